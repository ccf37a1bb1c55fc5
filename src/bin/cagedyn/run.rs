//! The command `run`, and the simulation of one scene that `cases` shares with it.

use crate::summary::Summary;
use crate::terminal::{self, INTERRUPTED, Progress};
use crate::{RunArgs, output, report};
use cagedyn::model::{Channel, PartTimes};
use cagedyn::scene::GuideRing;
use cagedyn::sim::{PowerBalance, RunStatistics};
use cagedyn::{Error, Model, Recording, Result, Scene, Sim, Status};
use std::fs;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

/// Length of the window over which results are averaged and details are shown, s.
const WINDOW: f64 = 0.1;
/// Share of the run that the window covers at most: what comes before is the start.
const LARGEST_WINDOW_SHARE: f64 = 1.0 / 3.0;

/// The parts of an evaluation are timed at about this many states of the run, this often.
const SAMPLES: f64 = 16.0;
const REPEATS: u32 = 200;

/// Exit code of runs that ended but are not to be trusted.
pub const UNTRUSTED: u8 = 3;

/// A run that has ended: by itself, by Ctrl-C or by a failure.
pub struct Run {
    /// Title for tables and pictures.
    pub title: String,
    /// The compiled scene.
    pub model: Arc<Model>,
    /// What was recorded.
    pub recording: Recording,
    /// The columns of the recording.
    pub channels: Vec<Channel>,
    /// Wall time of the parts of one force evaluation, s.
    pub parts: PartTimes,
    /// Counts.
    pub statistics: RunStatistics,
    /// Works and energies, if forces are defined at the end.
    pub balance: Option<PowerBalance>,
    /// What speaks against trusting the run.
    pub doubts: Vec<String>,
    /// What the integration did and why.
    pub report: String,
    /// Simulated time, s.
    pub time: f64,
    /// Wall time of the simulation, s.
    pub wall: f64,
    /// Whether Ctrl-C ended it.
    pub interrupted: bool,
    /// The failure that ended it.
    pub failure: Option<Error>,
}

impl Run {
    /// An error with all doubts, if there are any.
    pub fn trust(&self) -> Result<()> {
        if self.doubts.is_empty() {
            return Ok(());
        }
        let text = format!("{}: not to be trusted: {}", self.title, self.doubts.join("; "));
        Err(Error::new(Status::Untrusted, text))
    }

    /// Values of a channel, if the scene has it.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let index = self.channels.iter().position(|c| c.name == name)?;
        Some(self.recording.columns.get(index)?.as_slice())
    }

    /// Start of the averaging window, s: the last 0.1 s, or the last third of a shorter run.
    pub fn window_start(&self) -> f64 {
        self.last(WINDOW.min(LARGEST_WINDOW_SHARE * self.end()))
    }

    /// Start of the last `length` seconds, at least zero. A little earlier, so that round-off loses no record.
    pub fn last(&self, length: f64) -> f64 {
        (self.end() - length - 1e-6 * self.interval()).max(0.0)
    }

    /// Time between records, s.
    pub fn interval(&self) -> f64 {
        self.model.scene().record.interval
    }

    /// Time of the last record, s.
    pub fn end(&self) -> f64 {
        self.recording.times.last().copied().unwrap_or(0.0)
    }

    /// Number of rollers with a motion of their own.
    pub fn roller_count(&self) -> usize {
        self.model.layout().count
    }

    /// Cage centre (y, z) relative to the guide centre over time, m, if there is a cage.
    pub fn cage_centre(&self) -> Option<[Vec<f64>; 2]> {
        let guide = self.model.scene().cage.as_ref()?.guide.as_ref();
        let moving = guide.is_some_and(|g| g.ring == GuideRing::InnerRing);
        let relative = |cage: &str, ring: &str| {
            let cage = self.column(cage)?;
            let ring = self.column(ring).filter(|_| moving);
            Some(cage.iter().enumerate().map(|(i, x)| x - ring.map_or(0.0, |r| r[i])).collect())
        };
        Some([relative("cage.y", "inner_ring.y")?, relative("cage.z", "inner_ring.z")?])
    }
}

/// Runs a scene, writes the results and prints the summary.
///
/// # Errors
/// A scene or folder that cannot be used. A failure during the run is printed here, after the results so far.
pub fn command(args: &RunArgs) -> Result<ExitCode> {
    let text = read(&args.scene)?;
    let mut scene = Scene::from_json_with(&text, args.sets.pairs()).map_err(|e| in_file(&args.scene, e))?;
    args.instead.apply(&mut scene);
    terminal::listen_for_interrupt()?;
    make_folder(&args.out)?;
    let run = simulate(scene, &stem(&args.scene), "run", args.instead.max_wall_time)
        .map_err(|e| in_file(&args.scene, e))?;
    let set = args.sets.pairs().map(|(path, value)| format!("{path}={value}")).collect();
    let mut summary = Summary::new(&run, &args.scene, None, set);
    output::write(&run, &mut summary, &args.out)?;
    terminal::print(&report::text(&run, &summary, &args.out))?;
    if let Some(failure) = &run.failure {
        terminal::complain(failure);
        return Ok(ExitCode::FAILURE);
    }
    if let Err(untrusted) = run.trust() {
        terminal::complain(&untrusted);
        return Ok(ExitCode::from(UNTRUSTED));
    }
    Ok(if run.interrupted { ExitCode::from(INTERRUPTED) } else { ExitCode::SUCCESS })
}

/// Simulates a scene until its end or for `max_wall_time` s. Only what prevents the start is an error.
///
/// # Errors
/// As [`Model::new`], [`Sim::new`] and [`Sim::set_wall_time_limit`].
pub fn simulate(scene: Scene, fallback_title: &str, label: &str, max_wall_time: Option<f64>) -> Result<Run> {
    let (duration, interval) = (scene.record.duration, scene.record.interval);
    let title = scene.title.clone().unwrap_or_else(|| fallback_title.to_owned());
    let model = Arc::new(Model::new(scene)?);
    let mut sim = Sim::new(model.clone())?;
    sim.set_wall_time_limit(max_wall_time.unwrap_or(f64::INFINITY))?;
    terminal::stop_with(sim.canceller());
    let progress = Progress::new(label, duration);
    let mut recording = Recording::default();
    let started = Instant::now();
    let mut samples: Vec<(f64, Vec<f64>)> = Vec::new();
    let ended = recording.run(&mut sim, duration, interval, |sim| {
        progress.at(sim.time());
        if sim.time() >= duration * samples.len() as f64 / SAMPLES {
            samples.push((sim.time(), sim.state().to_vec()));
        }
        !terminal::stop_requested()
    });
    let cancelled = matches!(&ended, Err(e) if e.status == Status::Cancelled);
    let wall = started.elapsed().as_secs_f64();
    let parts = sim.time_parts(&samples, REPEATS).unwrap_or_default();
    Ok(Run {
        title,
        channels: sim.channels().to_vec(),
        parts,
        statistics: sim.statistics(),
        doubts: sim.doubts().iter().map(ToString::to_string).collect(),
        report: sim.report(),
        time: sim.time(),
        wall,
        interrupted: cancelled || terminal::stop_requested() && sim.time() < duration - interval,
        balance: sim.power_balance().ok(),
        failure: ended.err().filter(|e| e.status != Status::Cancelled),
        model,
        recording,
    })
}

/// The text of a file.
///
/// # Errors
/// [`Status::File`].
pub fn read(path: &Path) -> Result<String> {
    fs::read_to_string(path).map_err(|e| Error::new(Status::File, format!("{}: {e}", path.display())))
}

/// Makes a folder and those above it.
///
/// # Errors
/// [`Status::File`].
pub fn make_folder(path: &Path) -> Result<()> {
    fs::create_dir_all(path).map_err(|e| Error::new(Status::File, format!("{}: {e}", path.display())))
}

/// The failure with the name of the file that caused it in front.
pub fn in_file(path: &Path, e: Error) -> Error {
    Error::new(e.status, format!("{}: {}", path.display(), e.message))
}

/// File name without folder and ending, for files without a title.
pub fn stem(path: &Path) -> String {
    path.file_stem().map_or_else(|| "scene".to_owned(), |s| s.to_string_lossy().into_owned())
}
