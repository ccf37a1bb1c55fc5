//! Rolling element in its cage pocket: where it is and how it moves there, whatever the shape of the pocket.
//!
//! Each pocket has two pillars, which are evaluated separately, so an element can rest on both. The contact point is
//! fixed in the pocket: u1 is the sliding speed of the element's surface, u2 = 0.
//!
//! Local frame: (radial, circumferential) at the pocket centre, turning with the cage.

use super::contacts::{Batch, Search};
use super::pocket_slopes::add_pocket;
use super::{Ahead, ContactLaw, Cost, ElementPair, ElementPlace, Grip, MateLever, PairInfo, SlopeSums};
use crate::bodies::{CAGE, ElementMotion, Fault, Motions};
use crate::laws::contact_pair::ContactMotion;
use crate::scalar::elementary::sin_cos;
use crate::scalar::{Columns, Numeric, Pack, Real, dispatch, math};
use crate::space::{Frame, rotate};
use pulp::Simd;
use std::fmt::Debug;
use std::ops::Range;

/// An element this far round from its pocket, in radii of its own, is out of it.
const OUT_OF_POCKET: f64 = 1.0;

/// Place of the pockets in the cage and size of the elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PocketPlace {
    /// Radius of the circle of pocket centres, m.
    pub pitch_radius: f64,
    /// R_b, m.
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

impl Pillar {
    /// +1 for the front, -1 for the back: the side of the circumferential direction.
    #[inline]
    pub fn sign(self) -> f64 {
        match self {
            Pillar::Front => 1.0,
            Pillar::Back => -1.0,
        }
    }
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
    #[inline]
    pub fn relative_motion<T: Real>(
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
        }
    }

    /// The contact at depth `delta` (m) in the direction `normal` from the element centre.
    #[inline]
    pub fn contact<T: Real>(
        &self,
        m: &PocketMotion<T>,
        delta: T,
        normal: [T; 2],
        edge_share: T,
    ) -> PillarContact<T> {
        let tangent = [-normal[1], normal[0]];
        let sliding = m.velocity[0] * tangent[0] + m.velocity[1] * tangent[1] + m.spin * self.element_radius;
        let motion = ContactMotion {
            delta,
            delta_dot: m.velocity[0] * normal[0] + m.velocity[1] * normal[1],
            u1: sliding,
            u2: T::constant(0.0),
        };
        PillarContact { motion, normal, edge_share }
    }

    /// Levers of a contact of an element that is ahead of its pocket by `lead` and at `offset` (m) there.
    #[inline]
    pub fn grip<T: Real>(&self, offset: [T; 2], normal: [T; 2], lead: Frame<T>) -> Grip<T> {
        let mate = MateLever::Point(self.lever(offset, normal), lead);
        Grip { normal, arm: T::constant(self.element_radius), mate }
    }

    /// Contact point relative to the cage centre, m.
    #[inline]
    pub fn lever<T: Real>(&self, offset: [T; 2], normal: [T; 2]) -> [T; 2] {
        [
            offset[0] + self.pitch_radius + normal[0] * self.element_radius,
            offset[1] + normal[1] * self.element_radius,
        ]
    }
}

/// What distinguishes pockets: the surfaces of a pillar.
pub(super) trait PocketShape: Debug + Send + Sync {
    /// Place of the pockets.
    fn place(&self) -> PocketPlace;

    /// Clearance on each side of a centred element, m.
    fn clearance(&self) -> f64;

    /// True when no pillar can touch an element at `offset` (m).
    fn apart(&self, offset: [f64; 2]) -> bool;

    /// The contact with one pillar; `None` when they are apart.
    fn pillar<T: Real>(&self, side: Pillar, m: &PocketMotion<T>) -> Option<PillarContact<T>>;
}

/// The contacts of all elements with their pockets.
#[derive(Debug)]
pub(super) struct Pockets<S> {
    pub(super) shape: S,
    pub(super) law: ContactLaw,
    pub(super) info: &'static PairInfo,
    pub(super) cost: Cost,
    /// The longest step that passes no wall unseen.
    pub(super) longest_step: fn(&S, &ContactLaw, &Ahead<'_>) -> f64,
}

impl<S: PocketShape> ElementPair for Pockets<S> {
    fn info(&self) -> &'static PairInfo {
        self.info
    }

    fn law(&self) -> ContactLaw {
        self.law
    }

    fn find(&self, motions: &Motions, out: &mut Search<'_>) -> Result<(), Fault> {
        let (place, cage) = (self.shape.place(), &motions.shared[CAGE]);
        let largest_lead = OUT_OF_POCKET * place.element_radius / place.pitch_radius;
        let places = &motions.places;
        let together = match places.together {
            None => {
                for (element, travel) in places.travel[..motions.elements.len()].iter().enumerate() {
                    let lead = travel - cage.angle;
                    if lead.abs() > largest_lead {
                        return Err(Fault::OutOfPocket { element, lead });
                    }
                }
                None
            }
            Some(travel) => {
                let lead = travel - cage.angle;
                if lead.abs() > largest_lead {
                    return Err(Fault::OutOfPocket { element: 0, lead });
                }
                let (sin, cos) = math::sin_cos(lead);
                Some(Frame { sin, cos })
            }
        };
        let Search { touching, gaps, .. } = out;
        dispatch(motions.instructions, Offsets { motions, place, together, gaps });
        let [along, across, sin, cos] = &**gaps;
        let offsets = along.iter().zip(across).zip(&motions.elements);
        for (j, ((along, across), motion)) in offsets.enumerate() {
            let offset = [*along, *across];
            if self.shape.apart(offset) {
                continue;
            }
            let lead = together.unwrap_or(Frame { sin: sin[j], cos: cos[j] });
            let velocity = lead.to_global(motions.frame(j).to_local(cage.velocity));
            let relative = place.relative_motion(offset, motion, lead, velocity, cage.speed);
            for side in [Pillar::Front, Pillar::Back] {
                if let Some(PillarContact { motion, normal, edge_share }) = self.shape.pillar(side, &relative)
                {
                    let grip = place.grip(offset, normal, lead);
                    touching.push(j, side as usize, grip, edge_share, &motion);
                }
            }
        }
        Ok(())
    }

    fn add_slopes(&self, batch: &Batch, contacts: Range<usize>, motions: &Motions, sums: &mut SlopeSums<'_>) {
        for i in contacts {
            add_pocket(&self.shape, &self.law, batch, i, motions, sums);
        }
    }

    fn longest_step(&self, ahead: &Ahead<'_>) -> f64 {
        (self.longest_step)(&self.shape, &self.law, ahead)
    }

    fn clearance(&self) -> Option<f64> {
        Some(self.shape.clearance())
    }

    fn offset(&self, at: &ElementPlace) -> Option<f64> {
        let (sin, cos) = math::sin_cos(at.travel - at.mate.angle);
        let lead = Frame { sin, cos };
        let cage = lead.to_global(at.frame.to_local(at.mate.position));
        Some(self.shape.place().offset(at.radial_offset, lead, cage)[1])
    }

    fn cost(&self) -> Cost {
        self.cost
    }
}

/// Finds how far all elements are ahead of their pockets, and where in them they are.
struct Offsets<'a> {
    motions: &'a Motions,
    place: PocketPlace,
    /// Lead of all elements, where it is the same.
    together: Option<Frame<f64>>,
    /// Offset, then sine and cosine of the lead where it is not the same.
    gaps: &'a mut [Vec<f64>; 4],
}

impl Columns for Offsets<'_> {
    fn rows(&self) -> usize {
        self.motions.elements.len()
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (places, cage) = (&self.motions.places, &self.motions.shared[CAGE]);
        let all = |x: f64| Pack::<S, K>::all(simd, x);
        let load = |column: &[f64]| Pack::load(simd, &column[first..]);
        let (sin, cos) = match self.together {
            Some(lead) => (all(lead.sin), all(lead.cos)),
            None => sin_cos(load(&places.travel) - all(cage.angle)),
        };
        let azimuth = [load(&places.direction[0]), load(&places.direction[1])];
        let cage = rotate([all(cage.position[0]), all(cage.position[1])], -azimuth[0], azimuth[1]);
        let lead = Frame { sin, cos };
        let offset = self.place.offset(load(&places.radial_offset), lead, rotate(cage, sin, cos));
        let [along, across, sines, cosines] = &mut *self.gaps;
        offset[0].store(&mut along[first..]);
        offset[1].store(&mut across[first..]);
        if self.together.is_none() {
            sin.store(&mut sines[first..]);
            cos.store(&mut cosines[first..]);
        }
    }
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
