//! Equilibrium in C: displacement, loads of the contacts and stiffness of a bearing without time stepping.

use super::guard::{EMPTY, count, free, guard, index, shared, status, text, write_array};
use super::model::{Item, cagedyn_model};
use crate::equilibrium::{Equilibrium, RaceControl, equilibrium};
use crate::error::{Error, Result, Status};
use libc::c_char;
use std::ffi::CString;

/// The equilibrium of a bearing at its start. Any number of threads may read it.
#[allow(non_camel_case_types)]
pub struct cagedyn_equilibrium {
    found: Equilibrium,
    coordinates: Vec<Item>,
    element_quantities: Vec<Item>,
    contact_quantities: Vec<Item>,
    contacts: Vec<Item>,
    life_quantities: Vec<Item>,
    warnings: Vec<Item>,
}

impl cagedyn_equilibrium {
    fn new(found: Equilibrium) -> Self {
        let named = |quantities: &[crate::model::Quantity]| -> Vec<Item> {
            quantities.iter().map(|q| Item::new(q.name, q.unit, q.description)).collect()
        };
        let plain = |texts: &[String]| texts.iter().map(|text| Item::new(text, "", "")).collect();
        Self {
            coordinates: named(&found.coordinates),
            element_quantities: named(found.element_quantities),
            contact_quantities: named(found.contact_quantities),
            contacts: plain(&found.contacts),
            life_quantities: found.life.as_ref().map_or_else(Vec::new, |life| named(life.quantities)),
            warnings: plain(&found.warnings),
            found,
        }
    }
}

/// Finds the equilibrium of the model's scene at its start: displacement of the inner ring under its load, or the load at a displacement
/// where the scene holds it, loads of all contacts, stiffness. `control` says what balls follow at speed: the hypothesis that the "outer" or the "inner" race controls
/// them, axes parallel to that of the bearing with "none", or their own "friction" in steady motion; NULL for "outer". Returns NULL where there is no equilibrium, or none was found, with the reason in cagedyn_error_message(). Takes
/// milliseconds. Free it with cagedyn_equilibrium_free().
///
/// # Safety
/// `model` is NULL or a live handle, `control` NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_find(
    model: *const cagedyn_model,
    control: *const c_char,
) -> *mut cagedyn_equilibrium {
    guard(
        |_| std::ptr::null_mut(),
        || {
            // SAFETY: see above.
            let model = unsafe { shared("model", model) }?;
            // SAFETY: see above.
            let control = if control.is_null() { "outer" } else { unsafe { text("control", control) }? };
            let found = equilibrium(&model.model, control_of(control)?)?;
            Ok(Box::into_raw(Box::new(cagedyn_equilibrium::new(found))))
        },
    )
}

fn control_of(name: &str) -> Result<RaceControl> {
    let known = RaceControl::ALL.into_iter().find(|(known, _)| *known == name);
    known.map(|(_, control)| control).ok_or_else(|| {
        let names = RaceControl::ALL.map(|(name, _)| name).join(", ");
        Error::new(Status::UnknownName, format!("control: '{name}' is not one of {names}"))
    })
}

/// Frees an equilibrium. NULL is ignored, and the stored error stays.
///
/// # Safety
/// `found` is NULL or a live handle; it must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_free(found: *mut cagedyn_equilibrium) {
    // SAFETY: see above.
    unsafe { free(found) }
}

/// A text of an item of one of the lists; "" on failure.
///
/// # Safety
/// `found` is NULL or a live handle.
unsafe fn item(
    found: *const cagedyn_equilibrium,
    i: i64,
    list: fn(&cagedyn_equilibrium) -> &Vec<Item>,
    text: fn(&Item) -> &CString,
) -> *const c_char {
    guard(
        |_| EMPTY.as_ptr(),
        || {
            // SAFETY: as the caller's.
            let list = list(unsafe { shared("found", found) }?);
            Ok(text(&list[index("index", i, list.len())?]).as_ptr())
        },
    )
}

/// Number of items of one of the lists.
///
/// # Safety
/// `found` is NULL or a live handle.
unsafe fn length(found: *const cagedyn_equilibrium, list: fn(&cagedyn_equilibrium) -> &Vec<Item>) -> i64 {
    // SAFETY: as the caller's.
    count(|| Ok(list(unsafe { shared("found", found) }?).len()))
}

/// Number of coordinates of the inner ring: x, y, z, tilt_y and tilt_z of a ring in space, y and z of one in the plane. Negative status code on failure.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_coordinate_count(found: *const cagedyn_equilibrium) -> i64 {
    // SAFETY: see above.
    unsafe { length(found, |e| &e.coordinates) }
}

/// Name of one of them; "" on failure. Lives as long as the equilibrium.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_coordinate_name(
    found: *const cagedyn_equilibrium,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(found, index, |e| &e.coordinates, |item| &item.name) }
}

/// SI unit ("1" for ratios) of one of them; "" on failure. Lives as long as the equilibrium.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_coordinate_unit(
    found: *const cagedyn_equilibrium,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(found, index, |e| &e.coordinates, |item| &item.unit) }
}

/// Number of numbers that cagedyn_equilibrium_element() writes. Negative status code on failure.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_element_quantity_count(
    found: *const cagedyn_equilibrium,
) -> i64 {
    // SAFETY: see above.
    unsafe { length(found, |e| &e.element_quantities) }
}

/// Name of one of them; "" on failure. Lives as long as the equilibrium.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_element_quantity_name(
    found: *const cagedyn_equilibrium,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(found, index, |e| &e.element_quantities, |item| &item.name) }
}

/// SI unit ("1" for ratios) of one of them; "" on failure. Lives as long as the equilibrium.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_element_quantity_unit(
    found: *const cagedyn_equilibrium,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(found, index, |e| &e.element_quantities, |item| &item.unit) }
}

/// Number of numbers that cagedyn_equilibrium_contact() writes. Negative status code on failure.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_contact_quantity_count(
    found: *const cagedyn_equilibrium,
) -> i64 {
    // SAFETY: see above.
    unsafe { length(found, |e| &e.contact_quantities) }
}

/// Name of one of them; "" on failure. Lives as long as the equilibrium.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_contact_quantity_name(
    found: *const cagedyn_equilibrium,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(found, index, |e| &e.contact_quantities, |item| &item.name) }
}

/// SI unit ("1" for ratios) of one of them; "" on failure. Lives as long as the equilibrium.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_contact_quantity_unit(
    found: *const cagedyn_equilibrium,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(found, index, |e| &e.contact_quantities, |item| &item.unit) }
}

/// Number of contacts, those of an element together. Negative status code on failure.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_contact_count(found: *const cagedyn_equilibrium) -> i64 {
    // SAFETY: see above.
    unsafe { length(found, |e| &e.contacts) }
}

/// Name of one of them; "" on failure. Lives as long as the equilibrium.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_contact_name(
    found: *const cagedyn_equilibrium,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(found, index, |e| &e.contacts, |item| &item.name) }
}

/// Number of rolling elements. Negative status code on failure.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_element_count(found: *const cagedyn_equilibrium) -> i64 {
    // SAFETY: see above.
    count(|| Ok(unsafe { shared("found", found) }?.found.elements.len()))
}

/// Number of things that are amiss without preventing the equilibrium: an ellipse beyond the shoulder, a pressure above the static limit of
/// ISO 76, balls without load. Negative status code on failure.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_warning_count(found: *const cagedyn_equilibrium) -> i64 {
    // SAFETY: see above.
    unsafe { length(found, |e| &e.warnings) }
}

/// One of these, as one line. "" on failure. Lives as long as the equilibrium.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_warning(
    found: *const cagedyn_equilibrium,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(found, index, |e| &e.warnings, |item| &item.name) }
}

/// Writes the displacement of the inner ring over its coordinates, m and rad (length: coordinate count).
///
/// # Safety
/// `found` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_displacement(
    found: *const cagedyn_equilibrium,
    out: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    status(|| unsafe { write_array("out", &shared("found", found)?.found.displacement, out, length) })
}

/// Writes the load that the bearing carries over these coordinates, N and N m: that of the scene where the ring is free, else what holds
/// it (length: coordinate count).
///
/// # Safety
/// `found` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_load(
    found: *const cagedyn_equilibrium,
    out: *mut f64,
    length: i64,
) -> i32 {
    status(|| {
        // SAFETY: see above.
        let load: Vec<f64> = unsafe { shared("found", found) }?.found.load();
        // SAFETY: see above.
        unsafe { write_array("out", &load, out, length) }
    })
}

/// Writes the stiffness of the bearing, row by row: the derivative of the load over coordinate i by that of the displacement over
/// coordinate k stands at i * n + k, N/m and its kin (length: n * n, n the coordinate count). Springs that act on the ring are not in it.
///
/// # Safety
/// `found` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_stiffness(
    found: *const cagedyn_equilibrium,
    out: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    status(|| unsafe { write_array("out", &shared("found", found)?.found.stiffness, out, length) })
}

/// Writes what is known of an element (length: element quantity count).
///
/// # Safety
/// `found` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_element(
    found: *const cagedyn_equilibrium,
    element: i64,
    out: *mut f64,
    length: i64,
) -> i32 {
    status(|| {
        // SAFETY: see above.
        let elements = &unsafe { shared("found", found) }?.found.elements;
        let element = index("element", element, elements.len())?;
        // SAFETY: see above.
        unsafe { write_array("out", &elements[element], out, length) }
    })
}

/// Writes what is known of a contact (length: contact quantity count).
///
/// # Safety
/// `found` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_contact(
    found: *const cagedyn_equilibrium,
    contact: i64,
    out: *mut f64,
    length: i64,
) -> i32 {
    status(|| {
        // SAFETY: see above.
        let contacts = &unsafe { shared("found", found) }?.found.contact_values;
        let contact = index("contact", contact, contacts.len())?;
        // SAFETY: see above.
        unsafe { write_array("out", &contacts[contact], out, length) }
    })
}

/// Number of places along every roller at which its line loads are told: those of rollers that may tilt; of others none. Negative status
/// code on failure.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_line_load_count(found: *const cagedyn_equilibrium) -> i64 {
    // SAFETY: see above.
    count(|| Ok(unsafe { shared("found", found) }?.found.line_loads.places.len()))
}

/// Writes these places, the same of all contacts, from the middle of the roller along its axis, m (length: line load count).
///
/// # Safety
/// `found` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_line_load_places(
    found: *const cagedyn_equilibrium,
    out: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    status(|| unsafe { write_array("out", &shared("found", found)?.found.line_loads.places, out, length) })
}

/// Writes the load per length of a contact at these places, N/m (length: line load count).
///
/// # Safety
/// `found` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_line_loads(
    found: *const cagedyn_equilibrium,
    contact: i64,
    out: *mut f64,
    length: i64,
) -> i32 {
    status(|| {
        // SAFETY: see above.
        let found = &unsafe { shared("found", found) }?.found;
        let contact = index("contact", contact, found.contacts.len())?;
        let loads = found.line_loads.values.get(contact).map_or(&[][..], Vec::as_slice);
        // SAFETY: see above.
        unsafe { write_array("out", loads, out, length) }
    })
}

/// Number of numbers that cagedyn_equilibrium_life() writes: zero of balls, where no roller is loaded, and of contact angles above 45 degrees. Negative
/// status code on failure.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_life_quantity_count(found: *const cagedyn_equilibrium) -> i64 {
    // SAFETY: see above.
    unsafe { length(found, |e| &e.life_quantities) }
}

/// Name of one of them; "" on failure. Lives as long as the equilibrium.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_life_quantity_name(
    found: *const cagedyn_equilibrium,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(found, index, |e| &e.life_quantities, |item| &item.name) }
}

/// SI unit ("1" for numbers) of one of them; "" on failure. Lives as long as the equilibrium.
///
/// # Safety
/// `found` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_life_quantity_unit(
    found: *const cagedyn_equilibrium,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(found, index, |e| &e.life_quantities, |item| &item.unit) }
}

/// Writes the reference life of rollers after ISO/TS 16281, and what it follows from (length: life quantity count): turns and time that nine of ten such
/// bearings reach, the radial load under which ISO 281 gives as much, load ratings and equivalent loads. The time is infinite where the rings do not turn
/// against each other.
///
/// # Safety
/// `found` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_equilibrium_life(
    found: *const cagedyn_equilibrium,
    out: *mut f64,
    length: i64,
) -> i32 {
    status(|| {
        // SAFETY: see above.
        let life = &unsafe { shared("found", found) }?.found.life;
        let values = life.as_ref().map_or(&[][..], |life| &life.values);
        // SAFETY: see above.
        unsafe { write_array("out", values, out, length) }
    })
}
