//! Friction torque of a whole bearing from catalogue values, and what its balls conduct.
//!
//! ```text
//! M0 = 1e-7 f0 (nu n)^(2/3) d_m^3       nu n >= 2000,   M0 = 160e-7 f0 d_m^3   below
//! M1 = f1 F d_m                         M in N mm, nu in mm^2/s, n in 1/min, d_m in mm
//! g  = Z 590 D^2 sqrt(ln(w d_m/2000) - ln D + 7)     W/K, in SI, w >= 1 rad/s
//! ```
//!
//! d_m pitch diameter, D diameter of the Z balls, w speed of the inner ring. The torque is good to a factor of two: it jumps by 0.8 %
//! at nu n = 2000. Source: Palmgren, with coefficients in the catalogues of all makers; Schaefer 1993 for the conductance.

use crate::scalar::math;
use std::f64::consts::TAU;

/// mm per m, and mm^2/s per m^2/s.
const MM: f64 = 1e3;
const MM2_PER_S: f64 = 1e6;
/// Where the torque without load begins to grow, mm^2/(s min).
const SLOW: f64 = 2000.0;

/// Coefficients of a bearing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Palmgren {
    /// f0.
    pub f0: f64,
    /// f1.
    pub f1: f64,
    /// F, N.
    pub load: f64,
    /// d_m, m.
    pub pitch_diameter: f64,
}

impl Palmgren {
    /// Torque in N m at a speed of the inner ring in rad/s with a kinematic viscosity in m^2/s.
    pub fn torque(&self, speed: f64, viscosity: f64) -> f64 {
        self.without_load(speed, viscosity) + self.by_load()
    }

    /// M0 in N m, likewise.
    pub fn without_load(&self, speed: f64, viscosity: f64) -> f64 {
        let d = self.pitch_diameter * MM;
        let turns = speed.abs() / TAU * 60.0;
        let product = viscosity * MM2_PER_S * turns;
        let grows = if product >= SLOW { math::exp(math::ln(product) * (2.0 / 3.0)) } else { 160.0 };
        1e-7 * self.f0 * grows * d * d * d / MM
    }

    /// M1 in N m.
    pub fn by_load(&self) -> f64 {
        self.f1 * self.load * self.pitch_diameter
    }
}

/// g in W/K of this many balls of `diameter` (m) between rings, at this speed of the inner one (rad/s).
pub fn ball_conductance(count: usize, diameter: f64, pitch_diameter: f64, speed: f64) -> f64 {
    let flow = math::ln(speed.abs().max(1.0) * pitch_diameter / 2000.0) - math::ln(diameter) + 7.0;
    count as f64 * 590.0 * diameter * diameter * flow.max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn torque_is_that_of_the_catalogue_formula() {
        let bearing = Palmgren { f0: 2.0, f1: 0.00046, load: 687.0, pitch_diameter: 90e-3 };
        // 3000 1/min, 40 mm^2/s: 1e-7 * 2 * 120000^(2/3) * 90^3 + 0.00046 * 687 * 90 N mm.
        let expected = 1e-7 * 2.0 * 120_000f64.powf(2.0 / 3.0) * 729_000.0 + 28.44;
        let found = bearing.torque(TAU * 50.0, 40e-6) * 1e3;
        assert!((found / expected - 1.0).abs() < 1e-4, "{found} {expected}");
        // At rest and slowly it does not depend on the viscosity, and it jumps by less than a per cent where it begins to.
        assert_eq!(bearing.torque(1.0, 40e-6), bearing.torque(1.0, 80e-6));
        let at = |product: f64| Palmgren { load: 0.0, ..bearing }.torque(TAU * 50.0, product / 3000.0 * 1e-6);
        assert!((at(2000.01) / at(1999.99) - 1.0).abs() < 0.009);
    }

    #[test]
    fn balls_conduct_more_at_speed() {
        let g = |turns: f64| ball_conductance(25, 8.731e-3, 90e-3, TAU * turns / 60.0);
        assert!((g(3000.0) - 3.07).abs() < 0.02, "{}", g(3000.0));
        assert!(g(500.0) < g(3000.0) && g(3000.0) < g(8000.0));
        assert!(ball_conductance(25, 8.731e-3, 90e-3, 0.0) > 0.0);
    }
}
