//! The table of a sweep: one row for each point, with what was varied, statistics of the run, and how it ended.

use super::grid::{Vary, plain_text};
use crate::cases::rollers::{OF_ROLLERS, of_rollers};
use crate::cases::whirl::{OF_WHIRL, of_whirl};
use crate::results::files::plain;
use crate::results::formats::parquet::{Column, Values};
use crate::results::summary::Summary;
use cagedyn::scene::parse_override;
use cagedyn::{Error, Spread};
use serde::{Deserialize, Serialize};
use std::collections::{HashMap, HashSet};

/// Column of [`OF_WHIRL`] that is no number.
const MOTION: &str = "motion";

/// A part of the statistics of a channel; `None` of what is not known.
type Part = (&'static str, fn(&Spread) -> Option<f64>);
const PARTS: [Part; 7] = [
    ("mean", |s| Some(s.mean)),
    ("deviation", |s| Some(s.deviation)),
    // Of a mean that has settled.
    ("standard error", |s| s.stationary.then_some(s.standard_error)),
    ("min", |s| Some(s.min)),
    ("max", |s| Some(s.max)),
    ("5 %", |s| Some(s.p05)),
    ("95 %", |s| Some(s.p95)),
];

/// Columns behind the results.
const ENDING: [&str; 6] = ["simulated time [s]", "complete", "trusted", "doubts", "error code", "error"];

/// What is known of a point that is done.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Varied values, as texts.
    pub values: Vec<String>,
    /// Names of columns with their cells, of a run that came to its end. Numbers are texts, which keep their digits.
    pub results: Vec<(String, String)>,
    /// Where the run ended, s; none if it did not start.
    pub simulated_time: Option<f64>,
    /// Whether the run kept what its preset promises; none if it did not come to its end.
    pub trusted: Option<bool>,
    /// What speaks against that.
    pub doubts: Vec<String>,
    /// Kind of the failure by its name in C, and one line about it.
    pub error: Option<(String, String)>,
}

impl Row {
    /// Of a run that came to its end.
    pub fn complete(values: Vec<String>, summary: &Summary) -> Self {
        let mut results = Vec::new();
        if summary.whirl.is_some() {
            results.extend(OF_WHIRL.map(str::to_owned).into_iter().zip(of_whirl(summary)));
        }
        let of_rollers = OF_ROLLERS.map(str::to_owned).into_iter().zip(of_rollers(summary));
        results.extend(of_rollers.filter(|(_, text)| !text.is_empty()));
        let mut add = |name: &str, value: Option<f64>| {
            results.extend(value.map(|value| (name.to_owned(), plain(value))));
        };
        add("velocity deviation [1]", summary.whirl.as_ref().and_then(|whirl| whirl.velocity_deviation));
        add("load zone [rad]", summary.load_zone.map(|zone| zone.extent_rad));
        add("power loss [W]", summary.power_loss.as_ref().map(|loss| loss.total_w));
        for (channel, statistics) in summary.statistics.iter().filter(|(name, _)| !name.contains('[')) {
            for (part, value) in PARTS {
                let text = value(&statistics.spread).map_or(String::new(), plain);
                results.push((format!("{channel} {part} [{}]", statistics.unit), text));
            }
        }
        Self {
            values,
            results,
            simulated_time: Some(summary.simulated_time_s),
            trusted: Some(summary.trusted),
            doubts: summary.doubts.clone(),
            error: None,
        }
    }

    /// Of a run that failed at a time in s, or did not start.
    pub fn failed(values: Vec<String>, simulated_time: Option<f64>, error: &Error) -> Self {
        let error = Some((error.status.name().to_owned(), error.message.clone()));
        Self { values, results: Vec::new(), simulated_time, trusted: None, doubts: Vec::new(), error }
    }

    /// A result that is a number.
    pub fn number(&self, column: &str) -> Option<f64> {
        self.results.iter().find(|(name, _)| name == column)?.1.parse().ok()
    }

    fn ending(&self) -> [String; ENDING.len()] {
        let (code, message) = self.error.clone().unwrap_or_default();
        [
            self.simulated_time.map_or(String::new(), plain),
            self.error.is_none().to_string(),
            self.trusted.map_or(String::new(), |trusted| trusted.to_string()),
            self.doubts.join("; "),
            code,
            message,
        ]
    }
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
        let found = results
            .iter()
            .map(|name| ((*name).to_owned(), if *name == MOTION { Kind::Text } else { Kind::Number }));
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
            std::iter::once(point.to_string()).chain(values).chain(found).chain(row.ending()).collect()
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
