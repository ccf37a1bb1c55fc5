//! Adams-Bashforth-Moulton method of order 1 to 12 with variable steps, in modified divided differences: one or two
//! evaluations per step, whatever the order.
//!
//! ```text
//! Phi_0 = f_n,   Phi_j = Phi_(j-1) - Phi*_(j-1) of the step before
//! p       = y_n + h Sum_(j<k) g_j Phi*_j          prediction, Phi*_j = beta_j Phi_j
//! y_(n+1) = p + h g_k D_k                         D_k = f(p) - Sum_(j<k) Phi*_j
//! error   = h (g_k - g_(k-1)) D_k
//! ```
//!
//! beta_j is the value at the end of the step, and g_j beta_j the mean over the step, of the polynomial that Phi_j belongs to.
//! Source: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, section III.5. Errors of the neighbouring
//! orders follow from the same differences and choose the order. Where prediction and correction differ by much less than
//! the tolerance, the second evaluation would change nothing and is left out.

use crate::integrate::driver::control::{ErrorNorm, Estimate, Law};
use crate::integrate::{Kept, Observed, Progress, Stepper};
use crate::stored::stored;

/// Highest order.
const HIGHEST: usize = 12;
/// Differences that are kept: two more than the order, of which the last is for the choice of a higher one.
const DIFFERENCES: usize = HIGHEST + 2;
/// Corrections smaller than this, in units of the tolerance, are not evaluated again.
const NEGLIGIBLE: f64 = 0.1;
/// Failed attempts of a step after which the past counts no more.
const PATIENCE: usize = 3;
/// A first step is judged by a change of the state by so many tolerances.
const PROBE: f64 = 10.0;
/// Weights of what is watched: at both ends of a step.
const WEIGHTS: [f64; 2] = [0.5, 0.5];

/// Polynomials of the differences over a step: values at its end, and means over it.
#[derive(Clone, Copy, Debug, Default)]
struct Basis {
    value: [f64; DIFFERENCES],
    mean: [f64; DIFFERENCES],
}

impl Basis {
    /// The first `count` of them over a step of size `h` (s), which may be negative, from a point that lies `behind` (s) the
    /// points before it.
    fn new(h: f64, behind: &[f64; DIFFERENCES], count: usize) -> Self {
        let mut basis = Self::default();
        (basis.value[0], basis.mean[0]) = (1.0, 1.0);
        let mut weights: [f64; DIFFERENCES] = std::array::from_fn(|i| 1.0 / (i + 1) as f64);
        let mut last = 0.0;
        for j in 1..count {
            let (reach, step) = ((h + last) / behind[j - 1], h / behind[j - 1]);
            for i in 0..count - j {
                weights[i] = reach * weights[i] - step * weights[i + 1];
            }
            basis.mean[j] = weights[0];
            basis.value[j] = reach * basis.value[j - 1];
            last = behind[j - 1];
        }
        basis
    }

    /// g_j.
    fn g(&self, j: usize) -> f64 {
        self.mean[j] / self.value[j]
    }
}

/// The method's memory.
#[derive(Clone, Debug)]
pub struct Adams {
    positions: usize,
    norm: ErrorNorm,
    progress: Progress,
    /// Rates of the state and powers, at the last evaluated point.
    rate: Vec<f64>,
    /// Their differences at the end of the last accepted step.
    differences: [Vec<f64>; DIFFERENCES],
    /// D_k of the attempt.
    last_difference: Vec<f64>,
    /// How far that end lies behind the points before it, s; and how many of these there are.
    behind: [f64; DIFFERENCES],
    points: usize,
    /// Order of the next step, and of the step after the attempt.
    order: usize,
    next_order: usize,
    /// Whether the order rises with every step, as at the start.
    rising: bool,
    /// Steps since the order changed.
    same: usize,
    /// Attempts of the present step that failed.
    failed: usize,
    /// Step to start with (s), if it has just been found.
    first_step: Option<f64>,
    /// Step and polynomials of the attempt.
    h: f64,
    basis: Basis,
    a: Vec<f64>,
    /// What is watched at the end of the last accepted step.
    watched: Vec<f64>,
}

impl Adams {
    /// Memory for a system with an absolute tolerance for every state.
    pub fn new<S: Observed>(system: &S, tolerance: &[f64]) -> Self {
        let n = system.positions() + system.velocities();
        let progress = Progress::new(system, WEIGHTS.len(), 0);
        let rates = || vec![0.0; n + progress.works.len()];
        Self {
            positions: system.positions(),
            norm: ErrorNorm::new(system, tolerance),
            rate: rates(),
            differences: std::array::from_fn(|_| rates()),
            last_difference: rates(),
            behind: [0.0; DIFFERENCES],
            points: 0,
            order: 1,
            next_order: 1,
            rising: true,
            same: 0,
            failed: 0,
            first_step: None,
            h: 0.0,
            basis: Basis::default(),
            a: vec![0.0; system.velocities()],
            watched: vec![0.0; system.watched()],
            progress,
        }
    }

    /// Forgets the points behind the last one.
    fn start_over(&mut self) {
        (self.points, self.order, self.rising, self.same) = (0, 1, true, 0);
    }

    /// Evaluates rates and powers at time `t` (s) of the trial.
    fn evaluate<S: Observed>(&mut self, system: &mut S, t: f64) -> Result<(), S::Fault> {
        let Self { positions, progress, a, rate, .. } = self;
        evaluate(system, t, *positions, &progress.trial, a, rate)
    }

    /// Size of `weight` times the difference that lies `above` that of the attempt's order.
    fn error_of(&mut self, above: isize, weight: f64) -> f64 {
        let Self { norm, last_difference: last, differences, basis, order, h, .. } = self;
        let star = |j: usize, i: usize| basis.value[j] * differences[j][i];
        let k = *order;
        let component = |i: usize| match above {
            1 => last[i] - star(k, i),
            0 => last[i],
            -1 => last[i] + star(k - 1, i),
            _ => last[i] + star(k - 1, i) + star(k - 2, i),
        };
        norm.of(|i| *h * weight * component(i)).error
    }

    /// The order after an attempt with this error.
    fn choose_order(&mut self, error: f64) -> usize {
        let (k, basis) = (self.order, self.basis);
        let weight = |order: usize| basis.g(order) - basis.g(order - 1);
        let mut below = f64::INFINITY;
        if k >= 2 {
            below = self.error_of(-1, weight(k - 1));
            if k >= 3 {
                below = below.max(self.error_of(-2, weight(k - 2)));
            }
            if below <= if k == 2 { 0.5 * error } else { error } {
                self.rising = false;
                return k - 1;
            }
        }
        if k == HIGHEST || self.points < k {
            return k;
        }
        if self.rising {
            return k + 1;
        }
        let above = if self.same > k { self.error_of(1, weight(k + 1)) } else { f64::INFINITY };
        let better = if k == 1 { above < 0.5 * error } else { above < error && error < below };
        if better { k + 1 } else { k }
    }
}

/// Rates of a state at time `t` (s), and behind them the powers.
fn evaluate<S: Observed>(
    system: &mut S,
    t: f64,
    positions: usize,
    state: &[f64],
    a: &mut [f64],
    out: &mut [f64],
) -> Result<(), S::Fault> {
    let (q, v) = state.split_at(positions);
    system.accelerations(t, q, v, a)?;
    let (rate, powers) = out.split_at_mut(state.len());
    rate[..positions].copy_from_slice(&v[..positions]);
    rate[positions..].copy_from_slice(a);
    system.powers(q, v, None, powers);
    Ok(())
}

impl<S: Observed> Stepper<S> for Adams {
    fn set_state(&mut self, state: &[f64]) {
        self.progress.begin(state);
        self.h = 0.0;
        self.start_over();
    }

    fn refresh(&mut self, system: &mut S, t: f64) -> Result<(), S::Fault> {
        self.start_over();
        let (positions, Progress { end: state, trial, .. }) = (self.positions, &mut self.progress);
        // A first step in which the second derivative makes half a tolerance, seen from a step that is far shorter.
        evaluate(system, t, positions, state, &mut self.a, &mut self.differences[0])?;
        let rate = &self.differences[0];
        let speed = self.norm.of(|i| rate[i]).error;
        let probe = if speed > 0.0 { PROBE / speed } else { 0.0 };
        for ((trial, y), rate) in trial.iter_mut().zip(&*state).zip(rate) {
            *trial = y + probe * rate;
        }
        self.first_step = None;
        if probe > 0.0 && evaluate(system, t, positions, trial, &mut self.a, &mut self.rate).is_ok() {
            let (then, now) = (&self.rate, &self.differences[0]);
            let bend = self.norm.of(|i| (then[i] - now[i]) / probe).error;
            let step = (1.0 / bend).sqrt();
            self.first_step = step.is_finite().then_some(step);
        }
        // What is watched belongs to the evaluation of the state.
        evaluate(system, t, positions, state, &mut self.a, &mut self.differences[0])?;
        if !self.watched.is_empty() {
            let (q, v) = state.split_at(positions);
            system.watch(q, v, None, &mut self.watched);
        }
        Ok(())
    }

    fn review(&mut self, _system: &mut S, _t: f64) -> Option<f64> {
        self.first_step.take()
    }

    fn attempt(&mut self, system: &mut S, t: f64, h: f64, t_last: f64) -> Result<Option<Estimate>, S::Fault> {
        self.failed += 1;
        if self.failed > PATIENCE && self.order > 1 {
            self.start_over();
        }
        let k = self.order;
        // Beyond the points that there are any distance will do: it drops out of what is used.
        for j in self.points..=k {
            self.behind[j] = if j > 0 { self.behind[j - 1] } else { 0.0 } + h.abs();
        }
        let basis = Basis::new(h, &self.behind, k + 2);
        (self.h, self.basis) = (h, basis);
        let end = (t + h).min(t_last);
        let Progress { end: state, trial, .. } = &mut self.progress;
        let n = state.len();
        for i in 0..n {
            let sum: f64 = (0..k).map(|j| basis.mean[j] * self.differences[j][i]).sum();
            trial[i] = state[i] + h * sum;
        }
        self.evaluate(system, end)?;
        for i in 0..self.rate.len() {
            let sum: f64 = (0..k).map(|j| basis.value[j] * self.differences[j][i]).sum();
            self.last_difference[i] = self.rate[i] - sum;
        }
        let (last, correction) = (&self.last_difference, h * basis.g(k));
        let moved = self.norm.of(|i| correction * last[i]).error;
        let estimate = {
            let weight = h * (basis.g(k) - basis.g(k - 1));
            self.norm.of(|i| weight * last[i])
        };
        // Also where it is not a number.
        let accepted = estimate.error <= 1.0;
        if !accepted {
            self.rising = false;
            return Ok(Some(estimate));
        }
        self.next_order = self.choose_order(estimate.error);
        for i in 0..n {
            self.progress.trial[i] += correction * self.last_difference[i];
        }
        for (w, work) in self.progress.works.iter_mut().enumerate() {
            let i = n + w;
            let sum: f64 = (0..k).map(|j| basis.mean[j] * self.differences[j][i]).sum();
            *work = h * sum + correction * self.last_difference[i];
        }
        if moved > NEGLIGIBLE {
            self.evaluate(system, end)?;
        }
        let Progress { trial, samples, .. } = &mut self.progress;
        if let Some(row) = samples.row(0) {
            row.copy_from_slice(&self.watched);
        }
        if let Some(row) = samples.row(1) {
            let (q, v) = trial.split_at(self.positions);
            system.watch(q, v, None, row);
        }
        samples.weigh(&WEIGHTS);
        Ok(Some(estimate))
    }

    fn accept(&mut self) {
        self.progress.accept();
        let (k, Basis { value, .. }) = (self.order, self.basis);
        for (i, rate) in self.rate.iter().enumerate() {
            let mut carried = *rate;
            for (difference, value) in self.differences[..=k].iter_mut().zip(value) {
                let star = value * difference[i];
                difference[i] = carried;
                carried -= star;
            }
            self.differences[k + 1][i] = carried;
        }
        for j in (1..DIFFERENCES).rev() {
            self.behind[j] = self.behind[j - 1] + self.h;
        }
        self.behind[0] = self.h;
        self.points = (self.points + 1).min(HIGHEST + 1);
        self.same = if self.next_order == k { self.same + 1 } else { 0 };
        (self.order, self.failed) = (self.next_order, 0);
        if let Some(row) = self.progress.samples.row(1) {
            self.watched.copy_from_slice(row);
        }
    }

    fn progress(&self) -> &Progress {
        &self.progress
    }

    fn recall(&self, &Kept { start, end, .. }: &Kept<'_>, theta: f64, out: &mut [f64]) {
        // Back from the end; what is missing at the start is spread over the step.
        let count = self.order + 1;
        let [here, whole] =
            [theta - 1.0, -1.0].map(|x| (x * self.h, Basis::new(x * self.h, &self.behind, count)));
        let back = |(h, basis): &(f64, Basis), i: usize| -> f64 {
            *h * (0..count).map(|j| basis.mean[j] * self.differences[j][i]).sum::<f64>()
        };
        for (i, out) in out.iter_mut().enumerate() {
            let missing = start[i] - (end[i] + back(&whole, i));
            *out = end[i] + back(&here, i) + (1.0 - theta) * missing;
        }
    }

    fn control(&self) -> Law {
        Law::multistep((self.order + 1) as f64)
    }
}

stored! {
    impl[] Adams {
        progress, differences, behind, points, order, rising, same, failed, first_step, h, watched
    }
    if |adams: &Adams| (1..=HIGHEST).contains(&adams.order) && adams.points <= HIGHEST + 1
}
