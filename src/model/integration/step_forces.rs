//! Forces of a semi-implicit step, which differ from those of its evaluation.
//!
//! ```text
//! Q   = Q(v*) + c (delta_dot - delta_dot*)      mean over the step
//! F_T = F_T(v*) - s (u1 - u2 - (u1* - u2*))     at a share of its change, from the mean to the end
//! ```
//!
//! v* velocities of the evaluation, c normal damping, s secant slope of friction; by the motion of the elements.

use super::step_changes::{Changes, StepChanges};
use crate::bodies::{OF_ELEMENT, SHARED};
use crate::integrate::{SemiImplicit, implicit_share};
use crate::laws::contact_pair::ContactForce;
use crate::model::Model;
use crate::model::workspace::Workspace;
use crate::pairs::Batch;
use crate::space::Wrench;

impl Model {
    /// Adds to the accelerations `a` of the shared bodies what the forces on them have become in the step of the elements.
    ///
    /// The forces between an element and its mates are the same on both of them in this way. With those of the evaluation on
    /// the mates, a ring under a heavy load swings against its rollers from step to step.
    pub(crate) fn react(&self, v: &[f64], step: &SemiImplicit<'_>, ws: &mut Workspace, a: &mut [f64]) {
        self.find_changes(v, Some(step), ws);
        let mut on = [Wrench::default(); SHARED];
        for (batch, of_batch) in ws.contacts.batches.iter().zip(&ws.changes.of_batches) {
            for ((site, [damping, secant]), changes) in batch.damping().zip(of_batch) {
                if self.layout.shared(site.mate).is_none() {
                    continue;
                }
                let change = ContactForce {
                    normal: damping * changes.approach_speed,
                    friction: -secant * changes.acting_slip,
                    ..ContactForce::none(0.0)
                };
                let [_, on_mate] = site.grip.wrenches(&change);
                let force = ws.motions.frame(site.element).to_global(on_mate.force);
                on[site.mate].add(&Wrench { force, ..on_mate });
            }
        }
        for (place, body, at) in self.free_bodies() {
            let [q, _, change] = &mut ws.of_shared;
            let change = &mut change[at.clone()];
            change.fill(0.0);
            change.iter_mut().zip(on[place].components()).for_each(|(change, on_body)| *change = on_body);
            body.respond(change, &q[at.clone()]);
            a[at].iter_mut().zip(change).for_each(|(a, change)| *a += *change);
        }
    }

    /// Makes the forces at the last evaluated state, whose velocities are `v`, those of a semi-implicit step from there; zero
    /// where damping would make a contact pull, which the step itself lets it do.
    pub(crate) fn apply_step(&self, v: &[f64], step: &SemiImplicit<'_>, ws: &mut Workspace) {
        self.find_changes(v, Some(step), ws);
        for (batch, of_batch) in ws.contacts.batches.iter_mut().zip(&ws.changes.of_batches) {
            let force = &mut batch.force;
            for (i, changes) in of_batch.iter().enumerate() {
                force.normal[i] = (force.normal[i] + force.damping[i] * changes.approach_speed).max(0.0);
                force.friction[i] -= force.friction_secant[i] * changes.acting_slip;
            }
        }
    }

    /// Finds the shares of the change of slip at which friction acts in a step of size `h` (s), unless they are known.
    pub(in crate::model) fn find_shares(&self, h: f64, ws: &mut Workspace) {
        if ws.changes.h == h {
            return;
        }
        ws.changes.h = h;
        for (batch, shares) in ws.contacts.batches.iter().zip(&mut ws.changes.shares) {
            let secants = &batch.force.friction_secant[..batch.len()];
            shares.clear();
            shares.extend(secants.iter().map(|secant| implicit_share(h * secant * self.mobility)));
        }
    }

    /// Finds the changes in the step by the motion of the elements, if there is one and they are not known yet.
    pub(in crate::model) fn find_changes(
        &self,
        v: &[f64],
        step: Option<&SemiImplicit<'_>>,
        ws: &mut Workspace,
    ) {
        let Some(step) = step.filter(|_| !ws.changes.found && self.layout.count > 0) else { return };
        self.find_shares(step.h, ws);
        let Workspace { contacts, motions, changes, .. } = ws;
        let StepChanges { of_elements, of_batches, shares, found, .. } = changes;
        *found = true;
        for (j, out) in of_elements.iter_mut().enumerate() {
            let ([a, b, c], element) = (self.layout.of_element(j), motions.element(j));
            let change = |to: &[f64]| element.local_speeds([to[a] - v[a], to[b] - v[b], to[c] - v[c]]);
            *out = [change(step.mean), change(step.end)];
        }
        for ((batch, shares), out) in contacts.batches.iter().zip(shares).zip(of_batches) {
            out.clear();
            for (site, share) in batch.sites.iter().zip(shares) {
                let [mean, end] = &of_elements[site.element];
                let [nr, nc] = site.grip.normal_on_element();
                let (mean_slip, end_slip) =
                    (slip([nr, nc], site.grip.arm, mean), slip([nr, nc], site.grip.arm, end));
                let beyond = 2.0 * *share - 1.0;
                out.push(Changes {
                    approach_speed: nr * mean[0] + nc * mean[1],
                    slip: mean_slip,
                    acting_slip: mean_slip + beyond * (end_slip - mean_slip),
                });
            }
        }
    }
}

/// Speed of the contact point along the tangent, m/s.
#[inline(always)]
fn slip([nr, nc]: [f64; 2], arm: f64, [radial, across, turning]: &[f64; OF_ELEMENT]) -> f64 {
    nr * across - nc * radial + arm * turning
}

/// Force of contact `i` of a batch, or what a semi-implicit step has made of it by these changes.
#[inline]
pub(in crate::model) fn force_in_step(batch: &Batch, i: usize, changes: &Changes) -> ContactForce<f64> {
    let f = &batch.force;
    ContactForce {
        normal: f.normal[i] + f.damping[i] * changes.approach_speed,
        friction: f.friction[i] - f.friction_secant[i] * changes.acting_slip,
        rolling_resistance: f.rolling_resistance[i],
        ..ContactForce::none(0.0)
    }
}
