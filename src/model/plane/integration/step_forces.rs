//! Forces of a semi-implicit step, which differ from those of its evaluation: of all contacts by `pairs/contacts/step`, found
//! once for all that ask.

use crate::bodies::{CAGE, CAGE_MOTION, ElementBlock, OF_ELEMENT, SHARED};
use crate::integrate::SemiImplicit;
use crate::model::plane::Plane;
use crate::model::plane::workspace::{StepMemory, Workspace};
use crate::pairs::ContactBlock;
use crate::scalar::{WIDEST, ZEROS};
use crate::space::Wrench;

impl Plane {
    /// Adds to the accelerations `a` of the shared bodies what the forces on them have become in the step of the elements.
    ///
    /// The forces between an element and its mates are the same on both of them in this way. With those of the evaluation on
    /// the mates, a ring under a heavy load swings against its rollers from step to step.
    pub(crate) fn react(&self, v: &[f64], step: &SemiImplicit<'_>, ws: &mut Workspace, a: &mut [f64]) {
        self.find_step(v, Some(step), ws);
        let mut on = [Wrench::default(); SHARED];
        self.add_on_mates(ws, &mut on, |block| &block.step.reaction);
        let mut on_modes = std::mem::take(&mut ws.step.on_modes);
        on_modes.fill(0.0);
        self.add_on_modes(ws, &mut on_modes, |block| &block.step.reaction);
        for (place, body, at) in self.free_bodies() {
            let [q, _, change] = &mut ws.of_shared;
            let change = &mut change[at.clone()];
            change.fill(0.0);
            change.iter_mut().zip(on[place].components()).for_each(|(change, on_body)| *change = on_body);
            if place == CAGE {
                change.iter_mut().skip(CAGE_MOTION).zip(&on_modes).for_each(|(change, on)| *change = *on);
            }
            body.respond(change, &q[at.clone()]);
            a[at].iter_mut().zip(change).for_each(|(a, change)| *a += *change);
        }
        ws.step.on_modes = on_modes;
    }

    /// Makes the forces at the last evaluated state, whose velocities are `v`, those of a semi-implicit step from there; zero
    /// where damping would make a contact pull, which the step itself lets it do.
    pub(crate) fn apply_step(&self, v: &[f64], step: &SemiImplicit<'_>, ws: &mut Workspace) {
        self.find_step(v, Some(step), ws);
        for batch in &mut ws.contacts.batches {
            for ContactBlock { force, step, .. } in &mut batch.blocks {
                for (force, acting) in force.normal.iter_mut().zip(&step.normal) {
                    *force = acting.max(0.0);
                }
                force.friction = step.friction;
            }
        }
    }

    /// Finds the forces and powers of all contacts in a step from the last evaluated state, whose velocities are `v`, or at that
    /// state, unless they are known. Steps of elements whose motion is prescribed change nothing.
    pub(in crate::model::plane) fn find_step(
        &self,
        v: &[f64],
        step: Option<&SemiImplicit<'_>>,
        ws: &mut Workspace,
    ) {
        let step = step.filter(|_| self.layout.count > 0);
        let wanted = step.map_or(0.0, |step| step.h);
        let Workspace { contacts, motions, step: StepMemory { of_elements, found, .. }, .. } = ws;
        if *found == Some(wanted) {
            return;
        }
        *found = Some(wanted);
        if let Some(step) = step {
            let blocks = of_elements.iter_mut().zip(&motions.blocks).enumerate();
            for (at, (changes, ElementBlock { motion, .. })) in blocks {
                let [mut from, mut rates] = [[ZEROS; OF_ELEMENT]; 2];
                self.layout.rates_of_block(v, at, from.each_mut());
                for (change, to) in changes.iter_mut().zip([step.mean, step.end]) {
                    self.layout.rates_of_block(to, at, rates.each_mut());
                    for i in 0..WIDEST {
                        let radius = self.pitch_radius() + motion.radial_offset[i];
                        change[0][i] = rates[0][i] - from[0][i];
                        change[1][i] = radius * (rates[1][i] - from[1][i]);
                        change[2][i] = rates[2][i] - from[2][i];
                    }
                }
            }
        }
        let of_elements = of_elements.as_slice();
        for batch in &mut contacts.batches {
            let changes = step.map(|step| (of_elements, step.h));
            batch.find_step(changes, self.mobility, &self.laws, motions.instructions);
        }
    }
}
