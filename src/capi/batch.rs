//! Many simulations at once in C.

use super::guard::{
    EMPTY, Exclusive, Handle, InUse, count, exclusive, free, guard, index, shared, static_name, status,
    to_c_string, write_array,
};
use super::sim::{Running, cagedyn_sim};
use crate::batch::{Monitor, PROGRESS, ProgressItem, advance_all};
use crate::error::{Error, Result, Status};
use crate::sim::{Sim, check_time};
use libc::c_char;
use std::ffi::CString;
use std::ptr::NonNull;
use std::sync::atomic::Ordering;

/// Simulations that run at once. May be used by one thread at a time; a second one gets CAGEDYN_ERR_BUSY.
#[allow(non_camel_case_types)]
pub struct cagedyn_batch {
    content: Exclusive<Batch>,
}

impl Handle for cagedyn_batch {
    type Content = Batch;

    fn exclusive(&self) -> &Exclusive<Batch> {
        &self.content
    }
}

/// The simulations with what became of them.
pub struct Batch {
    sims: Vec<Owned>,
    /// What became of each.
    results: Vec<(i32, CString)>,
    monitor: Monitor,
}

/// A simulation of the batch. A pointer, as the host has one, too.
struct Owned(NonNull<cagedyn_sim>);

// SAFETY: it is what a Box would be, and what is in it may be sent.
unsafe impl Send for Owned where cagedyn_sim: Send {}

/// A simulation of the batch that runs.
struct Runs<'a>(InUse<'a, Running>);

// SAFETY: the content may be sent, and nobody else has it.
unsafe impl Send for Runs<'_> where Running: Send {}

impl AsMut<Sim> for Runs<'_> {
    fn as_mut(&mut self) -> &mut Sim {
        &mut self.0.sim
    }
}

impl Drop for Owned {
    fn drop(&mut self) {
        // SAFETY: it came from Box::into_raw, and cagedyn_sim_free() leaves it alone.
        drop(unsafe { Box::from_raw(self.0.as_ptr()) });
    }
}

/// Watches and stops a batch. May be used by any number of threads at a time.
#[allow(non_camel_case_types)]
pub struct cagedyn_monitor {
    monitor: Monitor,
}

/// Creates a batch without simulations. Returns NULL on failure. Free it with cagedyn_batch_free().
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_batch_new() -> *mut cagedyn_batch {
    guard(
        |_| std::ptr::null_mut(),
        || {
            let (sims, results, monitor) = (Vec::new(), Vec::new(), Monitor::default());
            let content = Exclusive::new(Batch { sims, results, monitor });
            Ok(Box::into_raw(Box::new(cagedyn_batch { content })))
        },
    )
}

/// Frees a batch with its simulations. NULL is ignored, and the stored error stays.
///
/// # Safety
/// `batch` is NULL or a live handle; neither it nor its simulations must be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_batch_free(batch: *mut cagedyn_batch) {
    // SAFETY: see above.
    unsafe { free(batch) }
}

/// Gives a simulation to a batch and returns its place there, from 0 on. From then on it belongs to the batch, which frees it;
/// cagedyn_sim_free() does nothing to it. Every other function can be used with it while the batch does not run. Negative status
/// code on failure; it then stays the caller's.
///
/// # Safety
/// Both are NULL or live handles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_batch_add(batch: *mut cagedyn_batch, sim: *mut cagedyn_sim) -> i64 {
    count(|| {
        // SAFETY: see above.
        let (mut batch, added) = unsafe { (exclusive("batch", batch)?, shared("sim", sim)?) };
        if added.in_batch.swap(true, Ordering::AcqRel) {
            return Err(Error::new(Status::BadValue, "sim: a batch has it already".to_owned()));
        }
        // The host's own pointer, so that both may be used in turn.
        batch.sims.extend(NonNull::new(sim).map(Owned));
        batch.results.push((0, CString::default()));
        Ok(batch.sims.len() - 1)
    })
}

/// Number of simulations of a batch. Negative status code on failure.
///
/// # Safety
/// `batch` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_batch_count(batch: *const cagedyn_batch) -> i64 {
    // SAFETY: see above.
    count(|| Ok(unsafe { exclusive("batch", batch) }?.sims.len()))
}

/// The simulation at a place, which belongs to the batch and lives as long. NULL on failure.
///
/// # Safety
/// `batch` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_batch_sim(batch: *mut cagedyn_batch, index: i64) -> *mut cagedyn_sim {
    guard(
        |_| std::ptr::null_mut(),
        || {
            // SAFETY: see above.
            let content = unsafe { exclusive("batch", batch) }?;
            let sims = &content.sims;
            Ok(sims[self::index("index", index, sims.len())?].0.as_ptr())
        },
    )
}

/// Advances every simulation of a batch to time `t` (s), on so many threads; on as many as there are cores for 0. Every one gives
/// the results that it gives alone. One that fails is left as cagedyn_sim_advance_to() leaves it and does not stop the others.
/// CAGEDYN_OK if all have come to `t`, else the status of the first in order that has not: see cagedyn_batch_status(). Those that
/// will take longest should have been added first. Neither the batch nor its simulations may be used before the call returns;
/// see cagedyn_monitor_new() for what may.
///
/// # Safety
/// `batch` is NULL or a live handle that no other thread uses, and no thread uses its simulations.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_batch_advance_to(batch: *mut cagedyn_batch, t: f64, threads: i64) -> i32 {
    status(|| {
        // SAFETY: see above.
        let mut batch = unsafe { exclusive("batch", batch) }?;
        // Nothing has become of them in a call that is refused.
        batch.results.iter_mut().for_each(|result| *result = (0, CString::default()));
        let threads = usize::try_from(threads)
            .map_err(|_| Error::new(Status::BadValue, format!("threads: {threads} is not 0 or more")))?;
        check_time("t", t)?;
        let sims = batch.sims.iter().enumerate().map(|(place, sim)| {
            // SAFETY: the batch owns it.
            let sim = unsafe { sim.0.as_ref() };
            sim.exclusive().enter(&format!("simulation {place}")).map(Runs)
        });
        let mut sims = sims.collect::<Result<Vec<_>>>()?;
        let results = advance_all(&mut sims, t, threads, &batch.monitor);
        drop(sims);
        let first = results.iter().position(Result::is_err);
        let failed = results.iter().filter(|result| result.is_err()).count();
        let told = first.map(|place| (place, results[place].clone()));
        batch.results = results
            .into_iter()
            .map(|result| {
                result
                    .map_or_else(|e| (e.status as i32, to_c_string(&e.message)), |()| (0, CString::default()))
            })
            .collect();
        match told {
            Some((place, Err(e))) => {
                let of = batch.sims.len();
                let text = format!("simulation {place}: {} ({failed} of {of} did not arrive)", e.message);
                Err(Error::new(e.status, text))
            }
            _ => Ok(()),
        }
    })
}

/// What became of a simulation in the last cagedyn_batch_advance_to(): CAGEDYN_OK, also before the first, or the code with which
/// it failed. The code of this call, when `batch` or `index` is refused.
///
/// # Safety
/// `batch` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_batch_status(batch: *const cagedyn_batch, index: i64) -> i32 {
    guard(
        |status| status as i32,
        || {
            // SAFETY: see above.
            let content = unsafe { exclusive("batch", batch) }?;
            let results = &content.results;
            Ok(results[self::index("index", index, results.len())?].0)
        },
    )
}

/// Why it failed, one line; "" if it did not. Lives until the next cagedyn_batch_advance_to().
///
/// # Safety
/// `batch` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_batch_message(batch: *const cagedyn_batch, index: i64) -> *const c_char {
    guard(
        |_| EMPTY.as_ptr(),
        || {
            // SAFETY: see above.
            let content = unsafe { exclusive("batch", batch) }?;
            let results = &content.results;
            Ok(results[self::index("index", index, results.len())?].1.as_ptr())
        },
    )
}

/// Creates what watches and stops a batch from other threads, before it runs. It may outlive the batch. Returns NULL on
/// failure. Free it with cagedyn_monitor_free().
///
/// # Safety
/// `batch` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_monitor_new(batch: *const cagedyn_batch) -> *mut cagedyn_monitor {
    guard(
        |_| std::ptr::null_mut(),
        || {
            // SAFETY: see above.
            let monitor = unsafe { exclusive("batch", batch) }?.monitor.clone();
            Ok(Box::into_raw(Box::new(cagedyn_monitor { monitor })))
        },
    )
}

/// Frees a monitor. NULL is ignored, and the stored error stays.
///
/// # Safety
/// `monitor` is NULL or a live handle; it must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_monitor_free(monitor: *mut cagedyn_monitor) {
    // SAFETY: see above.
    unsafe { free(monitor) }
}

/// Makes the running cagedyn_batch_advance_to(), or else the next one, return CAGEDYN_ERR_CANCELLED: simulations that run stop
/// after their present step, those that wait do not begin. The request is then spent, and all of them can go on.
///
/// # Safety
/// `monitor` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_monitor_cancel(monitor: *const cagedyn_monitor) -> i32 {
    status(|| {
        // SAFETY: see above.
        unsafe { shared("monitor", monitor) }?.monitor.cancel();
        Ok(())
    })
}

/// Number of numbers that cagedyn_monitor_progress() writes.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_progress_count() -> i64 {
    PROGRESS.len() as i64
}

/// Name of one of these numbers; "" for others. Static text.
///
/// - simulations: in the batch; waiting, running, arrived, failed: how many of them do what.
/// - share: of the way that is done, of all together, from 0 to 1.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_progress_name(index: i64) -> *const c_char {
    static_name(&ProgressItem::C_NAMES, index)
}

/// Writes how far the running cagedyn_batch_advance_to() is, or how far the last one came (length: progress count).
///
/// # Safety
/// `monitor` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_monitor_progress(
    monitor: *const cagedyn_monitor,
    out: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    status(|| unsafe {
        let values = shared("monitor", monitor)?.monitor.progress().values();
        write_array("out", &values, out, length)
    })
}
