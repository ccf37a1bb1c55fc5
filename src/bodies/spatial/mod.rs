//! Bodies that move in space: coordinates, inertia and weight of balls and of a ring that shifts and tilts.

mod balls;
mod ring;

pub(crate) use balls::Balls;
pub(crate) use ring::{RING_COORDINATES, RingInSpace};

/// Coordinates of a ring in space.
pub(crate) const OF_RING: usize = 5;
