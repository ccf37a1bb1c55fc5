//! Parts of the circle between places where the integrand of a film has a kink.

use crate::scalar::WIDEST;
use std::f64::consts::PI;

/// h - h_L.
pub(in crate::laws::guide) const DRY: usize = 0;
/// G.
pub(in crate::laws::guide) const OPENING: usize = 1;
/// K.
pub(in crate::laws::guide) const EXCESS: usize = 2;
/// Functions that change their sign at breaks.
pub(in crate::laws::guide) const FUNCTIONS: usize = 3;

/// Most of those breaks that stand for what changed in dry parts.
pub(super) const MOST_DRY: usize = WIDEST;
/// Room for breaks: of a full block of brackets, of those that it leads to, and of dry parts.
const BREAKS: usize = 2 * WIDEST + MOST_DRY + FUNCTIONS;
/// One place where a function changes its sign.
#[derive(Clone, Copy, Default)]
pub(in crate::laws::guide) struct Break {
    /// rad
    pub angle: f64,
    /// Which of the functions.
    pub of: usize,
}

/// Breaks in ascending order, up to `M`.
pub(in crate::laws::guide) struct Breaks<const M: usize> {
    all: [Break; M],
    count: usize,
}

impl<const M: usize> Breaks<M> {
    /// None.
    pub fn none() -> Self {
        Self { all: [Break::default(); M], count: 0 }
    }

    /// All of them.
    pub fn all(&self) -> &[Break] {
        &self.all[..self.count]
    }

    /// Adds one in its place.
    #[inline]
    pub fn add(&mut self, angle: f64, of: usize) {
        let mut place = self.count;
        while place > 0 && self.all[place - 1].angle > angle {
            self.all[place] = self.all[place - 1];
            place -= 1;
        }
        self.all[place] = Break { angle, of };
        self.count += 1;
    }
}

/// A part of the circle and its breaks.
pub(in crate::laws::guide) struct Stretch {
    /// rad
    pub from: f64,
    /// rad
    pub to: f64,
    /// Number of the step that it ends with.
    pub last_step: usize,
    /// Whether each of the functions is negative at its start.
    pub negative: [bool; FUNCTIONS],
    /// Smallest film of those looked at, m, and where it is, rad.
    pub thinnest: f64,
    pub thinnest_at: f64,
    pub breaks: Breaks<BREAKS>,
    /// How many of them stand for what changed in dry parts.
    pub(super) dry: usize,
}

impl Stretch {
    /// Nothing, where the circle begins.
    pub fn new() -> Self {
        Self {
            from: 0.0,
            to: -PI,
            last_step: 0,
            negative: [false; FUNCTIONS],
            thinnest: f64::INFINITY,
            thinnest_at: -PI,
            breaks: Breaks::none(),
            dry: 0,
        }
    }

    /// Starts the next one where this one ends.
    pub(super) fn go_on(&mut self) {
        (self.breaks.count, self.dry) = (0, 0);
    }

    /// Begins it at this angle, rad, where these functions are negative.
    pub(super) fn begin(&mut self, from: f64, negative: [bool; FUNCTIONS]) {
        (self.from, self.negative) = (from, negative);
    }

    /// Keeps the smallest film (m) and where it is (rad).
    pub(super) fn look_at(&mut self, film: f64, angle: f64) {
        // A NaN is kept.
        let thicker = film >= self.thinnest || self.thinnest.is_nan();
        if !thicker {
            (self.thinnest, self.thinnest_at) = (film, angle);
        }
    }
}
