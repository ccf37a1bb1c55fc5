//! Linear systems of one shared group of unknowns, the hub, and small groups, the spokes, that touch only the hub.
//!
//! ```text
//! | S   U_1  U_2 ..|  | s   |   | b   |      S   hub
//! | V_1 A_1        |  | x_1 | = | c_1 |      A_j spoke j
//! | V_2      A_2   |  | x_2 |   | c_2 |      U_j to_hub,  V_j from_hub
//! | :           .. |  | :   |   | :   |
//!
//! T_j = A_j^-1 V_j,   y_j = A_j^-1 c_j
//! (S - sum U_j T_j) s = b - sum U_j y_j,   x_j = y_j - T_j s
//! ```
//!
//! The cost is linear in the number of spokes. Rows and columns may differ in scale by many orders: pivots are
//! chosen as if both were scaled to one. Inverses are never formed: with stiff, nearly singular groups they would
//! lose what cancels between hub and spokes.
//!
//! A singular spoke in a matrix that is not singular stops this elimination; such a matrix is solved as a dense one.

use super::dense::DenseFactors;
use super::matrix::{Arrowhead, HUB, Number, SPOKE};
use nalgebra::SVector;

/// A pivot below this share of the terms whose difference it is consists of rounding: the matrix is singular.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The factors of an [`Arrowhead`]. Memory is taken once, but for the dense fallback.
#[derive(Clone, Debug)]
pub struct Factors<T: Number = f64> {
    hub: Lu<T, HUB>,
    spokes: Vec<SpokeFactors<T>>,
    /// Factors of the last matrix, if the others are of no use.
    dense: Option<DenseFactors<T>>,
}

#[derive(Clone, Copy, Debug)]
struct SpokeFactors<T> {
    own: Lu<T, SPOKE>,
    /// Columns of U_j.
    to_hub: [[T; HUB]; SPOKE],
    /// Rows of T_j.
    response: [[T; HUB]; SPOKE],
}

impl<T: Number> Factors<T> {
    /// The factors of the identity with this number of spokes.
    pub fn new(spokes: usize) -> Self {
        let zero = [[T::zero(); HUB]; SPOKE];
        let spoke = SpokeFactors { own: Lu::identity(), to_hub: zero, response: zero };
        Self { hub: Lu::identity(), spokes: vec![spoke; spokes], dense: None }
    }

    /// Factorises a matrix. False when it is singular within rounding or not finite; the factors are then of no use.
    ///
    /// # Panics
    /// If the numbers of spokes differ.
    #[must_use]
    pub fn factorize(&mut self, a: &Arrowhead<T>) -> bool {
        assert_eq!(a.spokes.len(), self.spokes.len());
        self.dense = None;
        if self.eliminate(a) {
            return true;
        }
        self.dense = DenseFactors::new(a);
        self.dense.is_some()
    }

    /// Factorises by blocks; false when a block has no inverse.
    fn eliminate(&mut self, a: &Arrowhead<T>) -> bool {
        // Columns of the Schur complement.
        let mut schur: [[T; HUB]; HUB] = a.hub.data.0;
        for (spoke, factors) in a.spokes.iter().zip(&mut self.spokes) {
            let own = transposed(&spoke.own.data.0);
            if !factors.own.decompose(own, own.map(|row| row.map(T::norm1))) {
                return false;
            }
            factors.to_hub = spoke.to_hub.data.0;
            factors.response = factors.own.solve(&transposed(&spoke.from_hub.data.0));
            for (c, column) in schur.iter_mut().enumerate() {
                for (u, t) in factors.to_hub.iter().zip(&factors.response) {
                    subtract(column, t[c], u);
                }
            }
        }
        let schur = transposed(&schur);
        let mut size = transposed(&a.hub.data.0).map(|row| row.map(T::norm1));
        for (size, s) in size.iter_mut().flatten().zip(schur.iter().flatten()) {
            *size = size.max(s.norm1());
        }
        self.hub.decompose(schur, size)
    }

    /// Replaces the right-hand side (`hub`, `spokes`) by the solution.
    ///
    /// # Panics
    /// If the numbers of spokes differ.
    pub fn solve(&self, hub: &mut SVector<T, HUB>, spokes: &mut [SVector<T, SPOKE>]) {
        assert_eq!(spokes.len(), self.spokes.len());
        if let Some(dense) = &self.dense {
            return dense.solve(hub, spokes);
        }
        let mut s: [T; HUB] = hub.data.0[0];
        for (factors, x) in self.spokes.iter().zip(spokes.iter_mut()) {
            let y = factors.own.solve(&x.data.0[0].map(|x| [x]));
            for (u, [y]) in factors.to_hub.iter().zip(y) {
                subtract(&mut s, y, u);
            }
            *x = SVector::from(y.map(|[y]| y));
        }
        let s = self.hub.solve(&s.map(|s| [s])).map(|[s]| s);
        *hub = SVector::from(s);
        for (factors, x) in self.spokes.iter().zip(spokes) {
            for (x, t) in x.iter_mut().zip(&factors.response) {
                *x -= t.iter().zip(&s).fold(T::zero(), |sum, (t, s)| sum + *t * *s);
            }
        }
    }
}

/// Rows of the triangular factors of a small matrix, with the inverse of the diagonal.
#[derive(Clone, Copy, Debug)]
struct Lu<T, const N: usize> {
    rows: [[T; N]; N],
    /// Row of the matrix that each row came from.
    order: [usize; N],
}

impl<T: Number, const N: usize> Lu<T, N> {
    fn identity() -> Self {
        let rows =
            std::array::from_fn(|i| std::array::from_fn(|j| if i == j { T::one() } else { T::zero() }));
        Self { rows, order: std::array::from_fn(|i| i) }
    }

    /// Factorises the matrix with these rows. `size` is the magnitude of the terms that each entry is a sum of.
    #[inline]
    fn decompose(&mut self, mut a: [[T; N]; N], mut size: [[f64; N]; N]) -> bool {
        let Some(mut weight) = row_weights(&a) else { return false };
        let mut order: [usize; N] = std::array::from_fn(|i| i);
        for k in 0..N {
            let mut best = k;
            for i in k + 1..N {
                if a[i][k].norm1() * weight[i] > a[best][k].norm1() * weight[best] {
                    best = i;
                }
            }
            if best != k {
                a.swap(k, best);
                size.swap(k, best);
                weight.swap(k, best);
                order.swap(k, best);
            }
            let inverse = a[k][k].recip();
            // Also false for what is not a number. The inverse of a huge complex number is zero.
            let sound = a[k][k].norm1() > ROUNDING * size[k][k] && inverse.is_finite() && !inverse.is_zero();
            if !sound {
                return false;
            }
            a[k][k] = inverse;
            for i in k + 1..N {
                let l = a[i][k] * inverse;
                a[i][k] = l;
                for j in k + 1..N {
                    let term = l * a[k][j];
                    a[i][j] -= term;
                    size[i][j] = size[i][j].max(term.norm1());
                }
            }
        }
        (self.rows, self.order) = (a, order);
        true
    }

    /// Rows of the solution for right-hand sides with these rows.
    #[inline]
    fn solve<const M: usize>(&self, b: &[[T; M]; N]) -> [[T; M]; N] {
        let mut x = self.order.map(|i| b[i]);
        for i in 1..N {
            let (known, rest) = x.split_at_mut(i);
            for (l, known) in self.rows[i].iter().zip(known) {
                subtract(&mut rest[0], *l, known);
            }
        }
        for i in (0..N).rev() {
            let (rest, known) = x.split_at_mut(i + 1);
            for (u, known) in self.rows[i][i + 1..].iter().zip(known) {
                subtract(&mut rest[i], *u, known);
            }
            rest[i] = rest[i].map(|x| x * self.rows[i][i]);
        }
        x
    }
}

/// Powers of two that bring rows to one after columns have been brought to one. `None` if an entry is not finite.
#[inline]
fn row_weights<T: Number, const N: usize>(a: &[[T; N]; N]) -> Option<[f64; N]> {
    let mut columns = [0.0; N];
    for row in a {
        for (sum, a) in columns.iter_mut().zip(row) {
            *sum += a.norm1();
        }
    }
    if !columns.iter().sum::<f64>().is_finite() {
        return None;
    }
    for x in &mut columns {
        *x = inverse_power(*x);
    }
    let mut weights = [0.0; N];
    for (weight, row) in weights.iter_mut().zip(a) {
        for (a, c) in row.iter().zip(&columns) {
            *weight += a.norm1() * c;
        }
        *weight = inverse_power(*weight);
    }
    Some(weights)
}

/// A power of two near 1/x, of a finite x >= 0.
#[inline]
fn inverse_power(x: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff << 52;
    f64::from_bits((0x7fe << 52) - (x.to_bits() & EXPONENT))
}

/// a -= factor b
#[inline]
fn subtract<T: Number, const M: usize>(a: &mut [T; M], factor: T, b: &[T; M]) {
    for (a, b) in a.iter_mut().zip(b) {
        *a -= factor * *b;
    }
}

/// Rows from columns.
#[inline]
fn transposed<T: Copy, const N: usize, const M: usize>(columns: &[[T; N]; M]) -> [[T; M]; N] {
    std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]))
}
