//! Films between rolling surfaces.

pub mod ellipse;
pub mod regime;
pub mod thickness;
