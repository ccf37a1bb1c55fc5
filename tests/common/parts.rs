//! Scenes made of every combination of parts.

use super::{example, set};
use serde_json::{Value, json};

/// Which parts a scene is made of.
#[derive(Clone, Copy, Debug)]
pub struct Parts {
    pub rollers: bool,
    pub guide: &'static str,
    pub inner_ring: bool,
    pub pocket: &'static str,
    pub unbalance: bool,
    pub roundness: bool,
    pub gravity: bool,
    /// Rollers that touch each other in the place of a cage.
    pub neighbours: bool,
}

/// Every combination that makes sense.
pub fn all() -> Vec<Parts> {
    let mut list = Vec::new();
    for rollers in [true, false] {
        for guide in ["none", "short bearing", "layer", "solid", "mixed short bearing", "mixed layer"] {
            for inner_ring in [false, true] {
                for pocket in ["none", "cylinder", "plane"] {
                    for flags in 0..8 {
                        let [unbalance, roundness, gravity] = [1, 2, 4].map(|bit| flags & bit != 0);
                        let film = guide.contains("layer") || guide.contains("short");
                        let sensible = (film || !roundness) && (guide != "none" || !inner_ring);
                        if sensible {
                            list.push(Parts {
                                rollers,
                                guide,
                                inner_ring,
                                pocket,
                                unbalance,
                                roundness,
                                gravity,
                                neighbours: false,
                            });
                        }
                    }
                }
            }
        }
    }
    for gravity in [false, true] {
        let [guide, pocket] = ["none"; 2];
        let [inner_ring, unbalance, roundness] = [false; 3];
        list.push(Parts {
            rollers: true,
            guide,
            inner_ring,
            pocket,
            unbalance,
            roundness,
            gravity,
            neighbours: true,
        });
    }
    list
}

fn solid() -> Value {
    json!({
        "stiffness": 1e7, "damping": 200.0, "softening_depth": 1e-6,
        "friction": {"coefficient": 0.1, "transition_speed": 0.01}
    })
}

fn guide(parts: Parts) -> Value {
    let radius = if parts.inner_ring { 35e-3 } else { 45e-3 };
    let ring = if parts.inner_ring { "inner_ring" } else { "outer_ring" };
    let mut guide = json!({"ring": ring, "guide_radius": radius, "diametral_clearance": 0.445e-3});
    if parts.guide.contains("short") {
        guide["film"] = json!({"short_bearing": {"land_width": 7e-3, "squeeze": true}});
    }
    if parts.guide.contains("layer") {
        let layer = json!({"land_width": 14e-3, "thickness": 100e-6, "pressure_shear": "with_edges"});
        guide["film"] = json!({"lubricant_layer": layer});
    }
    if parts.guide.contains("mixed") {
        guide["film_share"] = json!({"roughness": 1e-6});
    }
    if parts.guide.contains("mixed") || parts.guide == "solid" {
        guide["solid"] = json!({"contact": solid()});
    }
    if parts.roundness {
        guide["roundness"] = json!([{"order": 2, "amplitude": 10e-6, "phase": 0.3}]);
    }
    guide
}

/// The scene of these parts; the cage starts off the centre, so that thin films and solid contacts are met soon.
pub fn scene(parts: Parts) -> Value {
    let mut scene = example();
    scene["initial"]["cage"] = json!({"y": 0.1e-3, "z": -0.03e-3});
    scene["initial"]["cage_velocity"] = json!({"y": 0.08, "z": -0.05});
    if !parts.rollers {
        let rollers = scene["rollers"].clone();
        for part in ["rollers", "outer_ring", "raceways"] {
            scene.as_object_mut().unwrap().remove(part);
        }
        scene["kinematic_elements"] = json!({
            "count": 12, "radius": rollers["radius"], "pitch_radius": 39.99e-3, "material": "steel",
            "effective_length": rollers["effective_length"], "motion": {"rolling": {"contact_angle": 0.2}}
        });
        scene["inner_ring"] = json!({"speed": {"constant": -314.0}});
        scene["initial"]["inner_ring"] = json!("centred");
    }
    match parts.pocket {
        "none" => set(&mut scene, "cage.pocket", Value::Null),
        "plane" => {
            let plane = json!({"solid_plane": {"diametral_clearance": 0.3e-3, "contact": solid()}});
            set(&mut scene, "cage.pocket", plane);
        }
        _ => {}
    }
    set(&mut scene, "cage.guide", if parts.guide == "none" { Value::Null } else { guide(parts) });
    if parts.unbalance {
        scene["cage"]["mass_eccentricity"] = json!({"y": 50e-6, "z": -20e-6});
    }
    if !parts.gravity {
        scene["gravity"] = Value::Null;
    }
    if parts.neighbours {
        fill(&mut scene);
    }
    scene
}

/// Lets the rings of a scene move in one way after the other, as often as not in the ways of the scene itself.
pub fn move_rings(scene: &mut Value, parts: Parts, i: usize) {
    let swing = |amplitude: f64, frequency: f64| json!({"sine": {"mean": 0.2 * amplitude, "amplitude": amplitude, "frequency": frequency, "phase": 0.3}});
    let prescribed = || json!({"prescribed": {"y": swing(4e-6, 130.0), "z": swing(-7e-6, 90.0)}});
    let support = json!({
        "stiffness": {"yy": 3e7, "yz": 4e6, "zy": -2e6, "zz": 6e7},
        "damping": {"yy": 300.0, "yz": -20.0, "zy": 50.0, "zz": 900.0},
        "mass": {"yy": 0.4, "yz": 0.2, "zy": 0.2, "zz": 1.1}
    });
    let unbalance = json!({"moment": 2e-4, "phase": 0.8});
    if !parts.rollers {
        if i.is_multiple_of(2) {
            scene["inner_ring"]["motion"] = prescribed();
        }
        return;
    }
    match i % 8 {
        1 => {
            let load = json!({"y": {"constant": 40.0}, "z": swing(300.0, 70.0)});
            let free = json!({"mass": 2.5, "support": support, "load": load, "unbalance": unbalance});
            scene["outer_ring"]["motion"] = json!({ "free": free });
        }
        3 => scene["outer_ring"]["motion"] = prescribed(),
        5 => scene["inner_ring"]["motion"] = prescribed(),
        6 => {
            scene["inner_ring"]["motion"]["free"]["support"] = support.clone();
            scene["inner_ring"]["motion"]["free"]["unbalance"] = unbalance;
            scene["outer_ring"]["motion"] = json!({"free": {"mass": 1.5, "support": support}});
        }
        7 => {
            scene["inner_ring"]["motion"] = prescribed();
            scene["outer_ring"]["motion"] = prescribed();
        }
        _ => {}
    }
}

/// Gives raceways and single rollers of a scene waves, one after the other, as often as not none; whether it has any.
pub fn roughen(scene: &mut Value, parts: Parts, i: usize) -> bool {
    if !parts.rollers {
        return false;
    }
    let waves = json!([{"order": 2, "amplitude": 4e-6, "phase": 0.7}, {"order": 13, "amplitude": -6e-7, "phase": -0.2}]);
    let table =
        json!({"angles": [-0.4, 0.6, 1.9, 2.4, 4.0, 5.1], "heights": [0.0, 2e-6, -3e-6, 1e-6, 0.0, -1e-6]});
    let rollers = json!([
        {"rollers": [0, 2], "harmonics": [{"order": 3, "amplitude": 5e-7, "phase": 0.4}]},
        {"rollers": [5], "harmonics": [{"order": 2, "amplitude": 1e-6, "phase": 0.0}], "table": table}
    ]);
    match i % 7 {
        1 => scene["inner_ring"]["waviness"] = waves,
        3 => {
            scene["outer_ring"]["waviness"] = waves;
            scene["outer_ring"]["waviness_table"] = table.clone();
            scene["inner_ring"]["waviness_table"] = table;
        }
        5 => scene["rollers"]["waviness"] = rollers,
        6 => {
            scene["outer_ring"]["waviness"] = waves.clone();
            scene["inner_ring"]["waviness"] = waves;
            scene["rollers"]["waviness"] = rollers;
        }
        _ => return false,
    }
    true
}

/// Sixteen rollers in the place of the cage, with half a micrometre between neighbours.
fn fill(scene: &mut Value) {
    let contact = scene["raceways"]["contact"].clone();
    let sine = (std::f64::consts::PI / 16.0).sin();
    let raceway = scene["outer_ring"]["raceway_radius"].as_f64().unwrap();
    let radius = ((raceway - 10e-6) * sine - 0.25e-6) / (1.0 + sine);
    set(scene, "rollers.radius", json!(radius));
    set(scene, "rollers.count", json!(16));
    set(scene, "rollers.neighbours", json!({ "contact": contact }));
    scene.as_object_mut().unwrap().remove("cage");
    scene["initial"] = json!({"inner_ring": scene["initial"]["inner_ring"]});
}
