//! An instance of a unit: modes, values of variables, co-simulation.

use super::variables::{Kind, Unit};
use crate::error::{Error, Result, Status};
use crate::model::HostInputs;
use crate::sim::Sim;
use std::sync::Arc;

/// A communication point may be this share of the time, or of a nanosecond, off the time of the instance.
const SAME_TIME: f64 = 1e-9;

/// How an importer uses an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interface {
    /// The importer integrates.
    ModelExchange,
    /// The instance does.
    CoSimulation,
}

/// What an instance is ready for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Parameters and inputs may be set.
    Instantiated,
    /// The same, and outputs asked for.
    Initialization,
    /// Of co-simulation: steps.
    Step,
    /// Inputs may jump.
    Event,
    /// Of model exchange: integration.
    Continuous,
    /// Nothing but a reset.
    Terminated,
}

/// Values that follow from state, time and inputs, found when they are asked for.
#[derive(Debug, Default)]
pub(super) struct Found {
    outputs: Option<Vec<f64>>,
    rates: Option<Vec<f64>>,
    pub(super) slopes: Option<Slopes>,
}

/// Derivatives at the present time, state and inputs, by columns: rates and outputs over states and over inputs.
#[derive(Debug)]
pub(super) struct Slopes {
    pub(super) rates: [Vec<f64>; 2],
    pub(super) outputs: [Vec<f64>; 2],
}

/// Time and state of a trial, and the inputs that were committed.
#[derive(Clone, Debug, Default)]
pub(super) struct Exchange {
    /// s from the start of the run.
    pub(super) time: f64,
    pub(super) state: Vec<f64>,
    /// Inputs at the time that was committed, s.
    pub(super) held: HostInputs,
    pub(super) since: f64,
}

impl Exchange {
    fn at_start_of(sim: &Sim) -> Self {
        Self { time: sim.time(), state: sim.state().to_vec(), held: sim.host_inputs(), since: sim.time() }
    }
}

/// An instance.
pub struct Instance {
    pub(super) unit: Arc<Unit>,
    pub(super) interface: Interface,
    pub(super) mode: Mode,
    /// Time of the importer at the start of the run, s.
    pub(super) start: f64,
    pub(super) parameters: Vec<f64>,
    /// Inputs that the importer has set to other values than those of the start, and their slopes.
    pub(super) inputs: Vec<Option<f64>>,
    /// Made when it is first needed: values of a start may be set before.
    pub(super) sim: Option<Sim>,
    /// Time and state of model exchange.
    pub(super) exchange: Exchange,
    pub(super) found: Found,
}

impl Instance {
    /// A new one.
    pub fn new(unit: Arc<Unit>, interface: Interface) -> Self {
        Self {
            parameters: unit.parameters.iter().map(|(_, value)| *value).collect(),
            inputs: vec![None; unit.model.input_count()],
            unit,
            interface,
            mode: Mode::Instantiated,
            start: 0.0,
            sim: None,
            exchange: Exchange::default(),
            found: Found::default(),
        }
    }

    /// As it was when it was made.
    pub fn reset(&mut self) {
        *self = Self::new(self.unit.clone(), self.interface);
    }

    /// Number of continuous states.
    pub fn state_count(&self) -> usize {
        (self.unit.rates - self.unit.states) as usize
    }

    /// Refuses a call in any other mode than these.
    pub(super) fn in_mode(&self, allowed: &[Mode]) -> Result<()> {
        if allowed.contains(&self.mode) {
            return Ok(());
        }
        let names: Vec<String> = allowed.iter().map(|mode| format!("{mode:?}")).collect();
        let text = format!("not allowed in mode {:?}; it is in {}", self.mode, names.join(", "));
        Err(Error::new(Status::BadValue, text))
    }

    /// Begins the initialization of a run that starts at time `start` (s), which is that of the scene's start.
    ///
    /// # Errors
    /// [`Status::BadValue`] in another mode or for a time that is not finite.
    pub fn enter_initialization(&mut self, start: f64) -> Result<()> {
        self.in_mode(&[Mode::Instantiated])?;
        if !start.is_finite() {
            return Err(Error::new(Status::BadValue, format!("startTime: {start} is not a finite number")));
        }
        (self.start, self.mode) = (start, Mode::Initialization);
        Ok(())
    }

    /// Ends it: parameters are fixed from now on. Co-simulation goes on in steps, or with events if the importer uses them.
    ///
    /// # Errors
    /// As [`Sim::new`], where the parameters describe no bearing.
    pub fn exit_initialization(&mut self, with_events: bool) -> Result<()> {
        self.in_mode(&[Mode::Initialization])?;
        self.sim()?;
        self.mode = match self.interface {
            Interface::CoSimulation if !with_events => Mode::Step,
            _ => Mode::Event,
        };
        Ok(())
    }

    /// Goes from one mode to another.
    ///
    /// # Errors
    /// [`Status::BadValue`] from a mode that does not lead there, or for a mode that this interface has not.
    pub fn enter(&mut self, mode: Mode) -> Result<()> {
        use Mode::{Continuous, Event, Step, Terminated};
        let exchange = self.interface == Interface::ModelExchange;
        self.in_mode(match (exchange, mode) {
            (false, Event | Step) => &[Step, Event],
            (true, Event) => &[Continuous, Event],
            (true, Continuous) => &[Event],
            (_, Terminated) => &[Step, Event, Continuous],
            _ => {
                let text = format!("{:?} has no mode {mode:?}", self.interface);
                return Err(Error::new(Status::BadValue, text));
            }
        })?;
        if exchange && mode != Terminated {
            self.commit()?;
        }
        self.mode = mode;
        Ok(())
    }

    /// The simulation, made of the parameters when it is first asked for.
    pub(super) fn sim(&mut self) -> Result<&mut Sim> {
        if self.sim.is_none() {
            let mut sim = Sim::new(self.unit.with(&self.parameters)?)?;
            for (k, value) in self.inputs.iter().enumerate() {
                if let Some(value) = value {
                    sim.set_input(k, *value).map_err(|e| self.unit.input_named(k, e))?;
                }
            }
            self.exchange = Exchange::at_start_of(&sim);
            self.sim = Some(sim);
        }
        self.sim.as_mut().ok_or_else(|| Error::new(Status::Internal, "no simulation".to_owned()))
    }

    /// Time of the importer, s.
    pub fn time(&self) -> f64 {
        self.start
            + match (self.interface, &self.sim) {
                (Interface::ModelExchange, _) => self.exchange.time,
                (Interface::CoSimulation, Some(sim)) => sim.time(),
                (Interface::CoSimulation, None) => 0.0,
            }
    }

    /// Writes the values of variables.
    ///
    /// # Errors
    /// [`Status::BadIndex`]; as [`Sim::outputs`] and [`Sim::derivative`]. `out` is then unchanged.
    pub fn values(&mut self, references: &[u32], out: &mut [f64]) -> Result<()> {
        let found =
            references.iter().map(|reference| self.value(*reference)).collect::<Result<Vec<f64>>>()?;
        out.copy_from_slice(&found);
        Ok(())
    }

    fn value(&mut self, reference: u32) -> Result<f64> {
        let kind = self.unit.variable(reference)?.kind;
        match kind {
            Kind::Time => Ok(self.time()),
            Kind::Parameter(k) => Ok(self.parameters[k]),
            Kind::Input(k) if self.sim.is_none() => {
                let start = self.unit.variables[reference as usize].start.unwrap_or_default();
                Ok(self.inputs[k].unwrap_or(start))
            }
            Kind::Input(k) => self.input(k),
            Kind::Output(k) => {
                if self.found.outputs.is_none() {
                    let outputs = self.outputs()?;
                    self.found.outputs = Some(outputs);
                }
                Ok(self.found.outputs.as_ref().map_or(f64::NAN, |outputs| outputs[k]))
            }
            Kind::State(k) => Ok(self.state()?[k]),
            Kind::Rate(k) => Ok(self.rates()?[k]),
        }
    }

    fn outputs(&mut self) -> Result<Vec<f64>> {
        if self.interface == Interface::ModelExchange {
            return self.exchanged_outputs();
        }
        let sim = self.sim()?;
        let mut out = vec![0.0; sim.channels().len()];
        sim.outputs(&mut out)?;
        Ok(out)
    }

    /// The continuous states.
    ///
    /// # Errors
    /// As [`Sim::new`].
    pub fn state(&mut self) -> Result<&[f64]> {
        self.sim()?;
        match (self.interface, &self.sim) {
            (Interface::CoSimulation, Some(sim)) => Ok(sim.state()),
            _ => Ok(&self.exchange.state),
        }
    }

    /// Rates of the continuous states.
    ///
    /// # Errors
    /// As [`Sim::derivative`].
    pub fn rates(&mut self) -> Result<&[f64]> {
        if self.found.rates.is_none() {
            let rates = self.exchanged_rates()?;
            self.found.rates = Some(rates);
        }
        Ok(self.found.rates.as_deref().unwrap_or_default())
    }

    /// Nominal values of the continuous states: the scales in which errors are controlled.
    pub fn nominals(&self) -> Vec<f64> {
        self.unit.model.state_scales()
    }

    /// Sets parameters before the run, and inputs.
    ///
    /// # Errors
    /// [`Status::BadIndex`]; [`Status::BadValue`] for a value that is not allowed, for variables that follow from others, and in modes in
    /// which they are fixed. What comes before such a value is set.
    pub fn set_values(&mut self, references: &[u32], values: &[f64]) -> Result<()> {
        for (reference, value) in references.iter().zip(values) {
            let variable = self.unit.variable(*reference)?;
            let refuse = |why: &str| Err(Error::new(Status::BadValue, format!("{}: {why}", variable.name)));
            if !value.is_finite() {
                return refuse(&format!("{value} is not a finite number"));
            }
            match variable.kind {
                Kind::Parameter(k) => {
                    if !matches!(self.mode, Mode::Instantiated | Mode::Initialization) {
                        return refuse("a parameter is fixed after the initialization");
                    }
                    self.parameters[k] = *value;
                    (self.sim, self.found) = (None, Found::default());
                }
                Kind::Input(k) => {
                    // What an importer repeats of the description leaves the scene its function of time.
                    let follows = self.inputs[k].is_none() && variable.start == Some(*value);
                    if !follows {
                        self.set_input(k, *value, None)?;
                    }
                }
                Kind::Time | Kind::Output(_) | Kind::State(_) | Kind::Rate(_) => {
                    return refuse("follows from others and cannot be set");
                }
            }
        }
        Ok(())
    }

    /// Sets an input, of co-simulation with a slope per second if there is one.
    pub(super) fn set_input(&mut self, k: usize, value: f64, slope: Option<f64>) -> Result<()> {
        self.in_mode(&[Mode::Instantiated, Mode::Initialization, Mode::Step, Mode::Event, Mode::Continuous])?;
        let unit = self.unit.clone();
        if let (Interface::CoSimulation, Some(sim)) = (self.interface, &mut self.sim) {
            let set = match slope {
                Some(slope) => sim.set_input_slope(k, value, slope),
                None => sim.set_input(k, value),
            };
            set.map_err(|e| unit.input_named(k, e))?;
        } else if let Some(input) = unit.model.input_list().nth(k) {
            unit.model.check_input(input, value).map_err(|e| unit.input_named(k, e))?;
        }
        self.inputs[k] = Some(value);
        self.found = Found::default();
        Ok(())
    }

    /// Lets inputs go on with these slopes, per second, from the values that they have.
    ///
    /// # Errors
    /// As [`Instance::set_values`].
    pub fn set_input_slopes(&mut self, references: &[u32], slopes: &[f64]) -> Result<()> {
        if self.interface != Interface::CoSimulation {
            return Err(Error::new(Status::BadValue, "slopes of inputs are for co-simulation".to_owned()));
        }
        for (reference, slope) in references.iter().zip(slopes) {
            let variable = self.unit.variable(*reference)?;
            let Kind::Input(k) = variable.kind else {
                return Err(Error::new(Status::BadValue, format!("{}: is no input", variable.name)));
            };
            self.sim()?;
            let value = self.input(k)?;
            self.set_input(k, value, Some(*slope))?;
        }
        Ok(())
    }

    /// Advances a co-simulation from `current` by `step` (s). Returns the time of the importer that it has come to.
    ///
    /// # Errors
    /// [`Status::BadValue`] for another time than that of the instance, or a step that is not positive; as [`Sim::advance_to`], whose last
    /// step then is what the instance has.
    pub fn do_step(&mut self, current: f64, step: f64) -> Result<f64> {
        self.in_mode(&[Mode::Step])?;
        let here = self.time();
        let same = (current - here).abs() <= SAME_TIME * (1.0 + here.abs());
        if !same {
            let text = format!(
                "currentCommunicationPoint: {current:?} s is not the time {here:?} s of the instance"
            );
            return Err(Error::new(Status::BadValue, text));
        }
        if !(step > 0.0 && step.is_finite()) {
            return Err(Error::new(
                Status::BadValue,
                format!("communicationStepSize: {step:?} s is not positive"),
            ));
        }
        self.found = Found::default();
        let to = current - self.start + step;
        self.sim()?.advance_to(to)?;
        Ok(self.time())
    }

    /// Force evaluations of co-simulation until now.
    pub fn evaluations(&self) -> u64 {
        self.sim.as_ref().map_or(0, |sim| sim.statistics().evaluations)
    }

    /// The next time of the importer at which an input of the scene jumps or has a kink, if there is one.
    ///
    /// # Errors
    /// As [`Sim::next_event`].
    pub fn next_event(&mut self) -> Result<Option<f64>> {
        let (start, time) = (self.start, self.time() - self.start);
        let event = self.sim()?.next_event(time)?;
        Ok(event.is_finite().then_some(start + event))
    }
}

impl Unit {
    /// An error that names an input.
    pub(super) fn input_named(&self, k: usize, error: Error) -> Error {
        let name = self.model.input_infos().get(k).map_or(String::new(), |info| info.name.clone());
        Error::new(error.status, format!("{name}: {}", error.message))
    }
}
