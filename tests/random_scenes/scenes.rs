//! Random valid scenes of every kind.

use crate::common::example;
use proptest::prelude::*;
use serde_json::{Value, json};
use std::f64::consts::PI;

/// Logarithmically uniform.
fn magnitude(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.ln()..high.ln()).prop_map(f64::exp)
}

/// Optional laws of a contact, each on or off.
fn contact_laws() -> impl Strategy<Value = Value> {
    let damping = proptest::option::of((magnitude(1e-8, 1e-5), magnitude(1e-10, 1e-7)));
    let friction = proptest::option::of((0.0..0.3f64, magnitude(1e-3, 0.1), magnitude(1e-8, 2e-6)));
    (damping, any::<[bool; 4]>(), friction, any::<bool>()).prop_map(
        |(damping, [film, correction, traction, heating], friction, gupta)| {
            let mut laws = json!({});
            if let Some((time, depth)) = damping {
                laws["damping"] = json!({"relaxation_time": time, "softening_depth": depth});
            }
            if film {
                laws["film"] = json!("pan_hamrock");
            }
            if film && correction {
                laws["thermal_correction"] = json!(if gupta { "gupta" } else { "ghosh_pandey" });
            }
            if film && traction {
                laws["traction"] = json!("muraki_kimura");
            }
            if film && traction && heating {
                laws["self_heating"] = json!("film_and_flash");
            }
            if let (true, Some((coefficient, speed, roughness))) = (film, friction) {
                laws["boundary_friction"] = json!({
                    "coefficient": coefficient, "transition_speed": speed, "roughness": roughness,
                    "lambda_boundary": 0.06, "lambda_full": 3.0
                });
            }
            laws
        },
    )
}

/// Constant, jumping, growing, tabulated or (the last of the `kinds`) swinging, within `size` of `mean`.
fn signal_around(mean: f64, size: f64, kinds: u32) -> impl Strategy<Value = Value> {
    (0..kinds, -1.0..1.0f64, -1.0..1.0f64).prop_map(move |(kind, a, b)| {
        let (a, b) = (a * size, b * size);
        match kind {
            0 => json!({"constant": mean + a}),
            1 => json!({"step": {"before": mean + a, "after": mean + b, "time": 1e-4}}),
            2 => json!({"ramp": {"from": mean + a, "to": mean + b, "start": 2e-5, "end": 1.3e-4}}),
            4 => json!({"sine": {"mean": mean + a, "amplitude": b, "frequency": 2e3, "phase": 0.4}}),
            _ => json!({"table": {"time": [0.0, 3e-5, 1.1e-4], "value": [mean + a, mean, mean + b]}}),
        }
    })
}

fn signal(size: f64) -> impl Strategy<Value = Value> {
    signal_around(0.0, size, 5)
}

/// Sizes of elements that fit.
#[derive(Clone, Copy, Debug)]
struct Sizes {
    count: u32,
    radius: f64,
    pitch: f64,
    /// Radial internal clearance of rollers, m.
    clearance: f64,
}

impl Sizes {
    /// Half the gap between neighbours, m.
    fn free(&self) -> f64 {
        if self.count == 1 {
            self.radius
        } else {
            self.pitch * (PI / f64::from(self.count)).sin() - self.radius
        }
    }
}

fn sizes() -> impl Strategy<Value = Sizes> {
    (1..=40u32, magnitude(1e-3, 2e-2), 0.3..0.9f64, -1e-5..2e-4f64).prop_map(
        |(count, radius, filling, clearance)| {
            let spacing = (PI / f64::from(count.max(2))).sin();
            let pitch = (radius / (filling * spacing)).max(2.0 * radius);
            Sizes { count, radius, pitch, clearance }
        },
    )
}

/// Spring and damper, with friction or without.
fn solid_contact() -> impl Strategy<Value = Value> {
    let friction = proptest::option::of((0.0..0.3f64, magnitude(1e-3, 0.1)));
    let depth = prop_oneof![Just(0.0), magnitude(1e-8, 1e-5)];
    (magnitude(1e4, 1e8), prop_oneof![Just(0.0), magnitude(0.1, 100.0)], depth, friction).prop_map(
        |(stiffness, damping, depth, friction)| {
            let mut contact = json!({"stiffness": stiffness, "damping": damping, "softening_depth": depth});
            if let Some((coefficient, speed)) = friction {
                contact["friction"] = json!({"coefficient": coefficient, "transition_speed": speed});
            }
            contact
        },
    )
}

/// A pocket of one of both kinds, and its radial clearance.
fn pocket(sizes: Sizes) -> impl Strategy<Value = (Value, f64)> {
    let walls = (0.1..1.4f64, 0.0..0.1f64, any::<bool>(), contact_laws());
    (any::<bool>(), magnitude(0.002, 0.8), walls, solid_contact()).prop_map(
        move |(plane, share, (half_angle, blend, friction, contact), solid)| {
            let clearance = (share * sizes.free()).min(0.05 * sizes.radius);
            let friction = friction.then(|| json!({"coefficient": 0.1, "transition_speed": 0.02}));
            let pocket = if plane {
                json!({"solid_plane": {"diametral_clearance": 2.0 * clearance, "contact": solid}})
            } else {
                json!({"lubricated_cylinder": {
                    "radial_clearance": clearance, "half_angle": half_angle,
                    "edge_blend": blend, "edge_friction": friction, "contact": contact
                }})
            };
            (pocket, clearance)
        },
    )
}

/// Radial clearance of a pocket of any kind; infinite without one.
fn pocket_room(pocket: &Value) -> f64 {
    let plane = pocket["solid_plane"]["diametral_clearance"].as_f64().map(|x| 0.5 * x);
    let cylinder = pocket["lubricated_cylinder"]["radial_clearance"].as_f64();
    cylinder.or(plane).unwrap_or(f64::INFINITY)
}

/// A guide of any law on any ring, and its radial clearance.
fn guide(sizes: Sizes) -> impl Strategy<Value = (Value, f64)> {
    let film = (0..3, any::<bool>(), 0..3usize, magnitude(0.02, 2.0), proptest::option::of(0.1..0.99f64));
    let solid = (any::<bool>(), solid_contact(), proptest::option::of(0.0..0.2f64), magnitude(1e-2, 1.0));
    let roundness = proptest::option::of((2..9u32, -0.3..0.3f64));
    (magnitude(2e-3, 2e-2), any::<bool>(), film, solid, roundness).prop_map(
        move |(share, inner, (film, squeeze, shear, filling, cap), (with_solid, solid, height, rough), round)| {
            let pitch = sizes.pitch;
            let clearance = (share * pitch).min(9e-3);
            let land_width = 0.1 * pitch;
            let mut guide = json!({
                "guide_radius": pitch + if inner { -0.5 } else { 0.5 } * sizes.radius,
                "diametral_clearance": clearance,
                "ring": if inner { "inner_ring" } else { "outer_ring" }
            });
            if film == 1 {
                guide["film"] = json!({"short_bearing": {"land_width": land_width, "squeeze": squeeze}});
            }
            if film == 2 {
                let words = ["absent", "within_arc", "with_edges"];
                guide["film"] = json!({"lubricant_layer": {
                    "land_width": land_width, "thickness": filling * clearance, "pressure_shear": words[shear],
                    "pressure_cap": cap.unwrap_or(0.9)
                }});
            }
            if let (true, Some((order, a))) = (film > 0, round) {
                let harmonic = json!({"order": order, "amplitude": 0.5 * a * clearance, "phase": 1.0});
                guide["roundness"] = json!([harmonic]);
            }
            if film == 0 || with_solid {
                guide["solid"] = json!({"contact": solid});
                if let Some(height) = height {
                    guide["solid"]["asperity_height"] = json!(height * clearance);
                }
            }
            if film > 0 && with_solid {
                guide["film_share"] = json!({"roughness": (rough * clearance / 12.0).max(1e-9)});
                if let Some(height) = height {
                    guide["film_share"]["touching_ratio"] = json!(5.0 * height);
                }
            }
            (guide, 0.5 * clearance)
        },
    )
}

/// The cage with its pocket and guide, or none, and how far off centre it may start.
fn cage(sizes: Sizes) -> impl Strategy<Value = (Value, f64)> {
    let parts =
        (proptest::option::weighted(0.8, pocket(sizes)), proptest::option::weighted(0.8, guide(sizes)));
    let unbalance = proptest::option::of((-0.01..0.01f64, -0.01..0.01f64));
    let load = proptest::option::of((signal(20.0), signal(20.0), signal(2.0), any::<bool>()));
    (parts, magnitude(0.01, 3.0), unbalance, load, 0.0..0.6f64).prop_map(
        move |((pocket, guide), mass, unbalance, load, start)| {
            let pitch = sizes.pitch;
            let room = pocket.as_ref().map_or(f64::INFINITY, |(_, clearance)| *clearance);
            let start = guide.as_ref().map_or(0.0, |(_, clearance)| start * clearance.min(room));
            let mut cage = json!({
                "mass": mass, "inertia": 0.9 * mass * pitch * pitch, "material": "brass",
                "pocket": pocket.map(|(pocket, _)| pocket), "guide": guide.map(|(guide, _)| guide)
            });
            if let Some((y, z)) = unbalance {
                cage["mass_eccentricity"] = json!({"y": y * pitch, "z": z * pitch});
            }
            if let Some((y, z, torque, all)) = load {
                cage["load"] = if all {
                    json!({"force_y": y, "force_z": z, "torque": torque})
                } else {
                    json!({"force_z": z})
                };
            }
            (cage, start)
        },
    )
}

/// Viscosity: constant, or from a temperature that follows time or speed. The amplitude of a sine has the range of a
/// temperature, which leaves no moderate one.
fn viscosity() -> impl Strategy<Value = Value> {
    let points = (magnitude(2e-5, 1e-3), 0.05..0.5f64, 700.0..1000.0f64);
    let over_speed = (magnitude(1.0, 300.0), 300.0..350.0f64, 300.0..350.0f64);
    (0..3, magnitude(1e-3, 1.0), points, signal_around(330.0, 25.0, 4), over_speed).prop_map(
        |(kind, constant, (cold, ratio, density), over_time, (speed, t0, t1))| {
            let temperature = match kind {
                0 => return json!({"constant": constant}),
                1 => json!({"over_time": over_time}),
                _ => json!({"over_speed": {"speed": [0.0, speed], "temperature": [t0, t1]}}),
            };
            json!({"walther": {
                "cold": {"temperature": 313.15, "kinematic_viscosity": cold},
                "hot": {"temperature": 373.15, "kinematic_viscosity": ratio * cold},
                "density": density, "temperature": temperature
            }})
        },
    )
}

/// Ring motion and whether it starts in equilibrium.
fn ring() -> impl Strategy<Value = (Value, &'static str)> {
    let free = (magnitude(0.1, 100.0), proptest::option::of(magnitude(10.0, 1e5)), signal(2e4), signal(2e4));
    let load = (any::<bool>(), any::<bool>());
    (free, load, 0..4, -2e-5..2e-5f64).prop_map(|((mass, damping, y, z), (loaded, balanced), fixed, x)| {
        let load = if loaded { json!({"y": y, "z": z}) } else { Value::Null };
        let motion = json!({"free": {"mass": mass, "support_damping": damping, "load": load}});
        match fixed {
            0 => (json!({"fixed": {"y": x, "z": -x}}), "centred"),
            _ => (motion, if balanced { "equilibrium" } else { "centred" }),
        }
    })
}

fn solver() -> impl Strategy<Value = Value> {
    prop_oneof![
        Just(json!({"auto": {}})),
        magnitude(1e-7, 1e-3).prop_map(|tolerance| json!({"auto": {"tolerance": tolerance}})),
        Just(json!({"leapfrog": {}})),
        magnitude(1e-7, 2e-6).prop_map(|step| json!({"leapfrog": {"step": step}})),
        magnitude(1e-7, 1e-3).prop_map(|tolerance| json!({"dormand_prince": {"tolerance": tolerance}})),
        magnitude(1e-7, 1e-3).prop_map(|tolerance| json!({"adams": {"tolerance": tolerance}})),
        magnitude(1e-7, 1e-3).prop_map(|tolerance| json!({"rosenbrock": {"tolerance": tolerance}})),
        magnitude(1e-7, 1e-3).prop_map(|tolerance| json!({"radau": {"tolerance": tolerance}})),
    ]
    .prop_map(|method| json!({"method": method, "min_step": 1e-13, "max_steps": 2_500}))
}

/// What keeps rollers apart.
#[derive(Clone, Copy, PartialEq)]
enum Apart {
    Cage,
    Neighbours,
    Nothing,
}

/// Puts rollers between two rings, without a cage now and then.
fn add_rollers(scene: &mut Value, sizes: Sizes, ring: (Value, &str), raceways: Value, apart: Apart) {
    let Sizes { count, radius, pitch, clearance } = sizes;
    let mass = 7800.0 * PI * radius.powi(2) * 2.5 * radius;
    scene["rollers"] = json!({
        "count": count, "radius": radius, "effective_length": 2.4 * radius, "mass": mass,
        "inertia": 0.5 * mass * radius * radius, "material": "steel"
    });
    scene["outer_ring"]["raceway_radius"] = json!(pitch + radius + clearance / 4.0);
    scene["inner_ring"]["radial_clearance"] = json!(clearance);
    scene["inner_ring"]["material"] = json!("steel");
    scene["inner_ring"]["motion"] = ring.0;
    scene["initial"]["inner_ring"] = json!(ring.1);
    scene["raceways"] = raceways;
    if apart != Apart::Cage {
        scene["cage"] = Value::Null;
        scene["initial"] = json!({"inner_ring": ring.1});
    }
    if apart == Apart::Neighbours && count > 2 {
        scene["rollers"]["neighbours"] = json!({"contact": scene["raceways"]["contact"]});
    }
}

/// Puts kinematic elements in the place of the rollers; the inner ring goes where nothing needs it.
fn add_kinematic(scene: &mut Value, sizes: Sizes, ring: Value, motion: Value, bare: bool) {
    let rolling = motion["rolling"].is_object();
    let guided = scene["cage"]["guide"]["ring"] == "inner_ring";
    let over_speed = scene["lubricant"]["viscosity"]["walther"]["temperature"]["over_speed"].is_object();
    let elastic = scene["cage"]["pocket"]["lubricated_cylinder"].is_object();
    scene["kinematic_elements"] =
        json!({"count": sizes.count, "radius": sizes.radius, "pitch_radius": sizes.pitch, "motion": motion});
    if elastic || !bare {
        scene["kinematic_elements"]["material"] = json!("steel");
        scene["kinematic_elements"]["effective_length"] = json!(2.4 * sizes.radius);
    }
    for field in ["rollers", "outer_ring", "raceways"] {
        scene[field] = Value::Null;
    }
    if ring["fixed"].is_object() {
        scene["inner_ring"]["motion"] = ring;
    }
    if bare && !(rolling || guided || over_speed) {
        scene["inner_ring"] = Value::Null;
    }
}

/// Rolling or given speeds.
fn element_motion() -> impl Strategy<Value = Value> {
    (any::<bool>(), -1.2..1.2f64, signal(300.0), signal(3000.0)).prop_map(|(rolling, angle, orbit, spin)| {
        if rolling {
            json!({"rolling": {"contact_angle": angle}})
        } else {
            json!({"prescribed": {"orbit_speed": orbit, "spin_speed": spin}})
        }
    })
}

/// A valid scene of any kind.
pub fn scene() -> impl Strategy<Value = Value> {
    let bearing = sizes().prop_flat_map(|sizes| (Just(sizes), cage(sizes)));
    let raceways = (contact_laws(), proptest::option::of(proptest::option::of(magnitude(0.1, 100.0))))
        .prop_map(|(contact, rolling)| {
            let rolling = rolling.map(|threshold| match threshold {
                None => json!({"extent": "all"}),
                Some(threshold) => json!({"extent": {"loaded": {"threshold": threshold}}}),
            });
            json!({"contact": contact, "rolling_resistance": rolling})
        });
    let flow = (signal(1500.0), viscosity(), any::<bool>());
    let kind = (any::<bool>(), element_motion(), any::<bool>(), 0..15);
    let start = (-3.0..3.0f64, -0.05..0.05f64, proptest::option::of(-500.0..500.0f64));
    (bearing, raceways, flow, ring(), kind, solver(), start).prop_map(
        |((sizes, (cage, offset)), raceways, flow, ring, kind, solver, (angle, velocity, cage_speed))| {
            let (speed, viscosity, weight) = flow;
            let (kinematic, motion, bare, apart) = kind;
            let apart = match apart {
                0 => Apart::Nothing,
                1 | 2 => Apart::Neighbours,
                _ => Apart::Cage,
            };
            let mut scene = example();
            scene["title"] = json!("random");
            scene["gravity"] = if weight { scene["gravity"].take() } else { Value::Null };
            scene["lubricant"]["viscosity"] = viscosity;
            scene["inner_ring"] = json!({"speed": speed});
            scene["cage"] = cage;
            // A cage on a fixed inner ring starts around its centre, which stays within the pockets.
            let guided = scene["cage"]["guide"]["ring"] == "inner_ring";
            let moved = ring.0["fixed"]["y"].as_f64().filter(|_| guided).map_or(0.0, |x| {
                let largest = 0.25 * pocket_room(&scene["cage"]["pocket"]);
                x.clamp(-largest, largest)
            });
            let mut ring = ring;
            if moved != 0.0 {
                ring.0 = json!({"fixed": {"y": moved, "z": -moved}});
            }
            scene["initial"] = json!({
                "first_roller_angle": angle,
                "cage": {"y": moved + offset * angle.cos(), "z": -moved + offset * angle.sin()},
                "cage_velocity": {"y": velocity, "z": -velocity}, "cage_speed": cage_speed
            });
            scene["solver"] = solver;
            scene["record"] = json!({"duration": 2e-3, "interval": 2e-4});
            if kinematic {
                add_kinematic(&mut scene, sizes, ring.0, motion, bare);
            } else {
                add_rollers(&mut scene, sizes, ring, raceways, apart);
            }
            scene
        },
    )
}
