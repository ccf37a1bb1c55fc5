//! The NU2310 with profiles of rollers and raceways: power balance by every kind of method, equilibrium at the start, bits
//! without vector instructions, and slip.

use cagedyn::model::POWERS;
use cagedyn::{Model, Scene, Sim};
use std::sync::Arc;

const LOGARITHM: &str = r#"{"logarithmic": {"design_load": 10880, "crowned_share": 0.6, "end_drop": 12e-6}}"#;
const CROWN: &str = r#"{"circular_crown": {"radius": 5.2}}"#;

fn sim(changes: &[(&str, &str)]) -> Sim {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/nu2310.json");
    let scene = Scene::from_json_with(&std::fs::read_to_string(path).unwrap(), changes.iter().copied());
    Sim::new(Arc::new(Model::new(scene.unwrap()).unwrap())).unwrap()
}

/// Profiles of the rollers, of raceways, and of both.
const PROFILES: [&[(&str, &str)]; 3] = [
    &[("rollers.profile", LOGARITHM)],
    &[("rollers.profile", CROWN)],
    &[
        ("rollers.profile", LOGARITHM),
        ("outer_ring.raceway_crown_radius", "9.0"),
        ("inner_ring.raceway_crown_radius", "40.0"),
        ("raceways.slices", "4"),
    ],
];

#[test]
fn the_power_balance_closes() {
    for profile in PROFILES {
        for method in [
            r#"{"method": {"auto": {}}}"#,
            r#"{"method": {"leapfrog": {"step": 1e-6}}}"#,
            r#"{"method": {"dormand_prince": {"tolerance": 1e-5}}}"#,
            r#"{"method": {"rosenbrock": {"tolerance": 1e-4}}}"#,
        ] {
            let mut sim = sim(&[profile, &[("solver", method)]].concat());
            sim.advance_to(if method.contains("auto") { 40e-3 } else { 8e-3 }).unwrap();
            let balance = sim.power_balance().unwrap();
            println!("{method} {profile:?}: {:.1e}", balance.relative_residual());
            assert!(balance.relative_residual().abs() < 1e-3, "{method} {profile:?}: {balance:?}");
            // Contacts take power.
            for (name, work) in POWERS.iter().zip(balance.work) {
                let taken = ["raceway_damping", "raceway_friction", "rolling_resistance"].contains(name);
                assert!(!taken || work < 0.0, "{name}: {work} J with {method} {profile:?}");
            }
        }
    }
}

#[test]
fn a_loaded_bearing_starts_at_rest() {
    for profile in PROFILES {
        let mut sim = sim(&[profile, &[("inner_ring.speed.constant", "0.0"), ("gravity", "null")]].concat());
        let mut rate = vec![0.0; sim.state().len()];
        let state = sim.state().to_vec();
        sim.derivative(0.0, &state, &mut rate).unwrap();
        let places =
            |name: &str| sim.model().state_infos().iter().position(|info| info.name == name).unwrap();
        for axis in ["inner_ring.vy", "inner_ring.vz"] {
            // 4900 N on 3 kg would be 1600 m/s^2.
            assert!(rate[places(axis)].abs() < 1e-4, "{axis}: {} m/s^2 of {profile:?}", rate[places(axis)]);
        }
        let straight = self::sim(&[("inner_ring.speed.constant", "0.0"), ("gravity", "null")]);
        let z = places("inner_ring.z");
        let deeper = straight.state()[z] - state[z];
        assert!(deeper > 1e-7 && deeper < 1e-5, "{deeper} m deeper with {profile:?}");
    }
}

#[test]
fn instructions_do_not_change_bits() {
    for profile in PROFILES {
        let [vector, plain] = [true, false].map(|vector| {
            let mut sim = sim(profile);
            sim.set_vector_instructions(vector);
            sim.advance_to(10e-3).unwrap();
            sim.state().iter().map(|x| x.to_bits()).collect::<Vec<u64>>()
        });
        assert!(vector == plain, "{profile:?}");
    }
}
