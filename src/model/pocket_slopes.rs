//! Derivatives of the pocket forces, contact by contact: law and kinematics by dual numbers, chained.

use super::batch::Mate;
use super::jacobian::{CAGE, Drift};
use super::laws::{CylinderLaws, PocketLaws};
use super::workspace::{ElementSite, Workspace};
use super::{Input, Model};
use crate::contact::guide::BodyMotion;
use crate::contact::pocket::{Pillar, PillarContact, PocketPlace};
use crate::contact::raceway::RollerMotion;
use crate::contact::{Wrench, rotate};
use crate::integrate::Linearization;
use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::scalar::{Dual, Real};

/// A number with derivatives over what a contact law sees: approach, approach speed, u1, u2, edge share, logarithm of the
/// viscosity.
type LawDual = Dual<6>;
/// A number with derivatives over the coordinates of a contact: element (rho, travel), their rates, spin; position of the
/// cage, its velocity; logarithm of the viscosity.
type PairDual = Dual<12>;
const POSITION: usize = 5;
const VELOCITY: usize = 8;
const VISCOSITY: usize = 11;

/// Forces on the element of a pair (radial, circumferential, moment) and on the cage (y, z, moment), with their
/// derivatives.
struct PairForce {
    own: [PairDual; 3],
    on_cage: [PairDual; 3],
}

impl Model {
    /// Adds the derivatives of all pocket contacts.
    pub(super) fn add_pockets(
        &self,
        pocket: &PocketLaws,
        state: (&[f64], &[f64]),
        ws: &Workspace,
        drift: &mut Drift<'_>,
        out: &mut Linearization,
    ) {
        let Some(cage) = self.layout.cage else { return };
        for contact in ws.contacts() {
            let (Mate::Pocket(site), j) = (&contact.site.mate, contact.site.element) else { continue };
            if let Some(force) = Pair::new(j, cage, state, ws).pocket(pocket, site.pillar) {
                self.add_pair(j, &force, drift, out);
            }
        }
    }

    /// Adds the derivatives of the forces of one contact of element `j`.
    fn add_pair(&self, j: usize, force: &PairForce, drift: &mut Drift<'_>, out: &mut Linearization) {
        let thickening = drift.thickening;
        let (k, d) = (&mut out.over_positions, &mut out.over_velocities);
        for (i, row) in force.on_cage.iter().enumerate() {
            for c in 0..3 {
                k.hub[(CAGE + i, CAGE + c)] += row.eps[POSITION + c];
                d.hub[(CAGE + i, CAGE + c)] += row.eps[VELOCITY + c];
            }
            drift.hub[CAGE + i] += row.eps[VISCOSITY] * thickening;
        }
        let (Some(k), Some(d)) = (k.spokes.get_mut(j), d.spokes.get_mut(j)) else {
            // The motion of the element is prescribed.
            let rates = drift.rates;
            for (i, row) in force.on_cage.iter().enumerate() {
                drift.hub[CAGE + i] += row.eps[1] * rates.orbit_travel
                    + row.eps[3] * rates.of(Input::OrbitSpeed)
                    + row.eps[4] * rates.of(Input::SpinSpeed);
            }
            return;
        };
        for (i, row) in force.on_cage.iter().enumerate() {
            for c in 0..2 {
                k.to_hub[(CAGE + i, c)] += row.eps[c];
            }
            for c in 0..3 {
                d.to_hub[(CAGE + i, c)] += row.eps[2 + c];
            }
        }
        let places = self.places(j);
        for (i, row) in force.own.iter().enumerate() {
            for c in 0..2 {
                k.own[(i, c)] += row.eps[c];
            }
            for c in 0..3 {
                d.own[(i, c)] += row.eps[2 + c];
                k.from_hub[(i, CAGE + c)] += row.eps[POSITION + c];
                d.from_hub[(i, CAGE + c)] += row.eps[VELOCITY + c];
            }
            out.over_time[places[i]] += row.eps[VISCOSITY] * thickening;
        }
    }
}

/// The coordinates of element `j` and of the cage, which begin at `c`, as variables.
struct Pair {
    motion: RollerMotion<PairDual>,
    /// Sine and cosine of the azimuth and of the lead over the pocket.
    azimuth: (PairDual, PairDual),
    lead: (PairDual, PairDual),
    cage: BodyMotion<PairDual>,
    /// ln of the relative viscosity.
    thickening: LawDual,
}

impl Pair {
    fn new(j: usize, c: usize, (q, v): (&[f64], &[f64]), ws: &Workspace) -> Self {
        let site: &ElementSite = &ws.elements[j];
        let m = &site.motion;
        let own = PairDual::variable;
        let motion = RollerMotion {
            radial_offset: own(m.radial_offset, 0),
            radial_speed: own(m.radial_speed, 2),
            orbit_speed: own(m.orbit_speed, 3),
            spin_speed: own(m.spin_speed, 4),
        };
        let turn = |(sin, cos): (f64, f64), slope: PairDual| (slope * cos + sin, -(slope * sin) + cos);
        // Zero with the derivative of the travel.
        let travel = own(0.0, 1);
        let cage = BodyMotion {
            position: [0, 1].map(|k| PairDual::variable(q[c + k], POSITION + k)),
            velocity: [0, 1].map(|k| PairDual::variable(v[c + k], VELOCITY + k)),
            angle: PairDual::variable(q[c + 2], POSITION + 2),
            speed: PairDual::variable(v[c + 2], VELOCITY + 2),
        };
        let behind = travel - (cage.angle - cage.angle.value());
        Self {
            motion,
            azimuth: turn((site.sin, site.cos), travel),
            lead: turn(site.lead, behind),
            cage,
            thickening: LawDual::variable(ws.thickening, 5),
        }
    }

    fn to_local(&self, v: [PairDual; 2]) -> [PairDual; 2] {
        rotate(v, -self.azimuth.0, self.azimuth.1)
    }

    fn to_global(&self, v: [PairDual; 2]) -> [PairDual; 2] {
        rotate(v, self.azimuth.0, self.azimuth.1)
    }

    /// The contact with one pillar; `None` when they are apart.
    fn pocket(&self, pocket: &PocketLaws, side: Pillar) -> Option<PairForce> {
        let cage = &self.cage;
        let place = pocket.place();
        let position = rotate(self.to_local(cage.position), self.lead.0, self.lead.1);
        let offset = place.offset(self.motion.radial_offset, self.lead, position);
        let velocity = rotate(self.to_local(cage.velocity), self.lead.0, self.lead.1);
        let relative = place.relative_motion(offset, &self.motion, self.lead, velocity, cage.speed);
        let contact = match pocket {
            PocketLaws::Cylinder(laws) => laws.shape.pillar(side, &relative),
            PocketLaws::Plane(laws) => laws.shape.wall(side, &relative),
        }?;
        let force = match pocket {
            PocketLaws::Cylinder(laws) => cylinder_force(laws, &contact, self.thickening),
            PocketLaws::Plane(laws) => {
                let law = laws.contact.force(&law_variables(&contact.motion));
                chain(&law, &contact.motion, contact.edge_share)
            }
        };
        Some(self.pocket_force(&place, &offset, &contact, &force))
    }

    fn pocket_force(
        &self,
        place: &PocketPlace,
        offset: &[PairDual; 2],
        contact: &PillarContact<PairDual>,
        force: &ContactForce<PairDual>,
    ) -> PairForce {
        let [on_element, _] = contact.frame.wrenches(force);
        let lever = place.lever(*offset, contact.frame.normal);
        let [along_r, along_c] = on_element.force;
        let moment = -(lever[0] * along_c - lever[1] * along_r);
        let local = rotate(on_element.force, -self.lead.0, self.lead.1);
        let [y, z] = self.to_global(local);
        let own = components(&Wrench { force: local, moment: on_element.moment });
        PairForce { own, on_cage: [-y, -z, moment] }
    }
}

/// Force of a wall or an edge of a cylindrical pocket.
fn cylinder_force(
    laws: &CylinderLaws,
    contact: &PillarContact<PairDual>,
    thickening: LawDual,
) -> ContactForce<PairDual> {
    let motion = law_variables(&contact.motion);
    let edge_share = LawDual::variable(contact.edge_share.value(), 4);
    chain(&laws.wall.force(&motion, thickening, edge_share), &contact.motion, contact.edge_share)
}

/// What a law sees, as its variables.
fn law_variables(motion: &ContactMotion<PairDual>) -> ContactMotion<LawDual> {
    ContactMotion {
        delta: LawDual::variable(motion.delta.value(), 0),
        delta_dot: LawDual::variable(motion.delta_dot.value(), 1),
        u1: LawDual::variable(motion.u1.value(), 2),
        u2: LawDual::variable(motion.u2.value(), 3),
    }
}

/// The forces of a contact over the coordinates of its bodies: chain rule. What makes no force is left at zero.
fn chain(
    force: &ContactForce<LawDual>,
    motion: &ContactMotion<PairDual>,
    edge_share: PairDual,
) -> ContactForce<PairDual> {
    let viscosity = PairDual::variable(0.0, VISCOSITY);
    let inner = [motion.delta, motion.delta_dot, motion.u1, motion.u2, edge_share, viscosity];
    let over_coordinates = |f: LawDual| {
        let mut out = PairDual::constant(f.re);
        for (slope, x) in f.eps.iter().zip(&inner) {
            for (e, dx) in out.eps.iter_mut().zip(x.eps) {
                *e += slope * dx;
            }
        }
        out
    };
    ContactForce {
        normal: over_coordinates(force.normal),
        friction: over_coordinates(force.friction),
        rolling_resistance: over_coordinates(force.rolling_resistance),
        ..ContactForce::none(PairDual::constant(0.0))
    }
}

fn components(wrench: &Wrench<PairDual>) -> [PairDual; 3] {
    [wrench.force[0], wrench.force[1], wrench.moment]
}
