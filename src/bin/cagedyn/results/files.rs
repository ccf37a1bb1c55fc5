//! Files of results: their names, and how they are written.

use cagedyn::{Error, Result, Status};
use serde::Serialize;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Name of the table, and until it is complete.
pub const SERIES: &str = "timeseries.csv";
pub const UNFINISHED: &str = "timeseries.unfinished.csv";

/// Writes a text file, which has its name only when it is complete.
///
/// # Errors
/// [`Status::File`].
pub fn write_text(path: &Path, text: &str) -> Result<()> {
    write_with(path, |file| file.write_all(text.as_bytes()))
}

/// The same for what `write` makes.
///
/// # Errors
/// [`Status::File`].
pub fn write_with(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<()> {
    let unfinished = path.with_extension("unfinished");
    let whole = || {
        let mut file = BufWriter::new(File::create(&unfinished)?);
        write(&mut file)?;
        file.flush()?;
        fs::rename(&unfinished, path)
    };
    whole().map_err(|e| {
        fs::remove_file(&unfinished).ok();
        file_error(path, e)
    })
}

pub fn write_json(path: &Path, value: &impl Serialize) -> Result<()> {
    write_text(path, &to_json(value).map_err(|e| file_error(path, e))?)
}

/// The JSON text of a value, as files have it.
///
/// # Errors
/// [`Status::Internal`] for a value that JSON cannot express.
pub fn to_json(value: &impl Serialize) -> Result<String> {
    let text = serde_json::to_string_pretty(value);
    text.map(|text| text + "\n").map_err(|e| Error::new(Status::Internal, format!("JSON: {e}")))
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
    let mut text = Vec::new();
    add_plain(&mut text, x);
    String::from_utf8_lossy(&text).into_owned()
}

/// Appends that of a number to a text; of what is none, its name.
pub fn add_plain(text: &mut Vec<u8>, x: f64) {
    if x.is_finite() {
        serde_json::to_writer(text, &x).ok();
    } else {
        text.extend_from_slice(format!("{x:?}").as_bytes());
    }
}

/// What is wrong with a file.
pub fn file_error(path: &Path, e: impl std::fmt::Display) -> Error {
    Error::new(Status::File, format!("{}: {e}", path.display()))
}
