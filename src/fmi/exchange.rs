//! Model exchange: rates and outputs at the times, states and inputs that the integrator of the importer tries.
//!
//! What a step of the importer ends with is committed. From there on inputs go straight to the values of a trial, so that angles, which
//! are integrals of speeds, belong to a trial and not to those before it.

use super::instance::{Exchange, Found, Instance, Interface, Mode};
use crate::error::{Error, Result, Status};

impl Instance {
    fn exchanges(&self) -> Result<()> {
        match self.interface {
            Interface::ModelExchange => Ok(()),
            Interface::CoSimulation => Err(Error::new(
                Status::BadValue,
                "is for model exchange; this instance is one for co-simulation".to_owned(),
            )),
        }
    }

    /// Sets the time of the importer, s.
    ///
    /// # Errors
    /// [`Status::BadValue`] for a time before the start, and in other modes.
    pub fn set_time(&mut self, time: f64) -> Result<()> {
        self.exchanges()?;
        self.in_mode(&[Mode::Continuous, Mode::Event])?;
        let t = time - self.start;
        if !(t >= 0.0 && t.is_finite()) {
            let text = format!("time: {time:?} s is not a time from the start {:?} s on", self.start);
            return Err(Error::new(Status::BadValue, text));
        }
        self.exchange.time = t;
        self.found = Found::default();
        Ok(())
    }

    /// Sets the continuous states.
    ///
    /// # Errors
    /// [`Status::WrongSize`]; [`Status::BadValue`] for numbers that no state can have, and in other modes.
    pub fn set_state(&mut self, state: &[f64]) -> Result<()> {
        self.exchanges()?;
        self.in_mode(&[Mode::Continuous, Mode::Event])?;
        self.sim()?.check_state(state)?;
        self.exchange.state.copy_from_slice(state);
        self.found = Found::default();
        Ok(())
    }

    /// Commits the inputs of the present time, at the end of a step of the importer.
    ///
    /// # Errors
    /// [`Status::BadValue`] for an instance of co-simulation.
    pub fn commit(&mut self) -> Result<()> {
        self.exchanges()?;
        self.sim()?;
        self.hold_inputs()?;
        let Some(sim) = &self.sim else { return Ok(()) };
        (self.exchange.held, self.exchange.since) = (sim.host_inputs(), self.exchange.time);
        Ok(())
    }

    /// Brings the inputs of the simulation to those of the trial.
    fn hold_inputs(&mut self) -> Result<()> {
        let Exchange { time, held, since, .. } = self.exchange;
        let unit = self.unit.clone();
        let Some(sim) = &mut self.sim else { return Ok(()) };
        sim.set_host_inputs(held);
        for (k, value) in self.inputs.iter().enumerate() {
            if let Some(value) = value {
                sim.hold_elsewhere(k, [since, time], *value).map_err(|e| unit.input_named(k, e))?;
            }
        }
        Ok(())
    }

    /// Value of an input at the present time.
    pub(super) fn input(&mut self, k: usize) -> Result<f64> {
        match self.interface {
            Interface::CoSimulation => self.sim()?.input(k),
            Interface::ModelExchange => {
                let (time, _) = self.prepare()?;
                self.sim()?.input_elsewhere(k, time)
            }
        }
    }

    /// Time and state that values belong to, with the inputs of the simulation brought there.
    pub(super) fn prepare(&mut self) -> Result<(f64, Vec<f64>)> {
        let interface = self.interface;
        let sim = self.sim()?;
        if interface == Interface::CoSimulation {
            return Ok((sim.time(), sim.state().to_vec()));
        }
        let (time, state) = (self.exchange.time, self.exchange.state.clone());
        self.hold_inputs()?;
        Ok((time, state))
    }

    pub(super) fn exchanged_outputs(&mut self) -> Result<Vec<f64>> {
        let (t, state) = self.prepare()?;
        let sim = self.sim()?;
        let mut out = vec![0.0; sim.channels().len()];
        sim.outputs_at(t, &state, &mut out)?;
        Ok(out)
    }

    pub(super) fn exchanged_rates(&mut self) -> Result<Vec<f64>> {
        let (t, state) = self.prepare()?;
        let mut out = vec![0.0; state.len()];
        self.sim()?.derivative(t, &state, &mut out)?;
        Ok(out)
    }
}
