//! One ball that goes round steadily under all forces of its contacts: normal forces, traction over the ellipses with spin, rolling resistance.
//!
//! ```text
//! F_x = 0,   F_r + m psi'^2 r + weight = 0,   F_psi = 0
//! M_x = 0,   M_r + I psi' w_psi = 0,   M_psi - I psi' w_r = 0
//! ```
//!
//! Six equations for x, rho, psi', w_x, w_r, w_psi beside a ring that is where it is. In a bearing that is the same all around that is its steady
//! motion; under a load across the axis each ball is taken as if it had been at its azimuth for long. Newton's method starts from outer race
//! control.

use super::ball::{Ball, OF_RING, OnRing};
use crate::bodies::MovingRing;
use crate::laws::point_contact::PointContact;
use crate::pairs::groove::{Contact, InGroove};
use crate::scalar::{Dual, Of, Real};
use crate::space::solid::{Moving, Tilt, Vector, added, scaled};
use nalgebra::{SMatrix, SVector};

/// Unknowns of a ball: x, rho, psi', w_x, w_r, w_psi.
const OF_BALL: usize = 6;
const ALL: usize = OF_BALL + OF_RING;
/// Derivatives that are taken at once: all together would be ten times the code of the forces.
const AT_ONCE: usize = 2;
/// Newton steps, and halvings of one.
const MOST_STEPS: usize = 80;
const MOST_HALVINGS: usize = 24;
/// Rest of the forces, over their size, that is round-off, and the one that is accepted where no step makes it smaller.
const ROUND_OFF: f64 = 1e-13;
const ACCEPTED: f64 = 1e-8;

/// A ball with the laws of its contacts beside elasticity.
pub(crate) struct SteadyBall<'a> {
    pub(super) ball: Ball<'a>,
    /// Of outer and inner race.
    pub(super) laws: [&'a PointContact; 2],
}

/// Forces on ball and ring.
struct Forces<T> {
    /// What must vanish, N; moments over the radius.
    rest: [T; OF_BALL],
    /// On the ring over its coordinates.
    on_ring: [T; OF_RING],
    /// Q of both contacts, N.
    loads: [T; 2],
}

/// Derivatives of the forces on ball and ring over those of the variables that were asked for.
struct Slopes {
    rest: SMatrix<f64, OF_BALL, ALL>,
    on_ring: SMatrix<f64, OF_RING, ALL>,
}

impl SteadyBall<'_> {
    fn forces<T: Of<f64>>(&self, y: [T; OF_BALL], ring: [T; OF_RING]) -> Forces<T> {
        let [x, rho, orbit, wx, wr, wpsi] = y;
        let zero = x.like(0.0);
        let radius = self.ball.radius();
        let tilt = Tilt::new([ring[3], ring[4]]);
        let around = rho + self.ball.grooves[0].pitch_radius;
        let moving = &Moving { velocity: [zero, zero, around * orbit], turning: [wx, wr, wpsi] };
        let contact = |k: usize, centre: Vector<T>, axis: Vector<T>| -> Contact<T> {
            let speed = x.like(self.ball.speeds[k]);
            let turning = scaled(axis, speed);
            let ring = MovingRing { centre, moving: Moving { velocity: [zero; 3], turning }, axis, speed };
            let ball = InGroove {
                groove: self.ball.grooves[k],
                elastic: self.ball.elastic[k],
                at: [x, rho],
                excess: self.ball.excess,
                moving,
            };
            ball.contact(self.laws[k], &ring, None, zero)
        };
        let outer = contact(0, [zero; 3], [x.like(1.0), zero, zero]);
        let inner = contact(1, [ring[0], ring[1], ring[2]], tilt.axis);
        let [mass, inertia] = self.ball.inertia;
        let [[fx, fr, fpsi], [mx, mr, mpsi]] = added(outer.on_ball, inner.on_ball);
        let [[on_x, on_r, on_psi], moment] = inner.on_ring;
        let gyroscopic = orbit * inertia;
        let [over_r, over_psi] = tilt.moments_over_angles(moment);
        Forces {
            rest: [
                fx,
                fr + orbit * orbit * around * mass + mass * self.ball.gravity,
                fpsi,
                mx / radius,
                (mr + gyroscopic * wpsi) / radius,
                (mpsi - gyroscopic * wr) / radius,
            ],
            on_ring: [on_x, on_r, on_psi, over_r, over_psi],
            loads: [outer.force.normal, inner.force.normal],
        }
    }

    /// Slopes over `count` variables from this one on, of which those of the ball come first.
    fn slopes(&self, y: [f64; OF_BALL], ring: [f64; OF_RING], [first, count]: [usize; 2]) -> Slopes {
        let mut slopes = Slopes { rest: SMatrix::zeros(), on_ring: SMatrix::zeros() };
        for from in (first..first + count).step_by(AT_ONCE) {
            let number = |value: f64, k: usize| match k.checked_sub(from) {
                Some(place) if place < AT_ONCE => Dual::<AT_ONCE>::variable(value, place),
                _ => Dual::constant(value),
            };
            let at = std::array::from_fn(|k| number(y[k], k));
            let forces = self.forces(at, std::array::from_fn(|k| number(ring[k], OF_BALL + k)));
            for k in from..(from + AT_ONCE).min(first + count) {
                let column = |force: Dual<AT_ONCE>| force.eps[k - from];
                slopes.rest.set_column(k, &SVector::from(forces.rest.map(column)));
                slopes.on_ring.set_column(k, &SVector::from(forces.on_ring.map(column)));
            }
        }
        slopes
    }

    /// The steady motion beside a ring at these coordinates; `None` where none is found.
    pub(super) fn steady(&self, from: [f64; 2], ring: [f64; OF_RING]) -> Option<[f64; OF_BALL]> {
        let [x, rho] = self.ball.rest(from, ring)?;
        let rolling = self.ball.forces::<f64>([x, rho], ring).rolling;
        let mut y = SVector::from([x, rho, rolling.orbit, rolling.spin[0], rolling.spin[1], 0.0]);
        let size = |forces: &Forces<f64>| forces.loads.iter().sum::<f64>();
        let mut here = self.forces::<f64>(y.into(), ring);
        for _ in 0..MOST_STEPS {
            let rest = SVector::from(here.rest).norm();
            if rest <= ROUND_OFF * size(&here) {
                return Some(y.into());
            }
            let slopes = self.slopes(y.into(), ring, [0, OF_BALL]);
            let matrix = -slopes.rest.fixed_columns::<OF_BALL>(0);
            let step = matrix.lu().solve(&SVector::from(here.rest))?;
            let mut share = 1.0;
            let mut nearer = None;
            for _ in 0..MOST_HALVINGS {
                let to = y + step * share;
                let there = self.forces::<f64>(to.into(), ring);
                if SVector::from(there.rest).norm() < (1.0 - 0.1 * share) * rest {
                    nearer = Some((to, there));
                    break;
                }
                share *= 0.5;
            }
            match nearer {
                Some(found) => (y, here) = found,
                None => return (rest <= ACCEPTED * size(&here)).then(|| y.into()),
            }
        }
        None
    }

    /// What it does to the ring in its steady motion.
    pub(super) fn on_ring(&self, y: [f64; OF_BALL], ring: [f64; OF_RING]) -> OnRing {
        let forces = self.forces::<f64>(y, ring);
        let Slopes { rest, on_ring } = self.slopes(y, ring, [0, ALL]);
        let own = -rest.fixed_columns::<OF_BALL>(0);
        let by_ring = rest.fixed_columns::<OF_RING>(OF_BALL);
        let direct = -on_ring.fixed_columns::<OF_RING>(OF_BALL);
        let on_ring = on_ring.fixed_columns::<OF_BALL>(0);
        let following = own.lu().solve(&by_ring).unwrap_or_else(SMatrix::zeros);
        OnRing {
            force: SVector::from(forces.on_ring),
            stiffness: direct - on_ring * following,
            // Friction has no potential: the force alone tells progress.
            energy: f64::NAN,
        }
    }
}
