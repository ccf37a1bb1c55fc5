//! Spectra of sweeps over one number: their table and their picture.
#![cfg(all(feature = "cli", unix))]

use crate::cli::{cagedyn, json, run, text};
use crate::sweep::{ended, succeeded};
use std::path::Path;

/// A sweep of the NU2310 over seven speeds, with records that show 10 kHz.
fn arguments(out: &Path, more: &[&str]) -> Vec<String> {
    let out = out.to_string_lossy();
    let fixed = ["sweep", "scenes/nu2310.json", "--until", "0.03", "--set", "record.interval=5e-5"];
    let vary = ["--vary", "inner_ring.speed.constant=-100:-400:7", "--out", &out];
    fixed.into_iter().chain(vary).chain(more.iter().copied()).map(str::to_owned).collect()
}

fn sweep(out: &Path, more: &[&str]) -> String {
    succeeded(&cagedyn().args(arguments(out, more)).output().expect("it runs"))
}

fn files(out: &Path) -> [Vec<u8>; 3] {
    ["spectra.csv", "waterfall.svg", "sweep.csv"].map(|name| std::fs::read(out.join(name)).expect(name))
}

/// Frequencies, amplitudes and resolution of a point.
fn spectrum(out: &Path, point: usize) -> (Vec<f64>, Vec<f64>, f64) {
    let mut reader = csv::Reader::from_path(out.join("spectra.csv")).expect("a table");
    let head: Vec<String> = reader.headers().expect("a head").iter().map(str::to_owned).collect();
    let expected = [
        "point",
        "inner_ring.speed.constant",
        "frequency [Hz]",
        "amplitude of cage.z [m]",
        "resolution [Hz]",
    ];
    assert_eq!(head, expected);
    let rows = reader.records().map(|row| row.expect("a row")).filter(|row| row[0] == point.to_string());
    let rows: Vec<Vec<f64>> =
        rows.map(|row| row.iter().map(|cell| cell.parse().expect("a number")).collect()).collect();
    let column = |k: usize| rows.iter().map(|row| row[k]).collect::<Vec<f64>>();
    assert!(column(1).iter().all(|speed| *speed == -100.0 - 50.0 * point as f64));
    (column(2), column(3), rows[0][4])
}

#[test]
fn spectra_are_those_of_runs_and_the_same_for_any_jobs_and_after_a_kill() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name);
    assert!(sweep(&at("one"), &["--jobs", "1"]).contains("spectra.csv, waterfall.svg"));
    sweep(&at("two"), &["--jobs", "2"]);
    assert!(files(&at("one")) == files(&at("two")));
    let (kept, _) = ended(&arguments(&at("killed"), &[]), &at("killed"), "KILL", 2);
    assert!((2..7).contains(&kept) && !at("killed/spectra.csv").exists());
    assert!(sweep(&at("killed"), &[]).contains(&format!("{kept} of them done")));
    assert!(files(&at("one")) == files(&at("killed")));
    // Rows are numbers in order, and have the lines that a run by itself tells of.
    let out = at("run").to_string_lossy().into_owned();
    let sets = ["--set", "record.interval=5e-5", "--set", "inner_ring.speed.constant=-300"];
    succeeded(&{
        let output =
            run(&[&["run", "scenes/nu2310.json", "--until", "0.03", "--out", &out], &sets[..]].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
        output
    });
    let told = &json(&at("run/summary.json"))["spectrum"];
    let (frequencies, amplitudes, resolution) = spectrum(&at("one"), 4);
    assert!((resolution - told["resolution_hz"].as_f64().expect("a number")).abs() < 1e-6 * resolution);
    assert!(frequencies.windows(2).all(|f| f[0] < f[1]) && frequencies.last().is_some_and(|f| *f > 9000.0));
    let mut compared = 0;
    for line in told["lines"].as_array().expect("lines") {
        let number = |name: &str| line[name].as_f64().expect("a number");
        let near = |f: f64| (f - number("frequency_hz")).abs() <= resolution;
        let largest = frequencies
            .iter()
            .zip(&amplitudes)
            .filter(|(f, _)| near(**f))
            .map(|(_, a)| *a)
            .fold(0.0, f64::max);
        assert!(largest >= (1.0 - 1e-9) * number("amplitude_m"), "{line}: {largest}");
        compared += 1;
    }
    assert!(compared > 2, "{told}");
    let svg = text(&files(&at("one"))[1]);
    for expected in [
        "frequency [Hz]",
        "|inner_ring.speed.constant| [1/min]",
        "amplitude of cage.z [m]",
        "2 Z f_c",
        "10\u{207b}",
    ] {
        assert!(svg.contains(expected), "{expected}");
    }
    assert!(!svg.contains("NaN") && !svg.contains("failed"));
}

#[test]
fn there_are_spectra_over_one_number_only_and_failed_points_have_none() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name);
    let list = |name: &str, vary: &[&str]| {
        let out = at(name).to_string_lossy().into_owned();
        let scene = ["sweep", "scenes/nu2310.json", "--until", "0.02", "--set", "solver={}", "--out", &out];
        run(&[&scene[..], vary].concat())
    };
    let words = list("words", &["--vary", "solver.preset=draft,engineering"]);
    assert!(words.status.success() && !at("words/spectra.csv").exists(), "{}", text(&words.stderr));
    let failing = list("failing", &["--vary", "solver.max_steps=10,1000000"]);
    assert_eq!(failing.status.code(), Some(1));
    let table = std::fs::read_to_string(at("failing/spectra.csv")).expect("a table");
    assert!(table.lines().skip(1).all(|line| line.starts_with("1,1000000,")) && table.lines().count() > 5);
    assert!(std::fs::read_to_string(at("failing/waterfall.svg")).expect("a picture").contains("failed"));
    // Too few records for any.
    let short = run(&[
        "sweep",
        "scenes/nu2310.json",
        "--until",
        "2e-3",
        "--vary",
        "inner_ring.speed.constant=-100:-300:2",
        "--out",
        &at("short").to_string_lossy(),
    ]);
    assert!(!succeeded(&short).contains("spectra") && !at("short/waterfall.svg").exists());
}
