//! The fastest vibration of a system at one state, from the derivatives of its accelerations.
//!
//! Power iteration on -da/dq: of all modes the one with the highest frequency survives.

use crate::integrate::linear::Arrowhead;
use crate::integrate::{Linearization, Structure};
use nalgebra::{DVector, SVector};

/// Multiplications by -da/dq. Frequencies of loaded rollers lie close together: any mixture of them will do.
const ITERATIONS: usize = 24;

/// A vibration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mode {
    /// Frequency without damping, rad/s.
    pub frequency: f64,
    /// Damping as a share of critical damping.
    pub damping_ratio: f64,
}

/// Finds the fastest vibration. Memory is taken once.
#[derive(Clone, Debug)]
pub struct ModeFinder<const N: usize> {
    /// Unit of each place of the hub and the spokes; zero where there is no position.
    unit: Vector<N>,
    shape: Vector<N>,
    image: Vector<N>,
    scaled: Vector<N>,
}

/// A vector over the places of an arrowhead.
#[derive(Clone, Debug)]
struct Vector<const N: usize> {
    hub: DVector<f64>,
    spokes: Vec<SVector<f64, N>>,
}

impl<const N: usize> Vector<N> {
    fn dot(&self, other: &Self) -> f64 {
        self.hub.dot(&other.hub) + self.spokes.iter().zip(&other.spokes).map(|(a, b)| a.dot(b)).sum::<f64>()
    }

    /// Every number becomes that of `f` of those at its place in two others.
    fn set(&mut self, a: &Self, b: &Self, f: impl Fn(f64, f64) -> f64) {
        self.hub.zip_zip_apply(&a.hub, &b.hub, |x, a, b| *x = f(a, b));
        for ((x, a), b) in self.spokes.iter_mut().zip(&a.spokes).zip(&b.spokes) {
            *x = a.zip_map(b, &f);
        }
    }
}

impl<const N: usize> ModeFinder<N> {
    /// A finder for systems of this structure with this number of positions, and the unit of each of them.
    pub fn new(structure: &Structure<N>, positions: usize, units: &[f64]) -> Self {
        let Structure { hub, spokes, .. } = structure;
        let positions = &units[..positions.min(units.len())];
        let unit = |i: usize| positions.get(i).copied().unwrap_or(0.0);
        let unit = Vector {
            hub: DVector::from_iterator(hub.len(), hub.iter().map(|i| unit(*i))),
            spokes: spokes.iter().map(|places| SVector::from(places.map(unit))).collect(),
        };
        Self { shape: unit.clone(), image: unit.clone(), scaled: unit.clone(), unit }
    }

    /// The fastest vibration at the state of `slopes`; of frequency zero if nothing pulls back.
    pub fn find(&mut self, slopes: &Linearization<N>) -> Mode {
        self.shape.set(&self.unit, &self.unit, |unit, _| if unit > 0.0 { 1.0 } else { 0.0 });
        let mut square = 0.0;
        for _ in 0..ITERATIONS {
            self.multiply(&slopes.over_positions);
            square = self.image.dot(&self.image).sqrt() / self.shape.dot(&self.shape).sqrt();
            if !(square > 0.0 && square.is_finite()) {
                return Mode::default();
            }
            let scale = 1.0 / self.image.dot(&self.image).sqrt();
            self.shape.set(&self.image, &self.image, |x, _| x * scale);
        }
        self.multiply(&slopes.over_velocities);
        let frequency = square.sqrt();
        Mode { frequency, damping_ratio: self.image.dot(&self.shape) / (2.0 * frequency) }
    }

    /// `image` = -matrix `shape`, both in the units of the positions.
    fn multiply(&mut self, matrix: &Arrowhead<f64, N>) {
        let Self { unit, shape, image, scaled } = self;
        scaled.set(shape, unit, |x, unit| x * unit);
        matrix.multiply(scaled.hub.as_slice(), &scaled.spokes, image.hub.as_mut_slice(), &mut image.spokes);
        let inverse = |unit: f64| if unit > 0.0 { -1.0 / unit } else { 0.0 };
        image.hub.zip_apply(&unit.hub, |x, unit| *x *= inverse(unit));
        for (x, unit) in image.spokes.iter_mut().zip(&unit.spokes) {
            x.zip_apply(unit, |x, unit| *x *= inverse(unit));
        }
    }
}
