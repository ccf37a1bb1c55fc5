//! The Jacobian of the rates of a state, for hosts with their own implicit integrator.

use crate::error::Result;
use crate::integrate::linear::Arrowhead;
use crate::integrate::{Linearization, Structure};
use crate::model::{Fault, OF_ELEMENT, Plane};
use crate::sim::{Evaluated, Sim, check_time, wrong_size};

/// Memory for derivatives of the accelerations.
pub(in crate::sim) struct Slopes {
    pub(in crate::sim) structure: Structure<OF_ELEMENT>,
    pub(in crate::sim) linearization: Linearization<OF_ELEMENT>,
}

impl Slopes {
    pub(in crate::sim) fn new(model: &Plane) -> Self {
        let structure = model.structure();
        let linearization = Linearization::new(&structure, model.layout().velocities());
        Self { structure, linearization }
    }

    /// The fault of the first acceleration without finite derivatives.
    pub(in crate::sim) fn check(&self) -> std::result::Result<(), Fault> {
        let Linearization { over_positions, over_velocities, .. } = &self.linearization;
        for part in [over_positions, over_velocities] {
            let finite = |block: &[f64]| block.iter().fold(true, |finite, x| finite & x.is_finite());
            if part.blocks().into_iter().all(finite) {
                continue;
            }
            if let Some((velocity, ..)) = entries(&self.structure, part).find(|(.., x)| !x.is_finite()) {
                return Err(Fault::NoSlope { velocity });
            }
        }
        Ok(())
    }

    /// Writes the derivatives of the rates of `positions` positions and all velocities by columns.
    fn write(&self, positions: usize, out: &mut [f64]) {
        let size = positions + self.linearization.over_time.len();
        out.fill(0.0);
        for (row, column, value) in self.of_rates(positions) {
            out[column * size + row] = value;
        }
    }

    /// Row, column and value of every derivative of these rates that is not always zero.
    pub(super) fn of_rates(&self, positions: usize) -> impl Iterator<Item = (usize, usize, f64)> {
        let Linearization { over_positions, over_velocities, .. } = &self.linearization;
        let rates = (0..positions).map(move |i| (i, positions + i, 1.0));
        // Spins have no position; what stands in their place is zero.
        let of_positions = entries(&self.structure, over_positions)
            .filter(move |(_, column, _)| *column < positions)
            .map(move |(row, column, value)| (positions + row, column, value));
        let of_velocities = entries(&self.structure, over_velocities)
            .map(move |(row, column, value)| (positions + row, positions + column, value));
        rates.chain(of_positions).chain(of_velocities)
    }
}

/// Row, column (both as velocities) and value of every entry of a matrix of this structure.
fn entries<'a>(
    structure: &'a Structure<OF_ELEMENT>,
    matrix: &'a Arrowhead<f64, OF_ELEMENT>,
) -> impl Iterator<Item = (usize, usize, f64)> + 'a {
    let hub = || structure.hub.iter().copied().enumerate();
    let within_hub =
        hub().flat_map(move |(i, row)| hub().map(move |(k, column)| (row, column, matrix.hub[(i, k)])));
    let with_spokes = structure.spokes.iter().enumerate().flat_map(move |(j, places)| {
        let (own, from_hub, to_hub) = (matrix.own_of(j), matrix.from_hub_of(j), matrix.to_hub_of(j));
        places.iter().enumerate().flat_map(move |(i, &row)| {
            let within = places.iter().enumerate().map(move |(k, &column)| (row, column, own[k][i]));
            let across = hub().flat_map(move |(k, shared)| {
                [(row, shared, from_hub[k][i]), (shared, row, to_hub[i * matrix.width() + k])]
            });
            let beside = matrix.rim_of(j).flat_map(move |(other, columns)| {
                let neighbour = structure.spokes[other].iter().zip(columns);
                neighbour.map(move |(&column, slopes)| (row, column, slopes[i]))
            });
            within.chain(across).chain(beside)
        })
    });
    within_hub.chain(with_spokes)
}

impl Sim {
    /// Exact derivatives of what [`Sim::derivative`] gives over the state, at an arbitrary state and time `t` (s), for
    /// hosts with their own implicit integrator: `out[i + n * k]` is the derivative of rate `i` over state `k`, with
    /// `n` the length of the state. Units are those of the rate over those of the state.
    ///
    /// Where forces have a kink, such as at first touch, it is the derivative on one of its sides. The simulation's
    /// own state is not touched, and nothing is counted. The first call takes memory; later ones take none.
    ///
    /// # Errors
    /// As [`Sim::derivative`], and [`Status::BadState`](crate::Status::BadState) where a derivative is not finite;
    /// `out` is then unchanged.
    pub fn jacobian(&mut self, t: f64, state: &[f64], out: &mut [f64]) -> Result<()> {
        check_time("t", t)?;
        self.check_state(state)?;
        let length = state.len() * state.len();
        if out.len() != length {
            return Err(wrong_size("jacobian", out.len(), length));
        }
        let positions = self.model().layout().positions();
        self.slopes_at(t, state)?.write(positions, out);
        Ok(())
    }

    /// Derivative over time of what [`Sim::derivative`] gives, at a constant state: how inputs that change with time change the
    /// rates, per second. The rates of inputs at a jump or kink are those after it.
    ///
    /// # Errors
    /// As [`Sim::jacobian`].
    pub fn time_derivative(&mut self, t: f64, state: &[f64], out: &mut [f64]) -> Result<()> {
        if out.len() != state.len() {
            return Err(wrong_size("rate", out.len(), state.len()));
        }
        let positions = self.model().layout().positions();
        let over_time = &self.slopes_at(t, state)?.linearization.over_time;
        out[..positions].fill(0.0);
        out[positions..].copy_from_slice(over_time);
        Ok(())
    }

    /// Finds the derivatives there.
    pub(super) fn slopes_at(&mut self, t: f64, state: &[f64]) -> Result<&Slopes> {
        check_time("t", t)?;
        self.check_state(state)?;
        self.evaluated = Evaluated::Other;
        let slopes = self.slopes.get_or_insert_with(|| Slopes::new(self.bearing.plane()));
        let linearized = self.bearing.linearize_at(t, state, &mut self.accelerations, slopes);
        match linearized.and_then(|()| slopes.check()) {
            Ok(()) => Ok(self.slopes.get_or_insert_with(|| Slopes::new(self.bearing.plane()))),
            Err(fault) => Err(self.bad_state(t, fault)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Model;

    #[test]
    fn what_is_not_finite_is_found_and_named() {
        let model = Model::from_json(include_str!("../../../scenes/nu2310.json")).unwrap();
        let plane = model.plane().unwrap();
        let mut slopes = Slopes::new(plane);
        assert_eq!(slopes.check(), Ok(()));
        slopes.linearization.over_velocities.to_hub[(4, 3 * OF_ELEMENT + 1)] = f64::NAN;
        let fault = slopes.check().unwrap_err();
        let text = plane.describe(fault);
        assert!(text.contains("derivative of the rate of cage.speed is not a finite number"), "{text}");
    }
}
