//! What the presets of a scene stand for, in numbers.
//!
//! Chosen from the work-precision diagrams of docs/results/accuracy.md, which has the error and the cost of each.

use crate::scene::Preset;

/// Numbers that a preset stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Numbers {
    /// Whether rollers are followed in their statistics only, by the leapfrog.
    pub statistics: bool,
    /// Leapfrog step in units of 1/(highest frequency), with contact damping; without it takes half.
    pub leapfrog_step: f64,
    /// Tolerance of a method with error control that the scene names.
    pub tolerance: f64,
    /// Tolerance of `auto`, which promises means; for rollers while nothing vibrates, and where the leapfrog will not do.
    pub auto_tolerance: f64,
    /// Share of the energy that a trusted run misses at most.
    pub missing_energy: f64,
    /// Share of the energy by which `auto` judges its stretches, at most that of a trusted run.
    pub watched_energy: f64,
}

/// Leapfrog step without contact damping, relative to that with it.
pub(super) const UNDAMPED_SHARE: f64 = 0.5;

/// Leapfrog step of `auto` in units of 1/(highest frequency), once a longer one has missed too much energy.
pub(super) const CAREFUL_STEP: f64 = ENGINEERING.leapfrog_step;

const ENGINEERING: Numbers = Numbers {
    statistics: true,
    leapfrog_step: 1.0,
    tolerance: 1e-6,
    auto_tolerance: 1e-6,
    missing_energy: 1e-3,
    watched_energy: 1e-3,
};

// With a tolerance of 1e-4 `auto` missed a slow growth of the whirl in one of two thousand random scenes; it saved a tenth of
// the evaluations of the median one, and two fifths of the time of two hundred together. Stretches that may miss ten times as
// much as at `engineering` shifted means in four of two thousand; they saved a fifth of the evaluations of the median one. Where
// the longer step misses energy, making stretches again all the time cost more than steps of `engineering`, and shifted means.
const DRAFT: Numbers = Numbers { leapfrog_step: 1.4, tolerance: 1e-4, missing_energy: 1e-2, ..ENGINEERING };

const REFERENCE: Numbers = Numbers {
    statistics: false,
    leapfrog_step: 0.15,
    tolerance: 1e-8,
    auto_tolerance: 1e-8,
    missing_energy: 1e-4,
    watched_energy: 1e-4,
};

/// The numbers of a preset.
pub(super) fn numbers(preset: Preset) -> Numbers {
    match preset {
        Preset::Draft => DRAFT,
        Preset::Engineering => ENGINEERING,
        Preset::Reference => REFERENCE,
    }
}
