//! Bearings of any size under any load that they can carry have an equilibrium, and it is one.

use super::{ANGULAR, free_ring, of, values};
use crate::common::Random;
use cagedyn::equilibrium::RaceControl;
use serde_json::{Value, json};
use std::f64::consts::TAU;

/// A ball bearing by a catalogue's proportions, with what loads it.
fn changes(random: &mut Random) -> Vec<(&'static str, Value)> {
    let radius = 10f64.powf(random.within(-3.0, -1.5));
    let count = random.within(7.0, 30.0).floor();
    // Balls leave a tenth to three quarters of their diameter between them.
    let pitch = radius / (TAU / 2.0 / count).sin() * random.within(1.1, 1.75);
    let groove = |random: &mut Random| radius * 2.0 * random.within(0.505, 0.56);
    let (outer, inner) = (groove(random), groove(random));
    let angular = random.within(0.0, 1.0) < 0.6;
    let clearance = random.within(-2e-4, 4e-3) * radius;
    // From a hundredth of the static rating to twice as much.
    let rating = 12e6 * count * (2.0 * radius).powi(2) * 10f64.powf(random.within(-2.0, 0.3));
    let axial = random.within(0.1, 1.0) * rating;
    let mut share = || random.within(-0.2, 0.2) * rating;
    let loads = [axial, share(), share(), 0.3 * pitch * share(), 0.3 * pitch * share()];
    // Up to a speed factor of a million mm/min.
    let speed = random.within(-1.0, 1.0) * 1000.0 / (2.0 * pitch) / 60.0 * TAU * random.within(0.0, 1.0);
    vec![
        (
            "balls",
            json!({
                "count": count as u32, "radius": radius, "pitch_radius": pitch, "material": "steel",
                "mass": 7830.0 * 2.0 / 3.0 * TAU * radius.powi(3),
                "contact_angle": if angular { json!(random.within(0.1, 1.0)) } else { Value::Null },
            }),
        ),
        ("inner_ring.radial_clearance", if angular { Value::Null } else { json!(clearance) }),
        ("outer_ring.groove_radius", json!(outer)),
        ("inner_ring.groove_radius", json!(inner)),
        ("inner_ring.speed.constant", json!(speed)),
        ("inner_ring.motion", free_ring(loads)),
        ("initial", json!({"first_roller_angle": random.within(0.0, TAU)})),
    ]
}

#[test]
fn any_bearing_carries_its_load() {
    let (mut random, mut light) = (Random::new(46), 0);
    for case in 0..500 {
        let (changes, (_, control)) = (changes(&mut random), RaceControl::ALL[case % 3]);
        let found = match of(ANGULAR, control, &changes) {
            Ok(found) => found,
            // Race control knows no equilibrium of some balls that centrifugal forces throw off the inner race.
            Err(e) if e.message.contains("of the speed") => {
                let told = ["'outer' or 'none' instead", "outweighs their load", "finds no rest"];
                assert!(told.iter().any(|words| e.message.contains(words)), "case {case}: {e}");
                light += 1;
                continue;
            }
            Err(e) => panic!("case {case}: {e}: {changes:?}"),
        };
        assert!(found.residual < 1e-10, "case {case}: {}", found.residual);
        let loads = values(&found, "normal_force");
        assert!(loads.iter().all(|load| *load >= 0.0 && load.is_finite()), "case {case}");
        assert!(found.stiffness.iter().all(|k| k.is_finite()), "case {case}");
    }
    assert!(light < 15, "{light}");
}
