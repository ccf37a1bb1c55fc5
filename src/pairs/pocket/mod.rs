//! Pockets of the cage: contacts of all elements with the pillars before and behind them.

mod cylinder;
mod kinematics;
mod plane;
mod slopes;

pub(super) use cylinder::new as cylinder;
pub(super) use plane::new as plane;

use crate::bodies::{CAGE, Fault, Motions};
use crate::pairs::contacts::GAPS;
use crate::pairs::{Ahead, Batch, ContactLaw, Cost, ElementPair, ElementPlace, PairInfo, Search, SlopeSums};
use crate::scalar::elementary::sin_cos;
use crate::scalar::{Columns, Pack, dispatch, math};
use crate::space::{Frame, rotate};
use kinematics::{Pillar, PillarContact, PocketPlace, PocketShape};
use pulp::Simd;
use slopes::add_pocket;
use std::ops::Range;

/// An element this far round from its pocket, in radii of its own, is out of it.
const OUT_OF_POCKET: f64 = 1.0;

/// The contacts of all elements with their pockets.
#[derive(Debug)]
pub(super) struct Pockets<S> {
    pub(super) shape: S,
    pub(super) law: ContactLaw,
    pub(super) info: &'static PairInfo,
    pub(super) cost: Cost,
    /// The longest step that passes no wall unseen, where the law sets in abruptly.
    pub(super) longest_step: Option<fn(&S, &ContactLaw, &Ahead<'_>) -> f64>,
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
            add_pocket(&self.shape, batch, i, motions, sums);
        }
    }

    fn has_onset(&self) -> bool {
        self.longest_step.is_some()
    }

    fn longest_step(&self, ahead: &Ahead<'_>) -> f64 {
        self.longest_step.map_or(f64::INFINITY, |longest| longest(&self.shape, &self.law, ahead))
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
    gaps: &'a mut [Vec<f64>; GAPS],
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
