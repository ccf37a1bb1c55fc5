//! Compiles the C tests and the C example against the shared library just built, and runs them; under Valgrind
//! too where it is installed (`CAGEDYN_REQUIRE_VALGRIND=1` makes a missing Valgrind a failure).

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const NU2310: &str = "scenes/nu2310.json";
const STRICT: [&str; 4] = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A directory with the shared library under the names that linker and loader look for.
fn library() -> tempfile::TempDir {
    let test = std::env::current_exe().expect("path of this test");
    let built = test.parent().expect("a directory").join("libcagedyn.so");
    assert!(built.exists(), "{} was not built", built.display());
    let dir = tempfile::tempdir().expect("a temporary directory");
    for name in ["libcagedyn.so", "libcagedyn.so.0"] {
        std::os::unix::fs::symlink(&built, dir.path().join(name)).expect("a link");
    }
    dir
}

/// Compiles and links one source file.
fn compile(source: &Path, standard: &str, library: &Path) -> PathBuf {
    let cpp = standard.starts_with("c++");
    let compiler = cc::Build::new()
        .cpp(cpp)
        .opt_level(1)
        .cargo_metadata(false)
        .target(env!("CAGEDYN_TARGET"))
        .host(env!("CAGEDYN_HOST"))
        .out_dir(library)
        .get_compiler();
    let stem = source.file_stem().expect("a file name").to_string_lossy().into_owned();
    let program = library.join(format!("{stem}-{standard}"));
    let mut command = compiler.to_command();
    command
        .arg(format!("-std={standard}"))
        .args(STRICT)
        .arg("-I")
        .arg(root().join("include"))
        .args(if cpp { ["-x", "c++"] } else { ["-x", "c"] })
        .arg(root().join(source))
        .arg("-o")
        .arg(&program)
        .arg("-L")
        .arg(library)
        .args(["-lcagedyn", "-lm", "-pthread"])
        .arg(format!("-Wl,-rpath,{}", library.display()));
    succeed(&mut command);
    program
}

fn succeed(command: &mut Command) -> Output {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    let shown = words.map(|w| w.to_string_lossy()).collect::<Vec<_>>().join(" ");
    let output = command.output().unwrap_or_else(|e| panic!("{shown}: {e}"));
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{shown}: {}\n{out}\n{err}", output.status);
    output
}

fn run_c_test(source: &str, scene: &str) {
    let library = library();
    let scene = root().join(scene);
    let program = compile(Path::new(source), "c11", library.path());
    succeed(Command::new(&program).arg(&scene));
    if Command::new("valgrind").arg("--version").output().is_ok() {
        let kinds = ["--leak-check=full", "--errors-for-leak-kinds=definite,indirect,possible"];
        succeed(Command::new("valgrind").args(kinds).arg("--error-exitcode=99").arg(&program).arg(&scene));
    } else {
        assert!(std::env::var_os("CAGEDYN_REQUIRE_VALGRIND").is_none(), "valgrind is not installed");
        eprintln!("valgrind is not installed: ran {source} without it");
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
fn c_errors() {
    run_c_test("ctests/test_errors.c", NU2310);
}

#[test]
fn c_guide() {
    run_c_test("ctests/test_guide.c", "scenes/grease_guide.json");
}

#[test]
fn c_threads() {
    run_c_test("ctests/test_threads.c", NU2310);
}

#[test]
fn c_example_as_c99_and_cpp17() {
    let library = library();
    for standard in ["c99", "c++17"] {
        let program = compile(Path::new("examples/nu2310.c"), standard, library.path());
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
    let program = compile(&source, "c11", library.path());
    let output = succeed(Command::new(&program).current_dir(root()));
    assert!(String::from_utf8_lossy(&output.stdout).contains("of the clearance"));
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
    let mut count = 0;
    for name in symbols.lines().filter_map(|line| line.split_whitespace().last()) {
        assert!(header.contains(&format!("{name}(")), "{name} is exported but not in the header");
        count += 1;
    }
    assert!(count >= 58, "{count} functions exported");
}
