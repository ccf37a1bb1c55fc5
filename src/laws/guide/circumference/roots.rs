//! Places where functions of the gap are zero or turn back, several at a time.
//!
//! The first guess is that of the cubic through values and slopes at the ends of a bracket. From there
//! x <- x - r (1 + r (k + r (2 k^2 - t)))  with  r = f/f',  k = f''/2f',  t = f'''/6f',
//! whose error falls with its fourth power, or with its third where a function turns back; a step that leaves the bracket halves it.

use super::stretch::{FUNCTIONS, Functions};
use crate::scalar::{Base, Columns, Lanes, Numeric, Pack, WIDEST, dispatch};
use pulp::{Arch, Simd};

/// Largest number of brackets that one step needs.
const MOST_OF_STEP: usize = FUNCTIONS + 1;
/// Largest number of steps; each that fails to be one halves a bracket.
const MOST_STEPS: usize = 60;
/// Newton steps on the cubic of a bracket.
const GUESS_STEPS: usize = 3;
/// Error of a place that is as good as none, rad.
const EXACT: f64 = 1e-14;

/// What is looked for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Aim {
    /// The place where the function is zero.
    #[default]
    Zero,
    /// The place where it turns back, having this sign at both ends.
    Turn { negative: bool },
    /// The same, for the smallest film only.
    Lowest,
}

/// A block of brackets, in each of which a place is looked for.
#[derive(Default)]
#[repr(align(64))]
pub(super) struct Brackets {
    pub count: usize,
    /// How many of them may lead to two more.
    turns: usize,
    pub aim: [Aim; WIDEST],
    /// Ends, rad, and then the place.
    pub ends: [Lanes; 2],
    pub angle: Lanes,
    /// The function at both ends and its slopes there, for the first guess.
    values: [Lanes; 2],
    slopes: [Lanes; 2],
    /// Minus one where what is to be zero rises, else one.
    sign: Lanes,
    /// Number of the function, and one where not itself but its slope is to be zero.
    pub of: Lanes,
    of_slope: Lanes,
    /// The function, and the film in m, at the places found.
    pub value: Lanes,
    pub film: Lanes,
}

/// One bracket.
pub(super) struct Bracket {
    /// rad
    pub ends: [f64; 2],
    /// The function at both ends, and its slopes there; zero where they are not known.
    pub values: [f64; 2],
    pub slopes: [f64; 2],
    /// Whether what is to be zero rises.
    pub rises: bool,
    /// Number of the function.
    pub of: usize,
    pub aim: Aim,
}

impl Brackets {
    #[inline(always)]
    pub fn add(&mut self, bracket: Bracket) {
        let Bracket { ends, values, slopes, rises, of, aim } = bracket;
        let i = self.count;
        self.count += 1;
        self.turns += usize::from(matches!(aim, Aim::Turn { .. }));
        self.aim[i] = aim;
        for k in 0..2 {
            (self.ends[k][i], self.values[k][i], self.slopes[k][i]) = (ends[k], values[k], slopes[k]);
        }
        self.sign[i] = if rises { -1.0 } else { 1.0 };
        (self.of[i], self.of_slope[i]) = (of as f64, if aim == Aim::Zero { 0.0 } else { 1.0 });
    }

    /// Whether all that one more step needs has room, and what it leads to, too.
    pub fn has_room(&self) -> bool {
        self.count + MOST_OF_STEP <= WIDEST && 2 * (self.turns + FUNCTIONS) <= WIDEST
    }

    /// Finds the places.
    pub fn find(&mut self, functions: &Functions<'_>, instructions: Arch) {
        let order = f64::from(functions.gap.order());
        dispatch(instructions, Roots { functions, brackets: self, order });
    }
}

/// Whether x is between a and b.
#[inline(always)]
fn within<B: Base>(x: B, a: B, b: B) -> B::Mask {
    a.less_or_equal(x) & x.less_or_equal(b)
}

/// What stands at both ends.
#[inline(always)]
fn load<S: Simd, const K: usize>(simd: S, ends: &[Lanes; 2], first: usize) -> [Pack<S, K>; 2] {
    [Pack::load(simd, &ends[0][first..]), Pack::load(simd, &ends[1][first..])]
}

struct Roots<'a> {
    functions: &'a Functions<'a>,
    brackets: &'a mut Brackets,
    /// Highest order of the gap.
    order: f64,
}

impl Roots<'_> {
    /// The place where the cubic of each bracket is zero or turns back.
    #[inline(always)]
    fn guess<S: Simd, const K: usize>(&self, simd: S, first: usize, turns: &Mask<S, K>) -> Pack<S, K> {
        let Brackets { ends, values, slopes, .. } = &*self.brackets;
        let [from, to] = load::<S, K>(simd, ends, first);
        let length = to - from;
        let [a, b] = load::<S, K>(simd, values, first);
        let [da, db] = load::<S, K>(simd, slopes, first);
        let (da, db) = (da * length, db * length);
        // a + t (da + t (square + t cube))
        let square = (b - a) * 3.0 - da * 2.0 - db;
        let cube = (a - b) * 2.0 + da + db;
        let (zero, one) = (a.like(0.0), a.like(1.0));
        let mut t = Pack::select(*turns, da / (da - db), a / (a - b));
        for _ in 0..GUESS_STEPS {
            let slope = da + t * (square * 2.0 + t * cube * 3.0);
            let f = Pack::select(*turns, slope, a + t * (da + t * (square + t * cube)));
            let df = Pack::select(*turns, square * 2.0 + t * cube * 6.0, slope);
            let next = t - f / df;
            t = Pack::select(within(next, zero, one), next, t);
        }
        // Without values it is not a number.
        Pack::select(within(t, zero, one), from + t * length, (from + to) * 0.5)
    }
}

type Mask<S, const K: usize> = <Pack<S, K> as Numeric>::Mask;

impl Columns for Roots<'_> {
    fn rows(&self) -> usize {
        self.brackets.count
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let Brackets { ends, sign, of, of_slope, .. } = &*self.brackets;
        let turns = Pack::<S, K>::load(simd, &of_slope[first..]).above(0.5);
        let [mut a, mut b] = load::<S, K>(simd, ends, first);
        let (sign, of) = (Pack::load(simd, &sign[first..]), Pack::load(simd, &of[first..]));
        let mut x = self.guess(simd, first, &turns);
        let zero = x.like(0.0);
        let mut searching = x.like(1.0);
        let (mut kept, mut film) = (x, x);
        for _ in 0..MOST_STEPS {
            let place = self.functions.gap.at(x);
            let [value, slope, curvature, third] = self.functions.at(of, &place);
            let active = searching.above(0.5);
            let (f, df) = (Pack::select(turns, slope, value), Pack::select(turns, curvature, slope));
            let bend = Pack::select(turns, third, curvature);
            let before = (f * sign).above(0.0);
            a = Pack::select(before, x, a);
            b = Pack::select(before, b, x);
            let inverse = x.like(1.0) / df;
            let (ratio, bend) = (f * inverse, bend * inverse * 0.5);
            let turn = bend * bend * 2.0 - third * inverse * (1.0 / 6.0);
            let turn = Pack::select(turns, zero, turn);
            let better = x - ratio * (ratio * (ratio * turn + bend) + 1.0);
            let stays = within(better, a, b);
            let next = Pack::select(stays, better, (a + b) * 0.5);
            let exact = f.at_least(0.0) & f.at_most(0.0);
            let next = Pack::select(exact, x, next);
            let step = next - x;
            // What is left is about the last power of the step times that of a length which the order stands for.
            let length = step * (bend.abs() + self.order);
            let power = length * length * step;
            let error = Pack::select(turns, power, power * length).abs();
            let last = error.less_or_equal(x.abs() * EXACT + EXACT);
            kept = Pack::select(active, value + step * (slope + step * curvature * 0.5), kept);
            let [h, h1, h2, _] = place.film;
            film = Pack::select(active, h + step * (h1 + step * h2 * 0.5), film);
            x = Pack::select(active, next, x);
            searching = Pack::select(last, zero, searching);
            if !Pack::<S, K>::any(searching.above(0.5)) {
                break;
            }
        }
        x.store(&mut self.brackets.angle[first..]);
        kept.store(&mut self.brackets.value[first..]);
        film.store(&mut self.brackets.film[first..]);
    }
}
