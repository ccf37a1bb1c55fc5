//! What a model knows of its bearing, in whatever space that moves: asked of the one that it has.

use super::plane::Plane;
use super::{Fault, InputValues, Layout, Model, Quantity, StateInfo};
use crate::error::Result;

/// Methods of a model that its bearing has by the same name.
macro_rules! of_bearing {
    ($($(#[$about:meta])* $name:ident($($argument:ident: $type:ty),*) $(-> $output:ty)?;)+) => {
        impl Model {
            $($(#[$about])* pub fn $name(&self $(, $argument: $type)*) $(-> $output)? {
                self.plane.$name($($argument),*)
            })+
        }
    };
}

of_bearing! {
    /// Order of the coordinates in the state vector.
    #[doc(hidden)]
    layout() -> &Layout;
    /// State vector at the start of the run.
    ///
    /// # Errors
    /// [`crate::Status::BadScene`] when no static equilibrium is found, or it leaves no room for the cage.
    initial_state() -> Result<Vec<f64>>;
    /// The state vector: positions, then velocities.
    state_infos() -> Vec<StateInfo>;
    /// What counts as one unit of error for every state: see [`Plane::state_scales`].
    #[doc(hidden)]
    state_scales() -> Vec<f64>;
    /// Names of the bodies, in the order of force reports: outer ring, inner ring, cage, elements.
    body_names() -> Vec<String>;
    /// Names of all contacts that can exist, in the order of force reports.
    contact_names() -> Vec<String>;
    /// What the elements are called in names.
    element_kind() -> &'static str;
    /// Number of rolling elements, whether they have states or not.
    element_count() -> usize;
    /// Whether the elements move freely and are rollers; otherwise their motion is prescribed.
    has_rollers() -> bool;
    /// Radius of the pitch circle, m.
    pitch_radius() -> f64;
    /// Radius of the inner raceway in m, where there are rollers.
    inner_raceway_radius() -> Option<f64>;
    /// Lengths and counts of the bearing that follow from its scene, those that it has: name, unit and meaning with the value, SI.
    geometry() -> Vec<(Quantity, f64)>;
    /// Radial guide clearance in m, if the cage is guided.
    guide_clearance() -> Option<f64>;
    /// Clearance in m of an element to the pillar before or behind it, if there are pockets.
    pocket_clearance() -> Option<f64>;
    /// Length in m that errors are measured by: see [`Plane::reference_length`].
    reference_length() -> f64;
    /// Orders and frequencies in rad/s of the waves of an elastic ring of the cage, free and at rest.
    ring_waves() -> Vec<(u32, f64)>;
    /// The laws that this scene uses, each with the largest number of contacts it can act in.
    laws_in_use() -> Vec<(&'static str, usize)>;
    /// The field of the scene by which the film of the guide can give energy to the cage, if it can.
    energy_giving_film() -> Option<String>;
    /// Orbit and spin speed of the elements without slip at these inputs, rad/s: of rollers that touch both raceways,
    /// or as prescribed.
    #[doc(hidden)]
    kinematic_speeds(inputs: &InputValues) -> [f64; 2];
    /// Highest contact frequency in rad/s: see [`Plane::contact_frequency`].
    contact_frequency() -> f64;
    /// The highest of all: contacts and waves, rad/s.
    highest_frequency() -> f64;
    /// Whether the contacts that set the highest frequency are damped.
    #[doc(hidden)]
    damped() -> bool;
    /// A fault in words.
    #[doc(hidden)]
    describe(fault: Fault) -> String;
}

impl Model {
    /// The bearing, if it moves in the plane.
    #[doc(hidden)]
    pub fn plane(&self) -> &std::sync::Arc<Plane> {
        &self.plane
    }
}
