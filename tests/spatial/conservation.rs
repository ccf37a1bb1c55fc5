//! What no motion may change, and the balance of forces and powers at any state.

use crate::{ANGULAR, DEEP, cages, driven, everything, free_ring, model, states};
use cagedyn::model::FORCE_SOURCES;
use cagedyn::{Model, Sim};
use serde_json::{Value, json};
use std::sync::Arc;

/// Forces and moments of both rings and all balls on each other cancel.
#[test]
fn forces_and_moments_cancel() {
    cancel(&everything(), 1e3);
    for model in cages() {
        cancel(&model, 10.0);
    }
}

pub(crate) fn cancel(model: &Arc<Model>, largest: f64) {
    let mut sim = Sim::new(model.clone()).unwrap();
    let mut acts = [false; 5];
    for state in states(&sim, 20, 1.0, 7) {
        let forces = sim.forces_at(0.0, &state).unwrap().space.clone();
        let names = model.state_infos();
        // What is held is at zero.
        let at = |name: &str| names.iter().position(|info| info.name == name).map_or(0.0, |k| state[k]);
        let mut sum = [0.0; 6];
        let mut size: f64 = 0.0;
        for (body, name) in forces.bodies.iter().zip(model.body_names()) {
            let centre = match name.as_str() {
                "outer_ring" => [0.0; 3],
                ring @ ("inner_ring" | "cage") => ["x", "y", "z"].map(|c| at(&format!("{ring}.{c}"))),
                ball => {
                    let number = ball.trim_start_matches(char::is_alphabetic);
                    let j: f64 = number[1..number.len() - 1].parse().unwrap();
                    let psi = j * std::f64::consts::TAU / model.element_count() as f64
                        + at(&format!("{ball}.orbit_travel"));
                    let r = model.pitch_radius() + at(&format!("{ball}.radial_offset"));
                    [at(&format!("{ball}.axial_offset")), r * psi.cos(), r * psi.sin()]
                }
            };
            let rib = FORCE_SOURCES.iter().position(|source| *source == "rib").unwrap();
            for (source, [fx, fy, fz, mx, my, mz]) in body[..4].iter().chain([&body[rib]]).enumerate() {
                acts[source] |= *fy != 0.0;
                let [x, y, z] = centre;
                let about = [mx + y * fz - z * fy, my + z * fx - x * fz, mz + x * fy - y * fx];
                for (sum, part) in sum.iter_mut().zip([*fx, *fy, *fz].into_iter().chain(about)) {
                    *sum += part;
                }
                size = size.max(fx.abs()).max(fy.abs()).max(fz.abs());
            }
        }
        assert!(size > largest);
        for part in sum {
            assert!(part.abs() < 1e-11 * size, "{sum:?} of {size}");
        }
    }
    let caged = model.body_names().contains(&"cage".to_owned());
    let ribs = model.contact_names().iter().any(|name| name.contains("_rib_"));
    let cage = model.scene().cage.as_ref();
    let lands = cage.and_then(|cage| cage.space.as_ref()).is_some_and(|space| !space.lands.is_empty());
    let guided = lands || cage.is_some_and(|cage| cage.guide.is_some());
    assert_eq!(acts, [true, true, caged, guided, ribs]);
}

/// The powers are the rate of the energy.
#[test]
fn powers_are_the_rate_of_the_energy() {
    for model in [everything(), driven()].into_iter().chain(cages()) {
        powers(&model, 1e-7);
    }
}

pub(crate) fn powers(model: &Arc<Model>, allowed: f64) {
    let mut sim = Sim::new(model.clone()).unwrap();
    for (k, state) in states(&sim, 5, 0.5, 9).into_iter().enumerate() {
        let (t, n) = (1e-4 + 3e-4 * k as f64, state.len());
        let mut rate = vec![0.0; n];
        sim.derivative(t, &state, &mut rate).unwrap();
        let mut energy = |s: f64| {
            let moved: Vec<f64> = state.iter().zip(&rate).map(|(x, rate)| x + s * rate).collect();
            let e = sim.energy_at(t + s, &moved).unwrap();
            e.total()
        };
        let h = 2e-8;
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|s| energy(s * h));
        let difference = (a - d + 8.0 * (c - b)) / (12.0 * h);
        let powers = sim.powers_at(t, &state).unwrap();
        let given: f64 = powers.iter().sum();
        let size: f64 = powers.iter().map(|p| p.abs()).sum();
        assert!((given - difference).abs() < allowed * size, "{given} {difference} {powers:?}");
    }
}

/// Mass and radius of a ball of the 218, and inertia of the ring of [`free_ring`].
const BALL: (f64, f64) = (0.04504, 11.115e-3);
const RING: [f64; 3] = [2.0, 4e-3, 3e-3];

/// Angular momentum of balls and ring about the axis of the bearing, with the ring turning at `speed`, kg m^2/s. What the ring turns with its
/// tilting is left to its drive.
fn axial_momentum(model: &Model, state: &[f64], speed: f64) -> f64 {
    let (q, v) = state.split_at(model.layout().positions());
    let ((mass, radius), [ring_mass, polar, transverse]) = (BALL, RING);
    let of_balls = (0..16).map(|j| {
        let (at, spin) = (model.layout().element(j), model.layout().spin(j));
        let r = model.pitch_radius() + q[at + 1];
        mass * (r * r * v[at + 2] + 0.4 * radius * radius * v[spin])
    });
    let [[_, y, z, a, b], [_, vy, vz, da, db]] = [q, v].map(|x| std::array::from_fn::<f64, 5, _>(|k| x[k]));
    let (angle, turn) = (a.hypot(b), a * db - b * da);
    let share = (1.0 - angle.cos()) / (angle * angle);
    let along = angle.cos();
    // w_x - (w . a) a_x of the frame that does not spin.
    let across = share * turn * (1.0 + along);
    of_balls.sum::<f64>() + ring_mass * (y * vz - z * vy) + transverse * across + polar * speed * along
}

/// Without friction and damping energy and the axial angular momentum stay.
#[test]
fn without_friction_nothing_is_lost() {
    let speed = 837.0;
    let changes = [
        ("raceways", json!({"contact": {}})),
        ("inner_ring.motion", free_ring([17.8e3, 0.0, 0.0, 0.0, 0.0])),
        ("inner_ring.speed", json!({"constant": speed})),
        ("initial", json!({"inner_ring": "equilibrium"})),
        ("solver", json!({"method": {"dormand_prince": {"tolerance": 1e-9}}})),
    ];
    let model = model(ANGULAR, &changes);
    let mut sim = Sim::new(model.clone()).unwrap();
    // Shifted, tilted and moving.
    let mut state = sim.state().to_vec();
    let nq = model.layout().positions();
    for (k, (place, rate)) in
        [(0.0, 0.02), (2e-5, 0.01), (-1e-5, -0.03), (4e-4, 0.2), (-3e-4, 0.1)].into_iter().enumerate()
    {
        state[k] += place;
        state[nq + k] += rate;
    }
    sim.set_state(0.0, &state).unwrap();
    let before = axial_momentum(&model, sim.state(), speed);
    let mut largest: f64 = 0.0;
    for k in 1..=20 {
        sim.advance_to(0.5e-3 * f64::from(k)).unwrap();
        largest = largest.max((axial_momentum(&model, sim.state(), speed) / before - 1.0).abs());
    }
    let balance = sim.power_balance().unwrap();
    let missing = balance.residual() / balance.energy[0].total();
    assert!(missing.abs() < 1e-8, "{missing}");
    assert!(largest < 1e-12, "{largest}");
}

/// A ball that touches nothing flies straight and keeps its spin, whatever the axes that it is told in.
#[test]
fn a_free_ball_flies_straight() {
    let changes = [
        ("inner_ring.radial_clearance", json!(3e-4)),
        ("inner_ring.motion", json!({"space": {}})),
        ("initial", json!({})),
        ("gravity", Value::Null),
        ("solver", json!({"method": {"dormand_prince": {"tolerance": 1e-12}}})),
    ];
    let model = model(DEEP, &changes);
    let mut sim = Sim::new(model.clone()).unwrap();
    let (nq, layout) = (model.layout().positions(), model.layout());
    let mut state = sim.state().to_vec();
    let (at, spin) = (layout.element(0), layout.spin(0));
    let start = [1e-5, -2e-5, 0.3];
    let speeds = [0.01, 0.005, 5.0];
    let turning = [-300.0, 120.0, 45.0];
    for k in 0..3 {
        (state[at + k], state[nq + at + k], state[nq + spin + k]) = (start[k], speeds[k], turning[k]);
    }
    sim.set_state(0.0, &state).unwrap();
    let pitch = model.pitch_radius();
    let told = |sim: &Sim| {
        let (q, v) = sim.state().split_at(nq);
        let (sin, cos) = q[at + 2].sin_cos();
        let r = pitch + q[at + 1];
        let [x, y, z] = [q[at], r * cos, r * sin];
        let spins: [f64; 3] = std::array::from_fn(|k| v[spin + k]);
        let [wx, wr, wt] = spins;
        ([x, y, z], [wx, wr * cos - wt * sin, wr * sin + wt * cos])
    };
    let (place, spins) = told(&sim);
    let (sin, cos) = start[2].sin_cos();
    let around = (pitch + start[1]) * speeds[2];
    let velocity = [speeds[0], speeds[1] * cos - around * sin, speeds[1] * sin + around * cos];
    let t = 4e-3;
    sim.advance_to(t).unwrap();
    let (moved, kept) = told(&sim);
    for k in 0..3 {
        let off = moved[k] - place[k] - velocity[k] * t;
        assert!(off.abs() < 1e-13, "{k}: {off}");
        assert!((kept[k] - spins[k]).abs() < 1e-9, "{kept:?} {spins:?}");
    }
}
