//! What the judged runs amount to.

use super::run::{Apart, CHANNELS, Outcome, OverStarts, PRESETS, Verdict};

/// A run that takes more than so many times the evaluations of the median one is dear.
const DEAR: u64 = 50;

/// Whether more is missing than promised, or what is no number.
fn breaks(residual: f64, promise: f64) -> bool {
    residual.is_nan() || residual.abs() > promise
}

/// A line about a run that is not as it should be.
pub fn line(outcome: &Outcome) -> Option<String> {
    let Outcome { number, preset, promise, evaluations, verdict } = outcome;
    let text = match verdict {
        Verdict::Refused(e) => format!("refused: {e}"),
        Verdict::Failed(e) => format!("failed after {evaluations} evaluations: {e}"),
        Verdict::MadeEnergy(report) => format!("its film made energy: {report}"),
        Verdict::Ran { impossible, trusted, report, .. } if !impossible.is_empty() => {
            let trusted = if *trusted { "trusted" } else { "not trusted" };
            format!("impossible, {trusted}: {}: {report}", impossible.join("; "))
        }
        Verdict::Ran { trusted: false, report, residual, .. } => {
            format!("not trusted, residual {residual:.1e}: {report}")
        }
        Verdict::Ran { residual, report, .. } if breaks(*residual, *promise) => {
            format!("residual {residual:.1e}, {evaluations} evaluations: {report}")
        }
        Verdict::Ran { apart: Some(apart), report, residual, .. } if apart.ratio > 1.0 => {
            let Apart { ratio, channel, in_mean } = *apart;
            let starts = if in_mean { "also" } else { "not" };
            let channel = CHANNELS[channel];
            format!(
                "mean of {channel} {ratio:.1} times too far from reference, {starts} over several starts, residual \
                 {residual:.1e}: {report}"
            )
        }
        _ => return None,
    };
    Some(format!("{number} {preset}: {text}"))
}

/// A table of means over many starts.
pub fn starts(means: &[OverStarts]) -> String {
    let mut text = "| preset | mean of | over all starts | standard error | starts | evaluations per run |\n\
                    |---|---|---:|---:|---:|---:|\n"
        .to_owned();
    for OverStarts { preset, channel, sample, evaluations } in means {
        text.push_str(&format!(
            "| {preset} | `{channel}` | {:.5} | {:.5} | {} | {evaluations:.0} |\n",
            sample.mean,
            sample.variance.sqrt(),
            sample.count
        ));
    }
    text
}

/// How far the means of a trusted run are from the reference.
fn apart(verdict: &Verdict) -> Option<Apart> {
    if let Verdict::Ran { trusted: true, apart, .. } = verdict { *apart } else { None }
}

/// Counts by preset.
pub fn table(outcomes: &[Outcome]) -> String {
    let mut text = format!(
        "\n| preset | scenes | refused | failed | film made energy, and told | impossible | not trusted | trusted, balance broken | trusted, means of one run apart | of eight starts | \
                    largest missing share of the trusted | median evaluations per run | more than {DEAR} times as many | most, of scene |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n"
    );
    for (preset, promise) in PRESETS {
        let list: Vec<&Outcome> = outcomes.iter().filter(|o| o.preset == preset).collect();
        if list.is_empty() {
            continue;
        }
        let count = |f: &dyn Fn(&Verdict) -> bool| list.iter().filter(|o| f(&o.verdict)).count();
        let mut evaluations: Vec<(u64, u64)> = list
            .iter()
            .filter(|o| matches!(o.verdict, Verdict::Ran { .. }))
            .map(|o| (o.evaluations, o.number))
            .collect();
        evaluations.sort_unstable();
        let (median, _) = evaluations.get(evaluations.len() / 2).copied().unwrap_or_default();
        // Also of those that failed or were stopped: they took at least as many.
        let dear = list.iter().filter(|o| o.evaluations > DEAR * median).count();
        let (most, scene) = evaluations.last().copied().unwrap_or_default();
        let largest = list.iter().fold(0.0f64, |most, o| match o.verdict {
            Verdict::Ran { residual, trusted: true, .. } => most.max(residual.abs()),
            _ => most,
        });
        text += &format!(
            "| {preset} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {largest:.1e} | {median} | {dear} | {most}, {scene} |\n",
            list.len(),
            count(&|v| matches!(v, Verdict::Refused(_))),
            count(&|v| matches!(v, Verdict::Failed(_))),
            count(&|v| matches!(v, Verdict::MadeEnergy(_))),
            count(&|v| matches!(v, Verdict::Ran { impossible, .. } if !impossible.is_empty())),
            count(&|v| matches!(v, Verdict::Ran { trusted: false, .. })),
            count(
                &|v| matches!(v, Verdict::Ran { trusted: true, residual, .. } if breaks(*residual, promise))
            ),
            count(&|v| matches!(apart(v), Some(apart) if apart.ratio > 1.0)),
            count(&|v| matches!(apart(v), Some(apart) if apart.in_mean)),
        );
    }
    text
}
