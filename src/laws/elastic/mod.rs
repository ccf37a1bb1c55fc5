//! Normal force of two surfaces that are pressed together.

pub mod line;
pub mod loaded;
pub mod normal;
pub mod point;
pub mod profile;
pub mod solid;
pub mod surface;
pub mod tilted;
