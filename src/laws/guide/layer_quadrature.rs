//! Integrals of pressure and shear over wet arcs, for `LubricantLayer`.
//!
//! An arc is split where G = 0 and where s = s_cap. Pieces above the cap are mapped by gamma = middle - half cos(x),
//! because t_c is a square root of the distance from the place where s = s_cap. A piece is bisected into panels until a
//! Gauss rule suits: its integrand has to be analytic within the Bernstein ellipse of the panel that belongs to the
//! number of nodes. What it is singular at are the poles of the map to Sommerfeld's angle and the places where
//! `BarusFilm::coordinate` takes a given value; that value stays outside if the Chebyshev coefficients of the coordinate
//! say so, which is exact for a coordinate with one term. All places are chosen from plain values; nodes move with the
//! ends of the arc, so that derivatives are those of the integral.

use crate::laws::guide::barus_film::BarusFilm;
use crate::laws::guide::layer_gap::{Gap, Place, parts};
use crate::scalar::Real;
use crate::scalar::math;
use std::f64::consts::PI;

/// Largest s for which a piece is integrated as if the film were isoviscous.
const MILD: f64 = 0.01;
/// Bisections of one piece; reached only by states that are not finite.
const DEEPEST: u32 = 14;

/// Part of the pressure gradient in the shear stress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PressureShear {
    /// None: the stress of the sliding surfaces alone.
    Absent,
    /// The gradient within the wet arcs, but not across the jump of the pressure at their ends.
    WithinArc,
    /// The gradient with that jump, and the moment of the pressure on the lobes of a profile. Only then does the film
    /// dissipate at every motion.
    WithEdges,
}

/// Oil and surface of a land.
#[derive(Clone, Copy)]
pub(super) struct Land {
    /// eta_0, Pa s.
    pub viscosity: f64,
    /// alpha, 1/Pa.
    pub pressure_viscosity: f64,
    /// s_cap.
    pub cap: f64,
    /// R, m.
    pub radius: f64,
    /// L, m.
    pub width: f64,
    pub pressure_shear: PressureShear,
    /// Whether the pressure on lobes turns the journal.
    pub turns_lobes: bool,
}

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

/// Part of an arc in which the integrand has no kink.
#[derive(Clone, Copy)]
struct Piece {
    arc_start: f64,
    /// Whether s is so small, or the film cavitates, that only the gap matters.
    mild: bool,
    /// Whether s > s_cap; then its coordinate x is that of gamma = middle - half cos(x), else gamma itself.
    capped: bool,
    middle: f64,
    half: f64,
}

impl Piece {
    /// Angle and its rate of change at `x`.
    #[inline]
    fn at(&self, x: f64) -> (f64, f64) {
        if self.capped {
            let (sin, cos) = math::sin_cos(x);
            (self.middle - self.half * cos, self.half * sin)
        } else {
            (x, 1.0)
        }
    }
}

/// Integrator over the arcs of one state; `gap` and `plain` are the same gap with and without derivatives.
pub(super) struct Integrator<'a, T, G, P> {
    pub land: Land,
    pub gap: &'a G,
    pub plain: &'a P,
    film: BarusFilm,
    /// q_0 = -peak_scale G/h^3.
    peak_scale: f64,
    narrowness: f64,
    pub sums: Sums<T>,
}

impl<'a, T: Real, G: Gap<T>, P: Gap<f64>> Integrator<'a, T, G, P> {
    #[inline]
    pub fn new(land: Land, gap: &'a G, plain: &'a P) -> Self {
        let zero = T::constant(0.0);
        Self {
            land,
            gap,
            plain,
            film: BarusFilm { pressure_viscosity: land.pressure_viscosity, cap: land.cap },
            peak_scale: 0.75 * land.viscosity * land.width * land.width,
            narrowness: plain.narrowness(),
            sums: Sums { pressure: [zero; 2], shear: [zero; 2], moment: zero },
        }
    }

    /// Adds what the jump of the pressure at an end of a wet arc takes from the shear stress between the ends: +1 at the
    /// end of an arc and -1 at its start.
    #[inline]
    pub fn wet_end(&mut self, gamma: T, side: f64) {
        let place = self.gap.at(gamma);
        let mean = self.film.mean(self.peak(&place));
        let along = mean.pressure * place.film * (-0.5 * side * self.land.width);
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
        let mild = bound < MILD || self.plain.at(0.5 * (from + to)).opening >= 0.0;
        if mild || bound < self.film.cap {
            self.smooth(arc, from, to, mild, false);
            return;
        }
        let (plain, scale, cap) = (self.plain, self.scale(), self.film.cap);
        let over = |gamma: f64| scale * relative_pressure(&plain.at(gamma)) - cap;
        parts(over, [from, to], scan, |a, b| {
            // Not at an end: there, round-off decides on which side of the cap s lies.
            if b > a {
                self.smooth(arc, a, b, false, over(0.5 * (a + b)) > 0.0);
            }
        });
    }

    /// s for q_0 = -G/h^3.
    #[inline]
    fn scale(&self) -> f64 {
        self.peak_scale * self.land.pressure_viscosity
    }

    #[inline]
    fn smooth(&mut self, arc: &Arc<T>, from: f64, to: f64, mild: bool, capped: bool) {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let piece = Piece { arc_start: arc.start.value(), mild, capped, middle, half };
        let stretch = (arc.end - arc.start) / (arc.end.value() - arc.start.value());
        let x = if capped { [0.0, PI] } else { [from, to] };
        let mut samples = [0.0; 5];
        if !mild {
            let quarter = 0.25 * (x[1] - x[0]);
            for (i, sample) in samples.iter_mut().enumerate() {
                *sample = self.coordinate(&piece, x[0] + i as f64 * quarter);
            }
        }
        self.panels(&piece, [arc.start, stretch], x, &samples, 0);
    }

    #[inline]
    fn coordinate(&self, piece: &Piece, x: f64) -> f64 {
        let s = self.scale() * relative_pressure(&self.plain.at(piece.at(x).0));
        self.film.coordinate(s, piece.capped).0
    }

    /// Bisects until a rule suits. `map` is the start of the arc and its stretch, `samples` the coordinate at the ends,
    /// the middle and the quarters of `x`.
    fn panels(&mut self, piece: &Piece, map: [T; 2], x: [f64; 2], samples: &[f64; 5], depth: u32) {
        let (middle, half) = (0.5 * (x[0] + x[1]), 0.5 * (x[1] - x[0]));
        let (from, to) = (piece.at(x[0]).0, piece.at(x[1]).0);
        let width = to - from;
        // Larger half axis of the ellipse through a pole.
        let (far, narrow) = (PI - 0.5 * (from + to).abs(), 2.0 * self.narrowness);
        let to_pole = |d: f64| (d * d + narrow * narrow).sqrt();
        let axis = (to_pole(far - 0.5 * width) + to_pole(far + 0.5 * width)) / width;
        let limit = self.film.coordinate(0.0, piece.capped).1;
        let terms = chebyshev(samples);
        let suits = |rule: &&Rule| {
            let most = terms[1..].iter().zip(rule.growth).fold(terms[0], |sum, (c, g)| sum + c.abs() * g);
            // Written so that a NaN suits.
            let unsuited = width > rule.widest
                || (piece.capped && half > rule.widest)
                || axis < rule.growth[0]
                || (!piece.mild && most >= limit);
            !unsuited
        };
        let rule = match RULES.iter().find(suits) {
            None if depth < DEEPEST => {
                let mut parts = [
                    [samples[0], 0.0, samples[1], 0.0, samples[2]],
                    [samples[2], 0.0, samples[3], 0.0, samples[4]],
                ];
                if !piece.mild {
                    let at = |i: f64| self.coordinate(piece, x[0] + 0.25 * i * half);
                    (parts[0][1], parts[0][3]) = (at(1.0), at(3.0));
                    (parts[1][1], parts[1][3]) = (at(5.0), at(7.0));
                }
                self.panels(piece, map, [x[0], middle], &parts[0], depth + 1);
                self.panels(piece, map, [middle, x[1]], &parts[1], depth + 1);
                return;
            }
            found => found.unwrap_or(&RULES[2]),
        };
        let [start, stretch] = map;
        for (node, weight) in rule.nodes.iter().flat_map(|&(x, w)| [(-x, w), (x, w)]) {
            let (gamma, rate) = piece.at(middle + half * node);
            self.node(start + stretch * (gamma - piece.arc_start), stretch * (weight * half * rate));
        }
    }

    #[inline]
    fn peak(&self, place: &Place<T>) -> T {
        let i = place.inverse_film;
        -(place.opening * i * i * i * self.peak_scale)
    }

    #[inline]
    fn node(&mut self, gamma: T, weight: T) {
        let place = self.gap.at(gamma);
        let weight = weight * place.arc;
        let land = self.land;
        let mut along = place.sliding * place.inverse_film * (-land.radius * land.viscosity * land.width);
        if place.opening.value() < 0.0 {
            let mean = self.film.mean(self.peak(&place));
            let line = mean.pressure * weight * land.width;
            along = along * mean.viscosity * weight;
            let [cos, sin] = place.normal;
            let [y, z] = &mut self.sums.pressure;
            *y -= line * cos * land.radius;
            *z -= line * sin * land.radius;
            if land.pressure_shear != PressureShear::Absent {
                // By parts, d(h t)/dtheta = slope t - h n takes the place of the pressure gradient.
                along += line * place.slope * 0.5;
                let inward = line * place.film * 0.5;
                let [y, z] = &mut self.sums.shear;
                *y -= inward * cos;
                *z -= inward * sin;
            }
            if land.turns_lobes {
                self.sums.moment -= line * place.lobe_slope * land.radius;
            }
        } else {
            along = along * weight;
        }
        self.add_tangential(&place, along);
    }

    #[inline]
    fn add_tangential(&mut self, place: &Place<T>, along: T) {
        let [cos, sin] = place.normal;
        let [a, b] = &mut self.sums.shear;
        *a -= along * sin;
        *b += along * cos;
        self.sums.moment += along * self.land.radius;
    }
}

/// -G/h^3.
#[inline]
fn relative_pressure(p: &Place<f64>) -> f64 {
    -p.opening * p.inverse_film * p.inverse_film * p.inverse_film
}

/// Chebyshev coefficients of the quartic through five values at equal distances.
#[inline]
fn chebyshev(&[a, b, c, d, e]: &[f64; 5]) -> [f64; 5] {
    let (inner, outer) = (0.5 * (b + d) - c, 0.5 * (a + e) - c);
    let square = (16.0 * inner - outer) / 3.0;
    let fourth = outer - square;
    let (inner, outer) = (0.5 * (d - b), 0.5 * (e - a));
    let linear = (8.0 * inner - outer) / 3.0;
    let cube = outer - linear;
    [
        c + 0.5 * square + 0.375 * fourth,
        linear + 0.75 * cube,
        0.5 * (square + fourth),
        0.25 * cube,
        0.125 * fourth,
    ]
}

/// Gauss-Legendre rule on [-1, 1].
struct Rule {
    /// Widest panel, rad, at which products of five sines are integrated.
    widest: f64,
    /// Largest values of the Chebyshev polynomials of orders 1 to 4 on the ellipse in which the integrand has to be
    /// analytic; the first is also its larger half axis.
    growth: [f64; 4],
    /// Positive nodes and weights.
    nodes: &'static [(f64, f64)],
}

impl Rule {
    /// `ellipse` is the sum of the half axes.
    const fn new(widest: f64, ellipse: f64, nodes: &'static [(f64, f64)]) -> Self {
        let a = 0.5 * (ellipse + 1.0 / ellipse);
        let square = 2.0 * a * a - 1.0;
        Self { widest, growth: [a, square, a * (2.0 * square - 1.0), 2.0 * square * square - 1.0], nodes }
    }
}

const RULES: [Rule; 3] = [
    Rule::new(
        0.4,
        6.5,
        &[
            (0.238_619_186_083_196_9, 0.467_913_934_572_691_04),
            (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
            (0.932_469_514_203_152, 0.171_324_492_379_170_36),
        ],
    ),
    Rule::new(
        1.2,
        3.1,
        &[
            (0.148_874_338_981_631_22, 0.295_524_224_714_752_87),
            (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
            (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
            (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
            (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
        ],
    ),
    Rule::new(
        2.4,
        2.0,
        &[
            (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
            (0.281_603_550_779_258_9, 0.182_603_415_044_923_58),
            (0.458_016_777_657_227_37, 0.169_156_519_395_002_54),
            (0.617_876_244_402_643_8, 0.149_595_988_816_576_73),
            (0.755_404_408_355_003, 0.124_628_971_255_533_88),
            (0.865_631_202_387_831_8, 0.095_158_511_682_492_79),
            (0.944_575_023_073_232_6, 0.062_253_523_938_647_894),
            (0.989_400_934_991_649_9, 0.027_152_459_411_754_096),
        ],
    ),
];
