//! Numbers at the ends of what doubles and scenes allow, and tolerances from the loosest to the tightest.

use crate::case;
use crate::common::{read, set};
use cagedyn::{Model, Sim, Status};
use serde_json::{Value, json};
use std::sync::Arc;

const SCENES: [&str; 4] = ["nu2310", "nu2310_grease", "grease_guide", "ball_short_bearing"];
/// Wall time of one run, s; none comes near it.
const WALL_TIME: f64 = 20.0;

fn scene(name: &str) -> Value {
    serde_json::from_str(&read(&format!("scenes/{name}.json"))).expect("the scene is JSON")
}

/// Dotted paths of all numbers.
fn numbers(value: &Value, path: &str, list: &mut Vec<String>) {
    let mut inside = |key: &str, value: &Value| {
        let path = if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
        numbers(value, &path, list);
    };
    match value {
        Value::Object(map) => map.iter().for_each(|(key, value)| inside(key, value)),
        Value::Array(items) => items.iter().enumerate().for_each(|(i, value)| inside(&i.to_string(), value)),
        Value::Number(_) => list.push(path.to_owned()),
        _ => {}
    }
}

/// Runs a scene for some steps. Refused or not, it says why; accepted, all its numbers stay finite. The message of refusal.
fn survive(scene: &Value, what: &str) -> Option<String> {
    let fine = |e: &cagedyn::Error, allowed: &[Status]| {
        assert!(allowed.contains(&e.status), "{what}: {:?} {e}", e.status);
        assert!(!e.message.is_empty() && !e.message.contains('\n'), "{what}: {e}");
    };
    let sim = Model::from_json(&scene.to_string()).and_then(|model| Sim::new(Arc::new(model)));
    let mut sim = match sim {
        Ok(sim) => sim,
        Err(e) => {
            fine(&e, &[Status::BadScene, Status::BadJson, Status::BadState]);
            return Some(e.message);
        }
    };
    sim.set_wall_time_limit(WALL_TIME).expect("a limit");
    let result = sim.advance_to(20e-6);
    if let Err(e) = &result {
        fine(e, &[Status::BadState, Status::StepTooSmall, Status::TooManySteps]);
    }
    assert!(sim.state().iter().all(|x| x.is_finite()), "{what}: {:?}", sim.state());
    let mut out = vec![0.0; sim.channels().len()];
    match sim.outputs(&mut out) {
        Ok(()) => assert!(out.iter().all(|x| x.is_finite()), "{what}: {out:?}"),
        Err(e) => fine(&e, &[Status::BadState]),
    }
    None
}

#[test]
fn any_field_may_have_any_number() {
    let tiny = [0.0, -0.0, 5e-324, -5e-324, 1e-310, 1e-300, -1e-300];
    let huge = [1e300, -1e300, f64::MAX, f64::MIN];
    for name in SCENES {
        let scene = scene(name);
        let mut paths = Vec::new();
        numbers(&scene, "", &mut paths);
        assert!(paths.len() > 20, "{paths:?}");
        for path in &paths {
            for x in tiny.into_iter().chain(huge) {
                let mut changed = scene.clone();
                set(&mut changed, path, json!(x));
                let refused = survive(&changed, &format!("{name}: {path} = {x:e}"));
                if let (Some(message), true) = (&refused, x.abs() > 1e299) {
                    let place = path.rsplit_once('.').map_or(path.as_str(), |(place, _)| place);
                    assert!(message.contains(place), "{name}: {path} = {x:e}: {message}");
                }
            }
        }
    }
}

/// The ends of the range that a message of refusal names.
fn range(message: &str) -> Option<[f64; 2]> {
    let mut words = message.split("is not within ").nth(1)?.split(' ');
    let low = words.next()?.parse().ok()?;
    let high = words.nth(1)?.parse().ok()?;
    Some([low, high])
}

#[test]
fn both_ends_of_every_range_run_or_say_why_not() {
    let mut ends = 0;
    for name in SCENES {
        let scene = scene(name);
        let mut paths = Vec::new();
        numbers(&scene, "", &mut paths);
        for path in &paths {
            let mut changed = scene.clone();
            let integer = scene.pointer(&format!("/{}", path.replace('.', "/"))).is_some_and(Value::is_u64);
            set(&mut changed, path, if integer { json!(u32::MAX) } else { json!(1e300) });
            let Some(range) = survive(&changed, path).as_deref().and_then(range) else { continue };
            for x in range {
                set(&mut changed, path, if integer { json!(x as u32) } else { json!(x) });
                let refused = survive(&changed, &format!("{name}: {path} = {x:e}"));
                // Other fields may forbid it, but its own range includes it.
                let own =
                    |message: &str| message.starts_with(path.as_str()) && self::range(message) == Some(range);
                assert!(!refused.as_deref().is_some_and(own), "{name}: {path} = {x:e}: {refused:?}");
                ends += 1;
            }
        }
    }
    assert!(ends > 200, "{ends}");
}

#[test]
fn tolerances_from_loose_to_tight() {
    let methods = ["auto", "dormand_prince", "adams", "rosenbrock", "radau"];
    for (name, duration) in [("grease_guide", 2e-3), ("nu2310", 0.3e-3)] {
        for method in methods {
            let end = |tolerance: f64| {
                let mut scene = scene(name);
                scene["solver"] = json!({"method": {method: {"tolerance": tolerance}}});
                let model = Model::from_json(&scene.to_string()).expect("a scene");
                let mut sim = Sim::new(Arc::new(model)).expect("a simulation");
                sim.set_wall_time_limit(WALL_TIME).expect("a limit");
                let scales = sim.model().state_scales();
                sim.advance_to(duration).unwrap_or_else(|e| panic!("{name}, {method}, {tolerance:e}: {e}"));
                sim.state().iter().zip(&scales).map(|(x, scale)| x / scale).collect::<Vec<f64>>()
            };
            let exact = end(1e-13);
            let error = |tolerance: f64| {
                let found = end(tolerance);
                found.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
            };
            let errors = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12].map(|t| (t, error(t)));
            println!("{name}, {method}: {errors:?}");
            for (tolerance, error) in errors {
                assert!(error < 1e4 * tolerance, "{name}, {method}, {tolerance:e}: {error:e}");
            }
        }
    }
}

#[test]
fn angles_keep_their_digits() {
    // The same bearing, a minute and more than a thousand revolutions later.
    let [early, late] = ["unchanged", "after a minute"].map(|which| {
        let mut sim = case("after a minute").sim(&json!({}), 0.0);
        let mut state = sim.state().to_vec();
        if which == "unchanged" {
            let infos = sim.model().state_infos();
            let turned = state[infos.iter().position(|i| i.name == "cage.angle").expect("a cage")];
            for (x, info) in state.iter_mut().zip(&infos) {
                if info.name == "cage.angle" || info.name.ends_with("orbit_travel") {
                    *x -= turned;
                }
            }
        }
        let mut rate = vec![0.0; state.len()];
        sim.derivative(0.0, &state, &mut rate).expect("forces");
        rate
    });
    let largest = early.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    for (a, b) in early.iter().zip(&late) {
        assert!((a - b).abs() < 1e-6 * largest, "{a} {b} of {largest}");
    }
}
