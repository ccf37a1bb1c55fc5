//! How contacts oppose the velocities of balls, and their forces and powers in a semi-implicit step, which differ from those of its
//! evaluation.
//!
//! ```text
//! D = c n n^T + J^T C J   over the velocity of a ball and its spin; C the secants of friction over slip and turning (5 x 5)
//! each part of a contact acts at v + s (v_end - v), s its implicit share
//! ```
//!
//! Rows of J are those of the rigid-body slip of a ball, so a step loses by friction what its forces say.

use super::Space;
use super::evaluate::OUTWARDS;
use super::workspace::{BallBlock, WRENCH, Workspace, at_lane, load, store};
use crate::bodies::{Balls, CAGE, Fault, MovingRing, OF_BALL, Power, SOUND};
use crate::integrate::{GroupDamping, SemiImplicit, SpokeDamping, implicit_share};
use crate::laws::point_contact::{PointForce, PointMotion};
use crate::model::{Condition, Energy, RATES, STATIC_LIMIT};
use crate::pairs::groove::{Fit, InGroove, Race, fit};
use crate::scalar::{Columns, Lanes, Numeric, Pack, dispatch, math, place_of};
use crate::space::solid::{added, dot, numbers, scaled, sum, to_global};
use pulp::Simd;

/// How far the grooves of a bearing with a contact angle are used on the side of the low shoulder, over that angle (assumed).
const LOW_SHOULDER: f64 = 0.5;

/// Rates of decay of the velocities of a ball by damping and by friction of a contact, 1/s: largest of each.
#[inline(always)]
fn decays<T: Numeric>(force: &PointForce<T>, [mass, inertia]: [T; 2], radius: T) -> [T; 2] {
    let one = mass.like(1.0);
    [force.damping / mass, force.friction.secants.first[0] * (one / mass + radius * radius / inertia)]
}

impl Space {
    /// Damping of every group for a step of size `h` (s), after an evaluation.
    pub(crate) fn damping(&self, h: f64, ws: &mut Workspace, out: &mut GroupDamping<OF_BALL>) {
        for race in 0..self.races.len() {
            let Workspace { blocks, rings, count, instructions, .. } = &mut *ws;
            let (race, ring) = ((&self.races[race], race), &rings[race]);
            dispatch(*instructions, Damp { race, ring, blocks, count: *count, h, spokes: &mut out.spokes });
        }
        self.damp_rollers(h, ws, out);
        self.damp_in_pockets(h, ws, out);
        for (body, block) in self.layout.free().zip(&mut out.bodies) {
            if body == CAGE {
                self.damp_cage(h, ws, block);
                continue;
            }
            block.full.fill(0.0);
            for (i, k) in self.ring.free().enumerate() {
                block.full[(i, i)] = self.ring.decay(k);
            }
            block.split(h, 1.0);
        }
    }

    /// Makes the accelerations `a` of ring and cage those by what the forces on them have become in the step of the balls.
    pub(crate) fn react(&self, v: &[f64], step: &SemiImplicit<'_>, ws: &mut Workspace, a: &mut [f64]) {
        self.find_step(v, Some(step), ws);
        let by_rollers = self.reaction_of_rollers(ws, 1);
        let [mut force, mut moment] = added(ws.on_rings[1], by_rollers);
        for (contact, lane) in ws.contacts(1) {
            for k in 0..3 {
                force[k] += contact.reaction[k][lane];
                moment[k] += contact.reaction[3 + k][lane];
            }
        }
        self.accelerate_ring(ws, [force, moment], a);
        self.accelerate_cage_in_step(ws, a);
    }

    /// Finds forces and powers of all contacts in a step from the last evaluated state, whose velocities are `v`, or at that state, unless
    /// they are known.
    pub(super) fn find_step(&self, v: &[f64], step: Option<&SemiImplicit<'_>>, ws: &mut Workspace) {
        let wanted = step.map_or(0.0, |step| step.h);
        if ws.step == Some(wanted) {
            return;
        }
        ws.step = Some(wanted);
        self.find_cage_step(v, step, ws);
        self.find_rollers_step(v, step, ws);
        if let Some(step) = step {
            for j in 0..ws.balls {
                let (block, lane) = place_of(j);
                for (k, place) in self.layout.of_element::<OF_BALL>(j).into_iter().enumerate() {
                    let [mean, end] = &mut ws.changes[block];
                    mean[k][lane] = step.mean[place] - v[place];
                    end[k][lane] = step.end[place] - v[place];
                }
            }
        }
        for place in 0..self.races.len() {
            let Workspace { blocks, rings, count, instructions, changes, .. } = &mut *ws;
            let (race, ring) = ((&self.races[place], place), &rings[place]);
            let changes = step.map(|_| changes.as_slice());
            dispatch(*instructions, Step { race, ring, blocks, count: *count, h: wanted, changes });
        }
    }

    /// Makes the forces at the last evaluated state, whose velocities are `v`, those of a semi-implicit step from there; zero where damping
    /// would make a contact pull.
    pub(crate) fn apply_step(&self, v: &[f64], step: &SemiImplicit<'_>, ws: &mut Workspace) {
        self.find_step(v, Some(step), ws);
        for contact in ws.blocks.iter_mut().flat_map(|block| &mut block.contacts) {
            for (force, acting) in contact.force[0].iter_mut().zip(&contact.normal) {
                *force = acting.max(0.0);
            }
        }
        for touching in &mut ws.cage.touching {
            touching.contact.force = touching.normal.max(0.0);
        }
    }

    /// Powers at the last evaluated state of `ws`, whose velocities are `v`, W, and whether each [`Condition`] holds (1 or 0), by their places.
    /// With a semi-implicit step those of its forces.
    pub(crate) fn powers(
        &self,
        v: &[f64],
        step: Option<&SemiImplicit<'_>>,
        ws: &mut Workspace,
        p: &mut [f64],
    ) {
        p[..RATES].fill(0.0);
        self.find_step(v, step, ws);
        let parts = [Power::RacewayDamping, Power::RacewayFriction, Power::RollingResistance];
        let by_rollers = [0, 1].map(|ring| self.reaction_of_rollers(ws, ring));
        let mut on_inner = sum(ws.on_rings[1][1], by_rollers[1][1]);
        let mut on_outer = ws.on_rings[0][1][0] + by_rollers[0][1][0];
        self.add_roller_powers(ws, p);
        for (race, (contact, lane)) in (0..2).flat_map(|race| ws.contacts(race).map(move |c| (race, c))) {
            for (power, part) in contact.powers.iter().zip(parts) {
                p[part as usize] += power[lane];
            }
            if race == 0 {
                on_outer += contact.reaction[3][lane];
            } else {
                on_inner = sum(on_inner, [3, 4, 5].map(|k| contact.reaction[k][lane]));
            }
        }
        self.add_cage_powers(ws, p);
        for j in 0..ws.balls {
            let (block, lane) = place_of(j);
            let block = &ws.blocks[block];
            let r = self.set.pitch_radius + block.at[1][lane];
            let moving = Balls::moving(at_lane(&block.speeds, lane), r);
            if let Some(drag) = self.drag_on(j, &moving, ws.fluid.ln_viscosity) {
                p[Power::Drag as usize] += moving.power(drag);
            }
        }
        for condition in Condition::ALL {
            p[condition.place()] = f64::from(u8::from(self.holds(condition, ws)));
        }
        let [outer, inner] = &ws.rings;
        let [loads, supports] = self.ring.powers(&ws.ring, ws.load);
        p[Power::Loads as usize] += loads;
        p[Power::RingSupport as usize] += supports;
        let mut force_on_inner = sum(ws.on_rings[1][0], by_rollers[1][0]);
        for (contact, lane) in ws.contacts(1) {
            force_on_inner = sum(force_on_inner, [0, 1, 2].map(|k| contact.reaction[k][lane]));
        }
        let on_ring = [force_on_inner, on_inner];
        p[Power::RingDrive as usize] += self.ring.held_power(&ws.ring, on_ring, ws.load, self.gravity)
            - dot(on_inner, inner.axis) * inner.speed;
        p[Power::OuterRingDrive as usize] -= on_outer * outer.speed;
    }

    /// Whether a condition holds in any contact at the last evaluated state of `ws`.
    fn holds(&self, condition: Condition, ws: &Workspace) -> bool {
        if let Some(rollers) = &self.rollers {
            return self.holds_of_rollers(rollers, condition, ws);
        }
        let mut all = (0..2).flat_map(|k| ws.contacts(k).map(move |(contact, lane)| (k, contact, lane)));
        match condition {
            Condition::AtFloor => all.any(|(k, contact, lane)| {
                let (motion, force) = (contact.motion_of(lane), contact.force_of(lane));
                self.races[k].laws.is_at_floor(&motion, &force, ws.fluid.ln_viscosity)
            }),
            Condition::BeyondShoulder => all.any(|(k, contact, lane)| {
                let (load, long) = (contact.force[0][lane], contact.force[3][lane]);
                let beyond = || self.races[k].beyond_shoulder(math::asin(contact.in_meridian[0][lane]), long);
                load > 0.0 && beyond().is_some_and(|beyond| beyond > 0.0)
            }),
            Condition::OnLowShoulder => match fit(&self.scene) {
                Fit::ContactAngle(angle) => {
                    let steepest = -math::sin(LOW_SHOULDER * angle);
                    all.any(|(k, contact, lane)| {
                        contact.force[0][lane] > 0.0 && OUTWARDS[k] * contact.in_meridian[0][lane] < steepest
                    })
                }
                Fit::RadialClearance(_) => false,
            },
            Condition::OverPressed => {
                all.any(|(_, contact, lane)| contact.force_of(lane).pressure > STATIC_LIMIT)
            }
            Condition::Unloaded => {
                self.free && ws.contacts(1).all(|(contact, lane)| contact.force[0][lane] == 0.0)
            }
        }
    }

    /// Energy of the last evaluated state of `ws`.
    pub(crate) fn energy(&self, ws: &Workspace) -> Energy {
        let of_ring = self.ring.energy(&ws.ring, self.gravity);
        let mut sum = Energy { kinetic: of_ring.kinetic, elastic: 0.0, potential: of_ring.potential };
        if let Some(cage) = &self.cage {
            let of_cage = cage.body.energy(&ws.cage.state, ws.cage.bending(), self.gravity);
            sum.kinetic += of_cage.kinetic;
            sum.potential += of_cage.potential;
            sum.elastic += of_cage.elastic + self.energy_in_pockets(ws);
        }
        let [kinetic, elastic, potential] = self.energy_of_rollers(ws);
        (sum.kinetic, sum.elastic, sum.potential) =
            (sum.kinetic + kinetic, sum.elastic + elastic, sum.potential + potential);
        let [gy, gz] = self.gravity;
        for j in 0..ws.balls {
            let (block, lane) = place_of(j);
            let block = &ws.blocks[block];
            let [mass, inertia] = at_lane(&block.inertia, lane);
            let [cos, sin] = at_lane(&block.direction, lane);
            let r = self.set.pitch_radius + block.at[1][lane];
            let [x, rho, orbit, wx, wr, wt] = at_lane(&block.speeds, lane);
            let around = r * orbit;
            sum.kinetic += 0.5 * mass * (x * x + rho * rho + around * around)
                + 0.5 * inertia * (wx * wx + wr * wr + wt * wt);
            sum.potential -= mass * r * (gy * cos + gz * sin);
            for (race, contact) in self.races.iter().zip(&block.contacts) {
                let delta = contact.motion[0][lane];
                // Hertz's law: 2/5 of Q delta.
                sum.elastic += 0.4 * race.elastic[j].load(delta) * delta;
            }
        }
        sum
    }

    /// Whether a step may end with these velocities.
    ///
    /// # Errors
    /// [`Fault::TooFast`].
    pub(crate) fn admit(&self, v: &[f64]) -> Result<(), Fault> {
        let levers = if self.rollers.is_some() { self.levers_of_rollers() } else { self.levers() };
        for j in 0..self.layout.count {
            for (k, velocity) in self.layout.of_element::<OF_BALL>(j).into_iter().enumerate() {
                let lever = levers[k];
                let speed = v[velocity].abs() * lever;
                if speed > SOUND {
                    return Err(Fault::TooFast { velocity, speed });
                }
            }
        }
        Ok(())
    }
}

/// Damping of balls by one race.
struct Damp<'a> {
    /// With its place.
    race: (&'a Race, usize),
    ring: &'a MovingRing<f64>,
    blocks: &'a mut [BallBlock],
    count: usize,
    h: f64,
    spokes: &'a mut [SpokeDamping<OF_BALL>],
}

impl Columns for Damp<'_> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.count
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (place, lane) = place_of(first);
        let (block, (race, k)) = (&mut self.blocks[place], self.race);
        let at: [Pack<S, K>; 2] = load(simd, &block.at, lane);
        let direction = load(simd, &block.direction, lane);
        let groove = race.groove.map(&mut |x| Pack::all(simd, *x));
        let r = at[1] + groove.pitch_radius;
        let moving = &Balls::moving(load(simd, &block.speeds, lane), r);
        let excess = Pack::load(simd, &block.excess[lane..]);
        let radius = groove.ball_radius + excess;
        let elastic = &block.contacts[k].elastic(simd, &race.elastic[0], lane);
        let wave = block.contacts[k].wave(simd, race, lane);
        let ball = InGroove { groove: &groove, elastic, at, excess, moving };
        let touch = ball.touch(&self.ring.beside(direction)).on(wave);
        let force = PointForce::of_numbers(load(simd, &block.contacts[k].force, lane));
        let [mass, inertia] = load(simd, &block.inertia, lane);
        let [of_normal, of_friction] =
            decays(&force, [mass, inertia], radius).map(|rate| implicit_share(rate * self.h));
        let zero = Pack::all(simd, 0.0);
        let (t, l, n, nearer) = (touch.along, touch.across, touch.normal, touch.approach());
        let inverse = [mass, mass, mass * r, inertia, inertia, inertia];
        let out = &mut self.spokes[place];
        for column in 0..OF_BALL {
            // A unit of this speed of the ball: slip and turning of the contact.
            let i = column % 3;
            let (slip, turning, normal) = if column < 3 {
                ([t[i], l[i]], [zero; 3], nearer[i] * force.damping)
            } else {
                ([l[i] * radius, -(t[i] * radius)], [t[i], l[i], n[i]], zero)
            };
            let ([ft, fl], [mt, ml, mn]) = force.friction.secants.friction(slip, turning);
            let pushed = sum(scaled(t, ft), scaled(l, fl));
            let couple = sum(sum(scaled(t, mt - fl * radius), scaled(l, ml + ft * radius)), scaled(n, mn));
            for row in 0..OF_BALL {
                let rubbed = if row < 3 { -pushed[row] } else { -couple[row - 3] };
                let pressed = if row < 3 { normal * nearer[row] } else { zero };
                // psi' moves the ball by r.
                let lever = if column == 2 { r } else { zero.like(1.0) };
                let factor = lever / inverse[row];
                let full = (rubbed + pressed) * factor;
                let implicit = (rubbed * of_friction + pressed * of_normal) * factor;
                let (to_full, to_implicit) =
                    (&mut out.full[row][column][lane..], &mut out.implicit[row][column][lane..]);
                if k == 0 {
                    full.store(to_full);
                    implicit.store(to_implicit);
                } else {
                    full.add_to(to_full);
                    implicit.add_to(to_implicit);
                }
            }
        }
    }
}

/// Forces and powers of the contacts with one race in a step.
struct Step<'a> {
    /// With its place.
    race: (&'a Race, usize),
    ring: &'a MovingRing<f64>,
    blocks: &'a mut [BallBlock],
    count: usize,
    /// s; zero for the evaluated state itself.
    h: f64,
    /// Mean and last speeds of the balls in the step less those of the evaluation.
    changes: Option<&'a [[[Lanes; OF_BALL]; 2]]>,
}

impl Columns for Step<'_> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.count
    }

    #[inline(always)]
    #[expect(clippy::needless_range_loop, reason = "iterators might not be inlined")]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (place, lane) = place_of(first);
        let (block, (race, k)) = (&mut self.blocks[place], self.race);
        let contact = &mut block.contacts[k];
        let mut force = PointForce::of_numbers(load::<S, K, _>(simd, &contact.force, lane));
        let mut motion = PointMotion::of_numbers(load::<S, K, _>(simd, &contact.motion, lane));
        let elastic = &contact.elastic(simd, &race.elastic[0], lane);
        let zero = Pack::all(simd, 0.0);
        let mut reaction = [zero; WRENCH];
        if let Some(changes) = self.changes {
            let [to_mean, to_end] = &changes[place];
            let at: [Pack<S, K>; 2] = load(simd, &block.at, lane);
            let direction = load(simd, &block.direction, lane);
            let groove = race.groove.map(&mut |x| Pack::all(simd, *x));
            let r = at[1] + groove.pitch_radius;
            let excess = Pack::load(simd, &block.excess[lane..]);
            let radius = groove.ball_radius + excess;
            let speeds: [Pack<S, K>; OF_BALL] = load(simd, &block.speeds, lane);
            let to_mean: [Pack<S, K>; OF_BALL] = load(simd, to_mean, lane);
            let to_end: [Pack<S, K>; OF_BALL] = load(simd, to_end, lane);
            let inertia = load(simd, &block.inertia, lane);
            let ring = self.ring.beside(direction);
            let unmoved = &Balls::moving(speeds, r);
            let ball = InGroove { groove: &groove, elastic, at, excess, moving: unmoved };
            let touch = ball.touch(&ring).on(contact.wave(simd, race, lane));
            let shares = decays(&force, inertia, radius).map(|rate| implicit_share(rate * self.h));
            // At the mean speeds, and where damping and friction act.
            let mut moved = [motion; 3];
            for (part, share) in [Pack::all(simd, 0.5), shares[0], shares[1]].into_iter().enumerate() {
                let mut of_ball = speeds;
                for i in 0..OF_BALL {
                    of_ball[i] += to_mean[i] * (-(share * 2.0) + 2.0) + to_end[i] * (share * 2.0 - 1.0);
                }
                moved[part] = InGroove { moving: &Balls::moving(of_ball, r), ..ball }.motion(&touch, &ring);
            }
            let [mean, pressed, rubbed] = moved;
            let mut change = force;
            change.normal = force.damping * (pressed.delta_dot - motion.delta_dot);
            change.rolling_resistance = zero;
            // Friction is linear in slip and turning.
            let slip = [rubbed.slip[0] - motion.slip[0], rubbed.slip[1] - motion.slip[1]];
            let mut turning = rubbed.turning;
            for i in 0..3 {
                turning[i] = rubbed.turning[i] - motion.turning[i];
            }
            let (by_slip, couple) = force.friction.secants.friction(slip, turning);
            (change.friction.force, change.friction.couple) = (by_slip, couple);
            let [_, [push, moment]] = ball.wrenches(&touch, &change);
            reaction = numbers([to_global(push, direction), to_global(moment, direction)]);
            force.normal += change.normal;
            for i in 0..2 {
                force.friction.force[i] += by_slip[i];
            }
            for i in 0..3 {
                force.friction.couple[i] += couple[i];
            }
            motion = PointMotion { delta: motion.delta, ..mean };
        }
        store(reaction, &mut contact.reaction, lane);
        force.normal.store(&mut contact.normal[lane..]);
        let ([ft, fl], [mt, ml, mn]) = (force.friction.force, force.friction.couple);
        let ([dt, dl], [wt, wl, wn], [u1, u2]) = (motion.slip, motion.turning, motion.surface_speeds);
        let powers = [
            -((force.normal - elastic.load(motion.delta)) * motion.delta_dot),
            ft * dt + fl * dl + mt * wt + ml * wl + mn * wn,
            force.rolling_resistance * (u1 + u2),
        ];
        store(powers, &mut contact.powers, lane);
    }
}
