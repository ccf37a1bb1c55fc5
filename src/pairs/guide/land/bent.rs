//! A land of a cage in space whose ring bends in its plane.
//!
//! ```text
//! film   s F_film at the middle of the land,    s share by the smallest gap there
//! solid  (1 - s) F_solid at each slice,         each with the bent surface in its own plane across the axis
//! ```
//!
//! The laws are those of a bent cage in the plane (`laws/guide/bent`), in axes that turn with the cage. The waves are the same over the width:
//! bending out of the plane of the ring is left out. Derivatives go along one direction at a time.

use super::{Beside, Land, LandForce, longest_bent_step};
use crate::bodies::{CAGE_MOTION, MovingCage, MovingRing};
use crate::integrate::Tuning;
use crate::laws::fluid::Fluid;
use crate::laws::guide::bent::{BentForces, BentMotion, BentSurface, Wanted};
use crate::laws::guide::journal::{JournalMotion, NoFilm};
use crate::laws::guide::{GuideForce, GuideLaw};
use crate::pairs::guide::Built;
use crate::pairs::guide::side::GuideSide;
use crate::scalar::{Dual, Real, math};
use crate::scene::Scene;
use crate::space::rotate;

/// How a land acts on a bent cage.
#[derive(Debug)]
pub(super) struct BentLand {
    surface: BentSurface,
    /// Film and solid contact, each by itself.
    film: Option<GuideLaw>,
    solid: Option<GuideLaw>,
    slices: usize,
}

/// Forces of a land on a bent cage and memory for them.
#[derive(Clone, Debug)]
pub(crate) struct BentLandForces {
    film: BentForces,
    slices: Vec<BentForces>,
    share: Share,
    /// Over the waves, N: all, and those of the film.
    pub(crate) on_modes: [Vec<f64>; 2],
}

/// Share of the film.
#[derive(Clone, Copy, Debug, Default)]
struct Share {
    value: f64,
    /// Over the smallest gap, 1/m.
    slope: f64,
    /// Where that is in axes of the cage, rad.
    angle: f64,
}

/// A coordinate of the modes, or its rate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OfMode {
    pub(crate) place: usize,
    pub(crate) rate: bool,
}

/// How the cage lies and moves beside its ring, in axes of the cage.
struct Own<T> {
    position: [T; 2],
    velocity: [T; 2],
    /// Of cage and ring, rad/s.
    speeds: [T; 2],
}

impl<T: Real> Own<T> {
    fn new(side: GuideSide, motion: &JournalMotion<T>, [sin, cos]: [T; 2]) -> Self {
        let (sign, speeds) = match side {
            GuideSide::CageInside => (1.0, [motion.journal_speed, motion.bush_speed]),
            GuideSide::CageOutside => (-1.0, [motion.bush_speed, motion.journal_speed]),
        };
        let own = |v: [T; 2]| rotate(v.map(|x| x * sign), -sin, cos);
        Self { position: own(motion.position), velocity: own(motion.velocity), speeds }
    }
}

impl Own<f64> {
    fn with<'a>(&self, [amplitudes, rates]: [&'a [f64]; 2]) -> BentMotion<'a> {
        let Self { position, velocity, speeds } = *self;
        BentMotion { position, velocity, speeds, amplitudes, rates }
    }
}

/// Forces by numbers with or without derivatives.
trait Known<T> {
    /// Share of the film.
    fn share(&self, own: &Own<T>) -> T;
    /// Force over coordinate `i` of the cage: place in its own axes, angle (there the moment on the journal), waves.
    fn force(&self, forces: &BentForces, i: usize, own: &Own<T>) -> T;
}

/// As they were found.
struct AsFound(Share);

impl Known<f64> for AsFound {
    fn share(&self, _own: &Own<f64>) -> f64 {
        self.0.value
    }

    fn force(&self, forces: &BentForces, i: usize, _own: &Own<f64>) -> f64 {
        forces.all[i]
    }
}

/// With what they change by.
struct Changing<'a> {
    share: Share,
    mode: Option<OfMode>,
    surface: &'a BentSurface,
}

impl Known<Dual<1>> for Changing<'_> {
    fn share(&self, own: &Own<Dual<1>>) -> Dual<1> {
        let Share { value, slope, angle } = self.share;
        let sign = if self.surface.on_journal { 1.0 } else { -1.0 };
        let (sin, cos) = math::sin_cos(angle);
        let [y, z] = own.position;
        let mut raised = y.eps[0] * cos + z.eps[0] * sin;
        if let Some(OfMode { place, rate: false }) = self.mode {
            let (order, _) = self.surface.waves[place / 2];
            let (sin, cos) = math::sin_cos(f64::from(order) * angle);
            raised += [cos, sin][place % 2];
        }
        let [speed, _] = own.speeds;
        raised += 2.0 * self.surface.growth * speed.re * speed.eps[0];
        Dual { re: value, eps: [-sign * slope * raised] }
    }

    fn force(&self, forces: &BentForces, i: usize, own: &Own<Dual<1>>) -> Dual<1> {
        let [over_positions, over_velocities] = &forces.over;
        let mut slope = 0.0;
        for k in 0..2 {
            slope += over_positions[(i, k)] * own.position[k].eps[0];
            slope += over_velocities[(i, k)] * own.velocity[k].eps[0];
        }
        let [cage, ring] = own.speeds;
        slope += over_velocities[(i, 2)] * cage.eps[0] + forces.over_ring_speed[i] * ring.eps[0];
        if let Some(OfMode { place, rate }) = self.mode {
            slope += forces.over[usize::from(rate)][(i, CAGE_MOTION + place)];
        }
        Dual { re: forces.all[i], eps: [slope] }
    }
}

impl BentLand {
    /// That of a scene whose cage has an elastic ring, by its laws as those of a rigid one.
    pub(super) fn of(scene: &Scene, built: &Built, slices: usize) -> Option<Self> {
        let bends = scene.cage.as_ref()?.elastic_ring.as_ref()?;
        let law = &built.law;
        let surface = BentSurface::of(bends, law.radius, built.side, &built.profile);
        let film = law.film.as_ref().map(|_| GuideLaw { solid: None, ..law.clone() });
        let solid = law.solid.as_ref().map(|_| GuideLaw { film: None, ..law.clone() });
        Some(Self { surface, film, solid, slices })
    }

    pub(super) fn memory(&self) -> BentLandForces {
        let forces = || BentForces::new(&self.surface);
        let on_modes = vec![0.0; 2 * self.surface.waves.len()];
        BentLandForces {
            film: forces(),
            slices: (0..if self.solid.is_some() { self.slices } else { 0 }).map(|_| forces()).collect(),
            share: Share::default(),
            on_modes: [on_modes.clone(), on_modes],
        }
    }

    /// See [`Land::bend`].
    pub(super) fn force(
        &self,
        land: &Land,
        (cage, ring): (&MovingCage<f64>, &MovingRing<f64>),
        of_modes: [&[f64]; 2],
        (fluid, wanted): (Fluid, Wanted),
        memory: &mut BentLandForces,
    ) -> Result<LandForce<f64>, NoFilm> {
        let turned = turned_by(cage.angle);
        let at = |x: f64| Own::new(land.side, &land.beside(x, cage, ring).motion, turned);
        memory.share = self.share(land, &at(land.x).with(of_modes))?;
        if let Some(film) = self.film.as_ref().filter(|_| memory.share.value > 0.0) {
            film.bend(&self.surface, &at(land.x).with(of_modes), fluid, wanted, &mut memory.film)?;
        }
        if let Some(solid) = self.solid.as_ref().filter(|_| memory.share.value < 1.0) {
            for ([x, _], forces) in land.slices.iter().zip(&mut memory.slices) {
                solid.bend(&self.surface, &at(*x).with(of_modes), fluid, wanted, forces)?;
            }
        }
        let BentLandForces { film, slices, share, on_modes: [all, by_film] } = memory;
        Ok(self.collect(land, (cage, ring), (film, slices), &AsFound(*share), [all, by_film]))
    }

    /// See [`Land::bend_slopes`].
    pub(super) fn slopes(
        &self,
        land: &Land,
        bodies: (&MovingCage<Dual<1>>, &MovingRing<Dual<1>>),
        mode: Option<OfMode>,
        memory: &BentLandForces,
        on_modes: &mut [Dual<1>],
    ) -> LandForce<Dual<1>> {
        let known = Changing { share: memory.share, mode, surface: &self.surface };
        self.collect(land, bodies, (&memory.film, &memory.slices), &known, [on_modes, &mut []])
    }

    fn share(&self, land: &Land, motion: &BentMotion<'_>) -> Result<Share, NoFilm> {
        match (&self.film, &self.solid) {
            (Some(_), None) => Ok(Share { value: 1.0, ..Share::default() }),
            (None, _) => Ok(Share::default()),
            (Some(_), Some(_)) => {
                if land.law.is_far(&self.surface, motion) {
                    return Ok(Share { value: 1.0, ..Share::default() });
                }
                let [gap, angle] = land.law.smallest_bent_gap(&self.surface, motion);
                if gap.is_nan() {
                    return Err(NoFilm { minimum_film: gap });
                }
                let Dual { re, eps } = land.law.film_share(Dual::<1>::variable(gap, 0));
                Ok(Share { value: re, slope: eps[0], angle })
            }
        }
    }

    /// Adds film and solid contact up, on both bodies and over the modes: all, and as far as there is room those of the film.
    fn collect<T: Real>(
        &self,
        land: &Land,
        (cage, ring): (&MovingCage<T>, &MovingRing<T>),
        (film, slices): (&BentForces, &[BentForces]),
        known: &impl Known<T>,
        [on_modes, by_film]: [&mut [T]; 2],
    ) -> LandForce<T> {
        let mut out = LandForce::default();
        on_modes.fill(T::constant(0.0));
        let turned = turned_by(cage.angle);
        let middle = land.beside(land.x, cage, ring);
        let share = known.share(&Own::new(land.side, &middle.motion, turned));
        out.film_share = share;
        if self.film.is_some() && share.value() > 0.0 {
            let part = share * land.film_part;
            add(land, (film, part), known, (&middle, turned), on_modes, &mut out);
            out.by_film = out.on;
        }
        by_film.copy_from_slice(&on_modes[..by_film.len()]);
        if self.solid.is_some() && share.value() < 1.0 {
            for ([x, weight], forces) in land.slices.iter().zip(slices) {
                let part = (-share + 1.0) * *weight;
                let slice = land.beside(*x, cage, ring);
                add(land, (forces, part), known, (&slice, turned), on_modes, &mut out);
            }
        }
        out
    }

    fn motion(&self, land: &Land, motion: &JournalMotion<f64>, angle: f64) -> Own<f64> {
        Own::new(land.side, motion, turned_by(angle))
    }

    /// Smallest gap, m.
    pub(super) fn smallest_gap(
        &self,
        land: &Land,
        motion: &JournalMotion<f64>,
        angle: f64,
        of_modes: [&[f64]; 2],
    ) -> f64 {
        let own = self.motion(land, motion, angle);
        let [gap, _] = land.law.smallest_bent_gap(&self.surface, &own.with(of_modes));
        gap
    }

    /// Number of wet arcs, and the angle that they take, rad.
    pub(super) fn wet_arcs(
        &self,
        land: &Land,
        motion: &JournalMotion<f64>,
        angle: f64,
        of_modes: [&[f64]; 2],
    ) -> (u32, f64) {
        land.law.wet_arcs(&self.surface, &self.motion(land, motion, angle).with(of_modes))
    }

    /// The longest step (s) that passes no onset unseen, of a cage of this mass (kg).
    pub(super) fn longest_step(
        &self,
        land: &Land,
        motion: &JournalMotion<f64>,
        angle: f64,
        of_modes: [&[f64]; 2],
        (mass, tuning): (f64, &Tuning),
    ) -> f64 {
        let own = self.motion(land, motion, angle);
        longest_bent_step(&land.law, &self.surface, &own.with(of_modes), mass, tuning)
    }
}

/// Sine and cosine.
fn turned_by<T: Real>(angle: T) -> [T; 2] {
    let (sin, cos) = angle.sin_cos();
    [sin, cos]
}

/// Adds a part of the forces of a law at a place of the land to what acts on both bodies and over the modes.
fn add<T: Real>(
    land: &Land,
    (forces, part): (&BentForces, T),
    known: &impl Known<T>,
    (at, [sin, cos]): (&Beside<T>, [T; 2]),
    on_modes: &mut [T],
    out: &mut LandForce<T>,
) {
    let own = Own::new(land.side, &at.motion, [sin, cos]);
    let found = |i: usize| known.force(forces, i, &own) * part;
    let sign = land.sign();
    let on_cage = rotate([found(0), found(1)], sin, cos);
    land.push(on_cage.map(|f| f * sign), found(2), at, out);
    for (k, sum) in on_modes.iter_mut().enumerate() {
        *sum += found(CAGE_MOTION + k);
    }
    let GuideForce { pressure, shear, solid, .. } = forces.parts;
    for (sum, of) in out.parts.iter_mut().zip([pressure, shear, solid]) {
        let [y, z] = rotate(of.map(T::constant), sin, cos);
        *sum = [sum[0] + y * part * sign, sum[1] + z * part * sign];
    }
}
