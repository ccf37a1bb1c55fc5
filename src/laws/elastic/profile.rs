//! Profile of a roller and of its raceway: how far the surfaces fall back from a straight contact along its length, and the
//! slices that the contact is cut into for it.
//!
//! ```text
//! delta(s) = delta - p(s),   s from the middle along the axis, |s| <= a = l/2
//! p = A ln 1/(1 - (1 - exp(-z_m/A)) x^2),   x = (|s| - (1 - K2) a)_+ / (K2 a)      logarithmic
//! p = s^2/(R_c + sqrt(R_c^2 - s^2))                                               circular crown
//! Q = (2/l) Int (delta(s)/K)^(10/9) ds      over the loaded part of one half, K that of the full length
//! ```
//!
//! Every slice is thus a share of what the whole contact would do at the approach of the slice, and nothing else has to
//! know of lengths. Slices do not tilt and do not feel each other. They stand on the loaded part only: nodes of a
//! Gauss-Legendre rule in u, s = edge (1 - (1 - u)^2), which stand close where the load vanishes. Eight of them are within 2e-5
//! of the force, four within 5e-4 (tested). A logarithm begins at (1 - K2) a, where the rule is split.
//!
//! Sources: H. Fujiwara, T. Kawase, NTN Technical Review 75 (2007); K2 = 1 is the profile of Johns and Gohar, with z_m
//! without limit that of Lundberg. The spring constant of the full length in every slice: ISO/TS 16281.

use crate::scalar::{Base, Numeric, Of, math};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Largest number of slices of a part of the length.
pub const MOST_SLICES: usize = 32;
/// Number of slices unless another is asked for.
pub const USUAL_SLICES: usize = 8;

/// Approach below which a contact is as long as at it, m.
const LEAST_APPROACH: f64 = 1e-40;
/// Least argument of the logarithm: at the very end of a profile without limit.
const LEAST_ARGUMENT: f64 = 1e-15;
/// Most steps to the edge of the loaded part where several profiles act; a few are usual.
const MOST_STEPS: usize = 60;

/// A slice of a part of the length: where, as a share of the part, and how much of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Node {
    pub(super) place: f64,
    pub(super) weight: f64,
}

/// The rule with this many slices, at most [`MOST_SLICES`].
pub(super) fn nodes(slices: usize) -> &'static [Node] {
    RULES[slices.clamp(1, MOST_SLICES) - 1].as_slice()
}

/// The rules with one slice to [`MOST_SLICES`].
static RULES: LazyLock<Vec<Vec<Node>>> = LazyLock::new(|| (1..=MOST_SLICES).map(rule).collect());

/// A part along which nothing changes.
static LEVEL: [Node; 1] = [Node { place: 0.5, weight: 1.0 }];

/// Node `i` of Gauss and Legendre's rule of `n` points on -1 to 1, from above, and 2 over its weight.
pub(super) fn legendre(n: usize, i: usize) -> [f64; 2] {
    let mut x = math::cos(PI * (i as f64 + 0.75) / (n as f64 + 0.5));
    let mut slope = 1.0;
    for _ in 0..20 {
        let (mut before, mut here) = (1.0, x);
        for k in 2..=n {
            let k = k as f64;
            (before, here) = (here, ((2.0 * k - 1.0) * x * here - (k - 1.0) * before) / k);
        }
        slope = n as f64 * (x * here - before) / (x * x - 1.0);
        x -= here / slope;
    }
    [x, (1.0 - x * x) * slope * slope]
}

/// Nodes of that rule in u from 0 to 1, at 1 - (1 - u)^2.
fn rule(n: usize) -> Vec<Node> {
    let node = |i: usize| {
        let [x, inverse] = legendre(n, i);
        // 1 - u of the node.
        let rest = 0.5 * (1.0 + x);
        Node { place: 1.0 - rest * rest, weight: 2.0 * rest / inverse }
    };
    (0..n).map(node).collect()
}

/// Logarithmic profile of a roller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Logarithm {
    /// A, m.
    scale: f64,
    /// (1 - K2) a: where it begins, m from the middle.
    start: f64,
    /// K2 a, m.
    length: f64,
    /// 1 - exp(-z_m/A).
    share: f64,
}

impl Logarithm {
    /// From A (m), the contact length l (m), K2 and the drop z_m (m) at the end, all > 0; without it the drop has no limit.
    pub fn new(scale: f64, length: f64, crowned_share: f64, end_drop: Option<f64>) -> Self {
        let (half, share) = (0.5 * length, end_drop.map_or(1.0, |drop| approach_to_one(drop / scale)));
        Self { scale, start: (1.0 - crowned_share) * half, length: crowned_share * half, share }
    }

    /// A = 2 K1 Q/(pi l E') in m of a design load Q (N), its factor K1, l (m) and E' (Pa).
    pub fn scale_of(load: f64, load_factor: f64, length: f64, effective_modulus: f64) -> f64 {
        2.0 * load_factor * load / (PI * length * effective_modulus)
    }

    /// Share of the part with the profile that lies between its start and `s`.
    #[inline(always)]
    fn along<T: Numeric>(&self, s: T) -> T {
        ((s - self.start) / self.length).floored(0.0)
    }

    /// Drop at `s` in m.
    #[inline(always)]
    fn drop<T: Numeric>(&self, s: T) -> T {
        let x = self.along(s);
        let square = x * x * self.share;
        // -ln(1 - y) = ln(1 + y/(1 - y)) keeps the digits of small drops.
        (square / (-square + 1.0).floored(LEAST_ARGUMENT)).ln_1p() * self.scale
    }

    /// Slope of the drop at `s`.
    #[inline(always)]
    fn slope<T: Numeric>(&self, s: T) -> T {
        let x = self.along(s);
        let argument = (-(x * x * self.share) + 1.0).floored(LEAST_ARGUMENT);
        x * (2.0 * self.scale * self.share / self.length) / argument
    }

    /// Where the drop is `depth` > 0, or the end of the profile, m.
    #[inline(always)]
    fn edge<T: Numeric>(&self, depth: T) -> T {
        let square = approach_to_one(depth / self.scale) / self.share;
        let whole = square.at_least(1.0);
        T::select(whole, square.like(1.0), square).sqrt() * self.length + self.start
    }
}

/// Profile of one kind of contact, and its slices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profile<B = f64> {
    /// a, m.
    half_length: f64,
    logarithm: Option<Logarithm>,
    /// Curvatures of the crowns of roller and raceway, 1/m.
    crowns: Option<[B; 2]>,
    /// Slices of the part before the logarithm, and of the rest.
    before: &'static [Node],
    rest: &'static [Node],
}

/// The loaded part of one half of a contact, m.
#[derive(Clone, Copy, Debug)]
pub struct LoadedPart<T> {
    /// Up to the start of the logarithm.
    before: T,
    /// From there on.
    rest: T,
}

impl Profile {
    /// Of a contact of this length (m): a logarithm, crowns of roller and raceway (radius R_c in m, at least half of the
    /// length), slices of the loaded part of one half, at most [`MOST_SLICES`]. `None` where both surfaces are straight.
    pub fn new(
        length: f64,
        logarithm: Option<Logarithm>,
        crown_radii: [Option<f64>; 2],
        slices: usize,
    ) -> Option<Self> {
        let crowned = crown_radii.iter().any(Option::is_some);
        if logarithm.is_none() && !crowned {
            return None;
        }
        let crowns = crowned.then(|| crown_radii.map(|radius| radius.map_or(0.0, |radius| 1.0 / radius)));
        let rest = nodes(slices);
        let before = match logarithm {
            Some(logarithm) if logarithm.start > 0.0 => {
                if crowned {
                    rest
                } else {
                    &LEVEL
                }
            }
            _ => &[],
        };
        Some(Self { half_length: 0.5 * length, logarithm, crowns, before, rest })
    }
}

impl<B> Profile<B> {
    /// The same with every constant of the raceway replaced; those of the roller are the same in all contacts.
    #[inline(always)]
    pub fn map<U>(&self, f: &mut impl FnMut(&B) -> U) -> Profile<U> {
        let Self { half_length, logarithm, before, rest, .. } = *self;
        let mut crowns = None;
        if let Some([roller, raceway]) = &self.crowns {
            crowns = Some([f(roller), f(raceway)]);
        }
        Profile { half_length, logarithm, crowns, before, rest }
    }

    /// Where the logarithm begins, m from the middle; zero without one.
    pub(super) fn start(&self) -> f64 {
        match &self.logarithm {
            Some(logarithm) => logarithm.start,
            None => 0.0,
        }
    }

    /// Its slices of one part of the length.
    pub(super) fn nodes(&self) -> &'static [Node] {
        self.rest
    }

    /// Number of slices.
    #[inline(always)]
    pub fn count(&self) -> usize {
        self.before.len() + self.rest.len()
    }
}

impl<B: Base> Profile<B> {
    /// Drop of both surfaces at `s` in m, before the start of the logarithm or anywhere.
    #[inline(always)]
    fn drop<T: Of<B>>(&self, s: T, before: bool) -> T {
        let mut drop = s.like(0.0);
        if let Some([roller, raceway]) = &self.crowns {
            drop = circle(s, *roller) + circle(s, *raceway);
        }
        match &self.logarithm {
            Some(logarithm) if !before => drop + logarithm.drop(s),
            _ => drop,
        }
    }

    /// Drop in m of the roller alone, `s` (m) from its middle.
    #[inline(always)]
    pub fn of_roller<T: Of<B>>(&self, s: T) -> T {
        let mut drop = s.like(0.0);
        if let Some([roller, _]) = &self.crowns {
            drop = circle(s, *roller);
        }
        match &self.logarithm {
            Some(logarithm) => drop + logarithm.drop(s.abs()),
            None => drop,
        }
    }

    /// Slope of the drop of the roller alone, `s` (m) from its middle.
    #[inline(always)]
    pub fn slope_of_roller<T: Of<B>>(&self, s: T) -> T {
        let mut slope = s.like(0.0);
        if let Some([roller, _]) = &self.crowns {
            slope = circle_slope(s, *roller);
        }
        match &self.logarithm {
            Some(logarithm) => {
                let of_logarithm = logarithm.slope(s.abs());
                slope + T::select(s.below(0.0), -of_logarithm, of_logarithm)
            }
            None => slope,
        }
    }

    /// Drop in m of the raceway alone, `t` (m) from its middle, and its slope.
    #[inline(always)]
    pub fn of_raceway<T: Of<B>>(&self, t: T) -> [T; 2] {
        match &self.crowns {
            Some([_, raceway]) => [circle(t, *raceway), circle_slope(t, *raceway)],
            None => [t.like(0.0); 2],
        }
    }

    /// Slope of the drop at `s`.
    #[inline(always)]
    fn slope(&self, s: B) -> B {
        let mut slope = s.splat(0.0);
        if let Some([roller, raceway]) = &self.crowns {
            slope = circle_slope(s, *roller) + circle_slope(s, *raceway);
        }
        match &self.logarithm {
            Some(logarithm) => slope + logarithm.slope(s),
            None => slope,
        }
    }

    /// Where the drop is `depth` > 0, or the end of the contact, m.
    ///
    /// With crowns by Newton steps from beyond: the drop is convex, so they come from one side and stop where they would turn
    /// back. The last one carries the derivative.
    #[inline(always)]
    fn edge<T: Of<B>>(&self, depth: T) -> T {
        let end = depth.base().splat(self.half_length);
        let alone = match &self.logarithm {
            Some(logarithm) => logarithm.edge(depth),
            None => T::lift(end),
        };
        let Some([roller, raceway]) = &self.crowns else { return alone };
        // A parabola falls slower than a circle.
        let parabola = (depth.base() * 2.0 / (*roller + *raceway)).sqrt();
        let mut s = B::select(parabola.less(alone.base()), parabola, alone.base());
        for _ in 0..MOST_STEPS {
            let next = s - (self.drop::<B>(s, false) - depth.base()) / self.slope(s);
            let nearer = next.less(s);
            if !B::any(nearer) {
                break;
            }
            s = B::select(nearer, next, s);
        }
        let step = (depth - self.drop::<B>(s, false)) / self.slope(s);
        let found = T::lift(s) + step;
        T::select(found.at_least(self.half_length), T::lift(end), found)
    }

    /// The loaded part at the approach `delta` (m) of the middle.
    #[inline(always)]
    pub fn loaded<T: Of<B>>(&self, delta: T) -> LoadedPart<T> {
        let edge = self.edge(delta.floored(LEAST_APPROACH));
        let start = self.start();
        let before = T::select(edge.above(start), edge.like(start), edge);
        LoadedPart { before, rest: edge - before }
    }

    /// Approach of slice `k` (m), the first next to the middle, and its share of the length of the contact.
    #[inline(always)]
    pub fn slice<T: Of<B>>(&self, part: &LoadedPart<T>, k: usize, delta: T) -> (T, T) {
        let before = k < self.before.len();
        let (node, from, length) = if before {
            (self.before[k], delta.like(0.0), part.before)
        } else {
            (self.rest[k - self.before.len()], part.before, part.rest)
        };
        let depth = delta - self.drop(from + length * node.place, before);
        (depth, length * (node.weight / self.half_length))
    }
}

/// 1 - exp(-z), accurate near zero.
#[inline(always)]
fn approach_to_one<T: Numeric>(z: T) -> T {
    let t = Numeric::tanh(z * 0.5);
    t * 2.0 / (t + 1.0)
}

/// Drop of a circle of this curvature (1/m) at `s` (m).
#[inline(always)]
fn circle<B: Base, T: Of<B>>(s: T, curvature: B) -> T {
    let along = s * curvature;
    s * along / ((-(along * along) + 1.0).sqrt() + 1.0)
}

/// Its slope.
#[inline(always)]
fn circle_slope<B: Base, T: Of<B>>(s: T, curvature: B) -> T {
    let along = s * curvature;
    along / (-(along * along) + 1.0).sqrt()
}

#[cfg(test)]
pub(crate) mod tests;
