//! Lumps of one temperature each and what flows between them.
//!
//! ```text
//! C_k T_k' = P_k + Sum_l G_kl (T_l - T_k) + G_ka (T_a - T_k) + V rho c (T_in - T_k)
//! G = A h   of a surface in oil,   h = 0.0986 sqrt((n/nu)(1 + D cos a/d_m)) k Pr^(1/3),   Pr = nu rho c/k
//! ```
//!
//! P heat made in a lump, G conductances, T_a of the surroundings, V the flow of an oil that enters at T_in. Of a surface that a
//! bearing of pitch diameter d_m with elements of diameter D splashes at the speed n (1/min): nu kinematic viscosity, k
//! conductivity. The conductance falls as nu^(-1/6), so the network is solved at a given viscosity.
//! Source: Harris, Rolling Bearing Analysis, for the surface in oil.

use crate::error::{Error, Result, Status};
use crate::scalar::math;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// What conducts between two lumps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Conducts {
    /// So well, W/K.
    Constant(f64),
    /// So well at a kinematic viscosity of 1 m^2/s, W/K: a surface in oil.
    Splashed(f64),
}

/// Two lumps, `None` for the surroundings, and what conducts between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Both.
    pub ends: [Option<usize>; 2],
    /// How well.
    pub conducts: Conducts,
}

/// What flows through a lump and is mixed there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inflow {
    /// The lump.
    pub node: usize,
    /// Heat that it carries, W/K.
    pub conductance: f64,
    /// Temperature at which it enters, K.
    pub temperature: f64,
}

/// Lumps and links.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatNetwork {
    /// Heat capacities, J/K.
    pub capacities: Vec<f64>,
    /// Links.
    pub links: Vec<Link>,
    /// Flows through lumps.
    pub inflows: Vec<Inflow>,
    /// Temperature of the surroundings, K.
    pub ambient: f64,
}

impl Conducts {
    /// A surface of `area` (m^2) that is splashed at the speed of the inner ring (rad/s) in a bearing with this D cos a/d_m, by an oil
    /// of this conductivity (W/(m K)) and heat capacity (J/(m^3 K)).
    pub fn splashed(area: f64, speed: f64, ratio: f64, [conductivity, capacity]: [f64; 2]) -> Self {
        let turns = speed.abs() / TAU * 60.0;
        // With nu = 1 in both the speed and the Prandtl number.
        let prandtl = math::exp(math::ln(capacity / conductivity) / 3.0);
        Self::Splashed(area * 0.0986 * (turns * (1.0 + ratio)).sqrt() * conductivity * prandtl)
    }

    /// G at a kinematic viscosity in m^2/s, W/K.
    pub fn at(&self, viscosity: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Splashed(value) => value * math::exp(math::ln(viscosity) / -6.0),
        }
    }
}

impl HeatNetwork {
    /// Heat that flows into a lump from others at these temperatures (K), W.
    pub fn gained(&self, node: usize, viscosity: f64, temperature: impl Fn(usize) -> f64) -> f64 {
        let own = temperature(node);
        let other = |end: Option<usize>| end.map_or(self.ambient, &temperature);
        let of_links = self.links.iter().map(|link| match link.ends {
            [Some(a), b] if a == node => link.conducts.at(viscosity) * (other(b) - own),
            [a, Some(b)] if b == node => link.conducts.at(viscosity) * (other(a) - own),
            _ => 0.0,
        });
        let of_flows = self.inflows.iter().filter(|flow| flow.node == node);
        of_links.sum::<f64>() + of_flows.map(|flow| flow.conductance * (flow.temperature - own)).sum::<f64>()
    }

    /// Sum of all that conducts between these two lumps; with itself, from one to everything, W/K.
    pub fn between(&self, a: usize, b: usize, viscosity: f64) -> f64 {
        let joins = |link: &&Link| {
            let has = |node: usize| link.ends.contains(&Some(node));
            has(a) && has(b)
        };
        let links: f64 = self.links.iter().filter(joins).map(|link| link.conducts.at(viscosity)).sum();
        let flows = self.inflows.iter().filter(|flow| a == b && flow.node == a);
        links + flows.map(|flow| flow.conductance).sum::<f64>()
    }

    /// G T = P + G_a T_a as a matrix and what the surroundings give.
    fn system(&self, viscosity: f64) -> (DMatrix<f64>, DVector<f64>) {
        let n = self.capacities.len();
        let (mut matrix, mut right) = (DMatrix::zeros(n, n), DVector::zeros(n));
        for Link { ends: [a, b], conducts } in &self.links {
            let conductance = conducts.at(viscosity);
            for (own, other) in [(a, b), (b, a)] {
                let Some(own) = *own else { continue };
                matrix[(own, own)] += conductance;
                match other {
                    Some(other) => matrix[(own, *other)] -= conductance,
                    None => right[own] += conductance * self.ambient,
                }
            }
        }
        for flow in &self.inflows {
            matrix[(flow.node, flow.node)] += flow.conductance;
            right[flow.node] += flow.conductance * flow.temperature;
        }
        (matrix, right)
    }

    /// Temperatures at which these powers (W) stay in balance, with an oil of this kinematic viscosity (m^2/s), K.
    ///
    /// # Errors
    /// [`Status::BadScene`] where nothing holds a temperature.
    pub fn steady(&self, powers: &[f64], viscosity: f64) -> Result<Vec<f64>> {
        let (matrix, right) = self.system(viscosity);
        solve(matrix, right + DVector::from_column_slice(powers))
    }

    /// Moves the temperatures on by `step` (s) under these powers (W): one implicit step.
    ///
    /// # Errors
    /// As [`HeatNetwork::steady`].
    pub fn step(&self, powers: &[f64], viscosity: f64, step: f64, temperatures: &mut [f64]) -> Result<()> {
        let (mut matrix, mut right) = self.system(viscosity);
        right += DVector::from_column_slice(powers);
        for (i, (capacity, now)) in self.capacities.iter().zip(&*temperatures).enumerate() {
            matrix[(i, i)] += capacity / step;
            right[i] += capacity / step * now;
        }
        temperatures.copy_from_slice(&solve(matrix, right)?);
        Ok(())
    }

    /// Heat through every link, from its first end to its second, W.
    pub fn flows(&self, temperatures: &[f64], viscosity: f64) -> Vec<f64> {
        let at = |end: Option<usize>| end.map_or(self.ambient, |place| temperatures[place]);
        self.links
            .iter()
            .map(|link| link.conducts.at(viscosity) * (at(link.ends[0]) - at(link.ends[1])))
            .collect()
    }

    /// Heat that what flows through carries away, W.
    pub fn carried(&self, temperatures: &[f64]) -> f64 {
        self.inflows.iter().map(|flow| flow.conductance * (temperatures[flow.node] - flow.temperature)).sum()
    }
}

fn solve(matrix: DMatrix<f64>, right: DVector<f64>) -> Result<Vec<f64>> {
    let solved = matrix.lu().solve(&right).filter(|x| x.iter().all(|x| x.is_finite()));
    let text = "heat: the network has no temperatures; does every lump reach the surroundings?";
    solved.map(|x| x.as_slice().to_vec()).ok_or_else(|| Error::new(Status::BadScene, text.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn network() -> HeatNetwork {
        let link = |a, b, g| Link { ends: [a, b], conducts: Conducts::Constant(g) };
        let splashed = Conducts::splashed(0.02, 314.16, 0.19, [0.13, 1.67e6]);
        HeatNetwork {
            capacities: vec![10.0, 200.0],
            links: vec![Link { ends: [Some(0), Some(1)], conducts: splashed }, link(Some(1), None, 2.0)],
            inflows: vec![Inflow { node: 0, conductance: 1.5, temperature: 310.0 }],
            ambient: 300.0,
        }
    }

    #[test]
    fn a_splashed_surface_conducts_by_the_formula() {
        // 3000 1/min, nu 3e-5 m^2/s, Pr = 3e-5 * 1.67e6/0.13 = 385.
        let h = 0.0986 * (3000.0 / 3e-5 * 1.19f64).sqrt() * 0.13 * 385.385f64.powf(1.0 / 3.0);
        let found = Conducts::splashed(1.0, TAU * 50.0, 0.19, [0.13, 1.67e6]).at(3e-5);
        assert!((found / h - 1.0).abs() < 1e-6, "{found} {h}");
    }

    #[test]
    fn steady_temperatures_keep_every_balance_and_steps_lead_there() {
        let (network, powers, nu) = (network(), [30.0, 5.0], 2e-5);
        let steady = network.steady(&powers, nu).unwrap();
        for (node, power) in powers.iter().enumerate() {
            let into = network.gained(node, nu, |i| steady[i]);
            assert!((into + power).abs() < 1e-10, "{node}: {into}");
        }
        let out = network.carried(&steady) + network.flows(&steady, nu)[1];
        assert!((out - 35.0).abs() < 1e-10);
        let mut temperatures = vec![300.0; 2];
        for _ in 0..100 {
            network.step(&powers, nu, 50.0, &mut temperatures).unwrap();
        }
        assert!(temperatures.iter().zip(&steady).all(|(a, b)| (a - b).abs() < 1e-6));
    }

    #[test]
    fn what_conducts_is_the_derivative_of_what_flows() {
        let (network, nu) = (network(), 2e-5);
        let at = |t: [f64; 2], node: usize| network.gained(node, nu, |i| t[i]);
        for node in 0..2 {
            for over in 0..2 {
                let mut t = [320.0, 310.0];
                let before = at(t, node);
                t[over] += 1.0;
                let sign = if node == over { -1.0 } else { 1.0 };
                let slope = sign * network.between(node, over, nu);
                assert!((at(t, node) - before - slope).abs() < 1e-9, "{node} {over}");
            }
        }
    }
}
