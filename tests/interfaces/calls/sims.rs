//! Calls about simulations: states, values of any place, inputs, steps, intervals, what is kept and cancelled.

use super::*;

type Writes = unsafe extern "C" fn(*mut cagedyn_sim, *mut f64, i64) -> i32;
type Reads = unsafe extern "C" fn(*const cagedyn_sim, *mut f64, i64) -> i32;
type Anywhere = unsafe extern "C" fn(*mut cagedyn_sim, f64, *const f64, i64, *mut f64, i64) -> i32;
type Rates = unsafe extern "C" fn(*mut cagedyn_sim, f64, *const f64, *mut f64, i64) -> i32;

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

impl Host {
    pub(super) fn about_sims(&mut self) {
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
}
