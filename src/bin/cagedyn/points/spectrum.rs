//! Spectra of the cage in runs beside each other: as they are kept, as a table and as columns of a picture.

use crate::plots::sweep::Column;
use crate::results::files::plain;
use crate::results::finished::Run;
use crate::results::lines;
use crate::results::summary::{Summary, Whirl};
use crate::results::table::rounded;
use serde::{Deserialize, Serialize};

/// Ranges of frequency that a spectrum has at most; of each its largest amplitude is kept.
const RANGES: usize = 1000;
/// Multiples of the frequency of the passing elements that pictures mark.
const MULTIPLES: [usize; 3] = [1, 2, 3];

/// Columns of its table behind those that name the run.
pub const COLUMNS: [&str; 3] = ["frequency [Hz]", "amplitude of cage.z [m]", "resolution [Hz]"];

/// The spectrum of the height of the cage centre in a run. Numbers are texts, which keep their digits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spectrum {
    /// Sines closer than this are one line, Hz.
    resolution: String,
    /// Names and frequencies of the bearing, Hz.
    marks: Vec<(String, String)>,
    /// Frequencies and amplitudes, Hz and m.
    lines: Vec<(String, String)>,
}

impl Spectrum {
    /// Of a run with its results; `None` without a cage or with too few records.
    pub fn of(run: &Run, summary: &Summary) -> Option<Self> {
        let cage = summary.cage_frequency_hz.filter(|f| *f > 0.0);
        let (spectrum, _) = lines::spectrum(run, cage)?;
        let passing = |cage: f64| cage * run.model.element_count() as f64;
        let multiple = |n: usize, cage: f64| (lines::multiple(n, "Z f_c"), text(n as f64 * passing(cage)));
        let mut marks: Vec<(String, String)> = Vec::new();
        marks.extend(cage.map(|cage| ("f_c".to_owned(), text(cage))));
        marks.extend(cage.into_iter().flat_map(|cage| MULTIPLES.map(|n| multiple(n, cage))));
        let whirl = summary.whirl.as_ref().and_then(Whirl::frequency);
        marks.extend(whirl.map(|whirl| ("whirl".to_owned(), text(whirl))));
        Some(Self {
            resolution: text(spectrum.resolution),
            marks,
            lines: spectrum.lines(RANGES).map(|(f, a)| (text(f), text(a))).collect(),
        })
    }

    /// Cells of [`COLUMNS`], a row for every line.
    pub fn rows(&self) -> impl Iterator<Item = [String; COLUMNS.len()]> + '_ {
        self.lines
            .iter()
            .map(|(frequency, amplitude)| [frequency.clone(), amplitude.clone(), self.resolution.clone()])
    }

    /// The column of a picture at a place of its axis.
    pub fn column(&self, at: f64) -> Column {
        let number = |text: &String| text.parse().unwrap_or(f64::NAN);
        Column {
            at,
            resolution: number(&self.resolution),
            lines: self.lines.iter().map(|(f, a)| (number(f), number(a))).collect(),
            marks: self.marks.iter().map(|(name, f)| (name.clone(), number(f))).collect(),
        }
    }
}

/// A number without the round-off of its last digits.
fn text(x: f64) -> String {
    plain(rounded(x))
}
