//! Helpers shared by the integration tests: scenes of the repository with changes, and random numbers; bearings in
//! given states, their force reports and a contact law to compare with in the submodules.

// Every test file compiles this module for itself and uses only a part of it.
#![allow(dead_code)]

pub mod bench;
pub mod palmgren;
pub mod parts;
pub mod reports;
pub mod systems;

pub use cagedyn_studies::random::Random;

use serde_json::Value;
use std::path::{Path, PathBuf};

/// A path inside the repository.
pub fn repository(relative: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(relative)
}

/// Text of a file of the repository.
pub fn read(relative: &str) -> String {
    let path = repository(relative);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The text of the example scene.
pub fn example_text() -> String {
    read("scenes/nu2310.json")
}

/// The example scene as a JSON value.
pub fn example() -> Value {
    serde_json::from_str(&example_text()).expect("the example scene is JSON")
}

/// The place at a dotted path; its last key may be new.
fn place<'a>(scene: &'a mut Value, path: &str) -> &'a mut Value {
    path.split('.').fold(scene, |place, key| match place {
        Value::Array(list) => {
            let i: usize = key.parse().unwrap_or_else(|_| panic!("{path}: {key} is no index"));
            &mut list[i]
        }
        other => &mut other[key],
    })
}

/// Sets the value at a dotted path.
pub fn set(scene: &mut Value, path: &str, value: Value) {
    *place(scene, path) = value;
}

/// Removes the field at a dotted path.
pub fn remove(scene: &mut Value, path: &str) {
    let (parent, key) = path.rsplit_once('.').unwrap_or(("", path));
    let parent = if parent.is_empty() { scene } else { place(scene, parent) };
    let removed = parent.as_object_mut().and_then(|map| map.remove(key));
    assert!(removed.is_some(), "{path}: nothing to remove");
}

/// The example scene with other values at some paths; null removes an optional block.
pub fn example_with(changes: &[(&str, Value)]) -> Value {
    with(&example(), changes)
}

/// A scene with other values at some paths.
pub fn with(scene: &Value, changes: &[(&str, Value)]) -> Value {
    let mut scene = scene.clone();
    for (path, value) in changes {
        set(&mut scene, path, value.clone());
    }
    scene
}

/// Replaces what stands between a marker and the next `<!-- end -->` in a file.
pub fn replace_between(file: &Path, marker: &str, text: &str) {
    let mut page = std::fs::read_to_string(file).expect("the page can be read");
    let start = page.find(marker).expect("a marker") + marker.len();
    let length = page[start..].find("<!-- end -->").expect("an end");
    page.replace_range(start..start + length, &format!("\n\n{text}\n"));
    std::fs::write(file, page).expect("the page is written");
}
