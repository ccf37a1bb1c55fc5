//! Central film thickness of a lubricated line contact, with an optional thermal correction.
//!
//! ```text
//! h_iso = 2.922 R_e W^-0.166 U^0.692 G^0.470                      (Pan and Hamrock 1989)
//! W = Q/(E' R_e l),  U = eta0 |u|/(E' R_e),  G = alpha E',  u = (u1 + u2)/2
//! h_c   = T h_iso
//! T_H = 1/[1 + 1.6 W^0.152 L_T^0.379 (1 + 3.96 s^0.96)]           (Ghosh and Pandey 1998)
//! T_R = [1 - 13.2 (P_max/E') L_T^0.42] / [1 + 0.213 (1 + 2.23 s^0.83) L_T^0.64]        (Gupta)
//! L_T = beta eta0 u^2 / k',  s = |u1 - u2| / |u|
//! ```
//!
//! Valid for fully flooded line contacts in the piezoviscous-elastic regime. Sources: NTN Eq. 2, 3, 5 and 11.
//! The Ghosh-Pandey factor is only partly legible in the paper's text; its form here is the best reading.

use super::normal_contact::ElasticLine;
use super::relative_viscosity::RelativeViscosity;
use crate::scalar::Real;
use std::f64::consts::PI;

/// Smoothing speed of |u| at rest, m/s: |u| is taken as sqrt(u^2 + floor^2), so that film thickness, thermal
/// load and slide-to-roll ratio stay finite and smooth when the rolling speed passes through zero.
pub const ENTRAINMENT_FLOOR: f64 = 1e-6;

/// Smallest Gupta factor of the film thickness: beyond the range of the fit the formula turns negative.
pub const GUPTA_FLOOR: f64 = 1e-3;

/// Lubricant constants of the thermal load parameter L_T.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThermalLoad {
    /// beta eta0 / k', s^2/m^2.
    pub factor: f64,
}

/// Thermal correction of the film thickness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ThermalCorrection {
    /// Ghosh and Pandey 1998, factor T_H.
    GhoshPandey(ThermalLoad),
    /// Gupta's form, factor T_R.
    Gupta(ThermalLoad),
}

/// Film thickness law of one contact pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmThickness {
    /// Equivalent radius R_e, m.
    pub equivalent_radius: f64,
    /// 1/(E' R_e l), 1/N.
    pub load_factor: f64,
    /// eta0/(E' R_e), s/m.
    pub speed_factor: f64,
    /// G = alpha E'.
    pub material: f64,
    /// Effective modulus E', Pa.
    pub effective_modulus: f64,
    /// Optional thermal correction.
    pub thermal: Option<ThermalCorrection>,
}

/// Rolling and sliding speed of a contact and the viscosity at its inlet, in the form the power laws need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entrainment<T> {
    /// Smoothed |u|, m/s.
    pub speed: T,
    /// u divided by the smoothed |u|: the direction of rolling, smooth through zero.
    pub direction: T,
    /// Slide-to-roll ratio s = |u1 - u2|/|u|.
    pub slide_roll: T,
    /// eta0 over the eta0 of the law.
    pub viscosity: RelativeViscosity<T>,
}

impl<T: Real> Entrainment<T> {
    /// From the surface speeds `u1`, `u2` relative to the contact, m/s.
    pub fn new(u1: T, u2: T, viscosity: RelativeViscosity<T>) -> Self {
        let u = (u1 + u2) * 0.5;
        let speed = (u * u + ENTRAINMENT_FLOOR * ENTRAINMENT_FLOOR).sqrt();
        Self { speed, direction: u / speed, slide_roll: (u1 - u2).abs() / speed, viscosity }
    }
}

impl ThermalLoad {
    /// From beta (1/K), eta0 (Pa s) and k' (W/(m K)).
    pub fn new(temperature_viscosity: f64, viscosity: f64, conductivity: f64) -> Self {
        Self { factor: temperature_viscosity * viscosity / conductivity }
    }

    /// L_T.
    pub fn parameter<T: Real>(&self, e: &Entrainment<T>) -> T {
        e.speed * e.speed * e.viscosity.ratio * self.factor
    }

    /// Gupta's factor T_R; `pressure` is P_max/E'. Not limited: it is negative far outside the fitted range.
    pub fn gupta<T: Real>(&self, pressure: T, e: &Entrainment<T>) -> T {
        let l_t = self.parameter(e);
        let slip = power_of_slip(e.slide_roll, 0.83) * 2.23 + 1.0;
        (-(pressure * l_t.powf(0.42) * 13.2) + 1.0) / (slip * l_t.powf(0.64) * 0.213 + 1.0)
    }

    /// Ghosh and Pandey's factor T_H; `load` is W.
    pub fn ghosh_pandey<T: Real>(&self, load: T, e: &Entrainment<T>) -> T {
        let l_t = self.parameter(e);
        let slip = power_of_slip(e.slide_roll, 0.96) * 3.96 + 1.0;
        T::constant(1.0) / (load.powf(0.152) * l_t.powf(0.379) * slip * 1.6 + 1.0)
    }
}

/// `s^p` for 0 < p < 1 without the infinite slope at s = 0 (shifted by 1e-12, far below any physical slip).
fn power_of_slip<T: Real>(s: T, p: f64) -> T {
    (s + 1e-12).powf(p)
}

impl FilmThickness {
    /// From the elastic contact, eta0 (Pa s) and alpha (1/Pa).
    pub fn new(
        line: &ElasticLine,
        viscosity: f64,
        pressure_viscosity: f64,
        thermal: Option<ThermalCorrection>,
    ) -> Self {
        let e_r = line.effective_modulus * line.equivalent_radius;
        Self {
            equivalent_radius: line.equivalent_radius,
            load_factor: 1.0 / (e_r * line.length),
            speed_factor: viscosity / e_r,
            material: pressure_viscosity * line.effective_modulus,
            effective_modulus: line.effective_modulus,
            thermal,
        }
    }

    /// Isothermal central film thickness in m under the load `q` > 0 (N).
    pub fn isothermal<T: Real>(&self, q: T, e: &Entrainment<T>) -> T {
        let constant = 2.922 * self.equivalent_radius * self.material.powf(0.470);
        let u = e.speed * e.viscosity.ratio * self.speed_factor;
        (q * self.load_factor).powf(-0.166) * u.powf(0.692) * constant
    }

    /// Central film thickness h_c in m under the load `q` > 0 (N); `mean_pressure` is P_mean in Pa.
    pub fn central<T: Real>(&self, q: T, mean_pressure: T, e: &Entrainment<T>) -> T {
        let h = self.isothermal(q, e);
        match &self.thermal {
            None => h,
            Some(ThermalCorrection::GhoshPandey(load)) => h * load.ghosh_pandey(q * self.load_factor, e),
            Some(ThermalCorrection::Gupta(load)) => {
                let pressure = mean_pressure * (4.0 / PI / self.effective_modulus);
                h * load.gupta(pressure, e).at_least(GUPTA_FLOOR)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::normal_contact::effective_modulus;

    #[test]
    fn pan_hamrock_reference_values() {
        // Roller r = 8 mm, l = 24 mm, races 32 and 48 mm, 1000 N, eta0 = 0.05 Pa s, u = 6.0319 m/s.
        let e = effective_modulus(206e9, 0.3, 206e9, 0.3);
        for (re, expected) in [(6.4e-3, 1.1074e-6), (9.6e-3, 1.3420e-6)] {
            let line = ElasticLine::new(e, re, 0.024);
            let film = FilmThickness::new(&line, 0.05, 2e-8, None);
            let h = film.isothermal(1000.0, &Entrainment::new(6.0319, 6.0319, RelativeViscosity::one()));
            assert!((h / expected - 1.0).abs() < 1e-4, "{h} instead of {expected}");
            assert!((film.material / 4527.5 - 1.0).abs() < 1e-4);
        }
    }

    #[test]
    fn thermal_factors_start_at_one_and_fall_with_speed_and_slip() {
        let load = ThermalLoad::new(0.04, 0.06, 0.13);
        let at = |u: f64, du: f64| Entrainment::new(u + du / 2.0, u - du / 2.0, RelativeViscosity::one());
        assert!((load.ghosh_pandey(3e-5, &at(1e-3, 0.0)) - 1.0).abs() < 0.01);
        assert!((load.gupta(2e-3, &at(1e-3, 0.0)) - 1.0).abs() < 1e-3);
        for f in [
            |l: &ThermalLoad, e: &Entrainment<f64>| l.ghosh_pandey(3e-5, e),
            |l: &ThermalLoad, e: &Entrainment<f64>| l.gupta(2e-3, e),
        ] {
            let (slow, fast, sliding) =
                (f(&load, &at(1.0, 0.0)), f(&load, &at(20.0, 0.0)), f(&load, &at(20.0, 5.0)));
            assert!(slow < 1.0 && fast < slow && sliding < fast && sliding > 0.0);
        }
    }

    #[test]
    fn film_stays_finite_when_rolling_stops() {
        let line = ElasticLine::new(2.26e11, 6e-3, 0.02);
        let thermal = Some(ThermalCorrection::GhoshPandey(ThermalLoad::new(0.04, 0.06, 0.13)));
        let film = FilmThickness::new(&line, 0.06, 2e-8, thermal);
        let stop = Entrainment::new(1.0, -1.0, RelativeViscosity::one());
        let h = film.central(1000.0, 3e8, &stop);
        assert!(h > 0.0 && h < 1e-9, "{h}");
        assert_eq!(stop.direction, 0.0);
    }
}
