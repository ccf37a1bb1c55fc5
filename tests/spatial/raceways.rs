//! Races that are not round, rings that are moved, and what a run notices.

use crate::{ANGULAR, DEEP, driven, model};
use cagedyn::Sim;
use serde_json::json;

fn output(sim: &mut Sim, name: &str) -> f64 {
    let place = sim.channels().iter().position(|channel| channel.name == name).unwrap();
    let mut out = vec![0.0; sim.channels().len()];
    sim.outputs(&mut out).unwrap();
    out[place]
}

/// Factor of cos(16 angle) in the axial place of the ring of a 218 with waves of as many periods as it has balls, of `amplitude` (m) on one
/// race; the angle is that of a ball in this race.
fn axial_vibration(ring: &str, amplitude: f64) -> f64 {
    let speed = 100.0;
    let model = model(
        ANGULAR,
        &[
            ("raceways", json!({"contact": {"damping": {"relaxation_time": 5e-7, "softening_depth": 1e-8}}})),
            ("inner_ring.speed", json!({"constant": speed})),
            ("inner_ring.motion.space.support_damping", json!(2e4)),
            (&format!("{ring}.waviness"), json!([{"order": 16, "amplitude": amplitude, "phase": 0.0}])),
        ],
    );
    let mut sim = Sim::new(model).unwrap();
    let (count, period) = (40, 9e-3);
    let [mut cos, mut square] = [0.0; 2];
    let mut list = Vec::new();
    for k in 0..count {
        let t = 20e-3 + period * f64::from(k) / f64::from(count);
        sim.advance_to(t).unwrap();
        let turned = if ring == "inner_ring" { speed * t } else { 0.0 };
        let angle = output(&mut sim, "ball[0].orbit_angle") - turned;
        list.push(((16.0 * angle).cos(), output(&mut sim, "inner_ring.x")));
    }
    let n = f64::from(count);
    let [mean_cos, mean] =
        [list.iter().map(|x| x.0).sum::<f64>() / n, list.iter().map(|x| x.1).sum::<f64>() / n];
    for (c, x) in list {
        cos += (c - mean_cos) * (x - mean);
        square += (c - mean_cos) * (c - mean_cos);
    }
    cos / square
}

/// All balls climb a wave together, and the ring with them: by the amplitude over the sine of the contact angle.
#[test]
fn waves_of_the_order_of_the_balls_shake_the_ring_along_the_axis() {
    for ring in ["outer_ring", "inner_ring"] {
        let amplitude = 1e-7;
        let found = axial_vibration(ring, amplitude);
        let expected = -amplitude / f64::sin(41.5_f64.to_radians());
        assert!((found / expected - 1.0).abs() < 0.02, "{ring}: {found} {expected}");
    }
}

/// Waves on the way, a ring that is moved: every method, and its power balance.
#[test]
fn a_ring_that_is_moved_keeps_its_power_balance() {
    for method in [json!({"leapfrog": {}}), json!({"dormand_prince": {}}), json!({"rosenbrock": {}})] {
        let scene = driven().scene().clone();
        let text = serde_json::to_string(&scene).unwrap();
        let set = json!({"method": method}).to_string();
        let scene = cagedyn::Scene::from_json_with(&text, [("solver", set.as_str())]).unwrap();
        let mut sim = Sim::new(std::sync::Arc::new(cagedyn::Model::new(scene).unwrap())).unwrap();
        sim.advance_to(4e-3).unwrap();
        let expected = 1e-5 + 1e-5 * (std::f64::consts::TAU * 300.0 * 4e-3 + 0.4).sin();
        assert!((output(&mut sim, "inner_ring.y") - expected).abs() < 1e-15);
        let balance = sim.power_balance().unwrap();
        assert!(balance.relative_residual().abs() < 1e-3, "{method}: {balance:?}");
    }
}

#[test]
fn a_run_notices_shoulders_pressures_and_rings_without_load() {
    let told = |changes: &[(&str, serde_json::Value)]| {
        let mut sim = Sim::new(model(DEEP, changes)).unwrap();
        sim.advance_to(1e-3).unwrap();
        sim.remarks().join("; ")
    };
    let load = "inner_ring.motion.space.load.z.constant";
    let still = ("initial.inner_ring", json!("equilibrium"));
    let heavy = told(&[(load, json!(-2.5e4)), still.clone()]);
    assert!(heavy.contains("in 100.00 % of the time a contact pressure was above 4.2 GPa"), "{heavy}");
    assert!(!heavy.contains("shoulder") && !heavy.contains("no ball"), "{heavy}");
    let shallow = told(&[("inner_ring.shoulder_height", json!(1e-4)), still]);
    assert_eq!(shallow, "in 100.00 % of the time an ellipse reached beyond the shoulder of its ring");
    let loose = told(&[(load, json!(0.0))]);
    assert_eq!(loose, "in 100.00 % of the time no ball pressed the inner ring");
}
