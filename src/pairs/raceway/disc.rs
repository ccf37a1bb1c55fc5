//! A disc of a roller that shifts, skews and tilts against a raceway whose ring does so too.
//!
//! ```text
//! C = P + s u,   q = C - O,   t = q . b,   p = q - t b,   d = |p|,   e_n = p/d,   e_t = b x e_n
//! N = k (cos(alpha) e_n - sin(alpha) b),   G = N . u,   h = e_t . u,   c = sqrt(1 - G^2),   R = R_b + s tan(beta) + dR - p(s)
//! delta = k cos(alpha) (rho + (d - r_0)) - k sin(alpha) (t - s cos(gamma)) - R (cos(beta) - c)'
//!         + cos(beta) (dR - p(s)) - cos(alpha) g_0 - p_r(t),   (cos(beta) - c)' = (G^2 - sin^2(beta))/(c + cos(beta)),   r_0 = r + s sin(gamma)
//! n     = d(delta)/dC = N - k cos(alpha) R (G h/(c d)) e_t - p_r'(t) b
//! on the roller for Q = 1:   force -n,   moment about P  -s u x n + R (G/c) (u x N)
//! ```
//!
//! P is the centre of the roller and u its axis, O the centre of the ring and b its axis, all in the axes of the azimuth; k is 1 on the outer
//! raceway and -1 on the inner one; angles of cones as in `cones`, zero of cylinders. R (1 - c) is how much less far the rim of a tilted disc reaches: 94 nm
//! at 5 mrad of one of 7.5 mm. Force and moment are the gradient of delta, so that they turn neither body about its own axis and their work is that of the
//! approach. d - r_0 is a sum of small numbers. Valid for tilts up to those of `space/solid`. Source: geometry; the gradient is exact.

use super::{Cones, RacewayGeometry};
use crate::bodies::RollerPlace;
use crate::laws::elastic::surface::Drops;
use crate::pairs::groove::RingPlace;
use crate::scalar::Numeric;
use crate::space::solid::{Vector, cross, difference, dot, mapped, scaled, sum};

/// A disc against a raceway.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Disc<T> {
    /// m.
    pub(crate) delta: T,
    /// n: the unit force on the ring, which acts through the roller's with the opposite sign.
    pub(crate) normal: Vector<T>,
    /// Moment on the roller about its centre for a unit force, m.
    pub(crate) on_roller: Vector<T>,
    /// t, m: place along the axis of the ring, and that along the raceway.
    pub(crate) along: T,
    pub(crate) in_raceway: T,
    /// Drop of the raceway there, m.
    pub(crate) raceway_drop: T,
    /// N, e_n and e_t.
    pub(crate) facing: Vector<T>,
    pub(crate) outward: Vector<T>,
    pub(crate) tangent: Vector<T>,
    /// d, R, G and c.
    pub(crate) distance: T,
    pub(crate) radius: T,
    lean: T,
    cosine: T,
}

impl<T: Numeric> Disc<T> {
    /// The same of what `f` makes of every number.
    #[inline(always)]
    pub(crate) fn map<U>(self, f: impl Fn(T) -> U + Copy) -> Disc<U> {
        let vector = |v: Vector<T>| mapped(v, f);
        Disc {
            delta: f(self.delta),
            normal: vector(self.normal),
            on_roller: vector(self.on_roller),
            along: f(self.along),
            in_raceway: f(self.in_raceway),
            raceway_drop: f(self.raceway_drop),
            facing: vector(self.facing),
            outward: vector(self.outward),
            tangent: vector(self.tangent),
            distance: f(self.distance),
            radius: f(self.radius),
            lean: f(self.lean),
            cosine: f(self.cosine),
        }
    }

    /// m: from the centre of the disc towards the place of its rim that touches, with the axis `u` of the roller.
    #[inline(always)]
    pub(crate) fn rim_direction(&self, u: Vector<T>) -> Vector<T> {
        scaled(difference(self.facing, scaled(u, self.lean)), self.lean.like(1.0) / self.cosine)
    }
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

impl<T: Numeric> OffAxis<T> {
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
    /// ring. Once in the library for each kind of numbers: it is long.
    #[inline(never)]
    pub(crate) fn disc<T: Numeric>(
        &self,
        ring: (usize, &RingPlace<T>),
        roller: &RollerPlace<T>,
        profile: impl Drops<T>,
        excess: f64,
        s: T,
    ) -> Disc<T> {
        self.disc_in_line(ring, roller, profile, excess, s)
    }

    /// The same, for the instructions of the caller.
    #[inline(always)]
    pub(crate) fn disc_in_line<T: Numeric>(
        &self,
        ring: (usize, &RingPlace<T>),
        roller: &RollerPlace<T>,
        profile: impl Drops<T>,
        excess: f64,
        s: T,
    ) -> Disc<T> {
        let (k, RingPlace { centre, axis: b }) = (if ring.0 == 0 { 1.0 } else { -1.0 }, *ring.1);
        let Cones { inclination: gamma, roller: beta, growth, raceways, .. } = &self.cones;
        let alpha = raceways[ring.0];
        let (u, one) = (roller.axis, roller.rho.like(1.0));
        let base = roller.rho + self.pitch_radius + s * gamma.sin;
        let place =
            [roller.x + u[0] * s - centre[0], (u[1] - gamma.sin) * s - centre[1], u[2] * s - centre[2]];
        let OffAxis { along: t, square, distance: d, outward, tangent } = OffAxis::new(base, place, b);
        let facing = difference(scaled(outward, one.like(k * alpha.cos)), scaled(b, one.like(k * alpha.sin)));
        let (g, h) = (dot(facing, u), dot(tangent, u));
        let c = (one - g * g).sqrt();
        let drop = profile.of_roller(s);
        let in_raceway = t * self.cones.stretch();
        let [raceway, slope] = profile.of_raceway(in_raceway);
        let larger = one.like(excess) - drop;
        let radius = larger + s * *growth + self.roller_radius;
        let delta = (roller.rho + square / (d + base)) * (k * alpha.cos)
            - (t - s * gamma.cos) * (k * alpha.sin)
            - self.gap * alpha.cos
            + larger * beta.cos
            - radius * (g - beta.sin) * (g + beta.sin) / (c + beta.cos)
            - raceway;
        let turned = scaled(tangent, radius * g * h * (k * alpha.cos) / (c * d));
        let n = difference(difference(facing, turned), scaled(b, slope * self.cones.stretch()));
        let lever = scaled(cross(u, n), -s);
        let on_roller = sum(lever, scaled(cross(u, facing), radius * g / c));
        Disc {
            delta,
            normal: n,
            on_roller,
            along: t,
            in_raceway,
            raceway_drop: raceway,
            facing,
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
    use crate::bodies::{ElementMotion, Inclination, RollerState};
    use crate::laws::elastic::profile::{Logarithm, Profile};
    use crate::laws::elastic::surface::Surface;
    use crate::pairs::raceway::RingMotion;
    use crate::scalar::{Dual, Of};
    use crate::scene::RollerTaper;
    use crate::space::solid::Tilt;

    const NU2310: RacewayGeometry =
        RacewayGeometry { pitch_radius: 39.99e-3, roller_radius: 7.5e-3, gap: 10e-6, cones: Cones::NONE };

    /// The same, and one with tapered rollers.
    fn bearings() -> [RacewayGeometry; 2] {
        let taper = RollerTaper { half_angle: 0.07, outer_raceway_angle: 0.3 };
        [NU2310, RacewayGeometry { cones: Cones::new(Some(&taper)), ..NU2310 }]
    }

    fn profile() -> Surface {
        let logarithm = Logarithm::new(1.5e-6, 0.0204, 0.6, Some(12e-6));
        Surface::new(Profile::new(0.0204, Some(logarithm), [None, Some(2.0)], 8).unwrap())
    }

    /// Coordinates: x, rho, skew and tilt of the roller; x, r, psi and two angles of the ring.
    fn disc<T: Of<f64>>(bearing: &RacewayGeometry, ring: usize, q: [T; 9], s: f64) -> Disc<T> {
        let axis = bearing.cones.inclination.turned(Tilt::new([q[2], q[3]]).axis);
        let roller = RollerPlace { x: q[0], rho: q[1], axis };
        let place = RingPlace { centre: [q[4], q[5], q[6]], axis: Tilt::new([q[7], q[8]]).axis };
        bearing.disc((ring, &place), &roller, Some(&profile()), 0.3e-6, q[0].like(s))
    }

    const STATES: [[f64; 9]; 3] = [
        [2e-5, 5e-6, 5e-3, -4e-3, 1e-5, -2e-5, 1e-5, 3e-3, -5e-3],
        [-1e-4, -8e-6, 0.05, 0.03, 3e-5, 1e-5, -2e-5, -0.02, 0.04],
        [0.0, 1e-6, 0.0, 1e-3, 0.0, 0.0, 0.0, 0.0, 2e-3],
    ];

    fn cases() -> impl Iterator<Item = (RacewayGeometry, usize, [f64; 9])> {
        let of = |bearing| [0, 1].into_iter().flat_map(move |ring| STATES.map(|q| (bearing, ring, q)));
        bearings().into_iter().flat_map(of)
    }

    #[test]
    fn forces_are_the_gradient_of_the_approach() {
        for (bearing, ring, q) in cases() {
            for s in [-9.7e-3, -3e-3, 0.0, 8e-3] {
                let sloped = disc(&bearing, ring, std::array::from_fn(|k| Dual::<9>::variable(q[k], k)), s);
                let Disc { normal, on_roller, .. } = disc(&bearing, ring, q, s);
                // Power of the unit wrench over the coordinates.
                let state =
                    RollerState::new((0.0, bearing.cones.inclination), [0.0; 2], [q[2], q[3]], [0.0; 6]);
                let [.., skew, tilt, _] = state.over_speeds([[0.0; 3], on_roller], 0.0);
                let over_angles = [skew, tilt];
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
                let allowed = if bearing.cones == Cones::NONE { 1e-16 } else { 2e-16 };
                assert!(
                    dot(on_roller, state.axis).abs() < allowed && dot(moment, of_ring.axis).abs() < 1e-15
                );
            }
        }
    }

    #[test]
    fn the_approach_is_that_of_the_rim() {
        // The point of the rim that reaches furthest, by brute force around the disc.
        for (bearing, ring, q) in cases() {
            for s in [-9.7e-3, 0.0, 8e-3] {
                let Cones { inclination, growth, raceways, .. } = bearing.cones;
                let (tilt, b) = (Tilt::new([q[2], q[3]]), Tilt::new([q[7], q[8]]).axis);
                let profile = profile();
                let axis = inclination.turned(tilt.axis);
                // A drop lies across the cone.
                let radius = bearing.roller_radius + growth * s + 0.3e-6 - profile.of_roller(s);
                let centre = [
                    q[0] + s * axis[0] - q[4],
                    bearing.pitch_radius + q[1] + s * axis[1] - q[5],
                    s * axis[2] - q[6],
                ];
                let side = if ring == 0 { 1.0 } else { -1.0 };
                // How far a place of the rim is beyond the cone, across it.
                let beyond = |angle: f64| {
                    let rim =
                        inclination.turned(tilt.turned([0.0, radius * angle.cos(), radius * angle.sin()]));
                    let at = sum(centre, rim);
                    let t = dot(at, b);
                    let across = difference(at, scaled(b, t));
                    let Inclination { sin, cos } = raceways[ring];
                    let middle = bearing.pitch_radius + side * bearing.roller_radius * inclination.cos;
                    let at_middle = -side * bearing.roller_radius * inclination.sin;
                    side * (cos * (dot(across, across).sqrt() - middle) - sin * (t - at_middle))
                };
                let middle = if ring == 0 { 0.0 } else { std::f64::consts::PI };
                let (mut best, mut width) = (middle, 0.3);
                for _ in 0..60 {
                    let candidates = (-10..=10).map(|i| best + width * f64::from(i) / 10.0);
                    best = candidates.max_by(|x, y| beyond(*x).total_cmp(&beyond(*y))).unwrap();
                    width *= 0.5;
                }
                let found = disc(&bearing, ring, q, s);
                let [drop, _] = profile.of_raceway(found.in_raceway);
                let reach = beyond(best) - drop - bearing.gap * raceways[ring].cos;
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
