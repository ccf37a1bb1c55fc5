//! Pockets, guides, elastic rings and lumps of heat for bearings of any size.

use super::scenes::Draw;
use crate::bearings::{Bearing, STEEL};
use serde_json::{Value, json};
use std::f64::consts::PI;

/// Pitch radius of the bearings that contact stiffnesses of 1e6 to 5e7 N/m are usual for, m; they grow with the size.
const USUAL_PITCH: f64 = 40e-3;
/// Thinnest layer on a land, m: no thinner than a ground land is rough.
const LAYER: f64 = 1e-6;
/// How far a cage may sink into a solid contact under its weight, m.
const SAG: f64 = 5e-6;

/// Spring and damper against a cage of `mass` kg, 1 to 50 percent of critical damping.
fn solid(draw: &mut Draw, bearing: &Bearing, mass: f64) -> Value {
    let stiffness = draw.log(1e6, 5e7) * bearing.pitch() / USUAL_PITCH;
    let stiffness = stiffness.max(9.81 * mass / SAG);
    let critical = 2.0 * (stiffness * mass).sqrt();
    let mut contact = json!({
        "stiffness": stiffness, "damping": critical * draw.log(0.01, 0.5), "softening_depth": draw.log(1e-7, 3e-6)
    });
    if draw.chance(0.8) {
        contact["friction"] = draw.friction();
    }
    contact
}

/// Pockets of one of both kinds.
pub(super) fn pocket(draw: &mut Draw, bearing: &Bearing, mass: f64) -> Value {
    let clearance = (bearing.radius() * draw.log(4e-3, 5e-2)).min(0.6 * bearing.free());
    if draw.chance(0.5) {
        let contact = solid(draw, bearing, mass);
        return json!({"solid_plane": {"diametral_clearance": 2.0 * clearance, "contact": contact}});
    }
    json!({"lubricated_cylinder": {
        "radial_clearance": clearance, "half_angle": draw.within(0.2, 0.7), "edge_blend": 0.02,
        "edge_friction": draw.friction(), "contact": draw.line([5e-7, 5e-6])
    }})
}

/// A guide on either ring, with a film, a solid contact or both.
pub(super) fn guide(draw: &mut Draw, bearing: &Bearing, clearance: Option<f64>, mass: f64) -> Value {
    let inner = draw.chance(0.4);
    let side = draw.within(0.2, 0.7) * bearing.radius();
    let radius = if inner { bearing.pitch() - side } else { bearing.pitch() + side };
    // An inner ring that is pressed down by its clearance must not meet the cage there.
    let least = clearance.filter(|_| inner).map_or(0.0, |clearance| 1.5 * clearance + 1.5e-3 * radius);
    let play = (2.0 * radius * draw.log(1e-3, 8e-3)).max(least).min(0.02 * radius + least);
    let mut guide = json!({
        "ring": if inner { "inner_ring" } else { "outer_ring" }, "guide_radius": radius, "diametral_clearance": play
    });
    let width = bearing.radius() * draw.log(0.2, 1.5);
    let film = match draw.0.index(8) {
        0 | 1 => Value::Null,
        2 | 3 => json!({"short_bearing": {"land_width": width, "squeeze": draw.chance(0.95)}}),
        _ => {
            let thickness = play * draw.log(1e-3, 0.9);
            let shear = ["absent", "within_arc", "with_edges", "with_edges"][draw.0.index(4)];
            json!({"lubricant_layer": {"land_width": width, "thickness": thickness.max(LAYER), "pressure_shear": shear}})
        }
    };
    let filled = film["short_bearing"].is_object();
    if !filled || draw.chance(0.5) {
        guide["solid"] = json!({"contact": solid(draw, bearing, mass)});
        if !film.is_null() {
            guide["film_share"] = json!({"roughness": draw.log(0.03e-6, 1e-6).min(play / 24.0)});
        }
    }
    if !film.is_null() {
        if draw.chance(0.15) {
            let amplitude = draw.log(0.01, 0.3) * 0.5 * play;
            let order = 2 + draw.0.index(6);
            guide["roundness"] = json!([{"order": order, "amplitude": amplitude, "phase": draw.angle()}]);
        }
        guide["film"] = film;
    }
    guide
}

/// Bending of the ring of a cage of steel, brass or plastic with this pitch radius (m) and number of pockets.
pub(super) fn elastic_ring(draw: &mut Draw, (pitch, count): (f64, usize), mass: f64) -> Value {
    let most = 8.min(count / 2);
    let modes = 2 + draw.0.index(most - 1);
    let (young, density) = [(206e9, STEEL), (103e9, 8500.0), (6e9, 1400.0)][draw.0.index(3)];
    // A ring of rectangular section that weighs what the cage does without its pillars.
    let section = 0.5 * mass / (density * 2.0 * PI * pitch);
    let thickness = (section * draw.log(0.3, 3.0)).sqrt().min(0.9 * pitch / modes as f64).max(1.1e-4);
    json!({
        "modes": modes, "neutral_radius": pitch,
        "stiffness": {"section": {"young_modulus": young, "width": (section / thickness).max(2e-5), "thickness": thickness}},
        "damping": draw.log(0.005, 0.1), "growth": mass * pitch * pitch / (2.0 * PI * young * section)
    })
}

/// Four lumps and the surroundings, with temperatures that move or not.
pub(super) fn heat(draw: &mut Draw, bearing: &Bearing, scene: &Value) -> Value {
    let (rollers, pitch) = (scene["rollers"].is_object(), bearing.pitch());
    let width = 1e-3 * bearing.boundary[2];
    let ring = 460.0 * bearing.ring_mass().max(1e-4);
    let elements = 460.0 * bearing.count as f64 * bearing.element_mass();
    let surface = 2.0 * PI * pitch * width;
    let start = |draw: &mut Draw| draw.within(285.0, 360.0);
    let nodes = json!([
        {"name": "oil", "capacity": 1.7e6 * surface * bearing.radius() * draw.log(0.01, 0.3), "start": start(draw)},
        {"name": "inner_ring", "capacity": ring, "start": start(draw)},
        {"name": "outer_ring", "capacity": ring * draw.log(1.0, 10.0), "start": start(draw)},
        {"name": "elements", "capacity": elements, "start": start(draw)}
    ]);
    let mut links = vec![
        json!({"between": ["outer_ring", "elements"], "conductance": {"balls": 2.0}}),
        json!({"between": ["elements", "inner_ring"], "conductance": {"balls": 2.0}}),
        json!({"between": ["inner_ring", "ambient"], "conductance": {"constant": surface * draw.log(50.0, 5e3)}}),
        json!({"between": ["outer_ring", "ambient"], "conductance": {"constant": surface * draw.log(50.0, 5e3)}}),
    ];
    for name in ["inner_ring", "outer_ring", "elements"] {
        let conductance = if draw.chance(0.6) {
            json!({"splashed": {"area": surface, "specific_heat": 1920.0}})
        } else {
            json!({"constant": surface * draw.log(50.0, 2e3)})
        };
        links.push(json!({"between": ["oil", name], "conductance": conductance}));
    }
    let powers: &[&str] = if rollers {
        &[
            "raceway_friction",
            "raceway_damping",
            "rolling_resistance",
            "pocket_friction",
            "guide_film",
            "guide_solid",
        ]
    } else {
        &["pocket_friction", "pocket_damping", "guide_film", "guide_solid"]
    };
    let mut sources = Vec::new();
    for power in powers {
        let node = ["oil", "elements"][draw.0.index(2)];
        sources.push(json!({"power": power, "node": node, "share": draw.within(0.3, 1.0)}));
    }
    let mut heat = json!({
        "ambient": draw.within(285.0, 315.0), "lubricant": "oil", "nodes": nodes, "links": links, "sources": sources
    });
    if draw.chance(0.7) {
        let lumps = ["oil", "elements", "inner_ring", "outer_ring"];
        heat["in_motion"] = json!(lumps[..1 + draw.0.index(4)]);
        if draw.chance(0.5) {
            heat["own_time"] = json!(draw.log(3e-3, 1.0));
        }
    }
    if rollers && draw.chance(0.4) {
        heat["play"] = json!({
            "nodes": ["inner_ring", "outer_ring", "elements"], "expansion": 11.7e-6,
            "reference": draw.within(290.0, 330.0)
        });
    }
    heat
}
