//! Damping within groups of coupled velocities, and the step of the velocities against it: of all spokes at once, of each body
//! of the hub by itself.

use crate::integrate::Structure;
use crate::integrate::linear::{Scales, decompose, substitute};
use crate::scalar::{Columns, Lanes, Numeric, Pack, ZEROS, blocks_for, dispatch, place_of};
use nalgebra::DMatrix;
use pulp::{Arch, Simd};

/// -da/dv of the velocities of one body, or a positive approximation of it, 1/s.
#[derive(Clone, Debug, PartialEq)]
pub struct DampingBlock {
    /// D, all of it.
    pub full: DMatrix<f64>,
    /// D_i over D, the share of it that acts on the change of the step: half for the trapezoidal rule, all where rates exceed 1/h by
    /// far, and up to twice as much where two bodies damp each other. See [`implicit_share`].
    pub share: f64,
}

impl DampingBlock {
    /// Finds the implicit share of it for a step of size `h` (s) from its largest diagonal entry, times `factor`.
    pub fn split(&mut self, h: f64, factor: f64) {
        let diagonal = self.full.as_slice().iter().step_by(self.full.nrows() + 1);
        let largest = diagonal.fold(0.0, |largest: f64, x| largest.max(x.abs()));
        self.share = implicit_share(h * largest) * factor;
    }
}

/// Share of the change in a step at which a decay at rate r acts, z = h r >= 0: `(3 + 2 z + z^2)/(6 + 3 z + z^2)`.
///
/// One half for slow decays (second order), towards one for fast ones. A step of `v' = -r v` leaves
/// `1/(1 + z + z^2/2 + z^3/6)`: exp(-z) to third order, and never less than zero.
#[inline(always)]
pub fn implicit_share<T: Numeric>(z: T) -> T {
    let share = (z * (z + 2.0) + 3.0) / (z * (z + 3.0) + 6.0);
    // All of it where z is not finite.
    T::select(z.below(1e100), share, z.like(1.0))
}

/// A vector for each spoke of a block.
pub type VectorLanes<const N: usize> = [Lanes; N];

/// Vectors of zeros for `n` spokes.
pub(crate) fn zero_vectors<const N: usize>(n: usize) -> Vec<VectorLanes<N>> {
    vec![[ZEROS; N]; blocks_for(n)]
}

/// Damping of a block of spokes by row and column of their matrices, 1/s. What is beyond the last spoke is of no meaning, but
/// finite.
#[derive(Clone, Debug)]
pub struct SpokeDamping<const N: usize> {
    /// D.
    pub full: [VectorLanes<N>; N],
    /// D_i.
    pub implicit: [VectorLanes<N>; N],
}

/// The damping of every spoke and of every body of the hub.
#[derive(Clone, Debug)]
pub struct GroupDamping<const N: usize> {
    /// Of the spokes, in blocks.
    pub spokes: Vec<SpokeDamping<N>>,
    /// Of the bodies of the hub.
    pub bodies: Vec<DampingBlock>,
    /// Number of spokes.
    count: usize,
    /// For bodies of other numbers of velocities than the closed form is for.
    elimination: Elimination,
}

/// Memory of an elimination.
#[derive(Clone, Debug)]
struct Elimination {
    matrix: Vec<f64>,
    size: Vec<f64>,
    scales: [Vec<f64>; 2],
    order: Vec<usize>,
    x: Vec<f64>,
}

impl<const N: usize> GroupDamping<N> {
    /// No damping.
    pub fn new(structure: &Structure<N>) -> Self {
        let count = structure.spokes.len();
        let zero = SpokeDamping { full: [[ZEROS; N]; N], implicit: [[ZEROS; N]; N] };
        let block = |n: usize| DampingBlock { full: DMatrix::zeros(n, n), share: 0.0 };
        let widest = structure.bodies.iter().map(ExactSizeIterator::len).max().unwrap_or(0);
        let (column, square) = (vec![0.0; widest], vec![0.0; widest * widest]);
        Self {
            spokes: vec![zero; blocks_for(count)],
            bodies: structure.bodies.iter().map(|body| block(body.len())).collect(),
            count,
            elimination: Elimination {
                matrix: square.clone(),
                size: square,
                scales: [column.clone(), column.clone()],
                order: vec![0; widest],
                x: column,
            },
        }
    }

    /// Solves `(I + h D_i) x = y + D p` for one body of the hub; `y` becomes `x`, which is not finite where there is none.
    ///
    /// # Panics
    /// If there is no such body.
    pub(crate) fn solve_body(&mut self, body: usize, h: f64, p: &[f64], y: &mut [f64]) {
        let DampingBlock { full, share } = &self.bodies[body];
        let n = full.nrows();
        match n {
            2 => return step_closed::<2>(&self.bodies[body], h, p, y),
            3 => return step_closed::<3>(&self.bodies[body], h, p, y),
            _ => {}
        }
        let Elimination { matrix, size, scales: [columns, weights], order, x } = &mut self.elimination;
        for i in 0..n {
            order[i] = i;
            for k in 0..n {
                matrix[i * n + k] = full[(i, k)] * share * h + f64::from(u8::from(i == k));
                size[i * n + k] = matrix[i * n + k].abs();
                y[i] += full[(i, k)] * p[k];
            }
        }
        let [matrix, size] = [&mut matrix[..n * n], &mut size[..n * n]];
        let scales = Scales { size, columns: &mut columns[..n], weights: &mut weights[..n] };
        if !decompose(n, matrix, &mut order[..n], scales) {
            return y.fill(f64::NAN);
        }
        for (x, i) in x.iter_mut().zip(&order[..n]) {
            *x = y[*i];
        }
        substitute(n, 1, matrix, &mut x[..n]);
        y.copy_from_slice(&x[..n]);
    }

    /// Solves `(I + h D_i) x = y + D p` for every spoke; `y` becomes `x`, which is not finite where there is none.
    pub(crate) fn solve_spokes(
        &self,
        h: f64,
        p: &[VectorLanes<N>],
        y: &mut [VectorLanes<N>],
        instructions: Arch,
    ) {
        dispatch(instructions, Solve { damping: self, h, p, y });
    }
}

/// The step of a body of M velocities, at most three, by the closed form.
fn step_closed<const M: usize>(block: &DampingBlock, h: f64, p: &[f64], y: &mut [f64]) {
    let (mut full, mut ahead, mut right) = ([[0.0; 3]; 3], [0.0; 3], [0.0; 3]);
    for (k, column) in block.full.as_slice().as_chunks::<M>().0.iter().enumerate().take(M) {
        for i in 0..M {
            full[i][k] = column[i];
        }
    }
    ahead[..M].copy_from_slice(&p[..M]);
    right[..M].copy_from_slice(&y[..M]);
    let implicit = full.map(|row| row.map(|x| x * block.share));
    y[..M].copy_from_slice(&solve(&implicit, &full, h, ahead, right)[..M]);
}

struct Solve<'a, const N: usize> {
    damping: &'a GroupDamping<N>,
    h: f64,
    p: &'a [VectorLanes<N>],
    y: &'a mut [VectorLanes<N>],
}

/// One group, or several at once: three velocities by Cramer's rule, which divides once, others by elimination. Damping and
/// inertia are positive, so the diagonal is always a pivot.
#[inline(always)]
#[expect(clippy::needless_range_loop, reason = "iterators might not be inlined")]
fn solve<T: Numeric, const N: usize>(
    implicit: &[[T; N]; N],
    full: &[[T; N]; N],
    h: f64,
    p: [T; N],
    y: [T; N],
) -> [T; N] {
    let zero = p[0].like(0.0);
    // Columns of the matrix, and the right side.
    let mut m = [[zero; N]; N];
    let mut right = y;
    for i in 0..N {
        for k in 0..N {
            let identity = if i == k { 1.0 } else { 0.0 };
            m[k][i] = implicit[i][k] * h + identity;
            right[i] += full[i][k] * p[k];
        }
    }
    if N == 3 {
        let [a, b, c] = [0, 1, 2].map(|k| [m[k][0], m[k][1], m[k][2]]);
        let right = [right[0], right[1], right[2]];
        let (bc, ca, ab) = (cross(&b, &c), cross(&c, &a), cross(&a, &b));
        let inverse = zero.like(1.0) / dot(&a, &bc);
        let x = [dot(&bc, &right) * inverse, dot(&ca, &right) * inverse, dot(&ab, &right) * inverse];
        return std::array::from_fn(|i| x[i]);
    }
    for k in 0..N {
        let inverse = zero.like(1.0) / m[k][k];
        for i in k + 1..N {
            let factor = m[k][i] * inverse;
            for j in k + 1..N {
                m[j][i] -= factor * m[j][k];
            }
            right[i] -= factor * right[k];
        }
    }
    for k in (0..N).rev() {
        for j in k + 1..N {
            right[k] -= m[j][k] * right[j];
        }
        right[k] = right[k] / m[k][k];
    }
    right
}

#[inline(always)]
fn cross<T: Numeric>(a: &[T; 3], b: &[T; 3]) -> [T; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn dot<T: Numeric>(a: &[T; 3], b: &[T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl<const N: usize> Columns for Solve<'_, N> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.damping.count
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (block, lane) = place_of(first);
        let (damping, p_of, y_of) = (&self.damping.spokes[block], &self.p[block], &mut self.y[block]);
        let zero = Pack::<S, K>::all(simd, 0.0);
        let (mut implicit, mut full, mut p, mut y) = ([[zero; N]; N], [[zero; N]; N], [zero; N], [zero; N]);
        for i in 0..N {
            p[i] = Pack::load(simd, &p_of[i][lane..]);
            y[i] = Pack::load(simd, &y_of[i][lane..]);
            for k in 0..N {
                implicit[i][k] = Pack::load(simd, &damping.implicit[i][k][lane..]);
                full[i][k] = Pack::load(simd, &damping.full[i][k][lane..]);
            }
        }
        let x = solve(&implicit, &full, self.h, p, y);
        for i in 0..N {
            x[i].store(&mut y_of[i][lane..]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Spokes of N velocities and bodies of every size, against a dense solver.
    fn check<const N: usize>() {
        let n = 21;
        let bodies = [1, 2, 3, 6, 8];
        let structure = Structure::<N> {
            hub: (0..20).collect(),
            bodies: vec![0..1, 1..3, 3..6, 6..12, 12..20],
            rim: false,
            spokes: vec![[0; N]; n],
        };
        let mut damping = GroupDamping::new(&structure);
        let number = |i: usize| ((i * 37) % 17) as f64 - 8.0;
        let (h, mut seed) = (0.01, 0);
        let mut problem = |n: usize| {
            seed += 1;
            let full =
                DMatrix::from_fn(n, n, |i, k| number(9 * seed + 3 * i + k) + if i == k { 9.0 } else { 0.0 });
            let share = 0.7;
            let implicit = &full * share;
            let [known, ahead] =
                [0, 5].map(|s| nalgebra::DVector::from_fn(n, |k, _| number(4 * seed + k + s)));
            let x = (DMatrix::identity(n, n) + &implicit * h).lu().solve(&(&known + &full * &ahead)).unwrap();
            (DampingBlock { full, share }, known, ahead, x)
        };
        let (mut p, mut y) = (zero_vectors::<N>(n), zero_vectors::<N>(n));
        let mut expected = Vec::new();
        for g in 0..n {
            let (block, known, ahead, x) = problem(N);
            let (b, lane) = place_of(g);
            for i in 0..N {
                (p[b][i][lane], y[b][i][lane]) = (ahead[i], known[i]);
                for k in 0..N {
                    damping.spokes[b].full[i][k][lane] = block.full[(i, k)];
                    damping.spokes[b].implicit[i][k][lane] = block.full[(i, k)] * block.share;
                }
            }
            expected.push(x);
        }
        damping.solve_spokes(h, &p, &mut y, Arch::new());
        for (g, x) in expected.iter().enumerate() {
            let (b, lane) = place_of(g);
            for k in 0..N {
                let found = y[b][k][lane];
                assert!((found - x[k]).abs() < 1e-11 * x.norm(), "{g} {k}: {found} {}", x[k]);
            }
        }
        for (body, n) in bodies.into_iter().enumerate() {
            let (block, known, ahead, x) = problem(n);
            damping.bodies[body] = block;
            let mut y = known.as_slice().to_vec();
            damping.solve_body(body, h, ahead.as_slice(), &mut y);
            assert!(y.iter().zip(&x).all(|(y, x)| (y - x).abs() < 1e-11), "{n}: {y:?} {x}");
        }
    }

    #[test]
    fn every_group_is_solved() {
        check::<2>();
        check::<3>();
        check::<6>();
    }
}
