//! Derivatives and linear systems for hosts with their own integrator.

mod inputs;
pub(in crate::sim) mod jacobian;
pub(in crate::sim) mod newton;
pub(in crate::sim) mod sparse;
