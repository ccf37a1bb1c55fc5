//! What a film does at one place of the circumference, and how that changes with the motion.
//!
//! ```text
//! N = area p,   T = -drag eta u/h + N h'/2R,   inward N h/2R,   M = R T - N w'
//! ```
//!
//! per angle, with the mean pressure p and viscosity eta of the width, u = u_1 - u_2: the gradient of the pressure, integrated
//! by parts, leaves h'/2R and h/2R. All of it depends on h, h', G and u; these are linear in the motion, so derivatives are
//! those over these four, and the rows below.

use super::gap::{Gap, Place};
use crate::laws::fluid::grease::Thickening;
use crate::laws::guide::barus_film::{BarusFilm, WidthMean};
use crate::scalar::{Base, Duals, Numeric, Of, Pack};
use pulp::Simd;

/// Pressure (along, across), shear (along, across) and moment.
pub(in crate::laws::guide) const OUTPUTS: usize = 5;
/// Their derivatives are over the rates of y and z, w_1 + w_2, R (w_1 - w_2), the speed of the lobes, y and z.
pub(in crate::laws::guide) const VARIABLES: usize = 7;
/// The first of them are velocities.
pub(in crate::laws::guide) const VELOCITIES: usize = 5;

/// Oil and surfaces.
#[derive(Clone, Copy)]
pub(in crate::laws::guide) struct Land {
    pub barus: BarusFilm,
    /// q_0 = -peak_scale G/h^3, Pa s m^2.
    pub peak_scale: f64,
    /// Area per angle, m^2.
    pub area: f64,
    /// Tangential force of sliding per angle = -drag u/h, N s.
    pub drag: f64,
    /// R, m.
    pub radius: f64,
    /// Share of the gradient of the pressure in the shear of the journal: 1, or 0.
    pub gradient_force: f64,
    /// The same in its moment.
    pub gradient_moment: f64,
    /// Share of the pressure on lobes in the moment of the journal.
    pub lobe_moment: f64,
    /// What thickens the oil where it is sheared.
    pub thickening: Option<Thickening>,
}

/// What a film does per angle at one place.
#[derive(Clone, Copy)]
pub(in crate::laws::guide) struct Stress<T> {
    /// Pressure on the journal, N.
    pub normal: T,
    /// Part of the gradient of the pressure, along the normal, N.
    pub inward: T,
    /// Along the surface, N.
    pub along: T,
    /// About the centre, N m.
    pub moment: T,
}

impl<T: Numeric> Stress<T> {
    /// In axes of the gap.
    #[inline(always)]
    pub fn outputs<B: Base>(&self, cos: B, sin: B) -> [T; OUTPUTS]
    where
        T: Of<B>,
    {
        let Self { normal, inward, along, moment } = *self;
        [-(normal * cos), -(normal * sin), -(inward * cos) - along * sin, along * cos - inward * sin, moment]
    }
}

/// What the stress at a place depends on.
#[derive(Clone, Copy)]
struct Local<T> {
    film: T,
    slope: T,
    opening: T,
    sliding: T,
}

impl Land {
    /// q_0, Pa.
    #[inline(always)]
    fn peak<T: Numeric>(&self, at: &Local<T>, inverse: T) -> T {
        -(at.opening * inverse * inverse * inverse * self.peak_scale)
    }

    #[inline(always)]
    fn stress<T: Of<B>, B: Base>(
        &self,
        at: &Local<T>,
        inverse: T,
        mean: &WidthMean<T>,
        lobe_slope: B,
    ) -> Stress<T> {
        let normal = mean.pressure * self.area;
        let gradient = normal * (0.5 / self.radius);
        let slope = gradient * at.slope;
        let drag = -(mean.viscosity * at.sliding * inverse * self.drag);
        Stress {
            normal,
            inward: gradient * at.film * self.gradient_force,
            along: drag + slope * self.gradient_force,
            moment: (drag + slope * self.gradient_moment) * self.radius
                - normal * lobe_slope * self.lobe_moment,
        }
    }

    /// Stress at places, and the inverse of the film.
    #[inline(always)]
    pub fn at<B: Of<B> + Base>(&self, p: &Place<B>) -> (Stress<B>, WidthMean<B>, B) {
        let inverse = p.cos.splat(1.0) / p.film[0];
        let local = Local { film: p.film[0], slope: p.film[1], opening: p.opening[0], sliding: p.sliding };
        let factor = match &self.thickening {
            None => p.cos.splat(1.0),
            Some(law) => law.factor(local.sliding * inverse),
        };
        let mean = self.barus.mean(self.peak(&local, inverse) * factor);
        let mean = WidthMean { viscosity: mean.viscosity * factor, ..mean };
        (self.stress(&local, inverse, &mean, p.lobe_slope), mean, inverse)
    }

    /// Stress with its derivatives over opening and sliding and, if there are four, film and slope.
    #[inline(always)]
    pub fn with_slopes<S: Simd, const K: usize, const N: usize>(
        &self,
        p: &Place<Pack<S, K>>,
    ) -> Stress<Duals<N, Pack<S, K>>> {
        let [film, slope] = [p.film[0], p.film[1]];
        let local = Local {
            film: if N > 2 { Duals::variable(film, 2) } else { Duals::lift(film) },
            slope: if N > 2 { Duals::variable(slope, 3) } else { Duals::lift(slope) },
            opening: Duals::variable(p.opening[0], 0),
            sliding: Duals::variable(p.sliding, 1),
        };
        let inverse = local.film.like(1.0) / local.film;
        let mut peak = self.peak(&local, inverse);
        let mut factor = peak.like(1.0);
        if let Some(law) = &self.thickening {
            // It depends on the shear alone.
            let shear = local.sliding * inverse;
            let of_shear = law.factor(Duals::<1, Pack<S, K>>::variable(shear.re, 0));
            factor = shear.chain(of_shear.re, of_shear.eps[0]);
            peak = peak * factor;
        }
        let mean = self.barus.mean(Duals::<1, Pack<S, K>>::variable(peak.re, 0));
        let mean = WidthMean {
            pressure: peak.chain(mean.pressure.re, mean.pressure.eps[0]),
            viscosity: peak.chain(mean.viscosity.re, mean.viscosity.eps[0]),
        };
        let mean = if self.thickening.is_some() {
            WidthMean { viscosity: mean.viscosity * factor, ..mean }
        } else {
            mean
        };
        self.stress(&local, inverse, &mean, p.lobe_slope)
    }
}

/// Derivatives over velocities of what has these over opening and sliding.
#[inline(always)]
pub(in crate::laws::guide) fn over_velocities<B: Base>(
    gap: &Gap<'_>,
    p: &Place<B>,
    opening: B,
    sliding: B,
) -> [B; VELOCITIES] {
    let squeezed = opening * gap.squeeze;
    let drifting = sliding * gap.drift;
    [
        -(squeezed * p.cos + drifting * p.sin),
        drifting * p.cos - squeezed * p.sin,
        opening * p.film[1],
        sliding,
        -(squeezed * p.lobe_slope),
    ]
}

/// Derivatives over y and z of what has these over opening, film and slope.
#[inline(always)]
pub(in crate::laws::guide) fn over_positions<B: Base>(
    gap: &Gap<'_>,
    p: &Place<B>,
    opening: B,
    film: B,
    slope: B,
) -> [B; 2] {
    let turning = slope + opening * gap.turning;
    [turning * p.sin - film * p.cos, -(turning * p.cos + film * p.sin)]
}

/// Outputs of a force along the surface.
#[inline(always)]
pub(in crate::laws::guide) fn tangential<B: Base>(along: B, cos: B, sin: B, radius: f64) -> [B; OUTPUTS] {
    let zero = along.splat(0.0);
    [zero, zero, -(along * sin), along * cos, along * radius]
}
