//! Hard cases of cages that bend and of lumps whose temperature moves with the run.

use crate::common::{read, with};
use crate::{Case, change_state};
use cagedyn::Sim;
use serde_json::{Value, json};

const LAYER: &str = "cage.guide.film.lubricant_layer.thickness";
const BENDING: &str = "cage.elastic_ring.stiffness.bending";
const MODES: &str = "cage.elastic_ring.modes";
const IN_MOTION: &str = "heat.in_motion";

fn scene_of(name: &str, changes: &[(&str, Value)]) -> Value {
    let scene: Value =
        serde_json::from_str(&read(&format!("scenes/{name}.json"))).expect("the scene is JSON");
    with(&scene, changes)
}

fn greased(changes: &[(&str, Value)]) -> Value {
    scene_of("grease_guide_elastic", changes)
}

/// The film's temperature is a state with a capacity that is warmed within milliseconds.
fn warm(changes: &[(&str, Value)]) -> Value {
    let quick = [(IN_MOTION, json!(["film"])), ("heat.nodes.0.capacity", json!(2e-3))];
    with(&scene_of("grease_guide_heat", &quick), changes)
}

/// Cold oil between a hot ring that turns backwards and hotter rollers, whose temperature is a state that closes in within milliseconds.
fn cold_oil() -> Value {
    scene_of(
        "nu2310_heat",
        &[
            ("inner_ring.speed.constant", json!(-314.159)),
            ("heat.nodes.0.start", json!(285.0)),
            ("heat.nodes.1.start", json!(351.0)),
            ("heat.nodes.2.start", json!(357.0)),
            (IN_MOTION, json!(["oil"])),
            ("heat.own_time", json!(1e-3)),
        ],
    )
}

/// Bends the ring by a fifth of its radius, outwards at both ends of a diameter: close to where it has no stable shape.
fn bent(sim: &mut Sim) {
    change_state(sim, 0.0, |name, x| {
        if name == "cage.mode[2].a" {
            *x = 8e-3;
        }
    });
}

/// All of them.
pub fn cases() -> Vec<Case> {
    let case = |name, why, scene, milliseconds: f64| Case::new(name, why, scene, 1e-3 * milliseconds);
    let free = [("cage.guide", Value::Null), ("cage.pocket", Value::Null)];
    vec![
        case("ring bent by a fifth of its radius", "it nearly flips through", greased(&free), 2.0).from(bent),
        case(
            "ring like rubber",
            "bending 2600 times as soft as in the scene of the greased guide",
            greased(&[(BENDING, json!(1e-4))]),
            8.0,
        ),
        case(
            "wet arcs that merge",
            "lobes bring arcs of the film together and part them",
            greased(&[(LAYER, json!(180e-6)), (MODES, json!(6))]),
            8.0,
        ),
        case("layer that floods a bent guide", "there is no dry arc", greased(&[(LAYER, json!(1e-3))]), 8.0),
        case(
            "waves beyond any step",
            "orders up to twelve of a stiff ring",
            greased(&[(MODES, json!(12)), (BENDING, json!(1e4))]),
            8.0,
        ),
        case(
            "ring without damping",
            "nothing takes energy out of its waves",
            greased(&[("cage.elastic_ring.damping", json!(0.0))]),
            8.0,
        ),
        case(
            "brass ring of the NU2310",
            "its waves are faster than steps for rollers",
            scene_of("nu2310_elastic", &[]),
            8.0,
        ),
        case(
            "film at the cold end",
            "a viscosity law near its end, a hundred times as thick as at 40 C",
            warm(&[("heat.ambient", json!(255.0)), ("heat.nodes.0.start", json!(255.0))]),
            12.0,
        ),
        case(
            "film at the hot end",
            "hardly any viscosity, and the law ends 2 K above",
            warm(&[("heat.ambient", json!(440.0)), ("heat.nodes.0.start", json!(448.0))]),
            12.0,
        ),
        case(
            "film with a conductance of zero",
            "all that it takes in leaves through the cage",
            warm(&[("heat.links.0.conductance.constant", json!(0.0))]),
            12.0,
        ),
        case(
            "cold oil between hot steel",
            "285 K between a ring of 351 K, turning backwards, and rollers of 357 K",
            cold_oil(),
            3.0,
        ),
    ]
}
