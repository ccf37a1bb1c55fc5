//! Sweeps: tables of grids, lists and hypercubes; what is done is kept, whatever ends the program.
#![cfg(all(feature = "cli", unix))]

use crate::cli::{cagedyn, run, text};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

const SPEEDS: &str = "inner_ring.speed.constant=-100:-300:3";
const CLEARANCES: &str = "inner_ring.radial_clearance=2e-5,4e-5";

/// A sweep of the NU2310 over 2 ms.
fn sweep(out: &Path, arguments: &[&str]) -> Output {
    let out = out.to_string_lossy().into_owned();
    run(&[&["sweep", "scenes/nu2310.json", "--until", "2e-3", "--out", &out], arguments].concat())
}

pub fn succeeded(output: &Output) -> String {
    assert!(output.status.success(), "{}{}", text(&output.stdout), text(&output.stderr));
    assert!(text(&output.stderr).is_empty(), "{}", text(&output.stderr));
    text(&output.stdout)
}

/// Tables and picture, byte for byte.
fn files(out: &Path) -> [Vec<u8>; 3] {
    ["sweep.csv", "sweep.parquet", "sweep.svg"].map(|name| std::fs::read(out.join(name)).expect(name))
}

fn rows(out: &Path) -> Vec<csv::StringRecord> {
    let mut reader =
        csv::ReaderBuilder::new().has_headers(false).from_path(out.join("sweep.csv")).expect("a table");
    reader.records().map(|row| row.expect("a row")).collect()
}

fn column(rows: &[csv::StringRecord], name: &str) -> Vec<String> {
    let place =
        rows[0].iter().position(|cell| cell == name).unwrap_or_else(|| panic!("{name}: {:?}", rows[0]));
    rows[1..].iter().map(|row| row[place].to_owned()).collect()
}

#[test]
fn grids_give_one_row_for_every_combination_whatever_the_number_of_jobs() {
    let dir = tempfile::tempdir().expect("a directory");
    let [one, two] = ["1", "2"].map(|jobs| {
        let out = dir.path().join(jobs);
        succeeded(&sweep(&out, &["--vary", SPEEDS, "--vary", CLEARANCES, "--jobs", jobs]));
        out
    });
    assert!(files(&one) == files(&two));
    let rows = rows(&one);
    assert_eq!(column(&rows, "point"), ["0", "1", "2", "3", "4", "5"]);
    let speeds = ["-100", "-100", "-200", "-200", "-300", "-300"];
    assert_eq!(column(&rows, "inner_ring.speed.constant"), speeds);
    assert_eq!(column(&rows, "inner_ring.radial_clearance")[..2], ["0.00002", "0.00004"]);
    for (name, expected) in [("complete", "true"), ("trusted", "true"), ("error", ""), ("error code", "")] {
        assert_eq!(column(&rows, name), [expected; 6], "{name}");
    }
    // As a run of its own has them.
    let out = dir.path().join("run").to_string_lossy().into_owned();
    let sets = ["--set", "inner_ring.speed.constant=-200", "--set", "inner_ring.radial_clearance=4e-5"];
    let alone = run(&[&["run", "scenes/nu2310.json", "--until", "2e-3", "--out", &out], &sets[..]].concat());
    assert!(alone.status.success());
    let summary = crate::cli::json(&dir.path().join("run/summary.json"));
    for (name, pointer) in [
        ("cage.y_ratio mean [1]", "/statistics/cage.y_ratio/mean"),
        ("inner_ring.drag_torque 95 % [N m]", "/statistics/inner_ring.drag_torque/p95"),
        ("max roller slip [1]", "/max_roller_slip/value"),
    ] {
        let value = summary.pointer(pointer).unwrap_or_else(|| panic!("{pointer}: {summary}"));
        assert_eq!(column(&rows, name)[3], value.to_string(), "{name}");
    }
    let svg = text(&files(&one)[2]);
    assert!(svg.contains("|inner_ring.speed.constant| [1/min]") && svg.contains("fewer than three turns"));
    assert!(svg.contains("drag torque [N m]") && !svg.contains("NaN") && !svg.contains("4900 N, radial"));
}

#[test]
fn lists_take_words_and_objects_and_hypercubes_their_seed() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name);
    let list = r#"solver.method={"dormand_prince":{}},{"auto":{}}"#;
    let words = ["--set", "solver={}", "--vary", "solver.preset=draft,engineering", "--vary", SPEEDS];
    succeeded(&sweep(&at("words"), &words));
    let presets = column(&rows(&at("words")), "solver.preset");
    assert_eq!([&*presets[2], &*presets[3]], ["draft", "engineering"]);
    let svg = text(&files(&at("words"))[2]);
    assert!(svg.contains("engineering") && svg.contains("inner_ring.speed.constant"));
    succeeded(&sweep(&at("objects"), &["--set", "solver={}", "--vary", list]));
    let methods = column(&rows(&at("objects")), "solver.method");
    assert_eq!(methods, [r#"{"dormand_prince":{}}"#, r#"{"auto":{}}"#]);
    assert!(!at("objects/sweep.svg").exists());
    let cube = [
        "--vary",
        "inner_ring.speed.constant=-100:-300",
        "--vary",
        "inner_ring.radial_clearance=1e-6:1e-4:log",
    ];
    let of_seed = |name: &str, seed: &str| {
        let rows = sweep_of_cube(&at(name), &cube, seed);
        [column(&rows, "inner_ring.speed.constant"), column(&rows, "inner_ring.radial_clearance")]
    };
    let first = of_seed("first", "1");
    assert_eq!(first, of_seed("again", "1"));
    assert_ne!(first, of_seed("other", "2"));
    let mut speeds: Vec<f64> = first[0].iter().map(|text| -text.parse::<f64>().expect("a number")).collect();
    speeds.sort_by(f64::total_cmp);
    for (layer, speed) in speeds.iter().enumerate() {
        let from = 100.0 + 40.0 * layer as f64;
        assert!((from..from + 40.0).contains(speed), "{speeds:?}");
    }
}

fn sweep_of_cube(out: &Path, cube: &[&str], seed: &str) -> Vec<csv::StringRecord> {
    succeeded(&sweep(out, &[cube, &["--latin", "5", "--seed", seed]].concat()));
    rows(out)
}

fn points(out: &Path) -> usize {
    let names = std::fs::read_dir(out.join("points")).into_iter().flatten().flatten();
    names.filter(|entry| entry.file_name().to_string_lossy().ends_with(".json")).count()
}

/// Starts a sweep, ends it by a signal when some of its points are done, and gives their number.
pub fn ended(arguments: &[String], out: &Path, signal: &str, done: usize) -> (usize, Output) {
    let child = cagedyn()
        .args(arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let start = Instant::now();
    while points(out) < done {
        assert!(start.elapsed() < Duration::from_secs(300), "no point is done");
        std::thread::sleep(Duration::from_millis(2));
    }
    let sent = Command::new("sh").args(["-c", &format!("kill -{signal} {}", child.id())]).status();
    assert!(sent.is_ok_and(|status| status.success()));
    let output = child.wait_with_output().expect("it ends");
    (points(out), output)
}

/// 24 points of 20 ms.
fn long(out: &Path) -> Vec<String> {
    let vary = ["--vary", "inner_ring.speed.constant=-100:-300:12", "--vary", CLEARANCES];
    let scene = ["sweep", "scenes/nu2310.json", "--until", "0.02", "--out"].map(str::to_owned);
    scene.into_iter().chain([out.to_string_lossy().into_owned()]).chain(vary.map(str::to_owned)).collect()
}

#[test]
fn killed_and_interrupted_sweeps_go_on_to_the_same_bytes() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name);
    let whole = cagedyn().args(long(&at("whole"))).output().expect("it runs");
    succeeded(&whole);
    for (name, signal, done) in
        [("killed", "KILL", 1), ("killed later", "KILL", 9), ("interrupted", "INT", 3)]
    {
        let out = at(name);
        let (kept, output) = ended(&long(&out), &out, signal, done);
        assert!((done..24).contains(&kept), "{name}: {kept}");
        assert!(!out.join("sweep.csv").exists());
        if signal == "INT" {
            assert_eq!(output.status.code(), Some(130));
            let told = text(&output.stdout);
            assert!(
                told.contains(&format!("{kept} of 24 points are kept, and the same command goes on")),
                "{told}"
            );
            let table = std::fs::read_to_string(out.join("sweep.unfinished.csv")).expect("a table");
            assert_eq!(table.lines().count(), 1 + kept);
        }
        let kept_before: Vec<_> = (0..24).map(|i| modified(&out, i)).collect();
        let resumed = cagedyn().args(long(&out)).output().expect("it runs");
        assert!(succeeded(&resumed).contains(&format!("24 points, {kept} of them done")));
        assert!(files(&out) == files(&at("whole")), "{name}");
        assert!(!out.join("sweep.unfinished.csv").exists());
        for (i, before) in kept_before.into_iter().enumerate().filter(|(_, before)| before.is_some()) {
            assert_eq!(before, modified(&out, i), "point {i} was run again");
        }
    }
    // A point that was cut off in its middle is run again.
    std::fs::write(at("whole/points/00007.json"), "{\"values\": [").expect("written");
    let before = files(&at("whole"));
    let resumed = cagedyn().args(long(&at("whole"))).output().expect("it runs");
    assert!(succeeded(&resumed).contains("23 of them done"));
    assert!(files(&at("whole")) == before);
}

fn modified(out: &Path, point: usize) -> Option<std::time::SystemTime> {
    let path = out.join(format!("points/{point:05}.json"));
    std::fs::metadata(path).ok().map(|data| data.modified().expect("a time"))
}

#[test]
fn folders_of_others_are_refused_and_mistakes_told_before_the_first_run() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().join("out");
    succeeded(&sweep(&out, &["--vary", SPEEDS]));
    let before = files(&out);
    let foreign = dir.path().join("foreign");
    std::fs::create_dir(&foreign).expect("a folder");
    std::fs::write(foreign.join("sweep.csv"), "mine\n").expect("a file");
    for (folder, arguments, expected) in [
        (
            &out,
            vec!["--vary", CLEARANCES],
            "has another sweep (vary was [\"inner_ring.speed.constant=-100:-300:3\"])",
        ),
        (&out, vec!["--vary", SPEEDS, "--set", "gravity=null"], "has another sweep (set was [])"),
        (&out, vec!["--vary", SPEEDS, "--preset", "draft"], "has another sweep (preset was null)"),
        (&foreign, vec!["--vary", SPEEDS], "sweep.csv: is not of a sweep"),
        (&foreign, vec!["--vary", "rollers.radiuss=1:2:3"], "rollers.radiuss"),
        (&foreign, vec!["--vary", "solver.method=auto,leapfrogg", "--set", "solver={}"], "solver.method"),
        (
            &foreign,
            vec!["--vary", "rollers.radius=1:2:3"],
            "no point can be simulated; point 0 (rollers.radius = 1)",
        ),
        (&foreign, vec!["--vary", SPEEDS, "--vary", SPEEDS], "varied twice"),
        (&foreign, vec!["--vary", "record.duration=1e-3:2e-3:2"], "--until"),
        (&foreign, vec!["--vary", "gravity.z=1:2:20000", "--vary", SPEEDS], "20000 x 3 points, at most"),
    ] {
        let output = sweep(folder, &arguments);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {message}");
        assert!(message.contains(expected) && message.lines().count() == 1, "{arguments:?}: {message}");
    }
    for arguments in [
        &["--vary", "gravity.z=1"][..],
        &["--vary", "gravity.z=1:2:1"],
        &[],
        &["--vary", SPEEDS, "--seed", "1"],
    ] {
        assert_eq!(sweep(&foreign, arguments).status.code(), Some(2), "{arguments:?}");
    }
    assert!(files(&out) == before);
    assert_eq!(std::fs::read_dir(&foreign).expect("a folder").count(), 1);
    // The same file by another name is the same sweep.
    let scene = dir.path().join("renamed.json");
    std::fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/nu2310.json"), &scene).expect("a copy");
    let (scene, folder) = (scene.to_string_lossy().into_owned(), out.to_string_lossy().into_owned());
    let same = run(&["sweep", &scene, "--until", "2e-3", "--out", &folder, "--vary", SPEEDS]);
    assert!(succeeded(&same).contains("3 of them done"));
}

#[test]
fn failures_are_rows_with_their_error() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().join("out");
    let failing = [
        "--vary",
        "solver.max_steps=10,1000000",
        "--vary",
        "inner_ring.radial_clearance=2e-5,-1",
        "--set",
        "solver={}",
    ];
    let output = sweep(&out, &failing);
    assert_eq!(output.status.code(), Some(1));
    let message = text(&output.stderr);
    assert!(
        message.contains("3 of 4 points failed; point 0 (solver.max_steps = 10,")
            && message.lines().count() == 1,
        "{message}"
    );
    let rows = rows(&out);
    assert_eq!(column(&rows, "complete"), ["false", "false", "true", "false"]);
    assert_eq!(column(&rows, "trusted"), ["", "", "true", ""]);
    assert_eq!(column(&rows, "error code"), ["ERR_TOO_MANY_STEPS", "ERR_BAD_SCENE", "", "ERR_BAD_SCENE"]);
    assert!(column(&rows, "error")[0].contains("max_steps"));
    let means = column(&rows, "cage.y_ratio mean [1]");
    assert_eq!(means.iter().map(|cell| cell.is_empty()).collect::<Vec<_>>(), [true, true, false, true]);
    assert!(column(&rows, "simulated time [s]")[1].is_empty());
    // They are done, too.
    assert!(text(&sweep(&out, &failing).stdout).contains("4 points, 4 of them done"));
}

#[test]
fn points_that_cannot_be_written_end_the_sweep_and_cost_no_other() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name);
    let arguments = ["--vary", "inner_ring.speed.constant=-100:-300:6", "--jobs", "1"];
    succeeded(&sweep(&at("whole"), &arguments));
    let out = at("out");
    std::fs::create_dir_all(&out).expect("a folder");
    std::fs::copy(at("whole/sweep.json"), out.join("sweep.json")).expect("a copy");
    std::fs::create_dir_all(out.join("points/00003.json")).expect("a folder in the way");
    let output = sweep(&out, &arguments);
    assert_eq!(output.status.code(), Some(1));
    let message = text(&output.stderr);
    assert!(message.contains("00003.json") && message.contains("of 6 points are kept"), "{message}");
    assert_eq!(message.lines().count(), 1, "{message}");
    let kept = (0..6).filter(|i| out.join(format!("points/{i:05}.json")).is_file()).count();
    assert!(message.contains(&format!("{kept} of 6")), "{kept}: {message}");
    std::fs::remove_dir(out.join("points/00003.json")).expect("removed");
    assert!(succeeded(&sweep(&out, &arguments)).contains(&format!("{kept} of them done")));
    assert!(files(&out) == files(&at("whole")));
    // A file in place of the folder, and a limit on the size of files as on a full disk.
    let refused = sweep(Path::new("README.md/x"), &arguments);
    assert!(text(&refused.stderr).contains("README.md/x") && refused.status.code() == Some(1));
    let command = format!(
        "ulimit -f 16; exec '{}' sweep scenes/nu2310.json --until 2e-3 --out '{}' --vary {}",
        env!("CARGO_BIN_EXE_cagedyn"),
        at("full").display(),
        arguments[1]
    );
    let full = Command::new("sh").current_dir(env!("CARGO_MANIFEST_DIR")).args(["-c", &command]).output();
    let full = full.expect("a shell");
    let message = text(&full.stderr);
    assert_eq!(full.status.code(), Some(1), "{message}");
    assert!(message.contains("points/0") && message.contains("0 of 6 points are kept"), "{message}");
    succeeded(&sweep(&at("full"), &arguments));
    assert!(files(&at("full")) == files(&at("whole")));
}
