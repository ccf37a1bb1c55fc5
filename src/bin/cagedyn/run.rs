//! The command `run`, and the simulation of one scene that `cases` shares with it.

use crate::results::facts;
use crate::results::files::to_json;
use crate::results::finished::{Notes, Run};
use crate::results::formats::{self, TableFormat};
use crate::results::stream::{self, Stream};
use crate::results::summary::Summary;
use crate::results::table::number;
use crate::results::{output, report};
use crate::starts::{self, Apart};
use crate::terminal::{self, INTERRUPTED, Progress};
use crate::workers;
use crate::{Instead, RunArgs, Sets};
use cagedyn::model::{LineLoad, PartTimes};
use cagedyn::scene::Record;
use cagedyn::{Error, Model, Recording, Result, Scene, Sim, Status};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

/// The parts of an evaluation are timed at about this many states of the run, this often.
const SAMPLES: f64 = 16.0;
const REPEATS: u32 = 10;

/// Tables above this size are made only when it is asked for, bytes.
pub const LARGEST_TABLE: f64 = 2e9;

/// What stands for standard input in place of a file.
const STANDARD_INPUT: &str = "-";

/// Exit code of runs that ended but are not to be trusted.
pub const UNTRUSTED: u8 = 3;

/// What to simulate, and what to call it.
pub struct Request<'a> {
    /// Scene.
    pub scene: Scene,
    /// File that it came from.
    pub file: &'a Path,
    /// Name of the case, in a case set.
    pub case: Option<&'a str>,
    /// Comment of the whole scene.
    pub comment: Option<Value>,
    /// Values that replaced those of the file, as `path=value`.
    pub set: Vec<String>,
    /// Folder for the results.
    pub folder: &'a Path,
    /// Formats of the time series.
    pub formats: &'a [TableFormat],
    /// Whether to say how large the table will be.
    pub aloud: bool,
}

/// Runs a scene, writes the results and prints the summary.
///
/// # Errors
/// A scene or folder that cannot be used. A failure during the run is printed here, after the results so far.
pub fn command(args: &RunArgs) -> Result<ExitCode> {
    let request = request(&args.scene, &args.sets, &args.instead, &args.out)?;
    let progress = Progress::new("run", request.scene.record.duration);
    let request = Request { aloud: !args.json, formats: &args.format, ..request };
    let performed = perform(request, &args.instead, &|t| progress.at(t));
    drop(progress);
    let (run, summary) =
        performed.map_err(|e| if e.status == Status::File { e } else { in_file(&args.scene, e) })?;
    if args.json {
        terminal::print(&to_json(&summary)?)?;
    } else {
        terminal::print(&report::text(&run, &summary, &args.out))?;
    }
    Ok(exit_code(&run))
}

/// What to run of a scene file, with results in `folder`. From here on Ctrl-C ends runs.
///
/// # Errors
/// A scene that cannot be used.
pub fn request<'a>(file: &'a Path, sets: &Sets, instead: &Instead, folder: &'a Path) -> Result<Request<'a>> {
    let text = read(file)?;
    // The time belongs to the values that are replaced: it must fit with all of them, not before them.
    let until = instead.until().map(|until| format!("{until:?}"));
    let replaced = sets.pairs().chain(until.as_deref().map(|until| ("record.duration", until)));
    let mut scene = Scene::from_json_with(&text, replaced).map_err(|e| in_file(file, e))?;
    instead.apply(&mut scene)?;
    terminal::listen_for_interrupt()?;
    let set = sets.pairs().map(|(path, value)| format!("{path}={value}")).collect();
    let formats = &[TableFormat::Csv];
    Ok(Request { scene, file, case: None, comment: comment(&text), set, folder, formats, aloud: false })
}

/// How a program ends after a run; what is wrong with it is printed.
pub fn exit_code(run: &Run) -> ExitCode {
    if let Some(failure) = &run.failure {
        terminal::complain(failure);
        return ExitCode::FAILURE;
    }
    if let Err(untrusted) = run.trust() {
        terminal::complain(&untrusted);
        return ExitCode::from(UNTRUSTED);
    }
    if run.interrupted { ExitCode::from(INTERRUPTED) } else { ExitCode::SUCCESS }
}

/// Simulates a scene until its end and writes the results into its folder: records as they come, the rest behind them. Only
/// what prevents the start, and files that cannot be written, are errors. `progress` is told the simulated time, s.
///
/// # Errors
/// As [`Model::new`], [`Sim::new`] and [`Sim::set_wall_time_limit`]; [`Status::File`]; [`Status::BadScene`] for a table that is
/// too large.
pub fn perform(request: Request<'_>, instead: &Instead, progress: &dyn Fn(f64)) -> Result<(Run, Summary)> {
    let Request { scene, file, case, comment, set, folder, formats, aloud } = request;
    let (duration, interval) = (scene.record.duration, scene.record.interval);
    let own = scene.title.clone();
    let title = match case {
        Some(case) => facts::title(own.as_deref(), case, &[]),
        None => facts::title(own.as_deref(), &stem(file), &set),
    };
    let model = Arc::new(Model::new(scene)?);
    let mut sim = Sim::new(model.clone())?;
    announce(&model, aloud, instead)?;
    for warning in model.scene().warnings() {
        terminal::warn(&case.map_or(warning.clone(), |case| format!("case {case}: {warning}")));
    }
    let limit = instead.max_wall_time.unwrap_or(f64::INFINITY);
    let apart = Apart { shift_m: instead.start_shift, spin_share: instead.start_spin };
    if instead.starts > 1 {
        starts::check(&mut sim, apart)?;
    }
    sim.set_wall_time_limit(limit)?;
    let taken = output::take(folder)?;
    output::begin(folder, &title, file, case, &set)?;
    output::write_scene(folder, model.scene(), &title, comment.as_ref())?;
    let mut stream = Stream::new(folder, taken, sim.channels(), model.recorded(), model.watched())?;
    terminal::stop_with(sim.canceller());
    let mut recording = Recording::default();
    let started = Instant::now();
    let mut samples: Vec<(f64, Vec<f64>)> = Vec::new();
    let (mut unwritten, mut notes) = (None, Notes::new(&model));
    let ended = recording.run(&mut sim, duration, interval, |sim, recording| {
        progress(sim.time());
        if sim.time() >= duration * samples.len() as f64 / SAMPLES {
            samples.push((sim.time(), sim.state().to_vec()));
        }
        notes.at(sim, recording);
        unwritten = stream.add(recording).err();
        unwritten.is_none() && !terminal::stop_requested()
    });
    // What was computed is not lost with the table.
    let written = unwritten.map_or_else(|| stream.finish(), Err);
    let wall = started.elapsed().as_secs_f64();
    let parts = sim.time_parts(&samples, REPEATS).unwrap_or_default();
    let mut run = finished(&mut sim, title, (recording, notes), (ended, written), (wall, parts));
    let mut summary = Summary::new(&run, file, case, set);
    if instead.starts > 1 && summary.complete {
        let count = usize::from(instead.starts);
        let threads = workers::threads(instead.jobs);
        let starts = starts::try_starts(&run.model, count, apart, run.window_start(), limit, threads)?;
        if starts.count < starts.asked {
            (run.interrupted, summary.interrupted, summary.complete) = (true, true, false);
        }
        summary.starts = Some(starts);
    }
    match if run.written { formats::write(&run, folder, formats) } else { Ok(Vec::new()) } {
        Ok(tables) if run.written => summary.files = tables.into_iter().map(str::to_owned).collect(),
        Ok(_) => {}
        Err(e) => run.failure = run.failure.or(Some(e)),
    }
    // The limit on the wall time is one on everything.
    let draw = started.elapsed().as_secs_f64() < limit;
    if let Err(e) = output::write(&run, &mut summary, folder, draw) {
        run.failure = run.failure.or(Some(e));
    }
    Ok((run, summary))
}

/// A run that has ended where `sim` is now. It is told how the run and its table ended, the wall time in s, and that of the parts of
/// an evaluation.
pub fn finished(
    sim: &mut Sim,
    title: String,
    (recording, notes): (Recording, Notes),
    (ended, written): (Result<()>, Result<()>),
    (wall, parts): (f64, PartTimes),
) -> Run {
    let model = sim.model().clone();
    let Record { duration, interval, .. } = model.scene().record;
    let cancelled = matches!(&ended, Err(e) if e.status == Status::Cancelled);
    let channels = model.recorded().iter().map(|i| sim.channels()[*i].clone()).collect();
    let interrupted = cancelled || terminal::stop_requested() && sim.time() < duration - interval;
    let whole = !interrupted && ended.is_ok();
    let ending =
        if whole { String::new() } else { format!("; incomplete, ended at {} s", number(sim.time())) };
    let (statistics, report, works) = (sim.statistics(), sim.report(), sim.works());
    let balance = sim.power_balance().ok();
    let (contacts_at, forces) = match &notes.strongest {
        Some((record, time, state)) => (*record, sim.forces_at(*time, state)),
        None => (recording.times.len().saturating_sub(1), sim.forces()),
    };
    let (contacts, contacts_in_space) = forces
        .map_or((Vec::new(), Vec::new()), |forces| (forces.contacts.clone(), forces.space.contacts.clone()));
    let line_loads = line_loads(sim);
    Run {
        title,
        facts: facts::facts(&model) + &ending,
        channels,
        parts,
        statistics,
        doubts: sim.doubts().iter().map(ToString::to_string).collect(),
        remarks: sim.remarks(),
        report,
        time: sim.time(),
        wall,
        written: written.is_ok(),
        interrupted,
        balance,
        contacts,
        contacts_in_space,
        contacts_at,
        line_loads,
        works,
        before: notes.works,
        failure: ended.err().filter(|e| e.status != Status::Cancelled).or(written.err()),
        model,
        recording,
    }
}

/// How rollers in space are loaded along their length where a simulation is now; nothing where forces are undefined.
fn line_loads(sim: &mut Sim) -> Vec<[Vec<LineLoad>; 2]> {
    let model = sim.model().clone();
    let in_space = model.scene().rollers.as_ref().is_some_and(|rollers| rollers.space.is_some());
    if !in_space {
        return Vec::new();
    }
    let names = model.contact_names();
    let mut of = |j: usize, raceway: &str| {
        let name = format!("roller[{j}].{raceway}");
        sim.line_loads(names.iter().position(|contact| *contact == name)?).ok()
    };
    let pair = |j: usize| Some([of(j, "outer_raceway")?, of(j, "inner_raceway")?]);
    (0..model.element_count()).map(pair).collect::<Option<_>>().unwrap_or_default()
}

/// Size of the table of a run in bytes, a little more than it takes, and in words.
pub fn table_size(model: &Model) -> (f64, String) {
    let record = &model.scene().record;
    let columns = 1 + stream::columns(model.recorded().len(), model.watched().len());
    let records = (record.duration / record.interval * (1.0 + 1e-12)).floor() + 1.0;
    let bytes = records * columns as f64 * stream::NUMBER_LENGTH;
    let megabytes = (1e-6 * bytes).ceil();
    (bytes, format!("a table of {records} records in {columns} columns, up to {megabytes} MB"))
}

/// Says how large the table of a run will be, and refuses one that nobody can have meant.
fn announce(model: &Model, aloud: bool, instead: &Instead) -> Result<()> {
    let record = &model.scene().record;
    let (bytes, text) = table_size(model);
    if bytes > LARGEST_TABLE && !instead.large_table {
        let text =
            format!("record.interval: {:?} s makes {text}; --large-table if that is meant", record.interval);
        return Err(Error::new(Status::BadScene, text));
    }
    if aloud {
        terminal::print(&format!("writing {text}\n"))?;
    }
    Ok(())
}

/// Comment of the whole scene, which the scene itself does not keep.
pub fn comment(text: &str) -> Option<Value> {
    serde_json::from_str::<Value>(text).ok()?.get("comment").cloned()
}

/// The text of a file.
///
/// # Errors
/// [`Status::File`].
pub fn read(path: &Path) -> Result<String> {
    if path == Path::new(STANDARD_INPUT) {
        return std::io::read_to_string(std::io::stdin())
            .map_err(|e| Error::new(Status::File, format!("standard input: {e}")));
    }
    fs::read_to_string(path).map_err(|e| Error::new(Status::File, format!("{}: {e}", path.display())))
}

/// The failure with the name of the file that caused it in front.
pub fn in_file(path: &Path, e: Error) -> Error {
    Error::new(e.status, format!("{}: {}", path.display(), e.message))
}

/// File name without folder and ending, for files without a title.
pub fn stem(path: &Path) -> String {
    path.file_stem().map_or_else(|| "scene".to_owned(), |s| s.to_string_lossy().into_owned())
}
