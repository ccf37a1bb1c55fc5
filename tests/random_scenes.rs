//! Random scenes and random damage to a scene: nothing panics, nothing is NaN, failures say why.

mod common;

use cagedyn::{Error, Model, Recording, Scene, Sim, Status};
use common::{Random, example, example_text, read as read_file, set};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestError, TestRng, TestRunner};
use serde_json::{Value, json};
use std::cell::{Cell, RefCell};
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::sync::Arc;

/// A runner that tries the same cases on every machine and writes no files; PROPTEST_CASES asks for more.
fn runner(cases: u32) -> TestRunner {
    runner_from(0, cases)
}

/// The same with other cases for every seed.
fn runner_from(seed: u8, cases: u32) -> TestRunner {
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|text| text.parse().ok());
    let cases = cases.max(asked.unwrap_or(0));
    let config = Config { cases, failure_persistence: None, max_shrink_iters: 200, ..Config::default() };
    TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]))
}

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
        magnitude(1e-7, 1e-3).prop_map(|tolerance| json!({"rosenbrock": {"tolerance": tolerance}})),
        magnitude(1e-7, 1e-3).prop_map(|tolerance| json!({"radau": {"tolerance": tolerance}})),
    ]
    .prop_map(|method| json!({"method": method, "min_step": 1e-13, "max_steps": 1_500}))
}

/// Puts rollers between two rings, without a cage now and then.
fn add_rollers(scene: &mut Value, sizes: Sizes, ring: (Value, &str), raceways: Value, caged: bool) {
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
    if !caged {
        scene["cage"] = Value::Null;
        scene["initial"] = json!({"inner_ring": ring.1});
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
fn scene() -> impl Strategy<Value = Value> {
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
    let kind = (any::<bool>(), element_motion(), any::<bool>(), 0..5);
    let start = (-3.0..3.0f64, -0.05..0.05f64, proptest::option::of(-500.0..500.0f64));
    (bearing, raceways, flow, ring(), kind, solver(), start).prop_map(
        |((sizes, (cage, offset)), raceways, flow, ring, kind, solver, (angle, velocity, cage_speed))| {
            let (speed, viscosity, weight) = flow;
            let (kinematic, motion, bare, absent) = kind;
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
                add_rollers(&mut scene, sizes, ring, raceways, absent > 0);
            }
            scene
        },
    )
}

/// What a scene combines: elements, pockets, and guide with its ring.
fn combination(scene: &Value) -> String {
    let key = |value: &Value| {
        value.as_object().and_then(|map| map.keys().next().cloned()).unwrap_or_else(|| "none".to_owned())
    };
    let elements = match &scene["kinematic_elements"]["motion"] {
        Value::Null => "rollers".to_owned(),
        motion => key(motion),
    };
    let cage = &scene["cage"];
    if cage.is_null() {
        return format!("{elements}, no cage");
    }
    let guide = match &cage["guide"] {
        Value::Null => "no guide".to_owned(),
        guide => {
            let solid = if guide["solid"].is_null() { "" } else { " and solid" };
            format!("film {}{solid} on {}", key(&guide["film"]), guide["ring"])
        }
    };
    format!("{elements}, pocket {}, {guide}", key(&cage["pocket"]))
}

/// How often each combination came up.
type Counts = RefCell<BTreeMap<String, u32>>;

fn count(counts: &Counts, what: String) {
    *counts.borrow_mut().entry(what).or_insert(0) += 1;
}

/// Panics with the scene that failed as JSON.
fn report(result: Result<(), TestError<Value>>) {
    match result {
        Ok(()) => {}
        Err(TestError::Fail(reason, scene)) => panic!("{reason}\n{scene}"),
        Err(e) => panic!("{e}"),
    }
}

/// Fails unless an error is one of a run and has a message of one line.
fn check_error(error: &Error, allowed: &[Status]) -> Result<(), TestCaseError> {
    prop_assert!(allowed.contains(&error.status), "{:?}: {error}", error.status);
    prop_assert!(!error.message.trim().is_empty());
    prop_assert!(!error.message.contains(['\n', '\r']), "{error}");
    Ok(())
}

fn check_finite(what: &str, names: &[String], values: &[f64]) -> Result<(), TestCaseError> {
    for (name, value) in names.iter().zip(values) {
        prop_assert!(value.is_finite(), "{what}: {name} is {value}");
    }
    Ok(())
}

/// Runs a scene; whether it reached its end.
fn run(scene: &Value) -> Result<bool, TestCaseError> {
    let model = Model::from_json(&scene.to_string());
    let model = Arc::new(model.map_err(|e| TestCaseError::fail(format!("refused: {e}")))?);
    let names: Vec<String> = model.state_infos().into_iter().map(|info| info.name).collect();
    let mut sim = match Sim::new(model.clone()) {
        Ok(sim) => sim,
        Err(e) => {
            check_error(&e, &[Status::BadScene, Status::BadState])?;
            return Ok(false);
        }
    };
    check_finite("initial state", &names, sim.state())?;
    let mut recording = Recording::default();
    let record = &model.scene().record;
    let result = recording.run(&mut sim, record.duration, record.interval, |_| true);
    if let Err(e) = &result {
        check_error(e, &[Status::StepTooSmall, Status::TooManySteps, Status::BadState])?;
        prop_assert!(e.message.starts_with("at t = "), "{e}");
    }
    check_finite("state", &names, sim.state())?;
    let channels: Vec<String> = sim.channels().iter().map(|channel| channel.name.clone()).collect();
    for (name, column) in channels.iter().zip(&recording.columns) {
        prop_assert!(column.iter().all(|x| x.is_finite()), "{name}: {column:?}");
        prop_assert_eq!(column.len(), recording.times.len());
    }
    if result.is_ok() {
        prop_assert_eq!(recording.times.len(), 11);
        prop_assert_eq!(sim.time(), record.duration);
    }
    Ok(result.is_ok())
}

/// Runs a scene that runs from a state that differs in its last digits.
fn run_nearby(scene: &Value, seed: u64) -> Result<(), TestCaseError> {
    // Chaotic runs may take more steps.
    let scene = common::with(scene, &[("solver.max_steps", json!(400_000))]);
    let model = Model::from_json(&scene.to_string()).map_err(|e| TestCaseError::fail(e.to_string()))?;
    let duration = model.scene().record.duration;
    let scales = model.state_scales();
    let mut sim = Sim::new(Arc::new(model)).map_err(|e| TestCaseError::fail(e.to_string()))?;
    let mut random = Random::new(seed);
    let nearby = |(x, scale): (&f64, &f64)| x + 1e-12 * random.around_zero(1.0) * (x.abs() + scale);
    let state: Vec<f64> = sim.state().iter().zip(&scales).map(nearby).collect();
    let went = sim.set_state(0.0, &state).and_then(|()| sim.advance_to(duration));
    went.map_err(|e| TestCaseError::fail(format!("1e-12 away: {e}")))
}

/// Runs a thousand scenes, one in eight of those that reach their end again from nearby.
fn scenes_run_or_say_why_not(seed: u8) {
    let (finished, started) = (Cell::new(0), Cell::new(0));
    let failed = Counts::default();
    let result = runner_from(seed, 1000).run(&scene(), |scene| {
        started.set(started.get() + 1);
        if run(&scene)? {
            finished.set(finished.get() + 1);
            if finished.get() % 8 == 0 {
                run_nearby(&scene, finished.get())?;
            }
        } else {
            count(&failed, combination(&scene));
        }
        Ok(())
    });
    report(result);
    // Failures are an answer, but most scenes can be simulated.
    let (finished, started) = (finished.get(), started.get());
    println!("{finished} of {started} scenes reached their end");
    assert!(
        finished * 10 >= started * 8,
        "{finished} of {started} scenes reached their end; not: {failed:#?}"
    );
}

// Two tests, which run beside each other.

#[test]
fn random_scenes_run_or_say_why_not() {
    scenes_run_or_say_why_not(0);
}

#[test]
fn more_random_scenes_run_or_say_why_not() {
    scenes_run_or_say_why_not(1);
}

#[test]
fn random_scenes_are_of_every_kind() {
    let (kinds, laws) = (Counts::default(), Counts::default());
    let result = runner(4000).run(&scene(), |scene| {
        count(&kinds, combination(&scene));
        let mut all = Vec::new();
        paths(&scene, "", &mut all);
        all.retain(|path| {
            scene.pointer(&format!("/{}", path.replace('.', "/"))).is_some_and(|v| !v.is_null())
        });
        all.into_iter().for_each(|path| count(&laws, path));
        Ok(())
    });
    report(result);
    // Three kinds of motion, three of pockets, no guide or one of five on one of two rings; rollers without a cage.
    let kinds = kinds.borrow();
    assert_eq!(kinds.len(), 3 * 3 * (1 + 5 * 2) + 1, "{kinds:#?}");
    let laws = laws.borrow();
    for path in [
        "lubricant.viscosity.constant",
        "lubricant.viscosity.walther.temperature.over_time.table",
        "lubricant.viscosity.walther.temperature.over_speed",
        "cage.mass_eccentricity",
        "cage.load.torque",
        "cage.guide.roundness",
        "cage.guide.solid.asperity_height",
        "cage.guide.film.lubricant_layer.pressure_shear",
        "cage.pocket.lubricated_cylinder.contact.self_heating",
        "cage.pocket.solid_plane.contact.friction",
        "initial.cage_speed",
    ] {
        assert!(laws.contains_key(path), "no scene has {path}");
    }
}

#[test]
fn random_scenes_survive_writing_and_reading() {
    let result = runner(200).run(&scene(), |scene| {
        let scene = Scene::from_json(&scene.to_string()).map_err(|e| TestCaseError::fail(e.to_string()))?;
        let again = Scene::from_json(&scene.to_json()).map_err(|e| TestCaseError::fail(e.to_string()))?;
        prop_assert_eq!(scene, again);
        Ok(())
    });
    report(result);
}

/// Reads a text as a scene; accepted scenes must also have finite forces or a clean error at the start.
fn read(text: &str) -> Result<(), TestCaseError> {
    let model = match Model::from_json(text) {
        Ok(model) => Arc::new(model),
        Err(e) => return check_error(&e, &[Status::BadJson, Status::BadScene]),
    };
    match Sim::new(model) {
        Ok(mut sim) => {
            prop_assert!(sim.state().iter().all(|x| x.is_finite()));
            let mut out = vec![0.0; sim.channels().len()];
            let names: Vec<String> = sim.channels().iter().map(|channel| channel.name.clone()).collect();
            match sim.outputs(&mut out) {
                Ok(()) => check_finite("outputs", &names, &out),
                Err(e) => check_error(&e, &[Status::BadState]),
            }
        }
        Err(e) => check_error(&e, &[Status::BadScene, Status::BadState]),
    }
}

/// The text of one of the examples.
fn some_example(random: &mut Random) -> String {
    if random.chance(0.5) { example_text() } else { read_file("scenes/grease_guide.json") }
}

/// Deletes, doubles or alters up to three characters.
fn damaged_text(seed: u64) -> String {
    let mut random = Random::new(seed);
    let mut text: Vec<char> = some_example(&mut random).chars().collect();
    for _ in 0..=random.index(3) {
        let i = random.index(text.len());
        let any = |random: &mut Random| {
            let usual: Vec<char> = "0123456789.,:;eE+-{}[]\"\\ ntfu\n\0\u{e9}\u{1f600}".chars().collect();
            usual[random.index(usual.len())]
        };
        match random.index(5) {
            0 => drop(text.remove(i)),
            1 => text.insert(i, text[i]),
            2 => text[i] = any(&mut random),
            3 => text.insert(i, any(&mut random)),
            _ => {
                let end = (i + 1 + random.index(40)).min(text.len());
                let piece: Vec<char> = text[i..end].to_vec();
                if random.chance(0.5) {
                    text.splice(i..i, piece);
                } else {
                    text.drain(i..end);
                }
            }
        }
    }
    text.into_iter().collect()
}

/// Dotted paths of everything inside a JSON value.
fn paths(value: &Value, path: &str, list: &mut Vec<String>) {
    let mut inside = |key: &str, value: &Value| {
        let path = if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
        list.push(path.clone());
        paths(value, &path, list);
    };
    match value {
        Value::Object(map) => map.iter().for_each(|(key, value)| inside(key, value)),
        Value::Array(items) => items.iter().enumerate().for_each(|(i, value)| inside(&i.to_string(), value)),
        _ => {}
    }
}

/// An example with up to three values replaced by other values.
fn damaged_values(seed: u64) -> String {
    let mut random = Random::new(seed);
    let mut scene: Value = serde_json::from_str(&some_example(&mut random)).expect("an example is JSON");
    for _ in 0..=random.index(3) {
        let mut all = Vec::new();
        paths(&scene, "", &mut all);
        let path = &all[random.index(all.len())];
        let old = scene.pointer(&format!("/{}", path.replace('.', "/"))).cloned().unwrap_or(Value::Null);
        let other = &all[random.index(all.len())];
        let swapped = scene.pointer(&format!("/{}", other.replace('.', "/"))).cloned().unwrap_or(Value::Null);
        let new = match (random.index(8), old.as_f64()) {
            (0, _) => Value::Null,
            (1, _) => swapped,
            (2, _) => json!([old]),
            (3, Some(x)) => json!(-x),
            (4, Some(x)) => json!(x * 10f64.powf(random.around_zero(12.0))),
            (5, Some(_)) => {
                let odd = [0.0, -0.0, f64::MIN_POSITIVE, 5e-324, f64::MAX, f64::EPSILON, 1e18, -1e300];
                json!(odd[random.index(odd.len())])
            }
            (6, Some(x)) => json!(x * random.within(0.2, 3.0)),
            (_, Some(x)) => json!(x.to_string()),
            _ => json!("steel"),
        };
        set(&mut scene, path, new);
    }
    scene.to_string()
}

#[test]
fn damaged_texts_never_panic() {
    let result = runner(3000).run(&any::<u64>().prop_map(damaged_text), |text| read(&text));
    result.unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn damaged_values_never_panic() {
    let result = runner(3000).run(&any::<u64>().prop_map(damaged_values), |text| read(&text));
    result.unwrap_or_else(|e| panic!("{e}"));
}
