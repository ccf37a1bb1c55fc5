//! Rolling resistance of an elastohydrodynamic line contact (Zhou and Hoeprich 1991).
//!
//! ```text
//! F_iso = 29.2 R_e l (G U)^0.648 W^0.246 / alpha
//! W = Q/(E' R_e l),  U = eta0 u/(E' R_e),  G = alpha E'
//! ```
//!
//! Fitted to tapered roller bearings under load. At low load it falls slower than the film theory of rigid surfaces does.
//! Source: NTN Eq. 11.

use super::RollingFilm;
use crate::laws::film::thickness::Entrainment;
use crate::scalar::{Base, Of, math};

/// Constants of the law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZhouHoeprich<B = f64> {
    /// F_iso at Q = 1 N, |u| = 1 m/s, N.
    scale: B,
}

impl ZhouHoeprich {
    /// From film and surfaces.
    pub fn new(film: &RollingFilm<'_>) -> Self {
        let RollingFilm { line, viscosity, pressure_viscosity } = *film;
        let g_u = pressure_viscosity * viscosity / line.equivalent_radius;
        let w = 1.0 / (line.effective_modulus * line.equivalent_radius * line.length);
        Self {
            scale: 29.2 * line.equivalent_radius * line.length / pressure_viscosity
                * math::powf(g_u, 0.648)
                * math::powf(w, 0.246),
        }
    }

    /// The same law without force anywhere.
    pub(super) fn none(&self) -> Self {
        Self { scale: 0.0 }
    }
}

impl<B> ZhouHoeprich<B> {
    /// The same with every constant replaced.
    #[inline(always)]
    pub fn map<U>(&self, f: &mut impl FnMut(&B) -> U) -> ZhouHoeprich<U> {
        ZhouHoeprich { scale: f(&self.scale) }
    }
}

impl<B: Base> ZhouHoeprich<B> {
    /// F_iso in N under the load of which ln is `ln_q`.
    #[inline(always)]
    pub fn force<T: Of<B>>(&self, ln_q: T, e: &Entrainment<T>) -> T {
        ((e.ln_speed + e.ln_viscosity) * 0.648 + ln_q * 0.246).exp() * self.scale
    }
}
