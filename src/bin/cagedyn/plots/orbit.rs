//! Orbit of the cage centre in the circle of the guide clearance (compare Fig. 4).

use super::axis::{Axis, minus};
use super::panel::{Place, Y_LABELS, panel};
use super::style::{
    self, BLUE, CURVE, Canvas, Drawn, FAINT, GREEN, INK, MUTED, Marker, PURPLE, RED, Symbol, TEXT, THIN,
    line, px,
};
use crate::results::finished::Run;
use crate::results::summary::Summary;
use cagedyn::Result;
use plotters::style::text_anchor::HPos;

/// Diameter of the diagram, px.
const SIDE: f64 = 560.0;
/// Side of the inset, px, and where it is.
const INSET: f64 = 330.0;
const BESIDE: Place = Place { x: 100.0 + SIDE + 24.0 + Y_LABELS, y: 122.0, w: INSET, h: INSET };
/// An orbit that fills less than this share of the diagram has an inset ...
const SMALL: f64 = 1.0 / 3.0;
/// ... unless it is smaller than this share of the clearance, where it is round-off.
const NONE: f64 = 1e-6;
/// Half the side of the inset in units of that of the orbit.
const AROUND: f64 = 1.15;

/// The picture, if the cage is guided.
pub fn cage_orbit(run: &Run, summary: &Summary) -> Option<Result<String>> {
    let (y, z) = (run.column("cage.y_ratio")?, run.column("cage.z_ratio")?);
    let mean = (summary.of("cage.y_ratio")?.spread.mean, summary.of("cage.z_ratio")?.spread.mean);
    let points: Vec<(f64, f64)> = y.iter().copied().zip(z.iter().copied()).collect();
    let from = run.recording.index_at(run.window_start());
    let whirl = summary.whirl.as_ref().filter(|whirl| whirl.motion.is_whirl());
    let way = whirl.and_then(|whirl| whirl.mean_speed_rad_per_s).map(f64::signum);
    Some(draw(run, &points, from, (mean, way), summary.few_turns()))
}

/// `from` is the first point of the averaging window, `way` that of a whirl: 1 counter-clockwise, -1 clockwise.
fn draw(
    run: &Run,
    points: &[(f64, f64)],
    from: usize,
    (mean, way): ((f64, f64), Option<f64>),
    few: Option<String>,
) -> Result<String> {
    // A cage with lobes can move beyond the mean clearance.
    let reach = points.iter().fold(1.1, |r: f64, p| r.max(1.05 * p.0.abs()).max(1.05 * p.1.abs()));
    let x_axis =
        Axis::new("cage centre y from that of the guide / radial guide clearance [1]", -reach, reach, 5);
    let y_axis =
        Axis::new("cage centre z from that of the guide / radial guide clearance [1]", -reach, reach, 5);
    let place = Place { x: 100.0, y: 122.0, w: SIDE, h: SIDE };
    let inset = Inset::of(&points[from.min(points.len())..], reach);
    let width = if inset.is_some() { BESIDE.x + INSET + 30.0 } else { 690.0 };
    style::picture((width, 750.0), &run.title, &run.subtitle("Orbit of the cage centre"), |canvas| {
        let few = few.map_or(String::new(), |few| format!(", {few}"));
        let [y, z] = [mean.0, mean.1].map(|x| minus(&format!("{x:.3}")));
        let first = [
            (Symbol::Line(BLUE), "averaging window".to_owned()),
            (Symbol::Line(FAINT), "before it".to_owned()),
            (Symbol::Line(INK), "guide clearance".to_owned()),
        ];
        let second = [
            (Symbol::Marker(Marker::Ring, GREEN), "start".to_owned()),
            (Symbol::Marker(Marker::Cross, RED), format!("mean ({y}, {z}){few}")),
        ];
        let turning = way.map(|way| {
            let sense = if way > 0.0 { "whirls counter-clockwise" } else { "whirls clockwise" };
            (Symbol::Line(PURPLE), sense.to_owned())
        });
        let second: Vec<_> = second.into_iter().chain(turning).collect();
        style::legend_row(canvas, 76.0, &first)?;
        style::legend_row(canvas, 100.0, &second)?;
        if let Some(inset) = &inset {
            inset.draw(canvas, points, from, mean)?;
        }
        panel(canvas, place, (&x_axis, &y_axis), true, &[], |panel| {
            panel.circle(1.0, line(INK, CURVE))?;
            panel.dashed([(-1.0, 0.0), (1.0, 0.0)], line(MUTED, 0.5))?;
            panel.dashed([(0.0, -1.0), (0.0, 1.0)], line(MUTED, 0.5))?;
            panel.curve(points.iter().take(from + 1).copied(), line(FAINT, THIN))?;
            panel.curve(points.iter().skip(from).copied(), line(BLUE, CURVE))?;
            if let Some(inset) = &inset {
                panel.curve(inset.edge(), line(BLUE, 0.6 * THIN))?;
            }
            if let Some(way) = way {
                panel.turning(0.5 * (1.0 + reach), way, (1.2 * reach, PURPLE))?;
            }
            if let Some(&start) = points.first() {
                style::marker(panel.canvas(), Marker::Ring, panel.place(start), 5.0, GREEN)?;
            }
            style::marker(panel.canvas(), Marker::Cross, panel.place(mean), 5.0, RED)
        })
    })
}

/// The part of the clearance with the orbit in the averaging window, at a scale of its own.
struct Inset {
    centre: (f64, f64),
    half: f64,
}

impl Inset {
    /// Of these points, if they fill little of a diagram that goes to `reach`.
    fn of(points: &[(f64, f64)], reach: f64) -> Option<Self> {
        let range = |of: fn(&(f64, f64)) -> f64| {
            points.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
        };
        let ((y0, y1), (z0, z1)) = (range(|p| p.0), range(|p| p.1));
        let half = 0.5 * (y1 - y0).max(z1 - z0);
        let shown = half > NONE && half < SMALL * reach;
        shown.then_some(Self { centre: (0.5 * (y0 + y1), 0.5 * (z0 + z1)), half: AROUND * half })
    }

    fn edge(&self) -> [(f64, f64); 5] {
        let ((y, z), half) = (self.centre, self.half);
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)]
            .map(|(a, b)| (y + a * half, z + b * half))
    }

    /// The point if it is inside, or a gap.
    fn inside(&self, (y, z): (f64, f64)) -> (f64, f64) {
        let off = (y - self.centre.0).abs().max((z - self.centre.1).abs());
        if off <= self.half { (y, z) } else { (f64::NAN, f64::NAN) }
    }

    fn draw(&self, canvas: &Canvas<'_>, points: &[(f64, f64)], from: usize, mean: (f64, f64)) -> Drawn {
        let axis = |name, centre| Axis::new(name, centre - self.half, centre + self.half, 4).narrow();
        let (x_axis, y_axis) =
            (axis("y / clearance [1]", self.centre.0), axis("z / clearance [1]", self.centre.1));
        let above = (px(BESIDE.x), px(BESIDE.y - 14.0));
        style::label(canvas, "the blue square at its own scale", above, (TEXT, INK), HPos::Left)?;
        panel(canvas, BESIDE, (&x_axis, &y_axis), true, &[], |panel| {
            // The part of the clearance that could pass here.
            let (angle, near) = (self.centre.1.atan2(self.centre.0), 3.0 * self.half);
            let arc = (-100..=100).map(|i| angle + near * f64::from(i) / 100.0);
            panel.curve(arc.map(|a| self.inside((a.cos(), a.sin()))), line(INK, CURVE))?;
            let inside = |points: &[(f64, f64)]| points.iter().map(|p| self.inside(*p)).collect::<Vec<_>>();
            panel.curve(inside(&points[..(from + 1).min(points.len())]), line(FAINT, THIN))?;
            panel.curve(inside(&points[from.min(points.len())..]), line(BLUE, CURVE))?;
            style::marker(panel.canvas(), Marker::Cross, panel.place(mean), 5.0, RED)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_orbits_have_an_inset_and_round_off_has_none() {
        let square = |half: f64| [(0.4 - half, 0.1), (0.4 + half, 0.1 + half)];
        let inset = Inset::of(&square(0.2), 1.1).expect("an inset");
        assert!((inset.half - 0.23).abs() < 1e-12 && (inset.centre.0 - 0.4).abs() < 1e-12);
        assert!(inset.edge().iter().all(|corner| corner.0 > 0.1 && corner.0 < 0.7));
        assert!(inset.inside((0.5, 0.1)).0 == 0.5 && inset.inside((0.9, 0.1)).0.is_nan());
        for half in [0.4, 1e-9, 0.0] {
            assert!(Inset::of(&square(half), 1.1).is_none(), "{half}");
        }
        assert!(Inset::of(&[], 1.1).is_none());
    }
}
