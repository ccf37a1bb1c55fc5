//! Pockets of both kinds.

use super::table::*;
use serde_json::{Value, json};

pub fn rows() -> Vec<Row> {
    [kinds(), plane(), lubricated()].into_iter().flatten().collect()
}

fn kinds() -> Vec<Row> {
    let place = "cage.pocket";
    vec![
        grease().json("no pocket law", place, json!({}), place, &[]),
        grease().json("pocket law as a word", place, json!("solid_plane"), place, &["solid_plane"]),
        grease().json(
            "unknown pocket law",
            place,
            json!({"sphere": {}}),
            place,
            &["unknown variant `sphere`", "`lubricated_cylinder`", "`solid_plane`"],
        ),
        grease().json("two pocket laws", "cage.pocket.lubricated_cylinder", json!({}), place, &[]),
        grease().json(
            "angle of a plane pocket",
            "cage.pocket.solid_plane.half_angle",
            json!(0.4),
            "cage.pocket.solid_plane.half_angle",
            &["unknown field `half_angle`", "`diametral_clearance`"],
        ),
        rollers().json(
            "diametral clearance of a cylinder pocket",
            "cage.pocket.lubricated_cylinder.diametral_clearance",
            json!(0.3e-3),
            "cage.pocket.lubricated_cylinder.diametral_clearance",
            &["unknown field `diametral_clearance`", "`radial_clearance`"],
        ),
        rollers().json(
            "spring in a cylinder pocket",
            "cage.pocket.lubricated_cylinder.contact.stiffness",
            json!(1e6),
            "cage.pocket.lubricated_cylinder.contact.stiffness",
            &["unknown field `stiffness`"],
        ),
        rollers().json(
            "pocket fields without their law",
            place,
            json!({"radial_clearance": 0.15e-3}),
            place,
            &["`radial_clearance`", "`lubricated_cylinder`"],
        ),
    ]
}

fn plane() -> Vec<Row> {
    let pocket = "cage.pocket.solid_plane";
    let contact = "cage.pocket.solid_plane.contact";
    vec![
        grease().value(
            "plane pocket clearance in mm",
            "cage.pocket.solid_plane.diametral_clearance",
            json!(0.555),
            &["0.555 m", "milli", "5.55e-4 m"],
        ),
        grease().value(
            "plane pocket clearance in um",
            "cage.pocket.solid_plane.diametral_clearance",
            json!(555),
            &["555.0 m", "micro"],
        ),
        grease().value(
            "plane pocket without play",
            "cage.pocket.solid_plane.diametral_clearance",
            json!(0),
            &["0.0 m"],
        ),
        grease().value(
            "overlapping plane pockets",
            "cage.pocket.solid_plane.diametral_clearance",
            json!(5e-3),
            &["25 pockets", "overlap"],
        ),
        grease().missing(
            "plane pocket clearance missing",
            "cage.pocket.solid_plane.diametral_clearance",
            pocket,
            &["missing field `diametral_clearance`"],
        ),
        grease().missing("plane pocket contact missing", contact, pocket, &["missing field `contact`"]),
        grease().missing(
            "pocket stiffness missing",
            "cage.pocket.solid_plane.contact.stiffness",
            contact,
            &["missing field `stiffness`"],
        ),
        grease().value(
            "pocket without stiffness",
            "cage.pocket.solid_plane.contact.stiffness",
            json!(0),
            &["0.0 N/m", "1 to 1e12 N/m"],
        ),
        grease().value(
            "pocket stiffness beyond any",
            "cage.pocket.solid_plane.contact.stiffness",
            json!(1e13),
            &["N/m"],
        ),
        grease().value(
            "negative pocket damping",
            "cage.pocket.solid_plane.contact.damping",
            json!(-44.4),
            &["-44.4 N s/m", "0 to 1e6"],
        ),
        grease().value(
            "pocket softening depth in um",
            "cage.pocket.solid_plane.contact.softening_depth",
            json!(1),
            &["1.0 m", "micro", "1e-6 m"],
        ),
        grease().value(
            "negative pocket softening depth",
            "cage.pocket.solid_plane.contact.softening_depth",
            json!(-1e-6),
            &["-1e-6 m"],
        ),
        grease().value(
            "negative pocket friction",
            "cage.pocket.solid_plane.contact.friction.coefficient",
            json!(-0.1),
            &["-0.1", "0 to 2"],
        ),
        grease().value(
            "pocket friction in percent",
            "cage.pocket.solid_plane.contact.friction.coefficient",
            json!(10),
            &["10.0"],
        ),
        grease().value(
            "pocket friction without transition",
            "cage.pocket.solid_plane.contact.friction.transition_speed",
            json!(0),
            &["0.0 m/s", "1e-6 to 10"],
        ),
        grease().missing(
            "pocket friction coefficient missing",
            "cage.pocket.solid_plane.contact.friction.coefficient",
            "cage.pocket.solid_plane.contact.friction",
            &["missing field `coefficient`"],
        ),
        grease().missing(
            "pocket transition speed missing",
            "cage.pocket.solid_plane.contact.friction.transition_speed",
            "cage.pocket.solid_plane.contact.friction",
            &["missing field `transition_speed`"],
        ),
        grease().json(
            "pocket friction as a number",
            "cage.pocket.solid_plane.contact.friction",
            json!(0.1),
            "cage.pocket.solid_plane.contact.friction",
            &["0.1"],
        ),
        grease().json(
            "film in a plane pocket",
            "cage.pocket.solid_plane.contact.film",
            json!("pan_hamrock"),
            "cage.pocket.solid_plane.contact.film",
            &["unknown field `film`", "`stiffness`"],
        ),
        grease().json(
            "pocket damping as a block",
            "cage.pocket.solid_plane.contact.damping",
            json!({"relaxation_time": 1e-6}),
            "cage.pocket.solid_plane.contact.damping",
            &["expected a number"],
        ),
        grease().json(
            "pocket damping of null",
            "cage.pocket.solid_plane.contact.damping",
            Value::Null,
            "cage.pocket.solid_plane.contact.damping",
            &["null", "expected a number"],
        ),
        replaced_in_grease("pocket clearance NaN", "0.555e-3", "NaN", "cage.pocket", &["line"]),
        replaced_in_grease(
            "pocket stiffness infinite",
            "\"stiffness\": 1e6",
            "\"stiffness\": Infinity",
            "cage.pocket",
            &["line"],
        ),
    ]
}

/// Lubricated pockets around kinematic elements, which have material and length only for them.
fn lubricated() -> Vec<Row> {
    let pocket =
        json!({"lubricated_cylinder": {"radial_clearance": 0.2e-3, "half_angle": 0.4, "edge_blend": 0.02}});
    let steel = json!({"steel": {"young_modulus": 206e9, "poisson_ratio": 0.3}});
    let base = grease().with(&[
        ("materials", steel),
        ("kinematic_elements.material", json!("steel")),
        ("kinematic_elements.effective_length", json!(8e-3)),
        ("cage.material", json!("steel")),
        ("cage.pocket", pocket),
    ]);
    let by = &["missing; cage.pocket.lubricated_cylinder needs it"];
    let material = "kinematic_elements.material";
    let length = "kinematic_elements.effective_length";
    vec![
        base.needed("lubricated pocket around no material", material, material, by),
        base.needed("lubricated pocket around no length", length, length, by),
        base.needed("lubricated pocket of no material", "cage.material", "cage.material", by),
        base.scene(
            "lubricated pocket with nothing it needs",
            &[(material, Value::Null), (length, Value::Null), ("cage.material", Value::Null)],
            "cage.material",
            by,
        ),
        base.scene(
            "pocket film of kinematic elements without lubricant",
            &[
                ("cage.pocket.lubricated_cylinder.contact", json!({"film": "pan_hamrock"})),
                ("cage.guide", Value::Null),
                ("lubricant", Value::Null),
            ],
            "lubricant",
            &["missing; cage.pocket.lubricated_cylinder.contact.film needs it"],
        ),
        base.scene(
            "pocket traction of kinematic elements without constants",
            &[(
                "cage.pocket.lubricated_cylinder.contact",
                json!({"film": "pan_hamrock", "traction": "muraki_kimura"}),
            )],
            "lubricant.eyring_stress",
            &["missing; cage.pocket.lubricated_cylinder.contact.traction needs it"],
        ),
        base.scene(
            "overlapping lubricated pockets of kinematic elements",
            &[("cage.pocket.lubricated_cylinder.radial_clearance", json!(2e-3))],
            "cage.pocket.lubricated_cylinder.radial_clearance",
            &["25 pockets", "overlap"],
        ),
    ]
}
