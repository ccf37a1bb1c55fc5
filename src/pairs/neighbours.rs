//! Rollers that touch the next one or the one before: bearings without a cage, or whose cage does not keep them apart.
//!
//! ```text
//! gap   = d - R_j - R_k,   d^2 = (rho_k - rho_j)^2 + 4 r_j r_k sin(dpsi/2)^2,   r = r_p + rho
//! dpsi  = +-2 pi/Z + travel_k - travel_j
//! u_1   = a_1 (w_j - phi_dot),   u_2 = -a_2 (w_k - phi_dot),   a_1 = d R_j/(R_j + R_k),   a_2 = d - a_1
//! ```
//!
//! Line contact of two cylinders with 1/R_e = 1/R_j + 1/R_k along the line of centres, whose turning rate is phi_dot. Angles are
//! differences of travels, so no two radii of the bearing are subtracted. Both surfaces move in opposite directions there, so
//! u_1 + u_2 is next to nothing and sliding is 2 R w: a film is thin and friction mostly that of boundaries.
//!
//! A contact stands twice, once for each of its rollers, which is the element there; its mate is the other one. What both give to
//! sums over the bearing counts by half. Neither paper has this contact.

use super::contacts::{DIRECTIONS, FORCES};
use super::line_laws::LawBuilder;
use super::{
    Batch, ContactLaw, Cost, ElementPair, Grip, Law, NEIGHBOUR, PairInfo, RelativeSlopes, Search, SlopeSums,
};
use crate::bodies::{Fault, ForceSource, Motions, Power};
use crate::error::Result;
use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::line_contact::LineContact;
use crate::scalar::{Dual, Numeric, Real};
use crate::scene::Scene;
use std::f64::consts::TAU;
use std::ops::Range;

static INFO: PairInfo = PairInfo {
    mate: NEIGHBOUR,
    source: ForceSource::Neighbour,
    contacts: &["neighbour_ahead", "neighbour_behind"],
    laws: [Some(Law::Neighbours), None],
    powers: [Power::NeighbourDamping, Power::NeighbourFriction],
    rolls: false,
    share: 0.5,
};

/// Contacts of every roller with its neighbours.
#[derive(Debug)]
struct Neighbours {
    law: LineContact,
    count: usize,
    pitch_radius: f64,
    /// Nominal R_b, m.
    radius: f64,
    /// 2 pi/Z, rad.
    spacing: f64,
}

/// Coordinates of one roller: rho, travel, their rates, spin.
type Coordinates<T> = [T; 5];
/// Those of a roller and its neighbour.
const BOTH: usize = 10;

/// The contacts between the rollers of a scene, if they have laws.
pub(super) fn new(laws: &LawBuilder<'_>) -> Result<Option<Box<dyn ElementPair>>> {
    let scene: &Scene = laws.scene();
    let Some((rollers, neighbours)) =
        scene.rollers.as_ref().and_then(|rollers| Some((rollers, rollers.neighbours.as_ref()?)))
    else {
        return Ok(None);
    };
    let law = laws.at("rollers.neighbours.contact").line_contact(
        &neighbours.contact,
        &rollers.material,
        0.5 * rollers.radius,
    )?;
    Ok(Some(Box::new(Neighbours {
        law,
        count: rollers.count as usize,
        pitch_radius: scene.pitch_radius(),
        radius: rollers.radius,
        spacing: TAU / f64::from(rollers.count),
    })))
}

impl Neighbours {
    /// The neighbour of roller `j` on this side, 0 ahead and 1 behind.
    fn neighbour(&self, j: usize, side: usize) -> usize {
        (j + if side == 0 { 1 } else { self.count - 1 }) % self.count
    }

    /// Motion and levers of the contact of a roller with its neighbour on this side, in the axes of the roller, with what their
    /// radii exceed the nominal one by (m).
    fn contact<T: Real>(
        &self,
        own: Coordinates<T>,
        other: Coordinates<T>,
        excess: [f64; 2],
        side: usize,
    ) -> (ContactMotion<T>, Grip<T>) {
        let [rho, travel, radial_speed, orbit_speed, spin] = own;
        let [rho_k, travel_k, radial_speed_k, orbit_speed_k, spin_k] = other;
        let spacing = if side == 0 { self.spacing } else { -self.spacing };
        let half = (travel_k - travel + spacing) * 0.5;
        let (sin, cos) = half.sin_cos();
        let (r, r_k) = (rho + self.pitch_radius, rho_k + self.pitch_radius);
        let to_other = [rho_k - rho - r_k * sin * sin * 2.0, r_k * sin * cos * 2.0];
        let d = (to_other[0] * to_other[0] + to_other[1] * to_other[1]).sqrt();
        let normal = [to_other[0] / d, to_other[1] / d];
        let [radius_1, radius_2] = excess.map(|excess| self.radius + excess);
        // The same point from both sides.
        let arm_1 = d * (radius_1 / (radius_1 + radius_2));
        let arm_2 = d - arm_1;
        let grip = Grip::centred(normal, arm_1, arm_2);
        let tangent = grip.tangent();
        let (sin, cos) = (sin * cos * 2.0, -(sin * sin * 2.0) + 1.0);
        let across = r_k * orbit_speed_k;
        let relative = [
            radial_speed_k * cos - across * sin - radial_speed,
            radial_speed_k * sin + across * cos - r * orbit_speed,
        ];
        let turning = (relative[0] * tangent[0] + relative[1] * tangent[1]) / d;
        let motion = ContactMotion {
            delta: -(d - (radius_1 + radius_2)),
            delta_dot: -(relative[0] * normal[0] + relative[1] * normal[1]),
            u1: (spin - turning) * arm_1,
            u2: -(arm_2 * (spin_k - turning)),
        };
        (motion, grip)
    }

    /// Coordinates of roller `j` and what its radius exceeds the nominal one by, m.
    fn coordinates(&self, motions: &Motions, j: usize) -> (Coordinates<f64>, f64) {
        let m = motions.element(j).motion;
        let coordinates = [m.radial_offset, motions.travel(j), m.radial_speed, m.orbit_speed, m.spin_speed];
        (coordinates, m.radius_excess)
    }
}

impl ElementPair for Neighbours {
    fn info(&self) -> &'static PairInfo {
        &INFO
    }

    fn law(&self) -> ContactLaw {
        ContactLaw::Line(self.law)
    }

    fn find(&self, motions: &Motions, out: &mut Search<'_>) -> std::result::Result<(), Fault> {
        for j in 0..self.count {
            let k = self.neighbour(j, 0);
            let ((own, excess), (other, excess_k)) =
                (self.coordinates(motions, j), self.coordinates(motions, k));
            let (motion, grip) = self.contact(own, other, [excess, excess_k], 0);
            // Also where it is not a number.
            if motion.delta <= 0.0 {
                continue;
            }
            out.touching.push(j, 0, &grip, 0.0, &motion);
            let (motion, grip) = self.contact(other, own, [excess_k, excess], 1);
            out.touching.push(k, 1, &grip, 0.0, &motion);
        }
        Ok(())
    }

    fn add_slopes(
        &self,
        batch: &Batch,
        contacts: Range<usize>,
        motions: &Motions,
        sums: &mut SlopeSums<'_>,
        _memory: &mut RelativeSlopes,
    ) {
        for i in contacts {
            let (j, side) = (batch.sites[i].element, batch.sites[i].contact);
            let k = self.neighbour(j, side);
            let ((own, excess), (other, excess_k)) =
                (self.coordinates(motions, j), self.coordinates(motions, k));
            let varied = |x: Coordinates<f64>, first: usize| -> Coordinates<Dual<BOTH>> {
                std::array::from_fn(|c| Dual::variable(x[c], first + c))
            };
            let (motion, grip) =
                self.contact(varied(own, 0), varied(other, own.len()), [excess, excess_k], side);
            let (values, slopes) = batch.forces_and_slopes(i);
            let seen = [motion.delta, motion.delta_dot, motion.u1, motion.u2];
            let [mut forces, mut warming] = [[Dual::<BOTH>::lift(0.0); FORCES]; 2];
            for (f, slopes) in slopes.iter().enumerate() {
                forces[f].re = values[f];
                for (x, slope) in seen.iter().zip(slopes) {
                    for (sum, eps) in forces[f].eps.iter_mut().zip(x.eps) {
                        *sum += slope * eps;
                    }
                }
                warming[f].re = slopes[DIRECTIONS - 1] * sums.ln_viscosity_rate;
            }
            let wrench = |[normal, friction, rolling_resistance]: [Dual<BOTH>; FORCES]| {
                let force = ContactForce {
                    normal,
                    friction,
                    rolling_resistance,
                    ..ContactForce::none(Dual::<BOTH>::lift(0.0))
                };
                grip.wrenches(&force)[0].components()
            };
            sums.add_neighbours(j, side, wrench(forces).map(|on| on.eps), wrench(warming).map(|on| on.re));
        }
    }

    fn cost(&self) -> Cost {
        // Few of them touch.
        Cost { value: 20.0, slopes: 0.0, per_element: true }
    }
}
