//! What the tool adds to the integration: the whole process of `cagedyn run`, with reading, records, table and pictures, over one
//! `advance_to` of the same scene, in pairs. `cargo bench --bench tool` prints it.

use cagedyn::{Model, Scene, Sim};
use std::error::Error;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::time::Instant;

const SCENE: &str = "nu2310";
/// s
const DURATION: f64 = 0.3;
const PAIRS: usize = 21;

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn main() -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("scenes/{SCENE}.json"));
    let text = std::fs::read_to_string(&path)?;
    let model = Arc::new(Model::new(Scene::from_json(&text)?)?);
    let [mut tool, mut integration, mut ratios] = [(); 3].map(|()| Vec::new());
    for _ in 0..PAIRS {
        let started = Instant::now();
        let status = Command::new(env!("CARGO_BIN_EXE_cagedyn"))
            .args(["run".as_ref(), path.as_os_str(), "--until".as_ref(), DURATION.to_string().as_ref()])
            .args(["--out".as_ref(), folder.path().as_os_str()])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status()?;
        let whole = started.elapsed().as_secs_f64();
        if !status.success() {
            return Err(status.to_string().into());
        }
        let mut sim = Sim::new(model.clone())?;
        let started = Instant::now();
        sim.advance_to(DURATION)?;
        let alone = started.elapsed().as_secs_f64();
        tool.push(whole);
        integration.push(alone);
        ratios.push(whole / alone);
    }
    println!(
        "{SCENE}, {DURATION} s: the tool takes {:.3} s, integration alone {:.3} s; ratio {:.3}, median of {PAIRS} pairs",
        median(tool),
        median(integration),
        median(ratios)
    );
    Ok(())
}
