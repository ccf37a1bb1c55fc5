//! Tables as text and as CSV files.

use cagedyn::Result;
use std::path::Path;

/// Name, headings and lines of a table.
pub struct Table {
    /// Name, for the file and the marker on the page.
    pub name: String,
    /// Headings.
    pub head: Vec<String>,
    /// Lines, each as long as the headings.
    pub lines: Vec<Vec<String>>,
}

impl Table {
    /// One with these headings.
    pub fn new(name: &str, head: &[&str]) -> Self {
        let head = head.iter().map(|text| (*text).to_owned()).collect();
        Self { name: name.to_owned(), head, lines: Vec::new() }
    }

    /// Adds a line.
    pub fn add<const N: usize>(&mut self, line: [String; N]) {
        self.lines.push(line.to_vec());
    }

    /// The table in Markdown.
    pub fn text(&self) -> String {
        let line = |texts: &[String]| format!("| {} |\n", texts.join(" | "));
        let rule: String = (0..self.head.len()).map(|k| if k == 0 { "|---" } else { "|---:" }).collect();
        let lines: String = self.lines.iter().map(|texts| line(texts)).collect();
        format!("{}{rule}|\n{lines}", line(&self.head))
    }

    /// Writes the table as a CSV file.
    ///
    /// # Errors
    /// [`cagedyn::Status::File`].
    pub fn save(&self, folder: &Path) -> Result<()> {
        let path = folder.join(format!("{}.csv", self.name.replace(' ', "_")));
        let write = || {
            let mut writer = csv::Writer::from_path(&path)?;
            std::iter::once(&self.head).chain(&self.lines).try_for_each(|line| writer.write_record(line))?;
            Ok(writer.flush()?)
        };
        write().map_err(|e: csv::Error| crate::file_error(&path, e))
    }
}
