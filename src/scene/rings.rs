//! Rings of a scene.

use super::{DropTable, PlaneVector, Scene, Signal, SpatialRing};
use serde::{Deserialize, Serialize};

/// The outer ring. It is held with its centre at the origin and stands still unless it is given a motion or a speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct OuterRing {
    /// Rotation speed over time, rad/s; negative is clockwise. Absent: at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed: Option<Signal>,
    /// Motion of the ring centre. Absent: held at the origin. Needs rollers in the plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<OuterRingMotion>,
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
    /// Waves of the raceway around the ring. Absent: round. Needs balls, or rollers in the plane.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub waviness: Vec<WavinessHarmonic>,
    /// Measured heights of the raceway around the ring, beside `waviness`. Absent: none. Needs balls, or rollers in the plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub waviness_table: Option<WavinessTable>,
    /// Name of the material. Needed by rollers and balls.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
}

/// One harmonic of the waves of a raceway or a roller: height amplitude * cos(order * angle + phase) towards the mate, the angle in the
/// body, from y to z at the start.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct WavinessHarmonic {
    /// Order n. Order 1 is a surface that is off the centre of its body.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 200)))]
    pub order: u32,
    /// Amplitude a_n, m.
    #[cfg_attr(feature = "schema", schemars(range(min = -0.0001, max = 0.0001)))]
    pub amplitude: f64,
    /// Phase b_n, rad.
    #[cfg_attr(feature = "schema", schemars(range(min = -1000.0, max = 1000.0)))]
    pub phase: f64,
}

/// Heights over the angle in a body, smooth between them and around: a measured roundness, or a local defect such as a spall.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct WavinessTable {
    /// Angles, rad, growing, within one turn, from y to z at the start: 4 to 4096.
    pub angles: Vec<f64>,
    /// Heights there towards the mate, m.
    pub heights: Vec<f64>,
}

impl OuterRing {
    /// Whether its raceway has waves.
    pub(crate) fn wavy(&self) -> bool {
        !self.waviness.is_empty() || self.waviness_table.is_some()
    }

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
    /// Waves of the raceway around the ring. Absent: round. Needs balls, or rollers in the plane.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub waviness: Vec<WavinessHarmonic>,
    /// Measured heights of the raceway around the ring, beside `waviness`. Absent: none. Needs balls, or rollers in the plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub waviness_table: Option<WavinessTable>,
    /// Name of the material. Needed by rollers and balls.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
}

impl InnerRing {
    /// Whether its raceway has waves.
    pub(crate) fn wavy(&self) -> bool {
        !self.waviness.is_empty() || self.waviness_table.is_some()
    }
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
    /// Moved in the plane like this, or by the host, whatever force that takes.
    Prescribed(PlaneMotion),
    /// In space, with every coordinate by itself. Needs balls, or rollers; beside rollers in the plane it has equilibria only, and beside cylindrical ones without ribs on both rings it is held
    /// along the axis.
    Space(Box<SpatialRing>),
}

impl Default for RingMotion {
    fn default() -> Self {
        Self::Fixed(PlaneVector::default())
    }
}

impl Scene {
    /// What the outer ring does, if it is not held.
    pub fn outer_motion(&self) -> Option<&OuterRingMotion> {
        self.outer_ring.as_ref()?.motion.as_ref()
    }

    /// The outer ring, if it moves freely.
    pub fn free_outer_ring(&self) -> Option<&FreeRing> {
        match self.outer_motion()? {
            OuterRingMotion::Free(ring) => Some(ring),
            OuterRingMotion::Prescribed(_) => None,
        }
    }

    /// The inner ring, if it moves freely in the plane.
    pub fn free_inner_ring(&self) -> Option<&FreeRing> {
        match &self.inner_ring.as_ref()?.motion {
            RingMotion::Free(ring) => Some(ring),
            RingMotion::Fixed(_) | RingMotion::Prescribed(_) | RingMotion::Space(_) => None,
        }
    }
}

/// Motion of the centre of the outer ring.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum OuterRingMotion {
    /// Free in the plane on its support, under load and contact forces.
    Free(FreeRing),
    /// Moved in the plane like this, or by the host, whatever force that takes.
    Prescribed(PlaneMotion),
}

/// Place of a centre in the plane over time. It must not jump.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlaneMotion {
    /// To the right, m.
    pub y: Signal,
    /// Upwards, m.
    pub z: Signal,
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
    /// What holds the ring elastically at the origin, such as a housing or a shaft. Absent: nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub support: Option<Support>,
    /// Unbalance of what turns with the ring. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unbalance: Option<Unbalance>,
    /// External load on the ring, N. Absent: none, unless the host sets one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load: Option<Load>,
}

/// A support of a ring: force -K x - C x' on it at the place x, and the mass M of what moves with it beside the mass of the ring.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Support {
    /// K, N/m. What it has beside a symmetric matrix stores no energy.
    pub stiffness: PlaneMatrix,
    /// C, N s/m. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<PlaneMatrix>,
    /// M, kg, symmetric. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass: Option<PlaneMatrix>,
}

/// A matrix over the directions to the right (y) and upwards (z).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlaneMatrix {
    /// Row y, column y.
    pub yy: f64,
    /// Row y, column z. Absent: zero.
    #[serde(default)]
    pub yz: f64,
    /// Row z, column y. Absent: zero.
    #[serde(default)]
    pub zy: f64,
    /// Row z, column z.
    pub zz: f64,
}

impl PlaneMatrix {
    /// Its rows.
    pub fn rows(&self) -> [[f64; 2]; 2] {
        [[self.yy, self.yz], [self.zy, self.zz]]
    }
}

/// A rotor on an elastic shaft whose end is the inner ring: a disc that moves in the plane and turns with the ring. One that is rigid is
/// mass and unbalance of the ring itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Rotor {
    /// Its mass, or that which this bearing carries, kg.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-07, max = 1000000.0)))]
    pub mass: f64,
    /// The shaft between it and the inner ring.
    pub shaft: Shaft,
    /// Damping to the ground, N s/m. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000000000.0)))]
    pub damping: Option<f64>,
    /// Its unbalance. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unbalance: Option<Unbalance>,
    /// External load on it, N. Absent: none, unless the host sets one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load: Option<Load>,
}

/// An elastic shaft.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Shaft {
    /// Stiffness between its ends, N/m.
    #[cfg_attr(feature = "schema", schemars(range(min = 1.0, max = 1e13)))]
    pub stiffness: f64,
    /// Damping within it, which turns with it, N s/m. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000000000.0)))]
    pub internal_damping: Option<f64>,
}

/// Mass off the centre of a ring or a rotor, which turns with it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Unbalance {
    /// Mass times its distance from the centre, kg m.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
    pub moment: f64,
    /// Its direction at the start, counter-clockwise from y, rad. Absent: zero.
    #[serde(default)]
    #[cfg_attr(feature = "schema", schemars(range(min = -1000.0, max = 1000.0)))]
    pub phase: f64,
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
