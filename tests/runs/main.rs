//! Simulations as hosts run them, and the examples over time.

#[path = "../common/mod.rs"]
mod common;

mod elastic_cage;
mod extremes;
mod grease_guide;
mod host;
mod host_derivatives;
mod impossible;
mod limits;
mod machine;
mod nu2310;
mod outer_ring;
mod profile;
mod promises;
mod published;
mod rigid_rotor;
mod roller_sizes;
mod sim;
mod snapshots;
mod started;
mod waviness;
