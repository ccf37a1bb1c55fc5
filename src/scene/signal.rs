//! Functions of time for loads and speeds.

use crate::scalar::math;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// A value over time (t in s, value in the unit of the field that uses it). A plain number is a constant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Signal {
    /// The same at all times.
    Constant(f64),
    /// Jumps at one instant.
    Step {
        /// Value before the jump.
        before: f64,
        /// Value from the jump on.
        after: f64,
        /// Time of the jump, s.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1e6)))]
        time: f64,
    },
    /// Changes linearly between two instants and is constant outside.
    Ramp {
        /// Value up to `start`.
        from: f64,
        /// Value from `end` on.
        to: f64,
        /// Start of the change, s.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1e6)))]
        start: f64,
        /// End of the change, s.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1e6)))]
        end: f64,
    },
    /// mean + amplitude * sin(2 pi frequency t + phase).
    Sine {
        /// Mean value.
        mean: f64,
        /// Amplitude.
        amplitude: f64,
        /// Frequency, Hz.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1e6)))]
        frequency: f64,
        /// Phase at t = 0, rad.
        #[cfg_attr(feature = "schema", schemars(range(min = -1e3, max = 1e3)))]
        phase: f64,
    },
    /// Linear between points, constant before the first and after the last.
    Table {
        /// Times in strictly growing order, s.
        time: Vec<f64>,
        /// Values at these times.
        value: Vec<f64>,
    },
}

impl Signal {
    /// Value at time `t` in s. At a jump it is the value after it.
    pub fn at(&self, t: f64) -> f64 {
        match self {
            Signal::Constant(value) => *value,
            Signal::Step { before, after, time } => {
                if t < *time {
                    *before
                } else {
                    *after
                }
            }
            Signal::Ramp { from, to, start, end } => {
                let x = ((t - start) / (end - start)).clamp(0.0, 1.0);
                from + (to - from) * x
            }
            Signal::Sine { mean, amplitude, frequency, phase } => {
                mean + amplitude * math::sin(TAU * frequency * t + phase)
            }
            Signal::Table { time, value } => interpolate(time, value, t),
        }
    }

    /// Rate of change at time `t` in s, per second. At a kink it is that after it; jumps have none.
    pub fn rate(&self, t: f64) -> f64 {
        match self {
            Signal::Constant(_) | Signal::Step { .. } => 0.0,
            Signal::Ramp { from, to, start, end } => {
                if *start <= t && t < *end {
                    (to - from) / (end - start)
                } else {
                    0.0
                }
            }
            Signal::Sine { amplitude, frequency, phase, .. } => {
                amplitude * TAU * frequency * math::cos(TAU * frequency * t + phase)
            }
            Signal::Table { time, value } => {
                let next = time.partition_point(|&x| x <= t);
                match (next.checked_sub(1), time.get(next)) {
                    (Some(last), Some(end)) => (value[next] - value[last]) / (end - time[last]),
                    _ => 0.0,
                }
            }
        }
    }

    /// Second and third rate at time `t` in s, per second squared and cubed; zero but for a sine.
    pub fn higher_rates(&self, t: f64) -> [f64; 2] {
        match self {
            Signal::Sine { mean, frequency, .. } => {
                let square = -(TAU * frequency) * (TAU * frequency);
                [square * (self.at(t) - mean), square * self.rate(t)]
            }
            _ => [0.0; 2],
        }
    }

    /// The first jump or kink after time `t` in s; infinity when there is none.
    pub fn next_event(&self, t: f64) -> f64 {
        let first_after = |times: &[f64]| times.iter().copied().find(|&x| x > t).unwrap_or(f64::INFINITY);
        match self {
            Signal::Constant(_) | Signal::Sine { .. } => f64::INFINITY,
            Signal::Step { time, .. } => first_after(&[*time]),
            Signal::Ramp { start, end, .. } => first_after(&[*start, *end]),
            Signal::Table { time, .. } => {
                time.get(time.partition_point(|&x| x <= t)).copied().unwrap_or(f64::INFINITY)
            }
        }
    }

    /// The first time after `t` (s) at which the signal passes `level` without a jump; infinity when there is none.
    pub fn next_passage(&self, t: f64, level: f64) -> f64 {
        // On the line from one point to the next, if it leads through.
        let on_line = |[t0, t1]: [f64; 2], [v0, v1]: [f64; 2]| {
            let at = t0 + (t1 - t0) * ((level - v0) / (v1 - v0));
            (at > t && (v0 - level) * (v1 - level) < 0.0).then_some(at)
        };
        match self {
            Signal::Constant(_) | Signal::Step { .. } => f64::INFINITY,
            Signal::Ramp { from, to, start, end } => {
                on_line([*start, *end], [*from, *to]).unwrap_or(f64::INFINITY)
            }
            Signal::Table { time, value } => {
                let first = time.partition_point(|&x| x <= t).saturating_sub(1);
                let lines = time.windows(2).zip(value.windows(2)).skip(first);
                lines.filter_map(|(t, v)| on_line([t[0], t[1]], [v[0], v[1]])).next().unwrap_or(f64::INFINITY)
            }
            Signal::Sine { mean, amplitude, frequency, phase } => {
                let share = (level - mean) / amplitude;
                if share.is_nan() || share.abs() > 1.0 || *frequency == 0.0 {
                    return f64::INFINITY;
                }
                let angle = math::asin(share);
                let passage = |angle: f64| {
                    // Rising once and falling once per period; a time depends on the number of the period alone.
                    let at = |n: f64| ((angle - phase) / TAU + n) / frequency;
                    let n = (frequency * t - (angle - phase) / TAU).floor();
                    let times = [n - 1.0, n, n + 1.0, n + 2.0].map(at);
                    times.into_iter().filter(|x| *x > t).fold(f64::INFINITY, f64::min)
                };
                passage(angle).min(passage(std::f64::consts::PI - angle))
            }
        }
    }

    /// Period of a sine that is switched on, s; infinity for everything else.
    pub fn period(&self) -> f64 {
        match self {
            Signal::Sine { amplitude, frequency, .. } if *amplitude != 0.0 => 1.0 / frequency.abs(),
            _ => f64::INFINITY,
        }
    }

    /// Smallest and largest value the signal reaches.
    pub fn bounds(&self) -> (f64, f64) {
        match self {
            Signal::Constant(value) => (*value, *value),
            Signal::Step { before: a, after: b, .. } | Signal::Ramp { from: a, to: b, .. } => {
                (a.min(*b), a.max(*b))
            }
            Signal::Sine { mean, amplitude, .. } => (mean - amplitude.abs(), mean + amplitude.abs()),
            Signal::Table { value, .. } => {
                value.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(*v), b.max(*v)))
            }
        }
    }

    /// Largest magnitude the signal reaches.
    pub fn largest(&self) -> f64 {
        let (low, high) = self.bounds();
        low.abs().max(high.abs())
    }
}

/// The integral of a signal over time from 0.
#[derive(Clone, Debug, PartialEq)]
pub struct SignalIntegral {
    signal: Signal,
    /// Integral of a table from its first point to each of its points.
    to_point: Vec<f64>,
}

impl SignalIntegral {
    /// Prepares the integral of `signal`.
    pub fn new(signal: &Signal) -> Self {
        let mut to_point = Vec::new();
        if let Signal::Table { time, value } = signal {
            let panels = time.windows(2).zip(value.windows(2));
            let areas = panels.map(|(t, v)| 0.5 * (t[1] - t[0]) * (v[0] + v[1]));
            to_point.push(0.0);
            to_point.extend(areas.scan(0.0, |sum, area| {
                *sum += area;
                Some(*sum)
            }));
        }
        Self { signal: signal.clone(), to_point }
    }

    /// Integral from 0 to `t` in s; exact apart from round-off.
    #[inline]
    pub fn at(&self, t: f64) -> f64 {
        match &self.signal {
            Signal::Constant(value) => value * t,
            _ => self.varying(t),
        }
    }

    /// That of a signal that may vary.
    fn varying(&self, t: f64) -> f64 {
        match &self.signal {
            Signal::Constant(value) => value * t,
            Signal::Step { before, after, time } => before * t.min(*time) + after * (t - time).max(0.0),
            Signal::Ramp { from, to, start, end } => {
                let x = t.clamp(*start, *end) - start;
                from * t + (to - from) * (0.5 * x * x / (end - start) + (t - end).max(0.0))
            }
            Signal::Sine { mean, amplitude, frequency, phase } => {
                // The mean of the sine over the time, without the difference of two cosines.
                let half = 0.5 * TAU * frequency * t;
                let mean_sine =
                    math::sin(phase + half) * if half == 0.0 { 1.0 } else { math::sin(half) / half };
                (mean + amplitude * mean_sine) * t
            }
            Signal::Table { time, value } => {
                let next = time.partition_point(|&x| x <= t);
                match (next.checked_sub(1), time.first()) {
                    (Some(last), Some(first)) => {
                        let before = value[0] * first;
                        let rest = 0.5 * (t - time[last]) * (value[last] + self.signal.at(t));
                        before + self.to_point[last] + rest
                    }
                    _ => self.signal.at(t) * t,
                }
            }
        }
    }
}

/// Value at `t` of the line through points with strictly growing `time`, constant beyond the first and the last. NaN
/// without points.
pub fn interpolate(time: &[f64], value: &[f64], t: f64) -> f64 {
    let next = time.partition_point(|&x| x <= t);
    match (next.checked_sub(1), time.get(next)) {
        (None, _) => value.first().copied().unwrap_or(f64::NAN),
        (Some(_), None) => value.last().copied().unwrap_or(f64::NAN),
        (Some(last), Some(t1)) => {
            let (t0, v0, v1) = (time[last], value[last], value[next]);
            v0 + (v1 - v0) * ((t - t0) / (t1 - t0))
        }
    }
}

/// Slope at `t` of what [`interpolate`] gives; at a point that of the line after it.
pub fn slope(time: &[f64], value: &[f64], t: f64) -> f64 {
    let next = time.partition_point(|&x| x <= t);
    match (next.checked_sub(1), time.get(next)) {
        (Some(last), Some(t1)) => (value[next] - value[last]) / (t1 - time[last]),
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_and_events() {
        let step = Signal::Step { before: 1.0, after: 2.0, time: 0.1 };
        assert_eq!((step.at(0.0999), step.at(0.1)), (1.0, 2.0));
        assert_eq!((step.next_event(0.0), step.next_event(0.1)), (0.1, f64::INFINITY));
        let ramp = Signal::Ramp { from: 0.0, to: 4.0, start: 1.0, end: 3.0 };
        assert_eq!((ramp.at(0.0), ramp.at(2.0), ramp.at(9.0)), (0.0, 2.0, 4.0));
        assert_eq!((ramp.next_event(0.0), ramp.next_event(1.0)), (1.0, 3.0));
        let table = Signal::Table { time: vec![0.0, 1.0, 3.0], value: vec![1.0, 3.0, -1.0] };
        assert_eq!((table.at(-1.0), table.at(0.5), table.at(2.0), table.at(3.0)), (1.0, 2.0, 1.0, -1.0));
        assert_eq!((table.next_event(0.0), table.next_event(3.0)), (1.0, f64::INFINITY));
        let sine = Signal::Sine { mean: 1.0, amplitude: 2.0, frequency: 0.25, phase: 0.0 };
        assert!((sine.at(1.0) - 3.0).abs() < 1e-15);
        assert_eq!(sine.largest(), 3.0);
    }

    #[test]
    fn passages_are_found_in_order() {
        let signals = [
            Signal::Ramp { from: 1.0, to: 4.0, start: 0.2, end: 0.9 },
            Signal::Sine { mean: 1.0, amplitude: 2.0, frequency: 1.3, phase: 0.5 },
            Signal::Sine { mean: 1.0, amplitude: -2.0, frequency: 1.3, phase: 0.5 },
            Signal::Table { time: vec![0.1, 0.5, 1.2, 1.5], value: vec![1.0, 3.0, -1.0, 2.0] },
        ];
        for signal in signals {
            for level in [-0.9003, 0.3001, 1.7002, 2.5003] {
                // By small steps.
                let step = 1e-4;
                let passed = |i: &i32| {
                    let (a, b) = (signal.at(f64::from(*i) * step), signal.at(f64::from(i + 1) * step));
                    (a - level) * (b - level) < 0.0
                };
                let expected: Vec<f64> = (0..20_000).filter(passed).map(|i| f64::from(i) * step).collect();
                let (mut found, mut t) = (Vec::new(), 0.0);
                loop {
                    t = signal.next_passage(t, level);
                    if t >= 2.0 {
                        break;
                    }
                    found.push(t);
                }
                assert_eq!(found.len(), expected.len(), "{signal:?} {level}: {found:?} {expected:?}");
                assert!(found.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 2e-4), "{signal:?} {level}");
            }
        }
        assert_eq!(Signal::Constant(1.0).next_passage(0.0, 1.0), f64::INFINITY);
    }

    #[test]
    fn rates_are_those_of_the_values() {
        let signals = [
            Signal::Ramp { from: 1.0, to: 4.0, start: 0.2, end: 0.9 },
            Signal::Sine { mean: 1.0, amplitude: 2.0, frequency: 1.3, phase: 0.5 },
            Signal::Table { time: vec![0.1, 0.5, 1.2], value: vec![1.0, 3.0, -1.0] },
        ];
        for signal in signals {
            for t in [0.05, 0.3, 0.6, 1.0, 2.0] {
                let h = 1e-6;
                let difference = (signal.at(t + h) - signal.at(t - h)) / (2.0 * h);
                assert!((signal.rate(t) - difference).abs() < 1e-8, "{signal:?} at {t}");
            }
        }
    }

    #[test]
    fn integrals_are_those_of_the_values() {
        let signals = [
            Signal::Constant(2.0),
            Signal::Step { before: 1.0, after: -2.0, time: 0.4 },
            Signal::Ramp { from: 1.0, to: 4.0, start: 0.2, end: 0.9 },
            Signal::Sine { mean: 1.0, amplitude: 2.0, frequency: 1.3, phase: 0.5 },
            Signal::Sine { mean: 1.0, amplitude: 2.0, frequency: 0.0, phase: 0.5 },
            Signal::Table { time: vec![0.1, 0.5, 1.2], value: vec![1.0, 3.0, -1.0] },
        ];
        for signal in signals {
            for t in [0.0, 0.05, 0.3, 0.6, 1.0, 2.0] {
                let n = 20_000;
                let sum: f64 = (0..n).map(|i| signal.at((f64::from(i) + 0.5) / f64::from(n) * t)).sum();
                let error = SignalIntegral::new(&signal).at(t) - sum * t / f64::from(n);
                assert!(error.abs() < 3e-4, "{signal:?} to {t}: {error}");
            }
        }
    }
}
