//! Extremes and integrals of watched outputs in C.

use super::guard::{check_array, count, exclusive, index, shared, static_name, status, write_array};
use super::model::cagedyn_model;
use super::sim::cagedyn_sim;
use libc::c_char;
use std::ffi::CStr;

/// Names of the numbers of an interval, NUL-terminated.
const INTERVAL_NAMES: [&CStr; 7] =
    [c"from", c"to", c"min", c"max", c"mean", c"integral", c"positive_integral"];

/// Number of outputs that are watched in every step: those that the scene names in record.extremes. Negative status code on
/// failure.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_watched_count(model: *const cagedyn_model) -> i64 {
    // SAFETY: see above.
    count(|| Ok(unsafe { shared("model", model) }?.model.watched().len()))
}

/// Output that is at place `index` of those that are watched. Negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_watched_output(model: *const cagedyn_model, index: i64) -> i64 {
    count(|| {
        // SAFETY: see above.
        let watched = unsafe { shared("model", model) }?.model.watched();
        Ok(watched[self::index("index", index, watched.len())?])
    })
}

/// Number of numbers that cagedyn_sim_get_interval() writes.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_interval_count() -> i64 {
    INTERVAL_NAMES.len() as i64
}

/// Name of one of these numbers; "" for others. Static text.
///
/// - from, to: the interval, s.
/// - min, max: extremes in any step that touches it, in the unit of the output.
/// - mean: over time; integral: over time, in that unit times s; positive_integral: of the values above zero.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_interval_name(index: i64) -> *const c_char {
    static_name(&INTERVAL_NAMES, index)
}

/// Begins at the present time the interval of cagedyn_sim_get_interval(). So do setting a state, a reset and restoring.
///
/// # Safety
/// `sim` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_begin_interval(sim: *mut cagedyn_sim) -> i32 {
    status(|| {
        // SAFETY: see above.
        unsafe { exclusive("sim", sim) }?.sim.begin_interval();
        Ok(())
    })
}

/// Writes what a watched output did since cagedyn_sim_begin_interval(), from every step and not from where the host stopped
/// (length: interval count). Forces are those that acted in the steps, so that their integrals are the impulses that the
/// bodies were given.
///
/// # Safety
/// `sim` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_get_interval(
    sim: *mut cagedyn_sim,
    output: i64,
    out: *mut f64,
    length: i64,
) -> i32 {
    status(|| {
        check_array("out", out.is_null(), length, INTERVAL_NAMES.len())?;
        // SAFETY: see above.
        let mut content = unsafe { exclusive("sim", sim) }?;
        let sim = &mut content.sim;
        let interval = sim.interval(index("output", output, sim.channels().len())?)?;
        let crate::Interval { from, to, min, max, mean, integral, positive } = interval;
        // SAFETY: see above.
        unsafe { write_array("out", &[from, to, min, max, mean, integral, positive], out, length) }
    })
}
