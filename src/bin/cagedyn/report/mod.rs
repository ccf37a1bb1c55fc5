//! The command `report`: a run as one HTML file that can be handed on.

mod animation;
mod frames;
mod gather;
mod page;
mod scene_text;
mod series;
mod unrolled;

use crate::results::files::{file_error, write_text};
use crate::run::{self, in_file, stem};
use crate::terminal::Progress;
use crate::{ReportArgs, terminal};
use cagedyn::{Error, Result, Status};
use gather::Gathered;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// First line of every report, by which it is known.
const BEGINS: &str = "<!DOCTYPE html><!-- cagedyn report -->";

/// Writes the report of a folder of `run`, or runs a scene and writes that of its results.
///
/// # Errors
/// A scene or folder that cannot be used, a file that cannot be written. A failure during the run is printed here, after its
/// report.
pub fn command(args: &ReportArgs) -> Result<ExitCode> {
    let out = args.out.clone().map_or_else(|| format!("{}.html", stem(&args.source)).into(), named);
    let made = args.source.is_dir();
    if made && !(args.sets.list.is_empty() && args.instead.leaves_all()) {
        let text = "--set and what else changes a run: this one has been made; report its scene instead";
        return Err(Error::new(Status::BadValue, text));
    }
    check(&out)?;
    if made {
        write(&args.source, &out)?;
        return Ok(ExitCode::SUCCESS);
    }
    let folder = Scratch::new()?;
    let request = run::request(&args.source, &args.sets, &args.instead, &folder.0)?;
    let progress = Progress::new("run", request.scene.record.duration);
    let performed = run::perform(request, &args.instead, &|t| progress.at(t));
    drop(progress);
    let (run, _) = performed.map_err(|e| in_file(&args.source, e))?;
    write(&folder.0, &out)?;
    Ok(run::exit_code(&run))
}

/// The file with the suffix by which a browser knows it.
fn named(out: PathBuf) -> PathBuf {
    let has_it = out
        .extension()
        .is_some_and(|suffix| ["html", "htm"].iter().any(|html| suffix.eq_ignore_ascii_case(html)));
    let nameless = out.file_name().is_none() || out.is_dir();
    if has_it || nameless {
        return out;
    }
    let mut name = out.into_os_string();
    name.push(".html");
    name.into()
}

fn write(folder: &Path, out: &Path) -> Result<()> {
    let gathered = Gathered::from(folder)?;
    let html = format!("{BEGINS}\n{}", page::page(&gathered));
    write_text(out, &html)?;
    let frames = gathered.animation.as_ref().map_or(0, |animation| animation.frames);
    let size = 1e-6 * html.len() as f64;
    terminal::print(&format!("{}: {size:.1} MB, {frames} frames\n", out.display()))
}

/// Whether a report can be written there: known before the run, not after it.
fn check(out: &Path) -> Result<()> {
    if fs::read(out).is_ok_and(|bytes| !bytes.starts_with(BEGINS.as_bytes())) {
        return Err(file_error(out, "is no report of this program; choose another file or remove it"));
    }
    if out.is_dir() {
        return Err(file_error(out, "is a folder; the report is one file"));
    }
    let trial = out.with_extension("unfinished");
    fs::write(&trial, "").and_then(|()| fs::remove_file(&trial)).map_err(|e| file_error(out, e))
}

/// A folder for the results of a run that only its report is wanted of; removed in the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new() -> Result<Self> {
        let base = std::env::temp_dir();
        // One that is there already is somebody else's.
        let names = (0..100).map(|i| base.join(format!("cagedyn-report-{}-{i}", std::process::id())));
        let mut last = file_error(&base, "no folder can be made there");
        for path in names {
            match fs::create_dir(&path) {
                Ok(()) => return Ok(Self(path)),
                Err(e) => last = file_error(&path, e),
            }
        }
        Err(last)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        fs::remove_dir_all(&self.0).ok();
    }
}
