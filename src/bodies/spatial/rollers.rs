//! Rollers with six freedoms, each at (x, r_p + rho, psi) in cylindrical coordinates about the axis of the bearing; its axis is turned by the
//! rotation vector (0, sigma, tau) in the axes (x, outwards, ahead) of its azimuth, sigma skew and tau tilt.
//!
//! ```text
//! m x'' = F_x,   m (rho'' - r psi'^2) = F_r,   m (r psi'' + 2 rho' psi') = F_psi,   r = r_p + rho
//! u = (1 - A1 q^2, s tau, -s sigma)                                              axis
//! w_2 = (D (sigma', tau'))_1 - psi' u_r,   w_3 = (D (sigma', tau'))_2 - psi' u_psi    across it, w_1 about it, in the frame that does not spin
//! I_a w_1' = M_1,   I_t w_2' = M_2 - I_a w_1 w_3 + I_t W_1 w_3,   I_t w_3' = M_3 + I_a w_1 w_2 - I_t W_1 w_2
//! ```
//!
//! D and W_1 as in `space/solid`, with psi' u_x in W_1. The speeds of a roller are x', rho', psi', sigma', tau' and w_1. Forces of contacts are kept
//! **over these speeds**: f = T^T (F, M), T from speeds to velocity and angular velocity. The spin angle enters no force, and what does not turn
//! a roller about its own axis has a force over w_1 of exactly zero. Zero angles give the plane term by term. The axis of a tapered roller is inclined:
//! sigma and tau turn it in axes that are turned by gamma about the direction ahead, in which e_x is (cos gamma, -sin gamma, 0) and u_r and u_psi above are
//! less e_x along the axes 2 and 3 of the frame. Source: Euler's equations.

use super::AXIAL_OFFSET;
use crate::bodies::elements::{ORBIT_TRAVEL, RADIAL_OFFSET, SPIN_SPEED};
use crate::bodies::{Coordinate, ElementSet, Moves};
use crate::scalar::{Base, Numeric, Of, math};
use crate::scene::Scene;
use crate::space::solid::{Moving, Tilt, Vector, cross, difference, dot, mapped, scaled, sum};

/// Speeds of a roller.
pub(crate) const OF_ROLLER: usize = 6;
/// Places of them.
pub(crate) const ORBIT: usize = 2;
pub(crate) const SPIN: usize = 5;

const COORDINATES: [Coordinate; OF_ROLLER] = [
    AXIAL_OFFSET,
    RADIAL_OFFSET,
    ORBIT_TRAVEL,
    Coordinate {
        position: Some([
            "skew",
            "rad",
            "rotation vector of its axis, outwards: its +x end is at smaller angles where positive",
        ]),
        rate: ["skew_speed", "rad/s", "rate of the skew"],
        moves: Moves::Surface,
    },
    Coordinate {
        position: Some([
            "tilt",
            "rad",
            "rotation vector of its axis, along the orbit: its +x end is outside where positive",
        ]),
        rate: ["tilt_speed", "rad/s", "rate of the tilt"],
        moves: Moves::Surface,
    },
    SPIN_SPEED,
];

/// Place of a roller in the axes of its azimuth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RollerPlace<T> {
    /// x, m along the axis of the bearing.
    pub(crate) x: T,
    /// rho, m outside the pitch circle.
    pub(crate) rho: T,
    /// u.
    pub(crate) axis: Vector<T>,
}

/// A roller that moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MovingRoller<T> {
    /// x, rho and the axis u.
    pub(crate) place: RollerPlace<T>,
    /// Velocity of its centre and angular velocity with its spin.
    pub(crate) moving: Moving<T>,
}

impl<T> MovingRoller<T> {
    /// The same of what `f` makes of every number.
    #[inline(always)]
    pub(crate) fn map<U>(self, f: impl Fn(T) -> U + Copy) -> MovingRoller<U> {
        let RollerPlace { x, rho, axis } = self.place;
        MovingRoller {
            place: RollerPlace { x: f(x), rho: f(rho), axis: mapped(axis, f) },
            moving: self.moving.map(f),
        }
    }
}

/// Place and speeds of a roller, in the axes of its azimuth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RollerState<T> {
    /// x and rho, m.
    pub(crate) at: [T; 2],
    /// sigma and tau, rad.
    pub(crate) angles: [T; 2],
    /// x', rho', psi', sigma', tau', w_1.
    pub(crate) speeds: [T; OF_ROLLER],
    /// r, m.
    pub(crate) r: T,
    /// Orientation of the axis in the inclined axes.
    tilt: Tilt<T>,
    /// u.
    pub(crate) axis: Vector<T>,
    /// gamma.
    inclination: Inclination,
}

/// How the axes in which a roller skews and tilts are inclined: sine and cosine of gamma, which turns about the direction ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Inclination {
    pub(crate) sin: f64,
    pub(crate) cos: f64,
}

impl Inclination {
    /// That of cylindrical rollers.
    pub(crate) const NONE: Self = Self { sin: 0.0, cos: 1.0 };

    /// By this angle, rad.
    pub(crate) fn new(angle: f64) -> Self {
        let (sin, cos) = math::sin_cos(angle);
        Self { sin, cos }
    }

    /// This and another angle, which counts by 1 or -1, together.
    pub(crate) fn turned_by(self, other: Self, by: f64) -> Self {
        let sin = self.sin * other.cos + by * self.cos * other.sin;
        Self { sin, cos: self.cos * other.cos - by * self.sin * other.sin }
    }

    /// A vector of the inclined axes in those of the azimuth.
    #[inline(always)]
    pub(crate) fn turned<T: Numeric>(&self, [x, r, t]: Vector<T>) -> Vector<T> {
        [x * self.cos - r * self.sin, x * self.sin + r * self.cos, t]
    }

    /// A vector of the axes of the azimuth in the inclined ones.
    #[inline(always)]
    fn turned_back<T: Numeric>(&self, [x, r, t]: Vector<T>) -> Vector<T> {
        [x * self.cos + r * self.sin, r * self.cos - x * self.sin, t]
    }
}

/// Rollers with states of their own.
#[derive(Debug)]
pub(crate) struct RollersInSpace {
    /// Mass, kg, and moments of inertia about and across the axis, kg m^2, of each.
    inertia: Vec<[f64; 3]>,
    pub(crate) inclination: Inclination,
}

impl<T: Numeric> RollerState<T> {
    /// That at this place (m), with these angles (rad) and speeds, of a roller that is inclined like this.
    #[inline(always)]
    pub(crate) fn new(
        (pitch_radius, inclination): (f64, Inclination),
        at: [T; 2],
        angles: [T; 2],
        speeds: [T; OF_ROLLER],
    ) -> Self {
        let tilt = Tilt::new(angles);
        let axis = inclination.turned(tilt.axis);
        Self { at, angles, speeds, r: at[1] + pitch_radius, tilt, axis, inclination }
    }

    /// Its motion.
    #[inline(always)]
    pub(crate) fn motion(&self) -> MovingRoller<T> {
        let place = RollerPlace { x: self.at[0], rho: self.at[1], axis: self.axis };
        MovingRoller { place, moving: self.moved(self.speeds) }
    }

    /// Velocity and angular velocity by these speeds: T.
    #[inline(always)]
    pub(crate) fn moved(&self, [x, rho, orbit, skew, tilt, spin]: [T; OF_ROLLER]) -> Moving<T> {
        let axis = self.axis;
        let mut turning = self.turning([skew, tilt]);
        turning[0] += orbit;
        // The frame turns about the own axis as it likes: w_1 is absolute.
        let own = spin - dot(turning, axis);
        Moving { velocity: [x, rho, self.r * orbit], turning: sum(turning, scaled(axis, own)) }
    }

    /// Angular velocity of its axis by these rates of skew and tilt alone, rad/s.
    #[inline(always)]
    pub(crate) fn turning(&self, rates: [T; 2]) -> Vector<T> {
        self.inclination.turned(self.tilt.angular_velocity(rates))
    }

    /// e_x times a number in the inclined axes.
    #[inline(always)]
    fn orbiting(&self, speed: T) -> Vector<T> {
        [speed * self.inclination.cos, -(speed * self.inclination.sin), speed.like(0.0)]
    }

    /// Forces over the speeds by a force (N) and a moment (N m) about its centre, of which `own` acts about its axis: T^T.
    #[inline(always)]
    pub(crate) fn over_speeds(&self, [force, moment]: [Vector<T>; 2], own: T) -> [T; OF_ROLLER] {
        let axis = self.axis;
        let across = difference(moment, scaled(axis, dot(moment, axis)));
        let [skew, tilt] = self.tilt.moments_over_angles(self.inclination.turned_back(across));
        [force[0], force[1], self.r * force[2] + across[0], skew, tilt, own]
    }

    /// Rates of the speeds by forces over them alone: the inverse inertia.
    #[inline(always)]
    pub(crate) fn accelerated<B: Base>(
        &self,
        [mass, polar, transverse]: [B; 3],
        [x, rho, orbit, skew, tilt, spin]: [T; OF_ROLLER],
    ) -> [T; OF_ROLLER]
    where
        T: Of<B>,
    {
        let [u, w] = self.tilt.crosswise(self.orbiting(-orbit.like(1.0)));
        let [[aa, ab], [_, bb]] = self.tilt.over_rates();
        let inverse = orbit.like(1.0) / (aa * bb - ab * ab);
        let solved = |a: T, b: T| [(bb * a - ab * b) * inverse, (aa * b - ab * a) * inverse];
        let [m2, m3] = solved(skew, tilt);
        let around = (orbit + m2 * u + m3 * w) / (self.r * self.r * mass);
        let [dda, ddb] = solved(m2 / transverse + around * u, m3 / transverse + around * w);
        [x / mass, rho / mass, around, dda, ddb, spin / polar]
    }

    /// Rates of the speeds without any force but gravity outwards and along the orbit, m/s^2.
    #[inline(always)]
    pub(crate) fn drift<B: Base>(
        &self,
        [_, polar, transverse]: [B; 3],
        [outwards, ahead]: [T; 2],
    ) -> [T; OF_ROLLER]
    where
        T: Of<B>,
    {
        let [_, rho, orbit, skew, tilt, spin] = self.speeds;
        let across = self.tilt.across([skew, tilt]);
        let against = self.orbiting(-orbit.like(1.0));
        let [u, w] = self.tilt.crosswise(against);
        // Their rates, as the axes of its frame turn.
        let [du, dw] = self.tilt.crosswise(cross(against, self.tilt.angular_velocity([skew, tilt])));
        let w2 = across.speed[0] - orbit * u;
        let w3 = across.speed[1] - orbit * w;
        let own = across.own + orbit * self.axis[0];
        let around = (ahead - rho * orbit * 2.0) / self.r;
        let gyration = spin * polar / transverse - own;
        let right_a = -(gyration * w3) - across.drift[0] + around * u + orbit * du;
        let right_b = gyration * w2 - across.drift[1] + around * w + orbit * dw;
        let [[aa, ab], [_, bb]] = self.tilt.over_rates();
        let inverse = orbit.like(1.0) / (aa * bb - ab * ab);
        let dda = (bb * right_a - ab * right_b) * inverse;
        let ddb = (aa * right_b - ab * right_a) * inverse;
        let zero = orbit.like(0.0);
        [zero, self.r * orbit * orbit + outwards, around, dda, ddb, zero]
    }
}

impl RollersInSpace {
    /// Those of a scene that has them.
    pub(crate) fn new(scene: &Scene, set: &ElementSet) -> Option<Self> {
        let rollers = scene.rollers.as_ref()?;
        let space = rollers.space.as_ref()?;
        let solid =
            rollers.mass * (3.0 * rollers.radius * rollers.radius + space.length * space.length) / 12.0;
        let transverse = space.transverse_inertia.unwrap_or(solid);
        let inclination =
            space.taper.as_ref().map_or(Inclination::NONE, |taper| Inclination::new(taper.inclination()));
        Some(Self { inertia: vec![[rollers.mass, rollers.inertia, transverse]; set.count], inclination })
    }

    /// Its coordinates.
    pub(crate) fn coordinates(&self) -> &'static [Coordinate] {
        &COORDINATES
    }

    /// Mass (kg) and moments of inertia (kg m^2) about and across the axis of roller `j`.
    pub(crate) fn inertia(&self, j: usize) -> [f64; 3] {
        self.inertia[j]
    }

    /// Energy of its motion, J.
    pub(crate) fn kinetic_energy(&self, j: usize, state: &RollerState<f64>) -> f64 {
        let [mass, polar, transverse] = self.inertia[j];
        let Moving { velocity, turning } = state.moved(state.speeds);
        let own = state.speeds[SPIN];
        let across = difference(turning, scaled(state.axis, own));
        0.5 * (mass * dot(velocity, velocity) + polar * own * own + transverse * dot(across, across))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    const PITCH: f64 = 0.04;
    const INERTIA: [f64; 3] = [0.0304, 8.55e-7, 1.66e-6];

    /// x, rho, psi, sigma, tau, then the speeds.
    type Point = [f64; 11];

    /// Of a cylinder, and of a cone that is inclined much.
    const INCLINATIONS: [f64; 2] = [0.0, 0.4];

    fn state(p: &Point, inclination: f64) -> RollerState<f64> {
        let base = (PITCH, Inclination::new(inclination));
        RollerState::new(base, [p[0], p[1]], [p[3], p[4]], std::array::from_fn(|k| p[5 + k]))
    }

    fn moved(start: Point, inclination: f64, h: f64, steps: usize) -> Point {
        let slope = |p: &Point| {
            let a = state(p, inclination).drift(INERTIA, [0.0; 2]);
            std::array::from_fn(|k| if k < 5 { p[5 + k] } else { a[k - 5] })
        };
        let add = |p: &Point, d: &Point, h: f64| -> Point { std::array::from_fn(|k| p[k] + h * d[k]) };
        (0..steps).fold(start, |p, _| {
            let a: Point = slope(&p);
            let b: Point = slope(&add(&p, &a, 0.5 * h));
            let c: Point = slope(&add(&p, &b, 0.5 * h));
            let d: Point = slope(&add(&p, &c, h));
            std::array::from_fn(|k| p[k] + h * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]) / 6.0)
        })
    }

    /// In axes that stand still.
    fn global([x, r, t]: Vector<f64>, psi: f64) -> Vector<f64> {
        [x, r * psi.cos() - t * psi.sin(), r * psi.sin() + t * psi.cos()]
    }

    fn centre(p: &Point) -> Vector<f64> {
        global([p[0], PITCH + p[1], 0.0], p[2])
    }

    fn axis(p: &Point, inclination: f64) -> Vector<f64> {
        global(state(p, inclination).axis, p[2])
    }

    fn angular_momentum(p: &Point, inclination: f64) -> Vector<f64> {
        let s = state(p, inclination);
        let turning = s.moved(s.speeds).turning;
        let [_, polar, transverse] = INERTIA;
        let own = scaled(s.axis, (polar - transverse) * s.speeds[SPIN]);
        global(sum(scaled(turning, transverse), own), p[2])
    }

    #[test]
    fn a_free_roller_goes_straight_and_precesses_about_its_angular_momentum() {
        let start = [1e-4, 2e-5, 0.3, 0.1, -0.08, 0.2, -0.3, 127.0, 40.0, -45.0, 800.0];
        let time = 5e-3;
        for inclination in INCLINATIONS {
            let end = moved(start, inclination, 2.5e-7, 20_000);
            let s = state(&start, inclination);
            let velocity = global(s.moved(s.speeds).velocity, start[2]);
            let off = difference(difference(centre(&end), centre(&start)), scaled(velocity, time));
            assert!(dot(off, off).sqrt() < 1e-13, "{off:?}");
            let [before, after] = [&start, &end].map(|p| angular_momentum(p, inclination));
            let rest = difference(after, before);
            let size = dot(before, before).sqrt();
            assert!(dot(rest, rest).sqrt() < 1e-12 * size, "{rest:?} {before:?}");
            // The axis turns about H at |H|/I_t.
            let along = scaled(before, 1.0 / size);
            let across = |v: Vector<f64>| difference(v, scaled(along, dot(v, along)));
            let [first, last] = [&start, &end].map(|p| across(axis(p, inclination)));
            let turned = dot(cross(first, last), along).atan2(dot(first, last));
            let expected = size / INERTIA[2] * time;
            let error = (turned - expected).rem_euclid(TAU);
            assert!(error.min(TAU - error) < 1e-9, "{turned} {expected}");
            assert_eq!(end[5 + SPIN], start[5 + SPIN]);
        }
    }

    const POINT: Point = [1e-4, 2e-5, 0.3, 0.1, -0.08, 0.2, -0.3, 127.0, 40.0, -45.0, 800.0];

    #[test]
    fn forces_over_the_speeds_have_the_power_of_the_wrench() {
        for inclination in INCLINATIONS {
            let s = state(&POINT, inclination);
            let (force, moment) = ([3.0, -5.0, 7.0], [0.2, 0.5, -0.4]);
            let over = s.over_speeds([force, moment], dot(moment, s.axis));
            let power: f64 = over.iter().zip(s.speeds).map(|(f, v)| f * v).sum();
            let Moving { velocity, turning } = s.moved(s.speeds);
            let expected = dot(force, velocity) + dot(moment, turning);
            assert!((power - expected).abs() < 1e-12 * expected.abs(), "{power} {expected}");
        }
    }

    #[test]
    fn the_power_of_forces_is_the_change_of_energy() {
        let p = POINT;
        let (force, moment) = ([3.0, -5.0, 7.0], [0.2, 0.5, -0.4]);
        for angle in INCLINATIONS {
            let inclination = Inclination::new(angle);
            let rollers = RollersInSpace { inertia: vec![INERTIA], inclination };
            let s = state(&p, angle);
            let over = s.over_speeds([force, moment], dot(moment, s.axis));
            let by_force = s.accelerated(INERTIA, over);
            let drift = s.drift(INERTIA, [0.0; 2]);
            let h = 1e-7;
            let at = |h: f64| {
                let next: Point = std::array::from_fn(|k| {
                    if k < 5 { p[k] + h * p[5 + k] } else { p[k] + h * (by_force[k - 5] + drift[k - 5]) }
                });
                rollers.kinetic_energy(0, &state(&next, angle))
            };
            let gained = (at(h) - at(-h)) / (2.0 * h);
            let power: f64 = over.iter().zip(s.speeds).map(|(f, v)| f * v).sum();
            assert!((gained - power).abs() < 1e-6 * power.abs(), "{gained} {power}");
        }
    }

    #[test]
    fn without_angles_it_is_the_plane() {
        let s = state(&[0.0, 2e-5, 0.3, 0.0, 0.0, 0.0, -0.3, 127.0, 0.0, 0.0, 800.0], 0.0);
        let over = s.over_speeds([[0.0, -5.0, 7.0], [0.4, 0.0, 0.0]], 0.4);
        let (a, drift) = (s.accelerated(INERTIA, over), s.drift(INERTIA, [1.0, 2.0]));
        let [mass, polar, _] = INERTIA;
        let r = PITCH + 2e-5;
        let expected = [
            0.0,
            -5.0 / mass + r * 127.0 * 127.0 + 1.0,
            (7.0 / mass + 2.0 * 0.3 * 127.0 + 2.0) / r,
            0.0,
            0.0,
            0.4 / polar,
        ];
        for (k, expected) in expected.into_iter().enumerate() {
            assert!((a[k] + drift[k] - expected).abs() <= 1e-15 * expected.abs(), "{k}");
        }
    }
}
