//! What force reports hold at which place, and sums over them.

use cagedyn::model::{BodyForces, Forces};

// Sources of forces, in the order of FORCE_SOURCES.
pub const OUTER: usize = 0;
pub const INNER: usize = 1;
pub const POCKET: usize = 2;
pub const GUIDE: usize = 3;
pub const GRAVITY: usize = 4;
pub const LOAD: usize = 5;
pub const SUPPORT: usize = 6;
pub const NEIGHBOUR: usize = 7;

// Quantities of a contact, in the order of CONTACT_QUANTITIES.
pub const NORMAL: usize = 0;
pub const APPROACH: usize = 1;
pub const FILM: usize = 2;
pub const FILM_RATIO: usize = 3;
pub const TEMPERATURE: usize = 4;
pub const FRICTION: usize = 6;
pub const ROLLING: usize = 7;
pub const SLIP_SPEED: usize = 10;
pub const ROLLING_SPEED: usize = 11;
pub const ROLLING_FACTOR: usize = 18;

// Bodies in force reports; the cage comes before the rollers.
pub const INNER_RING: usize = 1;
pub const CAGE: usize = 2;

/// Largest force of any source on any body, N.
pub fn largest_force(f: &Forces) -> f64 {
    f.bodies.iter().flatten().map(|[y, z, _]| y.hypot(*z)).fold(0.0, f64::max)
}

pub fn sum(body: &BodyForces) -> [f64; 3] {
    body.iter().fold([0.0; 3], |s, f| [s[0] + f[0], s[1] + f[1], s[2] + f[2]])
}
