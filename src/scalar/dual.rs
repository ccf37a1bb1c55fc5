//! Forward-mode dual numbers with `N` independent directions.

#![allow(clippy::needless_range_loop)]

use super::{Base, Numeric, Pack, Real, math};
use pulp::Simd;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

/// Does `work` with `i` for each of the `N` directions.
macro_rules! looped {
    ($i:ident: $work:expr) => {
        for $i in 0..N {
            $work;
        }
    };
}

/// The same written out, for up to [`MOST_DIRECTIONS`]: loops in every operation would take most of the time of a build.
macro_rules! written_out {
    ($i:ident: $work:expr) => {{
        const { assert!(N <= MOST_DIRECTIONS) };
        written_out!($i: $work; 0 1 2 3 4 5 6 7);
    }};
    ($i:ident: $work:expr; $($at:literal)*) => {$(
        if N > $at {
            let $i = $at;
            $work;
        }
    )*};
}

/// Largest number of directions of [`Duals`].
const MOST_DIRECTIONS: usize = 8;

/// A type of dual numbers whose operations are inlined and go through the directions as said. No closures: they would not
/// always be inlined.
macro_rules! dual_numbers {
    ($name:ident, $inline:meta, $each:ident, $(#[$text:meta])*) => {
    $(#[$text])*
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct $name<const N: usize, B = f64> {
        /// Value.
        pub re: B,
        /// Partial derivatives with respect to the `N` variables.
        pub eps: [B; N],
    }

    impl<const N: usize, B: Base> $name<N, B> {
        /// The independent variable number `index` at `value`.
        #[$inline]
        pub fn variable(value: B, index: usize) -> Self {
            let mut eps = [value.splat(0.0); N];
            eps[index] = value.splat(1.0);
            Self { re: value, eps }
        }

        /// Chain rule: the result has value `re` and derivative `slope` times that of `self`.
        #[$inline]
        pub fn chain(self, re: B, slope: B) -> Self {
            let mut eps = self.eps;
            $each!(i: eps[i] = slope * eps[i]);
            Self { re, eps }
        }

        #[$inline]
        fn combine(self, other: Self, re: B, a: B, b: B) -> Self {
            let mut eps = self.eps;
            $each!(i: eps[i] = a * eps[i] + b * other.eps[i]);
            Self { re, eps }
        }
    }

    impl<const N: usize, B: Base> Add for $name<N, B> {
        type Output = Self;
        #[$inline]
        fn add(self, o: Self) -> Self {
            let mut eps = self.eps;
            $each!(i: eps[i] += o.eps[i]);
            Self { re: self.re + o.re, eps }
        }
    }

    impl<const N: usize, B: Base> Sub for $name<N, B> {
        type Output = Self;
        #[$inline]
        fn sub(self, o: Self) -> Self {
            let mut eps = self.eps;
            $each!(i: eps[i] -= o.eps[i]);
            Self { re: self.re - o.re, eps }
        }
    }

    impl<const N: usize, B: Base> Mul for $name<N, B> {
        type Output = Self;
        #[$inline]
        fn mul(self, o: Self) -> Self {
            self.combine(o, self.re * o.re, o.re, self.re)
        }
    }

    impl<const N: usize, B: Base> Div for $name<N, B> {
        type Output = Self;
        #[$inline]
        fn div(self, o: Self) -> Self {
            let q = self.re / o.re;
            let inverse = o.re.splat(1.0) / o.re;
            self.combine(o, q, inverse, -q * inverse)
        }
    }

    impl<const N: usize, B: Base> Neg for $name<N, B> {
        type Output = Self;
        #[$inline]
        fn neg(self) -> Self {
            let mut eps = self.eps;
            $each!(i: eps[i] = -eps[i]);
            Self { re: -self.re, eps }
        }
    }

    impl<const N: usize, B: Base> AddAssign for $name<N, B> {
        #[$inline]
        fn add_assign(&mut self, o: Self) {
            *self = *self + o;
        }
    }

    impl<const N: usize, B: Base> SubAssign for $name<N, B> {
        #[$inline]
        fn sub_assign(&mut self, o: Self) {
            *self = *self - o;
        }
    }

    impl<const N: usize, B: Base> Add<f64> for $name<N, B> {
        type Output = Self;
        #[$inline]
        fn add(self, o: f64) -> Self {
            Self { re: self.re + o, ..self }
        }
    }

    impl<const N: usize, B: Base> Sub<f64> for $name<N, B> {
        type Output = Self;
        #[$inline]
        fn sub(self, o: f64) -> Self {
            Self { re: self.re - o, ..self }
        }
    }

    impl<const N: usize, B: Base> Mul<f64> for $name<N, B> {
        type Output = Self;
        #[$inline]
        fn mul(self, o: f64) -> Self {
            let mut eps = self.eps;
            $each!(i: eps[i] = eps[i] * o);
            Self { re: self.re * o, eps }
        }
    }

    impl<const N: usize, B: Base> Div<f64> for $name<N, B> {
        type Output = Self;
        #[$inline]
        fn div(self, o: f64) -> Self {
            // The value is that of plain numbers, to the last bit.
            Self { re: self.re / o, ..self * (1.0 / o) }
        }
    }

    impl<const N: usize, B: Base> Numeric for $name<N, B> {
        const DERIVATIVES: bool = true;
        type Base = B;
        type Mask = B::Mask;

        #[$inline]
        fn base(self) -> B {
            self.re
        }
        #[$inline]
        fn lift(base: B) -> Self {
            Self { re: base, eps: [base.splat(0.0); N] }
        }
        #[$inline]
        fn select(condition: B::Mask, yes: Self, no: Self) -> Self {
            let mut out = no;
            out.re = B::select(condition, yes.re, no.re);
            $each!(i: out.eps[i] = B::select(condition, yes.eps[i], out.eps[i]));
            out
        }
        #[$inline]
        fn sqrt(self) -> Self {
            let r = self.re.sqrt();
            self.chain(r, r.splat(0.5) / r)
        }
        #[$inline]
        fn ln(self) -> Self {
            self.chain(self.re.ln(), self.re.splat(1.0) / self.re)
        }
        #[$inline]
        fn ln_1p(self) -> Self {
            self.chain(self.re.ln_1p(), self.re.splat(1.0) / (self.re + 1.0))
        }
        #[$inline]
        fn exp(self) -> Self {
            let e = self.re.exp();
            self.chain(e, e)
        }
        #[$inline]
        fn tanh(self) -> Self {
            let t = self.re.tanh();
            self.chain(t, -(t * t) + 1.0)
        }
        #[$inline]
        fn asinh(self) -> Self {
            let root = (self.re * self.re + 1.0).sqrt();
            self.chain(self.re.asinh(), root.splat(1.0) / root)
        }
        #[$inline]
        fn atan(self) -> Self {
            self.chain(self.re.atan(), self.re.splat(1.0) / (self.re * self.re + 1.0))
        }
    }
    };
}

dual_numbers!(
    Dual,
    inline,
    looped,
    /// A value with its `N` partial derivatives.
);
dual_numbers!(
    Duals,
    inline(always),
    written_out,
    /// Values side by side with their `N` partial derivatives. Every operation is inlined, as [`Columns`](super::Columns)
    /// need it; in other places that would bloat the code.
);

macro_rules! with_constants {
    ($($operator:ident $method:ident),*) => {$(
        impl<S: Simd, const K: usize, const N: usize> $operator<Pack<S, K>> for Duals<N, Pack<S, K>> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Pack<S, K>) -> Self {
                let mut out = self;
                out.re = self.re.$method(o);
                with_constants!($method out o);
                out
            }
        }
    )*};
    (add $out:ident $o:ident) => {};
    (sub $out:ident $o:ident) => {};
    ($method:ident $out:ident $o:ident) => {
        written_out!(i: $out.eps[i] = $out.eps[i].$method($o));
    };
}

with_constants!(Add add, Sub sub, Mul mul, Div div);

impl<const N: usize> Real for Dual<N> {
    fn powf(self, p: f64) -> Self {
        self.chain(Real::powf(self.re, p), p * Real::powf(self.re, p - 1.0))
    }
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = math::sin_cos(self.re);
        (self.chain(s, c), self.chain(c, -s))
    }
    fn atan2(self, x: Self) -> Self {
        let r2 = self.re * self.re + x.re * x.re;
        self.combine(x, math::atan2(self.re, x.re), x.re / r2, -self.re / r2)
    }
    fn varies(self) -> bool {
        self.eps != [0.0; N]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every operation of the trait in one expression, each with a non-trivial argument.
    fn expression<T: Real>(x: T, y: T) -> T {
        let (s, c) = (x * y).sin_cos();
        let a = (x / y).sqrt() + (x + 1.5).ln() * (-y).exp() * x.ln_1p() - (x * 0.5).powf(1.3);
        let b = (y - 2.0).tanh() / (x.asinh() + 3.0) + s.atan2(c + 2.0) * y.atan() - x.squared() / 4.0;
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
