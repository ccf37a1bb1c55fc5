//! Functional mock-up units: made by the tool, then validated, run and taken back by FMPy (`tests/fmu`).
#![cfg(target_os = "linux")]

use crate::c_programs::{library, root, succeed};
use crate::hosts::python;
use std::process::Command;

fn tool() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cagedyn"));
    command.current_dir(root());
    command
}

#[test]
fn units_are_what_the_standard_says() {
    let library = library();
    if let Some(mut python) = python(library.path(), "numpy, cffi, pytest, fmpy") {
        python.env("CAGEDYN_TOOL", env!("CARGO_BIN_EXE_cagedyn"));
        succeed(python.args(["-m", "pytest", "-q", "-p", "no:cacheprovider", "tests/fmu"]));
    }
}

#[test]
fn the_same_scene_gives_the_same_bytes() {
    let (library, folder) = (library(), tempfile::tempdir().expect("a folder"));
    let made: Vec<Vec<u8>> = ["a", "b"]
        .into_iter()
        .map(|name| {
            let out = folder.path().join(name).join("unit.fmu");
            std::fs::create_dir(out.parent().expect("a folder")).expect("a folder");
            let file = library.path().join("libcagedyn.so");
            let mut tool = tool();
            tool.args(["fmu", "scenes/grease_guide.json", "--out"]).arg(&out).arg("--library").arg(file);
            let said = String::from_utf8(succeed(&mut tool).stdout).expect("text");
            assert!(said.contains("FMI 3.0") && said.contains("6 states"), "{said}");
            std::fs::read(out).expect("a unit")
        })
        .collect();
    assert!(made[0] == made[1]);
}

#[test]
fn libraries_that_do_not_fit_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let other = folder.path().join("libother.so");
    std::fs::write(&other, b"another library").expect("a file");
    let out = folder.path().join("unit.fmu");
    for (library, words) in [(other.as_path(), "sources"), (&folder.path().join("none.so"), "none.so")] {
        let mut tool = tool();
        tool.args(["fmu", "scenes/nu2310.json", "--out"]).arg(&out).arg("--library").arg(library);
        let output = tool.output().expect("the tool runs");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && said.contains(words) && said.lines().count() == 1, "{said}");
        assert!(!out.exists());
    }
}
