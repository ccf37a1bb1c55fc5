//! Closed forms of a ring that bends.

use super::ring_modes::RingModes;
use crate::scene::{ElasticRing, RingStiffness};
use std::f64::consts::{FRAC_PI_2, PI};

const RADIUS: f64 = 45.081e-3;
const MASS: f64 = 12.34e-3;
const INERTIA: f64 = 2.511e-5;
const BENDING: f64 = 0.2572;

fn ring(modes: u32) -> RingModes {
    let ring = ElasticRing {
        modes,
        neutral_radius: RADIUS,
        stiffness: RingStiffness::Bending(BENDING),
        damping: 0.0,
        growth: 0.0,
        contact_depth: 1e-6,
    };
    let pockets: Vec<f64> = (0..40).map(|j| 2.0 * PI * f64::from(j) / 40.0).collect();
    RingModes::new(&ring, MASS, RADIUS, &pockets)
}

/// Accelerations of the modes, and the angular acceleration.
fn accelerate(ring: &RingModes, speed: f64, on: &[f64], state: [&[f64]; 2]) -> (Vec<f64>, f64) {
    let mut out = vec![0.0; on.len()];
    let turning = ring.accelerate([0.0, INERTIA, speed], on, state, &mut out);
    (out, turning)
}

#[test]
fn frequencies_are_those_of_hoppe_and_of_bryan() {
    let ring = ring(8);
    let count = 2 * ring.orders().count();
    let line = MASS / (2.0 * PI * RADIUS);
    for speed in [0.0, 142.5, 800.0] {
        for (k, order) in ring.orders().enumerate() {
            let n = f64::from(order);
            let bent = n * (n * n - 1.0);
            let hoppe = (BENDING / (line * RADIUS.powi(4)) * bent * bent / (n * n + 1.0)).sqrt();
            let carried = bent * speed / (n * n + 1.0);
            for sign in [1.0, -1.0] {
                let lambda =
                    -2.0 * n / (n * n + 1.0) * speed + sign * (hoppe * hoppe + carried * carried).sqrt();
                // A + iB = a e^(i lambda t), so small that nothing else moves.
                let (mut q, mut v) = (vec![0.0; count], vec![0.0; count]);
                (q[2 * k], v[2 * k + 1]) = (1e-12, 1e-12 * lambda);
                let (a, _) = accelerate(&ring, speed, &vec![0.0; count], [&q, &v]);
                let expected = -lambda * lambda * 1e-12;
                assert!(
                    (a[2 * k] / expected - 1.0).abs() < 1e-12,
                    "{order} {speed}: {} {expected}",
                    a[2 * k]
                );
                assert!(a[2 * k + 1].abs() < 1e-12 * expected.abs());
            }
        }
    }
}

/// Static displacement under radial loads at the angles 0 and, if there are two, pi; inwards, at the first.
fn displacement(modes: u32, both: bool) -> f64 {
    let (ring, load) = (ring(modes), 3.0);
    let count = 2 * ring.orders().count();
    // The stiffness is what a coordinate of one pushes back with.
    let waves = ring.orders().enumerate().map(|(k, order)| {
        let mut q = vec![0.0; count];
        q[2 * k] = 1e-9;
        let (a, _) = accelerate(&ring, 0.0, &vec![0.0; count], [&q, &vec![0.0; count]]);
        let mut on = vec![0.0; count];
        on[2 * k] = -a[2 * k];
        // How much force stops it there: the mass is what a force of one accelerates.
        let (per_force, _) = accelerate(
            &ring,
            0.0,
            &{
                let mut on = vec![0.0; count];
                on[2 * k] = 1.0;
                on
            },
            [&vec![0.0; count], &vec![0.0; count]],
        );
        let stiffness = -a[2 * k] / per_force[2 * k] / 1e-9;
        let force = if !both {
            load
        } else if order % 2 == 0 {
            2.0 * load
        } else {
            0.0
        };
        force / stiffness
    });
    waves.sum::<f64>() / load
}

#[test]
fn loads_bend_it_as_closed_forms_say() {
    let unit = RADIUS.powi(3) / BENDING;
    // Two opposite loads: the diameter.
    let exact = (PI / 4.0 - 2.0 / PI) * unit;
    for (modes, share) in [(2, 0.95088), (4, 0.98892), (6, 0.99591)] {
        let found = 2.0 * displacement(modes, true) / exact;
        assert!((found - share).abs() < 1e-5, "{modes}: {found}");
    }
    // One load against the inertia of the ring: at the load.
    let exact = (PI * PI / 12.0 - 11.0 / 16.0) / PI * unit;
    for (modes, share) in [(2, 0.8232), (3, 0.9390), (4, 0.9719), (6, 0.9909)] {
        let found = displacement(modes, false) / exact;
        assert!((found - share).abs() < 1e-4, "{modes}: {found}");
    }
}

#[test]
fn what_displaces_pockets_is_the_wave() {
    let ring = ring(3);
    // Pocket 10 of 40 is a quarter of the way round; at the neutral line the tangential factor is -1/n.
    let basis = ring.displacements(10);
    for (k, order) in [(0, 2.0), (1, 3.0)] {
        let (sin, cos) = (order * FRAC_PI_2).sin_cos();
        let expected = [[cos, -sin / order], [sin, cos / order]];
        for (found, expected) in basis[2 * k..2 * k + 2].iter().zip(expected) {
            assert!((found[0] - expected[0]).abs() + (found[1] - expected[1]).abs() < 1e-14);
        }
    }
}

#[test]
fn energy_and_angular_momentum_stay_at_their_exact_rates() {
    // At any state: d/dt of both, by differences along the motion.
    let ring = ring(5);
    let n = 2 * ring.orders().count();
    let mut rng = fastrand::Rng::with_seed(4);
    for _ in 0..50 {
        let q: Vec<f64> = (0..n).map(|_| 2e-3 * (rng.f64() - 0.5)).collect();
        let v: Vec<f64> = (0..n).map(|_| 4.0 * (rng.f64() - 0.5)).collect();
        let speed = 1600.0 * (rng.f64() - 0.5);
        let (a, turning) = accelerate(&ring, speed, &vec![0.0; n], [&q, &v]);
        let dt = 1e-8;
        let at = |s: f64| {
            let moved = |x: &[f64], rate: &[f64]| -> Vec<f64> {
                x.iter().zip(rate).map(|(x, rate)| x + s * rate).collect()
            };
            let (q, v, speed) = (moved(&q, &v), moved(&v, &a), speed + s * turning);
            let [bending, elastic] = ring.energy(speed, [&q, &v]);
            [
                bending + elastic + 0.5 * INERTIA * speed * speed,
                ring.angular_momentum([INERTIA, speed], [&q, &v]),
            ]
        };
        let ([e_low, h_low], [e_high, h_high]) = (at(-dt), at(dt));
        let [energy, momentum] = at(0.0);
        assert!(((e_high - e_low) / (2.0 * dt)).abs() < 1e-3 * energy, "{e_low} {e_high}");
        assert!(((h_high - h_low) / (2.0 * dt)).abs() < 1e-3 * momentum.abs() + 1e-8, "{h_low} {h_high}");
        // The moment that turns it like this is none.
        let moment = ring.moment_for([turning, INERTIA, speed], [&q, &v], |k| a[k]);
        assert!(moment.abs() < 1e-12 * (INERTIA * turning).abs().max(1e-6), "{moment}");
    }
}

#[test]
fn a_ring_that_has_collapsed_has_no_motion() {
    let ring = ring(2);
    // So much bending that nothing is left of the moment of inertia.
    let (a, turning) = accelerate(&ring, 1.0, &[0.0; 2], [&[60e-3, 0.0], &[0.0; 2]]);
    assert!(turning.is_nan() && a.iter().any(|a| a.is_nan()));
}
