//! Start, integration and records of a scene.

use super::{PlaneVector, SpatialCageStart};
use serde::{Deserialize, Serialize};

/// Start of the run. Rolling elements start at kinematic speeds in the centres of their pockets.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Initial {
    /// Where a free inner ring and the rollers start.
    #[serde(default)]
    pub inner_ring: RingStart,
    /// Angle of the first rolling element, rad.
    #[serde(default)]
    #[cfg_attr(feature = "schema", schemars(range(min = -1000.0, max = 1000.0)))]
    pub first_roller_angle: f64,
    /// Centre of the cage, m, seen from the centre of the outer ring. Absent: the centre of the ring that guides it, where
    /// that ring starts, or as near to it as pockets let the cage come.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cage: Option<PlaneVector>,
    /// Velocity of the cage centre, m/s.
    #[serde(default)]
    pub cage_velocity: PlaneVector,
    /// Rotation speed of the cage, rad/s. Absent: the orbit speed of the rolling elements.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = -100000.0, max = 100000.0)))]
    pub cage_speed: Option<f64>,
    /// The rest of the start of a cage in space. Absent: upright, in the middle, at rest in these coordinates.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cage_space: Option<SpatialCageStart>,
}

/// Start of the inner ring and the radial position of the rollers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum RingStart {
    /// Ring centred (a fixed ring: at its place), rollers on the pitch circle; the load drops a free ring through
    /// the clearance.
    #[default]
    Centred,
    /// Static equilibrium of ring and rollers under the load, the weight of the ring and centrifugal force.
    Equilibrium,
}

/// How accurate a run is to be, by its purpose. Fills in every step and tolerance that the method leaves open;
/// docs/results/accuracy.md has the measured error and cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Preset {
    /// For searching: many cases, trends, the kind of motion.
    Draft,
    /// For results: statistics of rollers within their scatter, everything else to a millionth of the clearance.
    #[default]
    Engineering,
    /// For comparing: trajectories with controlled errors, also where they are chaotic.
    Reference,
}

impl Preset {
    /// All presets, from the fastest to the most accurate.
    pub const ALL: [Self; 3] = [Self::Draft, Self::Engineering, Self::Reference];

    /// Name, as in scenes.
    pub fn name(self) -> &'static str {
        match self {
            Self::Draft => "draft",
            Self::Engineering => "engineering",
            Self::Reference => "reference",
        }
    }
}

/// Integration method and limits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct Solver {
    /// How accurate, where the method leaves it open.
    pub preset: Preset,
    /// Method.
    pub method: Method,
    /// Largest step of any method, s. Absent: for methods with error control 0.1 ms; without rollers at most half the time
    /// of a contact at the highest contact frequency.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-18, max = 0.01)))]
    pub max_step: Option<f64>,
    /// Smallest step size, s; a run that needs less fails.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-18, max = 1e-06)))]
    pub min_step: f64,
    /// Largest number of attempted steps in one advance.
    #[cfg_attr(feature = "schema", schemars(range(min = 1)))]
    pub max_steps: u64,
}

impl Default for Solver {
    fn default() -> Self {
        let method = Method::Auto(Auto { tolerance: None });
        Self { preset: Preset::default(), method, max_step: None, min_step: 1e-18, max_steps: 200_000_000 }
    }
}

/// Defines [`Method`] with all methods that have error control, each with its name in scenes and its usual name.
macro_rules! methods {
    ($($(#[$doc:meta])* $variant:ident = $name:literal, $title:literal;)+) => {
        /// Integration method.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
        #[serde(rename_all = "snake_case", deny_unknown_fields)]
        pub enum Method {
            /// Chooses method and step from the scene and from what it measures while running.
            Auto(Auto),
            /// Semi-implicit leapfrog of fixed step: one force evaluation per step; the choice for statistics of long runs.
            Leapfrog(Leapfrog),
            $($(#[$doc])* #[serde(rename = $name)] $variant(ErrorControl),)+
        }

        impl Method {
            /// Name, as in scenes.
            pub fn name(&self) -> &'static str {
                match self {
                    Self::Auto(_) => "auto",
                    Self::Leapfrog(_) => "leapfrog",
                    $(Self::$variant(_) => $name,)+
                }
            }

            /// Its usual name, or what it does.
            pub fn title(&self) -> &'static str {
                match self {
                    Self::Auto(_) => "chosen while running",
                    Self::Leapfrog(_) => "leapfrog",
                    $(Self::$variant(_) => $title,)+
                }
            }

            /// The tolerance that the scene gives it, if it does.
            pub fn tolerance(&self) -> Option<f64> {
                match self {
                    Self::Auto(auto) => auto.tolerance,
                    Self::Leapfrog(_) => None,
                    $(Self::$variant(control) => control.tolerance,)+
                }
            }
        }
    };
}

methods! {
    /// Dormand-Prince 5(4) with error control: the choice for accurate trajectories.
    DormandPrince = "dormand_prince", "Dormand-Prince 5(4)";
    /// Rosenbrock method of order 4(3) on the exact derivatives, with error control: the choice for accurate
    /// trajectories of stiff scenes, such as thin films and heavy loads.
    Rosenbrock = "rosenbrock", "Rosenbrock 4(3)";
    /// Adams method of order 1 to 12 with error control: the choice for accurate trajectories of a cage that is not hit often,
    /// with one or two evaluations per step.
    Adams = "adams", "Adams 1 to 12";
    /// Radau IIA method of order 5 on the exact derivatives, with error control: the choice for extreme accuracy where
    /// films are stiff and nothing else touches.
    Radau = "radau", "Radau IIA 5";
}

/// Parameters of the choice.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Auto {
    /// Local error in units of the model's reference clearance (see docs/model.md), for accurate trajectories. Absent:
    /// by the preset, which may follow rollers in their statistics only.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-13, max = 0.1)))]
    pub tolerance: Option<f64>,
}

/// Parameters of the leapfrog.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Leapfrog {
    /// Step size, s. Absent: by the preset, in units of the highest contact frequency of the model.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-18, max = 0.001)))]
    pub step: Option<f64>,
}

/// Parameters of a method with error control.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ErrorControl {
    /// Local error in units of the model's reference clearance (see docs/model.md). Absent: by the preset.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-13, max = 0.1)))]
    pub tolerance: Option<f64>,
}

/// Length of the run and records of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// Simulated time, s.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-09, max = 100000.0)))]
    pub duration: f64,
    /// Time between records, s. It does not influence the steps.
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-10, max = 100000.0)))]
    pub interval: f64,
    /// Channels of a record, by name; `*` stands for any text, `?` for one character. Absent: all but
    /// those of the stress and losses in contacts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub channels: Option<Vec<String>>,
    /// Channels that are followed in every step: a record has their smallest and largest value, their mean and their integral
    /// since the record before. Forces, moments, gaps of the guide and distances from its centre, by name as in `channels`.
    /// Absent: all pocket forces.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub extremes: Option<Vec<String>>,
    /// Length of the window at the end of the run that results are averaged over, s. Absent: 0.1 s, or a third of a shorter
    /// run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1e-10, max = 100000.0)))]
    pub window: Option<f64>,
}

impl Record {
    /// All channels every `interval` s up to `duration` s.
    pub fn of(duration: f64, interval: f64) -> Self {
        Self { duration, interval, channels: None, extremes: None, window: None }
    }
}
