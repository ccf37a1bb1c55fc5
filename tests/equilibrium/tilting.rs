//! Rollers that tilt with their ring.

use super::{free_ring, of, values};
use cagedyn::equilibrium::{Equilibrium, RaceControl, equilibrium};
use cagedyn::{Error, Model, Scene, Sim, Status};
use cagedyn_studies::judge::rollers_in_space;
use serde_json::{Value, json};
use std::sync::Arc;

const ROLLERS: &str = "scenes/nu2310.json";

fn found(changes: &[(&str, Value)]) -> Equilibrium {
    of(ROLLERS, RaceControl::Outer, changes).unwrap()
}

/// A ring free across the axis under the load of the scene, held at these tilts, rad.
fn tilted([tilt_y, tilt_z]: [f64; 2]) -> (&'static str, Value) {
    let motion = json!({"space": {
        "y": "free", "z": "free", "tilt_y": {"held": tilt_y}, "tilt_z": {"held": tilt_z},
        "load": {"z": {"constant": -4900.0}},
    }});
    ("inner_ring.motion", motion)
}

/// Held at these coordinates.
fn held(at: &[f64]) -> (&'static str, Value) {
    let [x, y, z, tilt_y, tilt_z] = at else { unreachable!() };
    let motion = json!({"space": {
        "x": {"held": x}, "y": {"held": y}, "z": {"held": z}, "tilt_y": {"held": tilt_y}, "tilt_z": {"held": tilt_z},
    }});
    ("inner_ring.motion", motion)
}

const LOGARITHM: &str = r#"{"logarithmic": {"design_load": 4000.0, "load_factor": 1.0, "crowned_share": 0.6, "end_drop": 1.2e-5}}"#;

fn logarithm() -> (&'static str, Value) {
    ("rollers.profile", serde_json::from_str(LOGARITHM).unwrap())
}

#[test]
fn a_misaligned_nu2310_agrees_with_an_independent_solution() {
    // Straight rollers, 4900 N, each with a centrifugal force of 19.8 N; the other solution has 19.6 N.
    for (tilts, z, force, moment, tilt) in [
        ([0.0, 0.0], -28.235, 2619.4, 0.0, 0.0),
        ([1e-3, 0.3e-3], -27.316, 2469.0, -24.91, 0.4987),
        ([5e-3, 0.3e-3], -8.807, 2857.2, -70.03, 2.459),
    ] {
        let found = found(&[tilted(tilts)]);
        let largest = values(&found, "normal_force").into_iter().skip(1).step_by(2).fold(0.0, f64::max);
        let lowest = 1e3 * found.elements[9][2];
        let shown = format!("{:?} {largest} {:?} {lowest}", found.displacement, found.reaction);
        assert!((1e6 * found.displacement[2] - z).abs() < 2e-3, "{shown}");
        assert!((largest - force).abs() < 0.2, "{shown}");
        assert!((found.reaction[3] - moment).abs() < 0.01, "{shown}");
        assert!((lowest - tilt).abs() < 6e-4, "{shown}");
        assert!(found.residual < 1e-9 && found.coordinates.len() == 5, "{shown}");
    }
}

#[test]
fn without_tilt_it_is_the_equilibrium_in_the_plane() {
    let deviations = ("rollers.radius_deviations", json!({"groups": [{"rollers": [9], "deviation": 2e-6}]}));
    let load = |y: f64, z: f64| {
        [("inner_ring.motion.free.load", json!({"y": {"constant": y}, "z": {"constant": z}}))]
    };
    let in_space = json!({"space": {
        "y": "free", "z": "free", "load": {"y": {"constant": 800.0}, "z": {"constant": -7000.0}},
    }});
    for profile in
        [None, Some(logarithm()), Some(("rollers.profile", json!({"circular_crown": {"radius": 3.0}})))]
    {
        let others: Vec<_> = profile.into_iter().chain([deviations.clone()]).collect();
        // A ring in the plane has weight.
        let plane = [&load(800.0, -7000.0)[..], &others, &[("gravity", Value::Null)]].concat();
        let space = [&[("inner_ring.motion", in_space.clone())][..], &others].concat();
        let (plane, space) = (found(&plane), found(&space));
        for (k, place) in plane.displacement.iter().enumerate() {
            assert!((place - space.displacement[1 + k]).abs() < 2e-12, "{plane:?} {space:?}");
        }
        for (a, b) in values(&plane, "normal_force").into_iter().zip(values(&space, "normal_force")) {
            assert!((a - b).abs() < 1e-6 * 4000.0, "{a} {b}");
        }
        for (a, b) in values(&plane, "largest_pressure").into_iter().zip(values(&space, "largest_pressure")) {
            assert!((a - b).abs() < 1e-6 * 1e9, "{a} {b}");
        }
    }
}

#[test]
fn the_other_tilt_is_the_mirror_image() {
    let [one, other] = [[2e-3, 0.0], [-2e-3, 0.0]].map(|tilts| found(&[tilted(tilts), logarithm()]));
    assert!((one.displacement[2] / other.displacement[2] - 1.0).abs() < 1e-9);
    assert!((one.reaction[3] + other.reaction[3]).abs() < 1e-6 * one.reaction[3].abs());
    let places = [&one, &other].map(|found| values(found, "largest_at")[19]);
    assert!(places[0] > 1e-3 && (places[0] + places[1]).abs() < 1e-9, "{places:?}");
}

#[test]
fn the_moment_that_holds_a_tilt_is_the_one_that_causes_it() {
    let held = found(&[tilted([1.5e-3, -0.4e-3]), logarithm()]);
    let [.., moment_y, moment_z] = held.load()[..] else { unreachable!() };
    let mut ring = free_ring([0.0, 0.0, -4900.0, moment_y, moment_z]);
    ring["space"]["x"] = json!({"held": 0.0});
    let free = found(&[("inner_ring.motion", ring), logarithm()]);
    for (a, b) in held.displacement.iter().zip(&free.displacement) {
        assert!((a - b).abs() < 1e-8, "{held:?} {free:?}");
    }
}

#[test]
fn its_stiffness_is_the_derivative_of_the_load() {
    let unit = |k: usize| if k < 3 { 1.0 } else { 1.0 / 0.04 };
    for profile in [None, Some(logarithm())] {
        let base: Vec<_> = profile.into_iter().collect();
        let all = found(&[&[tilted([1e-3, 0.3e-3])][..], &base].concat());
        let largest = (0..5).map(|k| all.stiffness[6 * k] * unit(k) * unit(k)).fold(0.0, f64::max);
        for k in 0..5 {
            let h = 1e-8 * unit(k);
            let loads = [-2.0, -1.0, 1.0, 2.0].map(|steps| {
                let mut at = all.displacement.clone();
                at[k] += steps * h;
                found(&[&[held(&at)][..], &base].concat()).load()
            });
            let [a, b, c, d] = &loads;
            for (i, (((a, b), c), d)) in a.iter().zip(b).zip(c).zip(d).enumerate() {
                let difference = (a - 8.0 * b + 8.0 * c - d) / (12.0 * h);
                let stiffness = all.stiffness[5 * i + k];
                let error = (difference - stiffness).abs() * unit(i) * unit(k);
                // Slices stand at other places beside: their rule is good to this.
                assert!(error < 5e-4 * largest, "{i} {k}: {difference} {stiffness}");
            }
        }
    }
}

#[test]
fn line_loads_add_up_to_the_force() {
    let found = found(&[tilted([2e-3, -1e-3]), logarithm()]);
    let places = &found.line_loads.places;
    let step = places[1] - places[0];
    let (forces, moments) = (values(&found, "normal_force"), values(&found, "moment"));
    let (largest, lengths) = (values(&found, "largest_line_load"), values(&found, "loaded_length"));
    for (i, loads) in found.line_loads.values.iter().enumerate() {
        let sum: f64 = loads.iter().sum::<f64>() * step - 0.5 * step * (loads[0] + loads[100]);
        // On the roller about the axis along the orbit: pressed from outside at +x it turns that end inwards.
        let side = if i % 2 == 0 { -1.0 } else { 1.0 };
        let moment: f64 = side * step * places.iter().zip(loads).map(|(s, load)| s * load).sum::<f64>();
        // Towards the end of a logarithm the load falls within a step.
        let coarse = 0.5 * step * largest[i];
        assert!((sum - forces[i]).abs() <= 0.005 * forces[i] + coarse, "{i}: {sum} {}", forces[i]);
        assert!(
            (moment - moments[i]).abs() <= 0.005 * moments[i].abs() + coarse * places[100],
            "{i}: {moment} {}",
            moments[i]
        );
        assert!(loads.iter().all(|load| *load <= largest[i] * (1.0 + 1e-9)));
        let loaded = loads.iter().filter(|load| **load > 0.0).count() as f64 * step;
        assert!((loaded - lengths[i]).abs() < 1.6 * step, "{i}: {loaded} {}", lengths[i]);
    }
}

#[test]
fn profiles_take_the_stress_from_the_ends() {
    let pressure = |changes: &[(&str, Value)]| values(&found(changes), "largest_pressure")[19];
    let [straight, profiled] =
        [vec![tilted([1e-3, 0.0])], vec![tilted([1e-3, 0.0]), logarithm()]].map(|c| pressure(&c));
    assert!(profiled < 0.95 * straight, "{profiled} {straight}");
}

#[test]
fn it_has_no_motion_over_time_and_is_held_along_the_axis() {
    let text = super::common::read(ROLLERS);
    let (path, motion) = tilted([1e-3, 0.0]);
    let scene = Scene::from_json_with(&text, [(path, motion.to_string().as_str())]).unwrap();
    let refused: Error = Sim::new(Arc::new(Model::new(scene).unwrap())).err().expect("no motion");
    assert_eq!(refused.status, Status::BadScene);
    assert!(
        refused.message.starts_with("inner_ring.motion.space: rollers move over time in the plane"),
        "{refused}"
    );
    let free = json!({"space": {"x": "free"}});
    let refused = of(ROLLERS, RaceControl::Outer, &[("inner_ring.motion", free)]).unwrap_err();
    assert!(refused.message.contains("inner_ring.motion.space.x: cylindrical rollers"), "{refused}");
    let loose = json!({"space": {"z": "free", "tilt_y": "free"}});
    let refused = of(ROLLERS, RaceControl::Outer, &[("inner_ring.motion", loose)]).unwrap_err();
    assert!(refused.message.contains("nothing holds it"), "{refused}");
}

/// Rollers that hardly anything presses slide between ribs without end, unless friction holds them.
#[test]
fn hardly_loaded_rollers_between_ribs_find_a_rest() {
    for number in [3050, 3115, 3162] {
        let scene = rollers_in_space::scene(number, 1e-3).to_string();
        let found = equilibrium(&Model::from_json(&scene).unwrap(), RaceControl::Outer).unwrap();
        assert!(found.residual < 1e-9, "{number}: {}", found.residual);
        assert!(found.displacement.iter().all(|x| x.abs() < 0.1), "{number}: {:?}", found.displacement);
    }
}
