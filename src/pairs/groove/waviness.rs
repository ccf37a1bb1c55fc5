//! Waves of a raceway around the axis of its ring.
//!
//! ```text
//! w(phi)  = sum of a_n cos(n phi + b_n)       height towards the balls, phi the angle of the contact in the ring
//! delta  += w,   delta' += w' (phi' - w_1)     phi' the turning of the contact about the axis, w_1 that of the ring
//! force    -Q w'/vr t  on the ball at its centre, the opposite on the ring at the same point
//! ```
//!
//! With the tangential force the power of the contact is -Q delta', so waves neither make nor lose energy. The normal stays that of
//! the round race. Valid for slopes w'/vr far below one. Source: geometry.

use super::geometry::Touch;
use crate::bodies::MovingRing;
use crate::scalar::{Base, Numeric, Of, math};
use crate::scene::WavinessHarmonic;
use crate::space::solid::{Tilt, Vector, cross, scaled, sum};

/// Waves of one race.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Waviness {
    /// n, a_n in m and b_n in rad.
    harmonics: Vec<[f64; 3]>,
}

/// A wavy race under a ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wave<T> {
    /// w, m.
    pub(crate) height: T,
    /// w', m/rad.
    pub(crate) slope: T,
}

impl Waviness {
    /// That of these harmonics, if there are any.
    pub(crate) fn new(harmonics: &[WavinessHarmonic]) -> Option<Self> {
        let list = harmonics.iter().map(|h| [f64::from(h.order), h.amplitude, h.phase]);
        (!harmonics.is_empty()).then(|| Self { harmonics: list.collect() })
    }

    /// The largest order.
    pub(crate) fn highest_order(&self) -> f64 {
        self.harmonics.iter().map(|[order, ..]| *order).fold(0.0, f64::max)
    }

    /// w, w' and w'' at an angle in the ring (rad); m, m/rad and m/rad^2.
    pub(crate) fn at(&self, angle: f64) -> [f64; 3] {
        self.harmonics.iter().fold([0.0; 3], |[height, slope, curvature], [order, amplitude, phase]| {
            let (sin, cos) = math::sin_cos(order * angle + phase);
            let [sin, cos] = [amplitude * sin, amplitude * cos];
            [height + cos, slope - order * sin, curvature - order * order * cos]
        })
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_derivatives() {
        let harmonic = |order, amplitude, phase| WavinessHarmonic { order, amplitude, phase };
        assert!(Waviness::new(&[]).is_none());
        let waves = Waviness::new(&[harmonic(3, 1e-6, 0.3), harmonic(17, -2e-7, -1.0)]).unwrap();
        assert!((waves.highest_order() - 17.0).abs() < 1e-15);
        let (at, h) = (0.7, 1e-4);
        let [before, here, after] = [at - h, at, at + h].map(|angle| waves.at(angle));
        let expected = 1e-6 * f64::cos(3.0 * at + 0.3) - 2e-7 * f64::cos(17.0 * at - 1.0);
        assert!((here[0] - expected).abs() < 1e-20);
        for k in 0..2 {
            let slope = (after[k] - before[k]) / (2.0 * h);
            assert!((slope - here[k + 1]).abs() < 1e-5 * here[k + 1].abs(), "{k}: {slope} {}", here[k + 1]);
        }
    }
}
