//! Bodies: each owns its coordinates with their names and units, its inertia, its weight and its energy.
//!
//! | body | file | coordinates |
//! |---|---|---|
//! | rings | `ring` | centre (y, z), or none for one that is held |
//! | rotor | `rotor` | centre (y, z) |
//! | cage | `cage` | centre (y, z), angle, modes of an elastic ring |
//! | rollers | `elements/rollers` | radial offset and orbit angle, spin speed |
//! | elements of prescribed motion | `elements/kinematic` | none |
//! | nodes | `nodes`; `heat/lumps` | states that are no motion; temperatures |
//!
//! Rings and cage are shared: every element can touch them. Pairs see [`Motions`] and act on bodies by wrenches. A new body is a
//! file with one of the traits `SharedBody`, `Elements` and `Node` and a line in `shared_bodies`, `elements` or
//! `nodes`.

mod cage;
mod elements;
mod fault;
mod heat;
mod inputs;
mod layout;
mod motions;
mod nodes;
mod ring;
mod rotor;
mod spatial;
mod states;
mod unbalance;

pub use fault::{FAULTS, Fault, FaultCounts};
pub(crate) use fault::{FaultKind, SOUND};
pub(crate) use inputs::PLACES;
pub use inputs::{HostInputs, INPUTS, Input, InputValues};
pub use layout::Layout;

pub(crate) use cage::{MOST_MODES, OF_MOTION as CAGE_MOTION, along_factor};
pub(crate) use elements::{Damping, ElementSlopes, Elements, Spacing, UPPER};
pub(crate) use heat::HeatBudget;
pub(crate) use layout::{OF_ELEMENT, Owner};
pub(crate) use motions::{Element, ElementBlock, ElementMotion, ElementSet, Motions, WrenchLanes};
pub(crate) use nodes::{Node, NodeState, nodes};
pub(crate) use spatial::{
    Balls, CageInSpace, CageState, Inclination, MovingCage, MovingRing, MovingRoller, OF_BALL, OF_CAGE,
    OF_RING, OF_ROLLER, ORBIT, RING_COORDINATES, RingInSpace, RingState, RollerPlace, RollerState,
    RollersInSpace, SPIN, tilt_of,
};
pub(crate) use states::{State, layout_of, states_of};
pub(crate) use unbalance::SPEEDS;

use crate::registry::registry;
use crate::scalar::Lanes;
use crate::scene::Scene;
use crate::space::{Motion, Wrench};
use cage::Cage;
use elements::{KinematicElements, Rollers};
use nalgebra::DMatrixViewMut;
use pulp::Arch;
use ring::Ring;
use rotor::Rotor;
use std::fmt::Debug;

/// Places of the shared bodies.
pub(crate) const OUTER_RING: usize = 0;
/// See [`OUTER_RING`].
pub(crate) const INNER_RING: usize = 1;
/// See [`OUTER_RING`].
pub(crate) const CAGE: usize = 2;
/// See [`OUTER_RING`].
pub(crate) const ROTOR: usize = 3;
/// Number of shared bodies.
pub(crate) const SHARED: usize = 4;

/// The shared bodies of a bearing.
pub(crate) type SharedBodies = [Option<Box<dyn SharedBody>>; SHARED];

/// The shared bodies of a checked scene with these elements: outer ring, inner ring, cage, rotor.
pub(crate) fn shared_bodies(scene: &Scene, elements: &ElementSet) -> SharedBodies {
    [
        Some(Box::new(Ring::outer(scene))),
        Some(Box::new(Ring::inner(scene))),
        Cage::new(scene, elements),
        Rotor::of(scene),
    ]
}

/// The rolling elements of a checked scene.
pub(crate) fn elements(scene: &Scene) -> Box<dyn Elements> {
    match Rollers::new(scene) {
        Some(rollers) => Box::new(rollers),
        None => Box::new(KinematicElements::new(scene)),
    }
}

/// A coordinate of a body and its rate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coordinate {
    /// Name, SI unit and meaning of the position; `None` for one that enters no force, of which only the rate is a state.
    pub(crate) position: Option<[&'static str; 3]>,
    /// Name, SI unit and meaning of its rate.
    pub(crate) rate: [&'static str; 3],
    /// What a change of it moves.
    pub(crate) moves: Moves,
}

/// The centre of a body.
pub(crate) const CENTRE: [Coordinate; 2] = [
    Coordinate {
        position: Some(["y", "m", "centre position to the right"]),
        rate: ["vy", "m/s", "velocity of the centre to the right"],
        moves: Moves::Itself,
    },
    Coordinate {
        position: Some(["z", "m", "centre position upwards"]),
        rate: ["vz", "m/s", "velocity of the centre upwards"],
        moves: Moves::Itself,
    },
];

/// What a unit of a coordinate moves by how much.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Moves {
    /// The body, by as much.
    Itself,
    /// Points at the pitch radius.
    PitchCircle,
    /// The surface of an element.
    Surface,
}

registry! {
    /// Where forces on a body come from.
    pub(crate) enum ForceSource,
    /// Where forces on a body come from.
    pub const FORCE_SOURCES {
        OuterRaceway = "outer_raceway",
        InnerRaceway = "inner_raceway",
        Pocket = "pocket",
        Guide = "guide",
        Gravity = "gravity",
        Load = "load",
        Support = "support",
        Neighbour = "neighbour",
        Drag = "drag",
        Rib = "rib",
        Unbalance = "unbalance",
        Shaft = "shaft",
    }
}

/// Forces on one body by source: (F_y in N, F_z in N, moment about its own geometric centre in N m).
pub type BodyForces = [[f64; 3]; FORCE_SOURCES.len()];

registry! {
    /// A power of the power balance.
    pub(crate) enum Power,
    /// Names of the powers, W. Those of loads and of prescribed motions are positive where they drive the bearing; those of
    /// forces inside are negative where they take energy. The solid contact of the guide gives back what its spring took.
    pub const POWERS {
        Loads = "loads",
        RingDrive = "ring_drive",
        OuterRingDrive = "outer_ring_drive",
        ElementDrive = "element_drive",
        RingSupport = "ring_support",
        RacewayDamping = "raceway_damping",
        RacewayFriction = "raceway_friction",
        RollingResistance = "rolling_resistance",
        PocketDamping = "pocket_damping",
        PocketFriction = "pocket_friction",
        GuideFilm = "guide_film",
        GuideSolid = "guide_solid",
        CageBending = "cage_bending",
        NeighbourDamping = "neighbour_damping",
        NeighbourFriction = "neighbour_friction",
        Drag = "drag",
        RibDamping = "rib_damping",
        RibFriction = "rib_friction",
        ShaftDamping = "shaft_damping",
    }
}

impl Power {
    /// Whether it turns energy of the bearing into heat within it.
    pub(crate) fn is_lost(self) -> bool {
        !matches!(
            self,
            Self::Loads | Self::RingDrive | Self::OuterRingDrive | Self::ElementDrive | Self::RingSupport
        )
    }
}

/// Energy of a body's motion, of its deformation and of its weight, J.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct BodyEnergy {
    pub(crate) kinetic: f64,
    pub(crate) elastic: f64,
    pub(crate) potential: f64,
}

impl BodyEnergy {
    /// Weight of `mass` kg with its centre at `position` (m): zero with all bodies at the centre.
    pub(crate) fn of_weight(mass: f64, [gy, gz]: [f64; 2], [y, z]: [f64; 2]) -> f64 {
        -mass * (gy * y + gz * z)
    }
}

/// A shared body at one state: its motion, and its coordinates and their rates, none if it is held.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyState<'a> {
    pub(crate) motion: &'a Motion<f64>,
    pub(crate) q: &'a [f64],
    pub(crate) v: &'a [f64],
}

/// Forces on a shared body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OnBody<'a> {
    pub(crate) wrench: &'a Wrench<f64>,
    /// Over its coordinates behind those of its motion, N or N m.
    pub(crate) coordinates: &'a [f64],
}

/// A body that every element can touch. Slices of its coordinates begin with its first.
pub(crate) trait SharedBody: Debug + Send + Sync {
    /// Name of the body.
    fn name(&self) -> &'static str;

    /// Its coordinates, each with a position; none if it is held. The first are those of its motion, in the order of its wrench:
    /// y, y and z, or y, z and angle.
    fn coordinates(&self) -> &[Coordinate];

    /// Its motion at these positions, velocities and inputs.
    fn motion(&self, q: &[f64], v: &[f64], inputs: &InputValues) -> Motion<f64>;

    /// How each of its coordinates behind those of its motion displaces the place that it has for element `j`, outwards and
    /// counter-clockwise, per unit; none of a rigid body.
    fn displacements(&self, _j: usize) -> &[[f64; 2]] {
        &[]
    }

    /// Displacements of the places that it has for the elements of a block, outwards and counter-clockwise, by amplitudes (m) of
    /// these coordinates; or their rates. Those of a rigid body stay.
    fn displace(&self, _block: usize, _amplitudes: &[f64], _out: &mut [Lanes; 2], _instructions: Arch) {}

    /// The input that prescribes its rotation, if one does.
    fn turned_by(&self) -> Option<Input> {
        None
    }

    /// Where its y and z are among [`PLACES`], if inputs prescribe them.
    fn moved_by(&self) -> Option<[usize; 2]> {
        None
    }

    /// The most that its centre may be off that of the outer ring, or that one off the centre of the bearing, m.
    fn reach(&self) -> f64;

    /// What it is when it is `distance` (m) off, further than that.
    fn lost(&self, distance: f64) -> Fault;

    /// Mass in kg, if it moves freely: the least that it has in a direction.
    fn mass(&self) -> Option<f64>;

    /// Mass in kg that its weight is of, if it moves freely.
    fn weighing(&self) -> Option<f64> {
        self.mass()
    }

    /// Stiffness of its support, N/m, by rows; zero of a body without one.
    fn support(&self) -> [[f64; 2]; 2] {
        [[0.0; 2]; 2]
    }

    /// Load at rest, N.
    fn load(&self, _inputs: &InputValues) -> [f64; 2] {
        [0.0; 2]
    }

    /// Adds loads and supports to the wrench on it.
    fn add_external(&self, state: &BodyState<'_>, inputs: &InputValues, on_body: &mut Wrench<f64>);

    /// Makes forces over its coordinates, with the body at these, the accelerations that they alone give it.
    fn respond(&self, forces: &mut [f64], q: &[f64]);

    /// Accelerations `a` of its coordinates by all other forces on it and its weight.
    fn accelerate(&self, on_body: &OnBody<'_>, state: &BodyState<'_>, gravity: [f64; 2], a: &mut [f64]);

    /// The wrench beside the weight that makes these accelerations of its coordinates: what [`SharedBody::accelerate`] turns
    /// round.
    fn wrench_for(&self, a: &dyn Fn(usize) -> f64, state: &BodyState<'_>, gravity: [f64; 2]) -> Wrench<f64>;

    /// Whether forces accelerate each coordinate by itself.
    fn is_balanced(&self) -> bool {
        true
    }

    /// Tells the damping of its own by row and column over its coordinates, N s/m.
    fn add_damping(&self, _add: &mut dyn FnMut([usize; 2], f64)) {}

    /// How its accelerations change with its positions and velocities at these forces, but for the forces themselves; added to
    /// the derivatives over positions and velocities.
    fn add_inertial_slopes(
        &self,
        _on_body: &OnBody<'_>,
        _state: &BodyState<'_>,
        _over_position: DMatrixViewMut<'_, f64>,
        _over_velocity: DMatrixViewMut<'_, f64>,
    ) {
    }

    /// Energy of its motion and its weight.
    fn energy(&self, state: &BodyState<'_>, gravity: [f64; 2]) -> BodyEnergy;

    /// Adds the powers of its loads and supports, W, by [`Power`].
    fn add_powers(&self, state: &BodyState<'_>, inputs: &InputValues, powers: &mut [f64]);

    /// Writes weight, loads and supports into a report.
    fn report(&self, state: &BodyState<'_>, inputs: &InputValues, gravity: [f64; 2], out: &mut BodyForces);

    /// Rates of its load, to the right, upwards, and of its moment, per second, where inputs change at these rates.
    fn load_rates(&self, inputs: &InputValues, rates: &InputValues) -> [f64; 3];

    /// Largest squared frequency in 1/s^2 that a stiffness of `radial` (N/m) between centre and surroundings, and of `turning`
    /// (N/m) along the circle with the radius `lever` (m), gives the body.
    fn frequency_on(&self, radial: f64, turning: f64, lever: f64) -> f64;

    /// Orders and frequencies (rad/s) of the waves of a body that bends, free and at rest.
    fn waves(&self) -> Vec<(u32, f64)> {
        Vec::new()
    }
}

/// Displacement, or its rate, of a place that these amplitudes, or their rates, displace by so much each.
#[inline]
pub(crate) fn displaced(basis: &[[f64; 2]], amplitudes: &[f64]) -> [f64; 2] {
    let sum = |[x, y]: [f64; 2], ([outwards, ahead], a): (&[f64; 2], &f64)| [x + outwards * a, y + ahead * a];
    basis.iter().zip(amplitudes).fold([0.0; 2], sum)
}

/// Weight of `mass` kg as a row of a report.
pub(crate) fn weight(mass: f64, [gy, gz]: [f64; 2]) -> [f64; 3] {
    [mass * gy, mass * gz, 0.0]
}
