//! Presets on random scenes that nothing was tuned to.

pub mod run;
pub mod scenes;
pub mod summary;
