//! Rolling elements whose orbit and spin are prescribed: they roll on, whatever the cage does to them.

use super::{Damping, ElementSlopes};
use crate::bodies::{
    BodyEnergy, BodyForces, Coordinate, Element, ElementBlock, ElementSet, Elements, Fault, Input,
    InputValues, Layout, Motions, OF_ELEMENT, WrenchLanes,
};
use crate::scene::Scene;
use crate::space::Wrench;

/// Elements of prescribed motion, at equal distances on the pitch circle.
#[derive(Debug)]
pub(in crate::bodies) struct KinematicElements {
    set: ElementSet,
}

impl KinematicElements {
    /// Those of a scene.
    pub(in crate::bodies) fn new(scene: &Scene) -> Self {
        Self { set: ElementSet::new(scene) }
    }
}

impl Elements for KinematicElements {
    fn set(&self) -> &ElementSet {
        &self.set
    }

    fn kind(&self) -> &'static str {
        "element"
    }

    fn coordinates(&self) -> &'static [Coordinate] {
        &[]
    }

    fn mass(&self) -> Option<f64> {
        None
    }

    fn mobility(&self) -> f64 {
        0.0
    }

    fn centrifugal(&self, _orbit_speed: f64) -> f64 {
        0.0
    }

    fn kinematic_speeds(&self, inputs: &InputValues) -> [f64; 2] {
        [inputs.of(Input::OrbitSpeed), inputs.of(Input::SpinSpeed)]
    }

    fn orbit_ratios(&self) -> [f64; 2] {
        [0.0; 2]
    }

    fn find(
        &self,
        _layout: &Layout,
        _q: &[f64],
        _v: &[f64],
        inputs: &InputValues,
        out: &mut Motions,
    ) -> Result<(), Fault> {
        let [orbit_speed, spin_speed] = self.kinematic_speeds(inputs);
        for ElementBlock { motion, .. } in &mut out.blocks {
            if [motion.orbit_speed[0], motion.spin_speed[0]] != [orbit_speed, spin_speed] {
                motion.orbit_speed.fill(orbit_speed);
                motion.spin_speed.fill(spin_speed);
            }
        }
        if out.together != Some(inputs.orbit_travel()) {
            out.turn_together(&self.set, inputs.orbit_travel());
        }
        Ok(())
    }

    fn travel(&self, _layout: &Layout, _q: &[f64], inputs: &InputValues, _j: usize) -> [f64; 2] {
        [inputs.orbit_travel(), 0.0]
    }

    fn accelerate(&self, _: &Layout, _: &Motions, _: &[WrenchLanes], _: [f64; 2], _: &mut [f64]) {}

    fn slopes(
        &self,
        _element: &Element,
        _on_element: &Wrench<f64>,
        _gravity: [f64; 2],
        _over_positions: ElementSlopes<'_>,
        _over_velocities: ElementSlopes<'_>,
    ) -> [f64; OF_ELEMENT] {
        [0.0; OF_ELEMENT]
    }

    fn accelerations_of(&self, _motions: &Motions, _damping: &mut Damping) {}

    fn energy(&self, _element: &Element, _gravity: [f64; 2]) -> BodyEnergy {
        BodyEnergy::default()
    }

    fn report(&self, _gravity: [f64; 2], _out: &mut BodyForces) {}
}
