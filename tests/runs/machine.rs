//! Bearings in their machine: rings that hosts move, rings on supports, unbalance, rotors on elastic shafts.

use crate::common::{example_with, read, with};
use cagedyn::model::POWERS;
use cagedyn::{Model, Sim, Status};
use nalgebra::Vector2;
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::sync::Arc;

const NORMAL: usize = 0;

fn sim(scene: &Value) -> Sim {
    Sim::new(Arc::new(Model::from_json(&scene.to_string()).unwrap_or_else(|e| panic!("{e}")))).unwrap()
}

fn input(sim: &Sim, name: &str) -> usize {
    sim.model().input_infos().iter().position(|info| info.name == name).unwrap_or_else(|| panic!("{name}"))
}

fn state_place(sim: &Sim, name: &str) -> usize {
    sim.model().state_infos().iter().position(|info| info.name == name).unwrap()
}

fn output(sim: &mut Sim, name: &str) -> f64 {
    let place = sim.channels().iter().position(|c| c.name == name).unwrap_or_else(|| panic!("{name}"));
    sim.output(place).unwrap()
}

fn work(sim: &Sim, name: &str) -> f64 {
    sim.works()[POWERS.iter().position(|power| *power == name).unwrap()]
}

fn support() -> Value {
    json!({
        "stiffness": {"yy": 3e8, "yz": 4e7, "zy": -2e7, "zz": 6e8},
        "damping": {"yy": 3e3, "yz": -200.0, "zy": 500.0, "zz": 9e3},
        "mass": {"yy": 0.4, "yz": 0.2, "zy": 0.2, "zz": 1.1}
    })
}

fn prescribed(y: Value, z: Value) -> Value {
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

/// A rigid rotor on two bearings, with its ends as coordinates.
struct RigidRotor {
    /// Own and other mass of the ends, kg.
    masses: [f64; 2],
    unbalance: [[f64; 2]; 2],
    speed: f64,
    /// Of each end to the ground, N s/m.
    damping: f64,
}

impl RigidRotor {
    const MASS: f64 = 50.0;
    const GRAVITY: f64 = -9.80665;
    /// Load of each end, N: without it the ends wander in their clearance, and no two runs stay together.
    const LOAD: f64 = -4900.0;

    fn new() -> Self {
        let (inertia, span) = (1.2, 0.4);
        let [mean, turning] = [Self::MASS / 4.0, inertia / (span * span)];
        Self {
            masses: [mean + turning, mean - turning],
            unbalance: [[2e-2, 0.0], [1e-2, 1.5]],
            speed: -314.159,
            damping: 6e3,
        }
    }

    /// Forces of weight and unbalance at an end, N.
    fn outer(&self, end: usize, t: f64) -> [f64; 2] {
        let [moment, phase] = self.unbalance[end];
        let (sin, cos) = (self.speed * t + phase).sin_cos();
        let size = moment * self.speed * self.speed;
        [size * cos, size * sin + 0.5 * Self::MASS * Self::GRAVITY + Self::LOAD]
    }

    /// Accelerations of both ends under these forces of the bearings, at these velocities.
    fn accelerations(&self, forces: [[f64; 2]; 2], v: [[f64; 2]; 2], t: f64) -> [[f64; 2]; 2] {
        let [own, other] = self.masses;
        let scale = 1.0 / (own * own - other * other);
        let total: [[f64; 2]; 2] = std::array::from_fn(|i| {
            std::array::from_fn(|k| forces[i][k] + self.outer(i, t)[k] - self.damping * v[i][k])
        });
        std::array::from_fn(|i| {
            std::array::from_fn(|k| scale * (own * total[i][k] - other * total[1 - i][k]))
        })
    }
}

fn bearing_of_rotor(motion: Value) -> Sim {
    sim(&example_with(&[
        ("inner_ring.speed", json!({"constant": RigidRotor::new().speed})),
        ("inner_ring.motion", motion),
        ("initial", json!({"inner_ring": "equilibrium"})),
    ]))
}

const FORCES: [&str; 2] = ["inner_ring.force_y", "inner_ring.force_z"];
const ENDS: [&str; 2] = ["inner_ring.y", "inner_ring.z"];
const CAGE: [&str; 2] = ["cage.y_ratio", "cage.z_ratio"];

/// Values of two channels.
fn two(sim: &mut Sim, names: [&str; 2]) -> [f64; 2] {
    names.map(|name| output(sim, name))
}

/// Places of both ends at every 0.1 ms, from a host that owns the rings.
fn owned(duration: f64) -> (Vec<[f64; 6]>, u64) {
    let (rotor, h) = (RigidRotor::new(), 1e-4);
    let start = two(&mut monolithic_bearing(), ENDS);
    let mut ends: [Sim; 2] =
        std::array::from_fn(|_| bearing_of_rotor(prescribed(json!(start[0]), json!(start[1]))));
    let rates = ["inner_ring.vy", "inner_ring.vz"].map(|name| input(&ends[0], name));
    let (mut places, mut v, mut t) = (Vec::new(), [[0.0; 2]; 2], 0.0);
    let forces =
        |ends: &mut [Sim; 2]| -> [[f64; 2]; 2] { std::array::from_fn(|i| two(&mut ends[i], FORCES)) };
    let mut a = rotor.accelerations(forces(&mut ends), v, t);
    for n in 1..=(duration / h).round() as u32 {
        for (i, end) in ends.iter_mut().enumerate() {
            for k in 0..2 {
                end.set_input_slope(rates[k], v[i][k], a[i][k]).unwrap();
            }
            end.advance_to(f64::from(n) * h).unwrap();
        }
        t = f64::from(n) * h;
        let (before, by_bearings) = (v, forces(&mut ends));
        let mut next = a;
        // The damping is that of the velocity which it leads to.
        for _ in 0..4 {
            v = std::array::from_fn(|i| {
                std::array::from_fn(|k| before[i][k] + 0.5 * h * (a[i][k] + next[i][k]))
            });
            next = rotor.accelerations(by_bearings, v, t);
        }
        a = next;
        let [[y0, z0], [y1, z1]] = std::array::from_fn(|i| two(&mut ends[i], ENDS));
        let [cage_y, cage_z] = two(&mut ends[0], CAGE);
        places.push([y0, z0, y1, z1, cage_y, cage_z]);
    }
    (places, ends[0].statistics().evaluations)
}

fn monolithic_bearing() -> Sim {
    let (own, damping) = (RigidRotor::new().masses[0], RigidRotor::new().damping);
    // The weight of the ring in the scene is that of its own mass.
    let rest = (0.5 * RigidRotor::MASS - own) * RigidRotor::GRAVITY + RigidRotor::LOAD;
    let load = json!({"y": {"constant": 0.0}, "z": {"constant": rest}});
    bearing_of_rotor(json!({"free": {"mass": own, "load": load, "support_damping": damping}}))
}

/// The same from rings that are free, each with its own mass, and whatever else acts on them set as loads every microsecond.
fn loaded(duration: f64) -> (Vec<[f64; 6]>, u64) {
    let (rotor, h) = (RigidRotor::new(), 1e-6);
    let mut ends: [Sim; 2] = std::array::from_fn(|_| monolithic_bearing());
    let loads = ["load.y", "load.z"].map(|name| input(&ends[0], name));
    let rates = ["inner_ring.vy", "inner_ring.vz"].map(|name| state_place(&ends[0], name));
    let [own, other] = rotor.masses;
    let mut places = Vec::new();
    for n in 0..(duration / h).round() as u32 {
        let t = f64::from(n) * h;
        let forces = std::array::from_fn(|i| two(&mut ends[i], FORCES));
        let v = std::array::from_fn(|i| rates.map(|place| ends[i].state()[place]));
        let a = rotor.accelerations(forces, v, t);
        for (i, end) in ends.iter_mut().enumerate() {
            let outer = rotor.outer(i, t + 0.5 * h);
            let weight = [0.0, own * RigidRotor::GRAVITY];
            for k in 0..2 {
                end.set_input(loads[k], outer[k] - other * a[1 - i][k] - weight[k]).unwrap();
            }
            end.advance_to(t + h).unwrap();
        }
        if (n + 1) % 100 == 0 {
            let [[y0, z0], [y1, z1]] = std::array::from_fn(|i| two(&mut ends[i], ENDS));
            let [cage_y, cage_z] = two(&mut ends[0], CAGE);
            places.push([y0, z0, y1, z1, cage_y, cage_z]);
        }
    }
    (places, ends[0].statistics().evaluations)
}

/// Cosine and sine of a coordinate once per revolution, over two revolutions at every 0.1 ms.
fn synchronous(places: &[[f64; 6]], k: usize) -> Vector2<f64> {
    let turn = TAU / 200.0;
    let places = &places[places.len() - 400..];
    let sum = places.iter().enumerate().map(|(n, x)| {
        let (sin, cos) = (turn * n as f64).sin_cos();
        Vector2::new(cos, sin) * x[k]
    });
    sum.sum::<Vector2<f64>>() / 200.0
}

/// Orbits of a rotor of 50 kg on two bearings: by a host that owns the rings in steps of 0.1 ms, and by loads at every microsecond.
#[test]
fn a_host_owns_the_rings_of_a_rotor() {
    const DURATION: f64 = 0.08;
    let (owned, evaluations) = owned(DURATION);
    let (loaded, _) = loaded(DURATION);
    let mut free = monolithic_bearing();
    free.advance_to(DURATION).unwrap();
    let ratio = evaluations as f64 / free.statistics().evaluations as f64;
    // What goes round with the rotor: rollers pass at other times in both, as cages are not reproducible.
    let mut worst = 0.0f64;
    for k in 0..4 {
        let [one, other] = [&loaded, &owned].map(|places| synchronous(places, k));
        worst = worst.max((one - other).norm() / one.norm());
    }
    let mean = |places: &[[f64; 6]], k: usize| places[400..].iter().map(|x| x[k]).sum::<f64>() / 400.0;
    let cages = [4, 5].map(|k| mean(&loaded, k) - mean(&owned, k));
    println!(
        "orbits {worst:.4} apart, {ratio:.2} of the evaluations of a free run, means of cages {cages:.3?}"
    );
    assert!(worst < 0.01, "{worst}");
    assert!(ratio < 1.5, "{ratio}");
    assert!(cages.iter().all(|apart| apart.abs() < 0.05), "{cages:?}");
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
    assert!((inner[0] - force).abs() < 1e-4 * force.abs(), "{inner:?} {force}");
    let error = sim.set_input(x, 0.2).unwrap_err();
    assert!(error.message.starts_with("value: 0.2 m"), "{error}");
}

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
    assert!(compared > 1000 && acting > 15, "{compared} {acting}");
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
    let text = sim.output_jacobian(t, &state, &mut over_states, &mut []).unwrap_err().message;
    assert!(text.starts_with("over_inputs"), "{text}");
    assert_eq!(sim.next_event(t), Ok(f64::INFINITY));
}
