//! Presets fill in what the method leaves open, in order of accuracy, and touch nothing else.

use crate::common::{example_with, read, set};
use cagedyn::scene::Preset;
use cagedyn::{Model, Sim, Status};
use serde_json::{Value, json};
use std::sync::Arc;

fn model(scene: &Value) -> Arc<Model> {
    Arc::new(Model::from_json(&scene.to_string()).unwrap_or_else(|e| panic!("{e}")))
}

fn with_solver(solver: Value) -> Arc<Model> {
    model(&example_with(&[("solver", solver)]))
}

fn sim(solver: Value) -> Sim {
    Sim::new(with_solver(solver)).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn the_default_is_engineering_and_a_caller_may_choose_another() {
    let chosen = sim(json!({"preset": "draft", "max_step": 2e-5}));
    assert_eq!(chosen.preset(), Preset::Draft);
    assert_eq!(sim(json!({})).preset(), Preset::Engineering);
    let mut asked = Sim::with_preset(with_solver(json!({"max_step": 2e-5})), Preset::Draft).unwrap();
    assert_eq!(asked.preset(), Preset::Draft);
    let mut chosen = chosen;
    for sim in [&mut asked, &mut chosen] {
        sim.advance_to(1e-3).unwrap();
    }
    assert_eq!(asked.state(), chosen.state(), "the same numbers, whoever asks for the preset");
    let other = Sim::new(with_solver(json!({"max_step": 2e-5}))).unwrap().save();
    assert_eq!(asked.restore(&other).unwrap_err().status, Status::BadSnapshot, "made with another preset");
}

#[test]
fn rollers_are_followed_in_their_statistics_but_for_comparing() {
    let step = |preset: &str| sim(json!({"preset": preset})).nominal_step();
    let [draft, engineering] = ["draft", "engineering"].map(step);
    assert!(draft > 1.2 * engineering, "{draft:e} {engineering:e}");
    for (preset, leapfrog) in [("draft", true), ("engineering", true), ("reference", false)] {
        let mut sim = sim(json!({"preset": preset}));
        sim.advance_to(10e-3).unwrap();
        let [by_leapfrog, others @ ..] = sim.statistics().choice.expect("auto chooses").steps;
        // Nothing vibrates at the start.
        assert_eq!(by_leapfrog > others.iter().sum(), leapfrog, "{preset}: {by_leapfrog}, {others:?}");
        assert!(leapfrog || by_leapfrog == 0, "{preset}: {by_leapfrog}");
    }
}

#[test]
fn what_a_method_leaves_open_is_filled_in_and_what_it_says_stays() {
    let step = |preset: &str, method: Value| sim(json!({"preset": preset, "method": method})).nominal_step();
    let free = ["draft", "engineering", "reference"].map(|p| step(p, json!({"leapfrog": {}})));
    assert!(free[0] > free[1] && free[1] > free[2], "{free:?}");
    for preset in Preset::ALL {
        assert_eq!(step(preset.name(), json!({"leapfrog": {"step": 1e-6}})), 1e-6);
    }
    for method in ["auto", "dormand_prince", "adams", "rosenbrock", "radau"] {
        let end = |preset: &str, parameters: Value| {
            let mut sim = sim(json!({"preset": preset, "method": {method: parameters}}));
            sim.advance_to(1e-4).unwrap();
            sim.state().to_vec()
        };
        let given = json!({"tolerance": 1e-5});
        assert_eq!(end("draft", given.clone()), end("reference", given), "{method}");
        if method != "auto" {
            assert_ne!(end("draft", json!({})), end("engineering", json!({})), "{method}");
        }
        assert_eq!(end("reference", json!({})), end("draft", json!({"tolerance": 1e-8})), "{method}");
    }
}

/// The cage on its greased guide, dropped from several places off the centre; errors alone limit the steps.
#[test]
fn errors_fall_from_preset_to_preset() {
    let mut scene: Value = serde_json::from_str(&read("scenes/grease_guide.json")).unwrap();
    let mut end = |y: f64, solver: Value| {
        set(&mut scene, "initial", json!({"cage": {"y": y, "z": 0.0}}));
        set(&mut scene, "solver", solver);
        let mut sim = Sim::new(model(&scene)).unwrap();
        sim.advance_to(15e-3).unwrap();
        ([sim.state()[0], sim.state()[1]], sim.statistics().evaluations)
    };
    let mut runs = [(0.0f64, 0); 3];
    for y in [2e-5, 3e-5, 5e-5, 8e-5] {
        let (exact, _) = end(y, json!({"method": {"rosenbrock": {"tolerance": 1e-12}}}));
        for (run, preset) in runs.iter_mut().zip(Preset::ALL) {
            let solver = json!({"preset": preset.name(), "max_step": 1e-3, "method": {"dormand_prince": {}}});
            let (centre, evaluations) = end(y, solver);
            let error = (centre[0] - exact[0]).hypot(centre[1] - exact[1]);
            *run = (run.0.max(error), run.1 + evaluations);
        }
    }
    println!("largest error in m and evaluations: {runs:?}");
    for pair in runs.windows(2) {
        assert!(pair[1].0 < 0.1 * pair[0].0 && pair[1].1 > pair[0].1, "{runs:?}");
    }
}
