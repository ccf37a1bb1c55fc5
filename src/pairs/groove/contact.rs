//! How ball and ring move past each other in a contact, and what its forces do to both.
//!
//! ```text
//! w_t  = w_ring - (w_ring . a) a,   phi' = (v_ball - v_ring - w_t x d) . t/vr        turning of the contact about the axis of the ring
//! u1   = R (w_ball - w_t - phi' a) . l,   u2 = (Omega - phi') rho_c                   surface speeds past the contact
//! D_t  = u1 - u2,   D_l = (v_ball + w_ball x R n - v_ring - w_ring x c) . l,   c = d + R n
//! w    = w_ball - w_ring along t, l, n;   delta' = n . (v_ball - v_ring - w_ring x c)
//! F    = F_t t + F_l l - Q n on the ball at the contact, with the couple M; the opposite on the ring
//! F_R  on both surfaces; the film pressure -2 F_R/(1 + R k) t through the centre of the ball and -2 F_R R k/(1 + R k) t through the axis
//!      of the ring, k = -n_rho/rho_c, so that forces and moments cancel
//! ```
//!
//! All vectors are in the axes of the ball's azimuth. Source: kinematics; the film pressure is that of line contacts.

use super::geometry::{Groove, RingPlace, Touch};
use super::waviness::{Wave, closing};
use crate::bodies::MovingRing;
use crate::laws::elastic::point::ElasticPoint;
use crate::laws::point_contact::{PointContact, PointForce, PointMotion};
use crate::scalar::{Base, Numeric, Of};
use crate::space::solid::{Moving, Vector, added, cross, difference, dot, scaled, sum};

/// Force, N, and moment about the centre of the body, N m.
pub(crate) type OnBody<T> = [Vector<T>; 2];

/// A ball at (x, rho), m, whose radius is larger than nominal by `excess` (m), with its elastic constants in a groove.
#[derive(Clone, Copy, Debug)]
pub(crate) struct InGroove<'a, B, T> {
    pub(crate) groove: &'a Groove<B>,
    pub(crate) elastic: &'a ElasticPoint<B>,
    pub(crate) at: [T; 2],
    pub(crate) excess: B,
    pub(crate) moving: &'a Moving<T>,
}

/// A contact: how it moves, its forces, and what these do to ball and ring.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact<T> {
    pub(crate) touch: Touch<T>,
    pub(crate) motion: PointMotion<T>,
    pub(crate) force: PointForce<T>,
    pub(crate) on_ball: OnBody<T>,
    pub(crate) on_ring: OnBody<T>,
}

impl<B: Base, T: Of<B>> InGroove<'_, B, T> {
    /// R of this ball, m.
    #[inline(always)]
    fn radius(&self) -> B {
        self.groove.ball_radius + self.excess
    }

    /// Where it touches a ring.
    #[inline(always)]
    pub(crate) fn touch(&self, ring: &MovingRing<T>) -> Touch<T> {
        self.groove.touch(self.at, self.excess, &RingPlace { centre: ring.centre, axis: ring.axis })
    }

    /// How both surfaces move there.
    #[inline(always)]
    pub(crate) fn motion(&self, touch: &Touch<T>, ring: &MovingRing<T>) -> PointMotion<T> {
        motion(touch, self.radius(), self.moving, ring)
    }

    /// What these forces there do to ball and ring.
    #[inline(always)]
    pub(crate) fn wrenches(&self, touch: &Touch<T>, force: &PointForce<T>) -> [OnBody<T>; 2] {
        wrenches(touch, self.radius(), force)
    }

    /// The contact with a ring, on a wave if there is one, under these laws at a viscosity of e^`ln_viscosity` times theirs.
    #[inline(always)]
    pub(crate) fn contact(
        &self,
        laws: &PointContact,
        ring: &MovingRing<T>,
        wave: Option<Wave<T>>,
        ln_viscosity: T,
    ) -> Contact<T> {
        let touch = self.touch(ring).on(wave);
        let motion = self.motion(&touch, ring);
        let force = laws.force(self.elastic, &motion, ln_viscosity);
        let [on_ball, on_ring] = self.wrenches(&touch, &force);
        Contact { touch, motion, force, on_ball, on_ring }
    }
}

/// How both surfaces move in a contact with a ball of this radius (m).
#[inline(always)]
fn motion<B: Base, T: Of<B>>(
    touch: &Touch<T>,
    radius: B,
    ball: &Moving<T>,
    ring: &MovingRing<T>,
) -> PointMotion<T> {
    let (axis, w_ring) = (ring.axis, ring.moving.turning);
    let tilting = difference(w_ring, scaled(axis, dot(w_ring, axis)));
    let passing = difference(ball.velocity, ring.moving.velocity);
    let swept = difference(passing, cross(tilting, touch.from_ring));
    let turn = dot(swept, touch.along) / touch.ball_distance;
    let spun = difference(difference(ball.turning, tilting), scaled(axis, turn));
    let [nx, nr, nt] = touch.normal;
    let to_contact = [nx * radius, nr * radius, nt * radius];
    let lever = sum(touch.from_ring, to_contact);
    let at_contact = sum(passing, difference(cross(ball.turning, to_contact), cross(w_ring, lever)));
    let speeds = [dot(spun, touch.across) * radius, (ring.speed - turn) * touch.contact_distance];
    let turning = difference(ball.turning, w_ring);
    let mut delta_dot = dot(difference(passing, cross(w_ring, lever)), touch.normal);
    if let Some(slope) = touch.slope {
        delta_dot += closing(touch, slope, turn, ring);
    }
    PointMotion {
        delta: touch.delta,
        delta_dot,
        surface_speeds: speeds,
        slip: [speeds[0] - speeds[1], dot(at_contact, touch.across)],
        turning: [dot(turning, touch.along), dot(turning, touch.across), dot(turning, touch.normal)],
    }
}

/// The vector with these components along t, l and n.
#[inline(always)]
fn in_axes<T: Numeric>(touch: &Touch<T>, [t, l, n]: [T; 3]) -> Vector<T> {
    sum(sum(scaled(touch.along, t), scaled(touch.across, l)), scaled(touch.normal, n))
}

/// What the forces of a contact do to a ball of this radius (m) and to the ring.
#[inline(always)]
fn wrenches<B: Base, T: Of<B>>(touch: &Touch<T>, radius: B, force: &PointForce<T>) -> [OnBody<T>; 2] {
    let ([ft, fl], [mt, ml, mn]) = (force.friction.force, force.friction.couple);
    let pushed = in_axes(touch, [ft, fl, -force.normal]);
    let couple = in_axes(touch, [mt, ml, mn]);
    let rolling = force.rolling_resistance;
    let resisted = scaled(touch.along, rolling);
    // R k and the shares of the film pressure.
    let curved = -(touch.in_meridian[1] * radius / touch.contact_distance);
    let pressure = -(rolling * 2.0) / (curved + 1.0);
    let on_surface = sum(pushed, resisted);
    let [nx, nr, nt] = touch.normal;
    let to_contact = [nx * radius, nr * radius, nt * radius];
    let lever = sum(touch.from_ring, to_contact);
    let through_axis = scaled(touch.along, pressure * curved);
    let on_race = sum(difference(resisted, pushed), through_axis);
    let mut ball =
        [sum(on_surface, scaled(touch.along, pressure)), sum(cross(to_contact, on_surface), couple)];
    let moment = sum(difference(cross(lever, on_race), couple), scaled(touch.across, pressure * radius));
    let mut ring = [on_race, moment];
    if let Some(slope) = touch.slope {
        let back = scaled(touch.along, force.normal * slope);
        ball[0] = difference(ball[0], back);
        ring = added(ring, [back, cross(touch.from_ring, back)]);
    }
    [ball, ring]
}

#[cfg(test)]
mod tests {
    use super::super::{Fit, Side};
    use super::*;
    use crate::laws::film::ellipse::EllipseFilm;
    use crate::laws::point_contact::PointResistance;
    use crate::laws::rolling::Extent;
    use crate::laws::rolling::point::PointRolling;
    use crate::laws::traction::ellipse::{EllipseRule, EllipseTraction};
    use crate::space::solid::Tilt;

    const RADIUS: f64 = 11.115e-3;

    /// A state of ball and ring with everything in it.
    fn state(side: Side) -> (Touch<f64>, Moving<f64>, MovingRing<f64>) {
        let groove = Groove::new(side, 0.06263, RADIUS, 0.5232 * 2.0 * RADIUS, Fit::ContactAngle(0.7));
        let tilt = Tilt::new([2e-4, -1.5e-4]);
        let (speed, rates) = (700.0, [0.3, -0.2]);
        let tilting = tilt.angular_velocity(rates);
        let own = speed - dot(tilting, tilt.axis);
        let ring = MovingRing {
            centre: [0.0; 3],
            moving: Moving { velocity: [0.01, -0.02, 0.03], turning: sum(tilting, scaled(tilt.axis, own)) },
            axis: tilt.axis,
            speed,
        };
        let ball = Moving { velocity: [0.02, 0.01, 19.0], turning: [-1500.0, 900.0, 30.0] };
        let towards = if side == Side::Outer { 1.0 } else { -1.0 };
        let place = RingPlace { centre: [-towards * 3e-5, 2e-5, -1e-5], axis: tilt.axis };
        (groove.touch([towards * 2e-5, towards * 1e-5], 0.0, &place), ball, ring)
    }

    fn law() -> (PointContact, ElasticPoint) {
        let point = ElasticPoint::new(2.26e11, [110.0, 4.0]).unwrap();
        let law = PointContact {
            damping: None,
            film: Some(EllipseFilm::new(&point, 0.03, 2e-8, None)),
            traction: Some(EllipseTraction {
                rule: EllipseRule::new(16, 2),
                temperature_rule: EllipseRule::new(16, 2),
                ln_time: (0.03_f64 / 5e6).ln(),
                pressure_viscosity: 2e-8,
                eyring_stress: 5e6,
                shear_modulus: 3e8,
                pressed_radius: 11.37e-3,
                self_heating: None,
            }),
            regime: None,
            rolling_resistance: Some(PointResistance {
                law: PointRolling::biboulet_houpert(&point, 0.03),
                thermal: None,
                extent: Extent::All,
            }),
        };
        (law, point)
    }

    #[test]
    fn forces_and_moments_cancel_and_slip_loses_their_power() {
        for side in [Side::Outer, Side::Inner] {
            let (touch, ball, ring) = state(side);
            let motion = motion(&touch, RADIUS, &ball, &ring);
            let (law, point) = law();
            let force = law.force::<f64, f64>(&point, &motion, 0.0);
            assert!(force.normal > 100.0 && force.friction.couple[2] != 0.0, "{force:?}");
            let [on_ball, on_ring] = wrenches(&touch, RADIUS, &force);
            let rest = sum(on_ball[0], on_ring[0]);
            // About the centre of the ring.
            let moment = sum(sum(on_ball[1], on_ring[1]), cross(touch.from_ring, on_ball[0]));
            for k in 0..3 {
                assert!(rest[k].abs() < 1e-12 * force.normal, "{side:?}: {rest:?}");
                assert!(moment[k].abs() < 1e-13 * force.normal, "{side:?}: {moment:?}");
            }
            let given = ball.power(on_ball) + ring.moving.power(on_ring);
            let pressed = -force.normal * motion.delta_dot;
            let [f, m] =
                [force.friction.force.as_slice(), force.friction.couple.as_slice()].map(|part| part.to_vec());
            let rubbed: f64 = f.iter().zip(motion.slip).map(|(f, d)| f * d).sum::<f64>()
                + m.iter().zip(motion.turning).map(|(m, w)| m * w).sum::<f64>();
            // Rolling resistance loses F_R (u1 + u2), up to what a ring that tilts adds to the speed of the contact.
            let [u1, u2] = motion.surface_speeds;
            let rolled = force.rolling_resistance * (u1 + u2);
            let expected = pressed + rubbed + rolled;
            assert!(rubbed < 0.0 && rolled < 0.0);
            assert!((given - expected).abs() < 1e-11 * rubbed.abs(), "{side:?}: {given} {expected}");
        }
    }

    #[test]
    fn the_approach_speed_is_the_rate_of_the_approach() {
        // A ring that stands still, a ball that moves by dual time.
        use crate::scalar::{Dual, Numeric};
        let groove = Groove::new(Side::Inner, 0.06263, RADIUS, 0.5232 * 2.0 * RADIUS, Fit::ContactAngle(0.7));
        let tilt = Tilt::new([2e-3, -1.5e-3]);
        let place = RingPlace { centre: [3e-5, 2e-5, -1e-5], axis: tilt.axis };
        let (at, velocity) = ([-2e-5, -1e-5], [0.3, -0.2]);
        let moved = |k: usize| Dual::<1> { re: at[k], eps: [velocity[k]] };
        let lifted = RingPlace { centre: place.centre.map(Dual::lift), axis: place.axis.map(Dual::lift) };
        let rate = groove.touch([moved(0), moved(1)], 0.0, &lifted).delta.eps[0];
        let ball = Moving { velocity: [velocity[0], velocity[1], 0.0], turning: [5.0, 3.0, 1.0] };
        let ring = MovingRing {
            centre: place.centre,
            moving: Moving { velocity: [0.0; 3], turning: scaled(tilt.axis, 50.0) },
            axis: tilt.axis,
            speed: 50.0,
        };
        let found = motion(&groove.touch(at, 0.0, &place), RADIUS, &ball, &ring).delta_dot;
        assert!((found - rate).abs() < 1e-15, "{found} {rate}");
    }
}
