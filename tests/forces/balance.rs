//! The forces of a whole bearing at any state: balance between bodies, and equations of motion.

use crate::common::bench::{Bearing, State, at_random_states};
use crate::common::reports::{
    APPROACH, CAGE, FILM, FILM_RATIO, GUIDE, INNER, INNER_RING, NORMAL, OUTER, POCKET, largest_force, sum,
};
use cagedyn::model::{BodyForces, ContactForces, FORCE_SOURCES};
use serde_json::Value;

#[test]
fn sources_have_the_expected_names() {
    let names = [
        "outer_raceway",
        "inner_raceway",
        "pocket",
        "guide",
        "gravity",
        "load",
        "support",
        "neighbour",
        "drag",
        "rib",
        "unbalance",
        "shaft",
    ];
    assert_eq!(FORCE_SOURCES, names);
}

/// Centres of the bodies in the order of force reports.
fn centres(b: &Bearing, s: &State) -> Vec<[f64; 2]> {
    let mut list = vec![[0.0; 2], s.ring, [s.cage[0], s.cage[1]]];
    list.extend(s.rollers.iter().enumerate().map(|(j, r)| {
        let (radius, angle) = (b.pitch + r.offset, b.reference(j) + r.travel);
        [radius * angle.cos(), radius * angle.sin()]
    }));
    list
}

#[test]
fn random_states_reach_every_regime() {
    let mut seen = std::collections::BTreeMap::new();
    at_random_states(1, |_, b, state| {
        let forces = b.forces(state);
        let eccentricity = state.cage[0].hypot(state.cage[1]) / b.guide;
        let mut see = |regime: &'static str, yes: bool| *seen.entry(regime).or_insert(0) += usize::from(yes);
        see("eccentricity of 0.9 and more", eccentricity > 0.9);
        see("eccentricity below 0.1", eccentricity < 0.1);
        for contact in forces.contacts.chunks_exact(4) {
            let [outer, inner, front, back] = contact else { unreachable!() };
            let touches = |c: &ContactForces| c[NORMAL] > 0.0;
            // Edges have no film.
            let wall = |c: &ContactForces| touches(c) && c[FILM] > 0.0;
            let edge = |c: &ContactForces| touches(c) && c[FILM] == 0.0;
            see("outer raceway apart", !touches(outer));
            see("inner raceway apart", !touches(inner));
            see("outer raceway deep", touches(outer) && outer[APPROACH] > 3e-6);
            see("inner raceway deep", touches(inner) && inner[APPROACH] > 3e-6);
            see("outer raceway light", touches(outer) && outer[APPROACH] < 3e-7);
            see("inner raceway light", touches(inner) && inner[APPROACH] < 3e-7);
            see("both raceways", touches(outer) && touches(inner));
            see("mixed or boundary lubrication", touches(outer) && outer[FILM_RATIO] < 1.0);
            see("front wall", wall(front));
            see("back wall", wall(back));
            see("front edge", edge(front));
            see("back edge", edge(back));
            see("both edges", edge(front) && edge(back));
            see("pocket free", !touches(front) && !touches(back));
        }
    });
    for (regime, times) in &seen {
        assert!(*times >= 10, "'{regime}' occurred {times} times only: {seen:?}");
    }
    assert_eq!(seen.len(), 16);
}

#[test]
fn forces_and_moments_between_bodies_balance() {
    at_random_states(1, |name, b, state| {
        let forces = b.forces(state);
        let largest = largest_force(&forces);
        let centres = centres(b, state);
        for source in [OUTER, INNER, POCKET, GUIDE] {
            let mut total = [0.0; 3];
            for (body, [y, z]) in forces.bodies.iter().zip(&centres) {
                let [fy, fz, moment] = body[source];
                total[0] += fy;
                total[1] += fz;
                total[2] += moment + y * fz - z * fy;
            }
            let (force, moment) = (total[0].hypot(total[1]), total[2].abs());
            let what = FORCE_SOURCES[source];
            assert!(force <= 1e-12 * largest, "{name}: forces of {what} leave {force:e} N of {largest} N");
            let limit = 1e-12 * largest * b.pitch;
            assert!(
                moment <= limit,
                "{name}: moments of {what} leave {moment:e} N m, more than {limit:e}: {state:?}"
            );
        }
    });
}

#[test]
fn accelerations_are_forces_over_inertia() {
    at_random_states(2, |name, b, state| {
        let forces = b.forces(state);
        let value = |path: &str| b.scene.pointer(path).and_then(Value::as_f64).unwrap();
        let (mass, inertia) = (value("/rollers/mass"), value("/rollers/inertia"));
        let n = b.count();
        let a = &forces.accelerations;
        let same = |what: String, reported: f64, expected: f64, scale: f64| {
            let error = (reported - expected).abs();
            assert!(
                error <= 1e-10 * scale,
                "{name}: {what}: {reported} reported, {expected} from the forces"
            );
        };
        // Round-off is measured by the largest contribution.
        let scale = |body: &BodyForces, k: usize| body.iter().map(|f| f[k].abs()).fold(1e-300, f64::max);
        for (k, rate) in a.iter().take(2).enumerate() {
            let ring = value("/inner_ring/motion/free/mass");
            let body = &forces.bodies[INNER_RING];
            same(format!("ring {k}"), *rate, sum(body)[k] / ring, scale(body, k) / ring);
        }
        for k in 0..3 {
            let cage = if k < 2 { value("/cage/mass") } else { value("/cage/inertia") };
            let body = &forces.bodies[CAGE];
            same(format!("cage {k}"), a[2 + k], sum(body)[k] / cage, scale(body, k) / cage);
        }
        for (j, roller) in state.rollers.iter().enumerate() {
            let body = &forces.bodies[CAGE + 1 + j];
            let r = b.pitch + roller.offset;
            let (sin, cos) = (b.reference(j) + roller.travel).sin_cos();
            let radial = a[5 + 2 * j] - r * roller.orbit_speed.powi(2);
            let around = r * a[6 + 2 * j] + 2.0 * roller.radial_speed * roller.orbit_speed;
            let centrifugal = r * roller.orbit_speed.powi(2);
            let size = scale(body, 0).max(scale(body, 1)) / mass + centrifugal;
            same(format!("roller {j} y"), radial * cos - around * sin, sum(body)[0] / mass, size);
            same(format!("roller {j} z"), radial * sin + around * cos, sum(body)[1] / mass, size);
            let spin = a[5 + 2 * n + j];
            same(format!("roller {j} spin"), spin, sum(body)[2] / inertia, scale(body, 2) / inertia);
        }
    });
}
