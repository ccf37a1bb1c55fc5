//! Scenes without an equilibrium, and bearings that cannot be: one line that says where and why.

use super::{ANGULAR, DEEP, free_ring, of};
use cagedyn::Status;
use cagedyn::equilibrium::RaceControl;
use serde_json::{Value, json};

fn refused(file: &str, changes: &[(&str, Value)], status: Status, words: &[&str]) {
    let Err(error) = of(file, RaceControl::Outer, changes) else { panic!("{changes:?} is no mistake") };
    assert_eq!(error.status, status, "{error}");
    assert!(
        words.iter().all(|word| error.message.contains(word)) && !error.message.contains('\n'),
        "{error}"
    );
}

#[test]
fn bearings_that_cannot_be() {
    let bad = |file: &str, changes: &[(&str, Value)], words: &[&str]| {
        refused(file, changes, Status::BadScene, words)
    };
    bad(
        ANGULAR,
        &[("outer_ring.groove_radius", json!(11e-3))],
        &["outer_ring.groove_radius: 0.011 m", "radius 0.011115 m of the balls"],
    );
    bad(ANGULAR, &[("inner_ring.groove_radius", json!(11.115e-3))], &["inner_ring.groove_radius"]);
    bad(ANGULAR, &[("inner_ring.groove_radius", json!(11.63))], &["inner_ring.groove_radius", "millimetres"]);
    bad(
        ANGULAR,
        &[("inner_ring.groove_radius", Value::Null)],
        &["inner_ring.groove_radius: missing; 'balls' need it"],
    );
    bad(ANGULAR, &[("balls.count", json!(18))], &["balls.count: 18 balls", "overlap"]);
    bad(ANGULAR, &[("balls.contact_angle", json!(40.0))], &["balls.contact_angle: 40.0 rad", "degrees"]);
    bad(
        ANGULAR,
        &[("balls.contact_angle", Value::Null)],
        &["balls.contact_angle: missing", "radial_clearance"],
    );
    bad(
        ANGULAR,
        &[("inner_ring.radial_clearance", json!(1e-5))],
        &["inner_ring.radial_clearance: not allowed beside"],
    );
    bad(
        DEEP,
        &[("inner_ring.radial_clearance", json!(1e-3))],
        &["inner_ring.radial_clearance: 0.001 m lets balls climb"],
    );
    bad(
        DEEP,
        &[("balls.radius_deviations", json!({"groups": [{"balls": [9], "deviation": 1e-6}]}))],
        &["there is no ball 9; 0 to 8"],
    );
    bad(
        ANGULAR,
        &[("outer_ring.raceway_radius", json!(0.07))],
        &["outer_ring.raceway_radius: not allowed beside 'balls'"],
    );
    bad(
        "scenes/nu2310.json",
        &[("outer_ring.groove_radius", json!(8e-3))],
        &["outer_ring.groove_radius: needs 'balls'"],
    );
    bad(
        "scenes/grease_guide.json",
        &[("inner_ring.motion", json!({"space": {}}))],
        &["inner_ring.motion.space: needs 'balls' or 'rollers'"],
    );
    bad("scenes/grease_guide.json", &[], &["kinematic_elements"]);
    bad(
        DEEP,
        &[("inner_ring.motion.space.tilt_y", json!({"held": 3.0}))],
        &["inner_ring.motion.space.tilt_y.held: 3.0 rad"],
    );
}

#[test]
fn laws_of_the_other_kind() {
    let bad = |file: &str, path: &str, value: Value, words: &[&str]| {
        refused(file, &[(path, value)], Status::BadScene, words);
    };
    bad(ANGULAR, "raceways.contact.film", json!("pan_hamrock"), &["raceways.contact.film: a law of rollers"]);
    bad(ANGULAR, "raceways.contact.thermal_correction", json!("ghosh_pandey"), &["of balls 'gupta'"]);
    bad(
        ANGULAR,
        "raceways.rolling_resistance.law",
        json!("zhou_hoeprich"),
        &["raceways.rolling_resistance.law: a law of rollers"],
    );
    bad(
        ANGULAR,
        "raceways.rolling_resistance.inlet_sliding",
        json!({}),
        &["inlet_sliding: a law of rollers"],
    );
    bad(ANGULAR, "raceways.slices", json!(4), &["raceways.slices: balls have no profile"]);
    bad(
        "scenes/nu2310.json",
        "raceways.contact.film",
        json!("hamrock_dowson"),
        &["raceways.contact.film: a law of balls"],
    );
    bad(
        "scenes/nu2310.json",
        "raceways.rolling_resistance.law",
        json!("houpert"),
        &["a law of balls; of rollers"],
    );
    bad("scenes/nu2310.json", "raceways.ellipse", json!("fine"), &["raceways.ellipse: needs 'balls'"]);
}

#[test]
fn friction_needs_traction() {
    let changes = [("raceways", json!({})), ("inner_ring.speed.constant", json!(500.0))];
    let Err(error) = of(ANGULAR, RaceControl::Friction, &changes) else { panic!("nothing drives the balls") };
    assert!(error.message.starts_with("raceways.contact.traction: missing"), "{error}");
    assert!(of(ANGULAR, RaceControl::Friction, &[("raceways", json!({}))]).is_ok(), "nothing turns");
    // Nor does anything drive balls outside of the load zone.
    let Err(error) = of(DEEP, RaceControl::Friction, &[("inner_ring.speed.constant", json!(1000.0))]) else {
        panic!("balls that nothing presses go round")
    };
    assert!(error.message.contains("ball[3] finds no steady motion under friction"), "{error}");
}

#[test]
fn an_axial_load_needs_a_stop() {
    for load in [-100.0, 0.0] {
        let changes = [("inner_ring.motion.space.load.x.constant", json!(load))];
        refused(ANGULAR, &changes, Status::BadScene, &["inner_ring.motion.space.load.x", "no axial stop"]);
    }
    let spring = json!({"force": 500.0});
    let changes = [
        ("inner_ring.motion.space.load.x.constant", json!(-100.0)),
        ("inner_ring.motion.space.preload", spring),
    ];
    assert!(of(ANGULAR, RaceControl::Outer, &changes).is_ok());
    // A deep groove holds both ways.
    for load in [-800.0, 800.0] {
        let found =
            of(DEEP, RaceControl::Outer, &[("inner_ring.motion", free_ring([load, 0.0, -1000.0, 0.0, 0.0]))])
                .unwrap();
        assert!(found.displacement[0] * load > 0.0);
    }
}

#[test]
fn a_free_coordinate_that_nothing_holds_is_named() {
    let none = [("inner_ring.motion", free_ring([0.0; 5]))];
    refused(DEEP, &none, Status::BadState, &["inner_ring.motion.space.", "free, and nothing holds it"]);
    // A ring that rests on one ball falls off it.
    let two = [
        ("balls.count", json!(2)),
        ("balls.contact_angle", json!(0.0)),
        ("inner_ring.radial_clearance", Value::Null),
        ("inner_ring.motion", free_ring([0.0, 0.0, -1000.0, 0.0, 0.0])),
    ];
    let found = of(DEEP, RaceControl::Outer, &two).unwrap();
    assert!(found.warnings.iter().any(|line| line.contains("pushed away")), "{:?}", found.warnings);
}

#[test]
fn a_load_beyond_the_bearing_is_told() {
    let moment = [("inner_ring.motion", free_ring([100.0, 0.0, 0.0, 1e9, 0.0]))];
    refused(
        ANGULAR,
        &moment,
        Status::BadState,
        &["no equilibrium", "inner_ring.tilt_y", "nothing holds the ring that way"],
    );
}
