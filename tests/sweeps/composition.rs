//! Every kind of rolling element with every guide, every pocket and every cage effect: runs, obeys action and
//! reaction, and friction and films never create energy.

use crate::common::parts::{Parts, all, scene};
use crate::common::reports::{
    CAGE, FRICTION, GUIDE, INNER_RING, NEIGHBOUR, ROLLING, ROLLING_SPEED, SLIP_SPEED,
};
use cagedyn::model::{Forces, LAWS};
use cagedyn::{Model, Sim};
use std::sync::Arc;

const DURATION: f64 = 5e-3;
const CHECKS: u32 = 20;

/// Positions (m), velocities (m/s) and rotation speeds (rad/s) of the bodies, in the order of force reports. Those of
/// elements are their positions only.
struct Bodies {
    positions: Vec<[f64; 2]>,
    velocities: Vec<[f64; 2]>,
    speeds: Vec<f64>,
}

fn bodies(sim: &mut Sim) -> Bodies {
    let names: Vec<String> = sim.model().state_infos().into_iter().map(|info| info.name).collect();
    let state = sim.state().to_vec();
    let of = |name: &str| names.iter().position(|n| n == name).map_or(0.0, |i| state[i]);
    let pair = |body: &str, a: &str, b: &str| [of(&format!("{body}.{a}")), of(&format!("{body}.{b}"))];
    let mut positions = vec![[0.0; 2], pair("inner_ring", "y", "z")];
    if names.iter().any(|name| name == "cage.y") {
        positions.push(pair("cage", "y", "z"));
    }
    let channels: Vec<String> = sim.channels().iter().map(|c| c.name.clone()).collect();
    for j in 0..sim.model().element_count() {
        let kind = sim.model().element_kind();
        let angle = channels.iter().position(|c| *c == format!("{kind}[{j}].orbit_angle")).unwrap();
        let angle = sim.output(angle).unwrap();
        let radius = sim.model().pitch_radius() + of(&format!("roller[{j}].radial_offset"));
        positions.push([radius * angle.cos(), radius * angle.sin()]);
    }
    let velocities = vec![[0.0; 2], pair("inner_ring", "vy", "vz"), pair("cage", "vy", "vz")];
    Bodies { positions, velocities, speeds: vec![0.0, sim.input(0).unwrap(), of("cage.speed")] }
}

/// Largest size of the sum of one source's forces and moments about the origin over all bodies, relative to the largest
/// of them.
fn imbalance(forces: &Forces, source: usize, positions: &[[f64; 2]]) -> f64 {
    let (mut sum, mut size) = ([0.0; 3], [0.0f64; 3]);
    for (body, [y, z]) in forces.bodies.iter().zip(positions) {
        let [fy, fz, moment] = body[source];
        for (k, (x, part)) in [(fy, fy), (fz, fz), (moment + y * fz - z * fy, moment)].into_iter().enumerate()
        {
            sum[k] += x;
            size[k] = size[k].max(part.abs());
        }
    }
    let force = size[0].max(size[1]);
    let lever = 50e-3;
    let moment = size[2].max(lever * force);
    if force == 0.0 { 0.0 } else { (sum[0].hypot(sum[1]) / force).max(sum[2].abs() / moment.max(1e-300)) }
}

/// Power of the guide on all bodies in W, less that of the spring of its solid contact, and the size of its parts.
fn guide_power(parts: Parts, forces: &Forces, b: &Bodies) -> (f64, f64) {
    let (mut power, mut size) = (0.0, 0.0);
    for body in [0, INNER_RING, CAGE] {
        let [fy, fz, moment] = forces.bodies[body][GUIDE];
        let [vy, vz] = b.velocities[body];
        for part in [fy * vy, fz * vz, moment * b.speeds[body]] {
            power += part;
            size += part.abs();
        }
    }
    if parts.guide.contains("mixed") || parts.guide == "solid" {
        let roughness = if parts.guide == "solid" { 0.0 } else { 3e-6 };
        let roundness = if parts.roundness { 10e-6 } else { 0.0 };
        let [y, z] = forces.guide.offset;
        let e = y.hypot(z);
        let depth = e - (0.2225e-3 - roundness - roughness);
        let [vy, vz] = forces.guide.velocity;
        let rate = (y * vy + z * vz) / e;
        power -= -(1.0 - forces.guide.film_share) * 1e7 * depth.max(0.0) * rate;
    }
    (power, size)
}

#[test]
fn every_combination_runs_balances_and_dissipates() {
    let list = all();
    let mut touched = std::collections::BTreeSet::new();
    for &parts in &list {
        let text = scene(parts).to_string();
        let model = Model::from_json(&text).unwrap_or_else(|e| panic!("{parts:?}: {e}"));
        let mut sim = Sim::new(Arc::new(model)).unwrap_or_else(|e| panic!("{parts:?}: {e}"));
        for i in 1..=CHECKS {
            let t = DURATION * f64::from(i) / f64::from(CHECKS);
            sim.advance_to(t).unwrap_or_else(|e| panic!("{parts:?}: {e}"));
            let b = bodies(&mut sim);
            let forces = sim.forces().unwrap().clone();
            for source in (0..=GUIDE).chain([NEIGHBOUR]) {
                let error = imbalance(&forces, source, &b.positions);
                // Rollers touch by small differences of the distances of their centres.
                let allowed = if source == NEIGHBOUR { 1e-9 } else { 1e-11 };
                assert!(error < allowed, "{parts:?} at {t}: source {source}: {error:e}");
            }
            for contact in &forces.contacts {
                let friction = contact[FRICTION] * contact[SLIP_SPEED];
                let rolling = contact[ROLLING] * contact[ROLLING_SPEED];
                assert!(friction <= 0.0 && rolling <= 0.0, "{parts:?} at {t}: {contact:?}");
            }
            let (power, size) = guide_power(parts, &forces, &b);
            assert!(power <= 1e-9 * size, "{parts:?} at {t}: the guide gives {power:e} W of {size:e} W");
        }
        let laws = sim.statistics().laws;
        touched.extend(LAWS.iter().zip(laws).filter(|(_, n)| *n > 0).map(|(name, _)| *name));
    }
    println!("{} combinations", list.len());
    let missed: Vec<_> = LAWS.iter().filter(|law| !touched.contains(*law)).collect();
    assert_eq!(missed, [&"viscosity_temperature", &"rib"], "laws that no combination met");
}
