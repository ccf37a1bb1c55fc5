//! Bearings in their machine: rings that hosts move, rings on supports, unbalance, rotors on elastic shafts.

use crate::common::{example_with, read, with};
use cagedyn::model::POWERS;
use cagedyn::{Model, Sim, Status};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::sync::Arc;

const NORMAL: usize = 0;

pub fn sim(scene: &Value) -> Sim {
    Sim::new(Arc::new(Model::from_json(&scene.to_string()).unwrap_or_else(|e| panic!("{e}")))).unwrap()
}

pub fn input(sim: &Sim, name: &str) -> usize {
    sim.model().input_infos().iter().position(|info| info.name == name).unwrap_or_else(|| panic!("{name}"))
}

pub fn state_place(sim: &Sim, name: &str) -> usize {
    sim.model().state_infos().iter().position(|info| info.name == name).unwrap()
}

pub fn output(sim: &mut Sim, name: &str) -> f64 {
    let place = sim.channels().iter().position(|c| c.name == name).unwrap_or_else(|| panic!("{name}"));
    sim.output(place).unwrap()
}

fn work(sim: &Sim, name: &str) -> f64 {
    sim.works()[POWERS.iter().position(|power| *power == name).unwrap()]
}

pub fn support() -> Value {
    json!({
        "stiffness": {"yy": 3e8, "yz": 4e7, "zy": -2e7, "zz": 6e8},
        "damping": {"yy": 3e3, "yz": -200.0, "zy": 500.0, "zz": 9e3},
        "mass": {"yy": 0.4, "yz": 0.2, "zy": 0.2, "zz": 1.1}
    })
}

pub fn prescribed(y: Value, z: Value) -> Value {
    json!({"prescribed": {"y": y, "z": z}})
}

fn sine(mean: f64, amplitude: f64, frequency: f64) -> Value {
    json!({"sine": {"mean": mean, "amplitude": amplitude, "frequency": frequency, "phase": 0.3}})
}

/// The example without gravity and cage, both rings held, one of them off the centre.
fn held(outer: [f64; 2], inner: [f64; 2]) -> Value {
    let at = |[y, z]: [f64; 2]| prescribed(json!({ "constant": y }), json!({ "constant": z }));
    example_with(&[
        ("gravity", Value::Null),
        ("cage", Value::Null),
        ("initial", json!({"inner_ring": "equilibrium"})),
        ("outer_ring.motion", at(outer)),
        ("inner_ring.motion", at(inner)),
        ("inner_ring.radial_clearance", json!(5e-6)),
    ])
}

/// What an outer ring at d and an inner one at the centre do to rollers is what rings at the centre and at -d do.
#[test]
fn only_the_distance_of_the_rings_matters() {
    let d = [7e-6, -12e-6];
    let (mut a, mut b) = (sim(&held(d, [0.0; 2])), sim(&held([0.0; 2], d.map(|x| -x))));
    let (pitch, first) = (a.model().pitch_radius(), state_place(&a, "roller[0].radial_offset"));
    // The same places of the rollers from the centre of the outer ring, at speeds that are none.
    let (mut here, mut there) = (a.state().to_vec(), b.state().to_vec());
    let count = a.model().element_count();
    let nq = a.model().layout().positions();
    for j in 0..count {
        let angle = TAU * j as f64 / count as f64;
        let (r, turned) = (pitch + here[first + 2 * j], angle + here[first + 2 * j + 1]);
        let [y, z] = [r * turned.cos() - d[0], r * turned.sin() - d[1]];
        there[first + 2 * j] = y.hypot(z) - pitch;
        let azimuth = z.atan2(y);
        there[first + 2 * j + 1] = (azimuth - angle + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0;
    }
    here[nq..].fill(0.0);
    there[nq..].fill(0.0);
    let (here, there) = (a.forces_at(0.0, &here).unwrap().clone(), b.forces_at(0.0, &there).unwrap().clone());
    let largest = here.contacts.iter().fold(0.0f64, |most, contact| most.max(contact[NORMAL]));
    assert!(largest > 500.0, "{largest}");
    for (a, b) in here.contacts.iter().zip(&there.contacts) {
        // Radii of 40 mm are known to 7e-18 m, stiffnesses are below 1e9 N/m.
        assert!((a[NORMAL] - b[NORMAL]).abs() < 1e-7, "{} {}", a[NORMAL], b[NORMAL]);
    }
}

/// Rings in rest at the start stay where they are: only what turns makes them move.
#[test]
fn rings_start_in_equilibrium_with_their_supports() {
    let load = json!({"y": {"constant": 300.0}, "z": {"constant": -900.0}});
    let free = |load: &Value| json!({"free": {"mass": 2.0, "support": support(), "load": load}});
    let loose =
        json!({"free": {"mass": 2.0, "load": {"y": {"constant": -200.0}, "z": {"constant": -4000.0}}}});
    let at = prescribed(json!({"constant": 4e-6}), json!({"constant": 25e-6}));
    let rotor = json!({"mass": 30.0, "shaft": {"stiffness": 5e7}, "load": load});
    let cases = [
        [free(&load), free(&load), Value::Null],
        [free(&load), loose.clone(), Value::Null],
        [free(&load), loose, rotor],
        [free(&load), at.clone(), Value::Null],
        [at, free(&load), Value::Null],
    ];
    for [outer, inner, rotor] in cases {
        let scene = example_with(&[
            ("inner_ring.speed", json!({"constant": 0.0})),
            ("outer_ring.motion", outer),
            ("inner_ring.motion", inner),
            ("rotor", rotor),
            ("initial", json!({"inner_ring": "equilibrium"})),
        ]);
        let mut sim = sim(&scene);
        let accelerations = sim.forces().unwrap().accelerations.clone();
        let nq = sim.model().layout().positions();
        let of_rings =
            sim.model().state_infos()[..nq].iter().position(|info| info.name.starts_with("cage")).unwrap();
        // Rollers and cage have their weight, of 100 g and 200 g.
        for (i, a) in accelerations[..of_rings].iter().enumerate() {
            assert!(a.abs() < 2.0, "{i}: {a} in {scene}");
        }
    }
}

/// Every kind of ring keeps its balance, with every method.
#[test]
fn moving_rings_keep_their_power_balance() {
    let unbalance = json!({"moment": 5e-4, "phase": 0.8});
    let load = json!({"y": {"constant": 0.0}, "z": {"constant": -2000.0}});
    let free = json!({"free": {"mass": 2.0, "support": support(), "load": load, "unbalance": unbalance}});
    let swinging = prescribed(sine(0.0, 6e-6, 120.0), sine(-24e-6, 5e-6, 90.0));
    let rotor = json!({
        "mass": 30.0, "shaft": {"stiffness": 5e7, "internal_damping": 300.0}, "damping": 100.0,
        "unbalance": unbalance, "load": {"y": {"constant": 100.0}, "z": {"constant": 0.0}}
    });
    let methods = [
        json!({"auto": {}}),
        json!({"dormand_prince": {}}),
        json!({"rosenbrock": {}}),
        json!({"leapfrog": {}}),
    ];
    for (outer, inner, rotor) in
        [(&free, &free, &rotor), (&Value::Null, &swinging, &Value::Null), (&swinging, &free, &Value::Null)]
    {
        for method in &methods {
            let scene = example_with(&[
                (
                    "inner_ring.speed",
                    json!({"ramp": {"from": -300.0, "to": -330.0, "start": 0.0, "end": 0.01}}),
                ),
                ("outer_ring.motion", outer.clone()),
                ("inner_ring.motion", inner.clone()),
                ("rotor", rotor.clone()),
                ("solver", json!({ "method": method })),
            ]);
            let mut sim = sim(&scene);
            sim.advance_to(4e-3).unwrap();
            let balance = sim.power_balance().unwrap();
            let (missing, passed) = (balance.relative_residual(), balance.throughput());
            assert!(missing.abs() < 1e-3 && passed > 0.05, "{method}: {missing:e} of {passed} J in {scene}");
        }
    }
}

/// A ring that a host moves by velocity and acceleration at each of its steps is one that the scene moves.
#[test]
fn a_host_moves_a_ring_as_a_scene_does() {
    const AMPLITUDE: f64 = 6e-6;
    let w = TAU * 120.0;
    let scene = |z: Value| example_with(&[("inner_ring.motion", prescribed(json!(0.0), z))]);
    let mut by_scene = sim(&scene(
        json!({"sine": {"mean": -24e-6, "amplitude": AMPLITUDE, "frequency": 120.0, "phase": 0.0}}),
    ));
    let mut by_host = sim(&scene(json!(-24e-6)));
    let rate = input(&by_host, "inner_ring.vz");
    let (steps, h) = (100, 1e-4);
    let mut apart = 0.0f64;
    for n in 0..steps {
        let t = f64::from(n) * h;
        let (v, a) = (AMPLITUDE * w * (w * t).cos(), -AMPLITUDE * w * w * (w * t).sin());
        by_host.set_input_slope(rate, v, a).unwrap();
        by_host.advance_to(t + h).unwrap();
        by_scene.advance_to(t + h).unwrap();
        apart =
            apart.max((output(&mut by_host, "inner_ring.z") - output(&mut by_scene, "inner_ring.z")).abs());
    }
    // A step leaves out A w^3 h^3/6.
    let bound = f64::from(steps) * AMPLITUDE * (w * h).powi(3) / 6.0;
    assert!(apart < bound, "{apart:e} {bound:e}");
    for sim in [&mut by_scene, &mut by_host] {
        assert_eq!(sim.trust(), Ok(()));
        let missing = sim.power_balance().unwrap().relative_residual();
        assert!(missing.abs() < 1e-3, "{missing:e}");
    }
    let evaluations = |sim: &Sim| sim.statistics().evaluations as f64;
    let ratio = evaluations(&by_host) / evaluations(&by_scene);
    assert!(ratio < 1.5, "{ratio}");
    let ([a, b], of) = (["inner_ring.force_z"; 2], f64::abs);
    let (host, own) = (output(&mut by_host, a), output(&mut by_scene, b));
    assert!(of(host - own) < 0.05 * of(own) + 200.0, "{host} {own}");
}

/// A place that jumps puts energy into the bearing, which is work of its drive; one out of the bearing is refused.
#[test]
fn places_that_jump_do_work_and_stay_in_the_bearing() {
    let scene = example_with(&[("inner_ring.motion", prescribed(json!(0.0), json!(-24e-6)))]);
    let mut sim = sim(&scene);
    sim.advance_to(1e-3).unwrap();
    let (place, before) = (input(&sim, "inner_ring.z"), work(&sim, "ring_drive"));
    let energy = |sim: &mut Sim| {
        let (t, state) = (sim.time(), sim.state().to_vec());
        sim.energy_at(t, &state).unwrap().total()
    };
    let stored = energy(&mut sim);
    sim.set_input(place, -30e-6).unwrap();
    let put = energy(&mut sim) - stored;
    assert!(put > 1e-4, "{put}");
    let worked = work(&sim, "ring_drive") - before;
    assert!((worked - put).abs() < 1e-9 * put.abs(), "{worked} {put}");
    let saved = sim.save();
    let error = sim.set_input(place, -4e-3).unwrap_err();
    assert_eq!(error.status, Status::BadValue);
    assert!(error.message.contains("value: the inner ring has left the bearing"), "{error}");
    let error = sim.set_input(place, -0.4).unwrap_err();
    assert!(error.message.starts_with("value: -0.4 m"), "{error}");
    let rate = input(&sim, "inner_ring.vz");
    let error = sim.set_input_slope(rate, 0.1, f64::NAN).unwrap_err();
    assert!(error.message.starts_with("slope: NaN"), "{error}");
    assert_eq!(saved, sim.save());
    // Slopes that lead out of it end the run at the last step that can be made.
    sim.set_input(rate, -2.0).unwrap();
    let error = sim.advance_to(2e-3).unwrap_err();
    assert!(error.message.contains("the inner ring has left the bearing"), "{error}");
    sim.set_input(rate, 2.0).unwrap();
    sim.advance_to(sim.time() + 2e-4).unwrap();
}

/// What a host lets go on is part of a snapshot, to the last bit.
#[test]
fn snapshots_have_inputs_that_go_on() {
    let scene = example_with(&[("inner_ring.motion", prescribed(json!(0.0), json!(-24e-6)))]);
    let mut sim = sim(&scene);
    let [rate, speed] = ["inner_ring.vy", "inner_ring.speed"].map(|name| input(&sim, name));
    sim.set_input_slope(rate, 1e-3, -2.0).unwrap();
    sim.set_input_slope(speed, -310.0, -4e3).unwrap();
    sim.advance_to(1.3e-3).unwrap();
    assert!((sim.input(speed).unwrap() + 310.0 + 5.2).abs() < 1e-9);
    let saved = sim.save();
    sim.advance_to(2.6e-3).unwrap();
    let (state, evaluations) = (sim.state().to_vec(), sim.statistics().evaluations);
    sim.restore(&saved).unwrap();
    sim.advance_to(2.6e-3).unwrap();
    assert_eq!((state, evaluations), (sim.state().to_vec(), sim.statistics().evaluations));
    sim.release_input(rate).unwrap();
    assert_eq!(sim.input(rate).unwrap(), 0.0);
}

/// A rotor on a shaft whose end is held: whirls with m e w^2/(k - m w^2), and is unstable above its critical speed where the shaft damps
/// more than the ground.
#[test]
fn a_rotor_on_a_shaft_is_that_of_jeffcott() {
    let (mass, stiffness, w) = (2.0f64, 2e5f64, 150.0f64);
    let grease: Value = serde_json::from_str(&read("scenes/grease_guide.json")).unwrap();
    let scene = |speed: f64, rotor: Value| {
        with(
            &grease,
            &[
                ("gravity", Value::Null),
                ("inner_ring.speed", json!({"constant": speed})),
                ("inner_ring.motion", json!({"fixed": {"y": 0.0, "z": 0.0}})),
                ("rotor", rotor),
                ("solver", json!({"method": {"dormand_prince": {"tolerance": 1e-8}}})),
                ("record.duration", json!(1.0)),
            ],
        )
    };
    let damping = 0.1 * (stiffness * mass).sqrt();
    let mut driven = sim(&scene(
        w,
        json!({
            "mass": mass, "shaft": {"stiffness": stiffness}, "damping": damping, "unbalance": {"moment": 1e-4, "phase": 0.4}
        }),
    ));
    driven.advance_to(0.6).unwrap();
    let radius = output(&mut driven, "rotor.y").hypot(output(&mut driven, "rotor.z"));
    let expected = 1e-4 * w * w / (stiffness - mass * w * w).hypot(damping * w);
    assert!((radius / expected - 1.0).abs() < 1e-3, "{radius:e} {expected:e}");
    // Growth (c_i (w/w_0 - 1) - c_e)/(2 m) of the forward whirl, for light damping.
    let natural = (stiffness / mass).sqrt();
    for speed in [0.5, 2.0] {
        let rotor = json!({
            "mass": mass, "shaft": {"stiffness": stiffness, "internal_damping": 40.0}, "damping": 8.0,
            "load": {"y": {"step": {"before": 10.0, "after": 0.0, "time": 0.01}}, "z": {"constant": 0.0}}
        });
        let mut sim = sim(&scene(speed * natural, rotor));
        let mut radius = |t: f64| {
            sim.advance_to(t).unwrap();
            let q = ["rotor.y", "rotor.z"].map(|name| output(&mut sim, name));
            let (y, z) = (state_place(&sim, "rotor.vy"), state_place(&sim, "rotor.vz"));
            let v = [sim.state()[y] / natural, sim.state()[z] / natural];
            // Amplitude of the forward whirl.
            0.5 * (q[0] + v[1]).hypot(q[1] - v[0])
        };
        let (from, to) = (0.2, 0.4);
        let [first, last] = [from, to].map(&mut radius);
        let growth = (last / first).ln() / (to - from);
        let expected = (40.0 * (speed - 1.0) - 8.0) / (2.0 * mass);
        assert!((growth - expected).abs() < 0.05 * expected.abs(), "{speed}: {growth} {expected}");
    }
}

/// A host moves a ring in space along the axis and tilts it, and has the force and moment of the bearing back: those that a free ring has
/// in equilibrium.
#[test]
fn a_host_moves_a_ring_in_space() {
    let text: Value = serde_json::from_str(&read("scenes/angular_contact_70.json")).unwrap();
    let coordinate = |value: f64| json!({"prescribed": {"constant": value}});
    let scene = with(
        &text,
        &[
            ("inner_ring.motion.space.x", coordinate(0.0)),
            ("inner_ring.motion.space.tilt_y", coordinate(0.0)),
        ],
    );
    let mut sim = sim(&scene);
    let [x, vx, tilting] =
        ["inner_ring.x", "inner_ring.vx", "inner_ring.tilt_speed_y"].map(|name| input(&sim, name));
    // Pressed in by 20 um and tilted by 0.2 mrad within 2 ms.
    sim.set_input(vx, 20e-6 / 2e-3).unwrap();
    sim.set_input(tilting, 2e-4 / 2e-3).unwrap();
    sim.advance_to(2e-3).unwrap();
    sim.set_input(vx, 0.0).unwrap();
    sim.set_input(tilting, 0.0).unwrap();
    sim.advance_to(5e-3).unwrap();
    assert!((sim.input(x).unwrap() - 20e-6).abs() < 1e-12);
    assert_eq!(sim.trust(), Ok(()));
    let missing = sim.power_balance().unwrap().relative_residual();
    assert!(missing.abs() < 1e-3, "{missing:e}");
    // The bearing pushes back, against both.
    let (force, moment) = (output(&mut sim, "inner_ring.force_x"), output(&mut sim, "inner_ring.moment_y"));
    assert!(force < -50.0 && moment < -0.01, "{force} {moment}");
    let inner: [f64; 6] = sim.forces().unwrap().space.bodies[1]
        .iter()
        .take(2)
        .fold([0.0; 6], |sum, force| std::array::from_fn(|k| sum[k] + force[k]));
    // The output is that of the step, with its share of the damping.
    assert!((inner[0] - force).abs() < 1e-5 * force.abs(), "{inner:?} {force}");
    let error = sim.set_input(x, 0.2).unwrap_err();
    assert!(error.message.starts_with("value: 0.2 m"), "{error}");
}
