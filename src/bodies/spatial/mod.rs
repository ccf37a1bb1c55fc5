//! Bodies that move in space: coordinates, inertia and weight of balls and rollers, of a ring that shifts and tilts, and of a cage.

mod balls;
mod cage;
mod ring;
mod rollers;

pub(crate) use balls::{Balls, OF_BALL};
pub(crate) use cage::{CageInSpace, CageState, MovingCage, OF_CAGE, tilt_of};
pub(crate) use ring::{MovingRing, RING_COORDINATES, RingInSpace, RingState};
pub(crate) use rollers::{
    Inclination, MovingRoller, OF_ROLLER, ORBIT, RollerPlace, RollerState, RollersInSpace, SPIN,
};

use crate::bodies::{Coordinate, Moves};

/// A ball or roller along the axis of the bearing.
const AXIAL_OFFSET: Coordinate = Coordinate {
    position: Some(["axial_offset", "m", "place along the axis of the bearing"]),
    rate: ["axial_speed", "m/s", "rate of the axial offset"],
    moves: Moves::Itself,
};

/// The centre of a ring or cage along the axis of the bearing.
const ALONG: Coordinate = Coordinate {
    position: Some(["x", "m", "centre position along the axis of the bearing"]),
    rate: ["vx", "m/s", "velocity of the centre along the axis of the bearing"],
    moves: Moves::Itself,
};

/// Tilts of its axis.
const TILTS: [Coordinate; 2] = [
    Coordinate {
        position: Some(["tilt_y", "rad", "rotation vector of the axis, to the right"]),
        rate: ["tilt_speed_y", "rad/s", "rate of tilt_y"],
        moves: Moves::PitchCircle,
    },
    Coordinate {
        position: Some(["tilt_z", "rad", "rotation vector of the axis, upwards"]),
        rate: ["tilt_speed_z", "rad/s", "rate of tilt_z"],
        moves: Moves::PitchCircle,
    },
];

/// Coordinates of a ring in space.
pub(crate) const OF_RING: usize = 5;
