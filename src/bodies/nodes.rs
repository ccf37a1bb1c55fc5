//! Nodes: states that are no motion, such as temperatures. Each owns their names, units, starts and rates.
//!
//! ```text
//! x' = f(x, powers of the bearing)
//! ```
//!
//! Their states are velocities without position behind all others. Powers are positive where they drive the bearing, so heat is
//! the negative of what forces inside take; they are those of evaluations, also in a semi-implicit step, whose booked works are
//! those of the step. The derivatives that a node tells are those over its own values: how powers change with the motion is left
//! out of the linear systems of integrators and hosts, as it changes a node slowly, and so is how forces change with it.

use super::heat::Lumps;
use crate::scene::Scene;
use nalgebra::DMatrixViewMut;
use std::fmt::Debug;

/// The nodes of a checked scene.
pub(crate) fn nodes(scene: &Scene) -> Vec<Box<dyn Node>> {
    let lumps = Lumps::of(scene).map(|lumps| Box::new(lumps) as Box<dyn Node>);
    [lumps].into_iter().flatten().collect()
}

/// What is said of a value of a node.
#[derive(Clone, Debug)]
pub(crate) struct NodeState {
    /// Its name within the node.
    pub(crate) name: String,
    /// SI unit.
    pub(crate) unit: &'static str,
    /// Meaning.
    pub(crate) description: &'static str,
    /// What counts as one unit of error, in that unit.
    pub(crate) error_unit: f64,
    /// Value at the start of a run.
    pub(crate) start: f64,
}

/// States that are no motion and belong together.
pub(crate) trait Node: Debug + Send + Sync {
    /// Name of the node.
    fn name(&self) -> &'static str;

    /// What is said of its values.
    fn states(&self) -> &[NodeState];

    /// Rates of its values `x`, per second, while forces have these powers, W, by [`super::Power`].
    fn rates(&self, x: &[f64], powers: &[f64], out: &mut [f64]);

    /// Adds the derivatives of these rates over its own values.
    fn add_slopes(&self, x: &[f64], out: DMatrixViewMut<'_, f64>);

    /// Place among its values of the temperature that the lubricant has.
    fn lubricant(&self) -> Option<usize> {
        None
    }
}
