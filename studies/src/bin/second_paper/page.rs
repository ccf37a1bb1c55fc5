//! Tables, and their places in the page.

use cagedyn::{Error, Result, Status};
use std::path::Path;

const END: &str = "<!-- end -->";

/// A table of texts.
pub struct Table {
    /// Its name, which marks its place.
    pub name: &'static str,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// One with these heads.
    pub fn new(name: &'static str, head: &[&str]) -> Self {
        Self { name, rows: vec![head.iter().map(|text| (*text).to_owned()).collect()] }
    }

    /// Adds a row.
    pub fn add<const N: usize>(&mut self, row: [String; N]) {
        self.rows.push(row.to_vec());
    }

    /// As Markdown.
    pub fn text(&self) -> String {
        let mut text = String::new();
        for (i, row) in self.rows.iter().enumerate() {
            text += &format!("| {} |\n", row.join(" | "));
            if i == 0 {
                text += &format!("|---|{}\n", "---:|".repeat(row.len() - 1));
            }
        }
        text
    }
}

/// Writes tables into a page that has places for them.
///
/// # Errors
/// A page that cannot be read or written, or without the places.
pub fn write(path: &Path, tables: &[Table]) -> Result<()> {
    let mut page = std::fs::read_to_string(path).map_err(|e| cagedyn_studies::file_error(path, e))?;
    for table in tables {
        let marker = format!("<!-- {} -->\n", table.name);
        let start = page.find(&marker).map(|at| at + marker.len());
        let place = start.and_then(|start| Some(start..start + page[start..].find(END)?));
        let place = place
            .ok_or_else(|| Error::new(Status::File, format!("{}: no place for {marker}", path.display())))?;
        page.replace_range(place, &format!("\n{}\n", table.text()));
    }
    std::fs::write(path, page).map_err(|e| cagedyn_studies::file_error(path, e))
}
