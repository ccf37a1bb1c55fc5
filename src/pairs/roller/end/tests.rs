//! Tests of ends on ribs.

use super::*;
use crate::bodies::{RollerPlace, RollerState};
use crate::scalar::Dual;
use crate::scene::RollerTaper;
use crate::space::solid::{Tilt, Vector};

const PITCH: f64 = 39.99e-3;
const END: EndShape = EndShape { cap_radius: 0.6, face_radius: 6.7e-3, length: 22e-3 };

/// One of cylindrical and one of tapered rollers.
fn bearings() -> [RacewayGeometry; 2] {
    let taper = RollerTaper { half_angle: 0.07, outer_raceway_angle: 0.3 };
    [Cones::NONE, Cones::new(Some(&taper))].map(|cones| RacewayGeometry {
        pitch_radius: PITCH,
        roller_radius: 7.5e-3,
        gap: 0.0,
        cones,
    })
}

/// Ribs of a bearing; ends are nearly as round as the ribs of a tapered one.
fn rib(bearing: &RacewayGeometry, ring: usize, side: f64) -> RibGeometry {
    let (end, [angle, height]) = match bearing.cones == Cones::NONE {
        true => (END, [0.01, 2.5e-3]),
        false => (EndShape { cap_radius: 0.15, ..END }, [0.0325, 3.5e-3]),
    };
    RibGeometry::rib(bearing, end, (ring, side), [angle, height, 50e-6]).unwrap()
}

fn ribs() -> impl Iterator<Item = (RacewayGeometry, RibGeometry, (usize, f64))> {
    let places = [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)];
    let of = move |bearing: RacewayGeometry| {
        places.map(|(ring, side)| (bearing, rib(&bearing, ring, side), (ring, side)))
    };
    bearings().into_iter().flat_map(of)
}

/// Coordinates: x, rho, skew and tilt of the roller; x, r, psi and two angles of the ring.
fn touch<T: Real>(
    (bearing, rib): (&RacewayGeometry, &RibGeometry),
    q: [T; 9],
    rates: Option<[Vector<T>; 4]>,
) -> EndTouch<T> {
    let axis = bearing.cones.inclination.turned(Tilt::new([q[2], q[3]]).axis);
    let place = RollerPlace { x: q[0], rho: q[1], axis };
    let still = [[T::constant(0.0); 3]; 4];
    let [velocity, turning, of_ring, ring_turning] = rates.unwrap_or(still);
    let roller = MovingRoller { place, moving: Moving { velocity, turning } };
    let ring = MovingRing {
        centre: [q[4], q[5], q[6]],
        axis: Tilt::new([q[7], q[8]]).axis,
        moving: Moving { velocity: of_ring, turning: ring_turning },
        speed: T::constant(0.0),
    };
    rib.touch(&roller, &ring, 0.0)
}

/// States with an end on each region, by one side or the other.
const STATES: [[f64; 9]; 4] = [
    [2e-5, 5e-6, 1e-4, -2e-4, 1e-5, -2e-5, 1e-5, 1e-4, -2e-4],
    [2e-5, 5e-6, 4e-3, 8e-3, 1e-5, -2e-5, 1e-5, 0.0, 0.0],
    [2e-5, 5e-6, 2e-3, -9e-3, 1e-5, -2e-5, 1e-5, 1e-3, 0.0],
    [2e-5, 5e-6, 12e-3, -3e-3, 1e-5, -2e-5, 1e-5, 0.0, 2e-3],
];

#[test]
fn forces_are_the_gradient_of_the_approach() {
    let mut seen = Vec::new();
    for (bearing, rib, (ring, side)) in ribs() {
        for q in STATES {
            for sign in [[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]] {
                let mut q = q;
                (q[2], q[3]) = (q[2] * sign[0], q[3] * sign[1]);
                let of = (&bearing, &rib);
                let found = touch(of, q, None);
                seen.push((bearing.cones == Cones::NONE, found.region));
                let sloped = touch(of, std::array::from_fn(|k| Dual::<9>::variable(q[k], k)), None);
                let [force, moment] = found.spot.normal;
                let state =
                    RollerState::new((0.0, bearing.cones.inclination), [0.0; 2], [q[2], q[3]], [0.0; 6]);
                let of_ring = Tilt::new([q[7], q[8]]);
                let [.., skew, tilt, _] = state.over_speeds([[0.0; 3], moment], 0.0);
                let over_angles = [skew, tilt];
                let from_ring = [q[0] - q[4], PITCH + q[1] - q[5], -q[6]];
                let on_ring = scaled(sum(moment, cross(from_ring, force)), -1.0);
                let ring_angles = of_ring.moments_over_angles(on_ring);
                let expected = [
                    force[0],
                    force[1],
                    over_angles[0],
                    over_angles[1],
                    -force[0],
                    -force[1],
                    -force[2],
                    ring_angles[0],
                    ring_angles[1],
                ];
                for (k, expected) in expected.into_iter().enumerate() {
                    let slope = -sloped.spot.delta.eps[k];
                    assert!(
                        (slope - expected).abs() < 1e-12,
                        "{ring} {side} {:?} {k}: {slope} {expected}",
                        found.region
                    );
                }
                // Nothing turns a body about its own axis.
                assert!(dot(moment, state.axis).abs() < 1e-15, "{:?}", found.region);
                assert!(dot(on_ring, of_ring.axis).abs() < 1e-15);
            }
        }
    }
    for region in [Region::Cap, Region::Rim, Region::Edge, Region::Corner] {
        assert!(seen.contains(&(true, region)) && seen.contains(&(false, region)), "{region:?}");
    }
}

#[test]
fn in_the_middle_it_has_half_of_the_play() {
    for (bearing, rib, _) in ribs() {
        let found = touch((&bearing, &rib), [0.0; 9], None);
        let allowed = if bearing.cones == Cones::NONE { 1e-17 } else { 3e-17 };
        assert!((found.spot.delta + rib.gap).abs() < allowed && found.region == Region::Cap, "{found:?}");
    }
}

#[test]
fn the_end_play_is_that_of_any_cap() {
    // Flat, between, and so round that the edge of the rib touches.
    for cap_radius in [50.0, 2.0, 0.6, 0.1] {
        for angle in [0.0, 1e-3, 0.025] {
            for (ring, side) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)] {
                let end = EndShape { cap_radius, ..END };
                let [bearing, _] = bearings();
                let rib = RibGeometry::rib(&bearing, end, (ring, side), [angle, 2.5e-3, 50e-6]).unwrap();
                let at = |x: f64| {
                    touch((&bearing, &rib), [side * x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], None)
                };
                let found = at(25e-6).spot.delta;
                assert!(found.abs() < 1e-16, "{cap_radius} {angle} {ring} {side}: {found:e}");
                let radius = 1.0 / rib.curvatures(&bearing.cones)[0];
                assert!(radius > 0.7 * cap_radius && radius < 1.4 * cap_radius);
            }
        }
    }
}

#[test]
fn the_approach_is_that_of_the_deepest_point() {
    // The face by brute force against the plane that touches the cone in the meridian of the roller.
    for (bearing, rib, (ring, side)) in ribs() {
        for q in STATES {
            let found = touch((&bearing, &rib), q, None).spot.delta;
            let Inclination { sin, cos } = rib.angle;
            let (f, gamma) = (rib.outwards, bearing.cones.inclination);
            let tilt = Tilt::new([q[2], q[3]]);
            let b = Tilt::new([q[7], q[8]]).axis;
            let centre = [q[0], PITCH + q[1], 0.0];
            let o = [q[4], q[5], q[6]];
            let from_ring = difference(centre, o);
            let t = dot(from_ring, b);
            let radial = difference(from_ring, scaled(b, t));
            let d = dot(radial, radial).sqrt();
            let e_n = scaled(radial, 1.0 / d);
            let normal = sum(scaled(b, side * cos), scaled(e_n, f * sin));
            let u = gamma.turned(tilt.axis);
            let m1 = difference(e_n, scaled(u, dot(e_n, u)));
            let m1 = scaled(m1, 1.0 / dot(m1, m1).sqrt());
            let w = cross(u, m1);
            // The plane touches the undisplaced cap with the gap g_f.
            let y_n = rib.middle();
            let radii = [rib.end.cap_radius, rib.across_radius];
            let at_rest = f * sin * PITCH
                + rib.opening.sin * y_n
                + rib.opening.cos * (11e-3 - y_n * y_n / (2.0 * radii[0]))
                + rib.gap;
            let mut deepest = f64::NEG_INFINITY;
            let n = 2000;
            for i in 0..=n {
                for k in 0..=40 {
                    let (angle, size) = (
                        std::f64::consts::TAU * f64::from(i) / f64::from(n),
                        rib.end.face_radius * f64::from(k) / 40.0,
                    );
                    let (y1, y2) = (size * angle.cos(), size * angle.sin());
                    if f * y1 < rib.lowest {
                        continue;
                    }
                    let arm = sum(
                        scaled(u, side * (11e-3 - 0.5 * (y1 * y1 / radii[0] + y2 * y2 / radii[1]))),
                        sum(scaled(m1, y1), scaled(w, y2)),
                    );
                    deepest = deepest.max(dot(normal, sum(from_ring, arm)) - at_rest);
                }
            }
            assert!(
                found - deepest > -1e-12 && found - deepest < 1e-6,
                "{ring} {side} {q:?}: {found} {deepest}"
            );
        }
    }
}

#[test]
fn the_approach_speed_is_the_rate_of_the_approach() {
    for (bearing, rib, q) in ribs().flat_map(|(bearing, rib, _)| STATES.map(|q| (bearing, rib, q))) {
        let of = (&bearing, &rib);
        let gamma = bearing.cones.inclination;
        let dq = [0.3, -0.02, 4.0, -3.0, 0.1, 0.2, -0.1, 2.0, 5.0];
        let tilt = Tilt::new([q[2], q[3]]);
        let ring = Tilt::new([q[7], q[8]]);
        let spin = scaled(gamma.turned(tilt.axis), 800.0);
        let of_ring = scaled(ring.axis, -314.0);
        let rates = [
            [dq[0], dq[1], 0.0],
            sum(gamma.turned(tilt.angular_velocity([dq[2], dq[3]])), spin),
            [dq[4], dq[5], dq[6]],
            sum(ring.angular_velocity([dq[7], dq[8]]), of_ring),
        ];
        let found = touch(of, q, Some(rates));
        let h = 1e-7;
        let at = |h: f64| touch(of, std::array::from_fn(|k| q[k] + h * dq[k]), None).spot.delta;
        let rate = (at(h) - at(-h)) / (2.0 * h);
        assert!((found.spot.delta_dot - rate).abs() < 1e-8, "{:?}: {found:?} {rate}", found.region);
        // Speeds differ by the slip.
        let [u1, u2] = found.spot.surface_speeds;
        let slip = found.spot.slip[0].hypot(found.spot.slip[1]);
        assert!(slip <= u1 + u2 + 1e-12 && slip >= (u1 - u2).abs() - 1e-12);
    }
}
