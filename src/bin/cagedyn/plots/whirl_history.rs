//! Whirl of the cage and the forces that drive and brake it, over the whole run.

use super::strips::{self, Strip, Texts};
use super::style::{BLUE, GREEN, MUTED, ORANGE, PURPLE, Paint, RED, Symbol, TEAL};
use crate::results::finished::Run;
use crate::results::summary::Summary;
use crate::results::table::rounded;
use cagedyn::{Result, Spread};

/// Share of the records whose extreme values do not stretch a diagram: right after the start, while the centre is
/// near the guide centre, whirl speeds are large without meaning.
const CLIPPED: f64 = 0.01;

/// Whirl speeds nearer to the centre of the guide are left out, as a share of the clearance, or of the largest radius without a guide:
/// there the whirl has little motion and much speed.
const SMALLEST_RADIUS: f64 = 0.02;

/// Parts of the guide force: channel, name, colour.
const PARTS: [(&str, &str, Paint); 3] = [
    ("guide.pressure_phi", "guide pressure", BLUE),
    ("guide.shear_phi", "guide shear", ORANGE),
    ("guide.solid_phi", "guide solid", RED),
];

/// The picture, if the elements have a prescribed motion and there is a cage.
pub fn whirl_history(run: &Run, summary: &Summary) -> Option<Result<String>> {
    if run.model.has_rollers() {
        return None;
    }
    let column = |name: &str, scale: f64| -> Option<Vec<f64>> {
        Some(run.column(name)?.iter().map(|x| scale * x).collect())
    };
    let present = |name: &str| {
        // A part that never acts would only cover the others.
        column(name, 1.0).filter(|values| values.iter().any(|x| *x != 0.0))
    };
    let strip = |name, curves: Vec<(Paint, Vec<f64>)>| Strip { curves, ..Strip::new(name) };
    let clearance = run.model.guide_clearance();
    let mut entries = vec![(Symbol::Patch, "averaging window".to_owned())];
    let radius = column("cage.whirl_radius", 1e6)?;
    let largest = radius.iter().copied().fold(0.0, f64::max);
    let smallest = SMALLEST_RADIUS * clearance.map_or(largest, |c| 1e6 * c);
    let speed = column("cage.whirl_speed", 1.0)?;
    let note = match clearance {
        Some(_) => "where the radius is at least 2 % of the clearance",
        None => "where the radius is at least 2 % of the largest",
    };
    let known = speed.iter().zip(&radius).map(|(x, r)| if *r >= smallest { *x } else { f64::NAN }).collect();
    let whirl = summary.whirl.as_ref().filter(|whirl| whirl.motion.is_whirl());
    let settled = whirl.and_then(|whirl| whirl.settling_time_s).map(|from| {
        (from, format!("from {} ms on within 15 % of its mean in the window", rounded(1e3 * from)))
    });
    let mut strips = vec![
        Strip {
            note: Some(note),
            since: settled,
            ..strip("whirl speed [rad/s]", vec![(PURPLE, clipped(known))])
        },
        Strip {
            curves: vec![(GREEN, radius)],
            bounds: clearance.map(|c| 1e6 * c).into_iter().collect(),
            ..Strip::new("whirl radius [\u{b5}m]")
        },
    ];
    let dashed = [
        (strips[0].since.is_some(), "steady whirl from here"),
        (clearance.is_some(), "guide clearance"),
        (run.column("guide.film_share").is_some(), "zero"),
    ];
    let dashed: Vec<&str> = dashed.into_iter().filter_map(|(there, name)| there.then_some(name)).collect();
    if !dashed.is_empty() {
        entries.push((Symbol::Dashed(MUTED), dashed.join("; ")));
    }
    if let Some(mut share) = column("guide.film_share", 1.0) {
        // It is a share of a force.
        if let (Some(y), Some(z)) = (run.column("guide.force_y"), run.column("guide.force_z")) {
            let forces = y.iter().zip(z).map(|(y, z)| y.hypot(*z));
            share.iter_mut().zip(forces).filter(|(_, force)| *force == 0.0).for_each(|(x, _)| *x = f64::NAN);
        }
        strips.push(Strip { bounds: vec![0.0], ..strip("film share [1]", vec![(TEAL, share)]) });
    }
    let parts: Vec<_> = PARTS.into_iter().filter_map(|(c, name, p)| Some((p, name, present(c)?))).collect();
    if !parts.is_empty() {
        entries.extend(parts.iter().map(|(paint, name, _)| (Symbol::Line(*paint), (*name).to_owned())));
        let curves = parts.into_iter().map(|(paint, _, values)| (paint, clipped(values))).collect();
        strips.push(strip("guide force [N]", curves));
    }
    if let Some(force) = column("pocket.force_phi", 1.0) {
        strips.push(Strip {
            envelope: run.intervals("pocket.force_phi"),
            ..strip("pocket force [N]", vec![(MUTED, force)])
        });
    }
    let window = [(summary.window.from_s, summary.window.to_s)];
    let what =
        "Whirl of the cage; forces across the line from guide to cage centre, positive counter-clockwise";
    let texts =
        Texts { title: &run.title, subtitle: &run.subtitle(what), axis: strips::TIME, step: None, entries };
    Some(strips::history(&texts, &run.recording.times, &strips, &window))
}

/// The values, those far outside of the range of all but a few of them cut to the edge of that range.
fn clipped(mut values: Vec<f64>) -> Vec<f64> {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|x| x.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let cut = (CLIPPED * sorted.len() as f64) as usize;
    let Some(inner) = sorted.get(cut..sorted.len() - cut).and_then(Spread::of) else { return values };
    let room = inner.max - inner.min;
    let (low, high) = (inner.min - room, inner.max + room);
    values.iter_mut().filter(|x| x.is_finite()).for_each(|x| *x = x.clamp(low, high));
    values
}
