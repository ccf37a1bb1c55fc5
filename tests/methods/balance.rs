//! The balance of energy that judges stretches of steps.

use cagedyn::integrate::auto::balance::{Balance, Judgement};
use cagedyn::integrate::{Observed, System, Tuning};

/// Something that stores energy (J) and has no motion.
struct Store(f64);

impl System for Store {
    type Fault = &'static str;
    fn positions(&self) -> usize {
        0
    }
    fn velocities(&self) -> usize {
        0
    }
    fn accelerations(&mut self, _: f64, _: &[f64], _: &[f64], _: &mut [f64]) -> Result<(), &'static str> {
        Ok(())
    }
    fn not_finite(&self, _: usize) -> &'static str {
        "not finite"
    }
}

impl Observed for Store {
    fn power_count(&self) -> [usize; 2] {
        [1, 0]
    }
    fn energy(&self, _: &[f64], _: &[f64]) -> [f64; 3] {
        [self.0, 0.0, 0.0]
    }
}

/// Whether each stretch in turn, of this work and this gain of energy (J), is right in a run that may miss a thousandth.
fn judged<const N: usize>(controlled: bool, stretches: [[f64; 2]; N]) -> [bool; N] {
    let mut store = Store(0.0);
    let mut balance = Balance::new(&store, 1e-3, Tuning::default());
    balance.open(&mut store, 0.0, &[]).unwrap();
    stretches.map(|[work, gain]| {
        balance.add(&[work]);
        store.0 += gain;
        balance.settle(&mut store, 0.0, &[], controlled).unwrap() == Judgement::Right
    })
}

/// What closer steps miss as well is forgiven, until it has grown by half.
#[test]
fn steps_are_not_to_blame_for_what_closer_ones_miss_as_well() {
    use Judgement::{Inherent, Right, Wrong};
    for (controlled, again, judgement) in
        [(true, 0.0030, Inherent), (true, 0.0010, Wrong), (true, -0.0030, Wrong), (false, 0.0030, Wrong)]
    {
        let mut store = Store(0.0);
        let mut balance = Balance::new(&store, 1e-3, Tuning::default());
        balance.open(&mut store, 0.0, &[]).unwrap();
        let before = balance.clone();
        let mut stretch = |balance: &mut Balance, missing: f64| {
            balance.add(&[1.0]);
            store.0 += 1.0 - missing;
            balance.settle(&mut store, 0.0, &[], controlled).unwrap()
        };
        assert_eq!(stretch(&mut balance, 0.0040), Wrong);
        let missed = balance.missed();
        assert!((missed - 0.0040).abs() < 1e-12);
        balance = before;
        balance.open(&mut Store(1.0 - 0.0040), 0.0, &[]).unwrap();
        balance.suspect(missed);
        assert_eq!(stretch(&mut balance, again), judgement, "{controlled} {again}");
        if judgement == Inherent {
            assert_eq!(stretch(&mut balance, 0.0012), Right);
            assert_eq!(stretch(&mut balance, 0.0012), Wrong);
        }
    }
}

#[test]
fn a_stretch_may_miss_what_the_run_can_spare_but_the_latest_not_much_of_their_own() {
    for controlled in [true, false] {
        assert_eq!(judged(controlled, [[1.0, 0.9999]]), [true]);
        assert_eq!(judged(controlled, [[1.0, 0.9997]]), [false]);
        assert_eq!(judged(controlled, [[1000.0, 1000.0], [1.0, f64::NAN]]), [true, false]);
        // A little more may be missing after more energy; without error control not from all of the latest stretches,
        let mut stretches = [[1.0, 0.99]; 80];
        stretches[0] = [1e5, 1e5];
        let right = judged(controlled, stretches);
        assert!(right[..10].iter().all(|right| *right) && right[79] == controlled, "{right:?}");
        // but for what they give back, as the leapfrog does of a vibration.
        let stretches: [_; 80] = std::array::from_fn(|k| [1.0, if k % 2 == 0 { 1.01 } else { 0.99 }]);
        let stretches = [&[[1e5, 1e5]][..], &stretches].concat();
        let stretches: [_; 81] = stretches.try_into().unwrap();
        assert_eq!(judged(controlled, stretches), [true; 81]);
    }
}
