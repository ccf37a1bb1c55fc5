//! Touching contacts in columns.
//!
//! Contacts of several kinds share a batch if the laws of these kinds have the same parts. They differ in constants only,
//! which are columns too, so that vector instructions serve all of them at once.

use super::law_columns::{KINDS, LawColumns};
use super::law_slopes::{FORCES, LawSlopes, Slopes};
use super::laws::{INNER_RACEWAY, OUTER_RACEWAY, POCKET_EDGE, POCKET_PLANE, POCKET_WALL};
use crate::contact::PairFrame;
use crate::contact::pocket::Pillar;
use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::line_contact::LineContact;
use crate::scalar::WIDEST;
use pulp::Arch;

/// What an element touches.
#[derive(Clone, Copy, Debug)]
pub(super) enum Mate {
    Outer,
    Inner,
    Pocket(PocketSite),
}

/// What a pocket contact needs besides its motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct PocketSite {
    pub(super) pillar: Pillar,
    pub(super) edge_share: f64,
    /// Contact point relative to the cage centre, pocket frame, m.
    pub(super) lever: [f64; 2],
}

/// Where a contact is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Site {
    pub(super) element: usize,
    pub(super) frame: PairFrame<f64>,
    pub(super) mate: Mate,
}

/// Touching contacts, their numbers in columns. Room is taken at creation, so filling it does not allocate.
#[derive(Clone, Debug)]
pub(super) struct Batch {
    pub(super) sites: Vec<Site>,
    /// As long as the batch may become, and more: what is beyond its end is apart.
    pub(super) motion: ContactMotion<Vec<f64>>,
    edge_share: Vec<f64>,
    pub(super) force: ContactForce<Vec<f64>>,
    /// Laws of line contacts; solid pockets have one of their own.
    laws: Option<LawColumns>,
    /// Derivatives of the forces, where they are found by the batch.
    slopes: LawSlopes,
    /// Whether they belong to the last evaluation.
    differentiated: bool,
    /// Number of contacts by law: the first of [`super::LAWS`].
    pub(super) counts: [u64; CONTACT_LAWS],
}

/// Number of laws of contacts, the first of [`super::LAWS`].
pub(super) const CONTACT_LAWS: usize = POCKET_PLANE + 1;

/// A motion without contact.
const APART: ContactMotion<f64> = ContactMotion { delta: -1.0, delta_dot: 0.0, u1: 0.0, u2: 0.0 };

impl Batch {
    /// Room for `n` contacts.
    pub(super) fn new(n: usize) -> Self {
        let room = n.next_multiple_of(WIDEST);
        Self {
            sites: Vec::with_capacity(n),
            motion: APART.map(|x| vec![*x; room]),
            edge_share: vec![0.0; room],
            force: ContactForce::none(0.0).map(|x: &f64| vec![*x; room]),
            laws: None,
            slopes: LawSlopes::default(),
            differentiated: false,
            counts: [0; CONTACT_LAWS],
        }
    }

    /// The same with laws of line contacts.
    pub(super) fn with_laws(self, laws: [LineContact; KINDS]) -> Self {
        let room = self.motion.delta.len();
        Self { laws: Some(LawColumns::new(laws, room)), slopes: LawSlopes::new(room), ..self }
    }

    pub(super) fn clear(&mut self) {
        self.sites.clear();
        self.differentiated = false;
        self.counts = [0; CONTACT_LAWS];
    }

    #[inline]
    pub(super) fn len(&self) -> usize {
        self.sites.len()
    }

    #[inline(always)]
    pub(super) fn push(&mut self, site: Site, motion: &ContactMotion<f64>) {
        let i = self.len();
        let (kind, law, edge_share) = match &site.mate {
            Mate::Outer => (0, OUTER_RACEWAY, 0.0),
            Mate::Inner => (1, INNER_RACEWAY, 0.0),
            Mate::Pocket(_) if self.laws.is_none() => (2, POCKET_PLANE, 0.0),
            Mate::Pocket(site) if site.edge_share >= 1.0 => (2, POCKET_EDGE, site.edge_share),
            Mate::Pocket(site) => (2, POCKET_WALL, site.edge_share),
        };
        self.motion.set(i, motion);
        self.edge_share[i] = edge_share;
        if let Some(laws) = &mut self.laws {
            laws.set(i, kind);
        }
        self.counts[law] += 1;
        self.sites.push(site);
    }

    /// Makes the places up to the next whole group apart.
    fn pad(&mut self) {
        for i in self.len()..self.len().next_multiple_of(WIDEST) {
            self.motion.set(i, &APART);
            self.edge_share[i] = 0.0;
        }
    }

    /// Evaluates the laws of line contacts, with the logarithm `thickening` of the relative viscosity.
    pub(super) fn apply(&mut self, thickening: f64, instructions: Arch) {
        self.pad();
        self.differentiated = false;
        let rows = self.len();
        if let Some(laws) = &self.laws {
            laws.apply(rows, &self.motion, &self.edge_share, thickening, &mut self.force, instructions);
        }
    }

    /// Evaluates the laws of line contacts with their derivatives, unless the last evaluation has done so.
    pub(super) fn differentiate(&mut self, thickening: f64, instructions: Arch) {
        if self.differentiated {
            return;
        }
        self.pad();
        self.differentiated = true;
        let rows = self.len();
        if let Some(laws) = &self.laws {
            let seen = (&self.motion, &self.edge_share[..]);
            self.slopes.find(laws, rows, seen, thickening, &mut self.force, instructions);
        }
    }

    /// Every contact with its normal force, friction and rolling resistance, N.
    #[inline]
    pub(super) fn forces(&self) -> impl Iterator<Item = (&Site, ContactForce<f64>)> {
        let f = &self.force;
        let forces = f.normal.iter().zip(&f.friction).zip(&f.rolling_resistance);
        self.sites.iter().zip(forces).map(|(site, ((&normal, &friction), &rolling_resistance))| {
            (site, ContactForce { normal, friction, rolling_resistance, ..ContactForce::none(0.0) })
        })
    }

    /// Normal force, friction and rolling resistance of contact `i`, N, and their derivatives over what the law sees.
    #[inline(always)]
    pub(super) fn slopes(&self, i: usize) -> ([f64; FORCES], Slopes) {
        let f = &self.force;
        ([f.normal[i], f.friction[i], f.rolling_resistance[i]], self.slopes.of(i))
    }

    /// Every contact with its normal damping and its secant slope of friction, N s/m.
    #[inline]
    pub(super) fn damping(&self) -> impl Iterator<Item = (&Site, [f64; 2])> {
        let rates = self.force.damping.iter().zip(&self.force.friction_secant);
        self.sites.iter().zip(rates).map(|(site, (damping, secant))| (site, [*damping, *secant]))
    }

    /// Every contact with all that is known of it.
    #[inline]
    pub(super) fn iter(&self) -> impl Iterator<Item = Loaded<'_>> {
        self.sites.iter().enumerate().map(|(i, site)| Loaded {
            site,
            motion: self.motion.map(|x| x[i]),
            force: self.force.map(|x| x[i]),
        })
    }
}

/// One contact of a batch.
pub(super) struct Loaded<'a> {
    pub(super) site: &'a Site,
    pub(super) motion: ContactMotion<f64>,
    pub(super) force: ContactForce<f64>,
}
