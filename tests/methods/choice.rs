//! The choice of a method on small systems: what it measures, when it leaves the leapfrog and returns, and the selection
//! between the methods with error control.

use crate::common::systems::Stiffening;
use cagedyn::integrate::Tuning;
use cagedyn::integrate::auto::mode::{Mode, ModeFinder};
use cagedyn::integrate::auto::stability::Expectation;
use cagedyn::integrate::auto::{Aim, Auto, Kind, Reason};
use cagedyn::integrate::{Driver, Leapfrog, Limits, Linearization, Structure};

fn limits(step: f64) -> Limits {
    Limits { nominal_step: step, min_step: 1e-14, max_step: 0.5, max_steps: 10_000_000 }
}

/// A chain in the shape of an arrowhead: a hub mass on a spring, and a spoke mass on the hub.
fn coupled(k: [f64; 2], d: f64) -> (Structure<3>, Linearization<3>) {
    let structure = Structure::around(1, vec![[1, 2, 3]]);
    let mut slopes = Linearization::new(&structure, 4);
    slopes.clear();
    for (part, k) in [(&mut slopes.over_positions, k), (&mut slopes.over_velocities, k.map(|k| k * d))] {
        part.hub[(0, 0)] = -(k[0] + k[1]);
        part.to_hub[(0, 0)] = k[1];
        part.from_hub[(0, 0)] = k[1];
        part.own[(0, 0)] = -k[1];
    }
    (structure, slopes)
}

#[test]
fn the_fastest_vibration_of_a_chain_is_found() {
    for (units, stiffness) in [([1.0; 7], [1.0, 3.0]), ([2.0, 0.1, 5.0, 1.0, 1.0, 1.0, 1.0], [7.0, 0.2])] {
        let (structure, slopes) = coupled(stiffness, 0.02);
        let mode = ModeFinder::new(&structure, 3, &units).find(&slopes);
        // Roots of (a - x)(b - x) = b^2 with a = k1 + k2, b = k2.
        let [a, b] = [stiffness[0] + stiffness[1], stiffness[1]];
        let square = 0.5 * (a + b) + (0.25 * (a - b) * (a - b) + b * b).sqrt();
        assert!((mode.frequency / square.sqrt() - 1.0).abs() < 1e-6, "{mode:?} {}", square.sqrt());
        // Damping proportional to stiffness: ratio = d w/2.
        assert!((mode.damping_ratio / (0.01 * square.sqrt()) - 1.0).abs() < 0.01 * units[0], "{mode:?}");
    }
    let (structure, mut nothing) = coupled([0.0; 2], 0.0);
    nothing.clear();
    assert_eq!(ModeFinder::new(&structure, 3, &[1.0; 7]).find(&nothing), Mode::default());
}

fn auto(system: &Stiffening, statistics: bool) -> Driver<Stiffening> {
    let aim = Aim {
        statistics,
        // Damping is expected where there is none.
        expected: Expectation {
            frequency: 1.0,
            damped: true,
            share: 0.1,
            careful_share: 0.1,
            largest_step: 1.0,
        },
        units: vec![100.0; 2],
        tolerance: 1e-8,
        first_step: 1e-3,
        missing_energy: 1e-3,
        tuning: Tuning::default(),
    };
    let limits = limits(aim.nominal_step());
    let mut driver = Driver::new(Box::new(Auto::new(system, aim)), limits);
    driver.start(0.0, &[1.0, 0.0]);
    driver
}

#[test]
fn the_choice_leaves_the_leapfrog_where_it_must_and_returns() {
    let infinity = f64::INFINITY;
    // Twenty times the frequency for a while.
    let mut system =
        Stiffening { squares: [(0.0, 1.0), (60.0, 400.0), (160.0, 1.0)], fails_from: infinity, failures: 0 };
    let mut driver = auto(&system, true);
    let at = |driver: &mut Driver<Stiffening>, system: &mut Stiffening, t: f64| {
        driver.advance(system, t).unwrap();
        driver.choice().unwrap()
    };
    let before = at(&mut driver, &mut system, 55.0);
    assert_eq!((before.method, before.reason), (Kind::Leapfrog, Reason::Vibration));
    // No damping was found: half the step.
    assert!((before.leapfrog_step - 0.05).abs() < 1e-3, "{before:?}");
    let stiff = at(&mut driver, &mut system, 150.0);
    // Many steps for a tolerance as tight as this: the Radau method, whose order is higher, is tried.
    assert_eq!(stiff.reason, Reason::Cost, "{stiff:?}");
    assert!(stiff.steps[Kind::Radau as usize] > stiff.steps[Kind::Rosenbrock as usize], "{stiff:?}");
    assert!((stiff.highest_frequency - 20.0).abs() < 0.1, "{stiff:?}");
    let after = at(&mut driver, &mut system, 3000.0);
    assert_eq!((after.method, after.reason), (Kind::Leapfrog, Reason::Vibration), "{after:?}");
    assert!(after.steps[0] > 1000 && after.steps[2] > 100 && after.changes >= 2, "{after:?}");
}

/// What is measured beside the run leaves no trace in it.
#[test]
fn measurements_leave_the_run_alone() {
    let mut system = Stiffening { squares: [(0.0, 1.0); 3], fails_from: f64::INFINITY, failures: 0 };
    let mut driver = auto(&system, true);
    let (mut start, mut state) = (0.0_f64, [1.0, 0.0]);
    // One step at a time, up to the first one of the leapfrog.
    loop {
        driver.advance(&mut system, start.next_up()).unwrap();
        if driver.choice().unwrap().method == Kind::Leapfrog {
            break;
        }
        start = driver.reached();
        driver.state_at(start, &mut state);
    }
    let step = driver.choice().unwrap().leapfrog_step;
    let mut plain = Driver::new(Box::new(Leapfrog::new(&system)), limits(step));
    plain.start(start, &state);
    let mut states = [[0.0; 2]; 2];
    for (driver, state) in [&mut driver, &mut plain].into_iter().zip(&mut states) {
        driver.advance(&mut system, start + 300.0).unwrap();
        driver.state_at(start + 300.0, state);
    }
    assert_eq!(states[0], states[1]);
    let choice = driver.choice().unwrap();
    assert!(choice.highest_frequency > 0.99 && choice.method == Kind::Leapfrog, "{choice:?}");
}

#[test]
fn the_choice_gives_way_when_attempts_fail() {
    let mut system = Stiffening { squares: [(0.0, 1.0); 3], fails_from: 31.0, failures: 3 };
    let mut driver = auto(&system, true);
    driver.advance(&mut system, 31.5).unwrap();
    let choice = driver.choice().unwrap();
    assert_eq!((choice.method, choice.reason), (Kind::Rosenbrock, Reason::Failures), "{choice:?}");
    assert!(driver.statistics().faults >= 3);
}

#[test]
fn error_control_of_the_choice_keeps_the_tolerance_and_takes_the_faster_method() {
    let mut system = Stiffening { squares: [(0.0, 1.0); 3], fails_from: f64::INFINITY, failures: 0 };
    let mut driver = auto(&system, false);
    let mut out = [0.0; 2];
    driver.advance(&mut system, 200.0).unwrap();
    driver.state_at(200.0, &mut out);
    // 1e-8 of 100 for each of some thousand steps.
    assert!((out[0] - 200f64.cos()).abs() < 1e-3, "{out:?}");
    let choice = driver.choice().unwrap();
    let [leapfrog, explicit, implicit, _] = choice.steps;
    assert!(leapfrog == 0 && implicit > 0 && explicit > 5 * implicit, "{choice:?}");
    assert!(choice.lead > 1.2 || choice.reason == Reason::Trial, "{choice:?}");
}
