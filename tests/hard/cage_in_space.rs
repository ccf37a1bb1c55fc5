//! Hard cases of a cage that tilts and shifts among balls that move.

use crate::common::{read, with};
use crate::{Case, change_state};
use cagedyn::Sim;
use serde_json::{Value, json};

const SCENE: &str = "scenes/angular_contact_70_cage.json";
const SPEED: &str = "inner_ring.speed";
const TRANSVERSE: &str = "cage.space.transverse_inertia";
/// Polar moment of inertia of the cage of the scene, kg m^2.
const POLAR: f64 = 2.511e-5;
/// Speed of its inner ring, rad/s, and of its cage without slip.
const RING_SPEED: f64 = 314.1592653589793;
const CAGE_SPEED: f64 = 142.0;

fn scene_with(others: &[(&str, Value)]) -> Value {
    let scene: Value = serde_json::from_str(&read(SCENE)).expect("the scene is JSON");
    with(&scene, others)
}

/// Lands like that of the scene, of this width (m), at these places along the axis (m) in the place of the one in the middle, with
/// a layer of this thickness (m).
fn lands(places: &[f64], width: f64, layer: f64) -> [(&'static str, Value); 2] {
    let mut guide = scene_with(&[])["cage"]["guide"].clone();
    guide["film"]["lubricant_layer"]["land_width"] = json!(width);
    guide["film"]["lubricant_layer"]["thickness"] = json!(layer);
    let lands: Vec<Value> = places.iter().map(|x| json!({"x": x, "slices": 5, "guide": guide})).collect();
    [("cage.guide", Value::Null), ("cage.space.lands", json!(lands))]
}

/// Plane walls, along the axis too.
fn box_of(around: f64, along: f64) -> (&'static str, Value) {
    let contact = scene_with(&[])["cage"]["pocket"]["solid_cylinder"]["law"]["spring"].clone();
    let walls = json!({"diametral_clearance": around, "axial_clearance": along, "contact": contact});
    ("cage.pocket", json!({ "solid_plane": walls }))
}

/// The cage flies along its axis at 1 m/s while it leads the balls: they meet two walls of their pockets at once.
fn into_the_corner(sim: &mut Sim) {
    change_state(sim, 0.0, |name, x| match name {
        "cage.vx" => *x = 1.0,
        "cage.speed" => *x += 20.0,
        _ => {}
    });
}

/// All of them.
pub fn cases() -> Vec<Case> {
    let case = |name, why, scene, milliseconds: f64| Case::new(name, why, scene, 1e-3 * milliseconds);
    let two = lands(&[-5e-3, 5e-3], 2e-3, 80e-6);
    let ramp =
        |from: f64, to: f64| (SPEED, json!({"ramp": {"from": from, "to": to, "start": 2e-3, "end": 12e-3}}));
    // Nutation of a cage that nothing holds: a moment that turns as fast finds no resistance.
    let nutation = CAGE_SPEED * POLAR / 1.285e-5 / std::f64::consts::TAU;
    let swing =
        |phase: f64| json!({"sine": {"mean": 0.0, "amplitude": 2e-3, "frequency": nutation, "phase": phase}});
    vec![
        case(
            "one land far from the middle",
            "every force of the guide tilts the cage",
            scene_with(&lands(&[9e-3], 4e-3, 80e-6)),
            20.0,
        ),
        case(
            "pocket wider than the guide",
            "balls never hold the cage before the guide does",
            scene_with(&[("cage.pocket.solid_cylinder.diametral_clearance", json!(1.8e-3))]),
            20.0,
        ),
        case(
            "balls into the corner of their pockets",
            "two plane walls are met at once, at 1 m/s along the axis",
            scene_with(&[box_of(0.3e-3, 0.3e-3)]),
            10.0,
        )
        .from(into_the_corner),
        case(
            "cage that starts tilted to its stop",
            "both lands touch with their edges, on opposite sides",
            with(&scene_with(&two), &[("initial.cage_space", json!({"tilt_y": 0.0355}))]),
            10.0,
        ),
        case(
            "cage like a disc",
            "the least inertia across its axis that a body has: it precesses twice as fast as it spins",
            scene_with(&[(TRANSVERSE, json!(0.5 * POLAR))]),
            10.0,
        ),
        case(
            "balls without load",
            "nothing but their weight and the cage moves them",
            scene_with(&[
                ("inner_ring.motion", json!({"space": {"x": {"held": -20e-6}}})),
                ("initial.inner_ring", json!("centred")),
            ]),
            10.0,
        ),
        case(
            "balls and cage from rest",
            "films and friction of every contact begin at speed zero",
            scene_with(&[ramp(0.0, RING_SPEED)]),
            15.0,
        ),
        case(
            "reversal among balls",
            "balls skid, and the cage goes on against them",
            scene_with(&[ramp(RING_SPEED, -RING_SPEED)]),
            15.0,
        ),
        case(
            "resonance of the tilt",
            "a moment turns with the nutation of the cage and drives it to its stops",
            with(
                &scene_with(&two),
                &[(
                    "cage.space.load",
                    json!({"moment_y": swing(0.0), "moment_z": swing(-0.5 * std::f64::consts::PI)}),
                )],
            ),
            30.0,
        ),
        case(
            "land that dries",
            "a layer of 5 um in a gap of 0.2 mm: lands leave their film and come back at every wobble",
            scene_with(&lands(&[-5e-3, 5e-3], 2e-3, 5e-6)),
            20.0,
        ),
    ]
}
