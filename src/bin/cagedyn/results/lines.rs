//! Lines of the amplitude spectrum of the cage: at the frequencies of a bearing.

use crate::results::finished::Run;
use crate::spectrum::{Spectrum, averaged_spectrum};
use serde::{Deserialize, Serialize};

/// The start of a run is left out, s ...
const SETTLED: f64 = 0.08;
/// ... but at most this share of it.
const LARGEST_START_SHARE: f64 = 1.0 / 3.0;
/// Resolution that segments have, in units of the frequency of the cage: enough to tell sidebands from their neighbours.
const RESOLUTION: f64 = 0.5;
/// Multiples of the frequency of the cage that papers show.
const HARMONICS: [usize; 5] = [1, 2, 4, 8, 16];

/// Amplitudes of the height of the cage centre at frequencies of the bearing, after the start has died away.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Lines {
    /// Beginning of the time that was analysed, s; it ends with the run.
    pub from_s: f64,
    /// Sines closer than this are one line, Hz.
    pub resolution_hz: f64,
    /// Overlapping stretches of that time that the amplitudes are the mean of.
    pub segments: u32,
    /// The lines below the highest frequency that records show.
    pub lines: Vec<Line>,
}

/// Amplitude at a frequency.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// For example "Z f_c": the cage turns with f_c and has Z pockets.
    pub name: String,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Amplitude of a sine there, m.
    pub amplitude_m: f64,
}

/// Spectrum of the height of the cage centre in m, and the time in s that it begins at; `None` without a cage or with too few
/// records. `cage` is the frequency of the cage, Hz.
pub fn spectrum(run: &Run, cage: Option<f64>) -> Option<(Spectrum, f64)> {
    let start = SETTLED.min(LARGEST_START_SHARE * run.end()) - 1e-6 * run.interval();
    let from = run.recording.index_at(start);
    let samples = run.column("cage.z")?.get(from..)?;
    let wanted = cage.map_or(0.0, |f| RESOLUTION * f);
    Some((averaged_spectrum(samples, run.interval(), wanted)?, *run.recording.times.get(from)?))
}

/// Frequencies of the bearing with their names: of the cage and its harmonics, of the elements that pass, with sidebands, and of
/// the whirl. `cage` and `whirl` in Hz.
pub fn frequencies(elements: usize, cage: f64, whirl: Option<f64>) -> Vec<(String, f64)> {
    let harmonic = |n: usize| (multiple(n, "f_c"), n as f64 * cage);
    let passing = elements as f64 * cage;
    let mut all: Vec<_> = HARMONICS.into_iter().filter(|n| *n != elements).map(harmonic).collect();
    all.extend([("Z f_c", passing), ("2 Z f_c", 2.0 * passing)].map(|(name, f)| (name.to_owned(), f)));
    all.extend(
        [("Z f_c - f_c", -cage), ("Z f_c + f_c", cage)].map(|(name, f)| (name.to_owned(), passing + f)),
    );
    all.extend(whirl.map(|f| ("whirl".to_owned(), f)));
    all
}

/// "f_c", "2 f_c" and so on.
pub fn multiple(n: usize, name: &str) -> String {
    if n == 1 { name.to_owned() } else { format!("{n} {name}") }
}

/// The lines of a run whose cage turns and whirls with these frequencies, Hz.
pub fn lines(run: &Run, cage: Option<f64>, whirl: Option<f64>) -> Option<Lines> {
    let cage = cage.filter(|f| *f > 0.0)?;
    let (spectrum, from_s) = spectrum(run, Some(cage))?;
    let known = frequencies(run.model.element_count(), cage, whirl).into_iter();
    let found = known.filter_map(|(name, frequency_hz)| {
        Some(Line { name, frequency_hz, amplitude_m: spectrum.at(frequency_hz)? })
    });
    let lines = found.filter(|line| line.frequency_hz > spectrum.resolution).collect();
    Some(Lines { from_s, resolution_hz: spectrum.resolution, segments: spectrum.segments, lines })
}
