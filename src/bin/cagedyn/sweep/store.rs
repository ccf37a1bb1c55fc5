//! The folder of a sweep: what it is of, and its finished points, each of which is kept from the moment that it is done.

use crate::results::files::{file_error, write_json, write_with};
use crate::sweep::table::Row;
use cagedyn::Result;
use serde_json::Value;
use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

/// Name of the file that tells what the sweep is of.
const SWEEP: &str = "sweep.json";
/// Name of the folder of finished points, and of the file in it that a running sweep holds.
const POINTS: &str = "points";
const LOCK: &str = "lock";
/// Names of what a finished sweep writes.
pub const TABLE: &str = "sweep.csv";
pub const PARQUET: &str = "sweep.parquet";
pub const PICTURE: &str = "sweep.svg";
/// Name of a table of some of the points.
pub const UNFINISHED: &str = "sweep.unfinished.csv";

/// The folder of a sweep that this program has for itself.
pub struct Store {
    points: PathBuf,
    /// Held as long as this lives.
    _lock: File,
}

impl Store {
    /// Makes the folder, or takes up a sweep that was left before its end. `identity` has all that results depend on.
    ///
    /// # Errors
    /// [`cagedyn::Status::File`], also for a folder that another sweep writes to, and for one with another sweep or with files of
    /// these names that are somebody else's.
    pub fn open(folder: &Path, identity: &Value) -> Result<Self> {
        let (path, points) = (folder.join(SWEEP), folder.join(POINTS));
        let begun = fs::exists(&path).map_err(|e| file_error(&path, e))?;
        if begun {
            check(folder, &path, identity)?;
        } else if let Some(name) =
            [POINTS, TABLE, PARQUET, PICTURE].iter().find(|name| folder.join(name).exists())
        {
            return Err(file_error(
                &folder.join(name),
                "is not of a sweep; choose another folder or remove it",
            ));
        }
        fs::create_dir_all(&points).map_err(|e| file_error(&points, e))?;
        let lock = points.join(LOCK);
        let file = File::options().create(true).append(true).open(&lock).map_err(|e| file_error(&lock, e))?;
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(file_error(folder, "another sweep is writing to this folder"));
        }
        if !begun {
            let made = write_json(&path, identity);
            if made.is_err() {
                fs::remove_file(&lock).ok();
                fs::remove_dir(&points).ok();
            }
            made?;
        }
        Ok(Self { points, _lock: file })
    }

    fn path(&self, point: usize) -> PathBuf {
        self.points.join(format!("{point:05}.json"))
    }

    /// The row of a point that is done. What cannot be read as one, as after a loss of power, is not done.
    pub fn row(&self, point: usize, values: &[String]) -> Option<Row> {
        let row: Row = serde_json::from_str(&fs::read_to_string(self.path(point)).ok()?).ok()?;
        (row.values == values).then_some(row)
    }

    /// Keeps the row of a point.
    ///
    /// # Errors
    /// [`cagedyn::Status::File`]; the points before are kept.
    pub fn keep(&self, point: usize, row: &Row) -> Result<()> {
        let path = self.path(point);
        let text = serde_json::to_string_pretty(row).map_err(|e| file_error(&path, e))?;
        write_with(&path, |file| writeln!(file, "{text}"))
    }
}

/// Refuses a folder with another sweep, and tells in what it differs.
fn check(folder: &Path, path: &Path, identity: &Value) -> Result<()> {
    let text = fs::read_to_string(path).map_err(|e| file_error(path, e))?;
    // The same reader for both, so that numbers are the same.
    let found: Option<Value> = serde_json::from_str(&text).ok();
    let wanted: Option<Value> = serde_json::from_str(&identity.to_string()).ok();
    if found == wanted {
        return Ok(());
    }
    let of = |value: &Option<Value>, name: &str| value.as_ref().and_then(|value| value.get(name)).cloned();
    let names = identity.as_object().into_iter().flat_map(|fields| fields.keys());
    let other = names.into_iter().find(|name| of(&found, name) != of(&wanted, name));
    let differs = match other.map(|name| (name.as_str(), of(&found, name))) {
        Some(("scene", Some(_))) => "the scene file differs".to_owned(),
        Some((name, Some(was))) => format!("{name} was {was}"),
        _ => "sweep.json is none of this version".to_owned(),
    };
    Err(file_error(folder, format!("has another sweep ({differs}); choose another folder or remove it")))
}
