//! Force laws, one file each.
//!
//! A law knows its own constants and nothing else: no bodies, no JSON, no planar or spatial geometry. All
//! quantities are in SI units. Laws are generic over [`crate::scalar::Real`], so the code that gives a force
//! also gives its exact derivatives.

pub mod barus_film;
pub mod contact_pair;
#[cfg(test)]
mod extremes;
pub mod film_thickness;
pub mod fluid;
pub mod guide;
pub mod journal;
mod layer_gap;
mod layer_quadrature;
pub mod line_contact;
pub mod lubricant_layer;
pub mod lubrication_regime;
pub mod normal_contact;
pub mod rolling_resistance;
pub mod self_heating;
pub mod short_bearing;
pub mod solid_contact;
pub mod solid_friction;
pub mod traction;
pub mod walther;
