//! Drag of a mixture of air and oil on a ball that moves and turns in it.
//!
//! ```text
//! F = -(1/2) rho C_d pi R^2 |v| v
//! M = -(1/2) rho R^5 C_n |w| w,   C_n = 6.45/sqrt(Re) + 32.1/Re,   Re = rho R^2 |w|/eta
//! ```
//!
//! Valid up to Re of 3e5. Source: drag of spheres, as in any textbook of fluid mechanics; moment of a turning sphere as fitted by
//! Sawatzki (Acta Mechanica 9, 1970). The density of the mixture, 0.5 to 10 % of that of oil, is an assumption of the scene.

use crate::scalar::Numeric;
use std::f64::consts::PI;

/// Added to the squares of speeds, so that roots have derivatives at rest.
const FLOOR: f64 = 1e-24;

/// Drag of a mixture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MixtureDrag {
    /// rho, kg/m^3.
    pub density: f64,
    /// C_d.
    pub coefficient: f64,
    /// eta of the oil, Pa s.
    pub viscosity: f64,
}

impl MixtureDrag {
    /// -F/v in N s/m and -M/w in N m s of a ball of this radius (m) at the squares of its speed (m^2/s^2) and of its angular velocity
    /// (rad^2/s^2), at e^`ln_viscosity` times the viscosity.
    #[inline(always)]
    pub fn per_speed<T: Numeric>(&self, radius: f64, [speed, turning]: [T; 2], ln_viscosity: T) -> [T; 2] {
        let [speed, turning] = [(speed + FLOOR).sqrt(), (turning + FLOOR).sqrt()];
        let square = radius * radius;
        // rho R^5 C_n |w| = R^3 (6.45 sqrt(rho R^2 eta |w|) + 32.1 eta).
        let eta = ln_viscosity.exp() * self.viscosity;
        let shear = (eta * turning * (self.density * square)).sqrt() * 6.45 + eta * 32.1;
        [speed * (0.5 * self.density * self.coefficient * PI * square), shear * (0.5 * square * radius)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Dual;

    #[test]
    fn the_drag_of_a_fast_ball_and_that_of_stokes() {
        let drag = MixtureDrag { density: 60.0, coefficient: 0.5, viscosity: 0.03 };
        let (radius, v, w) = (11.115e-3, 29.0, 2500.0);
        let [force, moment] = drag.per_speed(radius, [v * v, w * w], 0.0_f64);
        assert!((force * v - 0.5 * 60.0 * 0.5 * PI * radius * radius * v * v).abs() < 1e-12, "{force}");
        let re = 60.0 * radius * radius * w / 0.03;
        let cn = 6.45 / f64::sqrt(re) + 32.1 / re;
        let expected = 0.5 * 60.0 * radius.powi(5) * cn * w * w;
        assert!((moment * w / expected - 1.0).abs() < 1e-12, "{moment} {expected}");
        let still = Dual::<1>::variable(0.0, 0);
        let [_, moment] = drag.per_speed(radius, [still * still; 2], Dual::<1>::lift(0.0));
        assert!((moment.re / (0.5 * radius.powi(3) * 32.1 * 0.03) - 1.0).abs() < 1e-5, "{moment:?}");
        assert!(moment.eps[0].is_finite());
    }
}
