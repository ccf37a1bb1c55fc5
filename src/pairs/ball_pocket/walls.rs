//! Walls of a pocket around a ball, in its own axes: along the axis of the cage, outwards, ahead.
//!
//! ```text
//! planes     delta = |q_3| - c_t and |q_1| - c_a                  each touches by itself
//! cylinder   delta = |(q_1', q_3')| - c                           around the outward axis
//! sphere     delta = |(q_1', q_2, q_3')| - c
//! c = min(c_t, c_a),   q_1' = q_1 less its part within -+(c_a - c),   q_3' = q_3 less its part within -+(c_t - c)
//! ```
//!
//! q centre of the ball from that of the pocket, c_t and c_a clearance of a centred ball along the orbit and along the axis. Where both differ a
//! round pocket is a slot: half a pocket at each end and straight walls between. delta is depth; the normal points from the ball to the wall.
//! Source: geometry.

use crate::scalar::Real;
use crate::space::solid::{Vector, dot, scaled};

/// Most walls that a ball touches at once.
pub(crate) const WALLS: usize = 2;

/// Shape of the pockets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Walls {
    /// Plane walls ahead and behind, and on request along the axis: c_t and c_a, m.
    Planes { along: f64, across: Option<f64> },
    /// Round walls.
    Round {
        /// c, m.
        clearance: f64,
        /// How far a slot reaches along the axis and along the orbit, m.
        slot: [f64; 2],
        /// Whether it is round all about.
        sphere: bool,
    },
}

/// A wall beside a ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wall<T> {
    /// delta, m; negative where they are apart.
    pub(crate) depth: T,
    /// In the axes of the pocket.
    pub(crate) normal: Vector<T>,
}

impl Walls {
    /// Round walls with these clearances on each side of a centred ball along the orbit and along the axis, m.
    pub(crate) fn round([along, across]: [f64; 2], sphere: bool) -> Self {
        let clearance = along.min(across);
        Self::Round { clearance, slot: [across - clearance, along - clearance], sphere }
    }

    /// Wall `k` beside a ball at `q` (m) whose radius is larger than nominal by `excess` (m); none where there is none, or a round wall has no
    /// nearest place.
    pub(crate) fn wall<T: Real>(&self, k: usize, q: Vector<T>, excess: f64) -> Option<Wall<T>> {
        let zero = T::constant(0.0);
        match *self {
            Self::Planes { along, across } => {
                let (place, clearance) = if k == 0 { (2, along) } else { (0, across?) };
                let mut normal = [zero; 3];
                normal[place] = T::constant(q[place].sign());
                Some(Wall { depth: q[place].abs() + (excess - clearance), normal })
            }
            Self::Round { clearance, slot: [axial, around], sphere } => {
                if k > 0 {
                    return None;
                }
                let beyond = |x: T, reach: f64| {
                    if x.value().abs() <= reach && reach > 0.0 { zero } else { x - reach * x.sign() }
                };
                let off = [beyond(q[0], axial), if sphere { q[1] } else { zero }, beyond(q[2], around)];
                let square = dot(off, off);
                if square.value() == 0.0 {
                    return None;
                }
                let distance = square.sqrt();
                let normal = scaled(off, T::constant(1.0) / distance);
                Some(Wall { depth: distance + (excess - clearance), normal })
            }
        }
    }

    /// Clearance of a centred ball along the orbit and, where walls hold it there, along the axis, m.
    pub(crate) fn clearances(&self) -> [Option<f64>; 2] {
        match *self {
            Self::Planes { along, across } => [Some(along), across],
            Self::Round { clearance, slot: [axial, around], .. } => {
                [Some(clearance + around), Some(clearance + axial)]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Dual;

    const C: f64 = 2.775e-4;

    #[test]
    fn round_walls_are_as_far_as_they_are() {
        let cylinder = Walls::round([C, C], false);
        let touch = cylinder.wall(0, [3e-4, 5e-3, -4e-4], 1e-6).unwrap();
        assert!((touch.depth - (5e-4 - C + 1e-6)).abs() < 1e-18);
        assert!((touch.normal[0] - 0.6).abs() < 1e-15 && touch.normal[1] == 0.0);
        let sphere = Walls::round([C, C], true);
        let touch = sphere.wall(0, [2e-4, -1e-4, 2e-4], 0.0).unwrap();
        assert!((touch.depth - (3e-4 - C)).abs() < 1e-18 && touch.normal[1] < 0.0);
        assert_eq!(cylinder.wall(0, [0.0, 1.0, 0.0], 0.0), None);
        assert_eq!(cylinder.wall(1, [3e-4, 0.0, 0.0], 0.0), None);
    }

    #[test]
    fn slots_have_straight_walls_between_round_ends() {
        // Twice the room along the axis.
        let slot = Walls::round([C, 2.0 * C], false);
        assert_eq!(slot.clearances(), [Some(C), Some(2.0 * C)]);
        let straight = slot.wall(0, [0.9 * C, 0.0, 1.1 * C], 0.0).unwrap();
        assert!((straight.depth - 0.1 * C).abs() < 1e-18 && straight.normal[..2] == [0.0; 2]);
        assert!((straight.normal[2] - 1.0).abs() < 1e-15);
        let end = slot.wall(0, [-2.2 * C, 0.0, 0.0], 0.0).unwrap();
        assert!((end.depth - 0.2 * C).abs() < 1e-18 && end.normal == [-1.0, 0.0, 0.0]);
        // Both meet without a kink.
        let at = |x: f64| slot.wall(0, [Dual::<1>::variable(x, 0), Dual::lift(0.0), Dual::lift(C)], 0.0);
        let [a, b] = [C - 1e-10, C + 1e-10].map(|x| at(x).unwrap().depth.eps[0]);
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }

    #[test]
    fn plane_walls_touch_by_themselves() {
        let square = Walls::Planes { along: C, across: Some(2.0 * C) };
        let q = [-3.0 * C, 1.0, 1.5 * C];
        let [ahead, beside] = [0, 1].map(|k| square.wall(k, q, 0.0).unwrap());
        assert!((ahead.depth - 0.5 * C).abs() < 1e-18 && ahead.normal == [0.0, 0.0, 1.0]);
        assert!((beside.depth - C).abs() < 1e-18 && beside.normal == [-1.0, 0.0, 0.0]);
        assert_eq!(Walls::Planes { along: C, across: None }.wall(1, q, 0.0), None);
    }

    use crate::scalar::Numeric;
}
