//! The Jacobian of the rates of a state, for hosts with their own implicit integrator.

use crate::error::Result;
use crate::integrate::linear::Arrowhead;
use crate::integrate::{Linearization, Structure};
use crate::model::{Fault, Model, OF_BALL, OF_ELEMENT};
use crate::scalar::all_finite;
use crate::sim::{Evaluated, Sim, check_time, wrong_size};

/// Memory for derivatives of the accelerations.
pub(in crate::sim) struct Slopes<const N: usize> {
    pub(in crate::sim) structure: Structure<N>,
    pub(in crate::sim) linearization: Linearization<N>,
}

/// That of a bearing in the plane or in space.
pub(in crate::sim) enum AnySlopes {
    Plane(Slopes<OF_ELEMENT>),
    Space(Slopes<OF_BALL>),
}

/// Does the same with slopes, whatever the width of their spokes.
macro_rules! any {
    ($any:expr, $slopes:ident => $work:expr) => {
        match $any {
            AnySlopes::Plane($slopes) => $work,
            AnySlopes::Space($slopes) => $work,
        }
    };
}

impl AnySlopes {
    pub(in crate::sim) fn new(model: &Model) -> Self {
        match model.space() {
            Some(_) => Self::Space(Slopes::new(model)),
            None => Self::Plane(Slopes::new(model)),
        }
    }

    /// The fault of the first acceleration without finite derivatives.
    pub(in crate::sim) fn check(&self) -> std::result::Result<(), Fault> {
        any!(self, slopes => slopes.check())
    }

    /// Tells row and column of every derivative of the rates that is not always zero, and its value: first those over velocities of the
    /// rates of positions, which are one, then in the order of [`AnySlopes::blocks`]. What has no place in a state is zero.
    pub(super) fn for_each(&self, positions: usize, mut tell: impl FnMut(Option<[usize; 2]>, f64)) {
        (0..positions).for_each(|i| tell(Some([i, positions + i]), 1.0));
        any!(self, slopes => {
            let Linearization { over_positions, over_velocities, .. } = &slopes.linearization;
            for_each(&slopes.structure, over_positions, |row, column, value| {
                // Spins have no position.
                tell((column < positions).then_some([positions + row, column]), value);
            });
            for_each(&slopes.structure, over_velocities, |row, column, value| {
                tell(Some([positions + row, positions + column]), value);
            });
        });
    }

    /// Values of the derivatives of the accelerations over positions and over velocities.
    pub(super) fn blocks(&self) -> [[&[f64]; 5]; 2] {
        any!(self, slopes => {
            let Linearization { over_positions, over_velocities, .. } = &slopes.linearization;
            [over_positions.blocks(), over_velocities.blocks()]
        })
    }

    /// Derivatives of the accelerations over time.
    pub(super) fn over_time(&self) -> &[f64] {
        any!(self, slopes => &slopes.linearization.over_time)
    }
}

impl<const N: usize> Slopes<N> {
    fn new(model: &Model) -> Self {
        let structure = model.layout().structure();
        let linearization = Linearization::new(&structure, model.layout().velocities());
        Self { structure, linearization }
    }

    /// The fault of the first acceleration without finite derivatives.
    pub(in crate::sim) fn check(&self) -> std::result::Result<(), Fault> {
        let Linearization { over_positions, over_velocities, .. } = &self.linearization;
        for part in [over_positions, over_velocities] {
            if part.blocks().into_iter().all(all_finite) {
                continue;
            }
            let mut first = None;
            for_each(&self.structure, part, |velocity, _, x| {
                first = first.or((!x.is_finite()).then_some(Fault::NoSlope { velocity }));
            });
            first.map_or(Ok(()), Err)?;
        }
        Ok(())
    }
}

/// Tells row, column (both as velocities) and value of every entry of a matrix of this structure, in the order of its blocks.
fn for_each<const N: usize>(
    structure: &Structure<N>,
    matrix: &Arrowhead<f64, N>,
    mut tell: impl FnMut(usize, usize, f64),
) {
    let Structure { hub, spokes, .. } = structure;
    let mut tell_block = |columns: &[usize], rows: &[usize], values: &[f64]| {
        for (column, values) in columns.iter().zip(values.chunks_exact(rows.len().max(1))) {
            rows.iter().zip(values).for_each(|(row, value)| tell(*row, *column, *value));
        }
    };
    let [of_hub, own, to_hub, from_hub, rim] = matrix.blocks();
    let across = (N * hub.len()).max(1);
    tell_block(hub, hub, of_hub);
    spokes.iter().zip(own.chunks_exact(N * N)).for_each(|(spoke, values)| tell_block(spoke, spoke, values));
    spokes.iter().zip(to_hub.chunks_exact(across)).for_each(|(spoke, values)| tell_block(spoke, hub, values));
    spokes
        .iter()
        .zip(from_hub.chunks_exact(across))
        .for_each(|(spoke, values)| tell_block(hub, spoke, values));
    let n = spokes.len();
    for (j, values) in rim.chunks_exact(2 * N * N).enumerate() {
        for (other, values) in [(j + 1) % n, (j + n - 1) % n].into_iter().zip(values.chunks_exact(N * N)) {
            tell_block(&spokes[other], &spokes[j], values);
        }
    }
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
        let slopes = self.slopes_at(t, state)?;
        out.fill(0.0);
        slopes.for_each(positions, |place, value| {
            if let Some([row, column]) = place {
                out[column * state.len() + row] = value;
            }
        });
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
        let over_time = self.slopes_at(t, state)?.over_time();
        out[..positions].fill(0.0);
        out[positions..].copy_from_slice(over_time);
        Ok(())
    }

    /// Finds the derivatives there.
    pub(super) fn slopes_at(&mut self, t: f64, state: &[f64]) -> Result<&AnySlopes> {
        check_time("t", t)?;
        self.check_state(state)?;
        self.evaluated = Evaluated::Other;
        let slopes = self.slopes.get_or_insert_with(|| self.bearing.new_slopes());
        let linearized = self.bearing.linearize_at(t, state, &mut self.accelerations, slopes);
        match linearized.and_then(|()| slopes.check()) {
            Ok(()) => Ok(self.slopes.get_or_insert_with(|| self.bearing.new_slopes())),
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
        let mut slopes = Slopes::<OF_ELEMENT>::new(&model);
        assert_eq!(slopes.check(), Ok(()));
        slopes.linearization.over_velocities.to_hub[(4, 3 * OF_ELEMENT + 1)] = f64::NAN;
        let fault = slopes.check().unwrap_err();
        let text = model.describe(fault);
        assert!(text.contains("derivative of the rate of cage.speed is not a finite number"), "{text}");
    }
}
