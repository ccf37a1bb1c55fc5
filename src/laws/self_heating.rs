//! Self-heating of the traction film: the temperature rise that its own friction sustains.
//!
//! ```text
//! eta_P = eta0 exp(alpha P_mean - beta dT)
//! dT    = A S(dT),  A = tau0 |du| [ h_c/(12 k') + (4/3)/(sqrt(pi e1 U1/2b) + sqrt(pi e2 U2/2b)) ]
//! e     = k rho c of each solid,  U = speed of its surface past the contact
//! ```
//!
//! Mean rise across the film plus Jaeger's flash rise with equal surface temperatures. The paper (NTN, text after
//! Eq. 8) only says that the rise must be iterated; this closure is an assumption of the library.
//!
//! S falls with dT, so `dT - A S(dT)` increases and has one root between 0 and A S(0). Newton's method from dT = 0
//! finds it in 2 to 6 steps; where S turns from elastic to viscous it can swing to and fro, and bisection takes over.
//! The last Newton step is done in the law's own number type: with dual numbers it is the implicit-function rule.

use super::traction::{MeanShear, ShearState};
use crate::scalar::Real;
use std::f64::consts::PI;

/// Newton steps before bisection takes over.
const NEWTON_STEPS: usize = 12;
/// Steps after which the iteration counts as failed.
const MAX_ITERATIONS: usize = 120;
/// Relative accuracy of dT at which Newton stops; the last step squares it.
const TOLERANCE: f64 = 1e-7;

/// Thermal constants of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SelfHeating {
    /// beta, 1/K.
    pub temperature_viscosity: f64,
    /// k', conductivity of the lubricant, W/(m K).
    pub conductivity: f64,
    /// tau0, Pa.
    pub eyring_stress: f64,
    /// e1 = k rho c of body 1, J^2/(m^4 s K^2).
    pub thermal_product_1: f64,
    /// e2 = k rho c of body 2.
    pub thermal_product_2: f64,
}

/// Solution of the self-heating equation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeatedShear<T> {
    /// S at the final temperature.
    pub stress: T,
    /// dT, K.
    pub temperature_rise: T,
}

impl SelfHeating {
    /// A in K: temperature rise per unit of mean dimensionless stress. `u1`, `u2` relative to the contact, m/s.
    pub fn rise_per_stress<T: Real>(&self, slip: T, film: T, half_width: T, u1: T, u2: T) -> T {
        let across_film = film / (12.0 * self.conductivity);
        // A floor far below any speed of interest keeps sqrt differentiable when a surface stands still.
        let flow = |e: f64, u: T| ((u.abs() + 1e-9) * (PI * e / 2.0) / half_width).sqrt();
        let surfaces = flow(self.thermal_product_1, u1) + flow(self.thermal_product_2, u2);
        (across_film + T::constant(4.0 / 3.0) / surfaces) * slip * self.eyring_stress
    }

    /// S and dT for the shear state; NaN when the inputs are not finite.
    pub fn solve<T: Real>(&self, shear: &ShearState<T>, rise_per_stress: T) -> HeatedShear<T> {
        let plain = ShearState {
            ln_rate_scale: shear.ln_rate_scale.value(),
            slip: shear.slip.value(),
            elastic_slope: shear.elastic_slope.value(),
        };
        let (a, beta) = (rise_per_stress.value(), self.temperature_viscosity);
        let (mut low, mut high) = (0.0, f64::INFINITY);
        let mut rise = 0.0;
        let mut converged = false;
        for i in 0..MAX_ITERATIONS {
            let shear = plain.mean_shear(beta * rise);
            if i == 0 {
                high = a * shear.stress;
            }
            if a * shear.stress >= rise {
                low = rise;
            } else {
                high = rise;
            }
            let newton = rise + newton_step(shear, a, beta, rise);
            let inside = low <= newton && newton <= high && i < NEWTON_STEPS;
            let next = if inside { newton } else { 0.5 * (low + high) };
            let change = (next - rise).abs();
            rise = next;
            if change <= TOLERANCE * rise {
                converged = true;
                break;
            }
        }
        let rise = T::constant(if converged { rise } else { f64::NAN });
        let rise = rise + newton_step(shear.mean_shear(rise * beta), rise_per_stress, beta, rise);
        HeatedShear { stress: shear.mean_shear(rise * beta).stress, temperature_rise: rise }
    }
}

/// Newton correction for f(dT) = dT - A S(dT); the derivative enters as a plain number.
fn newton_step<T: Real>(s: MeanShear<T>, a: T, beta: f64, rise: T) -> T {
    let derivative = 1.0 + a.value() * beta * s.slope.value();
    (a * s.stress - rise) / derivative
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::film_thickness::Entrainment;
    use crate::laws::relative_viscosity::RelativeViscosity;
    use crate::laws::traction::Traction;
    use crate::scalar::Dual;

    const STEEL: f64 = 46.0 * 7830.0 * 460.0;
    const LAW: SelfHeating = SelfHeating {
        temperature_viscosity: 0.04,
        conductivity: 0.13,
        eyring_stress: 5e6,
        thermal_product_1: STEEL,
        thermal_product_2: STEEL,
    };

    fn solve<T: Real>(du: T, pressure: f64) -> HeatedShear<T> {
        let t = Traction::new(0.06, 2e-8, 5e6, 3e8);
        let (h, b, u) = (T::constant(6e-7), T::constant(8e-5), T::constant(6.0));
        let rolling = Entrainment::new(u, u, RelativeViscosity::one());
        let shear = t.shear_state(T::constant(pressure), h, b, &rolling, du);
        let a = LAW.rise_per_stress(du, h, b, u, u);
        LAW.solve(&shear, a)
    }

    #[test]
    fn root_satisfies_the_equation_over_a_wide_range() {
        for pressure in [1e6, 3e8, 1e9, 3e9] {
            for du in [1e-12, 1e-4, 0.05, 2.0, 30.0] {
                let x = solve(du, pressure);
                let law_a = LAW.rise_per_stress(du, 6e-7, 8e-5, 6.0, 6.0);
                let residual = x.temperature_rise - law_a * x.stress;
                assert!(x.temperature_rise >= 0.0);
                assert!(
                    residual.abs() <= 1e-11 * x.temperature_rise.max(1e-300),
                    "p {pressure} du {du}: rise {} residual {residual}",
                    x.temperature_rise
                );
            }
        }
    }

    #[test]
    fn derivative_follows_the_implicit_function_rule() {
        for du in [1e-3, 0.05, 0.5, 3.0] {
            let d = solve(Dual::<1>::variable(du, 0), 6e8);
            let h = 1e-5 * du;
            let slope = (solve(du + h, 6e8).stress - solve(du - h, 6e8).stress) / (2.0 * h);
            let rise =
                (solve(du + h, 6e8).temperature_rise - solve(du - h, 6e8).temperature_rise) / (2.0 * h);
            assert!((d.stress.eps[0] / slope - 1.0).abs() < 1e-6, "{} {slope}", d.stress.eps[0]);
            assert!((d.temperature_rise.eps[0] / rise - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn converges_where_newton_alone_swings_between_elastic_and_viscous() {
        for ln_rate_scale in [-5.0, 0.0, 5.0, 15.0, 25.0, 40.0] {
            for elastic_slope in [1e-3, 0.1, 2.0, 10.0, 50.0] {
                for a in [1e-3, 1.0, 30.0, 250.0, 2000.0] {
                    let shear = ShearState { ln_rate_scale, slip: 1.0, elastic_slope };
                    let x = LAW.solve(&shear, a);
                    let residual = x.temperature_rise - a * x.stress;
                    assert!(
                        residual.abs() <= 1e-6 * x.temperature_rise,
                        "{ln_rate_scale} {elastic_slope} {a}: {x:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn nan_is_passed_on() {
        assert!(solve(0.1, f64::NAN).stress.is_nan());
    }
}
