//! Forces of a guide whose cage is bent, by virtual work over every wave of its surface.
//!
//! ```text
//! h(phi)   = C - s (Y cos phi + Z sin phi) - Sum_n H_n(phi),    H_n = s (A_n cos n phi + B_n sin n phi)
//! u_t(phi) = Sum_n tau_n (A_n sin n phi - B_n cos n phi)         along the surface
//! Q_A  = s Int [-N cos n phi + T tau_n sin n phi + E n tau_n cos n phi] dphi
//! Q_B  = s Int [-N sin n phi - T tau_n cos n phi + E n tau_n sin n phi] dphi
//! M    = Int R T dphi + Int N w' dphi                            on the journal
//! ```
//!
//! phi is the angle in axes of the cage, s = 1 where it is the journal and -1 where it is the bush, N the pressure, T the
//! tangential force and E = N h/2R the part of the pressure gradient that integration by parts leaves, all per angle. The place
//! (Y, Z) of the cage is a wave of order one with tau_1 = -1, so its force comes from the same sums. With N, T, E and their
//! derivatives over h, h', G and the sliding speed known around the circle, every force is one of their Fourier coefficients, and
//! every derivative a sum of two: the product of two waves is one of the sum of their orders and one of the difference.
//!
//! The solid contact is spread along the surface, k_s (h_a - h) and its damping and friction per angle, which is continuous where
//! contacts merge and works against nothing but its damper and its friction: k_s = 3/4 sqrt(C/2d) k, so that a round cage that
//! touches at the depth d is pushed back by k d. d is an assumption. The share of the film follows from the smallest gap.

mod moments;
mod points;
mod sums;
mod surface;

use crate::laws::elastic::solid::SolidContact;
use crate::laws::fluid::Fluid;
use crate::laws::guide::circumference::Film;
use crate::laws::guide::circumference::breaks::Search;
use crate::laws::guide::circumference::gap::{Gap, Harmonics, Lobe};
use crate::laws::guide::circumference::panels::Panels;
use crate::laws::guide::circumference::samples::{Memory, Row, Table, with_memory};
use crate::laws::guide::circumference::stretch::Aims;
use crate::laws::guide::journal::{Harmonic, NoFilm};
use crate::laws::guide::{GuideFilm, GuideForce, GuideLaw, GuideSolid};
use crate::scalar::{Dual, Real, math};
use nalgebra::{DMatrix, DVector};
use pulp::Arch;
use std::f64::consts::TAU;
use sums::Sums;
use surface::{FilmSurface, Shape, SolidSurface};

/// Coordinates of the motion of the whole cage in front of those of its waves: place (y, z) and angle.
pub const OF_MOTION: usize = 3;

/// The guided surface of a cage that bends.
#[derive(Clone, Debug, PartialEq)]
pub struct BentSurface {
    /// Order and tau of each wave, in ascending order.
    pub waves: Vec<(u32, f64)>,
    /// Fixed lobes, as the film sees them.
    pub profile: Vec<Harmonic>,
    /// Whether it is that of the journal.
    pub on_journal: bool,
    /// g_c: growth of the radius with the square of the speed, m s^2.
    pub growth: f64,
    /// d, depth at which the solid contact of a round cage is as stiff as a point contact, m.
    pub contact_depth: f64,
}

/// Motion of a bent cage in its guide, in axes of the cage.
#[derive(Clone, Copy, Debug)]
pub struct BentMotion<'a> {
    /// Centre of the cage seen from that of the ring, m.
    pub position: [f64; 2],
    /// Its velocity in these axes, m/s.
    pub velocity: [f64; 2],
    /// Speed of the cage and of the ring, rad/s.
    pub speeds: [f64; 2],
    /// A and B of each wave, m.
    pub amplitudes: &'a [f64],
    /// Their rates, m/s.
    pub rates: &'a [f64],
}

/// What is to be found beside forces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Wanted {
    /// Nothing.
    Forces,
    /// Derivatives over velocities.
    Damping,
    /// All derivatives.
    Slopes,
}

/// Forces of a guide on a bent cage in axes of the cage, over its place, its angle and its waves. Memory is taken once.
#[derive(Clone, Debug)]
pub struct BentForces {
    /// All, N and N m. Instead of the moment on the cage, that on the journal.
    pub all: Vec<f64>,
    /// Those of the film.
    pub film: Vec<f64>,
    /// Those of the solid contact.
    solid: Vec<f64>,
    /// Forces by their parts in axes of the cage, as they act on the journal.
    pub parts: GuideForce<f64>,
    /// Derivatives of `all` over place, angle and waves (place in axes of the cage, so nothing over the angle), and over their
    /// rates.
    pub over: [DMatrix<f64>; 2],
    /// Derivative over the speed of the ring.
    pub over_ring_speed: DVector<f64>,
    lobes: Vec<Lobe>,
    harmonics: Vec<Harmonics>,
    table: Table,
    rows: Vec<Row>,
    sums: Sums,
}

impl BentSurface {
    /// s.
    fn sign(&self) -> f64 {
        if self.on_journal { 1.0 } else { -1.0 }
    }

    /// What `gap` is by its lobes, in orders: the first of them is the place of the cage, the others turn with it.
    fn find_harmonics(&self, gap: &Gap<'_>, motion: &BentMotion<'_>, out: &mut Vec<Harmonics>) {
        out.clear();
        out.resize(gap.order() as usize, Harmonics::default());
        // The place of the cage is a lobe here.
        out[0] = gap.first_harmonic();
        for lobe in gap.lobes {
            let (of, more) = (&mut out[lobe.order as usize - 1], gap.harmonic_of(lobe));
            for k in 0..2 {
                of.film[k] += more.film[k];
                of.opening[k] += more.opening[k];
            }
        }
        let s = self.sign();
        for ((order, along), rate) in self.waves.iter().zip(motion.rates.as_chunks::<2>().0) {
            let [a_rate, b_rate] = *rate;
            let of = &mut out[*order as usize - 1];
            of.sliding[0] -= s * along * b_rate;
            of.sliding[1] += s * along * a_rate;
        }
        for of in out {
            of.still = [of.film, of.opening, of.sliding] == [[0.0; 2]; 3];
        }
    }
}

impl BentForces {
    /// Memory for a surface.
    pub fn new(surface: &BentSurface) -> Self {
        let profile = &surface.profile;
        let width = OF_MOTION + 2 * surface.waves.len();
        let order = surface.waves.iter().map(|(order, _)| *order).max().unwrap_or(1);
        let order = profile.iter().map(|lobe| lobe.order).fold(order, u32::max);
        let table = Table::new(order);
        Self {
            all: vec![0.0; width],
            film: vec![0.0; width],
            solid: vec![0.0; width],
            parts: GuideForce::default(),
            over: [DMatrix::zeros(width, width), DMatrix::zeros(width, width)],
            over_ring_speed: DVector::zeros(width),
            lobes: Vec::with_capacity(1 + surface.waves.len() + profile.len()),
            harmonics: Vec::with_capacity(order as usize),
            rows: table.rows(),
            table,
            sums: Sums::new(surface),
        }
    }

    fn clear(&mut self, wanted: Wanted) {
        self.all.fill(0.0);
        self.film.fill(0.0);
        self.solid.fill(0.0);
        self.parts = GuideForce::default();
        if wanted == Wanted::Forces {
            return;
        }
        self.over.iter_mut().for_each(|part| part.fill(0.0));
        self.over_ring_speed.fill(0.0);
    }
}

/// The smallest gap and where it is, m and rad.
#[derive(Clone, Copy, Debug)]
struct Thinnest {
    gap: f64,
    angle: f64,
}

impl GuideLaw {
    /// Forces on a bent cage.
    ///
    /// # Errors
    /// [`NoFilm`] for a film without solid contact that is gone somewhere.
    pub fn bend(
        &self,
        surface: &BentSurface,
        motion: &BentMotion<'_>,
        fluid: Fluid,
        wanted: Wanted,
        out: &mut BentForces,
    ) -> Result<(), NoFilm> {
        out.clear(wanted);
        let mut lobes = std::mem::take(&mut out.lobes);
        self.find_lobes(surface, motion, &mut lobes);
        let gap = self.gap(surface, motion, &lobes);
        let shape = Shape {
            surface,
            motion,
            radius: self.radius,
            squeeze: 2.0,
            turning: gap.turning,
            wedge: true,
            slides: true,
        };
        let found = self.bend_gap(&gap, &shape, fluid, wanted, out);
        out.lobes = lobes;
        found
    }

    /// Whether no place of a bent cage is so near that film and solid contact share, or the latter touches, by the heights of all waves.
    pub fn is_far(&self, surface: &BentSurface, motion: &BentMotion<'_>) -> bool {
        let [y, z] = motion.position;
        let waves: f64 = motion.amplitudes.as_chunks::<2>().0.iter().map(|[a, b]| math::hypot(*a, *b)).sum();
        let lobes: f64 = surface.profile.iter().map(|lobe| lobe.amplitude.abs()).sum();
        let grown = surface.growth * motion.speeds[0] * motion.speeds[0];
        self.clearance - math::hypot(y, z) - waves - lobes - grown > self.onset()
    }

    /// The smallest gap of a bent cage, m, and where it is in axes of the cage, rad.
    pub fn smallest_bent_gap(&self, surface: &BentSurface, motion: &BentMotion<'_>) -> [f64; 2] {
        let mut lobes = Vec::with_capacity(surface.waves.len() + 8);
        self.find_lobes(surface, motion, &mut lobes);
        let Thinnest { gap, angle } = thinnest(&self.gap(surface, motion, &lobes), Arch::new());
        [gap, angle]
    }

    /// Number of wet arcs of a bent cage, and the angle that all of them take, rad; a guide full of oil is one.
    pub fn wet_arcs(&self, surface: &BentSurface, motion: &BentMotion<'_>) -> (u32, f64) {
        let Some(GuideFilm::LubricantLayer(layer)) = &self.film else {
            return if self.film.is_some() { (1, TAU) } else { (0, 0.0) };
        };
        let mut lobes = Vec::with_capacity(surface.waves.len() + 8);
        self.find_lobes(surface, motion, &mut lobes);
        let gap = self.gap(surface, motion, &lobes);
        with_memory(gap.order(), |memory| {
            Search::new(&gap, layer.thickness, Aims::Edges, Arch::new(), memory).wet_arcs()
        })
    }

    /// Lobes of the gap: the place of the cage, its waves, its fixed profile.
    fn find_lobes(&self, surface: &BentSurface, motion: &BentMotion<'_>, out: &mut Vec<Lobe>) {
        let s = surface.sign();
        let ([y, z], [speed, _]) = (motion.position, motion.speeds);
        out.clear();
        // The place does not turn with the cage: its rate takes back what the gap makes of its turning.
        let rate = [s * speed * z, -s * speed * y];
        out.push(Lobe { order: 1, height: [s * y, s * z], rate });
        for (k, (order, _)) in surface.waves.iter().enumerate() {
            let at = |x: &[f64]| [s * x[2 * k], s * x[2 * k + 1]];
            out.push(Lobe { order: *order, height: at(motion.amplitudes), rate: at(motion.rates) });
        }
        out.extend(surface.profile.iter().map(|harmonic| Lobe::of(harmonic, 0.0)));
    }

    fn gap<'a>(&self, surface: &BentSurface, motion: &BentMotion<'_>, lobes: &'a [Lobe]) -> Gap<'a> {
        let s = surface.sign();
        let [cage, ring] = motion.speeds;
        Gap {
            eccentricity: 0.0,
            thinnest: self.clearance - s * surface.growth * cage * cage,
            velocity: motion.velocity.map(|v| s * v),
            turning: cage + ring,
            rolling: s * self.radius * (cage - ring),
            lobe_speed: cage,
            squeeze: 2.0,
            drift: 1.0,
            lobes,
            harmonics: &[],
        }
    }

    /// Film, solid contact and their shares.
    fn bend_gap(
        &self,
        gap: &Gap<'_>,
        shape: &Shape<'_>,
        fluid: Fluid,
        wanted: Wanted,
        out: &mut BentForces,
    ) -> Result<(), NoFilm> {
        let instructions = Arch::new();
        let least = match &self.film {
            Some(film) => self.sum_film(&film.around(fluid), gap, shape, wanted, out),
            None => Ok(f64::NAN),
        };
        // Written so that a NaN is looked at. A film that is gone leaves the gap to the solid contact.
        let far = least.is_ok_and(|least| least > self.onset());
        let smallest = (self.solid.is_some() && !far).then(|| thinnest(gap, instructions));
        let share = match (&self.film, smallest) {
            (Some(_), Some(smallest)) => self.film_share(Dual::<1>::variable(smallest.gap, 0)),
            (Some(_), None) => Dual::constant(1.0),
            (None, _) => Dual::constant(0.0),
        };
        if share.re > 0.0 {
            least?;
            self.take_film(shape, wanted, share.re, out);
        }
        if let (Some(solid), Some(smallest)) = (&self.solid, smallest) {
            if smallest.gap.is_nan() {
                return Err(NoFilm { minimum_film: smallest.gap });
            }
            if wanted == Wanted::Slopes && share.eps[0] != 0.0 && share.re > 0.0 {
                shape.add_share(smallest.angle, share.eps[0] / share.re, &out.film, &mut out.over);
            }
            if smallest.gap < solid.asperity_height && share.re < 1.0 {
                self.bend_solid(solid, gap, shape, wanted, [1.0 - share.re, share.eps[0]], smallest, out);
            }
        }
        out.parts.film_share = share.re;
        Ok(())
    }

    /// Smallest gap below which film and solid contact share, or the latter touches, m.
    fn onset(&self) -> f64 {
        let height = self.solid.as_ref().map_or(0.0, |solid| solid.asperity_height);
        height.max(self.roughness * self.touching_ratio.max(super::FULL_SHARE))
    }

    /// Sums over the film. Returns what no gap is less than, m.
    fn sum_film(
        &self,
        film: &Film<'_>,
        gap: &Gap<'_>,
        shape: &Shape<'_>,
        wanted: Wanted,
        out: &mut BentForces,
    ) -> Result<f64, NoFilm> {
        let squeeze = self.film.as_ref().map_or(0.0, GuideFilm::squeeze);
        let gap = Gap { squeeze, ..*gap };
        let mut harmonics = std::mem::take(&mut out.harmonics);
        shape.surface.find_harmonics(&gap, shape.motion, &mut harmonics);
        let gap = Gap { harmonics: &harmonics, ..gap };
        let shape = Shape { squeeze, ..*shape };
        let [_, largest_opening] = gap.bounds();
        let surface = FilmSurface { land: film.land, drags: film.drags, rolling: gap.rolling, shape: &shape };
        let step = out.table.step();
        let mut sum = |aims: Aims| {
            out.sums.begin(wanted);
            let sums = out.sums.over(&surface);
            let (land, instructions) = (film.land, film.instructions);
            let jumps = film.within_arc;
            let mut panels = Panels::new(land, &gap, largest_opening, jumps, instructions, sums);
            film.integrate_with(&mut panels, aims, Memory { rows: &mut out.rows, table: Some(&out.table) })
        };
        let curvature: f64 = gap.lobes.iter().map(Lobe::curvature).sum();
        let least = sum(Aims::Edges).map(|lowest| lowest - 0.125 * curvature * step * step);
        // Pressures above the cap are rare: most films are summed once.
        let excess = least.ok().and_then(|least| film.excess(least, largest_opening));
        let summed = excess.map_or(Ok(0.0), |excess| sum(Aims::EdgesAndExcess(excess)));
        out.harmonics = harmonics;
        summed.and(least)
    }

    /// Takes the forces of the film that was summed last, times its share.
    fn take_film(&self, shape: &Shape<'_>, wanted: Wanted, share: f64, out: &mut BentForces) {
        let squeeze = self.film.as_ref().map_or(0.0, GuideFilm::squeeze);
        let slides = !matches!(self.film, Some(GuideFilm::ShortBearing(_)));
        let shape = Shape { squeeze, slides, ..*shape };
        let found = shape.take_forces(&mut out.sums, share, &mut out.film);
        out.parts.pressure = found.pressure.map(|f| f * share);
        out.parts.shear = found.shear.map(|f| f * share);
        out.parts.film_moment = found.moment * share;
        out.parts.moment += found.moment * share;
        out.all.iter_mut().zip(&out.film).for_each(|(sum, force)| *sum += force);
        shape.add_slopes(&out.sums, wanted, share, &mut out.over, &mut out.over_ring_speed);
    }

    #[expect(clippy::too_many_arguments, reason = "what is known of the state")]
    fn bend_solid(
        &self,
        solid: &GuideSolid,
        gap: &Gap<'_>,
        shape: &Shape<'_>,
        wanted: Wanted,
        [share, film_share_slope]: [f64; 2],
        smallest: Thinnest,
        out: &mut BentForces,
    ) {
        // Its opening is the rate of the gap at a fixed place.
        let gap = Gap { turning: 0.0, squeeze: 1.0, ..*gap };
        let mut harmonics = std::mem::take(&mut out.harmonics);
        shape.surface.find_harmonics(&gap, shape.motion, &mut harmonics);
        let gap = Gap { harmonics: &harmonics, ..gap };
        let shape = Shape { squeeze: 1.0, turning: 0.0, wedge: false, ..*shape };
        let spread = 0.75 * (self.free_clearance / (2.0 * shape.surface.contact_depth)).sqrt();
        let SolidContact { stiffness, damping, .. } = solid.contact;
        let contact =
            SolidContact { stiffness: stiffness * spread, damping: damping * spread, ..solid.contact };
        let surface = SolidSurface {
            contact,
            asperity_height: solid.asperity_height,
            radius: self.radius,
            shape: &shape,
        };
        let instructions = Arch::new();
        let memory = Memory { rows: &mut out.rows, table: Some(&out.table) };
        let search = Search::new(&gap, solid.asperity_height, Aims::Edges, instructions, memory);
        out.sums.begin(wanted);
        search.over_wet(|from, to| out.sums.add_pieces(&surface, &gap, from, to, instructions));
        out.harmonics = harmonics;
        let found = shape.take_forces(&mut out.sums, share, &mut out.solid);
        out.parts.solid = [0, 1].map(|k| (found.pressure[k] + found.shear[k]) * share);
        out.parts.moment += found.moment * share;
        out.all.iter_mut().zip(&out.solid).for_each(|(sum, force)| *sum += force);
        shape.add_slopes(&out.sums, wanted, share, &mut out.over, &mut out.over_ring_speed);
        if wanted == Wanted::Slopes && film_share_slope != 0.0 {
            shape.add_share(smallest.angle, -film_share_slope / share, &out.solid, &mut out.over);
        }
    }
}

/// The smallest gap.
fn thinnest(gap: &Gap<'_>, instructions: Arch) -> Thinnest {
    let [gap, angle] = gap.smallest(instructions);
    Thinnest { gap, angle }
}

#[cfg(test)]
mod tests;
