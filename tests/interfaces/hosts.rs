//! Hosts that are no C programs: Python, MATLAB by way of Octave, Julia. One that is missing is told of; with
//! `CAGEDYN_REQUIRE_HOSTS=1` a missing Python is a failure, with `CAGEDYN_REQUIRE_ALL_HOSTS=1` also a missing Octave.

use crate::c_programs::{library, root, succeed};
use crate::examples::check;
use std::path::Path;
use std::process::Command;

/// Whether a program runs; where it must and does not, a failure.
pub fn present(program: &Path, arguments: &[&str], switches: &[&str]) -> bool {
    let runs = Command::new(program).args(arguments).output().is_ok_and(|output| output.status.success());
    let needed = switches.iter().any(|switch| std::env::var_os(switch).is_some());
    assert!(runs || !needed, "{} {arguments:?} does not run", program.display());
    if !runs {
        eprintln!("{} is not there: not tested", program.display());
    }
    runs
}

/// Python with what the package needs.
pub fn python(library: &Path, modules: &str) -> Option<Command> {
    let python = std::env::var_os("CAGEDYN_PYTHON").unwrap_or("python3".into());
    let switches = ["CAGEDYN_REQUIRE_HOSTS", "CAGEDYN_REQUIRE_ALL_HOSTS"];
    if !present(Path::new(&python), &["-c", &format!("import {modules}")], &switches) {
        return None;
    }
    let mut command = Command::new(python);
    command.env("CAGEDYN_LIBRARY", library.join("libcagedyn.so")).env("PYTHONPATH", root().join("python"));
    command.env("PYTHONDONTWRITEBYTECODE", "1").current_dir(root());
    Some(command)
}

#[test]
fn python_package() {
    let library = library();
    if let Some(mut python) = python(library.path(), "numpy, cffi, pytest, distributed, pyarrow, xarray") {
        succeed(python.args(["-m", "pytest", "-q", "-p", "no:cacheprovider", "python/tests"]));
    }
}

#[test]
fn python_types() {
    let library = library();
    if let Some(mut python) = python(library.path(), "numpy, cffi, mypy, distributed, xarray") {
        let cache = library.path().join("mypy");
        succeed(python.args(["-m", "mypy", "--strict", "--cache-dir"]).arg(cache).arg("python/cagedyn"));
    }
}

#[test]
fn python_examples() {
    let library = library();
    if let Some(mut python) = python(library.path(), "numpy, cffi") {
        check("nu2310.txt", &succeed(python.arg("examples/nu2310.py")).stdout);
    }
    if let Some(mut python) = python(library.path(), "numpy, cffi") {
        check("ball_bearing.txt", &succeed(python.arg("python/examples/ball_bearing.py")).stdout);
    }
    if let Some(mut python) = python(library.path(), "numpy, cffi") {
        check("cage_in_space.txt", &succeed(python.arg("python/examples/cage_in_space.py")).stdout);
    }
    if let Some(mut python) = python(library.path(), "numpy, cffi, distributed, pyarrow, xarray") {
        let folder = library.path().join("study");
        check("study.txt", &succeed(python.arg("python/examples/study.py").arg(folder)).stdout);
    }
    if let Some(mut python) = python(library.path(), "numpy, cffi, matplotlib") {
        let picture = library.path().join("orbit.png");
        let output =
            succeed(python.args(["python/examples/cage_orbit.py", "scenes/nu2310.json"]).arg(&picture));
        assert!(String::from_utf8_lossy(&output.stdout).contains("trusted"));
        assert!(std::fs::metadata(&picture).is_ok_and(|file| file.len() > 10_000));
    }
}

/// All cells of the notebooks, in kernels of Jupyter.
#[test]
fn python_notebooks() {
    let library = library();
    let modules =
        "numpy, cffi, pytest, matplotlib, distributed, pyarrow, xarray, nbformat, nbclient, ipykernel";
    if let Some(mut python) = python(library.path(), modules) {
        succeed(python.args(["-m", "pytest", "-q", "-p", "no:cacheprovider", "python/notebooks"]));
    }
}

/// The lines of Python of the pages.
#[test]
fn python_of_the_pages() {
    let library = library();
    for (page, modules, printed) in [
        ("python/README.md", "numpy, cffi", "leapfrog"),
        ("docs/hosts.md", "numpy, cffi", "-0.566"),
        ("docs/studies.md", "numpy, cffi, distributed, pyarrow, xarray", "134.2"),
        ("README.md", "numpy, cffi", "cage centre y: -0.546 of the clearance"),
    ] {
        let text = std::fs::read_to_string(root().join(page)).expect("a page");
        let code = text.split("```python\n").nth(1).and_then(|rest| rest.split("```").next()).expect("code");
        // A study of an earlier build would be refused.
        let code = code.replace("out/", &format!("{}/", library.path().display()));
        if let Some(mut python) = python(library.path(), modules) {
            let output = succeed(python.args(["-c", &code]));
            let text = String::from_utf8_lossy(&output.stdout);
            assert!(text.contains(printed), "{page}: {text}");
        }
    }
}

#[test]
fn octave() {
    let switches = ["CAGEDYN_REQUIRE_ALL_HOSTS"];
    if !present(Path::new("mkoctfile"), &["--version"], &switches) {
        return;
    }
    let library = library();
    let folder = library.path().display().to_string();
    let mut build = Command::new("mkoctfile");
    build.args(["--mex", "-Wall", "-Wextra"]).arg(root().join("matlab/cagedyn_mex.c"));
    build.arg(format!("-I{}", root().join("include").display())).arg(format!("-L{folder}"));
    build
        .args(["-lcagedyn", &format!("-Wl,-rpath,{folder}"), "-o"])
        .arg(library.path().join("cagedyn_mex.mex"));
    succeed(build.current_dir(library.path()));
    let octave = || {
        let mut octave = Command::new("octave-cli");
        octave.arg("--path").arg(root().join("matlab")).args(["--path", &folder]).current_dir(root());
        octave
    };
    let output = succeed(octave().args(["--eval", "test_cagedyn('scenes/nu2310.json')"]));
    assert!(String::from_utf8_lossy(&output.stdout).contains("all checks passed"));
    check("cage_in_space.txt", &succeed(octave().arg("examples/cage_in_space.m")).stdout);
    let output = succeed(octave().arg("examples/nu2310.m"));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let (of_host, ours): (Vec<&str>, Vec<&str>) = text.lines().partition(|line| line.starts_with("ode15s"));
    check("nu2310.txt", ours.join("\n").as_bytes());
    for line in of_host {
        assert!(["1e-03", "1e-04", "1e-05"].iter().any(|small| line.contains(small)), "{line}");
    }
}

#[test]
fn julia() {
    if present(Path::new("julia"), &["--version"], &[]) {
        let library = library();
        let mut julia = Command::new("julia");
        julia.env("CAGEDYN_LIBRARY", library.path().join("libcagedyn.so"));
        let output = succeed(julia.arg("examples/nu2310.jl").current_dir(root()));
        check("nu2310.txt", &output.stdout);
    }
}
