//! Amplitude spectrum of the cage position (compare Fig. 6).

use super::axis::Axis;
use super::labels::Room;
use super::panel::{Panel, Place, panel};
use super::style::{self, BLUE, Canvas, Drawn, INK, MUTED, Marker, RED, Symbol, TEXT, THIN, line};
use crate::results::finished::Run;
use crate::results::lines;
use crate::results::summary::{Summary, Whirl};
use crate::results::table::{number, rounded};
use crate::spectrum::{Peak, Spectrum};
use cagedyn::Result;
use plotters::style::text_anchor::HPos;

/// Highest frequency shown, Hz, if the cage does not whirl faster ...
const HIGHEST: f64 = 1000.0;
/// ... or else in units of the whirl frequency.
const ABOVE_WHIRL: f64 = 2.2;
/// Powers of ten shown below the highest amplitude, at most.
const DECADES: f64 = 4.0;
/// Axes of fewer powers of ten have ticks between them.
const FEW_DECADES: f64 = 2.5;
/// Frequency ranges that are told apart.
const COLUMNS: usize = 1000;
/// Share of the height above the highest amplitude, which labels have, and below the lowest.
const ROOM: (f64, f64) = (0.16, 0.03);
/// Peaks without a name that are told by their frequency.
const UNKNOWN: usize = 4;
/// Size of the labels and of the markers, px.
const LABEL: f64 = TEXT - 1.0;
const MARKER: f64 = 3.0;

/// Place of the diagram, px.
const PLACE: Place = Place { x: 100.0, y: 100.0, w: 770.0, h: 370.0 };

/// A peak with what is said of it.
struct Named {
    peak: Peak,
    label: String,
    /// Whether it stands out of the noise.
    clear: bool,
}

/// The picture, if there is a cage and the run is long enough.
pub fn cage_spectrum(run: &Run, summary: &Summary) -> Option<Result<String>> {
    let (mut spectrum, first) = lines::spectrum(run, summary.cage_frequency_hz)?;
    spectrum.amplitudes.iter_mut().for_each(|a| *a *= 1e3);
    let whirl = summary.whirl.as_ref().and_then(Whirl::frequency);
    let highest = highest_shown(whirl);
    let shown = spectrum.frequencies.partition_point(|f| *f <= highest);
    spectrum.frequencies.truncate(shown);
    spectrum.amplitudes.truncate(shown);
    let mut what =
        format!("Amplitude spectrum of cage.z from {} s to {} s", rounded(first), rounded(run.end()));
    let cage = summary.cage_frequency_hz.filter(|f| *f > 0.0);
    if let Some(cage) = cage {
        what += &format!(", f_c = {} Hz, Z = {}", number(cage), run.model.element_count());
    }
    let known = cage.map_or(Vec::new(), |cage| lines::frequencies(run, cage, whirl));
    let peaks = lines::named_peaks(&spectrum, &known);
    let mut unknown = 0;
    let labelled = peaks.into_iter().filter_map(|(peak, name)| {
        unknown += usize::from(name.is_none());
        let name = name.map(|name| name + ", ");
        let label = format!("{}{} Hz", name.clone().unwrap_or_default(), number(peak.frequency));
        (name.is_some() || unknown <= UNKNOWN).then_some(Named { peak, label, clear: true })
    });
    let mut labelled: Vec<Named> = labelled.collect();
    // The highest one is never without a name.
    if let Some(peak) = spectrum.highest().filter(|peak| labelled.iter().all(|other| other.peak != *peak)) {
        let label = format!("highest, {} Hz", number(peak.frequency));
        labelled.push(Named { peak, label, clear: false });
    }
    Some(draw(&run.title, &run.subtitle(&what), &spectrum, &labelled))
}

/// Highest frequency of pictures of a cage that whirls with this one, Hz.
pub fn highest_shown(whirl: Option<f64>) -> f64 {
    whirl.map_or(HIGHEST, |f| HIGHEST.max(ABOVE_WHIRL * f))
}

fn draw(title: &str, subtitle: &str, spectrum: &Spectrum, peaks: &[Named]) -> Result<String> {
    let highest = spectrum.frequencies.last().copied().unwrap_or(HIGHEST);
    let all: Vec<(f64, f64)> = spectrum.lines(COLUMNS).collect();
    let (low, high) = all
        .iter()
        .filter(|(_, a)| *a > 0.0)
        .fold((f64::INFINITY, 1e-15f64), |(low, high), (_, a)| (low.min(*a), high.max(*a)));
    let (low, high) = (low.min(high).log10().max(high.log10() - DECADES), high.log10());
    let size = (high - low).max(0.3) / (1.0 - ROOM.0 - ROOM.1);
    let ends = (high - (1.0 - ROOM.0) * size, high + ROOM.0 * size);
    let peaks: Vec<&Named> = peaks.iter().filter(|named| named.peak.amplitude.log10() > low).collect();
    let axis = if size < FEW_DECADES { Axis::logarithms } else { Axis::powers_of_ten };
    let y_axis = axis("amplitude of cage.z [mm]", ends.0, ends.1);
    let x_axis = Axis::new("frequency [Hz]", 0.0, highest, 10);
    style::picture((900.0, 540.0), title, subtitle, |canvas| {
        legend(canvas, spectrum, &peaks)?;
        panel(canvas, PLACE, (&x_axis, &y_axis), true, &[], |panel| {
            let curve = above(all.into_iter(), y_axis.min);
            panel.curve(curve.iter().copied(), line(BLUE, THIN + 0.2))?;
            mark(panel, &curve, &peaks, [(0.0, y_axis.max), (highest, y_axis.min)])
        })
    })
}

fn legend(canvas: &Canvas<'_>, spectrum: &Spectrum, peaks: &[&Named]) -> Drawn {
    let segments =
        if spectrum.segments > 1 { format!("{} segments, ", spectrum.segments) } else { String::new() };
    let window = format!("Hann window, {segments}resolution {} Hz", number(spectrum.resolution));
    let highest =
        |clear: bool| peaks.iter().find(|named| named.clear == clear).map(|named| named.peak.amplitude);
    let peak = highest(true).map(|amplitude| {
        let text = format!("peaks, up to {} mm", number(amplitude));
        (Symbol::Marker(Marker::Ring, RED), text)
    });
    let other = highest(false).map(|amplitude| {
        let text = format!("no clear peak, {} mm", number(amplitude));
        (Symbol::Marker(Marker::Disc, MUTED), text)
    });
    let entries: Vec<_> = std::iter::once((Symbol::Line(BLUE), window)).chain(peak).chain(other).collect();
    style::legend_row(canvas, 78.0, &entries)
}

/// Rings and labels of the peaks, within these corners.
fn mark(
    panel: &Panel<'_, '_, '_>,
    curve: &[(f64, f64)],
    peaks: &[&Named],
    corners: [(f64, f64); 2],
) -> Drawn {
    let mut room = Room::new(LABEL, MARKER).within(corners.map(|corner| panel.place(corner)));
    for part in curve.split(|(_, a)| a.is_nan()) {
        room.line(&part.iter().map(|point| panel.place(*point)).collect::<Vec<_>>(), THIN);
    }
    let place = |peak: &Peak| panel.place((peak.frequency, peak.amplitude.log10()));
    peaks.iter().for_each(|named| room.add(&[place(&named.peak)]));
    for Named { peak, label, .. } in peaks {
        let frame = room.take(place(peak), label);
        room.leader(panel.canvas(), place(peak), &frame)?;
        style::label(panel.canvas(), label, frame.centre, (LABEL, INK), HPos::Center)?;
    }
    peaks.iter().try_for_each(|named| {
        let (shape, color) = if named.clear { (Marker::Ring, RED) } else { (Marker::Disc, MUTED) };
        style::marker(panel.canvas(), shape, place(&named.peak), MARKER, color)
    })
}

/// The logarithms of amplitudes, which end at `floor` where they go below it.
fn above(lines: impl Iterator<Item = (f64, f64)>, floor: f64) -> Vec<(f64, f64)> {
    let all: Vec<(f64, f64)> = lines.map(|(f, a)| (f, a.max(1e-300).log10())).collect();
    let seen = |k: usize| all.get(k).is_some_and(|(_, a)| *a > floor);
    let shown = |k: usize| seen(k) || seen(k + 1) || k > 0 && seen(k - 1);
    all.iter().enumerate().map(|(k, (f, a))| (*f, if shown(k) { a.max(floor) } else { f64::NAN })).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_end_at_the_floor() {
        let lines = [1.0, 1e-9, 1e-9, 1e-9, 1.0].map(|a| (0.0, a));
        let found: Vec<f64> = above(lines.into_iter(), -4.0).into_iter().map(|(_, a)| a).collect();
        assert_eq!((found[0], found[1], found[3], found[4]), (0.0, -4.0, -4.0, 0.0));
        assert!(found[2].is_nan());
    }
}
