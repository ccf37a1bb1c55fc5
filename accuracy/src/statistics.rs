//! Errors of the statistics of long runs, in units of their scatter from run to run.

use crate::curves::{Comparison, Curve, settings, tolerances};
use crate::problem::Problem;
use crate::scenes;
use crate::solvers::{Matrix, Solution, Solver, Way};
use cagedyn::scene::{Auto, Method};
use cagedyn::{Error, Result, Scene, Sim, Status};
use cagedyn_studies::cvode;
use cagedyn_studies::statistics::readings::{QUANTITIES, Record};

/// Time between records, s.
const INTERVAL: f64 = 1e-4;
/// Turn of the first element from one start to the next, rad.
const START_TURN: f64 = 1e-3;
/// Runs of every solver at every setting, each from another start, and of each of the two reference methods.
const RUNS: usize = 2;
const REFERENCE_RUNS: usize = 6;
/// Tolerance of the reference methods.
const REFERENCE_TOLERANCE: f64 = 1e-6;
/// Solvers that would take half a minute per run.
const TOO_SLOW: [&str; 1] = ["Radau of ivp, our Jacobian dense"];
/// Share of samples of the reference whose error is below the band.
const LEVEL: f64 = 0.95;
/// Steps of the leapfrog in units of 1/(highest frequency).
const STEPS: [f64; 7] = [1.9, 1.5, 1.0, 0.6, 0.3, 0.15, 0.07];

/// How values of several quantities become one error.
#[derive(Clone, Copy)]
enum Measure {
    /// Root mean square over quantities of differences in units of the scatter of one run.
    Scatter(&'static [&'static str]),
    /// Relative difference of one quantity.
    Relative(&'static str),
}

/// A long run.
struct Case {
    name: &'static str,
    title: &'static str,
    scene: Scene,
    settling: f64,
    end: f64,
    measure: Measure,
    targets: Vec<f64>,
    tolerances: Vec<f64>,
}

/// What is reported of a roller bearing: place of the cage, slip, torque, forces in pockets and raceways.
const REPORTED: &[&str] = &["y", "z", "ecc.", "slip", "roller", "torque", "pocket", "p95", "load"];

/// All comparisons of this kind, by name.
pub const NAMES: [&str; 3] = ["nu2310-statistics", "heavy-statistics", "grease-whirl"];

/// Makes one of them.
///
/// # Errors
/// Those of the scene and of the reference.
pub fn compare(name: &str, solvers: &[Solver]) -> Result<Comparison> {
    let case = case(name)?;
    let problems: Vec<Problem> = (0..REFERENCE_RUNS).map(|k| case.problem(k)).collect::<Result<_>>()?;
    let reference = reference(&case, &problems)?;
    let noise = reference.noise();
    let shown = solvers.iter().filter(|solver| !TOO_SLOW.contains(&solver.name));
    let curves = shown.map(|solver| {
        Curve::trace(*solver, settings(solver, &STEPS, &case.tolerances), |solver, setting| {
            let (mut values, mut seconds, mut evaluations) = (Vec::new(), 0.0, 0);
            for problem in &problems[..RUNS] {
                let solution = solver.run(problem, setting)?;
                values.push(case.values(problem, &solution).map_err(|e| e.message)?);
                seconds += solution.seconds / RUNS as f64;
                evaluations += solution.evaluations / RUNS as u64;
            }
            Ok((reference.error(&values), seconds, evaluations))
        })
    });
    Ok(Comparison {
        name: case.name,
        title: case.title,
        error: match case.measure {
            Measure::Scatter(_) => "error of statistics, standard deviations of one run",
            Measure::Relative(_) => "relative error of the whirl speed",
        },
        reference: format!(
            "{REFERENCE_RUNS} runs each of CVODE BDF and the library's Rosenbrock method at {REFERENCE_TOLERANCE:e}; \
             {:.0} % of samples of {RUNS} of them differ from the rest by less than {noise:.2e}",
            100.0 * LEVEL
        ),
        noise,
        curves: curves.collect(),
        targets: case.targets,
        simulated: case.end,
    })
}

fn case(name: &str) -> Result<Case> {
    let roller = |name, title, scene| Case {
        name,
        title,
        scene,
        settling: 0.1,
        end: 0.3,
        measure: Measure::Scatter(REPORTED),
        targets: Vec::new(),
        tolerances: tolerances(2, 6).into_iter().step_by(2).collect(),
    };
    Ok(match name {
        "nu2310-statistics" => {
            roller("nu2310-statistics", "NU2310, statistics of 0.3 s", scenes::nu2310(&[])?)
        }
        "heavy-statistics" => {
            let scene = scenes::nu2310(&[scenes::HEAVY])?;
            roller("heavy-statistics", "NU2310 at 40 kN, statistics of 0.3 s", scene)
        }
        _ => Case {
            settling: 0.05,
            end: 0.1,
            measure: Measure::Relative("orbit"),
            targets: vec![5e-3],
            tolerances: tolerances(2, 9).into_iter().step_by(2).collect(),
            ..roller("grease-whirl", "Greased guide, mean whirl speed of 0.1 s", scenes::grease_guide()?)
        },
    })
}

impl Case {
    /// The `k`-th start.
    fn problem(&self, k: usize) -> Result<Problem> {
        let mut scene = self.scene.clone();
        scene.initial.first_roller_angle += START_TURN * k as f64;
        Problem::new(scene, self.end, (self.end / INTERVAL).round() as u32)
    }

    /// The quantities of a run.
    fn values(&self, problem: &Problem, solution: &Solution) -> Result<Vec<f64>> {
        let mut sim: Sim = problem.sim(Method::Auto(Auto::default()))?;
        let mut record = Record::default();
        let states = problem.times.iter().zip(&solution.states);
        for (t, state) in states.filter(|(t, _)| **t >= self.settling - 0.5 * INTERVAL) {
            sim.set_state(*t, state)?;
            record.add(&mut sim)?;
        }
        let names = match self.measure {
            Measure::Scatter(names) => names,
            Measure::Relative(name) => &[name],
        };
        let values = record.values(&sim);
        let of = |name: &str| {
            let place = QUANTITIES.iter().position(|quantity| quantity.short == name);
            let value = place.and_then(|i| values.get(i).copied().flatten());
            value.ok_or_else(|| Error::new(Status::UnknownName, format!("the scene has no {name}")))
        };
        names.iter().map(|name| of(name)).collect()
    }
}

/// The runs of the reference.
struct Reference {
    measure: Measure,
    /// Values of each run.
    runs: Vec<Vec<f64>>,
}

fn reference(case: &Case, problems: &[Problem]) -> Result<Reference> {
    let ways = [Way::Cvode(cvode::Method::Bdf, Matrix::Structured), Way::Controlled(Method::Rosenbrock)];
    let mut runs = Vec::new();
    for way in ways {
        let solver = Solver { name: "reference", way };
        for problem in problems {
            let solution = solver.run(problem, REFERENCE_TOLERANCE);
            let solution = solution.map_err(|e| Error::new(Status::StepTooSmall, e))?;
            runs.push(case.values(problem, &solution)?);
        }
    }
    Ok(Reference { measure: case.measure, runs })
}

impl Reference {
    /// Error of the mean of these runs against the mean of all of the reference.
    fn error(&self, values: &[Vec<f64>]) -> f64 {
        error(self.measure, values, &self.runs)
    }

    /// What samples of as many runs as a solver makes differ by from the rest.
    fn noise(&self) -> f64 {
        let mut errors = Vec::new();
        for i in 0..self.runs.len() {
            for k in 0..i {
                let (sample, rest): (Vec<_>, Vec<_>) = (0..self.runs.len()).partition(|n| *n == i || *n == k);
                let [sample, rest] = [sample, rest]
                    .map(|list| list.into_iter().map(|n| self.runs[n].clone()).collect::<Vec<_>>());
                errors.push(error(self.measure, &sample, &rest));
            }
        }
        errors.sort_by(f64::total_cmp);
        let place = (LEVEL * errors.len() as f64) as usize;
        errors.get(place.min(errors.len().saturating_sub(1))).copied().unwrap_or(f64::NAN)
    }
}

fn error(measure: Measure, sample: &[Vec<f64>], reference: &[Vec<f64>]) -> f64 {
    let quantities = sample.first().map_or(0, Vec::len);
    let mut sum = 0.0;
    for i in 0..quantities {
        let mean = |runs: &[Vec<f64>]| runs.iter().map(|run| run[i]).sum::<f64>() / runs.len() as f64;
        let expected = mean(reference);
        let difference = mean(sample) - expected;
        let unit = match measure {
            Measure::Relative(_) => expected,
            Measure::Scatter(_) => {
                let squares = reference.iter().map(|run| (run[i] - expected).powi(2)).sum::<f64>();
                (squares / (reference.len() - 1) as f64).sqrt()
            }
        };
        sum += (difference / unit).powi(2);
    }
    (sum / quantities as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_measured_by_scatter_or_by_size() {
        let reference: Vec<Vec<f64>> = [9.0, 10.0, 11.0].iter().map(|x| vec![*x, 10.0 * x]).collect();
        let sample = vec![vec![12.0, 100.0], vec![14.0, 100.0]];
        let scatter = error(Measure::Scatter(REPORTED), &sample, &reference);
        assert!((scatter - 4.5f64.sqrt()).abs() < 1e-12, "three deviations in one of two quantities");
        let relative = error(Measure::Relative("orbit"), &[vec![12.0]], &[vec![10.0]]);
        assert!((relative - 0.2).abs() < 1e-12);
    }
}
