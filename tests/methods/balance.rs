//! The balance of energy that judges stretches of steps.

use cagedyn::integrate::auto::balance::Balance;
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
        balance.settle(&mut store, 0.0, &[], controlled).unwrap()
    })
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
