//! Force of a guide: a lubricant film, a solid contact, or both, sharing by film thickness.
//!
//! ```text
//! film alone     F = F_film                    (no force is defined where the film is gone)
//! solid alone    F = F_solid(d),               d = e - (C - a - h_a)
//! both           F = L F_film + (1 - L) F_solid,   moments likewise
//!                L = f [1 - exp(-1.8 Lambda^1.2)],  f = smoothstep(Lambda/Lambda_t)^2,  Lambda = (C - a - e)/sigma
//! ```
//!
//! e eccentricity, C radial clearance, h_a asperity height, sigma composite roughness. a is the height of the highest
//! place of the roundness profile: the solid contact and Lambda see the circle that the turning profile sweeps, which
//! keeps both smooth and the solid contact conservative; the film sees the profile itself. The solid contact pushes
//! against the eccentricity and rubs at its end. Source: Takeshima et al. 2025, Eq. 6, 21, 22, Table 2 and section 3.2; L weights
//! the film there too (its printed formula lacks the minus).
//!
//! The factor f is an assumption: without it (Lambda_t = 0) the share falls slower than the film force grows, their
//! product goes to infinity as the gap closes and is gone when it has closed. With it the force is continuous.

pub mod barus_film;
pub mod bent;
mod circumference;
pub mod dry_whirl;
pub mod journal;
pub mod lubricant_layer;
pub mod short_bearing;

use crate::laws::contact_pair::ContactMotion;
use crate::laws::elastic::solid::SolidContact;
use crate::laws::fluid::Fluid;
use crate::laws::guide::circumference::Film;
use crate::laws::guide::journal::{FilmForce, JournalMotion, NoFilm};
use crate::laws::guide::lubricant_layer::{LubricantLayer, PressureShear};
use crate::laws::guide::short_bearing::ShortBearing;
use crate::scalar::{Real, math, smoothstep};

/// Film ratio from which on the share of the film is one to the last bit.
const FULL_SHARE: f64 = 13.0;

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
    /// C, radial clearance, m.
    pub clearance: f64,
    /// C - a, radial clearance less the highest place of the roundness profile, m.
    pub free_clearance: f64,
    /// Film.
    pub film: Option<GuideFilm>,
    /// Solid contact.
    pub solid: Option<GuideSolid>,
    /// sigma, composite roughness in m; used where there are both.
    pub roughness: f64,
    /// Lambda_t, film ratio below which the film fades out; 0 for the paper's share.
    pub touching_ratio: f64,
}

/// Force of a guide on the journal. Components are those that act, after sharing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GuideForce<T> {
    /// Force of the film pressure (y, z), N.
    pub pressure: [T; 2],
    /// Force of the film shear (y, z), N.
    pub shear: [T; 2],
    /// Force of the solid contact (y, z), N.
    pub solid: [T; 2],
    /// Moment about the centre of the journal, N m.
    pub moment: T,
    /// Part of it that the film makes, N m.
    pub film_moment: T,
    /// Share of the film: 1 for a film alone, 0 for a solid contact alone.
    pub film_share: T,
}

impl<T: Real> GuideForce<T> {
    /// Sum of all components (y, z), N.
    #[inline]
    pub fn force(&self) -> [T; 2] {
        let (p, s, c) = (self.pressure, self.shear, self.solid);
        [p[0] + s[0] + c[0], p[1] + s[1] + c[1]]
    }

    /// The values without derivatives.
    #[inline]
    pub fn value(&self) -> GuideForce<f64> {
        let both = |[y, z]: [T; 2]| [y.value(), z.value()];
        GuideForce {
            pressure: both(self.pressure),
            shear: both(self.shear),
            solid: both(self.solid),
            moment: self.moment.value(),
            film_moment: self.film_moment.value(),
            film_share: self.film_share.value(),
        }
    }

    /// What the film alone does.
    #[inline]
    pub fn of_film(&self) -> Self {
        Self { solid: [T::constant(0.0); 2], moment: self.film_moment, ..*self }
    }
}

impl GuideFilm {
    /// Film force on the journal.
    ///
    /// # Errors
    /// [`NoFilm`] where the surfaces touch or overlap.
    #[inline]
    pub fn force<T: Real>(&self, m: &JournalMotion<T>, fluid: Fluid) -> Result<FilmForce<T>, NoFilm> {
        match self {
            GuideFilm::ShortBearing(film) => film.force(m, fluid),
            GuideFilm::LubricantLayer(film) => film.force(m, fluid),
        }
    }

    /// Smallest thickness, m; zero or negative where the surfaces touch or overlap.
    pub fn minimum(&self, m: &JournalMotion<f64>) -> f64 {
        match self {
            GuideFilm::ShortBearing(film) => film.minimum(m),
            GuideFilm::LubricantLayer(film) => film.minimum(m),
        }
    }

    /// Factor of dh/dt in G.
    fn squeeze(&self) -> f64 {
        match self {
            GuideFilm::ShortBearing(film) if !film.squeeze => 0.0,
            GuideFilm::ShortBearing(_) | GuideFilm::LubricantLayer(_) => 2.0,
        }
    }

    /// What thickens its oil where it is sheared.
    pub fn thickens(&self) -> bool {
        matches!(self, GuideFilm::LubricantLayer(film) if film.thickener.is_some())
    }

    /// The film in the gap of a bent cage, without what its fixed lobes do.
    fn around(&self, fluid: Fluid) -> Film<'_> {
        match self {
            GuideFilm::ShortBearing(film) => film.around(fluid),
            GuideFilm::LubricantLayer(film) => film.around(fluid),
        }
    }

    /// Whether the film takes energy at every motion; otherwise the field of the scene that says it does not.
    ///
    /// # Errors
    /// That field.
    pub fn passive(&self) -> Result<(), &'static str> {
        match self {
            GuideFilm::ShortBearing(film) if !film.squeeze => Err("short_bearing.squeeze"),
            GuideFilm::ShortBearing(film) if !film.pressure_moment => Err("short_bearing.pressure_moment"),
            GuideFilm::LubricantLayer(film) if film.pressure_shear != PressureShear::WithEdges => {
                Err("lubricant_layer.pressure_shear")
            }
            GuideFilm::ShortBearing(_) | GuideFilm::LubricantLayer(_) => Ok(()),
        }
    }
}

impl GuideLaw {
    /// Force on the journal.
    ///
    /// # Errors
    /// [`NoFilm`] for a film without solid contact that is gone.
    #[inline]
    pub fn force<T: Real>(&self, m: &JournalMotion<T>, fluid: Fluid) -> Result<GuideForce<T>, NoFilm> {
        let e = distance(m);
        let gap = -e + self.free_clearance;
        match (&self.film, &self.solid) {
            (Some(film), None) => Ok(from_film(film.force(m, fluid)?, T::constant(1.0))),
            (None, Some(solid)) => Ok(self.add_solid(solid, m, e, gap, apart())),
            (Some(film), Some(solid)) => {
                let share = self.film_share(gap);
                let film =
                    if share.value() > 0.0 { from_film(film.force(m, fluid)?, share) } else { apart() };
                Ok(self.add_solid(solid, m, e, gap, film))
            }
            (None, None) => Ok(apart()),
        }
    }

    /// The part of the film of [`GuideLaw::force`], with its share.
    ///
    /// # Errors
    /// As that.
    pub fn of_film<T: Real>(&self, m: &JournalMotion<T>, fluid: Fluid) -> Result<GuideForce<T>, NoFilm> {
        let Some(film) = &self.film else { return Ok(apart()) };
        let share = match self.solid {
            None => T::constant(1.0),
            Some(_) => self.film_share(-distance(m) + self.free_clearance),
        };
        if share.value() > 0.0 { Ok(from_film(film.force(m, fluid)?, share)) } else { Ok(apart()) }
    }

    /// The part of the solid contact where the film has this share.
    pub fn of_solid<T: Real>(&self, m: &JournalMotion<T>, film_share: T) -> GuideForce<T> {
        let mut none = apart();
        none.film_share = film_share;
        let e = distance(m);
        match &self.solid {
            None => none,
            Some(solid) => self.add_solid(solid, m, e, -e + self.free_clearance, none),
        }
    }

    /// Smallest gap, m: that of the film where there is one, else up to the highest place of the profile.
    pub fn smallest_gap(&self, m: &JournalMotion<f64>) -> f64 {
        match &self.film {
            Some(film) => film.minimum(m),
            None => self.free_clearance - math::hypot(m.position[0], m.position[1]),
        }
    }

    /// L at the smallest gap `gap` in m.
    #[inline]
    pub fn film_share<T: Real>(&self, gap: T) -> T {
        // Written so that a NaN gap counts as no film.
        let open = gap.value() > 0.0;
        if !open {
            return T::constant(0.0);
        }
        let ratio = gap / self.roughness;
        if ratio.value() >= self.touching_ratio.max(FULL_SHARE) {
            return T::constant(1.0);
        }
        let share = -(ratio.powf(1.2) * -1.8).exp() + 1.0;
        if ratio.value() >= self.touching_ratio {
            return share;
        }
        share * smoothstep(ratio / self.touching_ratio).squared()
    }

    #[inline]
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

/// e, m. A centred journal has no direction; its solid contact is open and its film finds its own.
#[inline]
fn distance<T: Real>(m: &JournalMotion<T>) -> T {
    let [y, z] = m.position;
    let r2 = y * y + z * z;
    if r2.value() > 0.0 { r2.sqrt() } else { T::constant(0.0) }
}

#[inline]
fn apart<T: Real>() -> GuideForce<T> {
    from_film(FilmForce::none(), T::constant(0.0))
}

#[inline]
fn from_film<T: Real>(film: FilmForce<T>, share: T) -> GuideForce<T> {
    GuideForce {
        pressure: [film.pressure[0] * share, film.pressure[1] * share],
        shear: [film.shear[0] * share, film.shear[1] * share],
        solid: [T::constant(0.0); 2],
        moment: film.moment * share,
        film_moment: film.moment * share,
        film_share: share,
    }
}

#[cfg(test)]
mod tests {
    use super::lubricant_layer::tests::layer;
    use super::*;
    use crate::laws::traction::solid_friction::SolidFriction;

    fn mixed() -> GuideLaw {
        let friction = Some(SolidFriction { coefficient: 0.1, transition_speed: 0.01 });
        let contact = SolidContact { stiffness: 1e6, damping: 44.4, softening_depth: 1e-6, friction };
        GuideLaw {
            radius: 46.6615e-3,
            clearance: 0.2135e-3,
            free_clearance: 0.2135e-3,
            film: Some(GuideFilm::LubricantLayer(layer())),
            solid: Some(GuideSolid { contact, asperity_height: 3e-6 }),
            roughness: 1e-6,
            touching_ratio: 0.1,
        }
    }

    fn at(e: f64, speed: f64) -> JournalMotion<f64> {
        JournalMotion {
            position: [0.0, e],
            velocity: [0.0; 2],
            journal_speed: speed,
            bush_speed: 0.0,
            profile_angle: 0.0,
            profile_speed: speed,
        }
    }

    #[test]
    fn shares_follow_the_smallest_gap() {
        let law = mixed();
        assert_eq!(law.film_share(0.0), 0.0);
        assert_eq!(law.film_share(f64::NAN), 0.0);
        assert!((law.film_share(1e-6) - (1.0 - (-1.8f64).exp())).abs() < 1e-15);
        assert!((law.film_share(30e-6) - 1.0).abs() < 1e-15);
        // Where it is full, nothing is cut off.
        assert_eq!(1.0 - (-1.8 * FULL_SHARE.powf(1.2)).exp(), 1.0);
    }

    #[test]
    fn full_film_is_the_film_alone_and_no_film_the_solid_alone() {
        let law = mixed();
        let m = at(150e-6, 142.5);
        let film_alone = GuideLaw { solid: None, ..law.clone() };
        let (a, b) = (law.force(&m, Fluid::SAME).unwrap(), film_alone.force(&m, Fluid::SAME).unwrap());
        assert!((a.force()[0] - b.force()[0]).abs() < 1e-12 * b.force()[0].abs());
        assert_eq!((a.solid, a.moment), ([0.0; 2], b.moment * a.film_share));
        let m = at(220e-6, 142.5);
        let solid_alone = GuideLaw { film: None, ..law.clone() };
        assert_eq!(law.force(&m, Fluid::SAME), solid_alone.force(&m, Fluid::SAME));
        assert!(film_alone.force(&m, Fluid::SAME).is_err());
    }

    #[test]
    fn solid_contact_pushes_back_and_brakes() {
        let law = GuideLaw { film: None, ..mixed() };
        let f = law.force(&at(213.5e-6, 142.5), Fluid::SAME).unwrap();
        // 3 um deep: 3 N inwards; the journal turns counter-clockwise and rubs at its top: friction to the right.
        assert!((f.solid[1] + 3.0).abs() < 1e-9, "{f:?}");
        assert!((f.solid[0] - 0.3).abs() < 1e-9);
        assert!((f.moment + 0.3 * 46.6615e-3).abs() < 1e-10);
        assert_eq!(f.film_share, 0.0);
        assert_eq!(law.force(&at(210e-6, 142.5), Fluid::SAME).unwrap().solid, [0.0; 2]);
        let carried = JournalMotion { bush_speed: 142.5, ..at(213.5e-6, 142.5) };
        assert_eq!(law.force(&carried, Fluid::SAME).unwrap().moment, 0.0);
    }

    #[test]
    fn the_sum_is_continuous_where_the_film_ends() {
        let law = mixed();
        let force = |gap: f64| law.force(&at(0.2135e-3 - gap, 142.5), Fluid::SAME).unwrap().force();
        let (a, b) = (force(1e-12), force(-1e-12));
        assert!((a[1] - b[1]).abs() < 1e-3, "{a:?} {b:?}");
        for k in 0..200 {
            let gap = 4e-6 - f64::from(k) * 2e-8;
            let (a, b) = (force(gap), force(gap - 1e-12));
            assert!((a[1] - b[1]).abs() < 1e-3 * a[1].abs(), "{gap}: {a:?} {b:?}");
        }
        // The paper's share makes the force grow without bound instead.
        let literal = GuideLaw { touching_ratio: 0.0, ..mixed() };
        let closing = |gap: f64| literal.force(&at(0.2135e-3 - gap, 142.5), Fluid::SAME).unwrap().force()[1];
        assert!(closing(1e-12) < 10.0 * closing(1e-9) && closing(1e-9) < 0.0);
    }
}
