//! Force laws, one file each.
//!
//! | folder | laws |
//! |---|---|
//! | `elastic` | normal force of a line contact, profile of its surfaces, of a point contact, of a spring with damper |
//! | `film` | film thickness, lubrication regimes |
//! | `traction` | full-film traction, its self-heating, solid friction |
//! | `rolling` | rolling resistance |
//! | `guide` | films between cage and ring, shared with solid contact |
//! | `fluid` | viscosity |
//!
//! `drag` is that of a mixture of air and oil on a ball; `bearing_torque` is the friction of a whole bearing from catalogue values. `line_contact` puts those of a lubricated line contact together,
//! `point_contact` those of a ball in its groove; `resting_line` gives the spring of a line contact alone.
//!
//! A law knows its own constants and nothing else: no bodies, no JSON, no planar or spatial geometry. All
//! quantities are in SI units. Laws are generic over [`crate::scalar::Real`], so the code that gives a force
//! also gives its exact derivatives.

pub mod bearing_torque;
pub mod contact_pair;
pub mod drag;
pub mod elastic;
#[cfg(test)]
mod extremes;
pub mod film;
pub mod fluid;
pub mod guide;
pub mod heat_network;
pub mod life;
pub mod line_contact;
pub mod point_contact;
mod resting_line;
pub mod rib_contact;
pub mod rolling;
pub mod traction;
