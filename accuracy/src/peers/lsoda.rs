//! LSODA as ported to C by scipy (`scipy/integrate/src/lsoda.c`), with LAPACK
//! of OpenBLAS (one thread).
//!
//! Takes everything of a [`Task`]: the largest step, the Jacobian by columns
//! (differences of the rates without one), and a relative tolerance of zero.
//!
//! It gives up with istate = -2 when the tolerance is below 2.2e-14 of the
//! largest state, and with -5 after ten failed corrections of one step.

use super::{Guard, Setup, Task, run};
use libloading::Library;
use std::cell::Cell;
use std::ffi::c_int;
use std::ptr;
use std::slice;
use std::sync::OnceLock;

type Rates = unsafe extern "C-unwind" fn(*mut c_int, *mut f64, *mut f64, *mut f64);
type Jacobian =
    unsafe extern "C-unwind" fn(*mut c_int, *mut f64, *mut f64, *mut c_int, *mut c_int, *mut f64, *mut c_int);

/// `lsoda_common_struct_t`: 240 doubles, then 48 ints; all zero before the first call.
#[repr(C)]
struct Common {
    doubles: [f64; 240],
    integers: [c_int; 48],
}

/// `lsoda(f, neq, y, t, tout, itol, rtol, atol, itask, istate, iopt, rwork, lrw,
/// iwork, liw, jac, jt, S)`.
type Lsoda = unsafe extern "C-unwind" fn(
    Rates,
    c_int,
    *mut f64,
    *mut f64,
    *mut f64,
    c_int,
    *const f64,
    *const f64,
    *mut c_int,
    *mut c_int,
    *mut c_int,
    *mut f64,
    c_int,
    *mut c_int,
    c_int,
    Jacobian,
    c_int,
    *mut Common,
);

const LSODA: &str = "libscipy_lsoda.so";

static LIBRARY: OnceLock<Result<Library, String>> = OnceLock::new();

thread_local! {
    /// The guard of the running integration: the callbacks have no user data.
    static CURRENT: Cell<*mut Guard<'static, 'static, 'static>> = const { Cell::new(ptr::null_mut()) };
}

/// Puts back the former guard, also when unwinding.
struct Restore(*mut Guard<'static, 'static, 'static>);

impl Drop for Restore {
    fn drop(&mut self) {
        CURRENT.set(self.0);
    }
}

/// # Safety
/// Called by LSODA only, while [`integrate`] runs on this thread.
unsafe extern "C-unwind" fn rates(size: *mut c_int, time: *mut f64, state: *mut f64, out: *mut f64) {
    // SAFETY: LSODA's arrays have `size` entries; `CURRENT` is set by `integrate`.
    unsafe {
        let size = *size as usize;
        let (state, out) = (slice::from_raw_parts(state, size), slice::from_raw_parts_mut(out, size));
        (*CURRENT.get()).rates(*time, state, out);
    }
}

/// # Safety
/// As for [`rates`].
unsafe extern "C-unwind" fn jacobian(
    size: *mut c_int,
    time: *mut f64,
    state: *mut f64,
    _lower: *mut c_int,
    _upper: *mut c_int,
    out: *mut f64,
    _rows: *mut c_int,
) {
    // SAFETY: as for `rates`; a full Jacobian has `size` rows and columns.
    unsafe {
        let size = *size as usize;
        let state = slice::from_raw_parts(state, size);
        let out = slice::from_raw_parts_mut(out, size * size);
        (*CURRENT.get()).jacobian(*time, state, out);
    }
}

/// Load the library and keep OpenBLAS to one thread.
fn library() -> Result<Library, String> {
    let blas = super::load("libscipy_openblas.so")?;
    // SAFETY: this is the type of the function in OpenBLAS.
    let threads = unsafe { blas.get::<unsafe extern "C" fn(c_int)>(b"scipy_openblas_set_num_threads\0") };
    // SAFETY: no other thread uses this OpenBLAS yet.
    unsafe { threads.map_err(|error| error.to_string())?(1) };
    // Keep it loaded: its threads must not lose their code.
    std::mem::forget(blas);
    super::load(LSODA)
}

/// Whether the library is where it is looked for.
pub fn there() -> bool {
    std::env::var_os("PEERS_LIB").is_some_and(|folder| std::path::Path::new(&folder).join(LSODA).exists())
}

/// Solve with LSODA of scipy.
pub fn solve(task: Task<'_, '_, '_>) -> Result<Vec<Vec<f64>>, String> {
    run(task, integrate)
}

fn integrate(guard: &mut Guard<'_, '_, '_>, setup: &Setup<'_>) -> Result<Vec<Vec<f64>>, String> {
    let library = LIBRARY.get_or_init(library).as_ref().map_err(Clone::clone)?;
    // SAFETY: the symbol has this type in scipy 1.17.1 (lsoda.h).
    let lsoda = unsafe { library.get::<Lsoda>(b"lsoda\0") };
    let lsoda = lsoda.map_err(|error| error.to_string())?;

    let size = setup.state.len();
    let mut state = setup.state.to_vec();
    let adams = 20 + 13 * size;
    let bdf = 20 + 6 * size + size * size + 2;
    let mut reals = vec![0.0; adams.max(bdf) + 3 * size];
    let mut integers: Vec<c_int> = vec![0; 20 + size];
    // rwork(6): largest step, 0 = none; iwork(6): steps per call; both as in ODEPACK.
    reals[5] = if setup.max_step.is_finite() { setup.max_step } else { 0.0 };
    integers[5] = c_int::MAX;
    let lengths = (c_int::try_from(size), c_int::try_from(reals.len()), c_int::try_from(integers.len()));
    let (Ok(equations), Ok(real_length), Ok(integer_length)) = lengths else {
        return Err("too many states".into());
    };
    // A full Jacobian from the callback: the guard's differences, if need be, stay
    // clear of undefined rates, LSODA's own do not.
    let jacobian_type: c_int = 1;
    let (mut task, mut status, mut optional): (c_int, c_int, c_int) = (1, 1, 1);
    let mut common = Common { doubles: [0.0; 240], integers: [0; 48] };
    let mut time = setup.start;

    let _restore = Restore(CURRENT.replace(ptr::from_mut(guard).cast()));
    let mut states = Vec::with_capacity(setup.times.len());
    for &output in setup.times {
        let mut output = output;
        // SAFETY: arrays have the sizes passed and ODEPACK asks for; the guard
        // outlives the call; panics may pass, the library has unwind tables.
        unsafe {
            lsoda(
                rates,
                equations,
                state.as_mut_ptr(),
                &mut time,
                &mut output,
                1,
                &0.0,
                &setup.tolerance,
                &mut task,
                &mut status,
                &mut optional,
                reals.as_mut_ptr(),
                real_length,
                integers.as_mut_ptr(),
                integer_length,
                jacobian,
                jacobian_type,
                &mut common,
            );
        }
        if status < 0 {
            return Err(format!("LSODA gave up at {time} with istate = {status}"));
        }
        states.push(state.clone());
    }
    Ok(states)
}
