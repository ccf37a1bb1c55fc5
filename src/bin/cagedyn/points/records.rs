//! A folder of records, one file for each run that is done: whatever ends the program costs no run that was done before.

use crate::results::files::{file_error, write_with};
use cagedyn::Result;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

/// Name of the file that a program holds while it adds records.
const LOCK: &str = "lock";

/// The records, which this program has for itself if it adds some.
pub struct Records {
    folder: PathBuf,
    /// Held as long as this lives.
    _lock: Option<File>,
}

impl Records {
    /// Makes the folder, or takes up its records.
    ///
    /// # Errors
    /// [`cagedyn::Status::File`], also for a folder that another program adds to; `of` is what it is then said to be.
    pub fn open(folder: &Path, of: &str) -> Result<Self> {
        fs::create_dir_all(folder).map_err(|e| file_error(folder, e))?;
        let lock = folder.join(LOCK);
        let file = File::options().create(true).append(true).open(&lock).map_err(|e| file_error(&lock, e))?;
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            let outside = folder.parent().unwrap_or(folder);
            return Err(file_error(outside, format!("another {of} is writing to this folder")));
        }
        Ok(Self { folder: folder.to_owned(), _lock: Some(file) })
    }

    /// The records of a folder that others may add to, and that may have none.
    pub fn read(folder: &Path) -> Self {
        Self { folder: folder.to_owned(), _lock: None }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.join(format!("{name}.json"))
    }

    /// The record of this name. What cannot be read as one, as after a loss of power, is none.
    pub fn get<T: DeserializeOwned>(&self, name: &str) -> Option<T> {
        serde_json::from_str(&fs::read_to_string(self.path(name)).ok()?).ok()
    }

    /// Keeps a record.
    ///
    /// # Errors
    /// [`cagedyn::Status::File`]; the others are kept.
    pub fn keep(&self, name: &str, record: &impl Serialize) -> Result<()> {
        let path = self.path(name);
        let text = serde_json::to_string_pretty(record).map_err(|e| file_error(&path, e))?;
        write_with(&path, |file| writeln!(file, "{text}"))
    }

    /// Removes all of them but those of these names.
    pub fn retain(&self, kept: impl Fn(&str) -> bool) {
        for entry in fs::read_dir(&self.folder).into_iter().flatten().flatten() {
            let name = entry.file_name();
            if name.to_str().and_then(|name| name.strip_suffix(".json")).is_some_and(|name| !kept(name)) {
                fs::remove_file(entry.path()).ok();
            }
        }
    }

    /// Removes the folder, which was made in vain.
    pub fn discard(self) {
        fs::remove_file(self.folder.join(LOCK)).ok();
        fs::remove_dir(&self.folder).ok();
    }
}
