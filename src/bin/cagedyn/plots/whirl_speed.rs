//! Whirl speed of all cases over the speed of the inner ring.

use super::axis::Axis;
use super::labels::beside;
use super::panel::{Panel, Place, panel};
use super::style::{
    self, CURVE, Canvas, Drawn, INK, MUTED, Marker, Paint, Symbol, TEXT, THIN, line, px, text_width,
};
use super::{Series, is_long, look};
use cagedyn::Result;
use plotters::prelude::PathElement;

/// Size of the diagram, px.
const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 440.0;
/// Size of the markers and half width of the ends of the bars, px.
const MARKER: f64 = 4.5;
const BAR_END: f64 = 4.0;

/// Whirl of one case.
pub struct WhirlPoint {
    /// Speed of the inner ring in 1/min.
    pub speed: f64,
    /// Mean whirl speed, rad/s.
    pub mean: f64,
    /// Its fifth and 95th percentile, rad/s.
    pub band: [f64; 2],
    /// Whether the cage whirls.
    pub whirls: bool,
}

/// The picture.
///
/// # Errors
/// [`cagedyn::Status::File`] when it cannot be drawn.
pub fn whirl_speed(title: &str, series: &[Series<WhirlPoint>]) -> Result<String> {
    let points = || series.iter().flat_map(|s| &s.points);
    let fastest = points().map(|p| p.speed).fold(0.0, f64::max);
    let slowest = points().map(|p| p.speed).fold(f64::INFINITY, f64::min);
    let logarithmic = is_long(&points().map(|p| p.speed).collect::<Vec<_>>());
    let x = |speed: f64| if logarithmic { speed.log10() } else { speed };
    let x_axis = if logarithmic {
        let [low, high] = [slowest, fastest].map(f64::log10);
        let room = 0.04 * (high - low);
        Axis::logarithms("inner ring speed [1/min]", low - room, high + room)
    } else {
        Axis::new("inner ring speed [1/min]", 0.0, 1.05 * fastest, 10)
    };
    let values = points().flat_map(|p| [p.mean, p.band[0], p.band[1]]).chain([0.0]);
    let y_axis = Axis::covering("whirl speed [rad/s]", values, 8);
    let place = Place { x: 100.0, y: 80.0, w: WIDTH, h: HEIGHT };
    let longest = series.iter().map(|s| text_width(&s.label, TEXT)).fold(120.0, f64::max);
    let width = 100.0 + WIDTH + 28.0 + 36.0 + longest;
    let subtitle = "Whirl speed of every case: mean, bar from the 5th to the 95th percentile; cases at one place are drawn beside each other";
    style::picture((width, 80.0 + HEIGHT + 70.0), title, subtitle, |canvas| {
        legend(canvas, series)?;
        panel(canvas, place, (&x_axis, &y_axis), true, &[], |panel| {
            panel.dashed([(x_axis.min, 0.0), (x_axis.max, 0.0)], line(MUTED, THIN))?;
            let places: Vec<_> = points().map(|p| panel.place((x(p.speed), p.mean))).collect();
            let mut shifts = beside(&places, MARKER).into_iter();
            for (k, s) in series.iter().enumerate() {
                panel.curve(s.points.iter().map(|p| (x(p.speed), p.mean)), line(look(k).1, CURVE))?;
                for (p, shift) in s.points.iter().zip(shifts.by_ref()) {
                    contents(panel, look(k), (p, x(p.speed)), px(shift))?;
                }
            }
            Ok(())
        })
    })
}

fn legend(canvas: &Canvas<'_>, series: &[Series<WhirlPoint>]) -> Drawn {
    let x = 100.0 + WIDTH + 28.0;
    for (k, s) in series.iter().enumerate() {
        let (shape, color) = look(k);
        style::legend_entry(canvas, (x, 96.0 + 26.0 * k as f64), Symbol::MarkedLine(shape, color), &s.label)?;
    }
    let y = 96.0 + 26.0 * series.len() as f64;
    style::legend_entry(canvas, (x, y), Symbol::Marker(Marker::Ring, INK), "no whirl")
}

/// The bar and the marker of a point, so far to the right of its place on the surface.
fn contents(
    panel: &Panel<'_, '_, '_>,
    (shape, color): (Marker, Paint),
    (p, x): (&WhirlPoint, f64),
    shift: i32,
) -> Drawn {
    let place = |speed: f64| {
        let (x, y) = panel.place((x, speed));
        (x + shift, y)
    };
    let [low, high] = p.band.map(place);
    let stroke = |from, to| panel.canvas().draw(&PathElement::new(vec![from, to], line(color, THIN)));
    stroke(low, high)?;
    for (x, y) in [low, high] {
        stroke((x - px(BAR_END), y), (x + px(BAR_END), y))?;
    }
    let shape = if p.whirls { shape } else { Marker::Ring };
    style::marker(panel.canvas(), shape, place(p.mean), MARKER, color)
}
