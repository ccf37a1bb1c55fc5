//! Skew and tilt of rollers in space, and forces of their ends on ribs and pocket sides, over the angle of their orbit in the averaging
//! window.

use super::over_orbit::{angle_axis, shaded};
use super::strips::{self, Strip, Texts};
use super::style::{BLUE, FAINT, GREEN, ORANGE, PURPLE, Paint, RED, Symbol, TEAL};
use crate::results::finished::Run;
use crate::results::sectors::{InSpace, Scattered};
use crate::results::summary::Summary;
use cagedyn::Result;

/// Colours of the ends, in order.
const ENDS: [Paint; 6] = [ORANGE, BLUE, RED, TEAL, GREEN, FAINT];

/// The picture, if rollers move in space.
pub fn roller_skew(run: &Run, summary: &Summary) -> Option<Result<String>> {
    let sectors = summary.over_orbit.as_ref()?;
    let rollers = sectors.rollers_in_space.as_ref()?;
    let degrees: Vec<f64> = sectors.angle_rad.iter().map(|x| x.to_degrees()).collect();
    let mut entries =
        vec![(Symbol::Line(PURPLE), "mean".to_owned()), (Symbol::Line(FAINT), "5 % and 95 %".to_owned())];
    let ends = rollers.ends.iter().zip(ENDS);
    entries.extend(ends.map(|(end, paint)| (Symbol::Line(paint), end_in_words(&end.name))));
    if summary.load_zone.is_some() {
        entries.push((Symbol::Patch, "load zone".to_owned()));
    }
    let subtitle = &run.subtitle("Rollers over the angle of their orbit, all of them together");
    let axis = &angle_axis(run);
    let texts = Texts { title: &run.title, subtitle, axis, step: Some(45.0), entries };
    Some(strips::history(&texts, &degrees, &strips(rollers), &shaded(summary.load_zone)))
}

/// "outer rib +x" of `outer_rib_positive`.
fn end_in_words(name: &str) -> String {
    let (what, side) = name.rsplit_once('_').unwrap_or((name, ""));
    let side = match side {
        "positive" => "+x",
        "negative" => "\u{2212}x",
        other => other,
    };
    format!("{} {side}", what.replace('_', " "))
}

fn strips(rollers: &InSpace) -> Vec<Strip<'static>> {
    let values = |values: &[Option<f64>], scale: f64| -> Vec<f64> {
        values.iter().map(|x| x.map_or(f64::NAN, |x| scale * x)).collect()
    };
    let angle = |name: &'static str, of: &Scattered| Strip {
        bounds: vec![0.0],
        curves: vec![
            (FAINT, values(&of.p05, 1e3)),
            (FAINT, values(&of.p95, 1e3)),
            (PURPLE, values(&of.mean, 1e3)),
        ],
        ..Strip::new(name)
    };
    let forces = |name: &'static str, of: fn(&crate::results::sectors::EndForces) -> &Vec<Option<f64>>| {
        let curves: Vec<(Paint, Vec<f64>)> =
            rollers.ends.iter().zip(ENDS).map(|(end, paint)| (paint, values(of(end), 1.0))).collect();
        (!curves.is_empty()).then(|| Strip { bounds: vec![0.0], curves, ..Strip::new(name) })
    };
    [
        Some(angle("skew [mrad]\n+x end at smaller angles > 0", &rollers.skew)),
        Some(angle("tilt [mrad]\n+x end outside > 0", &rollers.tilt)),
        forces("end force, mean [N]", |end| &end.mean_n),
        forces("end force, 95 % [N]", |end| &end.p95_n),
    ]
    .into_iter()
    .flatten()
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_told_with_their_side() {
        assert_eq!(end_in_words("outer_rib_positive"), "outer rib +x");
        assert_eq!(end_in_words("pocket_side_negative"), "pocket side \u{2212}x");
    }
}
