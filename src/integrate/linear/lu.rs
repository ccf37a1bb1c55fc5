//! Triangular factors of a small matrix of `n` rows, given as rows one after another. Inlined, so that sizes that are known when
//! the library is compiled cost no loops.

use super::matrix::Number;

/// Spokes of more unknowns take so long themselves that it does not matter how their hub is reached.
pub(super) const LIGHT_SPOKE: usize = 3;

/// Calls a function with the size of a hub, of light spokes by its type for a cage and for a cage with a ring: loops of known length are quicker.
macro_rules! with_width {
    ($spoke:expr, $width:expr, $n:ident => $call:expr) => {
        match $width {
            5 if $spoke <= crate::integrate::linear::lu::LIGHT_SPOKE => {
                let $n = nalgebra::Const::<5>;
                $call
            }
            3 if $spoke <= crate::integrate::linear::lu::LIGHT_SPOKE => {
                let $n = nalgebra::Const::<3>;
                $call
            }
            width => {
                let $n = nalgebra::Dyn(width);
                $call
            }
        }
    };
}
pub(super) use with_width;

/// A pivot below this share of the terms whose difference it is consists of rounding: the matrix is singular.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// What pivots are chosen and judged by.
pub(crate) struct Scales<'a> {
    /// Magnitude of the terms that each entry is a sum of, as far as it is known.
    pub(crate) size: &'a mut [f64],
    /// Memory for a number of each column, and of each row.
    pub(crate) columns: &'a mut [f64],
    pub(crate) weights: &'a mut [f64],
}

/// Factorises the matrix in place, with the inverse of the diagonal. `order` becomes the row that each row came from, if it
/// begins as 0, 1, 2 ... False when the matrix is singular within rounding or not finite.
#[inline(always)]
pub(crate) fn decompose<T: Number>(n: usize, a: &mut [T], order: &mut [usize], scales: Scales<'_>) -> bool {
    let Scales { size, columns, weights } = scales;
    let ([size, columns, weights], a) =
        ([&mut size[..n * n], &mut columns[..n], &mut weights[..n]], &mut a[..n * n]);
    if !weigh_rows(n, a, columns, weights) {
        return false;
    }
    for k in 0..n {
        let mut best = k;
        for i in k + 1..n {
            if a[i * n + k].norm1() * weights[i] > a[best * n + k].norm1() * weights[best] {
                best = i;
            }
        }
        if best != k {
            for j in 0..n {
                a.swap(k * n + j, best * n + j);
                size.swap(k * n + j, best * n + j);
            }
            weights.swap(k, best);
            order.swap(k, best);
        }
        let inverse = a[k * n + k].recip();
        // Also false for what is not a number. The inverse of a huge complex number is zero.
        let sound =
            a[k * n + k].norm1() > ROUNDING * size[k * n + k] && inverse.is_finite() && !inverse.is_zero();
        if !sound {
            return false;
        }
        a[k * n + k] = inverse;
        for i in k + 1..n {
            let l = a[i * n + k] * inverse;
            a[i * n + k] = l;
            for j in k + 1..n {
                let term = l * a[k * n + j];
                a[i * n + j] -= term;
                size[i * n + j] = size[i * n + j].max(term.norm1());
            }
        }
    }
    true
}

/// Replaces `m` right-hand sides, given by their rows in the order of the factors, by the solutions.
#[inline(always)]
pub(crate) fn substitute<T: Number>(n: usize, m: usize, rows: &[T], x: &mut [T]) {
    let (rows, x) = (&rows[..n * n], &mut x[..n * m]);
    for i in 1..n {
        let (known, rest) = x.split_at_mut(i * m);
        for j in 0..i {
            subtract(&mut rest[..m], rows[i * n + j], &known[j * m..(j + 1) * m]);
        }
    }
    for i in (0..n).rev() {
        let (rest, known) = x.split_at_mut((i + 1) * m);
        let own = &mut rest[i * m..];
        for j in i + 1..n {
            let at = (j - i - 1) * m;
            subtract(own, rows[i * n + j], &known[at..at + m]);
        }
        own.iter_mut().for_each(|x| *x *= rows[i * n + i]);
    }
}

/// Powers of two that bring rows to one after columns have been brought to one. False if an entry is not finite.
#[inline(always)]
fn weigh_rows<T: Number>(n: usize, a: &[T], columns: &mut [f64], weights: &mut [f64]) -> bool {
    columns.fill(0.0);
    for i in 0..n {
        for j in 0..n {
            columns[j] += a[i * n + j].norm1();
        }
    }
    if !columns.iter().sum::<f64>().is_finite() {
        return false;
    }
    columns.iter_mut().for_each(|x| *x = inverse_power(*x));
    for i in 0..n {
        weights[i] = 0.0;
        for j in 0..n {
            weights[i] += a[i * n + j].norm1() * columns[j];
        }
        weights[i] = inverse_power(weights[i]);
    }
    true
}

/// A power of two near 1/x, of a finite x >= 0.
#[inline]
fn inverse_power(x: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    f64::from_bits((0x7fe << 52) - (x.to_bits() & EXPONENT))
}

/// a -= factor b
#[inline(always)]
pub(crate) fn subtract<T: Number>(a: &mut [T], factor: T, b: &[T]) {
    for (a, b) in a.iter_mut().zip(b) {
        *a -= factor * *b;
    }
}
