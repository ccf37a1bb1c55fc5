//! Rolling elements: what all kinds of them have in common.

mod kinematic;
mod rollers;
mod spacing;

pub(super) use kinematic::KinematicElements;
pub(super) use rollers::Rollers;
pub(crate) use spacing::Spacing;

use crate::bodies::{
    BodyEnergy, BodyForces, Coordinate, Element, ElementSet, Fault, InputValues, Layout, Motions, Moves,
    OF_ELEMENT, WrenchLanes,
};
use crate::integrate::GroupDamping;
use crate::scalar::math;
use crate::space::{Frame, Wrench};
use std::fmt::Debug;

/// Coordinates that elements have in the plane and in space.
pub(in crate::bodies) const RADIAL_OFFSET: Coordinate = Coordinate {
    position: Some(["radial_offset", "m", "distance outside the pitch circle"]),
    rate: ["radial_speed", "m/s", "rate of the radial offset"],
    moves: Moves::Itself,
};
/// See [`RADIAL_OFFSET`]: of rollers.
pub(in crate::bodies) const ORBIT_TRAVEL: Coordinate = Coordinate {
    position: Some([
        "orbit_travel",
        "rad",
        "orbit angle travelled from the centred place of its pocket at the start",
    ]),
    rate: ["orbit_speed", "rad/s", "rate of the orbit angle"],
    moves: Moves::PitchCircle,
};
/// See [`ORBIT_TRAVEL`].
pub(in crate::bodies) const SPIN_SPEED: Coordinate = Coordinate {
    position: None,
    rate: ["spin_speed", "rad/s", "rotation speed about its own axis"],
    moves: Moves::Surface,
};

/// See [`ORBIT_TRAVEL`]: of rollers that are not round.
pub(in crate::bodies) const SPIN_ANGLE: Coordinate = Coordinate {
    position: Some(["spin_angle", "rad", "angle turned about its own axis since the start"]),
    ..SPIN_SPEED
};

/// Derivatives of the wrench on one element, or of its accelerations, by columns: over its own coordinates, over those of the
/// hub, and over those of its neighbours where these touch it.
pub(crate) struct ElementSlopes<'a> {
    pub(crate) own: &'a mut [[f64; OF_ELEMENT]],
    pub(crate) over_hub: &'a mut [[f64; OF_ELEMENT]],
    pub(crate) over_neighbours: &'a mut [[f64; OF_ELEMENT]],
}

/// Damping of all elements, shared bodies and nodes.
pub(crate) type Damping = GroupDamping<OF_ELEMENT>;

/// The rolling elements of a bearing, all of one kind.
pub(crate) trait Elements: Debug + Send + Sync {
    /// Number, size and places.
    fn set(&self) -> &ElementSet;

    /// What they are called in names.
    fn kind(&self) -> &'static str;

    /// Coordinates of one; none if the motion is prescribed.
    fn coordinates(&self) -> &'static [Coordinate];

    /// Mass of one in kg, if it moves freely; otherwise its motion is prescribed.
    fn mass(&self) -> Option<f64>;

    /// Slip speed that a tangential impulse of 1 N s on its surface gives one, m/(N s^2).
    fn mobility(&self) -> f64;

    /// Centrifugal force in N on one on the pitch circle at this orbit speed in rad/s.
    fn centrifugal(&self, orbit_speed: f64) -> f64;

    /// Orbit and spin speed without slip at these inputs, rad/s: of elements that touch both raceways, or as prescribed.
    fn kinematic_speeds(&self, inputs: &InputValues) -> [f64; 2];

    /// Orbit speed without slip per speed of the outer and of the inner ring; none where it is prescribed.
    fn orbit_ratios(&self) -> [f64; 2];

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

    /// Accelerations by their weight and by the wrenches on the elements, in their local frames.
    fn accelerate(
        &self,
        layout: &Layout,
        motions: &Motions,
        on_elements: &[WrenchLanes],
        gravity: [f64; 2],
        a: &mut [f64],
    );

    /// Makes derivatives of the wrench on an element over positions and velocities those of its accelerations, and adds
    /// how these change at constant wrenches. Returns the factors from forces to accelerations.
    fn slopes(
        &self,
        element: &Element,
        on_element: &Wrench<f64>,
        gravity: [f64; 2],
        over_positions: ElementSlopes<'_>,
        over_velocities: ElementSlopes<'_>,
    ) -> [f64; OF_ELEMENT];

    /// Makes `damping` over the speeds in the local frames, in N s/m and given by its upper triangles, that of the accelerations
    /// over the rates of the coordinates, 1/s.
    fn accelerations_of(&self, motions: &Motions, damping: &mut Damping);

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

/// Places of the upper triangle of a matrix over the speeds of an element.
pub(crate) const UPPER: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

/// Multiplies the rows of a matrix, given by its columns, by these factors.
#[inline]
fn scale_rows<const N: usize>(columns: &mut [[f64; N]], factors: &[f64; N]) {
    for column in columns {
        for (x, factor) in column.iter_mut().zip(factors) {
            *x *= factor;
        }
    }
}
