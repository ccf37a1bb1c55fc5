//! The quick part of what `docs/results/statistics.md` tells: the statistics behind its bands, and one short comparison.

mod common;

use cagedyn::sim::{LEVEL, Sample, Verdict, student};
use cagedyn_studies::cvode;
use cagedyn_studies::statistics::{cases, methods, readings, study};
use cases::{Case, NU2310};
use common::{Random, repository};
use methods::Solver;
use readings::QUANTITIES;
use std::f64::consts::TAU;

#[test]
fn students_quantiles_are_those_of_tables() {
    let known = [
        (0.05, 1.0, 12.706),
        (0.05, 10.0, 2.228),
        (0.01, 5.0, 4.032),
        (0.01, 30.0, 2.750),
        (0.001, 10.0, 4.587),
        (0.001, 1e6, 3.291),
    ];
    for (p, freedoms, expected) in known {
        let found = student(p, freedoms);
        assert!((found / expected - 1.0).abs() < 3e-4, "{p}, {freedoms}: {found}, not {expected}");
    }
}

fn normal(random: &mut Random, count: usize, mean: f64, deviation: f64) -> Sample {
    let mut value = || {
        let radius = (-2.0 * (1.0 - random.unit()).ln()).sqrt();
        mean + deviation * radius * (TAU * random.unit()).cos()
    };
    Sample::of(&(0..count).map(|_| value()).collect::<Vec<f64>>()).expect("two values")
}

#[test]
fn bands_hold_as_often_as_they_say() {
    let mut random = Random::new(7);
    let trials = 20_000;
    // Samples of the sizes of the page, with unlike scatter.
    for (level, deviation) in [(0.05, 1.0), (0.05, 3.0), (0.01, 1.0)] {
        let mut outside = 0;
        for _ in 0..trials {
            let [a, b] = [(5, deviation), (10, 1.0)].map(|(n, s)| normal(&mut random, n, 2.0, s));
            outside += usize::from(!a.against(&b, level, 1).inside());
        }
        let share = outside as f64 / f64::from(trials);
        assert!((0.6..1.3).contains(&(share / level)), "level {level}, deviation {deviation}: {share}");
    }
    let verdict = normal(&mut random, 5, 12.0, 1.0).against(&normal(&mut random, 10, 2.0, 1.0), LEVEL, 14);
    assert!(!verdict.inside(), "ten standard deviations: {verdict:?}");
}

#[test]
fn equal_values_are_inside_and_others_are_not() {
    let [a, b] = [[1.0; 4], [2.0; 4]].map(|values| Sample::of(&values).expect("four values"));
    assert_eq!(a.against(&a, LEVEL, 1), Verdict { difference: 0.0, band: 0.0 });
    assert!(a.against(&a, LEVEL, 1).inside() && !a.against(&b, LEVEL, 1).inside());
    assert_eq!(Sample::of(&[1.0]), None);
}

/// Values of one quantity over runs.
type Columns = Vec<Option<Vec<f64>>>;

fn columns(case: &Case, text: &str, solver: Solver) -> Columns {
    let run = |k| study::run(case, text, solver, k).unwrap_or_else(|e| panic!("{}: {e}", case.name)).values;
    let runs: Vec<Vec<Option<f64>>> = (0..case.runs).map(run).collect();
    (0..QUANTITIES.len()).map(|i| runs.iter().map(|values| values[i]).collect()).collect()
}

/// The quantities that are outside of their bands.
fn outside(found: &Columns, reference: &Columns) -> Vec<(&'static str, Verdict)> {
    let sample = |column: &Option<Vec<f64>>| Sample::of(column.as_ref()?);
    let verdict = |i: usize| {
        let v = sample(&found[i])?.against(&sample(&reference[i])?, LEVEL, QUANTITIES.len());
        (!v.inside()).then_some((QUANTITIES[i].name, v))
    };
    (0..QUANTITIES.len()).filter_map(verdict).collect()
}

#[test]
fn the_leapfrog_has_the_statistics_of_cvode_at_its_own_step_and_not_at_its_limit() {
    let case = Case { settling: 0.02, window: 0.03, runs: 5, ..NU2310 };
    let text = case.text(&repository("scenes")).expect("a scene");
    let reference = columns(&case, &text, Solver::Cvode(cvode::Method::Bdf));
    assert!(reference.iter().all(Option::is_some));
    let own = outside(&columns(&case, &text, Solver::Leapfrog(1.0)), &reference);
    assert!(own.is_empty(), "{own:?}");
    let limit = outside(&columns(&case, &text, Solver::Leapfrog(2.0)), &reference);
    assert!(limit.iter().any(|(name, _)| name.starts_with("approach speed")), "{limit:?}");
}
