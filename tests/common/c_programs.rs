//! Compiles C and C++ programs against the shared library just built, and runs them; under Valgrind too where it is
//! installed (`CAGEDYN_REQUIRE_VALGRIND=1` makes a missing Valgrind a failure).

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const STRICT: [&str; 4] = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"];

pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A directory with the shared library under the names that linker and loader look for.
pub fn library() -> tempfile::TempDir {
    let test = std::env::current_exe().expect("path of this test");
    let built = test.parent().expect("a directory").join("libcagedyn.so");
    assert!(built.exists(), "{} was not built", built.display());
    let dir = tempfile::tempdir().expect("a temporary directory");
    for name in ["libcagedyn.so", "libcagedyn.so.0"] {
        std::os::unix::fs::symlink(&built, dir.path().join(name)).expect("a link");
    }
    dir
}

/// Compiles one source file and links it with the library in the directory `library` and with what `more` asks for; the
/// program is written there.
pub fn compile(source: &Path, standard: &str, library: &Path, more: &[&OsStr]) -> PathBuf {
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
        .args(["-x", "none"])
        .arg("-o")
        .arg(&program)
        .arg("-L")
        .arg(library)
        .arg("-lcagedyn")
        .args(more)
        .args(["-lm", "-pthread"])
        .arg(format!("-Wl,-rpath,{}", library.display()));
    succeed(&mut command);
    program
}

/// Runs a command that must succeed.
pub fn succeed(command: &mut Command) -> Output {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    let shown = words.map(|w| w.to_string_lossy()).collect::<Vec<_>>().join(" ");
    let output = command.output().unwrap_or_else(|e| panic!("{shown}: {e}"));
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{shown}: {}\n{out}\n{err}", output.status);
    output
}

/// Runs a program under Valgrind, if it is installed; leaks and wrong accesses are failures.
pub fn run_under_valgrind<A: AsRef<OsStr>>(program: &Path, arguments: &[A]) {
    if Command::new("valgrind").arg("--version").output().is_ok() {
        let kinds = ["--leak-check=full", "--errors-for-leak-kinds=definite,indirect,possible"];
        let mut command = Command::new("valgrind");
        let known = root().join("ctests/valgrind.supp");
        // One thread runs at a time, and all get their turn.
        command.args(kinds).args(["--error-exitcode=99", "--fair-sched=try"]);
        command.arg(format!("--suppressions={}", known.display()));
        succeed(command.arg(program).args(arguments));
    } else {
        assert!(std::env::var_os("CAGEDYN_REQUIRE_VALGRIND").is_none(), "valgrind is not installed");
        eprintln!("valgrind is not installed: ran {} without it", program.display());
    }
}
