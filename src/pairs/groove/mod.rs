//! Balls in the grooves of the raceways.

mod geometry;

pub(crate) use geometry::{Fit, Groove, RingPlace, Side, Touch};
