//! Load along the rollers in C: of a simulation at its present state.

use super::guard::{count, exclusive, index, write_array};
use super::model::{cagedyn_model, find, item, length};
use super::sim::{Running, cagedyn_sim, with};
use crate::error::Result;
use crate::model::LineLoad;
use libc::c_char;

/// Number of line load quantities: columns of cagedyn_sim_line_loads(). Negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_line_load_quantity_count(model: *const cagedyn_model) -> i64 {
    // SAFETY: see above.
    unsafe { length(model, |m| &m.line_load_quantities) }
}

/// Name of a line load quantity; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_line_load_quantity_name(
    model: *const cagedyn_model,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.line_load_quantities, |item| &item.name) }
}

/// SI unit of a line load quantity; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_line_load_quantity_unit(
    model: *const cagedyn_model,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.line_load_quantities, |item| &item.unit) }
}

/// Meaning of a line load quantity; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_line_load_quantity_description(
    model: *const cagedyn_model,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.line_load_quantities, |item| &item.description) }
}

/// Index of the line load quantity of this name; CAGEDYN_ERR_UNKNOWN_NAME or another negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle, `name` NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_find_line_load_quantity(
    model: *const cagedyn_model,
    name: *const c_char,
) -> i64 {
    // SAFETY: see above.
    unsafe { find(model, name, |m| &m.line_load_quantities) }
}

/// What is known along a contact at the present state.
fn line_loads(running: &mut Running, contact: i64) -> Result<Vec<LineLoad>> {
    let contacts = running.sim.forces()?;
    let contacts = contacts.contacts.len().max(contacts.space.contacts.len());
    running.sim.line_loads(index("contact", contact, contacts)?)
}

/// Number of places along the roller at which a contact is loaded at the present state: rows of cagedyn_sim_line_loads(). Zero
/// where the surfaces are apart, and of contacts that are no lines of rollers that move in space. Negative status code on failure.
///
/// # Safety
/// `sim` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_line_load_count(sim: *mut cagedyn_sim, contact: i64) -> i64 {
    // SAFETY: see above.
    count(|| Ok(line_loads(&mut *unsafe { exclusive("sim", sim) }?, contact)?.len()))
}

/// Writes how a contact is loaded along its roller at the present state: one row per place in their order along the roller, one column
/// per line load quantity, rows one after the other (length: line load count times line load quantity count). Places follow the loaded
/// part of the contact, so their number may change with the state: ask for it before. Line load times extent, summed over the rows, is
/// the normal force.
///
/// # Safety
/// `sim` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_line_loads(
    sim: *mut cagedyn_sim,
    contact: i64,
    out: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe { with(sim, |s| write_array("out", line_loads(s, contact)?.as_flattened(), out, length)) }
}
