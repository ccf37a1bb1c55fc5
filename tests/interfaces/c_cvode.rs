//! CVODE of SUNDIALS, driven from C through the C ABI alone, against the library's own methods: `ctests/test_cvode.c`.

use crate::c_programs::{compile, library, run_under_valgrind, succeed};
use crate::common::{example, read, with};
use cagedyn::Model;
use serde_json::{Value, json};
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The directory of the static libraries that `sundials-sys` built: cargo puts it into the search path of the tests.
pub fn sundials() -> PathBuf {
    let paths = std::env::var_os("LD_LIBRARY_PATH").unwrap_or_default();
    std::env::split_paths(&paths)
        .find(|path| path.join("libsundials_cvode.a").exists())
        .expect("LD_LIBRARY_PATH, as cargo sets it for tests, leads to SUNDIALS")
}

/// The C program, in the directory of the library.
fn program(library: &Path) -> PathBuf {
    let lib = sundials();
    let include = lib.with_file_name("include");
    let names = ["cvode", "nvecserial", "sunlinsoldense", "sunmatrixdense", "core"];
    let names = names.map(|name| OsString::from(format!("-lsundials_{name}")));
    // Warnings are for this repository's code, not for these headers.
    let mut more: Vec<&OsStr> = vec!["-isystem".as_ref(), include.as_ref(), "-L".as_ref(), lib.as_ref()];
    more.extend(names.iter().map(OsString::as_os_str));
    compile(Path::new("ctests/test_cvode.c"), "c11", library, &more)
}

/// A scene and how it is followed.
struct Case {
    name: &'static str,
    scene: Value,
    duration: f64,
    /// Largest step of CVODE, s: short enough to meet every contact.
    max_step: f64,
    /// Largest difference of a position at the end, in units of the guide clearance.
    bound: f64,
}

fn scene(file: &str, changes: &[(&str, Value)]) -> Value {
    with(&serde_json::from_str(&read(file)).expect("a scene"), changes)
}

fn cases() -> Vec<Case> {
    let start = json!({
        "cage": {"y": 0.08e-3, "z": -0.05e-3}, "cage_velocity": {"y": 0.02, "z": 0.03}, "cage_speed": 142.5
    });
    let ball = "scenes/ball_short_bearing.json";
    let smooth = scene(ball, &[("cage.pocket", Value::Null), ("initial", start)]);
    let heavy = with(&example(), &[("inner_ring.motion.free.load.z", json!({"constant": -40e3}))]);
    let case = |name, scene, duration, max_step, bound| Case { name, scene, duration, max_step, bound };
    vec![
        case("smooth film", smooth, 5e-3, 2.5e-6, 1e-9),
        case("NU2310", example(), 1e-3, 2.5e-7, 1e-10),
        case("NU2310 at 40 kN", heavy, 0.5e-3, 2.5e-7, 1e-10),
        case("grease guide", scene("scenes/grease_guide.json", &[]), 10e-3, 2.5e-7, 1e-7),
        case("ball short bearing", scene(ball, &[]), 10e-3, 2.5e-7, 1e-7),
    ]
}

impl Case {
    /// Arguments of the program, with the scene in the directory `folder`.
    fn arguments(&self, solver: &Value, duration: f64, folder: &Path) -> Vec<OsString> {
        let text = with(&self.scene, &[("solver", json!({"method": solver}))]).to_string();
        let model = Model::from_json(&text).unwrap_or_else(|e| panic!("{}: {e}", self.name));
        let file = folder.join("scene.json");
        std::fs::write(&file, text).expect("a file");
        let numbers = [duration, model.pitch_radius(), self.max_step, self.bound];
        let numbers = numbers.map(|x| OsString::from(format!("{x:?}")));
        std::iter::once(file.into_os_string()).chain(numbers).collect()
    }
}

#[test]
fn cvode_ends_where_the_library_ends() {
    let library = library();
    let program = program(library.path());
    let dormand_prince = json!({"dormand_prince": {"tolerance": 1e-12}});
    let rosenbrock = json!({"rosenbrock": {"tolerance": 1e-10}});
    for case in cases() {
        for solver in [&rosenbrock, &dormand_prince] {
            let arguments = case.arguments(solver, case.duration, library.path());
            let output = succeed(Command::new(&program).args(&arguments));
            print!("{}, {solver}: {}", case.name, String::from_utf8_lossy(&output.stdout));
        }
        // Memory is used alike in all steps; Valgrind is slow.
        let arguments = case.arguments(&dormand_prince, 0.05 * case.duration, library.path());
        run_under_valgrind(&program, &arguments);
    }
}
