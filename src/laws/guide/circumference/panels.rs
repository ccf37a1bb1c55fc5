//! Integrals of pressure and shear over the circumference in panels of sixteen places, one block of lanes each.
//!
//! Panels lie between breaks. Beyond the cap, a piece is mapped by d = middle - half cos(x), because t_c is a square root of
//! the distance from the place where s = s_cap. A panel is halved until the last two terms of the Legendre series of the
//! pressure and of the stress through its places are small; those of a smooth function fall as a geometric series, and the
//! error of the sum is about the square of the last. Force and derivatives are sums over the same places.

use super::gap::Gap;
use super::land::{Land, OUTPUTS, VELOCITIES, over_positions, over_velocities, tangential};
use crate::scalar::{Columns, Lanes, Numeric, Pack, WIDEST, ZEROS, dispatch, elementary};
use pulp::{Arch, Simd};
use std::f64::consts::PI;

/// Halvings of a panel; reached only by states that are not finite.
const DEEPEST: u32 = 14;
/// Largest share that the last terms of the series of a panel may have.
const TAIL: f64 = 1e-6;
/// Widest panel, rad.
const WIDEST_PANEL: f64 = 1.6;
/// Panels per period of the highest order of the gap, at least.
const PANELS_PER_PERIOD: f64 = 1.0;
/// Round-off of G relative to its largest part.
const ROUND_OFF: f64 = 1e-11;

/// What is summed over the places of panels.
pub(in crate::laws::guide) trait PanelSums {
    /// Adds the film at the places of a panel, unless its series do not suit, where it can be halved. Whether it did.
    fn add(&mut self, panel: &Panel<'_>, halves: bool, noise: f64, instructions: Arch) -> bool;

    /// Adds what the ends of wet arcs do: see [`Panels::complete_ends`]. `jump` is the tangential force there over the pressure times
    /// the film; 0 for none.
    fn add_ends(&mut self, places: &Ends<'_>, instructions: Arch);

    /// Whether ends matter without a jump.
    fn moves_ends(&self) -> bool;
}

/// Sums over the places of all panels, lane by lane.
pub(in crate::laws::guide) struct Sums<'a> {
    pub land: Land,
    /// Outputs.
    pub values: [Lanes; OUTPUTS],
    /// Their derivatives over all variables, over velocities only, or none.
    pub slopes: &'a mut [[Lanes; OUTPUTS]],
}

/// Each output.
pub(in crate::laws::guide) fn totals(lanes: &[Lanes; OUTPUTS]) -> [f64; OUTPUTS] {
    lanes.each_ref().map(total)
}

/// Sum of all lanes, in an order that lets neighbours be added at a time.
#[inline]
pub(in crate::laws::guide) fn total(lanes: &Lanes) -> f64 {
    let mut sums = *lanes;
    for half in [8, 4, 2, 1] {
        for i in 0..half {
            sums[i] += sums[i + half];
        }
    }
    sums[0]
}

impl PanelSums for Sums<'_> {
    fn add(&mut self, panel: &Panel<'_>, halves: bool, noise: f64, instructions: Arch) -> bool {
        let mut found = Found { outputs: [ZEROS; OUTPUTS], pressure: ZEROS, stress: ZEROS, cubes: ZEROS };
        dispatch(instructions, Values { land: &self.land, panel, found: &mut found });
        if halves && !suits([&found.pressure, &found.stress, &found.cubes], noise) {
            return false;
        }
        for (sum, output) in self.values.iter_mut().zip(&found.outputs) {
            for (sum, output) in sum.iter_mut().zip(output) {
                *sum += output;
            }
        }
        if !self.slopes.is_empty() {
            dispatch(instructions, Slopes { land: &self.land, panel, slopes: self.slopes });
        }
        true
    }

    fn add_ends(&mut self, ends: &Ends<'_>, instructions: Arch) {
        dispatch(instructions, EndSums { ends, sums: self });
    }

    fn moves_ends(&self) -> bool {
        self.slopes.len() > VELOCITIES
    }
}

/// Integrator over the panels of one state.
pub(in crate::laws::guide) struct Panels<'a, S> {
    pub land: Land,
    pub gap: &'a Gap<'a>,
    /// Not less than any |G|, m/s.
    pub largest_opening: f64,
    /// Whether the pressure jumps at the ends of wet arcs.
    jumps: bool,
    pub instructions: Arch,
    pub sums: S,
    /// Ends of wet arcs that are not in the sums yet.
    end_angles: Lanes,
    end_sides: Lanes,
    end_count: usize,
}

/// Part of the circle between two breaks, or of its map.
#[derive(Clone, Copy)]
pub(in crate::laws::guide) struct Piece {
    /// Whether d = middle - half cos(x); else d = x.
    mapped: bool,
    middle: f64,
    half: f64,
}

impl Piece {
    /// One that is not mapped.
    pub const STRAIGHT: Self = Self { mapped: false, middle: 0.0, half: 0.0 };
}

impl<'a, S: PanelSums> Panels<'a, S> {
    /// Nothing yet. No |G| is above `largest_opening`, m/s; at the ends of wet arcs the pressure `jumps` or not.
    pub fn new(
        land: Land,
        gap: &'a Gap<'a>,
        largest_opening: f64,
        jumps: bool,
        instructions: Arch,
        sums: S,
    ) -> Self {
        let (end_angles, end_sides) = (ZEROS, ZEROS);
        Self { land, gap, largest_opening, jumps, instructions, sums, end_angles, end_sides, end_count: 0 }
    }

    /// Adds the film between `from` and `to`; `capped` where s > s_cap.
    pub fn add(&mut self, from: f64, to: f64, capped: bool) {
        // Written so that a NaN leads nowhere.
        let exists = to > from;
        if !exists {
            return;
        }
        let piece = Piece { mapped: capped, middle: 0.5 * (from + to), half: 0.5 * (to - from) };
        let widest = WIDEST_PANEL.min(2.0 * PI / (PANELS_PER_PERIOD * f64::from(self.gap.order())));
        let panels = ((to - from) / widest).ceil().max(if capped { 2.0 } else { 1.0 });
        let (start, width) = if capped { (0.0, PI / panels) } else { (from, (to - from) / panels) };
        for i in 0..panels as usize {
            let a = start + i as f64 * width;
            self.panel(&piece, a, a + width, 0);
        }
    }

    fn panel(&mut self, piece: &Piece, from: f64, to: f64, depth: u32) {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let panel = Panel { gap: self.gap, piece, middle, half };
        let noise = ROUND_OFF * self.land.area * self.land.peak_scale * self.largest_opening;
        if !self.sums.add(&panel, depth < DEEPEST, noise, self.instructions) {
            self.panel(piece, from, middle, depth + 1);
            self.panel(piece, middle, to, depth + 1);
        }
    }

    /// An end of a wet arc at this angle, rad: +1 where the arc ends, -1 where it starts.
    pub fn add_end(&mut self, angle: f64, side: f64) {
        if !self.jumps && !self.sums.moves_ends() {
            return;
        }
        let i = self.end_count;
        (self.end_angles[i], self.end_sides[i], self.end_count) = (angle, side, i + 1);
        if self.end_count == WIDEST {
            self.complete_ends();
        }
    }

    /// Adds what these ends do: the jump of the pressure there, if `jumps`, and to the derivatives that they move.
    pub fn complete_ends(&mut self) {
        let count = std::mem::take(&mut self.end_count);
        if count == 0 {
            return;
        }
        let jump = if self.jumps { -0.5 / self.land.radius } else { 0.0 };
        let ends = Ends { gap: self.gap, angles: &self.end_angles, sides: &self.end_sides, count, jump };
        self.sums.add_ends(&ends, self.instructions);
        // Lanes that the next ends leave must add nothing.
        self.end_sides = ZEROS;
    }
}

/// Places of a panel.
pub(in crate::laws::guide) struct Panel<'a> {
    pub gap: &'a Gap<'a>,
    piece: &'a Piece,
    middle: f64,
    half: f64,
}

impl<'a> Panel<'a> {
    /// The places at most `half` from `middle`, rad.
    pub fn new(gap: &'a Gap<'a>, piece: &'a Piece, middle: f64, half: f64) -> Self {
        Self { gap, piece, middle, half }
    }

    /// Places (rad) and their weights (rad) in the sums, of a group.
    #[inline(always)]
    pub fn places<S: Simd, const K: usize>(&self, simd: S, first: usize) -> [Pack<S, K>; 2] {
        let x = Pack::load(simd, &NODES[first..]) * self.half + self.middle;
        let weight = Pack::load(simd, &WEIGHTS[first..]) * self.half;
        if !self.piece.mapped {
            return [x, weight];
        }
        let (sin, cos) = elementary::sin_cos(x);
        let Piece { middle, half, .. } = *self.piece;
        [-(cos * half) + middle, weight * sin * half]
    }
}

/// What the film does at the places of a panel.
struct Found {
    /// Parts of the sums.
    outputs: [Lanes; OUTPUTS],
    /// Parts of the integrals of pressure, viscosity over film, and the inverse cube of the film.
    pressure: Lanes,
    stress: Lanes,
    cubes: Lanes,
}

/// Whether the last terms of the series of pressure and stress are small, or at least of round-off. A NaN suits, or nothing would.
pub(in crate::laws::guide) fn suits([pressure, stress, cubes]: [&Lanes; 3], noise: f64) -> bool {
    // Round-off is asked for only where it may matter.
    let rough = |parts: &Lanes, allowed: &dyn Fn() -> f64| {
        let (tail, whole) = (tail(parts), TAIL * total(parts));
        tail > whole && tail > whole + allowed()
    };
    !(rough(pressure, &|| noise * total(cubes)) || rough(stress, &|| 0.0))
}

/// Size of the last two terms of the series.
#[inline]
fn tail(parts: &Lanes) -> f64 {
    let mut products = *parts;
    for (product, term) in products.iter_mut().zip(&LAST_TERMS) {
        *product *= term;
    }
    total(&products).abs()
}

struct Values<'a> {
    land: &'a Land,
    panel: &'a Panel<'a>,
    found: &'a mut Found,
}

impl Columns for Values<'_> {
    fn rows(&self) -> usize {
        WIDEST
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let [d, weight] = self.panel.places::<S, K>(simd, first);
        let place = self.panel.gap.at(d);
        let (stress, mean, inverse) = self.land.at(&place);
        let outputs = stress.outputs(place.cos, place.sin);
        let Found { outputs: columns, pressure, stress: stresses, cubes } = &mut *self.found;
        for (column, output) in columns.iter_mut().zip(&outputs) {
            (*output * weight).store(&mut column[first..]);
        }
        (stress.normal * weight).store(&mut pressure[first..]);
        (mean.viscosity * inverse * weight).store(&mut stresses[first..]);
        (inverse * inverse * inverse * weight).store(&mut cubes[first..]);
    }
}

/// Derivatives of the sums of a panel at places that stay.
struct Slopes<'a> {
    land: &'a Land,
    panel: &'a Panel<'a>,
    slopes: &'a mut [[Lanes; OUTPUTS]],
}

impl Slopes<'_> {
    // Loops over numbers are written out by the compiler, those over iterators here are not.
    #[allow(clippy::needless_range_loop)]
    #[inline(always)]
    fn add<S: Simd, const K: usize, const N: usize>(&mut self, simd: S, first: usize) {
        let (gap, land) = (self.panel.gap, self.land);
        let [d, weight] = self.panel.places::<S, K>(simd, first);
        let place = gap.at(d);
        let outputs = land.with_slopes::<S, K, N>(&place).outputs(place.cos, place.sin);
        let (of_velocities, of_positions) = self.slopes.split_at_mut(VELOCITIES);
        for k in 0..OUTPUTS {
            let mut local = outputs[k].eps;
            for slope in &mut local {
                *slope = *slope * weight;
            }
            let velocities = over_velocities(gap, &place, local[0], local[1]);
            for i in 0..VELOCITIES {
                velocities[i].add_to(&mut of_velocities[i][k][first..]);
            }
            if N > 2 {
                let positions = over_positions(gap, &place, local[0], local[2], local[N - 1]);
                for i in 0..2 {
                    positions[i].add_to(&mut of_positions[i][k][first..]);
                }
            }
        }
    }
}

impl Columns for Slopes<'_> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        WIDEST
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        if self.slopes.len() > VELOCITIES {
            self.add::<S, K, 4>(simd, first);
        } else {
            self.add::<S, K, 2>(simd, first);
        }
    }
}

#[inline(always)]
fn add<S: Simd, const K: usize>(more: &[Pack<S, K>; OUTPUTS], sums: &mut [Lanes; OUTPUTS], first: usize) {
    for (sum, more) in sums.iter_mut().zip(more) {
        more.add_to(&mut sum[first..]);
    }
}

/// Some ends of wet arcs.
pub(in crate::laws::guide) struct Ends<'a> {
    pub gap: &'a Gap<'a>,
    /// rad
    pub angles: &'a Lanes,
    /// +1 where an arc ends, -1 where it starts.
    pub sides: &'a Lanes,
    pub count: usize,
    /// Tangential force there over the pressure times the film; 0 for none.
    pub jump: f64,
}

/// Adds their part of the sums.
struct EndSums<'a, 'b> {
    ends: &'a Ends<'a>,
    sums: &'a mut Sums<'b>,
}

impl Columns for EndSums<'_, '_> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.ends.count
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let Ends { gap, angles, sides, jump, .. } = *self.ends;
        let land = self.sums.land;
        let side = Pack::<S, K>::load(simd, &sides[first..]);
        let place = gap.at(Pack::load(simd, &angles[first..]));
        let (cos, sin, film) = (place.cos, place.sin, place.film[0]);
        let (of_jump, radius) = (film * side * jump, land.radius);
        if self.sums.slopes.is_empty() {
            let (stress, ..) = land.at(&place);
            add(&tangential(stress.normal * of_jump, cos, sin, radius), &mut self.sums.values, first);
            return;
        }
        let stress = land.with_slopes::<S, K, 4>(&place);
        let along = stress.normal.re * of_jump;
        add(&tangential(along, cos, sin, radius), &mut self.sums.values, first);
        let (of_velocities, of_positions) = self.sums.slopes.split_at_mut(VELOCITIES);
        // The film at an end stays that of the layer.
        let zero = side.like(0.0);
        let over_opening = stress.normal.eps[0];
        let velocities = over_velocities(gap, &place, over_opening, zero);
        for (sums, over) in of_velocities.iter_mut().zip(&velocities) {
            add(&tangential(*over * of_jump, cos, sin, radius), sums, first);
        }
        // How far an end moves with y and z; where the arc is about to open or close, it has no derivative.
        let inverse = side.like(1.0) / place.film[1];
        let inverse = Pack::select(inverse.abs().below(1e100), inverse, zero);
        let moved = [cos * inverse, sin * inverse];
        let density = stress.outputs(cos, sin);
        let positions = over_positions(gap, &place, over_opening, zero, zero);
        for ((sums, over), moved) in of_positions.iter_mut().zip(&positions).zip(&moved) {
            let normal = *over + over_opening * place.opening[1] * *moved;
            let turned = along * *moved;
            let mut more = tangential(normal * of_jump, cos, sin, radius);
            more[2] -= turned * cos;
            more[3] -= turned * sin;
            for (more, density) in more.iter_mut().zip(&density) {
                *more += density.re * side * *moved;
            }
            add(&more, sums, first);
        }
    }
}

/// Nodes of the Gauss-Legendre rule on [-1, 1].
const NODES: Lanes = mirrored(&POSITIVE_NODES, -1.0);
/// Their weights.
const WEIGHTS: Lanes = mirrored(&POSITIVE_WEIGHTS, 1.0);
/// 29 P_14 + 31 P_15 at the nodes: with weights, the size of the last two terms of the Legendre series of what stands there.
const LAST_TERMS: Lanes = last_terms();

const POSITIVE_NODES: [f64; WIDEST / 2] = [
    0.095_012_509_837_637_44,
    0.281_603_550_779_258_9,
    0.458_016_777_657_227_37,
    0.617_876_244_402_643_8,
    0.755_404_408_355_003,
    0.865_631_202_387_831_8,
    0.944_575_023_073_232_6,
    0.989_400_934_991_649_9,
];
const POSITIVE_WEIGHTS: [f64; WIDEST / 2] = [
    0.189_450_610_455_068_5,
    0.182_603_415_044_923_58,
    0.169_156_519_395_002_54,
    0.149_595_988_816_576_73,
    0.124_628_971_255_533_88,
    0.095_158_511_682_492_79,
    0.062_253_523_938_647_894,
    0.027_152_459_411_754_096,
];

const fn mirrored(positive: &[f64; WIDEST / 2], sign: f64) -> Lanes {
    let mut all = ZEROS;
    let mut i = 0;
    while i < WIDEST / 2 {
        all[WIDEST / 2 + i] = positive[i];
        all[WIDEST / 2 - 1 - i] = sign * positive[i];
        i += 1;
    }
    all
}

const fn last_terms() -> Lanes {
    let mut all = ZEROS;
    let mut i = 0;
    while i < WIDEST {
        let x = NODES[i];
        let (mut before, mut now, mut k) = (1.0, x, 1.0);
        while k < 14.0 {
            (before, now) = (now, ((2.0 * k + 1.0) * x * now - k * before) / (k + 1.0));
            k += 1.0;
        }
        let next = (29.0 * x * now - 14.0 * before) / 15.0;
        all[i] = 29.0 * now + 31.0 * next;
        i += 1;
    }
    all
}
