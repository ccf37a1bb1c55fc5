//! What a model tells: names, force reports, output channels, and what is followed in every step.

mod channels;
mod faults;
mod forces;
mod geometry;
mod names;
mod reading;
mod selection;
mod watch;

pub use channels::Channel;
pub use forces::{CONTACT_QUANTITIES, ContactForces, FORCE_COMPONENTS, Forces, GuideReport, Quantity};
pub use names::StateInfo;
pub(crate) use reading::Reading;
pub(super) use selection::Selection;
