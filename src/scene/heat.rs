//! The heat balance of a scene: temperatures of lumps, what warms them, what they give to each other.

use serde::{Deserialize, Serialize};

/// Name of the surroundings in links.
pub(crate) const AMBIENT: &str = "ambient";

/// Lumps of one temperature each, with what flows between them: `C dT/dt = P + Sum G (T_other - T)`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Heat {
    /// Temperature of the surroundings, K.
    #[cfg_attr(feature = "schema", schemars(range(min = 150.0, max = 1000.0)))]
    pub ambient: f64,
    /// The lumps.
    pub nodes: Vec<HeatNode>,
    /// What conducts between them, and to the surroundings, whose name is "ambient".
    pub links: Vec<HeatLink>,
    /// Powers of the power balance that warm them.
    pub sources: Vec<HeatSource>,
    /// Heat of elements whose motion is prescribed, from catalogue values. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bearing_torque: Option<BearingTorque>,
    /// Name of the lump whose temperature the lubricant has.
    pub lubricant: String,
    /// Names of lumps whose temperature is a state of the motion; the others keep theirs during a run.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub in_motion: Vec<String>,
    /// Time constant of the lumps in motion, s, instead of that of their capacities: the bearing is warm within a run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-3, max = 1e6)))]
    pub own_time: Option<f64>,
    /// How the radial clearance of a roller bearing follows temperatures. Absent: not at all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub play: Option<ThermalPlay>,
}

/// A lump of one temperature.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct HeatNode {
    /// Its name.
    pub name: String,
    /// Heat capacity C, J/K.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-6, max = 1e9)))]
    pub capacity: f64,
    /// Temperature at the start, K. Absent: that of the surroundings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 150.0, max = 1000.0)))]
    pub start: Option<f64>,
    /// Oil that flows through it. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub flow: Option<OilFlow>,
}

/// Oil that enters a lump, is mixed there and leaves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct OilFlow {
    /// Volume per time, m^3/s.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub rate: f64,
    /// Temperature at which it enters, K.
    #[cfg_attr(feature = "schema", schemars(range(min = 150.0, max = 1000.0)))]
    pub inlet: f64,
    /// Heat capacity rho c, J/(m^3 K).
    #[cfg_attr(feature = "schema", schemars(range(min = 1e5, max = 1e7)))]
    pub heat_capacity: f64,
}

/// Radial clearance that follows temperatures: G_r at the reference temperature T_0 plus alpha [D_o (T_o - T_0) - d_i (T_i - T_0) - 2 D_w (T_w - T_0)].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ThermalPlay {
    /// Names of the lumps of inner ring, outer ring and rollers.
    pub nodes: [String; 3],
    /// Thermal expansion alpha, 1/K.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1e-4)))]
    pub expansion: f64,
    /// Temperature T_0 at which the radial clearance is that of the inner ring, K.
    #[cfg_attr(feature = "schema", schemars(range(min = 150.0, max = 1000.0)))]
    pub reference: f64,
}

/// What conducts between two lumps, or a lump and the surroundings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct HeatLink {
    /// Names of both.
    pub between: [String; 2],
    /// How well.
    pub conductance: Conductance,
}

/// Conductance of a link.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Conductance {
    /// A number, W/K.
    Constant(f64),
    /// This many times that of all rolling elements together from ring to ring, which grows with the speed of the inner ring.
    Balls(f64),
    /// A surface in oil, by the speed of the inner ring and the viscosity.
    Splashed(SplashedSurface),
}

/// A surface that oil is splashed on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SplashedSurface {
    /// Its area, m^2.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 100.0)))]
    pub area: f64,
    /// Specific heat of the oil, J/(kg K); conductivity and density are those of the lubricant.
    #[cfg_attr(feature = "schema", schemars(range(min = 100.0, max = 1e4)))]
    pub specific_heat: f64,
}

/// A power of the power balance that warms a lump.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct HeatSource {
    /// Name of the power, such as "guide_film".
    pub power: String,
    /// Name of the lump.
    pub node: String,
    /// Share of it that goes there.
    #[serde(default = "whole")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub share: f64,
}

fn whole() -> f64 {
    1.0
}

/// Friction of a bearing from catalogue values, as heat: Palmgren's torque without load and with it, times the speed of the inner
/// ring. The viscosity is that at the mean temperature of the two lumps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct BearingTorque {
    /// f0, coefficient of the torque without load, by type of bearing and lubrication.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 100.0)))]
    pub f0: f64,
    /// f1, coefficient of the torque by load.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 0.1)))]
    pub f1: f64,
    /// Load, N.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1e9)))]
    pub load: f64,
    /// Names of the lumps of inner and outer ring.
    pub nodes: [String; 2],
    /// Share of the first of them.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub inner_share: f64,
    /// Rolling elements, and their share of the torque by load. Absent: the rings take all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub elements: Option<ElementsShare>,
    /// Name of the lump that the torque without load warms, such as the oil. Absent: the rings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub without_load: Option<String>,
}

/// The rolling elements' part of the heat.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ElementsShare {
    /// Name of their lump.
    pub node: String,
    /// Their share.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub share: f64,
}

impl Heat {
    /// Place of a lump by its name.
    pub(crate) fn node(&self, name: &str) -> Option<usize> {
        self.nodes.iter().position(|node| node.name == name)
    }

    /// Temperature of the lubricant at the start, K.
    pub(crate) fn lubricant_start(&self) -> f64 {
        let node = self.nodes.iter().find(|node| node.name == self.lubricant);
        node.and_then(|node| node.start).unwrap_or(self.ambient)
    }
}
