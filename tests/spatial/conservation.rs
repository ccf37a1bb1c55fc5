//! What no motion may change, and the balance of forces and powers at any state.

use crate::{ANGULAR, everything, free_ring, model, states};
use cagedyn::Sim;
use serde_json::json;

/// Forces and moments of both rings and all balls on each other cancel.
#[test]
fn forces_and_moments_cancel() {
    let model = everything();
    let mut sim = Sim::new(model.clone()).unwrap();
    for state in states(&sim, 20, 1.0, 7) {
        let forces = sim.forces_at(0.0, &state).unwrap().space.clone();
        let names = model.state_infos();
        let at = |name: &str| state[names.iter().position(|info| info.name == name).unwrap()];
        let mut sum = [0.0; 6];
        let mut size: f64 = 0.0;
        for (body, name) in forces.bodies.iter().zip(model.body_names()) {
            let centre = match name.as_str() {
                "outer_ring" => [0.0; 3],
                "inner_ring" => ["x", "y", "z"].map(|c| at(&format!("inner_ring.{c}"))),
                ball => {
                    let j: f64 = ball[5..ball.len() - 1].parse().unwrap();
                    let psi = j * std::f64::consts::TAU / 16.0 + at(&format!("{ball}.orbit_travel"));
                    let r = model.pitch_radius() + at(&format!("{ball}.radial_offset"));
                    [at(&format!("{ball}.axial_offset")), r * psi.cos(), r * psi.sin()]
                }
            };
            for [fx, fy, fz, mx, my, mz] in &body[..2] {
                let [x, y, z] = centre;
                let about = [mx + y * fz - z * fy, my + z * fx - x * fz, mz + x * fy - y * fx];
                for (sum, part) in sum.iter_mut().zip([*fx, *fy, *fz].into_iter().chain(about)) {
                    *sum += part;
                }
                size = size.max(fx.abs()).max(fy.abs()).max(fz.abs());
            }
        }
        assert!(size > 1e3);
        for part in sum {
            assert!(part.abs() < 1e-11 * size, "{sum:?} of {size}");
        }
    }
}

/// The powers are the rate of the energy.
#[test]
fn powers_are_the_rate_of_the_energy() {
    let model = everything();
    let mut sim = Sim::new(model.clone()).unwrap();
    for state in states(&sim, 5, 0.5, 9) {
        let n = state.len();
        let mut rate = vec![0.0; n];
        sim.derivative(0.0, &state, &mut rate).unwrap();
        let mut energy = |s: f64| {
            let moved: Vec<f64> = state.iter().zip(&rate).map(|(x, rate)| x + s * rate).collect();
            let e = sim.energy_at(0.0, &moved).unwrap();
            e.total()
        };
        let h = 2e-8;
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|s| energy(s * h));
        let difference = (a - d + 8.0 * (c - b)) / (12.0 * h);
        let powers = sim.powers_at(0.0, &state).unwrap();
        let given: f64 = powers.iter().sum();
        let size: f64 = powers.iter().map(|p| p.abs()).sum();
        assert!((given - difference).abs() < 1e-7 * size, "{given} {difference} {powers:?}");
    }
}

/// Without friction and damping energy and the axial angular momentum stay.
#[test]
fn without_friction_nothing_is_lost() {
    let changes = [
        ("raceways", json!({"contact": {}})),
        ("inner_ring.motion", free_ring([17.8e3, 2e3, -3e3, 40.0, 0.0])),
        ("inner_ring.speed", json!({"constant": 837.0})),
        ("initial", json!({"inner_ring": "equilibrium"})),
        ("solver", json!({"method": {"dormand_prince": {"tolerance": 1e-9}}})),
    ];
    let model = model(ANGULAR, &changes);
    let mut sim = Sim::new(model.clone()).unwrap();
    // A kick.
    let mut state = sim.state().to_vec();
    let nq = model.layout().positions();
    for (k, speed) in [0.02, 0.01, -0.03, 0.2, 0.1].into_iter().enumerate() {
        state[nq + k] += speed;
    }
    sim.set_state(0.0, &state).unwrap();
    let momentum = |sim: &Sim| -> f64 {
        let (q, v) = sim.state().split_at(nq);
        let (mass, radius) = (0.04504, 11.115e-3);
        (0..16)
            .map(|j| {
                let (at, spin) = (model.layout().element(j), model.layout().spin(j));
                let r = model.pitch_radius() + q[at + 1];
                mass * (r * r * v[at + 2] + 0.4 * radius * radius * v[spin])
            })
            .sum()
    };
    let balance = |sim: &mut Sim| sim.power_balance().unwrap();
    let before = momentum(&sim);
    sim.advance_to(10e-3).unwrap();
    let after = momentum(&sim);
    let b = balance(&mut sim);
    println!(
        "{before} {after} {:e} {:e} {:?}",
        (after - before) / before,
        b.residual() / b.energy[0].total(),
        b.work
    );
}
