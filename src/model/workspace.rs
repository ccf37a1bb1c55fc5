//! Memory of a force evaluation: the touching contacts of every law, gathered for it, and their forces.

use super::law_slopes::LawSlopes;
use super::laws::{LAWS, LawCounts, PocketLaws};
use super::{InputValues, Model};
use crate::contact::pocket::Pillar;
use crate::contact::raceway::RollerMotion;
use crate::contact::{PairFrame, Wrench, rotate};
use crate::integrate::Vibration;
use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::guide::{GuideForce, GuideLaw};
use crate::laws::journal::JournalMotion;
use crate::scalar::elementary::{ANGLE_LARGEST, sin_cos};
use crate::scalar::{Columns, Pack, WIDEST, dispatch};
use pulp::Simd;
use std::f64::consts::TAU;

/// The touching contacts of one law, in columns. Room is taken at creation, so filling it does not allocate.
#[derive(Clone, Debug)]
pub(super) struct Batch<S> {
    pub(super) element: Vec<usize>,
    pub(super) frame: Vec<PairFrame<f64>>,
    pub(super) site: Vec<S>,
    /// As long as the batch may become, and more: what is beyond its end is apart.
    pub(super) motion: ContactMotion<Vec<f64>>,
    pub(super) force: ContactForce<Vec<f64>>,
    /// Derivatives of the forces, where they are found by the batch.
    pub(super) slopes: LawSlopes,
}

/// A motion without contact.
const APART: ContactMotion<f64> = ContactMotion { delta: -1.0, delta_dot: 0.0, u1: 0.0, u2: 0.0 };

impl<S> Batch<S> {
    fn with_capacity(n: usize) -> Self {
        let room = n.next_multiple_of(WIDEST);
        Self {
            element: Vec::with_capacity(n),
            frame: Vec::with_capacity(n),
            site: Vec::with_capacity(n),
            motion: APART.map(|x| vec![*x; room]),
            force: ContactForce::none(0.0).map(|x: &f64| vec![*x; room]),
            slopes: LawSlopes::default(),
        }
    }

    fn with_slopes(self) -> Self {
        Self { slopes: LawSlopes::new(self.motion.delta.len()), ..self }
    }

    pub(super) fn clear(&mut self) {
        self.element.clear();
        self.frame.clear();
        self.site.clear();
    }

    pub(super) fn len(&self) -> usize {
        self.element.len()
    }

    pub(super) fn push(
        &mut self,
        element: usize,
        motion: ContactMotion<f64>,
        frame: PairFrame<f64>,
        site: S,
    ) {
        self.motion.set(self.len(), &motion);
        self.element.push(element);
        self.frame.push(frame);
        self.site.push(site);
    }

    /// Makes the places up to the next whole group apart.
    pub(super) fn pad(&mut self) {
        for i in self.len()..self.len().next_multiple_of(WIDEST) {
            self.motion.set(i, &APART);
        }
    }

    /// Element, frame and site of each contact with its normal force, friction and rolling resistance, N.
    pub(super) fn forces(&self) -> impl Iterator<Item = (usize, &PairFrame<f64>, &S, ContactForce<f64>)> {
        let f = &self.force;
        let kinematics = self.element.iter().zip(&self.frame).zip(&self.site);
        let forces = f.normal.iter().zip(&f.friction).zip(&f.rolling_resistance);
        kinematics.zip(forces).map(
            |(((element, frame), site), ((&normal, &friction), &rolling_resistance))| {
                let force = ContactForce { normal, friction, rolling_resistance, ..ContactForce::none(0.0) };
                (*element, frame, site, force)
            },
        )
    }

    /// Element, frame and site of each contact with its normal damping and its secant slope of friction, N s/m.
    pub(super) fn damping(&self) -> impl Iterator<Item = (usize, &PairFrame<f64>, &S, [f64; 2])> {
        let kinematics = self.element.iter().zip(&self.frame).zip(&self.site);
        kinematics
            .zip(self.force.damping.iter().zip(&self.force.friction_secant))
            .map(|(((element, frame), site), (damping, secant))| (*element, frame, site, [*damping, *secant]))
    }

    /// Contacts with all that is known of them, in the order of the elements.
    pub(super) fn iter(&self) -> impl Iterator<Item = Loaded<'_, S>> {
        let kinematics = self.element.iter().zip(&self.frame).zip(&self.site);
        kinematics.enumerate().map(|(i, ((&element, frame), site))| Loaded {
            element,
            motion: self.motion.map(|x| x[i]),
            frame,
            site,
            force: self.force.map(|x| x[i]),
        })
    }
}

/// One contact of a batch.
pub(super) struct Loaded<'a, S> {
    pub(super) element: usize,
    pub(super) motion: ContactMotion<f64>,
    pub(super) frame: &'a PairFrame<f64>,
    pub(super) site: &'a S,
    pub(super) force: ContactForce<f64>,
}

/// Angles with their sines and cosines, in columns.
#[derive(Clone, Debug)]
pub(super) struct Directions {
    /// rad
    pub(super) angle: Vec<f64>,
    sin: Vec<f64>,
    cos: Vec<f64>,
}

impl Directions {
    fn new(n: usize) -> Self {
        let room = n.next_multiple_of(WIDEST);
        Self { angle: vec![0.0; room], sin: vec![0.0; room], cos: vec![1.0; room] }
    }

    /// Sine and cosine.
    pub(super) fn direction(&self, j: usize) -> (f64, f64) {
        (self.sin[j], self.cos[j])
    }

    /// Finds sine and cosine of the first `n` angles.
    pub(super) fn turn(&mut self, n: usize, instructions: pulp::Arch) {
        for angle in &mut self.angle[..n] {
            if angle.abs() > ANGLE_LARGEST {
                *angle %= TAU;
            }
        }
        dispatch(instructions, Turn(self, n));
    }
}

struct Turn<'a>(&'a mut Directions, usize);

impl Columns for Turn<'_> {
    fn rows(&self) -> usize {
        self.1
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (sin, cos) = sin_cos(Pack::<S, K>::load(simd, &self.0.angle[first..]));
        sin.store(&mut self.0.sin[first..]);
        cos.store(&mut self.0.cos[first..]);
    }
}

/// What a pocket contact needs besides its motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct PocketSite {
    pub(super) pillar: Pillar,
    pub(super) edge_share: f64,
    /// Contact point relative to the cage centre, pocket frame, m.
    pub(super) lever: [f64; 2],
}

/// Motion of an element and the direction of its local frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct ElementSite {
    pub(super) motion: RollerMotion<f64>,
    pub(super) sin: f64,
    pub(super) cos: f64,
    /// Sine and cosine of the angle by which the element leads its pocket; (0, 1) without pockets.
    pub(super) lead: (f64, f64),
    /// Element centre relative to its pocket, pocket frame, m; zero without pockets.
    pub(super) pocket_offset: [f64; 2],
}

impl ElementSite {
    /// A global vector in the element's local frame.
    pub(super) fn to_local(self, v: [f64; 2]) -> [f64; 2] {
        rotate(v, -self.sin, self.cos)
    }

    /// A local vector in the global frame.
    pub(super) fn to_global(self, v: [f64; 2]) -> [f64; 2] {
        rotate(v, self.sin, self.cos)
    }
}

/// Memory of a force evaluation and its results. One per simulation; never shared.
#[derive(Clone, Debug)]
pub struct Workspace {
    /// Directions of rollers, and by how much they lead their pockets.
    pub(super) azimuths: Directions,
    pub(super) leads: Directions,
    pub(super) elements: Vec<ElementSite>,
    pub(super) outer: Batch<()>,
    pub(super) inner: Batch<()>,
    pub(super) wall: Batch<PocketSite>,
    pub(super) edge: Batch<PocketSite>,
    pub(super) plane: Batch<PocketSite>,
    /// Force of the guide on its journal, and the motion it belongs to.
    pub(super) guide: Option<GuideForce<f64>>,
    pub(super) journal: Option<JournalMotion<f64>>,
    pub(super) inputs: InputValues,
    /// Contact forces on each roller, local frame; empty for kinematic elements.
    pub(super) on_roller: Vec<Wrench<f64>>,
    /// Forces on the cage but its weight, moment about its geometric centre, global frame.
    pub(super) on_cage: Wrench<f64>,
    /// Evaluations per law.
    pub(super) counts: LawCounts,
    /// Whether evaluations are counted now.
    pub(super) counting: bool,
    /// Temperature that the viscosity belongs to, K; NaN where the viscosity is constant.
    pub(super) temperature: f64,
    /// ln of the viscosity at that temperature over that of the laws.
    pub(super) thickening: f64,
    /// The guide at that viscosity.
    pub(super) guide_law: Option<GuideLaw>,
    /// Vector instructions of this machine.
    pub(super) instructions: pulp::Arch,
}

impl Workspace {
    /// Memory for evaluations of `model`.
    pub fn new(model: &Model) -> Self {
        let n = model.elements.count;
        let rollers = model.layout.count;
        let (cylinder, plane) = match &model.laws.pocket {
            None => (0, 0),
            Some(PocketLaws::Cylinder(_)) => (2 * n, 0),
            Some(PocketLaws::Plane(_)) => (0, 2 * n),
        };
        Self {
            azimuths: Directions::new(rollers),
            leads: Directions::new(rollers),
            elements: Vec::with_capacity(n),
            outer: Batch::with_capacity(rollers).with_slopes(),
            inner: Batch::with_capacity(rollers).with_slopes(),
            wall: Batch::with_capacity(cylinder),
            edge: Batch::with_capacity(cylinder),
            plane: Batch::with_capacity(plane),
            guide: None,
            journal: None,
            inputs: InputValues::default(),
            on_roller: vec![Wrench::default(); rollers],
            on_cage: Wrench::default(),
            counts: [0; LAWS.len()],
            counting: true,
            temperature: model.inputs.oil.map_or(f64::NAN, |oil| oil.built_at.0),
            thickening: 0.0,
            guide_law: model.laws.guide.clone(),
            instructions: pulp::Arch::new(),
        }
    }

    /// Number of contacts that touched in the last evaluation: raceways, pockets.
    pub fn active_contacts(&self) -> [usize; 2] {
        let pockets = self.wall.len() + self.edge.len() + self.plane.len();
        [self.outer.len() + self.inner.len(), pockets]
    }

    /// Normal speeds of the touching raceway contacts at the last evaluated state.
    pub(crate) fn vibration(&self) -> Vibration {
        let speeds =
            |batch: &Batch<()>| batch.motion.delta_dot[..batch.len()].iter().map(|v| v * v).sum::<f64>();
        let squares = speeds(&self.outer) + speeds(&self.inner);
        Vibration { squares, count: (self.outer.len() + self.inner.len()) as f64 }
    }

    /// Number of evaluations of each law since the workspace was made or the counts were set, in the order of [`LAWS`].
    pub fn law_counts(&self) -> &LawCounts {
        &self.counts
    }

    /// Whether the next evaluations count; they do at first.
    pub fn set_counting(&mut self, counting: bool) {
        self.counting = counting;
    }

    /// Sets the counts.
    pub fn set_law_counts(&mut self, counts: LawCounts) {
        self.counts = counts;
    }

    /// All pocket contacts, in the order of the elements for each law.
    pub(super) fn pocket_contacts(&self) -> impl Iterator<Item = Loaded<'_, PocketSite>> {
        self.wall.iter().chain(self.edge.iter()).chain(self.plane.iter())
    }

    pub(super) fn clear(&mut self) {
        self.elements.clear();
        self.outer.clear();
        self.inner.clear();
        self.wall.clear();
        self.edge.clear();
        self.plane.clear();
    }
}
