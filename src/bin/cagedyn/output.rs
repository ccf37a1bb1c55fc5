//! Files of a run: time series, summary and pictures.

use crate::plots;
use crate::run::Run;
use crate::summary::Summary;
use crate::table::rounded;
use cagedyn::{Error, Result, Status};
use serde::Serialize;
use std::fs;
use std::path::Path;

/// Writes all files of a run into `folder` and notes their names in the summary.
///
/// # Errors
/// [`Status::File`] for a file that cannot be written.
pub fn write(run: &Run, summary: &mut Summary, folder: &Path) -> Result<()> {
    write_series(run, &folder.join("timeseries.csv"))?;
    summary.files.push("timeseries.csv".to_owned());
    for (name, svg) in plots::pictures(run, summary)? {
        write_text(&folder.join(name), &svg)?;
        summary.files.push(name.to_owned());
    }
    summary.files.push("summary.json".to_owned());
    write_json(&folder.join("summary.json"), summary)
}

/// Writes a text file.
///
/// # Errors
/// [`Status::File`].
pub fn write_text(path: &Path, text: &str) -> Result<()> {
    fs::write(path, text).map_err(|e| file_error(path, e))
}

fn write_json(path: &Path, value: &impl Serialize) -> Result<()> {
    let text = serde_json::to_string_pretty(value).map_err(|e| file_error(path, e))?;
    write_text(path, &(text + "\n"))
}

/// Writes a table of comma-separated values.
///
/// # Errors
/// [`Status::File`].
pub fn write_csv(path: &Path, rows: impl IntoIterator<Item = Vec<String>>) -> Result<()> {
    let mut writer = csv::Writer::from_path(path).map_err(|e| file_error(path, e))?;
    for row in rows {
        writer.write_record(&row).map_err(|e| file_error(path, e))?;
    }
    writer.flush().map_err(|e| file_error(path, e))
}

fn write_series(run: &Run, path: &Path) -> Result<()> {
    let channels = run.channels.iter().map(|c| format!("{} [{}]", c.name, c.unit));
    let head = std::iter::once("time [s]".to_owned()).chain(channels).collect();
    let records = run.recording.times.iter().enumerate().map(|(i, t)| {
        let values = run.recording.columns.iter().map(|column| column.get(i).map_or(String::new(), plain));
        std::iter::once(plain(&rounded(*t))).chain(values).collect()
    });
    write_csv(path, std::iter::once(head).chain(records))
}

/// The shortest text that reads back as the same number.
fn plain(x: &f64) -> String {
    format!("{x:?}")
}

fn file_error(path: &Path, e: impl std::fmt::Display) -> Error {
    Error::new(Status::File, format!("{}: {e}", path.display()))
}
