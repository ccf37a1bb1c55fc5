//! Forces at given states: balance, symmetry, continuity, effects, and bearings at rest.

#[path = "../common/mod.rs"]
mod common;

mod balance;
mod continuity;
mod effects;
mod passive;
mod published;
mod static_equilibrium;
mod symmetry;
