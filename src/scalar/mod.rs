//! The number types of the force laws.
//!
//! Laws are generic. Those of line and solid contacts take any [`Numeric`] and do not branch on it: called with `f64` they give the
//! force of one contact, with [`Pack`] those of several contacts at once, with
//! [`Dual`] and [`Duals`] the same forces and their exact derivatives. The other laws take a [`Real`], one number that they may branch on.

mod dual;
pub mod elementary;
pub mod math;
mod pack;

pub use dual::{Dual, Duals};
pub use pack::{Columns, Lanes, Pack, WIDEST, ZEROS, blocks_for, dispatch, one_by_one, place_of};

use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Sub, SubAssign};

/// Whether all numbers are finite: zero times any other is no number.
#[inline(always)]
pub fn all_finite(numbers: &[f64]) -> bool {
    let (fours, rest) = numbers.as_chunks::<4>();
    let mut nothing = [0.0; 4];
    for four in fours {
        for (nothing, x) in nothing.iter_mut().zip(four) {
            *nothing += 0.0 * x;
        }
    }
    rest.iter().fold(nothing.iter().sum(), |nothing: f64, x| nothing + 0.0 * x) == 0.0
}

/// One real number or several side by side, with or without derivatives.
///
/// Comparisons look at values, not at derivatives.
pub trait Numeric:
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
    /// Whether there are derivatives.
    const DERIVATIVES: bool;
    /// The same without derivatives.
    type Base: Base<Mask = Self::Mask>;
    /// Result of a comparison: one truth value per number.
    type Mask: Copy + BitAnd<Output = Self::Mask> + BitOr<Output = Self::Mask>;

    /// The values without derivatives.
    fn base(self) -> Self::Base;
    /// A constant: all derivatives are zero.
    fn lift(base: Self::Base) -> Self;
    /// Where true the one, elsewhere the other. Both are there already, so that no branch is needed.
    fn select(condition: Self::Mask, yes: Self, no: Self) -> Self;
    /// Square root; valid for values > 0.
    fn sqrt(self) -> Self;
    /// Natural logarithm; valid for values > 0.
    fn ln(self) -> Self;
    /// `ln(1 + self)`; valid for values >= 0.
    fn ln_1p(self) -> Self;
    /// Exponential.
    fn exp(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// Inverse hyperbolic sine; valid for values >= 0.
    fn asinh(self) -> Self;
    /// Arc tangent; valid for values >= 0.
    fn atan(self) -> Self;

    /// The constant `value`, beside `self`.
    #[inline(always)]
    fn like(self, value: f64) -> Self {
        Self::lift(self.base().splat(value))
    }
    /// self < `bound`
    #[inline(always)]
    fn below(self, bound: f64) -> Self::Mask {
        self.base().less(self.base().splat(bound))
    }
    /// self > `bound`
    #[inline(always)]
    fn above(self, bound: f64) -> Self::Mask {
        self.base().splat(bound).less(self.base())
    }
    /// self <= `bound`
    #[inline(always)]
    fn at_most(self, bound: f64) -> Self::Mask {
        self.base().less_or_equal(self.base().splat(bound))
    }
    /// self >= `bound`
    #[inline(always)]
    fn at_least(self, bound: f64) -> Self::Mask {
        self.base().splat(bound).less_or_equal(self.base())
    }
    /// Absolute value; the derivative at zero is that of `+self`.
    #[inline(always)]
    fn abs(self) -> Self {
        Self::select(self.below(0.0), -self, self)
    }
    /// The larger of the value and a constant floor.
    #[inline(always)]
    fn floored(self, floor: f64) -> Self {
        Self::select(self.below(floor), self.like(floor), self)
    }
}

/// Numbers without derivatives, and what [`elementary`] needs to know of their bits.
pub trait Base: Numeric<Base = Self> {
    /// `value` as often as there are numbers in `self`.
    fn splat(self, value: f64) -> Self;
    /// self < `other`
    fn less(self, other: Self) -> Self::Mask;
    /// self <= `other`
    fn less_or_equal(self, other: Self) -> Self::Mask;
    /// The numbers, or the nearer end of a range. NaN stays.
    #[inline(always)]
    fn within(self, [low, high]: [f64; 2]) -> Self {
        let raised = Self::select(self.below(low), self.splat(low), self);
        Self::select(raised.above(high), self.splat(high), raised)
    }
    /// Whether any is true.
    fn any(mask: Self::Mask) -> bool;
    /// 2^self of whole numbers from -1022 to 1023.
    fn power_of_two(self) -> Self;
    /// k and m of 2^k m, m from sqrt(1/2) to sqrt(2), of normal numbers > 0.
    fn split(self) -> (Self, Self);
}

/// Numbers of `B`, with or without derivatives, that can be combined with constants of type `B`.
pub trait Of<B>:
    Numeric<Base = B>
    + Add<B, Output = Self>
    + Sub<B, Output = Self>
    + Mul<B, Output = Self>
    + Div<B, Output = Self>
{
}

impl<B, T> Of<B> for T where
    T: Numeric<Base = B> + Add<B, Output = T> + Sub<B, Output = T> + Mul<B, Output = T> + Div<B, Output = T>
{
}

/// One real number, with or without derivatives.
pub trait Real: Numeric<Base = f64, Mask = bool> {
    /// `self^p` with a constant exponent; valid for values > 0, and at 0 for p >= 1.
    fn powf(self, p: f64) -> Self;
    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);
    /// Four-quadrant arc tangent of `self / x`.
    fn atan2(self, x: Self) -> Self;
    /// Whether any derivative differs from zero.
    fn varies(self) -> bool;

    /// A constant: all derivatives are zero.
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self::lift(value)
    }
    /// The value without derivatives.
    #[inline(always)]
    fn value(self) -> f64 {
        self.base()
    }
    /// `self * self`.
    #[inline(always)]
    fn squared(self) -> Self {
        self * self
    }
    /// -1 for negative values, else +1; a plain number because its derivative is zero.
    #[inline(always)]
    fn sign(self) -> f64 {
        if self.value() < 0.0 { -1.0 } else { 1.0 }
    }
}

impl Numeric for f64 {
    const DERIVATIVES: bool = false;
    type Base = f64;
    type Mask = bool;

    #[inline(always)]
    fn base(self) -> f64 {
        self
    }
    #[inline(always)]
    fn lift(base: f64) -> Self {
        base
    }
    #[inline(always)]
    fn select(condition: bool, yes: Self, no: Self) -> Self {
        if condition { yes } else { no }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }
    fn ln(self) -> Self {
        elementary::ln(self)
    }
    fn ln_1p(self) -> Self {
        elementary::ln_1p(self)
    }
    fn exp(self) -> Self {
        elementary::exp(self)
    }
    fn tanh(self) -> Self {
        elementary::tanh(self)
    }
    fn asinh(self) -> Self {
        elementary::asinh(self)
    }
    fn atan(self) -> Self {
        elementary::atan(self)
    }
}

const MANTISSA_BITS: u32 = 52;
const EXPONENT_BIAS: u64 = 1023;
/// Bits of sqrt(1/2).
const ROOT_HALF: u64 = 0x3fe6_a09e_667f_3bcd;

impl Base for f64 {
    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn less(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn less_or_equal(self, other: Self) -> bool {
        self <= other
    }
    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        f64::from_bits(((self as i64 + EXPONENT_BIAS as i64) as u64) << MANTISSA_BITS)
    }
    #[inline(always)]
    fn split(self) -> (Self, Self) {
        let bits = self.to_bits();
        let k = (bits.wrapping_sub(ROOT_HALF) as i64) >> MANTISSA_BITS;
        (k as f64, f64::from_bits(bits.wrapping_sub((k as u64) << MANTISSA_BITS)))
    }
}

impl Real for f64 {
    fn powf(self, p: f64) -> Self {
        math::powf(self, p)
    }
    fn sin_cos(self) -> (Self, Self) {
        math::sin_cos(self)
    }
    fn atan2(self, x: Self) -> Self {
        math::atan2(self, x)
    }
    fn varies(self) -> bool {
        false
    }
}

/// Smooth switch: 0 below `0`, 1 above `1`, `3x^2 - 2x^3` between (continuous first derivative).
#[inline(always)]
pub fn smoothstep<T: Numeric>(x: T) -> T {
    let between = x * x * (-x * 2.0 + 3.0);
    T::select(x.at_most(0.0), x.like(0.0), T::select(x.at_least(1.0), x.like(1.0), between))
}
