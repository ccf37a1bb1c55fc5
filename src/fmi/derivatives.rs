//! Directional derivatives of rates and outputs over states and inputs.

use super::instance::{Instance, Slopes};
use super::variables::Kind;
use crate::error::{Error, Result, Status};

impl Instance {
    /// Writes derivatives of unknowns, outputs and rates, over knowns, inputs and states: along a direction of the knowns, or if `adjoint`
    /// what a seed over the unknowns is over each of the knowns.
    ///
    /// # Errors
    /// [`Status::BadIndex`]; [`Status::BadValue`] for other variables; as [`crate::Sim::output_jacobian`]. `out` is then unchanged.
    pub fn derivative_along(
        &mut self,
        [unknowns, knowns]: [&[u32]; 2],
        seed: &[f64],
        adjoint: bool,
        out: &mut [f64],
    ) -> Result<()> {
        let mut sums = vec![0.0; out.len()];
        self.each_derivative(unknowns, knowns, |entry, i, k| {
            let (to, from) = if adjoint { (k, i) } else { (i, k) };
            sums[to] += entry * seed[from];
        })?;
        out.copy_from_slice(&sums);
        Ok(())
    }

    /// Tells every derivative by the places of unknown and known.
    fn each_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        mut tell: impl FnMut(f64, usize, usize),
    ) -> Result<()> {
        let kinds = |list: &[u32]| {
            list.iter()
                .map(|reference| Ok(self.unit.variable(*reference)?.kind))
                .collect::<Result<Vec<Kind>>>()
        };
        let (unknowns, knowns) = (kinds(unknowns)?, kinds(knowns)?);
        if self.found.slopes.is_none() {
            let slopes = self.slopes()?;
            self.found.slopes = Some(slopes);
        }
        let (states, outputs) = (self.state_count(), self.unit.model.channels().len());
        let Some(slopes) = &self.found.slopes else { return Ok(()) };
        for (i, unknown) in unknowns.iter().enumerate() {
            for (k, known) in knowns.iter().enumerate() {
                let (over, column) = match known {
                    Kind::State(place) => (0, *place),
                    Kind::Input(place) => (1, *place),
                    _ => return Err(refused("knowns", "states and inputs")),
                };
                let entry = match unknown {
                    Kind::Rate(row) => slopes.rates[over][column * states + row],
                    Kind::Output(row) => slopes.outputs[over][column * outputs + row],
                    _ => return Err(refused("unknowns", "rates and outputs")),
                };
                tell(entry, i, k);
            }
        }
        Ok(())
    }

    fn slopes(&mut self) -> Result<Slopes> {
        let (t, state) = self.prepare()?;
        let (n, inputs, outputs) =
            (state.len(), self.unit.model.input_count(), self.unit.model.channels().len());
        let sim = self.sim()?;
        let mut slopes = Slopes {
            rates: [vec![0.0; n * n], vec![0.0; n * inputs]],
            outputs: [vec![0.0; outputs * n], vec![0.0; outputs * inputs]],
        };
        sim.jacobian(t, &state, &mut slopes.rates[0])?;
        sim.input_jacobian(t, &state, &mut slopes.rates[1])?;
        let [over_states, over_inputs] = &mut slopes.outputs;
        sim.output_jacobian(t, &state, over_states, over_inputs)?;
        Ok(slopes)
    }
}

fn refused(argument: &str, allowed: &str) -> Error {
    Error::new(Status::BadValue, format!("{argument}: derivatives are of {allowed} only"))
}
