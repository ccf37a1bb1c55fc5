//! How a contact holds its two bodies: the levers by which its forces act on both, and the way back from them to wrenches.
//!
//! Conventions: n points from the centre of the element to the contact, t is n turned by +90 degrees, angles and speeds are
//! counter-clockwise positive. Body 1 is the element, body 2 its mate.
//!
//! ```text
//! force on the element   -n Q + t (F_T + k F_EHLr)          force on the mate   the opposite
//! moments                a (F_T + F_EHLr) + e Q                                 l_n Q + l_t F_T + l_r F_EHLr
//! ```
//!
//! On waves n is the gradient of the approach over the place of the element, a little longer than 1.
//!
//! A contact has one contact point, at the distance a from the centre of the element along n. All tangential forces act
//! there or through the centres, so forces and moments of a pair balance to round-off. The same rows take speeds of the
//! bodies to speeds of the contact, and its damping back to both.

use crate::laws::contact_pair::ContactForce;
use crate::scalar::{Lanes, Numeric, Pack, WIDEST, ZEROS};
use crate::space::{Frame, Wrench};
use pulp::Simd;

/// Levers of one contact, or of several in columns, in the frame of the element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip<T> {
    /// n.
    pub normal: [T; 2],
    /// a, distance from the centre of the element to the contact point, m.
    pub arm: T,
    /// e, moment on the element per normal force, m: zero on one that is round.
    pub offset: T,
    /// k, share of the rolling resistance that drives the element along t.
    pub rolling: T,
    /// l_n, l_t and l_r: moment on the mate per normal force, friction and rolling resistance, m.
    pub on_mate: [T; 3],
}

impl<T: Numeric> Grip<T> {
    /// Contact of two bodies that both are round about their centres, `arm_1` and `arm_2` (m) away from it; `arm_2` is negative
    /// when the mate surrounds the element.
    ///
    /// The pressure of the rolling film drives both through their centres by 2 R_e F/R of each body (NTN Eq. 12), with the
    /// actual arms for the radii, which differ from the nominal ones by the elastic approach and make the balance exact.
    #[inline(always)]
    pub fn centred(normal: [T; 2], arm_1: T, arm_2: T) -> Self {
        let rolling = (arm_1 - arm_2) / (arm_1 + arm_2);
        let none = arm_1.like(0.0);
        Self { normal, arm: arm_1, offset: none, rolling, on_mate: [none, arm_2, -arm_2] }
    }

    /// Contact at a `point` of the mate, m from its centre, with the `normal`, both in a frame that moves with the mate and that
    /// the frame of the element leads by `lead`. Nothing rolls there.
    #[inline(always)]
    pub fn at_point(normal: [T; 2], arm: T, point: [T; 2], lead: Frame<T>) -> Self {
        let across = point[0] * normal[1] - point[1] * normal[0];
        let along = -(point[0] * normal[0] + point[1] * normal[1]);
        let rolling = arm.like(1.0);
        let offset = arm.like(0.0);
        Self { normal: lead.to_local(normal), arm, offset, rolling, on_mate: [across, along, along] }
    }

    /// t: n turned by +90 degrees.
    #[inline(always)]
    pub fn tangent(&self) -> [T; 2] {
        [-self.normal[1], self.normal[0]]
    }

    /// Approach speed and slip in m/s that speeds of the element make: radial and across in m/s, spin in rad/s.
    #[inline(always)]
    pub fn speeds(&self, [radial, across, spin]: [T; 3]) -> [T; 2] {
        let [r, c] = self.normal;
        [r * radial + c * across - self.offset * spin, r * across - c * radial + self.arm * spin]
    }

    /// Pressure forces of the rolling film through the centres of element and mate along t, N.
    #[inline(always)]
    pub fn film_pressure_forces(&self, f: &ContactForce<T>) -> [T; 2] {
        // A difference, so that no force is not a negative zero.
        let none = f.rolling_resistance.like(0.0);
        let on_mate = none - (self.rolling + 1.0) * f.rolling_resistance;
        [(self.rolling - 1.0) * f.rolling_resistance, on_mate]
    }

    /// Wrenches on element and mate for the forces of a contact.
    #[inline(always)]
    pub fn wrenches(&self, f: &ContactForce<T>) -> [Wrench<T>; 2] {
        let ([n, t], [l_n, l_t, l_r]) = ([self.normal, self.tangent()], self.on_mate);
        let along = f.friction + self.rolling * f.rolling_resistance;
        let force = [along * t[0] - f.normal * n[0], along * t[1] - f.normal * n[1]];
        let moment = self.arm * (f.friction + f.rolling_resistance) + self.offset * f.normal;
        let on_mate = l_n * f.normal + l_t * f.friction + l_r * f.rolling_resistance;
        [Wrench { force, moment }, Wrench { force: [-force[0], -force[1]], moment: on_mate }]
    }
}

impl Grip<f64> {
    /// Lever rows on the mate of the normal force and of friction, in global axes: (y, z, moment).
    #[inline]
    pub fn rows_on_mate(&self, frame: &Frame<f64>) -> [[f64; 3]; 2] {
        let [along, across] = [self.normal, self.tangent()].map(|direction| frame.to_global(direction));
        let [l_n, l_t, _] = self.on_mate;
        [[along[0], along[1], l_n], [-across[0], -across[1], l_t]]
    }
}

impl Grip<Lanes> {
    /// Zeros.
    pub const ZERO: Self =
        Self { normal: [ZEROS; 2], arm: ZEROS, offset: ZEROS, rolling: ZEROS, on_mate: [ZEROS; 3] };

    /// Sets the levers at a place of the lanes.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, grip: &Grip<f64>) {
        let i = lane % WIDEST;
        (self.normal[0][i], self.normal[1][i]) = (grip.normal[0], grip.normal[1]);
        (self.arm[i], self.offset[i], self.rolling[i]) = (grip.arm, grip.offset, grip.rolling);
        for (column, lever) in self.on_mate.iter_mut().zip(grip.on_mate) {
            column[i] = lever;
        }
    }

    /// Levers at a place of the lanes.
    #[inline(always)]
    pub fn of(&self, lane: usize) -> Grip<f64> {
        let (i, [n, c], [l_n, l_t, l_r]) = (lane % WIDEST, &self.normal, &self.on_mate);
        let on_mate = [l_n[i], l_t[i], l_r[i]];
        Grip {
            normal: [n[i], c[i]],
            arm: self.arm[i],
            offset: self.offset[i],
            rolling: self.rolling[i],
            on_mate,
        }
    }

    /// Levers from this place of the lanes on, as many as fit.
    #[inline(always)]
    pub fn load<S: Simd, const K: usize>(&self, simd: S, lane: usize) -> Grip<Pack<S, K>> {
        let load = |column: &Lanes| Pack::load(simd, &column[lane..]);
        let ([n, c], [l_n, l_t, l_r]) = (&self.normal, &self.on_mate);
        Grip {
            normal: [load(n), load(c)],
            arm: load(&self.arm),
            offset: load(&self.offset),
            rolling: load(&self.rolling),
            on_mate: [load(l_n), load(l_t), load(l_r)],
        }
    }

    /// Sets the levers from this place of the lanes on.
    #[inline(always)]
    pub fn store<S: Simd, const K: usize>(&mut self, lane: usize, grip: &Grip<Pack<S, K>>) {
        let (Self { normal: [n, c], on_mate: [l_n, l_t, l_r], .. }, from) = (&mut *self, grip);
        from.normal[0].store(&mut n[lane..]);
        from.normal[1].store(&mut c[lane..]);
        from.on_mate[0].store(&mut l_n[lane..]);
        from.on_mate[1].store(&mut l_t[lane..]);
        from.on_mate[2].store(&mut l_r[lane..]);
        from.arm.store(&mut self.arm[lane..]);
        from.offset.store(&mut self.offset[lane..]);
        from.rolling.store(&mut self.rolling[lane..]);
    }
}
