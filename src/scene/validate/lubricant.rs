//! Checks of the lubricant.

use crate::scene::check::range;
use crate::scene::validate::*;
use crate::scene::*;

impl Lubricant {
    pub(in crate::scene) fn validate(&self, judge: Judge<'_>) -> Result<()> {
        match &self.viscosity {
            Viscosity::Constant(value) => judge.number("lubricant.viscosity.constant", *value, VISCOSITY)?,
            Viscosity::Walther(walther) => walther.validate(judge)?,
        }
        for (name, value, allowed) in [
            ("pressure_viscosity", self.pressure_viscosity, range(1e-10, 1e-6, "1/Pa")),
            ("temperature_viscosity", self.temperature_viscosity, range(1e-4, 1.0, "1/K")),
            ("conductivity", self.conductivity, range(1e-3, 10.0, "W/(m K)")),
            ("eyring_stress", self.eyring_stress, range(1e4, 1e9, "Pa")),
            ("shear_modulus", self.shear_modulus, range(1e6, 1e12, "Pa")),
        ] {
            judge.optional(&format!("lubricant.{name}"), value, allowed)?;
        }
        self.grease.as_ref().map_or(Ok(()), |grease| grease.validate(judge))
    }
}

impl WaltherViscosity {
    pub(in crate::scene) fn validate(&self, judge: Judge<'_>) -> Result<()> {
        let at = |field: &str| format!("lubricant.viscosity.walther.{field}");
        for (name, point) in [("cold", &self.cold), ("hot", &self.hot)] {
            judge.number(&at(&format!("{name}.temperature")), point.temperature, TEMPERATURE)?;
            // Walther's equation has log10(nu + 0.7), which must be positive.
            let allowed = range(0.4e-6, 1.0, "m^2/s");
            judge.number(&at(&format!("{name}.kinematic_viscosity")), point.kinematic_viscosity, allowed)?;
        }
        let (cold, hot) = (&self.cold, &self.hot);
        if hot.temperature <= cold.temperature || hot.kinematic_viscosity >= cold.kinematic_viscosity {
            let text = format!(
                "({:?} K, {:?} m^2/s) must be hotter and thinner than the cold point ({:?} K, {:?} m^2/s)",
                hot.temperature, hot.kinematic_viscosity, cold.temperature, cold.kinematic_viscosity
            );
            judge.refuse(&at("hot"), text)?;
        }
        judge.number(&at("density"), self.density, range(100.0, 2e4, "kg/m^3"))?;
        match &self.temperature {
            None => Ok(()),
            Some(Temperature::OverTime(time)) => {
                signal(judge, &at("temperature.over_time"), time, TEMPERATURE)
            }
            Some(Temperature::OverSpeed { speed, temperature }) => {
                let path = at("temperature.over_speed");
                table(
                    judge,
                    &path,
                    ("speed", speed, range(0.0, 1e5, "rad/s")),
                    ("temperature", temperature, TEMPERATURE),
                )
            }
        }
    }
}

impl Grease {
    pub(in crate::scene) fn validate(&self, judge: Judge<'_>) -> Result<()> {
        match self {
            Grease::Soap(soap) => {
                let at = |field: &str| format!("lubricant.grease.soap.{field}");
                judge.number(&at("yield_stress"), soap.yield_stress, range(0.0, 1e5, "Pa"))?;
                judge.number(&at("yield_time"), soap.yield_time, range(1e-6, 1e3, "s"))?;
                judge.number(&at("consistency"), soap.consistency, range(0.0, 1e5, "Pa s^n"))?;
                judge.number(&at("exponent"), soap.exponent, range(0.0, 1.0, ""))?;
                judge.number(&at("lowest_shear_rate"), soap.lowest_shear_rate, range(1.0, 1e5, "1/s"))?;
                judge.number(&at("reference_temperature"), soap.reference_temperature, TEMPERATURE)?;
                judge.number(&at("halving"), soap.halving, range(1.0, 1000.0, "K"))
            }
            Grease::Polymer(polymer) => {
                let at = |field: &str| format!("lubricant.grease.polymer.{field}");
                judge.number(&at("plateau"), polymer.plateau, range(1e-3, 1.0, ""))?;
                judge.number(&at("relaxation_time"), polymer.relaxation_time, range(1e-9, 1e3, "s"))?;
                judge.number(&at("exponent"), polymer.exponent, range(0.0, 1.0, ""))
            }
        }
    }
}
