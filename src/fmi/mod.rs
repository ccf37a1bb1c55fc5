//! A bearing as a functional mock-up unit (FMI 2.0 and 3.0): its variables, its description, and an instance of it for co-simulation and
//! model exchange. The functions that importers call are in `capi/fmi`, the file is made by the command `fmu`.
//!
//! Source: Functional Mock-up Interface Specification, 2.0.4 and 3.0.2, <https://fmi-standard.org>.

mod derivatives;
mod description;
mod exchange;
mod instance;
mod saved;
mod units;
mod variables;

pub use description::{Standard, describe};
pub use instance::{Instance, Interface, Mode};
pub use saved::Saved;
pub use variables::Unit;

/// Name of the file with the scene among the resources of a unit.
pub const SCENE_FILE: &str = "scene.json";
