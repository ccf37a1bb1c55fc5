//! Hard cases of the greased cage guide.

use crate::common::{read, with};
use crate::{Case, change_state};
use cagedyn::Sim;
use serde_json::{Value, json};
use std::f64::consts::PI;

const LAYER: &str = "cage.guide.film.lubricant_layer.thickness";
const GUIDE_SOLID: &str = "cage.guide.solid.contact";
/// Radial clearance of the scene, m.
const CLEARANCE: f64 = 0.2135e-3;

fn scene_with(others: &[(&str, Value)]) -> Value {
    let scene: Value = serde_json::from_str(&read("scenes/grease_guide.json")).expect("the scene is JSON");
    with(&scene, others)
}

/// The cage at a distance below the centre (m), moving down (m/s).
fn start(depth: f64, speed: f64, others: &[(&str, Value)]) -> Value {
    let scene = scene_with(&[
        ("initial.cage", json!({"y": 0.0, "z": -depth})),
        ("initial.cage_velocity", json!({"y": 0.0, "z": -speed})),
    ]);
    with(&scene, others)
}

/// Puts the cage 1 mm deep into the ring.
fn deep(sim: &mut Sim) {
    change_state(sim, 0.0, |name, x| {
        if name == "cage.z" {
            *x = -(CLEARANCE + 1e-3);
        }
    });
}

/// All of them.
pub fn cases() -> Vec<Case> {
    let case = |name, why, scene, milliseconds: f64| Case::new(name, why, scene, 1e-3 * milliseconds);
    let speed = |rpm: f64| ("inner_ring.speed", json!({ "constant": rpm * PI / 30.0 }));
    let temperature =
        |kelvin: f64| ("lubricant.viscosity.walther.temperature.over_time.constant", json!(kelvin));
    let close = |distance: f64, speed: f64| start(CLEARANCE + distance, speed, &[]);
    vec![
        case("impact at 1 m/s", "the film stops the cage within 80 um", start(0.1e-3, 1.0, &[]), 10.0),
        case(
            "impact at 3 m/s on 5 um",
            "film and solid take the impact together",
            start(0.1e-3, 3.0, &[(LAYER, json!(5e-6))]),
            10.0,
        ),
        case("start 5 um deep", "the surfaces overlap at the start", close(5e-6, 0.0), 10.0),
        case("start 1 nm apart, approaching", "the film ends within a step", close(-1e-9, 0.1), 10.0),
        case("start 1 nm apart, receding", "the film begins within a step", close(-1e-9, -0.1), 10.0),
        case("start 1 nm deep, approaching", "where the film has just gone", close(1e-9, 0.1), 10.0),
        case("start 1 nm deep, receding", "where the film will come", close(1e-9, -0.1), 10.0),
        case(
            "pressure far above the cap",
            "viscosity grows without limit but for the cap",
            start(0.15e-3, 5.0, &[("lubricant.pressure_viscosity", json!(2e-7))]),
            5.0,
        ),
        case(
            "film from 10 nm",
            "decay rates of 1e11 1/s",
            start(
                CLEARANCE - 1e-8,
                0.0,
                &[("cage.guide.film_share", Value::Null), ("cage.guide.solid", Value::Null)],
            ),
            10.0,
        ),
        case(
            "rough surfaces",
            "film and solid share the force over a third of the clearance",
            scene_with(&[("cage.guide.film_share.roughness", json!(0.02e-3))]),
            20.0,
        ),
        case(
            "cage spin zero at the start",
            "the elements drag the cage up",
            scene_with(&[("initial.cage_speed", json!(0.0))]),
            20.0,
        ),
        case(
            "cage spin doubled at the start",
            "the cage drives the elements",
            scene_with(&[("initial.cage_speed", json!(285.0))]),
            20.0,
        ),
        case(
            "stiffness 1e9 N/m",
            "contacts of a microsecond",
            scene_with(&[
                (&format!("{GUIDE_SOLID}.stiffness"), json!(1e9)),
                ("cage.pocket.solid_plane.contact.stiffness", json!(1e9)),
            ]),
            10.0,
        ),
        case(
            "rolling with stick",
            "friction locks within 0.1 mm/s",
            scene_with(&[
                ("cage.guide.film", Value::Null),
                ("cage.guide.film_share", Value::Null),
                (&format!("{GUIDE_SOLID}.stiffness"), json!(1e8)),
                (&format!("{GUIDE_SOLID}.friction.transition_speed"), json!(1e-4)),
            ]),
            20.0,
        ),
        case(
            "8000 rpm at 273 K",
            "thick grease at high speed",
            scene_with(&[speed(8000.0), temperature(273.15)]),
            20.0,
        ),
        case(
            "fully flooded",
            "the layer fills the whole clearance",
            scene_with(&[(LAYER, json!(0.5e-3))]),
            20.0,
        ),
        case("0 rpm", "nothing turns", scene_with(&[speed(0.0), ("initial.cage_speed", json!(0.0))]), 20.0),
        case(
            "centred without gravity",
            "nothing may push it off the centre",
            scene_with(&[("gravity", json!({"y": 0.0, "z": 0.0}))]),
            20.0,
        ),
        case(
            "nine balls touching",
            "the cage is driven against many balls at once",
            scene_with(&[
                ("kinematic_elements.count", json!(9)),
                ("cage.pocket.solid_plane.diametral_clearance", json!(20e-6)),
            ]),
            20.0,
        ),
        case("start 1 mm deep", "solid bodies overlap by five clearances", scene_with(&[]), 10.0).from(deep),
        case(
            "film up to first touch",
            "film and solid change places at once",
            scene_with(&[("cage.guide.film_share.touching_ratio", json!(0.0))]),
            20.0,
        ),
        case(
            "narrow dry pockets",
            "up to nine balls strike at once, with more friction than the guide has",
            scene_with(&[
                ("cage.guide.film", Value::Null),
                ("cage.guide.film_share", Value::Null),
                ("cage.guide.solid.asperity_height", json!(3e-6)),
                ("cage.pocket.solid_plane.diametral_clearance", json!(0.3e-3)),
                ("cage.pocket.solid_plane.contact.friction.coefficient", json!(0.6)),
            ]),
            40.0,
        ),
        case(
            "literal Voigt",
            "the damper jumps in at first touch",
            scene_with(&[
                (&format!("{GUIDE_SOLID}.softening_depth"), json!(0.0)),
                ("cage.pocket.solid_plane.contact.softening_depth", json!(0.0)),
            ]),
            20.0,
        ),
    ]
}
