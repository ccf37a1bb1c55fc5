//! Local state of the film between journal and bush at one place of the circumference, for `LubricantLayer`.
//!
//! With d the angle from the thinnest place of a round gap and eps = e/C, Sommerfeld's angle gamma is used instead,
//!
//! ```text
//! tan(d/2) = tan(gamma/2) sqrt((1 - eps)/(1 + eps)),   h = C (1 - eps^2)/(1 + eps cos gamma)
//! ```
//!
//! because powers of 1/h are polynomials in cos gamma: however thin the film, few quadrature nodes do. Everything is
//! written with cos(gamma/2) and sin(gamma/2), so that nothing cancels at either end and e = 0 needs no special case.

use crate::laws::guide::journal::{Harmonic, JournalMotion};
use crate::scalar::Real;
use crate::scalar::math;

/// The film at one place. Vectors are in the axes of the gap that gives it.
#[derive(Clone, Copy)]
pub(super) struct Place<T> {
    /// h, m.
    pub film: T,
    /// 1/h, 1/m.
    pub inverse_film: T,
    /// dh/dtheta, m/rad.
    pub slope: T,
    /// Part of it that the profile makes, m/rad.
    pub lobe_slope: T,
    /// G = (w_1 + w_2) dh/dtheta + 2 dh/dt, m/s; negative where the film builds up pressure.
    pub opening: T,
    /// u_1 - u_2, m/s.
    pub sliding: T,
    /// Unit vector (cos, sin) from the journal to the bush; the sliding is positive along (-sin, cos).
    pub normal: [T; 2],
    /// dtheta/dgamma.
    pub arc: T,
}

/// The gap around the circumference.
pub(super) trait Gap<T> {
    /// The film at Sommerfeld's angle `gamma`, rad.
    fn at(&self, gamma: T) -> Place<T>;
    /// b = sqrt((1 - eps)/(1 + eps)); the singular points of the map are pi +- 2 i atanh(b).
    fn narrowness(&self) -> f64;
}

/// Gap of round surfaces, in axes along and across the eccentricity.
#[derive(Clone, Copy)]
pub(super) struct RoundGap<T> {
    /// e, m.
    pub eccentricity: T,
    /// C - e, m.
    pub thinnest: T,
    /// C + e, m.
    pub thickest: T,
    /// sqrt((C + e)(C - e)), m.
    pub mean: T,
    /// Inverse of its square, 1/m^2.
    pub inverse_square: T,
    /// (w_1 + w_2) e - 2 v_phi, m/s: G = wedge sin d - squeeze cos d.
    pub wedge: T,
    /// 2 v_eps, m/s.
    pub squeeze: T,
    /// R (w_1 - w_2), m/s.
    pub rolling: T,
    /// v_eps and v_phi, m/s.
    pub velocity: [T; 2],
}

impl<T: Real> RoundGap<T> {
    /// The same gap without derivatives.
    #[inline]
    pub fn plain(&self) -> RoundGap<f64> {
        RoundGap {
            eccentricity: self.eccentricity.value(),
            thinnest: self.thinnest.value(),
            thickest: self.thickest.value(),
            mean: self.mean.value(),
            inverse_square: self.inverse_square.value(),
            wedge: self.wedge.value(),
            squeeze: self.squeeze.value(),
            rolling: self.rolling.value(),
            velocity: self.velocity.map(Real::value),
        }
    }
}

impl RoundGap<f64> {
    /// The two places where G changes sign, in ascending order within -pi to pi.
    #[inline]
    pub fn sign_changes(&self) -> [f64; 2] {
        let (a, s) = (self.wedge, self.squeeze);
        let n = math::hypot(a, s);
        // Sine and cosine of half the angle atan2(s, a), up to a common factor.
        let (sin, cos) = if a < 0.0 { (n - a, s) } else { (s, n + a) };
        let (wide, thin) = (self.thickest.sqrt(), self.thinnest.sqrt());
        let fold = |y: f64, x: f64| 2.0 * (if x < 0.0 { math::atan2(-y, -x) } else { math::atan2(y, x) });
        let (first, second) = (fold(wide * sin, thin * cos), fold(wide * cos, -thin * sin));
        [first.min(second), first.max(second)]
    }
}

impl<T: Real> Gap<T> for RoundGap<T> {
    #[inline]
    fn at(&self, gamma: T) -> Place<T> {
        let (s, c) = (gamma * 0.5).sin_cos();
        let (near, far) = (c * c * self.thickest, s * s * self.thinnest);
        let sum = near + far;
        let inverse = T::constant(1.0) / sum;
        let arc = self.mean * inverse;
        let (cos, sin) = ((near - far) * inverse, s * c * arc * 2.0);
        let [radial, tangential] = self.velocity;
        Place {
            film: self.mean * arc,
            inverse_film: sum * self.inverse_square,
            slope: self.eccentricity * sin,
            lobe_slope: T::constant(0.0),
            opening: self.wedge * sin - self.squeeze * cos,
            sliding: self.rolling - radial * sin + tangential * cos,
            normal: [cos, sin],
            arc,
        }
    }

    #[inline]
    fn narrowness(&self) -> f64 {
        (self.thinnest.value() / self.thickest.value()).sqrt()
    }
}

/// Gap with a profile, in global axes. The map follows the plain value of the eccentricity, and only the film carries
/// derivatives.
#[derive(Clone, Copy)]
pub(super) struct ProfileGap<'a, T> {
    pub radius: f64,
    pub clearance: f64,
    pub roundness: &'a [Harmonic],
    pub motion: JournalMotion<T>,
    /// Unit vector along the eccentricity.
    pub direction: [f64; 2],
    /// C - e and C + e of the map, m; the first is kept above zero.
    pub thinnest: f64,
    pub thickest: f64,
}

impl<T: Real> ProfileGap<'_, T> {
    /// The same gap without derivatives.
    #[inline]
    pub fn plain(&self) -> ProfileGap<'_, f64> {
        let m = &self.motion;
        let motion = JournalMotion {
            position: m.position.map(Real::value),
            velocity: m.velocity.map(Real::value),
            journal_speed: m.journal_speed.value(),
            bush_speed: m.bush_speed.value(),
            profile_angle: m.profile_angle.value(),
            profile_speed: m.profile_speed.value(),
        };
        ProfileGap {
            radius: self.radius,
            clearance: self.clearance,
            roundness: self.roundness,
            motion,
            direction: self.direction,
            thinnest: self.thinnest,
            thickest: self.thickest,
        }
    }
}

impl<T: Real> Gap<T> for ProfileGap<'_, T> {
    #[inline]
    fn at(&self, gamma: T) -> Place<T> {
        let (s, c) = (gamma * 0.5).sin_cos();
        let (near, far) = (c * c * self.thickest, s * s * self.thinnest);
        let inverse = T::constant(1.0) / (near + far);
        let arc = inverse * (self.thickest * self.thinnest).sqrt();
        let (cos_d, sin_d) = ((near - far) * inverse, s * c * arc * 2.0);
        let [dy, dz] = self.direction;
        let (cos, sin) = (cos_d * dy - sin_d * dz, cos_d * dz + sin_d * dy);
        let m = &self.motion;
        let ([y, z], [vy, vz]) = (m.position, m.velocity);
        let mut film = -(y * cos + z * sin) + self.clearance;
        let mut lobe_slope = T::constant(0.0);
        let mut rate = -(vy * cos + vz * sin);
        let angle = sin.atan2(cos) - m.profile_angle;
        for a in self.roundness {
            let n = f64::from(a.order);
            let (s, c) = (angle * n + a.phase).sin_cos();
            film -= c * a.amplitude;
            lobe_slope += s * (a.amplitude * n);
            rate -= s * (a.amplitude * n) * m.profile_speed;
        }
        let slope = y * sin - z * cos + lobe_slope;
        Place {
            film,
            inverse_film: T::constant(1.0) / film,
            slope,
            lobe_slope,
            opening: (m.journal_speed + m.bush_speed) * slope + rate * 2.0,
            sliding: (m.journal_speed - m.bush_speed) * self.radius - vy * sin + vz * cos,
            normal: [cos, sin],
            arc,
        }
    }

    #[inline]
    fn narrowness(&self) -> f64 {
        (self.thinnest / self.thickest).sqrt()
    }
}

/// Place between `a` and `b` where `f` changes its sign, by the Illinois method.
#[inline]
pub(super) fn change(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let (mut at_a, mut at_b) = (f(a), f(b));
    for _ in 0..60 {
        let secant = b - at_b * (b - a) / (at_b - at_a);
        let inside = a.min(b) < secant && secant < a.max(b);
        let next = if inside { secant } else { 0.5 * (a + b) };
        let value = f(next);
        let step = (next - b).abs();
        if (value < 0.0) == (at_b < 0.0) {
            at_a *= 0.5;
        } else {
            (a, at_a) = (b, at_b);
        }
        (b, at_b) = (next, value);
        if value == 0.0 || step.min((b - a).abs()) < 1e-15 {
            break;
        }
    }
    b
}

/// Calls `visit` for the parts of an interval between the sign changes of `f`, which is looked at in `steps` steps and
/// one beyond either end. Where those values curve towards zero, a pair of changes within one step is looked for too.
pub(super) fn parts(
    f: impl Fn(f64) -> f64,
    [from, to]: [f64; 2],
    steps: u32,
    mut visit: impl FnMut(f64, f64),
) {
    let step = (to - from) / f64::from(steps);
    let place = |i: u32| if i == steps { to } else { from + step * f64::from(i) };
    let mut start = from;
    let mut split = |at: f64| {
        visit(start, at);
        start = at;
    };
    let mut v = [f(from - step), f(from), f(place(1)), 0.0];
    for i in 0..steps {
        let (a, b) = (place(i), place(i + 1));
        v[3] = f(b + step);
        let side = if v[1] < 0.0 { -1.0 } else { 1.0 };
        let [before, left, right, after] = v.map(|v| side * v);
        if (v[1] < 0.0) != (v[2] < 0.0) {
            split(change(&f, a, b));
        } else if before >= left && after >= right && left.min(right) <= before - left + after - right {
            let lowest = lowest(|x| side * f(x), a, b);
            if side * f(lowest) < 0.0 {
                split(change(&f, a, lowest));
                split(change(&f, lowest, b));
            }
        }
        v = [v[1], v[2], v[3], 0.0];
    }
    split(to);
}

/// Place of the minimum of `f` between `a` and `b`, or a place where it is negative.
fn lowest(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (mut left, mut right) = (b - GOLDEN * (b - a), a + GOLDEN * (b - a));
    let (mut at_left, mut at_right) = (f(left), f(right));
    for _ in 0..36 {
        if at_left < at_right {
            (b, right, at_right) = (right, left, at_left);
            left = b - GOLDEN * (b - a);
            at_left = f(left);
        } else {
            (a, left, at_left) = (left, right, at_right);
            right = a + GOLDEN * (b - a);
            at_right = f(right);
        }
        if at_left.min(at_right) < 0.0 {
            break;
        }
    }
    if at_left < at_right { left } else { right }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ends(f: impl Fn(f64) -> f64, interval: [f64; 2], steps: u32) -> Vec<f64> {
        let mut ends = Vec::new();
        parts(f, interval, steps, |_, b| ends.push(b));
        ends
    }

    fn near(found: &[f64], expected: &[f64]) -> bool {
        found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12)
    }

    #[test]
    fn parts_end_at_sign_changes() {
        assert!(near(&ends(|x| x.powi(3) - 0.2, [0.0, 1.0], 1), &[0.2f64.cbrt(), 1.0]));
        assert_eq!(ends(|x| x * x + 1e-9, [-1.0, 1.1], 3), [1.1]);
        assert_eq!(ends(|_| f64::NAN, [0.0, 1.0], 2), [1.0]);
        assert_eq!(ends(|_| f64::INFINITY, [0.0, 1.0], 2), [1.0]);
    }

    #[test]
    fn a_pair_of_sign_changes_within_a_step_is_found() {
        for width in [0.2, 1e-3, 1e-6] {
            for sign in [1.0, -1.0] {
                for middle in [0.03, 0.3, 0.5, 0.9] {
                    let (a, b) = (middle - 0.1 * width, middle + 0.1 * width);
                    let found = ends(|x| sign * (x - a) * (x - b), [0.0, 1.0], 1);
                    assert!(near(&found, &[a, b, 1.0]), "{width} {middle} {found:?}");
                }
            }
        }
    }
}
