//! A disc of a roller that shifts, skews and tilts against a raceway whose ring does so too.
//!
//! ```text
//! C = P + s u,   q = C - O,   t = q . b,   p = q - t b,   d = |p|,   e_n = p/d,   e_t = b x e_n
//! g = e_n . u,   h = e_t . u,   c = sqrt(1 - g^2),   R = R_b + dR - p(s)
//! delta = k (rho + (d - r)) - g_0 + dR - p(s) - R (1 - c) - p_r(t)
//! n     = d(delta)/dC = k e_n - R (g h/(c d)) e_t - p_r'(t) b
//! on the roller for Q = 1:   force -n,   moment about P  -s u x n + R (g/c) (u x e_n)
//! ```
//!
//! P is the centre of the roller and u its axis, O the centre of the ring and b its axis, all in the axes of the azimuth; k is 1 on the outer
//! raceway and -1 on the inner one. R (1 - c) is how much less far the rim of a tilted disc reaches: 94 nm at 5 mrad of one of 7.5 mm. Force and moment are the
//! gradient of delta, so that they turn neither body about its own axis and their work is that of the approach. d - r and 1 - c are sums of
//! small numbers. Valid for tilts up to those of `space/solid`. Source: geometry; the gradient is exact.

use super::RacewayGeometry;
use crate::bodies::RollerPlace;
use crate::laws::elastic::profile::Profile;
use crate::pairs::groove::RingPlace;
use crate::scalar::Of;
use crate::space::solid::{Vector, cross, difference, dot, scaled, sum};

/// A disc against a raceway.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Disc<T> {
    /// m.
    pub(crate) delta: T,
    /// n: the unit force on the ring, which acts through the roller's with the opposite sign.
    pub(crate) normal: Vector<T>,
    /// Moment on the roller about its centre for a unit force, m.
    pub(crate) on_roller: Vector<T>,
    /// t, m: place along the axis of the ring.
    pub(crate) in_raceway: T,
    /// Drop of the raceway there, m.
    pub(crate) raceway_drop: T,
    /// e_n and e_t.
    pub(crate) outward: Vector<T>,
    pub(crate) tangent: Vector<T>,
    /// d, R, g and c.
    pub(crate) distance: T,
    pub(crate) radius: T,
    pub(crate) lean: T,
    pub(crate) cosine: T,
}

/// A point beside the axis of a ring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OffAxis<T> {
    /// t, m.
    pub(crate) along: T,
    /// d^2 - r^2, m^2, by small numbers, and d, m.
    pub(crate) square: T,
    pub(crate) distance: T,
    /// e_n and e_t.
    pub(crate) outward: Vector<T>,
    pub(crate) tangent: Vector<T>,
}

impl<T: Of<f64>> OffAxis<T> {
    /// Of a point whose place from the centre of a ring with the axis `b` is (along, r + outwards, across), m.
    #[inline(always)]
    pub(crate) fn new(r: T, [along, outwards, across]: [T; 3], b: Vector<T>) -> Self {
        let in_meridian = (r + outwards) * b[1] + across * b[2];
        let t = along * b[0] + in_meridian;
        let px = along * (b[1] * b[1] + b[2] * b[2]) - b[0] * in_meridian;
        let beyond = outwards - t * b[1];
        let pt = across - t * b[2];
        let square = px * px + r * beyond * 2.0 + beyond * beyond + pt * pt;
        let distance = (r * r + square).sqrt();
        let outward = scaled([px, r + beyond, pt], r.like(1.0) / distance);
        Self { along: t, square, distance, outward, tangent: cross(b, outward) }
    }
}

impl RacewayGeometry {
    /// The disc at `s` (m) of a roller whose radius is larger than nominal by `excess` (m) against the raceway of the outer (0) or inner (1)
    /// ring.
    pub(crate) fn disc<T: Of<f64>>(
        &self,
        ring: (usize, &RingPlace<T>),
        roller: &RollerPlace<T>,
        profile: Option<&Profile>,
        excess: f64,
        s: T,
    ) -> Disc<T> {
        let (side, RingPlace { centre, axis: b }) = (if ring.0 == 0 { 1.0 } else { -1.0 }, *ring.1);
        let (u, one) = (roller.axis, roller.rho.like(1.0));
        let r = roller.rho + self.pitch_radius;
        let place = [roller.x + u[0] * s - centre[0], u[1] * s - centre[1], u[2] * s - centre[2]];
        let OffAxis { along: t, square, distance: d, outward, tangent } = OffAxis::new(r, place, b);
        let (g, h) = (dot(outward, u), dot(tangent, u));
        let c = (one - g * g).sqrt();
        let drop = profile.map_or_else(|| one.like(0.0), |profile| profile.of_roller(s));
        let [raceway, slope] = profile.map_or([one.like(0.0); 2], |profile| profile.of_raceway(t));
        let larger = one.like(excess) - drop;
        let radius = larger + self.roller_radius;
        let delta =
            (roller.rho + square / (d + r)) * side - self.gap + larger - radius * g * g / (one + c) - raceway;
        let turned = scaled(tangent, radius * g * h / (c * d));
        let n = difference(difference(scaled(outward, one.like(side)), turned), scaled(b, slope));
        let lever = scaled(cross(u, n), -s);
        let on_roller = sum(lever, scaled(cross(u, outward), radius * g / c));
        Disc {
            delta,
            normal: n,
            on_roller,
            in_raceway: t,
            raceway_drop: raceway,
            outward,
            tangent,
            distance: d,
            radius,
            lean: g,
            cosine: c,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::ElementMotion;
    use crate::laws::elastic::profile::Logarithm;
    use crate::pairs::raceway::RingMotion;
    use crate::scalar::Dual;
    use crate::space::solid::Tilt;

    const NU2310: RacewayGeometry =
        RacewayGeometry { pitch_radius: 39.99e-3, roller_radius: 7.5e-3, gap: 10e-6 };

    fn profile() -> Profile {
        let logarithm = Logarithm::new(1.5e-6, 0.0204, 0.6, Some(12e-6));
        Profile::new(0.0204, Some(logarithm), [None, Some(2.0)], 8).unwrap()
    }

    /// Coordinates: x, rho, skew and tilt of the roller; x, r, psi and two angles of the ring.
    fn disc<T: Of<f64>>(ring: usize, q: [T; 9], s: f64) -> Disc<T> {
        let roller = RollerPlace { x: q[0], rho: q[1], axis: Tilt::new([q[2], q[3]]).axis };
        let place = RingPlace { centre: [q[4], q[5], q[6]], axis: Tilt::new([q[7], q[8]]).axis };
        NU2310.disc((ring, &place), &roller, Some(&profile()), 0.3e-6, q[0].like(s))
    }

    const STATES: [[f64; 9]; 3] = [
        [2e-5, 5e-6, 5e-3, -4e-3, 1e-5, -2e-5, 1e-5, 3e-3, -5e-3],
        [-1e-4, -8e-6, 0.05, 0.03, 3e-5, 1e-5, -2e-5, -0.02, 0.04],
        [0.0, 1e-6, 0.0, 1e-3, 0.0, 0.0, 0.0, 0.0, 2e-3],
    ];

    #[test]
    fn forces_are_the_gradient_of_the_approach() {
        for (ring, q) in [0, 1].into_iter().flat_map(|ring| STATES.map(|q| (ring, q))) {
            for s in [-9.7e-3, -3e-3, 0.0, 8e-3] {
                let sloped = disc(ring, std::array::from_fn(|k| Dual::<9>::variable(q[k], k)), s);
                let Disc { normal, on_roller, .. } = disc(ring, q, s);
                // Power of the unit wrench over the coordinates.
                let tilt = Tilt::new([q[2], q[3]]);
                let over_angles = tilt.moments_over_angles(on_roller);
                let of_ring = Tilt::new([q[7], q[8]]);
                let r = NU2310.pitch_radius + q[1];
                let from_ring = [q[0] - q[4], r - q[5], -q[6]];
                let moment = scaled(sum(on_roller, cross(from_ring, scaled(normal, -1.0))), -1.0);
                let on_ring = of_ring.moments_over_angles(moment);
                let expected = [
                    -normal[0],
                    -normal[1],
                    over_angles[0],
                    over_angles[1],
                    normal[0],
                    normal[1],
                    normal[2],
                    on_ring[0],
                    on_ring[1],
                ];
                for (k, force) in expected.into_iter().enumerate() {
                    // A force is what the energy falls by: Q d(delta) with the sign of approaching bodies.
                    let slope = -sloped.delta.eps[k];
                    assert!((slope - force).abs() < 2e-13, "{ring} {s} {k}: {slope} {force}");
                }
                // Nothing turns a body about its own axis.
                assert!(dot(on_roller, tilt.axis).abs() < 1e-16 && dot(moment, of_ring.axis).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn the_approach_is_that_of_the_rim() {
        // The point of the rim that reaches furthest, by brute force around the disc.
        for (ring, q) in [0, 1].into_iter().flat_map(|ring| STATES.map(|q| (ring, q))) {
            for s in [-9.7e-3, 0.0, 8e-3] {
                let (tilt, b) = (Tilt::new([q[2], q[3]]), Tilt::new([q[7], q[8]]).axis);
                let profile = profile();
                let radius = NU2310.roller_radius + 0.3e-6 - profile.of_roller(s);
                let centre = [
                    q[0] + s * tilt.axis[0] - q[4],
                    NU2310.pitch_radius + q[1] + s * tilt.axis[1] - q[5],
                    s * tilt.axis[2] - q[6],
                ];
                let from_axis = |angle: f64| {
                    let rim = tilt.turned([0.0, radius * angle.cos(), radius * angle.sin()]);
                    let at = sum(centre, rim);
                    let t = dot(at, b);
                    let across = difference(at, scaled(b, t));
                    dot(across, across).sqrt()
                };
                let side = if ring == 0 { 1.0 } else { -1.0 };
                let middle = if ring == 0 { 0.0 } else { std::f64::consts::PI };
                let (mut best, mut width) = (middle, 0.3);
                for _ in 0..60 {
                    let candidates = (-10..=10).map(|i| best + width * f64::from(i) / 10.0);
                    best = candidates
                        .max_by(|x, y| (side * from_axis(*x)).total_cmp(&(side * from_axis(*y))))
                        .unwrap();
                    width *= 0.5;
                }
                let raceway = NU2310.pitch_radius + side * (NU2310.roller_radius + NU2310.gap);
                let found = disc(ring, q, s);
                let [drop, _] = profile.of_raceway(found.in_raceway);
                let reach = side * (from_axis(best) - raceway) - drop;
                // Of second order: the rim is taken where the axis of the ring is nearest.
                let angle = q[2].hypot(q[3]).max(q[7].hypot(q[8]));
                let allowed = 1e-14 + 0.02 * angle.powi(4);
                assert!((found.delta - reach).abs() < allowed, "{ring} {s}: {} {reach}", found.delta);
            }
        }
    }

    #[test]
    fn without_tilt_it_is_the_contact_in_the_plane() {
        for (rho, y, z) in [(3e-6, 1e-5, -2e-5), (-5e-6, 0.0, 3e-5)] {
            let plane = ElementMotion { radial_offset: rho, ..ElementMotion::default() };
            let ring = RingMotion { position: [y, z], velocity: [0.0; 2], speed: 0.0 };
            let (inner, _) = NU2310.inner(&plane, &ring);
            let (outer, _) = NU2310.outer(&plane, 0.0);
            let upright = RollerPlace { x: 0.0, rho, axis: [1.0, 0.0, 0.0] };
            for (k, centre, expected) in [(0, [0.0; 3], outer.delta), (1, [0.0, y, z], inner.delta)] {
                let place = RingPlace { centre, axis: [1.0, 0.0, 0.0] };
                let found = NU2310.disc((k, &place), &upright, None, 0.0, 5e-3);
                assert!((found.delta - expected).abs() < 1e-19, "{found:?} {expected}");
            }
        }
    }
}
