//! Linear systems with the structure of a bearing: a hub and spokes.

mod dense;
mod factors;
mod matrix;
pub(crate) mod shifted;

pub use factors::Factors;
pub use matrix::{Arrowhead, HUB, Number, SPOKE, Spoke};
