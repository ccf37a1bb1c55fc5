//! Film force of a lubricant layer that sticks to the bush of a guide: short bearing with squeeze, Barus viscosity,
//! cavitation and wall shear.
//!
//! ```text
//! h = C + e cos(Theta) - Sum a_n cos(n (theta - psi) + b_n),   film where h < h_L
//! q = -(3 eta_0/h^3) G (L^2/4 - y^2),   G = (u_1 + u_2) dh/dx + 2 dh/dt
//! p(q) and eta(q) as in `BarusFilm`,   p = 0 and eta = eta_0 where q <= 0
//! tau = (h/2) dp/dx + eta (u_1 - u_2)/h,   u_1 - u_2 = R (w_1 - w_2) + v_eps sin(Theta) - v_phi cos(Theta)
//! F_P = R Int p (cos, sin) dTheta dy,   F_S = R Int tau (-sin, cos) dTheta dy,   M = -R^2 Int tau dTheta dy
//! ```
//!
//! Components are along the eccentricity and across it. Theta is counted from the widest place of a round gap, so
//! theta = phi + Theta - pi for an eccentricity in the direction phi. Index 1 is the journal, 2 the bush, psi the
//! profile. Source: Takeshima et al. 2025, Eq. 5-20. The stress acts on the journal against the direction in which it
//! acts on the fluid, which gives the signs of F_S along the eccentricity and of M above; Eq. 18 and 20 are printed with
//! the opposite ones, for which the film would drive the cage.
//!
//! Valid for L/(2R) up to about 0.25, a laminar film thin against R, and pressures well above the vapour pressure. The
//! layer has the same thickness everywhere and fills again at once.
//!
//! The width is integrated in closed form. Around the circumference the pressure gradient is integrated by parts, which
//! leaves Gauss quadrature between the places where the integrand has a kink. Against a brute-force integral, the force
//! on round surfaces was off by at most 4.3e-10 of the largest force in 12600 random states, and by 7e-11 in 99.9 % of
//! them. The largest of these errors are of states that dip into the layer by less than some 1e-5 of the film: there, the
//! rounding of e alone moves the ends of the wet arc, and the error grows as the inverse of that depth.
//!
//! With roundness, panels follow the harmonics and end where h is smallest or largest, h = h_L, G = 0 or s = s_cap; the
//! force was off by at most 1.4e-9 in 3600 states. Two changes of sign of G or of s - s_cap are missed only where both
//! lie within a twelfth of the shortest period and the values around them do not curve towards zero; that costs
//! accuracy, but neither continuity nor symmetry.

use crate::laws::fluid::Fluid;
use crate::laws::guide::journal::{FilmForce, Harmonic, JournalMotion, NoFilm};
use crate::laws::guide::layer_gap::{Gap, ProfileGap, RoundGap, change, parts};
use crate::laws::guide::layer_quadrature::{Arc, Integrator, Land};

pub use crate::laws::guide::layer_quadrature::PressureShear;

use crate::scalar::Real;
use std::f64::consts::{PI, TAU};

/// Steps in which a round gap is searched for the place where the viscosity reaches its cap.
const CAP_SCAN: u32 = 12;
/// Panels per period of the highest harmonic.
const PANELS_PER_PERIOD: f64 = 6.0;
/// Steps in which a panel of a profile is searched for G = 0 and for the cap.
const PARTS: u32 = 2;
/// Widest panel of a profile in Sommerfeld's angle, rad.
const WIDEST: f64 = 0.3;
/// Narrowest panel of a profile, rad; it bounds their number.
const NARROWEST: f64 = 2e-3;

/// Lubricant layer on the bush of a journal.
#[derive(Clone, Debug, PartialEq)]
pub struct LubricantLayer {
    /// eta_0, Pa s.
    pub viscosity: f64,
    /// alpha >= 0, 1/Pa; 0 is an isoviscous film.
    pub pressure_viscosity: f64,
    /// s_cap, value of alpha q above which the pressure follows its tangent; between 0 and 1, usually 0.9.
    pub cap: f64,
    /// R, radius of the journal, m; the film is thin, so it serves for both surfaces.
    pub radius: f64,
    /// C, radial clearance, m.
    pub clearance: f64,
    /// L, width of the land, m.
    pub width: f64,
    /// h_L, thickness of the layer, m; a layer thicker than the widest gap floods it.
    pub thickness: f64,
    /// What the pressure gradient adds to the shear stress.
    pub pressure_shear: PressureShear,
    /// Roundness; empty for round surfaces.
    pub roundness: Vec<Harmonic>,
    /// Whether the journal carries it, and not the bush.
    pub profile_on_journal: bool,
}

impl LubricantLayer {
    /// Film force on the journal, or [`NoFilm`] where h <= 0.
    pub fn force<T: Real>(&self, m: &JournalMotion<T>, fluid: Fluid) -> Result<FilmForce<T>, NoFilm> {
        let viscosity = self.viscosity * fluid.relative_viscosity;
        let (eccentricity, direction) = eccentricity(m.position);
        if self.roundness.is_empty() {
            self.round_force(m, eccentricity, direction, viscosity)
        } else {
            self.profile_force(m, eccentricity.value(), direction.map(Real::value), viscosity)
        }
    }

    /// What the quadrature needs of it, with the viscosity in Pa s.
    fn land(&self, viscosity: f64) -> Land {
        // The pressure on lobes turns the journal.
        let turns_lobes = self.pressure_shear == PressureShear::WithEdges
            && self.profile_on_journal
            && !self.roundness.is_empty();
        Land {
            viscosity,
            pressure_viscosity: self.pressure_viscosity,
            cap: self.cap,
            radius: self.radius,
            width: self.width,
            pressure_shear: self.pressure_shear,
            turns_lobes,
        }
    }

    fn round_force<T: Real>(
        &self,
        m: &JournalMotion<T>,
        e: T,
        direction: [T; 2],
        viscosity: f64,
    ) -> Result<FilmForce<T>, NoFilm> {
        let [dy, dz] = direction;
        let [vy, vz] = m.velocity;
        let (radial, tangential) = (vy * dy + vz * dz, vz * dy - vy * dz);
        let (thinnest, thickest) = (-e + self.clearance, e + self.clearance);
        // Written so that a NaN counts as no film.
        let exists = thinnest.value() > 0.0;
        if !exists {
            return Err(NoFilm { minimum_film: thinnest.value() });
        }
        // Immersion of the thinnest place, and how far the widest one is from the layer.
        let (depth, dry) = (-thinnest + self.thickness, thickest - self.thickness);
        if depth.value() <= 0.0 {
            return Ok(FilmForce::none(thinnest));
        }
        let square = thinnest * thickest;
        let gap = RoundGap {
            eccentricity: e,
            thinnest,
            thickest,
            mean: square.sqrt(),
            inverse_square: T::constant(1.0) / square,
            wedge: (m.journal_speed + m.bush_speed) * e - tangential * 2.0,
            squeeze: radial * 2.0,
            rolling: (m.journal_speed - m.bush_speed) * self.radius,
            velocity: [radial, tangential],
        };
        let plain = gap.plain();
        let flooded = dry.value() <= 0.0;
        let end = if flooded {
            T::constant(PI)
        } else {
            (depth * thickest).sqrt().atan2((dry * thinnest).sqrt()) * 2.0
        };
        let arc = Arc { start: -end, end };
        let mut film = Integrator::new(self.land(viscosity), &gap, &plain);
        let last = end.value();
        let [cos, sin] = plain.at(last).normal;
        let most = plain.wedge.abs() * (if cos > 0.0 { sin } else { 1.0 }) + plain.squeeze.abs();
        let bound = self.relative_pressure(viscosity, most, plain.thinnest);
        let mut from = -last;
        for at in plain.sign_changes() {
            if at > from && at < last {
                film.piece(&arc, from, at, bound, CAP_SCAN);
                from = at;
            }
        }
        film.piece(&arc, from, last, bound, CAP_SCAN);
        if self.pressure_shear == PressureShear::WithinArc && !flooded {
            film.wet_end(arc.end, 1.0);
            film.wet_end(arc.start, -1.0);
        }
        let turn = |[a, b]: [T; 2]| [a * dy - b * dz, a * dz + b * dy];
        Ok(FilmForce {
            pressure: turn(film.sums.pressure),
            shear: turn(film.sums.shear),
            moment: film.sums.moment,
            minimum_film: thinnest,
        })
    }

    /// s for an approach -G of `speed` m/s at a film of `film` m.
    #[inline]
    fn relative_pressure(&self, viscosity: f64, speed: f64, film: f64) -> f64 {
        0.75 * viscosity * self.width.powi(2) * self.pressure_viscosity * speed / film.powi(3)
    }

    fn profile_force<T: Real>(
        &self,
        m: &JournalMotion<T>,
        e: f64,
        direction: [f64; 2],
        viscosity: f64,
    ) -> Result<FilmForce<T>, NoFilm> {
        // The map has to stay regular; a profile that is thin nowhere near the eccentricity lets e reach C.
        let thinnest = (self.clearance - e).max(1e-4 * self.clearance);
        let gap = ProfileGap {
            radius: self.radius,
            clearance: self.clearance,
            roundness: &self.roundness,
            motion: *m,
            direction,
            thinnest,
            thickest: 2.0 * self.clearance - thinnest,
        };
        let plain = gap.plain();
        let highest = self.roundness.iter().map(|a| a.order).max().unwrap_or(2);
        let widest = TAU / (PANELS_PER_PERIOD * f64::from(highest));
        let mut film = Integrator::new(self.land(viscosity), &gap, &plain);
        let (mut least, mut thinnest_at, mut missing) = (f64::INFINITY, 0.0, None);
        let slope = |gamma: f64| plain.at(gamma).slope;
        let mut from = -PI;
        let mut here = plain.at(from);
        while from < PI && missing.is_none() {
            let gradient = (here.slope * here.arc * here.inverse_film).abs();
            let step = WIDEST.min(widest / here.arc).min(0.5 / gradient).max(NARROWEST);
            let to = if from + 1.01 * step < PI { from + step } else { PI };
            parts(slope, [from, to], 1, |a, b| {
                for (at, place) in [(a, plain.at(a)), (b, plain.at(b))] {
                    // Written so that a NaN counts as no film.
                    let exists = place.film > 0.0;
                    if !exists {
                        missing = Some(place.film);
                    } else if place.film < least {
                        (least, thinnest_at) = (place.film, at);
                    }
                }
                if missing.is_none() && b > a {
                    self.profile_panel(&mut film, a, b);
                }
            });
            (from, here) = (to, plain.at(to));
        }
        if let Some(minimum_film) = missing {
            return Err(NoFilm { minimum_film });
        }
        let sums = film.sums;
        Ok(FilmForce {
            pressure: sums.pressure,
            shear: sums.shear,
            moment: sums.moment,
            minimum_film: gap.at(T::constant(thinnest_at)).film,
        })
    }

    /// Adds the wet part of a panel in which h has no extremum inside.
    fn profile_panel<T: Real>(
        &self,
        film: &mut Integrator<'_, T, ProfileGap<'_, T>, ProfileGap<'_, f64>>,
        from: f64,
        to: f64,
    ) {
        let (gap, plain) = (film.gap, film.plain);
        let dry = |gamma: f64| plain.at(gamma).film - self.thickness;
        // The Newton step that gives the end of the wet arc its derivatives.
        let edge = || {
            let at = change(dry, from, to);
            let place = plain.at(at);
            let error = gap.at(T::constant(at)).film - self.thickness;
            let moved = T::constant(at) - error / (place.slope * place.arc);
            if moved.value().is_finite() { moved } else { T::constant(at) }
        };
        let mut arc = Arc { start: T::constant(from), end: T::constant(to) };
        match (dry(from) < 0.0, dry(to) < 0.0) {
            (true, true) => (),
            (false, false) => return,
            (true, false) => arc.end = edge(),
            (false, true) => arc.start = edge(),
        }
        let (start, end) = (arc.start.value(), arc.end.value());
        if self.pressure_shear == PressureShear::WithinArc && end > start {
            if end < to {
                film.wet_end(arc.end, 1.0);
            }
            if start > from {
                film.wet_end(arc.start, -1.0);
            }
        }
        parts(
            |gamma| plain.at(gamma).opening,
            [start, end],
            PARTS,
            |a, b| {
                let bound = [a, 0.5 * (a + b), b].map(|g| plain.at(g)).iter().fold(0.0, |most: f64, p| {
                    most.max(self.relative_pressure(film.land.viscosity, -p.opening, p.film))
                });
                film.piece(&arc, a, b, 2.0 * bound, PARTS);
            },
        );
    }
}

/// Distance of the journal from the centre and its direction; the direction is arbitrary (+y) at the centre.
#[inline]
fn eccentricity<T: Real>([y, z]: [T; 2]) -> (T, [T; 2]) {
    let r2 = y * y + z * z;
    // Below this, squares lose digits to underflow and the direction would not be a unit vector.
    if r2.value() < 1e-280 {
        return (y, [T::constant(1.0), T::constant(0.0)]);
    }
    let r = r2.sqrt();
    (r, [y / r, z / r])
}

#[cfg(test)]
pub(super) mod tests;
