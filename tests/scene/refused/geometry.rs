//! Geometry that cannot exist and names that lead nowhere.

use super::table::*;
use serde_json::{Value, json};

pub fn rows() -> Vec<Row> {
    let inner = "inner_ring.radial_clearance";
    vec![
        value_row("overlapping rollers", "rollers.count", json!(17), &["17 rollers", "overlap", "0.0075 m"]),
        value_row(
            "no room for the inner ring",
            "outer_ring.raceway_radius",
            json!(15e-3),
            &["0.015 m", "no room for the inner ring"],
        ),
        scene_row(
            "clearance of the size of a roller",
            vec![("rollers.radius", json!(1e-3)), ("rollers.inertia", json!(1.5e-8)), (inner, json!(1e-3))],
            inner,
            &["0.001 m", "a fifth of the roller radius"],
        ),
        value_row("preload of a millimetre", inner, json!(-1e-3), &["-0.001 m", "-2e-4"]),
        scene_row(
            "overlapping pockets",
            vec![("cage.pocket.lubricated_cylinder.radial_clearance", json!(9e-3))],
            "cage.pocket.lubricated_cylinder.radial_clearance",
            &["12 pockets", "overlap"],
        ),
        value_row(
            "roller material unknown",
            "rollers.material",
            json!("ceramic"),
            &["'ceramic'", "brass, steel"],
        ),
        value_row(
            "outer ring material unknown",
            "outer_ring.material",
            json!("Steel"),
            &["'Steel'", "steel"],
        ),
        value_row("inner ring material unknown", "inner_ring.material", json!(""), &["''"]),
        value_row("cage material unknown", "cage.material", json!("pa66"), &["'pa66'"]),
        scene_row("no materials", vec![("materials", json!({}))], "inner_ring.material", &["'steel'"]),
        value_row(
            "guide clearance too large",
            "cage.guide.diametral_clearance",
            json!(9e-3),
            &["0.009 m", "a tenth of the guide radius"],
        ),
        scene_row(
            "roundness closes the film",
            vec![(
                "cage.guide.roundness",
                json!([{"order": 2, "amplitude": 1.5e-4, "phase": 0.0}, {"order": 3, "amplitude": -1e-4, "phase": 0.0}]),
            )],
            "cage.guide.roundness",
            &["close the radial clearance", "0.0002225 m"],
        ),
        scene_row(
            "roundness amplitude in mm",
            vec![("cage.guide.roundness", json!([{"order": 2, "amplitude": 0.02, "phase": 0.0}]))],
            "cage.guide.roundness.0.amplitude",
            &["0.02 m", "milli"],
        ),
        scene_row(
            "roundness of order one",
            vec![(
                "cage.guide.roundness",
                json!([{"order": 2, "amplitude": 1e-6, "phase": 0.0}, {"order": 1, "amplitude": 1e-6, "phase": 0.0}]),
            )],
            "cage.guide.roundness.1.order",
            &["1 is not within 2 to 200", "eccentricity"],
        ),
        scene_row(
            "roundness of high order",
            vec![("cage.guide.roundness", json!([{"order": 201, "amplitude": 1e-6, "phase": 0.0}]))],
            "cage.guide.roundness.0.order",
            &["201"],
        ),
        scene_row(
            "65 harmonics",
            vec![(
                "cage.guide.roundness",
                json!(vec![json!({"order": 2, "amplitude": 1e-8, "phase": 0.0}); 65]),
            )],
            "cage.guide.roundness",
            &["65 harmonics", "64"],
        ),
        scene_row(
            "cage starts outside its clearance",
            vec![("initial.cage", json!({"y": 2e-4, "z": -2e-4}))],
            "initial.cage",
            &["no room", "0.0002225 m"],
        ),
        scene_row(
            "cage starts within the roundness",
            vec![
                ("initial.cage", json!({"y": 2e-4, "z": 0.0})),
                ("cage.guide.roundness", json!([{"order": 2, "amplitude": 3e-5, "phase": 0.0}])),
            ],
            "initial.cage",
            &["no room"],
        ),
        scene_row(
            "cage starts inside its rollers",
            vec![("cage.guide", Value::Null), ("initial.cage", json!({"y": 5e-3, "z": 0.0}))],
            "initial.cage",
            &["0.005 m"],
        ),
        scene_row(
            "cage start in um",
            vec![("initial.cage", json!({"y": 20.0, "z": 0.0}))],
            "initial.cage.y",
            &["20.0 m", "micro"],
        ),
        scene_row(
            "equilibrium of a fixed ring",
            vec![("inner_ring.motion", json!({"fixed": {"y": 0.0, "z": -2e-5}}))],
            "initial.inner_ring",
            &["equilibrium", "free", "centred"],
        ),
        scene_row(
            "fixed ring position in um",
            vec![
                ("inner_ring.motion", json!({"fixed": {"y": 0.0, "z": -20}})),
                ("initial.inner_ring", json!("centred")),
            ],
            "inner_ring.motion.fixed.z",
            &["-20.0 m", "micro"],
        ),
    ]
}
