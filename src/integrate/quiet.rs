//! Tells whether a run is quiet: whether error control costs little more than a method of fixed step.
//!
//! Error control is tried on the run itself at the start, after events, and from time to time. It stays as long as all it has
//! cost is below a few times what the fixed step would have, and some evaluations on top; more of them after an event, as
//! the transient that follows is what the run is about. After a trial in vain the next one waits twice as long. All of it
//! counts evaluations and not seconds of a clock, so it is reproducible.

use super::Reader;

/// Evaluations on top in a trial, and after an event.
const ALLOWANCE: f64 = 300.0;
const TRANSIENT: f64 = 3000.0;
/// What events may take together, and the share of all evaluations that is added to it: events may follow each other closely.
const RESERVE: f64 = 2.0 * TRANSIENT;
const REFILL: f64 = 0.05;
/// A phase of this many evaluations was worth it.
const SUCCESS: f64 = 2000.0;
/// Steps of the other method between trials: at first, and at most.
const FIRST_PAUSE: u64 = 8192;
const LONGEST_PAUSE: u64 = 64 * FIRST_PAUSE;

/// Watches error control and calls for its trials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quiet {
    /// Simulated time in s and evaluations of the present phase.
    advanced: f64,
    cost: f64,
    /// Evaluations on top in this phase, and those left for events.
    allowance: f64,
    reserve: f64,
    /// Steps of the other method until the next trial, and between trials.
    wait: u64,
    pause: u64,
}

impl Quiet {
    /// A trial begins.
    pub fn new() -> Self {
        Self { advanced: 0.0, cost: 0.0, allowance: ALLOWANCE, reserve: RESERVE, wait: 0, pause: FIRST_PAUSE }
    }

    /// Error control made an accepted step of `advance` s.
    pub fn note_advance(&mut self, advance: f64) {
        self.advanced += advance;
    }

    /// Error control spent evaluations.
    pub fn note_cost(&mut self, evaluations: f64) {
        self.cost += evaluations;
        self.refill(evaluations);
    }

    /// The other method made a step.
    pub fn count_step(&mut self) {
        self.wait = self.wait.saturating_sub(1);
        self.refill(1.0);
    }

    fn refill(&mut self, evaluations: f64) {
        self.reserve = (self.reserve + REFILL * evaluations).min(RESERVE);
    }

    /// An event: error control is tried at once, unless there were too many of them.
    pub fn note_event(&mut self) {
        if self.reserve >= TRANSIENT {
            self.wait = 0;
            (self.advanced, self.cost) = (0.0, 0.0);
            self.allowance = TRANSIENT;
            self.reserve -= TRANSIENT;
        }
    }

    /// Whether it is time for error control to be tried, which then begins.
    pub fn begins(&mut self) -> bool {
        let begins = self.wait == 0;
        if begins {
            (self.advanced, self.cost) = (0.0, 0.0);
        }
        begins
    }

    /// Whether error control has cost more than `affordable` evaluations for one of a fixed step of `step` s, and another method
    /// takes over.
    pub fn ends(&mut self, affordable: f64, step: f64) -> bool {
        let ends = self.cost > affordable * self.advanced / step + self.allowance;
        if ends {
            self.end();
        }
        ends
    }

    /// Another method takes over.
    pub fn end(&mut self) {
        self.allowance = ALLOWANCE;
        if self.cost > SUCCESS {
            self.pause = FIRST_PAUSE;
        }
        self.wait = self.pause;
        self.pause = (2 * self.pause).min(LONGEST_PAUSE);
    }

    /// Appends everything that the next decisions depend on.
    pub fn save(&self, out: &mut Vec<f64>) {
        out.extend([self.advanced, self.cost, self.allowance, self.reserve]);
        out.extend([self.wait, self.pause].map(|n| n as f64));
    }

    /// Takes back what [`Quiet::save`] wrote; `None` if it does not fit.
    pub fn load(&mut self, from: &mut Reader<'_>) -> Option<()> {
        for number in [&mut self.advanced, &mut self.cost, &mut self.allowance, &mut self.reserve] {
            *number = from.number().filter(|x| *x >= 0.0)?;
        }
        self.wait = from.count()?;
        self.pause = from.count().filter(|n| (FIRST_PAUSE..=LONGEST_PAUSE).contains(n))?;
        Some(())
    }
}
