//! The command `cases`.

mod rollers;
mod series;
mod whirl;

use crate::run::{self, Run, in_file};
use crate::summary::Summary;
use crate::table::{self, Align};
use crate::terminal::{self, INTERRUPTED};
use crate::{CasesArgs, output};
use cagedyn::model::{HostInputs, Input};
use cagedyn::scene::{Case, CaseSet};
use cagedyn::{Result, Scene};
use rollers::ROLLERS;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use whirl::WHIRL;

/// What is compared: a printed table, a file and a picture.
struct Comparison {
    /// Columns of the printed table: heading, narrowest width.
    columns: &'static [(&'static str, usize)],
    /// Row of the printed table.
    row: fn(&Done<'_>) -> Vec<String>,
    /// All rows of the file, with its head.
    csv_rows: fn(&[Done<'_>]) -> Vec<Vec<String>>,
    /// File name of the picture.
    picture_name: &'static str,
    /// The picture with a title, if there is something to show.
    picture: fn(&str, &[Done<'_>]) -> Option<Result<String>>,
}

/// A finished case.
struct Done<'a> {
    case: &'a Case,
    /// Inner ring speed at the end, 1/min, without sign.
    speed: f64,
    summary: Summary,
}

impl Done<'_> {
    /// Why the case ended early; nothing for a complete one.
    fn state(&self) -> &'static str {
        match (&self.summary.error, self.summary.interrupted) {
            (Some(_), _) => "failed",
            (None, true) => "interrupted",
            (None, false) => "",
        }
    }
}

/// Runs all cases, writes their results and a comparison. A case that fails is reported and the others go on.
///
/// # Errors
/// Files and scenes that cannot be used; they are found before the first run.
pub fn command(args: &CasesArgs) -> Result<ExitCode> {
    let set = CaseSet::from_json(&run::read(&args.file)?).map_err(|e| in_file(&args.file, e))?;
    let base = args.file.parent().unwrap_or(Path::new("")).join(&set.scene);
    let scenes = set.scenes(&run::read(&base)?).map_err(|e| in_file(&args.file, e))?;
    terminal::listen_for_interrupt()?;
    run::make_folder(&args.out)?;
    // Without rollers that move freely, what matters is the whirl of the cage.
    let whirl = scenes.iter().all(|scene| scene.kinematic_elements.is_some());
    let comparison = if whirl { WHIRL } else { ROLLERS };
    let widths = widths(comparison.columns, &set);
    let head: Vec<String> = comparison.columns.iter().map(|(name, _)| (*name).to_owned()).collect();
    print_row(&head, &widths)?;
    let mut done = Vec::new();
    let (mut failed, mut untrusted) = (false, false);
    for (case, scene) in set.cases.iter().zip(scenes) {
        match run_case(args, &base, case, scene) {
            Ok((finished, failure, trust)) => {
                print_row(&(comparison.row)(&finished), &widths)?;
                done.push(finished);
                failed |= failure.inspect(|e| report(args, case, e)).is_some();
                untrusted |= trust.inspect_err(|e| report(args, case, e)).is_err();
            }
            Err(e) => {
                report(args, case, &e);
                failed = true;
            }
        }
        if terminal::stop_requested() {
            break;
        }
    }
    let files = write_comparison(args, &set, &comparison, &done)?;
    terminal::print(&format!("\nfiles: {}: {}\n", args.out.display(), files.join(", ")))?;
    Ok(match (terminal::stop_requested(), failed) {
        (true, _) => ExitCode::from(INTERRUPTED),
        (_, true) => ExitCode::FAILURE,
        _ if untrusted => ExitCode::from(run::UNTRUSTED),
        _ => ExitCode::SUCCESS,
    })
}

/// Runs one case and writes its files. The second result is why it ended early, if it failed, the last whether to trust it.
fn run_case<'a>(
    args: &CasesArgs,
    base: &Path,
    case: &'a Case,
    mut scene: Scene,
) -> Result<(Done<'a>, Option<cagedyn::Error>, Result<()>)> {
    args.instead.apply(&mut scene);
    let run = run::simulate(scene, &case.name, &case.name, args.instead.max_wall_time)?;
    let folder: PathBuf = args.out.join(&case.name);
    run::make_folder(&folder)?;
    let set = case.set.iter().map(|(path, value)| format!("{path}={value}")).collect();
    let mut summary = Summary::new(&run, base, Some(&case.name), set);
    output::write(&run, &mut summary, &folder)?;
    let trust = run.trust();
    Ok((Done { case, speed: speed_at_end(&run), summary }, run.failure, trust))
}

fn speed_at_end(run: &Run) -> f64 {
    run.model.inputs_at(run.time, &HostInputs::default()).of(Input::RingSpeed).abs() * 60.0 / TAU
}

fn report(args: &CasesArgs, case: &Case, e: &cagedyn::Error) {
    let named = cagedyn::Error::new(e.status, format!("case {}: {e}", case.name));
    terminal::complain(&in_file(&args.file, named));
}

fn widths(columns: &[(&str, usize)], set: &CaseSet) -> Vec<usize> {
    let mut widths: Vec<usize> = columns.iter().map(|(_, width)| *width).collect();
    widths[0] = set.cases.iter().map(|c| c.name.chars().count()).fold(widths[0], usize::max);
    widths
}

fn print_row(row: &[String], widths: &[usize]) -> Result<()> {
    let mut align = vec![Align::Right; widths.len()];
    align[0] = Align::Left;
    terminal::print(&(table::line(row, widths, &align) + "\n"))
}

/// Writes `cases.csv` and the picture of the comparison.
fn write_comparison(
    args: &CasesArgs,
    set: &CaseSet,
    comparison: &Comparison,
    done: &[Done<'_>],
) -> Result<Vec<&'static str>> {
    let mut files = vec!["cases.csv"];
    output::write_csv(&args.out.join("cases.csv"), (comparison.csv_rows)(done))?;
    let title = set.title.clone().unwrap_or_else(|| run::stem(&args.file));
    if let Some(picture) = (comparison.picture)(&title, done) {
        output::write_text(&args.out.join(comparison.picture_name), &picture?)?;
        files.push(comparison.picture_name);
    }
    Ok(files)
}
