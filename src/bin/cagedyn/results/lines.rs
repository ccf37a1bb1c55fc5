//! Lines of the amplitude spectrum of the cage: at the frequencies of a bearing.

use crate::results::finished::Run;
use crate::spectrum::{Peak, Spectrum, averaged_spectrum};
use cagedyn::model::{HostInputs, Input};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

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
    /// Whether there is a peak that stands out of the noise about it.
    #[serde(default)]
    pub peak: bool,
}

/// Spectrum of the height of the cage centre in m, as [`spectrum_of`].
pub fn spectrum(run: &Run, cage: Option<f64>) -> Option<(Spectrum, f64)> {
    spectrum_of(run, "cage.z", cage)
}

/// Spectrum of a channel, and the time in s that it begins at; `None` where it is not recorded or has too few records. `cage` is the
/// frequency of the cage, Hz.
pub fn spectrum_of(run: &Run, channel: &str, cage: Option<f64>) -> Option<(Spectrum, f64)> {
    let start = SETTLED.min(LARGEST_START_SHARE * run.end()) - 1e-6 * run.interval();
    let from = run.recording.index_at(start);
    let samples = run.column(channel)?.get(from..)?;
    let wanted = cage.map_or(0.0, |f| RESOLUTION * f);
    Some((averaged_spectrum(samples, run.interval(), wanted)?, *run.recording.times.get(from)?))
}

/// Frequencies of the bearing with their names: of the cage and its harmonics, of the elements that pass a place, with sidebands, of
/// the inner ring and the elements that pass a place of it, and of the whirl. `cage` and `whirl` in Hz.
pub fn frequencies(run: &Run, cage: f64, whirl: Option<f64>) -> Vec<(String, f64)> {
    let elements = run.model.element_count();
    let harmonic = |n: usize| (multiple(n, "f_c"), n as f64 * cage);
    let passing = elements as f64 * cage;
    let mut all: Vec<_> = HARMONICS.into_iter().filter(|n| *n != elements).map(harmonic).collect();
    all.extend([1, 2, 3].map(|n| (multiple(n, "Z f_c"), n as f64 * passing)));
    all.extend(
        [("Z f_c - f_c", -cage), ("Z f_c + f_c", cage)].map(|(name, f)| (name.to_owned(), passing + f)),
    );
    let speed = run.model.inputs_at(run.end(), &HostInputs::default()).of(Input::RingSpeed);
    let ring = Some(speed.abs() / TAU).filter(|f| *f > cage);
    all.extend(ring.map(|f| ("f_i".to_owned(), f)));
    all.extend(ring.map(|f| ("Z (f_i - f_c)".to_owned(), elements as f64 * (f - cage))));
    all.extend(whirl.into_iter().flat_map(|f| [1, 2].map(|n| (multiple(n, "whirl"), n as f64 * f))));
    all
}

/// The peaks of a spectrum, highest first, each with the name of the nearest of these frequencies that it cannot be told apart from and
/// that no higher one has.
pub fn named_peaks(spectrum: &Spectrum, known: &[(String, f64)]) -> Vec<(Peak, Option<String>)> {
    let mut left: Vec<&(String, f64)> = known.iter().collect();
    let peaks = spectrum.peaks().into_iter();
    peaks
        .map(|peak| {
            let off = |(_, f): &(String, f64)| (f - peak.frequency).abs();
            let near = left.iter().enumerate().filter(|(_, known)| off(known) <= 0.5 * spectrum.resolution);
            let nearest = near.min_by(|a, b| off(a.1).total_cmp(&off(b.1))).map(|(place, _)| place);
            (peak, nearest.map(|place| left.remove(place).0.clone()))
        })
        .collect()
}

/// "f_c", "2 f_c" and so on.
pub fn multiple(n: usize, name: &str) -> String {
    if n == 1 { name.to_owned() } else { format!("{n} {name}") }
}

/// The lines of a run whose cage turns and whirls with these frequencies, Hz.
pub fn lines(run: &Run, cage: Option<f64>, whirl: Option<f64>) -> Option<Lines> {
    let cage = cage.filter(|f| *f > 0.0)?;
    let (spectrum, from_s) = spectrum(run, Some(cage))?;
    let known = frequencies(run, cage, whirl);
    let peaks = named_peaks(&spectrum, &known);
    let found = known.into_iter().filter_map(|(name, frequency_hz)| {
        let peak = peaks.iter().any(|(_, other)| other.as_ref() == Some(&name));
        Some(Line { amplitude_m: spectrum.at(frequency_hz)?, name, frequency_hz, peak })
    });
    let lines = found.filter(|line| line.frequency_hz > spectrum.resolution).collect();
    Some(Lines { from_s, resolution_hz: spectrum.resolution, segments: spectrum.segments, lines })
}
