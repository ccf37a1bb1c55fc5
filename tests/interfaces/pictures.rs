//! Pictures and means of runs: they show what is there, and say where it is little.
#![cfg(feature = "cli")]

use crate::cli::{json, run, text};
use serde_json::Value;
use std::path::Path;

/// Runs a scene; what it prints.
fn performed(scene: &str, out: &Path, more: &[&str]) -> String {
    let (file, out) = (format!("scenes/{scene}.json"), out.to_string_lossy());
    let output = run(&[&["run", &file, "--out", &out][..], more].concat());
    assert!(output.status.success(), "{scene}: {}", text(&output.stderr));
    text(&output.stdout)
}

fn picture(out: &Path, name: &str) -> String {
    std::fs::read_to_string(out.join(name)).expect(name)
}

#[test]
fn spectra_name_peaks_that_are_there() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name);
    for (scene, named, peaks) in [
        ("grease_guide", vec!["whirl, 311", "2 whirl, 62"], vec!["whirl", "2 whirl"]),
        ("nu2310", vec!["Z f_c, 242"], vec!["Z f_c"]),
        // It rests: what is left is round-off, whose highest place is told and no line.
        ("ball_short_bearing", vec!["highest, 1", "no clear peak"], vec![]),
    ] {
        performed(scene, &at(scene), &[]);
        let svg = picture(&at(scene), "cage_spectrum.svg");
        for name in named {
            assert!(svg.contains(name), "{scene} has no {name}");
        }
        for harmonic in ["4 f_c, ", "8 f_c, ", "16 f_c, "] {
            assert!(!svg.contains(harmonic), "{scene} marks {harmonic}where there is nothing");
        }
        let lines = json(&at(scene).join("summary.json"))["spectrum"]["lines"].clone();
        let found = lines.as_array().expect("lines").iter().filter(|line| line["peak"] == true);
        let found: Vec<&str> = found.filter_map(|line| line["name"].as_str()).collect();
        let sorted = |mut names: Vec<&str>| {
            names.sort_unstable();
            names.join(", ")
        };
        assert_eq!(sorted(found), sorted(peaks), "{scene}");
    }
}

/// The moment is that of the largest pocket force at any record of the window, and its force is drawn.
#[test]
fn contact_forces_are_those_of_the_largest_pocket_force() {
    let dir = tempfile::tempdir().expect("a directory");
    performed("nu2310", dir.path(), &[]);
    let from = json(&dir.path().join("summary.json"))["window"]["from_s"].as_f64().expect("a time");
    let mut table = csv::Reader::from_path(dir.path().join("timeseries.csv")).expect("a table");
    let heads = table.headers().expect("a head").clone();
    let of_pocket: Vec<usize> =
        (0..heads.len()).filter(|i| heads[*i].ends_with("].pocket_force [N]")).collect();
    let (mut time, mut largest) = (String::new(), 0.0);
    for row in table.records().map(|row| row.expect("a row")) {
        let number = |i: usize| row[i].parse::<f64>().expect("a number");
        let most = of_pocket.iter().map(|i| number(*i).abs()).fold(0.0, f64::max);
        if number(0) >= from && most > largest {
            (time, largest) = (row[0].to_owned(), most);
        }
    }
    let svg = picture(dir.path(), "contact_forces.svg");
    assert!(largest > 100.0 && svg.contains(&format!("Forces at {time} s, when that on a pocket")), "{time}");
    let told = svg.split("elements on cage, largest ").nth(1).and_then(|rest| rest.split(' ').next());
    let told: f64 = told.and_then(|text| text.parse().ok()).expect("a force");
    // Along the circumference and in all.
    assert!((0.999 * largest..1.2 * largest).contains(&told), "{told} {largest}");
    // Twelve bars of the cage, and its rims.
    assert_eq!(svg.matches("fill=\"#D8B56A\"").count(), 12);
}

/// Loads, angles and slip of balls: an axial load is carried by all of them alike, at the angles that the table tells.
#[test]
fn balls_in_space_are_shown_around_the_bearing_and_over_their_ellipses() {
    let dir = tempfile::tempdir().expect("a directory");
    let told = performed("angular_contact_70", dir.path(), &["--until", "0.02", "--set", "gravity=null"]);
    let summary = json(&dir.path().join("summary.json"));
    let column = |name: &str| -> Vec<f64> {
        let list = summary["over_orbit"][name].as_array().expect(name);
        list.iter().filter_map(Value::as_f64).collect()
    };
    for (name, alike) in
        [("inner_angle_mean_rad", 0.3), ("outer_angle_mean_rad", 0.3), ("orbit_ratio_mean", 1.0)]
    {
        let values = column(name);
        assert!(
            values.len() == 36 && values.iter().all(|x| (x / alike - 1.0).abs() < 0.25),
            "{name}: {values:?}"
        );
        assert!(values.iter().all(|x| (x / values[0] - 1.0).abs() < 1e-3), "{name}: {values:?}");
    }
    // 687 N on 25 balls.
    let forces = column("inner_force_mean_n");
    let angle = column("inner_angle_mean_rad")[0];
    assert!((forces[0] * 25.0 * angle.sin() / 687.0 - 1.0).abs() < 0.01, "{forces:?}");
    assert!(told.contains("contact angle") && told.contains("orbit speed"), "{told}");
    let svg = picture(dir.path(), "over_orbit.svg");
    assert!(svg.contains("mean contact angle [deg]") && svg.contains("mean orbit speed [1]"));
    let svg = picture(dir.path(), "contact_ellipse.svg");
    assert!(svg.contains("outer race: ") && svg.contains("inner race: ") && svg.contains("spin to roll"));
}

#[test]
fn small_orbits_have_an_inset() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name);
    for (scene, inset) in [("nu2310", true), ("grease_guide", false), ("ball_short_bearing", false)] {
        performed(scene, &at(scene), &[]);
        let svg = picture(&at(scene), "cage_orbit.svg");
        assert_eq!(svg.contains("at its own scale"), inset, "{scene}");
        assert_eq!(svg.matches("data-x=").count(), 1 + usize::from(inset), "{scene}");
    }
}

/// Every object that has a mean, with its path.
fn means(value: &Value, path: String) -> Vec<(String, Value)> {
    let Some(fields) = value.as_object() else { return Vec::new() };
    let own = fields.keys().any(|name| name.contains("mean") || name == "driving_n" || name == "total_w");
    let inside = fields.iter().flat_map(|(name, field)| means(field, format!("{path}/{name}")));
    own.then(|| (path.clone(), value.clone())).into_iter().chain(inside).collect()
}

/// In 0.1 s the cage of the NU2310 turns twice.
#[test]
fn a_run_of_few_turns_of_the_cage_says_so_beside_every_mean() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name);
    for (until, few) in [("0.1", true), ("0.2", false)] {
        let printed = performed("nu2310", &at(until), &["--until", until]);
        let summary = json(&at(until).join("summary.json"));
        let turns = summary["cage_turns"].as_f64().expect("turns");
        assert!((turns - 20.2 * until.parse::<f64>().expect("a time")).abs() < 0.1, "{turns}");
        let (window, of) = (&summary["window"], turns / until.parse::<f64>().expect("a time"));
        let length = window["to_s"].as_f64().zip(window["from_s"].as_f64()).map(|(to, from)| to - from);
        let in_window = window["cage_turns"].as_f64().expect("turns");
        assert!((in_window - of * length.expect("a window")).abs() < 0.05, "{in_window}");
        let all = means(&summary, String::new());
        assert!(all.len() > 30, "{}", all.len());
        for (path, of) in all {
            assert_eq!(of["few_cage_turns"].as_f64(), few.then_some(turns), "{until}: {path}");
        }
        let beside = |line: &&str| line.contains(" \u{b1} ") && !line.starts_with("mean");
        let rows: Vec<&str> = printed.lines().filter(beside).collect();
        assert!(rows.len() > 8, "{printed}");
        let says = format!("only {turns:.1} turns of the cage");
        assert!(rows.iter().all(|row| row.contains(&says) == few), "{printed}");
        let html = at("x.html").to_string_lossy().into_owned();
        let folder = at(until).to_string_lossy().into_owned();
        assert!(run(&["report", &folder, "--out", &html]).status.success());
        let page = std::fs::read_to_string(&html).expect("a page");
        // Results, conditions of trust, and the tables of all channels.
        assert_eq!(page.matches(&says).count() > 60, few, "{}", page.matches(&says).count());
        assert_eq!(page.contains("class=\"trust but\""), few);
    }
}

#[test]
fn temperatures_are_on_both_scales() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy();
    let output = run(&["heat", "scenes/nu2310_heat.json", "--out", &out]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let (found, svg) = (json(&dir.path().join("heat.json")), picture(dir.path(), "heat_flow.svg"));
    for node in found["nodes"].as_array().expect("lumps") {
        let kelvin = node["temperature_k"].as_f64().expect("a temperature");
        for told in [format!("{kelvin:.1} K"), format!("{:.1} \u{b0}C", kelvin - 273.15)] {
            assert!(svg.contains(&told), "{told}");
        }
        assert!(text(&output.stdout).contains(&format!("{kelvin:.2} K  {:.2} \u{b0}C", kelvin - 273.15)));
    }
}

/// Rollers in space have their skew, and their line loads at the end and in equilibrium; the map has a rectangle for every roller.
#[test]
fn rollers_in_space_have_pictures_of_their_own() {
    let dir = tempfile::tempdir().expect("a directory");
    performed("nu2310_space", dir.path(), &["--until", "0.03"]);
    let summary = json(&dir.path().join("summary.json"));
    let in_space = &summary["over_orbit"]["rollers_in_space"];
    assert_eq!(in_space["skew"]["mean"].as_array().map(Vec::len), Some(36));
    assert_eq!(in_space["ends"][0]["name"], "outer_rib_positive");
    let skew = picture(dir.path(), "roller_skew.svg");
    for text in ["skew [mrad]", "tilt [mrad]", "end force, mean [N]", "outer rib +x", "pocket side"] {
        assert!(skew.contains(text), "no {text}");
    }
    let map = picture(dir.path(), "line_load_map.svg");
    for text in ["load per length [N/mm]", "outer raceway", "inner raceway", "along the roller [mm]"] {
        assert!(map.contains(text), "no {text}");
    }
    let out = dir.path().join("still").to_string_lossy().into_owned();
    assert!(run(&["equilibrium", "scenes/nu2310_space.json", "--out", &out]).status.success());
    assert!(picture(&dir.path().join("still"), "line_load_map.svg").contains("load per length [N/mm]"));
    performed("nu2310", dir.path(), &["--until", "0.01"]);
    assert!(!dir.path().join("roller_skew.svg").exists() && !dir.path().join("line_load_map.svg").exists());
}
