//! Cage in its guide ring, which is centred at the origin and at rest.
//!
//! The film force acts through the cage centre, the shear moment is a pure moment; the reaction on the ring carries
//! in addition the moment of the force about the ring centre. Global frame (y, z).

use super::Wrench;
use crate::laws::journal::FilmForce;
use crate::scalar::Real;

/// Wrenches on the cage and on the guide ring for a cage centre at `position`, m.
pub fn wrenches<T: Real>(film: &FilmForce<T>, position: [T; 2]) -> [Wrench<T>; 2] {
    let f = film.force();
    let carried = position[0] * f[1] - position[1] * f[0];
    [
        Wrench { force: f, moment: film.moment },
        Wrench { force: [-f[0], -f[1]], moment: -(film.moment + carried) },
    ]
}
