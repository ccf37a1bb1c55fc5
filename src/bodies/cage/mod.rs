//! The cage: a rigid body in the plane, balanced or with its centre of mass apart from its geometric centre.
//!
//! ```text
//! m y_s'' = F_y,  m z_s'' = F_z,  I psi'' = M_s        about the centre of mass s = centre + u(psi)
//! ```
//!
//! Coordinates are those of the geometric centre, which turns about s, and those of the modes of an elastic ring (`ring_modes`).

mod names;
mod pocket_waves;
mod ring_modes;

pub(super) use names::of_mode;
pub(super) use ring_modes::RingModes;
pub(crate) use ring_modes::{MOST_MODES, along_factor};

use super::{
    BodyEnergy, BodyForces, BodyState, CENTRE, Coordinate, ElementSet, Fault, ForceSource, Input,
    InputValues, Moves, OnBody, Power, SharedBody, weight,
};
use crate::scalar::{Lanes, math};
use crate::scene::Scene;
use crate::space::{Motion, Wrench, rotate};
use nalgebra::DMatrixViewMut;
use pulp::Arch;
use ring_modes::Over;

/// The cage.
#[derive(Debug)]
pub(super) struct Cage {
    mass: f64,
    inertia: f64,
    /// Centre of mass in the axes of the cage, m.
    mass_eccentricity: Option<[f64; 2]>,
    /// Whether external force and torque are inputs.
    loaded: bool,
    /// Bending of its ring, if it is elastic.
    modes: Option<RingModes>,
    coordinates: Vec<Coordinate>,
    /// Pitch radius: further off it is outside of the bearing, m.
    reach: f64,
}

/// Number of coordinates of the motion of the whole body; those of modes follow.
pub(crate) const OF_MOTION: usize = 3;

const COORDINATES: [Coordinate; OF_MOTION] = [
    CENTRE[0],
    CENTRE[1],
    Coordinate {
        position: Some(["angle", "rad", "rotation angle since the start"]),
        rate: ["speed", "rad/s", "rotation speed"],
        moves: Moves::PitchCircle,
    },
];

const LOADS: [Input; 3] = [Input::CageForceY, Input::CageForceZ, Input::CageTorque];

impl Cage {
    /// The cage of a scene, if it has one, with pockets where these elements are at the start.
    #[expect(clippy::new_ret_no_self, reason = "an item of a list of bodies")]
    pub(super) fn new(scene: &Scene, elements: &ElementSet) -> Option<Box<dyn SharedBody>> {
        let cage = scene.cage.as_ref()?;
        let modes = cage
            .elastic_ring
            .as_ref()
            .map(|ring| RingModes::new(ring, cage.mass, elements.pitch_radius, &elements.reference_angles));
        let of_modes = modes.iter().flat_map(|modes| modes.orders()).flat_map(of_mode);
        Some(Box::new(Self {
            mass: cage.mass,
            inertia: cage.inertia,
            mass_eccentricity: cage.mass_eccentricity.map(|u| [u.y, u.z]),
            loaded: cage.load.is_some(),
            coordinates: COORDINATES.into_iter().chain(of_modes).collect(),
            reach: elements.pitch_radius,
            modes,
        }))
    }

    /// Centre of mass relative to the geometric centre at the angle `angle` (rad), global axes, m; `None` for a balanced
    /// cage.
    fn mass_offset(&self, angle: f64) -> Option<[f64; 2]> {
        let (sin, cos) = self.mass_eccentricity.map(|_| math::sin_cos(angle))?;
        self.mass_eccentricity.map(|u| rotate(u, sin, cos))
    }

    /// Accelerations of the motion by a wrench alone, with the centre of mass at `offset` (m) from the geometric centre, where a
    /// moment about the former turns the cage by `turn`.
    #[inline]
    fn response_at(
        &self,
        on_cage: &Wrench<f64>,
        offset: Option<[f64; 2]>,
        turn: impl FnOnce(f64) -> f64,
    ) -> [f64; OF_MOTION] {
        let [fy, fz] = on_cage.force;
        let [y, z] = [fy / self.mass, fz / self.mass];
        match offset {
            None => [y, z, turn(on_cage.moment)],
            Some(offset) => {
                // About the centre of mass, whose acceleration the forces give; the centre of the cage turns about it.
                let ([uy, uz], turning) = (offset, turn(about_mass(on_cage, offset)));
                [y + turning * uz, z - turning * uy, turning]
            }
        }
    }

    /// Its own coordinates and their rates.
    #[inline]
    fn of_modes<'a>(state: &BodyState<'a>) -> [&'a [f64]; 2] {
        [&state.q[OF_MOTION..], &state.v[OF_MOTION..]]
    }
}

/// Moment about the centre of mass at (`uy`, `uz`) from the geometric centre, of a wrench about the latter.
#[inline]
fn about_mass(on_cage: &Wrench<f64>, [uy, uz]: [f64; 2]) -> f64 {
    let [fy, fz] = on_cage.force;
    on_cage.moment - (uy * fz - uz * fy)
}

impl SharedBody for Cage {
    fn name(&self) -> &'static str {
        "cage"
    }

    fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    fn displacements(&self, j: usize) -> &[[f64; 2]] {
        self.modes.as_ref().map_or(&[], |modes| modes.displacements(j))
    }

    fn displace(&self, block: usize, amplitudes: &[f64], out: &mut [Lanes; 2], instructions: Arch) {
        if let Some(modes) = &self.modes {
            modes.displace(block, amplitudes, out, instructions);
        }
    }

    #[inline]
    fn motion(&self, q: &[f64], v: &[f64], _inputs: &InputValues) -> Motion<f64> {
        Motion { position: [q[0], q[1]], velocity: [v[0], v[1]], angle: q[2], speed: v[2] }
    }

    fn reach(&self) -> f64 {
        self.reach
    }

    fn lost(&self, _distance: f64) -> Fault {
        Fault::LostCage
    }

    fn mass(&self) -> Option<f64> {
        Some(self.mass)
    }

    fn add_external(&self, _state: &BodyState<'_>, inputs: &InputValues, on_body: &mut Wrench<f64>) {
        if self.loaded {
            let [y, z, moment] = LOADS.map(|input| inputs.of(input));
            on_body.add(&Wrench { force: [y, z], moment });
        }
    }

    fn respond(&self, forces: &mut [f64], q: &[f64]) {
        let on_cage = Wrench { force: [forces[0], forces[1]], moment: forces[2] };
        let (of_motion, of_modes) = forces.split_at_mut(OF_MOTION);
        let response = self.response_at(&on_cage, self.mass_offset(q[2]), |moment| match &self.modes {
            None => moment / self.inertia,
            Some(modes) => modes.respond(moment, self.inertia, &q[OF_MOTION..], of_modes),
        });
        of_motion.copy_from_slice(&response);
    }

    fn accelerate(&self, on_body: &OnBody<'_>, state: &BodyState<'_>, gravity: [f64; 2], a: &mut [f64]) {
        let offset = self.mass_offset(state.q[2]);
        let (a, of_modes) = a.split_at_mut(OF_MOTION);
        let response = self.response_at(on_body.wrench, offset, |moment| match &self.modes {
            None => moment / self.inertia,
            Some(modes) => {
                let turned = [moment, self.inertia, state.v[2]];
                modes.accelerate(turned, on_body.coordinates, Self::of_modes(state), of_modes)
            }
        });
        a.copy_from_slice(&response);
        a[0] += gravity[0];
        a[1] += gravity[1];
        if let Some([uy, uz]) = offset {
            let speed = state.v[2];
            a[0] += speed * speed * uy;
            a[1] += speed * speed * uz;
        }
    }

    fn wrench_for(&self, a: &dyn Fn(usize) -> f64, state: &BodyState<'_>, gravity: [f64; 2]) -> Wrench<f64> {
        let [uy, uz] = self.mass_offset(state.q[2]).unwrap_or_default();
        let ([ay, az, turning], square) = ([0, 1, 2].map(a), state.v[2] * state.v[2]);
        let force = [
            self.mass * (ay - gravity[0] - turning * uz - square * uy),
            self.mass * (az - gravity[1] + turning * uy - square * uz),
        ];
        let turned = match &self.modes {
            None => self.inertia * turning,
            Some(modes) => {
                let turned = [turning, self.inertia, state.v[2]];
                modes.moment_for(turned, Self::of_modes(state), |k| a(OF_MOTION + k))
            }
        };
        Wrench { force, moment: turned + uy * force[1] - uz * force[0] }
    }

    fn is_balanced(&self) -> bool {
        self.mass_eccentricity.is_none() && self.modes.is_none()
    }

    fn add_damping(&self, add: &mut dyn FnMut([usize; 2], f64)) {
        for (k, damping) in self.modes.iter().flat_map(|modes| modes.damping()).enumerate() {
            add([OF_MOTION + k; 2], damping);
        }
    }

    /// The accelerations of an unbalanced cage change with its angle and speed, those of an elastic one with its modes.
    fn add_inertial_slopes(
        &self,
        on_body: &OnBody<'_>,
        state: &BodyState<'_>,
        over_position: DMatrixViewMut<'_, f64>,
        over_velocity: DMatrixViewMut<'_, f64>,
    ) {
        let [mut over_position, mut over_velocity] = [over_position, over_velocity];
        let offset = self.mass_offset(state.q[2]);
        let moment = offset.map_or(on_body.wrench.moment, |offset| about_mass(on_body.wrench, offset));
        // Angular acceleration, and what a moment about the centre of mass makes of it in N m.
        let (mut turning, mut per_turn) = (moment / self.inertia, self.inertia);
        if let Some(modes) = &self.modes {
            let turned = [moment, self.inertia, state.v[2]];
            let at = Self::of_modes(state);
            let [uy, uz] = offset.unwrap_or_default();
            let mut per_moment = [0.0; MOST_MODES];
            modes.slopes(turned, on_body.coordinates, at, |over, turned, of_modes| {
                let (rate, column) = match over {
                    Over::Moment => {
                        per_turn = 1.0 / turned;
                        per_moment[..of_modes.len()].copy_from_slice(of_modes);
                        return;
                    }
                    Over::Speed => (true, 2),
                    Over::Coordinate(k) => (false, OF_MOTION + k),
                    Over::Rate(k) => (true, OF_MOTION + k),
                };
                let part = if rate { &mut over_velocity } else { &mut over_position };
                let mut add = |row: usize, slope: f64| part[(row, column)] += slope;
                add(0, turned * uz);
                add(1, -turned * uy);
                add(2, turned);
                of_modes.iter().enumerate().for_each(|(k, a)| add(OF_MOTION + k, *a));
            });
            if offset.is_some() {
                // The moment about the centre of mass changes with the angle.
                let ([fy, fz], n) = (on_body.wrench.force, at[0].len());
                let rate = uz * fz + uy * fy;
                per_moment[..n].iter().enumerate().for_each(|(k, a)| {
                    over_position[(OF_MOTION + k, 2)] += a * rate;
                });
                let mut a = [0.0; MOST_MODES];
                turning = modes.accelerate(turned, on_body.coordinates, at, &mut a[..n]);
            }
        }
        let Some([uy, uz]) = offset else { return };
        let [fy, fz] = on_body.wrench.force;
        // The offset turns: du = (-uz, uy) dangle.
        let turning_rate = (uz * fz + uy * fy) / per_turn;
        let speed = state.v[2];
        over_position[(2, 2)] += turning_rate;
        over_position[(0, 2)] += turning_rate * uz + turning * uy - speed * speed * uz;
        over_position[(1, 2)] += speed * speed * uy + turning * uz - turning_rate * uy;
        over_velocity[(0, 2)] += 2.0 * speed * uy;
        over_velocity[(1, 2)] += 2.0 * speed * uz;
    }

    fn energy(&self, state: &BodyState<'_>, gravity: [f64; 2]) -> BodyEnergy {
        let [uy, uz] = self.mass_offset(state.q[2]).unwrap_or_default();
        let (position, velocity, speed) = (state.motion.position, state.motion.velocity, state.v[2]);
        let (y, z) = (velocity[0] - speed * uz, velocity[1] + speed * uy);
        let [bending, elastic] =
            self.modes.as_ref().map_or([0.0; 2], |modes| modes.energy(speed, Self::of_modes(state)));
        BodyEnergy {
            kinetic: 0.5 * (self.mass * (y * y + z * z) + self.inertia * speed * speed) + bending,
            elastic,
            potential: BodyEnergy::of_weight(self.mass, gravity, [position[0] + uy, position[1] + uz]),
        }
    }

    fn add_powers(&self, state: &BodyState<'_>, inputs: &InputValues, powers: &mut [f64]) {
        if self.loaded {
            let [vy, vz] = state.motion.velocity;
            let speeds = [vy, vz, state.v[2]];
            powers[Power::Loads as usize] +=
                LOADS.iter().zip(speeds).map(|(input, v)| inputs.of(*input) * v).sum::<f64>();
        }
        if let Some(modes) = &self.modes {
            let [_, rates] = Self::of_modes(state);
            powers[Power::CageBending as usize] -=
                modes.damping().zip(rates).map(|(damping, rate)| damping * rate * rate).sum::<f64>();
        }
    }

    fn report(&self, state: &BodyState<'_>, inputs: &InputValues, gravity: [f64; 2], out: &mut BodyForces) {
        let [y, z, _] = weight(self.mass, gravity);
        let [uy, uz] = self.mass_offset(state.q[2]).unwrap_or_default();
        out[ForceSource::Gravity as usize] = [y, z, uy * z - uz * y];
        if self.loaded {
            out[ForceSource::Load as usize] = LOADS.map(|input| inputs.of(input));
        }
    }

    fn load_rates(&self, _inputs: &InputValues, rates: &InputValues) -> [f64; 3] {
        LOADS.map(|input| rates.of(input))
    }

    fn frequency_on(&self, radial: f64, turning: f64, lever: f64) -> f64 {
        turning * (1.0 / self.mass + lever * lever / self.inertia) + radial / self.mass
    }

    fn waves(&self) -> Vec<(u32, f64)> {
        self.modes.as_ref().map_or_else(Vec::new, RingModes::frequencies)
    }
}

#[cfg(test)]
mod tests;
