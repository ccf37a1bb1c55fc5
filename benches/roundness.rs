//! What roundness of the guided surface costs: an evaluation of all forces with it over one without, at the same states, in
//! pairs. States where only the lobes reach the oil count for themselves: there a round film would not be integrated.
//! `cargo bench --bench roundness` prints it.

use cagedyn::{Model, Scene, Sim};
use std::error::Error;
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

const SCENES: [&str; 4] = ["nu2310", "ball_short_bearing", "grease_guide", "nu2310_grease"];
const PROFILES: [(&str, &str); 2] = [
    ("order 2", r#"[{"order": 2, "amplitude": 5e-6, "phase": 0.3}]"#),
    (
        "orders 3 and 7",
        r#"[{"order": 3, "amplitude": 5e-6, "phase": 0.3}, {"order": 7, "amplitude": 2e-6, "phase": 1.0}]"#,
    ),
];
/// States are taken from a run with roundness, s.
const DEVELOPED: f64 = 30e-3;
const INTERVAL: f64 = 1e-3;
const STATES: usize = 21;
const EVALUATIONS: u32 = 2000;

/// Median and range of ratios.
fn spread(mut values: Vec<f64>) -> String {
    values.sort_by(f64::total_cmp);
    match (values.first(), values.last()) {
        (Some(least), Some(most)) => {
            let median = values[values.len() / 2];
            format!("{median:.2} ({least:.2} to {most:.2}) in {} states", values.len())
        }
        _ => "no state".to_owned(),
    }
}

/// Whether the film of the guide acts in this state.
fn is_wet(sim: &mut Sim, time: f64, state: &[f64]) -> Result<bool, Box<dyn Error>> {
    sim.set_state(time, state)?;
    let guide = sim.forces()?.guide;
    Ok(guide.pressure != [0.0; 2] || guide.shear != [0.0; 2])
}

fn main() -> Result<(), Box<dyn Error>> {
    for name in SCENES {
        let path = format!("{}/scenes/{name}.json", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path)?;
        for (profile, roundness) in PROFILES {
            let sim = |more: &[(&str, &str)]| -> Result<Sim, Box<dyn Error>> {
                Ok(Sim::new(Arc::new(Model::new(Scene::from_json_with(&text, more.iter().copied())?)?))?)
            };
            let (mut round, mut lobed) = (sim(&[])?, sim(&[("cage.guide.roundness", roundness)])?);
            let mut rate = vec![0.0; round.state().len()];
            let mut running = sim(&[("cage.guide.roundness", roundness)])?;
            let (mut alike, mut reached) = (Vec::new(), Vec::new());
            for i in 0..STATES {
                let time = DEVELOPED + i as f64 * INTERVAL;
                running.advance_to(time)?;
                let state = running.state();
                let same = is_wet(&mut lobed, time, state)? == is_wet(&mut round, time, state)?;
                let mut time_of = |sim: &mut Sim| -> Result<f64, Box<dyn Error>> {
                    let started = Instant::now();
                    for _ in 0..EVALUATIONS {
                        sim.derivative(time, black_box(state), &mut rate)?;
                    }
                    Ok(started.elapsed().as_secs_f64())
                };
                // Once before, so that both find their data at hand.
                time_of(&mut lobed)?;
                let [with, without] = [time_of(&mut lobed)?, time_of(&mut round)?];
                let ratios = if same { &mut alike } else { &mut reached };
                ratios.push(with / without);
            }
            println!(
                "{name}, {profile}: {}; where only the lobes reach the oil: {}",
                spread(alike),
                spread(reached)
            );
        }
    }
    Ok(())
}
