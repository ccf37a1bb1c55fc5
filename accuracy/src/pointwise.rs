//! Errors of states against a reference, at many times of a short run.

use crate::curves::{Comparison, Curve, settings, tolerances};
use crate::problem::Problem;
use crate::scenes;
use crate::solvers::{Matrix, SOLVERS, Solver, Way};
use cagedyn::scene::Method;
use cagedyn::{Error, Result, Status};
use cagedyn_studies::cvode;

/// Tolerance of the reference and of the other method that checks it.
const TIGHT: f64 = 1e-12;
/// Steps of the leapfrog in units of 1/(highest frequency).
const STEPS: [f64; 9] = [1.5, 1.0, 0.6, 0.3, 0.15, 0.07, 0.035, 0.017, 0.008];

/// A comparison of states.
struct Case {
    name: &'static str,
    title: &'static str,
    problem: Problem,
    exact: Option<Vec<Vec<f64>>>,
    targets: Vec<f64>,
}

/// All comparisons of this kind, by name.
pub const NAMES: [&str; 5] =
    ["nu2310-start", "nu2310-developed", "heavy-developed", "grease-start", "spring"];

/// Makes one of them.
///
/// # Errors
/// Those of the scene and of the reference.
pub fn compare(name: &str, solvers: &[Solver]) -> Result<Comparison> {
    let case = case(name)?;
    let (reference, doubt, what) = reference(&case)?;
    let problem = &case.problem;
    let curves = solvers.iter().map(|solver| {
        Curve::trace(*solver, settings(solver, &STEPS, &tolerances(2, 9)), |solver, setting| {
            let solution = solver.run(problem, setting)?;
            Ok((problem.distance(&solution.states, &reference), solution.seconds, solution.evaluations))
        })
    });
    Ok(Comparison {
        name: case.name,
        title: case.title,
        error: "error of positions, m",
        reference: format!("{what}; they differ by {doubt:.1e} m"),
        noise: doubt,
        curves: curves.collect(),
        targets: case.targets,
        simulated: problem.end(),
    })
}

fn case(name: &str) -> Result<Case> {
    let targets = vec![1e-6, 1e-7, 1e-8, 1e-9];
    let case = |name, title, problem| Case { name, title, problem, exact: None, targets: targets.clone() };
    Ok(match name {
        "nu2310-start" => {
            case("nu2310-start", "NU2310, the first 3 ms", Problem::new(scenes::nu2310(&[])?, 3e-3, 30)?)
        }
        "nu2310-developed" => {
            let problem = Problem::new(scenes::nu2310(&[])?, 1e-3, 10)?.developed(0.1)?;
            case("nu2310-developed", "NU2310, 1 ms of developed motion", problem)
        }
        "heavy-developed" => {
            let problem = Problem::new(scenes::nu2310(&[scenes::HEAVY])?, 1e-3, 10)?.developed(0.1)?;
            case("heavy-developed", "NU2310 at 40 kN, 1 ms of developed motion", problem)
        }
        "grease-start" => {
            let problem = Problem::new(scenes::grease_guide()?, 20e-3, 200)?;
            let contact = first_contact(&problem)?;
            case(
                "grease-start",
                "Greased guide, until the cage first meets an element",
                problem.until(contact),
            )
        }
        _ => {
            let problem = Problem::new(scenes::spring()?, 20e-3, 40)?;
            let exact = problem.times.iter().map(|t| scenes::spring_motion(&problem.start, *t)).collect();
            let title = "Cage on the spring of its guide, known solution";
            Case { exact: Some(exact), ..case("spring", title, problem) }
        }
    })
}

/// States at the times, how far they can be trusted (m), and what they are.
fn reference(case: &Case) -> Result<(Vec<Vec<f64>>, f64, String)> {
    let said = |e: String| Error::new(Status::StepTooSmall, e);
    if let Some(exact) = &case.exact {
        // Round-off of states that are some tenths of a millimetre, over thousands of steps.
        return Ok((exact.clone(), 1e-15, "closed form".to_owned()));
    }
    let by = |way| Solver { name: "reference", way }.run(&case.problem, TIGHT).map_err(said);
    let theirs = by(Way::Cvode(cvode::Method::Bdf, Matrix::Structured))?;
    let ours = by(Way::Controlled(Method::DormandPrince))?;
    let doubt = case.problem.distance(&theirs.states, &ours.states);
    let what = format!("CVODE BDF at {TIGHT:e}, checked by Dormand-Prince of the library at {TIGHT:e}");
    Ok((theirs.states, doubt, what))
}

/// The last of the times before the cage meets an element.
fn first_contact(problem: &Problem) -> Result<f64> {
    let tight = Method::DormandPrince(cagedyn::scene::ErrorControl { tolerance: Some(1e-9) });
    let mut sim = problem.sim(tight)?;
    let touching = sim.channels().iter().position(|channel| channel.name == "pocket.touching_elements");
    let touching = touching.ok_or_else(|| Error::new(Status::UnknownName, "no pockets".to_owned()))?;
    let mut last = 0.0;
    for t in &problem.times {
        sim.advance_to(*t)?;
        if sim.output(touching)? > 0.0 {
            break;
        }
        last = *t;
    }
    Ok(last)
}

/// All solvers that can be had here.
pub fn available() -> Vec<Solver> {
    SOLVERS.into_iter().filter(|solver| !solver.missing()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All solvers swing as the known solution does, and a tighter setting is a smaller error.
    #[test]
    fn solvers_follow_the_known_solution() {
        let case = case("spring").expect("a scene");
        let exact = case.exact.expect("a known solution");
        for solver in available().into_iter().filter(|solver| !matches!(solver.way, Way::Preset(_))) {
            let settings = if matches!(solver.way, Way::Leapfrog) { [0.3, 0.03] } else { [1e-4, 1e-7] };
            let errors = settings.map(|setting| {
                let solution =
                    solver.run(&case.problem, setting).unwrap_or_else(|e| panic!("{}: {e}", solver.name));
                case.problem.distance(&solution.states, &exact)
            });
            println!("{}: {errors:?}", solver.name);
            // Where the largest step keeps errors down, the tolerance has no say.
            let falls = errors[1] < 0.1 * errors[0] || errors[0] < 1e-9;
            assert!(errors[1] < 1e-7 && falls, "{}: {errors:?}", solver.name);
        }
    }

    #[test]
    fn the_first_contact_ends_the_start_of_the_grease_guide() {
        let case = case("grease-start").expect("a scene");
        let end = case.problem.end();
        assert!(end > 1e-3 && end < 20e-3, "{end}");
    }
}
