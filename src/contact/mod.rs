//! Pair kinematics: the motion of two bodies in, gap, approach speed and surface speeds out, and the way back
//! from contact forces to forces and moments on the bodies.
//!
//! Conventions (planar): n points from the roller centre to the contact, t is n turned by +90 degrees, angles and
//! speeds are counter-clockwise positive. Vectors of a pair are given in a local frame that the file names.
//!
//! A contact has one contact point at the distance `arm_1` from the centre of body 1 along n and `arm_2` from the
//! centre of body 2 along -n. All tangential forces act there or through the centres, so forces and moments of a
//! pair balance to round-off.

pub mod cylinder_pocket;
pub mod guide;
pub mod plane_pocket;
pub mod pocket;
pub mod raceway;

use crate::laws::contact_pair::ContactForce;
use crate::scalar::{Numeric, Real};

/// Force and moment about the body's own centre.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench<T> {
    /// Force components in the frame of the pair, N.
    pub force: [T; 2],
    /// Moment, N m.
    pub moment: T,
}

/// Geometry of one contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairFrame<T> {
    /// n, from body 1 to the contact.
    pub normal: [T; 2],
    /// Distance from the centre of body 1 to the contact point along n, m.
    pub arm_1: T,
    /// Distance from the contact point to the centre of body 2 along n, m; negative when body 2 surrounds body 1.
    pub arm_2: T,
}

impl<T: Real> PairFrame<T> {
    /// t: n turned by +90 degrees.
    #[inline]
    pub fn tangent(&self) -> [T; 2] {
        [-self.normal[1], self.normal[0]]
    }

    /// Pressure forces of the rolling film through the centres of body 1 and 2 along t, N.
    ///
    /// They are 2 R_e F/R of each body (NTN Eq. 12) with the actual arms for the radii, which differ from the
    /// nominal ones by the elastic approach and make the balance exact.
    #[inline]
    pub fn film_pressure_forces(&self, f: &ContactForce<T>) -> [T; 2] {
        let drive = -(f.rolling_resistance * 2.0);
        let distance = self.arm_1 + self.arm_2;
        [drive * self.arm_2 / distance, drive * self.arm_1 / distance]
    }

    /// Wrenches on body 1 and body 2 for the forces of a line contact.
    #[inline]
    pub fn wrenches(&self, f: &ContactForce<T>) -> [Wrench<T>; 2] {
        let [n, t] = [self.normal, self.tangent()];
        let [pressure_1, pressure_2] = self.film_pressure_forces(f);
        let (surface_1, surface_2) = (f.friction + f.rolling_resistance, f.rolling_resistance - f.friction);
        let (along_1, along_2) = (surface_1 + pressure_1, surface_2 + pressure_2);
        let combine = |normal: T, along: T| [normal * n[0] + along * t[0], normal * n[1] + along * t[1]];
        [
            Wrench { force: combine(-f.normal, along_1), moment: self.arm_1 * surface_1 },
            Wrench { force: combine(f.normal, along_2), moment: -(self.arm_2 * surface_2) },
        ]
    }
}

/// Rotates `v` by the angle whose sine and cosine are given.
#[inline(always)]
pub fn rotate<T: Numeric>(v: [T; 2], sin: T, cos: T) -> [T; 2] {
    [v[0] * cos - v[1] * sin, v[0] * sin + v[1] * cos]
}
