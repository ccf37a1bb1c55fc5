//! Balls of a scene, which move in space.

use super::{RadiusDeviations, Signal};
use serde::{Deserialize, Serialize};

/// A set of equally spaced balls between grooved raceways, which move in space under the forces of their contacts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Balls {
    /// Number of balls.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 1000)))]
    pub count: u32,
    /// Radius R of a ball, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0001, max = 5.0)))]
    pub radius: f64,
    /// Radius r_p of the pitch circle, m: half of the pitch diameter.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0001, max = 5.0)))]
    pub pitch_radius: f64,
    /// Mass of one ball, kg.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-07, max = 1000000.0)))]
    pub mass: f64,
    /// Name of the material.
    pub material: String,
    /// Free contact angle, at which balls just touch both grooves, rad. Either this or `inner_ring.radial_clearance`, from which that of a
    /// deep groove bearing follows. A load on the inner ring along +x closes the bearing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.5)))]
    pub contact_angle: Option<f64>,
    /// How much the radii of single balls deviate from `radius`. Absent: they are equal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius_deviations: Option<RadiusDeviations>,
    /// Drag of the mixture of air and oil in which they move. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drag: Option<BallDrag>,
}

/// Drag of a mixture of air and oil on balls: force on their centres, moment against their spin.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct BallDrag {
    /// Density of the mixture, kg/m^3: 0.5 to 10 % of that of oil are usual.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-3, max = 2000.0)))]
    pub density: f64,
    /// C_d of a sphere.
    #[serde(default = "drag_coefficient")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 10.0)))]
    pub coefficient: f64,
}

fn drag_coefficient() -> f64 {
    0.5
}

/// An inner ring that moves in space: any of its coordinates is free, held, or prescribed over time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SpatialRing {
    /// Place along the axis of the bearing, m. Absent: held at zero, as all of them.
    #[serde(default)]
    pub x: RingCoordinate,
    /// Place to the right, m.
    #[serde(default)]
    pub y: RingCoordinate,
    /// Place upwards, m.
    #[serde(default)]
    pub z: RingCoordinate,
    /// Rotation vector of the axis to the right, rad.
    #[serde(default)]
    pub tilt_y: RingCoordinate,
    /// Rotation vector of the axis upwards, rad.
    #[serde(default)]
    pub tilt_z: RingCoordinate,
    /// External load. Absent: none, unless the host sets one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load: Option<SpatialLoad>,
    /// Spring along the axis that presses the ring into the bearing. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub preload: Option<Preload>,
    /// Mass of the ring and of what moves with it, kg. Needed by motion over time where x, y or z is free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-07, max = 1000000.0)))]
    pub mass: Option<f64>,
    /// Moments of inertia of the ring and of what moves with it. Needed by motion over time where a tilt is free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia: Option<RotorInertia>,
    /// Damping of the supports for each velocity of the centre, N s/m. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1e9)))]
    pub support_damping: Option<f64>,
    /// Damping of the supports for the rate of each tilt, N m s. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1e9)))]
    pub tilt_damping: Option<f64>,
}

/// Moments of inertia of a body of revolution.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RotorInertia {
    /// About its axis, kg m^2.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-15, max = 1e6)))]
    pub polar: f64,
    /// About an axis across it through its centre, kg m^2.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-15, max = 1e6)))]
    pub transverse: f64,
}

impl SpatialRing {
    /// Load on each of its coordinates.
    pub fn loads(&self) -> [Option<&Signal>; 5] {
        self.load.as_ref().map_or([None; 5], |load| load.components().map(|(_, signal)| signal.as_ref()))
    }

    /// Its coordinates with their names: x, y, z, tilt_y, tilt_z.
    pub fn coordinates(&self) -> [(&'static str, &RingCoordinate); 5] {
        let Self { x, y, z, tilt_y, tilt_z, .. } = self;
        [("x", x), ("y", y), ("z", z), ("tilt_y", tilt_y), ("tilt_z", tilt_z)]
    }
}

/// What a coordinate of a ring does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum RingCoordinate {
    /// Moves under load and contact forces.
    Free,
    /// Held at this value, m or rad.
    Held(f64),
    /// Moved like this over time, m or rad, whatever force that takes. It must not jump.
    Prescribed(Signal),
}

impl RingCoordinate {
    /// How it is moved over time, if it is.
    pub fn prescribed(&self) -> Option<&Signal> {
        match self {
            Self::Prescribed(signal) => Some(signal),
            _ => None,
        }
    }
}

impl Default for RingCoordinate {
    fn default() -> Self {
        Self::Held(0.0)
    }
}

/// External load on a ring in space, over time.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SpatialLoad {
    /// Force along the axis of the bearing, N. Absent: none, as all of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x: Option<Signal>,
    /// Force to the right, N.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y: Option<Signal>,
    /// Force upwards, N.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub z: Option<Signal>,
    /// Moment about the axis to the right through the centre of the ring, N m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moment_y: Option<Signal>,
    /// Moment about the upward axis through the centre of the ring, N m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moment_z: Option<Signal>,
}

impl SpatialLoad {
    /// Its components with their names: x, y, z, moment_y, moment_z.
    pub fn components(&self) -> [(&'static str, &Option<Signal>); 5] {
        let Self { x, y, z, moment_y, moment_z } = self;
        [("x", x), ("y", y), ("z", z), ("moment_y", moment_y), ("moment_z", moment_z)]
    }
}

/// A spring along the axis: its force on the ring is `force` - `stiffness` x.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Preload {
    /// Force at x = 0, N.
    #[cfg_attr(feature = "schema", schemars(range(min = -1e9, max = 1e9)))]
    pub force: f64,
    /// Stiffness, N/m. Absent: zero, a force that does not change.
    #[serde(default)]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1e12)))]
    pub stiffness: f64,
}
