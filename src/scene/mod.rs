//! The scene: what is to be simulated, as JSON text and as typed, checked data in SI units.
//!
//! What a scene does not write is not simulated. Every physical effect is an optional block of its own; the
//! doc comments here are also the descriptions in the JSON Schema.

mod cases;
mod check;
mod overrides;
mod signal;
mod strict;
mod validate;

pub use cases::{CASES_SCHEMA, Case, CaseSet};
pub(crate) use check::{bad as bad_scene, needed};
pub use overrides::{parse_override, set_path};
pub use signal::Signal;

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
    #[serde(deserialize_with = "strict::map")]
    pub materials: BTreeMap<String, Material>,
    /// The lubricant. Needed by films, traction, rolling resistance and lubricated guides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lubricant: Option<Lubricant>,
    /// The cylindrical rollers.
    pub rollers: Rollers,
    /// The outer ring.
    pub outer_ring: OuterRing,
    /// The inner ring.
    pub inner_ring: InnerRing,
    /// Contacts between rollers and raceways.
    pub raceways: Raceways,
    /// The cage. Absent: rollers without a cage; they do not touch each other.
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

/// Lubricant at inlet temperature. Only the constants that the scene's laws use are needed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lubricant {
    /// Dynamic viscosity eta0 at inlet temperature and ambient pressure, Pa s.
    pub viscosity: f64,
    /// Pressure-viscosity coefficient alpha, 1/Pa. Needed by films, traction and rolling resistance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pressure_viscosity: Option<f64>,
    /// Temperature-viscosity coefficient beta, 1/K. Needed by thermal corrections, self-heating, rolling resistance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub temperature_viscosity: Option<f64>,
    /// Thermal conductivity k', W/(m K). Needed by thermal corrections, self-heating, rolling resistance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub conductivity: Option<f64>,
    /// Characteristic (Eyring) stress tau0, Pa. Needed by traction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub eyring_stress: Option<f64>,
    /// Shear modulus G_l, Pa. Needed by traction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shear_modulus: Option<f64>,
}

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

/// Laws of the contacts between rollers and raceways.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Raceways {
    /// Laws besides elasticity. Normal forces follow Palmgren's line contact.
    #[serde(default)]
    pub contact: ContactLaws,
    /// Rolling resistance of the film (Zhou and Hoeprich). Absent: off.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rolling_resistance: Option<RollingResistance>,
}

/// Optional laws of a line contact.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactLaws {
    /// Damping of the normal motion. Absent: elastic impacts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<ContactDamping>,
    /// Film thickness law. Absent: no film; then neither traction nor boundary friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub film: Option<FilmLaw>,
    /// Thermal correction of the film thickness. Absent: isothermal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thermal_correction: Option<ThermalCorrection>,
    /// Traction of the full film. Absent: frictionless film.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub traction: Option<TractionLaw>,
    /// Self-heating of the traction film. Absent: traction at inlet temperature.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub self_heating: Option<SelfHeating>,
    /// Friction of mixed and boundary lubrication. Absent: full film at any thickness.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub boundary_friction: Option<BoundaryFriction>,
}

/// Normal damping proportional to contact stiffness.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactDamping {
    /// Ratio of damping to stiffness tau_c, s.
    pub relaxation_time: f64,
    /// Approach at which half of the damping is active, m.
    pub softening_depth: f64,
}

/// Film thickness law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FilmLaw {
    /// Central film thickness of Pan and Hamrock (1989).
    PanHamrock,
}

/// Thermal correction of the film thickness.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ThermalCorrection {
    /// Ghosh and Pandey (1998).
    GhoshPandey,
    /// Gupta's form, the one of the rolling resistance.
    Gupta,
}

/// Traction law of the full film.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TractionLaw {
    /// Simplified equations of Muraki and Kimura (1983).
    MurakiKimura,
}

/// Self-heating model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SelfHeating {
    /// Mean rise across the film plus flash rise of both surfaces.
    FilmAndFlash,
}

/// Friction in mixed and boundary lubrication.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoundaryFriction {
    /// Boundary friction coefficient mu_bd.
    pub coefficient: f64,
    /// Slip speed v_s of the transition through zero, m/s.
    pub transition_speed: f64,
    /// Composite roughness sigma, m.
    pub roughness: f64,
    /// Largest film ratio of boundary lubrication L_bd.
    pub lambda_boundary: f64,
    /// Smallest film ratio of full-film lubrication L_hd.
    pub lambda_full: f64,
}

/// Rolling resistance and the contacts in which it acts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RollingResistance {
    /// Contacts in which it acts.
    pub extent: Extent,
}

/// Contacts with rolling resistance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Extent {
    /// All contacts, also those that carry only the centrifugal force of the roller.
    All,
    /// Loaded contacts: fades in between the threshold and twice the threshold.
    Loaded {
        /// Contact load below which there is no rolling resistance, N.
        threshold: f64,
    },
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

/// Start of the run. Rollers start at kinematic speeds in the centres of their pockets.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Initial {
    /// Where the inner ring and the rollers start.
    #[serde(default)]
    pub inner_ring: RingStart,
    /// Angle of the first roller, rad.
    #[serde(default)]
    pub first_roller_angle: f64,
    /// Centre of the cage, m.
    #[serde(default)]
    pub cage: PlaneVector,
}

/// Start of the inner ring and the radial position of the rollers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum RingStart {
    /// Ring centred (a fixed ring: at its place), rollers on the pitch circle; the load drops a free ring through
    /// the clearance.
    #[default]
    Centred,
    /// Static equilibrium of ring and rollers under the load, the weight of the ring and centrifugal force.
    Equilibrium,
}

/// Integration method and limits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Solver {
    /// Method.
    pub method: Method,
    /// Smallest step size, s; a run that needs less fails.
    pub min_step: f64,
    /// Largest number of attempted steps in one advance.
    pub max_steps: u64,
}

impl Default for Solver {
    fn default() -> Self {
        Self { method: Method::Leapfrog(Leapfrog { step: None }), min_step: 1e-12, max_steps: 200_000_000 }
    }
}

/// Integration method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Method {
    /// Semi-implicit leapfrog of fixed step: one force evaluation per step; the choice for statistics of long runs.
    Leapfrog(Leapfrog),
    /// Dormand-Prince 5(4) with error control: the choice for accurate trajectories.
    DormandPrince(DormandPrince),
}

/// Parameters of the leapfrog.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Leapfrog {
    /// Step size, s. Absent: chosen from the highest contact frequency of the model.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub step: Option<f64>,
}

/// Parameters of the Dormand-Prince method.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DormandPrince {
    /// Local error in units of the model's reference clearance (see docs/model.md); 1e-5 suits most scenes.
    pub tolerance: f64,
}

/// Length of the run and times of the records.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// Simulated time, s.
    pub duration: f64,
    /// Time between records, s. It does not influence the steps.
    pub interval: f64,
}

impl Scene {
    /// Reads and checks a scene.
    ///
    /// # Errors
    /// [`Status::BadJson`] for syntax, types, unknown, missing or doubled fields; [`Status::BadScene`] for values
    /// out of range or contradictions. The message starts with the JSON path.
    pub fn from_json(text: &str) -> Result<Self> {
        let mut reader = serde_json::Deserializer::from_str(text);
        let scene: Self = serde_path_to_error::deserialize(&mut reader).map_err(json_error)?;
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
        let scene: Self = serde_path_to_error::deserialize(&value).map_err(json_error)?;
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

/// A JSON error with its dotted path.
fn json_error(e: serde_path_to_error::Error<serde_json::Error>) -> Error {
    let mut path = String::new();
    for segment in e.path() {
        let name = segment.to_string();
        let separator = if path.is_empty() { "" } else { "." };
        path += &format!("{separator}{}", name.trim_matches(['[', ']']));
    }
    // What serde_json says of a plain value where an object or a word is needed.
    let text = e.into_inner().to_string().replace("expected value", "the value is of the wrong type");
    Error::new(Status::BadJson, if path.is_empty() || path == "?" { text } else { format!("{path}: {text}") })
}
