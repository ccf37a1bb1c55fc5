//! Calls about models: their lists, names, numbers and patterns, and texts that models are made of.

use super::{Host, ROOM};
use cagedyn::capi::forces::*;
use cagedyn::capi::geometry::*;
use cagedyn::capi::integrator::*;
use cagedyn::capi::interval::*;
use cagedyn::capi::line_loads::*;
use cagedyn::capi::model::*;
use cagedyn::capi::statistics::*;
use cagedyn::capi::*;
use std::ffi::{CString, c_char};
use std::ptr::{null, null_mut};

type Texts = unsafe extern "C" fn(*const cagedyn_model, i64) -> *const c_char;
type Counts = unsafe extern "C" fn(*const cagedyn_model) -> i64;
type Finds = unsafe extern "C" fn(*const cagedyn_model, *const c_char) -> i64;
type Names = unsafe extern "C" fn(*const c_char) -> i64;

const TEXTS: [Texts; 26] = [
    cagedyn_model_state_name,
    cagedyn_model_state_unit,
    cagedyn_model_state_description,
    cagedyn_model_input_name,
    cagedyn_model_input_unit,
    cagedyn_model_input_description,
    cagedyn_model_output_name,
    cagedyn_model_output_unit,
    cagedyn_model_output_description,
    cagedyn_model_contact_name,
    cagedyn_model_contact_quantity_name,
    cagedyn_model_contact_quantity_unit,
    cagedyn_model_contact_quantity_description,
    cagedyn_model_line_load_quantity_name,
    cagedyn_model_line_load_quantity_unit,
    cagedyn_model_line_load_quantity_description,
    cagedyn_model_body_name,
    cagedyn_model_force_source_name,
    cagedyn_model_force_component_name,
    cagedyn_model_force_component_unit,
    cagedyn_model_force_component_description,
    cagedyn_model_geometry_name,
    cagedyn_model_geometry_unit,
    cagedyn_model_geometry_description,
    cagedyn_model_warning,
    scene_json,
];

unsafe extern "C" fn scene_json(model: *const cagedyn_model, _: i64) -> *const c_char {
    // SAFETY: as the caller's.
    unsafe { cagedyn_model_scene_json(model) }
}

const COUNTS: [Counts; 15] = [
    cagedyn_model_state_count,
    cagedyn_model_position_count,
    cagedyn_model_velocity_count,
    cagedyn_model_input_count,
    cagedyn_model_output_count,
    cagedyn_model_contact_count,
    cagedyn_model_contact_quantity_count,
    cagedyn_model_line_load_quantity_count,
    cagedyn_model_body_count,
    cagedyn_model_force_source_count,
    cagedyn_model_force_component_count,
    cagedyn_model_geometry_count,
    cagedyn_model_warning_count,
    cagedyn_model_watched_count,
    cagedyn_model_jacobian_entry_count,
];

const FINDS: [Finds; 10] = [
    cagedyn_model_find_state,
    cagedyn_model_find_input,
    cagedyn_model_find_output,
    cagedyn_model_find_contact,
    cagedyn_model_find_contact_quantity,
    cagedyn_model_find_line_load_quantity,
    cagedyn_model_find_body,
    cagedyn_model_find_force_source,
    cagedyn_model_find_force_component,
    cagedyn_model_find_geometry,
];

const NAMES: [Names; 3] = [cagedyn_find_statistic, cagedyn_find_law, cagedyn_find_balance];

impl Host {
    pub(super) fn about_models(&mut self) {
        let model = self.model();
        let places = self.index(50);
        let text = self.text();
        let text = text.as_ref().map_or(null(), |text| text.as_ptr());
        // SAFETY: live handles or NULL, texts that end with NUL or NULL, buffers as long as they say.
        unsafe {
            match self.rng.u32(0..8) {
                0..3 => {
                    let call = TEXTS[self.rng.usize(0..TEXTS.len())];
                    assert!(!call(model, places).is_null());
                }
                3 => {
                    let call = COUNTS[self.rng.usize(0..COUNTS.len())];
                    let count = call(model);
                    self.check("count", count);
                }
                4 => {
                    let found = if self.one_of(4) {
                        NAMES[self.rng.usize(0..NAMES.len())](text)
                    } else {
                        FINDS[self.rng.usize(0..FINDS.len())](model, text)
                    };
                    self.check("find", found);
                }
                5 => {
                    let out = self.out();
                    let status = cagedyn_model_get_geometry(model, places, out);
                    self.check("geometry", status.into());
                }
                6 => {
                    let states = cagedyn_model_state_count(model);
                    let entries = cagedyn_model_jacobian_entry_count(model);
                    let (mut starts, mut rows) = (vec![0i64; 500], vec![0i64; ROOM]);
                    assert!(states < 500 && entries < ROOM as i64);
                    let (a, b) = (self.length(states + 1), self.length(entries));
                    let rows = if self.one_of(10) { null_mut() } else { rows.as_mut_ptr() };
                    let status = cagedyn_model_jacobian_pattern(model, starts.as_mut_ptr(), a, rows, b);
                    self.check("pattern", status.into());
                    let inputs = cagedyn_model_input_count(model);
                    let entries = cagedyn_model_feedthrough_entry_count(model);
                    assert!(inputs < 500 && entries < ROOM as i64);
                    let (a, b) = (self.length(inputs + 1), self.length(entries));
                    let status = cagedyn_model_feedthrough_pattern(model, starts.as_mut_ptr(), a, rows, b);
                    self.check("feedthrough", status.into());
                }
                _ => {
                    let json = include_str!("../../../scenes/nu2310.json");
                    let json = CString::new(json).expect("no NUL");
                    let made = match self.rng.u32(0..20) {
                        0 => cagedyn_model_from_json_with(json.as_ptr(), text),
                        1 => cagedyn_model_from_file(text),
                        _ => cagedyn_model_from_json(text),
                    };
                    assert_eq!(made.is_null(), cagedyn_error_status() != CAGEDYN_OK);
                    cagedyn_model_free(made);
                    let _ = cagedyn_model_watched_output(model, places);
                }
            }
        }
    }
}
