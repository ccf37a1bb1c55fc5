//! Several numbers in vector registers, with the widest instructions of the machine.

use super::{Base, Numeric, ROOT_HALF, elementary};
use pulp::bytemuck::cast;
use pulp::{Arch, Scalar, Simd, WithSimd};
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Sub, SubAssign};

/// Largest number of numbers in a group.
pub const WIDEST: usize = 16;
/// A column of numbers that stands in one piece, as long as the widest group. Columns of more rows come in blocks of these:
/// what belongs together is then at constant distances, and its place needs no check.
pub type Lanes = [f64; WIDEST];
/// A column of zeros.
pub const ZEROS: Lanes = [0.0; WIDEST];

/// Number of blocks for so many rows.
pub const fn blocks_for(rows: usize) -> usize {
    rows.div_ceil(WIDEST)
}

/// Block of row `i`, and its place there.
#[inline(always)]
pub const fn place_of(i: usize) -> (usize, usize) {
    (i / WIDEST, i % WIDEST)
}

/// Largest number of registers of a group.
const LARGEST_GROUP: usize = 2;

/// Work on columns of numbers, group by group.
pub trait Columns {
    /// Whether two registers are worked on at a time while there is work for them, so that one does not wait for the other.
    const PAIRED: bool = true;
    /// Number of rows.
    fn rows(&self) -> usize;
    /// Does the work for the group of `K` registers from row `first` on; it may go beyond the last row, up to the next
    /// multiple of [`WIDEST`]. Must be inlined, as must everything it calls: only then is it compiled for the
    /// instructions of `simd`.
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize);
}

struct Work<C>(C);

impl<C: Columns> WithSimd for Work<C> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let rows = self.0.rows();
        let mut first = 0;
        while first < rows {
            let rest = rows - first;
            if C::PAIRED && S::F64_LANES > 1 && rest > S::F64_LANES {
                self.0.group::<S, 2>(simd, first);
                first += 2 * S::F64_LANES;
            } else {
                self.0.group::<S, 1>(simd, first);
                first += S::F64_LANES;
            }
        }
    }
}

/// Does `work` with these instructions.
#[inline(always)]
pub fn dispatch(instructions: Arch, work: impl Columns) {
    if work.rows() > 0 {
        instructions.dispatch(Work(work));
    }
}

/// Does `work` number by number, for what is rare: with every kind of instructions it would be as large again.
pub fn one_by_one(work: impl Columns) {
    if work.rows() > 0 {
        Work(work).with_simd(Scalar::new());
    }
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

/// Does `work` with `i` for each of the `K` registers, written out: a loop in every operation would take most of the time of
/// a build, and closures would not always be inlined.
macro_rules! each_register {
    ($i:ident: $work:expr) => {{
        const { assert!(0 < K && K <= LARGEST_GROUP) };
        {
            let $i = 0;
            $work;
        }
        if K > 1 {
            let $i = 1;
            $work;
        }
    }};
}

impl<S: Simd, const K: usize> Pack<S, K> {
    /// The first of these numbers.
    ///
    /// # Panics
    /// If there are not enough.
    #[inline(always)]
    pub fn load(simd: S, numbers: &[f64]) -> Self {
        let (registers, _) = S::as_simd_f64s(&numbers[..K * S::F64_LANES]);
        let mut v = [simd.splat_f64s(0.0); K];
        v.copy_from_slice(registers);
        Self { simd, v }
    }

    /// `value` in every place.
    #[inline(always)]
    pub fn all(simd: S, value: f64) -> Self {
        Self { simd, v: [simd.splat_f64s(value); K] }
    }

    /// Adds the numbers to the first of these.
    ///
    /// # Panics
    /// If there are not enough.
    #[inline(always)]
    pub fn add_to(self, numbers: &mut [f64]) {
        (Self::load(self.simd, numbers) + self).store(numbers);
    }

    /// Sum of the numbers, in any order.
    #[inline(always)]
    pub fn sum(self) -> f64 {
        let mut sum = 0.0;
        each_register!(i: sum += self.simd.reduce_sum_f64s(self.v[i]));
        sum
    }

    /// What `f` makes of each number.
    #[inline(always)]
    pub fn each<const N: usize>(self, f: impl Fn(f64) -> [f64; N]) -> [Self; N] {
        let numbers = self.lanes();
        let mut out = [ZEROS; N];
        for (lane, number) in numbers[..K * S::F64_LANES].iter().enumerate() {
            for (out, value) in out.iter_mut().zip(f(*number)) {
                out[lane] = value;
            }
        }
        out.map(|numbers| Self::load(self.simd, &numbers))
    }

    /// The numbers, and zeros behind them.
    #[inline(always)]
    pub fn lanes(self) -> Lanes {
        let mut numbers = ZEROS;
        self.store(&mut numbers);
        numbers
    }

    /// Writes the numbers to the first of these.
    ///
    /// # Panics
    /// If there are not enough.
    #[inline(always)]
    pub fn store(self, numbers: &mut [f64]) {
        let (registers, _) = S::as_mut_simd_f64s(&mut numbers[..K * S::F64_LANES]);
        registers.copy_from_slice(&self.v);
    }
}

/// Applies an operation of the instruction set to each register.
macro_rules! each {
    ($x:ident: $operation:ident($($argument:expr),*)) => {{
        let mut out = $x;
        each_register!(i: out.v[i] = $x.simd.$operation($x.v[i] $(, $argument)*));
        out
    }};
    ($x:ident, $y:ident: $operation:ident) => {{
        let mut out = $x;
        each_register!(i: out.v[i] = $x.simd.$operation($x.v[i], $y.v[i]));
        out
    }};
}

macro_rules! compare {
    ($x:ident, $y:ident: $operation:ident) => {{
        let simd = $x.simd;
        let mut m = [simd.$operation($x.v[0], $y.v[0]); K];
        if K > 1 {
            m[1] = simd.$operation($x.v[1], $y.v[1]);
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
        each_register!(i: out.m[i] = self.simd.and_m64s(self.m[i], o.m[i]));
        out
    }
}

impl<S: Simd, const K: usize> BitOr for PackMask<S, K> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, o: Self) -> Self {
        let mut out = self;
        each_register!(i: out.m[i] = self.simd.or_m64s(self.m[i], o.m[i]));
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
        each_register!(i: out.v[i] = yes.simd.select_f64s(condition.m[i], yes.v[i], no.v[i]));
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
    #[inline(always)]
    fn atan(self) -> Self {
        elementary::atan(self)
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
        each_register!(i: all = mask.simd.or_m64s(all, mask.m[i]));
        mask.simd.first_true_m64s(all) < S::F64_LANES
    }
    #[inline(always)]
    fn power_of_two(self) -> Self {
        let s = self.simd;
        let mut out = self;
        each_register!(i: out.v[i] = power_of_two(s, self.v[i]));
        out
    }
    #[inline(always)]
    fn split(self) -> (Self, Self) {
        let s = self.simd;
        let (mut k, mut m) = (self, self);
        each_register!(i: (k.v[i], m.v[i]) = split(s, self.v[i]));
        (k, m)
    }
}

/// 2^x of whole numbers: the exponent goes from the high half of a sum to its place.
#[inline(always)]
fn power_of_two<S: Simd>(s: S, x: S::f64s) -> S::f64s {
    if S::F64_LANES == 1 {
        return s.splat_f64s(cast::<_, f64>(x).power_of_two());
    }
    let halves: S::u32s = cast(s.add_f64s(x, s.splat_f64s(1.5 * WHOLE + BIAS)));
    cast(s.wrapping_dyn_shl_u32s(halves, s.splat_u32s(HIGH_BITS)))
}

/// Exponent and mantissa of each number, as [`Base::split`].
#[inline(always)]
fn split<S: Simd>(s: S, x: S::f64s) -> (S::f64s, S::f64s) {
    if S::F64_LANES == 1 {
        let (exponent, mantissa) = cast::<_, f64>(x).split();
        return (s.splat_f64s(exponent), s.splat_f64s(mantissa));
    }
    let bits: S::u64s = cast(x);
    let offset = s.splat_u64s(OFFSET << 52);
    let above = s.add_u64s(s.sub_u64s(bits, s.splat_u64s(ROOT_HALF)), offset);
    let exponent = s.and_u64s(above, s.splat_u64s(EXPONENT));
    let low: S::u64s = cast(s.wrapping_dyn_shr_u32s(cast(exponent), s.splat_u32s(HIGH_BITS)));
    let whole = s.or_u64s(low, s.splat_u64s(WHOLE.to_bits()));
    let k = s.sub_f64s(cast(whole), s.splat_f64s(WHOLE + OFFSET as f64));
    (k, cast(s.sub_u64s(bits, s.sub_u64s(exponent, offset))))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Functions of groups, and the same of each number by itself.
    struct Compare<'a>(&'a [f64], &'a mut u64);

    fn functions<T: Base>(x: T) -> [T; 10] {
        let (sin, cos) = elementary::sin_cos(x);
        let mixed = x.floored(0.25) - x * 3.0;
        let size = x.abs();
        [x.exp(), size.ln(), size.ln_1p(), x.tanh(), size.asinh(), size.atan(), sin, cos, x.sqrt(), mixed]
    }

    impl Columns for Compare<'_> {
        fn rows(&self) -> usize {
            self.0.len()
        }
        #[inline(always)]
        fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
            let numbers = &self.0[first..first + K * S::F64_LANES];
            let mut out = [0.0; WIDEST];
            for (f, all) in functions(Pack::<S, K>::load(simd, numbers)).into_iter().enumerate() {
                all.store(&mut out);
                for (x, y) in numbers.iter().zip(out) {
                    let alone = functions(*x)[f];
                    let same = alone.to_bits() == y.to_bits() || alone.is_nan() && y.is_nan();
                    assert!(same, "{f}({x}): {y} {alone}");
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
        let mut numbers: Vec<f64> = (0..32_000)
            .map(|i| {
                let sign = if i % 3 == 0 { -1.0 } else { 1.0 };
                sign * 10f64.powf(f64::from(i) * 0.02 - 320.0)
            })
            .collect();
        numbers.extend([0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 5e-324, 709.5, -709.0]);
        numbers.extend([1.0; 8]);
        for instructions in all {
            let mut compared = 0;
            dispatch(instructions, Compare(&numbers, &mut compared));
            assert_eq!(compared, 10 * numbers.len() as u64);
        }
    }
}
