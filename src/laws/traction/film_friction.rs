//! Friction of a lubricant film from full film to boundary lubrication, whatever the shape of the contact.
//!
//! ```text
//! shear of the film (Muraki and Kimura), heated by itself -> mu of the full film;   mu + (mu_bd - mu) share of boundary lubrication
//! ```
//!
//! Source: those of the parts.

use crate::laws::film::regime::LubricationRegime;
use crate::laws::film::thickness::Entrainment;
use crate::laws::traction::muraki_kimura::Traction;
use crate::laws::traction::self_heating::SelfHeating;
use crate::scalar::{Base, Of};

/// The parts that a contact has.
#[derive(Clone, Copy, Debug)]
pub struct FilmFriction<'a, B> {
    /// Full-film traction.
    pub traction: Option<&'a Traction<B>>,
    /// Self-heating of the traction film.
    pub self_heating: Option<&'a SelfHeating<B>>,
    /// Mixed and boundary lubrication.
    pub regime: Option<&'a LubricationRegime<B>>,
}

/// What the film does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rubbing<T> {
    /// mu.
    pub coefficient: T,
    /// Lambda; zero without a regime.
    pub film_ratio: T,
    /// K; zero without self-heating.
    pub temperature_rise: T,
}

impl<B: Base> FilmFriction<'_, B> {
    /// At a mean pressure (Pa), on a half width or radius (m), with a film of this thickness (m), between surfaces with these speeds past the contact,
    /// m/s.
    #[inline(always)]
    pub fn at<T: Of<B>>(
        &self,
        [p, b]: [T; 2],
        [film, ln_film]: [T; 2],
        [u1, u2]: [T; 2],
        rolling: &Entrainment<T>,
    ) -> Rubbing<T> {
        let zero = ln_film.like(0.0);
        let mut out = Rubbing { coefficient: zero, film_ratio: zero, temperature_rise: zero };
        if let Some(traction) = self.traction
            && B::any(traction.acts.above(0.5))
        {
            let shear = traction.shear_state(p, film, ln_film, b, rolling);
            let heating = self.self_heating.filter(|heating| B::any(heating.acts.above(0.5)));
            let stress = match heating {
                None => shear.mean_shear(zero).stress,
                Some(heating) => {
                    let rise = heating.rise_per_stress(rolling.slip, film, b, u1, u2);
                    let heated = heating.solve(&shear, rise);
                    out.temperature_rise = heated.temperature_rise;
                    heated.stress
                }
            };
            let acts = T::lift(traction.acts).above(0.5);
            out.coefficient = T::select(acts, stress * traction.eyring_stress / p, zero);
        }
        if let Some(regime) = self.regime {
            out.film_ratio = regime.film_ratio(film);
            let share = regime.boundary_share(out.film_ratio);
            // In groups of full films only.
            if B::any(share.base().above(0.0)) {
                let mu = out.coefficient;
                out.coefficient = mu + (regime.boundary.at(rolling.slip) - mu) * share;
            }
        }
        out
    }
}
