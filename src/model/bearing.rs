//! What a model knows of its bearing, in whatever space that moves: asked of the one that it has.

use super::plane::{CONTACT_QUANTITIES, FORCE_COMPONENTS, Plane};
use super::space::{SPATIAL_CONTACT_QUANTITIES, SPATIAL_FORCE_COMPONENTS, Space};
use super::{Channel, Fault, InputValues, Layout, Model, Quantity, Source, StateInfo, plane, space};
use crate::error::{Error, Result, Status};
use std::sync::Arc;

/// A bearing by the space in which it moves.
#[derive(Debug)]
pub(super) enum Bearing {
    Plane(Arc<Plane>),
    Space(Arc<Space>),
}

/// A state with what its channels show of it.
pub(crate) enum Reading<'a> {
    Plane(plane::Reading<'a>),
    Space(space::Reading<'a>),
}

impl Reading<'_> {
    /// Value of a channel of the same model.
    pub(crate) fn value(&self, channel: &Channel) -> f64 {
        match (self, channel.source) {
            (Self::Plane(reading), Source::Plane(source)) => reading.value(source),
            (Self::Space(reading), Source::Space(source)) => reading.value(source),
            _ => f64::NAN,
        }
    }
}

/// Methods of a model that its bearing has by the same name.
macro_rules! of_bearing {
    ($($(#[$about:meta])* $name:ident($($argument:ident: $type:ty),*) $(-> $output:ty)?;)+) => {
        impl Model {
            $($(#[$about])* pub fn $name(&self $(, $argument: $type)*) $(-> $output)? {
                match &self.bearing {
                    Bearing::Plane(bearing) => bearing.$name($($argument),*),
                    Bearing::Space(bearing) => bearing.$name($($argument),*),
                }
            })+
        }
    };
}

of_bearing! {
    /// Order of the coordinates in the state vector.
    #[doc(hidden)]
    layout() -> &Layout;
    /// The state vector: positions, then velocities.
    state_infos() -> Vec<StateInfo>;
    /// What counts as one unit of error for every state: see [`Plane::state_scales`].
    #[doc(hidden)]
    state_scales() -> Vec<f64>;
    /// Names of the bodies, in the order of force reports: outer ring, inner ring, cage, elements.
    body_names() -> Vec<String>;
    /// Names of all contacts that can exist, in the order of force reports.
    contact_names() -> Vec<String>;
    /// A fault in words.
    #[doc(hidden)]
    describe(fault: Fault) -> String;
    /// What the elements are called in names.
    element_kind() -> &'static str;
    /// Number of rolling elements, whether they have states or not.
    element_count() -> usize;
    /// Whether the elements move freely and are rollers; otherwise their motion is prescribed.
    has_rollers() -> bool;
    /// Radius of the pitch circle, m.
    pitch_radius() -> f64;
    /// Lengths and counts of the bearing that follow from its scene, those that it has: name, unit and meaning with the value, SI.
    geometry() -> Vec<(Quantity, f64)>;
    /// Length in m that errors are measured by: see [`Plane::reference_length`].
    reference_length() -> f64;
    /// The laws that this scene uses, each with the largest number of contacts it can act in.
    laws_in_use() -> Vec<(&'static str, usize)>;
    /// Orbit and spin speed of the elements without slip at these inputs, rad/s: of rollers that touch both raceways,
    /// or as prescribed.
    #[doc(hidden)]
    kinematic_speeds(inputs: &InputValues) -> [f64; 2];
    /// State vector at the start of the run.
    ///
    /// # Errors
    /// [`crate::Status::BadScene`] when no static equilibrium is found, it leaves no room for the cage, or a free coordinate has no
    /// inertia; [`crate::Status::BadState`] when balls find none.
    initial_state() -> Result<Vec<f64>>;
    /// Highest contact frequency in rad/s: see [`Plane::contact_frequency`].
    contact_frequency() -> f64;
    /// The highest of all: contacts and waves, rad/s.
    highest_frequency() -> f64;
    /// Orders and frequencies in rad/s of the waves of an elastic ring of the cage, free and at rest.
    ring_waves() -> Vec<(u32, f64)>;
    /// Whether the contacts that set the highest frequency are damped.
    #[doc(hidden)]
    damped() -> bool;
}

impl Model {
    /// The bearing, if it moves in the plane.
    ///
    /// # Errors
    /// [`Status::BadScene`] of one in space.
    #[doc(hidden)]
    pub fn plane(&self) -> Result<&Arc<Plane>> {
        match &self.bearing {
            Bearing::Plane(plane) => Ok(plane),
            Bearing::Space(space) => {
                let text = match space.free {
                    true => {
                        "balls: this is for elements whose motion is prescribed, or rollers, in the plane"
                    }
                    false => "cage.space: this is for bearings that move in the plane only",
                };
                Err(Error::new(Status::BadScene, text))
            }
        }
    }

    /// The same before it is shared.
    #[cfg(test)]
    pub(in crate::model) fn plane_mut(&mut self) -> &mut Plane {
        match &mut self.bearing {
            Bearing::Plane(plane) => Arc::get_mut(plane).unwrap(),
            Bearing::Space(_) => unreachable!(),
        }
    }

    fn in_plane(&self) -> Option<&Plane> {
        match &self.bearing {
            Bearing::Plane(plane) => Some(plane),
            Bearing::Space(_) => None,
        }
    }

    /// The bearing, if it moves in space.
    pub(crate) fn space(&self) -> Option<&Arc<Space>> {
        match &self.bearing {
            Bearing::Plane(_) => None,
            Bearing::Space(space) => Some(space),
        }
    }

    /// Whether elements roll under load on raceways, whose contacts keep steps short.
    pub fn rolls(&self) -> bool {
        self.has_rollers() || self.space().is_some_and(|space| space.free)
    }

    /// Radius of the inner raceway in m, where there are rollers.
    pub fn inner_raceway_radius(&self) -> Option<f64> {
        self.in_plane().and_then(|plane| plane.inner_raceway_radius())
    }

    /// Radial guide clearance in m, if the cage is guided.
    pub fn guide_clearance(&self) -> Option<f64> {
        match &self.bearing {
            Bearing::Plane(plane) => plane.guide_clearance(),
            Bearing::Space(space) => space.guide_clearance(),
        }
    }

    /// Clearance in m of an element to the pillar before or behind it, if there are pockets.
    pub fn pocket_clearance(&self) -> Option<f64> {
        match &self.bearing {
            Bearing::Plane(plane) => plane.pocket_clearance(),
            Bearing::Space(space) => space.pocket_clearance(),
        }
    }

    /// The field of the scene by which the film of the guide can give energy to the cage, if it can.
    pub fn energy_giving_film(&self) -> Option<String> {
        match &self.bearing {
            Bearing::Plane(plane) => plane.energy_giving_film(),
            Bearing::Space(space) => space.energy_giving_film(),
        }
    }

    /// What force reports have of every contact.
    pub fn contact_quantities(&self) -> &'static [Quantity] {
        match &self.bearing {
            Bearing::Plane(_) => &CONTACT_QUANTITIES,
            Bearing::Space(_) => &SPATIAL_CONTACT_QUANTITIES,
        }
    }

    /// Components of the forces on bodies.
    pub fn force_components(&self) -> &'static [Quantity] {
        match &self.bearing {
            Bearing::Plane(_) => &FORCE_COMPONENTS,
            Bearing::Space(_) => &SPATIAL_FORCE_COMPONENTS,
        }
    }
}
