//! Traction coefficient over all lubrication regimes, from boundary to full film.
//!
//! ```text
//! Lambda = h_c / sigma
//! mu = mu_bd                                                          Lambda <= L_bd
//! mu = mu_hd + (mu_bd - mu_hd) ((Lambda - L_hd)/(L_bd - L_hd))^6      L_bd < Lambda < L_hd
//! mu = mu_hd                                                          Lambda >= L_hd
//! ```
//!
//! Source: NTN Eq. 9 and 10. The boundary coefficient falls to zero with the slip speed
//! ([`crate::laws::traction::solid_friction`]); that smoothing is an assumption of this library.

use crate::laws::traction::solid_friction::SolidFriction;
use crate::scalar::{Base, Of};

/// Mixed and boundary friction of one contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LubricationRegime<B = f64> {
    /// mu_bd with its transition speed.
    pub boundary: SolidFriction<B>,
    /// L_bd, largest film ratio of pure boundary lubrication.
    pub lambda_boundary: B,
    /// L_hd, smallest film ratio of full-film lubrication.
    pub lambda_full: B,
    /// sigma, composite roughness, m.
    pub roughness: B,
}

impl LubricationRegime {
    /// Full film at any thickness.
    pub const NONE: Self = Self {
        boundary: SolidFriction::NONE,
        lambda_boundary: -2.0,
        lambda_full: -1.0,
        roughness: f64::INFINITY,
    };
}

impl<B> LubricationRegime<B> {
    /// The same with every constant replaced.
    #[inline(always)]
    pub fn map<U>(&self, f: &mut impl FnMut(&B) -> U) -> LubricationRegime<U> {
        LubricationRegime {
            boundary: self.boundary.map(f),
            lambda_boundary: f(&self.lambda_boundary),
            lambda_full: f(&self.lambda_full),
            roughness: f(&self.roughness),
        }
    }
}

impl<B: Base> LubricationRegime<B> {
    /// Film ratio Lambda of the film thickness `film` in m.
    #[inline(always)]
    pub fn film_ratio<T: Of<B>>(&self, film: T) -> T {
        film / self.roughness
    }

    /// Share of boundary friction, 1 at and below L_bd, 0 at and above L_hd.
    #[inline(always)]
    pub fn boundary_share<T: Of<B>>(&self, film_ratio: T) -> T {
        let x = (film_ratio - self.lambda_full) / (self.lambda_boundary - self.lambda_full);
        let cube = x * x * x;
        T::select(x.at_least(1.0), x.like(1.0), T::select(x.at_most(0.0), x.like(0.0), cube * cube))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn share_is_continuous_and_monotone() {
        let r = LubricationRegime {
            boundary: SolidFriction { coefficient: 0.1, transition_speed: 0.02 },
            lambda_boundary: 0.06,
            lambda_full: 3.0,
            roughness: 1e-7,
        };
        assert_eq!(r.boundary_share(0.05), 1.0);
        assert_eq!(r.boundary_share(3.5), 0.0);
        let mut last = 1.0;
        for i in 0..=4000 {
            let share = r.boundary_share(i as f64 * 1e-3);
            assert!(share <= last && last - share < 3e-3);
            last = share;
        }
        assert!((r.boundary_share(1.53) - 0.5f64.powi(6)).abs() < 1e-12);
        assert!((r.film_ratio(3e-7) - 3.0).abs() < 1e-14);
    }
}
