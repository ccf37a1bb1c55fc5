//! Time series in the formats of other programs: what they read is what the table of comma-separated values has. Python with pandas
//! and scipy, and Octave, are told of if they are missing; with `CAGEDYN_REQUIRE_ALL_HOSTS=1` that is a failure.
#![cfg(feature = "cli")]

use crate::c_programs::succeed;
use crate::cli::{json, run, text};
use crate::hosts::present;
use std::path::Path;
use std::process::Command;

const ALL_HOSTS: [&str; 1] = ["CAGEDYN_REQUIRE_ALL_HOSTS"];

/// A run of the NU2310 over 20 ms.
fn run_with(out: &Path, arguments: &[&str]) {
    let out = out.to_string_lossy().into_owned();
    let output = run(&[&["run", "scenes/nu2310.json", "--until", "0.02", "--out", &out], arguments].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
}

#[test]
fn formats_are_files_beside_or_instead_of_the_table() {
    let dir = tempfile::tempdir().expect("a directory");
    let there = |arguments: &[&str]| {
        run_with(dir.path(), arguments);
        let summary = json(&dir.path().join("summary.json"));
        let listed = summary["files"].as_array().expect("a list").clone();
        ["csv", "parquet", "mat"].map(|ending| {
            let name = format!("timeseries.{ending}");
            let exists = dir.path().join(&name).exists();
            assert_eq!(listed.contains(&name.into()), exists, "{listed:?}");
            exists
        })
    };
    assert_eq!(there(&[]), [true, false, false]);
    assert_eq!(there(&["--format", "csv,parquet,mat"]), [true, true, true]);
    assert_eq!(there(&["--format", "mat"]), [false, false, true]);
    assert_eq!(there(&["--format", "parquet", "--format", "csv"]), [true, true, false]);
    // What cannot be written costs no record.
    std::fs::create_dir(dir.path().join("timeseries.mat")).expect("a folder in the way");
    let out = dir.path().to_string_lossy().into_owned();
    let output = run(&["run", "scenes/nu2310.json", "--until", "0.02", "--out", &out, "--format", "mat"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("timeseries.mat"), "{}", text(&output.stderr));
    assert!(dir.path().join("timeseries.csv").exists());
    let unknown = run(&["run", "scenes/nu2310.json", "--out", &out, "--format", "hdf5"]);
    assert_eq!(unknown.status.code(), Some(2));
}

#[test]
fn pandas_and_scipy_read_the_numbers_of_the_table() {
    let python = std::env::var_os("CAGEDYN_PYTHON").unwrap_or("python3".into());
    if !present(Path::new(&python), &["-c", "import pandas, pyarrow, scipy.io"], &ALL_HOSTS) {
        return;
    }
    let dir = tempfile::tempdir().expect("a directory");
    run_with(dir.path(), &["--format", "csv,parquet,mat"]);
    let sweep = dir.path().join("sweep").to_string_lossy().into_owned();
    let vary = ["--vary", "solver.max_steps=10,1000000", "--set", "solver={}", "--until", "2e-3"];
    run(&[&["sweep", "scenes/nu2310.json", "--out", &sweep], &vary[..]].concat());
    let script = r#"
import pandas, scipy.io, sys
read = lambda name: pandas.read_csv(name, float_precision="round_trip")
table, parquet = read("timeseries.csv"), pandas.read_parquet("timeseries.parquet")
assert list(table.columns) == list(parquet.columns) and len(table) == 41
assert (table.values == parquet.values).all() and (parquet.dtypes == "float64").all()
mat = scipy.io.loadmat("timeseries.mat", squeeze_me=True)
names = [name for name in mat if not name.startswith("__") and name != "units"]
assert len(names) == len(table.columns)
for name, column in zip(names, table.columns):
    assert (mat[name] == table[column].values).all(), column
    assert str(mat["units"][name]) == column[column.rindex("[") + 1:-1], column
assert (mat["cage_y_ratio"] == table["cage.y_ratio [1]"]).all() and "roller_11_slip" in names
table, parquet = read("sweep/sweep.csv"), pandas.read_parquet("sweep/sweep.parquet")
assert list(table.columns) == list(parquet.columns) and len(table) == 2
assert list(parquet["complete"]) == [False, True] and parquet["trusted"].isna()[0]
assert parquet["error code"][0] == "ERR_TOO_MANY_STEPS" and parquet["error code"].isna()[1]
assert (parquet["cage.y_ratio mean [1]"][1:] == table["cage.y_ratio mean [1]"][1:]).all()
assert parquet["point"].dtype == "int64"
print("all the same")
"#;
    let output = succeed(Command::new(python).args(["-c", script]).current_dir(dir.path()));
    assert!(text(&output.stdout).contains("all the same"));
}

#[test]
fn octave_reads_the_numbers_of_the_table() {
    if !present(Path::new("octave-cli"), &["--version"], &ALL_HOSTS) {
        return;
    }
    let dir = tempfile::tempdir().expect("a directory");
    run_with(dir.path(), &["--format", "csv,mat"]);
    let script = r#"
s = load('timeseries.mat');
t = dlmread('timeseries.csv', ',', 1, 0);
names = setdiff(fieldnames(s), {'units'}, 'stable');
assert(numel(names), columns(t));
for k = 1:numel(names)
  x = s.(names{k});
  assert(size(x), [41, 1]);
  assert(max(abs(x - t(:, k))) <= 1e-14 * max(abs(x)));
end
assert(s.units.cage_y, 'm'); assert(s.units.time, 's'); assert(s.units.roller_0_slip, '1');
disp('all the same');
"#;
    let output =
        succeed(Command::new("octave-cli").args(["--norc", "--eval", script]).current_dir(dir.path()));
    assert!(text(&output.stdout).contains("all the same"), "{}", text(&output.stdout));
}
