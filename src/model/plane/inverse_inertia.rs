//! From forces over the coordinates of shared bodies to their accelerations.

use crate::bodies::SharedBody;
use std::ops::Range;

/// Accelerations of the coordinates of all shared bodies by unit forces over them, by columns.
#[derive(Clone, Debug)]
pub(super) struct InverseInertia {
    columns: Vec<f64>,
    /// Those of forces over their own coordinates.
    diagonal: Vec<f64>,
    product: Vec<f64>,
    /// Whether there are no others.
    balanced: bool,
}

impl InverseInertia {
    /// Memory for so many coordinates of shared bodies.
    pub(super) fn new(width: usize) -> Self {
        let zero = vec![0.0; width];
        Self { columns: vec![0.0; width * width], diagonal: zero.clone(), product: zero, balanced: true }
    }

    pub(super) fn clear(&mut self) {
        self.columns.fill(0.0);
        self.balanced = true;
    }

    /// Adds that of a body whose coordinates stand at these places and are `q`.
    pub(super) fn add(&mut self, body: &dyn SharedBody, at: Range<usize>, q: &[f64]) {
        let width = self.diagonal.len();
        self.balanced &= body.is_balanced();
        for k in at.clone() {
            let column = &mut self.columns[k * width..(k + 1) * width];
            column[k] = 1.0;
            body.respond(&mut column[at.clone()], q);
            self.diagonal[k] = column[k];
        }
    }

    /// Makes the forces that begin columns of `length` numbers accelerations.
    pub(super) fn multiply(&mut self, columns: &mut [f64], length: usize) {
        let Self { columns: inverse, diagonal, product, balanced } = self;
        let width = diagonal.len();
        for forces in columns.chunks_exact_mut(length.max(1)) {
            let forces = &mut forces[..width];
            if *balanced {
                forces.iter_mut().zip(diagonal.iter()).for_each(|(x, factor)| *x *= factor);
                continue;
            }
            product.fill(0.0);
            for (force, column) in forces.iter().zip(inverse.chunks_exact(width.max(1))) {
                product.iter_mut().zip(column).for_each(|(sum, x)| *sum += x * force);
            }
            forces.copy_from_slice(product);
        }
    }
}
