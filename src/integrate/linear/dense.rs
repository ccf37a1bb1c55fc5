//! Dense elimination with row exchanges over the whole matrix, for the arrowheads that elimination by blocks does not do: a
//! singular spoke in a regular matrix, spokes that touch each other. It takes its memory when it is needed.

use crate::integrate::linear::{Arrowhead, Number};
use nalgebra::{DMatrix, DVector, Dyn, LU, SVector};

/// The factors of an [`Arrowhead`] as a dense matrix, rows and columns scaled to about one.
#[derive(Clone, Debug)]
pub(in crate::integrate) struct DenseFactors<T: Number> {
    lu: LU<T, Dyn, Dyn>,
    rows: Vec<f64>,
    columns: Vec<f64>,
}

impl<T: Number> DenseFactors<T> {
    /// Factorises a matrix; `None` when it is singular within rounding or not finite.
    pub(in crate::integrate) fn new<const N: usize>(a: &Arrowhead<T, N>) -> Option<Self> {
        let hub = a.width();
        let n = hub + N * a.spokes();
        let mut matrix = DMatrix::<T>::zeros(n, n);
        matrix.view_mut((0, 0), (hub, hub)).copy_from(&a.hub);
        matrix.columns_mut(hub, n - hub).rows_mut(0, hub).copy_from(&a.to_hub);
        for j in 0..a.spokes() {
            let first = hub + N * j;
            matrix.view_mut((first, first), (N, N)).copy_from(&a.own.columns(N * j, N));
            matrix.view_mut((first, 0), (N, hub)).copy_from(&a.from_hub.columns(hub * j, hub));
            for (k, columns) in a.rim_of(j) {
                for (c, column) in columns.iter().enumerate() {
                    for (i, x) in column.iter().enumerate() {
                        matrix[(first + i, hub + N * k + c)] += *x;
                    }
                }
            }
        }
        let size = |i: usize, j: usize| matrix[(i, j)].norm1();
        let columns: Vec<f64> = (0..n).map(|j| 1.0 / (0..n).map(|i| size(i, j)).sum::<f64>()).collect();
        let weighted = |i: usize| (0..n).map(|j| size(i, j) * columns[j]).sum::<f64>();
        let rows: Vec<f64> = (0..n).map(|i| 1.0 / weighted(i)).collect();
        // A row or column of zeros, or something that is not finite.
        if !rows.iter().chain(&columns).all(|x| x.is_normal()) {
            return None;
        }
        for j in 0..n {
            for i in 0..n {
                matrix[(i, j)] = matrix[(i, j)].scale(rows[i] * columns[j]);
            }
        }
        let lu = matrix.lu();
        let rounding = f64::EPSILON * n as f64;
        let regular = lu.u().diagonal().iter().all(|pivot| pivot.norm1() > rounding);
        regular.then_some(Self { lu, rows, columns })
    }

    /// Replaces the right-hand side (`hub`, `spokes`) by the solution.
    pub(in crate::integrate) fn solve<const N: usize>(&self, hub: &mut [T], spokes: &mut [SVector<T, N>]) {
        let values = hub.iter().chain(spokes.iter().flatten()).zip(&self.rows);
        let mut right = DVector::<T>::zeros(self.rows.len());
        for (i, (x, scale)) in values.enumerate() {
            right[i] = x.scale(*scale);
        }
        // The pivots are known not to be zero.
        let solved = self.lu.solve_mut(&mut right);
        debug_assert!(solved);
        let places = hub.iter_mut().chain(spokes.iter_mut().flatten()).zip(&self.columns);
        for (i, (x, scale)) in places.enumerate() {
            *x = right[i].scale(*scale);
        }
    }
}
