//! A ring in the plane: held, moved as prescribed, or free on a support. Its rotation is prescribed.
//!
//! ```text
//! M x'' = F + P + U - K x - C x'  and the weight,   M = m 1 + that of the support
//! ```
//!
//! x centre, P load, U unbalance. What turns the ring is no state: it takes the moment that the speed needs. The part of K
//! that is not symmetric stores no energy.

use super::unbalance::OffCentre;
use super::{
    BodyEnergy, BodyForces, BodyState, CENTRE, Coordinate, Fault, ForceSource, Input, InputValues, OnBody,
    PLACES, Power, SharedBody, weight,
};
use crate::scalar::math;
use crate::scene::{
    FreeRing, InnerRing, OuterRing, OuterRingMotion, PlaneMatrix, RingMotion, Scene, Support,
};
use crate::space::{Motion, Wrench};
use nalgebra::{DMatrixViewMut, Matrix2, Vector2};

/// A free ring further off than clearance and this share of the radius of its rollers has left the bearing.
const LOST_RING: f64 = 0.1;

/// A ring.
#[derive(Debug)]
pub(super) struct Ring {
    name: &'static str,
    held: Held,
    /// Input that prescribes its speed; without one it does not turn.
    speed: Option<Input>,
    /// Which ring it is: 0 the outer one.
    which: usize,
    /// Whether its raceway has waves, which makes its angle count.
    wavy: bool,
    /// Inputs that are its load.
    load: [Input; 2],
    /// Clearance and a tenth of a roller's radius, which no elastic approach comes near, m.
    reach: f64,
}

#[derive(Debug)]
enum Held {
    /// At this position, m.
    At([f64; 2]),
    /// By inputs: where y and z are among [`PLACES`].
    By([usize; 2]),
    /// Not at all.
    Free(Box<Free>),
}

/// What moves a free ring.
#[derive(Debug)]
struct Free {
    /// m, kg.
    mass: f64,
    /// Of the support alike in all directions, N s/m.
    damping: f64,
    support: Option<Matrices>,
    unbalance: OffCentre,
}

/// A support that differs from one direction to the other.
#[derive(Debug)]
struct Matrices {
    /// M, kg, and its inverse.
    mass: Matrix2<f64>,
    inverse: Matrix2<f64>,
    /// The parts of K that are symmetric and that are not, N/m.
    stiffness: [Matrix2<f64>; 2],
    /// C, N s/m.
    damping: Matrix2<f64>,
}

impl Matrices {
    fn new(support: &Support, ring: f64) -> Self {
        let matrix = |m: PlaneMatrix| Matrix2::from_row_slice(m.rows().as_flattened());
        let stiffness = matrix(support.stiffness);
        let [symmetric, rest] = [1.0, -1.0].map(|sign| (stiffness + stiffness.transpose() * sign) * 0.5);
        let added = support.mass.map_or_else(Matrix2::zeros, matrix);
        let mass = added + Matrix2::from_diagonal_element(ring);
        let adjugate = Matrix2::new(mass[(1, 1)], -mass[(0, 1)], -mass[(1, 0)], mass[(0, 0)]);
        Self {
            mass,
            inverse: adjugate / mass.determinant(),
            stiffness: [symmetric, rest],
            damping: support.damping.map_or_else(Matrix2::zeros, matrix),
        }
    }

    /// Force of its spring that stores energy, and of all else, N.
    fn forces(&self, motion: &Motion<f64>) -> [Vector2<f64>; 2] {
        let (x, v) = (Vector2::from(motion.position), Vector2::from(motion.velocity));
        let [symmetric, rest] = self.stiffness;
        [-(symmetric * x), -(rest * x) - self.damping * v]
    }
}

/// Smallest and largest eigenvalue of a symmetric matrix.
fn extremes(matrix: &Matrix2<f64>) -> [f64; 2] {
    let (mean, half) = (0.5 * matrix.trace(), 0.5 * (matrix[(0, 0)] - matrix[(1, 1)]));
    let radius = math::hypot(half, matrix[(0, 1)]);
    [mean - radius, mean + radius]
}

impl Free {
    fn new(ring: &FreeRing, turning: usize) -> Self {
        Self {
            mass: ring.mass,
            damping: ring.support_damping.unwrap_or(0.0),
            support: ring.support.as_ref().map(|support| Matrices::new(support, ring.mass)),
            unbalance: OffCentre::new(ring.unbalance, turning),
        }
    }

    /// The smallest mass that it has in a direction, kg.
    fn least_mass(&self) -> f64 {
        self.support.as_ref().map_or(self.mass, |support| extremes(&support.mass)[0])
    }

    /// Force of the support, N.
    fn of_support(&self, motion: &Motion<f64>) -> Vector2<f64> {
        let uniform = -(Vector2::from(motion.velocity) * self.damping);
        let [spring, rest] =
            self.support.as_ref().map_or([Vector2::zeros(); 2], |support| support.forces(motion));
        uniform + spring + rest
    }
}

impl Ring {
    /// The outer ring of a scene: it is held in the centre and stands still unless the scene says otherwise.
    pub(super) fn outer(scene: &Scene) -> Self {
        let speed = scene.outer_ring.as_ref().and_then(|ring| ring.speed.as_ref());
        let held = match scene.outer_motion() {
            None => Held::At([0.0; 2]),
            Some(OuterRingMotion::Prescribed(_)) => Held::By([5, 6]),
            Some(OuterRingMotion::Free(ring)) => Held::Free(Box::new(Free::new(ring, 0))),
        };
        Self {
            name: "outer_ring",
            held,
            speed: speed.map(|_| Input::OuterRingSpeed),
            which: 0,
            wavy: scene.rollers.is_some() && scene.outer_ring.as_ref().is_some_and(OuterRing::wavy),
            load: [Input::OuterLoadY, Input::OuterLoadZ],
            reach: LOST_RING * scene.pitch_radius(),
        }
    }

    /// The inner ring of a scene.
    pub(super) fn inner(scene: &Scene) -> Self {
        let held = match scene.inner_ring.as_ref().map(|ring| &ring.motion) {
            None | Some(RingMotion::Space(_)) => Held::At([0.0; 2]),
            Some(RingMotion::Fixed(position)) => Held::At([position.y, position.z]),
            Some(RingMotion::Prescribed(_)) => Held::By([1, 2]),
            Some(RingMotion::Free(ring)) => Held::Free(Box::new(Free::new(ring, 1))),
        };
        let clearance = scene.radial_clearance().max(0.0);
        let reach = clearance + scene.largest_deviation() + LOST_RING * scene.element_radius();
        let load = [Input::LoadY, Input::LoadZ];
        let wavy = scene.rollers.is_some() && scene.inner_ring.as_ref().is_some_and(InnerRing::wavy);
        Self { name: "inner_ring", held, speed: Some(Input::RingSpeed), which: 1, wavy, load, reach }
    }

    fn free(&self) -> Option<&Free> {
        match &self.held {
            Held::Free(free) => Some(free),
            Held::At(_) | Held::By(_) => None,
        }
    }

    fn turning(&self, inputs: &InputValues) -> f64 {
        self.speed.map_or(0.0, |input| inputs.of(input))
    }
}

impl SharedBody for Ring {
    fn name(&self) -> &'static str {
        self.name
    }

    fn coordinates(&self) -> &[Coordinate] {
        if self.free().is_some() { &CENTRE } else { &[] }
    }

    #[inline]
    fn motion(&self, q: &[f64], v: &[f64], inputs: &InputValues) -> Motion<f64> {
        let (position, velocity) = match self.held {
            Held::At(position) => (position, [0.0; 2]),
            Held::By(places) => {
                let of = |which: usize| places.map(|place| inputs.of(PLACES[place][which]));
                (of(0), of(1))
            }
            Held::Free(_) => ([q[0], q[1]], [v[0], v[1]]),
        };
        let angle = if self.wavy { inputs.angles[self.which] } else { 0.0 };
        Motion { position, velocity, angle, speed: self.turning(inputs) }
    }

    fn turned_by(&self) -> Option<Input> {
        self.speed
    }

    fn moved_by(&self) -> Option<[usize; 2]> {
        match self.held {
            Held::By(places) => Some(places),
            Held::At(_) | Held::Free(_) => None,
        }
    }

    fn reach(&self) -> f64 {
        self.reach
    }

    fn lost(&self, distance: f64) -> Fault {
        Fault::LostRing { ring: self.which, distance, reach: self.reach }
    }

    fn mass(&self) -> Option<f64> {
        self.free().map(Free::least_mass)
    }

    fn weighing(&self) -> Option<f64> {
        self.free().map(|free| free.mass)
    }

    fn support(&self) -> [[f64; 2]; 2] {
        let support = self.free().and_then(|free| free.support.as_ref());
        support.map_or([[0.0; 2]; 2], |support| {
            let [symmetric, rest] = support.stiffness;
            (symmetric + rest).transpose().into()
        })
    }

    fn load(&self, inputs: &InputValues) -> [f64; 2] {
        self.load.map(|input| inputs.of(input))
    }

    fn add_external(&self, state: &BodyState<'_>, inputs: &InputValues, on_body: &mut Wrench<f64>) {
        let Some(free) = self.free() else { return };
        let load = self.load.map(|input| inputs.of(input));
        for ((force, load), v) in on_body.force.iter_mut().zip(load).zip(state.motion.velocity) {
            *force = *force + load - free.damping * v;
        }
        let mut more = |x: Vector2<f64>| on_body.force = [on_body.force[0] + x[0], on_body.force[1] + x[1]];
        if let Some(support) = &free.support {
            support.forces(state.motion).into_iter().for_each(&mut more);
        }
        if let Some(off_centre) = free.unbalance.force(inputs) {
            more(off_centre);
        }
    }

    fn respond(&self, forces: &mut [f64], _q: &[f64]) {
        match self.free() {
            Some(Free { mass, support: None, .. }) => forces.iter_mut().for_each(|force| *force /= mass),
            Some(Free { support: Some(support), .. }) => {
                let a = support.inverse * Vector2::new(forces[0], forces[1]);
                forces[..2].copy_from_slice(a.as_slice());
            }
            None => {}
        }
    }

    fn accelerate(&self, on_body: &OnBody<'_>, _state: &BodyState<'_>, gravity: [f64; 2], a: &mut [f64]) {
        let Some(free) = self.free() else { return };
        let force = on_body.wrench.force;
        match &free.support {
            None => (0..2).for_each(|k| a[k] = force[k] / free.mass + gravity[k]),
            Some(support) => {
                let all = Vector2::from(force) + Vector2::from(gravity) * free.mass;
                a[..2].copy_from_slice((support.inverse * all).as_slice());
            }
        }
    }

    fn wrench_for(&self, a: &dyn Fn(usize) -> f64, _state: &BodyState<'_>, gravity: [f64; 2]) -> Wrench<f64> {
        let Some(free) = self.free() else { return Wrench::default() };
        let a = Vector2::new(a(0), a(1));
        let inertial = free.support.as_ref().map_or(a * free.mass, |support| support.mass * a);
        Wrench { force: (inertial - Vector2::from(gravity) * free.mass).into(), moment: 0.0 }
    }

    fn is_balanced(&self) -> bool {
        self.free().and_then(|free| free.support.as_ref()).is_none_or(|support| support.mass[(0, 1)] == 0.0)
    }

    fn add_damping(&self, add: &mut dyn FnMut([usize; 2], f64)) {
        let Some(free) = self.free() else { return };
        for k in 0..2 {
            add([k, k], free.damping);
        }
        if let Some(support) = &free.support {
            for (i, k) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                add([i, k], support.damping[(i, k)]);
            }
        }
    }

    fn add_inertial_slopes(
        &self,
        _on_body: &OnBody<'_>,
        _state: &BodyState<'_>,
        mut over_position: DMatrixViewMut<'_, f64>,
        _over_velocity: DMatrixViewMut<'_, f64>,
    ) {
        if let Some(support) = self.free().and_then(|free| free.support.as_ref()) {
            let [symmetric, rest] = support.stiffness;
            over_position -= support.inverse * (symmetric + rest);
        }
    }

    fn energy(&self, state: &BodyState<'_>, gravity: [f64; 2]) -> BodyEnergy {
        let Some(free) = self.free() else { return BodyEnergy::default() };
        let Motion { position, velocity: [vy, vz], .. } = *state.motion;
        let potential = BodyEnergy::of_weight(free.mass, gravity, position);
        let Some(support) = &free.support else {
            return BodyEnergy { kinetic: 0.5 * free.mass * (vy * vy + vz * vz), elastic: 0.0, potential };
        };
        let (x, v) = (Vector2::from(position), Vector2::new(vy, vz));
        BodyEnergy {
            kinetic: 0.5 * v.dot(&(support.mass * v)),
            elastic: 0.5 * x.dot(&(support.stiffness[0] * x)),
            potential,
        }
    }

    fn add_powers(&self, state: &BodyState<'_>, inputs: &InputValues, powers: &mut [f64]) {
        let Some(free) = self.free() else { return };
        let [y, z] = state.motion.velocity;
        let v = Vector2::new(y, z);
        powers[Power::Loads as usize] += Vector2::from(self.load(inputs)).dot(&v);
        powers[Power::RingSupport as usize] -= free.damping * (y * y + z * z);
        if let Some(off_centre) = free.unbalance.force(inputs) {
            powers[Power::Loads as usize] += off_centre.dot(&v);
        }
        if let Some(support) = &free.support {
            let [_, rest] = support.forces(state.motion);
            powers[Power::RingSupport as usize] += rest.dot(&v);
        }
    }

    fn report(&self, state: &BodyState<'_>, inputs: &InputValues, gravity: [f64; 2], out: &mut BodyForces) {
        let Some(free) = self.free() else { return };
        let row = |force: Vector2<f64>| [force[0], force[1], 0.0];
        out[ForceSource::Gravity as usize] = weight(free.mass, gravity);
        out[ForceSource::Load as usize] = row(self.load(inputs).into());
        out[ForceSource::Support as usize] = row(free.of_support(state.motion));
        out[ForceSource::Unbalance as usize] = row(free.unbalance.force(inputs).unwrap_or_default());
    }

    fn load_rates(&self, inputs: &InputValues, rates: &InputValues) -> [f64; 3] {
        let Some(free) = self.free() else { return [0.0; 3] };
        let all = Vector2::from(self.load(rates)) + free.unbalance.change(inputs, rates);
        [all[0], all[1], 0.0]
    }

    fn frequency_on(&self, radial: f64, _turning: f64, _lever: f64) -> f64 {
        let Some(free) = self.free() else { return 0.0 };
        let held = free.support.as_ref().map_or(0.0, |support| extremes(&support.stiffness[0])[1]);
        (radial + held) / free.least_mass()
    }
}
