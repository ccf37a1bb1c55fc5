//! Touching contacts in columns: where they are, how they move, what forces they have.
//!
//! Whatever follows from levers and forces does so here, for all contacts at once and whatever the pair: wrenches (`wrenches`),
//! damping (`damping`), forces, powers and reaction of a step (`step`).

mod damping;
mod law_columns;
mod law_slopes;
mod relative;
mod step;
mod wrenches;

pub(super) use law_columns::LawColumns;
use law_slopes::contact_force;
pub(super) use law_slopes::{DIRECTIONS, EDGE_SHARE, FORCES, LawSlopes, VISCOSITY};
pub(crate) use relative::RelativeSlopes;
pub(super) use relative::{Beside, Kinematics, OverSpinAngle, Varied, VariedContact, add_slopes};
pub(crate) use step::SpeedChanges;
use step::StepForces;

use super::{ContactLaw, ElementPair, Grip, PairInfo};
use crate::bodies::{Motions, OF_ELEMENT, WrenchLanes};
use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::elastic::solid::SolidContact;
use crate::laws::line_contact::LineContact;
use crate::scalar::{Columns, Lanes, WIDEST, ZEROS, blocks_for, dispatch, place_of};
use crate::space::Frame;
use damping::Triangles;
use pulp::{Arch, Simd};
use std::ops::Range;

/// Where a contact is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site {
    /// Its element.
    pub(crate) element: usize,
    /// Its pair, a place in the list of the model.
    pub(crate) pair: usize,
    /// Which of the contacts of this pair it is, such as that with the front or the back of a pocket.
    pub(crate) contact: usize,
    /// Its mate, a shared body.
    pub(crate) mate: usize,
}

/// A motion without contact.
const APART: ContactMotion<f64> = ContactMotion { delta: -1.0, delta_dot: 0.0, u1: 0.0, u2: 0.0 };

/// A block of contacts. What is beyond the last one moves apart, and nobody asks for its forces.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(crate) struct ContactBlock {
    pub(crate) grip: Grip<Lanes>,
    /// Of the elements.
    frame: Frame<Lanes>,
    pub(crate) motion: ContactMotion<Lanes>,
    pub(in crate::pairs) edge_share: Lanes,
    pub(crate) force: ContactForce<Lanes>,
    /// Wrenches on elements in their local frames, and on mates in global axes.
    pub(crate) on_elements: WrenchLanes,
    pub(crate) on_mates: WrenchLanes,
    damping: Triangles,
    pub(crate) step: StepForces,
}

impl ContactBlock {
    pub(in crate::pairs) const APART: Self = Self {
        grip: Grip::<Lanes>::ZERO,
        frame: Frame::GLOBAL_LANES,
        motion: NO_MOTION,
        edge_share: ZEROS,
        force: ContactForce::none(ZEROS),
        on_elements: [ZEROS; OF_ELEMENT],
        on_mates: [ZEROS; OF_ELEMENT],
        damping: Triangles::ZERO,
        step: StepForces::ZERO,
    };
}

pub(in crate::pairs) const NO_MOTION: ContactMotion<Lanes> =
    ContactMotion { delta: [APART.delta; WIDEST], delta_dot: ZEROS, u1: ZEROS, u2: ZEROS };

/// Touching contacts whose laws are evaluated together. Room is taken at creation, so filling it does not allocate.
#[derive(Clone, Debug)]
pub(crate) struct Batch {
    pub(crate) sites: Vec<Site>,
    /// As many as the batch may become long.
    pub(crate) blocks: Vec<ContactBlock>,
    laws: BatchLaws,
    /// Derivatives of the forces.
    slopes: LawSlopes,
    /// Whether they belong to the last evaluation.
    differentiated: bool,
    /// Whether blocks have changes of speeds of a step.
    changed: bool,
    /// Whether slices of its contacts may lose their force one by one.
    sliced: bool,
}

/// Laws of a batch.
#[expect(clippy::large_enum_variant, reason = "a few per simulation")]
#[derive(Clone, Debug)]
enum BatchLaws {
    Lines(LawColumns),
    Solid(SolidContact),
}

impl Batch {
    fn new(n: usize, laws: &[ContactLaw]) -> Self {
        let room = blocks_for(n) * WIDEST;
        let sliced = laws.iter().any(ContactLaw::sliced);
        let lines: Vec<LineContact> = laws.iter().filter_map(ContactLaw::line).copied().collect();
        let laws = match (lines.split_first(), laws.first()) {
            (None, Some(ContactLaw::Solid(law))) => BatchLaws::Solid(*law),
            (Some((first, others)), _) => BatchLaws::Lines(LawColumns::new(*first, others, room)),
            (None, _) => unreachable!("a batch has at least one law"),
        };
        Self {
            sites: Vec::with_capacity(n),
            blocks: vec![ContactBlock::APART; blocks_for(n)],
            laws,
            slopes: LawSlopes::new(room),
            differentiated: false,
            changed: false,
            sliced,
        }
    }

    /// Forgets all contacts: every place of their blocks is apart again.
    fn clear(&mut self) {
        for block in &mut self.blocks[..blocks_for(self.sites.len())] {
            (block.motion, block.edge_share) = (NO_MOTION, ZEROS);
        }
        self.sites.clear();
        self.differentiated = false;
    }

    #[inline]
    pub(crate) fn len(&self) -> usize {
        self.sites.len()
    }

    #[inline(always)]
    fn push(
        &mut self,
        kind: usize,
        site: Site,
        frame: Frame<f64>,
        grip: &Grip<f64>,
        edge_share: f64,
        motion: &ContactMotion<f64>,
    ) {
        let i = self.len();
        let (block, lane) = place_of(i);
        let block = &mut self.blocks[block];
        block.motion.set(lane, motion);
        block.grip.set(lane, grip);
        block.frame.set(lane, frame);
        block.edge_share[lane] = edge_share;
        if let BatchLaws::Lines(laws) = &mut self.laws {
            laws.set(i, kind);
        }
        self.sites.push(site);
    }

    /// Evaluates the laws, with the logarithm `ln_viscosity` of the relative viscosity.
    pub(crate) fn apply(&mut self, ln_viscosity: f64, instructions: Arch) {
        let rows = self.len();
        self.differentiated = false;
        match &self.laws {
            BatchLaws::Lines(laws) => laws.apply(rows, &mut self.blocks, ln_viscosity, instructions),
            BatchLaws::Solid(law) => {
                let contacts = &mut self.blocks;
                dispatch(instructions, ApplySolid { law, rows, contacts });
            }
        }
    }

    /// Evaluates the laws with their derivatives, unless the last evaluation has done so.
    pub(crate) fn differentiate(&mut self, ln_viscosity: f64, instructions: Arch) {
        if self.differentiated {
            return;
        }
        let rows = self.len();
        if let BatchLaws::Solid(law) = self.laws {
            self.slopes.find_solid(law, rows, &mut self.blocks, instructions);
        }
        if let BatchLaws::Lines(laws) = &self.laws {
            self.slopes.find(laws, rows, &mut self.blocks, ln_viscosity, instructions);
        }
        self.differentiated = true;
    }

    /// Normal force, friction and rolling resistance of contact `i`, N, and their derivatives over what its law sees, after
    /// [`Batch::differentiate`].
    pub(super) fn forces_and_slopes(&self, i: usize) -> ([f64; FORCES], [[f64; DIRECTIONS]; FORCES]) {
        let force = self.loaded(i).force;
        ([force.normal, force.friction, force.rolling_resistance], self.slopes.of(i))
    }

    /// The contacts of each block, with their places in it.
    #[inline]
    pub(crate) fn by_block(&self) -> impl Iterator<Item = (&[Site], &ContactBlock)> {
        self.sites.chunks(WIDEST).zip(&self.blocks)
    }

    /// These contacts block by block, with their places there.
    #[inline]
    pub(crate) fn pieces(
        &self,
        contacts: Range<usize>,
    ) -> impl Iterator<Item = (&ContactBlock, Range<usize>)> {
        let Range { start, end } = contacts;
        (start / WIDEST..blocks_for(end)).map(move |block| {
            let first = block * WIDEST;
            (&self.blocks[block], start.max(first) - first..end.min(first + WIDEST) - first)
        })
    }

    /// Block of contact `i`, and its place there.
    #[inline(always)]
    pub(crate) fn at(&self, i: usize) -> (&ContactBlock, usize) {
        let (block, lane) = place_of(i);
        (&self.blocks[block], lane)
    }

    /// Levers of contact `i`.
    #[inline(always)]
    pub(crate) fn grip(&self, i: usize) -> Grip<f64> {
        let (block, lane) = self.at(i);
        block.grip.of(lane)
    }

    /// Contact `i` with all that is known of it.
    #[inline]
    pub(crate) fn loaded(&self, i: usize) -> Loaded<'_> {
        let (block, lane) = self.at(i);
        Loaded {
            site: &self.sites[i],
            grip: block.grip.of(lane),
            motion: block.motion.of(lane),
            force: block.force.of(lane),
        }
    }

    /// Every contact with all that is known of it.
    #[inline]
    pub(crate) fn iter(&self) -> impl Iterator<Item = Loaded<'_>> {
        (0..self.len()).map(|i| self.loaded(i))
    }
}

/// Evaluates the law of solid contacts.
struct ApplySolid<'a> {
    law: &'a SolidContact,
    rows: usize,
    contacts: &'a mut [ContactBlock],
}

impl Columns for ApplySolid<'_> {
    fn rows(&self) -> usize {
        self.rows
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (block, lane) = place_of(first);
        let ContactBlock { motion, force, .. } = &mut self.contacts[block];
        force.store(lane, &self.law.force(&motion.load::<S, K>(simd, lane)));
    }
}

/// One contact of a batch.
pub(crate) struct Loaded<'a> {
    pub(crate) site: &'a Site,
    pub(crate) grip: Grip<f64>,
    pub(crate) motion: ContactMotion<f64>,
    pub(crate) force: ContactForce<f64>,
}

/// All touching contacts of elements, in batches. Those of a pair stand together.
#[derive(Clone, Debug)]
pub(crate) struct Contacts {
    pub(crate) batches: Vec<Batch>,
    /// Batch of each pair, and the kind that its law is there.
    place: Vec<[usize; 2]>,
    /// Contacts of each pair in its batch.
    ranges: Vec<Range<usize>>,
    /// Memory of pairs for what they find of all elements.
    found: Vec<Found>,
    /// Evaluations of the last state by law of the pairs.
    pub(crate) counts: Vec<[u64; LAWS_OF_PAIR]>,
}

/// What a pair finds of a block of elements, whether they touch or not.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(crate) struct Found {
    pub(crate) motion: ContactMotion<Lanes>,
    pub(crate) grip: Grip<Lanes>,
    /// How far an element is ahead of the place that the mate has for it, and where it is there, m.
    pub(crate) lead: Frame<Lanes>,
    pub(crate) offset: [Lanes; 2],
    /// 1 where it may touch there, 0 where it does not; and whether any of the block may.
    pub(crate) near: Lanes,
    pub(crate) any_near: bool,
}

impl Found {
    const NOTHING: Self = Self {
        motion: NO_MOTION,
        grip: Grip::<Lanes>::ZERO,
        lead: Frame::GLOBAL_LANES,
        offset: [ZEROS; 2],
        near: ZEROS,
        any_near: false,
    };
}

/// Laws that a pair may count its contacts by.
pub(crate) const LAWS_OF_PAIR: usize = 2;

impl Contacts {
    /// Memory for the contacts of these pairs with so many elements. Pairs share a batch if their laws have the same parts.
    pub(crate) fn new(pairs: &[Box<dyn ElementPair>], elements: usize) -> Self {
        let mut groups: Vec<(usize, Vec<ContactLaw>)> = Vec::new();
        let mut place = Vec::new();
        for pair in pairs {
            let (n, law) = (elements * pair.info().contacts.len(), pair.law());
            let joined = groups.iter().position(|(_, laws)| join(laws, &law).is_some());
            match joined {
                Some(batch) => {
                    let (room, laws) = &mut groups[batch];
                    if let Some(all) = join(laws, &law) {
                        place.push([batch, laws.len()]);
                        (*room, *laws) = (*room + n, all);
                    }
                }
                None => {
                    place.push([groups.len(), 0]);
                    groups.push((n, vec![law]));
                }
            }
        }
        Self {
            batches: groups.iter().map(|(n, laws)| Batch::new(*n, laws)).collect(),
            place,
            ranges: vec![0..0; pairs.len()],
            found: vec![Found::NOTHING; blocks_for(elements)],
            counts: vec![[0; LAWS_OF_PAIR]; pairs.len()],
        }
    }

    pub(crate) fn clear(&mut self) {
        self.batches.iter_mut().for_each(Batch::clear);
        self.ranges.fill(0..0);
        self.counts.fill([0; LAWS_OF_PAIR]);
    }

    /// Where a pair puts its touching contacts.
    #[inline]
    pub(crate) fn of<'a>(&'a mut self, pair: usize, mate: usize, motions: &'a Motions) -> Search<'a> {
        let [batch, kind] = self.place[pair];
        let batch = &mut self.batches[batch];
        let first = batch.len();
        let touching = Touching { motions, batch, counts: &mut self.counts[pair], pair, mate, kind };
        Search { touching, found: &mut self.found, range: &mut self.ranges[pair], first }
    }

    /// The batches, with the mate and the contacts of every pair in them.
    pub(crate) fn by_pair<'a>(
        &'a self,
        infos: &'a [&'static PairInfo],
    ) -> impl Iterator<Item = (&'a Batch, &'static PairInfo, Range<usize>)> {
        let pairs = infos.iter().zip(&self.place).zip(&self.ranges);
        pairs.map(|((info, [batch, _]), contacts)| (&self.batches[*batch], *info, contacts.clone()))
    }

    /// The batch of a pair and its contacts there.
    #[inline]
    pub(crate) fn range(&self, pair: usize) -> (&Batch, Range<usize>) {
        let (place, contacts) = self.place(pair);
        (&self.batches[place], contacts)
    }

    /// Place of the batch of a pair among all, and its contacts there.
    #[inline]
    pub(crate) fn place(&self, pair: usize) -> (usize, Range<usize>) {
        (self.place[pair][0], self.ranges[pair].clone())
    }

    /// The touching contacts, with their wrenches on the elements in the frames of these, N and N m.
    #[inline]
    pub(crate) fn on_elements(&self) -> impl Iterator<Item = (&Site, [f64; OF_ELEMENT])> {
        self.batches.iter().flat_map(|batch| {
            batch.sites.iter().enumerate().map(|(i, site)| {
                let (block, lane) = batch.at(i);
                (site, block.on_elements.each_ref().map(|column| column[lane]))
            })
        })
    }

    /// All touching contacts.
    #[inline]
    pub(crate) fn iter(&self) -> impl Iterator<Item = Loaded<'_>> {
        self.batches.iter().flat_map(Batch::iter)
    }
}

/// All laws of a batch and one more, with the same parts; `None` where they differ in more than in constants.
fn join(laws: &[ContactLaw], law: &ContactLaw) -> Option<Vec<ContactLaw>> {
    let mut last = *law.line()?;
    let mut all = Vec::new();
    for other in laws {
        let [other, own] = other.line()?.alike(&last)?;
        all.push(ContactLaw::Line(other));
        last = own;
    }
    all.push(ContactLaw::Line(last));
    Some(all)
}

/// A pair's search for its touching contacts.
pub(crate) struct Search<'a> {
    pub(crate) touching: Touching<'a>,
    /// Memory for what it finds of all elements.
    pub(crate) found: &'a mut [Found],
    range: &'a mut Range<usize>,
    first: usize,
}

impl Drop for Search<'_> {
    fn drop(&mut self) {
        *self.range = self.first..self.touching.batch.len();
    }
}

/// Touching contacts of one pair in the making.
pub(crate) struct Touching<'a> {
    motions: &'a Motions,
    batch: &'a mut Batch,
    counts: &'a mut [u64; LAWS_OF_PAIR],
    pair: usize,
    mate: usize,
    kind: usize,
}

impl Touching<'_> {
    /// Adds a contact of an element. Its edge share says which of the laws of the pair counts it: an edge is the second.
    #[inline(always)]
    pub(crate) fn push(
        &mut self,
        element: usize,
        contact: usize,
        grip: &Grip<f64>,
        edge_share: f64,
        motion: &ContactMotion<f64>,
    ) {
        let site = Site { element, pair: self.pair, contact, mate: self.mate };
        self.batch.push(self.kind, site, self.motions.frame(element), grip, edge_share, motion);
        self.counts[usize::from(edge_share >= 1.0)] += 1;
    }
}
