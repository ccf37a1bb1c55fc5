//! Symmetries of the forces of a whole bearing at any state: turning and mirroring.

use crate::common::bench::{Bearing, Roller, STATES_PER_SCENE, State, scenes};
use crate::common::reports::{CAGE, NORMAL, largest_force};
use crate::common::{Random, set, with};
use cagedyn::model::{FORCE_SOURCES, Forces};
use serde_json::{Value, json};
use std::f64::consts::PI;

impl State {
    /// Turned by `angle` about the bearing axis. Travel and cage angle count from the start, so they stay; the scene
    /// turns the first roller, the roundness, gravity and load.
    fn turned(&self, angle: f64) -> Self {
        let mut s = self.clone();
        let turn = |v: &mut [f64]| {
            let (sin, cos) = angle.sin_cos();
            (v[0], v[1]) = (v[0] * cos - v[1] * sin, v[0] * sin + v[1] * cos);
        };
        turn(&mut s.ring);
        turn(&mut s.ring_velocity);
        turn(&mut s.cage);
        turn(&mut s.cage_velocity);
        s
    }

    /// Mirrored, y to -y. Roller `j` becomes roller `n - j`.
    fn mirrored(&self) -> Self {
        let n = self.rollers.len();
        let flip = |v: [f64; 2]| [-v[0], v[1]];
        let flip_turn = |v: [f64; 3]| [-v[0], v[1], -v[2]];
        let roller = |j: usize| {
            let r = self.rollers[(n - j) % n];
            Roller { travel: -r.travel, orbit_speed: -r.orbit_speed, spin: -r.spin, ..r }
        };
        Self {
            ring: flip(self.ring),
            ring_velocity: flip(self.ring_velocity),
            cage: flip_turn(self.cage),
            cage_velocity: flip_turn(self.cage_velocity),
            rollers: (0..n).map(roller).collect(),
        }
    }
}

/// Distance from first touch in the pocket that symmetry is judged at, m.
const AWAY_FROM_ONSET: f64 = 2e-7;

/// Compares two force reports body by body after `map` has been applied to the forces of the first.
fn assert_same_forces(
    what: &str,
    tolerance: f64,
    pitch: f64,
    (expected, map): (&Forces, impl Fn([f64; 3]) -> [f64; 3]),
    (found, body_of): (&Forces, impl Fn(usize) -> usize),
) {
    let largest = largest_force(expected);
    for (i, body) in expected.bodies.iter().enumerate() {
        for source in 0..FORCE_SOURCES.len() {
            let (wanted, got) = (map(body[source]), found.bodies[body_of(i)][source]);
            let force = (wanted[0] - got[0]).hypot(wanted[1] - got[1]);
            let moment = (wanted[2] - got[2]).abs();
            assert!(
                force <= tolerance * largest && moment <= tolerance * largest * pitch,
                "{what}: {} on body {i}: {wanted:?} wanted, {got:?} found; {force:e} N of {largest} N",
                FORCE_SOURCES[source]
            );
        }
    }
}

fn number(scene: &Value, pointer: &str) -> f64 {
    scene.pointer(pointer).and_then(Value::as_f64).unwrap()
}

/// Changes that turn a scene by an angle.
fn turned_scene(scene: &Value, angle: f64) -> Vec<(&'static str, Value)> {
    let (sin, cos) = angle.sin_cos();
    let turn = |y: &str, z: &str| {
        let (y, z) = (number(scene, y), number(scene, z));
        [json!(y * cos - z * sin), json!(y * sin + z * cos)]
    };
    let load = "/inner_ring/motion/free/load";
    let [gravity_y, gravity_z] = turn("/gravity/y", "/gravity/z");
    let [load_y, load_z] = turn(&format!("{load}/y/constant"), &format!("{load}/z/constant"));
    let first = number(scene, "/initial/first_roller_angle") + angle;
    let mut roundness = scene["cage"]["guide"]["roundness"].clone();
    for harmonic in roundness.as_array_mut().into_iter().flatten() {
        // cos(n (th - angle - psi) + b)
        harmonic["phase"] = json!(number(harmonic, "/phase") - number(harmonic, "/order") * angle);
    }
    vec![
        ("initial.first_roller_angle", json!(first)),
        ("cage.guide.roundness", if roundness.is_null() { json!([]) } else { roundness }),
        ("gravity.y", gravity_y),
        ("gravity.z", gravity_z),
        ("inner_ring.motion.free.load.y.constant", load_y),
        ("inner_ring.motion.free.load.z.constant", load_z),
    ]
}

#[test]
fn a_turned_bearing_has_turned_forces() {
    for angle in [0.3, -1.234, 0.8125] {
        let (sin, cos) = f64::sin_cos(angle);
        let turn = |[y, z, m]: [f64; 3]| [y * cos - z * sin, y * sin + z * cos, m];
        for (i, (name, scene)) in scenes().into_iter().enumerate() {
            let mut plain = Bearing::new(with(&scene, &[("initial.first_roller_angle", json!(-PI))]));
            let mut turned = plain.changed(&turned_scene(&plain.scene, angle));
            let mut random = Random::new(3 + i as u64);
            for _ in 0..STATES_PER_SCENE / 3 {
                let state = State::random(&plain, &mut random);
                let (expected, found) = (plain.forces(&state), turned.forces(&state.turned(angle)));
                assert_same_forces(name, 1e-12, plain.pitch, (&expected, turn), (&found, |body| body));
            }
        }
    }
}

impl State {
    /// Seen from axes that turn at `speed` (rad/s) the other way.
    fn carried(&self, speed: f64) -> Self {
        let mut s = self.clone();
        s.ring_velocity[0] -= speed * s.ring[1];
        s.ring_velocity[1] += speed * s.ring[0];
        s.cage_velocity[0] -= speed * s.cage[1];
        s.cage_velocity[1] += speed * s.cage[0];
        s.cage_velocity[2] += speed;
        for roller in &mut s.rollers {
            roller.orbit_speed += speed;
            roller.spin += speed;
        }
        s
    }
}

#[test]
fn contacts_know_nothing_of_a_rotation_of_the_whole() {
    // The support stands, and a film without squeeze takes the turning of its gap for rest.
    let relative = [
        ("inner_ring.motion.free.support_damping", Value::Null),
        ("cage.guide.film.short_bearing.squeeze", json!(true)),
    ];
    for (i, (name, scene)) in scenes().into_iter().enumerate() {
        let [inner, outer] = ["/inner_ring/speed/constant", "/outer_ring/speed/constant"]
            .map(|path| scene.pointer(path).and_then(Value::as_f64).unwrap_or(0.0));
        let mut plain = Bearing::new(with(&scene, &relative));
        for speed in [140.0, -55.0] {
            let mut carried = plain.changed(&[
                ("inner_ring.speed.constant", json!(inner + speed)),
                ("outer_ring.speed", json!({"constant": outer + speed})),
            ]);
            let mut random = Random::new(6 + i as u64);
            for _ in 0..STATES_PER_SCENE / 3 {
                let state = State::random_beyond(AWAY_FROM_ONSET, &plain, &mut random);
                let (expected, found) = (plain.forces(&state), carried.forces(&state.carried(speed)));
                assert_same_forces(name, 1e-10, plain.pitch, (&expected, |f| f), (&found, |body| body));
            }
        }
    }
}

#[test]
fn turning_the_first_roller_is_turning_the_cage() {
    let angle = 0.8125;
    for (i, (name, scene)) in scenes().into_iter().enumerate() {
        // The profile of the cage turns with its angle, not with the first roller.
        let mut plain = Bearing::new(with(
            &scene,
            &[("cage.guide.roundness", json!([])), ("initial.first_roller_angle", json!(-PI))],
        ));
        let first = json!(plain.first_angle + angle);
        let mut turned = plain.changed(&[("initial.first_roller_angle", first)]);
        let mut random = Random::new(4 + i as u64);
        for _ in 0..STATES_PER_SCENE / 3 {
            let state = State::random_beyond(AWAY_FROM_ONSET, &plain, &mut random);
            let mut same = state.clone();
            same.cage[2] -= angle;
            same.rollers.iter_mut().for_each(|r| r.travel -= angle);
            let (expected, found) = (plain.forces(&state), turned.forces(&same));
            assert_same_forces(name, 1e-11, plain.pitch, (&expected, |f| f), (&found, |body| body));
        }
    }
}

#[test]
fn a_mirrored_bearing_has_mirrored_forces() {
    for (i, (name, scene)) in scenes().into_iter().enumerate() {
        let mut plain = Bearing::new(with(&scene, &[("initial.first_roller_angle", json!(0.0))]));
        let scene = &plain.scene;
        let load = "/inner_ring/motion/free/load/y/constant";
        let mut other = with(
            scene,
            &[
                ("gravity.y", json!(-number(scene, "/gravity/y"))),
                ("inner_ring.motion.free.load.y.constant", json!(-number(scene, load))),
                ("inner_ring.speed.constant", json!(-number(scene, "/inner_ring/speed/constant"))),
                ("initial.first_roller_angle", json!(-PI - plain.first_angle)),
            ],
        );
        if let Some(speed) = scene.pointer("/outer_ring/speed/constant").and_then(Value::as_f64) {
            set(&mut other, "outer_ring.speed.constant", json!(-speed));
        }
        if let Some(list) = scene.pointer("/cage/guide/roundness").and_then(Value::as_array) {
            // cos(n (pi - th - psi) + b) = cos(n (th + psi) - b - n pi)
            for (k, harmonic) in list.iter().enumerate() {
                let phase = -number(harmonic, "/phase") - number(harmonic, "/order") * PI;
                set(&mut other, &format!("cage.guide.roundness.{k}.phase"), json!(phase));
            }
        }
        let mut mirrored = Bearing::new(other);
        let n = plain.count();
        let body_of = |i: usize| if i <= CAGE { i } else { CAGE + 1 + (n - (i - CAGE - 1)) % n };
        let mut random = Random::new(5 + i as u64);
        for _ in 0..STATES_PER_SCENE {
            let state = State::random(&plain, &mut random);
            let (expected, found) = (plain.forces(&state), mirrored.forces(&state.mirrored()));
            let flip = |[y, z, m]: [f64; 3]| [-y, z, -m];
            assert_same_forces(name, 1e-12, plain.pitch, (&expected, flip), (&found, body_of));
            for j in 0..n {
                let contacts = |f: &Forces, j: usize| f.contacts[4 * j..4 * j + 4].to_vec();
                let (a, b) = (contacts(&expected, j), contacts(&found, (n - j) % n));
                for (k, l) in [(0, 0), (1, 1), (2, 3), (3, 2)] {
                    let error = (a[k][NORMAL] - b[l][NORMAL]).abs();
                    assert!(error <= 1e-12 * largest_force(&expected), "{name}: roller {j}, contact {k}");
                }
            }
        }
    }
}
