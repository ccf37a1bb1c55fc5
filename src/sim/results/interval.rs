//! Extremes and integrals of watched channels between two times, from every step and not from records.

use crate::error::{Error, Result, Status};
use crate::integrate::Total;
use crate::sim::{Sim, bad_index};
use serde::Serialize;

/// A watched channel over an interval of time. Steps count in it by the share of their time, in the extremes whole. Forces
/// are those that acted in the steps: their integrals are the impulses that the bodies were given.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Interval {
    /// Start and end, s.
    pub from: f64,
    /// See `from`.
    pub to: f64,
    /// Smallest value.
    pub min: f64,
    /// Largest value.
    pub max: f64,
    /// Mean over time.
    pub mean: f64,
    /// Integral over time.
    pub integral: f64,
    /// Integral of its positive values.
    pub positive: f64,
}

impl Interval {
    /// This one and the one that follows it.
    #[must_use]
    pub fn joined(self, next: &Self) -> Self {
        let (from, to, integral) = (self.from, next.to, self.integral + next.integral);
        Self {
            from,
            to,
            min: self.min.min(next.min),
            max: self.max.max(next.max),
            mean: if to > from { integral / (to - from) } else { next.mean },
            integral,
            positive: self.positive + next.positive,
        }
    }
}

impl Sim {
    /// Places among [`Sim::channels`] of the channels that are watched: `record.extremes` of the scene.
    pub fn watched(&self) -> &[usize] {
        self.model().watched()
    }

    /// Begins at the present time the interval that [`Sim::interval`] is about. Setting the state, a reset and restoring do
    /// so, too.
    pub fn begin_interval(&mut self) {
        self.driver.begin_interval(self.time);
    }

    /// What channel `index` did since the last [`Sim::begin_interval`]. Of no time it has the present value.
    ///
    /// # Errors
    /// [`Status::BadIndex`]; [`Status::BadValue`] for a channel that is not watched; [`Status::BadState`] as
    /// [`Sim::output`].
    pub fn interval(&mut self, index: usize) -> Result<Interval> {
        let count = self.channels().len();
        let channel = self.channels().get(index).ok_or_else(|| bad_index("output", index, count))?;
        let Some(place) = self.watched().iter().position(|watched| *watched == index) else {
            let text = format!("output: {} is not among record.extremes of the scene", channel.name);
            return Err(Error::new(Status::BadValue, text));
        };
        self.interval_of(place)
    }

    /// As [`Sim::interval`], by the place among [`Sim::watched`].
    pub(in crate::sim) fn interval_of(&mut self, place: usize) -> Result<Interval> {
        let to = self.time;
        let (from, total) = self.driver.total_at(to, place);
        let Some(Total { min, max, integral, positive }) = total else {
            let value = self.output(self.watched()[place])?;
            return Ok(Interval {
                from,
                to,
                min: value,
                max: value,
                mean: value,
                integral: 0.0,
                positive: 0.0,
            });
        };
        Ok(Interval { from, to, min, max, mean: integral / (to - from), integral, positive })
    }
}
