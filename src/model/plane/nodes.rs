//! States that are no motion: their rates from the powers of the last evaluated state, and what methods ask of them.

use super::{Input, InputValues, Plane, Workspace};
use crate::bodies::{Damping, Fault, Node, OF_ELEMENT};
use crate::integrate::Linearization;
use crate::scene::TEMPERATURE;
use std::ops::Range;

impl Plane {
    /// The nodes, with their states in `v`.
    pub(super) fn nodes_in(&self) -> impl Iterator<Item = (&dyn Node, Range<usize>)> {
        self.nodes.iter().map(|node| &**node).zip(self.layout.nodes())
    }

    /// Gives inputs at velocities `v` the temperature of the lubricant's lump, where that is a state.
    #[inline]
    pub(super) fn set_lumps(&self, v: &[f64], inputs: &mut InputValues) {
        if let Some(place) = self.lubricant {
            inputs.values[Input::Temperature as usize] = v[place];
        }
    }

    /// Whether the lubricant has a viscosity at the temperature that these velocities give it, where that is a state: one that
    /// a scene may give, at which its law has one.
    ///
    /// # Errors
    /// [`Fault::NoViscosity`].
    #[inline]
    pub(crate) fn admit(&self, v: &[f64]) -> Result<(), Fault> {
        let (Some(place), Some(oil)) = (self.lubricant, &self.inputs.oil) else { return Ok(()) };
        let temperature = v[place];
        let known = (TEMPERATURE.min..=TEMPERATURE.max).contains(&temperature);
        let gone = !known || oil.fluid_at(temperature).relative_viscosity.is_nan();
        if gone { Err(Fault::NoViscosity { temperature }) } else { Ok(()) }
    }

    /// Sets their values at the start of a run.
    pub(super) fn start_nodes(&self, v: &mut [f64]) {
        for (node, at) in self.nodes_in() {
            v[at].iter_mut().zip(node.states()).for_each(|(x, state)| *x = state.start);
        }
    }

    /// Writes their rates at the last evaluated state, whose velocities are `v`, into the accelerations `a`.
    #[inline]
    pub(super) fn find_node_rates(&self, v: &[f64], ws: &mut Workspace, a: &mut [f64]) {
        if self.nodes.is_empty() {
            return;
        }
        let mut powers = std::mem::take(&mut ws.powers);
        self.powers(v, None, ws, &mut powers);
        ws.powers = powers;
        let first = v.len() - ws.nodes.len();
        ws.nodes.copy_from_slice(&v[first..]);
        for (node, at) in self.nodes_in() {
            node.rates(&v[at.clone()], &ws.powers, &mut a[at]);
        }
    }

    /// Adds the derivatives of their rates at the last evaluated state.
    pub(super) fn add_node_slopes(&self, ws: &Workspace, out: &mut Linearization<OF_ELEMENT>) {
        let of_shared = self.layout.of_shared();
        for (node, at) in self.nodes_in() {
            let (place, n) = (self.layout.in_hub(at.start), at.len());
            let x = &ws.nodes[place - of_shared..][..n];
            node.add_slopes(x, out.over_velocities.hub.view_mut((place, place), (n, n)));
        }
    }

    /// How their rates oppose their own values, for a step of size `h` (s).
    pub(super) fn node_damping(&self, h: f64, ws: &Workspace, out: &mut Damping) {
        let (of_shared, first) = (self.layout.of_shared(), self.layout.free().count());
        for ((node, at), block) in self.nodes_in().zip(&mut out.bodies[first..]) {
            let (full, n) = (&mut block.full, at.len());
            let place = self.layout.in_hub(at.start) - of_shared;
            full.fill(0.0);
            node.add_slopes(&ws.nodes[place..][..n], full.as_view_mut());
            full.neg_mut();
            block.split(h, 1.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::{NodeState, Power, layout_of};
    use crate::model::Model;
    use crate::{Scene, Sim};
    use nalgebra::DMatrixViewMut;
    use std::sync::Arc;

    /// The layer of a greased guide as two lumps: it is heated by what its film takes and cooled by a ring of constant
    /// temperature, and warms a second one.
    #[derive(Debug)]
    struct Layer([NodeState; 2]);

    const CAPACITIES: [f64; 2] = [1e-4, 3e-4];
    const CONDUCTANCE: f64 = 0.02;
    const AROUND: f64 = 300.0;
    /// End of the runs, s: before impacts drive the motions of the methods apart.
    const END: f64 = 12e-3;

    fn temperature(name: &str) -> NodeState {
        let (unit, description) = ("K", "temperature");
        NodeState { name: name.to_owned(), unit, description, error_unit: 1.0, start: AROUND }
    }

    impl Node for Layer {
        fn name(&self) -> &'static str {
            "layer"
        }

        fn states(&self) -> &[NodeState] {
            &self.0
        }

        fn rates(&self, x: &[f64], powers: &[f64], out: &mut [f64]) {
            let through = CONDUCTANCE * (x[0] - x[1]);
            let heat = -powers[Power::GuideFilm as usize];
            out[0] = (heat - through) / CAPACITIES[0];
            out[1] = (through - CONDUCTANCE * (x[1] - AROUND)) / CAPACITIES[1];
        }

        fn add_slopes(&self, _: &[f64], mut out: DMatrixViewMut<'_, f64>) {
            let [film, wall] = CAPACITIES.map(|c| CONDUCTANCE / c);
            out[(0, 0)] -= film;
            out[(0, 1)] += film;
            out[(1, 0)] += wall;
            out[(1, 1)] -= 2.0 * wall;
        }
    }

    /// A simulation of the greased guide with the layer.
    fn greased_guide(method: &str) -> Sim {
        let text = include_str!("../../../scenes/grease_guide.json");
        let solver = format!(r#"{{"method": {method}}}"#);
        let mut model =
            Model::new(Scene::from_json_with(text, [("solver", solver.as_str())]).unwrap()).unwrap();
        let plane = model.plane_mut();
        plane.nodes.push(Box::new(Layer(["film", "wall"].map(temperature))));
        plane.layout = layout_of(&plane.shared, &*plane.elements, &plane.nodes);
        Sim::new(Arc::new(model)).unwrap()
    }

    fn temperatures(sim: &Sim) -> [f64; 2] {
        let &[.., film, wall] = sim.state() else { unreachable!() };
        [film, wall]
    }

    /// Goes on to the time `to` (s); the heat that went into the ring on the way, J.
    fn advance(sim: &mut Sim, to: f64) -> f64 {
        let (from, samples, mut lost) = (sim.time(), 2000, 0.0);
        let step = (to - from) / f64::from(samples);
        for i in 1..=samples {
            let [_, before] = temperatures(sim);
            sim.advance_to(if i < samples { from + step * f64::from(i) } else { to }).unwrap();
            let [_, after] = temperatures(sim);
            lost += CONDUCTANCE * (0.5 * (before + after) - AROUND) * step;
        }
        lost
    }

    #[test]
    fn a_state_that_is_no_motion_is_integrated_by_every_method() {
        let mut first = None;
        // How far each may be from the first.
        for (method, allowed) in [
            (r#"{"dormand_prince": {"tolerance": 1e-7}}"#, 0.0),
            (r#"{"adams": {"tolerance": 1e-7}}"#, 1e-5),
            (r#"{"rosenbrock": {"tolerance": 1e-7}}"#, 1e-5),
            (r#"{"radau": {"tolerance": 1e-7}}"#, 1e-5),
            (r#"{"leapfrog": {"step": 2e-6}}"#, 1e-4),
            (r#"{"auto": {}}"#, 1e-4),
        ] {
            let mut sim = greased_guide(method);
            let mut lost = advance(&mut sim, END);
            let at_end = temperatures(&sim);
            assert!(at_end[0] - AROUND > 1.0, "{method}: {at_end:?}");
            let expected = *first.get_or_insert(at_end);
            for (x, expected) in at_end.iter().zip(expected) {
                let error = ((x - expected) / (expected - AROUND)).abs();
                assert!(error <= allowed, "{method}: {error:e}");
            }
            // Works belong to the time that the integration has reached.
            let reached = sim.power_balance().unwrap().to;
            lost += advance(&mut sim, reached);
            let balance = sim.power_balance().unwrap();
            assert_eq!(balance.to, sim.time());
            let stored: f64 = CAPACITIES.iter().zip(temperatures(&sim)).map(|(c, t)| c * (t - AROUND)).sum();
            let heat = -balance.work[Power::GuideFilm as usize];
            let error = (stored + lost) / heat - 1.0;
            assert!(error.abs() < 1e-5, "{method}: {error:e}");
        }
    }

    #[test]
    fn its_names_units_and_groups_are_its_own() {
        let sim = greased_guide(r#"{"auto": {}}"#);
        let model = sim.model();
        let names: Vec<_> = model.state_infos().into_iter().map(|info| (info.name, info.unit)).collect();
        assert_eq!(
            names[names.len() - 2..],
            [("layer.film".to_owned(), "K"), ("layer.wall".to_owned(), "K")]
        );
        assert_eq!(model.state_scales()[names.len() - 1], 1.0);
        let groups = model.plane().unwrap().structure().groups();
        assert_eq!(model.plane().unwrap().group_name(groups.len() - 1).as_deref(), Some("layer"));
        assert_eq!(groups.last().map(Vec::len), Some(2));
    }
}
