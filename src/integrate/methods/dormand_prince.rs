//! Explicit Runge-Kutta pair of order 5(4) by Dormand and Prince, with its fourth-order dense output.
//!
//! Coefficients: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, table II.5.2 and
//! section II.6.

use crate::integrate::driver::control::{ErrorNorm, Estimate, Law};
use crate::integrate::{Kept, Observed, Progress, Stepper, add_weighted, parts_mut, zero_works};
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
    progress: Progress,
    /// Rates at the seven stages; the first is that of the state.
    k: [Vec<f64>; 7],
    a: Vec<f64>,
    /// Powers at the stages.
    powers: [Vec<f64>; 7],
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
            progress: Progress::new(system, SAMPLED.len(), 3 * n),
            k: std::array::from_fn(|_| zeros()),
            a: vec![0.0; system.velocities()],
            powers: std::array::from_fn(|_| zero_works(system)),
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

impl<S: Observed> Stepper<S> for DormandPrince {
    fn set_state(&mut self, state: &[f64]) {
        self.progress.begin(state);
    }

    fn refresh(&mut self, system: &mut S, t: f64) -> Result<(), S::Fault> {
        let Self { positions, progress: Progress { end: state, .. }, a, k, powers, .. } = self;
        Self::rate(system, t, *positions, state, a, &mut k[0])?;
        let (q, v) = state.split_at(*positions);
        system.powers(q, v, None, &mut powers[0]);
        Ok(())
    }

    fn attempt(&mut self, system: &mut S, t: f64, h: f64, t_last: f64) -> Result<Option<Estimate>, S::Fault> {
        let Progress { end: state, trial, trial_dense, works, samples, .. } = &mut self.progress;
        for stage in 1..7 {
            let (done, rest) = self.k.split_at_mut(stage);
            weigh(done, &A[stage], trial);
            for (trial, start) in trial.iter_mut().zip(&*state) {
                *trial = start + h * *trial;
            }
            let time = (t + C[stage] * h).min(t_last);
            Self::rate(system, time, self.positions, trial, &mut self.a, &mut rest[0])?;
            // Those of the last stage are the first ones of the next step.
            if stage == 6 || A[6][stage] != 0.0 {
                let (q, v) = trial.split_at(self.positions);
                system.powers(q, v, None, &mut self.powers[stage]);
            }
            if let Some(place) = SAMPLED.iter().position(|s| *s == stage)
                && let Some(row) = samples.row(place)
            {
                let (q, v) = trial.split_at(self.positions);
                system.watch(q, v, None, row);
            }
        }
        samples.weigh(&SAMPLE_WEIGHTS);
        works.fill(0.0);
        for (x, weight) in self.powers.iter().zip(A[6]) {
            add_weighted(works, h * weight, x);
        }
        let [d2, d3, d4] = parts_mut(trial_dense);
        // The room of the last one holds the error first.
        weigh(&self.k, &E, d4);
        let estimate = self.norm.of(|i| h * d4[i]);
        weigh(&self.k, &D, d4);
        for i in 0..state.len() {
            let change = trial[i] - state[i];
            d2[i] = h * self.k[0][i] - change;
            d3[i] = change - h * self.k[6][i] - d2[i];
            d4[i] *= h;
        }
        Ok(Some(estimate))
    }

    fn accept(&mut self) {
        self.progress.accept();
        self.k.swap(0, 6);
        self.powers.swap(0, 6);
    }

    fn progress(&self) -> &Progress {
        &self.progress
    }

    fn recall(&self, kept: &Kept<'_>, theta: f64, out: &mut [f64]) {
        let (x, y) = (theta, 1.0 - theta);
        let (Kept { start, end, .. }, [d2, d3, d4]) = (kept, kept.parts());
        for (i, out) in out.iter_mut().enumerate() {
            *out = start[i] + x * (end[i] - start[i] + y * (d2[i] + x * (d3[i] + y * d4[i])));
        }
    }

    fn control(&self) -> Law {
        Law::explicit(5.0)
    }
}

stored! {
    impl[] DormandPrince { progress, k[0], powers[0] }
}
