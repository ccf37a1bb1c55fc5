//! Hard cases of rollers that skew and tilt between ribs and in the pockets of a cage.

use crate::common::{read, with};
use crate::{Case, RESIDUAL, change_state, run};
use cagedyn::{Model, Sim, Status};
use serde_json::{Value, json};
use std::sync::Arc;

const SCENE: &str = "scenes/nu2310_space.json";
const SPEED: &str = "inner_ring.speed";
const RING: &str = "inner_ring.motion.space";
const CAP: &str = "rollers.space.ends.cap_radius";
/// Speed of the inner ring of the scene, rad/s.
const RING_SPEED: f64 = -314.1592653589793;

fn scene_with(others: &[(&str, Value)]) -> Value {
    let scene: Value = serde_json::from_str(&read(SCENE)).expect("the scene is JSON");
    with(&scene, others)
}

/// A value that grows from one to another within so many ms.
fn ramp(from: f64, to: f64, [start, end]: [f64; 2]) -> Value {
    json!({"ramp": {"from": from, "to": to, "start": 1e-3 * start, "end": 1e-3 * end}})
}

/// Ribs like those of the scene, by ring and side.
fn ribs(list: &[(&str, &str)]) -> (&'static str, Value) {
    let rib =
        |(ring, side): &(&str, &str)| json!({"ring": ring, "side": side, "angle": 0.01, "height": 2.5e-3});
    ("ribs.list", json!(list.iter().map(rib).collect::<Vec<_>>()))
}

const OUTER: [(&str, &str); 2] = [("outer", "positive"), ("outer", "negative")];

/// An NJ bearing, whose inner ring a force along its axis (N) presses to its rib or pulls off it.
fn nj(force: f64) -> Value {
    scene_with(&[
        ribs(&[OUTER[0], OUTER[1], ("inner", "negative")]),
        (&format!("{RING}.x"), json!("free")),
        (&format!("{RING}.load.x"), json!({ "constant": force })),
    ])
}

/// Skews all rollers by this angle (rad), one to the left, the next to the right.
fn skew(sim: &mut Sim, size: f64) {
    let mut sign = 1.0;
    change_state(sim, 0.0, |name, x| {
        if name.ends_with(".skew") {
            *x = sign * size;
            sign = -sign;
        }
    });
}

/// To the corners of ends with caps.
fn askew(sim: &mut Sim) {
    skew(sim, 9.5e-3);
}

/// To the rims of flat ends.
fn askew_by_less(sim: &mut Sim) {
    skew(sim, 3.8e-3);
}

/// Puts one roller 5 um deep into a rib, and tilts another so that one half of it is in a raceway.
fn in_the_steel(sim: &mut Sim) {
    change_state(sim, 0.0, |name, x| match name {
        "roller[3].axial_offset" => *x = 30e-6,
        "roller[5].tilt" => *x = 1e-3,
        _ => {}
    });
}

/// All of them.
pub fn cases() -> Vec<Case> {
    let case = |name, why, scene, milliseconds: f64| Case::new(name, why, scene, 1e-3 * milliseconds);
    let deviations: Vec<f64> = (0..12).map(|j| 5e-6 * (1.7 * f64::from(j)).sin()).collect();
    let flat = json!([
        {"ring": "outer", "side": "positive", "angle": 0.0, "height": 2.5e-3},
        {"ring": "outer", "side": "negative", "angle": 0.0, "height": 2.5e-3},
    ]);
    let all = [OUTER[0], OUTER[1], ("inner", "positive"), ("inner", "negative")];
    vec![
        case(
            "ring tilted to the stop of its rollers",
            "rollers lean on the corners of both of their ends",
            scene_with(&[
                (&format!("{RING}.tilt_y"), json!({"prescribed": ramp(0.0, 8e-3, [1.0, 6.0])})),
                ("ribs.end_play", json!(20e-6)),
            ]),
            10.0,
        ),
        case(
            "crown of the length of a roller",
            "no more than a tenth of a roller is loaded, and it rocks",
            scene_with(&[("rollers.profile", json!({"circular_crown": {"radius": 20.4e-3}}))]),
            10.0,
        ),
        case(
            "ring pushed through its rollers",
            "friction along the axis presses all rollers to one rib",
            scene_with(&[(&format!("{RING}.x"), json!({"prescribed": ramp(0.0, 2e-3, [1.0, 6.0])}))]),
            10.0,
        ),
        case(
            "rollers askew at the start",
            "every roller sticks with opposite corners in both ribs",
            scene_with(&[]),
            10.0,
        )
        .from(askew),
        case(
            "roller deep in a rib",
            "one roller is thrown along its axis, another across",
            scene_with(&[]),
            5.0,
        )
        .from(in_the_steel),
        case(
            "rollers of unequal size",
            "some carry, others never touch the inner ring",
            scene_with(&[("rollers.radius_deviations", json!({ "each": deviations }))]),
            10.0,
        ),
        case(
            "reversal among ribs",
            "films of raceways and ends vanish as the speed passes through zero",
            scene_with(&[(SPEED, ramp(RING_SPEED, -RING_SPEED, [2.0, 8.0]))]),
            10.0,
        ),
        case(
            "rollers in space from rest",
            "films and friction of every contact begin at speed zero",
            scene_with(&[(SPEED, ramp(0.0, RING_SPEED, [0.0, 8.0]))]),
            10.0,
        ),
        case(
            "two slices",
            "the coarsest rule, under a ring that tilts",
            scene_with(&[
                ("raceways.slices", json!(2)),
                (&format!("{RING}.load.moment_y"), json!({"constant": 50.0})),
            ]),
            10.0,
        ),
        case(
            "flat ends",
            "the place of contact jumps from one rim to the other within a microradian",
            scene_with(&[(CAP, json!(50.0)), ("ribs.list", flat)]),
            10.0,
        )
        .from(askew_by_less),
        case(
            "flat ends on ribs that open",
            "rim and corner touch, never the cap",
            scene_with(&[(CAP, json!(50.0))]),
            10.0,
        )
        .from(askew_by_less),
        case(
            "rollers in space at 12 000 rpm and 50 N",
            "centrifugal force parts the rollers from the inner ring, nothing straightens them",
            scene_with(&[
                (SPEED, json!({"constant": 4.0 * RING_SPEED})),
                (&format!("{RING}.load.z"), json!({"constant": -50.0})),
            ]),
            10.0,
        ),
        case(
            "thrust that turns round",
            "all rollers go from one pair of ribs to the other",
            scene_with(&[
                ribs(&all),
                (&format!("{RING}.x"), json!("free")),
                (&format!("{RING}.load.x"), json!({"step": {"before": 1e3, "after": -1e3, "time": 4e-3}})),
            ]),
            10.0,
        ),
    ]
}

/// A crown must reach over half of the length of its roller.
#[test]
fn a_crown_shorter_than_its_roller_is_refused() {
    let scene = scene_with(&[("rollers.profile", json!({"circular_crown": {"radius": 10e-3}}))]);
    let error = Model::from_json(&scene.to_string()).map(|_| ()).expect_err("too round");
    assert_eq!(error.status, Status::BadScene);
    assert!(error.message.starts_with("rollers.profile.circular_crown.radius: 0.01"), "{error}");
}

/// A roller that nothing keeps from turning across its bearing ends the run, and the simulation goes on from a sound state.
#[test]
fn a_roller_across_its_bearing_ends_the_run_and_leaves_the_simulation_usable() {
    let scene = scene_with(&[("ribs", Value::Null), ("cage", Value::Null)]);
    let mut sim =
        Sim::new(Arc::new(Model::from_json(&scene.to_string()).expect("a scene"))).expect("a start");
    let start = sim.state().to_vec();
    change_state(&mut sim, 0.0, |name, x| {
        if name == "roller[3].skew_speed" {
            *x = 1e4;
        }
    });
    let error = sim.advance_to(5e-3).expect_err("it turns");
    assert!(error.message.contains("roller[3] is askew in its bearing"), "{error}");
    assert!(sim.state().iter().all(|x| x.is_finite()));
    sim.set_state(0.0, &start).expect("the start");
    sim.advance_to(1e-3).expect("a run");
    let balance = sim.power_balance().expect("a balance").relative_residual();
    assert!(balance.abs() < RESIDUAL, "{balance}");
}

/// The inner ring of an NJ bearing that is pulled off its rib leaves the bearing, and the run says so.
#[test]
fn a_ring_that_is_pulled_off_its_rib_is_told() {
    let outcome = run(&Case::new("pulled off", "", nj(-2000.0), 20e-3), &json!({}), 60.0);
    assert!(outcome.residual.abs() < RESIDUAL, "{}", outcome.residual);
    let error = outcome.error.expect("nothing holds the ring");
    assert!(error.message.contains("the inner ring has left the bearing"), "{error}");
}
