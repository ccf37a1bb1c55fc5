//! A bearing whose bodies move in the plane: composes what bodies and pairs say of themselves, by the same code for all of them.
//!
//! | file | what |
//! |---|---|
//! | `compile` | from the scene to bodies and pairs |
//! | `evaluate`, `workspace` | forces and accelerations |
//! | `linearize` | their exact derivatives |
//! | `nodes` | rates of states that are no motion |
//! | `integration/` | what integrators need: damping, forces of a semi-implicit step, onsets, units of errors, costs |
//! | `works` | energies, powers |
//! | `initial`, `still` | start of a run, equilibrium of ring and rollers |
//! | `report/` | names, force reports, channels, what is followed in every step |

mod compile;
mod evaluate;
mod initial;
mod integration;
mod inverse_inertia;
mod linearize;
mod nodes;
mod report;
mod still;
#[cfg(test)]
mod tests;
mod works;
mod workspace;

pub(in crate::model) use integration::costs::shortest;
pub use integration::costs::{PARTS, PartTimes};
pub use report::{CONTACT_QUANTITIES, ContactForces, FORCE_COMPONENTS, Forces, GuideReport};
pub(crate) use report::{Reading, Source};
pub(crate) use still::StillBearing;
pub use workspace::Workspace;

use super::signals::InputSignals;
use super::{Fault, HostInputs, Input, InputValues, Layout};
use crate::bodies::{
    CAGE, CAGE_MOTION, Elements, ForceSource, Node, OUTER_RING, SHARED, SharedBodies, SharedBody,
};
use crate::pairs::raceway::{Cones, RacewayGeometry};
use crate::pairs::{ContactLaw, ElementPair, Law, PairInfo, SharedInfo, SharedPair};
use crate::scene::Scene;
use crate::space::Motion;
use report::Watch;
use std::ops::Range;
use std::sync::Arc;

/// A bearing in the plane.
#[derive(Debug)]
pub struct Plane {
    pub(in crate::model) scene: Arc<Scene>,
    pub(in crate::model) inputs: Arc<InputSignals>,
    layout: Layout,
    gravity: [f64; 2],
    shared: SharedBodies,
    pub(in crate::model) elements: Box<dyn Elements>,
    nodes: Vec<Box<dyn Node>>,
    /// Place among the velocities of the temperature of the lubricant, where it is a state.
    lubricant: Option<usize>,
    /// Whether the outer ring moves in any way.
    outer_moves: bool,
    /// Shared bodies that may move at all, with their first coordinates; that are free; and whose places inputs prescribe.
    moving: Vec<(usize, usize)>,
    free: Vec<(usize, Range<usize>)>,
    moved: Vec<usize>,
    /// Masses of the shared bodies, kg; infinite where one is not free.
    masses: [f64; SHARED],
    /// Whether the law of a pair of elements sets in abruptly.
    onsets: bool,
    /// Slip speed that a tangential impulse of 1 N s gives a free element, m/(N s^2).
    mobility: f64,
    pairs: Vec<Box<dyn ElementPair>>,
    /// What the pairs say of themselves, for loops over contacts.
    infos: Vec<&'static PairInfo>,
    laws: Vec<ContactLaw>,
    /// Optional laws in those of each pair.
    parts: Vec<Vec<Law>>,
    /// Pairs of shared bodies, and what they say of themselves.
    between: Vec<Box<dyn SharedPair>>,
    between_infos: Vec<SharedInfo>,
    watch: Watch,
}

impl Plane {
    /// Order of the coordinates in the state vector.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The field of the scene by which the film of the guide can give energy to the cage, if it can.
    pub fn energy_giving_film(&self) -> Option<String> {
        self.between.iter().find_map(|pair| pair.energy_giving_field())
    }

    /// Number of rolling elements, whether they have states or not.
    pub fn element_count(&self) -> usize {
        self.elements.set().count
    }

    /// Whether the elements move freely and are rollers; otherwise their motion is prescribed.
    pub fn has_rollers(&self) -> bool {
        self.elements.mass().is_some()
    }

    /// Radius of the pitch circle, m.
    pub fn pitch_radius(&self) -> f64 {
        self.elements.set().pitch_radius
    }

    /// Radius of the inner raceway in m, where there are rollers.
    pub fn inner_raceway_radius(&self) -> Option<f64> {
        let g = self.raceway_geometry()?;
        Some(g.inner_radius(self.scene.outer_ring.as_ref()?.raceway_radius?))
    }

    /// Radii of rollers and raceways, where there are rollers.
    fn raceway_geometry(&self) -> Option<RacewayGeometry> {
        let rollers = self.scene.rollers.as_ref()?;
        let outer = self.scene.outer_ring.as_ref()?.raceway_radius?;
        Some(RacewayGeometry::new(
            outer,
            (rollers.radius, Cones::new(self.scene.taper())),
            self.scene.radial_clearance(),
        ))
    }

    /// Orbit and spin speed of the elements without slip at these inputs, rad/s: of rollers that touch both raceways,
    /// or as prescribed.
    #[doc(hidden)]
    pub fn kinematic_speeds(&self, inputs: &InputValues) -> [f64; 2] {
        self.elements.kinematic_speeds(inputs)
    }

    /// Motion of the shared bodies at this state; of one that does not exist, none.
    #[inline]
    fn motions_at(&self, q: &[f64], v: &[f64], inputs: &InputValues) -> [Motion<f64>; SHARED] {
        let mut motions = [Motion::default(); SHARED];
        self.find_motions(q, v, inputs, &mut motions);
        motions
    }

    /// Finds those that may move.
    #[inline]
    fn find_motions(&self, q: &[f64], v: &[f64], inputs: &InputValues, out: &mut [Motion<f64>; SHARED]) {
        for (body, first) in &self.moving {
            if let Some(moving) = &self.shared[*body] {
                out[*body] = moving.motion(&q[*first..], &v[*first..], inputs);
            }
        }
    }

    /// That of one of them.
    #[inline]
    fn motion_of(&self, body: usize, q: &[f64], v: &[f64], inputs: &InputValues) -> Motion<f64> {
        let first = self.layout.shared(body).unwrap_or(0);
        self.shared[body]
            .as_ref()
            .map_or_else(Motion::default, |b| b.motion(&q[first..], &v[first..], inputs))
    }

    /// Number of coordinates of the cage behind those of its motion.
    fn mode_count(&self) -> usize {
        self.layout.range(CAGE).len().saturating_sub(CAGE_MOTION)
    }

    /// Whether there is a cage.
    fn has_cage(&self) -> bool {
        self.shared[CAGE].is_some()
    }

    /// The shared bodies that move freely: place, body, coordinates.
    #[inline]
    fn free_bodies(&self) -> impl Iterator<Item = (usize, &dyn SharedBody, Range<usize>)> {
        self.free.iter().filter_map(|(place, at)| Some((*place, self.shared[*place].as_deref()?, at.clone())))
    }

    /// Place of the guide among the pairs of shared bodies, and what it says of itself: the first, if there are several, whose
    /// parts the channels show.
    fn guide(&self) -> Option<(usize, &SharedInfo)> {
        self.between_infos.iter().enumerate().find(|(_, info)| info.source == ForceSource::Guide)
    }

    /// Whether the rotation of this shared body is prescribed, by an input of the scene.
    fn is_driven(&self, body: usize) -> bool {
        self.turned_by(body).is_some()
    }

    /// The input that prescribes the rotation of this shared body, if one does.
    fn turned_by(&self, body: usize) -> Option<Input> {
        self.shared[body].as_ref().and_then(|body| body.turned_by())
    }

    /// The ring that guides the cage; the outer one, which is held in the centre, without a guide.
    fn guiding_ring(&self) -> usize {
        self.guide().map_or(OUTER_RING, |(_, info)| info.bodies[1])
    }

    /// Whether elements touch the cage.
    fn has_pockets(&self) -> bool {
        self.infos.iter().any(|info| info.mate == CAGE)
    }

    /// Whether rollers roll on raceways.
    fn has_raceways(&self) -> bool {
        self.infos.iter().any(|info| info.rolls)
    }
}
