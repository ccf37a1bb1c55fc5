//! Elementary functions without branches and calls, for one number or several side by side.
//!
//! ```text
//! exp x  = 2^k e^r,        k = round(x/ln 2),  |r| <= ln(2)/2,   Taylor polynomial of degree 13
//! ln x   = k ln 2 + ln m,  m from sqrt(1/2) to sqrt(2),          ln m = 2 artanh s, s = (m - 1)/(m + 1)
//! sin, cos: x = n pi/2 + r,  |r| <= pi/4,                        Taylor polynomials
//! atan x = atan c + atan((x - c)/(1 + c x)),  c = 0, 1/2, 1, 3/2 or infinity
//! ```
//!
//! Errors are below 2 units in the last place, 3 for the hyperbolic tangent (tested). Only basic operations are used,
//! each rounded by itself: results are the same with every instruction set.
//!
//! Sources: Cody and Waite, Software Manual for the Elementary Functions (splitting of ln 2 and pi/2); the polynomials of
//! the logarithm and, with its intervals, of the arc tangent are those of Sun's fdlibm.

use super::Base;
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, LN_2, LOG2_E};

/// Adding and subtracting it rounds to an integer: 1.5 * 2^52.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// ln 2 in two parts, the first with so few bits that its products with exponents are exact.
const LN_2_HIGH: f64 = 6.931_471_803_691_238e-1;
const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;
/// pi/2 in three parts of 33 bits and more.
const HALF_PI: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];

/// Range of [`exp`]: beyond it the result is that at its end.
pub const EXP_RANGE: [f64; 2] = [-708.0, 709.0];
/// Largest magnitude that [`sin_cos`] reduces with full accuracy.
pub const ANGLE_LARGEST: f64 = 1e6;

/// c_0 + c_1 x + c_2 x^2 + ...
#[inline(always)]
fn polynomial<T: Base>(x: T, c: &[f64]) -> T {
    let mut sum = x.splat(0.0);
    for c in c.iter().rev() {
        sum = sum * x + *c;
    }
    sum
}

/// Exponential within [`EXP_RANGE`].
#[inline(always)]
pub fn exp<T: Base>(x: T) -> T {
    let x = x.within(EXP_RANGE);
    let k = (x * LOG2_E + ROUND) - ROUND;
    let r = (x - k * LN_2_HIGH) - k * LN_2_LOW;
    let r2 = r * r;
    let r4 = r2 * r2;
    let low = (r * (1.0 / 6.0) + 0.5) + r2 * (r * (1.0 / 120.0) + 1.0 / 24.0);
    let middle = (r * (1.0 / 5040.0) + 1.0 / 720.0) + r2 * (r * (1.0 / 362_880.0) + 1.0 / 40_320.0);
    let high = (r * (1.0 / 39_916_800.0) + 1.0 / 3_628_800.0)
        + r2 * (r * (1.0 / 6_227_020_800.0) + 1.0 / 479_001_600.0);
    let p = (r + r2 * (low + r4 * (middle + r4 * high))) + 1.0;
    p * k.power_of_two()
}

/// Natural logarithm of normal numbers > 0. Of anything else but NaN it is meaningless.
#[inline(always)]
pub fn ln<T: Base>(x: T) -> T {
    let (k, m) = x.split();
    let f = m - 1.0;
    let s = f / (m + 1.0);
    let z = s * s;
    let w = z * z;
    let odd = z
        * (w * (w * (w * 1.479_819_860_511_658_6e-1 + 1.818_357_216_161_805e-1) + 2.857_142_874_366_239e-1)
            + 6.666_666_666_666_735e-1);
    let even =
        w * (w * (w * 1.531_383_769_920_937_3e-1 + 2.222_219_843_214_978_4e-1) + 3.999_999_999_940_942e-1);
    let half = f * f * 0.5;
    let y = k * LN_2_HIGH - ((half - (s * (half + (odd + even)) + k * LN_2_LOW)) - f);
    // Zero, or NaN.
    let nothing = x * 0.0;
    y + nothing
}

/// ln(1 + x) for x >= 0, accurate near zero.
#[inline(always)]
pub fn ln_1p<T: Base>(x: T) -> T {
    let u = x + 1.0;
    let lost = x - (u - 1.0);
    ln(u) + lost / u
}

/// Hyperbolic tangent.
#[inline(always)]
pub fn tanh<T: Base>(x: T) -> T {
    let z = x * x;
    // Lambert's continued fraction, for small arguments; the exponential would lose their digits.
    let p = x * polynomial(z, &[2_027_025.0, 270_270.0, 6930.0, 36.0]);
    let q = polynomial(z, &[2_027_025.0, 945_945.0, 51_975.0, 630.0, 1.0]);
    let size = x.abs();
    let e = exp(size.within([0.0, 20.0]) * 2.0);
    let large = (e - 1.0) / (e + 1.0);
    T::select(size.below(0.4), p / q, T::select(x.below(0.0), -large, large))
}

/// Inverse hyperbolic sine of x >= 0.
#[inline(always)]
pub fn asinh<T: Base>(x: T) -> T {
    // Beyond it the square would overflow, and asinh x = ln 2x.
    let huge = x.above(1e100);
    let bounded = T::select(huge, x.splat(1.0), x);
    let square = bounded * bounded;
    let near = ln_1p(bounded + square / ((square + 1.0).sqrt() + 1.0));
    T::select(huge, ln(x) + LN_2, near)
}

/// Sine and cosine, for magnitudes up to [`ANGLE_LARGEST`].
#[inline(always)]
pub fn sin_cos<T: Base>(x: T) -> (T, T) {
    let n = (x * FRAC_2_PI + ROUND) - ROUND;
    let r = ((x - n * HALF_PI[0]) - n * HALF_PI[1]) - n * HALF_PI[2];
    let z = r * r;
    const SIN: [f64; 7] = [
        -1.0 / 6.0,
        1.0 / 120.0,
        -1.0 / 5040.0,
        1.0 / 362_880.0,
        -1.0 / 39_916_800.0,
        1.0 / 6_227_020_800.0,
        -1.0 / 1_307_674_368_000.0,
    ];
    const COS: [f64; 7] = [
        1.0 / 24.0,
        -1.0 / 720.0,
        1.0 / 40_320.0,
        -1.0 / 3_628_800.0,
        1.0 / 479_001_600.0,
        -1.0 / 87_178_291_200.0,
        1.0 / 20_922_789_888_000.0,
    ];
    let sin = r + r * z * polynomial(z, &SIN);
    let cos = (z * z * polynomial(z, &COS) - z * 0.5) + 1.0;
    // n modulo 4, from -2 to 2.
    let quarter = n - ((n * 0.25 + ROUND) - ROUND) * 4.0;
    let odd = (quarter * quarter).below(2.0) & (quarter * quarter).above(0.5);
    let (a, b) = (T::select(odd, cos, sin), T::select(odd, sin, cos));
    // Negative for n modulo 4 of 2 and 3, and of 1 and 2.
    let opposite = (quarter * quarter).above(2.0);
    let sin_falls = opposite | (quarter.below(-0.5));
    let cos_falls = opposite | (quarter.above(0.5));
    (T::select(sin_falls, -a, a), T::select(cos_falls, -b, b))
}

/// Arc tangents of 1/2, 1, 3/2 and infinity, each in two parts.
const ARC: [[f64; 2]; 4] = [
    [0.463_647_609_000_806_1, 2.269_877_745_296_168_7e-17],
    [FRAC_PI_4, 3.061_616_997_868_383e-17],
    [0.982_793_723_247_329, 1.390_331_103_123_099_8e-17],
    [FRAC_PI_2, 6.123_233_995_736_766e-17],
];

/// Arc tangent of x >= 0.
#[inline(always)]
pub fn atan<T: Base>(x: T) -> T {
    const ODD: [f64; 6] = [
        3.333_333_333_333_293e-1,
        1.428_571_427_250_346_6e-1,
        9.090_887_133_436_507e-2,
        6.661_073_137_387_531e-2,
        4.976_877_994_615_932_4e-2,
        1.628_582_011_536_578_2e-2,
    ];
    const EVEN: [f64; 5] = [
        -1.999_999_999_987_648_3e-1,
        -1.111_111_040_546_235_6e-1,
        -7.691_876_205_044_83e-2,
        -5.833_570_133_790_573e-2,
        -3.653_157_274_421_691_6e-2,
    ];
    let one = x.splat(1.0);
    let above = by_interval(x, [x, x * 2.0 - 1.0, x - 1.0, x - 1.5, -one]);
    let below = by_interval(x, [one, x + 2.0, x + 1.0, x * 1.5 + 1.0, x]);
    let high = by_interval(x, constants(x, 0));
    let low = by_interval(x, constants(x, 1));
    let r = above / below;
    let z = r * r;
    let w = z * z;
    let (odd, even) = (z * polynomial(w, &ODD), w * polynomial(w, &EVEN));
    high - ((r * (odd + even) - low) - r)
}

/// The one that belongs to the interval of x.
#[inline(always)]
fn by_interval<T: Base>(x: T, [zero, half, one, more, infinite]: [T; 5]) -> T {
    let large = T::select(x.below(2.4375), more, infinite);
    let medium = T::select(x.below(1.1875), one, large);
    T::select(x.below(0.4375), zero, T::select(x.below(0.6875), half, medium))
}

#[inline(always)]
fn constants<T: Base>(x: T, part: usize) -> [T; 5] {
    let [half, one, more, infinite] = ARC;
    [x.splat(0.0), x.splat(half[part]), x.splat(one[part]), x.splat(more[part]), x.splat(infinite[part])]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Real;

    /// Largest error in units in the last place over `n` arguments between two, evenly spaced by `map`.
    fn error(from: f64, to: f64, map: fn(f64) -> f64, ours: fn(f64) -> f64, theirs: fn(f64) -> f64) -> f64 {
        const N: usize = 200_000;
        (0..=N).fold(0.0, |largest: f64, i| {
            let x = map(from + (to - from) * i as f64 / N as f64);
            let (y, exact) = (ours(x), theirs(x));
            let unit = exact.abs().next_up() - exact.abs();
            largest.max((y - exact).abs() / unit)
        })
    }

    fn same(x: f64) -> f64 {
        x
    }

    /// Also covers one unit that the functions of the standard library may be off.
    const UNITS: f64 = 2.0;

    #[test]
    fn errors_are_in_the_last_place() {
        let tiny = |x: f64| 10f64.powf(x);
        for (name, e) in [
            ("exp", error(-700.0, 709.0, same, exp, f64::exp)),
            ("exp near 0", error(-1.0, 1.0, same, exp, f64::exp)),
            ("ln", error(-300.0, 300.0, tiny, ln, f64::ln)),
            ("ln near 1", error(0.5, 2.0, same, ln, f64::ln)),
            ("ln_1p", error(-20.0, 20.0, tiny, ln_1p, f64::ln_1p)),
            ("tanh", error(-3.0, 3.0, same, tanh, f64::tanh)),
            ("tanh of little", error(-30.0, 1.0, tiny, tanh, f64::tanh)),
            ("asinh", error(-300.0, 300.0, tiny, asinh, |x| x.asinh())),
            ("sin", error(-100.0, 100.0, same, |x| sin_cos(x).0, f64::sin)),
            ("atan", error(-20.0, 20.0, tiny, atan, f64::atan)),
            ("atan near 1", error(0.0, 3.0, same, atan, f64::atan)),
            ("cos", error(-100.0, 100.0, same, |x| sin_cos(x).1, f64::cos)),
        ] {
            println!("{name}: {e:.2} units in the last place");
            assert!(e <= if name.starts_with("tanh") { 3.0 } else { UNITS }, "{name}: {e}");
        }
    }

    #[test]
    fn large_angles_keep_their_digits() {
        let largest = (0..1_000_000).fold(0.0, |largest: f64, i| {
            let x = ANGLE_LARGEST * (f64::from(i) / 5e5 - 1.0);
            let (sin, cos) = sin_cos(x);
            largest.max((sin - x.sin()).abs()).max((cos - x.cos()).abs())
        });
        println!("large angles: {largest:e}");
        assert!(largest < 3e-16);
    }

    #[test]
    fn powers_follow_the_exponent() {
        for p in [-0.166, 0.1, 0.692, 10.0 / 9.0, 0.96] {
            for i in -120..=120 {
                let x = 10f64.powf(f64::from(i) * 0.1);
                assert!((Real::powf(x, p) / x.powf(p) - 1.0).abs() < 1e-14, "{x}^{p}");
            }
            assert!(p < 0.0 || Real::powf(0.0, p) == 0.0);
        }
    }

    #[test]
    fn special_values() {
        let (infinity, nan) = (f64::INFINITY, f64::NAN);
        assert_eq!((exp(0.0), exp(infinity), exp(-infinity)), (1.0, exp(709.0), exp(-708.0)));
        assert_eq!((ln(1.0), ln_1p(0.0), ln_1p(1e-300)), (0.0, 0.0, 1e-300));
        assert!((ln(f64::MIN_POSITIVE) / f64::MIN_POSITIVE.ln() - 1.0).abs() < 1e-15);
        assert_eq!((tanh(0.0), tanh(1e-300), tanh(infinity), tanh(-infinity)), (0.0, 1e-300, 1.0, -1.0));
        assert_eq!((asinh(0.0), asinh(1e-300)), (0.0, 1e-300));
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
        for f in [exp, ln, ln_1p, tanh, asinh, |x| sin_cos(x).0, |x| sin_cos(x).1] {
            assert!(f(nan).is_nan());
        }
    }
}
