//! Step-size control: constants and the PI controller of the methods with an error estimate.
//!
//! Factors follow Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, section II.4.

/// Aim at this share of the largest step that the error estimate allows.
const SAFETY: f64 = 0.9;
/// Weight of the previous error (PI control); 0 is plain control.
const PI_WEIGHT: f64 = 0.04;
/// A step grows and shrinks at most by these factors.
const MAX_GROWTH: f64 = 5.0;
const MIN_SHRINK: f64 = 0.2;
/// Errors below this count as this, so that a perfect step does not spoil the memory.
const SMALLEST_ERROR: f64 = 1e-4;
/// Step factor after an evaluation failed.
pub const FAULT_SHRINK: f64 = 0.25;
/// Growth back to the nominal step of a method without error estimate, per step.
pub const RECOVERY_GROWTH: f64 = 2.0;

/// Proportional-integral step-size controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PiController {
    /// Error of the last accepted step in units of the tolerance.
    pub last_error: f64,
    /// The last attempt was rejected: do not grow yet.
    pub after_rejection: bool,
}

impl PiController {
    /// A controller without memory.
    pub fn new() -> Self {
        Self { last_error: SMALLEST_ERROR, after_rejection: false }
    }

    /// Factor for the next step after an accepted one with the error `error` <= 1.
    pub fn accepted(&mut self, error: f64, order: f64) -> f64 {
        let exponent = 1.0 / order - 0.75 * PI_WEIGHT;
        let error = error.max(SMALLEST_ERROR);
        let factor = SAFETY * error.powf(-exponent) * self.last_error.powf(PI_WEIGHT);
        let growth = if self.after_rejection { 1.0 } else { MAX_GROWTH };
        self.last_error = error;
        self.after_rejection = false;
        factor.clamp(MIN_SHRINK, growth)
    }

    /// Factor for the retry of a step with the error `error` > 1.
    pub fn rejected(&mut self, error: f64, order: f64) -> f64 {
        let exponent = 1.0 / order - 0.75 * PI_WEIGHT;
        self.after_rejection = true;
        (SAFETY * error.powf(-exponent)).clamp(MIN_SHRINK, 1.0)
    }
}
