//! What stops simulations and searches from outside, in C, and tells how far searches are.

use super::guard::{exclusive, free, guard, shared, status, write_array};
use super::sim::cagedyn_sim;
use crate::sim::{Canceller, RunLimits};
use std::sync::{Mutex, PoisonError};

/// Asks one simulation to stop. May be used by any number of threads at a time.
#[allow(non_camel_case_types)]
pub struct cagedyn_canceller {
    canceller: Canceller,
}

/// Creates what stops a simulation from other threads, before it runs there. It may outlive the simulation. Returns NULL
/// on failure. Free it with cagedyn_canceller_free().
///
/// # Safety
/// `sim` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_canceller_new(sim: *const cagedyn_sim) -> *mut cagedyn_canceller {
    guard(
        |_| std::ptr::null_mut(),
        || {
            // SAFETY: see above.
            let canceller = unsafe { exclusive("sim", sim) }?.sim.canceller();
            Ok(Box::into_raw(Box::new(cagedyn_canceller { canceller })))
        },
    )
}

/// Makes the simulation's running cagedyn_sim_step() or cagedyn_sim_advance_to(), or else its next one, return
/// CAGEDYN_ERR_CANCELLED after its present step. The request is then spent, and the simulation can go on.
///
/// # Safety
/// `canceller` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_canceller_cancel(canceller: *const cagedyn_canceller) -> i32 {
    status(|| {
        // SAFETY: see above.
        unsafe { shared("canceller", canceller) }?.canceller.cancel();
        Ok(())
    })
}

/// Frees a canceller. NULL is ignored, and the stored error stays.
///
/// # Safety
/// `canceller` is NULL or a live handle; it must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_canceller_free(canceller: *mut cagedyn_canceller) {
    // SAFETY: see above.
    unsafe { free(canceller) }
}

/// Lets a simulation run for `seconds` of wall time from now. Then the running call returns CAGEDYN_ERR_OUT_OF_TIME, and
/// so does every later one until the limit is set again. INFINITY for no limit, as at first.
///
/// # Safety
/// `sim` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_set_wall_time_limit(sim: *mut cagedyn_sim, seconds: f64) -> i32 {
    // SAFETY: see above.
    status(|| unsafe { exclusive("sim", sim) }?.sim.set_wall_time_limit(seconds))
}

/// Watches, limits and stops a search, that is a call that takes it: cagedyn_whirl_..._with_watch(), cagedyn_heat_..._with_watch(). One
/// for each search that runs at a time. May be used by any number of threads at a time.
#[allow(non_camel_case_types)]
pub struct cagedyn_watch {
    limits: Mutex<RunLimits>,
}

/// The limits of a watch; none for NULL.
///
/// # Safety
/// `watch` is NULL or a live handle.
pub(super) unsafe fn limits_of(watch: *const cagedyn_watch) -> RunLimits {
    // SAFETY: see above.
    let watch = unsafe { watch.as_ref() };
    watch.map_or_else(RunLimits::default, cagedyn_watch::limits)
}

impl cagedyn_watch {
    fn limits(&self) -> RunLimits {
        self.limits.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

/// Creates a watch without limit. Returns NULL on failure. Free it with cagedyn_watch_free() when no search uses it any more.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_watch_new() -> *mut cagedyn_watch {
    let make = || Ok(Box::into_raw(Box::new(cagedyn_watch { limits: Mutex::default() })));
    guard(|_| std::ptr::null_mut(), make)
}

/// Frees a watch. NULL is ignored, and the stored error stays.
///
/// # Safety
/// `watch` is NULL or a live handle; it must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_watch_free(watch: *mut cagedyn_watch) {
    // SAFETY: see above.
    unsafe { free(watch) }
}

/// Makes the running search, or else the next one, end with CAGEDYN_ERR_CANCELLED within some thousandths of a second, or within a step of
/// a motion that it runs. The request is then spent. What was found is kept as the search says.
///
/// # Safety
/// `watch` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_watch_cancel(watch: *const cagedyn_watch) -> i32 {
    status(|| {
        // SAFETY: see above.
        unsafe { shared("watch", watch) }?.limits().canceller().cancel();
        Ok(())
    })
}

/// Lets searches that begin after this call run until `seconds` of wall time from now. Then they end with CAGEDYN_ERR_OUT_OF_TIME, until the
/// limit is set again. INFINITY for no limit, as at first.
///
/// # Safety
/// `watch` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_watch_set_wall_time_limit(watch: *mut cagedyn_watch, seconds: f64) -> i32 {
    status(|| {
        // SAFETY: see above.
        let watch = unsafe { shared("watch", watch) }?;
        watch.limits.lock().unwrap_or_else(PoisonError::into_inner).set_wall_time(seconds)
    })
}

/// Writes how far the running search is, or how far the last one came (length: 2): the share of the way that is done, from 0 to 1, rough
/// where its length is not known before; and how many pieces of the result there are, that is whirls or bursts of motion.
///
/// # Safety
/// `watch` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_watch_progress(
    watch: *const cagedyn_watch,
    out: *mut f64,
    length: i64,
) -> i32 {
    status(|| {
        // SAFETY: see above.
        let limits = unsafe { shared("watch", watch) }?.limits();
        // SAFETY: see above.
        unsafe { write_array("out", &[limits.share(), limits.found() as f64], out, length) }
    })
}
