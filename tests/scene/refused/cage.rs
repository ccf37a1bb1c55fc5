//! The cage itself: its material, its unbalance and its load.

use super::table::*;
use serde_json::{Value, json};

pub fn rows() -> Vec<Row> {
    let load = "cage.load";
    vec![
        rollers().needed(
            "cage without material",
            "cage.material",
            "cage.material",
            &["cage.pocket.lubricated_cylinder"],
        ),
        grease().value("unneeded cage material unknown", "cage.material", json!("pa66"), &["'pa66'"]),
        grease().missing("cage mass missing", "cage.mass", "cage", &["missing field `mass`"]),
        grease().missing("cage inertia missing", "cage.inertia", "cage", &["missing field `inertia`"]),
        grease().value(
            "inertia of a cage elsewhere",
            "cage.inertia",
            json!(2.5e-3),
            &["0.0025 kg m^2", "1.2494"],
        ),
        grease().scene(
            "unbalance too large",
            &[("cage.mass_eccentricity", json!({"y": 0.0, "z": 0.03}))],
            "cage.mass_eccentricity.z",
            &["0.03 m", "0.0225 m"],
        ),
        grease().scene(
            "unbalance in mm",
            &[("cage.mass_eccentricity", json!({"y": -0.05, "z": 0.0}))],
            "cage.mass_eccentricity.y",
            &["-0.05 m", "milli", "-5e-5 m"],
        ),
        grease().scene(
            "unbalance in um",
            &[("cage.mass_eccentricity", json!({"y": 50, "z": 0.0}))],
            "cage.mass_eccentricity.y",
            &["50.0 m", "micro"],
        ),
        grease().json(
            "unbalance as a number",
            "cage.mass_eccentricity",
            json!(5e-5),
            "cage.mass_eccentricity",
            &["expected an object"],
        ),
        grease().json(
            "unbalance as a list",
            "cage.mass_eccentricity",
            json!([5e-5, 0.0]),
            "cage.mass_eccentricity",
            &["expected an object"],
        ),
        grease().json(
            "unbalance without z",
            "cage.mass_eccentricity",
            json!({"y": 5e-5}),
            "cage.mass_eccentricity",
            &["missing field `z`"],
        ),
        grease().json(
            "unbalance with a radius",
            "cage.mass_eccentricity",
            json!({"y": 0.0, "z": 0.0, "radius": 5e-5}),
            "cage.mass_eccentricity.radius",
            &["unknown field `radius`", "`y`"],
        ),
        grease().scene(
            "huge force on the cage",
            &[(load, json!({"force_y": {"constant": 2e9}}))],
            "cage.load.force_y.constant",
            &["2000000000.0 N"],
        ),
        grease().scene(
            "huge force upwards on the cage",
            &[(load, json!({"force_z": {"step": {"before": 0, "after": -2e9, "time": 1}}}))],
            "cage.load.force_z.step.after",
            &["-2000000000.0 N"],
        ),
        grease().scene(
            "huge torque on the cage",
            &[(load, json!({"torque": {"sine": {"mean": 0, "amplitude": 2e9, "frequency": 1, "phase": 0}}}))],
            "cage.load.torque.sine.amplitude",
            &["2000000000.0 N m"],
        ),
        grease().scene(
            "torque of unequal table",
            &[(load, json!({"torque": {"table": {"time": [0, 1], "value": [0]}}}))],
            "cage.load.torque.table.value",
            &["1 values for 2 points"],
        ),
        grease().json("load as a number", load, json!(10.0), load, &["10"]),
        grease().json(
            "load as a list",
            load,
            json!([{"constant": 0.0}, {"constant": -10.0}, {"constant": 0.0}]),
            load,
            &["expected an object"],
        ),
        grease().json(
            "truth value for a force",
            load,
            json!({"force_y": true}),
            "cage.load.force_y",
            &["expected one of `constant`"],
        ),
        grease().json("force of null", load, json!({"force_y": Value::Null}), "cage.load.force_y", &[]),
        grease().json(
            "load of a ring on the cage",
            load,
            json!({"y": {"constant": 1.0}}),
            "cage.load.y",
            &["unknown field `y`", "`force_y`"],
        ),
        grease().json(
            "unknown field in the cage",
            "cage.width",
            json!(0.02),
            "cage.width",
            &["unknown field `width`"],
        ),
        replaced_in_grease("cage mass beyond f64", "12.34e-3", "1e400", "cage.mass", &["out of range"]),
    ]
}
