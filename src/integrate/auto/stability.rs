//! Keeps the step of the leapfrog, which has no error estimate, below what its fastest vibration allows.
//!
//! The step is `share / highest frequency`, and half of it where that vibration is hardly damped. A system tells the frequency
//! that it expects; from time to time it is measured at the present state.

use crate::integrate::auto::mode::{Mode, ModeFinder};
use crate::integrate::{Complete, Leapfrog, Linearization, Stepper, Tuning};
use crate::stored::stored;

/// Most refinements of a step: no step is left after more.
const MOST_REFINED: u64 = 60;

/// What is known about a system before its first step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expectation {
    /// Highest frequency of undamped vibration, rad/s; zero if unknown.
    pub frequency: f64,
    /// Whether that vibration is damped.
    pub damped: bool,
    /// Step in units of 1/frequency.
    pub share: f64,
    /// The same once steps have missed too much energy; not more than `share`.
    pub careful_share: f64,
    /// Largest step, s.
    pub largest_step: f64,
}

impl Expectation {
    /// The step to start with, s.
    pub fn step(&self) -> f64 {
        self.step_at(self.share, self.frequency, self.damped)
    }

    fn step_at(&self, share: f64, frequency: f64, damped: bool) -> f64 {
        (share / frequency).min(self.largest_step) * if damped { 1.0 } else { 0.5 }
    }
}

/// What a look leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Go on.
    Keep,
    /// Go on with another step.
    Change,
    /// Stable steps would cost as much as error control.
    TooFast,
}

/// The monitor and its memory.
#[derive(Clone, Debug)]
pub struct StabilityMonitor<const N: usize> {
    tuning: Tuning,
    expected: Expectation,
    finder: ModeFinder<N>,
    slopes: Linearization<N>,
    a: Vec<f64>,
    /// Steps until the next look.
    due: u64,
    /// Highest frequency that the step rests on, rad/s, and whether its vibration is damped.
    frequency: f64,
    damped: bool,
    /// Whether a step that rested on them missed too much energy.
    careful: bool,
    /// How many times the step is halved for what no frequency tells, such as the onset of damping.
    refinement: u64,
    /// What error control advanced per evaluation when it was seen last, s; zero before.
    rival: f64,
    /// Highest frequency met, rad/s.
    highest: f64,
}

impl<const N: usize> StabilityMonitor<N> {
    /// A monitor of a system; `units` are one unit of error of each state.
    pub fn new<S: Complete<N>>(system: &S, expected: Expectation, units: &[f64], tuning: Tuning) -> Self {
        let structure = system.structure();
        Self {
            tuning,
            expected,
            finder: ModeFinder::new(&structure, system.positions(), units),
            slopes: Linearization::new(&structure, system.velocities()),
            a: vec![0.0; system.velocities()],
            due: 0,
            frequency: expected.frequency,
            damped: expected.damped,
            careful: false,
            refinement: 0,
            rival: 0.0,
            highest: 0.0,
        }
    }

    /// Forgets everything that steps rest on.
    pub fn forget(&mut self) {
        self.due = 0;
        (self.frequency, self.damped) = (self.expected.frequency, self.expected.damped);
        self.careful = false;
        (self.refinement, self.rival) = (0, 0.0);
    }

    /// Forgets the highest frequency met.
    pub fn reset_highest(&mut self) {
        self.highest = 0.0;
    }

    /// The steps of the leapfrog missed too much energy: from now on they are careful ones.
    pub fn take_care(&mut self) {
        self.careful = true;
    }

    /// Highest frequency met, rad/s.
    pub fn highest_frequency(&self) -> f64 {
        self.highest
    }

    /// Step of the leapfrog, s.
    pub fn step(&self) -> f64 {
        self.refined_step(self.refinement)
    }

    fn refined_step(&self, refinement: u64) -> f64 {
        let Expectation { share, careful_share, .. } = self.expected;
        let share = if self.careful { careful_share } else { share };
        self.expected.step_at(share, self.frequency, self.damped) * 0.5f64.powi(refinement as i32)
    }

    /// Error control advanced by so many s with so many evaluations.
    pub fn note_rival(&mut self, advanced: f64, cost: f64) {
        if cost > 0.0 {
            self.rival = advanced / cost;
        }
    }

    /// Whether error control is known to advance clearly less per evaluation than this step, s.
    fn beats_rival(&self, step: f64) -> bool {
        self.rival > 0.0 && step > self.tuning.finer_lead * self.rival
    }

    /// How often the step has been refined.
    pub fn refinement(&self) -> u64 {
        self.refinement
    }

    /// Goes on from this refinement with the next one, if such steps cost clearly less than error control. Whether it does.
    pub fn refine(&mut self, refinement: u64) -> bool {
        let cheaper = refinement < MOST_REFINED && self.beats_rival(self.refined_step(refinement + 1));
        self.refinement = if cheaper { refinement + 1 } else { refinement };
        cheaper
    }

    /// Takes all refinement back.
    pub fn relax(&mut self) {
        self.refinement = 0;
    }

    /// Takes the last refinement back. Whether there was one.
    pub fn coarsen(&mut self) -> bool {
        let refined = self.refinement > 0;
        self.refinement = self.refinement.saturating_sub(1);
        refined
    }

    /// One more step was made.
    pub fn count_step(&mut self) {
        self.due = self.due.saturating_sub(1);
    }

    /// Measures, if it is time to, at the state of `main` at time `t` (s).
    pub fn look<S: Complete<N>>(&mut self, system: &mut S, main: &Leapfrog<N>, t: f64) -> Verdict {
        if self.due > 0 {
            return Verdict::Keep;
        }
        self.due = self.tuning.frequency_interval;
        let before = self.step();
        self.measure(system, main, t);
        if self.too_fast() {
            Verdict::TooFast
        } else if self.step() == before {
            Verdict::Keep
        } else {
            Verdict::Change
        }
    }

    /// Whether the leapfrog could go on from the state that `main` has been set to at time `t` (s).
    pub fn allows<S: Complete<N>>(&mut self, system: &mut S, main: &Leapfrog<N>, t: f64) -> bool {
        self.due = self.tuning.frequency_interval;
        self.measure(system, main, t);
        !self.too_fast()
    }

    /// What error control costs is guessed until it has been seen.
    fn too_fast(&self) -> bool {
        self.frequency > self.tuning.highest_frequency * self.expected.frequency
            && !self.beats_rival(self.step())
    }

    fn measure<S: Complete<N>>(&mut self, system: &mut S, main: &Leapfrog<N>, t: f64) {
        let (q, v) = Stepper::<S>::state(main).split_at(system.positions());
        if system.linearize(t, q, v, &mut self.a, &mut self.slopes).is_err() {
            return;
        }
        let Mode { frequency, damping_ratio } = self.finder.find(&self.slopes);
        self.highest = self.highest.max(frequency);
        let (known, clear) = (frequency.max(self.expected.frequency), self.tuning.clear_difference);
        if known > clear * self.frequency || self.frequency > clear * known {
            self.frequency = known;
        }
        // A slow vibration says nothing about the damping of the fast one.
        let fast = frequency >= 0.5 * self.frequency;
        self.damped = self.expected.damped && !(fast && damping_ratio < self.tuning.light_damping);
    }
}

stored! {
    impl[const N: usize] StabilityMonitor<N> { due, frequency, highest, damped, careful, refinement, rival }
    if |monitor| monitor.frequency >= 0.0 && monitor.highest >= 0.0 && monitor.rival >= 0.0 && monitor.refinement <= MOST_REFINED
}
