//! Bearings of balls that cannot be.

use super::table::*;
use serde_json::{Value, json};

pub fn rows() -> Vec<Row> {
    let (deep, angular) = (deep_groove(), angular_contact());
    let wave = |order: u32, amplitude: f64| json!([{"order": order, "amplitude": amplitude, "phase": 0.0}]);
    let motion = "inner_ring.motion.space";
    vec![
        deep.value(
            "groove below the radius of the balls",
            "inner_ring.groove_radius",
            json!(4.7e-3),
            &["0.0047 m", "0.0047625 m", "1.03 to 1.06"],
        ),
        angular.scene(
            "shoulder below the contact",
            &[("inner_ring.shoulder_height", json!(1e-3))],
            "inner_ring.shoulder_height",
            &["0.001 m", "too low", "leave the groove"],
        ),
        deep.value("groove in millimetres", "outer_ring.groove_radius", json!(5.0), &["5.0 m", "milli"]),
        deep.value("balls that overlap", "balls.count", json!(16), &["16 balls", "overlap"]),
        deep.scene(
            "clearance and contact angle",
            &[("balls.contact_angle", json!(0.3)), ("inner_ring.motion", json!({"space": {}}))],
            "inner_ring.radial_clearance",
            &["not allowed beside 'balls.contact_angle'"],
        ),
        deep.value(
            "clearance that lets balls climb",
            "inner_ring.radial_clearance",
            json!(1.9e-3),
            &["climb", "at most"],
        ),
        angular.value(
            "axial load the other way",
            "inner_ring.motion.space.load.x",
            json!({"constant": -100.0}),
            &["no axial stop"],
        ),
        deep.scene(
            "planar cage beside balls",
            &[("cage", json!({"mass": 0.01, "inertia": 1e-5}))],
            "cage.space",
            &["missing", "moves in space"],
        ),
        deep.value("wave of order zero", "outer_ring.waviness", wave(0, 1e-7), &["0 is not within 1 to 200"])
            .at("outer_ring.waviness.0.order"),
        deep.value("wave in micrometres", "inner_ring.waviness", wave(5, 0.5), &["0.5 m", "micro"])
            .at("inner_ring.waviness.0.amplitude"),
        deep.value("wave that is too steep", "inner_ring.waviness", wave(200, 5e-6), &["too steep", "0.01"]),
        deep.scene(
            "ring that jumps",
            &[(
                "inner_ring.motion.space.y",
                json!({"prescribed": {"step": {"before": 0.0, "after": 1e-5, "time": 0.1}}}),
            )],
            "inner_ring.motion.space.y.prescribed.step",
            &["no speed", "ramp"],
        ),
        deep.scene(
            "ring that is moved far",
            &[(
                "inner_ring.motion.space.tilt_y",
                json!({"prescribed": {"ramp": {"from": 0.0, "to": 1.0, "start": 0.0, "end": 1.0}}}),
            )],
            "inner_ring.motion.space.tilt_y.prescribed.ramp.to",
            &["1.0 rad"],
        ),
        deep.scene(
            "rotor that is no body",
            &[(&format!("{motion}.inertia"), json!({"polar": 1e-3, "transverse": 1e-4}))],
            "inner_ring.motion.space.inertia.polar",
            &["twice the transverse one"],
        ),
        deep.scene(
            "drag without oil",
            &[("balls.drag", json!({"density": 40.0})), ("lubricant", Value::Null), ("raceways", json!({}))],
            "lubricant",
            &["'balls.drag' needs its viscosity"],
        ),
    ]
}
