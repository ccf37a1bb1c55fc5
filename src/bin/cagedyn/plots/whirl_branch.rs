//! A branch of steady whirls: speed and place of the cage over what is varied, stable and unstable, with what happens on the way.

use super::axis::Axis;
use super::panel::{Panel, Place, panel};
use super::style::{
    self, BLUE, CURVE, Canvas, Drawn, INK, MUTED, Marker, ORANGE, Paint, RED, Symbol, THIN, line,
};
use super::sweep::Abscissa;
use cagedyn::Result;
use cagedyn::whirl::{Branch, End, Point};

/// Size of each diagram and its place, px.
const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 190.0;
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
    let x = Abscissa::of_path(path, false, &points.iter().map(|point| point.parameter).collect::<Vec<_>>());
    let x_axis = x.covering(10);
    let subtitle = format!(
        "Steady whirl over {path}, without gravity; the branch ends {}",
        match branch.end {
            End::Range => "with the range",
            End::Length => "after as many points as it may have",
            End::Lost(_) => "where no whirl is found further on",
            End::Stopped(_) => "where the search was stopped",
        }
    );
    let rows: [(&str, Value); 3] = [
        ("whirl speed [rad/s]", |point| point.whirl.speed),
        ("eccentricity [\u{b5}m]", |point| 1e6 * point.whirl.eccentricity),
        ("largest growth rate [1/s]", |point| {
            point.whirl.eigenvalues.first().map_or(f64::NAN, |value| value[0])
        }),
    ];
    let height = TOP + 3.0 * HEIGHT + 2.0 * GAP + 70.0;
    style::picture((LEFT + WIDTH + 200.0, height), title, &subtitle, |canvas| {
        legend(canvas, points)?;
        for (k, (name, value)) in rows.into_iter().enumerate() {
            let y_axis = Axis::covering(name, points.iter().map(value), 6);
            let place = Place { x: LEFT, y: TOP + k as f64 * (HEIGHT + GAP), w: WIDTH, h: HEIGHT };
            panel(canvas, place, (&x_axis, &y_axis), k == 2, &[], |panel| {
                contents(panel, (points, &x), value)
            })?;
        }
        Ok(())
    })
}

fn legend(canvas: &Canvas<'_>, points: &[Point]) -> Drawn {
    type Is = fn(&Point) -> bool;
    let entries: [(Marker, Paint, &str, Is); 5] = [
        (Marker::Disc, BLUE, "stable", |point| point.whirl.stable()),
        (Marker::Ring, ORANGE, "unstable", |point| !point.whirl.stable()),
        (Marker::Diamond, RED, "fold", |point| point.fold),
        (Marker::Triangle, INK, "Hopf point", |point| point.hopf),
        (Marker::Square, INK, "wet arcs change", |point| point.grazed),
    ];
    let there = entries.into_iter().filter(|(.., is)| points.iter().any(is));
    for (k, (shape, color, name, _)) in there.enumerate() {
        let at = (LEFT + WIDTH + 28.0, TOP + 16.0 + 26.0 * k as f64);
        style::legend_entry(canvas, at, Symbol::Marker(shape, color), name)?;
    }
    Ok(())
}

fn contents(panel: &mut Panel<'_, '_, '_>, (points, x): (&[Point], &Abscissa), value: Value) -> Drawn {
    let place = |point: &Point| (x.place(point.parameter), value(point));
    // Between branches there is no line.
    for pair in points.windows(2).filter(|pair| !pair[1].grazed) {
        let stable = pair.iter().all(|point| point.whirl.stable());
        let style = if stable { line(BLUE, CURVE) } else { line(MUTED, THIN) };
        panel.curve(pair.iter().map(place), style)?;
    }
    let mark = |point: &Point, shape: Marker, size: f64, color: Paint| {
        style::marker(panel.canvas(), shape, panel.place(place(point)), size, color)
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
        if point.grazed {
            mark(point, Marker::Square, MARK, INK)?;
        }
    }
    Ok(())
}
