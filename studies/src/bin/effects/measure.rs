//! Cost of force evaluations: instructions, and time relative to the unchanged scene.

use crate::study::Outcome;
use cagedyn::{Error, Model, Result, Scene, Sim, Status};
use cagedyn_studies::effects::count::{States, evaluate_states, instructions};
use cagedyn_studies::effects::rows::Row;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// Pairs of batches that a ratio of times is the median of, and least time of a batch, s.
const PAIRS: usize = 300;
const BATCH: f64 = 2e-4;
/// Passes over the states for a count of instructions.
const PASSES: u32 = 2;

/// Cost of one force evaluation.
#[derive(Clone, Copy, Default)]
pub struct Cost {
    /// Instructions at the states of the row's own run.
    pub instructions: Option<f64>,
    /// Instructions at the states of the unchanged scene.
    pub same_states: Option<f64>,
    /// Time at the states of the row's own run, relative to the unchanged scene.
    pub time: Option<f64>,
}

/// Evaluates the forces of a scene file with changes at saved states: the work that callgrind counts.
///
/// # Errors
/// Those of scene, file and evaluation.
pub fn evaluate(scene: &Path, changes: &[(&str, &str)], states: &Path, passes: u32) -> Result<()> {
    let text = std::fs::read_to_string(scene)
        .map_err(|e| Error::new(Status::File, format!("{}: {e}", scene.display())))?;
    let model = Model::new(Scene::from_json_with(&text, changes.iter().copied())?)?;
    let mut sim = Sim::new(Arc::new(model))?;
    let length = sim.state().len();
    let states = States::load(states, length)?;
    evaluate_states(&mut sim, &states, passes, &mut vec![0.0; length])
}

/// Cost of the unchanged scene and of every row; the outcomes begin with the unchanged scene.
///
/// # Errors
/// [`Status::File`] when callgrind does not run.
pub fn costs(scene: &Path, rows: &[Row], outcomes: &[Outcome], folder: &Path) -> Result<Vec<Cost>> {
    let mut costs = vec![Cost::default(); outcomes.len()];
    let Some((full, _)) = outcomes.split_first() else { return Ok(costs) };
    for (i, (cost, outcome)) in costs.iter_mut().zip(outcomes).enumerate() {
        let set = i.checked_sub(1).map_or(&[][..], |row| rows[row].set);
        let count = |states: &States| count(scene, set, states, folder);
        if !outcome.states.0.is_empty() {
            cost.instructions = Some(count(&outcome.states)?);
        }
        if let (Some(from), Some(to)) = (&full.model, &outcome.model)
            && let Some(states) = full.states.project(from, to)
        {
            cost.same_states = Some(count(&states)?);
        }
    }
    let Some(mut base) = Timed::new(full) else { return Ok(costs) };
    for (cost, outcome) in costs.iter_mut().zip(outcomes) {
        cost.time = Timed::new(outcome).and_then(|mut row| ratio(&mut base, &mut row));
    }
    Ok(costs)
}

/// Instructions per evaluation.
fn count(scene: &Path, set: &[(&str, &str)], states: &States, folder: &Path) -> Result<f64> {
    let program = std::env::current_exe().map_err(|e| Error::new(Status::File, e.to_string()))?;
    let saved: PathBuf = folder.join("states.bin");
    states.save(&saved)?;
    let passes = PASSES.to_string();
    let (scene, saved) = (scene.display().to_string(), saved.display().to_string());
    let changes: Vec<String> = set.iter().map(|(path, value)| format!("--set={path}={value}")).collect();
    let mut arguments = vec!["--evaluate", &scene, "--states", &saved, "--passes", &passes];
    arguments.extend(changes.iter().map(String::as_str));
    let evaluations = f64::from(PASSES) * states.0.len() as f64;
    Ok(instructions(&program, &arguments, &[])? as f64 / evaluations)
}

/// A simulation to be timed at states of its run.
struct Timed<'a> {
    sim: Sim,
    states: &'a States,
    rate: Vec<f64>,
    passes: u32,
}

impl<'a> Timed<'a> {
    fn new(outcome: &'a Outcome) -> Option<Self> {
        let sim = Sim::new(outcome.model.clone()?).ok()?;
        let rate = vec![0.0; sim.state().len()];
        let mut timed = Self { sim, states: &outcome.states, rate, passes: 1 };
        while timed.batch()? * timed.evaluations() < BATCH {
            timed.passes *= 2;
        }
        Some(timed)
    }

    fn evaluations(&self) -> f64 {
        f64::from(self.passes) * self.states.0.len() as f64
    }

    /// Time per evaluation of one batch, s.
    fn batch(&mut self) -> Option<f64> {
        let start = Instant::now();
        evaluate_states(&mut self.sim, self.states, self.passes, &mut self.rate).ok()?;
        Some(start.elapsed().as_secs_f64() / self.evaluations())
    }
}

/// Median ratio of the times of `row` and `base`, batch by batch in turn.
fn ratio(base: &mut Timed<'_>, row: &mut Timed<'_>) -> Option<f64> {
    let pair = |_| Some(row.batch()? / base.batch()?);
    let mut ratios = (0..PAIRS).map(pair).collect::<Option<Vec<f64>>>()?;
    ratios.sort_by(f64::total_cmp);
    ratios.get(PAIRS / 2).copied()
}
