//! Quantities over one varied value, one diagram below the other: means with the band of the run, or one curve for each value of a list.

use super::super::axis::Axis;
use super::super::look;
use super::super::panel::{Panel, Place, panel};
use super::super::style::{
    self, BLUE, CURVE, Canvas, Drawn, Marker, Paint, RED, SHADE, Symbol, TEXT, line, text_width,
};
use super::Abscissa;
use cagedyn::Result;

/// Size of a diagram, its place and the gap between two, px.
const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 165.0;
const LEFT: f64 = 100.0;
const TOP: f64 = 80.0;
const GAP: f64 = 16.0;
/// Size of the markers, px.
const MARKER: f64 = 4.0;

/// A point of the sweep in a diagram.
pub struct Mark {
    /// The varied value.
    pub x: f64,
    /// Mean of the quantity, if there is one.
    pub mean: Option<f64>,
    /// Fifth and 95th percentile.
    pub band: Option<[f64; 2]>,
    /// Whether the run is to be trusted.
    pub trusted: bool,
    /// Whether it failed.
    pub failed: bool,
    /// Whether it is too short for means.
    pub short: bool,
}

/// A diagram.
pub struct Curves {
    /// Name of the quantity with unit.
    pub name: &'static str,
    /// Points in the order of the varied value, of each curve.
    pub series: Vec<Vec<Mark>>,
}

/// The picture; `labels` are those of the curves, of which there is one without label otherwise.
///
/// # Errors
/// [`cagedyn::Status::File`] when it cannot be drawn.
pub fn lines(title: &str, x: &Abscissa, labels: &[String], diagrams: &[Curves]) -> Result<String> {
    let x_axis = x.covering(10);
    let entries = entries(labels, diagrams);
    let longest = entries.iter().map(|(_, label)| text_width(label, TEXT)).fold(120.0, f64::max);
    let height = TOP + diagrams.len() as f64 * (HEIGHT + GAP) + 50.0;
    let width = LEFT + WIDTH + 28.0 + 36.0 + longest;
    let mut subtitle = "Over the averaging window of every run".to_owned();
    if diagrams.iter().flat_map(|d| &d.series).flatten().any(|mark| mark.short) {
        subtitle += super::SHORT;
    }
    style::picture((width, height), title, &subtitle, |canvas| {
        legend(canvas, &entries)?;
        for (k, diagram) in diagrams.iter().enumerate() {
            let marks = || diagram.series.iter().flatten();
            let bands = marks().filter_map(|mark| mark.band).flatten().filter(|_| labels.is_empty());
            let y_axis =
                Axis::covering(diagram.name, marks().filter_map(|mark| mark.mean).chain(bands), 5).narrow();
            let place = Place { x: LEFT, y: TOP + k as f64 * (HEIGHT + GAP), w: WIDTH, h: HEIGHT };
            let last = k + 1 == diagrams.len();
            panel(canvas, place, (&x_axis, &y_axis), last, &[], |panel| {
                for (k, series) in diagram.series.iter().enumerate() {
                    let (shape, color) = if labels.is_empty() { (Marker::Disc, BLUE) } else { look(k) };
                    if labels.is_empty() {
                        band(panel, x, series)?;
                    }
                    curve(panel, x, series, (shape, color))?;
                    for mark in series.iter().filter(|mark| mark.failed) {
                        let at = panel.place((x.place(mark.x), y_axis.min));
                        style::marker(panel.canvas(), Marker::Cross, at, MARKER, RED)?;
                    }
                }
                Ok(())
            })?;
        }
        Ok(())
    })
}

/// What the picture has of: curves, bands, points that are not to be trusted or failed.
fn entries(labels: &[String], diagrams: &[Curves]) -> Vec<(Symbol, String)> {
    let any = |is: fn(&Mark) -> bool| diagrams.iter().flat_map(|d| &d.series).flatten().any(is);
    let mut entries: Vec<(Symbol, String)> = Vec::new();
    for (k, label) in labels.iter().enumerate() {
        let (shape, color) = look(k);
        entries.push((Symbol::MarkedLine(shape, color), label.clone()));
    }
    if labels.is_empty() {
        entries.push((Symbol::MarkedLine(Marker::Disc, BLUE), "mean".to_owned()));
        entries.push((Symbol::Patch, "5th to 95th percentile".to_owned()));
    }
    if any(|mark| !mark.trusted) {
        entries.push((Symbol::Marker(Marker::Ring, BLUE), "not to be trusted".to_owned()));
    }
    if any(|mark| mark.failed) {
        entries.push((Symbol::Marker(Marker::Cross, RED), "failed".to_owned()));
    }
    entries
}

fn legend(canvas: &Canvas<'_>, entries: &[(Symbol, String)]) -> Drawn {
    let place = |k: usize| (LEFT + WIDTH + 28.0, TOP + 16.0 + 26.0 * k as f64);
    entries
        .iter()
        .enumerate()
        .try_for_each(|(k, (symbol, label))| style::legend_entry(canvas, place(k), *symbol, label))
}

/// Where runs beside each other have bands.
fn band(panel: &mut Panel<'_, '_, '_>, x: &Abscissa, marks: &[Mark]) -> Drawn {
    for part in marks.split(|mark| mark.band.is_none()) {
        let edge = |k: usize| part.iter().filter_map(move |mark| Some((x.place(mark.x), mark.band?[k])));
        let low: Vec<_> = edge(0).collect();
        panel.area(edge(1).chain(low.into_iter().rev()), SHADE)?;
        for k in [0, 1] {
            panel.curve(edge(k), line(style::FAINT, 0.6))?;
        }
    }
    Ok(())
}

fn curve(
    panel: &mut Panel<'_, '_, '_>,
    x: &Abscissa,
    marks: &[Mark],
    (shape, color): (Marker, Paint),
) -> Drawn {
    let points = marks.iter().map(|mark| (x.place(mark.x), mark.mean.unwrap_or(f64::NAN)));
    panel.curve(points.clone(), line(color, CURVE))?;
    for (mark, point) in marks.iter().zip(points).filter(|(mark, _)| mark.mean.is_some()) {
        let shape = if mark.trusted { shape } else { Marker::Ring };
        style::marker(panel.canvas(), shape, panel.place(point), MARKER, color)?;
    }
    Ok(())
}
