//! Continuity of the forces of a whole bearing along paths through the onset and the limits of contacts.

use crate::common::bench::{Bearing, State, scenes};
use crate::common::{example_with, with};
use cagedyn::model::FORCE_SOURCES;
use serde_json::{Value, json};
use std::f64::consts::{PI, TAU};

/// A jump of a force along a path.
#[derive(Debug)]
struct Jump {
    /// Body and source.
    _place: (String, &'static str),
    /// Component: y, z, moment.
    _component: usize,
    _at: f64,
    /// Size in units of the component's largest value on the path.
    share: f64,
}

/// The largest jump of any force along a path x = 0..1. For every component the steepest interval of a grid is halved
/// until nothing is left of it: the change vanishes for every power law, but not for a jump.
fn largest_jump(b: &mut Bearing, path: impl Fn(f64) -> State) -> Jump {
    const INTERVALS: usize = 1000;
    let names = b.sim.model().body_names();
    let sources = FORCE_SOURCES.len();
    let mut at = |x: f64| -> Vec<f64> { b.forces(&path(x)).bodies.as_flattened().as_flattened().to_vec() };
    let grid: Vec<Vec<f64>> = (0..=INTERVALS).map(|i| at(i as f64 / INTERVALS as f64)).collect();
    let largest = |k: usize| grid.iter().fold(0.0f64, |m, v| m.max(v[k].abs()));
    let overall: [f64; 3] =
        std::array::from_fn(|c| (c..grid[0].len()).step_by(3).map(largest).fold(0.0, f64::max));
    let mut worst = Jump { _place: (String::new(), ""), _component: 0, _at: 0.0, share: 0.0 };
    for k in 0..grid[0].len() {
        // Components that are small beside the others hold round-off only.
        let scale = largest(k).max(1e-6 * overall[k % 3]);
        let change = |i: usize| (grid[i + 1][k] - grid[i][k]).abs();
        let steepest = (0..INTERVALS).max_by(|&i, &j| change(i).total_cmp(&change(j))).unwrap();
        let ends = [steepest, steepest + 1].map(|i| i as f64 / INTERVALS as f64);
        let mut low = (ends[0], grid[steepest][k]);
        let mut high = (ends[1], grid[steepest + 1][k]);
        loop {
            let x = 0.5 * (low.0 + high.0);
            if x <= low.0 || x >= high.0 || (high.1 - low.1).abs() <= 1e-6 * scale {
                break;
            }
            let middle = (x, at(x)[k]);
            if (middle.1 - low.1).abs() > (high.1 - middle.1).abs() { high = middle } else { low = middle }
        }
        let share = (high.1 - low.1).abs() / scale;
        if share > worst.share {
            let place = (names[k / (3 * sources)].clone(), FORCE_SOURCES[k / 3 % sources]);
            worst = Jump { _place: place, _component: k % 3, _at: low.0, share };
        }
    }
    worst
}

const CONTINUOUS: f64 = 1e-3;

fn assert_continuous(what: &str, b: &mut Bearing, path: impl Fn(f64) -> State) {
    let jump = largest_jump(b, path);
    assert!(jump.share < CONTINUOUS, "{what}: {jump:?}");
}

/// The example at rest relative to kinematic motion with the given roller moving.
fn moving_roller(b: &Bearing) -> State {
    let mut s = State::kinematic(b);
    s.rollers[0].radial_speed = 0.01;
    s.rollers[0].spin *= 0.9;
    s.cage_velocity[0] = 0.02;
    s
}

#[test]
fn forces_start_continuously_at_the_raceways() {
    for (name, scene) in scenes() {
        let mut b = Bearing::new(with(&scene, &[("inner_ring.radial_clearance", json!(20e-6))]));
        let base = moving_roller(&b);
        let gap = b.gap;
        for speed in [0.01, -0.002] {
            let at = |offset: f64| {
                let mut s = base.clone();
                s.rollers[0].offset = offset;
                s.rollers[0].radial_speed = speed;
                s
            };
            assert_continuous(&format!("{name}: outer raceway"), &mut b, |x| at(gap + 1e-7 * (x - 0.3)));
            assert_continuous(&format!("{name}: inner raceway"), &mut b, |x| at(-gap - 1e-7 * (x - 0.3)));
            assert_continuous(&format!("{name}: deep"), &mut b, |x| at(gap + 4e-6 * x));
        }
    }
}

#[test]
fn forces_are_continuous_over_slip_and_rolling_speed() {
    for (name, scene) in scenes() {
        let mut b = Bearing::new(scene);
        let mut base = moving_roller(&b);
        base.rollers[0].offset = b.gap + 1e-6;
        let spin = State::kinematic(&b).rollers[0].spin;
        let spinning = |factor: f64| {
            let mut s = base.clone();
            s.rollers[0].spin = spin * factor;
            s
        };
        assert_continuous(&format!("{name}: through zero slip"), &mut b, |x| spinning(0.9 + 0.2 * x));
        // The surfaces move against each other: the mean speed goes through zero at about -1.
        assert_continuous(&format!("{name}: through zero rolling"), &mut b, |x| spinning(-2.0 + 3.0 * x));
    }
}

/// The cage and roller 0 such that this roller is at (radial, circumferential) in its pocket; the roller stays on the
/// pitch circle and at its angle, the cage moves.
fn in_pocket(b: &Bearing, base: &State, radial: f64, circumferential: f64) -> State {
    let mut s = base.clone();
    let (sin, cos) = b.first_angle.sin_cos();
    let lead = (circumferential / b.pitch).asin();
    let inwards = -radial - b.pitch * (1.0 - lead.cos());
    (s.cage[0], s.cage[1]) = (inwards * cos, inwards * sin);
    for j in 0..b.count() {
        s.put_in_pocket(b, j, 0.0);
    }
    s.put_in_pocket(b, 0, circumferential);
    s
}

#[test]
fn forces_start_continuously_in_the_pocket() {
    for (name, scene) in scenes() {
        let mut b =
            Bearing::new(with(&scene, &[("cage.pocket.lubricated_cylinder.edge_blend", json!(0.02))]));
        let base = moving_roller(&b);
        let [clearance, half_angle] = b.pocket;
        for pillar in [1.0, -1.0] {
            for phi in
                [0.0, 0.5 * half_angle, -0.5 * half_angle, half_angle, 1.1 * half_angle, -1.1 * half_angle]
            {
                // Along the line of the angle phi, from 0.2 um before the contact to 0.6 um behind it.
                let touch = {
                    let (mut low, mut high) = (0.5 * clearance, 4.0 * clearance);
                    for _ in 0..80 {
                        let middle = 0.5 * (low + high);
                        let apart = b.pocket_approach(middle * phi.sin(), middle * phi.cos()) <= 0.0;
                        if apart { low = middle } else { high = middle }
                    }
                    low
                };
                let shape = Bearing::new(b.scene.clone());
                assert_continuous(&format!("{name}: pillar {pillar}, angle {phi}"), &mut b, |x| {
                    let d = touch + 8e-7 * (x - 0.25);
                    in_pocket(&shape, &base, d * phi.sin(), pillar * d * phi.cos())
                });
            }
        }
    }
}

/// A roller in contact with a pillar that moves over the ends of the wall.
fn across_the_wall(b: &Bearing, pillar: f64) -> impl Fn(f64) -> State + use<> {
    let shape = Bearing::new(b.scene.clone());
    let base = moving_roller(b);
    let [clearance, half_angle] = b.pocket;
    move |x| {
        let phi = half_angle * (-1.02 + 2.04 * x);
        let d = clearance + 2e-6;
        in_pocket(&shape, &base, d * phi.sin(), pillar * d * phi.cos())
    }
}

#[test]
fn forces_are_continuous_across_the_edges_of_the_pocket() {
    for (name, scene) in scenes() {
        let mut b =
            Bearing::new(with(&scene, &[("cage.pocket.lubricated_cylinder.edge_blend", json!(0.02))]));
        for pillar in [1.0, -1.0] {
            let path = across_the_wall(&b, pillar);
            assert_continuous(&format!("{name}: pillar {pillar}"), &mut b, path);
        }
    }
}

#[test]
fn without_blend_the_friction_jumps_at_the_edges_of_the_pocket() {
    let mut b = Bearing::new(example_with(&[("cage.pocket.lubricated_cylinder.edge_blend", json!(0.0))]));
    for pillar in [1.0, -1.0] {
        let path = across_the_wall(&b, pillar);
        let jump = largest_jump(&mut b, path);
        assert!(jump.share > 50.0 * CONTINUOUS, "pillar {pillar}: {jump:?}");
    }
}

#[test]
fn forces_are_continuous_between_one_edge_and_both() {
    let mut b = Bearing::new(scenes().swap_remove(1).1);
    let base = moving_roller(&b);
    let [clearance, half_angle] = b.pocket;
    let shape = Bearing::new(b.scene.clone());
    let resting = clearance / half_angle.sin();
    for side in [1.0, -1.0] {
        // Radially on to both edges, and from one pillar to the other while on both.
        assert_continuous("on to both edges", &mut b, |x| {
            in_pocket(&shape, &base, side * (resting + 4e-7 * (x - 0.4)), 1e-7)
        });
        assert_continuous("from edge to edge", &mut b, |x| {
            in_pocket(&shape, &base, side * (resting + 1e-6), 2e-6 * (x - 0.5))
        });
    }
}

#[test]
fn guide_forces_are_continuous_through_the_centre_and_to_the_wall() {
    for (name, scene) in scenes() {
        let mut b = Bearing::new(with(&scene, &[("cage.pocket", Value::Null)]));
        let base = moving_roller(&b);
        let clearance = b.guide;
        let at = |eccentricity: f64, angle: f64| {
            let mut s = base.clone();
            (s.cage[0], s.cage[1]) =
                (eccentricity * clearance * angle.cos(), eccentricity * clearance * angle.sin());
            s
        };
        assert_continuous(&format!("{name}: along y"), &mut b, |x| at(x - 0.4, 0.0));
        assert_continuous(&format!("{name}: along z"), &mut b, |x| at(x - 0.6, PI / 2.0));
        assert_continuous(&format!("{name}: centre"), &mut b, |x| at(1e-6 * (x - 0.5), 0.7));
        assert_continuous(&format!("{name}: around"), &mut b, |x| at(0.9, TAU * x));
        assert_continuous(&format!("{name}: outwards"), &mut b, |x| at(0.9 + 0.05 * x, 2.0));
    }
}
