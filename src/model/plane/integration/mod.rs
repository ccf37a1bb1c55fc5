//! What integration needs beside forces: damping, forces of a step, scales and limits of steps, costs.

pub(in crate::model) mod costs;
pub(in crate::model) mod damping;
pub(in crate::model) mod onsets;
pub(in crate::model) mod scales;
pub(in crate::model) mod step_forces;
