//! An inner ring in space, at (x, y, z) with the rotation vector (0, a, b) of its axis; each of these is free, held, or prescribed over time.
//!
//! ```text
//! m v' = F + load + spring + weight - c v
//! w = B (a', b')   across the axis, in the frame that does not spin;   W_1 its turning about the axis,   w_1 = W_1 + Omega
//! I_t w_2' = M_2 - I_p w_1 w_3 + I_t W_1 w_3,   I_t w_3' = M_3 + I_p w_1 w_2 - I_t W_1 w_2
//! ```
//!
//! Omega, relative to that frame, is prescribed: a ring that does not tilt turns about its own axis. The equations hold along the free
//! angles; moments of the supports act over the rates of the angles. What turns the ring is no state: its energy is not counted, and it
//! takes the moment M_1. Source: Euler's equations; a, b as in `space/solid`.

use super::{ALONG, OF_RING, TILTS};
use crate::bodies::{BodyEnergy, CENTRE, Coordinate, Input, InputValues, PLACES};
use crate::error::Result;
use crate::scalar::Numeric;
use crate::scene::{Preload, RingCoordinate, RingMotion, Scene, SpatialRing, bad_scene};
use crate::space::solid::{Moving, Tilt, Vector, mapped, scaled, sum, to_local};

/// Coordinates of a ring in space.
pub(crate) const RING_COORDINATES: [Coordinate; OF_RING] = [ALONG, CENTRE[0], CENTRE[1], TILTS[0], TILTS[1]];

/// Inputs that are its load, by coordinate.
const LOADS: [Input; OF_RING] = [Input::LoadX, Input::LoadY, Input::LoadZ, Input::MomentY, Input::MomentZ];

/// The inner ring of a scene.
#[derive(Debug)]
pub(crate) struct RingInSpace {
    /// By coordinate: where it is held, or is at the start where it is prescribed, m or rad; `None` of one that is free.
    pub(crate) held: [Option<f64>; OF_RING],
    /// By coordinate: whether it is prescribed over time.
    prescribed: [bool; OF_RING],
    preload: Option<Preload>,
    /// m, kg, and I_p and I_t, kg m^2; zero where the scene has none, and nothing that is free needs them.
    mass: f64,
    inertia: [f64; 2],
    /// Of the supports for the centre, N s/m, and for tilts, N m s.
    damping: [f64; 2],
}

/// Coordinates of a ring and their rates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RingState<T> {
    pub(crate) position: [T; OF_RING],
    pub(crate) rate: [T; OF_RING],
    /// Second rates of those that are prescribed; zero for others.
    pub(crate) given: [T; OF_RING],
    /// Omega, rad/s.
    pub(crate) speed: T,
}

/// A ring that moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MovingRing<T> {
    /// O, m.
    pub(crate) centre: Vector<T>,
    /// a.
    pub(crate) axis: Vector<T>,
    pub(crate) moving: Moving<T>,
    /// w_1, rad/s.
    pub(crate) speed: T,
}

impl<T> MovingRing<T> {
    /// The same of what `f` makes of every number.
    #[inline(always)]
    pub(crate) fn map<U>(self, f: impl Fn(T) -> U + Copy) -> MovingRing<U> {
        let Self { centre, axis, moving, speed } = self;
        MovingRing {
            centre: mapped(centre, f),
            axis: mapped(axis, f),
            moving: moving.map(f),
            speed: f(speed),
        }
    }
}

impl MovingRing<f64> {
    /// As it is seen in the axes of the azimuth with this cosine and sine.
    #[inline(always)]
    pub(crate) fn beside<T: Numeric>(&self, direction: [T; 2]) -> MovingRing<T> {
        let Moving { velocity, turning } = self.moving;
        MovingRing {
            centre: to_local(self.centre, direction),
            axis: to_local(self.axis, direction),
            moving: Moving { velocity: to_local(velocity, direction), turning: to_local(turning, direction) },
            speed: direction[0].like(self.speed),
        }
    }
}

impl<T: Numeric> RingState<T> {
    /// Its motion.
    #[inline(always)]
    pub(crate) fn motion(&self) -> MovingRing<T> {
        let ([x, y, z, a, b], [vx, vy, vz, da, db]) = (self.position, self.rate);
        let tilt = Tilt::new([a, b]);
        let turning = sum(tilt.angular_velocity([da, db]), scaled(tilt.axis, self.speed));
        let speed = tilt.across([da, db]).own + self.speed;
        MovingRing {
            centre: [x, y, z],
            axis: tilt.axis,
            moving: Moving { velocity: [vx, vy, vz], turning },
            speed,
        }
    }
}

impl RingInSpace {
    /// The inner ring of a scene.
    pub(crate) fn new(scene: &Scene) -> Self {
        let at = |held| Self {
            held,
            prescribed: [false; OF_RING],
            preload: None,
            mass: 0.0,
            inertia: [0.0; 2],
            damping: [0.0; 2],
        };
        match scene.inner_ring.as_ref().map(|ring| &ring.motion) {
            Some(RingMotion::Space(ring)) => {
                let held = ring.coordinates().map(|(_, coordinate)| match coordinate {
                    RingCoordinate::Free => None,
                    RingCoordinate::Held(value) => Some(*value),
                    RingCoordinate::Prescribed(signal) => Some(signal.at(0.0)),
                });
                Self {
                    prescribed: ring.coordinates().map(|(_, coordinate)| coordinate.prescribed().is_some()),
                    preload: ring.preload,
                    mass: ring.mass.unwrap_or(0.0),
                    inertia: ring.inertia.map_or([0.0; 2], |inertia| [inertia.polar, inertia.transverse]),
                    damping: [ring.support_damping, ring.tilt_damping].map(|c| c.unwrap_or(0.0)),
                    ..at(held)
                }
            }
            Some(RingMotion::Fixed(place)) => at([0.0, place.y, place.z, 0.0, 0.0].map(Some)),
            Some(RingMotion::Prescribed(motion)) => Self {
                prescribed: [false, true, true, false, false],
                ..at([0.0, motion.y.at(0.0), motion.z.at(0.0), 0.0, 0.0].map(Some))
            },
            _ => at([Some(0.0); OF_RING]),
        }
    }

    /// Whether a scene has what its motion over time needs.
    ///
    /// # Errors
    /// [`crate::Status::BadScene`].
    pub(crate) fn can_move(scene: &Scene) -> Result<()> {
        let Some(RingMotion::Space(ring)) = scene.inner_ring.as_ref().map(|ring| &ring.motion) else {
            return Ok(());
        };
        let SpatialRing { mass, inertia, .. } = &**ring;
        let free = ring.coordinates().into_iter().filter(|(_, c)| **c == RingCoordinate::Free);
        for (name, _) in free {
            let (field, present) = match name.starts_with("tilt") {
                true => ("inertia", inertia.is_some()),
                false => ("mass", mass.is_some()),
            };
            if !present {
                let text = format!("missing; motion over time needs it where '{name}' is free");
                return Err(bad_scene(&format!("inner_ring.motion.space.{field}"), text));
            }
        }
        Ok(())
    }

    /// Whether a coordinate is prescribed over time.
    pub(crate) fn is_moved(&self) -> bool {
        self.prescribed.contains(&true)
    }

    /// Its coordinates that are free, by their places among all.
    pub(crate) fn free(&self) -> impl Iterator<Item = usize> {
        let held = self.held;
        (0..OF_RING).filter(move |k| held[*k].is_none())
    }

    /// Forces (N) and moments (N m) of the load, beside the spring.
    pub(crate) fn load(&self, inputs: &InputValues) -> [f64; OF_RING] {
        LOADS.map(|input| inputs.of(input))
    }

    /// Force (N) of the spring along the axis with the ring at `x` (m), and its stiffness (N/m).
    pub(crate) fn spring(&self, x: f64) -> [f64; 2] {
        self.preload.map_or([0.0; 2], |spring| [spring.force - spring.stiffness * x, spring.stiffness])
    }

    /// Of its prescribed coordinates the first to third rates, from the rates of the inputs; zero of others.
    pub(crate) fn given(&self, rates: &InputValues) -> [[f64; OF_RING]; 3] {
        let of = |which: usize| std::array::from_fn(|k| rates.of(PLACES[k][which]));
        [of(0), of(1), std::array::from_fn(|k| rates.second[k])]
    }

    /// All coordinates and their rates, from those that are free.
    pub(crate) fn state(&self, q: &[f64], v: &[f64], inputs: &InputValues) -> RingState<f64> {
        let (mut position, mut rate) = (self.held.map(|held| held.unwrap_or(0.0)), [0.0; OF_RING]);
        let mut given = [0.0; OF_RING];
        for (k, [place, speed]) in PLACES.into_iter().enumerate().take(OF_RING) {
            if self.prescribed[k] {
                (position[k], rate[k], given[k]) = (inputs.of(place), inputs.of(speed), inputs.second[k]);
            }
        }
        for ((k, q), v) in self.free().zip(q).zip(v) {
            (position[k], rate[k]) = (*q, *v);
        }
        RingState { position, rate, given, speed: inputs.of(Input::RingSpeed) }
    }

    /// Forces over its coordinates that are not those of its inertia over their second rates, of this force (N) and moment (N m) about its
    /// centre, this load and weight (`gravity` along y and z, m/s^2), and the inertia over both tilts: that of a, of a and b, of b.
    #[inline]
    fn acting<T: Numeric>(
        &self,
        state: &RingState<T>,
        [force, moment]: [Vector<T>; 2],
        load: [T; OF_RING],
        gravity: [f64; 2],
    ) -> ([T; OF_RING], [T; 3]) {
        let ([x, _, _, a, b], [vx, vy, vz, da, db]) = (state.position, state.rate);
        let ([polar, transverse], [damping, tilt_damping]) = (self.inertia, self.damping);
        let [spring, stiffness] = self.spring(0.0);
        let pushed = [force[0] - x * stiffness + spring, force[1], force[2]];
        let weight = [0.0, gravity[0] * self.mass, gravity[1] * self.mass];
        let velocity = [vx, vy, vz];
        let on_centre: [T; 3] =
            std::array::from_fn(|k| pushed[k] + load[k] - velocity[k] * damping + weight[k]);
        let tilt = Tilt::new([a, b]);
        let across = tilt.across([da, db]);
        let [w2, w3] = across.speed;
        let own = (across.own + state.speed) * polar - across.own * transverse;
        let [m2, m3] = tilt.crosswise([moment[0], moment[1] + load[3], moment[2] + load[4]]);
        let [d2, d3] = across.drift;
        let rest = [m2 - own * w3 - d2 * transverse, m3 + own * w2 - d3 * transverse];
        let rows = tilt.over_rates();
        let along = |k: usize| rows[0][k] * rest[0] + rows[1][k] * rest[1];
        let [over_a, over_b] = [along(0) - da * tilt_damping, along(1) - db * tilt_damping];
        let product = |i: usize, k: usize| (rows[0][i] * rows[0][k] + rows[1][i] * rows[1][k]) * transverse;
        let [x, y, z] = on_centre;
        ([x, y, z, over_a, over_b], [product(0, 0), product(0, 1), product(1, 1)])
    }

    /// Accelerations of its coordinates under the same.
    #[inline]
    pub(crate) fn accelerations<T: Numeric>(
        &self,
        state: &RingState<T>,
        on_ring: [Vector<T>; 2],
        load: [T; OF_RING],
        gravity: [f64; 2],
    ) -> [T; OF_RING] {
        let ([x, y, z, over_a, over_b], [aa, ab, bb]) = self.acting(state, on_ring, load, gravity);
        let [_, _, _, given_a, given_b] = state.given;
        let [dda, ddb] = match [self.held[3], self.held[4]] {
            [None, None] => {
                let inverse = over_a.like(1.0) / (aa * bb - ab * ab);
                [(bb * over_a - ab * over_b) * inverse, (aa * over_b - ab * over_a) * inverse]
            }
            _ => [(over_a - ab * given_b) / aa, (over_b - ab * given_a) / bb],
        };
        let all = [x * (1.0 / self.mass), y * (1.0 / self.mass), z * (1.0 / self.mass), dda, ddb];
        std::array::from_fn(|k| if self.held[k].is_some() { state.given[k] } else { all[k] })
    }

    /// Power of what moves its prescribed coordinates, W, under the same.
    pub(crate) fn held_power(
        &self,
        state: &RingState<f64>,
        on_ring: [Vector<f64>; 2],
        load: [f64; OF_RING],
        gravity: [f64; 2],
    ) -> f64 {
        if self.prescribed == [false; OF_RING] {
            return 0.0;
        }
        let (acting, [aa, ab, bb]) = self.acting(state, on_ring, load, gravity);
        let [x, y, z, a, b] = self.accelerations(state, on_ring, load, gravity);
        let inertial = [self.mass * x, self.mass * y, self.mass * z, aa * a + ab * b, ab * a + bb * b];
        let power = |k: usize| (inertial[k] - acting[k]) * state.rate[k];
        (0..OF_RING).filter(|k| self.prescribed[*k]).map(power).sum()
    }

    /// Energy of its motion, but for that of the rotation that is prescribed, and of its weight, J.
    pub(crate) fn energy(&self, state: &RingState<f64>, gravity: [f64; 2]) -> BodyEnergy {
        let ([_, y, z, a, b], [vx, vy, vz, da, db]) = (state.position, state.rate);
        let [w2, w3] = Tilt::new([a, b]).across([da, db]).speed;
        let [_, transverse] = self.inertia;
        let mass = self.moving_mass();
        let kinetic = 0.5 * (mass * (vx * vx + vy * vy + vz * vz) + transverse * (w2 * w2 + w3 * w3));
        BodyEnergy { kinetic, elastic: 0.0, potential: BodyEnergy::of_weight(mass, gravity, [y, z]) }
    }

    /// Powers of loads with the spring, and of the supports, W.
    pub(crate) fn powers(&self, state: &RingState<f64>, load: [f64; OF_RING]) -> [f64; 2] {
        let ([x, _, _, a, b], rate) = (state.position, state.rate);
        let tilt = Tilt::new([a, b]);
        let [w2, w3] = tilt.across([rate[3], rate[4]]).speed;
        let [m2, m3] = tilt.crosswise([0.0, load[3], load[4]]);
        let [spring, _] = self.spring(x);
        let pushed = (load[0] + spring) * rate[0] + load[1] * rate[1] + load[2] * rate[2];
        let [damping, tilt_damping] = self.damping;
        let lost = damping * rate[..3].iter().map(|v| v * v).sum::<f64>()
            + tilt_damping * (rate[3] * rate[3] + rate[4] * rate[4]);
        [pushed + m2 * w2 + m3 * w3, -lost]
    }

    /// Damping of its supports over a coordinate by the inertia of that, 1/s.
    pub(crate) fn decay(&self, coordinate: usize) -> f64 {
        if coordinate < 3 { self.damping[0] / self.mass } else { self.damping[1] / self.inertia[1] }
    }

    /// m, kg; zero where its centre is held.
    fn moving_mass(&self) -> f64 {
        let moves = |k: usize| self.held[k].is_none() || self.prescribed[k];
        if (0..3).any(moves) { self.mass } else { 0.0 }
    }

    /// Weight, N, along y and z; none where its centre is held.
    pub(crate) fn weight(&self, gravity: [f64; 2]) -> [f64; 2] {
        gravity.map(|g| self.moving_mass() * g)
    }

    /// Force (N) and moment (N m) of the supports at these rates.
    pub(crate) fn support(&self, rate: &[f64; OF_RING]) -> [f64; OF_RING] {
        let [damping, tilt_damping] = self.damping;
        std::array::from_fn(|k| -rate[k] * if k < 3 { damping } else { tilt_damping })
    }
}
