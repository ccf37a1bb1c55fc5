//! Slip, place in the pocket and forces of one roller at the end of a run (compare Fig. 10).

use super::axis::Axis;
use super::panel::{Place, panel};
use super::style::{self, BLUE, CURVE, GREEN, MUTED, ORANGE, PURPLE, Paint, Symbol, line};
use crate::intervals::positive_intervals;
use crate::run::Run;
use cagedyn::Result;

/// Length of the time shown, s.
const SHOWN: f64 = 0.1;
/// Height of a diagram and gap between two, px.
const HEIGHT: f64 = 165.0;
const GAP: f64 = 16.0;
/// Upper edge of the first diagram, px.
const TOP: f64 = 100.0;

/// One diagram.
struct Strip {
    name: &'static str,
    color: Paint,
    values: Vec<f64>,
    /// Dashed lines at plus and minus this value.
    bound: Option<f64>,
}

/// The picture of the first roller.
pub fn roller_history(run: &Run) -> Option<Result<String>> {
    let from = run.recording.index_at(run.last(SHOWN));
    let times = run.recording.times.get(from..)?;
    let values = |field: &str, scale: f64| -> Option<Vec<f64>> {
        let column = run.column(&format!("roller[0].{field}"))?.get(from..)?;
        Some(column.iter().map(|x| x * scale).collect())
    };
    let bound = run.model.pocket_clearance().map(|clearance| 1e3 * clearance);
    let strip = |name, color, values: Option<Vec<f64>>, bound| {
        values.map(|values| Strip { name, color, values, bound })
    };
    let strips = [
        strip("slip ratio [1]", BLUE, values("slip", 1.0), None),
        strip("pocket position [mm]", GREEN, values("pocket_position", 1e3), bound),
        strip("pocket force [N]", PURPLE, values("pocket_force", 1.0), None),
        strip("inner race force [N]", ORANGE, values("inner_force", 1.0), None),
    ];
    let strips: Vec<Strip> = strips.into_iter().flatten().collect();
    let loaded = positive_intervals(times, &values("inner_force", 1.0)?);
    Some(draw(&run.title, times, &strips, &loaded))
}

fn draw(title: &str, times: &[f64], strips: &[Strip], loaded: &[(f64, f64)]) -> Result<String> {
    let (start, end) = (times.first().copied().unwrap_or(0.0), times.last().copied().unwrap_or(1.0));
    let x_axis = Axis::new("time [s]", start, end, 10);
    let height = TOP + strips.len() as f64 * (HEIGHT + GAP) + 46.0;
    style::picture((900.0, height), title, "Roller 0: slip, place in its pocket and forces", |canvas| {
        let mut entries = vec![(Symbol::Patch, "load zone (force on the inner race)".to_owned())];
        if strips.iter().any(|s| s.bound.is_some()) {
            entries.push((Symbol::Dashed(MUTED), "pocket clearance".to_owned()));
        }
        style::legend_row(canvas, 78.0, &entries)?;
        for (k, strip) in strips.iter().enumerate() {
            let bounds = strip.bound.into_iter().flat_map(|b| [-b, b]);
            let y_axis = Axis::covering(strip.name, strip.values.iter().copied().chain(bounds.clone()), 5);
            let place = Place { x: 100.0, y: TOP + k as f64 * (HEIGHT + GAP), w: 770.0, h: HEIGHT };
            let last = k + 1 == strips.len();
            panel(canvas, place, (&x_axis, &y_axis), last, loaded, |panel| {
                for bound in bounds {
                    panel.dashed([(start, bound), (end, bound)], line(MUTED, 0.9))?;
                }
                let points = times.iter().copied().zip(strip.values.iter().copied());
                panel.curve(points, line(strip.color, CURVE))
            })?;
        }
        Ok(())
    })
}
