//! Nodes: states that are no motion, such as temperatures. Each owns their names, units, starts and rates.
//!
//! ```text
//! x' = f(x, powers of the bearing)
//! ```
//!
//! Their states are velocities without position behind all others. They follow from the motion and may act on it by what laws see
//! of them; the derivatives of their rates are those over their own values, since powers change them slowly.

use crate::scene::Scene;
use nalgebra::DMatrixViewMut;
use std::fmt::Debug;

/// The nodes of a checked scene.
pub(crate) fn nodes(_scene: &Scene) -> Vec<Box<dyn Node>> {
    Vec::new()
}

/// A value of a node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NodeState {
    /// Name, SI unit and meaning.
    pub(crate) name: [&'static str; 3],
    /// What counts as one unit of error, in that unit.
    pub(crate) error_unit: f64,
    /// Value at the start of a run.
    pub(crate) start: f64,
}

/// States that are no motion and belong together.
pub(crate) trait Node: Debug + Send + Sync {
    /// Name of the node.
    fn name(&self) -> &'static str;

    /// Its values.
    fn states(&self) -> &[NodeState];

    /// Rates of its values `x`, per second, while forces have these powers, W, by [`super::Power`].
    fn rates(&self, x: &[f64], powers: &[f64], out: &mut [f64]);

    /// Adds the derivatives of these rates over its own values.
    fn add_slopes(&self, x: &[f64], out: DMatrixViewMut<'_, f64>);
}
