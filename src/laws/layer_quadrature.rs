//! Integrals of pressure and shear over wet arcs, for `LubricantLayer`.
//!
//! An arc is split where G = 0 and where s = s_cap. Pieces with thickening, s > 0.1, are mapped by
//! gamma = middle - half cos(x), because t_c is a square root of the distance from the place where s = s_cap, and cut
//! into panels over which `BarusFilm::smoothness` changes little: the mean viscosity below the cap is nearly singular
//! at s = 1. All places are chosen from plain values; nodes move with the ends of the arc, so that derivatives are those
//! of the integral.

use super::barus_film::BarusFilm;
use super::layer_gap::{Gap, Place, change};
use super::lubricant_layer::{LubricantLayer, PressureShear};
use crate::scalar::Real;
use std::f64::consts::PI;

/// Largest s for which a piece is integrated as if the film were isoviscous.
const MILD: f64 = 0.1;
/// Widest panel, rad: below it ten nodes resolve the products of five sines that occur.
const WIDEST: f64 = 1.0;
/// Widest panel for six nodes, rad.
const NARROW: f64 = 0.3;
/// Largest ratio of `BarusFilm::smoothness` over a panel.
const ROUGHEST: f64 = 2.0;
/// Bisections of one piece; reached only by states that are not finite.
const DEEPEST: u32 = 14;

/// What a film does to the journal, in the axes of the gap.
pub(super) struct Sums<T> {
    pub pressure: [T; 2],
    pub shear: [T; 2],
    pub moment: T,
}

/// Wet arc from `start` to `end`, rad.
#[derive(Clone, Copy)]
pub(super) struct Arc<T> {
    pub start: T,
    pub end: T,
}

/// Coordinate x of a piece: the angle itself, or gamma = middle - half cos(x).
#[derive(Clone, Copy)]
enum Map {
    Angle,
    Cosine { middle: f64, half: f64, capped: bool },
}

impl Map {
    /// Angle and its rate of change at `x`.
    fn at(self, x: f64) -> (f64, f64) {
        match self {
            Self::Angle => (x, 1.0),
            Self::Cosine { middle, half, .. } => {
                let (sin, cos) = x.sin_cos();
                (middle - half * cos, half * sin)
            }
        }
    }
}

/// Integrator over the arcs of one state; `gap` and `plain` are the same gap with and without derivatives.
pub(super) struct Integrator<'a, T, G, P> {
    pub law: &'a LubricantLayer,
    pub gap: &'a G,
    pub plain: &'a P,
    film: BarusFilm,
    /// q_0 = -peak_scale G/h^3.
    peak_scale: f64,
    narrowness: f64,
    pub sums: Sums<T>,
}

impl<'a, T: Real, G: Gap<T>, P: Gap<f64>> Integrator<'a, T, G, P> {
    pub fn new(law: &'a LubricantLayer, gap: &'a G, plain: &'a P) -> Self {
        let zero = T::constant(0.0);
        Self {
            law,
            gap,
            plain,
            film: BarusFilm { pressure_viscosity: law.pressure_viscosity, cap: law.cap },
            peak_scale: 0.75 * law.viscosity * law.width * law.width,
            narrowness: plain.narrowness(),
            sums: Sums { pressure: [zero; 2], shear: [zero; 2], moment: zero },
        }
    }

    /// Adds what the jump of the pressure at an end of a wet arc takes from the shear stress between the ends: +1 at the
    /// end of an arc and -1 at its start.
    pub fn wet_end(&mut self, gamma: T, side: f64) {
        let place = self.gap.at(gamma);
        let mean = self.film.mean(self.peak(&place));
        let along = mean.pressure * place.film * (-0.5 * side * self.law.width);
        self.add_tangential(&place, along);
    }

    /// Adds an arc between the angles `from` and `to`, in which G does not change sign. `bound` is not less than the
    /// largest s there, and `scan` the number of steps in which places with s = s_cap are looked for.
    pub fn piece(&mut self, arc: &Arc<T>, from: f64, to: f64, bound: f64, scan: u32) {
        // Written so that a NaN leads nowhere.
        let exists = to > from;
        if !exists {
            return;
        }
        let under_pressure = self.plain.at(0.5 * (from + to)).opening < 0.0;
        if !under_pressure || bound < MILD {
            self.panels(arc, Map::Angle, [from, to], [0.0; 2], 0);
            return;
        }
        let step = (to - from) / f64::from(scan);
        let (mut start, mut left) = (from, from);
        let mut left_capped = self.thickening(from) > self.film.cap;
        for i in 1..=scan {
            let right = if i == scan { to } else { from + step * f64::from(i) };
            let right_capped = self.thickening(right) > self.film.cap;
            if left_capped != right_capped {
                let at = change(|g| self.thickening(g) > self.film.cap, left, right);
                self.thickened(arc, start, at);
                start = at;
            }
            (left, left_capped) = (right, right_capped);
        }
        self.thickened(arc, start, to);
    }

    /// s = alpha q_0; negative where the film cavitates.
    fn thickening(&self, gamma: f64) -> f64 {
        let p = self.plain.at(gamma);
        -p.opening * p.inverse_film.powi(3) * (self.peak_scale * self.law.pressure_viscosity)
    }

    fn smoothness(&self, gamma: f64, capped: bool) -> f64 {
        // At the very cap round-off decides on which side of it s lies; the piece knows better.
        self.film.smoothness(self.thickening(gamma).max(0.0), capped)
    }

    fn thickened(&mut self, arc: &Arc<T>, from: f64, to: f64) {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let capped = self.thickening(middle) > self.film.cap;
        let ends = [self.smoothness(from, capped), self.smoothness(to, capped)];
        self.panels(arc, Map::Cosine { middle, half, capped }, [0.0, PI], ends, 0);
    }

    /// Bisects until panels are smooth enough. `ends` is the smoothness at both ends of `x`.
    fn panels(&mut self, arc: &Arc<T>, map: Map, x: [f64; 2], ends: [f64; 2], depth: u32) {
        let [from, to] = [map.at(x[0]).0, map.at(x[1]).0];
        let far = PI - from.abs().max(to.abs());
        let singular = far.hypot(2.0 * self.narrowness);
        let mut wide = to - from > WIDEST || to - from > 2.0 * singular;
        let middle = 0.5 * (x[0] + x[1]);
        let mut at_middle = 0.0;
        if let Map::Cosine { capped, .. } = map {
            at_middle = self.smoothness(map.at(middle).0, capped);
            let least = ends[0].min(ends[1]).min(at_middle);
            let most = ends[0].max(ends[1]).max(at_middle);
            wide |= x[1] - x[0] > 1.6 || most > ROUGHEST * least;
        }
        if wide && depth < DEEPEST {
            self.panels(arc, map, [x[0], middle], [ends[0], at_middle], depth + 1);
            self.panels(arc, map, [middle, x[1]], [at_middle, ends[1]], depth + 1);
            return;
        }
        let few = matches!(map, Map::Angle) && to - from < NARROW.min(0.4 * singular);
        let rule = if few { &GAUSS_6[..] } else { &GAUSS_10[..] };
        let half = 0.5 * (x[1] - x[0]);
        let (start, length) = (arc.start.value(), arc.end.value() - arc.start.value());
        let stretch = (arc.end - arc.start) / length;
        for (node, weight) in rule.iter().flat_map(|&(x, w)| [(-x, w), (x, w)]) {
            let (gamma, rate) = map.at(middle + half * node);
            self.node(arc.start + stretch * (gamma - start), stretch * (weight * half * rate));
        }
    }

    fn peak(&self, place: &Place<T>) -> T {
        let i = place.inverse_film;
        -(place.opening * i * i * i * self.peak_scale)
    }

    fn node(&mut self, gamma: T, weight: T) {
        let place = self.gap.at(gamma);
        let weight = weight * place.arc;
        let law = self.law;
        let mut along = place.sliding * place.inverse_film * (-law.radius * law.viscosity * law.width);
        if place.opening.value() < 0.0 {
            let mean = self.film.mean(self.peak(&place));
            let line = mean.pressure * weight * law.width;
            along = along * mean.viscosity * weight;
            let [cos, sin] = place.normal;
            let [y, z] = &mut self.sums.pressure;
            *y -= line * cos * law.radius;
            *z -= line * sin * law.radius;
            if law.pressure_shear != PressureShear::Absent {
                // By parts, d(h t)/dtheta = slope t - h n takes the place of the pressure gradient.
                along += line * place.slope * 0.5;
                let inward = line * place.film * 0.5;
                let [y, z] = &mut self.sums.shear;
                *y -= inward * cos;
                *z -= inward * sin;
            }
        } else {
            along = along * weight;
        }
        self.add_tangential(&place, along);
    }

    fn add_tangential(&mut self, place: &Place<T>, along: T) {
        let [cos, sin] = place.normal;
        let [a, b] = &mut self.sums.shear;
        *a -= along * sin;
        *b += along * cos;
        self.sums.moment += along * self.law.radius;
    }
}

/// Positive nodes and weights of the Gauss-Legendre rules on [-1, 1].
const GAUSS_6: [(f64, f64); 3] = [
    (0.238_619_186_083_196_9, 0.467_913_934_572_691_04),
    (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (0.932_469_514_203_152, 0.171_324_492_379_170_36),
];
const GAUSS_10: [(f64, f64); 5] = [
    (0.148_874_338_981_631_22, 0.295_524_224_714_752_87),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
];
