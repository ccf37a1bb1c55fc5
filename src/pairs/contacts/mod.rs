//! Touching contacts in columns: where they are, how they move, what forces they have.

mod law_columns;
mod law_slopes;

pub(super) use law_slopes::{FORCES, Slopes, VISCOSITY, chain, contact_force};

use super::{ContactLaw, ElementPair, Grip};
use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::elastic::solid::SolidContact;
use crate::laws::line_contact::LineContact;
use crate::scalar::WIDEST;
use law_columns::LawColumns;
use law_slopes::LawSlopes;
use pulp::Arch;
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
    pub(crate) grip: Grip<f64>,
}

/// A motion without contact.
const APART: ContactMotion<f64> = ContactMotion { delta: -1.0, delta_dot: 0.0, u1: 0.0, u2: 0.0 };

/// Touching contacts whose laws are evaluated together. Room is taken at creation, so filling it does not allocate.
#[derive(Clone, Debug)]
pub(crate) struct Batch {
    pub(crate) sites: Vec<Site>,
    /// As long as the batch may become, and more: what is beyond its end is apart.
    pub(crate) motion: ContactMotion<Vec<f64>>,
    edge_share: Vec<f64>,
    pub(crate) force: ContactForce<Vec<f64>>,
    laws: BatchLaws,
    /// Derivatives of the forces.
    slopes: LawSlopes,
    /// Whether they belong to the last evaluation.
    differentiated: bool,
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
        let room = n.next_multiple_of(WIDEST);
        let lines: Vec<LineContact> = laws.iter().filter_map(ContactLaw::line).copied().collect();
        let laws = match (lines.split_first(), laws.first()) {
            (None, Some(ContactLaw::Solid(law))) => BatchLaws::Solid(*law),
            (Some((first, others)), _) => BatchLaws::Lines(LawColumns::new(*first, others, room)),
            (None, _) => unreachable!("a batch has at least one law"),
        };
        Self {
            sites: Vec::with_capacity(n),
            motion: APART.map(|x| vec![*x; room]),
            edge_share: vec![0.0; room],
            force: ContactForce::none(0.0).map(|x: &f64| vec![*x; room]),
            laws,
            slopes: LawSlopes::new(room),
            differentiated: false,
        }
    }

    fn clear(&mut self) {
        self.sites.clear();
        self.differentiated = false;
    }

    /// Number of contacts that there is memory for.
    pub(crate) fn room(&self) -> usize {
        self.sites.capacity()
    }

    #[inline]
    pub(crate) fn len(&self) -> usize {
        self.sites.len()
    }

    #[inline(always)]
    fn push(&mut self, kind: usize, site: Site, edge_share: f64, motion: &ContactMotion<f64>) {
        let i = self.len();
        self.motion.set(i, motion);
        self.edge_share[i] = edge_share;
        if let BatchLaws::Lines(laws) = &mut self.laws {
            laws.set(i, kind);
        }
        self.sites.push(site);
    }

    /// Evaluates the laws, with the logarithm `ln_viscosity` of the relative viscosity.
    pub(crate) fn apply(&mut self, ln_viscosity: f64, instructions: Arch) {
        let rows = self.len();
        let Self { motion, edge_share, force, .. } = self;
        self.differentiated = false;
        match &self.laws {
            BatchLaws::Lines(laws) => {
                pad(rows, motion, edge_share);
                laws.apply(rows, motion, edge_share, ln_viscosity, force, instructions);
            }
            BatchLaws::Solid(law) => {
                for i in 0..rows {
                    force.set(i, &law.force(&motion.map(|x| x[i])));
                }
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
            self.apply(ln_viscosity, instructions);
            self.slopes.find_solid(&law, rows, &self.motion);
        }
        let Self { motion, edge_share, force, .. } = self;
        if let BatchLaws::Lines(laws) = &self.laws {
            pad(rows, motion, edge_share);
            self.slopes.find(laws, rows, (motion, edge_share), ln_viscosity, force, instructions);
        }
        self.differentiated = true;
    }

    /// Every contact with its normal force, friction and rolling resistance, N.
    #[inline]
    pub(crate) fn forces(&self) -> impl Iterator<Item = (&Site, ContactForce<f64>)> {
        let f = &self.force;
        let forces = f.normal.iter().zip(&f.friction).zip(&f.rolling_resistance);
        self.sites.iter().zip(forces).map(|(site, ((&normal, &friction), &rolling_resistance))| {
            (site, ContactForce { normal, friction, rolling_resistance, ..ContactForce::none(0.0) })
        })
    }

    /// Normal force, friction and rolling resistance of contact `i`, N, and their derivatives over what the law sees.
    #[inline(always)]
    pub(crate) fn slopes(&self, i: usize) -> ([f64; FORCES], Slopes) {
        let f = &self.force;
        ([f.normal[i], f.friction[i], f.rolling_resistance[i]], self.slopes.of(i))
    }

    /// Every contact with its normal damping and its secant slope of friction, N s/m.
    #[inline]
    pub(crate) fn damping(&self) -> impl Iterator<Item = (&Site, [f64; 2])> {
        let rates = self.force.damping.iter().zip(&self.force.friction_secant);
        self.sites.iter().zip(rates).map(|(site, (damping, secant))| (site, [*damping, *secant]))
    }

    /// Every contact with all that is known of it.
    #[inline]
    pub(crate) fn iter(&self) -> impl Iterator<Item = Loaded<'_>> {
        self.sites.iter().enumerate().map(|(i, site)| Loaded {
            site,
            motion: self.motion.map(|x| x[i]),
            force: self.force.map(|x| x[i]),
        })
    }
}

/// Makes the places from the last contact up to the next whole group apart.
fn pad(rows: usize, motion: &mut ContactMotion<Vec<f64>>, edge_share: &mut [f64]) {
    let rest = rows..rows.next_multiple_of(WIDEST);
    edge_share[rest.clone()].fill(0.0);
    rest.for_each(|i| motion.set(i, &APART));
}

/// One contact of a batch.
pub(crate) struct Loaded<'a> {
    pub(crate) site: &'a Site,
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
    gaps: [Vec<f64>; GAPS],
    /// Evaluations of the last state by law of the pairs.
    pub(crate) counts: Vec<[u64; LAWS_OF_PAIR]>,
}

/// Columns of numbers that a pair may find of all elements.
pub(crate) const GAPS: usize = 4;
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
        let room = elements.next_multiple_of(WIDEST);
        Self {
            batches: groups.iter().map(|(n, laws)| Batch::new(*n, laws)).collect(),
            place,
            ranges: vec![0..0; pairs.len()],
            gaps: std::array::from_fn(|_| vec![0.0; room]),
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
    pub(crate) fn of(&mut self, pair: usize, mate: usize) -> Search<'_> {
        let [batch, kind] = self.place[pair];
        let batch = &mut self.batches[batch];
        let first = batch.len();
        let touching = Touching { batch, counts: &mut self.counts[pair], pair, mate, kind };
        Search { touching, gaps: &mut self.gaps, range: &mut self.ranges[pair], first }
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
    pub(crate) gaps: &'a mut [Vec<f64>; GAPS],
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
        grip: Grip<f64>,
        edge_share: f64,
        motion: &ContactMotion<f64>,
    ) {
        let site = Site { element, pair: self.pair, contact, mate: self.mate, grip };
        self.batch.push(self.kind, site, edge_share, motion);
        self.counts[usize::from(edge_share >= 1.0)] += 1;
    }
}
