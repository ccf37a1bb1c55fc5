//! What stops simulations from outside, in C.

use super::guard::{exclusive, free, guard, shared, status};
use super::sim::cagedyn_sim;
use crate::sim::Canceller;

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
