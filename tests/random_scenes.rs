//! Random scenes and random damage to a scene: nothing panics, nothing is NaN, failures say why.

mod common;

use cagedyn::{Error, Model, Recording, Scene, Sim, Status};
use common::{Random, example, example_text, set};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use serde_json::{Value, json};
use std::cell::Cell;
use std::f64::consts::PI;
use std::sync::Arc;

/// A runner that tries the same cases on every machine and writes no files.
fn runner(cases: u32) -> TestRunner {
    let config = Config { cases, failure_persistence: None, max_shrink_iters: 200, ..Config::default() };
    TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha))
}

/// Logarithmically uniform.
fn magnitude(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.ln()..high.ln()).prop_map(f64::exp)
}

/// Optional laws of a contact, each on or off.
fn contact_laws() -> impl Strategy<Value = Value> {
    let damping = proptest::option::of((magnitude(1e-8, 1e-5), magnitude(1e-10, 1e-7)));
    let friction = proptest::option::of((0.0..0.3f64, magnitude(1e-3, 0.1), magnitude(1e-8, 2e-6)));
    (damping, any::<[bool; 4]>(), friction, any::<bool>()).prop_map(
        |(damping, [film, correction, traction, heating], friction, gupta)| {
            let mut laws = json!({});
            if let Some((time, depth)) = damping {
                laws["damping"] = json!({"relaxation_time": time, "softening_depth": depth});
            }
            if film {
                laws["film"] = json!("pan_hamrock");
            }
            if film && correction {
                laws["thermal_correction"] = json!(if gupta { "gupta" } else { "ghosh_pandey" });
            }
            if film && traction {
                laws["traction"] = json!("muraki_kimura");
            }
            if film && traction && heating {
                laws["self_heating"] = json!("film_and_flash");
            }
            if let (true, Some((coefficient, speed, roughness))) = (film, friction) {
                laws["boundary_friction"] = json!({
                    "coefficient": coefficient, "transition_speed": speed, "roughness": roughness,
                    "lambda_boundary": 0.06, "lambda_full": 3.0
                });
            }
            laws
        },
    )
}

/// Constant, jumping, growing, swinging or tabulated around `size`.
fn signal(size: f64) -> impl Strategy<Value = Value> {
    (0..5, -1.0..1.0f64, -1.0..1.0f64).prop_map(move |(kind, a, b)| {
        let (a, b) = (a * size, b * size);
        match kind {
            0 => json!({"constant": a}),
            1 => json!({"step": {"before": a, "after": b, "time": 1e-4}}),
            2 => json!({"ramp": {"from": a, "to": b, "start": 2e-5, "end": 1.3e-4}}),
            3 => json!({"sine": {"mean": a, "amplitude": b, "frequency": 2e3, "phase": 0.4}}),
            _ => json!({"table": {"time": [0.0, 3e-5, 1.1e-4], "value": [a, 0.0, b]}}),
        }
    })
}

/// Roller and raceway sizes that fit: count, roller radius, outer raceway radius, clearance.
fn sizes() -> impl Strategy<Value = (u32, f64, f64, f64)> {
    (1..=40u32, magnitude(1e-3, 2e-2), 0.3..0.9f64, -1e-5..2e-4f64).prop_map(
        |(count, radius, filling, clearance)| {
            let spacing = (PI / f64::from(count.max(2))).sin();
            let pitch = (radius / (filling * spacing)).max(2.0 * radius);
            (count, radius, pitch + radius + clearance / 4.0, clearance)
        },
    )
}

/// The cage with its pocket and guide, or none, and where it starts in units of the guide clearance.
fn cage(count: u32, radius: f64, outer: f64) -> impl Strategy<Value = (Value, f64)> {
    let pitch = outer - radius;
    let free = if count == 1 { radius } else { pitch * (PI / f64::from(count)).sin() - radius };
    let pocket = (magnitude(0.002, 0.8), 0.1..1.4f64, 0.0..0.1f64, any::<bool>(), contact_laws()).prop_map(
        move |(share, half_angle, blend, friction, contact)| {
            let friction = friction.then(|| json!({"coefficient": 0.1, "transition_speed": 0.02}));
            json!({"lubricated_cylinder": {
                "radial_clearance": (share * free).min(0.05 * radius), "half_angle": half_angle,
                "edge_blend": blend, "edge_friction": friction, "contact": contact
            }})
        },
    );
    let guide = (magnitude(2e-3, 2e-2), any::<bool>(), proptest::option::of((2..9u32, -0.3..0.3f64)))
        .prop_map(move |(share, squeeze, roundness)| {
            let clearance = share * pitch;
            let roundness: Vec<Value> = roundness
                .map(|(order, a)| json!({"order": order, "amplitude": 0.5 * a * clearance, "phase": 1.0}))
                .into_iter()
                .collect();
            json!({
                "guide_radius": pitch + 0.5 * radius, "diametral_clearance": clearance, "roundness": roundness,
                "film": {"short_bearing": {"land_width": 0.1 * pitch, "squeeze": squeeze}}
            })
        });
    let parts = (proptest::option::weighted(0.8, pocket), proptest::option::weighted(0.7, guide));
    (parts, magnitude(0.01, 3.0), 0.0..0.6f64, 0..5).prop_map(
        move |((pocket, guide), mass, start, absent)| {
            let clearance = |guide: &Value| 0.5 * guide["diametral_clearance"].as_f64().unwrap();
            // The cage may start anywhere that leaves room for the rollers in its pockets.
            let room = pocket
                .as_ref()
                .map_or(f64::INFINITY, |p| p["lubricated_cylinder"]["radial_clearance"].as_f64().unwrap());
            let start = guide.as_ref().map_or(0.0, |guide| start * clearance(guide).min(room));
            let cage = json!({
                "mass": mass, "inertia": 0.9 * mass * pitch * pitch, "material": "brass",
                "pocket": pocket, "guide": guide
            });
            if absent == 0 { (Value::Null, 0.0) } else { (cage, start) }
        },
    )
}

/// Ring motion and whether it starts in equilibrium.
fn ring() -> impl Strategy<Value = (Value, &'static str)> {
    let free = (magnitude(0.1, 100.0), proptest::option::of(magnitude(10.0, 1e5)), signal(2e4), signal(2e4));
    let load = (any::<bool>(), any::<bool>());
    (free, load, 0..4, -2e-5..2e-5f64).prop_map(|((mass, damping, y, z), (loaded, balanced), fixed, x)| {
        let load = if loaded { json!({"y": y, "z": z}) } else { Value::Null };
        let motion = json!({"free": {"mass": mass, "support_damping": damping, "load": load}});
        match fixed {
            0 => (json!({"fixed": {"y": x, "z": -x}}), "centred"),
            _ => (motion, if balanced { "equilibrium" } else { "centred" }),
        }
    })
}

fn solver() -> impl Strategy<Value = Value> {
    prop_oneof![
        Just(json!({"leapfrog": {}})),
        magnitude(1e-7, 2e-6).prop_map(|step| json!({"leapfrog": {"step": step}})),
        magnitude(1e-7, 1e-3).prop_map(|tolerance| json!({"dormand_prince": {"tolerance": tolerance}})),
    ]
    .prop_map(|method| json!({"method": method, "min_step": 1e-13, "max_steps": 2_000}))
}

/// A valid scene of any kind.
fn scene() -> impl Strategy<Value = Value> {
    let bearing = sizes().prop_flat_map(|(count, radius, outer, clearance)| {
        (Just((count, radius, outer, clearance)), cage(count, radius, outer))
    });
    let raceways = (contact_laws(), proptest::option::of(proptest::option::of(magnitude(0.1, 100.0))));
    let flow = (signal(1500.0), magnitude(1e-3, 1.0), any::<bool>());
    (bearing, raceways, flow, ring(), solver(), -3.0..3.0f64).prop_map(
        |(
            (sizes, (cage, start)),
            (contact, rolling),
            (speed, viscosity, weight),
            (motion, begin),
            solver,
            angle,
        )| {
            let (count, radius, outer, clearance) = sizes;
            let mass = 7800.0 * PI * radius.powi(2) * 2.5 * radius;
            let rolling = rolling.map(|threshold| match threshold {
                None => json!({"extent": "all"}),
                Some(threshold) => json!({"extent": {"loaded": {"threshold": threshold}}}),
            });
            let mut scene = example();
            scene["title"] = json!("random");
            scene["gravity"] = if weight { scene["gravity"].take() } else { Value::Null };
            scene["lubricant"]["viscosity"] = json!({"constant": viscosity});
            scene["rollers"] = json!({
                "count": count, "radius": radius, "effective_length": 2.4 * radius, "mass": mass,
                "inertia": 0.5 * mass * radius * radius, "material": "steel"
            });
            scene["outer_ring"]["raceway_radius"] = json!(outer);
            scene["inner_ring"] = json!({
                "radial_clearance": clearance, "material": "steel", "speed": speed, "motion": motion
            });
            scene["raceways"] = json!({"contact": contact, "rolling_resistance": rolling});
            scene["cage"] = cage;
            scene["initial"] = json!({
                "inner_ring": begin, "first_roller_angle": angle,
                "cage": {"y": start * angle.cos(), "z": start * angle.sin()}
            });
            scene["solver"] = solver;
            scene["record"] = json!({"duration": 2e-4, "interval": 2e-5});
            scene
        },
    )
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

/// Runs a scene; whether it reached its end.
fn run(scene: &Value) -> Result<bool, TestCaseError> {
    let model = Model::from_json(&scene.to_string());
    let model = Arc::new(model.map_err(|e| TestCaseError::fail(format!("refused: {e}")))?);
    let names: Vec<String> = model.state_infos().into_iter().map(|info| info.name).collect();
    let mut sim = match Sim::new(model.clone()) {
        Ok(sim) => sim,
        Err(e) => {
            check_error(&e, &[Status::BadScene, Status::BadState])?;
            return Ok(false);
        }
    };
    check_finite("initial state", &names, sim.state())?;
    let mut recording = Recording::default();
    let record = &model.scene().record;
    let result = recording.run(&mut sim, record.duration, record.interval, |_| true);
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
    Ok(result.is_ok())
}

#[test]
fn random_scenes_run_or_say_why_not() {
    let (finished, started) = (Cell::new(0), Cell::new(0));
    let result = runner(300).run(&scene(), |scene| {
        started.set(started.get() + 1);
        finished.set(finished.get() + u32::from(run(&scene)?));
        Ok(())
    });
    result.unwrap_or_else(|e| panic!("{e}"));
    // Failures are an answer, but most scenes can be simulated.
    let (finished, started) = (finished.get(), started.get());
    assert!(finished * 10 >= started * 8, "{finished} of {started} scenes reached their end");
}

#[test]
fn random_scenes_survive_writing_and_reading() {
    let result = runner(100).run(&scene(), |scene| {
        let scene = Scene::from_json(&scene.to_string()).map_err(|e| TestCaseError::fail(e.to_string()))?;
        let again = Scene::from_json(&scene.to_json()).map_err(|e| TestCaseError::fail(e.to_string()))?;
        prop_assert_eq!(scene, again);
        Ok(())
    });
    result.unwrap_or_else(|e| panic!("{e}"));
}

/// Reads a text as a scene; accepted scenes must also have finite forces or a clean error at the start.
fn read(text: &str) -> Result<(), TestCaseError> {
    let model = match Model::from_json(text) {
        Ok(model) => Arc::new(model),
        Err(e) => return check_error(&e, &[Status::BadJson, Status::BadScene]),
    };
    match Sim::new(model) {
        Ok(mut sim) => {
            prop_assert!(sim.state().iter().all(|x| x.is_finite()));
            let mut out = vec![0.0; sim.channels().len()];
            let names: Vec<String> = sim.channels().iter().map(|channel| channel.name.clone()).collect();
            match sim.outputs(&mut out) {
                Ok(()) => check_finite("outputs", &names, &out),
                Err(e) => check_error(&e, &[Status::BadState]),
            }
        }
        Err(e) => check_error(&e, &[Status::BadScene, Status::BadState]),
    }
}

/// Deletes, doubles or alters up to three characters.
fn damaged_text(seed: u64) -> String {
    let mut random = Random::new(seed);
    let mut text: Vec<char> = example_text().chars().collect();
    for _ in 0..=random.index(3) {
        let i = random.index(text.len());
        let any = |random: &mut Random| {
            let usual: Vec<char> = "0123456789.,:;eE+-{}[]\"\\ ntfu\n\0\u{e9}\u{1f600}".chars().collect();
            usual[random.index(usual.len())]
        };
        match random.index(5) {
            0 => drop(text.remove(i)),
            1 => text.insert(i, text[i]),
            2 => text[i] = any(&mut random),
            3 => text.insert(i, any(&mut random)),
            _ => {
                let end = (i + 1 + random.index(40)).min(text.len());
                let piece: Vec<char> = text[i..end].to_vec();
                if random.chance(0.5) {
                    text.splice(i..i, piece);
                } else {
                    text.drain(i..end);
                }
            }
        }
    }
    text.into_iter().collect()
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

/// The example with up to three values replaced by other values.
fn damaged_values(seed: u64) -> String {
    let mut random = Random::new(seed);
    let mut scene = example();
    for _ in 0..=random.index(3) {
        let mut all = Vec::new();
        paths(&scene, "", &mut all);
        let path = &all[random.index(all.len())];
        let old = scene.pointer(&format!("/{}", path.replace('.', "/"))).cloned().unwrap_or(Value::Null);
        let other = &all[random.index(all.len())];
        let swapped = scene.pointer(&format!("/{}", other.replace('.', "/"))).cloned().unwrap_or(Value::Null);
        let new = match (random.index(8), old.as_f64()) {
            (0, _) => Value::Null,
            (1, _) => swapped,
            (2, _) => json!([old]),
            (3, Some(x)) => json!(-x),
            (4, Some(x)) => json!(x * 10f64.powf(random.around_zero(12.0))),
            (5, Some(_)) => {
                let odd = [0.0, -0.0, f64::MIN_POSITIVE, 5e-324, f64::MAX, f64::EPSILON, 1e18, -1e300];
                json!(odd[random.index(odd.len())])
            }
            (6, Some(x)) => json!(x * random.within(0.2, 3.0)),
            (_, Some(x)) => json!(x.to_string()),
            _ => json!("steel"),
        };
        set(&mut scene, path, new);
    }
    scene.to_string()
}

#[test]
fn damaged_texts_never_panic() {
    let result = runner(3000).run(&any::<u64>().prop_map(damaged_text), |text| read(&text));
    result.unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn damaged_values_never_panic() {
    let result = runner(3000).run(&any::<u64>().prop_map(damaged_values), |text| read(&text));
    result.unwrap_or_else(|e| panic!("{e}"));
}
