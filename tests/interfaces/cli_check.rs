//! `cagedyn check`: all that is wrong with a file at once, each in a line of its own.
#![cfg(feature = "cli")]

use crate::cli::{cagedyn, run, text};
use crate::common::{example, read, remove, set};
use serde_json::{Value, json};
use std::io::Write;
use std::path::Path;
use std::process::Stdio;

/// Writes a text into a folder and checks it.
fn check(folder: &Path, name: &str, content: &str, more: &[&str]) -> (Option<i32>, String, String) {
    let file = folder.join(name);
    std::fs::write(&file, content).expect("a file");
    let mut arguments = vec!["check", file.to_str().expect("UTF-8")];
    arguments.extend(more);
    let output = run(&arguments);
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

/// A scene with five mistakes that have nothing to do with each other, and the paths of these.
fn five() -> (String, [&'static str; 5]) {
    let mut scene = example();
    set(&mut scene, "gravity.w", json!(1.0));
    set(&mut scene, "solver", json!({"preset": 3}));
    set(&mut scene, "cage.mass", json!(1e9));
    remove(&mut scene, "lubricant");
    set(&mut scene, "rollers.count", json!(40));
    (format!("{scene:#}"), ["lubricant", "cage.mass", "gravity.w", "rollers.count", "solver.preset"])
}

#[test]
fn scenes_and_case_sets_that_are_right_are_ok() {
    for (file, title) in [
        ("scenes/nu2310.json", "NU2310"),
        ("scenes/grease_guide_heat.json", ""),
        ("scenes/nu2310_fig9.cases.json", ""),
    ] {
        let output = run(&["check", file]);
        let told = text(&output.stdout);
        assert_eq!(output.status.code(), Some(0), "{file}: {told}");
        assert!(told.starts_with(&format!("{file}: ok")) && told.contains(title), "{told}");
        assert_eq!(told.lines().count(), 1);
        assert!(output.stderr.is_empty());
    }
}

#[test]
fn a_replaced_value_is_named_instead_of_the_title_and_an_unlikely_one_is_told() {
    let file = "scenes/nu2310.json";
    let output = run(&["check", file, "--set", "inner_ring.speed=3000"]);
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(text(&output.stdout), format!("{file}: ok, nu2310 with inner_ring.speed=3000\n"));
    let told = text(&output.stderr);
    assert!(told.contains("warning: inner_ring.speed: 3000 rad/s") && told.contains("314.159"), "{told}");
    let output = run(&["check", file, "--set", "inner_ring.speed=300", "--set", "title=mine"]);
    assert_eq!(text(&output.stdout), format!("{file}: ok, mine\n"));
    assert!(output.stderr.is_empty());
}

#[test]
fn five_mistakes_are_five_lines() {
    let folder = tempfile::tempdir().expect("a directory");
    let (scene, paths) = five();
    let (code, told, errors) = check(folder.path(), "five.json", &scene, &[]);
    assert_eq!((code, errors.as_str()), (Some(1), ""));
    let file = folder.path().join("five.json").display().to_string();
    let mut found = Vec::new();
    for line in told.lines() {
        let rest = line.strip_prefix(&format!("{file}:")).unwrap_or_else(|| panic!("{line}"));
        let mut parts = rest.splitn(3, ": ");
        let number: usize = parts.next().and_then(|number| number.parse().ok()).expect("a line number");
        let path = parts.next().expect("a path").to_owned();
        let key = path.rsplit('.').next().expect("a key");
        let there = scene.lines().nth(number - 1).expect("a line of the file");
        assert!(there.contains(&format!("\"{key}\"")) || path == "lubricant", "{line}: {there}");
        found.push(path);
    }
    found.sort();
    let mut paths = paths.map(str::to_owned);
    paths.sort();
    assert_eq!(found, paths, "{told}");
}

#[test]
fn programs_get_the_same_as_json() {
    let folder = tempfile::tempdir().expect("a directory");
    let (scene, paths) = five();
    let (code, told, _) = check(folder.path(), "five.json", &scene, &["--json"]);
    assert_eq!(code, Some(1));
    let list: Vec<Value> = serde_json::from_str(&told).expect("JSON");
    assert_eq!(list.len(), paths.len(), "{told}");
    for problem in &list {
        assert!(paths.contains(&problem["path"].as_str().expect("a path")), "{problem}");
        assert!(problem["line"].as_u64().is_some_and(|line| line >= 1));
        assert!(problem["message"].as_str().is_some_and(|message| !message.is_empty()));
    }
    let output = run(&["check", "scenes/nu2310.json", "--json"]);
    assert_eq!((output.status.code(), text(&output.stdout).trim()), (Some(0), "[]"));
}

#[test]
fn a_text_that_is_no_json_is_one_line() {
    let folder = tempfile::tempdir().expect("a directory");
    let (code, told, _) =
        check(folder.path(), "broken.json", "{\n\"schema\": \"cagedyn.scene/1\",\n\"gravity\": {,\n", &[]);
    assert_eq!((code, told.lines().count()), (Some(1), 1), "{told}");
    assert!(told.contains("broken.json:3: gravity: "), "{told}");
    let (code, _, errors) =
        (run(&["check", "no/such.json"]).status.code(), (), text(&run(&["check", "no/such.json"]).stderr));
    assert_eq!(code, Some(1));
    assert!(errors.starts_with("cagedyn: no/such.json"), "{errors}");
}

#[test]
fn values_may_be_replaced_and_text_may_come_from_a_pipe() {
    let output = run(&["check", "scenes/nu2310.json", "--set", "cage=null", "--set", "rollers.radius=7.5"]);
    assert_eq!(output.status.code(), Some(1));
    let told = text(&output.stdout);
    assert!(told.lines().count() == 1 && told.contains(": rollers.radius: 7.5 m is not within"), "{told}");
    let mut child = cagedyn()
        .args(["check", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let scene = read("scenes/nu2310.json").replace("\"count\": 12", "\"count\": 40");
    child.stdin.take().expect("a pipe").write_all(scene.as_bytes()).expect("written");
    let output = child.wait_with_output().expect("an end");
    assert!(text(&output.stdout).starts_with("-:"), "{}", text(&output.stdout));
    assert_eq!(output.status.code(), Some(1));
}

#[test]
fn cases_are_told_with_their_places() {
    let folder = tempfile::tempdir().expect("a directory");
    let mut base = example();
    set(&mut base, "cage.mass", json!(-1.0));
    std::fs::write(folder.path().join("base.json"), format!("{base:#}")).expect("a file");
    let cases = r#"{
  "schema": "cagedyn.cases/1",
  "scene": "base.json",
  "cases": [
    { "name": "a", "set": { "rollers.count": 12 } },
    { "name": "b", "set": { "rollers.count": 40 } }
  ]
}"#;
    let (code, told, _) = check(folder.path(), "set.cases.json", cases, &[]);
    assert_eq!(code, Some(1));
    let lines: Vec<&str> = told.lines().collect();
    assert_eq!(lines.len(), 2, "{told}");
    assert!(lines[0].contains("base.json:") && lines[0].contains("cage.mass: -1"), "{told}");
    let place = "set.cases.json:6: cases.1.set.rollers.count: case b: rollers.count: 40 rollers";
    assert!(lines[1].contains(place), "{told}");
}
