//! Balls that move in space over time: conservation, balances of forces and powers, derivatives, published motions.

#[path = "../common/mod.rs"]
mod common;

mod conservation;
mod derivatives;
mod raceways;
mod same_bits;
mod skidding;
mod steady;

use cagedyn::{Model, Scene, Sim};
use common::Random;
use serde_json::{Value, json};
use std::sync::Arc;

const ANGULAR: &str = "scenes/angular_contact_218.json";
const DEEP: &str = "scenes/deep_groove_6206.json";

/// A scene with changes.
fn model(file: &str, changes: &[(&str, Value)]) -> Arc<Model> {
    let text = common::read(file);
    let texts: Vec<(&str, String)> = changes.iter().map(|(path, value)| (*path, value.to_string())).collect();
    let scene = Scene::from_json_with(&text, texts.iter().map(|(path, value)| (*path, value.as_str())));
    Arc::new(Model::new(scene.expect("a scene")).expect("a model"))
}

/// A ring that is free in all coordinates under these loads, with everything that motion needs.
fn free_ring([x, y, z, moment_y, moment_z]: [f64; 5]) -> Value {
    let constant = |value: f64| json!({"constant": value});
    json!({"space": {
        "x": "free", "y": "free", "z": "free", "tilt_y": "free", "tilt_z": "free",
        "mass": 2.0, "inertia": {"polar": 4e-3, "transverse": 3e-3},
        "load": {
            "x": constant(x), "y": constant(y), "z": constant(z),
            "moment_y": constant(moment_y), "moment_z": constant(moment_z),
        },
    }})
}

/// The 218 at speed with a ring that is free, all effects, gravity, supports, and waves on both races.
fn everything() -> Arc<Model> {
    with_everything(&[])
}

/// The same with a ring that is moved along y and tilted about z, whatever force that takes.
fn driven() -> Arc<Model> {
    let sine = |mean: f64, amplitude: f64, frequency: f64| json!({"prescribed": {"sine": {"mean": mean, "amplitude": amplitude, "frequency": frequency, "phase": 0.4}}});
    with_everything(&[
        ("inner_ring.motion.space.y", sine(1e-5, 1e-5, 300.0)),
        ("inner_ring.motion.space.tilt_z", sine(1e-3, 1e-3, 200.0)),
    ])
}

fn with_everything(changes: &[(&str, Value)]) -> Arc<Model> {
    let ring = free_ring([17.8e3, 3e3, -6e3, 60.0, -90.0]);
    let wave = |order: u32, amplitude: f64, phase: f64| json!({"order": order, "amplitude": amplitude, "phase": phase});
    let all = [
        ("inner_ring.motion", ring),
        ("inner_ring.waviness", json!([wave(16, 1e-6, 0.3), wave(3, -2e-6, 1.0)])),
        ("outer_ring.waviness", json!([wave(25, 5e-7, -0.7), wave(2, 3e-6, 0.0)])),
        ("inner_ring.motion.space.support_damping", json!(800.0)),
        ("inner_ring.motion.space.tilt_damping", json!(2.0)),
        ("inner_ring.motion.space.preload", json!({"force": 500.0, "stiffness": 1e6})),
        ("inner_ring.speed", json!({"constant": 900.0})),
        ("outer_ring.speed", json!({"constant": -40.0})),
        ("balls.drag", json!({"density": 40.0})),
        ("gravity", json!({"y": 1.0, "z": -9.8})),
        ("balls.radius_deviations", json!({"groups": [{"balls": [0, 4], "deviation": 1e-6}]})),
        ("initial", json!({"inner_ring": "equilibrium"})),
    ];
    model(ANGULAR, &[&all[..], changes].concat())
}

/// States near the start: positions and velocities off by so many of their scales.
fn states(sim: &Sim, count: usize, spread: f64, seed: u64) -> Vec<Vec<f64>> {
    let mut random = Random::new(seed);
    let (start, scales) = (sim.state().to_vec(), sim.model().state_scales());
    let off = |random: &mut Random| {
        start.iter().zip(&scales).map(|(x, scale)| x + spread * scale * random.within(-1.0, 1.0)).collect()
    };
    (0..count).map(|_| off(&mut random)).collect()
}
