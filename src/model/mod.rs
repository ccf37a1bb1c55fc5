//! The compiled model: bodies, coordinates and interaction laws of a scene. Immutable, `Send` and `Sync`; any
//! number of simulations in any number of threads can share one.

mod batch;
mod channels;
mod compile;
mod compile_laws;
mod costs;
mod damping;
mod energy;
mod evaluate;
mod fault;
mod forces;
mod initial;
mod inputs;
mod jacobian;
mod law_columns;
mod law_slopes;
mod laws;
mod layout;
mod locate;
mod names;
mod onsets;
mod places;
mod pocket_slopes;
mod raceway_slopes;
mod scales;
mod selection;
mod step_forces;
mod watch;
mod workspace;

pub use channels::Channel;
pub use costs::{PARTS, PartTimes};
pub(crate) use energy::AT_FLOOR;
pub use energy::{Energy, POWERS};
pub use fault::{FAULTS, Fault, FaultCounts};
pub use forces::{
    BodyForces, CONTACT_QUANTITIES, ContactForces, FORCE_SOURCES, Forces, GuideReport, Quantity,
};
pub use inputs::{HostInputs, INPUTS, Input, InputValues};
pub use laws::{LAWS, LawCounts};
pub use layout::Layout;
pub use names::StateInfo;
pub use workspace::Workspace;

use crate::contact::guide::GuideSide;
use crate::contact::raceway::RacewayGeometry;
use crate::error::{Error, Result, Status};
use crate::scene::{FORCE, SPEED, Scene, TEMPERATURE, TORQUE, VISCOSITY};
use inputs::InputSignals;
use laws::Laws;
use selection::Selection;

/// The inner ring.
#[derive(Clone, Copy, Debug, PartialEq)]
enum RingBody {
    /// Held at a position, m.
    Fixed([f64; 2]),
    /// Free; mass in kg, support damping in N s/m.
    Free { mass: f64, damping: f64 },
}

/// The rolling elements.
#[derive(Clone, Debug, PartialEq)]
struct ElementSet {
    count: usize,
    /// Radius of one, m.
    radius: f64,
    /// Radius of the circle of their centres, m.
    pitch_radius: f64,
    /// Angle from which the travel of each element counts, and of its pocket in the cage, rad.
    reference_angles: Vec<f64>,
    /// Their cosines and sines.
    directions: Vec<[f64; 2]>,
    kind: ElementKind,
}

#[derive(Clone, Debug, PartialEq)]
enum ElementKind {
    Rollers(RollerSet),
    /// Their motion is prescribed.
    Kinematic,
}

/// Rollers with states of their own.
#[derive(Clone, Debug, PartialEq)]
struct RollerSet {
    geometry: RacewayGeometry,
    mass: f64,
    inertia: f64,
}

/// The cage.
#[derive(Clone, Debug, PartialEq)]
struct CageBody {
    mass: f64,
    inertia: f64,
    /// Centre of mass in the axes of the cage, m.
    mass_eccentricity: Option<[f64; 2]>,
    guide_side: GuideSide,
    guided_by_inner_ring: bool,
    /// Whether external force and torque are inputs.
    loaded: bool,
}

/// A compiled scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    scene: Scene,
    layout: Layout,
    elements: ElementSet,
    gravity: [f64; 2],
    ring: RingBody,
    cage: Option<CageBody>,
    laws: Laws,
    inputs: InputSignals,
    selection: Selection,
}

impl Model {
    /// Compiles a scene.
    ///
    /// # Errors
    /// [`crate::Status::BadScene`] when the scene is impossible or a law lacks a constant.
    pub fn new(scene: Scene) -> Result<Self> {
        scene.validate()?;
        compile::compile(scene)
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

    /// Places among [`Model::channels`] of those that a record of a run has.
    pub fn recorded(&self) -> &[usize] {
        &self.selection.recorded
    }

    /// Order of the coordinates in the state vector.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The inputs of this scene, in the order of their indices.
    pub fn input_list(&self) -> impl ExactSizeIterator<Item = Input> {
        self.inputs.list.iter().map(|(input, _)| *input)
    }

    /// Number of inputs.
    pub fn input_count(&self) -> usize {
        self.inputs.list.len()
    }

    /// Values of the inputs at time `t` in s.
    pub fn inputs_at(&self, t: f64, host: &HostInputs) -> InputValues {
        self.inputs.at(t, host)
    }

    /// Rates of the inputs at time `t` in s, per second; of `orbit_travel` too. At a jump or kink they are those after it.
    pub fn input_rates_at(&self, t: f64, host: &HostInputs) -> InputValues {
        self.inputs.rates_at(t, host)
    }

    /// Sets an input at time `t` (s) to `value`, or lets it follow the scene again with `None`.
    pub fn set_input(&self, host: &mut HostInputs, t: f64, input: Input, value: Option<f64>) {
        self.inputs.set(host, t, input, value);
    }

    /// Whether an input may have this value: those that scenes may give it.
    ///
    /// # Errors
    /// [`crate::Status::BadValue`].
    pub fn check_input(&self, input: Input, value: f64) -> Result<()> {
        let allowed = match input {
            Input::RingSpeed | Input::OrbitSpeed | Input::SpinSpeed => SPEED,
            Input::LoadY | Input::LoadZ | Input::CageForceY | Input::CageForceZ => FORCE,
            Input::CageTorque => TORQUE,
            Input::Temperature => TEMPERATURE,
        };
        allowed.check("value", value).map_err(|e| Error::new(Status::BadValue, e.message))?;
        match self.inputs.oil.filter(|_| input == Input::Temperature).map(|oil| oil.law.viscosity(value)) {
            Some(viscosity) => VISCOSITY.check("value", viscosity).map_err(|e| {
                let text =
                    format!("value: at {value:?} K the viscosity{}", e.message.trim_start_matches("value:"));
                Error::new(Status::BadValue, text)
            }),
            None => Ok(()),
        }
    }

    /// The first jump or kink of an input after `t`, s; infinity if there is none.
    pub fn next_event(&self, t: f64, host: &HostInputs) -> f64 {
        self.inputs.next_event(t, host)
    }

    /// The field of the scene by which the film of the guide can give energy to the cage, if it can.
    pub fn energy_giving_film(&self) -> Option<String> {
        let film = self.laws.guide.as_ref()?.film.as_ref()?;
        film.passive().err().map(|field| format!("cage.guide.film.{field}"))
    }

    /// Number of rolling elements, whether they have states or not.
    pub fn element_count(&self) -> usize {
        self.elements.count
    }

    /// Whether the elements move freely and are rollers; otherwise their motion is prescribed.
    pub fn has_rollers(&self) -> bool {
        matches!(self.elements.kind, ElementKind::Rollers(_))
    }

    /// Radius of the pitch circle, m.
    pub fn pitch_radius(&self) -> f64 {
        self.elements.pitch_radius
    }

    /// Radius of the inner raceway in m, where there are rollers.
    pub fn inner_raceway_radius(&self) -> Option<f64> {
        match &self.elements.kind {
            ElementKind::Rollers(rollers) => {
                let g = &rollers.geometry;
                Some(g.pitch_radius - g.roller_radius - g.gap)
            }
            ElementKind::Kinematic => None,
        }
    }

    /// Orbit and spin speed of the elements without slip at these inputs, rad/s: of rollers that touch both raceways,
    /// or as prescribed.
    pub fn kinematic_speeds(&self, inputs: &InputValues) -> [f64; 2] {
        match &self.elements.kind {
            ElementKind::Kinematic => [inputs.of(Input::OrbitSpeed), inputs.of(Input::SpinSpeed)],
            ElementKind::Rollers(rollers) => {
                let orbit = rollers.orbit_ratio() * inputs.of(Input::RingSpeed);
                let spin_ratio =
                    -rollers.orbit_ratio() * rollers.outer_centre_radius() / self.elements.radius;
                [orbit, spin_ratio * inputs.of(Input::RingSpeed)]
            }
        }
    }
}

impl RollerSet {
    /// Radius of the circle of the centres of rollers that touch the outer raceway, m.
    fn outer_centre_radius(&self) -> f64 {
        self.geometry.pitch_radius + self.geometry.gap
    }

    /// Orbit speed per ring speed of a roller that touches both raceways and does not slip: R_i/(2 (R_o - R_b)).
    fn orbit_ratio(&self) -> f64 {
        let g = &self.geometry;
        (g.pitch_radius - g.roller_radius - g.gap) / (2.0 * self.outer_centre_radius())
    }
}
