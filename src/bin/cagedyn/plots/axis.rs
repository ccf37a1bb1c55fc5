//! Axes with round tick values.

use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use std::ops::Range;

/// More decimals than this, or larger numbers, are written with an exponent.
const MAX_DECIMALS: f64 = 5.0;
const LARGEST_PLAIN: f64 = 1e6;

/// How tick values are written.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Notation {
    /// Plain, with this many decimals.
    Decimals(usize),
    /// With an exponent, where plain numbers would be too long for their strip.
    Exponent,
    /// The same with a short zero.
    Narrow,
    /// As power of ten; the axis shows logarithms.
    PowerOfTen,
    /// The number itself; the axis shows logarithms.
    Antilogarithm,
    /// The number with the digits that it has.
    Plain,
}

/// Range, ticks and name of an axis.
#[derive(Clone)]
pub struct Axis {
    /// Name with unit.
    pub name: String,
    /// Lower end.
    pub min: f64,
    /// Upper end.
    pub max: f64,
    step: f64,
    notation: Notation,
    /// Places of the ticks, where they are at equal distances of no round number.
    at: Option<Vec<f64>>,
}

impl Axis {
    /// An axis from `min` to `max` with about `ticks` ticks.
    pub fn new(name: &str, min: f64, max: f64, ticks: usize) -> Self {
        let step = round_step((max - min) / ticks.max(1) as f64);
        // A tick of 1, 2 or 5 times a power of ten has no more digits than that power.
        let decimals = (-(step * (1.0 + 1e-9)).log10().floor()).max(0.0);
        let plain = decimals <= MAX_DECIMALS && min.abs().max(max.abs()) < LARGEST_PLAIN;
        let notation = if plain { Notation::Decimals(decimals as usize) } else { Notation::Exponent };
        Self { name: name.to_owned(), min, max, step, notation, at: None }
    }

    /// The axis with its ticks at these places, or some of them where there are more than `most`. They are written as they are, or
    /// as numbers of which they are the logarithms.
    pub fn at(mut self, places: &[f64], most: usize, logarithmic: bool) -> Self {
        let every = places.len().div_ceil(most.max(1)).max(1);
        self.at = Some(places.iter().copied().step_by(every).collect());
        self.notation = if logarithmic { Notation::Antilogarithm } else { Notation::Plain };
        self
    }

    /// The axis with a tick at every multiple of `step`.
    pub fn every(self, step: f64) -> Self {
        Self { step, ..self }
    }

    /// An axis that shows all finite values with some room around them.
    pub fn covering(name: &str, values: impl Iterator<Item = f64>, ticks: usize) -> Self {
        let finite = values.filter(|v| v.is_finite());
        let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        let (low, high) = if low > high { (0.0, 0.0) } else { (low, high) };
        // A constant still needs a range to be drawn in.
        let size = low.abs().max(high.abs());
        let constant = high - low <= 1e-9 * size;
        let room = match (constant, size > 0.0) {
            (false, _) => 0.06 * (high - low),
            (true, true) => 0.1 * size,
            (true, false) => 1.0,
        };
        Self::new(name, low - room, high + room, ticks)
    }

    /// An axis of logarithms to the base 10, with a tick at every power of ten.
    pub fn powers_of_ten(name: &str, min: f64, max: f64) -> Self {
        Self { name: name.to_owned(), min, max, step: 1.0, notation: Notation::PowerOfTen, at: None }
    }

    /// An axis of logarithms to the base 10, with a tick at 1, 2 and 5 times every power of ten.
    pub fn logarithms(name: &str, min: f64, max: f64) -> Self {
        Self { name: name.to_owned(), min, max, step: 1.0, notation: Notation::Antilogarithm, at: None }
    }

    /// Writes numbers of more than four decimals with an exponent, beside which the name has room.
    pub fn narrow(mut self) -> Self {
        if matches!(self.notation, Notation::Decimals(decimals) if decimals > 4)
            || self.notation == Notation::Exponent
        {
            self.notation = Notation::Narrow;
        }
        self
    }

    /// Whether it shows logarithms to the base 10.
    pub fn logarithmic(&self) -> bool {
        matches!(self.notation, Notation::PowerOfTen | Notation::Antilogarithm)
    }

    /// Places of the ticks.
    pub fn ticks(&self) -> Vec<f64> {
        if let Some(at) = &self.at {
            return at.clone();
        }
        if self.notation == Notation::Antilogarithm {
            let (first, last) = (self.min.floor() as i64, self.max.ceil() as i64);
            let all = (first..=last).flat_map(|power| [1.0f64, 2.0, 5.0].map(|m| power as f64 + m.log10()));
            return all.filter(|tick| (self.min..=self.max).contains(tick)).collect();
        }
        let slack = 1e-9 * (self.max - self.min);
        let first = ((self.min - slack) / self.step).ceil() as i64;
        let last = ((self.max + slack) / self.step).floor() as i64;
        (first..=last).map(|i| i as f64 * self.step).collect()
    }

    /// Text of a tick.
    pub fn label(&self, value: f64) -> String {
        match self.notation {
            Notation::Decimals(decimals) => minus(&format!("{value:.decimals$}")),
            Notation::Narrow if value == 0.0 => "0".to_owned(),
            Notation::Exponent | Notation::Narrow => minus(&format!("{value:.1e}")),
            Notation::Antilogarithm => short(10f64.powf(value)),
            Notation::Plain => short(value),
            Notation::PowerOfTen => format!("10{}", superscript(value.round() as i64)),
        }
    }
}

impl Ranged for Axis {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let share = (value - self.min) / (self.max - self.min);
        (f64::from(limit.0) + share * f64::from(limit.1 - limit.0)).round() as i32
    }

    /// The ticks as bold lines; no light lines between them.
    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() { Vec::new() } else { self.ticks() }
    }

    fn range(&self) -> Range<f64> {
        self.min..self.max
    }
}

/// The smallest of 1, 2, 5 times a power of ten that is at least `x`.
fn round_step(x: f64) -> f64 {
    if !x.is_finite() || x <= 0.0 {
        return 1.0;
    }
    let power = 10f64.powf(x.log10().floor());
    let step = [1.0, 2.0, 5.0].into_iter().find(|m| m * power >= x * (1.0 - 1e-9));
    step.unwrap_or(10.0) * power
}

/// A number with the digits that it has, at most four.
fn short(x: f64) -> String {
    let rounded: f64 = format!("{x:.3e}").parse().unwrap_or(x);
    let plain = rounded == 0.0 || (1e-3..1e5).contains(&rounded.abs());
    minus(&if plain { format!("{rounded}") } else { format!("{rounded:e}") })
}

/// A number with a typographic minus sign, and none in front of zero.
pub fn minus(number: &str) -> String {
    match number.strip_prefix('-') {
        Some(rest) if rest.chars().any(|c| ('1'..='9').contains(&c)) => format!("\u{2212}{rest}"),
        Some(rest) => rest.to_owned(),
        None => number.to_owned(),
    }
}

fn superscript(n: i64) -> String {
    let raised = |c: char| match c {
        '-' => '\u{207b}',
        '1' => '\u{b9}',
        '2' => '\u{b2}',
        '3' => '\u{b3}',
        digit => char::from_u32(0x2070 + digit.to_digit(10).unwrap_or(0)).unwrap_or(digit),
    };
    n.to_string().chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        let axis = Axis::new("x", -0.23, 0.31, 5);
        let labels: Vec<_> = axis.ticks().iter().map(|&t| axis.label(t)).collect();
        assert_eq!(labels, ["\u{2212}0.2", "0.0", "0.2"]);
        assert_eq!(Axis::new("x", 0.0, 1000.0, 10).ticks().len(), 11);
        let small = Axis::new("x", 0.0, 3e-7, 3);
        assert_eq!(small.label(-2e-7), "\u{2212}2.0e-7");
        let log = Axis::powers_of_ten("x", -3.2, 0.5);
        assert_eq!(log.ticks(), [-3.0, -2.0, -1.0, 0.0]);
        assert_eq!(log.label(-13.0), "10\u{207b}\u{b9}\u{b3}");
        let log = Axis::logarithms("x", -5.4, -4.0);
        let labels: Vec<_> = log.ticks().iter().map(|&t| log.label(t)).collect();
        assert_eq!(labels, ["5e-6", "1e-5", "2e-5", "5e-5", "1e-4"]);
        assert_eq!(Axis::new("x", 0.0, 3e-5, 3).narrow().label(1e-5), "1.0e-5");
        let at = Axis::new("x", 0.0, 4.0, 3).at(&[0.5, 1.25, 2.0, -1500.0], 2, false);
        let labels: Vec<_> = at.ticks().iter().map(|&t| at.label(t)).collect();
        assert_eq!(labels, ["0.5", "2"]);
        assert_eq!(at.label(-1234.56), "\u{2212}1235");
        assert_eq!(Axis::new("x", 0.0, 360.0, 10).every(90.0).ticks().len(), 5);
    }

    #[test]
    fn constants_and_nothing_have_a_range() {
        for values in [vec![], vec![3.0, 3.0], vec![f64::NAN]] {
            let axis = Axis::covering("x", values.into_iter(), 4);
            assert!(axis.max > axis.min && !axis.ticks().is_empty());
        }
    }
}
