//! Which of cage and ring is the journal, and the way back from the force on it to both bodies. Global frame.

use crate::laws::guide::GuideForce;
use crate::laws::guide::journal::JournalMotion;
use crate::pairs::slope_sums::Slope;
use crate::scalar::{Dual, Real};
use crate::space::{Motion, Wrench};

/// A number with derivatives over what the law sees, in the order of [`JournalMotion`].
pub(super) type JournalDual = Dual<8>;

/// Side of the guide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GuideSide {
    /// The cage is the journal inside the ring.
    CageInside,
    /// The cage is the bush around the ring.
    CageOutside,
}

impl GuideSide {
    /// Motion of the journal in the bush. The roundness profile is that of the cage.
    #[inline]
    pub fn journal_motion<T: Real>(self, cage: &Motion<T>, ring: &Motion<T>) -> JournalMotion<T> {
        let (journal, bush) = match self {
            GuideSide::CageInside => (cage, ring),
            GuideSide::CageOutside => (ring, cage),
        };
        JournalMotion {
            position: difference(journal.position, bush.position),
            velocity: difference(journal.velocity, bush.velocity),
            journal_speed: journal.speed,
            bush_speed: bush.speed,
            profile_angle: cage.angle,
            profile_speed: cage.speed,
        }
    }

    /// Derivatives over the motions of cage and ring: y, z and angle, and their rates.
    #[inline]
    pub(super) fn over_bodies(self, row: &JournalDual) -> [Slope<3, 3>; 2] {
        let [y, z, vy, vz, journal, bush, angle, profile] = row.eps;
        match self {
            GuideSide::CageInside => {
                [([y, z, angle], [vy, vz, journal + profile]), ([-y, -z, 0.0], [-vy, -vz, bush])]
            }
            GuideSide::CageOutside => {
                [([-y, -z, angle], [-vy, -vz, bush + profile]), ([y, z, 0.0], [vy, vz, journal])]
            }
        }
    }

    /// The force on the cage, with its moment about the cage centre.
    #[inline]
    pub fn on_cage<T: Real>(self, f: &GuideForce<T>, m: &JournalMotion<T>) -> GuideForce<T> {
        match self {
            GuideSide::CageInside => *f,
            GuideSide::CageOutside => GuideForce {
                pressure: opposite(f.pressure),
                shear: opposite(f.shear),
                solid: opposite(f.solid),
                moment: -(f.moment + carried(f, m)),
                film_moment: -(f.film_moment + carried(&f.of_film(), m)),
                ..*f
            },
        }
    }

    /// Wrenches on the cage and on the ring.
    #[inline]
    pub fn wrenches<T: Real>(self, f: &GuideForce<T>, m: &JournalMotion<T>) -> [Wrench<T>; 2] {
        let force = f.force();
        let on_journal = Wrench { force, moment: f.moment };
        let on_bush = Wrench { force: opposite(force), moment: -(f.moment + carried(f, m)) };
        match self {
            GuideSide::CageInside => [on_journal, on_bush],
            GuideSide::CageOutside => [on_bush, on_journal],
        }
    }
}
#[inline]
pub(super) fn difference<T: Real>(a: [T; 2], b: [T; 2]) -> [T; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

#[inline]
fn opposite<T: Real>([y, z]: [T; 2]) -> [T; 2] {
    [-y, -z]
}

/// Moment of the force on the journal about the centre of the bush.
#[inline]
fn carried<T: Real>(f: &GuideForce<T>, m: &JournalMotion<T>) -> T {
    let [y, z] = f.force();
    m.position[0] * z - m.position[1] * y
}
