//! What rollers that skew and tilt have beside those in the plane, and the ribs that hold them along the axis.

use super::{ContactLaws, RadiusDeviations};
use crate::scalar::math;
use serde::{Deserialize, Serialize};

/// Six freedoms of every roller: rollers shift along the axis, skew and tilt.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RollerSpace {
    /// Length L of a roller over both ends, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-5, max = 100.0)))]
    pub length: f64,
    /// Moment of inertia across its axis, kg m^2. Absent: that of a solid cylinder of its mass, radius and length.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 3e7)))]
    pub transverse_inertia: Option<f64>,
    /// Cones of tapered rollers and their raceways. Absent: cylinders.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub taper: Option<RollerTaper>,
    /// How much longer than `length` single rollers are, m, and their contact lengths as much. Absent: equal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length_deviations: Option<RadiusDeviations>,
    /// How much larger than that of the profile the drop of single rollers is at both ends of the contact length, m; it grows with the square of the distance from the
    /// middle. Absent: equal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub crown_deviations: Option<RadiusDeviations>,
    /// Shape of the ends. Needed by ribs, and by pockets with play along the axis.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ends: Option<RollerEnds>,
    /// Where the slices of the contacts with the raceways stand.
    #[serde(default, skip_serializing_if = "is_loaded")]
    pub slices_on: SlicesOn,
}

/// Tapered rollers: `rollers.radius` is that of their middle, radii of raceways are those beside it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RollerTaper {
    /// Half angle beta of the cone of a roller, rad: the +x end is the large one.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-4, max = 0.2)))]
    pub half_angle: f64,
    /// Angle of the outer raceway against the axis of the bearing, rad. That of the inner one is less by twice the half angle.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-4, max = 0.9)))]
    pub outer_raceway_angle: f64,
}

impl RollerSpace {
    /// Growth of the radius of a roller per length along its axis: zero of cylinders.
    pub(crate) fn growth(&self) -> f64 {
        let (sin, cos) = self.taper.map_or((0.0, 1.0), |taper| math::sin_cos(taper.half_angle));
        sin / cos
    }
}

impl RollerTaper {
    /// Inclination gamma of the axes of the rollers against that of the bearing, rad.
    pub fn inclination(&self) -> f64 {
        self.outer_raceway_angle - self.half_angle
    }
}

/// Ends of a roller: caps of a paraboloid.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RollerEnds {
    /// Radius R_s of the caps, m. Flat ends are caps of 10 to 50 m.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-3, max = 50.0)))]
    pub cap_radius: f64,
    /// Radius of the face of an end, that of the roller less its chamfer, m; of tapered rollers that of the large end.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-5, max = 5.0)))]
    pub face_radius: f64,
}

/// Where the slices of a contact stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum SlicesOn {
    /// On the part that is loaded.
    #[default]
    Loaded,
    /// On the whole length, for checks: energy is then conserved to round-off.
    Whole,
}

fn is_loaded(place: &SlicesOn) -> bool {
    *place == SlicesOn::Loaded
}

/// Ribs of the rings, which hold rollers by their ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Ribs {
    /// Play of a roller along the axis between two ribs of one ring, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-7, max = 1e-2)))]
    pub end_play: f64,
    /// The ribs: of an NU bearing both of the outer ring, of N both of the inner one, of NJ these of the outer ring and one of the inner ring.
    pub list: Vec<Rib>,
    /// Laws besides elasticity, which is Hertz's.
    #[serde(default)]
    pub contact: ContactLaws,
}

/// A rib.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Rib {
    /// Its ring.
    pub ring: RibRing,
    /// On which side of the rollers it is, along the axis of the bearing.
    pub side: RibSide,
    /// By which angle its cone opens away from the rollers, rad.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 0.2)))]
    pub angle: f64,
    /// Height above the raceway, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-5, max = 5.0)))]
    pub height: f64,
}

/// The ring of a rib.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum RibRing {
    /// Outer ring.
    Outer,
    /// Inner ring.
    Inner,
}

/// Side of a rib.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum RibSide {
    /// At +x.
    Positive,
    /// At -x.
    Negative,
}
