//! A diagram with grid and axes at an exact place of a picture.

use super::axis::Axis;
use super::style::{Canvas, Drawn, GRID, INK, MUTED, Paint, SHADE, TEXT, line, px, text};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use std::f64::consts::TAU;

/// Width of the strip for the labels of the y axis, px.
pub const Y_LABELS: f64 = 74.0;
/// Height of the strip for the labels of the x axis, px.
pub const X_LABELS: f64 = 46.0;
/// Place of the second line of the name of the y axis in its strip, px.
const SECOND_LINE: f64 = 22.0;
/// Curves are drawn as dashes of this length and half as long gaps, px.
const DASH: f64 = 6.0;
/// Head of an arrow in a diagram of round things: length and half width in units of a radius of it.
pub const HEAD: (f64, f64) = (0.035, 0.013);
/// Largest half length of an arc that tells a direction, in the same unit.
const ARC: f64 = 0.15;

/// Rectangle of a diagram without its labels, px.
#[derive(Clone, Copy)]
pub struct Place {
    /// Left edge.
    pub x: f64,
    /// Upper edge.
    pub y: f64,
    /// Width.
    pub w: f64,
    /// Height.
    pub h: f64,
}

type Coordinates = Cartesian2d<Axis, Axis>;

/// A diagram to draw in.
pub struct Panel<'c, 'a, 'b> {
    canvas: &'c Canvas<'b>,
    chart: ChartContext<'a, SVGBackend<'b>, Coordinates>,
    y_range: (f64, f64),
}

/// Draws a diagram; `draw` adds its contents. Without `x_labels` the x axis has a grid only. The name of the y axis may have a second
/// line.
pub fn panel(
    canvas: &Canvas<'_>,
    place: Place,
    (x, y): (&Axis, &Axis),
    x_labels: bool,
    shaded: &[(f64, f64)],
    draw: impl FnOnce(&mut Panel<'_, '_, '_>) -> Drawn,
) -> Drawn {
    let below = if x_labels { X_LABELS } else { 0.0 };
    let corner = (px(place.x - Y_LABELS), px(place.y));
    canvas.note([place.x, place.y, place.w, place.h], [x, y]);
    let area = (**canvas).clone().shrink(corner, (px(place.w + Y_LABELS) as u32, px(place.h + below) as u32));
    let mut chart = ChartBuilder::on(&area)
        .set_label_area_size(LabelAreaPosition::Left, px(Y_LABELS))
        .set_label_area_size(LabelAreaPosition::Bottom, px(below))
        .build_cartesian_2d(x.clone(), y.clone())?;
    let rectangles = shaded
        .iter()
        .map(|&(a, b)| Rectangle::new([(a.max(x.min), y.min), (b.min(x.max), y.max)], SHADE.filled()));
    chart.draw_series(rectangles)?;
    mesh(&mut chart, x, y)?;
    if let Some((_, second)) = y.name.split_once('\n') {
        let style = text(TEXT - 2.0, MUTED, HPos::Center, VPos::Center).transform(FontTransform::Rotate270);
        let at = (px(place.x - Y_LABELS + SECOND_LINE), px(place.y + 0.5 * place.h));
        canvas.draw(&Text::new(second.to_owned(), at, style))?;
    }
    let frame = [(x.min, y.min), (x.max, y.max)];
    chart.draw_series([Rectangle::new(frame, line(MUTED, 0.8))])?;
    draw(&mut Panel { canvas, chart, y_range: (y.min, y.max) })
}

fn mesh(chart: &mut ChartContext<'_, SVGBackend<'_>, Coordinates>, x: &Axis, y: &Axis) -> Drawn {
    let label = text(TEXT - 1.0, INK, HPos::Center, VPos::Center);
    let name = text(TEXT, INK, HPos::Center, VPos::Center);
    chart
        .configure_mesh()
        .bold_line_style(line(GRID, 0.8))
        .axis_style(line(MUTED, 0.8))
        .label_style(label)
        .axis_desc_style(name)
        .x_desc(x.name.as_str())
        .y_desc(y.name.lines().next().unwrap_or_default())
        .x_label_formatter(&|v| x.label(*v))
        .y_label_formatter(&|v| y.label(*v))
        .set_all_tick_mark_size(px(4.0))
        .draw()
}

impl<'b> Panel<'_, '_, 'b> {
    /// Draws a curve, with gaps where it is not finite.
    pub fn curve(&mut self, points: impl IntoIterator<Item = (f64, f64)>, style: ShapeStyle) -> Drawn {
        let points: Vec<_> = points.into_iter().collect();
        for part in points.split(|(x, y)| !x.is_finite() || !y.is_finite()).filter(|part| !part.is_empty()) {
            self.chart.draw_series(LineSeries::new(part.iter().copied(), style))?;
        }
        Ok(())
    }

    /// Fills the room between a lower and an upper value from time to time: (from, to, lower, upper).
    pub fn envelope(&mut self, parts: impl Iterator<Item = (f64, f64, f64, f64)>, color: Paint) -> Drawn {
        let boxes =
            parts.map(|(from, to, low, high)| Rectangle::new([(from, low), (to, high)], color.filled()));
        self.chart.draw_series(boxes)?;
        Ok(())
    }

    /// Fills the area within a closed line.
    pub fn area(&mut self, edge: impl IntoIterator<Item = (f64, f64)>, color: Paint) -> Drawn {
        let edge: Vec<_> = edge.into_iter().collect();
        self.chart.draw_series([Polygon::new(edge, color.filled())])?;
        Ok(())
    }

    /// Draws a dashed curve.
    pub fn dashed(&mut self, points: impl IntoIterator<Item = (f64, f64)>, style: ShapeStyle) -> Drawn {
        let points: Vec<_> = points.into_iter().collect();
        self.chart.draw_series(DashedLineSeries::new(points, px(DASH), px(0.5 * DASH), style))?;
        Ok(())
    }

    /// Draws a vertical line from the bottom up to `top`.
    pub fn vertical(&mut self, x: f64, top: f64, style: ShapeStyle) -> Drawn {
        self.dashed([(x, self.y_range.0), (x, top)], style)
    }

    /// Draws a circle about the origin.
    pub fn circle(&mut self, radius: f64, style: ShapeStyle) -> Drawn {
        let angles = (0..=180).map(|i| f64::from(i) * TAU / 180.0);
        self.curve(angles.map(|a| (radius * a.cos(), radius * a.sin())), style)
    }

    /// Draws an arc about the origin, above it, that tells a direction of turning: 1 counter-clockwise, -1 clockwise. `scale` is a
    /// radius of the diagram, which the size of its head follows.
    pub fn turning(&mut self, radius: f64, way: f64, (scale, color): (f64, Paint)) -> Drawn {
        let at = |angle: f64, radius: f64| {
            let angle = 0.25 * TAU + way * angle;
            (radius * angle.cos(), radius * angle.sin())
        };
        let (length, half) = (0.8 * HEAD.0 * scale / radius, 0.8 * HEAD.1 * scale);
        let arc = (ARC * scale / radius).min(TAU / 9.0);
        self.curve((-20..=20).map(|i| at(arc * f64::from(i) / 20.0, radius)), line(color, 1.2))?;
        self.area([at(arc + length, radius), at(arc, radius + half), at(arc, radius - half)], color)
    }

    /// Place of a point on the surface.
    pub fn place(&self, point: (f64, f64)) -> (i32, i32) {
        self.chart.backend_coord(&point)
    }

    /// The surface of the whole picture.
    pub fn canvas(&self) -> &Canvas<'b> {
        self.canvas
    }
}
