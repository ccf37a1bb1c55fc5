//! The elastic shaft between a rotor and the inner ring.
//!
//! ```text
//! F = -k u - c (u' - w x u)   on the rotor,  -F on the ring,   M = c (u' - w x u) . (e x u) on the ring
//! ```
//!
//! u rotor less ring, w speed of both, e along the axis: what damps within the shaft turns with it, so that M is what its drive gives.
//! Source: Kimball 1924; Genta, Dynamics of Rotating Systems, 2005, section 3.5.

use super::{Ahead, Cost, Law, SharedForce, SharedInfo, SharedPair, SlopeSums};
use crate::bodies::{Fault, ForceSource, INNER_RING, Motions, Power, ROTOR};
use crate::laws::fluid::Fluid;
use crate::laws::guide::GuideForce;
use crate::scene::Scene;
use crate::space::{Motion, Wrench};
use nalgebra::Matrix3;

/// A shaft.
#[derive(Debug)]
pub(super) struct Shaft {
    /// k, N/m.
    stiffness: f64,
    /// c, N s/m.
    damping: f64,
}

/// Rotor less ring, m and m/s, the latter in axes that turn with the shaft.
struct Bent {
    place: [f64; 2],
    rate: [f64; 2],
}

impl Shaft {
    /// That of a scene, if it has a rotor.
    pub(super) fn of(scene: &Scene) -> Option<Box<dyn SharedPair>> {
        let shaft = &scene.rotor.as_ref()?.shaft;
        let damping = shaft.internal_damping.unwrap_or(0.0);
        Some(Box::new(Self { stiffness: shaft.stiffness, damping }))
    }

    fn bent(motions: &Motions) -> Bent {
        let [rotor, ring] = [ROTOR, INNER_RING].map(|place| &motions.shared[place]);
        let minus = |a: [f64; 2], b: [f64; 2]| [a[0] - b[0], a[1] - b[1]];
        let place = minus(rotor.position, ring.position);
        let [vy, vz] = minus(rotor.velocity, ring.velocity);
        Bent { place, rate: [vy + ring.speed * place[1], vz - ring.speed * place[0]] }
    }

    /// On both bodies by these stiffness and damping.
    fn wrenches(&self, bent: &Bent, [k, c]: [f64; 2]) -> [Wrench<f64>; 2] {
        let Bent { place: [y, z], rate: [vy, vz] } = *bent;
        let force = [-k * y - c * vy, -k * z - c * vz];
        let moment = c * (vz * y - vy * z);
        [Wrench { force, moment: 0.0 }, Wrench { force: force.map(|x| -x), moment }]
    }
}

impl SharedPair for Shaft {
    fn info(&self) -> SharedInfo {
        SharedInfo {
            bodies: [ROTOR, INNER_RING],
            source: ForceSource::Shaft,
            laws: [None::<Law>; 2],
            powers: [Power::ShaftDamping, Power::ShaftDamping],
            shears: false,
        }
    }

    fn evaluate(&self, motions: &Motions, _fluid: Fluid, out: &mut SharedForce) -> Result<(), Fault> {
        out.on = self.wrenches(&Self::bent(motions), [self.stiffness, self.damping]);
        out.damping = None;
        Ok(())
    }

    fn evaluate_with_damping(
        &self,
        motions: &Motions,
        fluid: Fluid,
        out: &mut SharedForce,
    ) -> Result<(), Fault> {
        self.evaluate(motions, fluid, out)?;
        let mut own = Matrix3::zeros();
        (own[(0, 0)], own[(1, 1)]) = (self.damping, self.damping);
        out.damping = Some([own, own]);
        Ok(())
    }

    fn acting(&self, _force: &SharedForce) -> [bool; 2] {
        [false; 2]
    }

    /// What damps.
    fn of_film(&self, motions: &Motions, _force: &SharedForce) -> [Wrench<f64>; 2] {
        self.wrenches(&Self::bent(motions), [0.0, self.damping])
    }

    fn stored(&self, motions: &Motions) -> Option<f64> {
        let [y, z] = Self::bent(motions).place;
        Some(0.5 * self.stiffness * (y * y + z * z))
    }

    fn parts(&self, _motions: &Motions, _force: &SharedForce) -> GuideForce<f64> {
        GuideForce::default()
    }

    fn smallest_gap(&self, _motions: &Motions) -> f64 {
        f64::INFINITY
    }

    fn add_slopes(
        &self,
        motions: &Motions,
        _fluid: Fluid,
        _force: &mut SharedForce,
        sums: &mut SlopeSums<'_>,
    ) {
        let (k, c) = (self.stiffness, self.damping);
        let Motion { speed: w, .. } = motions.shared[INNER_RING];
        let bodies = [ROTOR, INNER_RING];
        let bent = Self::bent(motions).place;
        let (speeding, moving) = (sums.speeding(INNER_RING), sums.moving(INNER_RING));
        for (i, body) in bodies.into_iter().enumerate() {
            for (j, over) in bodies.into_iter().enumerate() {
                let sign = if i == j { 1.0 } else { -1.0 };
                let place = [[-k, -c * w], [c * w, -k]].map(|row| row.map(|x| sign * x));
                let rate = [[-c, 0.0], [0.0, -c]].map(|row| row.map(|x| sign * x));
                sums.add_mate::<2, 2>(body, over, &[(place[0], rate[0]), (place[1], rate[1])]);
                if over == INNER_RING {
                    let along = |row: [f64; 2], by: [f64; 2]| row[0] * by[0] + row[1] * by[1];
                    let by_ring = [0, 1].map(|n| along(place[n], moving[0]) + along(rate[n], moving[1]));
                    sums.add_mate_over_time(body, &by_ring);
                }
            }
            let sign = if i == 0 { 1.0 } else { -1.0 };
            let by_speed = [-c * bent[1], c * bent[0]].map(|x| sign * x * speeding);
            sums.add_mate_over_time(body, &by_speed);
        }
    }

    fn longest_step(&self, _ahead: &Ahead<'_>) -> f64 {
        f64::INFINITY
    }

    fn stiffness(&self) -> f64 {
        self.stiffness
    }

    fn energy_giving_field(&self) -> Option<String> {
        None
    }

    fn cost(&self) -> Option<Cost> {
        Some(Cost { value: 10.0, slopes: 30.0, per_element: false })
    }
}
