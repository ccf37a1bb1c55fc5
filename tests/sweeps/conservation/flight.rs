//! A cage that touches nothing flies along a parabola.

use super::scenes::{controlled, flying, leapfrog, simulate};
use cagedyn::Sim;
use serde_json::{Value, json};

const GRAVITY: f64 = 9.80665;
const DURATION: f64 = 50e-3;

fn methods() -> Vec<(&'static str, Value)> {
    let mut list = controlled(1e-6).to_vec();
    list.push(("leapfrog", leapfrog(2e-5)));
    list.push(("auto, free choice", json!({"method": {"auto": {}}})));
    list
}

/// Place and velocity of the centre of mass.
fn centre_of_mass(sim: &Sim, state: &[f64]) -> [f64; 4] {
    let unbalance = sim.model().scene().cage.as_ref().and_then(|cage| cage.mass_eccentricity);
    let [y, z, angle, vy, vz, speed] = state[..6] else { panic!("a cage alone") };
    let (sin, cos) = angle.sin_cos();
    let (uy, uz) = unbalance.map_or((0.0, 0.0), |u| (u.y * cos - u.z * sin, u.y * sin + u.z * cos));
    [y + uy, z + uz, vy - speed * uz, vz + speed * uy]
}

/// Positions and velocities on the parabola through the start.
fn parabola(start: &[f64], t: f64) -> [f64; 4] {
    let [y, z, vy, vz] = [start[0], start[1], start[3], start[4]];
    [y + vy * t, z + vz * t - 0.5 * GRAVITY * t * t, vy, vz - GRAVITY * t]
}

/// Largest departures in any of many looks.
fn departure(sim: &mut Sim, looks: u32, exact: impl Fn(f64) -> [f64; 4]) -> [f64; 4] {
    let mut worst = [0.0f64; 4];
    for i in 1..=looks {
        let t = DURATION * f64::from(i) / f64::from(looks);
        sim.advance_to(t).expect("a flight");
        let (state, exact) = (sim.state(), exact(t));
        for (worst, (found, exact)) in worst.iter_mut().zip(centre_of_mass(sim, state).into_iter().zip(exact))
        {
            *worst = worst.max((found - exact).abs());
        }
    }
    worst
}

/// Every step rounds each number once, by half an ulp at most. An error of speed is carried on to the end.
#[test]
fn free_flight_is_a_parabola_to_round_off() {
    const HIGHEST: f64 = 1.7e-3;
    const FASTEST: f64 = 0.25;
    for (method, solver) in methods() {
        for looks in [1, 7, 1000] {
            let mut sim = simulate(&flying(&[]), &solver);
            let start = sim.state().to_vec();
            let found = departure(&mut sim, looks, |t| parabola(&start, t));
            let steps = sim.statistics().driver.steps as f64;
            let half_ulps = 0.5 * f64::EPSILON * (steps + 1.0);
            let (speed, place) = (half_ulps * FASTEST, half_ulps * (HIGHEST + FASTEST * DURATION));
            println!(
                "{method}, {looks} looks, {steps} steps: {found:?}, {place:.1e} and {speed:.1e} allowed"
            );
            assert!(found[0].max(found[1]) < place, "{method}: {found:?}");
            assert!(found[2].max(found[3]) < speed, "{method}: {found:?}");
            assert_eq!(sim.state()[5], start[5], "{method}: the cage spins up");
        }
    }
}

#[test]
fn nothing_changes_the_momentum_of_a_cage_without_weight() {
    for (method, solver) in methods() {
        let mut sim = simulate(&flying(&[("gravity", Value::Null)]), &solver);
        let start = sim.state()[3..].to_vec();
        // It would reach the guide later.
        for t in [1.3e-3, 9e-3] {
            sim.advance_to(t).expect("a flight");
            let kept =
                sim.state()[3..].iter().zip(&start).all(|(a, b)| (a - b).abs() <= f64::EPSILON * b.abs());
            assert!(kept, "{method}: {:?}, {start:?}", &sim.state()[3..]);
        }
    }
}

/// The centre of mass flies along the parabola, and the geometric centre turns about it. A method of order p makes the
/// speed of the turning part, u w, wrong by a share (w h)^p; the leapfrog, which takes the acceleration in the middle of
/// its steps, by (w h)^2/24 to either side.
#[test]
fn the_centre_of_mass_of_an_unbalanced_cage_flies_along_the_parabola() {
    const ARM: f64 = 50e-6;
    const SPEED: f64 = 1000.0;
    let unbalance = json!({"y": 30e-6, "z": -40e-6});
    // The speed of the centre of mass is that of the balanced cage.
    let velocity = json!({"y": -0.02, "z": 0.22});
    let scene = flying(&[
        ("cage.mass_eccentricity", unbalance),
        ("initial.cage_speed", json!(SPEED)),
        ("initial.cage_velocity", velocity),
    ]);
    let fly = |solver: &Value| {
        let mut sim = simulate(&scene, solver);
        let start = sim.state().to_vec();
        let [y, z, vy, vz] = centre_of_mass(&sim, &start);
        let found = departure(&mut sim, 100, |t| parabola(&[y, z, 0.0, vy, vz], t));
        (found[0].max(found[1]), sim.statistics().driver.largest_step)
    };
    for (method, solver) in controlled(1e-6) {
        let order = if method == "dormand_prince" { 5 } else { 4 };
        let (found, step) = fly(&solver);
        let allowed = ARM * SPEED * (SPEED * step).powi(order) * DURATION;
        println!("{method}, {step:.1e} s: {found:.1e} m off the parabola, {allowed:.1e} m allowed");
        assert!(found < allowed, "{method}: {found:e} m");
    }
    let errors = [2e-5, 1e-5, 5e-6].map(|step| {
        let found = fly(&leapfrog(step)).0;
        let allowed = 2.0 * ARM * SPEED * (SPEED * step).powi(2) / 24.0 * DURATION;
        println!("leapfrog, {step:.1e} s: {found:.1e} m off the parabola, {allowed:.1e} m allowed");
        assert!(found < allowed, "leapfrog: {found:e} m");
        found
    });
    for pair in errors.windows(2) {
        assert!(((pair[0] / pair[1]).log2() - 2.0).abs() < 0.05, "{errors:?}");
    }
}
