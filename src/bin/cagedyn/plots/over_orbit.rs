//! What elements feel over the angle of their orbit, in the averaging window.

use super::strips::{self, Strip, Texts};
use super::style::{BLUE, FAINT, GREEN, ORANGE, PURPLE, Paint, Symbol};
use crate::results::finished::Run;
use crate::results::sectors::Sectors;
use crate::results::summary::Summary;
use cagedyn::Result;
use cagedyn::sim::LoadZone;
use std::f64::consts::TAU;

/// The picture, if elements have pockets to press on.
pub fn over_orbit(run: &Run, summary: &Summary) -> Option<Result<String>> {
    let sectors = summary.over_orbit.as_ref()?;
    let degrees: Vec<f64> = sectors.angle_rad.iter().map(|x| x.to_degrees()).collect();
    let strips: Vec<Strip> = strips(sectors).collect();
    let mut entries = vec![
        (Symbol::Line(PURPLE), "pocket force: mean".to_owned()),
        (Symbol::Line(ORANGE), "95 % of magnitudes".to_owned()),
        (Symbol::Line(FAINT), "largest in any step".to_owned()),
    ];
    if summary.load_zone.is_some() {
        entries.push((Symbol::Patch, "load zone".to_owned()));
    }
    let what = "Elements over the angle of their orbit, all of them together";
    let subtitle = &run.subtitle(what);
    let way = match run.direction() {
        Some(way) if way < 0.0 => "; elements go to smaller angles",
        Some(_) => "; elements go to larger angles",
        None => "",
    };
    let axis = &format!("angle from y, counter-clockwise; 270 is the bottom [deg]{way}");
    let texts = Texts { title: &run.title, subtitle, axis, step: Some(45.0), entries };
    Some(strips::history(&texts, &degrees, &strips, &shaded(summary.load_zone)))
}

fn strips(sectors: &Sectors) -> impl Iterator<Item = Strip<'static>> {
    let curve = |paint: Paint, values: &[Option<f64>], scale: f64| {
        (paint, values.iter().map(|x| x.map_or(f64::NAN, |x| scale * x)).collect::<Vec<f64>>())
    };
    let strip = |name, curves: Vec<(Paint, Vec<f64>)>| {
        curves.iter().any(|(_, values)| !values.is_empty()).then(|| Strip {
            bounds: vec![0.0],
            curves,
            ..Strip::new(name)
        })
    };
    [
        strip("inner race force [N]", vec![curve(BLUE, &sectors.inner_force_mean_n, 1.0)]),
        strip("mean slip [%]", vec![curve(GREEN, &sectors.slip_mean, 100.0)]),
        strip(
            "pocket force [N]\nmean: driving > 0",
            vec![
                curve(FAINT, &sectors.pocket_force_peak_n, 1.0),
                curve(ORANGE, &sectors.pocket_force_p95_n, 1.0),
                curve(PURPLE, &sectors.pocket_force_mean_n, 1.0),
            ],
        ),
        strip(
            "mean pocket force [N]\ndriving > 0 > braking",
            vec![curve(PURPLE, &sectors.pocket_force_mean_n, 1.0)],
        ),
    ]
    .into_iter()
    .flatten()
}

/// The load zone in degrees, in two parts where it lies across the beginning.
fn shaded(zone: Option<LoadZone>) -> Vec<(f64, f64)> {
    let Some(zone) = zone else { return Vec::new() };
    let (from, to) = (zone.middle_rad - 0.5 * zone.extent_rad, zone.middle_rad + 0.5 * zone.extent_rad);
    let parts = [(from, to), (from + TAU, to + TAU), (from - TAU, to - TAU)];
    let parts = parts.map(|(a, b)| (a.max(0.0).to_degrees(), b.min(TAU).to_degrees()));
    parts.into_iter().filter(|(a, b)| b > a).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_zone_across_the_beginning_has_two_parts() {
        let zone = |middle: f64, extent: f64| {
            let [middle_rad, extent_rad] = [middle, extent].map(f64::to_radians);
            let rounded = |(a, b): (f64, f64)| (a.round(), b.round());
            shaded(Some(LoadZone { middle_rad, extent_rad })).into_iter().map(rounded).collect::<Vec<_>>()
        };
        assert_eq!(zone(270.0, 90.0), [(225.0, 315.0)]);
        assert_eq!(zone(10.0, 60.0), [(0.0, 40.0), (340.0, 360.0)]);
        assert_eq!(zone(350.0, 60.0), [(320.0, 360.0), (0.0, 20.0)]);
        assert!(shaded(None).is_empty());
    }
}
