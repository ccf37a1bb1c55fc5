//! Film force of a filled guide clearance: short journal bearing with squeeze and roundness.
//!
//! ```text
//! h(th) = c - (y cos th + z sin th) - Sum_{n>=2} a_n cos(n (th - psi) + b_n)
//! g(th) = (1/h^3) [((w_1 + w_2)/2) dh/dth + dh/dt],   kept only where g < 0 (Guembel)
//! (F_y, F_z) = 2 eta0 R l^3 Int g (cos th, sin th) dth                          (two lands of width l)
//! M = -4 pi eta0 (w_1 - w_2) R^3 l / (c sqrt(1 - eps^2)) + 1/2 Int p dh/dth dA - M_lobes
//! ```
//!
//! c radial clearance, (y, z) centre of the journal in the bush, w_1 and w_2 speeds of journal and bush, psi angle of
//! the profile, dh/dt with the profile turning. Valid for l/(2R) up to about 0.25, laminar isoviscous
//! film. The moment of sliding uses the full film although the pressure is cut, as the paper does. That of the pressure, half
//! on each side, and on the lobes of a profile, Int p dw/dth dA on the body that carries them, is `pressure_moment`: without it,
//! as in the paper, the film puts energy into a journal that whirls fast enough far off the centre. Source: NTN Eq. 13-21,
//! there for a bush at rest.
//!
//! With Sommerfeld's substitution cos b = (cos g + eps)/(1 + eps cos g) the integrals of a round cage are
//! elementary, so its force is exact. With roundness the same substitution places the quadrature nodes where the
//! film is thin, and a panel in which g changes sign ends there. Two changes within one panel go unseen; panels are
//! narrow enough that this costs less than 1e-3 of the force, and usually 1e-9.

use crate::laws::fluid::Fluid;
use crate::laws::guide::journal::{FilmForce, Harmonic, JournalMotion, NoFilm};
use crate::laws::guide::layer_gap::change;
use crate::scalar::Real;
use crate::scalar::math;
use std::f64::consts::{PI, TAU};

/// A film thinner than this share of the clearance counts as gone: less than a molecule in any real guide, and too
/// thin for the closed form, whose terms then cancel.
const THINNEST_FILM: f64 = 1e-6;

/// Short journal bearing with two lands.
#[derive(Clone, Debug, PartialEq)]
pub struct ShortBearing {
    /// eta0, Pa s.
    pub viscosity: f64,
    /// R, radius of the journal, m.
    pub radius: f64,
    /// c, radial clearance, m.
    pub clearance: f64,
    /// l, width of one of the two lands, m.
    pub land_width: f64,
    /// Whether dh/dt is included.
    pub squeeze: bool,
    /// Whether the moment is that of the pressure, too; with it and the squeeze the film dissipates at every motion.
    pub pressure_moment: bool,
    /// Roundness; empty for round surfaces.
    pub roundness: Vec<Harmonic>,
    /// Whether the journal carries it, and not the bush.
    pub profile_on_journal: bool,
}

/// Eccentricity in polar form; the direction is arbitrary (+y) when the cage is centred.
struct Eccentricity<T> {
    ratio: T,
    direction: [T; 2],
}

impl ShortBearing {
    /// Film force on the journal, or [`NoFilm`] where h <= 0.
    pub fn force<T: Real>(&self, m: &JournalMotion<T>, fluid: Fluid) -> Result<FilmForce<T>, NoFilm> {
        let viscosity = self.viscosity * fluid.relative_viscosity;
        let e = self.eccentricity(m);
        let film = (-e.ratio + 1.0) * self.clearance;
        // Written so that a NaN counts as no film. A profile can only be thinner in places; it checks itself.
        let exists = film.value() > THINNEST_FILM * self.clearance;
        if !exists {
            return Err(NoFilm { minimum_film: film.value() });
        }
        let (force, slopes, minimum_film) = if self.roundness.is_empty() {
            let force = self.round_force(m, &e, viscosity);
            (force, eccentric(m.position, force), film)
        } else {
            self.profile_force(m, &e, viscosity)?
        };
        let scale = -4.0 * PI * viscosity * self.radius.powi(3) * self.land_width / self.clearance;
        let mut moment = (m.journal_speed - m.bush_speed) * scale / one_minus_square(e.ratio).sqrt();
        if self.pressure_moment {
            moment += slopes * 0.5;
            if self.profile_on_journal {
                moment -= slopes - eccentric(m.position, force);
            }
        }
        Ok(FilmForce { pressure: force, shear: [T::constant(0.0); 2], moment, minimum_film })
    }

    #[inline]
    fn eccentricity<T: Real>(&self, m: &JournalMotion<T>) -> Eccentricity<T> {
        let [y, z] = m.position;
        let r2 = y * y + z * z;
        // Below this, squares lose digits to underflow and the direction would not be a unit vector.
        if r2.value() < 1e-280 {
            let direction = [T::constant(1.0), T::constant(0.0)];
            return Eccentricity { ratio: y / self.clearance, direction };
        }
        let r = r2.sqrt();
        Eccentricity { ratio: r / self.clearance, direction: [y / r, z / r] }
    }

    #[inline]
    fn force_scale(&self, viscosity: f64) -> f64 {
        2.0 * viscosity * self.radius * self.land_width.powi(3)
    }

    /// Exact force of a round cage. With b measured from the thinnest film, g = (A sin b + B cos b)/(c^2 (1 - eps cos b)^3)
    /// is negative on a half circle whose ends are mapped by Sommerfeld's substitution.
    fn round_force<T: Real>(&self, m: &JournalMotion<T>, e: &Eccentricity<T>, viscosity: f64) -> [T; 2] {
        let [dy, dz] = e.direction;
        let (mut a, mut b) = ((m.journal_speed + m.bush_speed) * e.ratio * 0.5, T::constant(0.0));
        if self.squeeze {
            let [vy, vz] = m.velocity;
            a -= (vz * dy - vy * dz) / self.clearance;
            b -= (vy * dy + vz * dz) / self.clearance;
        }
        let n2 = a * a + b * b;
        if n2.value() == 0.0 {
            return [T::constant(0.0); 2];
        }
        let n = n2.sqrt();
        let (sin_m, cos_m) = (a / n, b / n);
        let q2 = one_minus_square(e.ratio);
        let q = q2.sqrt();
        // Both ends: the distances from the origin of the points that they are angles of are 1 +- eps sin_m.
        let (near, far) = (e.ratio * sin_m + 1.0, -(e.ratio * sin_m) + 1.0);
        let (s0, c0) = (q * cos_m / near, -(sin_m + e.ratio) / near);
        let (s1, c1) = (-(q * cos_m) / far, (sin_m - e.ratio) / far);
        let mut span = (s1 * c0 - c1 * s0).atan2(c1 * c0 + s1 * s0);
        if span.value() < 0.0 {
            span = span + TAU;
        }
        let sin_sin = (span - (s1 * c1 - s0 * c0)) * 0.5;
        let cos_cos =
            (span + (s1 * c1 - s0 * c0)) * 0.5 + e.ratio * (s1 - s0) * 2.0 + e.ratio * e.ratio * span;
        let sin_cos = (s1 * s1 - s0 * s0) * 0.5 - e.ratio * (c1 - c0);
        // Integrals of sin^2, sin cos and cos^2 over (1 - eps cos b)^3.
        let i_ss = sin_sin / (q2 * q);
        let i_sc = sin_cos / (q2 * q2);
        let i_cc = cos_cos / (q2 * q2 * q);
        let scale = self.force_scale(viscosity) / self.clearance.powi(2);
        let radial = (a * i_sc + b * i_cc) * scale;
        let tangential = (a * i_ss + b * i_sc) * scale;
        [radial * dy - tangential * dz, radial * dz + tangential * dy]
    }

    /// Force with a roundness profile, the integral of p dh/dtheta in N m, and the thinnest film, by Gauss quadrature on panels between the sign changes of g.
    fn profile_force<T: Real>(
        &self,
        m: &JournalMotion<T>,
        e: &Eccentricity<T>,
        viscosity: f64,
    ) -> Result<([T; 2], T, T), NoFilm> {
        let highest = self.roundness.iter().map(|a| a.order).max().unwrap_or(2) as usize;
        // The substitution widens panels on the far side by up to (1 + eps)/q.
        let q = one_minus_square(e.ratio.value()).sqrt();
        let panels = (16 + 8 * highest) * (1.0 / q).ceil().min(8.0) as usize;
        let width = TAU / panels as f64;
        let plain = JournalMotion {
            position: m.position.map(Real::value),
            velocity: m.velocity.map(Real::value),
            journal_speed: m.journal_speed.value(),
            bush_speed: m.bush_speed.value(),
            profile_angle: m.profile_angle.value(),
            profile_speed: m.profile_speed.value(),
        };
        let plain_e = Eccentricity { ratio: e.ratio.value(), direction: e.direction.map(Real::value) };
        let rate = |gamma: f64| self.profile_node(&plain, &plain_e, gamma).rate;
        let mut sum = [T::constant(0.0); 3];
        let mut thinnest = T::constant(f64::INFINITY);
        let mut thinnest_at = 0.0;
        let mut visit = |gamma: f64| {
            let node = self.profile_node(m, e, gamma);
            if node.film.value() < thinnest.value() || node.film.value().is_nan() {
                (thinnest, thinnest_at) = (node.film, gamma);
            }
            node
        };
        let mut left = rate(0.0);
        for i in 0..panels {
            let (g0, g1) = (width * i as f64, width * (i + 1) as f64);
            let right = rate(if i + 1 == panels { 0.0 } else { g1 });
            let (from, to) = match (left < 0.0, right < 0.0) {
                (true, true) => (g0, g1),
                (true, false) => (g0, sign_change(&rate, g0, g1)),
                (false, true) => (sign_change(&rate, g0, g1), g1),
                (false, false) => (g0, g0),
            };
            left = right;
            // The thinnest film may be where it cavitates, so every panel is looked at.
            visit(g0);
            visit(0.5 * (g0 + g1));
            if from == to {
                continue;
            }
            let half = 0.5 * (to - from);
            for (x, w) in GAUSS_6.iter().flat_map(|&(x, w)| [(-x, w), (x, w)]) {
                let node = visit(from + half * (1.0 + x));
                let weight = node.rate / (node.film * node.film * node.film) * node.arc * (w * half);
                sum[0] += weight * node.direction[0];
                sum[1] += weight * node.direction[1];
                sum[2] -= weight * node.slope;
            }
        }
        // Between the places that were looked at it may be thinner still.
        let slope = |gamma: f64| self.profile_node(&plain, &plain_e, gamma).slope;
        let around = [thinnest_at - 0.5 * width, thinnest_at + 0.5 * width];
        if slope(around[0]) < 0.0 && slope(around[1]) > 0.0 {
            thinnest = self.profile_node(m, e, change(slope, around[0], around[1])).film;
        }
        let defined = thinnest.value() > 0.0 && sum[0].value().is_finite() && sum[1].value().is_finite();
        if !defined {
            return Err(NoFilm { minimum_film: thinnest.value() });
        }
        let [y, z, slopes] = sum.map(|s| s * self.force_scale(viscosity));
        Ok(([y, z], slopes, thinnest))
    }

    /// Film thickness, h^3 g and the arc element at the Sommerfeld angle `gamma`.
    fn profile_node<T: Real>(&self, m: &JournalMotion<T>, e: &Eccentricity<T>, gamma: f64) -> ProfileNode<T> {
        let (sin_g, cos_g) = math::sin_cos(gamma);
        let stretch = e.ratio * cos_g + 1.0;
        let q = one_minus_square(e.ratio).sqrt();
        let (cos_b, sin_b) = ((e.ratio + cos_g) / stretch, q * sin_g / stretch);
        let [dy, dz] = e.direction;
        let (cos_t, sin_t) = (dy * cos_b - dz * sin_b, dz * cos_b + dy * sin_b);
        let [y, z] = m.position;
        let mut film = -(y * cos_t + z * sin_t) + self.clearance;
        let mut slope = y * sin_t - z * cos_t;
        let mut time_rate = -(m.velocity[0] * cos_t + m.velocity[1] * sin_t);
        let angle = sin_t.atan2(cos_t) - m.profile_angle;
        for a in &self.roundness {
            let n = f64::from(a.order);
            let (s, c) = (angle * n + a.phase).sin_cos();
            film -= c * a.amplitude;
            slope += s * (a.amplitude * n);
            time_rate -= s * (a.amplitude * n) * m.profile_speed;
        }
        let mut rate = (m.journal_speed + m.bush_speed) * slope * 0.5;
        if self.squeeze {
            rate += time_rate;
        }
        ProfileNode { film, rate, slope, arc: q / stretch, direction: [cos_t, sin_t] }
    }
}

struct ProfileNode<T> {
    film: T,
    /// h^3 g.
    rate: T,
    /// dh/dtheta, m/rad.
    slope: T,
    /// d(theta)/d(gamma).
    arc: T,
    direction: [T; 2],
}

/// What the eccentricity makes of the integral of p dh/dtheta, N m, with this force of the pressure.
#[inline]
fn eccentric<T: Real>([y, z]: [T; 2], [fy, fz]: [T; 2]) -> T {
    z * fy - y * fz
}

#[inline]
fn one_minus_square<T: Real>(x: T) -> T {
    (-x + 1.0) * (x + 1.0)
}

/// Root of `f` in a bracket by bisection; the integrand vanishes there, so 40 halvings are far below round-off
/// of the integral.
fn sign_change(f: &impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let negative_at_a = f(a) < 0.0;
    for _ in 0..40 {
        let middle = 0.5 * (a + b);
        if (f(middle) < 0.0) == negative_at_a {
            a = middle;
        } else {
            b = middle;
        }
    }
    0.5 * (a + b)
}

/// Positive nodes and weights of the six-point Gauss-Legendre rule on [-1, 1].
const GAUSS_6: [(f64, f64); 3] = [
    (0.238_619_186_083_196_9, 0.467_913_934_572_691_04),
    (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (0.932_469_514_203_152, 0.171_324_492_379_170_36),
];

#[cfg(test)]
mod tests;
