//! Sweeps in parts, as on several machines: merged they are the whole sweep, byte for byte.
#![cfg(all(feature = "cli", unix))]

use crate::cli::{cagedyn, json, run, text};
use crate::common::read;
use crate::docs::fenced;
use crate::sweep::{ended, succeeded};
use std::collections::BTreeMap;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const SPEEDS: &str = "inner_ring.speed.constant=-100:-300:3";
const CLEARANCES: &str = "inner_ring.radial_clearance=2e-5,4e-5";
const GRID: [&str; 4] = ["--vary", SPEEDS, "--vary", CLEARANCES];

/// A sweep of the NU2310 over 2 ms.
fn sweep(out: &Path, arguments: &[&str]) -> Output {
    sweep_of(Path::new("scenes/nu2310.json"), out, &[arguments, &["--until", "2e-3"]].concat())
}

fn sweep_of(scene: &Path, out: &Path, arguments: &[&str]) -> Output {
    let mut command = cagedyn();
    command.arg("sweep").arg(scene).args(arguments).arg("--out").arg(out).output().expect("it runs")
}

fn merge(parts: &[PathBuf], out: &Path) -> Output {
    cagedyn().arg("merge").args(parts).arg("--out").arg(out).output().expect("it runs")
}

/// The message of a command that refuses in one line and exits with 1.
fn refused(output: &Output) -> String {
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert_eq!(message.lines().count(), 1, "{message}");
    message
}

/// All files of a folder and those in it, by their names.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut files = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(inside) = folders.pop() {
        for entry in std::fs::read_dir(&inside).expect("a folder").flatten() {
            if entry.path().is_dir() {
                folders.push(entry.path());
            } else {
                let name = entry.path().strip_prefix(folder).expect("inside").to_owned();
                files.insert(name, std::fs::read(entry.path()).expect("readable"));
            }
        }
    }
    files
}

fn assert_same(found: &Path, expected: &Path) {
    let (found, expected) = (files(found), files(expected));
    assert_eq!(found.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
    for (name, content) in &expected {
        assert!(&found[name] == content, "{} differs", name.display());
    }
}

/// Runs a sweep as a whole and in so many parts, merges these from last to first, and gives the names of all files.
fn whole_and_merged(scene: &Path, dir: &Path, arguments: &[&str], count: usize) -> Vec<String> {
    let whole = dir.join("whole");
    succeeded(&sweep_of(scene, &whole, arguments));
    let parts: Vec<PathBuf> = (1..=count).rev().map(|number| dir.join(number.to_string())).collect();
    for (folder, number) in parts.iter().zip((1..=count).rev()) {
        let part = format!("{number}/{count}");
        let told = succeeded(&sweep_of(scene, folder, &[arguments, &["--part", &part]].concat()));
        assert!(told.starts_with(&format!("part {part}: ")) && told.contains("sweep.part.csv"), "{told}");
        assert!(!folder.join("sweep.csv").exists() && !folder.join("sweep.svg").exists());
    }
    succeeded(&merge(&parts, &dir.join("merged")));
    assert_same(&dir.join("merged"), &whole);
    files(&whole).keys().map(|name| name.to_string_lossy().into_owned()).collect()
}

#[test]
fn merged_parts_are_the_whole_sweep() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name);
    // Six points are no four equal parts, and numbers have more digits than readers of JSON keep for sure.
    let scene = at("bearing.json");
    let digits = read("scenes/nu2310.json").replace("\"mass\": 0.37", "\"mass\": 0.30000000000000004");
    std::fs::write(&scene, digits).expect("written");
    let names = whole_and_merged(
        &scene,
        &at("grid"),
        &[&GRID[..], &["--preset", "draft", "--until", "2.0000000000000004e-3", "--set", "gravity=null"]]
            .concat(),
        4,
    );
    for name in ["sweep.csv", "sweep.parquet", "sweep.svg", "sweep.json", "points/00005.json"] {
        assert!(names.iter().any(|found| found == name), "{name}: {names:?}");
    }
    let mut table = csv::Reader::from_path(at("grid/2/sweep.part.csv")).expect("a table");
    let points: Vec<String> = table.records().map(|row| row.expect("a row")[0].to_owned()).collect();
    assert_eq!(points, ["1", "5"]);
    assert_eq!(json(&at("grid/2/sweep.json"))["part"], "2/4");

    let range = "inner_ring.speed.constant=-100:-300";
    let cube = ["--vary", range, "--latin", "5", "--seed", "7", "--until", "1e-3"];
    whole_and_merged(&scene, &at("cube"), &cube, 5);

    let lines = ["--vary", SPEEDS, "--until", "0.03", "--set", "record.interval=5e-5"];
    let names = whole_and_merged(&scene, &at("lines"), &lines, 2);
    assert!(names.contains(&"spectra.csv".to_owned()) && names.contains(&"waterfall.svg".to_owned()));
    // What is merged is a sweep, which can be merged again and is done.
    succeeded(&merge(&[at("lines/1"), at("lines/2")], &at("lines/merged")));
    assert!(succeeded(&sweep_of(&scene, &at("lines/merged"), &lines)).contains("3 points, 3 of them done"));
}

#[test]
fn failed_points_are_rows_of_the_merged_sweep_too() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name);
    let failing = ["--vary", "solver.max_steps=10,1000000", "--vary", CLEARANCES, "--set", "solver={}"];
    let whole = refused(&sweep(&at("whole"), &failing));
    assert!(whole.contains("2 of 4 points failed; point 0 (solver.max_steps = 10,"), "{whole}");
    let part = |number: usize| {
        let part = format!("{number}/2");
        refused(&sweep(&at(&number.to_string()), &[&failing[..], &["--part", &part]].concat()))
    };
    assert!(part(1).contains("1 of 2 points failed; point 0 (") && part(2).contains("point 1 ("));
    let merged = merge(&[at("1"), at("2")], &at("merged"));
    assert_eq!(refused(&merged), whole.replace("scenes/nu2310.json", "nu2310.json"));
    assert_same(&at("merged"), &at("whole"));
}

#[test]
fn a_killed_part_is_named_and_goes_on_to_the_same_bytes() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name);
    let long = |name: &str, more: &[&str]| {
        let vary = ["--vary", "inner_ring.speed.constant=-100:-300:12", "--vary", CLEARANCES];
        let fixed = [&["sweep", "scenes/nu2310.json", "--until", "0.02"][..], &vary, more].concat();
        let out = ["--out".to_owned(), at(name).to_string_lossy().into_owned()];
        fixed.into_iter().map(str::to_owned).chain(out).collect::<Vec<String>>()
    };
    let done = |arguments: Vec<String>| succeeded(&cagedyn().args(arguments).output().expect("it runs"));
    done(long("whole", &[]));
    done(long("1", &["--part", "1/2"]));
    let second = || long("2", &["--part", "2/2"]);
    let (kept, _) = ended(&second(), &at("2"), "KILL", 2);
    assert!((2..12).contains(&kept), "{kept}");
    let message = refused(&merge(&[at("1"), at("2")], &at("merged")));
    assert!(
        message.starts_with(&format!("cagedyn: missing: {} of 24 points, first ", 12 - kept)),
        "{message}"
    );
    assert!(message.ends_with("; run part 2/2 again\n") && !at("merged").exists(), "{message}");
    let (kept, interrupted) = ended(&second(), &at("2"), "INT", kept + 1);
    assert_eq!(interrupted.status.code(), Some(130));
    assert!(text(&interrupted.stdout).contains(&format!("{kept} of 12 points are kept")));
    assert!(done(second()).contains(&format!("part 2/2: 12 points, {kept} of them done")));
    assert!(!at("2/sweep.unfinished.csv").exists());
    succeeded(&merge(&[at("1"), at("2")], &at("merged")));
    assert_same(&at("merged"), &at("whole"));
}

#[test]
fn what_is_no_whole_of_one_sweep_is_refused() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name);
    let make = |name: &str, arguments: &[&str]| succeeded(&sweep(&at(name), arguments));
    let of_grid = |name: &str, part: &str, more: &[&str]| {
        make(name, &[&GRID[..], &["--part", part], more].concat());
    };
    for (name, part) in [("a", "1/3"), ("b", "2/3"), ("c", "3/3"), ("b again", "2/3"), ("halved", "2/2")] {
        of_grid(name, part, &[]);
    }
    of_grid("set", "2/3", &["--set", "gravity=null"]);
    of_grid("draft", "2/3", &["--preset", "draft"]);
    make("vary", &["--vary", SPEEDS, "--part", "2/3"]);
    make("whole", &GRID);
    std::fs::create_dir(at("empty")).expect("a folder");
    // A scene of this name that is another, and this scene under another name.
    std::fs::create_dir(at("scenes")).expect("a folder");
    let scene = read("scenes/nu2310.json");
    std::fs::write(at("scenes/nu2310.json"), scene.replace("\"mass\": 0.37", "\"mass\": 0.38"))
        .expect("written");
    std::fs::write(at("scenes/renamed.json"), &scene).expect("written");
    for (name, file) in [("scene", "nu2310.json"), ("renamed", "renamed.json")] {
        let part = [&GRID[..], &["--part", "2/3", "--until", "2e-3"]].concat();
        succeeded(&sweep_of(&at("scenes").join(file), &at(name), &part));
    }
    // As another version of the program leaves it.
    of_grid("older", "2/3", &[]);
    let older = json(&at("older/sweep.json")).to_string().replace(env!("CARGO_PKG_VERSION"), "0.0.1");
    std::fs::write(at("older/sweep.json"), older).expect("written");
    for (parts, expected) in [
        (vec!["a", "set", "c"], "set: is of another sweep than a (set is [\"gravity=null\"], not [])"),
        (vec!["a", "draft", "c"], "draft: is of another sweep than a (preset is \"draft\", not null)"),
        (vec!["a", "b", "vary"], "vary: is of another sweep than a (vary is"),
        (vec!["a", "scene", "c"], "scene: is of another sweep than a (the scene differs)"),
        (vec!["a", "renamed", "c"], "(scene_file is \"renamed.json\", not \"nu2310.json\")"),
        (vec!["a", "halved", "c"], "halved: is of another sweep than a (part is 2/2, not one of 3)"),
        (
            vec!["a", "older", "c"],
            "older/sweep.json: version is \"0.0.1\"; this program merges \"0.1.0\" only",
        ),
        (vec!["a", "whole"], "whole: has a whole sweep; merged are folders of sweep --part K/N"),
        (vec!["a", "empty"], "empty/sweep.json: No such file"),
        (vec!["a", "b", "c", "b again"], "b again: twice: 2 of 6 points, first 1; b is part 2/3, too"),
        (vec!["a", "a"], "a: twice: 2 of 6 points, first 0; a is part 1/3, too"),
        (vec!["c"], "missing: 4 of 6 points, first 0; give parts 1,2 of 3, too"),
    ] {
        let folders: Vec<PathBuf> = parts.iter().map(|name| at(name)).collect();
        let message = refused(&merge(&folders, &at("merged")));
        let brief = message.replace(&format!("{}/", dir.path().display()), "");
        assert!(brief.contains(expected), "{parts:?}: {brief}");
        assert!(!at("merged").exists(), "{parts:?}");
    }
    // A point that is gone, and one that was cut off in its middle.
    std::fs::remove_file(at("c/points/00002.json")).expect("removed");
    std::fs::write(at("b/points/00004.json"), "{\"values\": [").expect("written");
    let parts = ["a", "b", "c"].map(at);
    let message = refused(&merge(&parts, &at("merged")));
    assert_eq!(message, "cagedyn: missing: 2 of 6 points, first 2; run parts 2,3 of 3 again\n");
    let message = refused(&merge(&parts[1..], &at("merged")));
    assert_eq!(
        message,
        "cagedyn: missing: 4 of 6 points, first 0; run parts 2,3 of 3 again; give part 1/3, too\n"
    );
    of_grid("b", "2/3", &[]);
    of_grid("c", "3/3", &[]);
    // Folders of other sweeps stay as they are.
    for (output, expected) in [
        (merge(&parts, &at("b")), "b: has another sweep (part was \"2/3\")"),
        (sweep(&at("b"), &GRID), "b: has another sweep (part was \"2/3\")"),
        (
            sweep(&at("b"), &[&GRID[..], &["--part", "1/3"]].concat()),
            "b: has another sweep (part was \"2/3\")",
        ),
        (
            sweep(&at("whole"), &[&GRID[..], &["--part", "1/3"]].concat()),
            "whole: has another sweep (part was null)",
        ),
    ] {
        let message = refused(&output);
        assert!(message.contains(expected), "{message}");
    }
    succeeded(&merge(&parts, &at("merged")));
    assert_same(&at("merged"), &at("whole"));
}

#[test]
fn parts_that_cannot_be_are_told_with_what_is_allowed() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().join("out");
    for bad in ["0/4", "5/4", "x", "1/0", "1/20001"] {
        let output = sweep(&out, &[&GRID[..], &["--part", bad]].concat());
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{bad}: {message}");
        let told = message.lines().next().unwrap_or_default();
        let allowed = "must have the form K/N, with N from 1 to 20000 and K from 1 to N";
        assert!(
            told.contains("--part <K/N>") && told.contains(bad) && told.ends_with(allowed),
            "{bad}: {told}"
        );
    }
    let message = refused(&sweep(&out, &[&GRID[..], &["--part", "7/8"]].concat()));
    assert_eq!(message, "cagedyn: --part: 7/8 of 6 points; at most as many parts as points\n");
    assert!(!out.exists());
    assert_eq!(run(&["merge", "--out", "x"]).status.code(), Some(2));
}

/// The job scripts of the page, every other task by SLURM's and PBS's, give parts of one sweep.
#[test]
fn job_scripts_of_the_page_make_one_sweep() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name);
    let scripts = fenced(&read("docs/studies-cli.md"), "sh");
    let [slurm, pbs, merge] = &scripts[..] else { panic!("{scripts:?}") };
    std::fs::create_dir(at("scenes")).expect("a folder");
    std::fs::write(at("scenes/nu2310.json"), read("scenes/nu2310.json")).expect("written");
    // Runs are short here.
    let tool = env!("CARGO_BIN_EXE_cagedyn");
    let short = format!("#!/bin/sh\n[ $1 = sweep ] && set -- \"$@\" --until 1e-3\nexec '{tool}' \"$@\"\n");
    std::fs::create_dir(at("bin")).expect("a folder");
    std::fs::write(at("bin/cagedyn"), short).expect("written");
    std::fs::set_permissions(at("bin/cagedyn"), std::fs::Permissions::from_mode(0o755)).expect("a program");
    let path = format!("{}:{}", at("bin").display(), std::env::var("PATH").expect("a path"));
    let execute = |script: &str, folder: &Path, variables: &[(&str, &str)]| {
        let mut command = Command::new("sh");
        command.args(["-c", script]).current_dir(folder).env("PATH", &path);
        succeeded(&command.envs(variables.iter().copied()).output().expect("a shell"))
    };
    let folder = dir.path().to_string_lossy().into_owned();
    for task in 1..=8 {
        let task = task.to_string();
        let told = if ["1", "3", "5", "7"].contains(&&*task) {
            let task = ("SLURM_ARRAY_TASK_ID", &*task);
            execute(
                slurm,
                Path::new("/"),
                &[("SLURM_SUBMIT_DIR", &folder), ("SLURM_CPUS_PER_TASK", "2"), task],
            )
        } else {
            execute(pbs, Path::new("/"), &[("PBS_O_WORKDIR", &folder), ("PBS_ARRAY_INDEX", &task)])
        };
        assert!(told.starts_with(&format!("part {task}/8: 3 points, 0 of them done")), "{told}");
    }
    assert!(execute(merge, dir.path(), &[]).contains("24 complete, 0 failed"));
    std::fs::remove_file(at("parts/8/points/00007.json")).expect("removed");
    std::fs::remove_file(at("parts/8/points/00015.json")).expect("removed");
    let parts: Vec<PathBuf> = (1..=8).map(|task| at("parts").join(task.to_string())).collect();
    let shown = fenced(&read("docs/studies-cli.md"), "text");
    assert_eq!(shown, [refused(&self::merge(&parts, &at("again")))]);
}
