//! The compiled model of a scene. Immutable, `Send` and `Sync`; any number of simulations in any number of threads can
//! share one.
//!
//! | file | what |
//! |---|---|
//! | `inputs`, `signals` | from the scene to inputs over time |
//! | `names`, `selection` | what models tell: names, units, channels and those that a record has |
//! | `faults`, `conditions` | faults in words; what holds at an instant beside the powers |
//! | `bearing` | what both kinds of bearings answer |
//! | `plane/` | a bearing whose bodies move in the plane |
//! | `space/` | one whose balls or rollers, ring and cage move in space |

mod bearing;
mod conditions;
mod faults;
mod feedthrough;
mod inputs;
mod names;
pub(crate) mod plane;
mod selection;
mod signals;
pub(crate) mod space;

pub use crate::bodies::{BodyForces, FAULTS, FORCE_SOURCES, Fault, FaultCounts, INPUTS, Input, POWERS};
pub(crate) use crate::bodies::{FaultKind, OF_BALL, OF_ELEMENT, Power};
#[doc(hidden)]
pub use crate::bodies::{HostInputs, InputValues, Layout};
pub(crate) use crate::pairs::Law;
pub use crate::pairs::{LAWS, LawCounts};
pub(crate) use bearing::Reading;
pub(crate) use conditions::{Condition, RATES};
pub use conditions::{STATIC_LIMIT, STATIC_LIMIT_OF_ROLLERS};
pub use names::{Channel, Energy, Quantity, StateInfo};
pub(crate) use names::{Source, quantity};
pub use plane::{CONTACT_QUANTITIES, ContactForces, FORCE_COMPONENTS, Forces, GuideReport};
#[doc(hidden)]
pub use plane::{PARTS, PartTimes, Plane, Workspace};
pub use space::rest::RaceControl;
pub use space::{
    LINE_LOAD_QUANTITIES, LineLoad, SPATIAL_CONTACT_QUANTITIES, SPATIAL_FORCE_COMPONENTS, SpatialBodyForces,
    SpatialContact, SpatialForces,
};

use crate::error::Result;
use crate::scene::Scene;
use bearing::Bearing;
use signals::InputSignals;
use space::Space;
use std::sync::Arc;

/// A compiled scene.
#[derive(Debug)]
pub struct Model {
    scene: Arc<Scene>,
    inputs: Arc<InputSignals>,
    bearing: Bearing,
    channels: Vec<Channel>,
    /// Places among the channels of those that a record has, and of those that are followed in every step.
    recorded: Vec<usize>,
    watched: Vec<usize>,
}

impl Model {
    /// Compiles a scene.
    ///
    /// # Errors
    /// [`crate::Status::BadScene`] when the scene is impossible or a law lacks a constant.
    pub fn new(scene: Scene) -> Result<Self> {
        scene.validate()?;
        let inputs = Arc::new(inputs::inputs(&scene)?);
        let scene = Arc::new(scene);
        if let Some(mut space) = Space::new(scene.clone(), inputs.clone())? {
            let channels = space.list_channels();
            let [recorded, watched] = selection::select(&scene.record, &channels)?;
            space.watch_channels(&watched, &channels);
            let bearing = Bearing::Space(Arc::new(space));
            return Ok(Self { scene, inputs, bearing, channels, recorded, watched });
        }
        let mut plane = Plane::new(scene.clone(), inputs.clone())?;
        let channels = plane.list_channels();
        let [recorded, watched] = selection::select(&scene.record, &channels)?;
        plane.watch_channels(&watched, &channels);
        Ok(Self { scene, inputs, bearing: Bearing::Plane(Arc::new(plane)), channels, recorded, watched })
    }

    /// Reads, checks and compiles a scene given as JSON text.
    ///
    /// # Errors
    /// As [`Scene::from_json`] and [`Model::new`].
    pub fn from_json(text: &str) -> Result<Self> {
        Self::new(Scene::from_json(text)?)
    }

    /// The scene this model was made from.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The output channels of this scene.
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// Places among [`Model::channels`] of those that a record of a run has.
    pub fn recorded(&self) -> &[usize] {
        &self.recorded
    }

    /// Places of the channels among [`Model::channels`] that are followed in every step.
    #[doc(hidden)]
    pub fn watched(&self) -> &[usize] {
        &self.watched
    }
}
