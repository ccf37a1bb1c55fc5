//! Mean cage centres of all cases in the circle of the guide clearance (compare Fig. 9).

use super::axis::Axis;
use super::panel::{Panel, Place, panel};
use super::style::{self, CURVE, Canvas, Drawn, INK, MUTED, Symbol, TEXT, line, px, text, text_width};
use super::{Series, look};
use cagedyn::Result;
use plotters::prelude::Text;
use plotters::style::text_anchor::{HPos, VPos};

/// Side of the diagram, px.
const SIDE: f64 = 600.0;
/// Size of the markers and of the labels of the points, px.
const MARKER: f64 = 5.0;
const LABEL: f64 = 11.0;

/// Mean cage centre of a case.
pub struct Point {
    /// Speed of the inner ring in 1/min.
    pub speed: f64,
    /// Cage centre over the guide clearance.
    pub centre: (f64, f64),
}

/// The picture.
///
/// # Errors
/// [`cagedyn::Status::File`] when it cannot be drawn.
pub fn cage_positions(title: &str, series: &[Series<Point>]) -> Result<String> {
    let x_axis = Axis::new("mean cage centre y / radial guide clearance [1]", -1.1, 1.1, 5);
    let y_axis = Axis::new("mean cage centre z / radial guide clearance [1]", -1.1, 1.1, 5);
    let place = Place { x: 100.0, y: 80.0, w: SIDE, h: SIDE };
    let longest = series.iter().map(|s| text_width(&s.label, TEXT)).fold(150.0, f64::max);
    let width = 100.0 + SIDE + 28.0 + 36.0 + longest;
    let subtitle = "Mean cage centre of every case; numbers: inner ring speed in 1/min";
    style::picture((width, 80.0 + SIDE + 70.0), title, subtitle, |canvas| {
        legend(canvas, series)?;
        panel(canvas, place, (&x_axis, &y_axis), true, &[], |panel| {
            panel.circle(1.0, line(INK, CURVE))?;
            panel.dashed([(-1.0, 0.0), (1.0, 0.0)], line(MUTED, 0.5))?;
            panel.dashed([(0.0, -1.0), (0.0, 1.0)], line(MUTED, 0.5))?;
            contents(panel, series)
        })
    })
}

fn legend(canvas: &Canvas<'_>, series: &[Series<Point>]) -> Drawn {
    let x = 100.0 + SIDE + 28.0;
    for (k, s) in series.iter().enumerate() {
        let (shape, color) = look(k);
        style::legend_entry(canvas, (x, 96.0 + 26.0 * k as f64), Symbol::MarkedLine(shape, color), &s.label)?;
    }
    let y = 96.0 + 26.0 * series.len() as f64;
    style::legend_entry(canvas, (x, y), Symbol::Line(INK), "guide clearance")
}

fn contents(panel: &mut Panel<'_, '_, '_>, series: &[Series<Point>]) -> Drawn {
    let mut room = Room::default();
    for (k, s) in series.iter().enumerate() {
        panel.curve(s.points.iter().map(|p| p.centre), line(look(k).1, CURVE))?;
        let places: Vec<_> = s.points.iter().map(|p| panel.place(p.centre)).collect();
        room.lines.extend(places.windows(2).flat_map(|ends| along(ends[0], ends[1])));
        room.markers.extend(places);
    }
    for (k, s) in series.iter().enumerate() {
        let (shape, color) = look(k);
        for point in &s.points {
            style::marker(panel.canvas(), shape, panel.place(point.centre), MARKER, color)?;
        }
    }
    for (k, s) in series.iter().enumerate() {
        for point in &s.points {
            let label = format!("{:.0}", point.speed);
            let frame = room.take(panel.place(point.centre), &label);
            draw_label(panel.canvas(), &label, frame.centre, look(k).1)?;
        }
    }
    Ok(())
}

/// Text with a white edge, to be readable on lines.
fn draw_label(canvas: &Canvas<'_>, label: &str, at: (i32, i32), color: style::Paint) -> Drawn {
    const EDGE: f64 = 1.2;
    let draw = |(dx, dy): (f64, f64), color| {
        let style = text(LABEL, color, HPos::Center, VPos::Center);
        canvas.draw(&Text::new(label.to_owned(), (at.0 + px(EDGE * dx), at.1 + px(EDGE * dy)), style))
    };
    for shift in
        [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0), (0.7, 0.7), (0.7, -0.7), (-0.7, 0.7), (-0.7, -0.7)]
    {
        draw(shift, style::PAPER)?;
    }
    draw((0.0, 0.0), color)
}

/// A rectangle on the surface.
#[derive(Clone, Copy)]
struct Frame {
    centre: (i32, i32),
    half: (i32, i32),
}

impl Frame {
    /// Of a width and a height in px.
    fn around(centre: (i32, i32), width: f64, height: f64) -> Self {
        Self { centre, half: (px(0.5 * width), px(0.5 * height)) }
    }

    /// Area shared with another one.
    fn overlap(&self, other: &Self) -> i64 {
        let shared = |distance: i32, a: i32, b: i32| i64::from((a + b - distance).clamp(0, 2 * a.min(b)));
        shared((self.centre.0 - other.centre.0).abs(), self.half.0, other.half.0)
            * shared((self.centre.1 - other.centre.1).abs(), self.half.1, other.half.1)
    }

    /// Distance of a point from the rectangle.
    fn distance(&self, point: (i32, i32)) -> i64 {
        let outside = |a: i32, b: i32, half: i32| i64::from(((a - b).abs() - half).max(0));
        let (x, y) =
            (outside(point.0, self.centre.0, self.half.0), outside(point.1, self.centre.1, self.half.1));
        (x * x + y * y).isqrt()
    }
}

/// Small frames along a line from `a` to `b`, so that labels keep off it.
fn along(a: (i32, i32), b: (i32, i32)) -> impl Iterator<Item = Frame> {
    const PITCH: f64 = 3.0;
    let (dx, dy) = (f64::from(b.0 - a.0), f64::from(b.1 - a.1));
    let count = (dx.hypot(dy) / f64::from(px(PITCH))).ceil().max(1.0);
    (0..=count as u32).map(move |i| {
        let share = f64::from(i) / count;
        let at = (a.0 + (share * dx).round() as i32, a.1 + (share * dy).round() as i32);
        Frame::around(at, PITCH, PITCH)
    })
}

/// What labels should keep off.
#[derive(Default)]
struct Room {
    markers: Vec<(i32, i32)>,
    lines: Vec<Frame>,
    labels: Vec<Frame>,
}

impl Room {
    /// Takes the best place for the label of a point: off other labels and markers, then near, then off lines.
    fn take(&mut self, point: (i32, i32), label: &str) -> Frame {
        let (w, h) = (text_width(label, LABEL) + 2.0, LABEL + 1.0);
        let (dx, dy) = (0.5 * w + MARKER + 2.0, 0.5 * h + MARKER + 2.0);
        let around = [
            (1.0, 0.0),
            (-1.0, 0.0),
            (0.0, -1.0),
            (0.0, 1.0),
            (0.9, -0.8),
            (0.9, 0.8),
            (-0.9, -0.8),
            (-0.9, 0.8),
        ];
        let far = [1.0, 1.6].into_iter();
        let places = far.flat_map(|far| around.map(|(u, v)| (far * u * dx, far * v * dy, far > 1.0)));
        let candidates = places.map(|(u, v, far)| {
            let frame = Frame::around((point.0 + px(u), point.1 + px(v)), w, h);
            (self.cost(&frame, point, far), frame)
        });
        let best = candidates.min_by_key(|(cost, _)| *cost).map(|(_, frame)| frame);
        let frame = best.unwrap_or(Frame::around(point, w, h));
        self.labels.push(frame);
        frame
    }

    /// How bad a place is, in areas of overlap.
    fn cost(&self, frame: &Frame, own: (i32, i32), far: bool) -> i64 {
        let marker = |at: &(i32, i32)| Frame::around(*at, 2.0 * MARKER, 2.0 * MARKER);
        let solid: i64 = self.markers.iter().map(|at| frame.overlap(&marker(at))).sum::<i64>()
            + self.labels.iter().map(|other| frame.overlap(other)).sum::<i64>();
        let lines: i64 = self.lines.iter().map(|other| frame.overlap(other)).sum();
        // A label nearer to the marker of another point would be read as belonging to it.
        let ambiguous = self.markers.iter().any(|at| frame.distance(*at) < frame.distance(own));
        let area = 4 * i64::from(frame.half.0) * i64::from(frame.half.1);
        20 * solid + lines + area * (i64::from(far) + i64::from(ambiguous))
    }
}
