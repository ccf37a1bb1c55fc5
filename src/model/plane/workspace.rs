//! Memory of a force evaluation: motion of the bodies, touching contacts, and all forces.

use super::inverse_inertia::InverseInertia;
use super::{InputValues, Plane};
use crate::bodies::{BodyState, CAGE, Motions, OF_ELEMENT, SHARED, WrenchLanes};
use crate::integrate::Vibration;
use crate::laws::fluid::Fluid;
use crate::model::RATES;
use crate::pairs::{
    Contacts, LAWS, LAWS_OF_PAIR, Law, LawCounts, PairInfo, RelativeSlopes, SharedForce, SpeedChanges,
};
use crate::scalar::{ZEROS, blocks_for};
use crate::space::Wrench;
use std::ops::Range;

/// Memory of a force evaluation and its results. One per simulation; never shared.
#[derive(Clone, Debug)]
pub struct Workspace {
    pub(super) motions: Motions,
    /// Positions and velocities of the shared bodies, and memory for as many.
    pub(super) of_shared: [Vec<f64>; 3],
    pub(super) contacts: Contacts,
    /// Of the step from the last evaluated state.
    pub(super) step: StepMemory,
    /// What the pairs say of themselves.
    infos: Vec<&'static PairInfo>,
    /// Forces of the pairs of shared bodies.
    pub(super) between: Vec<SharedForce>,
    pub(super) inputs: InputValues,
    /// Contact forces on each element that moves freely, local frame.
    pub(super) on_elements: Vec<WrenchLanes>,
    /// Forces on the shared bodies but their weight, moments about their geometric centres, global frame.
    pub(super) on_shared: [Wrench<f64>; SHARED],
    /// Forces over the coordinates of the cage behind those of its motion, but those of its own stiffness and damping.
    pub(super) on_modes: Vec<f64>,
    /// Memory for derivatives.
    pub(super) relative_slopes: RelativeSlopes,
    pub(super) inverse_inertia: InverseInertia,
    /// Powers, where nodes follow from them, and the values of these.
    pub(super) powers: Vec<f64>,
    pub(super) nodes: Vec<f64>,
    /// Evaluations per law, but for those of the contacts of elements: these by pair, and which laws they stand for.
    pub(super) counts: LawCounts,
    pub(super) touched: Vec<[u64; LAWS_OF_PAIR]>,
    of_contacts: Vec<(Law, [usize; 2])>,
    /// Whether evaluations are counted now.
    pub(super) counting: bool,
    /// Whether evaluations find the derivatives of line contacts in the same pass.
    pub(super) differentiating: bool,
    /// Whether they find the damping by pairs of shared bodies in the same pass.
    pub(super) splitting: bool,
    /// Temperature that the viscosity belongs to, K; NaN where the viscosity is constant.
    pub(super) temperature: f64,
    /// The lubricant at that temperature.
    pub(super) fluid: Fluid,
}

impl Workspace {
    /// Memory for evaluations of `model`.
    pub fn new(model: &Plane) -> Self {
        let contacts = Contacts::new(&model.pairs, model.element_count());
        Self {
            step: StepMemory::new(model.layout.count, model.mode_count()),
            motions: Motions::new(model.elements.set(), model.mode_count()),
            of_shared: std::array::from_fn(|_| vec![0.0; model.layout.of_shared()]),
            contacts,
            infos: model.infos.clone(),
            between: model.between.iter().map(|pair| pair.memory()).collect(),
            inputs: InputValues::default(),
            on_elements: vec![[ZEROS; OF_ELEMENT]; blocks_for(model.layout.count)],
            on_shared: [Wrench::default(); SHARED],
            on_modes: vec![0.0; model.mode_count()],
            relative_slopes: RelativeSlopes::new(),
            inverse_inertia: InverseInertia::new(model.layout.of_shared()),
            powers: vec![0.0; RATES],
            nodes: vec![0.0; model.layout.of_nodes()],
            counts: [0; LAWS.len()],
            touched: vec![[0; LAWS_OF_PAIR]; model.pairs.len()],
            of_contacts: model.laws_of_contacts().collect(),
            counting: true,
            differentiating: false,
            splitting: false,
            temperature: model.inputs.oil.map_or(f64::NAN, |oil| oil.built_at.0),
            fluid: model.inputs.oil.map_or(Fluid::SAME, |oil| oil.fluid_at(oil.built_at.0)),
        }
    }

    /// A shared body, whose coordinates are these, at the last evaluated state.
    #[inline]
    pub(super) fn body(&self, place: usize, at: Range<usize>) -> BodyState<'_> {
        let [q, v, _] = &self.of_shared;
        BodyState { motion: &self.motions.shared[place], q: &q[at.clone()], v: &v[at] }
    }

    /// Forces over the coordinates of a shared body behind those of its motion.
    #[inline]
    pub(super) fn on_coordinates(&self, place: usize) -> &[f64] {
        if place == CAGE { &self.on_modes } else { &[] }
    }

    /// Number of touching contacts at the last evaluated state.
    pub(crate) fn touching(&self) -> usize {
        self.contacts.batches.iter().map(|batch| batch.len()).sum()
    }

    /// Normal speeds of the touching contacts that elements roll in, at the last evaluated state.
    pub(crate) fn vibration(&self) -> Vibration {
        let mut sum = Vibration::default();
        for (batch, _, contacts) in self.contacts.by_pair(&self.infos).filter(|(_, info, _)| info.rolls) {
            sum.count += contacts.len() as f64;
            for i in contacts {
                let (block, lane) = batch.at(i);
                sum.squares += block.motion.delta_dot[lane] * block.motion.delta_dot[lane];
            }
        }
        sum
    }

    /// Number of evaluations of each law since the workspace was made or the counts were set, in the order of [`LAWS`].
    pub fn law_counts(&self) -> LawCounts {
        let mut counts = self.counts;
        for (law, [pair, kind]) in &self.of_contacts {
            counts[*law as usize] += self.touched[*pair][*kind];
        }
        counts
    }

    /// Inputs of the next evaluation.
    #[inline]
    pub(crate) fn inputs_mut(&mut self) -> &mut InputValues {
        &mut self.inputs
    }

    /// Whether the next evaluations count; they do at first.
    pub fn set_counting(&mut self, counting: bool) {
        self.counting = counting;
    }

    /// Whether the next evaluations find what [`Plane::linearize`] needs along with the forces, which is quicker than finding
    /// it then; they do not at first.
    pub fn set_differentiating(&mut self, differentiating: bool) {
        self.differentiating = differentiating;
    }

    /// Whether the next evaluations find what [`Plane::damping`] needs along with the forces; they do not at first.
    pub(crate) fn set_splitting(&mut self, splitting: bool) {
        self.splitting = splitting;
    }

    /// Whether evaluations use the widest vector instructions of the machine, or none; they do at first.
    pub fn set_vector_instructions(&mut self, vector: bool) {
        self.motions.instructions = if vector { pulp::Arch::new() } else { pulp::Arch::Scalar };
    }

    /// Sets the counts.
    pub fn set_law_counts(&mut self, counts: LawCounts) {
        self.counts = counts;
        self.touched.fill([0; LAWS_OF_PAIR]);
    }
}

/// What is known of the step from the last evaluated state.
#[derive(Clone, Debug)]
pub(super) struct StepMemory {
    pub(super) of_elements: Vec<SpeedChanges>,
    /// What it has added to the forces over the coordinates of the cage behind those of its motion.
    pub(super) on_modes: Vec<f64>,
    /// Step whose forces the contacts have, s; zero where they have those of the state itself.
    pub(super) found: Option<f64>,
}

impl StepMemory {
    /// Memory for these elements and a cage with so many modes.
    pub(super) fn new(elements: usize, modes: usize) -> Self {
        Self {
            of_elements: vec![[[ZEROS; OF_ELEMENT]; 2]; blocks_for(elements)],
            on_modes: vec![0.0; modes],
            found: None,
        }
    }

    /// Forgets it, as another state is evaluated.
    #[inline]
    pub(super) fn forget(&mut self) {
        self.found = None;
    }
}
