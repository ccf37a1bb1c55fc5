//! Rollers that skew and tilt: the plane as a limit, conservation, derivatives, skew by tilt, signs by mirrored runs.

use crate::conservation::{cancel, powers};
use crate::derivatives::{error, error_of_steps};
use crate::{model, states};
use cagedyn::equilibrium::{RaceControl, equilibrium};
use cagedyn::{Model, Sim};
use serde_json::{Value, json};
use std::sync::Arc;

const NU2310: &str = "scenes/nu2310.json";

/// Six freedoms of the rollers of the NU2310.
fn freedom() -> Value {
    json!({"length": 22e-3, "transverse_inertia": 1.66e-6, "ends": {"cap_radius": 0.6, "face_radius": 6.7e-3}})
}

/// A ring with these coordinates beside x, which is held, under a load down.
fn ring(coordinates: &[(&str, Value)]) -> Value {
    let mut ring = json!({
        "x": {"held": 0.0}, "y": "free", "z": "free", "tilt_y": "free", "tilt_z": "free",
        "mass": 3.0, "inertia": {"polar": 2.7e-3, "transverse": 1.875e-3},
        "support_damping": 3e3, "tilt_damping": 1.0, "load": {"z": {"constant": -4900.0}},
    });
    for (name, value) in coordinates {
        ring[*name] = value.clone();
    }
    json!({"space": ring})
}

/// The NU2310 without its cage, with rollers in space.
fn rollers(changes: &[(&str, Value)]) -> Arc<Model> {
    let all = [
        ("cage", Value::Null),
        ("rollers.space", freedom()),
        ("raceways.slices", json!(4)),
        ("inner_ring.motion", ring(&[])),
    ];
    model(NU2310, &[&all[..], changes].concat())
}

/// Places and drops of a table that is steeper at one end, m. Its curvature jumps at one place only, which no node comes near to.
fn drops() -> Value {
    json!({
        "places": [-11e-3, 0.0, 11e-3],
        "drops": [14e-6, 0.0, 18e-6],
    })
}

/// Rollers and outer raceway by tables, lengths and crowns that deviate, ribs.
fn shaped() -> Arc<Model> {
    let mut space = freedom();
    space["length_deviations"] =
        json!({"each": (0..12).map(|j| 1e-5 * f64::from(j - 6)).collect::<Vec<_>>()});
    space["crown_deviations"] =
        json!({"groups": [{"rollers": [1, 9], "deviation": 2e-6}, {"rollers": [10], "deviation": -1e-6}]});
    rollers(&[
        ("rollers.space", space),
        ("rollers.profile", json!({"table": drops()})),
        ("outer_ring.raceway_drops", drops()),
        ("raceways.slices", json!(8)),
        (
            "ribs",
            caged(&[]).scene().ribs.as_ref().map_or(Value::Null, |ribs| serde_json::to_value(ribs).unwrap()),
        ),
    ])
}

/// With everything that has a force: profile, deviations, a speed of both rings.
fn everything() -> Arc<Model> {
    rollers(&[
        (
            "rollers.profile",
            json!({"logarithmic": {"design_load": 5000.0, "crowned_share": 0.6, "end_drop": 12e-6}}),
        ),
        ("rollers.radius_deviations", json!({"groups": [{"rollers": [0, 4], "deviation": 1e-6}]})),
        ("inner_ring.raceway_crown_radius", json!(30.0)),
        ("outer_ring.speed", json!({"constant": 30.0})),
        ("raceways.slices", json!(8)),
    ])
}

fn place(model: &Model, name: &str) -> usize {
    model.state_infos().iter().position(|info| info.name == name).expect(name)
}

/// Without angles and shifts along the axis the accelerations are those of the plane.
#[test]
fn the_plane_is_a_limit() {
    let planar = model(NU2310, &[("cage", Value::Null)]);
    for slices in [2, 4, 8] {
        let spatial = rollers(&[("raceways.slices", json!(slices))]);
        let [mut sim, mut plane] = [&spatial, &planar].map(|model| Sim::new(model.clone()).unwrap());
        let (infos, of_plane) = (spatial.state_infos(), planar.state_infos());
        let mut worst: f64 = 0.0;
        // Rollers carry up to 33 kN and 190 kN in these states; what is left is round-off of that.
        let drawn = [(0.2, 2e-8), (1.0, 1e-7)]
            .map(|(spread, rest)| states(&plane, 40, spread, 11).into_iter().map(move |state| (state, rest)));
        for (state, rest) in drawn.into_iter().flatten() {
            let mut lifted = vec![0.0; infos.len()];
            for (info, x) in of_plane.iter().zip(&state) {
                lifted[place(&spatial, &info.name)] = *x;
            }
            let (mut rate, mut expected) = (vec![0.0; infos.len()], vec![0.0; state.len()]);
            sim.derivative(0.0, &lifted, &mut rate).unwrap();
            plane.derivative(0.0, &state, &mut expected).unwrap();
            let largest = |of: &str| {
                let all = of_plane.iter().zip(&expected).filter(|(info, _)| info.name.ends_with(of));
                all.map(|(_, x)| x.abs()).fold(1e-300, f64::max)
            };
            for (info, x) in infos.iter().zip(&rate) {
                let field = info.name.rsplit('.').next().unwrap();
                match of_plane.iter().position(|other| other.name == info.name) {
                    Some(k) => worst = worst.max((x - expected[k]).abs() / largest(field)),
                    // Skew and tilt of rollers, axial motion and tilts of the ring.
                    None => assert!(x.abs() < rest, "{}: {x}", info.name),
                }
            }
        }
        assert!(worst < 1e-9, "{slices}: {worst:e}");
    }
}

#[test]
fn forces_and_moments_cancel() {
    cancel(&everything(), 1e3);
    cancel(&shaped(), 1e3);
    for model in cages() {
        cancel(&model, 1e3);
    }
}

#[test]
fn powers_are_the_rate_of_the_energy() {
    // Of slices on the loaded part the energy is within the error of the rule; on the whole length to round-off.
    powers(&everything(), 1e-3);
    powers(&shaped(), 1e-3);
    let mut whole = freedom();
    whole["slices_on"] = json!("whole");
    powers(&rollers(&[("rollers.space", whole)]), 1e-7);
}

#[test]
fn derivatives_are_those_of_the_accelerations() {
    for model in [rollers(&[]), everything()] {
        let off = error(&model, 0.1);
        assert!(off < 1e-6, "{off}");
    }
    let off = error_of_steps(&shaped(), 0.1, &[1.0, 0.125]);
    assert!(off < 1e-6, "{off}");
}

/// Without friction and damping nothing is lost, and spins stay to the last bit.
#[test]
fn without_friction_nothing_is_lost() {
    let mut whole = freedom();
    whole["slices_on"] = json!("whole");
    let model = rollers(&[
        ("raceways", json!({"contact": {}, "slices": 8})),
        ("rollers.space", whole),
        ("inner_ring.motion", {
            let mut free = ring(&[]);
            for field in ["support_damping", "tilt_damping"] {
                free["space"].as_object_mut().unwrap().remove(field);
            }
            free
        }),
        ("solver", json!({"method": {"dormand_prince": {"tolerance": 1e-10}}})),
    ]);
    let mut sim = Sim::new(model.clone()).unwrap();
    let mut state = sim.state().to_vec();
    for j in 0..12 {
        let x = f64::from(j);
        for (name, size) in [("skew", 2e-3), ("tilt", 1e-3), ("tilt_speed", 3.0), ("axial_speed", 0.02)] {
            state[place(&model, &format!("roller[{j}].{name}"))] += size * (1.0 + x).sin();
        }
    }
    sim.set_state(0.0, &state).unwrap();
    sim.advance_to(5e-3).unwrap();
    for j in 0..12 {
        let spin = place(&model, &format!("roller[{j}].spin_speed"));
        assert_eq!(sim.state()[spin], state[spin]);
    }
    let balance = sim.power_balance().unwrap();
    let missing = balance.residual() / balance.energy[0].total();
    assert!(missing.abs() < 1e-8, "{missing}");
}

/// Damping lets the ends of rollers that rock go before they are apart: what they still hold is its loss.
#[test]
fn rollers_that_rock_lose_no_energy_without_a_power() {
    let mut whole = freedom();
    whole["slices_on"] = json!("whole");
    let model = rollers(&[
        ("rollers.space", whole),
        ("raceways.slices", json!(8)),
        ("raceways.contact.damping.relaxation_time", json!(2e-6)),
        ("solver", json!({"method": {"dormand_prince": {"tolerance": 1e-8}}})),
    ]);
    let mut sim = Sim::new(model.clone()).unwrap();
    let mut state = sim.state().to_vec();
    for j in 0..12 {
        state[place(&model, &format!("roller[{j}].tilt"))] += 2e-3;
    }
    sim.set_state(0.0, &state).unwrap();
    sim.advance_to(1e-4).unwrap();
    let missing = sim.power_balance().unwrap().relative_residual();
    println!("{missing:e}");
    assert!(missing.abs() < 1e-5, "{missing:e}");
}

/// A loaded roller that is tilted and rolls keeps the direction of its axis: sigma' = psi' tau. A skewed one stays so.
#[test]
fn a_tilted_roller_that_rolls_skews() {
    let still = |z: f64, tilt: f64| {
        let coordinates: Vec<(&str, Value)> = [("y", 0.0), ("z", z), ("tilt_y", tilt), ("tilt_z", 0.0)]
            .into_iter()
            .map(|(name, value)| (name, json!({"held": value})))
            .collect();
        ring(&coordinates)
    };
    let run = |z: f64, tilt: f64, skew: f64| {
        let model = rollers(&[
            ("inner_ring.motion", still(z, tilt)),
            ("raceways.rolling_resistance", Value::Null),
            ("raceways.slices", json!(8)),
            ("gravity", Value::Null),
            ("solver", json!({"method": {"dormand_prince": {"tolerance": 1e-8}}})),
        ]);
        let mut sim = Sim::new(model.clone()).unwrap();
        let mut state = sim.state().to_vec();
        let lowest = "roller[9]";
        let [at, tau] = ["skew", "tilt"].map(|name| place(&model, &format!("{lowest}.{name}")));
        state[at] = skew;
        sim.set_state(0.0, &state).unwrap();
        sim.advance_to(0.3e-3).unwrap();
        let first = sim.state()[at];
        sim.advance_to(0.8e-3).unwrap();
        let orbit = sim.state()[place(&model, &format!("{lowest}.orbit_speed"))];
        ((sim.state()[at] - first) / 0.5e-3, orbit * sim.state()[tau])
    };
    let (rate, rolled) = run(-27.316e-6, 1e-3, 0.0);
    println!("{rate} {rolled}");
    assert!((rate + 0.0639).abs() < 0.0002 && (rolled + 0.0636).abs() < 0.0003, "{rate} {rolled}");
    let (rate, _) = run(-28.235e-6, 0.0, 3e-3);
    println!("{rate}");
    assert!((rate + 0.003).abs() < 0.0006, "{rate}");
}

/// The NU2310 with ribs, a cage that tilts and touches everything, and on request one that bends.
fn caged(changes: &[(&str, Value)]) -> Arc<Model> {
    let all = [
        ("ribs.end_play", json!(1e-6)),
        ("cage.space.pocket_sides.play", json!(2e-6)),
        ("cage.pocket.lubricated_cylinder.radial_clearance", json!(2e-6)),
        ("cage.space.mass_offset_x", json!(1e-4)),
    ];
    model("scenes/nu2310_space.json", &[&all[..], changes].concat())
}

fn cages() -> [Arc<Model>; 4] {
    let bends = crate::elastic_ring(3);
    let plane = json!({"solid_plane": {
        "diametral_clearance": 4e-6,
        "contact": {
            "stiffness": 1e7, "damping": 50.0, "softening_depth": 1e-6,
            "friction": {"coefficient": 0.1, "transition_speed": 0.02},
        },
    }});
    let rib = |ring: &str, side: &str| json!({"ring": ring, "side": side, "angle": 0.01, "height": 2.5e-3});
    let all_ribs = json!([
        rib("outer", "positive"),
        rib("outer", "negative"),
        rib("inner", "positive"),
        rib("inner", "negative")
    ]);
    let free_along = [
        ("ribs.list", all_ribs),
        ("inner_ring.motion.space.x", json!("free")),
        ("inner_ring.motion.space.load.x", json!({"constant": 500.0})),
    ];
    [caged(&[]), caged(&free_along), caged(&[("cage.pocket", plane)]), caged(&[("cage.elastic_ring", bends)])]
}

#[test]
fn ribs_and_cages_keep_balance_and_have_exact_derivatives() {
    for (k, model) in cages().iter().enumerate() {
        powers(model, 2e-3);
        let off = error(model, 0.02);
        println!("{k}: {off:e}");
        assert!(off < 1e-5, "{k}: {off:e}");
    }
}

/// Reversing the shaft reverses the skew; clockwise with thrust on an inner ring with a rib at -x it is negative.
#[test]
fn thrust_pins_the_rollers_of_an_nj_bearing() {
    let rib = |ring: &str, side: &str| json!({"ring": ring, "side": side, "angle": 0.01, "height": 2.5e-3});
    let run = |speed: f64| {
        let model = model(
            "scenes/nu2310_space.json",
            &[
                (
                    "ribs.list",
                    json!([rib("outer", "positive"), rib("outer", "negative"), rib("inner", "negative")]),
                ),
                ("inner_ring.motion.space.x", json!("free")),
                ("inner_ring.motion.space.load.x", json!({"constant": 500.0})),
                ("inner_ring.speed", json!({"constant": speed})),
            ],
        );
        let mut sim = Sim::new(model.clone()).unwrap();
        sim.advance_to(0.03).unwrap();
        let outputs = |sim: &mut Sim, name: &str| {
            let place = model.channels().iter().position(|channel| channel.name == name).unwrap();
            sim.output(place).unwrap()
        };
        let (mut skew, mut tilt, mut n) = (0.0, 0.0, 0.0);
        for k in 0..40 {
            sim.advance_to(0.03 + 0.5e-3 * f64::from(k)).unwrap();
            skew += outputs(&mut sim, "rollers.mean_skew");
            tilt += outputs(&mut sim, "roller[9].tilt");
            n += 1.0;
        }
        (skew / n, tilt / n)
    };
    let [(clockwise, tilt), (counter, _)] = [-314.159, 314.159].map(run);
    println!("{clockwise:e} {counter:e} {tilt:e}");
    assert!((-0.2e-3..-0.05e-3).contains(&clockwise), "{clockwise}");
    assert!((clockwise + counter).abs() < 0.3 * clockwise.abs(), "{clockwise} {counter}");
}

/// Ribs of a tilted inner ring find the rollers between them at the start, and carry them round.
#[test]
fn rollers_start_between_the_ribs_of_a_tilted_inner_ring() {
    let rib = |side: &str| json!({"ring": "inner", "side": side, "angle": 0.01, "height": 2.5e-3});
    let model = model(
        "scenes/nu2310_space.json",
        &[
            ("cage", Value::Null),
            ("ribs.list", json!([rib("positive"), rib("negative")])),
            ("inner_ring.motion.space.tilt_y", json!({"held": 4e-3})),
            ("inner_ring.motion.space.tilt_z", json!({"held": -2e-3})),
            ("inner_ring.motion.space.x", json!({"held": 2e-4})),
        ],
    );
    let mut sim = Sim::new(model.clone()).unwrap();
    let forces = |sim: &mut Sim| {
        let mut out = vec![0.0; model.channels().len()];
        sim.outputs(&mut out).unwrap();
        let of_ribs =
            model.channels().iter().zip(out).filter(|(channel, _)| channel.name.contains("inner_rib"));
        of_ribs.map(|(_, force)| force).fold(0.0, f64::max)
    };
    assert_eq!(forces(&mut sim), 0.0);
    // Half of a turn of the rollers takes them 0.4 mm along the axis and back.
    let mut largest: f64 = 0.0;
    for k in 1..=100 {
        sim.advance_to(2.5e-4 * f64::from(k)).unwrap();
        largest = largest.max(forces(&mut sim));
    }
    println!("{largest}");
    assert!(largest > 0.0 && largest < 500.0, "{largest}");
}

#[test]
fn what_leaves_the_bearing_is_told() {
    let model = rollers(&[]);
    let mut sim = Sim::new(model.clone()).unwrap();
    let start = sim.state().to_vec();
    for (name, x, told) in [
        (
            "roller[3].skew",
            0.5,
            "roller[3] is askew in its bearing (its axis is turned by 5e-1 rad, at most 0.3 rad)",
        ),
        ("roller[4].orbit_travel", -0.3, "go through each other"),
        ("roller[5].axial_offset", 0.02, "roller[5] has left the bearing"),
    ] {
        let mut state = start.clone();
        state[place(&model, name)] += x;
        let mut rate = vec![0.0; state.len()];
        let error = sim.derivative(0.0, &state, &mut rate).unwrap_err();
        assert!(error.message.contains(told), "{error:?}");
    }
    sim.advance_to(1e-4).unwrap();
}

/// A table of a crown is the crown; a longer roller has less play between ribs, a flatter one presses on the ends.
#[test]
fn shapes_of_single_rollers_are_seen() {
    let half: f64 = 0.0102;
    let radius = 4.0;
    let circle = |s: f64| s * s / (radius + (radius * radius - s * s).sqrt());
    let places: Vec<f64> = (-15..=15).map(|i| f64::from(i) * half / 15.0).collect();
    let table =
        json!({"table": {"places": places, "drops": places.iter().map(|s| circle(*s)).collect::<Vec<_>>()}});
    let crown = json!({"circular_crown": {"radius": radius}});
    let loads = |profile: &Value, changes: &[(&str, Value)]| {
        let all = [
            &[("rollers.profile", profile.clone()), ("inner_ring.speed", json!({"constant": 0.0}))],
            changes,
        ]
        .concat();
        let found = equilibrium(&rollers(&all), RaceControl::None).unwrap();
        let numbers = |k: usize| found.contact_values.iter().map(|values| values[k]).collect::<Vec<_>>();
        [numbers(0), numbers(3)]
    };
    let [by_table, by_crown] = [&table, &crown].map(|profile| loads(profile, &[]));
    let largest = by_crown[0].iter().copied().fold(0.0, f64::max);
    for (a, b) in by_table[0].iter().zip(&by_crown[0]) {
        // Cubics between places follow the circle to a share of the square of their distance.
        assert!((a - b).abs() < 2e-3 * largest, "{a} {b}");
    }
    // A crown on the rollers as on all of them by deviations.
    let drop = circle(half);
    let deviations = json!({"each": vec![drop; 12]});
    let [by_deviation, _] = loads(&Value::Null, &[("rollers.space.crown_deviations", deviations)]);
    for (a, b) in by_deviation.iter().zip(&by_crown[0]) {
        assert!((a - b).abs() < 1e-3 * largest, "{a} {b}");
    }
    // The lowest roller: shorter, then more crowned.
    let of = |profile: &Value, field: &str, deviation: f64| {
        let list = json!({"groups": [{"rollers": [9], "deviation": deviation}]});
        loads(profile, &[(field, list)])
    };
    let k = 2 * 9;
    let rounder = of(&crown, "rollers.space.crown_deviations", 5e-6);
    let [straight, shorter] = [0.0, -4e-4].map(|by| of(&Value::Null, "rollers.space.length_deviations", by));
    assert!(rounder[0][k] < 0.98 * by_crown[0][k], "{rounder:?} {by_crown:?}");
    assert!(shorter[0][k] < 0.999 * straight[0][k] && shorter[0][k] > 0.95 * straight[0][k], "{shorter:?}");
    assert!(rounder[0][k + 2] > by_crown[0][k + 2]);
}

#[test]
fn drops_and_deviations_that_make_no_sense_are_refused() {
    let table = |places: &[f64], drops: &[f64]| json!({"table": {"places": places, "drops": drops}});
    let cases = [
        ("rollers.profile", table(&[-0.011, 0.011], &[0.0; 2]), "rollers.profile.table.places: has 2"),
        ("rollers.profile", table(&[-0.011, 0.0, 0.011], &[0.0; 2]), "rollers.profile.table.drops: has 2"),
        ("rollers.profile", table(&[-0.009, 0.0, 0.011], &[0.0; 3]), "rollers.profile.table.places.0"),
        ("rollers.profile", table(&[-0.011, 0.001, 0.0, 0.011], &[0.0; 4]), "rollers.profile.table.places.2"),
        ("rollers.profile", table(&[-0.011, 0.0, 0.011], &[0.0, 0.1, 0.0]), "rollers.profile.table.drops.1"),
        (
            "rollers.space.length_deviations",
            json!({"each": [0.0]}),
            "rollers.space.length_deviations.each: has 1",
        ),
        (
            "rollers.space.crown_deviations",
            json!({"groups": [{"rollers": [12], "deviation": 0.0}]}),
            "rollers.space.crown_deviations.groups.0.rollers.0",
        ),
    ];
    for (field, value, expected) in cases {
        let base: Value = serde_json::from_str(&crate::common::read("scenes/nu2310_space.json")).unwrap();
        let scene = crate::common::with(&base, &[(field, value)]);
        let message = match cagedyn::Scene::from_json(&scene.to_string()) {
            Ok(_) => panic!("{field} is taken"),
            Err(error) => error.message,
        };
        assert!(message.starts_with(expected), "{message}");
    }
}

#[test]
fn impossible_ends_and_ribs_are_refused() {
    for (path, value, told) in [
        ("rollers.space.ends.cap_radius", json!(100.0), "rollers.space.ends.cap_radius: 100.0"),
        ("rollers.space.length", json!(0.01), "rollers.space.length: 0.01"),
        ("rollers.space.ends", Value::Null, "rollers.space.ends: missing; 'ribs' need the shape of the ends"),
        ("ribs.list.0.height", json!(5e-4), "ribs.list.0.height: 0.0005 m reaches no face"),
        ("ribs.list.1.side", json!("positive"), "ribs.list.1: a second rib of this ring on this side"),
        ("rollers.space", Value::Null, "ribs: needs 'rollers.space'; remove it"),
        ("cage.space", Value::Null, "cage.space: missing"),
        (
            "inner_ring.motion.space.x",
            json!("free"),
            "inner_ring.motion.space.x: cylindrical rollers do not hold",
        ),
        ("ribs.contact.film", json!("pan_hamrock"), "ribs.contact.film: a law of line contacts"),
        ("raceways.slices", json!(1), "raceways.slices: 1"),
    ] {
        let text = crate::common::read("scenes/nu2310_space.json");
        let value = value.to_string();
        let error = cagedyn::Scene::from_json_with(&text, [(path, value.as_str())]).and_then(Model::new);
        let message = error.map(|_| ()).unwrap_err().message;
        assert!(message.contains(told), "{path}: {message}");
    }
}
