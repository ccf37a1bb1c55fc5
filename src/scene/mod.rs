//! The scene: what is to be simulated, as JSON text and as typed, checked data in SI units.
//!
//! What a scene does not write is not simulated. Every physical effect is an optional block of its own; the
//! doc comments here are also the descriptions in the JSON Schema.

mod cage;
mod cases;
mod check;
mod contact_laws;
mod elements;
mod lubricant;
mod overrides;
mod rings;
mod run;
mod signal;
mod strict;
mod validate;
mod validate_cage;

pub use cage::{
    Cage, CageLoad, CylinderPocket, FilmShare, Friction, Guide, GuideFilm, GuideRing, GuideSolid, LayerFilm,
    PlanePocket, Pocket, PressureShear, RoundnessHarmonic, ShortBearingFilm, SolidContact,
};
pub use cases::{CASES_SCHEMA, Case, CaseSet};
pub(crate) use check::{bad as bad_scene, needed};
pub use contact_laws::{
    BoundaryFriction, ContactDamping, ContactLaws, Extent, FilmLaw, Raceways, RollingResistance, SelfHeating,
    ThermalCorrection, TractionLaw,
};
pub use elements::{ElementMotion, KinematicElements, Rollers};
pub use lubricant::{Lubricant, Temperature, Viscosity, ViscosityPoint, WaltherViscosity};
pub use overrides::{parse_override, set_path};
pub use rings::{FreeRing, InnerRing, Load, OuterRing, RingMotion};
pub use run::{Auto, ErrorControl, Initial, Leapfrog, Method, Preset, Record, RingStart, Solver};
pub use signal::{Signal, SignalIntegral, interpolate, slope};
pub(crate) use validate::VISCOSITY;

use crate::error::{Error, Result, Status};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Name and version of the scene format.
pub const SCENE_SCHEMA: &str = "cagedyn.scene/1";

/// A rolling bearing and the run to make with it. SI units; angles in rad; y to the right, z up, rotation
/// counter-clockwise positive; the outer ring is fixed and centred at the origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
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
    /// Materials by name.
    #[serde(default, deserialize_with = "strict::map", skip_serializing_if = "BTreeMap::is_empty")]
    pub materials: BTreeMap<String, Material>,
    /// The lubricant. Needed by films, traction, rolling resistance and lubricated guides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lubricant: Option<Lubricant>,
    /// Cylindrical rollers that move freely. Either these or `kinematic_elements`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rollers: Option<Rollers>,
    /// Rolling elements with prescribed motion. Either these or `rollers`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kinematic_elements: Option<KinematicElements>,
    /// The outer ring. Needed by rollers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outer_ring: Option<OuterRing>,
    /// The inner ring. Needed by rollers, by elements that roll on it and by a cage that it guides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inner_ring: Option<InnerRing>,
    /// Contacts between rollers and raceways. Needed by rollers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub raceways: Option<Raceways>,
    /// The cage. Absent: rollers without a cage; they do not touch each other. Needed by kinematic elements.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cage: Option<Cage>,
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaneVector {
    /// Component to the right.
    pub y: f64,
    /// Component upwards.
    pub z: f64,
}

/// Elastic and thermal constants of a solid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus, Pa.
    pub young_modulus: f64,
    /// Poisson's ratio.
    pub poisson_ratio: f64,
    /// Thermal constants; needed where self-heating is simulated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thermal: Option<ThermalMaterial>,
}

/// Thermal constants of a solid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ThermalMaterial {
    /// Thermal conductivity, W/(m K).
    pub conductivity: f64,
    /// Density, kg/m^3.
    pub density: f64,
    /// Specific heat capacity, J/(kg K).
    pub specific_heat: f64,
}

impl Scene {
    /// Reads and checks a scene.
    ///
    /// # Errors
    /// [`Status::BadJson`] for syntax, types, unknown, missing or doubled fields; [`Status::BadScene`] for values
    /// out of range or contradictions. The message starts with the JSON path.
    pub fn from_json(text: &str) -> Result<Self> {
        let mut reader = serde_json::Deserializer::from_str(text);
        let scene: Self = serde_path_to_error::deserialize(&mut reader)
            .map_err(|e| json_error(e, serde_json::from_str(text).ok().as_ref()))?;
        reader.end().map_err(|e| Error::new(Status::BadJson, e.to_string()))?;
        strict::same_shape(text, &scene)?;
        scene.validate()?;
        Ok(scene)
    }

    /// Reads a scene and replaces values in it: `("inner_ring.speed.constant", "-104.7")`. A value is JSON; `null`
    /// removes an optional block.
    ///
    /// # Errors
    /// As [`Scene::from_json`]; [`Status::UnknownName`] for a path that leads nowhere.
    pub fn from_json_with<'a>(
        text: &str,
        overrides: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> Result<Self> {
        let scene = Self::from_json(text)?;
        let mut overrides = overrides.into_iter().peekable();
        if overrides.peek().is_none() {
            return Ok(scene);
        }
        let bad = |e: serde_json::Error| Error::new(Status::BadJson, e.to_string());
        let mut value: serde_json::Value = serde_json::from_str(text).map_err(bad)?;
        for (path, new) in overrides {
            set_path(&mut value, path, parse_override(new))?;
        }
        Self::from_value(value)
    }

    /// Checks a scene given as a JSON value.
    ///
    /// # Errors
    /// As [`Scene::from_json`].
    pub fn from_value(value: serde_json::Value) -> Result<Self> {
        let scene: Self =
            serde_path_to_error::deserialize(&value).map_err(|e| json_error(e, Some(&value)))?;
        strict::same_shape_as(&value, &scene)?;
        scene.validate()?;
        Ok(scene)
    }

    /// JSON text of the scene.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default()
    }

    /// The JSON Schema (draft 2020-12) of the scene format.
    pub fn json_schema() -> serde_json::Value {
        schemars::schema_for!(Scene).to_value()
    }
}

/// A JSON error with its dotted path in `value`, if that is JSON at all.
fn json_error(e: serde_path_to_error::Error<serde_json::Error>, value: Option<&serde_json::Value>) -> Error {
    let mut path = String::new();
    let mut place = value;
    for segment in e.path() {
        let name = segment.to_string();
        let name = name.trim_matches(['[', ']']);
        let separator = if path.is_empty() { "" } else { "." };
        path += &format!("{separator}{name}");
        place = place.and_then(|place| match name.parse::<usize>() {
            Ok(index) if place.is_array() => place.get(index),
            _ => place.get(name),
        });
    }
    let mut text = e.into_inner().to_string();
    // What serde_json says of a plain value where a choice is needed.
    if let Some(found) = place
        && (text.starts_with("expected value") || text.contains("expected string or map"))
    {
        let line = text.find(" at line").map_or("", |at| &text[at..]);
        text = format!(
            "the value {found} is of the wrong type, expected an object with one key or a word{line}"
        );
    }
    let text = text.replace("expected value", "the value is of the wrong type");
    Error::new(Status::BadJson, if path.is_empty() || path == "?" { text } else { format!("{path}: {text}") })
}
