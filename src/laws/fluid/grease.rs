//! Viscosity of a grease that depends on the rate of shear, as a factor of that of its base oil.
//!
//! ```text
//! soap      eta/eta_b = 1 + s [tau_y (1 - e^{-t_p g}) + K g^n]/(g eta_b),    s = 2^{-(T - T_r)/T_h}
//! polymer   eta/eta_b = r + (1 - r) [1 + (lambda g)^2]^{(n - 1)/2}
//! g = sqrt((u/h)^2 + g_0^2)      for the soap,      g = u/h      for the polymer
//! ```
//!
//! u is the sliding speed of both surfaces and h the film between them: the shear of sliding, which is the same over the width.
//! The soap holds a yield stress tau_y and thickens by a power law of exponent n < 1, both softer by half every T_h; g_0 bounds
//! the viscosity where nothing slides. Valid for shear rates from g_0 to some 1e6 1/s.
//! Sources: Palacios and Palacios 1984 (Herschel-Bulkley with the base oil), Papanastasiou 1987 (yield by an exponential), Carreau 1972
//! with the second plateau; that of the soap over the temperature is an assumption.

use super::Fluid;
use crate::scalar::{Numeric, math};

/// What thickens an oil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Thickener {
    /// Soap.
    Soap(Soap),
    /// Polymer.
    Polymer(Polymer),
}

/// Structure of a soap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Soap {
    /// tau_y, Pa.
    pub yield_stress: f64,
    /// t_p, s.
    pub yield_time: f64,
    /// K, Pa s^n.
    pub consistency: f64,
    /// n, from 0 to 1.
    pub exponent: f64,
    /// g_0 > 0, 1/s.
    pub lowest_shear_rate: f64,
    /// T_r, K: where s = 1.
    pub reference_temperature: f64,
    /// T_h, K: by how much warmer the soap is half as strong.
    pub halving: f64,
    /// eta_b that laws are built with, Pa s.
    pub base_viscosity: f64,
}

/// Thinning of a polymer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polymer {
    /// r, viscosity at high rates over that at low ones, from 0 to 1.
    pub plateau: f64,
    /// lambda, s.
    pub relaxation_time: f64,
    /// n, from 0 to 1.
    pub exponent: f64,
}

impl Soap {
    /// s at a temperature in K.
    pub fn structure(&self, temperature: f64) -> f64 {
        math::exp(self.ln_structure_slope() * (temperature - self.reference_temperature))
    }

    /// Derivative of ln s over the temperature, 1/K.
    pub fn ln_structure_slope(&self) -> f64 {
        -std::f64::consts::LN_2 / self.halving
    }
}

/// Factor of the viscosity of one fluid: a constant, a power of the shear rate g = u/h, and a yield stress,
/// `constant + power (square + (time g)^2)^exponent + stress (1 - e^{-t_p G})/G`, `G = sqrt(square + g^2)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Thickening {
    constant: f64,
    power: f64,
    square: f64,
    time: f64,
    exponent: f64,
    /// Over the viscosity of the base oil, 1/s; zero for a polymer.
    stress: f64,
    yield_time: f64,
}

impl Thickening {
    /// eta/eta_b where the surfaces slide at the rate `shear` = u/h, 1/s.
    #[inline(always)]
    pub(crate) fn factor<T: Numeric>(&self, shear: T) -> T {
        let of = shear * self.time;
        let flows = ((of * of + self.square).ln() * self.exponent).exp() * self.power;
        if self.stress == 0.0 {
            return flows + self.constant;
        }
        let g = (shear * shear + self.square).sqrt();
        let yields = (-(g * -self.yield_time).exp() + 1.0) / g * self.stress;
        flows + yields + self.constant
    }

    /// The largest factor.
    pub(crate) fn largest(&self) -> f64 {
        self.factor(0.0)
    }
}

impl Thickener {
    /// What it does to this fluid.
    pub(crate) fn of(&self, fluid: &Fluid) -> Thickening {
        match self {
            Self::Soap(soap) => {
                let scale = fluid.structure / (soap.base_viscosity * fluid.relative_viscosity);
                Thickening {
                    constant: 1.0,
                    power: soap.consistency * scale,
                    square: soap.lowest_shear_rate * soap.lowest_shear_rate,
                    time: 1.0,
                    exponent: 0.5 * (soap.exponent - 1.0),
                    stress: soap.yield_stress * scale,
                    yield_time: soap.yield_time,
                }
            }
            Self::Polymer(polymer) => Thickening {
                constant: polymer.plateau,
                power: 1.0 - polymer.plateau,
                square: 1.0,
                time: polymer.relaxation_time,
                exponent: 0.5 * (polymer.exponent - 1.0),
                stress: 0.0,
                yield_time: 0.0,
            },
        }
    }

    /// s at a temperature in K; 1 where there is no soap.
    pub(crate) fn structure(&self, temperature: f64) -> f64 {
        match self {
            Self::Soap(soap) => soap.structure(temperature),
            Self::Polymer(_) => 1.0,
        }
    }

    /// Derivative of ln s over the temperature, 1/K.
    pub(crate) fn ln_structure_slope(&self) -> f64 {
        match self {
            Self::Soap(soap) => soap.ln_structure_slope(),
            Self::Polymer(_) => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Dual;

    const SOAP: Soap = Soap {
        yield_stress: 300.0,
        yield_time: 1.0,
        consistency: 20.0,
        exponent: 0.4,
        lowest_shear_rate: 100.0,
        reference_temperature: 298.0,
        halving: 30.0,
        base_viscosity: 0.1,
    };
    const POLYMER: Polymer = Polymer { plateau: 0.3, relaxation_time: 1e-5, exponent: 0.6 };

    fn laws() -> [Thickener; 2] {
        [Thickener::Soap(SOAP), Thickener::Polymer(POLYMER)]
    }

    #[test]
    fn stress_of_a_soap_is_yield_power_law_and_base_oil() {
        for g in [5e3, 5e4, 3e5] {
            let stress = laws()[0].of(&Fluid::SAME).factor(g) * SOAP.base_viscosity * g;
            let expected = 300.0 + 20.0 * f64::powf(g, 0.4) + 0.1 * g;
            assert!((stress / expected - 1.0).abs() < 1e-3, "{g}: {stress} {expected}");
        }
        // Half as strong 30 K above, and as much thinner against an oil that is twice as thick.
        assert!((SOAP.structure(328.0) - 0.5).abs() < 1e-15 && SOAP.structure(298.0) == 1.0);
        let excess = |fluid: &Fluid| laws()[0].of(fluid).factor(1e4) - 1.0;
        let thick = Fluid::new(2.0);
        assert!((excess(&thick) / excess(&Fluid::SAME) - 0.5).abs() < 1e-14);
        let warm = Fluid { structure: 0.5, ..Fluid::SAME };
        assert!((excess(&warm) / excess(&Fluid::SAME) - 0.5).abs() < 1e-14);
    }

    #[test]
    fn viscosity_falls_with_shear_and_is_bounded_at_rest() {
        for law in laws() {
            let mut before = law.of(&Fluid::SAME).largest();
            assert!(before.is_finite());
            for k in 0..60 {
                let g = 10f64.powf(0.1 * f64::from(k));
                let (here, back) = (law.of(&Fluid::SAME).factor(g), law.of(&Fluid::SAME).factor(-g));
                assert_eq!(here, back);
                assert!(here <= before, "{law:?} {g}");
                before = here;
            }
        }
        assert!((laws()[1].of(&Fluid::SAME).factor(0.0) - 1.0).abs() < 1e-15);
        assert!((laws()[1].of(&Fluid::SAME).factor(1e12) - 0.3).abs() < 2e-3);
    }

    #[test]
    fn derivatives_match_central_differences() {
        for law in laws() {
            for g in [-3e5, -40.0, 1e-3, 90.0, 2e4] {
                let h = 1e-5 * g.abs().max(1.0);
                let exact = law.of(&Fluid::SAME).factor(Dual::<1>::variable(g, 0)).eps[0];
                let difference =
                    (law.of(&Fluid::SAME).factor(g + h) - law.of(&Fluid::SAME).factor(g - h)) / (2.0 * h);
                let allowed = 1e-6 * exact.abs() + 1e-9;
                assert!((exact - difference).abs() < allowed, "{law:?} {g}: {exact} {difference}");
            }
        }
    }
}
