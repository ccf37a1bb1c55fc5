//! A cage in space: its orbit in three views with its tilt, and the gaps of its lands.

use super::axis::{Axis, minus};
use super::panel::{Place, panel};
use super::strips::{Strip, TIME, Texts, history};
use super::style::{self, BLUE, CURVE, FAINT, INK, MUTED, Marker, RED, SERIES, Symbol, THIN, line};
use crate::results::finished::Run;
use crate::results::summary::Summary;
use cagedyn::Result;

/// Side of a view, px, and distance from one to the next.
const SIDE: f64 = 330.0;
const NEXT: f64 = SIDE + 110.0;
/// Channels with their factor and unit.
const CENTRE: [(&str, f64, &str); 3] =
    [("cage.x", 1e6, "x [um]"), ("cage.y", 1e6, "y [um]"), ("cage.z", 1e6, "z [um]")];
const TILTS: [(&str, f64, &str); 2] =
    [("cage.tilt_y", 1e3, "tilt_y [mrad]"), ("cage.tilt_z", 1e3, "tilt_z [mrad]")];

/// The centre from the front, from the side and from above, and the way of the axis, if the cage moves in space.
pub fn cage_views(run: &Run, summary: &Summary) -> Option<Result<String>> {
    let column = |(name, factor, unit): (&str, f64, &'static str)| {
        Some((unit, run.column(name)?.iter().map(|x| factor * x).collect::<Vec<f64>>()))
    };
    let [x, y, z] = CENTRE.map(column);
    let (x, y, z) = (x?, y?, z?);
    let [a, b] = TILTS.map(column);
    let (a, b) = (a?, b?);
    let views =
        [("from the front", &y, &z), ("from the side", &x, &z), ("from above", &x, &y), ("tilt", &a, &b)];
    let from = run.recording.index_at(run.window_start());
    let subtitle = run.subtitle("Cage centre in three views, and rotation vector of its axis");
    let tilt = summary.of("cage.tilt").map(|tilt| 1e3 * tilt.spread.mean);
    Some(style::picture((2.0 * NEXT + 30.0, 130.0 + 2.0 * (SIDE + 70.0)), &run.title, &subtitle, |canvas| {
        let mut entries = vec![
            (Symbol::Line(BLUE), "averaging window".to_owned()),
            (Symbol::Line(FAINT), "before it".to_owned()),
            (Symbol::Marker(Marker::Cross, RED), "mean in the window".to_owned()),
        ];
        if let Some(tilt) = tilt {
            entries.push((Symbol::Line(INK), format!("mean tilt, {} mrad", minus(&format!("{tilt:.2}")))));
        }
        style::legend_row(canvas, 78.0, &entries)?;
        for (k, (name, across, up)) in views.into_iter().enumerate() {
            let (row, side) = ((k / 2) as f64, (k % 2) as f64);
            let place = Place { x: 90.0 + NEXT * side, y: 116.0 + (SIDE + 70.0) * row, w: SIDE, h: SIDE };
            let (reach, middle) = square(&across.1, &up.1, name == "tilt");
            let axis = |unit: &str, middle: f64| Axis::new(unit, middle - reach, middle + reach, 5);
            let (x_axis, y_axis) = (axis(&format!("{name}: {}", across.0), middle[0]), axis(up.0, middle[1]));
            panel(canvas, place, (&x_axis, &y_axis), true, &[], |panel| {
                let points: Vec<(f64, f64)> = across.1.iter().copied().zip(up.1.iter().copied()).collect();
                if let Some(tilt) = tilt.filter(|_| name == "tilt") {
                    panel.circle(tilt, line(INK, THIN))?;
                }
                panel.curve(points.iter().take(from + 1).copied(), line(FAINT, THIN))?;
                panel.curve(points.iter().skip(from).copied(), line(BLUE, CURVE))?;
                let counted = &points[from.min(points.len() - 1)..];
                let n = counted.len() as f64;
                let mean = counted.iter().fold((0.0, 0.0), |sum, p| (sum.0 + p.0 / n, sum.1 + p.1 / n));
                style::marker(panel.canvas(), Marker::Cross, panel.place(mean), 5.0, RED)
            })?;
        }
        Ok(())
    }))
}

/// Half the side of a square with all of these points, and its middle, which is the origin if `about_origin`.
fn square(across: &[f64], up: &[f64], about_origin: bool) -> (f64, [f64; 2]) {
    let range = |values: &[f64]| {
        values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(*x), b.max(*x)))
    };
    let ends = [range(across), range(up)];
    let middle = ends.map(|(low, high)| if about_origin { 0.0 } else { 0.5 * (low + high) });
    let reach = ends.iter().zip(middle).fold(0.0, |reach: f64, ((low, high), middle)| {
        reach.max((high - middle).abs()).max((low - middle).abs())
    });
    (1.08 * reach.max(1e-3), middle)
}

/// Smallest gap of every land and the tilt over time, if the cage has lands and moves in space.
pub fn land_gaps(run: &Run, summary: &Summary) -> Option<Result<String>> {
    let tilt: Vec<f64> = run.column("cage.tilt")?.iter().map(|tilt| 1e3 * tilt).collect();
    let of_land = |k: usize| run.column(&format!("land[{k}].minimum_gap"));
    let mut gaps: Vec<(String, &[f64])> =
        (0..).map_while(|k| Some((format!("land[{k}]"), of_land(k)?))).collect();
    if gaps.is_empty() {
        gaps.push(("land".to_owned(), run.column("guide.minimum_film")?));
    }
    let paint = |k: usize| SERIES[k % SERIES.len()];
    let mut strip = Strip::new("smallest gap [um]\nbelow 0: contact");
    strip.curves = gaps
        .iter()
        .enumerate()
        .map(|(k, (_, gap))| (paint(k), gap.iter().map(|h| 1e6 * h).collect()))
        .collect();
    strip.bounds = vec![0.0];
    let mut tilts = Strip::new("tilt of the cage [mrad]");
    tilts.curves = vec![(MUTED, tilt)];
    let entries = gaps.iter().enumerate().map(|(k, (name, _))| (Symbol::Line(paint(k)), name.clone()));
    let texts = Texts {
        title: &run.title,
        subtitle: &run.subtitle("Smallest gaps of the lands, and tilt of the cage"),
        axis: TIME,
        step: None,
        entries: entries.chain([(Symbol::Patch, "averaging window".to_owned())]).collect(),
    };
    let window = [(summary.window.from_s, summary.window.to_s)];
    Some(history(&texts, &run.recording.times, &[strip, tilts], &window))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_holds_all_points() {
        let (reach, middle) = square(&[1.0, 3.0], &[0.0, 10.0], false);
        assert!((reach - 5.4).abs() < 1e-12 && middle == [2.0, 5.0]);
        let (reach, middle) = square(&[1.0, 3.0], &[0.0, -1.0], true);
        assert!((reach - 3.24).abs() < 1e-12 && middle == [0.0, 0.0]);
        assert!(square(&[0.0], &[0.0], true).0 > 0.0);
    }
}
