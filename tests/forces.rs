//! Properties that the forces of a whole bearing must have at any state: balance, equations of motion, symmetry,
//! independence of effects, continuity and static equilibrium.

mod common;

use cagedyn::model::{BodyForces, FORCE_SOURCES, Forces};
use cagedyn::{Model, Scene, Sim};
use common::{Random, example, example_with, set, with};
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

// Sources of forces, in the order of FORCE_SOURCES.
const OUTER: usize = 0;
const INNER: usize = 1;
const POCKET: usize = 2;
const GUIDE: usize = 3;
const GRAVITY: usize = 4;
const LOAD: usize = 5;
const SUPPORT: usize = 6;

// Quantities of a contact, in the order of CONTACT_QUANTITIES.
const NORMAL: usize = 0;
const APPROACH: usize = 1;
const FILM: usize = 2;
const FILM_RATIO: usize = 3;
const TEMPERATURE: usize = 4;
const FRICTION: usize = 6;
const ROLLING: usize = 7;
const SLIP_SPEED: usize = 10;
const ROLLING_SPEED: usize = 11;

// Bodies in force reports; the cage comes before the rollers.
const INNER_RING: usize = 1;
const CAGE: usize = 2;

#[test]
fn sources_have_the_expected_names() {
    let names = ["outer_raceway", "inner_raceway", "pocket", "guide", "gravity", "load", "support"];
    assert_eq!(FORCE_SOURCES, names);
}

/// A scene with its simulation and the lengths that states are built from.
struct Bearing {
    scene: Value,
    sim: Sim,
    pitch: f64,
    roller_radius: f64,
    gap: f64,
    first_angle: f64,
    pocket: [f64; 2],
    guide: f64,
}

impl Bearing {
    fn new(scene: Value) -> Self {
        let checked = Scene::from_value(scene.clone()).unwrap_or_else(|e| panic!("{e}"));
        let sim = Sim::new(Arc::new(Model::new(checked.clone()).unwrap())).unwrap_or_else(|e| panic!("{e}"));
        let pocket = checked.cage.as_ref().and_then(|c| c.pocket.as_ref());
        Self {
            pitch: sim.model().pitch_radius(),
            guide: sim.model().guide_clearance().unwrap_or(0.0),
            roller_radius: checked.rollers.radius,
            gap: checked.inner_ring.radial_clearance / 4.0,
            first_angle: checked.initial.first_roller_angle,
            pocket: pocket.map_or([1.0, 1.0], |p| [p.radial_clearance, p.half_angle]),
            scene,
            sim,
        }
    }

    fn changed(&self, changes: &[(&str, Value)]) -> Self {
        Self::new(with(&self.scene, changes))
    }

    fn count(&self) -> usize {
        self.sim.model().layout().count
    }

    fn forces(&mut self, state: &State) -> Forces {
        let vector = state.vector();
        self.sim.set_state(0.0, &vector).unwrap_or_else(|e| panic!("{e}: {state:?}"));
        self.sim.forces().unwrap_or_else(|e| panic!("{e}: {state:?}")).clone()
    }

    /// Approach of a roller at (radially outwards, towards the pillar) in its pocket to that pillar, m.
    fn pocket_approach(&self, radial: f64, towards: f64) -> f64 {
        let [clearance, half_angle] = self.pocket;
        if radial.atan2(towards).abs() <= half_angle {
            radial.hypot(towards) - clearance
        } else {
            let wall = self.roller_radius + clearance;
            let edge = [wall * half_angle.sin() * radial.signum(), wall * half_angle.cos()];
            self.roller_radius - (edge[0] - radial).hypot(edge[1] - towards)
        }
    }

    /// Circumferential position at which a roller at `radial` has the given approach to a pillar; zero if it is
    /// deeper everywhere.
    fn towards_for(&self, radial: f64, approach: f64) -> f64 {
        let (mut low, mut high) = (0.0, 2.0 * self.pocket[0] + approach.abs());
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.pocket_approach(radial, middle) > approach { high = middle } else { low = middle }
        }
        low
    }
}

/// A state by bodies.
#[derive(Clone, Debug)]
struct State {
    ring: [f64; 2],
    ring_velocity: [f64; 2],
    cage: [f64; 3],
    cage_velocity: [f64; 3],
    rollers: Vec<Roller>,
}

#[derive(Clone, Copy, Debug)]
struct Roller {
    offset: f64,
    angle: f64,
    radial_speed: f64,
    orbit_speed: f64,
    spin: f64,
}

impl State {
    fn vector(&self) -> Vec<f64> {
        let mut x = Vec::new();
        x.extend(self.ring);
        x.extend(self.cage);
        x.extend(self.rollers.iter().flat_map(|r| [r.offset, r.angle]));
        x.extend(self.ring_velocity);
        x.extend(self.cage_velocity);
        x.extend(self.rollers.iter().flat_map(|r| [r.radial_speed, r.orbit_speed]));
        x.extend(self.rollers.iter().map(|r| r.spin));
        x
    }

    /// Everything at rest relative to kinematic motion, rollers on the pitch circle in the centres of their pockets.
    fn kinematic(b: &Bearing) -> Self {
        let model = b.sim.model();
        let speed = model.inputs_at(0.0, &Default::default()).ring_speed;
        let n = b.count();
        let roller = |j: usize| Roller {
            offset: 0.0,
            angle: b.first_angle + TAU * j as f64 / n as f64,
            radial_speed: 0.0,
            orbit_speed: model.orbit_ratio() * speed,
            spin: model.spin_ratio() * speed,
        };
        Self {
            ring: [0.0; 2],
            ring_velocity: [0.0; 2],
            cage: [0.0; 3],
            cage_velocity: [0.0, 0.0, model.orbit_ratio() * speed],
            rollers: (0..n).map(roller).collect(),
        }
    }

    /// Puts roller `j` at the given circumferential offset from the centre of its pocket.
    fn put_in_pocket(&mut self, b: &Bearing, j: usize, circumferential: f64) {
        let pocket = b.first_angle + TAU * j as f64 / b.count() as f64 + self.cage[2];
        let along = -self.cage[0] * pocket.sin() + self.cage[1] * pocket.cos();
        let r = b.pitch + self.rollers[j].offset;
        self.rollers[j].angle = pocket + ((circumferential + along) / r).asin();
    }

    /// Radial position of roller `j` in its pocket.
    fn radial_in_pocket(&self, b: &Bearing, j: usize) -> f64 {
        let pocket = b.first_angle + TAU * j as f64 / b.count() as f64 + self.cage[2];
        let lead = self.rollers[j].angle - pocket;
        let across = self.cage[0] * pocket.cos() + self.cage[1] * pocket.sin();
        (b.pitch + self.rollers[j].offset) * lead.cos() - b.pitch - across
    }

    /// Rollers between the raceways or up to 5 um deep in them, in all positions in their pockets, the cage up to an
    /// eccentricity of 0.95, everything moving.
    fn random(b: &Bearing, r: &mut Random) -> Self {
        Self::random_beyond(0.0, b, r)
    }

    /// As [`State::random`] with one or two pocket contacts, and these at least `margin` (m) from first touch as
    /// far as that can be chosen.
    ///
    /// Pocket angles of several rad are rounded to 1e-15 rad, which moves a pocket by 4e-17 m and every force of
    /// 1 kN in it by 2e-8 N; at first touch, where damping sets in over nanometres, by far more. Tests that express
    /// one state by different angles keep that below what they look for.
    fn random_beyond(margin: f64, b: &Bearing, r: &mut Random) -> Self {
        let mut s = Self::kinematic(b);
        let n = b.count();
        let direction = r.around_zero(PI);
        let shift = r.unit() * (2.0 * b.gap.max(0.0) + 3e-6);
        s.ring = [shift * direction.cos(), shift * direction.sin()];
        s.ring_velocity = [r.around_zero(0.02), r.around_zero(0.02)];
        s.cage[2] = r.around_zero(0.5);
        s.cage_velocity = [r.around_zero(0.1), r.around_zero(0.1), s.cage_velocity[2] * r.within(0.98, 1.02)];
        // Often towards or away from a roller, and often far out, so that rollers reach both edges at once.
        let j = r.index(n);
        let aligned =
            b.first_angle + TAU * j as f64 / n as f64 + s.cage[2] + if r.chance(0.5) { PI } else { 0.0 };
        let direction = if r.chance(0.5) { aligned } else { r.around_zero(PI) };
        let eccentricity = if r.chance(0.3) { 0.95 } else { 0.95 * r.unit() } * b.guide;
        (s.cage[0], s.cage[1]) = (eccentricity * direction.cos(), eccentricity * direction.sin());
        for j in 0..n {
            let angle = b.first_angle + TAU * j as f64 / n as f64 + s.cage[2];
            let towards = s.ring[0] * angle.cos() + s.ring[1] * angle.sin();
            s.rollers[j].offset = r.within(towards - b.gap - 5e-6, b.gap + 5e-6);
            s.rollers[j].radial_speed = r.around_zero(0.02);
            s.rollers[j].orbit_speed *= r.within(0.98, 1.02);
            s.rollers[j].spin *= r.within(0.7, 1.3);
            s.put_in_pocket(b, j, 0.0);
            let approach = r.within(-3e-6, 4e-6);
            let approach = if approach.abs() < margin { margin.copysign(approach) } else { approach };
            let wall = b.towards_for(s.radial_in_pocket(b, j), approach);
            let circumferential = match r.index(if margin > 0.0 { 24 } else { 3 }) {
                0 => wall,
                1 => -wall,
                _ => r.around_zero(wall),
            };
            s.put_in_pocket(b, j, circumferential);
        }
        s
    }

    /// Turned by `angle` about the bearing axis. Pockets turn with the cage, so nothing else has to change in the
    /// scene than the directions of gravity and load.
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
        s.cage[2] += angle;
        s.rollers.iter_mut().for_each(|r| r.angle += angle);
        s
    }

    /// Mirrored, y to -y. Roller `j` becomes roller `n - j`.
    fn mirrored(&self) -> Self {
        let n = self.rollers.len();
        let flip = |v: [f64; 2]| [-v[0], v[1]];
        let flip_turn = |v: [f64; 3]| [-v[0], v[1], -v[2]];
        let roller = |j: usize| {
            let r = self.rollers[(n - j) % n];
            // Pockets are counted from -pi - first_roller_angle in the mirrored scene.
            let half = if j == 0 { -PI } else { PI };
            Roller { angle: half - r.angle, orbit_speed: -r.orbit_speed, spin: -r.spin, ..r }
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

/// Scenes that differ in what matters for the balance of forces.
fn scenes() -> Vec<(&'static str, Value)> {
    let roundness = json!([
        {"order": 2, "amplitude": 2e-6, "phase": 0.3},
        {"order": 5, "amplitude": -1e-6, "phase": 1.0}
    ]);
    vec![
        ("example", example()),
        (
            "tight cage",
            example_with(&[
                ("cage.pocket.radial_clearance", json!(40e-6)),
                ("cage.pocket.half_angle", json!(0.6)),
                ("cage.pocket.edge_blend", json!(0.05)),
                ("cage.guide.short_bearing.diametral_clearance", json!(152e-6)),
                ("inner_ring.radial_clearance", json!(20e-6)),
            ]),
        ),
        (
            "other options",
            example_with(&[
                ("cage.guide.short_bearing.roundness", roundness),
                ("cage.guide.short_bearing.squeeze", json!(false)),
                ("raceways.contact.thermal_correction", json!("gupta")),
                ("raceways.contact.damping", Value::Null),
                ("raceways.rolling_resistance.extent", json!({"loaded": {"threshold": 50.0}})),
                ("cage.pocket.contact.self_heating", Value::Null),
                ("cage.pocket.edge_blend", json!(0.0)),
                ("rollers.count", json!(13)),
                ("initial", json!({"first_roller_angle": 0.37})),
                ("inner_ring.speed.constant", json!(900.0)),
                ("inner_ring.motion.free.load.y.constant", json!(700.0)),
                ("gravity", json!({"y": 3.0, "z": -5.0})),
            ]),
        ),
        (
            "rough and slow",
            example_with(&[
                ("raceways.contact.boundary_friction.roughness", json!(2e-6)),
                ("cage.pocket.contact.boundary_friction.roughness", json!(5e-6)),
                ("inner_ring.speed.constant", json!(-12.0)),
                ("cage.pocket.radial_clearance", json!(60e-6)),
                ("cage.guide.short_bearing.diametral_clearance", json!(240e-6)),
                ("inner_ring.radial_clearance", json!(-4e-6)),
            ]),
        ),
    ]
}

const STATES_PER_SCENE: usize = 100;

/// Calls `check` with every scene and its random states.
fn at_random_states(seed: u64, mut check: impl FnMut(&str, &mut Bearing, &State)) {
    for (i, (name, scene)) in scenes().into_iter().enumerate() {
        let mut bearing = Bearing::new(scene);
        let mut random = Random::new(seed + i as u64);
        for _ in 0..STATES_PER_SCENE {
            let state = State::random(&bearing, &mut random);
            check(name, &mut bearing, &state);
        }
    }
}

/// Largest force of any source on any body, N.
fn largest_force(f: &Forces) -> f64 {
    f.bodies.iter().flatten().map(|[y, z, _]| y.hypot(*z)).fold(0.0, f64::max)
}

fn sum(body: &BodyForces) -> [f64; 3] {
    body.iter().fold([0.0; 3], |s, f| [s[0] + f[0], s[1] + f[1], s[2] + f[2]])
}

/// Centres of the bodies in the order of force reports.
fn centres(b: &Bearing, s: &State) -> Vec<[f64; 2]> {
    let mut list = vec![[0.0; 2], s.ring, [s.cage[0], s.cage[1]]];
    list.extend(s.rollers.iter().map(|r| {
        let radius = b.pitch + r.offset;
        [radius * r.angle.cos(), radius * r.angle.sin()]
    }));
    list
}

#[test]
fn random_states_reach_every_regime() {
    let mut seen = std::collections::BTreeMap::new();
    at_random_states(1, |_, b, state| {
        let forces = b.forces(state);
        let eccentricity = state.cage[0].hypot(state.cage[1]) / b.guide;
        let mut see = |regime: &'static str, yes: bool| *seen.entry(regime).or_insert(0) += usize::from(yes);
        see("eccentricity of 0.9 and more", eccentricity > 0.9);
        see("eccentricity below 0.1", eccentricity < 0.1);
        for contact in forces.contacts.chunks_exact(4) {
            let [outer, inner, front, back] = contact else { unreachable!() };
            let touches = |c: &[f64; 12]| c[NORMAL] > 0.0;
            // Edges have no film.
            let wall = |c: &[f64; 12]| touches(c) && c[FILM] > 0.0;
            let edge = |c: &[f64; 12]| touches(c) && c[FILM] == 0.0;
            see("outer raceway apart", !touches(outer));
            see("inner raceway apart", !touches(inner));
            see("outer raceway deep", touches(outer) && outer[APPROACH] > 3e-6);
            see("inner raceway deep", touches(inner) && inner[APPROACH] > 3e-6);
            see("outer raceway light", touches(outer) && outer[APPROACH] < 3e-7);
            see("inner raceway light", touches(inner) && inner[APPROACH] < 3e-7);
            see("both raceways", touches(outer) && touches(inner));
            see("mixed or boundary lubrication", touches(outer) && outer[FILM_RATIO] < 1.0);
            see("front wall", wall(front));
            see("back wall", wall(back));
            see("front edge", edge(front));
            see("back edge", edge(back));
            see("both edges", edge(front) && edge(back));
            see("pocket free", !touches(front) && !touches(back));
        }
    });
    for (regime, times) in &seen {
        assert!(*times >= 10, "'{regime}' occurred {times} times only: {seen:?}");
    }
    assert_eq!(seen.len(), 16);
}

#[test]
fn forces_and_moments_between_bodies_balance() {
    at_random_states(1, |name, b, state| {
        let forces = b.forces(state);
        let largest = largest_force(&forces);
        let centres = centres(b, state);
        for source in [OUTER, INNER, POCKET, GUIDE] {
            let mut total = [0.0; 3];
            for (body, [y, z]) in forces.bodies.iter().zip(&centres) {
                let [fy, fz, moment] = body[source];
                total[0] += fy;
                total[1] += fz;
                total[2] += moment + y * fz - z * fy;
            }
            let (force, moment) = (total[0].hypot(total[1]), total[2].abs());
            let what = FORCE_SOURCES[source];
            assert!(force <= 1e-12 * largest, "{name}: forces of {what} leave {force:e} N of {largest} N");
            let limit = 1e-12 * largest * b.pitch;
            assert!(
                moment <= limit,
                "{name}: moments of {what} leave {moment:e} N m, more than {limit:e}: {state:?}"
            );
        }
    });
}

#[test]
fn accelerations_are_forces_over_inertia() {
    at_random_states(2, |name, b, state| {
        let forces = b.forces(state);
        let value = |path: &str| b.scene.pointer(path).and_then(Value::as_f64).unwrap();
        let (mass, inertia) = (value("/rollers/mass"), value("/rollers/inertia"));
        let n = b.count();
        let a = &forces.accelerations;
        let same = |what: String, reported: f64, expected: f64, scale: f64| {
            let error = (reported - expected).abs();
            assert!(
                error <= 1e-10 * scale,
                "{name}: {what}: {reported} reported, {expected} from the forces"
            );
        };
        // Round-off is measured by the largest contribution.
        let scale = |body: &BodyForces, k: usize| body.iter().map(|f| f[k].abs()).fold(1e-300, f64::max);
        for (k, rate) in a.iter().take(2).enumerate() {
            let ring = value("/inner_ring/motion/free/mass");
            let body = &forces.bodies[INNER_RING];
            same(format!("ring {k}"), *rate, sum(body)[k] / ring, scale(body, k) / ring);
        }
        for k in 0..3 {
            let cage = if k < 2 { value("/cage/mass") } else { value("/cage/inertia") };
            let body = &forces.bodies[CAGE];
            same(format!("cage {k}"), a[2 + k], sum(body)[k] / cage, scale(body, k) / cage);
        }
        for (j, roller) in state.rollers.iter().enumerate() {
            let body = &forces.bodies[CAGE + 1 + j];
            let r = b.pitch + roller.offset;
            let (sin, cos) = roller.angle.sin_cos();
            let radial = a[5 + 2 * j] - r * roller.orbit_speed.powi(2);
            let around = r * a[6 + 2 * j] + 2.0 * roller.radial_speed * roller.orbit_speed;
            let centrifugal = r * roller.orbit_speed.powi(2);
            let size = scale(body, 0).max(scale(body, 1)) / mass + centrifugal;
            same(format!("roller {j} y"), radial * cos - around * sin, sum(body)[0] / mass, size);
            same(format!("roller {j} z"), radial * sin + around * cos, sum(body)[1] / mass, size);
            let spin = a[5 + 2 * n + j];
            same(format!("roller {j} spin"), spin, sum(body)[2] / inertia, scale(body, 2) / inertia);
        }
    });
}

/// Distance from first touch in the pocket that symmetry is judged at, m.
const AWAY_FROM_ONSET: f64 = 2e-7;

/// Compares two force reports body by body after `map` has been applied to the forces of the first.
fn assert_same_forces(
    what: &str,
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
                force <= 1e-11 * largest && moment <= 1e-11 * largest * pitch,
                "{what}: {} on body {i}: {wanted:?} wanted, {got:?} found; {force:e} N of {largest} N",
                FORCE_SOURCES[source]
            );
        }
    }
}

fn number(scene: &Value, pointer: &str) -> f64 {
    scene.pointer(pointer).and_then(Value::as_f64).unwrap()
}

/// Changes that turn the external forces of a scene by an angle.
fn turned_forces(scene: &Value, angle: f64) -> Vec<(&'static str, Value)> {
    let (sin, cos) = angle.sin_cos();
    let turn = |y: &str, z: &str| {
        let (y, z) = (number(scene, y), number(scene, z));
        [json!(y * cos - z * sin), json!(y * sin + z * cos)]
    };
    let load = "/inner_ring/motion/free/load";
    let [gravity_y, gravity_z] = turn("/gravity/y", "/gravity/z");
    let [load_y, load_z] = turn(&format!("{load}/y/constant"), &format!("{load}/z/constant"));
    vec![
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
            let mut turned = plain.changed(&turned_forces(&plain.scene, angle));
            let mut random = Random::new(3 + i as u64);
            for _ in 0..STATES_PER_SCENE / 3 {
                let state = State::random_beyond(AWAY_FROM_ONSET, &plain, &mut random);
                let (expected, found) = (plain.forces(&state), turned.forces(&state.turned(angle)));
                assert_same_forces(name, plain.pitch, (&expected, turn), (&found, |body| body));
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
            &[("cage.guide.short_bearing.roundness", json!([])), ("initial.first_roller_angle", json!(-PI))],
        ));
        let first = json!(plain.first_angle + angle);
        let mut turned = plain.changed(&[("initial.first_roller_angle", first)]);
        let mut random = Random::new(4 + i as u64);
        for _ in 0..STATES_PER_SCENE / 3 {
            let state = State::random_beyond(AWAY_FROM_ONSET, &plain, &mut random);
            let mut same = state.clone();
            same.cage[2] -= angle;
            let (expected, found) = (plain.forces(&state), turned.forces(&same));
            assert_same_forces(name, plain.pitch, (&expected, |f| f), (&found, |body| body));
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
        if let Some(list) = scene.pointer("/cage/guide/short_bearing/roundness").and_then(Value::as_array) {
            // cos(n (pi - th - psi) + b) = cos(n (th + psi) - b - n pi)
            for (k, harmonic) in list.iter().enumerate() {
                let phase = -number(harmonic, "/phase") - number(harmonic, "/order") * PI;
                set(&mut other, &format!("cage.guide.short_bearing.roundness.{k}.phase"), json!(phase));
            }
        }
        let mut mirrored = Bearing::new(other);
        let n = plain.count();
        let body_of = |i: usize| if i <= CAGE { i } else { CAGE + 1 + (n - (i - CAGE - 1)) % n };
        let mut random = Random::new(5 + i as u64);
        for _ in 0..STATES_PER_SCENE {
            let state = State::random_beyond(AWAY_FROM_ONSET, &plain, &mut random);
            let (expected, found) = (plain.forces(&state), mirrored.forces(&state.mirrored()));
            let flip = |[y, z, m]: [f64; 3]| [-y, z, -m];
            assert_same_forces(name, plain.pitch, (&expected, flip), (&found, body_of));
            for j in 0..n {
                let contacts = |f: &Forces, j: usize| f.contacts[4 * j..4 * j + 4].to_vec();
                let (a, b) = (contacts(&expected, j), contacts(&found, (n - j) % n));
                for (k, l) in [(0, 0), (1, 1), (2, 3), (3, 2)] {
                    let error = (a[k][NORMAL] - b[l][NORMAL]).abs();
                    assert!(error <= 1e-11 * largest_force(&expected), "{name}: roller {j}, contact {k}");
                }
            }
        }
    }
}

/// Compares the reports of a scene with and without something. `unchanged` lists the sources that must be the same to
/// the last bit, `gone` those that must be zero.
fn switched_off(
    changes: &[(&str, Value)],
    gone: &[usize],
    unchanged: &[usize],
    check: impl Fn(&Forces, &Forces, &State),
) {
    at_random_states(6, |name, b, state| {
        let what = format!("{name} without {changes:?}");
        let with_it = b.forces(state);
        let without = b.changed(changes).forces(state);
        assert_eq!(with_it.bodies.len(), without.bodies.len());
        for (i, (one, other)) in with_it.bodies.iter().zip(&without.bodies).enumerate() {
            for &source in gone {
                assert_eq!(other[source], [0.0; 3], "{what}: {} on body {i}", FORCE_SOURCES[source]);
            }
            for &source in unchanged {
                assert_eq!(one[source], other[source], "{what}: {} on body {i}", FORCE_SOURCES[source]);
            }
        }
        check(&with_it, &without, state);
    });
}

const ALL: [usize; 7] = [OUTER, INNER, POCKET, GUIDE, GRAVITY, LOAD, SUPPORT];

fn all_but(gone: usize) -> Vec<usize> {
    ALL.into_iter().filter(|&source| source != gone).collect()
}

#[test]
fn gravity_load_support_and_guide_vanish_alone() {
    let same_contacts = |a: &Forces, b: &Forces, _: &State| assert_eq!(a.contacts, b.contacts);
    for (path, source) in [
        ("gravity", GRAVITY),
        ("inner_ring.motion.free.load", LOAD),
        ("inner_ring.motion.free.support_damping", SUPPORT),
        ("cage.guide", GUIDE),
    ] {
        switched_off(&[(path, Value::Null)], &[source], &all_but(source), same_contacts);
    }
}

#[test]
fn pockets_vanish_alone() {
    switched_off(&[("cage.pocket", Value::Null)], &[POCKET], &all_but(POCKET), |a, b, _| {
        for (with_pocket, without) in a.contacts.chunks_exact(4).zip(b.contacts.chunks_exact(2)) {
            assert_eq!(&with_pocket[..2], without);
        }
    });
}

#[test]
fn the_cage_vanishes_alone() {
    at_random_states(6, |name, b, state| {
        let with_it = b.forces(state);
        let model = Model::new(Scene::from_value(with(&b.scene, &[("cage", Value::Null)])).unwrap()).unwrap();
        let mut sim = Sim::new(Arc::new(model)).unwrap();
        let n = b.count();
        let mut vector = state.vector();
        vector.drain(5 + 2 * n + 2..5 + 2 * n + 5);
        vector.drain(2..5);
        sim.set_state(0.0, &vector).unwrap();
        let without = sim.forces().unwrap();
        for (i, body) in without.bodies.iter().enumerate() {
            let other = &with_it.bodies[if i < CAGE { i } else { i + 1 }];
            for source in [OUTER, INNER, GRAVITY, LOAD, SUPPORT] {
                assert_eq!(body[source], other[source], "{name}: {} on body {i}", FORCE_SOURCES[source]);
            }
            for source in [POCKET, GUIDE] {
                assert_eq!(body[source], [0.0; 3], "{name}: {} on body {i}", FORCE_SOURCES[source]);
            }
        }
    });
}

#[test]
fn rolling_resistance_vanishes_alone() {
    let off = [("raceways.rolling_resistance", Value::Null)];
    switched_off(&off, &[], &[POCKET, GUIDE, GRAVITY, LOAD, SUPPORT], |a, b, _| {
        assert!(a.contacts.iter().any(|c| c[ROLLING] != 0.0));
        for (one, other) in a.contacts.iter().zip(&b.contacts) {
            assert_eq!(one[..=FRICTION], other[..=FRICTION]);
            assert_eq!(other[ROLLING..SLIP_SPEED], [0.0; 3]);
            assert_eq!(one[SLIP_SPEED..], other[SLIP_SPEED..]);
        }
    });
}

#[test]
fn contact_laws_of_the_raceways_vanish_alone() {
    let path = |law: &str| format!("raceways.contact.{law}");
    // Each law, the quantities that it alone makes, and those that must not change without it.
    let heating = ["self_heating"];
    let traction = ["self_heating", "traction"];
    let friction = ["self_heating", "traction", "boundary_friction"];
    let film = ["self_heating", "traction", "boundary_friction", "thermal_correction", "film"];
    let rows: [(&[&str], &[usize], &[usize]); 5] = [
        (&heating, &[TEMPERATURE], &[NORMAL, FILM, FILM_RATIO, ROLLING]),
        (&traction, &[TEMPERATURE], &[NORMAL, FILM, FILM_RATIO, ROLLING]),
        (&friction, &[TEMPERATURE, FILM_RATIO, FRICTION], &[NORMAL, FILM, ROLLING]),
        (&["boundary_friction"], &[FILM_RATIO], &[NORMAL, FILM, ROLLING]),
        (&film, &[TEMPERATURE, FILM, FILM_RATIO, FRICTION], &[NORMAL, ROLLING]),
    ];
    for (laws, gone, unchanged) in rows {
        let paths: Vec<String> = laws.iter().map(|law| path(law)).collect();
        let changes: Vec<(&str, Value)> = paths.iter().map(|p| (p.as_str(), Value::Null)).collect();
        switched_off(&changes, &[], &[POCKET, GUIDE, GRAVITY, LOAD, SUPPORT], |a, b, _| {
            for (one, other) in a.contacts.chunks_exact(4).zip(b.contacts.chunks_exact(4)) {
                assert_eq!(one[2..], other[2..], "pocket contacts without {laws:?} on the raceways");
                for (one, other) in one[..2].iter().zip(&other[..2]) {
                    gone.iter().for_each(|&k| assert_eq!(other[k], 0.0, "without {laws:?}: {k}"));
                    for &k in unchanged.iter().chain(&[APPROACH, SLIP_SPEED, ROLLING_SPEED]) {
                        assert_eq!(one[k], other[k], "without {laws:?}: {k}");
                    }
                }
            }
        });
    }
}

/// Palmgren's load of a steel roller of the example on a mate of the given E and nu at an approach in m.
fn palmgren_load(approach: f64, length: f64, mate: [f64; 2]) -> f64 {
    (approach / palmgren_compliance(length, mate)).powf(10.0 / 9.0)
}

fn palmgren_compliance(length: f64, [young, poisson]: [f64; 2]) -> f64 {
    let modulus = 2.0 / ((1.0 - 0.3 * 0.3) / 206e9 + (1.0 - poisson * poisson) / young);
    0.39 * (8.0 / modulus).powf(0.9) / length.powf(0.8)
}

const STEEL: [f64; 2] = [206e9, 0.3];
const BRASS: [f64; 2] = [103e9, 0.34];

#[test]
fn without_damping_the_elastic_force_remains() {
    let off = [("raceways.contact.damping", Value::Null), ("cage.pocket.contact.damping", Value::Null)];
    switched_off(&off, &[], &[GUIDE, GRAVITY, LOAD, SUPPORT], |_, b, _| {
        for (i, contact) in b.contacts.iter().enumerate() {
            let mate = if i % 4 < 2 { STEEL } else { BRASS };
            let expected = palmgren_load(contact[APPROACH], 20.4e-3, mate);
            let error = (contact[NORMAL] - expected).abs();
            assert!(error <= 1e-12 * expected, "contact {i}: {} instead of {expected}", contact[NORMAL]);
        }
    });
}

#[test]
fn edge_friction_vanishes_alone() {
    let off = [("cage.pocket.edge_friction", Value::Null)];
    let edges = std::cell::Cell::new(0);
    switched_off(&off, &[], &all_but(POCKET), |a, b, _| {
        for (one, other) in a.contacts.iter().zip(&b.contacts) {
            assert_eq!(one[..=FILM], other[..=FILM]);
            if one[NORMAL] > 0.0 && one[FILM] == 0.0 {
                edges.set(edges.get() + 1);
                assert!(one[FRICTION] != 0.0);
                assert_eq!(other[FRICTION], 0.0);
            }
        }
    });
    assert!(edges.get() > 100);
}

#[test]
fn without_squeeze_the_guide_force_ignores_the_velocity_of_the_cage() {
    for squeeze in [true, false] {
        let mut b = Bearing::new(example_with(&[("cage.guide.short_bearing.squeeze", json!(squeeze))]));
        let mut random = Random::new(7);
        for _ in 0..STATES_PER_SCENE {
            let moving = State::random(&b, &mut random);
            let mut resting = moving.clone();
            (resting.cage_velocity[0], resting.cage_velocity[1]) = (0.0, 0.0);
            let guide = [b.forces(&moving), b.forces(&resting)].map(|f| f.bodies[CAGE][GUIDE]);
            assert_eq!(guide[0] != guide[1], squeeze);
        }
    }
}

/// A jump of a force along a path.
#[derive(Debug)]
struct Jump {
    /// Body and source.
    _place: (String, &'static str),
    /// Component: y, z, moment.
    _component: usize,
    _at: f64,
    /// Size in units of the component's largest value on the path.
    share: f64,
}

/// The largest jump of any force along a path x = 0..1. For every component the steepest interval of a grid is halved
/// until nothing is left of it: the change vanishes for every power law, but not for a jump.
fn largest_jump(b: &mut Bearing, path: impl Fn(f64) -> State) -> Jump {
    const INTERVALS: usize = 1000;
    let names = b.sim.model().body_names();
    let sources = FORCE_SOURCES.len();
    let mut at = |x: f64| -> Vec<f64> { b.forces(&path(x)).bodies.as_flattened().as_flattened().to_vec() };
    let grid: Vec<Vec<f64>> = (0..=INTERVALS).map(|i| at(i as f64 / INTERVALS as f64)).collect();
    let largest = |k: usize| grid.iter().fold(0.0f64, |m, v| m.max(v[k].abs()));
    let overall: [f64; 3] =
        std::array::from_fn(|c| (c..grid[0].len()).step_by(3).map(largest).fold(0.0, f64::max));
    let mut worst = Jump { _place: (String::new(), ""), _component: 0, _at: 0.0, share: 0.0 };
    for k in 0..grid[0].len() {
        // Components that are small beside the others hold round-off only.
        let scale = largest(k).max(1e-6 * overall[k % 3]);
        let change = |i: usize| (grid[i + 1][k] - grid[i][k]).abs();
        let steepest = (0..INTERVALS).max_by(|&i, &j| change(i).total_cmp(&change(j))).unwrap();
        let ends = [steepest, steepest + 1].map(|i| i as f64 / INTERVALS as f64);
        let mut low = (ends[0], grid[steepest][k]);
        let mut high = (ends[1], grid[steepest + 1][k]);
        loop {
            let x = 0.5 * (low.0 + high.0);
            if x <= low.0 || x >= high.0 || (high.1 - low.1).abs() <= 1e-6 * scale {
                break;
            }
            let middle = (x, at(x)[k]);
            if (middle.1 - low.1).abs() > (high.1 - middle.1).abs() { high = middle } else { low = middle }
        }
        let share = (high.1 - low.1).abs() / scale;
        if share > worst.share {
            let place = (names[k / (3 * sources)].clone(), FORCE_SOURCES[k / 3 % sources]);
            worst = Jump { _place: place, _component: k % 3, _at: low.0, share };
        }
    }
    worst
}

const CONTINUOUS: f64 = 1e-3;

fn assert_continuous(what: &str, b: &mut Bearing, path: impl Fn(f64) -> State) {
    let jump = largest_jump(b, path);
    assert!(jump.share < CONTINUOUS, "{what}: {jump:?}");
}

/// The example at rest relative to kinematic motion with the given roller moving.
fn moving_roller(b: &Bearing) -> State {
    let mut s = State::kinematic(b);
    s.rollers[0].radial_speed = 0.01;
    s.rollers[0].spin *= 0.9;
    s.cage_velocity[0] = 0.02;
    s
}

#[test]
fn forces_start_continuously_at_the_raceways() {
    for (name, scene) in scenes() {
        let mut b = Bearing::new(with(&scene, &[("inner_ring.radial_clearance", json!(20e-6))]));
        let base = moving_roller(&b);
        let gap = b.gap;
        for speed in [0.01, -0.002] {
            let at = |offset: f64| {
                let mut s = base.clone();
                s.rollers[0].offset = offset;
                s.rollers[0].radial_speed = speed;
                s
            };
            assert_continuous(&format!("{name}: outer raceway"), &mut b, |x| at(gap + 1e-7 * (x - 0.3)));
            assert_continuous(&format!("{name}: inner raceway"), &mut b, |x| at(-gap - 1e-7 * (x - 0.3)));
            assert_continuous(&format!("{name}: deep"), &mut b, |x| at(gap + 4e-6 * x));
        }
    }
}

#[test]
fn forces_are_continuous_over_slip_and_rolling_speed() {
    for (name, scene) in scenes() {
        let mut b = Bearing::new(scene);
        let mut base = moving_roller(&b);
        base.rollers[0].offset = b.gap + 1e-6;
        let spin = State::kinematic(&b).rollers[0].spin;
        let spinning = |factor: f64| {
            let mut s = base.clone();
            s.rollers[0].spin = spin * factor;
            s
        };
        assert_continuous(&format!("{name}: through zero slip"), &mut b, |x| spinning(0.9 + 0.2 * x));
        // The surfaces move against each other: the mean speed goes through zero at about -1.
        assert_continuous(&format!("{name}: through zero rolling"), &mut b, |x| spinning(-2.0 + 3.0 * x));
    }
}

/// The cage and roller 0 such that this roller is at (radial, circumferential) in its pocket; the roller stays on the
/// pitch circle and at its angle, the cage moves.
fn in_pocket(b: &Bearing, base: &State, radial: f64, circumferential: f64) -> State {
    let mut s = base.clone();
    let (sin, cos) = b.first_angle.sin_cos();
    let lead = (circumferential / b.pitch).asin();
    let inwards = -radial - b.pitch * (1.0 - lead.cos());
    (s.cage[0], s.cage[1]) = (inwards * cos, inwards * sin);
    for j in 0..b.count() {
        s.put_in_pocket(b, j, 0.0);
    }
    s.put_in_pocket(b, 0, circumferential);
    s
}

#[test]
fn forces_start_continuously_in_the_pocket() {
    for (name, scene) in scenes() {
        let mut b = Bearing::new(with(&scene, &[("cage.pocket.edge_blend", json!(0.02))]));
        let base = moving_roller(&b);
        let [clearance, half_angle] = b.pocket;
        for pillar in [1.0, -1.0] {
            for phi in
                [0.0, 0.5 * half_angle, -0.5 * half_angle, half_angle, 1.1 * half_angle, -1.1 * half_angle]
            {
                // Along the line of the angle phi, from 0.2 um before the contact to 0.6 um behind it.
                let touch = {
                    let (mut low, mut high) = (0.5 * clearance, 4.0 * clearance);
                    for _ in 0..80 {
                        let middle = 0.5 * (low + high);
                        let apart = b.pocket_approach(middle * phi.sin(), middle * phi.cos()) <= 0.0;
                        if apart { low = middle } else { high = middle }
                    }
                    low
                };
                let shape = Bearing::new(b.scene.clone());
                assert_continuous(&format!("{name}: pillar {pillar}, angle {phi}"), &mut b, |x| {
                    let d = touch + 8e-7 * (x - 0.25);
                    in_pocket(&shape, &base, d * phi.sin(), pillar * d * phi.cos())
                });
            }
        }
    }
}

/// A roller in contact with a pillar that moves over the ends of the wall.
fn across_the_wall(b: &Bearing, pillar: f64) -> impl Fn(f64) -> State + use<> {
    let shape = Bearing::new(b.scene.clone());
    let base = moving_roller(b);
    let [clearance, half_angle] = b.pocket;
    move |x| {
        let phi = half_angle * (-1.02 + 2.04 * x);
        let d = clearance + 2e-6;
        in_pocket(&shape, &base, d * phi.sin(), pillar * d * phi.cos())
    }
}

#[test]
fn forces_are_continuous_across_the_edges_of_the_pocket() {
    for (name, scene) in scenes() {
        let mut b = Bearing::new(with(&scene, &[("cage.pocket.edge_blend", json!(0.02))]));
        for pillar in [1.0, -1.0] {
            let path = across_the_wall(&b, pillar);
            assert_continuous(&format!("{name}: pillar {pillar}"), &mut b, path);
        }
    }
}

#[test]
fn without_blend_the_friction_jumps_at_the_edges_of_the_pocket() {
    let mut b = Bearing::new(example_with(&[("cage.pocket.edge_blend", json!(0.0))]));
    for pillar in [1.0, -1.0] {
        let path = across_the_wall(&b, pillar);
        let jump = largest_jump(&mut b, path);
        assert!(jump.share > 50.0 * CONTINUOUS, "pillar {pillar}: {jump:?}");
    }
}

#[test]
fn forces_are_continuous_between_one_edge_and_both() {
    let mut b = Bearing::new(scenes().swap_remove(1).1);
    let base = moving_roller(&b);
    let [clearance, half_angle] = b.pocket;
    let shape = Bearing::new(b.scene.clone());
    let resting = clearance / half_angle.sin();
    for side in [1.0, -1.0] {
        // Radially on to both edges, and from one pillar to the other while on both.
        assert_continuous("on to both edges", &mut b, |x| {
            in_pocket(&shape, &base, side * (resting + 4e-7 * (x - 0.4)), 1e-7)
        });
        assert_continuous("from edge to edge", &mut b, |x| {
            in_pocket(&shape, &base, side * (resting + 1e-6), 2e-6 * (x - 0.5))
        });
    }
}

#[test]
fn guide_forces_are_continuous_through_the_centre_and_to_the_wall() {
    for (name, scene) in scenes() {
        let mut b = Bearing::new(with(&scene, &[("cage.pocket", Value::Null)]));
        let base = moving_roller(&b);
        let clearance = b.guide;
        let at = |eccentricity: f64, angle: f64| {
            let mut s = base.clone();
            (s.cage[0], s.cage[1]) =
                (eccentricity * clearance * angle.cos(), eccentricity * clearance * angle.sin());
            s
        };
        assert_continuous(&format!("{name}: along y"), &mut b, |x| at(x - 0.4, 0.0));
        assert_continuous(&format!("{name}: along z"), &mut b, |x| at(x - 0.6, PI / 2.0));
        assert_continuous(&format!("{name}: centre"), &mut b, |x| at(1e-6 * (x - 0.5), 0.7));
        assert_continuous(&format!("{name}: around"), &mut b, |x| at(0.9, TAU * x));
        assert_continuous(&format!("{name}: outwards"), &mut b, |x| at(0.9 + 0.05 * x, 2.0));
    }
}

/// A bearing whose raceways are elastic only.
fn elastic(changes: &[(&str, Value)]) -> Value {
    let bare = [("cage", Value::Null), ("raceways", json!({})), ("lubricant", Value::Null)];
    with(&with(&example(), &bare), changes)
}

#[test]
fn the_equilibrium_start_is_in_equilibrium() {
    let load_z = "inner_ring.motion.free.load.z.constant";
    let load_y = "inner_ring.motion.free.load.y.constant";
    let clearance = "inner_ring.radial_clearance";
    for changes in [
        vec![],
        vec![(clearance, json!(5e-6))],
        vec![(clearance, json!(0.0)), (load_z, json!(-40e3))],
        vec![(clearance, json!(-5e-6)), (load_z, json!(-980.0))],
        vec![(load_y, json!(3000.0)), (load_z, json!(800.0))],
        vec![("initial.first_roller_angle", json!(0.1)), (clearance, json!(200e-6))],
        vec![("inner_ring.speed.constant", json!(-1500.0)), (load_z, json!(-100.0))],
    ] {
        let mut scene = elastic(&changes);
        set(&mut scene, "initial.inner_ring", json!("equilibrium"));
        let mut sim = Sim::new(Arc::new(Model::from_json(&scene.to_string()).unwrap())).unwrap();
        let ring = sim.forces().unwrap().bodies[INNER_RING];
        let [y, z, _] = sum(&ring);
        let load = (ring[LOAD][0] + ring[GRAVITY][0]).hypot(ring[LOAD][1] + ring[GRAVITY][1]);
        let net = y.hypot(z);
        assert!(net < 1e-6 * load, "{changes:?}: net force {net} N under {load} N");
    }
}

#[test]
fn the_equilibrium_start_is_found_for_any_clearance_load_and_roller_angle() {
    let (mut tried, mut failed) = (0, Vec::new());
    for clearance in [-5e-6, 0.0, 5e-6, 40e-6, 200e-6] {
        for load in [1.0, 30.0, 300.0, 4900.0, 100e3] {
            for (count, first) in [(7, 0.3), (12, 0.0), (12, 0.07), (12, 0.14), (12, 0.35), (14, 0.14)] {
                let mut scene = elastic(&[
                    ("gravity", Value::Null),
                    ("rollers.count", json!(count)),
                    ("inner_ring.radial_clearance", json!(clearance)),
                    ("inner_ring.motion.free.load.z.constant", json!(-load)),
                ]);
                set(&mut scene, "initial", json!({"inner_ring": "equilibrium", "first_roller_angle": first}));
                tried += 1;
                if Sim::new(Arc::new(Model::from_json(&scene.to_string()).unwrap())).is_err() {
                    failed.push(format!("{clearance} m, {load} N, {count} rollers from {first} rad"));
                }
            }
        }
    }
    assert!(failed.is_empty(), "not found {} times of {tried}: {}", failed.len(), failed.join("; "));
}

/// Z Qmax/Fr of rigid rings from the sum over the rollers, one of them in the direction of the load: at a ring shift x
/// the roller at psi is squeezed by x cos(psi) - G_r/2, shared by two equal contacts.
fn load_share(count: usize, length: f64, clearance: f64, load: f64) -> f64 {
    let roller_loads = |x: f64| -> Vec<(f64, f64)> {
        (0..count)
            .map(|j| {
                let cos = (TAU * j as f64 / count as f64).cos();
                let squeeze = (x * cos - 0.5 * clearance).max(0.0);
                (palmgren_load(0.5 * squeeze, length, STEEL), cos)
            })
            .collect()
    };
    let (mut low, mut high) = (0.0, 1e-3);
    for _ in 0..100 {
        let x = 0.5 * (low + high);
        let carried: f64 = roller_loads(x).iter().map(|(q, cos)| q * cos).sum();
        if carried > load { high = x } else { low = x }
    }
    let largest = roller_loads(low).iter().fold(0.0f64, |m, (q, _)| m.max(*q));
    count as f64 * largest / load
}

#[test]
fn the_largest_roller_load_is_that_of_the_sum_over_the_rollers() {
    let (count, length, load) = (60, 5e-3, 4900.0);
    for clearance in [5e-6, 2e-6, 1e-6, 0.0] {
        let mut scene = elastic(&[
            ("gravity", Value::Null),
            ("rollers.count", json!(count)),
            ("rollers.radius", json!(2e-3)),
            ("rollers.effective_length", json!(length)),
            ("rollers.mass", json!(5e-4)),
            ("rollers.inertia", json!(1e-9)),
            ("inner_ring.radial_clearance", json!(clearance)),
            ("inner_ring.speed.constant", json!(0.0)),
            ("inner_ring.motion.free.load.z.constant", json!(-load)),
        ]);
        set(&mut scene, "initial", json!({"inner_ring": "equilibrium", "first_roller_angle": -PI / 2.0}));
        let mut sim = Sim::new(Arc::new(Model::from_json(&scene.to_string()).unwrap())).unwrap();
        let forces = sim.forces().unwrap();
        let largest = forces.contacts.chunks_exact(2).fold(0.0f64, |m, c| m.max(c[1][NORMAL]));
        let share = f64::from(count) * largest / load;
        let expected = load_share(count as usize, length, clearance, load);
        assert!(
            (share / expected - 1.0).abs() < 0.01,
            "clearance {clearance}: {share} instead of {expected}"
        );
        if clearance == 0.0 {
            // The value for line contacts without clearance.
            assert!((share / 4.08 - 1.0).abs() < 0.01, "{share} instead of 4.08");
        }
    }
}
