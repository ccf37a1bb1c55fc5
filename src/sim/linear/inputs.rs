//! Derivatives over inputs, and of outputs, for hosts whose own implicit solver steps the bearing together with what is around it.

use crate::error::Result;
use crate::model::{Input, InputValues};
use crate::sim::{Evaluated, Sim, check_time, wrong_size};

/// Steps of differences in units of what is moved.
const STEP: f64 = 1e-6;
/// Units of inputs: a speed in rad/s, a force in N or moment in N m, a temperature in K.
const SPEED: f64 = 100.0;
const LOAD: f64 = 1e3;
const TEMPERATURE: f64 = 10.0;
/// Units of rates over those of places, 1/s: as of the states.
const RATE: f64 = 1e4;

impl Sim {
    /// Exact derivatives of what [`Sim::derivative`] gives over the inputs, at an arbitrary state and time `t` (s): `out[i + n * k]` is
    /// that of rate `i` over input `k`, with `n` the length of the state. What follows from an input, such as the orbit of elements that
    /// roll, moves with it; angles, and for the place of a ring its rate, do not.
    ///
    /// # Errors
    /// As [`Sim::jacobian`].
    pub fn input_jacobian(&mut self, t: f64, state: &[f64], out: &mut [f64]) -> Result<()> {
        let (n, inputs) = (state.len(), self.inputs());
        if out.len() != n * inputs.len() {
            return Err(wrong_size("jacobian", out.len(), n * inputs.len()));
        }
        self.slopes_at(t, state)?;
        let positions = self.model().layout().positions();
        let mut slopes = self.slopes.take().unwrap_or_else(|| self.bearing.new_slopes());
        for (input, column) in inputs.into_iter().zip(out.chunks_exact_mut(n.max(1))) {
            let direction = self.model().input_direction(input, t, self.bearing.host());
            self.bearing.linearize_along(&direction, &mut slopes);
            column[..positions].fill(0.0);
            column[positions..].copy_from_slice(slopes.over_time());
        }
        self.slopes = Some(slopes);
        Ok(())
    }

    /// Derivatives of the outputs at an arbitrary state and time `t` (s) over the states and over the inputs, by central differences in
    /// steps of a millionth of the scales in which errors are controlled: `over_states[i + n * k]` is that of output `i` over state `k`, with `n` the number of
    /// outputs, and `over_inputs[i + n * k]` that over input `k`. Where forces have a kink, it is the mean of both sides.
    ///
    /// # Errors
    /// As [`Sim::derivative`], also at the states beside this one; both arrays are then unchanged.
    pub fn output_jacobian(
        &mut self,
        t: f64,
        state: &[f64],
        over_states: &mut [f64],
        over_inputs: &mut [f64],
    ) -> Result<()> {
        check_time("t", t)?;
        self.check_state(state)?;
        let (n, inputs) = (self.channels().len(), self.inputs());
        for (name, found, wanted) in [
            ("over_states", over_states.len(), n * state.len()),
            ("over_inputs", over_inputs.len(), n * inputs.len()),
        ] {
            if found != wanted {
                return Err(wrong_size(name, found, wanted));
            }
        }
        let now = self.model().inputs_at(t, self.bearing.host());
        let (mut states, mut by_inputs) = (vec![0.0; over_states.len()], vec![0.0; over_inputs.len()]);
        let mut moved = state.to_vec();
        for (k, column) in states.chunks_exact_mut(n.max(1)).enumerate() {
            let step = STEP * self.scales[k];
            let mut at = |side: f64| {
                moved[k] = state[k] + side * step;
                let outputs = self.outputs_with(t, &now, &moved);
                moved[k] = state[k];
                outputs
            };
            differ(column, &at(1.0)?, &at(-1.0)?, step);
        }
        for (input, column) in inputs.into_iter().zip(by_inputs.chunks_exact_mut(n.max(1))) {
            let direction = self.model().input_direction(input, t, self.bearing.host());
            let step = STEP * self.unit(input);
            let mut at = |side: f64| self.outputs_with(t, &now.moved(&direction, side * step), state);
            differ(column, &at(1.0)?, &at(-1.0)?, step);
        }
        over_states.copy_from_slice(&states);
        over_inputs.copy_from_slice(&by_inputs);
        Ok(())
    }

    /// The first time after `t` (s) at which an input jumps or has a kink, where a host with its own integrator has to stop; infinity
    /// if there is none. Forces have no jumps that an integrator must land on.
    ///
    /// # Errors
    /// [`crate::Status::BadValue`].
    pub fn next_event(&self, t: f64) -> Result<f64> {
        check_time("t", t)?;
        Ok(self.model().next_event(t, self.bearing.host()))
    }

    fn inputs(&self) -> Vec<Input> {
        self.model().input_list().collect()
    }

    fn outputs_with(&mut self, t: f64, inputs: &InputValues, state: &[f64]) -> Result<Vec<f64>> {
        self.evaluated = Evaluated::Other;
        let mut out = vec![0.0; self.channels().len()];
        let memory = (&mut self.accelerations[..], &mut self.forces);
        let evaluated = self.bearing.outputs_with(inputs, state, memory, &mut out);
        evaluated.map_err(|fault| self.bad_state(t, fault))?;
        Ok(out)
    }

    /// What an input is moved by to see what it does.
    fn unit(&self, input: Input) -> f64 {
        let length = self.model().reference_length();
        let of_place = |tilts: bool| if tilts { length / self.model().pitch_radius() } else { length };
        let [unit, _] = input.meaning();
        match (input.place(), unit) {
            (Some((_, is_rate)), _) => of_place(unit.starts_with("rad")) * if is_rate { RATE } else { 1.0 },
            (None, "rad/s") => SPEED,
            (None, "K") => TEMPERATURE,
            (None, _) => LOAD,
        }
    }
}

/// Central differences.
fn differ(out: &mut [f64], ahead: &[f64], behind: &[f64], step: f64) {
    for (out, (ahead, behind)) in out.iter_mut().zip(ahead.iter().zip(behind)) {
        *out = (ahead - behind) / (2.0 * step);
    }
}
