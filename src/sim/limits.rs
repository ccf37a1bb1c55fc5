//! What may stop a run from outside: a limit on its wall time, and requests from other threads.

use crate::integrate::Interruption;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Steps between two looks at the clock.
const CLOCK_INTERVAL: u32 = 16;

/// Asks one simulation to stop, from any thread. Clones ask the same simulation; one that outlives it asks nobody.
#[derive(Clone, Debug, Default)]
pub struct Canceller(Arc<AtomicBool>);

impl Canceller {
    /// Makes the running advance, or else the next one, end with [`crate::Status::Cancelled`] after its present step. The
    /// request is then spent; resetting or restoring the simulation does not take it back.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// The limits of one simulation.
#[derive(Debug, Default)]
pub(super) struct RunLimits {
    canceller: Canceller,
    deadline: Option<Instant>,
    /// Steps until the clock is looked at.
    until_look: u32,
}

impl RunLimits {
    pub(super) fn canceller(&self) -> Canceller {
        self.canceller.clone()
    }

    /// Lets runs end `seconds` of wall time from now; infinity for never.
    pub(super) fn set_wall_time(&mut self, seconds: f64) {
        // What a clock cannot count to is never.
        self.deadline =
            Duration::try_from_secs_f64(seconds).ok().and_then(|left| Instant::now().checked_add(left));
        self.until_look = 0;
    }

    /// Whether to stop, with a look at the clock.
    pub(super) fn interruption_now(&mut self) -> Option<Interruption> {
        self.until_look = 0;
        self.interruption()
    }

    /// Whether to stop before the next step.
    pub(super) fn interruption(&mut self) -> Option<Interruption> {
        if self.canceller.0.load(Ordering::Relaxed) {
            self.canceller.0.store(false, Ordering::Relaxed);
            return Some(Interruption::Cancelled);
        }
        let deadline = self.deadline?;
        if self.until_look > 0 {
            self.until_look -= 1;
            return None;
        }
        if Instant::now() >= deadline {
            return Some(Interruption::OutOfTime);
        }
        self.until_look = CLOCK_INTERVAL;
        None
    }
}
