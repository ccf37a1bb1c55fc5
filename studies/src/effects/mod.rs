//! What every effect costs and changes: the scenes and their changes, counted instructions, bars.

pub mod bar;
pub mod count;
pub mod rows;
