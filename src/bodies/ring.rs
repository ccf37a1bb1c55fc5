//! A ring: held, or free to move in the plane. Its rotation is prescribed.
//!
//! ```text
//! m y'' = F_y + P_y - c y',   m z'' = F_z + P_z - c z'      and the weight
//! ```
//!
//! P load, c damping of the support. What turns the ring is no state: it takes the moment that the speed needs.

use super::{
    BodyEnergy, BodyForces, BodyState, CENTRE, Coordinate, Fault, ForceSource, Input, InputValues, OnBody,
    Power, SharedBody, weight,
};
use crate::scene::{RingMotion, Scene};
use crate::space::{Motion, Wrench};

/// A free ring further off than clearance and this share of the radius of its rollers has left the bearing.
const LOST_RING: f64 = 0.1;

/// A ring.
#[derive(Debug)]
pub(super) struct Ring {
    name: &'static str,
    held: Held,
    /// Input that prescribes its speed; without one it does not turn.
    speed: Option<Input>,
    /// Clearance and a tenth of a roller's radius, which no elastic approach comes near, m.
    reach: f64,
}

#[derive(Debug)]
enum Held {
    /// At this position, m.
    At([f64; 2]),
    /// Not at all; mass in kg, support damping in N s/m.
    Free { mass: f64, damping: f64 },
}

impl Ring {
    /// The outer ring of a scene, held in the centre: it stands still unless the scene gives it a speed.
    pub(super) fn outer(scene: &Scene) -> Self {
        let speed = scene.outer_ring.as_ref().and_then(|ring| ring.speed.as_ref());
        let speed = speed.map(|_| Input::OuterRingSpeed);
        Self { name: "outer_ring", held: Held::At([0.0; 2]), speed, reach: f64::INFINITY }
    }

    /// Of its support, N s/m.
    fn support_damping(&self) -> f64 {
        match self.held {
            Held::At(_) => 0.0,
            Held::Free { damping, .. } => damping,
        }
    }

    /// The inner ring of a scene.
    pub(super) fn inner(scene: &Scene) -> Self {
        let held = match scene.inner_ring.as_ref().map(|ring| &ring.motion) {
            None | Some(RingMotion::Space(_)) => Held::At([0.0; 2]),
            Some(RingMotion::Fixed(position)) => Held::At([position.y, position.z]),
            Some(RingMotion::Free(free)) => {
                Held::Free { mass: free.mass, damping: free.support_damping.unwrap_or(0.0) }
            }
        };
        let clearance = scene.radial_clearance().max(0.0);
        let reach = clearance + scene.largest_deviation() + LOST_RING * scene.element_radius();
        Self { name: "inner_ring", held, speed: Some(Input::RingSpeed), reach }
    }
}

impl SharedBody for Ring {
    fn name(&self) -> &'static str {
        self.name
    }

    fn coordinates(&self) -> &[Coordinate] {
        match self.held {
            Held::At(_) => &[],
            Held::Free { .. } => &CENTRE,
        }
    }

    #[inline]
    fn motion(&self, q: &[f64], v: &[f64], inputs: &InputValues) -> Motion<f64> {
        let (position, velocity) = match self.held {
            Held::At(position) => (position, [0.0; 2]),
            Held::Free { .. } => ([q[0], q[1]], [v[0], v[1]]),
        };
        Motion { position, velocity, angle: 0.0, speed: self.speed.map_or(0.0, |input| inputs.of(input)) }
    }

    fn turned_by(&self) -> Option<Input> {
        self.speed
    }

    fn reach(&self) -> f64 {
        self.reach
    }

    fn lost(&self, distance: f64) -> Fault {
        Fault::LostRing { distance, reach: self.reach }
    }

    fn mass(&self) -> Option<f64> {
        match self.held {
            Held::At(_) => None,
            Held::Free { mass, .. } => Some(mass),
        }
    }

    fn add_external(&self, state: &BodyState<'_>, inputs: &InputValues, on_body: &mut Wrench<f64>) {
        let load = [inputs.of(Input::LoadY), inputs.of(Input::LoadZ)];
        for ((force, load), v) in on_body.force.iter_mut().zip(load).zip(state.motion.velocity) {
            *force = *force + load - self.support_damping() * v;
        }
    }

    fn respond(&self, forces: &mut [f64], _q: &[f64]) {
        let mass = self.mass().unwrap_or(f64::INFINITY);
        forces.iter_mut().for_each(|force| *force /= mass);
    }

    fn accelerate(&self, on_body: &OnBody<'_>, _state: &BodyState<'_>, gravity: [f64; 2], a: &mut [f64]) {
        let Some(mass) = self.mass() else { return };
        for k in 0..2 {
            a[k] = on_body.wrench.force[k] / mass + gravity[k];
        }
    }

    fn wrench_for(&self, a: &dyn Fn(usize) -> f64, _state: &BodyState<'_>, gravity: [f64; 2]) -> Wrench<f64> {
        let mass = self.mass().unwrap_or(0.0);
        Wrench { force: [mass * (a(0) - gravity[0]), mass * (a(1) - gravity[1])], moment: 0.0 }
    }

    fn add_damping(&self, add: &mut dyn FnMut([usize; 2], f64)) {
        for k in 0..2 {
            add([k, k], self.support_damping());
        }
    }

    fn energy(&self, state: &BodyState<'_>, gravity: [f64; 2]) -> BodyEnergy {
        let mass = self.mass().unwrap_or(0.0);
        let [y, z] = state.motion.velocity;
        BodyEnergy {
            kinetic: 0.5 * mass * (y * y + z * z),
            potential: BodyEnergy::of_weight(mass, gravity, state.motion.position),
            elastic: 0.0,
        }
    }

    fn add_powers(&self, state: &BodyState<'_>, inputs: &InputValues, powers: &mut [f64]) {
        if self.mass().is_some() {
            let [y, z] = state.motion.velocity;
            powers[Power::Loads as usize] += inputs.of(Input::LoadY) * y + inputs.of(Input::LoadZ) * z;
            powers[Power::RingSupport as usize] -= self.support_damping() * (y * y + z * z);
        }
    }

    fn report(&self, state: &BodyState<'_>, inputs: &InputValues, gravity: [f64; 2], out: &mut BodyForces) {
        if let Held::Free { mass, damping } = self.held {
            let [y, z] = state.motion.velocity;
            out[ForceSource::Gravity as usize] = weight(mass, gravity);
            out[ForceSource::Load as usize] = [inputs.of(Input::LoadY), inputs.of(Input::LoadZ), 0.0];
            out[ForceSource::Support as usize] = [-damping * y, -damping * z, 0.0];
        }
    }

    fn load_inputs(&self) -> [Option<Input>; 3] {
        let free = self.mass().is_some();
        [free.then_some(Input::LoadY), free.then_some(Input::LoadZ), None]
    }

    fn frequency_on(&self, radial: f64, _turning: f64, _lever: f64) -> f64 {
        self.mass().map_or(0.0, |mass| radial / mass)
    }
}
