//! Steady whirl in C: a whirl, or a branch of them over a number of the scene.

use super::guard::{
    EMPTY, check_array, count, free, guard, index, shared, static_name, status, text, to_c_string,
    write_array,
};
use super::limits::{cagedyn_watch, limits_of};
use super::model::cagedyn_model;
use crate::error::{Result, Status};
use crate::registry::registry;
use crate::scene::Scene;
use crate::whirl::{Branch, End, Point, follow, steady};
use libc::c_char;
use std::ffi::CString;

/// Steady whirls of a cage among elements of prescribed motion, without gravity: one, or a branch of them. Any number of threads may
/// read it.
#[allow(non_camel_case_types)]
pub struct cagedyn_whirl {
    branch: Branch,
    why: CString,
}

registry! {
    /// What is known of a whirl.
    enum Quantity,
    /// Names of what is known of a whirl.
    const QUANTITIES {
        Parameter = "parameter",
        Speed = "whirl_speed",
        Eccentricity = "eccentricity",
        Lead = "lead",
        LeadingRate = "leading_rate",
        LeadingFrequency = "leading_frequency",
        Arcs = "arcs",
        Stable = "stable",
        Fold = "fold",
        Hopf = "hopf",
        Grazed = "grazed",
    }
}

fn values(point: &Point) -> [f64; QUANTITIES.len()] {
    let whirl = &point.whirl;
    let flag = |is: bool| f64::from(u8::from(is));
    let [rate, frequency] = whirl.eigenvalues.first().copied().unwrap_or([f64::NAN; 2]);
    [
        point.parameter,
        whirl.speed,
        whirl.eccentricity,
        whirl.lead,
        rate,
        frequency,
        f64::from(whirl.arcs),
        flag(whirl.stable()),
        flag(point.fold),
        flag(point.hopf),
        flag(point.grazed),
    ]
}

fn handle(branch: Branch) -> *mut cagedyn_whirl {
    let why = to_c_string(branch.end.why().unwrap_or_default());
    Box::into_raw(Box::new(cagedyn_whirl { branch, why }))
}

/// Finds the steady whirl of the model's scene without its gravity: a branch of one point, whose parameter is 0. Of several whirls it is a
/// stable one. Returns NULL on failure, with the reason in cagedyn_error_message(): that there is no whirl, or that none was found. Free it
/// with cagedyn_whirl_free().
///
/// # Safety
/// `model` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_whirl_steady(model: *const cagedyn_model) -> *mut cagedyn_whirl {
    // SAFETY: see above.
    unsafe { cagedyn_whirl_steady_with_watch(model, std::ptr::null()) }
}

/// As cagedyn_whirl_steady(), with a watch, by which it can be stopped; NULL for none.
///
/// # Safety
/// `model` and `watch` are NULL or live handles.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_whirl_steady_with_watch(
    model: *const cagedyn_model,
    watch: *const cagedyn_watch,
) -> *mut cagedyn_whirl {
    guard(
        |_| std::ptr::null_mut(),
        || {
            // SAFETY: see above.
            let (model, limits) = unsafe { (shared("model", model)?, limits_of(watch)) };
            let whirl = steady(model.model.scene(), None, &limits)?;
            let point = Point { parameter: 0.0, whirl, fold: false, hopf: false, grazed: false };
            Ok(handle(Branch { points: vec![point], end: End::Range }))
        },
    )
}

/// Follows the steady whirl over a number of the scene from one value to another, around folds. `path` is that of an override, as in
/// inner_ring.speed.constant. Returns NULL where there is no whirl at the start, with the reason in cagedyn_error_message(); where
/// the branch ends later, and why, tell cagedyn_whirl_end() and cagedyn_whirl_why(). Takes up to minutes for an elastic cage. Free it with
/// cagedyn_whirl_free().
///
/// # Safety
/// `model` is NULL or a live handle, `path` NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_whirl_follow(
    model: *const cagedyn_model,
    path: *const c_char,
    from: f64,
    to: f64,
) -> *mut cagedyn_whirl {
    // SAFETY: see above.
    unsafe { cagedyn_whirl_follow_with_watch(model, path, from, to, std::ptr::null()) }
}

/// As cagedyn_whirl_follow(), with a watch, by which it can be stopped; NULL for none. A branch that is stopped has the points so far, and
/// cagedyn_whirl_status() tells; before the first point NULL is returned.
///
/// # Safety
/// `model` and `watch` are NULL or live handles, `path` NULL or a NUL-terminated text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_whirl_follow_with_watch(
    model: *const cagedyn_model,
    path: *const c_char,
    from: f64,
    to: f64,
    watch: *const cagedyn_watch,
) -> *mut cagedyn_whirl {
    guard(
        |_| std::ptr::null_mut(),
        || {
            // SAFETY: see above.
            let (model, path, limits) =
                unsafe { (shared("model", model)?, text("path", path)?, limits_of(watch)) };
            let json = model.model.scene().to_json();
            let with =
                |_: &Scene, value: f64| Scene::from_json_with(&json, [(path, format!("{value:?}").as_str())]);
            Ok(handle(follow(model.model.scene(), [from, to], with, &limits, |_| ())?))
        },
    )
}

/// Frees a branch. NULL is ignored, and the stored error stays.
///
/// # Safety
/// `whirl` is NULL or a live handle; it must not be used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_whirl_free(whirl: *mut cagedyn_whirl) {
    // SAFETY: see above.
    unsafe { free(whirl) }
}

/// Number of points of a branch. Negative status code on failure.
///
/// # Safety
/// `whirl` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_whirl_point_count(whirl: *const cagedyn_whirl) -> i64 {
    // SAFETY: see above.
    count(|| Ok(unsafe { shared("whirl", whirl) }?.branch.points.len()))
}

/// Number of numbers that cagedyn_whirl_point() writes.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_whirl_quantity_count() -> i64 {
    QUANTITIES.len() as i64
}

/// Name of one of these numbers; "" for others. Static text.
///
/// - parameter: the number that is varied.
/// - whirl_speed: rad/s, negative clockwise; eccentricity: m; lead: of the elements in their pockets, rad.
/// - leading_rate, leading_frequency: of the eigenvalue that decides the stability, 1/s and rad/s.
/// - arcs: wet arcs of the film. stable: 1 where every small disturbance decays, else 0.
/// - fold, hopf, grazed: 1 where, since the point before, the branch has turned back, a pair of eigenvalues has crossed, or the
///   number of wet arcs has changed, so that another branch begins; else 0.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_whirl_quantity_name(index: i64) -> *const c_char {
    static_name(&Quantity::C_NAMES, index)
}

/// Writes what is known of a point (length: quantity count).
///
/// # Safety
/// `whirl` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_whirl_point(
    whirl: *const cagedyn_whirl,
    point: i64,
    out: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    status(|| unsafe { write_array("out", &values(point_of(whirl, point)?), out, length) })
}

/// Number of waves of an elastic cage, which cagedyn_whirl_amplitudes() writes; 0 for a rigid one. Negative status code on failure.
///
/// # Safety
/// `whirl` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_whirl_wave_count(whirl: *const cagedyn_whirl) -> i64 {
    // SAFETY: see above.
    count(|| Ok(unsafe { point_of(whirl, 0) }?.whirl.amplitudes.len()))
}

/// Writes the amplitudes of the waves of a point from order 2 on, m (length: wave count).
///
/// # Safety
/// `whirl` is NULL or a live handle, `out` NULL or an array of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_whirl_amplitudes(
    whirl: *const cagedyn_whirl,
    point: i64,
    out: *mut f64,
    length: i64,
) -> i32 {
    // SAFETY: see above.
    status(|| unsafe { write_array("out", &point_of(whirl, point)?.whirl.amplitudes, out, length) })
}

/// Number of eigenvalues of a point without that of its phase. Negative status code on failure.
///
/// # Safety
/// `whirl` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_whirl_eigenvalue_count(whirl: *const cagedyn_whirl) -> i64 {
    // SAFETY: see above.
    count(|| Ok(unsafe { point_of(whirl, 0) }?.whirl.eigenvalues.len()))
}

/// Writes rates (1/s) and frequencies (rad/s) of the eigenvalues of a point, the largest rate first (length of both: eigenvalue
/// count). On failure neither is touched.
///
/// # Safety
/// `whirl` is NULL or a live handle, `rates` and `frequencies` NULL or arrays of `length` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_whirl_eigenvalues(
    whirl: *const cagedyn_whirl,
    point: i64,
    rates: *mut f64,
    frequencies: *mut f64,
    length: i64,
) -> i32 {
    status(|| {
        // SAFETY: see above.
        let found = &unsafe { point_of(whirl, point) }?.whirl.eigenvalues;
        check_array("rates", rates.is_null(), length, found.len())?;
        check_array("frequencies", frequencies.is_null(), length, found.len())?;
        let part = |k: usize| found.iter().map(|value| value[k]).collect::<Vec<_>>();
        // SAFETY: see above.
        unsafe {
            write_array("rates", &part(0), rates, length)?;
            write_array("frequencies", &part(1), frequencies, length)
        }
    })
}

/// How a branch ends: "range" at the end of the range, "length" after as many points as a branch may have, "lost" where no
/// whirl was found further on, "cancelled" or "out of time" where a watch has ended it; "" on failure. Static text.
///
/// # Safety
/// `whirl` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_whirl_end(whirl: *const cagedyn_whirl) -> *const c_char {
    guard(
        |_| EMPTY.as_ptr(),
        || {
            // SAFETY: see above.
            let end = &unsafe { shared("whirl", whirl) }?.branch.end;
            Ok(match end {
                End::Range => c"range",
                End::Length => c"length",
                End::Lost(_) => c"lost",
                End::Stopped(e) if e.status == Status::Cancelled => c"cancelled",
                End::Stopped(_) => c"out of time",
            }
            .as_ptr())
        },
    )
}

/// CAGEDYN_ERR_CANCELLED or CAGEDYN_ERR_OUT_OF_TIME for a branch that a watch has ended, CAGEDYN_OK for others; other codes on failure.
///
/// # Safety
/// `whirl` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_whirl_status(whirl: *const cagedyn_whirl) -> i32 {
    status(|| {
        // SAFETY: see above.
        match &unsafe { shared("whirl", whirl) }?.branch.end {
            End::Stopped(e) => Err(e.clone()),
            _ => Ok(()),
        }
    })
}

/// Why a branch ends before the end of its range, one line; "" where it does not, and on failure. Lives as long as the branch.
///
/// # Safety
/// `whirl` is NULL or a live handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_whirl_why(whirl: *const cagedyn_whirl) -> *const c_char {
    // SAFETY: see above.
    guard(|_| EMPTY.as_ptr(), || Ok(unsafe { shared("whirl", whirl) }?.why.as_ptr()))
}

/// A point of a branch.
///
/// # Safety
/// `whirl` is NULL or a live handle.
unsafe fn point_of<'a>(whirl: *const cagedyn_whirl, point: i64) -> Result<&'a Point> {
    // SAFETY: as the caller's.
    let points = &unsafe { shared("whirl", whirl) }?.branch.points;
    Ok(&points[index("point", point, points.len())?])
}
