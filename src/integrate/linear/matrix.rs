//! A matrix of one shared group of unknowns, the hub, and small groups, the spokes, that touch only the hub.

use nalgebra::{ComplexField, SMatrix, SVector};

/// Unknowns of the hub.
pub const HUB: usize = 5;
/// Unknowns of a spoke.
pub const SPOKE: usize = 3;

/// Real and complex numbers.
pub trait Number: ComplexField<RealField = f64> + Copy {}

impl<T: ComplexField<RealField = f64> + Copy> Number for T {}

/// The part of the matrix that belongs to one spoke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spoke<T: Number = f64> {
    /// A_j: rows and columns of the spoke.
    pub own: SMatrix<T, SPOKE, SPOKE>,
    /// U_j: rows of the hub, columns of the spoke.
    pub to_hub: SMatrix<T, HUB, SPOKE>,
    /// V_j: rows of the spoke, columns of the hub.
    pub from_hub: SMatrix<T, SPOKE, HUB>,
}

impl<T: Number> Spoke<T> {
    /// A spoke with the identity and without coupling.
    pub fn identity() -> Self {
        Self { own: SMatrix::identity(), to_hub: SMatrix::zeros(), from_hub: SMatrix::zeros() }
    }
}

/// The matrix. Unused places carry the identity.
#[derive(Clone, Debug, PartialEq)]
pub struct Arrowhead<T: Number = f64> {
    /// S: rows and columns of the hub.
    pub hub: SMatrix<T, HUB, HUB>,
    /// The spokes.
    pub spokes: Vec<Spoke<T>>,
}

impl<T: Number> Arrowhead<T> {
    /// The identity with this number of spokes.
    pub fn new(spokes: usize) -> Self {
        Self { hub: SMatrix::identity(), spokes: vec![Spoke::identity(); spokes] }
    }

    /// Makes the matrix the identity.
    pub fn fill_identity(&mut self) {
        self.hub = SMatrix::identity();
        self.spokes.fill(Spoke::identity());
    }

    /// Makes the matrix zero.
    pub fn fill_zero(&mut self) {
        self.hub = SMatrix::zeros();
        let zero = Spoke { own: SMatrix::zeros(), to_hub: SMatrix::zeros(), from_hub: SMatrix::zeros() };
        self.spokes.fill(zero);
    }

    /// Product of the matrix with (`hub`, `spokes`).
    ///
    /// # Panics
    /// If the numbers of spokes differ.
    pub fn multiply(
        &self,
        hub: &SVector<T, HUB>,
        spokes: &[SVector<T, SPOKE>],
        hub_out: &mut SVector<T, HUB>,
        spokes_out: &mut [SVector<T, SPOKE>],
    ) {
        assert!(spokes.len() == self.spokes.len() && spokes_out.len() == self.spokes.len());
        *hub_out = self.hub * hub;
        for ((spoke, x), out) in self.spokes.iter().zip(spokes).zip(spokes_out) {
            *hub_out += spoke.to_hub * x;
            *out = spoke.own * x + spoke.from_hub * hub;
        }
    }
}
