//! Solid contact: spring and damper in parallel (Voigt) with friction.
//!
//! ```text
//! N = max(0, k d + c s(d) d'),   s = smoothstep(d / delta_d)
//! F = mu(|du|) N against the sliding speed du
//! ```
//!
//! d depth of contact. With delta_d = 0 the damper acts in full from first touch, as in the paper, and N jumps there;
//! a positive delta_d makes N continuous and is an assumption of this library. N never pulls. Source: Takeshima et
//! al., Front. Mech. Eng. 10 (2025), section 3.

use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::traction::solid_friction::SolidFriction;
use crate::scalar::{Base, Of, smoothstep};

/// Added to |du| in m/s, so that friction and its slope are defined at zero slip.
const SLIP_FLOOR: f64 = 1e-12;

/// Constants of a solid contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidContact {
    /// k, N/m.
    pub stiffness: f64,
    /// c, N s/m.
    pub damping: f64,
    /// delta_d, m; 0 for a damper that jumps in.
    pub softening_depth: f64,
    /// Friction, if there is any.
    pub friction: Option<SolidFriction>,
}

impl SolidContact {
    /// Normal force and friction of the pair. `motion.delta` is the depth d.
    #[inline(always)]
    pub fn force<B: Base, T: Of<B>>(&self, motion: &ContactMotion<T>) -> ContactForce<T> {
        let zero = motion.delta.like(0.0);
        // Written so that a NaN depth is passed on and not taken for "apart".
        let apart = motion.delta.at_most(0.0);
        let share = if self.softening_depth > 0.0 {
            smoothstep(motion.delta / self.softening_depth)
        } else {
            motion.delta.like(1.0)
        };
        let damping = share * self.damping;
        let normal = motion.delta * self.stiffness + damping * motion.delta_dot;
        let nothing = apart | normal.at_most(0.0);
        let mut out = ContactForce::none(zero);
        out.normal = T::select(nothing, zero, normal);
        out.stiffness = T::select(nothing, zero, zero.like(self.stiffness));
        out.damping = T::select(nothing, zero, damping);
        if let Some(friction) = &self.friction {
            let du = motion.u1 - motion.u2;
            let slip = du.abs() + SLIP_FLOOR;
            let coefficient = friction.map(&mut |x| zero.base().splat(*x)).at(slip);
            let secant = coefficient * out.normal / slip;
            out.friction_coefficient = T::select(nothing, zero, coefficient);
            out.friction_secant = secant;
            out.friction = -(secant * du);
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONTACT: SolidContact = SolidContact {
        stiffness: 1e6,
        damping: 44.4,
        softening_depth: 1e-6,
        friction: Some(SolidFriction { coefficient: 0.1, transition_speed: 0.01 }),
    };

    fn at(delta: f64, delta_dot: f64, slip: f64) -> ContactForce<f64> {
        CONTACT.force(&ContactMotion { delta, delta_dot, u1: slip, u2: 0.0 })
    }

    #[test]
    fn spring_damper_and_friction() {
        let f = at(5e-6, 0.02, 1.0);
        assert!((f.normal - (5.0 + 44.4 * 0.02)).abs() < 1e-12);
        assert!((f.friction + 0.1 * f.normal).abs() < 1e-9);
        assert_eq!(at(5e-6, 0.0, 0.0).friction, 0.0);
        assert!(at(5e-6, 0.0, -0.3).friction > 0.0);
    }

    #[test]
    fn touches_continuously_and_never_pulls() {
        assert_eq!(at(-1e-9, 1.0, 1.0), ContactForce::none(0.0));
        assert!(at(1e-12, 1.0, 1.0).normal < 1e-5);
        assert_eq!(at(1e-6, -10.0, 1.0).normal, 0.0);
        assert!(at(f64::NAN, 0.0, 0.0).normal.is_nan());
    }

    #[test]
    fn without_softening_the_damper_jumps_in() {
        let literal = SolidContact { softening_depth: 0.0, ..CONTACT };
        let f = literal.force(&ContactMotion { delta: 1e-12, delta_dot: 1.0, u1: 0.0, u2: 0.0 });
        assert!((f.normal - 44.4).abs() < 1e-5);
    }
}
