//! From Fourier coefficients to forces over the coordinates of a bent cage, and to their derivatives.

use super::points::Of;
use super::sums::{Found, Sums};
use super::surface::Shape;
use super::{OF_MOTION, Wanted};
use crate::scalar::math;
use nalgebra::{DMatrix, DVector, DVectorViewMut};

/// A wave as a coordinate: order, tau, and whether it is the sine.
#[derive(Clone, Copy)]
struct Coordinate {
    place: usize,
    order: isize,
    along: f64,
    sine: bool,
}

/// a cos(n phi) + b sin(n phi), for the order of its coordinate.
type Wave = [f64; 2];

impl Coordinate {
    /// `x` times its own wave.
    fn own(&self, x: f64) -> Wave {
        if self.sine { [0.0, x] } else { [x, 0.0] }
    }

    /// `x` times the derivative of its own wave over n phi.
    fn turned(&self, x: f64) -> Wave {
        if self.sine { [x, 0.0] } else { [0.0, -x] }
    }

    fn n(&self) -> f64 {
        self.order as f64
    }
}

impl Shape<'_> {
    /// The place of the cage and its waves.
    fn coordinates(&self) -> impl Iterator<Item = Coordinate> + '_ {
        let centre = std::iter::once((0, 1, -1.0));
        let waves = self.surface.waves.iter().enumerate();
        let waves = waves.map(|(k, (order, along))| (OF_MOTION + 2 * k, *order as isize, *along));
        centre.chain(waves).flat_map(|(first, order, along)| {
            [false, true].map(|sine| Coordinate { place: first + usize::from(sine), order, along, sine })
        })
    }

    /// Whether a coordinate turns with the cage: all waves but the place of the cage.
    fn turns(coordinate: &Coordinate) -> bool {
        coordinate.order > 1
    }

    /// Completes sums; writes the forces over all coordinates, times `share`, in place of the moment on the cage that on the
    /// journal.
    pub(super) fn take_forces(&self, sums: &mut Sums, share: f64, out: &mut [f64]) -> Found {
        let s = self.sign() * share;
        let waves = &self.surface.waves;
        let mut next = 0;
        let found = sums.forces(|order, [on_cosine, on_sine]| {
            let place = match order {
                1 => 0,
                _ if waves.get(next).is_some_and(|(wave, _)| *wave as usize == order) => {
                    next += 1;
                    OF_MOTION + 2 * (next - 1)
                }
                _ => return,
            };
            (out[place], out[place + 1]) = (s * on_cosine, s * on_sine);
        });
        out[2] = share * found.moment;
        found
    }

    /// Adds derivatives over positions and velocities, and over the speed of the ring, times `share`.
    pub(super) fn add_slopes(
        &self,
        sums: &Sums,
        wanted: Wanted,
        share: f64,
        [over_positions, over_velocities]: &mut [DMatrix<f64>; 2],
        over_ring_speed: &mut DVector<f64>,
    ) {
        if wanted == Wanted::Forces {
            return;
        }
        let s = self.sign();
        // What the speed of the cage does to the film by its growth, m s.
        let growing = -2.0 * s * self.surface.growth * self.motion.speeds[0];
        for row in self.coordinates() {
            let [n, t, e] = row.weights();
            let at = |function: Of, wave: Wave| mean(sums, function, row.order, wave);
            let by_film =
                at(Of::NormalByFilmSlope, n) + at(Of::AlongByFilmSlope, t) + at(Of::InwardByFilmSlope, e);
            let by_waves =
                at(Of::NormalByWaveSlope, n) + at(Of::AlongByWaveSlope, t) + at(Of::InwardByWaveSlope, e);
            let by_sliding = at(Of::AlongOverSliding, t);
            let of_ring = self.turns_film() * by_film - s * self.radius * by_sliding;
            over_ring_speed[row.place] += share * s * of_ring;
            let mut of_cage =
                self.turns_film() * by_film + self.squeeze * by_waves + s * self.radius * by_sliding;
            if wanted == Wanted::Slopes {
                let thinner =
                    at(Of::NormalOverFilm, n) + at(Of::AlongOverFilm, t) + at(Of::InwardOverFilm, e);
                of_cage += growing * thinner;
            }
            over_velocities[(row.place, 2)] += share * s * of_cage;
            for column in self.coordinates() {
                let over = |function: Of, weight: Wave, wave: Wave| {
                    product(sums, function, (row.order, weight), (column.order, wave))
                };
                let opening = column.own(-self.squeeze);
                let sliding = column.turned(-column.along);
                let velocity = over(Of::NormalOverOpening, n, opening)
                    + over(Of::AlongOverOpening, t, opening)
                    + over(Of::AlongOverSliding, t, sliding)
                    + over(Of::InwardOverOpening, e, opening);
                over_velocities[(row.place, column.place)] += share * velocity;
                if wanted < Wanted::Slopes {
                    continue;
                }
                let (film, slope) = (column.own(-1.0), column.turned(-column.n()));
                let opening = column.turned(-column.n() * self.opening_of(&column));
                let position = over(Of::NormalOverOpening, n, opening)
                    + over(Of::AlongOverOpening, t, opening)
                    + over(Of::InwardOverOpening, e, opening)
                    + over(Of::NormalOverFilm, n, film)
                    + over(Of::AlongOverFilm, t, film)
                    + over(Of::AlongOverSlope, t, slope)
                    + over(Of::InwardOverFilm, e, film);
                over_positions[(row.place, column.place)] += share * position;
            }
        }
        // The moment on the journal.
        let at = |function: Of| sums.of(function, 0)[0];
        let [by_film, by_waves] = [at(Of::MomentByFilmSlope), at(Of::MomentByWaveSlope)];
        let by_sliding = self.radius * at(Of::MomentOverSliding);
        over_ring_speed[2] += share * (self.turns_film() * by_film - s * by_sliding);
        let mut of_cage = self.turns_film() * by_film + self.squeeze * by_waves + s * by_sliding;
        if wanted == Wanted::Slopes {
            of_cage += growing * at(Of::MomentOverFilm);
        }
        over_velocities[(2, 2)] += share * of_cage;
        for column in self.coordinates() {
            let at = |function: Of, wave: Wave| mean(sums, function, column.order, wave);
            let sliding = column.turned(if self.slides { -column.along } else { 0.0 });
            let velocity =
                at(Of::MomentOverOpening, column.own(-self.squeeze)) + at(Of::MomentOverSliding, sliding);
            over_velocities[(2, column.place)] += share * s * velocity;
            if wanted < Wanted::Slopes {
                continue;
            }
            let mut position = at(Of::MomentOverFilm, column.own(-1.0))
                + at(Of::MomentOverSlope, column.turned(-column.n()))
                + at(Of::MomentOverOpening, column.turned(-column.n() * self.opening_of(&column)));
            if self.turns_waves() && Self::turns(&column) {
                position += at(Of::Normal, column.turned(column.n()));
            }
            over_positions[(2, column.place)] += share * s * position;
        }
    }

    /// Adds what `forces` do that change by `slope` times themselves per film (1/m) at the thinnest place.
    pub(super) fn add_share(
        &self,
        angle: f64,
        slope: f64,
        forces: &[f64],
        [over_positions, over_velocities]: &mut [DMatrix<f64>; 2],
    ) {
        let s = self.sign();
        let add = |factor: f64, mut column: DVectorViewMut<'_, f64>| {
            column.iter_mut().zip(forces).for_each(|(sum, force)| *sum += factor * force);
        };
        for column in self.coordinates() {
            let (sin, cos) = math::sin_cos(column.n() * angle);
            let thinner = -s * slope * if column.sine { sin } else { cos };
            add(thinner, over_positions.column_mut(column.place));
        }
        let growing = -2.0 * s * self.surface.growth * self.motion.speeds[0];
        add(growing * slope, over_velocities.column_mut(2));
    }

    /// Factor of the slope of the film in G that follows the speeds: 1, or 0 where G is the rate of the film alone.
    fn turns_film(&self) -> f64 {
        if self.wedge { 1.0 } else { 0.0 }
    }

    /// Factor of the slope of a wave in G, rad/s.
    fn opening_of(&self, column: &Coordinate) -> f64 {
        let carried = if Self::turns(column) { self.squeeze * self.motion.speeds[0] } else { 0.0 };
        self.turning - carried
    }
}

impl Coordinate {
    /// What pressure, tangential force and the part of the gradient count with in the force over it.
    fn weights(&self) -> [Wave; 3] {
        [self.own(-1.0), self.turned(-self.along), self.own(self.n() * self.along)]
    }
}

/// Integral of a function times a wave.
fn mean(sums: &Sums, function: Of, order: isize, [a, b]: Wave) -> f64 {
    let [cos, sin] = sums.of(function, order);
    a * cos + b * sin
}

/// Integral of a function times two waves.
fn product(sums: &Sums, function: Of, (n, [a, b]): (isize, Wave), (p, [c, d]): (isize, Wave)) -> f64 {
    let ([cos_less, sin_less], [cos_more, sin_more]) = (sums.of(function, n - p), sums.of(function, n + p));
    0.5 * (a * c * (cos_less + cos_more)
        + b * d * (cos_less - cos_more)
        + a * d * (sin_more - sin_less)
        + b * c * (sin_more + sin_less))
}
