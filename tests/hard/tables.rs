//! The tables of the page on hard cases.

use crate::agreement::agreement;
use crate::common::{replace_between, repository};
use crate::{Case, Outcome, cases, run};
use serde_json::json;

const METHODS: [(&str, &str); 5] = [
    ("auto", "auto"),
    ("leapfrog", "leapfrog"),
    ("dormand_prince", "Dormand-Prince"),
    ("rosenbrock", "Rosenbrock"),
    ("radau", "Radau"),
];
const PRESETS: [&str; 3] = ["draft", "engineering", "reference"];
/// Wall time of one run, s.
const WALL_TIME: f64 = 20.0;

/// One number for a table, in three digits.
fn short(x: f64) -> String {
    if x == 0.0 { "0".to_owned() } else { format!("{x:.1e}") }
}

fn thousands(n: u64) -> String {
    if n < 10_000 { n.to_string() } else { format!("{:.0}k", n as f64 / 1e3) }
}

/// Evaluations and residual, or why there are none.
fn brief(o: &Outcome) -> String {
    match &o.error {
        None => format!("{}, {}", thousands(o.evaluations), short(o.residual.abs())),
        Some(e) => {
            format!("**{}**", e.status.name().trim_start_matches("ERR_").to_lowercase().replace('_', " "))
        }
    }
}

/// The mean that is farthest from CVODE's in units of its band: its difference in shares of the clearance, rad/s or N m, and
/// in bands.
fn compared(case: &Case) -> String {
    let names = ["y", "z", if case.scene["cage"].is_null() { "torque" } else { "speed" }];
    let verdicts = match agreement(case, &json!({})) {
        Ok(verdicts) => verdicts,
        Err(e) => return format!("**{e}**"),
    };
    let worst = verdicts.iter().zip(names).max_by(|a, b| a.0.ratio().abs().total_cmp(&b.0.ratio().abs()));
    worst.map_or_else(String::new, |(v, name)| {
        let bands = format!("{:.1}", v.ratio().abs());
        let bands = if v.inside() { bands } else { format!("**{bands}**") };
        format!("{name} {:+.1e}, {bands}", v.difference)
    })
}

/// Prints the tables of the page; with `CAGEDYN_BLESS=1` also writes them there.
#[test]
#[ignore = "make hard"]
fn table() {
    let head = "| case | why it is hard | steps | rejected | smallest step, s | evaluations | energy | momentum | \
                from CVODE | cage |\n|---|---|---:|---:|---:|---:|---:|---:|---|---|\n";
    let mut detail = head.to_owned();
    let columns: Vec<String> =
        METHODS.iter().flat_map(|(_, name)| PRESETS.map(|preset| format!("{name} {preset}"))).collect();
    let mut all = format!("| case | {} |\n|---|{}\n", columns.join(" | "), "---:|".repeat(columns.len()));
    for case in cases() {
        let Case { name, why, .. } = case;
        let outcomes: Vec<Outcome> = METHODS
            .iter()
            .flat_map(|(method, _)| PRESETS.map(|preset| (method, preset)))
            .map(|(method, preset)| {
                run(&case, &json!({"preset": preset, "method": {*method: {}}}), WALL_TIME)
            })
            .collect();
        // The first is `auto`.
        let auto = &outcomes[1];
        let row = format!(
            "| {name} | {why} | {} | {} | {} | {} | {} | {} | {} | {} |\n",
            auto.steps,
            auto.rejected,
            short(auto.smallest_step),
            auto.evaluations,
            short(auto.residual.abs()),
            short(auto.momentum),
            compared(&case),
            auto.class
        );
        print!("{row}");
        detail += &row;
        let briefs: Vec<String> = outcomes.iter().map(brief).collect();
        all += &format!("| {name} | {} |\n", briefs.join(" | "));
    }
    println!("{all}");
    if std::env::var_os("CAGEDYN_BLESS").is_some() {
        let path = repository("docs/hard-cases.md");
        replace_between(&path, "<!-- auto -->", &detail);
        replace_between(&path, "<!-- all -->", &all);
    }
}
