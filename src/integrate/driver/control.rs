//! Errors and step sizes: the norm that measures an error, the controller that follows it, and their constants.
//!
//! Sources: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, section II.4 (safety, limits);
//! Soderlind, Digital filters in adaptive time-stepping, ACM Trans. Math. Softw. 29 (2003) 1 (filtered controllers);
//! Soderlind and Wang, Adaptive time-stepping and computational stability, J. Comp. Appl. Math. 185 (2006) 225
//! (smooth limiter).

use crate::integrate::System;
use crate::scalar::math;

/// Aim at this share of the largest step that the error estimate allows.
const SAFETY: f64 = 0.9;
/// The filter H211 with b = 4, for implicit methods: it answers to the mean of two errors, and a change of the step
/// damps the next one, so that impacts cost fewer rejected steps.
const FILTER: [f64; 3] = [0.25, 0.25, 0.25];
/// The controller PI.3.4, for explicit methods: it settles where stability and not accuracy limits the step.
const PROPORTIONAL_INTEGRAL: [f64; 3] = [0.7, -0.4, 0.0];
/// A change of the step by a factor c becomes 1 + LIMIT atan((c - 1)/LIMIT): at most 2.6, at least 0.2.
const LIMIT: f64 = 1.0;
/// Growth of a steady step.
const DOUBLED: f64 = 2.0;
/// Errors below this count as this, so that a perfect step does not spoil the memory.
const SMALLEST_ERROR: f64 = 1e-4;
/// A rejected step shrinks at least to this and at most to that share.
const REJECTED_SHRINK: [f64; 2] = [0.2, 0.9];
/// Step factor after an evaluation failed.
pub const FAULT_SHRINK: f64 = 0.25;
/// Growth back to the nominal step of a method without error estimate, per step.
pub const RECOVERY_GROWTH: f64 = 2.0;

/// The error of an attempted step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// In units of the tolerance; a step with at most 1 is accepted.
    pub error: f64,
    /// The group of velocities whose states have this error: see [`System::groups`].
    pub group: usize,
}

/// How steps of a method follow its errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    /// Power of the step that the error estimate grows with.
    order: f64,
    /// Exponents, times the order, of the present and the last error, and of the last change of the step.
    exponents: [f64; 3],
    /// Whether the step stays as it is unless it can be doubled or must shrink.
    steady: bool,
}

impl Law {
    /// For an explicit method.
    pub fn explicit(order: f64) -> Self {
        Self { order, exponents: PROPORTIONAL_INTEGRAL, steady: false }
    }

    /// For an implicit or linearly implicit method.
    pub fn implicit(order: f64) -> Self {
        Self { order, exponents: FILTER, steady: false }
    }

    /// For a multistep method, whose coefficients and choice of the order like even steps.
    pub fn multistep(order: f64) -> Self {
        Self { order, exponents: [1.0, 0.0, 0.0], steady: true }
    }
}

/// Root mean square over the states of a group in units of their tolerances, largest over the groups: no body is
/// hidden by a mean over all of them, and no state is measured by its own size (angles grow without limit).
#[derive(Clone, Debug)]
pub struct ErrorNorm {
    /// 1/tolerance of each state, divided by the root of the number of states in its group.
    weight: Vec<f64>,
    /// Group of each state.
    group: Vec<usize>,
    squares: Vec<f64>,
}

impl ErrorNorm {
    /// The norm for a system, with an absolute tolerance for every state. States in no group form one more.
    pub fn new<S: System>(system: &S, tolerance: &[f64]) -> Self {
        let (positions, groups) = (system.positions(), system.groups());
        let rest = groups.len();
        let mut group = vec![rest; positions + system.velocities()];
        for (i, velocities) in groups.into_iter().enumerate() {
            for v in velocities {
                group[positions + v] = i;
                if v < positions {
                    group[v] = i;
                }
            }
        }
        let size = |g: usize| group.iter().filter(|i| **i == g).count() as f64;
        let weight = tolerance.iter().zip(&group).map(|(t, g)| 1.0 / (t * size(*g).sqrt())).collect();
        Self { weight, group, squares: vec![0.0; rest + 1] }
    }

    /// Size of an error given by its component for each state.
    pub fn of(&mut self, component: impl Fn(usize) -> f64) -> Estimate {
        self.squares.fill(0.0);
        for (i, (weight, group)) in self.weight.iter().zip(&self.group).enumerate() {
            let e = component(i) * weight;
            self.squares[*group] += e * e;
        }
        let mut largest = Estimate::default();
        for (group, square) in self.squares.iter().enumerate() {
            // Also true for what is not a number, which then stays.
            if !(square.sqrt() <= largest.error || largest.error.is_nan()) {
                largest = Estimate { error: square.sqrt(), group };
            }
        }
        largest
    }
}

/// Chooses step sizes from the errors of the last two steps and the last change of the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Controller {
    /// Error of the last accepted step in units of the tolerance.
    pub last_error: f64,
    /// Last step over the one before it.
    pub last_change: f64,
    /// The last attempt was rejected: do not grow yet.
    pub after_rejection: bool,
}

impl Default for Controller {
    /// A controller without memory.
    fn default() -> Self {
        Self { last_error: 1.0, last_change: 1.0, after_rejection: false }
    }
}

impl Controller {
    /// Factor for the next step after an accepted one with the error `error` <= 1.
    pub fn accepted(&mut self, error: f64, law: Law) -> f64 {
        let Law { order, exponents: [now, last, change], steady } = law;
        let aim = math::powf(SAFETY, order);
        let error = error.max(SMALLEST_ERROR) / aim;
        let power = |x: f64, exponent: f64| if exponent == 0.0 { 1.0 } else { math::powf(x, exponent) };
        let followed = power(error, -now / order) * power(self.last_error, -last / order);
        let wanted = followed * power(self.last_change, -change);
        let limited = 1.0 + LIMIT * math::atan((wanted - 1.0) / LIMIT);
        let factor = match limited {
            _ if self.after_rejection => limited.min(1.0),
            _ if !steady => limited,
            x if x >= DOUBLED => DOUBLED,
            x => x.min(1.0),
        };
        *self = Self { last_error: error, last_change: factor, after_rejection: false };
        factor
    }

    /// Factor for the retry of a step with the error `error` > 1; a quarter if it is not finite.
    pub fn rejected(&mut self, error: f64, law: Law) -> f64 {
        if !error.is_finite() {
            return self.failed();
        }
        self.after_rejection = true;
        let [most, least] = REJECTED_SHRINK;
        (SAFETY * math::powf(error, -1.0 / law.order)).clamp(most, least)
    }

    /// Factor for the retry of a step whose evaluation failed.
    pub fn failed(&mut self) -> f64 {
        self.after_rejection = true;
        FAULT_SHRINK
    }
}

/// A step size (s), its end and the last time that it may look at, and whether something cut it.
pub struct Plan {
    pub h: f64,
    pub end: f64,
    pub t_last: f64,
    pub cut: bool,
    /// Whether it ends on an event.
    pub on_event: bool,
}

impl Plan {
    /// A step of `h` where one of `wanted` was, from time `t` (s): never across an `event`, and not leaving a tiny rest before it.
    pub fn of(t: f64, h: f64, wanted: f64, event: f64) -> Self {
        let (rest, t_last) = (event - t, event.next_down());
        if rest <= h {
            Self { h: rest, end: event, t_last, cut: true, on_event: true }
        } else if rest < 2.0 * h {
            Self { h: 0.5 * rest, end: t + 0.5 * rest, t_last, cut: true, on_event: false }
        } else {
            Self { h, end: t + h, t_last, cut: h < wanted, on_event: false }
        }
    }
}
