//! Force of a guide: a lubricant film, a solid contact, or both, sharing by film thickness.
//!
//! ```text
//! film alone     F = F_film                    (no force is defined where the film is gone)
//! solid alone    F = F_solid(d),               d = e - (C - a - h_a)
//! both           F = L F_film + (1 - L) F_solid,   moments likewise
//!                L = 1 - exp(-1.8 Lambda^1.2), Lambda = (C - a - e)/sigma;   L = 0 where Lambda <= 0
//! ```
//!
//! e eccentricity, C radial clearance, h_a asperity height, sigma composite roughness. a is the height of the highest
//! place of the roundness profile: the solid contact and Lambda see the circle that the turning profile sweeps, which
//! keeps both smooth and the solid contact conservative; the film sees the profile itself. The solid contact pushes
//! against the eccentricity and rubs at its end. Source: Takeshima et al. 2025, Eq. 6, 21-25 and Table 2; L weights
//! the film there too (its printed formula lacks the minus).

use super::contact_pair::ContactMotion;
use super::journal::{FilmForce, JournalMotion, NoFilm};
use super::lubricant_layer::LubricantLayer;
use super::short_bearing::ShortBearing;
use super::solid_contact::SolidContact;
use crate::scalar::Real;

/// Film in the guide.
#[derive(Clone, Debug, PartialEq)]
pub enum GuideFilm {
    /// Clearance full of oil.
    ShortBearing(ShortBearing),
    /// Layer that fills the narrow part of the clearance.
    LubricantLayer(LubricantLayer),
}

/// Solid contact of the guide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuideSolid {
    /// Spring, damper, friction.
    pub contact: SolidContact,
    /// h_a, gap at which asperities begin to touch, m.
    pub asperity_height: f64,
}

/// Laws of a guide.
#[derive(Clone, Debug, PartialEq)]
pub struct GuideLaw {
    /// R, radius of the journal, m.
    pub radius: f64,
    /// C - a, radial clearance less the highest place of the roundness profile, m.
    pub free_clearance: f64,
    /// Film.
    pub film: Option<GuideFilm>,
    /// Solid contact.
    pub solid: Option<GuideSolid>,
    /// sigma, composite roughness in m; used where there are both.
    pub roughness: f64,
}

/// Force of a guide on the journal. Components are those that act, after sharing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuideForce<T> {
    /// Force of the film pressure (y, z), N.
    pub pressure: [T; 2],
    /// Force of the film shear (y, z), N.
    pub shear: [T; 2],
    /// Force of the solid contact (y, z), N.
    pub solid: [T; 2],
    /// Moment about the centre of the journal, N m.
    pub moment: T,
    /// Share of the film: 1 for a film alone, 0 for a solid contact alone.
    pub film_share: T,
    /// Smallest gap, m.
    pub minimum_film: T,
}

impl<T: Real> GuideForce<T> {
    /// Sum of all components (y, z), N.
    pub fn force(&self) -> [T; 2] {
        std::array::from_fn(|k| self.pressure[k] + self.shear[k] + self.solid[k])
    }
}

impl GuideFilm {
    /// Film force on the journal.
    ///
    /// # Errors
    /// [`NoFilm`] where the surfaces touch or overlap.
    pub fn force<T: Real>(&self, m: &JournalMotion<T>) -> Result<FilmForce<T>, NoFilm> {
        match self {
            GuideFilm::ShortBearing(film) => film.force(m),
            GuideFilm::LubricantLayer(film) => film.force(m),
        }
    }

    /// The film's viscosity eta0, Pa s.
    pub fn viscosity(&self) -> f64 {
        match self {
            GuideFilm::ShortBearing(film) => film.viscosity,
            GuideFilm::LubricantLayer(film) => film.viscosity,
        }
    }

    /// The film's viscosity eta0, Pa s.
    pub fn viscosity_mut(&mut self) -> &mut f64 {
        match self {
            GuideFilm::ShortBearing(film) => &mut film.viscosity,
            GuideFilm::LubricantLayer(film) => &mut film.viscosity,
        }
    }
}

impl GuideLaw {
    /// Force on the journal.
    ///
    /// # Errors
    /// [`NoFilm`] for a film without solid contact that is gone.
    pub fn force<T: Real>(&self, m: &JournalMotion<T>) -> Result<GuideForce<T>, NoFilm> {
        let [y, z] = m.position;
        let r2 = y * y + z * z;
        // A centred journal has no direction; its solid contact is open and its film finds its own.
        let e = if r2.value() > 0.0 { r2.sqrt() } else { T::constant(0.0) };
        let gap = -e + self.free_clearance;
        match (&self.film, &self.solid) {
            (Some(film), None) => Ok(from_film(film.force(m)?, T::constant(1.0))),
            (None, Some(solid)) => Ok(self.add_solid(solid, m, e, gap, apart(gap))),
            (Some(film), Some(solid)) => {
                let share = self.film_share(gap);
                let film = if share.value() > 0.0 { from_film(film.force(m)?, share) } else { apart(gap) };
                Ok(self.add_solid(solid, m, e, gap, film))
            }
            (None, None) => Ok(apart(gap)),
        }
    }

    /// L at the smallest gap `gap` in m.
    pub fn film_share<T: Real>(&self, gap: T) -> T {
        // Written so that a NaN gap counts as no film.
        let open = gap.value() > 0.0;
        if !open {
            return T::constant(0.0);
        }
        -((gap / self.roughness).powf(1.2) * -1.8).exp() + 1.0
    }

    /// Whether the solid contact of a guide at the eccentricity `e` (m) touches.
    pub fn solid_touches(&self, e: f64) -> bool {
        self.solid.is_some_and(|solid| e > self.free_clearance - solid.asperity_height)
    }

    fn add_solid<T: Real>(
        &self,
        solid: &GuideSolid,
        m: &JournalMotion<T>,
        e: T,
        gap: T,
        mut out: GuideForce<T>,
    ) -> GuideForce<T> {
        let depth = -gap + solid.asperity_height;
        if depth.value() <= 0.0 {
            return out;
        }
        let (dy, dz) = (m.position[0] / e, m.position[1] / e);
        let (along, across) =
            (m.velocity[0] * dy + m.velocity[1] * dz, m.velocity[1] * dy - m.velocity[0] * dz);
        let contact = solid.contact.force(&ContactMotion {
            delta: depth,
            delta_dot: along,
            u1: m.journal_speed * self.radius + across,
            u2: m.bush_speed * self.radius,
        });
        let share = -out.film_share + 1.0;
        let (normal, friction) = (contact.normal * share, contact.friction * share);
        out.solid = [-(normal * dy) - friction * dz, -(normal * dz) + friction * dy];
        out.moment += friction * self.radius;
        out
    }
}

fn apart<T: Real>(gap: T) -> GuideForce<T> {
    from_film(FilmForce::none(gap), T::constant(0.0))
}

fn from_film<T: Real>(film: FilmForce<T>, share: T) -> GuideForce<T> {
    GuideForce {
        pressure: film.pressure.map(|f| f * share),
        shear: film.shear.map(|f| f * share),
        solid: [T::constant(0.0); 2],
        moment: film.moment * share,
        film_share: share,
        minimum_film: film.minimum_film,
    }
}
