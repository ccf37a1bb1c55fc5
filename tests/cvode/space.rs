//! Balls and a ring in space against CVODE.

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
    let reference = case.reference();
    assert!(reference.doubt < 1e-6, "two methods of CVODE differ by {:e}", reference.doubt);
    for (method, _) in METHODS {
        let [coarse, fine] =
            [1e-4, 1e-9].map(|level| case.distance(&case.controlled(method, level), &reference.end));
        println!("{method}: {coarse:.1e} {fine:.1e}; doubt {:.1e}", reference.doubt);
        assert!(fine < 1e-6 && fine < 0.1 * coarse.max(1e-6), "{method}: {coarse:e} {fine:e}");
    }
    let leapfrog = [4e-6, 1e-6, 2.5e-7].map(|h| case.distance(&case.leapfrog(h), &reference.end));
    println!("leapfrog: {leapfrog:?}");
    assert!(leapfrog[2] < 0.3 * leapfrog[0] && leapfrog[2] < 1e-3, "{leapfrog:?}");
}
