//! The gap between a journal and its bush around the circumference, with lobes on one of them.
//!
//! ```text
//! h(d)   = (C - e) + 2 e sin^2(d/2) - w(d)
//! dh/dt  = -(v_1 cos d + v_2 sin d) - dw/dt + w_p dw/dd            at a fixed place
//! G(d)   = (w_1 + w_2) dh/dd + 2 dh/dt,   u_1 - u_2 = R (w_1 - w_2) - v_1 sin d + v_2 cos d
//! w(d)   = Sum A_n cos nd + B_n sin nd
//! ```
//!
//! d is counted from the direction of the eccentricity e, along which v_1 is; w_p is the speed at which the lobes turn. Written
//! so, a thin film keeps its digits. h and G are trigonometric polynomials of the highest order of the lobes; there is no
//! other limit to the shape.

use crate::laws::guide::journal::{Harmonic, JournalMotion};
use crate::scalar::{Base, elementary, math};

/// A wave of the surface, which thins the film by `height[0] cos(n d) + height[1] sin(n d)`.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::laws::guide) struct Lobe {
    /// n >= 2.
    pub order: u32,
    /// A_n and B_n, m.
    pub height: [f64; 2],
    /// Their rates in axes that turn with the surface, m/s.
    pub rate: [f64; 2],
}

/// Waves of one order of all that a bent surface does to its gap: the factors of cos(n d) and sin(n d).
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::laws::guide) struct Harmonics {
    /// Of h, m.
    pub film: [f64; 2],
    /// Of G, m/s.
    pub opening: [f64; 2],
    /// Of u_1 - u_2, m/s.
    pub sliding: [f64; 2],
    /// Whether all of them are zero: between the waves of a ring and a profile of high order there are many.
    pub still: bool,
}

/// The gap at one state, in axes along the eccentricity and across it.
pub(in crate::laws::guide) struct Gap<'a> {
    /// e, m.
    pub eccentricity: f64,
    /// C - e, m.
    pub thinnest: f64,
    /// v_1 and v_2, m/s.
    pub velocity: [f64; 2],
    /// w_1 + w_2, rad/s.
    pub turning: f64,
    /// R (w_1 - w_2), m/s.
    pub rolling: f64,
    /// Speed at which the lobes turn, rad/s.
    pub lobe_speed: f64,
    /// Factor of dh/dt in G: 2, or 0 for a film that is not squeezed.
    pub squeeze: f64,
    /// Factor of the speed of the centre in u_1 - u_2 of a surface that is not bent: 1, or 0 for a drag that turns only.
    pub drift: f64,
    /// Lobes in any order; those in ascending order take least time.
    pub lobes: &'a [Lobe],
    /// All of the gap but its mean by order, from one on, where the surface is bent; lobes do not count then. All but the first
    /// turn with the surface.
    pub harmonics: &'a [Harmonics],
}

/// The gap at one place, or at several.
#[derive(Clone, Copy)]
pub(in crate::laws::guide) struct Place<B> {
    /// Direction from the journal to the bush.
    pub cos: B,
    pub sin: B,
    /// h and its derivatives over d, m.
    pub film: [B; 4],
    /// The part of dh/dd that the lobes make, m.
    pub lobe_slope: B,
    /// G and its derivatives over d, m/s.
    pub opening: [B; 4],
    /// u_1 - u_2, m/s.
    pub sliding: B,
}

impl Lobe {
    /// Not less than any second derivative, m.
    pub fn curvature(&self) -> f64 {
        let (n, [a, b]) = (f64::from(self.order), self.height);
        n * n * (a * a + b * b).sqrt()
    }

    /// One harmonic of a profile that is turned by this angle, rad.
    pub fn of(harmonic: &Harmonic, turned: f64) -> Self {
        let Harmonic { order, amplitude, phase } = *harmonic;
        let (sin, cos) = math::sin_cos(f64::from(order) * turned + phase);
        Self { order, height: [amplitude * cos, -amplitude * sin], rate: [0.0; 2] }
    }
}

impl<'a> Gap<'a> {
    /// Of a journal of `radius` and a bush with this clearance, both in m, at an eccentricity `e` (m) in this direction.
    pub fn new(
        [radius, clearance]: [f64; 2],
        motion: &JournalMotion<f64>,
        e: f64,
        [cos, sin]: [f64; 2],
        lobes: &'a [Lobe],
    ) -> Self {
        let [vy, vz] = motion.velocity;
        Self {
            eccentricity: e,
            thinnest: clearance - e,
            velocity: [vy * cos + vz * sin, vz * cos - vy * sin],
            turning: motion.journal_speed + motion.bush_speed,
            rolling: radius * (motion.journal_speed - motion.bush_speed),
            lobe_speed: motion.profile_speed,
            squeeze: 2.0,
            drift: 1.0,
            lobes,
            harmonics: &[],
        }
    }

    /// That of a bent surface.
    #[inline(always)]
    fn bent_at<B: Base>(&self, d: B) -> Place<B> {
        let (sin, cos) = elementary::sin_cos(d);
        let zero = d.splat(0.0);
        let mut place = Place {
            cos,
            sin,
            film: [d.splat(self.thinnest), zero, zero, zero],
            lobe_slope: zero,
            opening: [zero; 4],
            sliding: d.splat(self.rolling),
        };
        let (mut n, mut wave, mut before) = (1.0, [cos, sin], [zero + 1.0, zero]);
        // The error of this recurrence grows with the square of the order, and stays that of the last bits of a wave.
        let twice = cos * 2.0;
        for of in self.harmonics {
            if !of.still {
                let [film, slope, bend, turn] = derivatives_of(wave, n, of.film);
                let [opening, opening_slope, opening_bend, opening_turn] =
                    derivatives_of(wave, n, of.opening);
                place.film[0] += film;
                place.film[1] += slope;
                place.film[2] += bend;
                place.film[3] += turn;
                place.opening[0] += opening;
                place.opening[1] += opening_slope;
                place.opening[2] += opening_bend;
                place.opening[3] += opening_turn;
                place.sliding += wave[0] * of.sliding[0] + wave[1] * of.sliding[1];
                if n > 1.0 {
                    place.lobe_slope += slope;
                }
            }
            let [c, s] = wave;
            (wave, before) = ([twice * c - before[0], twice * s - before[1]], wave);
            n += 1.0;
        }
        place
    }

    /// What the place of the journal does, unless a surface is bent: the wave of order one.
    pub fn first_harmonic(&self) -> Harmonics {
        let ([v_1, v_2], e) = (self.velocity, self.eccentricity);
        let opening = [-self.squeeze * v_1, self.turning * e - self.squeeze * v_2];
        Harmonics { film: [-e, 0.0], opening, sliding: [v_2, -v_1], still: false }
    }

    /// What a lobe does, but for the sliding of a bent surface.
    #[inline]
    pub fn harmonic_of(&self, lobe: &Lobe) -> Harmonics {
        let (n, [a, b], [a_rate, b_rate]) = (f64::from(lobe.order), lobe.height, lobe.rate);
        let slope = [-n * b, n * a];
        let closing = [a_rate + self.lobe_speed * slope[0], b_rate + self.lobe_speed * slope[1]];
        let opening = [0, 1].map(|k| self.turning * slope[k] - self.squeeze * closing[k]);
        Harmonics { film: [-a, -b], opening, sliding: [0.0; 2], still: false }
    }

    /// Mean of the film around the circle, m.
    pub fn mean(&self) -> f64 {
        self.thinnest + self.eccentricity
    }

    /// Whether it is that between two circles.
    pub fn is_round(&self) -> bool {
        self.lobes.is_empty() && self.harmonics.is_empty()
    }

    /// Highest order of h and G, at least 1.
    pub fn order(&self) -> u32 {
        self.lobes.iter().map(|lobe| lobe.order).fold(1, u32::max)
    }

    /// Largest height of lobes, m, and not less than any |G|, m/s.
    pub fn bounds(&self) -> [f64; 2] {
        let [mut height, mut slope, mut rate] = [0.0; 3];
        for lobe in self.lobes {
            let size = |[a, b]: [f64; 2]| (a * a + b * b).sqrt();
            height += size(lobe.height);
            slope += f64::from(lobe.order) * size(lobe.height);
            rate += size(lobe.rate);
        }
        let [v_1, v_2] = self.velocity;
        let closing = v_1.abs() + v_2.abs() + rate + self.lobe_speed.abs() * slope;
        [height, self.turning.abs() * (self.eccentricity + slope) + self.squeeze * closing]
    }

    /// The gap at `d`, rad, from -pi to pi.
    #[inline(always)]
    pub fn at<B: Base>(&self, d: B) -> Place<B> {
        if !self.harmonics.is_empty() {
            return self.bent_at(d);
        }
        let (sin_half, cos_half) = elementary::sin_cos(d * 0.5);
        let square = sin_half * sin_half;
        let (sin, cos) = (sin_half * cos_half * 2.0, -(square * 2.0) + 1.0);
        let e = self.eccentricity;
        let mut film = [square * (2.0 * e) + self.thinnest, sin * e, cos * e, -(sin * e), -(cos * e)];
        let [v_1, v_2] = self.velocity;
        let closing = cos * v_1 + sin * v_2;
        let across = sin * v_1 - cos * v_2;
        let mut rate = [-closing, across, closing, -across];
        let zero = d.splat(0.0);
        let mut lobe_slope = zero;
        // Cosine and sine of n d.
        let (mut n, mut wave) = (1, [cos, sin]);
        for lobe in self.lobes {
            if lobe.order < n {
                (n, wave) = (1, [cos, sin]);
            }
            while n < lobe.order {
                let [c, s] = wave;
                (n, wave) = (n + 1, [c * cos - s * sin, s * cos + c * sin]);
            }
            let (w, w_dot) = (derivatives(wave, n, lobe.height), derivatives(wave, n, lobe.rate));
            lobe_slope -= w[1];
            let square = f64::from(n) * f64::from(n);
            let w = [w[0], w[1], w[2], w[3], -(w[2] * square)];
            for k in 0..5 {
                film[k] -= w[k];
            }
            for k in 0..4 {
                rate[k] += w[k + 1] * self.lobe_speed - w_dot[k];
            }
        }
        let mut opening = [zero; 4];
        for k in 0..4 {
            opening[k] = film[k + 1] * self.turning + rate[k] * self.squeeze;
        }
        let film = [film[0], film[1], film[2], film[3]];
        let sliding = (cos * v_2 - sin * v_1) * self.drift + self.rolling;
        Place { cos, sin, film, lobe_slope, opening, sliding }
    }
}

/// a cos + b sin of order `n` with its derivatives.
#[inline(always)]
fn derivatives<B: Base>(wave: [B; 2], n: u32, factors: [f64; 2]) -> [B; 4] {
    derivatives_of(wave, f64::from(n), factors)
}

/// The same, with the order as a number.
#[inline(always)]
fn derivatives_of<B: Base>([cos, sin]: [B; 2], n: f64, [a, b]: [f64; 2]) -> [B; 4] {
    let (even, odd) = (cos * a + sin * b, cos * (n * b) - sin * (n * a));
    [even, odd, -(even * (n * n)), -(odd * (n * n))]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::guide::journal::tests::motion;

    fn lobes() -> [Lobe; 2] {
        let roundness = [
            Harmonic { order: 5, amplitude: 3e-6, phase: 0.4 },
            Harmonic { order: 2, amplitude: -8e-6, phase: 2.0 },
        ];
        roundness.map(|harmonic| Lobe::of(&harmonic, 0.6f64.asin() - 0.3))
    }

    fn gap(lobes: &[Lobe]) -> Gap<'_> {
        let m = motion([120e-6, 90e-6], [0.02, -0.1], 142.5);
        Gap::new([46e-3, 0.2e-3], &m, 150e-6, [0.8, 0.6], lobes)
    }

    #[test]
    fn derivatives_match_central_differences() {
        let (lobes, step) = (lobes(), 1e-5);
        let gap = gap(&lobes);
        for i in -30..30 {
            let d = 0.1 * f64::from(i);
            let [low, at, high] = [d - step, d, d + step].map(|d| gap.at(d));
            let check = |name: &str, exact: f64, [a, b]: [f64; 2], scale: f64| {
                let error = exact - (b - a) / (2.0 * step);
                assert!(error.abs() < 1e-8 * scale, "{name} at {d}: {exact} off by {error}");
            };
            for k in 0..3 {
                check("film", at.film[k + 1], [low.film[k], high.film[k]], 2e-3);
            }
            for k in 0..3 {
                check("opening", at.opening[k + 1], [low.opening[k], high.opening[k]], 1.0);
            }
        }
    }

    #[test]
    fn lobes_that_turn_are_lobes_that_grow_and_shrink() {
        let lobes = lobes();
        let turning = gap(&lobes);
        let rates = lobes.map(|lobe| {
            let [a, b] = lobe.height;
            let speed = f64::from(lobe.order) * turning.lobe_speed;
            Lobe { rate: [-speed * b, speed * a], ..lobe }
        });
        let growing = Gap { lobe_speed: 0.0, ..gap(&rates) };
        let [height, opening] = turning.bounds();
        for i in -30..30 {
            let d = 0.1 * f64::from(i);
            let (a, b) = (turning.at(d), growing.at(d));
            assert_eq!(a.film, b.film);
            for (a, b) in a.opening.into_iter().zip(b.opening) {
                assert!((a - b).abs() < 1e-14, "{a} {b}");
            }
            assert!(a.opening[0].abs() <= opening);
            assert!(a.film[0] >= turning.thinnest - height && height < 12e-6);
        }
    }
}
