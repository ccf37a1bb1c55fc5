//! Films between rolling surfaces.

pub mod regime;
pub mod thickness;
