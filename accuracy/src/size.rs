//! How time and memory grow with the number of rollers.

use crate::memory;
use crate::problem::Problem;
use crate::report::empty;
use crate::scenes;
use crate::solvers::Solver;
use cagedyn::scene::Preset;
use cagedyn::{Error, Model, Result, Sim, Status};
use cagedyn_studies::table::Table;
use std::sync::Arc;

/// Numbers of rollers.
pub const COUNTS: [u32; 4] = [12, 50, 100, 200];
/// Simulated time, s, after the settling.
const DURATION: f64 = 2e-3;
const SETTLING: f64 = 5e-3;
/// Setting of methods with error control.
const TOLERANCE: f64 = 1e-5;
/// Solvers that are followed over the number of rollers.
const SHOWN: [&str; 5] = [
    "cagedyn, engineering",
    "cagedyn, Rosenbrock",
    "CVODE BDF, own dense Jacobian",
    "CVODE BDF, our Jacobian dense",
    "CVODE BDF, our structured solver",
];

/// Wall time per simulated time over the number of rollers, its exponent from the fewest to the most, and memory.
///
/// # Errors
/// Those of the scenes; a solver that gives up is an error, too.
pub fn table(solvers: &[Solver]) -> Result<(Table, f64, f64)> {
    let problems: Vec<Problem> = COUNTS
        .iter()
        .map(|count| Problem::new(scenes::rollers(*count)?, DURATION, 20)?.developed(SETTLING))
        .collect::<Result<_>>()?;
    let mut head = vec!["wall time per simulated ms, ms".to_owned()];
    head.extend(COUNTS.iter().map(|count| format!("{count} rollers")));
    head.push("exponent".to_owned());
    let mut table = empty("size", head);
    let mut exponent = f64::NAN;
    for solver in solvers.iter().filter(|solver| SHOWN.contains(&solver.name)) {
        let times: Vec<f64> = problems
            .iter()
            .map(|problem| {
                let solution = solver.run(problem, TOLERANCE);
                let seconds = solution.map_err(|e| Error::new(Status::StepTooSmall, e))?.seconds;
                Ok(seconds / DURATION)
            })
            .collect::<Result<_>>()?;
        let growth = (times[COUNTS.len() - 1] / times[0]).ln()
            / (f64::from(COUNTS[COUNTS.len() - 1]) / f64::from(COUNTS[0])).ln();
        if solver.name == SHOWN[0] {
            exponent = growth;
        }
        let mut line = vec![solver.name.to_owned()];
        line.extend(times.iter().map(|t| format!("{t:.3}")));
        line.push(format!("{growth:.2}"));
        table.lines.push(line);
    }
    let mut line = vec!["memory of model and simulation, kB".to_owned()];
    let mut most = 0.0;
    for count in COUNTS {
        most = memory_of(count)?;
        line.push(format!("{:.0}", most / 1e3));
    }
    line.push(String::new());
    table.lines.push(line);
    Ok((table, exponent, most))
}

/// Bytes of a model and its simulation, after some steps.
fn memory_of(count: u32) -> Result<f64> {
    let scene = scenes::rollers(count)?;
    let before = memory::in_use();
    let mut sim = Sim::with_preset(Arc::new(Model::new(scene)?), Preset::Engineering)?;
    sim.advance_to(1e-5)?;
    let used = memory::in_use().saturating_sub(before);
    drop(sim);
    Ok(used as f64)
}
