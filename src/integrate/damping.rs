//! Damping within groups of coupled velocities, and the step of the velocities against it, for all groups at once.
//!
//! ```text
//! (I + Z + Z^2/2 + Z^3/6) dv = (I + Z/2 + Z^2/6) h (a + D p),   Z = h E
//!                       dv/h = a + D p - E s,   s = (3 I + 2 Z + Z^2) (6 I + 3 Z + Z^2)^-1 dv
//! ```
//!
//! a accelerations with velocities that were predicted to change by p, D damping, E = D but for groups that damp each other.
//! Damping acts at the velocities that have changed by s: half of dv where it is slow against 1/h, and all of it where it is
//! fast. Of a decay at rate r a step leaves 1/(1 + z + z^2/2 + z^3/6) with z = h r: exp(-z) to third order, and never less
//! than zero.

use crate::scalar::{Columns, Numeric, Pack, WIDEST, dispatch};
use nalgebra::Matrix3;
use pulp::{Arch, Simd};

/// A matrix for each group: a column of numbers for each entry, as long as whole groups of vector instructions need.
pub type MatrixColumns = [[Vec<f64>; 3]; 3];
/// A vector for each group.
pub type VectorColumns = [Vec<f64>; 3];

/// Vectors of zeros for `n` groups.
pub(crate) fn zero_vectors(n: usize) -> VectorColumns {
    std::array::from_fn(|_| vec![0.0; n.next_multiple_of(WIDEST)])
}

/// Damping of every group, D = -da/dv or a positive approximation of it, in columns.
#[derive(Clone, Debug)]
pub struct GroupDamping {
    /// D by row and column of the matrix, then group, 1/s; zero in unused places. What is beyond the last group is of no
    /// meaning, but finite.
    pub rates: MatrixColumns,
    /// E/D: 1, or 2 for groups that damp each other and take each other's predicted velocity, which only then is stable.
    weights: Vec<f64>,
    groups: usize,
}

impl GroupDamping {
    /// No damping of this many groups.
    pub fn new(groups: usize) -> Self {
        let rates: MatrixColumns = std::array::from_fn(|_| zero_vectors(groups));
        Self { weights: vec![1.0; rates[0][0].len()], rates, groups }
    }

    /// Sets D of one group, 1/s, and E/D.
    ///
    /// # Panics
    /// If there is no such group.
    pub fn set(&mut self, group: usize, rates: &Matrix3<f64>, weight: f64) {
        for i in 0..3 {
            for k in 0..3 {
                self.rates[i][k][group] = rates[(i, k)];
            }
        }
        self.weights[group] = weight;
    }

    /// A step of size `h` (s) of one group from the accelerations `a` at velocities that were predicted to change by `p`.
    ///
    /// # Panics
    /// If there is no such group.
    pub(crate) fn step_one(&self, group: usize, h: f64, p: [f64; 3], a: [f64; 3]) -> GroupStep<f64> {
        let rates = self.rates.each_ref().map(|row| row.each_ref().map(|column| column[group]));
        step(&rates, self.weights[group], h, p, a)
    }

    /// Steps of all groups: `a` becomes the mean acceleration, `p` the change at which damping acts. Not finite where there is
    /// no step.
    pub(crate) fn step(&self, h: f64, p: &mut VectorColumns, a: &mut VectorColumns, instructions: Arch) {
        dispatch(instructions, Step { damping: self, h, p, a });
    }
}

/// What becomes of one group, or several at once, in a step.
pub(crate) struct GroupStep<T> {
    /// dv/h, m/s^2 and its kin.
    pub mean_acceleration: [T; 3],
    /// s, the change of the velocities at which damping acts, m/s and its kin.
    pub acting: [T; 3],
}

struct Step<'a> {
    damping: &'a GroupDamping,
    h: f64,
    p: &'a mut VectorColumns,
    a: &'a mut VectorColumns,
}

/// By Cramer's rule for `w = (6 I + 3 Z + Z^2)^-1 dv/h`: `(6 I + 6 Z + 3 Z^2 + Z^3) w = a + D p`.
#[inline(always)]
fn step<T: Numeric>(rates: &[[T; 3]; 3], weight: T, h: f64, p: [T; 3], a: [T; 3]) -> GroupStep<T> {
    let z = rates.map(|row| row.map(|rate| rate * weight * h));
    let square = product(&z, &z);
    let cube = product(&square, &z);
    let zero = p[0].like(0.0);
    // Columns of the matrix, and the right side.
    let mut m = [[zero; 3]; 3];
    let mut right = a;
    for i in 0..3 {
        for k in 0..3 {
            let identity = if i == k { 6.0 } else { 0.0 };
            m[k][i] = z[i][k] * 6.0 + square[i][k] * 3.0 + cube[i][k] + identity;
            right[i] += rates[i][k] * p[k];
        }
    }
    let [a, b, c] = m;
    let (bc, ca, ab) = (cross(&b, &c), cross(&c, &a), cross(&a, &b));
    let inverse = zero.like(1.0) / dot(&a, &bc);
    let w = [dot(&bc, &right) * inverse, dot(&ca, &right) * inverse, dot(&ab, &right) * inverse];
    let [once, twice] = [&z, &square].map(|m| [dot(&m[0], &w), dot(&m[1], &w), dot(&m[2], &w)]);
    GroupStep {
        mean_acceleration: [0, 1, 2].map(|i| w[i] * 6.0 + once[i] * 3.0 + twice[i]),
        acting: [0, 1, 2].map(|i| (w[i] * 3.0 + once[i] * 2.0 + twice[i]) * h),
    }
}

#[inline(always)]
fn product<T: Numeric>(a: &[[T; 3]; 3], b: &[[T; 3]; 3]) -> [[T; 3]; 3] {
    a.map(|row| [0, 1, 2].map(|k| row[0] * b[0][k] + row[1] * b[1][k] + row[2] * b[2][k]))
}

#[inline(always)]
fn cross<T: Numeric>(a: &[T; 3], b: &[T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn dot<T: Numeric>(a: &[T; 3], b: &[T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Columns for Step<'_> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.damping.groups
    }

    #[inline(always)]
    #[expect(clippy::needless_range_loop, reason = "iterators might not be inlined")]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let zero = Pack::<S, K>::all(simd, 0.0);
        let (mut rates, mut p, mut a) = ([[zero; 3]; 3], [zero; 3], [zero; 3]);
        for i in 0..3 {
            p[i] = Pack::load(simd, &self.p[i][first..]);
            a[i] = Pack::load(simd, &self.a[i][first..]);
            for k in 0..3 {
                rates[i][k] = Pack::load(simd, &self.damping.rates[i][k][first..]);
            }
        }
        let weight = Pack::load(simd, &self.damping.weights[first..]);
        let step = step(&rates, weight, self.h, p, a);
        for i in 0..3 {
            step.mean_acceleration[i].store(&mut self.a[i][first..]);
            step.acting[i].store(&mut self.p[i][first..]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn every_group_makes_its_step() {
        let n = 21;
        let mut damping = GroupDamping::new(n);
        let (mut p, mut a) = (zero_vectors(n), zero_vectors(n));
        let number = |i: usize| ((i * 37) % 17) as f64 - 8.0;
        let h = 0.01;
        let mut expected = Vec::new();
        for g in 0..n {
            let rates = Matrix3::from_fn(|i, k| number(9 * g + 3 * i + k));
            let weight = 1.0 + (g % 2) as f64;
            damping.set(g, &rates, weight);
            let [known, predicted] = [0, 5].map(|s| Vector3::from_fn(|k, _| number(4 * g + k + s)));
            for k in 0..3 {
                (p[k][g], a[k][g]) = (predicted[k], known[k]);
            }
            let (one, e) = (Matrix3::identity(), rates * weight);
            let z = e * h;
            let matrix = one + z + z * z / 2.0 + z * z * z / 6.0;
            let right = (one + z / 2.0 + z * z / 6.0) * h * (known + rates * predicted);
            let dv = matrix.lu().solve(&right).unwrap();
            let inner = (one * 6.0 + z * 3.0 + z * z).lu().solve(&dv).unwrap();
            let acting = (one * 3.0 + z * 2.0 + z * z) * inner;
            assert!((known + rates * predicted - e * acting - dv / h).norm() < 1e-11 * dv.norm() / h);
            expected.push((dv / h, acting));
        }
        let mut scalar = Vec::new();
        for g in 0..n {
            let [p, a] = [&p, &a].map(|columns| [0, 1, 2].map(|k| columns[k][g]));
            scalar.push(damping.step_one(g, h, p, a));
        }
        damping.step(h, &mut p, &mut a, Arch::new());
        for (g, ((x, s), one)) in expected.iter().zip(scalar).enumerate() {
            for k in 0..3 {
                let differ = [a[k][g] - x[k], one.mean_acceleration[k] - x[k]];
                assert!(differ.iter().all(|d| d.abs() < 1e-11 * x.norm()), "{g} {k}: {differ:?}");
                let differ = [p[k][g] - s[k], one.acting[k] - s[k]];
                assert!(differ.iter().all(|d| d.abs() < 1e-9 * s.norm()), "{g} {k}: {differ:?} {s}");
            }
        }
    }
}
