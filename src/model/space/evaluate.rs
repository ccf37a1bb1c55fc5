//! The force evaluation in space: from a state to the forces of every contact and the accelerations.

use super::workspace::{BallBlock, WRENCH, Workspace, at_lane, load, store};
use super::{RACES, Space};
use crate::bodies::{Balls, Fault, INNER_RING, Input, Moves, MovingRing, OF_BALL, SOUND};
use crate::laws::point_contact::PointContact;
use crate::pairs::groove::{InGroove, Race};
use crate::pairs::{Law, Waves, parts};
use crate::scalar::{Columns, Numeric, Pack, dispatch, math, place_of};
use crate::space::solid::{
    LARGEST_TILT, Moving, Tilt, Vector, added, dot, halves, numbers, scaled, to_global, to_local,
};
use pulp::Simd;

/// Which way the normal of a contact with outer and inner race points from the axis of the ring.
pub(super) const OUTWARDS: [f64; 2] = [1.0, -1.0];
/// Outward part of the normal below which a ball is behind its groove, 135 degrees from the middle of that.
const BEHIND: f64 = -std::f64::consts::FRAC_1_SQRT_2;

impl Space {
    /// Accelerations `a` (m/s^2 or rad/s^2) at positions `q`, velocities `v` and the inputs that `ws` holds.
    ///
    /// # Errors
    /// A [`Fault`] when forces are undefined at this state; `a` is then meaningless.
    pub(crate) fn evaluate(
        &self,
        q: &[f64],
        v: &[f64],
        ws: &mut Workspace,
        a: &mut [f64],
    ) -> Result<(), Fault> {
        self.heat(ws)?;
        self.locate(q, v, ws)?;
        for race in 0..self.races.len() {
            self.apply(race, ws);
        }
        if ws.counting && self.free {
            self.count(ws);
        }
        self.apply_rollers(ws)?;
        self.apply_cage(ws)?;
        self.assemble(ws, a);
        self.in_grooves(ws)?;
        match a.iter().position(|x| !x.is_finite()) {
            None => Ok(()),
            Some(velocity) => Err(Fault::NotFinite { velocity, contact: self.contact_not_finite(ws) }),
        }
    }

    /// Finds the viscosity at the present temperature.
    fn heat(&self, ws: &mut Workspace) -> Result<(), Fault> {
        let temperature = ws.inputs.of(Input::Temperature);
        let Some(oil) = self.inputs.oil.as_ref().filter(|_| temperature != ws.temperature) else {
            return Ok(());
        };
        ws.counts[Law::ViscosityTemperature as usize] += u64::from(ws.counting);
        let fluid = oil.fluid_at(temperature);
        if fluid.relative_viscosity.is_nan() {
            return Err(Fault::NoViscosity { temperature });
        }
        (ws.fluid, ws.temperature) = (fluid, temperature);
        Ok(())
    }

    /// Finds the motion of all bodies.
    pub(super) fn locate(&self, q: &[f64], v: &[f64], ws: &mut Workspace) -> Result<(), Fault> {
        ws.step = None;
        let of_ring = self.layout.range(INNER_RING);
        ws.ring = self.ring.state(&q[of_ring.clone()], &v[of_ring.clone()], &ws.inputs);
        ws.load = self.ring.load(&ws.inputs);
        let [_, y, z, a, b] = ws.ring.position;
        let (tilted, pitch) = (math::hypot(a, b), self.set.pitch_radius);
        let off = math::hypot(math::hypot(ws.ring.position[0], y), z);
        if tilted > LARGEST_TILT {
            return Err(Fault::LostRing { ring: 1, distance: tilted * pitch, reach: LARGEST_TILT * pitch });
        }
        if off > self.set.radius {
            return Err(Fault::LostRing { ring: 1, distance: off, reach: self.set.radius });
        }
        let outer = ws.inputs.of(Input::OuterRingSpeed);
        ws.rings[0].speed = outer;
        ws.rings[0].moving.turning = [outer, 0.0, 0.0];
        ws.rings[1] = ws.ring.motion();
        self.locate_cage(q, v, ws)?;
        if !self.free {
            self.locate_prescribed(ws);
        }
        self.locate_rollers(q, v, ws)?;
        let levers = self.levers();
        let mut fastest = (0, 0.0);
        for j in 0..ws.balls {
            let (block, lane) = place_of(j);
            let block = &mut ws.blocks[block];
            let places: [usize; OF_BALL] = self.layout.of_element(j);
            for (k, at) in block.at.iter_mut().enumerate() {
                at[lane] = q[places[k]];
            }
            let (sin, cos) = math::sin_cos(self.set.reference_angles[j] + q[places[2]]);
            (block.direction[0][lane], block.direction[1][lane]) = (cos, sin);
            block.travel[lane] = q[places[2]];
            for ((speeds, place), lever) in block.speeds.iter_mut().zip(places).zip(levers) {
                speeds[lane] = v[place];
                let speed = v[place].abs() * lever;
                if speed > fastest.1 {
                    fastest = (place, speed);
                }
            }
        }
        let of_ring = self.ring.free().map(|k| if k < 3 { 1.0 } else { pitch });
        let of_cage = self.cage_coordinates().iter();
        let of_cage = of_cage.map(|c| if c.moves == Moves::Itself { 1.0 } else { pitch });
        for (place, (lever, v)) in of_ring.chain(of_cage).zip(v).enumerate() {
            if v.abs() * lever > fastest.1 {
                fastest = (place, v.abs() * lever);
            }
        }
        for (k, race) in self.races.iter().enumerate() {
            if let Some(waviness) = &race.waviness {
                self.place_on_waves(k, waviness, ws);
            }
        }
        match fastest {
            (velocity, speed) if speed > SOUND => Err(Fault::TooFast { velocity, speed }),
            _ => Ok(()),
        }
    }

    /// Finds the motion of elements that is prescribed.
    fn locate_prescribed(&self, ws: &mut Workspace) {
        let travel = ws.inputs.orbit_travel();
        let [orbit, spin] = [Input::OrbitSpeed, Input::SpinSpeed].map(|input| ws.inputs.of(input));
        for j in 0..ws.count {
            let (block, lane) = place_of(j);
            let block = &mut ws.blocks[block];
            let (sin, cos) = math::sin_cos(self.set.reference_angles[j] + travel);
            (block.direction[0][lane], block.direction[1][lane]) = (cos, sin);
            block.travel[lane] = travel;
            for (column, speed) in block.speeds.iter_mut().zip([0.0, 0.0, orbit, spin, 0.0, 0.0]) {
                column[lane] = speed;
            }
            for column in &mut block.on_ball {
                column[lane] = 0.0;
            }
        }
    }

    /// Finds the waves of race `k` under every ball.
    fn place_on_waves(&self, k: usize, waviness: &Waves, ws: &mut Workspace) {
        for j in 0..ws.count {
            let (block, lane) = place_of(j);
            let direction = at_lane(&ws.blocks[block].direction, lane);
            let still = Moving { velocity: [0.0; 3], turning: [0.0; 3] };
            let ring = ws.rings[k].beside(direction);
            let touch = self.in_groove(ws, k, j, &still).touch(&ring);
            let tilt = if k == 0 { [0.0; 2] } else { [ws.ring.position[3], ws.ring.position[4]] };
            let [_, outwards, along] = to_local([0.0, tilt[0], tilt[1]], direction);
            let [cos, sin] = touch.ahead(ring.axis, &Tilt::new([outwards, along]));
            let [azimuth, ahead] = [math::atan2(direction[1], direction[0]), math::atan2(sin, cos)];
            let wave = waviness.at(azimuth + ahead - ws.inputs.angles[k]);
            for (column, value) in ws.blocks[block].contacts[k].wave.iter_mut().zip(wave) {
                column[lane] = value;
            }
        }
    }

    /// Ball `j` with this motion in the groove of race `k`.
    pub(super) fn in_groove<'a>(
        &'a self,
        ws: &Workspace,
        k: usize,
        j: usize,
        moving: &'a Moving<f64>,
    ) -> InGroove<'a, f64, f64> {
        let (block, lane) = place_of(j);
        let block = &ws.blocks[block];
        InGroove {
            groove: &self.races[k].groove,
            elastic: &self.races[k].elastic[j],
            at: at_lane(&block.at, lane),
            excess: block.excess[lane],
            moving,
        }
    }

    /// Levers of the speeds of a ball, m or 1.
    pub(super) fn levers(&self) -> [f64; OF_BALL] {
        let (pitch, radius) = (self.set.pitch_radius, self.set.radius);
        [1.0, 1.0, pitch, radius, radius, radius]
    }

    /// Evaluates the contacts with one race.
    pub(super) fn apply(&self, race: usize, ws: &mut Workspace) {
        let Workspace { blocks, rings, fluid, count, instructions, .. } = ws;
        let work = Apply {
            race: &self.races[race],
            place: race,
            ring: &rings[race],
            blocks,
            count: *count,
            ln_viscosity: fluid.ln_viscosity,
        };
        dispatch(*instructions, work);
    }

    fn count(&self, ws: &mut Workspace) {
        for (race, law) in [Law::OuterRaceway, Law::InnerRaceway].into_iter().enumerate() {
            let touching = ws.contacts(race).filter(|(c, lane)| c.force[0][*lane] > 0.0).count() as u64;
            ws.counts[law as usize] += touching;
            for law in self.parts(race) {
                ws.counts[law as usize] += touching;
            }
        }
    }

    /// The laws of the contacts with one race beside elasticity.
    pub(super) fn parts(&self, race: usize) -> impl Iterator<Item = Law> {
        let list = self.races.get(race).map(|race| {
            let PointContact { film, traction, regime, rolling_resistance: rolling, .. } = &race.laws;
            let heated = traction.as_ref().is_some_and(|traction| traction.self_heating.is_some());
            parts([film.is_some(), traction.is_some(), heated, regime.is_some(), rolling.is_some()])
        });
        list.into_iter().flatten()
    }

    /// Collects forces on the bodies and lets them accelerate.
    pub(super) fn assemble(&self, ws: &mut Workspace, a: &mut [f64]) {
        for race in 0..RACES.len() {
            let mut total = [0.0; WRENCH];
            for (contact, lane) in ws.contacts(race) {
                for (total, column) in total.iter_mut().zip(&contact.on_ring) {
                    *total += column[lane];
                }
            }
            let (by_rollers, by_balls) = (ws.rollers.on_mates[race], halves(total));
            ws.on_rings[race] = if self.rollers.is_some() { by_rollers } else { by_balls };
        }
        if let Some(cage) = &self.cage {
            for (land, force) in cage.lands.iter().zip(&ws.cage.lands) {
                let on_ring = &mut ws.on_rings[land.ring];
                *on_ring = added(*on_ring, force.on[1]);
            }
        }
        self.accelerate_ring(ws, ws.on_rings[1], a);
        self.accelerate_cage(ws, a);
        self.accelerate_rollers(ws, a);
        for j in 0..ws.balls {
            let (block, lane) = place_of(j);
            let block = &ws.blocks[block];
            let [cos, sin] = at_lane(&block.direction, lane);
            let [gy, gz] = self.gravity;
            let (r, speeds) = (self.set.pitch_radius + block.at[1][lane], at_lane(&block.speeds, lane));
            let mut on_ball = halves(at_lane(&block.on_ball, lane));
            if let Some(drag) = self.drag_on(j, &Balls::moving(speeds, r), ws.fluid.ln_viscosity) {
                on_ball = added(on_ball, drag);
            }
            let accelerations = Balls::accelerations(
                at_lane(&block.inertia, lane),
                r,
                speeds,
                on_ball,
                [gy * cos + gz * sin, gz * cos - gy * sin],
            );
            for (place, acceleration) in self.layout.of_element::<OF_BALL>(j).into_iter().zip(accelerations) {
                a[place] = acceleration;
            }
        }
    }

    /// Force and moment of the mixture on ball `j`, if there is one.
    #[inline]
    pub(super) fn drag_on<T: Numeric>(
        &self,
        j: usize,
        moving: &Moving<T>,
        ln_viscosity: T,
    ) -> Option<[Vector<T>; 2]> {
        let radius = self.set.radius + self.set.radius_excess[j];
        let Moving { velocity, turning } = *moving;
        self.drag.map(|drag| {
            let squares = [velocity, turning].map(|v| dot(v, v));
            let [force, moment] = drag.per_speed(radius, squares, ln_viscosity);
            [scaled(velocity, -force), scaled(turning, -moment)]
        })
    }

    /// Writes the accelerations of the ring under these forces of all balls.
    pub(super) fn accelerate_ring(&self, ws: &Workspace, on_ring: [Vector<f64>; 2], a: &mut [f64]) {
        if self.layout.range(INNER_RING).is_empty() {
            return;
        }
        let all = self.ring.accelerations(&ws.ring, on_ring, ws.load, self.gravity);
        for (a, k) in a.iter_mut().zip(self.ring.free()) {
            *a = all[k];
        }
    }

    /// Whether every ball is in its grooves: none presses an arc from behind, or with an ellipse wider than that is.
    fn in_grooves(&self, ws: &Workspace) -> Result<(), Fault> {
        for (k, race) in self.races.iter().enumerate() {
            for (j, (contact, lane)) in ws.contacts(k).enumerate() {
                let (loaded, long) = (contact.force[0][lane] > 0.0, contact.force[3][lane]);
                let behind = OUTWARDS[k] * contact.in_meridian[1][lane] < BEHIND;
                if loaded && behind || long > race.pressed_radius() {
                    let approach = contact.motion[0][lane];
                    return Err(Fault::LostBall { ball: j, race: RACES[k], approach });
                }
            }
        }
        Ok(())
    }

    /// The first contact whose force is not finite, as a place in [`Space::contact_names`].
    fn contact_not_finite(&self, ws: &Workspace) -> Option<usize> {
        let (races, of_ball) = (self.races.len(), self.contacts_of_ball.len());
        let on_race = (0..ws.count).flat_map(|j| (0..races).map(move |k| (j, k))).find(|(j, k)| {
            let (contact, lane) = ws.contact(*k, *j);
            contact.on_ring.iter().any(|column| !column[lane].is_finite())
        });
        let in_pocket = || {
            let lost = ws.cage.touching.iter().find(|touching| !touching.contact.force.is_finite())?;
            Some((lost.ball, races + lost.wall))
        };
        let of_rollers = || self.roller_contact_not_finite(ws);
        on_race.or_else(in_pocket).map(|(j, k)| of_ball * j + k).or_else(of_rollers)
    }
}

struct Apply<'a> {
    race: &'a Race,
    place: usize,
    ring: &'a MovingRing<f64>,
    blocks: &'a mut [BallBlock],
    count: usize,
    ln_viscosity: f64,
}

impl Columns for Apply<'_> {
    /// The sums over an ellipse fill the registers by themselves.
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.count
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (block, lane) = place_of(first);
        let block = &mut self.blocks[block];
        let at: [Pack<S, K>; 2] = load(simd, &block.at, lane);
        let direction = load(simd, &block.direction, lane);
        let groove = self.race.groove.map(&mut |x| Pack::all(simd, *x));
        let moving = &Balls::moving(load(simd, &block.speeds, lane), at[1] + groove.pitch_radius);
        let excess = Pack::load(simd, &block.excess[lane..]);
        let contact = &mut block.contacts[self.place];
        let elastic = &contact.elastic(simd, &self.race.elastic[0], lane);
        let ball = InGroove { groove: &groove, elastic, at, excess, moving };
        let ring = self.ring.beside(direction);
        let wave = contact.wave(simd, self.race, lane);
        let found = ball.contact(&self.race.laws, &ring, wave, Pack::all(simd, self.ln_viscosity));
        store(found.motion.numbers(), &mut contact.motion, lane);
        store(found.force.numbers(), &mut contact.force, lane);
        store(found.touch.in_meridian, &mut contact.in_meridian, lane);
        let on_ball = numbers(found.on_ball);
        let [force, moment] = found.on_ring;
        let on_ring = [to_global(force, direction), to_global(moment, direction)];
        store(numbers(on_ring), &mut contact.on_ring, lane);
        if self.place == 0 {
            store(on_ball, &mut block.on_ball, lane);
        } else {
            let mut sum: [Pack<S, K>; WRENCH] = load(simd, &block.on_ball, lane);
            for i in 0..WRENCH {
                sum[i] += on_ball[i];
            }
            store(sum, &mut block.on_ball, lane);
        }
    }
}
