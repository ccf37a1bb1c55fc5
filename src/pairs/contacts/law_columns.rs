//! Constants of line contact laws in columns, and the evaluation of a batch with them.
//!
//! Contacts of several kinds share a batch if the laws of these kinds have the same parts. They differ in constants only,
//! which are columns too, so that vector instructions serve all of them at once.

use super::ContactBlock;
use crate::laws::line_contact::LineContact;
use crate::scalar::{Columns, Lanes, Pack, WIDEST, blocks_for, dispatch, place_of};
use pulp::{Arch, Simd};

/// The constants of the law of every contact in a batch.
#[derive(Clone, Debug)]
pub(in crate::pairs) struct LawColumns {
    /// The first of the laws; all have the same parts.
    first: LineContact,
    /// Constants of each kind, in the order of [`LineContact::map`].
    table: Vec<Vec<f64>>,
    /// The same of every place, by blocks.
    blocks: Vec<Vec<Lanes>>,
    /// Kind of each place, whose constants the columns have.
    kind: Vec<usize>,
}

impl LawColumns {
    /// Room for this many contacts of kinds with these laws, which have the same parts; there is at least one.
    pub(in crate::pairs) fn new(first: LineContact, others: &[LineContact], room: usize) -> Self {
        let constants = |law: &LineContact| {
            let mut list = Vec::new();
            law.map(&mut |x| list.push(*x));
            list
        };
        let table: Vec<Vec<f64>> = std::iter::once(&first).chain(others).map(constants).collect();
        let block: Vec<Lanes> = table[0].iter().map(|x| [*x; WIDEST]).collect();
        Self { first, table, blocks: vec![block; blocks_for(room)], kind: vec![0; room] }
    }

    /// Makes contact `i` one of this kind.
    #[inline]
    pub(in crate::pairs) fn set(&mut self, i: usize, kind: usize) {
        if self.kind[i] != kind {
            self.kind[i] = kind;
            let (block, lane) = place_of(i);
            for (column, x) in self.blocks[block].iter_mut().zip(&self.table[kind]) {
                column[lane] = *x;
            }
        }
    }

    /// Laws of the contacts from the first one on, as many as fit.
    #[inline(always)]
    pub(in crate::pairs) fn load<S: Simd, const K: usize>(
        &self,
        simd: S,
        first: usize,
    ) -> LineContact<Pack<S, K>> {
        let (block, lane) = place_of(first);
        let mut columns = self.blocks[block].iter();
        self.first.map(&mut |_| match columns.next() {
            Some(column) => Pack::load(simd, &column[lane..]),
            None => Pack::all(simd, f64::NAN),
        })
    }

    /// Evaluates the laws of the first `rows` contacts, with the logarithm `ln_viscosity` of the relative viscosity.
    pub(in crate::pairs) fn apply(
        &self,
        rows: usize,
        contacts: &mut [ContactBlock],
        ln_viscosity: f64,
        instructions: Arch,
    ) {
        self.apply_sliding(rows, contacts, None, ln_viscosity, instructions);
    }

    /// The same where surfaces also slide across the direction of rolling at these speeds, m/s.
    pub(in crate::pairs) fn apply_sliding(
        &self,
        rows: usize,
        contacts: &mut [ContactBlock],
        across: Option<&[Lanes]>,
        ln_viscosity: f64,
        instructions: Arch,
    ) {
        dispatch(instructions, Apply { laws: self, rows, contacts, across, ln_viscosity });
    }
}

/// Speeds across from contact `first` on, or none.
#[inline(always)]
pub(super) fn across_at<S: Simd, const K: usize>(
    simd: S,
    across: Option<&[Lanes]>,
    first: usize,
) -> Pack<S, K> {
    let (block, lane) = place_of(first);
    match across {
        Some(across) => Pack::load(simd, &across[block][lane..]),
        None => Pack::all(simd, 0.0),
    }
}

struct Apply<'a> {
    laws: &'a LawColumns,
    rows: usize,
    contacts: &'a mut [ContactBlock],
    across: Option<&'a [Lanes]>,
    ln_viscosity: f64,
}

impl Columns for Apply<'_> {
    fn rows(&self) -> usize {
        self.rows
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (block, lane) = place_of(first);
        let law = self.laws.load::<S, K>(simd, first);
        let ContactBlock { motion, edge_share, force, .. } = &mut self.contacts[block];
        let ln_viscosity = Pack::all(simd, self.ln_viscosity);
        let edge_share = Pack::load(simd, &edge_share[lane..]);
        let across = across_at(simd, self.across, first);
        let motion = motion.load(simd, lane);
        force.store(lane, &law.force_sliding(&motion, across, ln_viscosity, edge_share));
    }
}

#[cfg(test)]
mod tests {
    use super::super::law_slopes::LawSlopes;
    use super::*;
    use crate::laws::contact_pair::ContactMotion;
    use crate::laws::elastic::line::ElasticLine;
    use crate::laws::elastic::profile::tests::profiles;
    use crate::laws::film::thickness::FilmThickness;
    use crate::laws::line_contact::tests::raceway;
    use crate::laws::traction::solid_friction::SolidFriction;

    /// Three laws with every part, different in all of them.
    fn laws() -> [LineContact; 3] {
        let edge_friction = Some(SolidFriction { coefficient: 0.1, transition_speed: 0.02 });
        let law = LineContact { edge_friction, ..raceway() };
        let other = |factor: f64| law.map(&mut |x| x * factor);
        let elastic = ElasticLine::new(2e11, 0.01, 0.02);
        [LineContact { elastic, ..law }, other(1.1), other(0.9)]
    }

    #[test]
    fn every_contact_gets_the_force_of_its_law() {
        check_forces(laws());
        for (_, profile, _) in profiles(3) {
            // The crowns of the three differ.
            let profiled = |law: LineContact, x: f64| LineContact {
                profile: Some(profile.map(&mut |curvature| x * curvature)),
                ..law
            };
            let [a, b, c] = laws();
            check_forces([profiled(a, 1.0), profiled(b, 0.7), profiled(c, 1.3)]);
        }
    }

    fn check_forces(laws: [LineContact; 3]) {
        let n = 32;
        let mut columns = LawColumns::new(laws[0], &laws[1..], n);
        let mut contacts = vec![ContactBlock::APART; blocks_for(n)];
        // Twice, so that places change their kind.
        for turn in 0..2 {
            let at = |i: usize| {
                let x = i as f64;
                let motion =
                    ContactMotion { delta: 1e-8 * (x * x - 4.0), delta_dot: 0.0, u1: 6.0, u2: 0.3 * x };
                (motion, 0.1 * ((i * 7) % 12) as f64, (i / 2 + turn) % laws.len())
            };
            for i in 0..n {
                let (contact, edge_share, kind) = at(i);
                let (block, lane) = place_of(i);
                contacts[block].motion.set(lane, &contact);
                contacts[block].edge_share[lane] = edge_share;
                columns.set(i, kind);
            }
            let instructions = if turn == 0 { Arch::new() } else { Arch::Scalar };
            columns.apply(n, &mut contacts, 0.2, instructions);
            for i in 0..n {
                let (contact, edge_share, kind) = at(i);
                let alone = laws[kind].force(&contact, 0.2, edge_share);
                let (block, lane) = place_of(i);
                assert_eq!(contacts[block].force.of(lane), alone, "{turn} {i}");
            }
        }
    }

    /// The law without each of the parts that another may have beside it.
    fn without_parts(law: LineContact) -> [LineContact; 7] {
        let film = law.film.map(|film| FilmThickness { thermal: None, ..film });
        [
            LineContact { damping: None, ..law },
            LineContact { rolling_resistance: None, ..law },
            LineContact { edge_friction: None, ..law },
            LineContact { film, ..law },
            LineContact { self_heating: None, ..law },
            LineContact { traction: None, self_heating: None, ..law },
            LineContact { film, regime: None, self_heating: None, ..law },
        ]
    }

    #[test]
    fn contacts_without_a_part_have_the_same_force_beside_others_with_it() {
        let [full, other, _] = laws();
        for bare in without_parts(other) {
            let [own, beside] = bare.alike(&full).expect("parts that can be filled in");
            let (mut mixed, alone) =
                (LawColumns::new(own, &[beside], WIDEST), LawColumns::new(bare, &[], WIDEST));
            let mut contacts = vec![ContactBlock::APART; 1];
            let mut slopes = [0, 1].map(|_| LawSlopes::new(WIDEST));
            for lane in 0..WIDEST {
                let x = lane as f64;
                let motion = ContactMotion { delta: 1e-7 * x, delta_dot: 1e-3 * x, u1: 5.0, u2: 0.5 * x };
                contacts[0].motion.set(lane, &motion);
                // Only contacts with a law for edges have a share of one.
                contacts[0].edge_share[lane] = if bare.edge_friction.is_some() { 0.1 * x } else { 0.0 };
                mixed.set(lane, lane % 2);
            }
            mixed.apply(WIDEST, &mut contacts, 0.2, Arch::new());
            for lane in 0..WIDEST {
                let (motion, edge_share) = (contacts[0].motion.of(lane), contacts[0].edge_share[lane]);
                let law = if lane % 2 == 0 { &bare } else { &full };
                let expected = law.force(&motion, 0.2, edge_share);
                assert_eq!(contacts[0].force.of(lane), expected, "{lane} beside {bare:?}");
            }
            for (laws, slopes) in [mixed, alone].iter().zip(&mut slopes) {
                slopes.find(laws, WIDEST, &mut contacts, 0.2, Arch::new());
            }
            for lane in (0..WIDEST).step_by(2) {
                let [beside, alone] = slopes.each_ref().map(|slopes| slopes.of(lane));
                for (a, b) in beside.iter().flatten().zip(alone.iter().flatten()) {
                    assert!((a - b).abs() <= 1e-13 * b.abs(), "{lane}: {beside:?} {alone:?} of {bare:?}");
                }
            }
        }
    }
}
