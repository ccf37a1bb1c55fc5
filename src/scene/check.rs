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

impl Range {
    /// [`number`] on this range.
    pub fn check(self, path: &str, value: f64) -> Result<()> {
        number(path, value, self)
    }
}

/// Shorthand for a [`Range`].
pub const fn range(min: f64, max: f64, unit: &'static str) -> Range {
    Range { min, max, unit }
}

/// Units in which values are often given by mistake: the SI unit, the other one, and what a value in it is multiplied with.
const UNIT_SLIPS: [(&str, &str, f64); 30] = [
    ("m", "millimetres", 1e-3),
    ("m", "micrometres", 1e-6),
    ("rad/s", "revolutions per minute", std::f64::consts::PI / 30.0),
    ("rad", "degrees", std::f64::consts::PI / 180.0),
    ("kg", "grams", 1e-3),
    ("kg m^2", "kg mm^2", 1e-6),
    ("kg m^2", "g mm^2", 1e-9),
    ("s", "milliseconds", 1e-3),
    ("s", "microseconds", 1e-6),
    ("m/s", "millimetres per second", 1e-3),
    ("m/s^2", "mm/s^2", 1e-3),
    ("N", "kilonewtons", 1e3),
    ("N", "millinewtons", 1e-3),
    ("N s/m", "N s/mm", 1e3),
    ("N s/m", "kN s/mm", 1e6),
    ("N/m", "N/mm", 1e3),
    ("N/m", "N/um", 1e6),
    ("Pa s", "millipascal seconds", 1e-3),
    ("Pa s", "micropascal seconds", 1e-6),
    ("Pa s", "m^2/s of oil with 880 kg/m^3", 880.0),
    ("Pa", "kilopascals", 1e3),
    ("Pa", "megapascals", 1e6),
    ("Pa", "gigapascals", 1e9),
    ("1/Pa", "1/GPa", 1e-9),
    ("m^2/s", "mm^2/s", 1e-6),
    ("m^3/s", "litres per minute", 1e-3 / 60.0),
    ("kg/m^3", "g/cm^3", 1e3),
    ("J/(kg K)", "kJ/(kg K)", 1e3),
    ("1/K", "milli per K", 1e-3),
    ("W/(m K)", "kW/(m K)", 1e3),
];
/// 0 degrees Celsius, K.
const CELSIUS: f64 = 273.15;

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
    let limits = format!("{} to {}{unit_text}", shown(inward(min, 1.0)), shown(inward(max, -1.0)));
    Err(bad(path, format!("{value:?}{unit_text} is not within {limits}{}", slip_hint(value, allowed))))
}

/// "; values are in SI units: was it meant in millimetres, 3e-3 m?", or nothing where no other unit is likely.
pub fn slip_hint(value: f64, allowed: Range) -> String {
    let hint = unit_slip(value, allowed).map(|(si, name)| {
        format!("; values are in SI units: was it meant in {name}, {} {}?", shown(si), allowed.unit)
    });
    hint.unwrap_or_default()
}

/// A limit with six digits that is still allowed; what is allowed lies in the direction `side` (1 or -1).
fn inward(limit: f64, side: f64) -> f64 {
    let digits = |x: f64| format!("{x:.5e}").parse().unwrap_or(x);
    let rounded: f64 = digits(limit);
    if (rounded - limit) * side >= 0.0 {
        return rounded;
    }
    // One more or less in the last of the six digits.
    let text = format!("{rounded:e}");
    let exponent = text.split_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0);
    digits(rounded + side * 10f64.powi(exponent - 5))
}

/// A number for people: six digits, and an exponent where that is shorter.
pub fn shown(x: f64) -> String {
    let rounded = format!("{x:.5e}").parse().unwrap_or(x);
    if x == 0.0 || (1e-2..1e6).contains(&x.abs()) { format!("{rounded}") } else { format!("{rounded:e}") }
}

/// The unit in which a refused value would be the most usual one, and its SI value.
fn unit_slip(value: f64, allowed: Range) -> Option<(f64, &'static str)> {
    let Range { min, max, unit } = allowed;
    // The middle of the range by order of magnitude; a range that reaches zero has its usual values below its end.
    let usual = if min > 0.0 { (min * max).sqrt() } else { 1e-2 * max };
    let distance = |si: f64| math::ln(si.abs() / usual).abs();
    let celsius = (unit == "K" && value < min).then_some((value + CELSIUS, "degrees Celsius"));
    UNIT_SLIPS
        .iter()
        .filter(|(si_unit, ..)| *si_unit == unit && value != 0.0)
        .map(|&(_, name, factor)| (value * factor, name))
        .chain(celsius)
        .filter(|(si, _)| (min..=max).contains(si))
        .min_by(|a, b| distance(a.0).total_cmp(&distance(b.0)))
}

/// The value that a law needs, or an error that says which law needs it.
pub fn needed<T: Copy>(path: &str, value: Option<T>, by: &str) -> Result<T> {
    value.ok_or_else(|| bad(path, format!("missing; {by} needs it")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_that_are_told_are_allowed() {
        let limit = 1.569_796_326_794_896_6;
        assert_eq!((inward(limit, -1.0), inward(limit, 1.0)), (1.56979, 1.5698));
        assert_eq!((inward(-limit, -1.0), inward(-limit, 1.0)), (-1.5698, -1.56979));
        assert_eq!((inward(1e5, -1.0), inward(0.3, -1.0), inward(0.0, 1.0)), (1e5, 0.3, 0.0));
        assert_eq!([1e-4, 0.02375, 1e12, 5.0, 3e-7].map(shown), ["1e-4", "0.02375", "1e12", "5", "3e-7"]);
    }
}
