//! The motion of an averaged cage in axes at rest, and that among single elements.

use super::{Averaged, LEAD, State, failed};
use crate::bodies::CAGE_MOTION;
use crate::error::Result;
use crate::scalar::math;
use crate::space::rotate;
use nalgebra::DVector;

impl Averaged {
    /// The motion of a whirl in axes at rest, with the elements where they are at the start: place, angle and waves, and their
    /// rates.
    pub(in crate::whirl) fn at_rest(&self, u: &[f64]) -> Vec<f64> {
        let (state, _) = self.state(u);
        let places = [state.position[0], state.position[1], -state.lead];
        let rates = [state.velocity[0], state.velocity[1], state.speed];
        places.into_iter().chain(state.waves).chain(rates).chain(state.rates).collect()
    }

    /// Scales of its numbers, with `second` in place of that of the second.
    pub(in crate::whirl) fn motion_scales(&self, second: f64) -> Vec<f64> {
        let waves = 2 * self.orders.len();
        let places = [1e-6, if second > 0.0 { 1e-2 * second } else { 1e-6 }, LEAD];
        let rates = [1e-2, 1e-2, 1.0];
        let of = |scale: f64| std::iter::repeat_n(scale, waves);
        places.into_iter().chain(of(1e-6)).chain(rates).chain(of(1e-2)).collect()
    }

    /// Rates of the motion in axes at rest at the time `t`, s, among single elements.
    pub(in crate::whirl) fn full_rate(&mut self, t: f64, x: &DVector<f64>) -> Result<DVector<f64>> {
        self.limits.check()?;
        let n = x.len() / 2;
        self.inputs.angles[0] = self.orbit * t;
        let (q, v) = x.as_slice().split_at(n);
        let Self { plane, inputs, ws, a, .. } = self;
        plane.accelerations(inputs, q, v, ws, a).map_err(|fault| failed(fault, plane))?;
        Ok(DVector::from_iterator(2 * n, v.iter().chain(&self.a[..n]).copied()))
    }

    /// Turns a motion back after one element has passed in this time, s.
    pub(in crate::whirl) fn turn_back(&self, x: &mut DVector<f64>, passage: f64) {
        let n = x.len() / 2;
        let passed = if self.passes_forwards { self.pitch } else { -self.pitch };
        let (sin, cos) = math::sin_cos(self.orbit * passage - passed);
        for at in [0, n] {
            let [y, z] = rotate([x[at], x[at + 1]], -sin, cos);
            (x[at], x[at + 1]) = (y, z);
        }
        x[2] -= self.orbit * passage;
        for (k, order) in self.orders.iter().enumerate() {
            // Pockets are alike one place further.
            let (sin, cos) = math::sin_cos(f64::from(*order) * passed);
            for at in [CAGE_MOTION + 2 * k, n + CAGE_MOTION + 2 * k] {
                let [a, b] = rotate([x[at], x[at + 1]], sin, cos);
                (x[at], x[at + 1]) = (a, b);
            }
        }
    }

    /// Numbers of the state in axes at rest: place, velocity, lead, speed, waves and their rates.
    pub(in crate::whirl) fn averaged_at_rest(&self, u: &[f64]) -> Vec<f64> {
        self.state(u).0.flat()
    }

    /// Rate of that state under gravity (m/s^2), with the waves in axes at rest.
    pub(in crate::whirl) fn rate_at_rest(
        &mut self,
        x: &DVector<f64>,
        gravity: [f64; 2],
    ) -> Result<DVector<f64>> {
        let state = State::of(x.as_slice(), 2 * self.orders.len());
        let mut rate = self.rate(&state, -state.speed)?;
        rate[2] += gravity[0];
        rate[3] += gravity[1];
        Ok(DVector::from_vec(rate))
    }
}
