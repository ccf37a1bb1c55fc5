//! Twelve bearings that other people publish, from catalogues and papers, for tests and random scenes.

mod table;

pub use table::{TWELVE, page};

use serde_json::{Value, json};
use std::f64::consts::PI;

/// Density of bearing steel, kg/m^3.
pub const STEEL: f64 = 7830.0;
/// Modulus 1/[(1 - nu^2)/E] of steel against steel, Pa, and Palmgren's factor of the approach.
const CONTACT_MODULUS: f64 = 206e9 / (1.0 - 0.3 * 0.3);
const PALMGREN: f64 = 0.39;

/// What is published of a bearing, in the units of catalogues.
#[derive(Clone, Copy, Debug)]
pub struct Bearing {
    pub name: &'static str,
    /// Bore, outside diameter, width, mm.
    pub boundary: [f64; 3],
    pub count: usize,
    pub elements: Elements,
    /// Smallest and largest radial internal clearance, um.
    pub clearance: [f64; 2],
    pub caged: bool,
    /// Static load rating, kN, where the length of the rollers follows from it.
    pub static_rating: Option<f64>,
    pub source: &'static str,
    pub assumed: &'static str,
}

/// Rolling elements with their raceways.
#[derive(Clone, Copy, Debug)]
pub enum Elements {
    /// Diameters F and E of inner and outer raceway and effective length, mm.
    Rollers { raceways: [f64; 2], length: f64 },
    /// Diameters of ball and pitch circle, mm; contact angle, degrees.
    Balls { diameter: f64, pitch: f64, contact_angle: f64 },
}

impl Bearing {
    /// The bearing of this name; the first one if there is none.
    pub fn named(name: &str) -> &'static Self {
        TWELVE.iter().find(|bearing| bearing.name == name).unwrap_or(&TWELVE[0])
    }

    /// Those with rollers.
    pub fn with_rollers() -> impl Iterator<Item = &'static Self> {
        TWELVE.iter().filter(|bearing| bearing.length().is_some())
    }

    /// Radius of an element, m.
    pub fn radius(&self) -> f64 {
        match self.elements {
            Elements::Rollers { raceways: [inner, outer], .. } => 0.25e-3 * (outer - inner),
            Elements::Balls { diameter, .. } => 0.5e-3 * diameter,
        }
    }

    /// Radius of the pitch circle of rollers without clearance, or of balls, m.
    pub fn pitch(&self) -> f64 {
        match self.elements {
            Elements::Rollers { raceways: [inner, outer], .. } => 0.25e-3 * (inner + outer),
            Elements::Balls { pitch, .. } => 0.5e-3 * pitch,
        }
    }

    /// Half the gap between neighbours on the pitch circle, m.
    pub fn free(&self) -> f64 {
        self.pitch() * (PI / self.count as f64).sin() - self.radius()
    }

    /// Effective length of rollers, m.
    pub fn length(&self) -> Option<f64> {
        match self.elements {
            Elements::Rollers { length, .. } => Some(1e-3 * length),
            Elements::Balls { .. } => None,
        }
    }

    /// Mass of an element, kg: a solid steel cylinder that is a twentieth longer than its contact, or a ball.
    pub fn element_mass(&self) -> f64 {
        let radius = self.radius();
        match self.length() {
            Some(length) => STEEL * PI * radius * radius * 1.05 * length,
            None => STEEL * 4.0 / 3.0 * PI * radius.powi(3),
        }
    }

    /// Mass of the inner ring, kg: a tube from the bore to the raceway, or the shaft in it where rollers run on that.
    pub fn ring_mass(&self) -> f64 {
        let [bore, _, width] = self.boundary.map(|mm| 1e-3 * mm);
        let (raceway, hole) = (self.pitch() - self.radius(), 0.5 * bore);
        let hole = if hole < 0.99 * raceway { hole } else { 0.0 };
        STEEL * PI * (raceway * raceway - hole * hole) * width
    }

    /// Static load rating of ISO 76 from the geometry of the rollers, N.
    pub fn static_rating(&self) -> Option<f64> {
        let (diameter, pitch) = (2e3 * self.radius(), 2e3 * self.pitch());
        Some(44.0 * (1.0 - diameter / pitch) * self.count as f64 * 1e3 * self.length()? * diameter)
    }

    /// Load of a contact of two steel bodies by Palmgren, N, at an approach in m.
    pub fn contact_load(&self, approach: f64) -> f64 {
        let length = self.length().unwrap_or(f64::NAN);
        let compliance = PALMGREN * (8.0 / CONTACT_MODULUS).powf(0.9) / length.powf(0.8);
        (approach.max(0.0) / compliance).powf(10.0 / 9.0)
    }

    /// Radial stiffness of a roller bearing without clearance, N/m, by Krämer, Dynamics of Rotors and Foundations (1993), as
    /// quoted by Friswell, Penny, Garvey and Lees, Dynamics of Rotating Machines (2010), section 5.5: k = 1e9 Z^0.9 l^0.8 F^0.1.
    pub fn kraemer_stiffness(&self, load: f64) -> f64 {
        1e9 * (self.count as f64).powf(0.9) * self.length().unwrap_or(f64::NAN).powf(0.8) * load.powf(0.1)
    }

    /// Rings and rollers with this radial internal clearance (m): `rollers`, `outer_ring` and `inner_ring` of a scene, with
    /// everything else elastic and at rest under this load (N) downwards.
    pub fn rollers_at_rest(&self, clearance: f64, load: f64) -> Value {
        let (radius, mass) = (self.radius(), self.element_mass());
        json!({
            "schema": "cagedyn.scene/1", "title": self.name,
            "materials": {"steel": {"young_modulus": 206e9, "poisson_ratio": 0.30,
                "thermal": {"conductivity": 46.0, "density": STEEL, "specific_heat": 460.0}}},
            "rollers": {
                "count": self.count, "radius": radius, "effective_length": self.length(), "mass": mass,
                "inertia": 0.5 * mass * radius * radius, "material": "steel"
            },
            "outer_ring": {"raceway_radius": self.pitch() + radius, "material": "steel"},
            "inner_ring": {
                "radial_clearance": clearance, "material": "steel", "speed": 0.0,
                "motion": {"free": {"mass": self.ring_mass(), "load": {"y": 0.0, "z": -load}}}
            },
            "raceways": {},
            "initial": {"inner_ring": "equilibrium"},
            "record": {"duration": 0.03, "interval": 1e-4}
        })
    }
}
