//! The stiffness is the derivative of the load, and symmetric where forces have a potential.

use super::{ANGULAR, DEEP, free_ring, of};
use cagedyn::equilibrium::{Equilibrium, RaceControl};
use serde_json::{Value, json};

/// The load of a ring held at these coordinates.
fn held(file: &str, control: RaceControl, at: &[f64], others: &[(&str, Value)]) -> Vec<f64> {
    let motion = match at {
        [x, y, z, tilt_y, tilt_z] => json!({"space": {
            "x": {"held": x}, "y": {"held": y}, "z": {"held": z}, "tilt_y": {"held": tilt_y}, "tilt_z": {"held": tilt_z},
        }}),
        [y, z] => json!({"fixed": {"y": y, "z": z}}),
        _ => unreachable!(),
    };
    // Only a free ring of rollers may start from its equilibrium.
    let start = (at.len() == 2).then(|| ("initial.inner_ring", json!("centred")));
    let changes: Vec<_> =
        [("inner_ring.motion", motion)].into_iter().chain(start).chain(others.iter().cloned()).collect();
    of(file, control, &changes).unwrap().load()
}

/// Compares with differences of loads of a ring that is held beside.
fn check(file: &str, control: RaceControl, found: &Equilibrium, others: &[(&str, Value)]) {
    let n = found.displacement.len();
    // Of force and moment alike: a tilt moves balls by a pitch radius.
    let unit = |k: usize| if k < 3 { 1.0 } else { 1.0 / 0.05 };
    let largest = (0..n).map(|k| found.stiffness[n * k + k] * unit(k) * unit(k)).fold(0.0, f64::max);
    for k in 0..n {
        let h = 1e-9 * unit(k);
        let loads = [-2.0, -1.0, 1.0, 2.0].map(|steps| {
            let mut at = found.displacement.clone();
            at[k] += steps * h;
            held(file, control, &at, others)
        });
        let load = |step: usize, i: usize| loads[step][i];
        for i in 0..n {
            let difference = (load(0, i) - 8.0 * load(1, i) + 8.0 * load(2, i) - load(3, i)) / (12.0 * h);
            let exact = found.stiffness[n * i + k];
            let error = (difference - exact).abs() * unit(i) * unit(k);
            assert!(error < 2e-6 * largest, "{file} {i} {k}: {difference} {exact}");
        }
    }
}

#[test]
fn it_is_the_derivative_of_the_load() {
    let loads = free_ring([17_800.0, 3000.0, -6000.0, 60.0, -90.0]);
    for speed in [0.0, 600.0, -1047.0] {
        let speed = ("inner_ring.speed.constant", json!(speed));
        for (_, control) in RaceControl::ALL {
            let found = of(ANGULAR, control, &[("inner_ring.motion", loads.clone()), speed.clone()]).unwrap();
            check(ANGULAR, control, &found, std::slice::from_ref(&speed));
        }
    }
    let combined = free_ring([500.0, 200.0, -3000.0, 1.0, -2.0]);
    let speed = ("inner_ring.speed.constant", json!(900.0));
    let found = of(DEEP, RaceControl::Outer, &[("inner_ring.motion", combined), speed.clone()]).unwrap();
    check(DEEP, RaceControl::Outer, &found, &[speed]);
    let rollers = "scenes/nu2310.json";
    check(rollers, RaceControl::Outer, &of(rollers, RaceControl::Outer, &[]).unwrap(), &[]);
    let crowned = [("rollers.profile", json!({"circular_crown": {"radius": 2.0}}))];
    let turned = ("inner_ring.motion.free.load.y.constant", json!(2000.0));
    let found = of(rollers, RaceControl::Outer, &[crowned[0].clone(), turned]).unwrap();
    assert!(found.stiffness[1].abs() > 1e6);
}

#[test]
fn at_rest_it_is_symmetric() {
    for (file, loads) in [
        (ANGULAR, [17_800.0, 3000.0, -6000.0, 60.0, -90.0]),
        (ANGULAR, [5000.0, 0.0, 4000.0, 0.0, 30.0]),
        (DEEP, [300.0, 1000.0, -3000.0, 2.0, 3.0]),
    ] {
        let found = of(file, RaceControl::Outer, &[("inner_ring.motion", free_ring(loads))]).unwrap();
        for i in 0..5 {
            for k in 0..i {
                let (a, b) = (found.stiffness[5 * i + k], found.stiffness[5 * k + i]);
                let size = (found.stiffness[6 * i] * found.stiffness[6 * k]).sqrt();
                assert!((a - b).abs() < 1e-13 * size, "{file} {i} {k}: {a} {b}");
            }
        }
    }
}
