//! The compiled model: bodies, coordinates and interaction laws of a scene. Immutable, `Send` and `Sync`; any
//! number of simulations in any number of threads can share one.

mod channels;
mod compile;
mod evaluate;
mod fault;
mod forces;
mod initial;
mod inputs;
mod layout;
mod names;

pub use channels::Channel;
pub use evaluate::Workspace;
pub use fault::Fault;
pub use forces::{BodyForces, CONTACT_QUANTITIES, ContactForces, FORCE_SOURCES, Forces, Quantity};
pub use inputs::{HostInputs, INPUTS, Input, InputValues};
pub use layout::Layout;
pub use names::StateInfo;

use crate::contact::pocket::PocketGeometry;
use crate::contact::raceway::RacewayGeometry;
use crate::error::Result;
use crate::laws::line_contact::LineContact;
use crate::laws::short_bearing::ShortBearing;
use crate::laws::solid_friction::SolidFriction;
use crate::scene::Scene;
use inputs::InputSignals;

/// Ratio of velocity to position scale in the error control, 1/s: slow against contact vibration (2e5 1/s), fast
/// against the cage (1e2 1/s).
const RATE_SCALE: f64 = 1e4;

/// The inner ring.
#[derive(Clone, Copy, Debug, PartialEq)]
enum RingBody {
    /// Held at a position, m.
    Fixed([f64; 2]),
    /// Free; mass in kg, support damping in N s/m.
    Free { mass: f64, damping: f64 },
}

/// The cage and its contacts.
#[derive(Clone, Debug, PartialEq)]
struct CageBody {
    mass: f64,
    inertia: f64,
    pocket: Option<PocketLaws>,
    guide: Option<ShortBearing>,
}

/// Laws of the pocket contacts.
#[derive(Clone, Copy, Debug, PartialEq)]
struct PocketLaws {
    geometry: PocketGeometry,
    wall: LineContact,
    edge: LineContact,
    edge_friction: SolidFriction,
}

/// A compiled scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    scene: Scene,
    layout: Layout,
    /// Angle from which the travel of each roller counts, and of its pocket in the cage, rad.
    reference_angles: Vec<f64>,
    geometry: RacewayGeometry,
    roller_mass: f64,
    roller_inertia: f64,
    gravity: [f64; 2],
    outer: LineContact,
    inner: LineContact,
    ring: RingBody,
    cage: Option<CageBody>,
    inputs: InputSignals,
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

    /// Order of the coordinates in the state vector.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Number of inputs: ring speed, and the two load components if the ring is free.
    pub fn input_count(&self) -> usize {
        if self.layout.ring.is_some() { INPUTS } else { 1 }
    }

    /// Values of the inputs at time `t` in s.
    pub fn inputs_at(&self, t: f64, host: &HostInputs) -> InputValues {
        self.inputs.at(t, host)
    }

    /// The first jump or kink of an input after `t`, s; infinity if there is none.
    pub fn next_event(&self, t: f64, host: &HostInputs) -> f64 {
        self.inputs.next_event(t, host)
    }

    /// Radial guide clearance in m, if the cage is guided.
    pub fn guide_clearance(&self) -> Option<f64> {
        self.cage.as_ref()?.guide.as_ref().map(|g| g.clearance)
    }

    /// Length in m that errors are measured by: the guide clearance, else the pocket clearance, else 0.1 mm.
    pub fn reference_length(&self) -> f64 {
        let pocket = || self.cage.as_ref().and_then(|c| c.pocket.as_ref()).map(|p| p.geometry.clearance);
        self.guide_clearance().or_else(pocket).unwrap_or(1e-4)
    }

    /// Radius of the pitch circle, m.
    pub fn pitch_radius(&self) -> f64 {
        self.geometry.pitch_radius
    }

    /// Radius of the inner raceway, m.
    pub fn inner_raceway_radius(&self) -> f64 {
        self.geometry.pitch_radius - self.geometry.roller_radius - self.geometry.gap
    }

    /// Orbit speed per ring speed of a roller that touches both raceways and does not slip: R_i/(2 (R_o - R_b)).
    pub fn orbit_ratio(&self) -> f64 {
        self.inner_raceway_radius() / (2.0 * (self.geometry.pitch_radius + self.geometry.gap))
    }

    /// Spin speed per ring speed of such a roller.
    pub fn spin_ratio(&self) -> f64 {
        let g = &self.geometry;
        -self.orbit_ratio() * (g.pitch_radius + g.gap) / g.roller_radius
    }

    /// Highest contact frequency in rad/s at the largest load of the scene: of a roller between two loaded raceways,
    /// or, if one is so light, of the ring on half of the rollers or the cage between all of them.
    pub fn highest_frequency(&self) -> f64 {
        let [speed, y, z] = self.inputs.signals.each_ref().map(|s| s.largest());
        let ring_mass = match self.ring {
            RingBody::Fixed(_) => 0.0,
            RingBody::Free { mass, .. } => mass,
        };
        let weight = ring_mass * self.gravity[0].hypot(self.gravity[1]);
        let orbit = speed * self.orbit_ratio();
        let centrifugal = self.roller_mass * self.geometry.pitch_radius * orbit * orbit;
        let preload = self.inner.elastic.load(-self.geometry.gap);
        // 4.1 F/Z is the largest roller load of a line contact bearing without clearance; 1 N keeps it positive.
        let per_roller = 4.1 / (self.layout.count as f64).max(4.1);
        let q = per_roller * (y.hypot(z) + weight) + centrifugal + preload + 1.0;
        let stiffness = self.inner.elastic.stiffness_at_load(q) + self.outer.elastic.stiffness_at_load(q);
        let roller = stiffness / self.roller_mass;
        let ring = match self.ring {
            RingBody::Fixed(_) => 0.0,
            RingBody::Free { mass, .. } => {
                self.inner.elastic.stiffness_at_load(q) * 0.5 * (self.layout.count as f64).max(2.0) / mass
            }
        };
        let cage = self.cage.as_ref().map_or(0.0, |cage| {
            let pockets = cage.pocket.map_or(0.0, |p| p.wall.elastic.stiffness_at_load(q));
            let lever = self.geometry.pitch_radius;
            pockets * self.layout.count as f64 * (1.0 / cage.mass + lever * lever / cage.inertia)
        });
        roller.max(ring).max(cage).sqrt()
    }

    /// Whether the raceway contacts are damped.
    pub fn damped(&self) -> bool {
        self.inner.damping.is_some()
    }

    /// What counts as one unit of error for every state: the reference length for positions, divided by a radius
    /// for angles, times 1e4 1/s for velocities.
    pub fn state_scales(&self) -> Vec<f64> {
        let length = self.reference_length();
        let (pitch, radius) = (self.geometry.pitch_radius, self.geometry.roller_radius);
        let layout = self.layout();
        let mut positions = vec![length; layout.positions()];
        if let Some(c) = layout.cage {
            positions[c + 2] = length / pitch;
        }
        for j in 0..layout.count {
            positions[layout.roller(j) + 1] = length / pitch;
        }
        let mut scales = positions.clone();
        scales.extend(positions.iter().map(|x| x * RATE_SCALE));
        scales.extend(std::iter::repeat_n(length / radius * RATE_SCALE, layout.count));
        scales
    }
}
