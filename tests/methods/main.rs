//! Integration methods on known problems, their linear algebra, and how the default method chooses.

#[path = "../common/mod.rs"]
mod common;

mod adams;
mod arrowhead;
mod auto;
mod balance;
mod choice;
mod implicit;
mod orders;
mod presets;
mod stiff;
mod tuning;
