//! Orbit of the cage centre in the circle of the guide clearance (compare Fig. 4).

use super::axis::{Axis, minus};
use super::panel::{Place, panel};
use super::style::{self, BLUE, CURVE, FAINT, GREEN, INK, MUTED, Marker, PURPLE, RED, Symbol, THIN, line};
use crate::results::finished::Run;
use crate::results::summary::Summary;
use cagedyn::Result;

/// Diameter of the diagram, px.
const SIDE: f64 = 560.0;

/// The picture, if the cage is guided.
pub fn cage_orbit(run: &Run, summary: &Summary) -> Option<Result<String>> {
    let (y, z) = (run.column("cage.y_ratio")?, run.column("cage.z_ratio")?);
    let mean = (summary.of("cage.y_ratio")?.spread.mean, summary.of("cage.z_ratio")?.spread.mean);
    let points: Vec<(f64, f64)> = y.iter().copied().zip(z.iter().copied()).collect();
    let from = run.recording.index_at(run.window_start());
    let whirl = summary.whirl.as_ref().filter(|whirl| whirl.motion.is_whirl());
    let way = whirl.and_then(|whirl| whirl.mean_speed_rad_per_s).map(f64::signum);
    Some(draw(run, &points, from, (mean, way)))
}

/// `from` is the first point of the averaging window, `way` that of a whirl: 1 counter-clockwise, -1 clockwise.
fn draw(
    run: &Run,
    points: &[(f64, f64)],
    from: usize,
    (mean, way): ((f64, f64), Option<f64>),
) -> Result<String> {
    // A cage with lobes can move beyond the mean clearance.
    let reach = points.iter().fold(1.1, |r: f64, p| r.max(1.05 * p.0.abs()).max(1.05 * p.1.abs()));
    let x_axis =
        Axis::new("cage centre y from that of the guide / radial guide clearance [1]", -reach, reach, 5);
    let y_axis =
        Axis::new("cage centre z from that of the guide / radial guide clearance [1]", -reach, reach, 5);
    let place = Place { x: 100.0, y: 122.0, w: SIDE, h: SIDE };
    style::picture((690.0, 750.0), &run.title, &run.subtitle("Orbit of the cage centre"), |canvas| {
        let mean_text = format!("mean ({:.3}, {:.3})", mean.0, mean.1);
        let first = [
            (Symbol::Line(BLUE), "averaging window".to_owned()),
            (Symbol::Line(FAINT), "before it".to_owned()),
            (Symbol::Line(INK), "guide clearance".to_owned()),
        ];
        let second = [
            (Symbol::Marker(Marker::Ring, GREEN), "start".to_owned()),
            (Symbol::Marker(Marker::Cross, RED), minus_signs(&mean_text)),
        ];
        let turning = way.map(|way| {
            let sense = if way > 0.0 { "whirls counter-clockwise" } else { "whirls clockwise" };
            (Symbol::Line(PURPLE), sense.to_owned())
        });
        let second: Vec<_> = second.into_iter().chain(turning).collect();
        style::legend_row(canvas, 76.0, &first)?;
        style::legend_row(canvas, 100.0, &second)?;
        panel(canvas, place, (&x_axis, &y_axis), true, &[], |panel| {
            panel.circle(1.0, line(INK, CURVE))?;
            panel.dashed([(-1.0, 0.0), (1.0, 0.0)], line(MUTED, 0.5))?;
            panel.dashed([(0.0, -1.0), (0.0, 1.0)], line(MUTED, 0.5))?;
            panel.curve(points.iter().take(from + 1).copied(), line(FAINT, THIN))?;
            panel.curve(points.iter().skip(from).copied(), line(BLUE, CURVE))?;
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

/// The text with typographic minus signs.
fn minus_signs(text: &str) -> String {
    text.replace('-', &minus("-1").replace('1', ""))
}
