//! The cage of a scene, with its pockets and its guide.

use super::{ContactLaws, ElasticRing, PlaneVector, RoundPocket, Signal, SpatialCage};
use serde::{Deserialize, Serialize};

/// The cage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Cage {
    /// Mass, kg.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-07, max = 1000000.0)))]
    pub mass: f64,
    /// Moment of inertia about the centre of mass, kg m^2.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-15, max = 1000000.0)))]
    pub inertia: f64,
    /// Name of the material. Needed by lubricated pockets.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Static unbalance: the centre of mass seen from the geometric centre in the axes of the cage, which are y and z
    /// at angle zero, m. Absent: balanced.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass_eccentricity: Option<PlaneVector>,
    /// In-plane bending of the ring of the cage. Absent: a rigid cage.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub elastic_ring: Option<ElasticRing>,
    /// External force through the geometric centre and torque over time. Absent: none, and no such inputs.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load: Option<CageLoad>,
    /// Contacts between rolling elements and pockets. Absent: they do not touch.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pocket: Option<Pocket>,
    /// Guidance by a ring. Absent: the cage is carried by the rolling elements alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub guide: Option<Guide>,
    /// Motion in space. Needed beside `balls`; beside `kinematic_elements` it gives the cage three more coordinates.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub space: Option<Box<SpatialCage>>,
}

impl Cage {
    /// Its guide in the middle and those of its lands.
    pub(super) fn guides(&self) -> impl Iterator<Item = &Guide> {
        let lands = self.space.iter().flat_map(|space| &space.lands);
        self.guide.iter().chain(lands.map(|land| &land.guide))
    }
}

/// External force and torque on the cage over time; the host can take each of them over.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct CageLoad {
    /// Force to the right, N.
    pub force_y: Signal,
    /// Force upwards, N.
    pub force_z: Signal,
    /// Torque, N m.
    pub torque: Signal,
}

impl Default for CageLoad {
    fn default() -> Self {
        let none = Signal::Constant(0.0);
        Self { force_y: none.clone(), force_z: none.clone(), torque: none }
    }
}

/// Shape of the pockets and law of their contacts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Pocket {
    /// Cylindrical walls with edges and lubricated line contacts.
    LubricatedCylinder(CylinderPocket),
    /// Plane walls across the circumference with solid contacts; in space along the axis, too.
    SolidPlane(PlanePocket),
    /// In space: round walls about the outward axis with solid contacts. They do not hold the cage outwards.
    SolidCylinder(RoundPocket),
    /// In space: walls like a sphere with solid contacts.
    SolidSphere(RoundPocket),
}

impl Pocket {
    /// Clearance of an element that is centred along the orbit, m.
    pub fn clearance(&self) -> f64 {
        match self {
            Self::LubricatedCylinder(pocket) => pocket.radial_clearance,
            Self::SolidPlane(pocket) => 0.5 * pocket.diametral_clearance,
            Self::SolidCylinder(pocket) | Self::SolidSphere(pocket) => 0.5 * pocket.diametral_clearance,
        }
    }

    /// Whether only cages in space have it.
    pub(crate) fn is_in_space(&self) -> bool {
        matches!(self, Self::SolidCylinder(_) | Self::SolidSphere(_))
    }
}

/// Cylindrical pockets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct CylinderPocket {
    /// Radial clearance R_p - R_b between roller and pocket wall, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-07, max = 0.01)))]
    pub radial_clearance: f64,
    /// Half angle phi_p of each wall about the circumferential direction, rad.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.001, max = 1.57)))]
    pub half_angle: f64,
    /// Angle before the edge over which wall friction turns into edge friction, rad; 0 lets it jump.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.57)))]
    pub edge_blend: f64,
    /// Friction at the edges of the walls. Absent: frictionless edges.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub edge_friction: Option<Friction>,
    /// Laws of the wall contact besides elasticity.
    #[serde(default)]
    pub contact: ContactLaws,
}

/// Pockets with plane walls.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlanePocket {
    /// Circumferential clearance c_p between both walls (diametral), m.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-07, max = 0.01)))]
    pub diametral_clearance: f64,
    /// In space: the same of walls along the axis. Absent: there are none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-07, max = 0.01)))]
    pub axial_clearance: Option<f64>,
    /// Contact between element and wall.
    pub contact: SolidContact,
}

/// Spring and damper in parallel (Voigt), with friction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SolidContact {
    /// Stiffness k, N/m.
    #[cfg_attr(feature = "schema", schemars(range(min = 1.0, max = 1000000000000.0)))]
    pub stiffness: f64,
    /// Damping c, N s/m.
    #[serde(default)]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000000.0)))]
    pub damping: f64,
    /// Depth delta_d over which the damper sets in, m; 0 lets it jump at touch-down.
    #[serde(default = "default_softening_depth")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 0.001)))]
    pub softening_depth: f64,
    /// Friction. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<Friction>,
}

fn default_softening_depth() -> f64 {
    1e-6
}

/// Solid friction with a smooth transition through zero slip.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Friction {
    /// Friction coefficient.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 2.0)))]
    pub coefficient: f64,
    /// Slip speed of the transition through zero, m/s.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-06, max = 10.0)))]
    pub transition_speed: f64,
}

/// Guidance of the cage by a ring. A film, a solid contact, or both with their shares.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Guide {
    /// The ring that guides.
    #[serde(default)]
    pub ring: GuideRing,
    /// Radius R_g of the guiding surface of that ring, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 10.0)))]
    pub guide_radius: f64,
    /// Guide clearance c_g (diametral), m.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-06, max = 0.01)))]
    pub diametral_clearance: f64,
    /// Roundness of the guided surface of the cage. Absent: round. Needs a film.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub roundness: Vec<RoundnessHarmonic>,
    /// Lubricant film. Absent: none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub film: Option<GuideFilm>,
    /// Solid contact. Absent: none; a film that is gone then ends the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub solid: Option<GuideSolid>,
    /// How film and solid contact share the load; needed if there are both, else not allowed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub film_share: Option<FilmShare>,
}

/// The ring that guides the cage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum GuideRing {
    /// The outer ring: the cage turns inside it.
    #[default]
    OuterRing,
    /// The inner ring: the cage turns around it and feels its speed and motion.
    InnerRing,
}

/// Lubricant film of the guide.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum GuideFilm {
    /// The clearance is full of oil: short journal bearing with two lands.
    ShortBearing(ShortBearingFilm),
    /// A layer of grease or oil on one land that fills only the narrow part of the clearance.
    LubricantLayer(LayerFilm),
}

/// Short journal bearing with two lands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ShortBearingFilm {
    /// Width of one of the two lands, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-05, max = 10.0)))]
    pub land_width: f64,
    /// Whether the film is squeezed (dh/dt of the moving centre and of the turning roundness).
    #[serde(default = "present")]
    pub squeeze: bool,
    /// Whether the pressure turns the cage, too. Without it, as in the paper, a film can give energy to a cage that whirls.
    #[serde(default = "present")]
    pub pressure_moment: bool,
}

fn present() -> bool {
    true
}

/// Lubricant layer of uniform thickness on one land. Needs the lubricant's pressure-viscosity coefficient.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct LayerFilm {
    /// Width L of the land, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-05, max = 10.0)))]
    pub land_width: f64,
    /// Thickness h_L of the layer, m. More than the diametral clearance floods the guide.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-08, max = 0.1)))]
    pub thickness: f64,
    /// Reduced pressure alpha q from which on the pressure follows its tangent and the viscosity stays constant.
    #[serde(default = "default_pressure_cap")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.1, max = 0.999)))]
    pub pressure_cap: f64,
    /// What the pressure gradient adds to the shear stress.
    #[serde(default)]
    pub pressure_shear: PressureShear,
}

/// Part of the pressure gradient in the shear stress of a lubricant layer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum PressureShear {
    /// None: the stress of the sliding surfaces alone.
    Absent,
    /// The gradient within the wet arcs, not across the jump of the pressure at their ends, as the paper reads.
    WithinArc,
    /// The gradient with that jump. Only then does the film take energy at every motion.
    #[default]
    WithEdges,
}

fn default_pressure_cap() -> f64 {
    0.9
}

/// Solid contact of the guide.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct GuideSolid {
    /// Spring, damper and friction.
    pub contact: SolidContact,
    /// Film thickness h_a at which asperities begin to touch, m. Absent: three times the roughness of `film_share`,
    /// or 0 without a film.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 0.0025)))]
    pub asperity_height: Option<f64>,
}

/// Share of the film in the guide force: 1 - exp(-1.8 L^1.2), L film ratio: smallest gap over roughness.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct FilmShare {
    /// Composite roughness sigma, m.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-09, max = 0.001)))]
    pub roughness: f64,
    /// Film ratio below which the film fades out, so that the force stays finite until the surfaces touch; 0 for the
    /// bare share.
    #[serde(default = "default_touching_ratio")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 3.0)))]
    pub touching_ratio: f64,
}

fn default_touching_ratio() -> f64 {
    0.1
}

/// One harmonic of the cage roundness: radius deviation amplitude * cos(order * angle + phase).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RoundnessHarmonic {
    /// Order n, at least 2.
    #[cfg_attr(feature = "schema", schemars(range(min = 2, max = 200)))]
    pub order: u32,
    /// Amplitude a_n, m.
    #[cfg_attr(feature = "schema", schemars(range(min = -0.005, max = 0.005)))]
    pub amplitude: f64,
    /// Phase b_n, rad.
    #[cfg_attr(feature = "schema", schemars(range(min = -1000.0, max = 1000.0)))]
    pub phase: f64,
}
