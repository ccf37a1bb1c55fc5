//! What an elastic ring of the cage costs: an evaluation of all forces with it over one of a rigid cage, each at the states of its
//! own run, in pairs. Without the guide it is what pockets and waves alone cost. `cargo bench --bench bent` prints it.

use cagedyn::{Model, Scene, Sim};
use std::error::Error;
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

/// Scenes, rings, whether they have their guide, and what is allowed.
const CASES: [(&str, &str, bool, &str); 4] = [
    ("grease_guide_elastic", "4", true, "3"),
    ("grease_guide_elastic", "8", true, "5"),
    ("nu2310_elastic", "6", true, "1.15"),
    ("nu2310_elastic", "6", false, "1.15"),
];
/// States are taken from a run, s.
const DEVELOPED: f64 = 20e-3;
const INTERVAL: f64 = 0.25e-3;
const STATES: usize = 41;
const EVALUATIONS: u32 = 500;

fn main() -> Result<(), Box<dyn Error>> {
    for (name, modes, guided, allowed) in CASES {
        let path = format!("{}/scenes/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path)?;
        let without: &[_] = if guided { &[] } else { &[("cage.guide", "null")] };
        let sim = |changes: &[(&str, &str)]| -> Result<Sim, Box<dyn Error>> {
            let changes = changes.iter().chain(without).copied();
            Ok(Sim::new(Arc::new(Model::new(Scene::from_json_with(&text, changes)?)?))?)
        };
        let bends = ("cage.elastic_ring.modes", modes);
        let [mut bent, mut rigid] = [sim(&[bends])?, sim(&[("cage.elastic_ring", "null")])?];
        let mut runs = [sim(&[bends])?, sim(&[("cage.elastic_ring", "null")])?];
        let mut ratios = Vec::new();
        for i in 0..STATES {
            let time = DEVELOPED + i as f64 * INTERVAL;
            runs.iter_mut().try_for_each(|run| run.advance_to(time))?;
            let time_of = |sim: &mut Sim, run: &Sim| -> Result<f64, Box<dyn Error>> {
                let mut rate = vec![0.0; run.state().len()];
                let started = Instant::now();
                for _ in 0..EVALUATIONS {
                    sim.derivative(time, black_box(run.state()), &mut rate)?;
                }
                Ok(started.elapsed().as_secs_f64())
            };
            time_of(&mut bent, &runs[0])?;
            let [with, without] = [time_of(&mut bent, &runs[0])?, time_of(&mut rigid, &runs[1])?];
            ratios.push((with / without, with, without));
        }
        ratios.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (ratio, with, without) = ratios[ratios.len() / 2];
        println!(
            "{name}{}, orders 2 to {modes}: {ratio:.2} ({:.2} to {:.2}), wanted {allowed}; {:.2} us over {:.2} us",
            if guided { "" } else { " without its guide" },
            ratios[0].0,
            ratios[ratios.len() - 1].0,
            1e6 * with / f64::from(EVALUATIONS),
            1e6 * without / f64::from(EVALUATIONS),
        );
    }
    Ok(())
}
