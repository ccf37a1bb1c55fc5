//! What a film or a solid contact does at the places of a panel and at the ends of wet arcs, with derivatives.

use super::surface::{Surface, SurfaceLaw};
use crate::laws::guide::circumference::panels::{Ends, Panel};
use crate::scalar::{Columns, Lanes, Numeric, Pack, WIDEST};
use pulp::Simd;

/// Derivatives whose coefficients are found, as functions of the place. First those up to the highest order of the waves, then those
/// up to twice that; of each the ones over velocities before those over positions. Where only the mean is needed, it stands with the
/// others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub(super) enum Of {
    /// Moment with that of the pressure on waves.
    MomentOverOpening,
    MomentOverSliding,
    /// Derivatives over G times h', and times the slope of what turns with the cage.
    NormalByFilmSlope,
    AlongByFilmSlope,
    InwardByFilmSlope,
    MomentByFilmSlope,
    NormalByWaveSlope,
    AlongByWaveSlope,
    InwardByWaveSlope,
    MomentByWaveSlope,
    MomentOverFilm,
    MomentOverSlope,
    /// The pressure itself, whose waves turn with the cage.
    Normal,
    NormalOverOpening,
    AlongOverOpening,
    AlongOverSliding,
    InwardOverOpening,
    NormalOverFilm,
    AlongOverFilm,
    AlongOverSlope,
    InwardOverFilm,
}

/// Numbers of functions: all, those of one order, those of one order without derivatives over positions, those without derivatives
/// over positions.
pub(super) const FUNCTIONS: usize = Of::InwardOverFilm as usize + 1;
pub(super) const SHORT: usize = Of::Normal as usize + 1;
pub(super) const SHORT_OF_VELOCITIES: usize = Of::MomentByWaveSlope as usize + 1;
pub(super) const OF_VELOCITIES: usize = Of::InwardOverOpening as usize + 1;

/// Functions at the places of a panel, times their weights.
#[derive(Clone, Debug, Default)]
#[repr(align(64))]
pub(super) struct Points {
    pub(super) normal: Lanes,
    pub(super) along: Lanes,
    pub(super) inward: Lanes,
    pub(super) moment: Lanes,
    pub(super) of: [Lanes; FUNCTIONS],
    /// Direction of each place.
    pub(super) cos: Lanes,
    pub(super) sin: Lanes,
    /// Parts of integrals that tell whether panels are fine enough, beside the pressure.
    pub(super) series: [Lanes; 2],
}

/// Finds what the forces follow from.
pub(super) struct Values<'a, L> {
    pub(super) law: &'a L,
    pub(super) panel: &'a Panel<'a>,
    pub(super) points: &'a mut Points,
}

impl<L: SurfaceLaw> Columns for Values<'_, L> {
    fn rows(&self) -> usize {
        WIDEST
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let [d, weight] = self.panel.places::<S, K>(simd, first);
        let place = self.panel.gap.at(d);
        let (surface, series) = self.law.values(&place);
        let shape = self.law.shape();
        let mut moment = surface.moment;
        if shape.turns_waves() {
            moment += surface.normal * -place.lobe_slope;
        }
        let points = &mut *self.points;
        place.cos.store(&mut points.cos[first..]);
        place.sin.store(&mut points.sin[first..]);
        (surface.normal * weight).store(&mut points.normal[first..]);
        (surface.along * weight).store(&mut points.along[first..]);
        (surface.inward * weight).store(&mut points.inward[first..]);
        (moment * weight).store(&mut points.moment[first..]);
        for (column, value) in points.series.iter_mut().zip(series) {
            (value * weight).store(&mut column[first..]);
        }
    }
}

/// Finds derivatives over `N` variables.
pub(super) struct Slopes<'a, L, const N: usize> {
    pub(super) law: &'a L,
    pub(super) panel: &'a Panel<'a>,
    pub(super) points: &'a mut Points,
}

/// Stores a function.
macro_rules! put {
    ($points:ident, $first:ident: $($of:ident = $value:expr),* $(,)?) => {
        $($value.store(&mut $points.of[Of::$of as usize][$first..]);)*
    };
}

impl<L: SurfaceLaw, const N: usize> Columns for Slopes<'_, L, N> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        WIDEST
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let [d, weight] = self.panel.places::<S, K>(simd, first);
        let place = self.panel.gap.at(d);
        let surface = self.law.slopes::<S, K, N>(&place);
        let turned = -place.lobe_slope;
        let on_waves = if self.law.shape().turns_waves() { turned } else { turned.like(0.0) };
        let points = &mut *self.points;
        let Surface { normal: n, along: t, inward: e, moment: m } = surface;
        let moment = |k: usize| (m.eps[k] + n.eps[k] * on_waves) * weight;
        let [n_g, t_g, t_u, e_g] =
            [n.eps[0] * weight, t.eps[0] * weight, t.eps[1] * weight, e.eps[0] * weight];
        let [m_g, m_u] = [moment(0), moment(1)];
        let slope = place.film[1];
        put!(points, first:
            NormalOverOpening = n_g, AlongOverOpening = t_g, AlongOverSliding = t_u, InwardOverOpening = e_g,
            MomentOverOpening = m_g, MomentOverSliding = m_u,
            NormalByFilmSlope = (n_g * slope), AlongByFilmSlope = (t_g * slope),
            InwardByFilmSlope = (e_g * slope), MomentByFilmSlope = (m_g * slope),
            NormalByWaveSlope = (n_g * turned), AlongByWaveSlope = (t_g * turned),
            InwardByWaveSlope = (e_g * turned), MomentByWaveSlope = (m_g * turned),
        );
        if N > 2 {
            let (h, slope) = (2, N - 1);
            put!(points, first:
                NormalOverFilm = (n.eps[h] * weight), AlongOverFilm = (t.eps[h] * weight),
                InwardOverFilm = (e.eps[h] * weight), AlongOverSlope = (t.eps[slope] * weight),
                MomentOverFilm = moment(h), MomentOverSlope = moment(slope), Normal = (n.re * weight),
            );
        }
    }
}

/// What the ends of wet arcs do: the jump of the pressure, and how they move.
pub(super) struct AtEnds<'a, L> {
    pub(super) law: &'a L,
    pub(super) ends: &'a Ends<'a>,
    pub(super) points: &'a mut Points,
    /// Whether derivatives are found, too.
    pub(super) slopes: bool,
}

impl<L: SurfaceLaw> Columns for AtEnds<'_, L> {
    const PAIRED: bool = false;

    fn rows(&self) -> usize {
        self.ends.count
    }

    #[inline(always)]
    fn group<S: Simd, const K: usize>(&mut self, simd: S, first: usize) {
        let Ends { gap, angles, sides, jump, .. } = self.ends;
        let side = Pack::<S, K>::load(simd, &sides[first..]);
        let place = gap.at(Pack::load(simd, &angles[first..]));
        let (of_jump, radius) = (place.film[0] * side * *jump, self.law.shape().radius);
        if !self.slopes {
            let (surface, _) = self.law.values(&place);
            let jumped = surface.normal * of_jump;
            let points = &mut *self.points;
            place.cos.store(&mut points.cos[first..]);
            place.sin.store(&mut points.sin[first..]);
            jumped.store(&mut points.along[first..]);
            (jumped * radius).store(&mut points.moment[first..]);
            return;
        }
        let surface = self.law.slopes::<S, K, 4>(&place);
        let turned = -place.lobe_slope;
        let on_waves = if self.law.shape().turns_waves() { turned } else { turned.like(0.0) };
        let Surface { normal: n, along: t, inward: e, moment: m } = surface;
        let (jumped, jumped_g) = (n.re * of_jump, n.eps[0] * of_jump);
        // How far an end moves with the film; where the arc is about to open or close, it has no derivative.
        let inverse = side.like(1.0) / place.film[1];
        let moved = -Pack::select(inverse.abs().below(1e100), inverse, side.like(0.0));
        let swept = moved * side;
        let jumped_h = jumped_g * place.opening[1] * moved;
        let points = &mut *self.points;
        place.cos.store(&mut points.cos[first..]);
        place.sin.store(&mut points.sin[first..]);
        let slope = place.film[1];
        jumped.store(&mut points.along[first..]);
        (jumped * radius).store(&mut points.moment[first..]);
        put!(points, first:
            AlongOverOpening = jumped_g, MomentOverOpening = (jumped_g * radius),
            AlongByFilmSlope = (jumped_g * slope), MomentByFilmSlope = (jumped_g * radius * slope),
            AlongByWaveSlope = (jumped_g * turned), MomentByWaveSlope = (jumped_g * radius * turned),
            NormalOverFilm = (n.re * swept), AlongOverFilm = (t.re * swept + jumped_h),
            InwardOverFilm = (e.re * swept + jumped * moved),
            MomentOverFilm = ((m.re + n.re * on_waves) * swept + jumped_h * radius),
        );
    }
}
