//! What a bearing in space costs beside the NU2310 in the same run: one force evaluation with all effects, its derivatives, and whole runs
//! of the command line.
//!
//! Medians of short interleaved blocks, as machines drift.

use cagedyn::{Model, Scene, Sim};
use std::hint::black_box;
use std::process::Command;
use std::sync::Arc;
use std::time::Instant;

const BLOCKS: usize = 41;
const REPEATS: u32 = 50;
/// Whole runs of each scene.
const RUNS: usize = 5;

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn sim(name: &str, overrides: &[(&str, &str)], until: f64) -> cagedyn::Result<Sim> {
    let path = format!("{}/scenes/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap_or_default();
    let scene = Scene::from_json_with(&text, overrides.iter().copied())?;
    let mut sim = Sim::new(Arc::new(Model::new(scene)?))?;
    sim.advance_to(until)?;
    Ok(sim)
}

fn main() -> cagedyn::Result<()> {
    let fast = [("inner_ring.speed.constant", "1000.0"), ("balls.drag", r#"{"density": 20.0}"#)];
    let cases = [
        ("nu2310", sim("nu2310", &[], 10e-3)?),
        ("angular_contact_218", sim("angular_contact_218", &fast, 2e-3)?),
        ("deep_groove_6206", sim("deep_groove_6206", &[("inner_ring.speed.constant", "300.0")], 2e-3)?),
        ("angular_contact_70", sim("angular_contact_70", &[], 2e-3)?),
        ("angular_contact_70_cage", sim("angular_contact_70_cage", &[], 2e-3)?),
        ("nu2310_space, 4 slices", sim("nu2310_space", &[], 10e-3)?),
        ("nu2310_space, 8 slices", sim("nu2310_space", &[("raceways.slices", "8")], 10e-3)?),
    ];
    let mut times = vec![[Vec::new(), Vec::new()]; cases.len()];
    let (names, mut sims): (Vec<&str>, Vec<Sim>) = cases.into_iter().unzip();
    for _ in 0..BLOCKS {
        for (sim, times) in sims.iter_mut().zip(&mut times) {
            let (t, state) = (sim.time(), sim.state().to_vec());
            let mut rate = vec![0.0; state.len()];
            let started = Instant::now();
            for _ in 0..REPEATS {
                sim.derivative(t, black_box(&state), &mut rate)?;
            }
            times[0].push(started.elapsed().as_secs_f64() / f64::from(REPEATS));
            let started = Instant::now();
            for _ in 0..REPEATS {
                sim.linearize(t, black_box(&state))?;
            }
            times[1].push(started.elapsed().as_secs_f64() / f64::from(REPEATS));
        }
    }
    let medians: Vec<[f64; 2]> = times.iter_mut().map(|[a, b]| [median(a), median(b)]).collect();
    println!(
        "| scene | evaluation, us | over NU2310 | with derivatives, in evaluations |\n|---|---:|---:|---:|"
    );
    for (name, [forces, both]) in names.iter().zip(&medians) {
        println!("| {name} | {:.2} | {:.1} | {:.1} |", 1e6 * forces, forces / medians[0][0], both / forces);
    }
    whole_runs();
    Ok(())
}

/// Wall times of `cagedyn run`, one scene after the other.
fn whole_runs() {
    let names = ["nu2310", "angular_contact_70", "angular_contact_70_cage", "nu2310_space"];
    let folder = std::env::temp_dir().join(format!("cagedyn_bench_{}", std::process::id()));
    let mut times = vec![Vec::new(); names.len()];
    for _ in 0..RUNS {
        for (name, times) in names.iter().zip(&mut times) {
            let scene = format!("{}/scenes/{name}.json", env!("CARGO_MANIFEST_DIR"));
            let mut run = Command::new(env!("CARGO_BIN_EXE_cagedyn"));
            run.args(["run", &scene, "--out"]).arg(folder.join(name));
            let started = Instant::now();
            let output = run.output().expect("cagedyn runs");
            assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
            times.push(started.elapsed().as_secs_f64());
        }
    }
    let _ = std::fs::remove_dir_all(folder);
    let medians: Vec<f64> = times.iter_mut().map(|times| median(times)).collect();
    println!("\n| cagedyn run | s | over NU2310 |\n|---|---:|---:|");
    for (name, time) in names.iter().zip(&medians) {
        println!("| {name} | {time:.2} | {:.1} |", time / medians[0]);
    }
}
