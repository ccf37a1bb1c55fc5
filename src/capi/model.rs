//! Models in C: creation and introspection.

use super::guard::{EMPTY, count, free, guard, index, place_of, shared, text, to_c_string};
use crate::error::{Error, Result, Status};
use crate::model::{FORCE_SOURCES, LINE_LOAD_QUANTITIES, Model};
use crate::scene::Scene;
use crate::sim::SparsePattern;
use libc::c_char;
use std::ffi::CString;
use std::sync::{Arc, OnceLock};

/// A compiled scene. Immutable; may be used from several threads at a time.
#[allow(non_camel_case_types)]
pub struct cagedyn_model {
    pub(super) model: Arc<Model>,
    scene: CString,
    states: Vec<Item>,
    inputs: Vec<Item>,
    outputs: Vec<Item>,
    pub(super) contacts: Vec<Item>,
    pub(super) bodies: Vec<Item>,
    pub(super) quantities: Vec<Item>,
    pub(super) line_load_quantities: Vec<Item>,
    pub(super) sources: Vec<Item>,
    pub(super) components: Vec<Item>,
    pub(super) geometry: Vec<Item>,
    pub(super) geometry_values: Vec<f64>,
    warnings: Vec<Item>,
    pattern: OnceLock<SparsePattern>,
    feedthrough: OnceLock<SparsePattern>,
}

/// Texts of a named item.
pub(super) struct Item {
    pub(super) name: CString,
    pub(super) unit: CString,
    pub(super) description: CString,
}

impl Item {
    pub(super) fn new(name: &str, unit: &str, description: &str) -> Self {
        Self { name: to_c_string(name), unit: to_c_string(unit), description: to_c_string(description) }
    }
}

impl cagedyn_model {
    fn new(model: Model) -> Self {
        let plain = |names: Vec<String>| names.iter().map(|n| Item::new(n, "", "")).collect();
        let geometry = model.geometry();
        let states = model.state_infos();
        let inputs = model.input_infos();
        Self {
            scene: to_c_string(&model.scene().to_json()),
            states: states.iter().map(|s| Item::new(&s.name, s.unit, s.description)).collect(),
            inputs: inputs.iter().map(|s| Item::new(&s.name, s.unit, s.description)).collect(),
            outputs: model.channels().iter().map(|c| Item::new(&c.name, c.unit, c.description)).collect(),
            contacts: plain(model.contact_names()),
            bodies: plain(model.body_names()),
            quantities: model
                .contact_quantities()
                .iter()
                .map(|q| Item::new(q.name, q.unit, q.description))
                .collect(),
            line_load_quantities: LINE_LOAD_QUANTITIES
                .iter()
                .map(|q| Item::new(q.name, q.unit, q.description))
                .collect(),
            sources: FORCE_SOURCES.iter().map(|s| Item::new(s, "", "")).collect(),
            components: model
                .force_components()
                .iter()
                .map(|q| Item::new(q.name, q.unit, q.description))
                .collect(),
            geometry: geometry.iter().map(|(q, _)| Item::new(q.name, q.unit, q.description)).collect(),
            geometry_values: geometry.iter().map(|(_, value)| *value).collect(),
            warnings: plain(model.scene().warnings()),
            pattern: OnceLock::new(),
            feedthrough: OnceLock::new(),
            model: Arc::new(model),
        }
    }
}

impl cagedyn_model {
    /// Pattern of its Jacobian.
    pub(super) fn pattern(&self) -> &SparsePattern {
        self.pattern.get_or_init(|| self.model.jacobian_pattern())
    }

    /// Pattern of its direct feed-through.
    pub(super) fn feedthrough(&self) -> &SparsePattern {
        self.feedthrough.get_or_init(|| self.model.feedthrough_pattern())
    }
}

/// A handle, or NULL with the error stored.
fn create(build: impl FnOnce() -> Result<Model>) -> *mut cagedyn_model {
    guard(|_| std::ptr::null_mut(), || Ok(Box::into_raw(Box::new(cagedyn_model::new(build()?)))))
}

/// Length of one list of a model.
///
/// # Safety
/// `model` is NULL or a live handle.
pub(super) unsafe fn length(
    model: *const cagedyn_model,
    list: impl FnOnce(&cagedyn_model) -> &Vec<Item>,
) -> i64 {
    // SAFETY: see above.
    count(|| unsafe { shared("model", model) }.map(|m| list(m).len()))
}

/// One text of an item of a list, or "" with the error stored.
///
/// # Safety
/// `model` is NULL or a live handle.
pub(super) unsafe fn item(
    model: *const cagedyn_model,
    i: i64,
    list: impl FnOnce(&cagedyn_model) -> &Vec<Item>,
    field: impl FnOnce(&Item) -> &CString,
) -> *const c_char {
    guard(
        |_| EMPTY.as_ptr(),
        || {
            // SAFETY: see above.
            let items = list(unsafe { shared("model", model) }?);
            let i = index("index", i, items.len())?;
            Ok(field(&items[i]).as_ptr())
        },
    )
}

/// Index of the item of this name, or a negative status code.
///
/// # Safety
/// `model` is NULL or a live handle, `name` NULL or a NUL-terminated text.
pub(super) unsafe fn find(
    model: *const cagedyn_model,
    name: *const c_char,
    list: impl FnOnce(&cagedyn_model) -> &Vec<Item>,
) -> i64 {
    count(|| {
        // SAFETY: see above.
        let (items, name) = unsafe { (list(shared("model", model)?), text("name", name)?) };
        place_of(name, items.iter().map(|item| item.name.as_c_str()))
    })
}

/// Creates a model from the JSON text of a scene. Returns NULL on failure. Free it with cagedyn_model_free().
///
/// # Safety
/// `json` is NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_from_json(json: *const c_char) -> *mut cagedyn_model {
    // SAFETY: see above.
    create(|| Model::from_json(unsafe { text("json", json) }?))
}

/// Creates a model from the JSON text of a scene with some values replaced. `overrides` has one replacement per line,
/// "path=value", for example "inner_ring.speed.constant=-104.7"; the value null removes an optional block. Returns
/// NULL on failure.
///
/// # Safety
/// Both texts are NULL or NUL-terminated.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_from_json_with(
    json: *const c_char,
    overrides: *const c_char,
) -> *mut cagedyn_model {
    create(|| {
        // SAFETY: see above.
        let (json, overrides) = unsafe { (text("json", json)?, text("overrides", overrides)?) };
        let lines = overrides.lines().map(str::trim).filter(|line| !line.is_empty());
        let pairs: Vec<(&str, &str)> = lines
            .map(|line| {
                let pair = line.split_once('=').map(|(path, value)| (path.trim(), value.trim()));
                let text = format!("overrides: '{line}' is not of the form path=value");
                pair.ok_or_else(|| Error::new(Status::BadValue, text))
            })
            .collect::<Result<_>>()?;
        Model::new(Scene::from_json_with(json, pairs)?)
    })
}

/// Creates a model from a scene file. Returns NULL on failure.
///
/// # Safety
/// `path` is NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_from_file(path: *const c_char) -> *mut cagedyn_model {
    create(|| {
        // SAFETY: see above.
        let path = unsafe { text("path", path) }?;
        let json = std::fs::read_to_string(path)
            .map_err(|e| Error::new(Status::File, format!("path: cannot read '{path}': {e}")))?;
        Model::from_json(&json)
    })
}

/// Frees a model. Simulations made from it stay valid. NULL is ignored, and the stored error stays.
///
/// # Safety
/// `model` is NULL or a live handle; it must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_free(model: *mut cagedyn_model) {
    // SAFETY: see above.
    unsafe { free(model) }
}

/// JSON text of the scene the model was made from, replacements included. "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_scene_json(model: *const cagedyn_model) -> *const c_char {
    // SAFETY: see above.
    guard(|_| EMPTY.as_ptr(), || Ok(unsafe { shared("model", model) }?.scene.as_ptr()))
}

/// Number of values of the scene that are legal and unlikely. Negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_warning_count(model: *const cagedyn_model) -> i64 {
    // SAFETY: see above.
    unsafe { length(model, |m| &m.warnings) }
}

/// One of these, as one line: JSON path, value, why it is unlikely. "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_warning(model: *const cagedyn_model, index: i64) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.warnings, |item| &item.name) }
}

/// Number of positions: the first part of the state vector. Negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_position_count(model: *const cagedyn_model) -> i64 {
    // SAFETY: see above.
    count(|| Ok(unsafe { shared("model", model) }?.model.layout().positions()))
}

/// Number of velocities: the second part of the state vector. Negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_velocity_count(model: *const cagedyn_model) -> i64 {
    // SAFETY: see above.
    count(|| Ok(unsafe { shared("model", model) }?.model.layout().velocities()))
}

/// Number of states. Negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_state_count(model: *const cagedyn_model) -> i64 {
    // SAFETY: see above.
    unsafe { length(model, |m| &m.states) }
}

/// Name of a state; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_state_name(model: *const cagedyn_model, index: i64) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.states, |item| &item.name) }
}

/// SI unit ("1" for ratios) of a state; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_state_unit(model: *const cagedyn_model, index: i64) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.states, |item| &item.unit) }
}

/// Meaning of a state; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_state_description(
    model: *const cagedyn_model,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.states, |item| &item.description) }
}

/// Index of the state of this name; CAGEDYN_ERR_UNKNOWN_NAME or another negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle, `name` NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_find_state(model: *const cagedyn_model, name: *const c_char) -> i64 {
    // SAFETY: see above.
    unsafe { find(model, name, |m| &m.states) }
}

/// Number of inputs. Negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_input_count(model: *const cagedyn_model) -> i64 {
    // SAFETY: see above.
    unsafe { length(model, |m| &m.inputs) }
}

/// Name of an input; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_input_name(model: *const cagedyn_model, index: i64) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.inputs, |item| &item.name) }
}

/// SI unit ("1" for ratios) of an input; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_input_unit(model: *const cagedyn_model, index: i64) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.inputs, |item| &item.unit) }
}

/// Meaning of an input; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_input_description(
    model: *const cagedyn_model,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.inputs, |item| &item.description) }
}

/// Index of the input of this name; CAGEDYN_ERR_UNKNOWN_NAME or another negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle, `name` NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_find_input(model: *const cagedyn_model, name: *const c_char) -> i64 {
    // SAFETY: see above.
    unsafe { find(model, name, |m| &m.inputs) }
}

/// Number of outputs. Negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_output_count(model: *const cagedyn_model) -> i64 {
    // SAFETY: see above.
    unsafe { length(model, |m| &m.outputs) }
}

/// Name of an output; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_output_name(model: *const cagedyn_model, index: i64) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.outputs, |item| &item.name) }
}

/// SI unit ("1" for ratios) of an output; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_output_unit(model: *const cagedyn_model, index: i64) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.outputs, |item| &item.unit) }
}

/// Meaning of an output; "" on failure. Lives as long as the model.
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_output_description(
    model: *const cagedyn_model,
    index: i64,
) -> *const c_char {
    // SAFETY: see above.
    unsafe { item(model, index, |m| &m.outputs, |item| &item.description) }
}

/// Index of the output of this name; CAGEDYN_ERR_UNKNOWN_NAME or another negative status code on failure.
///
/// # Safety
/// `model` is NULL or a live handle, `name` NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_model_find_output(model: *const cagedyn_model, name: *const c_char) -> i64 {
    // SAFETY: see above.
    unsafe { find(model, name, |m| &m.outputs) }
}
