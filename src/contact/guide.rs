//! Cage and guiding ring: who is the journal, and the way back from the force on it to both bodies. Global frame.
//!
//! Forces act through the centre of the journal; the bush carries in addition the moment of the force about its own
//! centre, so both wrenches balance.

use super::Wrench;
use crate::laws::guide::GuideForce;
use crate::laws::journal::JournalMotion;
use crate::scalar::Real;

/// Planar motion of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyMotion<T> {
    /// Centre (y, z), m.
    pub position: [T; 2],
    /// Velocity of the centre, m/s.
    pub velocity: [T; 2],
    /// Rotation angle, rad.
    pub angle: T,
    /// Rotation speed, rad/s.
    pub speed: T,
}

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
    pub fn journal_motion<T: Real>(self, cage: &BodyMotion<T>, ring: &BodyMotion<T>) -> JournalMotion<T> {
        let (journal, bush) = match self {
            GuideSide::CageInside => (cage, ring),
            GuideSide::CageOutside => (ring, cage),
        };
        JournalMotion {
            position: std::array::from_fn(|k| journal.position[k] - bush.position[k]),
            velocity: std::array::from_fn(|k| journal.velocity[k] - bush.velocity[k]),
            journal_speed: journal.speed,
            bush_speed: bush.speed,
            profile_angle: cage.angle,
            profile_speed: cage.speed,
        }
    }

    /// The force on the cage, with its moment about the cage centre.
    pub fn on_cage<T: Real>(self, f: &GuideForce<T>, m: &JournalMotion<T>) -> GuideForce<T> {
        match self {
            GuideSide::CageInside => *f,
            GuideSide::CageOutside => GuideForce {
                pressure: f.pressure.map(|x| -x),
                shear: f.shear.map(|x| -x),
                solid: f.solid.map(|x| -x),
                moment: -(f.moment + carried(f, m)),
                ..*f
            },
        }
    }

    /// Wrenches on the cage and on the ring.
    pub fn wrenches<T: Real>(self, f: &GuideForce<T>, m: &JournalMotion<T>) -> [Wrench<T>; 2] {
        let force = f.force();
        let on_journal = Wrench { force, moment: f.moment };
        let on_bush = Wrench { force: force.map(|x| -x), moment: -(f.moment + carried(f, m)) };
        match self {
            GuideSide::CageInside => [on_journal, on_bush],
            GuideSide::CageOutside => [on_bush, on_journal],
        }
    }
}

/// Moment of the force on the journal about the centre of the bush.
fn carried<T: Real>(f: &GuideForce<T>, m: &JournalMotion<T>) -> T {
    let [y, z] = f.force();
    m.position[0] * z - m.position[1] * y
}
