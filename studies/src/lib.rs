//! Studies of cagedyn, and what they share with its tests: what effects cost and change, statistics of long runs, random scenes;
//! CVODE as a reference, random numbers, pictures.

#![allow(missing_docs, clippy::result_unit_err, reason = "read in this repository only")]

pub mod cvode;
pub mod effects;
pub mod judge;
#[path = "../../src/bin/cagedyn/plots"]
pub mod plots {
    pub mod axis;
    pub mod panel;
    pub mod style;
}
pub mod random;
#[path = "../../src/bin/cagedyn/spectrum.rs"]
pub mod spectrum;
pub mod statistics;

use cagedyn::{Error, Status};
use std::path::Path;

/// An error with a path.
pub fn file_error(path: &Path, e: impl std::fmt::Display) -> Error {
    Error::new(Status::File, format!("{}: {e}", path.display()))
}
