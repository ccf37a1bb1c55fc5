//! Runs of all cases with all methods, and how far each is from the reference.

use crate::cvode::{self, Derivatives};
use crate::statistics::cases::Case;
use crate::statistics::methods::{METHODS, Method, Solver};
use crate::statistics::readings::{QUANTITIES, Record};
use cagedyn::sim::{LEVEL, Sample, Verdict};
use cagedyn::{Error, Result, Sim, Status};
use serde_json::json;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Largest step of CVODE, s: in free flight a step without limit jumps across contacts.
const CVODE_STEP: f64 = 1e-5;
/// Tolerance of CVODE in units of that of the case.
const CVODE_TOLERANCE: f64 = 0.1;

/// One run.
pub struct Run {
    /// Values of [`QUANTITIES`].
    pub values: Vec<Option<f64>>,
    /// Force evaluations per simulated time, 1/ms.
    pub evaluations: f64,
}

/// All runs of a method.
pub struct Outcome {
    /// The method.
    pub method: Method,
    /// Step of the leapfrog relative to the one that the library takes.
    pub own_steps: Option<f64>,
    /// Its runs, or why one ended early.
    pub runs: Result<Vec<Run>>,
}

/// All runs of a case.
pub struct Outcomes {
    /// Name of the case.
    pub name: &'static str,
    /// One per method.
    pub of: Vec<Outcome>,
}

/// Runs a case with all its methods on all cores; `runs` stands in for the number of runs of the case.
///
/// # Errors
/// Those of the scene; failures of runs are in the outcomes.
pub fn run_case(case: &Case, scenes: &Path, runs: Option<usize>) -> Result<Outcomes> {
    let text = case.text(scenes)?;
    let methods: Vec<Method> = METHODS.iter().chain(case.more).copied().collect();
    // The costly methods come first, so that no core waits for one at the end.
    let starts = |m: usize| (0..methods[m].repeats * runs.unwrap_or(case.runs)).map(move |k| (m, k));
    let tasks: Vec<(usize, usize)> = (0..methods.len()).flat_map(starts).collect();
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, |n| n.get()) {
            scope.spawn(|| {
                while let Some(&(m, k)) = tasks.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let run = run(case, &text, methods[m].solver, k);
                    done.lock().unwrap_or_else(|e| e.into_inner()).push((m, k, run));
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap_or_else(|e| e.into_inner());
    done.sort_by_key(|(m, k, _)| (*m, *k));
    let sim = case.sim(&text, None, 0)?;
    let mut of: Vec<Outcome> = Vec::new();
    for method in methods {
        let own_steps = match method.solver {
            Solver::Leapfrog(share) => Some(step(&sim, share) / sim.nominal_step()),
            _ => None,
        };
        of.push(Outcome { method, own_steps, runs: Ok(Vec::new()) });
    }
    for (m, _, run) in done {
        match (run, &mut of[m].runs) {
            (Ok(run), Ok(list)) => list.push(run),
            (Err(e), runs) => *runs = Err(e),
            _ => {}
        }
    }
    Ok(Outcomes { name: case.name, of })
}

/// Step of the leapfrog in s from a share of 1/(highest frequency).
fn step(sim: &Sim, share: f64) -> f64 {
    share / sim.model().highest_frequency()
}

/// The `k`-th run of a case.
///
/// # Errors
/// Those of scene and integration.
pub fn run(case: &Case, text: &str, solver: Solver, k: usize) -> Result<Run> {
    let method = match solver {
        Solver::Leapfrog(share) => {
            Some(json!({"leapfrog": {"step": step(&case.sim(text, None, k)?, share)}}))
        }
        Solver::Library(method) => Some(method(case.tolerance)),
        Solver::Cvode(_) => None,
    };
    let mut sim = case.sim(text, method.as_ref(), k)?;
    let mut record = Record::default();
    let times = case.times();
    let evaluations = if let Solver::Cvode(method) = solver {
        let solution = integrate(case, &mut sim, method, &times)?;
        for (t, state) in times.iter().zip(&solution.states) {
            sim.set_state(*t, state)?;
            record.add(&mut sim)?;
        }
        solution.statistics.evaluations
    } else {
        for t in &times {
            sim.advance_to(*t)?;
            record.add(&mut sim)?;
        }
        sim.statistics().evaluations
    };
    let simulated = case.settling + case.window;
    Ok(Run { values: record.values(&sim), evaluations: evaluations as f64 / (1e3 * simulated) })
}

fn integrate(case: &Case, sim: &mut Sim, method: cvode::Method, times: &[f64]) -> Result<cvode::Solution> {
    let absolute: Vec<f64> =
        sim.model().state_scales().iter().map(|s| CVODE_TOLERANCE * case.tolerance * s).collect();
    let start = sim.state().to_vec();
    let options = cvode::Options {
        method,
        relative: 0.0,
        absolute: &absolute,
        max_steps: 10_000_000,
        max_step: CVODE_STEP,
    };
    let mut rates = |t: f64, x: &[f64], rate: &mut [f64]| sim.derivative(t, x, rate).map_err(|_| ());
    cvode::solve(&options, 0.0, &start, times, &mut rates, Derivatives::Quotients)
        .map_err(|e| Error::new(Status::StepTooSmall, e))
}

impl Outcome {
    /// Values of quantity `i` of all runs, if it is defined in each.
    fn values(&self, i: usize) -> Option<Vec<f64>> {
        self.runs.as_ref().ok()?.iter().map(|run| run.values[i]).collect()
    }

    /// Mean force evaluations per simulated time over the runs, 1/ms.
    pub fn evaluations(&self) -> Option<f64> {
        let runs = self.runs.as_ref().ok()?;
        Some(runs.iter().map(|run| run.evaluations).sum::<f64>() / runs.len() as f64)
    }
}

impl Outcomes {
    /// Quantity `i` in the runs of all reference methods but that with index `without`.
    pub fn reference(&self, i: usize, without: Option<usize>) -> Option<Sample> {
        let methods = self.of.iter().enumerate().filter(|(m, o)| o.method.reference && Some(*m) != without);
        let values: Vec<f64> = methods.filter_map(|(_, outcome)| outcome.values(i)).flatten().collect();
        Sample::of(&values)
    }

    /// Number of quantities that the case has.
    pub fn quantities(&self) -> usize {
        (0..QUANTITIES.len()).filter(|&i| self.reference(i, None).is_some()).count()
    }

    /// Quantity `i` of method `m` against the reference; a reference method is compared with the others.
    pub fn verdict(&self, m: usize, i: usize) -> Option<Verdict> {
        let sample = Sample::of(&self.of[m].values(i)?)?;
        Some(sample.against(&self.reference(i, Some(m))?, LEVEL, self.quantities()))
    }
}
