//! Random calls of the C ABI with whatever a host may get wrong: NULL, wrong lengths, indices out of range, numbers that are
//! none. Nothing crashes, a failure leaves outputs as they were and has a message, and every object stays usable.
//! `CAGEDYN_CALLS` sets another number of calls.
#![allow(unsafe_code)]

mod models;
mod sims;
mod steady;

use cagedyn::capi::batch::*;
use cagedyn::capi::forces::*;
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
use std::ffi::{CStr, CString};
use std::ptr::{null, null_mut};

const CALLS: u64 = 100_000;
/// Numbers in a buffer, more than any call writes.
const ROOM: usize = 1 << 15;
/// What is in a buffer that nothing was written to.
const UNTOUCHED: f64 = -1.2345e67;
/// Wall time of one call that advances, s.
const PATIENCE: f64 = 2e-3;

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
