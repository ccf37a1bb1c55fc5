//! An inner ring in space, at (x, y, z) with the rotation vector (0, tilt_y, tilt_z) of its axis; each of these is free or held.

use super::OF_RING;
use crate::bodies::{CENTRE, Coordinate, Input, InputValues, Moves};
use crate::scene::{Preload, RingCoordinate, RingMotion, Scene};

/// Coordinates of a ring in space.
pub(crate) const RING_COORDINATES: [Coordinate; OF_RING] = [
    Coordinate {
        position: Some(["x", "m", "centre position along the axis of the bearing"]),
        rate: ["vx", "m/s", "velocity of the centre along the axis of the bearing"],
        moves: Moves::Itself,
    },
    CENTRE[0],
    CENTRE[1],
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

/// Inputs that are its load, by coordinate.
const LOADS: [Input; OF_RING] = [Input::LoadX, Input::LoadY, Input::LoadZ, Input::MomentY, Input::MomentZ];

/// The inner ring of a scene.
#[derive(Debug)]
pub(crate) struct RingInSpace {
    /// By coordinate: where it is held, m or rad; `None` of one that is free.
    pub(crate) held: [Option<f64>; OF_RING],
    preload: Option<Preload>,
}

impl RingInSpace {
    /// The inner ring of a scene.
    pub(crate) fn new(scene: &Scene) -> Self {
        match scene.inner_ring.as_ref().map(|ring| &ring.motion) {
            Some(RingMotion::Space(ring)) => {
                let held = ring.coordinates().map(|(_, coordinate)| match coordinate {
                    RingCoordinate::Free => None,
                    RingCoordinate::Held(value) => Some(*value),
                });
                Self { held, preload: ring.preload }
            }
            Some(RingMotion::Fixed(place)) => {
                Self { held: [0.0, place.y, place.z, 0.0, 0.0].map(Some), preload: None }
            }
            _ => Self { held: [Some(0.0); OF_RING], preload: None },
        }
    }

    /// Its coordinates that are free, by their places among all.
    pub(crate) fn free(&self) -> impl Iterator<Item = usize> {
        let held = self.held;
        (0..OF_RING).filter(move |k| held[*k].is_none())
    }

    /// Forces (N) and moments (N m) of the load, beside the spring.
    pub(crate) fn load(&self, inputs: &InputValues) -> [f64; OF_RING] {
        LOADS.map(|input| inputs.of(input))
    }

    /// Force (N) of the spring along the axis with the ring at `x` (m), and its stiffness (N/m).
    pub(crate) fn spring(&self, x: f64) -> [f64; 2] {
        self.preload.map_or([0.0; 2], |spring| [spring.force - spring.stiffness * x, spring.stiffness])
    }
}
