//! Quantities over two varied values: a map of coloured cells for each, with its scale of colours.

use super::super::axis::Axis;
use super::super::panel::{Place, X_LABELS, Y_LABELS, panel};
use super::super::style::{
    self, Canvas, Drawn, GRID, INK, MUTED, Marker, PAPER, Paint, TEXT, line, px, text,
};
use super::Abscissa;
use cagedyn::Result;
use plotters::prelude::{Color, Rectangle, Text};
use plotters::style::text_anchor::{HPos, VPos};

/// Size of a map and of its scale, px.
const WIDTH: f64 = 330.0;
const HEIGHT: f64 = 250.0;
const SCALE: f64 = 14.0;
/// Room for a map with its labels, its name and its scale, px.
const ACROSS: f64 = Y_LABELS + WIDTH + 110.0;
const DOWN: f64 = HEIGHT + X_LABELS + 44.0;
const TOP: f64 = 70.0;
/// Maps beside each other.
const BESIDE: usize = 2;
/// Steps of the scale.
const STEPS: usize = 64;
/// Size of the markers, px.
const MARKER: f64 = 4.0;

/// Colours from the smallest to the largest value, even in lightness from dark to light.
const COLOURS: [Paint; 6] = [
    Paint(0x1f, 0x2a, 0x5c),
    Paint(0x1f, 0x5f, 0xa6),
    Paint(0x1c, 0x8f, 0x9c),
    Paint(0x58, 0xb3, 0x78),
    Paint(0xb9, 0xcf, 0x5a),
    Paint(0xf7, 0xe8, 0x7d),
];

/// A point of the sweep in a map.
pub struct Cell {
    /// Both varied values.
    pub at: [f64; 2],
    /// The quantity; none where the run failed or has none.
    pub value: Option<f64>,
    /// Whether the run is to be trusted.
    pub trusted: bool,
}

/// A map.
pub struct Map {
    /// Name of the quantity with unit.
    pub name: &'static str,
    /// Its cells.
    pub cells: Vec<Cell>,
}

/// The picture.
///
/// # Errors
/// [`cagedyn::Status::File`] when it cannot be drawn.
pub fn maps(title: &str, axes: [&Abscissa; 2], maps: &[Map]) -> Result<String> {
    let edges = axes.map(Abscissa::edges);
    let ends = |k: usize| (edges[k].first().copied().unwrap_or(0.0), edges[k].last().copied().unwrap_or(1.0));
    let (x_axis, y_axis) = (axes[0].axis(ends(0), 4), axes[1].axis(ends(1), 5));
    let any = |is: fn(&Cell) -> bool| maps.iter().flat_map(|map| &map.cells).any(is);
    let mut subtitle = "Means over the averaging window of every run; SI units".to_owned();
    if any(|cell| cell.value.is_none()) {
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
            let spans = [0, 1].map(|k| span(&edges[k], axes[k].place(cell.at[k])));
            let color = cell.value.map_or(GRID, |value| color((value - scale.min) / (scale.max - scale.min)));
            let corners = [0, 1].map(|end| panel.place((spans[0][end], spans[1][end])));
            canvas.draw(&Rectangle::new(corners, color.filled()))?;
            // Viewers show gaps between cells that only touch.
            canvas.draw(&Rectangle::new(corners, line(color, 0.5)))?;
            let shape = match (cell.value, cell.trusted) {
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
    draw_scale(canvas, place, &scale)
}

/// The edges around a place.
fn span(edges: &[f64], place: f64) -> [f64; 2] {
    let above = edges.partition_point(|edge| *edge < place).clamp(1, edges.len() - 1);
    [edges[above - 1], edges[above]]
}

fn draw_scale(canvas: &Canvas<'_>, place: Place, scale: &Axis) -> Drawn {
    let x = place.x + place.w + 14.0;
    let height = |share: f64| px(place.y + (1.0 - share) * place.h);
    for step in 0..STEPS {
        let [from, to] = [step, step + 1].map(|step| step as f64 / STEPS as f64);
        // Up to the end, so that there are no gaps between steps.
        let corners = [(px(x), height(from)), (px(x + SCALE), height(1.0))];
        canvas.draw(&Rectangle::new(corners, color(0.5 * (from + to)).filled()))?;
    }
    canvas.draw(&Rectangle::new([(px(x), height(0.0)), (px(x + SCALE), height(1.0))], line(MUTED, 0.8)))?;
    for tick in scale.ticks() {
        let at = (px(x + SCALE + 6.0), height((tick - scale.min) / (scale.max - scale.min)));
        let style = text(TEXT - 1.0, INK, HPos::Left, VPos::Center);
        canvas.draw(&Text::new(scale.label(tick), at, style))?;
    }
    Ok(())
}

/// The colour at a share of the scale.
fn color(share: f64) -> Paint {
    if !share.is_finite() {
        return PAPER;
    }
    let place = share.clamp(0.0, 1.0) * (COLOURS.len() - 1) as f64;
    let (k, part) = ((place as usize).min(COLOURS.len() - 2), place.fract());
    let part = if place as usize > k { 1.0 } else { part };
    let mixed = |a: u8, b: u8| (f64::from(a) + part * (f64::from(b) - f64::from(a))).round() as u8;
    let (a, b) = (COLOURS[k], COLOURS[k + 1]);
    Paint(mixed(a.0, b.0), mixed(a.1, b.1), mixed(a.2, b.2))
}
