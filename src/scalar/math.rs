//! Elementary functions of plain numbers for all of `f64`, built on [`elementary`]: the library calls no
//! others, because those of the system differ in their last bit from processor to processor.
//!
//! Errors are below 3 units in the last place; those of powers grow with their exponent.

use super::elementary::{self, ANGLE_LARGEST};
use std::f64::consts::{LN_10, LOG10_E, PI, TAU};

/// What pi lacks.
const PI_LOW: f64 = 1.224_646_799_147_353_2e-16;
/// Smallest normal number, and a factor for smaller ones with its logarithm.
const NORMAL: f64 = f64::MIN_POSITIVE;
const LIFT: (f64, f64) = (18_014_398_509_481_984.0, 37.429_947_750_237_05);

/// Sine and cosine.
#[inline]
pub fn sin_cos(x: f64) -> (f64, f64) {
    if x.abs() <= ANGLE_LARGEST { elementary::sin_cos(x) } else { elementary::sin_cos(x % TAU) }
}

/// Sine.
#[inline]
pub fn sin(x: f64) -> f64 {
    sin_cos(x).0
}

/// Cosine.
#[inline]
pub fn cos(x: f64) -> f64 {
    sin_cos(x).1
}

/// Arc tangent.
pub fn atan(x: f64) -> f64 {
    elementary::atan(x.abs()).copysign(x)
}

/// Four-quadrant arc tangent of y/x, rad.
#[inline]
pub fn atan2(y: f64, x: f64) -> f64 {
    let (a, b) = (y.abs(), x.abs());
    // Zeros and infinities have the quotient that their signs leave.
    let ratio = if a == b { if a == 0.0 { 0.0 } else { 1.0 } } else { a / b };
    let angle = elementary::atan(ratio);
    let angle = if x.is_sign_negative() { PI - (angle - PI_LOW) } else { angle };
    if x.is_nan() || y.is_nan() { f64::NAN } else { angle.copysign(y) }
}

/// Arc sine.
pub fn asin(x: f64) -> f64 {
    atan2(x, ((1.0 - x) * (1.0 + x)).sqrt())
}

/// sqrt(x^2 + y^2) without overflow or underflow.
#[inline]
pub fn hypot(x: f64, y: f64) -> f64 {
    let size = x.abs().max(y.abs());
    if size > 1e-140 && size < 1e140 {
        (x * x + y * y).sqrt()
    } else if size == 0.0 || size.is_infinite() {
        // NaN stays.
        size + 0.0 * (if x.is_nan() || y.is_nan() { f64::NAN } else { 0.0 })
    } else {
        let (x, y) = (x / size, y / size);
        size * (x * x + y * y).sqrt()
    }
}

/// Natural logarithm; of zero minus infinity, of negative numbers NaN.
#[inline]
pub fn ln(x: f64) -> f64 {
    if (NORMAL..=f64::MAX).contains(&x) {
        elementary::ln(x)
    } else if x > 0.0 && x < NORMAL {
        elementary::ln(x * LIFT.0) - LIFT.1
    } else if x == 0.0 {
        f64::NEG_INFINITY
    } else {
        // Infinity stays, what is negative or NaN becomes NaN.
        x - if x > 0.0 { 0.0 } else { f64::NAN }
    }
}

/// ln(1 + x) for x >= 0.
#[inline]
pub fn ln_1p(x: f64) -> f64 {
    elementary::ln_1p(x)
}

/// Logarithm to the base 10.
pub fn log10(x: f64) -> f64 {
    ln(x) * LOG10_E
}

/// Exponential; zero and infinity beyond the range of normal numbers.
#[inline]
pub fn exp(x: f64) -> f64 {
    let [low, high] = elementary::EXP_RANGE;
    if x >= low && x <= high {
        elementary::exp(x)
    } else if x < low {
        0.0
    } else {
        // Infinity, or NaN.
        x * f64::INFINITY
    }
}

/// x^p of x >= 0.
#[inline]
pub fn powf(x: f64, p: f64) -> f64 {
    if x == 0.0 && p > 0.0 { 0.0 } else { exp(p * ln(x)) }
}

/// 10^x.
pub fn ten_to(x: f64) -> f64 {
    exp(x * LN_10)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Difference in units in the last place of the larger.
    fn units(ours: f64, system: f64) -> f64 {
        if ours == system || ours.is_nan() && system.is_nan() {
            return 0.0;
        }
        let size = ours.abs().max(system.abs()).max(f64::MIN_POSITIVE);
        (ours - system).abs() / (size.next_up() - size)
    }

    #[test]
    fn functions_agree_with_those_of_the_system() {
        let sizes = (-300..300).map(|k| 1.37f64.powi(k));
        let numbers: Vec<f64> = sizes.flat_map(|x| [x, -x, 1.1 * x]).chain([0.0, -0.0, 1.0, -1.0]).collect();
        for &x in &numbers {
            assert!(units(atan(x), x.atan()) <= 1.0, "atan {x}: {} {}", atan(x), x.atan());
            assert!(units(ln(x), x.ln()) <= 2.0, "ln {x}: {} {}", ln(x), x.ln());
            assert!(units(log10(x), x.log10()) <= 4.0, "log10 {x}: {} {}", log10(x), x.log10());
            if x.abs() < 700.0 {
                assert!(units(exp(x), x.exp()) <= 2.0, "exp {x}: {} {}", exp(x), x.exp());
            }
            if x.abs() <= 1.0 {
                assert!(units(asin(x), x.asin()) <= 4.0, "asin {x}: {} {}", asin(x), x.asin());
            }
            if x.abs() < ANGLE_LARGEST {
                let ((s, c), (sin, cos)) = (sin_cos(x), x.sin_cos());
                assert!((s - sin).abs() <= 3e-16 && (c - cos).abs() <= 3e-16, "{x}");
            }
            for &y in numbers.iter().step_by(7) {
                assert!(
                    units(atan2(y, x), y.atan2(x)) <= 2.0,
                    "atan2 {y} {x}: {} {}",
                    atan2(y, x),
                    y.atan2(x)
                );
                assert!(units(hypot(x, y), x.hypot(y)) <= 2.0, "hypot {x} {y}");
            }
            if x > 1e-3 && x < 1e3 {
                assert!((powf(x, 0.9) / x.powf(0.9) - 1.0).abs() < 4e-15, "{x}");
                assert!((ten_to(0.1 * x) / 10f64.powf(0.1 * x) - 1.0).abs() < 1e-13, "{x}");
            }
        }
        for x in [1e7, -3e8, 1e12] {
            let ((s, c), (sin, cos)) = (sin_cos(x), x.sin_cos());
            assert!((s - sin).abs() < 1e-16 * x.abs() && (c - cos).abs() < 1e-16 * x.abs(), "{x}");
        }
    }

    #[test]
    fn ends_of_the_range_are_those_of_the_system() {
        let ends = [0.0, -0.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 5e-324, f64::MAX];
        let same = |ours: f64, system: f64| units(ours, system) <= 2.0;
        for x in ends {
            assert!(same(ln(x), x.ln()) && same(atan(x), x.atan()), "{x}: {} {}", ln(x), x.ln());
            assert!(same(exp(x), x.exp()), "{x}: {}", exp(x));
            for y in ends {
                assert!(same(atan2(y, x), y.atan2(x)), "{y} {x}: {} {}", atan2(y, x), y.atan2(x));
                assert_eq!(atan2(y, x).is_sign_negative(), y.atan2(x).is_sign_negative(), "{y} {x}");
                let unlike = (x.is_nan() && y.is_infinite()) || (y.is_nan() && x.is_infinite());
                assert!(unlike || same(hypot(x, y), x.hypot(y)), "{x} {y}: {}", hypot(x, y));
            }
        }
        assert_eq!((exp(-800.0), exp(800.0), powf(0.0, 0.9)), (0.0, f64::INFINITY, 0.0));
    }
}
