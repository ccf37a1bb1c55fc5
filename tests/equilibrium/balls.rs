//! Published and independently computed equilibria of ball bearings.

use super::{ANGULAR, DEEP, free_ring, of, values};
use cagedyn::equilibrium::RaceControl;
use serde_json::json;
use std::f64::consts::{PI, TAU};

const FAST: f64 = 10_000.0 * PI / 30.0;

#[track_caller]
fn close(found: f64, expected: f64, error: f64) {
    assert!((found - expected).abs() <= error, "{found} instead of {expected}");
}

#[test]
fn an_angular_contact_bearing_at_rest() {
    let found = of(ANGULAR, RaceControl::Outer, &[]).unwrap();
    close(1e6 * found.displacement[0], 36.1, 0.05);
    for (angle, load) in values(&found, "contact_angle").into_iter().zip(values(&found, "normal_force")) {
        close(angle.to_degrees(), 41.50, 0.005);
        close(load, 1678.9, 0.05);
        // 16 balls carry the axial load.
        close(16.0 * load * angle.sin(), 17_800.0, 1e-6);
    }
    assert!(found.residual < 1e-12 && found.warnings.is_empty(), "{:?}", found.warnings);
}

/// Jones and Harris: outer race control, and no gyroscopic moment.
#[test]
fn an_angular_contact_bearing_at_speed() {
    let fast = [
        ("inner_ring.speed.constant", json!(FAST)),
        ("inner_ring.motion.space.load.x.constant", json!(22_250.0)),
    ];
    for (control, inner, outer) in [(RaceControl::Outer, 48.74, 33.58), (RaceControl::None, 47.75, 34.98)] {
        let found = of(ANGULAR, control, &fast).unwrap();
        let angles = values(&found, "contact_angle");
        close(angles[1].to_degrees(), inner, 0.005);
        close(angles[0].to_degrees(), outer, 0.005);
        let backwards = [("inner_ring.speed.constant", json!(-FAST)), fast[1].clone()];
        let mirrored = of(ANGULAR, control, &backwards).unwrap();
        close(mirrored.displacement[0], found.displacement[0], 1e-16);
        close(mirrored.elements[3][3], -found.elements[3][3], 1e-9);
    }
    // With the inner race in control spin is on the outer one only, and the friction draws the angles together.
    let found = of(ANGULAR, RaceControl::Inner, &fast).unwrap();
    let (spin, angles) = (values(&found, "spin_to_roll"), values(&found, "contact_angle"));
    assert!(spin[1] < 1e-12 && spin[0] > 0.3 && angles[1] - angles[0] < 0.1, "{spin:?} {angles:?}");
}

/// Kinematics of the textbook at outer race control: tan(beta) = sin a/(cos a + gamma) in the frame that goes round with the balls,
/// orbit speed from both angles.
#[test]
fn race_control_has_the_speeds_of_the_textbook() {
    let fast = [
        ("inner_ring.speed.constant", json!(FAST)),
        ("inner_ring.motion.space.load.x.constant", json!(22_250.0)),
    ];
    let found = of(ANGULAR, RaceControl::Outer, &fast).unwrap();
    let angles = values(&found, "contact_angle");
    let (outer, inner) = (angles[0], angles[1]);
    let [_, _, rho, orbit, spin_x, spin_r, _, pitch] = found.elements[0][..] else { unreachable!() };
    let gamma = 11.115e-3 / (62.63e-3 + rho);
    let tangent = outer.sin() / (outer.cos() + gamma);
    close(spin_r / (orbit - spin_x), tangent, 1e-12);
    close(pitch.tan(), tangent, 1e-12);
    let lever = |angle: f64| angle.cos() + tangent * angle.sin();
    let ratio = (1.0 + gamma * outer.cos()) * lever(inner) / ((1.0 - gamma * inner.cos()) * lever(outer));
    close(orbit / FAST, 1.0 / (1.0 + ratio), 1e-12);
}

/// The steady motion under the model's own friction, against that of an independent program over time: neither race controls.
#[test]
fn friction_lies_between_both_races() {
    let fast = [
        ("inner_ring.speed.constant", json!(FAST)),
        ("inner_ring.motion.space.load.x.constant", json!(22_250.0)),
    ];
    let found = of(ANGULAR, RaceControl::Friction, &fast).unwrap();
    let [angles, loads, spin] =
        ["contact_angle", "normal_force", "spin_to_roll"].map(|name| values(&found, name));
    close(angles[1].to_degrees(), 47.90, 0.05);
    close(angles[0].to_degrees(), 34.67, 0.05);
    close(loads[1], 1838.0, 2.0);
    close(loads[0], 2276.0, 2.0);
    let [_, _, _, orbit, .., pitch] = found.elements[0][..] else { unreachable!() };
    close(orbit / FAST, 0.4411, 1e-4);
    close(pitch.to_degrees(), 34.3, 0.1);
    assert!(spin.iter().all(|ratio| *ratio > 0.05), "{spin:?}");
    // All balls do the same, and a speed the other way round mirrors them.
    assert!(found.elements.iter().all(|ball| (ball[3] / orbit - 1.0).abs() < 1e-9));
    let backwards = [("inner_ring.speed.constant", json!(-FAST)), fast[1].clone()];
    let mirrored = of(ANGULAR, RaceControl::Friction, &backwards).unwrap();
    close(mirrored.elements[0][3], -orbit, 1e-7 * orbit);
    close(mirrored.displacement[0], found.displacement[0], 1e-9 * found.displacement[0]);
}

#[test]
fn a_ring_with_five_freedoms() {
    let loads = [17_800.0, 3000.0, -6000.0, 60.0, -90.0];
    let changes = [("inner_ring.motion", free_ring(loads)), ("initial", json!({"first_roller_angle": 0.05}))];
    let found = of(ANGULAR, RaceControl::Outer, &changes).unwrap();
    for (found, expected) in
        found.displacement.iter().zip([14.467e-6, 31.789e-6, -159.086e-6, 2.8606e-3, 0.4845e-3])
    {
        close(*found, expected, 1e-4 * expected.abs());
    }
    let largest = values(&found, "normal_force").into_iter().skip(1).step_by(2).fold(0.0, f64::max);
    close(largest, 3900.9, 0.1);
    // Moments over the tilts are those of the load to the first order in the tilt.
    for (load, expected) in found.load().into_iter().zip(loads) {
        close(load, expected, 1e-5 * expected.abs());
    }
}

/// Stribeck's factor of a bearing without clearance whose lowest ball stands right below, Z/sum of cos^2.5: that of a displacement
/// that is small beside the pitch radius. Under 3000 N it is 7e-4 larger.
#[test]
fn a_deep_groove_bearing_under_radial_load() {
    let factor = |load: f64| {
        let changes = [
            ("inner_ring.radial_clearance", json!(0.0)),
            ("inner_ring.motion.space.load.z.constant", json!(-load)),
        ];
        let found = of(DEEP, RaceControl::Outer, &changes).unwrap();
        values(&found, "normal_force").into_iter().skip(1).step_by(2).fold(0.0, f64::max) * 9.0 / load
    };
    let stribeck = 9.0 / (0..9).map(|j| (TAU / 9.0 * f64::from(j)).cos().max(0.0).powf(2.5)).sum::<f64>();
    close(stribeck, 4.385, 5e-4);
    close(factor(0.1), stribeck, 1e-5);
    close(factor(3000.0), 4.388, 5e-4);
}

#[test]
fn turning_the_bearing_turns_its_equilibrium() {
    let step = TAU / 16.0 * 3.0;
    let (sin, cos) = step.sin_cos();
    let turned = |[y, z]: [f64; 2]| [y * cos - z * sin, y * sin + z * cos];
    let (force, moment) = ([3000.0, -6000.0], [60.0, -90.0]);
    let solve = |[y, z]: [f64; 2], [my, mz]: [f64; 2]| {
        let speed = ("inner_ring.speed.constant", json!(0.5 * FAST));
        of(ANGULAR, RaceControl::Outer, &[("inner_ring.motion", free_ring([17_800.0, y, z, my, mz])), speed])
            .unwrap()
    };
    let (a, b) = (solve(force, moment), solve(turned(force), turned(moment)));
    close(a.displacement[0], b.displacement[0], 1e-14);
    for k in [1, 3] {
        let expected = turned([a.displacement[k], a.displacement[k + 1]]);
        close(b.displacement[k], expected[0], 1e-12);
        close(b.displacement[k + 1], expected[1], 1e-12);
    }
}

#[test]
fn a_larger_ball_carries_more_and_a_held_ring_tells_its_load() {
    let larger = json!({"groups": [{"balls": [2], "deviation": 2e-6}]});
    let found = of(ANGULAR, RaceControl::Outer, &[("balls.radius_deviations", larger)]).unwrap();
    let loads = values(&found, "normal_force");
    assert!(loads[5] > 1.2 * loads[1], "{loads:?}");
    assert!(found.load()[1].abs() > 1.0, "the ring is held across the axis");

    let free = of(ANGULAR, RaceControl::Outer, &[]).unwrap();
    let held = json!({"space": {"x": {"held": free.displacement[0]}}});
    let held = of(ANGULAR, RaceControl::Outer, &[("inner_ring.motion", held)]).unwrap();
    close(held.load()[0], 17_800.0, 1e-6);
    assert_eq!(held.free, [false; 5]);
}

#[test]
fn a_spring_presses_the_ring() {
    let spring = json!({"space": {"x": "free", "preload": {"force": 2000.0, "stiffness": 1e7}}});
    let found = of(ANGULAR, RaceControl::Outer, &[("inner_ring.motion", spring)]).unwrap();
    close(found.load()[0], 2000.0 - 1e7 * found.displacement[0], 1e-6);
    assert!(found.displacement[0] > 1e-6);
}

#[test]
fn what_is_amiss_is_told() {
    let changes = [
        ("inner_ring.shoulder_height", json!(2.8e-3)),
        ("inner_ring.motion.space.load.x.constant", json!(1e5)),
    ];
    let found = of(ANGULAR, RaceControl::Outer, &changes).unwrap();
    let text = found.warnings.join("\n");
    assert!(
        text.contains("ball[0].inner_raceway: the ellipse reaches") && text.contains("beyond the shoulder"),
        "{text}"
    );
    let heavy = [("inner_ring.motion.space.load.z.constant", json!(-40e3))];
    let text = of(DEEP, RaceControl::Outer, &heavy).unwrap().warnings.join("\n");
    assert!(text.contains("above 4.2e9 Pa") && text.contains("balls carry no load"), "{text}");
}

#[test]
fn films_are_those_of_rolling() {
    let fast =
        [("inner_ring.speed.constant", json!(FAST)), ("raceways.contact.thermal_correction", json!(null))];
    let found = of(ANGULAR, RaceControl::Outer, &fast).unwrap();
    let [speeds, films, ratios, loads] =
        ["rolling_speed", "film_thickness", "film_ratio", "normal_force"].map(|name| values(&found, name));
    // Past the outer contact the ring moves by the orbit speed, past the inner one by what is left of that of the ring.
    let [_, _, rho, orbit, ..] = found.elements[0][..] else { unreachable!() };
    let angles = values(&found, "contact_angle");
    close(speeds[0], orbit * (62.63e-3 + rho + 11.115e-3 * angles[0].cos()), 1e-9);
    close(speeds[1], (FAST - orbit) * (62.63e-3 + rho - 11.115e-3 * angles[1].cos()), 1e-9);
    for k in 0..2 {
        // h ~ u^0.67 Q^-0.067 R_x^0.464, about a micrometre.
        assert!((0.5e-6..3e-6).contains(&films[k]), "{films:?}");
        close(ratios[k], films[k] / 1e-7, 1e-9 * ratios[k]);
    }
    assert!(films[0] > films[1] && loads[0] > loads[1], "the outer race is the flatter one");
    let still = of(ANGULAR, RaceControl::Outer, &[]).unwrap();
    assert!(values(&still, "film_thickness").iter().all(|h| *h == 0.0));
}
