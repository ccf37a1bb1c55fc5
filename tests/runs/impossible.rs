//! States that no bearing can have end a run with a fault that names them; contacts that keep bearings out of them.

use crate::common::{Random, example_with, read, with};
use cagedyn::model::{FAULTS, POWERS};
use cagedyn::{Model, Sim, Status};
use serde_json::{Value, json};
use std::sync::Arc;

fn channel(sim: &Sim, name: &str) -> usize {
    sim.channels().iter().position(|c| c.name == name).unwrap_or_else(|| panic!("no {name}"))
}

fn sim(scene: &Value) -> Sim {
    Sim::new(Arc::new(Model::from_json(&scene.to_string()).unwrap_or_else(|e| panic!("{e}")))).unwrap()
}

/// Thirteen rollers without a cage at 60 1/min, which bunch below the shaft.
fn without_cage() -> Value {
    let mut scene = example_with(&[
        ("rollers.count", json!(13)),
        ("rollers.radius", json!(4.5e-3)),
        ("rollers.effective_length", json!(8e-3)),
        ("rollers.mass", json!(4e-3)),
        ("rollers.inertia", json!(4.05e-8)),
        ("outer_ring.raceway_radius", json!(27.75e-3)),
        ("inner_ring.radial_clearance", json!(0.0)),
        ("inner_ring.speed", json!({"constant": std::f64::consts::TAU})),
        ("inner_ring.motion.free.mass", json!(1.0)),
        ("inner_ring.motion.free.load.z", json!({"constant": -500.0})),
        ("record", json!({"duration": 1.0, "interval": 1e-3})),
    ]);
    scene.as_object_mut().unwrap().remove("cage");
    scene
}

/// The same with contacts between neighbours, by the laws of pockets.
fn neighbours(scene: &Value) -> Value {
    let contact = example_with(&[])["cage"]["pocket"]["lubricated_cylinder"]["contact"].clone();
    with(scene, &[("rollers.neighbours", json!({ "contact": contact }))])
}

#[test]
fn rollers_that_nothing_keeps_apart_do_not_go_through_each_other() {
    let mut free = sim(&without_cage());
    let error = free.advance_to(1.0).unwrap_err();
    assert!(error.message.contains("go through each other"), "{error}");
    assert!(free.time() > 1e-3 && free.time() < 0.64);
    assert!(free.statistics().faults[FAULTS.iter().position(|name| *name == "overlap").unwrap()] > 0);
    free.power_balance().unwrap();
}

#[test]
fn neighbours_that_touch_keep_the_ring_in_the_bearing() {
    let mut full = sim(&neighbours(&without_cage()));
    let clearance = channel(&full, "inner_ring.z");
    let mut outputs = vec![0.0; full.model().channels().len()];
    for k in 1..=20 {
        full.advance_to(0.01 * f64::from(k)).unwrap();
        full.outputs(&mut outputs).unwrap();
        assert!(outputs[clearance].abs() < 20e-6, "{} m", outputs[clearance]);
    }
    full.trust().unwrap();
    let balance = full.power_balance().unwrap();
    let work = |name: &str| balance.work[POWERS.iter().position(|power| *power == name).unwrap()];
    assert!(work("neighbour_damping") < 0.0 && work("neighbour_friction") < 0.0, "{balance:?}");
}

/// Twelve rollers that fill the bearing, some of them pressed together, in disordered motion.
fn pressed(seed: u64) -> (Sim, Vec<f64>) {
    let full = neighbours(&with(
        &without_cage(),
        &[
            ("rollers.count", json!(16)),
            ("rollers.radius_deviations", json!({"groups": [{"rollers": [3], "deviation": 2e-6}]})),
        ],
    ));
    let sim = sim(&full);
    let mut random = Random::new(seed);
    let model = sim.model().clone();
    let mut state = sim.state().to_vec();
    let names: Vec<String> = model.state_infos().into_iter().map(|info| info.name).collect();
    // Every second gap is closed by a few micrometres.
    let radius = model.pitch_radius();
    let gap = 2.0 * radius * (std::f64::consts::PI / 16.0).sin() - 9e-3;
    for (name, x) in names.iter().zip(&mut state) {
        let j: usize = name.split(['[', ']']).nth(1).and_then(|j| j.parse().ok()).unwrap_or(0);
        let noise = random.around_zero(1.0);
        match name.rsplit('.').next().unwrap() {
            "orbit_travel" => {
                *x += (if j.is_multiple_of(2) { 0.5 } else { -0.5 }) * (gap + 3e-6 + 1e-6 * noise) / radius
            }
            "radial_offset" => *x += 1e-6 * noise,
            "radial_speed" => *x += 0.05 * noise,
            "orbit_speed" => *x += 0.5 * noise,
            "spin_speed" => *x += 10.0 * noise,
            _ => {}
        }
    }
    (sim, state)
}

#[test]
fn neighbours_push_each_other_equally() {
    for seed in 1..6 {
        let (mut sim, state) = pressed(seed);
        sim.set_state(0.0, &state).unwrap();
        let names = sim.model().contact_names();
        let forces = sim.forces().unwrap();
        let of = |j: usize, side: &str| {
            let place =
                names.iter().position(|name| *name == format!("roller[{j}].neighbour_{side}")).unwrap();
            forces.contacts[place]
        };
        let mut touching = 0;
        for j in 0..16 {
            let (ahead, behind) = (of(j, "ahead"), of((j + 1) % 16, "behind"));
            // Normal force, approach and friction by their size; friction is along opposite tangents.
            for k in [0, 1, 6] {
                assert!(
                    (ahead[k] - behind[k]).abs() < 1e-9 * ahead[k].abs() + 1e-12,
                    "{j} {k}: {ahead:?}\n{behind:?}"
                );
            }
            touching += usize::from(ahead[0] > 0.0);
        }
        assert!(touching >= 7, "{touching}");
    }
}

#[test]
fn derivatives_of_neighbours_are_exact() {
    for seed in 1..4 {
        let (mut sim, state) = pressed(seed);
        let n = state.len();
        let mut exact = vec![0.0; n * n];
        sim.jacobian(0.0, &state, &mut exact).unwrap();
        let pattern = sim.model().jacobian_pattern();
        let mut values = vec![0.0; pattern.rows.len()];
        sim.sparse_jacobian(0.0, &state, &pattern, &mut values).unwrap();
        let mut filled = vec![0.0; n * n];
        for column in 0..n {
            for k in pattern.column_starts[column]..pattern.column_starts[column + 1] {
                filled[column * n + pattern.rows[k]] = values[k];
            }
        }
        assert_eq!(filled, exact);
        let infos = sim.model().state_infos();
        let (mut low, mut high) = (vec![0.0; n], vec![0.0; n]);
        for column in 0..n {
            let step = match infos[column].unit {
                "m" => 1e-12,
                "rad" => 1e-10,
                "m/s" => 1e-7,
                _ => 1e-5,
            };
            let mut moved = state.clone();
            moved[column] = state[column] - step;
            sim.derivative(0.0, &moved, &mut low).unwrap();
            moved[column] = state[column] + step;
            sim.derivative(0.0, &moved, &mut high).unwrap();
            let width = moved[column] - (state[column] - step);
            let largest = (0..n).fold(0.0f64, |a, row| a.max(exact[column * n + row].abs()));
            for row in 0..n {
                let difference = (high[row] - low[row]) / width;
                let error = (difference - exact[column * n + row]).abs();
                assert!(
                    error < 2e-4 * largest + 1e-3,
                    "{seed} {} over {}: {difference:e} {:e}",
                    infos[row].name,
                    infos[column].name,
                    exact[column * n + row]
                );
            }
        }
    }
}

/// Full of rollers, all methods agree where chaos has not set in.
#[test]
fn methods_agree_on_neighbours() {
    let (sim_, state) = pressed(7);
    let scene: Value = serde_json::to_value(sim_.model().scene()).unwrap();
    let at = |method: Value| {
        let mut sim = sim(&with(&scene, &[("solver", method.clone())]));
        sim.set_state(0.0, &state).unwrap();
        sim.advance_to(2e-4).unwrap();
        sim.trust().unwrap_or_else(|e| panic!("{method}: {e}"));
        sim.state().to_vec()
    };
    let reference = at(json!({"method": {"radau": {"tolerance": 1e-9}}}));
    let controlled = ["rosenbrock", "dormand_prince", "auto"].map(|method| json!({method: {}}));
    // Rollers this light want shorter steps of the leapfrog than its own, which would not be trusted.
    for method in controlled.into_iter().chain([json!({"leapfrog": {"step": 2e-7}})]) {
        let other = at(json!({ "method": method }));
        let infos = sim_.model().state_infos();
        for ((a, b), info) in reference.iter().zip(&other).zip(&infos) {
            let allowed = match info.unit {
                "m" => 3e-7,
                "rad" => 1e-5,
                "m/s" => 0.05,
                _ => 20.0,
            };
            assert!((a - b).abs() < allowed, "{method} {}: {a} {b}", info.name);
        }
    }
}

#[test]
fn a_ring_without_rollers_below_has_left_the_bearing() {
    let mut ring = sim(&example_with(&[]));
    let mut state = ring.state().to_vec();
    let z = ring.model().state_infos().iter().position(|info| info.name == "inner_ring.z").unwrap();
    state[z] = -0.9e-3;
    let error = ring.set_state(0.0, &state).and_then(|()| ring.advance_to(1e-4)).unwrap_err();
    assert!(error.message.contains("the inner ring has left the bearing"), "{error}");
    assert!(error.message.contains("7.9e-4 m"), "{error}");
}

#[test]
fn nothing_moves_faster_than_sound() {
    let mut fast = sim(&example_with(&[]));
    let mut state = fast.state().to_vec();
    let infos = fast.model().state_infos();
    let index = infos.iter().position(|info| info.name == "roller[3].spin_speed").unwrap();
    state[index] = 1e6;
    let error = fast.set_state(0.0, &state).and_then(|()| fast.advance_to(1e-4)).unwrap_err();
    assert!(error.message.contains("roller[3].spin_speed is too fast: 7.5e3 m/s"), "{error}");
}

/// A short bearing without squeeze is not passive: it throws a light cage of 17 g faster and faster.
#[test]
fn a_film_that_makes_energy_ends_the_run() {
    let scene: Value = serde_json::from_str(&read("scenes/ball_short_bearing.json")).unwrap();
    let light = [
        ("cage.mass", json!(0.017)),
        ("cage.inertia", json!(3.5e-5)),
        ("cage.guide.diametral_clearance", json!(0.111e-3)),
        ("cage.guide.film.short_bearing.land_width", json!(11.26e-3)),
        ("lubricant.viscosity.constant", json!(0.255)),
        ("initial.cage_speed", json!(50.27)),
    ];
    for preset in ["draft", "engineering", "reference"] {
        let solver = ("solver", json!({"preset": preset}));
        let mut passive = sim(&with(&with(&scene, &light), std::slice::from_ref(&solver)));
        passive.advance_to(20e-3).unwrap();
        passive.trust().unwrap();
        let without_squeeze = ("cage.guide.film.short_bearing.squeeze", json!(false));
        let mut active = sim(&with(&with(&scene, &light), &[solver, without_squeeze]));
        let error = active.advance_to(20e-3).unwrap_err();
        assert_eq!(error.status, Status::BadState, "{error}");
        assert!(error.message.contains("can make energy (cage.guide.film.short_bearing.squeeze)"), "{error}");
        assert!(active.time() > 0.5e-3 && active.time() < 5e-3, "{preset}: {error}");
        let doubt = active.trust().unwrap_err();
        assert!(doubt.message.contains("was made by the film of the guide"), "{doubt}");
    }
}

/// Where the kinematic speed passes zero, slip says what motion gives and no more.
#[test]
fn slip_is_bounded_where_the_ring_reverses() {
    let ramp = json!({"ramp": {"from": -100.0, "to": 100.0, "start": 0.0, "end": 20e-3}});
    let mut sim = sim(&example_with(&[("inner_ring.speed", ramp)]));
    let slips: Vec<usize> = (0..12)
        .map(|j| channel(&sim, &format!("roller[{j}].slip")))
        .chain([channel(&sim, "cage.slip")])
        .collect();
    let (mut outputs, mut largest) = (vec![0.0; sim.model().channels().len()], 0.0f64);
    for k in 1..=200 {
        sim.advance_to(1e-4 * f64::from(k)).unwrap();
        sim.outputs(&mut outputs).unwrap();
        largest = slips.iter().fold(largest, |largest, i| largest.max(outputs[*i].abs()));
    }
    assert!(largest > 0.9 && largest <= 2.0, "{largest}");
}
