//! Hard cases of roller bearings.

use crate::common::{example, with};
use crate::{Case, change_state};
use cagedyn::Sim;
use serde_json::{Value, json};
use std::f64::consts::PI;

const LOAD: &str = "inner_ring.motion.free.load.z";
const SPEED: &str = "inner_ring.speed";
const CLEARANCE: &str = "inner_ring.radial_clearance";

/// The example at `rpm` under a load in N.
fn at(rpm: f64, load: f64, others: &[(&str, Value)]) -> Value {
    let scene = with(
        &example(),
        &[(SPEED, json!({ "constant": -rpm * PI / 30.0 })), (LOAD, json!({ "constant": -load }))],
    );
    with(&scene, others)
}

fn example_with(others: &[(&str, Value)]) -> Value {
    with(&example(), others)
}

/// With as many rollers, of a size that fits.
fn rollers(count: u32) -> Value {
    let scale = if count > 12 { 14.0 / f64::from(count) } else { 1.0 };
    let radius = 7.5e-3 * scale;
    let mass = 0.0304 * scale * scale;
    let pocket = 0.15e-3 * scale;
    example_with(&[
        ("initial.inner_ring", json!(if count < 3 { "centred" } else { "equilibrium" })),
        ("rollers.count", json!(count)),
        ("rollers.radius", json!(radius)),
        ("rollers.mass", json!(mass)),
        ("rollers.inertia", json!(0.5 * mass * radius * radius)),
        ("cage.pocket.lubricated_cylinder.radial_clearance", json!(pocket)),
        ("cage.guide.guide_radius", json!(47.5e-3 - 0.3 * radius)),
    ])
}

fn pocket_clearance(clearance: f64) -> Value {
    example_with(&[("cage.pocket.lubricated_cylinder.radial_clearance", json!(clearance))])
}

/// Revolutions of the cage in a minute.
const REVOLUTIONS: f64 = 1219.0;

/// Goes to t = 60 s and turns cage and rollers by whole revolutions.
fn after_a_minute(sim: &mut Sim) {
    change_state(sim, 60.0, |name, x| {
        if name == "cage.angle" || name.ends_with("orbit_travel") {
            *x -= REVOLUTIONS * 2.0 * PI;
        }
    });
}

/// Rollers of the case in which they are bunched.
const BUNCHED: u32 = 8;

/// Puts all rollers beside each other at the bottom, where the load is.
fn bunch(sim: &mut Sim) {
    let count = f64::from(BUNCHED);
    // Rollers of 7.5 mm on a circle of 40 mm.
    let closest = 2.01 * (7.5f64 / 39.99).asin();
    let mut j = 0.0;
    change_state(sim, 0.0, |name, x| {
        if name.ends_with("orbit_travel") {
            *x += (j - 0.5 * count) * (closest - 2.0 * PI / count);
            j += 1.0;
        }
    });
}

/// Puts one roller 1 mm deep into the outer raceway.
fn press(sim: &mut Sim) {
    change_state(sim, 0.0, |name, x| {
        if name == "roller[3].radial_offset" {
            *x = 1e-3;
        }
    });
}

/// All of them.
pub fn cases() -> Vec<Case> {
    let pocket = "cage.pocket.lubricated_cylinder";
    let case = |name, why, scene, milliseconds: f64| Case::new(name, why, scene, 1e-3 * milliseconds);
    let land = "cage.guide.film.short_bearing.land_width";
    vec![
        case(
            "contacts without damping",
            "nothing takes energy out of contact vibration",
            example_with(&[("raceways.contact.damping", Value::Null)]),
            20.0,
        ),
        case("40 kN", "steep friction in heavy contacts", at(3000.0, 40e3, &[]), 20.0),
        case("200 kN", "friction so steep that speeds lock", at(3000.0, 200e3, &[]), 10.0),
        case("10 000 rpm at 100 N", "rollers and cage skid grossly", at(10e3, 100.0, &[]), 20.0),
        case(
            "60 000 rpm at 100 N",
            "centrifugal force parts the rollers from the inner ring",
            at(60e3, 100.0, &[]),
            5.0,
        ),
        case("no load", "nothing holds the rollers", at(3000.0, 0.0, &[]), 20.0),
        case(
            "load step",
            "from nothing to full load at once",
            example_with(&[(LOAD, json!({"step": {"before": 0.0, "after": -4900.0, "time": 5e-3}}))]),
            15.0,
        ),
        case(
            "load reversed in 0.1 ms",
            "the ring is thrown through the clearance",
            example_with(&[(
                LOAD,
                json!({"ramp": {"from": -4900.0, "to": 4900.0, "start": 5e-3, "end": 5.1e-3}}),
            )]),
            15.0,
        ),
        case(
            "load at 10 kHz",
            "the load changes within few steps",
            example_with(&[(
                LOAD,
                json!({"sine": {"mean": -2450.0, "amplitude": 2450.0, "frequency": 1e4, "phase": 0.0}}),
            )]),
            10.0,
        ),
        case(
            "start from rest",
            "films begin at rolling speed zero",
            example_with(&[(
                SPEED,
                json!({"ramp": {"from": 0.0, "to": -314.159, "start": 0.0, "end": 0.02}}),
            )]),
            20.0,
        ),
        case(
            "reversal",
            "films vanish as the speed passes through zero",
            example_with(&[(
                SPEED,
                json!({"ramp": {"from": -100.0, "to": 100.0, "start": 5e-3, "end": 15e-3}}),
            )]),
            20.0,
        ),
        case(
            "oscillating shaft",
            "speed passes through zero again and again",
            example_with(&[(
                SPEED,
                json!({"sine": {"mean": 0.0, "amplitude": 100.0, "frequency": 50.0, "phase": 0.0}}),
            )]),
            30.0,
        ),
        case(
            "preload of 5 um",
            "every roller is loaded from both sides",
            example_with(&[(CLEARANCE, json!(-5e-6))]),
            10.0,
        ),
        case(
            "clearance of 200 um",
            "one roller carries, the others fly",
            example_with(&[(CLEARANCE, json!(200e-6))]),
            20.0,
        ),
        case("one roller", "the ring falls past it", rollers(1), 1.0),
        case("two rollers", "the ring falls between them", rollers(2), 1.0),
        case("200 rollers", "many light rollers, many contacts", rollers(200), 2.0),
        case("pocket clearance 1 um", "impacts within a nanosecond's way", pocket_clearance(1e-6), 5.0),
        case("pocket clearance 20 um", "rollers rattle", pocket_clearance(20e-6), 10.0),
        case("pocket clearance 0.4 mm", "long flights, hard impacts", pocket_clearance(0.4e-3), 20.0),
        case(
            "narrow pocket walls",
            "friction jumps at edges after 6 degrees of wall, without blending",
            example_with(&[
                (&format!("{pocket}.half_angle"), json!(3.0 * PI / 180.0)),
                (&format!("{pocket}.edge_blend"), json!(0.0)),
            ]),
            10.0,
        ),
        case(
            "guide land of 0.5 mm",
            "the film carries only when it is almost gone",
            example_with(&[(land, json!(0.5e-3))]),
            20.0,
        ),
        case(
            "cage dropped in a standing bearing",
            "nothing rolls, films only squeeze",
            at(0.0, 4900.0, &[]),
            20.0,
        ),
        case(
            "roundness near the clearance",
            "the film is modulated by nine tenths of its thickness",
            example_with(&[(
                "cage.guide.roundness",
                json!([{ "order": 3, "amplitude": 0.2e-3, "phase": 0.0 }]),
            )]),
            5.0,
        ),
        case("1 rpm", "boundary lubrication, film ratio far below 0.06", at(1.0, 4900.0, &[]), 20.0),
        case(
            "viscosity 1e-4 Pa s",
            "hardly any film anywhere",
            example_with(&[("lubricant.viscosity", json!({"constant": 1e-4}))]),
            10.0,
        ),
        case(
            "viscosity 10 Pa s",
            "films brake more than loads drive",
            example_with(&[("lubricant.viscosity", json!({"constant": 10.0}))]),
            10.0,
        ),
        case(
            "load dropped through the clearance",
            "the start of the paper: the ring falls and bounces",
            example_with(&[("initial.inner_ring", json!("centred"))]),
            10.0,
        ),
        case(
            "rollers bunched on one side",
            "nothing keeps the rollers apart, and the ring slips off them",
            example_with(&[
                ("rollers.count", json!(BUNCHED)),
                ("cage", Value::Null),
                ("initial", json!({"inner_ring": "centred", "first_roller_angle": 0.0})),
            ]),
            1.0,
        )
        .from(bunch),
        case("roller 1 mm deep", "a force of tons at the start", example(), 5.0).from(press),
        case("after a minute", "angles of a thousand revolutions keep their digits", example(), 20.0)
            .from(after_a_minute),
        case(
            "cage against a pocket wall at the start",
            "several walls touch at once",
            example_with(&[("initial.cage", json!({"y": 0.16e-3, "z": 0.0}))]),
            10.0,
        ),
    ]
}
