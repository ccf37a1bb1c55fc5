//! Rosenbrock method of order 4 with an embedded method of order 3: RODAS by Hairer and Wanner, stiffly accurate and
//! L-stable, with dense output of order 3.
//!
//! ```text
//! (I/(h g) - J) u_i = f(t + a_i h, y + Sum_j a_ij u_j) + Sum_j (c_ij/h) u_j + h d_i df/dt
//! y_new = y + Sum_j m_j u_j,   error = u_6
//! ```
//!
//! Works follow by Simpson's rule from the ends and the middle, where one more evaluation is made.
//!
//! Seven evaluations and one derivative per step, six solves and one factorisation per attempt. Source: Hairer and
//! Wanner, Solving Ordinary Differential Equations II, section IV.7 and the program RODAS (method 1).

use crate::integrate::driver::control::{ErrorNorm, Estimate, Law};
use crate::integrate::linear::shifted::Shifted;
use crate::integrate::{
    Kept, Linearization, Linearized, Observed, Progress, Stepper, Structure, add_weighted, parts_mut,
    zero_works,
};
use crate::stored::stored;

const GAMMA: f64 = 0.25;
const A: [[f64; 5]; 6] = [
    [0.0; 5],
    [1.544, 0.0, 0.0, 0.0, 0.0],
    [0.946_678_528_081_582_6, 0.255_701_169_898_328_4, 0.0, 0.0, 0.0],
    [3.314_825_187_068_521, 2.896_124_015_972_201, 0.998_641_913_997_781_7, 0.0, 0.0],
    [1.221_224_509_226_641, 6.019_134_481_288_629, 12.537_083_329_320_87, -0.687_886_036_105_895, 0.0],
    [1.221_224_509_226_641, 6.019_134_481_288_629, 12.537_083_329_320_87, -0.687_886_036_105_895, 1.0],
];
const C: [[f64; 5]; 6] = [
    [0.0; 5],
    [-5.6688, 0.0, 0.0, 0.0, 0.0],
    [-2.430_093_356_833_875, -0.206_359_915_709_191_5, 0.0, 0.0, 0.0],
    [-0.107_352_905_815_137_5, -9.594_562_251_023_355, -20.470_286_148_096_16, 0.0, 0.0],
    [7.496_443_313_967_647, -10.246_804_314_643_52, -33.999_903_528_199_05, 11.708_908_932_061_6, 0.0],
    [
        8.083_246_795_921_522,
        -7.981_132_988_064_893,
        -31.521_594_328_743_71,
        16.319_305_431_231_36,
        -6.058_818_238_834_054,
    ],
];
/// Times of the stages in units of the step.
const TIMES: [f64; 6] = [0.0, 0.386, 0.21, 0.63, 1.0, 1.0];
/// Weights of df/dt.
const RATE: [f64; 6] = [0.25, -0.1043, 0.1035, -0.0362, 0.0, 0.0];
/// Weights of the dense output.
const DENSE: [[f64; 5]; 2] = [
    [
        10.126_235_083_445_86,
        -7.487_995_877_610_167,
        -34.800_918_615_557_47,
        -7.992_771_707_568_823,
        1.025_137_723_295_662,
    ],
    [
        -0.676_280_339_280_125_3,
        6.087_714_651_680_015,
        16.430_843_208_924_78,
        24.767_225_114_183_86,
        -6.594_389_125_716_872,
    ],
];

/// The method's memory.
#[derive(Clone, Debug)]
pub struct Rosenbrock<const N: usize> {
    positions: usize,
    structure: Structure<N>,
    norm: ErrorNorm,
    /// Watched at the start, at the end and in the middle; between the ends there are two bending terms.
    progress: Progress,
    /// State in the middle of the attempt.
    middle: Vec<f64>,
    a: Vec<f64>,
    /// Accelerations at the start of the step; with `slope` they serve every attempt from there.
    start_a: Vec<f64>,
    linearized: bool,
    /// Powers at the start, in the middle and at the end.
    powers: [Vec<f64>; 3],
    /// u_1 to u_6 over the whole state.
    stages: [Vec<f64>; 6],
    slope: Linearization<N>,
    system: Shifted<f64, N>,
}

impl<const N: usize> Rosenbrock<N> {
    /// Evaluations of an attempt.
    pub const EVALUATIONS: f64 = 5.0;
    /// Those at its new state: one with the derivatives, whose own cost the system knows, one for the integrals.
    pub const EVALUATIONS_AT_START: f64 = 2.0;

    /// Memory for a system with an absolute tolerance for every state.
    pub fn new<S: Linearized<N> + Observed>(system: &S, tolerance: &[f64]) -> Self {
        let structure = system.structure();
        let (nq, nv) = (system.positions(), system.velocities());
        let zeros = || vec![0.0; nq + nv];
        Self {
            positions: nq,
            norm: ErrorNorm::new(system, tolerance),
            progress: Progress::new(system, 3, 2 * (nq + nv)),
            middle: zeros(),
            a: vec![0.0; nv],
            start_a: vec![0.0; nv],
            linearized: false,
            powers: std::array::from_fn(|_| zero_works(system)),
            stages: std::array::from_fn(|_| zeros()),
            slope: Linearization::new(&structure, nv),
            system: Shifted::new(&structure),
            structure,
        }
    }
}

impl<const N: usize> Rosenbrock<N> {
    /// Integrates over the attempt by Simpson's rule. The last stage was evaluated within its error of the end; the
    /// middle comes from the dense output.
    fn integrate<S: Linearized<N> + Observed>(&mut self, system: &mut S, t: f64, h: f64, t_last: f64) {
        let Progress { end: start, trial: last, trial_dense, works, samples, .. } = &mut self.progress;
        let [bend, twist] = parts_mut(trial_dense);
        for (k, x) in self.middle.iter_mut().enumerate() {
            *x = 0.5 * (start[k] + last[k] + 0.5 * (bend[k] + 0.5 * twist[k]));
        }
        let (q, v) = self.middle.split_at(self.positions);
        works.fill(0.0);
        // Where nothing is defined between the ends, they alone must do: sums must not stop a step.
        let defined = system.accelerations((t + 0.5 * h).min(t_last), q, v, &mut self.a).is_ok();
        if defined {
            system.powers(q, v, None, &mut self.powers[1]);
        } else {
            self.powers[1].fill(0.0);
        }
        let weights = if defined { [1.0, 4.0, 1.0] } else { [3.0, 0.0, 3.0] };
        if let Some(row) = samples.row(2).filter(|_| defined) {
            system.watch(q, v, None, row);
        }
        samples.weigh(if defined { &[1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0] } else { &[0.5, 0.5] });
        for (x, weight) in self.powers.iter().zip(weights) {
            add_weighted(works, weight * h / 6.0, x);
        }
    }
}

/// out = sum of the `stages`, each with its weight: whole stages one after another, so that entries share registers.
fn weighted_sum(out: &mut [f64], stages: &[Vec<f64>], weights: &[f64]) {
    out.fill(0.0);
    for (stage, weight) in stages.iter().zip(weights) {
        for (x, u) in out.iter_mut().zip(stage) {
            *x += weight * u;
        }
    }
}

impl<S: Linearized<N> + Observed, const N: usize> Stepper<S> for Rosenbrock<N> {
    fn set_state(&mut self, state: &[f64]) {
        self.progress.begin(state);
        self.linearized = false;
    }

    fn refresh(&mut self, system: &mut S, t: f64) -> Result<(), S::Fault> {
        let (q, v) = self.progress.end.split_at(self.positions);
        self.linearized = false;
        system.linearize(t, q, v, &mut self.start_a, &mut self.slope)?;
        system.powers(q, v, None, &mut self.powers[0]);
        if let Some(row) = self.progress.samples.row(0) {
            system.watch(q, v, None, row);
        }
        self.linearized = true;
        Ok(())
    }

    fn attempt(&mut self, system: &mut S, t: f64, h: f64, t_last: f64) -> Result<Option<Estimate>, S::Fault> {
        let nq = self.positions;
        if !self.linearized {
            Stepper::<S>::refresh(self, system, t)?;
        }
        if !self.system.factorize(&self.slope, 1.0 / (GAMMA * h)) {
            return Err(system.not_finite(0));
        }
        let Progress { end: state, trial, trial_dense, samples, .. } = &mut self.progress;
        for i in 0..6 {
            weighted_sum(trial, &self.stages[..i], &A[i]);
            for (x, start) in trial.iter_mut().zip(&*state) {
                *x += start;
            }
            let (q, v) = trial.split_at(nq);
            if i == 0 {
                self.a.copy_from_slice(&self.start_a);
            } else {
                system.accelerations((t + TIMES[i] * h).min(t_last), q, v, &mut self.a)?;
            }
            if i == 5 {
                system.powers(q, v, None, &mut self.powers[2]);
                if let Some(row) = samples.row(1) {
                    system.watch(q, v, None, row);
                }
            }
            let (done, rest) = self.stages.split_at_mut(i);
            let stage = &mut rest[0];
            weighted_sum(stage, done, &C[i].map(|c| c / h));
            let (stage_q, stage_v) = stage.split_at_mut(nq);
            for (x, v) in stage_q.iter_mut().zip(v) {
                *x += v;
            }
            for ((x, a), drift) in stage_v.iter_mut().zip(&self.a).zip(&self.slope.over_time) {
                *x += a + h * RATE[i] * drift;
            }
            self.system.solve(&self.slope, &self.structure, nq, stage);
        }
        // The last stage is the error; with it the step is complete.
        let last = &self.stages[5];
        for (x, error) in trial.iter_mut().zip(last) {
            *x += error;
        }
        let [bend, twist] = parts_mut(trial_dense);
        weighted_sum(bend, &self.stages[..5], &DENSE[0]);
        weighted_sum(twist, &self.stages[..5], &DENSE[1]);
        let estimate = self.norm.of(|k| last[k]);
        if estimate.error <= 1.0 {
            self.integrate(system, t, h, t_last);
        }
        Ok(Some(estimate))
    }

    fn accept(&mut self) {
        self.progress.accept();
        self.linearized = false;
    }

    fn progress(&self) -> &Progress {
        &self.progress
    }

    fn recall(&self, kept: &Kept<'_>, theta: f64, out: &mut [f64]) {
        let (x, y) = (theta, 1.0 - theta);
        let (Kept { start, end, .. }, [bend, twist]) = (kept, kept.parts());
        for (i, out) in out.iter_mut().enumerate() {
            *out = start[i] * y + x * (end[i] + y * (bend[i] + x * twist[i]));
        }
    }

    fn control(&self) -> Law {
        Law::implicit(4.0)
    }
}

stored! {
    impl[const N: usize] Rosenbrock<N> { progress }
    then { linearized = false }
}
