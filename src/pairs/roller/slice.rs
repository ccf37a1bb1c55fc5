//! A slice of the contact of a roller that skews and tilts with a raceway: how its surfaces move, and the levers of its forces.
//!
//! ```text
//! disc at s as in `pairs/raceway/disc`;   k = 1 on the outer raceway, -1 on the inner one
//! X   = C + R m,   m = (N - G u)/c                                contact point on the rim, the same for both bodies
//! t   = k e_t,   a = N x t                                        along the raceway, and across that on it; a is b of cylinders
//! dv  = v_roller(X) - v_ring(X) - (d_mid - d_X) W x e_n,   d_X = d + R m . e_n,   d_mid of s = 0, changed as the cone of the raceway does
//! u_1 = R (w x m) . t - k R (m . e_n) phi',   u_2 = u_1 - dv . t,   phi' = e_t . (V_C - V_O - W x t b)/d
//! F_R on both at X, along t;   against it 2 F_R a_2/(a_1 + a_2) on the roller at C, the rest on the ring;   a_1 = R,   a_1 + a_2 = -d/(m . e_n)
//! ```
//!
//! Surface speeds of elastic bodies of like material follow their undeformed radii, so all slices see the ring with the arm of the one in the
//! middle: along the length only true differences of radius make slip. The depth of each slice instead would turn a tilted roller. The four levers of
//! rolling resistance are on one line: forces and moments cancel. Source: K. L. Johnson, Contact Mechanics, of creep; the rest is geometry.

use super::{MovingRoller, Spot, UnitWrench};
use crate::bodies::MovingRing;
use crate::laws::elastic::surface::Drops;
use crate::pairs::groove::RingPlace;
use crate::pairs::raceway::{Disc, RacewayGeometry};
use crate::scalar::{Numeric, Real};
use crate::space::solid::{Moving, cross, difference, dot, scaled, sum};

/// A roller beside the raceway of one ring.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OnRaceway<'a, T, P> {
    pub(crate) geometry: &'a RacewayGeometry,
    pub(crate) profile: P,
    /// 0 outer, 1 inner.
    pub(crate) side: usize,
    pub(crate) ring: MovingRing<T>,
    pub(crate) roller: MovingRoller<T>,
    /// How much larger than nominal the radius of the roller is, m.
    pub(crate) excess: f64,
}

/// What all slices of a contact share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Middle<T> {
    /// d_mid + the drop of the raceway in the middle with its sign, less what the cone of the raceway grows by up to there, m.
    arm: T,
    /// Motion of the roller against the ring, both taken at the centre of the roller.
    pub(crate) passing: Moving<T>,
}

impl<T: Numeric> Middle<T> {
    /// The same of what `f` makes of every number.
    #[inline(always)]
    pub(crate) fn map<U>(self, f: impl Fn(T) -> U + Copy) -> Middle<U> {
        Middle { arm: f(self.arm), passing: self.passing.map(f) }
    }
}

impl<'a, T: Numeric, P: Drops<T>> OnRaceway<'a, T, P> {
    /// The same of what `f` makes of every number, and these drops.
    #[inline(always)]
    pub(crate) fn map<U, Q>(self, profile: Q, f: impl Fn(T) -> U + Copy) -> OnRaceway<'a, U, Q> {
        let Self { geometry, side, ring, roller, excess, .. } = self;
        OnRaceway { geometry, profile, side, ring: ring.map(f), roller: roller.map(f), excess }
    }

    #[inline(always)]
    fn sign(&self) -> f64 {
        if self.side == 0 { 1.0 } else { -1.0 }
    }

    #[inline(always)]
    fn place_of_ring(&self) -> RingPlace<T> {
        RingPlace { centre: self.ring.centre, axis: self.ring.axis }
    }

    /// The disc at `s`, m, with these drops.
    pub(crate) fn disc(&self, profile: P, s: T) -> Disc<T> {
        self.geometry.disc((self.side, &self.place_of_ring()), &self.roller.place, profile, self.excess, s)
    }

    /// The same for the instructions of the caller.
    #[inline(always)]
    pub(crate) fn disc_in_line(&self, profile: impl Drops<T>, s: T) -> Disc<T> {
        let ring = (self.side, &self.place_of_ring());
        self.geometry.disc_in_line(ring, &self.roller.place, profile, self.excess, s)
    }

    /// Whether no disc within `half_length` (m) of the middle can touch, by the straight disc in the middle.
    #[inline(always)]
    pub(crate) fn apart(&self, middle: &Disc<T>, half_length: f64) -> bool
    where
        T: Real,
    {
        let cones = &self.geometry.cones;
        let [of_roller, of_ring] = [
            difference(self.roller.place.axis.map(T::value), cones.inclination.turned([1.0, 0.0, 0.0])),
            difference(self.ring.axis.map(T::value), [1.0, 0.0, 0.0]),
        ];
        let size = |v: [f64; 3]| dot(v, v).sqrt();
        // The distance across the raceway changes along the roller by the sine of the angle between roller and ring, as far as they have left
        // their inclination, at most.
        let apart = size(difference(of_roller, of_ring));
        let slope = 1.01 * (apart + cones.inclination.sin.abs() * (size(of_roller) + size(of_ring)));
        middle.delta.value() + slope * (half_length + self.geometry.roller_radius * slope) < 0.0
    }

    /// What its slices share, by the straight disc in the middle.
    pub(crate) fn middle(&self, disc: &Disc<T>) -> Middle<T> {
        let k = self.sign();
        let Self { ring, roller, side, .. } = self;
        let geometry = self.geometry;
        let m = disc.rim_direction(roller.place.axis);
        let radius = geometry.roller_radius + self.excess;
        let mut arm = disc.distance + dot(m, disc.outward) * radius
            - (disc.along + dot(m, ring.axis) * radius) * geometry.cones.slopes[*side];
        let [drop, _] = self.profile.of_raceway(disc.in_raceway);
        arm += drop * k;
        let place = roller.place;
        let [cx, cr, ct] = ring.centre;
        let from_ring = [place.x - cx, place.rho + geometry.pitch_radius - cr, -ct];
        let of_ring = sum(ring.moving.velocity, cross(ring.moving.turning, from_ring));
        let passing = Moving {
            velocity: difference(roller.moving.velocity, of_ring),
            turning: difference(roller.moving.turning, ring.moving.turning),
        };
        Middle { arm, passing }
    }

    /// The slice at `s` (m), whose disc is this.
    #[inline(always)]
    pub(crate) fn spot(&self, middle: &Middle<T>, s: T, disc: Disc<T>) -> Spot<T> {
        let k = self.sign();
        let Self { ring, roller, .. } = self;
        let Middle { arm, passing } = middle;
        let Disc { normal, on_roller, outward, tangent, distance, radius, .. } = disc;
        let (u, b) = (roller.place.axis, ring.axis);
        let one = s.like(1.0);
        let direction = disc.rim_direction(u);
        let upright = dot(direction, outward);
        let to_centre = scaled(u, s);
        let lever = sum(to_centre, scaled(direction, radius));
        let t = scaled(tangent, one.like(k));
        let axial = cross(disc.facing, t);
        let unit: UnitWrench<T> = [scaled(normal, one.like(-1.0)), on_roller];
        let along = [t, cross(lever, t)];
        let across = [axial, cross(lever, axial)];
        let delta_dot = -passing.power(unit);
        let reach = distance + radius * upright;
        let grown = (disc.along + radius * dot(direction, b)) * self.geometry.cones.slopes[self.side];
        let deeper = *arm + grown - reach - disc.raceway_drop * k;
        let mut moving = sum(passing.velocity, cross(passing.turning, lever));
        moving = difference(moving, scaled(cross(ring.moving.turning, outward), deeper));
        let slip = [dot(moving, t), dot(moving, axial)];
        // The place of contact goes round with the centre of the disc.
        let of_disc = sum(roller.moving.velocity, cross(roller.moving.turning, to_centre));
        let by_ring = sum(ring.moving.velocity, cross(ring.moving.turning, scaled(b, disc.along)));
        let turning = dot(tangent, difference(of_disc, by_ring)) / distance;
        let rolled = dot(cross(roller.moving.turning, direction), t);
        let u1 = radius * (rolled - upright * turning * k);
        let u2 = u1 - slip[0];
        // 2 a_2/(a_1 + a_2).
        let back = radius * upright / distance * 2.0 + 2.0;
        let held = -back + 1.0;
        let rolling = [scaled(t, held), difference(cross(lever, t), scaled(cross(to_centre, t), back))];
        Spot {
            delta: disc.delta,
            delta_dot,
            surface_speeds: [u1, u2],
            entrainment: (u1 + u2) * 0.5,
            slip,
            normal: unit,
            along,
            across,
            rolling,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::{ElementMotion, RingState, RollerState};
    use crate::laws::elastic::profile::{Logarithm, Profile};
    use crate::laws::elastic::surface::{Straight, Surface};
    use crate::pairs::raceway::{Cones, RingMotion};
    use crate::scene::RollerTaper;

    const NU2310: RacewayGeometry =
        RacewayGeometry { pitch_radius: 39.99e-3, roller_radius: 7.5e-3, gap: 10e-6, cones: Cones::NONE };

    /// The same with tapered rollers.
    fn tapered() -> RacewayGeometry {
        let taper = RollerTaper { half_angle: 0.07, outer_raceway_angle: 0.3 };
        RacewayGeometry { cones: Cones::new(Some(&taper)), ..NU2310 }
    }

    fn profile() -> Surface {
        let logarithm = Logarithm::new(1.5e-6, 0.0204, 0.6, Some(12e-6));
        Surface::new(Profile::new(0.0204, Some(logarithm), [None, Some(2.0)], 8).unwrap())
    }

    /// Place and angles of a roller, then of the ring; rates in the same order. All at the azimuth zero.
    struct Pose {
        roller: [f64; 5],
        ring: [f64; 5],
        roller_rates: [f64; 6],
        ring_rates: [f64; 5],
        spin: f64,
    }

    const POSE: Pose = Pose {
        roller: [2e-5, 5e-6, 0.0, 5e-3, -4e-3],
        ring: [1e-5, -2e-5, 1e-5, 3e-3, -5e-3],
        roller_rates: [0.3, -0.02, 127.0, 4.0, -3.0, 800.0],
        ring_rates: [0.1, 0.2, -0.1, 2.0, 5.0],
        spin: -314.0,
    };

    impl Pose {
        /// After the time `h`, s, seen in the axes of the roller's azimuth.
        fn at(&self, bearing: &RacewayGeometry, h: f64) -> (MovingRing<f64>, MovingRoller<f64>) {
            let psi = h * self.roller_rates[2];
            let (sin, cos) = psi.sin_cos();
            let place = |k: usize| self.roller[k] + h * self.roller_rates[k];
            let base = (39.99e-3, bearing.cones.inclination);
            let state = RollerState::new(base, [place(0), place(1)], [place(3), place(4)], self.roller_rates);
            let position = std::array::from_fn(|k| self.ring[k] + h * self.ring_rates[k]);
            let ring = RingState { position, rate: self.ring_rates, given: [0.0; 5], speed: self.spin };
            let ring = ring.motion();
            let local = |[x, y, z]: [f64; 3]| [x, cos * y + sin * z, cos * z - sin * y];
            let ring = MovingRing {
                centre: local(ring.centre),
                axis: local(ring.axis),
                moving: Moving { velocity: local(ring.moving.velocity), turning: local(ring.moving.turning) },
                speed: ring.speed,
            };
            (ring, state.motion())
        }
    }

    #[test]
    fn the_approach_speed_is_the_rate_of_the_approach() {
        let profile = profile();
        for (geometry, side) in [NU2310, tapered()].iter().flat_map(|of| [(of, 0), (of, 1)]) {
            for s in [-9e-3, -2e-3, 0.0, 7e-3] {
                let on = |h: f64| {
                    let (ring, roller) = POSE.at(geometry, h);
                    OnRaceway { geometry, profile: Some(&profile), side, ring, roller, excess: 2e-7 }
                };
                let h = 1e-7;
                let delta = |h: f64| on(h).disc(Some(&profile), s).delta;
                let rate = (delta(h) - delta(-h)) / (2.0 * h);
                let now = on(0.0);
                let spot = now.spot(&now.middle(&now.disc(None, 0.0)), s, now.disc(Some(&profile), s));
                assert!((spot.delta_dot - rate).abs() < 2e-9, "{side} {s}: {} {rate}", spot.delta_dot);
            }
        }
    }

    #[test]
    fn rolling_resistance_has_the_power_of_both_surfaces() {
        // No force is left over: what acts on the ring is the opposite of what acts on the roller.
        for (geometry, side) in [NU2310, tapered()].iter().flat_map(|of| [(of, 0), (of, 1)]) {
            let (ring, roller) = POSE.at(geometry, 0.0);
            let on = OnRaceway { geometry, profile: Straight, side, ring, roller, excess: 0.0 };
            let middle = on.middle(&on.disc(Straight, 0.0));
            let spot = on.spot(&middle, 3e-3, on.disc(Straight, 3e-3));
            let power = middle.passing.power(spot.rolling);
            let [u1, u2] = spot.surface_speeds;
            assert!((power - (u1 + u2)).abs() < 0.02 * (u1 + u2).abs(), "{side} {power} {}", u1 + u2);
        }
    }

    #[test]
    fn without_angles_it_is_the_contact_in_the_plane() {
        let still = Pose {
            roller: [0.0, 5e-6, 0.0, 0.0, 0.0],
            ring: [0.0, -2e-5, 1e-5, 0.0, 0.0],
            roller_rates: [0.0, -0.02, 127.0, 0.0, 0.0, 800.0],
            ring_rates: [0.0, 0.2, -0.1, 0.0, 0.0],
            ..POSE
        };
        let (ring, roller) = still.at(&NU2310, 0.0);
        let plane = ElementMotion {
            radial_offset: 5e-6,
            radial_speed: -0.02,
            orbit_speed: 127.0,
            spin_speed: 800.0,
            ..ElementMotion::default()
        };
        let inner = RingMotion { position: [-2e-5, 1e-5], velocity: [0.2, -0.1], speed: -314.0 };
        let outer_ring = MovingRing {
            centre: [0.0; 3],
            axis: [1.0, 0.0, 0.0],
            moving: Moving { velocity: [0.0; 3], turning: [20.0, 0.0, 0.0] },
            speed: 20.0,
        };
        let contacts = [NU2310.outer(&plane, 20.0), NU2310.inner(&plane, &inner)];
        for (side, ring) in [outer_ring, ring].into_iter().enumerate() {
            let on = OnRaceway { geometry: &NU2310, profile: Straight, side, ring, roller, excess: 0.0 };
            let spot = on.spot(&on.middle(&on.disc(Straight, 0.0)), 4e-3, on.disc(Straight, 4e-3));
            let (motion, grip) = &contacts[side];
            assert!((spot.delta - motion.delta).abs() < 1e-19);
            assert!((spot.delta_dot - motion.delta_dot).abs() < 1e-15);
            assert!((spot.surface_speeds[0] - motion.u1).abs() < 1e-14);
            // The planar arm of the ring lacks nothing but the approach.
            assert!((spot.surface_speeds[1] - motion.u2).abs() < 1e-12, "{spot:?} {motion:?}");
            let tangent = grip.tangent();
            assert!((spot.along[0][1] - tangent[0]).abs() < 1e-15);
            assert!((spot.along[0][2] - tangent[1]).abs() < 1e-15);
            assert_eq!(spot.slip[1], 0.0);
        }
    }
}
