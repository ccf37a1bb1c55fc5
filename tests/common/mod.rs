//! Helpers shared by the integration tests: scenes of the repository with changes, and random numbers; bearings in
//! given states, their force reports and a contact law to compare with in the submodules.

// Every test file compiles this module for itself and uses only a part of it.
#![allow(dead_code)]

pub mod bench;
pub mod palmgren;
pub mod parts;
pub mod reports;

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

/// Splitmix64: the same numbers on every platform.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in [low, high).
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform in (-size, size).
    pub fn around_zero(&mut self, size: f64) -> f64 {
        self.within(-size, size)
    }

    /// Uniform in 0..n.
    pub fn index(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    pub fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }
}

/// Replaces what stands between a marker and the next `<!-- end -->` in a file.
pub fn replace_between(file: &Path, marker: &str, text: &str) {
    let mut page = std::fs::read_to_string(file).expect("the page can be read");
    let start = page.find(marker).expect("a marker") + marker.len();
    let length = page[start..].find("<!-- end -->").expect("an end");
    page.replace_range(start..start + length, &format!("\n\n{text}\n"));
    std::fs::write(file, page).expect("the page is written");
}
