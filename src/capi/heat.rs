//! Heat balance in C: temperatures of the lumps of a bearing, steady or over time.

use super::guard::{
    EMPTY, Exclusive, Handle, count, exclusive, free, guard, index, read_array, shared, static_name, status,
    to_c_string, write_array,
};
use super::limits::{cagedyn_watch, limits_of};
use super::model::cagedyn_model;
use crate::error::{Error, Result, Status};
use crate::heat::{HeatBalance, HeatState};
use crate::registry::registry;
use libc::c_char;
use std::ffi::CString;

/// The heat balance of a bearing whose scene has `heat`. May be used by one thread at a time; a second one gets CAGEDYN_ERR_BUSY.
#[allow(non_camel_case_types)]
pub struct cagedyn_heat {
    content: Exclusive<Balance>,
    /// Names of the lumps and of the powers that warm them.
    lumps: Vec<CString>,
    sources: Vec<CString>,
    /// Which lumps each link joins; -1 for the surroundings.
    links: Vec<[i64; 2]>,
}

impl Handle for cagedyn_heat {
    type Content = Balance;

    fn exclusive(&self) -> &Exclusive<Balance> {
        &self.content
    }
}

/// A heat balance.
pub struct Balance {
    heat: HeatBalance,
}

impl Balance {
    /// What its last burst of motion came to.
    fn last(&self) -> Result<&HeatState> {
        self.heat.last().ok_or_else(|| {
            let text = "heat: no motion has been run; cagedyn_heat_settle() or cagedyn_heat_step() does so";
            Error::new(Status::BadState, text.to_owned())
        })
    }
}

registry! {
    /// What is known of a heat balance beside temperatures and flows.
    enum Quantity,
    /// Names of what is known of a heat balance.
    const QUANTITIES {
        Viscosity = "viscosity",
        RadialClearance = "radial_clearance",
        WhirlSpeed = "whirl_speed",
        HeatOfBearing = "bearing_torque_heat",
        HeatInNoLump = "heat_in_no_lump",
        Carried = "carried",
        StandardError = "standard_error",
        Bursts = "bursts",
    }
}

fn quantities(state: &HeatState) -> [f64; QUANTITIES.len()] {
    [
        state.viscosity,
        state.clearance.unwrap_or(f64::NAN),
        state.whirl_speed,
        state.of_bearing,
        state.in_no_lump.iter().map(|(_, heat)| heat).sum(),
        state.carried,
        state.scatter,
        state.bursts as f64,
    ]
}

/// Runs `entry` on a heat balance.
///
/// # Safety
/// `heat` is NULL or a live handle.
unsafe fn with(heat: *const cagedyn_heat, entry: impl FnOnce(&mut Balance) -> Result<()>) -> i32 {
    // SAFETY: see above.
    status(|| entry(&mut *unsafe { exclusive("heat", heat) }?))
}

/// Moves temperatures within the limits of a watch.
///
/// # Safety
/// `heat` and `watch` are NULL or live handles.
unsafe fn watched(
    heat: *const cagedyn_heat,
    watch: *const cagedyn_watch,
    moves: impl FnOnce(&mut HeatBalance) -> Result<()>,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(heat, |balance| {
            balance.heat.set_limits(limits_of(watch));
            moves(&mut balance.heat)
        })
    }
}

/// Creates the heat balance of a model whose scene has `heat`, at the temperatures of the start. Returns NULL on failure, with the
/// reason in cagedyn_error_message(). Free it with cagedyn_heat_free().
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_new(model: *const cagedyn_model) -> *mut cagedyn_heat {
    guard(
        |_| std::ptr::null_mut(),
        || {
            // SAFETY: see above.
            let heat = HeatBalance::new(unsafe { shared("model", model) }?.model.clone())?;
            let lumps = heat.names().map(to_c_string).collect();
            let sources = heat.sources().map(to_c_string).collect();
            let place =
                |name: &str| heat.names().position(|lump| lump == name).map_or(-1, |place| place as i64);
            let links = heat.links().map(|ends| ends.map(place)).collect();
            let content = Exclusive::new(Balance { heat });
            Ok(Box::into_raw(Box::new(cagedyn_heat { content, lumps, sources, links })))
        },
    )
}

/// Frees a heat balance. NULL is ignored, and the stored error stays.
///
/// # Safety
/// `heat` is NULL or a live handle; it must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_free(heat: *mut cagedyn_heat) {
    // SAFETY: see above.
    unsafe { free(heat) }
}

/// Finds the temperatures at which the bearing stays, from up to 80 bursts of motion of 30 ms, with rolling elements of 100 ms. On
/// failure temperatures stay what they were.
///
/// # Safety
/// `heat` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_settle(heat: *mut cagedyn_heat) -> i32 {
    // SAFETY: see above.
    unsafe { cagedyn_heat_settle_with_watch(heat, std::ptr::null()) }
}

/// As cagedyn_heat_settle(), with a watch, by which it can be stopped; NULL for none. Temperatures are then those of the last whole burst,
/// of which the other calls tell, and another call goes on from there.
///
/// # Safety
/// `heat` and `watch` are NULL or live handles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_settle_with_watch(
    heat: *mut cagedyn_heat,
    watch: *const cagedyn_watch,
) -> i32 {
    // SAFETY: see above.
    unsafe { watched(heat, watch, |heat| heat.settle().map(|_| ())) }
}

/// Warms up for `duration` (s, from 1e-6 to 1e9) with the heat of one burst of motion: the longer, the more roughly. On failure
/// temperatures stay what they were.
///
/// # Safety
/// `heat` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_step(heat: *mut cagedyn_heat, duration: f64) -> i32 {
    // SAFETY: see above.
    unsafe { cagedyn_heat_step_with_watch(heat, duration, std::ptr::null()) }
}

/// As cagedyn_heat_step(), with a watch, by which it can be stopped; NULL for none. Temperatures then stay what they were, and the motion
/// goes on from where it is.
///
/// # Safety
/// `heat` and `watch` are NULL or live handles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_step_with_watch(
    heat: *mut cagedyn_heat,
    duration: f64,
    watch: *const cagedyn_watch,
) -> i32 {
    // SAFETY: see above.
    unsafe { watched(heat, watch, |heat| heat.step(duration).map(|_| ())) }
}

/// Number of lumps. Negative status code on failure.
///
/// # Safety
/// `heat` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_lump_count(heat: *const cagedyn_heat) -> i64 {
    // SAFETY: see above.
    count(|| Ok(unsafe { shared("heat", heat) }?.lumps.len()))
}

/// Name of a lump, as in the scene; "" on failure. Lives as long as the heat balance.
///
/// # Safety
/// `heat` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_lump_name(heat: *const cagedyn_heat, lump: i64) -> *const c_char {
    guard(
        |_| EMPTY.as_ptr(),
        || {
            // SAFETY: see above.
            let lumps = &unsafe { shared("heat", heat) }?.lumps;
            Ok(lumps[index("lump", lump, lumps.len())?].as_ptr())
        },
    )
}

/// Writes the temperatures of the lumps, K (length: lump count).
///
/// # Safety
/// `heat` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_temperatures(
    heat: *const cagedyn_heat,
    out: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe { with(heat, |balance| write_array("out", balance.heat.temperatures(), out, length)) }
}

/// Sets the temperatures of the lumps, K, from 150 to 1000 (length: lump count).
///
/// # Safety
/// `heat` is NULL or a live handle, `temperatures` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_set_temperatures(
    heat: *mut cagedyn_heat,
    temperatures: *const f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(heat, |balance| {
            let mut values = vec![0.0; balance.heat.temperatures().len()];
            read_array("temperatures", temperatures, length, &mut values)?;
            balance.heat.set_temperatures(&values)
        })
    }
}

/// Writes the heat that went into each lump in the last burst of motion, W (length: lump count).
///
/// # Safety
/// `heat` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_into_lumps(
    heat: *const cagedyn_heat,
    out: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe { with(heat, |balance| write_array("out", &balance.last()?.heat, out, length)) }
}

/// Number of links between lumps and surroundings. Negative status code on failure.
///
/// # Safety
/// `heat` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_link_count(heat: *const cagedyn_heat) -> i64 {
    // SAFETY: see above.
    count(|| Ok(unsafe { shared("heat", heat) }?.links.len()))
}

/// Writes which lumps a link joins to `lumps` (length: 2); -1 stands for the surroundings.
///
/// # Safety
/// `heat` is NULL or a live handle, `lumps` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_link(
    heat: *const cagedyn_heat,
    link: i64,
    lumps: *mut i64,
    length: i64,
) -> i32 {
    status(|| {
        // SAFETY: see above.
        let links = &unsafe { shared("heat", heat) }?.links;
        // SAFETY: see above.
        unsafe { write_array("lumps", &links[index("link", link, links.len())?], lumps, length) }
    })
}

/// Writes the heat that flows through each link after the last burst of motion, from its first lump to its second, W (length: link
/// count).
///
/// # Safety
/// `heat` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_flows(heat: *const cagedyn_heat, out: *mut f64, length: i64) -> i32 {
    // SAFETY: see above.
    unsafe { with(heat, |balance| write_array("out", &balance.last()?.flows, out, length)) }
}

/// Number of powers of the motion that warm lumps. Negative status code on failure.
///
/// # Safety
/// `heat` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_source_count(heat: *const cagedyn_heat) -> i64 {
    // SAFETY: see above.
    count(|| Ok(unsafe { shared("heat", heat) }?.sources.len()))
}

/// Name of such a power, as in the power balance; "" on failure. Lives as long as the heat balance.
///
/// # Safety
/// `heat` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_source_name(heat: *const cagedyn_heat, source: i64) -> *const c_char {
    guard(
        |_| EMPTY.as_ptr(),
        || {
            // SAFETY: see above.
            let sources = &unsafe { shared("heat", heat) }?.sources;
            Ok(sources[index("source", source, sources.len())?].as_ptr())
        },
    )
}

/// Writes the heat of each of these powers in the last burst of motion, W (length: source count).
///
/// # Safety
/// `heat` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_sources(heat: *const cagedyn_heat, out: *mut f64, length: i64) -> i32 {
    // SAFETY: see above.
    unsafe {
        with(heat, |balance| {
            let heat: Vec<f64> = balance.last()?.of_motion.iter().map(|(_, heat)| *heat).collect();
            write_array("out", &heat, out, length)
        })
    }
}

/// Number of numbers that cagedyn_heat_quantities() writes.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_heat_quantity_count() -> i64 {
    QUANTITIES.len() as i64
}

/// Name of one of these numbers; "" for others. Static text.
///
/// - viscosity: of the lubricant, Pa s; radial_clearance: of a roller bearing, m, else NaN.
/// - whirl_speed: mean of the last burst, rad/s; 0 where the cage does not go round.
/// - bearing_torque_heat: of the bearing by catalogue values, W; heat_in_no_lump: of powers that no source names, W.
/// - carried: heat that oil carries away which flows through lumps, W.
/// - standard_error: largest one of a temperature, K; 0 where powers do not scatter. bursts: that were run.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_heat_quantity_name(index: i64) -> *const c_char {
    static_name(&Quantity::C_NAMES, index)
}

/// Writes what else the last burst of motion came to (length: quantity count).
///
/// # Safety
/// `heat` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_heat_quantities(
    heat: *const cagedyn_heat,
    out: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    unsafe { with(heat, |balance| write_array("out", &quantities(balance.last()?), out, length)) }
}
