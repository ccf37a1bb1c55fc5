//! Derivatives along one direction after the other: of the cage's own motion, and of lands on one that bends, whose number of directions
//! depends on its modes.

use super::super::Space;
use super::super::linearize::RingSlopes;
use super::super::workspace::Workspace;
use super::memory::CageOfScene;
use super::slopes::{WARMING, timed};
use super::turning_outer;
use crate::bodies::{
    CAGE, CageState, INNER_RING, Input, InputValues, MOST_MODES, MovingRing, OF_BALL, OF_CAGE, RingState,
};
use crate::integrate::Linearization;
use crate::laws::guide::bent::Wanted;
use crate::pairs::guide::land::{BentLandForces, Land, OfMode};
use crate::scalar::{Dual, Numeric};
use crate::space::solid::numbers;
use nalgebra::DMatrix;

type One = Dual<1>;

/// What changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Along {
    /// A coordinate of the ring, or its rate.
    Ring { place: usize, rate: bool },
    /// A coordinate of the cage, or its rate: of the whole body, then of its modes.
    Cage { place: usize, rate: bool },
    /// Inputs.
    Time,
}

impl Along {
    /// A number that changes, or does not.
    fn seed(self, x: f64, along: Self) -> One {
        Dual { re: x, eps: [f64::from(u8::from(self == along))] }
    }

    /// The whole cage.
    fn cage(self, state: &CageState<f64>) -> CageState<One> {
        let seed = |x: f64, place: usize, rate: bool| self.seed(x, Self::Cage { place, rate });
        CageState {
            position: std::array::from_fn(|k| seed(state.position[k], k, false)),
            rate: std::array::from_fn(|k| seed(state.rate[k], k, true)),
        }
    }

    /// The mode, if it is one.
    fn mode(self) -> Option<OfMode> {
        match self {
            Self::Cage { place, rate } => Some(OfMode { place: place.checked_sub(OF_CAGE)?, rate }),
            _ => None,
        }
    }
}

/// Changes of force and moment on both bodies, and of the forces over the modes.
struct Changes {
    on: [[f64; 6]; 2],
    on_modes: [f64; MOST_MODES],
}

impl Space {
    /// Adds how the accelerations of the cage follow its own motion, and finds how they follow forces.
    pub(super) fn add_own_slopes(
        &self,
        cage: &CageOfScene,
        ws: &mut Workspace,
        by_forces: &mut DMatrix<f64>,
        out: &mut Linearization<OF_BALL>,
    ) {
        let mut room = std::mem::take(&mut ws.cage.along);
        let (first, width) = (self.layout.range(CAGE).start, cage.body.coordinates().len());
        let none = Along::Time;
        for column in 0..width {
            let coordinate = Along::Cage { place: column, rate: false };
            let rate = Along::Cage { place: column, rate: true };
            for (along, forced) in [(none, true), (coordinate, false), (rate, false)] {
                let changes = |w: usize| f64::from(u8::from(forced && w == column));
                let force = |x: f64, w: usize| Dual { re: x, eps: [changes(w)] };
                let wrench = [0, 1].map(|i| [0, 1, 2].map(|k| force(ws.cage.on_cage[i][k], 3 * i + k)));
                room.hold(ws.cage.bending());
                if let Some(mode) = along.mode() {
                    room.of_modes[usize::from(mode.rate)][mode.place].eps[0] = 1.0;
                }
                for (k, (to, on)) in room.on_modes.iter_mut().zip(&ws.cage.on_modes[0]).enumerate() {
                    *to = force(*on, OF_CAGE + k);
                }
                let bending = room.of_modes.each_ref().map(Vec::as_slice);
                let (state, on) = (along.cage(&ws.cage.state), (wrench, room.on_modes.as_slice()));
                let own = cage.body.bent_accelerations(&state, on, bending, self.gravity, &mut room.out);
                for (row, a) in own.iter().chain(&room.out).enumerate() {
                    if forced {
                        by_forces[(row, column)] = a.eps[0];
                    } else {
                        let part =
                            if along == rate { &mut out.over_velocities } else { &mut out.over_positions };
                        part.hub[(first + row, first + column)] += a.eps[0];
                    }
                }
            }
        }
        ws.cage.along = room;
    }

    /// Adds the derivatives of land `k`.
    pub(super) fn add_bent_land_slopes(
        &self,
        k: usize,
        ws: &mut Workspace,
        (rates, ln_rate): (&InputValues, f64),
        (ring, by_forces): (&RingSlopes, &DMatrix<f64>),
        out: &mut Linearization<OF_BALL>,
    ) {
        let Some(cage) = &self.cage else { return };
        let land = &cage.lands[k];
        let mut bent = std::mem::take(&mut ws.cage.bent);
        let warming = self.warming_of(land, ws, ln_rate, &mut bent[k]);
        let (body, of_ring) = (&ws.cage.moving, &ws.rings[land.ring]);
        let found = land.bend(body, of_ring, ws.cage.bending(), (ws.fluid, Wanted::Slopes), &mut bent[k]);
        if found.is_ok() {
            let free: Vec<usize> = self.ring.free().collect();
            let (first, start) = (self.layout.range(CAGE).start, self.layout.range(INNER_RING).start);
            let add = |changes: &Changes, tell: &mut dyn FnMut(usize, f64)| {
                for (i, by) in by_forces.row_iter().enumerate() {
                    let forces = changes.on[0].iter().chain(&changes.on_modes);
                    tell(first + i, by.iter().zip(forces).map(|(by, force)| by * force).sum());
                }
                for (i, k) in free.iter().enumerate().filter(|_| land.ring == 1) {
                    let by_wrench = ring[*k].eps.iter().zip(changes.on[1]);
                    tell(start + i, by_wrench.map(|(by, force)| by * force).sum());
                }
            };
            for rate in [false, true] {
                let of_cage = (0..cage.body.coordinates().len())
                    .map(|place| (first + place, Along::Cage { place, rate }));
                let of_ring =
                    free.iter().enumerate().map(|(i, k)| (start + i, Along::Ring { place: *k, rate }));
                for (column, along) in of_cage.chain(of_ring.filter(|_| land.ring == 1)) {
                    let changes = self.changes_along(along, land, ws, rates, &bent[k]);
                    let part = if rate { &mut out.over_velocities } else { &mut out.over_positions };
                    add(&changes, &mut |row, slope| part.hub[(row, column)] += slope);
                }
            }
            let in_time = self.changes_along(Along::Time, land, ws, rates, &bent[k]);
            for changes in std::iter::once(&in_time).chain(&warming) {
                add(changes, &mut |row, slope| out.over_time[row] += slope);
            }
        }
        ws.cage.bent = bent;
    }

    /// What a lubricant changes that warms while the logarithm of its viscosity changes at this rate.
    fn warming_of(
        &self,
        land: &Land,
        ws: &Workspace,
        ln_rate: f64,
        memory: &mut BentLandForces,
    ) -> Option<Changes> {
        if ln_rate == 0.0 || land.laws()[0].is_none() {
            return None;
        }
        let mut at = |step: f64| {
            let fluid = ws.fluid.moved(step, self.ln_structure_ratio(ws));
            let (body, ring) = (&ws.cage.moving, &ws.rings[land.ring]);
            let force = land.bend(body, ring, ws.cage.bending(), (fluid, Wanted::Forces), memory).ok()?;
            let mut on_modes = [0.0; MOST_MODES];
            on_modes.iter_mut().zip(&memory.on_modes[0]).for_each(|(to, force)| *to = *force);
            Some(Changes { on: force.on.map(numbers), on_modes })
        };
        let (high, low) = (at(WARMING)?, at(-WARMING)?);
        let slope = |high: f64, low: f64| ln_rate * (high - low) / (2.0 * WARMING);
        Some(Changes {
            on: [0, 1].map(|b| std::array::from_fn(|w| slope(high.on[b][w], low.on[b][w]))),
            on_modes: std::array::from_fn(|k| slope(high.on_modes[k], low.on_modes[k])),
        })
    }

    /// What a land changes along one direction.
    fn changes_along(
        &self,
        along: Along,
        land: &Land,
        ws: &Workspace,
        rates: &InputValues,
        memory: &BentLandForces,
    ) -> Changes {
        let in_time = |x: One, rate: f64| if along == Along::Time { timed(x, rate) } else { x };
        let ring: MovingRing<One> = if land.ring == 0 {
            turning_outer(in_time(One::lift(ws.rings[0].speed), rates.of(Input::OuterRingSpeed)))
        } else {
            let [at, rate, second] = self.ring.given(rates);
            let seed = |x: f64, place: usize, rate: bool| along.seed(x, Along::Ring { place, rate });
            let state = RingState {
                position: std::array::from_fn(|k| in_time(seed(ws.ring.position[k], k, false), at[k])),
                rate: std::array::from_fn(|k| in_time(seed(ws.ring.rate[k], k, true), rate[k])),
                given: second.map(One::lift),
                speed: in_time(One::lift(ws.ring.speed), rates.of(Input::RingSpeed)),
            };
            state.motion()
        };
        let mut on_modes = [One::lift(0.0); MOST_MODES];
        let cage = along.cage(&ws.cage.state).motion();
        let count = memory.on_modes[0].len();
        let force = land.bend_slopes(&cage, &ring, along.mode(), memory, &mut on_modes[..count]);
        Changes { on: force.on.map(|on| numbers(on).map(|x| x.eps[0])), on_modes: on_modes.map(|x| x.eps[0]) }
    }
}
