//! Runs of the scenes of the study and what they show.

use cagedyn::sim::RunStatistics;
use cagedyn::{Error, Model, Recording, Result, Scene, Sim, Status};
use cagedyn_studies::effects::count::States;
use cagedyn_studies::effects::rows::Row;
use std::path::Path;
use std::sync::Arc;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Runs per row, and of the unchanged scene; each starts with the elements turned on by `START_SHIFT` rad.
const RUNS: usize = 4;
const FULL_RUNS: usize = 10;
const START_SHIFT: f64 = 1e-3;
/// States kept for the measurements.
const STATES: usize = 20;
/// A change is beyond scatter from this many standard deviations of the difference of two runs on, if tables can
/// show it.
const BEYOND: f64 = 2.0;
/// Whirl has settled when its speed stays this near to its mean.
const SETTLED: f64 = 0.15;

/// A number that a run gives.
pub struct Quantity {
    /// Name and unit, for headings.
    pub name: &'static str,
    /// Decimals in tables.
    pub decimals: usize,
    value: fn(&Results<'_>) -> Option<f64>,
}

/// What is read from the runs of a scene.
pub struct Readings {
    /// Share of the run over which means are taken, at its end.
    pub window: f64,
    /// The numbers.
    pub quantities: &'static [Quantity],
}

/// Radial guide clearance of the NU2310 scene, m; the rows without a guide are measured by it, too.
const GUIDE_CLEARANCE: f64 = 0.2225e-3;

/// What is read from the runs of a scene, by its name.
pub fn readings(name: &str) -> Readings {
    if name == "nu2310" {
        Readings { window: 1.0 / 3.0, quantities: &NU2310 }
    } else {
        Readings { window: 0.5, quantities: &GREASE_GUIDE }
    }
}

const NU2310: [Quantity; 5] = [
    Quantity { name: "cage y/c", decimals: 3, value: |r| r.mean("cage.y").map(|y| y / GUIDE_CLEARANCE) },
    Quantity { name: "cage z/c", decimals: 3, value: |r| r.mean("cage.z").map(|z| z / GUIDE_CLEARANCE) },
    Quantity { name: "largest roller slip, %", decimals: 1, value: |r| r.largest_slip().map(|s| 100.0 * s) },
    Quantity { name: "cage slip, %", decimals: 2, value: |r| r.mean("cage.slip").map(|s| 100.0 * s) },
    Quantity { name: "drag torque, N m", decimals: 3, value: |r| r.mean("inner_ring.drag_torque") },
];

const GREASE_GUIDE: [Quantity; 5] = [
    Quantity { name: "whirl, rad/s", decimals: 0, value: |r| r.mean("cage.whirl_speed") },
    Quantity { name: "radius, um", decimals: 1, value: |r| r.mean("cage.whirl_radius").map(|x| 1e6 * x) },
    Quantity { name: "phi pressure, N", decimals: 3, value: |r| r.mean("guide.pressure_phi") },
    Quantity { name: "phi shear, N", decimals: 3, value: |r| r.mean("guide.shear_phi") },
    Quantity { name: "settled after, ms", decimals: 1, value: |r| r.settled("cage.whirl_speed") },
];

/// The recording of a run with the names of its columns.
struct Results<'a> {
    sim: &'a Sim,
    recording: &'a Recording,
    from: f64,
}

impl Results<'_> {
    fn column(&self, name: &str) -> Option<usize> {
        self.sim.channels().iter().position(|channel| channel.name == name)
    }

    fn mean(&self, name: &str) -> Option<f64> {
        Some(self.recording.spread(self.column(name)?, self.from)?.mean)
    }

    fn largest_slip(&self) -> Option<f64> {
        let channels = self.sim.channels().iter().enumerate();
        let slips = channels.filter(|(_, c)| c.name.starts_with("roller[") && c.name.ends_with("].slip"));
        slips.filter_map(|(i, _)| Some(self.recording.spread(i, self.from)?.max)).reduce(f64::max)
    }

    /// Time in ms after which a column stays near the mean of the window, unless that is within the window.
    fn settled(&self, name: &str) -> Option<f64> {
        let mean = self.mean(name)?;
        let values = &self.recording.columns[self.column(name)?];
        let far = |x: &f64| (x - mean).abs() > SETTLED * mean.abs();
        let time = self.recording.times.get(values.iter().rposition(far)? + 1)?;
        (*time < self.from).then_some(1e3 * time)
    }
}

/// One run.
struct Run {
    model: Option<Arc<Model>>,
    values: Vec<Option<f64>>,
    states: States,
    statistics: RunStatistics,
    simulated: f64,
    error: Option<Error>,
}

/// All runs of a row.
pub struct Outcome {
    /// The compiled scene, unless it is not valid.
    pub model: Option<Arc<Model>>,
    /// Mean and standard deviation of every quantity over the runs that have it.
    pub values: Vec<Option<(f64, f64)>>,
    /// States over the window of the first run.
    pub states: States,
    /// Counts of the first run.
    pub statistics: RunStatistics,
    /// How far the first run came, s.
    pub simulated: f64,
    /// Why a run ended early.
    pub error: Option<String>,
}

/// Runs the unchanged scene and then every row, on all cores.
///
/// # Errors
/// [`Status::File`] when the scene cannot be read.
pub fn run_all(scene: &Path, readings: &Readings, rows: &[Row]) -> Result<Vec<Outcome>> {
    let text = std::fs::read_to_string(scene)
        .map_err(|e| Error::new(Status::File, format!("{}: {e}", scene.display())))?;
    let sets: Vec<&[(&str, &str)]> = std::iter::once(&[][..]).chain(rows.iter().map(|row| row.set)).collect();
    let runs_of = |i: usize| if i == 0 { FULL_RUNS } else { RUNS };
    let tasks: Vec<(usize, usize)> =
        (0..sets.len()).flat_map(|i| (0..runs_of(i)).map(move |k| (i, k))).collect();
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, |n| n.get()) {
            scope.spawn(|| {
                while let Some(&(i, k)) = tasks.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let run = run(&text, sets[i], k, readings);
                    done.lock().unwrap_or_else(|e| e.into_inner()).push((i, k, run));
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap_or_else(|e| e.into_inner());
    done.sort_by_key(|(i, k, _)| (*i, *k));
    let mut outcomes: Vec<Vec<Run>> = sets.iter().map(|_| Vec::new()).collect();
    for (i, _, run) in done {
        outcomes[i].push(run);
    }
    Ok(outcomes.into_iter().filter_map(outcome).collect())
}

/// One run of a changed scene with the `k`-th start.
fn run(text: &str, set: &[(&str, &str)], k: usize, readings: &Readings) -> Run {
    let mut result = Run {
        model: None,
        values: vec![None; readings.quantities.len()],
        states: States::default(),
        statistics: RunStatistics::default(),
        simulated: 0.0,
        error: None,
    };
    if let Err(e) = try_run(text, set, k, readings, &mut result) {
        result.error = Some(e);
    }
    result
}

fn try_run(text: &str, set: &[(&str, &str)], k: usize, readings: &Readings, result: &mut Run) -> Result<()> {
    let mut scene = Scene::from_json_with(text, set.iter().copied())?;
    scene.initial.first_roller_angle += START_SHIFT * k as f64;
    let record = scene.record.clone();
    let model = Arc::new(Model::new(scene)?);
    result.model = Some(model.clone());
    let mut sim = Sim::new(model)?;
    let mut recording = Recording { columns: vec![Vec::new(); sim.channels().len()], ..Recording::default() };
    let mut row = vec![0.0; sim.channels().len()];
    let mut states = Vec::new();
    let last = (record.duration / record.interval).round() as usize;
    let mut ended = Ok(());
    for i in 0..=last {
        let t = (i as f64 * record.interval).min(record.duration);
        ended = sim.advance_to(t).and_then(|()| sim.outputs(&mut row));
        if ended.is_err() {
            break;
        }
        recording.times.push(t);
        for (column, value) in recording.columns.iter_mut().zip(&row) {
            column.push(*value);
        }
        states.push((t, sim.state().to_vec()));
    }
    result.simulated = sim.time();
    result.statistics = sim.statistics();
    // Evenly spread over the window.
    let first = ((1.0 - readings.window) * states.len() as f64) as usize;
    let pitch = (states.len() - first) as f64 / STATES as f64;
    result.states.0 = (0..STATES).map(|i| states[first + (pitch * i as f64) as usize].clone()).collect();
    if ended.is_ok() {
        let from = (1.0 - readings.window) * record.duration * (1.0 - 1e-9);
        let results = Results { sim: &sim, recording: &recording, from };
        result.values = readings.quantities.iter().map(|quantity| (quantity.value)(&results)).collect();
    }
    ended
}

/// Summary of the runs of a row; `None` without runs.
fn outcome(mut runs: Vec<Run>) -> Option<Outcome> {
    let error = runs.iter().find_map(|run| run.error.as_ref().map(|e| e.message.clone()));
    let values = (0..runs.first()?.values.len())
        .map(|i| {
            let values: Option<Vec<f64>> = runs.iter().map(|run| run.values[i]).collect();
            spread(&values?)
        })
        .collect();
    let first = runs.swap_remove(0);
    let Run { model, states, statistics, simulated, .. } = first;
    Some(Outcome { model, values, states, statistics, simulated, error })
}

/// Mean and standard deviation of a sample.
fn spread(values: &[f64]) -> Option<(f64, f64)> {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let square = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>();
    (n > 1.0).then(|| (mean, (square / (n - 1.0)).sqrt()))
}

/// Change of a quantity.
#[derive(Clone, Copy)]
pub struct Change {
    /// Mean of the row minus mean of the unchanged scene.
    pub difference: f64,
    /// The same in units of what counts as beyond scatter.
    pub significance: f64,
}

impl Outcome {
    /// Change of quantity `i`, shown with some decimals, against the unchanged scene.
    pub fn change(&self, full: &Outcome, i: usize, decimals: usize) -> Option<Change> {
        let ((value, deviation), (base, scatter)) = (self.values[i]?, full.values[i]?);
        let difference = value - base;
        let shown = 0.5 * 0.1_f64.powi(decimals as i32);
        let noise = shown.max(BEYOND * deviation.hypot(scatter));
        Some(Change { difference, significance: difference.abs() / noise })
    }
}
