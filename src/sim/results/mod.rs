//! What a run tells: records, intervals, statistics, and whether to trust it.

pub(in crate::sim) mod interval;
pub(in crate::sim) mod motion;
pub(in crate::sim) mod over_orbit;
pub(in crate::sim) mod recording;
pub(in crate::sim) mod sample;
pub(in crate::sim) mod statistics;
pub(in crate::sim) mod stretches;
pub(in crate::sim) mod trust;
pub(in crate::sim) mod whirl;
