//! Central film thickness of a lubricated point contact, with an optional thermal correction.
//!
//! ```text
//! h_iso = 2.69 R_x U^0.67 G^0.53 W^-0.067 (1 - 0.61 e^(-0.73 k))              (Hamrock and Dowson 1977)
//! U = eta0 |u|/(E' R_x),  G = alpha E',  W = Q/(E' R_x^2),  R_x = 1/rho_t,  k = a/b
//! h_c   = T_R h_iso,  T_R of [`super::thickness`] at p0/E'
//! ```
//!
//! u is the mean of the surface speeds along the short half axis b; that across, about a hundredth of it in bearings, is left out. Valid for fully
//! flooded contacts with k >= 1 in the piezoviscous-elastic regime.

use super::thickness::{Entrainment, GUPTA_FLOOR, ThermalLoad};
use crate::laws::elastic::point::ElasticPoint;
use crate::scalar::{Numeric, math};

/// Film thickness law of the contacts of one race.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipseFilm {
    /// ln of h_iso in m at Q = 1 N, |u| = 1 m/s.
    ln_scale: f64,
    /// 1/E', 1/Pa.
    inverse_modulus: f64,
    /// Gupta's thermal factor, if it acts.
    pub thermal: Option<ThermalLoad>,
}

impl EllipseFilm {
    /// From the elastic contact, eta0 (Pa s) and alpha (1/Pa).
    pub fn new(
        point: &ElasticPoint,
        viscosity: f64,
        pressure_viscosity: f64,
        thermal: Option<ThermalLoad>,
    ) -> Self {
        let (modulus, radius) = (point.effective_modulus, 1.0 / point.curvatures[0]);
        let side_flow = 1.0 - 0.61 * math::exp(-0.73 * point.ellipticity);
        let ln_scale = math::ln(2.69 * radius * side_flow)
            + 0.67 * math::ln(viscosity / (modulus * radius))
            + 0.53 * math::ln(pressure_viscosity * modulus)
            + 0.067 * math::ln(modulus * radius * radius);
        Self { ln_scale, inverse_modulus: 1.0 / modulus, thermal }
    }

    /// ln of h_c in m under the load of which ln is `ln_q` (N) with the largest pressure p0 (Pa).
    #[inline(always)]
    pub fn ln_central<T: Numeric>(&self, ln_q: T, pressure: T, e: &Entrainment<T>) -> T {
        let ln_h = ln_q * -0.067 + (e.ln_speed + e.ln_viscosity) * 0.67 + self.ln_scale;
        match &self.thermal {
            None => ln_h,
            Some(load) => ln_h + load.gupta(pressure * self.inverse_modulus, e).floored(GUPTA_FLOOR).ln(),
        }
    }

    /// Whether the thermal factor is at its floor: speed and pressure are far outside of what it was fitted to.
    pub fn is_at_floor(&self, pressure: f64, e: &Entrainment<f64>) -> bool {
        self.thermal.is_some_and(|load| load.gupta(pressure * self.inverse_modulus, e) < GUPTA_FLOOR)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::elastic::line::effective_modulus;

    /// Inner race of the 218.
    fn point() -> ElasticPoint {
        let (ball, pitch, cos) = (11.115e-3, 62.63e-3, 40f64.to_radians().cos());
        let along = cos / (pitch - ball * cos);
        let modulus = effective_modulus(206e9, 0.3, 206e9, 0.3);
        ElasticPoint::new(modulus, [1.0 / ball + along, 1.0 / ball - 1.0 / (0.5232 * 22.23e-3)]).unwrap()
    }

    #[test]
    fn it_is_the_formula() {
        let (point, u, q) = (point(), 20.0, 1679.0);
        let film = EllipseFilm::new(&point, 0.03, 2e-8, None);
        let (e, r) = (point.effective_modulus, 1.0 / point.curvatures[0]);
        let expected = 2.69
            * r
            * (0.03 * u / (e * r)).powf(0.67)
            * (2e-8 * e).powf(0.53)
            * (q / (e * r * r)).powf(-0.067)
            * (1.0 - 0.61 * (-0.73 * point.ellipticity).exp());
        let h = film.ln_central(q.ln(), 1.5e9, &Entrainment::new(u, u, 0.0)).exp();
        assert!((h / expected - 1.0).abs() < 1e-10, "{h} {expected}");
        // About a micrometre is usual.
        assert!((0.3e-6..3e-6).contains(&h), "{h}");
    }

    #[test]
    fn heat_at_the_inlet_thins_it() {
        let cold = EllipseFilm::new(&point(), 0.03, 2e-8, None);
        let warm = EllipseFilm { thermal: Some(ThermalLoad::new(0.04, 0.03, 0.13)), ..cold };
        let at = |film: &EllipseFilm, u: f64| film.ln_central(7.0, 1.5e9, &Entrainment::new(u, u, 0.0)).exp();
        assert!(at(&warm, 1.0) > 0.97 * at(&cold, 1.0) && at(&warm, 40.0) < 0.8 * at(&cold, 40.0));
        assert!(warm.is_at_floor(3e9, &Entrainment::new(400.0, 400.0, 0.0)));
        assert!(!warm.is_at_floor(1.5e9, &Entrainment::new(40.0, 40.0, 0.0)));
    }
}
