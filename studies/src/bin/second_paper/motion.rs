//! Numbers of runs: whirl of the cage, means of a roller bearing.

use cagedyn::{Model, Result, Scene, Sim};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Length of a run among prescribed elements, s, part of it after which it counts, and time between looks, s.
const RUN: f64 = 0.1;
const COUNTED_FROM: f64 = 0.05;
const LOOK: f64 = 50e-6;
/// The same among rollers.
const RUN_OF_ROLLERS: f64 = 0.3;
const COUNTED_FROM_OF_ROLLERS: f64 = 0.1;
const LOOK_AT_ROLLERS: f64 = 0.25e-3;

/// How a cage goes round under gravity.
pub struct Whirl {
    /// Mean speed, rad/s.
    pub speed: f64,
    /// Standard deviation of the speed over thirty looks each, rad/s.
    pub scatter: f64,
    /// Mean distance from the centre over the clearance.
    pub eccentricity: f64,
    /// Turns that were counted.
    pub turns: f64,
}

fn channel(sim: &Sim, name: &str) -> usize {
    sim.channels().iter().position(|channel| channel.name == name).unwrap_or(usize::MAX)
}

/// The whirl that a scene comes to from its start.
pub fn whirl_of(scene: &Scene) -> Result<Whirl> {
    let mut sim = Sim::new(Arc::new(Model::new(scene.clone())?))?;
    let [y, z] = ["cage.y_ratio", "cage.z_ratio"].map(|name| channel(&sim, name));
    sim.advance_to(COUNTED_FROM)?;
    let looks = ((RUN - COUNTED_FROM) / LOOK).round() as u32;
    let place = |sim: &mut Sim| Ok::<_, cagedyn::Error>([sim.output(y)?, sim.output(z)?]);
    let mut before = place(&mut sim)?;
    let (mut turned, mut distance, mut stretch, mut speeds) = (0.0, 0.0, 0.0, Vec::new());
    for i in 1..=looks {
        sim.advance_to(COUNTED_FROM + LOOK * f64::from(i))?;
        let now = place(&mut sim)?;
        let by = now[1].atan2(now[0]) - before[1].atan2(before[0]);
        let by = (by + PI).rem_euclid(TAU) - PI;
        turned += by;
        stretch += by;
        distance += now[0].hypot(now[1]);
        before = now;
        if i % 30 == 0 {
            speeds.push(stretch / (30.0 * LOOK));
            stretch = 0.0;
        }
    }
    let mean = turned / (RUN - COUNTED_FROM);
    let squares: f64 = speeds.iter().map(|speed| (speed - mean) * (speed - mean)).sum();
    Ok(Whirl {
        speed: mean,
        scatter: (squares / speeds.len() as f64).sqrt(),
        eccentricity: distance / f64::from(looks),
        turns: turned.abs() / TAU,
    })
}

/// Means of a roller bearing: cage place over the clearance, force of a touching pocket in N, slip of the rollers that carry load.
pub fn rollers(scene: &Scene) -> Result<[f64; 4]> {
    let mut sim = Sim::new(Arc::new(Model::new(scene.clone())?))?;
    let [y, z] = ["cage.y_ratio", "cage.z_ratio"].map(|name| channel(&sim, name));
    let count = sim.model().element_count();
    let of =
        |what: &str| (0..count).map(|j| channel(&sim, &format!("roller[{j}].{what}"))).collect::<Vec<_>>();
    let [slips, pockets, loads] = ["slip", "pocket_force", "inner_force"].map(of);
    let mut outputs = vec![0.0; sim.channels().len()];
    let (mut place, mut force, mut slip) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    let looks = ((RUN_OF_ROLLERS - COUNTED_FROM_OF_ROLLERS) / LOOK_AT_ROLLERS).round() as u32;
    for i in 0..=looks {
        sim.advance_to(COUNTED_FROM_OF_ROLLERS + LOOK_AT_ROLLERS * f64::from(i))?;
        sim.outputs(&mut outputs)?;
        place = [place[0] + outputs[y], place[1] + outputs[z]];
        for j in 0..count {
            let pocket = outputs[pockets[j]];
            if pocket != 0.0 {
                force = [force[0] + pocket.abs(), force[1] + 1.0];
            }
            if outputs[loads[j]] > 0.0 {
                slip = [slip[0] + outputs[slips[j]], slip[1] + 1.0];
            }
        }
    }
    let n = f64::from(looks + 1);
    Ok([place[0] / n, place[1] / n, force[0] / force[1], slip[0] / slip[1]])
}
