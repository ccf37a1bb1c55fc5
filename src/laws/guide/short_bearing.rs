//! Film force of a filled guide clearance: short journal bearing with squeeze and roundness.
//!
//! ```text
//! h(th) = c - (y cos th + z sin th) - Sum_{n>=2} a_n cos(n (th - psi) + b_n)
//! g(th) = (1/h^3) [((w_1 + w_2)/2) dh/dth + dh/dt],   kept only where g < 0 (Guembel)
//! (F_y, F_z) = 2 eta0 R l^3 Int g (cos th, sin th) dth                          (two lands of width l)
//! M = -2 eta0 (w_1 - w_2) R^3 l Int dth/h + 1/2 Int p dh/dth dA - M_lobes
//! ```
//!
//! c radial clearance, (y, z) centre of the journal in the bush, w_1 and w_2 speeds of journal and bush, psi angle of
//! the profile, dh/dt with the profile turning. Valid for l/(2R) up to about 0.25, laminar isoviscous
//! film. The moment of sliding uses the full film although the pressure is cut, as the paper does; between round surfaces it is
//! the paper's -4 pi eta0 (w_1 - w_2) R^3 l / (c sqrt(1 - eps^2)), which lobes that leave room beyond eps = 1 would make infinite
//! in an open gap. It turns both surfaces and does not push them. That of the pressure, half
//! on each side, and on the lobes of a profile, Int p dw/dth dA on the body that carries them, is `pressure_moment`: without it,
//! as in the paper, the film puts energy into a journal that whirls fast enough far off the centre. Source: NTN Eq. 13-21,
//! there for a bush at rest.
//!
//! With Sommerfeld's substitution cos b = (cos g + eps)/(1 + eps cos g) the integrals of a round cage are
//! elementary, so its force is exact. With roundness they are Gauss sums in lanes between the changes of sign of g (`panels`);
//! against a brute-force integral the force was off by at most 3e-13 in 100 random states (tests/sweeps/film_quadrature).

use crate::laws::fluid::Fluid;
use crate::laws::guide::barus_film::BarusFilm;
use crate::laws::guide::circumference::Film;
use crate::laws::guide::circumference::land::Land;
use crate::laws::guide::journal::{FilmForce, Harmonic, JournalMotion, NoFilm};
use crate::scalar::Real;
use pulp::Arch;
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
        if !self.roundness.is_empty() {
            return self.lobed(viscosity).force(m);
        }
        let e = self.eccentricity(m);
        let film = (-e.ratio + 1.0) * self.clearance;
        // Written so that a NaN counts as no film.
        let exists = film.value() > THINNEST_FILM * self.clearance;
        if !exists {
            return Err(NoFilm { minimum_film: film.value() });
        }
        let scale = -4.0 * PI * viscosity * self.radius.powi(3) * self.land_width / self.clearance;
        let sliding = (m.journal_speed - m.bush_speed) * scale / one_minus_square(e.ratio).sqrt();
        let force = self.round_force(m, &e, viscosity);
        let mut moment = sliding;
        if self.pressure_moment {
            let ([y, z], [fy, fz]) = (m.position, force);
            moment += (z * fy - y * fz) * 0.5;
        }
        Ok(FilmForce { pressure: force, shear: [T::constant(0.0); 2], moment })
    }

    /// Smallest thickness, m.
    pub fn minimum(&self, m: &JournalMotion<f64>) -> f64 {
        self.lobed(self.viscosity).minimum(m)
    }

    /// The film between surfaces that are not round. Its drag turns both and does not push them, as that of a round gap.
    fn lobed(&self, viscosity: f64) -> Film<'_> {
        let share = |part: bool| if part { 1.0 } else { 0.0 };
        let area = 2.0 * self.radius * self.land_width;
        let land = Land {
            barus: BarusFilm { pressure_viscosity: 0.0, cap: 0.5 },
            peak_scale: 0.75 * viscosity * self.land_width.powi(2),
            area,
            drag: viscosity * area,
            radius: self.radius,
            gradient_force: 0.0,
            gradient_moment: share(self.pressure_moment),
            lobe_moment: share(self.pressure_moment && self.profile_on_journal),
            thickening: None,
        };
        Film {
            land,
            clearance: self.clearance,
            layer: f64::INFINITY,
            within_arc: false,
            squeezed: self.squeeze,
            drags: false,
            roundness: &self.roundness,
            instructions: Arch::new(),
        }
    }

    /// The film in the gap of a bent cage.
    pub(super) fn around(&self, fluid: Fluid) -> Film<'_> {
        let viscosity = self.viscosity * fluid.relative_viscosity;
        let mut film = self.lobed(viscosity);
        film.land.lobe_moment = 0.0;
        film
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
}

#[inline]
fn one_minus_square<T: Real>(x: T) -> T {
    (-x + 1.0) * (x + 1.0)
}

#[cfg(test)]
mod tests;
