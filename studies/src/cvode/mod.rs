//! CVODE of SUNDIALS behind one safe function: an integrator that shares no code with the library.

#![allow(unsafe_code)]

mod algebra;
mod handles;

use algebra::Algebra;
use handles::{Context, Memory, Vector};
use std::any::Any;
use std::ffi::{c_int, c_long, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::ptr;
use sundials_sys as sys;

/// Linear multistep method with its solver of the implicit equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Backward differences of order 1 to 5, Newton, dense matrix. For stiff systems.
    Bdf,
    /// Adams-Moulton of order 1 to 12, fixed-point iteration. For systems that are not stiff.
    Adams,
}

/// How to integrate.
#[derive(Clone, Copy, Debug)]
pub struct Options<'a> {
    pub method: Method,
    /// Error of a step relative to each state.
    pub relative: f64,
    /// Absolute error of a step for every state.
    pub absolute: &'a [f64],
    /// Largest number of steps from one time asked for to the next.
    pub max_steps: u32,
    /// Largest step, in the unit of time; infinity for none. Free flight is a polynomial that a large step follows
    /// exactly, right across a short contact.
    pub max_step: f64,
}

/// Counts of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    pub steps: u64,
    /// Evaluations of the rates, those of difference quotients included.
    pub evaluations: u64,
    /// Steps rejected by the error estimate.
    pub rejected: u64,
    /// Steps whose implicit equations were not solved.
    pub newton_failures: u64,
}

/// The states at the times asked for.
#[derive(Clone, Debug)]
pub struct Solution {
    pub states: Vec<Vec<f64>>,
    pub statistics: Statistics,
}

/// Writes what it is for at a time and a state; a failure makes CVODE try a smaller step.
pub type Function<'a> = dyn FnMut(f64, &[f64], &mut [f64]) -> Result<(), ()> + 'a;

/// Where backward differences get the derivatives J of the rates from, and who solves their linear systems.
pub enum Derivatives<'a, 'f> {
    /// Difference quotients, a dense matrix and a dense solver, all of CVODE.
    Quotients,
    /// This writes J by columns; the matrix is dense and the solver CVODE's.
    Dense(&'a mut Function<'f>),
    /// No matrix at all.
    Newton(&'a mut dyn Newton),
}

/// A solver of `(I - gamma J) x = b`. A failure makes CVODE try a smaller step.
pub trait Newton {
    /// Gets ready for `gamma`, with derivatives at this time and state, or, where `again`, with those of last time.
    fn prepare(&mut self, t: f64, state: &[f64], gamma: f64, again: bool) -> Result<(), ()>;
    /// Replaces the right-hand side `x` by the solution.
    fn solve(&mut self, x: &mut [f64]) -> Result<(), ()>;
}

/// The structured solver of the library.
impl Newton for cagedyn::Sim {
    fn prepare(&mut self, t: f64, state: &[f64], gamma: f64, again: bool) -> Result<(), ()> {
        if !again {
            self.linearize(t, state).map_err(|_| ())?;
        }
        self.factorize(gamma).map_err(|_| ())
    }

    fn solve(&mut self, x: &mut [f64]) -> Result<(), ()> {
        cagedyn::Sim::solve(self, x).map_err(|_| ())
    }
}

/// Integrates `state` from `start` to each of `times`, which grow. Rates are never asked for after the last time.
///
/// # Errors
/// What CVODE refused or where it gave up.
pub fn solve(
    options: &Options<'_>,
    start: f64,
    state: &[f64],
    times: &[f64],
    rates: &mut Function<'_>,
    derivatives: Derivatives<'_, '_>,
) -> Result<Solution, String> {
    let n = state.len();
    assert_eq!(options.absolute.len(), n, "one absolute tolerance per state");
    // Dropped in the opposite order: the memory of CVODE first, the context last.
    let context = Context::new()?;
    let mut y = Vector::new(&context, state)?;
    let absolute = Vector::new(&context, options.absolute)?;
    let mut callbacks = Callbacks { n, rates, derivatives, panic: None };
    let algebra = match (options.method, &callbacks.derivatives) {
        (Method::Adams, _) => Algebra::fixed_point(&context, &y)?,
        (Method::Bdf, Derivatives::Newton(_)) => Algebra::newton(&context)?,
        (Method::Bdf, _) => Algebra::dense(&context, &y)?,
    };
    let memory = Memory::new(&context, options.method)?;

    // SAFETY: memory, vectors and algebra are alive and belong to the same context. The callbacks outlive the last
    // call of CVode below and are reached only through this pointer while it runs.
    unsafe {
        let mem = memory.0;
        check("CVodeInit", sys::CVodeInit(mem, Some(rates_for_cvode), start, y.0))?;
        check("CVodeSVtolerances", sys::CVodeSVtolerances(mem, options.relative, absolute.0))?;
        check("CVodeSetMaxNumSteps", sys::CVodeSetMaxNumSteps(mem, c_long::from(options.max_steps)))?;
        check("CVodeSetMaxStep", sys::CVodeSetMaxStep(mem, options.max_step))?;
        let data = ptr::from_mut(&mut callbacks).cast::<c_void>();
        check("CVodeSetUserData", sys::CVodeSetUserData(mem, data))?;
        match options.method {
            Method::Bdf => {
                let set = sys::CVodeSetLinearSolver(mem, algebra.linear, algebra.matrix);
                check("CVodeSetLinearSolver", set)?;
                match callbacks.derivatives {
                    Derivatives::Quotients => {}
                    Derivatives::Dense(_) => {
                        check("CVodeSetJacFn", sys::CVodeSetJacFn(mem, Some(jacobian_for_cvode)))?;
                    }
                    Derivatives::Newton(_) => {
                        algebra.give(data);
                        check("CVodeSetLinSysFn", sys::CVodeSetLinSysFn(mem, Some(newton_for_cvode)))?;
                    }
                }
            }
            Method::Adams => {
                let set = sys::CVodeSetNonlinearSolver(mem, algebra.nonlinear);
                check("CVodeSetNonlinearSolver", set)?;
            }
        }
        if let Some(last) = times.last() {
            check("CVodeSetStopTime", sys::CVodeSetStopTime(mem, *last))?;
        }
    }
    let mut states = Vec::with_capacity(times.len());
    for &time in times {
        let mut reached = start;
        // SAFETY: as above; `reached` is written only during the call.
        let flag = unsafe { sys::CVode(memory.0, time, y.0, &mut reached, sys::CV_NORMAL) };
        if let Some(panic) = callbacks.panic.take() {
            resume_unwind(panic);
        }
        check(&format!("CVode at t = {reached:?} s"), flag)?;
        states.push(y.values().to_vec());
    }
    Ok(Solution { states, statistics: memory.statistics(options.method)? })
}

/// Warnings are positive flags and no failures.
fn check(what: &str, flag: c_int) -> Result<(), String> {
    if flag < 0 { Err(format!("{what}: CVODE error {flag}")) } else { Ok(()) }
}

fn not_null<T>(what: &str, pointer: *mut T) -> Result<*mut T, String> {
    if pointer.is_null() { Err(format!("{what} failed")) } else { Ok(pointer) }
}

struct Callbacks<'a, 'r, 'd, 'j> {
    n: usize,
    rates: &'a mut Function<'r>,
    derivatives: Derivatives<'d, 'j>,
    /// A panic of a callback, kept until CVODE has returned.
    panic: Option<Box<dyn Any + Send>>,
}

/// The answer that CVODE understands: 0 success, 1 try again with a smaller step, -1 give up.
fn answer(panic: &mut Option<Box<dyn Any + Send>>, call: impl FnOnce() -> Result<(), ()>) -> c_int {
    match catch_unwind(AssertUnwindSafe(call)) {
        Ok(Ok(())) => 0,
        Ok(Err(())) => 1,
        Err(payload) => {
            *panic = Some(payload);
            -1
        }
    }
}

unsafe extern "C" fn rates_for_cvode(
    t: f64,
    y: sys::N_Vector,
    rates: sys::N_Vector,
    data: *mut c_void,
) -> c_int {
    // SAFETY: `data` is the `Callbacks` that `solve` registered, alive and borrowed by nobody else while CVode runs.
    // Both vectors are distinct clones of its serial vector of `n` numbers.
    unsafe {
        let callbacks = &mut *data.cast::<Callbacks<'_, '_, '_, '_>>();
        let state = std::slice::from_raw_parts(sys::N_VGetArrayPointer(y), callbacks.n);
        let out = std::slice::from_raw_parts_mut(sys::N_VGetArrayPointer(rates), callbacks.n);
        answer(&mut callbacks.panic, || (callbacks.rates)(t, state, out))
    }
}

#[allow(clippy::similar_names)]
unsafe extern "C" fn jacobian_for_cvode(
    t: f64,
    y: sys::N_Vector,
    _rates: sys::N_Vector,
    matrix: sys::SUNMatrix,
    data: *mut c_void,
    _: sys::N_Vector,
    _: sys::N_Vector,
    _: sys::N_Vector,
) -> c_int {
    // SAFETY: as in `rates_for_cvode`; the matrix is the dense one of `n` by `n` numbers, stored by columns.
    unsafe {
        let callbacks = &mut *data.cast::<Callbacks<'_, '_, '_, '_>>();
        let n = callbacks.n;
        let state = std::slice::from_raw_parts(sys::N_VGetArrayPointer(y), n);
        let out = std::slice::from_raw_parts_mut(sys::SUNDenseMatrix_Data(matrix), n * n);
        match &mut callbacks.derivatives {
            Derivatives::Dense(jacobian) => answer(&mut callbacks.panic, || jacobian(t, state, out)),
            _ => -1,
        }
    }
}

#[allow(clippy::similar_names)]
unsafe extern "C" fn newton_for_cvode(
    t: f64,
    y: sys::N_Vector,
    _rates: sys::N_Vector,
    _: sys::SUNMatrix,
    again: c_int,
    current: *mut c_int,
    gamma: f64,
    data: *mut c_void,
    _: sys::N_Vector,
    _: sys::N_Vector,
    _: sys::N_Vector,
) -> c_int {
    // SAFETY: as in `rates_for_cvode`; `current` is written during the call.
    unsafe {
        let callbacks = &mut *data.cast::<Callbacks<'_, '_, '_, '_>>();
        let state = std::slice::from_raw_parts(sys::N_VGetArrayPointer(y), callbacks.n);
        *current = c_int::from(again == 0);
        match &mut callbacks.derivatives {
            Derivatives::Newton(newton) => {
                answer(&mut callbacks.panic, || newton.prepare(t, state, gamma, again != 0))
            }
            _ => -1,
        }
    }
}

/// Solves for CVODE; the content of the solver is what `solve` gave it.
unsafe extern "C" fn solve_for_cvode(
    solver: sys::SUNLinearSolver,
    _: sys::SUNMatrix,
    x: sys::N_Vector,
    b: sys::N_Vector,
    _: f64,
) -> c_int {
    // SAFETY: as in `rates_for_cvode`; both vectors are serial ones of `n` numbers, and may be the same.
    unsafe {
        let callbacks = &mut *(*solver).content.cast::<Callbacks<'_, '_, '_, '_>>();
        let (from, to) = (sys::N_VGetArrayPointer(b), sys::N_VGetArrayPointer(x));
        ptr::copy(from, to, callbacks.n);
        let x = std::slice::from_raw_parts_mut(to, callbacks.n);
        match &mut callbacks.derivatives {
            Derivatives::Newton(newton) => answer(&mut callbacks.panic, || newton.solve(x)),
            _ => -1,
        }
    }
}
