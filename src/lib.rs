//! Dynamics of the cage, the rolling elements and the rings of a rolling bearing.
//!
//! Data flows one way: JSON text becomes a checked [`Scene`], the scene a compiled [`Model`], and any number of
//! simulations [`Sim`] run on it. The C ABI in `include/cagedyn.h` offers the same in C.
//!
//! ```no_run
//! use std::sync::Arc;
//!
//! fn main() -> cagedyn::Result<()> {
//!     let text = std::fs::read_to_string("scenes/nu2310.json").unwrap_or_default();
//!     let model = Arc::new(cagedyn::Model::from_json(&text)?);
//!     let mut sim = cagedyn::Sim::new(model)?;
//!     sim.advance_to(1e-3)?;
//!     println!("cage centre: {:?} m", &sim.state()[2..4]);
//!     Ok(())
//! }
//! ```
//!
//! What these pages show is the Rust API. The rooms behind it can be reached by the tests and studies of this repository; they are
//! hidden here, and change without notice.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod batch;
mod bodies;
#[doc(hidden)]
pub mod capi;
mod check;
pub mod equilibrium;
mod error;
#[doc(hidden)]
pub mod fmi;
pub mod heat;
#[doc(hidden)]
pub mod integrate;
#[doc(hidden)]
pub mod laws;
pub mod model;
#[doc(hidden)]
pub mod pairs;
mod registry;
#[doc(hidden)]
pub mod scalar;
pub mod scene;
pub mod sim;
#[doc(hidden)]
pub mod space;
#[doc(hidden)]
pub mod stored;
pub mod whirl;

pub use check::Problem;
pub use error::{Error, Result, Status};
pub use model::Model;
pub use scene::Scene;
pub use sim::{CageMotion, Interval, MotionOfCage, Recording, Sim, Spread, WhirlRecord, WhirlSummary};
