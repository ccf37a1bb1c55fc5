//! Constants of line contact laws in columns, and the evaluation of a batch with them.

use crate::laws::contact_pair::{ContactForce, ContactMotion};
use crate::laws::line_contact::LineContact;
use crate::scalar::{Columns, Pack, dispatch};
use pulp::{Arch, Simd};

/// Kinds of contacts in a batch: with the outer raceway, the inner raceway, a pocket.
pub(super) const KINDS: usize = 3;

/// Largest number of constants of a law.
const CONSTANTS: usize = 22;

/// The constants of the law of every contact in a batch.
#[derive(Clone, Debug)]
pub(super) struct LawColumns {
    /// Laws of the kinds; all have the same parts.
    laws: [LineContact; KINDS],
    /// Constants of each kind, in the order of [`LineContact::map`].
    table: [[f64; CONSTANTS]; KINDS],
    columns: Vec<Vec<f64>>,
    /// Kind of each place, whose constants the columns have.
    kind: Vec<usize>,
}

impl LawColumns {
    /// Room for this many contacts.
    pub(super) fn new(laws: [LineContact; KINDS], room: usize) -> Self {
        let mut table = [[0.0; CONSTANTS]; KINDS];
        for (law, row) in laws.iter().zip(&mut table) {
            let mut places = row.iter_mut();
            law.map(&mut |x| {
                if let Some(place) = places.next() {
                    *place = *x;
                }
            });
        }
        let columns = table[0].iter().map(|x| vec![*x; room]).collect();
        Self { laws, table, columns, kind: vec![0; room] }
    }

    /// Makes contact `i` one of this kind.
    #[inline]
    pub(super) fn set(&mut self, i: usize, kind: usize) {
        if self.kind[i] != kind {
            self.kind[i] = kind;
            for (column, x) in self.columns.iter_mut().zip(self.table[kind]) {
                column[i] = x;
            }
        }
    }

    /// Laws of the contacts from the first one on, as many as fit.
    #[inline(always)]
    pub(super) fn load<S: Simd, const K: usize>(&self, simd: S, first: usize) -> LineContact<Pack<S, K>> {
        let mut columns = self.columns.iter();
        self.laws[0].map(&mut |_| match columns.next() {
            Some(column) => Pack::load(simd, &column[first..]),
            None => Pack::all(simd, f64::NAN),
        })
    }

    /// Evaluates the laws of the first `rows` contacts, with the logarithm `thickening` of the relative viscosity.
    pub(super) fn apply(
        &self,
        rows: usize,
        motion: &ContactMotion<Vec<f64>>,
        edge_share: &[f64],
        thickening: f64,
        force: &mut ContactForce<Vec<f64>>,
        instructions: Arch,
    ) {
        dispatch(instructions, Apply { laws: self, rows, motion, edge_share, thickening, force });
    }
}

struct Apply<'a> {
    laws: &'a LawColumns,
    rows: usize,
    motion: &'a ContactMotion<Vec<f64>>,
    edge_share: &'a [f64],
    thickening: f64,
    force: &'a mut ContactForce<Vec<f64>>,
}

impl Columns for Apply<'_> {
    fn rows(&self) -> usize {
        self.rows
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let law = self.laws.load::<S, K>(simd, first);
        let motion = self.motion.load(simd, first);
        let thickening = Pack::all(simd, self.thickening);
        let edge_share = Pack::load(simd, &self.edge_share[first..]);
        self.force.store(first, &law.force(&motion, thickening, edge_share));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::line_contact::tests::raceway;
    use crate::laws::normal_contact::ElasticLine;
    use crate::laws::solid_friction::SolidFriction;

    /// Three laws with every part, different in all of them.
    fn laws() -> [LineContact; KINDS] {
        let edge_friction = Some(SolidFriction { coefficient: 0.1, transition_speed: 0.02 });
        let law = LineContact { edge_friction, ..raceway() };
        let other = |factor: f64| law.map(&mut |x| x * factor);
        let elastic = ElasticLine::new(2e11, 0.01, 0.02);
        [LineContact { elastic, ..law }, other(1.1), other(0.9)]
    }

    #[test]
    fn every_contact_gets_the_force_of_its_law() {
        let laws = laws();
        let mut count = 0;
        laws[0].map(&mut |_| count += 1);
        assert_eq!(count, CONSTANTS);

        let n = 32;
        let mut columns = LawColumns::new(laws, n);
        let mut motion = ContactMotion { delta: 0.0, delta_dot: 0.0, u1: 0.0, u2: 0.0 }.map(|_| vec![0.0; n]);
        let mut force = ContactForce::none(0.0).map(|_| vec![0.0; n]);
        // Twice, so that places change their kind.
        for turn in 0..2 {
            let at = |i: usize| {
                let x = i as f64;
                let motion =
                    ContactMotion { delta: 1e-8 * (x * x - 4.0), delta_dot: 0.0, u1: 6.0, u2: 0.3 * x };
                (motion, 0.1 * ((i * 7) % 12) as f64, (i / 2 + turn) % KINDS)
            };
            let mut shares = vec![0.0; n];
            for (i, share) in shares.iter_mut().enumerate() {
                let (contact, edge_share, kind) = at(i);
                motion.set(i, &contact);
                columns.set(i, kind);
                *share = edge_share;
            }
            columns.apply(n, &motion, &shares, 0.2, &mut force, Arch::new());
            for i in 0..n {
                let (contact, edge_share, kind) = at(i);
                let alone = laws[kind].force(&contact, 0.2, edge_share);
                assert_eq!(force.map(|x| x[i]), alone, "{turn} {i}");
            }
        }
    }
}
