//! Outputs recorded on a fixed time grid, and their statistics.

use crate::error::{Error, Result, Status};
use crate::sim::{Interval, Sample, Sim};
use serde::{Deserialize, Serialize};

/// Largest number of records of one run.
const MAX_RECORDS: f64 = 1e8;

/// Output channels over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recording {
    /// Times, s.
    pub times: Vec<f64>,
    /// One column per recorded channel, in the order of [`crate::Model::recorded`].
    pub columns: Vec<Vec<f64>>,
    /// One column per watched channel, in the order of [`Sim::watched`]: what it did since the record before. The first
    /// record has intervals of no time.
    pub intervals: Vec<Vec<Interval>>,
}

/// Mean and spread of a channel over a window of time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub deviation: f64,
    /// Standard error of the mean, see [`Sample`].
    pub standard_error: f64,
    /// Whether the window is long enough for it: no drift or swing as long as itself.
    pub stationary: bool,
    /// Smallest value.
    pub min: f64,
    /// Largest value.
    pub max: f64,
    /// Fifth percentile.
    pub p05: f64,
    /// 95th percentile.
    pub p95: f64,
}

impl Recording {
    /// Advances `sim` and records its outputs at its present time, every `interval` seconds after, and at `until` (s).
    /// `keep_going` is called after every record, which is the last one of the recording, and ends the run by returning false.
    ///
    /// # Errors
    /// [`Status::BadValue`] for an interval that is not positive or gives too many records, and as
    /// [`Sim::advance_to`]; what was recorded before is kept in `self`.
    pub fn run(
        &mut self,
        sim: &mut Sim,
        until: f64,
        interval: f64,
        mut keep_going: impl FnMut(&Sim, &Self) -> bool,
    ) -> Result<()> {
        let start = sim.time();
        let records = (until - start) / interval;
        if !(interval > 0.0 && records <= MAX_RECORDS) {
            let text = format!(
                "interval: {interval:?} s from {start:?} s to {until:?} s is not 1 to {MAX_RECORDS:e} records"
            );
            return Err(Error::new(Status::BadValue, text));
        }
        let model = sim.model().clone();
        self.columns.resize(model.recorded().len(), Vec::new());
        self.intervals.resize(model.watched().len(), Vec::new());
        let mut row = vec![0.0; sim.channels().len()];
        sim.begin_interval();
        // Records at multiples of the interval, without adding up its round-off.
        let last = (records * (1.0 + 1e-12)).floor() as u64;
        // And at the end, where that is between two of them.
        let rest = u64::from(until - (start + last as f64 * interval) > 1e-9 * interval);
        for i in 0..=last + rest {
            sim.advance_to((start + i as f64 * interval).min(until))?;
            sim.outputs(&mut row)?;
            self.times.push(sim.time());
            for (column, place) in self.columns.iter_mut().zip(model.recorded()) {
                column.push(row[*place]);
            }
            for (place, column) in self.intervals.iter_mut().enumerate() {
                column.push(sim.interval_of(place)?);
            }
            sim.begin_interval();
            if !keep_going(sim, self) {
                break;
            }
        }
        Ok(())
    }

    /// Index of the first record at or after time `t` in s.
    pub fn index_at(&self, t: f64) -> usize {
        self.times.partition_point(|&x| x < t)
    }

    /// What the watched channel at `place` did from the first record at or after time `from` (s) on; `None` when no time has
    /// passed.
    pub fn interval(&self, place: usize, from: f64) -> Option<Interval> {
        let (first, rest) = self.intervals.get(place)?.get(self.index_at(from) + 1..)?.split_first()?;
        Some(rest.iter().fold(*first, |sum, next| sum.joined(next)))
    }

    /// Statistics of column `column` from time `from` (s) on; `None` when it holds no record.
    pub fn spread(&self, column: usize, from: f64) -> Option<Spread> {
        let values = self.columns.get(column)?.get(self.index_at(from)..)?;
        Spread::of(values)
    }
}

impl Spread {
    /// Statistics of some values; `None` when there are none.
    pub fn of(values: &[f64]) -> Option<Self> {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let (min, max) = (*sorted.first()?, *sorted.last()?);
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let variance = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / n;
        let sample = Sample::of_series(values);
        let percentile = |p: f64| {
            let place = p * (n - 1.0);
            let (low, share) = (place.floor() as usize, place.fract());
            let high = (low + 1).min(sorted.len() - 1);
            sorted[low] + share * (sorted[high] - sorted[low])
        };
        Some(Self {
            mean,
            deviation: variance.sqrt(),
            standard_error: sample.map_or(0.0, |sample| sample.standard_error()),
            stationary: sample.is_some_and(|sample| sample.stationary),
            min,
            max,
            p05: percentile(0.05),
            p95: percentile(0.95),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spread_of_known_values() {
        let values: Vec<f64> = (0..=100).map(f64::from).collect();
        let s = Spread::of(&values).unwrap();
        assert_eq!((s.mean, s.min, s.max, s.p05, s.p95), (50.0, 0.0, 100.0, 5.0, 95.0));
        assert!((s.deviation - 850f64.sqrt()).abs() < 1e-12);
        assert_eq!(Spread::of(&[]), None);
    }
}
