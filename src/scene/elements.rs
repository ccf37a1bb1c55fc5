//! Rolling elements of a scene: rollers that move freely, or elements whose motion is prescribed.

use super::Signal;
use serde::{Deserialize, Serialize};

/// A set of equal, equally spaced cylindrical rollers that move in the plane under the forces of their contacts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Rollers {
    /// Number of rollers.
    pub count: u32,
    /// Roller radius R_b, m.
    pub radius: f64,
    /// Effective contact length l (without chamfers), m.
    pub effective_length: f64,
    /// Mass of one roller, kg.
    pub mass: f64,
    /// Moment of inertia of one roller about its axis, kg m^2.
    pub inertia: f64,
    /// Name of the material.
    pub material: String,
}

/// A set of equal, equally spaced rolling elements on a circle, with prescribed orbit and spin. They add no states.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct KinematicElements {
    /// Number of elements.
    pub count: u32,
    /// Radius of one element, m.
    pub radius: f64,
    /// Radius of the circle of their centres, m.
    pub pitch_radius: f64,
    /// Orbit and spin.
    pub motion: ElementMotion,
    /// Name of the material. Needed by lubricated pockets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Effective contact length l, m. Needed by lubricated pockets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub effective_length: Option<f64>,
}

/// Prescribed motion of the rolling elements.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ElementMotion {
    /// Rolling without slip between the inner ring, which turns with its speed, and the outer ring at rest.
    Rolling {
        /// Contact angle, rad; 0 for a radial bearing.
        contact_angle: f64,
    },
    /// Given speeds.
    Prescribed {
        /// Speed of the centres about the bearing over time, rad/s.
        orbit_speed: Signal,
        /// Speed of each element about its own axis parallel to the bearing axis over time, rad/s.
        spin_speed: Signal,
    },
}
