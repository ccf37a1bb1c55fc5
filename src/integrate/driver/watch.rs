//! Quantities that the host watches: their values in every step, and their extremes and integrals over an interval of time.
//!
//! A step counts in every interval that it touches: its extremes whole, its integrals by the share of its time. So no peak
//! is lost between two records, and the integrals over adjacent intervals add up to that over all of them.

/// Watched quantities in one step: values at a few places of it, whose weights give the mean over the step.
#[derive(Clone, Debug, Default)]
pub struct Samples {
    /// One row of all quantities per place.
    values: Vec<f64>,
    count: usize,
    weights: &'static [f64],
}

impl Samples {
    /// Room for `count` quantities at up to `places` places.
    pub(in crate::integrate) fn new(count: usize, places: usize) -> Self {
        Self { values: vec![0.0; count * places], count, weights: &[] }
    }

    /// Number of quantities.
    pub(in crate::integrate) fn count(&self) -> usize {
        self.count
    }

    /// The values at a place, to be written; `None` if nothing is watched.
    pub(in crate::integrate) fn row(&mut self, place: usize) -> Option<&mut [f64]> {
        let from = place * self.count;
        self.values.get_mut(from..from + self.count).filter(|row| !row.is_empty())
    }

    /// The step is complete: these are the weights of its first places. They add up to one.
    pub(in crate::integrate) fn weigh(&mut self, weights: &'static [f64]) {
        self.weights = weights;
    }

    /// Becomes a copy of another one of as many quantities.
    pub(in crate::integrate) fn copy(&mut self, other: &Self) {
        self.weights = other.weights;
        self.count = other.count;
        self.values.clear();
        self.values.extend_from_slice(&other.values[..other.weights.len() * other.count]);
    }

    fn rows(&self) -> impl Iterator<Item = (f64, &[f64])> {
        self.weights.iter().copied().zip(self.values.chunks_exact(self.count.max(1)))
    }
}

/// Extremes and integrals of one quantity over an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Total {
    /// Smallest value.
    pub min: f64,
    /// Largest value.
    pub max: f64,
    /// Integral over time.
    pub integral: f64,
    /// Integral of the positive values.
    pub positive: f64,
}

/// Totals of all watched quantities over an interval that grows.
#[derive(Clone, Debug, Default)]
pub(in crate::integrate) struct Tally {
    min: Vec<f64>,
    max: Vec<f64>,
    integral: Vec<f64>,
    positive: Vec<f64>,
    /// Start and present end of the interval, s.
    pub(in crate::integrate) from: f64,
    to: f64,
}

impl Tally {
    pub(in crate::integrate) fn new(count: usize) -> Self {
        let column = || vec![0.0; count];
        Self { min: column(), max: column(), integral: column(), positive: column(), from: 0.0, to: 0.0 }
    }

    /// Whether nothing is watched.
    pub(in crate::integrate) fn is_empty(&self) -> bool {
        self.min.is_empty()
    }

    /// Of one quantity; `None` of no time.
    pub(in crate::integrate) fn total(&self, i: usize) -> Option<Total> {
        let (min, max) = (self.min[i], self.max[i]);
        (min <= max).then(|| Total { min, max, integral: self.integral[i], positive: self.positive[i] })
    }

    /// Begins an interval at time `t` (s).
    pub(in crate::integrate) fn begin(&mut self, t: f64) {
        self.min.fill(f64::INFINITY);
        self.max.fill(f64::NEG_INFINITY);
        self.integral.fill(0.0);
        self.positive.fill(0.0);
        (self.from, self.to) = (t, t);
    }

    /// Adds what of the step from `from` to `to` (s) lies behind the end of the interval and not behind `until`.
    pub(in crate::integrate) fn add(&mut self, [from, to]: [f64; 2], samples: &Samples, until: f64) {
        let (begin, end) = (self.to.max(from), until.min(to));
        if end <= begin {
            return;
        }
        self.to = end;
        for (weight, row) in samples.rows() {
            let time = weight * (end - begin);
            let extremes = self.min.iter_mut().zip(&mut self.max);
            let integrals = self.integral.iter_mut().zip(&mut self.positive);
            for (((min, max), (integral, positive)), &x) in extremes.zip(integrals).zip(row) {
                *min = if x < *min { x } else { *min };
                *max = if x > *max { x } else { *max };
                *integral += time * x;
                *positive += time * if x > 0.0 { x } else { 0.0 };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_add_up_and_lose_no_peak() {
        let mut samples = Samples::new(2, 3);
        let mut totals = |cuts: &[f64]| {
            let mut tally = Tally::new(2);
            tally.begin(0.25);
            let nothing = Total { min: f64::INFINITY, max: f64::NEG_INFINITY, integral: 0.0, positive: 0.0 };
            let mut all = vec![nothing; 2];
            let mut cuts = cuts.iter().copied().chain([3.5]).peekable();
            for step in 0..4 {
                let from = f64::from(step);
                for place in 0..3 {
                    let x = f64::from(step * 3 + place as i32) - 4.0;
                    samples.row(place).unwrap().copy_from_slice(&[x, -x * x]);
                }
                samples.weigh(&[0.25, 0.5, 0.25]);
                while let Some(cut) = cuts.next_if(|cut| *cut <= from + 1.0) {
                    tally.add([from, from + 1.0], &samples, cut);
                    for (i, all) in all.iter_mut().enumerate() {
                        let part = tally.total(i).unwrap_or(nothing);
                        *all = Total {
                            min: all.min.min(part.min),
                            max: all.max.max(part.max),
                            integral: all.integral + part.integral,
                            positive: all.positive + part.positive,
                        };
                    }
                    tally.begin(cut);
                }
                tally.add([from, from + 1.0], &samples, f64::INFINITY);
            }
            all
        };
        let whole = totals(&[]);
        assert_eq!(whole[0].min, -4.0);
        // The last step counts half, its extremes whole.
        assert_eq!((whole[0].max, whole[1].min), (7.0, -49.0));
        assert_eq!(whole[0].integral, 0.75 * -3.0 + 0.0 + 3.0 + 0.5 * 6.0);
        assert_eq!((whole[1].positive, whole[1].max), (0.0, 0.0));
        for cuts in [&[0.5, 1.0, 1.125][..], &[0.3, 2.9, 3.0, 3.1], &[2.0]] {
            for (part, whole) in totals(cuts).iter().zip(&whole) {
                assert_eq!((part.min, part.max), (whole.min, whole.max));
                assert!((part.integral - whole.integral).abs() < 1e-14, "{part:?} {whole:?}");
                assert!((part.positive - whole.positive).abs() < 1e-14, "{part:?} {whole:?}");
            }
        }
        assert_eq!(Samples::new(0, 3).row(0), None);
    }
}
