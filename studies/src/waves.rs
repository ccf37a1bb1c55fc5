//! Bearings whose raceways and rollers are not round: runs of a preloaded NU2310, and the lines in them.

use crate::page::{Changes, scene};
use cagedyn::{Model, Result, Sim};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Time between samples, what of a run is left out, and the rest, s.
pub const INTERVAL: f64 = 5e-5;
pub const BEFORE: f64 = 0.03;
/// Amplitude of a wave in these runs, m.
pub const AMPLITUDE: f64 = 1e-6;

/// An NU2310 whose twelve rollers carry alike: preloaded by 10 um, without load and weight, its ring of 3 kg damped.
pub fn preloaded(changes: &Changes) -> Result<Model> {
    let ring = json!({"free": {"mass": 3.0, "support_damping": 2000.0}});
    let mut all: Changes = vec![
        ("inner_ring.radial_clearance", json!(-10e-6)),
        ("inner_ring.motion", ring),
        ("gravity", Value::Null),
    ];
    all.extend(changes.iter().cloned());
    Model::new(scene("nu2310", &all)?)
}

/// Waves of one order on a body.
pub fn waves(body: &str, order: u32) -> Changes {
    let wave = json!([{"order": order, "amplitude": AMPLITUDE, "phase": 0.0}]);
    match body {
        "inner ring" => vec![("inner_ring.waviness", wave)],
        "outer ring" => vec![("outer_ring.waviness", wave)],
        _ => vec![("rollers.waviness", json!([{"rollers": [0], "harmonics": wave}]))],
    }
}

/// What came of a run.
pub struct Run {
    /// Place of the inner ring at every sample, y and z, m.
    pub ring: Vec<[f64; 2]>,
    /// Place of the cage, m.
    pub cage: Vec<[f64; 2]>,
    /// Turns of the inner ring, of the cage, and of a roller in the frame of the cage, 1/s.
    pub turns: [f64; 3],
}

/// Runs a model for `duration` s after [`BEFORE`].
pub fn run(model: Model, duration: f64) -> Result<Run> {
    let model = Arc::new(model);
    let place = |name: &str| model.channels().iter().position(|channel| channel.name == name).expect(name);
    let places = ["inner_ring.y", "inner_ring.z", "cage.y", "cage.z", "cage.speed"].map(place);
    let spin =
        model.state_infos().iter().position(|info| info.name == "roller[1].spin_speed").expect("a roller");
    let (mut sim, mut out) = (Sim::new(model.clone())?, vec![0.0; model.channels().len()]);
    let count = (duration / INTERVAL).round() as usize;
    let mut found = Run { ring: Vec::with_capacity(count), cage: Vec::with_capacity(count), turns: [0.0; 3] };
    sim.advance_to(BEFORE)?;
    for i in 0..count {
        sim.advance_to(BEFORE + INTERVAL * (i + 1) as f64)?;
        sim.outputs(&mut out)?;
        let [y, z, cage_y, cage_z, speed] = places.map(|place| out[place]);
        found.ring.push([y, z]);
        found.cage.push([cage_y, cage_z]);
        found.turns[1] += speed / TAU / count as f64;
        found.turns[2] += (sim.state()[spin] - speed) / TAU / count as f64;
    }
    let speed =
        model.input_infos().iter().position(|info| info.name == "inner_ring.speed").expect("its speed");
    found.turns[0] = sim.input(speed)? / TAU;
    Ok(found)
}

/// Amplitude of the part of a motion that goes round `frequency` times a second, counter-clockwise, in its unit: under a Hann window.
pub fn amplitude(motion: &[[f64; 2]], frequency: f64) -> f64 {
    let n = motion.len() as f64;
    let mean = [0, 1].map(|k| motion.iter().map(|x| x[k]).sum::<f64>() / n);
    let mut sum = [0.0; 2];
    for (i, [y, z]) in motion.iter().enumerate() {
        let window = 1.0 - (TAU * i as f64 / n).cos();
        let (sin, cos) = (-TAU * frequency * INTERVAL * i as f64).sin_cos();
        let [y, z] = [window * (y - mean[0]), window * (z - mean[1])];
        sum = [sum[0] + y * cos - z * sin, sum[1] + y * sin + z * cos];
    }
    sum[0].hypot(sum[1]) / n
}

/// Frequency and amplitude of the highest lines of a motion up to `most` Hz either way round, the highest first, at least four resolutions
/// apart.
pub fn highest(motion: &[[f64; 2]], most: f64, count: usize) -> Vec<[f64; 2]> {
    let line = 1.0 / (motion.len() as f64 * INTERVAL);
    let last = (2.0 * most / line).round() as i32;
    let mut all: Vec<[f64; 2]> = (-last..=last)
        .map(|k| 0.5 * line * f64::from(k))
        .map(|frequency| [frequency, amplitude(motion, frequency)])
        .collect();
    all.sort_by(|a, b| b[1].total_cmp(&a[1]));
    let mut found: Vec<[f64; 2]> = Vec::new();
    for here in all {
        if found.len() < count && found.iter().all(|other| (other[0] - here[0]).abs() > 4.0 * line) {
            found.push(here);
        }
    }
    found
}

/// The lines of the table of textbooks for waves of an order on a body, with these turns of ring, cage and roller and `rollers` rollers, Hz,
/// counter-clockwise; none of an order that does not shake the ring.
pub fn textbook(body: &str, order: u32, [ring, cage, roller]: [f64; 3], rollers: u32) -> Vec<f64> {
    let passing = |speed: f64| match (order % rollers, f64::from(order)) {
        (1, n) => Some((n - 1.0) * speed),
        (rest, n) if rest == rollers - 1 => Some(-(n + 1.0) * speed),
        _ => None,
    };
    match body {
        "inner ring" => passing(ring - cage).map(|line| line + ring).into_iter().collect(),
        "outer ring" => passing(-cage).into_iter().collect(),
        _ if order.is_multiple_of(2) => [1.0, -1.0].map(|way| way * f64::from(order) * roller + cage).into(),
        _ => Vec::new(),
    }
}
