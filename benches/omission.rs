//! What an evaluation costs without a law or an effect over one with it, at the same states, in pairs: leaving something out
//! must not cost. `cargo bench --bench omission` prints it.
//!
//! States are those of a run of the whole scene, so that the same contacts touch with and without.

use cagedyn::{Model, Scene, Sim};
use std::error::Error;
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

const SCENE: &str = include_str!("../scenes/nu2310.json");
const RACEWAYS: &str = "raceways.contact";
const POCKETS: &str = "cage.pocket.lubricated_cylinder.contact";
/// Parts of the law of a contact.
const PARTS: [&str; 4] = ["damping", "thermal_correction", "self_heating", "boundary_friction"];
/// Other fields that a scene may leave out, and what stands there instead.
const OTHERS: [(&str, &str); 7] = [
    ("gravity", "null"),
    ("raceways.contact.traction", "null"),
    ("raceways.rolling_resistance", "null"),
    ("cage.pocket.lubricated_cylinder.edge_friction", "null"),
    ("cage.pocket.lubricated_cylinder.contact", "{}"),
    ("cage.guide.film.short_bearing.squeeze", "false"),
    ("cage.guide", "null"),
];
/// States are taken from a run, s.
const DEVELOPED: f64 = 30e-3;
const INTERVAL: f64 = 0.5e-3;
const STATES: usize = 41;
const REPEATS: usize = 9;
const EVALUATIONS: u32 = 200;

fn sim(overrides: &[(&str, &str)]) -> Result<Sim, Box<dyn Error>> {
    let scene = Scene::from_json_with(SCENE, overrides.iter().copied())?;
    Ok(Sim::new(Arc::new(Model::new(scene)?))?)
}

/// Wall time of some evaluations at a state, s.
fn time_of(sim: &mut Sim, time: f64, state: &[f64], rate: &mut [f64]) -> Result<f64, Box<dyn Error>> {
    let started = Instant::now();
    for _ in 0..EVALUATIONS {
        sim.derivative(time, black_box(state), rate)?;
    }
    Ok(started.elapsed().as_secs_f64())
}

/// Median over pairs at all states.
fn ratio(whole: &mut Sim, less: &mut Sim, states: &[(f64, Vec<f64>)]) -> Result<f64, Box<dyn Error>> {
    let mut rate = vec![0.0; states[0].1.len()];
    let mut ratios = Vec::new();
    for _ in 0..REPEATS {
        for (time, state) in states {
            time_of(less, *time, state, &mut rate)?;
            let less = time_of(less, *time, state, &mut rate)?;
            let whole = time_of(whole, *time, state, &mut rate)?;
            ratios.push(less / whole);
        }
    }
    ratios.sort_by(f64::total_cmp);
    Ok(ratios[ratios.len() / 2])
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut whole = sim(&[])?;
    let mut states = Vec::new();
    for i in 0..STATES {
        let time = DEVELOPED + i as f64 * INTERVAL;
        whole.advance_to(time)?;
        states.push((time, whole.state().to_vec()));
    }
    println!("nothing: {:.3}", ratio(&mut whole, &mut sim(&[])?, &states)?);
    for law in [RACEWAYS, POCKETS] {
        for part in PARTS {
            let path = format!("{law}.{part}");
            println!("{path}: {:.3}", ratio(&mut whole, &mut sim(&[(&path, "null")])?, &states)?);
        }
    }
    for (path, value) in OTHERS {
        let mut overrides = vec![(path, value)];
        if path.ends_with("traction") {
            overrides.push(("raceways.contact.self_heating", "null"));
        }
        println!("{path}: {:.3}", ratio(&mut whole, &mut sim(&overrides)?, &states)?);
    }
    Ok(())
}
