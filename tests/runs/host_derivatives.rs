//! Derivatives over inputs and of outputs, for hosts with an implicit solver.

use crate::common::{example_with, read, with};
use crate::machine::{input, prescribed, sim, state_place, support};
use cagedyn::Sim;
use serde_json::{Value, json};

/// Scenes whose inputs are all there are.
fn scenes_with_inputs() -> Vec<Value> {
    let unbalance = json!({"moment": 5e-3, "phase": 0.8});
    let load = json!({"y": {"constant": 200.0}, "z": {"constant": -4000.0}});
    let free = json!({"free": {"mass": 2.0, "support": support(), "load": load, "unbalance": unbalance}});
    let rotor =
        json!({"mass": 30.0, "shaft": {"stiffness": 5e7, "internal_damping": 300.0}, "unbalance": unbalance});
    let at = prescribed(json!(3e-6), json!(-27e-6));
    let space: Value = serde_json::from_str(&read("scenes/angular_contact_70_cage.json")).unwrap();
    let grease: Value = serde_json::from_str(&read("scenes/grease_guide.json")).unwrap();
    let speed = ("outer_ring.speed", json!({"constant": 20.0}));
    vec![
        example_with(&[
            ("outer_ring.motion", free.clone()),
            ("inner_ring.motion", free),
            ("rotor", rotor),
            speed.clone(),
        ]),
        example_with(&[("outer_ring.motion", at.clone()), ("inner_ring.motion", at.clone()), speed]),
        with(&grease, &[("inner_ring.motion", at.clone()), ("gravity", Value::Null)]),
        with(&space, &[("inner_ring.motion.space.y", json!({"prescribed": {"constant": 2e-6}}))]),
    ]
}

/// Exact derivatives over every input are differences of the rates; those of the outputs have the forces of these rates.
#[test]
fn derivatives_over_inputs_are_differences() {
    let (mut compared, mut acting) = (0, 0);
    for scene in scenes_with_inputs() {
        let mut sim = sim(&scene);
        sim.advance_to(1.2e-3).unwrap();
        let (t, state) = (sim.time(), sim.state().to_vec());
        let (n, infos) = (state.len(), sim.model().input_infos());
        let mut exact = vec![0.0; n * infos.len()];
        sim.input_jacobian(t, &state, &mut exact).unwrap();
        for (k, info) in infos.iter().enumerate() {
            let now = sim.input(k).unwrap();
            let step = match info.unit {
                "m" | "rad" => 1e-11,
                "m/s" => 1e-7,
                // Friction that hardly slips bends within 1e-2 rad/s.
                "rad/s" => 1e-4,
                "K" => 1e-3,
                _ => 1e-2,
            };
            let rates = [1.0, -1.0, 2.0, -2.0].map(|side| {
                sim.set_input(k, now + side * step).unwrap();
                let mut rate = vec![0.0; n];
                sim.derivative(t, &state, &mut rate).unwrap();
                rate
            });
            sim.release_input(k).unwrap();
            let column = &exact[k * n..(k + 1) * n];
            let largest = column.iter().fold(0.0f64, |most, x| most.max(x.abs()));
            let size = rates[0].iter().fold(0.0f64, |most, x| most.max(x.abs()));
            acting += usize::from(largest > 0.0);
            for i in 0..n {
                let [near, far] = [rates[0][i] - rates[1][i], rates[2][i] - rates[3][i]];
                let difference = (8.0 * near - far) / (12.0 * step);
                let error = (column[i] - difference).abs();
                // Round-off of the rates counts where an input does little.
                assert!(
                    error < 2e-5 * largest + 1e-14 * size / step,
                    "{} {i}: {} {difference}",
                    info.name,
                    column[i]
                );
                compared += 1;
            }
        }
    }
    assert!(compared > 1000 && acting >= 18, "{compared} {acting}");
}

/// What depends on an input stands in the pattern.
fn check_feedthrough(sim: &Sim, over_inputs: &[f64]) {
    let (pattern, outputs) = (sim.model().feedthrough_pattern(), sim.channels().len());
    let mut seen = 0;
    for (k, column) in over_inputs.chunks(outputs).enumerate() {
        let rows = &pattern.rows[pattern.column_starts[k]..pattern.column_starts[k + 1]];
        for (i, value) in column.iter().enumerate() {
            let name = || format!("{} over {}", sim.channels()[i].name, sim.model().input_infos()[k].name);
            assert!(*value == 0.0 || rows.contains(&i), "{}", name());
            seen += usize::from(*value != 0.0);
        }
    }
    assert!(seen > 0, "nothing of {}", pattern.rows.len());
}

#[test]
fn outputs_change_at_once_with_what_their_pattern_says() {
    let prescribed = json!({"prescribed": {"y": {"constant": 1e-6}, "z": {"constant": -3e-5}}});
    let oil = json!({"walther": {
        "cold": {"temperature": 313.15, "kinematic_viscosity": 105e-6},
        "hot": {"temperature": 373.15, "kinematic_viscosity": 12e-6},
        "density": 880.0, "temperature": {"over_time": {"constant": 330.0}}
    }});
    let rollers = [
        ("inner_ring.motion", prescribed),
        ("outer_ring.speed", json!({"constant": 20.0})),
        ("lubricant.viscosity", oil),
    ];
    let mut scenes = vec![example_with(&rollers)];
    for name in [
        "grease_guide",
        "grease_guide_elastic",
        "nu2310_space",
        "deep_groove_6206",
        "angular_contact_70_cage",
    ] {
        scenes.push(serde_json::from_str(&read(&format!("scenes/{name}.json"))).unwrap());
    }
    for scene in scenes {
        let mut sim = sim(&scene);
        sim.advance_to(2e-4).unwrap();
        let (t, state) = (sim.time(), sim.state().to_vec());
        let (n, outputs, inputs) = (state.len(), sim.channels().len(), sim.model().input_count());
        let (mut over_states, mut over_inputs) = (vec![0.0; n * outputs], vec![0.0; inputs * outputs]);
        sim.output_jacobian(t, &state, &mut over_states, &mut over_inputs).unwrap();
        check_feedthrough(&sim, &over_inputs);
    }
}

#[test]
fn derivatives_of_outputs_have_the_forces_of_the_rates() {
    let load = json!({"y": {"constant": 0.0}, "z": {"constant": -4900.0}});
    let mut sim = sim(&example_with(&[("inner_ring.motion", json!({"free": {"mass": 3.0, "load": load}}))]));
    sim.advance_to(1.2e-3).unwrap();
    let (t, state) = (sim.time(), sim.state().to_vec());
    let (n, outputs, inputs) = (state.len(), sim.channels().len(), sim.model().input_count());
    let mut exact = vec![0.0; n * n];
    sim.jacobian(t, &state, &mut exact).unwrap();
    let (mut over_states, mut over_inputs) = (vec![0.0; n * outputs], vec![0.0; inputs * outputs]);
    sim.output_jacobian(t, &state, &mut over_states, &mut over_inputs).unwrap();
    let place = |name: &str| sim.channels().iter().position(|c| c.name == name).unwrap();
    let (force, rate, cage) =
        (place("inner_ring.force_z"), state_place(&sim, "inner_ring.vz"), place("cage.y"));
    let largest = (0..n).fold(0.0f64, |most, k| most.max(3.0 * exact[k * n + rate].abs()));
    for k in 0..n {
        let (by_output, by_rate) = (over_states[k * outputs + force], 3.0 * exact[k * n + rate]);
        assert!((by_output - by_rate).abs() < 1e-6 * largest, "{k}: {by_output} {by_rate}");
    }
    let own = state_place(&sim, "cage.y");
    for k in 0..n {
        let expected = f64::from(u8::from(k == own));
        assert!((over_states[k * outputs + cage] - expected).abs() < 1e-6, "{k}");
    }
    // The speed of the ring moves the friction on it; a load moves no force of the bearing at once.
    let [speed, load] = ["inner_ring.speed", "load.z"].map(|name| input(&sim, name));
    assert!(over_inputs[speed * outputs + place("inner_ring.drag_torque")].abs() > 1e-6);
    assert_eq!(over_inputs[load * outputs + force], 0.0);
    check_feedthrough(&sim, &over_inputs);
    let text = sim.output_jacobian(t, &state, &mut over_states, &mut []).unwrap_err().message;
    assert!(text.starts_with("over_inputs"), "{text}");
    assert_eq!(sim.next_event(t), Ok(f64::INFINITY));
}
