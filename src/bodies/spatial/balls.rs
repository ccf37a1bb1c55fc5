//! Balls, each at (x, r_p + rho, psi) in cylindrical coordinates about the axis of the bearing, with the angular velocity in the axes
//! of its azimuth.
//!
//! ```text
//! m x'' = F_x,   m (rho'' - r psi'^2) = F_r,   m (r psi'' + 2 rho' psi') = F_psi,   r = r_p + rho
//! I w_x' = M_x,   I (w_r' - psi' w_psi) = M_r,   I (w_psi' + psi' w_r) = M_psi,   I = (2/5) m R^2
//! ```
//!
//! The terms with psi' are the whole gyroscopic effect. A sphere has no orientation.

use super::AXIAL_OFFSET;
use crate::bodies::elements::RADIAL_OFFSET;
use crate::bodies::{Coordinate, ElementSet, Moves};
use crate::scalar::{Base, Numeric, Of};
use crate::scene::Scene;
use crate::space::solid::{Moving, Vector};

/// Balls with states of their own.
#[derive(Debug)]
pub(crate) struct Balls {
    /// Mass (kg) and moment of inertia (kg m^2) of each: those of its own radius.
    inertia: Vec<[f64; 2]>,
}

/// Speeds of a ball.
pub(crate) const OF_BALL: usize = 6;

const COORDINATES: [Coordinate; OF_BALL] = [
    AXIAL_OFFSET,
    RADIAL_OFFSET,
    Coordinate {
        position: Some(["orbit_travel", "rad", "orbit angle travelled since the start"]),
        rate: ["orbit_speed", "rad/s", "rate of the orbit angle"],
        moves: Moves::PitchCircle,
    },
    Coordinate {
        position: None,
        rate: ["spin_x", "rad/s", "angular velocity about the axis of the bearing"],
        moves: Moves::Surface,
    },
    Coordinate {
        position: None,
        rate: ["spin_r", "rad/s", "angular velocity about the outward axis"],
        moves: Moves::Surface,
    },
    Coordinate {
        position: None,
        rate: ["spin_t", "rad/s", "angular velocity about the axis along the orbit"],
        moves: Moves::Surface,
    },
];

impl Balls {
    /// Motion of one with these speeds in the axes of its azimuth, at the distance `r` (m) from the axis of the bearing.
    #[inline(always)]
    pub(crate) fn moving<T: Numeric>([x, rho, orbit, wx, wr, wt]: [T; OF_BALL], r: T) -> Moving<T> {
        Moving { velocity: [x, rho, r * orbit], turning: [wx, wr, wt] }
    }

    /// Those of a scene, or its elements of prescribed motion, which have no mass.
    pub(crate) fn new(scene: &Scene, set: &ElementSet) -> Self {
        let mass = scene.balls.as_ref().map_or(0.0, |balls| balls.mass);
        let of = |excess: &f64| {
            let scale = 1.0 + excess / set.radius;
            let (mass, radius) = (mass * scale * scale * scale, set.radius * scale);
            [mass, 0.4 * mass * radius * radius]
        };
        Self { inertia: set.radius_excess.iter().map(of).collect() }
    }

    /// Its coordinates.
    pub(crate) fn coordinates(&self) -> &'static [Coordinate] {
        &COORDINATES
    }

    /// Mass (kg) and moment of inertia (kg m^2) of ball `j`.
    pub(crate) fn inertia(&self, j: usize) -> [f64; 2] {
        self.inertia[j]
    }

    /// Accelerations of its six speeds (x', rho', psi', w_x, w_r, w_psi) at a distance `r` (m) from the axis, under this force (N) and moment
    /// (N m) in the axes of its azimuth and gravity outwards and along the orbit, m/s^2.
    #[inline(always)]
    pub(crate) fn accelerations<B: Base, T: Of<B>>(
        [mass, inertia]: [B; 2],
        r: T,
        speeds: [T; OF_BALL],
        [[fx, fr, ft], [mx, mr, mt]]: [Vector<T>; 2],
        [outwards, ahead]: [T; 2],
    ) -> [T; OF_BALL] {
        let [_, rho, orbit, _, wr, wt] = speeds;
        [
            fx / mass,
            fr / mass + r * orbit * orbit + outwards,
            (ft / mass - rho * orbit * 2.0 + ahead) / r,
            mx / inertia,
            mr / inertia + orbit * wt,
            mt / inertia - orbit * wr,
        ]
    }
}
