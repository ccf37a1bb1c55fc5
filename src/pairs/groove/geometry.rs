//! A ball in the groove of a raceway: gap, normal and levers, for both rings by the same formulas.
//!
//! ```text
//! ring at O with the axis a, ball at P, both in axes (x, outwards, ahead) of the ball's azimuth;  d = P - O
//! xi    = d . a                                  place of the ball along the axis of the ring
//! s2    = |d - xi a|^2 - r_p^2,   vr = sqrt(r_p^2 + s2)      distance from the axis
//! v     = v0 + (xi, vr - r_p)                    from the centre of the groove's arc to the ball, in the plane of the axis
//! delta = |v| - L = (|v0|^2 - L^2 + 2 v0 . (xi, vr - r_p) + xi^2 + (vr - r_p)^2)/(|v| + L),   L = r_g - R
//! n     = v/|v|                                  from the ball to the contact, on both rings
//! t     = a x e_rho,   l = n x t                 along the race, across it; (t, l, n) right-handed
//! ```
//!
//! |v0| - L is a small number of its own, zero of an angular contact bearing that just touches, so that no difference of radii is
//! taken: gaps are good to 1e-19 m. Valid while the ball stays far from the centre of the arc. Source: geometry.

use crate::scalar::{Base, Of, math};
use crate::space::solid::{Vector, cross, difference, dot, scaled, sum};

/// Which ring a groove is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Outer,
    Inner,
}

/// How the grooves of both rings lie to each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Fit {
    /// Balls just touch both grooves at this angle, rad.
    ContactAngle(f64),
    /// Diametral clearance of an undisplaced deep groove bearing, m.
    RadialClearance(f64),
}

/// A groove around the axis of a ring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Groove<B = f64> {
    /// r_p, m.
    pub(crate) pitch_radius: B,
    /// R of a ball without deviation, m.
    pub(crate) ball_radius: B,
    /// r_g, m.
    pub(crate) radius: B,
    /// v0 along the axis and outwards, m.
    centre: [B; 2],
    /// |v0| - L of a ball without deviation, m.
    excess: B,
}

/// Place of a ring beside a ball, in the axes of the ball's azimuth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RingPlace<T> {
    /// O, m.
    pub(crate) centre: Vector<T>,
    /// a.
    pub(crate) axis: Vector<T>,
}

/// A ball beside a groove.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Touch<T> {
    /// delta, m; negative where they are apart.
    pub(crate) delta: T,
    /// t, l and n.
    pub(crate) along: Vector<T>,
    pub(crate) across: Vector<T>,
    pub(crate) normal: Vector<T>,
    /// n along the axis of the ring and outwards from it.
    pub(crate) in_meridian: [T; 2],
    /// d, m.
    pub(crate) from_ring: Vector<T>,
    /// Distance of ball and contact from the axis of the ring, m.
    pub(crate) ball_distance: T,
    pub(crate) contact_distance: T,
    /// Slope of a wave along the path of the ball's centre, m per m; `None` on a round race.
    pub(crate) slope: Option<T>,
}

impl Groove {
    /// That of one ring for balls of radius `ball_radius` on a circle of `pitch_radius`; `radius` is that of its arc, m.
    pub(crate) fn new(side: Side, pitch_radius: f64, ball_radius: f64, radius: f64, fit: Fit) -> Self {
        let length = radius - ball_radius;
        let (angle, excess) = match fit {
            Fit::ContactAngle(angle) => (angle, 0.0),
            Fit::RadialClearance(clearance) => (0.0, -0.25 * clearance),
        };
        let outwards = match side {
            Side::Outer => length + excess,
            Side::Inner => -(length + excess),
        };
        let (sin, cos) = math::sin_cos(angle);
        Self { pitch_radius, ball_radius, radius, centre: [outwards * sin, outwards * cos], excess }
    }

    /// L of a ball without deviation, m: distance of the centres of ball and arc where they just touch.
    pub(crate) fn length(&self) -> f64 {
        self.radius - self.ball_radius
    }

    /// v0, m.
    pub(crate) fn centre(&self) -> [f64; 2] {
        self.centre
    }
}

impl<B> Groove<B> {
    /// The same with every number replaced.
    #[inline(always)]
    pub(crate) fn map<U>(&self, f: &mut impl FnMut(&B) -> U) -> Groove<U> {
        let [along, outwards] = &self.centre;
        Groove {
            pitch_radius: f(&self.pitch_radius),
            ball_radius: f(&self.ball_radius),
            radius: f(&self.radius),
            centre: [f(along), f(outwards)],
            excess: f(&self.excess),
        }
    }
}

impl<B: Base> Groove<B> {
    /// A ball at (x, rho), m, from the middle of the bearing and the pitch circle, whose radius is larger by `deviation` (m).
    #[inline(always)]
    pub(crate) fn touch<T: Of<B>>(&self, [x, rho]: [T; 2], deviation: B, ring: &RingPlace<T>) -> Touch<T> {
        let ([ox, outwards, ahead], axis) = (ring.centre, ring.axis);
        let from_ring = [x - ox, rho - outwards + self.pitch_radius, -ahead];
        let xi = dot(from_ring, axis);
        // |d|^2 - r_p^2 - xi^2 without large numbers.
        let dx = x - ox;
        let square = rho * (rho + self.pitch_radius * 2.0) + dx * dx
            - (rho + self.pitch_radius) * outwards * 2.0
            + outwards * outwards
            + ahead * ahead
            - xi * xi;
        let ball_distance = (square + self.pitch_radius * self.pitch_radius).sqrt();
        let off_pitch = square / (ball_distance + self.pitch_radius);
        let [along_0, outwards_0] = self.centre;
        let v = [xi + along_0, off_pitch + outwards_0];
        let size = (v[0] * v[0] + v[1] * v[1]).sqrt();
        let nominal = self.radius - self.ball_radius;
        let length = nominal - deviation;
        let own = (self.excess + deviation) * (nominal * 2.0 + self.excess - deviation);
        let delta = ((xi * along_0 + off_pitch * outwards_0) * 2.0 + xi * xi + off_pitch * off_pitch + own)
            / (size + length);
        let in_meridian = [v[0] / size, v[1] / size];
        let one = delta.like(1.0);
        let outward = scaled(difference(from_ring, scaled(axis, xi)), one / ball_distance);
        let normal = sum(scaled(axis, in_meridian[0]), scaled(outward, in_meridian[1]));
        let along = cross(axis, outward);
        Touch {
            delta,
            along,
            across: cross(normal, along),
            normal,
            in_meridian,
            from_ring,
            ball_distance,
            contact_distance: in_meridian[1] * (self.ball_radius + deviation) + ball_distance,
            slope: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Dual;
    use crate::space::solid::Tilt;

    /// Angular contact bearing 218 of Harris' textbook.
    fn groove_of_218(side: Side) -> Groove {
        let ball = 0.011115;
        Groove::new(side, 0.06263, ball, 0.5232 * 2.0 * ball, Fit::ContactAngle(0.698_131_700_797_731_8))
    }

    fn ring(centre: [f64; 3], tilt: [f64; 2]) -> RingPlace<f64> {
        RingPlace { centre, axis: Tilt::new(tilt).axis }
    }

    /// Gaps by the plain difference of lengths in 50 digits.
    #[test]
    fn gaps_have_all_their_digits() {
        let places = [
            ([1.3e-5, -4e-6], 0.0, [0.0; 3], [0.0; 2]),
            ([1.3e-5, -4e-6], 2e-7, [3.61e-5, 0.0, 0.0], [0.0; 2]),
            ([2.1e-5, 7e-6], -1e-7, [1.4e-5, 3.2e-5, -1.59e-4], [2.86e-3, -4.8e-4]),
            ([-3e-6, 1.2e-5], 0.0, [-2e-5, -1e-4, 5e-5], [0.02, 0.011]),
        ];
        let outer = [
            5.442_697_375_545_51e-6,
            -1.748_287_463_308_977e-5,
            -3.420_390_443_862_974e-5,
            6.392_072_335_795_01e-4,
        ];
        let inner = [
            -5.138_302_400_481_292e-6,
            1.832_685_477_101_026_6e-5,
            3.401_219_674_644_364e-5,
            -4.222_036_290_935_572e-5,
        ];
        for (side, expected) in [(Side::Outer, outer), (Side::Inner, inner)] {
            let groove = groove_of_218(side);
            for ((at, deviation, centre, tilt), expected) in places.into_iter().zip(expected) {
                let found = groove.touch(at, deviation, &ring(centre, tilt)).delta;
                let allowed = 1e-19 + 4e-16 * f64::abs(expected);
                assert!((found - expected).abs() < allowed, "{side:?}: {found:e} {expected:e}");
            }
        }
    }

    #[test]
    fn gaps_of_a_deep_groove_have_all_their_digits() {
        let (ball, clearance) = (0.0047625, 1.5e-5);
        let groove = |side, radius| Groove::new(side, 0.023, ball, radius, Fit::RadialClearance(clearance));
        let both = [groove(Side::Outer, 0.525 * 0.009525), groove(Side::Inner, 0.515 * 0.009525)];
        let centred = ([1e-6, 5e-6], 0.0, [0.0; 3], [0.0; 2]);
        let off = ([4e-6, -2e-6], 1e-7, [-9e-6, -2.2e-5, 4e-6], [1e-3, -7e-4]);
        let expected = [
            [1.252_088_763_732_775_5e-6, 1.637_281_873_685_191e-5],
            [-8.746_272_186_007_818e-6, -2.361_321_720_076_752e-5],
        ];
        for (groove, expected) in both.into_iter().zip(expected) {
            for ((at, deviation, centre, tilt), expected) in [centred, off].into_iter().zip(expected) {
                let found = groove.touch(at, deviation, &ring(centre, tilt)).delta;
                assert!((found - expected).abs() < 1e-19, "{found:e} {expected:e}");
            }
        }
    }

    #[test]
    fn the_normal_is_the_gradient_of_the_gap() {
        for side in [Side::Outer, Side::Inner] {
            let groove = groove_of_218(side);
            let [x, rho, ox, or, op, a, b] = std::array::from_fn(|k| {
                let at = [2e-5, -7e-6, 1e-5, 3e-5, -1.2e-4, 3e-3, -2e-3];
                Dual::<7>::variable(at[k], k)
            });
            let tilt = Tilt::new([a, b]);
            let touch = groove.touch([x, rho], 1e-7, &RingPlace { centre: [ox, or, op], axis: tilt.axis });
            let slope = touch.delta.eps;
            let n = touch.normal.map(|n| n.re);
            let moments = cross(touch.from_ring.map(|d| d.re), n);
            let over_angles = Tilt::new([a.re, b.re]).moments_over_angles(moments);
            let expected = [n[0], n[1], -n[0], -n[1], -n[2], -over_angles[0], -over_angles[1]];
            for (slope, expected) in slope.into_iter().zip(expected) {
                assert!((slope - expected).abs() < 1e-14, "{side:?}: {slope} {expected}");
            }
            // Right-handed, of length one.
            let [t, l] = [touch.along, touch.across].map(|v| v.map(|x| x.re));
            let back = cross(t, l);
            assert!(back.iter().zip(n).all(|(x, y)| (x - y).abs() < 1e-15), "{back:?} {n:?}");
            assert!((dot(t, t) - 1.0).abs() < 1e-15);
        }
    }
}
