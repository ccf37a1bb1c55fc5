//! The cage among balls and rings: its pockets and lands at a state, in a semi-implicit step, and how they oppose velocities.

mod along;
pub(super) mod memory;
mod report;
mod slopes;
mod step;

pub(crate) use report::OfCage;

use super::Space;
use super::workspace::{Workspace, at_lane};
use crate::bodies::{
    Balls, CAGE, CageState, Fault, Input, InputValues, MovingRing, OF_CAGE, Power, displaced, tilt_of,
};
use crate::integrate::Tuning;
use crate::laws::guide::bent::Wanted;
use crate::pairs::Law;
use crate::pairs::ball_pocket::{BallAt, BallPockets, WALLS};
use crate::pairs::guide::land::Land;
use crate::scalar::{Numeric, Real, math, place_of};
use crate::space::solid::{LARGEST_TILT, Moving, Vector, added, numbers, scaled, to_global};
use memory::{CageMemory, Touching};

impl Space {
    /// Finds how the cage moves.
    pub(super) fn locate_cage(&self, q: &[f64], v: &[f64], ws: &mut Workspace) -> Result<(), Fault> {
        let Some(cage) = &self.cage else { return Ok(()) };
        let first = self.layout.range(CAGE).start;
        let memory = &mut ws.cage;
        memory.state.position.copy_from_slice(&q[first..first + OF_CAGE]);
        memory.state.rate.copy_from_slice(&v[first..first + OF_CAGE]);
        for (to, from) in memory.of_modes.iter_mut().zip([q, v]) {
            to.copy_from_slice(&from[first + OF_CAGE..][..cage.body.bending()]);
        }
        let [x, y, z, ..] = memory.state.position;
        let off = math::hypot(x, math::hypot(y, z));
        if off > self.set.pitch_radius || tilt_of(&memory.state.position) > LARGEST_TILT {
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
            moving: Balls::moving(at_lane(&block.speeds, lane), self.set.pitch_radius + at[1]),
            excess: block.excess[lane],
            bent: self.displaced_pocket(ws, j),
        }
    }

    /// By how much a cage that bends displaces pocket `j`, outwards and ahead, m, and the rates of that.
    pub(super) fn displaced_pocket(&self, ws: &Workspace, j: usize) -> Option<[[f64; 2]; 2]> {
        let body = &self.cage.as_ref()?.body;
        (body.bending() > 0).then(|| ws.cage.bending().map(|x| displaced(body.displacements(j), x)))
    }

    /// Finds the forces of pockets and lands, and adds those on the balls to what acts on these.
    pub(super) fn apply_cage(&self, ws: &mut Workspace) -> Result<(), Fault> {
        let Some(cage) = &self.cage else { return Ok(()) };
        ws.cage.touching.clear();
        ws.cage.by_pockets = [[0.0; 3]; 2];
        ws.cage.on_modes[0].fill(0.0);
        if let Some(pockets) = &cage.pockets {
            self.touch_pockets(pockets, ws)?;
        }
        self.add_rollers_to_cage(ws);
        ws.cage.on_cage = added(ws.cage.load, ws.cage.by_pockets);
        for (k, land) in cage.lands.iter().enumerate() {
            let Workspace { cage: memory, rings, fluid, .. } = ws;
            let CageMemory { moving, lands, on_cage, of_modes, on_modes, bent, .. } = memory;
            let found = match bent.get_mut(k) {
                None => land.force(moving, &rings[land.ring], *fluid),
                Some(bent) => {
                    let of_modes = of_modes.each_ref().map(Vec::as_slice);
                    let wanted = (*fluid, Wanted::Forces);
                    let found = land.bend(moving, &rings[land.ring], of_modes, wanted, bent);
                    on_modes[0].iter_mut().zip(&bent.on_modes[0]).for_each(|(sum, force)| *sum += force);
                    found
                }
            };
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
        let furthest = self.set.radius / self.set.pitch_radius;
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
                let [on_ball, on_cage] = contact.wrenches();
                for (sum, x) in ws.blocks[block].on_ball.iter_mut().zip(numbers(on_ball)) {
                    sum[lane] += x;
                }
                if let Some(cage) = self.cage.as_ref().filter(|_| ball.bent.is_some()) {
                    let by = contact.on_bending(on_cage[0]);
                    add_to_modes(&mut ws.cage.on_modes[0], cage.body.displacements(j), by);
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
                    on_bending: [0.0; 2],
                });
            }
        }
        Ok(())
    }

    /// Writes the accelerations of the cage under this force and moment, and these forces over its modes.
    fn accelerate_cage_by(&self, ws: &Workspace, on_cage: [Vector<f64>; 2], on_modes: &[f64], a: &mut [f64]) {
        if let Some(cage) = &self.cage {
            let (own, of_modes) = a[self.layout.range(CAGE)].split_at_mut(OF_CAGE);
            let on = (on_cage, on_modes);
            let bending = ws.cage.bending();
            let all = cage.body.bent_accelerations(&ws.cage.state, on, bending, self.gravity, of_modes);
            own.copy_from_slice(&all);
        }
    }

    /// Writes the accelerations of the cage at the last evaluated state.
    pub(super) fn accelerate_cage(&self, ws: &Workspace, a: &mut [f64]) {
        self.accelerate_cage_by(ws, ws.cage.on_cage, &ws.cage.on_modes[0], a);
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
        let [film, solid] = self.guide_powers(ws);
        p[Power::GuideFilm as usize] += film;
        p[Power::GuideSolid as usize] += solid;
        let [_, rates] = ws.cage.bending();
        // Memory checkers take the empty chain of the modes of a rigid cage for one that nobody has set.
        if !rates.is_empty() {
            let lost: f64 = cage.body.damping_of_modes().zip(rates).map(|(damping, v)| damping * v * v).sum();
            p[Power::CageBending as usize] -= lost;
        }
        p[Power::Loads as usize] += ws.cage.moving.moving.power(ws.cage.load);
    }

    /// Powers of the films of all lands, and of their solid contacts, W.
    fn guide_powers(&self, ws: &Workspace) -> [f64; 2] {
        let mut sum = [0.0; 2];
        let [_, rates] = ws.cage.bending();
        let lands = self.cage.iter().flat_map(|cage| &cage.lands);
        for (k, (land, force)) in lands.zip(&ws.cage.lands).enumerate() {
            let bodies = [&ws.cage.moving.moving, &ws.rings[land.ring].moving];
            let total = |on: &[[Vector<f64>; 2]; 2]| bodies[0].power(on[0]) + bodies[1].power(on[1]);
            let [bending, bending_by_film] = ws.cage.bent.get(k).map_or([0.0; 2], |bent| {
                bent.on_modes.each_ref().map(|on| on.iter().zip(rates).map(|(f, v)| f * v).sum())
            });
            let film = total(&force.by_film) + bending_by_film;
            sum[0] += film;
            sum[1] += total(&force.on) + bending - film;
        }
        sum
    }

    /// Energy of the bent ring, J.
    pub(super) fn energy_of_bending(&self, ws: &Workspace) -> f64 {
        let Some(cage) = &self.cage else { return 0.0 };
        cage.body.energy(&ws.cage.state, ws.cage.bending(), self.gravity).elastic
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
        let pitch = self.set.pitch_radius;
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
        let first = self.layout.range(CAGE).start;
        let state = CageState {
            position: std::array::from_fn(|k| q[first + k]),
            rate: std::array::from_fn(|k| v[first + k]),
        };
        let moving = state.motion();
        let of_modes = [q, v].map(|x| &x[first + OF_CAGE..][..cage.body.bending()]);
        let outer = turning_outer(inputs.of(Input::OuterRingSpeed));
        let inner = self.ring.state(&q[of_ring.clone()], &v[of_ring], inputs).motion();
        let rings = [outer, inner];
        let longest =
            |land: &Land| land.longest_step(cage.body.mass(), (&moving, of_modes), &rings[land.ring], tuning);
        cage.lands.iter().map(longest).fold(f64::INFINITY, f64::min)
    }
}

/// Adds forces over a pocket's displacement to those over the modes, which displace it like this.
pub(super) fn add_to_modes(on_modes: &mut [f64], displacements: &[[f64; 2]], [outwards, ahead]: [f64; 2]) {
    for (sum, [x, t]) in on_modes.iter_mut().zip(displacements) {
        *sum += x * outwards + t * ahead;
    }
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
