//! placeholder
use super::journal::*;
use crate::scalar::Real;
/// x
#[derive(Clone, Debug, PartialEq)]
pub struct LubricantLayer {
    /// x
    pub viscosity: f64,
    /// x
    pub pressure_viscosity: f64,
    /// x
    pub cap: f64,
    /// x
    pub radius: f64,
    /// x
    pub clearance: f64,
    /// x
    pub width: f64,
    /// x
    pub thickness: f64,
    /// x
    pub edge_shear: bool,
    /// x
    pub roundness: Vec<Harmonic>,
}
impl LubricantLayer {
    /// x
    pub fn force<T: Real>(&self, _m: &JournalMotion<T>) -> Result<FilmForce<T>, NoFilm> {
        Ok(FilmForce::none(T::constant(1.0)))
    }
}
