//! Counts and numbers of health of a run.

use crate::integrate::Statistics;
use crate::integrate::auto::Choice;
use crate::model::{FaultCounts, LawCounts};

/// Counts of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RunStatistics {
    /// Steps.
    pub driver: Statistics,
    /// Force evaluations of the integration.
    pub evaluations: u64,
    /// Derivatives of the forces, for implicit methods and checks.
    pub jacobians: u64,
    /// What `auto` has chosen; absent with other methods.
    pub choice: Option<Choice>,
    /// Failed attempts by cause, in the order of [`crate::model::FAULTS`].
    pub faults: FaultCounts,
    /// Evaluations of each law in them, in the order of [`crate::model::LAWS`].
    pub laws: LawCounts,
}

/// Names of [`RunStatistics::values`].
pub const STATISTICS: [&str; 23] = [
    "steps",
    "rejected_steps",
    "failed_steps",
    "evaluations",
    "events",
    "smallest_step",
    "largest_step",
    "raceway_vibration_rms",
    "leapfrog_steps",
    "dormand_prince_steps",
    "rosenbrock_steps",
    "method_changes",
    "highest_frequency",
    "failed_no_guide_film",
    "failed_no_viscosity",
    "failed_lost_roller",
    "failed_lost_ring",
    "failed_lost_cage",
    "failed_not_finite",
    "failed_no_slope",
    "jacobians",
    "undone_steps",
    "failed_out_of_pocket",
];

impl RunStatistics {
    /// The numbers named by [`STATISTICS`]. Steps in s, vibration in m/s, frequency in rad/s, everything else a count. Zero for what was not measured.
    pub fn values(&self) -> [f64; STATISTICS.len()] {
        let d = &self.driver;
        let mut values = [0.0; STATISTICS.len()];
        let counts = [d.steps, d.rejected, d.faults, self.evaluations, d.events].map(|n| n as f64);
        values[..5].copy_from_slice(&counts);
        values[5..8].copy_from_slice(&[d.smallest_step, d.largest_step, d.vibration.rms()]);
        if let Some(choice) = &self.choice {
            values[8..11].copy_from_slice(&choice.steps.map(|n| n as f64));
            values[11..13].copy_from_slice(&[choice.changes as f64, choice.highest_frequency]);
        }
        let [faults @ .., last] = self.faults.map(|n| n as f64);
        values[13..20].copy_from_slice(&faults);
        values[20..].copy_from_slice(&[self.jacobians as f64, d.undone as f64, last]);
        values
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::FAULTS;

    #[test]
    fn failures_are_named_as_faults() {
        let failed = STATISTICS.iter().filter_map(|name| name.strip_prefix("failed_"));
        assert!(failed.filter(|name| *name != "steps").eq(FAULTS));
    }
}
