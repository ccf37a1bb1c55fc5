//! Pocket with plane walls across the circumference.
//!
//! ```text
//! delta = |s| - c_p/2,   s = d . t,   n = sgn(s) t
//! ```
//!
//! d element centre relative to the pocket centre, t circumferential direction of the pocket, c_p clearance between
//! element and both walls together. The walls turn with the cage and are unbounded radially. Source: Takeshima et al.
//! 2025, section 3.

use super::pocket::{Pillar, PillarContact, PocketMotion, PocketPlace};
use crate::scalar::Real;

/// Shape of the pockets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanePocket {
    /// Place and element size.
    pub place: PocketPlace,
    /// c_p/2: clearance on each side of a centred element, m.
    pub clearance: f64,
}

impl PlanePocket {
    /// True when no wall can touch an element at `offset`.
    #[inline]
    pub fn apart<T: Real>(&self, offset: [T; 2]) -> bool {
        offset[1].value().abs() < self.clearance
    }

    /// The contact with the wall of one pillar; `None` when they are apart.
    #[inline]
    pub fn wall<T: Real>(&self, side: Pillar, m: &PocketMotion<T>) -> Option<PillarContact<T>> {
        let sign = side.sign();
        let delta = m.offset[1] * sign - self.clearance;
        if delta.value() <= 0.0 {
            return None;
        }
        let normal = [T::constant(0.0), T::constant(sign)];
        Some(self.place.contact(m, delta, normal, T::constant(0.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const P: PlanePocket =
        PlanePocket { place: PocketPlace { pitch_radius: 0.045, element_radius: 0.004 }, clearance: 0.25e-3 };

    #[test]
    fn walls_are_flat_and_face_each_other() {
        for radial in [-0.3e-3, 0.0, 0.2e-3] {
            let m = |s: f64| PocketMotion { offset: [radial, s], velocity: [0.3, 0.2], spin: -1500.0 };
            let front = P.wall(Pillar::Front, &m(0.251e-3)).unwrap();
            assert!((front.motion.delta - 1e-6).abs() < 1e-18);
            assert_eq!(front.frame.normal, [0.0, 1.0]);
            assert_eq!(front.motion.delta_dot, 0.2);
            // The front wall's t points inwards: radial sliding and spin at the contact.
            assert!((front.motion.u1 - (-0.3 - 1500.0 * 0.004)).abs() < 1e-14);
            let back = P.wall(Pillar::Back, &m(-0.252e-3)).unwrap();
            assert!((back.motion.delta - 2e-6).abs() < 1e-18);
            assert_eq!(back.motion.delta_dot, -0.2);
            assert!(P.apart([radial, 0.249e-3]) && P.wall(Pillar::Front, &m(0.249e-3)).is_none());
        }
    }
}
