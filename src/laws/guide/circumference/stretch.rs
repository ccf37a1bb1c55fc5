//! Functions of the gap at whose zeros the integrand of a film has a kink, and parts of the circle between such places.

use super::gap::{Gap, Place};
use crate::scalar::{Base, WIDEST};
use std::f64::consts::PI;

/// h - h_L.
pub(in crate::laws::guide) const DRY: usize = 0;
/// G.
pub(in crate::laws::guide) const OPENING: usize = 1;
/// K.
pub(in crate::laws::guide) const EXCESS: usize = 2;
/// Functions that change their sign at breaks.
pub(in crate::laws::guide) const FUNCTIONS: usize = 3;

/// What is looked for on a circle.
#[derive(Clone, Copy, PartialEq)]
pub(in crate::laws::guide) enum Aims {
    /// The smallest film.
    Minima,
    /// Where h = h_L and where G = 0.
    Edges,
    /// Where K = 0, too, with this c, 1/(m^2 s).
    EdgesAndExcess(f64),
}

/// K and its slope.
#[inline(always)]
pub(super) fn excess<B: Base>(c: f64, [h, h1]: [B; 2], [g, g1]: [B; 2]) -> [B; 2] {
    let square = h * h;
    [g + square * h * c, g1 + square * h1 * (3.0 * c)]
}

/// Functions of a gap whose signs are looked at.
#[derive(Clone, Copy)]
pub(super) struct Functions<'a> {
    pub gap: &'a Gap<'a>,
    /// h_L, m; infinite where everything is wet.
    pub layer: f64,
    pub aims: Aims,
}

impl Functions<'_> {
    /// Functions with their derivatives at a place.
    #[inline(always)]
    fn all<B: Base>(&self, p: &Place<B>) -> [[B; 4]; FUNCTIONS] {
        let ([h, h1, h2, h3], [g, g1, g2, g3]) = (p.film, p.opening);
        let excess = match self.aims {
            Aims::Minima | Aims::Edges => p.opening,
            Aims::EdgesAndExcess(c) => {
                let [value, slope] = excess(c, [h, h1], [g, g1]);
                let square = h1 * h1 * 2.0;
                let second = g2 + h * (square + h * h2) * (3.0 * c);
                [value, slope, second, g3 + (h1 * (square + h * h2 * 6.0) + h * h * h3) * (3.0 * c)]
            }
        };
        [[h - self.layer, h1, h2, h3], p.opening, excess]
    }

    /// The function of this number and its slope where h (m) and G (m/s) and their slopes are these.
    #[inline(always)]
    pub(super) fn of_values(&self, of: usize, [h, h1]: [f64; 2], opening: [f64; 2]) -> [f64; 2] {
        match (of, self.aims) {
            (DRY, _) => [h - self.layer, h1],
            (EXCESS, Aims::EdgesAndExcess(c)) => excess(c, [h, h1], opening),
            _ => opening,
        }
    }

    /// The function of this number at each place.
    #[inline(always)]
    pub(super) fn at<B: Base>(&self, of: B, p: &Place<B>) -> [B; 4] {
        let [mut out, opening, excess] = self.all(p);
        for k in 0..4 {
            out[k] = B::select(of.above(0.5), B::select(of.above(1.5), excess[k], opening[k]), out[k]);
        }
        out
    }
}

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
