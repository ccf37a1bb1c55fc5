//! For hosts with their own integrator: rates, derivatives, linear systems, forces, outputs and energies at arbitrary states.
//!
//! None of these functions touches the simulation's own state, or what it counts.

use super::guard::{
    check_array, count, lend_array, read_array, shared, static_name, status, write_array, write_parts,
};
use super::model::cagedyn_model;
use super::sim::{cagedyn_sim, with};
use crate::error::Result;
use crate::sim::SparsePattern;
use libc::c_char;
use std::ffi::CStr;

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
            // A host calls this as often as it can: nothing is copied that needs not be.
            let state = lend_array("state", state, length, &mut s.state)?;
            check_array("rate", rate.is_null(), length, state.len())?;
            let [velocities, accelerations] = s.sim.derivative_parts(t, state)?;
            write_parts("rate", [velocities, accelerations], rate, length)
        })
    }
}

/// Writes the derivative over time of what cagedyn_sim_derivative() gives, at a constant state, to `rate`: how inputs that change
/// with time change the rates. Rosenbrock methods need it. Arrays and the rest as there.
///
/// # Safety
/// `sim` is NULL or a live handle, the arrays are NULL or hold `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_time_derivative(
    sim: *mut cagedyn_sim,
    t: f64,
    state: *const f64,
    rate: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            read_array("state", state, length, &mut s.state)?;
            check_array("rate", rate.is_null(), length, s.state.len())?;
            let n = s.state.len();
            s.sim.time_derivative(t, &s.state, &mut s.result[..n])?;
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
            if s.jacobian.len() < size {
                s.jacobian.resize(size, 0.0);
            }
            s.sim.jacobian(t, &s.state, &mut s.jacobian[..size])?;
            write_array("jacobian", &s.jacobian[..size], jacobian, jacobian_length)
        })
    }
}

/// Writes the exact derivatives of what cagedyn_sim_derivative() gives over the inputs, at an arbitrary state and time `t` (s), to
/// `jacobian`, by columns: jacobian[i + k * length] is that of rate i over input k. `length` is the length of the state,
/// `jacobian_length` that times the number of inputs. What follows from an input, such as the orbit of elements that roll, moves with it;
/// the rate of the place of a ring is an input of its own. The simulation's own state does not change.
///
/// # Safety
/// `sim` is NULL or a live handle, `state` NULL or an array of `length` numbers, `jacobian` NULL or an array of
/// `jacobian_length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_input_jacobian(
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
            let size = s.state.len() * s.sim.model().input_count();
            check_array("jacobian", jacobian.is_null(), jacobian_length, size)?;
            read_array("state", state, length, &mut s.state)?;
            let mut found = vec![0.0; size];
            s.sim.input_jacobian(t, &s.state, &mut found)?;
            write_array("jacobian", &found, jacobian, jacobian_length)
        })
    }
}

/// Writes the derivatives of the outputs at an arbitrary state and time `t` (s) over the states and over the inputs, by columns:
/// over_states[i + k * outputs] is that of output i over state k. `length` is the length of the state, `states_length` that times the
/// number of outputs, `inputs_length` the number of inputs times that of outputs. They are central differences, good to some five digits; at a
/// kink of a force the mean of both sides. The simulation's own state does not change.
///
/// # Safety
/// `sim` is NULL or a live handle, the arrays are NULL or hold as many numbers as their lengths say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_output_jacobian(
    sim: *mut cagedyn_sim,
    t: f64,
    state: *const f64,
    length: i64,
    over_states: *mut f64,
    states_length: i64,
    over_inputs: *mut f64,
    inputs_length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            let outputs = s.sim.channels().len();
            let sizes = [s.state.len(), s.sim.model().input_count()].map(|n| n * outputs);
            check_array("over_states", over_states.is_null(), states_length, sizes[0])?;
            check_array("over_inputs", over_inputs.is_null(), inputs_length, sizes[1])?;
            read_array("state", state, length, &mut s.state)?;
            let [mut states, mut inputs] = sizes.map(|size| vec![0.0; size]);
            s.sim.output_jacobian(t, &s.state, &mut states, &mut inputs)?;
            write_array("over_states", &states, over_states, states_length)?;
            write_array("over_inputs", &inputs, over_inputs, inputs_length)
        })
    }
}

/// Writes the first time after `t` (s) at which an input that follows the scene jumps or has a kink to `event`, where a host's own integrator has
/// to stop; infinity if there is none. Forces have no jumps that it would have to land on.
///
/// # Safety
/// `sim` is NULL or a live handle, `event` NULL or a place for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_next_event(sim: *mut cagedyn_sim, t: f64, event: *mut f64) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            check_array("event", event.is_null(), 1, 1)?;
            let found = s.sim.next_event(t)?;
            write_array("event", &[found], event, 1)
        })
    }
}

/// Number of derivatives that cagedyn_sim_sparse_jacobian() gives. Negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_jacobian_entry_count(model: *const cagedyn_model) -> i64 {
    // SAFETY: see above.
    count(|| Ok(unsafe { shared("model", model) }?.pattern().rows.len()))
}

/// Writes where the derivatives of cagedyn_sim_sparse_jacobian() are, in compressed sparse columns counted from 0, the same
/// for all states: entries `column_starts[k]` to `column_starts[k + 1] - 1` belong to column k, `rows[i]` is the row of entry i,
/// ascending in each column. `starts_length` is one more than the length of the state, `rows_length` the number of entries.
///
/// # Safety
/// `model` is NULL or a live handle, the arrays are NULL or hold as many numbers as their lengths say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_jacobian_pattern(
    model: *const cagedyn_model,
    column_starts: *mut i64,
    starts_length: i64,
    rows: *mut i64,
    rows_length: i64,
) -> i32 {
    status(|| {
        // SAFETY: see above.
        let pattern = unsafe { shared("model", model) }?.pattern();
        // SAFETY: see above.
        unsafe { write_pattern(pattern, (column_starts, starts_length), (rows, rows_length)) }
    })
}

/// Writes a pattern to arrays with their lengths.
///
/// # Safety
/// The arrays are NULL or hold as many numbers as their lengths say.
unsafe fn write_pattern(
    pattern: &SparsePattern,
    (column_starts, starts_length): (*mut i64, i64),
    (rows, rows_length): (*mut i64, i64),
) -> Result<()> {
    let [starts, places] = [&pattern.column_starts, &pattern.rows]
        .map(|list| list.iter().map(|i| *i as i64).collect::<Vec<i64>>());
    check_array("column_starts", column_starts.is_null(), starts_length, starts.len())?;
    // SAFETY: see above.
    unsafe {
        write_array("rows", &places, rows, rows_length)?;
        write_array("column_starts", &starts, column_starts, starts_length)
    }
}

/// Number of pairs of an output and an input that cagedyn_model_feedthrough_pattern() has. Negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_feedthrough_entry_count(model: *const cagedyn_model) -> i64 {
    // SAFETY: see above.
    count(|| Ok(unsafe { shared("model", model) }?.feedthrough().rows.len()))
}

/// Writes which outputs may change at once with which inputs, direct feed-through, in compressed sparse columns counted from 0, the same for
/// all states: `rows[i]` with i from `column_starts[k]` to `column_starts[k + 1] - 1` are the outputs of input k, ascending. The
/// derivatives of all others over that input are zero. `starts_length` is one more than the number of inputs, `rows_length` the number of pairs.
///
/// # Safety
/// `model` is NULL or a live handle, the arrays are NULL or hold as many numbers as their lengths say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_feedthrough_pattern(
    model: *const cagedyn_model,
    column_starts: *mut i64,
    starts_length: i64,
    rows: *mut i64,
    rows_length: i64,
) -> i32 {
    status(|| {
        // SAFETY: see above.
        let pattern = unsafe { shared("model", model) }?.feedthrough();
        // SAFETY: see above.
        unsafe { write_pattern(pattern, (column_starts, starts_length), (rows, rows_length)) }
    })
}

/// Writes what cagedyn_sim_jacobian() gives, without what is always zero, to `values`, in the order of
/// cagedyn_model_jacobian_pattern(). `length` is the length of the state, `values_length` the number of entries. The first
/// call takes memory.
///
/// # Safety
/// `sim` is NULL or a live handle, `state` NULL or an array of `length` numbers, `values` NULL or an array of `values_length`
/// numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_sparse_jacobian(
    sim: *mut cagedyn_sim,
    t: f64,
    state: *const f64,
    length: i64,
    values: *mut f64,
    values_length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            if s.pattern.is_none() {
                s.pattern = Some(s.sim.model().jacobian_pattern());
            }
            let Some(pattern) = &s.pattern else { return Ok(()) };
            let entries = pattern.rows.len();
            check_array("values", values.is_null(), values_length, entries)?;
            read_array("state", state, length, &mut s.state)?;
            if s.jacobian.len() < entries {
                s.jacobian.resize(entries, 0.0);
            }
            s.sim.sparse_jacobian(t, &s.state, pattern, &mut s.jacobian[..entries])?;
            write_array("values", &s.jacobian[..entries], values, values_length)
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
/// cagedyn_sim_factorize(). `length` is the length of the state. CAGEDYN_ERR_BAD_STATE without factors, whatever is in `x`, or
/// when the solution is not finite; CAGEDYN_ERR_BAD_VALUE for numbers that are not finite.
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

/// As cagedyn_sim_contact_forces(), at an arbitrary state and time `t` (s). `state_length` is the length of the state, `length`
/// that of `out`.
///
/// # Safety
/// `sim` is NULL or a live handle, the arrays are NULL or hold as many numbers as their lengths say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_contact_forces_at(
    sim: *mut cagedyn_sim,
    t: f64,
    state: *const f64,
    state_length: i64,
    out: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            read_array("state", state, state_length, &mut s.state)?;
            let forces = s.sim.forces_at(t, &s.state)?;
            write_array("out", forces.contact_values(), out, length)
        })
    }
}

/// As cagedyn_sim_body_forces(), at an arbitrary state and time `t` (s). `state_length` is the length of the state, `length`
/// that of `out`.
///
/// # Safety
/// `sim` is NULL or a live handle, the arrays are NULL or hold as many numbers as their lengths say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_body_forces_at(
    sim: *mut cagedyn_sim,
    t: f64,
    state: *const f64,
    state_length: i64,
    out: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            read_array("state", state, state_length, &mut s.state)?;
            let forces = s.sim.forces_at(t, &s.state)?;
            write_array("out", forces.body_values(), out, length)
        })
    }
}

/// As cagedyn_sim_get_outputs(), at an arbitrary state and time `t` (s), with the forces of that state. `state_length` is the
/// length of the state, `length` that of `out`.
///
/// # Safety
/// `sim` is NULL or a live handle, the arrays are NULL or hold as many numbers as their lengths say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_outputs_at(
    sim: *mut cagedyn_sim,
    t: f64,
    state: *const f64,
    state_length: i64,
    out: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            read_array("state", state, state_length, &mut s.state)?;
            let n = s.sim.channels().len();
            s.sim.outputs_at(t, &s.state, &mut s.result[..n])?;
            write_array("out", &s.result[..n], out, length)
        })
    }
}

/// Names of the energies of a state.
const ENERGIES: [&CStr; 3] = [c"kinetic", c"elastic", c"potential"];

/// Number of energies of a state.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_energy_count() -> i64 {
    ENERGIES.len() as i64
}

/// Name of an energy of a state: kinetic, elastic, potential; "" for other numbers. Static text.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_energy_name(index: i64) -> *const c_char {
    static_name(&ENERGIES, index)
}

/// Writes the energies of an arbitrary state at time `t` (s), J: of motion, of contacts that are pressed together, and of weights,
/// zero with all bodies at the centre (length: energy count). `state_length` is the length of the state.
///
/// # Safety
/// `sim` is NULL or a live handle, the arrays are NULL or hold as many numbers as their lengths say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_energies_at(
    sim: *mut cagedyn_sim,
    t: f64,
    state: *const f64,
    state_length: i64,
    out: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(sim, |s| {
            read_array("state", state, state_length, &mut s.state)?;
            let energy = s.sim.energy_at(t, &s.state)?;
            write_array("out", &[energy.kinetic, energy.elastic, energy.potential], out, length)
        })
    }
}
