//! What contact laws share: the motion of a pair of surfaces in, normal and tangential force out.

use crate::scalar::{GROUP, Pack};
use pulp::Simd;

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

impl<T> ContactMotion<T> {
    /// The same with every number replaced.
    #[inline(always)]
    pub fn map<U>(&self, mut f: impl FnMut(&T) -> U) -> ContactMotion<U> {
        ContactMotion {
            delta: f(&self.delta),
            delta_dot: f(&self.delta_dot),
            u1: f(&self.u1),
            u2: f(&self.u2),
        }
    }
}

impl<T> ContactForce<T> {
    /// The same with every number replaced.
    #[inline(always)]
    pub fn map<U>(&self, mut f: impl FnMut(&T) -> U) -> ContactForce<U> {
        ContactForce {
            normal: f(&self.normal),
            stiffness: f(&self.stiffness),
            damping: f(&self.damping),
            film: f(&self.film),
            film_ratio: f(&self.film_ratio),
            temperature_rise: f(&self.temperature_rise),
            friction_coefficient: f(&self.friction_coefficient),
            friction: f(&self.friction),
            friction_secant: f(&self.friction_secant),
            rolling_resistance: f(&self.rolling_resistance),
        }
    }
}

impl<S: Simd, const K: usize> ContactForce<Pack<S, K>> {
    /// Writes the forces of a group.
    #[inline(always)]
    pub fn store(&self, out: &mut ContactForce<[f64; GROUP]>) {
        self.normal.store(&mut out.normal);
        self.stiffness.store(&mut out.stiffness);
        self.damping.store(&mut out.damping);
        self.film.store(&mut out.film);
        self.film_ratio.store(&mut out.film_ratio);
        self.temperature_rise.store(&mut out.temperature_rise);
        self.friction_coefficient.store(&mut out.friction_coefficient);
        self.friction.store(&mut out.friction);
        self.friction_secant.store(&mut out.friction_secant);
        self.rolling_resistance.store(&mut out.rolling_resistance);
    }
}

impl<T: Copy, const N: usize> ContactMotion<[T; N]> {
    /// Motion of one contact of a group.
    #[inline(always)]
    pub fn get(&self, i: usize) -> ContactMotion<T> {
        self.map(|x| x[i])
    }

    /// Sets the motion of one contact of a group.
    #[inline(always)]
    pub fn set(&mut self, i: usize, motion: &ContactMotion<T>) {
        self.delta[i] = motion.delta;
        self.delta_dot[i] = motion.delta_dot;
        self.u1[i] = motion.u1;
        self.u2[i] = motion.u2;
    }
}

impl<T: Copy, const N: usize> ContactForce<[T; N]> {
    /// Force of one contact of a group.
    #[inline(always)]
    pub fn get(&self, i: usize) -> ContactForce<T> {
        self.map(|x| x[i])
    }

    /// Sets the force of one contact of a group.
    #[inline(always)]
    pub fn set(&mut self, i: usize, force: &ContactForce<T>) {
        self.normal[i] = force.normal;
        self.stiffness[i] = force.stiffness;
        self.damping[i] = force.damping;
        self.film[i] = force.film;
        self.film_ratio[i] = force.film_ratio;
        self.temperature_rise[i] = force.temperature_rise;
        self.friction_coefficient[i] = force.friction_coefficient;
        self.friction[i] = force.friction;
        self.friction_secant[i] = force.friction_secant;
        self.rolling_resistance[i] = force.rolling_resistance;
    }
}

impl<T: Copy> ContactForce<T> {
    /// The same number everywhere; with zero the forces of two surfaces that do not touch.
    #[inline(always)]
    pub fn none(zero: T) -> Self {
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
