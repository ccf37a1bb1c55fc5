//! Drag of the oil that is sheared in the inlet of a line contact whose surfaces slip.
//!
//! ```text
//! F_S   = kappa F_R |u_1 - u_2|/|u|                         against the slip, on both surfaces
//! kappa = kappa_E + (kappa_I - kappa_E) / (1 + (Q/Q_t)^2)
//! rigid surfaces, h = h_0 + x^2/2R:        F_R = 4.60 eta0 u sqrt(R/h_0),  F_S = 2.85 eta0 du sqrt(R/h_0):  kappa_I = 0.6191
//! elastic surfaces, h = h_c (1 + t^1.5):                                                                    kappa_E = 0.25
//! ```
//!
//! Rolling resistance is the shear of the pressure flow of the inlet, this that of its Couette flow. Traction acts within the Hertz
//! zone only, which is next to nothing in a contact without load; there this drag alone keeps a roller from being braked past
//! zero. Both flows are those of one film, so their ratio is a number: from Reynolds' equation for a rigid cylinder that is
//! fully flooded and whose film ruptures where pressure and its gradient vanish, and for the inlet of an elastohydrodynamic
//! contact. The passage between both by the load is that of [`super::RigidLimit`], with its Q_t. Neither paper has this drag.

use super::{RollingFilm, ln_passage};
use crate::laws::film::thickness::Entrainment;
use crate::scalar::{Base, Of};

/// kappa of rigid surfaces.
pub const RIGID_RATIO: f64 = 0.6191;
/// kappa of elastic surfaces.
pub const ELASTIC_RATIO: f64 = 0.25;

/// Constants of the drag.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InletSliding<B = f64> {
    /// kappa_E.
    pub elastic_ratio: f64,
    /// kappa_I.
    pub rigid_ratio: f64,
    /// ln Q_t at |u| = 1 m/s, of Q_t in N.
    pub ln_passage: B,
}

impl InletSliding {
    /// From film and surfaces and both ratios.
    pub fn new(film: &RollingFilm<'_>, rigid_ratio: f64, elastic_ratio: f64) -> Self {
        Self { elastic_ratio, rigid_ratio, ln_passage: ln_passage(film) }
    }
}

impl<B> InletSliding<B> {
    /// The same with every constant of the surfaces replaced.
    #[inline(always)]
    pub fn map<U>(&self, f: &mut impl FnMut(&B) -> U) -> InletSliding<U> {
        InletSliding {
            elastic_ratio: self.elastic_ratio,
            rigid_ratio: self.rigid_ratio,
            ln_passage: f(&self.ln_passage),
        }
    }
}

impl<B: Base> InletSliding<B> {
    /// kappa under the load of which ln is `ln_q`.
    #[inline(always)]
    pub fn ratio<T: Of<B>>(&self, ln_q: T, e: &Entrainment<T>) -> T {
        let ln_flow = e.ln_speed + e.ln_viscosity;
        let square = ((ln_q - ln_flow * (1.0 / 3.0) - self.ln_passage) * 2.0).exp();
        ln_q.like(self.rigid_ratio - self.elastic_ratio) / (square + 1.0) + self.elastic_ratio
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::elastic::line::ElasticLine;
    use crate::scalar::math;
    use std::f64::consts::{FRAC_PI_2, PI};

    /// Midpoint sum of `f` from `a` to `b`.
    fn integral(f: impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
        let n = 20_000;
        let h = (b - a) / f64::from(n);
        (0..n).map(|i| f(a + (f64::from(i) + 0.5) * h) * h).sum()
    }

    fn law() -> InletSliding {
        let line = ElasticLine::new(2.263736e11, 6.4e-3, 0.024);
        let film = RollingFilm { line: &line, viscosity: 0.05, pressure_viscosity: 2e-8 };
        InletSliding::new(&film, RIGID_RATIO, ELASTIC_RATIO)
    }

    #[test]
    fn both_ratios_are_those_of_one_film() {
        // X = x/sqrt(2 R h_0) = tan(a), exit at X = c where the pressure vanishes; forces over eta0 sqrt(R/h_0).
        let load = |c: f64| {
            integral(|a| (a.sin().powi(2) - (c * a.cos()).powi(2)) * a.cos().powi(2), -FRAC_PI_2, c.atan())
        };
        let (mut low, mut high) = (0.1, 1.0);
        for _ in 0..60 {
            let c = 0.5 * (low + high);
            if load(c) > 0.0 { low = c } else { high = c }
        }
        let root = 2f64.sqrt();
        let rolling =
            6.0 * root * integral(|a| a.sin().powi(2) - (low * a.cos()).powi(2), -FRAC_PI_2, low.atan());
        let sliding = root * integral(|_| 1.0, -FRAC_PI_2, low.atan());
        assert!((rolling - 4.601_077).abs() < 1e-6 && (sliding - 2.848_722).abs() < 1e-6);
        assert!((sliding / rolling - RIGID_RATIO).abs() < 1e-4);
        // Elastic: shear Int dt/H and pressure flow 6 Int (H - 1)/H^2 dt with H = 1 + t^1.5, t = tan(a)^2 from 0 to infinity.
        let film = |t: f64| 1.0 + t.powf(1.5);
        let over = |f: &dyn Fn(f64) -> f64| {
            integral(|a| f(a.tan().powi(2)) * 2.0 * a.tan() / a.cos().powi(2), 0.0, FRAC_PI_2)
        };
        let shear = over(&|t| 1.0 / film(t));
        let flow = 6.0 * over(&|t| t.powf(1.5) / film(t).powi(2));
        assert!((shear - PI / 1.5 / (PI / 1.5).sin()).abs() < 1e-6, "{shear}");
        assert!((shear / flow - ELASTIC_RATIO).abs() < 1e-6, "{}", shear / flow);
    }

    #[test]
    fn it_falls_with_the_load_from_one_limit_to_the_other() {
        let e = Entrainment::new(6.0, 6.0, 0.0);
        let at = |q: f64| law().ratio(math::ln(q), &e);
        assert!((at(1e-3) - RIGID_RATIO).abs() < 1e-6 && (at(1e6) - ELASTIC_RATIO).abs() < 1e-6);
        for i in 0..200 {
            let q = 1e-3 * 1.1f64.powi(i);
            assert!(at(1.1 * q) <= at(q));
        }
    }

    #[test]
    fn a_free_roller_without_load_is_dragged_along() {
        // Its moment vanishes where kappa (u_2 - u_1) = (u_1 + u_2)/2.
        let (mut low, mut high) = (-1.0, 1.0);
        for _ in 0..60 {
            let u_1 = 0.5 * (low + high);
            let e = Entrainment::new(u_1, 1.0, 0.0);
            let moment = law().ratio(math::ln(1e-3), &e) * (1.0 - u_1) / e.speed - 1.0;
            if moment > 0.0 { low = u_1 } else { high = u_1 }
        }
        let expected = (RIGID_RATIO - 0.5) / (RIGID_RATIO + 0.5);
        assert!((low - expected).abs() < 1e-6 && low > 0.1, "{low}");
    }
}
