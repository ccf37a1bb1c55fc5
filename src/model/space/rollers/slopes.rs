//! Exact derivatives of what contacts of rollers do, by dual numbers over the coordinates of a roller and its mate.
//!
//! The laws of all slices are differentiated in lanes over what they see, geometry and wrenches slice by slice over the coordinates themselves. Ends of
//! loaded parts move as the roots that they are: s' = -(d(delta)/dq)/(d(delta)/ds).

use super::super::Space;
use super::super::cage::turning_outer;
use super::super::linearize::RingSlopes;
use super::super::workspace::Workspace;
use super::contacts::{Contact, Place};
use super::varied::{
    ALL, AT_ONCE, BENT, Edges, MATE, MATE_RATES, OF_MATE, PASSES, POSITIONS, Pass, SPEEDS, TIME, Varied,
    global, local, turned_ring, varied_cage,
};
use super::{RollersOfScene, as_ring};
use crate::bodies::{
    CAGE, INNER_RING, Input, InputValues, MovingRing, OF_RING, OF_ROLLER, RingState, RollerState,
};
use crate::integrate::Linearization;
use crate::pairs::roller::{OnRaceway, Spot};
use crate::scalar::{Dual, Numeric};
use crate::space::solid::{Vector, cross, dot, scaled, sum};
use nalgebra::DMatrix;

/// Coordinates of a ring among those of a mate.
const OF_RING_IN_MATE: [usize; OF_RING] = [0, 1, 2, 4, 5];

/// What a roller's own motion follows: rho, azimuth, skew, tilt, speeds.
const OWN: usize = 4 + OF_ROLLER;

/// Forces on a mate: force, moment, those over the displacement of a pocket.
const ON_MATE: usize = 8;

/// Derivatives of forces over the speeds of a roller, and of those on its mate, by directions.
struct Slopes {
    on_roller: [[f64; OF_ROLLER]; ALL],
    on_mate: [[f64; ON_MATE]; ALL],
}

/// What a contact does to a roller, where that is from the centre of the mate, and forces over the displacement of its pocket.
struct OnBoth {
    on_roller: OnRoller,
    from_mate: Vector<Varied>,
    over_bending: [Varied; 2],
}

/// Force and moment on a roller, of which `own` turns it about its axis.
struct OnRoller {
    force: Vector<Varied>,
    moment: Vector<Varied>,
    own: Varied,
}

impl OnRoller {
    fn none() -> Self {
        let zero = Varied::lift(0.0);
        Self { force: [zero; 3], moment: [zero; 3], own: zero }
    }

    /// Adds the forces at a place: normal force, secant of friction, rolling resistance. Once in the library: it is long.
    #[inline(never)]
    fn add(&mut self, spot: &Spot<Varied>, [normal, secant, rolling]: [Varied; 3], axis: Vector<Varied>) {
        let [along, across] = spot.slip.map(|slip| -(secant * slip));
        for (wrench, factor, turns) in [
            (&spot.normal, normal, false),
            (&spot.along, along, true),
            (&spot.across, across, true),
            (&spot.rolling, rolling, true),
        ] {
            let moment = scaled(wrench[1], factor);
            self.force = sum(self.force, scaled(wrench[0], factor));
            self.moment = sum(self.moment, moment);
            if turns {
                self.own += dot(moment, axis);
            }
        }
    }
}

impl Space {
    /// Adds what follows from rollers, while the inputs change at `rates` and the logarithm of the viscosity at `ln_rate`; `ring` are the
    /// accelerations of the ring over what its motion follows.
    pub(in super::super) fn add_roller_slopes(
        &self,
        ws: &mut Workspace,
        (rates, ln_rate): (&InputValues, f64),
        ring: &RingSlopes,
        out: &mut Linearization<OF_ROLLER>,
    ) {
        let Some(rollers) = &self.rollers else { return };
        ws.rollers.differentiate(ws.fluid.ln_viscosity, ws.instructions);
        for j in 0..ws.rollers.rollers.len() {
            self.add_own_roller_slopes(rollers, ws, j, out);
        }
        for place in 0..ws.rollers.contacts.len() {
            let contact = ws.rollers.contacts[place];
            let mut slopes = Slopes { on_roller: [[0.0; OF_ROLLER]; ALL], on_mate: [[0.0; ON_MATE]; ALL] };
            for pass in 0..PASSES {
                let pass = Pass { first: pass * AT_ONCE };
                self.find_slopes(rollers, ws, &contact, pass, (rates, ln_rate), &mut slopes);
            }
            self.add_to_roller(rollers, ws, &contact, &slopes.on_roller, out);
            self.add_to_mate(&contact, &slopes.on_mate, (ring, &ws.cage.by_forces), out);
        }
    }

    /// Finds the slopes of a contact along the directions of a pass.
    fn find_slopes(
        &self,
        rollers: &RollersOfScene,
        ws: &Workspace,
        contact: &Contact,
        pass: Pass,
        rates: (&InputValues, f64),
        slopes: &mut Slopes,
    ) {
        let (state, direction) = self.varied_roller(rollers, pass, ws, contact.roller);
        let OnBoth { on_roller: on, from_mate, over_bending } =
            self.varied_contact(rollers, ws, (contact, pass), rates, &state, direction);
        let forces = state.over_speeds([on.force, on.moment], on.own);
        let about = sum(on.moment, cross(from_mate, on.force));
        let [force, moment] = [on.force, about].map(|v| global(v.map(|x| -x), direction));
        let ([a, b, c], [d, e, f], [out_of, ahead]) = (force, moment, over_bending);
        let on_mate = [a, b, c, d, e, f, out_of, ahead];
        for place in 0..AT_ONCE {
            slopes.on_roller[pass.first + place] = forces.map(|force| force.eps[place]);
            slopes.on_mate[pass.first + place] = on_mate.map(|force| force.eps[place]);
        }
    }

    /// Roller `j` over its coordinates, and the direction of its azimuth.
    fn varied_roller(
        &self,
        rollers: &RollersOfScene,
        pass: Pass,
        ws: &Workspace,
        j: usize,
    ) -> (RollerState<Varied>, [Varied; 2]) {
        let of = &ws.rollers.rollers[j];
        let variable = |x: f64, k: usize| pass.variable(x, k);
        let [cos, sin] = of.direction;
        let direction = [pass.along(Varied::lift(cos), 2, -sin), pass.along(Varied::lift(sin), 2, cos)];
        let at = [variable(of.state.at[0], 0), variable(of.state.at[1], 1)];
        let angles = [variable(of.state.angles[0], 3), variable(of.state.angles[1], 4)];
        let speeds = std::array::from_fn(|k| variable(of.state.speeds[k], SPEEDS + k));
        (RollerState::new((self.set.pitch_radius, rollers.body.inclination), at, angles, speeds), direction)
    }

    /// A ring over its coordinates, in the axes of this direction.
    fn varied_ring(
        &self,
        pass: Pass,
        ws: &Workspace,
        side: usize,
        rates: &InputValues,
        direction: [Varied; 2],
    ) -> MovingRing<Varied> {
        let ring = if side == 0 {
            turning_outer(pass.timed(Varied::lift(ws.rings[0].speed), rates.of(Input::OuterRingSpeed)))
        } else {
            let [at, rate, second] = self.ring.given(rates);
            let place = |k: usize| OF_RING_IN_MATE[k];
            let variable = |x: f64, k: usize| pass.variable(x, k);
            RingState {
                position: std::array::from_fn(|k| {
                    pass.timed(variable(ws.ring.position[k], MATE + place(k)), at[k])
                }),
                rate: std::array::from_fn(|k| {
                    pass.timed(variable(ws.ring.rate[k], MATE_RATES + place(k)), rate[k])
                }),
                given: second.map(Varied::lift),
                speed: pass.timed(Varied::lift(ws.ring.speed), rates.of(Input::RingSpeed)),
            }
            .motion()
        };
        turned_ring(&ring, direction)
    }

    /// What a contact does to the roller, and where that is from the centre of the mate.
    fn varied_contact(
        &self,
        rollers: &RollersOfScene,
        ws: &Workspace,
        (contact, pass): (&Contact, Pass),
        (rates, ln_rate): (&InputValues, f64),
        state: &RollerState<Varied>,
        direction: [Varied; 2],
    ) -> OnBoth {
        let ln_viscosity = pass.timed(Varied::lift(ws.fluid.ln_viscosity), ln_rate);
        let mut on_roller = OnRoller::none();
        let side = match contact.place {
            Place::Raceway(side) => side,
            Place::Bar(wall) => {
                return self.varied_bar(rollers, ws, (contact, wall, pass), ln_viscosity, state, direction);
            }
            Place::End(k, mate) => {
                let ring = if mate == CAGE {
                    turned_ring(&as_ring(&varied_cage(pass, ws).motion()), direction)
                } else {
                    self.varied_ring(pass, ws, mate, rates, direction)
                };
                let end = &rollers.ends[k];
                let touch = end.geometry.touch(&state.motion(), &ring, rollers.shapes.longer(contact.roller));
                if let Some(force) = end.law.alone(&touch.spot, ln_viscosity) {
                    let forces = [force.normal, force.secant, force.rolling];
                    on_roller.add(&touch.spot, forces, state.axis);
                }
                let [cx, cr, ct] = ring.centre;
                let from_mate = [state.at[0] - cx, state.r - cr, -ct];
                return OnBoth { on_roller, from_mate, over_bending: [Varied::lift(0.0); 2] };
            }
        };
        let on = OnRaceway {
            geometry: &rollers.geometry,
            profile: rollers.shapes.surface(side, contact.roller),
            side,
            ring: self.varied_ring(pass, ws, side, rates, direction),
            roller: state.motion(),
            excess: self.set.radius_excess[contact.roller],
        };
        let a = rollers.shapes.half_length(contact.roller);
        let discs = [-a, 0.0, a].map(|s| on.disc(None, Varied::lift(s)));
        let middle = on.middle(&discs[1]);
        let slices = Edges::new(rollers, side, contact, discs.map(|disc| (disc.delta, disc.in_raceway)));
        for node in ws.rollers.places(contact) {
            let [s, share] = slices.slice(node);
            let spot = on.spot(&middle, s, on.disc(on.profile, s));
            if let Some(slices) = &ws.rollers.laws[side] {
                let forces = slices.varied(node.row, &spot, ln_viscosity);
                on_roller.add(&spot, forces.map(|force| force * share), state.axis);
            }
        }
        let [x, rho] = state.at;
        let [cx, cr, ct] = on.ring.centre;
        let from_mate = [x - cx, rho + rollers.geometry.pitch_radius - cr, -ct];
        OnBoth { on_roller, from_mate, over_bending: [Varied::lift(0.0); 2] }
    }

    /// The same of a bar.
    fn varied_bar(
        &self,
        rollers: &RollersOfScene,
        ws: &Workspace,
        (contact, wall, pass): (&Contact, usize, Pass),
        ln_viscosity: Varied,
        state: &RollerState<Varied>,
        direction: [Varied; 2],
    ) -> OnBoth {
        let none = [Varied::lift(0.0); 3];
        let mut out = OnBoth { on_roller: OnRoller::none(), from_mate: none, over_bending: [none[0]; 2] };
        let Some(bars) = &rollers.bars else { return out };
        let j = contact.roller;
        let variable = |x: f64, k: usize| pass.variable(x, k);
        let cage = varied_cage(pass, ws).motion();
        let mut lead = Varied::lift(ws.rollers.rollers[j].travel - ws.cage.moving.angle);
        lead = pass.along(pass.along(lead, 2, 1.0), MATE + 3, -1.0);
        let bent = self.displaced_pocket(ws, j).map(|bent| {
            let at = |i: usize, k: usize| variable(bent[i][k], BENT + 2 * i + k);
            [[at(0, 0), at(0, 1)], [at(1, 0), at(1, 1)]]
        });
        let place = bars.place(&state.motion(), direction, lead, &cage, bent);
        let surface = rollers.shapes.surface(0, j);
        let law = &rollers.laws[contact.law];
        for node in ws.rollers.places(contact) {
            let s = node.slice.place;
            let drop = surface.map_or(0.0, |surface| surface.of_roller(s));
            let spot = bars.spot(&place, wall, s, self.set.radius_excess[j], drop).spot;
            let forces = match &ws.rollers.laws[contact.law] {
                Some(slices) => slices.varied(node.row, &spot, ln_viscosity),
                None => match law.alone(&spot, ln_viscosity) {
                    Some(force) => [force.normal, force.secant, force.rolling],
                    None => continue,
                },
            };
            let share = node.slice.share;
            out.on_roller.add(&spot, forces.map(|force| force * share), state.axis);
        }
        let centre = local(cage.centre, direction);
        out.from_mate = [state.at[0] - centre[0], state.r - centre[1], -centre[2]];
        if bent.is_some() {
            out.over_bending = place.displaced.map(|axis| -dot(axis, out.on_roller.force));
        }
        out
    }

    /// Adds how the accelerations of roller `j` follow its own coordinates at constant forces.
    fn add_own_roller_slopes(
        &self,
        rollers: &RollersOfScene,
        ws: &Workspace,
        j: usize,
        out: &mut Linearization<OF_ROLLER>,
    ) {
        type Own = Dual<OWN>;
        let of = &ws.rollers.rollers[j];
        let variable = Own::variable;
        let at = [Own::lift(of.state.at[0]), variable(of.state.at[1], 0)];
        let angles = [variable(of.state.angles[0], 2), variable(of.state.angles[1], 3)];
        let speeds = std::array::from_fn(|k| variable(of.state.speeds[k], 4 + k));
        let state = RollerState::new((self.set.pitch_radius, rollers.body.inclination), at, angles, speeds);
        let ([cos, sin], [gy, gz]) = (of.direction, self.gravity);
        let [outwards, ahead] = [gy * cos + gz * sin, gz * cos - gy * sin];
        let mut gravity = [Own::lift(outwards), Own::lift(ahead)];
        (gravity[0].eps[1], gravity[1].eps[1]) = (ahead, -outwards);
        let inertia = rollers.body.inertia(j);
        let by_forces = state.accelerated(inertia, of.forces.map(Own::lift));
        let drift = state.drift(inertia, gravity);
        let to = out.over_positions.own.as_mut_slice().as_chunks_mut::<OF_ROLLER>().0;
        for row in 0..OF_ROLLER {
            let slopes: [f64; OWN] = std::array::from_fn(|d| by_forces[row].eps[d] + drift[row].eps[d]);
            for (d, column) in [1, 2, 3, 4].into_iter().enumerate() {
                to[j * OF_ROLLER + column][row] += slopes[d];
            }
            let to = out.over_velocities.own.as_mut_slice().as_chunks_mut::<OF_ROLLER>().0;
            for column in 0..OF_ROLLER {
                to[j * OF_ROLLER + column][row] += slopes[4 + column];
            }
        }
    }

    /// Where the coordinates of a mate are in the hub: place among those of [`OF_MATE`], place in the hub.
    fn mate_in_hub(&self, mate: usize) -> Vec<(usize, usize)> {
        match mate {
            CAGE => (0..OF_MATE).map(|k| (k, self.layout.range(CAGE).start + k)).collect(),
            INNER_RING => {
                let first = self.layout.range(INNER_RING).start;
                self.ring.free().enumerate().map(|(i, k)| (OF_RING_IN_MATE[k], first + i)).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Places of the modes of a cage that bends in the hub.
    fn modes_in_hub(&self) -> std::ops::Range<usize> {
        let of_cage = self.layout.range(CAGE);
        (of_cage.start + OF_MATE).min(of_cage.end)..of_cage.end
    }

    /// How the modes of a cage that bends displace the pocket of a contact with it.
    fn displacements_of(&self, contact: &Contact) -> &[[f64; 2]] {
        match &self.cage {
            Some(cage) if contact.place.mate() == CAGE => cage.body.displacements(contact.roller),
            _ => &[],
        }
    }

    /// Adds how forces of a contact over the speeds of its roller accelerate that.
    fn add_to_roller(
        &self,
        rollers: &RollersOfScene,
        ws: &Workspace,
        contact: &Contact,
        slopes: &[[f64; OF_ROLLER]; ALL],
        out: &mut Linearization<OF_ROLLER>,
    ) {
        let (j, width) = (contact.roller, self.layout.hub());
        let of = &ws.rollers.rollers[j];
        let inertia = rollers.body.inertia(j);
        let column = |d: usize| of.state.accelerated(inertia, slopes[d]);
        let add = |to: &mut [f64; OF_ROLLER], by: [f64; OF_ROLLER]| {
            to.iter_mut().zip(by).for_each(|(to, x)| *to += x);
        };
        let places = self.layout.of_element::<OF_ROLLER>(j);
        for (place, x) in places.into_iter().zip(column(TIME)) {
            out.over_time[place] += x;
        }
        let mates = self.mate_in_hub(contact.place.mate());
        let displacements = self.displacements_of(contact);
        for (part, first, count, [of_mate, bent]) in [
            (&mut out.over_positions, 0, POSITIONS, [MATE, BENT]),
            (&mut out.over_velocities, SPEEDS, OF_ROLLER, [MATE_RATES, BENT + 2]),
        ] {
            let own = part.own.as_mut_slice().as_chunks_mut::<OF_ROLLER>().0;
            for k in 0..count {
                add(&mut own[j * OF_ROLLER + k], column(first + k));
            }
            let from_hub = part.from_hub.as_mut_slice().as_chunks_mut::<OF_ROLLER>().0;
            for (k, place) in &mates {
                add(&mut from_hub[j * width + place], column(of_mate + k));
            }
            for (place, [x, t]) in self.modes_in_hub().zip(displacements) {
                let [by_x, by_t] = [column(bent), column(bent + 1)];
                add(&mut from_hub[j * width + place], std::array::from_fn(|k| by_x[k] * x + by_t[k] * t));
            }
        }
    }

    /// Adds what force and moment on a mate do to it.
    fn add_to_mate(
        &self,
        contact: &Contact,
        slopes: &[[f64; ON_MATE]; ALL],
        (ring, by_forces): (&RingSlopes, &DMatrix<f64>),
        out: &mut Linearization<OF_ROLLER>,
    ) {
        let mate = contact.place.mate();
        let displacements = self.displacements_of(contact);
        let rows: Vec<(usize, [f64; 6], [f64; 2])> = match mate {
            CAGE => {
                let first = self.layout.range(CAGE).start;
                let over = |i: usize, k: usize| {
                    let by = displacements.iter().enumerate().map(|(m, at)| by_forces[(i, 6 + m)] * at[k]);
                    by.sum::<f64>()
                };
                let row = |i: usize| {
                    (first + i, std::array::from_fn(|w| by_forces[(i, w)]), [over(i, 0), over(i, 1)])
                };
                (0..by_forces.nrows()).map(row).collect()
            }
            INNER_RING => {
                let first = self.layout.range(INNER_RING).start;
                let row =
                    |(i, k): (usize, usize)| (first + i, std::array::from_fn(|w| ring[k].eps[w]), [0.0; 2]);
                self.ring.free().enumerate().map(row).collect()
            }
            _ => return,
        };
        let mates = self.mate_in_hub(mate);
        for (place, by, by_bending) in rows {
            let slope = |d: usize| {
                let bending = by_bending[0] * slopes[d][6] + by_bending[1] * slopes[d][7];
                (0..6).map(|w| by[w] * slopes[d][w]).sum::<f64>() + bending
            };
            out.over_time[place] += slope(TIME);
            for (part, first, count, [of_mate, bent]) in [
                (&mut out.over_positions, 0, POSITIONS, [MATE, BENT]),
                (&mut out.over_velocities, SPEEDS, OF_ROLLER, [MATE_RATES, BENT + 2]),
            ] {
                for (column, [x, t]) in self.modes_in_hub().zip(displacements) {
                    part.hub[(place, column)] += slope(bent) * x + slope(bent + 1) * t;
                }
                for k in 0..count {
                    part.to_hub[(place, contact.roller * OF_ROLLER + k)] += slope(first + k);
                }
                for (k, column) in &mates {
                    part.hub[(place, *column)] += slope(of_mate + k);
                }
            }
        }
    }
}
