//! The tables of the page on verification.

use crate::cases::{Case, End, Reference, contacts, pressed, smooth, thick};
use crate::common::{replace_between, repository};
use crate::whirl::{mean, whirls};
use crate::{FIXED_SHARES, LEVELS, METHODS, orders};
use cagedyn_studies::cvode::Method;
use serde_json::json;

/// Rows of one scene.
struct Rows<'a> {
    case: &'a Case,
    reference: &'a End,
    text: String,
}

impl Rows<'_> {
    fn row(&mut self, method: &str, setting: &str, error: f64, order: Option<f64>, end: &End) {
        let order = order.map_or(String::new(), |order| format!("{order:.1}"));
        self.text += &format!(
            "| {} | {method} | {setting} | {error:.1e} | {order} | {} | {} |\n",
            self.case.name, end.steps, end.evaluations
        );
    }

    fn run(&mut self, method: &str, setting: &str, end: &End) {
        self.row(method, setting, self.case.distance(end, self.reference), None, end);
    }

    /// Runs whose step shrinks by `ratio` from one to the next.
    fn series(&mut self, method: &str, ratio: f64, show_order: bool, runs: &[(f64, End)]) {
        let errors: Vec<f64> = runs.iter().map(|(_, end)| self.case.distance(end, self.reference)).collect();
        let found = orders(&errors, ratio);
        for (i, ((step, end), error)) in runs.iter().zip(&errors).enumerate() {
            let order = (show_order && i > 0).then(|| found[i - 1]);
            self.row(method, &format!("{:.3} us", 1e6 * step), *error, order, end);
        }
    }
}

fn rows(case: &Case, is_smooth: bool) -> String {
    let Reference { end, doubt } = case.reference();
    let mut rows = Rows { case, reference: &end, text: String::new() };
    rows.row("CVODE, reference", "1e-12", doubt, None, &end);
    for level in LEVELS {
        for (method, name) in [(Method::Bdf, "CVODE, BDF"), (Method::Adams, "CVODE, Adams")] {
            rows.run(name, &format!("{level:e}"), &case.cvode(method, 0.0, level, case.max_step));
        }
    }
    for (method, name) in METHODS {
        for level in LEVELS.into_iter().chain([1e-10, 1e-12]) {
            rows.run(name, &format!("{level:e}"), &case.controlled(method, level));
        }
    }
    let chosen = case.run(&json!({"max_step": case.max_step}));
    rows.run("auto", "default", &chosen);
    let nominal = case.sim(&json!({"method": {"leapfrog": {}}})).nominal_step();
    let runs = [1.0, 4.0, 16.0].map(|share| (nominal / share, case.leapfrog(nominal / share)));
    rows.series("leapfrog", 4.0, is_smooth, &runs);
    rows.text
}

/// Steps of given size on a scene where the order of the error shows.
fn fixed_steps(case: &Case) -> String {
    let reference = case.exact();
    let mut rows = Rows { case, reference: &reference, text: String::new() };
    for (method, name) in &METHODS[..2] {
        let runs = FIXED_SHARES.map(|n| (case.duration / n, case.fixed(method, case.duration / n)));
        rows.series(&format!("{name}, fixed steps"), 2.0, true, &runs);
    }
    rows.text
}

/// Prints the tables of the page; with `CAGEDYN_BLESS=1` also writes them there.
#[test]
#[ignore = "make verify"]
fn tables() {
    let mut table =
        String::from("| scene | method | tolerance or step | error | order | steps | evaluations |\n");
    table += "|---|---|---|---|---|---|---|\n";
    for case in smooth() {
        table += &rows(&case, true);
    }
    table += &rows(&thick(), false);
    table += &fixed_steps(&pressed());
    for case in contacts() {
        table += &rows(&case, false);
    }
    let mut whirl =
        String::from("| method | mean whirl | largest difference between starts |\n|---|---|---|\n");
    for run in whirls() {
        let largest = run.figures.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let least = run.figures.iter().copied().fold(f64::INFINITY, f64::min);
        let spread = largest - least;
        whirl += &format!("| {} | {:.2} rad/s | {spread:.2} rad/s |\n", run.name, mean(&run.figures).0);
    }
    println!("{table}\n{whirl}");
    if std::env::var_os("CAGEDYN_BLESS").is_some() {
        for (marker, text) in [("<!-- errors -->", table), ("<!-- whirl -->", whirl)] {
            replace_between(&repository("docs/results/verification.md"), marker, &text);
        }
    }
}
