//! The command `cases`.

mod comparison;
mod record;
mod rollers;
mod series;
mod whirl;

use crate::CasesArgs;
use crate::points::{Records, Row};
use crate::results::files::UNFINISHED;
use crate::results::formats::TableFormat;
use crate::results::output;
use crate::results::summary::few_turns;
use crate::results::table::{self, Align};
use crate::run::{self, Request, in_file};
use crate::terminal::{self, INTERRUPTED, Part, Together};
use crate::workers;
use cagedyn::scene::{Case, CaseSet};
use cagedyn::{Error, Result, Scene, Status};
use comparison::{Comparison, rounded_cell};
use record::{Record, fingerprint_of_case};
use rollers::ROLLERS;
use serde_json::Value;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use whirl::WHIRL;

/// Name and unit of a channel.
type Known<'a> = (&'static str, &'a str);

/// A case that was run, or could not be.
struct Done<'a> {
    /// Its place in the set.
    place: usize,
    case: &'a Case,
    /// Inner ring speed at the end, 1/min, without sign.
    speed: f64,
    record: Record,
}

impl<'a> Done<'a> {
    fn new(place: usize, case: &'a Case, record: Record) -> Self {
        Self { place, case, speed: record.speed(), record }
    }

    /// Results of a complete case: what a case that failed has reached says nothing beside the others.
    fn results(&self) -> Option<&Row> {
        Some(&self.record.row).filter(|row| row.error.is_none())
    }

    /// Why the case failed, if it did.
    fn failure(&self) -> Option<&str> {
        let error = self.record.row.error.as_ref().filter(|_| !self.record.interrupted());
        error.map(|(_, message)| message.as_str())
    }

    fn untrusted(&self) -> bool {
        self.record.row.trusted == Some(false)
    }
}

/// A case as it is to be run.
struct Prepared<'a> {
    case: &'a Case,
    scene: Result<Scene>,
    /// Folder for its results.
    folder: PathBuf,
    /// Fingerprint of all that its results depend on.
    of: String,
}

/// Runs the cases that are not done yet, writes their results and a comparison of all. A case that fails is reported and the others
/// go on.
///
/// # Errors
/// Files and scenes that cannot be used; they are found before the first run.
pub fn command(args: &CasesArgs) -> Result<ExitCode> {
    let set = CaseSet::from_json(&run::read(&args.file)?).map_err(|e| in_file(&args.file, e))?;
    let base = args.file.parent().unwrap_or(Path::new("")).join(&set.scene);
    let text = run::read(&base)?;
    let comment = run::comment(&text);
    let scenes = set.scenes(&text).map_err(|e| in_file(&args.file, e))?;
    // Without rollers that move freely, what matters is the whirl of the cage.
    let whirl = scenes.iter().all(|scene| scene.kinematic_elements.is_some());
    let comparison = if whirl { WHIRL } else { ROLLERS };
    let order = workers::longest_first(&scenes);
    let prepare = |(case, scene)| prepare(args, (&base, &comment), case, scene);
    let prepared: Vec<Prepared<'_>> = set.cases.iter().zip(scenes).map(prepare).collect();
    terminal::listen_for_interrupt()?;
    let Taken { lock, records, kept } = take(args, &prepared)?;
    let kept = kept.into_iter().map(|(i, record)| Done::new(i, prepared[i].case, record));
    let done = kept.collect();
    let mut tally = Tally { args, set: &set, comparison, done, printed: 0, files: Vec::new() };
    if !tally.done.is_empty() {
        terminal::print(&format!("{} cases, {} of them done\n", set.cases.len(), tally.done.len()))?;
    }
    tally.print_head()?;
    // A set that is ended before its first case has a table, too.
    tally.write()?;
    tally.print_next()?;
    let order: Vec<usize> =
        order.into_iter().filter(|i| !tally.done.iter().any(|done| done.place == *i)).collect();
    let failed = tally.done.iter().filter(|done| done.failure().is_some()).count();
    let together = Together::new(prepared.len(), tally.done.len(), failed);
    // Starts of one case share the threads, cases only without them.
    let threads = if args.instead.starts > 1 { 1 } else { workers::threads(args.instead.jobs) };
    let run = |i: usize| {
        (!terminal::stop_requested()).then(|| {
            let part = together.begin();
            let record = run_case(args, (&base, comment.clone()), &prepared[i], &part);
            part.end(record.row.error.is_some());
            Done::new(i, prepared[i].case, record)
        })
    };
    let mut written = Ok(());
    workers::share(&order, threads, run, |_, done| {
        written = done.record.keep(&records, done.case).and_then(|()| tally.add(done));
        if written.is_err() {
            terminal::stop_all();
        }
        written.is_ok()
    });
    written?;
    // What came to its end behind one that an interrupt left out.
    tally.print_rest()?;
    tally.files.extend(comparison::write_spectra(args, &comparison::title(args, &set), &tally.done)?);
    drop((lock, together));
    std::fs::remove_file(args.out.join(UNFINISHED)).ok();
    terminal::print(&format!("\nfiles: {}: {}\n", args.out.display(), tally.files.join(", ")))?;
    let done = &tally.done;
    Ok(match terminal::stop_requested() {
        true => ExitCode::from(INTERRUPTED),
        _ if done.iter().any(|done| done.failure().is_some()) => ExitCode::FAILURE,
        _ if done.iter().any(Done::untrusted) => ExitCode::from(run::UNTRUSTED),
        _ => ExitCode::SUCCESS,
    })
}

/// What a case runs, and where; `base` is the file of the base scene, with its comment.
fn prepare<'a>(
    args: &CasesArgs,
    (base, comment): (&Path, &Option<Value>),
    case: &'a Case,
    mut scene: Scene,
) -> Prepared<'a> {
    if !case.set.keys().any(|path| path == "title") {
        // The title of the base scene tells of other values.
        scene.title = None;
    }
    let changed = args.instead.apply(&mut scene);
    let of = fingerprint_of_case(args, base, case, &scene, comment);
    Prepared { case, scene: changed.map(|()| scene), folder: args.out.join(&case.name), of }
}

/// The folder of a set that this program has for itself.
struct Taken {
    /// Held as long as this lives.
    lock: File,
    records: Records,
    /// Cases that are done already, with their places in the set.
    kept: Vec<(usize, Record)>,
}

/// Takes the folder of a set, with the records of the cases in it that are done, and removes all else that runs have left there.
fn take(args: &CasesArgs, prepared: &[Prepared<'_>]) -> Result<Taken> {
    let (mut found, mut kept) = (None, Vec::new());
    let lock = output::take_keeping(&args.out, || {
        let records = Records::open(&args.out.join(output::RECORDS), "case set")?;
        let record = |p: &Prepared<'_>| Record::kept(&records, p.case, &p.of, &p.folder);
        kept.extend(prepared.iter().enumerate().filter_map(|(i, p)| Some((i, record(p)?))));
        let names: Vec<&str> = kept.iter().map(|(i, _)| prepared[*i].case.name.as_str()).collect();
        records.retain(|name| names.contains(&name));
        found = Some(records);
        Ok(names)
    })?;
    let records = found.ok_or_else(|| Error::new(Status::Internal, "no records"))?;
    Ok(Taken { lock, records, kept })
}

/// Cases that are done, in the order of the set, and what is to be said of all.
struct Tally<'a> {
    args: &'a CasesArgs,
    set: &'a CaseSet,
    comparison: Comparison,
    done: Vec<Done<'a>>,
    /// Number of those that were printed.
    printed: usize,
    files: Vec<&'static str>,
}

impl<'a> Tally<'a> {
    /// Adds a case and writes the comparison with it: what is done is not lost when the rest is.
    fn add(&mut self, done: Done<'a>) -> Result<()> {
        let at = self.done.partition_point(|other| other.place < done.place);
        self.done.insert(at, done);
        self.write()?;
        self.print_next()
    }

    fn write(&mut self) -> Result<()> {
        self.files = comparison::write(self.args, self.set, &self.comparison, &self.done)?;
        Ok(())
    }

    /// Prints what is next in the order of the set: what is behind a case that runs waits for it.
    fn print_next(&mut self) -> Result<()> {
        while self.done.get(self.printed).is_some_and(|done| done.place == self.printed) {
            self.print_one()?;
        }
        Ok(())
    }

    fn print_rest(&mut self) -> Result<()> {
        while self.printed < self.done.len() {
            self.print_one()?;
        }
        Ok(())
    }

    /// Prints the next case, and what is wrong with it.
    fn print_one(&mut self) -> Result<()> {
        let done = &self.done[self.printed];
        self.printed += 1;
        let untrusted = || format!("not to be trusted: {}", done.record.row.doubts.join("; "));
        let wrong = done.failure().map(str::to_owned).or_else(|| done.untrusted().then(untrusted));
        if let Some(wrong) = wrong {
            let text = format!("case {}: {wrong}", done.case.name);
            terminal::complain(&in_file(&self.args.file, Error::new(Status::BadScene, text)));
        }
        let empty = || vec!["-".to_owned(); self.comparison.columns.len()];
        let cells = done.results().map_or_else(empty, self.comparison.cells);
        let wall = done.record.wall_time().map_or("-".to_owned(), |wall| format!("{wall:.2}"));
        let state = match &done.record.row.error {
            Some((_, message)) if done.record.interrupted() => message.clone(),
            Some(_) => "failed".to_owned(),
            None => {
                let few = done.record.row.few_turns().map(few_turns);
                few.into_iter().chain(done.record.starts.clone()).collect::<Vec<_>>().join("; ")
            }
        };
        self.print_row(&done.case.name, cells.into_iter().chain([wall, state]))
    }

    fn print_head(&self) -> Result<()> {
        let headings = self.comparison.columns.iter().map(|(name, _)| (*name).to_owned());
        self.print_row("case", headings.chain([WALL_TIME.0.to_owned(), String::new()]))
    }

    fn print_row(&self, name: &str, cells: impl Iterator<Item = String>) -> Result<()> {
        let longest = self.set.cases.iter().map(|c| c.name.chars().count()).fold(4, usize::max);
        let columns = self.comparison.columns.iter().chain([&WALL_TIME, &("", 0)]);
        let widths: Vec<usize> = std::iter::once(longest).chain(columns.map(|(_, width)| *width)).collect();
        let mut align = vec![Align::Right; widths.len()];
        align[0] = Align::Left;
        let row: Vec<String> = std::iter::once(name.to_owned()).chain(cells).collect();
        terminal::print(&(table::line(&row, &widths, &align) + "\n"))
    }
}

/// Last column of the printed table.
const WALL_TIME: (&str, usize) = ("wall time [s]", 13);

/// Runs one case and writes its files; `base` is the file of the base scene, with its comment.
fn run_case(
    args: &CasesArgs,
    (base, comment): (&Path, Option<Value>),
    prepared: &Prepared<'_>,
    part: &Part<'_>,
) -> Record {
    let Prepared { case, scene, folder, of } = prepared;
    let set = case.set.iter().map(|(path, value)| format!("{path}={value}")).collect();
    let performed = scene.clone().and_then(|scene| {
        let duration = scene.record.duration;
        let formats = &[TableFormat::Csv];
        let case = Some(case.name.as_str());
        let request = Request { scene, file: base, case, comment, set, folder, aloud: false, formats };
        run::perform(request, &args.instead, &|t| part.at(t / duration))
    });
    match performed {
        Ok((run, summary)) => Record::of_run(of, folder, &run, &summary),
        Err(e) => Record::of_failure(of, &e),
    }
}
