//! Pockets of the cage: contacts of all elements with the pillars before and behind them.

pub(super) mod cylinder;
pub(super) mod kinematics;
pub(super) mod plane;

pub(super) use cylinder::new as cylinder;
pub(super) use plane::new as plane;

use crate::bodies::{CAGE, Fault, Motions};
use crate::pairs::contacts::{Beside, Kinematics, Varied, VariedContact, add_slopes};
use crate::pairs::{
    Ahead, Batch, ContactLaw, Cost, ElementPair, ElementPlace, Found, PairInfo, RelativeSlopes, Search,
    SlopeSums,
};
use crate::scalar::elementary::sin_cos;
use crate::scalar::{Base, Columns, Numeric, Pack, WIDEST, dispatch, math, place_of};
use crate::space::Frame;
use kinematics::{Pillar, PillarContact, PocketMotion, PocketPlace, PocketShape};
use pulp::Simd;
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
        let together = match motions.together {
            None => {
                let out = |travel: &f64| (travel - cage.angle).abs() > largest_lead;
                for (first, block) in (0..motions.count).step_by(WIDEST).zip(&motions.blocks) {
                    let travels = &block.travel[..WIDEST.min(motions.count - first)];
                    if travels.iter().fold(false, |any, travel| any | out(travel)) {
                        let at = travels.iter().position(out).unwrap_or_default();
                        let lead = travels[at] - cage.angle;
                        return Err(Fault::OutOfPocket { element: first + at, lead });
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
        let Search { touching, found, .. } = out;
        found.iter_mut().for_each(|block| block.any_near = false);
        let shape = &self.shape;
        dispatch(motions.instructions, Offsets { motions, shape, place, together, found });
        for (first, block) in (0..motions.count).step_by(WIDEST).zip(&**found) {
            if !block.any_near {
                continue;
            }
            for lane in 0..WIDEST.min(motions.count - first) {
                if block.near[lane] == 0.0 {
                    continue;
                }
                let Found { lead, offset: [along, across], .. } = block;
                let (lead, offset) = (lead.of(lane), [along[lane], across[lane]]);
                let element = motions.element(first + lane);
                let velocity = lead.to_global(element.frame.to_local(cage.velocity));
                let mut relative = place.relative_motion(offset, &element.motion, lead, velocity, cage.speed);
                if !motions.displaced.is_empty() {
                    relative.displace(motions.displacement(first + lane));
                }
                for side in [Pillar::Front, Pillar::Back] {
                    let contact = shape.pillar(side == Pillar::Front, &relative);
                    let PillarContact { motion, normal, edge_share } = contact;
                    if motion.delta <= 0.0 {
                        continue;
                    }
                    let grip = place.grip(offset, relative.radius_excess, normal, lead);
                    touching.push(first + lane, side as usize, &grip, edge_share, &motion);
                }
            }
        }
        Ok(())
    }

    fn add_slopes(
        &self,
        batch: &Batch,
        contacts: Range<usize>,
        motions: &Motions,
        sums: &mut SlopeSums<'_>,
        memory: &mut RelativeSlopes,
    ) {
        add_slopes(self, batch, contacts, motions, sums, memory);
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
        Some(self.shape.place().offset(at.radial_offset, lead, cage)[1] - at.displacement[1])
    }

    fn cost(&self) -> Cost {
        self.cost
    }
}

impl<P: PocketShape> Kinematics for Pockets<P> {
    #[inline(always)]
    fn contact<B: Base>(&self, at: &Beside<B>) -> VariedContact<B> {
        let (place, mate) = (self.shape.place(), &at.mate);
        let (sin, cos) = sin_cos(at.travel - mate.angle);
        let lead = Frame { sin, cos };
        let offset = place.offset(at.element.radial_offset, lead, lead.to_global(mate.position));
        let velocity = lead.to_global(mate.velocity);
        let m = place.relative_motion(offset, &at.element, lead, velocity, mate.speed);
        let (zero, one) = (sin.splat(0.0), sin.splat(1.0));
        let varied = |re: B, eps: [B; 5]| Varied { re, eps };
        let m = PocketMotion {
            offset: [
                varied(m.offset[0], [cos, -sin, zero, zero, zero]),
                varied(m.offset[1], [sin, cos, zero, zero, zero]),
            ],
            velocity: [
                varied(m.velocity[0], [zero, zero, cos, -sin, zero]),
                varied(m.velocity[1], [zero, zero, sin, cos, zero]),
            ],
            spin: varied(m.spin, [zero, zero, zero, zero, one]),
            radius_excess: Varied::lift(m.radius_excess),
        };
        // Levers are those of the contact point from the centre of the cage, wherever the pocket is.
        let offset = m.offset;
        let mut m = m;
        if let Some(displacement) = at.displacement {
            m.displace(displacement.map(|part| part.map(Varied::lift)));
        }
        let front = at.contact.below(0.5);
        let PillarContact { motion, normal, edge_share } = self.shape.pillar(front, &m);
        let lead = Frame { sin: Varied::lift(sin), cos: Varied::lift(cos) };
        VariedContact {
            motion,
            edge_share: Some(edge_share),
            over_spin_angle: None,
            grip: place.grip(offset, m.radius_excess, normal, lead),
        }
    }
}

/// Finds how far all elements are ahead of their pockets, and where in them they are.
struct Offsets<'a, P> {
    motions: &'a Motions,
    shape: &'a P,
    place: PocketPlace,
    /// Lead of all elements, where it is the same.
    together: Option<Frame<f64>>,
    found: &'a mut [Found],
}

impl<P: PocketShape> Columns for Offsets<'_, P> {
    fn rows(&self) -> usize {
        self.motions.count
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (block, at) = place_of(first);
        let (of_elements, cage) = (&self.motions.blocks[block], &self.motions.shared[CAGE]);
        let all = |x: f64| Pack::<S, K>::all(simd, x);
        let (sin, cos) = match self.together {
            Some(lead) => (all(lead.sin), all(lead.cos)),
            None => sin_cos(Pack::load(simd, &of_elements.travel[at..]) - all(cage.angle)),
        };
        let (frame, turned) = (of_elements.frame.load(simd, at), Frame { sin, cos });
        let centre = turned.to_global(frame.to_local([all(cage.position[0]), all(cage.position[1])]));
        let [radial_offset, excess] = [&of_elements.motion.radial_offset, &of_elements.motion.radius_excess]
            .map(|column| Pack::load(simd, &column[at..]));
        let [along, across] = self.place.offset(radial_offset, turned, centre);
        let Found { lead, offset, near, any_near, .. } = &mut self.found[block];
        lead.store(at, turned);
        let apart = match self.motions.displaced.get(block) {
            None => self.shape.apart([along, across], excess),
            Some([[outwards, ahead], _]) => {
                let moved = [outwards, ahead].map(|x| Pack::load(simd, &x[at..]));
                self.shape.apart([along - moved[0], across - moved[1]], excess)
            }
        };
        let touching = Pack::select(apart, all(0.0), all(1.0));
        touching.store(&mut near[at..]);
        *any_near |= Pack::any(touching.above(0.0));
        along.store(&mut offset[0][at..]);
        across.store(&mut offset[1][at..]);
    }
}
