//! Integrals of pressure and shear over the circumference in panels of sixteen places, one block of lanes each.
//!
//! Panels lie between breaks. Beyond the cap, a piece is mapped by d = middle - half cos(x), because t_c is a square root of
//! the distance from the place where s = s_cap. A panel is halved until the last two terms of the Legendre series of the
//! pressure and of the stress through its places are small; those of a smooth function fall as a geometric series, and the
//! error of the sum is about the square of the last. Force and derivatives are sums over the same places.
//!
//! Lobes cut wet arcs into many short pieces. Two of them share a block, with eight places each; where that does not do,
//! each gets its sixteen.

use super::gap::Gap;
use super::land::{Land, OUTPUTS, VELOCITIES, over_positions, over_velocities, tangential};
use super::rule::{Rule, SIXTEEN, TWICE_EIGHT, total};
use crate::scalar::{Columns, Lanes, Numeric, Pack, WIDEST, ZEROS, dispatch, elementary};
use pulp::{Arch, Simd};
use std::f64::consts::{PI, TAU};

/// Halvings of a panel; reached only by states that are not finite.
const DEEPEST: u32 = 14;
/// Widest panel, rad.
const WIDEST_PANEL: f64 = 1.6;
/// Panels per period of the highest order of the gap, at least.
const PANELS_PER_PERIOD: f64 = 1.0;
/// Widest piece that shares a block with another, over the period of the highest order; there is none without lobes.
const NARROW: f64 = 0.2;
/// Round-off of G relative to its largest part.
const ROUND_OFF: f64 = 1e-11;

/// Which half of a block a lane is in.
const BLOCK_HALF: Lanes = {
    let mut all = ZEROS;
    let mut i = WIDEST / 2;
    while i < WIDEST {
        all[i] = 1.0;
        i += 1;
    }
    all
};

/// What is summed over the places of panels.
pub(in crate::laws::guide) trait PanelSums {
    /// Adds the film at the places of those parts of a block whose series suit, or of all where `checked` has no noise for them.
    /// Which did.
    fn add(&mut self, panel: &Panel<'_>, checked: Option<f64>, instructions: Arch) -> [bool; 2];

    /// Adds what the ends of wet arcs do: see [`Panels::complete`]. `jump` is the tangential force there over the pressure times
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

impl PanelSums for Sums<'_> {
    fn add(&mut self, panel: &Panel<'_>, checked: Option<f64>, instructions: Arch) -> [bool; 2] {
        let mut found = Found { outputs: [ZEROS; OUTPUTS], pressure: ZEROS, stress: ZEROS, cubes: ZEROS };
        dispatch(instructions, Values { land: &self.land, panel, found: &mut found });
        let suits = panel.suit([&found.pressure, &found.stress, &found.cubes], checked);
        if suits == [false; 2] {
            return suits;
        }
        let panel = &panel.only(suits, found.outputs.each_mut());
        for (sum, output) in self.values.iter_mut().zip(&found.outputs) {
            for (sum, output) in sum.iter_mut().zip(output) {
                *sum += output;
            }
        }
        if !self.slopes.is_empty() {
            dispatch(instructions, Slopes { land: &self.land, panel, slopes: self.slopes });
        }
        suits
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
    order: f64,
    /// A narrow piece that waits for another one, rad.
    waiting: Option<[f64; 2]>,
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
        Self {
            land,
            gap,
            largest_opening,
            jumps,
            instructions,
            sums,
            order: f64::from(gap.order()),
            waiting: None,
            end_angles: ZEROS,
            end_sides: ZEROS,
            end_count: 0,
        }
    }

    /// Adds the film between `from` and `to`; `capped` where s > s_cap.
    pub fn add(&mut self, from: f64, to: f64, capped: bool) {
        // Written so that a NaN leads nowhere.
        let exists = to > from;
        if !exists {
            return;
        }
        let period = TAU / self.order;
        if !capped && self.order > 1.0 && to - from < NARROW * period {
            match self.waiting.take() {
                Some(other) => self.two([other, [from, to]]),
                None => self.waiting = Some([from, to]),
            }
            return;
        }
        let piece = Piece { mapped: capped, middle: 0.5 * (from + to), half: 0.5 * (to - from) };
        let widest = WIDEST_PANEL.min(period / PANELS_PER_PERIOD);
        let panels = ((to - from) / widest).ceil().max(if capped { 2.0 } else { 1.0 });
        let (start, width) = if capped { (0.0, PI / panels) } else { (from, (to - from) / panels) };
        for i in 0..panels as usize {
            let a = start + i as f64 * width;
            self.panel(&piece, [a, a + width], 0);
        }
    }

    /// Two narrow pieces.
    fn two(&mut self, pieces: [[f64; 2]; 2]) {
        let panel = Panel::two(self.gap, pieces);
        let suits = self.sums.add(&panel, Some(self.noise()), self.instructions);
        for (piece, suits) in pieces.into_iter().zip(suits) {
            if !suits {
                self.panel(&Piece::STRAIGHT, piece, 0);
            }
        }
    }

    fn panel(&mut self, piece: &Piece, [from, to]: [f64; 2], depth: u32) {
        let panel = Panel::new(self.gap, piece, [from, to]);
        let checked = (depth < DEEPEST).then(|| self.noise());
        if self.sums.add(&panel, checked, self.instructions) != [true; 2] {
            let middle = 0.5 * (from + to);
            self.panel(piece, [from, middle], depth + 1);
            self.panel(piece, [middle, to], depth + 1);
        }
    }

    /// Round-off of the pressure times the cube of the film, N m^3.
    fn noise(&self) -> f64 {
        ROUND_OFF * self.land.area * self.land.peak_scale * self.largest_opening
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

    /// Adds what still waits.
    pub fn complete(&mut self) {
        if let Some(piece) = self.waiting.take() {
            self.panel(&Piece::STRAIGHT, piece, 0);
        }
        self.complete_ends();
    }

    /// Adds what these ends do: the jump of the pressure there, if `jumps`, and to the derivatives that they move.
    fn complete_ends(&mut self) {
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

/// Places of one panel or of two.
pub(in crate::laws::guide) struct Panel<'a> {
    pub gap: &'a Gap<'a>,
    piece: Piece,
    rule: &'static Rule,
    /// Middle and half of the width of the panel in each half of the block.
    middle: [f64; 2],
    half: [f64; 2],
}

impl<'a> Panel<'a> {
    /// One with sixteen places.
    pub fn new(gap: &'a Gap<'a>, piece: &Piece, [from, to]: [f64; 2]) -> Self {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        Self { gap, piece: *piece, rule: &SIXTEEN, middle: [middle; 2], half: [half; 2] }
    }

    /// Two with eight places each.
    fn two(gap: &'a Gap<'a>, pieces: [[f64; 2]; 2]) -> Self {
        let middle = pieces.map(|[from, to]| 0.5 * (from + to));
        let half = pieces.map(|[from, to]| 0.5 * (to - from));
        Self { gap, piece: Piece::STRAIGHT, rule: &TWICE_EIGHT, middle, half }
    }

    /// Places (rad) and their weights (rad) in the sums, of a group.
    #[inline(always)]
    pub fn places<S: Simd, const K: usize>(&self, simd: S, first: usize) -> [Pack<S, K>; 2] {
        let of_block = Pack::<S, K>::load(simd, &BLOCK_HALF[first..]).above(0.5);
        let lanes = |[a, b]: [f64; 2]| Pack::select(of_block, Pack::all(simd, b), Pack::all(simd, a));
        let half = lanes(self.half);
        let x = Pack::load(simd, &self.rule.nodes[first..]) * half + lanes(self.middle);
        let weight = Pack::load(simd, &self.rule.weights[first..]) * half;
        if !self.piece.mapped {
            return [x, weight];
        }
        let (sin, cos) = elementary::sin_cos(x);
        let Piece { middle, half, .. } = self.piece;
        [-(cos * half) + middle, weight * sin * half]
    }

    /// Whether the series of each part suit; with no noise all do.
    #[inline]
    pub fn suit(&self, series: [&Lanes; 3], noise: Option<f64>) -> [bool; 2] {
        noise.map_or([true; 2], |noise| self.rule.suits(series, noise))
    }

    /// The same, where parts that do not suit have no width, and without what was found at their places.
    #[inline]
    pub fn only<const N: usize>(&self, suits: [bool; 2], found: [&mut Lanes; N]) -> Self {
        let mut out = Self { ..*self };
        if suits != [true; 2] {
            for (part, _) in suits.iter().enumerate().filter(|(_, suits)| !**suits) {
                out.half[part] = 0.0;
            }
            for lanes in found {
                for (part, lanes) in lanes.chunks_mut(WIDEST / 2).enumerate() {
                    if !suits[part] {
                        lanes.fill(0.0);
                    }
                }
            }
        }
        out
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
