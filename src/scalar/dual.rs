//! Forward-mode dual numbers with `N` independent directions.

use super::Real;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// A value with its `N` partial derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<const N: usize> {
    /// Value.
    pub re: f64,
    /// Partial derivatives with respect to the `N` variables.
    pub eps: [f64; N],
}

impl<const N: usize> Dual<N> {
    /// The independent variable number `index` at `value`.
    pub fn variable(value: f64, index: usize) -> Self {
        let mut eps = [0.0; N];
        eps[index] = 1.0;
        Self { re: value, eps }
    }

    /// Chain rule: the result has value `re` and derivative `slope` times that of `self`.
    fn chain(self, re: f64, slope: f64) -> Self {
        Self { re, eps: self.eps.map(|e| slope * e) }
    }

    fn combine(self, other: Self, re: f64, a: f64, b: f64) -> Self {
        let mut eps = [0.0; N];
        for ((e, x), y) in eps.iter_mut().zip(self.eps).zip(other.eps) {
            *e = a * x + b * y;
        }
        Self { re, eps }
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        self.combine(o, self.re + o.re, 1.0, 1.0)
    }
}

impl<const N: usize> Sub for Dual<N> {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self.combine(o, self.re - o.re, 1.0, -1.0)
    }
}

impl<const N: usize> Mul for Dual<N> {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        self.combine(o, self.re * o.re, o.re, self.re)
    }
}

impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let q = self.re / o.re;
        self.combine(o, q, 1.0 / o.re, -q / o.re)
    }
}

impl<const N: usize> Neg for Dual<N> {
    type Output = Self;
    fn neg(self) -> Self {
        self.chain(-self.re, -1.0)
    }
}

impl<const N: usize> AddAssign for Dual<N> {
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl<const N: usize> SubAssign for Dual<N> {
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

impl<const N: usize> Add<f64> for Dual<N> {
    type Output = Self;
    fn add(self, o: f64) -> Self {
        self.chain(self.re + o, 1.0)
    }
}

impl<const N: usize> Sub<f64> for Dual<N> {
    type Output = Self;
    fn sub(self, o: f64) -> Self {
        self.chain(self.re - o, 1.0)
    }
}

impl<const N: usize> Mul<f64> for Dual<N> {
    type Output = Self;
    fn mul(self, o: f64) -> Self {
        self.chain(self.re * o, o)
    }
}

impl<const N: usize> Div<f64> for Dual<N> {
    type Output = Self;
    fn div(self, o: f64) -> Self {
        self.chain(self.re / o, 1.0 / o)
    }
}

impl<const N: usize> Real for Dual<N> {
    fn constant(value: f64) -> Self {
        Self { re: value, eps: [0.0; N] }
    }
    fn value(self) -> f64 {
        self.re
    }
    fn sqrt(self) -> Self {
        let r = self.re.sqrt();
        self.chain(r, 0.5 / r)
    }
    fn ln(self) -> Self {
        self.chain(self.re.ln(), 1.0 / self.re)
    }
    fn exp(self) -> Self {
        let e = self.re.exp();
        self.chain(e, e)
    }
    fn powf(self, p: f64) -> Self {
        self.chain(self.re.powf(p), p * self.re.powf(p - 1.0))
    }
    fn tanh(self) -> Self {
        let t = self.re.tanh();
        self.chain(t, 1.0 - t * t)
    }
    fn asinh(self) -> Self {
        self.chain(self.re.asinh(), 1.0 / self.re.hypot(1.0))
    }
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.re.sin_cos();
        (self.chain(s, c), self.chain(c, -s))
    }
    fn atan2(self, x: Self) -> Self {
        let r2 = self.re * self.re + x.re * x.re;
        self.combine(x, self.re.atan2(x.re), x.re / r2, -self.re / r2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every operation of the trait in one expression, each with a non-trivial argument.
    fn expression<T: Real>(x: T, y: T) -> T {
        let (s, c) = (x * y).sin_cos();
        let a = (x / y).sqrt() + (x + 1.5).ln() * (-y).exp() - (x * 0.5).powf(1.3);
        let b = (y - 2.0).tanh() / (x.asinh() + 3.0) + s.atan2(c + 2.0) - x.squared() / 4.0;
        let mut sum = a;
        sum += b;
        sum -= (y - x).abs() * 0.1;
        sum
    }

    #[test]
    fn derivatives_match_central_differences() {
        let (x, y) = (0.7, 1.9);
        let d = expression(Dual::<2>::variable(x, 0), Dual::variable(y, 1));
        let h = 1e-6;
        let dx = (expression(x + h, y) - expression(x - h, y)) / (2.0 * h);
        let dy = (expression(x, y + h) - expression(x, y - h)) / (2.0 * h);
        assert_eq!(d.re, expression(x, y));
        assert!((d.eps[0] - dx).abs() < 1e-9, "{} {dx}", d.eps[0]);
        assert!((d.eps[1] - dy).abs() < 1e-9, "{} {dy}", d.eps[1]);
    }
}
