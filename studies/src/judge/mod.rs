//! Presets on random scenes that nothing was tuned to.

mod cage_in_space;
pub mod impossible;
mod parts;
pub mod published;
pub mod rollers_in_space;
pub mod run;
pub mod scenes;
pub mod space;
pub mod summary;
