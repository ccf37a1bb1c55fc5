//! Motion over time that settles, against that of independent solutions.

use crate::{ANGULAR, model};
use cagedyn::equilibrium::{RaceControl, equilibrium};
use cagedyn::{Model, Sim};
use serde_json::{Value, json};
use std::sync::Arc;

fn channel(sim: &mut Sim, name: &str) -> f64 {
    let place = sim.channels().iter().position(|channel| channel.name == name).expect("a channel");
    sim.output(place).unwrap()
}

fn fast_218(start: &str, method: Value) -> Arc<Model> {
    model(
        ANGULAR,
        &[
            ("inner_ring.motion.space.load.x.constant", json!(22250.0)),
            ("inner_ring.speed.constant", json!(1_047.197_551_196_597_7)),
            ("initial", json!({"inner_ring": start})),
            ("solver", json!({"method": method})),
        ],
    )
}

/// Contact angles, loads, orbit and axis of the balls of a 218 at 10 000 rev/min, from rest in the middle as from the equilibrium.
#[test]
fn a_fast_angular_contact_bearing() {
    for (start, method, until) in [
        ("equilibrium", json!({"auto": {}}), 0.01),
        ("centred", json!({"auto": {}}), 0.15),
        ("centred", json!({"leapfrog": {}}), 0.15),
    ] {
        let mut sim = Sim::new(fast_218(start, method)).unwrap();
        sim.advance_to(until).unwrap();
        for (name, expected, allowed) in [
            ("ball[3].inner_angle", 47.90_f64.to_radians(), 0.05_f64.to_radians()),
            ("ball[3].outer_angle", 34.67_f64.to_radians(), 0.05_f64.to_radians()),
            ("ball[3].inner_force", 1838.0, 2.0),
            ("ball[3].outer_force", 2276.0, 2.0),
            ("ball[3].pitch_angle", 34.3_f64.to_radians(), 0.1_f64.to_radians()),
        ] {
            let found = channel(&mut sim, name);
            assert!((found - expected).abs() < allowed, "{start} {name}: {found} {expected}");
        }
        let orbit = sim.state()[sim.model().layout().positions() + sim.model().layout().element(3) + 2];
        assert!((orbit / 1_047.197_551_196_597_7 - 0.4411).abs() < 1e-4, "{orbit}");
        let doubts = sim.doubts();
        assert!(doubts.is_empty(), "{doubts:?}");
    }
}

/// Nothing moves at the steady motion that the equations of the equilibrium have.
#[test]
fn the_steady_motion_of_the_equilibrium_is_that_over_time() {
    let model = fast_218("equilibrium", json!({"auto": {}}));
    let mut sim = Sim::new(model.clone()).unwrap();
    let state = sim.state().to_vec();
    let mut rate = vec![0.0; state.len()];
    sim.derivative(0.0, &state, &mut rate).unwrap();
    let (nq, scales) = (model.layout().positions(), model.state_scales());
    for (k, rate) in rate.iter().enumerate().skip(nq) {
        assert!(rate.abs() < 1e-3 * scales[k] * 1e4, "{}: {rate}", model.state_infos()[k].name);
    }
    let found = equilibrium(&model, RaceControl::Friction).unwrap();
    let force = found.contact_quantities.iter().position(|q| q.name == "normal_force").unwrap();
    let here = channel(&mut sim, "ball[0].inner_force");
    assert!((here / found.contact_values[1][force] - 1.0).abs() < 1e-9, "{here}");
}
