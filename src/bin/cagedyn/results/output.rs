//! Files of a run: time series, summary and pictures. A file has its name only when it is complete, and a folder has files of
//! one run only.

use crate::plots;
use crate::points::Records;
use crate::results::files::{SERIES, UNFINISHED, file_error, write_json, write_text};
use crate::results::finished::Run;
use crate::results::formats::SERIES_FILES;
use crate::results::summary::Summary;
use cagedyn::{Result, Scene};
use serde::Serialize;
use serde_json::Value;
use std::fs::{self, File, TryLockError};
use std::io::Read as _;
use std::path::Path;

/// Name of the summary.
pub const SUMMARY: &str = "summary.json";
/// Name of the scene with all values as they were run.
pub const SCENE: &str = "scene_as_run.json";
/// Name of the table of a case set.
pub const CASES: &str = "cases.csv";
/// Names of the spectra of its cases, as a table and as a picture.
pub const CASE_SPECTRA: &str = "cases_spectra.csv";
pub const CASE_WATERFALL: &str = "cases_waterfall.svg";
/// Name of the folder with the records of the cases of a set that are done; no case has this name.
pub const RECORDS: &str = ".cases";
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
    files: [&'static str; 3],
}

/// A scene as it is run.
#[derive(Serialize)]
struct AsRun<'a> {
    #[serde(flatten)]
    scene: &'a Scene,
    #[serde(skip_serializing_if = "Option::is_none")]
    comment: Option<&'a Value>,
}

/// Writes the scene of a run with the values that were replaced and those that stand where the file has none, under the title
/// of the run and with the comment of the file.
///
/// # Errors
/// [`Status::File`].
pub fn write_scene(folder: &Path, scene: &Scene, title: &str, comment: Option<&Value>) -> Result<()> {
    let scene = &Scene { title: Some(title.to_owned()), ..scene.clone() };
    write_json(&folder.join(SCENE), &AsRun { scene, comment })
}

/// Notes in a folder that a run has begun.
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
        files: [UNFINISHED, SUMMARY, SCENE],
    };
    write_json(&folder.join(SUMMARY), &beginning)
}

/// Makes a folder, takes it for this program alone, and removes from it what earlier runs and case sets have left. It is given
/// back with the file.
///
/// # Errors
/// [`Status::File`], also for a folder that another run writes to and for files of these names that are somebody else's.
pub fn take(folder: &Path) -> Result<File> {
    let taken = take_keeping(folder, || Ok(Vec::new()))?;
    let records = folder.join(RECORDS);
    if records.is_dir() {
        let records = Records::open(&records, "case set")?;
        records.retain(|_| false);
        records.discard();
    }
    Ok(taken)
}

/// The same, but it leaves the folders of the cases that `kept` names, which is asked when the folder is taken.
///
/// # Errors
/// As [`take`], and those of `kept`.
pub fn take_keeping<'a>(folder: &Path, kept: impl FnOnce() -> Result<Vec<&'a str>>) -> Result<File> {
    fs::create_dir_all(folder).map_err(|e| file_error(folder, e))?;
    let path = folder.join(UNFINISHED);
    let file = File::options().create(true).append(true).open(&path).map_err(|e| file_error(&path, e))?;
    if let Err(TryLockError::WouldBlock) = file.try_lock() {
        return Err(file_error(folder, "another run is writing to this folder"));
    }
    let cleared = check(folder)
        .and_then(|()| clear(folder, &kept()?))
        .and_then(|()| file.set_len(0).map_err(|e| file_error(&path, e)));
    if cleared.is_err() {
        fs::remove_file(&path).ok();
    }
    cleared.map(|()| file)
}

/// Refuses a folder with files of these names that are somebody else's.
fn check(folder: &Path) -> Result<()> {
    for (name, begins) in [
        (SUMMARY, "{\n  \"title\":"),
        (SERIES, "time [s]"),
        (SCENE, "{\n  \"schema\": \"cagedyn.scene/"),
        (CASES, "case,inner ring speed [1/min]"),
        (CASE_SPECTRA, "case,inner ring speed [1/min]"),
    ] {
        let path = folder.join(name);
        let mut head = Vec::new();
        let read = File::open(&path).and_then(|file| file.take(begins.len() as u64).read_to_end(&mut head));
        if read.is_ok() && head != begins.as_bytes() {
            return Err(file_error(&path, "is not of this program; choose another folder or remove it"));
        }
    }
    Ok(())
}

/// Removes what earlier runs and case sets have left in a folder: files of their names, and folders of cases but of these.
fn clear(folder: &Path, kept: &[&str]) -> Result<()> {
    remove_files(folder)?;
    for entry in fs::read_dir(folder).map_err(|e| file_error(folder, e))?.flatten() {
        if entry.file_name().to_str().is_some_and(|name| kept.contains(&name)) {
            continue;
        }
        let inside = entry.path();
        let summary = fs::read_to_string(inside.join(SUMMARY)).ok();
        let summary = summary.and_then(|text| serde_json::from_str::<Value>(&text).ok());
        if summary.is_some_and(|summary| summary.get("case").is_some()) {
            remove_files(&inside)?;
            fs::remove_file(inside.join(UNFINISHED)).ok();
            // Somebody may have put files of their own there.
            fs::remove_dir(&inside).ok();
        }
    }
    Ok(())
}

fn remove_files(folder: &Path) -> Result<()> {
    let tables =
        [SUMMARY, SERIES, SCENE, CASES, CASE_SPECTRA, CASE_WATERFALL].into_iter().chain(SERIES_FILES);
    let names = tables.chain(plots::PICTURES).chain(COMPARISONS);
    for path in names.map(|name| folder.join(name)) {
        if path.is_file() {
            fs::remove_file(&path).map_err(|e| file_error(&path, e))?;
        }
    }
    Ok(())
}

/// Writes summary and pictures of a run into `folder` and notes the names of all files in the summary. The summary comes first:
/// it is there even if no picture can be. Pictures are left out unless `draw`.
///
/// # Errors
/// [`Status::File`] for a file that cannot be written.
pub fn write(run: &Run, summary: &mut Summary, folder: &Path, draw: bool) -> Result<()> {
    summary.files.extend([SUMMARY, SCENE].map(str::to_owned));
    write_json(&folder.join(SUMMARY), summary)?;
    if !draw {
        return Ok(());
    }
    for (name, svg) in plots::pictures(run, summary)? {
        write_text(&folder.join(name), &svg)?;
        summary.files.push(name.to_owned());
    }
    write_json(&folder.join(SUMMARY), summary)
}
