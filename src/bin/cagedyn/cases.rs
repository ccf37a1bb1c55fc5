//! The command `cases`.

use crate::plots::{self, Point, Series};
use crate::run::{self, Run, in_file};
use crate::summary::Summary;
use crate::table::{self, Align, rounded};
use crate::terminal::{self, INTERRUPTED};
use crate::{CasesArgs, output};
use cagedyn::model::{HostInputs, Input};
use cagedyn::scene::{Case, CaseSet};
use cagedyn::{Result, Scene};
use serde_json::Value;
use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Values that do not make another series: the speed is the order within one, the title is no physics.
const WITHIN_SERIES: [&str; 2] = ["inner_ring.speed", "title"];

/// Columns of the printed table: heading, narrowest width.
const COLUMNS: [(&str, usize); 9] = [
    ("case", 4),
    ("y/c", 8),
    ("+-", 7),
    ("z/c", 8),
    ("+-", 7),
    ("eccentricity", 12),
    ("max roller slip [%]", 19),
    ("wall time [s]", 13),
    ("", 0),
];

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

/// Values that set a series apart, and its cases.
type Group<'a> = (Vec<(&'a str, &'a Value)>, Vec<&'a Done<'a>>);

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
    let widths = widths(&set);
    print_row(&COLUMNS.map(|(name, _)| name.to_owned()), &widths)?;
    let mut done = Vec::new();
    let mut failed = false;
    for (case, scene) in set.cases.iter().zip(scenes) {
        match run_case(args, &base, case, scene) {
            Ok((finished, failure)) => {
                print_row(&row(&finished), &widths)?;
                done.push(finished);
                failed |= failure.inspect(|e| report(args, case, e)).is_some();
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
    let files = write_comparison(args, &set, &done)?;
    terminal::print(&format!("\nfiles: {}: {}\n", args.out.display(), files.join(", ")))?;
    Ok(match (terminal::stop_requested(), failed) {
        (true, _) => ExitCode::from(INTERRUPTED),
        (_, true) => ExitCode::FAILURE,
        _ => ExitCode::SUCCESS,
    })
}

/// Runs one case and writes its files. The second result is why it ended early, if it failed.
fn run_case<'a>(
    args: &CasesArgs,
    base: &Path,
    case: &'a Case,
    scene: Scene,
) -> Result<(Done<'a>, Option<cagedyn::Error>)> {
    let run = run::simulate(scene, args.until, &case.name, &case.name)?;
    let folder: PathBuf = args.out.join(&case.name);
    run::make_folder(&folder)?;
    let set = case.set.iter().map(|(path, value)| format!("{path}={value}")).collect();
    let mut summary = Summary::new(&run, base, Some(&case.name), set);
    output::write(&run, &mut summary, &folder)?;
    Ok((Done { case, speed: speed_at_end(&run), summary }, run.failure))
}

fn speed_at_end(run: &Run) -> f64 {
    run.model.inputs_at(run.time, &HostInputs::default()).of(Input::RingSpeed).abs() * 60.0 / TAU
}

fn report(args: &CasesArgs, case: &Case, e: &cagedyn::Error) {
    let named = cagedyn::Error::new(e.status, format!("case {}: {e}", case.name));
    terminal::complain(&in_file(&args.file, named));
}

fn widths(set: &CaseSet) -> Vec<usize> {
    let mut widths = COLUMNS.map(|(_, width)| width).to_vec();
    widths[0] = set.cases.iter().map(|c| c.name.chars().count()).fold(widths[0], usize::max);
    widths
}

fn print_row(row: &[String], widths: &[usize]) -> Result<()> {
    let mut align = [Align::Right; COLUMNS.len()];
    align[0] = Align::Left;
    terminal::print(&(table::line(row, widths, &align) + "\n"))
}

fn row(done: &Done<'_>) -> [String; COLUMNS.len()] {
    let s = &done.summary;
    let mean = |name: &str| s.of(name).map_or("-".to_owned(), |s| format!("{:.4}", s.spread.mean));
    let deviation = |name: &str| s.of(name).map_or("-".to_owned(), |s| format!("{:.4}", s.spread.deviation));
    [
        done.case.name.clone(),
        mean("cage.y_ratio"),
        deviation("cage.y_ratio"),
        mean("cage.z_ratio"),
        deviation("cage.z_ratio"),
        mean("cage.eccentricity"),
        s.max_roller_slip.as_ref().map_or("-".to_owned(), |slip| format!("{:.2}", 100.0 * slip.value)),
        format!("{:.2}", s.wall_time_s),
        done.state().to_owned(),
    ]
}

/// Writes `cases.csv` and, if any cage is guided, `cage_positions.svg`.
fn write_comparison(args: &CasesArgs, set: &CaseSet, done: &[Done<'_>]) -> Result<Vec<&'static str>> {
    let mut files = vec!["cases.csv"];
    output::write_csv(&args.out.join("cases.csv"), csv_rows(done))?;
    let series = series(done);
    if !series.is_empty() {
        let title = set.title.clone().unwrap_or_else(|| run::stem(&args.file));
        output::write_text(&args.out.join("cage_positions.svg"), &plots::cage_positions(&title, &series)?)?;
        files.push("cage_positions.svg");
    }
    Ok(files)
}

fn csv_rows(done: &[Done<'_>]) -> Vec<Vec<String>> {
    let channels = ["cage.y_ratio", "cage.z_ratio", "cage.eccentricity", "cage.speed", "cage.slip"];
    let others = ["inner_ring.y", "inner_ring.z", "inner_ring.drag_torque"];
    let channels: Vec<&str> = channels.into_iter().chain(others).collect();
    let unit = |name: &str| done.iter().find_map(|d| d.summary.of(name)).map_or("1", |s| s.unit);
    let mut head = vec!["case".to_owned(), "inner ring speed [1/min]".to_owned()];
    for name in &channels {
        head.push(format!("{name} mean [{}]", unit(name)));
        head.push(format!("{name} deviation [{}]", unit(name)));
    }
    head.extend(
        ["max roller slip [1]", "simulated time [s]", "wall time [s]", "complete"].map(str::to_owned),
    );
    let body = done.iter().map(|d| {
        let s = &d.summary;
        let mut row = vec![d.case.name.clone(), rounded(d.speed).to_string()];
        for name in &channels {
            let of = s.of(name);
            row.push(of.map_or(String::new(), |s| format!("{:?}", s.spread.mean)));
            row.push(of.map_or(String::new(), |s| format!("{:?}", s.spread.deviation)));
        }
        row.push(s.max_roller_slip.as_ref().map_or(String::new(), |slip| format!("{:?}", slip.value)));
        row.push(format!("{:?}", s.simulated_time_s));
        row.push(format!("{:.3}", s.wall_time_s));
        row.push(d.state().is_empty().to_string());
        row
    });
    std::iter::once(head).chain(body).collect()
}

/// The complete cases with a guided cage, grouped by all that sets them apart but speed.
fn series<'a>(done: &'a [Done<'a>]) -> Vec<Series> {
    let mut groups: Vec<Group<'a>> = Vec::new();
    let shown = |d: &&Done<'_>| d.state().is_empty() && d.summary.of("cage.y_ratio").is_some();
    for d in done.iter().filter(shown) {
        let key = series_values(d.case);
        match groups.iter_mut().find(|(other, _)| *other == key) {
            Some((_, members)) => members.push(d),
            None => groups.push((key, vec![d])),
        }
    }
    groups.iter_mut().for_each(|(_, members)| members.sort_by(|a, b| a.speed.total_cmp(&b.speed)));
    let labels = labels(&groups);
    let named = labels.into_iter().zip(&groups);
    named
        .map(|(label, (_, members))| Series {
            label,
            points: members.iter().filter_map(|d| point(d)).collect(),
        })
        .collect()
}

/// What the names of the cases of each group share, or else their values: labels must tell the groups apart.
fn labels(groups: &[Group<'_>]) -> Vec<String> {
    let words = |(_, members): &Group<'_>| {
        common_words(&members.iter().map(|d| d.case.name.as_str()).collect::<Vec<_>>())
    };
    let short: Vec<String> = groups.iter().filter_map(words).collect();
    let distinct: BTreeSet<&String> = short.iter().collect();
    if distinct.len() == groups.len() {
        return short;
    }
    groups.iter().map(|(key, _)| values_in_words(key)).collect()
}

fn point(d: &Done<'_>) -> Option<Point> {
    let centre = (d.summary.of("cage.y_ratio")?.spread.mean, d.summary.of("cage.z_ratio")?.spread.mean);
    Some(Point { speed: d.speed, centre })
}

fn series_values(case: &Case) -> Vec<(&str, &Value)> {
    let within = |path: &str| WITHIN_SERIES.iter().any(|p| path == *p || path.starts_with(&format!("{p}.")));
    case.set.iter().filter(|(path, _)| !within(path)).map(|(path, value)| (path.as_str(), value)).collect()
}

/// The words that all names share, in the order of the first: "40um-980N-1000rpm" and "40um-980N-3000rpm" share
/// "40um, 980N".
fn common_words(names: &[&str]) -> Option<String> {
    let words = |name: &str| name.split(['-', '_']).map(str::to_owned).collect::<Vec<String>>();
    let all: Vec<Vec<String>> = names.iter().map(|name| words(name)).collect();
    let shared = all.first()?.iter().filter(|word| !word.is_empty() && all.iter().all(|w| w.contains(word)));
    let shared: Vec<&str> = shared.map(String::as_str).collect();
    (!shared.is_empty()).then(|| shared.join(", "))
}

/// "radial_clearance = 0.00004, ..." for cases whose names share nothing.
fn values_in_words(key: &[(&str, &Value)]) -> String {
    let last = |path: &str| path.rsplit('.').find(|p| *p != "constant").unwrap_or(path).to_owned();
    let words: Vec<String> = key.iter().map(|(path, value)| format!("{} = {value}", last(path))).collect();
    if words.is_empty() { "all cases".to_owned() } else { words.join(", ") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn series_are_named_by_what_their_cases_share() {
        let words = common_words(&["40um-980N-1000rpm", "40um-980N-3000rpm"]);
        assert_eq!(words.as_deref(), Some("40um, 980N"));
        assert_eq!(common_words(&["a", "b"]), None);
        let (clearance, load) = (json!(0.25), json!(-980.0));
        let key = [("inner_ring.radial_clearance", &clearance), ("load.z.constant", &load)];
        assert_eq!(values_in_words(&key), "radial_clearance = 0.25, z = -980.0");
    }

    #[test]
    fn speed_and_title_do_not_separate_series() {
        let set = [("inner_ring.speed.constant", 1.0), ("inner_ring.radial_clearance", 2.0)];
        let set = set.into_iter().map(|(path, x)| (path.to_owned(), json!(x)));
        let case =
            Case { name: "a".to_owned(), set: set.chain([("title".to_owned(), json!("t"))]).collect() };
        let kept: Vec<&str> = series_values(&case).into_iter().map(|(path, _)| path).collect();
        assert_eq!(kept, ["inner_ring.radial_clearance"]);
    }
}
