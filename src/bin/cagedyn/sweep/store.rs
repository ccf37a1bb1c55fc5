//! The folder of a sweep: what it is of, and its finished points, each of which is kept from the moment that it is done.

use crate::points::{Records, Row};
use crate::results::files::{file_error, write_text};
use cagedyn::Result;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Name of the file that tells what the sweep is of.
pub const SWEEP: &str = "sweep.json";
/// Name of the folder of finished points.
const POINTS: &str = "points";
/// Names of what a finished sweep writes.
pub const TABLE: &str = "sweep.csv";
pub const PARQUET: &str = "sweep.parquet";
pub const PICTURE: &str = "sweep.svg";
pub const SPECTRA: &str = "spectra.csv";
pub const WATERFALL: &str = "waterfall.svg";
/// Name of the table of a part of the points.
pub const PART_TABLE: &str = "sweep.part.csv";
/// Name of a table of some of the points.
pub const UNFINISHED: &str = "sweep.unfinished.csv";

/// The folder of a sweep, which this program has for itself if it writes to it.
pub struct Store {
    points: Records,
}

impl Store {
    /// Makes the folder, or takes up a sweep that was left before its end. `identity` has all that results depend on, as
    /// JSON.
    ///
    /// # Errors
    /// [`cagedyn::Status::File`], also for a folder that another sweep writes to, and for one with another sweep or with files of
    /// these names that are somebody else's.
    pub fn open(folder: &Path, identity: &str) -> Result<Self> {
        let (path, points) = (folder.join(SWEEP), folder.join(POINTS));
        let begun = fs::exists(&path).map_err(|e| file_error(&path, e))?;
        if begun {
            check(folder, &path, identity)?;
        } else if let Some(name) = [POINTS, TABLE, PARQUET, PICTURE, SPECTRA, WATERFALL, PART_TABLE]
            .iter()
            .find(|name| folder.join(name).exists())
        {
            return Err(file_error(
                &folder.join(name),
                "is not of a sweep; choose another folder or remove it",
            ));
        }
        let points = Records::open(&points, "sweep")?;
        if !begun && let Err(e) = write_text(&path, identity) {
            points.discard();
            return Err(e);
        }
        Ok(Self { points })
    }

    /// The folder of a sweep that is only read.
    pub fn read(folder: &Path) -> Self {
        Self { points: Records::read(&folder.join(POINTS)) }
    }

    /// The row of a point that is done.
    pub fn row(&self, point: usize, values: &[String]) -> Option<Row> {
        self.points.get(&name(point)).filter(|row: &Row| row.values == values)
    }

    /// Keeps the row of a point.
    ///
    /// # Errors
    /// [`cagedyn::Status::File`]; the points before are kept.
    pub fn keep(&self, point: usize, row: &Row) -> Result<()> {
        self.points.keep(&name(point), row)
    }
}

/// Name of the record of a point.
fn name(point: usize) -> String {
    format!("{point:05}")
}

/// Refuses a folder with another sweep, and tells in what it differs.
fn check(folder: &Path, path: &Path, identity: &str) -> Result<()> {
    let text = fs::read_to_string(path).map_err(|e| file_error(path, e))?;
    // The same reader for both, so that numbers are the same.
    let [found, wanted] = [&*text, identity].map(|text| serde_json::from_str(text).unwrap_or(Value::Null));
    let differs = match difference(&found, &wanted) {
        None => return Ok(()),
        Some(_) if !found.is_object() => format!("{SWEEP} is none of this version"),
        Some("scene") => "the scene file differs".to_owned(),
        Some(name) => format!("{name} was {}", found[name]),
    };
    Err(file_error(folder, format!("has another sweep ({differs}); choose another folder or remove it")))
}

/// The first field in which two descriptions of sweeps differ; one that is absent is null.
pub fn difference<'a>(found: &'a Value, wanted: &'a Value) -> Option<&'a str> {
    let names = [wanted, found].into_iter().filter_map(Value::as_object).flat_map(|fields| fields.keys());
    names.map(String::as_str).find(|name| found[*name] != wanted[*name])
}
