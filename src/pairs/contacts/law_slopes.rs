//! Derivatives of contact forces over what their law sees, for a whole batch at once.

use super::ContactBlock;
use super::law_columns::LawColumns;
use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::elastic::solid::SolidContact;
use crate::scalar::{Columns, Dual, Duals, Lanes, Pack, Real, ZEROS, blocks_for, dispatch, place_of};
use pulp::{Arch, Simd};

/// Directions of the derivatives: approach, approach speed, u1, u2, edge share, logarithm of the viscosity.
pub(in crate::pairs) const DIRECTIONS: usize = 6;
pub(in crate::pairs) const EDGE_SHARE: usize = 4;
pub(in crate::pairs) const VISCOSITY: usize = 5;
/// Forces that have derivatives: normal force, friction, rolling resistance.
pub(in crate::pairs) const FORCES: usize = 3;

/// Derivatives of the forces of one contact.
pub(in crate::pairs) type Slopes = [[f64; DIRECTIONS]; FORCES];

/// Derivatives in blocks of columns, by force and direction.
#[derive(Clone, Debug, Default)]
pub(in crate::pairs) struct LawSlopes(Vec<[[Lanes; DIRECTIONS]; FORCES]>);

impl LawSlopes {
    /// Room for this many contacts.
    pub(in crate::pairs) fn new(room: usize) -> Self {
        Self(vec![[[ZEROS; DIRECTIONS]; FORCES]; blocks_for(room)])
    }

    /// Finds the forces of the first `rows` contacts, for which there must be room, and their derivatives, with the logarithm
    /// `ln_viscosity` of the relative viscosity.
    pub(in crate::pairs) fn find(
        &mut self,
        laws: &LawColumns,
        rows: usize,
        contacts: &mut [ContactBlock],
        ln_viscosity: f64,
        instructions: Arch,
    ) {
        let slopes = &mut self.0;
        dispatch(instructions, Differentiate { laws, contacts, slopes, rows, ln_viscosity });
    }

    /// Derivatives alone of the forces of solid contacts, which know neither edges nor a lubricant.
    pub(in crate::pairs) fn find_solid(
        &mut self,
        law: &SolidContact,
        rows: usize,
        contacts: &[ContactBlock],
    ) {
        for i in 0..rows {
            let (block, lane) = place_of(i);
            let motion = contacts[block].motion.of(lane);
            let variable = Dual::<DIRECTIONS>::variable;
            let force = law.force(&ContactMotion {
                delta: variable(motion.delta, 0),
                delta_dot: variable(motion.delta_dot, 1),
                u1: variable(motion.u1, 2),
                u2: variable(motion.u2, 3),
            });
            let forces = [force.normal, force.friction, force.rolling_resistance];
            for (columns, of_force) in self.0[block].iter_mut().zip(forces) {
                for (column, slope) in columns.iter_mut().zip(of_force.eps) {
                    column[lane] = slope;
                }
            }
        }
    }

    /// Derivatives of the forces of contact `i`.
    #[inline(always)]
    pub(in crate::pairs) fn of(&self, i: usize) -> Slopes {
        let mut slopes = [[0.0; DIRECTIONS]; FORCES];
        let (block, lane) = place_of(i);
        for (row, columns) in slopes.iter_mut().zip(&self.0[block]) {
            for (slope, column) in row.iter_mut().zip(columns) {
                *slope = column[lane];
            }
        }
        slopes
    }
}

/// The forces of a contact, with the `slopes` of its law, over the coordinates of its bodies: chain rule.
#[inline]
pub(in crate::pairs) fn chain<const N: usize>(
    forces: &[f64; FORCES],
    slopes: &Slopes,
    motion: &ContactMotion<Dual<N>>,
    edge_share: Option<Dual<N>>,
) -> ContactForce<Dual<N>> {
    let inner = [motion.delta, motion.delta_dot, motion.u1, motion.u2];
    let over_coordinates = |f: usize| {
        let mut out = Dual::constant(forces[f]);
        for (slope, x) in slopes[f].iter().zip(inner.iter().chain(&edge_share)) {
            for (e, dx) in out.eps.iter_mut().zip(x.eps) {
                *e += slope * dx;
            }
        }
        out
    };
    contact_force([over_coordinates(0), over_coordinates(1), over_coordinates(2)])
}

/// A contact with this normal force, friction and rolling resistance, N, or their rates; all else is zero.
#[inline]
pub(in crate::pairs) fn contact_force<T: Real>(
    [normal, friction, rolling_resistance]: [T; FORCES],
) -> ContactForce<T> {
    ContactForce { normal, friction, rolling_resistance, ..ContactForce::none(T::constant(0.0)) }
}

struct Differentiate<'a> {
    laws: &'a LawColumns,
    contacts: &'a mut [ContactBlock],
    slopes: &'a mut [[[Lanes; DIRECTIONS]; FORCES]],
    rows: usize,
    ln_viscosity: f64,
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
        let (block, lane) = place_of(first);
        let ContactBlock { motion, edge_share, force: out, .. } = &mut self.contacts[block];
        let motion = motion.load::<S, K>(simd, lane);
        let motion = ContactMotion {
            delta: Duals::<DIRECTIONS, _>::variable(motion.delta, 0),
            delta_dot: Duals::variable(motion.delta_dot, 1),
            u1: Duals::variable(motion.u1, 2),
            u2: Duals::variable(motion.u2, 3),
        };
        let edge_share = Duals::variable(Pack::load(simd, &edge_share[lane..]), EDGE_SHARE);
        let ln_viscosity = Duals::variable(Pack::all(simd, self.ln_viscosity), VISCOSITY);
        let law = self.laws.load::<S, K>(simd, first);
        let force = law.force(&motion, ln_viscosity, edge_share);
        out.store(lane, &force);
        let forces = [force.normal, force.friction, force.rolling_resistance];
        for f in 0..FORCES {
            for d in 0..DIRECTIONS {
                forces[f].eps[d].store(&mut self.slopes[block][f][d][lane..]);
            }
        }
    }
}
