//! Long runs of all methods in their statistics.

pub mod cases;
pub mod methods;
pub mod readings;
pub mod study;
