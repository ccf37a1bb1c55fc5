//! Case sets: what is done is not run again, whatever ended the program.
#![cfg(all(feature = "cli", unix))]

use crate::cli::{cagedyn, json, run, text};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant, SystemTime};

const NAMES: [&str; 5] = ["slow", "fast", "bad", "tight", "loose"];

/// A set of five cases of 20 ms, one of which fails, with this clearance of the last.
fn write_set(folder: &Path, clearance: f64) -> String {
    let base = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/nu2310.json");
    let sets = [
        serde_json::json!({"inner_ring.speed.constant": -100.0}),
        serde_json::json!({"inner_ring.speed.constant": -400.0}),
        serde_json::json!({"solver": {"max_steps": 10}}),
        serde_json::json!({"inner_ring.radial_clearance": 5e-6}),
        serde_json::json!({"inner_ring.radial_clearance": clearance}),
    ];
    let cases: Vec<_> =
        NAMES.iter().zip(sets).map(|(name, set)| serde_json::json!({"name": name, "set": set})).collect();
    let set = serde_json::json!({"schema": "cagedyn.cases/1", "scene": base, "cases": cases});
    let file = folder.join("set.cases.json");
    std::fs::write(&file, set.to_string()).expect("a case set");
    file.to_string_lossy().into_owned()
}

fn arguments(file: &str, out: &Path, more: &[&str]) -> Vec<String> {
    let out = out.to_string_lossy();
    let all = ["cases", file, "--until", "0.02", "--out", &out].into_iter().chain(more.iter().copied());
    all.map(str::to_owned).collect()
}

fn cases(file: &str, out: &Path, more: &[&str]) -> Output {
    let arguments = arguments(file, out, more);
    run(&arguments.iter().map(String::as_str).collect::<Vec<_>>())
}

/// Times at which the summaries of all cases were written.
fn written(out: &Path) -> Vec<Option<SystemTime>> {
    let time = |name: &&str| std::fs::metadata(out.join(name).join("summary.json")).ok()?.modified().ok();
    NAMES.iter().map(time).collect()
}

/// The comparison without its wall times, the picture, and the tables of all cases.
fn results(out: &Path) -> (Vec<Vec<String>>, String, Vec<String>) {
    let mut reader =
        csv::ReaderBuilder::new().has_headers(false).from_path(out.join("cases.csv")).expect("a table");
    let rows: Vec<_> = reader.records().map(|row| row.expect("a row")).collect();
    let wall = rows[0].iter().position(|cell| cell == "wall time [s]").expect("wall times");
    let kept = |row: &csv::StringRecord| {
        row.iter().enumerate().filter(|(k, _)| *k != wall).map(|(_, cell)| cell.to_owned()).collect()
    };
    let read = |path: &Path| std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{path:?}: {e}"));
    let tables = NAMES.iter().map(|name| read(&out.join(name).join("timeseries.csv"))).collect();
    (rows.iter().map(kept).collect(), read(&out.join("cage_positions.svg")), tables)
}

#[test]
fn cases_that_are_done_are_not_run_again() {
    let dir = tempfile::tempdir().expect("a directory");
    let (file, out) = (write_set(dir.path(), 6e-5), dir.path().join("out"));
    let first = cases(&file, &out, &["--jobs", "2"]);
    assert_eq!(first.status.code(), Some(1), "{}", text(&first.stderr));
    assert!(!text(&first.stdout).contains("of them done"));
    let (before, times) = (results(&out), written(&out));
    // How much the cage moves about its mean, and how short the runs are.
    assert!(before.1.contains("bars from the 5th to the 95th percentile"));
    let printed = text(&first.stdout);
    let turns = before.0[0].iter().position(|cell| cell == "cage turns [1]").expect("turns");
    let few =
        before.0[1..].iter().filter(|row| row[turns].parse().is_ok_and(|turns: f64| turns < 3.0)).count();
    assert_eq!((few, printed.matches("turns of the cage").count()), (4, 4), "{printed}");
    let whole_table = std::fs::read(out.join("cases.csv")).expect("a table");
    let again = cases(&file, &out, &["--jobs", "1"]);
    // The failure is kept and told, too.
    assert_eq!((again.status.code(), &again.stderr), (Some(1), &first.stderr));
    assert!(text(&again.stderr).contains("case bad: ") && text(&again.stderr).lines().count() == 1);
    assert!(text(&again.stdout).starts_with("5 cases, 5 of them done\n"), "{}", text(&again.stdout));
    assert!(text(&again.stdout).ends_with(&text(&first.stdout)), "{}", text(&again.stdout));
    assert!(written(&out) == times && results(&out) == before);
    assert!(std::fs::read(out.join("cases.csv")).expect("a table") == whole_table, "with its wall times");
    // One whose scene differs is run again, one whose files are not there, and one whose files are not its own.
    let file = write_set(dir.path(), 3e-5);
    std::fs::remove_file(out.join("slow/cage_orbit.svg")).expect("removed");
    let fast = out.join("fast");
    let other = ["run", "scenes/nu2310.json", "--until", "0.01", "--out", &fast.to_string_lossy()];
    assert!(run(&other).status.success());
    let changed = cases(&file, &out, &[]);
    assert!(text(&changed.stdout).starts_with("5 cases, 2 of them done\n"), "{}", text(&changed.stdout));
    let now = written(&out);
    assert_eq!([2, 3].map(|k| now[k] == times[k]), [true; 2]);
    assert_eq!([0, 1, 4].map(|k| now[k] == times[k]), [false; 3]);
    assert_eq!(json(&fast.join("summary.json"))["case"], "fast");
    let after = results(&out);
    assert!(after.2[..4] == before.2[..4] && after.2[4] != before.2[4]);
    // Other options, other results: all of them.
    let other = cases(&file, &out, &["--preset", "draft"]);
    assert!(!text(&other.stdout).contains("of them done"));
    // A run in the folder leaves nothing of the set, so nothing of it is taken for done.
    let out_text = out.to_string_lossy().into_owned();
    assert!(run(&["run", "scenes/nu2310.json", "--until", "0.01", "--out", &out_text]).status.success());
    assert!(!out.join(".cases").exists() && !out.join("tight").exists());
}

#[test]
fn sets_that_were_killed_go_on_to_the_same_results_for_any_number_of_jobs() {
    let dir = tempfile::tempdir().expect("a directory");
    let (file, whole) = (write_set(dir.path(), 6e-5), dir.path().join("whole"));
    cases(&file, &whole, &["--jobs", "1"]);
    for (signal, jobs) in [("KILL", "1"), ("INT", "2")] {
        let out = dir.path().join(signal);
        let mut child = cagedyn()
            .args(arguments(&file, &out, &["--jobs", jobs]))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        let records = || {
            let names = std::fs::read_dir(out.join(".cases")).into_iter().flatten().flatten();
            names.filter(|entry| entry.file_name().to_string_lossy().ends_with(".json")).count()
        };
        let start = Instant::now();
        while records() < 2 {
            assert!(start.elapsed() < Duration::from_secs(300), "no case is done");
            std::thread::sleep(Duration::from_millis(2));
        }
        let sent = Command::new("sh").args(["-c", &format!("kill -{signal} {}", child.id())]).status();
        assert!(sent.is_ok_and(|status| status.success()));
        child.wait().expect("it ends");
        let (kept, times) = (records(), written(&out));
        let resumed = cases(&file, &out, &["--jobs", jobs]);
        let told = text(&resumed.stdout);
        assert!(told.starts_with(&format!("5 cases, {kept} of them done\n")), "{told}");
        assert!(results(&out) == results(&whole), "{signal}");
        let unchanged = written(&out).iter().zip(&times).filter(|(now, then)| now == then).count();
        assert!(unchanged >= kept, "{unchanged} of {kept} were not run again");
    }
}

/// Killed before its first case is done, a case set has its table.
#[test]
fn a_case_set_has_a_table_from_the_start() {
    let dir = tempfile::tempdir().expect("a directory");
    let mut child = cagedyn()
        .args(["cases", "scenes/nu2310_fig9.cases.json", "--until", "500", "--large-table", "--out"])
        .arg(dir.path())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let start = Instant::now();
    // The folder of the records begins with a point and is there before.
    let of_case = |entry: &std::fs::DirEntry| {
        entry.path().is_dir() && !entry.file_name().as_encoded_bytes().starts_with(b".")
    };
    while std::fs::read_dir(dir.path()).map_or(0, |entries| entries.flatten().filter(of_case).count()) == 0 {
        assert!(start.elapsed() < Duration::from_secs(120), "no case begins");
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().expect("killed");
    child.wait().expect("it ends");
    let table = std::fs::read_to_string(dir.path().join("cases.csv")).expect("a table");
    assert!(
        table.starts_with("case,inner ring speed [1/min],inner_ring.") && table.lines().count() == 1,
        "{table}"
    );
}
