//! Simulations: determinism, threads, methods, failures, odd but valid scenes.

use crate::common::{example_text, example_with};
use crate::started::{ACCURATE, CHOSEN, STIFF, bits, model, sim, state_at};
use cagedyn::model::PARTS;
use cagedyn::sim::STATISTICS;
use cagedyn::{Model, Sim, Status};
use serde_json::{Value, json};
use std::sync::Arc;

#[test]
fn the_same_scene_gives_the_same_bits() {
    for method in [&[][..], &[CHOSEN][..], &[ACCURATE][..], &[STIFF][..]] {
        assert_eq!(bits(&state_at(method, 2e-3)), bits(&state_at(method, 2e-3)));
    }
}

#[test]
fn threads_do_not_affect_each_other() {
    let shared = model(&[]);
    let run = |speed: f64| {
        let mut s = Sim::new(shared.clone()).unwrap();
        s.set_input(0, speed).unwrap();
        s.advance_to(2e-3).unwrap();
        bits(s.state())
    };
    let alone = [run(-300.0), run(-100.0)];
    let together = std::thread::scope(|scope| {
        let threads = [scope.spawn(|| run(-300.0)), scope.spawn(|| run(-100.0))];
        threads.map(|t| t.join().unwrap())
    });
    assert_eq!(alone, together);
    assert_ne!(alone[0], alone[1]);
}

#[test]
fn all_methods_converge_to_the_same_trajectory() {
    // Before chaos: the first 2 ms. Largest distance of any body from where the reference has it, m.
    let solver = |method: &str| state_at(&[("solver", &format!("{{\"method\": {{{method}}}}}"))], 2e-3);
    let adaptive = |tolerance: &str| solver(&format!(r#""dormand_prince": {{"tolerance": {tolerance}}}"#));
    let rosenbrock = |tolerance: &str| solver(&format!(r#""rosenbrock": {{"tolerance": {tolerance}}}"#));
    let leapfrog = |step: &str| solver(&format!(r#""leapfrog": {{"step": {step}}}"#));
    let reference = adaptive("1e-9");
    let distance = |state: Vec<f64>| {
        let difference = |i: usize| (state[i] - reference[i]).abs();
        let orbits = (6..29).step_by(2).map(|i| 0.04 * difference(i));
        let lengths = (0..4).chain((5..29).step_by(2)).map(difference);
        orbits.chain(lengths).fold(0.0, f64::max)
    };
    let (coarse, fine) = (distance(leapfrog("4e-6")), distance(leapfrog("0.25e-6")));
    let (loose, tight) = (distance(adaptive("1e-4")), distance(adaptive("1e-7")));
    let (wide, narrow) = (distance(rosenbrock("1e-4")), distance(rosenbrock("1e-7")));
    println!(
        "leapfrog {coarse:e} {fine:e}, Dormand-Prince {loose:e} {tight:e}, Rosenbrock {wide:e} {narrow:e}"
    );
    assert!(coarse < 2e-6 && fine < 0.2 * coarse, "{coarse:e} {fine:e}");
    assert!(loose < 1e-6 && tight < 0.05 * loose, "{loose:e} {tight:e}");
    assert!(wide < 2e-6 && narrow < 0.05 * wide, "{wide:e} {narrow:e}");
}

#[test]
fn forces_of_a_state_do_not_depend_on_history() {
    let mut s = sim(&[]);
    s.advance_to(1e-3).unwrap();
    let stepped = s.forces().unwrap().clone();
    let state = s.state().to_vec();
    let mut rate = vec![0.0; state.len()];
    s.derivative(0.5, &vec![0.0; state.len()], &mut rate).unwrap();
    let mut fresh = sim(&[]);
    fresh.set_state(1e-3, &state).unwrap();
    assert_eq!(*fresh.forces().unwrap(), stepped);
    assert_eq!(*s.forces().unwrap(), stepped);
    s.derivative(1e-3, &state, &mut rate).unwrap();
    assert_eq!(rate[29..], stepped.accelerations);
}

#[test]
fn a_run_that_cannot_go_on_says_why_and_can_be_reset() {
    // A step far beyond the stability limit throws rollers out; no smaller step is allowed.
    let mut s = sim(&[("solver", r#"{"method": {"leapfrog": {"step": 1e-4}}, "min_step": 1e-6}"#)]);
    let e = s.advance_to(1.0).unwrap_err();
    assert_eq!(e.status, Status::StepTooSmall);
    assert!(e.message.contains("at t = ") && e.message.contains("step"), "{e}");
    assert!(s.time() < 1.0 && e.message.contains(&format!("t = {:?} s", s.time())), "{e}");
    s.reset().unwrap();
    assert_eq!(s.time(), 0.0);
    s.advance_to(1e-5).unwrap();
}

#[test]
fn odd_scenes_run() {
    let free_of_cage = [("cage", "null")];
    let no_guide = [("cage.guide", "null")];
    let no_pockets = [("cage.pocket", "null")];
    let one_roller = [("rollers.count", "1"), ("initial.inner_ring", "\"centred\"")];
    let standing = [("inner_ring.speed.constant", "0")];
    let reversed = [("inner_ring.speed.constant", "314")];
    let preload = [("inner_ring.radial_clearance", "-5e-6")];
    let unloaded = [("inner_ring.motion.free.load", "null"), ("gravity", "null")];
    let elastic_only = [
        ("raceways.contact", "{}"),
        ("raceways.rolling_resistance", "null"),
        ("cage.pocket.lubricated_cylinder.contact", "{}"),
        ("lubricant", "null"),
        ("cage.guide", "null"),
    ];
    let rough_cage = [(
        "cage.guide.roundness",
        r#"[{"order": 2, "amplitude": 10e-6, "phase": 0}, {"order": 4, "amplitude": 5e-6, "phase": 1}]"#,
    )];
    let scenes: [&[(&str, &str)]; 10] = [
        &free_of_cage,
        &no_guide,
        &no_pockets,
        &one_roller,
        &standing,
        &reversed,
        &preload,
        &unloaded,
        &elastic_only,
        &rough_cage,
    ];
    for overrides in scenes {
        for method in [&[][..], &[CHOSEN][..], &[ACCURATE][..], &[STIFF][..]] {
            let overrides: Vec<_> = overrides.iter().chain(method).copied().collect();
            let mut s = sim(&overrides);
            s.advance_to(1e-3).unwrap_or_else(|e| panic!("{overrides:?}: {e}"));
            let mut out = vec![f64::NAN; s.channels().len()];
            s.outputs(&mut out).unwrap();
            assert!(out.iter().all(|x| x.is_finite()), "{overrides:?}");
        }
    }
}

#[test]
fn several_hundred_rollers_run() {
    let mut s = sim(&[
        ("rollers.count", "400"),
        ("outer_ring.raceway_radius", "1.3"),
        ("cage.inertia", "0.59"),
        ("cage.guide.guide_radius", "1.295"),
    ]);
    assert_eq!(s.state().len(), 2 * (2 + 3) + 5 * 400);
    s.advance_to(0.2e-3).unwrap();
}

#[test]
fn an_undamped_frictionless_bearing_keeps_its_energy() {
    // Ring and rollers on elastic raceways without gravity: kinetic energy plus the elastic energy of the contacts.
    let mut s = sim(&[
        ("raceways.contact", "{}"),
        ("raceways.rolling_resistance", "null"),
        ("cage", "null"),
        ("gravity", "null"),
        ("inner_ring.motion.free.load", "null"),
        ("inner_ring.motion.free.support_damping", "null"),
        ("inner_ring.radial_clearance", "-2e-6"),
        ("initial.inner_ring", "\"centred\""),
        ("solver", r#"{"method": {"dormand_prince": {"tolerance": 1e-9}}}"#),
    ]);
    let model = s.model().clone();
    let mut state = s.state().to_vec();
    let nq = model.layout().positions();
    state[nq] = 0.02;
    s.set_state(0.0, &state).unwrap();
    let energy = |s: &mut Sim| {
        let forces = s.forces().unwrap().clone();
        let state = s.state();
        let (q, v) = state.split_at(nq);
        let ring = 0.5 * 3.0 * (v[0] * v[0] + v[1] * v[1]);
        let rollers: f64 = (0..12)
            .map(|j| {
                let i = model.layout().element(j);
                let r = model.pitch_radius() + q[i];
                0.5 * 0.0304 * (v[i] * v[i] + (r * v[i + 1]).powi(2))
            })
            .sum();
        // Palmgren: the integral of Q over the approach is 9/19 Q delta.
        let elastic: f64 = forces.contacts.iter().map(|c| 9.0 / 19.0 * c[0] * c[1]).sum();
        (ring + rollers + elastic, elastic)
    };
    let (before, elastic) = energy(&mut s);
    for i in 1..=10 {
        s.advance_to(f64::from(i) * 1e-4).unwrap();
        let (now, _) = energy(&mut s);
        assert!((now - before).abs() < 1e-5 * elastic, "{now} {before} (elastic {elastic})");
    }
}

#[test]
fn after_a_failed_advance_time_state_and_outputs_are_those_of_the_last_step() {
    for method in
        [r#""leapfrog": {}"#, r#""dormand_prince": {"tolerance": 1e-6}"#, r#""adams": {"tolerance": 1e-6}"#]
    {
        let solver = format!(r#"{{"method": {{{method}}}, "max_steps": 400}}"#);
        let mut s = sim(&[("solver", &solver)]);
        s.advance_to(0.1e-3).unwrap();
        let e = s.advance_to(1.0).unwrap_err();
        assert_eq!(e.status, Status::TooManySteps);
        let time = s.time();
        assert!(time > 0.11e-3 && time < 1.0 && e.message.contains(&format!("t = {time:?} s")), "{e}");
        let mut reached = vec![0.0; s.channels().len()];
        s.outputs(&mut reached).unwrap();
        // The same as of a run that was asked for this time.
        let mut whole = sim(&[("solver", &format!(r#"{{"method": {{{method}}}}}"#))]);
        whole.advance_to(time).unwrap();
        let mut expected = reached.clone();
        whole.outputs(&mut expected).unwrap();
        assert_eq!((bits(s.state()), bits(&reached)), (bits(whole.state()), bits(&expected)));
        s.step(0.1e-3).unwrap();
        assert!(s.state()[..4].iter().all(|x| x.abs() < 1e-4), "{:?}", &s.state()[..4]);
    }
}

/// Where nothing has energy, none is missing.
#[test]
fn nothing_is_missing_of_nothing() {
    let mut s = sim(&[
        ("gravity", "null"),
        ("inner_ring.speed.constant", "0"),
        ("inner_ring.motion.free.load.z.constant", "0"),
        ("initial.inner_ring", "centred"),
    ]);
    s.advance_to(1e-3).unwrap();
    assert_eq!(s.power_balance().unwrap().relative_residual(), 0.0);
    // The smallest times there are.
    let mut s = sim(&[]);
    s.advance_to(5e-324).unwrap();
    s.step(5e-324).unwrap();
    let state = s.state().to_vec();
    s.set_state(5e-324, &state).unwrap();
    s.step(1e-6).unwrap();
}

#[test]
fn times_too_large_for_a_step_are_refused() {
    let mut s = sim(&[]);
    let state = s.state().to_vec();
    assert_eq!(s.set_state(1e12, &state).unwrap_err().status, Status::BadValue);
    assert_eq!(s.advance_to(1e7).unwrap_err().status, Status::BadValue);
    s.set_state(9.9e5, &state).unwrap();
    s.step(1e-4).unwrap();
}

#[test]
fn stiff_support_and_light_rings_get_the_step_they_need() {
    let mut s = sim(&[("inner_ring.motion.free.support_damping", "1e9")]);
    s.advance_to(2e-3).unwrap();
    assert!(s.nominal_step() > 2.4e-6);
    let light = sim(&[("inner_ring.motion.free.mass", "0.02")]);
    assert!(light.nominal_step() < 0.5 * s.nominal_step(), "{}", light.nominal_step());
}

#[test]
fn recordings_refuse_intervals_that_never_end() {
    let mut s = sim(&[]);
    for interval in [0.0, -1.0, f64::NAN, 1e-300] {
        let mut recording = cagedyn::Recording::default();
        let e = recording.run(&mut s, 1e-3, interval, |_, _| true).unwrap_err();
        assert_eq!(e.status, Status::BadValue, "{interval}");
    }
}

#[test]
fn parts_of_an_evaluation_are_timed_without_leaving_a_trace() {
    let text = example_text();
    let times = |text: &str| {
        let mut sim = Sim::new(Arc::new(Model::from_json(text).unwrap())).unwrap();
        // Elements touch the cage only now and then.
        let mut states = Vec::new();
        for i in 1..=20 {
            sim.advance_to(0.5e-3 * f64::from(i)).unwrap();
            states.push((sim.time(), sim.state().to_vec()));
        }
        let (before, saved) = (sim.statistics(), sim.save());
        let times = sim.time_parts(&states, 10).unwrap();
        assert_eq!(sim.time_parts(&[], 10).unwrap(), [0.0; PARTS.len()]);
        let far = vec![f64::NAN; sim.state().len()];
        assert_eq!(sim.time_parts(&[(0.0, far)], 10).unwrap_err().status, Status::BadValue);
        assert_eq!((sim.statistics(), sim.save()), (before, saved));
        times
    };
    let all = times(&text);
    assert!(all.iter().all(|t| *t > 0.0 && *t < 1e-2), "{all:?}");
    let loose = example_with(&[("cage.pocket", Value::Null), ("cage.guide", Value::Null)]).to_string();
    let part = |name: &str| PARTS.iter().position(|part| *part == name).unwrap();
    let some = times(&loose);
    assert_eq!([some[part("pockets")], some[part("guide")]], [0.0; 2]);
    assert!(some[part("outer_raceway")] > 0.0);
}

#[test]
fn runs_without_vector_instructions_have_the_same_bits() {
    let model = Arc::new(Model::from_json(&example_text()).unwrap());
    let mut sims = [Sim::new(model.clone()).unwrap(), Sim::new(model).unwrap()];
    sims[1].set_vector_instructions(false);
    for sim in &mut sims {
        sim.advance_to(5e-3).unwrap();
    }
    assert_eq!(sims[0].save(), sims[1].save());
}

#[test]
fn derivatives_are_counted() {
    let count = |method: &str| {
        let solver = json!({"method": {method: {}}});
        let text = example_with(&[("solver", solver)]).to_string();
        let mut sim = Sim::new(Arc::new(Model::from_json(&text).unwrap())).unwrap();
        sim.advance_to(1e-4).unwrap();
        let statistics = sim.statistics();
        let place = STATISTICS.iter().position(|name| *name == "jacobians").unwrap();
        assert_eq!(statistics.values()[place], statistics.jacobians as f64);
        (statistics.jacobians, statistics.driver.steps)
    };
    assert_eq!(count("leapfrog").0, 0);
    let (jacobians, steps) = count("rosenbrock");
    assert!(jacobians >= steps && steps > 0, "{jacobians} {steps}");
}
