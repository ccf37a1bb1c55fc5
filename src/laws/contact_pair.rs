//! What contact laws share: the motion of a pair of surfaces in, normal and tangential force out.

use crate::scalar::Real;

/// Motion of a contact pair, as the laws see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactMotion<T> {
    /// Approach delta, m; positive in contact.
    pub delta: T,
    /// Approach speed, m/s.
    pub delta_dot: T,
    /// Surface speed of body 1 (the roller) relative to the contact point, m/s.
    pub u1: T,
    /// Surface speed of body 2 (the mate) relative to the contact point, m/s.
    pub u2: T,
}

/// Everything a contact law computes; what a law does not have is zero. All zero when the surfaces are apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactForce<T> {
    /// Normal force Q, N.
    pub normal: T,
    /// Elastic stiffness dQ_el/d(delta), N/m.
    pub stiffness: T,
    /// Normal damping dQ/d(delta_dot), N s/m.
    pub damping: T,
    /// Central film thickness h_c, m.
    pub film: T,
    /// Film ratio Lambda.
    pub film_ratio: T,
    /// Temperature rise dT of the film, K.
    pub temperature_rise: T,
    /// Traction coefficient mu >= 0.
    pub friction_coefficient: T,
    /// Friction on body 1 along t, N; opposes u1 - u2.
    pub friction: T,
    /// |F_T|/|du|, N s/m: the secant slope of friction.
    pub friction_secant: T,
    /// Rolling resistance on each surface along t, N; opposes the rolling velocity.
    pub rolling_resistance: T,
}

impl<T: Real> ContactForce<T> {
    /// The forces of two surfaces that do not touch.
    pub fn apart() -> Self {
        let zero = T::constant(0.0);
        Self {
            normal: zero,
            stiffness: zero,
            damping: zero,
            film: zero,
            film_ratio: zero,
            temperature_rise: zero,
            friction_coefficient: zero,
            friction: zero,
            friction_secant: zero,
            rolling_resistance: zero,
        }
    }
}
