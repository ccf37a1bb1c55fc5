//! Semi-implicit leapfrog with one force evaluation per step.
//!
//! ```text
//! q_half = q + h/2 v
//! v*     = v + h/2 a_previous             (mean of the step before)
//! a      = accelerations(t + h/2, q_half, v*)
//! (I + h D_i) dv = h (a + D (v* - v))     (per spoke and per body of the hub; D damping, D_i its implicit share)
//! v_new  = v + dv,   q_new = q_half + h/2 v_new
//! ```
//!
//! Bodies of the hub follow the spokes ([`react`]): they take in their `a` what the forces between them have become by the step
//! of the spokes, so that momentum passes whole.
//!
//! [`react`]: crate::integrate::Split::react
//!
//! Second order where rates are below 1/h: D_i is D/2 there, and the predictor removes the first-order bias of
//! velocity-dependent forces also where D is known roughly. Forces may decay far faster than the step. Stable up to
//! h = 2/omega of the highest undamped frequency. No error estimate.

use crate::integrate::driver::control::{Estimate, Law};
use crate::integrate::methods::damping::{VectorLanes, zero_vectors};
use crate::integrate::{
    Applied, GroupDamping, Kept, Observed, Progress, SemiImplicit, Split, Stepper, Structure,
};
use crate::scalar::{WIDEST, all_finite};
use crate::stored::stored;
use pulp::Arch;

/// The method's memory.
#[derive(Clone, Debug)]
pub struct Leapfrog<const N: usize> {
    positions: usize,
    /// Of a step there are its size in s and the velocities that it was evaluated with.
    progress: Progress,
    /// Mean acceleration of the last step.
    mean_a: Vec<f64>,
    trial_a: Vec<f64>,
    a: Vec<f64>,
    mean_v: Vec<f64>,
    damping: GroupDamping<N>,
    /// Velocities of each spoke and of each body of the hub.
    structure: Structure<N>,
    /// Accelerations and predicted changes of velocity, of the spokes and of a body.
    of_spokes: [Vec<VectorLanes<N>>; 2],
    of_body: [Vec<f64>; 2],
    instructions: Arch,
}

impl<const N: usize> Leapfrog<N> {
    /// Number of velocities.
    pub(in crate::integrate) fn velocities(&self) -> usize {
        self.a.len()
    }

    /// Memory for a system.
    pub fn new<S: Split<N> + Observed>(system: &S) -> Self {
        let (nq, nv) = (system.positions(), system.velocities());
        let velocity = vec![0.0; nv];
        let structure = system.structure();
        let spokes = structure.spokes.len();
        Self {
            positions: nq,
            progress: Progress::new(system, 1, 1 + nv),
            mean_a: velocity.clone(),
            trial_a: velocity.clone(),
            a: velocity.clone(),
            mean_v: velocity,
            damping: GroupDamping::new(&structure),
            of_spokes: [zero_vectors(spokes), zero_vectors(spokes)],
            of_body: std::array::from_fn(|_| vec![0.0; structure.hub.len()]),
            structure,
            instructions: Arch::new(),
        }
    }
}

/// State within a step of `h` s at the fraction `theta` of it: cubic Hermite interpolation of positions, linear of velocities;
/// both of the method's order.
fn interpolate(positions: usize, h: f64, start: &[f64], end: &[f64], theta: f64, out: &mut [f64]) {
    let x = theta;
    let hermite = [
        (1.0 + 2.0 * x) * (1.0 - x) * (1.0 - x),
        x * (1.0 - x) * (1.0 - x) * h,
        x * x * (3.0 - 2.0 * x),
        x * x * (x - 1.0) * h,
    ];
    let (out_q, out_v) = out.split_at_mut(positions);
    for (i, out) in out_q.iter_mut().enumerate() {
        *out = hermite[0] * start[i]
            + hermite[1] * start[positions + i]
            + hermite[2] * end[i]
            + hermite[3] * end[positions + i];
    }
    let ends = start.iter().zip(end).skip(positions);
    for (out, (start, end)) in out_v.iter_mut().zip(ends) {
        *out = start + x * (end - start);
    }
}

/// Velocity at the end of a step of `h` s with this mean acceleration, and its mean.
#[inline(always)]
fn step_on(v: f64, a: f64, h: f64) -> (f64, f64) {
    (v + h * a, v + 0.5 * h * a)
}

/// The fault of an acceleration that is not finite, if there is one.
fn check_finite<S: Split<N>, const N: usize>(system: &S, a: &[f64]) -> Result<(), S::Fault> {
    if all_finite(a) {
        return Ok(());
    }
    Err(system.not_finite(a.iter().position(|a| !a.is_finite()).unwrap_or_default()))
}

impl<S: Split<N> + Observed, const N: usize> Stepper<S> for Leapfrog<N> {
    fn set_state(&mut self, state: &[f64]) {
        self.progress.begin(state);
    }

    fn refresh(&mut self, system: &mut S, t: f64) -> Result<(), S::Fault> {
        let (q, v) = self.progress.end.split_at(self.positions);
        system.accelerations(t, q, v, &mut self.a)?;
        // Those without a position, such as spins, may be about to jump to what friction wants.
        let (moving, spinning) = self.mean_a.split_at_mut(self.positions);
        moving.copy_from_slice(&self.a[..self.positions]);
        spinning.fill(0.0);
        Ok(())
    }

    fn attempt(&mut self, system: &mut S, t: f64, h: f64, t_last: f64) -> Result<Option<Estimate>, S::Fault> {
        let nq = self.positions;
        let Progress { end, trial, trial_dense, works, samples, .. } = &mut self.progress;
        let (q, v) = end.split_at(nq);
        let (q_trial, v_trial) = trial.split_at_mut(nq);
        let (step, predicted) = trial_dense.split_at_mut(1);
        step[0] = h;
        let half = 0.5 * h;
        for ((trial, q), v) in q_trial.iter_mut().zip(q).zip(v) {
            *trial = q + half * v;
        }
        for ((predicted, v), a) in predicted.iter_mut().zip(v).zip(&self.mean_a) {
            *predicted = v + half * a;
        }
        let middle = (t + 0.5 * h).min(t_last);
        system.accelerations_to_split(middle, q_trial, predicted, &mut self.a)?;
        system.damping(h, q_trial, predicted, &mut self.damping);
        let n = v.len();
        let (a, predicted) = (&self.a[..n], &predicted[..n]);
        let [known, ahead] = &mut self.of_spokes;
        let spokes = self.structure.spokes.chunks(WIDEST);
        for (spokes, (known, ahead)) in spokes.zip(known.iter_mut().zip(ahead.iter_mut())) {
            for (lane, at) in spokes.iter().enumerate().take(WIDEST) {
                for (k, &i) in at.iter().enumerate() {
                    (known[k][lane], ahead[k][lane]) = (a[i], predicted[i] - v[i]);
                }
            }
        }
        self.damping.solve_spokes(h, ahead, known, self.instructions);
        self.trial_a.copy_from_slice(&self.a);
        for (spokes, known) in self.structure.spokes.chunks(WIDEST).zip(known.iter()) {
            for (lane, at) in spokes.iter().enumerate().take(WIDEST) {
                for (k, &i) in at.iter().enumerate() {
                    self.trial_a[i] = known[k][lane];
                }
            }
        }
        let ends = v_trial.iter_mut().zip(&mut self.mean_v);
        for ((v, a), (end, mean)) in v.iter().zip(&self.trial_a).zip(ends) {
            (*end, *mean) = step_on(*v, *a, h);
        }
        check_finite(system, &self.trial_a)?;
        let Structure { hub, bodies, .. } = &self.structure;
        let step = SemiImplicit { mean: &self.mean_v, end: v_trial, h };
        if !self.structure.spokes.is_empty() {
            system.react(q_trial, predicted, &step, &mut self.a);
        }
        for (body, places) in bodies.iter().enumerate() {
            let [right, ahead] = &mut self.of_body;
            let (right, ahead) = (&mut right[..places.len()], &mut ahead[..places.len()]);
            let at = &hub[places.clone()];
            for ((right, ahead), &i) in right.iter_mut().zip(ahead.iter_mut()).zip(at) {
                (*right, *ahead) = (self.a[i], predicted[i] - v[i]);
            }
            self.damping.solve_body(body, h, ahead, right);
            for (&a, &i) in right.iter().zip(at) {
                self.trial_a[i] = a;
                (v_trial[i], self.mean_v[i]) = step_on(v[i], a, h);
            }
        }
        if let Some(&bad) = hub.iter().find(|i| !self.trial_a[**i].is_finite()) {
            return Err(system.not_finite(bad));
        }
        system.admit(v_trial)?;
        let step = SemiImplicit { mean: &self.mean_v, end: v_trial, h };
        system.powers(q_trial, predicted, Some(&step), works);
        works.iter_mut().for_each(|work| *work *= h);
        if let Some(row) = samples.row(0) {
            system.watch(q_trial, predicted, Some(&step), row);
            samples.weigh(&[1.0]);
        }
        for (q, v) in q_trial.iter_mut().zip(v_trial.iter()) {
            *q += half * v;
        }
        Ok(None)
    }

    fn accept(&mut self) {
        self.progress.accept();
        std::mem::swap(&mut self.mean_a, &mut self.trial_a);
    }

    fn progress(&self) -> &Progress {
        &self.progress
    }

    fn recall(&self, kept: &Kept<'_>, theta: f64, out: &mut [f64]) {
        if let Some(h) = kept.rest.first() {
            interpolate(self.positions, *h, kept.start, kept.end, theta, out);
        }
    }

    fn applied_in<'a>(&self, Kept { start, end, rest }: Kept<'a>) -> Option<Applied<'a>> {
        let (h, predicted) = rest.split_first()?;
        (*h > 0.0).then_some(Applied { start, end, predicted, h: *h })
    }

    fn control(&self) -> Law {
        Law::explicit(2.0)
    }
}

stored! {
    impl[const N: usize] Leapfrog<N> { progress, mean_a }
}
