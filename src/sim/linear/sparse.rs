//! The Jacobian of the rates of a state in compressed sparse columns.

use super::jacobian::AnySlopes;
use crate::error::Result;
use crate::model::Model;
use crate::sim::{Sim, wrong_size};

/// Which derivatives can be other than zero, in compressed sparse columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SparsePattern {
    /// Place among the rows where each column begins, and last the number of entries; one more than there are columns.
    pub column_starts: Vec<usize>,
    /// Row of every entry, ascending in each column.
    pub rows: Vec<usize>,
    /// Place of every entry in the order in which they are found; [`NOWHERE`] of what is no entry.
    places: Vec<usize>,
}

const NOWHERE: usize = usize::MAX;

impl SparsePattern {
    fn new(slopes: &AnySlopes, positions: usize) -> Self {
        let states = positions + slopes.over_time().len();
        let mut found = Vec::new();
        slopes.for_each(positions, |place, _| found.push(place.map(|[row, column]| [column, row])));
        let pattern = Self::of(states, &found.iter().copied().flatten().collect::<Vec<_>>());
        let mut next = pattern.places.iter();
        let place_of = |entry: &Option<_>| entry.and_then(|_| next.next().copied()).unwrap_or(NOWHERE);
        Self { places: found.iter().map(place_of).collect(), ..pattern }
    }

    /// Of entries by column and row in any order, each there once.
    fn of(columns: usize, found: &[[usize; 2]]) -> Self {
        let mut order: Vec<usize> = (0..found.len()).collect();
        order.sort_unstable_by_key(|i| found[*i]);
        let mut places = vec![0; found.len()];
        for (place, i) in order.iter().enumerate() {
            places[*i] = place;
        }
        let mut column_starts = vec![0; columns + 1];
        for [column, _] in found {
            column_starts[column + 1] += 1;
        }
        for column in 0..columns {
            column_starts[column + 1] += column_starts[column];
        }
        Self { column_starts, rows: order.iter().map(|i| found[*i][1]).collect(), places }
    }
}

impl Model {
    /// Places of the derivatives that [`Sim::sparse_jacobian`] gives: those that the structure of the bearing allows, whatever
    /// the state.
    pub fn jacobian_pattern(&self) -> SparsePattern {
        SparsePattern::new(&AnySlopes::new(self), self.layout().positions())
    }
}

impl Model {
    /// Which outputs (rows) may change at once with which inputs (columns): direct feed-through, by what outputs are made of, whatever the
    /// state. Loads accelerate bodies and change no output at once.
    pub fn feedthrough_pattern(&self) -> SparsePattern {
        let columns = self.feedthrough();
        let entries =
            columns.iter().enumerate().flat_map(|(input, rows)| rows.iter().map(move |row| [input, *row]));
        SparsePattern::of(columns.len(), &entries.collect::<Vec<_>>())
    }
}

impl Sim {
    /// What [`Sim::jacobian`] gives, in the order of `pattern`, which [`Model::jacobian_pattern`] has made for this model.
    ///
    /// # Errors
    /// As [`Sim::jacobian`]; [`Status::WrongSize`](crate::Status::WrongSize) also where the pattern is that of another model.
    pub fn sparse_jacobian(
        &mut self,
        t: f64,
        state: &[f64],
        pattern: &SparsePattern,
        out: &mut [f64],
    ) -> Result<()> {
        if out.len() != pattern.rows.len() {
            return Err(wrong_size("values", out.len(), pattern.rows.len()));
        }
        let positions = self.model().layout().positions();
        if pattern.column_starts.len() != self.state().len() + 1 {
            return Err(wrong_size("pattern", pattern.column_starts.len() - 1, self.state().len()));
        }
        let slopes = self.slopes_at(t, state)?;
        let mut places = pattern.places.iter();
        let mut write = |place: &usize, value| {
            if let Some(out) = out.get_mut(*place) {
                *out = value;
            }
        };
        places.by_ref().take(positions).for_each(|place| write(place, 1.0));
        for block in slopes.blocks().as_flattened() {
            block.iter().zip(places.by_ref()).for_each(|(value, place)| write(place, *value));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    #[test]
    fn sparse_is_dense_without_its_zeros() {
        for text in [
            include_str!("../../../scenes/nu2310.json"),
            include_str!("../../../scenes/grease_guide.json"),
            include_str!("../../../scenes/full_complement.json"),
            include_str!("../../../scenes/angular_contact_70_cage.json"),
        ] {
            let model = Arc::new(Model::from_json(text).unwrap());
            let pattern = model.jacobian_pattern();
            let mut sim = Sim::new(model).unwrap();
            sim.advance_to(2e-3).unwrap();
            let (t, state) = (sim.time(), sim.state().to_vec());
            let n = state.len();
            let (mut dense, mut values) = (vec![0.0; n * n], vec![f64::NAN; pattern.rows.len()]);
            sim.jacobian(t, &state, &mut dense).unwrap();
            sim.sparse_jacobian(t, &state, &pattern, &mut values).unwrap();
            let mut filled = vec![0.0; n * n];
            for column in 0..n {
                let entries = pattern.column_starts[column]..pattern.column_starts[column + 1];
                assert!(pattern.rows[entries.clone()].is_sorted_by(|a, b| a < b));
                for k in entries {
                    filled[column * n + pattern.rows[k]] = values[k];
                }
            }
            assert_eq!(filled, dense);
            assert!(dense.iter().filter(|x| **x != 0.0).count() <= values.len());
            assert!(sim.sparse_jacobian(t, &state, &pattern, &mut values[1..]).is_err());
        }
    }
}
