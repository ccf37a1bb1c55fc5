//! Bearings without friction and damping: every law that can be left out is left out.

use crate::common::{example, read, with};
use cagedyn::{Model, Sim};
use serde_json::{Value, json};
use std::sync::Arc;

/// A bearing and how long it is followed.
pub struct Case {
    pub name: &'static str,
    pub scene: Value,
    pub duration: f64,
    /// Whether only forces through the bearing axis and between the bodies act.
    pub isolated: bool,
}

const NONE: Value = Value::Null;

fn earth() -> Value {
    json!({"y": 0.0, "z": -9.80665})
}

fn unbalance() -> Value {
    json!({"y": 50e-6, "z": -20e-6})
}

/// A cage that only the spring of its guide holds.
pub fn sprung(changes: &[(&str, Value)]) -> Value {
    let scene: Value = serde_json::from_str(&read("scenes/grease_guide.json")).expect("a scene");
    let start = json!({
        "cage": {"y": 0.15e-3, "z": -0.05e-3}, "cage_velocity": {"y": 0.3, "z": 0.2}, "cage_speed": 142.5
    });
    let dry = [
        ("gravity", NONE),
        ("cage.pocket", NONE),
        ("cage.guide.film", NONE),
        ("cage.guide.film_share", NONE),
        ("cage.guide.solid", json!({"contact": {"stiffness": 1e6}})),
        ("initial", start),
    ];
    with(&with(&scene, &dry), changes)
}

/// Rollers between the raceways of a fixed outer and a free inner ring, which turns at a given speed.
fn bare(changes: &[(&str, Value)]) -> Value {
    let bare = [
        ("raceways", json!({})),
        ("lubricant", NONE),
        ("cage", NONE),
        ("gravity", NONE),
        ("inner_ring.motion", json!({"free": {"mass": 3.0}})),
        ("initial", json!({})),
    ];
    with(&with(&example(), &bare), changes)
}

/// The ring under load, dropped through its clearance.
fn load() -> Value {
    json!({"free": {"mass": 3.0, "load": {"y": {"constant": 800.0}, "z": {"constant": -4900.0}}}})
}

fn plane() -> Value {
    json!({"solid_plane": {"diametral_clearance": 0.3e-3, "contact": {"stiffness": 1e7}}})
}

fn cylinder() -> Value {
    json!({"lubricated_cylinder": {"radial_clearance": 0.15e-3, "half_angle": 0.43, "edge_blend": 0.0}})
}

/// An unbalanced cage that lags behind the rollers and meets pockets and guide.
fn caged(pocket: Value, ring: &str, changes: &[(&str, Value)]) -> Value {
    let radius = if ring == "inner_ring" { 35e-3 } else { 45e-3 };
    let guide = json!({
        "ring": ring, "guide_radius": radius, "diametral_clearance": 0.445e-3,
        "solid": {"contact": {"stiffness": 1e7}}
    });
    let cage = json!({
        "mass": 0.37, "inertia": 6.311e-4, "material": "brass", "mass_eccentricity": unbalance(),
        "pocket": pocket, "guide": guide
    });
    let start = json!({
        "cage": {"y": 0.05e-3, "z": -0.03e-3}, "cage_velocity": {"y": 0.3, "z": 0.2}, "cage_speed": -100.0
    });
    with(&bare(&[("cage", cage), ("initial", start)]), changes)
}

/// Bearings whose contacts open and close all the time.
pub fn contacts() -> Vec<Case> {
    let weight = [("gravity", earth()), ("inner_ring.motion", load())];
    let pushed = json!({
        "force_y": {"constant": 3.0}, "force_z": {"constant": -2.0}, "torque": {"constant": 0.0}
    });
    let cage_load = [("gravity", earth()), ("cage.mass_eccentricity", unbalance()), ("cage.load", pushed)];
    let case = |name, isolated, duration, scene| Case { name, scene, duration, isolated };
    vec![
        case("cage", true, 20e-3, sprung(&[])),
        case("unbalanced cage", true, 20e-3, sprung(&[("cage.mass_eccentricity", unbalance())])),
        case("loaded cage", false, 20e-3, sprung(&cage_load)),
        case("rollers under load", false, 5e-3, bare(&weight)),
        case("plane pockets", true, 5e-3, caged(plane(), "outer_ring", &[])),
        case("plane pockets under load", false, 5e-3, caged(plane(), "inner_ring", &weight)),
        case("cylinder pockets", true, 5e-3, caged(cylinder(), "inner_ring", &[])),
        case("cylinder pockets under load", false, 5e-3, caged(cylinder(), "outer_ring", &weight)),
    ]
}

/// Bearings whose contacts never open: their motion is smooth.
pub fn pressed() -> Vec<Case> {
    let heavy = [
        ("gravity", json!({"y": 0.0, "z": -981.0})),
        ("initial", json!({"cage": {"y": 30e-6, "z": -0.22e-3}})),
    ];
    let push = json!({"free": {"mass": 3.0, "load": {"y": {"constant": 0.0}, "z": {"constant": -2000.0}}}});
    let preload = [("inner_ring.radial_clearance", json!(-10e-6)), ("inner_ring.motion", push)];
    let case = |name, duration, scene| Case { name, scene, duration, isolated: false };
    vec![
        case("cage pressed onto its guide", 20e-3, sprung(&heavy)),
        case("preloaded rollers", 5e-3, bare(&preload)),
    ]
}

/// A cage that meets nothing: in a wide guide, with room for the pull of the earth.
pub fn flying(changes: &[(&str, Value)]) -> Value {
    let start = json!({
        "cage": {"y": -0.5e-3, "z": -1.5e-3}, "cage_velocity": {"y": 0.02, "z": 0.25}, "cage_speed": 142.5
    });
    let wide = [("cage.guide.diametral_clearance", json!(4.6e-3)), ("gravity", earth()), ("initial", start)];
    with(&sprung(&wide), changes)
}

pub fn simulate(scene: &Value, solver: &Value) -> Sim {
    let scene = with(scene, &[("solver", solver.clone())]);
    let model = Model::from_json(&scene.to_string()).unwrap_or_else(|e| panic!("{e}"));
    Sim::new(Arc::new(model)).unwrap_or_else(|e| panic!("{e}"))
}

pub fn leapfrog(step: f64) -> Value {
    json!({"method": {"leapfrog": {"step": step}}})
}

/// The methods with error control at a tolerance.
pub fn controlled(tolerance: f64) -> [(&'static str, Value); 3] {
    ["dormand_prince", "rosenbrock", "auto"]
        .map(|method| (method, json!({"method": {method: {"tolerance": tolerance}}})))
}
