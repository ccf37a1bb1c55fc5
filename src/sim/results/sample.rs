//! How well a mean is known, and whether two of them differ.
//!
//! - Of runs that start differently: their means are independent, variance s^2/n.
//! - Of a series of one run: means of 20 batches. Their covariances c_k at lags k, summed up as long as they are positive, give
//!   the number of independent batches n = 20 c_0/(c_0 + 2 sum c_k), at least 2, and the variance c_0/(n - 1) of the mean (A. D. Sokal,
//!   "Monte Carlo methods in statistical mechanics", 1997; G. S. Fishman, "Grouping observations in digital simulation", 1978).
//! - Two of them are compared by Welch's interval with Student's quantile.

use crate::scalar::math;

/// Probability that a method without any error is outside of at least one band of a line of a table.
pub const LEVEL: f64 = 0.01;
/// Batches of a series.
const BATCHES: usize = 20;
/// A series with fewer independent batches than this drifts or swings as slowly as its window is long.
const FEWEST: f64 = 5.0;
/// A drift that stays below this share of the root mean square is none.
const NO_DRIFT: f64 = 1e-3;

/// Mean of a sample with the variance of that mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Mean.
    pub mean: f64,
    /// Variance of the mean.
    pub variance: f64,
    /// Number of independent values.
    pub count: f64,
    /// Of a series: whether its window is long enough for its mean and variance, with no drift or swing as long as itself.
    pub stationary: bool,
}

/// A difference of two means with the band that sampling noise explains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// Difference of the means.
    pub difference: f64,
    /// Half width of the band.
    pub band: f64,
}

impl Sample {
    /// Of independent values; `None` for less than two.
    pub fn of(values: &[f64]) -> Option<Self> {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|x| (x - mean) * (x - mean)).sum();
        let variance = squares / (count - 1.0) / count;
        (values.len() > 1).then_some(Self { mean, variance, count, stationary: true })
    }

    /// Of a series at equal distances in time; `None` for less than two values.
    pub fn of_series(values: &[f64]) -> Option<Self> {
        let (n, number) = (values.len(), values.len().min(BATCHES));
        let mean = values.iter().sum::<f64>() / n as f64;
        let batches: Vec<f64> = (0..number)
            .map(|i| &values[i * n / number..(i + 1) * n / number])
            .map(|batch| batch.iter().map(|x| x - mean).sum::<f64>() / batch.len() as f64)
            .collect();
        let covariance =
            |lag: usize| batches.iter().zip(&batches[lag..]).map(|(a, b)| a * b).sum::<f64>() / number as f64;
        let (scatter, number) = (covariance(0), number as f64);
        let related: f64 = (1..batches.len()).map(covariance).take_while(|c| *c > 0.0).sum();
        let count = if scatter > 0.0 { number * scatter / (scatter + 2.0 * related) } else { number };
        let count = count.max(2.0);
        let squares = values.iter().map(|x| x * x).sum::<f64>() / n as f64;
        let stationary = count >= FEWEST || scatter <= NO_DRIFT * NO_DRIFT * squares;
        (n > 1).then_some(Self { mean, variance: scatter / (count - 1.0), count, stationary })
    }

    /// Standard error of the mean.
    pub fn standard_error(&self) -> f64 {
        self.variance.sqrt()
    }

    /// Standard deviation of an independent value.
    pub fn deviation(&self) -> f64 {
        (self.variance * self.count).sqrt()
    }

    /// This sample against a reference, as one of `comparisons` that share `level` (Bonferroni).
    pub fn against(&self, reference: &Self, level: f64, comparisons: usize) -> Verdict {
        let [a, b] = [self, reference];
        let variance = a.variance + b.variance;
        let freedom =
            |s: &Self| if s.variance > 0.0 { s.variance * s.variance / (s.count - 1.0) } else { 0.0 };
        let freedoms = variance * variance / (freedom(a) + freedom(b));
        let quantile = if variance > 0.0 { student(level / comparisons as f64, freedoms) } else { 0.0 };
        Verdict { difference: a.mean - b.mean, band: quantile * variance.sqrt() }
    }
}

impl Verdict {
    /// Whether sampling noise explains the difference.
    pub fn inside(&self) -> bool {
        self.difference.abs() <= self.band
    }

    /// Difference in units of the band.
    pub fn ratio(&self) -> f64 {
        if self.difference == 0.0 { 0.0 } else { self.difference / self.band }
    }
}

/// The number that the magnitude of Student's t exceeds with probability `p`, at so many degrees of freedom.
pub fn student(p: f64, freedoms: f64) -> f64 {
    let tail = |t: f64| incomplete_beta(freedoms / (freedoms + t * t), 0.5 * freedoms, 0.5);
    let (mut low, mut high) = (0.0, 1.0);
    while tail(high) > p {
        high *= 2.0;
    }
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if tail(middle) > p { low = middle } else { high = middle }
    }
    high
}

/// Regularised incomplete beta function of x in 0 to 1.
fn incomplete_beta(x: f64, a: f64, b: f64) -> f64 {
    // The continued fraction converges fast on this side only.
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - incomplete_beta(1.0 - x, b, a);
    }
    if x <= 0.0 {
        return 0.0;
    }
    let factor = a * math::ln(x) + b * math::ln(1.0 - x) + ln_gamma(a + b) - ln_gamma(a) - ln_gamma(b);
    let floor = |x: f64| if x.abs() < 1e-300 { 1e-300 } else { x };
    let mut c = 1.0;
    let mut d = 1.0 / floor(1.0 - (a + b) * x / (a + 1.0));
    let mut fraction = d;
    for m in 1..1000 {
        let m = f64::from(m);
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        let before = fraction;
        for term in [even, odd] {
            d = 1.0 / floor(1.0 + term * d);
            c = floor(1.0 + term / c);
            fraction *= c * d;
        }
        if (fraction / before - 1.0).abs() < 1e-14 {
            break;
        }
    }
    math::exp(factor) * fraction / a
}

/// Logarithm of the gamma function of x > 0: Stirling's series from 20 on, and the recurrence below.
fn ln_gamma(x: f64) -> f64 {
    if x < 20.0 {
        return ln_gamma(x + 1.0) - math::ln(x);
    }
    let series = 1.0 / (12.0 * x) - 1.0 / (360.0 * x.powi(3)) + 1.0 / (1260.0 * x.powi(5));
    (x - 0.5) * math::ln(x) - x + 0.5 * math::ln(std::f64::consts::TAU) + series
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers without memory, uniform in -1 to 1.
    fn noise() -> impl Iterator<Item = f64> {
        let mut state = 1u64;
        std::iter::repeat_with(move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        })
    }

    /// With x(i + 1) = m x(i) + noise, the variance of a mean of n is s^2/(1 - m)^2/n.
    #[test]
    fn errors_of_series_with_memory_are_those_of_many_series() {
        for memory in [0.0, 0.9, 0.98] {
            let (mut noise, mut x, n, series) = (noise(), 0.0, 4000, 400);
            let samples: Vec<Sample> = (0..series)
                .map(|_| {
                    let values: Vec<f64> = (0..n)
                        .map(|_| {
                            x = memory * x + noise.next().unwrap_or_default();
                            x
                        })
                        .collect();
                    Sample::of_series(&values).expect("a series")
                })
                .collect();
            let exact = 1.0 / 3.0 / ((1.0 - memory) * (1.0 - memory)) / f64::from(n);
            let found = samples.iter().map(|s| s.variance).sum::<f64>() / f64::from(series);
            assert!((0.95..1.25).contains(&(found / exact)), "{memory}: {}", found / exact);
            let within = samples.iter().filter(|s| s.mean.abs() <= 3.0 * s.standard_error()).count();
            assert!(within >= 390, "{memory}: {within}");
            let settled = samples.iter().filter(|s| s.stationary).count();
            assert!(settled >= 390, "{memory}: {settled}");
        }
    }

    #[test]
    fn drifts_and_slow_swings_are_not_stationary() {
        let of = |f: &dyn Fn(f64) -> f64| {
            let values: Vec<f64> =
                noise().zip(0..600).map(|(x, i)| f(f64::from(i) / 600.0) + 0.1 * x).collect();
            Sample::of_series(&values).expect("a series")
        };
        assert!(of(&|_| 2.0).stationary && of(&|t| (60.0 * t).sin()).stationary);
        let (drift, swing) = (of(&|t| t), of(&|t| (6.3 * t).sin()));
        assert!(!drift.stationary && !swing.stationary);
        // Not known any better than a single value.
        assert!(drift.standard_error() > 0.15, "{drift:?}");
        // Fast swings cancel in a mean.
        assert!(of(&|t| (200.0 * t).sin()).standard_error() < 0.05);
        // A drift of next to nothing, and nothing at all.
        assert!(Sample::of_series(&[1.0, 1.0001, 1.0002, 1.0003]).expect("a series").stationary);
        let constant = Sample::of_series(&[3.0; 50]).expect("a series");
        assert_eq!((constant.variance, constant.stationary), (0.0, true));
        assert_eq!(Sample::of_series(&[1.0]), None);
    }
}
