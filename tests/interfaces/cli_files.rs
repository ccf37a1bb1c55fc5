//! What the command line program leaves on disk: under true titles, of one run, whole or marked as unfinished.
#![cfg(all(feature = "cli", unix))]

use crate::cli::{cagedyn, json, run, text};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Rows of a table, which ends with a whole one; all have as many cells as its head.
fn rows(path: &Path) -> Vec<Vec<String>> {
    assert!(read(path).ends_with('\n'), "{}: cut within a row", path.display());
    whole_rows(path)
}

/// Rows of a table but for a last one without an end, which a kill in the middle of a write can leave.
fn whole_rows(path: &Path) -> Vec<Vec<String>> {
    let table = read(path);
    let whole = table.rfind('\n').map_or("", |end| &table[..end]);
    let rows: Vec<Vec<String>> =
        whole.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect();
    assert!(rows.iter().all(|row| row.len() == rows[0].len()), "{}", path.display());
    rows
}

#[test]
fn titles_tell_of_replaced_values_and_pictures_of_the_model() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    let scene = ["run", "scenes/nu2310.json", "--until", "0.02", "--out", &out];
    let changed = [&scene[..], &["--set", "inner_ring.radial_clearance=5e-6"]].concat();
    assert!(run(&changed).status.success());
    for picture in ["cage_orbit.svg", "cage_position.svg", "roller_history.svg"] {
        let svg = read(&dir.path().join(picture));
        assert!(!svg.contains("40 um"), "{picture}");
        for part in [
            "nu2310 with inner_ring.radial_clearance=5e-6",
            "3000 1/min",
            "load 4900 N",
            "radial clearance 5.000",
        ] {
            assert!(svg.contains(part), "{picture} has no {part}");
        }
    }
    assert_eq!(
        json(&dir.path().join("summary.json"))["title"],
        "nu2310 with inner_ring.radial_clearance=5e-6"
    );
    assert!(run(&scene).status.success());
    assert!(read(&dir.path().join("cage_orbit.svg")).contains("40 um"));
}

#[test]
fn a_folder_has_the_files_of_one_run() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    let names = || {
        let mut names: Vec<String> = std::fs::read_dir(dir.path())
            .expect("a folder")
            .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    };
    std::fs::write(dir.path().join("notes.txt"), "mine").expect("a file");
    assert!(run(&["run", "scenes/nu2310.json", "--until", "0.02", "--out", &out]).status.success());
    assert!(names().contains(&"roller_history.svg".to_owned()));
    let cases = ["cases", "scenes/nu2310_fig9.cases.json", "--until", "1e-3", "--out", &out];
    assert!(run(&cases).status.success());
    assert!(!names().contains(&"summary.json".to_owned()) && names().contains(&"cases.csv".to_owned()));
    assert!(run(&["run", "scenes/grease_guide.json", "--until", "0.02", "--out", &out]).status.success());
    let expected = [
        "cage_orbit.svg",
        "cage_position.svg",
        "cage_spectrogram.svg",
        "cage_spectrum.svg",
        "contact_forces.svg",
        "notes.txt",
        "over_orbit.svg",
        "scene_as_run.json",
        "summary.json",
        "timeseries.csv",
        "whirl_history.svg",
    ];
    assert_eq!(names(), expected);
}

/// A run that goes on for hours, with some records written.
fn long_run(out: &Path) -> Child {
    let mut child = cagedyn()
        .args(["run", "scenes/nu2310.json", "--until", "500", "--large-table", "--out"])
        .arg(out)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let start = Instant::now();
    let unfinished = out.join("timeseries.unfinished.csv");
    while std::fs::metadata(&unfinished).map_or(0, |data| data.len()) < 100_000 {
        assert!(child.try_wait().expect("a status").is_none(), "it ended");
        assert!(start.elapsed() < Duration::from_secs(120), "nothing was written");
        std::thread::sleep(Duration::from_millis(20));
    }
    child
}

fn signal(child: &Child, name: &str) {
    let sent = Command::new("sh").args(["-c", &format!("kill -{name} {}", child.id())]).status();
    assert!(sent.is_ok_and(|status| status.success()));
}

#[test]
fn a_killed_run_leaves_its_rows_and_says_that_it_is_unfinished() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    // The results of an earlier run must not stay beside those of the killed one.
    assert!(run(&["run", "scenes/nu2310.json", "--until", "0.01", "--out", &out]).status.success());
    let mut child = long_run(dir.path());
    signal(&child, "KILL");
    child.wait().expect("it ends");
    assert!(whole_rows(&dir.path().join("timeseries.unfinished.csv")).len() > 20);
    assert!(!dir.path().join("timeseries.csv").exists() && !dir.path().join("cage_orbit.svg").exists());
    let summary = json(&dir.path().join("summary.json"));
    assert_eq!(
        (&summary["complete"], &summary["simulated_time_s"]),
        (&false.into(), &serde_json::Value::Null)
    );
}

#[test]
fn termination_ends_a_run_as_ctrl_c_does() {
    for name in ["TERM", "HUP"] {
        let dir = tempfile::tempdir().expect("a directory");
        let mut child = long_run(dir.path());
        signal(&child, name);
        assert_eq!(child.wait().expect("it ends").code(), Some(130), "{name}");
        let summary = json(&dir.path().join("summary.json"));
        assert_eq!((&summary["complete"], &summary["interrupted"]), (&false.into(), &true.into()));
        assert!(rows(&dir.path().join("timeseries.csv")).len() > 20);
        assert!(!dir.path().join("timeseries.unfinished.csv").exists());
    }
}

/// As a full disk, a limit on the size of files fails a write in its middle.
#[test]
fn a_full_disk_leaves_whole_rows() {
    let dir = tempfile::tempdir().expect("a directory");
    let command = format!(
        "ulimit -f 100; exec '{}' run scenes/nu2310.json --until 0.2 --out '{}'",
        env!("CARGO_BIN_EXE_cagedyn"),
        dir.path().display()
    );
    let output = Command::new("sh")
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["-c", &command])
        .output()
        .expect("a shell");
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let message = text(&output.stderr);
    assert!(message.contains("timeseries.unfinished.csv") && message.lines().count() == 1, "{message}");
    assert!(rows(&dir.path().join("timeseries.unfinished.csv")).len() > 5);
    let summary = json(&dir.path().join("summary.json"));
    assert_eq!(summary["complete"], false);
    // What was computed is told all the same.
    assert!(summary["error"].as_str().is_some_and(|error| error.contains("timeseries.unfinished.csv")));
    assert!(text(&output.stdout).contains("cage centre y"), "{}", text(&output.stdout));
}

#[test]
fn a_picture_that_cannot_be_written_costs_nothing_else() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    std::fs::create_dir(dir.path().join("cage_orbit.svg")).expect("a folder in the way");
    let output = run(&["run", "scenes/nu2310.json", "--until", "0.02", "--out", &out]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        text(&output.stderr).contains("cage_orbit.svg") && text(&output.stdout).contains("cage centre y")
    );
    let summary = json(&dir.path().join("summary.json"));
    assert_eq!((&summary["complete"], &summary["simulated_time_s"]), (&true.into(), &0.02.into()));
    assert!(dir.path().join("timeseries.csv").exists());
}

#[test]
fn a_folder_serves_one_run_at_a_time_and_no_files_of_others_are_touched() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    let mut first = long_run(dir.path());
    let second = run(&["run", "scenes/grease_guide.json", "--until", "0.01", "--out", &out]);
    assert_eq!(second.status.code(), Some(1));
    assert!(text(&second.stderr).contains("another run is writing"), "{}", text(&second.stderr));
    signal(&first, "TERM");
    first.wait().expect("it ends");
    assert!(rows(&dir.path().join("timeseries.csv"))[0].contains(&"roller[0].slip [1]".to_owned()));
    let mine = tempfile::tempdir().expect("a directory");
    std::fs::write(mine.path().join("cases.csv"), "name,x\n").expect("a file");
    let out = mine.path().to_string_lossy().into_owned();
    let refused = run(&["run", "scenes/grease_guide.json", "--until", "0.01", "--out", &out]);
    assert!(text(&refused.stderr).contains("cases.csv: is not of this program"), "{}", text(&refused.stderr));
    assert_eq!(read(&mine.path().join("cases.csv")), "name,x\n");
    assert_eq!(std::fs::read_dir(mine.path()).expect("a folder").count(), 1);
}

#[test]
fn interrupted_starts_are_told() {
    let dir = tempfile::tempdir().expect("a directory");
    let mut child = cagedyn()
        .args(["run", "scenes/nu2310.json", "--until", "0.05", "--starts", "5000", "--out"])
        .arg(dir.path())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let start = Instant::now();
    while !dir.path().join("timeseries.csv").exists() {
        assert!(start.elapsed() < Duration::from_secs(120), "the first run never ended");
        std::thread::sleep(Duration::from_millis(20));
    }
    std::thread::sleep(Duration::from_millis(500));
    signal(&child, "INT");
    assert_eq!(child.wait().expect("it ends").code(), Some(130));
    let summary = json(&dir.path().join("summary.json"));
    assert_eq!((&summary["complete"], &summary["interrupted"]), (&false.into(), &true.into()));
    assert_eq!(summary["starts"]["asked"], 5000);
    assert!(summary["starts"]["count"].as_u64().is_some_and(|count| count < 5000));
    let shifted =
        ["run", "scenes/grease_guide.json", "--until", "0.01", "--starts", "2", "--start-shift", "1e-3"];
    let out = dir.path().join("out").to_string_lossy().into_owned();
    let output = run(&[&shifted[..], &["--out", &out]].concat());
    assert!(text(&output.stderr).contains("leaves no room"), "{}", text(&output.stderr));
}

#[test]
fn runs_end_where_they_are_told_to_and_windows_have_what_is_followed() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    let output = run(&[
        "run",
        "scenes/nu2310.json",
        "--until",
        "0.02",
        "--set",
        "record.interval=0.007",
        "--out",
        &out,
    ]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let times: Vec<String> =
        rows(&dir.path().join("timeseries.csv")).into_iter().skip(1).map(|row| row[0].clone()).collect();
    assert_eq!(times, ["0.0", "0.007", "0.014", "0.02"]);
    let summary = json(&dir.path().join("summary.json"));
    assert_eq!(summary["simulated_time_s"], 0.02);
    assert!(summary["pocket_forces"]["largest_n"].is_number(), "{summary}");
    let ramp = r#"inner_ring.speed={"ramp":{"from":0,"to":-314.159265,"start":0,"end":0.01}}"#;
    let output = run(&["run", "scenes/nu2310.json", "--until", "0.02", "--set", ramp, "--out", &out]);
    assert!(text(&output.stdout).contains("-3000 to 0 1/min"), "{}", text(&output.stdout));
}

#[test]
fn absurd_tables_are_refused_and_the_size_of_others_is_told() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().join("out").to_string_lossy().into_owned();
    let scene = ["run", "scenes/nu2310.json", "--until", "0.05", "--out", &out];
    let refused = run(&[&scene[..], &["--set", "record.interval=1e-9"]].concat());
    assert_eq!(refused.status.code(), Some(1));
    assert!(text(&refused.stderr).contains("--large-table"), "{}", text(&refused.stderr));
    assert!(!dir.path().join("out").exists(), "nothing was made");
    let set = ["--set", r#"record.channels=["cage.?"]"#, "--set", "record.extremes=[]"];
    let told = run(&[&scene[..], &set].concat());
    assert!(
        text(&told.stdout).starts_with("writing a table of 101 records in 3 columns"),
        "{}",
        text(&told.stdout)
    );
    assert_eq!(rows(&dir.path().join("out/timeseries.csv"))[0], ["time [s]", "cage.y [m]", "cage.z [m]"]);
}

#[test]
fn until_and_interval_are_checked_together() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    // The interval is longer than the run of the file, not than the one that is asked for.
    let longer =
        ["run", "scenes/grease_guide.json", "--until", "0.3", "--set", "record.interval=0.15", "--out", &out];
    assert!(run(&longer).status.success());
    let shorter = ["run", "scenes/grease_guide.json", "--until", "1e-5", "--out", &out];
    let output = run(&shorter);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("record.interval"), "{}", text(&output.stderr));
}

#[test]
fn failed_cases_have_their_error_instead_of_results() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name);
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    std::fs::copy(scenes.join("nu2310.json"), at("base.json")).expect("a copy");
    let set = serde_json::json!({"schema": "cagedyn.cases/1", "scene": "base.json", "cases": [
        {"name": "good", "set": {"inner_ring.radial_clearance": 5e-6}},
        {"name": "bad", "set": {"solver": {"max_steps": 10}}},
        {"name": "none", "set": {"inner_ring.radial_clearance": 4e-5, "title": "mine"}},
    ]});
    std::fs::write(at("set.cases.json"), set.to_string()).expect("a case set");
    let (file, out) = (at("set.cases.json"), at("out"));
    let output = run(&["cases", &file.to_string_lossy(), "--until", "2e-3", "--out", &out.to_string_lossy()]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stdout).lines().any(|line| line.starts_with("bad") && line.ends_with("failed")));
    let rows = rows(&at("out/cases.csv"));
    let column = |name: &str| {
        rows[0].iter().position(|cell| cell == name).unwrap_or_else(|| panic!("{name}: {rows:?}"))
    };
    let clearance = column("inner_ring.radial_clearance");
    assert_eq!([&rows[1][clearance], &rows[2][clearance], &rows[3][clearance]], ["5e-6", "", "0.00004"]);
    let mean = column("cage.eccentricity mean [1]");
    assert!(rows[1][mean].parse::<f64>().is_ok() && rows[2][mean].is_empty());
    assert!(rows[2][column("error")].contains("max_steps"), "{rows:?}");
    assert_eq!((&*rows[2][column("complete")], &*rows[1][column("complete")]), ("false", "true"));
    assert!(read(&at("out/good/cage_orbit.svg")).contains("good"));
    assert!(!read(&at("out/good/cage_orbit.svg")).contains("40 um"));
}

/// A dry guide of this friction rests from its own start and whirls from most others.
#[test]
fn several_starts_tell_which_motions_there_are() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    let scene = ["run", "scenes/grease_guide.json", "--until", "0.03", "--out", &out];
    let output =
        run(&[&scene[..], &["--starts", "5", "--start-shift", "1e-8", "--start-spin", "1e-4"]].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(
        text(&output.stdout).contains(
            "from 5 starts 1.000e-8 m and up to 0.01000 % of the cage speed apart: backward whirl 5 of 5"
        ),
        "{}",
        text(&output.stdout)
    );
    let summary = json(&dir.path().join("summary.json"));
    let starts = &summary["starts"];
    assert_eq!((&starts["count"], &starts["failed"]), (&5.into(), &0.into()));
    assert_eq!(
        (&starts["motions"][0]["motion"], &starts["motions"][0]["share"]),
        (&"backward_whirl".into(), &1.0.into())
    );
    let output = run(&[
        "run",
        "scenes/nu2310.json",
        "--until",
        "1e-3",
        "--set",
        "cage=null",
        "--out",
        &out,
        "--starts",
        "2",
    ]);
    assert!(text(&output.stderr).contains("no cage"), "{}", text(&output.stderr));
}

/// In the centre of the guide the whirl speed is noise of any size.
#[test]
fn whirl_speeds_near_the_centre_are_left_out() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    let output = run(&[
        "run",
        "scenes/grease_guide.json",
        "--until",
        "0.03",
        "--set",
        "gravity=null",
        "--set",
        "cage.pocket=null",
        "--out",
        &out,
    ]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let summary = json(&dir.path().join("summary.json"));
    assert_eq!(summary["whirl"]["motion"], "resting");
    assert!(summary["whirl"]["mean_speed_rad_per_s"].is_null(), "{}", summary["whirl"]);
    assert!(summary["statistics"].get("cage.whirl_speed").is_none());
    let table = rows(&dir.path().join("timeseries.csv"));
    let column = table[0].iter().position(|name| name.starts_with("cage.whirl_speed")).expect("a channel");
    assert!(table[1..].iter().all(|row| row[column].parse::<f64>().is_ok_and(f64::is_finite)));
    assert!(!read(&dir.path().join("whirl_history.svg")).contains("NaN"));
}

#[test]
fn the_spectrum_tells_its_resolution() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    assert!(run(&["run", "scenes/nu2310.json", "--until", "0.1", "--out", &out]).status.success());
    let svg = read(&dir.path().join("cage_spectrum.svg"));
    assert!(svg.contains("Hann window, resolution") && svg.contains("Hz"));
}

#[test]
fn the_limit_on_the_wall_time_covers_everything() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    let start = Instant::now();
    let scene = ["run", "scenes/nu2310.json", "--until", "500", "--large-table", "--out", &out];
    let output = run(&[&scene[..], &["--max-wall-time", "0.5", "--starts", "3"]].concat());
    assert!(start.elapsed() < Duration::from_secs(60));
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("wall time"), "{}", text(&output.stderr));
    let summary = json(&dir.path().join("summary.json"));
    assert_eq!(summary["complete"], false);
    assert!(summary["error"].as_str().is_some_and(|error| error.contains("wall time")));
    assert!(rows(&dir.path().join("timeseries.csv")).len() > 10);
    assert!(!dir.path().join("cage_orbit.svg").exists());
}
