//! Runs a scene from Rust and prints the cage centre: `cargo run --release --example cage_orbit scenes/nu2310.json`.

use cagedyn::{Error, Model, Recording, Sim, Status};
use std::sync::Arc;

fn main() -> cagedyn::Result<()> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "scenes/nu2310.json".to_owned());
    let text =
        std::fs::read_to_string(&path).map_err(|e| Error::new(Status::File, format!("{path}: {e}")))?;
    let model = Arc::new(Model::from_json(&text)?);
    let record = model.scene().record.clone();
    let mut sim = Sim::new(model)?;

    let mut recording = Recording::default();
    recording.run(&mut sim, record.duration, record.interval, |_, _| true)?;

    for (i, channel) in sim.channels().iter().enumerate().filter(|(_, c)| c.name.starts_with("cage.")) {
        if let Some(s) = recording.spread(i, 2.0 / 3.0 * record.duration) {
            println!("{:18} {:12.5e} +- {:10.3e} {}", channel.name, s.mean, s.deviation, channel.unit);
        }
    }
    println!("{} steps, {} evaluations", sim.statistics().driver.steps, sim.statistics().evaluations);
    Ok(())
}
