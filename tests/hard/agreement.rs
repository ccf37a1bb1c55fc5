//! `auto` against CVODE: means over the second half of runs that start a little differently.

use crate::motion::{Path, Readings};
use crate::{Case, RECORDS};
use cagedyn::Sim;
use cagedyn::sim::{LEVEL, Sample, Verdict, student};
use cagedyn_studies::cvode::{self, Derivatives, Method, Options};
use serde_json::{Value, json};

/// Runs of each, and by how much their starts differ from one to the next: the angle of the first element in rad, and the
/// place of the cage in clearances.
const RUNS: u32 = 4;
const SHIFT: f64 = 1e-3;
/// Local error of CVODE in units of the state scales; evaluations per simulated s it may take.
const TOLERANCE: f64 = 1e-7;
const EVALUATIONS: f64 = 40e6;
/// Its longest step, s: between raceways, and on a guide. Nothing tells CVODE of films ahead, and a cage that is thrown across
/// its clearance passes one within 10 us.
const LONGEST_STEP: [f64; 2] = [1e-5, 1e-6];

/// Smaller differences of means, in shares of the clearance, rad/s or N m, are no differences.
pub const SAME: f64 = 1e-6;

/// How close the means of `engineering` are where motion is not chaotic: shares of the clearance, and of the speed or torque
/// itself.
const RESOLUTION: f64 = 0.01;

/// Whether these differences from what is right are below that.
pub fn resolved(differences: [f64; 3], right: &Readings) -> bool {
    let scales = [1.0, 1.0, right[2].abs()];
    differences.iter().zip(scales).all(|(x, scale)| x.abs() <= RESOLUTION * scale)
}

/// Means of runs that start a little differently.
fn samples(run: impl Fn(f64) -> Result<Readings, String>) -> Result<[Sample; 3], String> {
    let runs = (0..RUNS).map(|k| run(SHIFT * f64::from(k))).collect::<Result<Vec<Readings>, String>>()?;
    let column = |k: usize| runs.iter().map(|run| run[k]).collect::<Vec<_>>();
    Ok([0, 1, 2].map(|k| Sample::of(&column(k)).expect("several runs")))
}

/// What CVODE finds.
///
/// # Errors
/// Where it gave up.
pub fn reference(case: &Case) -> Result<[Sample; 3], String> {
    samples(|shift| by_cvode(case, shift))
}

/// What `auto` finds less the reference, with the bands that the scatter of both explains.
///
/// # Errors
/// Where it gave up.
pub fn compared(case: &Case, reference: &[Sample; 3]) -> Result<[Verdict; 3], String> {
    let ours = samples(|shift| by_library(case, &json!({}), shift))?;
    Ok([0, 1, 2].map(|k| ours[k].against(&reference[k], LEVEL, 3)))
}

/// Whether the scatter of the reference explains the means of one run.
pub fn within(means: &Readings, reference: &[Sample; 3]) -> bool {
    means.iter().zip(reference).all(|(x, sample)| {
        let n = f64::from(RUNS);
        let band = student(LEVEL / 3.0, n - 1.0) * sample.deviation() * (1.0 + 1.0 / n).sqrt();
        (x - sample.mean).abs() <= band.max(SAME)
    })
}

fn times(case: &Case, start: f64) -> impl Iterator<Item = f64> {
    let interval = case.duration / f64::from(RECORDS);
    (RECORDS / 2 + 1..=RECORDS).map(move |i| start + interval * f64::from(i))
}

fn by_library(case: &Case, solver: &Value, shift: f64) -> Result<Readings, String> {
    let mut sim = case.sim(solver, shift);
    let (mut path, mut out) = (Path::new(&sim), vec![0.0; sim.channels().len()]);
    for t in times(case, sim.time()) {
        sim.advance_to(t).and_then(|()| sim.outputs(&mut out)).map_err(|e| e.message)?;
        path.add(&out);
    }
    Ok(path.means())
}

fn by_cvode(case: &Case, shift: f64) -> Result<Readings, String> {
    let new = || case.sim(&json!({}), shift);
    let (mut forces, mut slopes, mut reader): (Sim, Sim, Sim) = (new(), new(), new());
    let absolute: Vec<f64> = reader.model().state_scales().iter().map(|scale| TOLERANCE * scale).collect();
    let options = Options {
        method: Method::Bdf,
        relative: 0.0,
        absolute: &absolute,
        max_steps: 10_000_000,
        max_step: LONGEST_STEP[usize::from(case.scene["rollers"].is_null())],
    };
    let mut remaining = (EVALUATIONS * case.duration) as u64;
    let mut rates = |t: f64, x: &[f64], rate: &mut [f64]| {
        remaining = remaining.checked_sub(1).ok_or(())?;
        forces.derivative(t, x, rate).map_err(|_| ())
    };
    let (start, state) = (reader.time(), reader.state().to_vec());
    let times: Vec<f64> = times(case, start).collect();
    let solution =
        cvode::solve(&options, start, &state, &times, &mut rates, Derivatives::Newton(&mut slopes))?;
    let (mut path, mut out) = (Path::new(&reader), vec![0.0; reader.channels().len()]);
    for (t, state) in times.iter().zip(&solution.states) {
        reader.set_state(*t, state).and_then(|()| reader.outputs(&mut out)).map_err(|e| e.message)?;
        path.add(&out);
    }
    Ok(path.means())
}
