//! The command `sweep`.

mod args;
mod grid;
pub mod merge;
mod pictures;
mod portion;
mod store;
mod table;

pub use args::{MergeArgs, SweepArgs};
pub use grid::{Vary, parse_vary, points};

use crate::points::Row;
use crate::points::spectrum::Spectrum;
use crate::results::facts;
use crate::results::files::{to_json, write_csv, write_text, write_with};
use crate::results::finished::Notes;
use crate::results::formats::parquet;
use crate::results::summary::Summary;
use crate::run::{self, LARGEST_TABLE, in_file};
use crate::terminal::{self, INTERRUPTED, Part, Together};
use crate::workers;
use cagedyn::model::PartTimes;
use cagedyn::scene::Record;
use cagedyn::{Error, Model, Recording, Result, Scene, Sim, Status};
use grid::Values;
use serde_json::{Value, json};
use std::collections::HashSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use store::Store;
use table::Table;

/// Of more points than this the longest do not come first: what the last of them costs is little beside all.
const ORDERED: usize = 1000;

/// What `sweep.json` has of the program that wrote it.
const PROGRAM: [(&str, &str); 3] =
    [("schema", "cagedyn.sweep/2"), ("version", env!("CARGO_PKG_VERSION")), ("build", env!("CAGEDYN_BUILD"))];
/// What it has of a part beside what all parts have: which one it is, and the name of the scene file, which titles have.
const PART: &str = "part";
const SCENE_FILE: &str = "scene_file";

/// A sweep that can be run.
struct Sweep<'a> {
    args: &'a SweepArgs,
    /// Text of the scene.
    text: String,
    /// Varied values of every point.
    points: Vec<Vec<String>>,
}

/// Runs the points of a sweep that are not done yet, and writes their table.
///
/// # Errors
/// A scene, values or a folder that cannot be used; points and tables that cannot be written. A point that fails is a row.
pub fn command(args: &SweepArgs) -> Result<ExitCode> {
    let sweep = Sweep::new(args, run::read(&args.scene)?)?;
    terminal::listen_for_interrupt()?;
    let store = Store::open(&args.out, &to_json(&sweep.identity()?)?)?;
    let stored = sweep.own().filter_map(|point| Some((point, store.row(point, &sweep.points[point])?)));
    let rows = stored.collect();
    sweep.complete(&store, rows)
}

impl<'a> Sweep<'a> {
    /// Checks that every varied value is one of the scene, and that some point can be simulated.
    fn new(args: &'a SweepArgs, text: String) -> Result<Self> {
        let varied = |path: &str| args.vary.iter().any(|one| one.path == path);
        let doubled = |given: bool, path: &str, option: &str| {
            let text = format!("--vary: {path} is what {option} replaces, too");
            if given && varied(path) { Err(Error::new(Status::BadValue, text)) } else { Ok(()) }
        };
        doubled(args.until.is_some(), "record.duration", "--until")?;
        doubled(args.preset.is_some(), "solver.preset", "--preset")?;
        args.sets.pairs().try_for_each(|(path, _)| doubled(true, path, "--set"))?;
        let points = points(&args.vary, args.latin, args.seed)?;
        if let Some(part) = args.part.filter(|part| part.count > points.len()) {
            let text = format!("--part: {part} of {} points; at most as many parts as points", points.len());
            return Err(Error::new(Status::BadValue, text));
        }
        let sweep = Self { args, text, points };
        let (mut first, mut valid, mut listed) = (None, false, HashSet::new());
        for (point, values) in sweep.points.iter().enumerate() {
            // What is no value of the scene is one of a list; it is told before the first run.
            let lists = args.vary.iter().zip(values).filter(|(one, _)| matches!(one.values, Values::List(_)));
            let new = lists.fold(false, |new, (one, value)| listed.insert((&one.path, value)) || new);
            if valid && !new {
                continue;
            }
            match sweep.scene(values) {
                Err(e) if e.status == Status::BadScene => first = first.or(Some((point, e))),
                Err(e) => return Err(in_file(&args.scene, e)),
                Ok(_) => valid = true,
            }
        }
        let Some((point, e)) = first.filter(|_| !valid) else { return Ok(sweep) };
        let text = format!("no point can be simulated; point {point} ({}): {e}", sweep.in_words(point));
        Err(in_file(&args.scene, Error::new(e.status, text)))
    }

    /// Runs what is not among these rows, and writes the table of all.
    fn complete(&self, store: &Store, mut rows: Vec<(usize, Row)>) -> Result<ExitCode> {
        let all = self.own().count();
        let part = self.args.part.map_or(String::new(), |part| format!("part {part}: "));
        terminal::print(&format!("{part}{all} points, {} of them done\n", rows.len()))?;
        let written = self.run(store, &mut rows);
        rows.sort_by_key(|(i, _)| *i);
        let goes_on =
            format!("{} of {all} points are kept, and the same command goes on with the others", rows.len());
        written.map_err(|e| Error::new(e.status, format!("{e}; {goes_on}")))?;
        let table = Table::new(&self.args.vary, &rows);
        if rows.len() < all {
            write_csv(&self.args.out.join(store::UNFINISHED), table.csv())?;
            terminal::print(&format!("interrupted: {goes_on}\ntable so far: {}\n", store::UNFINISHED))?;
            return Ok(ExitCode::from(INTERRUPTED));
        }
        let files = self.write(&table, &rows)?;
        self.tell(&rows, &files)
    }

    /// Prints how the points ended, and which files there are.
    fn tell(&self, rows: &[(usize, Row)], files: &[&str]) -> Result<ExitCode> {
        let all = rows.len();
        let failed: Vec<&(usize, Row)> = rows.iter().filter(|(_, row)| row.error.is_some()).collect();
        let untrusted = rows.iter().filter(|(_, row)| row.trusted == Some(false)).count();
        terminal::print(&format!(
            "{} complete, {} failed, {untrusted} not to be trusted\nfiles: {}: {}\n",
            all - failed.len(),
            failed.len(),
            self.args.out.display(),
            files.join(", ")
        ))?;
        if let Some((point, row)) = failed.first() {
            let (_, why) = row.error.clone().unwrap_or_default();
            let text = format!(
                "{} of {all} points failed; point {point} ({}): {why}",
                failed.len(),
                self.in_words(*point)
            );
            terminal::complain(&in_file(&self.args.scene, Error::new(Status::BadScene, text)));
            return Ok(ExitCode::FAILURE);
        }
        Ok(if untrusted > 0 { ExitCode::from(run::UNTRUSTED) } else { ExitCode::SUCCESS })
    }

    /// The points that are run here: those of the part, or all.
    fn own(&self) -> impl Iterator<Item = usize> {
        let part = self.args.part;
        (0..self.points.len()).filter(move |point| part.is_none_or(|part| part.has(*point)))
    }

    /// The scene of a point.
    fn scene(&self, values: &[String]) -> Result<Scene> {
        let until = self.args.until.map(|until| format!("{until:?}"));
        let until = until.as_deref().map(|until| ("record.duration", until));
        let varied =
            self.args.vary.iter().zip(values).map(|(one, value)| (one.path.as_str(), value.as_str()));
        let mut scene = Scene::from_json_with(&self.text, self.args.sets.pairs().chain(varied).chain(until))?;
        scene.solver.preset = self.args.preset.unwrap_or(scene.solver.preset);
        scene.validate()?;
        Ok(scene)
    }

    /// All that the results depend on, and which part of them is made.
    fn identity(&self) -> Result<Value> {
        let scene: Value = serde_json::from_str(self.text.trim_start_matches('\u{feff}'))
            .map_err(|e| in_file(&self.args.scene, Error::new(Status::BadJson, e.to_string())))?;
        let [schema, version, build] = PROGRAM.map(|(_, value)| value);
        let mut identity = json!({
            "schema": schema,
            "version": version,
            "build": build,
            "scene": scene,
            "set": self.sets(),
            "vary": self.args.vary.iter().map(|one| &one.given).collect::<Vec<_>>(),
            "latin": self.args.latin,
            "seed": self.args.latin.map(|_| self.args.seed),
            "until": self.args.until,
            "preset": self.args.preset.map(|preset| preset.name()),
        });
        if let Some(part) = self.args.part {
            identity[PART] = json!(part.to_string());
            identity[SCENE_FILE] = json!(self.args.scene.file_name().map(|name| name.to_string_lossy()));
        }
        Ok(identity)
    }

    fn sets(&self) -> Vec<String> {
        self.args.sets.pairs().map(|(path, value)| format!("{path}={value}")).collect()
    }

    /// "cage.mass = 0.3, gravity = null".
    fn in_words(&self, point: usize) -> String {
        let values = self.args.vary.iter().zip(&self.points[point]);
        values.map(|(one, value)| format!("{} = {value}", one.path)).collect::<Vec<_>>().join(", ")
    }

    /// Runs what is not among the rows, until an interrupt, and keeps each of them at once.
    fn run(&self, store: &Store, rows: &mut Vec<(usize, Row)>) -> Result<()> {
        let order = self.order(rows);
        let failed = rows.iter().filter(|(_, row)| row.error.is_some()).count();
        let together = Together::new(self.own().count(), rows.len(), failed);
        let work = |point: usize| {
            if terminal::stop_requested() {
                return None;
            }
            let part = together.begin();
            let row = self.row(point, &part)?;
            part.end(row.error.is_some());
            Some(row)
        };
        let mut written = Ok(());
        workers::share(&order, workers::threads(self.args.jobs), work, |point, row| {
            written = store.keep(point, &row);
            if written.is_ok() {
                rows.push((point, row));
            } else {
                terminal::stop_all();
            }
            written.is_ok()
        });
        written
    }

    /// The points that are not done, those that take longest first.
    fn order(&self, rows: &[(usize, Row)]) -> Vec<usize> {
        let mut done = vec![false; self.points.len()];
        rows.iter().for_each(|(point, _)| done[*point] = true);
        let left: Vec<usize> = self.own().filter(|point| !done[*point]).collect();
        if left.len() > ORDERED {
            return left;
        }
        let scenes = left.iter().filter_map(|point| Some((*point, self.scene(&self.points[*point]).ok()?)));
        let (valid, scenes): (Vec<usize>, Vec<Scene>) = scenes.unzip();
        let longest = workers::longest_first(&scenes).into_iter().map(|place| valid[place]);
        // What is refused takes no time.
        longest.chain(left.iter().copied().filter(|point| !valid.contains(point))).collect()
    }

    /// Simulates a point; `None` if it was interrupted.
    fn row(&self, point: usize, part: &Part<'_>) -> Option<Row> {
        let values = &self.points[point];
        let simulated = catch_unwind(AssertUnwindSafe(|| self.simulate(values, part)));
        // A defect in one must not stop the others.
        let defect = |_| Err(Error::new(Status::Internal, "internal defect"));
        simulated.unwrap_or_else(defect).unwrap_or_else(|e| Some(Row::failed(values.clone(), None, &e)))
    }

    fn simulate(&self, values: &[String], part: &Part<'_>) -> Result<Option<Row>> {
        let model = Arc::new(Model::new(self.scene(values)?)?);
        let Record { duration, interval, .. } = model.scene().record;
        let (bytes, size) = run::table_size(&model);
        if bytes > LARGEST_TABLE {
            let text =
                format!("record.interval: {interval:?} s makes {size}; a sweep takes 2 GB for each point");
            return Err(Error::new(Status::BadScene, text));
        }
        let mut sim = Sim::new(model)?;
        terminal::stop_with(sim.canceller());
        let mut recording = Recording::default();
        let mut notes = Notes::new(sim.model());
        let ended = recording.run(&mut sim, duration, interval, |sim, recording| {
            notes.at(sim, recording);
            part.at(sim.time() / duration);
            !terminal::stop_requested()
        });
        let spent = (0.0, PartTimes::default());
        let run = run::finished(&mut sim, String::new(), (recording, notes), (ended, Ok(())), spent);
        Ok(match &run.failure {
            _ if run.interrupted => None,
            Some(e) => Some(Row::failed(values.to_vec(), Some(run.time), e)),
            None => {
                let summary = Summary::new(&run, &self.args.scene, None, Vec::new());
                let spectrum = self.over_one_number().then(|| Spectrum::of(&run, &summary)).flatten();
                Some(Row { spectrum, ..Row::complete(values.to_vec(), &summary) })
            }
        })
    }

    /// Whether one number is varied, over which spectra are shown.
    fn over_one_number(&self) -> bool {
        matches!(&self.args.vary[..], [one] if one.values.numeric())
    }

    /// Writes tables and pictures, of a part its table alone; names of the files.
    fn write(&self, table: &Table, rows: &[(usize, Row)]) -> Result<Vec<&'static str>> {
        let folder = &self.args.out;
        let files = match self.args.part {
            Some(_) => {
                write_csv(&folder.join(store::PART_TABLE), table.csv()).map(|()| vec![store::PART_TABLE])
            }
            None => self.write_all(folder, table, rows),
        }?;
        std::fs::remove_file(folder.join(store::UNFINISHED)).ok();
        Ok(files)
    }

    fn write_all(&self, folder: &Path, table: &Table, rows: &[(usize, Row)]) -> Result<Vec<&'static str>> {
        write_csv(&folder.join(store::TABLE), table.csv())?;
        let columns = table.parquet();
        write_with(&folder.join(store::PARQUET), |file| parquet::write(file, table.length(), &columns))?;
        let mut files = vec![store::TABLE, store::PARQUET];
        let scene = self.scene(&self.points[0]).ok();
        let own = scene.and_then(|scene| scene.title);
        let varied = self.args.vary.iter().map(|one| one.given.clone());
        let set: Vec<String> = self.sets().into_iter().chain(varied).collect();
        let title = facts::title(own.as_deref(), &run::stem(&self.args.scene), &set);
        if let Some(picture) = pictures::picture(&title, self.args, rows) {
            write_text(&folder.join(store::PICTURE), &picture?)?;
            files.push(store::PICTURE);
        }
        if let Some(spectra) = table::spectra(&self.args.vary, rows) {
            write_csv(&folder.join(store::SPECTRA), spectra)?;
            write_text(&folder.join(store::WATERFALL), &pictures::waterfall(&title, self.args, rows)?)?;
            files.extend([store::SPECTRA, store::WATERFALL]);
        }
        Ok(files)
    }
}
