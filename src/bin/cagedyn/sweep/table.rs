//! The table of a sweep: one row for each point, with what was varied, statistics of the run, and how it ended.

use super::grid::{Vary, plain_text};
use crate::points::columns::{MOTION, WOBBLE};
use crate::points::{Row, spectrum};
use crate::results::formats::parquet::{Column, Values};
use cagedyn::scene::parse_override;
use std::collections::{HashMap, HashSet};

/// Columns behind the results.
const ENDING: [&str; 6] = ["simulated time [s]", "complete", "trusted", "doubts", "error code", "error"];

/// Their cells.
fn cells_of_ending(row: &Row) -> [String; ENDING.len()] {
    let (code, message) = row.error.clone().unwrap_or_default();
    [
        row.simulated_time.clone().unwrap_or_default(),
        row.error.is_none().to_string(),
        row.trusted.map_or(String::new(), |trusted| trusted.to_string()),
        row.doubts.join("; "),
        code,
        message,
    ]
}

/// A table of points, each with its row.
pub struct Table {
    head: Vec<String>,
    /// What each column has.
    kinds: Vec<Kind>,
    rows: Vec<Vec<String>>,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Whole,
    Number,
    Flag,
    Text,
}

impl Table {
    /// Of the points that are done.
    pub fn new(vary: &[Vary], rows: &[(usize, Row)]) -> Self {
        let mut known = HashSet::new();
        let found = rows.iter().flat_map(|(_, row)| &row.results).map(|(name, _)| name.as_str());
        let results: Vec<&str> = found.filter(|name| known.insert(*name)).collect();
        let varied = vary
            .iter()
            .map(|one| (one.path.clone(), if one.values.numeric() { Kind::Number } else { Kind::Text }));
        let found = results.iter().map(|name| {
            ((*name).to_owned(), if [MOTION, WOBBLE].contains(name) { Kind::Text } else { Kind::Number })
        });
        let ending = ENDING.map(|name| {
            let kind = match name {
                "simulated time [s]" => Kind::Number,
                "complete" | "trusted" => Kind::Flag,
                _ => Kind::Text,
            };
            (name.to_owned(), kind)
        });
        let point = std::iter::once(("point".to_owned(), Kind::Whole));
        let (head, kinds) = point.chain(varied).chain(found).chain(ending).unzip();
        let cells = rows.iter().map(|(point, row)| {
            let values = row.values.iter().map(|text| plain_text(&parse_override(text)));
            let of: HashMap<&str, &str> =
                row.results.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
            let found =
                results.iter().map(move |name| of.get(name).map_or(String::new(), |text| (*text).to_owned()));
            std::iter::once(point.to_string())
                .chain(values)
                .chain(found)
                .chain(cells_of_ending(row))
                .collect()
        });
        Self { head, kinds, rows: cells.collect() }
    }

    /// Head and rows.
    pub fn csv(&self) -> impl Iterator<Item = Vec<String>> {
        std::iter::once(self.head.clone()).chain(self.rows.iter().cloned())
    }

    /// Number of rows.
    pub fn length(&self) -> usize {
        self.rows.len()
    }

    /// The same with types; a cell that is empty has no value.
    pub fn parquet(&self) -> Vec<Column<'_>> {
        let columns = self.head.iter().zip(&self.kinds).enumerate();
        let column = |(k, (name, kind)): (usize, (&String, &Kind))| {
            let cell = move |i: usize| Some(self.rows[i][k].as_str()).filter(|text| !text.is_empty());
            let values = match kind {
                Kind::Whole => Values::Wholes(Box::new(move |i| cell(i)?.parse().ok())),
                Kind::Number => Values::Numbers(Box::new(move |i| cell(i)?.parse().ok())),
                Kind::Flag => Values::Flags(Box::new(move |i| cell(i)?.parse().ok())),
                Kind::Text => Values::Texts(Box::new(cell)),
            };
            Column { name: name.clone(), values }
        };
        columns.map(column).collect()
    }
}

/// The table of the spectra over one number, head first: a row for every line of every point. `None` if there are none.
pub fn spectra(vary: &[Vary], rows: &[(usize, Row)]) -> Option<impl Iterator<Item = Vec<String>>> {
    let found = rows.iter().filter_map(|(point, row)| Some((point, row, row.spectrum.as_ref()?)));
    found.clone().next()?;
    let lines = found.flat_map(|(point, row, spectrum)| {
        let of_point = std::iter::once(point.to_string()).chain(row.values.iter().cloned());
        let of_point: Vec<String> = of_point.collect();
        spectrum.rows().map(move |line| of_point.iter().cloned().chain(line).collect())
    });
    let head = std::iter::once("point").chain(vary.iter().map(|one| one.path.as_str()));
    let head = head.chain(spectrum::COLUMNS).map(str::to_owned).collect();
    Some(std::iter::once(head).chain(lines))
}
