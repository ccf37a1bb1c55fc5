//! Vectors of three components, and the axis of a body that tilts.
//!
//! ```text
//! rotation vector T = (0, a, b) of the frame of the body that does not spin,  q^2 = a^2 + b^2
//! s = sin q/q,   A1 = (1 - cos q)/q^2,   A2 = (q - sin q)/q^3
//! axis u = (1 - A1 q^2, s b, -s a)
//! angular velocity w = J (0, a', b') + u psi',   J = I + A1 [T]x + A2 [T]x^2
//! ```
//!
//! A tilt is at most [`LARGEST_TILT`]; the functions of q are series in q^2, exact to round-off up to there, so that nothing is divided by
//! a tilt of zero and derivatives are those of polynomials. Source: the exponential map of rotations, as in any textbook of
//! mechanics.

use crate::scalar::Numeric;

/// A vector.
pub type Vector<T> = [T; 3];

/// Motion of a body: velocity of its centre, m/s, and angular velocity, rad/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moving<T> {
    /// Of the centre.
    pub velocity: Vector<T>,
    /// Of the body.
    pub turning: Vector<T>,
}

impl<T> Moving<T> {
    /// The same of what `f` makes of every number.
    #[inline(always)]
    pub fn map<U>(self, f: impl Fn(T) -> U + Copy) -> Moving<U> {
        Moving { velocity: mapped(self.velocity, f), turning: mapped(self.turning, f) }
    }
}

impl<T: Numeric> Moving<T> {
    /// Power of this force and moment on it.
    #[inline(always)]
    pub fn power(&self, [force, moment]: [Vector<T>; 2]) -> T {
        dot(force, self.velocity) + dot(moment, self.turning)
    }
}

/// What `f` makes of every component, for the instructions of the caller.
#[inline(always)]
pub fn mapped<T, U>([a, b, c]: Vector<T>, f: impl Fn(T) -> U) -> Vector<U> {
    [f(a), f(b), f(c)]
}

/// A vector in the axes of the azimuth with this cosine and sine.
#[inline(always)]
pub fn to_local<T: Numeric>([x, y, z]: Vector<f64>, [cos, sin]: [T; 2]) -> Vector<T> {
    [cos.like(x), cos * y + sin * z, cos * z - sin * y]
}

/// A vector in the axes of the bearing.
#[inline(always)]
pub fn to_global<T: Numeric>([x, r, t]: Vector<T>, [cos, sin]: [T; 2]) -> Vector<T> {
    [x, cos * r - sin * t, sin * r + cos * t]
}

/// Largest tilt that the series are for, rad: a bearing that tilts so far is none.
pub const LARGEST_TILT: f64 = 0.3;

/// a + b.
#[inline(always)]
pub fn sum<T: Numeric>(a: Vector<T>, b: Vector<T>) -> Vector<T> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Force and moment of two together.
#[inline(always)]
pub fn added<T: Numeric>(a: [Vector<T>; 2], b: [Vector<T>; 2]) -> [Vector<T>; 2] {
    [sum(a[0], b[0]), sum(a[1], b[1])]
}

/// Force and moment as numbers.
#[inline(always)]
pub fn numbers<T>([[a, b, c], [d, e, f]]: [Vector<T>; 2]) -> [T; 6] {
    [a, b, c, d, e, f]
}

/// Force and moment of these numbers.
#[inline(always)]
pub fn halves<T>([a, b, c, d, e, f]: [T; 6]) -> [Vector<T>; 2] {
    [[a, b, c], [d, e, f]]
}

/// a - b.
#[inline(always)]
pub fn difference<T: Numeric>(a: Vector<T>, b: Vector<T>) -> Vector<T> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// a times a number.
#[inline(always)]
pub fn scaled<T: Numeric>(a: Vector<T>, factor: T) -> Vector<T> {
    [a[0] * factor, a[1] * factor, a[2] * factor]
}

/// a . b.
#[inline(always)]
pub fn dot<T: Numeric>(a: Vector<T>, b: Vector<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a x b.
#[inline(always)]
pub fn cross<T: Numeric>(a: Vector<T>, b: Vector<T>) -> Vector<T> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Orientation of the axis of a body whose own frame is turned by the rotation vector (0, a, b), rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tilt<T> {
    /// a and b, rad.
    pub angles: [T; 2],
    /// u.
    pub axis: Vector<T>,
    /// A1, A2 and s.
    coefficients: [T; 3],
}

/// Turning of the frame of a body that does not spin, in its own axes, rad/s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Across<T> {
    /// w_2 and w_3, across the own axis.
    pub speed: [T; 2],
    /// Their rates at constant rates of the angles, rad/s^2.
    pub drift: [T; 2],
    /// W_1, about it.
    pub own: T,
    /// Its rate at constant rates of the angles, rad/s^2.
    pub own_drift: T,
}

/// 1 - x/m_1 (1 - x/m_2 (1 - ...)) over these divisors.
#[inline(always)]
fn series<T: Numeric, const N: usize>(x: T, divisors: [f64; N]) -> T {
    let mut sum = x.like(1.0);
    for divisor in divisors.into_iter().rev() {
        sum = -(x * sum) * (1.0 / divisor) + 1.0;
    }
    sum
}

impl<T: Numeric> Tilt<T> {
    /// That of these angles (rad), at most [`LARGEST_TILT`] together.
    #[inline(always)]
    pub fn new(angles: [T; 2]) -> Self {
        let [a, b] = angles;
        let x = a * a + b * b;
        let sine = series(x, [6.0, 20.0, 42.0, 72.0, 110.0, 156.0, 210.0]);
        let first = series(x, [12.0, 30.0, 56.0, 90.0, 132.0, 182.0, 240.0]) * 0.5;
        let second = series(x, [20.0, 42.0, 72.0, 110.0, 156.0, 210.0, 272.0]) * (1.0 / 6.0);
        let axis = [-(first * x) + 1.0, sine * b, -(sine * a)];
        Self { angles, axis, coefficients: [first, second, sine] }
    }

    /// Angular velocity of a body whose angles change at these rates (rad/s) and which does not turn in its own frame, rad/s.
    #[inline(always)]
    pub fn angular_velocity(&self, [da, db]: [T; 2]) -> Vector<T> {
        let ([a, b], [first, second, _]) = (self.angles, self.coefficients);
        // T x T' = (a b' - b a', 0, 0).
        let turn = a * db - b * da;
        [first * turn, da + second * b * turn, db - second * a * turn]
    }

    /// How the angular velocity across the own axis, in the axes of the frame of the body that does not spin, follows from the rates of
    /// the angles: that and its rate at constant rates of the angles; and the angular velocity of this frame about the own axis, rad/s.
    #[inline(always)]
    pub fn across(&self, [da, db]: [T; 2]) -> Across<T> {
        let ([a, b], [first, second, _]) = (self.angles, self.coefficients);
        let turn = a * db - b * da;
        let x = a * a + b * b;
        let slope = series(x, [21.0, 48.0, 82.5, 124.8, 175.0]) * (-1.0 / 120.0);
        let changing = (a * da + b * db) * 2.0;
        let rate = slope * changing;
        let first_slope = series(x, [15.0, 112.0 / 3.0, 67.5, 105.6, 455.0 / 3.0]) * (-1.0 / 24.0);
        Across {
            speed: [da + second * b * turn, db - second * a * turn],
            drift: [(rate * b + second * db) * turn, -(rate * a + second * da) * turn],
            own: -(first * turn),
            own_drift: -(first_slope * changing * turn),
        }
    }

    /// Rate of W_1 by second rates of the angles (rad/s^2) alone, rad/s^2.
    #[inline(always)]
    pub fn own_rate(&self, [dda, ddb]: [T; 2]) -> T {
        let ([a, b], [first, _, _]) = (self.angles, self.coefficients);
        -(first * (a * ddb - b * dda))
    }

    /// What turning a vector with the body adds to it.
    #[inline(always)]
    pub fn moved_by(&self, v: Vector<T>) -> Vector<T> {
        let ([a, b], [first, _, sine]) = (self.angles, self.coefficients);
        let by = |[x, y, z]: Vector<T>| [a * z - b * y, b * x, -(a * x)];
        let once = by(v);
        sum(scaled(once, sine), scaled(by(once), first))
    }

    /// A vector of the frame of the body that does not spin, in outer axes.
    #[inline(always)]
    pub fn turned(&self, v: Vector<T>) -> Vector<T> {
        sum(v, self.moved_by(v))
    }

    /// A vector in outer axes, in those of the frame of the body that does not spin.
    #[inline(always)]
    pub fn turned_back(&self, v: Vector<T>) -> Vector<T> {
        let [a, b] = self.angles;
        Self { angles: [-a, -b], ..*self }.turned(v)
    }

    /// Derivatives of [`Tilt::across`] over the rates of the angles: by row those of one component.
    #[inline(always)]
    pub fn over_rates(&self) -> [[T; 2]; 2] {
        let ([a, b], [_, second, _]) = (self.angles, self.coefficients);
        let mixed = second * a * b;
        [[-(second * b * b) + 1.0, mixed], [mixed, -(second * a * a) + 1.0]]
    }

    /// Components of a vector along the two axes across the own one of the frame of the body that does not spin.
    #[inline(always)]
    pub fn crosswise(&self, v: Vector<T>) -> [T; 2] {
        let ([a, b], [first, _, _]) = (self.angles, self.coefficients);
        let [_, sb, sa] = self.axis;
        let mixed = first * a * b;
        let [second, third] = [[-sb, -(first * b * b) + 1.0, mixed], [-sa, mixed, -(first * a * a) + 1.0]];
        [dot(second, v), dot(third, v)]
    }

    /// Moments over the angles, N m, of this moment (N m) on a body that does not turn in its own frame: their power is that of the
    /// moment.
    #[inline(always)]
    pub fn moments_over_angles(&self, [mx, my, mz]: Vector<T>) -> [T; 2] {
        let ([a, b], [first, second, _]) = (self.angles, self.coefficients);
        let turned = first * mx + second * (b * my - a * mz);
        [my - b * turned, mz + a * turned]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Dual;

    /// The matrix of the rotation, by Rodrigues' formula.
    fn matrix(a: f64, b: f64) -> [[f64; 3]; 3] {
        let q = a.hypot(b);
        let (s, c) = (q.sin() / q, (1.0 - q.cos()) / (q * q));
        let t = [[0.0, -b, a], [b, 0.0, 0.0], [-a, 0.0, 0.0]];
        std::array::from_fn(|i| {
            std::array::from_fn(|k| {
                let square: f64 = (0..3).map(|m| t[i][m] * t[m][k]).sum();
                f64::from(u8::from(i == k)) + s * t[i][k] + c * square
            })
        })
    }

    #[test]
    fn the_axis_is_that_of_the_rotation() {
        for [a, b] in [[1e-9, 2e-9], [3e-3, -4e-3], [0.18, 0.24], [-0.29, 0.05]] {
            let [axis, m] = [Tilt::new([a, b]).axis, matrix(a, b).map(|row| row[0])];
            assert!(axis.iter().zip(m).all(|(x, y)| (x - y).abs() < 2e-16), "{axis:?} {m:?}");
        }
        assert_eq!(Tilt::new([0.0, 0.0]).axis, [1.0, 0.0, 0.0]);
    }

    #[test]
    fn the_axis_turns_with_the_angular_velocity() {
        for [a, b, da, db] in [[0.0, 0.0, 1.0, -2.0], [0.1, -0.2, 0.7, 0.4], [-0.25, 0.1, -3.0, 1.0]] {
            let along = |x: f64, dx: f64| Dual::<1> { re: x, eps: [dx] };
            let moving = Tilt::new([along(a, da), along(b, db)]).axis;
            let tilt = Tilt::new([a, b]);
            let turned = cross(tilt.angular_velocity([da, db]), tilt.axis);
            for (rate, turned) in moving.iter().zip(turned) {
                assert!((rate.eps[0] - turned).abs() < 1e-15 * (1.0 + turned.abs()), "{rate:?} {turned}");
            }
            // The other columns of the rotation, which tell a turn about the axis, by differences.
            let h = 1e-5;
            let [before, after] = [-h, h].map(|s| matrix(a + s * da + 1e-12, b + s * db));
            let m = matrix(a + 1e-12, b);
            let w = tilt.angular_velocity([da, db]);
            for k in 0..3 {
                let column = |m: &[[f64; 3]; 3]| m.map(|row| row[k]);
                let expected = cross(w, column(&m));
                for i in 0..3 {
                    let rate = (column(&after)[i] - column(&before)[i]) / (2.0 * h);
                    assert!((rate - expected[i]).abs() < 1e-8, "{rate} {expected:?}");
                }
            }
        }
    }

    #[test]
    fn vectors_turn_with_the_body() {
        for [a, b] in [[1e-3, -2e-3], [0.18, 0.24], [-0.29, 0.05]] {
            let (tilt, m, v) = (Tilt::new([a, b]), matrix(a, b), [0.7, -0.4, 0.3]);
            let turned = tilt.turned(v);
            for (i, row) in m.iter().enumerate() {
                assert!((turned[i] - dot(*row, v)).abs() < 3e-16, "{turned:?}");
            }
            let back = tilt.turned_back(turned);
            assert!(back.iter().zip(v).all(|(x, y)| (x - y).abs() < 3e-16), "{back:?}");
            assert!((tilt.crosswise(turned)[0] - v[1]).abs() < 3e-16);
        }
    }

    #[test]
    fn the_frame_turns_about_its_axis_at_the_rate_told() {
        let ([a, b], [da, db], [dda, ddb]) = ([0.2, -0.15], [0.7, 1.3], [-3.0, 2.0]);
        let along = |x: f64, dx: f64| Dual::<1> { re: x, eps: [dx] };
        let moving = Tilt::new([along(a, da), along(b, db)]).across([along(da, dda), along(db, ddb)]);
        let tilt = Tilt::new([a, b]);
        let told = tilt.across([da, db]).own_drift + tilt.own_rate([dda, ddb]);
        assert!((moving.own.eps[0] - told).abs() < 1e-15, "{moving:?} {told}");
    }

    #[test]
    fn moments_over_angles_have_the_power_of_the_moment() {
        let (tilt, moment, rates) = (Tilt::new([0.2, -0.1]), [3.0, -5.0, 0.7], [1.3, 2.1]);
        let [over_a, over_b] = tilt.moments_over_angles(moment);
        let power = dot(moment, tilt.angular_velocity(rates));
        assert!((over_a * rates[0] + over_b * rates[1] - power).abs() < 1e-14 * power.abs());
    }
}
