//! The time series of a run, written while it goes on.
//!
//! Until the run has ended the table has a name that says so. Only whole rows are written, each once: a disk that is full leaves a
//! table that ends with a record. A program that is killed can leave a part of its last row, without a line's end, where the
//! system was writing at that moment.

use crate::results::files::{SERIES, UNFINISHED, add_plain, file_error};
use crate::results::table::rounded;
use cagedyn::model::Channel;
use cagedyn::{Interval, Recording, Result};
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Rows are written when there are so many bytes of them, or after this time.
const FULL: usize = 1 << 16;
const PATIENCE: Duration = Duration::from_secs(1);
/// Length of a number in the table, bytes; a little more than usual.
pub const NUMBER_LENGTH: f64 = 20.0;

/// What a record has of a watched channel: name, its unit in terms of that of the channel, value.
pub type Part = (&'static str, fn(&str) -> String, fn(&Interval) -> f64);
/// All of it, in the order of the columns.
pub const PARTS: [Part; 4] = [
    ("min", str::to_owned, |x| x.min),
    ("max", str::to_owned, |x| x.max),
    ("mean", str::to_owned, |x| x.mean),
    ("integral", over_time, |x| x.integral),
];

/// Columns of the table beside the time, of a run with so many channels, so many of them watched.
pub fn columns(recorded: usize, watched: usize) -> usize {
    recorded + PARTS.len() * watched
}

/// The time of a record as tables have it, s.
pub fn time_of_table(time: f64) -> f64 {
    rounded(time)
}

/// Unit of an integral over time.
fn over_time(unit: &str) -> String {
    if unit == "1" { "s".to_owned() } else { format!("{unit} s") }
}

/// A table in the making.
pub struct Stream {
    folder: PathBuf,
    file: File,
    /// Rows to be written.
    rows: Vec<u8>,
    /// Length of the file up to its last whole row, bytes.
    written: u64,
    last: Instant,
}

impl Stream {
    /// Starts a table in `file`, which lies in `folder`; `channels` are those of a simulation, by place.
    ///
    /// # Errors
    /// [`cagedyn::Status::File`].
    pub fn new(
        folder: &Path,
        file: File,
        channels: &[Channel],
        recorded: &[usize],
        watched: &[usize],
    ) -> Result<Self> {
        let mut rows = "time [s]".to_owned();
        for channel in recorded.iter().map(|i| &channels[*i]) {
            rows += &format!(",{} [{}]", channel.name, channel.unit);
        }
        for channel in watched.iter().map(|i| &channels[*i]) {
            for (part, unit, _) in PARTS {
                rows += &format!(",{} {part} [{}]", channel.name, unit(channel.unit));
            }
        }
        rows.push('\n');
        let mut stream =
            Self { folder: folder.to_owned(), file, rows: rows.into(), written: 0, last: Instant::now() };
        stream.flush()?;
        Ok(stream)
    }

    /// Adds the last record.
    ///
    /// # Errors
    /// [`cagedyn::Status::File`]; what the file has then ends with a whole row.
    pub fn add(&mut self, recording: &Recording) -> Result<()> {
        let Some(time) = recording.times.last() else { return Ok(()) };
        add_plain(&mut self.rows, time_of_table(*time));
        for value in recording.columns.iter().filter_map(|column| column.last()) {
            self.rows.push(b',');
            add_plain(&mut self.rows, *value);
        }
        for interval in recording.intervals.iter().filter_map(|column| column.last()) {
            for (_, _, value) in PARTS {
                self.rows.push(b',');
                add_plain(&mut self.rows, value(interval));
            }
        }
        self.rows.push(b'\n');
        if self.rows.len() >= FULL || self.last.elapsed() >= PATIENCE {
            self.flush()?;
        }
        Ok(())
    }

    fn flush(&mut self) -> Result<()> {
        let written = self.file.write_all(&self.rows).and_then(|()| self.file.flush());
        if let Err(e) = written {
            // A row cut within a number would still be read: what there is ends with the last whole one.
            let length = self.file.metadata().map_or(0, |data| data.len()).saturating_sub(self.written);
            let rows = self.rows.get(..length as usize).unwrap_or_default();
            let whole = rows.iter().rposition(|byte| *byte == b'\n').map_or(0, |last| last + 1);
            self.file.set_len(self.written + whole as u64).ok();
            return Err(file_error(&self.folder.join(UNFINISHED), e));
        }
        self.written += self.rows.len() as u64;
        self.rows.clear();
        self.last = Instant::now();
        Ok(())
    }

    /// The run has ended: the table is complete and gets its name.
    ///
    /// # Errors
    /// [`cagedyn::Status::File`].
    pub fn finish(mut self) -> Result<()> {
        self.flush()?;
        let path = self.folder.join(SERIES);
        self.file
            .sync_all()
            .and_then(|()| fs::rename(self.folder.join(UNFINISHED), &path))
            .map_err(|e| file_error(&path, e))
    }
}
