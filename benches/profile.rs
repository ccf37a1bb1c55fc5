//! What a profile of the rollers costs: an evaluation of all forces, of its derivatives, and a run, over those of straight rollers.
//! `cargo bench --bench profile` prints it.

use cagedyn::{Model, Scene, Sim};
use std::error::Error;
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

const LOGARITHM: &str = r#"{"logarithmic": {"design_load": 10880, "crowned_share": 0.6, "end_drop": 12e-6}}"#;
const CROWN: &str = r#"{"circular_crown": {"radius": 5.2}}"#;
/// Names and changes of the NU2310 scene.
const PROFILES: [(&str, &[(&str, &str)]); 5] = [
    ("logarithm, 4 slices", &[("rollers.profile", LOGARITHM), ("raceways.slices", "4")]),
    ("logarithm, 8 slices", &[("rollers.profile", LOGARITHM)]),
    ("crown, 4 slices", &[("rollers.profile", CROWN), ("raceways.slices", "4")]),
    ("crown, 8 slices", &[("rollers.profile", CROWN)]),
    (
        "logarithm on a crowned raceway, 8 slices",
        &[("rollers.profile", LOGARITHM), ("outer_ring.raceway_crown_radius", "12.0")],
    ),
];
/// States are taken from a run, s.
const DEVELOPED: f64 = 30e-3;
const INTERVAL: f64 = 1e-3;
const STATES: usize = 11;
const EVALUATIONS: u32 = 1000;
/// Length of the run that is timed, s.
const RUN: f64 = 20e-3;

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

fn main() -> Result<(), Box<dyn Error>> {
    let text = std::fs::read_to_string(format!("{}/scenes/nu2310.json", env!("CARGO_MANIFEST_DIR")))?;
    let sim = |more: &[(&str, &str)]| -> Result<Sim, Box<dyn Error>> {
        Ok(Sim::new(Arc::new(Model::new(Scene::from_json_with(&text, more.iter().copied())?)?))?)
    };
    for (name, profile) in PROFILES {
        let (mut straight, mut profiled, mut running) = (sim(&[])?, sim(profile)?, sim(profile)?);
        let n = running.state().len();
        let (mut rate, mut jacobian) = (vec![0.0; n], vec![0.0; n * n]);
        let [mut forces, mut slopes] = [Vec::new(), Vec::new()];
        for i in 0..STATES {
            let time = DEVELOPED + i as f64 * INTERVAL;
            running.advance_to(time)?;
            let state = running.state();
            let mut of_forces = |sim: &mut Sim| -> Result<f64, Box<dyn Error>> {
                let started = Instant::now();
                for _ in 0..EVALUATIONS {
                    sim.derivative(time, black_box(state), &mut rate)?;
                }
                Ok(started.elapsed().as_secs_f64())
            };
            // Once before, so that both find their data at hand.
            of_forces(&mut profiled)?;
            forces.push(of_forces(&mut profiled)? / of_forces(&mut straight)?);
            let mut of_slopes = |sim: &mut Sim| -> Result<f64, Box<dyn Error>> {
                let started = Instant::now();
                for _ in 0..EVALUATIONS / 4 {
                    sim.jacobian(time, black_box(state), &mut jacobian)?;
                }
                Ok(started.elapsed().as_secs_f64())
            };
            slopes.push(of_slopes(&mut profiled)? / of_slopes(&mut straight)?);
        }
        let mut runs = Vec::new();
        for _ in 0..3 {
            let [with, without] = [profile, &[]].map(|changes| -> Result<f64, Box<dyn Error>> {
                let mut sim = sim(changes)?;
                let started = Instant::now();
                sim.advance_to(RUN)?;
                Ok(started.elapsed().as_secs_f64())
            });
            runs.push(with? / without?);
        }
        println!(
            "{name}: forces {:.2}, Jacobian {:.2}, run {:.2}",
            median(forces),
            median(slopes),
            median(runs)
        );
    }
    Ok(())
}
