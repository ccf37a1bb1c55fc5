//! Derivatives of line contact forces over what their law sees, for a whole batch at once.

use super::law_columns::LawColumns;
use crate::laws::contact_pair::ContactMotion;
use crate::scalar::{Columns, Duals, Numeric, Pack, dispatch};
use pulp::{Arch, Simd};

/// Directions of the derivatives: approach, approach speed, u1, u2, logarithm of the viscosity.
pub(super) const DIRECTIONS: usize = 5;
/// Forces that have derivatives: normal force, friction, rolling resistance.
pub(super) const FORCES: usize = 3;

/// Derivatives in columns, by force and direction.
#[derive(Clone, Debug, Default)]
pub(super) struct LawSlopes([[Vec<f64>; DIRECTIONS]; FORCES]);

impl LawSlopes {
    /// Room for this many contacts.
    pub(super) fn new(room: usize) -> Self {
        Self(std::array::from_fn(|_| std::array::from_fn(|_| vec![0.0; room])))
    }

    /// Finds the derivatives of the first `rows` contacts, for which there must be room, with the logarithm `thickening`
    /// of the relative viscosity.
    pub(super) fn find(
        &mut self,
        laws: &LawColumns,
        rows: usize,
        motion: &ContactMotion<Vec<f64>>,
        thickening: f64,
        instructions: Arch,
    ) {
        dispatch(instructions, Differentiate { laws, motion, slopes: &mut self.0, rows, thickening });
    }

    /// Derivatives of the forces of contact `i`.
    pub(super) fn of(&self, i: usize) -> [[f64; DIRECTIONS]; FORCES] {
        std::array::from_fn(|f| std::array::from_fn(|d| self.0[f][d][i]))
    }
}

struct Differentiate<'a> {
    laws: &'a LawColumns,
    motion: &'a ContactMotion<Vec<f64>>,
    slopes: &'a mut [[Vec<f64>; DIRECTIONS]; FORCES],
    rows: usize,
    thickening: f64,
}

impl Columns for Differentiate<'_> {
    /// Values with their derivatives fill the registers by themselves.
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.rows
    }

    #[inline(always)]
    #[expect(clippy::needless_range_loop, reason = "iterators might not be inlined")]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let motion = self.motion.load::<S, K>(simd, first);
        let motion = ContactMotion {
            delta: Duals::<DIRECTIONS, _>::variable(motion.delta, 0),
            delta_dot: Duals::variable(motion.delta_dot, 1),
            u1: Duals::variable(motion.u1, 2),
            u2: Duals::variable(motion.u2, 3),
        };
        let thickening = Duals::variable(Pack::all(simd, self.thickening), 4);
        let law = self.laws.load::<S, K>(simd, first);
        let force = law.force(&motion, thickening, thickening.like(0.0));
        let forces = [force.normal, force.friction, force.rolling_resistance];
        for f in 0..FORCES {
            for d in 0..DIRECTIONS {
                forces[f].eps[d].store(&mut self.slopes[f][d][first..]);
            }
        }
    }
}
