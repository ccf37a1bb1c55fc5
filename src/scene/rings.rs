//! Rings of a scene.

use super::{DropTable, PlaneVector, Signal, SpatialRing};
use serde::{Deserialize, Serialize};

/// The outer ring: held with its centre at the origin. It stands still unless it is given a speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct OuterRing {
    /// Rotation speed over time, rad/s; negative is clockwise. Absent: at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed: Option<Signal>,
    /// Raceway radius R_o, m. Needed by rollers, refused beside kinematic elements.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0001, max = 5.0)))]
    pub raceway_radius: Option<f64>,
    /// Radius of the crown of the raceway along the axis, m. Absent: straight. Needs rollers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-05, max = 1000000.0)))]
    pub raceway_crown_radius: Option<f64>,
    /// Table of drops of the raceway along the axis. Absent: none. Needs `rollers.space`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub raceway_drops: Option<DropTable>,
    /// Radius r_o of the groove across its length, m. Needed by balls.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0001, max = 10.0)))]
    pub groove_radius: Option<f64>,
    /// Height of the shoulder above the bottom of the groove, m. Absent: contacts are not held against it. Needs balls.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-06, max = 10.0)))]
    pub shoulder_height: Option<f64>,
    /// Waves of the raceway around the ring. Absent: round. Needs balls.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub waviness: Vec<WavinessHarmonic>,
    /// Name of the material. Needed by rollers and balls.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
}

/// One harmonic of the waves of a raceway: height amplitude * cos(order * angle + phase) towards the balls, the angle in the ring, from y
/// to z at the start.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct WavinessHarmonic {
    /// Order n. Order 1 is a race that is off the centre of its ring.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 200)))]
    pub order: u32,
    /// Amplitude a_n, m.
    #[cfg_attr(feature = "schema", schemars(range(min = -0.0001, max = 0.0001)))]
    pub amplitude: f64,
    /// Phase b_n, rad.
    #[cfg_attr(feature = "schema", schemars(range(min = -1000.0, max = 1000.0)))]
    pub phase: f64,
}

impl OuterRing {
    /// Whether it ever turns by the scene; a host may turn it where there is a `speed`.
    pub fn turns(&self) -> bool {
        self.speed.as_ref().is_some_and(|speed| *speed != Signal::Constant(0.0))
    }
}

/// The inner ring with its shaft.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct InnerRing {
    /// Rotation speed over time, rad/s; negative is clockwise.
    pub speed: Signal,
    /// Motion of the ring centre. Absent: held at the origin.
    #[serde(default)]
    pub motion: RingMotion,
    /// Radial internal clearance G_r (the diametral play), m; negative for preload. The raceway radius is
    /// R_i = R_o - 2 R_b - G_r/2. Needed by rollers, and by balls without a contact angle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = -0.0002, max = 0.002)))]
    pub radial_clearance: Option<f64>,
    /// Radius of the crown of the raceway along the axis, m. Absent: straight. Needs rollers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-05, max = 1000000.0)))]
    pub raceway_crown_radius: Option<f64>,
    /// Table of drops of the raceway along the axis. Absent: none. Needs `rollers.space`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub raceway_drops: Option<DropTable>,
    /// Radius r_i of the groove across its length, m. Needed by balls.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0001, max = 10.0)))]
    pub groove_radius: Option<f64>,
    /// Height of the shoulder above the bottom of the groove, m. Absent: contacts are not held against it. Needs balls.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-06, max = 10.0)))]
    pub shoulder_height: Option<f64>,
    /// Waves of the raceway around the ring. Absent: round. Needs balls.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub waviness: Vec<WavinessHarmonic>,
    /// Name of the material. Needed by rollers and balls.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
}

/// Motion of the centre of the inner ring.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum RingMotion {
    /// Held at this position, m.
    Fixed(PlaneVector),
    /// Free in the plane under load and contact forces. Needs rollers.
    Free(FreeRing),
    /// In space, with every coordinate by itself. Needs balls, or rollers; beside rollers in the plane it has equilibria only, and beside cylindrical ones without ribs on both rings it is held
    /// along the axis.
    Space(Box<SpatialRing>),
}

impl Default for RingMotion {
    fn default() -> Self {
        Self::Fixed(PlaneVector::default())
    }
}

/// A ring that moves in the plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct FreeRing {
    /// Mass of the ring and what moves with it, kg.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-07, max = 1000000.0)))]
    pub mass: f64,
    /// Linear damping of the ring support, N s/m. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000000000.0)))]
    pub support_damping: Option<f64>,
    /// External load on the ring, N. Absent: none, unless the host sets one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load: Option<Load>,
}

/// External load over time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// Component to the right, N.
    pub y: Signal,
    /// Component upwards, N.
    pub z: Signal,
}
