//! Instructions of a run by what they are spent on, beside those of its force evaluations alone: `make profile`.
//!
//! Counted by callgrind, which takes the instructions of AVX2, so that nothing depends on how busy the machine is. Prints a
//! table; with `--docs` it is also written into `docs/results/profile.md`, and every function of every scene into
//! `out/profile/`.

mod callgrind;
mod phases;

use cagedyn::{Model, Result, Sim};
use cagedyn_studies::effects::count::States;
use cagedyn_studies::page::{self, Changes, Make, on_all_cores, scene};
use cagedyn_studies::table::Table;
use callgrind::Counted;
use phases::{PHASES, PLAIN, phase_of};
use serde_json::json;
use std::collections::BTreeMap;
use std::hint::black_box;
use std::path::Path;
use std::sync::Arc;

const PAGE: &str = "docs/results/profile.md";
const FOLDER: &str = "out/profile";
/// Says which part of which scene to run, so that callgrind can look at it.
const PART: &str = "CAGEDYN_PROFILE_PART";
/// States at which evaluations are counted, at equal intervals of the stretch that is run.
const STATES: usize = 20;

/// What is run: its name, its scene, the stretch of time that is counted (s), and whether by the leapfrog alone.
struct Case(&'static str, &'static str, [f64; 2], bool);

const CASES: [Case; 8] = [
    Case("NU2310, leapfrog", "nu2310", [10e-3, 20e-3], true),
    Case("NU2310", "nu2310", [10e-3, 20e-3], false),
    Case("NU2310, grease", "nu2310_grease", [10e-3, 15e-3], false),
    Case("greased guide", "grease_guide", [10e-3, 20e-3], false),
    Case("ball bearing in oil", "ball_short_bearing", [10e-3, 20e-3], false),
    Case("elastic ring", "grease_guide_elastic", [5e-3, 7e-3], false),
    Case("balls in space", "angular_contact_70", [1e-3, 5e-3], false),
    Case("balls and cage in space", "angular_contact_70_cage", [1e-3, 3e-3], false),
];

/// What is counted of a case.
const RUN: &str = "run";
const EVALUATIONS: &str = "evaluations";
const DERIVATIVES: &str = "derivatives";

fn main() -> Result<()> {
    if let Ok(part) = std::env::var(PART) {
        let (case, kind) = part.split_once(' ').expect("the number of a case and what to count");
        return run_part(&CASES[case.parse::<usize>().expect("a number")], kind);
    }
    let tables: &[(&str, Make)] = &[("phases", phases)];
    page::print(PAGE, tables)
}

/// What callgrind counts. It is found by its name.
#[inline(never)]
fn counted_part(work: &mut dyn FnMut() -> Result<()>) -> Result<()> {
    work()
}

/// Runs a part of a case and prints its steps and evaluations.
fn run_part(Case(_, name, [from, to], leapfrog): &Case, kind: &str) -> Result<()> {
    let solver = ("solver", json!({ "method": { "leapfrog": {} } }));
    let changes: Changes = leapfrog.then_some(solver).into_iter().collect();
    let mut sim = Sim::new(Arc::new(Model::new(scene(name, &changes)?)?))?;
    sim.advance_to(*from)?;
    if kind == RUN {
        let before = sim.statistics();
        counted_part(&mut || sim.advance_to(*to))?;
        let after = sim.statistics();
        println!("{} {}", after.driver.steps - before.driver.steps, after.evaluations - before.evaluations);
        return Ok(());
    }
    let mut states = States::default();
    for i in 1..=STATES {
        let time = from + (to - from) * i as f64 / STATES as f64;
        sim.advance_to(time)?;
        states.0.push((time, sim.state().to_vec()));
    }
    let n = sim.state().len();
    let pattern = sim.model().jacobian_pattern();
    let (mut rate, mut values) = (vec![0.0; n], vec![0.0; pattern.rows.len()]);
    // Memory for derivatives is taken once.
    let (time, state) = &states.0[0];
    sim.sparse_jacobian(*time, state, &pattern, &mut values)?;
    counted_part(&mut || {
        states.0.iter().try_for_each(|(time, state)| match kind {
            EVALUATIONS => sim.derivative(*time, black_box(state), &mut rate),
            _ => sim.sparse_jacobian(*time, black_box(state), &pattern, &mut values),
        })
    })?;
    println!("{STATES} {STATES}");
    Ok(())
}

/// Steps, evaluations, and what was counted.
struct Found {
    steps: f64,
    evaluations: f64,
    counted: Vec<Counted>,
}

impl Found {
    fn of(case: usize, kind: &str) -> Result<Self> {
        let program = std::env::current_exe().expect("this program has a path");
        let part = format!("{case} {kind}");
        let (text, counted) = callgrind::count(&program, (PART, &part), "*counted_part*")?;
        let mut numbers = text.split_whitespace().map(|word| word.parse().unwrap_or(f64::NAN));
        let mut next = || numbers.next().unwrap_or(f64::NAN);
        Ok(Self { steps: next(), evaluations: next(), counted })
    }

    fn sum(&self) -> f64 {
        self.counted.iter().map(|counted| counted.count as f64).sum()
    }

    /// Instructions of each phase per step.
    fn phases(&self) -> [f64; PHASES.len()] {
        let mut sums = [0.0; PHASES.len()];
        for Counted { functions, count } in &self.counted {
            sums[phase_of(functions)] += *count as f64 / self.steps;
        }
        sums
    }

    /// Writes instructions per step by phase and function, the dearest first.
    fn save(&self, name: &str) -> Result<()> {
        let mut sums: BTreeMap<(usize, &str), f64> = BTreeMap::new();
        for Counted { functions, count } in &self.counted {
            let own = functions.iter().find(|name| name.contains("cagedyn")).or(functions.first());
            let place = (phase_of(functions), own.map_or("", String::as_str));
            *sums.entry(place).or_default() += *count as f64 / self.steps;
        }
        let mut list: Vec<_> = sums.into_iter().collect();
        list.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut table = Table::new(name, &["phase", "function", "instructions per step"]);
        for ((phase, function), count) in list {
            table.add([PHASES[phase].0.to_owned(), function.to_owned(), format!("{count:.1}")]);
        }
        std::fs::create_dir_all(FOLDER).map_err(|e| cagedyn_studies::file_error(Path::new(FOLDER), e))?;
        table.save(Path::new(FOLDER))
    }
}

/// Instructions per step of every case by phase, and what they come to beside those of evaluations.
fn phases(name: &str) -> Result<Table> {
    const KINDS: [&str; 3] = [RUN, EVALUATIONS, DERIVATIVES];
    let mut parts =
        on_all_cores(CASES.len() * KINDS.len(), |i| Found::of(i / KINDS.len(), KINDS[i % KINDS.len()]))
            .into_iter()
            .collect::<Result<Vec<_>>>()?
            .into_iter();
    let mut found = Vec::new();
    while let (Some(run), Some(alone), Some(derivatives)) = (parts.next(), parts.next(), parts.next()) {
        found.push([run, alone, derivatives]);
    }
    let mut head = vec!["instructions per step", "least of NU2310"];
    head.extend(CASES.iter().map(|case| case.0));
    let mut table = Table::new(name, &head);
    let mut columns = Vec::new();
    for (case, [run, ..]) in CASES.iter().zip(&found) {
        run.save(case.0)?;
        columns.push(run.phases());
    }
    let mut line = |title: &str, least: String, of: &dyn Fn(usize) -> String| {
        let numbers = (0..CASES.len()).map(of);
        table.lines.push([title.to_owned(), least].into_iter().chain(numbers).collect());
    };
    for (phase, (title, _)) in PHASES.iter().enumerate() {
        let least = PLAIN[phase].map_or(String::new(), |count| count.to_string());
        line(title, least, &|case| format!("{:.0}", columns[case][phase]));
    }
    let plain: u32 = PLAIN.iter().flatten().sum();
    line("all", plain.to_string(), &|case| format!("{:.0}", found[case][0].sum() / found[case][0].steps));
    line("evaluations per step", "1".to_owned(), &|case| {
        format!("{:.2}", found[case][0].evaluations / found[case][0].steps)
    });
    let per_evaluation = |found: &Found| found.sum() / found.evaluations;
    line("per evaluation", String::new(), &|case| format!("{:.0}", per_evaluation(&found[case][0])));
    line("an evaluation alone", String::new(), &|case| format!("{:.0}", per_evaluation(&found[case][1])));
    line("run over its evaluations", String::new(), &|case| {
        format!("{:.2}", per_evaluation(&found[case][0]) / per_evaluation(&found[case][1]))
    });
    line("with derivatives over without", String::new(), &|case| {
        format!("{:.2}", per_evaluation(&found[case][2]) / per_evaluation(&found[case][1]))
    });
    Ok(table)
}
