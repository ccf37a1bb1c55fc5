//! The model as the integrator sees it: with its workspace, inputs and counts.

use crate::integrate::{DampingBlock, Linearization, Structure, System};
use crate::model::{Channel, Fault, Forces, HostInputs, Input, LawCounts, Model, Workspace};
use std::sync::Arc;

pub(super) struct Bearing {
    model: Arc<Model>,
    workspace: Workspace,
    host: HostInputs,
    evaluations: u64,
}

impl Bearing {
    pub(super) fn new(model: Arc<Model>) -> Self {
        let workspace = Workspace::new(&model);
        Self { model, workspace, host: HostInputs::default(), evaluations: 0 }
    }

    pub(super) fn model(&self) -> &Arc<Model> {
        &self.model
    }

    pub(super) fn host(&self) -> &HostInputs {
        &self.host
    }

    pub(super) fn host_mut(&mut self) -> &mut HostInputs {
        &mut self.host
    }

    /// Sets or releases an input at time `t` in s.
    pub(super) fn set_input(&mut self, t: f64, input: Input, value: Option<f64>) {
        self.model.set_input(&mut self.host, t, input, value);
    }

    pub(super) fn evaluations(&self) -> u64 {
        self.evaluations
    }

    pub(super) fn law_counts(&self) -> &LawCounts {
        self.workspace.law_counts()
    }

    pub(super) fn set_counts(&mut self, evaluations: u64, law_counts: LawCounts) {
        self.evaluations = evaluations;
        self.workspace.set_law_counts(law_counts);
    }

    pub(super) fn reset(&mut self) {
        self.host = HostInputs::default();
        self.set_counts(0, LawCounts::default());
    }

    /// Accelerations of a state vector; not counted as an evaluation of the integration.
    pub(super) fn accelerations_at(&mut self, t: f64, state: &[f64], a: &mut [f64]) -> Result<(), Fault> {
        let (q, v) = state.split_at(self.model.layout().positions());
        let inputs = self.model.inputs_at(t, &self.host);
        self.workspace.set_counting(false);
        let result = self.model.accelerations(&inputs, q, v, &mut self.workspace, a);
        self.workspace.set_counting(true);
        result
    }

    pub(super) fn report(&self, state: &[f64], a: &[f64], out: &mut Forces) {
        let (q, v) = state.split_at(self.model.layout().positions());
        self.model.report(q, v, &self.workspace, a, out);
    }

    pub(super) fn channel_value(&self, channel: &Channel, state: &[f64], forces: &Forces) -> f64 {
        let (q, v) = state.split_at(self.model.layout().positions());
        self.model.channel_value(channel, q, v, &self.workspace, forces)
    }
}

impl System for Bearing {
    type Fault = Fault;

    fn positions(&self) -> usize {
        self.model.layout().positions()
    }

    fn velocities(&self) -> usize {
        self.model.layout().velocities()
    }

    fn accelerations(&mut self, t: f64, q: &[f64], v: &[f64], a: &mut [f64]) -> Result<(), Fault> {
        self.evaluations += 1;
        let inputs = self.model.inputs_at(t, &self.host);
        self.model.accelerations(&inputs, q, v, &mut self.workspace, a)
    }

    fn not_finite(&self, velocity: usize) -> Fault {
        Fault::NotFinite { velocity }
    }

    fn next_event(&self, t: f64) -> f64 {
        self.model.next_event(t, &self.host)
    }

    /// Rollers, then the ring and the cage, whichever exist.
    fn damped_blocks(&self) -> usize {
        let layout = self.model.layout();
        layout.count + usize::from(layout.ring.is_some()) + usize::from(layout.cage.is_some())
    }

    fn damped_block(&self, i: usize) -> [Option<usize>; 3] {
        let layout = self.model.layout();
        if i < layout.count {
            return [Some(layout.roller(i)), Some(layout.roller(i) + 1), Some(layout.spin(i))];
        }
        match (layout.ring, layout.cage) {
            (Some(ring), _) if i == layout.count => [Some(ring), Some(ring + 1), None],
            (_, Some(cage)) => [Some(cage), Some(cage + 1), Some(cage + 2)],
            _ => [None; 3],
        }
    }

    fn structure(&self) -> Structure {
        self.model.structure()
    }

    fn linearize(
        &mut self,
        t: f64,
        q: &[f64],
        v: &[f64],
        a: &mut [f64],
        out: &mut Linearization,
    ) -> Result<(), Fault> {
        self.accelerations(t, q, v, a)?;
        let rates = self.model.input_rates_at(t, &self.host);
        self.model.linearize(q, v, &self.workspace, &rates, out);
        Ok(())
    }

    fn damping(&self, h: f64, q: &[f64], v: &[f64], blocks: &mut [DampingBlock]) {
        let layout = self.model.layout();
        let (rollers, others) = blocks.split_at_mut(layout.count);
        self.model.roller_damping(&self.workspace, rollers);
        let cage = self.model.cage_damping(q, v, &self.workspace, h);
        let mut others = others.iter_mut();
        if layout.ring.is_some()
            && let Some(ring) = others.next()
        {
            *ring = self.model.ring_damping(&cage, h);
        }
        if let Some(block) = others.next() {
            *block = cage;
        }
    }
}
