//! What a bearing does at arbitrary states, for hosts with their own integrator: rates, forces, outputs, energies. The state and
//! the integration of the simulation are not touched, and nothing is counted.

use super::errors::{check_time, wrong_size};
use super::{Evaluated, Sim};
use crate::error::Result;
use crate::integrate::Observed;
use crate::model::{Energy, Forces, HostInputs, POWERS, RATES};

impl Sim {
    /// Rate of an arbitrary state at time `t` (s), for hosts with their own integrator. The simulation's own state
    /// is not touched.
    ///
    /// # Errors
    /// [`crate::Status::WrongSize`], [`crate::Status::BadValue`], [`crate::Status::BadState`]; `rate` is then unchanged.
    pub fn derivative(&mut self, t: f64, state: &[f64], rate: &mut [f64]) -> Result<()> {
        if rate.len() != state.len() {
            return Err(wrong_size("rate", rate.len(), state.len()));
        }
        let [velocities, accelerations] = self.derivative_parts(t, state)?;
        let (of_positions, of_velocities) = rate.split_at_mut(velocities.len());
        of_positions.copy_from_slice(velocities);
        of_velocities.copy_from_slice(accelerations);
        Ok(())
    }

    /// What [`Sim::derivative`] gives, where it lies: the velocities in `state`, and all behind them.
    pub(crate) fn derivative_parts<'a>(&'a mut self, t: f64, state: &'a [f64]) -> Result<[&'a [f64]; 2]> {
        self.evaluate_at(t, state)?;
        let nq = self.model().layout().positions();
        Ok([&state[nq..2 * nq], &self.accelerations])
    }

    /// All forces at an arbitrary state and time `t` (s).
    ///
    /// # Errors
    /// As [`Sim::derivative`].
    pub fn forces_at(&mut self, t: f64, state: &[f64]) -> Result<&Forces> {
        self.evaluate_at(t, state)?;
        self.bearing.report(state, &self.accelerations, &mut self.forces);
        Ok(&self.forces)
    }

    /// Writes the value of every output channel at an arbitrary state and time `t` (s).
    ///
    /// # Errors
    /// As [`Sim::derivative`]; `out` is then unchanged.
    pub fn outputs_at(&mut self, t: f64, state: &[f64], out: &mut [f64]) -> Result<()> {
        if out.len() != self.channels().len() {
            return Err(wrong_size("outputs", out.len(), self.channels().len()));
        }
        self.forces_at(t, state)?;
        let reading = self.bearing.reading(t, state, &self.forces);
        for (out, channel) in out.iter_mut().zip(self.bearing.model().channels()) {
            *out = reading.value(channel);
        }
        Ok(())
    }

    /// Energies of an arbitrary state at time `t` (s).
    ///
    /// # Errors
    /// As [`Sim::derivative`].
    pub fn energy_at(&mut self, t: f64, state: &[f64]) -> Result<Energy> {
        self.evaluate_at(t, state)?;
        Ok(self.bearing.energy())
    }

    /// Powers that go into the bearing at an arbitrary state and time `t` (s), W, in the order of [`POWERS`]. They are the rate of the
    /// energy there.
    ///
    /// # Errors
    /// As [`Sim::derivative`].
    pub fn powers_at(&mut self, t: f64, state: &[f64]) -> Result<[f64; POWERS.len()]> {
        self.evaluate_at(t, state)?;
        let (q, v) = state.split_at(self.model().layout().positions());
        let mut rates = [0.0; RATES];
        Observed::powers(&mut self.bearing, q, v, None, &mut rates);
        let mut powers = [0.0; POWERS.len()];
        powers.copy_from_slice(&rates[..POWERS.len()]);
        Ok(powers)
    }

    /// The inputs that a host holds.
    pub(crate) fn host_inputs(&self) -> HostInputs {
        *self.bearing.host()
    }

    /// Holds these inputs, as they were held before, for what is asked elsewhere.
    pub(crate) fn set_host_inputs(&mut self, held: HostInputs) {
        *self.bearing.host_mut() = held;
        self.evaluated = Evaluated::Other;
    }

    /// Lets input `index` reach `value` at the second of two times (s), on a straight line from what it is at the first; the place of a
    /// ring jumps there, and its rate is set for itself. For what is asked elsewhere: the run does not begin anew.
    ///
    /// # Errors
    /// As [`Sim::set_input`].
    pub(crate) fn hold_elsewhere(&mut self, index: usize, [since, t]: [f64; 2], value: f64) -> Result<()> {
        let input = self.check_input(index)?;
        self.model().check_input(input, value)?;
        let (at, to) = if input.place().is_none() && t > since {
            let before = self.model().inputs_at(since, self.bearing.host()).of(input);
            (since, (before, Some((value - before) / (t - since))))
        } else {
            (t, (value, None))
        };
        self.bearing.set_input(at, input, Some(to));
        self.evaluated = Evaluated::Other;
        Ok(())
    }

    /// Value of input `index` at time `t` (s), as far as it is known.
    ///
    /// # Errors
    /// As [`Sim::input`].
    pub(crate) fn input_elsewhere(&self, index: usize, t: f64) -> Result<f64> {
        let input = self.check_input(index)?;
        Ok(self.model().inputs_at(t, self.bearing.host()).of(input))
    }

    /// Finds the accelerations there.
    fn evaluate_at(&mut self, t: f64, state: &[f64]) -> Result<()> {
        check_time("t", t)?;
        self.check_state(state)?;
        self.evaluated = Evaluated::Other;
        let evaluated = self.bearing.accelerations_at(t, state, &mut self.accelerations);
        evaluated.map_err(|fault| self.bad_state(t, fault))
    }
}
