//! Derivatives of contact forces over what their law sees, for a whole batch at once.

use super::ContactBlock;
use super::law_columns::{LawColumns, across_at};
use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::elastic::solid::SolidContact;
use crate::scalar::{Base, Columns, Duals, Lanes, Numeric, Pack, ZEROS, blocks_for, dispatch, place_of};
use pulp::{Arch, Simd};

/// Directions of the derivatives: approach, approach speed, u1, u2, edge share, logarithm of the viscosity.
pub(in crate::pairs) const DIRECTIONS: usize = 6;
pub(in crate::pairs) const EDGE_SHARE: usize = 4;
pub(in crate::pairs) const VISCOSITY: usize = 5;
/// Forces that have derivatives: normal force, friction, rolling resistance.
pub(in crate::pairs) const FORCES: usize = 3;

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
        dispatch(instructions, Differentiate { laws, contacts, across: None, slopes, rows, ln_viscosity });
    }

    /// The same where surfaces also slide across the direction of rolling at these speeds, m/s, which take the place of the edge share among
    /// the directions, as the secant of friction takes that of friction among the forces.
    pub(in crate::pairs) fn find_sliding(
        &mut self,
        laws: &LawColumns,
        rows: usize,
        contacts: &mut [ContactBlock],
        across: &[Lanes],
        ln_viscosity: f64,
        instructions: Arch,
    ) {
        let (slopes, across) = (&mut self.0, Some(across));
        dispatch(instructions, Differentiate { laws, contacts, across, slopes, rows, ln_viscosity });
    }

    /// The same of solid contacts, which know neither edges nor a lubricant.
    pub(in crate::pairs) fn find_solid(
        &mut self,
        law: SolidContact,
        rows: usize,
        contacts: &mut [ContactBlock],
        instructions: Arch,
    ) {
        let slopes = &mut self.0;
        dispatch(instructions, DifferentiateSolid { law, contacts, slopes, rows });
    }

    /// Derivatives of a block of contacts.
    #[inline(always)]
    pub(in crate::pairs) fn block(&self, block: usize) -> &[[Lanes; DIRECTIONS]; FORCES] {
        &self.0[block]
    }

    /// Derivatives of the forces of contact `i`.
    pub(in crate::pairs) fn of(&self, i: usize) -> [[f64; DIRECTIONS]; FORCES] {
        let (block, lane) = place_of(i);
        self.0[block].each_ref().map(|row| row.each_ref().map(|column| column[lane]))
    }
}

/// A contact with this normal force, friction and rolling resistance, N, or their rates; all else is zero.
#[inline(always)]
pub(in crate::pairs) fn contact_force<T: Numeric>(
    [normal, friction, rolling_resistance]: [T; FORCES],
) -> ContactForce<T> {
    ContactForce { normal, friction, rolling_resistance, ..ContactForce::none(normal.like(0.0)) }
}

struct Differentiate<'a> {
    laws: &'a LawColumns,
    contacts: &'a mut [ContactBlock],
    across: Option<&'a [Lanes]>,
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
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (block, lane) = place_of(first);
        let ContactBlock { motion, edge_share, force: out, .. } = &mut self.contacts[block];
        let motion = variables(&motion.load::<S, K>(simd, lane));
        let mut edge_share = Duals::variable(Pack::load(simd, &edge_share[lane..]), EDGE_SHARE);
        let mut across = Duals::lift(across_at(simd, self.across, first));
        if self.across.is_some() {
            (edge_share, across) = (Duals::lift(edge_share.re), Duals::variable(across.re, EDGE_SHARE));
        }
        let ln_viscosity = Duals::variable(Pack::all(simd, self.ln_viscosity), VISCOSITY);
        let law = self.laws.load::<S, K>(simd, first);
        let force = law.force_sliding(&motion, across, ln_viscosity, edge_share);
        out.store(lane, &force);
        let mut told = force;
        if self.across.is_some() {
            told.friction = force.friction_secant;
        }
        store(&told, &mut self.slopes[block], lane);
    }
}

struct DifferentiateSolid<'a> {
    law: SolidContact,
    contacts: &'a mut [ContactBlock],
    slopes: &'a mut [[[Lanes; DIRECTIONS]; FORCES]],
    rows: usize,
}

impl Columns for DifferentiateSolid<'_> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.rows
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (block, lane) = place_of(first);
        let ContactBlock { motion, force: out, .. } = &mut self.contacts[block];
        let force = self.law.force(&variables(&motion.load::<S, K>(simd, lane)));
        out.store(lane, &force);
        store(&force, &mut self.slopes[block], lane);
    }
}

/// What every law sees, as variables.
#[inline(always)]
fn variables<B: Base>(motion: &ContactMotion<B>) -> ContactMotion<Duals<DIRECTIONS, B>> {
    ContactMotion {
        delta: Duals::variable(motion.delta, 0),
        delta_dot: Duals::variable(motion.delta_dot, 1),
        u1: Duals::variable(motion.u1, 2),
        u2: Duals::variable(motion.u2, 3),
    }
}

/// Keeps the derivatives of the forces from this place of the lanes on.
#[inline(always)]
#[expect(clippy::needless_range_loop, reason = "iterators might not be inlined")]
fn store<S: Simd, const K: usize>(
    force: &ContactForce<Duals<DIRECTIONS, Pack<S, K>>>,
    slopes: &mut [[Lanes; DIRECTIONS]; FORCES],
    lane: usize,
) {
    let forces = [force.normal, force.friction, force.rolling_resistance];
    for f in 0..FORCES {
        for d in 0..DIRECTIONS {
            forces[f].eps[d].store(&mut slopes[f][d][lane..]);
        }
    }
}
