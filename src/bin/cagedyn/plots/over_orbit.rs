//! What elements feel and how they move over the angle of their orbit, in the averaging window.

use super::strips::{self, Strip, Texts};
use super::style::{BLUE, FAINT, GREEN, ORANGE, PURPLE, Paint, Symbol};
use crate::results::finished::Run;
use crate::results::sectors::Sectors;
use crate::results::summary::Summary;
use cagedyn::Result;
use cagedyn::sim::LoadZone;
use std::f64::consts::TAU;

/// The picture, if elements have pockets to press on, or are balls that move in space.
pub fn over_orbit(run: &Run, summary: &Summary) -> Option<Result<String>> {
    let sectors = summary.over_orbit.as_ref()?;
    let degrees: Vec<f64> = sectors.angle_rad.iter().map(|x| x.to_degrees()).collect();
    let strips: Vec<Strip> = strips(sectors).collect();
    let entry = |paint, text: &str| (Symbol::Line(paint), text.to_owned());
    let mut entries = Vec::new();
    if !sectors.outer_force_mean_n.is_empty() {
        entries.extend([entry(BLUE, "at the inner ring"), entry(ORANGE, "at the outer ring")]);
    }
    if !sectors.pocket_force_mean_n.is_empty() {
        entries.extend([
            entry(PURPLE, "pocket force: mean"),
            entry(ORANGE, "95 % of magnitudes"),
            entry(FAINT, "largest in any step"),
        ]);
    }
    if summary.load_zone.is_some() {
        entries.push((Symbol::Patch, "load zone".to_owned()));
    }
    let what = "Elements over the angle of their orbit, all of them together";
    let subtitle = &run.subtitle(what);
    let axis = &angle_axis(run);
    let texts = Texts { title: &run.title, subtitle, axis, step: Some(45.0), entries };
    Some(strips::history(&texts, &degrees, &strips, &shaded(summary.load_zone)))
}

/// Name of the axis of angles of the orbit, which tells the way of the elements.
pub(super) fn angle_axis(run: &Run) -> String {
    let way = match run.direction() {
        Some(way) if way < 0.0 => "; elements go to smaller angles",
        Some(_) => "; elements go to larger angles",
        None => "",
    };
    format!("angle from y, counter-clockwise; 270 is the bottom [deg]{way}")
}

fn strips(sectors: &Sectors) -> impl Iterator<Item = Strip<'static>> {
    let curve = |paint: Paint, values: &[Option<f64>], scale: f64| {
        (paint, values.iter().map(|x| x.map_or(f64::NAN, |x| scale * x)).collect::<Vec<f64>>())
    };
    let within = |name, bounds: Vec<f64>, mut curves: Vec<(Paint, Vec<f64>)>| {
        curves.retain(|(_, values)| !values.is_empty());
        (!curves.is_empty()).then(|| Strip { bounds, curves, ..Strip::new(name) })
    };
    let strip = |name, curves| within(name, vec![0.0], curves);
    let degrees = 360.0 / TAU;
    let of_both = |inner: &[Option<f64>], outer: &[Option<f64>], scale: f64| {
        vec![curve(ORANGE, outer, scale), curve(BLUE, inner, scale)]
    };
    let of_races =
        if sectors.outer_force_mean_n.is_empty() { "inner race force [N]" } else { "mean normal force [N]" };
    [
        strip(of_races, of_both(&sectors.inner_force_mean_n, &sectors.outer_force_mean_n, 1.0)),
        within(
            "mean contact angle [deg]\nof loaded contacts",
            Vec::new(),
            of_both(&sectors.inner_angle_mean_rad, &sectors.outer_angle_mean_rad, degrees),
        ),
        within(
            "mean orbit speed [1]\nover rolling at the free angle",
            Vec::new(),
            vec![curve(GREEN, &sectors.orbit_ratio_mean, 1.0)],
        ),
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
pub(super) fn shaded(zone: Option<LoadZone>) -> Vec<(f64, f64)> {
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
