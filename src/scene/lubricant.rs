//! The lubricant of a scene: viscosity, and the constants of films and traction.

use super::{Grease, Signal};
use serde::{Deserialize, Serialize};

/// Lubricant. Only the constants that the scene's laws use are needed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
#[cfg_attr(feature = "schema", schemars(transform = named_in_catalogue))]
pub struct Lubricant {
    /// Dynamic viscosity eta0 at ambient pressure.
    pub viscosity: Viscosity,
    /// Pressure-viscosity coefficient alpha, 1/Pa. Needed by contact films, traction, rolling resistance and lubricant
    /// layers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-10, max = 1e-6)))]
    pub pressure_viscosity: Option<f64>,
    /// Temperature-viscosity coefficient beta, 1/K. Needed by thermal corrections, self-heating, rolling resistance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-4, max = 1.0)))]
    pub temperature_viscosity: Option<f64>,
    /// Thermal conductivity k', W/(m K). Needed by thermal corrections, self-heating, rolling resistance.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-3, max = 10.0)))]
    pub conductivity: Option<f64>,
    /// Characteristic (Eyring) stress tau0, Pa. Needed by traction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e4, max = 1e9)))]
    pub eyring_stress: Option<f64>,
    /// Shear modulus G_l, Pa. Needed by traction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e6, max = 1e12)))]
    pub shear_modulus: Option<f64>,
    /// What thickens the oil where it is sheared, for lubricant layers. Absent: bled oil, which nothing thickens.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grease: Option<Grease>,
}

/// What the catalogue may give is not required.
#[cfg(feature = "schema")]
fn filled_by_catalogue(schema: &mut schemars::Schema) {
    schema.remove("required");
}

/// A scene may name an oil instead, which the reader replaces by its values.
#[cfg(feature = "schema")]
fn named_in_catalogue(schema: &mut schemars::Schema) {
    filled_by_catalogue(schema);
    let text = "Name of an oil in the catalogue, whose values stand where this block gives none.";
    if let Some(properties) = schema.ensure_object().get_mut("properties") {
        properties["catalogue"] = serde_json::json!({"description": text, "type": "string"});
    }
}

/// Viscosity at inlet temperature and ambient pressure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Viscosity {
    /// Dynamic viscosity, Pa s.
    Constant(f64),
    /// From temperature by Walther's equation (ASTM D341).
    Walther(WaltherViscosity),
}

/// Viscosity from temperature: log10 log10(nu + 0.7) = A - B log10 T through two points, nu in mm^2/s, T in K.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
#[cfg_attr(feature = "schema", schemars(transform = filled_by_catalogue))]
pub struct WaltherViscosity {
    /// First point.
    pub cold: ViscosityPoint,
    /// Second point, at a higher temperature.
    pub hot: ViscosityPoint,
    /// Density rho, kg/m^3: eta0 = nu rho.
    #[cfg_attr(feature = "schema", schemars(range(min = 100.0, max = 20000.0)))]
    pub density: f64,
    /// Temperature of the lubricant. Absent: that of a lump of `heat`; a scene has one or the other.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub temperature: Option<Temperature>,
}

/// Kinematic viscosity at one temperature.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ViscosityPoint {
    /// Temperature, K.
    #[cfg_attr(feature = "schema", schemars(range(min = 150.0, max = 1000.0)))]
    pub temperature: f64,
    /// Kinematic viscosity, m^2/s.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.4e-6, max = 1.0)))]
    pub kinematic_viscosity: f64,
}

/// Temperature of the lubricant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Temperature {
    /// Function of time, K.
    OverTime(Signal),
    /// Linear between points of the speed of the inner ring, constant beyond the first and the last.
    OverSpeed {
        /// Magnitudes of the speed of the inner ring in strictly growing order, rad/s.
        speed: Vec<f64>,
        /// Temperatures at these speeds, K.
        temperature: Vec<f64>,
    },
}
