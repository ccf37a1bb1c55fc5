//! Rolling elements and rings: what belongs together and what excludes each other, prescribed motion.

use super::table::*;
use serde_json::{Value, json};

pub fn rows() -> Vec<Row> {
    [together(), kinematic(), motion()].into_iter().flatten().collect()
}

fn together() -> Vec<Row> {
    let rollers_block = json!({"count": 12, "radius": 7.5e-3, "effective_length": 20.4e-3, "mass": 0.0304,
        "inertia": 8.55e-7, "material": "steel"});
    let steel = json!({"steel": {"young_modulus": 206e9, "poisson_ratio": 0.3}});
    let free = json!({"free": {"mass": 3.0}});
    let prescribed =
        json!({"prescribed": {"orbit_speed": {"constant": 140.0}, "spin_speed": {"constant": -1600.0}}});
    let driven = grease().with(&[("kinematic_elements.motion", prescribed), ("inner_ring", Value::Null)]);
    let not_beside = &["not allowed beside 'kinematic_elements'", "remove it"];
    vec![
        grease().scene(
            "element that covers the centre",
            &[("kinematic_elements.count", json!(1)), ("kinematic_elements.radius", json!(0.2))],
            "kinematic_elements.radius",
            &["0.2 m", "pitch radius 0.045 m"],
        ),
        rollers().needed("no elements", "rollers", "rollers", &["missing", "'kinematic_elements'"]),
        grease().needed("no elements for a cage", "kinematic_elements", "rollers", &["kinematic_elements"]),
        grease().scene(
            "rollers and kinematic elements",
            &[("rollers", rollers_block), ("materials", steel.clone())],
            "kinematic_elements",
            &["not allowed beside 'rollers'", "remove one"],
        ),
        rollers().needed("rollers without outer ring", "outer_ring", "outer_ring", &["'rollers' need it"]),
        rollers().needed("rollers without inner ring", "inner_ring", "inner_ring", &["'rollers' need it"]),
        rollers().needed("rollers without raceways", "raceways", "raceways", &["'rollers' need it"]),
        rollers().needed(
            "rollers without clearance",
            "inner_ring.radial_clearance",
            "inner_ring.radial_clearance",
            &["missing; 'rollers' need it"],
        ),
        rollers().needed(
            "rollers without ring material",
            "inner_ring.material",
            "inner_ring.material",
            &["missing; 'rollers' need it"],
        ),
        rollers().needed(
            "equilibrium of a ring without motion",
            "inner_ring.motion",
            "initial.inner_ring",
            &["'equilibrium' needs a free inner ring"],
        ),
        grease().scene(
            "outer raceway beside kinematic elements",
            &[
                ("materials", steel.clone()),
                ("outer_ring", json!({"raceway_radius": 0.05, "material": "steel"})),
            ],
            "outer_ring.raceway_radius",
            not_beside,
        ),
        grease().scene(
            "crown of an outer raceway beside kinematic elements",
            &[("outer_ring", json!({"raceway_crown_radius": 5.0}))],
            "outer_ring.raceway_crown_radius",
            not_beside,
        ),
        grease().scene(
            "unneeded material of the outer ring unknown",
            &[("outer_ring", json!({"material": "steel"}))],
            "outer_ring.material",
            &["'steel' is not one of the materials"],
        ),
        rollers().needed(
            "rollers without outer raceway",
            "outer_ring.raceway_radius",
            "outer_ring.raceway_radius",
            &["missing; 'rollers' need it"],
        ),
        rollers().needed(
            "rollers without material of the outer ring",
            "outer_ring.material",
            "outer_ring.material",
            &["missing; 'rollers' need it"],
        ),
        rollers().scene(
            "outer ring faster than anything",
            &[("outer_ring.speed", json!({"constant": 3e5}))],
            "outer_ring.speed.constant",
            &["300000.0 rad/s"],
        ),
        warm().scene(
            "outer ring that turns beside a heat balance",
            &[("outer_ring", json!({"speed": {"constant": 10.0}}))],
            "outer_ring.speed",
            &["not allowed beside 'heat'"],
        ),
        grease().scene(
            "raceways beside kinematic elements",
            &[("raceways", json!({}))],
            "raceways",
            not_beside,
        ),
        grease().value("free ring without rollers", "inner_ring.motion", free, &["'rollers'", "'fixed'"]),
        grease().needed(
            "elements roll on no ring",
            "inner_ring",
            "inner_ring",
            &["missing", "kinematic_elements.motion.rolling"],
        ),
        grease().needed(
            "kinematic elements without cage",
            "cage",
            "cage",
            &["missing", "kinematic_elements"],
        ),
        grease().value(
            "equilibrium of kinematic elements",
            "initial.inner_ring",
            json!("equilibrium"),
            &["'rollers'", "'centred'"],
        ),
        grease().value(
            "unneeded ring material unknown",
            "inner_ring.material",
            json!("steel"),
            &["'steel' is not one of the materials"],
        ),
        grease().value(
            "unneeded clearance in um",
            "inner_ring.radial_clearance",
            json!(40),
            &["40.0 m", "micro"],
        ),
        driven.scene(
            "cage guided by no inner ring",
            &[("cage.guide.ring", json!("inner_ring"))],
            "inner_ring",
            &["missing; cage.guide.ring needs it"],
        ),
    ]
}

fn kinematic() -> Vec<Row> {
    let elements = "kinematic_elements";
    vec![
        grease().value(
            "no kinematic elements",
            "kinematic_elements.count",
            json!(0),
            &["0 is not within 1 to 1000"],
        ),
        grease().value("1001 kinematic elements", "kinematic_elements.count", json!(1001), &["1001 is not"]),
        grease().value(
            "overlapping kinematic elements",
            "kinematic_elements.count",
            json!(33),
            &["33 elements of radius 0.0043655 m overlap", "0.045 m"],
        ),
        grease().value("element radius in mm", "kinematic_elements.radius", json!(7.5), &["m", "milli"]),
        grease().value("zero element radius", "kinematic_elements.radius", json!(0), &["0.0 m", "1e-4 to 5"]),
        grease().value(
            "pitch radius in mm",
            "kinematic_elements.pitch_radius",
            json!(45),
            &["45.0 m", "0.045 m"],
        ),
        grease().value(
            "negative pitch radius",
            "kinematic_elements.pitch_radius",
            json!(-0.045),
            &["-0.045 m", "1e-4 to 5"],
        ),
        grease().value(
            "element length in mm",
            "kinematic_elements.effective_length",
            json!(20.4),
            &["20.4 m", "milli"],
        ),
        grease().value("zero element length", "kinematic_elements.effective_length", json!(0), &["0.0 m"]),
        grease().value(
            "element material unknown",
            "kinematic_elements.material",
            json!("steel"),
            &["'steel' is not one of the materials"],
        ),
        grease().json(
            "half an element",
            "kinematic_elements.count",
            json!(25.5),
            "kinematic_elements.count",
            &["25.5"],
        ),
        grease().json(
            "elements as a count",
            elements,
            json!(25),
            elements,
            &["expected an object, found 25"],
        ),
        grease().json(
            "unknown field in kinematic elements",
            "kinematic_elements.mass",
            json!(1e-3),
            "kinematic_elements.mass",
            &["unknown field `mass`", "`pitch_radius`"],
        ),
        grease().json(
            "element length as a text",
            "kinematic_elements.effective_length",
            json!("20 mm"),
            "kinematic_elements.effective_length",
            &["20 mm", "expected a number"],
        ),
        grease().missing(
            "element count missing",
            "kinematic_elements.count",
            elements,
            &["missing field `count`"],
        ),
        grease().missing(
            "element radius missing",
            "kinematic_elements.radius",
            elements,
            &["missing field `radius`"],
        ),
        grease().missing(
            "pitch radius missing",
            "kinematic_elements.pitch_radius",
            elements,
            &["missing field `pitch_radius`"],
        ),
        grease().missing(
            "element motion missing",
            "kinematic_elements.motion",
            elements,
            &["missing field `motion`"],
        ),
        replaced_in_grease("element radius NaN", "4.3655e-3", "NaN", "kinematic_elements.radius", &["line"]),
        replaced_in_grease(
            "pitch radius beyond f64",
            "45e-3",
            "45e400",
            "kinematic_elements.pitch_radius",
            &["out of range"],
        ),
    ]
}

fn motion() -> Vec<Row> {
    let place = "kinematic_elements.motion";
    let prescribed =
        |orbit: Value, spin: Value| json!({"prescribed": {"orbit_speed": orbit, "spin_speed": spin}});
    let constant = |speed: f64| json!({"constant": speed});
    vec![
        grease().value(
            "contact angle in degrees",
            "kinematic_elements.motion.rolling.contact_angle",
            json!(18),
            &["18.0 rad is not within -1.5 to 1.5 rad", "degrees, 0.314159 rad"],
        ),
        grease().value(
            "contact angle beyond a quarter turn",
            "kinematic_elements.motion.rolling.contact_angle",
            json!(-1.6),
            &["-1.6 rad"],
        ),
        grease().missing(
            "contact angle missing",
            "kinematic_elements.motion.rolling.contact_angle",
            place,
            &["missing field `contact_angle`"],
        ),
        grease().json("motion as a word", place, json!("rolling"), place, &["rolling"]),
        grease().json("no motion", place, json!({}), place, &[]),
        grease().json("unknown motion", place, json!({"sliding": {}}), place, &["`sliding`", "`prescribed`"]),
        grease().json("two motions", "kinematic_elements.motion.prescribed", json!({}), place, &[]),
        grease().json(
            "unknown field in the motion",
            "kinematic_elements.motion.rolling.speed",
            constant(1.0),
            place,
            &["unknown field `speed`", "`contact_angle`"],
        ),
        grease().json(
            "orbit speed missing",
            place,
            json!({"prescribed": {"spin_speed": {"constant": 1.0}}}),
            place,
            &["missing field `orbit_speed`"],
        ),
        grease().json(
            "spin speed missing",
            place,
            json!({"prescribed": {"orbit_speed": {"constant": 1.0}}}),
            place,
            &["missing field `spin_speed`"],
        ),
        grease().json(
            "truth value for an orbit speed",
            place,
            prescribed(json!(true), constant(-1600.0)),
            "kinematic_elements.motion.prescribed",
            &["found true"],
        ),
        grease().scene(
            "orbit speed in rpm",
            &[(place, prescribed(constant(136e3), constant(-1600.0)))],
            "kinematic_elements.motion.prescribed.orbit_speed.constant",
            &["136000.0 rad/s", "revolutions per minute"],
        ),
        grease().scene(
            "spin speed in rpm",
            &[(place, prescribed(constant(140.0), constant(-153e3)))],
            "kinematic_elements.motion.prescribed.spin_speed.constant",
            &["-153000.0 rad/s", "revolutions per minute"],
        ),
        grease().scene(
            "orbit ramp going back",
            &[(
                place,
                prescribed(json!({"ramp": {"from": 0, "to": 140, "start": 1, "end": 0.5}}), constant(0.0)),
            )],
            "kinematic_elements.motion.prescribed.orbit_speed.ramp.end",
            &["0.5 s is not after the start 1.0 s"],
        ),
    ]
}
