//! What a bearing in space tells of a state: forces of every contact and on every body, output channels, what is followed in every step.

mod channels;
mod forces;

pub(super) use channels::channel;
pub(crate) use channels::{Reading, Source};
pub use forces::{
    SPATIAL_CONTACT_QUANTITIES, SPATIAL_FORCE_COMPONENTS, SpatialBodyForces, SpatialContact, SpatialForces,
};
