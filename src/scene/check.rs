//! Range checks with messages that name the path, the value and what is allowed.

use crate::error::{Error, Result, Status};

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

/// Factors between the usual units and SI: mm or ms, um or us, MPa or MN, GPa, and rpm.
const UNIT_SLIPS: [(f64, &str); 6] = [
    (1e-3, "milli"),
    (1e-6, "micro"),
    (1e3, "kilo"),
    (1e6, "mega"),
    (1e9, "giga"),
    (std::f64::consts::TAU / 60.0, "revolutions per minute"),
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
    let slip = UNIT_SLIPS
        .iter()
        .filter(|(_, name)| (unit == "rad/s") == name.starts_with("rev"))
        .find(|(factor, _)| value != 0.0 && (min..=max).contains(&(value * factor)))
        .map_or(String::new(), |(factor, name)| {
            format!(
                "; values are in SI units, is it meant in '{name}' units ({:e}{unit_text})?",
                value * factor
            )
        });
    Err(bad(path, format!("{value:?}{unit_text} is not within {min:e} to {max:e}{unit_text}{slip}")))
}

/// Checks an optional number.
pub fn optional(path: &str, value: Option<f64>, allowed: Range) -> Result<()> {
    value.map_or(Ok(()), |v| number(path, v, allowed))
}

/// The value that a law needs, or an error that says which law needs it.
pub fn needed<T: Copy>(path: &str, value: Option<T>, by: &str) -> Result<T> {
    value.ok_or_else(|| bad(path, format!("missing; {by} needs it")))
}
