//! The scenes, case sets and JSON Schemas of the repository fit each other and the library.

use crate::common::{example_with, read, repository, with};
use cagedyn::scene::CaseSet;
use cagedyn::{Model, Scene, Status};
use serde_json::{Value, json};

/// Paths of all files in `scenes/`, relative to the repository: scenes and case sets.
fn files() -> (Vec<String>, Vec<String>) {
    let mut names: Vec<String> = std::fs::read_dir(repository("scenes"))
        .expect("the repository has scenes")
        .map(|entry| entry.expect("readable").file_name().into_string().expect("UTF-8"))
        .filter(|name| name.ends_with(".json"))
        .map(|name| format!("scenes/{name}"))
        .collect();
    names.sort();
    names.into_iter().partition(|name| !name.ends_with(".cases.json"))
}

/// The example with kinematic elements.
const GREASE: &str = "scenes/grease_guide.json";

/// Changes of that example that leave a valid scene.
fn grease_variants() -> Vec<(&'static str, Vec<(&'static str, Value)>)> {
    let prescribed = json!({"prescribed": {
        "orbit_speed": {"constant": 142.5},
        "spin_speed": {"ramp": {"from": 0.0, "to": -1500.0, "start": 0.0, "end": 1.0 / 3.0}}
    }});
    let short = json!({"short_bearing": {"land_width": 8e-3, "squeeze": true}});
    let round = json!([{"order": 3, "amplitude": 1e-5, "phase": 0.1}]);
    let steel = json!({"steel": {"young_modulus": 206e9, "poisson_ratio": 0.3}});
    let cylinder = json!({"lubricated_cylinder": {
        "radial_clearance": 0.2e-3, "half_angle": 0.4, "edge_blend": 0.02, "contact": {"film": "pan_hamrock"}
    }});
    vec![
        (
            "cage alone",
            vec![("cage.guide", Value::Null), ("cage.pocket", Value::Null), ("lubricant", Value::Null)],
        ),
        ("no inner ring", vec![("kinematic_elements.motion", prescribed), ("inner_ring", Value::Null)]),
        (
            "temperature over speed",
            vec![(
                "lubricant.viscosity.walther.temperature",
                json!({"over_speed": {"speed": [0.0, 100.0, 1000.0], "temperature": [293.1, 303.3, 350.0]}}),
            )],
        ),
        (
            "temperature over time",
            vec![(
                "lubricant.viscosity.walther.temperature.over_time",
                json!({"table": {"time": [0.0, 0.1], "value": [300.1, 350.0]}}),
            )],
        ),
        ("constant viscosity", vec![("lubricant.viscosity", json!({"constant": 0.1}))]),
        (
            "layer alone",
            vec![
                ("cage.guide.solid", Value::Null),
                ("cage.guide.film_share", Value::Null),
                ("cage.guide.roundness", round.clone()),
            ],
        ),
        (
            "layer options",
            vec![
                ("cage.guide.film.lubricant_layer.pressure_cap", json!(0.7)),
                ("cage.guide.film.lubricant_layer.pressure_shear", json!("with_edges")),
                ("cage.guide.film_share.touching_ratio", json!(0.0)),
                ("cage.guide.solid.asperity_height", json!(1e-6 / 3.0)),
            ],
        ),
        ("solid alone", vec![("cage.guide.film", Value::Null), ("cage.guide.film_share", Value::Null)]),
        (
            "oil and solid on the inner ring",
            vec![
                ("cage.guide.ring", json!("inner_ring")),
                ("cage.guide.guide_radius", json!(42e-3)),
                ("cage.guide.film", short),
                ("cage.guide.roundness", round),
                ("inner_ring.motion", json!({"fixed": {"y": 1e-5, "z": 0.0}})),
            ],
        ),
        (
            "lubricated pockets",
            vec![
                ("materials", steel),
                ("kinematic_elements.material", json!("steel")),
                ("kinematic_elements.effective_length", json!(8e-3)),
                ("cage.material", json!("steel")),
                ("cage.pocket", cylinder),
            ],
        ),
        (
            "least solid contacts",
            vec![
                ("cage.pocket.solid_plane.contact", json!({"stiffness": 1e6})),
                ("cage.guide.solid.contact", json!({"stiffness": 1e6 / 3.0})),
            ],
        ),
        (
            "load, unbalance and start",
            vec![
                ("cage.mass_eccentricity", json!({"y": 1e-5, "z": -2e-5})),
                (
                    "cage.load",
                    json!({"force_z": {"sine": {"mean": 0.0, "amplitude": 0.7, "frequency": 9.0, "phase": 0.3}}}),
                ),
                (
                    "initial",
                    json!({"cage": {"y": 1e-4, "z": 0.0}, "cage_velocity": {"y": 0.0, "z": 0.1}, "cage_speed": 0.0}),
                ),
            ],
        ),
    ]
}

/// Fails with everything that the schema has to say about a document.
fn assert_valid(name: &str, schema: &Value, document: &Value) {
    let validator = jsonschema::draft202012::new(schema).expect("the schema is a JSON Schema");
    let complaints: Vec<String> =
        validator.iter_errors(document).map(|e| format!("{}: {e}", e.instance_path())).collect();
    assert!(complaints.is_empty(), "{name}: {}", complaints.join("\n"));
}

fn schema(text: &str) -> Value {
    serde_json::from_str(text).expect("a schema is JSON")
}

fn parse(name: &str) -> Value {
    serde_json::from_str(&read(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

#[test]
fn scenes_fit_the_schema_and_compile() {
    let (scenes, _) = files();
    assert!(scenes.iter().any(|name| name == GREASE));
    let schema = schema(Scene::JSON_SCHEMA);
    for name in &scenes {
        assert_valid(name, &schema, &parse(name));
        Model::from_json(&read(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    }
}

#[test]
fn case_sets_fit_the_schema_and_every_case_compiles() {
    let (_, sets) = files();
    assert!(!sets.is_empty());
    let schema = schema(CaseSet::JSON_SCHEMA);
    for name in &sets {
        assert_valid(name, &schema, &parse(name));
        let set = CaseSet::from_json(&read(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
        let base = read(&format!("scenes/{}", set.scene));
        let scenes = set.scenes(&base).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(scenes.len(), set.cases.len());
        for (case, scene) in set.cases.iter().zip(scenes) {
            Model::new(scene).unwrap_or_else(|e| panic!("{name}, case {}: {e}", case.name));
        }
    }
}

#[test]
fn cases_differ_from_the_base_scene_only_in_their_values() {
    let set = CaseSet::from_json(&read("scenes/nu2310_fig9.cases.json")).unwrap();
    let base = read("scenes/nu2310.json");
    for (case, scene) in set.cases.iter().zip(set.scenes(&base).unwrap()) {
        let changes: Vec<(&str, Value)> = case.set.iter().map(|(k, v)| (k.as_str(), v.clone())).collect();
        let expected = Scene::from_value(&example_with(&changes)).unwrap();
        assert_eq!(scene, expected, "case {}", case.name);
    }
}

#[cfg(feature = "schema")]
/// Compares a committed schema with the generated one; with CAGEDYN_BLESS=1 it writes the generated one instead.
fn check_committed(path: &str, schema: &Value) {
    let generated = serde_json::to_string_pretty(schema).expect("a schema is JSON") + "\n";
    let file = repository(path);
    if std::env::var_os("CAGEDYN_BLESS").is_some_and(|v| v == "1") {
        std::fs::create_dir_all(file.parent().expect("inside the repository")).unwrap();
        std::fs::write(&file, &generated).unwrap();
        return;
    }
    let hint = "run `make header` and commit the result";
    let committed = std::fs::read_to_string(&file).unwrap_or_else(|e| panic!("{path}: {e}; {hint}"));
    let same = committed.replace("\r\n", "\n") == generated;
    assert!(same, "{path} is not what the library generates; {hint}");
}

#[cfg(feature = "schema")]
#[test]
fn committed_schemas_are_the_generated_ones() {
    check_committed("schemas/scene.schema.json", &Scene::generated_json_schema());
    check_committed("schemas/cases.schema.json", &CaseSet::generated_json_schema());
}

#[test]
fn every_field_of_the_schemas_is_described() {
    for (name, schema) in [("scene", schema(Scene::JSON_SCHEMA)), ("cases", schema(CaseSet::JSON_SCHEMA))] {
        let mut bare = Vec::new();
        collect_undescribed(&schema, "", &mut bare);
        assert!(bare.is_empty(), "{name}: no description for {}", bare.join(", "));
    }
}

/// Whether every object may have a property of this name, for people and editors.
fn is_remark(key: &str) -> bool {
    key == "comment" || key == "$schema"
}

/// Paths of the properties below `schema` that have no description.
fn collect_undescribed(schema: &Value, path: &str, bare: &mut Vec<String>) {
    let Value::Object(map) = schema else {
        if let Value::Array(list) = schema {
            list.iter().enumerate().for_each(|(i, s)| collect_undescribed(s, &format!("{path}/{i}"), bare));
        }
        return;
    };
    for (key, inner) in map {
        let path = format!("{path}/{key}");
        if key == "properties" {
            // The property of a variant repeats the name of the variant, whose description stands above.
            let variant = map.contains_key("description")
                && map.get("required").is_some()
                && inner.as_object().is_some_and(|p| p.keys().filter(|key| !is_remark(key)).count() == 1);
            for (name, property) in inner.as_object().into_iter().flatten() {
                if property.get("description").is_none() && !variant {
                    bare.push(format!("{path}/{name}"));
                }
            }
        }
        collect_undescribed(inner, &path, bare);
    }
}

#[test]
fn a_scene_survives_writing_and_reading() {
    let (scenes, _) = files();
    let mut texts: Vec<(String, String)> = scenes.iter().map(|name| (name.clone(), read(name))).collect();
    let roundness = json!([{"order": 2, "amplitude": 1e-5, "phase": 0.1}]);
    let variants: [(&str, &[(&str, Value)]); 7] = [
        (
            "no options",
            &[
                ("lubricant", Value::Null),
                ("gravity", Value::Null),
                ("cage", Value::Null),
                ("raceways", json!({})),
                ("title", Value::Null),
            ],
        ),
        (
            "fixed ring",
            &[
                ("inner_ring.motion", json!({"fixed": {"y": 1e-6, "z": -3e-5}})),
                ("initial.inner_ring", json!("centred")),
            ],
        ),
        (
            "step and ramp",
            &[
                ("inner_ring.speed", json!({"ramp": {"from": 0.0, "to": -314.0, "start": 0.0, "end": 0.1}})),
                (
                    "inner_ring.motion.free.load.z",
                    json!({"step": {"before": 0.0, "after": -1.0 / 3.0, "time": 1e-3}}),
                ),
            ],
        ),
        (
            "sine and table",
            &[
                ("inner_ring.speed", json!({"table": {"time": [0.0, 0.1], "value": [0.1, 0.2]}})),
                (
                    "inner_ring.motion.free.load.z",
                    json!({"sine": {"mean": 0.1, "amplitude": 0.7, "frequency": 3.0, "phase": 0.3}}),
                ),
            ],
        ),
        ("roundness", &[("cage.guide.roundness", roundness)]),
        (
            "loaded contacts",
            &[
                ("raceways.rolling_resistance.extent", json!({"loaded": {"threshold": 12.3}})),
                ("raceways.contact.thermal_correction", json!("gupta")),
            ],
        ),
        (
            "solver",
            &[(
                "solver",
                json!({"method": {"dormand_prince": {"tolerance": 1e-5}}, "max_steps": 18446744073709551615u64}),
            )],
        ),
    ];
    for (name, changes) in variants {
        texts.push((name.to_owned(), example_with(changes).to_string()));
    }
    for (name, changes) in grease_variants() {
        texts.push((name.to_owned(), with(&parse(GREASE), &changes).to_string()));
    }
    let schema = schema(Scene::JSON_SCHEMA);
    for (name, text) in texts {
        let scene = Scene::from_json(&text).unwrap_or_else(|e| panic!("{name}: {e}"));
        let written = scene.to_json();
        let again = Scene::from_json(&written).unwrap_or_else(|e| panic!("{name}, written: {e}"));
        assert_eq!(scene, again, "{name}");
        assert_eq!(written, again.to_json(), "{name}: the text changes when it is written again");
        assert_valid(&name, &schema, &serde_json::from_str(&written).unwrap());
        assert_valid(&name, &schema, &serde_json::from_str(&text).unwrap());
    }
}

#[test]
fn what_the_schema_refuses_the_library_refuses() {
    let schema = schema(Scene::JSON_SCHEMA);
    let validator = jsonschema::draft202012::new(&schema).unwrap();
    let rows: [(&str, &str, Value); 15] = [
        ("unknown field at the top", "speed", json!(1.0)),
        ("unknown field in a block", "rollers.diameter", json!(15e-3)),
        (
            "unknown field in a law",
            "cage.pocket.lubricated_cylinder.contact.boundary_friction.mu",
            json!(0.1),
        ),
        ("unknown field in a vector", "gravity.x", json!(0.0)),
        ("unknown field in a signal", "inner_ring.speed.unit", json!("rpm")),
        ("unknown field in a material", "materials.steel.name", json!("steel")),
        ("unknown law", "raceways.contact.film", json!("dowson_higginson")),
        ("text for a number", "rollers.radius", json!("7.5e-3")),
        ("negative count", "rollers.count", json!(-1)),
        ("fractional count", "rollers.count", json!(12.5)),
        ("null for a number", "rollers.mass", Value::Null),
        ("number for a block", "cage.pocket", json!(1)),
        ("array for a block", "gravity", json!([0.0, -9.8])),
        ("array for a nested block", "raceways.contact.damping", json!([5e-7, 1e-8])),
        ("object for a plain choice", "raceways.contact.film", json!({"pan_hamrock": null})),
    ];
    let grease = parse(GREASE);
    let layer = "cage.guide.film.lubricant_layer";
    let more: [(&str, &str, Value); 15] = [
        ("unknown field in the elements", "kinematic_elements.mass", json!(1e-3)),
        ("unknown motion", "kinematic_elements.motion", json!({"sliding": {}})),
        ("two motions", "kinematic_elements.motion.prescribed", json!({})),
        ("word for a motion", "kinematic_elements.motion", json!("rolling")),
        ("two viscosities", "lubricant.viscosity.constant", json!(0.06)),
        ("list for a point", "lubricant.viscosity.walther.hot", json!([373.15, 12e-6])),
        ("bare temperature", "lubricant.viscosity.walther.temperature", json!(313.15)),
        ("unknown pocket", "cage.pocket", json!({"sphere": {}})),
        ("unknown field in a solid contact", "cage.pocket.solid_plane.contact.mu", json!(0.1)),
        ("unknown ring", "cage.guide.ring", json!("outer")),
        ("two films", "cage.guide.film.short_bearing", json!({"land_width": 8e-3})),
        ("unknown pressure shear", "cage.guide.film.lubricant_layer.pressure_shear", json!("none")),
        ("layer without fields", layer, json!({})),
        ("list for an unbalance", "cage.mass_eccentricity", json!([1e-5, 0.0])),
        ("truth value for a force on the cage", "cage.load", json!({"force_y": true})),
    ];
    let documents = rows.into_iter().map(|(name, path, value)| (name, path, example_with(&[(path, value)])));
    let more = more.into_iter().map(|(name, path, value)| (name, path, with(&grease, &[(path, value)])));
    for (name, path, document) in documents.chain(more) {
        assert!(!validator.is_valid(&document), "{name}: the schema accepts it");
        match Scene::from_json(&document.to_string()) {
            Ok(_) => panic!("{name}: the library accepts {path} although the schema refuses it"),
            Err(e) => assert_eq!(e.status, Status::BadJson, "{name}: {e}"),
        }
    }
}

/// Editors learn ranges from the schema: beyond each of them a scene is refused.
#[test]
fn ranges_of_the_schema_are_those_of_the_library() {
    let schema: Value = serde_json::from_str(Scene::JSON_SCHEMA).expect("JSON");
    let mut counts = [0, 0];
    for scene in files().0 {
        let scene: Value = serde_json::from_str(&read(&scene)).expect("JSON");
        let mut found = Vec::new();
        numbers_with_ranges(&schema, &schema, &scene, "", &mut found);
        for (path, [min, max]) in found {
            counts[0] += 1;
            for beyond in
                [min.map(|x: f64| x - 1e-3 * x.abs().max(1e-12)), max.map(|x: f64| x + 1e-3 * x.abs())]
            {
                let Some(x) = beyond else { continue };
                let x = if x.fract() == 0.0 && x.abs() > 10.0 { json!(x as i64) } else { json!(x) };
                let e = Scene::from_value(&with(&scene, &[(&path, x.clone())]))
                    .expect_err(&format!("{path} = {x}"));
                assert!(matches!(e.status, Status::BadScene | Status::BadJson), "{path} = {x}: {e}");
                counts[1] += 1;
            }
        }
    }
    assert!(counts[0] > 100 && counts[1] > 200, "{counts:?}");
}

/// Paths of the numbers of a scene that the schema gives limits to.
fn numbers_with_ranges(
    schema: &Value,
    node: &Value,
    value: &Value,
    path: &str,
    found: &mut Vec<(String, [Option<f64>; 2])>,
) {
    let node = match node["$ref"].as_str() {
        Some(name) => schema.pointer(name.trim_start_matches('#')).expect("a definition"),
        None => node,
    };
    let at = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
    match value {
        Value::Number(_) => {
            let limits = [node["minimum"].as_f64(), node["maximum"].as_f64()];
            if limits != [None, None] {
                found.push((path.to_owned(), limits));
            }
        }
        Value::Object(map) => {
            for (key, inside) in map {
                let choices =
                    ["oneOf", "anyOf"].into_iter().filter_map(|many| node[many].as_array()).flatten();
                for choice in choices.chain([node]) {
                    let choice = match choice["$ref"].as_str() {
                        Some(name) => schema.pointer(name.trim_start_matches('#')).expect("a definition"),
                        None => choice,
                    };
                    let next = [&choice["properties"][key], &choice["additionalProperties"]];
                    if let Some(next) = next.into_iter().find(|next| next.is_object()) {
                        numbers_with_ranges(schema, next, inside, &at(key), found);
                    } else if let Some(inner) = choice["oneOf"].as_array() {
                        for inner in inner.iter().filter(|inner| inner["properties"][key].is_object()) {
                            numbers_with_ranges(schema, &inner["properties"][key], inside, &at(key), found);
                        }
                    }
                }
            }
        }
        _ => {}
    }
}

#[test]
fn remarks_and_plain_numbers_are_allowed_everywhere() {
    let plain = [
        ("comment", json!(["two", "lines"])),
        ("$schema", json!("schemas/scene.schema.json")),
        ("rollers.comment", json!("of the catalogue")),
        ("inner_ring.speed", json!({"constant": -314.1592653589793, "comment": "3000 rpm"})),
        ("inner_ring.motion.free.load.z", json!(-4900.0)),
        ("materials.comment", json!("usual steels")),
    ];
    let scene = Scene::from_value(&example_with(&plain)).unwrap_or_else(|e| panic!("{e}"));
    let same = Scene::from_value(&example_with(&[("inner_ring.speed", json!(-314.1592653589793))])).unwrap();
    assert_eq!(scene, same);
    let text = example_with(&plain).to_string();
    let set = [("inner_ring.motion.free.load.z.constant", "-980")];
    let changed = Scene::from_json_with(&text, set).unwrap_or_else(|e| panic!("{e}"));
    assert_ne!(changed, scene);
    for (path, value) in [("rollers.coment", json!("x")), ("rollers.count", json!({"comment": 12}))] {
        assert!(Scene::from_value(&example_with(&[(path, value)])).is_err());
    }
}

/// As other languages write them.
#[test]
fn whole_numbers_with_a_point_and_a_byte_order_mark_are_read() {
    let text = example_with(&[("rollers.count", json!(12.0))]).to_string();
    assert!(text.contains("12.0"));
    let scene = Scene::from_json(&format!("\u{feff}{text}")).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(scene, Scene::from_value(&example_with(&[])).unwrap());
    for x in [json!(12.5), json!(-1.0), json!(1e300)] {
        assert!(Scene::from_value(&example_with(&[("rollers.count", x)])).is_err());
    }
}

#[test]
fn files_of_the_other_kind_are_told_apart() {
    let (scenes, sets) = files();
    let e = Scene::from_json(&read(&sets[0])).unwrap_err();
    assert!(e.message.contains("a case set") && e.message.contains("cagedyn cases"), "{e}");
    let e = CaseSet::from_json(&read(&scenes[0])).unwrap_err();
    assert!(e.message.contains("is a scene") && e.message.contains("cagedyn run"), "{e}");
}

#[test]
fn texts_that_are_too_long_are_refused_unread() {
    let e = Scene::from_json(&format!("[{}0]", "0,".repeat(9 << 20))).unwrap_err();
    assert_eq!(e.status, Status::BadJson);
    assert!(e.message.contains("bytes of text, at most"), "{e}");
}
