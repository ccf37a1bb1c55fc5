//! Scenes of rollers that move in space: cylindrical roller bearings of any size with ribs, misaligned, under combined loads.
//!
//! Ranges: pitch diameter 10 mm to 1 m, 3e3 to 6e5 mm/min times that, loads of 5e-4 to a quarter of the static rating, axial ones up to a
//! fifth of that, misalignment of 0.1 to 5 mrad, rollers 1.8 to 4 times as long as their radius, end plays of 20 to 150 um, ribs that open by 0
//! to 25 mrad, caps of 0.2 to 20 m and ends of 10 to 50 m that are nearly flat, oils as in [`scenes`](super::scenes), greases as in
//! [`published`](super::published). With or without a cage, whose pockets may have sides; every fourth ring of a cage bends.

use super::parts::elastic_ring;
use super::scenes::{Draw, materials};
use crate::random::Random;
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};

/// Lowest and highest speed times pitch diameter, m/s of rad/s times m.
const SPEEDS: [f64; 2] = [3.0 * TAU / 60.0, 600.0 * TAU / 60.0];
/// Seeds of these scenes are apart from those of others with the same number.
const STREAM: u64 = 0x1c6b_47d0_9e35_22af;
/// Static rating of a row over number, length and diameter of its rollers, Pa, without the share of the diameter in the pitch diameter.
const RATING: f64 = 44e6;
/// Stiffness of a line contact over its length, Pa.
const STIFFNESS: f64 = 2e10;

/// Sizes of a bearing, m.
struct Sizes {
    pitch: f64,
    radius: f64,
    count: usize,
    /// Of a roller over both ends and of its contacts.
    length: f64,
    effective: f64,
    clearance: f64,
    end_play: f64,
}

impl Sizes {
    fn of(draw: &mut Draw) -> Self {
        let pitch = draw.log(5e-3, 0.5);
        let radius = pitch * draw.within(0.07, 0.2);
        let most = 0.95 * PI * pitch / radius;
        let count = (most * draw.within(0.5, 0.92)).floor().max(5.0) as usize;
        let length = radius * draw.within(1.8, 4.0);
        let effective = length * draw.within(0.88, 0.97);
        let clearance = pitch * draw.log(1e-4, 3e-3);
        let clearance = if draw.chance(0.07) { -0.2 * clearance.min(2e-4) } else { clearance };
        Self { pitch, radius, count, length, effective, clearance, end_play: draw.log(20e-6, 150e-6) }
    }

    fn mass_of_roller(&self) -> f64 {
        7830.0 * PI * self.radius * self.radius * self.length
    }

    /// Half of the room between neighbours, m.
    fn room(&self) -> f64 {
        self.pitch * (PI / self.count as f64).sin() - self.radius
    }
}

/// A scene of `duration` s for this number, the same on every machine.
pub fn scene(number: u64, duration: f64) -> Value {
    let draw = &mut Draw(Random::new(number.wrapping_mul(0x5851_f42d_4c95_7f2d) ^ STREAM));
    let sizes = Sizes::of(draw);
    let load = RATING * sizes.count as f64 * sizes.effective * 2.0 * sizes.radius * draw.log(5e-4, 0.25);
    let speed =
        draw.log(SPEEDS[0], SPEEDS[1]) / (2.0 * sizes.pitch) * if draw.chance(0.5) { 1.0 } else { -1.0 };
    let ribs = list_of_ribs(draw);
    let against = held_against(&ribs);
    let mut scene = json!({
        "schema": "cagedyn.scene/1",
        "title": format!("rollers in space, random scene {number}"),
        "gravity": {"y": 0.0, "z": -9.80665},
        "materials": materials(),
        "lubricant": draw.oil(),
        "rollers": rollers(draw, &sizes, load),
        "outer_ring": {"raceway_radius": sizes.pitch + sizes.radius + 0.25 * sizes.clearance, "material": "steel"},
        "inner_ring": {
            "radial_clearance": sizes.clearance, "material": "steel",
            "speed": if draw.chance(0.85) { json!({"constant": speed}) } else { draw.signal(speed, duration, 300.0) },
            "motion": {"space": ring(draw, &sizes, &ribs, load, duration)}
        },
        "raceways": {"contact": draw.line([2e-7, 2e-6])},
        "initial": {
            "inner_ring": if draw.chance(0.85) && against.is_none() { "equilibrium" } else { "centred" },
            "first_roller_angle": draw.angle()
        },
        "record": {"duration": duration, "interval": 1e-4}
    });
    if draw.chance(0.2) {
        scene["outer_ring"]["speed"] = json!({"constant": speed * draw.within(-1.0, 1.0)});
    }
    if draw.chance(0.8) {
        scene["raceways"]["slices"] = json!(2 + draw.0.index(15));
    }
    if draw.chance(0.7) {
        // Without the drag of sliding in the inlet it turns unloaded rollers backwards.
        scene["raceways"]["rolling_resistance"] = json!({"extent": "all", "inlet_sliding": {}});
    }
    if !ribs.is_empty() {
        scene["ribs"] = json!({
            "end_play": sizes.end_play, "list": shaped(draw, &sizes, &ribs), "contact": ends(draw, [1e-6, 5e-6])
        });
    }
    crowned(draw, &sizes, &mut scene);
    if draw.chance(0.9) {
        scene["cage"] = cage(draw, &sizes, &ribs, duration);
        grease(draw, &mut scene);
    }
    scene
}

/// Ribs as rings and signs of their sides: of an NU, N, NJ, NUP or NF bearing, or none.
fn list_of_ribs(draw: &mut Draw) -> Vec<(&'static str, f64)> {
    let (outer, inner) = (|side: f64| ("outer", side), |side: f64| ("inner", side));
    let side = if draw.chance(0.5) { 1.0 } else { -1.0 };
    match draw.0.index(12) {
        0..=3 => vec![outer(1.0), outer(-1.0)],
        4 | 5 => vec![inner(1.0), inner(-1.0)],
        6 | 7 => vec![outer(1.0), outer(-1.0), inner(side)],
        8 | 9 => vec![outer(1.0), outer(-1.0), inner(1.0), inner(-1.0)],
        10 => vec![inner(1.0), inner(-1.0), outer(side)],
        _ => vec![],
    }
}

/// These ribs with angles and heights, both the same as a rule.
fn shaped(draw: &mut Draw, sizes: &Sizes, ribs: &[(&'static str, f64)]) -> Vec<Value> {
    let shape = |draw: &mut Draw| {
        let angle = if draw.chance(0.2) { 0.0 } else { draw.within(1e-3, 25e-3) };
        (angle, sizes.radius * draw.within(0.2, 0.6))
    };
    let of_all = shape(draw);
    let same = draw.chance(0.8);
    let one = |&(ring, side): &(&str, f64)| {
        let (angle, height) = if same { of_all } else { shape(draw) };
        let side = if side > 0.0 { "positive" } else { "negative" };
        json!({"ring": ring, "side": side, "angle": angle, "height": height})
    };
    ribs.iter().map(one).collect()
}

/// Along which direction a free ring may be pushed so that ribs hold it: one sign, any (0), or none.
fn held_against(ribs: &[(&'static str, f64)]) -> Option<f64> {
    let of = |ring: &str| ribs.iter().filter(|rib| rib.0 == ring).collect::<Vec<_>>();
    match (of("outer").as_slice(), of("inner").as_slice()) {
        ([], _) | (_, []) => None,
        ([_, _], [_, _]) => Some(0.0),
        ([_, _], [inner]) => Some(-inner.1),
        ([outer], _) => Some(outer.1),
        _ => None,
    }
}

/// Laws of ends with this damping, s.
fn ends(draw: &mut Draw, [shortest, longest]: [f64; 2]) -> Value {
    let mut laws = json!({});
    if draw.chance(0.9) {
        laws["damping"] = json!({"relaxation_time": draw.log(shortest, longest), "softening_depth": 1e-8});
    }
    if draw.chance(0.9) {
        laws["film"] = json!("hamrock_dowson");
        laws["traction"] = json!("muraki_kimura");
        for (field, law) in [("thermal_correction", "gupta"), ("self_heating", "film_and_flash")] {
            if draw.chance(0.7) {
                laws[field] = json!(law);
            }
        }
        if draw.chance(0.8) {
            let mut friction = draw.friction();
            friction["roughness"] = json!(draw.log(0.03e-6, 1e-6));
            friction["lambda_boundary"] = json!(0.06);
            friction["lambda_full"] = json!(3.0);
            laws["boundary_friction"] = friction;
        }
    }
    laws
}

/// Rollers of any profile.
fn rollers(draw: &mut Draw, sizes: &Sizes, load: f64) -> Value {
    let (mass, radius) = (sizes.mass_of_roller(), sizes.radius);
    let cap = if draw.chance(0.2) { draw.log(10.0, 50.0) } else { draw.log(0.2, 20.0) };
    let mut rollers = json!({
        "count": sizes.count, "radius": radius, "effective_length": sizes.effective, "mass": mass,
        "inertia": 0.5 * mass * radius * radius, "material": "steel",
        "space": {
            "length": sizes.length,
            "ends": {"cap_radius": cap.max(radius), "face_radius": radius * draw.within(0.82, 0.96)}
        }
    });
    if draw.chance(0.25) {
        rollers["space"]["slices_on"] = json!("whole");
    }
    let crown = |drop: f64| sizes.effective * sizes.effective / (8.0 * drop);
    match draw.0.index(5) {
        0 | 1 => {
            let design = draw.log(0.5, 5.0) * 4.6 * load / sizes.count as f64;
            let mut profile = json!({"design_load": design, "crowned_share": draw.within(0.3, 1.0)});
            if draw.chance(0.5) {
                profile["end_drop"] = json!(draw.log(3e-6, 30e-6));
            }
            rollers["profile"] = json!({ "logarithmic": profile });
        }
        2 => {
            let radius = crown(draw.log(1e-6, 20e-6)).max(2.0 * sizes.effective);
            rollers["profile"] = json!({"circular_crown": {"radius": radius}});
        }
        _ => {}
    }
    if draw.chance(0.3) {
        let largest = draw.log(0.1e-6, 5e-6).min(1e-3 * radius).min(0.3 * sizes.room());
        rollers["radius_deviations"] = if draw.chance(0.5) {
            json!({"each": (0..sizes.count).map(|_| draw.within(-largest, largest)).collect::<Vec<_>>()})
        } else {
            json!({"groups": [{"rollers": [draw.0.index(sizes.count)], "deviation": largest}]})
        };
    }
    rollers
}

/// A crown of a raceway now and then.
fn crowned(draw: &mut Draw, sizes: &Sizes, scene: &mut Value) {
    for ring in ["outer_ring", "inner_ring"] {
        if draw.chance(0.12) {
            let radius = sizes.effective * sizes.effective / (8.0 * draw.log(1e-6, 10e-6));
            scene[ring]["raceway_crown_radius"] = json!(radius.max(2.0 * sizes.effective));
        }
    }
}

/// A ring with any of its coordinates free, held off the middle or moved, under a radial load, and along the axis if ribs hold it.
fn ring(draw: &mut Draw, sizes: &Sizes, ribs: &[(&'static str, f64)], load: f64, duration: f64) -> Value {
    let place = 0.2 * sizes.clearance.abs() + 5e-5 * sizes.pitch;
    let misaligned = draw.log(1e-4, 5e-3);
    // With ribs on both rings a ring has no room to tilt further than by the play at their radius.
    let against = held_against(ribs);
    let most = 0.3 * sizes.end_play / sizes.pitch;
    let tilt = if against.is_some() { misaligned.min(most) } else { misaligned };
    let coordinate = |draw: &mut Draw, size: f64| draw.coordinate(size, 8);
    let direction = draw.angle();
    let lever = if against.is_some() { 0.01 } else { 0.1 };
    let moment = lever * load * sizes.effective * draw.within(-1.0, 1.0);
    let mass = sizes.count as f64 * sizes.mass_of_roller() * draw.log(1.0, 20.0);
    let transverse = mass * sizes.pitch * sizes.pitch * draw.within(0.3, 1.0);
    let stiffness = STIFFNESS * sizes.effective;
    let radial = |draw: &mut Draw, size: f64| draw.signal(size, duration, 1e3);
    let mut loads = json!({
        "y": radial(draw, load * direction.cos()), "z": radial(draw, load * direction.sin()),
        "moment_y": radial(draw, moment)
    });
    let along = match against {
        Some(sign) if draw.chance(0.8) => {
            let sign = if sign == 0.0 { draw.within(-1.0, 1.0) } else { sign };
            let thrust = sign * load * draw.log(1e-3, 0.2);
            loads["x"] = draw.signal(thrust, duration, 1e3);
            json!("free")
        }
        // Held as far as the ribs of both rings leave it room.
        Some(_) => json!({"held": sizes.end_play * draw.within(-0.4, 0.4)}),
        None => json!({"held": 1e-3 * sizes.radius * draw.within(-1.0, 1.0)}),
    };
    let mut space = json!({
        "x": along,
        "y": coordinate(draw, place), "z": coordinate(draw, place),
        "tilt_y": coordinate(draw, tilt), "tilt_z": coordinate(draw, tilt),
        "load": loads,
        "mass": mass,
        "inertia": {"polar": transverse * draw.within(0.5, 1.9), "transverse": transverse},
    });
    if draw.chance(0.8) {
        space["support_damping"] = json!(draw.log(0.05, 1.0) * (stiffness * mass).sqrt());
        space["tilt_damping"] =
            json!(draw.log(0.01, 0.3) * 0.3 * sizes.effective * (stiffness * transverse).sqrt());
    }
    space
}

/// A cage that tilts among the rollers, which starts upright: rollers that go with a tilted inner ring need room in it.
fn cage(draw: &mut Draw, sizes: &Sizes, ribs: &[(&'static str, f64)], duration: f64) -> Value {
    let Sizes { pitch, radius, .. } = *sizes;
    let mass = draw.log(0.05, 0.35) * sizes.count as f64 * sizes.mass_of_roller();
    let inertia = draw.within(0.85, 1.05) * mass * pitch * pitch;
    let mut pocket = draw.pocket(radius, sizes.room(), mass);
    let holds = pocket["lubricated_cylinder"].is_object();
    let inner = draw.chance(0.3);
    let go_with_inner_ring = ribs.iter().filter(|rib| rib.0 == "inner").count() == 2 && ribs.len() < 4;
    if inner || go_with_inner_ring {
        // One that the inner ring guides starts in the middle of that ring, which loads press to one side.
        let room = 0.5 * sizes.clearance.max(0.0) + 3e-4 * pitch;
        let room = if go_with_inner_ring { room + 2.5e-3 * sizes.length } else { room };
        let room = room.min(0.8 * sizes.room());
        widen(&mut pocket, "/lubricated_cylinder/radial_clearance", room);
        widen(&mut pocket, "/solid_plane/diametral_clearance", 2.0 * room);
    }
    let place = if inner { pitch - 0.4 * radius } else { pitch + 0.4 * radius };
    let ring = if inner { "inner_ring" } else { "outer_ring" };
    let least = if inner { 1.5 * sizes.clearance.max(0.0) + 3e-3 * pitch } else { 0.0 };
    let width = radius * draw.log(0.2, 1.0);
    let mut guide = draw.guide(ring, place, least, width, mass);
    if guide.is_null() && !holds {
        guide = json!({
            "ring": "outer_ring", "guide_radius": pitch + 0.4 * radius, "diametral_clearance": 5e-3 * pitch,
            "solid": {"contact": draw.solid(mass)}
        });
    }
    let mut space = json!({"transverse_inertia": inertia * draw.within(0.501, 0.7)});
    let mut cage = json!({"mass": mass, "inertia": inertia, "material": "brass", "pocket": pocket});
    if guide.is_object() && draw.chance(0.75) {
        // Beside the rollers, on both sides or on one.
        let off = 0.5 * sizes.length + 0.5 * width + 0.1 * radius;
        let places = if draw.chance(0.8) { vec![-off, off] } else { vec![off] };
        let slices = 1 + draw.0.index(6);
        let land = |x: &f64| json!({"x": x, "width": width, "slices": slices, "guide": guide});
        space["lands"] = json!(places.iter().map(land).collect::<Vec<_>>());
    } else {
        cage["guide"] = guide;
    }
    if draw.chance(0.7) && !go_with_inner_ring {
        space["pocket_sides"] = json!({"play": draw.log(50e-6, 1e-3), "contact": ends(draw, [1e-6, 5e-6])});
    }
    if draw.chance(0.4) {
        let (eccentricity, angle) = (pitch * draw.log(1e-5, 1e-3), draw.angle());
        cage["mass_eccentricity"] = json!({"y": eccentricity * angle.cos(), "z": eccentricity * angle.sin()});
        space["mass_offset_x"] = json!(draw.within(-0.2, 0.2) * radius);
    }
    if draw.chance(0.2) {
        let size = mass * draw.log(1.0, 100.0);
        let [force, moment] = [size, 0.3 * size * pitch].map(|size| draw.signal(size, duration, 1e4));
        // Nothing holds a cage without sides along the axis.
        space["load"] = if space["pocket_sides"].is_object() {
            json!({"force_x": force, "moment_y": moment})
        } else {
            json!({ "moment_y": moment })
        };
    }
    if draw.chance(0.25) {
        cage["elastic_ring"] = elastic_ring(draw, (pitch, sizes.count), mass);
    }
    cage["space"] = space;
    cage
}

/// Makes a number of a pocket that large at least, if it has that one.
fn widen(pocket: &mut Value, path: &str, least: f64) {
    if let Some(number) = pocket.pointer_mut(path) {
        *number = json!(number.as_f64().unwrap_or(least).max(least));
    }
}

/// Soap or polymer in the layers of half of the guides that have one.
fn grease(draw: &mut Draw, scene: &mut Value) {
    let guides = [&scene["cage"]["guide"], &scene["cage"]["space"]["lands"][0]["guide"]];
    if guides.iter().any(|guide| guide["film"]["lubricant_layer"].is_object()) && draw.chance(0.5) {
        scene["lubricant"]["grease"] = draw.grease();
    }
}
