//! Laws without what they need.

use super::table::*;
use serde_json::{Value, json};

pub fn rows() -> Vec<Row> {
    let null = || Value::Null;
    let lubricant = "lubricant";
    // Only the law in question asks for the constant.
    let guide_only = vec![
        (lubricant, null()),
        ("raceways", json!({})),
        ("cage.pocket.lubricated_cylinder.contact", json!({})),
    ];
    let rolling_only = |missing: &'static str| {
        vec![
            (missing, null()),
            ("raceways", json!({"rolling_resistance": {"extent": "all"}})),
            ("cage.pocket.lubricated_cylinder.contact", json!({})),
        ]
    };
    let raceway_law = |missing: &'static str, contact: Value| {
        vec![
            (missing, null()),
            ("raceways", json!({"contact": contact})),
            ("cage.pocket.lubricated_cylinder.contact", json!({})),
        ]
    };
    let pocket_law = |missing: &'static str, contact: Value| {
        vec![(missing, null()), ("raceways", json!({})), ("cage.pocket.lubricated_cylinder.contact", contact)]
    };
    let film = || json!({"film": "pan_hamrock"});
    let corrected = || json!({"film": "pan_hamrock", "thermal_correction": "gupta"});
    let traction = || json!({"film": "pan_hamrock", "traction": "muraki_kimura"});
    let heated =
        || json!({"film": "pan_hamrock", "traction": "muraki_kimura", "self_heating": "film_and_flash"});
    let alpha = "lubricant.pressure_viscosity";
    let beta = "lubricant.temperature_viscosity";
    let conductivity = "lubricant.conductivity";
    vec![
        needed("no lubricant at all", lubricant, lubricant, &["missing", "raceways.contact"]),
        scene_row("guide without lubricant", guide_only, lubricant, &["missing", "cage.guide"]),
        scene_row(
            "rolling resistance without lubricant",
            rolling_only(lubricant),
            lubricant,
            &["raceways.rolling_resistance"],
        ),
        scene_row(
            "rolling resistance without alpha",
            rolling_only(alpha),
            alpha,
            &["raceways.rolling_resistance needs it"],
        ),
        scene_row(
            "rolling resistance without beta",
            rolling_only(beta),
            beta,
            &["raceways.rolling_resistance needs it"],
        ),
        scene_row(
            "rolling resistance without conductivity",
            rolling_only(conductivity),
            conductivity,
            &["raceways.rolling_resistance needs it"],
        ),
        scene_row(
            "film without lubricant",
            raceway_law(lubricant, film()),
            lubricant,
            &["raceways.contact.film"],
        ),
        scene_row(
            "film without alpha",
            raceway_law(alpha, film()),
            alpha,
            &["raceways.contact.film needs it"],
        ),
        scene_row(
            "correction without beta",
            raceway_law(beta, corrected()),
            beta,
            &["raceways.contact.thermal_correction needs it"],
        ),
        scene_row(
            "correction without conductivity",
            raceway_law(conductivity, corrected()),
            conductivity,
            &["raceways.contact.thermal_correction needs it"],
        ),
        scene_row(
            "traction without Eyring stress",
            raceway_law("lubricant.eyring_stress", traction()),
            "lubricant.eyring_stress",
            &["raceways.contact.traction needs it"],
        ),
        scene_row(
            "traction without shear modulus",
            raceway_law("lubricant.shear_modulus", traction()),
            "lubricant.shear_modulus",
            &["raceways.contact.traction needs it"],
        ),
        scene_row(
            "self-heating without beta",
            raceway_law(beta, heated()),
            beta,
            &["raceways.contact.self_heating needs it"],
        ),
        scene_row(
            "self-heating without conductivity",
            raceway_law(conductivity, heated()),
            conductivity,
            &["raceways.contact.self_heating needs it"],
        ),
        scene_row(
            "self-heating without steel's constants",
            raceway_law("materials.steel.thermal", heated()),
            "materials.steel.thermal",
            &["raceways.contact.self_heating needs it"],
        ),
        scene_row(
            "self-heating without brass's constants",
            pocket_law("materials.brass.thermal", heated()),
            "materials.brass.thermal",
            &["cage.pocket.lubricated_cylinder.contact.self_heating needs it"],
        ),
        scene_row(
            "pocket film without lubricant",
            pocket_law(lubricant, film()),
            lubricant,
            &["cage.pocket.lubricated_cylinder.contact.film"],
        ),
        scene_row(
            "pocket traction without Eyring stress",
            pocket_law("lubricant.eyring_stress", traction()),
            "lubricant.eyring_stress",
            &["cage.pocket.lubricated_cylinder.contact.traction needs it"],
        ),
        scene_row(
            "traction without film",
            vec![("raceways.contact", json!({"traction": "muraki_kimura"}))],
            "raceways.contact.traction",
            &["needs 'film'"],
        ),
        scene_row(
            "correction without film",
            vec![("cage.pocket.lubricated_cylinder.contact", json!({"thermal_correction": "gupta"}))],
            "cage.pocket.lubricated_cylinder.contact.thermal_correction",
            &["needs 'film'"],
        ),
        scene_row(
            "self-heating without traction",
            vec![("raceways.contact.traction", null())],
            "raceways.contact.self_heating",
            &["needs 'traction'"],
        ),
        scene_row(
            "boundary friction without film",
            vec![
                ("raceways.contact.film", null()),
                ("raceways.contact.thermal_correction", null()),
                ("raceways.contact.traction", null()),
                ("raceways.contact.self_heating", null()),
            ],
            "raceways.contact.boundary_friction",
            &["needs 'film'"],
        ),
    ]
}
