//! Channels that are followed in every step, for their extremes and integrals between two records.
//!
//! With a semi-implicit step the forces are those that moved the bodies in it, also where damping pulls for a moment. That of
//! the guide is what is left of the momentum of the cage after all others.

use super::batch::{Batch, Mate};
use super::channels::{Channel, GuidePart, Source, along, radius};
use super::evaluate::{add, pocket_wrenches};
use super::workspace::{ElementSite, Workspace};
use super::{Input, Model};
use crate::contact::Wrench;
use crate::contact::guide::BodyMotion;
use crate::integrate::SemiImplicit;
use crate::laws::contact_pair::ContactForce;

/// What is followed.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Watch {
    /// Places of the channels among all.
    channels: Vec<usize>,
    /// Places among the watched channels of the forces of each element on outer ring, inner ring and cage.
    contacts: Vec<[Option<usize>; 3]>,
    /// Places of the others, and what they show.
    others: Vec<(usize, Source)>,
    /// Whether contacts with raceways, and their moments, matter.
    raceways: bool,
    torques: bool,
    guide: bool,
}

impl Watch {
    /// Of these places among all `channels` of a bearing with so many elements; all of them can be watched.
    pub(super) fn new(places: Vec<usize>, channels: &[Channel], elements: usize) -> Self {
        let mut watch = Self { contacts: vec![[None; 3]; elements], ..Self::default() };
        for (i, place) in places.iter().enumerate() {
            let source = channels[*place].source;
            match source {
                Source::OuterForce(j) => watch.contacts[j][0] = Some(i),
                Source::InnerForce(j) => watch.contacts[j][1] = Some(i),
                Source::PocketForce(j) => watch.contacts[j][2] = Some(i),
                _ => watch.others.push((i, source)),
            }
        }
        let any = |wanted: fn(&Source) -> bool| watch.others.iter().any(|(_, source)| wanted(source));
        let torques = any(|s| matches!(s, Source::DragTorque | Source::OuterRingTorque));
        let guide = torques || any(|s| matches!(s, Source::GuideY | Source::GuideZ | Source::GuideMoment));
        (watch.torques, watch.guide) = (torques, guide);
        watch.raceways = torques || watch.contacts.iter().any(|c| c[0].is_some() || c[1].is_some());
        watch.channels = places;
        watch
    }
}

impl Channel {
    /// Whether it is a force, or something else that may peak between two records and is known in every step.
    pub(super) fn can_be_watched(&self) -> bool {
        use Source as S;
        matches!(
            self.source,
            S::OuterForce(_)
                | S::InnerForce(_)
                | S::PocketForce(_)
                | S::PocketSum(_)
                | S::PocketMoment
                | S::GuideY
                | S::GuideZ
                | S::GuideMoment
                | S::Guide(..)
                | S::GuideFilm
                | S::DragTorque
                | S::OuterRingTorque
                | S::CageEccentricity
                | S::WhirlRadius
        )
    }
}

impl Model {
    /// Places of the watched channels among [`Model::channels`].
    pub fn watched(&self) -> &[usize] {
        &self.selection.watch.channels
    }

    /// Values of the watched channels at the last evaluated state (`q`, `v`) of `ws`, or in a step from there.
    pub(crate) fn watch(
        &self,
        q: &[f64],
        v: &[f64],
        step: Option<&SemiImplicit<'_>>,
        ws: &Workspace,
        out: &mut [f64],
    ) {
        out.fill(0.0);
        let direction = self.direction(&ws.inputs);
        let mut on_cage = Wrench::default();
        let mut on_rings = [0.0; 2];
        // Contacts with raceways come first.
        let first = if self.selection.watch.raceways { 0 } else { ws.on_raceways() };
        for (batch, first) in [(&ws.raceways, first), (&ws.pockets, 0)] {
            for (i, site) in batch.sites.iter().enumerate().skip(first) {
                let element = &ws.elements[site.element];
                let places = &self.selection.watch.contacts[site.element];
                let ring = match &site.mate {
                    Mate::Pocket(pocket) => {
                        let force = self.force_in_step(batch, i, v, step, &ws.elements);
                        let (on_element, reaction) = pocket_wrenches(&site.frame, &force, pocket, element);
                        if let Some(place) = places[2] {
                            out[place] -= direction * on_element.force[1];
                        }
                        add(&mut on_cage, reaction.force, reaction.moment);
                        continue;
                    }
                    Mate::Outer => 0,
                    Mate::Inner => 1,
                };
                let force = self.force_in_step(batch, i, v, step, &ws.elements);
                if let Some(place) = places[ring] {
                    out[place] = force.normal;
                }
                if self.selection.watch.torques {
                    on_rings[ring] += site.frame.wrenches(&force)[1].moment;
                }
            }
        }
        if self.selection.watch.others.is_empty() {
            return;
        }
        let [body, ring] = self.guide_bodies(q, v, &ws.inputs);
        let offset = [body.position[0] - ring.position[0], body.position[1] - ring.position[1]];
        let guide = if self.selection.watch.guide {
            self.guide_in_step(&body, step, &on_cage, ws)
        } else {
            Wrench::default()
        };
        if let Some(cage) = &self.cage {
            let moment = guide.moment + offset[0] * guide.force[1] - offset[1] * guide.force[0];
            on_rings[usize::from(cage.guided_by_inner_ring)] -= moment;
        }
        for (place, source) in &self.selection.watch.others {
            out[*place] = match source {
                Source::PocketSum(k) => along(offset, on_cage.force)[*k],
                Source::PocketMoment => on_cage.moment,
                Source::GuideY => guide.force[0],
                Source::GuideZ => guide.force[1],
                Source::GuideMoment => guide.moment,
                Source::DragTorque => -direction * on_rings[1],
                Source::OuterRingTorque => on_rings[0],
                Source::WhirlRadius => radius(offset),
                Source::CageEccentricity => self.guide_clearance().map_or(0.0, |c| radius(offset) / c),
                Source::GuideFilm => ws.guide.as_ref().map_or(0.0, |force| force.minimum_film),
                Source::Guide(part, k) => match (&self.cage, &ws.guide, &ws.journal) {
                    (Some(cage), Some(force), Some(motion)) => {
                        let force = cage.guide_side.on_cage(force, motion);
                        let part = match part {
                            GuidePart::Pressure => force.pressure,
                            GuidePart::Shear => force.shear,
                            GuidePart::Solid => force.solid,
                        };
                        along(offset, part)[*k]
                    }
                    _ => 0.0,
                },
                _ => 0.0,
            };
        }
    }

    /// Force of contact `i`, or what a semi-implicit step has made of it.
    #[inline]
    fn force_in_step(
        &self,
        batch: &Batch,
        i: usize,
        v: &[f64],
        step: Option<&SemiImplicit<'_>>,
        elements: &[ElementSite],
    ) -> ContactForce<f64> {
        let f = &batch.force;
        let secant = f.friction_secant[i];
        let changes = step.map(|step| self.step_changes(&batch.sites[i], secant, v, step, elements));
        let changes = changes.unwrap_or_default();
        ContactForce {
            normal: f.normal[i] + f.damping[i] * changes.approach_speed,
            friction: f.friction[i] - secant * changes.acting_slip,
            rolling_resistance: f.rolling_resistance[i],
            ..ContactForce::none(0.0)
        }
    }

    /// Force of the guide on the cage, moment about the centre of the cage, whose pockets push with `pockets`.
    fn guide_in_step(
        &self,
        body: &BodyMotion<f64>,
        step: Option<&SemiImplicit<'_>>,
        pockets: &Wrench<f64>,
        ws: &Workspace,
    ) -> Wrench<f64> {
        let (Some(cage), Some(c)) = (&self.cage, self.layout.cage) else { return Wrench::default() };
        let (Some(force), Some(motion)) = (&ws.guide, &ws.journal) else { return Wrench::default() };
        let Some(step) = step else { return cage.guide_side.wrenches(force, motion)[0] };
        let gained = |k: usize| 2.0 * (step.end[c + k] - step.mean[c + k]) / step.h;
        let turning = gained(2);
        let [uy, uz] = cage.mass_offset(body.angle).unwrap_or_default();
        let square = body.speed * body.speed;
        let mut force = [
            cage.mass * (gained(0) - self.gravity[0] - turning * uz - square * uy),
            cage.mass * (gained(1) - self.gravity[1] + turning * uy - square * uz),
        ];
        let mut moment = cage.inertia * turning + uy * force[1] - uz * force[0];
        if cage.loaded {
            let load = [Input::CageForceY, Input::CageForceZ, Input::CageTorque].map(|i| ws.inputs.of(i));
            force = [force[0] - load[0], force[1] - load[1]];
            moment -= load[2];
        }
        let [y, z] = pockets.force;
        Wrench { force: [force[0] - y, force[1] - z], moment: moment - pockets.moment }
    }
}
