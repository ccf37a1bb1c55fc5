//! The gap at even distances around the circle, where a search for breaks starts.
//!
//! Places are odd multiples of half a step, so they lie symmetrically: at d, -d, pi - d and d - pi every wave has the same cosine and
//! sine but for signs. Over a quarter of the circle, sums over even and over odd orders give all four quarters. The waves of a
//! bent surface are tabulated there. A gap with orders too high for memory on the stack is found place by place, in parts.

use super::gap::Harmonics;
use super::stretch::{Aims, DRY, EXCESS, FUNCTIONS, Functions, OPENING, excess};
use crate::scalar::{Base, Columns, Numeric, Pack, dispatch, elementary, math};
use pulp::Simd;
use std::f64::consts::{PI, TAU};

/// Places of a group, whose signs stand in one number.
pub(super) const GROUP: usize = 8;
/// Groups of a row: one of each quarter of the circle, or neighbours.
const GROUPS: usize = 4;
/// Rows of memory for a gap without a table: of few orders, and the most.
const FEW_ROWS: usize = 4;
const MOST_ROWS: usize = 24;

type Eight = [f64; GROUP];

/// The gap at the places of four groups. Registers do not cross cache lines.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(in crate::laws::guide) struct Row {
    /// h and dh/dd, m.
    film: [[Eight; 2]; GROUPS],
    /// G and dG/dd, m/s.
    opening: [[Eight; 2]; GROUPS],
    /// A bit for each place at which a function or its slope is negative, in the order of the circle; see [`Signs`].
    signs: [f64; GROUPS],
    /// Smallest film of each place of the groups, m; one that is not a number is the smallest.
    lowest: Eight,
}

impl Row {
    const ZERO: Self = Self {
        film: [[[0.0; GROUP]; 2]; GROUPS],
        opening: [[[0.0; GROUP]; 2]; GROUPS],
        signs: [0.0; GROUPS],
        lowest: [0.0; GROUP],
    };
}

/// Signs at the places of a group: a byte for the values of each function, and behind them one for its slopes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Signs(pub u64);

/// Lowest bit of each byte.
const LOWEST_BITS: u64 = 0x0101_0101_0101;

impl Signs {
    /// Where the sign of this function is negative.
    pub fn values(self, of: usize) -> u8 {
        self.0.to_le_bytes()[of]
    }

    /// Where its slope is negative.
    pub fn slopes(self, of: usize) -> u8 {
        self.0.to_le_bytes()[FUNCTIONS + of]
    }

    /// Signs at the next place of each, where `next` is the next group.
    pub fn shifted(self, next: Self) -> Self {
        Self(((self.0 >> 1) & !(LOWEST_BITS << 7)) | ((next.0 & LOWEST_BITS) << 7))
    }

    /// Where these differ from others.
    pub fn changes(self, other: Self) -> Self {
        Self(self.0 ^ other.0)
    }
}

/// Number of rows of the whole circle for waves up to this order: at least 16 places per period, and 32 in all.
pub(super) fn rows_for(order: u32) -> usize {
    order.max(1).div_ceil(2) as usize
}

/// Cosine and sine at the places of a group.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Wave([Eight; 2]);

/// Waves at the places of the first quarter, in ascending order.
#[derive(Clone, Debug)]
pub(in crate::laws::guide) struct Table {
    order: usize,
    /// Those of each order from one on, row by row.
    waves: Vec<Wave>,
}

impl Table {
    /// For waves up to this order.
    pub fn new(order: u32) -> Self {
        let rows = rows_for(order);
        let step = step(rows);
        let mut waves = Vec::with_capacity(rows * order as usize);
        for row in 0..rows {
            for n in 1..=order {
                let at = |i: usize| f64::from(n) * ((row * GROUP + i) as f64 + 0.5) * step;
                let sines: [_; GROUP] = std::array::from_fn(|i| math::sin_cos(at(i)));
                waves.push(Wave([sines.map(|(_, cos)| cos), sines.map(|(sin, _)| sin)]));
            }
        }
        Self { order: order as usize, waves }
    }

    /// Distance of places, rad.
    pub fn step(&self) -> f64 {
        step(self.waves.len() / self.order)
    }

    /// Memory for the gap at these places.
    pub fn rows(&self) -> Vec<Row> {
        vec![Row::ZERO; self.waves.len() / self.order]
    }
}

/// Distance of places, rad.
fn step(rows: usize) -> f64 {
    TAU / (rows * GROUPS * GROUP) as f64
}

/// Memory of a search, and the table of the waves of a bent surface.
pub(in crate::laws::guide) struct Memory<'m> {
    pub rows: &'m mut [Row],
    pub table: Option<&'m Table>,
}

/// Does `work` with memory for a gap of this order without a table: of the whole circle, or of a part of it for orders above 48.
pub(in crate::laws::guide) fn with_memory<R>(order: u32, work: impl FnOnce(Memory<'_>) -> R) -> R {
    let memory = |rows| Memory { rows, table: None };
    match rows_for(order) {
        1 => work(memory(&mut [Row::ZERO])),
        2 => work(memory(&mut [Row::ZERO; 2])),
        3..=FEW_ROWS => work(memory(&mut [Row::ZERO; FEW_ROWS])),
        _ => work(memory(&mut [Row::ZERO; MOST_ROWS])),
    }
}

/// The gap at all places, or at those of a part of the circle.
pub(super) struct Samples<'m> {
    memory: Memory<'m>,
    /// Rows of the whole circle.
    rows: usize,
    /// Distance of places, rad.
    step: f64,
    /// First group that was found, if one was; all are found together where all have room.
    first: Option<usize>,
}

/// The places of a group.
#[derive(Clone, Copy)]
pub(super) struct Group<'a> {
    row: &'a Row,
    group: usize,
    descends: bool,
}

/// The gap at one of the places.
#[derive(Clone, Copy)]
pub(super) struct Sample<'a> {
    film: &'a [Eight; 2],
    opening: &'a [Eight; 2],
    i: usize,
}

impl<'a> Group<'a> {
    #[inline(always)]
    pub fn signs(self) -> Signs {
        Signs(integer(self.row.signs[self.group]))
    }

    /// Place `i` in the order of the circle.
    #[inline(always)]
    pub fn at(self, i: usize) -> Sample<'a> {
        let i = if self.descends { GROUP - 1 - i } else { i };
        Sample { film: &self.row.film[self.group], opening: &self.row.opening[self.group], i }
    }
}

impl Sample<'_> {
    /// h and its slope, m.
    #[inline(always)]
    pub fn film(self) -> [f64; 2] {
        [self.film[0][self.i], self.film[1][self.i]]
    }

    /// G and its slope, m/s.
    #[inline(always)]
    pub fn opening(self) -> [f64; 2] {
        [self.opening[0][self.i], self.opening[1][self.i]]
    }
}

impl<'m> Samples<'m> {
    pub fn new(order: u32, memory: Memory<'m>) -> Self {
        let Memory { rows: memory, table } = memory;
        let rows = table.map_or_else(|| rows_for(order), |_| memory.len());
        let used = rows.min(memory.len());
        let memory = Memory { rows: &mut memory[..used], table };
        Self { memory, rows, step: step(rows), first: None }
    }

    /// Whether all places are found together.
    fn whole(&self) -> bool {
        self.memory.rows.len() == self.rows
    }

    /// Number of places.
    pub fn count(&self) -> usize {
        self.rows * GROUPS * GROUP
    }

    /// Place `k`, rad; the first one of the next turn follows the last.
    #[inline]
    pub fn angle(&self, k: usize) -> f64 {
        angle(k as u32 as f64, self.step)
    }

    /// Finds the gap in this group and the next, if it is not there yet.
    pub fn reach(&mut self, group: usize, functions: &Functions<'_>, instructions: pulp::Arch) {
        let there = self.first.is_some_and(|first| {
            self.whole() || (group >= first && group + 1 < first + GROUPS * self.memory.rows.len())
        });
        if there {
            return;
        }
        debug_assert!(
            functions.gap.harmonics.is_empty() || self.memory.table.is_some(),
            "a bent surface has a table"
        );
        let first = if self.whole() { 0 } else { group };
        self.first = Some(first);
        let (step, rows) = (self.step, &mut *self.memory.rows);
        let whole = rows.len() == self.rows;
        let table = self.memory.table;
        let fill = Fill { functions, rows, table, whole, step, first: first * GROUP };
        dispatch(instructions, fill);
    }

    /// A group of the circle that was reached, or follows it.
    #[inline]
    pub fn group(&self, group: usize) -> Group<'_> {
        if !self.whole() {
            let i = group - self.first.unwrap_or(0);
            return Group { row: &self.memory.rows[i / GROUPS], group: i % GROUPS, descends: false };
        }
        // What follows the last group is the first one.
        let (mut row, mut quarter) = (group, 0);
        while row >= self.rows {
            (row, quarter) = (row - self.rows, (quarter + 1) % GROUPS);
        }
        let descends = quarter % 2 == 1;
        let row = if descends { self.rows - 1 - row } else { row };
        Group { row: &self.memory.rows[row], group: quarter, descends }
    }

    /// Smallest film at all places, m. One that is not a number is the smallest.
    pub fn lowest(&self) -> f64 {
        let all = self.memory.rows.iter().flat_map(|row| row.lowest);
        all.fold(f64::INFINITY, |low, film| if low <= film { low } else { film })
    }
}

/// A whole number from 0 to 2^52: it stands in the lower bits of a sum of that magnitude.
#[inline(always)]
fn integer(x: f64) -> u64 {
    const MAGNITUDE: u64 = 1 << 52;
    (x + MAGNITUDE as f64).to_bits() & (MAGNITUDE - 1)
}

/// Place `k`, rad.
#[inline(always)]
fn angle<B: Numeric>(k: B, step: f64) -> B {
    (k + 0.5) * step - PI
}

/// Bits of the places of a group in ascending and in descending order.
const BITS: [Eight; 2] =
    [[1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0], [128.0, 64.0, 32.0, 16.0, 8.0, 4.0, 2.0, 1.0]];
/// 0, 1, 2, ...
const COUNTED: Eight = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// Finds the gap at the places of rows.
struct Fill<'a> {
    functions: &'a Functions<'a>,
    rows: &'a mut [Row],
    table: Option<&'a Table>,
    /// Whether these are the rows of the whole circle, or neighbours from the `first` place on.
    whole: bool,
    step: f64,
    first: usize,
}

/// A function and its slope.
type WithSlope<S, const K: usize> = [Pack<S, K>; 2];

impl Fill<'_> {
    /// Keeps the gap at the places of a group, from `i` on.
    #[inline(always)]
    fn keep<S: Simd, const K: usize>(
        &mut self,
        simd: S,
        [row, group, i]: [usize; 3],
        descends: bool,
        film: WithSlope<S, K>,
        opening: WithSlope<S, K>,
    ) {
        let Functions { layer, aims, .. } = *self.functions;
        let ([h, h1], [g, g1]) = (film, opening);
        let bits = Pack::<S, K>::load(simd, &BITS[usize::from(descends)][i..]);
        let mut signs = signs_of(bits, DRY, [h - layer, h1]);
        if aims != Aims::Minima {
            signs += signs_of(bits, OPENING, opening);
        }
        if let Aims::EdgesAndExcess(c) = aims {
            signs += signs_of(bits, EXCESS, excess(c, film, opening));
        }
        let row = &mut self.rows[row];
        let before = if i == 0 { 0.0 } else { row.signs[group] };
        row.signs[group] = before + signs.sum();
        let lowest = Pack::load(simd, &row.lowest[i..]);
        let lowest = if group == 0 { h } else { Pack::select(lowest.less_or_equal(h), lowest, h) };
        lowest.store(&mut row.lowest[i..]);
        let [films, openings] = [&mut row.film[group], &mut row.opening[group]];
        h.store(&mut films[0][i..]);
        h1.store(&mut films[1][i..]);
        g.store(&mut openings[0][i..]);
        g1.store(&mut openings[1][i..]);
    }
}

impl Columns for Fill<'_> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        GROUP * self.rows.len()
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let (row, i) = (first / GROUP, first % GROUP);
        let gap = self.functions.gap;
        if !self.whole {
            for group in 0..GROUPS {
                let start = self.first + (GROUPS * row + group) * GROUP;
                let k = Pack::<S, K>::load(simd, &COUNTED[i..]) + start as f64;
                let place = gap.at(angle(k, self.step));
                let ([h, h1, ..], [g, g1, ..]) = (place.film, place.opening);
                self.keep(simd, [row, group, i], false, [h, h1], [g, g1]);
            }
            return;
        }
        let zero = Pack::<S, K>::all(simd, 0.0);
        // Cosine and sine parts of h, dh/dd, G and dG/dd.
        let (mut odd, mut even) = ([[zero; 2]; 4], [[zero; 2]; 4]);
        if let Some(table) = self.table {
            let waves = &table.waves[row * table.order..][..table.order];
            let harmonics = &gap.harmonics[..table.order];
            let mut n = 1;
            while n <= table.order {
                add(&mut odd, n as f64, load(simd, &waves[n - 1], i), &harmonics[n - 1]);
                if n < table.order {
                    add(&mut even, (n + 1) as f64, load(simd, &waves[n], i), &harmonics[n]);
                }
                n += 2;
            }
        } else {
            let k = Pack::<S, K>::load(simd, &COUNTED[i..]) + (row * GROUP) as f64;
            let (sin, cos) = elementary::sin_cos((k + 0.5) * self.step);
            add(&mut odd, 1.0, [cos, sin], &gap.first_harmonic());
            let (mut n, mut wave) = (1, [cos, sin]);
            for lobe in gap.lobes {
                if lobe.order < n {
                    (n, wave) = (1, [cos, sin]);
                }
                while n < lobe.order {
                    let [c, s] = wave;
                    (n, wave) = (n + 1, [c * cos - s * sin, s * cos + c * sin]);
                }
                let parts = if n % 2 == 1 { &mut odd } else { &mut even };
                add(parts, f64::from(n), wave, &gap.harmonic_of(lobe));
            }
        }
        let mean = gap.mean();
        for group in 0..GROUPS {
            // d - pi, -d, d, pi - d
            let mut functions = [zero; 4];
            for k in 0..4 {
                let ([odd_cos, odd_sin], [even_cos, even_sin]) = (odd[k], even[k]);
                functions[k] = match group {
                    0 => even_cos - odd_cos + even_sin - odd_sin,
                    1 => even_cos + odd_cos - even_sin - odd_sin,
                    2 => even_cos + odd_cos + even_sin + odd_sin,
                    _ => even_cos - odd_cos - even_sin + odd_sin,
                };
            }
            let [h, h1, g, g1] = functions;
            let film = [h + mean, h1];
            self.keep(simd, [row, group, i], group % 2 == 1, film, [g, g1]);
        }
    }
}

/// Bits where a function and its slope are negative, in their bytes.
#[inline(always)]
fn signs_of<S: Simd, const K: usize>(
    bits: Pack<S, K>,
    of: usize,
    [value, slope]: WithSlope<S, K>,
) -> Pack<S, K> {
    let zero = bits.like(0.0);
    Pack::select(value.below(0.0), bits * byte(of), zero)
        + Pack::select(slope.below(0.0), bits * byte(FUNCTIONS + of), zero)
}

/// Lowest bit of a byte.
const fn byte(i: usize) -> f64 {
    (1u64 << (GROUP * i)) as f64
}

/// Cosine and sine of a wave, from `i` on.
#[inline(always)]
fn load<S: Simd, const K: usize>(simd: S, wave: &Wave, i: usize) -> [Pack<S, K>; 2] {
    [Pack::load(simd, &wave.0[0][i..]), Pack::load(simd, &wave.0[1][i..])]
}

/// Adds the waves of one order to cosine and sine parts.
#[inline(always)]
fn add<S: Simd, const K: usize>(
    parts: &mut [[Pack<S, K>; 2]; 4],
    n: f64,
    [cos, sin]: [Pack<S, K>; 2],
    of: &Harmonics,
) {
    let ([a, b], [c, d]) = (of.film, of.opening);
    let factors = [[a, b], [n * b, -n * a], [c, d], [n * d, -n * c]];
    for k in 0..4 {
        parts[k][0] += cos * factors[k][0];
        parts[k][1] += sin * factors[k][1];
    }
}
