//! CVODE of SUNDIALS behind one safe function: an integrator that shares no code with the library.

#![allow(unsafe_code)]

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

/// Integrates `state` from `start` to each of `times`, which grow. Rates are never asked for after the last time.
///
/// `jacobian` writes the matrix of derivatives of the rates by columns; without it CVODE takes difference quotients.
///
/// # Errors
/// What CVODE refused or where it gave up.
pub fn solve(
    options: &Options<'_>,
    start: f64,
    state: &[f64],
    times: &[f64],
    rates: &mut Function<'_>,
    jacobian: Option<&mut Function<'_>>,
) -> Result<Solution, String> {
    let n = state.len();
    assert_eq!(options.absolute.len(), n, "one absolute tolerance per state");
    // Dropped in the opposite order: the memory of CVODE first, the context last.
    let context = Context::new()?;
    let mut y = Vector::new(&context, state)?;
    let absolute = Vector::new(&context, options.absolute)?;
    let has_jacobian = jacobian.is_some();
    let mut callbacks = Callbacks { n, rates, jacobian, panic: None };
    let algebra = match options.method {
        Method::Bdf => Algebra::dense(&context, &y)?,
        Method::Adams => Algebra::fixed_point(&context, &y)?,
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
                if has_jacobian {
                    check("CVodeSetJacFn", sys::CVodeSetJacFn(mem, Some(jacobian_for_cvode)))?;
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

struct Callbacks<'a, 'r, 'j> {
    n: usize,
    rates: &'a mut Function<'r>,
    jacobian: Option<&'a mut Function<'j>>,
    /// A panic of a callback, kept until CVODE has returned.
    panic: Option<Box<dyn Any + Send>>,
}

/// The answer that CVODE understands: 0 success, 1 try again with a smaller step, -1 give up.
fn answer(
    panic: &mut Option<Box<dyn Any + Send>>,
    function: &mut Function<'_>,
    t: f64,
    state: &[f64],
    out: &mut [f64],
) -> c_int {
    match catch_unwind(AssertUnwindSafe(|| function(t, state, out))) {
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
        let callbacks = &mut *data.cast::<Callbacks<'_, '_, '_>>();
        let state = std::slice::from_raw_parts(sys::N_VGetArrayPointer(y), callbacks.n);
        let out = std::slice::from_raw_parts_mut(sys::N_VGetArrayPointer(rates), callbacks.n);
        answer(&mut callbacks.panic, callbacks.rates, t, state, out)
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
        let callbacks = &mut *data.cast::<Callbacks<'_, '_, '_>>();
        let n = callbacks.n;
        let state = std::slice::from_raw_parts(sys::N_VGetArrayPointer(y), n);
        let out = std::slice::from_raw_parts_mut(sys::SUNDenseMatrix_Data(matrix), n * n);
        match callbacks.jacobian.as_deref_mut() {
            Some(jacobian) => answer(&mut callbacks.panic, jacobian, t, state, out),
            None => -1,
        }
    }
}

struct Context(sys::SUNContext);

impl Context {
    fn new() -> Result<Self, String> {
        let mut context = ptr::null_mut();
        // SAFETY: the pointer is written during the call. Handlers that print are taken off: errors are returned.
        unsafe {
            check("SUNContext_Create", sys::SUNContext_Create(sys::comm_no_mpi(), &mut context))?;
            let context = Self(context);
            check("SUNContext_ClearErrHandlers", sys::SUNContext_ClearErrHandlers(context.0))?;
            Ok(context)
        }
    }
}

impl Drop for Context {
    fn drop(&mut self) {
        // SAFETY: everything made with it was declared later and is gone.
        unsafe { sys::SUNContext_Free(&mut self.0) };
    }
}

struct Vector(sys::N_Vector, usize);

impl Vector {
    fn new(context: &Context, values: &[f64]) -> Result<Self, String> {
        let length = i64::try_from(values.len()).map_err(|e| e.to_string())?;
        // SAFETY: the context is alive.
        let vector = not_null("N_VNew_Serial", unsafe { sys::N_VNew_Serial(length, context.0) })?;
        let mut vector = Self(vector, values.len());
        vector.values().copy_from_slice(values);
        Ok(vector)
    }

    fn values(&mut self) -> &mut [f64] {
        // SAFETY: a serial vector of this many numbers, borrowed with `self`.
        unsafe { std::slice::from_raw_parts_mut(sys::N_VGetArrayPointer(self.0), self.1) }
    }
}

impl Drop for Vector {
    fn drop(&mut self) {
        // SAFETY: made by `new`, freed once.
        unsafe { sys::N_VDestroy(self.0) };
    }
}

/// Solver of the implicit equations; null where the method needs none.
struct Algebra {
    matrix: sys::SUNMatrix,
    linear: sys::SUNLinearSolver,
    nonlinear: sys::SUNNonlinearSolver,
}

impl Algebra {
    const NONE: Self = Self { matrix: ptr::null_mut(), linear: ptr::null_mut(), nonlinear: ptr::null_mut() };

    fn dense(context: &Context, y: &Vector) -> Result<Self, String> {
        let n = i64::try_from(y.1).map_err(|e| e.to_string())?;
        let mut algebra = Self::NONE;
        // SAFETY: context and vector are alive; the solver keeps the matrix, which is freed after it.
        unsafe {
            algebra.matrix = not_null("SUNDenseMatrix", sys::SUNDenseMatrix(n, n, context.0))?;
            let linear = sys::SUNLinSol_Dense(y.0, algebra.matrix, context.0);
            algebra.linear = not_null("SUNLinSol_Dense", linear)?;
        }
        Ok(algebra)
    }

    fn fixed_point(context: &Context, y: &Vector) -> Result<Self, String> {
        // SAFETY: context and vector are alive.
        let nonlinear = unsafe { sys::SUNNonlinSol_FixedPoint(y.0, 0, context.0) };
        Ok(Self { nonlinear: not_null("SUNNonlinSol_FixedPoint", nonlinear)?, ..Self::NONE })
    }
}

impl Drop for Algebra {
    fn drop(&mut self) {
        // SAFETY: each was made once and is freed once; the memory of CVODE that used them is gone.
        unsafe {
            if !self.linear.is_null() {
                sys::SUNLinSolFree(self.linear);
            }
            if !self.nonlinear.is_null() {
                sys::SUNNonlinSolFree(self.nonlinear);
            }
            if !self.matrix.is_null() {
                sys::SUNMatDestroy(self.matrix);
            }
        }
    }
}

struct Memory(*mut c_void);

impl Memory {
    fn new(context: &Context, method: Method) -> Result<Self, String> {
        let method = match method {
            Method::Bdf => sys::CV_BDF,
            Method::Adams => sys::CV_ADAMS,
        };
        // SAFETY: the context is alive.
        Ok(Self(not_null("CVodeCreate", unsafe { sys::CVodeCreate(method, context.0) })?))
    }

    fn statistics(&self, method: Method) -> Result<Statistics, String> {
        type Count = unsafe extern "C" fn(*mut c_void, *mut c_long) -> c_int;
        let count = |get: Count| {
            let mut value = 0;
            // SAFETY: the memory is alive; the number is written during the call.
            check("statistics", unsafe { get(self.0, &mut value) })?;
            u64::try_from(value).map_err(|e| e.to_string())
        };
        let quotients = if method == Method::Bdf { count(sys::CVodeGetNumLinRhsEvals)? } else { 0 };
        Ok(Statistics {
            steps: count(sys::CVodeGetNumSteps)?,
            evaluations: count(sys::CVodeGetNumRhsEvals)? + quotients,
            rejected: count(sys::CVodeGetNumErrTestFails)?,
            newton_failures: count(sys::CVodeGetNumNonlinSolvConvFails)?,
        })
    }
}

impl Drop for Memory {
    fn drop(&mut self) {
        // SAFETY: made by `new`, freed once.
        unsafe { sys::CVodeFree(&mut self.0) };
    }
}
