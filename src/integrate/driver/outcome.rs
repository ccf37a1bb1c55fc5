//! What a run may use, what it has used, and how it can end.

use crate::integrate::{Interruption, Vibration};

/// Limits of the step size and the number of steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// First step, and for methods without error estimate the nominal step, s.
    pub nominal_step: f64,
    /// Smallest step, s.
    pub min_step: f64,
    /// Largest step of methods with error estimate, s.
    pub max_step: f64,
    /// Largest number of attempts in one advance.
    pub max_steps: u64,
}

/// Counts of a driver.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Accepted steps.
    pub steps: u64,
    /// Steps rejected by the error estimate.
    pub rejected: u64,
    /// Steps abandoned because forces were undefined.
    pub faults: u64,
    /// Events landed on.
    pub events: u64,
    /// Steps that were taken back, which count nowhere else.
    pub undone: u64,
    /// Smallest accepted step that was not cut by an event, s; zero before the first.
    pub smallest_step: f64,
    /// Largest accepted step, s.
    pub largest_step: f64,
    /// Vibration over time; its root mean square is a number of health.
    pub vibration: Vibration,
}

/// Why a run cannot go on. The state is that of the last accepted step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Failure<F> {
    /// Forces are undefined at the start.
    AtStart {
        /// Time, s.
        time: f64,
        /// What is wrong.
        fault: F,
    },
    /// The works of all forces are such as no system can have.
    Overdrawn {
        /// Time reached, s.
        time: f64,
        /// What is wrong.
        fault: F,
    },
    /// The step size fell below its minimum.
    StepTooSmall {
        /// Time, s.
        time: f64,
        /// Step that would be needed, s.
        step: f64,
        /// The last fault, if a fault made the step small.
        fault: Option<F>,
        /// The group with the largest error, if the error estimate did.
        group: Option<usize>,
    },
    /// The limit on the number of steps was reached.
    TooManySteps {
        /// Time reached, s.
        time: f64,
        /// The limit.
        limit: u64,
    },
    /// The host wanted the run to stop.
    Interrupted {
        /// Time reached, s.
        time: f64,
        /// Why.
        why: Interruption,
    },
}

impl<F> Failure<F> {
    /// The same at another time (s).
    pub(super) fn at(mut self, now: f64) -> Self {
        let (Self::AtStart { time, .. }
        | Self::Overdrawn { time, .. }
        | Self::StepTooSmall { time, .. }
        | Self::TooManySteps { time, .. }
        | Self::Interrupted { time, .. }) = &mut self;
        *time = now;
        self
    }
}
