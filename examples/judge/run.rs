//! One random scene with every preset.

use crate::scenes;
use cagedyn::{Error, Model, Sim, Status};
use serde_json::{Value, json};
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, mpsc};

/// How scenes are judged.
#[derive(Clone, Debug)]
pub struct Options {
    /// Length of each run, s.
    pub duration: f64,
    /// Whether means are compared with `reference`, which takes ten times as long.
    pub means: bool,
    /// The presets, or all of them.
    pub presets: Vec<String>,
    /// Limit of the wall time of a run, s.
    pub wall_time: f64,
}

/// The presets, and the largest share of energy that may be missing in each.
pub const PRESETS: [(&str, f64); 3] = [("draft", 1e-2), ("engineering", 1e-3), ("reference", 1e-4)];
/// Records of a run. The second half counts.
const RECORDS: u32 = 300;
/// Batches that the standard error of a mean is found from.
const BATCHES: usize = 10;
/// Channels whose means are compared, where they exist.
pub const CHANNELS: [&str; 4] = ["cage.y_ratio", "cage.z_ratio", "cage.slip", "inner_ring.drag_torque"];

/// Mean of a channel and its standard error.
#[derive(Clone, Copy, Debug)]
pub struct Mean {
    pub mean: f64,
    pub error: f64,
}

/// What became of a scene with a preset.
#[derive(Debug)]
pub enum Verdict {
    /// The schema refuses the scene.
    Refused,
    Failed(Error),
    Ran {
        /// Missing energy as a share of what passed through.
        residual: f64,
        trusted: bool,
        evaluations: u64,
        /// Largest difference of a mean from `reference` in units of what is allowed.
        apart: Option<(f64, &'static str)>,
        report: String,
    },
}

#[derive(Debug)]
pub struct Outcome {
    pub number: u64,
    pub preset: &'static str,
    pub promise: f64,
    pub verdict: Verdict,
}

/// Judges many scenes on all cores; `each` is told of every outcome.
pub fn judge_all(numbers: Range<u64>, options: &Options, mut each: impl FnMut(&Outcome)) -> Vec<Outcome> {
    let next = AtomicU64::new(numbers.start);
    let jobs = std::thread::available_parallelism().map_or(1, |n| n.get());
    let (sender, receiver) = mpsc::channel();
    let mut outcomes = Vec::new();
    std::thread::scope(|scope| {
        for _ in 0..jobs {
            let (sender, next, end) = (sender.clone(), &next, numbers.end);
            scope.spawn(move || {
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    if number >= end {
                        return;
                    }
                    for outcome in judge(number, options) {
                        // The receiver lives as long as this scope.
                        let _ = sender.send(outcome);
                    }
                }
            });
        }
        drop(sender);
        for outcome in receiver {
            each(&outcome);
            outcomes.push(outcome);
        }
    });
    outcomes
}

/// Runs scene `number` with the presets.
pub fn judge(number: u64, options: &Options) -> Vec<Outcome> {
    let scene = scenes::scene(number, options.duration);
    let references = options.means.then(|| {
        [0.0, 1e-9].map(|shift| run(&scene, "reference", shift, options).ok().map(|(_, means)| means))
    });
    let asked = |preset: &str| options.presets.is_empty() || options.presets.iter().any(|p| p == preset);
    let list = PRESETS.into_iter().filter(|(preset, _)| asked(preset));
    list.map(|(preset, promise)| {
        let verdict = match run(&scene, preset, 0.0, options) {
            Err(e) if matches!(e.status, Status::BadScene | Status::BadJson) => Verdict::Refused,
            Err(e) => Verdict::Failed(e),
            Ok((mut verdict, means)) => {
                if let (Verdict::Ran { apart, .. }, Some([Some(a), Some(b)])) = (&mut verdict, &references) {
                    *apart = compare(&means, [a, b]);
                }
                verdict
            }
        };
        Outcome { number, preset, promise, verdict }
    })
    .collect()
}

/// The largest difference from the references in units of three times their own and three standard errors.
fn compare(means: &[Option<Mean>; 4], [a, b]: [&[Option<Mean>; 4]; 2]) -> Option<(f64, &'static str)> {
    let ratio = |k: usize| {
        let (x, a, b) = (means[k]?, a[k]?, b[k]?);
        let error = (x.error * x.error + 0.5 * (a.error * a.error + b.error * b.error)).sqrt();
        // Smaller differences are none.
        let allowed = 3.0 * (a.mean - b.mean).abs() + 3.0 * error + 1e-3 * a.mean.abs().max(0.1);
        Some(((x.mean - 0.5 * (a.mean + b.mean)).abs() / allowed, CHANNELS[k]))
    };
    (0..CHANNELS.len()).filter_map(ratio).max_by(|a, b| a.0.total_cmp(&b.0))
}

type Means = [Option<Mean>; 4];

fn run(scene: &Value, preset: &str, shift: f64, options: &Options) -> Result<(Verdict, Means), Error> {
    let mut scene = scene.clone();
    scene["solver"] = json!({"preset": preset});
    let mut sim = Sim::new(Arc::new(Model::from_json(&scene.to_string())?))?;
    sim.set_wall_time_limit(options.wall_time)?;
    if shift > 0.0 {
        let mut state = sim.state().to_vec();
        let scales = sim.model().state_scales();
        state.iter_mut().zip(scales).for_each(|(x, scale)| *x += shift * scale);
        sim.set_state(0.0, &state)?;
    }
    let names: Vec<String> = sim.channels().iter().map(|channel| channel.name.clone()).collect();
    let places = CHANNELS.map(|name| names.iter().position(|n| n == name));
    let (mut out, mut columns) = (vec![0.0; names.len()], [const { Vec::new() }; 4]);
    for i in 1..=RECORDS {
        sim.advance_to(options.duration * f64::from(i) / f64::from(RECORDS))?;
        sim.outputs(&mut out)?;
        if 2 * i > RECORDS {
            for (column, place) in columns.iter_mut().zip(places) {
                column.extend(place.map(|k| out[k]));
            }
        }
    }
    let verdict = Verdict::Ran {
        residual: sim.power_balance()?.relative_residual(),
        trusted: sim.doubts().is_empty(),
        evaluations: sim.statistics().evaluations,
        apart: None,
        report: sim.report(),
    };
    Ok((verdict, columns.map(|values| mean(&values))))
}

/// Mean of a series and its standard error, from batches.
fn mean(values: &[f64]) -> Option<Mean> {
    let size = values.len() / BATCHES;
    let batches: Vec<f64> =
        values.chunks_exact(size.max(1)).map(|x| x.iter().sum::<f64>() / x.len() as f64).collect();
    let n = batches.len() as f64;
    let mean = batches.iter().sum::<f64>() / n;
    let variance = batches.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0) / n;
    (batches.len() > 1).then_some(Mean { mean, error: variance.sqrt() })
}
