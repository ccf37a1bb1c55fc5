//! `Scene::check` tells all that is wrong at once, each with its line, and nothing that only follows from something else.

use crate::common::{example, example_text, read, remove, set};
use crate::refused::rows;
use cagedyn::scene::CaseSet;
use cagedyn::{Model, Problem, Scene};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// Problems as lines, without those of the text.
fn told(problems: &[Problem]) -> Vec<String> {
    problems.iter().map(ToString::to_string).collect()
}

/// Paths of the problems of a scene.
fn paths(scene: &Value) -> Vec<String> {
    let mut paths: Vec<String> =
        Scene::check(&format!("{scene:#}")).into_iter().map(|problem| problem.path).collect();
    paths.sort();
    paths
}

#[test]
fn right_scenes_have_no_problems() {
    for scene in ["nu2310", "grease_guide", "grease_guide_heat", "grease_guide_elastic", "nu2310_grease"] {
        assert_eq!(Scene::check(&read(&format!("scenes/{scene}.json"))), [], "{scene}");
    }
}

/// Every scene that is refused has the message of the refusal among its problems, and one mistake is told as one.
#[test]
fn what_is_refused_is_told() {
    let (mut several, rows) = (BTreeMap::new(), rows());
    for row in &rows {
        let message = Model::from_json(&row.text).expect_err(row.name).message;
        let problems = told(&Scene::check(&row.text));
        assert!(problems.contains(&message), "{}: {message} is not among {problems:#?}", row.name);
        if problems.len() > 1 {
            several.insert(row.name, problems);
        }
    }
    // Rows with several mistakes.
    let expected = [
        "empty object",
        "unknown field in a signal",
        "unknown guide",
        "no materials",
        "cage guided by no inner ring",
        "clearance of the size of a roller",
        "lubricated pocket with nothing it needs",
        "pocket traction of kinematic elements without constants",
    ];
    assert_eq!(several.keys().copied().collect::<BTreeSet<_>>(), BTreeSet::from(expected), "{several:#?}");
}

#[test]
fn mistakes_of_different_kinds_are_told_together() {
    let mut scene = example();
    set(&mut scene, "gravity.w", json!(1.0));
    set(&mut scene, "solver", json!({"preset": 3}));
    set(&mut scene, "cage.mass", json!(1e9));
    set(&mut scene, "rollers.count", json!(40));
    remove(&mut scene, "lubricant");
    remove(&mut scene, "materials.brass");
    set(&mut scene, "inner_ring.motion.free.load.y.constant", json!("none"));
    let text = format!("{scene:#}");
    let problems = Scene::check(&text);
    let paths = [
        "cage.mass",
        "cage.material",
        "gravity.w",
        "inner_ring.motion.free.load.y.constant",
        "lubricant",
        "rollers.count",
        "solver.preset",
    ];
    let mut found: Vec<&str> = problems.iter().map(|problem| problem.path.as_str()).collect();
    found.sort_unstable();
    assert_eq!(found, paths, "{problems:#?}");
    // The line has the last key of the path, but for what is missing.
    for problem in problems.iter().filter(|problem| problem.path != "lubricant") {
        let line = text.lines().nth(problem.line - 1).expect("a line");
        let key = problem.path.rsplit('.').next().expect("a key");
        assert!(line.contains(&format!("\"{key}\"")), "{problem:?}: {line}");
    }
    assert_eq!(problems[0].path, "lubricant");
    assert_eq!(problems[0].line, 1);
}

#[test]
fn consequences_are_not_told() {
    for (changes, expected) in [
        // What has the wrong unit fits to nothing.
        (vec![("rollers.radius", json!(7.5))], vec!["rollers.radius"]),
        (vec![("rollers.mass", json!("30 g"))], vec!["rollers.mass"]),
        (vec![("outer_ring.raceway_radius", json!(47.5))], vec!["outer_ring.raceway_radius"]),
        (vec![("rollers.count", json!("twelve"))], vec!["rollers.count"]),
        (vec![("record.duration", json!([]))], vec!["record.duration"]),
        (vec![("lubricant", json!("oil"))], vec!["lubricant"]),
        (vec![("materials", json!([]))], vec!["materials"]),
        (vec![("cage", json!(0))], vec!["cage"]),
        (vec![("outer_ring", Value::Null)], vec!["outer_ring"]),
        (
            vec![("cage.guide", json!({"film": {"dry": {}}}))],
            vec!["cage.guide.film", "cage.guide", "cage.guide"],
        ),
        (vec![("cage.pocket", json!({"round": {}}))], vec!["cage.pocket"]),
        (vec![("inner_ring.motion", json!("loose"))], vec!["inner_ring.motion"]),
        // Without the clearance the circle of the rollers is known well enough.
        (
            vec![("inner_ring.radial_clearance", json!("40 um")), ("rollers.count", json!(40))],
            vec!["inner_ring.radial_clearance", "rollers.count"],
        ),
        // One mistake beside another one.
        (
            vec![("rollers.radius", json!(7.5)), ("cage.inertia", json!(-1))],
            vec!["cage.inertia", "rollers.radius"],
        ),
    ] {
        let mut scene = example();
        for (path, value) in &changes {
            set(&mut scene, path, value.clone());
        }
        let mut expected: Vec<String> = expected.into_iter().map(str::to_owned).collect();
        expected.sort();
        assert_eq!(paths(&scene), expected, "{changes:?}: {:#?}", told(&Scene::check(&scene.to_string())));
    }
}

/// A block whose name is misspelt is read as the one that is meant, so it is not missing as well.
#[test]
fn misspelt_names_are_told_once() {
    for (right, wrong) in
        [("lubricant", "lubrcant"), ("rollers", "roller"), ("materials", "Materials"), ("record", "recrd")]
    {
        let mut scene = example();
        let block = scene[right].clone();
        remove(&mut scene, right);
        set(&mut scene, wrong, block);
        assert_eq!(paths(&scene), [wrong]);
    }
    let text = example_text().replace("\"lubricated_cylinder\"", "\"lubricated_cylindre\"");
    let problems = Scene::check(&text);
    assert!(problems.len() == 1 && problems[0].path == "cage.pocket", "{problems:#?}");
}

#[test]
fn a_text_that_is_no_json_has_one_problem() {
    let text = example_text().replacen("-9.80665 }", "-9.80665, }", 1);
    let problems = Scene::check(&text);
    let message = Scene::from_json(&text).expect_err("a comma").message;
    assert_eq!(told(&problems), [message]);
    assert!(problems[0].line > 1 && text.lines().nth(problems[0].line - 1).expect("a line").contains("-9.8"));
}

#[test]
fn replaced_values_are_checked_with_the_scene() {
    let text = example_text();
    assert_eq!(Scene::check_with(&text, [("cage", "null")]), []);
    let problems = Scene::check_with(&text, [("rollers.radius", "7.5"), ("wheels.count", "4")]);
    let paths: Vec<&str> = problems.iter().map(|problem| problem.path.as_str()).collect();
    assert_eq!(paths, ["wheels.count", "rollers.radius"], "{problems:#?}");
}

#[test]
fn case_sets_are_checked_with_every_case() {
    let base = example_text();
    let text = r#"{
        "schema": "cagedyn.cases/1",
        "scene": "nu2310.json",
        "cases": [
            {"name": "right", "set": {"cage": null}},
            {"name": "wrong", "set": {"rollers.radius": 7.5,
                "cage.guide.ring": 5}}
        ]
    }"#;
    let set = CaseSet::from_json(text).expect("a case set");
    let problems = set.check_cases(text, &base);
    let places: Vec<(&str, usize)> = problems.iter().map(|p| (p.path.as_str(), p.line)).collect();
    assert_eq!(
        places,
        [("cases.1.set.rollers.radius", 6), ("cases.1.set.cage.guide.ring", 7)],
        "{problems:#?}"
    );
    assert!(problems[0].message.starts_with("case wrong: rollers.radius: 7.5 m is not within"));
    let text = text.replace("\"wrong\"", "\"ri ght\"").replace("\"scene\"", "\"scenes\"");
    let paths: Vec<String> = CaseSet::check(&text).into_iter().map(|problem| problem.path).collect();
    assert_eq!(paths, ["scenes", "cases.1.name"]);
}

/// Any number of mistakes ends, and quickly.
#[test]
fn many_mistakes_are_cut_off() {
    let mut scene = example();
    let points: Vec<String> = (0..1000).map(|i| i.to_string()).collect();
    set(&mut scene, "inner_ring.speed", json!({"table": {"time": points, "value": [1.0]}}));
    assert_eq!(Scene::check(&scene.to_string()).len(), 100);
}
