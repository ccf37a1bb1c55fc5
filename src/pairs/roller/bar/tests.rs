//! Tests of discs against the bars of a pocket.

use super::*;
use crate::bodies::RollerPlace;
use crate::bodies::{CageState, ElementMotion, RollerState};
use crate::pairs::pocket::cylinder::CylinderPocket;
use crate::pairs::pocket::kinematics::{Pillar, PillarContact, PocketPlace, PocketShape};
use crate::pairs::pocket::plane::PlanePocket;
use crate::scalar::{Dual, Numeric};
use crate::scene::RollerTaper;
use crate::space::Frame;
use crate::space::solid::Tilt;

const PITCH: f64 = 39.99e-3;
const RADIUS: f64 = 7.5e-3;
const CLEARANCE: f64 = 0.15e-3;
const ROUND: BarShape = BarShape::Cylinders { half_angle: 0.436, edge_blend: 0.02 };
const EXCESS: f64 = 0.3e-6;
const DROP: f64 = 0.7e-6;
/// Azimuth of the pocket at the start, rad.
const START: f64 = 0.9;
/// Spin of the roller, rad/s.
const SPIN: f64 = 800.0;

/// x, rho, travel, skew and tilt of the roller; x, y, z, angle and two tilts of the cage; displacement of the pocket outwards and ahead.
const COORDINATES: usize = 13;
type Coordinates<T> = [T; COORDINATES];

const RATES: Coordinates<f64> =
    [0.05, 0.02, 127.0, 3.0, -2.0, -0.03, 0.04, 0.02, 125.0, -4.0, 5.0, 0.01, -0.02];

fn bars(shape: BarShape, cones: Cones) -> Bars {
    Bars::new(PITCH, (RADIUS, cones), CLEARANCE, shape)
}

/// States with angles of 5 times `size` rad, of roller against cage twice that, and the middle of the roller all around in its pocket, within and beyond the clearance, m.
fn states(size: f64) -> impl Iterator<Item = Coordinates<f64>> {
    let around = (0..16).map(|i| math::sin_cos(0.1 + f64::from(i) * std::f64::consts::TAU / 16.0));
    around.flat_map(move |(sin, cos)| {
        [0.152e-3, 0.4e-3].map(|d| {
            let lead = d * cos / PITCH;
            let [a, b] = [3.1 * size, -4.1 * size];
            [2e-5, d * sin, 0.3 + lead, a, b, 1e-5, -2e-5, 1e-5, 0.3, -4.5 * size, 2.3 * size, 1e-6, -3e-6]
        })
    })
}

fn roller<T: Real>(bars: &Bars, q: Coordinates<T>, v: Coordinates<T>) -> MovingRoller<T> {
    let (tilt, inclination) = (Tilt::new([q[3], q[4]]), bars.cones.inclination);
    let axis = inclination.turned(tilt.axis);
    let turning =
        sum(inclination.turned(tilt.angular_velocity([v[3], v[4]])), scaled(axis, T::constant(SPIN)));
    let turning = sum(turning, [v[2], T::constant(0.0), T::constant(0.0)]);
    let place = RollerPlace { x: q[0], rho: q[1], axis };
    MovingRoller { place, moving: Moving { velocity: [v[0], v[1], (q[1] + PITCH) * v[2]], turning } }
}

fn cage<T: Real>(q: Coordinates<T>, v: Coordinates<T>) -> MovingCage<T> {
    let six = |x: Coordinates<T>| std::array::from_fn(|k| x[5 + k]);
    CageState { position: six(q), rate: six(v) }.motion()
}

fn place<T: Real>(bars: &Bars, q: Coordinates<T>, v: Coordinates<T>) -> InBars<T> {
    let (sin, cos) = (q[2] + START).sin_cos();
    let bent = Some([[q[11], q[12]], [v[11], v[12]]]);
    bars.place(&roller(bars, q, v), [cos, sin], q[2] - q[8], &cage(q, v), bent)
}

fn touch<T: Real>(bars: &Bars, q: Coordinates<T>, v: Coordinates<T>, wall: usize, s: f64) -> BarTouch<T> {
    bars.spot(&place(bars, q, v), wall, s, EXCESS, DROP)
}

/// Every contact of every state.
fn contacts(size: f64) -> impl Iterator<Item = (Bars, Coordinates<f64>, usize, f64)> {
    let taper = RollerTaper { half_angle: 0.07, outer_raceway_angle: 0.3 };
    let kinds = [Cones::NONE, Cones::new(Some(&taper))].into_iter();
    let kinds = kinds.flat_map(|cones| [ROUND, BarShape::Planes].map(|shape| bars(shape, cones)));
    let at = kinds.flat_map(move |bars| states(size).map(move |q| (bars, q)));
    let discs = [-9.7e-3, 0.0, 6e-3].into_iter().flat_map(|s| [(0, s), (1, s)]);
    at.flat_map(move |(bars, q)| discs.clone().map(move |(wall, s)| (bars, q, wall, s)))
}

#[test]
fn with_zero_angles_it_is_the_pocket_in_the_plane() {
    let at = PocketPlace { pitch_radius: PITCH, element_radius: RADIUS };
    let round = CylinderPocket::new(at, CLEARANCE, 0.436, 0.02);
    let planes = PlanePocket { place: at, clearance: CLEARANCE };
    let (mut touching, mut blended) = ([0; 2], 0);
    for i in 0..2000 {
        let (sin, cos) = math::sin_cos(f64::from(i) * 0.021 * 0.15);
        let d = [0.151e-3, 0.4e-3][usize::from(i % 2 == 1)];
        let mut q = [0.0; COORDINATES];
        [q[1], q[2], q[6], q[7], q[8]] = [d * sin, 0.3 + d * cos / PITCH, -2e-6, 1e-6, 0.3];
        let mut v = RATES;
        [v[3], v[4], v[9], v[10]] = [0.0; 4];
        let excess = EXCESS - DROP;
        let motion = ElementMotion {
            radial_offset: q[1],
            radial_speed: v[1],
            orbit_speed: v[2],
            spin_speed: SPIN + v[2],
            radius_excess: excess,
        };
        let [(sin, cos), (sin_b, cos_b)] = [q[2] - q[8], q[2] + START].map(math::sin_cos);
        let (lead, frame) = (Frame { sin, cos }, Frame { sin: sin_b, cos: cos_b });
        let seen = |v: [f64; 2]| lead.to_global(frame.to_local(v));
        let offset = at.offset(q[1], lead, seen([q[6], q[7]]));
        let mut relative = at.relative_motion(offset, &motion, lead, seen([v[6], v[7]]), v[8]);
        relative.displace([[q[11], q[12]], [v[11], v[12]]]);
        for (wall, shape) in [0, 1].into_iter().flat_map(|wall| [(wall, ROUND), (wall, BarShape::Planes)]) {
            let front = [Pillar::Front, Pillar::Back][wall] == Pillar::Front;
            let PillarContact { motion, normal, edge_share } = match shape {
                BarShape::Planes => planes.pillar(front, &relative),
                BarShape::Cylinders { .. } => round.pillar(front, &relative),
            };
            let found = touch(&bars(shape, Cones::NONE), q, v, wall, 0.0);
            if motion.delta <= 0.0 {
                assert!(found.spot.delta < 1e-18);
                continue;
            }
            touching[usize::from(edge_share == 1.0)] += 1;
            blended += usize::from(edge_share > 0.0 && edge_share < 1.0);
            let near = |a: f64, b: f64, by: f64| assert!((a - b).abs() < by, "{i} {wall}: {a} {b}");
            let spot = found.spot;
            near(spot.delta, motion.delta, 1e-18);
            near(spot.delta_dot, motion.delta_dot, 3e-15);
            near(spot.surface_speeds[0], motion.u1, 1e-14);
            near(spot.surface_speeds[1], motion.u2, 1e-30);
            near(spot.entrainment, 0.5 * (motion.u1 + motion.u2), 1e-14);
            near(spot.slip[0], motion.u1 - motion.u2, 1e-14);
            near(spot.slip[1], v[0] - v[5], 1e-15);
            near(found.edge_share, edge_share, 1e-12);
            // Levers on roller and cage.
            let grip = at.grip(offset, excess, normal, lead);
            let [of_normal, of_friction] = [spot.normal, spot.along].map(|[force, moment]| {
                let from_cage = [0.0, PITCH + q[1], 0.0];
                let centre = frame.to_local([q[6], q[7]]);
                let from_cage = difference(from_cage, [0.0, centre[0], centre[1]]);
                [moment[0], -(moment[0] + cross(from_cage, force)[0])]
            });
            for (k, (n, t)) in grip.normal.into_iter().zip(grip.tangent()).enumerate() {
                near(spot.normal[0][1 + k], -n, 1e-15);
                near(spot.along[0][1 + k], t, 1e-15);
            }
            near(of_normal[0], 0.0, 1e-30);
            near(of_normal[1], grip.on_mate[0], 3e-17);
            near(of_friction[0], grip.arm, 1e-17);
            near(of_friction[1], grip.on_mate[1], 3e-17);
            assert_eq!([spot.normal[0][0], spot.along[0][0]], [0.0; 2]);
            assert_eq!(spot.across[0], [1.0, 0.0, 0.0]);
        }
    }
    assert!(touching[0] > 500 && touching[1] > 500 && blended > 10, "{touching:?} {blended}");
}

#[test]
fn forces_are_the_gradient_of_the_approach() {
    for (bars, q, wall, s) in contacts(1e-3).chain(contacts(20e-3)) {
        let variable = |k| Dual::<COORDINATES>::variable(q[k], k);
        let rates = RATES.map(Dual::lift);
        let sloped = touch(&bars, std::array::from_fn(variable), rates, wall, s).spot.delta;
        let Spot { normal: [force, moment], .. } = touch(&bars, q, RATES, wall, s).spot;
        let displaced = place(&bars, q, RATES).displaced;
        let r = PITCH + q[1];
        let base = (PITCH, bars.cones.inclination);
        let state = RollerState::new(base, [q[0], q[1]], [q[3], q[4]], [0.0; 6]);
        let [.., skew, tilt, _] = state.over_speeds([[0.0; 3], moment], 0.0);
        let over_angles = [skew, tilt];
        // On the cage about its own centre, in global axes.
        let (sin, cos) = math::sin_cos(q[2] + START);
        let back = |v: Vector<f64>| ahead(v, [cos, -sin]);
        let of_cage = Tilt::new([q[9], q[10]]);
        let from_cage = difference([q[0], r, 0.0], ahead([q[5], q[6], q[7]], [cos, sin]));
        let on_cage = back(scaled(sum(moment, cross(from_cage, force)), -1.0));
        let pushed = back(scaled(force, -1.0));
        let over_tilts = of_cage.moments_over_angles(on_cage);
        let expected = [
            force[0],
            force[1],
            r * force[2] + moment[0],
            over_angles[0],
            over_angles[1],
            pushed[0],
            pushed[1],
            pushed[2],
            dot(on_cage, of_cage.axis),
            over_tilts[0],
            over_tilts[1],
            -dot(force, displaced[0]),
            -dot(force, displaced[1]),
        ];
        for (k, force) in expected.into_iter().enumerate() {
            let error = (-sloped.eps[k] - force).abs();
            assert!(error < 1e-14, "{wall} {s} {k}: {} {force} {q:?}", -sloped.eps[k]);
        }
        // Nothing turns the roller about its own axis.
        let allowed = if bars.cones == Cones::NONE { 1e-17 } else { 2e-17 };
        assert!(dot(moment, state.axis).abs() < allowed);
    }
}

#[test]
fn the_rate_of_the_approach_is_that_along_the_motion() {
    let h = 2e-6;
    for (bars, q, wall, s) in contacts(1e-3) {
        let at = |time: f64| std::array::from_fn(|k| q[k] + time * RATES[k]);
        let delta = |time: f64| touch(&bars, at(time), RATES, wall, s).spot.delta;
        let slope = |h: f64| (delta(h) - delta(-h)) / (2.0 * h);
        let rate = (4.0 * slope(h) - slope(2.0 * h)) / 3.0;
        let told = touch(&bars, q, RATES, wall, s).spot.delta_dot;
        // Differences across the end of a wall see both sides of it.
        let share = [-2.0 * h, 2.0 * h].map(|time| touch(&bars, at(time), RATES, wall, s).edge_share);
        if share[0] == share[1] {
            // Pockets that are inclined have larger numbers to be round-off of.
            let allowed = if bars.cones == Cones::NONE { 1e-11 } else { 5e-11 };
            assert!((rate - told).abs() < allowed, "{wall} {s}: {rate} {told} {q:?}");
        }
    }
}

#[test]
fn the_slip_is_that_of_the_materials_at_the_contact() {
    for (bars, q, wall, s) in contacts(1e-3) {
        let BarTouch { spot, .. } = touch(&bars, q, RATES, wall, s);
        let in_bars = place(&bars, q, RATES);
        // Power of unit friction on both bodies, each about its own centre.
        let (roller, cage) = (roller(&bars, q, RATES), cage(q, RATES));
        let (sin, cos) = math::sin_cos(q[2] + START);
        let local = |v: Vector<f64>| ahead(v, [cos, sin]);
        let from_cage = difference([q[0], PITCH + q[1], 0.0], local(cage.centre));
        for ([force, moment], slip) in [(spot.along, spot.slip[0]), (spot.across, spot.slip[1])] {
            let on_cage = scaled(sum(moment, cross(from_cage, force)), -1.0);
            let [out, on] = in_bars.displaced;
            let bending = RATES[11] * dot(force, out) + RATES[12] * dot(force, on);
            let power = dot(force, roller.moving.velocity) + dot(moment, roller.moving.turning)
                - dot(force, local(cage.moving.velocity))
                + dot(on_cage, local(cage.moving.turning))
                - bending;
            assert!((power - slip).abs() < 1e-14, "{power} {slip}");
        }
        assert_eq!(spot.surface_speeds, [spot.slip[0], 0.0]);
        assert_eq!(spot.rolling, [[0.0; 3]; 2]);
        assert!(dot(spot.along[0], spot.across[0]).abs() < 1e-15);
    }
}

#[test]
fn the_approach_is_that_of_the_rim() {
    let (mut walls, mut edges) = (0, 0);
    for (bars, q, wall, s) in contacts(1e-3).filter(|(bars, ..)| bars.cones == Cones::NONE) {
        let BarTouch { spot, edge_share } = touch(&bars, q, RATES, wall, s);
        if spot.delta <= 0.0 {
            continue;
        }
        // In axes that turn with the roller to its azimuth, and then with the cage, by plain sums.
        let tilt = Tilt::new([q[3], q[4]]);
        let radius = RADIUS + EXCESS - DROP;
        let (sin, cos) = math::sin_cos(q[2] + START);
        let (sin_p, cos_p) = math::sin_cos(q[8] + START);
        let of_cage = Tilt::new([q[9], q[10]]);
        let sign = if wall == 0 { 1.0 } else { -1.0 };
        // A place of the rim from the centre of the pocket, outwards and towards the wall.
        let rim = |angle: f64| {
            let (across, along) = math::sin_cos(angle);
            let in_roller = [s, radius * along, radius * across];
            let at = sum([q[0], PITCH + q[1], 0.0], tilt.turned(in_roller));
            let global = ahead(at, [cos, -sin]);
            let in_cage = of_cage.turned_back(difference(global, [q[5], q[6], q[7]]));
            let [_, out, on] = ahead(in_cage, [cos_p, sin_p]);
            [out - PITCH - q[11], sign * (on - q[12])]
        };
        let (pocket, (edge_sin, edge_cos)) = (RADIUS + CLEARANCE, bars.edge);
        let [out, _] = place(&bars, q, RATES).disc(s);
        let depth = |angle: f64| {
            let [x, y] = rim(angle);
            match bars.shape {
                BarShape::Planes => y - pocket,
                BarShape::Cylinders { .. } if edge_share == 1.0 => {
                    -math::hypot(x - out.signum() * pocket * edge_sin, y - pocket * edge_cos)
                }
                BarShape::Cylinders { .. } => math::hypot(x, y) - pocket,
            }
        };
        let (mut best, mut width) = (0.0, std::f64::consts::PI);
        for _ in 0..60 {
            let candidates = (-40..=40).map(|i| best + width * f64::from(i) / 40.0);
            best = candidates.max_by(|x, y| depth(*x).total_cmp(&depth(*y))).unwrap();
            width *= 0.5;
        }
        let at_edge = usize::from(edge_share == 1.0);
        let reach = if at_edge == 1 { -depth(best) } else { depth(best) };
        let error = spot.delta - reach;
        (walls, edges) = (walls + 1 - at_edge, edges + at_edge);
        // (R g h)^2/(2 d), with the angle between both axes; nothing of a plane.
        let [_, x, y] = difference(tilt.axis, ahead(of_cage.axis, [cos, sin]));
        let d = match bars.shape {
            BarShape::Planes => f64::INFINITY,
            BarShape::Cylinders { .. } => [CLEARANCE, 0.99 * radius][at_edge],
        };
        let allowed = 2e-14 + (0.5 * radius * (x * x + y * y)).powi(2) / (2.0 * d);
        assert!(error.abs() < allowed, "{error:e} {allowed:e} {q:?}");
    }
    assert!(walls > 30 && edges > 30, "{walls} {edges}");
}

#[test]
fn walls_that_are_apart_are_not_touched() {
    let mut apart = 0;
    for (bars, q, wall, s) in contacts(1e-3) {
        let place = place(&bars, q, RATES);
        if bars.apart(&place, 9.7e-3, EXCESS)[wall] {
            apart += 1;
            assert!(touch(&bars, q, RATES, wall, s).spot.delta < 0.0, "{q:?}");
        }
    }
    assert!(apart > 100, "{apart}");
}

#[test]
fn a_roller_in_the_middle_touches_nothing() {
    let still = [0.0; COORDINATES];
    for shape in [ROUND, BarShape::Planes] {
        let bars = bars(shape, Cones::NONE);
        let in_bars = place(&bars, still.map(Dual::<1>::lift), still.map(Dual::lift));
        assert_eq!(bars.apart(&in_bars, 0.01, 0.0), [true; 2]);
        for wall in [0, 1] {
            let BarTouch { spot, edge_share } = bars.spot(&in_bars, wall, 0.0, 0.0, 0.0);
            assert_eq!((spot.delta.re, edge_share.re), (-CLEARANCE, 0.0));
            let numbers = [spot.normal, spot.along, spot.across, spot.rolling];
            let numbers = numbers.iter().flatten().flatten().chain([&spot.delta, &spot.delta_dot]);
            let numbers = numbers.chain(&spot.slip).chain(&spot.surface_speeds);
            assert!(numbers.chain([&spot.entrainment]).all(|x| x.re.is_finite() && x.eps[0].is_finite()));
        }
        // What is no number is told.
        let mut lost = still;
        lost[1] = f64::NAN;
        if shape == ROUND {
            let place = place(&bars, lost, still);
            assert_eq!(bars.apart(&place, 0.01, 0.0), [false; 2]);
            assert!(bars.spot(&place, 0, 0.0, 0.0, 0.0).spot.delta.is_nan());
        }
    }
}
