//! Contacts, bodies and force components of a model in C: what the rows and columns of force reports are.

use super::model::{cagedyn_model, find, item, length};
use libc::c_char;

/// Number of contacts: rows of cagedyn_sim_contact_forces(). Negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_contact_count(model: *const cagedyn_model) -> i64 {
    // SAFETY: see above.
    unsafe { length(model, |m| &m.contacts) }
}

/// Name of a contact that can exist; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_contact_name(
    model: *const cagedyn_model,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.contacts, |item| &item.name) }
}

/// Index of the contact that can exist of this name; CAGEDYN_ERR_UNKNOWN_NAME or another negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle, `name` NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_find_contact(model: *const cagedyn_model, name: *const c_char) -> i64 {
    // SAFETY: see above.
    unsafe { find(model, name, |m| &m.contacts) }
}

/// Number of contact quantities: columns of cagedyn_sim_contact_forces(). Negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_contact_quantity_count(model: *const cagedyn_model) -> i64 {
    // SAFETY: see above.
    unsafe { length(model, |m| &m.quantities) }
}

/// Name of a contact quantity; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_contact_quantity_name(
    model: *const cagedyn_model,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.quantities, |item| &item.name) }
}

/// SI unit ("1" for ratios) of a contact quantity; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_contact_quantity_unit(
    model: *const cagedyn_model,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.quantities, |item| &item.unit) }
}

/// Meaning of a contact quantity; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_contact_quantity_description(
    model: *const cagedyn_model,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.quantities, |item| &item.description) }
}

/// Index of the contact quantity of this name; CAGEDYN_ERR_UNKNOWN_NAME or another negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle, `name` NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_find_contact_quantity(
    model: *const cagedyn_model,
    name: *const c_char,
) -> i64 {
    // SAFETY: see above.
    unsafe { find(model, name, |m| &m.quantities) }
}

/// Number of bodies: blocks of cagedyn_sim_body_forces(). Negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_body_count(model: *const cagedyn_model) -> i64 {
    // SAFETY: see above.
    unsafe { length(model, |m| &m.bodies) }
}

/// Name of a body; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_body_name(model: *const cagedyn_model, index: i64) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.bodies, |item| &item.name) }
}

/// Index of the body of this name; CAGEDYN_ERR_UNKNOWN_NAME or another negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle, `name` NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_find_body(model: *const cagedyn_model, name: *const c_char) -> i64 {
    // SAFETY: see above.
    unsafe { find(model, name, |m| &m.bodies) }
}

/// Number of force sources: rows of a block of cagedyn_sim_body_forces(). Negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_force_source_count(model: *const cagedyn_model) -> i64 {
    // SAFETY: see above.
    unsafe { length(model, |m| &m.sources) }
}

/// Name of a force source; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_force_source_name(
    model: *const cagedyn_model,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.sources, |item| &item.name) }
}

/// Index of the force source of this name; CAGEDYN_ERR_UNKNOWN_NAME or another negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle, `name` NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_find_force_source(
    model: *const cagedyn_model,
    name: *const c_char,
) -> i64 {
    // SAFETY: see above.
    unsafe { find(model, name, |m| &m.sources) }
}

/// Number of components of a force on a body: columns of a block of cagedyn_sim_body_forces(). Ask for it: it depends on the
/// directions in which the bodies of the model can move. Negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_force_component_count(model: *const cagedyn_model) -> i64 {
    // SAFETY: see above.
    unsafe { length(model, |m| &m.components) }
}

/// Name of a component of a force; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_force_component_name(
    model: *const cagedyn_model,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.components, |item| &item.name) }
}

/// SI unit of a component of a force; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_force_component_unit(
    model: *const cagedyn_model,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.components, |item| &item.unit) }
}

/// Meaning of a component of a force; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_force_component_description(
    model: *const cagedyn_model,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.components, |item| &item.description) }
}

/// Index of the component of a force of this name; CAGEDYN_ERR_UNKNOWN_NAME or another negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle, `name` NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_find_force_component(
    model: *const cagedyn_model,
    name: *const c_char,
) -> i64 {
    // SAFETY: see above.
    unsafe { find(model, name, |m| &m.components) }
}
