//! A cage in space: its centre at (x, y, z), the rotation psi about its own axis and the rotation vector (0, a, b) of that.
//!
//! ```text
//! s = centre + c,   c = Exp(0, a, b) (e_x, e_y cos psi - e_z sin psi, e_y sin psi + e_z cos psi)      centre of mass
//! m s'' = F + weight,   M_s = M - c x F
//! w = (w_1, w_2, w_3) in the frame that does not spin, which turns at W = (W_1, w_2, w_3) itself;   w_1 = W_1 + psi'
//! I_p w_1' = M_s1,   I_t w_2' = M_s2 - I_p w_1 w_3 + I_t W_1 w_3,   I_t w_3' = M_s3 + I_p w_1 w_2 - I_t W_1 w_2
//! ```
//!
//! psi counts from the start, so places in pockets are differences of small numbers. There is no singularity below a turn of tilt. Source:
//! Euler's equations; a and b as in `space/solid`.
//!
//! An elastic ring (`bodies/cage/ring_modes`) bends in its own plane, in axes that turn with the cage at w_1: its modes and w_1 follow one
//! Lagrangian, and its angular momentum H about the own axis stands for I_p w_1 above. Left out are bending out of that plane, and what
//! the waves change of I_t: some 1.5 A/a of it, by an amplitude A of order 2 on the neutral radius a. Energy and angular momentum are exact.

use super::{ALONG, TILTS};
use crate::bodies::cage::{RingModes, of_mode};
use crate::bodies::{BodyEnergy, CENTRE, Coordinate, ElementSet, Input, InputValues, Moves};
use crate::scalar::{Real, math};
use crate::scene::Scene;
use crate::space::solid::{Moving, Tilt, Vector, cross, difference, dot, scaled, sum};

/// Coordinates of a cage in space.
pub(crate) const OF_CAGE: usize = 6;

/// Their names.
const CAGE_COORDINATES: [Coordinate; OF_CAGE] = [
    ALONG,
    CENTRE[0],
    CENTRE[1],
    Coordinate {
        position: Some(["angle", "rad", "rotation angle about the own axis since the start"]),
        rate: ["speed", "rad/s", "rotation speed about the own axis"],
        moves: Moves::PitchCircle,
    },
    TILTS[0],
    TILTS[1],
];

/// Inputs that are its load: force and moment.
const LOADS: [Input; OF_CAGE] = [
    Input::CageForceX,
    Input::CageForceY,
    Input::CageForceZ,
    Input::CageTorque,
    Input::CageMomentY,
    Input::CageMomentZ,
];

/// The cage of a scene.
#[derive(Debug)]
pub(crate) struct CageInSpace {
    /// m, kg.
    mass: f64,
    /// I_p and I_t, kg m^2.
    inertia: [f64; 2],
    /// Centre of mass in the axes of the cage, m; `None` of a balanced one.
    mass_offset: Option<Vector<f64>>,
    /// Bending of its ring, if it is elastic.
    modes: Option<RingModes>,
    coordinates: Vec<Coordinate>,
}

/// Coordinates of a cage and their rates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CageState<T> {
    pub(crate) position: [T; OF_CAGE],
    pub(crate) rate: [T; OF_CAGE],
}

/// A cage that moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MovingCage<T> {
    /// Of its geometric centre, m.
    pub(crate) centre: Vector<T>,
    pub(crate) tilt: Tilt<T>,
    pub(crate) moving: Moving<T>,
    /// psi, rad, and its rate, rad/s.
    pub(crate) angle: T,
    pub(crate) speed: T,
}

impl<T: Real> CageState<T> {
    /// Its motion.
    pub(crate) fn motion(&self) -> MovingCage<T> {
        let ([x, y, z, angle, a, b], [vx, vy, vz, speed, da, db]) = (self.position, self.rate);
        let tilt = Tilt::new([a, b]);
        let turning = sum(tilt.angular_velocity([da, db]), scaled(tilt.axis, speed));
        let moving = Moving { velocity: [vx, vy, vz], turning };
        MovingCage { centre: [x, y, z], tilt, moving, angle, speed }
    }
}

impl CageInSpace {
    /// That of a scene whose cage moves in space, with pockets where these elements are at the start.
    pub(crate) fn new(scene: &Scene, elements: &ElementSet) -> Option<Self> {
        let cage = scene.cage.as_ref()?;
        let space = cage.space.as_ref()?;
        let by_shape = || space.shape.as_ref().map(|shape| scene.transverse_inertia_of(shape));
        let transverse = space.transverse_inertia.or_else(by_shape)?;
        let across = cage.mass_eccentricity.unwrap_or_default();
        let offset = [space.mass_offset_x, across.y, across.z];
        let bends = cage.elastic_ring.as_ref();
        let modes = bends
            .map(|ring| RingModes::new(ring, cage.mass, elements.pitch_radius, &elements.reference_angles));
        let of_modes = modes.iter().flat_map(RingModes::orders).flat_map(of_mode);
        Some(Self {
            mass: cage.mass,
            inertia: [cage.inertia, transverse],
            mass_offset: (offset != [0.0; 3]).then_some(offset),
            coordinates: CAGE_COORDINATES.into_iter().chain(of_modes).collect(),
            modes,
        })
    }

    /// Its coordinates: [`OF_CAGE`] of the whole body, then those of its modes.
    pub(crate) fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    /// Number of coordinates of its modes; none of a rigid one.
    pub(crate) fn bending(&self) -> usize {
        self.coordinates.len() - OF_CAGE
    }

    /// How the modes displace pocket `j`, outwards and ahead, per unit of each.
    pub(crate) fn displacements(&self, j: usize) -> &[[f64; 2]] {
        self.modes.as_ref().map_or(&[], |modes| modes.displacements(j))
    }

    /// Order and frequency (rad/s) of each mode.
    pub(crate) fn waves(&self) -> Vec<(u32, f64)> {
        self.modes.as_ref().map_or_else(Vec::new, RingModes::frequencies)
    }

    /// Damping of every coordinate of the modes, N s/m.
    pub(crate) fn damping_of_modes(&self) -> impl Iterator<Item = f64> {
        self.modes.iter().flat_map(RingModes::damping)
    }

    /// c in the frame that does not spin, m.
    fn offset<T: Real>(&self, angle: T) -> Option<Vector<T>> {
        self.mass_offset.map(|[x, y, z]| {
            let (sin, cos) = angle.sin_cos();
            [T::constant(x), cos * y - sin * z, sin * y + cos * z]
        })
    }

    /// Force (N) and moment (N m) of the load.
    pub(crate) fn load(&self, inputs: &InputValues) -> [Vector<f64>; 2] {
        let [fx, fy, fz, mx, my, mz] = LOADS.map(|input| inputs.of(input));
        [[fx, fy, fz], [mx, my, mz]]
    }

    /// Accelerations of its coordinates under this force (N) and moment (N m) about its geometric centre and gravity along y and z, m/s^2.
    pub(crate) fn accelerations<T: Real>(
        &self,
        state: &CageState<T>,
        on: [Vector<T>; 2],
        gravity: [f64; 2],
    ) -> [T; OF_CAGE] {
        let [polar, _] = self.inertia;
        self.accelerated(state, on, gravity, |moment, speed| [moment / polar, speed * polar])
    }

    /// The same of one that bends, under these forces over its modes (N) at their coordinates and rates, with the accelerations of its modes.
    pub(crate) fn bent_accelerations<T: Real>(
        &self,
        state: &CageState<T>,
        (on, on_modes): ([Vector<T>; 2], &[T]),
        of_modes: [&[T]; 2],
        gravity: [f64; 2],
        out: &mut [T],
    ) -> [T; OF_CAGE] {
        let Some(modes) = &self.modes else { return self.accelerations(state, on, gravity) };
        let polar = T::constant(self.inertia[0]);
        self.accelerated(state, on, gravity, |moment, speed| {
            let turned = modes.motion([moment, polar, speed], |k| on_modes[k], of_modes, true, out);
            [turned, modes.angular_momentum([polar, speed], of_modes)]
        })
    }

    /// Accelerations where a moment about the own axis (N m) at this speed w_1 (rad/s) gives `turning` as w_1' (rad/s^2), beside the angular
    /// momentum about that axis, N m s.
    #[inline]
    fn accelerated<T: Real>(
        &self,
        state: &CageState<T>,
        [force, moment]: [Vector<T>; 2],
        [gy, gz]: [f64; 2],
        turning: impl FnOnce(T, T) -> [T; 2],
    ) -> [T; OF_CAGE] {
        let ([_, _, _, angle, a, b], [_, _, _, speed, da, db]) = (state.position, state.rate);
        let [_, transverse] = self.inertia;
        let tilt = Tilt::new([a, b]);
        let across = tilt.across([da, db]);
        let offset = self.offset(angle);
        let about_mass = offset.map_or(moment, |c| difference(moment, cross(tilt.turned(c), force)));
        let [m2, m3] = tilt.crosswise(about_mass);
        let [w2, w3] = across.speed;
        let w1 = across.own + speed;
        let [first, momentum] = turning(dot(about_mass, tilt.axis), w1);
        let own = momentum - across.own * transverse;
        let [second, third] = [(m2 - own * w3) / transverse, (m3 + own * w2) / transverse];
        // The rates of the angles that have these rates of w_2 and w_3.
        let [[aa, ab], [_, bb]] = tilt.over_rates();
        let [right_a, right_b] = [second - across.drift[0], third - across.drift[1]];
        let inverse = T::constant(1.0) / (aa * bb - ab * ab);
        let dda = (bb * right_a - ab * right_b) * inverse;
        let ddb = (aa * right_b - ab * right_a) * inverse;
        let spinning = first - across.own_drift - tilt.own_rate([dda, ddb]);
        let [fx, fy, fz] = force;
        let mut centre = [fx / self.mass, fy / self.mass + gy, fz / self.mass + gz];
        if let Some(c) = offset {
            // The centre of the cage turns about that of its mass.
            let w = [w1, w2, w3];
            let turning = [first, second + w3 * speed, third - w2 * speed];
            let drawn = sum(cross(turning, c), cross(w, cross(w, c)));
            centre = difference(centre, tilt.turned(drawn));
        }
        let [x, y, z] = centre;
        [x, y, z, spinning, dda, ddb]
    }

    /// Energy of its motion, of its modes at these coordinates and rates, and of its weight, J.
    pub(crate) fn energy(
        &self,
        state: &CageState<f64>,
        of_modes: [&[f64]; 2],
        gravity: [f64; 2],
    ) -> BodyEnergy {
        let moving = state.motion();
        let [_, _, _, angle, _, _] = state.position;
        let [polar, transverse] = self.inertia;
        let mut centre = moving.centre;
        let mut velocity = moving.moving.velocity;
        if let Some(c) = self.offset(angle) {
            let c = moving.tilt.turned(c);
            centre = sum(centre, c);
            velocity = sum(velocity, cross(moving.moving.turning, c));
        }
        let own = dot(moving.moving.turning, moving.tilt.axis);
        let [w2, w3] = moving.tilt.crosswise(moving.moving.turning);
        let turning = polar * own * own + transverse * (w2 * w2 + w3 * w3);
        let [bending, elastic] = self.modes.as_ref().map_or([0.0; 2], |modes| modes.energy(own, of_modes));
        BodyEnergy {
            kinetic: 0.5 * (self.mass * dot(velocity, velocity) + turning) + bending,
            elastic,
            potential: BodyEnergy::of_weight(self.mass, gravity, [centre[1], centre[2]]),
        }
    }

    /// Angular momentum about its centre of mass, N m s.
    #[cfg(test)]
    pub(crate) fn angular_momentum(&self, state: &CageState<f64>, of_modes: [&[f64]; 2]) -> Vector<f64> {
        let moving = state.motion();
        let (turning, axis) = (moving.moving.turning, moving.tilt.axis);
        let [polar, transverse] = self.inertia;
        let own = dot(turning, axis);
        let about_axis =
            self.modes.as_ref().map_or(polar * own, |modes| modes.angular_momentum([polar, own], of_modes));
        sum(scaled(turning, transverse), scaled(axis, about_axis - transverse * own))
    }

    /// Weight: force (N) and its moment about the geometric centre, N m.
    pub(crate) fn weight(&self, moving: &MovingCage<f64>, [gy, gz]: [f64; 2]) -> [Vector<f64>; 2] {
        let force = [0.0, self.mass * gy, self.mass * gz];
        let moment = self.offset(moving.angle).map_or([0.0; 3], |c| cross(moving.tilt.turned(c), force));
        [force, moment]
    }

    /// Largest frequency that a stiffness (N/m) at the distance `lever` (m) from its centre gives it, which also bends its ring, rad/s.
    pub(crate) fn frequency_on(&self, stiffness: f64, lever: f64) -> f64 {
        let yields: f64 = self.modes.as_ref().map_or(0.0, RingModes::mobility);
        let [polar, transverse] = self.inertia;
        let least = polar.min(transverse);
        (stiffness * (1.0 / self.mass + lever * lever / least + yields)).sqrt()
    }

    /// m, kg.
    pub(crate) fn mass(&self) -> f64 {
        self.mass
    }
}

/// Angle of the tilt of these coordinates, rad.
pub(crate) fn tilt_of(position: &[f64; OF_CAGE]) -> f64 {
    math::hypot(position[4], position[5])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{ElasticRing, RingStiffness};

    fn cage(mass_offset: Option<Vector<f64>>) -> CageInSpace {
        let coordinates = CAGE_COORDINATES.to_vec();
        CageInSpace { mass: 0.012, inertia: [2.57e-5, 1.6e-5], mass_offset, modes: None, coordinates }
    }

    const STATE: CageState<f64> = CageState {
        position: [1e-4, -2e-4, 1e-4, 0.7, 3e-3, -5e-3],
        rate: [0.1, 0.3, -0.2, 140.0, 2.0, -3.0],
    };

    /// Steps of the classical fourth order.
    fn moved(cage: &CageInSpace, state: CageState<f64>, h: f64, steps: usize) -> CageState<f64> {
        let slope = |s: &CageState<f64>| (s.rate, cage.accelerations(s, [[0.0; 3]; 2], [0.0; 2]));
        let add = |s: &CageState<f64>, (v, a): &([f64; 6], [f64; 6]), h: f64| CageState {
            position: std::array::from_fn(|k| s.position[k] + h * v[k]),
            rate: std::array::from_fn(|k| s.rate[k] + h * a[k]),
        };
        (0..steps).fold(state, |s, _| {
            let a = slope(&s);
            let b = slope(&add(&s, &a, 0.5 * h));
            let c = slope(&add(&s, &b, 0.5 * h));
            let d = slope(&add(&s, &c, h));
            let mean = |[a, b, c, d]: [[f64; 6]; 4]| {
                std::array::from_fn(|k| (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]) / 6.0)
            };
            add(&s, &(mean([a.0, b.0, c.0, d.0]), mean([a.1, b.1, c.1, d.1])), h)
        })
    }

    #[test]
    fn a_cage_alone_precesses_about_its_angular_momentum() {
        let body = cage(None);
        let before = body.angular_momentum(&STATE, [&[]; 2]);
        let size = dot(before, before).sqrt();
        let along = before.map(|x| x / size);
        let axis = |s: &CageState<f64>| s.motion().tilt.axis;
        // Component of the axis across the angular momentum, as an angle about it.
        let first = difference(axis(&STATE), scaled(along, dot(axis(&STATE), along)));
        let time = 10e-3;
        let after = moved(&body, STATE, 1e-6, 10_000);
        let found = difference(axis(&after), scaled(along, dot(axis(&after), along)));
        let turned = math::atan2(dot(cross(first, found), along), dot(first, found));
        let expected = size / body.inertia[1] * time;
        let wrapped = (turned - expected).rem_euclid(std::f64::consts::TAU);
        let error = wrapped.min(std::f64::consts::TAU - wrapped);
        assert!(error < 1e-9 * expected, "{turned} {expected}: {error:e}");
        let rest = difference(body.angular_momentum(&after, [&[]; 2]), before);
        assert!(dot(rest, rest).sqrt() < 1e-12 * size, "{rest:?}");
        assert!((dot(found, found) / dot(first, first) - 1.0).abs() < 1e-9);
    }

    /// At any state: rates of both along the motion, by differences.
    #[test]
    fn a_bent_cage_alone_keeps_energy_and_angular_momentum() {
        let ring = ElasticRing {
            modes: 4,
            neutral_radius: 45e-3,
            stiffness: RingStiffness::Bending(0.26),
            damping: 0.0,
            growth: 0.0,
            contact_depth: 1e-6,
        };
        let modes = RingModes::new(&ring, 0.012, 45e-3, &[0.0, 1.0]);
        let body = CageInSpace { modes: Some(modes), ..cage(None) };
        let mut random = fastrand::Rng::with_seed(3);
        for _ in 0..20 {
            let mut near = |size: f64| -> Vec<f64> { (0..6).map(|_| size * (random.f64() - 0.5)).collect() };
            let (q, v) = (near(1e-3), near(2.0));
            let mut out = [0.0; 6];
            let on = ([[0.0; 3]; 2], &[0.0; 6][..]);
            let own = body.bent_accelerations(&STATE, on, [&q, &v], [0.0; 2], &mut out);
            let at = |s: f64| {
                let moved = |x: &[f64], rate: &[f64]| -> Vec<f64> {
                    x.iter().zip(rate).map(|(x, rate)| x + s * rate).collect()
                };
                let state = CageState {
                    position: std::array::from_fn(|k| STATE.position[k] + s * STATE.rate[k]),
                    rate: std::array::from_fn(|k| STATE.rate[k] + s * own[k]),
                };
                let (q, v) = (moved(&q, &v), moved(&v, &out));
                let energy = body.energy(&state, [&q, &v], [0.0; 2]);
                let [x, y, z] = body.angular_momentum(&state, [&q, &v]);
                [energy.kinetic + energy.elastic, x, y, z]
            };
            let ([low, high], size) = ([-1e-8, 1e-8].map(at), at(0.0));
            for k in 0..4 {
                let rate = (high[k] - low[k]) / 2e-8;
                let unit = if k == 0 { size[0] } else { size[1] };
                assert!(rate.abs() < 1e-4 * unit, "{k}: {rate} of {size:?}");
            }
        }
    }

    #[test]
    fn the_mass_of_an_unbalanced_cage_flies_straight() {
        let body = cage(Some([2e-4, -1e-4, 3e-4]));
        let mass_at = |s: &CageState<f64>| {
            let m = s.motion();
            sum(m.centre, m.tilt.turned(body.offset(m.angle).unwrap()))
        };
        let velocity = |s: &CageState<f64>| {
            let m = s.motion();
            let c = m.tilt.turned(body.offset(m.angle).unwrap());
            sum(m.moving.velocity, cross(m.moving.turning, c))
        };
        let after = moved(&body, STATE, 1e-6, 2000);
        let (from, speed, to) = (mass_at(&STATE), velocity(&STATE), mass_at(&after));
        for k in 0..3 {
            assert!((to[k] - from[k] - 2e-3 * speed[k]).abs() < 1e-13, "{k}: {from:?} {to:?}");
        }
        let energy = |s: &CageState<f64>| body.energy(s, [&[]; 2], [0.0; 2]).kinetic;
        assert!((energy(&after) / energy(&STATE) - 1.0).abs() < 1e-12);
    }
}
