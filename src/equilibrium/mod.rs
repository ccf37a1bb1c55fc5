//! Equilibrium of a bearing without stepping through time: displacement of the inner ring under its load, the load of every contact, and the
//! stiffness of the bearing, exact by dual numbers.
//!
//! | file | what |
//! |---|---|
//! | `balls` | ring and balls in space, found by `model/space/rest` |
//! | `rollers` | ring and rollers in the plane |
//! | `tilting` | a ring that tilts, and rollers that do so with it |
//! | `life` | reference life of rollers |

mod balls;
mod life;
mod rollers;
mod tilting;

pub use crate::model::RaceControl;
pub use life::ReferenceLife;

use crate::bodies::{Coordinate, RING_COORDINATES};
use crate::error::{Error, Result, Status};
use crate::model::space::rest::SettledRing;
use crate::model::{Model, Quantity, quantity};
use crate::scene::shown;

/// An equilibrium. Vectors are over `coordinates`, which are those of the inner ring.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// Names, SI units and meanings of the coordinates.
    pub coordinates: Vec<Quantity>,
    /// Whether each is free, or held.
    pub free: Vec<bool>,
    /// Displacements, m and rad.
    pub displacement: Vec<f64>,
    /// Forces (N) and moments (N m) of the bearing on the ring, opposite to the load that it carries, over these coordinates: their power is that of
    /// the forces.
    pub reaction: Vec<f64>,
    /// Derivatives of the load over the displacements, row by row, N/m and its kin: those of the bearing, without those of springs.
    pub stiffness: Vec<f64>,
    /// What is known of every element.
    pub element_quantities: &'static [Quantity],
    /// Values, element by element.
    pub elements: Vec<Vec<f64>>,
    /// Names of the contacts: those of an element together.
    pub contacts: Vec<String>,
    /// What is known of every contact.
    pub contact_quantities: &'static [Quantity],
    /// Values, contact by contact.
    pub contact_values: Vec<Vec<f64>>,
    /// How the contacts of rollers that may tilt are loaded along their length; of others nothing.
    pub line_loads: LineLoads,
    /// Reference life of rollers.
    pub life: Option<ReferenceLife>,
    /// What is amiss without preventing the equilibrium, one line each.
    pub warnings: Vec<String>,
    /// Rest of the forces on the ring over their size.
    pub residual: f64,
}

/// Loads per length of all contacts at the same places along their rollers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LineLoads {
    /// From the middle of the roller along its axis, m.
    pub places: Vec<f64>,
    /// Contact by contact, place by place, N/m.
    pub values: Vec<Vec<f64>>,
}

impl Equilibrium {
    /// Load that the bearing carries, N and N m, over the coordinates: that of the scene where the ring is free, else what holds it.
    pub fn load(&self) -> Vec<f64> {
        self.reaction.iter().map(|force| -force).collect()
    }
}

/// What is said where elements have no equilibrium.
const PRESCRIBED: &str = "kinematic_elements: nothing presses on elements of prescribed motion";

/// Finds the equilibrium of a model at its start: speeds and loads are those of the scene at t = 0, balls and rollers at the azimuths
/// that they start at. Which race controls balls matters at speed only.
///
/// # Errors
/// [`crate::Status::BadState`] where there is none, or none was found, as the message says; [`crate::Status::BadScene`] of elements of
/// prescribed motion.
pub fn equilibrium(model: &Model, control: RaceControl) -> Result<Equilibrium> {
    if let Some(settled) = model.space().and_then(|space| space.settled_rollers()) {
        return Ok(tilting::told(model, &settled?));
    }
    match model.space() {
        Some(space) if !space.free => Err(Error::new(Status::BadScene, PRESCRIBED)),
        Some(space) => balls::equilibrium(space, control),
        None if model.scene().has_tilting_rollers() => tilting::equilibrium(model, model.plane()?),
        None => rollers::equilibrium(model, model.plane()?),
    }
}

/// The quantities that every element has.
const AZIMUTH: Quantity = quantity("azimuth", "rad", "angle about the axis of the bearing");
const RADIAL_OFFSET: Quantity = quantity("radial_offset", "m", "distance outside the pitch circle");
const ORBIT_SPEED: Quantity = quantity("orbit_speed", "rad/s", "speed about the axis of the bearing");
/// That of every contact.
const NORMAL_FORCE: Quantity = quantity("normal_force", "N", "normal force Q");

/// That of a ring in space, before its elements and contacts are told.
fn of_ring(ring: &SettledRing, quantities: [&'static [Quantity]; 2]) -> Equilibrium {
    let [element_quantities, contact_quantities] = quantities;
    Equilibrium {
        coordinates: named(&RING_COORDINATES),
        free: ring.held.iter().map(Option::is_none).collect(),
        displacement: ring.at.iter().copied().collect(),
        reaction: ring.forces.force.iter().copied().collect(),
        stiffness: ring.forces.stiffness.transpose().iter().copied().collect(),
        element_quantities,
        elements: Vec::new(),
        contacts: Vec::new(),
        contact_quantities,
        contact_values: Vec::new(),
        line_loads: LineLoads::default(),
        life: None,
        warnings: Vec::new(),
        residual: ring.residual,
    }
}

/// What is said of an equilibrium that the ring is pushed away from.
fn pushed_away(ring: &SettledRing) -> Option<String> {
    let (least, softest) = ring.softest;
    let text =
        format!("the ring is pushed away from this equilibrium along {softest} ({} N/m)", shown(least));
    (least < 0.0).then_some(text)
}

/// What is said of a pressure (Pa) above the static limit of its kind of bearing.
fn over_pressed(contact: &str, pressure: f64, limit: f64) -> Option<String> {
    let text = format!(
        "{contact}: the largest pressure, {} Pa, is above {limit:e} Pa, the static limit of ISO 76",
        shown(pressure)
    );
    (pressure > limit).then_some(text)
}

/// Names, units and meanings of the positions of a ring.
fn named(coordinates: &[Coordinate]) -> Vec<Quantity> {
    let positions = coordinates.iter().filter_map(|coordinate| coordinate.position);
    positions.map(|[name, unit, description]| quantity(name, unit, description)).collect()
}
