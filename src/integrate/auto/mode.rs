//! The fastest vibration of a system at one state, from the derivatives of its accelerations.
//!
//! Power iteration on -da/dq: of all modes the one with the highest frequency survives.

use crate::integrate::linear::{Arrowhead, HUB, SPOKE};
use crate::integrate::{Linearization, Structure};
use nalgebra::SVector;

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
pub struct ModeFinder {
    /// Unit of each place of the hub and the spokes; zero where there is no position.
    hub_unit: SVector<f64, HUB>,
    spoke_units: Vec<SVector<f64, SPOKE>>,
    shape: Vector,
    image: Vector,
}

/// A vector over the places of an arrowhead.
#[derive(Clone, Debug)]
struct Vector {
    hub: SVector<f64, HUB>,
    spokes: Vec<SVector<f64, SPOKE>>,
}

impl Vector {
    fn dot(&self, other: &Self) -> f64 {
        self.hub.dot(&other.hub) + self.spokes.iter().zip(&other.spokes).map(|(a, b)| a.dot(b)).sum::<f64>()
    }
}

impl ModeFinder {
    /// A finder for systems of this structure with this number of positions, and the unit of each of them.
    pub fn new(structure: &Structure, positions: usize, units: &[f64]) -> Self {
        let Structure { hub, spokes } = structure;
        let positions = &units[..positions.min(units.len())];
        let unit = |i: Option<usize>| positions.get(i.unwrap_or(usize::MAX)).copied().unwrap_or(0.0);
        let hub_unit = SVector::from_fn(|k, _| unit(hub[k]));
        let spoke_units: Vec<_> =
            spokes.iter().map(|places| SVector::from_fn(|k, _| unit(Some(places[k])))).collect();
        let zero = Vector { hub: SVector::zeros(), spokes: vec![SVector::zeros(); spokes.len()] };
        Self { hub_unit, spoke_units, shape: zero.clone(), image: zero }
    }

    /// The fastest vibration at the state of `slopes`; of frequency zero if nothing pulls back.
    pub fn find(&mut self, slopes: &Linearization) -> Mode {
        let every = |unit: f64| if unit > 0.0 { 1.0 } else { 0.0 };
        self.shape.hub = self.hub_unit.map(every);
        for (shape, units) in self.shape.spokes.iter_mut().zip(&self.spoke_units) {
            *shape = units.map(every);
        }
        let mut square = 0.0;
        for _ in 0..ITERATIONS {
            self.multiply(&slopes.over_positions);
            square = self.image.dot(&self.image).sqrt() / self.shape.dot(&self.shape).sqrt();
            if !(square > 0.0 && square.is_finite()) {
                return Mode::default();
            }
            let scale = 1.0 / self.image.dot(&self.image).sqrt();
            self.shape.hub = self.image.hub * scale;
            for (shape, image) in self.shape.spokes.iter_mut().zip(&self.image.spokes) {
                *shape = image * scale;
            }
        }
        self.multiply(&slopes.over_velocities);
        let frequency = square.sqrt();
        Mode { frequency, damping_ratio: self.image.dot(&self.shape) / (2.0 * frequency) }
    }

    /// `image` = -matrix `shape`, both in the units of the positions.
    fn multiply(&mut self, matrix: &Arrowhead) {
        let inverse = |unit: f64| if unit > 0.0 { -1.0 / unit } else { 0.0 };
        let hub = self.shape.hub.component_mul(&self.hub_unit);
        let mut hub_image = matrix.hub * hub;
        let own = self.shape.spokes.iter().zip(&self.spoke_units);
        for ((out, (shape, units)), part) in self.image.spokes.iter_mut().zip(own).zip(&matrix.spokes) {
            let x = shape.component_mul(units);
            hub_image += part.to_hub * x;
            *out = (part.own * x + part.from_hub * hub).component_mul(&units.map(inverse));
        }
        self.image.hub = hub_image.component_mul(&self.hub_unit.map(inverse));
    }
}
