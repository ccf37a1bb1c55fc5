//! What usual ranges of numbers follow from: sizes and parts of a scene.

use crate::scene::check::{Range, range};
use crate::scene::*;
use std::f64::consts::TAU;

/// Speed times pitch diameter above which only special bearings run, m/min: a million mm/min for rollers. Balls go further in
/// spindles and in dental handpieces.
const FASTEST_ROLLERS: f64 = 1e3;
const FASTEST: f64 = 2.5e3;
/// Young's modulus of steel, Pa, where no material is named.
pub(super) const STEEL: f64 = 2.06e11;
/// Acceleration of gravity on earth, m/s^2.
pub(super) const EARTH: f64 = 9.81;
/// Share of the clearance by which a solid contact may give under the weight of the cage.
const SAG: f64 = 0.3;
/// Damping over the critical one.
const DAMPED: [f64; 2] = [1e-4, 20.0];

/// From hardly damped to overdamped, of a mass on a stiffness.
pub(super) fn damping(stiffness: f64, mass: f64) -> Range {
    range(DAMPED[0], DAMPED[1], "N s/m").times(2.0 * (stiffness * mass).sqrt())
}

impl Range {
    /// This many times the range.
    pub(super) fn times(self, factor: f64) -> Self {
        range(self.min * factor, self.max * factor, self.unit)
    }
}

impl Scene {
    /// Length of the elements; of balls their diameter, m.
    pub(super) fn length(&self) -> f64 {
        let given = self.kinematic_elements.as_ref().and_then(|elements| elements.effective_length);
        let given = self.rollers.as_ref().map(|rollers| rollers.effective_length).or(given);
        given.unwrap_or(2.0 * self.element_radius())
    }

    /// A groove beside its balls: 1.005 to 1.3 times as large.
    pub(super) fn groove(&self, radius: Option<f64>) -> Option<(f64, Range)> {
        Some((radius?, range(1.005, 1.3, "m").times(self.balls.as_ref()?.radius)))
    }

    pub(super) fn shoulder(&self, height: Option<f64>) -> Option<(f64, Range)> {
        Some((height?, range(0.1, 1.2, "m").times(self.balls.as_ref()?.radius)))
    }

    /// Loads of a ball bearing: up to some five times a static rating of 14 MPa Z D^2.
    pub(super) fn carried(&self) -> Range {
        range(0.0, 7e7 * f64::from(self.element_count()) * (2.0 * self.element_radius()).powi(2), "N")
    }

    pub(super) fn speeds(&self) -> Range {
        let fastest = if self.rollers.is_some() { FASTEST_ROLLERS } else { FASTEST };
        range(0.0, fastest / 60.0 * TAU / (2.0 * self.pitch_radius()), "rad/s")
    }

    pub(super) fn crowns(&self) -> Range {
        range(2.0, 1e5, "m").times(self.length())
    }

    pub(super) fn lands(&self) -> Range {
        range(0.05, 10.0, "m").times(self.element_radius())
    }

    /// Stiffnesses of solid contacts of the cage in a diametral clearance (m).
    pub(super) fn stiffnesses(&self, clearance: f64) -> Option<Range> {
        let softest = self.cage.as_ref()?.mass * EARTH / (SAG * 0.5 * clearance);
        Some(range(softest, 4.0 * STEEL * self.element_radius(), "N/m"))
    }

    pub(super) fn outer_speed(&self) -> Option<&Signal> {
        self.outer_ring.as_ref()?.speed.as_ref()
    }

    pub(super) fn plane_pocket(&self) -> Option<&PlanePocket> {
        match self.cage.as_ref()?.pocket.as_ref()? {
            Pocket::SolidPlane(pocket) => Some(pocket),
            _ => None,
        }
    }

    pub(super) fn guide(&self) -> Option<&Guide> {
        self.cage.as_ref()?.guide.as_ref()
    }

    pub(super) fn layer(&self) -> Option<&LayerFilm> {
        match self.guide()?.film.as_ref()? {
            GuideFilm::LubricantLayer(film) => Some(film),
            GuideFilm::ShortBearing(_) => None,
        }
    }

    pub(super) fn elastic(&self) -> Option<&ElasticRing> {
        self.cage.as_ref()?.elastic_ring.as_ref()
    }

    /// Growth of the elastic ring in a diametral clearance (m).
    pub(super) fn growth_in(&self, clearance: f64) -> Option<(f64, Range)> {
        let speed = self.inner_ring.as_ref().map_or(0.0, |ring| ring.speed.largest());
        Some((self.elastic()?.growth, range(0.0, clearance / (speed * speed), "m s^2")))
    }

    pub(super) fn section(&self) -> Option<&RingSection> {
        match &self.elastic()?.stiffness {
            RingStiffness::Section(section) => Some(section),
            _ => None,
        }
    }
}
