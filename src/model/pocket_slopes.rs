//! Derivatives of the pocket forces, contact by contact: those of the laws, chained with those of the kinematics, by dual
//! numbers.

use super::batch::Mate;
use super::jacobian::{CAGE, Drift};
use super::law_slopes::{DIRECTIONS, FORCES, Slopes, VISCOSITY, chain, contact_force};
use super::laws::PocketLaws;
use super::workspace::{ElementSite, Workspace};
use super::{Input, Model};
use crate::contact::guide::BodyMotion;
use crate::contact::pocket::{Pillar, PillarContact, PocketPlace};
use crate::contact::raceway::RollerMotion;
use crate::contact::rotate;
use crate::integrate::Linearization;
use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::solid_contact::SolidContact;
use crate::scalar::{Dual, Real};

/// A number with derivatives over what a contact law sees.
type LawDual = Dual<DIRECTIONS>;
/// A number with derivatives over the coordinates of a contact: element (rho, travel), their rates, spin; position of the
/// cage, its velocity.
type PairDual = Dual<11>;
const POSITION: usize = 5;
const VELOCITY: usize = 8;

/// Forces on the element of a pair (radial, circumferential, moment) and on the cage (y, z, moment), with their
/// derivatives.
struct PairForce {
    own: [PairDual; 3],
    on_cage: [PairDual; 3],
    /// Rates of both while the viscosity changes as it does.
    warming: [[f64; 3]; 2],
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
        for batch in [&ws.raceways, &ws.pockets] {
            for (i, site) in batch.sites.iter().enumerate() {
                let (Mate::Pocket(place), j) = (&site.mate, site.element) else { continue };
                let law = match pocket {
                    PocketLaws::Cylinder(_) => Some(batch.slopes(i)),
                    PocketLaws::Plane(_) => None,
                };
                let pair = Pair::new(j, cage, state, ws);
                if let Some(force) = pair.pocket(pocket, law, place.pillar, drift.thickening) {
                    self.add_pair(j, &force, drift, out);
                }
            }
        }
    }

    /// Adds the derivatives of the forces of one contact of element `j`.
    fn add_pair(&self, j: usize, force: &PairForce, drift: &mut Drift<'_>, out: &mut Linearization) {
        let (k, d) = (&mut out.over_positions, &mut out.over_velocities);
        for (i, row) in force.on_cage.iter().enumerate() {
            for c in 0..3 {
                k.hub[(CAGE + i, CAGE + c)] += row.eps[POSITION + c];
                d.hub[(CAGE + i, CAGE + c)] += row.eps[VELOCITY + c];
            }
            drift.hub[CAGE + i] += force.warming[1][i];
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
            out.over_time[places[i]] += force.warming[0][i];
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
}

impl Pair {
    #[inline]
    fn new(j: usize, c: usize, (q, v): (&[f64], &[f64]), ws: &Workspace) -> Self {
        let site: &ElementSite = &ws.elements[j];
        let m = &site.motion;
        let variable = PairDual::variable;
        let motion = RollerMotion {
            radial_offset: variable(m.radial_offset, 0),
            radial_speed: variable(m.radial_speed, 2),
            orbit_speed: variable(m.orbit_speed, 3),
            spin_speed: variable(m.spin_speed, 4),
        };
        let turn = |(sin, cos): (f64, f64), slope: PairDual| (slope * cos + sin, -(slope * sin) + cos);
        // Zero with the derivative of the travel.
        let travel = variable(0.0, 1);
        let cage = BodyMotion {
            position: [variable(q[c], POSITION), variable(q[c + 1], POSITION + 1)],
            velocity: [variable(v[c], VELOCITY), variable(v[c + 1], VELOCITY + 1)],
            angle: variable(q[c + 2], POSITION + 2),
            speed: variable(v[c + 2], VELOCITY + 2),
        };
        let behind = travel - (cage.angle - cage.angle.value());
        Self { motion, azimuth: turn((site.sin, site.cos), travel), lead: turn(site.lead, behind), cage }
    }

    #[inline]
    fn to_local(&self, v: [PairDual; 2]) -> [PairDual; 2] {
        rotate(v, -self.azimuth.0, self.azimuth.1)
    }

    #[inline]
    fn to_global(&self, v: [PairDual; 2]) -> [PairDual; 2] {
        rotate(v, self.azimuth.0, self.azimuth.1)
    }

    /// The contact with one pillar, of which the forces and the slopes of the `law` are known, but for solid contacts,
    /// while the logarithm of the viscosity changes at the rate `thickening` (1/s). `None` when they are apart.
    fn pocket(
        &self,
        pocket: &PocketLaws,
        law: Option<([f64; FORCES], Slopes)>,
        side: Pillar,
        thickening: f64,
    ) -> Option<PairForce> {
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
        let (forces, slopes) = match (law, pocket) {
            (Some(law), _) => law,
            (None, PocketLaws::Plane(laws)) => solid_slopes(&laws.contact, &contact.motion),
            (None, PocketLaws::Cylinder(_)) => return None,
        };
        let force = chain(&forces, &slopes, &contact.motion, Some(contact.edge_share));
        let [own, on_cage] = self.bodies(&place, &offset, &contact, &force);
        let mut warming = [[0.0; 3]; 2];
        if thickening != 0.0 {
            let rates = slopes.map(|row| PairDual::constant(row[VISCOSITY] * thickening));
            let both = self.bodies(&place, &offset, &contact, &contact_force(rates));
            warming = both.map(|body| body.map(|rate| rate.re));
        }
        Some(PairForce { own, on_cage, warming })
    }

    /// The forces of a contact on its element and on the cage.
    #[inline]
    fn bodies(
        &self,
        place: &PocketPlace,
        offset: &[PairDual; 2],
        contact: &PillarContact<PairDual>,
        force: &ContactForce<PairDual>,
    ) -> [[PairDual; 3]; 2] {
        let [on_element, _] = contact.frame.wrenches(force);
        let lever = place.lever(*offset, contact.frame.normal);
        let [along_r, along_c] = on_element.force;
        let moment = -(lever[0] * along_c - lever[1] * along_r);
        let local = rotate(on_element.force, -self.lead.0, self.lead.1);
        let [y, z] = self.to_global(local);
        [[local[0], local[1], on_element.moment], [-y, -z, moment]]
    }
}

/// Forces of a solid contact and their slopes.
fn solid_slopes(law: &SolidContact, motion: &ContactMotion<PairDual>) -> ([f64; FORCES], Slopes) {
    let force = law.force(&ContactMotion {
        delta: LawDual::variable(motion.delta.re, 0),
        delta_dot: LawDual::variable(motion.delta_dot.re, 1),
        u1: LawDual::variable(motion.u1.re, 2),
        u2: LawDual::variable(motion.u2.re, 3),
    });
    let all = [force.normal, force.friction, force.rolling_resistance];
    (all.map(|f| f.re), all.map(|f| f.eps))
}
