//! Mass off the axis of a body that turns.
//!
//! ```text
//! U = e m (w^2 n - w' t),   U' = e m (3 w w' n + (w^3 - w'') t),   n = (cos a, sin a), t = (-sin a, cos a), a = phase + angle
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

    /// U', N/s, where the inputs change at these rates.
    pub(super) fn rate(&self, inputs: &InputValues, rates: &InputValues) -> Vector2<f64> {
        let Some([outwards, ahead]) = self.axes(inputs) else { return Vector2::zeros() };
        let (w, dw, ddw) =
            (inputs.of(SPEEDS[self.with]), inputs.speeding[self.with], rates.speeding[self.with]);
        outwards * (3.0 * w * dw) + ahead * (w * w * w - ddw)
    }
}
