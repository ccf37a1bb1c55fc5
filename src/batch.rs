//! Many simulations at once, on all cores: each gives the bits that it would give alone.

use crate::error::{Error, Result, Status};
use crate::registry::registry;
use crate::sim::{Canceller, Sim};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Parts of its way after which a simulation tells how far it is.
const PARTS: u32 = 20;

registry! {
    /// A number of [`Progress::values`].
    pub(crate) enum ProgressItem,
    /// Names of [`Progress::values`].
    pub const PROGRESS {
        Simulations = "simulations",
        Waiting = "waiting",
        Running = "running",
        Arrived = "arrived",
        Failed = "failed",
        Share = "share",
    }
}

/// How far the running [`advance_all`] is, or how far the last one came.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Progress {
    /// Simulations in it.
    pub simulations: usize,
    /// Those that have not begun.
    pub waiting: usize,
    /// Those that run.
    pub running: usize,
    /// Those that are where they should go.
    pub arrived: usize,
    /// Those that could not go on, or were stopped.
    pub failed: usize,
    /// Share of the way that is done, of all simulations together, from 0 to 1.
    pub share: f64,
}

impl Progress {
    /// The numbers named by [`PROGRESS`].
    pub fn values(&self) -> [f64; PROGRESS.len()] {
        ProgressItem::ALL.map(|item| match item {
            ProgressItem::Simulations => self.simulations as f64,
            ProgressItem::Waiting => self.waiting as f64,
            ProgressItem::Running => self.running as f64,
            ProgressItem::Arrived => self.arrived as f64,
            ProgressItem::Failed => self.failed as f64,
            ProgressItem::Share => self.share,
        })
    }
}

/// Watches and stops [`advance_all`] from any thread. Clones watch the same calls.
#[derive(Clone, Debug, Default)]
pub struct Monitor(Arc<Mutex<Watched>>);

#[derive(Debug, Default)]
struct Watched {
    progress: Progress,
    /// Parts that are done.
    parts: u64,
    /// Of the simulations that run.
    running: Vec<(usize, Canceller)>,
    cancelled: bool,
}

impl Monitor {
    /// How far the running call is, or how far the last one came; all zero before the first.
    pub fn progress(&self) -> Progress {
        self.lock().progress
    }

    /// Stops the running call, or else the next one: simulations that run end with [`Status::Cancelled`] after their present
    /// step, and so do those that wait. The request is then spent, and all of them can go on.
    pub fn cancel(&self) {
        let mut watched = self.lock();
        watched.cancelled = true;
        watched.running.iter().for_each(|(_, canceller)| canceller.cancel());
    }

    fn lock(&self) -> MutexGuard<'_, Watched> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn begin(&self, simulations: usize) {
        let mut watched = self.lock();
        watched.parts = 0;
        watched.progress = Progress { simulations, waiting: simulations, ..Progress::default() };
    }

    /// Lets a simulation run, unless the call was stopped.
    fn start(&self, place: usize, canceller: Canceller) -> Result<()> {
        let mut watched = self.lock();
        watched.progress.waiting -= 1;
        watched.progress.running += 1;
        if watched.cancelled {
            return Err(Error::new(Status::Cancelled, "stopped before it began, as requested".to_owned()));
        }
        watched.running.push((place, canceller));
        Ok(())
    }

    /// One part of the way of a simulation is done.
    fn count_part(&self) {
        let mut watched = self.lock();
        watched.parts += 1;
        let all = watched.progress.simulations as f64 * f64::from(PARTS);
        watched.progress.share = watched.parts as f64 / all;
    }

    fn end(&self, place: usize, arrived: bool) {
        let mut watched = self.lock();
        watched.running.retain(|(running, _)| *running != place);
        watched.progress.running -= 1;
        if arrived {
            watched.progress.arrived += 1;
        } else {
            watched.progress.failed += 1;
        }
    }
}

/// Advances every simulation to time `t` (s), on so many threads; as many as there are cores for 0. Returns what became of
/// each, in their order. One that fails is where [`Sim::advance_to`] leaves it, and does not stop the others. Results do not
/// depend on the number of threads. Those that will take longest should come first.
///
/// # Errors
/// Of each as [`Sim::advance_to`].
pub fn advance_all<S: AsMut<Sim> + Send>(
    sims: &mut [S],
    t: f64,
    threads: usize,
    monitor: &Monitor,
) -> Vec<Result<()>> {
    monitor.begin(sims.len());
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    let threads = if threads == 0 { cores() } else { threads }.clamp(1, sims.len().max(1));
    let mut results = vec![Ok(()); sims.len()];
    let queue = Mutex::new(sims.iter_mut().zip(&mut results).enumerate());
    let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
    let work = || {
        while let Some((place, (sim, result))) = next() {
            *result = advance(place, sim.as_mut(), t, monitor);
        }
    };
    std::thread::scope(|scope| {
        // This thread works, too; where no other can be had, alone.
        let start = |_| std::thread::Builder::new().spawn_scoped(scope, work).ok();
        let others: Vec<_> = (1..threads).map_while(start).collect();
        work();
        // Threads are gone when this returns.
        others.into_iter().for_each(|thread| drop(thread.join()));
    });
    monitor.lock().cancelled = false;
    results
}

/// Advances one of them. A defect in one must not stop the others.
fn advance(place: usize, sim: &mut Sim, t: f64, monitor: &Monitor) -> Result<()> {
    let result = monitor.start(place, sim.canceller()).and_then(|()| {
        let run = catch_unwind(AssertUnwindSafe(|| advance_in_parts(sim, t, monitor)));
        run.unwrap_or_else(|_| Err(Error::new(Status::Internal, "internal defect".to_owned())))
    });
    monitor.end(place, result.is_ok());
    // A request that came too late is no reason to stop the next time.
    sim.withdraw_cancellation();
    result
}

fn advance_in_parts(sim: &mut Sim, t: f64, monitor: &Monitor) -> Result<()> {
    let start = sim.time();
    for part in 1..=PARTS {
        let at = start + (t - start) * f64::from(part) / f64::from(PARTS);
        sim.advance_to(if part == PARTS { t } else { at.max(sim.time()) })?;
        monitor.count_part();
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Model;

    struct One(Sim);

    impl AsMut<Sim> for One {
        fn as_mut(&mut self) -> &mut Sim {
            &mut self.0
        }
    }

    /// Six simulations that start differently.
    fn six() -> Vec<One> {
        let model = Arc::new(Model::from_json(include_str!("../scenes/nu2310.json")).unwrap());
        let start = |k: usize| {
            let mut sim = Sim::new(model.clone()).unwrap();
            let mut state = sim.state().to_vec();
            state[2] += 1e-7 * k as f64;
            sim.set_state(0.0, &state).unwrap();
            One(sim)
        };
        (0..6).map(start).collect()
    }

    fn bits(sims: &[One]) -> Vec<u64> {
        sims.iter().flat_map(|one| one.0.state()).map(|x| x.to_bits()).collect()
    }

    #[test]
    fn every_number_of_threads_gives_the_bits_of_single_runs() {
        let mut alone = six();
        for one in &mut alone {
            one.0.advance_to(2e-3).unwrap();
        }
        for threads in [0, 1, 2, 5, 100] {
            let (mut sims, monitor) = (six(), Monitor::default());
            assert_eq!(advance_all(&mut sims, 2e-3, threads, &monitor), vec![Ok(()); 6]);
            assert_eq!(bits(&sims), bits(&alone));
            let done = Progress { simulations: 6, arrived: 6, share: 1.0, ..Progress::default() };
            assert_eq!(monitor.progress(), done);
        }
        assert_eq!(advance_all(&mut six()[..0], 1.0, 3, &Monitor::default()), []);
    }

    #[test]
    fn one_that_fails_keeps_its_error_and_stops_no_other() {
        let (mut sims, monitor) = (six(), Monitor::default());
        sims[2].0.set_wall_time_limit(0.0).unwrap();
        sims[4].0.advance_to(3e-3).unwrap();
        let results = advance_all(&mut sims, 2e-3, 2, &monitor);
        let status = results.iter().map(|r| r.as_ref().map_or_else(|e| e.status, |()| Ok));
        use Status::{BadValue, Ok, OutOfTime};
        assert_eq!(status.collect::<Vec<_>>(), [Ok, Ok, OutOfTime, Ok, BadValue, Ok]);
        let Progress { arrived, failed, waiting, running, .. } = monitor.progress();
        assert_eq!([arrived, failed, waiting, running], [4, 2, 0, 0]);
    }

    #[test]
    fn all_can_be_stopped_and_go_on() {
        let (mut sims, monitor) = (six(), Monitor::default());
        let results = std::thread::scope(|scope| {
            scope.spawn(|| {
                while monitor.progress().running == 0 {
                    std::thread::yield_now();
                }
                monitor.cancel();
            });
            advance_all(&mut sims, 1e3, 2, &monitor)
        });
        assert!(results.iter().all(|r| r.as_ref().is_err_and(|e| e.status == Status::Cancelled)));
        let furthest = sims.iter().map(|one| one.0.time()).fold(0.0, f64::max);
        assert_eq!(advance_all(&mut sims, furthest + 1e-4, 2, &monitor), vec![Ok(()); 6]);
    }
}
