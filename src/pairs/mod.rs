//! Pairs of bodies: each owns the gap, the approach, the surface speeds and the levers of its contacts, written once.
//!
//! | pair | file | bodies | force |
//! |---|---|---|---|
//! | raceway | `raceway` | roller, outer or inner ring | line contact |
//! | cylindrical pocket | `pocket/cylinder` | element, cage | line contact, edge |
//! | plane pocket | `pocket/plane` | element, cage | spring, damper, friction |
//! | neighbours | `neighbours` | roller, the next roller | line contact |
//! | guide | `guide` | cage, outer or inner ring | films, solid contact |
//! | shaft | `shaft` | rotor, inner ring | spring, damper that turns |
//!
//! A pair of elements finds its touching contacts and hands motion and `Grip` of each to `Contacts`. Wrenches, powers,
//! damping, the change of forces in a step and the reaction follow from these by the same code for all pairs
//! (`model/plane/evaluate`, `works`, `integration`). A pair of two shared bodies gives wrenches on both. A new pair is a
//! file with the trait `ElementPair` and a line in `element_pairs`, or with `SharedPair` and a line in `shared_pairs`; and the
//! names that it is counted and reported by, in `Law`, `ForceSource` and `Power`.

pub(crate) mod ball_pocket;
mod contacts;
pub(crate) mod grip;
pub(crate) mod groove;
pub mod guide;
pub(crate) mod line_laws;
mod neighbours;
mod passage;
mod pocket;
pub(crate) mod raceway;
pub(crate) mod roller;
mod shaft;
mod slope_sums;
mod waves;

pub(crate) use contacts::{
    Batch, ContactBlock, Contacts, Found, LAWS_OF_PAIR, Loaded, RelativeSlopes, Search, Site, SpeedChanges,
};
pub(crate) use grip::Grip;
use guide::OnDeformed;
pub(crate) use slope_sums::SlopeSums;
pub(crate) use waves::Waves;

use crate::bodies::{
    CAGE, CAGE_MOTION, Elements, Fault, ForceSource, InputValues, Layout, Motions, Power, SHARED,
    SharedBodies, displaced,
};
use crate::error::Result;
use crate::integrate::Tuning;
use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::elastic::solid::SolidContact;
use crate::laws::fluid::Fluid;
use crate::laws::guide::GuideForce;
use crate::laws::line_contact::LineContact;
use crate::registry::registry;
use crate::scene::Scene;
use crate::space::{Frame, Motion, Wrench};
use line_laws::LawBuilder;
use nalgebra::{DMatrix, Matrix3};
use std::fmt::Debug;
use std::ops::Range;

/// The pairs of elements of a checked scene, with the lubricant at `viscosity` in Pa s, in the order of force reports.
pub(crate) fn element_pairs(scene: &Scene, viscosity: Option<f64>) -> Result<Vec<Box<dyn ElementPair>>> {
    let laws = LawBuilder::new(scene, viscosity);
    let list = [
        raceway::outer(&laws)?,
        raceway::inner(&laws)?,
        pocket::cylinder(&laws)?,
        pocket::plane(&laws)?,
        neighbours::new(&laws)?,
    ];
    Ok(list.into_iter().flatten().collect())
}

/// The pairs of shared bodies of a checked scene.
pub(crate) fn shared_pairs(scene: &Scene, viscosity: Option<f64>) -> Result<Vec<Box<dyn SharedPair>>> {
    let laws = LawBuilder::new(scene, viscosity);
    Ok([guide::Guide::of(&laws)?, shaft::Shaft::of(scene)].into_iter().flatten().collect())
}

registry! {
    /// A law whose evaluations are counted.
    pub(crate) enum Law,
    /// Laws whose evaluations are counted.
    pub const LAWS {
        OuterRaceway = "outer_raceway",
        InnerRaceway = "inner_raceway",
        PocketWall = "pocket_wall",
        PocketEdge = "pocket_edge",
        PocketPlane = "pocket_plane",
        FilmThickness = "film_thickness",
        Traction = "traction",
        SelfHeating = "self_heating",
        LubricationRegime = "lubrication_regime",
        RollingResistance = "rolling_resistance",
        GuideFilm = "guide_film",
        GuideSolid = "guide_solid",
        ViscosityTemperature = "viscosity_temperature",
        Neighbours = "neighbours",
        Rib = "rib",
    }
}

/// Counts by law, in the order of [`LAWS`].
pub type LawCounts = [u64; LAWS.len()];

/// The mate of elements that touch each other: no shared body.
pub(crate) const NEIGHBOUR: usize = SHARED;

/// What a pair is called and where its forces count.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairInfo {
    /// Shared body that elements touch, or [`NEIGHBOUR`].
    pub(crate) mate: usize,
    /// Under which its forces are reported.
    pub(crate) source: ForceSource,
    /// Names of the contacts that an element can have with it.
    pub(crate) contacts: &'static [&'static str],
    /// Laws that its contacts are counted by: of walls, and of edges, if it has any.
    pub(crate) laws: [Option<Law>; LAWS_OF_PAIR],
    /// Powers that its damping and its friction belong to: two, neither of which is that of rolling resistance.
    pub(crate) powers: [Power; 2],
    /// Whether elements roll on it under load. Then its vibration is that of the bearing, rolling resistance has a power of its
    /// own, and floors of its laws are watched.
    pub(crate) rolls: bool,
    /// What energy and powers of a contact count by: 1, or 1/2 where it stands once for each of two elements.
    pub(crate) share: f64,
}

/// The optional laws of a contact, of which these are present: film, traction with self-heating, regime, rolling resistance.
pub(crate) fn parts(present: [bool; 5]) -> impl Iterator<Item = Law> {
    let list =
        [Law::FilmThickness, Law::Traction, Law::SelfHeating, Law::LubricationRegime, Law::RollingResistance];
    list.into_iter().zip(present).filter_map(|(law, present)| present.then_some(law))
}

/// Those of a line contact.
pub(crate) fn parts_of_line(line: &LineContact) -> impl Iterator<Item = Law> + use<> {
    let LineContact { film, traction, self_heating: heated, regime, rolling_resistance: rolling, .. } = line;
    parts([film.is_some(), traction.is_some(), heated.is_some(), regime.is_some(), rolling.is_some()])
}

/// Force law of the contacts of a pair.
#[expect(clippy::large_enum_variant, reason = "a few per model")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ContactLaw {
    /// Lubricated line contact.
    Line(LineContact),
    /// Spring, damper and friction.
    Solid(SolidContact),
}

impl ContactLaw {
    /// The line contact, if it is one.
    pub(crate) fn line(&self) -> Option<&LineContact> {
        match self {
            Self::Line(law) => Some(law),
            Self::Solid(_) => None,
        }
    }

    /// The optional laws in it.
    pub(crate) fn parts(&self) -> Vec<Law> {
        self.line().into_iter().flat_map(parts_of_line).collect()
    }

    /// Elastic force in N and energy in J at the approach `delta` (m).
    pub(crate) fn spring(&self, delta: f64) -> [f64; 2] {
        match self {
            Self::Line(law) => {
                let [force, work] = law.rest_at(delta);
                [force, if law.profile.is_some() { 9.0 / 19.0 * work } else { 9.0 / 19.0 * force * delta }]
            }
            Self::Solid(law) => {
                let force = law.stiffness * delta;
                [force, 0.5 * force * delta]
            }
        }
    }

    /// Elastic force in N of slices whose own damping has cut off theirs while others of the contact push.
    pub(crate) fn cut_off(&self, motion: &ContactMotion<f64>) -> f64 {
        self.line().map_or(0.0, |law| law.cut_off(motion))
    }

    /// Whether slices may lose their force one by one.
    pub(crate) fn sliced(&self) -> bool {
        self.line().is_some_and(|law| law.profile.is_some())
    }

    /// Stiffness under a load in N, N/m.
    pub(crate) fn stiffness_at_load(&self, load: f64) -> f64 {
        match self {
            Self::Line(law) => law.stiffness_at_rest(load, law.approach(load)),
            Self::Solid(law) => law.stiffness,
        }
    }

    /// Whether it has a damper.
    pub(crate) fn damped(&self) -> bool {
        match self {
            Self::Line(law) => law.damping.is_some(),
            Self::Solid(law) => law.damping > 0.0,
        }
    }

    /// Whether a thermal factor is at its floor in a contact that moves like this under this force.
    pub(crate) fn is_at_floor(
        &self,
        motion: &ContactMotion<f64>,
        ln_viscosity: f64,
        force: &ContactForce<f64>,
    ) -> bool {
        self.line().is_some_and(|law| law.is_at_floor(motion, ln_viscosity, force))
    }
}

/// What a pair may look at to say how long a step may be.
pub(crate) struct Ahead<'a> {
    pub(crate) shared: &'a [Motion<f64>],
    pub(crate) bodies: &'a SharedBodies,
    pub(crate) elements: &'a dyn Elements,
    pub(crate) layout: &'a Layout,
    pub(crate) q: &'a [f64],
    pub(crate) v: &'a [f64],
    /// Zero where neither the inner ring guides nor a law sets in abruptly.
    pub(crate) inputs: &'a InputValues,
    /// Masses of the shared bodies, kg; infinite where one is not free.
    pub(crate) masses: &'a [f64; SHARED],
    /// Step that is wanted, s.
    pub(crate) wanted: f64,
    pub(crate) tuning: &'a Tuning,
}

impl Ahead<'_> {
    /// Coordinates of the cage behind those of its motion, and their rates.
    pub(crate) fn modes(&self) -> [&[f64]; 2] {
        let at = self.layout.range(CAGE);
        [self.q, self.v].map(|x| x[at.clone()].get(CAGE_MOTION..).unwrap_or(&[]))
    }

    /// How a deformed cage displaces the pocket of element `j`, outwards and counter-clockwise in m, and how fast, in m/s.
    pub(crate) fn displacement(&self, j: usize) -> [[f64; 2]; 2] {
        let basis = self.bodies[CAGE].as_ref().map_or(&[][..], |cage| cage.displacements(j));
        self.modes().map(|x| displaced(basis, x))
    }

    /// Smaller of the masses of this shared body and of a free element, kg.
    pub(crate) fn lightest(&self, mate: usize) -> f64 {
        self.elements.mass().map_or(self.masses[mate], |mass| mass.min(self.masses[mate]))
    }
}

/// Contacts of all elements with one shared body.
pub(crate) trait ElementPair: Debug + Send + Sync {
    /// Names and places.
    fn info(&self) -> &'static PairInfo;

    /// Force law.
    fn law(&self) -> ContactLaw;

    /// Finds the contacts that touch.
    ///
    /// # Errors
    /// The fault of an element where the pair has no law.
    fn find(&self, motions: &Motions, out: &mut Search<'_>) -> std::result::Result<(), Fault>;

    /// Adds the derivatives of the forces of these contacts of a batch over the coordinates of both bodies.
    fn add_slopes(
        &self,
        batch: &Batch,
        contacts: Range<usize>,
        motions: &Motions,
        sums: &mut SlopeSums<'_>,
        memory: &mut RelativeSlopes,
    );

    /// Whether its law sets in so abruptly that steps must be chosen by it.
    fn has_onset(&self) -> bool {
        false
    }

    /// The longest step (s) that passes no onset of its law unseen; infinite where the law sets in smoothly.
    fn longest_step(&self, _ahead: &Ahead<'_>) -> f64 {
        f64::INFINITY
    }

    /// Clearance of a centred element in m, where the pair holds it loosely.
    fn clearance(&self) -> Option<f64> {
        None
    }

    /// Counter-clockwise offset of an element at this place from where the pair holds it, m; `None` where it holds nothing.
    fn offset(&self, _at: &ElementPlace) -> Option<f64> {
        None
    }

    /// Time of finding its contacts and of their forces, and of the derivatives: see [`crate::Model::jacobian_cost`].
    fn cost(&self) -> Cost;
}

/// What a pair of shared bodies is called and where its forces count.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SharedInfo {
    /// Places of the bodies; of a guide the cage first.
    pub(crate) bodies: [usize; 2],
    /// Under which its forces are reported.
    pub(crate) source: ForceSource,
    /// Laws of its film and its solid contact, where it has them.
    pub(crate) laws: [Option<Law>; 2],
    /// Powers that both belong to.
    pub(crate) powers: [Power; 2],
    /// Whether its film has shear of its own.
    pub(crate) shears: bool,
}

/// Forces of a pair of shared bodies at one state.
#[derive(Clone, Debug, Default)]
pub(crate) struct SharedForce {
    /// Wrenches on both bodies.
    pub(crate) on: [Wrench<f64>; 2],
    /// What the law of the pair gives.
    of_law: GuideForce<f64>,
    /// How the wrench on each body opposes its own motion, if it was asked for: -d(force, moment)/d(velocity, speed), N s/m and
    /// its kin.
    pub(crate) damping: Option<[Matrix3<f64>; 2]>,
    /// What belongs to the deformation of the first body, if it has any.
    deformed: Option<Box<OnDeformed>>,
}

impl SharedForce {
    /// Forces over the coordinates of a deformed cage behind those of its motion; none on a rigid one.
    pub(crate) fn on_modes(&self) -> &[f64] {
        self.deformed.as_ref().map_or(&[], |deformed| deformed.on_modes())
    }

    /// These, and what the film alone does, where there is a deformed cage.
    pub(crate) fn of_modes(&self) -> Option<[&[f64]; 2]> {
        self.deformed.as_ref().map(|deformed| deformed.of_modes())
    }

    /// How the forces on a deformed cage oppose the rates of all its coordinates, if it was asked for and beyond what
    /// [`SharedForce::damping`] has.
    pub(crate) fn damping_of_modes(&self) -> Option<&DMatrix<f64>> {
        self.deformed.as_ref().and_then(|deformed| deformed.damping())
    }
}

/// Contact of two shared bodies.
pub(crate) trait SharedPair: Debug + Send + Sync {
    /// Names and places.
    fn info(&self) -> SharedInfo;

    /// Memory for its forces.
    fn memory(&self) -> SharedForce {
        SharedForce::default()
    }

    /// Writes the forces at this motion of the bodies with this lubricant, without damping.
    ///
    /// # Errors
    /// The fault of a state where it has no law.
    fn evaluate(
        &self,
        motions: &Motions,
        fluid: Fluid,
        out: &mut SharedForce,
    ) -> std::result::Result<(), Fault>;

    /// The same forces with their damping.
    ///
    /// # Errors
    /// As [`SharedPair::evaluate`].
    fn evaluate_with_damping(
        &self,
        motions: &Motions,
        fluid: Fluid,
        out: &mut SharedForce,
    ) -> std::result::Result<(), Fault>;

    /// Whether film and solid contact act.
    fn acting(&self, force: &SharedForce) -> [bool; 2];

    /// Wrenches of the film alone on both bodies, which moved like this.
    fn of_film(&self, motions: &Motions, force: &SharedForce) -> [Wrench<f64>; 2];

    /// Energy that it stores beside the works of its forces, J; `None` of one whose works count all.
    fn stored(&self, _motions: &Motions) -> Option<f64> {
        None
    }

    /// The force on the first body by its parts.
    fn parts(&self, motions: &Motions, force: &SharedForce) -> GuideForce<f64>;

    /// Smallest gap between the bodies, m.
    fn smallest_gap(&self, motions: &Motions) -> f64;

    /// Number of arcs in which its film touches a deformed body, and the angle that they take, rad.
    fn wet_arcs(&self, _motions: &Motions) -> (u32, f64) {
        (0, 0.0)
    }

    /// Adds the derivatives of its forces over the coordinates of both bodies. `force` was evaluated at this state.
    fn add_slopes(&self, motions: &Motions, fluid: Fluid, force: &mut SharedForce, sums: &mut SlopeSums<'_>);

    /// The longest step (s) that passes no onset of its laws unseen.
    fn longest_step(&self, ahead: &Ahead<'_>) -> f64;

    /// Stiffness of its solid contact, N/m.
    fn stiffness(&self) -> f64;

    /// The field of the scene by which its film can give energy, if it can.
    fn energy_giving_field(&self) -> Option<String>;

    /// Time of its forces and of their derivatives: see [`crate::Model::jacobian_cost`].
    fn cost(&self) -> Option<Cost>;
}

/// Place of an element beside its mate.
pub(crate) struct ElementPlace {
    pub(crate) frame: Frame<f64>,
    pub(crate) radial_offset: f64,
    /// Angle travelled since the start, rad.
    pub(crate) travel: f64,
    pub(crate) mate: Motion<f64>,
    /// How far its place in the mate is displaced, outwards and counter-clockwise, m.
    pub(crate) displacement: [f64; 2],
}

/// Time of a part of an evaluation, and of its derivatives, ns. Only ratios matter: `cargo bench --bench jacobian` shows them
/// beside measured ones.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cost {
    pub(crate) value: f64,
    pub(crate) slopes: f64,
    /// Whether it is that of each element, or of the whole pair.
    pub(crate) per_element: bool,
}
