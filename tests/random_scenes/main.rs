//! Random scenes and random damage to a scene: nothing panics, nothing is NaN, failures say why.

#[path = "../common/mod.rs"]
mod common;
mod damage;
mod published;
mod rollers_in_space;
mod scenes;

use cagedyn::model::FAULTS;
use cagedyn::{Error, Model, Recording, Scene, Sim, Status};
use common::Random;
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestError, TestRng, TestRunner};
use scenes::scene;
use serde_json::{Value, json};
use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A runner that tries the same cases on every machine and writes no files; PROPTEST_CASES asks for more.
fn runner(cases: u32) -> TestRunner {
    runner_from(0, cases)
}

/// The same with other cases for every seed.
fn runner_from(seed: u8, cases: u32) -> TestRunner {
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|text| text.parse().ok());
    let cases = cases.max(asked.unwrap_or(0));
    let config = Config { cases, failure_persistence: None, max_shrink_iters: 200, ..Config::default() };
    TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]))
}

/// What a scene combines: elements, pockets, and guide with its ring.
fn combination(scene: &Value) -> String {
    let key = |value: &Value| {
        value.as_object().and_then(|map| map.keys().next().cloned()).unwrap_or_else(|| "none".to_owned())
    };
    let elements = match &scene["kinematic_elements"]["motion"] {
        Value::Null => "rollers".to_owned(),
        motion => key(motion),
    };
    let cage = &scene["cage"];
    if cage.is_null() {
        return format!("{elements}, no cage");
    }
    let guide = match &cage["guide"] {
        Value::Null => "no guide".to_owned(),
        guide => {
            let solid = if guide["solid"].is_null() { "" } else { " and solid" };
            format!("film {}{solid} on {}", key(&guide["film"]), guide["ring"])
        }
    };
    format!("{elements}, pocket {}, {guide}", key(&cage["pocket"]))
}

/// How often each combination came up.
type Counts = RefCell<BTreeMap<String, u32>>;

fn count(counts: &Counts, what: String) {
    *counts.borrow_mut().entry(what).or_insert(0) += 1;
}

/// Panics with the scene that failed as JSON.
fn report(result: Result<(), TestError<Value>>) {
    match result {
        Ok(()) => {}
        Err(TestError::Fail(reason, scene)) => panic!("{reason}\n{scene}"),
        Err(e) => panic!("{e}"),
    }
}

/// Fails unless an error is one of a run and has a message of one line.
fn check_error(error: &Error, allowed: &[Status]) -> Result<(), TestCaseError> {
    prop_assert!(allowed.contains(&error.status), "{:?}: {error}", error.status);
    prop_assert!(!error.message.trim().is_empty());
    prop_assert!(!error.message.contains(['\n', '\r']), "{error}");
    Ok(())
}

fn check_finite(what: &str, names: &[String], values: &[f64]) -> Result<(), TestCaseError> {
    for (name, value) in names.iter().zip(values) {
        prop_assert!(value.is_finite(), "{what}: {name} is {value}");
    }
    Ok(())
}

/// Runs a scene; what kept it from its end, if so: the commonest fault, or the status.
fn run(scene: &Value) -> Result<Option<String>, TestCaseError> {
    let model = Model::from_json(&scene.to_string());
    let model = Arc::new(model.map_err(|e| TestCaseError::fail(format!("refused: {e}")))?);
    let names: Vec<String> = model.state_infos().into_iter().map(|info| info.name).collect();
    let mut sim = match Sim::new(model.clone()) {
        Ok(sim) => sim,
        Err(e) => {
            check_error(&e, &[Status::BadScene, Status::BadState])?;
            return Ok(Some(format!("{:?} at the start", e.status)));
        }
    };
    check_finite("initial state", &names, sim.state())?;
    let mut recording = Recording::default();
    let record = &model.scene().record;
    let result = recording.run(&mut sim, record.duration, record.interval, |_, _| true);
    if let Err(e) = &result {
        check_error(e, &[Status::StepTooSmall, Status::TooManySteps, Status::BadState])?;
        prop_assert!(e.message.starts_with("at t = "), "{e}");
    }
    check_finite("state", &names, sim.state())?;
    let channels: Vec<String> = sim.channels().iter().map(|channel| channel.name.clone()).collect();
    for (name, column) in channels.iter().zip(&recording.columns) {
        prop_assert!(column.iter().all(|x| x.is_finite()), "{name}: {column:?}");
        prop_assert_eq!(column.len(), recording.times.len());
    }
    if result.is_ok() {
        prop_assert_eq!(recording.times.len(), 11);
        prop_assert_eq!(sim.time(), record.duration);
    }
    Ok(result.err().map(|e| {
        let faults = sim.statistics().faults;
        let commonest = FAULTS.iter().zip(faults).max_by_key(|(_, count)| *count);
        commonest
            .filter(|(_, count)| *count > 0)
            .map_or(format!("{:?}", e.status), |(name, _)| name.to_string())
    }))
}

/// Runs a scene that runs from a state that differs in its last digits.
fn run_nearby(scene: &Value, seed: u64) -> Result<(), TestCaseError> {
    // Chaotic runs may take more steps.
    let scene = common::with(scene, &[("solver.max_steps", json!(400_000))]);
    let model = Model::from_json(&scene.to_string()).map_err(|e| TestCaseError::fail(e.to_string()))?;
    let duration = model.scene().record.duration;
    let scales = model.state_scales();
    let mut sim = Sim::new(Arc::new(model)).map_err(|e| TestCaseError::fail(e.to_string()))?;
    let mut random = Random::new(seed);
    let nearby = |(x, scale): (&f64, &f64)| x + 1e-12 * random.around_zero(1.0) * (x.abs() + scale);
    let state: Vec<f64> = sim.state().iter().zip(&scales).map(nearby).collect();
    let went = sim.set_state(0.0, &state).and_then(|()| sim.advance_to(duration));
    went.map_err(|e| TestCaseError::fail(format!("1e-12 away: {e}")))
}

/// Runs a thousand scenes, one in eight of those that reach their end again from nearby.
fn scenes_run_or_say_why_not(seed: u8) {
    let (finished, started) = (Cell::new(0), Cell::new(0));
    let failed = Counts::default();
    let result = runner_from(seed, 1000).run(&scene(), |scene| {
        started.set(started.get() + 1);
        if let Some(why) = run(&scene)? {
            count(&failed, why);
            return Ok(());
        }
        finished.set(finished.get() + 1);
        if finished.get() % 8 == 0 {
            run_nearby(&scene, finished.get())?;
        }
        Ok(())
    });
    report(result);
    // Failures are an answer, but most scenes can be simulated, unless nothing holds the bearing together: few rollers below the
    // ring, none kept apart.
    let (finished, started) = (finished.get(), started.get());
    println!("{finished} of {started} scenes reached their end");
    let fell_apart: u64 = ["lost_ring", "overlap"]
        .iter()
        .filter_map(|name| failed.borrow().get(*name).map(|n| u64::from(*n)))
        .sum();
    assert!(fell_apart * 25 < started, "{fell_apart} of {started} fell apart");
    assert!(
        finished * 10 >= (started - fell_apart) * 8,
        "{finished} of {started} scenes reached their end; not: {failed:#?}"
    );
}

// Two tests, which run beside each other.

#[test]
fn random_scenes_run_or_say_why_not() {
    scenes_run_or_say_why_not(0);
}

#[test]
fn more_random_scenes_run_or_say_why_not() {
    scenes_run_or_say_why_not(1);
}

#[test]
fn random_scenes_are_of_every_kind() {
    let (kinds, laws) = (Counts::default(), Counts::default());
    let result = runner(4000).run(&scene(), |scene| {
        count(&kinds, combination(&scene));
        let mut all = Vec::new();
        paths(&scene, "", &mut all);
        all.retain(|path| {
            scene.pointer(&format!("/{}", path.replace('.', "/"))).is_some_and(|v| !v.is_null())
        });
        all.into_iter().for_each(|path| count(&laws, path));
        Ok(())
    });
    report(result);
    // Three kinds of motion, three of pockets, no guide or one of five on one of two rings; rollers without a cage.
    let kinds = kinds.borrow();
    assert_eq!(kinds.len(), 3 * 3 * (1 + 5 * 2) + 1, "{kinds:#?}");
    let laws = laws.borrow();
    for path in [
        "lubricant.viscosity.constant",
        "lubricant.viscosity.walther.temperature.over_time.table",
        "lubricant.viscosity.walther.temperature.over_speed",
        "cage.mass_eccentricity",
        "cage.load.torque",
        "cage.guide.roundness",
        "cage.guide.solid.asperity_height",
        "cage.guide.film.lubricant_layer.pressure_shear",
        "cage.pocket.lubricated_cylinder.contact.self_heating",
        "cage.pocket.solid_plane.contact.friction",
        "initial.cage_speed",
    ] {
        assert!(laws.contains_key(path), "no scene has {path}");
    }
}

#[test]
fn random_scenes_survive_writing_and_reading() {
    let result = runner(200).run(&scene(), |scene| {
        let scene = Scene::from_json(&scene.to_string()).map_err(|e| TestCaseError::fail(e.to_string()))?;
        let again = Scene::from_json(&scene.to_json()).map_err(|e| TestCaseError::fail(e.to_string()))?;
        prop_assert_eq!(scene, again);
        Ok(())
    });
    report(result);
}

/// Dotted paths of everything inside a JSON value.
fn paths(value: &Value, path: &str, list: &mut Vec<String>) {
    let mut inside = |key: &str, value: &Value| {
        let path = if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
        list.push(path.clone());
        paths(value, &path, list);
    };
    match value {
        Value::Object(map) => map.iter().for_each(|(key, value)| inside(key, value)),
        Value::Array(items) => items.iter().enumerate().for_each(|(i, value)| inside(&i.to_string(), value)),
        _ => {}
    }
}
