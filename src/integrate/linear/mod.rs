//! Linear systems with the structure of a bearing: a hub and spokes.

mod dense;
mod factors;
mod lu;
mod matrix;
pub(crate) mod shifted;

pub use factors::Factors;
pub(crate) use lu::{Scales, decompose, substitute};
pub use matrix::{Arrowhead, Number};
