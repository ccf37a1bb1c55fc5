//! The examples: compiled, run, and their output compared with what is expected, numbers to a few thousandths.

use crate::c_cvode::sundials;
use crate::c_programs::{compile, library, root, succeed};
use std::ffi::OsStr;
use std::path::Path;
use std::process::Command;

/// Relative difference of numbers that compilers and machines explain, and digits of the last place.
const RELATIVE: f64 = 5e-3;
const LAST_DIGITS: f64 = 2.0;

fn words(text: &str) -> Vec<&str> {
    text.split(|c: char| c.is_whitespace() || "(),:".contains(c)).filter(|word| !word.is_empty()).collect()
}

/// One of the last place of a number.
fn last_place(number: &str) -> f64 {
    let digits = number.split_once('.').map_or(0, |(_, fraction)| fraction.len());
    10f64.powi(-i32::try_from(digits).expect("a few digits"))
}

/// Compares an output with what is expected in `examples/expected`; with `CAGEDYN_BLESS=1` writes that.
pub fn check(name: &str, output: &[u8]) {
    let path = root().join("examples/expected").join(name);
    let found = String::from_utf8_lossy(output).into_owned();
    if std::env::var_os("CAGEDYN_BLESS").is_some() {
        std::fs::write(&path, &found).expect("a file");
    }
    let expected = std::fs::read_to_string(&path).unwrap_or_default();
    let (a, b) = (words(&expected), words(&found));
    assert_eq!(a.len(), b.len(), "{name}: expected\n{expected}\nfound\n{found}");
    for (a, b) in a.into_iter().zip(b) {
        assert!(same(a, b), "{name}: expected {a}, found {b}\n{found}");
    }
}

/// Whether two words are the same, or numbers close to each other.
fn same(expected: &str, found: &str) -> bool {
    match (expected.parse::<f64>(), found.parse::<f64>()) {
        (Ok(x), Ok(y)) => {
            let band = RELATIVE * x.abs().max(y.abs()) + LAST_DIGITS * last_place(expected);
            (x - y).abs() <= band
        }
        _ => expected == found,
    }
}

#[test]
fn bad_output_is_seen() {
    for (a, b, alike) in
        [("1.000", "1.004", true), ("1.000", "1.02", false), ("0.01", "0.03", true), ("mm", "m", false)]
    {
        assert_eq!(same(a, b), alike, "{a} {b}");
    }
    assert_eq!(words("  0.5 ms: cage (0.1, -2)"), ["0.5", "ms", "cage", "0.1", "-2"]);
}

/// Compiles and runs an example on the scene of the NU2310.
fn run(source: &str, standard: &str, expected: &str, more: &[&OsStr]) {
    run_on("scenes/nu2310.json", source, standard, expected, more);
}

fn run_on(scene: &str, source: &str, standard: &str, expected: &str, more: &[&OsStr]) {
    let library = library();
    let program = compile(&Path::new("examples").join(source), standard, library.path(), more);
    let output = succeed(Command::new(&program).arg(root().join(scene)));
    check(expected, &output.stdout);
    let refused = Command::new(&program).arg("no such scene").output().expect("it starts");
    let message = String::from_utf8_lossy(&refused.stderr);
    assert!(!refused.status.success() && message.contains("no such scene"), "{message}");
}

#[test]
fn forces() {
    run("forces.c", "c99", "forces.txt", &[]);
    run("forces.c", "c++17", "forces.txt", &[]);
}

#[test]
fn host_loop() {
    run("host_loop.c", "c99", "host_loop.txt", &[]);
}

#[test]
fn rotor() {
    run("rotor.c", "c99", "rotor.txt", &[]);
    run("rotor.c", "c++17", "rotor.txt", &[]);
}

#[test]
fn batch() {
    run("batch.c", "c99", "batch.txt", &[]);
    run("batch.c", "c++20", "batch.txt", &[]);
}

#[test]
fn cvode() {
    let lib = sundials();
    let include = lib.with_file_name("include");
    let mut more: Vec<&OsStr> = vec!["-isystem".as_ref(), include.as_ref(), "-L".as_ref(), lib.as_ref()];
    let names = ["cvode", "nvecserial", "sunlinsolspgmr", "core"].map(|name| format!("-lsundials_{name}"));
    more.extend(names.iter().map(OsStr::new));
    run("cvode.c", "c99", "cvode.txt", &more);
}

/// With SUNDIALS of the system, where there is one: version 6 in Debian 12, with another name of one library.
#[test]
fn cvode_of_the_system() {
    let is_there = |name: &str| {
        let found = Command::new("cc").arg(format!("-print-file-name=lib{name}.so")).output();
        found.is_ok_and(|found| found.stdout.contains(&b'/'))
    };
    let Some(base) = ["sundials_core", "sundials_generic"].into_iter().find(|name| is_there(name)) else {
        eprintln!("there is no SUNDIALS of the system (libsundials-dev)");
        return;
    };
    let names = ["sundials_cvode", "sundials_nvecserial", "sundials_sunlinsolspgmr", base];
    let names = names.map(|name| format!("-l{name}"));
    let more: Vec<&OsStr> = names.iter().map(OsStr::new).collect();
    run("cvode.c", "c99", "cvode.txt", &more);
}

#[test]
fn ball_bearing() {
    let scene = "scenes/angular_contact_70.json";
    run_on(scene, "ball_bearing.c", "c99", "ball_bearing.txt", &[]);
    run_on(scene, "ball_bearing.cpp", "c++17", "ball_bearing.txt", &[]);
}

#[test]
fn cage_in_space() {
    let scene = "scenes/angular_contact_70_cage.json";
    run_on(scene, "cage_in_space.c", "c99", "cage_in_space.txt", &[]);
    run_on(scene, "cage_in_space.cpp", "c++17", "cage_in_space.txt", &[]);
}

#[test]
fn cpp() {
    run("nu2310.cpp", "c++17", "nu2310.txt", &[]);
    run("nu2310.cpp", "c++20", "nu2310.txt", &[]);
}
