//! Compiles the C tests and the C example against the shared library just built, and runs them; under Valgrind
//! too where it is installed (`CAGEDYN_REQUIRE_VALGRIND=1` makes a missing Valgrind a failure).

use crate::c_programs::{compile, library, root, run_under_valgrind, succeed};
use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

const NU2310: &str = "scenes/nu2310.json";

fn run_c_test(source: &str, scene: &str) {
    let library = library();
    let scene = root().join(scene);
    let program = compile(Path::new(source), "c11", library.path(), &[]);
    succeed(Command::new(&program).arg(&scene));
    run_under_valgrind(&program, &[&scene]);
}

/// The same in both standards, and without exceptions; with `more` arguments where Valgrind does not slow it down.
fn run_cpp_test(source: &str, scene: &str, more: &[&str]) {
    let library = library();
    let scene = root().join(scene);
    let quiet = ["-fno-exceptions".as_ref()];
    for (standard, switches) in [("c++17", &[][..]), ("c++20", &[]), ("c++17", &quiet)] {
        let program = compile(Path::new(source), standard, library.path(), switches);
        succeed(Command::new(&program).arg(&scene).args(more));
        run_under_valgrind(&program, &[&scene]);
    }
}

#[test]
fn c_model() {
    run_c_test("ctests/test_model.c", NU2310);
}

#[test]
fn c_sim() {
    run_c_test("ctests/test_sim.c", NU2310);
}

#[test]
fn limits() {
    run_c_test("ctests/test_limits.c", NU2310);
}

#[test]
fn c_errors() {
    run_c_test("ctests/test_errors.c", NU2310);
}

#[test]
fn c_guide() {
    run_c_test("ctests/test_guide.c", "scenes/grease_guide.json");
}

#[test]
fn c_integrator() {
    run_c_test("ctests/test_integrator.c", NU2310);
}

#[test]
fn c_batch() {
    run_c_test("ctests/test_batch.c", NU2310);
}

#[test]
fn c_motion() {
    run_c_test("ctests/test_motion.c", "scenes/grease_guide.json");
}

#[test]
fn c_whirl() {
    run_c_test("ctests/test_whirl.c", "scenes/grease_guide.json");
}

#[test]
fn c_equilibrium() {
    run_c_test("ctests/test_equilibrium.c", "scenes/angular_contact_218.json");
}

#[test]
fn c_tilting_rollers() {
    run_c_test("ctests/test_tilting_rollers.c", "scenes/nu2310.json");
}

#[test]
fn c_line_loads() {
    run_c_test("ctests/test_line_loads.c", "scenes/nu2310_space.json");
}

#[test]
fn cpp_equilibrium() {
    run_cpp_test("ctests/test_cpp_equilibrium.cpp", "scenes/angular_contact_218.json", &[]);
}

#[test]
fn c_heat() {
    run_c_test("ctests/test_heat.c", "scenes/grease_guide_heat.json");
}

#[test]
fn c_threads() {
    run_c_test("ctests/test_threads.c", NU2310);
}

#[test]
fn cpp_with_and_without_exceptions() {
    run_cpp_test("ctests/test_cpp.cpp", NU2310, &[]);
}

#[test]
fn cpp_analysis() {
    run_cpp_test("ctests/test_cpp_analysis.cpp", "scenes/grease_guide_heat.json", &["all"]);
}

#[test]
fn c_example_as_c99_and_cpp17() {
    let library = library();
    for standard in ["c99", "c++17"] {
        let program = compile(Path::new("examples/nu2310.c"), standard, library.path(), &[]);
        let csv = library.path().join(format!("{standard}.csv"));
        let output = succeed(Command::new(&program).arg(root().join("scenes/nu2310.json")).arg(&csv));
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(text.contains("inner_raceway") && text.contains("cage centre after 20 ms"), "{text}");
        let table = std::fs::read_to_string(&csv).expect("the example wrote its table");
        assert_eq!(table.lines().count(), 42);
        assert!(table.starts_with("time [s],cage.y_ratio [1],"), "{table}");
        // Without arguments it explains itself and fails.
        assert!(!Command::new(&program).output().expect("it starts").status.success());
    }
}

#[test]
fn c_example_of_the_readme() {
    let readme = std::fs::read_to_string(root().join("README.md")).expect("the README");
    let code = readme.split("```c\n").nth(1).and_then(|rest| rest.split("```").next());
    let library = library();
    let source = library.path().join("readme.c");
    std::fs::write(&source, code.expect("the README has a C example")).expect("a file");
    let program = compile(&source, "c11", library.path(), &[]);
    let output = succeed(Command::new(&program).current_dir(root()));
    assert!(String::from_utf8_lossy(&output.stdout).contains("of the clearance"));
    // Without the scene it says what is missing, and not what follows from that.
    let output = Command::new(&program).current_dir(library.path()).output().expect("it starts");
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && message.contains("scenes/nu2310.json"), "{message}");
    assert!(!message.contains("NULL"), "{message}");
}

#[test]
fn library_has_its_soname_and_exports_only_the_api() {
    let library = library();
    let so = library.path().join("libcagedyn.so");
    let dynamic = succeed(Command::new("readelf").arg("-d").arg(&so));
    assert!(String::from_utf8_lossy(&dynamic.stdout).contains("[libcagedyn.so.0]"));
    let symbols = succeed(Command::new("nm").args(["-D", "--defined-only"]).arg(&so));
    let symbols = String::from_utf8_lossy(&symbols.stdout).into_owned();
    let header = std::fs::read_to_string(root().join("include/cagedyn.h")).expect("the header");
    let exported: BTreeSet<&str> =
        symbols.lines().filter_map(|line| line.split_whitespace().last()).collect();
    // Those of functional mock-up units have headers of the standard.
    let of_units = include_str!("../fmu/functions.txt");
    let declared: BTreeSet<&str> =
        crate::header::functions(&header).into_iter().chain(of_units.lines()).collect();
    assert_eq!(exported, declared, "left: exported, right: in the header, and of units");
}
