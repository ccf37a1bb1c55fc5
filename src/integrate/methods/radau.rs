//! Radau IIA method of order 5 with three stages, fully implicit, stiffly accurate and L-stable, with an error
//! estimate of order 3 and dense output with a local error of order 5.
//!
//! ```text
//! z_i = h Sum_j a_ij f(t + c_j h, y + z_j),   y_new = y + z_3
//! ```
//!
//! Simplified Newton iteration with the exact Jacobian J of the start of the step. The eigenvectors of the inverse
//! of a_ij separate it into a real and a complex system of the size of one stage:
//!
//! ```text
//! (gamma/h I - J) d_1 = r_1,   ((alpha + i beta)/h I - J) (d_2 + i d_3) = r_2 + i r_3
//! ```
//!
//! Dense output: the collocation polynomial p(x), x = 0..1 over the step, has a local error of order 4. A term that
//! leaves its slopes at the stages as they are and brings the one at the start to its value raises it to 5:
//!
//! ```text
//! y(x) = p(x) + B(x) gamma e,   B = x - 4.5 x^2 + 6 x^3 - 2.5 x^4,   B(1) = 0
//! e = (gamma/h I - J)^-1 (f(t, y) - p'(0)/h)
//! ```
//!
//! e is the error estimate; fast decays, of which the slope at the start says nothing, are damped in it.
//!
//! Source: Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.8 and the program RADAU5.

use crate::integrate::driver::control::{ErrorNorm, Estimate, Law};
use crate::integrate::linear::shifted::Shifted;
use crate::integrate::{
    Kept, Linearization, Linearized, Observed, Progress, Stepper, Structure, add_weighted, parts_mut,
    zero_works,
};
use crate::scalar::math;
use crate::stored::stored;
use nalgebra::Complex;

/// Times of the stages in units of the step.
const TIMES: [f64; 3] = [0.155_051_025_721_682_2, 0.644_948_974_278_317_8, 1.0];
/// Weights of the stages in works.
const WEIGHTS: [f64; 3] = [0.376_403_062_700_467_3, 0.512_485_826_188_421_6, 1.0 / 9.0];
/// Real and complex eigenvalue of the inverse of the matrix a_ij.
const GAMMA: f64 = 3.637_834_252_744_496;
const ALPHA: f64 = 2.681_082_873_627_752_2;
const BETA: f64 = 3.050_430_199_247_410_5;
/// Eigenvectors: z = T w, and the inverse of T.
const T: [[f64; 3]; 3] = [
    [0.091_232_394_870_892_94, -0.141_255_295_020_954_2, -0.030_029_194_105_147_424],
    [0.241_717_932_707_107, 0.204_129_352_293_799_93, 0.382_942_112_757_261_9],
    [0.966_048_182_615_093, 1.0, 0.0],
];
const INVERSE_T: [[f64; 3]; 3] = [
    [4.325_579_890_063_155, 0.339_199_251_815_809_87, 0.541_770_539_935_874_9],
    [-4.178_718_591_551_905, -0.327_682_820_761_062_4, 0.476_623_554_500_550_45],
    [-0.502_872_634_945_786_9, 2.571_926_949_855_605, -0.596_039_204_828_224_9],
];
/// Weights of the stages in the error estimate.
const ERROR: [f64; 3] = [-10.048_809_399_827_416, 1.382_142_733_160_749, -1.0 / 3.0];
/// The iteration ends when its error is below this share of the tolerance. The error of order 5 is far below the
/// estimate of order 3, so an iteration that used up the tolerance would waste it.
const ITERATION_SHARE: f64 = 3e-4;
/// Largest number of iterations.
const MAX_ITERATIONS: u32 = 7;
/// An iteration that reduces its error by less than this diverges.
const SLOWEST: f64 = 0.99;
/// Increments below this share of a state are rounding.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The method's memory.
#[derive(Clone, Debug)]
pub struct Radau<const N: usize> {
    positions: usize,
    structure: Structure<N>,
    /// Absolute tolerance per state.
    tolerance: Vec<f64>,
    norm: ErrorNorm,
    /// Between the ends of a step there are the divided differences of its collocation polynomial, and the factor of B(x).
    progress: Progress,
    /// Accelerations at the start of the step; with `slope` they serve every attempt from there.
    start_a: Vec<f64>,
    slope: Linearization<N>,
    linearized: bool,
    /// The last attempt started from the same state.
    retried: bool,
    /// z_1 to z_3, w_1 to w_3 and the accelerations of the stages.
    stages: [Vec<f64>; 3],
    transformed: [Vec<f64>; 3],
    a: [Vec<f64>; 3],
    /// Powers at the stages.
    powers: [Vec<f64>; 3],
    /// What one iteration may leave in each state.
    allowed: Vec<f64>,
    real: Shifted<f64, N>,
    pair: Shifted<Complex<f64>, N>,
    right: Vec<f64>,
    right_pair: Vec<Complex<f64>>,
    /// Estimated ratio of the error of the iteration to its last increment.
    contraction: f64,
    /// Size of the last accepted step and of the attempt, s.
    step: f64,
    trial_step: f64,
    /// Evaluations of the last attempt.
    evaluations: u32,
    /// The polynomial of the last step leads into the next one.
    smooth: bool,
}

/// How an iteration ended.
enum Iteration {
    Converged,
    /// The error it would leave, in units of the allowed one; more than 1.
    Slow(f64),
}

impl<const N: usize> Radau<N> {
    /// Memory for a system with an absolute tolerance for every state.
    pub fn new<S: Linearized<N> + Observed>(system: &S, tolerance: &[f64]) -> Self {
        let structure = system.structure();
        let (nq, nv) = (system.positions(), system.velocities());
        let zeros = || vec![0.0; nq + nv];
        let three = || std::array::from_fn(|_| zeros());
        Self {
            positions: nq,
            tolerance: tolerance.to_vec(),
            norm: ErrorNorm::new(system, tolerance),
            progress: Progress::new(system, 3, 4 * (nq + nv)),
            start_a: vec![0.0; nv],
            slope: Linearization::new(&structure, nv),
            linearized: false,
            retried: false,
            stages: three(),
            transformed: three(),
            a: std::array::from_fn(|_| vec![0.0; nv]),
            powers: std::array::from_fn(|_| zero_works(system)),
            allowed: zeros(),
            real: Shifted::new(&structure),
            pair: Shifted::new(&structure),
            right: zeros(),
            right_pair: vec![Complex::new(0.0, 0.0); nq + nv],
            contraction: 1.0,
            step: 0.0,
            trial_step: 0.0,
            evaluations: 0,
            smooth: false,
            structure,
        }
    }

    /// Evaluations of the last attempt, without those of derivatives.
    pub fn evaluations(&self) -> u32 {
        self.evaluations
    }

    /// Starting values of the iteration: the last collocation polynomial continued, or none.
    fn predict(&mut self, h: f64) {
        let ratio = if self.smooth { h / self.step } else { 0.0 };
        let parts = self.progress.kept().parts::<4>();
        for (k, state) in self.progress.end.iter().enumerate() {
            let dense = parts.map(|part| part[k]);
            let z = TIMES.map(|c| bend(dense, c * ratio));
            let w = combined(&INVERSE_T, z);
            for i in 0..3 {
                self.stages[i][k] = z[i];
                self.transformed[i][k] = w[i];
            }
            self.allowed[k] = (ITERATION_SHARE * self.tolerance[k]).max(ROUNDING * state.abs());
        }
    }

    /// Solves for the stages by Newton's method.
    fn iterate<S: Linearized<N> + Observed>(
        &mut self,
        system: &mut S,
        t: f64,
        h: f64,
        t_last: f64,
    ) -> Result<Iteration, S::Fault> {
        let Progress { end: state, trial, samples, .. } = &mut self.progress;
        let (nq, n) = (self.positions, state.len());
        let (real, pair) = (GAMMA / h, Complex::new(ALPHA, BETA) / h);
        self.contraction = math::powf(self.contraction.max(f64::EPSILON), 0.8);
        let (mut last_size, mut last_ratio) = (0.0, 0.0);
        for iteration in 1..=MAX_ITERATIONS {
            self.evaluations += 3;
            let stages = self.stages.iter().zip(&mut self.a).zip(&mut self.powers).zip(TIMES);
            for (place, (((z, a), powers), c)) in stages.enumerate() {
                for ((trial, y), z) in trial.iter_mut().zip(&*state).zip(z) {
                    *trial = y + z;
                }
                let (q, v) = trial.split_at(nq);
                system.accelerations((t + c * h).min(t_last), q, v, a)?;
                system.powers(q, v, None, powers);
                if let Some(row) = samples.row(place) {
                    system.watch(q, v, None, row);
                }
            }
            for k in 0..n {
                let rates = std::array::from_fn(|i| {
                    if k < nq { state[nq + k] + self.stages[i][nq + k] } else { self.a[i][k - nq] }
                });
                let [r1, r2, r3] = combined(&INVERSE_T, rates);
                let [w1, w2, w3] = self.transformed.each_ref().map(|w| w[k]);
                self.right[k] = r1 - real * w1;
                self.right_pair[k] = Complex::new(r2, r3) - pair * Complex::new(w2, w3);
            }
            self.real.solve(&self.slope, &self.structure, nq, &mut self.right);
            self.pair.solve(&self.slope, &self.structure, nq, &mut self.right_pair);
            let mut size: f64 = 0.0;
            for ((d1, d2), allowed) in self.right.iter().zip(&self.right_pair).zip(&self.allowed) {
                let scaled = d1.abs().max(d2.re.abs()).max(d2.im.abs()) / allowed;
                // f64::max would drop a NaN.
                size = if size.is_nan() || scaled <= size { size } else { scaled };
            }
            if !size.is_finite() {
                return Ok(Iteration::Slow(f64::INFINITY));
            }
            if iteration > 1 {
                let ratio: f64 = size / last_size;
                let mean = if iteration == 2 { ratio } else { (ratio * last_ratio).sqrt() };
                last_ratio = ratio;
                if mean >= SLOWEST {
                    return Ok(Iteration::Slow(f64::INFINITY));
                }
                self.contraction = mean / (1.0 - mean);
                let left = self.contraction * size * mean.powi((MAX_ITERATIONS - iteration) as i32);
                if left > 1.0 {
                    return Ok(Iteration::Slow(left));
                }
            }
            last_size = size.max(f64::EPSILON);
            for k in 0..n {
                let d = [self.right[k], self.right_pair[k].re, self.right_pair[k].im];
                let w = std::array::from_fn(|i| self.transformed[i][k] + d[i]);
                let z = combined(&T, w);
                for i in 0..3 {
                    self.transformed[i][k] = w[i];
                    self.stages[i][k] = z[i];
                }
            }
            if self.contraction * size <= 1.0 {
                return Ok(Iteration::Converged);
            }
        }
        Ok(Iteration::Slow(f64::INFINITY))
    }

    /// The error, left in `right`, from the rates at the start of the step or, if `nearby`,
    /// at `trial`.
    fn estimate(&mut self, h: f64, nearby: bool) -> Estimate {
        let Progress { end: state, trial, .. } = &self.progress;
        let (nq, n) = (self.positions, state.len());
        for k in 0..n {
            let (v, a) = if nearby { (trial, &self.a[0]) } else { (state, &self.start_a) };
            let rate = if k < nq { v[nq + k] } else { a[k - nq] };
            let sum: f64 = self.stages.iter().zip(ERROR).map(|(z, e)| e * z[k]).sum();
            self.right[k] = rate + sum / h;
        }
        self.real.solve(&self.slope, &self.structure, nq, &mut self.right);
        let right = &self.right;
        self.norm.of(|k| right[k])
    }
}

impl<S: Linearized<N> + Observed, const N: usize> Stepper<S> for Radau<N> {
    fn set_state(&mut self, state: &[f64]) {
        self.progress.begin(state);
        (self.linearized, self.retried, self.smooth) = (false, false, false);
        self.contraction = 1.0;
    }

    fn refresh(&mut self, system: &mut S, t: f64) -> Result<(), S::Fault> {
        let (q, v) = self.progress.end.split_at(self.positions);
        (self.linearized, self.retried, self.smooth) = (false, false, false);
        system.linearize(t, q, v, &mut self.start_a, &mut self.slope)?;
        self.linearized = true;
        Ok(())
    }

    fn attempt(&mut self, system: &mut S, t: f64, h: f64, t_last: f64) -> Result<Option<Estimate>, S::Fault> {
        let nq = self.positions;
        self.evaluations = 0;
        if !self.linearized {
            let (q, v) = self.progress.end.split_at(nq);
            system.linearize(t, q, v, &mut self.start_a, &mut self.slope)?;
            self.linearized = true;
        }
        if !self.real.factorize(&self.slope, GAMMA / h)
            || !self.pair.factorize(&self.slope, Complex::new(ALPHA, BETA) / h)
        {
            return Err(system.not_finite(0));
        }
        // Also after a fault at a stage.
        let careful = std::mem::replace(&mut self.retried, true) || !self.smooth;
        self.predict(h);
        if let Iteration::Slow(left) = self.iterate(system, t, h, t_last)? {
            self.contraction = 1.0;
            return Ok(Some(Estimate { error: left, ..Estimate::default() }));
        }
        let mut estimate = self.estimate(h, false);
        if careful && estimate.error > 1.0 {
            // Evaluated again where the estimate points to, it has no part left that decays within the step.
            let Progress { end: state, trial, .. } = &mut self.progress;
            for ((trial, y), e) in trial.iter_mut().zip(&*state).zip(&self.right) {
                *trial = y + e;
            }
            let (q, v) = trial.split_at(nq);
            self.evaluations += 1;
            if system.accelerations(t, q, v, &mut self.a[0]).is_ok() {
                estimate = self.estimate(h, true);
            }
        }
        self.trial_step = h;
        let Progress { end: state, trial, trial_dense, works, samples, .. } = &mut self.progress;
        samples.weigh(&WEIGHTS);
        works.fill(0.0);
        for (x, weight) in self.powers.iter().zip(WEIGHTS) {
            add_weighted(works, h * weight, x);
        }
        let [c1, c2, _] = TIMES;
        let dense = parts_mut::<4>(trial_dense);
        for k in 0..state.len() {
            let [z1, z2, z3] = self.stages.each_ref().map(|z| z[k]);
            let last = (z3 - z2) / (1.0 - c2);
            let middle = (z2 - z1) / (c2 - c1);
            let second = (last - middle) / (1.0 - c1);
            let first = (middle - z1 / c1) / c2;
            trial[k] = state[k] + z3;
            dense[0][k] = last;
            dense[1][k] = second;
            dense[2][k] = second - first;
            dense[3][k] = GAMMA * self.right[k];
        }
        Ok(Some(estimate))
    }

    fn accept(&mut self) {
        self.progress.accept();
        self.step = self.trial_step;
        (self.linearized, self.retried, self.smooth) = (false, false, true);
    }

    fn progress(&self) -> &Progress {
        &self.progress
    }

    fn recall(&self, kept: &Kept<'_>, theta: f64, out: &mut [f64]) {
        let (x, parts) = (theta, kept.parts::<4>());
        let b = x * (1.0 - x * (4.5 - x * (6.0 - x * 2.5)));
        for (k, (out, end)) in out.iter_mut().zip(kept.end).enumerate() {
            let dense = parts.map(|part| part[k]);
            *out = end + bend(dense, x - 1.0) + b * dense[3];
        }
    }

    fn control(&self) -> Law {
        Law::implicit(4.0)
    }
}

/// Difference of a collocation polynomial to its end, at `x` steps after the end.
fn bend([first, second, third, _]: [f64; 4], x: f64) -> f64 {
    let [c1, c2, _] = TIMES;
    x * (first + (x + 1.0 - c2) * (second + (x + 1.0 - c1) * third))
}

fn combined(matrix: &[[f64; 3]; 3], x: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * x[0] + row[1] * x[1] + row[2] * x[2])
}

stored! {
    impl[const N: usize] Radau<N> { step, contraction, smooth, progress }
    then { linearized = false, retried = false }
}
