//! What the films between a journal and its bush have in common: motion, roundness, force.
//!
//! The journal turns inside the bush. A cage guided by the outer ring is the journal; a cage guided by the inner ring
//! is the bush and the ring the journal. All motion is that of the journal relative to the bush, in axes that do not
//! turn.

use crate::scalar::Real;

/// One harmonic of a profile that thins the film by `amplitude * cos(order * (theta - profile angle) + phase)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonic {
    /// n >= 2.
    pub order: u32,
    /// a_n, m; positive where the profile thins the film.
    pub amplitude: f64,
    /// b_n, rad.
    pub phase: f64,
}

/// Motion of a journal in its bush.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JournalMotion<T> {
    /// Centre of the journal relative to that of the bush (y, z), m.
    pub position: [T; 2],
    /// Its velocity, m/s.
    pub velocity: [T; 2],
    /// Rotation speed of the journal, rad/s.
    pub journal_speed: T,
    /// Rotation speed of the bush, rad/s.
    pub bush_speed: T,
    /// Angle psi of the surface that carries the roundness profile, rad.
    pub profile_angle: T,
    /// Rotation speed of that surface, rad/s.
    pub profile_speed: T,
}

impl<T: Real> JournalMotion<T> {
    /// The same without derivatives.
    pub fn value(&self) -> JournalMotion<f64> {
        JournalMotion {
            position: self.position.map(Real::value),
            velocity: self.velocity.map(Real::value),
            journal_speed: self.journal_speed.value(),
            bush_speed: self.bush_speed.value(),
            profile_angle: self.profile_angle.value(),
            profile_speed: self.profile_speed.value(),
        }
    }
}

/// Film force on the journal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmForce<T> {
    /// Force of the pressure (y, z), N.
    pub pressure: [T; 2],
    /// Force of the shear stress (y, z), N.
    pub shear: [T; 2],
    /// Moment about the centre of the journal, N m.
    pub moment: T,
}

/// The surfaces touch or overlap somewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoFilm {
    /// Smallest film thickness found, m; zero, negative or NaN.
    pub minimum_film: f64,
}

impl<T: Real> FilmForce<T> {
    /// No force.
    #[inline]
    pub fn none() -> Self {
        let zero = T::constant(0.0);
        Self { pressure: [zero; 2], shear: [zero; 2], moment: zero }
    }

    /// Pressure and shear together (y, z), N.
    #[inline]
    pub fn force(&self) -> [T; 2] {
        [self.pressure[0] + self.shear[0], self.pressure[1] + self.shear[1]]
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Of a journal that turns at `speed` (rad/s) in a bush at rest.
    pub(in crate::laws::guide) fn motion(
        position: [f64; 2],
        velocity: [f64; 2],
        speed: f64,
    ) -> JournalMotion<f64> {
        JournalMotion {
            position,
            velocity,
            journal_speed: speed,
            bush_speed: 0.0,
            profile_angle: 0.3,
            profile_speed: speed,
        }
    }
}
