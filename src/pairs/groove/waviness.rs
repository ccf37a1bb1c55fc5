//! A ball on the waves of a raceway.
//!
//! ```text
//! w(phi)    height towards the balls, phi the angle of the contact in the ring: see `waves`
//! delta  += w,   delta' += w' (phi' - w_1)     phi' the turning of the contact about the axis, w_1 that of the ring
//! force    -Q w'/vr t  on the ball at its centre, the opposite on the ring at the same point
//! ```
//!
//! With the tangential force the power of the contact is -Q delta', so waves neither make nor lose energy. The normal stays that of
//! the round race. Valid for slopes w'/vr far below one. Source: geometry.

use super::geometry::Touch;
use crate::bodies::MovingRing;
use crate::scalar::{Base, Numeric, Of};
use crate::space::solid::{Tilt, Vector, cross, scaled, sum};

/// A wavy race under a ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wave<T> {
    /// w, m.
    pub(crate) height: T,
    /// w', m/rad.
    pub(crate) slope: T,
}

impl<T: Numeric> Touch<T> {
    /// Cosine and sine of the angle by which the contact is ahead of the azimuth of the ball in the frame of the ring that does not spin.
    #[inline(always)]
    pub(crate) fn ahead(&self, axis: Vector<T>, tilt: &Tilt<T>) -> [T; 2] {
        tilt.crosswise(cross(self.along, axis))
    }

    /// The same on a wave, if there is one.
    #[inline(always)]
    pub(crate) fn on(self, wave: Option<Wave<T>>) -> Self {
        match wave {
            Some(wave) => {
                Self { delta: self.delta + wave.height, slope: Some(wave.slope / self.ball_distance), ..self }
            }
            None => self,
        }
    }

    /// By how much a ball that moves comes nearer, m per m: the normal, and the slope of a wave along the race.
    #[inline(always)]
    pub(crate) fn approach(&self) -> Vector<T> {
        match self.slope {
            Some(slope) => sum(self.normal, scaled(self.along, slope)),
            None => self.normal,
        }
    }
}

/// How fast the gap under a ball that turns about the axis of the ring at `turn` (rad/s) closes by the waves, m/s.
#[inline(always)]
pub(super) fn closing<B: Base, T: Of<B>>(touch: &Touch<T>, slope: T, turn: T, ring: &MovingRing<T>) -> T {
    slope * touch.ball_distance * (turn - ring.speed)
}
