//! Forces of a semi-implicit step, which differ from those of its evaluation.
//!
//! ```text
//! Q   = Q(v*) + c (delta_dot - delta_dot*)      mean over the step
//! F_T = F_T(v*) - s (u1 - u2 - (u1* - u2*))     at a share of its change, from the mean to the end
//! ```
//!
//! v* velocities of the evaluation, c normal damping, s secant slope of friction; by the motion of the rollers.

use super::batch::{Batch, Mate, Site};
use super::evaluate::{add, pocket_wrenches};
use super::workspace::{ElementSite, Workspace};
use super::{ElementKind, Model, RingBody};
use crate::contact::Wrench;
use crate::integrate::SemiImplicit;
use crate::laws::contact_pair::ContactForce;

/// Changes of the speeds of one contact, m/s: mean over the step, and slip at which friction acts.
#[derive(Default)]
pub(super) struct Changes {
    pub(super) approach_speed: f64,
    pub(super) slip: f64,
    pub(super) acting_slip: f64,
}

impl Model {
    /// Adds to the accelerations `a` of ring and cage what the forces on them have become in the step of the rollers, with
    /// the velocities `v` and the positions `q` of the last evaluation.
    ///
    /// The forces between a roller and its mates are the same on both of them in this way. With those of the evaluation on
    /// the mates, a ring under a heavy load swings against its rollers from step to step.
    pub(crate) fn react(&self, q: &[f64], v: &[f64], step: &SemiImplicit<'_>, ws: &Workspace, a: &mut [f64]) {
        let mut on_ring = [0.0; 2];
        let mut on_cage = Wrench::default();
        for Batch { sites, force, .. } in [&ws.raceways, &ws.pockets] {
            for (i, site) in sites.iter().enumerate() {
                let element = &ws.elements[site.element];
                if let Mate::Outer = site.mate {
                    continue;
                }
                let changes = self.step_changes(site, force.friction_secant[i], v, step, &ws.elements);
                let change = ContactForce {
                    normal: force.damping[i] * changes.approach_speed,
                    friction: -force.friction_secant[i] * changes.acting_slip,
                    ..ContactForce::none(0.0)
                };
                if let Mate::Pocket(pocket) = &site.mate {
                    let (_, reaction) = pocket_wrenches(&site.frame, &change, pocket, element);
                    add(&mut on_cage, reaction.force, reaction.moment);
                } else {
                    let [_, reaction] = site.frame.wrenches(&change);
                    let [y, z] = element.to_global(reaction.force);
                    on_ring = [on_ring[0] + y, on_ring[1] + z];
                }
            }
        }
        if let (RingBody::Free { mass, .. }, Some(i)) = (self.ring, self.layout.ring) {
            a[i] += on_ring[0] / mass;
            a[i + 1] += on_ring[1] / mass;
        }
        if let (Some(cage), Some(c)) = (&self.cage, self.layout.cage) {
            for (a, change) in a[c..].iter_mut().zip(cage.response(&on_cage, cage.mass_offset(q[c + 2]))) {
                *a += change;
            }
        }
    }

    /// Makes the forces at the last evaluated state, whose velocities are `v`, those of a semi-implicit step from there; zero
    /// where damping would make a contact pull, which the step itself lets it do.
    pub(crate) fn apply_step(&self, v: &[f64], step: &SemiImplicit<'_>, ws: &mut Workspace) {
        let Workspace { raceways, pockets, elements, .. } = ws;
        for Batch { sites, force, .. } in [raceways, pockets] {
            for (i, site) in sites.iter().enumerate() {
                let changes = self.step_changes(site, force.friction_secant[i], v, step, elements);
                force.normal[i] = (force.normal[i] + force.damping[i] * changes.approach_speed).max(0.0);
                force.friction[i] -= force.friction_secant[i] * changes.acting_slip;
            }
        }
    }

    /// How the speeds of a contact whose friction has the slope `secant` change from the evaluated velocities `v` to those of
    /// the step, by the motion of its roller.
    #[inline]
    pub(super) fn step_changes(
        &self,
        site: &Site,
        secant: f64,
        v: &[f64],
        step: &SemiImplicit<'_>,
        elements: &[ElementSite],
    ) -> Changes {
        let ElementKind::Rollers(rollers) = &self.elements.kind else { return Changes::default() };
        let element = &elements[site.element];
        let [nr, nc] = element.normal(site);
        let (j, spin) = (self.layout.roller(site.element), self.layout.spin(site.element));
        let r = rollers.geometry.pitch_radius + element.motion.radial_offset;
        let change = |to: &[f64]| [to[j] - v[j], r * (to[j + 1] - v[j + 1]), to[spin] - v[spin]];
        let slip = |[radial, across, turning]: [f64; 3]| {
            nr * across - nc * radial + rollers.geometry.roller_radius * turning
        };
        let mean = change(step.mean);
        let [mean_slip, end_slip] = [slip(mean), slip(change(step.end))];
        let beyond = 2.0 * rollers.friction_share(step.h, secant) - 1.0;
        Changes {
            approach_speed: nr * mean[0] + nc * mean[1],
            slip: mean_slip,
            acting_slip: mean_slip + beyond * (end_slip - mean_slip),
        }
    }
}
