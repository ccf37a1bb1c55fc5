//! Simulations in C.

use super::guard::{
    Exclusive, Handle, count, exclusive, free, guard, index, last_status, read_array, shared, status,
    write_array,
};
use super::model::cagedyn_model;
use crate::error::{Error, Result, Status};
use crate::model::Model;
use crate::scene::Preset;
use crate::sim::{Sim, SparsePattern};
use std::ffi::CString;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A running simulation. May be used by one thread at a time; a second one gets CAGEDYN_ERR_BUSY.
#[allow(non_camel_case_types)]
pub struct cagedyn_sim {
    content: Exclusive<Running>,
    /// Whether a batch owns it.
    pub(super) in_batch: AtomicBool,
}

impl Handle for cagedyn_sim {
    type Content = Running;

    fn exclusive(&self) -> &Exclusive<Running> {
        &self.content
    }
}

/// A simulation with memory for what is written to a host.
pub struct Running {
    pub(super) sim: Sim,
    /// Copies of the caller's arrays, so that overlapping arrays are harmless.
    pub(super) state: Vec<f64>,
    pub(super) result: Vec<f64>,
    pub(super) report: CString,
    /// Empty until a Jacobian is first asked for.
    pub(super) jacobian: Vec<f64>,
    /// None until a sparse Jacobian is first asked for.
    pub(super) pattern: Option<SparsePattern>,
}

/// Runs `entry` on a simulation that it may change.
///
/// # Safety
/// `sim` is NULL or a live handle that no other thread uses.
pub(super) unsafe fn with(sim: *mut cagedyn_sim, entry: impl FnOnce(&mut Running) -> Result<()>) -> i32 {
    // SAFETY: see above.
    status(|| entry(&mut *unsafe { exclusive("sim", sim) }?))
}

/// A handle to what `make` makes of a model, or NULL.
///
/// # Safety
/// `model` is NULL or a live handle.
unsafe fn new(model: *const cagedyn_model, make: impl FnOnce(Arc<Model>) -> Result<Sim>) -> *mut cagedyn_sim {
    if model.is_null() && last_status() != 0 {
        // Most likely the model could not be made, and why is worth more than that it is missing.
        return std::ptr::null_mut();
    }
    guard(
        |_| std::ptr::null_mut(),
        || {
            // SAFETY: see above.
            let sim = make(unsafe { shared("model", model) }?.model.clone())?;
            let (states, outputs) = (sim.state().len(), sim.channels().len());
            let (state, result) = (vec![0.0; states], vec![0.0; states.max(outputs)]);
            let running = Running {
                sim,
                state,
                result,
                report: CString::default(),
                jacobian: Vec::new(),
                pattern: None,
            };
            let (content, in_batch) = (Exclusive::new(running), AtomicBool::new(false));
            Ok(Box::into_raw(Box::new(cagedyn_sim { content, in_batch })))
        },
    )
}

/// Creates a simulation at the start of the model's scene. It keeps what it needs of the model. Returns NULL on
/// failure; with a model of NULL an error of the call before, such as that which made no model, stays the stored one. Free it
/// with cagedyn_sim_free().
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_new(model: *const cagedyn_model) -> *mut cagedyn_sim {
    // SAFETY: see above.
    unsafe { new(model, Sim::new) }
}

/// As cagedyn_sim_new(), with a preset (CAGEDYN_PRESET_...) instead of that of the scene: how accurate the simulation
/// is to be where the scene's method leaves that open.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_new_with_preset(
    model: *const cagedyn_model,
    preset: i32,
) -> *mut cagedyn_sim {
    let make = |model| {
        let place = usize::try_from(preset).ok().filter(|i| *i < Preset::ALL.len());
        let place = place.ok_or_else(|| {
            let text = format!("preset: {preset} is none of the CAGEDYN_PRESET_ numbers, 0 to 2");
            Error::new(Status::BadValue, text)
        })?;
        Sim::with_preset(model, Preset::ALL[place])
    };
    // SAFETY: see above.
    unsafe { new(model, make) }
}

/// Frees a simulation. NULL is ignored, and so is a simulation that a batch owns; the stored error stays.
///
/// # Safety
/// `sim` is NULL or a live handle; it must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_free(sim: *mut cagedyn_sim) {
    // SAFETY: see above.
    unsafe {
        if !sim.as_ref().is_some_and(|sim| sim.in_batch.load(Ordering::Acquire)) {
            free(sim);
        }
    }
}

/// Back to the start of the scene; inputs follow the scene again, statistics start at zero.
///
/// # Safety
/// `sim` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_reset(sim: *mut cagedyn_sim) -> i32 {
    // SAFETY: see above.
    unsafe { with(sim, |s| s.sim.reset()) }
}

/// Writes the simulated time in s to `time`.
///
/// # Safety
/// `sim` is NULL or a live handle, `time` NULL or a valid pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_time(sim: *const cagedyn_sim, time: *mut f64) -> i32 {
    // SAFETY: see above.
    status(|| unsafe { write_array("time", &[exclusive("sim", sim)?.sim.time()], time, 1) })
}

/// Writes the state to `state` (length: state count).
///
/// # Safety
/// `sim` is NULL or a live handle, `state` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_get_state(sim: *const cagedyn_sim, state: *mut f64, length: i64) -> i32 {
    // SAFETY: see above.
    status(|| unsafe { write_array("state", exclusive("sim", sim)?.sim.state(), state, length) })
}

/// Sets time (s, from 0 to 1e6) and state (length: state count). Inputs that are held stay held, counts go on. On failure nothing
/// changes.
///
/// - The present time and state change nothing.
/// - A state next to the present one at the present time (every number within a hundredth of the scale that its error is
///   controlled in) costs what cagedyn_sim_set_input() does: some force evaluations, and steps that grow again from a single
///   one between judgements. Method, step and power balance go on.
/// - Any other state begins anew: some thirty steps with controlled errors, each of about seven force evaluations and their
///   derivatives, before a method without them may go on, and a new power balance. Where time has passed since the last
///   beginning and does not go back, the run is not judged from then on, see cagedyn_sim_trust(). A host that imposes motion in
///   every step should set inputs or let the library integrate; for forces alone there is cagedyn_sim_derivative().
///
/// # Safety
/// `sim` is NULL or a live handle, `state` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_set_state(
    sim: *mut cagedyn_sim,
    time: f64,
    state: *const f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            read_array("state", state, length, &mut s.state)?;
            s.sim.set_state(time, &s.state)
        })
    }
}

/// Advances by `dt` >= 0 seconds. When a refused argument is the failure, nothing changes; otherwise time and state are then
/// those of the last step that could be made, and the simulation can be asked, changed, reset or advanced again.
///
/// # Safety
/// `sim` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_step(sim: *mut cagedyn_sim, dt: f64) -> i32 {
    // SAFETY: see above.
    unsafe { with(sim, |s| s.sim.step(dt)) }
}

/// Advances to time `t` (s), not before the present time and not beyond 1e6 s. A failure is as that of cagedyn_sim_step().
///
/// # Safety
/// `sim` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_advance_to(sim: *mut cagedyn_sim, t: f64) -> i32 {
    // SAFETY: see above.
    unsafe { with(sim, |s| s.sim.advance_to(t)) }
}

/// Writes the accelerations at the present state (length: velocity count, that is the states from position count on).
///
/// # Safety
/// `sim` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_accelerations(sim: *mut cagedyn_sim, out: *mut f64, length: i64) -> i32 {
    // SAFETY: see above.
    unsafe { with(sim, |s| write_array("out", &s.sim.forces()?.accelerations, out, length)) }
}

/// Writes the forces of all contacts at the present state: one row per contact, one column per contact quantity,
/// rows one after the other (length: contact count times contact quantity count).
///
/// The normal n points from the centre of the rolling element to the contact, t is n turned by +90 degrees. With the names of the
/// quantities the force on the element is -n normal_force + t (friction + rolling_resistance + film_pressure_roller), that on
/// its mate n normal_force + t (-friction + rolling_resistance + film_pressure_mate). Surfaces that are apart have zeros.
///
/// # Safety
/// `sim` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_contact_forces(
    sim: *mut cagedyn_sim,
    out: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe { with(sim, |s| write_array("out", s.sim.forces()?.contact_values(), out, length)) }
}

/// Writes the forces on all bodies by source at the present state: for every body a block with one row per force
/// source and one column per force component (length: body count times force source count times force component
/// count).
///
/// # Safety
/// `sim` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_body_forces(sim: *mut cagedyn_sim, out: *mut f64, length: i64) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            let bodies = s.sim.forces()?.body_values();
            write_array("out", bodies, out, length)
        })
    }
}

/// Writes the present value of an input to `value`.
///
/// # Safety
/// `sim` is NULL or a live handle, `value` NULL or a valid pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_get_input(sim: *const cagedyn_sim, input: i64, value: *mut f64) -> i32 {
    status(|| {
        // SAFETY: see above.
        let content = unsafe { exclusive("sim", sim) }?;
        let sim = &content.sim;
        let input = index("input", input, sim.model().input_count())?;
        // SAFETY: see above.
        unsafe { write_array("value", &[sim.input(input)?], value, 1) }
    })
}

/// Holds an input at `value` from now on, instead of the scene's function of time. Values have the range that scenes have.
/// The value that the input has already changes nothing.
///
/// # Safety
/// `sim` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_set_input(sim: *mut cagedyn_sim, input: i64, value: f64) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            let input = index("input", input, s.sim.model().input_count())?;
            s.sim.set_input(input, value)
        })
    }
}

/// Lets an input go on from `value` with `slope` per second from now on, instead of the scene's function of time. With a slope of 0 it
/// holds.
///
/// The place of a ring whose motion is prescribed and its rate (such as inner_ring.y and inner_ring.vy) are one motion. To set the
/// rate lets the place go on from where it is, with `slope` as its second rate: a host that owns the ring sets velocity and
/// acceleration at each of its steps, and the place neither jumps nor drifts from y + v h + a h^2/2. To set the place with a slope
/// sets its rate. A place that jumps does work that the power balance has as that of the drive of the ring. One out of the bearing is
/// refused.
///
/// # Safety
/// `sim` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_set_input_slope(
    sim: *mut cagedyn_sim,
    input: i64,
    value: f64,
    slope: f64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            let input = index("input", input, s.sim.model().input_count())?;
            s.sim.set_input_slope(input, value, slope)
        })
    }
}

/// Lets an input follow the scene again.
///
/// # Safety
/// `sim` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_release_input(sim: *mut cagedyn_sim, input: i64) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            let input = index("input", input, s.sim.model().input_count())?;
            s.sim.release_input(input)
        })
    }
}

/// Writes all outputs at the present state (length: output count).
///
/// # Safety
/// `sim` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_get_outputs(sim: *mut cagedyn_sim, out: *mut f64, length: i64) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            let n = s.sim.channels().len();
            s.sim.outputs(&mut s.result[..n])?;
            write_array("out", &s.result[..n], out, length)
        })
    }
}

/// Writes one output at the present state to `value`.
///
/// # Safety
/// `sim` is NULL or a live handle, `value` NULL or a valid pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_get_output(sim: *mut cagedyn_sim, output: i64, value: *mut f64) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            let output = index("output", output, s.sim.channels().len())?;
            write_array("value", &[s.sim.output(output)?], value, 1)
        })
    }
}

/// Length of the array for cagedyn_sim_save(); constant over the life of a simulation. Negative status code on
/// failure.
///
/// # Safety
/// `sim` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_save_length(sim: *const cagedyn_sim) -> i64 {
    // SAFETY: see above.
    count(|| Ok(unsafe { exclusive("sim", sim) }?.sim.save_len()))
}

/// Writes everything the future of the simulation depends on (length: save length). After cagedyn_sim_restore() into
/// a simulation of the same physics, solver and preset, with the same build of the library, it continues with bit-identical
/// results; title, comments and what is recorded may differ.
///
/// # Safety
/// `sim` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_save(sim: *const cagedyn_sim, out: *mut f64, length: i64) -> i32 {
    // SAFETY: see above.
    status(|| unsafe { write_array("out", &exclusive("sim", sim)?.sim.save(), out, length) })
}

/// Continues from what cagedyn_sim_save() wrote. On failure nothing changes.
///
/// # Safety
/// `sim` is NULL or a live handle, `saved` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_restore(sim: *mut cagedyn_sim, saved: *const f64, length: i64) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            let mut copy = vec![0.0; s.sim.save_len()];
            read_array("saved", saved, length, &mut copy)?;
            s.sim.restore(&copy)
        })
    }
}
