//! Mass off the axis of a body that turns.
//!
//! ```text
//! U = e m (w^2 n - w' t),   dU = e m ((2 w dw + w' da) n + (w^2 da - dw') t),   n = (cos a, sin a), t = (-sin a, cos a), a = phase + angle
//! ```
//!
//! e m mass times distance, w speed. Its work is that of a load on the centre; the moment is taken by what turns the body.

use super::{Input, InputValues};
use crate::scalar::math;
use crate::scene::Unbalance;
use nalgebra::Vector2;

/// Speeds of outer and inner ring.
pub(crate) const SPEEDS: [Input; 2] = [Input::OuterRingSpeed, Input::RingSpeed];

/// Mass off the axis of a body that turns with the outer (0) or inner ring (1).
#[derive(Clone, Copy, Debug)]
pub(super) struct OffCentre {
    unbalance: Option<Unbalance>,
    with: usize,
}

impl OffCentre {
    pub(super) fn new(unbalance: Option<Unbalance>, with: usize) -> Self {
        Self { unbalance, with }
    }

    /// e m n and e m t, kg m; `None` without any.
    fn axes(&self, inputs: &InputValues) -> Option<[Vector2<f64>; 2]> {
        let Unbalance { moment, phase } = self.unbalance?;
        let (sin, cos) = math::sin_cos(phase + inputs.angles[self.with]);
        Some([Vector2::new(cos, sin) * moment, Vector2::new(-sin, cos) * moment])
    }

    /// U, N; `None` without any.
    pub(super) fn force(&self, inputs: &InputValues) -> Option<Vector2<f64>> {
        let [outwards, ahead] = self.axes(inputs)?;
        let w = inputs.of(SPEEDS[self.with]);
        Some(outwards * (w * w) - ahead * inputs.speeding[self.with])
    }

    /// dU, N, where the inputs change by these, or its rate, where these are rates.
    pub(super) fn change(&self, inputs: &InputValues, by: &InputValues) -> Vector2<f64> {
        let Some([outwards, ahead]) = self.axes(inputs) else { return Vector2::zeros() };
        let (w, dw) = (inputs.of(SPEEDS[self.with]), by.of(SPEEDS[self.with]));
        let (speeding, da) = (inputs.speeding[self.with], by.angles[self.with]);
        outwards * (2.0 * w * dw + speeding * da) + ahead * (w * w * da - by.speeding[self.with])
    }
}
