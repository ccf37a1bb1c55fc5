//! The comparison of cases: a printed table, a file and a picture.

use super::series::series;
use super::{Done, Known};
use crate::CasesArgs;
use crate::plots::sweep::{Abscissa, Spectra, waterfall};
use crate::points::row::{CAGE_TURNS, share_of};
use crate::points::{Row, spectrum};
use crate::results::table::rounded;
use crate::results::{files, output};
use crate::run;
use cagedyn::scene::CaseSet;
use cagedyn::{CageMotion, Result};
use serde_json::Value;

/// Column of the speed.
const SPEED: &str = "inner ring speed [1/min]";
/// Of fewer speeds there is no picture of the spectra.
const FEWEST_SPEEDS: usize = 4;

/// What is compared.
pub struct Comparison {
    /// Columns of the printed table behind the name of the case: heading, narrowest width.
    pub columns: &'static [(&'static str, usize)],
    /// Their cells.
    pub cells: fn(&Row) -> Vec<String>,
    /// Channels whose means are in the file, where a case has them.
    pub channels: &'static [&'static str],
    /// Columns of the file, given these channels with their units.
    pub csv_columns: fn(&[Known<'_>]) -> Vec<String>,
    /// File name of the picture.
    pub picture_name: &'static str,
    /// The picture with a title, if there is something to show.
    pub picture: fn(&str, &[Done<'_>]) -> Option<Result<String>>,
}

/// Title of the set.
pub fn title(args: &CasesArgs, set: &CaseSet) -> String {
    set.title.clone().unwrap_or_else(|| run::stem(&args.file))
}

/// Writes `cases.csv` and the picture; names of the files.
///
/// # Errors
/// [`cagedyn::Status::File`].
pub fn write(
    args: &CasesArgs,
    set: &CaseSet,
    comparison: &Comparison,
    done: &[Done<'_>],
) -> Result<Vec<&'static str>> {
    let mut files = vec![output::CASES];
    files::write_csv(&args.out.join(output::CASES), csv_rows(set, comparison, done))?;
    if let Some(picture) = (comparison.picture)(&title(args, set), done) {
        files::write_text(&args.out.join(comparison.picture_name), &picture?)?;
        files.push(comparison.picture_name);
    }
    Ok(files)
}

/// Writes the spectra of cases that differ in speed: a table, and a picture of those that differ in nothing else, if they are enough;
/// names of the files.
///
/// # Errors
/// [`cagedyn::Status::File`].
pub fn write_spectra(args: &CasesArgs, title: &str, done: &[Done<'_>]) -> Result<Vec<&'static str>> {
    let spectra = || done.iter().filter_map(|d| Some((d, d.results()?.spectrum.as_ref()?)));
    let mut speeds = spectra().map(|(d, _)| d.speed);
    let first = speeds.next();
    if !speeds.any(|speed| Some(speed) != first) {
        return Ok(Vec::new());
    }
    let lines = spectra().flat_map(|(d, spectrum)| {
        let speed = rounded(d.speed).to_string();
        spectrum
            .rows()
            .map(move |line| [d.case.name.clone(), speed.clone()].into_iter().chain(line).collect())
    });
    let head = ["case", SPEED].into_iter().chain(spectrum::COLUMNS).map(str::to_owned).collect();
    files::write_csv(&args.out.join(output::CASE_SPECTRA), std::iter::once(head).chain(lines))?;
    let column = |d: &Done<'_>| Some(d.results()?.spectrum.as_ref()?.column(d.speed));
    let diagrams: Vec<Spectra> = series(done, column)
        .into_iter()
        .filter(|series| series.points.len() >= FEWEST_SPEEDS)
        .map(|series| {
            let speeds: Vec<f64> = series.points.iter().map(|column| column.at).collect();
            let (name, axis) = (Some(series.label), Abscissa::of_speeds(SPEED, &speeds));
            Spectra { name, axis, columns: series.points, failed: Vec::new() }
        })
        .collect();
    let mut files = vec![output::CASE_SPECTRA];
    if !diagrams.is_empty() {
        files::write_text(&args.out.join(output::CASE_WATERFALL), &waterfall(title, &diagrams)?)?;
        files.push(output::CASE_WATERFALL);
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
    let unit = |name: &str| done.iter().find_map(|d| unit(d.results()?, name));
    let known: Vec<Known<'_>> =
        comparison.channels.iter().filter_map(|name| Some((*name, unit(name)?))).collect();
    let mut columns = (comparison.csv_columns)(&known);
    let shares = CageMotion::ALL.map(share_of);
    if done.iter().any(|d| d.results().is_some_and(|row| row.text(&shares[0]).is_some())) {
        columns.extend(shares);
    }
    columns.push(CAGE_TURNS.to_owned());
    let mut head = vec!["case".to_owned(), SPEED.to_owned()];
    head.extend(varied.iter().map(|path| (*path).to_owned()));
    head.extend(columns.iter().cloned());
    head.extend(["simulated time [s]", "wall time [s]", "complete", "error"].map(str::to_owned));
    let rows = done.iter().map(|d| {
        let speed = if d.speed.is_finite() { rounded(d.speed).to_string() } else { String::new() };
        let mut row = vec![d.case.name.clone(), speed];
        row.extend(varied.iter().map(|path| d.case.set.get(*path).map_or(String::new(), plain_text)));
        let cell = |column: &String| d.results().and_then(|row| row.text(column)).unwrap_or_default();
        row.extend(columns.iter().map(|column| cell(column).to_owned()));
        row.push(d.record.row.simulated_time.clone().unwrap_or_default());
        row.push(d.record.wall_time().map_or(String::new(), |wall| format!("{wall:.3}")));
        row.push(d.record.row.error.is_none().to_string());
        row.push(d.record.row.error.as_ref().map_or(String::new(), |(_, message)| message.clone()));
        row
    });
    std::iter::once(head).chain(rows).collect()
}

/// Unit of a channel, as the heads of its columns have it.
fn unit<'a>(row: &'a Row, channel: &str) -> Option<&'a str> {
    let unit = |column: &'a str| column.strip_prefix(channel)?.strip_prefix(" mean [")?.strip_suffix(']');
    row.results.iter().find_map(|(column, _)| unit(column))
}

/// A JSON value as a cell of a table.
fn plain_text(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

/// A result times a factor in the printed table.
pub fn rounded_cell(row: &Row, column: &str, factor: f64, decimals: usize) -> String {
    row.number(column).map_or("-".to_owned(), |x| format!("{:.decimals$}", factor * x))
}
