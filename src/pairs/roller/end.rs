//! The end of a roller on a rib, or on the side of its pocket.
//!
//! ```text
//! end: a paraboloid of radius R_s over the disc |y| <= R_end;   rib: tangent plane of its cone in the meridian of the roller
//! N  = e cos(eps) b + f sin(eps) e_n(P),   e = +-1 the end, f = 1 a rib of the outer ring, -1 of the inner one
//! N1 = N . m1,   N2 = N . w,   Nu = N . e u,   m1 = (e_n - g u)/c,   w = u x m1
//! y  = nearest point of {|y| <= R_end, f y_1 >= y_min} to R_s (N1, N2)/Nu:   on the cap, its rim, the edge of the rib, or the corner of both
//! delta = cos(eps) e t + f sin(eps) (rho + (d - r)) + (L/2) (-cos(eps) (1 - u . b) + e f sin(eps) g) - (|y|^2/2 R_s) Nu
//!         + cos(eps) y_n^2/(2 R_s) + y_1 N1 + y_2 N2 - sin(eps) y_n - g_f,   y_n = R_s tan(eps), or the nearest of y_min to R_end
//! on the roller for Q = 1:  force -(N + k_t e_t),   moment about P  -((X - P) x N - T u + T (g/c) m1),   T = y_1 N2 - y_2 N1
//! ```
//!
//! y is where a concave function is largest over a convex region, so delta has a continuous slope from the cap to the corner. T turns the roller about
//! its own axis by nothing: it is there on the edge of a rib only. Left out: the curvature of the cone across the meridian, f sin(eps) y_2^2/(2 rho_c), a
//! micrometre at 3 mm. Source: geometry; the gradient is exact.

use super::{MovingRoller, Spot};
use crate::bodies::MovingRing;
use crate::pairs::raceway::OffAxis;
use crate::scalar::{Real, math};
use crate::space::solid::{Moving, cross, difference, dot, scaled, sum};

/// Square of a speed, m^2/s^2, that is added so that its size has a slope at none.
const SPEED_FLOOR: f64 = 1e-24;

/// What of an end touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Region {
    Cap,
    Rim,
    Edge,
    Corner,
}

/// The shape of the ends of rollers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EndShape {
    /// R_s, R_end and L, m.
    pub(crate) cap_radius: f64,
    pub(crate) face_radius: f64,
    pub(crate) length: f64,
}

/// An end beside its rib.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RibGeometry {
    pitch_radius: f64,
    end: EndShape,
    /// eps, as sine and cosine.
    angle: [f64; 2],
    /// f and e.
    outwards: f64,
    side: f64,
    /// y_min and g_f, m.
    lowest: f64,
    gap: f64,
}

/// An end on a rib.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EndTouch<T> {
    pub(crate) spot: Spot<T>,
    /// y_1 and y_2, m.
    pub(crate) place: [T; 2],
    pub(crate) region: Region,
    /// Motion of the roller against the ring, at the centre of the roller.
    pub(crate) passing: Moving<T>,
}

/// Nearest point of the face above the edge of the rib.
fn nearest<T: Real>([a, b]: [T; 2], face: f64, outwards: f64, lowest: f64) -> ([T; 2], Region) {
    let above = |y: T| outwards * y.value() >= lowest;
    let size = (a * a + b * b).sqrt();
    let within = size.value() <= face;
    if within && above(a) {
        return ([a, b], Region::Cap);
    }
    if !within {
        let scale = T::constant(face) / size;
        if above(a * scale) {
            return ([a * scale, b * scale], Region::Rim);
        }
    }
    let edge = outwards * lowest;
    let width = (face * face - lowest * lowest).max(0.0).sqrt();
    if !above(a) && b.value().abs() <= width {
        return ([T::constant(edge), b], Region::Edge);
    }
    ([T::constant(edge), T::constant(if b.value() < 0.0 { -width } else { width })], Region::Corner)
}

impl RibGeometry {
    /// Of a rib of the outer (0) or inner (1) ring at +x (1.0) or -x (-1.0) whose cone opens by `angle` (rad), reaching `height` (m) above the raceway, which is
    /// `reach` (m) from the pitch circle, with the play of a roller between two ribs, m.
    pub(crate) fn rib(
        (pitch_radius, reach, end): (f64, f64, EndShape),
        (ring, side): (usize, f64),
        [angle, height, end_play]: [f64; 3],
    ) -> Self {
        let (sin, cos) = math::sin_cos(angle);
        Self {
            pitch_radius,
            end,
            angle: [sin, cos],
            outwards: if ring == 0 { 1.0 } else { -1.0 },
            side,
            lowest: reach - height,
            gap: cos * 0.5 * end_play,
        }
    }

    /// Of the side of a pocket with this play of the roller along the axis, m.
    pub(crate) fn pocket_side((pitch_radius, end): (f64, EndShape), side: f64, play: f64) -> Self {
        let lowest = -end.face_radius;
        Self { pitch_radius, end, angle: [0.0, 1.0], outwards: 1.0, side, lowest, gap: 0.5 * play }
    }

    /// y_n, m: where an untilted end touches. A cap whose middle is off the face or below the edge of the rib does so with its rim or at
    /// that edge.
    fn middle(&self) -> f64 {
        let [sin, cos] = self.angle;
        let of_cap = self.end.cap_radius * sin / cos;
        of_cap.max(self.lowest).min(self.end.face_radius)
    }

    /// R_f, m: that of the cap with half of the curvature of the rib. A cap that is flatter than its rim can lean against the rib has the
    /// curvature of a cap there, so that it is no contact of conforming surfaces.
    pub(crate) fn radius(&self) -> f64 {
        let ([sin, cos], cap) = (self.angle, self.end.cap_radius);
        let middle = self.middle();
        let slope = if middle < cap * sin / cos { cos * middle / cap } else { sin };
        let of_rib = self.pitch_radius + self.outwards * middle;
        1.0 / (1.0 / cap - self.outwards * slope / (2.0 * of_rib))
    }

    /// Whether the end of a roller there is certainly apart from its rib.
    pub(crate) fn apart(&self, roller: &MovingRoller<f64>, ring: &MovingRing<f64>) -> bool {
        let ([sin, cos], b) = (self.angle, ring.axis);
        let (place, [ox, or, ot]) = (roller.place, ring.centre);
        let t = (place.x - ox) * b[0] + (place.rho + self.pitch_radius - or) * b[1] - ot * b[2];
        let off = difference(place.axis, b);
        let angle = 1.01 * dot(off, off).sqrt();
        // The face turned by the angle, the middle shifted along the cone.
        let across =
            place.rho.abs() + or.abs() + ot.abs() + self.pitch_radius * (b[1].abs() + b[2].abs()) * sin;
        let turned = self.end.face_radius * angle + 0.5 * self.end.length * sin * angle;
        // Untilted, y_1 N1 - |y|^2/(2 R_s) is largest at y_n.
        cos * self.side * t + sin * across + turned + angle * angle * self.end.cap_radius < self.gap
    }

    /// The end of a roller there. They touch where delta is above zero.
    pub(crate) fn touch<T: Real>(&self, roller: &MovingRoller<T>, ring: &MovingRing<T>) -> EndTouch<T> {
        let [sin, cos] = self.angle;
        let (e, f, half) = (self.side, self.outwards, 0.5 * self.end.length);
        let cap = self.end.cap_radius;
        let (u, b, [ox, or, ot]) = (roller.place.axis, ring.axis, ring.centre);
        let one = T::constant(1.0);
        let r = roller.place.rho + self.pitch_radius;
        let along = roller.place.x - ox;
        let OffAxis { along: t, square, distance: d, outward: e_n, tangent: e_t } =
            OffAxis::new(r, [along, -or, -ot], b);
        let g = dot(e_n, u);
        let c = (one - g * g).sqrt();
        let normal = sum(scaled(b, one * (e * cos)), scaled(e_n, one * (f * sin)));
        let m1 = scaled(difference(e_n, scaled(u, g)), one / c);
        let w = cross(u, m1);
        let (n1, n2, nu) = (dot(normal, m1), dot(normal, w), dot(normal, u) * e);
        let ([y1, y2], region) =
            nearest([n1 / nu * cap, n2 / nu * cap], self.end.face_radius, f, self.lowest);
        let off = difference(u, b);
        let from_axis = dot(off, off) * 0.5;
        let drop = (y1 * y1 + y2 * y2) * (0.5 / cap);
        let y_n = self.middle();
        let delta = t * (cos * e)
            + (roller.place.rho + square / (d + r)) * (f * sin)
            + (g * (e * f * sin) - from_axis * cos) * half
            - drop * nu
            + y1 * n1
            + y2 * n2
            + (cos * y_n * y_n * 0.5 / cap - sin * y_n - self.gap);
        let arm = sum(scaled(u, (-drop + half) * e), sum(scaled(m1, y1), scaled(w, y2)));
        let turn = y1 * n2 - y2 * n1;
        let tangential = dot(arm, e_t) / d * (f * sin) + turn * dot(w, e_t) / (c * d);
        let n = sum(normal, scaled(e_t, tangential));
        let moment = sum(difference(cross(arm, normal), scaled(u, turn)), scaled(m1, turn * g / c));
        let unit = [n.map(|x| -x), moment.map(|x| -x)];
        let from_ring = [along, r - or, -ot];
        let carried = sum(ring.moving.velocity, cross(ring.moving.turning, from_ring));
        let passing = Moving {
            velocity: difference(roller.moving.velocity, carried),
            turning: difference(roller.moving.turning, ring.moving.turning),
        };
        let delta_dot = -(dot(unit[0], passing.velocity) + dot(unit[1], passing.turning));
        let across = cross(normal, e_t);
        let slip = sum(passing.velocity, cross(passing.turning, arm));
        let slip = [dot(slip, e_t), dot(slip, across)];
        // Past the place of contact, which goes round with the azimuth.
        let Moving { velocity, turning } = roller.moving;
        let around = velocity[2] / r;
        let zero = T::constant(0.0);
        let at = sum([zero, r, zero], arm);
        let carried = sum([zero, velocity[1], zero], cross([around, zero, zero], at));
        let of_roller = difference(sum(velocity, cross(turning, arm)), carried);
        let of_roller = [dot(of_roller, e_t), dot(of_roller, across)];
        let of_ring = [of_roller[0] - slip[0], of_roller[1] - slip[1]];
        let size = |[a, b]: [T; 2]| (a * a + b * b + SPEED_FLOOR).sqrt();
        let mean = [(of_roller[0] + of_ring[0]) * 0.5, (of_roller[1] + of_ring[1]) * 0.5];
        let spot = Spot {
            delta,
            delta_dot,
            surface_speeds: [size(of_roller), size(of_ring)],
            entrainment: size(mean),
            slip,
            normal: unit,
            along: [e_t, cross(arm, e_t)],
            across: [across, cross(arm, across)],
            rolling: [[zero; 3]; 2],
        };
        EndTouch { spot, place: [y1, y2], region, passing }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::RollerPlace;
    use crate::scalar::Dual;
    use crate::space::solid::{Tilt, Vector};

    const PITCH: f64 = 39.99e-3;
    const END: EndShape = EndShape { cap_radius: 0.6, face_radius: 6.7e-3, length: 22e-3 };

    fn rib(ring: usize, side: f64) -> RibGeometry {
        RibGeometry::rib((PITCH, 7.5e-3, END), (ring, side), [0.01, 2.5e-3, 50e-6])
    }

    /// Coordinates: x, rho, skew and tilt of the roller; x, r, psi and two angles of the ring.
    fn touch<T: Real>(rib: &RibGeometry, q: [T; 9], rates: Option<[Vector<T>; 4]>) -> EndTouch<T> {
        let place = RollerPlace { x: q[0], rho: q[1], axis: Tilt::new([q[2], q[3]]).axis };
        let still = [[T::constant(0.0); 3]; 4];
        let [velocity, turning, of_ring, ring_turning] = rates.unwrap_or(still);
        let roller = MovingRoller { place, moving: Moving { velocity, turning } };
        let ring = MovingRing {
            centre: [q[4], q[5], q[6]],
            axis: Tilt::new([q[7], q[8]]).axis,
            moving: Moving { velocity: of_ring, turning: ring_turning },
            speed: T::constant(0.0),
        };
        rib.touch(&roller, &ring)
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
        for (ring, side) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)] {
            for q in STATES {
                for sign in [[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]] {
                    let mut q = q;
                    (q[2], q[3]) = (q[2] * sign[0], q[3] * sign[1]);
                    let rib = rib(ring, side);
                    let found = touch(&rib, q, None);
                    seen.push(found.region);
                    let sloped = touch(&rib, std::array::from_fn(|k| Dual::<9>::variable(q[k], k)), None);
                    let [force, moment] = found.spot.normal;
                    let tilt = Tilt::new([q[2], q[3]]);
                    let of_ring = Tilt::new([q[7], q[8]]);
                    let over_angles = tilt.moments_over_angles(moment);
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
                    assert!(dot(moment, tilt.axis).abs() < 1e-15, "{:?}", found.region);
                    assert!(dot(on_ring, of_ring.axis).abs() < 1e-15);
                }
            }
        }
        for region in [Region::Cap, Region::Rim, Region::Edge, Region::Corner] {
            assert!(seen.contains(&region), "{region:?}");
        }
    }

    #[test]
    fn in_the_middle_it_has_half_of_the_play() {
        let found = touch(&rib(0, 1.0), [0.0; 9], None);
        assert!(
            (found.spot.delta + rib(0, 1.0).gap).abs() < 1e-17 && found.region == Region::Cap,
            "{found:?}"
        );
    }

    #[test]
    fn the_end_play_is_that_of_any_cap() {
        // Flat, between, and so round that the edge of the rib touches.
        for cap_radius in [50.0, 2.0, 0.6, 0.1] {
            for angle in [0.0, 1e-3, 0.025] {
                for (ring, side) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)] {
                    let end = EndShape { cap_radius, ..END };
                    let rib = RibGeometry::rib((PITCH, 7.5e-3, end), (ring, side), [angle, 2.5e-3, 50e-6]);
                    let at = |x: f64| touch(&rib, [side * x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], None);
                    let found = at(25e-6).spot.delta;
                    assert!(found.abs() < 1e-16, "{cap_radius} {angle} {ring} {side}: {found:e}");
                    assert!(rib.radius() > 0.7 * cap_radius && rib.radius() < 1.4 * cap_radius);
                }
            }
        }
    }

    #[test]
    fn the_approach_is_that_of_the_deepest_point() {
        // The face by brute force against the plane that touches the cone in the meridian of the roller.
        for (ring, side) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)] {
            for q in STATES {
                let rib = rib(ring, side);
                let found = touch(&rib, q, None).spot.delta;
                let [sin, cos] = rib.angle;
                let f = rib.outwards;
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
                let u = tilt.axis;
                let m1 = difference(e_n, scaled(u, dot(e_n, u)));
                let m1 = scaled(m1, 1.0 / dot(m1, m1).sqrt());
                let w = cross(u, m1);
                // The plane touches the undisplaced cap with the gap g_f.
                let y_n = rib.middle();
                let at_rest = sin * (f * PITCH + y_n) + cos * (11e-3 - y_n * y_n / (2.0 * 0.6)) + rib.gap;
                let mut deepest = f64::NEG_INFINITY;
                let n = 2000;
                for i in 0..=n {
                    for k in 0..=40 {
                        let (angle, size) = (
                            std::f64::consts::TAU * f64::from(i) / f64::from(n),
                            6.7e-3 * f64::from(k) / 40.0,
                        );
                        let (y1, y2) = (size * angle.cos(), size * angle.sin());
                        if f * y1 < rib.lowest {
                            continue;
                        }
                        let arm = sum(
                            scaled(u, side * (11e-3 - size * size / 1.2)),
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
        for q in STATES {
            let rib = rib(0, 1.0);
            let dq = [0.3, -0.02, 4.0, -3.0, 0.1, 0.2, -0.1, 2.0, 5.0];
            let tilt = Tilt::new([q[2], q[3]]);
            let ring = Tilt::new([q[7], q[8]]);
            let spin = scaled(tilt.axis, 800.0);
            let of_ring = scaled(ring.axis, -314.0);
            let rates = [
                [dq[0], dq[1], 0.0],
                sum(tilt.angular_velocity([dq[2], dq[3]]), spin),
                [dq[4], dq[5], dq[6]],
                sum(ring.angular_velocity([dq[7], dq[8]]), of_ring),
            ];
            let found = touch(&rib, q, Some(rates));
            let h = 1e-7;
            let at = |h: f64| touch(&rib, std::array::from_fn(|k| q[k] + h * dq[k]), None).spot.delta;
            let rate = (at(h) - at(-h)) / (2.0 * h);
            assert!((found.spot.delta_dot - rate).abs() < 1e-8, "{:?}: {found:?} {rate}", found.region);
            // Speeds differ by the slip.
            let [u1, u2] = found.spot.surface_speeds;
            let slip = found.spot.slip[0].hypot(found.spot.slip[1]);
            assert!(slip <= u1 + u2 + 1e-12 && slip >= (u1 - u2).abs() - 1e-12);
        }
    }
}
