//! Viscosity of a mineral oil at ambient pressure from temperature (Walther's equation, ASTM D341).
//!
//! ```text
//! log10 log10(nu + 0.7) = A - B log10 T         nu in mm^2/s, T in K
//! eta0 = nu rho
//! ```
//!
//! Valid for nu above about 2 mm^2/s, between and somewhat beyond the two points that fix A and B.

use crate::scalar::math;
use std::f64::consts::LN_10;

/// mm^2/s per m^2/s.
const MM2_PER_S: f64 = 1e6;
/// The shift of the logarithm, mm^2/s.
const SHIFT: f64 = 0.7;

/// Walther's line of one oil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walther {
    intercept: f64,
    slope: f64,
    /// rho, kg/m^3.
    density: f64,
}

impl Walther {
    /// The line through two points (temperature in K, kinematic viscosity in m^2/s above 0.3e-6) for an oil of the
    /// given density (kg/m^3).
    pub fn new(cold: (f64, f64), hot: (f64, f64), density: f64) -> Self {
        let ordinate = |nu: f64| math::log10(math::log10(nu * MM2_PER_S + SHIFT));
        let (x0, x1) = (math::log10(cold.0), math::log10(hot.0));
        let (y0, y1) = (ordinate(cold.1), ordinate(hot.1));
        let slope = (y0 - y1) / (x1 - x0);
        Self { intercept: y0 + slope * x0, slope, density }
    }

    /// Dynamic viscosity eta0 in Pa s at `temperature` in K. NaN where the line gives no viscosity.
    pub fn viscosity(&self, temperature: f64) -> f64 {
        let nu = math::ten_to(math::ten_to(self.intercept - self.slope * math::log10(temperature))) - SHIFT;
        let viscosity = nu / MM2_PER_S * self.density;
        if viscosity > 0.0 && viscosity.is_finite() { viscosity } else { f64::NAN }
    }

    /// Derivative of ln eta0 over the temperature in 1/K at `temperature` in K, where the line gives a viscosity.
    pub fn relative_slope(&self, temperature: f64) -> f64 {
        let exponent = math::ten_to(self.intercept - self.slope * math::log10(temperature));
        let shifted = math::ten_to(exponent);
        -shifted / (shifted - SHIFT) * LN_10 * exponent * self.slope / temperature
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn its_slope_is_that_of_the_viscosity() {
        let oil = Walther::new((313.15, 105e-6), (373.15, 12e-6), 880.0);
        for t in [290.0, 313.15, 350.0, 390.0] {
            let difference = (oil.viscosity(t + 1e-3) / oil.viscosity(t - 1e-3)).ln() / 2e-3;
            assert!((oil.relative_slope(t) / difference - 1.0).abs() < 1e-8, "{t}");
        }
    }

    #[test]
    fn passes_through_its_points_and_falls_with_temperature() {
        let oil = Walther::new((313.15, 105e-6), (373.15, 12e-6), 880.0);
        assert!((oil.viscosity(313.15) - 0.0924).abs() < 1e-12);
        assert!((oil.viscosity(373.15) - 0.01056).abs() < 1e-12);
        // Between the points, by hand: log10 log10 falls linearly over log10 T.
        let mean = ((105.7f64.log10().log10() + 12.7f64.log10().log10()) / 2.0, (313.15f64 * 373.15).sqrt());
        let nu = 10f64.powf(10f64.powf(mean.0)) - 0.7;
        assert!((oil.viscosity(mean.1) / (nu * 880e-6) - 1.0).abs() < 1e-12);
        assert!(oil.viscosity(340.0) > oil.viscosity(341.0));
    }

    #[test]
    fn far_too_cold_there_is_no_viscosity() {
        let oil = Walther::new((313.15, 105e-6), (373.15, 12e-6), 880.0);
        assert!(oil.viscosity(20.0).is_nan());
        assert!(oil.viscosity(-1.0).is_nan());
    }
}
