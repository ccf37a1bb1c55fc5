//! Cones of rollers and raceways; without them both are cylinders.
//!
//! ```text
//! gamma   inclination of the axis of a roller about the direction ahead,   beta   half angle of its cone
//! alpha = gamma + k beta   angle of a raceway,   k = 1 outer, -1 inner
//! X = C + R m on the raceway,   m_r = k cos(gamma) beside an upright roller
//! ```
//!
//! Positive angles have the large end at +x. The radii of the rings are those beside the middle of the roller.

use crate::bodies::Inclination;
use crate::scene::RollerTaper;

/// Angles of the cones of rollers and raceways.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cones {
    /// gamma.
    pub(crate) inclination: Inclination,
    /// beta, and its tangent.
    pub(crate) roller: Inclination,
    pub(crate) growth: f64,
    /// alpha of the outer and the inner raceway, and their tangents.
    pub(crate) raceways: [Inclination; 2],
    pub(crate) slopes: [f64; 2],
}

impl Cones {
    /// Cylinders.
    pub(crate) const NONE: Self = Self {
        inclination: Inclination::NONE,
        roller: Inclination::NONE,
        growth: 0.0,
        raceways: [Inclination::NONE; 2],
        slopes: [0.0; 2],
    };

    /// Those of tapered rollers, if they are.
    pub(crate) fn new(taper: Option<&RollerTaper>) -> Self {
        let Some(taper) = taper else { return Self::NONE };
        let (gamma, beta) = (taper.inclination(), taper.half_angle);
        let [roller, outer, inner] = [beta, gamma + beta, gamma - beta].map(Inclination::new);
        Self {
            inclination: Inclination::new(gamma),
            roller,
            growth: roller.sin / roller.cos,
            raceways: [outer, inner],
            slopes: [outer, inner].map(|angle| angle.sin / angle.cos),
        }
    }

    /// Place along a raceway per place along the axis of the bearing.
    pub(super) fn stretch(&self) -> f64 {
        1.0 / (self.inclination.cos * self.roller.cos)
    }
}
