//! Traction of a fully lubricated line contact (Muraki and Kimura's simplified equations).
//!
//! ```text
//! Sigma = eta_P |du| / (tau0 h_c),   D = eta_P u / (G_l b),   X_c = (D/Sigma) asinh(Sigma)
//! S = asinh(Sigma) (1 - X_c/4)   for X_c < 2,      S = Sigma/D   for X_c >= 2
//! F = tau0 S 2 b l
//! ```
//!
//! S is the mean over the contact length of a stress that ramps up elastically with slope Sigma/D and is capped
//! at asinh(Sigma); it is continuously differentiable at X_c = 2. Sigma/D does not depend on viscosity, and only
//! ln(eta_P) enters, so pressures far above 1 GPa do not overflow. Source: NTN Eq. 6-8.

use crate::laws::film::thickness::Entrainment;
use crate::scalar::Numeric;
use crate::scalar::math;
use std::f64::consts::LN_2;

/// Above this ln(Sigma), asinh(Sigma) equals ln(2 Sigma) to round-off.
const ASINH_ASYMPTOTE: f64 = 20.0;

/// Lubricant constants of the traction law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Traction<B = f64> {
    /// ln(eta0/tau0), in s.
    pub ln_time: f64,
    /// alpha, 1/Pa.
    pub pressure_viscosity: f64,
    /// tau0, characteristic (Eyring) stress, Pa.
    pub eyring_stress: f64,
    /// G_l, shear modulus of the lubricant, Pa.
    pub shear_modulus: f64,
    /// Whether the film has traction: 1, or 0 in a contact without it that is evaluated beside others which have it.
    pub acts: B,
}

/// Conditions of one contact under which the mean shear stress is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearState<T> {
    /// ln(Sigma) without self-heating.
    pub ln_sigma: T,
    /// Sigma/D, the elastic slope.
    pub elastic_slope: T,
}

/// Mean dimensionless shear stress and its derivative with respect to ln(eta_P).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeanShear<T> {
    /// S.
    pub stress: T,
    /// dS/d(ln eta_P).
    pub slope: T,
    /// d2S/d(ln eta_P)2; it jumps where S turns from elastic to viscous.
    pub curvature: T,
}

impl Traction {
    /// From eta0 (Pa s), alpha (1/Pa), tau0 (Pa) and G_l (Pa), all > 0.
    pub fn new(viscosity: f64, pressure_viscosity: f64, eyring_stress: f64, shear_modulus: f64) -> Self {
        Self {
            ln_time: math::ln(viscosity / eyring_stress),
            pressure_viscosity,
            eyring_stress,
            shear_modulus,
            acts: 1.0,
        }
    }

    /// The same without effect.
    pub fn none(&self) -> Self {
        Self { acts: 0.0, ..*self }
    }
}

impl<B> Traction<B> {
    /// The same with what belongs to the contact replaced.
    #[inline(always)]
    pub fn map<U>(&self, f: &mut impl FnMut(&B) -> U) -> Traction<U> {
        Traction {
            ln_time: self.ln_time,
            pressure_viscosity: self.pressure_viscosity,
            eyring_stress: self.eyring_stress,
            shear_modulus: self.shear_modulus,
            acts: f(&self.acts),
        }
    }

    /// The shear state at mean pressure (Pa), film thickness (m) and its ln, and half width (m).
    #[inline(always)]
    pub fn shear_state<T: Numeric>(
        &self,
        mean_pressure: T,
        film: T,
        ln_film: T,
        half_width: T,
        e: &Entrainment<T>,
    ) -> ShearState<T> {
        let ln_viscosity_time = mean_pressure * self.pressure_viscosity + e.ln_viscosity + self.ln_time;
        let stiffness = self.shear_modulus / self.eyring_stress;
        ShearState {
            ln_sigma: ln_viscosity_time + e.ln_slip - ln_film,
            elastic_slope: e.slip * half_width * stiffness / (film * e.speed),
        }
    }
}

impl<T: Numeric> ShearState<T> {
    /// S when the film is warmer than the inlet so that ln(eta_P) falls by `cooling` (= beta dT).
    #[inline(always)]
    pub fn mean_shear(&self, cooling: T) -> MeanShear<T> {
        let ln_sigma = self.ln_sigma - cooling;
        let steep = ln_sigma.above(ASINH_ASYMPTOTE);
        let one = ln_sigma.like(1.0);
        let sigma = T::select(steep, one, ln_sigma).exp();
        // asinh(Sigma), and its derivative over ln(Sigma): Sigma/sqrt(1 + Sigma^2).
        let root = (sigma * sigma + 1.0).sqrt();
        let inverse = one / (root * (root + 1.0));
        let near =
            if T::DERIVATIVES { sigma.asinh() } else { (sigma + sigma * sigma * root * inverse).ln_1p() };
        let cap = T::select(steep, ln_sigma + LN_2, near);
        let cap_slope = T::select(steep, one, sigma * (root + 1.0) * inverse);
        // The same at every temperature.
        let compliance = one / self.elastic_slope;
        let x_c = cap * compliance;
        let elastic = x_c.at_least(2.0);
        let (zero, ramp) = (one.like(0.0), -x_c * 0.5 + 1.0);
        let square = cap_slope * cap_slope;
        let curvature = (cap_slope - cap_slope * square) * ramp - square * compliance * 0.5;
        MeanShear {
            stress: T::select(elastic, self.elastic_slope, cap * (-x_c * 0.25 + 1.0)),
            slope: T::select(elastic, zero, cap_slope * ramp),
            curvature: T::select(elastic, zero, curvature),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(sigma: f64, d: f64) -> ShearState<f64> {
        ShearState { ln_sigma: sigma.ln(), elastic_slope: sigma / d }
    }

    /// Mean over 0 < X < 2 of min(X Sigma/D, asinh Sigma) by the midpoint rule.
    fn mean_of_ramp(sigma: f64, d: f64) -> f64 {
        let n = 200_000;
        (0..n).map(|i| ((i as f64 + 0.5) * 2.0 / n as f64 * sigma / d).min(sigma.asinh())).sum::<f64>()
            / n as f64
    }

    #[test]
    fn mean_shear_is_the_mean_of_a_capped_ramp() {
        for sigma in [0.01, 0.5, 3.0, 100.0] {
            for d in [0.05, 0.5, 1.9, 2.1, 30.0, 500.0] {
                let s = state(sigma, d).mean_shear(0.0).stress;
                // mean over a length 2 of a ramp that reaches its cap at X_c
                let expected = mean_of_ramp(sigma, d);
                assert!((s / expected - 1.0).abs() < 1e-6, "Sigma {sigma}, D {d}: {s} {expected}");
            }
        }
    }

    #[test]
    fn smooth_at_the_change_from_elastic_to_viscous() {
        // X_c = 2 where asinh(Sigma) = 2 Sigma / D.
        let sigma = 5.0_f64;
        let d = 2.0 * sigma / sigma.asinh();
        let at = |f: f64| state(sigma, d * f).mean_shear(0.0);
        let (below, above) = (at(1.0 - 1e-7), at(1.0 + 1e-7));
        assert!((below.stress - above.stress).abs() < 1e-6);
        assert!((below.slope - above.slope).abs() < 1e-6);
    }

    #[test]
    fn limits_newtonian_and_extreme_pressure() {
        // Small Sigma and D: Newtonian, S = Sigma.
        assert!((state(1e-4, 1e-5).mean_shear(0.0).stress / 1e-4 - 1.0).abs() < 1e-5);
        // A mean pressure of 100 GPa would overflow exp(alpha P).
        let t = Traction::new(0.06, 2e-8, 5e6, 3e8);
        let e = Entrainment::new(5.05, 4.95, 0.0);
        let s = t.shear_state(1e11, 1e-7, 1e-7f64.ln(), 1e-4, &e).mean_shear(0.0).stress;
        assert!(s.is_finite() && s > 0.0);
    }

    #[test]
    fn slope_is_the_derivative_with_ln_viscosity() {
        for (sigma, d) in [(0.3, 0.2), (40.0, 1.0), (1e12, 1e9), (2.0, 50.0)] {
            let s = state(sigma, d);
            let h = 1e-6;
            let difference = (s.mean_shear(-h).stress - s.mean_shear(h).stress) / (2.0 * h);
            let here = s.mean_shear(0.0);
            assert!((here.slope - difference).abs() < 1e-6 * (1.0 + difference.abs()));
            let bend = (s.mean_shear(-h).slope - s.mean_shear(h).slope) / (2.0 * h);
            assert!((here.curvature - bend).abs() < 1e-6 * (1.0 + bend.abs()));
        }
    }
}
