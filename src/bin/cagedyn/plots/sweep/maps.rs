//! Quantities over two varied values: a map of coloured cells for each, with its scale of colours.

use super::super::axis::Axis;
use super::super::panel::{Place, X_LABELS, Y_LABELS, panel};
use super::super::style::{self, Canvas, Drawn, GRID, INK, MUTED, Marker, TEXT, line, px, text};
use super::Abscissa;
use super::colours::{self, color};
use cagedyn::Result;
use plotters::prelude::{Color, Rectangle, Text};
use plotters::style::text_anchor::{HPos, VPos};

/// Size of a map, px.
const WIDTH: f64 = 330.0;
const HEIGHT: f64 = 250.0;
/// Room for a map with its labels, its name and its scale, px.
const ACROSS: f64 = Y_LABELS + WIDTH + 110.0;
const DOWN: f64 = HEIGHT + X_LABELS + 44.0;
const TOP: f64 = 70.0;
/// Maps beside each other.
const BESIDE: usize = 2;
/// Size of the markers, px.
const MARKER: f64 = 4.0;

/// A point of the sweep in a map.
pub struct Cell {
    /// Both varied values.
    pub at: [f64; 2],
    /// The quantity; none where the run failed or has none.
    pub value: Option<f64>,
    /// Whether that is no failure: the speed of a whirl where there is no whirl.
    pub meaningless: bool,
    /// Whether the run is to be trusted.
    pub trusted: bool,
    /// Whether it is too short for means.
    pub short: bool,
}

/// A map.
pub struct Map {
    /// Name of the quantity with unit.
    pub name: &'static str,
    /// Its cells.
    pub cells: Vec<Cell>,
}

impl Map {
    /// Whether there is anything to see.
    pub fn has_values(&self) -> bool {
        self.cells.iter().any(|cell| cell.value.is_some())
    }
}

/// The picture.
///
/// # Errors
/// [`cagedyn::Status::File`] when it cannot be drawn.
pub fn maps(title: &str, axes: [&Abscissa; 2], maps: &[Map]) -> Result<String> {
    let edges = axes.map(Abscissa::edges);
    let ends = |k: usize| (edges[k].first().copied().unwrap_or(0.0), edges[k].last().copied().unwrap_or(1.0));
    let (x_axis, y_axis) = (axes[0].axis_of_cells(ends(0), 6), axes[1].axis_of_cells(ends(1), 10));
    let any = |is: fn(&Cell) -> bool| maps.iter().flat_map(|map| &map.cells).any(is);
    let mut subtitle = "Means over the averaging window of every run".to_owned();
    if any(|cell| cell.short) {
        subtitle += super::SHORT;
    }
    if maps.iter().any(|map| map.name.starts_with("max ")) {
        subtitle += "; max: the largest in it";
    }
    if any(|cell| cell.meaningless) {
        subtitle += "; grey: no whirl";
    }
    if any(|cell| cell.value.is_none() && !cell.meaningless) {
        subtitle += "; cross: failed, or none";
    }
    if any(|cell| cell.value.is_some() && !cell.trusted) {
        subtitle += "; ring: not to be trusted";
    }
    let columns = maps.len().min(BESIDE);
    let size = (24.0 + columns as f64 * ACROSS, TOP + maps.len().div_ceil(BESIDE) as f64 * DOWN + 16.0);
    style::picture(size, title, &subtitle, |canvas| {
        for (k, map) in maps.iter().enumerate() {
            let (across, down) = ((k % BESIDE) as f64, (k / BESIDE) as f64);
            let corner = (24.0 + Y_LABELS + across * ACROSS, TOP + 28.0 + down * DOWN);
            let place = Place { x: corner.0, y: corner.1, w: WIDTH, h: HEIGHT };
            draw(canvas, place, (axes, &edges), (&x_axis, &y_axis), map)?;
        }
        Ok(())
    })
}

fn draw(
    canvas: &Canvas<'_>,
    place: Place,
    (axes, edges): ([&Abscissa; 2], &[Vec<f64>; 2]),
    (x_axis, y_axis): (&Axis, &Axis),
    map: &Map,
) -> Drawn {
    let name = text(TEXT, INK, HPos::Left, VPos::Center);
    canvas.draw(&Text::new(map.name.to_owned(), (px(place.x), px(place.y - 14.0)), name))?;
    let values = || map.cells.iter().filter_map(|cell| cell.value).filter(|value| value.is_finite());
    let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
    let scale =
        if low < high { Axis::new("", low, high, 5) } else { Axis::covering("", values(), 5) }.narrow();
    panel(canvas, place, (x_axis, y_axis), true, &[], |panel| {
        for cell in &map.cells {
            let spans = [0, 1].map(|k| super::span(&edges[k], axes[k].place(cell.at[k])));
            let color = cell.value.map_or(GRID, |value| color((value - scale.min) / (scale.max - scale.min)));
            let corners = [0, 1].map(|end| panel.place((spans[0][end], spans[1][end])));
            canvas.draw(&Rectangle::new(corners, color.filled()))?;
            // Viewers show gaps between cells that only touch.
            canvas.draw(&Rectangle::new(corners, line(color, 0.5)))?;
            let shape = match (cell.value, cell.trusted) {
                (None, _) if cell.meaningless => None,
                (None, _) => Some((Marker::Cross, MUTED)),
                (Some(_), false) => Some((Marker::Ring, INK)),
                _ => None,
            };
            if let Some((shape, color)) = shape {
                let at = panel.place((axes[0].place(cell.at[0]), axes[1].place(cell.at[1])));
                style::marker(canvas, shape, at, MARKER, color)?;
            }
        }
        Ok(())
    })?;
    colours::scale(canvas, place, &scale)
}
