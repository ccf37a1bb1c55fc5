//! Slip, place in the pocket and forces of one roller at the end of a run (compare Fig. 10).

use super::strips::{self, ENVELOPE, Strip, Texts};
use super::style::{BLUE, GREEN, MUTED, ORANGE, PURPLE, Symbol};
use crate::results::finished::Run;
use crate::results::intervals::positive_intervals;
use cagedyn::Result;

const POCKET_FORCE: &str = "pocket force [N]\ndriving > 0 > braking";
/// Length of the time shown, s.
const SHOWN: f64 = 0.1;

/// The picture of the first roller.
pub fn roller_history(run: &Run) -> Option<Result<String>> {
    let from = run.recording.index_at(run.last(SHOWN));
    let times = run.recording.times.get(from..)?;
    let values = |field: &str, scale: f64| -> Option<Vec<f64>> {
        let column = run.column(&format!("roller[0].{field}"))?.get(from..)?;
        Some(column.iter().map(|x| x * scale).collect())
    };
    let bounds = run.model.pocket_clearance().map_or(Vec::new(), |c| vec![-1e3 * c, 1e3 * c]);
    let strip = |name, color, values: Option<Vec<f64>>, bounds: &[f64]| {
        values.map(|values| Strip {
            curves: vec![(color, values)],
            bounds: bounds.to_vec(),
            ..Strip::new(name)
        })
    };
    let extremes = run.intervals("roller[0].pocket_force").and_then(|x| x.get(from..));
    let strips = [
        strip("slip ratio [1]", BLUE, values("slip", 1.0), &[]),
        strip("pocket position [mm]\nahead > 0 > behind", GREEN, values("pocket_position", 1e3), &bounds),
        strip(POCKET_FORCE, PURPLE, values("pocket_force", 1.0), &[0.0]),
        // Many times the records, which would be a flat line on the same scale.
        extremes.map(|envelope| Strip {
            envelope: Some(envelope),
            bounds: vec![0.0],
            ..Strip::new("its extremes [N]\ndriving > 0 > braking")
        }),
        strip("inner race force [N]", ORANGE, values("inner_force", 1.0), &[]),
    ];
    let strips: Vec<Strip> = strips.into_iter().flatten().collect();
    let loaded = positive_intervals(times, &values("inner_force", 1.0)?);
    let mut entries = vec![(Symbol::Patch, "load zone (force on the inner race)".to_owned())];
    if !bounds.is_empty() {
        entries.push((Symbol::Dashed(MUTED), "pocket clearance, zero".to_owned()));
    }
    if extremes.is_some() {
        entries.push((Symbol::Line(ENVELOPE), "extremes of every step between records".to_owned()));
    }
    let subtitle = &run.subtitle("Roller 0: slip, place in its pocket and forces");
    let texts = Texts { title: &run.title, subtitle, axis: strips::TIME, step: None, entries };
    Some(strips::history(&texts, times, &strips, &loaded))
}
