//! Numbers that vary with the coordinates of a roller and its mate, a few directions at once, and the loaded parts of a contact, whose ends move.

use super::super::workspace::Workspace;
use super::RollersOfScene;
use super::contacts::{Contact, Node};
use crate::bodies::{CageState, MovingRing, OF_ROLLER};
use crate::laws::elastic::tilted::Along;
use crate::scalar::{Dual, Numeric};
use crate::scene::SlicesOn;
use crate::space::solid::{Moving, Vector};

/// Positions of a roller, its speeds, coordinates of the mate (x, y, z, angle and tilts), their rates, displacement of a pocket by bending with its
/// rates, time.
pub(super) const POSITIONS: usize = OF_ROLLER - 1;
pub(super) const OF_MATE: usize = 6;
pub(super) const SPEEDS: usize = POSITIONS;
pub(super) const MATE: usize = SPEEDS + OF_ROLLER;
pub(super) const MATE_RATES: usize = MATE + OF_MATE;
pub(super) const BENT: usize = MATE_RATES + OF_MATE;
pub(super) const TIME: usize = BENT + 4;
pub(super) const ALL: usize = TIME + 1;

/// Directions of one pass; all at once would make the code four times as large.
pub(in super::super) const AT_ONCE: usize = 7;
pub(super) const PASSES: usize = ALL / AT_ONCE;
const _: () = assert!(ALL.is_multiple_of(AT_ONCE));
pub(in super::super) type Varied = Dual<AT_ONCE>;

/// The directions of a pass.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Pass {
    pub(in super::super) first: usize,
}

impl Pass {
    /// Place of a direction in this pass, if it is one of it.
    fn place(self, direction: usize) -> Option<usize> {
        direction.checked_sub(self.first).filter(|place| *place < AT_ONCE)
    }

    /// Lets a number change at this rate along a direction.
    pub(in super::super) fn along(self, mut x: Varied, direction: usize, rate: f64) -> Varied {
        if let Some(place) = self.place(direction) {
            x.eps[place] += rate;
        }
        x
    }

    /// A coordinate.
    pub(in super::super) fn variable(self, x: f64, direction: usize) -> Varied {
        self.along(Varied::lift(x), direction, 1.0)
    }

    pub(super) fn timed(self, x: Varied, rate: f64) -> Varied {
        self.along(x, TIME, rate)
    }
}

pub(super) fn local([x, y, z]: Vector<Varied>, [cos, sin]: [Varied; 2]) -> Vector<Varied> {
    [x, cos * y + sin * z, cos * z - sin * y]
}

pub(super) fn global([x, r, t]: Vector<Varied>, [cos, sin]: [Varied; 2]) -> Vector<Varied> {
    [x, cos * r - sin * t, sin * r + cos * t]
}

/// A ring in the axes of this direction.
pub(super) fn turned_ring(ring: &MovingRing<Varied>, direction: [Varied; 2]) -> MovingRing<Varied> {
    let turned = |v: Vector<Varied>| local(v, direction);
    MovingRing {
        centre: turned(ring.centre),
        axis: turned(ring.axis),
        moving: Moving { velocity: turned(ring.moving.velocity), turning: turned(ring.moving.turning) },
        speed: ring.speed,
    }
}

/// The cage over its coordinates.
pub(super) fn varied_cage(pass: Pass, ws: &Workspace) -> CageState<Varied> {
    let CageState { position, rate } = &ws.cage.state;
    CageState {
        position: std::array::from_fn(|k| pass.variable(position[k], MATE + k)),
        rate: std::array::from_fn(|k| pass.variable(rate[k], MATE_RATES + k)),
    }
}

/// Ends of the loaded parts of a contact, which move.
pub(super) struct Edges {
    /// Value and motion of each end.
    parts: [[Varied; 2]; 2],
    count: usize,
    half_length: f64,
}

impl Edges {
    /// Of the contact of a roller whose straight discs at both ends and in the middle have this approach and place in the raceway.
    pub(super) fn new(
        rollers: &RollersOfScene,
        side: usize,
        contact: &Contact,
        discs: [(Varied, Varied); 3],
    ) -> Self {
        let a = rollers.shapes.half_length(contact.roller);
        let [low, middle, high] = discs;
        let of = |f: &dyn Fn([f64; 3]) -> f64, d: usize, at: [Varied; 3]| f(at.map(|x| x.eps[d]));
        let approach = [low.0, middle.0, high.0];
        let values = Along::parabola(a, approach.map(|x| x.re));
        // The parabola is linear in the three approaches.
        let coefficient = |k: usize| {
            let mut out = Varied::lift(values[k]);
            for d in 0..AT_ONCE {
                out.eps[d] = of(&|x| Along::parabola(a, x)[k], d, approach);
            }
            out
        };
        let [c0, c1, c2] = [coefficient(0), coefficient(1), coefficient(2)];
        let (t0, t1) = (middle.1, (high.1 - low.1) * (0.5 / a));
        let profile = rollers.shapes.surface(side, contact.roller);
        let moved = |s: f64| {
            if s.abs() >= a || rollers.slices_on == SlicesOn::Whole {
                return Varied::lift(s);
            }
            let at = Varied::lift(s);
            let mut depth = c0 + (c1 + c2 * at) * at;
            let mut slope = c1.re + 2.0 * c2.re * s;
            if let Some(profile) = profile {
                let [drop, steep] = profile.of_raceway(t0 + t1 * at);
                depth = depth - drop - profile.of_roller(at);
                slope -= profile.slope_of_roller(s) + steep.re * t1.re;
            }
            let mut out = at;
            for (out, depth) in out.eps.iter_mut().zip(depth.eps) {
                *out = -depth / slope;
            }
            out
        };
        let parts = contact.parts_loaded();
        let mut ends = [[Varied::lift(0.0); 2]; 2];
        for (ends, part) in ends.iter_mut().zip(parts) {
            *ends = part.map(moved);
        }
        Self { parts: ends, count: parts.len(), half_length: rollers.half_length }
    }

    /// Place and share of a slice.
    pub(super) fn slice(&self, node: &Node) -> [Varied; 2] {
        let s = node.slice.place;
        let inside = |[from, to]: &&[Varied; 2]| from.re <= s && s <= to.re;
        let Some([from, to]) = self.parts[..self.count].iter().find(inside) else {
            return [Varied::lift(s), Varied::lift(node.slice.share)];
        };
        let length = *to - *from;
        let place = (s - from.re) / length.re;
        let weight = node.slice.share / (0.5 * length.re / self.half_length);
        [*from + length * place, length * (0.5 * weight / self.half_length)]
    }
}
