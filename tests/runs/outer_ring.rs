//! Bearings whose outer ring turns: alone, against the inner ring, and with the whole bearing.

use crate::common::{example_with, read, with};
use crate::started::bits;
use cagedyn::model::{HostInputs, POWERS};
use cagedyn::{Model, Sim};
use serde_json::{Value, json};
use std::sync::Arc;

const FREE_LOAD: &str = "inner_ring.motion.free.load";
const SLIP_SPEED: usize = 10;
const ROLLING_SPEED: usize = 11;
const NORMAL: usize = 0;

fn sim(scene: &Value) -> Sim {
    Sim::new(Arc::new(Model::from_json(&scene.to_string()).unwrap_or_else(|e| panic!("{e}")))).unwrap()
}

fn constant(speed: f64) -> Value {
    json!({"constant": speed})
}

/// The example with these speeds of inner and outer ring, rad/s, and no play.
fn bearing(inner: f64, outer: f64) -> Value {
    example_with(&[
        ("inner_ring.speed", constant(inner)),
        ("outer_ring.speed", constant(outer)),
        ("inner_ring.radial_clearance", json!(0.0)),
    ])
}

/// The same without gravity and load: rollers lie on the outer raceway by their centrifugal force.
fn unloaded(inner: f64, outer: f64) -> Value {
    with(&bearing(inner, outer), &[("gravity", Value::Null), (FREE_LOAD, Value::Null)])
}

fn grease(changes: &[(&str, Value)]) -> Value {
    with(&serde_json::from_str(&read("scenes/grease_guide.json")).unwrap(), changes)
}

fn kinematic_speeds(scene: &Value) -> [f64; 2] {
    let model = Model::from_json(&scene.to_string()).unwrap_or_else(|e| panic!("{e}"));
    model.kinematic_speeds(&model.inputs_at(0.0, &HostInputs::default()))
}

fn place_of_power(name: &str) -> usize {
    POWERS.iter().position(|power| *power == name).unwrap()
}

/// Place of a velocity in the state vector.
fn place_of_state(sim: &Sim, name: &str) -> usize {
    sim.model().state_infos().iter().rposition(|info| info.name == name).unwrap()
}

/// Largest slip speed and rolling speed of loaded raceway contacts, m/s.
fn raceway_speeds(sim: &mut Sim) -> [f64; 2] {
    let names = sim.model().contact_names();
    let forces = sim.forces().unwrap();
    let raceways = names
        .iter()
        .zip(&forces.contacts)
        .filter(|(name, contact)| name.ends_with("_raceway") && contact[NORMAL] > 0.0);
    let speeds = raceways.map(|(_, contact)| [contact[SLIP_SPEED].abs(), contact[ROLLING_SPEED].abs()]);
    let mut count = 0;
    let largest = speeds.inspect(|_| count += 1).fold([0.0f64; 2], |[a, b], [x, y]| [a.max(x), b.max(y)]);
    assert!(count >= 5, "{count} loaded contacts");
    largest
}

/// Mean of a channel between two times, s.
fn mean(sim: &mut Sim, channel: &str, from: f64, to: f64) -> f64 {
    let place = sim.channels().iter().position(|c| c.name == channel).unwrap();
    let records = 1000;
    sim.advance_to(from).unwrap();
    let values = (1..=records).map(|i| {
        sim.advance_to(from + (to - from) * f64::from(i) / f64::from(records)).unwrap();
        sim.output(place).unwrap()
    });
    values.sum::<f64>() / f64::from(records)
}

#[test]
fn a_bearing_that_turns_as_a_whole_neither_slips_nor_loses() {
    let speed = -280.0;
    for clearance in [0.0, 40e-6] {
        let scene = with(&unloaded(speed, speed), &[("inner_ring.radial_clearance", json!(clearance))]);
        let mut sim = sim(&scene);
        if clearance > 0.0 {
            // A roller that touches both rings creeps through the play of a load that stands; without load it does not.
            let mut state = sim.state().to_vec();
            for (i, info) in sim.model().state_infos().iter().enumerate() {
                if ["orbit_speed", "spin_speed", "cage.speed"].iter().any(|end| info.name.ends_with(end)) {
                    state[i] = speed;
                }
            }
            sim.set_state(0.0, &state).unwrap();
        }
        let mut largest = [0.0f64; 2];
        for i in 0..=20 {
            sim.advance_to(5e-4 * f64::from(i)).unwrap();
            let [slip, rolling] = raceway_speeds(&mut sim);
            largest = [largest[0].max(slip), largest[1].max(rolling)];
        }
        let cage = sim.state()[place_of_state(&sim, "cage.speed")];
        let balance = sim.power_balance().unwrap();
        println!("{clearance}: {largest:?} m/s, cage {cage}, {balance:?}");
        // Surfaces move at 13 m/s.
        assert!(largest.iter().all(|speed| *speed < 1e-5), "{largest:?}");
        assert!((cage / speed - 1.0).abs() < 1e-7, "{cage}");
        for name in ["raceway_friction", "rolling_resistance", "pocket_friction", "guide_film"] {
            let work = balance.work[place_of_power(name)];
            assert!(work.abs() < 1e-8, "{name}: {work} J");
        }
    }
}

#[test]
fn speeds_without_slip_are_those_of_rolling_on_both_rings() {
    let (outer_raceway, roller) = (47.5e-3, 7.5e-3);
    let (pitch, inner_raceway) = (outer_raceway - roller, outer_raceway - 2.0 * roller);
    let near = |found: f64, expected: f64, size: f64| {
        assert!((found - expected).abs() < 1e-12 * size, "{found} {expected}");
    };
    for (inner, outer) in [(0.0, 300.0), (-200.0, 130.0), (250.0, 250.0)] {
        // The centre moves at the mean of the surface speeds; seen from there both surfaces run at half of their difference.
        let [orbit, spin] = kinematic_speeds(&bearing(inner, outer));
        let [a, b] = [inner * inner_raceway, outer * outer_raceway];
        near(orbit, (a + b) / (2.0 * pitch), 300.0);
        near(spin, (b - a) / (2.0 * roller), 3000.0);
        // Balls of an angular contact bearing.
        let scene = grease(&[
            ("inner_ring.speed", constant(inner)),
            ("outer_ring", json!({"speed": constant(outer)})),
        ]);
        let elements = &scene["kinematic_elements"];
        let number = |value: &Value| value.as_f64().unwrap();
        let ratio = number(&elements["radius"]) / number(&elements["pitch_radius"]);
        let angle = number(&elements["motion"]["rolling"]["contact_angle"]);
        let gamma = ratio * angle.cos();
        let [orbit, spin] = kinematic_speeds(&scene);
        near(orbit, 0.5 * (inner * (1.0 - gamma) + outer * (1.0 + gamma)), 300.0);
        let about_itself = 0.5 / ratio * (1.0 - gamma * gamma) * (outer - inner) * angle.cos();
        near(spin, orbit + about_itself, 3000.0);
    }
    // A bearing starts with them: nothing slides but what the elastic approach of 5 um makes.
    let [slip, rolling] = raceway_speeds(&mut sim(&bearing(0.0, 300.0)));
    assert!(slip < 1e-3 * rolling && rolling > 5.0, "{slip} {rolling}");
    let [slip, rolling] = raceway_speeds(&mut sim(&unloaded(0.0, 300.0)));
    assert!(slip < 1e-4 * rolling && rolling > 5.0, "{slip} {rolling}");
}

#[test]
fn the_cage_goes_with_an_outer_ring_that_turns_alone() {
    let outer = 300.0;
    let scene = bearing(0.0, outer);
    let [orbit, _] = kinematic_speeds(&scene);
    let mut sim = sim(&scene);
    let found = mean(&mut sim, "cage.speed", 0.02, 0.06);
    println!("cage {found} rad/s, without slip {orbit}");
    assert!((found / orbit - 1.0).abs() < 0.03, "{found} {orbit}");
    let slip = sim.channels().iter().position(|c| c.name == "cage.slip").unwrap();
    assert!(sim.output(slip).unwrap().abs() < 0.05);
}

#[test]
fn rings_that_turn_against_each_other_leave_the_cage_where_it_is() {
    let outer = 220.0;
    let inner = -outer * 47.5 / 32.5;
    let scene = bearing(inner, outer);
    let [orbit, spin] = kinematic_speeds(&scene);
    assert!(orbit.abs() < 1e-10 && (spin / (outer * 47.5 / 7.5) - 1.0).abs() < 1e-12, "{orbit} {spin}");
    let mut sim = sim(&scene);
    let found = mean(&mut sim, "cage.speed", 0.01, 0.04);
    println!("cage {found} rad/s");
    assert!(found.abs() < 0.02 * outer, "{found}");
    // Loaded rollers spin in their places.
    let slips: Vec<f64> = (0..12)
        .map(|j| {
            let place = sim.channels().iter().position(|c| c.name == format!("roller[{j}].slip")).unwrap();
            sim.output(place).unwrap()
        })
        .collect();
    let least = slips.iter().fold(1.0f64, |least, slip| least.min(slip.abs()));
    assert!(least < 0.01, "{slips:?}");
    let cage_slip = sim.channels().iter().position(|c| c.name == "cage.slip").unwrap();
    assert_eq!(sim.output(cage_slip).unwrap(), 0.0);
}

#[test]
fn the_power_balance_has_the_work_of_the_outer_ring() {
    let outer = 200.0;
    let rollers = with(&bearing(-100.0, outer), &[("inner_ring.radial_clearance", json!(20e-6))]);
    let greased =
        grease(&[("inner_ring.speed", constant(-60.0)), ("outer_ring", json!({"speed": constant(outer)}))]);
    for (name, scene) in [("rollers", rollers), ("grease", greased)] {
        let mut sim = sim(&scene);
        let (start, end) = (4e-3, 24e-3);
        sim.advance_to(start).unwrap();
        let before = sim.power_balance().unwrap();
        let torque = mean(&mut sim, "outer_ring.drag_torque", start, end);
        let moment = sim.channels().iter().position(|c| c.name == "outer_ring.torque").unwrap();
        let drag = sim.channels().iter().position(|c| c.name == "outer_ring.drag_torque").unwrap();
        assert_eq!(sim.output(drag).unwrap(), -sim.output(moment).unwrap());
        let after = sim.power_balance().unwrap();
        let drive = place_of_power("outer_ring_drive");
        let work = after.work[drive] - before.work[drive];
        let expected = torque * outer * (after.to - before.to);
        println!("{name}: {work} J, from the torque {expected} J, {:e}", after.relative_residual());
        assert!(after.relative_residual().abs() < 1e-3, "{name}: {after:?}");
        assert!(work > 0.0 && (work / expected - 1.0).abs() < 0.03, "{name}: {work} {expected}");
    }
}

#[test]
fn an_outer_ring_at_rest_changes_no_bit() {
    let grease_scene = grease(&[]);
    for (scene, until) in [(example_with(&[]), 4e-3), (grease_scene, 10e-3)] {
        for solver in [json!({}), json!({"method": {"rosenbrock": {"tolerance": 1e-5}}})] {
            let scene = with(&scene, &[("solver", solver)]);
            let outer = if scene["outer_ring"].is_null() { json!({}) } else { scene["outer_ring"].clone() };
            let standing = with(&scene, &[("outer_ring", outer), ("outer_ring.speed", constant(0.0))]);
            let end = |scene: &Value| {
                let mut sim = sim(scene);
                sim.advance_to(until).unwrap();
                let recorded = sim.model().recorded().to_vec();
                let names: Vec<_> = recorded.iter().map(|i| sim.channels()[*i].name.clone()).collect();
                let values: Vec<_> = recorded.into_iter().map(|i| sim.output(i).unwrap()).collect();
                (bits(sim.state()), names, bits(&values))
            };
            assert_eq!(end(&scene), end(&standing));
        }
    }
}

#[test]
fn all_methods_find_the_same_motion() {
    let swing = json!({"sine": {"mean": 150.0, "amplitude": 40.0, "frequency": 300.0, "phase": 0.4}});
    let scene = with(&bearing(-120.0, 0.0), &[("outer_ring.speed", swing)]);
    let at_end = |method: Value| {
        let mut sim = sim(&with(&scene, &[("solver", json!({"method": method}))]));
        sim.advance_to(1.5e-3).unwrap();
        sim.state().to_vec()
    };
    let reference = at_end(json!({"dormand_prince": {"tolerance": 1e-9}}));
    let scales = Model::from_json(&scene.to_string()).unwrap().state_scales();
    for (method, bound) in [
        (json!({"radau": {"tolerance": 1e-8}}), 1e-4),
        (json!({"adams": {"tolerance": 1e-8}}), 1e-4),
        (json!({"rosenbrock": {"tolerance": 1e-7}}), 1e-4),
        (json!({"leapfrog": {"step": 0.25e-6}}), 2e-2),
        (json!({"auto": {"tolerance": 1e-7}}), 2e-2),
    ] {
        let found = at_end(method.clone());
        let positions = 5 + 2 * 12;
        let off = (0..positions).map(|i| (found[i] - reference[i]).abs() / scales[i]).fold(0.0, f64::max);
        println!("{method}: {off:e} of the guide clearance");
        assert!(off < bound, "{method}: {off:e}");
    }
}

#[test]
fn a_host_turns_the_outer_ring() {
    let scene =
        with(&grease(&[("outer_ring", json!({"speed": constant(0.0)}))]), &[("gravity", Value::Null)]);
    let mut sim = sim(&scene);
    let input = sim.model().input_infos().iter().position(|info| info.name == "outer_ring.speed").unwrap();
    sim.advance_to(1e-3).unwrap();
    let place = sim.channels().iter().position(|c| c.name == "element[0].orbit_angle").unwrap();
    let before = sim.output(place).unwrap();
    sim.set_input(input, 80.0).unwrap();
    sim.advance_to(1.5e-3).unwrap();
    let expected =
        0.5 * (314.159_265_358_979_3 * (1.0 - gamma(&scene)) + 80.0 * (1.0 + gamma(&scene))) * 0.5e-3;
    let turned = sim.output(place).unwrap() - before;
    assert!((turned / expected - 1.0).abs() < 1e-9, "{turned} {expected}");
}

/// Element over pitch radius, times the cosine of the contact angle.
fn gamma(scene: &Value) -> f64 {
    let elements = &scene["kinematic_elements"];
    let number = |value: &Value| value.as_f64().unwrap();
    let angle = number(&elements["motion"]["rolling"]["contact_angle"]);
    number(&elements["radius"]) / number(&elements["pitch_radius"]) * angle.cos()
}

#[test]
fn a_cage_among_rings_that_turn_has_the_steady_whirl_of_its_run() {
    let solved = |speed: f64| {
        let outer = json!({"speed": constant(speed)});
        let scene = grease(&[("outer_ring", outer), ("gravity", Value::Null)]);
        let whirl = cagedyn::whirl::steady(
            &cagedyn::Scene::from_json(&scene.to_string()).unwrap(),
            None,
            &Default::default(),
        );
        (scene, whirl.unwrap_or_else(|e| panic!("{speed}: {e}")))
    };
    let (_, at_rest) = solved(0.0);
    // A land that turns with the cage drags it less, one that turns against it more.
    for speed in [30.0, -60.0] {
        let (scene, whirl) = solved(speed);
        let start = json!({"y": whirl.eccentricity, "z": 0.0});
        let push = json!({"y": 0.0, "z": 0.8 * whirl.speed * whirl.eccentricity});
        let scene = with(&scene, &[("initial.cage", start), ("initial.cage_velocity", push)]);
        let found = mean(&mut sim(&scene), "cage.whirl_speed", 0.04, 0.07);
        println!("{speed}: {} rad/s, in a run {found}, on a ring at rest {}", whirl.speed, at_rest.speed);
        assert!((whirl.speed / found - 1.0).abs() < 0.01, "{speed}: {} {found}", whirl.speed);
        assert!((whirl.speed.abs() < at_rest.speed.abs()) == (speed > 0.0));
    }
}
