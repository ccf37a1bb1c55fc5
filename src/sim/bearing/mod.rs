//! The model as the integrator sees it: with its workspace, inputs and counts.

use crate::integrate::{Applied, SemiImplicit, Tuning};
use crate::model::space::{self, Space};
use crate::model::{
    Energy, Fault, FaultCounts, Forces, HostInputs, Input, InputValues, LawCounts, LineLoad, Model,
    PartTimes, Plane, Reading, Workspace, plane,
};
use crate::sim::limits::RunLimits;
use crate::sim::linear::jacobian::AnySlopes;
use std::sync::Arc;

/// A bearing with its memory, by the space in which it moves.
enum Moving {
    Plane(Arc<Plane>, Box<Workspace>),
    Space(Arc<Space>, Box<space::Workspace>),
}

/// Does the same with the bearing and its workspace, whichever it is.
macro_rules! of_moving {
    ($self:ident, $bearing:ident, $workspace:ident => $work:expr) => {
        match &mut $self.moving {
            Moving::Plane($bearing, $workspace) => $work,
            Moving::Space($bearing, $workspace) => $work,
        }
    };
    (ref $self:ident, $bearing:ident, $workspace:ident => $work:expr) => {
        match &$self.moving {
            Moving::Plane($bearing, $workspace) => $work,
            Moving::Space($bearing, $workspace) => $work,
        }
    };
}

mod system;

pub(in crate::sim) struct Bearing {
    model: Arc<Model>,
    moving: Moving,
    host: HostInputs,
    evaluations: u64,
    jacobians: u64,
    /// Failed attempts by cause, and the last one with its time in s.
    fault_counts: FaultCounts,
    last_fault: Option<(f64, Fault)>,
    /// Steps rejected because of each group.
    rejections: Vec<u64>,
    limits: RunLimits,
    memory: StepMemory,
    tuning: Tuning,
    /// Energy at the start of the balance where a film can create some, J.
    start_energy: Option<f64>,
}

/// Memory for the forces of a step: the state it was evaluated at, mean velocities, accelerations.
#[derive(Default)]
struct StepMemory {
    middle: Vec<f64>,
    mean: Vec<f64>,
    a: Vec<f64>,
}

impl Bearing {
    pub(in crate::sim) fn new(model: Arc<Model>, tuning: Tuning) -> crate::Result<Self> {
        let moving = match model.space() {
            Some(space) => Moving::Space(space.clone(), Box::new(space::Workspace::new(space))),
            None => {
                let plane = model.plane()?.clone();
                let workspace = Box::new(Workspace::new(&plane));
                Moving::Plane(plane, workspace)
            }
        };
        let groups = match &moving {
            Moving::Plane(plane, _) => plane.structure().groups().len(),
            Moving::Space(space, _) => space.structure().groups().len(),
        };
        let layout = model.layout();
        Ok(Self {
            moving,
            host: HostInputs::default(),
            evaluations: 0,
            jacobians: 0,
            fault_counts: FaultCounts::default(),
            last_fault: None,
            rejections: vec![0; groups],
            limits: RunLimits::default(),
            tuning,
            start_energy: model.energy_giving_film().map(|_| 0.0),
            memory: StepMemory {
                middle: Vec::with_capacity(layout.states()),
                mean: Vec::with_capacity(layout.velocities()),
                a: Vec::with_capacity(layout.velocities()),
            },
            model,
        })
    }

    pub(in crate::sim) fn model(&self) -> &Arc<Model> {
        &self.model
    }

    pub(in crate::sim) fn describe(&self, fault: Fault) -> String {
        self.model.describe(fault)
    }

    pub(in crate::sim) fn tuning(&self) -> Tuning {
        self.tuning
    }

    pub(in crate::sim) fn host(&self) -> &HostInputs {
        &self.host
    }

    pub(in crate::sim) fn host_mut(&mut self) -> &mut HostInputs {
        &mut self.host
    }

    /// Sets an input at time `t` in s, to a value and a slope, or releases it.
    pub(in crate::sim) fn set_input(&mut self, t: f64, input: Input, to: Option<(f64, Option<f64>)>) {
        self.model.set_input(&mut self.host, t, input, to);
    }

    pub(in crate::sim) fn evaluations(&self) -> u64 {
        self.evaluations
    }

    pub(in crate::sim) fn law_counts(&self) -> LawCounts {
        of_moving!(ref self, _bearing, workspace => workspace.law_counts())
    }

    pub(in crate::sim) fn jacobians(&self) -> u64 {
        self.jacobians
    }

    pub(in crate::sim) fn set_counts(&mut self, [evaluations, jacobians]: [u64; 2], law_counts: LawCounts) {
        (self.evaluations, self.jacobians) = (evaluations, jacobians);
        of_moving!(self, _bearing, workspace => workspace.set_law_counts(law_counts));
    }

    pub(in crate::sim) fn fault_counts(&self) -> &FaultCounts {
        &self.fault_counts
    }

    pub(in crate::sim) fn set_fault_counts(&mut self, counts: FaultCounts) {
        self.fault_counts = counts;
        self.last_fault = None;
    }

    /// The last failed attempt since creation, reset or restoring: time in s and cause.
    pub(in crate::sim) fn last_fault(&self) -> Option<(f64, Fault)> {
        self.last_fault
    }

    /// Steps rejected because of each group.
    pub(in crate::sim) fn rejections_mut(&mut self) -> &mut [u64] {
        &mut self.rejections
    }

    pub(in crate::sim) fn rejections(&self) -> &[u64] {
        &self.rejections
    }

    /// The body because of which most steps were rejected, and how many.
    pub(in crate::sim) fn most_rejections(&self) -> Option<(String, u64)> {
        let most = self.rejections.iter().copied().max().filter(|n| *n > 0)?;
        let group = self.rejections.iter().position(|n| *n == most)?;
        Some((self.group_name(group)?, most))
    }

    /// Name of the body of a group.
    pub(in crate::sim) fn group_name(&self, group: usize) -> Option<String> {
        of_moving!(ref self, bearing, _workspace => bearing.group_name(group))
    }

    pub(in crate::sim) fn reset(&mut self) {
        self.host = HostInputs::default();
        self.set_counts([0; 2], LawCounts::default());
        self.set_fault_counts(FaultCounts::default());
        self.rejections.fill(0);
    }

    /// Accelerations of a state vector; not counted as an evaluation of the integration.
    pub(in crate::sim) fn accelerations_at(
        &mut self,
        t: f64,
        state: &[f64],
        a: &mut [f64],
    ) -> Result<(), Fault> {
        let (q, v) = state.split_at(self.model.layout().positions());
        of_moving!(self, bearing, workspace => {
            workspace.set_counting(false);
            self.model.find_inputs(t, &self.host, workspace.inputs_mut());
            let result = bearing.evaluate(q, v, workspace, a);
            workspace.set_counting(true);
            result
        })
    }

    /// Accelerations of a state vector and their derivatives; not counted as an evaluation of the integration.
    pub(in crate::sim) fn linearize_at(
        &mut self,
        t: f64,
        state: &[f64],
        a: &mut [f64],
        slopes: &mut AnySlopes,
    ) -> Result<(), Fault> {
        self.set_differentiating(true);
        let evaluated = self.accelerations_at(t, state, a);
        self.set_differentiating(false);
        evaluated?;
        let rates = self.model.input_rates_at(t, &self.host);
        self.linearize_along(&rates, slopes);
        Ok(())
    }

    /// Derivatives at the last evaluated state, with inputs that change at these rates.
    pub(in crate::sim) fn linearize_along(&mut self, rates: &InputValues, slopes: &mut AnySlopes) {
        match (&mut self.moving, slopes) {
            (Moving::Plane(plane, workspace), AnySlopes::Plane(slopes)) => {
                plane.linearize(workspace, rates, &mut slopes.linearization);
            }
            (Moving::Space(space, workspace), AnySlopes::Space(slopes)) => {
                space.linearize(workspace, rates, &mut slopes.linearization);
            }
            _ => unreachable!("slopes are made for their bearing"),
        }
    }

    /// Writes the output channels of a state vector at these inputs; not counted.
    pub(in crate::sim) fn outputs_with(
        &mut self,
        inputs: &InputValues,
        state: &[f64],
        (a, forces): (&mut [f64], &mut Forces),
        out: &mut [f64],
    ) -> Result<(), Fault> {
        let (q, v) = state.split_at(self.model.layout().positions());
        of_moving!(self, bearing, workspace => {
            workspace.set_counting(false);
            *workspace.inputs_mut() = *inputs;
            let result = bearing.evaluate(q, v, workspace, a);
            workspace.set_counting(true);
            result?;
        });
        self.report(state, a, forces);
        let reading = self.reading_with(*inputs, state, forces);
        for (out, channel) in out.iter_mut().zip(self.model.channels()) {
            *out = reading.value(channel);
        }
        Ok(())
    }

    /// Whether evaluations find more for derivatives in the same pass.
    fn set_differentiating(&mut self, differentiating: bool) {
        if let Moving::Plane(_, workspace) = &mut self.moving {
            workspace.set_differentiating(differentiating);
        }
    }

    /// Memory for derivatives of the accelerations.
    pub(in crate::sim) fn new_slopes(&self) -> AnySlopes {
        AnySlopes::new(&self.model)
    }

    /// Whether evaluations find more for the damping of a step in the same pass.
    fn set_splitting(&mut self, splitting: bool) {
        if let Moving::Plane(_, workspace) = &mut self.moving {
            workspace.set_splitting(splitting);
        }
    }

    /// Energy of the last evaluated state.
    pub(in crate::sim) fn energy(&self) -> Energy {
        of_moving!(ref self, bearing, workspace => bearing.energy(workspace))
    }

    /// Says what was stored when the works of the run began, J.
    pub(in crate::sim) fn begin_works(&mut self, energy: &Energy) {
        let stored = energy.kinetic + energy.elastic + energy.potential.abs();
        self.start_energy = self.start_energy.map(|_| stored);
    }

    pub(in crate::sim) fn limits(&self) -> &RunLimits {
        &self.limits
    }

    pub(in crate::sim) fn limits_mut(&mut self) -> &mut RunLimits {
        &mut self.limits
    }

    pub(in crate::sim) fn set_vector_instructions(&mut self, vector: bool) {
        of_moving!(self, _bearing, workspace => workspace.set_vector_instructions(vector));
    }

    /// Wall time of each part of an evaluation at a state, s; not counted.
    pub(in crate::sim) fn time_parts(
        &mut self,
        t: f64,
        state: &[f64],
        repeats: u32,
    ) -> Result<PartTimes, Fault> {
        let state = state.split_at(self.model.layout().positions());
        let inputs = self.model.inputs_at(t, &self.host);
        of_moving!(self, bearing, workspace => {
            workspace.set_counting(false);
            let times = bearing.time_parts(&inputs, state, workspace, repeats);
            workspace.set_counting(true);
            times
        })
    }

    pub(in crate::sim) fn report(&self, state: &[f64], a: &[f64], out: &mut Forces) {
        let (q, v) = state.split_at(self.model.layout().positions());
        match &self.moving {
            Moving::Plane(plane, workspace) => plane.report(q, v, workspace, a, out),
            Moving::Space(space, workspace) => {
                out.accelerations.clear();
                out.accelerations.extend_from_slice(a);
                space.report(workspace, &mut out.space);
            }
        }
    }

    /// How a contact of rollers in space is loaded along its length at the last evaluated state; nothing of others.
    pub(in crate::sim) fn line_loads(&self, contact: usize) -> Vec<LineLoad> {
        match &self.moving {
            Moving::Plane(..) => Vec::new(),
            Moving::Space(space, workspace) => space.line_loads(workspace, contact),
        }
    }

    /// Writes the forces of a step that began at time `t` (s) into `out`, with the bodies at `state`.
    pub(in crate::sim) fn report_step(
        &mut self,
        t: f64,
        step: &Applied<'_>,
        state: &[f64],
        out: &mut Forces,
    ) -> Result<(), Fault> {
        let nq = self.model.layout().positions();
        let (start_q, start_v) = step.start.split_at(nq);
        let end_v = &step.end[nq..];
        let StepMemory { mut middle, mut mean, mut a } = std::mem::take(&mut self.memory);
        middle.clear();
        middle.extend(start_q.iter().zip(start_v).map(|(q, v)| q + 0.5 * step.h * v));
        middle.extend_from_slice(step.predicted);
        mean.clear();
        mean.extend(start_v.iter().zip(end_v).map(|(a, b)| 0.5 * (a + b)));
        a.resize(mean.len(), 0.0);
        let evaluated = self.accelerations_at(t + 0.5 * step.h, &middle, &mut a);
        if evaluated.is_ok() {
            let change = SemiImplicit { mean: &mean, end: end_v, h: step.h };
            of_moving!(self, bearing, workspace => bearing.apply_step(step.predicted, &change, workspace));
            self.report(state, &a, out);
        }
        self.memory = StepMemory { middle, mean, a };
        evaluated
    }

    /// The state at time `t` (s) with `forces` that were found last.
    pub(in crate::sim) fn reading<'a>(&'a self, t: f64, state: &'a [f64], forces: &'a Forces) -> Reading<'a> {
        self.reading_with(self.model.inputs_at(t, &self.host), state, forces)
    }

    fn reading_with<'a>(&'a self, inputs: InputValues, state: &'a [f64], forces: &'a Forces) -> Reading<'a> {
        let (q, v) = state.split_at(self.model.layout().positions());
        match &self.moving {
            Moving::Plane(plane, workspace) => {
                Reading::Plane(plane::Reading::new(plane, [q, v], inputs, workspace, forces))
            }
            Moving::Space(space, workspace) => {
                let (space, ws, forces) = (&**space, workspace, &forces.space);
                Reading::Space(space::Reading { space, ws, inputs, q, v, forces })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{CONTACT_QUANTITIES, Forces};
    use crate::{Scene, Sim};

    /// Momentum that ring and cage gain in a step of the leapfrog is that of the forces that the step reports, on all bodies.
    #[test]
    fn ring_and_cage_move_by_the_forces_that_steps_report() {
        let free = [
            ("inner_ring.motion.free.support_damping", "null"),
            ("cage.guide", "null"),
            ("solver", r#"{"method": {"leapfrog": {}}}"#),
        ];
        for load in ["-4900", "-40e3"] {
            let sets: Vec<_> =
                free.into_iter().chain([("inner_ring.motion.free.load.z.constant", load)]).collect();
            let text = include_str!("../../../scenes/nu2310.json");
            let model = Arc::new(Model::new(Scene::from_json_with(text, sets).unwrap()).unwrap());
            let mut sim = Sim::new(model.clone()).unwrap();
            let (ring, cage) = (model.layout().ring().unwrap(), model.layout().cage().unwrap());
            let (mut compared, nq) = (0, model.layout().positions());
            for _ in 0..1500 {
                sim.step(sim.nominal_step()).unwrap();
                sim.find_output_forces().unwrap();
                let forces: Forces = sim.output_forces.clone();
                // The report holds a force at zero where damping would make it pull within the step.
                let [normal, approach] = ["normal_force", "approach"]
                    .map(|name| CONTACT_QUANTITIES.iter().position(|q| q.name == name).unwrap());
                if forces.contacts.iter().any(|c| c[normal] == 0.0 && c[approach] > 0.0) {
                    continue;
                }
                let (_, step) = sim.driver.applied_at(sim.time).unwrap();
                for (body, at, mass) in [(1, ring, ring_mass(&model)), (2, cage, cage_mass(&model))] {
                    for k in 0..2 {
                        let sum: f64 = forces.bodies[body].iter().map(|force| force[k]).sum();
                        let gained = mass * (step.end[nq + at + k] - step.start[nq + at + k]) / step.h;
                        let largest = forces.bodies[body].iter().fold(1.0, |m: f64, f| m.max(f[k].abs()));
                        assert!(
                            (gained - sum).abs() < 1e-6 * largest,
                            "{load} N, body {body}: {gained} {sum}"
                        );
                    }
                }
                compared += 1;
            }
            assert!(compared > 1000, "{compared}");
        }
    }

    fn ring_mass(model: &Model) -> f64 {
        let crate::scene::RingMotion::Free(free) = &model.scene().inner_ring.as_ref().unwrap().motion else {
            panic!("the ring is free");
        };
        free.mass
    }

    fn cage_mass(model: &Model) -> f64 {
        model.scene().cage.as_ref().unwrap().mass
    }
}
