//! Rolling element in its cage pocket: where it is and how it moves there, whatever the shape of the pocket.
//!
//! Each pocket has two pillars, which are evaluated separately, so an element can rest on both. The contact point is
//! fixed in the pocket: u1 is the sliding speed of the element's surface, u2 = 0.
//!
//! Local frame: (radial, circumferential) at the pocket centre, turning with the cage. Walls keep its direction in a bent cage.

use crate::bodies::ElementMotion;
use crate::laws::contact_pair::ContactMotion;
use crate::pairs::Grip;
use crate::scalar::Numeric;
use crate::space::Frame;
use std::fmt::Debug;

/// Place of the pockets in the cage and size of the elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PocketPlace {
    /// Radius of the circle of pocket centres, m.
    pub pitch_radius: f64,
    /// Nominal R_b, m.
    pub element_radius: f64,
}

/// A pillar of the pocket.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pillar {
    /// On the side of growing angle.
    Front,
    /// On the side of falling angle.
    Back,
}

/// Roller centre relative to the pocket.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PocketMotion<T> {
    /// d, m.
    pub offset: [T; 2],
    /// Velocity of the roller centre relative to the cage, m/s.
    pub velocity: [T; 2],
    /// Spin of the roller relative to the cage, rad/s.
    pub spin: T,
    /// How much larger its radius is than R_b, m.
    pub radius_excess: T,
}

impl<T: Numeric> PocketMotion<T> {
    /// The same in a pocket that a deformed cage displaces by the first of these (radial, circumferential), m, at the rate of the
    /// second, m/s.
    #[inline(always)]
    pub fn displace(&mut self, [by, rate]: [[T; 2]; 2]) {
        for k in 0..2 {
            self.offset[k] -= by[k];
            self.velocity[k] -= rate[k];
        }
    }
}

/// One pillar in contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PillarContact<T> {
    /// Motion for the contact law.
    pub motion: ContactMotion<T>,
    /// n, from the element to the contact.
    pub normal: [T; 2],
    /// Share of edge friction: 0 on the wall, 1 on an edge.
    pub edge_share: T,
}

impl PocketPlace {
    /// d in m for an element that is ahead of its pocket by `lead`, with the centre of the cage in the frame of the pocket.
    #[inline(always)]
    pub fn offset<T: Numeric>(&self, radial_offset: T, lead: Frame<T>, cage: [T; 2]) -> [T; 2] {
        let Frame { sin, cos } = lead;
        let r = radial_offset + self.pitch_radius;
        // 1 - cos without cancellation for the small leads of a roller in its pocket.
        let versine = T::select(cos.above(0.0), sin * sin / (cos + 1.0), -cos + 1.0);
        [radial_offset - r * versine - cage[0], r * sin - cage[1]]
    }

    /// Motion of the roller relative to the pocket; velocity (m/s, pocket frame) and rotation speed (rad/s) of the cage.
    #[inline(always)]
    pub fn relative_motion<T: Numeric>(
        &self,
        offset: [T; 2],
        roller: &ElementMotion<T>,
        lead: Frame<T>,
        cage_velocity: [T; 2],
        cage_speed: T,
    ) -> PocketMotion<T> {
        let r = roller.radial_offset + self.pitch_radius;
        let v = lead.to_global([roller.radial_speed, r * roller.orbit_speed]);
        let carried = [
            cage_velocity[0] - cage_speed * offset[1],
            cage_velocity[1] + cage_speed * (offset[0] + self.pitch_radius),
        ];
        PocketMotion {
            offset,
            velocity: [v[0] - carried[0], v[1] - carried[1]],
            spin: roller.spin_speed - cage_speed,
            radius_excess: roller.radius_excess,
        }
    }

    /// The contact at depth `delta` (m) in the direction `normal` from the element centre.
    #[inline(always)]
    pub fn contact<T: Numeric>(
        &self,
        m: &PocketMotion<T>,
        delta: T,
        normal: [T; 2],
        edge_share: T,
    ) -> PillarContact<T> {
        let tangent = [-normal[1], normal[0]];
        let radius = m.radius_excess + self.element_radius;
        let sliding = m.velocity[0] * tangent[0] + m.velocity[1] * tangent[1] + m.spin * radius;
        let motion = ContactMotion {
            delta,
            delta_dot: m.velocity[0] * normal[0] + m.velocity[1] * normal[1],
            u1: sliding,
            u2: delta.like(0.0),
        };
        PillarContact { motion, normal, edge_share }
    }

    /// Levers of a contact of an element, larger by `excess` (m), that is ahead of its pocket by `lead` and at `offset` (m) there.
    #[inline(always)]
    pub fn grip<T: Numeric>(&self, offset: [T; 2], excess: T, normal: [T; 2], lead: Frame<T>) -> Grip<T> {
        let radius = excess + self.element_radius;
        Grip::at_point(normal, radius, self.lever(offset, radius, normal), lead)
    }

    /// Contact point relative to the cage centre, m.
    #[inline(always)]
    fn lever<T: Numeric>(&self, offset: [T; 2], radius: T, normal: [T; 2]) -> [T; 2] {
        [offset[0] + self.pitch_radius + normal[0] * radius, offset[1] + normal[1] * radius]
    }
}

/// What distinguishes pockets: the surfaces of a pillar.
pub(in crate::pairs) trait PocketShape: Debug + Send + Sync {
    /// Place of the pockets.
    fn place(&self) -> PocketPlace;

    /// Clearance on each side of a centred element, m.
    fn clearance(&self) -> f64;

    /// True when no pillar can touch an element, larger by `excess` (m), at `offset` (m).
    fn apart<T: Numeric>(&self, offset: [T; 2], excess: T) -> T::Mask;

    /// The contact with the front pillar where `front` is true, with the back one elsewhere. They touch where the approach is
    /// above zero.
    fn pillar<T: Numeric>(&self, front: T::Mask, m: &PocketMotion<T>) -> PillarContact<T>;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offset_is_exact_for_small_leads() {
        let place = PocketPlace { pitch_radius: 0.04, element_radius: 0.0075 };
        let lead = 1e-4_f64;
        let cage = [1e-6, -2e-6];
        let (sin, cos) = lead.sin_cos();
        let d = place.offset(3e-6, Frame { sin, cos }, cage);
        let r = 0.04 + 3e-6;
        assert!((d[1] - (r * lead.sin() + 2e-6)).abs() < 1e-20);
        let radial = 3e-6 - 2.0 * r * (lead / 2.0).sin().powi(2) - 1e-6;
        assert!((d[0] - radial).abs() < 1e-20);
    }
}
