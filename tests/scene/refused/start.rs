//! Start of the cage.

use super::table::*;
use serde_json::{Value, json};

pub fn rows() -> Vec<Row> {
    let bare = || rollers().with(&[("cage", Value::Null)]);
    let off = |y: f64| json!({"y": y, "z": 0.0});
    let no_cage = &["there is no cage to place"];
    let on_inner_ring = grease().with(&[
        ("cage.guide.ring", json!("inner_ring")),
        ("cage.guide.guide_radius", json!(40e-3)),
        ("cage.guide.solid", Value::Null),
        ("cage.guide.film_share", Value::Null),
        ("inner_ring.motion", json!({"fixed": {"y": 1e-4, "z": 0.0}})),
    ]);
    vec![
        grease().scene(
            "start that pushes elements through their pockets",
            &[("cage.guide", Value::Null), ("initial.cage", off(9e-3))],
            "initial.cage",
            &["0.009 m", "pockets of 0.0002775 m"],
        ),
        bare().scene("start of no cage", &[("initial.cage", off(1e-5))], "initial.cage", no_cage),
        bare().scene(
            "velocity of no cage",
            &[("initial.cage_velocity", off(0.1))],
            "initial.cage_velocity",
            no_cage,
        ),
        bare().scene(
            "speed of no cage",
            &[("initial.cage_speed", json!(0.0))],
            "initial.cage_speed",
            no_cage,
        ),
        grease().scene(
            "cage velocity in mm/s",
            &[("initial.cage_velocity", off(200.0))],
            "initial.cage_velocity.y",
            &["200.0 m/s", "milli"],
        ),
        grease().scene(
            "cage velocity upwards beyond any",
            &[("initial.cage_velocity", json!({"y": 0.0, "z": -101.0}))],
            "initial.cage_velocity.z",
            &["-101.0 m/s", "-100 to 100 m/s"],
        ),
        grease().value(
            "cage speed in rpm",
            "initial.cage_speed",
            json!(-136_000),
            &["-136000.0 rad/s", "revolutions per minute"],
        ),
        grease().json(
            "signal for a cage speed",
            "initial.cage_speed",
            json!({"constant": 1.0}),
            "initial.cage_speed",
            &["expected a number"],
        ),
        grease().json(
            "text for a cage speed",
            "initial.cage_speed",
            json!("orbit"),
            "initial.cage_speed",
            &["orbit"],
        ),
        grease().json(
            "cage velocity as a number",
            "initial.cage_velocity",
            json!(0.1),
            "initial.cage_velocity",
            &["0.1"],
        ),
        grease().json(
            "cage velocity without z",
            "initial.cage_velocity",
            json!({"y": 0.1}),
            "initial.cage_velocity",
            &["missing field `z`"],
        ),
        grease().json("cage start of a number", "initial.cage", json!(1e-5), "initial.cage", &["an object"]),
        grease().json(
            "unknown field in the start",
            "initial.cage_angle",
            json!(0.1),
            "initial.cage_angle",
            &["unknown field `cage_angle`", "`cage_speed`"],
        ),
        grease().scene(
            "greased cage start in mm",
            &[("initial.cage", off(0.1))],
            "initial.cage.y",
            &["0.1 m", "milli"],
        ),
        grease().scene(
            "cage starts beyond its ring",
            &[("initial.cage", off(4.28e-4))],
            "initial.cage",
            &["4.28e-4 m", "0.0002135 m"],
        ),
        grease().scene(
            "cage starts without film or contact",
            &[
                ("cage.guide.solid", Value::Null),
                ("cage.guide.film_share", Value::Null),
                ("initial.cage", off(2.135e-4)),
            ],
            "initial.cage",
            &["no room", "0.0002135 m"],
        ),
        on_inner_ring.scene(
            "cage starts inside the inner ring",
            &[("initial.cage", off(-1.2e-4))],
            "initial.cage",
            &["2.2e-4", "0.0002135 m"],
        ),
    ]
}
