//! Amplitude spectrum of the cage position (compare Fig. 6).

use super::axis::Axis;
use super::panel::{Place, panel};
use super::style::{self, BLUE, INK, MUTED, Marker, RED, Symbol, TEXT, THIN, line, px, text};
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
const ABOVE_WHIRL: f64 = 1.5;
/// Powers of ten shown below the peak.
const DECADES: f64 = 4.0;
/// Label of the whirl frequency.
const WHIRL: &str = "whirl";
/// Frequency ranges that are told apart.
const COLUMNS: usize = 1000;
/// Room above the peak for the label of a frequency, and above all labels, in powers of ten.
const LABEL_ROOM: f64 = 0.35;
const TOP_ROOM: f64 = 0.25;
/// There is room for at least this many labels.
const MIN_LABELS: usize = 3;

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
    let sidebands =
        summary.cage_frequency_hz.map_or(Vec::new(), |f| vec![(count - 1.0) * f, (count + 1.0) * f]);
    Some(draw(&run.title, &run.subtitle(&what), &spectrum, (&orders(run, summary), &sidebands)))
}

/// Frequencies to mark, with their names: those of the cage, of the pockets passing by and of the whirl.
fn orders(run: &Run, summary: &Summary) -> Vec<(f64, String)> {
    let Some(cage) = summary.cage_frequency_hz.filter(|f| *f > 0.0) else { return Vec::new() };
    let count = run.model.element_count();
    let mut list = vec![(cage, "f_c".to_owned())];
    if count != 4 {
        list.push((4.0 * cage, "4 f_c".to_owned()));
    }
    list.push((count as f64 * cage, format!("Z f_c = {count} f_c")));
    list.extend(summary.whirl.as_ref().and_then(Whirl::frequency).map(|f| (f, WHIRL.to_owned())));
    list.sort_by(|a, b| a.0.total_cmp(&b.0));
    list
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
    let room = TOP_ROOM + LABEL_ROOM * orders.len().max(MIN_LABELS) as f64;
    let x_axis = Axis::new("frequency [Hz]", 0.0, highest, 10);
    let y_axis = Axis::powers_of_ten("amplitude of cage.z [mm]", (largest - DECADES).round(), largest + room);
    let place = Place { x: 100.0, y: 100.0, w: 770.0, h: 370.0 };
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
        let whirls = orders.iter().any(|(_, name)| name == WHIRL);
        let marks = if whirls { "f_c, n f_c, whirl" } else { "f_c, n f_c, Z f_c ± f_c" };
        entries.push((Symbol::Dashed(MUTED), marks.to_owned()));
        style::legend_row(canvas, 78.0, &entries)?;
        panel(canvas, place, (&x_axis, &y_axis), true, &[], |panel| {
            // Every label has a height of its own and its line ends there, so that none crosses another's text.
            let shown = orders.iter().filter(|(frequency, _)| *frequency < highest);
            for (row, (frequency, name)) in shown.enumerate() {
                let top = y_axis.max - 0.12 - LABEL_ROOM * row as f64;
                panel.vertical(*frequency, top, line(MUTED, THIN))?;
                let (x, y) = panel.place((*frequency, top));
                let label = format!("{name}, {} Hz", number(*frequency));
                let style = text(TEXT - 1.0, INK, HPos::Left, VPos::Top);
                panel.canvas().draw(&Text::new(label, (x + px(5.0), y - px(2.0)), style))?;
            }
            for frequency in sidebands.iter().filter(|frequency| **frequency < highest) {
                panel.vertical(*frequency, y_axis.min + 0.8, line(MUTED, THIN))?;
            }
            let points = spectrum.lines(COLUMNS).map(|(f, a)| (f, a.max(1e-300).log10().max(y_axis.min)));
            panel.curve(points, line(BLUE, THIN + 0.2))?;
            match peak {
                Some((f, a)) if a > 0.0 => {
                    style::marker(panel.canvas(), Marker::Ring, panel.place((f, a.log10())), 4.5, RED)
                }
                _ => Ok(()),
            }
        })
    })
}
