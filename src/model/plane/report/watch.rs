//! Channels that are followed in every step, for their extremes and integrals between two records.
//!
//! With a semi-implicit step the forces are those that moved the bodies in it, also where damping pulls for a moment. That of
//! the guide is what is left of the momentum of the cage after all others.

use super::channels::{GuidePart, Source};
use super::reading::{along, radius};
use crate::bodies::{CAGE, ForceSource, INNER_RING, OUTER_RING, SHARED};
use crate::integrate::SemiImplicit;
use crate::model::Channel;
use crate::model::plane::Plane;
use crate::model::plane::Workspace;
use crate::pairs::{ContactBlock, NEIGHBOUR, PairInfo};
use crate::space::Wrench;

/// What is followed.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::model::plane) struct Watch {
    /// Places among the watched channels of the force of every pair on every element: pairs, then elements.
    contacts: Vec<Vec<Option<usize>>>,
    /// Places of the others, and what they show.
    others: Vec<(usize, Source)>,
    /// Whether contacts with raceways, and their moments, matter.
    raceways: bool,
    torques: bool,
    guide: bool,
}

impl Watch {
    /// Of these places among all `channels` of a bearing with these pairs and so many elements; all of them can be watched.
    pub(in crate::model::plane) fn new(
        places: &[usize],
        channels: &[Channel],
        pairs: &[&'static PairInfo],
        elements: usize,
    ) -> Self {
        let mut watch = Self { contacts: vec![vec![None; elements]; pairs.len()], ..Self::default() };
        for (i, place) in places.iter().enumerate() {
            let crate::model::Source::Plane(source) = channels[*place].source else { continue };
            let of_element = match source {
                Source::OuterForce(j) => Some((ForceSource::OuterRaceway, j)),
                Source::InnerForce(j) => Some((ForceSource::InnerRaceway, j)),
                Source::PocketForce(j) => Some((ForceSource::Pocket, j)),
                _ => None,
            };
            match of_element {
                None => watch.others.push((i, source)),
                Some((source, j)) => {
                    for (pair, _) in pairs.iter().enumerate().filter(|(_, info)| info.source == source) {
                        watch.contacts[pair][j] = Some(i);
                        watch.raceways |= source != ForceSource::Pocket;
                    }
                }
            }
        }
        let any = |wanted: fn(&Source) -> bool| watch.others.iter().any(|(_, source)| wanted(source));
        let torques =
            any(|s| matches!(s, Source::DragTorque | Source::OuterRingTorque | Source::OuterDragTorque));
        let guide = torques || any(|s| matches!(s, Source::GuideY | Source::GuideZ | Source::GuideMoment));
        (watch.torques, watch.guide) = (torques, guide);
        watch.raceways |= torques;
        watch
    }
}

impl Plane {
    /// Values of the watched channels at the last evaluated state of `ws`, whose velocities are `v`, or in a step from there.
    pub(crate) fn watch(
        &self,
        v: &[f64],
        step: Option<&SemiImplicit<'_>>,
        ws: &mut Workspace,
        out: &mut [f64],
    ) {
        out.fill(0.0);
        self.find_step(v, step, ws);
        let ws = &*ws;
        let watch = &self.watch;
        let (direction, motions) = (self.direction(&ws.inputs), &ws.motions);
        let mut on = [Wrench::default(); SHARED];
        for (pair, (batch, info, contacts)) in ws.contacts.by_pair(&self.infos).enumerate() {
            let on_cage = info.mate == CAGE;
            if info.mate == NEIGHBOUR || !on_cage && !watch.raceways {
                continue;
            }
            for i in contacts {
                let (ContactBlock { step, .. }, lane) = batch.at(i);
                let element = batch.sites[i].element;
                let place = watch.contacts[pair][element];
                if on_cage {
                    let [on_element, on_mate] = batch.grip(i).wrenches(&batch.force_in_step(i));
                    if let Some(place) = place {
                        out[place] -= direction * on_element.force[1];
                    }
                    let force = motions.frame(element).to_global(on_mate.force);
                    on[CAGE].add(&Wrench { force, ..on_mate });
                } else {
                    if let Some(place) = place {
                        out[place] = step.normal[lane];
                    }
                    if watch.torques {
                        on[info.mate].moment += step.moment_on_mate[lane];
                    }
                }
            }
        }
        if watch.others.is_empty() {
            return;
        }
        let guiding = self.guiding_ring();
        let [body, ring] = [&motions.shared[CAGE], &motions.shared[guiding]];
        let offset = [body.position[0] - ring.position[0], body.position[1] - ring.position[1]];
        let guide = if watch.guide { self.guide_in_step(step, &on[CAGE], ws) } else { Wrench::default() };
        let on_cage = on[CAGE];
        on[guiding].moment -= guide.moment + offset[0] * guide.force[1] - offset[1] * guide.force[0];
        for (place, source) in &self.watch.others {
            out[*place] = match source {
                Source::PocketSum(k) => along(offset, on_cage.force)[*k],
                Source::PocketMoment => on_cage.moment,
                Source::GuideY => guide.force[0],
                Source::GuideZ => guide.force[1],
                Source::GuideMoment => guide.moment,
                Source::DragTorque => -self.turning_of(INNER_RING, &ws.inputs) * on[INNER_RING].moment,
                Source::OuterDragTorque => -self.turning_of(OUTER_RING, &ws.inputs) * on[OUTER_RING].moment,
                Source::OuterRingTorque => on[OUTER_RING].moment,
                Source::WhirlRadius => radius(offset),
                Source::CageEccentricity => self.guide_clearance().map_or(0.0, |c| radius(offset) / c),
                Source::GuideFilm => self.smallest_gap(ws),
                Source::Guide(part, k) => self.force_of_guide(ws).map_or(0.0, |force| {
                    let part = match part {
                        GuidePart::Pressure => force.pressure,
                        GuidePart::Shear => force.shear,
                        GuidePart::Solid => force.solid,
                    };
                    along(offset, part)[*k]
                }),
                _ => 0.0,
            };
        }
    }

    /// Force of the guide on the cage, moment about the centre of the cage, whose pockets push with `pockets`.
    fn guide_in_step(
        &self,
        step: Option<&SemiImplicit<'_>>,
        pockets: &Wrench<f64>,
        ws: &Workspace,
    ) -> Wrench<f64> {
        let (Some(cage), Some(c)) = (&self.shared[CAGE], self.layout.cage()) else {
            return Wrench::default();
        };
        let Some(force) = self.guide().and_then(|(place, _)| ws.between.get(place)) else {
            return Wrench::default();
        };
        let Some(step) = step else { return force.on[0] };
        let gained = |k: usize| 2.0 * (step.end[c + k] - step.mean[c + k]) / step.h;
        let state = ws.body(CAGE, self.layout.range(CAGE));
        let all = cage.wrench_for(&gained, &state, self.gravity);
        let mut other = Wrench::default();
        cage.add_external(&state, &ws.inputs, &mut other);
        other.add(pockets);
        Wrench {
            force: [all.force[0] - other.force[0], all.force[1] - other.force[1]],
            moment: all.moment - other.moment,
        }
    }
}
