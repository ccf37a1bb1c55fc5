//! Rolling resistance of a lubricated line contact.
//!
//! ```text
//! F_R = share T_R F_iso
//! T_R = max(0, [1 - 13.2 (P_max/E') L_T^0.42] / [1 + 0.213 (1 + 2.23 s^0.83) L_T^0.64])
//! ```
//!
//! F_iso is that of one of the laws of this folder, share that of the load zone if asked for. F_R acts on both surfaces
//! against the rolling velocity. The pressure of the film adds 2 R_e F_R/R through the centre of each body along it, so that
//! the four tangential forces of a contact cancel. Source: NTN Eq. 11 and 12. The floor at zero is an assumption: the fitted
//! T_R turns negative at very high speed and pressure.
//!
//! The paper applies its law to unloaded contacts too and finds the result too large; [`Extent::Loaded`] leaves it out there.
//!
//! A new law is a file with `new`, `none`, `map` and `force`, and its name in `rolling_laws!`.

mod inlet_sliding;
pub mod point;
mod rigid_limit;
mod zhou_hoeprich;

pub use inlet_sliding::{ELASTIC_RATIO, InletSliding, RIGID_RATIO};
pub use rigid_limit::RigidLimit;
pub use zhou_hoeprich::ZhouHoeprich;

use crate::laws::elastic::line::ElasticLine;
use crate::laws::film::thickness::{ENTRAINMENT_FLOOR, Entrainment, ThermalLoad};
use crate::scalar::{Base, Of, math, smoothstep};
use std::f64::consts::PI;

/// What a law is made from.
#[derive(Clone, Copy, Debug)]
pub struct RollingFilm<'a> {
    /// The elastic contact.
    pub line: &'a ElasticLine,
    /// eta0, Pa s.
    pub viscosity: f64,
    /// alpha, 1/Pa.
    pub pressure_viscosity: f64,
}

/// Q_t over l (2 eta0 u)^(1/3) (R_e/alpha)^(2/3): 2.45/1.05.
const PASSAGE: f64 = 2.333;

/// ln of the load Q_t in N from which pressure thickens the oil, at |u| = 1 m/s: see [`RigidLimit`].
fn ln_passage(film: &RollingFilm<'_>) -> f64 {
    let RollingFilm { line, viscosity, pressure_viscosity } = *film;
    let passage = PASSAGE
        * line.length
        * math::powf(2.0 * viscosity, 1.0 / 3.0)
        * math::powf(line.equivalent_radius / pressure_viscosity, 2.0 / 3.0);
    math::ln(passage)
}

/// Defines the choice among the laws, each of which has `none` (the same law without force anywhere), `map` over its constants
/// and `force`, F_iso in N.
macro_rules! rolling_laws {
    ($($law:ident),+) => {
        /// One of the laws of this folder.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Isothermal<B = f64> {
            $(#[doc = concat!("See [`", stringify!($law), "`].")] $law($law<B>)),+
        }

        impl Isothermal {
            fn none(&self) -> Self {
                match self { $(Self::$law(law) => Self::$law(law.none())),+ }
            }
        }

        impl<B> Isothermal<B> {
            #[inline(always)]
            fn map<U>(&self, f: &mut impl FnMut(&B) -> U) -> Isothermal<U> {
                match self { $(Self::$law(law) => Isothermal::$law(law.map(f))),+ }
            }
        }

        impl<B: Base> Isothermal<B> {
            #[inline(always)]
            fn force<T: Of<B>>(&self, ln_q: T, e: &Entrainment<T>) -> T {
                match self { $(Self::$law(law) => law.force(ln_q, e)),+ }
            }
        }
    };
}

rolling_laws!(ZhouHoeprich, RigidLimit);

/// Where rolling resistance acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// In every contact, as in the paper.
    All,
    /// Only where the contact carries load: fades in between `threshold` and twice that load (N).
    Loaded {
        /// Load below which there is no rolling resistance, N.
        threshold: f64,
    },
}

/// Rolling resistance of one contact pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollingResistance<B = f64> {
    /// F_iso.
    pub law: Isothermal<B>,
    /// 4/(pi E'), from P_mean to P_max/E', 1/Pa.
    pub pressure_factor: B,
    /// Thermal load constant of T_R.
    pub thermal: ThermalLoad,
    /// Contacts in which the law acts.
    pub extent: Extent,
    /// Drag of the same film on surfaces that slip.
    pub sliding: Option<InletSliding<B>>,
}

impl RollingResistance {
    /// From the law, the elastic contact and the thermal load constant; without drag by slip.
    pub fn new(law: Isothermal, line: &ElasticLine, thermal: ThermalLoad, extent: Extent) -> Self {
        Self { law, pressure_factor: 4.0 / PI / line.effective_modulus, thermal, extent, sliding: None }
    }

    /// The same, but without force anywhere.
    pub fn none(&self) -> Self {
        Self { law: self.law.none(), ..*self }
    }
}

impl<B> RollingResistance<B> {
    /// The same with every constant of the surfaces replaced.
    #[inline(always)]
    pub fn map<U>(&self, f: &mut impl FnMut(&B) -> U) -> RollingResistance<U> {
        RollingResistance {
            law: self.law.map(f),
            pressure_factor: f(&self.pressure_factor),
            thermal: self.thermal,
            extent: self.extent,
            sliding: match &self.sliding {
                None => None,
                Some(sliding) => Some(sliding.map(f)),
            },
        }
    }
}

impl<B: Base> RollingResistance<B> {
    /// F_R >= 0 in N under the load `q` > 0 (N), of which ln is `ln_q`, and mean pressure (Pa).
    #[inline(always)]
    pub fn force<T: Of<B>>(&self, q: T, ln_q: T, mean_pressure: T, e: &Entrainment<T>) -> T {
        let share = match self.extent {
            Extent::All => q.like(1.0),
            Extent::Loaded { threshold } => smoothstep((q - threshold) / threshold),
        };
        self.law.force(ln_q, e) * self.thermal_factor(mean_pressure, e) * share
    }

    /// F_S over |u_1 - u_2| in N s/m where the rolling resistance is `force` (N), under the load of which ln is `ln_q`; `None`
    /// without this drag.
    #[inline(always)]
    pub fn sliding_secant<T: Of<B>>(&self, force: T, ln_q: T, e: &Entrainment<T>) -> Option<T> {
        let sliding = self.sliding.as_ref()?;
        Some(force * sliding.ratio(ln_q, e) / e.speed)
    }

    /// T_R under the mean pressure in Pa.
    #[inline(always)]
    pub fn thermal_factor<T: Of<B>>(&self, mean_pressure: T, e: &Entrainment<T>) -> T {
        let pressure = mean_pressure * self.pressure_factor;
        self.thermal.gupta(pressure, e).floored(0.0)
    }
}

impl RollingResistance {
    /// Whether this force (N) under the load `q` (N) at the mean surface speed `u` (m/s) is zero because T_R is at its floor:
    /// the speed and pressure are far outside of what T_R was fitted to.
    pub fn is_at_floor(&self, force: f64, q: f64, u: f64) -> bool {
        let least = match self.extent {
            Extent::All => 0.0,
            Extent::Loaded { threshold } => threshold,
        };
        force == 0.0 && self.law != self.law.none() && q > least && u.abs() > ENTRAINMENT_FLOOR
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(extent: Extent) -> RollingResistance {
        let line = ElasticLine::new(2.263736e11, 6.4e-3, 0.024);
        let film = RollingFilm { line: &line, viscosity: 0.05, pressure_viscosity: 2e-8 };
        let law = Isothermal::ZhouHoeprich(ZhouHoeprich::new(&film));
        RollingResistance::new(law, &line, ThermalLoad::new(0.04, 0.05, 0.13), extent)
    }

    #[test]
    fn matches_the_formula_at_a_hand_computed_point() {
        // U = 2.0817e-10, W = 2.8760e-5, G = 4527.5 at 1000 N and 6.0319 m/s (reference values of the film test).
        let q = 1000.0;
        let e = Entrainment::new(6.0319, 6.0319, 0.0);
        let isothermal =
            29.2 * 6.4e-3 * 0.024 / 2e-8 * (4527.5 * 2.0817e-10f64).powf(0.648) * 2.8760e-5f64.powf(0.246);
        let l_t: f64 = 0.04 * 0.05 / 0.13 * 6.0319f64.powi(2);
        let p_max = 484.31e6;
        let t_r = (1.0 - 13.2 * p_max / 2.263736e11 * l_t.powf(0.42)) / (1.0 + 0.213 * l_t.powf(0.64));
        let f = law(Extent::All).force(q, q.ln(), p_max * PI / 4.0, &e);
        assert!((f / (isothermal * t_r) - 1.0).abs() < 1e-4, "{f} {}", isothermal * t_r);
    }

    #[test]
    fn never_drives_and_respects_its_extent() {
        let e = Entrainment::new(500.0, 500.0, 0.0);
        assert_eq!(law(Extent::All).force(1e5, 1e5f64.ln(), 3e9, &e), 0.0);
        let e = Entrainment::new(5.0, 5.0, 0.0);
        let loaded = law(Extent::Loaded { threshold: 50.0 });
        let p = |q: f64| q / (2.0 * 5e-5 * 0.024);
        assert_eq!(loaded.force(40.0, 40f64.ln(), p(40.0), &e), 0.0);
        assert_eq!(
            loaded.force(100.0, 100f64.ln(), p(100.0), &e),
            law(Extent::All).force(100.0, 100f64.ln(), p(100.0), &e)
        );
    }

    #[test]
    fn zero_tells_of_the_floor_only_where_there_is_a_law() {
        let fast = Entrainment::new(500.0, 500.0, 0.0);
        let loaded = law(Extent::Loaded { threshold: 50.0 });
        for law in [law(Extent::All), loaded] {
            for (p, floored) in [(3e9, true), (1e5, false)] {
                let force = law.force(1e5, 1e5f64.ln(), p, &fast);
                assert_eq!(law.is_at_floor(force, 1e5, 500.0), floored);
            }
            assert!(!law.none().is_at_floor(0.0, 1e5, 500.0));
            assert!(!law.is_at_floor(0.0, 1e5, 0.0));
        }
        assert!(!loaded.is_at_floor(0.0, 40.0, 500.0));
    }
}
