//! Bearings that tests put into chosen or random states to read the forces: scenes, states, and loops over them.

use super::{Random, example, example_with, with};
use cagedyn::model::Forces;
use cagedyn::scene::Pocket;
use cagedyn::{Model, Scene, Sim};
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// A scene with its simulation and the lengths that states are built from.
pub struct Bearing {
    pub scene: Value,
    pub sim: Sim,
    pub pitch: f64,
    roller_radius: f64,
    pub gap: f64,
    pub first_angle: f64,
    pub pocket: [f64; 2],
    pub guide: f64,
}

impl Bearing {
    pub fn new(scene: Value) -> Self {
        let checked = Scene::from_value(&scene).unwrap_or_else(|e| panic!("{e}"));
        let sim = Sim::new(Arc::new(Model::new(checked.clone()).unwrap())).unwrap_or_else(|e| panic!("{e}"));
        let pocket = checked.cage.as_ref().and_then(|c| match c.pocket.as_ref()? {
            Pocket::LubricatedCylinder(pocket) => Some([pocket.radial_clearance, pocket.half_angle]),
            _ => None,
        });
        Self {
            pitch: sim.model().pitch_radius(),
            guide: sim.model().guide_clearance().unwrap_or(0.0),
            roller_radius: checked.element_radius(),
            gap: checked.inner_ring.as_ref().and_then(|ring| ring.radial_clearance).unwrap() / 4.0,
            first_angle: checked.initial.first_roller_angle,
            pocket: pocket.unwrap_or([1.0, 1.0]),
            scene,
            sim,
        }
    }

    pub fn changed(&self, changes: &[(&str, Value)]) -> Self {
        Self::new(with(&self.scene, changes))
    }

    pub fn count(&self) -> usize {
        self.sim.model().layout().count
    }

    pub fn forces(&mut self, state: &State) -> Forces {
        let vector = state.vector();
        self.sim.set_state(0.0, &vector).unwrap_or_else(|e| panic!("{e}: {state:?}"));
        self.sim.forces().unwrap_or_else(|e| panic!("{e}: {state:?}")).clone()
    }

    /// Approach of a roller at (radially outwards, towards the pillar) in its pocket to that pillar, m.
    pub fn pocket_approach(&self, radial: f64, towards: f64) -> f64 {
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
pub struct State {
    pub ring: [f64; 2],
    pub ring_velocity: [f64; 2],
    pub cage: [f64; 3],
    pub cage_velocity: [f64; 3],
    pub rollers: Vec<Roller>,
}

#[derive(Clone, Copy, Debug)]
pub struct Roller {
    pub offset: f64,
    /// Orbit angle travelled from the reference angle of the roller, rad.
    pub travel: f64,
    pub radial_speed: f64,
    pub orbit_speed: f64,
    pub spin: f64,
}

impl Bearing {
    /// Angle from which the travel of roller `j` counts, rad.
    pub fn reference(&self, j: usize) -> f64 {
        self.first_angle + TAU * j as f64 / self.count() as f64
    }
}

impl State {
    pub fn vector(&self) -> Vec<f64> {
        let mut x = Vec::new();
        x.extend(self.ring);
        x.extend(self.cage);
        x.extend(self.rollers.iter().flat_map(|r| [r.offset, r.travel]));
        x.extend(self.ring_velocity);
        x.extend(self.cage_velocity);
        x.extend(self.rollers.iter().flat_map(|r| [r.radial_speed, r.orbit_speed]));
        x.extend(self.rollers.iter().map(|r| r.spin));
        x
    }

    /// Everything at rest relative to kinematic motion, rollers on the pitch circle in the centres of their pockets.
    pub fn kinematic(b: &Bearing) -> Self {
        let model = b.sim.model();
        let [orbit, spin] = model.kinematic_speeds(&model.inputs_at(0.0, &Default::default()));
        let n = b.count();
        let roller = |_| Roller { offset: 0.0, travel: 0.0, radial_speed: 0.0, orbit_speed: orbit, spin };
        Self {
            ring: [0.0; 2],
            ring_velocity: [0.0; 2],
            cage: [0.0; 3],
            cage_velocity: [0.0, 0.0, orbit],
            rollers: (0..n).map(roller).collect(),
        }
    }

    /// Puts roller `j` at the given circumferential offset from the centre of its pocket.
    pub fn put_in_pocket(&mut self, b: &Bearing, j: usize, circumferential: f64) {
        let pocket = b.reference(j) + self.cage[2];
        let along = -self.cage[0] * pocket.sin() + self.cage[1] * pocket.cos();
        let r = b.pitch + self.rollers[j].offset;
        self.rollers[j].travel = self.cage[2] + ((circumferential + along) / r).asin();
    }

    /// Radial position of roller `j` in its pocket.
    fn radial_in_pocket(&self, b: &Bearing, j: usize) -> f64 {
        let pocket = b.reference(j) + self.cage[2];
        let lead = self.rollers[j].travel - self.cage[2];
        let across = self.cage[0] * pocket.cos() + self.cage[1] * pocket.sin();
        (b.pitch + self.rollers[j].offset) * lead.cos() - b.pitch - across
    }

    /// Rollers between the raceways or up to 5 um deep in them, in all positions in their pockets, the cage up to an
    /// eccentricity of 0.95, everything moving.
    pub fn random(b: &Bearing, r: &mut Random) -> Self {
        Self::random_beyond(0.0, b, r)
    }

    /// As [`State::random`] with one or two pocket contacts, and these at least `margin` (m) from first touch as
    /// far as that can be chosen.
    ///
    /// Angles of a rad are rounded to 1e-16 rad, which moves a pocket by 4e-18 m and every force of 1 kN in it by
    /// 2e-9 N; at first touch, where damping sets in over nanometres, by far more. Tests that express one state by
    /// different angles keep that below what they look for.
    pub fn random_beyond(margin: f64, b: &Bearing, r: &mut Random) -> Self {
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
        let aligned = b.reference(j) + s.cage[2] + if r.chance(0.5) { PI } else { 0.0 };
        let direction = if r.chance(0.5) { aligned } else { r.around_zero(PI) };
        let eccentricity = if r.chance(0.3) { 0.95 } else { 0.95 * r.unit() } * b.guide;
        (s.cage[0], s.cage[1]) = (eccentricity * direction.cos(), eccentricity * direction.sin());
        for j in 0..n {
            let angle = b.reference(j) + s.cage[2];
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
}

/// Scenes that differ in what matters for the balance of forces.
pub fn scenes() -> Vec<(&'static str, Value)> {
    let roundness = json!([
        {"order": 2, "amplitude": 2e-6, "phase": 0.3},
        {"order": 5, "amplitude": -1e-6, "phase": 1.0}
    ]);
    vec![
        ("example", example()),
        (
            "tight cage",
            example_with(&[
                ("cage.pocket.lubricated_cylinder.radial_clearance", json!(40e-6)),
                ("cage.pocket.lubricated_cylinder.half_angle", json!(0.6)),
                ("cage.pocket.lubricated_cylinder.edge_blend", json!(0.05)),
                ("cage.guide.diametral_clearance", json!(152e-6)),
                ("inner_ring.radial_clearance", json!(20e-6)),
            ]),
        ),
        (
            "other options",
            example_with(&[
                ("cage.guide.roundness", roundness),
                ("cage.guide.film.short_bearing.squeeze", json!(false)),
                ("raceways.contact.thermal_correction", json!("gupta")),
                ("raceways.contact.damping", Value::Null),
                ("raceways.rolling_resistance.extent", json!({"loaded": {"threshold": 50.0}})),
                ("cage.pocket.lubricated_cylinder.contact.self_heating", Value::Null),
                ("cage.pocket.lubricated_cylinder.edge_blend", json!(0.0)),
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
                ("cage.pocket.lubricated_cylinder.contact.boundary_friction.roughness", json!(5e-6)),
                ("inner_ring.speed.constant", json!(-12.0)),
                ("cage.pocket.lubricated_cylinder.radial_clearance", json!(60e-6)),
                ("cage.guide.diametral_clearance", json!(240e-6)),
                ("inner_ring.radial_clearance", json!(-4e-6)),
            ]),
        ),
        (
            "turning outer ring",
            example_with(&[
                ("outer_ring.speed", json!({"constant": 90.0})),
                ("cage.pocket.lubricated_cylinder.radial_clearance", json!(60e-6)),
                ("cage.guide.diametral_clearance", json!(240e-6)),
                ("inner_ring.radial_clearance", json!(10e-6)),
            ]),
        ),
    ]
}

pub const STATES_PER_SCENE: usize = 100;

/// Calls `check` with every scene and its random states.
pub fn at_random_states(seed: u64, mut check: impl FnMut(&str, &mut Bearing, &State)) {
    for (i, (name, scene)) in scenes().into_iter().enumerate() {
        let mut bearing = Bearing::new(scene);
        let mut random = Random::new(seed + i as u64);
        for _ in 0..STATES_PER_SCENE {
            let state = State::random(&bearing, &mut random);
            check(name, &mut bearing, &state);
        }
    }
}
