//! Lengths that follow from a scene, in C.

use super::guard::{index, shared, status, write_array};
use super::model::{cagedyn_model, find, item, length};
use libc::c_char;

/// Number of lengths and counts of the bearing that follow from its scene. Negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_geometry_count(model: *const cagedyn_model) -> i64 {
    // SAFETY: see above.
    unsafe { length(model, |m| &m.geometry) }
}

/// Name of one of them, for example "pitch_radius"; "" on failure. Lives as long as the model. Those that the bearing has of
/// element_count, element_radius, pitch_radius, outer_raceway_radius, inner_raceway_radius, radial_internal_clearance,
/// guide_radius, guide_clearance, pocket_clearance.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_geometry_name(
    model: *const cagedyn_model,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.geometry, |item| &item.name) }
}

/// SI unit ("1" for counts) of one of them; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_geometry_unit(
    model: *const cagedyn_model,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.geometry, |item| &item.unit) }
}

/// Meaning of one of them; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_geometry_description(
    model: *const cagedyn_model,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.geometry, |item| &item.description) }
}

/// Index of the one of this name; CAGEDYN_ERR_UNKNOWN_NAME or another negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle, `name` NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_find_geometry(
    model: *const cagedyn_model,
    name: *const c_char,
) -> i64 {
    // SAFETY: see above.
    unsafe { find(model, name, |m| &m.geometry) }
}

/// Writes one of them to `value`.
///
/// # Safety
/// `model` is NULL or a live handle, `value` NULL or a valid pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_get_geometry(
    model: *const cagedyn_model,
    index: i64,
    value: *mut f64,
) -> i32 {
    status(|| {
        // SAFETY: see above.
        let values = &unsafe { shared("model", model) }?.geometry_values;
        let place = self::index("index", index, values.len())?;
        // SAFETY: see above.
        unsafe { write_array("value", &values[place..=place], value, 1) }
    })
}
