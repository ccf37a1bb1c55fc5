//! Derivatives of what pockets and lands do, by dual numbers over the coordinates of all that they are between.

use super::super::Space;
use super::super::linearize::RingSlopes;
use super::super::rollers::{AT_ONCE, Pass, Varied};
use super::super::workspace::{Workspace, at_lane};
use super::turning_outer;
use crate::bodies::{
    Balls, CAGE, CageState, INNER_RING, Input, InputValues, MovingRing, OF_BALL, OF_CAGE, OF_RING, RingState,
};
use crate::integrate::Linearization;
use crate::pairs::ball_pocket::{BallAt, BallPockets};
use crate::pairs::guide::land::Land;
use crate::scalar::{Dual, Numeric, place_of};
use crate::space::solid::{numbers, to_global};
use nalgebra::DMatrix;

/// What a pocket sees: x, rho and azimuth of a ball, its six speeds, coordinates of the cage, their rates, displacement of the pocket by
/// bending outwards and ahead, its rates, time.
const IN_POCKET: usize = 3 + OF_BALL + 2 * OF_CAGE + 4 + 1;
const BALL_SPEEDS: usize = 3;
const CAGE_IN_POCKET: usize = 3 + OF_BALL;
const BENT_IN_POCKET: usize = CAGE_IN_POCKET + 2 * OF_CAGE;
const POCKET_TIME: usize = IN_POCKET - 1;
/// Slopes of a force over these.
type PocketSlopes = [f64; IN_POCKET];

/// Slopes of what a pocket does over what it sees, found a few directions at once.
struct OfPocket {
    on_ball: [PocketSlopes; 6],
    on_cage: [PocketSlopes; 6],
    on_bending: [PocketSlopes; 2],
}

/// What a land sees: coordinates of the ring, their rates, coordinates of the cage, their rates, time.
const AT_LAND: usize = 2 * OF_RING + 2 * OF_CAGE + 1;
const CAGE_AT_LAND: usize = 2 * OF_RING;
const LAND_TIME: usize = AT_LAND - 1;
type AtLand = Dual<AT_LAND>;

/// Step of the logarithm of the viscosity for differences.
pub(super) const WARMING: f64 = 1e-4;

/// What also changes with time, the last of what it is differentiated over, at this rate.
pub(super) fn timed<const N: usize>(mut x: Dual<N>, rate: f64) -> Dual<N> {
    x.eps[N - 1] += rate;
    x
}

impl Space {
    /// Adds what follows from the cage, while the inputs change at `rates` and the logarithm of the viscosity at `ln_rate`; `ring` are the
    /// accelerations of the ring over what its motion follows.
    pub(in super::super) fn add_cage_slopes(
        &self,
        ws: &mut Workspace,
        (rates, ln_rate): (&InputValues, f64),
        ring: &RingSlopes,
        out: &mut Linearization<OF_BALL>,
    ) {
        let Some(cage) = &self.cage else { return };
        let mut by_forces = std::mem::take(&mut ws.cage.by_forces);
        self.add_own_slopes(cage, ws, &mut by_forces, out);
        let (first, load_rates) = (self.layout.range(CAGE).start, numbers(cage.body.load(rates)));
        for (i, row) in by_forces.row_iter().enumerate() {
            out.over_time[first + i] += row.iter().zip(load_rates).map(|(by, rate)| by * rate).sum::<f64>();
        }
        for place in 0..ws.cage.touching.len() {
            self.add_pocket_slopes(ws, place, rates, &by_forces, out);
        }
        for (k, land) in cage.lands.iter().enumerate() {
            if cage.body.bending() == 0 {
                self.add_land_slopes(land, ws, (rates, ln_rate), (ring, &by_forces), out);
            } else {
                self.add_bent_land_slopes(k, ws, (rates, ln_rate), (ring, &by_forces), out);
            }
        }
        ws.cage.by_forces = by_forces;
    }

    /// Change of the logarithm of a soap's structure over that of the viscosity.
    pub(super) fn ln_structure_ratio(&self, ws: &Workspace) -> f64 {
        let slope = |oil: &crate::model::signals::Oil| {
            let of_viscosity = oil.law.relative_slope(ws.inputs.of(Input::Temperature));
            oil.thickener.map_or(0.0, |law| law.ln_structure_slope() / of_viscosity)
        };
        self.inputs.oil.as_ref().map_or(0.0, slope)
    }

    fn add_pocket_slopes(
        &self,
        ws: &Workspace,
        place: usize,
        rates: &InputValues,
        by_forces: &DMatrix<f64>,
        out: &mut Linearization<OF_BALL>,
    ) {
        let Some(cage_of_scene) = &self.cage else { return };
        let Some(pockets) = &cage_of_scene.pockets else { return };
        let touching = &ws.cage.touching[place];
        let (j, first, width) = (touching.ball, self.layout.range(CAGE).start, self.layout.hub());
        let (block, lane) = place_of(j);
        let block = &ws.blocks[block];
        let none = [0.0; IN_POCKET];
        let mut slopes = OfPocket { on_ball: [none; 6], on_cage: [none; 6], on_bending: [none; 2] };
        for first in (0..IN_POCKET).step_by(AT_ONCE) {
            if !self.find_pocket_slopes(ws, (pockets, place), rates, Pass { first }, &mut slopes) {
                return;
            }
        }
        let OfPocket { on_ball, on_cage, on_bending } = slopes;
        let displacements = cage_of_scene.body.displacements(j);
        // Over what the modes do to the pocket.
        let over_modes =
            |slopes: &[f64; IN_POCKET], at: usize, [x, t]: [f64; 2]| slopes[at] * x + slopes[at + 1] * t;
        let columns = [
            (0, CAGE_IN_POCKET, BENT_IN_POCKET),
            (BALL_SPEEDS, CAGE_IN_POCKET + OF_CAGE, BENT_IN_POCKET + 2),
        ];
        let positions = [3, OF_BALL];
        let [mass, inertia] = at_lane(&block.inertia, lane);
        let r = self.set.pitch_radius + at_lane(&block.at, lane)[1];
        let inverse = [mass, mass, mass * r, inertia, inertia, inertia].map(|x| 1.0 / x);
        for (i, by) in by_forces.row_iter().enumerate() {
            let mut row = [0.0; IN_POCKET];
            let mut add = |by: f64, force: &PocketSlopes| {
                row.iter_mut().zip(force).for_each(|(sum, slope)| *sum += by * slope);
            };
            on_cage.iter().enumerate().for_each(|(w, force)| add(by[w], force));
            for (k, force) in on_bending.iter().enumerate().filter(|_| !displacements.is_empty()) {
                let by_modes = displacements.iter().enumerate().map(|(m, at)| by[6 + m] * at[k]);
                add(by_modes.sum::<f64>(), force);
            }
            out.over_time[first + i] += row[POCKET_TIME];
            let parts = [&mut out.over_positions, &mut out.over_velocities];
            for ((part, (of_ball, of_cage, of_modes)), positions) in
                parts.into_iter().zip(columns).zip(positions)
            {
                for k in 0..OF_CAGE {
                    part.hub[(first + i, first + k)] += row[of_cage + k];
                }
                for (m, at) in displacements.iter().enumerate() {
                    part.hub[(first + i, first + OF_CAGE + m)] += over_modes(&row, of_modes, *at);
                }
                for k in 0..if self.free { positions } else { 0 } {
                    part.to_hub[(first + i, j * OF_BALL + k)] += row[of_ball + k];
                }
            }
        }
        if !self.free {
            return;
        }
        let parts = [&mut out.over_positions, &mut out.over_velocities];
        for ((part, (of_ball, of_cage, of_modes)), positions) in parts.into_iter().zip(columns).zip(positions)
        {
            let own = part.own.as_mut_slice().as_chunks_mut::<OF_BALL>().0;
            let from_hub = part.from_hub.as_mut_slice().as_chunks_mut::<OF_BALL>().0;
            for row in 0..OF_BALL {
                let slopes = on_ball[row];
                for k in 0..positions {
                    own[j * OF_BALL + k][row] += slopes[of_ball + k] * inverse[row];
                }
                let hub = &mut from_hub[j * width + first..];
                for k in 0..OF_CAGE {
                    hub[k][row] += slopes[of_cage + k] * inverse[row];
                }
                for (m, at) in displacements.iter().enumerate() {
                    hub[OF_CAGE + m][row] += over_modes(&slopes, of_modes, *at) * inverse[row];
                }
            }
        }
    }

    /// Finds those along the directions of a pass; whether there is a contact.
    fn find_pocket_slopes(
        &self,
        ws: &Workspace,
        (pockets, place): (&BallPockets, usize),
        rates: &InputValues,
        pass: Pass,
        slopes: &mut OfPocket,
    ) -> bool {
        let touching = &ws.cage.touching[place];
        let j = touching.ball;
        let (block, lane) = place_of(j);
        let block = &ws.blocks[block];
        let variable = |x: f64, direction: usize| pass.variable(x, direction);
        let timed = |x: Varied, rate: f64| pass.along(x, POCKET_TIME, rate);
        // Elements of prescribed motion go on in time.
        let [orbit, orbit_rate, spin_rate] = if self.free {
            [0.0; 3]
        } else {
            [rates.angles[0], rates.of(Input::OrbitSpeed), rates.of(Input::SpinSpeed)]
        };
        let [x, rho] = at_lane(&block.at, lane);
        let [cos, sin] = at_lane(&block.direction, lane);
        let turning = |x: f64, rate: f64| timed(pass.along(Varied::lift(x), 2, rate), rate * orbit);
        let direction = [turning(cos, -sin), turning(sin, cos)];
        let speeds = at_lane(&block.speeds, lane);
        let mut of_ball: [Varied; OF_BALL] = std::array::from_fn(|k| variable(speeds[k], BALL_SPEEDS + k));
        of_ball[2] = timed(of_ball[2], orbit_rate);
        of_ball[3] = timed(of_ball[3], spin_rate);
        let state = CageState {
            position: std::array::from_fn(|k| variable(ws.cage.state.position[k], CAGE_IN_POCKET + k)),
            rate: std::array::from_fn(|k| variable(ws.cage.state.rate[k], CAGE_IN_POCKET + OF_CAGE + k)),
        };
        let cage = state.motion();
        let rho = variable(rho, 1);
        let lead = pass.along(Varied::lift(block.travel[lane] - ws.cage.moving.angle), 2, 1.0);
        let lead = pass.along(lead, CAGE_IN_POCKET + 3, -1.0);
        let ball = BallAt {
            at: [variable(x, 0), rho],
            direction,
            lead: timed(lead, orbit),
            moving: Balls::moving(of_ball, rho + self.set.pitch_radius),
            excess: block.excess[lane],
            bent: self.displaced_pocket(ws, j).map(|bent| {
                let at = |i: usize, k: usize| variable(bent[i][k], BENT_IN_POCKET + 2 * i + k);
                [[at(0, 0), at(0, 1)], [at(1, 0), at(1, 1)]]
            }),
        };
        let in_pocket = pockets.place(&ball, &cage);
        let Some(contact) = pockets.contact(touching.wall, &ball, &in_pocket, &cage) else { return false };
        let [on_ball, on_cage] = contact.wrenches();
        let on_bending = contact.on_bending(on_cage[0]);
        let on_cage = numbers(on_cage.map(|v| to_global(v, direction)));
        let last = (pass.first + AT_ONCE).min(IN_POCKET);
        let put = |to: &mut PocketSlopes, force: &Varied| {
            to[pass.first..last].copy_from_slice(&force.eps[..last - pass.first]);
        };
        slopes.on_ball.iter_mut().zip(&numbers(on_ball)).for_each(|(to, force)| put(to, force));
        slopes.on_cage.iter_mut().zip(&on_cage).for_each(|(to, force)| put(to, force));
        slopes.on_bending.iter_mut().zip(&on_bending).for_each(|(to, force)| put(to, force));
        true
    }

    fn add_land_slopes(
        &self,
        land: &Land,
        ws: &Workspace,
        (rates, ln_rate): (&InputValues, f64),
        (ring, by_forces): (&RingSlopes, &DMatrix<f64>),
        out: &mut Linearization<OF_BALL>,
    ) {
        let first = self.layout.range(CAGE).start;
        let variable = AtLand::variable;
        let state = CageState {
            position: std::array::from_fn(|k| variable(ws.cage.state.position[k], CAGE_AT_LAND + k)),
            rate: std::array::from_fn(|k| variable(ws.cage.state.rate[k], CAGE_AT_LAND + OF_CAGE + k)),
        };
        let cage = state.motion();
        let moving_ring: MovingRing<AtLand> = if land.ring == 0 {
            turning_outer(timed(AtLand::lift(ws.rings[0].speed), rates.of(Input::OuterRingSpeed)))
        } else {
            let [at, rate, second] = self.ring.given(rates);
            let state = RingState {
                position: std::array::from_fn(|k| timed(variable(ws.ring.position[k], k), at[k])),
                rate: std::array::from_fn(|k| timed(variable(ws.ring.rate[k], OF_RING + k), rate[k])),
                given: second.map(AtLand::lift),
                speed: timed(AtLand::lift(ws.ring.speed), rates.of(Input::RingSpeed)),
            };
            state.motion()
        };
        let Ok(force) = land.force_slopes(&cage, &moving_ring, ws.fluid) else { return };
        let mut on = force.on.map(numbers);
        if ln_rate != 0.0 && land.laws()[0].is_some() {
            let at = |step: f64| {
                let fluid = ws.fluid.moved(step, self.ln_structure_ratio(ws));
                land.force(&ws.cage.moving, &ws.rings[land.ring], fluid).map(|force| force.on.map(numbers))
            };
            if let (Ok(high), Ok(low)) = (at(WARMING), at(-WARMING)) {
                for (body, on) in on.iter_mut().enumerate() {
                    for (w, x) in on.iter_mut().enumerate() {
                        x.eps[LAND_TIME] += ln_rate * (high[body][w] - low[body][w]) / (2.0 * WARMING);
                    }
                }
            }
        }
        let free: Vec<usize> = self.ring.free().collect();
        let of_cage = (0..OF_CAGE).map(|i| (first + i, std::array::from_fn(|w| by_forces[(i, w)]), 0));
        let start = self.layout.range(INNER_RING).start;
        let of_ring = free
            .iter()
            .enumerate()
            .filter(|_| land.ring == 1)
            .map(|(i, k)| (start + i, std::array::from_fn(|w| ring[*k].eps[w]), 1));
        for (place, by, body) in of_cage.chain(of_ring) {
            let by: [f64; 6] = by;
            let slope = |d: usize| (0..6).map(|w| by[w] * on[body][w].eps[d]).sum::<f64>();
            let parts = [&mut out.over_positions, &mut out.over_velocities];
            let columns = [(0, CAGE_AT_LAND), (OF_RING, CAGE_AT_LAND + OF_CAGE)];
            for (part, (over_ring, over_cage)) in parts.into_iter().zip(columns) {
                for k in 0..OF_CAGE {
                    part.hub[(place, first + k)] += slope(over_cage + k);
                }
                for (i, k) in free.iter().enumerate() {
                    part.hub[(place, start + i)] += slope(over_ring + k);
                }
            }
            out.over_time[place] += slope(LAND_TIME);
        }
    }
}
