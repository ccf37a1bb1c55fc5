//! A rotor on an elastic shaft whose end is the inner ring, and with which it turns: a disc that moves in the plane.
//!
//! ```text
//! m x'' = F + P + U - c x'  and the weight
//! ```
//!
//! F force of the shaft (`pairs/shaft`), P load, U unbalance, c damping to the ground. Source: Jeffcott 1919.

use super::unbalance::OffCentre;
use super::{
    BodyEnergy, BodyForces, BodyState, CENTRE, Coordinate, Fault, ForceSource, Input, InputValues, OnBody,
    Power, SharedBody, weight,
};
use crate::scene::Scene;
use crate::space::{Motion, Wrench};
use nalgebra::Vector2;

/// Inputs that are its load.
const LOADS: [Input; 2] = [Input::RotorLoadY, Input::RotorLoadZ];

/// A rotor.
#[derive(Debug)]
pub(super) struct Rotor {
    /// kg
    mass: f64,
    /// N s/m
    damping: f64,
    unbalance: OffCentre,
    /// m
    reach: f64,
}

impl Rotor {
    /// That of a scene, if it has one.
    pub(super) fn of(scene: &Scene) -> Option<Box<dyn SharedBody>> {
        let rotor = scene.rotor.as_ref()?;
        Some(Box::new(Self {
            mass: rotor.mass,
            damping: rotor.damping.unwrap_or(0.0),
            unbalance: OffCentre::new(rotor.unbalance, 1),
            reach: scene.pitch_radius(),
        }))
    }
}

impl SharedBody for Rotor {
    fn name(&self) -> &'static str {
        "rotor"
    }

    fn coordinates(&self) -> &[Coordinate] {
        &CENTRE
    }

    fn motion(&self, q: &[f64], v: &[f64], inputs: &InputValues) -> Motion<f64> {
        let speed = inputs.of(Input::RingSpeed);
        Motion { position: [q[0], q[1]], velocity: [v[0], v[1]], angle: 0.0, speed }
    }

    fn reach(&self) -> f64 {
        self.reach
    }

    fn lost(&self, distance: f64) -> Fault {
        Fault::LostRotor { distance, reach: self.reach }
    }

    fn mass(&self) -> Option<f64> {
        Some(self.mass)
    }

    fn load(&self, inputs: &InputValues) -> [f64; 2] {
        LOADS.map(|input| inputs.of(input))
    }

    fn add_external(&self, state: &BodyState<'_>, inputs: &InputValues, on_body: &mut Wrench<f64>) {
        let (load, off_centre) = (self.load(inputs), self.unbalance.force(inputs).unwrap_or_default());
        for k in 0..2 {
            on_body.force[k] += load[k] + off_centre[k] - self.damping * state.motion.velocity[k];
        }
    }

    fn respond(&self, forces: &mut [f64], _q: &[f64]) {
        forces.iter_mut().for_each(|force| *force /= self.mass);
    }

    fn accelerate(&self, on_body: &OnBody<'_>, _state: &BodyState<'_>, gravity: [f64; 2], a: &mut [f64]) {
        for k in 0..2 {
            a[k] = on_body.wrench.force[k] / self.mass + gravity[k];
        }
    }

    fn wrench_for(&self, a: &dyn Fn(usize) -> f64, _state: &BodyState<'_>, gravity: [f64; 2]) -> Wrench<f64> {
        Wrench { force: [0, 1].map(|k| self.mass * (a(k) - gravity[k])), moment: 0.0 }
    }

    fn add_damping(&self, add: &mut dyn FnMut([usize; 2], f64)) {
        for k in 0..2 {
            add([k, k], self.damping);
        }
    }

    fn energy(&self, state: &BodyState<'_>, gravity: [f64; 2]) -> BodyEnergy {
        let [vy, vz] = state.motion.velocity;
        BodyEnergy {
            kinetic: 0.5 * self.mass * (vy * vy + vz * vz),
            elastic: 0.0,
            potential: BodyEnergy::of_weight(self.mass, gravity, state.motion.position),
        }
    }

    fn add_powers(&self, state: &BodyState<'_>, inputs: &InputValues, powers: &mut [f64]) {
        let v = Vector2::from(state.motion.velocity);
        let driving = Vector2::from(self.load(inputs)) + self.unbalance.force(inputs).unwrap_or_default();
        powers[Power::Loads as usize] += driving.dot(&v);
        powers[Power::RingSupport as usize] -= self.damping * v.dot(&v);
    }

    fn report(&self, state: &BodyState<'_>, inputs: &InputValues, gravity: [f64; 2], out: &mut BodyForces) {
        let ([vy, vz], [y, z]) = (state.motion.velocity, self.load(inputs));
        let off_centre = self.unbalance.force(inputs).unwrap_or_default();
        out[ForceSource::Gravity as usize] = weight(self.mass, gravity);
        out[ForceSource::Load as usize] = [y, z, 0.0];
        out[ForceSource::Support as usize] = [-self.damping * vy, -self.damping * vz, 0.0];
        out[ForceSource::Unbalance as usize] = [off_centre[0], off_centre[1], 0.0];
    }

    fn load_rates(&self, inputs: &InputValues, rates: &InputValues) -> [f64; 3] {
        let ([y, z], off_centre) = (self.load(rates), self.unbalance.change(inputs, rates));
        [y + off_centre[0], z + off_centre[1], 0.0]
    }

    fn frequency_on(&self, radial: f64, _turning: f64, _lever: f64) -> f64 {
        radial / self.mass
    }
}
