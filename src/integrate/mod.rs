//! Time integration. Knows second-order systems, steps and errors; nothing of bearings.
//!
//! | folder or file | what |
//! |---|---|
//! | `system` | what a method asks of a system |
//! | `stepper` | what a method gives |
//! | `driver/` | a run: steps, errors, events, undoing, following |
//! | `methods/` | leapfrog, Dormand-Prince, Rosenbrock, Radau |
//! | `auto/` | the choice among them, its monitors and its constants |
//! | `linear/` | structured linear systems |
//!
//! A new method is a file in `methods/`, its name here, in `methods!` of `scene/run.rs` and in `sim/method.rs`.

pub mod auto;
mod driver;
pub mod linear;
mod methods;
mod stepper;
mod system;

pub use auto::balance::throughput;
pub use auto::tuning::{Constant, Tuning};
pub use driver::watch::{Samples, Total};
pub use driver::{Driver, Failure, Limits, Statistics, control};
pub use methods::adams::Adams;
pub use methods::damping::{DampingBlock, GroupDamping, SpokeDamping, implicit_share};
pub use methods::dormand_prince::DormandPrince;
pub use methods::leapfrog::Leapfrog;
pub use methods::radau::Radau;
pub use methods::rosenbrock::Rosenbrock;
pub use stepper::{Applied, Kept, Progress, Stepper, Stretch};
pub use system::{
    Complete, Interruption, Linearization, Linearized, Observed, SemiImplicit, Split, Structure, Structured,
    System, Vibration,
};

pub(crate) use system::{add_weighted, parts_mut, zero_works};
