//! Malformed and impossible scenes: each is refused with the right status and one line that names the place.

mod balls;
mod beyond;
mod cage;
mod elements;
mod fields;
mod geometry;
mod guide;
mod laws;
mod oil;
mod pocket;
mod profile;
mod ranges;
mod signals;
mod spatial_cage;
mod start;
mod syntax;
pub mod table;
mod waves;

use crate::common::{example, example_text, read, set};
use cagedyn::{Model, Status};
use serde_json::json;
use table::{Row, complaint};

pub fn rows() -> Vec<Row> {
    let parts = [
        syntax::rows(),
        fields::rows(),
        ranges::rows(),
        geometry::rows(),
        signals::rows(),
        laws::rows(),
        elements::rows(),
        balls::rows(),
        oil::rows(),
        beyond::rows(),
        cage::rows(),
        spatial_cage::rows(),
        pocket::rows(),
        profile::rows(),
        guide::rows(),
        start::rows(),
        waves::rows(),
    ];
    parts.into_iter().flatten().collect()
}

#[test]
fn every_bad_scene_is_refused_with_a_message_that_helps() {
    let rows = rows();
    assert!(rows.len() >= 445, "only {} rows", rows.len());
    let complaints: Vec<String> =
        rows.iter().filter_map(|row| complaint(row).map(|text| format!("{}: {text}", row.name))).collect();
    assert!(complaints.is_empty(), "{} of {}:\n{}", complaints.len(), rows.len(), complaints.join("\n"));
}

#[test]
fn the_examples_themselves_are_accepted() {
    Model::from_json(&example_text()).unwrap();
    Model::from_json(&example().to_string()).unwrap();
    Model::from_json(&read("scenes/grease_guide.json")).unwrap();
}

#[test]
fn names_of_rows_are_unique() {
    let rows = rows();
    for (i, row) in rows.iter().enumerate() {
        assert!(rows[..i].iter().all(|other| other.name != row.name), "{} is used twice", row.name);
    }
}

#[test]
fn messages_stay_on_one_line_whatever_the_names() {
    for name in ["two\nlines", "\r\n", "tab\tand \u{1b}[31m colour", "\u{2028}"] {
        let mut scene = example();
        set(&mut scene, "rollers.material", json!(name));
        let error = Model::from_json(&scene.to_string()).unwrap_err();
        assert_eq!(error.status, Status::BadScene);
        assert!(error.message.starts_with("rollers.material: "), "{error}");
        assert_eq!(error.message.lines().count(), 1, "{error}");
    }
}
