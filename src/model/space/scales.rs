//! Lengths, frequencies and speeds that describe a bearing in space as a whole.

use super::Space;
use crate::bodies::{Input, InputValues, Moves, OF_RING, RING_COORDINATES};
use crate::pairs::groove::Race;
use crate::scalar::math;

/// Length that errors are measured by, m: about that of a heavily pressed contact.
const REFERENCE_LENGTH: f64 = 1e-5;
/// Ratio of velocity to position scale in the error control, 1/s.
const RATE_SCALE: f64 = 1e4;
/// Largest load of a ball over the mean one under a radial load.
const STRIBECK: f64 = 5.0;

impl Space {
    /// Length in m that errors are measured by.
    pub(crate) fn reference_length(&self) -> f64 {
        REFERENCE_LENGTH
    }

    /// What counts as one unit of error for every state.
    pub(crate) fn state_scales(&self) -> Vec<f64> {
        let set = &self.set;
        let ring = self.ring.free().map(|k| &RING_COORDINATES[k]);
        let cage = self.cage_coordinates().iter();
        let balls = (0..self.layout.count).flat_map(|_| self.element_coordinates());
        let all: Vec<_> = ring.chain(cage).chain(balls).collect();
        let unit = |moves: Moves| match moves {
            Moves::Itself => REFERENCE_LENGTH,
            Moves::PitchCircle => REFERENCE_LENGTH / set.pitch_radius,
            Moves::Surface => REFERENCE_LENGTH / set.radius,
        };
        let placed = || all.iter().filter(|c| c.position.is_some()).map(|c| unit(c.moves));
        let spins = all.iter().filter(|c| c.position.is_none()).map(|c| unit(c.moves));
        placed().chain(placed().chain(spins).map(|unit| unit * RATE_SCALE)).collect()
    }

    /// Orbit speed and speed of rotation about the axis of the bearing of balls that roll at the free contact angle, or as prescribed, rad/s.
    pub(crate) fn kinematic_speeds(&self, inputs: &InputValues) -> [f64; 2] {
        if !self.free {
            return [Input::OrbitSpeed, Input::SpinSpeed].map(|input| inputs.of(input));
        }
        if let Some(rollers) = &self.rollers {
            return rollers.kinematic_speeds(inputs);
        }
        let set = &self.set;
        let cos = math::cos(self.free_contact_angle());
        let gamma = set.radius * cos / set.pitch_radius;
        let [outer, inner] = [Input::OuterRingSpeed, Input::RingSpeed].map(|input| inputs.of(input));
        let orbit = 0.5 * (inner * (1.0 - gamma) + outer * (1.0 + gamma));
        let about_own = -0.5 * (inner - outer) * set.pitch_radius / set.radius * (1.0 - gamma * gamma);
        [orbit, orbit + about_own * cos]
    }

    /// Highest frequency of a ball between its races in rad/s, at the largest load of the scene; of prescribed ones that of the cage.
    pub(crate) fn contact_frequency(&self) -> f64 {
        if !self.free {
            return self.cage_frequency();
        }
        if let Some(rollers) = &self.rollers {
            return self.roller_frequency(rollers);
        }
        let largest = |input| self.inputs.largest(input);
        let sin = math::sin(self.free_contact_angle()).max(0.05);
        let held: f64 = (0..OF_RING).filter_map(|k| self.ring.held[k]).map(f64::abs).fold(0.0, f64::max);
        let count = self.element_count() as f64;
        let radial = math::hypot(largest(Input::LoadY), largest(Input::LoadZ));
        let moment = math::hypot(largest(Input::MomentY), largest(Input::MomentZ)) / self.pitch_radius();
        let axial = largest(Input::LoadX) + self.ring.spring(0.0)[0].abs();
        let largest_speed = largest(Input::RingSpeed).max(largest(Input::OuterRingSpeed));
        let [mass, _] = self.balls.inertia(0);
        let centrifugal = mass * self.pitch_radius() * (0.5 * largest_speed) * (0.5 * largest_speed);
        let load = (axial / sin + STRIBECK * (radial + moment / sin)) / count + centrifugal + 1.0;
        let stiffness = |race: &Race| {
            let elastic = &race.elastic[0];
            1.5 * elastic.rigidity * elastic.approach(load).max(held.min(1e-4)).sqrt()
        };
        (self.races.iter().map(stiffness).sum::<f64>() / mass).sqrt()
    }

    /// Orders and frequencies in rad/s of the waves of an elastic ring of the cage, free and at rest.
    pub(crate) fn ring_waves(&self) -> Vec<(u32, f64)> {
        self.cage.as_ref().map_or_else(Vec::new, |cage| cage.body.waves())
    }

    /// The highest of all frequencies, rad/s.
    pub(crate) fn highest_frequency(&self) -> f64 {
        let highest = self.contact_frequency().max(self.cage_frequency());
        self.ring_waves().iter().fold(highest, |highest, (_, wave)| highest.max(*wave))
    }

    /// Whether the contacts that set the highest frequency are damped.
    pub(crate) fn damped(&self) -> bool {
        self.scene.raceways.as_ref().is_some_and(|raceways| raceways.contact.damping.is_some())
    }
}
