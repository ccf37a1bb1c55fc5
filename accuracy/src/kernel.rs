//! What an evaluation of the forces costs, with and without derivatives, and a linear system.

use crate::memory;
use crate::problem::Problem;
use crate::report::{empty, time};
use crate::scenes;
use cagedyn::model::PARTS;
use cagedyn::scene::{Auto, Leapfrog, Method};
use cagedyn::{Model, Result, Scene, Sim};
use cagedyn_studies::table::Table;
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

/// States of a run over which costs are averaged, and rounds of which the fastest counts.
const STATES: u32 = 200;
const ROUNDS: u32 = 40;
/// Time before the first of them, s.
const SETTLING: f64 = 0.05;
/// Simulated time of a round of steps, s.
const ROUND: f64 = 1e-3;
/// Step of the linear systems, s.
const GAMMA: f64 = 1e-6;

/// Wall times, s.
#[derive(Clone, Copy, Debug)]
pub struct Costs {
    /// Rates of a state.
    pub forces: f64,
    /// The same without vector instructions.
    pub portable: f64,
    /// Rates and exact Jacobian.
    pub jacobian: f64,
    /// Factors.
    pub factorize: f64,
    /// Solution.
    pub solve: f64,
    /// Mean number of contacts that touch.
    pub contacts: f64,
}

/// Costs in the developed motion of a scene.
///
/// # Errors
/// Those of the scene and of the run.
pub fn costs(scene: Scene) -> Result<Costs> {
    let problem = Problem::new(scene, 10e-3, STATES)?;
    let mut sim = problem.sim(Method::Auto(Auto::default()))?;
    // Elements with prescribed motion are elsewhere at other times, so each state keeps its own.
    let (mut states, mut contacts) = (Vec::new(), 0.0);
    for t in problem.times.iter().map(|t| SETTLING + t) {
        sim.advance_to(t)?;
        contacts +=
            sim.forces()?.contacts.iter().filter(|contact| contact.iter().any(|x| *x != 0.0)).count() as f64;
        states.push((t, sim.state().to_vec()));
    }
    let mut rate = vec![0.0; problem.start.len()];
    let forces = each(&states, &mut sim, |sim, t, x| sim.derivative(t, x, &mut rate))?;
    sim.set_vector_instructions(false);
    let portable = each(&states, &mut sim, |sim, t, x| sim.derivative(t, x, &mut rate))?;
    sim.set_vector_instructions(true);
    let jacobian = each(&states, &mut sim, |sim, t, x| sim.linearize(t, x))?;
    let factorize = each(&states, &mut sim, |sim, _, _| sim.factorize(GAMMA))?;
    let mut right = problem.scales.clone();
    let solve = each(&states, &mut sim, |sim, _, _| {
        right.copy_from_slice(&problem.scales);
        sim.solve(black_box(&mut right))
    })?;
    Ok(Costs { forces, portable, jacobian, factorize, solve, contacts: contacts / f64::from(STATES) })
}

/// Seconds per call, the mean over the states in the fastest round.
fn each(
    states: &[(f64, Vec<f64>)],
    sim: &mut Sim,
    mut call: impl FnMut(&mut Sim, f64, &[f64]) -> Result<()>,
) -> Result<f64> {
    let mut best = f64::INFINITY;
    for _ in 0..ROUNDS {
        let started = Instant::now();
        for (t, state) in states {
            call(sim, *t, black_box(state))?;
        }
        best = best.min(started.elapsed().as_secs_f64() / states.len() as f64);
    }
    Ok(best)
}

/// Scenes whose evaluations are looked into.
const SCENES: [(&str, &str); 3] =
    [("NU2310", "nu2310"), ("greased guide", "grease_guide"), ("ball bearing in oil", "ball_short_bearing")];

/// Cost of an evaluation, its derivatives and a linear system, and where the time of the evaluation goes.
///
/// # Errors
/// Those of the scenes and the runs.
pub fn tables() -> Result<[Table; 2]> {
    let head = [
        "scene",
        "states",
        "contacts",
        "forces",
        "without vector instructions",
        "forces and Jacobian",
        "factorize",
        "solve",
        "memory of the model",
        "memory of a simulation",
    ];
    let mut costs_of = empty("costs", head.map(str::to_owned).to_vec());
    let mut head = vec!["scene".to_owned()];
    head.extend(PARTS.iter().map(|part| part.replace('_', " ")));
    let mut parts_of = empty("parts", head);
    for (name, file) in SCENES {
        let start = memory::in_use();
        let model = Arc::new(Model::new(scenes::from_file(file, &[])?)?);
        let compiled = memory::in_use();
        let mut sim = Sim::new(model)?;
        sim.advance_to(1e-4)?;
        let used = [compiled - start, memory::in_use() - compiled];
        let c = costs(scenes::from_file(file, &[])?)?;
        let times = [c.forces, c.portable, c.jacobian, c.factorize, c.solve].map(time);
        let mut line = vec![name.to_owned(), sim.state().len().to_string(), format!("{:.1}", c.contacts)];
        line.extend(times);
        line.extend(used.map(|bytes| format!("{:.0} kB", bytes as f64 / 1e3)));
        costs_of.lines.push(line);
        let mut states = Vec::new();
        for k in 1..=STATES {
            sim.advance_to(0.05 + 1e-4 * f64::from(k))?;
            states.push((sim.time(), sim.state().to_vec()));
        }
        let mut line = vec![name.to_owned()];
        line.extend(sim.time_parts(&states, ROUNDS)?.map(time));
        parts_of.lines.push(line);
    }
    Ok([costs_of, parts_of])
}

/// Wall time of a step of the leapfrog in developed motion, s.
///
/// # Errors
/// Those of the run.
pub fn leapfrog_step() -> Result<f64> {
    let problem = Problem::new(scenes::nu2310(&[])?, 10e-3, STATES)?;
    let mut sim = problem.sim(Method::Leapfrog(Leapfrog::default()))?;
    sim.advance_to(SETTLING)?;
    let mut best = f64::INFINITY;
    for _ in 0..ROUNDS {
        let before = sim.statistics().driver.steps;
        let started = Instant::now();
        sim.advance_to(sim.time() + ROUND)?;
        let seconds = started.elapsed().as_secs_f64();
        best = best.min(seconds / (sim.statistics().driver.steps - before) as f64);
    }
    Ok(best)
}

/// Wall time of the twelve cases of the paper at `engineering`, 0.3 s each, together and longest, s.
///
/// # Errors
/// Those of the case set and the runs.
pub fn twelve_cases() -> Result<(f64, f64)> {
    let (mut total, mut longest) = (0.0, 0.0_f64);
    for scene in scenes::twelve()? {
        let end = scene.record.duration;
        let mut sim = Sim::new(Arc::new(Model::new(scene)?))?;
        let started = Instant::now();
        sim.advance_to(end)?;
        let seconds = started.elapsed().as_secs_f64();
        total += seconds;
        longest = longest.max(seconds);
    }
    Ok((total, longest))
}
