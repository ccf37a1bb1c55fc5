//! A matrix of one shared group of unknowns, the hub, and small groups, the spokes, that touch the hub and, where there is a
//! rim, the spokes before and behind them.

use crate::integrate::Structure;
use nalgebra::{ComplexField, Const, DMatrix, Dyn, OMatrix, SVector};

/// Real and complex numbers.
pub trait Number: ComplexField<RealField = f64> + Copy {}

impl<T: ComplexField<RealField = f64> + Copy> Number for T {}

/// The matrix: a hub of any size, spokes of `N` unknowns each, whose blocks stand side by side.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrowhead<T: Number, const N: usize> {
    /// S: rows and columns of the hub.
    pub hub: DMatrix<T>,
    /// A_j of all spokes: rows and columns of the spoke. That of spoke j begins at column j N.
    pub own: OMatrix<T, Const<N>, Dyn>,
    /// U_j: rows of the hub, columns of the spoke. That of spoke j begins at column j N.
    pub to_hub: DMatrix<T>,
    /// V_j: rows of the spoke, columns of the hub. That of spoke j begins at column j times the size of the hub.
    pub from_hub: OMatrix<T, Const<N>, Dyn>,
    /// Rows of the spoke, columns of the next one and then of the one before: those of spoke j begin at column 2 j N. Nothing
    /// without a rim.
    pub rim: OMatrix<T, Const<N>, Dyn>,
}

impl<T: Number, const N: usize> Arrowhead<T, N> {
    /// The identity with so many unknowns in the hub and this number of spokes.
    pub fn new(hub: usize, spokes: usize) -> Self {
        let mut identity = Self {
            hub: DMatrix::zeros(hub, hub),
            own: OMatrix::zeros_generic(Const, Dyn(N * spokes)),
            to_hub: DMatrix::zeros(hub, N * spokes),
            from_hub: OMatrix::zeros_generic(Const, Dyn(hub * spokes)),
            rim: OMatrix::zeros_generic(Const, Dyn(0)),
        };
        identity.fill_identity();
        identity
    }

    /// The identity of a structure.
    pub fn of(structure: &Structure<N>) -> Self {
        let spokes = structure.spokes.len();
        let rim = if structure.rim { 2 * N * spokes } else { 0 };
        let rim = OMatrix::zeros_generic(Const, Dyn(rim));
        Self { rim, ..Self::new(structure.hub.len(), spokes) }
    }

    /// Number of unknowns of the hub.
    #[inline]
    pub fn width(&self) -> usize {
        self.hub.nrows()
    }

    /// Number of spokes.
    #[inline]
    pub fn spokes(&self) -> usize {
        self.own.ncols() / N
    }

    /// All blocks, each by its columns: hub, own, to the hub, from the hub, rim.
    #[inline]
    pub fn blocks(&self) -> [&[T]; 5] {
        let Self { hub, own, to_hub, from_hub, rim } = self;
        [hub.as_slice(), own.as_slice(), to_hub.as_slice(), from_hub.as_slice(), rim.as_slice()]
    }

    /// The same, to be written.
    #[inline]
    pub fn blocks_mut(&mut self) -> [&mut [T]; 5] {
        let Self { hub, own, to_hub, from_hub, rim } = self;
        [
            hub.as_mut_slice(),
            own.as_mut_slice(),
            to_hub.as_mut_slice(),
            from_hub.as_mut_slice(),
            rim.as_mut_slice(),
        ]
    }

    /// Makes the matrix the identity.
    pub fn fill_identity(&mut self) {
        self.fill_zero();
        self.add_diagonal(T::one());
    }

    /// Makes the matrix zero.
    pub fn fill_zero(&mut self) {
        self.blocks_mut().into_iter().for_each(|block| block.fill(T::zero()));
    }

    /// Adds a number to the diagonal.
    pub fn add_diagonal(&mut self, x: T) {
        let width = self.width();
        self.hub.as_mut_slice().iter_mut().step_by(width + 1).for_each(|entry| *entry += x);
        for (k, column) in self.own.as_mut_slice().as_chunks_mut::<N>().0.iter_mut().enumerate() {
            column[k % N] += x;
        }
    }

    /// Columns of A_j.
    #[inline]
    pub fn own_of(&self, j: usize) -> &[[T; N]] {
        &self.own.as_slice().as_chunks().0[j * N..(j + 1) * N]
    }

    /// Columns of U_j, one after another.
    #[inline]
    pub fn to_hub_of(&self, j: usize) -> &[T] {
        let block = N * self.width();
        &self.to_hub.as_slice()[j * block..(j + 1) * block]
    }

    /// Columns of V_j.
    #[inline]
    pub fn from_hub_of(&self, j: usize) -> &[[T; N]] {
        let width = self.width();
        &self.from_hub.as_slice().as_chunks().0[j * width..(j + 1) * width]
    }

    /// Whether a spoke touches another one.
    pub fn has_rim(&self) -> bool {
        self.rim.iter().any(|x| !x.is_zero())
    }

    /// The spokes that spoke j touches, the next and the one before, with the columns of their blocks; none without a rim.
    #[inline]
    pub fn rim_of(&self, j: usize) -> impl Iterator<Item = (usize, &[[T; N]])> {
        let n = self.spokes();
        let columns = self.rim.as_slice().as_chunks().0.chunks_exact(N).skip(2 * j);
        [(j + 1) % n.max(1), (j + n.max(1) - 1) % n.max(1)].into_iter().zip(columns)
    }

    /// Product of the matrix with (`hub`, `spokes`).
    ///
    /// # Panics
    /// If sizes differ.
    pub fn multiply(
        &self,
        hub: &[T],
        spokes: &[SVector<T, N>],
        hub_out: &mut [T],
        spokes_out: &mut [SVector<T, N>],
    ) {
        let width = self.width();
        assert!(spokes.len() == self.spokes() && spokes_out.len() == self.spokes());
        assert!(hub.len() == width && hub_out.len() == width);
        hub_out.fill(T::zero());
        add_product(self.hub.as_slice(), hub, hub_out);
        for (j, (x, out)) in spokes.iter().zip(&mut *spokes_out).enumerate() {
            for (i, sum) in hub_out.iter_mut().enumerate() {
                let row = self.to_hub_of(j)[i..].iter().step_by(width).zip(x);
                *sum += row.fold(T::zero(), |sum, (a, x)| sum + *a * *x);
            }
            let [mut own, mut across] = [[T::zero(); N]; 2];
            add_product(self.own_of(j).as_flattened(), x.as_slice(), &mut own);
            add_product(self.from_hub_of(j).as_flattened(), hub, &mut across);
            for (k, columns) in self.rim_of(j) {
                add_product(columns.as_flattened(), spokes[k].as_slice(), &mut across);
            }
            *out = SVector::from_fn(|i, _| own[i] + across[i]);
        }
    }
}

/// Adds the product of a matrix, given by its columns, with `x`.
#[inline(always)]
fn add_product<T: Number>(columns: &[T], x: &[T], sum: &mut [T]) {
    let rows = sum.len();
    for (j, x) in x.iter().enumerate() {
        for (sum, a) in sum.iter_mut().zip(&columns[j * rows..(j + 1) * rows]) {
            *sum += *a * *x;
        }
    }
}
