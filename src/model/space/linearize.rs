//! Exact derivatives of the accelerations in space, by dual numbers through the same laws and kinematics that give the forces.
//!
//! The laws of all contacts are differentiated in lanes over what they see ([`PointMotion`] and the viscosity), geometry and wrenches ball
//! by ball over how ball and ring lie and move to each other in the axes of the azimuth; both are chained with the coordinates.

use super::workspace::{BallBlock, BlockSlopes, FORCES, SEEN, Workspace, at_lane, load};
use super::{RACES, Space};
use crate::bodies::{Balls, Input, InputValues, MovingRing, OF_BALL, OF_RING, RingState};
use crate::integrate::{Linearization, Structure};
use crate::laws::elastic::normal::NormalForce;
use crate::laws::point_contact::{POINT_FORCE, POINT_MOTION, PointForce, PointMotion};
use crate::pairs::groove::{InGroove, Race, Wave};
use crate::scalar::{Columns, Dual, Duals, Numeric, Pack, ZEROS, dispatch, place_of};
use crate::space::solid::{Moving, Tilt, added, numbers, scaled, sum, to_local};
use pulp::{Simd, WithSimd};

/// How ball and ring lie and move to each other: x and rho of the ball, centre and tilt of the ring outwards and along the orbit,
/// velocity and spin of the ball, rates of the tilt, time at a ball that stands still, angle of the contact in the waves of the ring.
const RELATIVE: usize = 16;
const TILT: usize = 4;
const VELOCITY: usize = 6;
const TILT_RATE: usize = 12;
const TIME: usize = 14;
const ANGLE: usize = 15;
type Relative = Dual<RELATIVE>;

/// What the ring's own motion follows: force and moment, its positions, their rates; last time.
const OF_TIME: usize = 6 + 2 * OF_RING;

/// Accelerations of the ring over these.
pub(super) type RingSlopes = [Dual<{ OF_TIME + 1 }>; OF_RING];

/// What a ball's own motion follows: rho, azimuth, speeds, logarithm of the viscosity.
const OF_OWN: usize = 3 + OF_BALL;

/// Derivatives of force and moment.
type Row = [f64; RELATIVE];

/// What its contact with a race does to ball and ring, with derivatives.
struct Sloped {
    on_ball: [Relative; 6],
    on_ring: [Relative; 6],
}

impl Space {
    /// Which velocities are coupled: ring and cage are the hub, balls the spokes.
    pub(crate) fn structure(&self) -> Structure<OF_BALL> {
        self.layout.structure()
    }

    /// Derivatives of the accelerations at the last evaluated state of `ws`, while the inputs change at `rates`.
    pub(crate) fn linearize(
        &self,
        ws: &mut Workspace,
        rates: &InputValues,
        out: &mut Linearization<OF_BALL>,
    ) {
        out.clear();
        ws.slopes.resize(ws.blocks.len(), [[[ZEROS; SEEN]; FORCES]; 2]);
        for place in 0..self.races.len() {
            let Workspace { blocks, fluid, count, instructions, slopes, .. } = &mut *ws;
            let (race, ln_viscosity) = ((&self.races[place], place), fluid.ln_viscosity);
            dispatch(*instructions, Differentiate { race, blocks, slopes, count: *count, ln_viscosity });
        }
        let ring = self.ring_slopes(ws, rates);
        let free: Vec<usize> = self.ring.free().collect();
        let width = self.layout.hub();
        for (i, row) in free.iter().enumerate() {
            for (k, column) in free.iter().enumerate() {
                out.over_positions.hub[(i, k)] = ring[*row].eps[6 + column];
                out.over_velocities.hub[(i, k)] = ring[*row].eps[6 + OF_RING + column];
            }
            out.over_time[i] = ring[*row].eps[OF_TIME];
        }
        let ln_rate = self.inputs.oil.as_ref().map_or(0.0, |oil| {
            let warming = rates.of(Input::Temperature);
            if warming == 0.0 {
                0.0
            } else {
                oil.law.relative_slope(ws.inputs.of(Input::Temperature)) * warming
            }
        });
        self.add_cage_slopes(ws, (rates, ln_rate), &ring, out);
        self.add_roller_slopes(ws, (rates, ln_rate), &ring, out);
        for j in 0..ws.balls {
            let places = self.layout.of_element::<OF_BALL>(j);
            let ball = self.ball_slopes(ws, j);
            let (block, lane) = place_of(j);
            let block = &ws.blocks[block];
            let [cos, sin] = at_lane(&block.direction, lane);
            let [mass, inertia] = at_lane(&block.inertia, lane);
            let speeds = at_lane(&block.speeds, lane);
            let r = self.set.pitch_radius + block.at[1][lane];
            let inverse =
                [1.0 / mass, 1.0 / mass, 1.0 / (mass * r), 1.0 / inertia, 1.0 / inertia, 1.0 / inertia];
            let local = LocalRing::new(ws.ring.position, ws.ring.rate, [cos, sin]);
            for k in 0..RACES.len() {
                let sloping = Sloping { space: self, ws, contact: (j, k), rates, ln_rate };
                let Sloped { on_ball, on_ring } = ws.instructions.dispatch(sloping);
                let still = LocalRing::default();
                let place = if k == 1 { &local } else { &still };
                for row in 0..OF_BALL {
                    let slopes = on_ball[row].eps;
                    let own = over_ball(&slopes, place, speeds[2], r);
                    let to = &mut out.over_positions.own.as_mut_slice().as_chunks_mut::<OF_BALL>().0;
                    for (column, slope) in own[0].into_iter().enumerate() {
                        to[j * OF_BALL + column][row] += slope * inverse[row];
                    }
                    let to = &mut out.over_velocities.own.as_mut_slice().as_chunks_mut::<OF_BALL>().0;
                    for (column, slope) in own[1].into_iter().enumerate() {
                        to[j * OF_BALL + column][row] += slope * inverse[row];
                    }
                    out.over_time[places[row]] += slopes[TIME] * inverse[row];
                    if k == 1 {
                        let of_ring = over_ring(&slopes, [cos, sin]);
                        for (part, slopes) in
                            [&mut out.over_positions, &mut out.over_velocities].into_iter().zip(of_ring)
                        {
                            let to = part.from_hub.as_mut_slice().as_chunks_mut::<OF_BALL>().0;
                            for (column, k) in free.iter().enumerate() {
                                to[j * width + column][row] += slopes[*k] * inverse[row];
                            }
                        }
                    }
                }
                if k == 1 && !free.is_empty() {
                    let global = to_global_rows(&on_ring, [cos, sin]);
                    let (contact, lane) = ws.contact(1, j);
                    let [fx, fy, fz, mx, my, mz] = at_lane(&contact.on_ring, lane);
                    // Vectors turn with the azimuth.
                    let turned = [0.0 * fx, -fz, fy, 0.0 * mx, -mz, my];
                    for (i, k) in free.iter().enumerate() {
                        let by_wrench: [f64; 6] = std::array::from_fn(|w| ring[*k].eps[w]);
                        let sum =
                            |of: &dyn Fn(usize) -> f64| (0..6).map(|w| by_wrench[w] * of(w)).sum::<f64>();
                        let slopes: Row = std::array::from_fn(|d| sum(&|w| global[w][d]));
                        let mut own = over_ball(&slopes, &local, speeds[2], r);
                        own[0][2] += sum(&|w| turned[w]);
                        let of_ring = over_ring(&slopes, [cos, sin]);
                        out.over_time[i] += slopes[TIME];
                        for (part, (own, of_ring)) in [&mut out.over_positions, &mut out.over_velocities]
                            .into_iter()
                            .zip(own.into_iter().zip(of_ring))
                        {
                            for (column, slope) in own.into_iter().enumerate() {
                                part.to_hub[(i, j * OF_BALL + column)] += slope;
                            }
                            for (column, k) in free.iter().enumerate() {
                                part.hub[(i, column)] += of_ring[*k];
                            }
                        }
                    }
                }
            }
            for row in 0..OF_BALL {
                let eps = ball[row].eps;
                out.over_time[places[row]] += eps[OF_OWN - 1] * ln_rate;
                let to = &mut out.over_positions.own.as_mut_slice().as_chunks_mut::<OF_BALL>().0;
                to[j * OF_BALL + 1][row] += eps[0];
                to[j * OF_BALL + 2][row] += eps[1];
                let to = &mut out.over_velocities.own.as_mut_slice().as_chunks_mut::<OF_BALL>().0;
                for column in 0..OF_BALL {
                    to[j * OF_BALL + column][row] += eps[2 + column];
                }
            }
        }
    }

    /// Accelerations of the ring over force and moment, positions, rates, and time while all these stand still.
    fn ring_slopes(&self, ws: &Workspace, rates: &InputValues) -> RingSlopes {
        let variable = Dual::<{ OF_TIME + 1 }>::variable;
        let [force, moment] = ws.on_rings[1];
        let at = |first: usize, x: [f64; 3]| [0, 1, 2].map(|k| variable(x[k], first + k));
        let timed = |mut x: Dual<{ OF_TIME + 1 }>, rate: f64| {
            x.eps[OF_TIME] = rate;
            x
        };
        let in_time = |x: f64, rate: f64| timed(Dual { re: x, eps: [0.0; OF_TIME + 1] }, rate);
        let (ring, loads) = (&ws.ring, self.ring.load(rates));
        let [first, second, third] = self.ring.given(rates);
        let state = RingState {
            position: std::array::from_fn(|k| timed(variable(ring.position[k], 6 + k), first[k])),
            rate: std::array::from_fn(|k| timed(variable(ring.rate[k], 6 + OF_RING + k), second[k])),
            given: std::array::from_fn(|k| in_time(ring.given[k], third[k])),
            speed: in_time(ring.speed, rates.of(Input::RingSpeed)),
        };
        let load = std::array::from_fn(|k| in_time(ws.load[k], loads[k]));
        self.ring.accelerations(&state, [at(0, force), at(3, moment)], load, self.gravity)
    }

    /// Accelerations of a ball over rho, its azimuth, its speeds and the logarithm of the viscosity, at constant forces of contacts.
    fn ball_slopes(&self, ws: &Workspace, j: usize) -> [Dual<OF_OWN>; OF_BALL] {
        let (block, lane) = place_of(j);
        let block = &ws.blocks[block];
        let variable = Dual::<OF_OWN>::variable;
        let constant = |x: f64| Dual { re: x, eps: [0.0; OF_OWN] };
        let ([cos, sin], [gy, gz]) = (at_lane(&block.direction, lane), self.gravity);
        let [outwards, ahead] = [gy * cos + gz * sin, gz * cos - gy * sin];
        let mut gravity = [constant(outwards), constant(ahead)];
        (gravity[0].eps[1], gravity[1].eps[1]) = (ahead, -outwards);
        let speeds = at_lane(&block.speeds, lane);
        let speeds = std::array::from_fn(|k| variable(speeds[k], 2 + k));
        let r = variable(self.set.pitch_radius + block.at[1][lane], 0);
        let [fx, fr, ft, mx, my, mz] = at_lane(&block.on_ball, lane).map(constant);
        let mut on_ball = [[fx, fr, ft], [mx, my, mz]];
        let ln_viscosity = variable(ws.fluid.ln_viscosity, OF_OWN - 1);
        if let Some(drag) = self.drag_on(j, &Balls::moving(speeds, r), ln_viscosity) {
            on_ball = added(on_ball, drag);
        }
        Balls::accelerations(at_lane(&block.inertia, lane), r, speeds, on_ball, gravity)
    }

    /// What the contact of ball `j` with race `k` does to both, while the inputs change at `rates` and the logarithm of the viscosity at
    /// `ln_rate`.
    #[inline(always)]
    fn sloped(&self, ws: &Workspace, j: usize, k: usize, rates: &InputValues, ln_rate: f64) -> Sloped {
        let (place, lane) = place_of(j);
        let block = &ws.blocks[place];
        let direction = at_lane(&block.direction, lane);
        let at = at_lane(&block.at, lane);
        let r = self.set.pitch_radius + at[1];
        let variable = Relative::variable;
        let constant = |x: f64| Dual { re: x, eps: [0.0; RELATIVE] };
        let timed = |mut x: Relative, rate: f64| {
            x.eps[TIME] = rate;
            x
        };
        let in_time = |x: f64, rate: f64| timed(constant(x), rate);
        let own = Balls::moving(at_lane(&block.speeds, lane), r);
        let of_ball = Moving {
            velocity: std::array::from_fn(|i| variable(own.velocity[i], VELOCITY + i)),
            turning: std::array::from_fn(|i| variable(own.turning[i], VELOCITY + 3 + i)),
        };
        let race = &self.races[k];
        let (ring, tilt) = if k == 0 {
            let ring: MovingRing<f64> = ws.rings[0].beside(direction);
            let speed = in_time(ring.speed, rates.of(Input::OuterRingSpeed));
            let axis = ring.axis.map(constant);
            let ring = MovingRing {
                centre: ring.centre.map(constant),
                axis,
                moving: Moving { velocity: ring.moving.velocity.map(constant), turning: scaled(axis, speed) },
                speed,
            };
            (ring, Tilt::new([constant(0.0); 2]))
        } else {
            let local = LocalRing::new(ws.ring.position, ws.ring.rate, direction);
            // By what moves the ring from outside.
            let [place, rate, _] = self.ring.given(rates);
            let given = LocalRing::new(place, rate, direction);
            let tilt = Tilt::new([0, 1].map(|i| timed(variable(local.tilt[i], TILT + i), given.tilt[i])));
            let tilting =
                [0, 1].map(|i| timed(variable(local.tilt_rate[i], TILT_RATE + i), given.tilt_rate[i]));
            let speed = in_time(ws.ring.speed, rates.of(Input::RingSpeed));
            let centre = |i: usize| timed(variable(local.centre[i], 2 + i), given.centre[i]);
            let velocity = |i: usize| in_time(local.velocity[i], given.velocity[i]);
            let ring = MovingRing {
                centre: [in_time(ws.ring.position[0], place[0]), centre(0), centre(1)],
                axis: tilt.axis,
                moving: Moving {
                    velocity: [in_time(ws.ring.rate[0], rate[0]), velocity(0), velocity(1)],
                    turning: sum(tilt.angular_velocity(tilting), scaled(tilt.axis, speed)),
                },
                speed: tilt.across(tilting).own + speed,
            };
            (ring, tilt)
        };
        let ball = InGroove {
            groove: &race.groove,
            elastic: &race.elastic[j],
            at: [variable(at[0], 0), variable(at[1], 1)],
            excess: block.excess[lane],
            moving: &of_ball,
        };
        let round = ball.touch(&ring);
        let wave = race.waviness.as_ref().map(|_| {
            let [cos, sin] = round.ahead(ring.axis, &tilt);
            let mut angle: [f64; RELATIVE] =
                std::array::from_fn(|d| cos.re * sin.eps[d] - sin.re * cos.eps[d]);
            angle[ANGLE] += 1.0;
            angle[TIME] -= rates.angles[k];
            let [height, slope, curvature] = at_lane(&block.contacts[k].wave, lane);
            Wave {
                height: Dual { re: height, eps: angle.map(|x| slope * x) },
                slope: Dual { re: slope, eps: angle.map(|x| curvature * x) },
            }
        });
        let touch = round.on(wave);
        let motion = ball.motion(&touch, &ring);
        let normal = race.laws.normal_force(ball.elastic, motion.delta, motion.delta_dot).force;
        let ([u1, u2], [_, dl], [wt, wl, wn]) = (motion.surface_speeds, motion.slip, motion.turning);
        let seen = [normal, u1, u2, dl, wt, wl, wn, in_time(ws.fluid.ln_viscosity, ln_rate)];
        let force = block.contacts[k].force_of(lane);
        let slopes = &ws.slopes[place][k];
        let chained = |i: usize, value: f64| {
            let mut sum = constant(value);
            for (s, seen) in seen.iter().enumerate() {
                let slope = slopes[i][s][lane];
                for d in 0..RELATIVE {
                    sum.eps[d] += slope * seen.eps[d];
                }
            }
            sum
        };
        let mut sloped = PointForce::of_numbers([constant(0.0); POINT_FORCE]);
        sloped.normal = normal;
        sloped.friction.force = [0, 1].map(|i| chained(i, force.friction.force[i]));
        sloped.friction.couple = [0, 1, 2].map(|i| chained(2 + i, force.friction.couple[i]));
        sloped.rolling_resistance = chained(5, force.rolling_resistance);
        let [on_ball, on_ring] = ball.wrenches(&touch, &sloped);
        Sloped { on_ball: numbers(on_ball), on_ring: numbers(on_ring) }
    }
}

/// Place and motion of the ring outwards and along the orbit.
#[derive(Clone, Copy, Debug, Default)]
struct LocalRing {
    centre: [f64; 2],
    tilt: [f64; 2],
    velocity: [f64; 2],
    tilt_rate: [f64; 2],
}

impl LocalRing {
    fn new(position: [f64; OF_RING], rate: [f64; OF_RING], direction: [f64; 2]) -> Self {
        let turned = |y: f64, z: f64| {
            let [_, r, t] = to_local([0.0, y, z], direction);
            [r, t]
        };
        let ([_, y, z, a, b], [_, vy, vz, da, db]) = (position, rate);
        Self { centre: turned(y, z), tilt: turned(a, b), velocity: turned(vy, vz), tilt_rate: turned(da, db) }
    }
}

/// Derivatives over the positions of a ball and over its speeds.
fn over_ball(z: &Row, ring: &LocalRing, orbit: f64, r: f64) -> [[f64; OF_BALL]; 2] {
    let LocalRing { centre, tilt, velocity, tilt_rate } = ring;
    // Seen from the ball, all vectors of the ring turn back as it goes round.
    let around = z[2] * centre[1] - z[3] * centre[0] + z[TILT] * tilt[1]
        - z[TILT + 1] * tilt[0]
        - z[VELOCITY + 1] * velocity[1]
        + z[VELOCITY + 2] * velocity[0]
        + z[TILT_RATE] * tilt_rate[1]
        - z[TILT_RATE + 1] * tilt_rate[0]
        + z[ANGLE];
    let v = VELOCITY;
    [
        [z[0], z[1] + z[v + 2] * orbit, around, 0.0, 0.0, 0.0],
        [z[v], z[v + 1], z[v + 2] * r, z[v + 3], z[v + 4], z[v + 5]],
    ]
}

/// Derivatives over the positions of the ring and over their rates.
fn over_ring(z: &Row, [cos, sin]: [f64; 2]) -> [[f64; OF_RING]; 2] {
    let y = |k: usize| z[k] * cos - z[k + 1] * sin;
    let up = |k: usize| z[k] * sin + z[k + 1] * cos;
    let v = VELOCITY + 1;
    [[-z[0], y(2), up(2), y(TILT), up(TILT)], [-z[VELOCITY], -y(v), -up(v), y(TILT_RATE), up(TILT_RATE)]]
}

/// Derivatives of force and moment in the axes of the bearing at a constant azimuth.
fn to_global_rows(on: &[Relative; 6], [cos, sin]: [f64; 2]) -> [Row; 6] {
    let mut out = on.map(|x| x.eps);
    for first in [0, 3] {
        let turned =
            |r: [f64; 2]| std::array::from_fn(|d| r[0] * on[first + 1].eps[d] + r[1] * on[first + 2].eps[d]);
        (out[first + 1], out[first + 2]) = (turned([cos, -sin]), turned([sin, cos]));
    }
    out
}

/// One contact, differentiated with the instructions of the machine.
struct Sloping<'a> {
    space: &'a Space,
    ws: &'a Workspace,
    /// Ball and race.
    contact: (usize, usize),
    rates: &'a InputValues,
    ln_rate: f64,
}

impl WithSimd for Sloping<'_> {
    type Output = Sloped;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Sloped {
        let (j, k) = self.contact;
        self.space.sloped(self.ws, j, k, self.rates, self.ln_rate)
    }
}

/// Derivatives of the laws of all contacts with one race.
struct Differentiate<'a> {
    /// With its place.
    race: (&'a Race, usize),
    blocks: &'a [BallBlock],
    slopes: &'a mut [BlockSlopes],
    count: usize,
    ln_viscosity: f64,
}

impl Columns for Differentiate<'_> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.count
    }

    #[inline(always)]
    #[expect(clippy::needless_range_loop, reason = "iterators might not be inlined")]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (place, lane) = place_of(first);
        let (contact, (race, k)) = (&self.blocks[place].contacts[self.race.1], self.race);
        let elastic = contact.elastic(simd, &race.elastic[0], lane);
        let [_, _, u1, u2, _, dl, wt, wl, wn]: [Pack<S, K>; POINT_MOTION] = load(simd, &contact.motion, lane);
        let of = Duals::<SEEN, Pack<S, K>>::variable;
        let zero = Duals::lift(Pack::all(simd, 0.0));
        let normal = NormalForce {
            force: of(Pack::load(simd, &contact.force[0][lane..]), 0),
            stiffness: zero,
            damping: zero,
        };
        let (u1, u2) = (of(u1, 1), of(u2, 2));
        let motion = PointMotion {
            delta: zero,
            delta_dot: zero,
            surface_speeds: [u1, u2],
            slip: [u1 - u2, of(dl, 3)],
            turning: [of(wt, 4), of(wl, 5), of(wn, 6)],
        };
        let ln_viscosity = of(Pack::all(simd, self.ln_viscosity), 7);
        let force = race.laws.under(normal, &elastic, &motion, ln_viscosity);
        let ([ft, fl], [mt, ml, mn]) = (force.friction.force, force.friction.couple);
        let forces = [ft, fl, mt, ml, mn, force.rolling_resistance];
        let slopes = &mut self.slopes[place][k];
        for i in 0..FORCES {
            for d in 0..SEEN {
                forces[i].eps[d].store(&mut slopes[i][d][lane..]);
            }
        }
    }
}
