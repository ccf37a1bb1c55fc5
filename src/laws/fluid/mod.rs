//! The lubricant as all laws see it at one instant.

pub mod walther;

use crate::scalar::math;

/// How much thicker the lubricant is than that which laws were built with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fluid {
    /// eta/eta_0.
    pub relative_viscosity: f64,
    /// Its logarithm, which power laws take.
    pub ln_viscosity: f64,
}

impl Fluid {
    /// As thick as that.
    pub const SAME: Self = Self { relative_viscosity: 1.0, ln_viscosity: 0.0 };

    /// This much thicker.
    pub fn new(relative_viscosity: f64) -> Self {
        Self { relative_viscosity, ln_viscosity: math::ln(relative_viscosity) }
    }
}
