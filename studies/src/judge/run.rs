//! One random scene with every preset.

use crate::judge::impossible::Watch;
use crate::judge::{published, rollers_in_space, scenes, space};
use cagedyn::integrate::Tuning;
use cagedyn::sim::{Doubt, LEVEL, Sample};
use cagedyn::{Error, Model, Sim, Status};
use serde_json::{Value, json};
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, mpsc};

/// Where scenes come from. Numbers of different kinds have nothing in common.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Kind {
    /// Sizes at random.
    #[default]
    Plain,
    /// Published bearings with everything that a scene can have.
    Published,
    /// Balls that move in space, with a cage or without.
    Space { caged: bool },
    /// Rollers that move in space.
    Rollers,
}

impl Kind {
    /// A scene of `duration` s for this number.
    pub fn scene(self, number: u64, duration: f64) -> Value {
        match self {
            Self::Plain => scenes::scene(number, duration),
            Self::Published => published::scene(number, duration),
            Self::Space { caged } => space::scene(number, duration, caged),
            Self::Rollers => rollers_in_space::scene(number, duration),
        }
    }
}

/// How scenes are judged.
#[derive(Clone, Debug)]
pub struct Options {
    pub kind: Kind,
    /// Length of each run, s.
    pub duration: f64,
    /// Whether means are compared with `reference`, which takes ten times as long.
    pub means: bool,
    /// The presets, or all of them.
    pub presets: Vec<String>,
    /// Limit of the wall time of a run, s.
    pub wall_time: f64,
    /// Evaluations after which a run is stopped at its next record.
    pub most_evaluations: u64,
    /// Constants of `auto`.
    pub tuning: Tuning,
}

/// Means of a channel over many starts.
#[derive(Clone, Debug)]
pub struct OverStarts {
    pub preset: &'static str,
    pub channel: &'static str,
    pub sample: Sample,
    /// Mean number of evaluations of a run.
    pub evaluations: f64,
}

/// The presets, and the largest share of energy that may be missing in each.
pub const PRESETS: [(&str, f64); 3] = [("draft", 1e-2), ("engineering", 1e-3), ("reference", 1e-4)];
/// Records of a run. The second half counts.
const RECORDS: u32 = 300;
/// Distance of the starts of the two references, and by how much further starts differ from one to the next, in units of the
/// state scales.
const CLOSE: f64 = 1e-9;
const FURTHER: f64 = 1e-6;
/// Starts that decide whether means that are apart in one run are apart.
const STARTS: u32 = 8;
/// Smaller differences of means are none: as a share of the mean, or of this much of a ratio.
const NEXT_TO_NOTHING: f64 = 1e-3;
const SMALL_RATIO: f64 = 0.1;
/// Channels whose means are compared, where they exist.
pub const CHANNELS: [&str; 5] =
    ["cage.y_ratio", "cage.z_ratio", "cage.slip", "inner_ring.drag_torque", "balls.orbit_ratio"];
/// Most of them that a scene has.
const MOST_CHANNELS: usize = 4;

/// How far means are from those of `reference`.
#[derive(Clone, Copy, Debug)]
pub struct Apart {
    /// Largest difference in units of what is allowed.
    pub ratio: f64,
    /// Its index in [`CHANNELS`].
    pub channel: usize,
    /// Whether means over several starts differ, too, by more than their scatter explains.
    pub in_mean: bool,
}

impl Options {
    /// The presets that are asked for.
    fn chosen(&self) -> impl Iterator<Item = (&'static str, f64)> + '_ {
        let asked = |preset: &str| self.presets.is_empty() || self.presets.iter().any(|p| p == preset);
        PRESETS.into_iter().filter(move |(preset, _)| asked(preset))
    }
}

/// What became of a scene with a preset.
#[derive(Debug)]
pub enum Verdict {
    /// The schema refuses the scene.
    Refused(Error),
    Failed(Error),
    /// A film that is not passive made energy, and the run said so: by its end, or by not being trusted for nothing else.
    MadeEnergy(String),
    Ran {
        /// Missing energy as a share of what passed through.
        residual: f64,
        trusted: bool,
        apart: Option<Apart>,
        /// Results that no bearing can have.
        impossible: Vec<String>,
        report: String,
    },
}

#[derive(Debug)]
pub struct Outcome {
    pub number: u64,
    pub preset: &'static str,
    pub promise: f64,
    /// Evaluations of its run, to where it ended.
    pub evaluations: u64,
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
    let scene = options.kind.scene(number, options.duration);
    let run = |preset, shift| run(&scene, preset, shift, options);
    let mut references = options.means.then(|| [0.0, CLOSE].map(|shift| run("reference", shift)));
    let means = match &references {
        Some([(_, Ok((_, a))), (_, Ok((_, b)))]) => Some([*a, *b]),
        _ => None,
    };
    let list = options.chosen();
    list.map(|(preset, promise)| {
        let (evaluations, ran) = match references.take() {
            Some([reference, _]) if preset == "reference" => reference,
            others => {
                references = others;
                run(preset, 0.0)
            }
        };
        let verdict = match ran {
            Err(e) if matches!(e.status, Status::BadScene | Status::BadJson) => Verdict::Refused(e),
            Err(e) if e.message.contains("can make energy") => Verdict::MadeEnergy(e.message),
            Err(e) => Verdict::Failed(e),
            Ok((mut verdict, here)) => {
                if let (Verdict::Ran { apart, .. }, Some(means)) = (&mut verdict, &means) {
                    *apart = compare(&here, means);
                    if let Some(apart) = apart
                        && apart.ratio > 1.0
                    {
                        let of = |preset| {
                            starts(|shift| run(preset, shift).1.ok().map(|(_, means)| means), apart.channel)
                        };
                        apart.in_mean = differ(of(preset), of("reference"));
                    }
                }
                verdict
            }
        };
        Outcome { number, preset, promise, evaluations, verdict }
    })
    .collect()
}

/// The largest difference from the references in units of three times their own and three standard errors.
fn compare(means: &Means, [a, b]: &[Means; 2]) -> Option<Apart> {
    let apart = |channel: usize| {
        let (x, a, b) = (means[channel]?, a[channel]?, b[channel]?);
        let error = (x.variance + 0.5 * (a.variance + b.variance)).sqrt();
        let allowed = 3.0 * (a.mean - b.mean).abs() + 3.0 * error + negligible(a.mean);
        let ratio = (x.mean - 0.5 * (a.mean + b.mean)).abs() / allowed;
        Some(Apart { ratio, channel, in_mean: false })
    };
    (0..CHANNELS.len()).filter_map(apart).max_by(|a, b| a.ratio.total_cmp(&b.ratio))
}

fn negligible(mean: f64) -> f64 {
    NEXT_TO_NOTHING * mean.abs().max(SMALL_RATIO)
}

/// Means of a channel over runs from several starts.
fn starts(run: impl Fn(f64) -> Option<Means>, channel: usize) -> Option<Sample> {
    let mean = |k: u32| Some(run(FURTHER * f64::from(k))?[channel]?.mean);
    Sample::of(&(1..=STARTS).map(mean).collect::<Option<Vec<f64>>>()?)
}

/// Means of all channels of scene `number` over `count` starts, with the presets.
///
/// # Errors
/// As the first run that fails.
pub fn over_starts(number: u64, count: u32, options: &Options) -> Result<Vec<OverStarts>, Error> {
    let scene = options.kind.scene(number, options.duration);
    let mut all = Vec::new();
    for (preset, _) in options.chosen() {
        let (mut columns, mut evaluations) = ([const { Vec::new() }; CHANNELS.len()], 0.0);
        for k in 1..=count {
            let (of_run, ran) = run(&scene, preset, FURTHER * f64::from(k), options);
            let (_, means) = ran?;
            evaluations += of_run as f64 / f64::from(count);
            columns
                .iter_mut()
                .zip(means)
                .for_each(|(column, mean)| column.extend(mean.map(|mean| mean.mean)));
        }
        for (channel, column) in CHANNELS.into_iter().zip(&columns) {
            let sample = Sample::of(column);
            all.extend(sample.map(|sample| OverStarts { preset, channel, sample, evaluations }));
        }
    }
    Ok(all)
}

/// Whether scatter does not explain the difference; so it is where there is nothing to compare.
fn differ(here: Option<Sample>, there: Option<Sample>) -> bool {
    let (Some(here), Some(there)) = (here, there) else { return true };
    let verdict = here.against(&there, LEVEL, MOST_CHANNELS);
    verdict.difference.abs() > verdict.band + negligible(there.mean)
}

type Means = [Option<Sample>; CHANNELS.len()];

/// Evaluations of a run, and what it came to.
type Ran = (u64, Result<(Verdict, Means), Error>);

fn run(scene: &Value, preset: &str, shift: f64, options: &Options) -> Ran {
    let mut scene = scene.clone();
    scene["solver"] = json!({"preset": preset});
    let sim = Model::from_json(&scene.to_string())
        .and_then(|model| Sim::with_tuning(Arc::new(model), options.tuning));
    match sim {
        Ok(mut sim) => {
            let ran = follow(&mut sim, &scene, shift, options);
            (sim.statistics().evaluations, ran)
        }
        Err(e) => (0, Err(e)),
    }
}

fn follow(sim: &mut Sim, scene: &Value, shift: f64, options: &Options) -> Result<(Verdict, Means), Error> {
    sim.set_wall_time_limit(options.wall_time)?;
    if shift > 0.0 {
        let mut state = sim.state().to_vec();
        let scales = sim.model().state_scales();
        state.iter_mut().zip(scales).for_each(|(x, scale)| *x += shift * scale);
        sim.set_state(0.0, &state)?;
    }
    let names: Vec<String> = sim.channels().iter().map(|channel| channel.name.clone()).collect();
    let places = CHANNELS.map(|name| names.iter().position(|n| n == name));
    let mut watch = Watch::new(scene, &names);
    let (mut out, mut columns) = (vec![0.0; names.len()], [const { Vec::new() }; CHANNELS.len()]);
    for i in 1..=RECORDS {
        sim.advance_to(options.duration * f64::from(i) / f64::from(RECORDS))?;
        if sim.statistics().evaluations > options.most_evaluations {
            let message =
                format!("more than {} evaluations at t = {} s", options.most_evaluations, sim.time());
            return Err(Error::new(Status::TooManySteps, message));
        }
        sim.outputs(&mut out)?;
        watch.see(&out);
        if 2 * i > RECORDS {
            for (column, place) in columns.iter_mut().zip(places) {
                column.extend(place.map(|k| out[k]));
            }
        }
    }
    let doubts = sim.doubts();
    if !doubts.is_empty() && doubts.iter().all(|doubt| matches!(doubt, Doubt::CreatedEnergy { .. })) {
        return Ok((Verdict::MadeEnergy(sim.report()), [None; CHANNELS.len()]));
    }
    let verdict = Verdict::Ran {
        residual: sim.power_balance()?.relative_residual(),
        trusted: doubts.is_empty(),
        apart: None,
        impossible: watch.list(scene["outer_ring"]["speed"] != Value::Null),
        report: sim.report(),
    };
    Ok((verdict, columns.map(|values| Sample::of_series(&values))))
}
