//! Rollers, rings and cage of a scene.

use super::{ContactLaws, PlaneVector, Signal};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A set of equal, equally spaced cylindrical rollers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
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

/// The outer ring: fixed, centred at the origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OuterRing {
    /// Raceway radius R_o, m.
    pub raceway_radius: f64,
    /// Name of the material.
    pub material: String,
}

/// The inner ring with its shaft.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InnerRing {
    /// Radial internal clearance G_r (the diametral play), m; negative for preload. The raceway radius is
    /// R_i = R_o - 2 R_b - G_r/2.
    pub radial_clearance: f64,
    /// Name of the material.
    pub material: String,
    /// Rotation speed over time, rad/s; negative is clockwise.
    pub speed: Signal,
    /// Motion of the ring centre.
    pub motion: RingMotion,
}

/// Motion of the centre of the inner ring.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum RingMotion {
    /// Held at this position, m.
    Fixed(PlaneVector),
    /// Free in the plane under load and contact forces.
    Free(FreeRing),
}

/// A ring that moves in the plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FreeRing {
    /// Mass of the ring and what moves with it, kg.
    pub mass: f64,
    /// Linear damping of the ring support, N s/m. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub support_damping: Option<f64>,
    /// External load on the ring, N. Absent: none, unless the host sets one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load: Option<Load>,
}

/// External load over time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// Component to the right, N.
    pub y: Signal,
    /// Component upwards, N.
    pub z: Signal,
}

/// The cage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cage {
    /// Mass, kg.
    pub mass: f64,
    /// Moment of inertia about the centre, kg m^2.
    pub inertia: f64,
    /// Name of the material.
    pub material: String,
    /// Contacts between rollers and pockets. Absent: rollers and cage do not touch.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pocket: Option<Pocket>,
    /// Guidance by a ring. Absent: the cage is carried by the rollers alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub guide: Option<Guide>,
}

/// Cylindrical pockets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pocket {
    /// Radial clearance R_p - R_b between roller and pocket wall, m.
    pub radial_clearance: f64,
    /// Half angle phi_p of each wall about the circumferential direction, rad.
    pub half_angle: f64,
    /// Angle before the edge over which wall friction turns into edge friction, rad; 0 lets it jump.
    pub edge_blend: f64,
    /// Friction at the edges of the walls. Absent: frictionless edges.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub edge_friction: Option<EdgeFriction>,
    /// Laws of the wall contact besides elasticity.
    #[serde(default)]
    pub contact: ContactLaws,
}

/// Friction at the pocket edges.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EdgeFriction {
    /// Friction coefficient.
    pub coefficient: f64,
    /// Slip speed of the transition through zero, m/s.
    pub transition_speed: f64,
}

/// Guidance of the cage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Guide {
    /// Oil-filled guide on the ribs of the outer ring: short journal bearing with two lands.
    ShortBearing(ShortBearingGuide),
}

/// Short journal bearing between cage and outer ring ribs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShortBearingGuide {
    /// Radius R_g of the ribs, m.
    pub guide_radius: f64,
    /// Guide clearance (diametral), m.
    pub diametral_clearance: f64,
    /// Width of one of the two lands, m.
    pub land_width: f64,
    /// Whether the film is squeezed (dh/dt of the moving centre and of the turning roundness).
    #[serde(default)]
    pub squeeze: bool,
    /// Roundness of the cage. Absent: round.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub roundness: Vec<RoundnessHarmonic>,
}

/// One harmonic of the cage roundness: radius deviation amplitude * cos(order * angle + phase).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RoundnessHarmonic {
    /// Order n, at least 2.
    pub order: u32,
    /// Amplitude a_n, m.
    pub amplitude: f64,
    /// Phase b_n, rad.
    pub phase: f64,
}
