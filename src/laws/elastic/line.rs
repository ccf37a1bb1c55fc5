//! Normal force of a line contact: Palmgren's approach, Hertz pressure; with the damping of [`super::normal`].
//!
//! ```text
//! delta = K Q^0.9,   K = 0.39 (8/E')^0.9 / l^0.8               (Palmgren)
//! b     = sqrt(8 Q R_e / (pi l E')),  P_mean = Q / (2 b l),  P_max = (4/pi) P_mean   (Hertz)
//! ```
//!
//! Valid for steel-like line contacts with b much smaller than R_e and l. Source: Sakaguchi and Ueno, NTN
//! Technical Review 71 (2004), Eq. 1 and 4.

use crate::laws::elastic::normal::{NormalDamping, NormalForce};
use crate::scalar::math;
use crate::scalar::{Base, Of};
use std::f64::consts::PI;

/// Effective modulus `E' = 2 / [(1 - nu_a^2)/E_a + (1 - nu_b^2)/E_b]` in Pa (NTN Eq. 4).
pub fn effective_modulus(young_a: f64, poisson_a: f64, young_b: f64, poisson_b: f64) -> f64 {
    2.0 / ((1.0 - poisson_a * poisson_a) / young_a + (1.0 - poisson_b * poisson_b) / young_b)
}

/// Elastic constants of one line contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticLine<B = f64> {
    /// Effective modulus E', Pa.
    pub effective_modulus: B,
    /// Equivalent radius R_e, m.
    pub equivalent_radius: B,
    /// Effective contact length l, m.
    pub length: B,
    /// Palmgren constant K, m/N^0.9.
    pub compliance: B,
    /// Its logarithm.
    ln_compliance: B,
    /// 8 R_e/(pi l E'), m^2/N.
    width_factor: B,
}

impl ElasticLine {
    /// Constants from E' (Pa), R_e (m) and effective length (m), all > 0.
    pub fn new(effective_modulus: f64, equivalent_radius: f64, length: f64) -> Self {
        let compliance = 0.39 * math::powf(8.0 / effective_modulus, 0.9) / math::powf(length, 0.8);
        let width_factor = 8.0 * equivalent_radius / (PI * length * effective_modulus);
        let ln_compliance = math::ln(compliance);
        Self { effective_modulus, equivalent_radius, length, compliance, ln_compliance, width_factor }
    }

    /// Elastic approach delta in m under the load `q` >= 0 in N.
    pub fn approach(&self, q: f64) -> f64 {
        self.compliance * math::powf(q, 0.9)
    }

    /// Elastic stiffness dQ_el/d(delta) in N/m under the load `q` > 0 in N.
    pub fn stiffness_at_load(&self, q: f64) -> f64 {
        10.0 / 9.0 * math::powf(q, 0.1) / self.compliance
    }
}

impl<B> ElasticLine<B> {
    /// The same with every constant replaced.
    #[inline(always)]
    pub fn map<U>(&self, f: &mut impl FnMut(&B) -> U) -> ElasticLine<U> {
        ElasticLine {
            effective_modulus: f(&self.effective_modulus),
            equivalent_radius: f(&self.equivalent_radius),
            length: f(&self.length),
            compliance: f(&self.compliance),
            ln_compliance: f(&self.ln_compliance),
            width_factor: f(&self.width_factor),
        }
    }
}

impl<B: Base> ElasticLine<B> {
    /// Elastic load Q_el in N at the approach `delta` in m; zero for delta <= 0.
    #[inline(always)]
    pub fn load<T: Of<B>>(&self, delta: T) -> T {
        let loaded = ((delta.ln() - self.ln_compliance) * (10.0 / 9.0)).exp();
        T::select(delta.at_most(0.0), delta.like(0.0), loaded)
    }

    /// Elastic energy at the approach `delta` (m), J: 9/19 of Q delta.
    #[inline(always)]
    pub fn energy<T: Of<B>>(&self, delta: T) -> T {
        self.load(delta) * delta * (9.0 / 19.0)
    }

    /// Normal force at the approach `delta` (m) and approach speed `delta_dot` (m/s).
    #[inline(always)]
    pub fn normal_force<T: Of<B>>(
        &self,
        damping: Option<&NormalDamping<B>>,
        delta: T,
        delta_dot: T,
    ) -> NormalForce<T> {
        let elastic = self.load(delta);
        NormalForce::new(elastic, elastic * (10.0 / 9.0) / delta, damping, delta, delta_dot)
    }

    /// Half width b of the Hertz contact in m under the load `q` > 0 in N.
    #[inline(always)]
    pub fn half_width<T: Of<B>>(&self, q: T) -> T {
        (q * self.width_factor).sqrt()
    }

    /// Mean pressure in Pa under the load `q` in N with that half width.
    #[inline(always)]
    pub fn mean_pressure<T: Of<B>>(&self, q: T, half_width: T) -> T {
        q / (half_width * self.length * 2.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Dual;

    fn steel(radius: f64) -> ElasticLine {
        ElasticLine::new(effective_modulus(206e9, 0.3, 206e9, 0.3), radius, 0.024)
    }

    #[test]
    fn hertz_line_reference_values() {
        // Roller r = 8 mm on an inner race of 32 mm and an outer race of 48 mm, 1000 N on 24 mm.
        for (re, b, p) in [(6.4e-3, 54.770e-6, 484.31e6), (9.6e-3, 67.079e-6, 395.44e6)] {
            let c = steel(re);
            let half_width = c.half_width(1000.0);
            let p_max = 4.0 / PI * 1000.0 / (2.0 * half_width * c.length);
            assert!((half_width / b - 1.0).abs() < 1e-5, "b = {half_width}");
            assert!((p_max / p - 1.0).abs() < 1e-5, "p = {p_max}");
        }
    }

    #[test]
    fn palmgren_reference_value_and_steel_constant() {
        let c = steel(6.4e-3);
        assert!((c.effective_modulus / 226.3736e9 - 1.0).abs() < 1e-6);
        assert!((c.approach(1000.0) / 1.51472e-6 - 1.0).abs() < 1e-5, "{}", c.approach(1000.0));
        // The catalogue form for steel: 3.84e-5 Q^0.9 / l^0.8 in N and mm.
        let catalogue = 3.84e-5 * 1000f64.powf(0.9) / 24f64.powf(0.8) * 1e-3;
        assert!((c.approach(1000.0) / catalogue - 1.0).abs() < 5e-3);
    }

    #[test]
    fn load_inverts_approach() {
        let c = steel(6.4e-3);
        for q in [1e-3, 1.0, 4900.0, 2e5] {
            assert!((c.load(c.approach(q)) / q - 1.0).abs() < 1e-13);
            let slope = c.load(Dual::<1>::variable(c.approach(q), 0)).eps[0];
            assert!((slope / c.stiffness_at_load(q) - 1.0).abs() < 1e-12);
        }
        assert_eq!(c.load(-1e-6), 0.0);
    }

    #[test]
    fn force_starts_continuously_and_never_pulls() {
        let c = steel(6.4e-3);
        let d = NormalDamping { relaxation_time: 5e-7, softening_depth: 1e-8 };
        for speed in [-1.0, 0.0, 1.0] {
            let touch = c.normal_force(Some(&d), 1e-14, speed).force;
            assert!((0.0..0.02).contains(&touch), "{touch} at {speed}");
        }
        assert_eq!(c.normal_force(Some(&d), 1e-7, -10.0).force, 0.0);
        assert!(c.normal_force(Some(&d), f64::NAN, 0.0).force.is_nan());
        let still = c.normal_force(Some(&d), 1e-6, 0.0).force;
        assert!(c.normal_force(Some(&d), 1e-6, 0.1).force > still);
        assert_eq!(still, c.normal_force(None, 1e-6, 0.1).force);
    }
}
