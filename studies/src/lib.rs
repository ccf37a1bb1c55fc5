//! Studies of cagedyn, and what they share with its tests: what effects cost and change, statistics of long runs, random scenes;
//! CVODE as a reference, random numbers, pictures.

#![allow(missing_docs, clippy::result_unit_err, reason = "read in this repository only")]

pub mod bearings;
pub mod cvode;
pub mod effects;
pub mod judge;
pub mod page;
#[path = "../../src/bin/cagedyn/plots"]
pub mod plots {
    pub mod axis;
    pub mod panel;
    pub mod style;
}
pub mod random;
#[path = "../../src/bin/cagedyn/spectrum.rs"]
pub mod spectrum;
pub mod statistics;
pub mod table;
pub mod waves;
#[path = "../../src/bin/cagedyn/workers.rs"]
pub mod workers;

use cagedyn::{Error, Result, Status};
use std::path::Path;

/// Puts tables into a page, each by its name between the marker of that name and the end marker.
pub fn write_tables<'a>(path: &Path, tables: impl IntoIterator<Item = (&'a str, String)>) -> Result<()> {
    const END: &str = "<!-- end -->";
    let mut page = std::fs::read_to_string(path).map_err(|e| file_error(path, e))?;
    for (name, text) in tables {
        let marker = format!("<!-- {name} -->\n");
        let start = page.find(&marker).map(|at| at + marker.len());
        let place = start.and_then(|start| Some(start..start + page[start..].find(END)?));
        let place = place
            .ok_or_else(|| Error::new(Status::File, format!("{}: no place for {marker}", path.display())))?;
        page.replace_range(place, &format!("\n{text}\n"));
    }
    std::fs::write(path, page).map_err(|e| file_error(path, e))
}

/// An error with a path.
pub fn file_error(path: &Path, e: impl std::fmt::Display) -> Error {
    Error::new(Status::File, format!("{}: {e}", path.display()))
}
