//! Rolling elements of a scene: rollers that move freely, or elements whose motion is prescribed.

use super::{ContactLaws, RollerSpace, Signal, WavinessHarmonic, WavinessTable};
use serde::{Deserialize, Serialize};

/// A set of equally spaced cylindrical rollers that move in the plane under the forces of their contacts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Rollers {
    /// Number of rollers.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 1000)))]
    pub count: u32,
    /// Roller radius R_b, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0001, max = 5.0)))]
    pub radius: f64,
    /// Effective contact length l (without chamfers), m.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-05, max = 100.0)))]
    pub effective_length: f64,
    /// Mass of one roller, kg.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-07, max = 1000000.0)))]
    pub mass: f64,
    /// Moment of inertia of one roller about its axis, kg m^2.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 30000000.0)))]
    pub inertia: f64,
    /// Name of the material.
    pub material: String,
    /// Basic dynamic radial load rating C_r of the bearing in a catalogue, N, for its life. Absent: by ISO 281.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1.0, max = 1e9)))]
    pub dynamic_load_rating: Option<f64>,
    /// Profile of the rollers along their length in the contacts with the raceways. Absent: straight.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<RollerProfile>,
    /// How much the radii of single rollers deviate from `radius`. Absent: they are equal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius_deviations: Option<RadiusDeviations>,
    /// Waves of single rollers around their axes. Absent: round. Needs rollers in the plane.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub waviness: Vec<RollerWaviness>,
    /// Contact of each roller with those beside it. Absent: rollers must not touch each other.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub neighbours: Option<Neighbours>,
    /// Freedom to shift along the axis, to skew and to tilt. Absent: rollers stay in the plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub space: Option<RollerSpace>,
}

/// Waves of rollers, which are numbered from 0 on counter-clockwise from the first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RollerWaviness {
    /// Their numbers.
    pub rollers: Vec<u32>,
    /// Waves around the axis: heights towards the raceways. Absent: none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub harmonics: Vec<WavinessHarmonic>,
    /// Measured heights around the axis, beside the harmonics. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub table: Option<WavinessTable>,
}

/// Contact of neighbouring rollers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Neighbours {
    /// Laws besides elasticity.
    #[serde(default)]
    pub contact: ContactLaws,
}

/// Deviations of the radii of rollers or balls, which are numbered from 0 on counter-clockwise from the first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum RadiusDeviations {
    /// Of every roller or ball in the order of their numbers, m.
    Each(Vec<f64>),
    /// Of groups of them; the others have none.
    Groups(Vec<RollerGroup>),
}

/// Rollers or balls whose radii deviate by the same.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RollerGroup {
    /// Their numbers.
    #[serde(alias = "balls")]
    pub rollers: Vec<u32>,
    /// By how much their radii are larger than `radius`, m.
    #[cfg_attr(feature = "schema", schemars(range(min = -1e-3, max = 1e-3)))]
    pub deviation: f64,
}

impl RadiusDeviations {
    /// Deviation of each of `count` rollers, m.
    pub(crate) fn of_each(&self, count: usize) -> Vec<f64> {
        let mut each = vec![0.0; count];
        match self {
            Self::Each(list) => each.iter_mut().zip(list).for_each(|(deviation, given)| *deviation = *given),
            Self::Groups(groups) => {
                for group in groups {
                    for &roller in &group.rollers {
                        if let Some(deviation) = each.get_mut(roller as usize) {
                            *deviation = group.deviation;
                        }
                    }
                }
            }
        }
        each
    }
}

/// Profile of a roller: how far its surface falls back from a cylinder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum RollerProfile {
    /// Logarithm of Fujiwara and Kawase, with that of Johns and Gohar and that of Lundberg as limits.
    Logarithmic(LogarithmicProfile),
    /// Circular crown over the whole length.
    CircularCrown {
        /// Radius R_c of the crown along the axis, m.
        #[cfg_attr(feature = "schema", schemars(range(min = 1e-05, max = 1000000.0)))]
        radius: f64,
    },
    /// Table of drops. Needs `rollers.space`.
    Table(DropTable),
}

/// How far a surface falls back at places along it; smooth between them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct DropTable {
    /// Places along the axis from the middle, m, growing from one end of the contact length or beyond to the other: 3 to 32.
    pub places: Vec<f64>,
    /// How far the surface lies back there, m.
    pub drops: Vec<f64>,
}

/// Logarithmic profile.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct LogarithmicProfile {
    /// Load Q of one contact that the profile is made for, N.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-3, max = 1e9)))]
    pub design_load: f64,
    /// K1, factor of this load.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-3, max = 1e3)))]
    pub load_factor: f64,
    /// K2, share of the length with the profile; the middle is straight.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.01, max = 1.0)))]
    pub crowned_share: f64,
    /// z_m, drop at the ends of the contact length, m. Absent: without limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-9, max = 1e-3)))]
    pub end_drop: Option<f64>,
}

fn one() -> f64 {
    1.0
}

fn is_one(x: &f64) -> bool {
    *x == 1.0
}

/// A set of equal, equally spaced rolling elements on a circle, with prescribed orbit and spin. They add no states.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct KinematicElements {
    /// Number of elements.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 1000)))]
    pub count: u32,
    /// Radius of one element, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0001, max = 5.0)))]
    pub radius: f64,
    /// Radius of the circle of their centres, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0001, max = 5.0)))]
    pub pitch_radius: f64,
    /// Orbit and spin.
    pub motion: ElementMotion,
    /// Name of the material. Needed by lubricated pockets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Effective contact length l, m. Needed by lubricated pockets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-05, max = 5.0)))]
    pub effective_length: Option<f64>,
}

/// Prescribed motion of the rolling elements.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ElementMotion {
    /// Rolling without slip between the inner and the outer ring, each of which turns with its speed; an outer ring without one is
    /// at rest.
    Rolling {
        /// Contact angle, rad; 0 for a radial bearing.
        #[cfg_attr(feature = "schema", schemars(range(min = -1.5, max = 1.5)))]
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
