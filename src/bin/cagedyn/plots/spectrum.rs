//! Amplitude spectrum of the cage position (compare Fig. 6).

use super::axis::Axis;
use super::panel::{Place, panel};
use super::style::{self, BLUE, INK, MUTED, Marker, RED, Symbol, TEXT, THIN, line, px, text, text_width};
use crate::results::finished::Run;
use crate::results::lines;
use crate::results::summary::{Summary, Whirl};
use crate::results::table::{number, rounded};
use crate::spectrum::Spectrum;
use cagedyn::Result;
use plotters::prelude::Text;
use plotters::style::text_anchor::{HPos, VPos};

/// Highest frequency shown, Hz, if the cage does not whirl faster ...
const HIGHEST: f64 = 1000.0;
/// ... or else in units of the whirl frequency.
const ABOVE_WHIRL: f64 = 2.2;
/// Multiples of the frequency of the cage that are marked.
const HARMONICS: [usize; 4] = [1, 4, 8, 16];
/// Powers of ten shown below the peak.
const DECADES: f64 = 4.0;
/// Labels of the whirl frequency and its double.
const WHIRL: [&str; 2] = ["whirl", "2 x whirl"];
/// Frequency ranges that are told apart.
const COLUMNS: usize = 1000;
/// Room above the peak for the label of a frequency, and above all labels, in powers of ten.
const LABEL_ROOM: f64 = 0.3;
const TOP_ROOM: f64 = 0.25;
/// There is room for at least this many labels.
const MIN_LABELS: usize = 3;

/// Place of the diagram, px.
const PLACE: Place = Place { x: 100.0, y: 100.0, w: 770.0, h: 370.0 };

/// The picture, if there is a cage and the run is long enough.
pub fn cage_spectrum(run: &Run, summary: &Summary) -> Option<Result<String>> {
    let (mut spectrum, first) = lines::spectrum(run, summary.cage_frequency_hz)?;
    spectrum.amplitudes.iter_mut().for_each(|a| *a *= 1e3);
    let highest =
        summary.whirl.as_ref().and_then(Whirl::frequency).map_or(HIGHEST, |f| HIGHEST.max(ABOVE_WHIRL * f));
    let shown = spectrum.frequencies.partition_point(|f| *f <= highest);
    spectrum.frequencies.truncate(shown);
    spectrum.amplitudes.truncate(shown);
    let what = format!("Amplitude spectrum of cage.z from {} s to {} s", rounded(first), rounded(run.end()));
    let count = run.model.element_count() as f64;
    let cage = summary.cage_frequency_hz.filter(|f| *f >= spectrum.resolution);
    let sidebands = cage.map_or(Vec::new(), |f| vec![(count - 1.0) * f, (count + 1.0) * f]);
    let orders = orders(run, summary, &spectrum);
    Some(draw(&run.title, &run.subtitle(&what), &spectrum, (&orders, &sidebands)))
}

/// Frequencies to mark, with their names: those of the cage, of the pockets passing by and of the whirl, as far as the spectrum tells
/// them apart from others and from zero.
fn orders(run: &Run, summary: &Summary, spectrum: &Spectrum) -> Vec<(f64, String)> {
    let Some(cage) = summary.cage_frequency_hz.filter(|f| *f > 0.0) else { return Vec::new() };
    let count = run.model.element_count();
    // Those that matter most come first.
    let passing = (count as f64 * cage, format!("Z f_c = {count} f_c"));
    let whirl = summary.whirl.as_ref().and_then(Whirl::frequency);
    let whirl = whirl.into_iter().flat_map(|f| [(f, WHIRL[0].to_owned()), (2.0 * f, WHIRL[1].to_owned())]);
    let harmonics = HARMONICS.into_iter().map(|n| (n as f64 * cage, lines::multiple(n, "f_c")));
    let mut list: Vec<(f64, String)> = Vec::new();
    for (f, name) in std::iter::once(passing).chain(whirl).chain(harmonics) {
        let apart = |other: f64| (f - other).abs() >= spectrum.resolution;
        if apart(0.0) && list.iter().all(|(other, _)| apart(*other)) {
            list.push((f, name));
        }
    }
    list.retain(|(f, _)| spectrum.frequencies.last().is_some_and(|highest| f < highest));
    list.sort_by(|a, b| a.0.total_cmp(&b.0));
    list
}

/// Rows for labels that begin at these places and are so long; higher ones have smaller numbers. A label stands below all that it
/// begins within, so that its line from below does not cross their texts.
fn rows(labels: &[(f64, f64)]) -> Vec<usize> {
    let mut rows: Vec<usize> = Vec::new();
    for (k, (x, _)) in labels.iter().enumerate() {
        let over = labels[..k].iter().zip(&rows).filter(|((from, length), _)| from + length > *x);
        rows.push(over.map(|(_, row)| row + 1).max().unwrap_or(0));
    }
    rows
}

fn draw(
    title: &str,
    subtitle: &str,
    spectrum: &Spectrum,
    (orders, sidebands): (&[(f64, String)], &[f64]),
) -> Result<String> {
    let highest = spectrum.frequencies.last().copied().unwrap_or(HIGHEST);
    let peak = spectrum.peak();
    let largest = spectrum.amplitudes.iter().fold(0.0, |m: f64, a| m.max(*a)).max(1e-15).log10();
    let labels: Vec<String> =
        orders.iter().map(|(frequency, name)| format!("{name}, {} Hz", number(*frequency))).collect();
    let long = |text: &String| (text_width(text, TEXT - 1.0) + 10.0) * highest / PLACE.w;
    let extents: Vec<_> = orders.iter().zip(&labels).map(|((f, _), text)| (*f, long(text))).collect();
    let rows = rows(&extents);
    let room = TOP_ROOM + LABEL_ROOM * rows.iter().map(|row| row + 1).fold(MIN_LABELS, usize::max) as f64;
    let x_axis = Axis::new("frequency [Hz]", 0.0, highest, 10);
    let y_axis = Axis::powers_of_ten("amplitude of cage.z [mm]", (largest - DECADES).round(), largest + room);
    style::picture((900.0, 540.0), title, subtitle, |canvas| {
        let window = match spectrum.segments {
            1 => format!("Hann window, resolution {} Hz", number(spectrum.resolution)),
            n => format!("Hann window, {n} segments, resolution {} Hz", number(spectrum.resolution)),
        };
        let mut entries = vec![(Symbol::Line(BLUE), window)];
        if let Some((frequency, amplitude)) = peak {
            let label = format!("peak {} mm at {} Hz", number(amplitude), number(frequency));
            entries.push((Symbol::Marker(Marker::Ring, RED), label));
        }
        let whirls = orders.iter().any(|(_, name)| WHIRL.contains(&name.as_str()));
        let marks = [
            (orders.iter().any(|(_, name)| name.contains("f_c")), "n f_c"),
            (!sidebands.is_empty(), "Z f_c ± f_c"),
            (whirls, "n x whirl"),
        ];
        let marks: Vec<&str> = marks.into_iter().filter_map(|(there, name)| there.then_some(name)).collect();
        if !marks.is_empty() {
            entries.push((Symbol::Dashed(MUTED), marks.join(", ")));
        }
        style::legend_row(canvas, 78.0, &entries)?;
        panel(canvas, PLACE, (&x_axis, &y_axis), true, &[], |panel| {
            for (((frequency, _), label), row) in orders.iter().zip(&labels).zip(&rows) {
                let top = y_axis.max - 0.12 - LABEL_ROOM * *row as f64;
                panel.vertical(*frequency, top, line(MUTED, THIN))?;
                let (x, y) = panel.place((*frequency, top));
                let style = text(TEXT - 1.0, INK, HPos::Left, VPos::Top);
                panel.canvas().draw(&Text::new(label.as_str(), (x + px(5.0), y - px(2.0)), style))?;
            }
            for frequency in sidebands.iter().filter(|frequency| **frequency < highest) {
                panel.vertical(*frequency, y_axis.min + 0.8, line(MUTED, THIN))?;
            }
            panel.curve(above(spectrum.lines(COLUMNS), y_axis.min), line(BLUE, THIN + 0.2))?;
            match peak {
                Some((f, a)) if a > 0.0 => {
                    style::marker(panel.canvas(), Marker::Ring, panel.place((f, a.log10())), 4.5, RED)
                }
                _ => Ok(()),
            }
        })
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
    fn labels_stand_below_those_that_they_begin_within() {
        assert_eq!(rows(&[(0.0, 10.0), (4.0, 10.0), (11.0, 5.0), (20.0, 5.0)]), [0, 1, 2, 0]);
    }

    #[test]
    fn curves_end_at_the_floor() {
        let lines = [1.0, 1e-9, 1e-9, 1e-9, 1.0].map(|a| (0.0, a));
        let found: Vec<f64> = above(lines.into_iter(), -4.0).into_iter().map(|(_, a)| a).collect();
        assert_eq!((found[0], found[1], found[3], found[4]), (0.0, -4.0, -4.0, 0.0));
        assert!(found[2].is_nan());
    }
}
