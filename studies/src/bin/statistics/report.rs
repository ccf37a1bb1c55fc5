//! Tables of the study, and their place in the documentation.

use cagedyn::Result;
use cagedyn::sim::Verdict;
use cagedyn_studies::statistics::readings::QUANTITIES;
use cagedyn_studies::statistics::study::{Outcome, Outcomes};
use cagedyn_studies::table::Table;
use std::path::Path;

/// Significant digits of values.
const DIGITS: i32 = 4;

/// Tables of all cases together: counts, steps of the leapfrog, and what is outside of its band.
pub fn overview(all: &[Outcomes]) -> [Table; 3] {
    [summary(all), steps(all), outside(all)]
}

/// Tables of one case: its reference, and all methods against it.
pub fn of_case(case: &Outcomes) -> [Table; 2] {
    [reference(case), ratios(case)]
}

/// What is shown for one method of one case.
fn verdicts(case: &Outcomes, m: usize) -> Vec<(usize, Verdict)> {
    (0..QUANTITIES.len()).filter_map(|i| Some((i, case.verdict(m, i)?))).collect()
}

/// The quantity that is farthest from the reference in units of its band.
fn worst(verdicts: &[(usize, Verdict)]) -> Option<&(usize, Verdict)> {
    verdicts.iter().max_by(|a, b| a.1.ratio().abs().total_cmp(&b.1.ratio().abs()))
}

/// Name of a method; the leapfrog's own step is marked.
fn label(outcome: &Outcome) -> String {
    let own = outcome.own_steps.is_some_and(|steps| (steps - 1.0).abs() < 1e-9);
    format!("{}{}", outcome.method.name, if own { " (own step)" } else { "" })
}

/// Methods over cases: how many quantities are outside.
fn summary(all: &[Outcomes]) -> Table {
    let head = std::iter::once("method").chain(all.iter().map(|case| case.name)).map(str::to_owned).collect();
    let mut names: Vec<&str> = Vec::new();
    for outcome in all.iter().flat_map(|case| &case.of) {
        if !names.contains(&outcome.method.name) {
            names.push(outcome.method.name);
        }
    }
    let cell = |case: &Outcomes, name: &str| {
        let Some(m) = case.of.iter().position(|outcome| outcome.method.name == name) else {
            return "-".to_owned();
        };
        if case.of[m].runs.is_err() {
            return "**fails**".to_owned();
        }
        let verdicts = verdicts(case, m);
        let outside = verdicts.iter().filter(|(_, v)| !v.inside()).count();
        if outside == 0 { "all inside".to_owned() } else { format!("**{outside} of {}**", verdicts.len()) }
    };
    let line = |name: &&str| {
        std::iter::once((*name).to_owned()).chain(all.iter().map(|case| cell(case, name))).collect()
    };
    Table { name: "summary".to_owned(), head, lines: names.iter().map(line).collect() }
}

/// The largest step of the leapfrog at which this and all shorter ones are inside, and what fails at the next.
fn steps(all: &[Outcomes]) -> Table {
    let head =
        ["case", "own step", "largest step inside", "beyond it fails", "difference / band", "difference, %"];
    let line = |case: &Outcomes| {
        let mut steps: Vec<usize> = (0..case.of.len()).filter(|&m| case.of[m].own_steps.is_some()).collect();
        let own = |m: usize| case.of[m].own_steps.unwrap_or_default();
        steps.sort_by(|a, b| own(*a).total_cmp(&own(*b)));
        let inside =
            |&m: &usize| case.of[m].runs.is_ok() && verdicts(case, m).iter().all(|(_, v)| v.inside());
        let first = steps.iter().position(|m| !inside(m)).unwrap_or(steps.len());
        let name = |m: Option<&usize>| m.map_or("none", |&m| case.of[m].method.name).to_owned();
        let own_step = steps.iter().find(|m| (own(**m) - 1.0).abs() < 1e-9);
        let mut line = vec![case.name.to_owned(), name(own_step)];
        line.push(name(first.checked_sub(1).and_then(|i| steps.get(i))));
        let failed = steps.get(first).map(|&m| (case.of[m].runs.is_ok(), verdicts(case, m)));
        line.extend(match failed {
            None => ["-"; 3].map(str::to_owned),
            Some((false, _)) => ["the run", "-", "-"].map(str::to_owned),
            Some((true, verdicts)) => match worst(&verdicts) {
                None => ["-"; 3].map(str::to_owned),
                Some((i, v)) => [
                    QUANTITIES[*i].name.to_owned(),
                    format!("{:.1}", v.ratio()),
                    percent(case, *i, v.difference),
                ],
            },
        });
        line
    };
    let head = head.map(str::to_owned).to_vec();
    Table { name: "leapfrog steps".to_owned(), head, lines: all.iter().map(line).collect() }
}

/// Everything that is outside of its band.
fn outside(all: &[Outcomes]) -> Table {
    let head = ["case", "method", "quantity", "reference", "difference", "band", "difference, %"];
    let mut lines = Vec::new();
    for case in all {
        for (m, outcome) in case.of.iter().enumerate() {
            if let Err(e) = &outcome.runs {
                let mut line = vec![case.name.to_owned(), label(outcome), e.message.clone()];
                line.resize(head.len(), "-".to_owned());
                lines.push(line);
            }
            for (i, v) in verdicts(case, m).into_iter().filter(|(_, v)| !v.inside()) {
                let reference = case.reference(i, None).map_or(f64::NAN, |r| r.mean);
                lines.push(vec![
                    case.name.to_owned(),
                    label(outcome),
                    QUANTITIES[i].name.to_owned(),
                    number(reference),
                    number(v.difference),
                    number(v.band),
                    percent(case, i, v.difference),
                ]);
            }
        }
    }
    Table { name: "outside".to_owned(), head: head.map(str::to_owned).to_vec(), lines }
}

/// Means and scatter of the reference of a case.
fn reference(case: &Outcomes) -> Table {
    let methods: Vec<usize> = (0..case.of.len()).filter(|&m| case.of[m].method.reference).collect();
    let own = (0..case.of.len()).find(|&m| case.of[m].own_steps.is_some_and(|s| (s - 1.0).abs() < 1e-9));
    let head = ["quantity", "reference", "scatter of a run", "band of the own step", "the same, %"];
    let names = methods.iter().map(|&m| case.of[m].method.name);
    let head = head.into_iter().chain(names).map(str::to_owned).collect();
    let line = |i: usize| {
        let reference = case.reference(i, None)?;
        let band = own.and_then(|m| case.verdict(m, i)).map(|v| v.band);
        let mut line =
            vec![QUANTITIES[i].name.to_owned(), number(reference.mean), number(reference.deviation())];
        line.extend([optional(band.map(number)), optional(band.map(|band| percent(case, i, band)))]);
        let ratio = |&m: &usize| optional(case.verdict(m, i).map(ratio));
        line.extend(methods.iter().map(ratio));
        Some(line)
    };
    Table {
        name: format!("{} reference", case.name),
        head,
        lines: (0..QUANTITIES.len()).filter_map(line).collect(),
    }
}

/// Differences from the reference in units of the band, one line per method.
fn ratios(case: &Outcomes) -> Table {
    let shown: Vec<usize> = (0..QUANTITIES.len()).filter(|&i| case.reference(i, None).is_some()).collect();
    let head = ["method", "runs", "evaluations per ms"].into_iter();
    let head = head.chain(shown.iter().map(|&i| QUANTITIES[i].short)).map(str::to_owned).collect();
    let line = |(m, outcome): (usize, &Outcome)| {
        let count = outcome.runs.as_ref().ok().map(|runs| runs.len().to_string());
        let mut line = vec![label(outcome), optional(count)];
        line.push(optional(outcome.evaluations().map(|x| format!("{x:.0}"))));
        line.extend(shown.iter().map(|&i| optional(case.verdict(m, i).map(ratio))));
        line
    };
    Table {
        name: format!("{} methods", case.name),
        head,
        lines: case.of.iter().enumerate().map(line).collect(),
    }
}

/// Difference in units of the band; bold outside of it.
fn ratio(v: Verdict) -> String {
    if v.inside() { format!("{:.2}", v.ratio()) } else { format!("**{:.1}**", v.ratio()) }
}

/// A figure in % of the reference of quantity `i`.
fn percent(case: &Outcomes, i: usize, figure: f64) -> String {
    optional(case.reference(i, None).map(|r| format!("{:.2}", 100.0 * figure / r.mean.abs())))
}

fn optional(text: Option<String>) -> String {
    text.unwrap_or_else(|| "-".to_owned())
}

/// A number with [`DIGITS`] significant digits.
fn number(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return format!("{x}");
    }
    let decimals = DIGITS - 1 - x.abs().log10().floor() as i32;
    match usize::try_from(decimals) {
        Ok(decimals) if decimals <= 7 => format!("{x:.decimals$}"),
        Ok(_) => format!("{x:.1e}"),
        Err(_) => format!("{x:.0}"),
    }
}

/// Puts the tables into a page, each between its marker and the end marker.
///
/// # Errors
/// [`cagedyn::Status::File`], also when the page has no place for a table.
pub fn write_page(path: &Path, tables: &[Table]) -> Result<()> {
    cagedyn_studies::write_tables(path, tables.iter().map(|table| (table.name.as_str(), table.text())))
}
