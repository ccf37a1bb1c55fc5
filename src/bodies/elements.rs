//! Rolling elements: what all kinds of them have in common.

use super::{
    BodyEnergy, BodyForces, Coordinate, Fault, InputValues, Layout, OF_ELEMENT, SHARED, places::Places,
};
use crate::integrate::linear::Spoke;
use crate::scalar::{WIDEST, math};
use crate::scene::Scene;
use crate::space::{Frame, Motion, Wrench};
use pulp::Arch;
use std::f64::consts::TAU;
use std::fmt::Debug;

/// Number, size and places of the elements.
#[derive(Clone, Debug)]
pub(crate) struct ElementSet {
    pub(crate) count: usize,
    /// Radius of one, m.
    pub(crate) radius: f64,
    /// Radius of the circle of their centres, m.
    pub(crate) pitch_radius: f64,
    /// Angle from which the travel of each element counts, and of its pocket in the cage, rad.
    pub(crate) reference_angles: Vec<f64>,
    /// Their sines and cosines, in columns as long as whole groups of vector instructions need.
    pub(crate) directions: [Vec<f64>; 2],
}

impl ElementSet {
    /// Those of a scene.
    pub(super) fn new(scene: &Scene) -> Self {
        let count = scene.element_count() as usize;
        let reference_angles: Vec<f64> =
            (0..count).map(|j| scene.initial.first_roller_angle + TAU * j as f64 / count as f64).collect();
        let column = |f: fn(f64) -> f64| {
            let mut column: Vec<f64> = reference_angles.iter().map(|angle| f(*angle)).collect();
            column.resize(count.next_multiple_of(WIDEST), 0.0);
            column
        };
        let directions = [column(math::sin), column(math::cos)];
        let (radius, pitch_radius) = (scene.element_radius(), scene.pitch_radius());
        Self { count, radius, pitch_radius, reference_angles, directions }
    }
}

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
    pub(crate) fn new(elements: &dyn Elements) -> Self {
        let count = elements.set().count;
        Self {
            shared: [Motion::default(); SHARED],
            elements: vec![ElementMotion::default(); count],
            pitch_radius: elements.set().pitch_radius,
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

/// Mass in kg and moment of inertia in kg m^2 of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Inertia {
    pub(crate) mass: f64,
    pub(crate) moment: f64,
}

/// The rolling elements of a bearing, all of one kind.
pub(crate) trait Elements: Debug + Send + Sync {
    /// Number, size and places.
    fn set(&self) -> &ElementSet;

    /// What they are called in names.
    fn kind(&self) -> &'static str;

    /// Coordinates of one; none if the motion is prescribed.
    fn coordinates(&self) -> &'static [Coordinate];

    /// Inertia of one, if it moves freely.
    fn inertia(&self) -> Option<Inertia>;

    /// Orbit and spin speed without slip at these inputs, rad/s: of elements that touch both raceways, or as prescribed.
    fn kinematic_speeds(&self, inputs: &InputValues) -> [f64; 2];

    /// Orbit speed without slip per speed of the inner ring.
    fn orbit_ratio(&self) -> f64;

    /// Finds the motion of all elements, and their travel since the start, in columns.
    ///
    /// # Errors
    /// The fault of an element that has left the bearing.
    fn find(
        &self,
        layout: &Layout,
        q: &[f64],
        v: &[f64],
        inputs: &InputValues,
        out: &mut Motions,
    ) -> Result<(), Fault>;

    /// Travel of element `j` since the start and its radial offset, rad and m.
    fn travel(&self, layout: &Layout, q: &[f64], inputs: &InputValues, j: usize) -> [f64; 2];

    /// Accelerations by the wrenches on the elements, in their local frames, without the weight.
    fn accelerate(
        &self,
        layout: &Layout,
        motions: &Motions,
        on_elements: &[Wrench<f64>],
        gravity: [f64; 2],
        a: &mut [f64],
    );

    /// Makes derivatives of the wrench on element `j` over positions and velocities those of its accelerations, and adds
    /// how these change at constant wrenches. Returns the factors from forces to accelerations.
    fn slopes(
        &self,
        element: &Element,
        on_element: &Wrench<f64>,
        gravity: [f64; 2],
        over_positions: &mut Spoke,
        over_velocities: &mut Spoke,
    ) -> [f64; OF_ELEMENT];

    /// Energy of the motion and the weight of one element, if it moves freely.
    fn energy(&self, element: &Element, gravity: [f64; 2]) -> BodyEnergy;

    /// Writes the weight of an element into a report.
    fn report(&self, gravity: [f64; 2], out: &mut BodyForces);

    /// Azimuth of element `j`, rad.
    fn azimuth(&self, layout: &Layout, q: &[f64], inputs: &InputValues, j: usize) -> f64 {
        self.set().reference_angles[j] + self.travel(layout, q, inputs, j)[0]
    }

    /// Frame of element `j`.
    fn frame(&self, layout: &Layout, q: &[f64], inputs: &InputValues, j: usize) -> Frame<f64> {
        let (sin, cos) = math::sin_cos(self.azimuth(layout, q, inputs, j));
        Frame { sin, cos }
    }
}

/// Multiplies the rows of a matrix, given by its columns, by these factors.
#[inline]
pub(crate) fn scale_rows<const N: usize>(columns: &mut [[f64; N]], factors: &[f64; N]) {
    for column in columns {
        for (x, factor) in column.iter_mut().zip(factors) {
            *x *= factor;
        }
    }
}
