//! Malformed and impossible scenes: each is refused with the right status and one line that names the place.

mod common;

use cagedyn::{Model, Status};
use common::{example, example_text, remove, set};
use serde_json::{Value, json};

/// One bad scene.
struct Row {
    name: &'static str,
    text: String,
    status: Status,
    /// Start of the message: the JSON path, or empty where there is none (syntax).
    path: &'static str,
    /// What else the message must say.
    says: &'static [&'static str],
}

/// A whole text that is not a scene.
fn text(name: &'static str, text: &str, says: &'static [&'static str]) -> Row {
    Row { name, text: text.to_owned(), status: Status::BadJson, path: "", says }
}

/// The example with one piece of text replaced, for what a JSON value cannot express.
fn replaced(
    name: &'static str,
    from: &str,
    to: &str,
    path: &'static str,
    says: &'static [&'static str],
) -> Row {
    let text = example_text();
    assert!(text.contains(from), "{name}: the example has no {from}");
    Row { name, text: text.replacen(from, to, 1), status: Status::BadJson, path, says }
}

fn changed(
    name: &'static str,
    changes: Vec<(&str, Value)>,
    status: Status,
    path: &'static str,
    says: &'static [&'static str],
) -> Row {
    let mut scene = example();
    for (place, value) in changes {
        set(&mut scene, place, value);
    }
    Row { name, text: scene.to_string(), status, path, says }
}

/// Wrong types and fields: the place of the message is the place of the change.
fn json_row(
    name: &'static str,
    place: &'static str,
    value: Value,
    path: &'static str,
    says: &'static [&'static str],
) -> Row {
    changed(name, vec![(place, value)], Status::BadJson, path, says)
}

/// A value that is refused at its own place.
fn value_row(name: &'static str, path: &'static str, value: Value, says: &'static [&'static str]) -> Row {
    changed(name, vec![(path, value)], Status::BadScene, path, says)
}

/// Values that are refused at `path`.
fn scene_row(
    name: &'static str,
    changes: Vec<(&str, Value)>,
    path: &'static str,
    says: &'static [&'static str],
) -> Row {
    changed(name, changes, Status::BadScene, path, says)
}

/// The example without one field.
fn missing(name: &'static str, field: &str, path: &'static str, says: &'static [&'static str]) -> Row {
    let mut scene = example();
    remove(&mut scene, field);
    Row { name, text: scene.to_string(), status: Status::BadJson, path, says }
}

/// The example without one optional block that something else needs.
fn needed(name: &'static str, field: &str, path: &'static str, says: &'static [&'static str]) -> Row {
    Row { status: Status::BadScene, ..missing(name, field, path, says) }
}

fn syntax() -> Vec<Row> {
    let example = example_text();
    let nested = "[".repeat(100_000);
    let nested_object = r#"{"a":"#.repeat(100_000);
    vec![
        text("empty text", "", &["EOF", "line 1"]),
        text("blanks only", " \n\t ", &["EOF"]),
        text("not JSON", "bearing: NU2310", &["line 1 column 1"]),
        text("cut off", &example[..example.len() / 2], &["EOF"]),
        text("last brace missing", example.trim_end().strip_suffix('}').unwrap(), &["EOF"]),
        text("trailing garbage", &format!("{example} x"), &["trailing characters", "line"]),
        text("two scenes", &format!("{example}{example}"), &["trailing characters"]),
        text("byte order mark", &format!("\u{feff}{example}"), &["line 1 column 1"]),
        text("NUL in the text", &example.replacen('{', "{\0", 1), &["line 1"]),
        text("number for a scene", "12", &["invalid type"]),
        text("null for a scene", "null", &["invalid type"]),
        text("array for a scene", "[]", &["struct Scene"]),
        text("empty object", "{}", &["missing field", "schema"]),
        text("deep nesting of arrays", &nested, &["line 1"]),
        text("deep nesting of objects", &nested_object, &["unknown field `a`"]),
        replaced("deep nesting in a field", "12,", &nested, "rollers.count", &["line"]),
        replaced("comment", "\"gravity\"", "// weight\n\"gravity\"", "", &["line 4"]),
        replaced("trailing comma", "-9.80665 }", "-9.80665, }", "gravity", &["trailing comma"]),
        replaced("number beyond f64", "7.5e-3", "1e999", "rollers.radius", &["out of range"]),
        replaced("NaN", "7.5e-3", "NaN", "rollers.radius", &["line"]),
        replaced("infinity", "7.5e-3", "-Infinity", "rollers.radius", &["line"]),
        replaced("decimal comma", "0.0304", "0,0304", "rollers", &["line"]),
        replaced("hexadecimal", "\"count\": 12", "\"count\": 0x0c", "rollers", &["line"]),
        replaced("plus sign", "0.0304", "+0.0304", "rollers.mass", &["line"]),
        replaced("unit in a number", "7.5e-3", "7.5 mm", "rollers", &["line"]),
        replaced("raw line break in a text", "NU2310,", "NU2310\n", "title", &["line"]),
        replaced(
            "doubled field",
            "\"count\": 12",
            "\"count\": 12, \"count\": 13",
            "rollers",
            &["duplicate field `count`"],
        ),
        replaced(
            "doubled block",
            "\"gravity\"",
            "\"gravity\": { \"y\": 0.0, \"z\": 0.0 }, \"gravity\"",
            "",
            &["duplicate field `gravity`"],
        ),
        replaced("doubled material", "\"brass\":", "\"steel\":", "materials", &["steel"]),
    ]
}

fn fields_and_types() -> Vec<Row> {
    let pocket = "cage.pocket.lubricated_cylinder.contact.boundary_friction";
    vec![
        json_row(
            "unknown field at the top",
            "bearing",
            json!("NU2310"),
            "bearing",
            &["unknown field `bearing`"],
        ),
        json_row(
            "unknown field in rollers",
            "rollers.diameter",
            json!(15e-3),
            "rollers.diameter",
            &["unknown field", "`radius`"],
        ),
        json_row(
            "unknown field four levels deep",
            "cage.pocket.lubricated_cylinder.contact.boundary_friction.mu",
            json!(0.1),
            "cage.pocket.lubricated_cylinder.contact.boundary_friction.mu",
            &["unknown field `mu`", "`coefficient`"],
        ),
        json_row("unknown field in a vector", "gravity.x", json!(0.0), "gravity.x", &["unknown field `x`"]),
        json_row(
            "unknown field in a material",
            "materials.steel.thermal.colour",
            json!("grey"),
            "materials.steel.thermal.colour",
            &["unknown field `colour`"],
        ),
        json_row(
            "unknown field in a signal",
            "inner_ring.speed",
            json!({"step": {"before": 0.0, "after": 1.0, "at": 1.0}}),
            "inner_ring.speed.step.at",
            &["unknown field `at`", "`time`"],
        ),
        json_row(
            "unknown field in the solver",
            "solver",
            json!({"rtol": 1e-6}),
            "solver.rtol",
            &["unknown field `rtol`"],
        ),
        json_row(
            "unknown signal",
            "inner_ring.speed",
            json!({"cosine": 1.0}),
            "inner_ring.speed",
            &["unknown variant `cosine`", "`constant`"],
        ),
        json_row(
            "bare number for a signal",
            "inner_ring.speed",
            json!(-314.0),
            "inner_ring.speed",
            &["line"],
        ),
        json_row(
            "two signals at once",
            "inner_ring.speed",
            json!({"constant": 1.0, "sine": {}}),
            "inner_ring.speed",
            &[],
        ),
        json_row("no signal", "inner_ring.speed", json!({}), "inner_ring.speed", &[]),
        json_row(
            "ring fixed and free",
            "inner_ring.motion.fixed",
            json!({"y": 0.0, "z": 0.0}),
            "inner_ring.motion",
            &[],
        ),
        json_row(
            "unknown film law",
            "raceways.contact.film",
            json!("dowson_higginson"),
            "raceways.contact.film",
            &["unknown variant", "pan_hamrock"],
        ),
        json_row(
            "unknown thermal correction",
            "cage.pocket.lubricated_cylinder.contact.thermal_correction",
            json!("Gupta"),
            "cage.pocket.lubricated_cylinder.contact.thermal_correction",
            &["unknown variant", "gupta"],
        ),
        json_row(
            "unknown traction law",
            "raceways.contact.traction",
            json!("coulomb"),
            "raceways.contact.traction",
            &["muraki_kimura"],
        ),
        json_row(
            "unknown start",
            "initial.inner_ring",
            json!("static"),
            "initial.inner_ring",
            &["equilibrium"],
        ),
        json_row(
            "unknown guide",
            "cage.guide",
            json!({"roller_guided": {}}),
            "cage.guide",
            &["short_bearing"],
        ),
        json_row(
            "unknown method",
            "solver",
            json!({"method": {"rk4": {}}}),
            "solver.method",
            &["unknown variant `rk4`", "leapfrog"],
        ),
        json_row(
            "unknown extent",
            "raceways.rolling_resistance.extent",
            json!("none"),
            "raceways.rolling_resistance.extent",
            &["`all`"],
        ),
        json_row(
            "text for a number",
            "rollers.radius",
            json!("7.5e-3"),
            "rollers.radius",
            &["7.5e-3", "f64"],
        ),
        json_row(
            "number for a text",
            "rollers.material",
            json!(1),
            "rollers.material",
            &["expected a string"],
        ),
        json_row("block for a number", "cage.mass", json!({"kg": 0.37}), "cage.mass", &["expected f64"]),
        json_row("number for a block", "cage.pocket", json!(0.15), "cage.pocket", &["0.15"]),
        json_row(
            "array for a number",
            "lubricant.viscosity.constant",
            json!([0.06]),
            "lubricant.viscosity.constant",
            &["sequence"],
        ),
        json_row("array for a vector", "gravity", json!([0.0, -9.80665]), "gravity", &["sequence"]),
        json_row(
            "array for a block",
            "initial",
            json!(["centred", 0.0, {"y": 0.0, "z": 0.0}]),
            "initial",
            &["sequence"],
        ),
        json_row("true for a law", "raceways.contact.film", json!(true), "raceways.contact.film", &["line"]),
        json_row(
            "number for a flag",
            "cage.guide.film.short_bearing.squeeze",
            json!(1),
            "cage.guide.film.short_bearing.squeeze",
            &["bool"],
        ),
        json_row("null for a number", "rollers.mass", Value::Null, "rollers.mass", &["null"]),
        json_row("fractional count", "rollers.count", json!(12.5), "rollers.count", &["12.5"]),
        json_row("negative count", "rollers.count", json!(-12), "rollers.count", &["-12"]),
        json_row(
            "count beyond u32",
            "rollers.count",
            json!(4_294_967_296u64),
            "rollers.count",
            &["4294967296"],
        ),
        json_row("negative step limit", "solver", json!({"max_steps": -1}), "solver.max_steps", &["-1"]),
        json_row("material as a name", "materials.steel", json!("steel"), "materials.steel", &["steel"]),
        missing("schema missing", "schema", "", &["missing field `schema`"]),
        missing("rollers missing", "rollers", "", &["missing field `rollers`"]),
        missing("record missing", "record", "", &["missing field `record`"]),
        missing("roller mass missing", "rollers.mass", "rollers", &["missing field `mass`"]),
        missing("motion missing", "inner_ring.motion", "inner_ring", &["missing field `motion`"]),
        missing(
            "load component missing",
            "inner_ring.motion.free.load.y",
            "inner_ring.motion.free.load",
            &["missing field `y`"],
        ),
        missing("vector component missing", "gravity.y", "gravity", &["missing field `y`"]),
        missing(
            "Poisson's ratio missing",
            "materials.brass.poisson_ratio",
            "materials.brass",
            &["missing field `poisson_ratio`"],
        ),
        missing(
            "friction constant missing",
            "cage.pocket.lubricated_cylinder.contact.boundary_friction.roughness",
            pocket,
            &["missing field `roughness`"],
        ),
        missing(
            "land width missing",
            "cage.guide.film.short_bearing.land_width",
            "cage.guide.short_bearing",
            &["missing field `land_width`"],
        ),
        json_row(
            "roundness phase missing",
            "cage.guide.roundness",
            json!([{"order": 2, "amplitude": 0.0, "phase": 0.0}, {"order": 3, "amplitude": 0.0}]),
            "cage.guide.roundness.1",
            &["missing field `phase`"],
        ),
    ]
}

fn ranges_and_units() -> Vec<Row> {
    let thermal = "materials.steel.thermal.conductivity";
    vec![
        value_row("empty format name", "schema", json!(""), &["cagedyn.scene/1"]),
        value_row(
            "format of the future",
            "schema",
            json!("cagedyn.scene/2"),
            &["'cagedyn.scene/2'", "'cagedyn.scene/1'"],
        ),
        value_row("format of a case set", "schema", json!("cagedyn.cases/1"), &["cagedyn.cases/1"]),
        value_row(
            "guide clearance in mm",
            "cage.guide.diametral_clearance",
            json!(0.445),
            &["0.445 m", "1e-2 m", "milli"],
        ),
        value_row(
            "radial clearance in mm",
            "inner_ring.radial_clearance",
            json!(0.04),
            &["0.04 m", "milli", "4e-5"],
        ),
        value_row(
            "radial clearance in um",
            "inner_ring.radial_clearance",
            json!(40),
            &["40.0 m", "micro", "4e-5"],
        ),
        value_row(
            "Young's modulus in GPa",
            "materials.steel.young_modulus",
            json!(206),
            &["206.0 Pa", "giga"],
        ),
        value_row(
            "Young's modulus in MPa",
            "materials.brass.young_modulus",
            json!(1.03e5),
            &["103000.0 Pa", "mega"],
        ),
        value_row(
            "viscosity in uPa s",
            "lubricant.viscosity.constant",
            json!(60_000),
            &["60000.0 Pa s", "1e-5 to 1e3", "micro"],
        ),
        value_row("shear modulus in GPa", "lubricant.shear_modulus", json!(0.3), &["0.3 Pa", "giga"]),
        value_row("Eyring stress in MPa", "lubricant.eyring_stress", json!(5), &["5.0 Pa", "mega"]),
        value_row(
            "pressure-viscosity in 1/GPa",
            "lubricant.pressure_viscosity",
            json!(20),
            &["20.0 1/Pa", "1e-10 to 1e-6"],
        ),
        value_row("roller radius in mm", "rollers.radius", json!(7.5), &["7.5 m", "milli", "7.5e-3"]),
        value_row("raceway radius in mm", "outer_ring.raceway_radius", json!(47.5), &["47.5 m", "milli"]),
        value_row("roller length in mm", "rollers.effective_length", json!(20.4), &["20.4 m", "milli"]),
        value_row(
            "ring speed in rpm",
            "inner_ring.speed.constant",
            json!(-150_000),
            &["-150000.0 rad/s", "revolutions per minute"],
        ),
        value_row(
            "pocket clearance in mm",
            "cage.pocket.lubricated_cylinder.radial_clearance",
            json!(0.15),
            &["0.15 m", "milli"],
        ),
        value_row(
            "pocket angle in degrees",
            "cage.pocket.lubricated_cylinder.half_angle",
            json!(25),
            &["25.0 rad"],
        ),
        value_row(
            "roughness in um",
            "raceways.contact.boundary_friction.roughness",
            json!(0.1),
            &["0.1 m", "micro"],
        ),
        value_row("density in g/cm^3", "materials.steel.thermal.density", json!(7.83), &["7.83 kg/m^3"]),
        value_row("roller mass in grams", "rollers.mass", json!(30.4e6), &["30400000.0 kg"]),
        scene_row(
            "roller mass and inertia apart",
            vec![("rollers.mass", json!(30.4))],
            "rollers.inertia",
            &["8.55e-7 kg m^2"],
        ),
        value_row("negative roller mass", "rollers.mass", json!(-0.0304), &["-0.0304 kg", "1e-7 to 1e6"]),
        value_row("zero cage mass", "cage.mass", json!(0), &["0.0 kg"]),
        value_row("negative ring mass", "inner_ring.motion.free.mass", json!(-3), &["-3.0 kg"]),
        value_row("negative cage inertia", "cage.inertia", json!(-6e-4), &["-0.0006 kg m^2"]),
        value_row("cage inertia of another cage", "cage.inertia", json!(6e-2), &["kg m^2"]),
        value_row(
            "negative support damping",
            "inner_ring.motion.free.support_damping",
            json!(-1.0),
            &["-1.0 N s/m"],
        ),
        value_row("huge load", "inner_ring.motion.free.load.z.constant", json!(-4.9e12), &["N"]),
        value_row("huge gravity", "gravity.z", json!(-1e5), &["m/s^2"]),
        value_row("negative viscosity", "lubricant.viscosity.constant", json!(-0.06), &["-0.06 Pa s"]),
        value_row("zero conductivity", "lubricant.conductivity", json!(0), &["W/(m K)"]),
        value_row(
            "huge temperature-viscosity coefficient",
            "lubricant.temperature_viscosity",
            json!(40),
            &["1/K", "milli"],
        ),
        value_row("incompressible", "materials.steel.poisson_ratio", json!(0.5), &["0.5", "4.99e-1"]),
        value_row("negative Poisson's ratio", "materials.brass.poisson_ratio", json!(-0.1), &["-0.1"]),
        value_row("no heat conduction", thermal, json!(0.0), &["0.0 W/(m K)"]),
        value_row(
            "heat capacity in kJ",
            "materials.brass.thermal.specific_heat",
            json!(0.38),
            &["J/(kg K)", "kilo"],
        ),
        value_row("no rollers", "rollers.count", json!(0), &["0 is not within 1 to 1000"]),
        value_row("1001 rollers", "rollers.count", json!(1001), &["1001 is not within 1 to 1000"]),
        value_row(
            "negative relaxation time",
            "raceways.contact.damping.relaxation_time",
            json!(-5e-7),
            &["-5e-7 s"],
        ),
        value_row(
            "zero softening depth",
            "cage.pocket.lubricated_cylinder.contact.damping.softening_depth",
            json!(0),
            &["0.0 m"],
        ),
        value_row(
            "negative friction",
            "cage.pocket.lubricated_cylinder.edge_friction.coefficient",
            json!(-0.1),
            &["-0.1"],
        ),
        value_row(
            "zero transition speed",
            "raceways.contact.boundary_friction.transition_speed",
            json!(0),
            &["0.0 m/s"],
        ),
        value_row(
            "regimes the wrong way round",
            "raceways.contact.boundary_friction.lambda_full",
            json!(0.05),
            &["0.05"],
        ),
        scene_row(
            "zero load threshold",
            vec![("raceways.rolling_resistance.extent", json!({"loaded": {"threshold": 0}}))],
            "raceways.rolling_resistance.extent.loaded.threshold",
            &["0.0 N"],
        ),
        value_row(
            "blend beyond the wall",
            "cage.pocket.lubricated_cylinder.edge_blend",
            json!(0.5),
            &["0.5 rad"],
        ),
        value_row(
            "negative blend",
            "cage.pocket.lubricated_cylinder.edge_blend",
            json!(-0.01),
            &["-0.01 rad"],
        ),
        value_row(
            "wall of half a turn",
            "cage.pocket.lubricated_cylinder.half_angle",
            json!(1.6),
            &["1.6 rad"],
        ),
        value_row("zero land width", "cage.guide.film.short_bearing.land_width", json!(0), &["0.0 m"]),
        value_row("guide far from the bearing", "cage.guide.guide_radius", json!(0.1), &["0.1 m"]),
        value_row(
            "first roller angle in degrees of many turns",
            "initial.first_roller_angle",
            json!(1e4),
            &["10000.0 rad"],
        ),
        scene_row(
            "zero minimum step",
            vec![("solver", json!({"min_step": 0}))],
            "solver.min_step",
            &["0.0 s", "1e-18 to 1e-6"],
        ),
        scene_row(
            "huge minimum step",
            vec![("solver", json!({"min_step": 1}))],
            "solver.min_step",
            &["1.0 s", "nano"],
        ),
        scene_row(
            "no steps",
            vec![("solver", json!({"max_steps": 0}))],
            "solver.max_steps",
            &["0 is not allowed"],
        ),
        scene_row(
            "zero tolerance",
            vec![("solver", json!({"method": {"dormand_prince": {"tolerance": 0}}}))],
            "solver.method.dormand_prince.tolerance",
            &["0.0", "1e-12 to 1e-1"],
        ),
        scene_row(
            "tolerance of one",
            vec![("solver", json!({"method": {"dormand_prince": {"tolerance": 1}}}))],
            "solver.method.dormand_prince.tolerance",
            &["1.0"],
        ),
        scene_row(
            "step in us",
            vec![("solver", json!({"method": {"leapfrog": {"step": 0.5}}}))],
            "solver.method.leapfrog.step",
            &["0.5 s", "micro"],
        ),
        scene_row(
            "step below the smallest step",
            vec![("solver", json!({"method": {"leapfrog": {"step": 1e-8}}, "min_step": 1e-7}))],
            "solver.method.leapfrog.step",
            &["1e-8 s"],
        ),
        value_row("no duration", "record.duration", json!(0), &["0.0 s"]),
        value_row("negative interval", "record.interval", json!(-5e-4), &["-0.0005 s"]),
        value_row("interval longer than the run", "record.interval", json!(0.5), &["0.5 s", "3e-1 s"]),
        value_row("too many records", "record.interval", json!(1e-9), &["3e8 records", "1e8"]),
    ]
}

fn geometry_and_references() -> Vec<Row> {
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
        scene_row("no materials", vec![("materials", json!({}))], "rollers.material", &["'steel'"]),
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
            &["no film", "0.0002225 m"],
        ),
        scene_row(
            "cage starts within the roundness",
            vec![
                ("initial.cage", json!({"y": 2e-4, "z": 0.0})),
                ("cage.guide.roundness", json!([{"order": 2, "amplitude": 3e-5, "phase": 0.0}])),
            ],
            "initial.cage",
            &["no film"],
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

fn signals() -> Vec<Row> {
    let speed = |signal: Value| vec![("inner_ring.speed", signal)];
    let table = |time: Value, value: Value| speed(json!({"table": {"time": time, "value": value}}));
    let load = vec![("inner_ring.motion.free.load.y", json!({"table": {"time": [0, 1], "value": [0, 2e9]}}))];
    vec![
        scene_row("empty table", table(json!([]), json!([])), "inner_ring.speed.table.time", &["0 points"]),
        scene_row(
            "unequal table",
            table(json!([0, 1]), json!([0])),
            "inner_ring.speed.table.value",
            &["1 values for 2 times"],
        ),
        scene_row(
            "table going back",
            table(json!([0, 2, 1]), json!([0, 0, 0])),
            "inner_ring.speed.table.time.2",
            &["1.0 s is not after 2.0 s"],
        ),
        scene_row(
            "table standing still",
            table(json!([0, 0]), json!([0, 1])),
            "inner_ring.speed.table.time.1",
            &["0.0 s is not after 0.0 s"],
        ),
        scene_row(
            "table before zero",
            table(json!([-1, 0]), json!([0, 1])),
            "inner_ring.speed.table.time.0",
            &["-1.0 s"],
        ),
        scene_row(
            "table value out of range",
            load,
            "inner_ring.motion.free.load.y.table.value.1",
            &["2000000000.0 N"],
        ),
        scene_row(
            "ramp ends before it starts",
            speed(json!({"ramp": {"from": 0, "to": -314, "start": 0.2, "end": 0.1}})),
            "inner_ring.speed.ramp.end",
            &["0.1 s is not after the start 0.2 s"],
        ),
        scene_row(
            "ramp of no length",
            speed(json!({"ramp": {"from": 0, "to": -314, "start": 0.2, "end": 0.2}})),
            "inner_ring.speed.ramp.end",
            &["0.2 s"],
        ),
        scene_row(
            "step before zero",
            speed(json!({"step": {"before": 0, "after": 1, "time": -1e-3}})),
            "inner_ring.speed.step.time",
            &["-0.001 s"],
        ),
        scene_row(
            "negative frequency",
            speed(json!({"sine": {"mean": 0, "amplitude": 1, "frequency": -50, "phase": 0}})),
            "inner_ring.speed.sine.frequency",
            &["-50.0 Hz"],
        ),
        scene_row(
            "sine amplitude out of range",
            speed(json!({"sine": {"mean": 0, "amplitude": 1e6, "frequency": 50, "phase": 0}})),
            "inner_ring.speed.sine.amplitude",
            &["1000000.0 rad/s"],
        ),
    ]
}

fn laws() -> Vec<Row> {
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

fn rows() -> Vec<Row> {
    let parts =
        [syntax(), fields_and_types(), ranges_and_units(), geometry_and_references(), signals(), laws()];
    parts.into_iter().flatten().collect()
}

/// What is wrong with the answer to a row; `None` if nothing is.
fn complaint(row: &Row) -> Option<String> {
    let error = match Model::from_json(&row.text) {
        Ok(_) => return Some("accepted".to_owned()),
        Err(error) => error,
    };
    let message = &error.message;
    let mut wrong = Vec::new();
    if error.status != row.status {
        wrong.push(format!("status {:?} instead of {:?}", error.status, row.status));
    }
    if message.trim().is_empty() || message.chars().any(char::is_control) {
        wrong.push("not one line of text".to_owned());
    }
    let rest = message.strip_prefix(row.path);
    if !row.path.is_empty() && !rest.is_some_and(|rest| rest.starts_with([':', '.'])) {
        wrong.push(format!("does not start with the path {}", row.path));
    }
    for part in row.says.iter().filter(|part| !message.contains(**part)) {
        wrong.push(format!("does not say '{part}'"));
    }
    (!wrong.is_empty()).then(|| format!("{}; message: {message}", wrong.join(", ")))
}

#[test]
fn every_bad_scene_is_refused_with_a_message_that_helps() {
    let rows = rows();
    assert!(rows.len() >= 75, "only {} rows", rows.len());
    let complaints: Vec<String> =
        rows.iter().filter_map(|row| complaint(row).map(|text| format!("{}: {text}", row.name))).collect();
    assert!(complaints.is_empty(), "{} of {}:\n{}", complaints.len(), rows.len(), complaints.join("\n"));
}

#[test]
fn the_example_itself_is_accepted() {
    Model::from_json(&example_text()).unwrap();
    Model::from_json(&example().to_string()).unwrap();
}

#[test]
fn names_of_rows_are_unique() {
    let rows = rows();
    for (i, row) in rows.iter().enumerate() {
        assert!(rows[..i].iter().all(|other| other.name != row.name), "{} is used twice", row.name);
    }
}

#[test]
fn messages_stay_on_one_line_whatever_the_names() {
    for name in ["two\nlines", "\r\n", "tab\tand \u{1b}[31m colour", "\u{2028}"] {
        let mut scene = example();
        set(&mut scene, "rollers.material", json!(name));
        let error = Model::from_json(&scene.to_string()).unwrap_err();
        assert_eq!(error.status, Status::BadScene);
        assert!(error.message.starts_with("rollers.material: "), "{error}");
        assert_eq!(error.message.lines().count(), 1, "{error}");
    }
}
