//! Checks of a grease.

use crate::scene::check::{number, range};
use crate::scene::validate::*;
use crate::scene::*;

impl Grease {
    pub(in crate::scene) fn validate(&self) -> Result<()> {
        match self {
            Grease::Soap(soap) => {
                let at = |field: &str| format!("lubricant.grease.soap.{field}");
                number(&at("yield_stress"), soap.yield_stress, range(0.0, 1e5, "Pa"))?;
                number(&at("yield_time"), soap.yield_time, range(1e-6, 1e3, "s"))?;
                number(&at("consistency"), soap.consistency, range(0.0, 1e5, "Pa s^n"))?;
                number(&at("exponent"), soap.exponent, range(0.0, 1.0, ""))?;
                number(&at("lowest_shear_rate"), soap.lowest_shear_rate, range(1.0, 1e5, "1/s"))?;
                number(&at("reference_temperature"), soap.reference_temperature, TEMPERATURE)?;
                number(&at("halving"), soap.halving, range(1.0, 1000.0, "K"))
            }
            Grease::Polymer(polymer) => {
                let at = |field: &str| format!("lubricant.grease.polymer.{field}");
                number(&at("plateau"), polymer.plateau, range(1e-3, 1.0, ""))?;
                number(&at("relaxation_time"), polymer.relaxation_time, range(1e-9, 1e3, "s"))?;
                number(&at("exponent"), polymer.exponent, range(0.0, 1.0, ""))
            }
        }
    }
}
