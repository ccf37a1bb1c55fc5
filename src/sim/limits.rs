//! What may stop a run from outside: a limit on its wall time, and requests from other threads.

use crate::integrate::Interruption;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

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
}

impl RunLimits {
    pub(super) fn canceller(&self) -> Canceller {
        self.canceller.clone()
    }

    /// Takes back a request that was not heard yet.
    pub(super) fn withdraw(&self) {
        self.canceller.0.store(false, Ordering::Relaxed);
    }

    /// Lets runs end `seconds` of wall time from now; infinity for never.
    pub(super) fn set_wall_time(&mut self, seconds: f64) {
        // What a clock cannot count to is never.
        self.deadline =
            Duration::try_from_secs_f64(seconds).ok().and_then(|left| Instant::now().checked_add(left));
    }

    /// Whether to stop before the next attempted step. Looks at the clock each time: one attempt can take long.
    pub(super) fn interruption(&mut self) -> Option<Interruption> {
        if self.canceller.0.load(Ordering::Relaxed) {
            self.canceller.0.store(false, Ordering::Relaxed);
            return Some(Interruption::Cancelled);
        }
        (Instant::now() >= self.deadline?).then_some(Interruption::OutOfTime)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_clock_is_read_before_every_attempt() {
        let mut limits = RunLimits::default();
        limits.set_wall_time(3600.0);
        assert_eq!(limits.interruption(), None);
        limits.deadline = Some(Instant::now());
        assert_eq!(limits.interruption(), Some(Interruption::OutOfTime));
        limits.set_wall_time(f64::INFINITY);
        assert_eq!(limits.interruption(), None);
    }
}
