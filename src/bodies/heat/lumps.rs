//! Lumps whose temperature is a state of the motion; all others keep that of the start.
//!
//! ```text
//! C_k T_k' = P_k + heat from the other lumps,   P_k = -Sum share power + friction of the bearing
//! ```
//!
//! With an own time, C_k is that time times all that conducts from the lump, so that the bearing is warm within a run; where
//! temperatures stay does not change. Derivatives are those of the conductances at the start; the catalogue friction hardly changes with
//! temperature, and is that of the speed at the start.

use super::HeatBudget;
use crate::bodies::{Node, NodeState};
use crate::scene::Scene;
use nalgebra::DMatrixViewMut;

/// What counts as a unit of error, K.
const ERROR_UNIT: f64 = 1.0;

/// The lumps of a scene that move with it.
#[derive(Debug)]
pub(crate) struct Lumps {
    budget: HeatBudget,
    /// Their places among all lumps.
    moving: Vec<usize>,
    /// Place among these of every lump.
    place: Vec<Option<usize>>,
    /// 1/C, K/J.
    inverse_capacities: Vec<f64>,
    /// What conducts between them, and from each to everything in the diagonal, W/K.
    conductances: Vec<f64>,
    speed: f64,
    states: Vec<NodeState>,
}

impl Lumps {
    /// Those of a checked scene; `None` where there are none.
    pub(crate) fn of(scene: &Scene) -> Option<Self> {
        let heat = scene.heat.as_ref().filter(|heat| !heat.in_motion.is_empty())?;
        let speed = scene.inner_ring.as_ref().map_or(0.0, |ring| ring.speed.at(0.0));
        let budget = HeatBudget::of(scene, speed)?;
        let moving: Vec<usize> = heat.in_motion.iter().filter_map(|name| heat.node(name)).collect();
        let viscosity = budget.viscosity(|i| budget.start[i]);
        let conductance = |i: &usize, k: &usize| budget.network.between(*i, *k, viscosity);
        let capacity = |i: &usize| match heat.own_time {
            Some(time) => time * conductance(i, i),
            None => budget.network.capacities[*i],
        };
        let states = moving.iter().map(|i| NodeState {
            name: heat.nodes[*i].name.clone(),
            unit: "K",
            description: "temperature of a lump of the heat balance",
            error_unit: ERROR_UNIT,
            start: budget.start[*i],
        });
        Some(Self {
            place: (0..heat.nodes.len()).map(|i| moving.iter().position(|moving| *moving == i)).collect(),
            inverse_capacities: moving.iter().map(|i| 1.0 / capacity(i)).collect(),
            conductances: moving.iter().flat_map(|i| moving.iter().map(move |k| conductance(i, k))).collect(),
            states: states.collect(),
            speed,
            moving,
            budget,
        })
    }
}

impl Node for Lumps {
    fn name(&self) -> &'static str {
        "temperature"
    }

    fn states(&self) -> &[NodeState] {
        &self.states
    }

    fn rates(&self, x: &[f64], powers: &[f64], out: &mut [f64]) {
        let Self { budget, moving, place, inverse_capacities, .. } = self;
        let temperature = |i: usize| place[i].map_or(budget.start[i], |k| x[k]);
        let viscosity = budget.viscosity(temperature);
        for (out, i) in out.iter_mut().zip(moving) {
            *out = budget.network.gained(*i, viscosity, temperature);
        }
        for (power, node, share) in &budget.sources {
            if let Some(k) = place[*node] {
                out[k] -= share * powers[*power as usize];
            }
        }
        if let Some(friction) = &budget.friction {
            friction.heat(self.speed, temperature, |node, heat| {
                if let Some(k) = place[node] {
                    out[k] += heat;
                }
            });
        }
        out.iter_mut().zip(inverse_capacities).for_each(|(out, inverse)| *out *= inverse);
    }

    fn add_slopes(&self, _: &[f64], mut out: DMatrixViewMut<'_, f64>) {
        let n = self.moving.len();
        for i in 0..n {
            for k in 0..n {
                let sign = if i == k { -1.0 } else { 1.0 };
                out[(i, k)] += sign * self.conductances[i * n + k] * self.inverse_capacities[i];
            }
        }
    }

    fn lubricant(&self) -> Option<usize> {
        self.place[self.budget.lubricant]
    }
}
