//! Rolling resistance of a lubricated point contact.
//!
//! ```text
//! Houpert            F = 2.86 E' R_x^2 k_g^0.348 G^0.022 U^0.66 W^0.47
//! Biboulet-Houpert   F = F_E + (F_I - F_E)/(1 + M/6.6),   M = W k_g^(1/4) U^(-3/4)
//!                    F_I = 2.9766 E' R_x^2 k_g^0.3316 W^(1/3) U^(2/3)            rigid surfaces, constant viscosity
//!                    F_E = 7.5826 E' R_x^2 k_g^0.4055 W^(1/3) U^(3/4)            elastic surfaces
//! U = eta0 |u|/(E' R_x),  G = alpha E',  W = Q/(E' R_x^2),  R_x = 1/rho_t,  k_g = rho_t/rho_l
//! ```
//!
//! The force acts on both surfaces against the rolling speed u. Houpert's law is fitted to loaded contacts and gives 3 to 13 times less below 10 N.
//! The rigid branch of the other has the right size there; its limit at no load, F/Q ~ Q^(-2/3), is wrong, so [`super::Extent::Loaded`] may
//! leave light contacts out. Sources: Houpert 1987; Biboulet and Houpert, Proc. IMechE J 224 (2010).

use crate::laws::elastic::point::ElasticPoint;
use crate::laws::film::thickness::Entrainment;
use crate::scalar::{Numeric, math};

/// M at which both branches count the same.
const PASSAGE: f64 = 6.6;

/// A power of speed and load: ln F = ln scale + p ln U + q ln Q.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Power {
    ln_scale: f64,
    of_speed: f64,
    of_load: f64,
}

impl Power {
    #[inline(always)]
    fn at<T: Numeric>(&self, ln_q: T, e: &Entrainment<T>) -> T {
        ((e.ln_speed + e.ln_viscosity) * self.of_speed + ln_q * self.of_load + self.ln_scale).exp()
    }
}

/// One of the laws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointRolling {
    elastic: Power,
    /// F_I and M, with the passage from one branch to the other.
    rigid: Option<[Power; 2]>,
}

impl PointRolling {
    /// From the elastic contact, eta0 (Pa s) and alpha (1/Pa).
    pub fn houpert(point: &ElasticPoint, viscosity: f64, pressure_viscosity: f64) -> Self {
        let material = math::powf(pressure_viscosity * point.effective_modulus, 0.022);
        Self { elastic: power(point, viscosity, [2.86 * material, 0.348, 0.66, 0.47]), rigid: None }
    }

    /// From the elastic contact and eta0 (Pa s).
    pub fn biboulet_houpert(point: &ElasticPoint, viscosity: f64) -> Self {
        let third = 1.0 / 3.0;
        let rigid = power(point, viscosity, [2.9766, 0.3316, 2.0 * third, third]);
        let elastic = power(point, viscosity, [7.5826, 0.4055, 0.75, third]);
        let mut passage = power(point, viscosity, [1.0 / PASSAGE, 0.25, -0.75, 1.0]);
        passage.ln_scale -= math::ln(size(point));
        Self { elastic, rigid: Some([rigid, passage]) }
    }

    /// F in N under the load of which ln is `ln_q` (N).
    #[inline(always)]
    pub fn force<T: Numeric>(&self, ln_q: T, e: &Entrainment<T>) -> T {
        let elastic = self.elastic.at(ln_q, e);
        match &self.rigid {
            None => elastic,
            Some([rigid, passage]) => elastic + (rigid.at(ln_q, e) - elastic) / (passage.at(ln_q, e) + 1.0),
        }
    }
}

/// E' R_x^2, N.
fn size(point: &ElasticPoint) -> f64 {
    point.effective_modulus / (point.curvatures[0] * point.curvatures[0])
}

/// factor E' R_x^2 k_g^g U^u W^w.
fn power(point: &ElasticPoint, viscosity: f64, [factor, g, u, w]: [f64; 4]) -> Power {
    let [across, along] = point.curvatures;
    let ln_scale = math::ln(factor * size(point))
        + g * math::ln(across / along)
        + u * math::ln(viscosity * across / point.effective_modulus)
        - w * math::ln(size(point));
    Power { ln_scale, of_speed: u, of_load: w }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::elastic::line::effective_modulus;

    fn point() -> ElasticPoint {
        let modulus = effective_modulus(206e9, 0.3, 206e9, 0.3);
        ElasticPoint::new(modulus, [110.0, 4.0]).unwrap()
    }

    #[test]
    fn they_are_the_formulas() {
        let (point, viscosity, speed) = (point(), 0.03, 12.0);
        let (e, r, k) = (point.effective_modulus, 1.0 / 110.0_f64, 110.0_f64 / 4.0);
        let rolling = Entrainment::new(speed, speed, 0.0);
        for q in [0.1_f64, 3.0, 40.0, 2000.0] {
            let (u, w, g): (f64, f64, f64) = (viscosity * speed / (e * r), q / (e * r * r), 2e-8 * e);
            let houpert = 2.86 * e * r * r * k.powf(0.348) * g.powf(0.022) * u.powf(0.66) * w.powf(0.47);
            let found = PointRolling::houpert(&point, viscosity, 2e-8).force(q.ln(), &rolling);
            assert!((found / houpert - 1.0).abs() < 1e-10, "{found} {houpert}");
            let rigid = 2.9766 * e * r * r * k.powf(0.3316) * w.cbrt() * u.powf(2.0 / 3.0);
            let elastic = 7.5826 * e * r * r * k.powf(0.4055) * w.cbrt() * u.powf(0.75);
            let m = w * k.powf(0.25) * u.powf(-0.75);
            let both = elastic + (rigid - elastic) / (1.0 + m / 6.6);
            let found = PointRolling::biboulet_houpert(&point, viscosity).force(q.ln(), &rolling);
            assert!((found / both - 1.0).abs() < 1e-10, "{found} {both}");
        }
    }
}
