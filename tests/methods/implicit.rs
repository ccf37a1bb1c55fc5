//! The implicit methods on a stiff, driven system with the structure of a bearing.

use cagedyn::integrate::{
    DormandPrince, Driver, GroupDamping, Limits, Linearization, Radau, Rosenbrock, Stepper, Structure, System,
};

/// v' = -rate (v - cos t) with a position, coupled to a spoke of three velocities: stiff and driven.
struct Driven {
    rate: f64,
}

impl System for Driven {
    type Fault = &'static str;

    fn positions(&self) -> usize {
        3
    }
    fn velocities(&self) -> usize {
        4
    }
    fn accelerations(&mut self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]) -> Result<(), &'static str> {
        a[0] = -self.rate * (v[0] - t.cos()) - t.sin() + 0.3 * (q[1] - q[0]) - v[3] * v[0];
        a[1] = -q[1] * q[1] * q[1] + 0.5 * q[0] - 0.2 * v[1] * v[2];
        a[2] = -4.0 * q[2] + (t * q[1]).sin();
        a[3] = v[0] - v[3] * v[3];
        Ok(())
    }
    fn not_finite(&self, _: usize) -> &'static str {
        "not finite"
    }
    fn next_event(&self, _: f64) -> f64 {
        f64::INFINITY
    }
    fn groups(&self) -> usize {
        0
    }
    fn group(&self, _: usize) -> [Option<usize>; 3] {
        [None; 3]
    }
    fn structure(&self) -> Structure {
        Structure { hub: [Some(0), None, None, None, None], spokes: vec![[1, 2, 3]] }
    }
    fn linearize(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        a: &mut [f64],
        out: &mut Linearization,
    ) -> Result<(), &'static str> {
        self.accelerations(t, q, v, a)?;
        out.clear();
        let (k, d) = (&mut out.over_positions, &mut out.over_velocities);
        k.hub[(0, 0)] = -0.3;
        k.spokes[0].to_hub[(0, 0)] = 0.3;
        d.hub[(0, 0)] = -self.rate - v[3];
        d.spokes[0].to_hub[(0, 2)] = -v[0];
        k.spokes[0].from_hub[(0, 0)] = 0.5;
        k.spokes[0].own[(0, 0)] = -3.0 * q[1] * q[1];
        d.spokes[0].own[(0, 0)] = -0.2 * v[2];
        d.spokes[0].own[(0, 1)] = -0.2 * v[1];
        k.spokes[0].own[(1, 0)] = t * (t * q[1]).cos();
        k.spokes[0].own[(1, 1)] = -4.0;
        d.spokes[0].from_hub[(2, 0)] = 1.0;
        d.spokes[0].own[(2, 2)] = -2.0 * v[3];
        out.over_time.copy_from_slice(&[-self.rate * t.sin() - t.cos(), 0.0, q[1] * (t * q[1]).cos(), 0.0]);
        Ok(())
    }
    fn damping(&self, _: f64, _: &[f64], _: &[f64], _: &mut GroupDamping) {}
}

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
