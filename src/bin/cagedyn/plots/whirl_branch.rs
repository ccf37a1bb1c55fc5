//! A branch of steady whirls: speed and place of the cage over what is varied, stable and unstable, with what happens on the way.

use super::axis::Axis;
use super::panel::{Panel, Place, panel};
use super::style::{
    self, BLUE, CURVE, Canvas, Drawn, INK, MUTED, Marker, ORANGE, Paint, RED, Symbol, THIN, line,
};
use cagedyn::Result;
use cagedyn::whirl::{Branch, Point};

/// Size of each diagram and its place, px.
const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 240.0;
const LEFT: f64 = 100.0;
const TOP: f64 = 80.0;
const GAP: f64 = 50.0;
/// Size of the markers, px.
const DOT: f64 = 2.6;
const MARK: f64 = 5.0;

/// What a diagram shows of a point.
type Value = fn(&Point) -> f64;

/// The picture.
///
/// # Errors
/// [`cagedyn::Status::File`] when it cannot be drawn.
pub fn draw(title: &str, path: &str, branch: &Branch) -> Result<String> {
    let points = &branch.points;
    let x_axis = Axis::covering(path, points.iter().map(|point| point.parameter), 10);
    let subtitle = format!(
        "Steady whirl without gravity, averaged over the passing elements; it ends at: {}",
        branch.end.name()
    );
    let rows: [(&str, Value); 2] = [
        ("whirl speed [rad/s]", |point| point.whirl.speed),
        ("eccentricity [um]", |point| 1e6 * point.whirl.eccentricity),
    ];
    let height = TOP + 2.0 * HEIGHT + GAP + 70.0;
    style::picture((LEFT + WIDTH + 200.0, height), title, &subtitle, |canvas| {
        legend(canvas)?;
        for (k, (name, value)) in rows.into_iter().enumerate() {
            let y_axis = Axis::covering(name, points.iter().map(value), 6);
            let place = Place { x: LEFT, y: TOP + k as f64 * (HEIGHT + GAP), w: WIDTH, h: HEIGHT };
            panel(canvas, place, (&x_axis, &y_axis), k == 1, &[], |panel| contents(panel, points, value))?;
        }
        Ok(())
    })
}

fn legend(canvas: &Canvas<'_>) -> Drawn {
    let entries = [
        (Marker::Disc, BLUE, "stable"),
        (Marker::Ring, ORANGE, "unstable"),
        (Marker::Diamond, RED, "fold"),
        (Marker::Triangle, INK, "Hopf point"),
    ];
    for (k, (shape, color, name)) in entries.into_iter().enumerate() {
        let at = (LEFT + WIDTH + 28.0, TOP + 16.0 + 26.0 * k as f64);
        style::legend_entry(canvas, at, Symbol::Marker(shape, color), name)?;
    }
    Ok(())
}

fn contents(panel: &mut Panel<'_, '_, '_>, points: &[Point], value: Value) -> Drawn {
    panel.curve(points.iter().map(|point| (point.parameter, value(point))), line(MUTED, THIN))?;
    for pair in points.windows(2).filter(|pair| pair.iter().all(|point| point.whirl.stable())) {
        panel.curve(pair.iter().map(|point| (point.parameter, value(point))), line(BLUE, CURVE))?;
    }
    let mark = |point: &Point, shape: Marker, size: f64, color: Paint| {
        style::marker(panel.canvas(), shape, panel.place((point.parameter, value(point))), size, color)
    };
    for point in points {
        let (shape, color) = if point.whirl.stable() { (Marker::Disc, BLUE) } else { (Marker::Ring, ORANGE) };
        mark(point, shape, DOT, color)?;
        if point.fold {
            mark(point, Marker::Diamond, MARK, RED)?;
        }
        if point.hopf {
            mark(point, Marker::Triangle, MARK, INK)?;
        }
    }
    Ok(())
}
