//! Balls, rollers, cage and ring in space against CVODE.

use crate::METHODS;
use crate::cases::{Case, scene};
use serde_json::json;

/// A fast, loaded and misaligned 218 in the first half millisecond from the middle: every ball sets down, slides and spins up. Differences
/// are in units of 10 um.
#[test]
fn balls_in_space_agree_with_cvode() {
    let constant = |x: f64| json!({"constant": x});
    let ring = json!({"space": {
        "x": "free", "y": "free", "z": "free", "tilt_y": "free", "tilt_z": "free",
        "load": {"x": constant(17.8e3), "z": constant(-4e3), "moment_y": constant(40.0)},
        "mass": 2.0, "inertia": {"polar": 4e-3, "transverse": 3e-3}, "support_damping": 1e3,
    }});
    let changes = [
        ("balls.count", json!(7)),
        ("inner_ring.motion", ring),
        ("inner_ring.speed", constant(800.0)),
        ("initial", json!({"inner_ring": "centred"})),
        ("gravity", json!({"y": 0.0, "z": -9.8})),
    ];
    let scene = scene("scenes/angular_contact_218.json", &changes);
    let case = Case { name: "218 in space", scene, duration: 5e-4, reference_step: 2e-6, max_step: 5e-6 };
    agree(&case, [4e-6, 1e-6, 2.5e-7]);
}

/// Seven rollers between ribs of both rings, with a cage, in the first 0.3 ms of a ring that starts tilted under a radial load and a thrust: rollers set
/// down with one end first, tilt, skew, meet ribs, sides and bars. Differences are in units of the clearance of the guide.
#[test]
fn rollers_in_space_agree_with_cvode() {
    let constant = |x: f64| json!({"constant": x});
    let rib = |ring: &str, side: &str| json!({"ring": ring, "side": side, "angle": 0.01, "height": 2.5e-3});
    let changes = [
        ("rollers.count", json!(7)),
        (
            "rollers.profile",
            json!({"logarithmic": {"design_load": 5000.0, "crowned_share": 0.6, "end_drop": 12e-6}}),
        ),
        ("inner_ring.motion.space.x", json!("free")),
        ("inner_ring.motion.space.load.x", constant(300.0)),
        ("inner_ring.motion.space.load.moment_y", constant(20.0)),
        ("ribs.list", json!([rib("outer", "positive"), rib("outer", "negative"), rib("inner", "negative")])),
        ("ribs.end_play", json!(2e-6)),
        ("cage.space.pocket_sides.play", json!(4e-6)),
        ("cage.pocket.lubricated_cylinder.radial_clearance", json!(4e-6)),
        ("raceways.slices", json!(4)),
        ("initial", json!({"inner_ring": "equilibrium", "cage_space": {"tilt_y": 1e-3, "velocity_x": 0.02}})),
    ];
    let scene = scene("scenes/nu2310_space.json", &changes);
    let case = Case { name: "NU2310 in space", scene, duration: 3e-4, reference_step: 2e-6, max_step: 5e-6 };
    agree(&case, [2e-6, 5e-7, 1.25e-7]);
}

/// All methods come to CVODE's end, the leapfrog the nearer the shorter its steps (s) are.
fn agree(case: &Case, steps: [f64; 3]) {
    let reference = case.reference();
    assert!(reference.doubt < 1e-6, "two methods of CVODE differ by {:e}", reference.doubt);
    for (method, _) in METHODS {
        let [coarse, fine] =
            [1e-4, 1e-9].map(|level| case.distance(&case.controlled(method, level), &reference.end));
        println!("{method}: {coarse:.1e} {fine:.1e}; doubt {:.1e}", reference.doubt);
        assert!(fine < 1e-6 && fine < 0.1 * coarse.max(1e-6), "{method}: {coarse:e} {fine:e}");
    }
    let leapfrog = steps.map(|h| case.distance(&case.leapfrog(h), &reference.end));
    println!("leapfrog: {leapfrog:?}");
    assert!(leapfrog[2] < 0.3 * leapfrog[0] && leapfrog[2] < 1e-3, "{leapfrog:?}");
}
