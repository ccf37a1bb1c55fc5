//! Friction of sliding surfaces.

pub mod ellipse;
pub mod film_friction;
pub mod muraki_kimura;
pub mod self_heating;
pub mod solid_friction;
