//! The integration methods on small systems with known solutions: order, dense output, events, faults, saving.

use crate::common::systems::Oscillator;
use cagedyn::integrate::{
    Adams, DormandPrince, Driver, Failure, Leapfrog, Limits, Radau, Rosenbrock, Stepper, implicit_share,
};
use cagedyn::stored::{Reader, Stored};

const START: [f64; 5] = [1.0, 0.0, 0.0, 3.0, 0.0];

fn limits(step: f64) -> Limits {
    Limits { nominal_step: step, min_step: 1e-14, max_step: 0.5, max_steps: 10_000_000 }
}

fn leapfrog(s: &Oscillator, step: f64) -> Driver<Oscillator> {
    Driver::new(Box::new(Leapfrog::new(s)), limits(step))
}

fn dormand_prince(s: &Oscillator, tolerance: f64) -> Driver<Oscillator> {
    Driver::new(Box::new(DormandPrince::new(s, &[tolerance; 5])), limits(1e-3))
}

const METHODS: [&str; 4] = ["leapfrog", "dormand_prince", "adams", "radau"];

/// A method with error control by its name.
fn adaptive_driver(method: &str, s: &Oscillator, tolerance: f64) -> Driver<Oscillator> {
    match method {
        "adams" => Driver::new(Box::new(Adams::new(s, &[tolerance; 5])), limits(1e-3)),
        "radau" => Driver::new(Box::new(Radau::new(s, &[tolerance; 5])), limits(1e-3)),
        _ => dormand_prince(s, tolerance),
    }
}

/// Largest error of x, x', w at time t.
fn error(driver: &mut Driver<Oscillator>, system: &mut Oscillator, t: f64) -> f64 {
    let mut out = [0.0; 5];
    driver.advance(system, t).unwrap();
    driver.state_at(t, &mut out);
    let exact = system.exact(t);
    [out[0] - exact[0], out[2] - exact[1], out[4] - exact[2]]
        .into_iter()
        .fold(0.0, |m, e: f64| m.max(e.abs()))
}

#[test]
fn leapfrog_is_of_second_order_also_where_damping_is_known_roughly() {
    for known in [0.5, 1.0, 2.0] {
        let errors: Vec<f64> = [0.04, 0.02, 0.01, 0.005]
            .into_iter()
            .map(|h| {
                let mut s = Oscillator { known, ..Oscillator::smooth() };
                let mut d = leapfrog(&s, h);
                d.start(0.0, &START);
                error(&mut d, &mut s, 4.0)
            })
            .collect();
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!((order - 2.0).abs() < 0.2, "{known}: {errors:?}");
        }
    }
}

#[test]
fn dormand_prince_steps_are_of_fifth_order_and_dense_output_of_fourth() {
    let attempt = |h: f64, theta: f64| {
        let mut s = Oscillator::smooth();
        let mut m = DormandPrince::new(&s, &[1.0; 5]);
        let mut out = [0.0; 5];
        Stepper::<Oscillator>::set_state(&mut m, &START);
        m.refresh(&mut s, 0.0).unwrap();
        m.attempt(&mut s, 0.0, h, f64::INFINITY).unwrap();
        Stepper::<Oscillator>::accept(&mut m);
        Stepper::<Oscillator>::interpolate(&m, theta, &mut out);
        let exact = s.exact(theta * h);
        (out[0] - exact[0]).abs().max((out[4] - exact[2]).abs())
    };
    let local_order = |theta: f64| (attempt(0.4, theta) / attempt(0.2, theta)).log2();
    assert!((local_order(1.0) - 6.0).abs() < 0.3, "{}", local_order(1.0));
    assert!((local_order(0.37) - 5.0).abs() < 0.4, "{}", local_order(0.37));
}

#[test]
fn errors_follow_the_tolerance() {
    let at = |tolerance: f64| {
        let mut s = Oscillator::smooth();
        let mut d = dormand_prince(&s, tolerance);
        d.start(0.0, &START);
        error(&mut d, &mut s, 10.0)
    };
    assert!(at(1e-6) < 1e-5 && at(1e-9) < 1e-8 && at(1e-12) < 1e-11);
    assert!(at(1e-9) < 0.02 * at(1e-6));
}

#[test]
fn questions_do_not_change_the_steps() {
    for method in METHODS {
        let adaptive = method != "leapfrog";
        let run = |questions: usize| {
            let mut s = Oscillator::smooth();
            let mut d = if adaptive { adaptive_driver(method, &s, 1e-7) } else { leapfrog(&s, 0.013) };
            d.start(0.0, &START);
            let mut out = [0.0; 5];
            for i in 1..=questions {
                let t = 5.0 * i as f64 / questions as f64;
                d.advance(&mut s, t).unwrap();
                d.state_at(t, &mut out);
            }
            (out, s.evaluations, *d.statistics())
        };
        assert_eq!(run(1), run(1000));
    }
}

#[test]
fn dense_output_is_continuous_and_accurate() {
    let mut s = Oscillator::smooth();
    let mut d = leapfrog(&s, 0.01);
    d.start(0.0, &START);
    for i in 0..500 {
        assert!(error(&mut d, &mut s, 0.0137 * f64::from(i)) < 1e-4);
    }
}

#[test]
fn events_are_landed_on_exactly() {
    for method in METHODS {
        let adaptive = method != "leapfrog";
        let mut s = Oscillator { jump: 1.234_567, ..Oscillator::smooth() };
        let mut d = if adaptive { adaptive_driver(method, &s, 1e-9) } else { leapfrog(&s, 0.002) };
        d.start(0.0, &START);
        let e = error(&mut d, &mut s, 3.0);
        assert!(e < if adaptive { 1e-8 } else { 2e-6 }, "{e}");
        assert_eq!(d.statistics().events, 1);
        assert_eq!(d.statistics().rejected, 0, "a jump that is landed on costs no rejected step");
    }
}

#[test]
fn a_fault_is_retried_with_smaller_steps_and_ends_in_an_error() {
    for method in METHODS {
        let adaptive = method != "leapfrog";
        // x falls from 1, so a wall below never matters; one above 1 that is crossed upwards does.
        let mut s = Oscillator { zeta: 0.0, wall: 0.5, ..Oscillator::smooth() };
        let mut d = if adaptive { adaptive_driver(method, &s, 1e-6) } else { leapfrog(&s, 0.01) };
        d.start(0.0, &[0.0, 0.0, 1.0, 0.0, 0.0]);
        let Err(Failure::StepTooSmall { time, fault, .. }) = d.advance(&mut s, 2.0) else {
            panic!("the wall must stop the run");
        };
        assert_eq!(fault, Some("behind the wall"));
        // x = sin t reaches the wall at asin(0.5).
        assert!((time - 0.5f64.asin()).abs() < 1e-3, "stopped at {time}");
        assert!(d.statistics().faults > 10);
        let mut out = [0.0; 5];
        d.state_at(time, &mut out);
        assert!((out[0] - 0.5).abs() < 1e-3 && d.reached() == time);
        // With the wall gone the same driver goes on.
        s.wall = f64::INFINITY;
        d.advance(&mut s, 2.0).unwrap();
        d.state_at(2.0, &mut out);
        assert!((out[0] - 2f64.sin()).abs() < 1e-3);
    }
}

#[test]
fn a_fault_at_the_start_and_the_step_limit_are_reported() {
    let mut s = Oscillator { wall: 0.5, ..Oscillator::smooth() };
    let mut d = leapfrog(&s, 0.01);
    d.start(0.0, &START);
    assert!(matches!(d.advance(&mut s, 1.0), Err(Failure::AtStart { time: 0.0, .. })));
    let mut s = Oscillator::smooth();
    let few = Limits { max_steps: 10, ..limits(0.01) };
    let mut d = Driver::new(Box::new(Leapfrog::new(&s)), few);
    d.start(0.0, &START);
    assert!(matches!(d.advance(&mut s, 1.0), Err(Failure::TooManySteps { limit: 10, .. })));
    assert!(d.reached() > 0.09);
}

#[test]
fn saving_continues_bit_identically() {
    for method in METHODS {
        let adaptive = method != "leapfrog";
        let mut s = Oscillator { jump: 2.1, ..Oscillator::smooth() };
        let new =
            |s: &Oscillator| if adaptive { adaptive_driver(method, s, 1e-7) } else { leapfrog(s, 0.01) };
        let mut d = new(&s);
        d.start(0.0, &START);
        d.advance(&mut s, 1.003).unwrap();
        let mut saved = Vec::new();
        d.save_for_later(&mut saved);
        let mut other = new(&s);
        other.start(7.0, &[0.0; 5]);
        let mut reader = Reader::new(&saved);
        assert!(other.load(&mut reader).is_some() && reader.finished());
        let (mut a, mut b) = ([0.0; 5], [0.0; 5]);
        for t in [1.001, 1.5, 3.0] {
            d.advance(&mut s, t).unwrap();
            other.advance(&mut s.clone(), t).unwrap();
            d.state_at(t, &mut a);
            other.state_at(t, &mut b);
            assert_eq!(a, b);
        }
        assert!(other.load(&mut Reader::new(&saved[..saved.len() - 1])).is_none());
    }
}

#[test]
fn the_implicit_share_makes_decay_right_to_third_order_without_overshoot() {
    for z in [0.0_f64, 1e-9, 0.01, 0.1, 0.5] {
        let step = 1.0 - z / (1.0 + implicit_share(z) * z);
        assert!((step - (-z).exp()).abs() <= z.powi(4) / 20.0 + 1e-15, "{z}: {step}");
    }
    for z in [1.0, 10.0, 1e3, 1e8, 1e99, f64::INFINITY] {
        let share = implicit_share(z);
        assert!(share <= 1.0 && share * z >= z - 1.0, "{z}: {share}");
    }
}

#[test]
fn stiff_damping_of_the_leapfrog_never_overshoots() {
    // A speed that relaxes once to a million times within one step.
    for rate in [1e2, 1e3, 1e5, 1e8] {
        let mut s = Oscillator { rate, ..Oscillator::smooth() };
        let mut d = leapfrog(&s, 0.01);
        d.start(0.0, &START);
        let (mut out, mut before) = ([0.0; 5], 0.0);
        for step in 1..=100 {
            d.advance(&mut s, 0.01 * f64::from(step)).unwrap();
            d.state_at(0.01 * f64::from(step), &mut out);
            assert!(out[4] > before - 1e-12 && out[4] < 1.0 + 1e-12, "{rate} {step}: {before} {}", out[4]);
            before = out[4];
        }
        assert!((before - 1.0).abs() < 1e-9, "{rate}: {before}");
    }
}

/// Local orders at the end and within a step of an implicit method.
fn local_orders<M: Stepper<Oscillator>>(new: impl Fn(&Oscillator) -> M) -> [f64; 2] {
    let attempt = |h: f64, theta: f64| {
        let mut s = Oscillator::smooth();
        let mut m = new(&s);
        let mut out = [0.0; 5];
        m.set_state(&START);
        m.attempt(&mut s, 0.0, h, f64::INFINITY).unwrap();
        m.accept();
        m.interpolate(theta, &mut out);
        let exact = s.exact(theta * h);
        (out[0] - exact[0]).abs().max((out[2] - exact[1]).abs())
    };
    [1.0, 0.4].map(|theta| (attempt(0.2, theta) / attempt(0.1, theta)).log2())
}

#[test]
fn implicit_dense_output_is_of_its_local_order_and_ends_on_its_steps() {
    // Local errors are one order higher than the method's.
    let [end, within] = local_orders(|s| Rosenbrock::new(s, &[1.0; 5]));
    assert!(end > 4.7 && within > 3.7, "{end} {within}");
    let [end, within] = local_orders(|s| Radau::new(s, &[1e-12; 5]));
    assert!(end > 5.7 && within > 4.7, "{end} {within}");
}

/// Largest error at any time from 0 to 4, most of them within steps, with steps of size `h`.
fn error_within_steps<M: Stepper<Oscillator>>(new: impl Fn(&Oscillator) -> M, h: f64) -> f64 {
    const TIMES_PER_STEP: usize = 13;
    let mut s = Oscillator::smooth();
    let mut m = new(&s);
    m.set_state(&START);
    m.refresh(&mut s, 0.0).unwrap();
    let mut out = [0.0; 5];
    let mut largest: f64 = 0.0;
    for step in 0..(4.0 / h).round() as usize {
        let t = step as f64 * h;
        m.attempt(&mut s, t, h, f64::INFINITY).unwrap();
        m.accept();
        for i in 0..TIMES_PER_STEP {
            let theta = i as f64 / TIMES_PER_STEP as f64;
            m.interpolate(theta, &mut out);
            let exact = s.exact(t + theta * h);
            for (x, exact) in [out[0], out[2], out[4]].into_iter().zip(exact) {
                largest = largest.max((x - exact).abs());
            }
        }
    }
    largest
}

#[test]
fn dense_output_has_the_order_of_its_method() {
    fn check<M: Stepper<Oscillator>>(name: &str, theory: f64, new: impl Fn(&Oscillator) -> M) {
        let errors = [0.05, 0.025, 0.0125].map(|h| error_within_steps(&new, h));
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            println!("{name}: order {order:.2} of the dense output");
            assert!((order - theory).abs() < 0.2, "{name}: {errors:?}");
        }
    }
    check("leapfrog", 2.0, Leapfrog::new);
    check("Dormand-Prince", 5.0, |s| DormandPrince::new(s, &[1.0; 5]));
    check("Rosenbrock", 4.0, |s| Rosenbrock::new(s, &[1.0; 5]));
    check("Radau", 5.0, |s| Radau::new(s, &[1e-14; 5]));
}
