//! Where the time of a force evaluation in space goes, and what its derivatives take.

use super::{Space, Workspace};
use crate::bodies::{Fault, InputValues};
use crate::model::PartTimes;
use crate::model::plane::shortest;
use std::hint::black_box;

impl Space {
    /// Time that the derivatives of the forces take beside their values, in force evaluations. Never clocked, so that equal runs choose
    /// equally: of the sums over an ellipse each has its derivatives over all that the law sees; those of rollers go in several passes.
    pub(crate) fn jacobian_cost(&self) -> f64 {
        if self.rollers.is_some() { 9.0 } else { 6.0 }
    }

    /// Wall time of each part of one evaluation at positions `q` and velocities `v`, s: see [`super::super::Plane::time_parts`].
    ///
    /// # Errors
    /// As [`Space::evaluate`].
    pub(crate) fn time_parts(
        &self,
        inputs: &InputValues,
        (q, v): (&[f64], &[f64]),
        ws: &mut Workspace,
        repeats: u32,
    ) -> Result<PartTimes, Fault> {
        let mut a = vec![0.0; v.len()];
        *ws.inputs_mut() = *inputs;
        self.evaluate(q, v, ws, &mut a)?;
        let mut times = PartTimes::default();
        times[0] = shortest(repeats, &mut || self.locate(black_box(q), v, ws))?;
        for race in 0..self.races.len() {
            times[1 + race] = shortest(repeats, &mut || {
                self.apply(race, black_box(&mut *ws));
                Ok(())
            })?;
        }
        if self.rollers.is_some() {
            times[1] = shortest(repeats, &mut || self.apply_rollers(black_box(&mut *ws)))?;
        }
        if self.cage.is_some() {
            times[4] = shortest(repeats, &mut || self.apply_cage(black_box(&mut *ws)))?;
        }
        // The last pass added up once more; what follows collects the forces of one.
        self.evaluate(q, v, ws, &mut a)?;
        times[5] = shortest(repeats, &mut || {
            self.assemble(black_box(&mut *ws), &mut a);
            Ok(())
        })?;
        Ok(times)
    }
}
