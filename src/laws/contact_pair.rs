//! What contact laws share: the motion of a pair of surfaces in, normal and tangential force out.

use crate::scalar::{Numeric, Pack};
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

impl ContactMotion<Vec<f64>> {
    /// Sets the motion of contact `i`.
    ///
    /// # Panics
    /// If there is no such place.
    #[inline(always)]
    pub fn set(&mut self, i: usize, motion: &ContactMotion<f64>) {
        self.delta[i] = motion.delta;
        self.delta_dot[i] = motion.delta_dot;
        self.u1[i] = motion.u1;
        self.u2[i] = motion.u2;
    }

    /// Motions of the contacts from the first one on, as many as fit.
    ///
    /// # Panics
    /// If there are not as many.
    #[inline(always)]
    pub fn load<S: Simd, const K: usize>(&self, simd: S, first: usize) -> ContactMotion<Pack<S, K>> {
        ContactMotion {
            delta: Pack::load(simd, &self.delta[first..]),
            delta_dot: Pack::load(simd, &self.delta_dot[first..]),
            u1: Pack::load(simd, &self.u1[first..]),
            u2: Pack::load(simd, &self.u2[first..]),
        }
    }
}

impl ContactForce<Vec<f64>> {
    /// Sets the force of contact `i`.
    ///
    /// # Panics
    /// If there is no such place.
    #[inline(always)]
    pub fn set(&mut self, i: usize, force: &ContactForce<f64>) {
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

    /// Sets the forces of the contacts from the first one on, without their derivatives if they have any.
    ///
    /// # Panics
    /// If there are not as many places.
    #[inline(always)]
    pub fn store<S: Simd, const K: usize, T: Numeric<Base = Pack<S, K>>>(
        &mut self,
        first: usize,
        force: &ContactForce<T>,
    ) {
        force.normal.base().store(&mut self.normal[first..]);
        force.stiffness.base().store(&mut self.stiffness[first..]);
        force.damping.base().store(&mut self.damping[first..]);
        force.film.base().store(&mut self.film[first..]);
        force.film_ratio.base().store(&mut self.film_ratio[first..]);
        force.temperature_rise.base().store(&mut self.temperature_rise[first..]);
        force.friction_coefficient.base().store(&mut self.friction_coefficient[first..]);
        force.friction.base().store(&mut self.friction[first..]);
        force.friction_secant.base().store(&mut self.friction_secant[first..]);
        force.rolling_resistance.base().store(&mut self.rolling_resistance[first..]);
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
