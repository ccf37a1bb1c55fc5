//! Scenes of the [twelve published bearings](crate::bearings) with everything that a scene can have: elastic cages, heat in
//! motion, grease, profiles, deviations of size, rings that both turn, reversals, inner guides, no cage.
//!
//! Scene `number` has bearing `number` modulo twelve. Ranges: loads of a thousandth to a third of the static rating, speeds of
//! 3e3 to 6e5 mm/min times the pitch diameter, oils as in [`scenes`](super::scenes), temperatures of 285 to 360 K.

use super::parts::{elastic_ring, guide, heat, pocket};
use super::scenes::Draw;
use crate::bearings::{Bearing, Elements, TWELVE};
use crate::random::Random;
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};

/// Lowest and highest speed times pitch diameter, m/s of rad/s times m: 3e3 and 6e5 mm/min.
const SPEEDS: [f64; 2] = [3.0 * TAU / 60.0, 600.0 * TAU / 60.0];
/// Seeds of these scenes are apart from those of others with the same number.
const STREAM: u64 = 0x7e11_3bea_4149_6573;

/// A scene of `duration` s for this number, the same on every machine.
pub fn scene(number: u64, duration: f64) -> Value {
    let bearing = &TWELVE[(number % TWELVE.len() as u64) as usize];
    let mut draw = Draw(Random::new(number.wrapping_mul(0x5851_f42d_4c95_7f2d) ^ STREAM));
    let mut scene = match bearing.elements {
        Elements::Rollers { .. } => rollers(&mut draw, bearing, duration),
        Elements::Balls { .. } => balls(&mut draw, bearing, duration),
    };
    scene["title"] = json!(format!("{}, random scene {number}", bearing.name));
    scene["record"] = json!({"duration": duration, "interval": 1e-4});
    scene["gravity"] = json!({"y": 0.0, "z": -9.80665});
    scene["materials"] = json!({
        "steel": {"young_modulus": 206e9, "poisson_ratio": 0.30,
            "thermal": {"conductivity": 46.0, "density": 7830.0, "specific_heat": 460.0}},
        "brass": {"young_modulus": 103e9, "poisson_ratio": 0.34,
            "thermal": {"conductivity": 110.0, "density": 8500.0, "specific_heat": 380.0}}
    });
    let lumps = draw.chance(0.3);
    let turning = !lumps && draw.chance(0.3);
    let speed = draw.log(SPEEDS[0], SPEEDS[1]) / (2.0 * bearing.pitch());
    let speed = if draw.chance(0.5) { speed } else { -speed };
    // What conducts heat is that of one speed.
    scene["inner_ring"]["speed"] = if lumps { json!(speed) } else { speed_of(&mut draw, speed, duration) };
    if turning {
        let speed = speed * draw.log(0.03, 1.0) * if draw.chance(0.5) { 1.0 } else { -1.0 };
        scene["outer_ring"]["speed"] = speed_of(&mut draw, speed, duration);
    }
    lubricant(&mut draw, &mut scene, lumps);
    if lumps {
        scene["heat"] = heat(&mut draw, bearing, &scene);
    }
    scene
}

/// A speed that most often is constant, else reverses or varies.
fn speed_of(draw: &mut Draw, speed: f64, duration: f64) -> Value {
    match draw.0.index(10) {
        0 => {
            let start = draw.within(0.1, 0.4) * duration;
            let end = start + draw.within(0.1, 0.5) * duration;
            json!({"ramp": {"from": speed, "to": -speed, "start": start, "end": end}})
        }
        1 | 2 => draw.signal(speed, duration, 300.0),
        _ => json!({"constant": speed}),
    }
}

fn lubricant(draw: &mut Draw, scene: &mut Value, lumps: bool) {
    let mut viscosity = draw.viscosity();
    if lumps {
        let cold = draw.log(20e-6, 300e-6);
        viscosity = json!({"walther": {
            "cold": {"temperature": 313.15, "kinematic_viscosity": cold},
            "hot": {"temperature": 373.15, "kinematic_viscosity": draw.log(0.06, 0.2) * cold},
            "density": 880.0
        }});
    }
    scene["lubricant"] = json!({
        "viscosity": viscosity, "pressure_viscosity": draw.log(1e-8, 3e-8), "temperature_viscosity": 0.04,
        "conductivity": 0.13, "eyring_stress": draw.log(2e6, 8e6), "shear_modulus": 0.3e9
    });
    let layer = scene["cage"]["guide"]["film"]["lubricant_layer"].is_object();
    if layer && draw.chance(0.5) {
        scene["lubricant"]["grease"] = draw.grease();
    }
}

/// A roller bearing on a free ring.
fn rollers(draw: &mut Draw, bearing: &Bearing, duration: f64) -> Value {
    let [least, most] = bearing.clearance;
    let clearance = 1e-6 * draw.within(least, most);
    let rating = bearing.static_rating().unwrap_or(0.0);
    let load = rating * draw.log(1e-3, 0.3);
    let mut scene = bearing.rollers_at_rest(clearance, load);
    let mass = bearing.ring_mass() * draw.log(1.0, 8.0);
    let critical = 2.0 * (bearing.kraemer_stiffness(load) * mass).sqrt();
    scene["inner_ring"]["motion"]["free"] = json!({
        "mass": mass, "load": {"y": 0.0, "z": draw.signal(-load, duration, 2e4)},
        "support_damping": if draw.chance(0.8) { json!(critical * draw.log(0.01, 0.3)) } else { Value::Null }
    });
    scene["raceways"] = json!({"contact": draw.line([2e-7, 2e-6])});
    if draw.chance(0.7) {
        // Without the drag of sliding in the inlet it turns unloaded rollers backwards.
        scene["raceways"]["rolling_resistance"] = json!({"extent": "all", "inlet_sliding": {}});
    }
    let mut pocket_clearance = f64::INFINITY;
    if bearing.caged && draw.chance(0.9) {
        scene["cage"] = cage(draw, bearing, Some(clearance), duration);
        let pocket = &scene["cage"]["pocket"];
        let cylinder = pocket["lubricated_cylinder"]["radial_clearance"].as_f64();
        let plane = pocket["solid_plane"]["diametral_clearance"].as_f64().map(|c| 0.5 * c);
        pocket_clearance = cylinder.or(plane).unwrap_or(pocket_clearance);
    } else {
        neighbours(draw, &mut scene);
    }
    profile(draw, bearing, load, &mut scene);
    if draw.chance(0.3) {
        let largest = draw.log(0.1e-6, 5e-6).min(0.5 * pocket_clearance).min(0.005 * bearing.radius());
        // Full complements have no room for more.
        let room =
            (bearing.pitch() - 0.25 * clearance) * (PI / bearing.count as f64).sin() - bearing.radius();
        let largest = largest.min(0.5 * room);
        scene["rollers"]["radius_deviations"] = if draw.chance(0.5) {
            json!({"each": (0..bearing.count).map(|_| draw.within(-largest, largest)).collect::<Vec<_>>()})
        } else {
            json!({"groups": [{"rollers": [draw.0.index(bearing.count)], "deviation": largest}]})
        };
    }
    scene
}

/// What keeps rollers without a cage apart.
fn neighbours(draw: &mut Draw, scene: &mut Value) {
    scene["rollers"]["neighbours"] = json!({"contact": draw.line([5e-7, 5e-6])});
}

/// A profile of rollers and raceways, half of the time.
fn profile(draw: &mut Draw, bearing: &Bearing, load: f64, scene: &mut Value) {
    let length = bearing.length().unwrap_or(0.0);
    let crown = |drop: f64| length * length / (8.0 * drop);
    match draw.0.index(6) {
        0 | 1 => {
            let design = draw.log(0.5, 5.0) * 4.6 * load / bearing.count as f64;
            let mut profile = json!({"design_load": design, "crowned_share": draw.within(0.3, 1.0)});
            if draw.chance(0.5) {
                profile["end_drop"] = json!(draw.log(3e-6, 30e-6));
            }
            scene["rollers"]["profile"] = json!({"logarithmic": profile});
        }
        2 => {
            scene["rollers"]["profile"] =
                json!({"circular_crown": {"radius": crown(draw.log(1e-6, 20e-6)).max(2.0 * length)}});
        }
        3 => {
            let ring = if draw.chance(0.5) { "inner_ring" } else { "outer_ring" };
            scene[ring]["raceway_crown_radius"] = json!(crown(draw.log(1e-6, 10e-6)).max(2.0 * length));
        }
        _ => {}
    }
}

/// A ball bearing, whose balls roll as the rings have them.
fn balls(draw: &mut Draw, bearing: &Bearing, duration: f64) -> Value {
    let Elements::Balls { contact_angle, .. } = bearing.elements else { return Value::Null };
    let mut scene = json!({
        "schema": "cagedyn.scene/1",
        "kinematic_elements": {
            "count": bearing.count, "radius": bearing.radius(), "pitch_radius": bearing.pitch(),
            "motion": {"rolling": {"contact_angle": contact_angle.to_radians()}}
        },
        "inner_ring": {}
    });
    scene["cage"] = cage(draw, bearing, None, duration);
    if scene["cage"]["pocket"]["lubricated_cylinder"].is_object() {
        scene["kinematic_elements"]["material"] = json!("steel");
        // The ellipse of a ball in its pocket as a line.
        scene["kinematic_elements"]["effective_length"] = json!(0.5 * bearing.radius());
    }
    scene
}

/// A cage of a twentieth to a third of what the elements weigh; among rollers if the inner ring has a clearance.
fn cage(draw: &mut Draw, bearing: &Bearing, clearance: Option<f64>, duration: f64) -> Value {
    let pitch = bearing.pitch();
    let mass = draw.log(0.05, 0.35) * bearing.count as f64 * bearing.element_mass();
    let mut cage = json!({
        "mass": mass, "inertia": mass * pitch * pitch * draw.within(0.85, 1.05), "material": "brass",
        "pocket": pocket(draw, bearing, mass)
    });
    // Only rollers in cylindrical pockets hold a cage by themselves.
    let held = clearance.is_some() && cage["pocket"]["lubricated_cylinder"].is_object();
    if !held || draw.chance(0.85) {
        cage["guide"] = guide(draw, bearing, clearance, mass);
    }
    if draw.chance(0.5) {
        let (eccentricity, angle) = (pitch * draw.log(1e-5, 1e-3), draw.angle());
        cage["mass_eccentricity"] = json!({"y": eccentricity * angle.cos(), "z": eccentricity * angle.sin()});
    }
    // A pocket alone does not hold a cage against a pull.
    if draw.chance(0.15) && cage["guide"].is_object() {
        let size = mass * draw.log(1.0, 300.0);
        cage["load"] = json!({"force_z": draw.signal(size, duration, 1e5)});
    }
    if draw.chance(0.35) {
        cage["elastic_ring"] = elastic_ring(draw, (bearing.pitch(), bearing.count), mass);
    }
    cage
}
