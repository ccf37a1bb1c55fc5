//! What an integration method gives: steps, and what is known within them.

use super::auto::Choice;
use super::driver::control::{Estimate, Law};
use super::driver::watch::Samples;
use super::system::{Observed, System, zero_works};
use crate::stored::{Stored, stored};

/// The evaluation that a semi-implicit step was made with: positions `start.q + h/2 start.v`, velocities `predicted`. The
/// forces it applied lie between those of the states on both sides; where friction is steep neither of them has their mean.
#[derive(Clone, Copy, Debug)]
pub struct Applied<'a> {
    /// State (q, v) at the start.
    pub start: &'a [f64],
    /// State at the end.
    pub end: &'a [f64],
    /// Velocities of the evaluation.
    pub predicted: &'a [f64],
    /// Step, s.
    pub h: f64,
}

/// Steps that are judged together before they count; none if they count at once.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stretch {
    /// Largest number of them.
    pub steps: usize,
    /// Largest number of numbers that [`Stepper::keep`] adds for all of them; for a method that keeps more of a step they are
    /// fewer.
    pub room: usize,
    /// Most that it adds for one.
    pub of_step: usize,
}

/// A step for questions about it.
#[derive(Clone, Copy, Debug)]
pub struct Kept<'a> {
    /// State (q, v) at the start.
    pub start: &'a [f64],
    /// State at the end.
    pub end: &'a [f64],
    /// What [`Stepper::keep`] added.
    pub rest: &'a [f64],
}

impl<'a> Kept<'a> {
    /// The rest, of arrays of equal length.
    pub fn parts<const N: usize>(&self) -> [&'a [f64]; N] {
        let length = self.rest.len() / N;
        std::array::from_fn(|i| &self.rest[i * length..][..length])
    }
}

/// Where a method is: the last accepted step and the attempt behind it.
#[derive(Clone, Debug)]
pub struct Progress {
    /// State (q, v) at the start of the last accepted step.
    pub start: Vec<f64>,
    /// State at its end.
    pub end: Vec<f64>,
    /// What the method knows between the two.
    pub dense: Vec<f64>,
    /// State at the end of the attempt.
    pub trial: Vec<f64>,
    /// What the method knows of the attempt.
    pub trial_dense: Vec<f64>,
    /// Works of [`Observed::powers`] over the attempt.
    pub works: Vec<f64>,
    /// What the host watches in the attempt.
    pub samples: Samples,
}

impl Progress {
    /// Of a system that is watched at up to `places` places of a step, with so many numbers between its ends.
    pub fn new<S: Observed>(system: &S, places: usize, dense: usize) -> Self {
        let (state, dense) = (vec![0.0; system.positions() + system.velocities()], vec![0.0; dense]);
        Self {
            start: state.clone(),
            end: state.clone(),
            trial: state,
            trial_dense: dense.clone(),
            dense,
            works: zero_works(system),
            samples: Samples::new(system.watched(), places),
        }
    }

    /// Begins at this state.
    pub fn begin(&mut self, state: &[f64]) {
        self.start.copy_from_slice(state);
        self.end.copy_from_slice(state);
        self.dense.fill(0.0);
    }

    /// The attempt becomes the last step.
    pub fn accept(&mut self) {
        std::mem::swap(&mut self.start, &mut self.end);
        std::mem::swap(&mut self.end, &mut self.trial);
        std::mem::swap(&mut self.dense, &mut self.trial_dense);
    }

    /// The last accepted step.
    pub fn kept(&self) -> Kept<'_> {
        Kept { start: &self.start, end: &self.end, rest: &self.dense }
    }
}

stored! {
    impl[] Progress { start, end, dense }
}

/// One integration method: makes steps and interpolates in the last one. What is stored is everything that the next steps
/// depend on.
pub trait Stepper<S: System>: Stored {
    /// Sets the state.
    fn set_state(&mut self, state: &[f64]);
    /// Evaluates what the next step starts from; called at the start and after events.
    ///
    /// # Errors
    /// The system's fault at this state.
    fn refresh(&mut self, system: &mut S, t: f64) -> Result<(), S::Fault>;
    /// Called before every attempt from time `t`: the method may measure the system and change itself. Returns the
    /// step to go on with, if it is to change.
    fn review(&mut self, _system: &mut S, _t: f64) -> Option<f64> {
        None
    }
    /// Forgets what was learned from earlier states.
    fn forget(&mut self) {}
    /// Counts from zero.
    fn reset_counts(&mut self) {}
    /// Tries a step of size `h` from time `t`; never evaluates later than `t_last`. Returns the error, if the method
    /// estimates it.
    ///
    /// # Errors
    /// The system's fault at a stage; the state is then unchanged.
    fn attempt(&mut self, system: &mut S, t: f64, h: f64, t_last: f64) -> Result<Option<Estimate>, S::Fault>;
    /// Makes the last attempt the current state.
    fn accept(&mut self);
    /// The last accepted step and the last attempt.
    fn progress(&self) -> &Progress;
    /// State at the end of the last accepted step.
    fn state(&self) -> &[f64] {
        &self.progress().end
    }
    /// What the last accepted step was made with, for methods whose forces are those of steps and not of states.
    fn applied(&self) -> Option<Applied<'_>> {
        self.applied_in(self.progress().kept())
    }
    /// State within the last accepted step at the fraction 0 <= `theta` <= 1 of it.
    fn interpolate(&self, theta: f64, out: &mut [f64]) {
        self.recall(&self.progress().kept(), theta, out);
    }
    /// Steps that are judged together before they count.
    fn longest_stretch(&self) -> Stretch {
        Stretch::default()
    }
    /// Whether the steps since the last judgement were right, at time `t`. If not, the driver goes back to their start.
    fn judge(&mut self, _system: &mut S, _t: f64) -> bool {
        true
    }
    /// Called at time `t` of the start of a stretch that was wrong, with the memory of then: the method must follow the
    /// system more closely. Returns the step to go on with, if it is to change.
    fn go_back(&mut self, _system: &mut S, _t: f64) -> Option<f64> {
        None
    }
    /// Appends what [`Stepper::recall`] needs to know of the last accepted step, beside the states at its ends.
    fn keep(&self, out: &mut Vec<f64>) {
        out.extend_from_slice(&self.progress().dense);
    }
    /// State within a step of which this was kept, at the fraction 0 <= `theta` <= 1 of it.
    fn recall(&self, kept: &Kept<'_>, theta: f64, out: &mut [f64]);
    /// As [`Stepper::applied`], of a step of which this was kept.
    fn applied_in<'a>(&self, _kept: Kept<'a>) -> Option<Applied<'a>> {
        None
    }
    /// How the steps follow the errors; of no use for methods without error estimate.
    fn control(&self) -> Law;
    /// What a method that chooses among others has chosen.
    fn choice(&self) -> Option<Choice> {
        None
    }
}
