//! Simulations in C.

use super::guard::{
    check_array, count, exclusive, free, guard, index, last_status, read_array, shared, status, write_array,
};
use super::model::cagedyn_model;
use crate::error::{Error, Result, Status};
use crate::model::Model;
use crate::scene::Preset;
use crate::sim::Sim;
use std::ffi::CString;
use std::sync::Arc;

/// A running simulation. May be used by one thread at a time.
#[allow(non_camel_case_types)]
pub struct cagedyn_sim {
    pub(super) sim: Sim,
    /// Copies of the caller's arrays, so that overlapping arrays are harmless.
    state: Vec<f64>,
    result: Vec<f64>,
    pub(super) report: CString,
    /// Empty until a Jacobian is first asked for.
    jacobian: Vec<f64>,
}

/// Runs `entry` on a simulation that it may change.
///
/// # Safety
/// `sim` is NULL or a live handle that no other thread uses.
unsafe fn with(sim: *mut cagedyn_sim, entry: impl FnOnce(&mut cagedyn_sim) -> Result<()>) -> i32 {
    // SAFETY: see above.
    status(|| entry(unsafe { exclusive("sim", sim) }?))
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
            Ok(Box::into_raw(Box::new(cagedyn_sim {
                sim,
                state,
                result,
                report: CString::default(),
                jacobian: Vec::new(),
            })))
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

/// Frees a simulation. NULL is ignored, and the stored error stays.
///
/// # Safety
/// `sim` is NULL or a live handle; it must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_free(sim: *mut cagedyn_sim) {
    // SAFETY: see above.
    unsafe { free(sim) }
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
    status(|| unsafe { write_array("time", &[shared("sim", sim)?.sim.time()], time, 1) })
}

/// Writes the state to `state` (length: state count).
///
/// # Safety
/// `sim` is NULL or a live handle, `state` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_get_state(sim: *const cagedyn_sim, state: *mut f64, length: i64) -> i32 {
    // SAFETY: see above.
    status(|| unsafe { write_array("state", shared("sim", sim)?.sim.state(), state, length) })
}

/// Sets time (s) and state (length: state count) and restarts the integrator. On failure nothing changes.
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

/// Writes the rate of an arbitrary state at time `t` (s) to `rate`, for hosts with their own integrator: the
/// velocities, then the accelerations. Both arrays have the length of the state and may be the same. The
/// simulation's own state does not change.
///
/// # Safety
/// `sim` is NULL or a live handle, the arrays are NULL or hold `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_derivative(
    sim: *mut cagedyn_sim,
    t: f64,
    state: *const f64,
    rate: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            check_array("rate", rate.is_null(), length, s.state.len())?;
            read_array("state", state, length, &mut s.state)?;
            let n = s.state.len();
            s.sim.derivative(t, &s.state, &mut s.result[..n])?;
            write_array("rate", &s.result[..n], rate, length)
        })
    }
}

/// Writes the exact derivatives of what cagedyn_sim_derivative() gives over the state, at an arbitrary state and time
/// `t` (s), to `jacobian`, for hosts with their own implicit integrator: a square matrix by columns, so that
/// jacobian[i + k * length] is the derivative of rate i over state k. `length` is the length of the state, and
/// `jacobian_length` its square. The simulation's own state does not change. The first call takes memory for one such
/// matrix. Arrays may overlap.
///
/// # Safety
/// `sim` is NULL or a live handle, `state` NULL or an array of `length` numbers, `jacobian` NULL or an array of
/// `jacobian_length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_jacobian(
    sim: *mut cagedyn_sim,
    t: f64,
    state: *const f64,
    length: i64,
    jacobian: *mut f64,
    jacobian_length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            let size = s.state.len() * s.state.len();
            check_array("jacobian", jacobian.is_null(), jacobian_length, size)?;
            read_array("state", state, length, &mut s.state)?;
            s.jacobian.resize(size, 0.0);
            s.sim.jacobian(t, &s.state, &mut s.jacobian)?;
            write_array("jacobian", &s.jacobian, jacobian, jacobian_length)
        })
    }
}

/// Evaluates the exact derivatives J of what cagedyn_sim_derivative() gives, at an arbitrary state and time `t` (s), and
/// keeps them for cagedyn_sim_factorize(): the first of three functions that solve the linear systems of a host's own
/// implicit integrator in time proportional to the number of rollers. `length` is the length of the state. The
/// simulation's own state does not change. The first call takes memory.
///
/// # Safety
/// `sim` is NULL or a live handle, `state` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_linearize(
    sim: *mut cagedyn_sim,
    t: f64,
    state: *const f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            read_array("state", state, length, &mut s.state)?;
            s.sim.linearize(t, &s.state)
        })
    }
}

/// Factorizes I - gamma J with the derivatives of the last cagedyn_sim_linearize(); `gamma` in s, above zero. Can be
/// repeated with another `gamma`.
///
/// # Safety
/// `sim` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_factorize(sim: *mut cagedyn_sim, gamma: f64) -> i32 {
    // SAFETY: see above.
    unsafe { with(sim, |s| s.sim.factorize(gamma)) }
}

/// Replaces the right-hand side in `x` by the solution of (I - gamma J) x = b with the factors of the last
/// cagedyn_sim_factorize(). `length` is the length of the state.
///
/// # Safety
/// `sim` is NULL or a live handle, `x` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_solve(sim: *mut cagedyn_sim, x: *mut f64, length: i64) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            read_array("x", x, length, &mut s.state)?;
            s.sim.solve(&mut s.state)?;
            write_array("x", &s.state, x, length)
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

/// Advances to time `t` (s), not before the present time. A failure is as that of cagedyn_sim_step().
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
/// # Safety
/// `sim` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_contact_forces(
    sim: *mut cagedyn_sim,
    out: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe { with(sim, |s| write_array("out", s.sim.forces()?.contacts.as_flattened(), out, length)) }
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
            let bodies = s.sim.forces()?.bodies.as_flattened().as_flattened();
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
        let sim = &unsafe { shared("sim", sim) }?.sim;
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
    count(|| Ok(unsafe { shared("sim", sim) }?.sim.save_len()))
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
    status(|| unsafe { write_array("out", &shared("sim", sim)?.sim.save(), out, length) })
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
