//! Where the centre of an element is in its pocket of a cage that moves in space, by the formulas of the module.

use crate::bodies::MovingCage;
use crate::scalar::Real;
use crate::space::solid::{Tilt, Vector, difference};

/// Where the centre of an element is in its pocket.
#[derive(Clone, Copy, Debug)]
pub(crate) struct InPocket<T> {
    /// q, m.
    pub(crate) q: Vector<T>,
    /// Tilt of the pocket in the axes of its azimuth, and cosine and sine of beta.
    tilt: Tilt<T>,
    lead: [T; 2],
}

/// A vector in the axes of an azimuth ahead by the angle with this cosine and sine.
#[inline]
pub(crate) fn ahead<T: Real>([x, r, t]: Vector<T>, [cos, sin]: [T; 2]) -> Vector<T> {
    [x, cos * r + sin * t, cos * t - sin * r]
}

impl<T: Real> InPocket<T> {
    /// That of an element at x and rho (m) and at the azimuth with this cosine and sine, ahead of its pocket by `lead` (rad), whose pocket a
    /// bent cage displaces outwards and ahead by `bent`, m.
    pub(crate) fn new(
        pitch_radius: f64,
        [x, rho]: [T; 2],
        [cos_b, sin_b]: [T; 2],
        lead: T,
        cage: &MovingCage<T>,
        bent: Option<[T; 2]>,
    ) -> Self {
        let (half_sin, half_cos) = (lead * 0.5).sin_cos();
        let (sin, chord) = (half_sin * half_cos * 2.0, half_sin * half_sin * 2.0);
        let lead = [-chord + 1.0, sin];
        // The azimuth of the pocket.
        let [cos_p, sin_p] = [cos_b * lead[0] + sin_b * sin, sin_b * lead[0] - cos_b * sin];
        let across = |[_, y, z]: Vector<T>| [cos_p * y + sin_p * z, cos_p * z - sin_p * y];
        let [out, ahead] = across(cage.centre);
        let zero = T::constant(0.0);
        let tilt = Tilt::new(across([zero, cage.tilt.angles[0], cage.tilt.angles[1]]));
        let r = rho + pitch_radius;
        let off = [x - cage.centre[0], rho - r * chord - out, r * sin - ahead];
        let moved = tilt.moved_by([zero, T::constant(pitch_radius), zero]);
        let mut q = tilt.turned_back(difference(off, moved));
        if let Some([out, ahead]) = bent {
            q = difference(q, [zero, out, ahead]);
        }
        Self { q, tilt, lead }
    }

    /// A vector in the axes of the pocket, in those of the azimuth of the element.
    pub(crate) fn at_azimuth(&self, v: Vector<T>) -> Vector<T> {
        ahead(self.tilt.turned(v), self.lead)
    }
}
