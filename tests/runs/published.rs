//! Published bearings that turn: cages between rings that both turn, and the line of one larger roller.

use crate::common::with;
use cagedyn::model::HostInputs;
use cagedyn::{Model, Sim};
use cagedyn_studies::bearings::{Bearing, Elements, TWELVE};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::sync::Arc;

fn sim(scene: &Value) -> Sim {
    Sim::new(Arc::new(Model::from_json(&scene.to_string()).unwrap_or_else(|e| panic!("{e}")))).unwrap()
}

fn channel(sim: &Sim, name: &str) -> usize {
    sim.channels().iter().position(|channel| channel.name == name).unwrap()
}

/// A preloaded bearing with oil and these speeds: every roller carries, so that the film drives it.
fn preloaded(bearing: &Bearing, [inner, outer]: [Value; 2]) -> Value {
    let load = 2e-3 * bearing.static_rating().unwrap();
    let preload = -5e-4 * bearing.radius();
    let mass = bearing.ring_mass();
    let critical = 2.0 * (bearing.kraemer_stiffness(load) * mass).sqrt();
    with(
        &bearing.rollers_at_rest(preload, load),
        &[
            ("inner_ring.speed", inner),
            ("outer_ring.speed", outer),
            ("inner_ring.motion.free.support_damping", json!(0.3 * critical)),
            (
                "lubricant",
                json!({"viscosity": 0.03, "pressure_viscosity": 2e-8, "temperature_viscosity": 0.04,
                    "conductivity": 0.13, "eyring_stress": 5e6, "shear_modulus": 0.3e9}),
            ),
            (
                "raceways",
                json!({"contact": {
                    "damping": {"relaxation_time": 1e-6, "softening_depth": 1e-8},
                    "film": "pan_hamrock", "traction": "muraki_kimura"
                }}),
            ),
        ],
    )
}

#[test]
fn cages_of_published_bearings_turn_as_rolling_on_both_rings_has_it() {
    for bearing in &TWELVE {
        let (inner, outer) = (90.0 / bearing.pitch().sqrt(), -30.0 / bearing.pitch().sqrt());
        let (gamma, scene) = match bearing.elements {
            Elements::Rollers { .. } => {
                (bearing.radius() / bearing.pitch(), preloaded(bearing, [json!(inner), json!(outer)]))
            }
            Elements::Balls { contact_angle, .. } => {
                let angle = contact_angle.to_radians();
                let scene = json!({
                    "schema": "cagedyn.scene/1",
                    "kinematic_elements": {"count": bearing.count, "radius": bearing.radius(),
                        "pitch_radius": bearing.pitch(), "motion": {"rolling": {"contact_angle": angle}}},
                    "inner_ring": {"speed": inner}, "outer_ring": {"speed": outer},
                    "cage": {"mass": 0.01, "inertia": 0.01 * bearing.pitch().powi(2)},
                    "record": {"duration": 1e-3, "interval": 1e-4}
                });
                (bearing.radius() / bearing.pitch() * angle.cos(), scene)
            }
        };
        let model = Model::from_json(&scene.to_string()).unwrap_or_else(|e| panic!("{}: {e}", bearing.name));
        let [orbit, _] = model.kinematic_speeds(&model.inputs_at(0.0, &HostInputs::default()));
        let expected = 0.5 * (inner * (1.0 - gamma) + outer * (1.0 + gamma));
        assert!((orbit / expected - 1.0).abs() < 1e-3, "{}: {orbit} instead of {expected}", bearing.name);
    }
}

/// Complex amplitude of the height of the ring at the orbit frequency, m, over one turn of the rollers, and their orbit speed.
fn line(bearing: &Bearing, deviation: f64) -> ([f64; 2], f64) {
    let inner = 100.0 / bearing.pitch().sqrt();
    let mut scene = preloaded(bearing, [json!(inner), Value::Null]);
    scene["rollers"]["radius_deviations"] = json!({"groups": [{"rollers": [0], "deviation": deviation}]});
    let mut sim = sim(&scene);
    let model = Arc::clone(sim.model());
    let [orbit, _] = model.kinematic_speeds(&model.inputs_at(0.0, &HostInputs::default()));
    let (height, angle) = (channel(&sim, "inner_ring.z"), channel(&sim, "roller[0].orbit_angle"));
    let mut out = vec![0.0; sim.channels().len()];
    let (period, count) = (TAU / orbit, 60 * bearing.count);
    let settle = 5e-3;
    let (mut sum, mut first, mut last) = ([0.0; 2], 0.0, 0.0);
    for k in 0..=count {
        sim.advance_to(settle + period * k as f64 / count as f64).unwrap();
        sim.outputs(&mut out).unwrap();
        last = out[angle];
        if k == 0 {
            first = last;
        }
        if k < count {
            let phase = orbit * period * k as f64 / count as f64 + first;
            sum[0] += 2.0 * out[height] * phase.cos() / count as f64;
            sum[1] += 2.0 * out[height] * phase.sin() / count as f64;
        }
    }
    (sum, (last - first) / period)
}

#[test]
fn one_larger_roller_draws_a_line_at_the_cage_frequency() {
    for bearing in Bearing::with_rollers().filter(|bearing| bearing.count < 30) {
        let deviation = 2e-5 * bearing.radius();
        let ([cos, sin], orbit) = line(bearing, deviation);
        let ([none_cos, none_sin], _) = line(bearing, 0.0);
        let (found, without) = (cos.hypot(sin), none_cos.hypot(none_sin));
        // Equal springs all around: a roller that is larger by d at both contacts pushes the ring by 4 d/Z away from it.
        let expected = 4.0 * deviation / bearing.count as f64;
        println!("{}: {found:e} m, {without:e} without, {expected:e}, orbit {orbit}", bearing.name);
        assert!(without < 0.05 * found, "{}: {without:e} m without it, {found:e}", bearing.name);
        assert!(
            (found / expected - 1.0).abs() < 0.1,
            "{}: {found:e} instead of {expected:e} m",
            bearing.name
        );
        // Up where the roller is below.
        assert!(sin < 0.0 && cos.abs() < 0.2 * sin.abs(), "{}: {cos:e} {sin:e}", bearing.name);
    }
}
