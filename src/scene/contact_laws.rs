//! Optional laws of line contacts in a scene.

use serde::{Deserialize, Serialize};

/// Laws of the contacts between rollers and raceways.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Raceways {
    /// Laws besides elasticity. Normal forces of rollers follow Palmgren's line contact, of balls Hertz's ellipse.
    #[serde(default)]
    pub contact: ContactLaws,
    /// Rolling resistance of the film. Absent: off.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rolling_resistance: Option<RollingResistance>,
    /// Slices of the loaded part of one half of a contact with a profile. Absent: 8.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 2, max = 32)))]
    pub slices: Option<u32>,
    /// Places at which the stress in the ellipse of a ball is summed. Absent: `standard`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ellipse: Option<EllipseNodes>,
}

/// Places at which the stress in an ellipse is summed: strips across the race times places along each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum EllipseNodes {
    /// 8 x 2.
    Coarse,
    /// 16 x 2, of the temperature 8 x 2.
    #[default]
    Standard,
    /// 32 x 4.
    Fine,
}

/// Optional laws of a line contact.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ContactDamping {
    /// Ratio of damping to stiffness tau_c, s.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-12, max = 0.001)))]
    pub relaxation_time: f64,
    /// Approach at which half of the damping is active, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-12, max = 0.0001)))]
    pub softening_depth: f64,
}

/// Film thickness law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum FilmLaw {
    /// Central film thickness of Pan and Hamrock (1989), of rollers.
    PanHamrock,
    /// Central film thickness of Hamrock and Dowson (1977), of balls.
    HamrockDowson,
}

/// Thermal correction of the film thickness.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum ThermalCorrection {
    /// Ghosh and Pandey (1998), of rollers.
    GhoshPandey,
    /// Gupta's form, the one of the rolling resistance.
    Gupta,
}

/// Traction law of the full film.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum TractionLaw {
    /// Simplified equations of Muraki and Kimura (1983).
    MurakiKimura,
}

/// Self-heating model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum SelfHeating {
    /// Mean rise across the film plus flash rise of both surfaces.
    FilmAndFlash,
}

/// Friction in mixed and boundary lubrication.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct BoundaryFriction {
    /// Boundary friction coefficient mu_bd.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 2.0)))]
    pub coefficient: f64,
    /// Slip speed v_s of the transition through zero, m/s.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-06, max = 10.0)))]
    pub transition_speed: f64,
    /// Composite roughness sigma, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-10, max = 0.0001)))]
    pub roughness: f64,
    /// Largest film ratio of boundary lubrication L_bd.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 100.0)))]
    pub lambda_boundary: f64,
    /// Smallest film ratio of full-film lubrication L_hd.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1e3)))]
    pub lambda_full: f64,
}

/// Rolling resistance and the contacts in which it acts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RollingResistance {
    /// Law of the rolling resistance. Absent: `zhou_hoeprich` of rollers, `biboulet_houpert` of balls.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub law: Option<RollingLaw>,
    /// Contacts in which it acts.
    pub extent: Extent,
    /// Drag of the inlet on surfaces that slip. Absent: off, as in the first paper.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inlet_sliding: Option<InletSliding>,
}

/// Drag of the inlet on surfaces that slip, as a share of the rolling resistance times slip over rolling speed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct InletSliding {
    /// Share at no load, where surfaces are rigid. Absent: 0.62, from Reynolds' equation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 2.0)))]
    pub rigid_ratio: Option<f64>,
    /// Share under load, where they are elastic. Absent: 0.25.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 2.0)))]
    pub elastic_ratio: Option<f64>,
}

/// Law of the rolling resistance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum RollingLaw {
    /// Zhou and Hoeprich, for loaded contacts of rollers.
    ZhouHoeprich,
    /// The same with the limit of rigid surfaces at low load, which follows from Reynolds' equation.
    RigidLimit,
    /// Biboulet and Houpert, for contacts of balls under any load.
    BibouletHoupert,
    /// Houpert, for loaded contacts of balls.
    Houpert,
}

/// Contacts with rolling resistance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Extent {
    /// All contacts, also those that carry only the centrifugal force of the roller.
    All,
    /// Loaded contacts: fades in between the threshold and twice the threshold.
    Loaded {
        /// Contact load below which there is no rolling resistance, N.
        #[cfg_attr(feature = "schema", schemars(range(min = 1e-6, max = 1e9)))]
        threshold: f64,
    },
}
