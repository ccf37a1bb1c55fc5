//! Counts, numbers of health and reports of simulations in C.

use super::guard::{
    EMPTY, check_array, exclusive, find_static, guard, static_name, status, to_c_string, write_array,
};
use super::sim::cagedyn_sim;
use crate::model::{LAWS, Law, POWERS, Power};
use crate::sim::{BALANCE_ITEMS, BalanceItem, STATISTICS, Statistic};
use libc::c_char;

/// Number of statistics.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_statistic_count() -> i64 {
    STATISTICS.len() as i64
}

/// Name of a statistic. "" for other numbers. Static text.
///
/// - steps, rejected_steps (by the error estimate), failed_steps (forces undefined), evaluations (of all forces),
///   events: counts.
/// - smallest_step, largest_step: s.
/// - raceway_vibration_rms: root mean square approach speed of the loaded raceway contacts, m/s.
/// - leapfrog_steps, dormand_prince_steps, rosenbrock_steps, radau_steps, method_changes (of method or leapfrog step): what
///   the method "auto" did; zero with other methods.
/// - highest_frequency (rad/s): what "auto" measured while it made leapfrog steps.
/// - failed_...: failed_steps by cause.
/// - jacobians: derivatives of all forces; undone_steps: steps that "auto" took back because they missed energy.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_statistic_name(index: i64) -> *const c_char {
    static_name(&Statistic::C_NAMES, index)
}

/// Index of the statistic of this name; CAGEDYN_ERR_UNKNOWN_NAME or another negative status code on failure.
///
/// # Safety
/// `name` is NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_find_statistic(name: *const c_char) -> i64 {
    // SAFETY: see above.
    unsafe { find_static(&[&Statistic::C_NAMES], name) }
}

/// Writes the statistics since creation or reset; a restored simulation goes on from the saved ones (length: statistic
/// count).
///
/// # Safety
/// `sim` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_statistics(sim: *const cagedyn_sim, out: *mut f64, length: i64) -> i32 {
    // SAFETY: see above.
    status(|| unsafe { write_array("out", &exclusive("sim", sim)?.sim.statistics().values(), out, length) })
}

/// Whether the run since the start of the scene or the last set state kept what its preset promises: CAGEDYN_OK, or
/// CAGEDYN_ERR_UNTRUSTED with the reasons in cagedyn_error_message(). Promised is that no more than 1 % (draft), 0.1 %
/// (engineering) or 0.01 % (reference) of the energy that passed through is missing, and that leapfrog steps that were asked
/// for are stable, and that no thermal factor of a raceway contact was ever at its floor. CAGEDYN_ERR_NOT_JUDGED where nothing
/// speaks against the run, but cagedyn_sim_set_state() moved it on the way to where its motion had not led: of that the balance
/// knows nothing. Costs a force evaluation.
///
/// # Safety
/// `sim` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_trust(sim: *mut cagedyn_sim) -> i32 {
    // SAFETY: see above.
    status(|| unsafe { exclusive("sim", sim) }?.sim.trust())
}

/// What the integration does and why, and what went wrong on the way, in one line for people: the method and the reason
/// it was chosen for, failed attempts with the contact or body that caused the last one, what speaks against trusting the
/// run. "" on failure. Lives until the next call for this simulation.
///
/// # Safety
/// `sim` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_report(sim: *mut cagedyn_sim) -> *const c_char {
    guard(
        |_| EMPTY.as_ptr(),
        || {
            // SAFETY: see above.
            let mut s = unsafe { exclusive("sim", sim) }?;
            s.report = to_c_string(&s.sim.report());
            Ok(s.report.as_ptr())
        },
    )
}

/// Number of force laws whose evaluations are counted.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_law_count() -> i64 {
    LAWS.len() as i64
}

/// Name of a force law, for example "guide_film"; "" for other numbers. Static text.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_law_name(index: i64) -> *const c_char {
    static_name(&Law::C_NAMES, index)
}

/// Index of the force law of this name; CAGEDYN_ERR_UNKNOWN_NAME or another negative status code on failure.
///
/// # Safety
/// `name` is NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_find_law(name: *const c_char) -> i64 {
    // SAFETY: see above.
    unsafe { find_static(&[&Law::C_NAMES], name) }
}

/// Writes how often each force law was evaluated, once per contact, by the integration since creation or reset (length:
/// law count). Laws that the scene does not use stay at zero.
///
/// # Safety
/// `sim` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_law_evaluations(
    sim: *const cagedyn_sim,
    out: *mut f64,
    length: i64,
) -> i32 {
    status(|| {
        // SAFETY: see above.
        let counts = unsafe { exclusive("sim", sim) }?.sim.statistics().laws.map(|n| n as f64);
        // SAFETY: see above.
        unsafe { write_array("out", &counts, out, length) }
    })
}

/// Number of items of a power balance.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_balance_count() -> i64 {
    (POWERS.len() + BALANCE_ITEMS.len()) as i64
}

/// Name of an item of a power balance; "" for other numbers. Static text.
///
/// - loads (and unbalance), ring_drive (what turns and moves the inner ring), outer_ring_drive, element_drive (of elements with prescribed motion),
///   ring_support, raceway_damping, raceway_friction, rolling_resistance, pocket_damping, pocket_friction, guide_film,
///   guide_solid: works in J, positive where they go into the bearing.
/// - kinetic_energy_gain, elastic_energy_gain, potential_energy_gain: what is stored, J.
/// - residual: works less gains, J, the error of the integration; relative_residual: as a share of the energy that passed
///   through.
/// - from, to: the time that the balance is over, s.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_balance_name(index: i64) -> *const c_char {
    let works = POWERS.len() as i64;
    if index < works {
        static_name(&Power::C_NAMES, index)
    } else {
        static_name(&BalanceItem::C_NAMES, index - works)
    }
}

/// Index of the item of a power balance of this name; CAGEDYN_ERR_UNKNOWN_NAME or another negative status code on failure.
///
/// # Safety
/// `name` is NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_find_balance(name: *const c_char) -> i64 {
    // SAFETY: see above.
    unsafe { find_static(&[&Power::C_NAMES, &BalanceItem::C_NAMES], name) }
}

/// Writes the power balance since the start of the scene or the last cagedyn_sim_set_state() that was not next to the state that
/// the simulation had (length: balance count).
///
/// # Safety
/// `sim` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_power_balance(sim: *mut cagedyn_sim, out: *mut f64, length: i64) -> i32 {
    status(|| {
        check_array("out", out.is_null(), length, POWERS.len() + BALANCE_ITEMS.len())?;
        // SAFETY: see above.
        let mut content = unsafe { exclusive("sim", sim) }?;
        let balance = content.sim.power_balance()?;
        let items = BalanceItem::ALL.map(|item| balance.value(item));
        let values: Vec<f64> = balance.work.into_iter().chain(items).collect();
        // SAFETY: see above.
        unsafe { write_array("out", &values, out, length) }
    })
}
