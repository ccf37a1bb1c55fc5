//! Rolling resistance of a line contact from no load to an elastohydrodynamic one.
//!
//! ```text
//! F_iso = F_E + (F_I - F_E) / (1 + (Q/Q_t)^2)
//! F_I   = 2.0796 sqrt(eta0 u Q l)                           rigid surfaces, constant viscosity
//! F_E   = that of Zhou and Hoeprich                         elastic surfaces, viscosity rising with pressure
//! Q_t   = 2.333 l (2 eta0 u)^(1/3) (R_e/alpha)^(2/3)        where pressure begins to thicken the oil
//! ```
//!
//! F_I follows from Reynolds' equation for a rolling rigid cylinder without further assumption: film h_0 = 4.895 eta0 u R_e l/Q
//! (Martin; exit where pressure and its gradient vanish), force Int (h/2) dp. Q_t is the load at which that film is as thick
//! as the one of a rigid cylinder in an oil that thickens with pressure, 1.05 (2 alpha eta0 u)^(2/3) R_e^(1/3) (Blok). The form
//! of the passage from one branch to the other by the load is that of Biboulet and Houpert (Proc. IMechE J 224, 2010), whose
//! own constants for line contacts are not used here; its exponent 2 is an assumption. Valid from no load on, below the speeds
//! at which the film is starved.

use super::{RollingFilm, ZhouHoeprich, ln_passage};
use crate::laws::film::thickness::Entrainment;
use crate::scalar::{Base, Of};

/// F_I over sqrt(eta0 u Q l).
const RIGID: f64 = 2.0796;
/// Constants of the law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidLimit<B = f64> {
    loaded: ZhouHoeprich<B>,
    /// F_I at Q = 1 N, |u| = 1 m/s, N.
    rigid: B,
    /// ln Q_t at |u| = 1 m/s, of Q_t in N.
    ln_passage: B,
}

impl RigidLimit {
    /// From film and surfaces.
    pub fn new(film: &RollingFilm<'_>) -> Self {
        let rigid = RIGID * (film.viscosity * film.line.length).sqrt();
        Self { loaded: ZhouHoeprich::new(film), rigid, ln_passage: ln_passage(film) }
    }

    /// The same law without force anywhere.
    pub(super) fn none(&self) -> Self {
        Self { loaded: self.loaded.none(), rigid: 0.0, ..*self }
    }
}

impl<B> RigidLimit<B> {
    /// The same with every constant replaced.
    #[inline(always)]
    pub fn map<U>(&self, f: &mut impl FnMut(&B) -> U) -> RigidLimit<U> {
        RigidLimit { loaded: self.loaded.map(f), rigid: f(&self.rigid), ln_passage: f(&self.ln_passage) }
    }
}

impl<B: Base> RigidLimit<B> {
    /// F_iso in N under the load of which ln is `ln_q`.
    #[inline(always)]
    pub fn force<T: Of<B>>(&self, ln_q: T, e: &Entrainment<T>) -> T {
        let ln_flow = e.ln_speed + e.ln_viscosity;
        let loaded = self.loaded.force(ln_q, e);
        let rigid = ((ln_flow + ln_q) * 0.5).exp() * self.rigid;
        let square = ((ln_q - ln_flow * (1.0 / 3.0) - self.ln_passage) * 2.0).exp();
        loaded + (rigid - loaded) / (square + 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::elastic::line::ElasticLine;

    /// Reynolds' equation for a rigid cylinder, X = x/sqrt(2 R h_0): load over 24 eta0 u R l/h_0 and rolling force over
    /// 6 sqrt(2) eta0 u l sqrt(R/h_0), by quadrature, with the exit at X = c where the pressure vanishes.
    fn cylinder() -> [f64; 2] {
        let slope = |x: f64, c: f64| (x * x - c * c) / (1.0 + x * x).powi(3);
        // X = tan(a): the inlet far away becomes a = -pi/2.
        let over = |f: &dyn Fn(f64) -> f64, c: f64| {
            let (from, to, n) = (-std::f64::consts::FRAC_PI_2, c.atan(), 20_000);
            let h = (to - from) / f64::from(n);
            (0..n)
                .map(|i| from + (f64::from(i) + 0.5) * h)
                .map(|a| f(a.tan()) / a.cos().powi(2) * h)
                .sum::<f64>()
        };
        let (mut low, mut high) = (0.1, 1.0);
        for _ in 0..60 {
            let c = 0.5 * (low + high);
            if over(&|x| slope(x, c), c) > 0.0 { low = c } else { high = c }
        }
        let c = low;
        // Load by parts: Int p dX = -Int X dp.
        let load = -over(&|x| x * slope(x, c), c);
        let force = over(&|x| (1.0 + x * x) * slope(x, c), c);
        [load, force]
    }

    #[test]
    fn the_rigid_branch_is_that_of_reynolds() {
        let [load, force] = cylinder();
        // h_0 = 24 load eta0 u R l/Q, F = 6 sqrt(2) force eta0 u l sqrt(R/h_0).
        assert!((24.0 * load - 4.895).abs() < 2e-3, "{}", 24.0 * load);
        let constant = 6.0 * 2f64.sqrt() * force / (24.0 * load).sqrt();
        assert!((constant / RIGID - 1.0).abs() < 2e-4, "{constant}");
    }

    #[test]
    fn both_ends_are_those_of_their_branches() {
        let line = ElasticLine::new(2.263736e11, 6.4e-3, 0.024);
        let film = RollingFilm { line: &line, viscosity: 0.05, pressure_viscosity: 2e-8 };
        let (law, loaded) = (RigidLimit::new(&film), ZhouHoeprich::new(&film));
        let e = Entrainment::new(6.0, 6.0, 0.0);
        let (light, heavy) = (0.1f64, 1e4f64);
        let rigid = RIGID * (0.05 * 6.0 * light * 0.024).sqrt();
        assert!((law.force(light.ln(), &e) / rigid - 1.0).abs() < 1e-5);
        assert!((law.force(heavy.ln(), &e) / loaded.force(heavy.ln(), &e) - 1.0).abs() < 5e-3);
        // Less than the fit where nothing presses, more of it where rigid surfaces still hold.
        assert!(law.force(1f64.ln(), &e) < 0.5 * loaded.force(1f64.ln(), &e));
        assert_eq!(law.none().force(light.ln(), &e), 0.0);
    }

    /// An unloaded roller of the example: 20 N of centrifugal force on the outer raceway at 6 m/s.
    #[test]
    fn unloaded_rollers_feel_about_the_same_by_both_laws() {
        let line = ElasticLine::new(2.263736e11, 1.0 / (1.0 / 7.5e-3 - 1.0 / 47.5e-3), 0.0204);
        let film = RollingFilm { line: &line, viscosity: 0.06, pressure_viscosity: 2e-8 };
        let (e, ln_q) = (Entrainment::new(6.0, 6.0, 0.0), 20f64.ln());
        let forces = [RigidLimit::new(&film).force(ln_q, &e), ZhouHoeprich::new(&film).force(ln_q, &e)];
        assert!((forces[0] - 0.80).abs() < 0.005 && (forces[1] - 0.84).abs() < 0.005, "{forces:?}");
    }
}
