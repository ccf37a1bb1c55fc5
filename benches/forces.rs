//! Cost of a force evaluation and of a simulated millisecond. `cargo bench` prints both.
//!
//! Compare numbers of one run only: machines differ and drift.

use cagedyn::{Model, Sim};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::Arc;

fn developed(overrides: &[(&str, &str)]) -> Option<Sim> {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/nu2310.json")).ok()?;
    let scene = cagedyn::Scene::from_json_with(&text, overrides.iter().copied()).ok()?;
    let mut sim = Sim::new(Arc::new(Model::new(scene).ok()?)).ok()?;
    sim.advance_to(20e-3).ok()?;
    Some(sim)
}

fn benches(c: &mut Criterion) {
    let elastic_only: [(&str, &str); 5] = [
        ("raceways.contact", "{}"),
        ("raceways.rolling_resistance", "null"),
        ("cage.pocket", "null"),
        ("cage.guide", "null"),
        ("lubricant", "null"),
    ];
    for (name, overrides) in [("full", &[][..]), ("elastic", &elastic_only[..])] {
        let Some(mut sim) = developed(overrides) else { continue };
        let state = sim.state().to_vec();
        let mut rate = vec![0.0; state.len()];
        c.bench_function(&format!("nu2310/{name}/force evaluation"), |b| {
            b.iter(|| sim.derivative(20e-3, black_box(&state), &mut rate));
        });
        c.bench_function(&format!("nu2310/{name}/1 ms"), |b| {
            b.iter(|| {
                let reset = sim.set_state(20e-3, black_box(&state));
                reset.and_then(|()| sim.step(1e-3))
            });
        });
    }
}

criterion_group!(forces, benches);
criterion_main!(forces);
