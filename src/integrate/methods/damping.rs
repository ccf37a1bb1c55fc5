//! Damping within groups of coupled velocities, and the step of the velocities against it, for all groups at once.

use crate::scalar::{Columns, Numeric, Pack, WIDEST, dispatch};
use nalgebra::Matrix3;
use pulp::{Arch, Simd};

/// -da/dv of up to three coupled velocities (zero in unused places), or a positive approximation of it, 1/s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DampingBlock {
    /// D, all of it.
    pub full: Matrix3<f64>,
    /// D_i, the share of it that acts on the change of the step: half for the trapezoidal rule, all where rates exceed 1/h by
    /// far. See [`implicit_share`].
    pub implicit: Matrix3<f64>,
}

/// Share of the change in a step at which a decay at rate r acts, z = h r >= 0: `(3 + 2 z + z^2)/(6 + 3 z + z^2)`.
///
/// One half for slow decays (second order), towards one for fast ones. A step of `v' = -r v` leaves
/// `1/(1 + z + z^2/2 + z^3/6)`: exp(-z) to third order, and never less than zero.
#[inline]
pub fn implicit_share(z: f64) -> f64 {
    // All of it where z is not finite.
    if z < 1e100 { (3.0 + z * (2.0 + z)) / (6.0 + z * (3.0 + z)) } else { 1.0 }
}

/// A matrix for each group: a column of numbers for each entry, as long as whole groups of vector instructions need.
pub type MatrixColumns = [[Vec<f64>; 3]; 3];
/// A vector for each group.
pub type VectorColumns = [Vec<f64>; 3];

/// Vectors of zeros for `n` groups.
pub(crate) fn zero_vectors(n: usize) -> VectorColumns {
    std::array::from_fn(|_| vec![0.0; n.next_multiple_of(WIDEST)])
}

/// The damping of every group, in columns.
#[derive(Clone, Debug)]
pub struct GroupDamping {
    /// D by row and column of the matrix, then group, 1/s. What is beyond the last group is of no meaning, but finite.
    pub full: MatrixColumns,
    /// D_i.
    pub implicit: MatrixColumns,
    groups: usize,
}

impl GroupDamping {
    /// No damping of this many groups.
    pub fn new(groups: usize) -> Self {
        let zero = std::array::from_fn(|_| zero_vectors(groups));
        Self { full: zero.clone(), implicit: zero, groups }
    }

    /// Sets that of one group.
    ///
    /// # Panics
    /// If there is no such group.
    pub fn set(&mut self, group: usize, block: &DampingBlock) {
        for i in 0..3 {
            for k in 0..3 {
                self.full[i][k][group] = block.full[(i, k)];
                self.implicit[i][k][group] = block.implicit[(i, k)];
            }
        }
    }

    /// The solution `x` of `(I + h D_i) x = y + D p` for one group.
    ///
    /// # Panics
    /// If there is no such group.
    pub(crate) fn solve_one(&self, group: usize, h: f64, p: [f64; 3], y: [f64; 3]) -> [f64; 3] {
        let (mut implicit, mut full) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
        for i in 0..3 {
            for k in 0..3 {
                implicit[i][k] = self.implicit[i][k][group];
                full[i][k] = self.full[i][k][group];
            }
        }
        solve(&implicit, &full, h, p, y)
    }

    /// Solves `(I + h D_i) x = y + D p` for every group; `y` becomes `x`, which is not finite where there is none.
    pub(crate) fn solve(&self, h: f64, p: &VectorColumns, y: &mut VectorColumns, instructions: Arch) {
        dispatch(instructions, Solve { damping: self, h, p, y });
    }
}

struct Solve<'a> {
    damping: &'a GroupDamping,
    h: f64,
    p: &'a VectorColumns,
    y: &'a mut VectorColumns,
}

/// One group, or several at once, by Cramer's rule.
#[inline(always)]
fn solve<T: Numeric>(implicit: &[[T; 3]; 3], full: &[[T; 3]; 3], h: f64, p: [T; 3], y: [T; 3]) -> [T; 3] {
    let zero = p[0].like(0.0);
    // Columns of the matrix, and the right side.
    let mut m = [[zero; 3]; 3];
    let mut right = y;
    for i in 0..3 {
        for k in 0..3 {
            let identity = if i == k { 1.0 } else { 0.0 };
            m[k][i] = implicit[i][k] * h + identity;
            right[i] += full[i][k] * p[k];
        }
    }
    let [a, b, c] = m;
    let (bc, ca, ab) = (cross(&b, &c), cross(&c, &a), cross(&a, &b));
    let inverse = zero.like(1.0) / dot(&a, &bc);
    [dot(&bc, &right) * inverse, dot(&ca, &right) * inverse, dot(&ab, &right) * inverse]
}

#[inline(always)]
fn cross<T: Numeric>(a: &[T; 3], b: &[T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn dot<T: Numeric>(a: &[T; 3], b: &[T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Columns for Solve<'_> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.damping.groups
    }

    #[inline(always)]
    #[expect(clippy::needless_range_loop, reason = "iterators might not be inlined")]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let zero = Pack::<S, K>::all(simd, 0.0);
        let (mut implicit, mut full, mut p, mut y) = ([[zero; 3]; 3], [[zero; 3]; 3], [zero; 3], [zero; 3]);
        for i in 0..3 {
            p[i] = Pack::load(simd, &self.p[i][first..]);
            y[i] = Pack::load(simd, &self.y[i][first..]);
            for k in 0..3 {
                implicit[i][k] = Pack::load(simd, &self.damping.implicit[i][k][first..]);
                full[i][k] = Pack::load(simd, &self.damping.full[i][k][first..]);
            }
        }
        let x = solve(&implicit, &full, self.h, p, y);
        for i in 0..3 {
            x[i].store(&mut self.y[i][first..]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn every_group_is_solved() {
        let n = 21;
        let mut damping = GroupDamping::new(n);
        let (mut p, mut y) = (zero_vectors(n), zero_vectors(n));
        let number = |i: usize| ((i * 37) % 17) as f64 - 8.0;
        let h = 0.01;
        let mut expected = Vec::new();
        for g in 0..n {
            let full = Matrix3::from_fn(|i, k| number(9 * g + 3 * i + k));
            let block = DampingBlock { full, implicit: full * 0.7 };
            damping.set(g, &block);
            let [known, predicted] = [0, 5].map(|s| Vector3::from_fn(|k, _| number(4 * g + k + s)));
            for k in 0..3 {
                (p[k][g], y[k][g]) = (predicted[k], known[k]);
            }
            let matrix = Matrix3::identity() + block.implicit * h;
            expected.push(matrix.lu().solve(&(known + full * predicted)).unwrap());
        }
        damping.solve(h, &p, &mut y, Arch::new());
        for (g, x) in expected.iter().enumerate() {
            for k in 0..3 {
                assert!((y[k][g] - x[k]).abs() < 1e-11 * x.norm(), "{g} {k}: {} {}", y[k][g], x[k]);
            }
        }
    }
}
