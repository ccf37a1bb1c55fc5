//! What pictures and tables say of a bearing below their title: taken from the model, so that it is true of every run.

use crate::results::table::number;
use cagedyn::Model;
use cagedyn::scene::{ElementMotion, RingMotion, Signal};
use std::f64::consts::TAU;

/// Longest list of changes, characters.
const LONGEST: usize = 90;

/// "1000 1/min, load 4900 N, radial clearance 40 um, diametral guide clearance 400 um"; of what changes its range.
pub fn facts(model: &Model) -> String {
    let mut list = Vec::new();
    let scene = model.scene();
    let rpm = |speed: f64| number(speed * 60.0 / TAU);
    let range = |signal: &Signal| {
        let (low, high) = signal.bounds();
        if low == high { rpm(low.abs()) } else { format!("{} to {}", rpm(low), rpm(high)) }
    };
    match (&scene.inner_ring, scene.kinematic_elements.as_ref().map(|elements| &elements.motion)) {
        (Some(ring), _) => list.push(format!("{} 1/min", range(&ring.speed))),
        (None, Some(ElementMotion::Prescribed { orbit_speed, .. })) => {
            list.push(format!("elements at {} 1/min", range(orbit_speed)));
        }
        _ => {}
    }
    let outer = scene.outer_ring.as_ref().filter(|ring| ring.turns()).and_then(|ring| ring.speed.as_ref());
    list.extend(outer.map(|speed| format!("outer ring {} 1/min", range(speed))));
    let load = match scene.inner_ring.as_ref().map(|ring| &ring.motion) {
        Some(RingMotion::Free(free)) => free.load.as_ref(),
        _ => None,
    };
    if let Some(load) = load {
        let constant = [&load.y, &load.z].iter().all(|signal| signal.bounds().0 == signal.bounds().1);
        let largest = number(load.y.largest().hypot(load.z.largest()));
        list.push(format!("load {}{largest} N", if constant { "" } else { "up to " }));
    }
    let ring = scene.inner_ring.as_ref().filter(|_| model.has_rollers());
    let clearances = [
        ("radial clearance", ring.and_then(|ring| ring.radial_clearance)),
        ("diametral guide clearance", model.guide_clearance().map(|c| 2.0 * c)),
    ];
    for (name, clearance) in clearances {
        list.extend(clearance.map(|c| format!("{name} {} \u{b5}m", number(1e6 * c))));
    }
    list.join(", ")
}

/// Title of a run: that of the scene, or, when values of it were replaced, its name with them, as a title tells of what they
/// were before.
pub fn title(own: Option<&str>, name: &str, set: &[String]) -> String {
    let changes: Vec<&str> = set.iter().map(String::as_str).collect();
    match own {
        Some(own) if changes.is_empty() || changes.iter().any(|c| c.starts_with("title=")) => own.to_owned(),
        _ if changes.is_empty() => name.to_owned(),
        _ => format!("{name} with {}", shortened(&changes.join(", "))),
    }
}

fn shortened(text: &str) -> String {
    if text.chars().count() <= LONGEST {
        return text.to_owned();
    }
    text.chars().take(LONGEST).chain("...".chars()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_do_not_tell_of_values_that_were_replaced() {
        let set = |texts: &[&str]| texts.iter().map(|t| (*t).to_owned()).collect::<Vec<_>>();
        assert_eq!(title(Some("NU2310, 40 um"), "nu2310", &[]), "NU2310, 40 um");
        assert_eq!(title(None, "nu2310", &[]), "nu2310");
        let changed = set(&["inner_ring.radial_clearance=5e-6"]);
        assert_eq!(
            title(Some("NU2310, 40 um"), "nu2310", &changed),
            "nu2310 with inner_ring.radial_clearance=5e-6"
        );
        let named = set(&["inner_ring.radial_clearance=5e-6", "title=mine"]);
        assert_eq!(title(Some("mine"), "nu2310", &named), "mine");
        assert!(title(None, "x", &set(&["a=1"; 100])).len() < 120);
    }
}
