//! A running simulation: state, integrator and outputs of one model. Mutable, one per thread.

mod balance;
mod bearing;
mod elsewhere;
mod errors;
mod inputs;
mod limits;
mod linear;
mod method;
mod preset;
mod results;
mod snapshot;

pub use crate::integrate::Statistics as DriverStatistics;
pub(crate) use balance::BalanceItem;
pub use balance::{BALANCE_ITEMS, PowerBalance};
pub use limits::{Canceller, RunLimits};
pub use linear::sparse::SparsePattern;
pub use results::interval::Interval;
pub use results::motion::MotionOfCage;
pub use results::over_orbit::{LoadZone, OverOrbit};
pub use results::recording::{Recording, Spread};
pub use results::sample::{LEVEL, Sample, Verdict, student};
pub(crate) use results::statistics::Statistic;
pub use results::statistics::{RunStatistics, STATISTICS};
pub use results::trust::Doubt;
pub use results::whirl::{CageMotion, SMALLEST_WHIRL_RADIUS, WhirlRecord, WhirlSummary};

use crate::error::{Error, Result, Status};
use crate::integrate::{Driver, Failure, Tuning};
use crate::model::{Channel, Energy, FAULTS, Forces, Input, LineLoad, Model, PartTimes, Reading};
use crate::scene::{Preset, Solver};
use bearing::Bearing;
pub(crate) use errors::check_time;
use errors::{bad_index, wrong_size};
use linear::jacobian::AnySlopes;
use linear::newton::Newton;
use std::sync::Arc;

/// Largest simulated time, s: beyond it a step of a nanosecond is lost in round-off.
const MAX_TIME: f64 = 1e6;

/// Largest magnitude of a state that is set: an angle after the longest run at the highest speed, and more.
const LARGEST_STATE: f64 = 1e12;

/// A state that is set is next to the present one within this share of the scales of the model, and at the same time within
/// this share of it, which sums of many steps leave.
const NEAR: f64 = 1e-2;
const SAME_TIME: f64 = 1e-10;

/// What was evaluated last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Evaluated {
    /// The present state.
    State,
    /// The step that covers the present time.
    Step,
    /// Anything else.
    Other,
}

/// A simulation of one model.
///
/// The integrator may have run ahead of [`Sim::time`]; the state is then interpolated. Setting the state or an
/// input restarts the integrator at the current time.
pub struct Sim {
    bearing: Bearing,
    driver: Driver<Bearing>,
    solver: Solver,
    time: f64,
    state: Vec<f64>,
    forces: Forces,
    /// Forces of the last outputs.
    output_forces: Forces,
    accelerations: Vec<f64>,
    /// Made when they are first asked for.
    slopes: Option<AnySlopes>,
    newton: Option<Box<Newton>>,
    /// What the workspace, and with it `forces` or `output_forces`, belongs to.
    evaluated: Evaluated,
    fingerprint: [f64; 2],
    balance: balance::Start,
    /// Of every state, see [`Model::state_scales`].
    scales: Vec<f64>,
}

impl Sim {
    /// A simulation at the start of the scene.
    ///
    /// # Errors
    /// [`Status::BadScene`] when the initial state cannot be found, [`Status::BadState`] when forces are undefined
    /// there.
    pub fn new(model: Arc<Model>) -> Result<Self> {
        Self::with_tuning(model, Tuning::default())
    }

    /// A simulation at the start of the scene, with this preset instead of the scene's; what else the scene says about
    /// its solver stays.
    ///
    /// # Errors
    /// As [`Sim::new`].
    pub fn with_preset(model: Arc<Model>, preset: Preset) -> Result<Self> {
        let solver = Solver { preset, ..model.scene().solver.clone() };
        Self::with_solver(model, solver, Tuning::default())
    }

    /// A simulation at the start of the scene with other constants of the method `auto`, for studies of what they do.
    ///
    /// # Errors
    /// As [`Sim::new`].
    #[doc(hidden)]
    pub fn with_tuning(model: Arc<Model>, tuning: Tuning) -> Result<Self> {
        let solver = model.scene().solver.clone();
        Self::with_solver(model, solver, tuning)
    }

    fn with_solver(model: Arc<Model>, solver: Solver, tuning: Tuning) -> Result<Self> {
        Self::started(model.clone(), solver, tuning).map_err(|error| model.scene().suspected(error))
    }

    fn started(model: Arc<Model>, solver: Solver, tuning: Tuning) -> Result<Self> {
        let state = model.initial_state()?;
        let bearing = Bearing::new(model.clone(), tuning)?;
        let driver = Driver::new(method::stepper(&model, &solver, &bearing), method::limits(&model, &solver));
        let mut sim = Self {
            fingerprint: snapshot::fingerprint(&model, &solver, &tuning),
            accelerations: vec![0.0; model.layout().velocities()],
            scales: model.state_scales(),
            bearing,
            driver,
            solver,
            time: 0.0,
            state,
            forces: Forces::default(),
            output_forces: Forces::default(),
            slopes: None,
            newton: None,
            evaluated: Evaluated::Other,
            balance: balance::Start::default(),
        };
        sim.restart();
        sim.forces()?;
        sim.output_forces.clone_from(&sim.forces);
        sim.start_balance();
        Ok(sim)
    }

    /// The model.
    pub fn model(&self) -> &Arc<Model> {
        self.bearing.model()
    }

    /// How accurate it is, where the method leaves that open.
    pub fn preset(&self) -> Preset {
        self.solver.preset
    }

    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// The state (q, v) at [`Sim::time`]; order and units as in [`Model::state_infos`].
    pub fn state(&self) -> &[f64] {
        &self.state
    }

    /// Sets time and state. Forces must be defined there.
    ///
    /// The present time and state change nothing. A state next to the present one, at the present time and within a hundredth of
    /// the scales of the model ([`Model::state_scales`]), goes on with the method, its step and the power balance; that costs
    /// what [`Sim::set_input`] does: two force evaluations, and steps that grow again from a single one between judgements of
    /// their energy. Any other state begins anew, as where bodies are set down is rarely where they rest: some thirty steps with
    /// controlled errors and derivatives each, a new balance, and, where time has passed and does not go back, a run that
    /// is not judged ([`Sim::not_judged`]). Counts go on.
    ///
    /// # Errors
    /// [`Status::WrongSize`], [`Status::BadValue`] for numbers that are not finite or a negative time,
    /// [`Status::BadState`]. The simulation is then unchanged.
    pub fn set_state(&mut self, time: f64, state: &[f64]) -> Result<()> {
        check_time("time", time)?;
        self.check_state(state)?;
        if time == self.time && state == self.state {
            return Ok(());
        }
        self.evaluated = Evaluated::Other;
        let before = self.is_near(time, state).then(|| self.energy_at_present()).flatten();
        let evaluated = self.bearing.accelerations_at(time, state, &mut self.accelerations);
        evaluated.map_err(|f| self.bad_state(time, f))?;
        let moved = self.time > self.balance.time;
        let back = time < self.time;
        self.time = time;
        self.state.copy_from_slice(state);
        if let Some(before) = before {
            self.balance.shift(before, self.bearing.energy());
            self.restart();
            return Ok(());
        }
        self.driver.forget();
        self.restart();
        self.begin_interval();
        self.start_balance();
        self.balance.set = if back { 0 } else { self.balance.set + u64::from(moved) };
        Ok(())
    }

    /// Whether a state at a time (s) is next to the present one.
    fn is_near(&self, time: f64, state: &[f64]) -> bool {
        let mut pairs = self.state.iter().zip(state).zip(&self.scales);
        (time - self.time).abs() <= SAME_TIME * self.time
            && pairs.all(|((own, new), unit)| (own - new).abs() <= NEAR * unit)
    }

    /// Energy of the present state; `None` where forces are undefined.
    fn energy_at_present(&mut self) -> Option<Energy> {
        let evaluated = self.bearing.accelerations_at(self.time, &self.state, &mut self.accelerations);
        evaluated.ok().map(|()| self.bearing.energy())
    }

    /// All forces at the current state, without stepping.
    ///
    /// # Errors
    /// [`Status::BadState`] when forces are undefined.
    pub fn forces(&mut self) -> Result<&Forces> {
        if self.evaluated != Evaluated::State {
            let evaluated = self.bearing.accelerations_at(self.time, &self.state, &mut self.accelerations);
            evaluated.map_err(|f| self.bad_state(self.time, f))?;
            self.bearing.report(&self.state, &self.accelerations, &mut self.forces);
            self.evaluated = Evaluated::State;
        }
        Ok(&self.forces)
    }

    /// How a contact, by its place among [`Model::contact_names`], is loaded along its roller at the current state: values of
    /// [`crate::model::LINE_LOAD_QUANTITIES`] for every place, in their order along the roller. None where the surfaces are apart, and of
    /// contacts that are no lines of rollers in space.
    ///
    /// # Errors
    /// [`Status::BadIndex`]; [`Status::BadState`] when forces are undefined.
    pub fn line_loads(&mut self, contact: usize) -> Result<Vec<LineLoad>> {
        let forces = self.forces()?;
        let count = forces.contacts.len().max(forces.space.contacts.len());
        if contact >= count {
            return Err(bad_index("contact", contact, count));
        }
        Ok(self.bearing.line_loads(contact))
    }

    /// Advances by `dt` >= 0 seconds.
    ///
    /// # Errors
    /// As [`Sim::advance_to`].
    pub fn step(&mut self, dt: f64) -> Result<()> {
        check_time("dt", dt)?;
        self.advance_to(self.time + dt)
    }

    /// Advances to time `t` (s), not before the current time.
    ///
    /// # Errors
    /// [`Status::BadValue`]; time and state are then unchanged. [`Status::BadState`], [`Status::StepTooSmall`],
    /// [`Status::TooManySteps`], [`Status::Cancelled`], [`Status::OutOfTime`]: time and state are then those of the last
    /// step that could be made, outputs can be asked for, and the simulation can be reset, changed or asked again.
    pub fn advance_to(&mut self, t: f64) -> Result<()> {
        check_time("t", t)?;
        if t < self.time {
            let text = format!("t: {t:?} s is before the current time {:?} s", self.time);
            return Err(Error::new(Status::BadValue, text));
        }
        self.evaluated = Evaluated::Other;
        if let Some(why) = self.bearing.limits().interruption() {
            return Err(self.failure(Failure::Interrupted { time: self.time, why }));
        }
        let advanced = self.driver.advance(&mut self.bearing, t);
        self.time = t.min(self.driver.reached());
        self.driver.state_at(self.time, &mut self.state);
        advanced.map_err(|failure| self.failure(failure))
    }

    /// What stops this simulation from another thread.
    pub fn canceller(&self) -> Canceller {
        self.bearing.limits().canceller()
    }

    /// Takes back a request to stop that came when nothing ran.
    pub(crate) fn withdraw_cancellation(&self) {
        self.bearing.limits().withdraw();
    }

    /// Lets this simulation run for `seconds` of wall time from now; then it stops with [`Status::OutOfTime`], and so does
    /// every later advance until the limit is set again. Infinity for no limit, as at first.
    ///
    /// # Errors
    /// [`Status::BadValue`] if it is negative or NaN.
    pub fn set_wall_time_limit(&mut self, seconds: f64) -> Result<()> {
        self.bearing.limits_mut().set_wall_time(seconds)
    }

    /// Lets it run within the limits of a search that it is part of.
    pub(crate) fn set_limits(&mut self, limits: &RunLimits) {
        *self.bearing.limits_mut() = limits.clone();
    }

    /// Present value of an input, or of what follows from inputs, such as the orbit speed of elements that roll.
    pub(crate) fn input_at_present(&self, input: Input) -> f64 {
        self.model().inputs_at(self.time, self.bearing.host()).of(input)
    }

    /// Back to the start of the scene. Inputs set by the host follow the scene again; counts start at zero.
    ///
    /// # Errors
    /// As [`Sim::new`].
    pub fn reset(&mut self) -> Result<()> {
        let state = self.model().initial_state()?;
        self.bearing.reset();
        self.time = 0.0;
        self.state.copy_from_slice(&state);
        self.driver.reset();
        self.restart();
        self.begin_interval();
        self.forces()?;
        self.balance.set = 0;
        self.start_balance();
        Ok(())
    }

    /// The output channels.
    pub fn channels(&self) -> &[Channel] {
        self.model().channels()
    }

    /// Writes the value of every output channel at the current state. With the leapfrog, forces are those of the step that
    /// covers this time: what it applied to the rollers, and for cage and ring the reactions; those of the guide are the
    /// evaluated ones. With every other method, and before the first step from a set state or input, they are those of the
    /// state.
    ///
    /// # Errors
    /// [`Status::WrongSize`], [`Status::BadState`]; `out` is then unchanged.
    pub fn outputs(&mut self, out: &mut [f64]) -> Result<()> {
        if out.len() != self.channels().len() {
            return Err(wrong_size("outputs", out.len(), self.channels().len()));
        }
        self.find_output_forces()?;
        let reading = self.reading();
        for (out, channel) in out.iter_mut().zip(self.channels()) {
            *out = reading.value(channel);
        }
        Ok(())
    }

    /// The present state with the forces that were found for outputs.
    fn reading(&self) -> Reading<'_> {
        let of_step = self.evaluated == Evaluated::Step;
        let forces = if of_step { &self.output_forces } else { &self.forces };
        self.bearing.reading(self.time, &self.state, forces)
    }

    /// Finds the forces for outputs at the present time.
    fn find_output_forces(&mut self) -> Result<()> {
        let Some((t, step)) = self.driver.applied_at(self.time) else { return self.forces().map(|_| ()) };
        if self.evaluated != Evaluated::Step {
            self.evaluated = Evaluated::Other;
            let reported = self.bearing.report_step(t, &step, &self.state, &mut self.output_forces);
            reported.map_err(|fault| self.bad_state(t, fault))?;
            self.evaluated = Evaluated::Step;
        }
        Ok(())
    }

    /// Value of one output channel at the current state.
    ///
    /// # Errors
    /// [`Status::BadIndex`], [`Status::BadState`].
    pub fn output(&mut self, index: usize) -> Result<f64> {
        let count = self.channels().len();
        if index >= count {
            return Err(bad_index("output", index, count));
        }
        self.find_output_forces()?;
        Ok(self.reading().value(&self.channels()[index]))
    }

    /// Step that runs start with, s; a method without error control keeps it.
    pub fn nominal_step(&self) -> f64 {
        method::limits(self.model(), &self.solver).nominal_step
    }

    /// Counts since creation or reset; a restored simulation goes on from the saved counts.
    pub fn statistics(&self) -> RunStatistics {
        RunStatistics {
            driver: *self.driver.statistics(),
            choice: self.driver.choice(),
            faults: *self.bearing.fault_counts(),
            evaluations: self.bearing.evaluations(),
            jacobians: self.bearing.jacobians(),
            laws: self.bearing.law_counts(),
        }
    }

    /// Whether force evaluations use the widest vector instructions of the machine, as they do at first, or none. Results
    /// have the same bits.
    #[doc(hidden)]
    pub fn set_vector_instructions(&mut self, vector: bool) {
        self.bearing.set_vector_instructions(vector);
    }

    /// Wall time of each of [`PARTS`](crate::model::PARTS) of one force evaluation, s: the mean over these times (s) and
    /// states, each measured `repeats` times. The simulation's own state is not touched, and nothing is counted. Zeros
    /// without states.
    ///
    /// # Errors
    /// As [`Sim::derivative`].
    #[doc(hidden)]
    pub fn time_parts(&mut self, states: &[(f64, Vec<f64>)], repeats: u32) -> Result<PartTimes> {
        let mut mean = PartTimes::default();
        for (t, state) in states {
            check_time("t", *t)?;
            self.check_state(state)?;
            self.evaluated = Evaluated::Other;
            let times =
                self.bearing.time_parts(*t, state, repeats).map_err(|fault| self.bad_state(*t, fault))?;
            for (mean, time) in mean.iter_mut().zip(times) {
                *mean += time / states.len() as f64;
            }
        }
        Ok(mean)
    }

    /// What the integration does and why, what went wrong on the way, and what speaks against trusting it, in one line for
    /// people.
    pub fn report(&mut self) -> String {
        let mut text = match self.driver.choice() {
            Some(choice) => method::describe(&choice),
            None => self.solver.method.name().to_owned(),
        };
        let rms = self.driver.statistics().vibration.rms();
        if rms > 0.0 {
            text += &format!("; loaded raceway contacts vibrate with {rms:.3e} m/s rms");
        }
        for (name, count) in FAULTS.iter().zip(self.bearing.fault_counts()).filter(|(_, n)| **n > 0) {
            text += &format!("; {count} failed attempts: {name}");
        }
        if let Some((t, fault)) = self.bearing.last_fault() {
            text += &format!("; the last one at t = {t:?} s: {}", self.bearing.describe(fault));
        }
        if let Some((body, count)) = self.bearing.most_rejections() {
            text += &format!("; most rejected steps, {count}, for {body}");
        }
        if let Some(field) = self.model().energy_giving_film() {
            text += &format!("; the film of the guide can give energy to the cage ({field})");
        }
        for remark in self.remarks() {
            text += &format!("; {remark}");
        }
        let doubts = self.doubts();
        if let Some(why) = self.not_judged() {
            text += &format!("; not judged: {why}");
        }
        if !doubts.is_empty() {
            text += &format!("; not to be trusted: {}", results::trust::in_words(&doubts));
        }
        text
    }

    fn restart(&mut self) {
        self.driver.start(self.time, &self.state);
        self.evaluated = Evaluated::Other;
    }

    pub(crate) fn check_state(&self, state: &[f64]) -> Result<()> {
        if state.len() != self.state.len() {
            return Err(wrong_size("state", state.len(), self.state.len()));
        }
        // What is not a number is not within it. All at once: hosts ask for every evaluation.
        if state.iter().fold(true, |all, x| all & is_state(x)) { Ok(()) } else { Err(self.bad_number(state)) }
    }

    /// What is wrong with the first number that no state can have.
    #[cold]
    fn bad_number(&self, state: &[f64]) -> Error {
        let i = state.iter().position(|x| !is_state(x)).unwrap_or_default();
        let info = &self.model().state_infos()[i];
        let text = if state[i].is_finite() {
            format!("{:e} {} is not within {:e} of zero", state[i], info.unit, LARGEST_STATE)
        } else {
            format!("{} is not a finite number", state[i])
        };
        Error::new(Status::BadValue, format!("state[{i}] ({}): {text}", info.name))
    }
}

fn is_state(x: &f64) -> bool {
    x.abs() <= LARGEST_STATE
}
