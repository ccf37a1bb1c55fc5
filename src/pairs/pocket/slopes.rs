//! Derivatives of the pocket forces, contact by contact: those of the laws, chained with those of the kinematics, by dual
//! numbers.

use super::kinematics::{Pillar, PillarContact, PocketPlace, PocketShape};
use crate::bodies::{CAGE, Element, ElementMotion, Input, Motions};
use crate::laws::contact_pair::ContactForce;
use crate::pairs::contacts::{FORCES, Slopes, VISCOSITY, chain, contact_force};
use crate::pairs::{Batch, SlopeSums};
use crate::scalar::{Dual, Real, math};
use crate::space::{Frame, Motion};

/// A number with derivatives over the coordinates of a contact: element (rho, travel), their rates, spin; position of the
/// cage, its velocity.
type PairDual = Dual<11>;
const POSITION: usize = 5;
const VELOCITY: usize = 8;

/// Adds those of contact `i` of a batch.
pub(super) fn add_pocket<S: PocketShape>(
    shape: &S,
    batch: &Batch,
    i: usize,
    motions: &Motions,
    sums: &mut SlopeSums<'_>,
) {
    let site = &batch.sites[i];
    let j = site.element;
    let side = if site.contact == Pillar::Front as usize { Pillar::Front } else { Pillar::Back };
    let (sin, cos) = math::sin_cos(motions.travel(j) - motions.shared[CAGE].angle);
    let lead = Frame { sin, cos };
    let pair = Pair::new(&motions.element(j), lead, &motions.shared[CAGE]);
    if let Some(force) = pair.pocket(shape, &batch.slopes(i), side, sums.ln_viscosity_rate) {
        add_pair(j, &force, sums);
    }
}

/// Forces on the element of a pair (radial, circumferential, moment) and on the cage (y, z, moment), with their
/// derivatives.
struct PairForce {
    own: [PairDual; 3],
    on_cage: [PairDual; 3],
    /// Rates of both while the viscosity changes as it does.
    warming: [[f64; 3]; 2],
}

/// Adds the derivatives of the forces of one contact of element `j`.
fn add_pair(j: usize, force: &PairForce, sums: &mut SlopeSums<'_>) {
    sums.add_mate(CAGE, CAGE, &force.on_cage.map(over_cage));
    sums.add_mate_over_time(CAGE, &force.warming[1]);
    if j >= sums.layout.count {
        // The motion of the element is prescribed.
        let rates = sums.rates;
        let over_time = force.on_cage.map(|row| {
            row.eps[1] * rates.orbit_travel
                + row.eps[3] * rates.of(Input::OrbitSpeed)
                + row.eps[4] * rates.of(Input::SpinSpeed)
        });
        sums.add_mate_over_time(CAGE, &over_time);
        return;
    }
    sums.add_mate_over_own(j, CAGE, &force.on_cage.map(over_element));
    sums.add_own(j, &force.own.map(over_element));
    sums.add_own_over_mate(j, CAGE, &force.own.map(over_cage));
    sums.add_own_over_time(j, &force.warming[0]);
}

#[inline]
fn over_element(row: PairDual) -> ([f64; 2], [f64; 3]) {
    let [p0, p1, v0, v1, v2, ..] = row.eps;
    ([p0, p1], [v0, v1, v2])
}

#[inline]
fn over_cage(row: PairDual) -> ([f64; 3], [f64; 3]) {
    let [.., p0, p1, p2, v0, v1, v2] = row.eps;
    ([p0, p1, p2], [v0, v1, v2])
}

/// The coordinates of an element and of the cage as variables.
struct Pair {
    motion: ElementMotion<PairDual>,
    /// Direction of the element, and how far it is ahead of its pocket.
    frame: Frame<PairDual>,
    lead: Frame<PairDual>,
    cage: Motion<PairDual>,
}

impl Pair {
    #[inline]
    fn new(element: &Element, lead: Frame<f64>, cage: &Motion<f64>) -> Self {
        let m = &element.motion;
        let variable = PairDual::variable;
        let motion = ElementMotion {
            radial_offset: variable(m.radial_offset, 0),
            radial_speed: variable(m.radial_speed, 2),
            orbit_speed: variable(m.orbit_speed, 3),
            spin_speed: variable(m.spin_speed, 4),
        };
        // Zero with the derivative of the travel.
        let travel = variable(0.0, 1);
        let cage = Motion {
            position: [variable(cage.position[0], POSITION), variable(cage.position[1], POSITION + 1)],
            velocity: [variable(cage.velocity[0], VELOCITY), variable(cage.velocity[1], VELOCITY + 1)],
            angle: variable(cage.angle, POSITION + 2),
            speed: variable(cage.speed, VELOCITY + 2),
        };
        let behind = travel - (cage.angle - cage.angle.value());
        let (frame, lead) = (Frame::turning(element.frame, travel), Frame::turning(lead, behind));
        Self { motion, frame, lead, cage }
    }

    /// The contact with one pillar, with its forces and their derivatives over what its law sees, while the logarithm of the
    /// viscosity changes at the rate `ln_viscosity_rate` (1/s). `None` when they are apart.
    fn pocket<S: PocketShape>(
        &self,
        shape: &S,
        (forces, slopes): &([f64; FORCES], Slopes),
        side: Pillar,
        ln_viscosity_rate: f64,
    ) -> Option<PairForce> {
        let (cage, place) = (&self.cage, shape.place());
        let position = self.lead.to_global(self.frame.to_local(cage.position));
        let offset = place.offset(self.motion.radial_offset, self.lead, position);
        let velocity = self.lead.to_global(self.frame.to_local(cage.velocity));
        let relative = place.relative_motion(offset, &self.motion, self.lead, velocity, cage.speed);
        let contact = shape.pillar(side, &relative)?;
        let force = chain(forces, slopes, &contact.motion, Some(contact.edge_share));
        let [own, on_cage] = self.bodies(&place, &offset, &contact, &force);
        let mut warming = [[0.0; 3]; 2];
        if ln_viscosity_rate != 0.0 {
            let rates = slopes.map(|row| PairDual::constant(row[VISCOSITY] * ln_viscosity_rate));
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
        let grip = place.grip(*offset, contact.normal, self.lead);
        let [own, reaction] = grip.wrenches(force);
        let [y, z] = self.frame.to_global(reaction.force);
        [own.components(), [y, z, reaction.moment]]
    }
}
