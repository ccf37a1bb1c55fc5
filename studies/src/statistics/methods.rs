//! The methods that are compared.

use crate::cvode;
use serde_json::{Value, json};

/// How a method integrates.
#[derive(Clone, Copy)]
pub enum Solver {
    /// The leapfrog with a step in units of 1/(highest frequency of the model).
    Leapfrog(f64),
    /// `solver.method` of the scene, at the tolerance of the reference if it wants one.
    Library(fn(f64) -> Value),
    /// CVODE at a tenth of the tolerance of the reference: backward differences damp vibration.
    Cvode(cvode::Method),
}

/// A method of the study.
#[derive(Clone, Copy)]
pub struct Method {
    /// Name, for headings.
    pub name: &'static str,
    /// How it integrates.
    pub solver: Solver,
    /// Whether its runs are part of the reference.
    pub reference: bool,
    /// Runs for every run of a costly method.
    pub repeats: usize,
}

/// The leapfrog with a step in units of 1/(highest frequency).
pub const fn leapfrog(name: &'static str, step: f64) -> Method {
    Method { name, solver: Solver::Leapfrog(step), reference: false, repeats: 2 }
}

/// A method of the library.
pub const fn library(name: &'static str, method: fn(f64) -> Value) -> Method {
    Method { name, solver: Solver::Library(method), reference: false, repeats: 1 }
}

const fn reference(name: &'static str, solver: Solver) -> Method {
    Method { name, solver, reference: true, repeats: 1 }
}

/// Methods for all cases.
pub const METHODS: [Method; 11] = [
    reference("CVODE, reference", Solver::Cvode(cvode::Method::Bdf)),
    reference("Dormand-Prince, reference", Solver::Library(|t| json!({"dormand_prince": {"tolerance": t}}))),
    library("Rosenbrock 1e-5", |_| json!({"rosenbrock": {"tolerance": 1e-5}})),
    library("Rosenbrock 1e-4", |_| json!({"rosenbrock": {"tolerance": 1e-4}})),
    library("Rosenbrock 1e-3", |_| json!({"rosenbrock": {"tolerance": 1e-3}})),
    Method { repeats: 2, ..library("auto", |_| json!({"auto": {}})) },
    leapfrog("leapfrog 1/4", 0.25),
    leapfrog("leapfrog 1/2", 0.5),
    leapfrog("leapfrog 1", 1.0),
    leapfrog("leapfrog 7/5", 1.4),
    leapfrog("leapfrog 8/5", 1.6),
];
