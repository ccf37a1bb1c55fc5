//! The guide: its ring, its films, its solid contact and the share between them.

use super::table::*;
use serde_json::{Value, json};

pub fn rows() -> Vec<Row> {
    [place_and_ring(), together(), short_bearing(), layer(), solid()].into_iter().flatten().collect()
}

fn place_and_ring() -> Vec<Row> {
    vec![
        grease().value(
            "guide radius in mm",
            "cage.guide.guide_radius",
            json!(46.875),
            &["46.875 m", "milli"],
        ),
        grease().value(
            "guide inside the bore",
            "cage.guide.guide_radius",
            json!(0.017),
            &["0.017 m", "0.0445"],
        ),
        grease().value(
            "guide outside of the bearing",
            "cage.guide.guide_radius",
            json!(0.082),
            &["0.082 m", "0.0504"],
        ),
        grease().value(
            "greased clearance in mm",
            "cage.guide.diametral_clearance",
            json!(0.427),
            &["0.427 m", "milli"],
        ),
        grease().value(
            "guide without play",
            "cage.guide.diametral_clearance",
            json!(0),
            &["0.0 m", "1e-6 to 0.01 m"],
        ),
        grease().value(
            "wide greased clearance",
            "cage.guide.diametral_clearance",
            json!(5e-3),
            &["0.005 m", "a tenth of the guide radius 0.046875 m"],
        ),
        grease().missing(
            "guide radius missing",
            "cage.guide.guide_radius",
            "cage.guide",
            &["missing field `guide_radius`"],
        ),
        grease().missing(
            "guide clearance missing",
            "cage.guide.diametral_clearance",
            "cage.guide",
            &["missing field `diametral_clearance`"],
        ),
        grease().json(
            "unknown guide ring",
            "cage.guide.ring",
            json!("outer"),
            "cage.guide.ring",
            &["unknown variant `outer`", "`outer_ring`", "`inner_ring`"],
        ),
        grease().json(
            "guide ring as a number",
            "cage.guide.ring",
            json!(1),
            "cage.guide.ring",
            &["`inner_ring`, found 1"],
        ),
        grease().json(
            "guide ring as a block",
            "cage.guide.ring",
            json!({"outer_ring": {}}),
            "cage.guide.ring",
            &[],
        ),
        grease().json(
            "guide ring of null",
            "cage.guide.ring",
            Value::Null,
            "cage.guide.ring",
            &["`inner_ring`, found null"],
        ),
        grease().json(
            "land width outside of the film",
            "cage.guide.land_width",
            json!(8e-3),
            "cage.guide.land_width",
            &["unknown field `land_width`", "`film`"],
        ),
        replaced_in_grease("guide radius NaN", "46.875e-3", "NaN", "cage.guide.guide_radius", &["line"]),
    ]
}

fn together() -> Vec<Row> {
    let share = "cage.guide.film_share";
    let film = "cage.guide.film";
    let layer_only = grease().with(&[("cage.guide.solid", Value::Null), (share, Value::Null)]);
    let solid_only = grease().with(&[(film, Value::Null), (share, Value::Null)]);
    let round = json!([{"order": 2, "amplitude": 1e-6, "phase": 0.0}]);
    vec![
        layer_only.needed("guided by nothing", film, "cage.guide", &["nothing", "'film', 'solid' or both"]),
        grease().scene(
            "guided by shares of nothing",
            &[(film, Value::Null), ("cage.guide.solid", Value::Null)],
            "cage.guide",
            &["nothing"],
        ),
        grease().needed("film and solid without share", share, share, &["missing", "film and solid contact"]),
        grease().needed("share without film", film, share, &["needs both 'film' and 'solid'"]),
        grease().needed(
            "share without solid contact",
            "cage.guide.solid",
            share,
            &["needs both 'film' and 'solid'"],
        ),
        solid_only.value(
            "roundness without film",
            "cage.guide.roundness",
            round,
            &["needs 'film' beside it"],
        ),
        grease().value(
            "share roughness in um",
            "cage.guide.film_share.roughness",
            json!(1),
            &["1.0 m", "micro", "1e-6 m"],
        ),
        grease().value("share of smooth surfaces", "cage.guide.film_share.roughness", json!(0), &["0.0 m"]),
        grease().value(
            "share roughness of the size of the clearance",
            "cage.guide.film_share.roughness",
            json!(5e-5),
            &["5e-5 m", "3.558"],
        ),
        grease().missing(
            "share roughness missing",
            "cage.guide.film_share.roughness",
            share,
            &["missing field `roughness`"],
        ),
        grease().value(
            "touching ratio beyond full films",
            "cage.guide.film_share.touching_ratio",
            json!(3.1),
            &["3.1", "0 to 3"],
        ),
        grease().value(
            "negative touching ratio",
            "cage.guide.film_share.touching_ratio",
            json!(-0.1),
            &["-0.1"],
        ),
        grease().json(
            "touching ratio of null",
            "cage.guide.film_share.touching_ratio",
            Value::Null,
            "cage.guide.film_share.touching_ratio",
            &["null", "expected a number"],
        ),
        grease().json(
            "unknown field in the share",
            "cage.guide.film_share.exponent",
            json!(1.2),
            "cage.guide.film_share.exponent",
            &["unknown field `exponent`", "`roughness`"],
        ),
        grease().json("share as a number", share, json!(0.5), share, &["0.5"]),
    ]
}

fn short_bearing() -> Vec<Row> {
    let film = "cage.guide.film";
    vec![
        grease().json("no film law", film, json!({}), film, &[]),
        grease().json("film law as a word", film, json!("lubricant_layer"), film, &["lubricant_layer"]),
        grease().json(
            "unknown film of a guide",
            film,
            json!({"long_bearing": {}}),
            film,
            &["unknown variant `long_bearing`", "`short_bearing`", "`lubricant_layer`"],
        ),
        grease().json("two films of a guide", "cage.guide.film.short_bearing", json!({}), film, &[]),
        rollers().json(
            "layer thickness of a short bearing",
            "cage.guide.film.short_bearing.thickness",
            json!(80e-6),
            "cage.guide.film.short_bearing.thickness",
            &["unknown field `thickness`", "`squeeze`"],
        ),
        rollers().value(
            "land width in mm",
            "cage.guide.film.short_bearing.land_width",
            json!(7),
            &["7.0 m", "milli", "7e-3 m"],
        ),
        grease().scene(
            "short bearing of kinematic elements without lubricant",
            &[(film, json!({"short_bearing": {"land_width": 8e-3}})), ("lubricant", Value::Null)],
            "lubricant",
            &["missing; cage.guide.film.short_bearing needs it"],
        ),
    ]
}

fn layer() -> Vec<Row> {
    let layer = "cage.guide.film.lubricant_layer";
    vec![
        grease().needed(
            "layer without lubricant",
            "lubricant",
            "lubricant",
            &["missing; cage.guide.film.lubricant_layer needs it"],
        ),
        grease().needed(
            "layer without alpha",
            "lubricant.pressure_viscosity",
            "lubricant.pressure_viscosity",
            &["missing; cage.guide.film.lubricant_layer needs it"],
        ),
        grease().missing(
            "layer width missing",
            "cage.guide.film.lubricant_layer.land_width",
            layer,
            &["missing field `land_width`"],
        ),
        grease().missing(
            "layer thickness missing",
            "cage.guide.film.lubricant_layer.thickness",
            layer,
            &["missing field `thickness`"],
        ),
        grease().value(
            "layer width in mm",
            "cage.guide.film.lubricant_layer.land_width",
            json!(8),
            &["8.0 m", "milli", "8e-3 m"],
        ),
        grease().value(
            "layer without width",
            "cage.guide.film.lubricant_layer.land_width",
            json!(0),
            &["0.0 m"],
        ),
        grease().value(
            "layer thickness in um",
            "cage.guide.film.lubricant_layer.thickness",
            json!(80),
            &["80.0 m", "micro", "8e-5 m"],
        ),
        grease().value(
            "layer without thickness",
            "cage.guide.film.lubricant_layer.thickness",
            json!(0),
            &["0.0 m"],
        ),
        grease().value(
            "negative layer",
            "cage.guide.film.lubricant_layer.thickness",
            json!(-80e-6),
            &["-8e-5 m"],
        ),
        grease().value(
            "pressure cap of one",
            "cage.guide.film.lubricant_layer.pressure_cap",
            json!(1),
            &["1.0", "0.1 to 0.999"],
        ),
        grease().value("no pressure cap", "cage.guide.film.lubricant_layer.pressure_cap", json!(0), &["0.0"]),
        grease().value(
            "pressure cap in Pa",
            "cage.guide.film.lubricant_layer.pressure_cap",
            json!(45e6),
            &["45000000.0"],
        ),
        grease().json(
            "pressure shear as a flag",
            "cage.guide.film.lubricant_layer.pressure_shear",
            json!(true),
            "cage.guide.film.lubricant_layer.pressure_shear",
            &["found true"],
        ),
        grease().json(
            "unknown pressure shear",
            "cage.guide.film.lubricant_layer.pressure_shear",
            json!("none"),
            "cage.guide.film.lubricant_layer.pressure_shear",
            &["unknown variant `none`", "`absent`", "`within_arc`", "`with_edges`"],
        ),
        grease().json(
            "squeeze flag of a layer",
            "cage.guide.film.lubricant_layer.squeeze",
            json!(true),
            "cage.guide.film.lubricant_layer.squeeze",
            &["unknown field `squeeze`", "`pressure_cap`"],
        ),
        grease().json(
            "layer thickness as a text",
            "cage.guide.film.lubricant_layer.thickness",
            json!("80 um"),
            "cage.guide.film.lubricant_layer.thickness",
            &["80 um", "expected a number"],
        ),
        replaced_in_grease(
            "layer of infinite thickness",
            "80e-6",
            "1e999",
            "cage.guide.film",
            &["out of range"],
        ),
        grease().value(
            "roundness closes the layer",
            "cage.guide.roundness",
            json!([{"order": 2, "amplitude": 2.135e-4, "phase": 0.0}]),
            &["close the radial clearance 0.0002135 m"],
        ),
    ]
}

fn solid() -> Vec<Row> {
    let solid = "cage.guide.solid";
    let contact = "cage.guide.solid.contact";
    vec![
        grease().missing("guide contact missing", contact, solid, &["missing field `contact`"]),
        grease().missing(
            "guide stiffness missing",
            "cage.guide.solid.contact.stiffness",
            contact,
            &["missing field `stiffness`"],
        ),
        grease().value(
            "guide stiffness of zero",
            "cage.guide.solid.contact.stiffness",
            json!(0),
            &["0.0 N/m", "1 to 1e12"],
        ),
        grease().value(
            "negative guide damping",
            "cage.guide.solid.contact.damping",
            json!(-1),
            &["-1.0 N s/m"],
        ),
        grease().value(
            "guide softening depth in um",
            "cage.guide.solid.contact.softening_depth",
            json!(1),
            &["1.0 m", "micro"],
        ),
        grease().value(
            "guide friction beyond any",
            "cage.guide.solid.contact.friction.coefficient",
            json!(2.1),
            &["2.1", "0 to 2"],
        ),
        grease().value(
            "guide transition speed in um/s",
            "cage.guide.solid.contact.friction.transition_speed",
            json!(1e4),
            &["10000.0 m/s", "millimetres per second"],
        ),
        grease().value(
            "asperities in um",
            "cage.guide.solid.asperity_height",
            json!(3),
            &["3.0 m", "micro", "3e-6 m"],
        ),
        grease().value("negative asperities", "cage.guide.solid.asperity_height", json!(-3e-6), &["-3e-6 m"]),
        grease().value(
            "asperities of the size of the clearance",
            "cage.guide.solid.asperity_height",
            json!(1.1e-4),
            &["0.00011 m", "1.0675e-4 m"],
        ),
        grease().json(
            "asperities as a text",
            "cage.guide.solid.asperity_height",
            json!("3 um"),
            "cage.guide.solid.asperity_height",
            &["3 um", "expected a number"],
        ),
        grease().json(
            "stiffness outside of the contact",
            "cage.guide.solid.stiffness",
            json!(1e6),
            "cage.guide.solid.stiffness",
            &["unknown field `stiffness`", "`contact`"],
        ),
        grease().json(
            "unknown field in the guide contact",
            "cage.guide.solid.contact.mu",
            json!(0.1),
            "cage.guide.solid.contact.mu",
            &["unknown field `mu`", "`friction`"],
        ),
        grease().json("guide contact as a word", solid, json!("voigt"), solid, &["voigt"]),
    ]
}
