//! A rigid rotor on two bearings: by a host that owns their rings, and by loads on rings that are free.

use crate::common::example_with;
use crate::machine::{input, output, prescribed, sim, state_place};
use cagedyn::Sim;
use cagedyn::fmi::{self, Instance, Interface};
use nalgebra::Vector2;
use serde_json::{Value, json};
use std::collections::HashMap;
use std::f64::consts::TAU;
use std::sync::Arc;

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

/// A bearing whose ring is owned by a host.
trait Owned {
    /// Lets the ring go on with these velocities and accelerations to the end of step `n` of length `h` (s).
    fn move_on(&mut self, n: u32, h: f64, v: [f64; 2], a: [f64; 2]);
    /// Values of two outputs.
    fn two(&mut self, names: [&str; 2]) -> [f64; 2];
    /// Evaluations until now.
    fn evaluations(&self) -> u64;
}

const RATES: [&str; 2] = ["inner_ring.vy", "inner_ring.vz"];

impl Owned for Sim {
    fn move_on(&mut self, n: u32, h: f64, v: [f64; 2], a: [f64; 2]) {
        for (name, (v, a)) in RATES.into_iter().zip(v.into_iter().zip(a)) {
            self.set_input_slope(input(self, name), v, a).unwrap();
        }
        self.advance_to(f64::from(n) * h).unwrap();
    }

    fn two(&mut self, names: [&str; 2]) -> [f64; 2] {
        two(self, names)
    }

    fn evaluations(&self) -> u64 {
        self.statistics().evaluations
    }
}

/// The same as an instance of a functional mock-up unit, as an importer has it.
struct Unit {
    instance: Instance,
    names: HashMap<String, u32>,
}

impl Unit {
    fn new(sim: &Sim) -> Self {
        let unit = fmi::Unit::new(&sim.model().scene().to_json()).unwrap();
        let names = unit.names().map(str::to_owned).zip(0..).collect();
        let mut instance = Instance::new(Arc::new(unit), Interface::CoSimulation);
        instance.enter_initialization(0.0).unwrap();
        instance.exit_initialization(false).unwrap();
        Self { instance, names }
    }
}

impl Owned for Unit {
    fn move_on(&mut self, n: u32, h: f64, v: [f64; 2], a: [f64; 2]) {
        let rates = RATES.map(|name| self.names[name]);
        self.instance.set_values(&rates, &v).unwrap();
        self.instance.set_input_slopes(&rates, &a).unwrap();
        let t = self.instance.time();
        self.instance.do_step(t, f64::from(n) * h - t).unwrap();
    }

    fn two(&mut self, names: [&str; 2]) -> [f64; 2] {
        // A place that the importer owns is an input.
        let mut out = [0.0; 2];
        self.instance.values(&names.map(|name| self.names[name]), &mut out).unwrap();
        out
    }

    fn evaluations(&self) -> u64 {
        self.instance.evaluations()
    }
}

/// Places of both ends at every 0.1 ms, from a host that owns the rings of bearings that `make` makes, and the evaluations of one of them.
fn owned<B: Owned>(duration: f64, make: impl Fn(Sim) -> B) -> (Vec<[f64; 6]>, u64) {
    let (rotor, h) = (RigidRotor::new(), 1e-4);
    let start = two(&mut monolithic_bearing(), ENDS);
    let mut ends: [B; 2] =
        std::array::from_fn(|_| make(bearing_of_rotor(prescribed(json!(start[0]), json!(start[1])))));
    let (mut places, mut v, mut t) = (Vec::new(), [[0.0; 2]; 2], 0.0);
    let forces = |ends: &mut [B; 2]| -> [[f64; 2]; 2] { std::array::from_fn(|i| ends[i].two(FORCES)) };
    let mut a = rotor.accelerations(forces(&mut ends), v, t);
    for n in 1..=(duration / h).round() as u32 {
        for (i, end) in ends.iter_mut().enumerate() {
            end.move_on(n, h, v[i], a[i]);
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
        let [[y0, z0], [y1, z1]] = std::array::from_fn(|i| ends[i].two(ENDS));
        let [cage_y, cage_z] = ends[0].two(CAGE);
        places.push([y0, z0, y1, z1, cage_y, cage_z]);
    }
    (places, ends[0].evaluations())
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

/// Orbits of a rotor of 50 kg on two bearings: by loads at every microsecond, by a host that owns the rings in steps of 0.1 ms, and by one
/// that has the bearings as functional mock-up units.
#[test]
fn a_host_owns_the_rings_of_a_rotor() {
    const DURATION: f64 = 0.08;
    let (loaded, _) = loaded(DURATION);
    let mut free = monolithic_bearing();
    free.advance_to(DURATION).unwrap();
    for (host, (owned, evaluations)) in
        [("library", owned(DURATION, |sim| sim)), ("units", owned(DURATION, |sim| Unit::new(&sim)))]
    {
        let ratio = evaluations as f64 / free.statistics().evaluations as f64;
        // What goes round with the rotor: rollers pass at other times in all, as cages are not reproducible.
        let mut worst = 0.0f64;
        for k in 0..4 {
            let [one, other] = [&loaded, &owned].map(|places| synchronous(places, k));
            worst = worst.max((one - other).norm() / one.norm());
        }
        let mean = |places: &[[f64; 6]], k: usize| places[400..].iter().map(|x| x[k]).sum::<f64>() / 400.0;
        let cages = [4, 5].map(|k| mean(&loaded, k) - mean(&owned, k));
        println!(
            "{host}: orbits {worst:.4} apart, {ratio:.2} of the evaluations of a free run, means of cages {cages:.3?}"
        );
        assert!(worst < 0.01, "{host}: {worst}");
        assert!(ratio < 1.5, "{host}: {ratio}");
        assert!(cages.iter().all(|apart| apart.abs() < 0.05), "{host}: {cages:?}");
    }
}
