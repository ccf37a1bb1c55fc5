//! Normal force of a point contact: Hertz's ellipse with exact elliptic integrals, contact damping.
//!
//! ```text
//! s = rho_t + rho_l
//! [(k^2 + 1) E - 2 F]/[(k^2 - 1) E] = (rho_t - rho_l)/s,   k = a/b,  modulus m = 1 - 1/k^2
//! c     = (3/(2 s)) (2/E')
//! a     = (2 k^2 E c Q/pi)^(1/3),   b = a/k
//! delta = (2 F/pi) [pi/(2 k^2 E)]^(1/3) (c Q)^(2/3) s/2,   so that Q_el = K delta^1.5
//! Q     = max(0, Q_el + tau_c s_d(delta) dQ_el/d(delta) delta_dot),   s_d = delta/(delta + delta_s)
//! p_0   = 3 Q/(2 pi a b)
//! ```
//!
//! rho_t >= rho_l > 0 are the sums of the curvatures of both bodies in two planes at right angles; the long half axis a lies
//! in the plane of rho_l. F and E are the complete elliptic integrals of the first and second kind. Valid for bodies that are
//! smooth, elastic and much larger than the ellipse. Source: Hertz 1882, as in Harris and Kotzalas, Rolling Bearing Analysis,
//! ch. 6. K is constant: with one that follows the contact angle the force would have no potential. Damping is that of
//! [`super::normal`].

use crate::laws::elastic::normal::{NormalDamping, NormalForce};
use crate::scalar::{Base, Of, math};
use std::f64::consts::PI;

/// Largest k that is looked for, far beyond any ellipse of a bearing.
const LARGEST_RATIO: f64 = 1e6;
/// Difference of the principal curvatures, as a share of their sum, below which round-off hides that the ellipse is no circle.
const CIRCLE: f64 = 1e-8;

/// Elastic constants of one point contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticPoint<B = f64> {
    /// Effective modulus E', Pa, as of line contacts.
    pub effective_modulus: B,
    /// rho_t and rho_l, 1/m.
    pub curvatures: [B; 2],
    /// k = a/b.
    pub ellipticity: B,
    /// K, N/m^1.5.
    pub rigidity: B,
    /// Half axes a and b under 1 N, m.
    pub unit_axes: [B; 2],
}

/// Complete elliptic integrals F and E, and (F - E)/F, of the modulus m = 1 - 1/k^2 by the arithmetic-geometric mean.
fn elliptic_integrals(k: f64) -> [f64; 3] {
    let (mut a, mut b) = (1.0, 1.0 / k);
    let (mut sum, mut weight) = (0.5 * (1.0 - b * b), 0.5);
    loop {
        let c = 0.5 * (a - b);
        weight *= 2.0;
        sum += weight * c * c;
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        if c <= 1e-9 * a {
            // The next difference is of the order of c^2.
            let first = PI / (a + b);
            return [first, first * (1.0 - sum), sum];
        }
    }
}

/// (rho_t - rho_l)/s of an ellipse of this k > 1: 1 - 2 (F - E)/[(k^2 - 1) E], without the differences of large numbers.
fn difference(k: f64) -> f64 {
    let [first, second, share] = elliptic_integrals(k);
    1.0 - 2.0 * first * share / ((k - 1.0) * (k + 1.0) * second)
}

impl ElasticPoint {
    /// Constants from E' (Pa) and the sums rho_t, rho_l of the curvatures (1/m); `None` unless E' > 0 and rho_t >= rho_l > 0
    /// and the ellipse is less than a million times as long as it is wide.
    pub fn new(effective_modulus: f64, curvatures: [f64; 2]) -> Option<Self> {
        let [across, along] = curvatures;
        let sum = across + along;
        let wanted = (across - along) / sum;
        let sound =
            effective_modulus > 0.0 && along > 0.0 && (0.0..=difference(LARGEST_RATIO)).contains(&wanted);
        if !sound || !sum.is_finite() {
            return None;
        }
        let k = if wanted < CIRCLE { 1.0 } else { ratio_of(wanted) };
        let [first, second, _] = elliptic_integrals(k);
        let c = 3.0 / (sum * effective_modulus);
        let long = math::powf(2.0 * k * k * second * c / PI, 1.0 / 3.0);
        let approach =
            2.0 * first / PI * math::powf(PI / (2.0 * k * k * second), 1.0 / 3.0) * math::powf(c, 2.0 / 3.0);
        let rigidity = math::powf(0.5 * sum * approach, -1.5);
        Some(Self { effective_modulus, curvatures, ellipticity: k, rigidity, unit_axes: [long, long / k] })
    }

    /// Elastic approach delta in m under the load `q` >= 0 in N.
    pub fn approach(&self, q: f64) -> f64 {
        math::powf(q / self.rigidity, 2.0 / 3.0)
    }
}

/// k of the ellipse whose curvatures differ by this share of their sum, found where its logarithm is bracketed.
fn ratio_of(wanted: f64) -> f64 {
    let (mut low, mut high) = (0.0, math::ln(LARGEST_RATIO));
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return math::exp(high);
        }
        let below = difference(math::exp(middle)) < wanted;
        (low, high) = if below { (middle, high) } else { (low, middle) };
    }
}

impl<B> ElasticPoint<B> {
    /// The same with every constant replaced.
    #[inline(always)]
    pub fn map<U>(&self, f: &mut impl FnMut(&B) -> U) -> ElasticPoint<U> {
        let [across, along] = &self.curvatures;
        let [long, short] = &self.unit_axes;
        ElasticPoint {
            effective_modulus: f(&self.effective_modulus),
            curvatures: [f(across), f(along)],
            ellipticity: f(&self.ellipticity),
            rigidity: f(&self.rigidity),
            unit_axes: [f(long), f(short)],
        }
    }
}

impl<B: Base> ElasticPoint<B> {
    /// Elastic load Q_el in N at the approach `delta` in m; zero for delta <= 0.
    #[inline(always)]
    pub fn load<T: Of<B>>(&self, delta: T) -> T {
        let loaded = delta * delta.sqrt() * self.rigidity;
        T::select(delta.at_most(0.0), delta.like(0.0), loaded)
    }

    /// Normal force at the approach `delta` (m) and approach speed `delta_dot` (m/s).
    #[inline(always)]
    pub fn normal_force<T: Of<B>>(
        &self,
        damping: Option<&NormalDamping<B>>,
        delta: T,
        delta_dot: T,
    ) -> NormalForce<T> {
        NormalForce::new(self.load(delta), delta.sqrt() * self.rigidity * 1.5, damping, delta, delta_dot)
    }

    /// Half axes a and b of the ellipse in m under the load `q` > 0 in N, of which ln is `ln_q`.
    #[inline(always)]
    pub fn half_axes<T: Of<B>>(&self, ln_q: T) -> [T; 2] {
        let root = (ln_q * (1.0 / 3.0)).exp();
        let [long, short] = self.unit_axes;
        [root * long, root * short]
    }

    /// Largest pressure p_0 in Pa under the load `q` in N on the ellipse with these half axes (m).
    #[inline(always)]
    pub fn largest_pressure<T: Of<B>>(&self, q: T, [long, short]: [T; 2]) -> T {
        q * (1.5 / PI) / (long * short)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::elastic::line::effective_modulus;
    use crate::scalar::Dual;

    fn steel() -> f64 {
        effective_modulus(206e9, 0.3, 206e9, 0.3)
    }

    /// Ball and race of a 218 angular contact bearing at 40 degrees: inner where `side` is 1, outer where it is -1.
    fn race_of_218(side: f64) -> ElasticPoint {
        let (ball, pitch, groove, angle) =
            (22.23e-3 / 2.0, 125.26e-3 / 2.0, 0.5232 * 22.23e-3, 40f64.to_radians());
        let of_race = side * angle.cos() / (pitch - side * ball * angle.cos());
        ElasticPoint::new(steel(), [1.0 / ball + of_race, 1.0 / ball - 1.0 / groove]).unwrap()
    }

    #[test]
    fn integrals_have_the_values_of_tables() {
        // Modulus 1/2: Abramowitz and Stegun, table 17.1.
        let [first, second, share] = elliptic_integrals(2f64.sqrt());
        assert!((first / 1.854_074_677_301_371_9 - 1.0).abs() < 1e-15, "{first}");
        assert!((second / 1.350_643_881_047_675_5 - 1.0).abs() < 1e-15, "{second}");
        assert!(((first - second) / first - share).abs() < 1e-15);
        assert!(
            elliptic_integrals(1.0).iter().zip([PI / 2.0, PI / 2.0, 0.0]).all(|(x, y)| (x - y).abs() < 1e-15)
        );
        // Long ellipses: F = ln 4k, E = 1 to the order of (ln k)/k^2.
        let [first, second, _] = elliptic_integrals(1e6);
        assert!((first - 4e6f64.ln()).abs() < 1e-10 && (second - 1.0).abs() < 1e-10, "{first} {second}");
    }

    #[test]
    fn a_bearing_of_the_textbook() {
        let (inner, outer) = (race_of_218(1.0), race_of_218(-1.0));
        for (found, expected) in [
            (inner.rigidity, 4.070593e10),
            (outer.rigidity, 4.234197e10),
            (inner.ellipticity, 8.1554),
            (outer.ellipticity, 6.8972),
            (inner.unit_axes[1], 2.138835e-5),
        ] {
            assert!((found / expected - 1.0).abs() < 1e-5, "{found} instead of {expected}");
        }
    }

    #[test]
    fn a_ball_on_a_plane_is_a_circle() {
        // a^3 = 3 Q R/(2 E'), delta = a^2/R with E' = 2 E/(1 - nu^2) of equal bodies.
        let (radius, q) = (5e-3, 40.0_f64);
        let point = ElasticPoint::new(steel(), [1.0 / radius; 2]).unwrap();
        let [long, short] = point.half_axes(q.ln());
        let expected = (1.5 * q * radius / steel()).cbrt();
        assert!((long / expected - 1.0).abs() < 1e-14 && long == short, "{long} {short} {expected}");
        assert!((point.approach(q) / (expected * expected / radius) - 1.0).abs() < 1e-14);
        assert!(
            (point.largest_pressure(q, [long, short]) / (1.5 * q / (PI * expected * expected)) - 1.0).abs()
                < 1e-14
        );
    }

    #[test]
    fn the_ellipse_is_continuous_at_the_circle_and_symmetric_in_scale() {
        for share in [0.0, 1e-13, 1e-11, 1e-9, 1e-6, 1e-3] {
            let near = ElasticPoint::new(steel(), [100.0 * (1.0 + share), 100.0]).unwrap();
            // The difference is 3/8 (k^2 - 1) of the sum, to first order.
            let expected = 1.0 + 2.0 / 3.0 * share;
            assert!(
                (near.ellipticity - expected).abs() < 3e-8 + share * share,
                "{share}: {}",
                near.ellipticity
            );
        }
        let (one, ten) = (
            race_of_218(1.0),
            ElasticPoint::new(steel(), race_of_218(1.0).curvatures.map(|x| 10.0 * x)).unwrap(),
        );
        assert!((one.ellipticity / ten.ellipticity - 1.0).abs() < 1e-13);
    }

    #[test]
    fn curvatures_follow_from_the_ellipse() {
        for wanted in [1e-6, 0.01, 0.3, 0.9, 0.98, 0.999, 0.999_999] {
            let k = ratio_of(wanted);
            assert!(
                (difference(k) - wanted).abs() < 1e-14 + 1e-9 * (1.0 - wanted),
                "{wanted} {k} {}",
                difference(k)
            );
        }
    }

    #[test]
    fn what_is_no_ellipse_is_refused() {
        for curvatures in
            [[90.0, 0.0], [90.0, -1.0], [10.0, 90.0], [f64::NAN, 1.0], [f64::INFINITY, 1.0], [1e9, 1e-9]]
        {
            assert_eq!(ElasticPoint::new(steel(), curvatures), None, "{curvatures:?}");
        }
        assert_eq!(ElasticPoint::new(0.0, [90.0, 2.0]), None);
    }

    #[test]
    fn load_inverts_approach_and_force_never_pulls() {
        let point = race_of_218(1.0);
        for q in [1e-3, 1.0, 1679.0, 2e5] {
            let delta = point.approach(q);
            let load = point.load(Dual::<1>::variable(delta, 0));
            assert!((load.re / q - 1.0).abs() < 1e-13);
            let normal = point.normal_force(None, delta, 0.0);
            assert!((load.eps[0] / normal.stiffness - 1.0).abs() < 1e-12);
            assert!((normal.stiffness * delta / (1.5 * q) - 1.0).abs() < 1e-12);
        }
        let damping = NormalDamping { relaxation_time: 5e-7, softening_depth: 1e-8 };
        for speed in [-1.0, 0.0, 1.0] {
            let touch = point.normal_force(Some(&damping), 1e-14, speed).force;
            assert!((0.0..0.02).contains(&touch), "{touch} at {speed}");
        }
        assert_eq!(point.normal_force(Some(&damping), 1e-7, -10.0).force, 0.0);
        assert_eq!(point.normal_force(Some(&damping), -1e-6, 1.0).force, 0.0);
        assert!(point.normal_force(Some(&damping), f64::NAN, 0.0).force.is_nan());
    }
}
