//! Motion of all bodies at one state: what pairs see of them.

mod element_set;
mod places;

pub(crate) use element_set::ElementSet;

use super::SHARED;
use super::layout::OF_ELEMENT;
use crate::space::{Frame, Motion, Wrench};
use places::Places;
use pulp::Arch;

/// Motion of one element in cylindrical coordinates about the centre of the bearing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct ElementMotion<T> {
    /// rho, radial offset from the pitch circle, m.
    pub(crate) radial_offset: T,
    /// Radial speed, m/s.
    pub(crate) radial_speed: T,
    /// Orbit speed psi_dot, rad/s.
    pub(crate) orbit_speed: T,
    /// Spin speed w_b, rad/s.
    pub(crate) spin_speed: T,
}

/// One element: its motion and where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Element {
    pub(crate) motion: ElementMotion<f64>,
    /// Axes along its radius and across it.
    pub(crate) frame: Frame<f64>,
    /// r = r_p + rho, m.
    pub(crate) radius: f64,
}

impl Element {
    /// Speeds in the local frame, m/s and rad/s, that are these rates of the coordinates: radial, across, spin.
    #[inline]
    pub(crate) fn local_speeds(&self, [radial, orbit, spin]: [f64; OF_ELEMENT]) -> [f64; OF_ELEMENT] {
        [radial, self.radius * orbit, spin]
    }

    /// Power of a wrench in the local frame, W.
    pub(crate) fn power(&self, wrench: &Wrench<f64>) -> f64 {
        let m = &self.motion;
        let speeds = self.local_speeds([m.radial_speed, m.orbit_speed, m.spin_speed]);
        wrench.components().iter().zip(speeds).map(|(force, speed)| force * speed).sum()
    }
}

/// Motion of all bodies at one state: all that pairs see of them.
#[derive(Clone, Debug)]
pub(crate) struct Motions {
    /// Of the shared bodies.
    pub(crate) shared: [Motion<f64>; SHARED],
    /// Of the elements.
    pub(crate) elements: Vec<ElementMotion<f64>>,
    /// r_p, m.
    pitch_radius: f64,
    /// What pairs need of all elements at once, in columns.
    pub(crate) places: Places,
    /// Vector instructions of this machine.
    pub(crate) instructions: Arch,
}

impl Motions {
    /// Memory for the motion of these elements.
    pub(crate) fn new(set: &ElementSet) -> Self {
        let count = set.count;
        Self {
            shared: [Motion::default(); SHARED],
            elements: vec![ElementMotion::default(); count],
            pitch_radius: set.pitch_radius,
            places: Places::new(count),
            instructions: Arch::new(),
        }
    }

    /// Axes of element `j`.
    #[inline]
    pub(crate) fn frame(&self, j: usize) -> Frame<f64> {
        self.places.frame(j)
    }

    /// Element `j`.
    #[inline]
    pub(crate) fn element(&self, j: usize) -> Element {
        let motion = self.elements[j];
        Element { motion, frame: self.frame(j), radius: self.pitch_radius + motion.radial_offset }
    }
}
