//! The report of a run: one file that loads nothing, with the same bytes for the same run, that a browser shows.
#![cfg(feature = "cli")]

use crate::cli::{run, text};
use crate::hosts::present;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Runs `cagedyn report` with its file at `out`.
fn report(source: &str, out: &Path, more: &[&str]) -> Output {
    let out = out.to_string_lossy();
    run(&[&["report", source, "--out", &out][..], more].concat())
}

/// The same, where it succeeds: the page.
fn page(source: &str, out: &Path, more: &[&str]) -> String {
    let output = report(source, out, more);
    assert!(output.status.success(), "{source}: {}", text(&output.stderr));
    read(out)
}

/// What the animation moves by.
fn motion(page: &str) -> Value {
    let json = page.split("id=\"motion\">").nth(1).and_then(|rest| rest.split("</script>").next());
    serde_json::from_str(json.expect("an animation")).expect("JSON")
}

/// Value `i` of a packed column.
fn unpacked(packed: &Value, i: usize) -> f64 {
    packed["unit"].as_f64().expect("a unit") * packed["values"][i].as_f64().expect("a number")
}

/// What a page would load or run beside what it carries.
fn loads(page: &str) -> Vec<&str> {
    let marks = [
        "src=",
        "href=",
        "url(",
        "@import",
        "fetch(",
        "XMLHttpRequest",
        "import(",
        "<link",
        "<iframe",
        "<object",
        "<embed",
    ];
    let found = marks.into_iter().filter(|mark| page.contains(mark));
    // In the licence of what pictures are zoomed with.
    let known = ["http://www.w3.org/2000/svg", "https://github.com/timmywil/panzoom"];
    let links = page.match_indices("http").map(|(i, _)| &page[i..page.len().min(i + 60)]);
    let links = links.filter(|link| link.starts_with("http://") || link.starts_with("https://"));
    found.chain(links.filter(|link| !known.iter().any(|known| link.starts_with(known)))).collect()
}

#[test]
fn a_report_is_one_small_file_that_loads_nothing_and_is_the_same_from_its_folder() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name);
    for (scene, shown) in [
        ("nu2310", ["Roller 0: slip", "largest roller slip", "raceway friction"]),
        ("grease_guide_elastic", ["Whirl of the cage", "cage.mode[2].amplitude", "cage bending"]),
    ] {
        let file = format!("scenes/{scene}.json");
        let more = ["--until", "0.04"];
        let first = page(&file, &at("first.html"), &more);
        assert_eq!(first, page(&file, &at("second.html"), &more), "{scene}");
        assert_eq!(loads(&first), Vec::<&str>::new(), "{scene}");
        assert!(first.len() < 2_000_000 && first.starts_with("<!DOCTYPE html>"), "{scene}: {}", first.len());
        let out = at("out").to_string_lossy().into_owned();
        assert!(run(&["run", &file, "--until", "0.04", "--out", &out]).status.success());
        assert_eq!(first, page(&out, &at("third.html"), &[]), "{scene}: the folder has another report");
        for part in [
            "<b>Trusted</b>",
            "under these conditions",
            "Judged is how exactly",
            "Permission is hereby granted",
            "Power balance",
            "Orbit of the cage centre",
            "Amplitude spectrum",
            "force evaluations",
        ]
        .into_iter()
        .chain(shown)
        {
            assert!(first.contains(part), "{scene} has no {part}");
        }
        assert!(!first.contains("{{") && !first.contains("NaN") && !first.contains("wall time"), "{scene}");
    }
    let names: Vec<_> =
        std::fs::read_dir(dir.path()).expect("a folder").flatten().map(|e| e.file_name()).collect();
    assert_eq!(names.len(), 4, "{names:?}");
}

/// The numbers of the page are those of the table and the summary.
#[test]
fn a_report_has_the_numbers_of_the_run() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().join("out");
    let folder = out.to_string_lossy().into_owned();
    let printed = run(&["run", "scenes/nu2310_elastic.json", "--until", "0.02", "--out", &folder]);
    assert!(printed.status.success(), "{}", text(&printed.stderr));
    let page = page(&folder, &dir.path().join("x.html"), &[]);
    let motion = motion(&page);
    let table = read(&out.join("timeseries.csv"));
    let mut rows = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = rows.next().expect("a head");
    let rows: Vec<_> = rows.collect();
    let column =
        |name: &str| head.iter().position(|cell| cell.starts_with(&format!("{name} ["))).expect(name);
    let value = |row: usize, name: &str| rows[row][column(name)].parse::<f64>().expect("a number");
    let frames = motion["times"].as_array().expect("times").len();
    assert_eq!(frames, rows.len());
    let mut largest_pocket_force: f64 = 0.0;
    for i in [0, 7, frames - 1] {
        let near = |packed: &Value, at: usize, x: f64, of: f64| {
            let found = unpacked(packed, at);
            assert!((found - x).abs() <= 1e-4 * of, "frame {i}: {found}, not {x}");
        };
        near(&motion["cage"]["y"], i, value(i, "cage.y"), 2e-4);
        near(&motion["turn"], i, value(i, "cage.angle"), 3.0);
        near(&motion["forces"]["outer"], 3 * frames + i, value(i, "roller[3].outer_force"), 3000.0);
        near(&motion["forces"]["guide"][1], i, value(i, "guide.force_z"), 50.0);
        let (amplitude, phase) = (value(i, "cage.mode[3].amplitude"), value(i, "cage.mode[3].phase"));
        near(&motion["cage"]["waves"][1][2], i, amplitude * phase.sin(), 1e-5);
        let orbit = value(i, "roller[5].orbit_angle") - std::f64::consts::TAU * 5.0 / 12.0;
        near(&motion["ahead"], 5 * frames + i, orbit - value(i, "cage.angle"), 0.1);
    }
    for (j, i) in (0..12).flat_map(|j| (0..frames).map(move |i| (j, i))) {
        let of_steps = ["min", "max"].map(|part| value(i, &format!("roller[{j}].pocket_force {part}")));
        // The shaft turns clockwise, so what drives the cage is negative here.
        let largest = if of_steps[1] > -of_steps[0] { -of_steps[1] } else { -of_steps[0] };
        let shown = unpacked(&motion["forces"]["pocket"], j * frames + i);
        assert!(
            (shown - largest).abs() < 0.1 || of_steps[0] == -of_steps[1],
            "{j} {i}: {shown}, not {largest}"
        );
        largest_pocket_force = largest_pocket_force.max(shown.abs());
    }
    assert!(largest_pocket_force > 10.0);
    // Rollers spin against the shaft, about as fast as without slip.
    let spin = unpacked(&motion["spin"], frames - 1);
    assert!(spin > 5.0 && spin < 0.02 * 1100.0, "{spin}");
    for line in text(&printed.stdout).lines().filter(|line| line.starts_with("  cage ")) {
        let number = line[2..].split_whitespace().find(|word| word.parse::<f64>().is_ok()).expect("a number");
        assert!(page.contains(&number.replace('-', "\u{2212}")), "{line}");
    }
}

#[test]
fn texts_of_a_scene_are_escaped_and_assumed_values_marked() {
    let dir = tempfile::tempdir().expect("a directory");
    let scene = dir.path().join("scene.json");
    let mut value: Value = serde_json::from_str(&read(Path::new("scenes/grease_guide.json"))).expect("JSON");
    let title = "</script><script>alert('x')</script><!-- & \"q\" {{css}}";
    value["title"] = title.into();
    value["record"] = json!({"duration": 5e-3, "interval": 1e-4});
    value["comment"] = json!({
        "assumed": {"cage.mass": "weighed <b>once</b>", "kinematic_elements.motion": "", "cage.colour": "red"},
        "by": "</pre><script>",
    });
    std::fs::write(&scene, value.to_string()).expect("a scene");
    let more = ["--set", "cage.inertia=2.6e-5"];
    let page = page(
        &scene.to_string_lossy(),
        &dir.path().join("x.html"),
        &[&more[..], &["--set", "title=</title>&"]].concat(),
    );
    assert!(page.contains("<title>&lt;/title&gt;&amp;</title>"), "titles");
    let plain = self::page(&scene.to_string_lossy(), &dir.path().join("y.html"), &[]);
    assert_eq!(plain.matches("<script").count(), 3, "the script, what it zooms with and its numbers");
    assert_eq!((plain.matches("</script>").count(), plain.matches("</title>").count()), (3, 1));
    assert!(
        plain.contains("&lt;/script&gt;&lt;script&gt;alert(&#39;x&#39;)") && plain.contains("{{css}}</h1>")
    );
    assert!(plain.contains("0.01234,</mark> <i>assumed: weighed &lt;b&gt;once&lt;/b&gt;</i>"), "a value");
    assert!(plain.contains("&quot;motion&quot;: {</mark> <i>assumed</i>"), "a block");
    assert!(
        plain.contains("not in the scene: cage.colour")
            && plain.contains("Comment: by: &lt;/pre&gt;&lt;script&gt;")
    );
    assert!(plain.contains("3 values that the scene names as assumed") && !plain.contains("replaced</i>"));
    assert!(page.contains("&quot;inertia&quot;: 0.000026,</b> <i>replaced</i>"), "a replaced value");
    let silent =
        self::page("scenes/ball_short_bearing.json", &dir.path().join("z.html"), &["--until", "2e-3"]);
    assert!(silent.contains("does not say which of its values are assumed"));
}

#[test]
fn what_is_missing_is_said() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().join("x.html");
    let few =
        ["--until", "0.01", "--set", r#"record.channels=["cage.?","cage.angle","roller[*].orbit_angle"]"#];
    let shown = page("scenes/nu2310.json", &out, &[&few[..], &["--set", "record.extremes=[]"]].concat());
    let missing = shown.split("What is not in this report").nth(1).expect("a list");
    for part in [
        "pocket forces in",
        "forces on the raceways in",
        "guide force in",
        "spin of the rollers in",
        "place of the inner ring in",
    ] {
        assert!(missing.contains(part), "{part}");
    }
    assert!(motion(&shown)["forces"]["pocket"].is_null());
    let none =
        page("scenes/nu2310.json", &out, &["--until", "0.01", "--set", r#"record.channels=["cage.y"]"#]);
    assert!(none.contains("animation: needs cage.z") && !none.contains("<canvas"), "no animation");
    let bare = page("scenes/nu2310.json", &out, &["--until", "0.01", "--set", "cage=null"]);
    assert!(motion(&bare)["cage"].is_null() && !bare.contains("What is not in this report"));

    // A folder that has lost files still has a report of what is left.
    let folder = dir.path().join("out");
    let text_of = folder.to_string_lossy().into_owned();
    assert!(run(&["run", "scenes/nu2310.json", "--until", "0.01", "--out", &text_of]).status.success());
    std::fs::write(folder.join("cage_orbit.svg"), "<svg><script>alert(1)</script></svg>").expect("a file");
    std::fs::remove_file(folder.join("timeseries.csv")).expect("a table");
    let lost = page(&text_of, &out, &[]);
    assert!(lost.contains("animation: timeseries.csv is not in the folder") && !lost.contains("alert(1)"));
    assert!(lost.contains("picture cage_orbit.svg: is no picture of this program"));
    std::fs::remove_file(folder.join("scene_as_run.json")).expect("a scene");
    assert!(page(&text_of, &out, &[]).contains("The scene is not in the folder"));
}

#[test]
fn runs_that_are_not_to_be_trusted_have_a_report_that_says_so() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().join("x.html");
    let solver = r#"solver={"method": {"leapfrog": {"step": 1e-5}}}"#;
    let output = report("scenes/nu2310.json", &out, &["--until", "0.01", "--set", solver]);
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stderr));
    let page = read(&out);
    assert!(
        page.contains("<b>Not to be trusted</b><ul><li>leapfrog steps of 1.000e-5 s are unstable"),
        "doubts"
    );
    let output = report("scenes/nu2310.json", &out, &["--set", r#"solver={"max_steps":10}"#]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        read(&out).contains("<b>Incomplete</b><ul><li>The run failed: at t = ")
            && read(&out).contains("The results are incomplete")
    );
}

#[test]
fn mistakes_are_one_line() {
    let dir = tempfile::tempdir().expect("a directory");
    let at = |name: &str| dir.path().join(name).to_string_lossy().into_owned();
    for (name, files) in [
        ("empty", vec![]),
        ("cases", vec![("cases.csv", "case,inner ring speed [1/min]\n")]),
        ("begun", vec![("summary.json", r#"{"title": "x", "complete": false}"#)]),
        ("other", vec![("summary.json", r#"{"title": 3}"#)]),
        ("deep", vec![("summary.json", "[[[")]),
    ] {
        std::fs::create_dir(dir.path().join(name)).expect("a folder");
        for (file, content) in files {
            std::fs::write(dir.path().join(name).join(file), content).expect("a file");
        }
    }
    std::fs::write(dir.path().join("mine.html"), "<p>mine</p>").expect("a file");
    let out = at("x.html");
    let scene = "scenes/grease_guide.json";
    for (source, more, says) in [
        (at("empty"), &[][..], "is no folder of a run"),
        (at("cases"), &[], "is the folder of a case set"),
        (at("begun"), &[], "the run has not ended"),
        (at("other"), &[], "is not as this version"),
        (at("deep"), &[], "is not as this version"),
        (at("begun"), &["--set", "cage.mass=1"], "this one has been made"),
        (at("begun"), &["--until", "0.1"], "this one has been made"),
        (at("none.json"), &[], "none.json"),
        (scene.to_owned(), &["--set", "cage.colour=3"], "cage.colour"),
        (scene.to_owned(), &["--set", "record.duration=-1"], "record.duration"),
        ("README.md".to_owned(), &[], "README.md"),
    ] {
        refused(&report(&source, Path::new(&out), more), says);
        assert!(!Path::new(&out).exists(), "{source}");
    }
    for (out, says) in [
        (at("no/such/x.html"), "no/such/x.html"),
        (at("mine.html"), "is no report of this program"),
        (at("empty"), "is a folder"),
    ] {
        refused(&report(scene, Path::new(&out), &["--until", "500"]), says);
    }
    assert_eq!(read(&dir.path().join("mine.html")), "<p>mine</p>");
}

#[test]
fn a_name_without_suffix_gets_it() {
    let dir = tempfile::tempdir().expect("a directory");
    for (asked, made) in
        [("a", "a.html"), ("nu.2310", "nu.2310.html"), ("b.HTML", "b.HTML"), ("c.htm", "c.htm")]
    {
        let out = report("scenes/grease_guide.json", &dir.path().join(asked), &["--until", "1e-4"]);
        assert!(out.status.success(), "{}", text(&out.stderr));
        assert!(dir.path().join(made).is_file() && text(&out.stdout).contains(made), "{asked}");
    }
    assert_eq!(std::fs::read_dir(dir.path()).expect("a folder").count(), 4);
}

fn refused(output: &Output, says: &str) {
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.starts_with("cagedyn: ") && message.contains(says), "{says}: {message}");
    assert_eq!(message.trim_end().lines().count(), 1, "{message}");
}

/// A browser without a window, with a profile of its own.
fn browser(profile: &Path) -> Option<Command> {
    let program = std::env::var_os("CAGEDYN_BROWSER").map_or(PathBuf::from("chromium"), PathBuf::from);
    if !present(&program, &["--version"], &["CAGEDYN_REQUIRE_ALL_HOSTS"]) {
        return None;
    }
    let mut command = Command::new(program);
    command.args([
        "--headless=new",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-dev-shm-usage",
        "--hide-scrollbars",
    ]);
    command.args(["--enable-logging=stderr", "--v=0", "--window-size=1200,2200"]);
    command.arg(format!("--user-data-dir={}", profile.display()));
    Some(command)
}

/// Plays, scrubs and changes every control of reports of all kinds, and looks at pictures of them.
#[test]
fn a_browser_shows_the_report() {
    let dir = tempfile::tempdir().expect("a directory");
    if browser(dir.path()).is_none() {
        return;
    }
    let at = |name: &str| dir.path().join(name);
    let inner = r#"cage.guide={"ring":"inner_ring","guide_radius":43e-3,"diametral_clearance":0.4e-3,"film":{"short_bearing":{"land_width":4e-3}}}"#;
    for (name, scene, more) in [
        ("rollers", "nu2310", vec![]),
        ("elastic", "grease_guide_elastic", vec![]),
        ("without_cage", "nu2310", vec!["--set", "cage=null"]),
        ("without_guide", "grease_guide", vec!["--set", "cage.guide=null"]),
        ("inner_guide", "ball_short_bearing", vec!["--set", inner]),
        ("in_space", "angular_contact_70", vec![]),
        ("of_three_kinds", "angular_contact_70", vec!["--set", r#"record.channels=["ball[*].orbit_angle"]"#]),
        ("no_animation", "nu2310", vec!["--set", r#"record.channels=["cage.y"]"#]),
    ] {
        let html = at(&format!("{name}.html"));
        let page = page(&format!("scenes/{scene}.json"), &html, &[&["--until", "0.02"][..], &more].concat());
        let address = format!("file://{}#selfcheck", html.display());
        let output = browser(&at("profile")).expect("it was there").args(["--dump-dom", &address]).output();
        let output = output.expect("a browser");
        let (dom, log) = (text(&output.stdout), text(&output.stderr));
        assert!(output.status.success() && dom.contains("<html"), "{name}: {log}");
        let root = dom.split("<html").nth(1).and_then(|rest| rest.split('>').next()).unwrap_or_default();
        let shows = frames(&page).map_or("no animation".to_owned(), |n| format!("{n} frames"));
        let done = root.contains(&format!("data-selfcheck=\"ok, {shows}\""));
        assert!(done && !root.contains("data-error"), "{name}: {root}");
        // What the browser says of itself is no matter of the page.
        let of_page: Vec<&str> = log.lines().filter(|line| line.contains("CONSOLE")).collect();
        assert!(of_page.is_empty(), "{name}: {of_page:?}");
    }
    // Narrow as a telephone, where a page that is wider than its window fails its check.
    let address = format!("file://{}#selfcheck", at("rollers.html").display());
    let mut narrow = browser(&at("profile")).expect("it was there");
    let output = narrow.args(["--window-size=390,900", "--dump-dom", &address]).output().expect("a browser");
    assert!(text(&output.stdout).contains("data-selfcheck=\"ok, "), "{}", text(&output.stderr));
    let picture = |hash: &str| {
        let png = at("x.png");
        let address = format!("file://{}#{hash}", at("rollers.html").display());
        let mut browser = browser(&at("profile")).expect("it was there");
        let output =
            browser.arg(format!("--screenshot={}", png.display())).arg(address).output().expect("a browser");
        assert!(output.status.success(), "{}", text(&output.stderr));
        std::fs::read(png).expect("a picture")
    };
    let [start, later] = ["t=0", "t=0.013&m=6"].map(picture);
    assert!(
        start.len() > 50_000 && later.len() > 50_000 && start != later,
        "{} {}",
        start.len(),
        later.len()
    );
    let pdf = at("x.pdf");
    let mut printer = browser(&at("profile")).expect("it was there");
    let printed = printer.arg(format!("--print-to-pdf={}", pdf.display())).arg(at("rollers.html")).output();
    assert!(printed.is_ok_and(|output| output.status.success()));
    assert!(std::fs::read(pdf).is_ok_and(|bytes| bytes.starts_with(b"%PDF") && bytes.len() > 50_000));
}

/// Number of frames, where there is an animation.
fn frames(page: &str) -> Option<usize> {
    page.contains("id=\"motion\"").then(|| motion(page)["times"].as_array().map_or(0, Vec::len))
}
