//! Reference life of rollers.

use super::{of, values};
use cagedyn::equilibrium::{Equilibrium, RaceControl};
use serde_json::{Value, json};

fn found(changes: &[(&str, Value)]) -> Equilibrium {
    of("scenes/nu2310.json", RaceControl::Outer, changes).unwrap()
}

/// A quantity of its life.
fn life(found: &Equilibrium, name: &str) -> f64 {
    let life = found.life.as_ref().expect("a life");
    life.values[life.quantities.iter().position(|quantity| quantity.name == name).expect("a quantity")]
}

/// The ring tilted so far (rad) under the load of the scene.
fn tilted(tilt: f64) -> (&'static str, Value) {
    let motion = json!({"space": {
        "y": "free", "z": "free", "tilt_y": {"held": tilt}, "tilt_z": {"held": 0.0}, "load": {"z": {"constant": -4900.0}},
    }});
    ("inner_ring.motion", motion)
}

fn logarithm() -> (&'static str, Value) {
    let profile = json!({"design_load": 4000.0, "crowned_share": 0.6, "end_drop": 12e-6});
    ("rollers.profile", json!({"logarithmic": profile}))
}

/// Straight rollers are loaded alike along their length: what is left are means over the rollers and over the factors of the edges.
#[test]
fn that_of_even_loads_follows_from_them() {
    for (ring, powers) in [("inner_ring", [4.5, 4.0]), ("outer_ring", [4.0, 4.5])] {
        let speeds = [("inner_ring", "outer_ring")].map(|(inner, outer)| {
            [inner, outer]
                .map(|of| if of == ring { json!({"constant": -314.16}) } else { json!({"constant": 0.0}) })
        });
        let [[inner, outer]] = speeds;
        let changes = [
            tilted(0.0),
            ("inner_ring.speed", inner),
            ("outer_ring.speed", outer),
            ("rollers.dynamic_load_rating", json!(190e3)),
        ];
        let found = found(&changes);
        let loads = values(&found, "normal_force");
        let mut sum = 0.0;
        for (k, (name, rating)) in
            [("outer", "outer_rating"), ("inner", "inner_rating")].into_iter().enumerate()
        {
            let of_ring: Vec<f64> = loads.iter().skip(k).step_by(2).copied().collect();
            let mean = of_ring.iter().map(|q| q.powf(powers[k])).sum::<f64>() / of_ring.len() as f64;
            let edges: f64 = (0..30)
                .map(|i| 1.0 - 0.01 / (1.985 * f64::from(2 * i - 29).abs() / 58.0).ln())
                .map(|f| f.powf(4.5))
                .sum();
            let expected = mean.powf(1.0 / powers[k]) * (edges / 30.0).powf(1.0 / 4.5);
            let told = life(&found, &format!("{name}_equivalent_load"));
            assert!((told / expected - 1.0).abs() < 1e-6, "{ring} {name} {told} {expected}");
            sum += (expected / life(&found, rating)).powf(4.5);
        }
        let turns = 1e6 * sum.powf(-8.0 / 9.0);
        assert!((life(&found, "life_turns") / turns - 1.0).abs() < 1e-5);
        let seconds = turns / 50.0;
        assert!((life(&found, "life_time") / seconds - 1.0).abs() < 1e-4);
        let load = 190e3 * (1e-6 * turns).powf(-0.3);
        assert!((life(&found, "reference_load") / load - 1.0).abs() < 1e-5);
    }
}

#[test]
fn without_tilt_it_is_that_in_the_plane() {
    for profile in
        [None, Some(logarithm()), Some(("rollers.profile", json!({"circular_crown": {"radius": 3.0}})))]
    {
        let profile: Vec<_> = profile.into_iter().collect();
        let plane = found(&[&[("gravity", Value::Null)][..], &profile].concat());
        let space = found(&[&[tilted(0.0)][..], &profile].concat());
        let [plane, space] = [plane, space].map(|of| life(&of, "life_turns"));
        assert!((plane / space - 1.0).abs() < 1e-5, "{plane} {space}");
    }
}

#[test]
fn misalignment_costs_life() {
    for profile in [&[][..], &[logarithm()]] {
        let lives = [0.0, 0.5e-3, 1e-3, 2e-3]
            .map(|tilt| life(&found(&[&[tilted(tilt)][..], profile].concat()), "life_turns"));
        assert!(lives.windows(2).all(|pair| pair[1] < pair[0]), "{lives:?}");
    }
}

#[test]
fn what_carries_nothing_has_none() {
    let apart = json!({"fixed": {"y": 0.0, "z": 0.0}});
    let centred = ("initial.inner_ring", json!("centred"));
    let still = [("inner_ring.motion", apart), ("inner_ring.speed", json!({"constant": 0.0})), centred];
    assert_eq!(found(&still).life, None);
    let balls = of("scenes/deep_groove_6206.json", RaceControl::Outer, &[]).unwrap();
    assert_eq!(balls.life, None);
    // Rings that turn alike.
    let alike =
        [("inner_ring.speed", json!({"constant": 10.0})), ("outer_ring.speed", json!({"constant": 10.0}))];
    let found = found(&alike);
    assert!(life(&found, "life_time").is_infinite() && life(&found, "life_turns").is_finite());
}
