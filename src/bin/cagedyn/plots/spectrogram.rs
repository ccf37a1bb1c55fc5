//! What frequencies the motion of the cage has, and when.

use super::axis::Axis;
use super::panel::{Panel, Place, panel};
use super::spectrum::highest_shown;
use super::style::{self, Drawn, INK, Paint, Symbol, TEXT, px};
use crate::results::finished::Run;
use crate::results::lines;
use crate::results::summary::{Summary, Whirl};
use crate::results::table::number;
use crate::spectrum::{Analysis, Spectrum};
use cagedyn::Result;
use plotters::style::text_anchor::HPos;

/// What is shown, where the scene has it: channel, name of the axis.
const SHOWN: [(&str, &str); 4] = [
    ("cage.y", "cage.y: frequency [Hz]"),
    ("cage.z", "cage.z: frequency [Hz]"),
    ("cage.x", "cage.x: frequency [Hz]"),
    ("cage.tilt_y", "cage.tilt_y: frequency [Hz]"),
];
/// Resolution of a column in units of the frequency of the cage, and the largest part of the run in one.
const RESOLUTION: f64 = 1.0;
const LARGEST_PART: usize = 8;
/// Most columns and rows of a diagram.
const COLUMNS: usize = 90;
const ROWS: usize = 70;
/// Powers of ten between the strongest and the faintest colour, and the colours from there up.
const DECADES: f64 = 3.0;
const COLOURS: [Paint; 6] = [
    Paint(0xe3, 0xec, 0xf6),
    Paint(0xbd, 0xd3, 0xea),
    Paint(0x86, 0xb0, 0xd9),
    Paint(0x4a, 0x86, 0xc2),
    Paint(0x1f, 0x5f, 0xa6),
    Paint(0x0f, 0x2f, 0x57),
];
/// Peaks that are told at most, with and without name, and the least room between two of them, px.
const TOLD: [usize; 2] = [8, 2];
const APART: f64 = 14.0;
/// Height of a diagram and distance from one to the next, px.
const HEIGHT: f64 = 190.0;
const NEXT: f64 = 206.0;

/// Colours by column and row.
struct Map {
    /// Times at the edges of columns, s, and height of a row, Hz.
    edges: Vec<f64>,
    row: f64,
    colours: Vec<Vec<Option<usize>>>,
    /// Frequencies of peaks, Hz, with what they are called.
    peaks: Vec<(f64, String)>,
    /// Time that a column shows, s.
    length: f64,
    name: &'static str,
}

/// The picture, if there is a cage and the run is long enough.
pub fn cage_spectrogram(run: &Run, summary: &Summary) -> Option<Result<String>> {
    let cage = summary.cage_frequency_hz.filter(|f| *f > 0.0)?;
    let whirl = summary.whirl.as_ref().and_then(Whirl::frequency);
    let highest = highest_shown(whirl).min(0.5 / run.interval());
    let known = lines::frequencies(run, cage, whirl);
    let map = |(channel, name): (&str, &'static str)| {
        let samples = run.column(channel).filter(|samples| samples.iter().any(|x| *x != samples[0]))?;
        Map::of(run, (channel, samples), name, [cage, highest], &known)
    };
    let maps: Vec<Map> = SHOWN.into_iter().filter_map(map).collect();
    (!maps.is_empty()).then(|| draw(run, &maps, highest))
}

impl Map {
    /// `None` where the run is too short.
    fn of(
        run: &Run,
        (channel, samples): (&str, &[f64]),
        name: &'static str,
        [cage, highest]: [f64; 2],
        known: &[(String, f64)],
    ) -> Option<Self> {
        let wanted = (2.0 / (RESOLUTION * cage * run.interval())).ceil() as usize;
        let length = wanted.min(samples.len() / LARGEST_PART);
        let most = samples.len().checked_sub(length)?;
        let step = most.div_ceil(COLUMNS).max(1);
        let analysis = Analysis::new(length, run.interval())?;
        let starts = (0..=most).step_by(step);
        let spectra: Vec<Spectrum> =
            starts.map(|start| analysis.of(&samples[start..start + length])).collect();
        // No row is narrower than the time of a column can tell apart.
        let resolution = spectra.first()?.resolution;
        let rows = ((highest / (0.5 * resolution)) as usize).clamp(1, ROWS);
        let row = highest / rows as f64;
        let amplitudes: Vec<Vec<f64>> = spectra.iter().map(|spectrum| in_rows(spectrum, row, rows)).collect();
        let largest = amplitudes.iter().flatten().fold(0.0, |a: f64, b| a.max(*b));
        let of_column = |column: &Vec<f64>| column.iter().map(|x| colour(x / largest)).collect();
        let colours = amplitudes.iter().map(of_column).collect();
        let times = &run.recording.times;
        let middle = |k: usize| times[(k * step + length / 2).min(times.len() - 1)];
        let half = 0.5 * step as f64 * run.interval();
        let edges = (0..spectra.len()).map(|k| middle(k) - half);
        let edges = edges.chain([middle(spectra.len() - 1) + half]).collect();
        let (whole, _) = lines::spectrum_of(run, channel, Some(cage))?;
        let mut left = TOLD;
        let mut peaks = Vec::new();
        for (peak, of) in lines::named_peaks(&whole, known) {
            let left = &mut left[usize::from(of.is_none())];
            if *left > 0 && peak.frequency <= highest {
                *left -= 1;
                let at = format!("{} Hz", number(peak.frequency));
                peaks.push((peak.frequency, of.map_or(at.clone(), |of| format!("{of}, {at}"))));
            }
        }
        if let Some(peak) = whole.highest().filter(|peak| peaks.is_empty() && peak.frequency <= highest) {
            peaks.push((peak.frequency, format!("highest, {} Hz; no clear peak", number(peak.frequency))));
        }
        let length = length as f64 * run.interval();
        Some(Self { edges, row, colours, peaks, length, name })
    }
}

/// Largest amplitude in each row, which is `row` Hz high.
fn in_rows(spectrum: &Spectrum, row: f64, rows: usize) -> Vec<f64> {
    let mut all = vec![0.0f64; rows];
    for (frequency, amplitude) in spectrum.frequencies.iter().zip(&spectrum.amplitudes) {
        if let Some(largest) = all.get_mut((frequency / row) as usize) {
            *largest = largest.max(*amplitude);
        }
    }
    all
}

/// Index of the colour of a share; `None` of one too faint.
fn colour(share: f64) -> Option<usize> {
    let level = COLOURS.len() as f64 * (1.0 + share.max(1e-300).log10() / DECADES);
    (level > 0.0).then(|| (level as usize).min(COLOURS.len() - 1))
}

fn draw(run: &Run, maps: &[Map], highest: f64) -> Result<String> {
    let what = "Amplitudes of the cage over frequency and time";
    let size = (900.0, 100.0 + NEXT * maps.len() as f64 + 46.0);
    let entries = [
        (Symbol::Line(COLOURS[COLOURS.len() - 1]), "largest amplitude of a diagram".to_owned()),
        (
            Symbol::Line(COLOURS[0]),
            format!(
                "a thousandth of it; beside: peaks of the whole run, Hann windows of {} s",
                number(maps[0].length)
            ),
        ),
    ];
    style::picture(size, &run.title, &run.subtitle(what), |canvas| {
        style::legend_row(canvas, 78.0, &entries)?;
        let x_axis = Axis::new("time [s]", 0.0, run.end(), 10);
        for (k, map) in maps.iter().enumerate() {
            let place = Place { x: 100.0, y: 100.0 + NEXT * k as f64, w: 560.0, h: HEIGHT };
            let y_axis = Axis::new(map.name, 0.0, highest, 5);
            panel(canvas, place, (&x_axis, &y_axis), k + 1 == maps.len(), &[], |panel| {
                map.cells(panel)?;
                map.names(panel, place)
            })?;
        }
        Ok(())
    })
}

impl Map {
    /// Neighbours of one colour in a row are one box.
    fn cells(&self, panel: &mut Panel<'_, '_, '_>) -> Drawn {
        for (level, paint) in COLOURS.iter().enumerate() {
            for r in 0..self.colours[0].len() {
                let at = |k: usize| self.colours.get(k).is_some_and(|column| column[r] == Some(level));
                let mut k = 0;
                while k < self.colours.len() {
                    let length = (k..).take_while(|k| at(*k)).count();
                    if length > 0 {
                        let (low, high) = (self.row * r as f64, self.row * (r + 1) as f64);
                        let (from, to) = (self.edges[k], self.edges[k + length]);
                        panel.envelope(std::iter::once((from, to, low, high)), *paint)?;
                    }
                    k += length.max(1);
                }
            }
        }
        Ok(())
    }

    /// Peaks of the whole run beside it, as far as there is room.
    fn names(&self, panel: &Panel<'_, '_, '_>, place: Place) -> Drawn {
        let x = place.x + place.w + 8.0;
        let mut taken: Vec<f64> = Vec::new();
        for (frequency, name) in &self.peaks {
            let (_, y) = panel.place((0.0, *frequency));
            if taken.iter().all(|other| (f64::from(y) - other).abs() >= f64::from(px(APART))) {
                taken.push(f64::from(y));
                style::label(
                    panel.canvas(),
                    &format!("– {name}"),
                    (px(x), y),
                    (TEXT - 2.0, INK),
                    HPos::Left,
                )?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_end_a_thousandth_below_the_strongest() {
        assert_eq!([1.0, 0.9e-3, 1.1e-3, 0.0].map(colour), [Some(COLOURS.len() - 1), None, Some(0), None]);
    }

    #[test]
    fn rows_have_the_largest_amplitude_in_them() {
        let spectrum = Spectrum {
            frequencies: vec![0.0, 5.0, 15.0, 25.0, 99.0],
            amplitudes: vec![1.0, 3.0, 2.0, 4.0, 9.0],
            resolution: 5.0,
            segments: 1,
        };
        assert_eq!(in_rows(&spectrum, 10.0, 3), [3.0, 2.0, 4.0]);
    }
}
