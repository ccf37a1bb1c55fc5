//! Places of labels beside their points: off markers, off each other and off curves.

use super::style::{Canvas, Drawn, MUTED, THIN, line, px, text_width};
use plotters::prelude::PathElement;
use std::f64::consts::TAU;

/// Distances of a label from its marker that are tried, in units of the nearest, and directions at each.
const DISTANCES: [f64; 5] = [1.0, 1.35, 1.8, 2.5, 3.4];
const DIRECTIONS: usize = 16;
/// Weights of the areas that a label covers: of other labels and markers, and of curves. A step of distance weighs as the label itself.
const SOLID: i64 = 1000;
const CURVES: i64 = 200;

/// Width that a curve has at least for labels, px of the picture.
const THINNEST: f64 = 3.0;

/// What labels keep off; lengths are px of the surface unless said otherwise.
pub struct Room {
    /// Size of the text and of the markers, px of the picture.
    size: f64,
    marker: f64,
    markers: Vec<(i32, i32)>,
    lines: Vec<Frame>,
    labels: Vec<Frame>,
    /// Corners that labels stay within, if any.
    within: Option<[(i32, i32); 2]>,
}

/// A rectangle on the surface.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// Its centre.
    pub centre: (i32, i32),
    half: (i32, i32),
}

impl Frame {
    /// Of a width and a height in px.
    fn around(centre: (i32, i32), width: f64, height: f64) -> Self {
        Self { centre, half: (px(0.5 * width), px(0.5 * height)) }
    }

    fn area(&self) -> i64 {
        4 * i64::from(self.half.0) * i64::from(self.half.1)
    }

    /// Corners on the surface.
    pub fn corners(&self) -> [(i32, i32); 2] {
        let ((x, y), (w, h)) = (self.centre, self.half);
        [(x - w, y - h), (x + w, y + h)]
    }

    /// Area shared with another one.
    fn overlap(&self, other: &Self) -> i64 {
        let shared = |distance: i32, a: i32, b: i32| i64::from((a + b - distance).clamp(0, 2 * a.min(b)));
        shared((self.centre.0 - other.centre.0).abs(), self.half.0, other.half.0)
            * shared((self.centre.1 - other.centre.1).abs(), self.half.1, other.half.1)
    }

    /// The nearest point of the rectangle.
    fn nearest(&self, point: (i32, i32)) -> (i32, i32) {
        let inside = |x: i32, centre: i32, half: i32| x.clamp(centre - half, centre + half);
        (inside(point.0, self.centre.0, self.half.0), inside(point.1, self.centre.1, self.half.1))
    }

    /// Distance of a point from the rectangle.
    fn distance(&self, point: (i32, i32)) -> i64 {
        let (x, y) = self.nearest(point);
        let (dx, dy) = (i64::from(point.0 - x), i64::from(point.1 - y));
        (dx * dx + dy * dy).isqrt()
    }
}

/// Frames along a line of a width from `a` to `b`.
fn along(a: (i32, i32), b: (i32, i32), width: f64) -> impl Iterator<Item = Frame> {
    let (dx, dy) = (f64::from(b.0 - a.0), f64::from(b.1 - a.1));
    let count = (dx.hypot(dy) / f64::from(px(width))).ceil().max(1.0);
    (0..=count as u32).map(move |i| {
        let share = f64::from(i) / count;
        let at = (a.0 + (share * dx).round() as i32, a.1 + (share * dy).round() as i32);
        Frame::around(at, width, width)
    })
}

impl Room {
    /// For labels and markers of these sizes, px of the picture.
    pub fn new(size: f64, marker: f64) -> Self {
        Self { size, marker, markers: Vec::new(), lines: Vec::new(), labels: Vec::new(), within: None }
    }

    /// The same with labels within these corners only.
    pub fn within(self, corners: [(i32, i32); 2]) -> Self {
        Self { within: Some(corners), ..self }
    }

    /// Adds the markers of a curve, and the curve.
    pub fn add(&mut self, places: &[(i32, i32)]) {
        self.line(places, THINNEST);
        self.markers.extend(places);
    }

    /// Adds a curve of a width in px of the picture without markers.
    pub fn line(&mut self, places: &[(i32, i32)], width: f64) {
        let width = width.max(THINNEST);
        self.lines.extend(places.windows(2).flat_map(|ends| along(ends[0], ends[1], width)));
    }

    /// Takes the best place for the label of a point: off other labels and markers, then off curves, then near.
    pub fn take(&mut self, point: (i32, i32), label: &str) -> Frame {
        let (w, h) = (text_width(label, self.size) + 2.0, self.size + 1.0);
        let (dx, dy) = (0.5 * w + self.marker + 2.0, 0.5 * h + self.marker + 2.0);
        let candidates = DISTANCES.into_iter().enumerate().flat_map(|(far, distance)| {
            (0..DIRECTIONS).map(move |k| {
                let angle = TAU * k as f64 / DIRECTIONS as f64;
                // On the edge of a rectangle about the marker, so that the label touches it nowhere.
                let (u, v) = (angle.cos(), -angle.sin());
                let edge = 1.0 / (u.abs()).max(v.abs());
                let at = (point.0 + px(distance * edge * u * dx), point.1 + px(distance * edge * v * dy));
                (far, Frame::around(at, w, h))
            })
        });
        let best = candidates.min_by_key(|(far, frame)| self.cost(frame, point, *far));
        let frame = best.map_or(Frame::around(point, w, h), |(_, frame)| frame);
        self.labels.push(frame);
        frame
    }

    /// Takes the best place for the label of a line, on it: off other labels and markers, then off other lines, then near the share
    /// `wanted` of its way.
    pub fn slide(&mut self, (from, to): ((i32, i32), (i32, i32)), wanted: f64, label: &str) -> Frame {
        const STEPS: i32 = 40;
        let (w, h) = (text_width(label, self.size) + 2.0, self.size + 4.0);
        let on = |a: i32, b: i32, share: f64| a + (share * f64::from(b - a)).round() as i32;
        let candidates = (0..=STEPS).map(|k| {
            let share = f64::from(k) / f64::from(STEPS);
            let frame = Frame::around((on(from.0, to.0, share), on(from.1, to.1, share)), w, h);
            let (solid, lines) = self.covered(&frame);
            (
                SOLID * solid + CURVES * lines + (frame.area() as f64 * 8.0 * (share - wanted).abs()) as i64,
                frame,
            )
        });
        let best = candidates.min_by_key(|(cost, _)| *cost);
        let frame = best.map_or(Frame::around(from, w, h), |(_, frame)| frame);
        self.labels.push(frame);
        frame
    }

    /// Draws a thin line from a point to its label where that is not right beside it.
    pub fn leader(&self, canvas: &Canvas<'_>, point: (i32, i32), frame: &Frame) -> Drawn {
        if frame.distance(point) < i64::from(px(2.0 * self.marker + 2.0)) {
            return Ok(());
        }
        canvas.draw(&PathElement::new(vec![point, frame.nearest(point)], line(MUTED, 0.6 * THIN)))
    }

    fn marker_at(&self, at: (i32, i32)) -> Frame {
        Frame::around(at, 2.0 * self.marker, 2.0 * self.marker)
    }

    /// How bad a place is, in areas of overlap.
    fn cost(&self, frame: &Frame, own: (i32, i32), far: usize) -> i64 {
        let (solid, lines) = self.covered(frame);
        let outside = self.within.is_some_and(|[(left, top), (right, bottom)]| {
            let [(x0, y0), (x1, y1)] = frame.corners();
            x0 < left || y0 < top || x1 > right || y1 > bottom
        });
        if outside {
            return i64::MAX;
        }
        // A label nearer to the marker of another point would be read as belonging to it.
        let ambiguous = self.markers.iter().any(|at| frame.distance(*at) < frame.distance(own));
        SOLID * solid + CURVES * lines + frame.area() * (far as i64 + 2 * i64::from(ambiguous))
    }

    /// Areas of markers and other labels under a frame, and of curves.
    fn covered(&self, frame: &Frame) -> (i64, i64) {
        let markers: i64 = self.markers.iter().map(|at| frame.overlap(&self.marker_at(*at))).sum();
        let labels: i64 = self.labels.iter().map(|other| frame.overlap(other)).sum();
        (markers + labels, self.lines.iter().map(|other| frame.overlap(other)).sum())
    }
}

/// Sizes of markers that are drawn in this order, so that those at one place lie in each other; px of the picture, while `places` are
/// on the surface.
pub fn nested(places: &[(i32, i32)], marker: f64) -> Vec<f64> {
    const RIM: f64 = 2.6;
    let near = |(a, b): (i32, i32), (x, y): (i32, i32)| (a - x).abs().max((b - y).abs()) < px(marker);
    let above = |k: usize| places[k + 1..].iter().filter(|other| near(places[k], **other)).count();
    (0..places.len()).map(|k| marker + RIM * above(k) as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Markers as close as those of the NU2310 at 980 N, and a curve that passes.
    #[test]
    fn labels_keep_off_markers_each_other_and_curves() {
        let at = |(x, y): (f64, f64)| (px(x), px(y));
        let series: [[(f64, f64); 3]; 3] = [
            [(104.0, 232.0), (108.0, 168.0), (101.0, 150.0)],
            [(101.0, 241.0), (98.0, 167.0), (99.0, 144.0)],
            [(117.0, 214.0), (132.0, 112.0), (136.0, 100.0)],
        ];
        let mut room = Room::new(11.0, 5.0);
        series.iter().for_each(|points| room.add(&points.map(at)));
        let frames: Vec<Frame> = series.iter().flatten().map(|point| room.take(at(*point), "5000")).collect();
        for (i, frame) in frames.iter().enumerate() {
            let mut others =
                Room { lines: room.lines.clone(), markers: room.markers.clone(), ..Room::new(11.0, 5.0) };
            others.labels = frames.iter().enumerate().filter(|(k, _)| *k != i).map(|(_, f)| *f).collect();
            assert_eq!(others.covered(frame), (0, 0), "label {i} at {frame:?}");
        }
    }

    #[test]
    fn markers_at_one_place_lie_in_each_other() {
        let places = [(0, 0), (px(100.0), 0), (0, px(1.0)), (0, px(20.0)), (0, 0)];
        let sizes = nested(&places, 4.5);
        assert_eq!((sizes[1], sizes[3], sizes[4]), (4.5, 4.5, 4.5));
        assert!(sizes[0] > sizes[2] && sizes[2] > sizes[4]);
    }
}
