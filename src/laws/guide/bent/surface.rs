//! A bent surface as it moves, and what a film and a solid contact do at each place of it.

use super::{BentMotion, BentSurface};
use crate::laws::contact_pair::ContactMotion;
use crate::laws::elastic::solid::SolidContact;
use crate::laws::guide::circumference::gap::Place;
use crate::laws::guide::circumference::land::Land;
use crate::scalar::{Base, Duals, Numeric, Pack};
use pulp::Simd;

/// A bent surface as it moves.
#[derive(Clone, Copy)]
pub(super) struct Shape<'a> {
    pub surface: &'a BentSurface,
    pub motion: &'a BentMotion<'a>,
    /// R, m.
    pub radius: f64,
    /// Factor of dh/dt in G.
    pub squeeze: f64,
    /// w_1 + w_2 in G, rad/s.
    pub turning: f64,
    /// Whether they are in it at all.
    pub wedge: bool,
    /// Whether the moment sees how the surfaces slide, and not only how they turn.
    pub slides: bool,
}

impl Shape<'_> {
    /// s.
    pub(super) fn sign(&self) -> f64 {
        self.surface.sign()
    }

    /// Whether pressure on the waves turns the journal.
    pub(super) fn turns_waves(&self) -> bool {
        self.surface.on_journal
    }
}

/// What a surface does at one place, per angle.
#[derive(Clone, Copy)]
pub(super) struct Surface<T> {
    /// Pressure on the journal, N.
    pub normal: T,
    /// Tangential force, N.
    pub along: T,
    /// What integration by parts leaves of the gradient of the pressure, N.
    pub inward: T,
    /// Moment about the centre of the journal without that of the pressure on waves, N m.
    pub moment: T,
}

/// A law of the gap that acts at every place by itself.
pub(super) trait SurfaceLaw {
    /// What it does at these places, and what tells beside the pressure whether panels are fine enough: the stress, and the cube
    /// of the inverse of the film, which round-off of the pressure goes with.
    fn values<S: Simd, const K: usize>(
        &self,
        place: &Place<Pack<S, K>>,
    ) -> (Surface<Pack<S, K>>, [Pack<S, K>; 2]);

    /// The same with derivatives over G and the sliding speed and, if there are four, h and h'.
    fn slopes<S: Simd, const K: usize, const N: usize>(
        &self,
        place: &Place<Pack<S, K>>,
    ) -> Surface<Duals<N, Pack<S, K>>>;

    /// The shape of the surface.
    fn shape(&self) -> &Shape<'_>;
}

/// A film.
pub(super) struct FilmSurface<'a> {
    pub land: Land,
    pub drags: bool,
    /// R (w_1 - w_2), which is what a drag sees that does not push, m/s.
    pub rolling: f64,
    pub shape: &'a Shape<'a>,
}

impl FilmSurface<'_> {
    /// What a drag that does not push sees of a place.
    #[inline(always)]
    fn seen<B: Base>(&self, place: &Place<B>) -> Place<B> {
        let sliding = if self.drags { place.sliding } else { place.sliding.splat(self.rolling) };
        Place { sliding, ..*place }
    }
}

impl SurfaceLaw for FilmSurface<'_> {
    #[inline(always)]
    fn values<S: Simd, const K: usize>(
        &self,
        place: &Place<Pack<S, K>>,
    ) -> (Surface<Pack<S, K>>, [Pack<S, K>; 2]) {
        let (stress, mean, inverse) = self.land.at(&self.seen(place));
        let along = if self.drags { stress.along } else { place.cos.like(0.0) };
        let surface = Surface { normal: stress.normal, along, inward: stress.inward, moment: stress.moment };
        (surface, [mean.viscosity * inverse, inverse * inverse * inverse])
    }

    #[inline(always)]
    fn slopes<S: Simd, const K: usize, const N: usize>(
        &self,
        place: &Place<Pack<S, K>>,
    ) -> Surface<Duals<N, Pack<S, K>>> {
        let stress = self.land.with_slopes::<S, K, N>(&self.seen(place));
        let along = if self.drags { stress.along } else { stress.along.like(0.0) };
        Surface { normal: stress.normal, along, inward: stress.inward, moment: stress.moment }
    }

    #[inline(always)]
    fn shape(&self) -> &Shape<'_> {
        self.shape
    }
}

/// A solid contact that is spread along the surface.
pub(super) struct SolidSurface<'a> {
    pub contact: SolidContact,
    pub asperity_height: f64,
    pub radius: f64,
    pub shape: &'a Shape<'a>,
}

impl SurfaceLaw for SolidSurface<'_> {
    #[inline(always)]
    fn values<S: Simd, const K: usize>(
        &self,
        place: &Place<Pack<S, K>>,
    ) -> (Surface<Pack<S, K>>, [Pack<S, K>; 2]) {
        let force = self.contact.force(&ContactMotion {
            delta: -place.film[0] + self.asperity_height,
            delta_dot: -place.opening[0],
            u1: place.sliding,
            u2: place.sliding.like(0.0),
        });
        let zero = force.normal.like(0.0);
        let moment = force.friction * self.radius;
        let series = [force.normal, zero];
        (Surface { normal: force.normal, along: force.friction, inward: zero, moment }, series)
    }

    #[inline(always)]
    fn slopes<S: Simd, const K: usize, const N: usize>(
        &self,
        place: &Place<Pack<S, K>>,
    ) -> Surface<Duals<N, Pack<S, K>>> {
        let film = place.film[0];
        let film = if N > 2 { Duals::variable(film, 2) } else { Duals::lift(film) };
        let opening = Duals::<N, Pack<S, K>>::variable(place.opening[0], 0);
        let sliding = Duals::variable(place.sliding, 1);
        let force = self.contact.force(&ContactMotion {
            delta: -film + self.asperity_height,
            delta_dot: -opening,
            u1: sliding,
            u2: sliding.like(0.0),
        });
        let moment = force.friction * self.radius;
        Surface { normal: force.normal, along: force.friction, inward: moment.like(0.0), moment }
    }

    #[inline(always)]
    fn shape(&self) -> &Shape<'_> {
        self.shape
    }
}
