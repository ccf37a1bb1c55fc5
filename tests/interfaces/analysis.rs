//! What `run` tells of a motion beyond means: spectrum, load zone, forces over the orbit, power loss.
#![cfg(feature = "cli")]

use crate::cli::{json, run};
use serde_json::Value;
use std::f64::consts::PI;

fn summary(arguments: &[&str]) -> Value {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    let arguments: Vec<&str> =
        ["run"].into_iter().chain(arguments.iter().copied()).chain(["--out", &out]).collect();
    let output = run(&arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    json(&dir.path().join("summary.json"))
}

fn numbers(list: &Value) -> Vec<f64> {
    list.as_array().expect("a list").iter().map(|x| x.as_f64().unwrap_or(f64::NAN)).collect()
}

/// The first paper's bearing: elements that pass shake the cage, the bottom carries the load, rollers brake behind it and
/// push the cage in its second half, and what the ring gives is lost.
#[test]
fn a_loaded_roller_bearing() {
    let summary = summary(&["scenes/nu2310.json", "--until", "0.3"]);
    let spectrum = &summary["spectrum"];
    assert_eq!(spectrum["segments"], 1);
    let amplitude = |name: &str| {
        let lines = spectrum["lines"].as_array().expect("lines");
        lines
            .iter()
            .find(|line| line["name"] == name)
            .and_then(|line| line["amplitude_m"].as_f64())
            .expect(name)
    };
    for other in ["8 f_c", "16 f_c", "Z f_c - f_c", "Z f_c + f_c"] {
        assert!(amplitude("Z f_c") > 1.5 * amplitude(other), "{other}: {spectrum}");
    }

    let zone = &summary["load_zone"];
    let (middle, extent) = (zone["middle_rad"].as_f64().unwrap(), zone["extent_rad"].as_f64().unwrap());
    assert!((middle - 1.5 * PI).abs() < 0.2 && (1.2..2.2).contains(&extent), "{zone}");

    // Clockwise the load zone is entered at the right, so that its second half lies at the left of the bottom.
    let sectors = &summary["over_orbit"];
    let [angles, mean, slip] =
        ["angle_rad", "pocket_force_mean_n", "slip_mean"].map(|name| numbers(&sectors[name]));
    assert_eq!(angles.len(), 36);
    let most = (0..36).max_by(|a, b| mean[*a].total_cmp(&mean[*b])).unwrap();
    assert!((1.5 * PI - 1.3..1.5 * PI).contains(&angles[most]), "{} {mean:?}", angles[most]);
    let slipping = (0..36).max_by(|a, b| slip[*a].total_cmp(&slip[*b])).unwrap();
    assert!((angles[slipping] - (1.5 * PI + 0.5 * extent)).abs() < 0.5, "{} {slip:?}", angles[slipping]);

    let loss = &summary["power_loss"];
    let total = loss["total_w"].as_f64().unwrap();
    let sum: f64 = loss["by_source_w"].as_object().unwrap().values().filter_map(Value::as_f64).sum();
    // The drag on the ring, which turns with 3000 rev/min.
    let drive = summary["statistics"]["inner_ring.drag_torque"]["mean"].as_f64().unwrap() * 100.0 * PI;
    assert!((total - sum).abs() < 1e-9 * total, "{loss}");
    assert!((total - drive).abs() < 0.03 * total, "{total} W lost, {drive} W given");
}

/// A whirl has a steady velocity and its own line; elements of prescribed motion have no load.
#[test]
fn a_whirling_cage() {
    let summary = summary(&["scenes/grease_guide.json", "--until", "0.1"]);
    let deviation = summary["whirl"]["velocity_deviation"].as_f64().unwrap();
    assert!(deviation < 0.2, "{deviation}");
    let lines = summary["spectrum"]["lines"].as_array().unwrap();
    let largest = |a: &&Value, b: &&Value| {
        a["amplitude_m"].as_f64().unwrap().total_cmp(&b["amplitude_m"].as_f64().unwrap())
    };
    let line = lines.iter().max_by(largest).unwrap();
    assert_eq!(line["name"], "whirl", "{lines:?}");
    let radius = summary["whirl"]["mean_radius_m"].as_f64().unwrap();
    assert!((line["amplitude_m"].as_f64().unwrap() - radius).abs() < 0.15 * radius, "{line} {radius}");
    assert!(summary.get("load_zone").is_none() && summary["over_orbit"].get("inner_force_mean_n").is_none());
    assert!(summary["power_loss"]["by_source_w"]["guide_film"].as_f64().unwrap() > 0.0);
}
