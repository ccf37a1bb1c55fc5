//! The number type of the force laws.
//!
//! Every law in [`crate::laws`] is generic over [`Real`]: called with `f64` it gives a force, called with
//! [`Dual`] it gives the same force and its exact derivatives.

mod dual;

pub use dual::Dual;

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A real number, or a real number that carries derivatives.
///
/// Comparisons and branches in the laws look at [`Real::value`] only.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// A constant: all derivatives are zero.
    fn constant(value: f64) -> Self;
    /// The value without derivatives.
    fn value(self) -> f64;
    /// Square root; valid for values > 0.
    fn sqrt(self) -> Self;
    /// Natural logarithm; valid for values > 0.
    fn ln(self) -> Self;
    /// Exponential.
    fn exp(self) -> Self;
    /// `self^p` with a constant exponent; valid for values > 0, and at 0 for p >= 1.
    fn powf(self, p: f64) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// Inverse hyperbolic sine.
    fn asinh(self) -> Self;
    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);
    /// Four-quadrant arc tangent of `self / x`.
    fn atan2(self, x: Self) -> Self;

    /// `self * self`.
    fn squared(self) -> Self {
        self * self
    }
    /// Absolute value; the derivative at zero is that of `+self`.
    fn abs(self) -> Self {
        if self.value() < 0.0 { -self } else { self }
    }
    /// -1 for negative values, else +1; a plain number because its derivative is zero.
    fn sign(self) -> f64 {
        if self.value() < 0.0 { -1.0 } else { 1.0 }
    }
    /// The larger of the value and a constant floor.
    fn at_least(self, floor: f64) -> Self {
        if self.value() < floor { Self::constant(floor) } else { self }
    }
}

impl Real for f64 {
    fn constant(value: f64) -> Self {
        value
    }
    fn value(self) -> f64 {
        self
    }
    fn sqrt(self) -> Self {
        self.sqrt()
    }
    fn ln(self) -> Self {
        self.ln()
    }
    fn exp(self) -> Self {
        self.exp()
    }
    fn powf(self, p: f64) -> Self {
        self.powf(p)
    }
    fn tanh(self) -> Self {
        self.tanh()
    }
    fn asinh(self) -> Self {
        self.asinh()
    }
    fn sin_cos(self) -> (Self, Self) {
        self.sin_cos()
    }
    fn atan2(self, x: Self) -> Self {
        self.atan2(x)
    }
}

/// Smooth switch: 0 below `0`, 1 above `1`, `3x^2 - 2x^3` between (continuous first derivative).
pub fn smoothstep<T: Real>(x: T) -> T {
    if x.value() <= 0.0 {
        T::constant(0.0)
    } else if x.value() >= 1.0 {
        T::constant(1.0)
    } else {
        x * x * (-x * 2.0 + 3.0)
    }
}
