//! What thickens the oil of a grease, where it is sheared.

use serde::{Deserialize, Serialize};

/// Thickener of the lubricant, which lubricant layers of guides see. The viscosity of the lubricant is that of its base oil.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Grease {
    /// A soap with a yield stress: eta = eta_b + s [tau_y (1 - exp(-t_p g)) + K g^n]/g at the shear rate g.
    Soap(SoapGrease),
    /// A polymer that thins: eta = eta_b (r + (1 - r) [1 + (lambda g)^2]^((n - 1)/2)).
    Polymer(PolymerGrease),
}

/// Soap (Palacios form).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SoapGrease {
    /// Yield stress tau_y at the reference temperature, Pa.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1e5)))]
    pub yield_stress: f64,
    /// Time t_p over which the yield stress builds up with the shear rate, s.
    #[serde(default = "yield_time")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-6, max = 1e3)))]
    pub yield_time: f64,
    /// Consistency K at the reference temperature, Pa s^n.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1e5)))]
    pub consistency: f64,
    /// Exponent n.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub exponent: f64,
    /// Shear rate below which the viscosity no longer grows, 1/s.
    #[serde(default = "lowest_shear_rate")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1.0, max = 1e5)))]
    pub lowest_shear_rate: f64,
    /// Reference temperature, K.
    #[serde(default = "reference_temperature")]
    #[cfg_attr(feature = "schema", schemars(range(min = 150.0, max = 1000.0)))]
    pub reference_temperature: f64,
    /// By how much warmer the soap is half as strong, K. A lubricant of constant viscosity stays at the reference.
    #[serde(default = "halving")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1.0, max = 1000.0)))]
    pub halving: f64,
}

/// Polymer (Carreau form).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PolymerGrease {
    /// Viscosity at high shear rates over that at low ones, r.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-3, max = 1.0)))]
    pub plateau: f64,
    /// Relaxation time lambda, s.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-9, max = 1e3)))]
    pub relaxation_time: f64,
    /// Exponent n.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub exponent: f64,
}

fn yield_time() -> f64 {
    1.0
}

fn lowest_shear_rate() -> f64 {
    100.0
}

fn reference_temperature() -> f64 {
    298.0
}

fn halving() -> f64 {
    30.0
}
