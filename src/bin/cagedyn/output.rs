//! Files of a run: time series, summary and pictures. A file has its name only when it is complete, and a folder has files of
//! one run only.

use crate::plots;
use crate::run::Run;
use crate::stream::{SERIES, UNFINISHED};
use crate::summary::Summary;
use cagedyn::{Error, Result, Status};
use serde::Serialize;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Name of the summary.
pub const SUMMARY: &str = "summary.json";
/// Name of the table of a case set.
pub const CASES: &str = "cases.csv";
/// Pictures of case sets.
pub const COMPARISONS: [&str; 2] = ["cage_positions.svg", "whirl_speed.svg"];

/// What is known of a run before it ends.
#[derive(Serialize)]
struct Beginning<'a> {
    title: &'a str,
    scene: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    case: Option<&'a str>,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    set: &'a [String],
    version: &'static str,
    complete: bool,
    files: [&'static str; 2],
}

/// Makes a folder for a run, without files of an earlier one, and notes in it that a run has begun.
///
/// # Errors
/// [`Status::File`].
pub fn begin(folder: &Path, title: &str, scene: &Path, case: Option<&str>, set: &[String]) -> Result<()> {
    let beginning = Beginning {
        title,
        scene: scene.display().to_string(),
        case,
        set,
        version: env!("CARGO_PKG_VERSION"),
        complete: false,
        files: [UNFINISHED, SUMMARY],
    };
    make_folder(folder)?;
    clear(folder)?;
    write_json(&folder.join(SUMMARY), &beginning)
}

/// Removes what earlier runs and case sets have left in a folder: files of their names, and folders of cases.
///
/// # Errors
/// [`Status::File`].
pub fn clear(folder: &Path) -> Result<()> {
    remove_files(folder)?;
    for entry in fs::read_dir(folder).map_err(|e| file_error(folder, e))?.flatten() {
        let inside = entry.path();
        let summary = fs::read_to_string(inside.join(SUMMARY)).ok();
        let summary = summary.and_then(|text| serde_json::from_str::<Value>(&text).ok());
        if summary.is_some_and(|summary| summary.get("case").is_some()) {
            remove_files(&inside)?;
            // Somebody may have put files of their own there.
            fs::remove_dir(&inside).ok();
        }
    }
    Ok(())
}

fn remove_files(folder: &Path) -> Result<()> {
    let names = [SUMMARY, SERIES, UNFINISHED, CASES].into_iter().chain(plots::PICTURES).chain(COMPARISONS);
    for path in names.map(|name| folder.join(name)) {
        if path.is_file() {
            fs::remove_file(&path).map_err(|e| file_error(&path, e))?;
        }
    }
    Ok(())
}

/// Writes pictures and summary of a run into `folder` and notes the names of all files in the summary.
///
/// # Errors
/// [`Status::File`] for a file that cannot be written.
pub fn write(run: &Run, summary: &mut Summary, folder: &Path) -> Result<()> {
    summary.files.push(SERIES.to_owned());
    for (name, svg) in plots::pictures(run, summary)? {
        write_text(&folder.join(name), &svg)?;
        summary.files.push(name.to_owned());
    }
    summary.files.push(SUMMARY.to_owned());
    write_json(&folder.join(SUMMARY), summary)
}

/// Makes a folder and those above it.
///
/// # Errors
/// [`Status::File`].
pub fn make_folder(path: &Path) -> Result<()> {
    fs::create_dir_all(path).map_err(|e| file_error(path, e))
}

/// Writes a text file, which has its name only when it is complete.
///
/// # Errors
/// [`Status::File`].
pub fn write_text(path: &Path, text: &str) -> Result<()> {
    let unfinished = path.with_extension("unfinished");
    let written = fs::write(&unfinished, text).and_then(|()| fs::rename(&unfinished, path));
    written.map_err(|e| {
        fs::remove_file(&unfinished).ok();
        file_error(path, e)
    })
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
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.write_record(&row).map_err(|e| file_error(path, e))?;
    }
    let bytes = writer.into_inner().map_err(|e| file_error(path, e))?;
    write_text(path, &String::from_utf8_lossy(&bytes))
}

/// The shortest text that reads back as the same number.
pub fn plain(x: f64) -> String {
    format!("{x:?}")
}

/// What is wrong with a file.
pub fn file_error(path: &Path, e: impl std::fmt::Display) -> Error {
    Error::new(Status::File, format!("{}: {e}", path.display()))
}
