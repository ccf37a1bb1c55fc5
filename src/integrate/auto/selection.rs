//! Chooses between two methods of equal accuracy by what they achieve: simulated time per force evaluation.
//!
//! Both work on the run itself, so a trial of the slower one costs time but no accuracy. A method that loses waits
//! twice as long for its next trial. All of it counts evaluations and not seconds of a clock, so it is reproducible.

use crate::integrate::Tuning;
use crate::stored::stored;

/// Two methods, numbered 0 and 1, one of which is active.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Selection {
    tuning: Tuning,
    active: usize,
    /// Simulated time in s and evaluations in the present window.
    advanced: f64,
    cost: f64,
    /// Simulated time per evaluation in the last window of each, s.
    rates: [f64; 2],
    /// Whether the active method is on trial.
    trial: bool,
    /// Windows until the next trial, and between trials.
    wait: f64,
    pause: f64,
}

impl Selection {
    /// A selection in which `first` is active.
    pub fn new(first: usize, tuning: Tuning) -> Self {
        Self {
            tuning,
            active: first,
            advanced: 0.0,
            cost: 0.0,
            rates: [0.0; 2],
            trial: false,
            wait: tuning.first_trial,
            pause: tuning.first_trial,
        }
    }

    /// The active method.
    pub fn active(&self) -> usize {
        self.active
    }

    /// Whether the active method is on trial.
    pub fn on_trial(&self) -> bool {
        self.trial
    }

    /// How many times as far as the other the active method advances with one evaluation; zero before both have been
    /// tried.
    pub fn lead(&self) -> f64 {
        let other = self.rates[1 - self.active];
        if other > 0.0 { self.rates[self.active] / other } else { 0.0 }
    }

    /// The active method made an accepted step of `advance` s.
    pub fn note_advance(&mut self, advance: f64) {
        self.advanced += advance;
    }

    /// The active method spent evaluations.
    pub fn note_cost(&mut self, evaluations: f64) {
        self.cost += evaluations;
    }

    /// The active method cannot go on: the other takes over, and it waits.
    pub fn give_up(&mut self) {
        self.rates[self.active] = 0.0;
        self.pause = (2.0 * self.pause).min(self.tuning.longest_trial);
        (self.trial, self.wait) = (false, self.pause);
        (self.advanced, self.cost) = (0.0, 0.0);
        self.active = 1 - self.active;
    }

    /// At the end of a window: decides. Whether the active method changed.
    pub fn decide(&mut self) -> bool {
        self.decide_below(f64::INFINITY)
    }

    /// The same, but the other method is not tried where the active one advances by more than `limit` s per evaluation.
    pub fn decide_below(&mut self, limit: f64) -> bool {
        if self.cost < self.tuning.window {
            return false;
        }
        let rate = self.advanced / self.cost;
        self.rates[self.active] = rate;
        (self.advanced, self.cost) = (0.0, 0.0);
        let other = 1 - self.active;
        if self.trial {
            self.trial = false;
            self.wait = self.pause;
            if self.rates[self.active] > self.tuning.clear_lead * self.rates[other] {
                self.pause = self.tuning.first_trial;
                return false;
            }
            self.pause = (2.0 * self.pause).min(self.tuning.longest_trial);
            self.active = other;
            return true;
        }
        if rate > limit {
            return false;
        }
        self.wait -= 1.0;
        if self.wait > 0.0 {
            return false;
        }
        self.trial = true;
        self.active = other;
        true
    }

    /// Whether a state that was loaded is one that a selection can have.
    fn is_sound(&self) -> bool {
        let pauses = self.tuning.first_trial..=self.tuning.longest_trial;
        let mut numbers = self.rates.iter().chain([&self.advanced, &self.cost]);
        self.active < 2 && pauses.contains(&self.pause) && numbers.all(|x| *x >= 0.0)
    }
}

stored! {
    impl[] Selection { active, advanced, cost, rates, trial, wait, pause }
    if Self::is_sound
}
