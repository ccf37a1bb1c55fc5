//! What methods ask of a bearing: accelerations, damping, derivatives, powers, what is watched.

use super::{Bearing, Moving};
use crate::bodies::Power;
use crate::integrate::{
    GroupDamping, Interruption, Linearization, Linearized, Observed, SemiImplicit, Split, Structure,
    Structured, System, Vibration,
};
use crate::model::{Energy, Fault, OF_BALL, OF_ELEMENT, POWERS, RATES};

/// Why a method never asks a bearing for spokes of another width.
const WRONG_SPOKES: &str = "methods are made for the spokes of their bearing";

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
        of_moving!(self, bearing, workspace => {
            self.model.find_inputs(t, &self.host, workspace.inputs_mut());
            bearing.evaluate(q, v, workspace, a)
        })
    }

    fn not_finite(&self, velocity: usize) -> Fault {
        Fault::NotFinite { velocity, contact: None }
    }

    fn next_event(&self, t: f64) -> f64 {
        self.model.next_event(t, &self.host)
    }

    fn longest_step(&self, t: f64, q: &[f64], v: &[f64], wanted: f64) -> f64 {
        match &self.moving {
            Moving::Plane(plane, _) => plane.longest_step(t, [q, v], &self.host, wanted, &self.tuning),
            Moving::Space(space, _) => space.longest_step(t, [q, v], &self.host, &self.tuning),
        }
    }

    /// Elements, then the ring, the cage and nodes, whichever exist.
    fn groups(&self) -> Vec<Vec<usize>> {
        of_moving!(ref self, bearing, _workspace => bearing.structure().groups())
    }
}

/// What methods ask beside accelerations, with spokes as wide as an element has speeds. A method has those of its bearing.
macro_rules! with_spokes {
    ($spoke:expr, $moving:ident) => {
        impl Structured<{ $spoke }> for Bearing {
            fn structure(&self) -> Structure<{ $spoke }> {
                match &self.moving {
                    Moving::$moving(bearing, _) => bearing.structure(),
                    _ => unreachable!("{WRONG_SPOKES}"),
                }
            }
        }

        impl Linearized<{ $spoke }> for Bearing {
            fn linearize(
                &mut self,
                t: f64,
                q: &[f64],
                v: &[f64],
                a: &mut [f64],
                out: &mut Linearization<{ $spoke }>,
            ) -> Result<(), Fault> {
                self.set_differentiating(true);
                let evaluated = self.accelerations(t, q, v, a);
                self.set_differentiating(false);
                evaluated?;
                self.jacobians += 1;
                let rates = self.model.input_rates_at(t, &self.host);
                match &mut self.moving {
                    Moving::$moving(bearing, workspace) => bearing.linearize(workspace, &rates, out),
                    _ => unreachable!("{WRONG_SPOKES}"),
                }
                Ok(())
            }

            fn linearization_cost(&self) -> f64 {
                of_moving!(ref self, bearing, _workspace => bearing.jacobian_cost())
            }
        }

        impl Split<{ $spoke }> for Bearing {
            fn accelerations_to_split(
                &mut self,
                t: f64,
                q: &[f64],
                v: &[f64],
                a: &mut [f64],
            ) -> Result<(), Fault> {
                self.set_splitting(true);
                let evaluated = self.accelerations(t, q, v, a);
                self.set_splitting(false);
                evaluated
            }

            fn damping(&mut self, h: f64, _q: &[f64], _v: &[f64], out: &mut GroupDamping<{ $spoke }>) {
                match &mut self.moving {
                    Moving::$moving(bearing, workspace) => bearing.damping(h, workspace, out),
                    _ => unreachable!("{WRONG_SPOKES}"),
                }
            }

            fn react(&mut self, _q: &[f64], v: &[f64], step: &SemiImplicit<'_>, a: &mut [f64]) {
                of_moving!(self, bearing, workspace => bearing.react(v, step, workspace, a));
            }

            fn admit(&self, v: &[f64]) -> Result<(), Fault> {
                of_moving!(ref self, bearing, _workspace => bearing.admit(v))
            }
        }
    };
}

with_spokes!(OF_ELEMENT, Plane);
with_spokes!(OF_BALL, Space);

impl Observed for Bearing {
    fn overdrawn(&self, [before, last]: [&[f64]; 2]) -> Option<Fault> {
        let stored = self.start_energy?;
        let work = |power: Power| before[power as usize] + last[power as usize];
        let given = work(Power::GuideFilm);
        if given <= stored {
            return None;
        }
        let came = Power::ALL.into_iter().filter(|power| !power.is_lost()).map(|power| work(power).max(0.0));
        let available = stored + came.sum::<f64>();
        (given > available).then_some(Fault::EnergyCreated { given, available })
    }

    fn vibration(&self) -> Vibration {
        of_moving!(ref self, _bearing, workspace => workspace.vibration())
    }

    fn power_count(&self) -> [usize; 2] {
        [POWERS.len(), RATES - POWERS.len()]
    }

    fn powers(&mut self, _q: &[f64], v: &[f64], step: Option<&SemiImplicit<'_>>, out: &mut [f64]) {
        of_moving!(self, bearing, workspace => bearing.powers(v, step, workspace, out));
    }

    fn energy(&self, _q: &[f64], _v: &[f64]) -> [f64; 3] {
        let Energy { kinetic, elastic, potential } = Bearing::energy(self);
        [kinetic, elastic, potential]
    }

    fn watched(&self) -> usize {
        self.model.watched().len()
    }

    fn watch(&mut self, _q: &[f64], v: &[f64], step: Option<&SemiImplicit<'_>>, out: &mut [f64]) {
        of_moving!(self, bearing, workspace => bearing.watch(v, step, workspace, out));
    }

    fn interruption(&mut self) -> Option<Interruption> {
        self.limits.interruption()
    }

    fn failed(&mut self, t: f64, fault: Fault) {
        self.fault_counts[fault.kind()] += 1;
        self.last_fault = Some((t, fault));
    }

    fn rejected(&mut self, group: usize) {
        if let Some(count) = self.rejections.get_mut(group) {
            *count += 1;
        }
    }
}
