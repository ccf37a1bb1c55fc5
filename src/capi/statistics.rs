//! Counts, numbers of health and reports of simulations in C.

use super::guard::{EMPTY, check_array, exclusive, guard, shared, status, to_c_string, write_array};
use super::sim::cagedyn_sim;
use crate::model::{LAWS, POWERS};
use crate::sim::STATISTICS;
use std::ffi::{CStr, c_char};

/// Names of [`STATISTICS`], NUL-terminated.
const STATISTIC_NAMES: [&CStr; STATISTICS.len()] = [
    c"steps",
    c"rejected_steps",
    c"failed_steps",
    c"evaluations",
    c"events",
    c"smallest_step",
    c"largest_step",
    c"raceway_vibration_rms",
    c"leapfrog_steps",
    c"dormand_prince_steps",
    c"rosenbrock_steps",
    c"method_changes",
    c"highest_frequency",
    c"failed_no_guide_film",
    c"failed_no_viscosity",
    c"failed_lost_roller",
    c"failed_lost_ring",
    c"failed_lost_cage",
    c"failed_not_finite",
    c"failed_no_slope",
    c"jacobians",
    c"undone_steps",
    c"failed_out_of_pocket",
];

/// Names of [`LAWS`], NUL-terminated.
const LAW_NAMES: [&CStr; LAWS.len()] = [
    c"outer_raceway",
    c"inner_raceway",
    c"pocket_wall",
    c"pocket_edge",
    c"pocket_plane",
    c"film_thickness",
    c"traction",
    c"self_heating",
    c"lubrication_regime",
    c"rolling_resistance",
    c"guide_film",
    c"guide_solid",
    c"viscosity_temperature",
];

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
/// - leapfrog_steps, dormand_prince_steps, rosenbrock_steps, method_changes (of method or leapfrog step): what the
///   method "auto" did; zero with other methods.
/// - highest_frequency (rad/s): what "auto" measured while it made leapfrog steps.
/// - failed_...: failed_steps by cause.
/// - jacobians: derivatives of all forces; undone_steps: steps that "auto" took back because they missed energy.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_statistic_name(index: i64) -> *const c_char {
    let name = usize::try_from(index).ok().and_then(|i| STATISTIC_NAMES.get(i));
    name.map_or(EMPTY, |name| name).as_ptr()
}

/// Writes the statistics since creation or reset; a restored simulation goes on from the saved ones (length: statistic
/// count).
///
/// # Safety
/// `sim` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_statistics(sim: *const cagedyn_sim, out: *mut f64, length: i64) -> i32 {
    // SAFETY: see above.
    status(|| unsafe { write_array("out", &shared("sim", sim)?.sim.statistics().values(), out, length) })
}

/// Whether the run since the start of the scene or the last set state kept what its preset promises: CAGEDYN_OK, or
/// CAGEDYN_ERR_UNTRUSTED with the reasons in cagedyn_error_message(). Promised is that no more than 1 % (draft), 0.1 %
/// (engineering) or 0.01 % (reference) of the energy that passed through is missing, and that leapfrog steps that were asked
/// for are stable, and that no thermal factor of a raceway contact was ever at its floor. Costs a force evaluation.
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
            let s = unsafe { exclusive("sim", sim) }?;
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
    usize::try_from(index).ok().and_then(|i| LAW_NAMES.get(i)).map_or(EMPTY, |name| name).as_ptr()
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
        let counts = unsafe { shared("sim", sim) }?.sim.statistics().laws.map(|n| n as f64);
        // SAFETY: see above.
        unsafe { write_array("out", &counts, out, length) }
    })
}

/// Names of the power balance: of [`POWERS`], then of the energies and what follows from them. NUL-terminated.
const BALANCE_NAMES: [&CStr; POWERS.len() + 7] = [
    c"loads",
    c"ring_drive",
    c"element_drive",
    c"ring_support",
    c"raceway_damping",
    c"raceway_friction",
    c"rolling_resistance",
    c"pocket_damping",
    c"pocket_friction",
    c"guide_film",
    c"guide_solid",
    c"kinetic_energy_gain",
    c"elastic_energy_gain",
    c"potential_energy_gain",
    c"residual",
    c"relative_residual",
    c"from",
    c"to",
];

/// Number of items of a power balance.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_balance_count() -> i64 {
    BALANCE_NAMES.len() as i64
}

/// Name of an item of a power balance; "" for other numbers. Static text.
///
/// - loads, ring_drive, element_drive (of elements with prescribed motion), ring_support, raceway_damping,
///   raceway_friction, rolling_resistance, pocket_damping, pocket_friction, guide_film, guide_solid: works in J, positive
///   where they go into the bearing.
/// - kinetic_energy_gain, elastic_energy_gain, potential_energy_gain: what is stored, J.
/// - residual: works less gains, J, the error of the integration; relative_residual: as a share of the energy that passed
///   through.
/// - from, to: the time that the balance is over, s.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_balance_name(index: i64) -> *const c_char {
    let name = usize::try_from(index).ok().and_then(|i| BALANCE_NAMES.get(i));
    name.map_or(EMPTY, |name| name).as_ptr()
}

/// Writes the power balance since the start of the scene or the last cagedyn_sim_set_state() (length: balance count).
///
/// # Safety
/// `sim` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_sim_power_balance(sim: *mut cagedyn_sim, out: *mut f64, length: i64) -> i32 {
    status(|| {
        check_array("out", out.is_null(), length, BALANCE_NAMES.len())?;
        // SAFETY: see above.
        let balance = unsafe { exclusive("sim", sim) }?.sim.power_balance()?;
        let mut values = [0.0; BALANCE_NAMES.len()];
        let (works, rest) = values.split_at_mut(POWERS.len());
        works.copy_from_slice(&balance.work);
        rest[..3].copy_from_slice(&balance.gain());
        let residuals = [balance.residual(), balance.relative_residual()];
        rest[3..].copy_from_slice(&[residuals[0], residuals[1], balance.from, balance.to]);
        // SAFETY: see above.
        unsafe { write_array("out", &values, out, length) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn law_names_match_the_library() {
        assert_eq!(LAW_NAMES.map(|name| name.to_str().unwrap_or("")), LAWS);
    }

    #[test]
    fn names_of_the_balance_match_the_library() {
        let names = BALANCE_NAMES.map(|name| name.to_str().unwrap_or(""));
        assert_eq!(names[..POWERS.len()], POWERS);
    }

    #[test]
    fn statistic_names_match_the_library() {
        assert_eq!(STATISTIC_NAMES.map(|name| name.to_str().unwrap_or("")), STATISTICS);
    }
}
