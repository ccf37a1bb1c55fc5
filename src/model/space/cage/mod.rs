//! The cage among balls and rings: its pockets and lands at a state, in a semi-implicit step, and how they oppose velocities.

mod report;
mod slopes;

pub(crate) use report::OfCage;

use super::Space;
use super::evaluate::{moving, to_global};
use super::workspace::{Workspace, at_lane};
use crate::bodies::{
    CageInSpace, CageState, Fault, Input, InputValues, MovingCage, MovingRing, OF_BALL, OF_CAGE, Power,
    tilt_of,
};
use crate::integrate::{DampingBlock, GroupDamping, SemiImplicit, Tuning, implicit_share};
use crate::pairs::Law;
use crate::pairs::ball_pocket::{BallAt, BallPockets, PocketContact, WALLS};
use crate::pairs::guide::land::{Land, LandForce};
use crate::scalar::{Dual, Numeric, Real, math, place_of};
use crate::space::solid::{LARGEST_TILT, Moving, Vector, cross, difference, dot, scaled, sum};

/// A cage with its pairs.
#[derive(Debug)]
pub(super) struct CageOfScene {
    pub(super) body: CageInSpace,
    pub(super) pockets: Option<BallPockets>,
    pub(super) lands: Vec<Land>,
}

/// A ball that touches a wall of its pocket.
#[derive(Clone, Debug)]
pub(super) struct Touching {
    pub(super) ball: usize,
    pub(super) wall: usize,
    pub(super) contact: PocketContact<f64>,
    /// In the step from the last evaluated state: change of force and moment on the cage in axes of the bearing, normal force, friction on the
    /// ball in the axes of its azimuth, and powers of damping and friction, W.
    pub(super) reaction: [Vector<f64>; 2],
    pub(super) normal: f64,
    pub(super) friction: Vector<f64>,
    powers: [f64; 2],
    /// Power on the ball, W.
    on_ball: f64,
}

/// What is known of the cage at the last evaluated state.
#[derive(Clone, Debug)]
pub(super) struct CageMemory {
    pub(super) state: CageState<f64>,
    pub(super) moving: MovingCage<f64>,
    pub(super) touching: Vec<Touching>,
    pub(super) lands: Vec<LandForce<f64>>,
    pub(super) load: [Vector<f64>; 2],
    /// Of pockets alone.
    pub(super) by_pockets: [Vector<f64>; 2],
    /// Of all but its weight.
    pub(super) on_cage: [Vector<f64>; 2],
}

impl CageMemory {
    /// For a cage with so many balls and lands.
    pub(super) fn new(balls: usize, lands: usize) -> Self {
        let state = CageState { position: [0.0; OF_CAGE], rate: [0.0; OF_CAGE] };
        Self {
            state,
            moving: state.motion(),
            touching: Vec::with_capacity(WALLS * balls),
            lands: vec![LandForce::default(); lands],
            load: [[0.0; 3]; 2],
            by_pockets: [[0.0; 3]; 2],
            on_cage: [[0.0; 3]; 2],
        }
    }
}

/// Forces and moments together.
fn added<T: Numeric>(a: [Vector<T>; 2], b: [Vector<T>; 2]) -> [Vector<T>; 2] {
    [sum(a[0], b[0]), sum(a[1], b[1])]
}

fn power([force, moment]: [Vector<f64>; 2], body: &Moving<f64>) -> f64 {
    dot(force, body.velocity) + dot(moment, body.turning)
}

impl Space {
    /// Finds how the cage moves.
    pub(super) fn locate_cage(&self, q: &[f64], v: &[f64], ws: &mut Workspace) -> Result<(), Fault> {
        let Some(cage) = &self.cage else { return Ok(()) };
        let first = self.layout.range(crate::bodies::CAGE).start;
        let memory = &mut ws.cage;
        memory.state.position.copy_from_slice(&q[first..first + OF_CAGE]);
        memory.state.rate.copy_from_slice(&v[first..first + OF_CAGE]);
        let [x, y, z, ..] = memory.state.position;
        let off = math::hypot(x, math::hypot(y, z));
        if off > self.balls.set.pitch_radius || tilt_of(&memory.state.position) > LARGEST_TILT {
            return Err(Fault::LostCage);
        }
        memory.moving = memory.state.motion();
        memory.load = cage.body.load(&ws.inputs);
        Ok(())
    }

    /// Ball `j` as its pocket sees it.
    pub(super) fn in_pocket(&self, ws: &Workspace, j: usize) -> BallAt<f64> {
        let (block, lane) = place_of(j);
        let block = &ws.blocks[block];
        let at = at_lane(&block.at, lane);
        BallAt {
            at,
            direction: at_lane(&block.direction, lane),
            lead: block.travel[lane] - ws.cage.moving.angle,
            moving: moving(at_lane(&block.speeds, lane), self.balls.set.pitch_radius + at[1]),
            excess: block.excess[lane],
        }
    }

    /// Finds the forces of pockets and lands, and adds those on the balls to what acts on these.
    pub(super) fn apply_cage(&self, ws: &mut Workspace) -> Result<(), Fault> {
        let Some(cage) = &self.cage else { return Ok(()) };
        ws.cage.touching.clear();
        ws.cage.by_pockets = [[0.0; 3]; 2];
        if let Some(pockets) = &cage.pockets {
            self.touch_pockets(pockets, ws)?;
        }
        ws.cage.on_cage = added(ws.cage.load, ws.cage.by_pockets);
        for (k, land) in cage.lands.iter().enumerate() {
            let Workspace { cage: CageMemory { moving, lands, on_cage, .. }, rings, fluid, .. } = ws;
            let found = land.force(moving, &rings[land.ring], *fluid);
            let force = found.map_err(|gone| Fault::NoGuideFilm { minimum_film: gone.minimum_film })?;
            *on_cage = added(*on_cage, force.on[0]);
            lands[k] = force;
        }
        if ws.counting {
            let walls = ws.cage.touching.len() as u64;
            ws.counts[Law::PocketWall as usize] += walls;
            for (land, force) in cage.lands.iter().zip(&ws.cage.lands) {
                let acting = [force.film_share > 0.0, force.parts[2] != [0.0; 2]];
                for (law, acts) in land.laws().into_iter().zip(acting) {
                    if let Some(law) = law.filter(|_| acts) {
                        ws.counts[law as usize] += 1;
                    }
                }
            }
        }
        Ok(())
    }

    fn touch_pockets(&self, pockets: &BallPockets, ws: &mut Workspace) -> Result<(), Fault> {
        let furthest = self.balls.set.radius / self.balls.set.pitch_radius;
        for j in 0..ws.count {
            let ball = self.in_pocket(ws, j);
            if ball.lead.abs() > furthest {
                return Err(Fault::OutOfPocket { element: j, lead: ball.lead });
            }
            let place = pockets.place(&ball, &ws.cage.moving);
            if place.q[1].abs() > pockets.height {
                return Err(Fault::AbovePocket { element: j, distance: place.q[1] });
            }
            for wall in 0..WALLS {
                let Some(contact) = pockets.contact(wall, &ball, &place, &ws.cage.moving) else { continue };
                let (block, lane) = place_of(j);
                let direction = at_lane(&ws.blocks[block].direction, lane);
                let [[force, moment], on_cage] = contact.wrenches();
                let [fx, fr, ft] = force;
                let [mx, mr, mt] = moment;
                for (sum, x) in ws.blocks[block].on_ball.iter_mut().zip([fx, fr, ft, mx, mr, mt]) {
                    sum[lane] += x;
                }
                let on_cage = on_cage.map(|v| to_global(v, direction));
                ws.cage.by_pockets = added(ws.cage.by_pockets, on_cage);
                ws.cage.touching.push(Touching {
                    ball: j,
                    wall,
                    normal: contact.force,
                    friction: scaled(contact.slip, -contact.secant),
                    contact,
                    reaction: [[0.0; 3]; 2],
                    powers: [0.0; 2],
                    on_ball: 0.0,
                });
            }
        }
        Ok(())
    }

    /// Writes the accelerations of the cage under this force and moment.
    pub(super) fn accelerate_cage(&self, ws: &Workspace, on_cage: [Vector<f64>; 2], a: &mut [f64]) {
        if let Some(cage) = &self.cage {
            let first = self.layout.range(crate::bodies::CAGE).start;
            let all = cage.body.accelerations(&ws.cage.state, on_cage, self.gravity);
            a[first..first + OF_CAGE].copy_from_slice(&all);
        }
    }

    /// Shares of damping and friction of a contact that act on the change of a ball in a step of size `h`, s.
    fn pocket_shares(&self, ws: &Workspace, touching: &Touching, h: f64) -> [f64; 2] {
        if !self.free {
            return [0.5; 2];
        }
        let (block, lane) = place_of(touching.ball);
        let [mass, inertia] = at_lane(&ws.blocks[block].inertia, lane);
        let radius = self.balls.set.radius;
        let PocketContact { damping, secant, .. } = touching.contact;
        let rubbing = secant * (1.0 / mass + radius * radius / inertia);
        [damping / mass, rubbing].map(|rate| implicit_share(rate * h))
    }

    /// Adds the damping of balls by their pockets.
    pub(super) fn damp_in_pockets(&self, h: f64, ws: &Workspace, out: &mut GroupDamping<OF_BALL>) {
        for touching in ws.cage.touching.iter().filter(|_| self.free) {
            let (block, lane) = place_of(touching.ball);
            let of_ball = &ws.blocks[block];
            let [mass, inertia] = at_lane(&of_ball.inertia, lane);
            let r = self.balls.set.pitch_radius + of_ball.at[1][lane];
            let [of_normal, of_friction] = self.pocket_shares(ws, touching, h);
            let PocketContact { normal, damping, secant, levers: [to_wall, _], .. } = touching.contact;
            let inverse = [mass, mass, mass * r, inertia, inertia, inertia];
            for column in 0..OF_BALL {
                let mut unit = [[0.0; 3]; 2];
                unit[column / 3][column % 3] = if column == 2 { r } else { 1.0 };
                let moved = sum(unit[0], cross(unit[1], to_wall));
                let nearer = dot(moved, normal);
                let rubbed = scaled(difference(moved, scaled(normal, nearer)), secant);
                let pressed = scaled(normal, damping * nearer);
                let couple = cross(to_wall, rubbed);
                for row in 0..OF_BALL {
                    let (by_friction, by_normal) =
                        if row < 3 { (rubbed[row], pressed[row]) } else { (couple[row - 3], 0.0) };
                    let spokes = &mut out.spokes[block];
                    spokes.full[row][column][lane] += (by_friction + by_normal) / inverse[row];
                    spokes.implicit[row][column][lane] +=
                        (by_friction * of_friction + by_normal * of_normal) / inverse[row];
                }
            }
        }
    }

    /// Damping of the cage by its lands, and by elements whose motion is prescribed.
    pub(super) fn damp_cage(&self, h: f64, ws: &Workspace, out: &mut DampingBlock) {
        let Some(cage) = &self.cage else { return };
        type Rate = Dual<OF_CAGE>;
        let constant = ws.cage.state.position.map(Rate::lift);
        let state = CageState {
            position: constant,
            rate: std::array::from_fn(|k| Rate::variable(ws.cage.state.rate[k], k)),
        };
        let moving = state.motion();
        let mut on_cage = [[Rate::lift(0.0); 3]; 2];
        for land in &cage.lands {
            let ring = lifted(&ws.rings[land.ring]);
            if let Ok(force) = land.force_slopes(&moving, &ring, ws.fluid) {
                on_cage = added(on_cage, force.on[0]);
            }
        }
        for Touching { ball, contact, .. } in ws.cage.touching.iter().filter(|_| !self.free) {
            on_cage = added(on_cage, secant_of(ws, *ball, contact, &moving));
        }
        let still = CageState { position: constant, rate: ws.cage.state.rate.map(Rate::lift) };
        // The accelerations are linear in the forces.
        let respond = |on_cage| cage.body.accelerations(&still, on_cage, self.gravity);
        let all = respond(on_cage);
        for (row, a) in all.into_iter().enumerate() {
            for column in 0..OF_CAGE {
                out.full[(row, column)] = -a.eps[column];
            }
        }
        out.split(h, if cage.lands.iter().any(|land| land.ring == 1) { 2.0 } else { 1.0 });
    }

    /// Forces and powers of pockets in a step from the last evaluated state, or at that state.
    pub(super) fn find_cage_step(&self, v: &[f64], step: Option<&SemiImplicit<'_>>, ws: &mut Workspace) {
        let Some(pockets) = self.cage.as_ref().and_then(|cage| cage.pockets.as_ref()) else { return };
        let mut list = std::mem::take(&mut ws.cage.touching);
        for touching in &mut list {
            let (block, lane) = place_of(touching.ball);
            let block = &ws.blocks[block];
            let direction = at_lane(&block.direction, lane);
            let contact = &touching.contact;
            let [to_wall, _] = contact.levers;
            let r = self.balls.set.pitch_radius + block.at[1][lane];
            let speeds = at_lane(&block.speeds, lane);
            let (mut force, mut friction) = (contact.force, scaled(contact.slip, -contact.secant));
            let mut rates = (contact.depth_rate, contact.slip);
            let mut of_ball = moving(speeds, r);
            touching.reaction = [[0.0; 3]; 2];
            if let Some(step) = step.filter(|_| self.free) {
                let places = self.layout.of_element::<OF_BALL>(touching.ball);
                let [of_normal, of_friction] = self.pocket_shares(ws, touching, step.h);
                // Change of approach and slip where a part acts, and the motion of the ball there.
                let changed = |share: f64| {
                    let change = places.map(|i| {
                        (step.mean[i] - v[i]) * (2.0 - 2.0 * share)
                            + (step.end[i] - v[i]) * (2.0 * share - 1.0)
                    });
                    let moved = moving(change, r);
                    let passing = sum(moved.velocity, cross(moved.turning, to_wall));
                    let nearer = dot(passing, contact.normal);
                    (nearer, difference(passing, scaled(contact.normal, nearer)), moved)
                };
                let (nearer, ..) = changed(of_normal);
                let (_, rubbed, _) = changed(of_friction);
                let (mean_nearer, mean_slip, mean) = changed(0.5);
                let by_normal = contact.damping * nearer;
                let by_friction = scaled(rubbed, -contact.secant);
                let [_, on_cage] = contact.wrenches_of(by_normal, by_friction);
                touching.reaction = on_cage.map(|v| to_global(v, direction));
                force += by_normal;
                friction = sum(friction, by_friction);
                rates = (rates.0 + mean_nearer, sum(rates.1, mean_slip));
                of_ball = Moving {
                    velocity: sum(of_ball.velocity, mean.velocity),
                    turning: sum(of_ball.turning, mean.turning),
                };
            }
            let [_, spring] = pockets.spring(contact.depth);
            touching.normal = force;
            touching.friction = friction;
            touching.powers = [-(force - spring) * rates.0, dot(friction, rates.1)];
            let [on_ball, _] = contact.wrenches_of(force, friction);
            touching.on_ball = power(on_ball, &of_ball);
        }
        ws.cage.touching = list;
    }

    /// Force and moment on the cage in the step from the last evaluated state.
    pub(super) fn on_cage_in_step(ws: &Workspace) -> [Vector<f64>; 2] {
        ws.cage.touching.iter().fold(ws.cage.on_cage, |sum, touching| added(sum, touching.reaction))
    }

    /// Powers of pockets, lands and the load of the cage, W.
    pub(super) fn add_cage_powers(&self, ws: &Workspace, p: &mut [f64]) {
        let Some(cage) = &self.cage else { return };
        for touching in &ws.cage.touching {
            let [damping, friction] = touching.powers;
            p[Power::PocketDamping as usize] += damping;
            p[Power::PocketFriction as usize] += friction;
            if !self.free {
                p[Power::ElementDrive as usize] -= touching.on_ball;
            }
        }
        for (land, force) in cage.lands.iter().zip(&ws.cage.lands) {
            let bodies = [&ws.cage.moving.moving, &ws.rings[land.ring].moving];
            let total = |on: &[[Vector<f64>; 2]; 2]| power(on[0], bodies[0]) + power(on[1], bodies[1]);
            let film = total(&force.by_film);
            p[Power::GuideFilm as usize] += film;
            p[Power::GuideSolid as usize] += total(&force.on) - film;
        }
        p[Power::Loads as usize] += power(ws.cage.load, &ws.cage.moving.moving);
    }

    /// Springs of pockets hold this energy, J.
    pub(super) fn energy_in_pockets(&self, ws: &Workspace) -> f64 {
        let pockets = self.cage.as_ref().and_then(|cage| cage.pockets.as_ref());
        pockets.map_or(0.0, |pockets| {
            ws.cage.touching.iter().map(|touching| pockets.spring(touching.contact.depth)[0]).sum()
        })
    }

    /// Highest frequency of the cage between its pockets and in its lands, rad/s; zero without a cage.
    pub(super) fn cage_frequency(&self) -> f64 {
        let Some(cage) = &self.cage else { return 0.0 };
        let pitch = self.balls.set.pitch_radius;
        let pocket = cage.pockets.as_ref().map_or(0.0, BallPockets::stiffness);
        let of_lands = cage.lands.iter().map(|land| {
            let stiffness = land.stiffness();
            cage.body.frequency_on(stiffness, land.reach())
        });
        of_lands.fold(cage.body.frequency_on(pocket, pitch), f64::max)
    }

    /// The longest step (s) from a state in which no onset of a land is passed unseen.
    pub(super) fn longest_cage_step(
        &self,
        [q, v]: [&[f64]; 2],
        inputs: &InputValues,
        tuning: &Tuning,
    ) -> f64 {
        let Some(cage) = self.cage.as_ref().filter(|cage| !cage.lands.is_empty()) else {
            return f64::INFINITY;
        };
        let of_ring = self.layout.range(crate::bodies::INNER_RING);
        let first = self.layout.range(crate::bodies::CAGE).start;
        let state = CageState {
            position: std::array::from_fn(|k| q[first + k]),
            rate: std::array::from_fn(|k| v[first + k]),
        };
        let moving = state.motion();
        let outer = turning_outer(inputs.of(Input::OuterRingSpeed));
        let inner = self.ring.state(&q[of_ring.clone()], &v[of_ring], inputs).motion();
        let rings = [outer, inner];
        let longest = |land: &Land| land.longest_step(cage.body.mass(), &moving, &rings[land.ring], tuning);
        cage.lands.iter().map(longest).fold(f64::INFINITY, f64::min)
    }
}

/// Damping and friction, as secants, of a contact with an element of prescribed motion, over the rates of the cage.
fn secant_of(
    ws: &Workspace,
    ball: usize,
    contact: &PocketContact<f64>,
    cage: &MovingCage<Dual<OF_CAGE>>,
) -> [Vector<Dual<OF_CAGE>>; 2] {
    let (block, lane) = place_of(ball);
    let direction = at_lane(&ws.blocks[block].direction, lane);
    let lift = |v: Vector<f64>| to_global(v, direction).map(Dual::lift);
    let (lever, normal) = (lift(contact.levers[1]), lift(contact.normal));
    let of_cage = sum(cage.moving.velocity, cross(cage.moving.turning, lever));
    let nearer = dot(of_cage, normal);
    let across = difference(of_cage, scaled(normal, nearer));
    let pushed = sum(scaled(normal, nearer * contact.damping), scaled(across, Dual::lift(contact.secant)));
    let force = pushed.map(|f| -f);
    [force, cross(lever, force)]
}

/// The outer ring at this speed, rad/s.
pub(super) fn turning_outer<T: Numeric>(speed: T) -> MovingRing<T> {
    let zero = speed.like(0.0);
    MovingRing {
        centre: [zero; 3],
        axis: [speed.like(1.0), zero, zero],
        moving: Moving { velocity: [zero; 3], turning: [speed, zero, zero] },
        speed,
    }
}

/// A ring with constant numbers.
fn lifted<T: Real>(ring: &MovingRing<f64>) -> MovingRing<T> {
    let lift = |v: Vector<f64>| v.map(T::lift);
    MovingRing {
        centre: lift(ring.centre),
        axis: lift(ring.axis),
        moving: Moving { velocity: lift(ring.moving.velocity), turning: lift(ring.moving.turning) },
        speed: T::lift(ring.speed),
    }
}
