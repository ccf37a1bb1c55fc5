//! Number, size and places of the rolling elements.

use crate::scalar::{WIDEST, math};
use crate::scene::Scene;
use std::f64::consts::TAU;

/// Number, size and places of the elements.
#[derive(Clone, Debug)]
pub(crate) struct ElementSet {
    pub(crate) count: usize,
    /// Whether each touches those beside it.
    pub(crate) touching: bool,
    /// Nominal radius R_b of one, m.
    pub(crate) radius: f64,
    /// How much larger each is, m.
    pub(crate) radius_excess: Vec<f64>,
    /// Radius of the circle of their centres, m.
    pub(crate) pitch_radius: f64,
    /// Angle from which the travel of each element counts, and of its pocket in the cage, rad.
    pub(crate) reference_angles: Vec<f64>,
    /// Their sines and cosines, in columns as long as whole groups of vector instructions need.
    pub(crate) directions: [Vec<f64>; 2],
}

impl ElementSet {
    /// Those of a scene.
    pub(crate) fn new(scene: &Scene) -> Self {
        let count = scene.element_count() as usize;
        let reference_angles: Vec<f64> =
            (0..count).map(|j| scene.initial.first_roller_angle + TAU * j as f64 / count as f64).collect();
        let column = |f: fn(f64) -> f64| {
            let mut column: Vec<f64> = reference_angles.iter().map(|angle| f(*angle)).collect();
            column.resize(count.next_multiple_of(WIDEST), 0.0);
            column
        };
        let directions = [column(math::sin), column(math::cos)];
        let radius_excess =
            scene.radius_deviations().map_or_else(|| vec![0.0; count], |list| list.of_each(count));
        let (radius, pitch_radius) = (scene.element_radius(), scene.pitch_radius());
        let touching = scene.rollers.as_ref().is_some_and(|rollers| rollers.neighbours.is_some());
        Self { count, touching, radius, radius_excess, pitch_radius, reference_angles, directions }
    }
}
