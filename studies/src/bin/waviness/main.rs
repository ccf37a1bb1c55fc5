//! Raceways and rollers that are not round, and spalls: the lines in runs beside those of textbooks: `make waviness`.
//!
//! Prints tables; with `--docs` also those of `docs/results/waviness.md`.

use cagedyn::{Model, Result};
use cagedyn_studies::page::{self, Changes, Make, on_all_cores, scene};
use cagedyn_studies::table::Table;
use cagedyn_studies::waves::{INTERVAL, Run, amplitude, highest, preloaded, run, textbook, waves};
use serde_json::json;
use std::f64::consts::TAU;

const PAGE: &str = "docs/results/waviness.md";
/// Length of the runs, s.
const DURATION: f64 = 0.3;
const ROLLERS: u32 = 12;
/// Highest frequency that is looked at, Hz.
const HIGHEST: f64 = 1500.0;
/// Depth of a spall, m, its length and that of its edges as angles, rad.
const SPALL: [f64; 3] = [10e-6, 0.05, 0.01];
/// Direction of the load, rad.
const BOTTOM: f64 = 0.75 * TAU;

fn main() -> Result<()> {
    let tables: &[(&str, Make)] = &[("orders", orders), ("cage", cage), ("spalls", spalls)];
    page::print(PAGE, tables)
}

const CASES: [(&str, [u32; 5]); 3] = [
    ("inner ring", [11, 12, 13, 23, 25]),
    ("outer ring", [11, 12, 13, 23, 25]),
    ("one roller", [2, 3, 4, 5, 6]),
];

fn all() -> Vec<(&'static str, u32)> {
    CASES.iter().flat_map(|(body, orders)| orders.iter().map(|order| (*body, *order))).collect()
}

fn signed(list: impl IntoIterator<Item = f64>) -> String {
    let texts: Vec<String> = list.into_iter().map(|line| format!("{line:.1}")).collect();
    if texts.is_empty() { "none".to_owned() } else { texts.join(", ") }
}

fn in_preloaded(cases: &[(&'static str, u32)]) -> Result<Vec<Run>> {
    on_all_cores(cases.len(), |i| run(preloaded(&waves(cases[i].0, cases[i].1))?, DURATION))
        .into_iter()
        .collect()
}

/// The highest lines of the ring beside those of textbooks.
fn orders(name: &str) -> Result<Table> {
    let head = [
        "waves on",
        "order",
        "textbook, Hz",
        "highest lines of the ring, Hz",
        "their amplitudes, um",
        "next line, um",
    ];
    let mut table = Table::new(name, &head);
    let cases = all();
    for ((body, order), run) in cases.iter().zip(in_preloaded(&cases)?) {
        let expected = textbook(body, *order, run.turns, ROLLERS);
        let found = highest(&run.ring, HIGHEST, expected.len().max(1) + 1);
        let (lines, next) = found.split_at(expected.len());
        let of_lines = lines.iter().map(|[_, amplitude]| format!("{:.3}", 1e6 * amplitude));
        table.add([
            (*body).to_owned(),
            order.to_string(),
            signed(expected),
            signed(lines.iter().map(|[frequency, _]| *frequency)),
            of_lines.collect::<Vec<_>>().join(", "),
            format!("{:.1e}", 1e6 * next[0][1]),
        ]);
    }
    Ok(table)
}

/// What of the lines reaches the cage.
fn cage(name: &str) -> Result<Table> {
    let head =
        ["waves on", "order", "line of the ring, Hz", "cage there, nm", "cage there without waves, nm"];
    let mut table = Table::new(name, &head);
    let cases =
        [("inner ring", 13), ("inner ring", 11), ("outer ring", 13), ("one roller", 2), ("one roller", 4)];
    let round = run(preloaded(&Vec::new())?, DURATION)?;
    for ((body, order), run) in cases.iter().zip(in_preloaded(&cases)?) {
        for line in textbook(body, *order, run.turns, ROLLERS) {
            let of = |run: &Run| format!("{:.3}", 1e9 * amplitude(&run.cage, line));
            table.add([(*body).to_owned(), order.to_string(), format!("{line:.1}"), of(&run), of(&round)]);
        }
    }
    Ok(table)
}

/// A hollow around this angle (rad).
fn spall(middle: f64) -> serde_json::Value {
    let [depth, length, edge] = SPALL;
    let from = middle - 0.5 * length;
    json!({"angles": [from, from + edge, from + length - edge, from + length], "heights": [0.0, -depth, -depth, 0.0]})
}

/// Velocity of the ring along the load, as a motion.
fn velocity(run: &Run) -> Vec<[f64; 2]> {
    run.ring.windows(2).map(|pair| [(pair[1][1] - pair[0][1]) / INTERVAL, 0.0]).collect()
}

/// Lines of spalls at the bottom of the outer ring and in the inner one, under the load of the first paper.
fn spalls(name: &str) -> Result<Table> {
    let head =
        ["line", "Hz", "round, um/s", "spall of the outer ring, um/s", "spall of the inner ring, um/s"];
    let mut table = Table::new(name, &head);
    let changes: [Changes; 3] = [
        Vec::new(),
        vec![("outer_ring.waviness_table", spall(BOTTOM))],
        vec![("inner_ring.waviness_table", spall(0.0))],
    ];
    let of = |changes: &Changes| run(Model::new(scene("nu2310", changes)?)?, DURATION);
    let runs = on_all_cores(3, |i| of(&changes[i])).into_iter().collect::<Result<Vec<Run>>>()?;
    let z = f64::from(ROLLERS);
    let velocities: Vec<Vec<[f64; 2]>> = runs.iter().map(velocity).collect();
    let mut add = |line: String, times: [f64; 2]| {
        let at = |run: &Run| z * (times[0] * (run.turns[0] - run.turns[1]) + times[1] * run.turns[1]);
        let own = |k: usize| format!("{:.1}", 2e6 * amplitude(&velocities[k], at(&runs[k])));
        table.add([line, format!("{:.1}", at(&runs[0]).abs()), own(0), own(1), own(2)]);
    };
    for k in 1..=6 {
        add(format!("{k} Z f_c, rollers on the outer ring"), [0.0, f64::from(k)]);
    }
    for k in 1..=6 {
        add(format!("{k} Z (f_s - f_c), rollers on the inner ring"), [f64::from(k), 0.0]);
    }
    let rms = |k: usize| {
        let all = &velocities[k];
        format!("{:.0}", 1e6 * (all.iter().map(|v| v[0] * v[0]).sum::<f64>() / all.len() as f64).sqrt())
    };
    table.add(["all, root mean square".to_owned(), String::new(), rms(0), rms(1), rms(2)]);
    Ok(table)
}
