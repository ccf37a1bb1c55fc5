//! Film force of a lubricant layer that sticks to the bush of a guide: short bearing with squeeze, Barus viscosity,
//! cavitation and wall shear.
//!
//! ```text
//! h = C - e cos(d) - Sum a_n cos(n (theta - psi) + b_n),   film where h < h_L
//! q = -(3 eta_0/h^3) G (L^2/4 - y^2),   G = (u_1 + u_2) dh/dx + 2 dh/dt
//! p(q) and eta(q) as in `BarusFilm`,   p = 0 and eta = eta_0 where q <= 0
//! tau = (h/2) dp/dx + eta (u_1 - u_2)/h,   u_1 - u_2 = R (w_1 - w_2) - v_eps sin(d) + v_phi cos(d)
//! F_P = -R Int p (cos, sin) dd dy,   F_S = R Int tau (sin, -cos) dd dy,
//! M = -R^2 Int tau dd dy + R Int p w' dd dy,   w = Sum a_n cos(n (theta - psi) + b_n) on the journal
//! ```
//!
//! Components are along the eccentricity and across it. d is counted from the thinnest place of a round gap, so
//! theta = phi + d for an eccentricity in the direction phi; the paper counts from the widest place. Index 1 is the journal, 2 the bush, psi the
//! profile. Source: Takeshima et al. 2025, Eq. 5-20. The stress acts on the journal against the direction in which it
//! acts on the fluid, which gives the signs of F_S along the eccentricity and of M above; Eq. 18 and 20 are printed with
//! the opposite ones, for which the film would drive the cage.
//!
//! Valid for L/(2R) up to about 0.25, a laminar film thin against R, and pressures well above the vapour pressure. The
//! layer has the same thickness everywhere and fills again at once.
//!
//! The width is integrated in closed form. Around the circumference the pressure gradient is integrated by parts, which
//! leaves Gauss sums in lanes between the places where the integrand has a kink (`breaks`, `panels`). Against a brute-force
//! integral, the force was off by at most 7e-11 of the largest force in 3000 random states of round surfaces, and by 1e-12 in
//! 600 with roundness (tests/sweeps/film_quadrature, with its seeds and with others). The largest of these errors are of states
//! that dip into the layer by less than some 1e-5 of the film: there, the rounding of e alone moves the ends of the wet arc,
//! and the error grows as the inverse of that depth.

use crate::laws::fluid::Fluid;
use crate::laws::fluid::grease::Thickener;
use crate::laws::guide::barus_film::BarusFilm;
use crate::laws::guide::circumference::Film;
use crate::laws::guide::circumference::land::Land;
use crate::laws::guide::journal::{FilmForce, Harmonic, JournalMotion, NoFilm};
use crate::scalar::Real;
use pulp::Arch;

/// Part of the pressure gradient in the shear stress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PressureShear {
    /// None: the stress of the sliding surfaces alone.
    Absent,
    /// The gradient within the wet arcs, but not across the jump of the pressure at their ends.
    WithinArc,
    /// The gradient with that jump. Only then does the film dissipate at every motion.
    WithEdges,
}

/// Lubricant layer on the bush of a journal.
#[derive(Clone, Debug, PartialEq)]
pub struct LubricantLayer {
    /// eta_0, Pa s.
    pub viscosity: f64,
    /// What thickens the oil where it is sheared, if anything.
    pub thickener: Option<Thickener>,
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
        self.film(fluid, Arch::new()).force(m)
    }

    /// Smallest thickness, m.
    pub fn minimum(&self, m: &JournalMotion<f64>) -> f64 {
        self.film(Fluid::SAME, Arch::new()).minimum(m)
    }

    /// The film in the gap of a bent cage.
    pub(super) fn around(&self, fluid: Fluid) -> Film<'_> {
        let mut film = self.film(fluid, Arch::new());
        film.land.lobe_moment = 0.0;
        film
    }

    /// The film of this fluid.
    fn film(&self, fluid: Fluid, instructions: Arch) -> Film<'_> {
        let viscosity = self.viscosity * fluid.relative_viscosity;
        let of_gradient = if self.pressure_shear == PressureShear::Absent { 0.0 } else { 1.0 };
        let land = Land {
            barus: BarusFilm { pressure_viscosity: self.pressure_viscosity, cap: self.cap },
            peak_scale: 0.75 * viscosity * self.width * self.width,
            area: self.radius * self.width,
            drag: self.radius * viscosity * self.width,
            radius: self.radius,
            gradient_force: of_gradient,
            gradient_moment: of_gradient,
            lobe_moment: if self.profile_on_journal { 1.0 } else { 0.0 },
            thickening: self.thickener.map(|law| law.of(&fluid)),
        };
        Film {
            land,
            clearance: self.clearance,
            layer: self.thickness,
            within_arc: self.pressure_shear == PressureShear::WithinArc,
            squeezed: true,
            drags: true,
            roundness: &self.roundness,
            instructions,
        }
    }
}

#[cfg(test)]
pub(super) mod tests;
