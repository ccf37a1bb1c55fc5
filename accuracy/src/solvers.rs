//! The solvers that are compared: methods of the library, and others on the same derivatives.

use crate::peers::{self, Task};
use crate::problem::Problem;
use cagedyn::scene::{Auto, ErrorControl, Leapfrog, Method, Preset};
use cagedyn::{Error, Sim};
use cagedyn_studies::cvode::{self, Derivatives};
use std::time::Instant;

/// Runs are repeated until they have taken this time together, s, or were made this often; the fastest counts.
const REPEAT_TIME: f64 = 0.1;
const MOST_REPEATS: u32 = 5;
/// A peer that wants more evaluations than this per simulated second is given up.
const MOST_EVALUATIONS: f64 = 3e7;

/// How a solver integrates, and what its setting means.
#[derive(Clone, Copy)]
pub enum Way {
    /// The leapfrog; setting: step in units of 1/(highest frequency).
    Leapfrog,
    /// A method of the library with error control; setting: tolerance.
    Controlled(fn(ErrorControl) -> Method),
    /// `auto` at a preset; no setting.
    Preset(Preset),
    /// CVODE; setting: tolerance.
    Cvode(cvode::Method, Matrix),
    /// Another solver; setting: tolerance. Some take the Jacobian.
    Peer(fn(Task<'_, '_, '_>) -> Result<Vec<Vec<f64>>, String>, bool),
}

/// Where CVODE's backward differences get their linear algebra from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Matrix {
    /// Difference quotients and a dense matrix.
    Quotients,
    /// The library's Jacobian in a dense matrix.
    Dense,
    /// The library's structured solver.
    Structured,
}

/// A solver of the comparison.
#[derive(Clone, Copy)]
pub struct Solver {
    /// Name for tables and legends.
    pub name: &'static str,
    /// How it integrates.
    pub way: Way,
}

/// States at the times of a problem, and what they took.
pub struct Solution {
    /// One per time.
    pub states: Vec<Vec<f64>>,
    /// Evaluations of the forces, those of difference quotients included.
    pub evaluations: u64,
    /// Wall time, s.
    pub seconds: f64,
}

/// All solvers, in the order of tables and legends.
pub const SOLVERS: [Solver; 16] = [
    solver("cagedyn, draft", Way::Preset(Preset::Draft)),
    solver("cagedyn, engineering", Way::Preset(Preset::Engineering)),
    solver("cagedyn, reference", Way::Preset(Preset::Reference)),
    solver("cagedyn, leapfrog", Way::Leapfrog),
    solver("cagedyn, Dormand-Prince", Way::Controlled(Method::DormandPrince)),
    solver("cagedyn, Adams", Way::Controlled(Method::Adams)),
    solver("cagedyn, Rosenbrock", Way::Controlled(Method::Rosenbrock)),
    solver("cagedyn, Radau", Way::Controlled(Method::Radau)),
    solver("CVODE BDF, own dense Jacobian", Way::Cvode(cvode::Method::Bdf, Matrix::Quotients)),
    solver("CVODE BDF, our Jacobian dense", Way::Cvode(cvode::Method::Bdf, Matrix::Dense)),
    solver("CVODE BDF, our structured solver", Way::Cvode(cvode::Method::Bdf, Matrix::Structured)),
    solver("CVODE Adams", Way::Cvode(cvode::Method::Adams, Matrix::Quotients)),
    solver("LSODA", Way::Peer(peers::lsoda::solve, false)),
    solver("DOP853", Way::Peer(peers::dop853::solve, false)),
    solver("Radau of ivp, our Jacobian dense", Way::Peer(peers::radau::solve, true)),
    solver("diffsol BDF, our Jacobian dense", Way::Peer(peers::diffsol::solve, true)),
];

const fn solver(name: &'static str, way: Way) -> Solver {
    Solver { name, way }
}

impl Solver {
    /// Whether it is the library's.
    pub fn ours(&self) -> bool {
        matches!(self.way, Way::Leapfrog | Way::Controlled(_) | Way::Preset(_))
    }

    /// Whether it is a native library that has to be fetched first and is not there.
    pub fn missing(&self) -> bool {
        self.name == "LSODA" && !peers::lsoda::there()
    }

    /// Integrates a problem; short runs are repeated for their time.
    ///
    /// # Errors
    /// Why it gave up.
    pub fn run(&self, problem: &Problem, setting: f64) -> Result<Solution, String> {
        let mut best = self.run_once(problem, setting)?;
        let mut total = best.seconds;
        for _ in 1..MOST_REPEATS {
            if total >= REPEAT_TIME {
                break;
            }
            let seconds = self.run_once(problem, setting)?.seconds;
            best.seconds = best.seconds.min(seconds);
            total += seconds;
        }
        Ok(best)
    }

    fn run_once(&self, problem: &Problem, setting: f64) -> Result<Solution, String> {
        let said = |e: Error| e.message;
        match self.way {
            Way::Leapfrog => {
                let step = Some(setting / problem.model().highest_frequency());
                ours(problem, problem.sim(Method::Leapfrog(Leapfrog { step })).map_err(said)?)
            }
            Way::Controlled(method) => {
                let method = method(ErrorControl { tolerance: Some(setting) });
                ours(problem, problem.sim(method).map_err(said)?)
            }
            Way::Preset(preset) => {
                let sim = Sim::with_preset(problem.model().clone(), preset).map_err(said)?;
                ours(problem, problem.started(sim).map_err(said)?)
            }
            Way::Cvode(method, matrix) => by_cvode(problem, setting, method, matrix),
            Way::Peer(solve, exact) => by_peer(problem, setting, solve, exact),
        }
    }
}

fn ours(problem: &Problem, mut sim: Sim) -> Result<Solution, String> {
    let mut states = Vec::with_capacity(problem.times.len());
    let started = Instant::now();
    for t in &problem.times {
        sim.advance_to(*t).map_err(|e| e.message)?;
        states.push(sim.state().to_vec());
    }
    let seconds = started.elapsed().as_secs_f64();
    Ok(Solution { states, evaluations: sim.statistics().evaluations, seconds })
}

/// A simulation that lends its derivatives to another solver.
fn lender(problem: &Problem) -> Result<Sim, String> {
    problem.sim(Method::Auto(Auto::default())).map_err(|e| e.message)
}

fn by_cvode(
    problem: &Problem,
    tolerance: f64,
    method: cvode::Method,
    matrix: Matrix,
) -> Result<Solution, String> {
    let [mut forces, mut slopes] = [lender(problem)?, lender(problem)?];
    let absolute: Vec<f64> = problem.scales.iter().map(|scale| tolerance * scale).collect();
    let options = cvode::Options {
        method,
        relative: 0.0,
        absolute: &absolute,
        max_steps: u32::MAX,
        max_step: problem.max_step,
    };
    let mut remaining = (MOST_EVALUATIONS * problem.end()) as u64;
    let mut rates = |t: f64, x: &[f64], rate: &mut [f64]| {
        remaining = remaining.checked_sub(1).ok_or(())?;
        forces.derivative(t, x, rate).map_err(|_| ())
    };
    let mut jacobian = |t: f64, x: &[f64], out: &mut [f64]| slopes.jacobian(t, x, out).map_err(|_| ());
    let mut newton = lender(problem)?;
    let derivatives = match matrix {
        Matrix::Quotients => Derivatives::Quotients,
        Matrix::Dense => Derivatives::Dense(&mut jacobian),
        Matrix::Structured => Derivatives::Newton(&mut newton),
    };
    let started = Instant::now();
    let solved = cvode::solve(&options, 0.0, &problem.start, &problem.times, &mut rates, derivatives);
    let seconds = started.elapsed().as_secs_f64();
    let solution = solved?;
    Ok(Solution { states: solution.states, evaluations: solution.statistics.evaluations, seconds })
}

/// Solvers with one tolerance for all states get the states in units of their scales.
fn by_peer(
    problem: &Problem,
    tolerance: f64,
    solve: fn(Task<'_, '_, '_>) -> Result<Vec<Vec<f64>>, String>,
    exact: bool,
) -> Result<Solution, String> {
    let [mut forces, mut slopes] = [lender(problem)?, lender(problem)?];
    let scales = &problem.scales;
    let [mut x, mut x_slopes] = [(); 2].map(|()| vec![0.0; scales.len()]);
    let mut evaluations = 0;
    let mut rates = |t: f64, y: &[f64], out: &mut [f64]| {
        evaluations += 1;
        unscale(scales, y, &mut x);
        forces.derivative(t, &x, out).map_err(|_| ())?;
        out.iter_mut().zip(scales).for_each(|(rate, scale)| *rate /= scale);
        Ok(())
    };
    let mut jacobian = |t: f64, y: &[f64], out: &mut [f64]| {
        unscale(scales, y, &mut x_slopes);
        slopes.jacobian(t, &x_slopes, out).map_err(|_| ())?;
        for (column, unit) in out.chunks_exact_mut(scales.len()).zip(scales) {
            column.iter_mut().zip(scales).for_each(|(slope, scale)| *slope *= unit / scale);
        }
        Ok(())
    };
    let state: Vec<f64> = problem.start.iter().zip(scales).map(|(x, scale)| x / scale).collect();
    let task = Task {
        tolerance,
        max_step: problem.max_step,
        start: 0.0,
        state: &state,
        times: &problem.times,
        max_evaluations: (MOST_EVALUATIONS * problem.end()) as u64,
        rates: &mut rates,
        jacobian: if exact { Some(&mut jacobian) } else { None },
    };
    let started = Instant::now();
    let solved = solve(task);
    let seconds = started.elapsed().as_secs_f64();
    let mut states = solved?;
    for state in &mut states {
        state.iter_mut().zip(scales).for_each(|(x, scale)| *x *= scale);
    }
    Ok(Solution { states, evaluations, seconds })
}

fn unscale(scales: &[f64], y: &[f64], x: &mut [f64]) {
    for ((x, y), scale) in x.iter_mut().zip(y).zip(scales) {
        *x = y * scale;
    }
}
