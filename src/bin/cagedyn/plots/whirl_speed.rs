//! Whirl speed of all cases over the speed of the inner ring, and how many of their starts lead to a whirl.

use super::axis::Axis;
use super::labels::nested;
use super::panel::{Panel, Place, X_LABELS, panel};
use super::style::{self, CURVE, Canvas, Drawn, INK, MUTED, Marker, Symbol, TEXT, THIN, line, text_width};
use super::{Series, is_long, look};
use cagedyn::Result;

/// Place and size of the diagram, px.
const LEFT: f64 = 100.0;
const TOP: f64 = 80.0;
const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 440.0;
/// Height of the diagram of the starts, and its distance from the other, px.
const STARTS: f64 = 120.0;
const GAP: f64 = 16.0;
/// Size of the markers, px.
const MARKER: f64 = 4.5;

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
    /// Share of the starts from which it does, if others than the scene's own were tried.
    pub share: Option<f64>,
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
    let longest = series.iter().map(|s| text_width(&s.label, TEXT)).fold(160.0, f64::max);
    let starts = points().any(|p| p.share.is_some());
    let below = if starts { GAP + STARTS } else { 0.0 };
    let size = (LEFT + WIDTH + 28.0 + 36.0 + longest, TOP + HEIGHT + below + X_LABELS + 24.0);
    // A cage may have more than one motion at a speed, which a single start does not show.
    let subtitle = match starts {
        true => {
            "Whirl speed from the scene's own start: mean, bar from the 5th to the 95th percentile; below: starts that whirl"
        }
        false => {
            "Whirl speed of every case, from one start each: mean, bar from the 5th to the 95th percentile"
        }
    };
    style::picture(size, title, subtitle, |canvas| {
        legend(canvas, series)?;
        let place = Place { x: LEFT, y: TOP, w: WIDTH, h: HEIGHT };
        panel(canvas, place, (&x_axis, &y_axis), !starts, &[], |panel| {
            panel.dashed([(x_axis.min, 0.0), (x_axis.max, 0.0)], line(MUTED, THIN))?;
            contents(panel, series, |p| Some((x(p.speed), p.mean)), |p| p.band)
        })?;
        if !starts {
            return Ok(());
        }
        let y_axis = Axis::new("starts that whirl [%]", -8.0, 108.0, 4);
        let place = Place { y: TOP + HEIGHT + GAP, h: STARTS, ..place };
        panel(canvas, place, (&x_axis, &y_axis), true, &[], |panel| {
            let share = |p: &WhirlPoint| Some(100.0 * p.share?);
            contents(panel, series, |p| Some((x(p.speed), share(p)?)), |p| [share(p).unwrap_or(f64::NAN); 2])
        })
    })
}

fn legend(canvas: &Canvas<'_>, series: &[Series<WhirlPoint>]) -> Drawn {
    let x = LEFT + WIDTH + 28.0;
    for (k, s) in series.iter().enumerate() {
        let (shape, color) = look(k);
        style::legend_entry(canvas, (x, 96.0 + 26.0 * k as f64), Symbol::MarkedLine(shape, color), &s.label)?;
    }
    let y = 96.0 + 26.0 * series.len() as f64;
    style::legend_entry(canvas, (x, y), Symbol::Marker(Marker::Ring, INK), "no whirl from that start")
}

/// Curves, bars and markers of all series. Markers at one place lie in each other: beside each other they would stand at wrong speeds.
fn contents(
    panel: &mut Panel<'_, '_, '_>,
    series: &[Series<WhirlPoint>],
    at: impl Fn(&WhirlPoint) -> Option<(f64, f64)>,
    band: impl Fn(&WhirlPoint) -> [f64; 2],
) -> Drawn {
    for (k, s) in series.iter().enumerate() {
        let points = s.points.iter().map(|p| at(p).unwrap_or((f64::NAN, f64::NAN)));
        panel.curve(points, line(look(k).1, CURVE))?;
    }
    let shown = || {
        let points = series.iter().enumerate().flat_map(|(k, s)| s.points.iter().map(move |p| (k, p)));
        points.filter_map(|(k, p)| Some((k, p, at(p)?)))
    };
    let places: Vec<_> = shown().map(|(.., place)| panel.place(place)).collect();
    let sizes = nested(&places, MARKER);
    for (((k, p, (x, _)), place), size) in shown().zip(&places).zip(sizes) {
        let (shape, color) = look(k);
        style::bar(panel.canvas(), band(p).map(|y| panel.place((x, y))), color)?;
        let shape = if p.whirls { shape } else { Marker::Ring };
        style::marker(panel.canvas(), shape, *place, size, color)?;
    }
    Ok(())
}
