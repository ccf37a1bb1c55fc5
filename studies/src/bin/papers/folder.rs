//! Folders that `cagedyn run` and `cagedyn cases` have written.

use cagedyn::{Error, Result, Status};
use cagedyn_studies::file_error;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A folder of a run.
pub struct Folder {
    path: PathBuf,
    summary: Value,
}

impl Folder {
    /// Reads its summary.
    ///
    /// # Errors
    /// [`Status::File`], also for a run that did not come to its end.
    pub fn new(path: &Path) -> Result<Self> {
        let file = path.join("summary.json");
        let text = std::fs::read_to_string(&file).map_err(|e| file_error(&file, e))?;
        let summary: Value = serde_json::from_str(&text).map_err(|e| file_error(&file, e))?;
        if summary["complete"] != true {
            return Err(file_error(&file, "is not of a run that came to its end"));
        }
        Ok(Self { path: path.to_owned(), summary })
    }

    /// A number of the summary by its JSON pointer.
    ///
    /// # Errors
    /// [`Status::File`] where it is not.
    pub fn number(&self, pointer: &str) -> Result<f64> {
        self.find(pointer).and_then(Value::as_f64).ok_or_else(|| self.missing(pointer))
    }

    /// A part of the summary.
    pub fn find(&self, pointer: &str) -> Option<&Value> {
        self.summary.pointer(pointer)
    }

    /// Mean of a channel in the averaging window.
    ///
    /// # Errors
    /// As [`Folder::number`].
    pub fn mean(&self, channel: &str) -> Result<f64> {
        self.number(&format!("/statistics/{channel}/mean"))
    }

    /// Amplitude of a line of the spectrum and its frequency, m and Hz.
    ///
    /// # Errors
    /// As [`Folder::number`].
    pub fn line(&self, name: &str) -> Result<(f64, f64)> {
        let lines = self.find("/spectrum/lines").and_then(Value::as_array);
        let line = lines.and_then(|lines| lines.iter().find(|line| line["name"] == name));
        let found =
            line.and_then(|line| Some((line["amplitude_m"].as_f64()?, line["frequency_hz"].as_f64()?)));
        found.ok_or_else(|| self.missing(name))
    }

    /// A list of the sectors of the orbit; NaN where nothing was seen.
    ///
    /// # Errors
    /// As [`Folder::number`].
    pub fn sectors(&self, name: &str) -> Result<Vec<f64>> {
        let list = self.find(&format!("/over_orbit/{name}")).and_then(Value::as_array);
        let list = list.ok_or_else(|| self.missing(name))?;
        Ok(list.iter().map(|x| x.as_f64().unwrap_or(f64::NAN)).collect())
    }

    /// Columns of the time series by the beginnings of their heads, times first.
    ///
    /// # Errors
    /// [`Status::File`].
    pub fn columns(&self, names: &[&str]) -> Result<Vec<Vec<f64>>> {
        let file = self.path.join("timeseries.csv");
        let mut reader = csv::Reader::from_path(&file).map_err(|e| file_error(&file, e))?;
        let heads = reader.headers().map_err(|e| file_error(&file, e))?.clone();
        let place = |name: &str| {
            let head = format!("{name} [");
            heads
                .iter()
                .position(|h| h.starts_with(&head))
                .ok_or_else(|| file_error(&file, format!("has no {name}")))
        };
        let wanted = ["time"].iter().chain(names);
        let places = wanted.map(|name| place(name)).collect::<Result<Vec<usize>>>()?;
        let mut columns = vec![Vec::new(); places.len()];
        for record in reader.records() {
            let record = record.map_err(|e| file_error(&file, e))?;
            for (column, place) in columns.iter_mut().zip(&places) {
                let text = record.get(*place).unwrap_or_default();
                column.push(text.parse().map_err(|_| file_error(&file, format!("'{text}' is no number")))?);
            }
        }
        Ok(columns)
    }

    fn missing(&self, what: &str) -> Error {
        Error::new(Status::File, format!("{}: summary.json has no {what}", self.path.display()))
    }
}
