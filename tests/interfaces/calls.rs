//! Random calls of the C ABI with whatever a host may get wrong: NULL, wrong lengths, indices out of range, numbers that are
//! none. Nothing crashes, a failure leaves outputs as they were and has a message, and every object stays usable.
//! `CAGEDYN_CALLS` sets another number of calls.
#![allow(unsafe_code)]

mod steady;

use cagedyn::capi::batch::*;
use cagedyn::capi::forces::*;
use cagedyn::capi::geometry::*;
use cagedyn::capi::heat::*;
use cagedyn::capi::integrator::*;
use cagedyn::capi::interval::*;
use cagedyn::capi::limits::*;
use cagedyn::capi::line_loads::*;
use cagedyn::capi::model::*;
use cagedyn::capi::sim::*;
use cagedyn::capi::statistics::*;
use cagedyn::capi::whirl::*;
use cagedyn::capi::*;
use fastrand::Rng;
use std::ffi::{CStr, CString, c_char};
use std::ptr::{null, null_mut};

const CALLS: u64 = 100_000;
/// Numbers in a buffer, more than any call writes.
const ROOM: usize = 1 << 15;
/// What is in a buffer that nothing was written to.
const UNTOUCHED: f64 = -1.2345e67;
/// Wall time of one call that advances, s.
const PATIENCE: f64 = 2e-3;

type Texts = unsafe extern "C" fn(*const cagedyn_model, i64) -> *const c_char;
type Counts = unsafe extern "C" fn(*const cagedyn_model) -> i64;
type Finds = unsafe extern "C" fn(*const cagedyn_model, *const c_char) -> i64;
type Writes = unsafe extern "C" fn(*mut cagedyn_sim, *mut f64, i64) -> i32;
type Reads = unsafe extern "C" fn(*const cagedyn_sim, *mut f64, i64) -> i32;
type Anywhere = unsafe extern "C" fn(*mut cagedyn_sim, f64, *const f64, i64, *mut f64, i64) -> i32;
type Names = unsafe extern "C" fn(*const c_char) -> i64;
type Rates = unsafe extern "C" fn(*mut cagedyn_sim, f64, *const f64, *mut f64, i64) -> i32;

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

const WRITES: [(Writes, usize); 6] = [
    (cagedyn_sim_accelerations, VELOCITIES),
    (cagedyn_sim_contact_forces, CONTACTS),
    (cagedyn_sim_body_forces, BODIES),
    (cagedyn_sim_get_outputs, OUTPUTS),
    (cagedyn_sim_power_balance, BALANCE),
    (cagedyn_sim_solve, STATES),
];
const READS: [(Reads, usize); 4] = [
    (cagedyn_sim_get_state, STATES),
    (cagedyn_sim_save, SAVE),
    (cagedyn_sim_statistics, STATISTICS),
    (cagedyn_sim_law_evaluations, LAWS),
];
const ANYWHERE: [(Anywhere, usize); 7] = [
    (cagedyn_sim_contact_forces_at, CONTACTS),
    (cagedyn_sim_body_forces_at, BODIES),
    (cagedyn_sim_outputs_at, OUTPUTS),
    (cagedyn_sim_energies_at, ENERGIES),
    (cagedyn_sim_jacobian, JACOBIAN),
    (cagedyn_sim_sparse_jacobian, SPARSE),
    (cagedyn_sim_input_jacobian, INPUT_JACOBIAN),
];
const RATES: [Rates; 2] = [cagedyn_sim_derivative, cagedyn_sim_time_derivative];

// Lengths of the arrays of a simulation.
const STATES: usize = 0;
const VELOCITIES: usize = 1;
const CONTACTS: usize = 2;
const BODIES: usize = 3;
const OUTPUTS: usize = 4;
const BALANCE: usize = 5;
const SAVE: usize = 6;
const STATISTICS: usize = 7;
const LAWS: usize = 8;
const ENERGIES: usize = 9;
const JACOBIAN: usize = 10;
const SPARSE: usize = 11;
/// Number of contacts, and of what is known of a place along one.
const CONTACT: usize = 12;
const LINE_LOAD: usize = 13;
const INPUT_JACOBIAN: usize = 14;

/// A simulation with the lengths of its arrays.
#[derive(Clone, Copy)]
struct Owned {
    sim: *mut cagedyn_sim,
    lengths: [i64; 15],
}

/// What a careless host has.
struct Host {
    rng: Rng,
    models: Vec<*mut cagedyn_model>,
    sims: Vec<Owned>,
    batch: *mut cagedyn_batch,
    in_batch: usize,
    monitor: *mut cagedyn_monitor,
    whirl: *mut cagedyn_whirl,
    heat: *mut cagedyn_heat,
    buffer: Vec<f64>,
    failures: u64,
}

impl Host {
    fn new(seed: u64) -> Self {
        let scenes = [
            include_str!("../../scenes/nu2310_space.json").to_owned(),
            include_str!("../../scenes/nu2310.json").to_owned(),
            include_str!("../../scenes/grease_guide.json").to_owned(),
            include_str!("../../scenes/grease_guide_heat.json").to_owned(),
        ];
        let [in_space, rollers, balls, warm] = scenes.map(|text| {
            let text = CString::new(text).expect("no NUL");
            // SAFETY: a text.
            unsafe {
                cagedyn_model_from_json_with(text.as_ptr(), c"record.extremes=[\"guide.moment\"]".as_ptr())
            }
        });
        let models = [rollers, balls, in_space];
        assert!(models.iter().chain([&warm]).all(|model| !model.is_null()));
        let batch = cagedyn_batch_new();
        // SAFETY: a live handle.
        let (monitor, whirl) = unsafe { (cagedyn_monitor_new(batch), cagedyn_whirl_steady(models[1])) };
        assert!(!whirl.is_null());
        // SAFETY: a live handle, freed once.
        let heat = unsafe {
            let heat = cagedyn_heat_new(warm);
            cagedyn_model_free(warm);
            heat
        };
        assert!(!heat.is_null());
        Self {
            rng: Rng::with_seed(seed),
            models: models.to_vec(),
            sims: Vec::new(),
            batch,
            in_batch: 0,
            monitor,
            whirl,
            heat,
            buffer: vec![UNTOUCHED; ROOM],
            failures: 0,
        }
    }

    fn one_of(&mut self, n: u32) -> bool {
        self.rng.u32(0..n) == 0
    }

    fn number(&mut self) -> f64 {
        let odd = [0.0, -0.0, 1.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, 1e-300, 1e5];
        if self.one_of(3) { odd[self.rng.usize(0..odd.len())] } else { 1e-4 * self.rng.f64() }
    }

    fn index(&mut self, count: i64) -> i64 {
        let odd = [-1, count, i64::MIN, i64::MAX];
        if self.one_of(4) { odd[self.rng.usize(0..odd.len())] } else { self.rng.i64(0..count.max(1)) }
    }

    fn length(&mut self, right: i64) -> i64 {
        let odd = [right - 1, right + 1, 0, -1, i64::MIN, i64::MAX];
        if self.one_of(5) { odd[self.rng.usize(0..odd.len())] } else { right }
    }

    /// A place to write to, or NULL.
    fn out(&mut self) -> *mut f64 {
        if self.one_of(12) { null_mut() } else { self.buffer.as_mut_ptr() }
    }

    fn model(&mut self) -> *mut cagedyn_model {
        if self.one_of(12) { null_mut() } else { self.models[self.rng.usize(0..self.models.len())] }
    }

    fn sim(&mut self) -> Owned {
        if self.sims.is_empty() {
            self.add_sim();
        }
        let sim = self.sims[self.rng.usize(0..self.sims.len())];
        if self.one_of(15) { Owned { sim: null_mut(), ..sim } } else { sim }
    }

    /// A state like that of a simulation, now and then with something wrong in it; and its length.
    fn state(&mut self, of: Owned) -> (Vec<f64>, i64) {
        let n = of.lengths[STATES];
        let mut state = vec![0.0; n as usize];
        if !of.sim.is_null() {
            // SAFETY: a live handle and an array of this length.
            unsafe { cagedyn_sim_get_state(of.sim, state.as_mut_ptr(), n) };
        }
        if self.one_of(4) {
            let place = self.rng.usize(0..state.len());
            state[place] = self.number();
        }
        (state, self.length(n))
    }

    fn add_sim(&mut self) {
        let model = self.models[self.rng.usize(0..self.models.len())];
        // SAFETY: live handles.
        unsafe {
            let preset = self.rng.i32(-1..4);
            let sim =
                if preset == 3 { cagedyn_sim_new(model) } else { cagedyn_sim_new_with_preset(model, preset) };
            if sim.is_null() {
                assert_eq!(preset, -1);
                return self.add_sim();
            }
            let states = cagedyn_model_state_count(model);
            let bodies = cagedyn_model_body_count(model) * cagedyn_model_force_source_count(model);
            let lengths = [
                states,
                cagedyn_model_velocity_count(model),
                cagedyn_model_contact_count(model) * cagedyn_model_contact_quantity_count(model),
                bodies * cagedyn_model_force_component_count(model),
                cagedyn_model_output_count(model),
                cagedyn_balance_count(),
                cagedyn_sim_save_length(sim),
                cagedyn_statistic_count(),
                cagedyn_law_count(),
                cagedyn_energy_count(),
                states * states,
                cagedyn_model_jacobian_entry_count(model),
                cagedyn_model_contact_count(model),
                cagedyn_model_line_load_quantity_count(model),
                states * cagedyn_model_input_count(model),
            ];
            assert!(lengths.iter().all(|n| *n > 0 && *n < ROOM as i64));
            self.sims.push(Owned { sim, lengths });
        }
    }

    /// A text as hosts have them, good or not.
    fn text(&mut self) -> Option<CString> {
        let texts: [&[u8]; 9] = [
            b"cage.y",
            b"",
            b"{}",
            b"inner_ring.speed.constant=-50",
            b"rollers.count=6\ncage.guide=null",
            b"no such name",
            b"\xff\xfe",
            b"a=b=c\n=\n\n",
            b"[[[[",
        ];
        let text = texts[self.rng.usize(0..texts.len())];
        if self.one_of(10) { None } else { CString::new(text).ok() }
    }

    /// What a call returned is what the library says of it, and a failure has written nothing.
    fn check(&mut self, what: &str, status: i64) {
        // SAFETY: the message lives until the next call.
        let message = unsafe { CStr::from_ptr(cagedyn_error_message()) };
        let failed = status < 0;
        assert_eq!(failed, cagedyn_error_status() != CAGEDYN_OK, "{what} {status} {message:?}");
        assert_eq!(failed, !message.is_empty(), "{what} {status}");
        assert!(!failed || i64::from(cagedyn_error_status()) == status, "{what} {status}");
        assert_ne!(status, i64::from(CAGEDYN_ERR_INTERNAL), "{what}: {message:?}");
        if failed {
            self.failures += 1;
            // NaN is no written number either, but nothing was there before.
            let first = self.buffer[..64].iter().chain(&self.buffer[ROOM - 64..]);
            assert!(first.into_iter().all(|x| x.to_bits() == UNTOUCHED.to_bits()), "{what} wrote and failed");
        }
        if self.buffer[0].to_bits() != UNTOUCHED.to_bits() || !failed {
            self.buffer.fill(UNTOUCHED);
        }
    }

    fn about_models(&mut self) {
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
                    let json = include_str!("../../scenes/nu2310.json");
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

    fn about_sims(&mut self) {
        let s = self.sim();
        let (t, out) = (self.number(), self.out());
        // SAFETY: as above; lengths that are right are those of the arrays.
        unsafe {
            match self.rng.u32(0..16) {
                0 => {
                    let (call, k) = WRITES[self.rng.usize(0..WRITES.len())];
                    let n = self.length(s.lengths[k]);
                    if !out.is_null() && k == STATES {
                        self.buffer.fill(UNTOUCHED);
                    }
                    let status = call(s.sim, out, n);
                    self.check("write", status.into());
                }
                1 => {
                    let (call, k) = READS[self.rng.usize(0..READS.len())];
                    let n = self.length(s.lengths[k]);
                    let status = call(s.sim, out, n);
                    self.check("read", status.into());
                }
                2 | 3 => {
                    let (call, k) = ANYWHERE[self.rng.usize(0..ANYWHERE.len())];
                    let ((state, a), b) = (self.state(s), self.length(s.lengths[k]));
                    let from = if self.one_of(12) { null() } else { state.as_ptr() };
                    let status = call(s.sim, t, from, a, out, b);
                    self.check("anywhere", status.into());
                }
                4 => {
                    let call = RATES[self.rng.usize(0..RATES.len())];
                    let (state, n) = self.state(s);
                    let status = call(s.sim, t, state.as_ptr(), out, n);
                    self.check("rate", status.into());
                }
                5 => {
                    let (state, n) = self.state(s);
                    let status = match self.rng.u32(0..3) {
                        0 => cagedyn_sim_set_state(s.sim, t, state.as_ptr(), n),
                        1 => cagedyn_sim_linearize(s.sim, t, state.as_ptr(), n),
                        _ => cagedyn_sim_factorize(s.sim, t),
                    };
                    self.check("state", status.into());
                }
                6 | 7 => {
                    let _ = cagedyn_sim_set_wall_time_limit(s.sim, PATIENCE);
                    let mut now = 0.0;
                    let _ = cagedyn_sim_time(s.sim, &mut now);
                    let step = self.one_of(2);
                    let status = if step {
                        cagedyn_sim_step(s.sim, t)
                    } else {
                        cagedyn_sim_advance_to(s.sim, now + t)
                    };
                    self.check("advance", status.into());
                }
                8 => {
                    let (input, value) = (self.index(3), self.number());
                    let status = match self.rng.u32(0..4) {
                        0 => cagedyn_sim_set_input(s.sim, input, value),
                        1 => cagedyn_sim_get_input(s.sim, input, out),
                        2 => cagedyn_sim_set_input_slope(s.sim, input, value, self.number()),
                        _ => cagedyn_sim_release_input(s.sim, input),
                    };
                    self.check("input", status.into());
                }
                9 => {
                    let output = self.index(s.lengths[OUTPUTS]);
                    let n = self.length(cagedyn_interval_count());
                    let status = match self.rng.u32(0..3) {
                        0 => cagedyn_sim_get_output(s.sim, output, out),
                        1 => cagedyn_sim_begin_interval(s.sim),
                        _ => cagedyn_sim_get_interval(s.sim, output, out, n),
                    };
                    self.check("output", status.into());
                }
                10 => {
                    let n = s.lengths[SAVE];
                    let mut saved = vec![0.0; n as usize];
                    let _ = cagedyn_sim_save(s.sim, saved.as_mut_ptr(), n);
                    for _ in 0..self.rng.usize(0..3) {
                        let place = self.rng.usize(0..saved.len());
                        saved[place] = self.number();
                    }
                    let length = self.length(n);
                    let status = cagedyn_sim_restore(s.sim, saved.as_ptr(), length);
                    self.check("restore", status.into());
                }
                11 => {
                    let status = cagedyn_sim_trust(s.sim);
                    self.check("trust", status.into());
                    assert!(!cagedyn_sim_report(s.sim).is_null());
                }
                12 => {
                    let canceller = cagedyn_canceller_new(s.sim);
                    let status = cagedyn_canceller_cancel(canceller);
                    self.check("cancel", status.into());
                    cagedyn_canceller_free(canceller);
                }
                13 => {
                    let contact = self.index(s.lengths[CONTACT]);
                    let rows = cagedyn_sim_line_load_count(s.sim, contact);
                    self.check("line load count", rows);
                    let n = self.length(rows.max(0) * s.lengths[LINE_LOAD]);
                    let status = cagedyn_sim_line_loads(s.sim, contact, out, n);
                    self.check("line loads", status.into());
                }
                14 => {
                    let status = if self.one_of(3) {
                        cagedyn_sim_reset(s.sim)
                    } else {
                        cagedyn_sim_set_wall_time_limit(s.sim, t)
                    };
                    self.check("reset", status.into());
                }
                _ => {
                    if self.sims.len() < 4 {
                        self.add_sim();
                    } else if self.one_of(20) {
                        let gone = self.sims.swap_remove(self.rng.usize(0..self.sims.len()));
                        cagedyn_sim_free(gone.sim);
                    }
                }
            }
        }
    }

    fn about_batches(&mut self) {
        let batch = if self.one_of(10) { null_mut() } else { self.batch };
        let monitor = if self.one_of(10) { null_mut() } else { self.monitor };
        let place = self.index(self.in_batch as i64);
        // SAFETY: as above.
        unsafe {
            match self.rng.u32(0..7) {
                0 if self.in_batch < 3 => {
                    let s = self.sim();
                    let added = cagedyn_batch_add(batch, s.sim);
                    self.check("add", added);
                    if added >= 0 {
                        self.in_batch += 1;
                        self.sims.retain(|owned| owned.sim != s.sim);
                    }
                }
                1 => {
                    let mut furthest = 0.0f64;
                    for k in 0..self.in_batch {
                        let (sim, mut time) = (cagedyn_batch_sim(self.batch, k as i64), 0.0);
                        let _ = cagedyn_sim_set_wall_time_limit(sim, PATIENCE);
                        let _ = cagedyn_sim_time(sim, &mut time);
                        furthest = furthest.max(time);
                    }
                    let (t, threads) = (furthest + self.number(), self.index(4));
                    let threads = if threads == i64::MAX { 1 } else { threads };
                    let status = cagedyn_batch_advance_to(batch, t, threads);
                    self.check("batch", status.into());
                }
                2 => {
                    let sim = cagedyn_batch_sim(batch, place);
                    cagedyn_sim_free(sim);
                    let _ = cagedyn_batch_status(batch, place);
                    assert!(!cagedyn_batch_message(batch, place).is_null());
                }
                3 => {
                    let count = cagedyn_batch_count(batch);
                    self.check("count", count);
                }
                4 => {
                    let (out, n) = (self.out(), self.length(cagedyn_progress_count()));
                    let status = cagedyn_monitor_progress(monitor, out, n);
                    self.check("progress", status.into());
                }
                5 => {
                    let status = cagedyn_monitor_cancel(monitor);
                    self.check("cancel", status.into());
                }
                _ => {
                    let index = self.index(20);
                    for name in [
                        cagedyn_progress_name(index),
                        cagedyn_energy_name(index),
                        cagedyn_interval_name(index),
                        cagedyn_law_name(index),
                        cagedyn_statistic_name(index),
                        cagedyn_balance_name(index),
                        cagedyn_status_name(index as i32),
                        cagedyn_version(),
                    ] {
                        assert!(!name.is_null());
                    }
                }
            }
        }
    }

    /// Every simulation can be reset and runs, and all is freed.
    fn finish(mut self) {
        // SAFETY: as above.
        unsafe {
            let of_batch = (0..self.in_batch).map(|k| cagedyn_batch_sim(self.batch, k as i64));
            let all: Vec<_> = self.sims.iter().map(|owned| owned.sim).chain(of_batch).collect();
            for sim in all {
                assert_eq!(cagedyn_sim_set_wall_time_limit(sim, f64::INFINITY), CAGEDYN_OK);
                assert_eq!(cagedyn_sim_reset(sim), CAGEDYN_OK);
                // A request that nobody has heard yet is heard now.
                let _ = cagedyn_sim_advance_to(sim, 1e-6);
                let status = cagedyn_sim_advance_to(sim, 1e-4);
                assert_eq!(status, CAGEDYN_OK, "{:?}", CStr::from_ptr(cagedyn_error_message()));
            }
            self.sims.drain(..).for_each(|owned| cagedyn_sim_free(owned.sim));
            cagedyn_batch_free(self.batch);
            cagedyn_monitor_free(self.monitor);
            cagedyn_whirl_free(self.whirl);
            assert_eq!(cagedyn_heat_step(self.heat, 1.0), CAGEDYN_OK);
            cagedyn_heat_free(self.heat);
            self.models.drain(..).for_each(|model| cagedyn_model_free(model));
        }
    }
}

#[test]
fn random_calls_crash_nothing_and_leave_everything_usable() {
    let calls = std::env::var("CAGEDYN_CALLS").ok().and_then(|n| n.parse().ok()).unwrap_or(CALLS);
    let mut failures = 0;
    for seed in 0..calls.div_ceil(CALLS) {
        let mut host = Host::new(seed);
        for _ in 0..calls.min(CALLS) {
            match host.rng.u32(0..20) {
                0..6 => host.about_models(),
                6..17 => host.about_sims(),
                17 if host.one_of(2) => host.about_heat(),
                17 => host.about_whirl(),
                _ => host.about_batches(),
            }
        }
        failures += host.failures;
        host.finish();
    }
    println!("{calls} calls, {failures} of them refused");
    assert!(failures > calls / 10 && failures < calls);
}
