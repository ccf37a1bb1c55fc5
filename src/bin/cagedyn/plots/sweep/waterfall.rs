//! Spectra over one varied value: amplitude as colour over frequency, with the frequencies of the bearing.

use super::super::axis::Axis;
use super::super::panel::{Panel, Place, X_LABELS, panel};
use super::super::style::{
    self, Canvas, Drawn, GRID, INK, Marker, PAPER, Paint, RED, Symbol, TEXT, line, px, text, text_width,
};
use super::Abscissa;
use super::colours::{self, STEPS, color};
use cagedyn::Result;
use plotters::prelude::{Color, Rectangle, Text};
use plotters::style::text_anchor::{HPos, VPos};

/// Size of the diagram and its place, px.
const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 440.0;
const LEFT: f64 = 100.0;
const TOP: f64 = 112.0;
/// Room for the scale of colours, px.
const SCALE: f64 = 110.0;
/// Ranges of frequency that are told apart, and columns.
const ROWS: usize = 220;
const COLUMNS: usize = 360;
/// Powers of ten of the scale.
const DECADES: f64 = 4.0;
/// Frequencies are shown up to this multiple of the highest that is marked.
const ABOVE_MARKS: f64 = 1.1;
/// Least distance of two labels, px.
const LABEL: f64 = 14.0;

/// Spectrum of a run.
pub struct Column {
    /// The varied value.
    pub at: f64,
    /// Resolution, Hz: what is slower is no oscillation in the time that was seen.
    pub resolution: f64,
    /// Frequencies and amplitudes in order, Hz and m.
    pub lines: Vec<(f64, f64)>,
    /// Frequencies of the bearing by their names, Hz.
    pub marks: Vec<(String, f64)>,
}

/// Spectra over one value, in a diagram of their own.
pub struct Spectra {
    /// What they have in common, if there are several diagrams.
    pub name: Option<String>,
    /// The varied value.
    pub axis: Abscissa,
    /// Spectra.
    pub columns: Vec<Column>,
    /// Values whose runs failed.
    pub failed: Vec<f64>,
}

/// The picture; all diagrams have the same frequencies and colours.
///
/// # Errors
/// [`cagedyn::Status::File`] when it cannot be drawn.
pub fn waterfall(title: &str, diagrams: &[Spectra]) -> Result<String> {
    let all: Vec<&Column> = diagrams.iter().flat_map(|diagram| &diagram.columns).collect();
    let highest = highest(&all);
    let scale = scale(&all, highest);
    let (height, gap) = if diagrams.len() > 1 { (0.7 * HEIGHT, X_LABELS + 36.0) } else { (HEIGHT, 0.0) };
    let size = (LEFT + WIDTH + SCALE, TOP + diagrams.len() as f64 * (height + gap) - gap + X_LABELS + 16.0);
    let resolutions = all.iter().map(|column| column.resolution);
    let range = [f64::min, f64::max].map(|of| resolutions.clone().reduce(of).unwrap_or(0.0));
    let range = range.map(|x| format!("{x:.1}"));
    let range = if range[0] == range[1] { range[0].clone() } else { range.join(" to ") };
    let subtitle = format!("Amplitude spectrum of cage.z; Hann window, resolution {range} Hz");
    style::picture(size, title, &subtitle, |canvas| {
        let marked = names(&all).join(", ");
        let mut entries = vec![(Symbol::Dashed(INK), marked)];
        if diagrams.iter().any(|diagram| !diagram.failed.is_empty()) {
            entries.push((Symbol::Marker(Marker::Cross, RED), "failed".to_owned()));
        }
        entries.retain(|(_, text)| !text.is_empty());
        style::legend_row(canvas, 76.0, &entries)?;
        for (k, diagram) in diagrams.iter().enumerate() {
            let place = Place { x: LEFT, y: TOP + k as f64 * (height + gap), w: WIDTH, h: height };
            if let Some(name) = &diagram.name {
                let style = text(TEXT, INK, HPos::Left, VPos::Center);
                canvas.draw(&Text::new(name.clone(), (px(place.x), px(place.y - 12.0)), style))?;
            }
            draw(canvas, place, diagram, (highest, &scale))?;
        }
        Ok(())
    })
}

fn draw(canvas: &Canvas<'_>, place: Place, diagram: &Spectra, (highest, scale): (f64, &Axis)) -> Drawn {
    let x = &diagram.axis;
    let mut columns: Vec<&Column> = diagram.columns.iter().collect();
    columns.sort_by(|a, b| x.place(a.at).total_cmp(&x.place(b.at)));
    let edges = x.edges();
    let ends = (edges.first().copied().unwrap_or(0.0), edges.last().copied().unwrap_or(1.0));
    let (x_axis, y_axis) = (x.axis(ends, 10), Axis::new("frequency [Hz]", 0.0, highest, 8));
    panel(canvas, place, (&x_axis, &y_axis), true, &[], |panel| {
        fill(panel, [(ends.0, 0.0), (ends.1, highest)], GRID)?;
        for together in columns.chunks(columns.len().div_ceil(COLUMNS).max(1)) {
            cells(panel, (x, &edges), together, (highest, scale))?;
        }
        marks(panel, x, &columns, highest)?;
        for at in &diagram.failed {
            let at = panel.place((x.place(*at), 0.0));
            style::marker(panel.canvas(), Marker::Cross, (at.0, at.1 - px(8.0)), 4.0, RED)?;
        }
        Ok(())
    })?;
    colours::scale(canvas, place, scale)
}

/// Names of the marked frequencies.
fn names<'a>(columns: &[&'a Column]) -> Vec<&'a str> {
    let mut names: Vec<&str> = Vec::new();
    for (name, _) in columns.iter().flat_map(|column| &column.marks) {
        if !names.contains(&name.as_str()) {
            names.push(name);
        }
    }
    names
}

/// The highest frequency shown: a little above what is marked, but not above both all oscillations that the scale can show and the
/// marks without multiple; at most what records show.
fn highest(columns: &[&Column]) -> f64 {
    let largest = |frequencies: &mut dyn Iterator<Item = f64>| frequencies.fold(0.0, f64::max);
    let recorded = largest(&mut columns.iter().filter_map(|column| Some(column.lines.last()?.0)));
    let marks = || columns.iter().flat_map(|column| &column.marks);
    let multiple = |name: &str| name.starts_with(|c: char| c.is_ascii_digit());
    let marked = largest(&mut marks().map(|(_, f)| *f));
    if marked == 0.0 {
        return if recorded > 0.0 { recorded } else { 1.0 };
    }
    let limit = recorded.min(ABOVE_MARKS * marked);
    let floor = 10f64.powf(scale(columns, limit).min);
    let lines = columns.iter().flat_map(|column| &column.lines);
    let seen = largest(&mut lines.filter(|(f, a)| *f <= limit && *a > floor).map(|(f, _)| *f));
    let plain = largest(&mut marks().filter(|(name, _)| !multiple(name)).map(|(_, f)| *f));
    limit.min(ABOVE_MARKS * seen.max(plain))
}

/// The scale of the logarithms of amplitudes: some powers of ten below the largest oscillation that is shown.
fn scale(columns: &[&Column], highest: f64) -> Axis {
    let shown = columns.iter().flat_map(|column| {
        column.lines.iter().filter(|(f, _)| *f > column.resolution && *f <= highest).map(|(_, a)| *a)
    });
    let largest = shown.fold(1e-15, f64::max).log10();
    Axis::powers_of_ten("amplitude of cage.z [m]", (largest - DECADES).round(), largest)
}

fn fill(panel: &Panel<'_, '_, '_>, corners: [(f64, f64); 2], paint: Paint) -> Drawn {
    let corners = corners.map(|corner| panel.place(corner));
    panel.canvas().draw(&Rectangle::new(corners, paint.filled()))?;
    // Viewers show gaps between cells that only touch.
    panel.canvas().draw(&Rectangle::new(corners, line(paint, 0.5)))
}

/// Cells of columns that share one place, each with the largest amplitude in it.
fn cells(
    panel: &Panel<'_, '_, '_>,
    (x, edges): (&Abscissa, &[f64]),
    together: &[&Column],
    (highest, scale): (f64, &Axis),
) -> Drawn {
    let (Some(first), Some(last)) = (together.first(), together.last()) else { return Ok(()) };
    let span = (super::span(edges, x.place(first.at))[0], super::span(edges, x.place(last.at))[1]);
    let edge = |row: usize| highest * row as f64 / ROWS as f64;
    let step = |row: usize| {
        let inside = |column: &&Column| amplitude(&column.lines, edge(row), edge(row + 1));
        let largest = together.iter().filter_map(inside).reduce(f64::max)?;
        let share = (largest.max(1e-300).log10() - scale.min) / (scale.max - scale.min);
        Some((share.clamp(0.0, 1.0) * (STEPS - 1) as f64).round() as usize)
    };
    let steps: Vec<Option<usize>> = (0..ROWS).map(step).collect();
    // Cells of one colour above each other are one.
    let mut from = 0;
    for run in steps.chunk_by(|a, b| a == b) {
        let to = from + run.len();
        if let Some(step) = run[0] {
            let paint = color(step as f64 / (STEPS - 1) as f64);
            fill(panel, [(span.0, edge(from)), (span.1, edge(to))], paint)?;
        }
        from = to;
    }
    Ok(())
}

/// The largest amplitude between two frequencies: of the lines there, and of the one that is nearest to their middle. `None` beyond
/// what records show.
fn amplitude(lines: &[(f64, f64)], from: f64, to: f64) -> Option<f64> {
    let middle = 0.5 * (from + to);
    let above = lines.partition_point(|(f, _)| *f < middle);
    let near = [above.checked_sub(1), Some(above)].into_iter().flatten().filter_map(|i| lines.get(i));
    let nearest = near.min_by(|a, b| (a.0 - middle).abs().total_cmp(&(b.0 - middle).abs()))?;
    if from > lines.last()?.0 {
        return None;
    }
    let [first, last] = [from, to].map(|edge| lines.partition_point(|(f, _)| *f < edge));
    Some(lines[first..last].iter().map(|(_, a)| *a).fold(nearest.1, f64::max))
}

/// The frequencies of the bearing with their names, which stand where the highest of them ends.
fn marks(panel: &mut Panel<'_, '_, '_>, x: &Abscissa, columns: &[&Column], highest: f64) -> Drawn {
    let of = |column: &Column, name: &str| {
        let mark = column.marks.iter().find(|(other, f)| other == name && *f <= highest);
        (x.place(column.at), mark.map_or(f64::NAN, |(_, f)| *f))
    };
    let mut ends: Vec<(i32, i32, HPos, &str)> = Vec::new();
    for name in names(columns) {
        let curve: Vec<(f64, f64)> = columns.iter().map(|column| of(column, name)).collect();
        // Dark and light in turn are seen on every colour.
        panel.curve(curve.iter().copied(), line(INK, 1.0))?;
        for part in curve.split(|(_, f)| f.is_nan()).filter(|part| !part.is_empty()) {
            panel.dashed(part.iter().copied(), line(PAPER, 1.0))?;
        }
        let known = || curve.iter().filter(|(_, f)| f.is_finite());
        let (Some(first), Some(last)) = (known().next(), known().next_back()) else { continue };
        let (end, side) = if first.1 > last.1 { (first, HPos::Left) } else { (last, HPos::Right) };
        let (x, y) = panel.place(*end);
        let inwards = if matches!(side, HPos::Left) { px(5.0) } else { -px(5.0) };
        ends.push((x + inwards, y - px(0.7 * LABEL), side, name));
    }
    ends.sort_by_key(|(_, y, ..)| std::cmp::Reverse(*y));
    let mut below = i32::MAX;
    let top = panel.place((0.0, highest)).1 + px(0.7 * LABEL);
    for (x, y, side, name) in ends {
        let y = y.min(below.saturating_sub(px(LABEL))).max(top);
        let (width, half) = (px(text_width(name, TEXT)), px(0.5 * LABEL));
        let (left, right) = if matches!(side, HPos::Left) { (x, x + width) } else { (x - width, x) };
        let behind = [(left - px(2.0), y - half), (right + px(2.0), y + half)];
        panel.canvas().draw(&Rectangle::new(behind, PAPER.filled()))?;
        panel.canvas().draw(&Text::new(name.to_owned(), (x, y), text(TEXT, INK, side, VPos::Center)))?;
        below = y;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_have_the_largest_amplitude_in_them() {
        let lines = [(0.0, 1.0), (10.0, 3.0), (12.0, 7.0), (30.0, 2.0)];
        assert_eq!(amplitude(&lines, 9.0, 13.0), Some(7.0));
        assert_eq!(amplitude(&lines, 2.0, 3.0), Some(1.0));
        assert_eq!(amplitude(&lines, 24.0, 26.0), Some(2.0));
        assert_eq!(amplitude(&lines, 31.0, 33.0), None);
        assert_eq!(amplitude(&[], 0.0, 1.0), None);
    }

    #[test]
    fn frequencies_end_above_what_is_marked_and_scales_at_the_largest_oscillation() {
        let column = |marks: &[(&str, f64)]| Column {
            at: 1.0,
            resolution: 5.0,
            lines: vec![(0.0, 1.0), (4.0, 0.5), (20.0, 1e-3), (400.0, 1e-2), (1000.0, 1e-1)],
            marks: marks.iter().map(|(name, f)| ((*name).to_owned(), *f)).collect(),
        };
        let (plain, marked) = (column(&[]), column(&[("f_c", 20.0), ("Z f_c", 240.0)]));
        assert_eq!(highest(&[&plain]), 1000.0);
        assert!((highest(&[&plain, &marked]) - 264.0).abs() < 1e-9);
        assert_eq!(highest(&[]), 1.0);
        // Multiples of which nothing is heard are left out.
        let quiet = column(&[("f_c", 20.0), ("Z f_c", 240.0), ("3 Z f_c", 720.0)]);
        assert!((highest(&[&quiet]) - 440.0).abs() < 1e-9, "{}", highest(&[&quiet]));
        // Neither the drift nor what is not shown.
        let scale = scale(&[&marked], 264.0);
        assert!((scale.max + 3.0).abs() < 1e-9 && (scale.min + 7.0).abs() < 1e-9);
        assert_eq!(names(&[&plain, &marked]), ["f_c", "Z f_c"]);
    }
}
