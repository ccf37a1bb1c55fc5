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

use crate::laws::elastic::line::ElasticLine;
use crate::scalar::math;
use crate::scalar::{Base, Numeric, Of};
use std::f64::consts::PI;

/// Smoothing speed of |u| at rest, m/s: |u| is taken as sqrt(u^2 + floor^2), so that film thickness, thermal
/// load and slide-to-roll ratio stay finite and smooth when the rolling speed passes through zero.
pub const ENTRAINMENT_FLOOR: f64 = 1e-6;

/// Smallest Gupta factor of the film thickness: beyond the range of the fit the formula turns negative.
pub const GUPTA_FLOOR: f64 = 1e-3;

/// Added to |u1 - u2| in m/s, so that friction and its slope are defined at zero slip; far below round-off of any
/// surface speed.
pub(super) const SLIP_FLOOR: f64 = 1e-12;

/// Lubricant constants of the thermal load parameter L_T.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThermalLoad {
    /// ln(beta eta0 / k'), in s^2/m^2.
    pub ln_factor: f64,
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
pub struct FilmThickness<B = f64> {
    /// ln(2.922 R_e W^-0.166 U^0.692 G^0.470) at Q = 1 N, |u| = 1 m/s, R_e in m.
    pub ln_scale: B,
    /// ln(1/(E' R_e l)), 1/N.
    pub ln_load_factor: B,
    /// 4/(pi E'), from P_mean to P_max/E', 1/Pa.
    pub pressure_factor: B,
    /// Optional thermal correction.
    pub thermal: Option<ThermalCorrection>,
    /// Whether it acts: 1, or 0 in a contact without correction that is evaluated beside others which have it.
    pub thermal_acts: B,
}

/// Rolling and sliding speed of a contact and the viscosity at its inlet, in the form the power laws need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entrainment<T> {
    /// Smoothed |u|, m/s.
    pub speed: T,
    /// u divided by the smoothed |u|: the direction of rolling, smooth through zero.
    pub direction: T,
    /// |u1 - u2| > 0, m/s.
    pub slip: T,
    /// ln |u|.
    pub ln_speed: T,
    /// ln |u1 - u2|.
    pub ln_slip: T,
    /// ln of eta0 over the eta0 that the law was made with.
    pub ln_viscosity: T,
}

impl<T: Numeric> Entrainment<T> {
    /// From the surface speeds `u1`, `u2` relative to the contact, m/s, and ln of the relative viscosity.
    #[inline(always)]
    pub fn new(u1: T, u2: T, ln_viscosity: T) -> Self {
        let u = (u1 + u2) * 0.5;
        let speed = (u * u + ENTRAINMENT_FLOOR * ENTRAINMENT_FLOOR).sqrt();
        let slip = (u1 - u2).abs() + SLIP_FLOOR;
        Self { speed, direction: u / speed, slip, ln_speed: speed.ln(), ln_slip: slip.ln(), ln_viscosity }
    }

    /// The same with surfaces that also slide across the direction of rolling, m/s, where that is not zero.
    #[inline(always)]
    pub fn sliding(self, across: T) -> Self {
        let along = self.slip - SLIP_FLOOR;
        let slip = (along * along + across * across + SLIP_FLOOR * SLIP_FLOOR).sqrt();
        let none = across.abs().at_most(0.0);
        let slip = T::select(none, self.slip, slip);
        Self { slip, ln_slip: T::select(none, self.ln_slip, slip.ln()), ..self }
    }

    /// `s^p` of the slide-to-roll ratio s.
    #[inline(always)]
    fn power_of_slide_roll(&self, p: f64) -> T {
        ((self.ln_slip - self.ln_speed) * p).exp()
    }
}

impl ThermalLoad {
    /// From beta (1/K), eta0 (Pa s) and k' (W/(m K)).
    pub fn new(temperature_viscosity: f64, viscosity: f64, conductivity: f64) -> Self {
        Self { ln_factor: math::ln(temperature_viscosity * viscosity / conductivity) }
    }

    /// ln(L_T).
    #[inline(always)]
    pub fn ln_parameter<T: Numeric>(&self, e: &Entrainment<T>) -> T {
        e.ln_speed * 2.0 + e.ln_viscosity + self.ln_factor
    }

    /// Gupta's factor T_R; `pressure` is P_max/E'. Not limited: it is negative far outside the fitted range.
    #[inline(always)]
    pub fn gupta<T: Numeric>(&self, pressure: T, e: &Entrainment<T>) -> T {
        let ln_l_t = self.ln_parameter(e);
        let slip = e.power_of_slide_roll(0.83) * 2.23 + 1.0;
        (-(pressure * (ln_l_t * 0.42).exp() * 13.2) + 1.0) / (slip * (ln_l_t * 0.64).exp() * 0.213 + 1.0)
    }

    /// 1/T_H - 1 of Ghosh and Pandey's factor T_H at ln(W).
    #[inline(always)]
    pub fn ghosh_pandey<T: Numeric>(&self, ln_load: T, e: &Entrainment<T>) -> T {
        let slip = e.power_of_slide_roll(0.96) * 3.96 + 1.0;
        (ln_load * 0.152 + self.ln_parameter(e) * 0.379).exp() * slip * 1.6
    }
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
        let material = pressure_viscosity * line.effective_modulus;
        let ln_load_factor = -math::ln(e_r * line.length);
        let ln_scale = math::ln(2.922 * line.equivalent_radius) - 0.166 * ln_load_factor
            + 0.692 * math::ln(viscosity / e_r)
            + 0.470 * math::ln(material);
        let pressure_factor = 4.0 / PI / line.effective_modulus;
        Self { ln_scale, ln_load_factor, pressure_factor, thermal, thermal_acts: 1.0 }
    }
}

impl FilmThickness {
    /// The same, evaluated beside contacts whose film has this correction.
    pub fn beside(&self, thermal: Option<ThermalCorrection>) -> Self {
        match (self.thermal, thermal) {
            (None, Some(_)) => Self { thermal, thermal_acts: 0.0, ..*self },
            (Some(_), _) | (None, None) => *self,
        }
    }
}

impl<B> FilmThickness<B> {
    /// The same with every constant of the surfaces replaced.
    #[inline(always)]
    pub fn map<U>(&self, f: &mut impl FnMut(&B) -> U) -> FilmThickness<U> {
        FilmThickness {
            ln_scale: f(&self.ln_scale),
            ln_load_factor: f(&self.ln_load_factor),
            pressure_factor: f(&self.pressure_factor),
            thermal: self.thermal,
            thermal_acts: f(&self.thermal_acts),
        }
    }
}

impl<B: Base> FilmThickness<B> {
    /// ln of the isothermal central film thickness in m at ln(Q), Q in N.
    #[inline(always)]
    pub fn ln_isothermal<T: Of<B>>(&self, ln_q: T, e: &Entrainment<T>) -> T {
        ln_q * -0.166 + (e.ln_speed + e.ln_viscosity) * 0.692 + self.ln_scale
    }

    /// ln(h_c), h_c in m, at ln(Q), Q in N; `mean_pressure` is P_mean in Pa.
    #[inline(always)]
    pub fn ln_central<T: Of<B>>(&self, ln_q: T, mean_pressure: T, e: &Entrainment<T>) -> T {
        let ln_h = self.ln_isothermal(ln_q, e);
        let corrected = match &self.thermal {
            None => return ln_h,
            Some(_) if !B::any(self.thermal_acts.above(0.5)) => return ln_h,
            Some(ThermalCorrection::GhoshPandey(load)) => {
                ln_h - load.ghosh_pandey(ln_q + self.ln_load_factor, e).ln_1p()
            }
            Some(ThermalCorrection::Gupta(load)) => {
                let pressure = mean_pressure * self.pressure_factor;
                ln_h + load.gupta(pressure, e).floored(GUPTA_FLOOR).ln()
            }
        };
        T::select(T::lift(self.thermal_acts).above(0.5), corrected, ln_h)
    }
}

impl FilmThickness {
    /// h_c/h_iso at ln(Q), Q in N, under this mean pressure (Pa); 1 without correction.
    pub fn thermal_factor(&self, ln_q: f64, mean_pressure: f64, e: &Entrainment<f64>) -> f64 {
        math::exp(self.ln_central(ln_q, mean_pressure, e) - self.ln_isothermal(ln_q, e))
    }

    /// Whether Gupta's factor is at its floor under this mean pressure (Pa): the speed and pressure are far outside of what it was
    /// fitted to.
    pub fn is_at_floor(&self, mean_pressure: f64, e: &Entrainment<f64>) -> bool {
        match &self.thermal {
            Some(ThermalCorrection::Gupta(load)) => {
                load.gupta(mean_pressure * self.pressure_factor, e) < GUPTA_FLOOR
            }
            Some(ThermalCorrection::GhoshPandey(_)) | None => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::elastic::line::effective_modulus;

    fn at(u: f64, du: f64) -> Entrainment<f64> {
        Entrainment::new(u + du / 2.0, u - du / 2.0, 0.0)
    }

    #[test]
    fn pan_hamrock_reference_values() {
        // Roller r = 8 mm, l = 24 mm, races 32 and 48 mm, 1000 N, eta0 = 0.05 Pa s, u = 6.0319 m/s.
        let e = effective_modulus(206e9, 0.3, 206e9, 0.3);
        for (re, expected) in [(6.4e-3, 1.1074e-6), (9.6e-3, 1.3420e-6)] {
            let line = ElasticLine::new(e, re, 0.024);
            let film = FilmThickness::new(&line, 0.05, 2e-8, None);
            let h = film.ln_isothermal(1000f64.ln(), &at(6.0319, 0.0)).exp();
            assert!((h / expected - 1.0).abs() < 1e-4, "{h} instead of {expected}");
        }
    }

    #[test]
    fn thermal_factors_start_at_one_and_fall_with_speed_and_slip() {
        let load = ThermalLoad::new(0.04, 0.06, 0.13);
        let ln_load = 3e-5f64.ln();
        assert!(load.ghosh_pandey(ln_load, &at(1e-3, 0.0)) < 0.01);
        assert!((load.gupta(2e-3, &at(1e-3, 0.0)) - 1.0).abs() < 1e-3);
        for f in [
            |l: &ThermalLoad, e: &Entrainment<f64>| 1.0 / (1.0 + l.ghosh_pandey(3e-5f64.ln(), e)),
            |l: &ThermalLoad, e: &Entrainment<f64>| l.gupta(2e-3, e),
        ] {
            let (slow, fast, sliding) =
                (f(&load, &at(1.0, 0.0)), f(&load, &at(20.0, 0.0)), f(&load, &at(20.0, 5.0)));
            assert!(slow < 1.0 && fast < slow && sliding < fast && sliding > 0.0);
        }
    }

    #[test]
    fn thermal_factors_match_the_formulas() {
        let load = ThermalLoad::new(0.04, 0.06, 0.13);
        let e = at(6.0, 0.3);
        let (l_t, s) = (0.04 * 0.06 / 0.13 * 36.0f64, 0.05f64);
        let h = 1.6 * 3e-5f64.powf(0.152) * l_t.powf(0.379) * (1.0 + 3.96 * s.powf(0.96));
        assert!((load.ghosh_pandey(3e-5f64.ln(), &e) / h - 1.0).abs() < 1e-10);
        let r = (1.0 - 13.2 * 2e-3 * l_t.powf(0.42))
            / (1.0 + 0.213 * (1.0 + 2.23 * s.powf(0.83)) * l_t.powf(0.64));
        assert!((load.gupta(2e-3, &e) / r - 1.0).abs() < 1e-10);
    }

    #[test]
    fn film_stays_finite_when_rolling_stops() {
        let line = ElasticLine::new(2.26e11, 6e-3, 0.02);
        let thermal = Some(ThermalCorrection::GhoshPandey(ThermalLoad::new(0.04, 0.06, 0.13)));
        let film = FilmThickness::new(&line, 0.06, 2e-8, thermal);
        let stop = at(0.0, 2.0);
        let h = film.ln_central(1000f64.ln(), 3e8, &stop).exp();
        assert!(h > 0.0 && h < 1e-9, "{h}");
        assert_eq!(stop.direction, 0.0);
    }

    #[test]
    fn the_floor_of_guptas_factor_is_told() {
        let line = ElasticLine::new(2.26e11, 6e-3, 0.02);
        let load = ThermalLoad::new(0.04, 0.06, 0.13);
        let film = FilmThickness::new(&line, 0.06, 2e-8, Some(ThermalCorrection::Gupta(load)));
        for (pressure, u) in [(1e9, 5.0), (1e9, 100.0), (3e9, 100.0), (3e9, 500.0)] {
            let e = at(u, 0.0);
            let factor = film.thermal_factor(8.0, pressure, &e);
            let told = film.is_at_floor(pressure, &e);
            assert_eq!(told, factor < GUPTA_FLOOR * 1.0001, "{pressure} {u} {factor}");
        }
        assert!(film.is_at_floor(3e9, &at(500.0, 0.0)) && !film.is_at_floor(1e9, &at(5.0, 0.0)));
        let other = FilmThickness { thermal: Some(ThermalCorrection::GhoshPandey(load)), ..film };
        assert!(!other.is_at_floor(3e9, &at(500.0, 0.0)));
    }
}
