//! Elastic cages and heat balances.

use super::table::*;
use serde_json::json;

pub fn rows() -> Vec<Row> {
    [rings(), balances()].into_iter().flatten().collect()
}

fn rings() -> Vec<Row> {
    let base = bent();
    let section = |thickness: f64| json!({"section": {"young_modulus": 9.61e9, "width": 17e-3, "thickness": thickness}});
    let modes = |frequencies: &[f64]| json!({"finite_elements": {"frequencies": frequencies, "modal_masses": [6e-3, 6e-3, 6e-3]}});
    let stiffness = "cage.elastic_ring.stiffness";
    vec![
        base.value("one wave", "cage.elastic_ring.modes", json!(1), &["within 2 to 12"]),
        base.value(
            "more waves than half of the elements",
            "cage.elastic_ring.modes",
            json!(13),
            &["25 elements"],
        ),
        base.value("neutral radius in mm", "cage.elastic_ring.neutral_radius", json!(45.081), &["m"]),
        base.value("overcritical waves", "cage.elastic_ring.damping", json!(3.0), &["3.0"]),
        base.value("a ring that shrinks", "cage.elastic_ring.growth", json!(-1e-12), &["-1e-12"]),
        base.value("contact depth of nothing", "cage.elastic_ring.contact_depth", json!(0.0), &["0.0"]),
        base.value("no bending stiffness", "cage.elastic_ring.stiffness.bending", json!(0.0), &["0.0"]),
        base.scene(
            "a ring too thick for its waves",
            &[(stiffness, section(12e-3))],
            "cage.elastic_ring.stiffness.section.thickness",
            &["no longer those of a thin ring"],
        ),
        base.scene(
            "too few frequencies",
            &[(stiffness, modes(&[3e3, 9e3]))],
            "cage.elastic_ring.stiffness.finite_elements.frequencies",
            &["need 3"],
        ),
        base.scene(
            "a frequency of nothing",
            &[(stiffness, modes(&[3e3, 0.0, 2e4]))],
            "cage.elastic_ring.stiffness.finite_elements.frequencies.1",
            &["0.0"],
        ),
        base.json("no stiffness", stiffness, json!({}), stiffness, &[]),
    ]
}

fn balances() -> Vec<Row> {
    let base = warm();
    let link = |ends: [&str; 2], conductance: f64| json!({"between": ends, "conductance": {"constant": conductance}});
    vec![
        base.scene(
            "a temperature beside the heat balance",
            &[("lubricant.viscosity.walther.temperature", json!({"over_time": {"constant": 313.15}}))],
            "lubricant.viscosity.walther.temperature",
            &["not allowed beside 'heat'"],
        ),
        base.value("cold surroundings", "heat.ambient", json!(20.0), &["K"]),
        base.value("no lumps", "heat.nodes", json!([]), &["0 lumps"]),
        base.value("a lump called like another", "heat.nodes.1.name", json!("film"), &["taken"]),
        base.value("a lump called ambient", "heat.nodes.1.name", json!("ambient"), &["taken"]),
        base.value("no capacity", "heat.nodes.0.capacity", json!(0.0), &["J/K"]),
        base.value("lubricant of no lump", "heat.lubricant", json!("oil"), &["film, cage"]),
        base.value("link to nowhere", "heat.links.0.between.1", json!("pump"), &["no lump 'pump'"]),
        base.value("link to itself", "heat.links.0.between", json!(["film", "film"]), &["both ends"]),
        base.value("negative conductance", "heat.links.0.conductance.constant", json!(-1.0), &["W/K"]),
        base.scene(
            "a lump without a way out",
            &[
                ("heat.links.6", link(["inner_ring", "ambient"], 0.0)),
                ("heat.links.7", link(["housing", "ambient"], 0.0)),
            ],
            "heat.links",
            &["'film'", "without end"],
        ),
        base.scene(
            "a lump whose way out only turning opens",
            &[
                ("inner_ring.speed.constant", json!(0.0)),
                ("heat.links.0.conductance", json!({"balls": 1.0})),
                ("heat.links.1.conductance", json!({"balls": 1.0})),
            ],
            "heat.links",
            &["'film'", "while the ring rests", "without end"],
        ),
        base.value("a power of no name", "heat.sources.0.power", json!("magic"), &["guide_film"]),
        base.value("a source of no lump", "heat.sources.0.node", json!("oil"), &["no lump 'oil'"]),
        base.scene(
            "more heat than there is",
            &[("heat.sources.1", json!({"power": "guide_film", "node": "cage", "share": 0.5}))],
            "heat.sources",
            &["add up to 1.5"],
        ),
        base.value("torque of no lump", "heat.bearing_torque.nodes.0", json!("shaft"), &["no lump 'shaft'"]),
        base.value("f0 of a thousand", "heat.bearing_torque.f0", json!(1000.0), &["1000.0"]),
    ]
}
