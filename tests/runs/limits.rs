//! What ends a run: limits, requests from other threads, states that cannot be left. What was reached stays available.

use crate::common::{example_with, read};
use cagedyn::model::POWERS;
use cagedyn::{Model, Recording, Sim, Status};
use serde_json::{Value, json};
use std::sync::Arc;
use std::time::Duration;

fn sim(scene: &Value) -> Sim {
    Sim::new(Arc::new(Model::from_json(&scene.to_string()).unwrap())).unwrap()
}

fn bits(x: &[f64]) -> Vec<u64> {
    x.iter().map(|x| x.to_bits()).collect()
}

#[test]
fn an_interrupted_run_goes_on_with_the_same_bits() {
    let methods = ["auto", "leapfrog", "dormand_prince", "adams", "rosenbrock", "radau"];
    for method in methods {
        let scene = example_with(&[("solver", json!({"method": {method: {}}}))]);
        let mut whole = sim(&scene);
        whole.advance_to(2e-3).unwrap();
        let mut parts = sim(&scene);
        let canceller = parts.canceller();
        let mut interruptions = 0;
        while parts.time() < 2e-3 {
            canceller.cancel();
            assert_eq!(parts.advance_to(2e-3).unwrap_err().status, Status::Cancelled, "{method}");
            interruptions += 1;
            let mut outputs = vec![0.0; parts.channels().len()];
            parts.outputs(&mut outputs).unwrap();
            let until = (parts.time() + 0.3e-3).min(2e-3);
            parts.advance_to(until).unwrap();
        }
        assert!(interruptions > 5);
        assert_eq!(bits(parts.state()), bits(whole.state()), "{method}");
        assert_eq!(parts.statistics(), whole.statistics(), "{method}");
    }
}

/// Within a stretch of judged steps as anywhere else.
#[test]
fn a_run_of_many_short_advances_has_the_same_bits() {
    for text in [read("scenes/nu2310.json"), read("scenes/grease_guide.json")] {
        let mut scene: Value = serde_json::from_str(&text).unwrap();
        let mut whole = sim(&scene);
        let until = 3e-3;
        whole.advance_to(until).unwrap();
        scene["solver"]["max_steps"] = json!(7);
        let mut parts = sim(&scene);
        let mut advances = 0;
        let mut outputs = vec![0.0; parts.channels().len()];
        while let Err(e) = parts.advance_to(until) {
            assert_eq!(e.status, Status::TooManySteps, "{e}");
            assert!(e.message.contains(&format!("t = {:?} s", parts.time())) && parts.time() < until, "{e}");
            parts.outputs(&mut outputs).unwrap();
            parts.power_balance().unwrap();
            advances += 1;
        }
        assert!(advances > 10, "{advances}");
        assert_eq!(bits(parts.state()), bits(whole.state()));
        assert_eq!(parts.statistics().driver, whole.statistics().driver);
    }
}

#[test]
fn the_largest_step_binds_every_method() {
    for method in ["auto", "leapfrog", "dormand_prince", "adams", "rosenbrock", "radau"] {
        let bound = 1e-6;
        let scene = example_with(&[("solver", json!({"method": {method: {}}, "max_step": bound}))]);
        let mut sim = sim(&scene);
        sim.advance_to(0.5e-3).unwrap();
        let largest = sim.statistics().driver.largest_step;
        assert!(0.0 < largest && largest <= bound, "{method}: {largest}");
    }
}

#[test]
fn a_request_from_another_thread_ends_a_run() {
    let mut sim = sim(&example_with(&[]));
    let canceller = sim.canceller();
    let thread = std::thread::spawn(move || {
        std::thread::sleep(Duration::from_millis(50));
        canceller.cancel();
    });
    let e = sim.advance_to(1e5).unwrap_err();
    thread.join().unwrap();
    assert_eq!(e.status, Status::Cancelled);
    assert!(e.message.starts_with("at t = "), "{e}");
    assert!(sim.time() > 0.0 && e.message.contains(&format!("{:?} s", sim.time())), "{e}");
}

#[test]
fn recorded_data_stay_when_the_wall_time_is_used_up() {
    let mut sim = sim(&example_with(&[]));
    sim.set_wall_time_limit(0.1).unwrap();
    let mut recording = Recording::default();
    let e = recording.run(&mut sim, 1e3, 1e-4, |_, _| true).unwrap_err();
    assert_eq!(e.status, Status::OutOfTime);
    let last = *recording.times.last().unwrap();
    assert!(last > 0.0 && last <= sim.time() && sim.time() < last + 1e-4);
    assert!(recording.columns.iter().all(|column| column.len() == recording.times.len()));
    assert_eq!(sim.advance_to(1e3).unwrap_err().status, Status::OutOfTime);
    sim.reset().unwrap();
    assert_eq!(sim.advance_to(1e-3).unwrap_err().status, Status::OutOfTime);
    sim.set_wall_time_limit(f64::INFINITY).unwrap();
    sim.advance_to(1e-3).unwrap();
    for seconds in [f64::NAN, -1.0, f64::NEG_INFINITY] {
        assert_eq!(sim.set_wall_time_limit(seconds).unwrap_err().status, Status::BadValue);
    }
}

#[test]
fn a_step_that_becomes_too_small_names_the_body() {
    // Contacts with kinks, and an error that no step of this size keeps.
    let solver = json!({"method": {"dormand_prince": {"tolerance": 1e-12}}, "min_step": 1e-7});
    let mut sim = sim(&example_with(&[("solver", solver)]));
    let e = sim.advance_to(1.0).unwrap_err();
    assert_eq!(e.status, Status::StepTooSmall);
    assert!(["roller[", "inner_ring", "cage"].iter().any(|body| e.message.contains(body)), "{e}");
    assert!(e.message.starts_with("at t = "), "{e}");
}

#[test]
fn outputs_of_the_leapfrog_have_the_forces_of_its_steps() {
    // Friction of the heaviest contacts decays within a hundredth of a step.
    let scene = example_with(&[
        ("inner_ring.motion.free.load.z", json!({"constant": -40e3})),
        ("solver", json!({"preset": "draft", "method": {"leapfrog": {}}})),
    ]);
    let mut sim = sim(&scene);
    let drive = POWERS.iter().position(|name| *name == "ring_drive").unwrap();
    let torque = sim.channels().iter().position(|c| c.name == "inner_ring.drag_torque").unwrap();
    let (start, duration, records) = (5e-3, 20e-3, 1000);
    sim.advance_to(start).unwrap();
    let before = sim.power_balance().unwrap();
    let mut mean = 0.0;
    for i in 1..=records {
        sim.advance_to(start + duration * f64::from(i) / f64::from(records)).unwrap();
        mean += sim.output(torque).unwrap() / f64::from(records);
    }
    let after = sim.power_balance().unwrap();
    let angle = 314.1592653589793 * (after.to - before.to);
    let expected = (after.work[drive] - before.work[drive]) / angle;
    assert!((mean / expected - 1.0).abs() < 0.02, "{mean} {expected}");
}

#[test]
fn the_balance_closes_and_better_with_smaller_tolerances() {
    for (file, duration) in [("scenes/nu2310.json", 5e-3), ("scenes/grease_guide.json", 20e-3)] {
        let scene: Value = serde_json::from_str(&read(file)).unwrap();
        for method in ["dormand_prince", "adams", "rosenbrock", "radau"] {
            let residual = |tolerance: f64| {
                let solver = json!({"method": {method: {"tolerance": tolerance}}});
                let mut sim = sim(&crate::common::with(&scene, &[("solver", solver)]));
                sim.advance_to(duration).unwrap();
                sim.power_balance().unwrap().relative_residual().abs()
            };
            let (coarse, fine) = (residual(1e-4), residual(1e-8));
            println!("{file} {method}: {coarse:.2e} {fine:.2e}");
            // Simpson's rule does not see the kinks between its points.
            let largest = if method == "rosenbrock" { 1e-5 } else { 1e-6 };
            assert!(
                coarse < 1e-3 && fine < largest && fine < coarse.max(1e-7),
                "{file} {method}: {coarse} {fine}"
            );
        }
        let mut sim = sim(&scene);
        sim.advance_to(duration).unwrap();
        let balance = sim.power_balance().unwrap();
        println!("{file} engineering: {:.2e} {balance:?}", balance.relative_residual());
    }
}
