//! First pass of a force evaluation: find the contacts that touch and write their motions into one list per law.
//!
//! A contact that is apart costs its distance check.

use super::laws::PocketLaws;
use super::workspace::{Batch, ElementSite, PocketSite, Workspace};
use super::{ElementKind, Fault, Input, KinematicSet, Model, RollerSet};
use crate::contact::pocket::{CageMotion, Pillar, PillarContact, PocketMotion, PocketPlace};
use crate::contact::raceway::{RingMotion, RollerMotion};
use crate::contact::rotate;

/// A roller this far from the pitch circle, in pitch radii, has left the bearing.
const LOST_ROLLER: f64 = 0.25;
/// A ring or cage this far from the centre, in pitch radii, has left the bearing.
const LOST_BODY: f64 = 1.0;

impl Model {
    /// Fills the sites of the elements and the lists of touching contacts.
    pub(super) fn locate(&self, q: &[f64], v: &[f64], ws: &mut Workspace) -> Result<(), Fault> {
        let laws = &self.laws;
        ws.clear();
        let reach = LOST_BODY * self.elements.pitch_radius;
        if self.layout.cage.is_some_and(|c| q[c].hypot(q[c + 1]) > reach) {
            return Err(Fault::LostCage);
        }
        match &self.elements.kind {
            ElementKind::Rollers(rollers) => self.locate_rollers(rollers, laws.pocket.is_some(), q, v, ws)?,
            ElementKind::Kinematic(elements) if laws.pocket.is_some() => self.place_elements(elements, q, ws),
            ElementKind::Kinematic(_) => {}
        }
        match &laws.pocket {
            None => {}
            Some(PocketLaws::Cylinder(pocket)) => {
                let shape = pocket.shape;
                self.locate_pockets(
                    shape.place,
                    q,
                    v,
                    ws,
                    |offset| shape.apart(offset),
                    |ws, j, m| {
                        for side in [Pillar::Front, Pillar::Back] {
                            if let Some(contact) = shape.pillar(side, m) {
                                let edge = contact.edge_share >= 1.0;
                                let batch = if edge { &mut ws.edge } else { &mut ws.wall };
                                push(batch, j, side, shape.place, m, contact);
                            }
                        }
                    },
                );
            }
            Some(PocketLaws::Plane(pocket)) => {
                let shape = pocket.shape;
                self.locate_pockets(
                    shape.place,
                    q,
                    v,
                    ws,
                    |offset| shape.apart(offset),
                    |ws, j, m| {
                        for side in [Pillar::Front, Pillar::Back] {
                            if let Some(contact) = shape.wall(side, m) {
                                push(&mut ws.plane, j, side, shape.place, m, contact);
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
        pockets: bool,
        q: &[f64],
        v: &[f64],
        ws: &mut Workspace,
    ) -> Result<(), Fault> {
        let geometry = &rollers.geometry;
        let (ring_position, ring_velocity) = self.ring_motion(q, v);
        let ring_speed = ws.inputs.of(Input::RingSpeed);
        if ring_position[0].hypot(ring_position[1]) > LOST_BODY * geometry.pitch_radius {
            return Err(Fault::LostRing);
        }
        self.turn(pockets, q, ws);
        for j in 0..self.layout.count {
            let i = self.layout.roller(j);
            let motion = RollerMotion {
                radial_offset: q[i],
                radial_speed: v[i],
                orbit_speed: v[i + 1],
                spin_speed: v[self.layout.spin(j)],
            };
            if motion.radial_offset.abs() > LOST_ROLLER * geometry.pitch_radius {
                return Err(Fault::LostRoller { roller: j, radial_offset: motion.radial_offset });
            }
            let (sin, cos) = ws.azimuths.direction(j);
            let lead = ws.leads.direction(j);
            let site = ElementSite { motion, sin, cos, lead, pocket_offset: [0.0; 2] };

            if touching(motion.radial_offset - geometry.gap) {
                let (contact, frame) = geometry.outer(&motion);
                ws.outer.push(j, contact, frame, ());
            }
            let position = site.to_local(ring_position);
            if touching(geometry.inner_approach(motion.radial_offset, position)) {
                let velocity = site.to_local(ring_velocity);
                let ring = RingMotion { position, velocity, speed: ring_speed };
                let (contact, frame) = geometry.inner(&motion, &ring);
                ws.inner.push(j, contact, frame, ());
            }
            ws.elements.push(site);
        }
        Ok(())
    }

    /// Directions of the rollers and their leads over the pockets.
    fn turn(&self, pockets: bool, q: &[f64], ws: &mut Workspace) {
        let n = self.layout.count;
        let travel = |j: usize| q[self.layout.roller(j) + 1];
        for (j, (angle, reference)) in
            ws.azimuths.angle.iter_mut().zip(&self.elements.reference_angles).enumerate()
        {
            *angle = reference + travel(j);
        }
        ws.azimuths.turn(n, ws.instructions);
        if let (Some(c), true) = (self.layout.cage, pockets) {
            for (j, angle) in ws.leads.angle.iter_mut().enumerate().take(n) {
                *angle = travel(j) - q[c + 2];
            }
            ws.leads.turn(n, ws.instructions);
        }
    }

    /// Sites of kinematic elements. All lead their pockets by the same angle.
    fn place_elements(&self, elements: &KinematicSet, q: &[f64], ws: &mut Workspace) {
        let motion = RollerMotion {
            radial_offset: 0.0,
            radial_speed: 0.0,
            orbit_speed: ws.inputs.of(Input::OrbitSpeed),
            spin_speed: ws.inputs.of(Input::SpinSpeed),
        };
        let travel = ws.inputs.orbit_travel;
        let lead = (travel - self.layout.cage.map_or(0.0, |c| q[c + 2])).sin_cos();
        let (sin, cos) = travel.sin_cos();
        for direction in &elements.directions {
            let [cos, sin] = rotate(*direction, sin, cos);
            ws.elements.push(ElementSite { motion, sin, cos, lead, pocket_offset: [0.0; 2] });
        }
    }

    /// Runs over the pockets: notes the offset of every element and hands those that can touch to `touch`.
    fn locate_pockets(
        &self,
        place: PocketPlace,
        q: &[f64],
        v: &[f64],
        ws: &mut Workspace,
        apart: impl Fn([f64; 2]) -> bool,
        touch: impl Fn(&mut Workspace, usize, &PocketMotion<f64>),
    ) {
        let Some(c) = self.layout.cage else { return };
        for j in 0..ws.elements.len() {
            let site = &mut ws.elements[j];
            let lead = site.lead;
            let position = rotate(site.to_local([q[c], q[c + 1]]), lead.0, lead.1);
            let offset = place.offset(site.motion.radial_offset, lead, position);
            site.pocket_offset = offset;
            if apart(offset) {
                continue;
            }
            let velocity = rotate(site.to_local([v[c], v[c + 1]]), lead.0, lead.1);
            let cage = CageMotion { position, velocity, speed: v[c + 2] };
            let relative = place.relative_motion(offset, &site.motion, lead, &cage);
            touch(ws, j, &relative);
        }
    }
}

fn push(
    batch: &mut Batch<PocketSite>,
    element: usize,
    pillar: Pillar,
    place: PocketPlace,
    relative: &PocketMotion<f64>,
    contact: PillarContact<f64>,
) {
    let PillarContact { motion, frame, edge_share } = contact;
    let lever = place.lever(relative.offset, frame.normal);
    batch.push(element, motion, frame, PocketSite { pillar, edge_share, lever });
}

/// A NaN approach counts as contact, so that it reaches the accelerations and is reported.
fn touching(approach: f64) -> bool {
    approach > 0.0 || approach.is_nan()
}
