//! Pressure and viscosity of a short film, averaged over its width, with a viscosity that grows with pressure.
//!
//! ```text
//! q(t) = q_0 (1 - t^2)                       isoviscous pressure, t = 2 y/L from -1 to 1
//! p = -ln(1 - alpha q)/alpha                 Barus viscosity eta = eta_0 exp(alpha p), where s = alpha q_0 <= s_cap
//! p = p_c + (q - q_c)/(1 - s_cap)            its tangent where alpha q > s_cap
//! ```
//!
//! The logarithm ends at alpha q = 1, where a film that is squeezed hard enough arrives; the tangent goes on. It
//! equals a viscosity that stays at eta_0/(1 - s_cap) and leaves p convex with a continuous slope. The paper cuts p at
//! 1/alpha instead, so that its mean drops while the film is squeezed harder; that is not followed here.
//!
//! Both averages are closed. With t_c = sqrt(1 - s_cap/s), where the tangent begins (t_c = 0 and c = s below the
//! cap, c = s_cap above it),
//!
//! ```text
//! J = Int_{t_c}^1 dt/(1 - s + s t^2) = w Phi(z)/s,   w = c/(1 + t_c - c),   z = w^2 (1 - s)/s
//! mean alpha p = 2 (1 - t_c) - 2 (1 - s) J + (2/3) s t_c^3/(1 - s_cap)
//! mean eta/eta_0 = J + t_c/(1 - s_cap)
//! ```
//!
//! Phi(z) = atan(sqrt z)/sqrt z, which is atanh(sqrt -z)/sqrt -z for z < 0: one formula on both sides of s = 1.
//! Source: Takeshima et al. 2025, Eq. 5, 9 and 14, integrated by us.

use crate::scalar::{Base, Numeric};

/// Law of the viscosity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BarusFilm {
    /// alpha >= 0, 1/Pa; 0 is an isoviscous film.
    pub pressure_viscosity: f64,
    /// s_cap, value of alpha q above which p follows its tangent; between 0 and 1.
    pub cap: f64,
}

/// Averages over the width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WidthMean<T> {
    /// Mean pressure, Pa.
    pub pressure: T,
    /// Mean of eta/eta_0.
    pub viscosity: T,
}

impl BarusFilm {
    /// Averages where the isoviscous pressure is `peak` in the middle of the width, Pa; without pressure for `peak` <= 0.
    #[inline(always)]
    pub fn mean<T: Numeric>(&self, peak: T) -> WidthMean<T> {
        let (zero, one) = (peak.like(0.0), peak.like(1.0));
        let cavitated = peak.at_most(0.0);
        let s = T::select(cavitated, zero, peak * self.pressure_viscosity);
        if !T::Base::any(s.above(0.0)) {
            // Isoviscous everywhere; a NaN stays.
            return WidthMean {
                pressure: T::select(cavitated, zero, peak * (2.0 / 3.0)),
                viscosity: s + 1.0,
            };
        }
        // The square root has no derivative at the cap itself; this near to it both branches agree to round-off.
        let capped = s.above(self.cap * (1.0 + 1e-12));
        let mild = T::select(capped, zero, s);
        let inverse = one / (-mild + 1.0);
        let z = mild * inverse;
        let psi = psi(z);
        let mut out =
            WidthMean { pressure: peak * psi * inverse * 2.0, viscosity: (-(z * psi) + 1.0) * inverse };
        if T::Base::any(capped) {
            let steep = self.capped(T::select(capped, s, one));
            out.pressure = T::select(capped, steep.pressure, out.pressure);
            out.viscosity = T::select(capped, steep.viscosity, out.viscosity);
        }
        out.pressure = T::select(cavitated, zero, out.pressure);
        out
    }

    #[inline(always)]
    fn capped<T: Numeric>(&self, s: T) -> WidthMean<T> {
        let (cap, steep) = (self.cap, 1.0 / (1.0 - self.cap));
        let t = ((s - cap) / s).sqrt();
        let w = s.like(cap) / (t + (1.0 - cap));
        let beta = (-s + 1.0) / s;
        let z = beta * w * w;
        let j = w * (-(z * psi(z)) + 1.0);
        // 1 - t_c, without the cancellation of large s.
        let barus = s.like(cap) / (s * (t + 1.0)) - beta * j;
        let tangent = s * t * t * t * (steep / 3.0);
        WidthMean {
            pressure: (barus + tangent) * 2.0 / self.pressure_viscosity,
            viscosity: t * steep + j / s,
        }
    }
}

/// Below this, the series of [`psi`] holds to the last bit.
const SERIES: f64 = 4e-2;

/// (1 - Phi(z))/z = 1/3 - z/5 + z^2/7 - ..., for z > -1.
#[inline(always)]
fn psi<T: Numeric>(z: T) -> T {
    // Even and odd powers side by side: neither waits for the other.
    let square = z * z;
    let (mut even, mut odd) = (z.like(0.0), z.like(0.0));
    for pair in ODD_INVERSES.chunks_exact(2).rev() {
        (even, odd) = (even * square + pair[0], odd * square + pair[1]);
    }
    let mut out = even - odd * z;
    // Numbers that a function is not valid for are replaced by one that it is valid for.
    let spare = z.like(0.25);
    let positive = z.at_least(SERIES);
    if T::Base::any(positive) {
        let z = T::select(positive, z, spare);
        let root = z.sqrt();
        out = T::select(positive, (-(root.atan() / root) + 1.0) / z, out);
    }
    let negative = z.at_most(-SERIES);
    if T::Base::any(negative) {
        let z = T::select(negative, z, -spare);
        let root = (-z).sqrt();
        let phi = ((root + 1.0) / (-root + 1.0)).ln() * 0.5 / root;
        out = T::select(negative, (-phi + 1.0) / z, out);
    }
    out
}

/// 1/3, 1/5, 1/7, ...
const ODD_INVERSES: [f64; 12] = [
    1.0 / 3.0,
    1.0 / 5.0,
    1.0 / 7.0,
    1.0 / 9.0,
    1.0 / 11.0,
    1.0 / 13.0,
    1.0 / 15.0,
    1.0 / 17.0,
    1.0 / 19.0,
    1.0 / 21.0,
    1.0 / 23.0,
    1.0 / 25.0,
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Dual;

    const ALPHA: f64 = 2e-8;

    /// Nodes and weights of the five-point Gauss-Legendre rule on [-1, 1].
    const GAUSS_5: [(f64, f64); 5] = [
        (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
        (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (0.906_179_845_938_664, 0.236_926_885_056_189_08),
    ];

    /// Mean alpha p and eta/eta_0 from their definition, with panels that shrink towards the start of the logarithm.
    fn by_quadrature(s: f64, cap: f64) -> [f64; 2] {
        let start = if s > cap { (1.0 - cap / s).sqrt() } else { 0.0 };
        let mut ends = vec![0.0];
        ends.extend((0..=120).rev().map(|i| start + (1.0 - start) * 0.85f64.powi(i)));
        ends.push(1.0);
        let mut sum = [0.0; 2];
        for pair in ends.windows(2) {
            let (middle, half) = (0.5 * (pair[0] + pair[1]), 0.5 * (pair[1] - pair[0]));
            for (x, w) in GAUSS_5 {
                let q = s * (1.0 - (middle + half * x).powi(2));
                let p = if q > cap { -(-cap).ln_1p() + (q - cap) / (1.0 - cap) } else { -(-q).ln_1p() };
                sum[0] += w * half * p;
                sum[1] += w * half / (1.0 - q.min(cap));
            }
        }
        sum
    }

    #[test]
    fn averages_match_quadrature() {
        for cap in [0.5, 0.9, 0.99] {
            let film = BarusFilm { pressure_viscosity: ALPHA, cap };
            for s in [
                1e-12,
                1e-5,
                0.999e-3,
                1.001e-3,
                1.99e-3,
                2.01e-3,
                0.038,
                0.039,
                0.5,
                cap * (1.0 - 1e-9),
                cap * (1.0 + 1e-9),
                0.999999,
                1.0,
                1.000001,
                1.2,
                50.0,
                1e4,
            ] {
                let mean = film.mean(s / ALPHA);
                let [p, eta] = by_quadrature(s, cap);
                let errors = (mean.pressure * ALPHA / p - 1.0, mean.viscosity / eta - 1.0);
                assert!(errors.0.abs() < 1e-12 && errors.1.abs() < 1e-12, "{cap} {s}: {errors:?}");
            }
        }
    }

    #[test]
    fn isoviscous_limit() {
        let film = BarusFilm { pressure_viscosity: 0.0, cap: 0.9 };
        let mean = film.mean(3e7);
        assert!((mean.pressure / 2e7 - 1.0).abs() < 1e-15 && mean.viscosity == 1.0);
        let mean = film.mean(-1.0);
        assert_eq!((mean.pressure, mean.viscosity), (0.0, 1.0));
        let thin = BarusFilm { pressure_viscosity: 1e-14, ..film }.mean(3e7);
        assert!((thin.pressure / 2e7 - 1.0).abs() < 1e-6);
    }

    #[test]
    fn derivatives_match_central_differences() {
        let film = BarusFilm { pressure_viscosity: ALPHA, cap: 0.9 };
        for s in [1e-4, 0.02, 0.3, 0.8999, 0.9001, 1.0, 3.0, 1e3] {
            let d = film.mean(Dual::<1>::variable(s / ALPHA, 0));
            let step = 1e-6 * s;
            let (lo, hi) = (film.mean((s - step) / ALPHA), film.mean((s + step) / ALPHA));
            for (exact, difference) in [
                (d.pressure.eps[0], (hi.pressure - lo.pressure) / (2.0 * step) * ALPHA),
                (d.viscosity.eps[0], (hi.viscosity - lo.viscosity) / (2.0 * step) * ALPHA),
            ] {
                // Differences of a viscosity near 1 lose digits where s is small.
                let scale = difference.abs() + 1e-3 * ALPHA;
                assert!((exact - difference).abs() < 1e-5 * scale, "{s}: {exact} {difference}");
            }
        }
        let at_cap = film.mean(Dual::<1>::variable(0.9 / ALPHA, 0));
        assert!(at_cap.pressure.eps[0].is_finite() && at_cap.viscosity.eps[0].is_finite());
    }

    #[test]
    fn nan_stays_nan() {
        let film = BarusFilm { pressure_viscosity: ALPHA, cap: 0.9 };
        assert!(film.mean(f64::NAN).pressure.is_nan());
    }
}
