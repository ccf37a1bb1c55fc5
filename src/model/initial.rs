//! Start of a run: kinematic speeds, and on request the static equilibrium of ring and rollers.

use super::{HostInputs, Model, RingBody};
use crate::contact::raceway::{RingMotion, RollerMotion};
use crate::contact::rotate;
use crate::error::{Error, Result, Status};
use crate::scene::RingStart;

/// Steps for the equilibrium of the ring; about twenty are usual.
const MAX_ITERATIONS: usize = 500;
/// Accepted residual force in N, far below any load of interest.
const NEGLIGIBLE_FORCE: f64 = 1e-9;
/// Accepted residual force relative to the load.
const TOLERANCE: f64 = 1e-10;

impl Model {
    /// State vector at the start of the run.
    ///
    /// # Errors
    /// [`Status::BadScene`] when no static equilibrium is found.
    pub fn initial_state(&self) -> Result<Vec<f64>> {
        let inputs = self.inputs_at(0.0, &HostInputs::default());
        let layout = &self.layout;
        let mut state = vec![0.0; layout.states()];
        let (q, v) = state.split_at_mut(layout.positions());
        let orbit = self.orbit_ratio() * inputs.ring_speed;
        let cage = self.scene.initial.cage;
        for j in 0..layout.count {
            let (sin, cos) = self.reference_angles[j].sin_cos();
            // The pocket of a cage off centre lies beside its angle.
            let beside = cage.z * cos - cage.y * sin;
            q[layout.roller(j) + 1] = (beside / self.geometry.pitch_radius).asin();
            v[layout.roller(j) + 1] = orbit;
            v[layout.spin(j)] = self.spin_ratio() * inputs.ring_speed;
        }
        if let Some(c) = layout.cage {
            q[c] = cage.y;
            q[c + 1] = cage.z;
            v[c + 2] = orbit;
        }
        if self.scene.initial.inner_ring == RingStart::Equilibrium
            && let (Some(i), RingBody::Free { mass, .. }) = (layout.ring, self.ring)
        {
            let load = [inputs.load[0] + mass * self.gravity[0], inputs.load[1] + mass * self.gravity[1]];
            let centrifugal = self.roller_mass * self.geometry.pitch_radius * orbit * orbit;
            let ring = self.equilibrium(q, load, centrifugal)?;
            q[i] = ring[0];
            q[i + 1] = ring[1];
            for j in 0..layout.count {
                let (sin, cos) = self.azimuth(q, j).sin_cos();
                let local = rotate(ring, -sin, cos);
                q[layout.roller(j)] = self.roller_balance(local, centrifugal).radial_offset;
            }
        }
        Ok(state)
    }

    /// Angle of roller `j` about the bearing, rad.
    pub(super) fn azimuth(&self, q: &[f64], j: usize) -> f64 {
        self.reference_angles[j] + q[self.layout.roller(j) + 1]
    }

    /// Position of the ring, m, at which the rollers carry `load` (N): the minimum of the potential energy, found by
    /// Newton steps whose length a Levenberg-Marquardt parameter controls.
    fn equilibrium(&self, q: &[f64], load: [f64; 2], centrifugal: f64) -> Result<[f64; 2]> {
        let size = load[0].hypot(load[1]);
        if size == 0.0 {
            return Ok([0.0; 2]);
        }
        let reach = (2.0 * self.geometry.gap).max(0.0) + 2.0 * self.inner.elastic.approach(size);
        let mut x = [0.0; 2];
        let mut here = self.ring_balance(q, x, load, centrifugal);
        let mut parameter = size / reach;
        for _ in 0..MAX_ITERATIONS {
            let residual = here.force[0].hypot(here.force[1]);
            if residual <= TOLERANCE * size + NEGLIGIBLE_FORCE {
                return Ok(x);
            }
            let [kyy, kyz, kzz] = here.stiffness;
            let (kyy, kzz) = (kyy + parameter, kzz + parameter);
            let determinant = kyy * kzz - kyz * kyz;
            let [fy, fz] = here.force;
            let trial =
                [x[0] + (kzz * fy - kyz * fz) / determinant, x[1] + (kyy * fz - kyz * fy) / determinant];
            let there = self.ring_balance(q, trial, load, centrifugal);
            // Close to the minimum the energy drowns in round-off, and the force alone tells progress.
            let better = there.energy < here.energy || there.force[0].hypot(there.force[1]) < 0.5 * residual;
            if better {
                (x, here) = (trial, there);
            }
            parameter *= if better { 0.2 } else { 5.0 };
        }
        let text = format!(
            "initial.inner_ring: no static equilibrium found for a load of ({:?}, {:?}) N; start 'centred' instead",
            load[0], load[1]
        );
        Err(Error::new(Status::BadScene, text))
    }

    /// Energy, force and stiffness of the ring at `x` under `load` and all rollers.
    fn ring_balance(&self, q: &[f64], x: [f64; 2], load: [f64; 2], centrifugal: f64) -> RingBalance {
        let mut sum =
            RingBalance { energy: -(load[0] * x[0] + load[1] * x[1]), force: load, stiffness: [0.0; 3] };
        for j in 0..self.layout.count {
            let (sin, cos) = self.azimuth(q, j).sin_cos();
            let roller = self.roller_balance(rotate(x, -sin, cos), centrifugal);
            let [ny, nz] = rotate(roller.normal, sin, cos);
            sum.energy += roller.energy;
            sum.force[0] += roller.load * ny;
            sum.force[1] += roller.load * nz;
            sum.stiffness[0] += roller.stiffness * ny * ny;
            sum.stiffness[1] += roller.stiffness * ny * nz;
            sum.stiffness[2] += roller.stiffness * nz * nz;
        }
        sum
    }

    /// Radial equilibrium of a roller, with the ring centre at `ring` (m) in the roller's local frame.
    fn roller_balance(&self, ring: [f64; 2], centrifugal: f64) -> RollerBalance {
        let (outer, inner) = (&self.outer.elastic, &self.inner.elastic);
        let g = &self.geometry;
        // The outward force of the roller falls with its offset: bisection between resting outside and squeezed in.
        let state = |offset: f64| {
            let still =
                RollerMotion { radial_offset: offset, radial_speed: 0.0, orbit_speed: 0.0, spin_speed: 0.0 };
            let still_ring = RingMotion { position: ring, velocity: [0.0; 2], speed: 0.0 };
            let (motion, frame) = g.inner(&still, &still_ring);
            (inner.load(motion.delta), outer.load(offset - g.gap), motion.delta, frame.normal)
        };
        let resting = g.gap + outer.approach(centrifugal);
        let squeezed = ring[0].abs() + ring[1].abs() + 2.0 * g.gap.abs();
        let (mut low, mut high) = (resting, resting + squeezed);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            let (on_inner, on_outer, _, normal) = state(middle);
            if centrifugal - on_inner * normal[0] > on_outer {
                low = middle;
            } else {
                high = middle;
            }
        }
        let (load, on_outer, delta, normal) = state(high);
        // Palmgren's law: the energy at the approach delta is 9/19 Q delta.
        let energy = 9.0 / 19.0 * (load * delta.max(0.0) + on_outer * (high - g.gap).max(0.0))
            - centrifugal * (high - g.gap);
        let stiffness = if load > 0.0 {
            1.0 / (1.0 / inner.stiffness_at_load(load) + 1.0 / outer.stiffness_at_load(on_outer))
        } else {
            0.0
        };
        RollerBalance { load, stiffness, energy, normal, radial_offset: high }
    }
}

struct RingBalance {
    /// Potential energy, J.
    energy: f64,
    /// Sum of load and contact forces (y, z), N.
    force: [f64; 2],
    /// Stiffness of the contacts (yy, yz, zz), N/m.
    stiffness: [f64; 3],
}

struct RollerBalance {
    /// Force on the inner raceway, N.
    load: f64,
    /// Stiffness of both contacts in series, N/m.
    stiffness: f64,
    /// Elastic energy of both contacts less the work of the centrifugal force, J.
    energy: f64,
    /// From the roller to the ring, local frame: the direction of the force on the ring.
    normal: [f64; 2],
    /// Offset from the pitch circle, m.
    radial_offset: f64,
}
