//! The command `cases`.

pub mod rollers;
mod series;
pub mod whirl;

use crate::CasesArgs;
use crate::results::files::UNFINISHED;
use crate::results::finished::Run;
use crate::results::formats::TableFormat;
use crate::results::summary::Summary;
use crate::results::table::{self, Align, rounded};
use crate::results::{files, output};
use crate::run::{self, Request, in_file};
use crate::starts::Starts;
use crate::terminal::{self, INTERRUPTED, Part, Together};
use crate::workers;
use cagedyn::model::{HostInputs, Input};
use cagedyn::scene::{Case, CaseSet};
use cagedyn::{CageMotion, Result, Scene};
use rollers::ROLLERS;
use serde_json::Value;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use whirl::WHIRL;

/// Name and unit of a channel.
type Known<'a> = (&'static str, &'a str);

/// What is compared: a printed table, a file and a picture.
struct Comparison {
    /// Columns of the printed table behind the name of the case: heading, narrowest width.
    columns: &'static [(&'static str, usize)],
    /// Their cells.
    cells: fn(&Summary) -> Vec<String>,
    /// Channels whose means are in the file, where a case has them.
    channels: &'static [&'static str],
    /// Columns of the file, given these channels with their units.
    csv_columns: fn(&[Known<'_>]) -> Vec<String>,
    /// Their cells.
    csv_cells: fn(&Summary, &[Known<'_>]) -> Vec<String>,
    /// File name of the picture.
    picture_name: &'static str,
    /// The picture with a title, if there is something to show.
    picture: fn(&str, &[Done<'_>]) -> Option<Result<String>>,
}

/// A case that was run, or could not be.
struct Done<'a> {
    /// Its place in the set.
    place: usize,
    case: &'a Case,
    /// Inner ring speed at the end, 1/min, without sign.
    speed: f64,
    /// Results; none of a case that did not start.
    summary: Option<Summary>,
    /// Why the case did not come to its end.
    error: Option<String>,
    /// Why it failed, if it did.
    failure: Option<cagedyn::Error>,
    /// Whether to trust it.
    trust: Result<()>,
}

impl Done<'_> {
    /// Results of a complete case: what a case that failed has reached says nothing beside the others.
    fn results(&self) -> Option<&Summary> {
        self.summary.as_ref().filter(|_| self.error.is_none())
    }
}

/// Runs all cases, writes their results and a comparison. A case that fails is reported and the others go on.
///
/// # Errors
/// Files and scenes that cannot be used; they are found before the first run.
pub fn command(args: &CasesArgs) -> Result<ExitCode> {
    let set = CaseSet::from_json(&run::read(&args.file)?).map_err(|e| in_file(&args.file, e))?;
    let base = args.file.parent().unwrap_or(Path::new("")).join(&set.scene);
    let text = run::read(&base)?;
    let comment = run::comment(&text);
    let scenes = set.scenes(&text).map_err(|e| in_file(&args.file, e))?;
    terminal::listen_for_interrupt()?;
    let taken = output::take(&args.out)?;
    // Without rollers that move freely, what matters is the whirl of the cage.
    let whirl = scenes.iter().all(|scene| scene.kinematic_elements.is_some());
    let comparison = if whirl { WHIRL } else { ROLLERS };
    let widths = widths(comparison.columns, &set);
    let headings = comparison.columns.iter().map(|(name, _)| (*name).to_owned());
    print_row("case", headings.chain([WALL_TIME.0.to_owned(), String::new()]), &widths)?;
    let order = workers::longest_first(&scenes);
    let together = Together::new(scenes.len(), 0, 0);
    // Starts of one case share the threads, cases only without them.
    let threads = if args.instead.starts > 1 { 1 } else { workers::threads(args.instead.jobs) };
    let run = |i: usize| {
        let (case, scene) = (&set.cases[i], scenes[i].clone());
        (!terminal::stop_requested()).then(|| {
            let part = together.begin();
            let done = run_case(args, (&base, comment.clone()), i, case, scene, &part);
            part.end(done.error.is_some());
            done
        })
    };
    let (mut tally, mut written) = (Tally::default(), Ok(()));
    // A set that is ended before its first case has a table, too.
    write_comparison(args, &set, &comparison, &[])?;
    workers::share(&order, threads, run, |_, done| {
        written = tally.add(args, &set, &comparison, done).and_then(|()| {
            // In the order of the set: what is behind a case that runs waits for it.
            while tally.done.get(tally.printed).is_some_and(|done| done.place == tally.printed) {
                tally.print_next(args, &comparison, &widths)?;
            }
            Ok(())
        });
        if written.is_err() {
            terminal::stop_all();
        }
        written.is_ok()
    });
    written?;
    // What came to its end behind one that an interrupt left out.
    while tally.printed < tally.done.len() {
        tally.print_next(args, &comparison, &widths)?;
    }
    let Tally { failed, untrusted, files, .. } = tally;
    drop((taken, together));
    std::fs::remove_file(args.out.join(UNFINISHED)).ok();
    terminal::print(&format!("\nfiles: {}: {}\n", args.out.display(), files.join(", ")))?;
    Ok(match (terminal::stop_requested(), failed) {
        (true, _) => ExitCode::from(INTERRUPTED),
        (_, true) => ExitCode::FAILURE,
        _ if untrusted => ExitCode::from(run::UNTRUSTED),
        _ => ExitCode::SUCCESS,
    })
}

/// Cases that are done, in the order of the set, and what is to be said of all.
#[derive(Default)]
struct Tally<'a> {
    done: Vec<Done<'a>>,
    /// Number of those that were printed.
    printed: usize,
    failed: bool,
    untrusted: bool,
    files: Vec<&'static str>,
}

impl<'a> Tally<'a> {
    /// Adds a case and writes the comparison with it: what is done is not lost when the rest is.
    fn add(
        &mut self,
        args: &CasesArgs,
        set: &CaseSet,
        comparison: &Comparison,
        done: Done<'a>,
    ) -> Result<()> {
        self.failed |= done.failure.is_some();
        self.untrusted |= done.trust.is_err();
        let at = self.done.partition_point(|other| other.place < done.place);
        self.done.insert(at, done);
        self.files = write_comparison(args, set, comparison, &self.done)?;
        Ok(())
    }

    /// Prints the next case, and what is wrong with it.
    fn print_next(&mut self, args: &CasesArgs, comparison: &Comparison, widths: &[usize]) -> Result<()> {
        let done = &self.done[self.printed];
        self.printed += 1;
        done.failure.iter().chain(done.trust.as_ref().err()).for_each(|e| report(args, done.case, e));
        let empty = || vec!["-".to_owned(); comparison.columns.len()];
        let cells = done.results().map_or_else(empty, comparison.cells);
        let wall = done.summary.as_ref().map_or("-".to_owned(), |s| format!("{:.2}", s.wall_time_s));
        let state = match (&done.failure, &done.error) {
            (Some(_), _) => "failed".to_owned(),
            (None, Some(error)) => error.clone(),
            (None, None) => {
                done.results().and_then(|s| s.starts.as_ref()).map_or(String::new(), Starts::in_words)
            }
        };
        print_row(&done.case.name, cells.into_iter().chain([wall, state]), widths)
    }
}

/// Runs one case and writes its files; `base` is the file of the base scene, with its comment.
fn run_case<'a>(
    args: &CasesArgs,
    (base, comment): (&Path, Option<Value>),
    place: usize,
    case: &'a Case,
    mut scene: Scene,
    part: &Part<'_>,
) -> Done<'a> {
    let folder: PathBuf = args.out.join(&case.name);
    if !case.set.keys().any(|path| path == "title") {
        // The title of the base scene tells of other values.
        scene.title = None;
    }
    let set = case.set.iter().map(|(path, value)| format!("{path}={value}")).collect();
    let performed = args.instead.apply(&mut scene).and_then(|()| {
        let duration = scene.record.duration;
        let formats = &[TableFormat::Csv];
        let request = Request {
            scene,
            file: base,
            case: Some(&case.name),
            comment,
            set,
            folder: &folder,
            aloud: false,
            formats,
        };
        run::perform(request, &args.instead, &|t| part.at(t / duration))
    });
    match performed {
        Ok((run, summary)) => {
            let interrupted = run.interrupted.then(|| "interrupted".to_owned());
            let error = run.failure.as_ref().map(|e| e.message.clone()).or(interrupted);
            let (speed, trust) = (speed_at_end(&run), run.trust());
            Done { place, case, speed, summary: Some(summary), error, failure: run.failure, trust }
        }
        Err(e) => {
            let error = Some(e.message.clone());
            Done { place, case, speed: f64::NAN, summary: None, error, failure: Some(e), trust: Ok(()) }
        }
    }
}

fn speed_at_end(run: &Run) -> f64 {
    run.model.inputs_at(run.time, &HostInputs::default()).of(Input::RingSpeed).abs() * 60.0 / TAU
}

fn report(args: &CasesArgs, case: &Case, e: &cagedyn::Error) {
    let named = cagedyn::Error::new(e.status, format!("case {}: {e}", case.name));
    terminal::complain(&in_file(&args.file, named));
}

/// Last column of the printed table.
const WALL_TIME: (&str, usize) = ("wall time [s]", 13);

fn widths(columns: &[(&str, usize)], set: &CaseSet) -> Vec<usize> {
    let longest = set.cases.iter().map(|c| c.name.chars().count()).fold(4, usize::max);
    let columns = columns.iter().chain([&WALL_TIME, &("", 0)]);
    std::iter::once(longest).chain(columns.map(|(_, width)| *width)).collect()
}

fn print_row(name: &str, cells: impl Iterator<Item = String>, widths: &[usize]) -> Result<()> {
    let mut align = vec![Align::Right; widths.len()];
    align[0] = Align::Left;
    let row: Vec<String> = std::iter::once(name.to_owned()).chain(cells).collect();
    terminal::print(&(table::line(&row, widths, &align) + "\n"))
}

/// Writes `cases.csv` and the picture of the comparison.
fn write_comparison(
    args: &CasesArgs,
    set: &CaseSet,
    comparison: &Comparison,
    done: &[Done<'_>],
) -> Result<Vec<&'static str>> {
    let mut files = vec![output::CASES];
    files::write_csv(&args.out.join(output::CASES), csv_rows(set, comparison, done))?;
    let title = set.title.clone().unwrap_or_else(|| run::stem(&args.file));
    if let Some(picture) = (comparison.picture)(&title, done) {
        files::write_text(&args.out.join(comparison.picture_name), &picture?)?;
        files.push(comparison.picture_name);
    }
    Ok(files)
}

/// The table: name, speed, what the cases set, results, and why there are none.
fn csv_rows(set: &CaseSet, comparison: &Comparison, done: &[Done<'_>]) -> Vec<Vec<String>> {
    let mut varied: Vec<&str> = Vec::new();
    for path in set.cases.iter().flat_map(|case| case.set.keys()).filter(|path| *path != "title") {
        if !varied.contains(&path.as_str()) {
            varied.push(path);
        }
    }
    let unit = |name: &str| done.iter().find_map(|d| Some(&*d.summary.as_ref()?.of(name)?.unit));
    let known: Vec<Known<'_>> =
        comparison.channels.iter().filter_map(|name| Some((*name, unit(name)?))).collect();
    let columns = (comparison.csv_columns)(&known);
    let mut head = vec!["case".to_owned(), "inner ring speed [1/min]".to_owned()];
    head.extend(varied.iter().map(|path| (*path).to_owned()));
    head.extend(columns.iter().cloned());
    let several = done.iter().any(|d| d.results().is_some_and(|s| s.starts.is_some()));
    let kinds = if several { &CageMotion::ALL[..] } else { &[] };
    head.extend(kinds.iter().map(|motion| format!("share of starts: {} [1]", motion.name())));
    head.extend(["simulated time [s]", "wall time [s]", "complete", "error"].map(str::to_owned));
    let rows = done.iter().map(|d| {
        let speed = if d.speed.is_finite() { rounded(d.speed).to_string() } else { String::new() };
        let mut row = vec![d.case.name.clone(), speed];
        row.extend(varied.iter().map(|path| d.case.set.get(*path).map_or(String::new(), plain_text)));
        let empty = || vec![String::new(); columns.len()];
        row.extend(d.results().map_or_else(empty, |s| (comparison.csv_cells)(s, &known)));
        let starts = d.results().and_then(|s| s.starts.as_ref());
        row.extend(kinds.iter().map(|motion| cell(starts.map(|starts| starts.share(*motion)))));
        let of = |text: fn(&Summary) -> String| d.summary.as_ref().map_or(String::new(), text);
        row.push(of(|s| format!("{:?}", s.simulated_time_s)));
        row.push(of(|s| format!("{:.3}", s.wall_time_s)));
        row.push(d.error.is_none().to_string());
        row.push(d.error.clone().unwrap_or_default());
        row
    });
    std::iter::once(head).chain(rows).collect()
}

/// A JSON value as a cell of a table.
fn plain_text(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

/// A number in the file; empty where there is none.
fn cell(x: Option<f64>) -> String {
    x.map_or(String::new(), files::plain)
}
