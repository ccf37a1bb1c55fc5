//! The cage: a rigid body in the plane, balanced or with its centre of mass apart from its geometric centre.
//!
//! ```text
//! m y_s'' = F_y,  m z_s'' = F_z,  I psi'' = M_s        about the centre of mass s = centre + u(psi)
//! ```
//!
//! Coordinates are those of the geometric centre, which turns about s.

use super::{
    BodyEnergy, BodyForces, BodyState, CENTRE, Coordinate, Fault, ForceSource, Input, InputValues, Moves,
    Power, SharedBody, weight,
};
use crate::scalar::math;
use crate::scene::Scene;
use crate::space::{Motion, Wrench, rotate};
use nalgebra::DMatrixViewMut;

/// The cage.
#[derive(Debug)]
pub(super) struct Cage {
    mass: f64,
    inertia: f64,
    /// Centre of mass in the axes of the cage, m.
    mass_eccentricity: Option<[f64; 2]>,
    /// Whether external force and torque are inputs.
    loaded: bool,
}

const COORDINATES: [Coordinate; 3] = [
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
    /// The cage of a scene, if it has one.
    #[expect(clippy::new_ret_no_self, reason = "an item of a list of bodies")]
    pub(super) fn new(scene: &Scene) -> Option<Box<dyn SharedBody>> {
        let cage = scene.cage.as_ref()?;
        Some(Box::new(Self {
            mass: cage.mass,
            inertia: cage.inertia,
            mass_eccentricity: cage.mass_eccentricity.map(|u| [u.y, u.z]),
            loaded: cage.load.is_some(),
        }))
    }

    /// Centre of mass relative to the geometric centre at the angle `angle` (rad), global axes, m; `None` for a balanced
    /// cage.
    fn mass_offset(&self, angle: f64) -> Option<[f64; 2]> {
        let (sin, cos) = self.mass_eccentricity.map(|_| math::sin_cos(angle))?;
        self.mass_eccentricity.map(|u| rotate(u, sin, cos))
    }

    /// Accelerations by a wrench alone, with the centre of mass at `offset` (m) from the geometric centre.
    #[inline]
    fn response_at(&self, on_cage: &Wrench<f64>, offset: Option<[f64; 2]>) -> [f64; 3] {
        let [fy, fz] = on_cage.force;
        let [y, z] = [fy / self.mass, fz / self.mass];
        match offset {
            None => [y, z, on_cage.moment / self.inertia],
            Some([uy, uz]) => {
                // About the centre of mass, whose acceleration the forces give; the centre of the cage turns about it.
                let turning = self.turning(on_cage, [uy, uz]);
                [y + turning * uz, z - turning * uy, turning]
            }
        }
    }

    /// Angular acceleration by a wrench about the geometric centre, with the centre of mass at (`uy`, `uz`) from there.
    fn turning(&self, on_cage: &Wrench<f64>, [uy, uz]: [f64; 2]) -> f64 {
        let [fy, fz] = on_cage.force;
        (on_cage.moment - (uy * fz - uz * fy)) / self.inertia
    }
}

impl SharedBody for Cage {
    fn name(&self) -> &'static str {
        "cage"
    }

    fn coordinates(&self) -> &[Coordinate] {
        &COORDINATES
    }

    #[inline]
    fn motion(&self, q: &[f64], v: &[f64], _inputs: &InputValues) -> Motion<f64> {
        Motion { position: [q[0], q[1]], velocity: [v[0], v[1]], angle: q[2], speed: v[2] }
    }

    fn lost(&self) -> Fault {
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
        forces.copy_from_slice(&self.response_at(&on_cage, self.mass_offset(q[2])));
    }

    fn accelerate(&self, on_body: &Wrench<f64>, state: &BodyState<'_>, gravity: [f64; 2], a: &mut [f64]) {
        let offset = self.mass_offset(state.q[2]);
        a[..3].copy_from_slice(&self.response_at(on_body, offset));
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
        Wrench { force, moment: self.inertia * turning + uy * force[1] - uz * force[0] }
    }

    fn is_balanced(&self) -> bool {
        self.mass_eccentricity.is_none()
    }

    /// The accelerations of an unbalanced cage change with its angle and speed.
    fn add_inertial_slopes(
        &self,
        on_body: &Wrench<f64>,
        state: &BodyState<'_>,
        mut over_position: DMatrixViewMut<'_, f64>,
        mut over_velocity: DMatrixViewMut<'_, f64>,
    ) {
        let Some([uy, uz]) = self.mass_offset(state.q[2]) else { return };
        let [fy, fz] = on_body.force;
        let turning = self.turning(on_body, [uy, uz]);
        // The offset turns: du = (-uz, uy) dangle.
        let turning_rate = (uz * fz + uy * fy) / self.inertia;
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
        BodyEnergy {
            kinetic: 0.5 * (self.mass * (y * y + z * z) + self.inertia * speed * speed),
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
    }

    fn report(&self, state: &BodyState<'_>, inputs: &InputValues, gravity: [f64; 2], out: &mut BodyForces) {
        let [y, z, _] = weight(self.mass, gravity);
        let [uy, uz] = self.mass_offset(state.q[2]).unwrap_or_default();
        out[ForceSource::Gravity as usize] = [y, z, uy * z - uz * y];
        if self.loaded {
            out[ForceSource::Load as usize] = LOADS.map(|input| inputs.of(input));
        }
    }

    fn load_inputs(&self) -> [Option<Input>; 3] {
        LOADS.map(Some)
    }

    fn frequency_on(&self, radial: f64, turning: f64, lever: f64) -> f64 {
        turning * (1.0 / self.mass + lever * lever / self.inertia) + radial / self.mass
    }
}
