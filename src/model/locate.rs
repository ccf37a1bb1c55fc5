//! First pass of a force evaluation: find the contacts that touch and write their motions into one list per law.
//!
//! A contact that is apart costs its distance check.

use super::batch::{Batch, Mate, PocketSite, Site};
use super::laws::PocketLaws;
use super::places::Surroundings;
use super::workspace::{ElementSite, Workspace};
use super::{ElementKind, Fault, Input, Model, RollerSet};
use crate::contact::pocket::{Pillar, PillarContact, PocketMotion, PocketPlace};
use crate::contact::raceway::{RingMotion, RollerMotion};
use crate::contact::rotate;
use crate::scalar::math;

/// A roller this far from the pitch circle, in pitch radii, has left the bearing.
const LOST_ROLLER: f64 = 0.25;
/// An element this far round from its pocket, in radii of its own, is out of it.
const OUT_OF_POCKET: f64 = 1.0;
/// A ring or cage this far from the centre, in pitch radii, has left the bearing.
const LOST_BODY: f64 = 1.0;

impl Model {
    /// Fills the sites of the elements and the lists of touching contacts.
    pub(super) fn locate(&self, q: &[f64], v: &[f64], ws: &mut Workspace) -> Result<(), Fault> {
        let laws = &self.laws;
        ws.clear();
        let reach = LOST_BODY * self.elements.pitch_radius;
        if self.layout.cage.is_some_and(|c| math::hypot(q[c], q[c + 1]) > reach) {
            return Err(Fault::LostCage);
        }
        let pockets = laws.pocket.as_ref().map(PocketLaws::place);
        match &self.elements.kind {
            ElementKind::Rollers(rollers) => self.locate_rollers(rollers, pockets, q, v, ws)?,
            ElementKind::Kinematic => {
                if let Some(place) = pockets {
                    self.place_elements(place, q, ws)?;
                }
            }
        }
        match &laws.pocket {
            None => {}
            Some(PocketLaws::Cylinder(pocket)) => {
                let shape = pocket.shape;
                self.locate_pockets(
                    shape.place,
                    v,
                    ws,
                    |offset| shape.apart(offset),
                    |ws, j, m| {
                        for side in [Pillar::Front, Pillar::Back] {
                            if let Some(contact) = shape.pillar(side, m) {
                                push(ws.pocket_batch(), j, side, shape.place, m, contact);
                            }
                        }
                    },
                );
            }
            Some(PocketLaws::Plane(pocket)) => {
                let shape = pocket.shape;
                self.locate_pockets(
                    shape.place,
                    v,
                    ws,
                    |offset| shape.apart(offset),
                    |ws, j, m| {
                        for side in [Pillar::Front, Pillar::Back] {
                            if let Some(contact) = shape.wall(side, m) {
                                push(ws.pocket_batch(), j, side, shape.place, m, contact);
                            }
                        }
                    },
                );
            }
        }
        Ok(())
    }

    fn locate_rollers(
        &self,
        rollers: &RollerSet,
        pockets: Option<PocketPlace>,
        q: &[f64],
        v: &[f64],
        ws: &mut Workspace,
    ) -> Result<(), Fault> {
        let geometry = &rollers.geometry;
        let (ring_position, ring_velocity) = self.ring_motion(q, v);
        let ring_speed = ws.inputs.of(Input::RingSpeed);
        if math::hypot(ring_position[0], ring_position[1]) > LOST_BODY * geometry.pitch_radius {
            return Err(Fault::LostRing);
        }
        let n = self.layout.count;
        let largest_lead = match pockets {
            Some(place) => OUT_OF_POCKET * place.element_radius / place.pitch_radius,
            None => f64::INFINITY,
        };
        let angles = (ws.places.azimuth.iter_mut(), ws.places.lead.iter_mut());
        let columns = ws.places.radial_offset.iter_mut().zip(angles.0).zip(angles.1);
        let cage_angle = self.layout.cage.map_or(0.0, |c| q[c + 2]);
        let states = q[self.layout.rollers..].chunks_exact(2).zip(&self.elements.reference_angles);
        for (j, (((radial_offset, azimuth), lead), (state, reference))) in columns.zip(states).enumerate() {
            (*radial_offset, *azimuth, *lead) = (state[0], reference + state[1], state[1] - cage_angle);
            if state[0].abs() > LOST_ROLLER * geometry.pitch_radius {
                return Err(Fault::LostRoller { roller: j, radial_offset: state[0] });
            }
            if lead.abs() > largest_lead {
                return Err(Fault::OutOfPocket { element: j, lead: *lead });
            }
        }
        let pockets = pockets.and_then(|place| self.layout.cage.map(|c| (place, [q[c], q[c + 1]])));
        let around = Surroundings { raceways: (geometry, ring_position), pockets };
        ws.places.find(n, around, ws.instructions);

        for j in 0..n {
            let i = self.layout.roller(j);
            let motion = RollerMotion {
                radial_offset: q[i],
                radial_speed: v[i],
                orbit_speed: v[i + 1],
                spin_speed: v[self.layout.spin(j)],
            };
            if touching(motion.radial_offset - geometry.gap) {
                let (contact, frame) = geometry.outer(&motion);
                ws.raceways.push(Site { element: j, frame, mate: Mate::Outer }, &contact);
            }
            ws.elements[j] = ws.places.site(j, motion);
        }
        for j in 0..n {
            if touching(ws.places.inner_approach[j]) {
                let site = &ws.elements[j];
                let (position, velocity) = (site.to_local(ring_position), site.to_local(ring_velocity));
                let ring = RingMotion { position, velocity, speed: ring_speed };
                let (contact, frame) = geometry.inner(&site.motion, &ring);
                ws.raceways.push(Site { element: j, frame, mate: Mate::Inner }, &contact);
            }
        }
        Ok(())
    }

    /// Sites of kinematic elements. All lead their pockets by the same angle.
    fn place_elements(&self, place: PocketPlace, q: &[f64], ws: &mut Workspace) -> Result<(), Fault> {
        let motion = RollerMotion {
            radial_offset: 0.0,
            radial_speed: 0.0,
            orbit_speed: ws.inputs.of(Input::OrbitSpeed),
            spin_speed: ws.inputs.of(Input::SpinSpeed),
        };
        let travel = ws.inputs.orbit_travel;
        let (cage, angle) = self.layout.cage.map_or(([0.0; 2], 0.0), |c| ([q[c], q[c + 1]], q[c + 2]));
        let largest_lead = OUT_OF_POCKET * place.element_radius / place.pitch_radius;
        if self.layout.cage.is_some() && (travel - angle).abs() > largest_lead {
            return Err(Fault::OutOfPocket { element: 0, lead: travel - angle });
        }
        let lead = math::sin_cos(travel - angle);
        let (sin, cos) = math::sin_cos(travel);
        for (placed, direction) in ws.elements.iter_mut().zip(&self.elements.directions) {
            let [cos, sin] = rotate(*direction, sin, cos);
            let mut site = ElementSite { motion, sin, cos, lead, pocket_offset: [0.0; 2] };
            site.pocket_offset = place.offset(0.0, lead, rotate(site.to_local(cage), lead.0, lead.1));
            *placed = site;
        }
        Ok(())
    }

    /// Runs over the pockets and hands the elements that can touch them to `touch`.
    fn locate_pockets(
        &self,
        place: PocketPlace,
        v: &[f64],
        ws: &mut Workspace,
        apart: impl Fn([f64; 2]) -> bool,
        touch: impl Fn(&mut Workspace, usize, &PocketMotion<f64>),
    ) {
        let Some(c) = self.layout.cage else { return };
        for j in 0..ws.elements.len() {
            let site = &ws.elements[j];
            let (lead, offset) = (site.lead, site.pocket_offset);
            if apart(offset) {
                continue;
            }
            let velocity = rotate(site.to_local([v[c], v[c + 1]]), lead.0, lead.1);
            let relative = place.relative_motion(offset, &site.motion, lead, velocity, v[c + 2]);
            touch(ws, j, &relative);
        }
    }
}

#[inline(always)]
fn push(
    batch: &mut Batch,
    element: usize,
    pillar: Pillar,
    place: PocketPlace,
    relative: &PocketMotion<f64>,
    contact: PillarContact<f64>,
) {
    let PillarContact { motion, frame, edge_share } = contact;
    let lever = place.lever(relative.offset, frame.normal);
    let mate = Mate::Pocket(PocketSite { pillar, edge_share, lever });
    batch.push(Site { element, frame, mate }, &motion);
}

/// A NaN approach counts as contact, so that it reaches the accelerations and is reported.
#[inline]
fn touching(approach: f64) -> bool {
    approach > 0.0 || approach.is_nan()
}
