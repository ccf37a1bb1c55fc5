//! The lubricant as all laws see it at one instant.

pub mod grease;
pub mod walther;

use crate::scalar::math;

/// How much thicker the lubricant is than that which laws were built with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fluid {
    /// eta/eta_0.
    pub relative_viscosity: f64,
    /// Its logarithm, which power laws take.
    pub ln_viscosity: f64,
    /// s, strength of a soap against that which its law was built with.
    pub structure: f64,
}

impl Fluid {
    /// As thick as that.
    pub const SAME: Self = Self { relative_viscosity: 1.0, ln_viscosity: 0.0, structure: 1.0 };

    /// This much thicker.
    pub fn new(relative_viscosity: f64) -> Self {
        Self { relative_viscosity, ln_viscosity: math::ln(relative_viscosity), structure: 1.0 }
    }

    /// After the logarithm of its viscosity has changed by `step`, and that of its structure by `ratio` times as much.
    pub(crate) fn moved(&self, step: f64, ratio: f64) -> Self {
        let structure = self.structure * math::exp(step * ratio);
        Self { structure, ..Self::new(self.relative_viscosity * math::exp(step)) }
    }
}
