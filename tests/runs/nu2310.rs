//! The NU2310 bearing: cage positions, slip and trends over clearance, load and speed.
//!
//! Bands are the accuracy at which the reference values are known (0.03 of the clearance, 0.03 in slip), not what
//! a run happens to give. Means are over the last 0.4 s of 0.6 s, for slip over the last 0.1 s of 0.3 s, for the
//! trends over the last 0.6 s of 0.8 s: the motion is chaotic, and means over 0.1 s scatter by about 0.01.

use cagedyn::scene::{CaseSet, Scene};
use cagedyn::{Model, Recording, Sim};
use std::sync::Arc;

/// What the tests look at.
#[derive(Clone, Copy, Debug)]
struct Outcome {
    y: f64,
    z: f64,
    largest_slip: f64,
}

fn read(name: &str) -> String {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

fn run(scene: Scene, duration: f64, window: f64) -> Outcome {
    let interval = scene.record.interval;
    let mut sim = Sim::new(Arc::new(Model::new(scene).unwrap())).unwrap();
    let mut recording = Recording::default();
    recording.run(&mut sim, duration, interval, |_, _| true).unwrap();
    let from = duration - window + 1e-9;
    let column = |name: &str| sim.channels().iter().position(|c| c.name == name).unwrap();
    let slips = sim.channels().iter().enumerate().filter(|(_, c)| c.name.ends_with("].slip"));
    Outcome {
        y: recording.spread(column("cage.y_ratio"), from).unwrap().mean,
        z: recording.spread(column("cage.z_ratio"), from).unwrap().mean,
        largest_slip: slips
            .map(|(i, _)| recording.spread(i, from).unwrap().max)
            .fold(f64::NEG_INFINITY, f64::max),
    }
}

fn close(outcome: Outcome, y: f64, z: f64) {
    assert!((outcome.y - y).abs() < 0.03 && (outcome.z - z).abs() < 0.03, "{outcome:?}, expected ({y}, {z})");
}

#[test]
fn cage_position_at_40_um() {
    let outcome = run(Scene::from_json(&read("nu2310.json")).unwrap(), 0.6, 0.4);
    println!("{outcome:?}");
    close(outcome, -0.61, 0.25);
}

#[test]
fn cage_position_and_slip_at_5_um() {
    let overrides = [("inner_ring.radial_clearance", "5e-6")];
    let outcome = run(Scene::from_json_with(&read("nu2310.json"), overrides).unwrap(), 0.3, 0.1);
    println!("{outcome:?}");
    close(outcome, -0.54, 0.45);
    assert!((outcome.largest_slip - 0.30).abs() < 0.03, "{outcome:?}");
}

#[test]
fn dropping_the_load_through_the_clearance_gives_the_same_steady_state() {
    let overrides = [("initial.inner_ring", "\"centred\"")];
    close(run(Scene::from_json_with(&read("nu2310.json"), overrides).unwrap(), 0.6, 0.4), -0.61, 0.25);
}

#[test]
fn trends_of_the_twelve_cases() {
    let set = CaseSet::from_json(&read("nu2310_fig9.cases.json")).unwrap();
    let scenes = set.scenes(&read(&set.scene)).unwrap();
    let outcomes: Vec<(String, Outcome)> =
        set.cases.iter().zip(scenes).map(|(c, scene)| (c.name.clone(), run(scene, 0.8, 0.6))).collect();
    for (name, outcome) in &outcomes {
        println!("{name}: {outcome:?}");
    }
    assert_eq!(outcomes.len(), 12);
    let z = |clearance: u32, load: u32, speed: u32| {
        let name = format!("{clearance}um-{load}N-{speed}rpm");
        outcomes.iter().find(|(n, _)| *n == name).unwrap().1.z
    };
    for clearance in [40, 5] {
        for load in [980, 4900] {
            let rising = [1000, 3000, 5000].map(|speed| z(clearance, load, speed));
            assert!(rising[0] < rising[1] && rising[1] < rising[2], "{clearance} um, {load} N: {rising:?}");
        }
        for speed in [1000, 3000, 5000] {
            assert!(z(clearance, 980, speed) < z(clearance, 4900, speed), "{clearance} um, {speed} rpm");
        }
    }
    for speed in [1000, 3000, 5000] {
        assert!(z(40, 4900, speed) < z(5, 4900, speed), "4900 N, {speed} rpm");
    }
}
