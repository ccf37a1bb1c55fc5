//! How a contact holds its two bodies: the levers by which its forces act on both, and the way back from them to wrenches.
//!
//! Conventions: n points from the centre of the element to the contact, t is n turned by +90 degrees, angles and speeds are
//! counter-clockwise positive. Body 1 is the element, body 2 its mate.
//!
//! A contact has one contact point, at the distance `arm` from the centre of the element along n. All tangential forces act
//! there or through the centres, so forces and moments of a pair balance to round-off.

use crate::laws::contact_pair::ContactForce;
use crate::scalar::{Numeric, Real};
use crate::space::{Frame, Wrench};

/// Levers of one contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip<T> {
    /// n, in the frame of the pair.
    pub normal: [T; 2],
    /// Distance from the centre of the element to the contact point, m.
    pub arm: T,
    /// Lever on the mate.
    pub mate: MateLever<T>,
}

/// Where the contact point is on the mate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MateLever<T> {
    /// Its centre lies on the line through the centre of the element and the contact, so far beyond the contact (m; negative
    /// when the mate surrounds the element). The pair's frame is that of the element.
    Centre(T),
    /// The contact is at this place from its centre, m, in a frame that moves with the mate, which the frame of the element
    /// leads by an angle.
    Point([T; 2], Frame<T>),
}

impl<T: Numeric> Grip<T> {
    /// t: n turned by +90 degrees.
    #[inline(always)]
    pub fn tangent(&self) -> [T; 2] {
        [-self.normal[1], self.normal[0]]
    }

    /// n in the frame of the element.
    #[inline(always)]
    pub fn normal_on_element(&self) -> [T; 2] {
        match self.mate {
            MateLever::Centre(_) => self.normal,
            MateLever::Point(_, lead) => lead.to_local(self.normal),
        }
    }
}

impl<T: Real> Grip<T> {
    /// Pressure forces of the rolling film through the centres of element and mate along t, N.
    ///
    /// They are 2 R_e F/R of each body (NTN Eq. 12) with the actual arms for the radii, which differ from the
    /// nominal ones by the elastic approach and make the balance exact. At a point of the mate nothing rolls.
    #[inline]
    pub fn film_pressure_forces(&self, f: &ContactForce<T>) -> [T; 2] {
        let MateLever::Centre(arm_2) = self.mate else { return [T::constant(0.0); 2] };
        let drive = -(f.rolling_resistance * 2.0);
        let distance = self.arm + arm_2;
        [drive * arm_2 / distance, drive * self.arm / distance]
    }

    /// Wrenches on element and mate in the axes of the element for the forces of a contact.
    #[inline]
    pub fn wrenches(&self, f: &ContactForce<T>) -> [Wrench<T>; 2] {
        let [n, t] = [self.normal, self.tangent()];
        let combine = |normal: T, along: T| [normal * n[0] + along * t[0], normal * n[1] + along * t[1]];
        let surface_1 = f.friction + f.rolling_resistance;
        let moment = self.arm * surface_1;
        match self.mate {
            MateLever::Centre(arm_2) => {
                let [pressure_1, pressure_2] = self.film_pressure_forces(f);
                let surface_2 = f.rolling_resistance - f.friction;
                [
                    Wrench { force: combine(-f.normal, surface_1 + pressure_1), moment },
                    Wrench { force: combine(f.normal, surface_2 + pressure_2), moment: -(arm_2 * surface_2) },
                ]
            }
            MateLever::Point(lever, lead) => {
                let [along_r, along_c] = combine(-f.normal, surface_1);
                let force = lead.to_local([along_r, along_c]);
                let reaction = -(lever[0] * along_c - lever[1] * along_r);
                [Wrench { force, moment }, Wrench { force: [-force[0], -force[1]], moment: reaction }]
            }
        }
    }
}

impl Grip<f64> {
    /// Lever row on the mate of a force along a `direction` of the pair's frame (`n` or `t`), in global axes: (y, z, moment).
    #[inline]
    pub fn row_on_mate(&self, direction: [f64; 2], frame: &Frame<f64>) -> [f64; 3] {
        let [dr, dc] = direction;
        match self.mate {
            MateLever::Centre(arm_2) => {
                let [y, z] = frame.to_global(direction);
                let [nr, nc] = self.normal;
                [y, z, -arm_2 * (nr * dc - nc * dr)]
            }
            MateLever::Point(lever, lead) => {
                let [y, z] = frame.to_global(lead.to_local(direction));
                [y, z, lever[0] * dc - lever[1] * dr]
            }
        }
    }
}
