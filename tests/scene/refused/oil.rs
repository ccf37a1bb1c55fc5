//! Viscosity of the lubricant over its temperature.

use super::table::*;
use serde_json::{Value, json};

pub fn rows() -> Vec<Row> {
    [fields(), points(), temperature()].into_iter().flatten().collect()
}

fn fields() -> Vec<Row> {
    let viscosity = "lubricant.viscosity";
    let walther = "lubricant.viscosity.walther";
    vec![
        rollers().missing("viscosity missing", viscosity, "lubricant", &["missing field `viscosity`"]),
        rollers().scene(
            "oil that there is not",
            &[("lubricant.catalogue", json!("butter"))],
            "lubricant.catalogue",
            &["'butter' is not in the catalogue", "iso_vg_68"],
        ),
        rollers().scene(
            "oil of the catalogue without a temperature",
            &[("lubricant", json!({"catalogue": "iso_vg_68"}))],
            "lubricant.viscosity.walther.temperature",
            &["missing", "'heat'"],
        ),
        rollers().scene(
            "number for an oil",
            &[("lubricant.catalogue", json!(68))],
            "lubricant.catalogue",
            &["expected a name", "found 68"],
        ),
        rollers().scene(
            "oil beside all its values",
            &[("lubricant.catalogue", json!("iso_vg_68"))],
            "lubricant.catalogue",
            &["nothing is taken of 'iso_vg_68'", "remove them, or the name"],
        ),
        rollers().json(
            "truth value for a viscosity",
            viscosity,
            json!(false),
            viscosity,
            &["`walther`, found false"],
        ),
        rollers().json("no viscosity", viscosity, json!({}), viscosity, &[]),
        rollers().json("viscosity of null", viscosity, Value::Null, viscosity, &[]),
        rollers().json(
            "unknown viscosity law",
            viscosity,
            json!({"vogel": {}}),
            viscosity,
            &["unknown variant `vogel`", "`walther`"],
        ),
        grease().json("two viscosities", "lubricant.viscosity.constant", json!(0.06), viscosity, &[]),
        rollers().json("signal for a viscosity", viscosity, json!({"sine": {}}), viscosity, &["`constant`"]),
        rollers().json(
            "text for a viscosity",
            "lubricant.viscosity.constant",
            json!("0.06"),
            "lubricant.viscosity.constant",
            &["0.06", "expected a number"],
        ),
        rollers().value("no viscous force", "lubricant.viscosity.constant", json!(0), &["0.0 Pa s"]),
        grease().missing(
            "cold point missing",
            "lubricant.viscosity.walther.cold",
            walther,
            &["missing field `cold`"],
        ),
        grease().missing(
            "hot point missing",
            "lubricant.viscosity.walther.hot",
            walther,
            &["missing field `hot`"],
        ),
        grease().missing(
            "density missing",
            "lubricant.viscosity.walther.density",
            walther,
            &["missing field `density`"],
        ),
        grease().needed(
            "temperature missing",
            "lubricant.viscosity.walther.temperature",
            "lubricant.viscosity.walther.temperature",
            &["missing", "'heat'"],
        ),
        grease().missing(
            "temperature of a point missing",
            "lubricant.viscosity.walther.hot.temperature",
            "lubricant.viscosity.walther.hot",
            &["missing field `temperature`"],
        ),
        grease().missing(
            "viscosity of a point missing",
            "lubricant.viscosity.walther.cold.kinematic_viscosity",
            "lubricant.viscosity.walther.cold",
            &["missing field `kinematic_viscosity`"],
        ),
        grease().json(
            "unknown field in Walther's equation",
            "lubricant.viscosity.walther.index",
            json!(95),
            "lubricant.viscosity.walther.index",
            &["unknown field `index`", "`density`"],
        ),
        grease().json(
            "unknown field in a point",
            "lubricant.viscosity.walther.hot.viscosity",
            json!(1e-5),
            "lubricant.viscosity.walther.hot.viscosity",
            &["unknown field `viscosity`", "`kinematic_viscosity`"],
        ),
        grease().json(
            "point as a list",
            "lubricant.viscosity.walther.hot",
            json!([373.15, 12e-6]),
            "lubricant.viscosity.walther.hot",
            &["expected an object, found [373.15"],
        ),
        replaced_in_grease("viscosity NaN", "105e-6", "NaN", walther, &["line"]),
        replaced_in_grease("density beyond f64", "880.0", "8e999", walther, &["out of range"]),
    ]
}

fn points() -> Vec<Row> {
    let hot = "lubricant.viscosity.walther.hot";
    let must = &["must be hotter and thinner than the cold point"];
    vec![
        grease().scene(
            "points swapped",
            &[
                (
                    "lubricant.viscosity.walther.cold",
                    json!({"temperature": 373.15, "kinematic_viscosity": 12e-6}),
                ),
                (hot, json!({"temperature": 313.15, "kinematic_viscosity": 105e-6})),
            ],
            hot,
            &["must be hotter and thinner", "313.15 K", "0.000105 m^2/s"],
        ),
        grease().scene(
            "points equal",
            &[(hot, json!({"temperature": 313.15, "kinematic_viscosity": 105e-6}))],
            hot,
            must,
        ),
        grease().scene(
            "points at one temperature",
            &[("lubricant.viscosity.walther.hot.temperature", json!(313.15))],
            hot,
            must,
        ),
        grease().scene(
            "hot point thicker",
            &[("lubricant.viscosity.walther.hot.kinematic_viscosity", json!(2e-4))],
            hot,
            must,
        ),
        grease().scene(
            "points of one viscosity",
            &[("lubricant.viscosity.walther.hot.kinematic_viscosity", json!(105e-6))],
            hot,
            must,
        ),
        grease().value(
            "too thin for Walther",
            "lubricant.viscosity.walther.hot.kinematic_viscosity",
            json!(0.3e-6),
            &["3e-7 m^2/s", "4e-7 to 1 m^2/s"],
        ),
        grease().value(
            "viscosity in cSt",
            "lubricant.viscosity.walther.cold.kinematic_viscosity",
            json!(105),
            &["105.0 m^2/s"],
        ),
        grease().value(
            "negative kinematic viscosity",
            "lubricant.viscosity.walther.hot.kinematic_viscosity",
            json!(-12e-6),
            &["-1.2e-5 m^2/s"],
        ),
        grease().value(
            "point in degrees Celsius",
            "lubricant.viscosity.walther.cold.temperature",
            json!(40),
            &["40.0 K is not within 150 to 1000 K", "degrees Celsius, 313.15 K"],
        ),
        grease().value(
            "point in the fire",
            "lubricant.viscosity.walther.hot.temperature",
            json!(1001),
            &["1001.0 K"],
        ),
        grease().value(
            "oil density in g/cm^3",
            "lubricant.viscosity.walther.density",
            json!(0.88),
            &["0.88 kg/m^3", "g/cm^3"],
        ),
        grease().value("weightless oil", "lubricant.viscosity.walther.density", json!(0), &["0.0 kg/m^3"]),
    ]
}

fn temperature() -> Vec<Row> {
    let place = "lubricant.viscosity.walther.temperature";
    let over_speed = |speed: Value, temperature: Value| {
        vec![(place, json!({"over_speed": {"speed": speed, "temperature": temperature}}))]
    };
    let over_time = |signal: Value| vec![(place, json!({"over_time": signal}))];
    let prescribed =
        json!({"prescribed": {"orbit_speed": {"constant": 140.0}, "spin_speed": {"constant": -1600.0}}});
    let driven = grease().with(&[("kinematic_elements.motion", prescribed), ("inner_ring", Value::Null)]);
    vec![
        grease().scene(
            "temperature swing out of range",
            &over_time(json!({"sine": {"mean": 313.0, "amplitude": 200.0, "frequency": 1.0, "phase": 0.0}})),
            "lubricant.viscosity.walther.temperature.over_time.sine.amplitude",
            &["200.0 K", "163 K"],
        ),
        grease().scene(
            "oil stiff as pitch",
            &over_time(json!({"constant": 225.0})),
            place,
            &["Pa s at 225.0 K", "1e-5 to 1e3 Pa s", "too far"],
        ),
        grease().json(
            "bare number for a temperature",
            place,
            json!(313.15),
            place,
            &["`over_speed`, found 313.15"],
        ),
        grease().json("no temperature", place, json!({}), place, &[]),
        grease().json(
            "unknown temperature",
            place,
            json!({"over_load": {}}),
            place,
            &["`over_load`", "`over_speed`"],
        ),
        grease().json("constant temperature", place, json!({"constant": 313.0}), place, &["`over_time`"]),
        grease().json(
            "two temperatures",
            "lubricant.viscosity.walther.temperature.over_speed",
            json!({}),
            place,
            &[],
        ),
        grease().json(
            "temperatures over speed missing",
            place,
            json!({"over_speed": {"speed": [0.0]}}),
            place,
            &["missing field `temperature`"],
        ),
        grease().json(
            "speeds of the temperatures missing",
            place,
            json!({"over_speed": {"temperature": [300.0]}}),
            place,
            &["missing field `speed`"],
        ),
        grease().json(
            "unknown field over speed",
            place,
            json!({"over_speed": {"speed": [0.0], "temperature": [300.0], "value": [1.0]}}),
            place,
            &["unknown field `value`"],
        ),
        grease().json(
            "number for the speeds",
            place,
            json!({"over_speed": {"speed": 0.0, "temperature": [300.0]}}),
            place,
            &["expected an array"],
        ),
        grease().scene(
            "temperature in degrees Celsius",
            &over_time(json!({"constant": 40})),
            "lubricant.viscosity.walther.temperature.over_time.constant",
            &["40.0 K is not within 150 to 1000 K", "degrees Celsius, 313.15 K"],
        ),
        grease().scene(
            "temperature table in degrees Celsius",
            &over_time(json!({"table": {"time": [0, 1], "value": [313, 40]}})),
            "lubricant.viscosity.walther.temperature.over_time.table.value.1",
            &["40.0 K"],
        ),
        grease().scene(
            "more speeds than temperatures",
            &over_speed(json!([0, 100, 200]), json!([300, 310])),
            "lubricant.viscosity.walther.temperature.over_speed.temperature",
            &["2 values for 3 points"],
        ),
        grease().scene(
            "speeds not growing",
            &over_speed(json!([0, 200, 100]), json!([300, 310, 320])),
            "lubricant.viscosity.walther.temperature.over_speed.speed.2",
            &["100.0 rad/s is not after 200.0 rad/s"],
        ),
        grease().scene(
            "speeds standing still",
            &over_speed(json!([100, 100]), json!([300, 310])),
            "lubricant.viscosity.walther.temperature.over_speed.speed.1",
            &["100.0 rad/s is not after 100.0 rad/s"],
        ),
        grease().scene(
            "no speeds",
            &over_speed(json!([]), json!([])),
            "lubricant.viscosity.walther.temperature.over_speed.speed",
            &["0 points"],
        ),
        grease().scene(
            "negative speed of a temperature",
            &over_speed(json!([-100, 100]), json!([300, 310])),
            "lubricant.viscosity.walther.temperature.over_speed.speed.0",
            &["-100.0 rad/s", "0 to 100000"],
        ),
        grease().scene(
            "speed of a temperature in rpm",
            &over_speed(json!([0, 150_000]), json!([300, 310])),
            "lubricant.viscosity.walther.temperature.over_speed.speed.1",
            &["150000.0 rad/s", "revolutions per minute"],
        ),
        grease().scene(
            "temperature over speed in degrees Celsius",
            &over_speed(json!([0, 300]), json!([300, 40])),
            "lubricant.viscosity.walther.temperature.over_speed.temperature.1",
            &["40.0 K"],
        ),
        driven.scene(
            "temperature over the speed of no ring",
            &over_speed(json!([0, 300]), json!([300, 310])),
            "inner_ring",
            &["missing", "lubricant.viscosity.walther.temperature"],
        ),
        grease().scene(
            "no viscosity at this temperature",
            &[
                (
                    "lubricant.viscosity.walther.hot",
                    json!({"temperature": 314.15, "kinematic_viscosity": 1e-6}),
                ),
                ("lubricant.viscosity.walther.temperature.over_time.constant", json!(200)),
            ],
            place,
            &["no viscosity at 200.0 K", "too far from its two points"],
        ),
    ]
}
