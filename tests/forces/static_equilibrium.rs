//! The start in static equilibrium: balance of the ring, robustness, and the load of the rollers.

use crate::common::palmgren::{STEEL, palmgren_load};
use crate::common::reports::{GRAVITY, INNER_RING, LOAD, NORMAL, sum};
use crate::common::{example, set, with};
use cagedyn::{Model, Sim};
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// A bearing whose raceways are elastic only.
fn elastic(changes: &[(&str, Value)]) -> Value {
    let bare = [("cage", Value::Null), ("raceways", json!({})), ("lubricant", Value::Null)];
    with(&with(&example(), &bare), changes)
}

#[test]
fn the_equilibrium_start_is_in_equilibrium() {
    let load_z = "inner_ring.motion.free.load.z.constant";
    let load_y = "inner_ring.motion.free.load.y.constant";
    let clearance = "inner_ring.radial_clearance";
    for changes in [
        vec![],
        vec![(clearance, json!(5e-6))],
        vec![(clearance, json!(0.0)), (load_z, json!(-40e3))],
        vec![(clearance, json!(-5e-6)), (load_z, json!(-980.0))],
        vec![(load_y, json!(3000.0)), (load_z, json!(800.0))],
        vec![("initial.first_roller_angle", json!(0.1)), (clearance, json!(200e-6))],
        vec![("inner_ring.speed.constant", json!(-1500.0)), (load_z, json!(-100.0))],
    ] {
        let mut scene = elastic(&changes);
        set(&mut scene, "initial.inner_ring", json!("equilibrium"));
        let mut sim = Sim::new(Arc::new(Model::from_json(&scene.to_string()).unwrap())).unwrap();
        let ring = sim.forces().unwrap().bodies[INNER_RING];
        let [y, z, _] = sum(&ring);
        let load = (ring[LOAD][0] + ring[GRAVITY][0]).hypot(ring[LOAD][1] + ring[GRAVITY][1]);
        let net = y.hypot(z);
        assert!(net < 1e-6 * load, "{changes:?}: net force {net} N under {load} N");
    }
}

#[test]
fn the_equilibrium_start_is_found_for_any_clearance_load_and_roller_angle() {
    let (mut tried, mut failed) = (0, Vec::new());
    for clearance in [-5e-6, 0.0, 5e-6, 40e-6, 200e-6] {
        for load in [1.0, 30.0, 300.0, 4900.0, 100e3] {
            for (count, first) in [(7, 0.3), (12, 0.0), (12, 0.07), (12, 0.14), (12, 0.35), (14, 0.14)] {
                let mut scene = elastic(&[
                    ("gravity", Value::Null),
                    ("rollers.count", json!(count)),
                    ("inner_ring.radial_clearance", json!(clearance)),
                    ("inner_ring.motion.free.load.z.constant", json!(-load)),
                ]);
                set(&mut scene, "initial", json!({"inner_ring": "equilibrium", "first_roller_angle": first}));
                tried += 1;
                if Sim::new(Arc::new(Model::from_json(&scene.to_string()).unwrap())).is_err() {
                    failed.push(format!("{clearance} m, {load} N, {count} rollers from {first} rad"));
                }
            }
        }
    }
    assert!(failed.is_empty(), "not found {} times of {tried}: {}", failed.len(), failed.join("; "));
}

/// Z Qmax/Fr of rigid rings from the sum over the rollers, one of them in the direction of the load: at a ring shift x
/// the roller at psi is squeezed by x cos(psi) - G_r/2, shared by two equal contacts.
fn load_share(count: usize, length: f64, clearance: f64, load: f64) -> f64 {
    let roller_loads = |x: f64| -> Vec<(f64, f64)> {
        (0..count)
            .map(|j| {
                let cos = (TAU * j as f64 / count as f64).cos();
                let squeeze = (x * cos - 0.5 * clearance).max(0.0);
                (palmgren_load(0.5 * squeeze, length, STEEL), cos)
            })
            .collect()
    };
    let (mut low, mut high) = (0.0, 1e-3);
    for _ in 0..100 {
        let x = 0.5 * (low + high);
        let carried: f64 = roller_loads(x).iter().map(|(q, cos)| q * cos).sum();
        if carried > load { high = x } else { low = x }
    }
    let largest = roller_loads(low).iter().fold(0.0f64, |m, (q, _)| m.max(*q));
    count as f64 * largest / load
}

#[test]
fn the_largest_roller_load_is_that_of_the_sum_over_the_rollers() {
    let (count, length, load) = (60, 5e-3, 4900.0);
    for clearance in [5e-6, 2e-6, 1e-6, 0.0] {
        let mut scene = elastic(&[
            ("gravity", Value::Null),
            ("rollers.count", json!(count)),
            ("rollers.radius", json!(2e-3)),
            ("rollers.effective_length", json!(length)),
            ("rollers.mass", json!(5e-4)),
            ("rollers.inertia", json!(1e-9)),
            ("inner_ring.radial_clearance", json!(clearance)),
            ("inner_ring.speed.constant", json!(0.0)),
            ("inner_ring.motion.free.load.z.constant", json!(-load)),
        ]);
        set(&mut scene, "initial", json!({"inner_ring": "equilibrium", "first_roller_angle": -PI / 2.0}));
        let mut sim = Sim::new(Arc::new(Model::from_json(&scene.to_string()).unwrap())).unwrap();
        let forces = sim.forces().unwrap();
        let largest = forces.contacts.chunks_exact(2).fold(0.0f64, |m, c| m.max(c[1][NORMAL]));
        let share = f64::from(count) * largest / load;
        let expected = load_share(count as usize, length, clearance, load);
        assert!(
            (share / expected - 1.0).abs() < 0.01,
            "clearance {clearance}: {share} instead of {expected}"
        );
        if clearance == 0.0 {
            // The value for line contacts without clearance.
            assert!((share / 4.08 - 1.0).abs() < 0.01, "{share} instead of 4.08");
        }
    }
}
