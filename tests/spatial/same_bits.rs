//! The same bits from a snapshot, with any vector instructions, and what a run tells.

use crate::{DEEP, everything, free_ring, model};
use cagedyn::Sim;
use serde_json::json;

fn bits(x: &[f64]) -> Vec<u64> {
    x.iter().map(|x| x.to_bits()).collect()
}

#[test]
fn a_restored_run_goes_on_with_the_same_bits() {
    let model = everything();
    let mut first = Sim::new(model.clone()).unwrap();
    let load = model.input_infos().iter().position(|input| input.name == "load.x").unwrap();
    first.set_input(load, 15e3).unwrap();
    first.advance_to(1.3e-3).unwrap();
    let saved = first.save();
    let mut second = Sim::new(model).unwrap();
    second.restore(&saved).unwrap();
    for sim in [&mut first, &mut second] {
        sim.advance_to(2.5e-3).unwrap();
    }
    assert_eq!(bits(first.state()), bits(second.state()));
    assert_eq!(first.statistics(), second.statistics());
    let outputs = |sim: &mut Sim| {
        let mut out = vec![0.0; sim.channels().len()];
        sim.outputs(&mut out).unwrap();
        out
    };
    assert_eq!(bits(&outputs(&mut first)), bits(&outputs(&mut second)));
    assert!(outputs(&mut first).iter().all(|x| x.is_finite()));
}

#[test]
fn vector_instructions_change_no_bit() {
    for model in [
        everything(),
        model(
            DEEP,
            &[
                ("inner_ring.motion", free_ring([50.0, 0.0, -800.0, 1.0, 0.0])),
                ("inner_ring.speed", json!({"constant": 400.0})),
                ("initial", json!({"inner_ring": "equilibrium"})),
            ],
        ),
    ] {
        let run = |vector: bool| {
            let mut sim = Sim::new(model.clone()).unwrap();
            sim.set_vector_instructions(vector);
            sim.advance_to(1e-3).unwrap();
            bits(sim.state())
        };
        assert_eq!(run(true), run(false));
    }
}

/// A free ring under load in all directions keeps its power balance with the leapfrog.
#[test]
fn a_deep_groove_bearing_keeps_its_power_balance() {
    let model = model(
        DEEP,
        &[
            ("inner_ring.motion", free_ring([200.0, 100.0, -3000.0, 2.0, 1.0])),
            ("inner_ring.speed", json!({"constant": 400.0})),
            ("solver", json!({"method": {"leapfrog": {}}})),
        ],
    );
    let mut sim = Sim::new(model).unwrap();
    sim.advance_to(0.02).unwrap();
    let balance = sim.power_balance().unwrap();
    assert!(balance.relative_residual().abs() < 1e-3, "{balance:?}");
    assert!(sim.doubts().is_empty(), "{:?}", sim.doubts());
}

/// A ring that is pulled out of its bearing is told, and a ball behind its groove is a fault that names it.
#[test]
fn what_leaves_the_bearing_is_told() {
    let model = everything();
    let mut sim = Sim::new(model.clone()).unwrap();
    let load = model.input_infos().iter().position(|input| input.name == "load.x").unwrap();
    sim.set_input(load, -2e4).unwrap();
    sim.advance_to(5e-3).unwrap();
    assert!(sim.remarks().iter().any(|remark| remark.contains("low shoulder")), "{:?}", sim.remarks());
    let (mut state, mut rate) = (sim.state().to_vec(), vec![0.0; sim.state().len()]);
    state[model.layout().element(3) + 1] -= 8e-4;
    let error = sim.derivative(sim.time(), &state, &mut rate).unwrap_err();
    assert!(error.message.contains("ball[3] has left the groove of its "), "{error}");
    sim.advance_to(5.1e-3).unwrap();
}
