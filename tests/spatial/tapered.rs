//! Tapered rollers: statics of their forces, conservation, derivatives, signs by mirrored runs.

use crate::conservation::{cancel, powers};
use crate::derivatives::error;
use crate::model;
use cagedyn::equilibrium::{RaceControl, equilibrium};
use cagedyn::{Model, Sim};
use serde_json::{Value, json};
use std::sync::Arc;

const SCENE: &str = "scenes/tapered_32210.json";
/// Angles of the scene, rad: half angle of the rollers, outer raceway, opening of the ribs.
const HALF_ANGLE: f64 = 0.03125;
const OUTER_ANGLE: f64 = 0.273;
const OPENING: f64 = 0.0245;

fn constant(x: f64) -> Value {
    json!({ "constant": x })
}

/// The bearing under thrust alone, with changes.
fn thrust(changes: &[(&str, Value)]) -> Arc<Model> {
    let load = [("inner_ring.motion.space.load", json!({"x": constant(-4000.0)}))];
    model(SCENE, &[&load[..], changes].concat())
}

fn place(model: &Model, name: &str) -> usize {
    model.state_infos().iter().position(|info| info.name == name).expect(name)
}

/// Two raceways and the rib hold every roller like a wedge: Z Q_o sin(alpha_o) is the thrust, and the rib carries Q_o sin(2 beta) over
/// the cosine of its angle to the inner raceway.
#[test]
fn under_thrust_the_rib_carries_what_the_wedge_pushes_out() {
    for free in [true, false] {
        let mut changes = vec![("inner_ring.speed", constant(0.0)), ("cage", Value::Null)];
        if free {
            changes.push(("inner_ring.motion.space.tilt_y", json!("free")));
            changes.push(("inner_ring.motion.space.tilt_z", json!("free")));
            changes.push(("inner_ring.motion.space.inertia", json!({"polar": 1e-3, "transverse": 6e-4})));
        }
        let model = thrust(&changes);
        let found = equilibrium(&model, RaceControl::None).unwrap();
        assert!(found.residual < 1e-9, "{}", found.residual);
        let count = model.element_count();
        let inner_angle = OUTER_ANGLE - 2.0 * HALF_ANGLE;
        let rib_angle = OUTER_ANGLE - HALF_ANGLE - OPENING;
        let outer = 4000.0 / (count as f64 * OUTER_ANGLE.sin());
        let rib = outer * (2.0 * HALF_ANGLE).sin() / (rib_angle - inner_angle).cos();
        let inner = outer * (OUTER_ANGLE - rib_angle).cos() / (rib_angle - inner_angle).cos();
        for j in 0..count {
            for (name, expected) in [
                ("outer_raceway", outer),
                ("inner_raceway", inner),
                ("inner_rib_positive", rib),
                ("inner_rib_negative", 0.0),
            ] {
                let name = format!("roller[{j}].{name}");
                let k = found.contacts.iter().position(|contact| *contact == name).unwrap();
                let load = found.contact_values[k][0];
                // Angles change with the loads by micrometres over millimetres.
                assert!((load - expected).abs() <= 2e-4 * outer, "{name}: {load} {expected}");
            }
        }
        let [x, y] = [found.displacement[0], found.displacement[1]];
        assert!(x < -1e-6 && y.abs() < 1e-3 * x.abs(), "{x} {y}");
    }
}

#[test]
fn forces_cancel_and_powers_are_the_rate_of_the_energy() {
    let scene = model(
        SCENE,
        &[
            ("inner_ring.motion.space.tilt_y", json!("free")),
            ("inner_ring.motion.space.tilt_z", json!("free")),
            ("inner_ring.motion.space.inertia", json!({"polar": 1e-3, "transverse": 6e-4})),
        ],
    );
    cancel(&scene, 1e3);
    powers(&scene, 1e-3);
    let whole =
        model(SCENE, &[("rollers.space.slices_on", json!("whole")), ("rollers.profile", Value::Null)]);
    powers(&whole, 1e-6);
}

#[test]
fn derivatives_are_those_of_the_accelerations() {
    let off = error(&model(SCENE, &[]), 0.1);
    println!("{off:e}");
    assert!(off < 1e-6, "{off}");
}

/// Without friction and damping nothing is lost, and spins stay to the last bit.
#[test]
fn without_friction_nothing_is_lost() {
    let contact = json!({});
    let model = thrust(&[
        ("cage", Value::Null),
        ("raceways", json!({"contact": contact, "slices": 8})),
        ("rollers.profile", Value::Null),
        ("rollers.space.slices_on", json!("whole")),
        ("ribs.contact", contact),
        ("inner_ring.motion.space.support_damping", Value::Null),
        ("solver", json!({"method": {"dormand_prince": {"tolerance": 1e-10}}})),
    ]);
    let mut sim = Sim::new(model.clone()).unwrap();
    let mut state = sim.state().to_vec();
    let count = model.element_count();
    for j in 0..count {
        let x = j as f64;
        for (name, size) in [("skew", 1e-3), ("tilt", 3e-5), ("tilt_speed", 0.3), ("axial_speed", 2e-3)] {
            state[place(&model, &format!("roller[{j}].{name}"))] += size * (1.0 + x).sin();
        }
    }
    sim.set_state(0.0, &state).unwrap();
    let spins: Vec<f64> =
        (0..count).map(|j| state[place(&model, &format!("roller[{j}].spin_speed"))]).collect();
    sim.advance_to(1e-3).unwrap();
    let balance = sim.power_balance().unwrap();
    let missing = balance.residual() / balance.energy[0].total();
    assert!(missing.abs() < 1e-8, "{missing}");
    for (j, spin) in spins.iter().enumerate() {
        let now = sim.state()[place(&model, &format!("roller[{j}].spin_speed"))];
        assert_eq!(now.to_bits(), spin.to_bits(), "{j}: {now} {spin}");
    }
}

/// The mean skew of all rollers from 10 to 30 ms, rad.
fn mean_skew(speed: f64) -> f64 {
    let model = thrust(&[("inner_ring.speed", constant(speed)), ("cage", Value::Null)]);
    let mut sim = Sim::new(model.clone()).unwrap();
    let skews: Vec<usize> =
        (0..model.element_count()).map(|j| place(&model, &format!("roller[{j}].skew"))).collect();
    let (mut sum, mut records) = (0.0, 0);
    sim.advance_to(0.01).unwrap();
    for i in 1..=40 {
        sim.advance_to(0.01 + f64::from(i) * 5e-4).unwrap();
        sum += skews.iter().map(|place| sim.state()[*place]).sum::<f64>() / skews.len() as f64;
        records += 1;
    }
    sum / f64::from(records)
}

/// The end that rubs on an inner rib leads: of a shaft that turns clockwise the large end at +x goes towards -e_psi, which is a positive skew.
#[test]
fn rib_friction_skews_rollers_and_the_mirror_image_the_other_way() {
    let [clockwise, other] = [-314.0, 314.0].map(mean_skew);
    println!("{clockwise:e} {other:e}");
    assert!(clockwise > 0.0 && other < 0.0, "{clockwise} {other}");
    assert!((clockwise + other).abs() < 0.3 * clockwise, "{clockwise} {other}");
}
