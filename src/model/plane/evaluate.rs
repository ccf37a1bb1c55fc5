//! The force evaluation: from a state to the forces of every contact and the accelerations.
//!
//! Bodies find their motion; pairs find the contacts that touch, and their laws are run over all of them; forces are
//! collected on the bodies, which turn them into accelerations. A contact that is apart costs its distance check.

use super::workspace::Workspace;
use super::{Fault, Input, InputValues, Plane};
use crate::bodies::{
    BodyState, CAGE, CAGE_MOTION, OF_ELEMENT, OUTER_RING, OnBody, SHARED, SOUND, SharedBody, WrenchLanes,
};
use crate::laws::contact_pair::ContactForce;
use crate::pairs::{ContactBlock, Law};
use crate::scalar::{WIDEST, ZEROS, all_finite, math};
use crate::space::{Motion, Wrench};

impl Plane {
    /// Accelerations `a` (shape: velocities; m/s^2 or rad/s^2) at positions `q` and velocities `v`.
    ///
    /// # Errors
    /// A [`Fault`] when forces are undefined at this state; `a` is then meaningless.
    ///
    /// # Panics
    /// When a slice is shorter than its shape, or `ws` was made for another model.
    #[doc(hidden)]
    pub fn accelerations(
        &self,
        inputs: &InputValues,
        q: &[f64],
        v: &[f64],
        ws: &mut Workspace,
        a: &mut [f64],
    ) -> Result<(), Fault> {
        ws.inputs = *inputs;
        self.evaluate(q, v, ws, a)
    }

    /// [`Plane::accelerations`] at the inputs that `ws` holds.
    pub(crate) fn evaluate(
        &self,
        q: &[f64],
        v: &[f64],
        ws: &mut Workspace,
        a: &mut [f64],
    ) -> Result<(), Fault> {
        self.set_lumps(v, &mut ws.inputs);
        self.heat(ws)?;
        self.locate(q, v, ws)?;
        self.apply_laws(ws)?;
        self.assemble(ws, a);
        self.find_node_rates(v, ws, a);
        if all_finite(a) { Ok(()) } else { Err(self.not_finite(a, ws)) }
    }

    /// The first acceleration that is not finite.
    #[cold]
    fn not_finite(&self, a: &[f64], ws: &Workspace) -> Fault {
        let velocity = a.iter().position(|x| !x.is_finite()).unwrap_or_default();
        Fault::NotFinite { velocity, contact: self.contact_not_finite(ws) }
    }

    /// Finds the viscosity at the present temperature.
    fn heat(&self, ws: &mut Workspace) -> Result<(), Fault> {
        let temperature = ws.inputs.of(Input::Temperature);
        let Some(oil) = self.inputs.oil.as_ref().filter(|_| temperature != ws.temperature) else {
            return Ok(());
        };
        ws.counts[Law::ViscosityTemperature as usize] += u64::from(ws.counting);
        let fluid = oil.fluid_at(temperature);
        if fluid.relative_viscosity.is_nan() {
            return Err(Fault::NoViscosity { temperature });
        }
        ws.fluid = fluid;
        ws.temperature = temperature;
        Ok(())
    }

    /// Finds the motion of all bodies and the contacts that touch.
    pub(super) fn locate(&self, q: &[f64], v: &[f64], ws: &mut Workspace) -> Result<(), Fault> {
        let Workspace { motions, of_shared: [shared_q, shared_v, _], contacts, step, inputs, .. } = ws;
        shared_q.copy_from_slice(&q[..self.layout.of_shared()]);
        shared_v.copy_from_slice(&v[..self.layout.of_shared()]);
        contacts.clear();
        step.forget();
        self.find_motions(q, v, inputs, &mut motions.shared);
        self.find_deformation(ws);
        let Workspace { motions, contacts, inputs, .. } = ws;
        if !self.moved.is_empty() {
            self.moved_within_reach(&motions.shared)?;
        }
        for (place, body, at) in self.free_bodies() {
            within_reach(place, body, &motions.shared)?;
            let Motion { velocity: [vy, vz], speed, .. } = motions.shared[place];
            // The rotation of rings is prescribed.
            let turning = if place == CAGE { speed.abs() * self.pitch_radius() } else { 0.0 };
            let speeds = [vy.abs(), vz.abs(), turning];
            if let Some(k) = speeds.iter().position(|speed| *speed > SOUND) {
                return Err(Fault::TooFast { velocity: at.start + k, speed: speeds[k] });
            }
        }
        // Elements of prescribed motion that nothing touches are nobody's concern.
        if self.layout.count > 0 || !self.pairs.is_empty() {
            self.elements.find(&self.layout, q, v, inputs, motions)?;
        }
        for (place, pair) in self.pairs.iter().enumerate() {
            pair.find(motions, &mut contacts.of(place, self.infos[place].mate, motions))?;
        }
        Ok(())
    }

    /// Whether rings whose places are prescribed are within the bearing.
    #[cold]
    fn moved_within_reach(&self, shared: &[Motion<f64>; SHARED]) -> Result<(), Fault> {
        let mut moved = self.moved.iter().filter_map(|place| Some((*place, self.shared[*place].as_deref()?)));
        moved.try_for_each(|(place, body)| within_reach(place, body, shared))
    }

    /// Evaluates the laws of all contacts.
    fn apply_laws(&self, ws: &mut Workspace) -> Result<(), Fault> {
        self.apply_to_contacts(ws, |_| true);
        self.apply_between(ws)?;
        if ws.counting {
            self.count(ws);
        }
        Ok(())
    }

    /// Evaluates the laws of those batches whose place will do.
    pub(super) fn apply_to_contacts(&self, ws: &mut Workspace, will_do: impl Fn(usize) -> bool) {
        let Workspace { motions, contacts, fluid, differentiating, .. } = ws;
        for (_, batch) in contacts.batches.iter_mut().enumerate().filter(|(place, _)| will_do(*place)) {
            if *differentiating {
                batch.differentiate(fluid.ln_viscosity, motions.instructions);
            } else {
                batch.apply(fluid.ln_viscosity, motions.instructions);
            }
        }
    }

    /// Evaluates the pairs of shared bodies.
    pub(super) fn apply_between(&self, ws: &mut Workspace) -> Result<(), Fault> {
        let mut pairs = self.between.iter().zip(&mut ws.between);
        let (motions, fluid) = (&ws.motions, ws.fluid);
        if ws.splitting {
            pairs.try_for_each(|(pair, force)| pair.evaluate_with_damping(motions, fluid, force))
        } else {
            pairs.try_for_each(|(pair, force)| pair.evaluate(motions, fluid, force))
        }
    }

    /// The first contact whose force is not finite, as a place in [`Plane::contact_names`].
    fn contact_not_finite(&self, ws: &Workspace) -> Option<usize> {
        let bad = |f: ContactForce<f64>| !(f.normal + f.friction + f.rolling_resistance).is_finite();
        let found = ws.contacts.iter().find(|c| bad(c.force))?;
        Some(self.contact_place(found.site))
    }

    /// Collects forces on the bodies and lets them accelerate.
    pub(super) fn assemble(&self, ws: &mut Workspace, a: &mut [f64]) {
        let mut on = [Wrench::default(); SHARED];
        ws.on_elements.fill([ZEROS; OF_ELEMENT]);
        for batch in &mut ws.contacts.batches {
            batch.add_wrenches(ws.motions.instructions, &mut ws.on_elements);
        }
        self.add_on_mates(ws, &mut on, |block| &block.on_mates);
        if !ws.on_modes.is_empty() {
            let mut on_modes = std::mem::take(&mut ws.on_modes);
            on_modes.fill(0.0);
            self.add_on_modes(ws, &mut on_modes, |block| &block.on_mates);
            ws.on_modes = on_modes;
        }
        let Workspace {
            motions,
            of_shared: [q, v, _],
            between,
            on_elements,
            on_shared,
            on_modes,
            inputs,
            ..
        } = ws;
        for (info, force) in self.between_infos.iter().zip(between) {
            for (body, on_body) in info.bodies.into_iter().zip(&force.on) {
                on[body].add(on_body);
            }
            on_modes.iter_mut().zip(force.on_modes()).for_each(|(sum, force)| *sum += force);
        }
        for (place, body, at) in self.free_bodies() {
            let state = BodyState { motion: &motions.shared[place], q: &q[at.clone()], v: &v[at.clone()] };
            body.add_external(&state, inputs, &mut on[place]);
            let coordinates = if place == CAGE { on_modes.as_slice() } else { &[] };
            let on_body = OnBody { wrench: &on[place], coordinates };
            body.accelerate(&on_body, &state, self.gravity, &mut a[at]);
            on_shared[place] = on[place];
        }
        self.elements.accelerate(&self.layout, motions, on_elements, self.gravity, a);
    }

    /// Adds what all contacts do to those mates that are free, from the wrenches in their blocks.
    pub(super) fn add_on_mates(
        &self,
        ws: &Workspace,
        on: &mut [Wrench<f64>; SHARED],
        wrenches: impl Fn(&ContactBlock) -> &WrenchLanes,
    ) {
        let pairs = ws.contacts.by_pair(&self.infos);
        for (batch, info, contacts) in pairs.filter(|(_, info, _)| self.layout.shared(info.mate).is_some()) {
            let mut sum = on[info.mate];
            for (block, here) in batch.pieces(contacts) {
                let [y, z, moment] = wrenches(block);
                for lane in here.map(|lane| lane % WIDEST) {
                    sum.add(&Wrench { force: [y[lane], z[lane]], moment: moment[lane] });
                }
            }
            on[info.mate] = sum;
        }
    }

    /// Adds what all contacts do to the coordinates of a cage behind those of its motion, from the wrenches in their blocks.
    pub(super) fn add_on_modes(
        &self,
        ws: &Workspace,
        on: &mut [f64],
        wrenches: impl Fn(&ContactBlock) -> &WrenchLanes,
    ) {
        let Some(cage) = self.shared[CAGE].as_ref().filter(|_| !on.is_empty()) else { return };
        for (batch, _, contacts) in ws.contacts.by_pair(&self.infos).filter(|(_, info, _)| info.mate == CAGE)
        {
            for i in contacts {
                let (block, lane) = batch.at(i);
                let [y, z, _] = wrenches(block);
                let j = batch.sites[i].element;
                let [outwards, ahead] = ws.motions.pocket_frame(j).to_local([y[lane], z[lane]]);
                for (sum, [x, t]) in on.iter_mut().zip(cage.displacements(j)) {
                    *sum += outwards * x + ahead * t;
                }
            }
        }
    }

    /// Finds how the cage is deformed and where its pockets are.
    fn find_deformation(&self, ws: &mut Workspace) {
        let Workspace { motions, of_shared: [q, v, _], .. } = ws;
        if motions.displaced.is_empty() {
            return;
        }
        let at = self.layout.range(CAGE);
        for (modes, x) in motions.modes.iter_mut().zip([q, v]) {
            modes.copy_from_slice(&x[at.clone()][CAGE_MOTION..]);
        }
        let Some(cage) = &self.shared[CAGE] else { return };
        for (block, parts) in motions.displaced.iter_mut().enumerate() {
            for (part, amplitudes) in parts.iter_mut().zip(&motions.modes) {
                cage.displace(block, amplitudes, part, motions.instructions);
            }
        }
    }

    /// The laws that contacts of elements are counted by, each with its pair and the kind of contact.
    pub(super) fn laws_of_contacts(&self) -> impl Iterator<Item = (Law, [usize; 2])> {
        self.infos.iter().zip(&self.parts).enumerate().flat_map(|(pair, (info, parts))| {
            let own = info.laws.iter().flatten().enumerate().map(move |(kind, law)| (*law, [pair, kind]));
            // Edges have no film, nor what belongs to it.
            own.chain(parts.iter().map(move |law| (*law, [pair, 0])))
        })
    }

    /// Counts the evaluations of this pass; laws that the scene does not use cost nothing here.
    fn count(&self, ws: &mut Workspace) {
        for (sums, of_pair) in ws.touched.iter_mut().zip(&ws.contacts.counts) {
            for (sum, n) in sums.iter_mut().zip(of_pair) {
                *sum += n;
            }
        }
        let counts = &mut ws.counts;
        for ((pair, info), force) in self.between.iter().zip(&self.between_infos).zip(&ws.between) {
            for (law, acts) in info.laws.into_iter().zip(pair.acting(force)) {
                if let Some(law) = law {
                    counts[law as usize] += u64::from(acts);
                }
            }
        }
    }
}

/// Whether a shared body is within the bearing.
#[inline(always)]
fn within_reach(place: usize, body: &dyn SharedBody, shared: &[Motion<f64>; SHARED]) -> Result<(), Fault> {
    let ([y, z], [oy, oz]) = (shared[place].position, shared[OUTER_RING].position);
    let distance = if place == OUTER_RING { math::hypot(y, z) } else { math::hypot(y - oy, z - oz) };
    if distance > body.reach() { Err(body.lost(distance)) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sim;
    use crate::model::{HostInputs, Model};
    use pulp::Arch;
    use std::sync::Arc;

    /// Accelerations at a state with these instructions.
    fn accelerations(sim: &Sim, instructions: Arch) -> Vec<u64> {
        let model = sim.model();
        let (q, v) = sim.state().split_at(model.layout().positions());
        let mut ws = Workspace::new(model.plane().unwrap());
        ws.motions.instructions = instructions;
        let mut a = vec![0.0; v.len()];
        let inputs = model.inputs_at(sim.time(), &HostInputs::default());
        model.plane().unwrap().accelerations(&inputs, q, v, &mut ws, &mut a).unwrap();
        a.into_iter().map(f64::to_bits).collect()
    }

    #[test]
    fn all_instructions_give_the_same_bits() {
        for scene in ["nu2310", "nu2310_grease", "grease_guide"] {
            let path = format!("{}/scenes/{scene}.json", env!("CARGO_MANIFEST_DIR"));
            let model = Model::from_json(&std::fs::read_to_string(path).unwrap()).unwrap();
            let mut sim = Sim::new(Arc::new(model)).unwrap();
            for step in 1..=20 {
                sim.advance_to(0.5e-3 * f64::from(step)).unwrap();
                let portable = accelerations(&sim, Arch::Scalar);
                assert_eq!(portable, accelerations(&sim, Arch::new()), "{scene}");
                #[cfg(target_arch = "x86_64")]
                if let Some(v3) = pulp::x86::V3::try_new() {
                    assert_eq!(portable, accelerations(&sim, Arch::V3(v3)), "{scene}");
                }
            }
        }
    }
}
