//! Explicit Runge-Kutta pair of order 5(4) by Dormand and Prince, with its fourth-order dense output.
//!
//! Coefficients: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, table II.5.2 and
//! section II.6.

use crate::integrate::driver::control::{ErrorNorm, Estimate, Law};
use crate::integrate::{Kept, Observed, Samples, Stepper, add_weighted, zero_works};
use crate::stored::stored;

const C: [f64; 7] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];
const A: [[f64; 6]; 7] = [
    [0.0; 6],
    [0.2, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];
/// Fifth-order minus fourth-order weights.
const E: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0];
/// Weights of the last dense output polynomial.
const D: [f64; 7] = [
    -12715105075.0 / 11282082432.0,
    0.0,
    87487479700.0 / 32700410799.0,
    -10690763975.0 / 1880347072.0,
    701980252875.0 / 199316789632.0,
    -1453857185.0 / 822651844.0,
    69997945.0 / 29380423.0,
];

/// Stages at which watched quantities are sampled, at 0.3, 0.8 and 1 of the step; their weights are exact for parabolas, and none
/// of them is of the step before.
const SAMPLED: [usize; 3] = [2, 3, 6];
const SAMPLE_WEIGHTS: [f64; 3] = [2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0];

/// The method's memory.
#[derive(Clone, Debug)]
pub struct DormandPrince {
    positions: usize,
    norm: ErrorNorm,
    /// State at the end of the last accepted step, and at its start.
    state: Vec<f64>,
    before: Vec<f64>,
    trial: Vec<f64>,
    /// Rates at the seven stages; the first is that of `state`.
    k: [Vec<f64>; 7],
    a: Vec<f64>,
    /// Powers at the stages, and their works.
    powers: [Vec<f64>; 7],
    works: Vec<f64>,
    samples: Samples,
    /// Polynomials of the last accepted step and of the attempt.
    dense: [Vec<f64>; 3],
    trial_dense: [Vec<f64>; 3],
}

impl DormandPrince {
    /// Evaluations of an attempt.
    pub const EVALUATIONS: f64 = 6.0;

    /// Memory for a system with an absolute tolerance for every state.
    pub fn new<S: Observed>(system: &S, tolerance: &[f64]) -> Self {
        let n = system.positions() + system.velocities();
        let zeros = || vec![0.0; n];
        Self {
            positions: system.positions(),
            norm: ErrorNorm::new(system, tolerance),
            state: zeros(),
            before: zeros(),
            trial: zeros(),
            k: std::array::from_fn(|_| zeros()),
            a: vec![0.0; system.velocities()],
            powers: std::array::from_fn(|_| zero_works(system)),
            works: zero_works(system),
            samples: Samples::new(system.watched(), SAMPLED.len()),
            dense: std::array::from_fn(|_| zeros()),
            trial_dense: std::array::from_fn(|_| zeros()),
        }
    }

    fn rate<S: Observed>(
        system: &mut S,
        t: f64,
        positions: usize,
        state: &[f64],
        a: &mut [f64],
        rate: &mut [f64],
    ) -> Result<(), S::Fault> {
        let (q, v) = state.split_at(positions);
        system.accelerations(t, q, v, a)?;
        rate[..positions].copy_from_slice(&v[..positions]);
        rate[positions..].copy_from_slice(a);
        Ok(())
    }
}

/// Sums of vectors with these weights, element by element.
fn weigh(vectors: &[Vec<f64>], weights: &[f64], out: &mut [f64]) {
    out.fill(0.0);
    for (x, weight) in vectors.iter().zip(weights) {
        add_weighted(out, *weight, x);
    }
}

/// State at the fraction `theta` of the step with this dense output.
fn interpolate([start, end]: [&[f64]; 2], dense: [&[f64]; 3], theta: f64, out: &mut [f64]) {
    let (x, y) = (theta, 1.0 - theta);
    let [d2, d3, d4] = dense;
    for (i, out) in out.iter_mut().enumerate() {
        *out = start[i] + x * (end[i] - start[i] + y * (d2[i] + x * (d3[i] + y * d4[i])));
    }
}

impl<S: Observed> Stepper<S> for DormandPrince {
    fn set_state(&mut self, state: &[f64]) {
        self.state.copy_from_slice(state);
        for part in &mut self.dense {
            part.fill(0.0);
        }
        self.before.copy_from_slice(state);
    }

    fn refresh(&mut self, system: &mut S, t: f64) -> Result<(), S::Fault> {
        let Self { positions, state, a, k, powers, .. } = self;
        Self::rate(system, t, *positions, state, a, &mut k[0])?;
        let (q, v) = state.split_at(*positions);
        system.powers(q, v, None, &mut powers[0]);
        Ok(())
    }

    fn attempt(&mut self, system: &mut S, t: f64, h: f64, t_last: f64) -> Result<Option<Estimate>, S::Fault> {
        for stage in 1..7 {
            let (done, rest) = self.k.split_at_mut(stage);
            weigh(done, &A[stage], &mut self.trial);
            for (trial, start) in self.trial.iter_mut().zip(&self.state) {
                *trial = start + h * *trial;
            }
            let time = (t + C[stage] * h).min(t_last);
            Self::rate(system, time, self.positions, &self.trial, &mut self.a, &mut rest[0])?;
            // Those of the last stage are the first ones of the next step.
            if stage == 6 || A[6][stage] != 0.0 {
                let (q, v) = self.trial.split_at(self.positions);
                system.powers(q, v, None, &mut self.powers[stage]);
            }
            if let Some(place) = SAMPLED.iter().position(|s| *s == stage)
                && let Some(row) = self.samples.row(place)
            {
                let (q, v) = self.trial.split_at(self.positions);
                system.watch(q, v, None, row);
            }
        }
        self.samples.weigh(&SAMPLE_WEIGHTS);
        self.works.fill(0.0);
        for (x, weight) in self.powers.iter().zip(A[6]) {
            add_weighted(&mut self.works, h * weight, x);
        }
        let [d2, d3, d4] = &mut self.trial_dense;
        // The room of the last one holds the error first.
        weigh(&self.k, &E, d4);
        let estimate = self.norm.of(|i| h * d4[i]);
        weigh(&self.k, &D, d4);
        for i in 0..self.state.len() {
            let change = self.trial[i] - self.state[i];
            d2[i] = h * self.k[0][i] - change;
            d3[i] = change - h * self.k[6][i] - d2[i];
            d4[i] *= h;
        }
        Ok(Some(estimate))
    }

    fn accept(&mut self) {
        std::mem::swap(&mut self.before, &mut self.state);
        std::mem::swap(&mut self.state, &mut self.trial);
        std::mem::swap(&mut self.dense, &mut self.trial_dense);
        self.k.swap(0, 6);
        self.powers.swap(0, 6);
    }

    fn works(&self) -> &[f64] {
        &self.works
    }

    fn samples(&self) -> &Samples {
        &self.samples
    }

    fn state(&self) -> &[f64] {
        &self.state
    }

    fn interpolate(&self, theta: f64, out: &mut [f64]) {
        let dense = self.dense.each_ref().map(Vec::as_slice);
        interpolate([&self.before, &self.state], dense, theta, out);
    }

    fn keep(&self, out: &mut Vec<f64>) {
        self.dense.iter().for_each(|part| out.extend_from_slice(part));
    }

    fn recall(&self, kept: &Kept<'_>, theta: f64, out: &mut [f64]) {
        interpolate([kept.start, kept.end], kept.parts(), theta, out);
    }

    fn control(&self) -> Law {
        Law::explicit(5.0)
    }
}

stored! {
    impl[] DormandPrince { state, before, k[0], powers[0], dense }
}
