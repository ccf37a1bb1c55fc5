//! Mean cage centres of all cases in the circle of the guide clearance (compare Fig. 9).

use super::axis::Axis;
use super::labels::Room;
use super::panel::{Panel, Place, panel};
use super::style::{self, BLUE, CURVE, Canvas, Drawn, INK, MUTED, Symbol, TEXT, THIN, line, px, text_width};
use super::{Series, look};
use cagedyn::Result;
use plotters::prelude::{Circle, PathElement};
use plotters::style::text_anchor::HPos;
use std::f64::consts::TAU;

/// Side of the diagram, px.
const SIDE: f64 = 600.0;
/// Size of the markers and of the labels of the points, px.
const MARKER: f64 = 5.0;
const LABEL: f64 = 11.0;
/// Half the side of the diagram if it shows the whole circle.
const WHOLE: f64 = 1.1;
/// The part with all points is shown alone if it is at most this share of that, with this much room around the points.
const PART: f64 = 0.75;
const ROOM: f64 = 1.25;
/// Radius of the circle that then shows which part it is, px.
const OVERVIEW: f64 = 62.0;

/// Mean cage centre of a case.
pub struct Point {
    /// Speed of the inner ring in 1/min.
    pub speed: f64,
    /// Cage centre over the guide clearance.
    pub centre: (f64, f64),
    /// Fifth and 95th percentile of both of its coordinates.
    pub bands: [[f64; 2]; 2],
}

impl Point {
    /// Ends of the bars of its scatter.
    fn bars(&self) -> [[(f64, f64); 2]; 2] {
        let ((y, z), [across, up]) = (self.centre, self.bands);
        [across.map(|y| (y, z)), up.map(|z| (y, z))]
    }
}

/// The square that is shown: its centre and half its side.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Square {
    centre: (f64, f64),
    half: f64,
}

impl Square {
    /// The whole circle, or a part of it where all points are close together.
    fn around(points: &[(f64, f64)]) -> Self {
        let whole = Self { centre: (0.0, 0.0), half: WHOLE };
        let span = |of: fn(&(f64, f64)) -> f64| {
            let (low, high) = points
                .iter()
                .map(of)
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
            (0.5 * (low + high), 0.5 * (high - low))
        };
        let ((y, half_y), (z, half_z)) = (span(|p| p.0), span(|p| p.1));
        // Of one point a tenth of the clearance.
        let half = ROOM * half_y.max(half_z).max(0.04);
        if (y + z).is_finite() && half <= PART * WHOLE { Self { centre: (y, z), half } } else { whole }
    }

    fn is_part(&self) -> bool {
        self.half < WHOLE
    }

    fn contains(&self, (y, z): (f64, f64)) -> bool {
        (y - self.centre.0).abs() <= self.half && (z - self.centre.1).abs() <= self.half
    }

    fn axis(&self, name: &str, centre: f64) -> Axis {
        Axis::new(name, centre - self.half, centre + self.half, 5)
    }
}

/// The picture.
///
/// # Errors
/// [`cagedyn::Status::File`] when it cannot be drawn.
pub fn cage_positions(title: &str, series: &[Series<Point>]) -> Result<String> {
    let points: Vec<_> = series.iter().flat_map(|s| &s.points).flat_map(|p| p.bars().concat()).collect();
    let shown = Square::around(&points);
    let x_axis = shown.axis("mean cage centre y / radial guide clearance [1]", shown.centre.0);
    let y_axis = shown.axis("mean cage centre z / radial guide clearance [1]", shown.centre.1);
    let place = Place { x: 100.0, y: 80.0, w: SIDE, h: SIDE };
    let longest = series.iter().map(|s| text_width(&s.label, TEXT)).fold(150.0, f64::max);
    let width = 100.0 + SIDE + 28.0 + 36.0 + longest;
    let subtitle = "Mean cage centre of every case, bars from the 5th to the 95th percentile; numbers: inner ring speed in 1/min";
    style::picture((width, 80.0 + SIDE + 70.0), title, subtitle, |canvas| {
        legend(canvas, series, &shown)?;
        panel(canvas, place, (&x_axis, &y_axis), true, &[], |panel| {
            let inside = |point: (f64, f64)| if shown.contains(point) { point } else { (f64::NAN, f64::NAN) };
            let circle: Vec<_> = (0..=720)
                .map(|i| f64::from(i) * TAU / 720.0)
                .map(|angle| inside((angle.cos(), angle.sin())))
                .collect();
            panel.curve(circle.iter().copied(), line(INK, CURVE))?;
            let clamped = |x: f64, centre: f64| x.clamp(centre - shown.half, centre + shown.half);
            let [left, right] = [-1.0, 1.0].map(|y| (clamped(y, shown.centre.0), 0.0));
            let [low, high] = [-1.0, 1.0].map(|z| (0.0, clamped(z, shown.centre.1)));
            for ends in [[left, right], [low, high]] {
                if ends.iter().all(|end| shown.contains(*end)) {
                    panel.dashed(ends, line(MUTED, 0.5))?;
                }
            }
            contents(panel, series, &circle)
        })
    })
}

fn legend(canvas: &Canvas<'_>, series: &[Series<Point>], shown: &Square) -> Drawn {
    let x = 100.0 + SIDE + 28.0;
    for (k, s) in series.iter().enumerate() {
        let (shape, color) = look(k);
        style::legend_entry(canvas, (x, 96.0 + 26.0 * k as f64), Symbol::MarkedLine(shape, color), &s.label)?;
    }
    let y = 96.0 + 26.0 * series.len() as f64;
    style::legend_entry(canvas, (x, y), Symbol::Line(INK), "guide clearance")?;
    if shown.is_part() {
        overview(canvas, (x + WHOLE * OVERVIEW, y + 40.0 + WHOLE * OVERVIEW), shown)?;
    }
    Ok(())
}

/// The whole circle about a place in px, with the part of it that the diagram shows.
fn overview(canvas: &Canvas<'_>, centre: (f64, f64), shown: &Square) -> Drawn {
    let at = |y: f64, z: f64| (px(centre.0 + OVERVIEW * y), px(centre.1 - OVERVIEW * z));
    canvas.draw(&Circle::new(at(0.0, 0.0), px(OVERVIEW), line(INK, CURVE)))?;
    let (y, z) = shown.centre;
    let signs = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)];
    let edge = signs.map(|(a, b)| at(y + a * shown.half, z + b * shown.half));
    canvas.draw(&PathElement::new(edge.to_vec(), line(BLUE, CURVE)))?;
    let below = (at(0.0, 0.0).0, px(centre.1 + WHOLE * OVERVIEW + 24.0));
    style::label(canvas, "part that is shown", below, (TEXT - 1.0, MUTED), HPos::Center)
}

fn contents(panel: &mut Panel<'_, '_, '_>, series: &[Series<Point>], circle: &[(f64, f64)]) -> Drawn {
    let mut room = Room::new(LABEL, MARKER);
    for arc in circle.split(|(y, _)| y.is_nan()) {
        room.line(&arc.iter().map(|point| panel.place(*point)).collect::<Vec<_>>(), CURVE);
    }
    for (k, s) in series.iter().enumerate() {
        panel.curve(s.points.iter().map(|p| p.centre), line(look(k).1, CURVE))?;
        room.add(&s.points.iter().map(|p| panel.place(p.centre)).collect::<Vec<_>>());
        for ends in s.points.iter().flat_map(Point::bars) {
            let ends = ends.map(|end| panel.place(end));
            style::bar(panel.canvas(), ends, look(k).1)?;
            room.line(&ends, THIN);
        }
    }
    let points = || series.iter().enumerate().flat_map(|(k, s)| s.points.iter().map(move |p| (look(k), p)));
    let labels: Vec<_> = points()
        .map(|((_, color), point)| {
            let (at, label) = (panel.place(point.centre), format!("{:.0}", point.speed));
            (at, room.take(at, &label), label, color)
        })
        .collect();
    for (at, frame, ..) in &labels {
        room.leader(panel.canvas(), *at, frame)?;
    }
    for ((shape, color), point) in points() {
        style::marker(panel.canvas(), shape, panel.place(point.centre), MARKER, color)?;
    }
    for (_, frame, label, color) in labels {
        style::label(panel.canvas(), &label, frame.centre, (LABEL, color), HPos::Center)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_that_are_close_together_are_shown_larger() {
        let part = Square::around(&[(-0.74, -0.23), (-0.53, 0.51)]);
        assert!(part.is_part() && part.contains((-0.74, -0.23)) && part.contains((-0.53, 0.51)));
        assert!((part.half - 0.4625).abs() < 1e-9);
        assert_eq!(Square::around(&[(-0.9, -0.9), (0.9, 0.9)]), Square { centre: (0.0, 0.0), half: WHOLE });
        assert!(!Square::around(&[]).is_part());
        assert!(Square::around(&[(0.3, 0.3)]).half > 0.03);
    }
}
