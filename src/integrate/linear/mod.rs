//! Linear systems with the structure of a bearing: a hub and spokes.

pub mod arrowhead;
mod dense;
pub(crate) mod shifted;
