//! The network of lumps: temperatures that powers lead to, at once or over a time.

use crate::error::{Error, Result, Status};
use crate::laws::bearing_torque::ball_conductance;
use crate::scene::{Conductance, Heat, Scene};
use nalgebra::{DMatrix, DVector};

/// Lumps and links.
#[derive(Clone, Debug)]
pub(super) struct Network {
    capacities: Vec<f64>,
    /// Ends of the links, `None` for the surroundings, and conductances, W/K.
    links: Vec<([Option<usize>; 2], f64)>,
    ambient: f64,
}

impl Network {
    /// That of a checked scene at this speed of the inner ring, rad/s.
    pub(super) fn new(heat: &Heat, scene: &Scene, speed: f64) -> Self {
        let (count, diameter) = (scene.element_count() as usize, 2.0 * scene.element_radius());
        let balls = ball_conductance(count, diameter, 2.0 * scene.pitch_radius(), speed);
        let links = heat.links.iter().map(|link| {
            let conductance = match link.conductance {
                Conductance::Constant(value) => value,
                Conductance::Balls(factor) => factor * balls,
            };
            (link.between.each_ref().map(|name| heat.node(name)), conductance)
        });
        Self {
            capacities: heat.nodes.iter().map(|node| node.capacity).collect(),
            links: links.collect(),
            ambient: heat.ambient,
        }
    }

    /// G T = P + G_a T_a as a matrix and what the surroundings give.
    fn system(&self) -> (DMatrix<f64>, DVector<f64>) {
        let n = self.capacities.len();
        let (mut matrix, mut right) = (DMatrix::zeros(n, n), DVector::zeros(n));
        for ([a, b], conductance) in &self.links {
            for (own, other) in [(a, b), (b, a)] {
                let Some(own) = *own else { continue };
                matrix[(own, own)] += conductance;
                match other {
                    Some(other) => matrix[(own, *other)] -= conductance,
                    None => right[own] += conductance * self.ambient,
                }
            }
        }
        (matrix, right)
    }

    /// Temperatures at which these powers (W) stay in balance, K.
    pub(super) fn steady(&self, powers: &[f64]) -> Result<Vec<f64>> {
        let (matrix, right) = self.system();
        solve(matrix, right + DVector::from_column_slice(powers))
    }

    /// Moves the temperatures on by `step` (s) under these powers (W): one implicit step.
    pub(super) fn step(&self, powers: &[f64], step: f64, temperatures: &mut [f64]) -> Result<()> {
        let (mut matrix, mut right) = self.system();
        right += DVector::from_column_slice(powers);
        for (i, (capacity, now)) in self.capacities.iter().zip(&*temperatures).enumerate() {
            matrix[(i, i)] += capacity / step;
            right[i] += capacity / step * now;
        }
        temperatures.copy_from_slice(&solve(matrix, right)?);
        Ok(())
    }

    /// Heat through every link, from its first end to its second, W.
    pub(super) fn flows(&self, temperatures: &[f64]) -> Vec<f64> {
        let at = |end: Option<usize>| end.map_or(self.ambient, |place| temperatures[place]);
        self.links.iter().map(|([a, b], conductance)| conductance * (at(*a) - at(*b))).collect()
    }
}

fn solve(matrix: DMatrix<f64>, right: DVector<f64>) -> Result<Vec<f64>> {
    let solved = matrix.lu().solve(&right).filter(|x| x.iter().all(|x| x.is_finite()));
    let text = "heat: the network has no temperatures; does every lump reach the surroundings?";
    solved.map(|x| x.as_slice().to_vec()).ok_or_else(|| Error::new(Status::BadState, text.to_owned()))
}
