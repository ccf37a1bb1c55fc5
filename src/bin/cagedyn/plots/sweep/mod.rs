//! Pictures of sweeps.

pub(super) mod colours;
mod lines;
mod maps;
mod waterfall;

pub use lines::{Curves, Mark, lines};
pub use maps::{Cell, Map, maps};
pub use waterfall::{Column, Spectra, waterfall};

use super::axis::Axis;
use super::units::unit;
use std::f64::consts::TAU;

/// Axes over more than this many powers of ten have a tick at each of them only.
const LONG: f64 = 3.0;

/// What is said of means over runs that are too short for them.
const SHORT: &str = "; some runs have fewer than three turns of the cage";

/// The axis of a varied value.
pub struct Abscissa {
    name: String,
    logarithmic: bool,
    /// What the axis shows of a value of one.
    factor: f64,
    /// The values, in order, each once, as the axis has them.
    places: Vec<f64>,
}

impl Abscissa {
    /// Of values at a path of the scene; with their logarithms where they should be and there are any. Speeds are in 1/min; where no
    /// value is positive, which only tells a sense, they are shown without sign.
    pub fn of_path(path: &str, logarithmic: bool, values: &[f64]) -> Self {
        let negative = values.iter().all(|x| *x <= 0.0) && values.iter().any(|x| *x < 0.0);
        let name = if negative { format!("|{path}|") } else { path.to_owned() };
        let sign = if negative { -1.0 } else { 1.0 };
        let (unit, factor) = match unit(path) {
            Some("rad/s") => (" [1/min]".to_owned(), 60.0 / TAU),
            Some("K") => (" [K]; 0 \u{b0}C is 273.15 K".to_owned(), 1.0),
            Some(unit) => (format!(" [{unit}]"), 1.0),
            None => (String::new(), 1.0),
        };
        Self::new(&(name + &unit), logarithmic, sign * factor, values)
    }

    fn new(name: &str, logarithmic: bool, factor: f64, values: &[f64]) -> Self {
        let logarithmic = logarithmic && values.iter().all(|x| factor * x > 0.0);
        let mut axis = Self { name: name.to_owned(), logarithmic, factor, places: Vec::new() };
        axis.places = values.iter().map(|x| axis.place(*x)).collect();
        axis.places.sort_by(f64::total_cmp);
        axis.places.dedup();
        axis
    }

    /// Of speeds in 1/min; with their logarithms where low ones would lie on each other.
    pub fn of_speeds(name: &str, speeds: &[f64]) -> Self {
        Self::new(name, super::is_long(speeds), 1.0, speeds)
    }

    /// Where a value is.
    pub fn place(&self, x: f64) -> f64 {
        let x = self.factor * x;
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
    pub fn covering(&self, ticks: usize) -> Axis {
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
        let plain = Abscissa::new("x", false, 1.0, &[3.0, 1.0, 1.0, 2.0]);
        assert_eq!((plain.places.len(), plain.edges()), (3, vec![0.5, 1.5, 2.5, 3.5]));
        let powers = Abscissa::new("x", true, 1.0, &[1.0, 1000.0]);
        assert_eq!(powers.edges(), [-1.5, 1.5, 4.5]);
        assert!(!Abscissa::new("x", true, 1.0, &[-1.0, -10.0]).logarithmic);
    }

    #[test]
    fn speeds_are_in_revolutions_per_minute_and_larger_ones_to_the_right() {
        let speeds = [-100.0, -400.0, -200.0].map(|n| n * TAU / 60.0);
        let axis = Abscissa::of_path("inner_ring.speed.constant", true, &speeds);
        assert_eq!(axis.name, "|inner_ring.speed.constant| [1/min]");
        assert!(axis.logarithmic && (axis.place(speeds[1]) - 400f64.log10()).abs() < 1e-12);
        let load = Abscissa::of_path("inner_ring.motion.free.load.z.constant", false, &[-980.0, 0.0]);
        assert_eq!(
            (load.name.as_str(), load.place(-980.0)),
            ("|inner_ring.motion.free.load.z.constant| [N]", 980.0)
        );
        let both = Abscissa::of_path("inner_ring.motion.free.load.z.constant", false, &[-980.0, 980.0]);
        assert_eq!(
            (both.name.as_str(), both.place(-980.0)),
            ("inner_ring.motion.free.load.z.constant [N]", -980.0)
        );
    }
}
