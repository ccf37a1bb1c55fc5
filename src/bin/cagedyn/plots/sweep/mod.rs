//! Pictures of sweeps.

mod colours;
mod lines;
mod maps;
mod waterfall;

pub use lines::{Curves, Mark, lines};
pub use maps::{Cell, Map, maps};
pub use waterfall::{Column, Spectra, waterfall};

use super::axis::Axis;
use super::units::with_unit;

/// Axes over more than this many powers of ten have a tick at each of them only.
const LONG: f64 = 3.0;

/// The axis of a varied value.
pub struct Abscissa {
    name: String,
    logarithmic: bool,
    /// The values, in order, each once, as the axis has them.
    places: Vec<f64>,
}

impl Abscissa {
    /// Of values at a path of the scene; with their logarithms where they should be and there are any.
    pub fn of_path(path: &str, logarithmic: bool, values: &[f64]) -> Self {
        Self::new(&with_unit(path), logarithmic, values)
    }

    fn new(name: &str, logarithmic: bool, values: &[f64]) -> Self {
        let logarithmic = logarithmic && values.iter().all(|x| *x > 0.0);
        let mut axis = Self { name: name.to_owned(), logarithmic, places: Vec::new() };
        axis.places = values.iter().map(|x| axis.place(*x)).collect();
        axis.places.sort_by(f64::total_cmp);
        axis.places.dedup();
        axis
    }

    /// Of speeds in 1/min; with their logarithms where low ones would lie on each other.
    pub fn of_speeds(name: &str, speeds: &[f64]) -> Self {
        Self::new(name, super::is_long(speeds), speeds)
    }

    /// Where a value is.
    fn place(&self, x: f64) -> f64 {
        if self.logarithmic { x.log10() } else { x }
    }

    /// Edges of the cells around the values.
    fn edges(&self) -> Vec<f64> {
        let middle = |pair: &[f64]| 0.5 * (pair[0] + pair[1]);
        let (Some(first), Some(last)) = (self.places.first(), self.places.last()) else {
            return vec![0.0, 1.0];
        };
        let mut edges: Vec<f64> = self.places.windows(2).map(middle).collect();
        let [begin, end] = [edges.first(), edges.last()].map(|edge| edge.copied());
        edges.insert(0, 2.0 * first - begin.unwrap_or(first + 0.5));
        edges.push(2.0 * last - end.unwrap_or(last - 0.5));
        edges
    }

    /// The axis from one number to another with about so many ticks.
    fn axis(&self, (min, max): (f64, f64), ticks: usize) -> Axis {
        match self.logarithmic {
            true if max - min > LONG => Axis::powers_of_ten(&self.name, min, max),
            true => Axis::logarithms(&self.name, min, max),
            false => Axis::new(&self.name, min, max, ticks).narrow(),
        }
    }

    /// The same with its ticks at the values, or at some of them where there are more than `most`.
    fn axis_of_cells(&self, ends: (f64, f64), most: usize) -> Axis {
        self.axis(ends, most).at(&self.places, most, self.logarithmic)
    }

    /// The axis over all values with some room.
    fn covering(&self, ticks: usize) -> Axis {
        let Axis { min, max, .. } = Axis::covering("", self.places.iter().copied(), ticks);
        self.axis((min, max), ticks)
    }
}

/// The edges around a place.
fn span(edges: &[f64], place: f64) -> [f64; 2] {
    let above = edges.partition_point(|edge| *edge < place).clamp(1, edges.len() - 1);
    [edges[above - 1], edges[above]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_lie_around_their_values() {
        let plain = Abscissa::new("x", false, &[3.0, 1.0, 1.0, 2.0]);
        assert_eq!((plain.places.len(), plain.edges()), (3, vec![0.5, 1.5, 2.5, 3.5]));
        let powers = Abscissa::new("x", true, &[1.0, 1000.0]);
        assert_eq!(powers.edges(), [-1.5, 1.5, 4.5]);
        assert!(!Abscissa::new("x", true, &[-1.0, -10.0]).logarithmic);
    }
}
