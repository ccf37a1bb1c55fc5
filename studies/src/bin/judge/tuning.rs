//! What each constant of `auto` does: scenes at `engineering` with half and with twice of it.

use cagedyn::integrate::Tuning;
use cagedyn_studies::judge::run::{Options, Verdict, judge_all};
use std::ops::Range;

/// What many runs came to.
struct Total {
    evaluations: Vec<f64>,
    /// Largest share of missing energy, of those that are trusted.
    missing: f64,
    /// Runs that failed or are not trusted.
    bad: usize,
}

fn total(numbers: Range<u64>, options: &Options, tuning: Tuning) -> Total {
    let options =
        Options { tuning, means: false, presets: vec!["engineering".to_owned()], ..options.clone() };
    let mut outcomes = judge_all(numbers, &options, |_| ());
    outcomes.sort_by_key(|outcome| outcome.number);
    let mut total = Total { evaluations: Vec::new(), missing: 0.0, bad: 0 };
    for outcome in outcomes {
        match outcome.verdict {
            Verdict::Refused(_) => {}
            Verdict::Ran { trusted, residual, .. } => {
                total.evaluations.push(outcome.evaluations as f64);
                total.bad += usize::from(!trusted);
                total.missing = if trusted { total.missing.max(residual.abs()) } else { total.missing };
            }
            Verdict::Failed(_) | Verdict::MadeEnergy(_) => {
                total.evaluations.push(f64::NAN);
                total.bad += 1;
            }
        }
    }
    total
}

/// Evaluations in units of those of `usual`: of all runs together, and of the one that suffers most.
fn cost(of: &Total, usual: &Total) -> [f64; 2] {
    let pairs =
        || of.evaluations.iter().zip(&usual.evaluations).filter(|(a, b)| a.is_finite() && b.is_finite());
    let [all, all_usual] = pairs().fold([0.0; 2], |[a, b], (x, y)| [a + x, b + y]);
    [all / all_usual, pairs().fold(0.0, |most, (x, y)| most.max(x / y))]
}

/// The page: a table with a line per constant.
pub fn page(numbers: Range<u64>, options: &Options) -> String {
    format!(
        "# What the constants of the default method do\n\n\
         `make tuning` prints this page. [model.md](../model/integration.md#auto) has the reason of each constant of `Tuning`. Random \
         scenes\n{} to {} of `make judge` run at `engineering` for {} ms with half and with twice of it. Evaluations are \
         those of all runs\ntogether in units of those with the constants as they are, and of the one run that suffers \
         most. Missing is the largest share of\nenergy that a trusted run misses, of 1e-3 that are promised; bad are runs \
         that failed or are not trusted. Counts are halved\nrounding down.\n\n{}",
        numbers.start,
        numbers.end - 1,
        1e3 * options.duration,
        table(numbers.clone(), options)
    )
}

/// A line per constant.
fn table(numbers: Range<u64>, options: &Options) -> String {
    let usual = total(numbers.clone(), options, Tuning::default());
    let mut text = format!(
        "| constant | value | half: evaluations, most | missing | bad | twice: evaluations, most | missing | bad |\n\
         |---|---:|---:|---:|---:|---:|---:|---:|\n\
         | as they are | | 1 | {:.1e} | {} | 1 | {:.1e} | {} |\n",
        usual.missing, usual.bad, usual.missing, usual.bad
    );
    for constant in Tuning::TABLE {
        let cells = [0.5, 2.0].map(|factor| {
            let mut tuning = Tuning::default();
            tuning.set(constant.name, factor * constant.value);
            let total = total(numbers.clone(), options, tuning);
            let [all, most] = cost(&total, &usual);
            format!("{all:.2}, {most:.1} | {:.1e} | {}", total.missing, total.bad)
        });
        let line = format!("| `{}` | {} | {} | {} |\n", constant.name, constant.value, cells[0], cells[1]);
        eprint!("{line}");
        text += &line;
    }
    text
}
