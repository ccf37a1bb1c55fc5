//! Cost of a force evaluation, of the power balance of its state, and of a simulated millisecond. `cargo bench` prints both.
//!
//! Compare numbers of one run only: machines differ and drift.

use cagedyn::model::{HostInputs, POWERS, Workspace};
use cagedyn::{Model, Scene, Sim};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::Arc;

/// Time at which a run is taken, s: the motion has developed.
const DEVELOPED: f64 = 30e-3;

const ELASTIC_ONLY: [(&str, &str); 5] = [
    ("raceways.contact", "{}"),
    ("raceways.rolling_resistance", "null"),
    ("cage.pocket", "null"),
    ("cage.guide", "null"),
    ("lubricant", "null"),
];
const GRAVITY_ONLY: [(&str, &str); 3] =
    [("cage.pocket", "null"), ("cage.guide", "null"), ("lubricant", "null")];

fn developed(scene: &str, overrides: &[(&str, &str)]) -> Option<Sim> {
    let path = format!("{}/scenes/{scene}.json", env!("CARGO_MANIFEST_DIR"));
    let scene =
        Scene::from_json_with(&std::fs::read_to_string(path).ok()?, overrides.iter().copied()).ok()?;
    let mut sim = Sim::new(Arc::new(Model::new(scene).ok()?)).ok()?;
    sim.advance_to(DEVELOPED).ok()?;
    Some(sim)
}

fn benches(c: &mut Criterion) {
    for (scene, name, overrides) in [
        ("nu2310", "full", &[][..]),
        ("nu2310", "elastic", &ELASTIC_ONLY),
        ("grease_guide", "full", &[]),
        ("grease_guide", "gravity", &GRAVITY_ONLY),
    ] {
        let Some(mut sim) = developed(scene, overrides) else { continue };
        let state = sim.state().to_vec();
        let mut rate = vec![0.0; state.len()];
        c.bench_function(&format!("{scene}/{name}/force evaluation"), |b| {
            b.iter(|| sim.derivative(DEVELOPED, black_box(&state), &mut rate));
        });
        let model = sim.model().clone();
        let (q, v) = state.split_at(model.layout().positions());
        let (mut workspace, mut a) = (Workspace::new(model.plane().unwrap()), vec![0.0; v.len()]);
        let inputs = model.inputs_at(DEVELOPED, &HostInputs::default());
        if model.plane().unwrap().accelerations(&inputs, q, v, &mut workspace, &mut a).is_ok() {
            c.bench_function(&format!("{scene}/{name}/power balance"), |b| {
                let mut powers = [0.0; POWERS.len() + 1];
                b.iter(|| model.plane().unwrap().powers(black_box(v), None, &mut workspace, &mut powers));
            });
        }
        c.bench_function(&format!("{scene}/{name}/1 ms"), |b| {
            b.iter(|| {
                let reset = sim.set_state(DEVELOPED, black_box(&state));
                reset.and_then(|()| sim.step(1e-3))
            });
        });
    }
}

criterion_group!(forces, benches);
criterion_main!(forces);
