//! Scenes as users write them: what is read, what is refused and how, and what the repository ships.

#[path = "../common/mod.rs"]
mod common;

mod checked;
mod files;
mod refused;
