//! The command line program: files, exit codes, messages, interruption.
#![cfg(feature = "cli")]

use serde_json::{Value, json};
use std::path::Path;
use std::process::{Command, Output};
use std::time::{Duration, Instant};

pub fn cagedyn() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_cagedyn"));
    command.current_dir(env!("CARGO_MANIFEST_DIR"));
    command
}

pub fn run(arguments: &[&str]) -> Output {
    cagedyn().args(arguments).output().expect("the program starts")
}

pub fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

pub fn json(path: &Path) -> Value {
    let content = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    serde_json::from_str(&content).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

#[test]
fn run_writes_table_summary_and_pictures() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().join("deep/out");
    let arguments = ["run", "scenes/nu2310.json", "--until", "0.02", "--out", &out.to_string_lossy()];
    let output = run(&arguments);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stderr).is_empty(), "no progress bar in a pipe: {}", text(&output.stderr));
    assert!(text(&output.stdout).contains("cage centre y"));

    let table = std::fs::read_to_string(out.join("timeseries.csv")).expect("a table");
    assert!(table.starts_with("time [s],cage.y [m],"), "{}", &table[..60]);
    assert_eq!(table.lines().count(), 1 + 41);
    let columns = table.lines().next().map_or(0, |line| line.split(',').count());
    assert!(table.lines().all(|line| line.split(',').count() == columns));

    let summary = json(&out.join("summary.json"));
    assert_eq!(summary["simulated_time_s"], 0.02);
    assert_eq!(summary["interrupted"], false);
    assert!(summary["statistics"]["cage.y_ratio"]["mean"].is_number(), "{summary}");
    for picture in
        ["cage_orbit", "cage_position", "roller_history", "cage_spectrum", "over_orbit", "contact_forces"]
    {
        let svg = std::fs::read_to_string(out.join(format!("{picture}.svg"))).expect(picture);
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"), "{picture}");
        assert!(svg.contains("NU2310") && !svg.contains("NaN"), "{picture}");
    }
}

#[test]
fn overrides_reach_the_run() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    let sets = ["--set", "cage=null", "--set", "title=bare", "--set", "record.duration=1e-3"];
    let mut arguments = vec!["run", "scenes/nu2310.json", "--out", &out];
    arguments.extend(sets);
    let output = run(&arguments);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let summary = json(&dir.path().join("summary.json"));
    assert_eq!((&summary["title"], &summary["simulated_time_s"]), (&"bare".into(), &1e-3.into()));
    assert!(!dir.path().join("cage_orbit.svg").exists(), "there is no cage to draw");
}

#[test]
fn runs_that_are_not_to_be_trusted_say_so() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    let solver = r#"solver={"method": {"leapfrog": {"step": 1e-5}}}"#;
    let trusted = |set: &[&str]| {
        let mut arguments = vec!["run", "scenes/nu2310.json", "--until", "0.01", "--out", &out];
        arguments.extend(set);
        (run(&arguments), json(&dir.path().join("summary.json")))
    };
    let (output, summary) = trusted(&[]);
    assert!(output.status.success());
    assert_eq!((&summary["trusted"], &summary["doubts"]), (&true.into(), &Value::Null));
    let (output, summary) = trusted(&["--set", solver]);
    assert_eq!(output.status.code(), Some(3));
    assert!(text(&output.stderr).contains("not to be trusted: leapfrog steps of 1.000e-5 s are unstable"));
    assert_eq!(text(&output.stderr).lines().count(), 1);
    assert!(text(&output.stdout).contains("trusted            NO:"), "{}", text(&output.stdout));
    assert_eq!(summary["trusted"], false);
    assert!(summary["doubts"][0].as_str().is_some_and(|doubt| doubt.contains("unstable")), "{summary}");
}

/// The system's mathematical functions are others on processors without fused operations; the library calls none of them.
#[test]
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
fn bits_do_not_depend_on_the_processor() {
    for scene in ["ball_short_bearing", "nu2310_grease", "grease_guide"] {
        let table = |tunables: &str| {
            let dir = tempfile::tempdir().expect("a directory");
            let (scene, out) = (format!("scenes/{scene}.json"), dir.path().to_string_lossy().into_owned());
            let arguments = ["run", &scene, "--until", "0.02", "--out", &out];
            let output =
                cagedyn().env("GLIBC_TUNABLES", tunables).args(arguments).output().expect("it starts");
            assert!(output.status.success(), "{}", text(&output.stderr));
            std::fs::read(dir.path().join("timeseries.csv")).expect("a table")
        };
        let without = "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F,-AVX2_Usable,-FMA_Usable";
        assert!(table("") == table(without), "{scene}");
    }
}

#[test]
fn mistakes_are_one_line_and_exit_with_1() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().join("out").to_string_lossy().into_owned();
    for (arguments, expected) in [
        (vec!["run", "no/such.json", "--out", &out], "no/such.json"),
        (vec!["run", "README.md", "--out", &out], "README.md"),
        (vec!["run", "scenes/nu2310.json", "--out", &out, "--set", "rollers.radius=7.5"], "rollers.radius"),
        (vec!["run", "scenes/nu2310.json", "--out", &out, "--set", "wheels.count=7"], "wheels"),
        (vec!["info", "scenes/nu2310.json", "--set", "cage.guide=7"], "cage.guide"),
        (vec!["cases", "scenes/nu2310.json", "--out", &out], "scenes/nu2310.json"),
        (vec!["run", "scenes/nu2310.json", "--out", "README.md/x", "--until", "1e-3"], "README.md/x"),
    ] {
        let output = run(&arguments);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {message}");
        assert!(message.starts_with("cagedyn: ") && message.contains(expected), "{arguments:?}: {message}");
        assert_eq!(message.trim_end().lines().count(), 1, "{message}");
    }
    assert_eq!(run(&["walk"]).status.code(), Some(2));
}

#[test]
fn a_run_that_fails_keeps_what_it_computed() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    let output = run(&[
        "run",
        "scenes/nu2310.json",
        "--out",
        &out,
        "--set",
        "inner_ring.motion.free.load.z={\"step\":{\"before\":-4900,\"after\":9e8,\"time\":0.01}}",
        "--set",
        "solver={\"method\":{\"leapfrog\":{\"step\":4e-6}},\"min_step\":1e-7}",
    ]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("at t = "), "{}", text(&output.stderr));
    let table = std::fs::read_to_string(dir.path().join("timeseries.csv")).expect("a table");
    assert!(table.lines().count() >= 20, "{}", table.lines().count());
    assert!(json(&dir.path().join("summary.json"))["error"].is_string());
}

#[test]
fn interruption_keeps_what_was_computed() {
    let dir = tempfile::tempdir().expect("a directory");
    let mut child = cagedyn()
        .args(["run", "scenes/nu2310.json", "--until", "500", "--large-table", "--out"])
        .arg(dir.path())
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn()
        .expect("the program starts");
    std::thread::sleep(Duration::from_millis(1500));
    let signalled = Command::new("sh").args(["-c", &format!("kill -INT {}", child.id())]).status();
    assert!(signalled.is_ok_and(|s| s.success()));
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().expect("a status") {
            break status;
        }
        if start.elapsed() > Duration::from_secs(60) {
            let _ = child.kill();
            panic!("the program ignored the interruption");
        }
        std::thread::sleep(Duration::from_millis(20));
    };
    assert_eq!(status.code(), Some(130));
    assert_eq!(json(&dir.path().join("summary.json"))["interrupted"], true);
    let table = std::fs::read_to_string(dir.path().join("timeseries.csv")).expect("a table");
    assert!(table.lines().count() > 10);
}

#[test]
fn case_sets_give_one_folder_per_case_and_a_comparison() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    let output = run(&["cases", "scenes/nu2310_fig9.cases.json", "--until", "2e-3", "--out", &out]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(dir.path().join("40um-4900N-3000rpm/summary.json").exists());
    let table = std::fs::read_to_string(dir.path().join("cases.csv")).expect("a table");
    assert_eq!(table.lines().count(), 13);
    assert!(dir.path().join("cage_positions.svg").exists());
}

/// Also the order of rows, which is that of the set, and starts, which share the threads.
#[test]
fn cases_are_the_same_however_many_run_at_a_time() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name);
    let base = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/nu2310.json");
    let case = |ms: u32| {
        let duration = 1e-3 * f64::from(ms);
        serde_json::json!({"name": format!("{ms}ms"), "set": {"record.duration": duration, "record.interval": 1e-4}})
    };
    let cases: Vec<_> = [2, 8, 4, 6, 3, 5].map(case).into();
    let set = serde_json::json!({"schema": "cagedyn.cases/1", "scene": base, "cases": cases});
    std::fs::write(at("set.cases.json"), set.to_string()).expect("a case set");
    let file = at("set.cases.json").to_string_lossy().into_owned();
    let results = |jobs: &str, starts: &str| {
        let folder = at(&format!("{jobs}-{starts}"));
        let out = folder.to_string_lossy().into_owned();
        let output = run(&["cases", &file, "--out", &out, "--jobs", jobs, "--starts", starts]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let names: Vec<String> = text(&output.stdout)
            .lines()
            .filter_map(|l| Some(l.split_whitespace().next()?.to_owned()))
            .collect();
        let series = [2, 8, 4, 6, 3, 5].map(|ms| {
            let folder = folder.join(format!("{ms}ms"));
            let summary = json(&folder.join("summary.json"));
            let table = std::fs::read_to_string(folder.join("timeseries.csv")).expect("a table");
            (table, summary["statistics"].clone(), summary["starts"].clone())
        });
        assert_eq!(names[1..7], ["2ms", "8ms", "4ms", "6ms", "3ms", "5ms"], "{names:?}");
        series
    };
    assert!(results("1", "1") == results("3", "1"));
    assert!(results("1", "2") == results("3", "2"));
}

#[test]
fn a_grease_guide_run_reports_its_whirl() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    let output = run(&["run", "scenes/grease_guide.json", "--out", &out]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let printed = text(&output.stdout);
    for expected in ["backward whirl", "whirl speed", "film share", "guide force, shear", "guide film"] {
        assert!(printed.contains(expected), "{expected} in {printed}");
    }
    for absent in ["drag torque", "inner ring y", "guide force, solid", "roller"] {
        assert!(!printed.contains(absent), "{absent} in {printed}");
    }

    let summary = json(&dir.path().join("summary.json"));
    let whirl =
        |field: &str| summary["whirl"][field].as_f64().unwrap_or_else(|| panic!("{field}: {summary}"));
    assert_eq!(summary["whirl"]["motion"], "backward_whirl");
    let [low, mean, high] = ["p05", "mean", "p95"].map(|name| whirl(&format!("{name}_speed_rad_per_s")));
    assert!(low < mean && mean < high && (-2150.0..-1800.0).contains(&mean), "{low} {mean} {high}");
    assert!((100e-6..213.5e-6).contains(&whirl("mean_radius_m")));
    assert!((-12.0..-8.0).contains(&whirl("turns")));
    assert!((0.01..0.05).contains(&whirl("settling_time_s")));
    let laws = summary["integration"]["law_evaluations"].as_object().expect("a map");
    assert!(laws.keys().eq(["guide_film", "pocket_plane"]), "{laws:?}");
    let channels = summary["statistics"].as_object().expect("a map");
    assert!(channels.contains_key("guide.film_share") && !channels.keys().any(|name| name.contains('[')));

    for picture in ["cage_orbit", "cage_position", "cage_spectrum", "whirl_history"] {
        let svg = std::fs::read_to_string(dir.path().join(format!("{picture}.svg"))).expect(picture);
        assert!(svg.contains("Grease") && !svg.contains("NaN"), "{picture}");
    }
    assert!(!dir.path().join("roller_history.svg").exists(), "there are no rollers");
}

#[test]
fn cases_with_prescribed_elements_compare_their_whirl() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name);
    std::fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/grease_guide.json"), at("base.json"))
        .expect("a copy");
    let case = |rpm: f64| {
        let speed = rpm * std::f64::consts::TAU / 60.0;
        serde_json::json!({"name": format!("{rpm}rpm"), "set": {"inner_ring.speed.constant": speed}})
    };
    let set = serde_json::json!({"schema": "cagedyn.cases/1", "scene": "base.json", "cases": [case(500.0), case(3000.0)]});
    std::fs::write(at("set.cases.json"), set.to_string()).expect("a case set");
    let (file, out) = (at("set.cases.json"), at("out"));
    let output = run(&["cases", &file.to_string_lossy(), "--out", &out.to_string_lossy()]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let printed = text(&output.stdout);
    assert!(printed.contains("whirl [rad/s]") && printed.contains("backward whirl"), "{printed}");
    let table = std::fs::read_to_string(at("out/cases.csv")).expect("a table");
    let head = "case,inner ring speed [1/min],inner_ring.speed.constant,whirl speed mean [rad/s]";
    assert!(table.starts_with(head), "{table}");
    let motions: Vec<bool> = table.lines().skip(1).map(|line| line.contains(",backward whirl,")).collect();
    assert_eq!(motions, [false, true], "{table}");
    let svg = std::fs::read_to_string(at("out/whirl_speed.svg")).expect("a picture");
    assert!(svg.contains("whirl speed [rad/s]") && !svg.contains("NaN"));
    assert!(!at("out/cage_positions.svg").exists());
}

#[test]
fn the_catalogue_is_listed_and_its_entries_run() {
    let list = text(&run(&["catalogue"]).stdout);
    // The page has the same list.
    let page = crate::common::read("docs/scene/catalogue.md");
    assert!(page.contains(&format!("```text\n{list}```")), "{list}");
    let entry = text(&run(&["catalogue", "fva_3"]).stdout);
    assert!(entry.contains("pressure_viscosity 2.24e-8") && entry.contains("Lubricants 2023"), "{entry}");
    let all: Value = serde_json::from_slice(&run(&["catalogue", "--json"]).stdout).unwrap();
    assert_eq!(all["materials"]["steel_100cr6"]["values"]["young_modulus"], 210e9);
    let unknown = run(&["catalogue", "butter"]);
    assert!(!unknown.status.success() && text(&unknown.stderr).contains("iso_vg_46"));

    // A scene with nothing but names, in which one is replaced.
    let warm =
        json!({"catalogue": "iso_vg_68", "viscosity": {"walther": {"temperature": {"over_time": 333.15}}}});
    let mut scene = crate::common::example_with(&[
        ("lubricant", warm),
        ("rollers.material", json!("steel_100cr6")),
        ("outer_ring.material", json!("steel_100cr6")),
        ("inner_ring.material", json!("steel_100cr6")),
        ("cage.material", json!("brass_cuzn39pb3")),
    ]);
    crate::common::remove(&mut scene, "materials");
    scene["record"]["duration"] = json!(0.002);
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("named.json");
    std::fs::write(&file, scene.to_string()).unwrap();
    let out = folder.path().join("out");
    let ran = run(&["run", file.to_str().unwrap(), "--out", out.to_str().unwrap()]);
    assert!(ran.status.success(), "{}", text(&ran.stderr));
    let viscosity = |file: &Path, changes: &[&str]| {
        let output = run(&[&["info", file.to_str().unwrap(), "--json"][..], changes].concat());
        assert!(output.status.success(), "{}", text(&output.stderr));
        let info: Value = serde_json::from_slice(&output.stdout).unwrap();
        info["geometry"]["viscosity_pa_s"].as_f64().unwrap()
    };
    let thick = viscosity(&file, &[]);
    let thin =
        viscosity(&file, &["--set", "lubricant.catalogue=iso_vg_10", "--set", "cage.material=pa66_gf33"]);
    assert!(thin < 0.3 * thick, "{thin} {thick} Pa s");
    // What was run has the values and no name, so that it is the same whatever the catalogue becomes.
    assert_eq!(viscosity(&out.join("scene_as_run.json"), &[]), thick);
    let check = run(&["check", file.to_str().unwrap()]);
    assert!(check.status.success(), "{}", text(&check.stdout));
    let wrong = run(&["info", file.to_str().unwrap(), "--set", "cage.material=cheese"]);
    let message = text(&wrong.stderr);
    assert!(
        !wrong.status.success()
            && message.contains("cage.material: 'cheese'")
            && message.contains("phenolic_cotton")
    );
}

#[test]
fn info_and_schema_print_what_they_promise() {
    let info = text(&run(&["info", "scenes/nu2310.json"]).stdout);
    for expected in
        ["70: 29 positions, 41 velocities", "raceways.rolling_resistance", "roundness", "cage.y_ratio"]
    {
        assert!(info.contains(expected), "{expected} in {info}");
    }
    for (kind, file) in [("scene", "scene.schema.json"), ("cases", "cases.schema.json")] {
        let printed: Value = serde_json::from_slice(&run(&["schema", kind]).stdout).expect("a JSON Schema");
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("schemas").join(file);
        assert_eq!(printed, json(&path));
    }
}

#[test]
fn heat_tells_temperatures_powers_and_flows() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("heat");
    let scene = "scenes/grease_guide_heat.json";
    let output = run(&["heat", scene, "--warm-up", "--out", &out.to_string_lossy()]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let printed = text(&output.stdout);
    for expected in ["film", "guide_film", "housing to ambient", "temperatures over time", "whirl"] {
        assert!(printed.contains(expected), "{expected} in {printed}");
    }
    let table = std::fs::read_to_string(out.join("temperatures.csv")).expect("a table");
    assert!(table.starts_with("time_s,film_K,cage_K,") && table.lines().count() == 17, "{table}");
    let picture = std::fs::read_to_string(out.join("heat_flow.svg")).expect("a picture");
    assert!(picture.contains("outer ring") && !picture.contains("NaN"));
    let steady: Value = serde_json::from_slice(&run(&["heat", scene, "--json"]).stdout).expect("JSON");
    let film = &steady["nodes"][0];
    assert_eq!(film["name"], "film");
    assert!((film["temperature_k"].as_f64().expect("a number") - 330.95).abs() < 0.3, "{steady}");
    let refused = run(&["heat", "scenes/grease_guide.json"]);
    assert!(!refused.status.success() && text(&refused.stderr).contains("heat: missing"));
}

#[test]
fn equilibrium_tells_contacts_and_stiffness() {
    let (dir, scene) = (tempfile::tempdir().expect("a directory"), "scenes/angular_contact_218.json");
    let out = dir.path().to_string_lossy().into_owned();
    let output = run(&["equilibrium", scene, "--out", &out]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let printed = text(&output.stdout);
    for expected in ["36.10  um", "stiffness", "tilt_z", "ball[15].inner_raceway", "41.50"] {
        assert!(printed.contains(expected), "{expected} in {printed}");
    }
    let found = json(&dir.path().join("equilibrium.json"));
    assert_eq!(found["coordinates"][0]["name"], "x");
    assert!(found["stiffness"][0][0].as_f64().is_some_and(|k| k > 7e8), "{found}");
    assert_eq!(found["contacts"][1]["name"], "ball[0].inner_raceway");
    let table = std::fs::read_to_string(dir.path().join("contacts.csv")).expect("a table");
    assert!(
        table.starts_with("contact,normal_force_N,contact_angle_rad,approach_m,")
            && table.lines().count() == 33
    );
    let svg = std::fs::read_to_string(dir.path().join("equilibrium.svg")).expect("a picture");
    assert!(svg.contains("contact angle [deg]") && !svg.contains("NaN"));

    // A number that is varied: a row each, and the reason where there is none.
    let vary = "inner_ring.motion.space.load.x.constant=-1000:3000:3";
    let output = run(&["equilibrium", scene, "--vary", vary, "--out", &out]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let table = std::fs::read_to_string(dir.path().join("equilibrium.csv")).expect("a table");
    let rows: Vec<&str> = table.lines().collect();
    assert!(rows.len() == 4 && rows[1].contains("no axial stop") && rows[3].ends_with(','), "{table}");
    assert!(!run(&["equilibrium", scene, "--control", "both"]).status.success());
    let output = run(&["equilibrium", "scenes/grease_guide.json"]);
    assert!(!output.status.success() && text(&output.stderr).contains("kinematic_elements"));
    let rollers = text(&run(&["equilibrium", "scenes/nu2310.json"]).stdout);
    assert!(rollers.contains("roller[9].inner_raceway") && rollers.contains("half width um"), "{rollers}");

    // Beside a ring that tilts: loads along the rollers, too.
    let ring = r#"inner_ring.motion={"space": {"z": "free", "tilt_y": {"held": 1e-3}, "load": {"z": {"constant": -4900}}}}"#;
    let output = run(&["equilibrium", "scenes/nu2310.json", "--set", ring, "--out", &out]);
    assert!(text(&output.stdout).contains("tilt mrad"), "{}", text(&output.stderr));
    let found = json(&dir.path().join("equilibrium.json"));
    assert_eq!(found["line_loads"]["contacts"][19]["name"], "roller[9].inner_raceway");
    let table = std::fs::read_to_string(dir.path().join("line_loads.csv")).expect("a table");
    assert!(table.starts_with("place_m,roller[0].outer_raceway_N_m,") && table.lines().count() == 102);
    let svg = std::fs::read_to_string(dir.path().join("line_loads.svg")).expect("a picture");
    assert!(
        svg.contains("inner raceway [N/mm]") && svg.contains("roller[9], 270 deg") && !svg.contains("NaN")
    );
}

#[test]
fn whirl_tells_the_steady_state_and_follows_it() {
    let scene = "scenes/grease_guide.json";
    let printed = text(&run(&["whirl", scene]).stdout);
    for expected in ["whirl speed", "stable", "yes", "eigenvalues"] {
        assert!(printed.contains(expected), "{expected} in {printed}");
    }
    let steady: Value = serde_json::from_slice(&run(&["whirl", scene, "--json"]).stdout).expect("JSON");
    assert!((steady["whirl_speed"].as_f64().expect("a number") / -1962.1 - 1.0).abs() < 1e-3, "{steady}");
    assert_eq!(steady["eigenvalues"].as_array().map(Vec::len), Some(5));
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("whirl");
    let vary = "cage.guide.diametral_clearance=0.40e-3:0.46e-3";
    let output = run(&["whirl", scene, "--vary", vary, "--out", &out.to_string_lossy()]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("ends at range"), "{}", text(&output.stdout));
    let branch = json(&out.join("whirl.json"));
    assert_eq!(branch["end"], "range");
    assert!(branch["points"].as_array().is_some_and(|points| points.len() > 5), "{branch}");
    let svg = std::fs::read_to_string(out.join("whirl.svg")).expect("a picture");
    assert!(svg.contains("whirl speed [rad/s]") && !svg.contains("NaN"));
    for (arguments, says) in [
        (
            vec!["whirl", "scenes/nu2310.json"],
            "rollers: a steady whirl is that of a cage among elements of prescribed motion",
        ),
        (vec!["whirl", "scenes/angular_contact_70_cage.json"], "balls: a steady whirl is that"),
        (vec!["whirl", scene, "--vary", "cage.mass=1"], "PATH=FROM:TO"),
        (vec!["whirl", scene, "--vary", "cage.masses=1e-2:2e-2"], "cage.masses"),
    ] {
        let refused = run(&arguments);
        assert!(
            !refused.status.success() && text(&refused.stderr).contains(says),
            "{}",
            text(&refused.stderr)
        );
    }
}
