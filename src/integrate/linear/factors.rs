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
//! A singular spoke in a matrix that is not singular stops this elimination; such a matrix is solved as a dense one, and so is
//! one whose spokes touch each other.

use super::dense::DenseFactors;
use super::lu::{Scales, decompose, substitute, subtract, with_width};
use super::matrix::{Arrowhead, Number};
use nalgebra::{Dim, SVector};

/// The factors of an [`Arrowhead`]. Memory is taken once, but for the dense fallback.
#[derive(Clone, Debug)]
pub struct Factors<T: Number, const N: usize> {
    /// Unknowns of the hub.
    width: usize,
    /// Rows of the triangular factors of the hub's Schur complement, and where each came from.
    hub: Vec<T>,
    hub_order: Vec<usize>,
    spokes: Vec<SpokeFactors<T, N>>,
    /// Columns of U_j of all spokes, one after another.
    to_hub: Vec<T>,
    /// Rows of T_j.
    response: Vec<T>,
    /// Memory: columns of the Schur complement, and what pivots are chosen by.
    schur: Vec<T>,
    scales: [Vec<f64>; 3],
    solution: Vec<T>,
    /// Factors of the last matrix, if the others are of no use.
    dense: Option<DenseFactors<T>>,
}

/// Rows of the triangular factors of A_j, and where each came from.
#[derive(Clone, Copy, Debug)]
struct SpokeFactors<T, const N: usize> {
    rows: [[T; N]; N],
    order: [usize; N],
}

impl<T: Number, const N: usize> Factors<T, N> {
    /// The factors of the identity with so many unknowns in the hub and this number of spokes.
    pub fn new(width: usize, spokes: usize) -> Self {
        let rows =
            std::array::from_fn(|i| std::array::from_fn(|j| if i == j { T::one() } else { T::zero() }));
        let spoke = SpokeFactors { rows, order: std::array::from_fn(|i| i) };
        let mut hub = vec![T::zero(); width * width];
        hub.iter_mut().step_by(width + 1).for_each(|x| *x = T::one());
        let coupling = vec![T::zero(); spokes * block(N, width)];
        Self {
            width,
            hub,
            hub_order: (0..width).collect(),
            spokes: vec![spoke; spokes],
            to_hub: coupling.clone(),
            response: coupling,
            schur: vec![T::zero(); width * width],
            scales: [vec![0.0; width * width], vec![0.0; width], vec![0.0; width]],
            solution: vec![T::zero(); width],
            dense: None,
        }
    }

    /// Factorises a matrix. False when it is singular within rounding or not finite; the factors are then of no use.
    ///
    /// # Panics
    /// If sizes differ.
    #[must_use]
    pub fn factorize(&mut self, a: &Arrowhead<T, N>) -> bool {
        assert!(a.spokes() == self.spokes.len() && a.width() == self.width);
        self.dense = None;
        if !a.has_rim() && with_width!(N, self.width, width => self.eliminate(a, width)) {
            return true;
        }
        self.dense = DenseFactors::new(a);
        self.dense.is_some()
    }

    /// Factorises by blocks; false when a block has no inverse.
    fn eliminate<W: Dim>(&mut self, a: &Arrowhead<T, N>, width: W) -> bool {
        let width = width.value();
        let schur = &mut self.schur[..width * width];
        schur.copy_from_slice(a.hub.as_slice());
        let couplings = self.to_hub.chunks_exact_mut(block(N, width));
        let couplings = couplings.zip(self.response.chunks_exact_mut(block(N, width)));
        for (j, (factors, (to_hub, response))) in self.spokes.iter_mut().zip(couplings).enumerate() {
            let [to_hub, response] = [to_hub, response].map(|columns| &mut columns[..N * width]);
            factors.rows = transposed(a.own_of(j));
            let mut size = factors.rows.map(|row| row.map(T::norm1));
            let [mut columns, mut weights] = [[0.0; N]; 2];
            let scales =
                Scales { size: size.as_flattened_mut(), columns: &mut columns, weights: &mut weights };
            factors.order = std::array::from_fn(|i| i);
            if !decompose(N, factors.rows.as_flattened_mut(), &mut factors.order, scales) {
                return false;
            }
            to_hub.copy_from_slice(a.to_hub_of(j));
            for (k, i) in factors.order.into_iter().enumerate() {
                for (c, column) in a.from_hub_of(j).iter().enumerate() {
                    response[k * width + c] = column[i];
                }
            }
            substitute(N, width, factors.rows.as_flattened(), response);
            for (c, column) in schur.chunks_exact_mut(width.max(1)).enumerate() {
                for k in 0..N {
                    subtract(column, response[k * width + c], &to_hub[k * width..(k + 1) * width]);
                }
            }
        }
        for i in 0..width {
            for j in 0..width {
                let x = schur[j * width + i];
                self.hub[i * width + j] = x;
                self.scales[0][i * width + j] = a.hub[(i, j)].norm1().max(x.norm1());
            }
        }
        self.hub_order.iter_mut().enumerate().for_each(|(i, order)| *order = i);
        let [size, columns, weights] = &mut self.scales;
        decompose(width, &mut self.hub, &mut self.hub_order, Scales { size, columns, weights })
    }

    /// Replaces the right-hand side (`hub`, `spokes`) by the solution.
    ///
    /// # Panics
    /// If sizes differ.
    pub fn solve(&mut self, hub: &mut [T], spokes: &mut [SVector<T, N>]) {
        assert!(spokes.len() == self.spokes.len() && hub.len() == self.width);
        if let Some(dense) = &self.dense {
            return dense.solve(hub, spokes);
        }
        with_width!(N, self.width, width => self.substitute(hub, spokes, width));
    }

    fn substitute<W: Dim>(&mut self, hub: &mut [T], spokes: &mut [SVector<T, N>], width: W) {
        let width = width.value();
        let hub = &mut hub[..width];
        let couplings = self.to_hub.chunks_exact(block(N, width));
        for ((factors, x), to_hub) in self.spokes.iter().zip(spokes.iter_mut()).zip(couplings) {
            let mut y = [T::zero(); N];
            for (y, i) in y.iter_mut().zip(&factors.order) {
                *y = x[*i];
            }
            substitute(N, 1, factors.rows.as_flattened(), &mut y);
            for (k, y) in y.iter().enumerate() {
                subtract(hub, *y, &to_hub[k * width..(k + 1) * width]);
            }
            *x = SVector::from(y);
        }
        let solution = &mut self.solution[..width];
        for (x, i) in solution.iter_mut().zip(&self.hub_order) {
            *x = hub[*i];
        }
        substitute(width, 1, &self.hub[..width * width], solution);
        hub.copy_from_slice(solution);
        for (x, response) in spokes.iter_mut().zip(self.response.chunks_exact(block(N, width))) {
            for (k, x) in x.iter_mut().enumerate() {
                let row = response[k * width..(k + 1) * width].iter().zip(solution.iter());
                *x -= row.fold(T::zero(), |sum, (t, s)| sum + *t * *s);
            }
        }
    }
}

/// Room for the coupling of a spoke with the hub; at least one, as there are no chunks of none.
#[inline]
fn block(n: usize, width: usize) -> usize {
    (n * width).max(1)
}

/// Rows from columns.
#[inline]
fn transposed<T: Copy, const N: usize>(columns: &[[T; N]]) -> [[T; N]; N] {
    std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]))
}
