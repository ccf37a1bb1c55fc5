//! Which parts of a tilted line contact are loaded, found anew in every evaluation, and the slices on them.
//!
//! ```text
//! delta(s) = c_0 + c_1 s + c_2 s^2 - p(s) - p_r(t_0 + t_1 s),   |s| <= a
//! ```
//!
//! delta is cut at its extremes, where a logarithm begins and at the places of a table; between these it is monotone and has one root at most. Loaded pieces that
//! meet are one part. One part has n nodes of Gauss and Legendre, of two each has n/2: a skewed roller may lie on both ends. With nodes on the whole
//! length instead the stiffness against tilting would fall by a tenth whenever one of them leaves the contact. Within 1e-4 of force and moment
//! with 4 nodes, 1e-5 with 8; 1e-2 and 2e-3 beside a logarithm with steep ends, whose roots cost some steps (tested).

use super::profile::{MOST_SLICES, legendre};
use super::surface::{MOST_PLACES, Surface};
use super::tilted::{Along, Slice};
use std::sync::LazyLock;

/// Steps to a root; a few are usual.
const MOST_STEPS: usize = 40;
/// Accuracy of a root over the half length.
const ACCURACY: f64 = 1e-13;
/// Most places at which delta may turn, with both ends.
const CUTS: usize = 2 * (MOST_PLACES + 3);

/// A node of a rule on a part of the length: its place from the middle over half of that, and its weight.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Node {
    place: f64,
    weight: f64,
}

/// Gauss and Legendre's rules with one node to [`MOST_SLICES`].
static RULES: LazyLock<Vec<Vec<Node>>> = LazyLock::new(|| (1..=MOST_SLICES).map(rule).collect());

/// That of `n` nodes on -1 to 1, whose weights make 1.
fn rule(n: usize) -> Vec<Node> {
    let node = |i: usize| {
        let [x, inverse] = legendre(n, i);
        Node { place: -x, weight: 1.0 / inverse }
    };
    (0..n).map(node).collect()
}

/// The loaded parts of a contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Loaded {
    parts: [[f64; 2]; 2],
    count: usize,
}

impl Loaded {
    /// The whole length 2a, m.
    pub fn whole(half_length: f64) -> Self {
        Self { parts: [[-half_length, half_length], [0.0; 2]], count: 1 }
    }

    /// From where to where, m.
    pub fn parts(&self) -> &[[f64; 2]] {
        &self.parts[..self.count]
    }

    /// Length of all, m.
    pub fn length(&self) -> f64 {
        self.parts().iter().map(|[from, to]| to - from).sum()
    }

    /// Joins a part to those before it, which it may touch; of more than two the last are one.
    fn add(&mut self, [from, to]: [f64; 2]) {
        match self.count {
            n if n > 0 && (self.parts[n - 1][1] == from || n == 2) => self.parts[n - 1][1] = to,
            n => {
                self.parts[n] = [from, to];
                self.count += 1;
            }
        }
    }

    /// Adds `n` slices of a contact of this half length (m).
    pub fn slices(&self, half_length: f64, n: usize, out: &mut Vec<Slice>) {
        let n = if self.count == 2 { n.div_ceil(2) } else { n };
        let nodes = &RULES[n.clamp(1, MOST_SLICES) - 1];
        for [from, to] in self.parts() {
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            let share = half / half_length;
            out.extend(
                nodes
                    .iter()
                    .map(|node| Slice { place: middle + half * node.place, share: share * node.weight }),
            );
        }
    }
}

impl Along<'_> {
    /// The parts along which the contact is loaded.
    pub fn loaded(&self) -> Loaded {
        let a = self.half_length;
        let ([c0, c1, c2], none) = (self.approach, self.profile.is_none());
        if none && c0 - (c1.abs() + (-c2 * a).max(0.0)) * a > 0.0 && (c2 <= 0.0 || 2.0 * c2 * a < c1.abs()) {
            return Loaded::whole(a);
        }
        let mut cuts = [0.0; CUTS];
        let count = self.cuts(&mut cuts);
        let mut found = Loaded::default();
        for piece in cuts[..count].windows(2) {
            let ([from, to], depths) = ([piece[0], piece[1]], [self.depth(piece[0]), self.depth(piece[1])]);
            match depths.map(|depth| depth > 0.0) {
                [true, true] => found.add([from, to]),
                [true, false] => found.add([from, self.root([from, to], depths)]),
                [false, true] => found.add([self.root([from, to], depths), to]),
                [false, false] => {}
            }
        }
        found
    }

    /// Both ends, where a logarithm begins, and where delta turns, in order; how many these are.
    fn cuts(&self, out: &mut [f64; CUTS]) -> usize {
        let a = self.half_length;
        let start = self.profile.map_or(0.0, Surface::start);
        let mut ends = [a; MOST_PLACES + 2];
        let mut pieces = 1;
        ends[0] = -a;
        if let Some(table) = self.profile.and_then(|surface| surface.tables[0].as_ref()) {
            for place in table.places().iter().filter(|place| place.abs() < a) {
                ends[pieces] = *place;
                pieces += 1;
            }
            ends[pieces] = a;
        } else if start > 0.0 && start < a {
            (ends[1], ends[2], pieces) = (-start, start, 3);
        }
        let mut count = 0;
        let mut push = |s: f64| {
            out[count] = s;
            count += 1;
        };
        for piece in 0..pieces {
            let [from, to] = [ends[piece], ends[piece + 1]];
            push(from);
            // From within, where a logarithm has its slope on that side.
            let inside = 1e-9 * (to - from);
            let slopes = [self.slope(from + inside), self.slope(to - inside)];
            if (slopes[0] > 0.0) != (slopes[1] > 0.0) {
                push(self.turning([from, to], slopes[0]));
            }
        }
        push(a);
        count
    }

    /// d(delta)/ds at `s`.
    fn slope(&self, s: f64) -> f64 {
        let ([_, c1, c2], [t0, t1]) = (self.approach, self.in_raceway);
        let parabola = c1 + 2.0 * c2 * s;
        match self.profile {
            Some(profile) => parabola - profile.slope_of_roller(s) - t1 * profile.of_raceway(t0 + t1 * s)[1],
            None => parabola,
        }
    }

    /// Where the slope, `first` at the start of a piece, is zero in it, m.
    fn turning(&self, [mut low, mut high]: [f64; 2], first: f64) -> f64 {
        let [_, c1, c2] = self.approach;
        if self.profile.is_none() {
            return (-0.5 * c1 / c2).clamp(low, high);
        }
        for _ in 0..MOST_STEPS {
            let middle = 0.5 * (low + high);
            if (self.slope(middle) > 0.0) == (first > 0.0) {
                low = middle;
            } else {
                high = middle;
            }
            if high - low < 1e-6 * self.half_length {
                break;
            }
        }
        0.5 * (low + high)
    }

    /// The root of delta in a piece at whose ends it has these signs, m: Newton's steps, halved where they leave the piece.
    fn root(&self, [mut low, mut high]: [f64; 2], depths: [f64; 2]) -> f64 {
        let mut s = low + (high - low) * (depths[0] / (depths[0] - depths[1])).clamp(0.0, 1.0);
        for _ in 0..MOST_STEPS {
            let depth = self.depth(s);
            if (depth > 0.0) == (depths[0] > 0.0) {
                low = s;
            } else {
                high = s;
            }
            let next = s - depth / self.slope(s);
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            if (next - s).abs() <= ACCURACY * self.half_length {
                return next;
            }
            s = next;
        }
        s
    }
}

#[cfg(test)]
mod tests {
    use super::super::profile::{Logarithm, Profile};
    use super::*;

    const LENGTH: f64 = 0.0204;

    /// Integral of (delta/1 um)^(10/9) ds/l over the loaded part, and of the same times s/a.
    fn sums(along: &Along<'_>, slices: &[Slice]) -> [f64; 2] {
        let of = |slice: &Slice| slice.share * (1e6 * along.depth(slice.place)).max(0.0).powf(10.0 / 9.0);
        [
            slices.iter().map(of).sum(),
            slices.iter().map(|slice| of(slice) * slice.place / along.half_length).sum(),
        ]
    }

    fn largest_error(profile: Option<&Surface>, n: usize) -> f64 {
        let mut worst: f64 = 0.0;
        for depth in [-1e-6, 2e-6, 6e-6, 12e-6] {
            for tilt in [0.0, 1e-4, -5e-4, 2e-3] {
                for bend in [0.0, 0.03, -0.02] {
                    let approach = [depth, tilt, bend];
                    let along =
                        Along { profile, half_length: 0.5 * LENGTH, approach, in_raceway: [4e-5, 1.0] };
                    let (mut fine, mut slices) = (Vec::new(), Vec::new());
                    along.slices(&mut fine);
                    along.loaded().slices(along.half_length, n, &mut slices);
                    let ([load, moment], [of_load, of_moment]) = (sums(&along, &slices), sums(&along, &fine));
                    if of_load > 0.0 {
                        worst = worst.max((load - of_load).abs().max((moment - of_moment).abs()) / of_load);
                    } else {
                        assert_eq!(load, 0.0);
                    }
                }
            }
        }
        worst
    }

    #[test]
    fn a_few_nodes_on_the_loaded_part_are_enough() {
        let crown = Surface::new(Profile::new(LENGTH, None, [Some(3.0), Some(20.0)], 32).unwrap());
        let log = Logarithm::new(1.5e-6, LENGTH, 0.6, Some(12e-6));
        let log = Surface::new(Profile::new(LENGTH, Some(log), [None, None], 32).unwrap());
        for (name, profile, allowed) in [
            ("straight", None, [5e-3, 2e-4]),
            ("crowned", Some(&crown), [5e-3, 2e-4]),
            ("logarithm", Some(&log), [3e-2, 6e-3]),
        ] {
            for (n, allowed) in [4, 8].into_iter().zip(allowed) {
                let error = largest_error(profile, n);
                assert!(error < allowed, "{name} {n}: {error:e}");
            }
        }
    }

    #[test]
    fn weights_of_a_rule_make_the_whole() {
        for rule in RULES.iter() {
            assert!((rule.iter().map(|node| node.weight).sum::<f64>() - 1.0).abs() < 1e-14);
        }
        let along = Along {
            profile: None,
            half_length: 0.5 * LENGTH,
            approach: [1e-6, 0.0, 0.0],
            in_raceway: [0.0, 1.0],
        };
        assert_eq!(along.loaded(), Loaded::whole(0.5 * LENGTH));
        let apart = Along { approach: [-1e-9, 0.0, 0.0], ..along };
        assert_eq!(apart.loaded().parts(), &[] as &[[f64; 2]]);
    }

    #[test]
    fn a_skewed_roller_lies_on_both_ends() {
        let along = Along {
            profile: None,
            half_length: 0.5 * LENGTH,
            approach: [-1e-6, 0.0, 0.03],
            in_raceway: [0.0, 1.0],
        };
        let loaded = along.loaded();
        let [[a, b], [c, d]] = [loaded.parts[0], loaded.parts[1]];
        assert_eq!((loaded.count, a, d), (2, -0.5 * LENGTH, 0.5 * LENGTH));
        let edge = (1e-6_f64 / 0.03).sqrt();
        assert!((b + edge).abs() < 1e-10 && (c - edge).abs() < 1e-10, "{loaded:?}");
    }
}
