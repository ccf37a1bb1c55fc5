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

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod bodies;
pub mod capi;
mod error;
pub mod integrate;
pub mod laws;
pub mod model;
pub mod pairs;
mod registry;
pub mod scalar;
pub mod scene;
pub mod sim;
pub mod space;

pub use error::{Error, Result, Status};
pub use model::Model;
pub use scene::Scene;
pub use sim::{CageMotion, Interval, Recording, Sim, Spread, WhirlRecord, WhirlSummary};
