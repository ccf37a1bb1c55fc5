//! The multistep method: exact for polynomials whatever the steps, few evaluations, works, smooth output.

use crate::common::systems::Oscillator;
use cagedyn::integrate::{Adams, DormandPrince, Driver, Limits, Observed, SemiImplicit, Stepper, System};

/// A point whose acceleration is a polynomial of the time; its power is the rate of v^2/2.
struct Thrown;

impl Thrown {
    fn acceleration(t: f64) -> f64 {
        3.0 * t * t - 2.0 * t + 1.0
    }

    /// Position and speed after time `t` from rest at zero.
    fn exact(t: f64) -> [f64; 2] {
        [t.powi(4) / 4.0 - t.powi(3) / 3.0 + 0.5 * t * t, t.powi(3) - t * t + t]
    }
}

impl System for Thrown {
    type Fault = ();
    fn positions(&self) -> usize {
        1
    }
    fn velocities(&self) -> usize {
        1
    }
    fn accelerations(&mut self, t: f64, _q: &[f64], _v: &[f64], a: &mut [f64]) -> Result<(), ()> {
        a[0] = Self::acceleration(t);
        Ok(())
    }
    fn not_finite(&self, _: usize) {}
}

impl Observed for Thrown {
    fn power_count(&self) -> [usize; 2] {
        [1, 0]
    }
    fn powers(&mut self, _q: &[f64], v: &[f64], _step: Option<&SemiImplicit<'_>>, out: &mut [f64]) {
        out[0] = v[0];
    }
}

#[test]
fn polynomials_are_exact_over_uneven_steps() {
    let mut system = Thrown;
    let mut method = Adams::new(&system, &[1e-6; 2]);
    let method: &mut dyn Stepper<Thrown> = &mut method;
    method.set_state(&[0.0; 2]);
    method.refresh(&mut system, 0.0).unwrap();
    let (mut t, mut work, mut defects) = (0.0, 0.0, Vec::new());
    for i in 0..60 {
        // The order rises with every step; then the polynomial is one of those that the method is made of.
        let h = if i < 8 { 4e-4 } else { 0.01 * f64::from(1 + i % 3) };
        let error = method.attempt(&mut system, t, h, f64::INFINITY).unwrap().unwrap().error;
        assert!(error <= 1.0, "step {i}: {error}");
        let before = method.state().to_vec();
        method.accept();
        work += method.progress().works[0];
        t += h;
        // From where it was, with the speed that it had.
        let start = Thrown::exact(t - h);
        let faster = before[1] - start[1];
        let off = |state: &[f64], t: f64, since: f64| {
            let [x, v] = Thrown::exact(t);
            let position = state[0] - before[0] - (x - start[0]) - faster * since;
            position.abs().max((state[1] - v - faster).abs())
        };
        defects.push(off(method.state(), t, h));
        let (mut inside, theta) = ([0.0; 2], 0.3);
        method.interpolate(theta, &mut inside);
        defects.push(off(&inside, t - h + theta * h, theta * h));
    }
    assert!(defects[24..].iter().all(|defect| *defect < 1e-15), "{defects:?}");
    let [position, _] = Thrown::exact(t);
    assert!((work - method.state()[0]).abs() < 1e-12 && (work - position).abs() < 1e-6, "{work} {position}");
}

#[test]
fn tight_tolerances_take_few_evaluations() {
    let limits = Limits { nominal_step: 1e-3, min_step: 1e-14, max_step: 0.5, max_steps: 1_000_000 };
    let start = [1.0, 0.0, 0.0, 3.0, 0.0];
    let run = |adams: bool, tolerance: f64| {
        let mut system = Oscillator::smooth();
        let tolerances = [tolerance; 5];
        let stepper: Box<dyn Stepper<Oscillator> + Send> = if adams {
            Box::new(Adams::new(&system, &tolerances))
        } else {
            Box::new(DormandPrince::new(&system, &tolerances))
        };
        let mut driver = Driver::new(stepper, limits);
        driver.start(0.0, &start);
        driver.advance(&mut system, 20.0).unwrap();
        let mut end = [0.0; 5];
        driver.state_at(20.0, &mut end);
        ((end[0] - system.exact(20.0)[0]).abs(), system.evaluations)
    };
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let [(error, evaluations), (_, theirs)] = [true, false].map(|adams| run(adams, tolerance));
        println!("{tolerance:e}: error {error:.1e}, {evaluations} evaluations, Dormand-Prince {theirs}");
        assert!(error < 100.0 * tolerance, "{tolerance:e}: {error:e}");
        assert!(
            evaluations < theirs * if tolerance > 1e-7 { 3 } else { 2 } / 4,
            "{tolerance:e}: {evaluations} {theirs}"
        );
    }
}
