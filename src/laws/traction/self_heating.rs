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
//! S falls with dT, so `F = dT - A S(dT)` increases and has one root between 0 and A S(0). Halley's method from dT = 0
//! finds it in 1 to 3 steps; where S turns from elastic to viscous it can swing to and fro, and bisection takes over.
//! A last Newton step is done in the law's own number type: with dual numbers it is the implicit-function rule.
//!
//! The iteration ends with a guarantee. F' >= 1, so |F| bounds the error of dT before the last step; |S''| <= 1 over
//! ln(eta_P), so S = dT/A after it is wrong by less than (beta F)^2/2, which is held below 1e-14 of S.

use crate::laws::traction::muraki_kimura::{MeanShear, ShearState};
use crate::scalar::{Base, Numeric, Of};
use std::f64::consts::PI;
use std::ops::Mul;

/// Steps before bisection takes over.
const FAST_STEPS: usize = 12;
/// Steps after which the iteration counts as failed.
const MAX_ITERATIONS: usize = 120;

/// Largest relative error of S from the iteration. One more step usually reaches it from 1e-6, and differences of forces
/// see no steps.
const ACCURACY: f64 = 1e-14;

/// Thermal constants of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SelfHeating<B = f64> {
    /// beta, 1/K.
    pub temperature_viscosity: f64,
    /// k', conductivity of the lubricant, W/(m K).
    pub conductivity: f64,
    /// tau0, Pa.
    pub eyring_stress: f64,
    /// e1 = k rho c of body 1, J^2/(m^4 s K^2).
    pub thermal_product_1: B,
    /// e2 = k rho c of body 2.
    pub thermal_product_2: B,
    /// Whether the film heats itself: 1, or 0 in a contact without self-heating that is evaluated beside others which have it.
    pub acts: B,
}

/// Solution of the self-heating equation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeatedShear<T> {
    /// S at the final temperature.
    pub stress: T,
    /// dT, K.
    pub temperature_rise: T,
}

impl<B> SelfHeating<B> {
    /// The same with every constant of the surfaces replaced.
    #[inline(always)]
    pub fn map<U>(&self, f: &mut impl FnMut(&B) -> U) -> SelfHeating<U> {
        SelfHeating {
            temperature_viscosity: self.temperature_viscosity,
            conductivity: self.conductivity,
            eyring_stress: self.eyring_stress,
            thermal_product_1: f(&self.thermal_product_1),
            thermal_product_2: f(&self.thermal_product_2),
            acts: f(&self.acts),
        }
    }
}

impl SelfHeating {
    /// The same without effect.
    pub fn none(&self) -> Self {
        Self { acts: 0.0, ..*self }
    }
}

impl<B: Base> SelfHeating<B> {
    /// A in K: temperature rise per unit of mean dimensionless stress. `u1`, `u2` relative to the contact, m/s.
    #[inline(always)]
    pub fn rise_per_stress<T: Of<B>>(&self, slip: T, film: T, half_width: T, u1: T, u2: T) -> T {
        let across_film = film * (1.0 / (12.0 * self.conductivity));
        let surfaces = heat_flow(self.thermal_product_1, u1, half_width)
            + heat_flow(self.thermal_product_2, u2, half_width);
        (across_film + slip.like(4.0 / 3.0) / surfaces) * slip * self.eyring_stress * self.acts
    }

    /// S and dT for the shear state; NaN when the inputs are not finite.
    #[inline(always)]
    pub fn solve<T: Numeric>(&self, shear: &ShearState<T>, rise_per_stress: T) -> HeatedShear<T> {
        self.solve_to(shear, rise_per_stress, ACCURACY)
    }

    #[inline(always)]
    fn solve_to<T: Numeric>(
        &self,
        shear: &ShearState<T>,
        rise_per_stress: T,
        accuracy: f64,
    ) -> HeatedShear<T> {
        let plain = ShearState { ln_sigma: shear.ln_sigma.base(), elastic_slope: shear.elastic_slope.base() };
        let (root, s) = self.iterate(&plain, rise_per_stress.base(), accuracy);
        let root = T::lift(root);
        let stress = if T::DERIVATIVES {
            shear.mean_shear(root * self.temperature_viscosity).stress
        } else {
            T::lift(s.stress)
        };
        let derivative = rise_per_stress.base() * s.slope * self.temperature_viscosity + 1.0;
        let rise = root + (rise_per_stress * stress - root) / T::lift(derivative);
        let cold = rise_per_stress.at_most(0.0);
        HeatedShear { stress: T::select(cold, stress, rise / rise_per_stress), temperature_rise: rise }
    }

    /// dT before the last step, and S there; NaN where there is none. Contacts that are done wait for the others.
    #[inline(always)]
    fn iterate<T: Base>(&self, shear: &ShearState<T>, a: T, accuracy: f64) -> (T, MeanShear<T>) {
        let beta = self.temperature_viscosity;
        let mut rise = a.splat(0.0);
        let (mut low, mut high) = (rise, rise);
        let zero = rise;
        let mut open = a.splat(1.0);
        let mut found = MeanShear { stress: zero, slope: zero, curvature: zero };
        for iteration in 0..MAX_ITERATIONS {
            let s = shear.mean_shear(rise * beta);
            if iteration == 0 {
                high = a * s.stress;
            }
            let missing = a * s.stress - rise;
            found = s;
            let colder = missing.at_least(0.0);
            low = T::select(colder, rise, low);
            high = T::select(colder, high, rise);
            let middle = (low + high) * 0.5;
            let next = if iteration < FAST_STEPS {
                // F' and F'' of F = dT - A S.
                let (first, second) = (a * s.slope * beta + 1.0, -(a * s.curvature * (beta * beta)));
                let near = rise + missing * first / (first * first + missing * second * 0.5);
                T::select(low.less_or_equal(near) & near.less_or_equal(high), near, middle)
            } else {
                middle
            };
            let error = missing * beta;
            let done = (error * error).less_or_equal(s.stress * (2.0 * accuracy));
            open = T::select(done, zero, open);
            rise = T::select(done, rise, next);
            if !T::any(open.above(0.0)) {
                return (rise, found);
            }
        }
        (T::select(open.above(0.0), a.splat(f64::NAN), rise), found)
    }
}

/// sqrt(pi e U/2b), per K and m^2. A floor far below any speed of interest keeps it differentiable when a surface stands
/// still.
#[inline(always)]
pub(super) fn heat_flow<P, T: Numeric + Mul<P, Output = T>>(thermal_product: P, u: T, half_width: T) -> T {
    ((u.abs() + 1e-9) * (PI / 2.0) * thermal_product / half_width).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::film::thickness::Entrainment;
    use crate::laws::traction::muraki_kimura::Traction;
    use crate::scalar::{Dual, Real};

    const STEEL: f64 = 46.0 * 7830.0 * 460.0;
    const LAW: SelfHeating = SelfHeating {
        temperature_viscosity: 0.04,
        conductivity: 0.13,
        eyring_stress: 5e6,
        thermal_product_1: STEEL,
        thermal_product_2: STEEL,
        acts: 1.0,
    };

    fn solve<T: Real>(du: T, pressure: f64) -> HeatedShear<T> {
        let t = Traction::new(0.06, 2e-8, 5e6, 3e8);
        let (h, b, u) = (T::constant(6e-7), T::constant(8e-5), T::constant(6.0));
        let rolling = Entrainment::new(u + du * 0.5, u - du * 0.5, T::constant(0.0));
        let shear = t.shear_state(T::constant(pressure), h, h.ln(), b, &rolling);
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
        for ln_sigma in [-5.0, 0.0, 5.0, 15.0, 25.0, 40.0] {
            for elastic_slope in [1e-3, 0.1, 2.0, 10.0, 50.0] {
                for a in [1e-3, 1.0, 30.0, 250.0, 2000.0] {
                    let shear = ShearState { ln_sigma, elastic_slope };
                    let x = LAW.solve(&shear, a);
                    let residual = x.temperature_rise - a * x.stress;
                    assert!(
                        residual.abs() <= 1e-6 * x.temperature_rise,
                        "{ln_sigma} {elastic_slope} {a}: {} {residual}",
                        x.temperature_rise
                    );
                }
            }
        }
    }

    #[test]
    fn the_accuracy_is_kept() {
        for accuracy in [1e-4, 1e-6, 1e-10] {
            let mut worst: f64 = 0.0;
            for i in 0..=90 {
                for j in 0..=60 {
                    for a in [1e-6, 1e-3, 0.1, 1.0, 30.0, 250.0, 2000.0] {
                        let shear = ShearState {
                            ln_sigma: -40.0 + f64::from(i),
                            elastic_slope: 10f64.powf(-3.0 + 0.1 * f64::from(j)),
                        };
                        let exact = LAW.solve(&shear, a).stress;
                        worst = worst.max((LAW.solve_to(&shear, a, accuracy).stress / exact - 1.0).abs());
                    }
                }
            }
            println!("accuracy {accuracy:e}: largest error {worst:e}");
            assert!(worst <= accuracy, "{accuracy}: {worst}");
            assert!(worst > 1e-3 * accuracy || worst < 1e-12, "{accuracy}: {worst}, far more than asked for");
        }
    }

    #[test]
    fn nan_is_passed_on() {
        assert!(solve(0.1, f64::NAN).stress.is_nan());
    }
}
