//! What a cage that moves in space has beside one in the plane: inertia across its axis, pockets for balls, lands.

use super::{ContactDamping, ContactLaws, Friction, Guide, Signal, SolidContact};
use serde::{Deserialize, Serialize};

/// A cage with six coordinates: its centre, its rotation, and two tilts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SpatialCage {
    /// Moment of inertia about an axis across that of the cage through its centre of mass, kg m^2. Either this or `shape`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-15, max = 1e6)))]
    pub transverse_inertia: Option<f64>,
    /// Shape, from which this moment of inertia follows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<CageShape>,
    /// Place of the centre of mass along the axis of the cage, seen from its geometric centre, m; `cage.mass_eccentricity` has it across
    /// the axis.
    #[serde(default)]
    #[cfg_attr(feature = "schema", schemars(range(min = -0.1, max = 0.1)))]
    pub mass_offset_x: f64,
    /// Distance of the centre of an element from the pitch circle, in the pocket, beyond which it has left that, m. Absent: its radius.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-6, max = 5.0)))]
    pub pocket_height: Option<f64>,
    /// Lands beside `cage.guide`, which is one in the middle of the cage.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lands: Vec<Land>,
    /// Sides of the pockets, which stop rollers along the axis of the cage. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pocket_sides: Option<PocketSides>,
    /// External force along the axis of the bearing and moments across it. Absent: none, and no such inputs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load: Option<SpatialCageLoad>,
}

/// A ring with a pocket through it for every element.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct CageShape {
    /// Inner radius, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0001, max = 5.0)))]
    pub inner_radius: f64,
    /// Outer radius, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0001, max = 5.0)))]
    pub outer_radius: f64,
    /// Width along the axis, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0001, max = 5.0)))]
    pub width: f64,
    /// Density of the material, kg/m^3.
    #[cfg_attr(feature = "schema", schemars(range(min = 100.0, max = 20000.0)))]
    pub density: f64,
}

impl CageShape {
    /// Moment of inertia across the axis, kg m^2, with `count` round holes of this radius (m) through it outwards.
    pub fn transverse_inertia(&self, count: u32, hole: f64) -> f64 {
        let Self { inner_radius: a, outer_radius: b, width, density } = *self;
        let ring = density * std::f64::consts::PI * (b * b - a * a) * width;
        let drilled = f64::from(count) * density * std::f64::consts::PI * hole * hole * (b - a);
        // Mean squares of the place along the axis, outwards, and of a hole around.
        let (along, outwards, around) = (hole * hole / 4.0, (a * a + a * b + b * b) / 3.0, hole * hole / 4.0);
        ring * ((a * a + b * b) / 4.0 + width * width / 12.0) - drilled * (along + 0.5 * (outwards + around))
    }
}

/// Sides of the pockets of rollers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PocketSides {
    /// Play of a roller between them, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-7, max = 1e-2)))]
    pub play: f64,
    /// Laws besides elasticity, which is Hertz's.
    #[serde(default)]
    pub contact: ContactLaws,
}

/// A land: a guiding surface of the cage of its own width at its own place along the axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Land {
    /// Place of its middle along the axis of the cage, m.
    #[cfg_attr(feature = "schema", schemars(range(min = -1.0, max = 1.0)))]
    pub x: f64,
    /// Width over which its solid contact is spread, m. Absent: that of its film; without film all of it acts in the middle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-5, max = 5.0)))]
    pub width: Option<f64>,
    /// Number of slices of its solid contact, which touch one by one where the cage is tilted.
    #[serde(default = "slices")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 15)))]
    pub slices: u32,
    /// Its ring, gap and laws. A short bearing is that of this land alone, half of two.
    pub guide: Guide,
}

fn slices() -> u32 {
    3
}

/// External force along the axis and moments across it on a cage, over time; the host can take each of them over.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct SpatialCageLoad {
    /// Force along the axis of the bearing, N.
    pub force_x: Signal,
    /// Moment about the axis to the right, N m.
    pub moment_y: Signal,
    /// Moment about the upward axis, N m.
    pub moment_z: Signal,
}

impl Default for SpatialCageLoad {
    fn default() -> Self {
        let none = Signal::Constant(0.0);
        Self { force_x: none.clone(), moment_y: none.clone(), moment_z: none }
    }
}

/// Pockets that are round around the outward axis, or round all about; a slot where both clearances differ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RoundPocket {
    /// Clearance between element and both walls together along the orbit (diametral), m.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-07, max = 0.01)))]
    pub diametral_clearance: f64,
    /// The same along the axis, m. Absent: as along the orbit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-07, max = 0.01)))]
    pub axial_clearance: Option<f64>,
    /// Law of the contact.
    pub law: PocketLaw,
}

impl RoundPocket {
    /// The spring of its wall, if it has one.
    pub(crate) fn spring(&self) -> Option<&SolidContact> {
        match &self.law {
            PocketLaw::Spring(contact) => Some(contact),
            PocketLaw::Hertz(_) => None,
        }
    }
}

/// Law of the contact of a ball with the wall of its pocket.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum PocketLaw {
    /// Spring and damper.
    Spring(SolidContact),
    /// Hertz's point contact between ball and wall; for light loads, as the pocket hugs the ball.
    Hertz(HertzPocket),
}

/// Hertz's contact between ball and pocket. Needs the materials of balls and cage.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct HertzPocket {
    /// Damping. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<ContactDamping>,
    /// Friction. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<Friction>,
}

/// Start of a cage in space, beside that in the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct SpatialCageStart {
    /// Place of its centre along the axis of the bearing, m.
    #[cfg_attr(feature = "schema", schemars(range(min = -0.01, max = 0.01)))]
    pub x: f64,
    /// Its velocity, m/s.
    #[cfg_attr(feature = "schema", schemars(range(min = -100.0, max = 100.0)))]
    pub velocity_x: f64,
    /// Rotation vector of its axis to the right, rad.
    #[cfg_attr(feature = "schema", schemars(range(min = -0.1, max = 0.1)))]
    pub tilt_y: f64,
    /// The same upwards, rad.
    #[cfg_attr(feature = "schema", schemars(range(min = -0.1, max = 0.1)))]
    pub tilt_z: f64,
    /// Rate of `tilt_y`, rad/s.
    #[cfg_attr(feature = "schema", schemars(range(min = -100000.0, max = 100000.0)))]
    pub tilt_speed_y: f64,
    /// Rate of `tilt_z`, rad/s.
    #[cfg_attr(feature = "schema", schemars(range(min = -100000.0, max = 100000.0)))]
    pub tilt_speed_z: f64,
}
