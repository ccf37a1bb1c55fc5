//! Pockets and lands in a semi-implicit step: how they oppose the velocities of balls and cage, and their forces there.

use super::super::Space;
use super::super::workspace::{Workspace, at_lane};
use super::memory::{CageMemory, CageOfScene, Touching};
use super::{add_to_modes, lifted};
use crate::bodies::{Balls, CageState, MovingCage, OF_BALL, OF_CAGE};
use crate::integrate::{DampingBlock, GroupDamping, SemiImplicit, implicit_share};
use crate::laws::guide::bent::Wanted;
use crate::pairs::ball_pocket::PocketContact;
use crate::pairs::guide::land::OfMode;
use crate::scalar::{Dual, Numeric, place_of};
use crate::space::solid::{Moving, Vector, added, cross, difference, dot, scaled, sum, to_global, to_local};

impl Space {
    /// Writes those by what the forces on it have become in the step of the balls.
    pub(in super::super) fn accelerate_cage_in_step(&self, ws: &mut Workspace, a: &mut [f64]) {
        let Some(cage) = &self.cage else { return };
        let CageMemory { touching, on_modes: [at_state, in_step], on_cage, .. } = &mut ws.cage;
        in_step.copy_from_slice(at_state);
        let mut wrench = *on_cage;
        for touching in &*touching {
            wrench = added(wrench, touching.reaction);
            add_to_modes(in_step, cage.body.displacements(touching.ball), touching.on_bending);
        }
        let mut in_step = std::mem::take(&mut ws.cage.on_modes[1]);
        self.add_reaction_to_cage(ws, &mut wrench, &mut in_step);
        self.accelerate_cage_by(ws, wrench, &in_step, a);
        ws.cage.on_modes[1] = in_step;
    }

    /// Shares of damping and friction of a contact that act on the change of a ball in a step of size `h`, s.
    fn pocket_shares(&self, ws: &Workspace, touching: &Touching, h: f64) -> [f64; 2] {
        if !self.free {
            return [0.5; 2];
        }
        let (block, lane) = place_of(touching.ball);
        let [mass, inertia] = at_lane(&ws.blocks[block].inertia, lane);
        let radius = self.set.radius;
        let PocketContact { damping, secant, .. } = touching.contact;
        let rubbing = secant * (1.0 / mass + radius * radius / inertia);
        [damping / mass, rubbing].map(|rate| implicit_share(rate * h))
    }

    /// Adds the damping of balls by their pockets.
    pub(in super::super) fn damp_in_pockets(&self, h: f64, ws: &Workspace, out: &mut GroupDamping<OF_BALL>) {
        for touching in ws.cage.touching.iter().filter(|_| self.free) {
            let (block, lane) = place_of(touching.ball);
            let of_ball = &ws.blocks[block];
            let [mass, inertia] = at_lane(&of_ball.inertia, lane);
            let r = self.set.pitch_radius + of_ball.at[1][lane];
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

    /// Forces and powers of pockets in a step from the last evaluated state, or at that state.
    pub(in super::super) fn find_cage_step(
        &self,
        v: &[f64],
        step: Option<&SemiImplicit<'_>>,
        ws: &mut Workspace,
    ) {
        let Some(pockets) = self.cage.as_ref().and_then(|cage| cage.pockets.as_ref()) else { return };
        let mut list = std::mem::take(&mut ws.cage.touching);
        for touching in &mut list {
            let (block, lane) = place_of(touching.ball);
            let block = &ws.blocks[block];
            let direction = at_lane(&block.direction, lane);
            let contact = &touching.contact;
            let [to_wall, _] = contact.levers;
            let r = self.set.pitch_radius + block.at[1][lane];
            let speeds = at_lane(&block.speeds, lane);
            let (mut force, mut friction) = (contact.force, scaled(contact.slip, -contact.secant));
            let mut rates = (contact.depth_rate, contact.slip);
            let mut of_ball = Balls::moving(speeds, r);
            (touching.reaction, touching.on_bending) = ([[0.0; 3]; 2], [0.0; 2]);
            if let Some(step) = step.filter(|_| self.free) {
                let places = self.layout.of_element::<OF_BALL>(touching.ball);
                let [of_normal, of_friction] = self.pocket_shares(ws, touching, step.h);
                // Change of approach and slip where a part acts, and the motion of the ball there.
                let changed = |share: f64| {
                    let change = places.map(|i| {
                        (step.mean[i] - v[i]) * (2.0 - 2.0 * share)
                            + (step.end[i] - v[i]) * (2.0 * share - 1.0)
                    });
                    let moved = Balls::moving(change, r);
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
                touching.on_bending = contact.on_bending(on_cage[0]);
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
            touching.on_ball = of_ball.power(on_ball);
        }
        ws.cage.touching = list;
    }

    /// Damping of the cage by its lands, its dampers, and elements whose motion is prescribed.
    pub(in super::super) fn damp_cage(&self, h: f64, ws: &mut Workspace, out: &mut DampingBlock) {
        let Some(cage) = &self.cage else { return };
        if cage.body.bending() > 0 {
            self.damp_bent_cage(cage, ws, out);
        } else {
            self.damp_rigid_cage(cage, ws, out);
        }
        out.split(h, if cage.lands.iter().any(|land| land.ring == 1) { 2.0 } else { 1.0 });
    }

    fn damp_rigid_cage(&self, cage: &CageOfScene, ws: &Workspace, out: &mut DampingBlock) {
        type Rate = Dual<OF_CAGE>;
        let state = CageState {
            position: ws.cage.state.position.map(Rate::lift),
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
            on_cage = added(on_cage, secant_of(ws, *ball, contact, &moving, [0.0; 2]));
        }
        // The accelerations are linear in the forces.
        let CageState { position, rate } = ws.cage.state;
        let still = CageState { position: position.map(Dual::lift), rate: rate.map(Dual::lift) };
        for column in 0..OF_CAGE {
            let along = on_cage.map(|v| v.map(|x| Dual::<1> { re: x.re, eps: [x.eps[column]] }));
            let all = cage.body.accelerations(&still, along, self.gravity);
            for (row, a) in all.into_iter().enumerate() {
                out.full[(row, column)] = -a.eps[0];
            }
        }
    }

    /// The same of one that bends, by one rate after the other.
    fn damp_bent_cage(&self, cage: &CageOfScene, ws: &mut Workspace, out: &mut DampingBlock) {
        let mut bent = std::mem::take(&mut ws.cage.bent);
        for (land, memory) in cage.lands.iter().zip(&mut bent) {
            let ring = &ws.rings[land.ring];
            // A film that is gone was told with the forces.
            let _ = land.bend(&ws.cage.moving, ring, ws.cage.bending(), (ws.fluid, Wanted::Damping), memory);
        }
        let mut room = std::mem::take(&mut ws.cage.along);
        let CageState { position, rate } = ws.cage.state;
        let still = CageState { position: position.map(Dual::lift), rate: rate.map(Dual::lift) };
        room.hold(ws.cage.bending());
        for column in 0..OF_CAGE + cage.body.bending() {
            let mut state = still;
            let mode = column.checked_sub(OF_CAGE).map(|place| OfMode { place, rate: true });
            if mode.is_none() {
                state.rate[column].eps[0] = 1.0;
            }
            let moving = state.motion();
            let mut on_cage = [[Dual::lift(0.0); 3]; 2];
            room.on_modes.fill(Dual::lift(0.0));
            for (land, memory) in cage.lands.iter().zip(&bent) {
                let ring = lifted(&ws.rings[land.ring]);
                let force = land.bend_slopes(&moving, &ring, mode, memory, &mut room.by_land);
                on_cage = added(on_cage, force.on[0]);
                room.on_modes.iter_mut().zip(&room.by_land).for_each(|(sum, force)| *sum += *force);
            }
            for Touching { ball, contact, .. } in ws.cage.touching.iter().filter(|_| !self.free) {
                let displacements = cage.body.displacements(*ball);
                let by_mode = mode.map_or([0.0; 2], |mode| displacements[mode.place]);
                let by = secant_of(ws, *ball, contact, &moving, by_mode);
                on_cage = added(on_cage, by);
                let (block, lane) = place_of(*ball);
                let direction = at_lane(&ws.blocks[block].direction, lane);
                let pushed = contact.on_bending(to_local(by[0].map(|f| f.eps[0]), direction));
                for (sum, [x, t]) in room.on_modes.iter_mut().zip(displacements) {
                    sum.eps[0] += x * pushed[0] + t * pushed[1];
                }
            }
            if let Some(mode) = mode {
                let damping = cage.body.damping_of_modes().nth(mode.place).unwrap_or(0.0);
                room.on_modes[mode.place].eps[0] -= damping;
            }
            let bending = room.of_modes.each_ref().map(Vec::as_slice);
            let on = (on_cage, room.on_modes.as_slice());
            let own = cage.body.bent_accelerations(&still, on, bending, self.gravity, &mut room.out);
            for (row, a) in own.iter().chain(&room.out).enumerate() {
                out.full[(row, column)] = -a.eps[0];
            }
        }
        (ws.cage.bent, ws.cage.along) = (bent, room);
    }
}

/// Damping and friction, as secants, of a contact with an element of prescribed motion, over the rates of the cage, where its bending
/// displaces the pocket at these rates, outwards and ahead, in the first direction.
fn secant_of<const N: usize>(
    ws: &Workspace,
    ball: usize,
    contact: &PocketContact<f64>,
    cage: &MovingCage<Dual<N>>,
    by_bending: [f64; 2],
) -> [Vector<Dual<N>>; 2] {
    let (block, lane) = place_of(ball);
    let direction = at_lane(&ws.blocks[block].direction, lane);
    let lift = |v: Vector<f64>| to_global(v, direction).map(Dual::lift);
    let (lever, normal) = (lift(contact.levers[1]), lift(contact.normal));
    let mut of_cage = sum(cage.moving.velocity, cross(cage.moving.turning, lever));
    let bending = to_global(contact.velocity_by_bending(by_bending), direction);
    of_cage.iter_mut().zip(bending).for_each(|(velocity, rate)| velocity.eps[0] += rate);
    let nearer = dot(of_cage, normal);
    let across = difference(of_cage, scaled(normal, nearer));
    let pushed = sum(scaled(normal, nearer * contact.damping), scaled(across, Dual::lift(contact.secant)));
    let force = pushed.map(|f| -f);
    [force, cross(lever, force)]
}
