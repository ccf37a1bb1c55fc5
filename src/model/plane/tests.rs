//! A body with coordinates of its own behind those of its motion, as modes are: everything but its file takes them as they are.

use super::{InputValues, Workspace};
use crate::bodies::{
    BodyEnergy, BodyForces, BodyState, CAGE, Coordinate, Fault, Moves, OnBody, SharedBody, layout_of,
};
use crate::model::{HostInputs, Model};
use crate::space::{Motion, Wrench};
use crate::{Scene, Sim};
use nalgebra::DMatrixViewMut;
use std::sync::Arc;

/// Square of the frequency (1/s^2), damping (1/s) and drive (m/s^2) of each of two coordinates.
const SQUARE: [f64; 2] = [1.44e6, 4e6];
const DAMPING: [f64; 2] = [150.0, 60.0];
const DRIVE: [f64; 2] = [20.0, -35.0];

/// The cage of a scene with two driven vibrations of its own.
#[derive(Debug)]
struct VibratingCage {
    cage: Box<dyn SharedBody>,
    coordinates: Vec<Coordinate>,
}

impl SharedBody for VibratingCage {
    fn name(&self) -> &'static str {
        self.cage.name()
    }

    fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    fn motion(&self, q: &[f64], v: &[f64], inputs: &InputValues) -> Motion<f64> {
        self.cage.motion(q, v, inputs)
    }

    fn reach(&self) -> f64 {
        self.cage.reach()
    }

    fn lost(&self, distance: f64) -> Fault {
        self.cage.lost(distance)
    }

    fn mass(&self) -> Option<f64> {
        self.cage.mass()
    }

    fn add_external(&self, state: &BodyState<'_>, inputs: &InputValues, on_body: &mut Wrench<f64>) {
        self.cage.add_external(state, inputs, on_body);
    }

    fn respond(&self, forces: &mut [f64], q: &[f64]) {
        self.cage.respond(&mut forces[..3], q);
    }

    fn accelerate(&self, on_body: &OnBody<'_>, state: &BodyState<'_>, gravity: [f64; 2], a: &mut [f64]) {
        self.cage.accelerate(on_body, state, gravity, a);
        for k in 0..2 {
            a[3 + k] = DRIVE[k] - SQUARE[k] * state.q[3 + k] - DAMPING[k] * state.v[3 + k];
        }
    }

    fn wrench_for(&self, a: &dyn Fn(usize) -> f64, state: &BodyState<'_>, gravity: [f64; 2]) -> Wrench<f64> {
        self.cage.wrench_for(a, state, gravity)
    }

    fn is_balanced(&self) -> bool {
        self.cage.is_balanced()
    }

    fn add_inertial_slopes(
        &self,
        on_body: &OnBody<'_>,
        state: &BodyState<'_>,
        mut over_position: DMatrixViewMut<'_, f64>,
        mut over_velocity: DMatrixViewMut<'_, f64>,
    ) {
        for k in 0..2 {
            over_position[(3 + k, 3 + k)] -= SQUARE[k];
            over_velocity[(3 + k, 3 + k)] -= DAMPING[k];
        }
        self.cage.add_inertial_slopes(on_body, state, over_position, over_velocity);
    }

    fn energy(&self, state: &BodyState<'_>, gravity: [f64; 2]) -> BodyEnergy {
        self.cage.energy(state, gravity)
    }

    fn add_powers(&self, state: &BodyState<'_>, inputs: &InputValues, powers: &mut [f64]) {
        self.cage.add_powers(state, inputs, powers);
    }

    fn report(&self, state: &BodyState<'_>, inputs: &InputValues, gravity: [f64; 2], out: &mut BodyForces) {
        self.cage.report(state, inputs, gravity, out);
    }

    fn load_rates(&self, inputs: &InputValues, rates: &InputValues) -> [f64; 3] {
        self.cage.load_rates(inputs, rates)
    }

    fn frequency_on(&self, radial: f64, turning: f64, lever: f64) -> f64 {
        self.cage.frequency_on(radial, turning, lever)
    }

    fn waves(&self) -> Vec<(u32, f64)> {
        self.cage.waves()
    }
}

/// A scene with such a cage.
fn model(file: &str, method: &str) -> Model {
    let path = format!("{}/scenes/{file}.json", env!("CARGO_MANIFEST_DIR"));
    let solver = format!(r#"{{"method": {method}}}"#);
    let text = std::fs::read_to_string(path).unwrap();
    let mut model = Model::new(Scene::from_json_with(&text, [("solver", solver.as_str())]).unwrap()).unwrap();
    let plane = model.plane_mut();
    let cage = plane.shared[CAGE].take().unwrap();
    let names = [
        (["a", "m", "first mode"], ["a_rate", "m/s", "its rate"]),
        (["b", "m", "second mode"], ["b_rate", "m/s", "its rate"]),
    ];
    let own =
        names.map(|(position, rate)| Coordinate { position: Some(position), rate, moves: Moves::Itself });
    let coordinates = cage.coordinates().iter().copied().chain(own).collect();
    plane.shared[CAGE] = Some(Box::new(VibratingCage { cage, coordinates }));
    plane.layout = layout_of(&plane.shared, &*plane.elements, &plane.nodes);
    plane.list_bodies();
    model
}

/// Its vibration from rest, at time `t` (s).
fn exact(k: usize, t: f64) -> f64 {
    let decay = 0.5 * DAMPING[k];
    let frequency = (SQUARE[k] - decay * decay).sqrt();
    let (sin, cos) = (frequency * t).sin_cos();
    DRIVE[k] / SQUARE[k] * (1.0 - (-decay * t).exp() * (cos + decay / frequency * sin))
}

#[test]
fn coordinates_of_its_own_are_integrated_by_every_method() {
    for (file, until) in [("grease_guide", 6e-3), ("nu2310", 2e-3)] {
        for (method, error) in [
            (r#"{"dormand_prince": {"tolerance": 1e-7}}"#, 1e-5),
            (r#"{"adams": {"tolerance": 1e-7}}"#, 1e-5),
            (r#"{"rosenbrock": {"tolerance": 1e-7}}"#, 1e-5),
            (r#"{"radau": {"tolerance": 1e-7}}"#, 1e-5),
            (r#"{"leapfrog": {"step": 1e-6}}"#, 1e-5),
            (r#"{"auto": {}}"#, 2e-3),
        ] {
            let model = Arc::new(model(file, method));
            let at = model.layout().cage().unwrap() + 3;
            let mut sim = Sim::new(model).unwrap();
            sim.advance_to(until).unwrap();
            for k in 0..2 {
                let (x, expected) = (sim.state()[at + k], exact(k, until));
                let size = DRIVE[k].abs() / SQUARE[k];
                assert!((x - expected).abs() < error * size, "{file}, {method}: {x} {expected}");
            }
        }
    }
}

#[test]
fn its_derivatives_are_those_of_the_accelerations() {
    let model = Arc::new(model("nu2310", r#"{"auto": {}}"#));
    let mut sim = Sim::new(model.clone()).unwrap();
    sim.advance_to(1e-3).unwrap();
    let (state, n) = (sim.state().to_vec(), sim.state().len());
    let mut jacobian = vec![0.0; n * n];
    sim.jacobian(1e-3, &state, &mut jacobian).unwrap();
    let (positions, at) = (model.layout().positions(), model.layout().cage().unwrap() + 3);
    for k in 0..2 {
        let row = positions + at + k;
        for column in 0..n {
            let expected = match column {
                c if c == at + k => -SQUARE[k],
                c if c == row => -DAMPING[k],
                _ => 0.0,
            };
            assert_eq!(jacobian[row + n * column], expected, "{column}");
        }
    }
    let names: Vec<_> = model.state_infos().into_iter().map(|info| info.name).collect();
    assert_eq!((&*names[at], &*names[positions + at + 1]), ("cage.a", "cage.b_rate"));
    // Nothing else takes notice of them.
    let (mut ws, mut a) = (Workspace::new(model.plane().unwrap()), vec![0.0; model.layout().velocities()]);
    let inputs = model.inputs_at(1e-3, &HostInputs::default());
    let (q, v) = state.split_at(positions);
    model.plane().unwrap().accelerations(&inputs, q, v, &mut ws, &mut a).unwrap();
    let before = a.clone();
    let mut moved = state.clone();
    moved[at] += 1e-4;
    let (q, v) = moved.split_at(positions);
    model.plane().unwrap().accelerations(&inputs, q, v, &mut ws, &mut a).unwrap();
    a[at] = before[at];
    assert_eq!(a, before);
}
