//! What may stop a run from outside: a limit on its wall time, and requests from other threads; and how far it is.

use crate::error::{Error, Result, Status};
use crate::integrate::Interruption;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Asks one simulation or search to stop, from any thread. Clones ask the same one; one that outlives it asks nobody.
#[derive(Clone, Debug, Default)]
pub struct Canceller(Arc<AtomicBool>);

impl Canceller {
    /// Makes the running call, or else the next one, end with [`crate::Status::Cancelled`] after its present step. The
    /// request is then spent; resetting or restoring a simulation does not take it back.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// The limits of one simulation, or of one search of [`crate::whirl`] or [`crate::heat`], which tells here how far it is. Clones
/// share requests to stop and progress; a wall time is that of each.
#[derive(Clone, Debug, Default)]
pub struct RunLimits {
    canceller: Canceller,
    deadline: Option<Instant>,
    progress: Arc<Progress>,
}

/// Share of the way that is done, as bits, and how many pieces of the result there are.
#[derive(Debug, Default)]
struct Progress {
    share: AtomicU64,
    found: AtomicUsize,
}

impl RunLimits {
    /// What stops it from another thread.
    pub fn canceller(&self) -> Canceller {
        self.canceller.clone()
    }

    /// Lets it run for `seconds` of wall time from now; infinity for no limit, as at first.
    ///
    /// # Errors
    /// [`Status::BadValue`] if it is negative or NaN.
    pub fn set_wall_time(&mut self, seconds: f64) -> Result<()> {
        if seconds.is_nan() || seconds < 0.0 {
            return Err(Error::new(Status::BadValue, format!("seconds: {seconds} is not 0 or more")));
        }
        // What a clock cannot count to is never.
        self.deadline =
            Duration::try_from_secs_f64(seconds).ok().and_then(|left| Instant::now().checked_add(left));
        Ok(())
    }

    /// Share of the way that a search has done, from 0 to 1; rough where its length is not known before. May be asked from any thread.
    pub fn share(&self) -> f64 {
        f64::from_bits(self.progress.share.load(Ordering::Relaxed))
    }

    /// Pieces of its result that a search has found: whirls, bursts of motion, speeds of onset. May be asked from any thread.
    pub fn found(&self) -> usize {
        self.progress.found.load(Ordering::Relaxed)
    }

    pub(crate) fn tell(&self, share: f64, found: usize) {
        self.progress.share.store(share.clamp(0.0, 1.0).to_bits(), Ordering::Relaxed);
        self.progress.found.store(found, Ordering::Relaxed);
    }

    /// Takes back a request that was not heard yet.
    pub(crate) fn withdraw(&self) {
        self.canceller.0.store(false, Ordering::Relaxed);
    }

    /// Why to stop, if so. Looks at the clock each time: one attempt of a step can take long.
    fn why(&self) -> Option<Interruption> {
        if self.canceller.0.load(Ordering::Relaxed) {
            return Some(Interruption::Cancelled);
        }
        let deadline = self.deadline?;
        (Instant::now() >= deadline).then_some(Interruption::OutOfTime)
    }

    /// Whether to stop before the next attempted step. A request is spent with that.
    pub(super) fn interruption(&self) -> Option<Interruption> {
        let why = self.why();
        if why == Some(Interruption::Cancelled) {
            self.withdraw();
        }
        why
    }

    /// The same for the many parts of a search, which all must end: the request stays until [`RunLimits::searching`] is over.
    pub(crate) fn check(&self) -> Result<()> {
        match self.why() {
            None => Ok(()),
            Some(Interruption::Cancelled) => {
                Err(Error::new(Status::Cancelled, "stopped on request".to_owned()))
            }
            Some(Interruption::OutOfTime) => {
                Err(Error::new(Status::OutOfTime, "the limit on the wall time is reached".to_owned()))
            }
        }
    }

    /// One whole search; a request to stop is spent with it.
    pub(crate) fn searching<T>(&self, search: impl FnOnce() -> Result<T>) -> Result<T> {
        self.tell(0.0, 0);
        let found = search();
        // A branch that was ended keeps its share.
        if found.is_ok() && self.why().is_none() {
            self.tell(1.0, self.found().max(1));
        }
        self.withdraw();
        found
    }

    /// Lets a simulation that is part of a search go on to time `t` (s), within the limits of the search.
    pub(crate) fn advance(&self, sim: &mut super::Sim, t: f64) -> Result<()> {
        sim.set_limits(self);
        // The request is one to the whole search, not to this simulation alone.
        sim.advance_to(t).inspect_err(|e| {
            if e.status == Status::Cancelled {
                self.canceller.cancel();
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_clock_is_read_before_every_attempt() {
        let mut limits = RunLimits::default();
        limits.set_wall_time(3600.0).unwrap();
        assert_eq!(limits.interruption(), None);
        limits.deadline = Some(Instant::now());
        assert_eq!(limits.interruption(), Some(Interruption::OutOfTime));
        limits.set_wall_time(f64::INFINITY).unwrap();
        assert_eq!(limits.interruption(), None);
    }
}
