//! Equilibrium without time stepping, against textbook values, independent solutions and its own derivatives.

#[path = "../common/mod.rs"]
mod common;

mod balls;
mod life;
mod random;
mod refused;
mod stiffness;
mod tilting;

use cagedyn::equilibrium::{Equilibrium, RaceControl, equilibrium};
use cagedyn::{Model, Result, Scene};
use serde_json::{Value, json};

/// The equilibrium of a scene with changes.
fn of(file: &str, control: RaceControl, changes: &[(&str, Value)]) -> Result<Equilibrium> {
    let text = common::read(file);
    let texts: Vec<(&str, String)> = changes.iter().map(|(path, value)| (*path, value.to_string())).collect();
    let scene = Scene::from_json_with(&text, texts.iter().map(|(path, value)| (*path, value.as_str())))?;
    equilibrium(&Model::new(scene)?, control)
}

const ANGULAR: &str = "scenes/angular_contact_218.json";
const DEEP: &str = "scenes/deep_groove_6206.json";

/// A ring free in all coordinates under these loads.
fn free_ring([x, y, z, moment_y, moment_z]: [f64; 5]) -> Value {
    let constant = |value: f64| json!({"constant": value});
    json!({"space": {
        "x": "free", "y": "free", "z": "free", "tilt_y": "free", "tilt_z": "free",
        "load": {
            "x": constant(x), "y": constant(y), "z": constant(z),
            "moment_y": constant(moment_y), "moment_z": constant(moment_z),
        },
    }})
}

/// Values of a contact quantity, contact by contact.
fn values(found: &Equilibrium, name: &str) -> Vec<f64> {
    let place = found.contact_quantities.iter().position(|q| q.name == name).expect("a quantity");
    found.contact_values.iter().map(|values| values[place]).collect()
}
