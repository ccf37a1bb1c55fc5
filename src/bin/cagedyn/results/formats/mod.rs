//! The time series of a run in formats that other programs read in one line.

pub mod mat;
pub mod parquet;

use crate::results::files::{self, SERIES, write_with};
use crate::results::finished::Run;
use crate::results::stream;
use cagedyn::Result;
use clap::ValueEnum;
use std::path::Path;

/// A format of the time series.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum TableFormat {
    /// Comma-separated values: timeseries.csv.
    Csv,
    /// Apache Parquet, for pandas and the like: timeseries.parquet.
    Parquet,
    /// MATLAB level 5, for MATLAB, Octave and scipy: timeseries.mat.
    Mat,
}

/// File names of the formats that are written when a run has ended.
pub const SERIES_FILES: [&str; 2] = ["timeseries.parquet", "timeseries.mat"];

/// A column of a run: name, unit, and its number at a record.
pub struct Column<'a> {
    /// Name without unit.
    pub name: String,
    /// Unit; "1" for ratios.
    pub unit: String,
    /// Value at a record.
    pub at: Box<dyn Fn(usize) -> f64 + 'a>,
}

/// The columns of the table of a run, in its order.
fn columns(run: &Run) -> Vec<Column<'_>> {
    let recording = &run.recording;
    let times = &recording.times;
    let mut columns = vec![Column {
        name: "time".to_owned(),
        unit: "s".to_owned(),
        at: Box::new(|i| stream::time_of_table(times[i])),
    }];
    columns.extend(run.channels.iter().zip(&recording.columns).map(|(channel, values)| Column {
        name: channel.name.clone(),
        unit: channel.unit.to_owned(),
        at: Box::new(move |i| values[i]),
    }));
    let all = run.model.channels();
    let watched = run.model.watched().iter().map(|i| &all[*i]).zip(&recording.intervals);
    columns.extend(watched.flat_map(|(channel, intervals)| {
        stream::PARTS.into_iter().map(move |(part, unit, value)| Column {
            name: format!("{} {part}", channel.name),
            unit: unit(channel.unit),
            at: Box::new(move |i| value(&intervals[i])),
        })
    }));
    columns
}

/// Writes the records of a run in the formats that are asked for, and gives the names of all tables that are there. Where all of
/// them could be written and none is CSV, the table of that format is removed.
///
/// # Errors
/// [`cagedyn::Status::File`]; the table of comma-separated values is then still there.
pub fn write(run: &Run, folder: &Path, formats: &[TableFormat]) -> Result<Vec<&'static str>> {
    let records = run.recording.times.len();
    let mut written = vec![SERIES];
    for (format, name) in [TableFormat::Parquet, TableFormat::Mat].into_iter().zip(SERIES_FILES) {
        if !formats.contains(&format) {
            continue;
        }
        let columns = columns(run);
        write_with(&folder.join(name), |file| match format {
            TableFormat::Parquet => {
                let table: Vec<parquet::Column<'_>> = columns.iter().map(as_parquet).collect();
                parquet::write(file, records, &table)
            }
            _ => mat::write(file, records, &columns),
        })?;
        written.push(name);
    }
    if !formats.contains(&TableFormat::Csv) && written.len() > 1 {
        let path = folder.join(SERIES);
        std::fs::remove_file(&path).map_err(|e| files::file_error(&path, e))?;
        written.remove(0);
    }
    Ok(written)
}

fn as_parquet<'a>(column: &'a Column<'a>) -> parquet::Column<'a> {
    parquet::Column {
        name: format!("{} [{}]", column.name, column.unit),
        values: parquet::Values::Numbers(Box::new(|i| Some((column.at)(i)))),
    }
}
