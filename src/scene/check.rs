//! Range checks with messages that name the path, the value and what is allowed.

use crate::error::{Error, Result, Status};
use crate::scalar::math;

/// Allowed range of a number, both ends included.
#[derive(Clone, Copy, Debug)]
pub struct Range {
    pub min: f64,
    pub max: f64,
    pub unit: &'static str,
}

/// Shorthand for a [`Range`].
pub const fn range(min: f64, max: f64, unit: &'static str) -> Range {
    Range { min, max, unit }
}

/// What a value in a usual unit is multiplied with and divided by to get SI.
const UNIT_SLIPS: [(f64, f64, &str); 7] = [
    (std::f64::consts::PI, 30.0, "revolutions per minute"),
    (1.0, 1e3, "milli"),
    (1.0, 1e6, "micro"),
    (1.0, 1e9, "nano"),
    (1e3, 1.0, "kilo"),
    (1e6, 1.0, "mega"),
    (1e9, 1.0, "giga"),
];

/// A [`Status::BadScene`] error at a path.
pub fn bad(path: &str, text: impl std::fmt::Display) -> Error {
    Error::new(Status::BadScene, format!("{path}: {text}"))
}

/// Checks that `value` lies in `allowed`; names a likely unit slip when there is one.
pub fn number(path: &str, value: f64, allowed: Range) -> Result<()> {
    let Range { min, max, unit } = allowed;
    if min <= value && value <= max {
        return Ok(());
    }
    let unit_text = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    let slip = unit_slip(value, allowed).map_or(String::new(), |(si, name)| {
        format!("; values are in SI units: was it meant in '{name}' units, {si:e}{unit_text}?")
    });
    Err(bad(path, format!("{value:?}{unit_text} is not within {min:e} to {max:e}{unit_text}{slip}")))
}

/// The unit in which a refused value would be the most usual one, and its SI value.
fn unit_slip(value: f64, allowed: Range) -> Option<(f64, &'static str)> {
    let Range { min, max, unit } = allowed;
    // The middle of the range by order of magnitude; a range that reaches zero has its usual values below its end.
    let usual = if min > 0.0 { (min * max).sqrt() } else { 1e-2 * max };
    let distance = |si: f64| math::ln(si.abs() / usual).abs();
    UNIT_SLIPS
        .iter()
        .filter(|(_, _, name)| {
            value != 0.0 && !unit.is_empty() && (unit == "rad/s") == name.starts_with("rev")
        })
        .map(|&(multiply, divide, name)| (value * multiply / divide, name))
        .filter(|(si, _)| (min..=max).contains(si))
        .min_by(|a, b| distance(a.0).total_cmp(&distance(b.0)))
}

/// Checks an optional number.
pub fn optional(path: &str, value: Option<f64>, allowed: Range) -> Result<()> {
    value.map_or(Ok(()), |v| number(path, v, allowed))
}

/// The value that a law needs, or an error that says which law needs it.
pub fn needed<T: Copy>(path: &str, value: Option<T>, by: &str) -> Result<T> {
    value.ok_or_else(|| bad(path, format!("missing; {by} needs it")))
}
