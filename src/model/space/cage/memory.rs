//! A cage with its pairs, and what is known of it at a state.

use crate::bodies::{CageInSpace, CageState, MovingCage, OF_CAGE};
use crate::pairs::ball_pocket::{BallPockets, PocketContact, WALLS};
use crate::pairs::guide::land::{BentLandForces, Land, LandForce};
use crate::scalar::{Dual, Numeric};
use crate::space::solid::Vector;
use nalgebra::DMatrix;

/// A cage with its pairs.
#[derive(Debug)]
pub(in super::super) struct CageOfScene {
    pub(in super::super) body: CageInSpace,
    pub(in super::super) pockets: Option<BallPockets>,
    pub(in super::super) lands: Vec<Land>,
}

/// A ball that touches a wall of its pocket.
#[derive(Clone, Debug)]
pub(in super::super) struct Touching {
    pub(in super::super) ball: usize,
    pub(in super::super) wall: usize,
    pub(in super::super) contact: PocketContact<f64>,
    /// In the step from the last evaluated state: change of force and moment on the cage in axes of the bearing, normal force, friction on the
    /// ball in the axes of its azimuth, and powers of damping and friction, W.
    pub(in super::super) reaction: [Vector<f64>; 2],
    pub(in super::super) normal: f64,
    pub(in super::super) friction: Vector<f64>,
    pub(super) powers: [f64; 2],
    /// Power on the ball, W.
    pub(super) on_ball: f64,
    /// The change of what acts on the displacement of the pocket of a cage that bends, N.
    pub(super) on_bending: [f64; 2],
}

/// Room for derivatives of a cage that bends along one direction: amplitudes and rates of its modes, forces over them, also of one land,
/// their accelerations.
#[derive(Clone, Debug, Default)]
pub(super) struct AlongOne {
    pub(super) of_modes: [Vec<Dual<1>>; 2],
    pub(super) on_modes: Vec<Dual<1>>,
    pub(super) by_land: Vec<Dual<1>>,
    pub(super) out: Vec<Dual<1>>,
}

impl AlongOne {
    fn new(modes: usize) -> Self {
        let zeros = || vec![Dual::lift(0.0); modes];
        Self { of_modes: [zeros(), zeros()], on_modes: zeros(), by_land: zeros(), out: zeros() }
    }

    /// Takes these amplitudes and rates as constants.
    pub(super) fn hold(&mut self, of_modes: [&[f64]; 2]) {
        for (to, from) in self.of_modes.iter_mut().zip(of_modes) {
            to.iter_mut().zip(from).for_each(|(to, x)| *to = Dual::lift(*x));
        }
    }
}

/// What is known of the cage at the last evaluated state.
#[derive(Clone, Debug)]
pub(in super::super) struct CageMemory {
    pub(in super::super) state: CageState<f64>,
    pub(in super::super) moving: MovingCage<f64>,
    pub(in super::super) touching: Vec<Touching>,
    pub(in super::super) lands: Vec<LandForce<f64>>,
    /// Of a cage that bends: amplitudes of its modes, m, and their rates, m/s, forces over them, N, also those of a step, and each land.
    pub(in super::super) of_modes: [Vec<f64>; 2],
    pub(in super::super) on_modes: [Vec<f64>; 2],
    pub(super) bent: Vec<BentLandForces>,
    pub(super) along: AlongOne,
    /// Accelerations over forces, after those of the cage were differentiated: force and moment, those over the modes.
    pub(in super::super) by_forces: DMatrix<f64>,
    pub(in super::super) load: [Vector<f64>; 2],
    /// Of pockets alone.
    pub(in super::super) by_pockets: [Vector<f64>; 2],
    /// Of all but its weight.
    pub(in super::super) on_cage: [Vector<f64>; 2],
}

impl CageMemory {
    /// For a cage with so many balls.
    pub(in super::super) fn new(balls: usize, cage: Option<&CageOfScene>) -> Self {
        let state = CageState { position: [0.0; OF_CAGE], rate: [0.0; OF_CAGE] };
        let modes = || vec![0.0; cage.map_or(0, |cage| cage.body.bending())];
        let lands = cage.map_or(&[][..], |cage| &cage.lands);
        Self {
            state,
            moving: state.motion(),
            touching: Vec::with_capacity(WALLS * balls),
            lands: vec![LandForce::default(); lands.len()],
            of_modes: [modes(), modes()],
            on_modes: [modes(), modes()],
            bent: lands.iter().filter_map(Land::memory).collect(),
            along: AlongOne::new(modes().len()),
            by_forces: DMatrix::zeros(OF_CAGE + modes().len(), OF_CAGE + modes().len()),
            load: [[0.0; 3]; 2],
            by_pockets: [[0.0; 3]; 2],
            on_cage: [[0.0; 3]; 2],
        }
    }

    /// Amplitudes and rates of the modes.
    pub(in super::super) fn bending(&self) -> [&[f64]; 2] {
        self.of_modes.each_ref().map(Vec::as_slice)
    }
}
