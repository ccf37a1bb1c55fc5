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
    #[inline]
    pub fn journal_motion<T: Real>(self, cage: &BodyMotion<T>, ring: &BodyMotion<T>) -> JournalMotion<T> {
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
fn difference<T: Real>(a: [T; 2], b: [T; 2]) -> [T; 2] {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::guide::{GuideLaw, GuideSolid};
    use crate::laws::solid_contact::SolidContact;
    use crate::laws::solid_friction::SolidFriction;

    fn law() -> GuideLaw {
        let friction = Some(SolidFriction { coefficient: 0.2, transition_speed: 0.01 });
        let contact = SolidContact { stiffness: 1e6, damping: 0.0, softening_depth: 0.0, friction };
        let solid = Some(GuideSolid { contact, asperity_height: 0.0 });
        GuideLaw {
            radius: 35e-3,
            free_clearance: 0.2e-3,
            film: None,
            solid,
            roughness: 0.0,
            touching_ratio: 0.0,
        }
    }

    fn body(position: [f64; 2], speed: f64) -> BodyMotion<f64> {
        BodyMotion { position, velocity: [0.0; 2], angle: 0.0, speed }
    }

    #[test]
    fn a_cage_around_a_ring_is_pushed_back_and_driven_by_it() {
        let (cage, ring) = (body([0.21e-3, 0.0], 100.0), body([0.0; 2], 300.0));
        let side = GuideSide::CageOutside;
        let m = side.journal_motion(&cage, &ring);
        let f = law().force(&m).unwrap();
        let [on_cage, on_ring] = side.wrenches(&f, &m);
        // 10 um deep at the left of the ring, where its surface moves down and drags the cage.
        assert!(
            (on_cage.force[0] + 10.0).abs() < 1e-9 && (on_cage.force[1] + 2.0).abs() < 1e-9,
            "{on_cage:?}"
        );
        assert!(on_cage.moment > 0.0 && on_ring.moment < 0.0);
        let reported = side.on_cage(&f, &m);
        assert_eq!((reported.force(), reported.moment), (on_cage.force, on_cage.moment));
    }

    #[test]
    fn both_sides_balance() {
        for side in [GuideSide::CageInside, GuideSide::CageOutside] {
            let (cage, ring) = (body([0.15e-3, -0.16e-3], 100.0), body([1e-5, 2e-5], -300.0));
            let m = side.journal_motion(&cage, &ring);
            let [a, b] = side.wrenches(&law().force(&m).unwrap(), &m);
            assert_eq!([a.force[0] + b.force[0], a.force[1] + b.force[1]], [0.0; 2]);
            let about_origin =
                |w: &Wrench<f64>, x: [f64; 2]| w.moment + x[0] * w.force[1] - x[1] * w.force[0];
            let sum = about_origin(&a, cage.position) + about_origin(&b, ring.position);
            assert!(sum.abs() < 1e-15, "{sum}");
        }
    }
}
