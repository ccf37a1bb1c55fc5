//! An initial value problem made of a scene: where it starts, when it is looked at, and how errors of it are measured.

use cagedyn::scene::{Method, Solver};
use cagedyn::{Model, Result, Scene, Sim};
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// Largest step of all methods with error control, s, with rollers, whose loaded contacts keep steps short; and without
/// them, in units of 1/(highest frequency): half the time of a contact. The library's own limits.
const LARGEST_STEP: f64 = 1e-4;
const LARGEST_SHARE: f64 = FRAC_PI_2;

/// A scene, its start and the times at which its states are compared.
#[derive(Clone)]
pub struct Problem {
    scene: Scene,
    model: Arc<Model>,
    /// State at time zero.
    pub start: Vec<f64>,
    /// Times, growing, s.
    pub times: Vec<f64>,
    /// One unit of error of each state.
    pub scales: Vec<f64>,
    /// Largest step of methods with error control, s.
    pub max_step: f64,
}

impl Problem {
    /// The start of a scene, looked at `count` times until `end` in s.
    ///
    /// # Errors
    /// As [`Model::new`] and [`Sim::new`].
    pub fn new(scene: Scene, end: f64, count: u32) -> Result<Self> {
        let model = Arc::new(Model::new(scene.clone())?);
        let start = Sim::new(model.clone())?.state().to_vec();
        let share = LARGEST_SHARE / model.highest_frequency();
        let max_step = if model.has_rollers() { LARGEST_STEP } else { share.min(LARGEST_STEP) };
        let times = (1..=count).map(|i| end * f64::from(i) / f64::from(count)).collect();
        Ok(Self { scales: model.state_scales(), scene, model, start, times, max_step })
    }

    /// The same from the state that the scene reaches after `settling` s, at time zero: not for elements with prescribed motion,
    /// which are elsewhere then.
    ///
    /// # Errors
    /// Those of the run.
    pub fn developed(mut self, settling: f64) -> Result<Self> {
        let mut sim = Sim::new(self.model.clone())?;
        sim.advance_to(settling)?;
        self.start = sim.state().to_vec();
        Ok(self)
    }

    /// The same without times after `end` in s.
    pub fn until(mut self, end: f64) -> Self {
        self.times.retain(|t| *t <= end);
        self
    }

    /// The compiled scene.
    pub fn model(&self) -> &Arc<Model> {
        &self.model
    }

    /// Last time, s.
    pub fn end(&self) -> f64 {
        self.times.last().copied().unwrap_or(0.0)
    }

    /// A simulation at the start, integrated by this method.
    ///
    /// # Errors
    /// Those of the scene.
    pub fn sim(&self, method: Method) -> Result<Sim> {
        let solver = Solver { method, max_step: Some(self.max_step), ..self.scene.solver.clone() };
        self.started(Sim::new(Arc::new(Model::new(Scene { solver, ..self.scene.clone() })?))?)
    }

    /// Takes a simulation of the scene to the start.
    ///
    /// # Errors
    /// As [`Sim::set_state`].
    pub fn started(&self, mut sim: Sim) -> Result<Sim> {
        sim.set_state(0.0, &self.start)?;
        Ok(sim)
    }

    /// Largest difference of positions, m: angles count as arcs of the pitch circle.
    pub fn distance(&self, a: &[Vec<f64>], b: &[Vec<f64>]) -> f64 {
        let positions = self.model.layout().positions();
        // All positions have the same unit of error as a length.
        let length = self.length();
        let states = a.iter().zip(b);
        let difference = |(a, b): (&Vec<f64>, &Vec<f64>)| {
            let pairs = a.iter().zip(b).zip(&self.scales).take(positions);
            pairs.map(|((a, b), scale)| length * (a - b).abs() / scale).fold(0.0, f64::max)
        };
        states.map(difference).fold(0.0, f64::max)
    }

    /// The reference clearance, m.
    fn length(&self) -> f64 {
        let infos = self.model.state_infos();
        let lengths = infos.iter().zip(&self.scales).filter(|(info, _)| info.unit == "m");
        lengths.map(|(_, scale)| *scale).fold(0.0, f64::max)
    }
}
