//! What is kept of a run that is done: its results as cells of tables, and how it ended.

use super::columns::{OF_ROLLERS, OF_WHIRL, WOBBLE, of_rollers, of_whirl};
use super::spectrum::Spectrum;
use crate::results::files::plain;
use crate::results::summary::{FEW_TURNS, Summary};
use cagedyn::{CageMotion, Error, Spread};
use serde::{Deserialize, Serialize};

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

/// Column of the turns of the cage in the run.
pub const CAGE_TURNS: &str = "cage turns [1]";

/// What is known of a run that is done.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Varied values, as texts.
    pub values: Vec<String>,
    /// Names of columns with their cells, of a run that came to its end. Numbers are texts, which keep their digits.
    pub results: Vec<(String, String)>,
    /// Where the run ended, s; none if it did not start.
    pub simulated_time: Option<String>,
    /// Whether the run kept what its preset promises; none if it did not come to its end.
    pub trusted: Option<bool>,
    /// What speaks against that.
    pub doubts: Vec<String>,
    /// Kind of the failure by its name in C, and one line about it.
    pub error: Option<(String, String)>,
    /// Spectrum of the cage, where it is asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spectrum: Option<Spectrum>,
}

impl Row {
    /// Of a run that came to its end.
    pub fn complete(values: Vec<String>, summary: &Summary) -> Self {
        let mut results = Vec::new();
        if summary.whirl.is_some() {
            results.extend(OF_WHIRL.map(str::to_owned).into_iter().zip(of_whirl(summary)));
        }
        if let Some(wobble) = &summary.wobble {
            results.push((WOBBLE.to_owned(), wobble.motion.name().to_owned()));
        }
        let of_rollers = OF_ROLLERS.map(str::to_owned).into_iter().zip(of_rollers(summary));
        results.extend(of_rollers.filter(|(_, text)| !text.is_empty()));
        let mut add = |name: &str, value: Option<f64>| {
            results.extend(value.map(|value| (name.to_owned(), plain(value))));
        };
        add(CAGE_TURNS, summary.cage_turns);
        add("velocity deviation [1]", summary.whirl.as_ref().and_then(|whirl| whirl.velocity_deviation));
        for motion in CageMotion::ALL {
            let share = summary.whirl.as_ref().and_then(|whirl| whirl.share(motion));
            add(&format!("share of time: {} [1]", motion.name()), share);
        }
        add("load zone [rad]", summary.load_zone.map(|zone| zone.extent_rad));
        add("power loss [W]", summary.power_loss.as_ref().map(|loss| loss.total_w));
        if let Some(starts) = &summary.starts {
            results.extend(CageMotion::ALL.map(|motion| (share_of(motion), plain(starts.share(motion)))));
        }
        for (channel, statistics) in summary.statistics.iter().filter(|(name, _)| !name.contains('[')) {
            for (part, value) in PARTS {
                let text = value(&statistics.spread).map_or(String::new(), plain);
                results.push((format!("{channel} {part} [{}]", statistics.unit), text));
            }
        }
        Self {
            values,
            results,
            simulated_time: Some(plain(summary.simulated_time_s)),
            trusted: Some(summary.trusted),
            doubts: summary.doubts.clone(),
            error: None,
            spectrum: None,
        }
    }

    /// Of a run that failed at a time in s, or did not start.
    pub fn failed(values: Vec<String>, simulated_time: Option<f64>, error: &Error) -> Self {
        let error = Some((error.status.name().to_owned(), error.message.clone()));
        let simulated_time = simulated_time.map(plain);
        let (results, doubts) = (Vec::new(), Vec::new());
        Self { values, results, simulated_time, trusted: None, doubts, error, spectrum: None }
    }

    /// The cell of a column of the results.
    pub fn text(&self, column: &str) -> Option<&str> {
        Some(&self.results.iter().find(|(name, _)| name == column)?.1)
    }

    /// Turns of the cage in the run, where they are too few for its means.
    pub fn few_turns(&self) -> Option<f64> {
        self.number(CAGE_TURNS).filter(|turns| *turns < FEW_TURNS)
    }

    /// A result that is a number.
    pub fn number(&self, column: &str) -> Option<f64> {
        self.text(column)?.parse().ok()
    }
}

/// Column of the share of starts that lead to a motion.
pub fn share_of(motion: CageMotion) -> String {
    format!("share of starts: {} [1]", motion.name())
}
