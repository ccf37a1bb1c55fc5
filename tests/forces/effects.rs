//! Independence of effects in a whole bearing at any state: what is switched off vanishes, and nothing else.

use crate::common::bench::{Bearing, STATES_PER_SCENE, State, at_random_states};
use crate::common::palmgren::{BRASS, STEEL, palmgren_load};
use crate::common::reports::{
    APPROACH, CAGE, FILM, FILM_RATIO, FRICTION, GRAVITY, GUIDE, INNER, LOAD, NORMAL, OUTER, POCKET, ROLLING,
    ROLLING_FACTOR, ROLLING_SPEED, SLIP_SPEED, SUPPORT, TEMPERATURE,
};
use crate::common::{Random, example_with, with};
use cagedyn::model::{FORCE_SOURCES, Forces};
use cagedyn::{Model, Scene, Sim};
use serde_json::{Value, json};
use std::sync::Arc;

/// Compares the reports of a scene with and without something. `unchanged` lists the sources that must be the same to
/// the last bit, `gone` those that must be zero.
fn switched_off(
    changes: &[(&str, Value)],
    gone: &[usize],
    unchanged: &[usize],
    check: impl Fn(&Forces, &Forces, &State),
) {
    at_random_states(6, |name, b, state| {
        let what = format!("{name} without {changes:?}");
        let with_it = b.forces(state);
        let without = b.changed(changes).forces(state);
        assert_eq!(with_it.bodies.len(), without.bodies.len());
        for (i, (one, other)) in with_it.bodies.iter().zip(&without.bodies).enumerate() {
            for &source in gone {
                assert_eq!(other[source], [0.0; 3], "{what}: {} on body {i}", FORCE_SOURCES[source]);
            }
            for &source in unchanged {
                assert_eq!(one[source], other[source], "{what}: {} on body {i}", FORCE_SOURCES[source]);
            }
        }
        check(&with_it, &without, state);
    });
}

const ALL: [usize; 7] = [OUTER, INNER, POCKET, GUIDE, GRAVITY, LOAD, SUPPORT];

fn all_but(gone: usize) -> Vec<usize> {
    ALL.into_iter().filter(|&source| source != gone).collect()
}

#[test]
fn gravity_load_support_and_guide_vanish_alone() {
    let same_contacts = |a: &Forces, b: &Forces, _: &State| assert_eq!(a.contacts, b.contacts);
    for (path, source) in [
        ("gravity", GRAVITY),
        ("inner_ring.motion.free.load", LOAD),
        ("inner_ring.motion.free.support_damping", SUPPORT),
        ("cage.guide", GUIDE),
    ] {
        switched_off(&[(path, Value::Null)], &[source], &all_but(source), same_contacts);
    }
}

#[test]
fn pockets_vanish_alone() {
    switched_off(&[("cage.pocket", Value::Null)], &[POCKET], &all_but(POCKET), |a, b, _| {
        for (with_pocket, without) in a.contacts.chunks_exact(4).zip(b.contacts.chunks_exact(2)) {
            assert_eq!(&with_pocket[..2], without);
        }
    });
}

#[test]
fn the_cage_vanishes_alone() {
    at_random_states(6, |name, b, state| {
        let with_it = b.forces(state);
        let model =
            Model::new(Scene::from_value(&with(&b.scene, &[("cage", Value::Null)])).unwrap()).unwrap();
        let mut sim = Sim::new(Arc::new(model)).unwrap();
        let n = b.count();
        let mut vector = state.vector();
        vector.drain(5 + 2 * n + 2..5 + 2 * n + 5);
        vector.drain(2..5);
        sim.set_state(0.0, &vector).unwrap();
        let without = sim.forces().unwrap();
        for (i, body) in without.bodies.iter().enumerate() {
            let other = &with_it.bodies[if i < CAGE { i } else { i + 1 }];
            for source in [OUTER, INNER, GRAVITY, LOAD, SUPPORT] {
                assert_eq!(body[source], other[source], "{name}: {} on body {i}", FORCE_SOURCES[source]);
            }
            for source in [POCKET, GUIDE] {
                assert_eq!(body[source], [0.0; 3], "{name}: {} on body {i}", FORCE_SOURCES[source]);
            }
        }
    });
}

#[test]
fn rolling_resistance_vanishes_alone() {
    let off = [("raceways.rolling_resistance", Value::Null)];
    switched_off(&off, &[], &[POCKET, GUIDE, GRAVITY, LOAD, SUPPORT], |a, b, _| {
        assert!(a.contacts.iter().any(|c| c[ROLLING] != 0.0));
        for (one, other) in a.contacts.iter().zip(&b.contacts) {
            assert_eq!(one[..=FRICTION], other[..=FRICTION]);
            assert_eq!(other[ROLLING..SLIP_SPEED], [0.0; 3]);
            assert_eq!(one[SLIP_SPEED..ROLLING_FACTOR], other[SLIP_SPEED..ROLLING_FACTOR]);
            assert_eq!(one[ROLLING_FACTOR] != 0.0, one[ROLLING] != 0.0);
            assert_eq!(other[ROLLING_FACTOR], 0.0);
            assert_eq!(one[ROLLING_FACTOR + 1..], other[ROLLING_FACTOR + 1..]);
        }
    });
}

#[test]
fn contact_laws_of_the_raceways_vanish_alone() {
    let path = |law: &str| format!("raceways.contact.{law}");
    // Each law, the quantities that it alone makes, and those that must not change without it.
    let heating = ["self_heating"];
    let traction = ["self_heating", "traction"];
    let friction = ["self_heating", "traction", "boundary_friction"];
    let film = ["self_heating", "traction", "boundary_friction", "thermal_correction", "film"];
    let rows: [(&[&str], &[usize], &[usize]); 5] = [
        (&heating, &[TEMPERATURE], &[NORMAL, FILM, FILM_RATIO, ROLLING]),
        (&traction, &[TEMPERATURE], &[NORMAL, FILM, FILM_RATIO, ROLLING]),
        (&friction, &[TEMPERATURE, FILM_RATIO, FRICTION], &[NORMAL, FILM, ROLLING]),
        (&["boundary_friction"], &[FILM_RATIO], &[NORMAL, FILM, ROLLING]),
        (&film, &[TEMPERATURE, FILM, FILM_RATIO, FRICTION], &[NORMAL, ROLLING]),
    ];
    for (laws, gone, unchanged) in rows {
        let paths: Vec<String> = laws.iter().map(|law| path(law)).collect();
        let changes: Vec<(&str, Value)> = paths.iter().map(|p| (p.as_str(), Value::Null)).collect();
        switched_off(&changes, &[], &[POCKET, GUIDE, GRAVITY, LOAD, SUPPORT], |a, b, _| {
            for (one, other) in a.contacts.chunks_exact(4).zip(b.contacts.chunks_exact(4)) {
                assert_eq!(one[2..], other[2..], "pocket contacts without {laws:?} on the raceways");
                for (one, other) in one[..2].iter().zip(&other[..2]) {
                    gone.iter().for_each(|&k| assert_eq!(other[k], 0.0, "without {laws:?}: {k}"));
                    for &k in unchanged.iter().chain(&[APPROACH, SLIP_SPEED, ROLLING_SPEED]) {
                        assert_eq!(one[k], other[k], "without {laws:?}: {k}");
                    }
                }
            }
        });
    }
}

#[test]
fn without_damping_the_elastic_force_remains() {
    let off = [
        ("raceways.contact.damping", Value::Null),
        ("cage.pocket.lubricated_cylinder.contact.damping", Value::Null),
    ];
    switched_off(&off, &[], &[GUIDE, GRAVITY, LOAD, SUPPORT], |_, b, _| {
        for (i, contact) in b.contacts.iter().enumerate() {
            let mate = if i % 4 < 2 { STEEL } else { BRASS };
            let expected = palmgren_load(contact[APPROACH], 20.4e-3, mate);
            let error = (contact[NORMAL] - expected).abs();
            assert!(error <= 1e-12 * expected, "contact {i}: {} instead of {expected}", contact[NORMAL]);
        }
    });
}

#[test]
fn edge_friction_vanishes_alone() {
    let off = [("cage.pocket.lubricated_cylinder.edge_friction", Value::Null)];
    let edges = std::cell::Cell::new(0);
    switched_off(&off, &[], &all_but(POCKET), |a, b, _| {
        for (one, other) in a.contacts.iter().zip(&b.contacts) {
            assert_eq!(one[..=FILM], other[..=FILM]);
            if one[NORMAL] > 0.0 && one[FILM] == 0.0 {
                edges.set(edges.get() + 1);
                assert!(one[FRICTION] != 0.0);
                assert_eq!(other[FRICTION], 0.0);
            }
        }
    });
    assert!(edges.get() > 100);
}

#[test]
fn without_squeeze_the_guide_force_ignores_the_velocity_of_the_cage() {
    for squeeze in [true, false] {
        let mut b = Bearing::new(example_with(&[("cage.guide.film.short_bearing.squeeze", json!(squeeze))]));
        let mut random = Random::new(7);
        for _ in 0..STATES_PER_SCENE {
            let moving = State::random(&b, &mut random);
            let mut resting = moving.clone();
            (resting.cage_velocity[0], resting.cage_velocity[1]) = (0.0, 0.0);
            let guide = [b.forces(&moving), b.forces(&resting)].map(|f| f.bodies[CAGE][GUIDE]);
            assert_eq!(guide[0] != guide[1], squeeze);
        }
    }
}
