//! The integration methods, one file each, and what they share.

pub(super) mod adams;
pub(super) mod damping;
pub(super) mod dormand_prince;
pub(super) mod leapfrog;
pub(super) mod radau;
pub(super) mod rosenbrock;
