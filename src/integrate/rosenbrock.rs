//! Rosenbrock method of order 4 with an embedded method of order 3: RODAS by Hairer and Wanner, stiffly accurate and
//! L-stable, with dense output of order 3.
//!
//! ```text
//! (I/(h g) - J) u_i = f(t + a_i h, y + Sum_j a_ij u_j) + Sum_j (c_ij/h) u_j + h d_i df/dt
//! y_new = y + Sum_j m_j u_j,   error = u_6
//! ```
//!
//! For q' = v, v' = a(t, q, v) the positions are eliminated, which leaves one structured system per stage:
//!
//! ```text
//! (I/(h g) - D - h g K) u_v = r_v + h g K r_q,   u_q = h g (r_q + u_v),   K = da/dq,  D = da/dv
//! ```
//!
//! Six evaluations and one derivative per step, six solves and one factorisation per attempt. Source: Hairer and
//! Wanner, Solving Ordinary Differential Equations II, section IV.7 and the program RODAS (method 1).

use super::arrowhead::{Arrowhead, Factors, HUB, SPOKE};
use super::control::{ErrorNorm, Estimate, Law};
use super::{Linearization, Reader, Stepper, Structure, System};
use nalgebra::SVector;

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
pub struct Rosenbrock {
    positions: usize,
    structure: Structure,
    norm: ErrorNorm,
    state: Vec<f64>,
    trial: Vec<f64>,
    a: Vec<f64>,
    /// Accelerations at the start of the step; with `slope` they serve every attempt from there.
    start_a: Vec<f64>,
    linearized: bool,
    /// Right-hand side of a stage and its K r_q, over the velocities.
    right: Vec<f64>,
    /// u_1 to u_6 over the whole state.
    stages: [Vec<f64>; 6],
    slope: Linearization,
    matrix: Arrowhead,
    factors: Factors,
    hub: SVector<f64, HUB>,
    spokes: Vec<SVector<f64, SPOKE>>,
    /// Start, end and two bending terms of the last accepted step and of the attempt.
    dense: [Vec<f64>; 4],
    trial_dense: [Vec<f64>; 4],
}

impl Rosenbrock {
    /// Memory for a system with an absolute tolerance for every state.
    pub fn new<S: System>(system: &S, tolerance: &[f64]) -> Self {
        let structure = system.structure();
        let (nq, nv) = (system.positions(), system.velocities());
        let zeros = || vec![0.0; nq + nv];
        let spokes = structure.spokes.len();
        Self {
            positions: nq,
            norm: ErrorNorm::new(system, tolerance),
            state: zeros(),
            trial: zeros(),
            a: vec![0.0; nv],
            start_a: vec![0.0; nv],
            linearized: false,
            right: vec![0.0; nv],
            stages: std::array::from_fn(|_| zeros()),
            slope: Linearization::new(&structure, nv),
            matrix: Arrowhead::new(spokes),
            factors: Factors::new(spokes),
            hub: SVector::zeros(),
            spokes: vec![SVector::zeros(); spokes],
            structure,
            dense: std::array::from_fn(|_| zeros()),
            trial_dense: std::array::from_fn(|_| zeros()),
        }
    }

    /// Factorises I/(h g) - D - h g K; false if that fails.
    fn factorize(&mut self, h: f64) -> bool {
        let (shift, hg) = (1.0 / (GAMMA * h), GAMMA * h);
        let (k, d) = (&self.slope.over_positions, &self.slope.over_velocities);
        self.matrix.hub = -d.hub - k.hub * hg;
        for i in 0..HUB {
            self.matrix.hub[(i, i)] += shift;
        }
        for ((m, k), d) in self.matrix.spokes.iter_mut().zip(&k.spokes).zip(&d.spokes) {
            m.own = -d.own - k.own * hg;
            m.to_hub = -d.to_hub - k.to_hub * hg;
            m.from_hub = -d.from_hub - k.from_hub * hg;
            for i in 0..SPOKE {
                m.own[(i, i)] += shift;
            }
        }
        self.factors.factorize(&self.matrix)
    }

    /// Solves for stage `i` with the right-hand sides in `stages[i]` (positions) and `right` (velocities).
    fn solve(&mut self, i: usize, h: f64) {
        let (nq, hg) = (self.positions, GAMMA * h);
        let stage = &mut self.stages[i];
        // K r_q; velocities without position have no column in K.
        let at = |x: &[f64], index: Option<usize>| index.filter(|i| *i < x.len()).map_or(0.0, |i| x[i]);
        let r_q = &stage[..nq];
        let hub_q = SVector::<f64, HUB>::from_fn(|k, _| at(r_q, self.structure.hub[k]));
        let k = &self.slope.over_positions;
        let mut hub = k.hub * hub_q;
        for ((x, spoke), places) in self.spokes.iter_mut().zip(&k.spokes).zip(&self.structure.spokes) {
            let own_q = SVector::<f64, SPOKE>::from_fn(|k, _| at(r_q, Some(places[k])));
            hub += spoke.to_hub * own_q;
            let pushed = spoke.own * own_q + spoke.from_hub * hub_q;
            *x = SVector::from_fn(|k, _| self.right[places[k]] + hg * pushed[k]);
        }
        self.hub = SVector::from_fn(|k, _| at(&self.right, self.structure.hub[k]) + hg * hub[k]);
        self.factors.solve(&mut self.hub, &mut self.spokes);
        let (u_q, u_v) = stage.split_at_mut(nq);
        for (k, index) in self.structure.hub.iter().enumerate() {
            if let Some(index) = index {
                u_v[*index] = self.hub[k];
            }
        }
        for (x, places) in self.spokes.iter().zip(&self.structure.spokes) {
            for (k, index) in places.iter().enumerate() {
                u_v[*index] = x[k];
            }
        }
        for (u_q, u_v) in u_q.iter_mut().zip(u_v.iter()) {
            *u_q = hg * (*u_q + u_v);
        }
    }
}

impl<S: System> Stepper<S> for Rosenbrock {
    fn set_state(&mut self, state: &[f64]) {
        self.state.copy_from_slice(state);
        self.dense[0].copy_from_slice(state);
        self.dense[1].copy_from_slice(state);
        self.dense[2].fill(0.0);
        self.dense[3].fill(0.0);
        self.linearized = false;
    }

    fn refresh(&mut self, system: &mut S, t: f64) -> Result<(), S::Fault> {
        let (q, v) = self.state.split_at(self.positions);
        self.linearized = false;
        system.linearize(t, q, v, &mut self.start_a, &mut self.slope)?;
        self.linearized = true;
        Ok(())
    }

    fn attempt(&mut self, system: &mut S, t: f64, h: f64, t_last: f64) -> Result<Option<Estimate>, S::Fault> {
        let (nq, n) = (self.positions, self.state.len());
        let (q, v) = self.state.split_at(nq);
        if !self.linearized {
            system.linearize(t, q, v, &mut self.start_a, &mut self.slope)?;
            self.linearized = true;
        }
        if !self.factorize(h) {
            return Err(system.not_finite(0));
        }
        self.trial.copy_from_slice(&self.state);
        for i in 0..6 {
            for k in 0..n {
                let sum: f64 = self.stages[..i].iter().zip(&A[i]).map(|(u, a)| a * u[k]).sum();
                self.trial[k] = self.state[k] + sum;
            }
            let (q, v) = self.trial.split_at(nq);
            if i == 0 {
                self.a.copy_from_slice(&self.start_a);
            } else {
                system.accelerations((t + TIMES[i] * h).min(t_last), q, v, &mut self.a)?;
            }
            let (done, rest) = self.stages.split_at_mut(i);
            for k in 0..n {
                let sum: f64 = done.iter().zip(&C[i]).map(|(u, c)| c / h * u[k]).sum();
                if k < nq {
                    rest[0][k] = v[k] + sum;
                } else {
                    self.right[k - nq] = self.a[k - nq] + sum + h * RATE[i] * self.slope.over_time[k - nq];
                }
            }
            self.solve(i, h);
        }
        for k in 0..n {
            // The last stage is the error; with it the step is complete.
            let end = self.trial[k] + self.stages[5][k];
            let bend =
                |weights: &[f64; 5]| -> f64 { self.stages.iter().zip(weights).map(|(u, w)| w * u[k]).sum() };
            self.trial_dense[0][k] = self.state[k];
            self.trial_dense[2][k] = bend(&DENSE[0]);
            self.trial_dense[3][k] = bend(&DENSE[1]);
            self.trial_dense[1][k] = end;
            self.trial[k] = end;
        }
        let last = &self.stages[5];
        Ok(Some(self.norm.of(|k| last[k])))
    }

    fn accept(&mut self) {
        std::mem::swap(&mut self.state, &mut self.trial);
        std::mem::swap(&mut self.dense, &mut self.trial_dense);
        self.linearized = false;
    }

    fn state(&self) -> &[f64] {
        &self.state
    }

    fn interpolate(&self, theta: f64, out: &mut [f64]) {
        let (x, y) = (theta, 1.0 - theta);
        let [start, end, bend, twist] = &self.dense;
        for (i, out) in out.iter_mut().enumerate() {
            *out = start[i] * y + x * (end[i] + y * (bend[i] + x * twist[i]));
        }
    }

    fn control(&self) -> Law {
        Law::implicit(4.0)
    }

    fn save(&self, out: &mut Vec<f64>) {
        out.extend_from_slice(&self.state);
        for part in &self.dense {
            out.extend_from_slice(part);
        }
    }

    fn load(&mut self, from: &mut Reader<'_>) -> Option<()> {
        self.linearized = false;
        from.fill(&mut self.state)?;
        self.dense.iter_mut().try_for_each(|part| from.fill(part))
    }
}
