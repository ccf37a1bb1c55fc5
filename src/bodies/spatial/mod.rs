//! Bodies that move in space: coordinates, inertia and weight of balls and of a ring that shifts and tilts.

mod balls;
mod ring;

pub(crate) use balls::{Balls, OF_BALL};
pub(crate) use ring::{MovingRing, RING_COORDINATES, RingInSpace, RingState};

/// Coordinates of a ring in space.
pub(crate) const OF_RING: usize = 5;
