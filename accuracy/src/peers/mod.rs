//! Well-known solvers of ordinary differential equations, written by others, each behind the same small function: a [`Task`]
//! in, states at its times out. They know nothing of bearings and get states in units of their scales, so that one absolute
//! tolerance fits all of them; the relative tolerance is zero.
//!
//! | module | method | code |
//! |---|---|---|
//! | [`lsoda`] | Adams and BDF, switching by itself | the C port of ODEPACK in scipy |
//! | [`dop853`] | Dormand-Prince 8(5,3) | crate `ivp` |
//! | [`radau`] | Radau IIA, order 5 | crate `ivp` |
//! | [`diffsol`] | BDF | crate `diffsol` |

#![allow(unsafe_code)]

pub mod diffsol;
pub mod dop853;
pub mod lsoda;
pub mod radau;

use libloading::Library;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

/// Writes rates (or the Jacobian by columns, n*n) at a time and a state;
/// `Err(())` means undefined there.
pub type Function<'a> = dyn FnMut(f64, &[f64], &mut [f64]) -> Result<(), ()> + 'a;

/// An initial value problem and how to solve it.
pub struct Task<'a, 'r, 'j> {
    /// Absolute tolerance of every state.
    pub tolerance: f64,
    /// Largest step in seconds; may be infinity.
    pub max_step: f64,
    pub start: f64,
    pub state: &'a [f64],
    /// Output times, growing, none before `start`.
    pub times: &'a [f64],
    /// The run fails once the rates were asked for more often.
    pub max_evaluations: u64,
    pub rates: &'a mut Function<'r>,
    pub jacobian: Option<&'a mut Function<'j>>,
}

/// What a solver needs to know besides the functions.
pub(crate) struct Setup<'a> {
    pub tolerance: f64,
    pub max_step: f64,
    pub start: f64,
    pub state: &'a [f64],
    pub times: &'a [f64],
}

impl Setup<'_> {
    pub fn end(&self) -> f64 {
        self.times.last().copied().unwrap_or(self.start)
    }
}

/// Size of the rates that stand for undefined ones.
const POISON: f64 = 1e60;

/// Thrown, without the panic message, to leave a solver that used up its evaluations.
struct Exhausted;

/// The functions of a task as solvers without recoverable failures need them.
///
/// Undefined rates become huge ones whose sign alternates from call to call:
/// every error estimate and every Newton or functional iteration then fails and
/// the step is rejected.  NaN does not do: LSODA takes norms with `max` and
/// `ivp`'s Radau clamps its error with `max`, which drops NaN and accepts the step.
pub(crate) struct Guard<'a, 'r, 'j> {
    rates: &'a mut Function<'r>,
    jacobian: Option<&'a mut Function<'j>>,
    remaining: u64,
    poison: f64,
    tolerance: f64,
}

impl Guard<'_, '_, '_> {
    /// Write the rates, huge ones where undefined; unwinds to [`run`] when no
    /// evaluation remains.
    pub fn rates(&mut self, time: f64, state: &[f64], rates: &mut [f64]) {
        if !self.defined(time, state, rates) {
            self.poison = -self.poison;
            rates.fill(self.poison);
        }
    }

    /// Write the rates; whether they are defined (and finite).
    fn defined(&mut self, time: f64, state: &[f64], rates: &mut [f64]) -> bool {
        if self.remaining == 0 {
            resume_unwind(Box::new(Exhausted));
        }
        self.remaining -= 1;
        let defined = (self.rates)(time, state, rates).is_ok();
        defined && rates.iter().all(|rate| rate.is_finite())
    }

    /// Write the Jacobian by columns, from differences if the task has none;
    /// zero where undefined.
    pub fn jacobian(&mut self, time: f64, state: &[f64], columns: &mut [f64]) {
        let Some(jacobian) = self.jacobian.as_mut() else {
            return self.differences(time, state, columns);
        };
        let defined = jacobian(time, state, columns).is_ok();
        if !defined || !columns.iter().all(|slope| slope.is_finite()) {
            columns.fill(0.0);
        }
    }

    /// A first step that moves the fastest state by about a hundredth of its size
    /// (or of the root of the tolerance), for codes that make no such choice.
    pub fn first_step(&mut self, setup: &Setup) -> f64 {
        let mut rates = vec![0.0; setup.state.len()];
        self.rates(setup.start, setup.state, &mut rates);
        let sizes = setup.state.iter().map(|value| value.abs().max(setup.tolerance.sqrt()));
        let fastest = rates.iter().zip(sizes).map(|(rate, size)| rate.abs() / size).fold(0.0, f64::max);
        (0.01 / fastest.max(f64::MIN_POSITIVE)).min(1e-3 * (setup.end() - setup.start))
    }

    /// The Jacobian from one-sided differences: forward, or backward where the
    /// rates are undefined ahead.  Columns without either are zero: a huge slope
    /// would pass any Newton iteration off as converged.
    fn differences(&mut self, time: f64, state: &[f64], columns: &mut [f64]) {
        let size = state.len();
        let (mut moved, mut base) = (state.to_vec(), vec![0.0; size]);
        if !self.defined(time, state, &mut base) {
            return columns.fill(0.0);
        }
        for (index, column) in columns.chunks_exact_mut(size).enumerate() {
            let length = f64::EPSILON.sqrt() * state[index].abs().max(1e4 * self.tolerance);
            let mut slopes = |step: f64| {
                moved[index] = state[index] + step;
                let step = moved[index] - state[index];
                let defined = self.defined(time, &moved, column);
                moved[index] = state[index];
                column.iter_mut().zip(&base).for_each(|(rate, base)| *rate = (*rate - base) / step);
                defined
            };
            if !slopes(length) && !slopes(-length) {
                column.fill(0.0);
            }
        }
    }
}

/// Check the task, run a solver on it, and turn its panics into errors.
pub(crate) fn run(
    task: Task,
    solver: impl FnOnce(&mut Guard, &Setup) -> Result<Vec<Vec<f64>>, String>,
) -> Result<Vec<Vec<f64>>, String> {
    let Task { tolerance, max_step, start, state, times, max_evaluations, rates, jacobian } = task;
    if !(tolerance > 0.0 && tolerance.is_finite() && max_step > 0.0) {
        return Err("tolerance and max_step must be positive".into());
    }
    let early = times.first().is_some_and(|&first| first < start);
    if early || !times.windows(2).all(|pair| pair[0] < pair[1]) {
        return Err("output times must grow and not precede the start".into());
    }
    if rates(start, state, &mut vec![0.0; state.len()]).is_err() {
        return Err("the rates are undefined at the start".into());
    }
    let at_start = times.first() == Some(&start);
    let setup = Setup { tolerance, max_step, start, state, times: &times[usize::from(at_start)..] };
    let mut states = if at_start { vec![state.to_vec()] } else { Vec::new() };
    if setup.times.is_empty() {
        return Ok(states);
    }
    let mut guard = Guard { rates, jacobian, remaining: max_evaluations, poison: POISON, tolerance };
    match catch_unwind(AssertUnwindSafe(|| solver(&mut guard, &setup))) {
        Ok(result) => states.extend(result?),
        Err(cause) if cause.is::<Exhausted>() => {
            return Err(format!("more than {max_evaluations} evaluations"));
        }
        Err(cause) => {
            let text = cause.downcast_ref::<&str>().map(|text| text.to_string());
            let text = text.or_else(|| cause.downcast_ref::<String>().cloned());
            return Err(format!("the solver panicked: {}", text.unwrap_or_default()));
        }
    }
    if states.len() != times.len() || states.iter().flatten().any(|value| !value.is_finite()) {
        return Err("the solver returned too few or non-finite states".into());
    }
    Ok(states)
}

/// Loads a shared library of the folder that the environment variable `PEERS_LIB` names.
fn load(file: &str) -> Result<Library, String> {
    let folder = std::env::var_os("PEERS_LIB").ok_or("PEERS_LIB is not set")?;
    let path = std::path::Path::new(&folder).join(file);
    // SAFETY: loading these libraries runs no code that other code depends on.
    unsafe { Library::new(&path) }.map_err(|error| format!("{}: {error}", path.display()))
}
