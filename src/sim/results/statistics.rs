//! Counts and numbers of health of a run.

use crate::integrate::Statistics;
use crate::integrate::auto::{Choice, Kind};
use crate::model::{FaultCounts, FaultKind, LawCounts};
use crate::registry::registry;

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

registry! {
    /// A number of [`RunStatistics::values`].
    pub(crate) enum Statistic,
    /// Names of [`RunStatistics::values`].
    pub const STATISTICS {
        Steps = "steps",
        RejectedSteps = "rejected_steps",
        FailedSteps = "failed_steps",
        Evaluations = "evaluations",
        Events = "events",
        SmallestStep = "smallest_step",
        LargestStep = "largest_step",
        RacewayVibrationRms = "raceway_vibration_rms",
        LeapfrogSteps = "leapfrog_steps",
        DormandPrinceSteps = "dormand_prince_steps",
        RosenbrockSteps = "rosenbrock_steps",
        MethodChanges = "method_changes",
        HighestFrequency = "highest_frequency",
        FailedNoGuideFilm = "failed_no_guide_film",
        FailedNoViscosity = "failed_no_viscosity",
        FailedLostRoller = "failed_lost_roller",
        FailedLostRing = "failed_lost_ring",
        FailedLostCage = "failed_lost_cage",
        FailedNotFinite = "failed_not_finite",
        FailedNoSlope = "failed_no_slope",
        Jacobians = "jacobians",
        UndoneSteps = "undone_steps",
        FailedOutOfPocket = "failed_out_of_pocket",
        FailedOverlap = "failed_overlap",
        FailedTooFast = "failed_too_fast",
        FailedEnergyCreated = "failed_energy_created",
        FailedLostBall = "failed_lost_ball",
        FailedAbovePocket = "failed_above_pocket",
        FailedAskewRoller = "failed_askew_roller",
        FailedLostRotor = "failed_lost_rotor",
        RadauSteps = "radau_steps",
    }
}

impl RunStatistics {
    /// The numbers named by [`STATISTICS`]. Steps in s, vibration in m/s, frequency in rad/s, everything else a count. Zero for
    /// what was not measured.
    pub fn values(&self) -> [f64; STATISTICS.len()] {
        Statistic::ALL.map(|statistic| self.value(statistic))
    }

    fn value(&self, statistic: Statistic) -> f64 {
        let d = &self.driver;
        let of_choice = |number: fn(&Choice) -> f64| self.choice.as_ref().map_or(0.0, number);
        let failed = |kind: FaultKind| self.faults[kind as usize] as f64;
        match statistic {
            Statistic::Steps => d.steps as f64,
            Statistic::RejectedSteps => d.rejected as f64,
            Statistic::FailedSteps => d.faults as f64,
            Statistic::Evaluations => self.evaluations as f64,
            Statistic::Events => d.events as f64,
            Statistic::SmallestStep => d.smallest_step,
            Statistic::LargestStep => d.largest_step,
            Statistic::RacewayVibrationRms => d.vibration.rms(),
            Statistic::LeapfrogSteps => of_choice(|c| c.steps[Kind::Leapfrog as usize] as f64),
            Statistic::DormandPrinceSteps => of_choice(|c| c.steps[Kind::DormandPrince as usize] as f64),
            Statistic::RosenbrockSteps => of_choice(|c| c.steps[Kind::Rosenbrock as usize] as f64),
            Statistic::RadauSteps => of_choice(|c| c.steps[Kind::Radau as usize] as f64),
            Statistic::MethodChanges => of_choice(|c| c.changes as f64),
            Statistic::HighestFrequency => of_choice(|c| c.highest_frequency),
            Statistic::FailedNoGuideFilm => failed(FaultKind::NoGuideFilm),
            Statistic::FailedNoViscosity => failed(FaultKind::NoViscosity),
            Statistic::FailedLostRoller => failed(FaultKind::LostRoller),
            Statistic::FailedLostRing => failed(FaultKind::LostRing),
            Statistic::FailedLostRotor => failed(FaultKind::LostRotor),
            Statistic::FailedLostCage => failed(FaultKind::LostCage),
            Statistic::FailedNotFinite => failed(FaultKind::NotFinite),
            Statistic::FailedNoSlope => failed(FaultKind::NoSlope),
            Statistic::Jacobians => self.jacobians as f64,
            Statistic::UndoneSteps => d.undone as f64,
            Statistic::FailedOutOfPocket => failed(FaultKind::OutOfPocket),
            Statistic::FailedOverlap => failed(FaultKind::Overlap),
            Statistic::FailedTooFast => failed(FaultKind::TooFast),
            Statistic::FailedEnergyCreated => failed(FaultKind::EnergyCreated),
            Statistic::FailedLostBall => failed(FaultKind::LostBall),
            Statistic::FailedAbovePocket => failed(FaultKind::AbovePocket),
            Statistic::FailedAskewRoller => failed(FaultKind::AskewRoller),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::FAULTS;

    /// Places in the C ABI never change, so a kind of fault that is newer than others comes later.
    #[test]
    fn every_fault_has_a_statistic() {
        let mut failed: Vec<&str> =
            STATISTICS.iter().filter_map(|name| name.strip_prefix("failed_")).collect();
        failed.retain(|name| *name != "steps");
        assert_eq!(failed, FAULTS);
        let statistics =
            RunStatistics { faults: std::array::from_fn(|i| i as u64 + 1), ..Default::default() };
        let counted: f64 = statistics.values().iter().sum();
        assert_eq!(counted, (1..=FAULTS.len()).sum::<usize>() as f64);
    }
}
