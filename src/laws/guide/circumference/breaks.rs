//! Places where the integrand of a film has a kink, found in lanes.
//!
//! The layer ends where h = h_L, the pressure where G = 0, and the viscosity stops growing where s = s_cap, which is where
//! K = G + c h^3 = 0. The circle is looked at in 15 steps per period of the highest order, at least 30 in all. In a step at
//! whose ends a function has different signs there is one place. Where it has not, but its slope says that it turns back
//! towards zero in between, the place where it turns is found first: that tells whether there are two. So nothing is
//! missed but what a function does by turning twice within one step.

use super::gap::{Gap, Place};
use super::stretch::{Break, DRY, EXCESS, FUNCTIONS, MOST_DRY, OPENING, Stretch};
use crate::scalar::{Base, Columns, Lanes, Numeric, Pack, WIDEST, ZEROS, dispatch};
use pulp::{Arch, Simd};
use std::f64::consts::{PI, TAU};

/// Steps of a block: each shares its ends with its neighbours.
const STEPS: usize = WIDEST - 1;
/// Fewest blocks of the circle.
const FEWEST_BLOCKS: usize = 2;
/// Most blocks of a stretch.
const LONGEST: usize = 4;
/// Largest number of brackets that one step needs.
const MOST_OF_STEP: usize = FUNCTIONS + 1;
/// Largest number of Newton steps; each that fails to be one halves a bracket.
const MOST_STEPS: usize = 60;
/// A drop of the film between two points by this share of it is looked at.
const THIN: f64 = 0.25;
/// A Newton step so small, relative to the angle or in rad, is the last one: the next would be of round-off.
const LAST_STEP: [f64; 2] = [1e-8, 1e-16];

/// 0, 1, 2, ...
const COUNTED: Lanes = {
    let mut all = ZEROS;
    let mut i = 1;
    while i < WIDEST {
        all[i] = all[i - 1] + 1.0;
        i += 1;
    }
    all
};

/// What is looked for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Aim {
    /// The place where the function is zero.
    #[default]
    Zero,
    /// The place where it turns back, having this sign at both ends.
    Turn { negative: bool },
    /// The same, for the smallest film only.
    Lowest,
}

/// A block of brackets, in each of which a place is looked for.
struct Brackets {
    count: usize,
    /// How many of them may lead to two more.
    turns: usize,
    aim: [Aim; WIDEST],
    /// Ends, a first guess and then the place, rad.
    ends: [Lanes; 2],
    angle: Lanes,
    /// Minus one where what is to be zero rises, else one.
    sign: Lanes,
    /// Number of the function, and one where not itself but its slope is to be zero.
    of: Lanes,
    of_slope: Lanes,
}

impl Brackets {
    const fn none() -> Self {
        Self {
            count: 0,
            turns: 0,
            aim: [Aim::Zero; WIDEST],
            ends: [ZEROS; 2],
            angle: ZEROS,
            sign: ZEROS,
            of: ZEROS,
            of_slope: ZEROS,
        }
    }

    fn add(&mut self, [a, b]: [f64; 2], guess: f64, rises: bool, of: usize, aim: Aim) {
        let i = self.count;
        self.count += 1;
        self.turns += usize::from(matches!(aim, Aim::Turn { .. }));
        self.aim[i] = aim;
        (self.ends[0][i], self.ends[1][i], self.angle[i]) = (a, b, guess);
        self.sign[i] = if rises { -1.0 } else { 1.0 };
        (self.of[i], self.of_slope[i]) = (of as f64, if aim == Aim::Zero { 0.0 } else { 1.0 });
    }

    /// Whether all that one more step needs has room, and what it leads to, too.
    fn has_room(&self) -> bool {
        self.count + MOST_OF_STEP <= WIDEST && 2 * (self.turns + FUNCTIONS) <= WIDEST
    }
}

/// Functions and their slopes at the points of a block.
struct Sampled {
    angles: Lanes,
    functions: [[Lanes; 2]; FUNCTIONS],
    film: Lanes,
    /// The smallest film of all blocks so far at the points of each number, m.
    lowest: Lanes,
    /// Signs of functions and slopes as a number with a bit for each.
    signs: Lanes,
}

impl Sampled {
    /// The smallest film of all blocks so far, m. A film that is not a number is so everywhere.
    fn lowest(&self) -> f64 {
        let mut low = self.lowest;
        // Halves, so that neighbours are compared at a time.
        for half in [8, 4, 2, 1] {
            for i in 0..half {
                low[i] = low[i].min(low[i + half]);
            }
        }
        low[0]
    }

    /// A bit for each step of the block at whose ends signs differ.
    fn changes(&self) -> u32 {
        (0..STEPS).fold(0, |bits, k| bits | u32::from(self.signs[k] != self.signs[k + 1]) << k)
    }

    /// Whether a film that seems to drop by this between these points (m) has to be known better. Forces only ask
    /// whether there is one.
    fn may_be_thinnest(&self, k: usize, drop: f64, aims: Aims) -> bool {
        aims == Aims::Minima || drop > THIN * self.film[k].min(self.film[k + 1])
    }

    /// Adds the brackets of step `k`. Where it is dry, nothing acts: what changes its sign there does so at the end of the step.
    fn step(&self, k: usize, aims: Aims, brackets: &mut Brackets, out: &mut Stretch) {
        let [before, after] = [self.signs[k] as u32, self.signs[k + 1] as u32];
        let changed = before ^ after;
        let ends = [self.angles[k], self.angles[k + 1]];
        let length = ends[1] - ends[0];
        let of_dry = brackets.count;
        for (of, [values, slopes]) in self.functions.iter().enumerate() {
            let (value, slope) = (1 << of, 1 << (FUNCTIONS + of));
            if changed & (value | slope) == 0 {
                continue;
            }
            if of != DRY && (before | after) & (1 << DRY) == 0 && brackets.count == of_dry {
                if changed & value != 0 {
                    out.breaks.add(ends[1], of);
                    out.dry += 1;
                }
                continue;
            }
            let ([a, b], [da, db]) = ([values[k], values[k + 1]], [slopes[k], slopes[k + 1]]);
            let (negative, rises) = (before & value != 0, before & slope != 0);
            if changed & value != 0 {
                let guess = ends[0] + zero([a, b], [da * length, db * length]) * length;
                brackets.add(ends, guess, negative, of, Aim::Zero);
            }
            if changed & slope == 0 {
                continue;
            }
            // Where slopes change evenly; the value there, seen from either end.
            let turn = da / (da - db);
            let rise = [0.5 * da * turn * length, -0.5 * db * (1.0 - turn) * length];
            let seen = [a + rise[0], b + rise[1]];
            let sign = if negative { -1.0 } else { 1.0 };
            let nearly_zero = sign * seen[0] < (seen[0] - seen[1]).abs();
            let guess = ends[0] + turn * length;
            if changed & value == 0 && rises != negative && nearly_zero {
                brackets.add(ends, guess, rises, of, Aim::Turn { negative });
            } else if of == DRY && rises && self.may_be_thinnest(k, -rise[0].min(rise[1]), aims) {
                brackets.add(ends, guess, rises, of, Aim::Lowest);
            }
        }
    }
}

/// What is looked for on a circle.
#[derive(Clone, Copy, PartialEq)]
pub(in crate::laws::guide) enum Aims {
    /// The smallest film.
    Minima,
    /// Where h = h_L and where G = 0.
    Edges,
    /// Where K = 0, too, with this c, 1/(m^2 s).
    EdgesAndExcess(f64),
}

/// Place from 0 to 1 where a function with these values and slopes at 0 and 1 is zero, nearly: its inverse is a cubic with
/// the same values and slopes.
fn zero([a, b]: [f64; 2], [da, db]: [f64; 2]) -> f64 {
    let t = a / (a - b);
    let rest = 1.0 - t;
    let width = b - a;
    t * t * (3.0 - 2.0 * t) + t * rest * width * (rest / da - t / db)
}

/// Search over the circle.
pub(in crate::laws::guide) struct Search<'a> {
    pub gap: &'a Gap<'a>,
    /// h_L, m; infinite where everything is wet.
    pub layer: f64,
    pub aims: Aims,
    pub instructions: Arch,
}

impl Search<'_> {
    /// Number of steps of the circle.
    pub fn steps(&self) -> usize {
        STEPS * FEWEST_BLOCKS.max(self.gap.order() as usize)
    }

    /// Goes on to the next stretch of a circle of `steps`.
    pub fn next(&self, steps: usize, out: &mut Stretch) {
        out.go_on();
        let mut brackets = Brackets::none();
        let functions = [[ZEROS; 2]; FUNCTIONS];
        let lowest = [f64::INFINITY; WIDEST];
        let mut sampled = Sampled { angles: ZEROS, functions, film: ZEROS, lowest, signs: ZEROS };
        'blocks: for block in 0..LONGEST {
            let start = out.last_step;
            if start == steps {
                break;
            }
            dispatch(self.instructions, Scan { search: self, start, steps, sampled: &mut sampled });
            if block == 0 {
                let signs = sampled.signs[0] as u32;
                out.negative = std::array::from_fn(|of| signs >> of & 1 == 1);
                out.look_at(sampled.film[0], sampled.angles[0]);
            }
            let count = STEPS.min(steps - start);
            let mut changes = sampled.changes() & ((1 << count) - 1);
            while changes != 0 {
                let k = changes.trailing_zeros() as usize;
                if !brackets.has_room() || out.dry >= MOST_DRY {
                    if k > 0 {
                        (out.last_step, out.to) = (start + k, sampled.angles[k]);
                    }
                    break 'blocks;
                }
                sampled.step(k, self.aims, &mut brackets, out);
                changes &= changes - 1;
            }
            (out.last_step, out.to) = (start + count, sampled.angles[count]);
        }
        if !self.gap.harmonics.is_empty() {
            // A NaN is kept.
            let lowest = sampled.lowest();
            let higher = lowest >= out.lowest || out.lowest.is_nan();
            out.lowest = if higher { out.lowest } else { lowest };
        }
        if brackets.count > 0 {
            self.refine(&mut brackets, out);
        }
    }

    /// Tells every part of the circle where the film is thinner than the layer, cut where G changes its sign, rad.
    pub fn over_wet(&self, mut tell: impl FnMut(f64, f64)) {
        let (steps, mut stretch) = (self.steps(), Stretch::new());
        while stretch.last_step < steps {
            self.next(steps, &mut stretch);
            let (mut wet, mut from) = (stretch.negative[DRY], stretch.from);
            let end = Break { angle: stretch.to, of: OPENING };
            for b in stretch.breaks.all().iter().chain([&end]) {
                if wet && b.angle > from {
                    tell(from, b.angle);
                }
                wet ^= b.of == DRY;
                from = b.angle;
            }
        }
    }

    /// Number of arcs where the film is thinner than the layer, and the angle that they take together, rad.
    pub fn wet_arcs(&self) -> (u32, f64) {
        let (mut starts, mut angle, mut last) = (0, 0.0, f64::NAN);
        let mut first = None;
        self.over_wet(|from, to| {
            first.get_or_insert(from);
            starts += u32::from(from != last);
            angle += to - from;
            last = to;
        });
        // What ends where the circle does goes on where it begins.
        let goes_on = starts > 1 && first == Some(-PI) && last >= PI - 1e-12;
        (starts - u32::from(goes_on), angle)
    }

    /// Finds the places in these brackets; where functions turned back beyond zero, there are more.
    fn refine(&self, brackets: &mut Brackets, out: &mut Stretch) {
        let (mut value, mut film) = (ZEROS, ZEROS);
        let count = brackets.count;
        let roots = Roots { search: self, brackets, value: &mut value, film: &mut film };
        dispatch(self.instructions, roots);
        let mut more = None;
        for i in 0..count {
            let (angle, of) = (brackets.angle[i], brackets.of[i] as usize);
            let aim = brackets.aim[i];
            if aim == Aim::Zero {
                out.breaks.add(angle, of);
                continue;
            }
            if of == DRY {
                out.look_at(film[i], angle);
            }
            let [a, b] = [brackets.ends[0][i], brackets.ends[1][i]];
            let Aim::Turn { negative } = aim else { continue };
            let beyond = if negative { value[i] > 0.0 } else { value[i] < 0.0 };
            if beyond && a < angle && angle < b {
                let more = more.get_or_insert_with(Brackets::none);
                more.add([a, angle], 0.5 * (a + angle), negative, of, Aim::Zero);
                more.add([angle, b], 0.5 * (angle + b), !negative, of, Aim::Zero);
            }
        }
        if let Some(more) = &mut more {
            self.refine(more, out);
        }
    }

    /// Functions with their first and second derivatives at a place.
    #[inline(always)]
    fn functions<B: Base>(&self, p: &Place<B>) -> [[B; 3]; FUNCTIONS] {
        let ([h, h1, h2, _], [g, g1, g2]) = (p.film, p.opening);
        let excess = match self.aims {
            Aims::Minima | Aims::Edges => p.opening,
            Aims::EdgesAndExcess(c) => {
                let square = h * h;
                [
                    g + square * h * c,
                    g1 + square * h1 * (3.0 * c),
                    g2 + h * (h1 * h1 * 2.0 + h * h2) * (3.0 * c),
                ]
            }
        };
        [[h - self.layer, h1, h2], p.opening, excess]
    }

    /// The function of this number at each place.
    #[inline(always)]
    fn function<B: Base>(&self, of: B, p: &Place<B>) -> [B; 3] {
        let [mut out, opening, excess] = self.functions(p);
        for k in 0..3 {
            out[k] = B::select(of.above(0.5), B::select(of.above(1.5), excess[k], opening[k]), out[k]);
        }
        out
    }
}

struct Scan<'a> {
    search: &'a Search<'a>,
    start: usize,
    steps: usize,
    sampled: &'a mut Sampled,
}

impl Columns for Scan<'_> {
    fn rows(&self) -> usize {
        WIDEST
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let step = TAU / self.steps as f64;
        let angle = (Pack::<S, K>::load(simd, &COUNTED[first..]) + self.start as f64) * step - PI;
        angle.store(&mut self.sampled.angles[first..]);
        let place = self.search.gap.at(angle);
        let used = match self.search.aims {
            Aims::Minima => OPENING,
            Aims::Edges => EXCESS,
            Aims::EdgesAndExcess(_) => FUNCTIONS,
        };
        let zero = Pack::<S, K>::all(simd, 0.0);
        let mut signs = zero;
        let functions = self.search.functions(&place);
        let columns = self.sampled.functions.iter_mut();
        for (of, ([value, slope, _], [values, slopes])) in
            functions.iter().zip(columns).enumerate().take(used)
        {
            signs += bit(*value, of) + bit(*slope, FUNCTIONS + of);
            value.store(&mut values[first..]);
            slope.store(&mut slopes[first..]);
        }
        place.film[0].store(&mut self.sampled.film[first..]);
        let lowest = Pack::load(simd, &self.sampled.lowest[first..]);
        Pack::select(lowest.less_or_equal(place.film[0]), lowest, place.film[0])
            .store(&mut self.sampled.lowest[first..]);
        signs.store(&mut self.sampled.signs[first..]);
    }
}

/// 2^`of` where x is negative, else 0.
#[inline(always)]
fn bit<B: Base>(x: B, of: usize) -> B {
    B::select(x.below(0.0), x.splat(f64::from(1u32 << of)), x.splat(0.0))
}

/// Whether x is between a and b.
#[inline(always)]
fn within<B: Base>(x: B, a: B, b: B) -> B::Mask {
    a.less_or_equal(x) & x.less_or_equal(b)
}

/// Newton's method for several places at a time, each kept within its bracket.
struct Roots<'a> {
    search: &'a Search<'a>,
    brackets: &'a mut Brackets,
    /// The function, and the film in m, at the places found.
    value: &'a mut Lanes,
    film: &'a mut Lanes,
}

impl Columns for Roots<'_> {
    fn rows(&self) -> usize {
        self.brackets.count
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let Brackets { ends: [a, b], angle, sign, of, of_slope, .. } = &mut *self.brackets;
        let (mut a, mut b) = (Pack::<S, K>::load(simd, &a[first..]), Pack::load(simd, &b[first..]));
        let sign = Pack::load(simd, &sign[first..]);
        let of = Pack::load(simd, &of[first..]);
        let turns = Pack::load(simd, &of_slope[first..]).above(0.5);
        let middle = (a + b) * 0.5;
        let mut x = Pack::load(simd, &angle[first..]);
        x = Pack::select(within(x, a, b), x, middle);
        let mut searching = x.like(1.0);
        let (mut kept, mut film) = (x, x);
        for _ in 0..MOST_STEPS {
            let place = self.search.gap.at(x);
            let [value, slope, curvature] = self.search.function(of, &place);
            let active = searching.above(0.5);
            // Where a function turns, the last step changes it by less than its digits.
            kept = Pack::select(active, value, kept);
            film = Pack::select(active, place.film[0], film);
            let (f, df) = (Pack::select(turns, slope, value), Pack::select(turns, curvature, slope));
            let before = (f * sign).above(0.0);
            a = Pack::select(before, x, a);
            b = Pack::select(before, b, x);
            let newton = x - f / df;
            let next = Pack::select(within(newton, a, b), newton, (a + b) * 0.5);
            let exact = f.at_least(0.0) & f.at_most(0.0);
            let next = Pack::select(exact, x, next);
            let last = (next - x).abs().less_or_equal(x.abs() * LAST_STEP[0] + LAST_STEP[1]);
            x = Pack::select(active, next, x);
            searching = Pack::select(last, x.like(0.0), searching);
            if !Pack::<S, K>::any(searching.above(0.5)) {
                break;
            }
        }
        x.store(&mut angle[first..]);
        kept.store(&mut self.value[first..]);
        film.store(&mut self.film[first..]);
    }
}
