//! Simulations of the NU2310 bearing with changes, and what to compare of them.

use cagedyn::{Model, Scene, Sim};
use std::sync::Arc;

pub const STIFF: (&str, &str) = ("solver", r#"{"method": {"rosenbrock": {"tolerance": 1e-5}}}"#);
pub const CHOSEN: (&str, &str) = ("solver", r#"{"method": {"auto": {"tolerance": 1e-5}}}"#);
pub const ACCURATE: (&str, &str) = ("solver", r#"{"method": {"dormand_prince": {"tolerance": 1e-7}}}"#);

pub fn model(overrides: &[(&str, &str)]) -> Arc<Model> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/nu2310.json");
    let text = std::fs::read_to_string(path).unwrap();
    let scene = Scene::from_json_with(&text, overrides.iter().copied()).unwrap_or_else(|e| panic!("{e}"));
    Arc::new(Model::new(scene).unwrap_or_else(|e| panic!("{e}")))
}

pub fn sim(overrides: &[(&str, &str)]) -> Sim {
    Sim::new(model(overrides)).unwrap_or_else(|e| panic!("{e}"))
}

pub fn state_at(overrides: &[(&str, &str)], t: f64) -> Vec<f64> {
    let mut s = sim(overrides);
    s.advance_to(t).unwrap_or_else(|e| panic!("{e}"));
    s.state().to_vec()
}

pub fn bits(state: &[f64]) -> Vec<u64> {
    state.iter().map(|x| x.to_bits()).collect()
}
