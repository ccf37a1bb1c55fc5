//! The scene: what is to be simulated, as JSON text and as typed, checked data in SI units.
//!
//! What a scene does not write is not simulated. Every physical effect is an optional block of its own; the
//! doc comments here are also the descriptions in the JSON Schema.

mod balls;
mod cage;
mod cases;
mod catalogue;
mod check;
mod contact_laws;
mod elastic_ring;
mod elements;
mod grease;
pub(crate) mod heat;
mod json;
mod lubricant;
pub(crate) mod problems;
mod rings;
mod roller_space;
mod run;
mod signal;
mod spatial_cage;
mod validate;

pub use balls::{BallDrag, Balls, Preload, RingCoordinate, RotorInertia, SpatialLoad, SpatialRing};
pub use cage::{
    Cage, CageLoad, CylinderPocket, FilmShare, Friction, Guide, GuideFilm, GuideRing, GuideSolid, LayerFilm,
    PlanePocket, Pocket, PressureShear, RoundnessHarmonic, ShortBearingFilm, SolidContact,
};
pub use cases::{CASES_SCHEMA, Case, CaseSet};
pub use catalogue::catalogue;
pub(crate) use check::{bad as bad_scene, needed, shown};
pub use contact_laws::{
    BoundaryFriction, ContactDamping, ContactLaws, EllipseNodes, Extent, FilmLaw, InletSliding, Raceways,
    RollingLaw, RollingResistance, SelfHeating, ThermalCorrection, TractionLaw,
};
pub(crate) use elastic_ring::MOST_RING_ORDERS;
pub use elastic_ring::{ElasticRing, FiniteElementModes, RingSection, RingStiffness};
pub use elements::{
    DropTable, ElementMotion, KinematicElements, LogarithmicProfile, Neighbours, RadiusDeviations,
    RollerGroup, RollerProfile, RollerWaviness, Rollers,
};
pub use grease::{Grease, PolymerGrease, SoapGrease};
pub use heat::{
    BearingTorque, Conductance, ElementsShare, Heat, HeatLink, HeatNode, HeatSource, OilFlow,
    SplashedSurface, ThermalPlay,
};
pub(crate) use json::{line_of, nearest, parse_located};
pub use json::{parse_override, set_path};
pub use lubricant::{Lubricant, Temperature, Viscosity, ViscosityPoint, WaltherViscosity};
pub use rings::{
    FreeRing, InnerRing, Load, OuterRing, OuterRingMotion, PlaneMatrix, PlaneMotion, RingMotion, Rotor,
    Shaft, Support, Unbalance, WavinessHarmonic, WavinessTable,
};
pub use roller_space::{Rib, RibRing, RibSide, Ribs, RollerEnds, RollerSpace, RollerTaper, SlicesOn};
pub use run::{Auto, ErrorControl, Initial, Leapfrog, Method, Preset, Record, RingStart, Solver};
pub use signal::{Signal, SignalIntegral, interpolate, slope};
pub use spatial_cage::{
    CageShape, HertzPocket, Land, PocketLaw, PocketSides, RoundPocket, SpatialCage, SpatialCageLoad,
    SpatialCageStart,
};
pub(crate) use validate::{FORCE, MOMENT, POSITION, SPEED, TEMPERATURE, TILT, TORQUE, VELOCITY, VISCOSITY};

use crate::error::{Error, Result, Status};
use cases::CASES_NAME;
use json::{parse, typed};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Name and version of the scene format.
pub const SCENE_SCHEMA: &str = "cagedyn.scene/1";

/// A rolling bearing and the run to make with it. SI units; angles in rad; y to the right, z up, rotation
/// counter-clockwise positive; the outer ring is held with its centre at the origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Format of this file: "cagedyn.scene/1".
    pub schema: String,
    /// Free text for tables and pictures.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// Acceleration of gravity, m/s^2. Absent: no gravity.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gravity: Option<PlaneVector>,
    /// Materials by name, beside those of the catalogue.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub materials: BTreeMap<String, Material>,
    /// The lubricant. Needed by films, traction, rolling resistance and lubricated guides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lubricant: Option<Lubricant>,
    /// Cylindrical rollers that move freely in the plane. Either these, `balls` or `kinematic_elements`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rollers: Option<Rollers>,
    /// Balls that move in space. Either these, `rollers` or `kinematic_elements`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub balls: Option<Balls>,
    /// Rolling elements with prescribed motion. Either these, `rollers` or `balls`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kinematic_elements: Option<KinematicElements>,
    /// The outer ring. Needed by rollers and balls; beside kinematic elements it gives the speed of a ring that turns.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outer_ring: Option<OuterRing>,
    /// The inner ring. Needed by rollers and balls, by elements that roll on it and by a cage that it guides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inner_ring: Option<InnerRing>,
    /// A rotor on an elastic shaft whose end is the inner ring. Absent: what the ring carries is in its mass and load. Needs a ring in the plane.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotor: Option<Rotor>,
    /// Contacts between rollers or balls and raceways. Needed by both.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub raceways: Option<Raceways>,
    /// Ribs of the rings at the ends of rollers that move in space. Absent: nothing holds these along the axis but friction and pockets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ribs: Option<Ribs>,
    /// The cage. Absent: rollers without a cage; they do not touch each other. Needed by kinematic elements.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cage: Option<Cage>,
    /// Heat balance, which the viscosity follows. Absent: the lubricant has the temperature that it is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heat: Option<Heat>,
    /// Start of the run. Absent: everything centred, at kinematic speeds.
    #[serde(default)]
    pub initial: Initial,
    /// Integration method and its limits.
    #[serde(default)]
    pub solver: Solver,
    /// Length of the run and times of the records.
    pub record: Record,
}

/// A vector in the plane of the bearing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlaneVector {
    /// Component to the right.
    pub y: f64,
    /// Component upwards.
    pub z: f64,
}

/// Elastic and thermal constants of a solid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus, Pa.
    #[cfg_attr(feature = "schema", schemars(range(min = 10000000.0, max = 10000000000000.0)))]
    pub young_modulus: f64,
    /// Poisson's ratio.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 0.499)))]
    pub poisson_ratio: f64,
    /// Thermal constants; needed where self-heating is simulated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thermal: Option<ThermalMaterial>,
}

/// Thermal constants of a solid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ThermalMaterial {
    /// Thermal conductivity, W/(m K).
    #[cfg_attr(feature = "schema", schemars(range(min = 0.01, max = 10000.0)))]
    pub conductivity: f64,
    /// Density, kg/m^3.
    #[cfg_attr(feature = "schema", schemars(range(min = 10.0, max = 30000.0)))]
    pub density: f64,
    /// Specific heat capacity, J/(kg K).
    #[cfg_attr(feature = "schema", schemars(range(min = 10.0, max = 10000.0)))]
    pub specific_heat: f64,
}

impl Scene {
    /// A copy. Derived clones are inlined, and each caller would have twenty kilobytes of this one.
    #[inline(never)]
    pub(crate) fn copied(&self) -> Self {
        self.clone()
    }

    /// Reads and checks a scene.
    ///
    /// # Errors
    /// [`crate::Status::BadJson`] for syntax, types, unknown, missing or doubled fields; [`crate::Status::BadScene`] for values
    /// out of range or contradictions. The message starts with the JSON path.
    pub fn from_json(text: &str) -> Result<Self> {
        Self::from_value(&parse(text)?)
    }

    /// Reads a scene and replaces values in it: `("inner_ring.speed.constant", "-104.7")`. A value is JSON; `null`
    /// removes an optional block.
    ///
    /// # Errors
    /// As [`Scene::from_json`]; [`crate::Status::UnknownName`] for a path that leads nowhere.
    pub fn from_json_with<'a>(
        text: &str,
        overrides: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> Result<Self> {
        let mut value = parse(text)?;
        let scene = Self::from_value(&value)?;
        let mut overrides = overrides.into_iter().peekable();
        if overrides.peek().is_none() {
            return Ok(scene);
        }
        for (path, new) in overrides {
            set_path(&mut value, path, parse_override(new))?;
        }
        Self::from_value(&value)
    }

    /// Checks a scene given as a JSON value.
    ///
    /// # Errors
    /// As [`Scene::from_json`].
    pub fn from_value(value: &serde_json::Value) -> Result<Self> {
        Self::refuse_other_formats(value)?;
        let scene: Self = typed(catalogue::filled(value)?.as_ref())?;
        scene.validate()?;
        Ok(scene)
    }

    /// Refuses what is no scene, or one of another version.
    fn refuse_other_formats(value: &serde_json::Value) -> Result<()> {
        if let Some(schema) = value.get("schema").and_then(|schema| schema.as_str())
            && schema.starts_with(CASES_NAME)
        {
            let text = format!("schema: '{schema}' is a case set, not a scene; `cagedyn cases` runs it");
            return Err(Error::new(Status::BadScene, text));
        }
        check_format(value)
    }

    /// JSON text of the scene.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default()
    }
}

/// Refuses scenes of other versions of the format, before fields that only they have are found wanting.
fn check_format(value: &serde_json::Value) -> Result<()> {
    let name = SCENE_SCHEMA.trim_end_matches(char::is_numeric);
    let Some(schema) = value.get("schema").and_then(|schema| schema.as_str()) else { return Ok(()) };
    let [given, own] =
        [schema, SCENE_SCHEMA].map(|text| text.strip_prefix(name).and_then(|n| n.parse::<u64>().ok()));
    let why = match (given, own) {
        (Some(given), Some(own)) if given > own => {
            "is a newer format, which this version of the library does not know: it takes a newer one"
        }
        (Some(given), Some(own)) if given < own => "is an older format, which there has never been",
        _ => return Ok(()),
    };
    let text = format!("schema: '{schema}' {why}; read is '{SCENE_SCHEMA}'");
    Err(Error::new(Status::BadScene, text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn another_format_is_named_before_its_fields() {
        for (version, word) in [("2", "newer"), ("0", "older"), ("17", "newer")] {
            let text = format!(r#"{{"schema": "cagedyn.scene/{version}", "wheels": 4}}"#);
            let e = Scene::from_json(&text).unwrap_err();
            assert!(e.message.contains(word) && e.message.contains(SCENE_SCHEMA), "{e}");
            assert_eq!(e.status, Status::BadScene);
        }
    }
}
