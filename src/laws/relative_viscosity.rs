//! Viscosity of the lubricant relative to the one that a law was made with: how a law follows the temperature.

use crate::scalar::Real;

/// eta0 over the eta0 of the law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RelativeViscosity<T> {
    /// The ratio, > 0.
    pub ratio: T,
    /// Its logarithm.
    pub ln_ratio: T,
}

impl<T: Real> RelativeViscosity<T> {
    /// The viscosity of the law.
    pub fn one() -> Self {
        Self { ratio: T::constant(1.0), ln_ratio: T::constant(0.0) }
    }

    /// From the logarithm of the ratio.
    pub fn from_ln(ln_ratio: T) -> Self {
        Self { ratio: ln_ratio.exp(), ln_ratio }
    }
}
