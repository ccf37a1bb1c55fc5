//! What a host's own records tell of the motion: its class and statistics, quantities over the orbit.
//!
//! Nothing here needs a simulation: the numbers may be those of another program, or measured.

use super::guard::{check_array, static_name, status, write_array};
use crate::error::{Error, Result, Status};
use crate::scalar::math;
use crate::sim::{OverOrbit, WhirlRecord, WhirlSummary};
use libc::c_char;
use std::ffi::CStr;

/// Names of the numbers of a motion.
const MOTION: [&CStr; 14] = [
    c"motion",
    c"mean_whirl_speed",
    c"p05_whirl_speed",
    c"p95_whirl_speed",
    c"mean_radius",
    c"turns",
    c"settling_time",
    c"velocity_deviation",
    c"resting_share",
    c"stable_share",
    c"forward_share",
    c"backward_share",
    c"irregular_share",
    c"intermittent",
];
/// Names of the rows of quantities over the orbit.
const ROWS: [&CStr; 4] = [c"mean", c"p95", c"peak", c"positive_share"];
/// More sectors than this are a mistake.
const MOST_SECTORS: i64 = 100_000;

/// Number of numbers that cagedyn_cage_motion() writes.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_motion_count() -> i64 {
    MOTION.len() as i64
}

/// Name of one of these numbers; "" for others. Static text. What is not known is NaN.
///
/// - motion: 0 resting, 1 stable, 2 forward whirl (in the sense of the cage's rotation), 3 backward whirl, 4 irregular.
/// - mean_whirl_speed, p05_whirl_speed, p95_whirl_speed: mean and percentiles, rad/s; not of a centre next to that of the guide.
/// - mean_radius: distance from the centre of the guide, m; turns: net turns about it, counter-clockwise positive.
/// - settling_time: from which on the whirl speed stays within 15 % of its mean, s.
/// - velocity_deviation: standard deviation of the speed of the centre over its mean, from one record to the next.
/// - resting_share to irregular_share: share of the time in each class, stretch by stretch; intermittent: 1 where a whirl comes and goes.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_motion_name(index: i64) -> *const c_char {
    static_name(&MOTION, index)
}

/// Writes class and statistics of the motion of a cage from time `from` (s) on to `out` (length: motion count). Each array has
/// `records` numbers, at times in growing order: `times` in s, centre of the cage `y`, `z` in m relative to that of its guide, its
/// angular speed about that centre in rad/s (output cage.whirl_speed), rotation speed of the cage in rad/s. `clearance` is the radial
/// guide clearance in m; 0 for a cage without a guide, where the largest distance stands in for it.
///
/// # Safety
/// The arrays are NULL or hold as many numbers as their lengths say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_cage_motion(
    times: *const f64,
    y: *const f64,
    z: *const f64,
    whirl_speed: *const f64,
    cage_speed: *const f64,
    records: i64,
    clearance: f64,
    from: f64,
    out: *mut f64,
    length: i64,
) -> i32 {
    status(|| {
        check_array("out", out.is_null(), length, MOTION.len())?;
        // SAFETY: see above.
        let column = |name: &str, from: *const f64| unsafe { column(name, from, records) };
        let (times, y, z) = (column("times", times)?, column("y", y)?, column("z", z)?);
        let (whirl_speed, cage_speed) =
            (column("whirl_speed", whirl_speed)?, column("cage_speed", cage_speed)?);
        if !times.windows(2).all(|t| t[0] < t[1]) {
            return Err(bad("times: do not grow from record to record".to_owned()));
        }
        if !(0.0..f64::INFINITY).contains(&clearance) {
            return Err(bad(format!("clearance: {clearance} m is not 0 or more")));
        }
        if !from.is_finite() {
            return Err(bad(format!("from: {from} is not finite")));
        }
        let whirl_radius: Vec<f64> = y.iter().zip(z).map(|(y, z)| math::hypot(*y, *z)).collect();
        let clearance = Some(clearance).filter(|c| *c > 0.0);
        let whirl_radius = whirl_radius.as_slice();
        let (centre, along) = ([y, z], None);
        let record = WhirlRecord { times, whirl_speed, whirl_radius, centre, along, cage_speed, clearance };
        let found = WhirlSummary::of(&record, from);
        let w = found.ok_or_else(|| bad(format!("from: fewer than three records from {from} s on")))?;
        let speed = |part: fn(&crate::sim::Spread) -> f64| w.speed.as_ref().map_or(f64::NAN, part);
        let [resting, stable, forward, backward, irregular] = w.shares.unwrap_or([f64::NAN; 5]);
        let values = [
            f64::from(w.motion as u8),
            speed(|s| s.mean),
            speed(|s| s.p05),
            speed(|s| s.p95),
            w.radius,
            w.turns,
            w.settling_time.unwrap_or(f64::NAN),
            w.velocity_deviation.unwrap_or(f64::NAN),
            resting,
            stable,
            forward,
            backward,
            irregular,
            f64::from(u8::from(w.intermittent)),
        ];
        // SAFETY: see above.
        unsafe { write_array("out", &values, out, length) }
    })
}

/// Number of rows that cagedyn_over_orbit() writes.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_over_orbit_count() -> i64 {
    ROWS.len() as i64
}

/// Name of one of these rows; "" for others. Static text.
///
/// - mean; p95: 95th percentile of the magnitude; peak: the largest magnitude; positive_share: of the samples, as a load zone has
///   it of the force on the inner ring. NaN where there is no sample.
#[unsafe(no_mangle)]
pub extern "C" fn cagedyn_over_orbit_name(index: i64) -> *const c_char {
    static_name(&ROWS, index)
}

/// Sorts samples of elements into equal sectors of their orbit, and writes what they are there to `out`: rows one after the other,
/// each with a number per sector, sector k from 2 pi k / sectors on (length: row count times `sectors`). `angles` in rad, of any
/// number of turns, counter-clockwise from y (output orbit_angle), and `values` have `samples` numbers.
///
/// # Safety
/// The arrays are NULL or hold as many numbers as their lengths say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cagedyn_over_orbit(
    angles: *const f64,
    values: *const f64,
    samples: i64,
    sectors: i64,
    out: *mut f64,
    length: i64,
) -> i32 {
    status(|| {
        if !(1..=MOST_SECTORS).contains(&sectors) {
            return Err(bad(format!("sectors: {sectors} is not 1 to {MOST_SECTORS}")));
        }
        let sectors = sectors as usize;
        check_array("out", out.is_null(), length, ROWS.len() * sectors)?;
        // SAFETY: see above.
        let (angles, values) =
            unsafe { (column("angles", angles, samples)?, column("values", values, samples)?) };
        let over =
            OverOrbit::of(angles.iter().zip(values).map(|(angle, value)| (*angle, *value, 0.0)), sectors);
        let all: Vec<f64> = [over.mean, over.p95, over.peak, over.positive].concat();
        // SAFETY: see above.
        unsafe { write_array("out", &all, out, length) }
    })
}

fn bad(text: String) -> Error {
    Error::new(Status::BadValue, text)
}

/// Finite numbers of a host.
///
/// # Safety
/// `from` is NULL or an array of `length` numbers.
unsafe fn column<'a>(name: &str, from: *const f64, length: i64) -> Result<&'a [f64]> {
    let count = usize::try_from(length)
        .map_err(|_| Error::new(Status::WrongSize, format!("{name}: length {length}, must be 0 or more")))?;
    check_array(name, from.is_null() && count > 0, length, count)?;
    if count == 0 {
        return Ok(&[]);
    }
    if length > isize::MAX as i64 / 8 {
        return Err(Error::new(Status::WrongSize, format!("{name}: length {length} is no array")));
    }
    // SAFETY: not NULL, and as long by the contract of the ABI.
    let numbers = unsafe { std::slice::from_raw_parts(from, count) };
    match numbers.iter().position(|x| !x.is_finite()) {
        Some(i) => Err(bad(format!("{name}[{i}]: {} is not finite", numbers[i]))),
        None => Ok(numbers),
    }
}
