//! Start of a run: kinematic speeds, and on request the static equilibrium of ring and rollers.

use super::{HostInputs, Model, RingBody};
use crate::error::{Error, Result, Status};
use crate::scene::RingStart;
use std::f64::consts::TAU;

/// Newton steps for the equilibrium of the ring; about ten are usual.
const MAX_ITERATIONS: usize = 200;
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
        for j in 0..layout.count {
            q[layout.roller(j) + 1] =
                self.scene.initial.first_roller_angle + TAU * j as f64 / layout.count as f64;
            v[layout.roller(j) + 1] = orbit;
            v[layout.spin(j)] = self.spin_ratio() * inputs.ring_speed;
        }
        if let Some(c) = layout.cage {
            q[c] = self.scene.initial.cage.y;
            q[c + 1] = self.scene.initial.cage.z;
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
                let (sin, cos) = q[layout.roller(j) + 1].sin_cos();
                let towards = ring[0] * cos + ring[1] * sin;
                q[layout.roller(j)] = self.roller_balance(towards, centrifugal).radial_offset;
            }
        }
        Ok(state)
    }

    /// Position of the ring, m, at which the rollers carry `load` (N).
    fn equilibrium(&self, q: &[f64], load: [f64; 2], centrifugal: f64) -> Result<[f64; 2]> {
        let size = load[0].hypot(load[1]);
        if size == 0.0 {
            return Ok([0.0; 2]);
        }
        let clearance = 2.0 * self.geometry.gap;
        let reach = clearance.max(0.0) + self.inner.elastic.approach(size);
        let mut x = load.map(|f| f / size * reach);
        for _ in 0..MAX_ITERATIONS {
            let (force, stiffness) = self.ring_reaction(q, x, centrifugal);
            let residual = [load[0] + force[0], load[1] + force[1]];
            if residual[0].hypot(residual[1]) <= TOLERANCE * size {
                return Ok(x);
            }
            // A little isotropic stiffness keeps the matrix regular when one roller or none carries load.
            let [kyy, kyz, kzz] = stiffness;
            let floor = 1e-9 * (kyy + kzz) + size / (reach + 1e-6) * 1e-6;
            let (kyy, kzz) = (kyy + floor, kzz + floor);
            let determinant = kyy * kzz - kyz * kyz;
            let mut step = [
                (kzz * residual[0] - kyz * residual[1]) / determinant,
                (kyy * residual[1] - kyz * residual[0]) / determinant,
            ];
            let length = step[0].hypot(step[1]);
            let longest = 0.5 * reach + 1e-7;
            if length > longest {
                step = step.map(|s| s * longest / length);
            }
            x = [x[0] + step[0], x[1] + step[1]];
        }
        let text = format!(
            "initial.inner_ring: no static equilibrium found for a load of ({:?}, {:?}) N; start 'centred' instead",
            load[0], load[1]
        );
        Err(Error::new(Status::BadScene, text))
    }

    /// Force of all rollers on the ring at `x` and its stiffness (yy, yz, zz), both positive definite.
    fn ring_reaction(&self, q: &[f64], x: [f64; 2], centrifugal: f64) -> ([f64; 2], [f64; 3]) {
        let mut force = [0.0; 2];
        let mut stiffness = [0.0; 3];
        for j in 0..self.layout.count {
            let (sin, cos) = q[self.layout.roller(j) + 1].sin_cos();
            let balance = self.roller_balance(x[0] * cos + x[1] * sin, centrifugal);
            force[0] -= balance.load * cos;
            force[1] -= balance.load * sin;
            stiffness[0] += balance.stiffness * cos * cos;
            stiffness[1] += balance.stiffness * cos * sin;
            stiffness[2] += balance.stiffness * sin * sin;
        }
        (force, stiffness)
    }

    /// Radial equilibrium of a roller when the ring is displaced by `towards` m in its direction.
    fn roller_balance(&self, towards: f64, centrifugal: f64) -> RollerBalance {
        let (outer, inner) = (&self.outer.elastic, &self.inner.elastic);
        let resting = self.geometry.gap + outer.approach(centrifugal);
        let squeeze = towards - self.geometry.gap - resting;
        if squeeze <= 0.0 {
            return RollerBalance { load: 0.0, stiffness: 0.0, radial_offset: resting };
        }
        // approach_i(Q) + approach_o(Q + F_c) - approach_o(F_c) grows with Q: bisection in ln Q never fails.
        let excess = |q: f64| {
            inner.approach(q) + outer.approach(q + centrifugal) - outer.approach(centrifugal) - squeeze
        };
        let (mut low, mut high) = (1e-12, inner.load(squeeze).max(1e-12));
        for _ in 0..200 {
            let middle = (low * high).sqrt();
            if excess(middle) > 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        let load = (low * high).sqrt();
        let compliance =
            1.0 / inner.stiffness_at_load(load) + 1.0 / outer.stiffness_at_load(load + centrifugal);
        RollerBalance {
            load,
            stiffness: 1.0 / compliance,
            radial_offset: self.geometry.gap + outer.approach(load + centrifugal),
        }
    }
}

struct RollerBalance {
    /// Force on the inner raceway, N.
    load: f64,
    /// Stiffness of both contacts in series, N/m.
    stiffness: f64,
    /// Offset from the pitch circle, m.
    radial_offset: f64,
}
