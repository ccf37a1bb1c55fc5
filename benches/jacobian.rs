//! What the derivatives of the forces take beside the forces, measured and as the compiled model counts it: the numbers that
//! the choice between an implicit and an explicit method rests on.
//!
//! Medians of short interleaved blocks, as machines drift.

use cagedyn::integrate::Linearization;
use cagedyn::model::{HostInputs, Workspace};
use cagedyn::{Model, Scene, Sim};
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

/// Time at which forces are evaluated, s: the motion has developed.
const DEVELOPED: f64 = 10e-3;
const BLOCKS: usize = 41;
const REPEATS: u32 = 50;

const CASES: [(&str, &[(&str, &str)]); 9] = [
    ("nu2310", &[]),
    ("nu2310", &[("rollers.count", "6")]),
    ("nu2310", &[("cage.guide", "null")]),
    ("nu2310", &[("inner_ring.motion.free.load.z.constant", "-40e3")]),
    ("nu2310_grease", &[]),
    ("grease_guide", &[]),
    ("grease_guide", &[("cage.guide.film.lubricant_layer.thickness", "100e-6")]),
    ("grease_guide", &[("cage.guide.film", "null"), ("cage.guide.film_share", "null")]),
    ("ball_short_bearing", &[]),
];

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Time of the forces in ns, and derivatives less forces over forces.
fn measured(sim: &Sim) -> Option<[f64; 2]> {
    let model = sim.model();
    let host = HostInputs::default();
    let plane = model.plane().unwrap();
    let (inputs, rates) = (model.inputs_at(DEVELOPED, &host), model.input_rates_at(DEVELOPED, &host));
    let (q, v) = sim.state().split_at(model.layout().positions());
    let (mut ws, mut a) = (Workspace::new(plane), vec![0.0; v.len()]);
    let mut out = Linearization::new(&plane.structure(), v.len());
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..BLOCKS {
        let started = Instant::now();
        for _ in 0..REPEATS {
            plane.accelerations(&inputs, black_box(q), v, &mut ws, &mut a).ok()?;
        }
        let forces = started.elapsed().as_secs_f64() / f64::from(REPEATS);
        let started = Instant::now();
        for _ in 0..REPEATS {
            ws.set_differentiating(true);
            plane.accelerations(&inputs, black_box(q), v, &mut ws, &mut a).ok()?;
            ws.set_differentiating(false);
            plane.linearize(&mut ws, &rates, &mut out);
        }
        let both = started.elapsed().as_secs_f64() / f64::from(REPEATS);
        times[0].push(1e9 * forces);
        times[1].push(both / forces - 1.0);
    }
    Some(times.map(median))
}

fn main() -> cagedyn::Result<()> {
    println!("| scene | forces, ns | derivatives, in forces: measured | counted |\n|---|---:|---:|---:|");
    for (name, overrides) in CASES {
        let path = format!("{}/scenes/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap_or_default();
        let scene = Scene::from_json_with(&text, overrides.iter().copied())?;
        let mut sim = Sim::new(Arc::new(Model::new(scene)?))?;
        sim.advance_to(DEVELOPED)?;
        let changes: Vec<String> = overrides.iter().map(|(path, value)| format!(" {path}={value}")).collect();
        let Some([forces, measured]) = measured(&sim) else { continue };
        let counted = sim.model().plane().unwrap().jacobian_cost();
        println!("| {name}{} | {forces:.0} | {measured:.2} | {counted:.2} |", changes.concat());
    }
    Ok(())
}
