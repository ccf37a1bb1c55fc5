//! The figures that the library is measured by, in one table.

use crate::curves::Comparison;
use crate::kernel::{self, Costs};
use crate::report::{empty, time};
use crate::scenes;
use cagedyn::Result;
use cagedyn_studies::table::Table;

/// A figure, what is wanted and what was found.
fn line(what: &str, goal: &str, found: String) -> Vec<String> {
    vec![what.to_owned(), goal.to_owned(), found]
}

/// Ratio of a peer's time at an error to that of the library's fastest method.
fn ratio(comparison: &Comparison, peer: &str, target: f64) -> String {
    let ours = comparison.best_of_ours(target).map(|(_, seconds)| seconds);
    match (comparison.curve(peer).and_then(|curve| curve.seconds_at(target)), ours) {
        (Some(theirs), Some(ours)) => format!("{:.1}", theirs / ours),
        (None, Some(_)) => "not reached by it".to_owned(),
        _ => "not reached here".to_owned(),
    }
}

/// The smallest ratio of any peer to the library's best.
fn least_ratio(comparison: &Comparison, target: f64) -> String {
    let Some((_, ours)) = comparison.best_of_ours(target) else { return "not reached here".to_owned() };
    let peers = comparison.curves.iter().filter(|curve| !curve.solver.ours());
    let times = peers.filter_map(|curve| Some((curve.solver.name, curve.seconds_at(target)?)));
    match times.min_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((name, theirs)) => format!("{:.1} ({name})", theirs / ours),
        None => "no peer reaches it".to_owned(),
    }
}

/// Wall time of a preset in a comparison, and its error in units of the noise.
fn preset(comparison: &Comparison, name: &str) -> Option<(f64, f64)> {
    let point = comparison.curve(name)?.points.first()?;
    Some((point.seconds, point.error / comparison.noise))
}

/// The table.
///
/// # Errors
/// Those of the runs that only it needs.
pub fn table(comparisons: &[Comparison], size: Option<(f64, f64)>) -> Result<Table> {
    let mut table = empty("goals", ["what", "wanted", "found"].map(str::to_owned).to_vec());
    let named = |name: &str| comparisons.iter().find(|comparison| comparison.name == name);
    let engineering = |comparison: &Comparison| match preset(comparison, "cagedyn, engineering") {
        Some((seconds, error)) => format!("{}, error {error:.2} of the noise", time(seconds)),
        None => "failed".to_owned(),
    };
    if let Some(nu2310) = named("nu2310-statistics") {
        table.lines.push(line("NU2310, 0.3 s, engineering", "0.10 s, within noise", engineering(nu2310)));
        for (peer, goal) in [
            ("CVODE BDF, own dense Jacobian", "20"),
            ("CVODE BDF, our structured solver", "6"),
            ("LSODA", "40"),
        ] {
            let what = format!("{peer} within the noise: its time over that of the library's fastest method");
            table.lines.push(line(&what, goal, ratio(nu2310, peer, nu2310.noise)));
        }
        if let Some(heavy) = named("heavy-statistics") {
            let times = [nu2310, heavy].map(|c| preset(c, "cagedyn, engineering").map_or(f64::NAN, |p| p.0));
            table.lines.push(line("NU2310 at 40 kN, engineering", "within noise", engineering(heavy)));
            let found = format!("{:.2}", times[1] / times[0]);
            table.lines.push(line("its time over that at 4900 N", "1.0", found));
            table.lines.push(line("the fastest peer's time over ours", "4", least_ratio(heavy, heavy.noise)));
        }
    }
    let (total, longest) = kernel::twelve_cases()?;
    let found = format!("{}, the longest {}", time(total), time(longest));
    table.lines.push(line("twelve cases of 0.3 s together, engineering", "1.2 s", found));
    table.lines.extend(comparisons.iter().map(|comparison| {
        let targets =
            if comparison.targets.is_empty() { &[comparison.noise][..] } else { &comparison.targets };
        let ratios = targets.iter().map(|target| least_ratio(comparison, *target));
        let what = format!(
            "{}: time of the fastest peer over that of the library's fastest method",
            comparison.title
        );
        line(&what, "1.0", ratios.collect::<Vec<_>>().join(", "))
    }));
    if let Some(whirl) = named("grease-whirl") {
        let found = preset(whirl, "cagedyn, engineering").map_or("failed".to_owned(), |(seconds, error)| {
            format!("{}, error {:.2} %", time(seconds), 100.0 * error * whirl.noise)
        });
        table.lines.push(line("greased guide, 0.1 s, engineering", "0.05 s, whirl within 0.5 %", found));
    }
    costs(&mut table, kernel::costs(scenes::nu2310(&[])?)?, kernel::leapfrog_step()?);
    if let Some((exponent, memory)) = size {
        let what = "exponent of time over number of rollers, 12 to 200";
        table.lines.push(line(what, "1.05", format!("{exponent:.2}")));
        table.lines.push(line("memory with 200 rollers", "4 MB", format!("{:.2} MB", memory / 1e6)));
    }
    Ok(table)
}

fn costs(table: &mut Table, costs: Costs, step: f64) {
    let Costs { forces, portable, jacobian, factorize, solve, contacts } = costs;
    let what = format!("evaluation of the forces of NU2310, {contacts:.1} contacts");
    table.lines.push(line(&what, "1.0 us", time(forces)));
    table.lines.push(line("the same without vector instructions", "5 us", time(portable)));
    let found = format!("{:.2} evaluations", step / forces);
    table.lines.push(line("a step of the leapfrog", "1.25 evaluations", found));
    let found = format!("{:.2} evaluations", jacobian / forces);
    table.lines.push(line("forces with exact Jacobian", "2.5 evaluations", found));
    let found = format!("{} and {}", time(factorize), time(solve));
    table.lines.push(line("factorizing and solving a linear system", "1 us together", found));
}
