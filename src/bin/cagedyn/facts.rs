//! What pictures and tables say of a bearing below their title: taken from the model, so that it is true of every run.

use crate::table::number;
use cagedyn::Model;
use cagedyn::model::{HostInputs, Input};
use std::f64::consts::TAU;

/// Longest list of changes, characters.
const LONGEST: usize = 90;

/// "1000 1/min, load 4900 N, radial clearance 40 um, diametral guide clearance 400 um" at time `t` in s.
pub fn facts(model: &Model, t: f64) -> String {
    let inputs = model.inputs_at(t, &HostInputs::default());
    let has = |input| model.input_list().any(|other| other == input);
    let mut list = Vec::new();
    let speed = if has(Input::RingSpeed) { Input::RingSpeed } else { Input::OrbitSpeed };
    let what = if has(Input::RingSpeed) { "" } else { "elements at " };
    list.push(format!("{what}{} 1/min", number(inputs.of(speed).abs() * 60.0 / TAU)));
    if has(Input::LoadY) {
        list.push(format!("load {} N", number(inputs.of(Input::LoadY).hypot(inputs.of(Input::LoadZ)))));
    }
    let scene = model.scene();
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
