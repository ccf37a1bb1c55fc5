//! The implicit methods on a stiff, driven system with the structure of a bearing.

use crate::common::systems::Driven;
use cagedyn::integrate::{DormandPrince, Driver, Limits, Radau, Rosenbrock, Stepper};

const DRIVEN_START: [f64; 7] = [0.0, 0.3, -0.2, 1.0, 0.1, 0.4, 0.5];

type Method = Box<dyn Stepper<Driven>>;

fn rosenbrock(system: &Driven) -> Method {
    Box::new(Rosenbrock::new(system, &[1.0; 7]))
}

/// Its iteration goes as far as the tolerance asks.
fn radau(system: &Driven) -> Method {
    Box::new(Radau::new(system, &[1e-13; 7]))
}

/// State at t = 2 with steps of size `h`.
fn at_two(new: fn(&Driven) -> Method, rate: f64, h: f64) -> Vec<f64> {
    let mut system = Driven { rate };
    let mut m = new(&system);
    m.set_state(&DRIVEN_START);
    for i in 0..(2.0 / h).round() as usize {
        m.attempt(&mut system, i as f64 * h, h, f64::INFINITY).unwrap();
        m.accept();
    }
    m.state().to_vec()
}

#[test]
fn steps_have_the_order_of_the_method() {
    let mut system = Driven { rate: 3.0 };
    let reference = DormandPrince::new(&system, &[1e-13; 7]);
    let limits = Limits { nominal_step: 1e-3, min_step: 1e-14, max_step: 0.5, max_steps: 10_000_000 };
    let mut driver = Driver::new(Box::new(reference), limits);
    driver.start(0.0, &DRIVEN_START);
    driver.advance(&mut system, 2.0).unwrap();
    let mut exact = [0.0; 7];
    driver.state_at(2.0, &mut exact);
    for (new, theory) in [(rosenbrock as fn(&Driven) -> Method, 4.0), (radau, 5.0)] {
        let errors = [0.1, 0.05, 0.025].map(|h| {
            let end = at_two(new, 3.0, h);
            end.iter().zip(exact).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
        });
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!((order - theory).abs() < 0.2, "order {theory}: {errors:?}");
        }
    }
}

#[test]
fn steps_may_be_far_longer_than_stiff_rates() {
    // The fast velocity follows the cosine whatever its rate.
    for (new, bound) in [(rosenbrock as fn(&Driven) -> Method, 2e-4), (radau, 1e-5)] {
        for rate in [1e3, 1e6, 1e9] {
            let (coarse, fine) = (at_two(new, rate, 0.1), at_two(new, rate, 0.01));
            for (a, b) in coarse.iter().zip(&fine) {
                assert!((a - b).abs() < bound, "{rate}: {coarse:?} {fine:?}");
            }
            assert!((fine[3] - 2f64.cos()).abs() < 2.0 / rate + 1e-6);
        }
    }
}
