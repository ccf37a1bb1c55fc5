//! Scenes of balls that move in space: angular contact and deep groove bearings of any size under combined loads, with and without films.
//!
//! Ranges: pitch diameter 20 to 300 mm, 3e3 to 6e5 mm/min times that, ball loads of 0.05 to 5 N per mm^2 of their diameter's square, radial
//! loads up to half of the axial one, misalignment up to 2 mrad, clearance of deep grooves up to 3e-4 of the pitch diameter, oils as in
//! [`scenes`](super::scenes), mixtures of 1 to 60 kg/m^3, waves of orders 2 to 60 and up to 1e-4 of the pitch radius over the square of the
//! order, rings that are moved over time. With or without a [cage](super::cage_in_space).

use super::cage_in_space::{self, Sizes};
use super::scenes::Draw;
use crate::random::Random;
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};

/// Lowest and highest speed times pitch diameter, m/s of rad/s times m.
const SPEEDS: [f64; 2] = [3.0 * TAU / 60.0, 600.0 * TAU / 60.0];
/// Seeds of these scenes are apart from those of others with the same number.
const STREAM: u64 = 0x35a1_90c2_77b4_61e9;

/// A scene of `duration` s for this number, the same on every machine; `caged` but for its cage the same as without.
pub fn scene(number: u64, duration: f64, caged: bool) -> Value {
    let draw = &mut Draw(Random::new(number.wrapping_mul(0x5851_f42d_4c95_7f2d) ^ STREAM));
    let pitch = draw.log(10e-3, 150e-3);
    let radius = pitch * draw.within(0.1, 0.22);
    let most = (0.95 * PI * pitch / radius).floor();
    let count = (most * draw.within(0.5, 1.0)).floor().max(5.0);
    let angle = draw.chance(0.6).then(|| draw.within(0.2, 0.75));
    let clearance = pitch * draw.log(5e-6, 6e-4);
    let free_angle = angle.unwrap_or(0.3);
    let per_ball = draw.log(0.05, 5.0) * (2e3 * radius) * (2e3 * radius);
    let axial = count * per_ball * free_angle.sin();
    let radial = axial * draw.within(0.0, 0.5);
    let direction = draw.angle();
    let speed = draw.log(SPEEDS[0], SPEEDS[1]) / (2.0 * pitch) * if draw.chance(0.5) { 1.0 } else { -1.0 };
    let groove = |draw: &mut Draw| 2.0 * radius * draw.within(0.515, 0.54);
    let mass = 7830.0 * 4.0 / 3.0 * PI * radius.powi(3);
    let ring_mass = count * mass * draw.log(3.0, 60.0);
    let transverse = ring_mass * pitch * pitch * draw.within(0.4, 1.5);
    let coordinate = |draw: &mut Draw, size: f64| draw.coordinate(size, 6);
    let load = |draw: &mut Draw, size: f64| draw.signal(size, duration, 1e3);
    let moment = 0.1 * axial * pitch * draw.within(-1.0, 1.0);
    let steady = json!({"constant": axial});
    let mut space = json!({
        "x": "free",
        "y": coordinate(draw, 1e-4 * pitch), "z": coordinate(draw, 1e-4 * pitch),
        "tilt_y": coordinate(draw, 2e-3), "tilt_z": coordinate(draw, 2e-3),
        "load": {
            "x": steady, "y": load(draw, radial * direction.cos()), "z": load(draw, radial * direction.sin()),
            "moment_y": load(draw, moment),
        },
        "mass": ring_mass,
        "inertia": {"polar": transverse * draw.within(0.3, 1.9), "transverse": transverse},
    });
    if draw.chance(0.6) {
        // A twentieth to all of the critical damping of a ring on its balls.
        space["support_damping"] = json!(draw.log(0.05, 1.0) * (1e8 * ring_mass).sqrt());
        space["tilt_damping"] = json!(draw.log(0.01, 0.3) * pitch * (1e8 * transverse).sqrt());
    }
    if draw.chance(0.3) {
        space["preload"] = json!({"force": 0.2 * axial, "stiffness": draw.log(1e4, 1e7)});
    }
    let mut contact = json!({});
    let films = draw.chance(0.85);
    if draw.chance(0.9) {
        contact["damping"] = json!({"relaxation_time": draw.log(1e-7, 2e-6), "softening_depth": 1e-8});
    }
    if films {
        contact["film"] = json!("hamrock_dowson");
        contact["traction"] = json!("muraki_kimura");
        for (field, law) in [("thermal_correction", "gupta"), ("self_heating", "film_and_flash")] {
            if draw.chance(0.8) {
                contact[field] = json!(law);
            }
        }
        if draw.chance(0.8) {
            contact["boundary_friction"] = json!({
                "coefficient": draw.log(0.05, 0.15), "transition_speed": draw.log(5e-3, 0.1),
                "roughness": draw.log(3e-8, 5e-7), "lambda_boundary": 0.06, "lambda_full": 3.0
            });
        }
    }
    let mut raceways = json!({"contact": contact});
    if films && draw.chance(0.8) {
        let law = if draw.chance(0.5) { "biboulet_houpert" } else { "houpert" };
        raceways["rolling_resistance"] = json!({"extent": "all", "law": law});
    }
    let mut balls = json!({
        "count": count, "radius": radius, "pitch_radius": pitch, "mass": mass, "material": "steel"
    });
    if draw.chance(0.3) {
        let deviation = radius * draw.log(1e-5, 3e-4);
        balls["radius_deviations"] = json!({"groups": [{"balls": [0, 2], "deviation": deviation}]});
    }
    if draw.chance(0.4) {
        balls["drag"] = json!({"density": draw.log(1.0, 60.0)});
    }
    let mut inner = json!({
        "groove_radius": groove(draw), "material": "steel", "speed": {"constant": speed}, "motion": {"space": space}
    });
    match angle {
        Some(angle) => balls["contact_angle"] = json!(angle),
        None => inner["radial_clearance"] = json!(clearance),
    }
    let mut outer = json!({"groove_radius": groove(draw), "material": "steel"});
    if draw.chance(0.2) {
        outer["speed"] = json!({"constant": speed * draw.within(-1.0, 1.0)});
    }
    for ring in [&mut outer, &mut inner] {
        if draw.chance(0.4) {
            let count = 1 + draw.0.index(4);
            let mut wave = || {
                let order = draw.log(2.0, 60.0).round();
                // Waves get flatter as they get shorter.
                let amplitude = pitch * draw.log(1e-7, 1e-4) / (order * order).max(10.0);
                json!({"order": order, "amplitude": amplitude, "phase": draw.angle()})
            };
            let waves: Vec<Value> = (0..count).map(|_| wave()).collect();
            ring["waviness"] = json!(waves);
        }
    }
    let mut scene = json!({
        "schema": "cagedyn.scene/1",
        "title": format!("balls in space, random scene {number}"),
        "gravity": {"y": 0.0, "z": -9.80665},
        "materials": {"steel": {"young_modulus": 206e9, "poisson_ratio": 0.30,
            "thermal": {"conductivity": 46.0, "density": 7830.0, "specific_heat": 460.0}}},
        "lubricant": {
            "viscosity": draw.viscosity(), "pressure_viscosity": draw.log(1e-8, 3e-8),
            "temperature_viscosity": 0.04, "conductivity": 0.13, "eyring_stress": draw.log(2e6, 8e6),
            "shear_modulus": 0.3e9
        },
        "balls": balls, "outer_ring": outer, "inner_ring": inner, "raceways": raceways,
        "initial": {"inner_ring": if draw.chance(0.7) { "equilibrium" } else { "centred" }, "first_roller_angle": draw.angle()},
        "record": {"duration": duration, "interval": 1e-4}
    });
    if caged {
        let room = pitch * (PI / count).sin() - radius;
        let clearance = if angle.is_some() { 0.0 } else { clearance };
        cage_in_space::add(
            draw,
            &mut scene,
            Sizes { count: count as usize, radius, pitch, room, clearance },
            duration,
        );
    }
    scene
}
