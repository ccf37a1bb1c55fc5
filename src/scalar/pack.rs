//! Several numbers in vector registers, with the widest instructions of the machine.

use super::{Base, Numeric, ROOT_HALF, elementary};
use pulp::bytemuck::cast;
use pulp::{Arch, Simd, WithSimd};
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Sub, SubAssign};

/// Numbers in a group.
pub const GROUP: usize = 8;

/// Work on groups, for any number type that holds one.
pub trait Group {
    /// Does the work. Must be inlined, as must everything it calls: only then is it compiled for the instructions.
    fn run<S: Simd, const K: usize>(self, simd: S);
}

/// Does `work` with these instructions.
#[inline(always)]
pub fn dispatch(instructions: Arch, work: impl Group) {
    struct Work<G>(G);
    impl<G: Group> WithSimd for Work<G> {
        type Output = ();
        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) {
            match S::F64_LANES {
                GROUP => self.0.run::<S, 1>(simd),
                4 => self.0.run::<S, 2>(simd),
                2 => self.0.run::<S, 4>(simd),
                _ => self.0.run::<S, GROUP>(simd),
            }
        }
    }
    instructions.dispatch(Work(work));
}

/// A group of numbers in `K` registers.
#[derive(Clone, Copy, Debug)]
pub struct Pack<S: Simd, const K: usize> {
    simd: S,
    v: [S::f64s; K],
}

/// One truth value per number.
#[derive(Clone, Copy, Debug)]
pub struct PackMask<S: Simd, const K: usize> {
    simd: S,
    m: [S::m64s; K],
}

impl<S: Simd, const K: usize> Pack<S, K> {
    /// The numbers of a group.
    #[inline(always)]
    pub fn load(simd: S, numbers: &[f64; GROUP]) -> Self {
        let (registers, _) = S::as_simd_f64s(numbers);
        let mut v = [simd.splat_f64s(0.0); K];
        v.copy_from_slice(registers);
        Self { simd, v }
    }

    /// `value` in every place.
    #[inline(always)]
    pub fn all(simd: S, value: f64) -> Self {
        Self { simd, v: [simd.splat_f64s(value); K] }
    }

    /// Writes the numbers.
    #[inline(always)]
    pub fn store(self, numbers: &mut [f64; GROUP]) {
        let (registers, _) = S::as_mut_simd_f64s(numbers);
        registers.copy_from_slice(&self.v);
    }
}

/// Applies an operation of the instruction set to each register. No closures: they would not always be inlined.
macro_rules! each {
    ($x:ident: $operation:ident($($argument:expr),*)) => {{
        let mut out = $x;
        for i in 0..K {
            out.v[i] = $x.simd.$operation($x.v[i] $(, $argument)*);
        }
        out
    }};
    ($x:ident, $y:ident: $operation:ident) => {{
        let mut out = $x;
        for i in 0..K {
            out.v[i] = $x.simd.$operation($x.v[i], $y.v[i]);
        }
        out
    }};
}

macro_rules! compare {
    ($x:ident, $y:ident: $operation:ident) => {{
        let simd = $x.simd;
        let mut m = [simd.$operation($x.v[0], $y.v[0]); K];
        for i in 1..K {
            m[i] = simd.$operation($x.v[i], $y.v[i]);
        }
        PackMask { simd, m }
    }};
}

macro_rules! operators {
    ($($operator:ident $method:ident $simd:ident),*) => {$(
        impl<S: Simd, const K: usize> $operator for Pack<S, K> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                each!(self, o: $simd)
            }
        }
        impl<S: Simd, const K: usize> $operator<f64> for Pack<S, K> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: f64) -> Self {
                let simd = self.simd;
                each!(self: $simd(simd.splat_f64s(o)))
            }
        }
    )*};
}

operators!(Add add add_f64s, Sub sub sub_f64s, Mul mul mul_f64s, Div div div_f64s);

impl<S: Simd, const K: usize> Neg for Pack<S, K> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        each!(self: neg_f64s())
    }
}

impl<S: Simd, const K: usize> AddAssign for Pack<S, K> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl<S: Simd, const K: usize> SubAssign for Pack<S, K> {
    #[inline(always)]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

impl<S: Simd, const K: usize> BitAnd for PackMask<S, K> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, o: Self) -> Self {
        let mut out = self;
        for i in 0..K {
            out.m[i] = self.simd.and_m64s(self.m[i], o.m[i]);
        }
        out
    }
}

impl<S: Simd, const K: usize> BitOr for PackMask<S, K> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, o: Self) -> Self {
        let mut out = self;
        for i in 0..K {
            out.m[i] = self.simd.or_m64s(self.m[i], o.m[i]);
        }
        out
    }
}

impl<S: Simd, const K: usize> Numeric for Pack<S, K> {
    const DERIVATIVES: bool = false;
    type Base = Self;
    type Mask = PackMask<S, K>;

    #[inline(always)]
    fn base(self) -> Self {
        self
    }
    #[inline(always)]
    fn lift(base: Self) -> Self {
        base
    }
    #[inline(always)]
    fn select(condition: Self::Mask, yes: Self, no: Self) -> Self {
        let mut out = yes;
        for i in 0..K {
            out.v[i] = yes.simd.select_f64s(condition.m[i], yes.v[i], no.v[i]);
        }
        out
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        each!(self: sqrt_f64s())
    }
    #[inline(always)]
    fn ln(self) -> Self {
        elementary::ln(self)
    }
    #[inline(always)]
    fn ln_1p(self) -> Self {
        elementary::ln_1p(self)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        elementary::exp(self)
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        elementary::tanh(self)
    }
    #[inline(always)]
    fn asinh(self) -> Self {
        elementary::asinh(self)
    }
}

/// In the high half of a double of the magnitude 2^20 stands a whole number.
const WHOLE: f64 = 1_048_576.0;
/// Bits of the high half below the exponent.
const HIGH_BITS: u32 = 20;
const EXPONENT: u64 = 0xfff0_0000_0000_0000;
const BIAS: f64 = 1023.0;
/// Makes differences of exponents positive.
const OFFSET: u64 = 1024;

impl<S: Simd, const K: usize> Base for Pack<S, K> {
    #[inline(always)]
    fn splat(self, value: f64) -> Self {
        Self::all(self.simd, value)
    }
    #[inline(always)]
    fn less(self, other: Self) -> Self::Mask {
        compare!(self, other: less_than_f64s)
    }
    #[inline(always)]
    fn less_or_equal(self, other: Self) -> Self::Mask {
        compare!(self, other: less_than_or_equal_f64s)
    }
    #[inline(always)]
    fn any(mask: Self::Mask) -> bool {
        let mut all = mask.m[0];
        for m in mask.m {
            all = mask.simd.or_m64s(all, m);
        }
        mask.simd.first_true_m64s(all) < S::F64_LANES
    }
    /// The exponent goes from the high half of a sum to its place.
    #[inline(always)]
    fn power_of_two(self) -> Self {
        let s = self.simd;
        let mut out = self;
        for i in 0..K {
            out.v[i] = if S::F64_LANES == 1 {
                s.splat_f64s(cast::<_, f64>(self.v[i]).power_of_two())
            } else {
                let halves: S::u32s = cast(s.add_f64s(self.v[i], s.splat_f64s(1.5 * WHOLE + BIAS)));
                cast(s.wrapping_dyn_shl_u32s(halves, s.splat_u32s(HIGH_BITS)))
            };
        }
        out
    }
    #[inline(always)]
    fn split(self) -> (Self, Self) {
        let s = self.simd;
        let (mut k, mut m) = (self, self);
        for i in 0..K {
            if S::F64_LANES == 1 {
                let (exponent, mantissa) = cast::<_, f64>(self.v[i]).split();
                k.v[i] = s.splat_f64s(exponent);
                m.v[i] = s.splat_f64s(mantissa);
                continue;
            }
            let bits: S::u64s = cast(self.v[i]);
            let offset = s.splat_u64s(OFFSET << 52);
            let above = s.add_u64s(s.sub_u64s(bits, s.splat_u64s(ROOT_HALF)), offset);
            let exponent = s.and_u64s(above, s.splat_u64s(EXPONENT));
            let low: S::u64s = cast(s.wrapping_dyn_shr_u32s(cast(exponent), s.splat_u32s(HIGH_BITS)));
            let whole = s.or_u64s(low, s.splat_u64s(WHOLE.to_bits()));
            k.v[i] = s.sub_f64s(cast(whole), s.splat_f64s(WHOLE + OFFSET as f64));
            m.v[i] = cast(s.sub_u64s(bits, s.sub_u64s(exponent, offset)));
        }
        (k, m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Functions of a group, and the same of each number by itself.
    struct Compare<'a>(&'a [f64; GROUP], &'a mut u64);

    fn functions<T: Base>(x: T) -> [T; 9] {
        let (sin, cos) = elementary::sin_cos(x);
        [
            x.exp(),
            x.ln(),
            x.abs().ln_1p(),
            x.tanh(),
            x.abs().asinh(),
            sin,
            cos,
            x.sqrt(),
            x.floored(0.25) - x * 3.0,
        ]
    }

    impl Group for Compare<'_> {
        #[inline(always)]
        fn run<S: Simd, const K: usize>(self, simd: S) {
            let group = functions(Pack::<S, K>::load(simd, self.0));
            let mut out = [0.0; GROUP];
            for (f, all) in group.into_iter().enumerate() {
                all.store(&mut out);
                for (x, y) in self.0.iter().zip(out) {
                    let alone = functions(*x)[f];
                    assert!(
                        alone.to_bits() == y.to_bits() || alone.is_nan() && y.is_nan(),
                        "{f}({x}): {y} {alone}"
                    );
                    *self.1 += 1;
                }
            }
        }
    }

    #[test]
    fn groups_give_the_bits_of_single_numbers_with_all_instructions() {
        let mut all = vec![Arch::Scalar, Arch::new()];
        #[cfg(target_arch = "x86_64")]
        all.extend(pulp::x86::V3::try_new().map(Arch::V3));
        let mut compared = 0;
        for instructions in all {
            for i in 0..4000 {
                let numbers = std::array::from_fn(|j| {
                    let x = (i * GROUP + j) as f64;
                    let sign = if j % 3 == 0 { -1.0 } else { 1.0 };
                    sign * 10f64.powf(x * 0.02 - 320.0)
                });
                dispatch(instructions, Compare(&numbers, &mut compared));
            }
            let special = [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 5e-324, 709.5, -709.0];
            dispatch(instructions, Compare(&special, &mut compared));
        }
        assert!(compared > 500_000);
    }
}
