//! Whether two samples have the same mean: Welch's interval with Student's quantile.

/// Probability that a method without any error is outside of at least one band of its line.
pub const LEVEL: f64 = 0.01;

/// Mean of a sample with the variance of that mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Mean.
    pub mean: f64,
    /// Variance of the mean.
    pub variance: f64,
    /// Number of independent values.
    pub count: usize,
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
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares: f64 = values.iter().map(|x| (x - mean) * (x - mean)).sum();
        let variance = squares / (n - 1.0) / n;
        (values.len() > 1).then_some(Self { mean, variance, count: values.len() })
    }

    /// Standard deviation of a value.
    pub fn deviation(&self) -> f64 {
        (self.variance * self.count as f64).sqrt()
    }

    /// This sample against a reference, as one of `comparisons` that share `level` (Bonferroni).
    pub fn against(&self, reference: &Self, level: f64, comparisons: usize) -> Verdict {
        let [a, b] = [self, reference];
        let variance = a.variance + b.variance;
        let freedom =
            |s: &Self| if s.variance > 0.0 { s.variance * s.variance / (s.count - 1) as f64 } else { 0.0 };
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
    let factor = a * x.ln() + b * (1.0 - x).ln() + ln_gamma(a + b) - ln_gamma(a) - ln_gamma(b);
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
    factor.exp() * fraction / a
}

/// Logarithm of the gamma function of x > 0: Stirling's series from 20 on, and the recurrence below.
fn ln_gamma(x: f64) -> f64 {
    if x < 20.0 {
        return ln_gamma(x + 1.0) - x.ln();
    }
    let series = 1.0 / (12.0 * x) - 1.0 / (360.0 * x.powi(3)) + 1.0 / (1260.0 * x.powi(5));
    (x - 0.5) * x.ln() - x + 0.5 * std::f64::consts::TAU.ln() + series
}
