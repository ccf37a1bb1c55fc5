//! Rollers of different size: as in a bearing whose dimensions all changed, alone under load, and over time.

use crate::common::{example_with, with};
use crate::started::bits;
use cagedyn::{Model, Sim};
use serde_json::{Value, json};
use std::sync::Arc;

const NORMAL: usize = 0;
const DEVIATIONS: &str = "rollers.radius_deviations";

fn sim(scene: &Value) -> Sim {
    Sim::new(Arc::new(Model::from_json(&scene.to_string()).unwrap_or_else(|e| panic!("{e}")))).unwrap()
}

/// The example that does not turn, its first roller below, where the load is, with these changes.
fn still(changes: &[(&str, Value)]) -> Value {
    let below = json!(-std::f64::consts::FRAC_PI_2);
    let still = [
        ("inner_ring.speed", json!({"constant": 0.0})),
        ("initial.first_roller_angle", below),
        ("gravity", Value::Null),
    ];
    with(&example_with(&still), changes)
}

/// Loads of the contacts with one raceway, N, roller by roller.
fn loads(sim: &mut Sim, raceway: &str) -> Vec<f64> {
    let names: Vec<String> = sim.model().contact_names();
    let forces = sim.forces().unwrap();
    let of_raceway = names.iter().zip(&forces.contacts).filter(|(name, _)| name.ends_with(raceway));
    of_raceway.map(|(_, contact)| contact[NORMAL]).collect()
}

#[test]
fn all_larger_is_a_bearing_of_larger_rollers_and_less_play() {
    let excess = 4e-6;
    let all = sim(&example_with(&[(DEVIATIONS, json!({"each": vec![excess; 12]}))]));
    // The raceways stay where they are.
    let other = example_with(&[
        ("rollers.radius", json!(7.5e-3 + excess)),
        ("inner_ring.radial_clearance", json!(40e-6 - 4.0 * excess)),
        ("cage.pocket.lubricated_cylinder.radial_clearance", json!(0.15e-3 - excess)),
    ]);
    let mut pair = [all, sim(&other)];
    let start: Vec<f64> = pair[0].state().to_vec();
    for (a, b) in start.iter().zip(pair[1].state()) {
        assert!((a - b).abs() < 1e-3 * b.abs() + 1e-10, "{a} {b}");
    }
    let [a, b] = pair.each_mut().map(|sim| loads(sim, "inner_raceway"));
    assert!(b.iter().any(|load| *load > 1000.0));
    for (a, b) in a.iter().zip(&b) {
        assert!((a - b).abs() < 1e-6 * b.abs() + 1e-3, "{a} {b} N");
    }
    // Rates at one state differ by what contacts of another curvature and a pocket of another wall make.
    let state = pair[1].state().to_vec();
    let rates = pair.each_mut().map(|sim| {
        let mut rate = vec![0.0; state.len()];
        sim.derivative(0.0, &state, &mut rate).unwrap();
        rate
    });
    let largest = rates[1].iter().fold(0.0f64, |a, b| a.max(b.abs()));
    for (a, b) in rates[0].iter().zip(&rates[1]) {
        assert!((a - b).abs() < 5e-3 * b.abs() + 1e-4 * largest, "{a} {b}");
    }
}

#[test]
fn a_larger_roller_carries_more_and_its_neighbours_less() {
    let mut equal = sim(&still(&[]));
    let mut one = sim(&still(&[(DEVIATIONS, json!({"groups": [{"rollers": [0], "deviation": 3e-6}]}))]));
    let [a, b] = [&mut equal, &mut one].map(|sim| loads(sim, "inner_raceway"));
    println!("{a:.0?} {b:.0?} N");
    assert!(b[0] > 1.1 * a[0] && b[1] < a[1] && b[11] < a[11]);
    // The load is the same, and the ring is at rest.
    let carried = |loads: &[f64]| -> f64 {
        loads.iter().enumerate().map(|(j, load)| load * (j as f64 * std::f64::consts::TAU / 12.0).cos()).sum()
    };
    for loads in [&a, &b] {
        assert!((carried(loads) - 4900.0).abs() < 5.0, "{} N", carried(loads));
    }
    let ring = |sim: &Sim| {
        let z = sim.model().state_infos().iter().position(|info| info.name == "inner_ring.z").unwrap();
        sim.state()[z]
    };
    // The ring is pushed up by less than the larger diameter.
    let lifted = ring(&one) - ring(&equal);
    assert!(lifted > 1e-6 && lifted < 6e-6, "{lifted} m");
}

/// A roller that takes more than the play pushes the ring aside until the others across carry it.
#[test]
fn a_ring_without_a_load_rests_between_rollers_of_different_size() {
    let free = [
        ("inner_ring.motion.free.load", Value::Null),
        (DEVIATIONS, json!({"groups": [{"rollers": [0], "deviation": 30e-6}]})),
    ];
    let mut sim = sim(&still(&free));
    let state = sim.state().to_vec();
    let place = |name: &str| sim.model().state_infos().iter().position(|info| info.name == name).unwrap();
    let [z, fall] = ["inner_ring.z", "inner_ring.vz"].map(place);
    assert!(state[z] > 20e-6 && state[z] < 40e-6, "{} m", state[z]);
    let mut rate = vec![0.0; state.len()];
    sim.derivative(0.0, &state, &mut rate).unwrap();
    // Contacts of kilonewtons are in balance on three kilograms.
    assert!(loads(&mut sim, "inner_raceway")[0] > 1e3 && rate[fall].abs() < 1e-2, "{} m/s^2", rate[fall]);
}

#[test]
fn numbers_and_groups_are_the_same() {
    let mut each = vec![0.0; 12];
    (each[2], each[7], each[5]) = (2e-6, 2e-6, -1e-6);
    let groups = json!({"groups": [
        {"rollers": [7, 2], "deviation": 2e-6}, {"rollers": [5], "deviation": -1e-6}]});
    let [a, b] = [json!({ "each": each }), groups].map(|deviations| {
        let mut sim = sim(&example_with(&[(DEVIATIONS, deviations)]));
        sim.advance_to(5e-3).unwrap();
        bits(sim.state())
    });
    assert!(a == b);
    // Without deviations nothing changes.
    let [a, b] = [json!({"each": vec![0.0; 12]}), Value::Null].map(|deviations| {
        let mut sim = sim(&example_with(&[(DEVIATIONS, deviations)]));
        sim.advance_to(5e-3).unwrap();
        bits(sim.state())
    });
    assert!(a == b);
}

#[test]
fn the_power_balance_closes() {
    let sizes: Vec<f64> = (0..12).map(|j| 1.5e-6 * f64::from((7 * j) % 5 - 2)).collect();
    for pocket in
        [None, Some(json!({"solid_plane": {"diametral_clearance": 0.3e-3, "contact": {"stiffness": 5e7}}}))]
    {
        for method in [
            json!({"method": {"auto": {}}}),
            json!({"method": {"leapfrog": {"step": 1e-6}}}),
            json!({"method": {"dormand_prince": {"tolerance": 1e-5}}}),
            json!({"method": {"rosenbrock": {"tolerance": 1e-4}}}),
        ] {
            let mut changes = vec![(DEVIATIONS, json!({ "each": sizes })), ("solver", method.clone())];
            changes.extend(pocket.clone().map(|pocket| ("cage.pocket", pocket)));
            let mut sim = sim(&example_with(&changes));
            sim.advance_to(10e-3).unwrap();
            let residual = sim.power_balance().unwrap().relative_residual();
            println!("{method}: {residual:.1e}");
            assert!(residual.abs() < 1e-3, "{method}: {residual:e}");
        }
    }
}
