//! Presets on random scenes that nothing was tuned to.

pub mod impossible;
mod parts;
pub mod published;
pub mod run;
pub mod scenes;
pub mod space;
pub mod summary;
