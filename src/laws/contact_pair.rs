//! What contact laws share: the motion of a pair of surfaces in, normal and tangential force out.

use crate::scalar::{Lanes, Numeric, Pack, WIDEST};
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

impl ContactMotion<Lanes> {
    /// Sets the motion at a place of the lanes.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, motion: &ContactMotion<f64>) {
        let i = lane % WIDEST;
        self.delta[i] = motion.delta;
        self.delta_dot[i] = motion.delta_dot;
        self.u1[i] = motion.u1;
        self.u2[i] = motion.u2;
    }

    /// Motion at a place of the lanes.
    #[inline(always)]
    pub fn of(&self, lane: usize) -> ContactMotion<f64> {
        let i = lane % WIDEST;
        ContactMotion { delta: self.delta[i], delta_dot: self.delta_dot[i], u1: self.u1[i], u2: self.u2[i] }
    }

    /// Motions from this place of the lanes on, as many as fit.
    #[inline(always)]
    pub fn load<S: Simd, const K: usize>(&self, simd: S, lane: usize) -> ContactMotion<Pack<S, K>> {
        ContactMotion {
            delta: Pack::load(simd, &self.delta[lane..]),
            delta_dot: Pack::load(simd, &self.delta_dot[lane..]),
            u1: Pack::load(simd, &self.u1[lane..]),
            u2: Pack::load(simd, &self.u2[lane..]),
        }
    }

    /// Sets the motions from this place of the lanes on.
    #[inline(always)]
    pub fn store<S: Simd, const K: usize>(&mut self, lane: usize, motion: &ContactMotion<Pack<S, K>>) {
        motion.delta.store(&mut self.delta[lane..]);
        motion.delta_dot.store(&mut self.delta_dot[lane..]);
        motion.u1.store(&mut self.u1[lane..]);
        motion.u2.store(&mut self.u2[lane..]);
    }
}

impl ContactForce<Lanes> {
    /// Sets the force at a place of the lanes.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, force: &ContactForce<f64>) {
        let i = lane % WIDEST;
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

    /// Force at a place of the lanes.
    #[inline(always)]
    pub fn of(&self, lane: usize) -> ContactForce<f64> {
        self.map(|column| column[lane % WIDEST])
    }

    /// Sets the forces from this place of the lanes on, without their derivatives if they have any.
    #[inline(always)]
    pub fn store<S: Simd, const K: usize, T: Numeric<Base = Pack<S, K>>>(
        &mut self,
        lane: usize,
        force: &ContactForce<T>,
    ) {
        force.normal.base().store(&mut self.normal[lane..]);
        force.stiffness.base().store(&mut self.stiffness[lane..]);
        force.damping.base().store(&mut self.damping[lane..]);
        force.film.base().store(&mut self.film[lane..]);
        force.film_ratio.base().store(&mut self.film_ratio[lane..]);
        force.temperature_rise.base().store(&mut self.temperature_rise[lane..]);
        force.friction_coefficient.base().store(&mut self.friction_coefficient[lane..]);
        force.friction.base().store(&mut self.friction[lane..]);
        force.friction_secant.base().store(&mut self.friction_secant[lane..]);
        force.rolling_resistance.base().store(&mut self.rolling_resistance[lane..]);
    }
}

impl<T: Copy> ContactForce<T> {
    /// The same number everywhere; with zero the forces of two surfaces that do not touch.
    #[inline(always)]
    pub const fn none(zero: T) -> Self {
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
