//! Checks of functions of time, tables and harmonics.

use super::*;

const MAX_POINTS: usize = 1_000_000;
const MAX_HARMONICS: usize = 64;
const MAX_ORDER: u32 = 200;

/// Checks a function of time whose values must lie in `allowed`.
pub(in crate::scene) fn signal(judge: Judge<'_>, path: &str, s: &Signal, allowed: Range) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    match s {
        Signal::Constant(value) => judge.number(&at("constant"), *value, allowed),
        Signal::Step { before, after, time } => {
            judge.number(&at("step.before"), *before, allowed)?;
            judge.number(&at("step.after"), *after, allowed)?;
            judge.number(&at("step.time"), *time, TIME)
        }
        Signal::Ramp { from, to, start, end } => {
            judge.number(&at("ramp.from"), *from, allowed)?;
            judge.number(&at("ramp.to"), *to, allowed)?;
            judge.number(&at("ramp.start"), *start, TIME)?;
            judge.number(&at("ramp.end"), *end, TIME)?;
            if end <= start {
                judge.refuse(&at("ramp.end"), format!("{end:?} s is not after the start {start:?} s"))?;
            }
            Ok(())
        }
        Signal::Sine { mean, amplitude, frequency, phase } => {
            judge.number(&at("sine.mean"), *mean, allowed)?;
            let room = (mean - allowed.min).min(allowed.max - mean);
            judge.number(&at("sine.amplitude"), *amplitude, range(-room, room, allowed.unit))?;
            judge.number(&at("sine.frequency"), *frequency, range(0.0, 1e6, "Hz"))?;
            judge.number(&at("sine.phase"), *phase, ANGLE)
        }
        Signal::Table { time, value } => {
            table(judge, &at("table"), ("time", time, TIME), ("value", value, allowed))
        }
    }
}

/// Checks harmonics, each with order, amplitude and phase: orders from the lowest one on, with what those below would be.
pub(super) fn harmonics(
    judge: Judge<'_>,
    path: &str,
    list: impl ExactSizeIterator<Item = (u32, f64, f64)>,
    (lowest, below): (u32, &str),
    allowed: Range,
) -> Result<()> {
    if list.len() > MAX_HARMONICS {
        judge.refuse(path, format!("{} harmonics, at most {MAX_HARMONICS}", list.len()))?;
    }
    for (i, (order, amplitude, phase)) in list.enumerate() {
        let at = |field: &str| format!("{path}.{i}.{field}");
        if !(lowest..=MAX_ORDER).contains(&order) {
            judge.refuse(&at("order"), format!("{order} is not within {lowest} to {MAX_ORDER}{below}"))?;
        }
        judge.number(&at("amplitude"), amplitude, allowed)?;
        judge.number(&at("phase"), phase, ANGLE)?;
    }
    Ok(())
}

/// Checks two lists, each given with its name and range: equally long, the first in strictly growing order.
pub(super) fn table(
    judge: Judge<'_>,
    path: &str,
    x: (&str, &[f64], Range),
    y: (&str, &[f64], Range),
) -> Result<()> {
    let at = |field: &str| format!("{path}.{field}");
    if x.1.is_empty() || x.1.len() > MAX_POINTS {
        judge.refuse(&at(x.0), format!("{} points, 1 to {MAX_POINTS} are allowed", x.1.len()))?;
    }
    if x.1.len() != y.1.len() {
        judge.refuse(&at(y.0), format!("{} values for {} points", y.1.len(), x.1.len()))?;
    }
    for (i, (a, b)) in x.1.iter().zip(y.1).enumerate() {
        judge.number(&at(&format!("{}.{i}", x.0)), *a, x.2)?;
        judge.number(&at(&format!("{}.{i}", y.0)), *b, y.2)?;
        if let Some(before) = i.checked_sub(1).map(|i| x.1[i])
            && *a <= before
        {
            let text = format!("{a:?} {unit} is not after {before:?} {unit}", unit = x.2.unit);
            judge.refuse(&at(&format!("{}.{i}", x.0)), text)?;
        }
    }
    Ok(())
}
