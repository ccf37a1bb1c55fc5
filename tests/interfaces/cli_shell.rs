//! What shells and scripts want of the tool: completions, manual pages, silence, JSON in place of tables.
#![cfg(feature = "cli")]

use crate::cli::{json, run, text};
use serde_json::Value;
use std::process::Command;

/// Commands as the help lists them.
fn commands() -> Vec<String> {
    let help = text(&run(&["--help"]).stdout);
    let list =
        help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    list.filter_map(|line| line.split_whitespace().next())
        .map(str::to_owned)
        .filter(|name| name != "help")
        .collect()
}

#[test]
fn completions_know_every_command() {
    let commands = commands();
    assert!(
        ["check", "sweep", "merge"].iter().all(|name| commands.iter().any(|command| command == name)),
        "{commands:?}"
    );
    for shell in ["bash", "zsh", "fish"] {
        let output = run(&["completions", shell]);
        let script = text(&output.stdout);
        assert!(output.status.success() && output.stderr.is_empty());
        for command in &commands {
            assert!(script.contains(command.as_str()), "{shell}: no {command}");
        }
        for option in ["set", "max-wall-time", "warm-up", "part"] {
            assert!(script.contains(option), "{shell}: no {option}");
        }
    }
    assert_eq!(run(&["completions", "cmd.exe"]).status.code(), Some(2));
}

/// What bash offers after a line.
#[test]
fn bash_completes_with_the_script() {
    let script = text(&run(&["completions", "bash"]).stdout);
    let offered = |words: &[&str]| {
        let list: Vec<String> = words.iter().map(|word| format!("'{word}'")).collect();
        let ask = format!(
            "COMP_WORDS=({}); COMP_CWORD={}; _cagedyn cagedyn '{}' '{}'; printf '%s\\n' \"${{COMPREPLY[@]}}\"",
            list.join(" "),
            words.len() - 1,
            words[words.len() - 1],
            words[words.len() - 2]
        );
        let output =
            Command::new("bash").args(["--norc", "-c", &format!("{script}\n{ask}")]).output().expect("bash");
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout).lines().map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(offered(&["cagedyn", "swe"]), ["sweep"]);
    assert_eq!(offered(&["cagedyn", "run", "--max"]), ["--max-wall-time"]);
    assert_eq!(offered(&["cagedyn", "completions", "fi"]), ["fish"]);
}

#[test]
fn manual_pages_have_every_command() {
    let output = run(&["man"]);
    let page = text(&output.stdout);
    assert!(output.status.success() && page.contains(".TH"), "{page}");
    let folder = tempfile::tempdir().expect("a directory");
    let out = folder.path().join("man1");
    assert!(run(&["man", "--out", &out.to_string_lossy()]).status.success());
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    for command in commands() {
        assert!(page.contains(&format!(".SH \"CAGEDYN {}\"", command.to_uppercase())), "{command}");
        let own = read(&format!("cagedyn-{command}.1"));
        assert!(own.contains(".TH") && own.contains(&format!("cagedyn {command}")), "{own}");
    }
    assert!(read("cagedyn.1").contains("cagedyn\\-run(1)"), "{}", read("cagedyn.1"));
    assert!(read("cagedyn-run.1").contains("max\\-wall\\-time"));
    assert!(read("cagedyn-sweep.1").contains("\\-\\-part") && read("cagedyn-merge.1").contains("PART_DIR"));
}

#[test]
fn quiet_commands_say_nothing_but_errors() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().join("out").to_string_lossy().into_owned();
    let silent = |arguments: &[&str], code: i32| {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", text(&output.stderr));
        assert!(output.stdout.is_empty(), "{arguments:?}: {}", text(&output.stdout));
        text(&output.stderr)
    };
    let brief = ["run", "scenes/nu2310.json", "--until", "1e-3", "--out", &out];
    assert_eq!(silent(&[&brief[..], &["--quiet"]].concat(), 0), "");
    assert_eq!(json(&dir.path().join("out/summary.json"))["complete"], true);
    assert_eq!(silent(&[&["-q"][..], &brief].concat(), 0), "");
    let cases = ["cases", "scenes/nu2310_profile.cases.json", "--until", "1e-3", "--out", &out, "--quiet"];
    assert_eq!(silent(&cases, 0), "");
    let unstable = r#"solver={"method": {"leapfrog": {"step": 1e-5}}}"#;
    let doubted =
        ["run", "scenes/nu2310.json", "--until", "0.01", "--out", &out, "--set", unstable, "--quiet"];
    assert!(silent(&doubted, 3).contains("not to be trusted"));
    assert!(silent(&["run", "no/such.json", "--out", &out, "--quiet"], 1).contains("no/such.json"));
    assert_eq!(silent(&["check", "scenes/nu2310.json", "--set", "cage=7", "-q"], 1), "");
    assert_eq!(silent(&["whirl", "scenes/grease_guide.json", "-q"], 0), "");
}

#[test]
fn runs_and_contents_are_told_as_json() {
    let dir = tempfile::tempdir().expect("a directory");
    let out = dir.path().to_string_lossy().into_owned();
    let output = run(&["run", "scenes/nu2310.json", "--until", "2e-3", "--out", &out, "--json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let told: Value = serde_json::from_slice(&output.stdout).expect("JSON and nothing else");
    assert_eq!(told, json(&dir.path().join("summary.json")));

    let output = run(&["info", "scenes/nu2310.json", "--json"]);
    let info: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(info["states"], serde_json::json!({"positions": 29, "velocities": 41, "all": 70}));
    let names: Vec<&str> =
        info["bodies"].as_array().into_iter().flatten().filter_map(|b| b["name"].as_str()).collect();
    assert_eq!(names, ["outer_ring", "inner_ring", "cage", "roller"]);
    let channels = info["channels"].as_array().expect("a list");
    let y = channels.iter().find(|channel| channel["name"] == "cage.y").expect("a channel");
    assert_eq!((&y["unit"], &y["recorded"]), (&"m".into(), &true.into()));
    assert_eq!(info["geometry"]["element_radius_m"], 7.5e-3);
    assert!(
        info["geometry"]["inner_ring_speed_rad_s"].as_f64().is_some_and(|speed| speed < -100.0),
        "{info}"
    );
}
