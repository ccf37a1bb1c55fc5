//! What a model tells: names, force reports, output channels, and what is followed in every step.

mod channels;
mod forces;
mod geometry;
mod names;
mod reading;
mod watch;

pub(crate) use channels::Source;
pub use forces::{CONTACT_QUANTITIES, ContactForces, FORCE_COMPONENTS, Forces, GuideReport};
pub(crate) use reading::Reading;
pub(super) use watch::Watch;
