//! Exact derivatives of the accelerations with respect to positions and velocities, by dual numbers through the same
//! kinematics and laws that give the forces.
//!
//! Each contact is differentiated on its own: its law over what the law sees (approach, approach speed, surface
//! speeds, share of edge friction), by the batch; its kinematics over the coordinates of its two bodies, one by one, by its
//! pair, and both chained. The sums keep the structure of the bearing: shared bodies are coupled to every element, elements
//! to nothing else.

use super::workspace::Workspace;
use super::{Input, InputValues, Model};
use crate::bodies::{IN_HUB, SharedBody, scale_rows};
use crate::integrate::linear::HUB;
use crate::integrate::{Linearization, Structure};
use crate::pairs::SlopeSums;
use nalgebra::{Matrix3, Matrix5, Vector5};

impl Model {
    /// Which velocities are coupled: shared bodies are the hub, rollers the spokes.
    #[doc(hidden)]
    pub fn structure(&self) -> Structure {
        self.layout.structure()
    }

    /// Derivatives of the accelerations at the last evaluated state of `ws`, while the inputs change at `rates` (see
    /// [`Model::input_rates_at`]).
    ///
    /// # Panics
    /// When `ws` or `out` was made for another model.
    #[doc(hidden)]
    pub fn linearize(&self, ws: &mut Workspace, rates: &InputValues, out: &mut Linearization) {
        out.clear();
        for batch in &mut ws.contacts.batches {
            batch.differentiate(ws.fluid.ln_viscosity, ws.motions.instructions);
        }
        let ws = &*ws;
        let mut sums = SlopeSums {
            layout: &self.layout,
            rates,
            ln_viscosity_rate: self.ln_viscosity_rate(ws, rates),
            hub_over_time: Vector5::zeros(),
            out,
        };
        for (place, pair) in self.pairs.iter().enumerate() {
            let (batch, contacts) = ws.contacts.range(place);
            pair.add_slopes(batch, contacts, &ws.motions, &mut sums);
        }
        if let Some(guide) = &self.guide {
            guide.add_slopes(&ws.motions, ws.fluid, &mut sums);
        }
        for (at, body) in IN_HUB.into_iter().zip(&self.shared) {
            // External loads change by themselves.
            let Some(body) = body else { continue };
            for (k, input) in body.load_inputs().into_iter().enumerate().filter(|(k, _)| at + k < HUB) {
                sums.hub_over_time[at + k] += input.map_or(0.0, |input| rates.of(input));
            }
        }
        let over_time = sums.hub_over_time;
        self.divide_by_inertias(ws, &over_time, out);
    }

    /// The shared bodies that move freely: place, body, first place in the hub.
    fn free_bodies(&self) -> impl Iterator<Item = (usize, &dyn SharedBody, usize)> {
        let bodies = self.shared.iter().zip(IN_HUB).enumerate();
        bodies.filter_map(|(place, (body, at))| {
            let body = body.as_deref().filter(|_| self.layout.shared(place).is_some())?;
            Some((place, body, at))
        })
    }

    /// Rate of the logarithm of the viscosity, 1/s.
    fn ln_viscosity_rate(&self, ws: &Workspace, rates: &InputValues) -> f64 {
        let warming = rates.of(Input::Temperature);
        match &self.inputs.oil {
            Some(oil) if warming != 0.0 => oil.law.relative_slope(ws.inputs.of(Input::Temperature)) * warming,
            _ => 0.0,
        }
    }

    /// From forces to accelerations, with the terms that are no contact forces.
    fn divide_by_inertias(&self, ws: &Workspace, hub_over_time: &Vector5<f64>, out: &mut Linearization) {
        let mut inverse = Matrix5::zeros();
        let mut balanced = true;
        for (place, body, at) in self.free_bodies() {
            let n = body.coordinates().len();
            for k in 0..2 {
                out.over_velocities.hub[(at + k, at + k)] -= body.support_damping();
            }
            let corner = body.accelerations_of(&Matrix3::identity(), ws.motions.shared[place].angle);
            add_corner(&mut inverse, &corner, at, n);
            balanced &= body.is_balanced();
        }
        let diagonal = inverse.diagonal().data.0[0];
        for part in [&mut out.over_positions, &mut out.over_velocities] {
            part.hub = inverse * part.hub;
            for spoke in &mut part.spokes {
                if balanced {
                    scale_rows(&mut spoke.to_hub.data.0, &diagonal);
                } else {
                    spoke.to_hub = inverse * spoke.to_hub;
                }
            }
        }
        let rate = inverse * hub_over_time;
        for (index, rate) in self.layout.hub().into_iter().zip(rate.iter()) {
            if let Some(index) = index {
                out.over_time[index] += rate;
            }
        }
        self.add_inertial_slopes(ws, out);
        for (j, on_element) in ws.on_elements.iter().enumerate() {
            let element = ws.motions.element(j);
            let (k, d) = (&mut out.over_positions.spokes[j], &mut out.over_velocities.spokes[j]);
            let inverse = self.elements.slopes(&element, on_element, self.gravity, k, d);
            for (place, factor) in self.layout.of_element(j).into_iter().zip(inverse) {
                out.over_time[place] *= factor;
            }
        }
    }

    /// How the accelerations of shared bodies change with their own motion at given forces.
    fn add_inertial_slopes(&self, ws: &Workspace, out: &mut Linearization) {
        for (place, body, at) in self.free_bodies().filter(|(_, body, _)| !body.is_balanced()) {
            let n = body.coordinates().len();
            let (mut k, mut d) = (Matrix3::zeros(), Matrix3::zeros());
            body.add_inertial_slopes(&ws.on_shared[place], &ws.motions.shared[place], &mut k, &mut d);
            for (part, own) in [(&mut out.over_positions, k), (&mut out.over_velocities, d)] {
                add_corner(&mut part.hub, &own, at, n);
            }
        }
    }
}

/// Adds the first `n` rows and columns of a matrix to those of the hub that begin at `at`.
fn add_corner(hub: &mut Matrix5<f64>, own: &Matrix3<f64>, at: usize, n: usize) {
    for (sums, column) in hub.data.0[at..at + n].iter_mut().zip(&own.data.0) {
        for (sum, x) in sums[at..at + n].iter_mut().zip(column) {
            *sum += x;
        }
    }
}
