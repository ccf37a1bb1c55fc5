//! Directions of a bearing: x along its axis, y to the right, z upwards, right-handed.
//!
//! | file | what |
//! |---|---|
//! | `plane` | motions, frames and wrenches of a bearing that moves in the plane of y and z |
//! | `solid` | vectors of three components, and the axis of a body that tilts |

mod plane;
pub mod solid;

pub use plane::{Frame, Motion, Wrench, rotate};
