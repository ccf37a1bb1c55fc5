//! Random damage to the examples: nothing panics, failures say why.

use crate::common::{Random, example_text, read as read_file, set};
use crate::{check_error, check_finite, paths, runner};
use cagedyn::{Model, Scene, Sim, Status};
use proptest::prelude::*;
use serde_json::{Value, json};
use std::sync::Arc;

/// Reads a text as a scene; accepted scenes must also have finite forces or a clean error at the start.
fn read(text: &str) -> Result<(), TestCaseError> {
    let model = match Model::from_json(text) {
        Ok(model) => Arc::new(model),
        Err(e) => {
            let problems = Scene::check(text);
            prop_assert!(!problems.is_empty() && problems.iter().all(|problem| problem.line >= 1), "{}", e);
            return check_error(&e, &[Status::BadJson, Status::BadScene]);
        }
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

/// The text of one of the examples.
fn some_example(random: &mut Random) -> String {
    match random.index(6) {
        0..=2 => example_text(),
        3 | 4 => read_file("scenes/grease_guide.json"),
        _ => read_file("scenes/nu2310_space.json"),
    }
}

/// Deletes, doubles or alters up to three characters.
fn damaged_text(seed: u64) -> String {
    let mut random = Random::new(seed);
    let mut text: Vec<char> = some_example(&mut random).chars().collect();
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

/// An example with up to three values replaced by other values.
fn damaged_values(seed: u64) -> String {
    let mut random = Random::new(seed);
    let mut scene: Value = serde_json::from_str(&some_example(&mut random)).expect("an example is JSON");
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
