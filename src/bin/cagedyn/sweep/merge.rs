//! The command `merge`: the parts of a sweep become the whole one.

use super::args::{MergeArgs, SweepArgs};
use super::grid::parse_vary;
use super::portion::{Portion, parse_portion};
use super::store::{self, Store, difference};
use super::{PART, PROGRAM, SCENE_FILE, Sweep};
use crate::points::Row;
use crate::results::files::file_error;
use crate::{Sets, parse_preset, parse_set, terminal};
use cagedyn::{Error, Result, Status};
use serde::Deserialize;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Copies the points of all parts into one folder, and writes what a sweep of all points writes.
///
/// # Errors
/// Folders that are no parts of one sweep of this program, parts that are there twice, points that are missing; a folder that
/// cannot be used. A point that failed is a row.
pub fn command(args: &MergeArgs) -> Result<ExitCode> {
    let parts = args.parts.iter().map(|folder| Part::read(folder)).collect::<Result<Vec<_>>>()?;
    let (first, others) =
        parts.split_first().ok_or_else(|| Error::new(Status::BadValue, "PART_DIR: none"))?;
    others.iter().try_for_each(|other| other.check_same(first))?;
    let arguments = first.arguments(&args.out)?;
    let sweep = Sweep::new(&arguments, first.sweep["scene"].to_string())?;
    check_once(&parts, sweep.points.len())?;
    let rows = rows(&parts, first.portion.count, &sweep.points)?;
    terminal::listen_for_interrupt()?;
    let store = Store::open(&args.out, &first.whole())?;
    rows.iter().try_for_each(|(point, row)| store.keep(*point, row))?;
    sweep.complete(&store, rows)
}

/// A folder with a part of a sweep.
struct Part<'a> {
    folder: &'a Path,
    /// Text of what the sweep is of.
    text: String,
    /// The same but for which part it is.
    sweep: Value,
    portion: Portion,
    store: Store,
}

/// What the arguments of a sweep are made of.
#[derive(Deserialize)]
struct Given {
    set: Vec<String>,
    vary: Vec<String>,
    latin: Option<u32>,
    seed: Option<u64>,
    until: Option<f64>,
    preset: Option<String>,
    scene_file: PathBuf,
}

impl<'a> Part<'a> {
    /// Reads what a folder is of.
    fn read(folder: &'a Path) -> Result<Self> {
        let path = folder.join(store::SWEEP);
        let text = fs::read_to_string(&path).map_err(|e| file_error(&path, e))?;
        let mut sweep: Value = serde_json::from_str(&text).map_err(|e| file_error(&path, e))?;
        for (name, ours) in PROGRAM {
            if sweep[name] != ours {
                let text = format!("{name} is {}; this program merges {ours:?} only", sweep[name]);
                return Err(file_error(&path, text));
            }
        }
        let part = sweep.as_object_mut().and_then(|fields| fields.remove(PART));
        let Some(part) = part else {
            return Err(file_error(folder, "has a whole sweep; merged are folders of sweep --part K/N"));
        };
        let portion = parse_portion(part.as_str().unwrap_or_default());
        let portion = portion.map_err(|e| file_error(&path, format!("{PART}: {part}: {e}")))?;
        Ok(Self { folder, text, sweep, portion, store: Store::read(folder) })
    }

    /// Refuses a part of another sweep, or of another division.
    fn check_same(&self, other: &Self) -> Result<()> {
        let differs = match difference(&self.sweep, &other.sweep) {
            Some("scene") => "the scene differs".to_owned(),
            Some(name) => format!("{name} is {}, not {}", self.sweep[name], other.sweep[name]),
            None if self.portion.count != other.portion.count => {
                format!("part is {}, not one of {}", self.portion, other.portion.count)
            }
            None => return Ok(()),
        };
        let text = format!("is of another sweep than {} ({differs})", other.folder.display());
        Err(file_error(self.folder, text))
    }

    /// The arguments of the whole sweep.
    fn arguments(&self, out: &Path) -> Result<SweepArgs> {
        let refused = |e: String| file_error(&self.folder.join(store::SWEEP), e);
        let given = Given::deserialize(&self.sweep).map_err(|e| refused(e.to_string()))?;
        Ok(SweepArgs {
            scene: given.scene_file,
            out: out.to_owned(),
            vary: each(&given.vary, parse_vary).map_err(refused)?,
            latin: given.latin,
            seed: given.seed.unwrap_or_default(),
            until: given.until,
            preset: given.preset.as_deref().map(parse_preset).transpose().map_err(refused)?,
            jobs: None,
            part: None,
            sets: Sets { list: each(&given.set, parse_set).map_err(refused)? },
        })
    }

    /// What the whole sweep is of. Lines of text are left out, as numbers that are read and written again can change in their
    /// last digit.
    fn whole(&self) -> String {
        let own = [PART, SCENE_FILE].map(|name| format!("  \"{name}\": "));
        let lines = self.text.split_inclusive('\n');
        lines.filter(|line| !own.iter().any(|own| line.starts_with(own))).collect()
    }
}

/// What these texts say, or what is wrong with the first that says nothing.
fn each<T, E>(
    texts: &[String],
    parse: impl Fn(&str) -> std::result::Result<T, E>,
) -> std::result::Result<Vec<T>, E> {
    texts.iter().map(|text| parse(text)).collect()
}

/// Refuses points that are there twice.
fn check_once(parts: &[Part<'_>], points: usize) -> Result<()> {
    let mut folders = BTreeMap::new();
    for Part { folder, portion, .. } in parts {
        if let Some(other) = folders.insert(portion.number, folder) {
            let twice = (0..points).filter(|point| portion.has(*point)).count();
            let first = portion.number - 1;
            let text = format!(
                "twice: {twice} of {points} points, first {first}; {} is part {portion}, too",
                other.display()
            );
            return Err(file_error(folder, text));
        }
    }
    Ok(())
}

/// The rows of all points, in order, from so many parts; points that are missing are an error that tells of which parts they are.
fn rows(parts: &[Part<'_>], count: usize, points: &[Vec<String>]) -> Result<Vec<(usize, Row)>> {
    let (mut rows, mut missing) = (Vec::new(), Vec::new());
    for (point, values) in points.iter().enumerate() {
        let part = parts.iter().find(|part| part.portion.has(point));
        match part.and_then(|part| part.store.row(point, values)) {
            Some(row) => rows.push((point, row)),
            None => missing.push(point),
        }
    }
    let Some(first) = missing.first() else { return Ok(rows) };
    let lacking: BTreeSet<usize> = missing.iter().map(|point| point % count + 1).collect();
    let given = |number: &usize| parts.iter().any(|part| part.portion.number == *number);
    let (again, absent): (Vec<usize>, Vec<usize>) = lacking.into_iter().partition(given);
    let mut text = format!("missing: {} of {} points, first {first}", missing.len(), points.len());
    if !again.is_empty() {
        text += &format!("; run {} again", in_words(&again, count));
    }
    if !absent.is_empty() {
        text += &format!("; give {}, too", in_words(&absent, count));
    }
    Err(Error::new(Status::File, text))
}

/// "part 8/8", "parts 3,7 of 8", as job arrays take them.
fn in_words(numbers: &[usize], count: usize) -> String {
    match numbers {
        [number] => format!("part {number}/{count}"),
        _ => {
            let numbers: Vec<String> = numbers.iter().map(usize::to_string).collect();
            format!("parts {} of {count}", numbers.join(","))
        }
    }
}
