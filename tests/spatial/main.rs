//! Balls that move in space over time: conservation, balances of forces and powers, derivatives, published motions; with a cage among them.

#[path = "../common/mod.rs"]
mod common;

mod cage;
mod conservation;
mod derivatives;
mod raceways;
mod rollers;
mod same_bits;
mod skidding;
mod steady;
mod tapered;

use cagedyn::{Model, Scene, Sim};
use common::Random;
use serde_json::{Value, json};
use std::sync::Arc;

const ANGULAR: &str = "scenes/angular_contact_218.json";
const CAGED: &str = "scenes/angular_contact_70_cage.json";
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

/// The bearing of the series 70 with a cage that touches everything: an unbalanced one, tilted, pressed to lands on both rings, in
/// these pockets; on request one that bends.
fn caged((pocket, elastic_ring): (Value, Value)) -> Arc<Model> {
    let constant = |value: f64| json!({"constant": value});
    // Films of those that bend share with their solid contact.
    let (roughness, place) =
        if elastic_ring.is_null() { (1e-6, [4e-5, 3e-5]) } else { (8e-6, [2.7e-5, 1.5e-5]) };
    let lobes = if elastic_ring.is_null() {
        json!([])
    } else {
        json!([{"order": 5, "amplitude": 3e-6, "phase": 0.4}])
    };
    let solid = json!({"contact": {
        "stiffness": 1e6, "damping": 44.4, "softening_depth": 1e-6, "friction": {"coefficient": 0.1, "transition_speed": 0.01},
    }});
    let land = |ring: &str, x: f64, radius: f64, film: Value| {
        json!({"x": x, "width": 3e-3, "guide": {
            "ring": ring, "guide_radius": radius, "diametral_clearance": 1e-4, "film": film, "solid": solid,
            "film_share": {"roughness": roughness}, "roundness": lobes,
        }})
    };
    let layer =
        json!({"lubricant_layer": {"land_width": 3e-3, "thickness": 4e-5, "pressure_shear": "with_edges"}});
    let bearing = json!({"short_bearing": {"land_width": 3e-3}});
    let space = json!({
        "transverse_inertia": 1.285e-5,
        "mass_offset_x": 1e-4,
        "lands": [land("outer_ring", -6e-3, 46.875e-3, layer), land("inner_ring", 5e-3, 42e-3, bearing)],
        "load": {"force_x": constant(0.3), "moment_y": {"sine": {"mean": 0.0, "amplitude": 1e-3, "frequency": 200.0, "phase": 0.0}}, "moment_z": constant(-2e-3)},
    });
    model(
        CAGED,
        &[
            ("inner_ring.motion", free_ring([687.0, 100.0, -200.0, 2.0, -1.0])),
            ("inner_ring.motion.space.support_damping", json!(3000.0)),
            ("outer_ring.speed", json!({"constant": -40.0})),
            ("balls.radius_deviations", json!({"groups": [{"balls": [0, 4], "deviation": 1e-6}]})),
            ("cage.pocket", pocket),
            ("cage.guide", Value::Null),
            ("cage.elastic_ring", elastic_ring),
            ("cage.space", space),
            ("cage.material", json!("phenolic")),
            ("materials.phenolic", json!({"young_modulus": 7e9, "poisson_ratio": 0.35})),
            ("cage.mass_eccentricity", json!({"y": 5e-5, "z": -3e-5})),
            ("cage.load", json!({"force_z": constant(0.2), "torque": constant(-1e-3)})),
            ("initial.cage", json!({"y": place[0], "z": place[1]})),
            ("initial.cage_space", json!({"x": 3e-5, "tilt_y": 2e-3, "tilt_z": -1e-3, "tilt_speed_z": 1.0})),
        ],
    )
}

/// The elastic ring of the cage of the series 70 with waves up to this order.
fn elastic_ring(modes: u32) -> Value {
    json!({
        "modes": modes, "neutral_radius": 45.081e-3, "stiffness": {"bending": 0.2572}, "damping": 0.03, "growth": 1.4e-11,
    })
}

/// Cages in all shapes of pockets, narrow ones, rigid and elastic.
fn cages() -> [Arc<Model>; 5] {
    let friction = json!({"coefficient": 0.1, "transition_speed": 0.01});
    let spring = json!({"stiffness": 1e6, "damping": 44.4, "softening_depth": 1e-6, "friction": friction});
    let hertz = json!({"hertz": {"damping": {"relaxation_time": 1e-6, "softening_depth": 1e-7}, "friction": friction}});
    let cylinder = json!({"solid_cylinder": {"diametral_clearance": 4e-5, "axial_clearance": 9e-5, "law": {"spring": spring}}});
    let sphere = json!({"solid_sphere": {"diametral_clearance": 2e-4, "law": hertz}});
    let plane =
        json!({"solid_plane": {"diametral_clearance": 4e-5, "axial_clearance": 5e-5, "contact": spring}});
    [
        (cylinder.clone(), Value::Null),
        (sphere, Value::Null),
        (plane.clone(), Value::Null),
        (cylinder, elastic_ring(4)),
        (plane, elastic_ring(3)),
    ]
    .map(caged)
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
