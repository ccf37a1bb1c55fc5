//! Memory of a force evaluation: places of the elements, touching contacts, and all forces.

use super::batch::{Batch, Loaded, Mate, Site};
use super::laws::{INNER_RACEWAY, LAWS, LawCounts, OUTER_RACEWAY};
use super::places::Places;
use super::{InputValues, Model};
use crate::contact::raceway::RollerMotion;
use crate::contact::{Wrench, rotate};
use crate::integrate::Vibration;
use crate::laws::guide::{GuideForce, GuideLaw};
use crate::laws::journal::JournalMotion;

/// Motion of an element and the direction of its local frame.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct ElementSite {
    pub(super) motion: RollerMotion<f64>,
    pub(super) sin: f64,
    pub(super) cos: f64,
    /// Sine and cosine of the angle by which the element leads its pocket; (0, 1) without pockets.
    pub(super) lead: (f64, f64),
    /// Element centre relative to its pocket, pocket frame, m; zero without pockets.
    pub(super) pocket_offset: [f64; 2],
}

impl ElementSite {
    /// Normal of a contact of this element in its local frame.
    #[inline]
    pub(super) fn normal(&self, contact: &Site) -> [f64; 2] {
        match contact.mate {
            Mate::Outer | Mate::Inner => contact.frame.normal,
            Mate::Pocket(_) => rotate(contact.frame.normal, -self.lead.0, self.lead.1),
        }
    }

    /// A global vector in the element's local frame.
    #[inline]
    pub(super) fn to_local(self, v: [f64; 2]) -> [f64; 2] {
        rotate(v, -self.sin, self.cos)
    }

    /// A local vector in the global frame.
    #[inline]
    pub(super) fn to_global(self, v: [f64; 2]) -> [f64; 2] {
        rotate(v, self.sin, self.cos)
    }
}

/// Memory of a force evaluation and its results. One per simulation; never shared.
#[derive(Clone, Debug)]
pub struct Workspace {
    /// Of elements that move freely.
    pub(super) places: Places,
    pub(super) elements: Vec<ElementSite>,
    /// Contacts with raceways, first the outer one, and, if their laws have the same parts, with pockets.
    pub(super) raceways: Batch,
    /// Contacts with pockets otherwise.
    pub(super) pockets: Batch,
    joined: bool,
    /// Force of the guide on its journal, and the motion it belongs to.
    pub(super) guide: Option<GuideForce<f64>>,
    pub(super) journal: Option<JournalMotion<f64>>,
    pub(super) inputs: InputValues,
    /// Contact forces on each roller, local frame; empty for kinematic elements.
    pub(super) on_roller: Vec<Wrench<f64>>,
    /// Forces on the cage but its weight, moment about its geometric centre, global frame.
    pub(super) on_cage: Wrench<f64>,
    /// Evaluations per law.
    pub(super) counts: LawCounts,
    /// Whether evaluations are counted now.
    pub(super) counting: bool,
    /// Whether evaluations find the derivatives of line contacts in the same pass.
    pub(super) differentiating: bool,
    /// Temperature that the viscosity belongs to, K; NaN where the viscosity is constant.
    pub(super) temperature: f64,
    /// ln of the viscosity at that temperature over that of the laws.
    pub(super) thickening: f64,
    /// The guide at that viscosity.
    pub(super) guide_law: Option<GuideLaw>,
    /// Vector instructions of this machine.
    pub(super) instructions: pulp::Arch,
}

impl Workspace {
    /// Memory for evaluations of `model`.
    pub fn new(model: &Model) -> Self {
        let n = model.elements.count;
        let rollers = model.layout.count;
        let in_pockets = if model.laws.pocket.is_some() { 2 * n } else { 0 };
        let laws = model.laws.of_lines();
        let apart = if laws.joined { 0 } else { in_pockets };
        let batch = |n: usize, laws: Option<_>| {
            let batch = Batch::new(n);
            if let Some(laws) = laws { batch.with_laws(laws) } else { batch }
        };
        Self {
            places: Places::new(rollers),
            elements: vec![ElementSite::default(); n],
            raceways: batch(2 * rollers + in_pockets - apart, laws.raceways),
            pockets: batch(apart, laws.pockets),
            joined: laws.joined,
            guide: None,
            journal: None,
            inputs: InputValues::default(),
            on_roller: vec![Wrench::default(); rollers],
            on_cage: Wrench::default(),
            counts: [0; LAWS.len()],
            counting: true,
            differentiating: false,
            temperature: model.inputs.oil.map_or(f64::NAN, |oil| oil.built_at.0),
            thickening: 0.0,
            guide_law: model.laws.guide.clone(),
            instructions: pulp::Arch::new(),
        }
    }

    /// Number of contacts that touched in the last evaluation: raceways, pockets.
    pub fn active_contacts(&self) -> [usize; 2] {
        let raceways = self.on_raceways();
        [raceways, self.raceways.len() + self.pockets.len() - raceways]
    }

    /// Normal speeds of the touching raceway contacts at the last evaluated state.
    pub(crate) fn vibration(&self) -> Vibration {
        let speeds = &self.raceways.motion.delta_dot[..self.on_raceways()];
        Vibration { squares: speeds.iter().map(|v| v * v).sum(), count: speeds.len() as f64 }
    }

    /// Number of contacts with raceways, the first in their batch.
    pub(super) fn on_raceways(&self) -> usize {
        let counts = &self.raceways.counts;
        (counts[OUTER_RACEWAY] + counts[INNER_RACEWAY]) as usize
    }

    /// Number of evaluations of each law since the workspace was made or the counts were set, in the order of [`LAWS`].
    pub fn law_counts(&self) -> &LawCounts {
        &self.counts
    }

    /// Whether the next evaluations count; they do at first.
    pub fn set_counting(&mut self, counting: bool) {
        self.counting = counting;
    }

    /// Whether the next evaluations find what [`Model::linearize`] needs along with the forces, which is quicker than finding
    /// it then; they do not at first.
    pub fn set_differentiating(&mut self, differentiating: bool) {
        self.differentiating = differentiating;
    }

    /// Whether evaluations use the widest vector instructions of the machine, or none; they do at first.
    pub fn set_vector_instructions(&mut self, vector: bool) {
        self.instructions = if vector { pulp::Arch::new() } else { pulp::Arch::Scalar };
    }

    /// Sets the counts.
    pub fn set_law_counts(&mut self, counts: LawCounts) {
        self.counts = counts;
    }

    /// All touching contacts.
    #[inline]
    pub(super) fn contacts(&self) -> impl Iterator<Item = Loaded<'_>> {
        self.raceways.iter().chain(self.pockets.iter())
    }

    /// The batch of contacts with pockets.
    #[inline]
    pub(super) fn pocket_batch(&mut self) -> &mut Batch {
        if self.joined { &mut self.raceways } else { &mut self.pockets }
    }

    pub(super) fn clear(&mut self) {
        self.raceways.clear();
        self.pockets.clear();
    }
}
