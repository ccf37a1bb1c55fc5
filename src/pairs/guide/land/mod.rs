//! A land of a cage that moves in space: the guide's planar laws at a place along the axis.
//!
//! ```text
//! P = cage + x_L u   middle of the land on the axis u of the cage;   Q = ring + x_r u_ring, x_r = (P - ring)_x/u_ring,x    the ring's beside it
//! the journal is the cage's P in the outer ring, or the inner ring's Q in the cage; motion and force are those across x
//! force (0, F_y, F_z) and couple M e_x on the journal at its place, the opposite on the bush there
//! ```
//!
//! The solid contact acts in slices over the width, each at its own P and Q with its share, so that with a tilt the edges touch first; the share of
//! the film is that of the middle. Valid while the tilt over half of the width is much less than the gap: the film of a tilted land has no
//! moment about its own middle, and errors of the order of the square of the tilt are left out of directions.

mod bent;

pub(crate) use bent::{BentLandForces, OfMode};

use super::longest_step::{CagePlace, longest_bent_step, longest_step};
use super::side::{GuideSide, JournalDual};
use super::{Built, laws_of, lift};
use crate::bodies::{MovingCage, MovingRing};
use crate::error::Result;
use crate::integrate::Tuning;
use crate::laws::fluid::Fluid;
use crate::laws::guide::bent::Wanted;
use crate::laws::guide::journal::{JournalMotion, NoFilm};
use crate::laws::guide::{GuideFilm, GuideForce, GuideLaw};
use crate::laws::traction::ellipse::legendre;
use crate::pairs::Law;
use crate::pairs::line_laws::LawBuilder;
use crate::scalar::{Dual, Real, math};
use crate::scene::{self, Scene};
use crate::space::solid::{Vector, cross, difference, scaled, sum};
use bent::BentLand;

/// A land.
#[derive(Debug)]
pub(crate) struct Land {
    /// How it acts on a cage that bends.
    bent: Option<BentLand>,
    /// x_L, m.
    x: f64,
    law: GuideLaw,
    side: GuideSide,
    /// Its ring: 0 the outer one, 1 the inner one.
    pub(crate) ring: usize,
    /// Part of the film of the law that is that of this land.
    film_part: f64,
    /// Places (m) on the axis of the cage, and shares, of slices of the solid contact.
    slices: Vec<[f64; 2]>,
    /// Half of its width, m; zero where it is not known.
    half_width: f64,
    /// Of its film in the scene.
    path: String,
}

/// Force, N, and moment about the centre, N m, on a body.
pub(crate) type OnBody<T> = [Vector<T>; 2];

/// What a land does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LandForce<T> {
    /// On cage and ring.
    pub(crate) on: [OnBody<T>; 2],
    /// The part of the film.
    pub(crate) by_film: [OnBody<T>; 2],
    /// Across the axis of the bearing on the cage: of pressure, shear and solid contact, N.
    pub(crate) parts: [[T; 2]; 3],
    /// Share of the film.
    pub(crate) film_share: T,
}

impl<T: Real> Default for LandForce<T> {
    fn default() -> Self {
        let zero = T::constant(0.0);
        let none = [[[zero; 3]; 2]; 2];
        Self { on: none, by_film: none, parts: [[zero; 2]; 3], film_share: zero }
    }
}

/// Width of the film of a guide, m.
fn width_of(guide: &scene::Guide) -> Option<f64> {
    match guide.film.as_ref()? {
        scene::GuideFilm::ShortBearing(film) => Some(film.land_width),
        scene::GuideFilm::LubricantLayer(film) => Some(film.land_width),
    }
}

/// How the middles of cage and ring lie in a plane across the axis.
struct Beside<T> {
    motion: JournalMotion<T>,
    /// Of the journal from the centres of cage and ring, m.
    levers: [Vector<T>; 2],
}

impl Land {
    /// All lands of a scene: its guide in the middle, and those of a cage in space.
    pub(crate) fn all(scene: &Scene, viscosity: Option<f64>) -> Result<Vec<Self>> {
        let Some(cage) = &scene.cage else { return Ok(Vec::new()) };
        let builder = LawBuilder::new(scene, viscosity);
        let middle = cage.guide.iter().map(|guide| {
            let path = "cage.guide.film";
            let built = laws_of(&builder.at(path), guide)?;
            let half_width = 0.5 * width_of(guide).unwrap_or(0.0);
            Ok(Self::new(scene, 0.0, built, 1.0, vec![[0.0, 1.0]], half_width, path.to_owned()))
        });
        let lands = cage.space.iter().flat_map(|space| space.lands.iter().enumerate()).map(|(k, land)| {
            let path = format!("cage.space.lands[{k}].guide.film");
            let built = laws_of(&builder.at(&path), &land.guide)?;
            let of_two = matches!(land.guide.film, Some(scene::GuideFilm::ShortBearing(_)));
            let film_part = if of_two { 0.5 } else { 1.0 };
            let half = 0.5 * land.width.or_else(|| width_of(&land.guide)).unwrap_or(0.0);
            let count = if half > 0.0 { land.slices as usize } else { 1 };
            let slices =
                legendre(count).into_iter().map(|[at, weight]| [land.x + half * at, 0.5 * weight]).collect();
            Ok(Self::new(scene, land.x, built, film_part, slices, half, path))
        });
        middle.chain(lands).collect()
    }

    fn new(
        scene: &Scene,
        x: f64,
        built: Built,
        film_part: f64,
        slices: Vec<[f64; 2]>,
        half_width: f64,
        path: String,
    ) -> Self {
        let bent = BentLand::of(scene, &built, slices.len());
        let ring = usize::from(built.side == GuideSide::CageOutside);
        Self { bent, x, law: built.law, side: built.side, ring, film_part, slices, half_width, path }
    }

    /// Memory for its forces on a cage that bends.
    pub(crate) fn memory(&self) -> Option<BentLandForces> {
        self.bent.as_ref().map(BentLand::memory)
    }

    /// C, radial clearance, m.
    pub(crate) fn clearance(&self) -> f64 {
        self.law.clearance
    }

    /// Whether it is off the middle of the cage.
    pub(crate) fn off_middle(&self) -> bool {
        self.x != 0.0
    }

    /// Laws of film and solid contact, where it has them.
    pub(crate) fn laws(&self) -> [Option<Law>; 2] {
        [self.law.film.as_ref().map(|_| Law::GuideFilm), self.law.solid.as_ref().map(|_| Law::GuideSolid)]
    }

    /// The laws that it has.
    pub(crate) fn laws_listed(&self) -> impl Iterator<Item = Law> {
        self.laws().into_iter().flatten()
    }

    /// Whether its film has a shear force of its own.
    pub(crate) fn shears(&self) -> bool {
        matches!(self.law.film, Some(GuideFilm::LubricantLayer(_)))
    }

    /// The field of the scene by which its film can give energy, if it can.
    pub(crate) fn energy_giving_field(&self) -> Option<String> {
        let field = self.law.film.as_ref()?.passive().err()?;
        Some(format!("{}.{field}", self.path))
    }

    /// Stiffness of its solid contact, N/m; zero without one.
    pub(crate) fn stiffness(&self) -> f64 {
        self.law.solid.map_or(0.0, |solid| solid.contact.stiffness)
    }

    /// How far its solid contact is from the centre of the cage along the axis at most, m.
    pub(crate) fn reach(&self) -> f64 {
        self.slices.iter().map(|[x, _]| x.abs()).fold(self.x.abs(), f64::max)
    }

    /// Centre of a cage from the axis of a ring beside it, along y and z, m, and its velocity, m/s.
    pub(crate) fn offset(cage: &MovingCage<f64>, ring: &MovingRing<f64>) -> [[f64; 2]; 2] {
        let of_ring = scaled(ring.axis, (cage.centre[0] - ring.centre[0]) / ring.axis[0]);
        let ring_velocity = sum(ring.moving.velocity, cross(ring.moving.turning, of_ring));
        let [_, y, z] = difference(cage.centre, sum(ring.centre, of_ring));
        let [_, vy, vz] = difference(cage.moving.velocity, ring_velocity);
        [[y, z], [vy, vz]]
    }

    fn beside<T: Real>(&self, x: f64, cage: &MovingCage<T>, ring: &MovingRing<T>) -> Beside<T> {
        let of_cage = scaled(cage.tilt.axis, T::constant(x));
        let [px, py, pz] = sum(cage.centre, of_cage);
        let [rx, ry, rz] = ring.centre;
        let along = (px - rx) / ring.axis[0];
        let of_ring = scaled(ring.axis, along);
        let from_ring = [py - ry - of_ring[1], pz - rz - of_ring[2]];
        let velocity = |body: &crate::space::solid::Moving<T>, lever| {
            let [_, vy, vz] = sum(body.velocity, cross(body.turning, lever));
            [vy, vz]
        };
        let [cy, cz] = velocity(&cage.moving, of_cage);
        let [ry, rz] = velocity(&ring.moving, of_ring);
        let passing = [cy - ry, cz - rz];
        let spins = [cage.moving.turning[0], ring.moving.turning[0]];
        let (sign, speeds, place) = match self.side {
            GuideSide::CageInside => (1.0, spins, [px, py, pz]),
            GuideSide::CageOutside => (-1.0, [spins[1], spins[0]], sum(ring.centre, of_ring)),
        };
        let motion = JournalMotion {
            position: from_ring.map(|x| x * sign),
            velocity: passing.map(|x| x * sign),
            journal_speed: speeds[0],
            bush_speed: speeds[1],
            profile_angle: cage.angle,
            profile_speed: cage.speed,
        };
        Beside { motion, levers: [difference(place, cage.centre), difference(place, ring.centre)] }
    }

    /// Its forces on cage and ring, with the film at this state of the lubricant.
    ///
    /// # Errors
    /// [`NoFilm`] for a film without solid contact that is gone.
    pub(crate) fn force(
        &self,
        cage: &MovingCage<f64>,
        ring: &MovingRing<f64>,
        fluid: Fluid,
    ) -> std::result::Result<LandForce<f64>, NoFilm> {
        self.force_by(cage, ring, |motion| self.law.of_film(motion, fluid))
    }

    /// The same with derivatives, for which those of the film are taken over its own motion.
    ///
    /// # Errors
    /// As [`Land::force`].
    pub(crate) fn force_slopes<const N: usize>(
        &self,
        cage: &MovingCage<Dual<N>>,
        ring: &MovingRing<Dual<N>>,
        fluid: Fluid,
    ) -> std::result::Result<LandForce<Dual<N>>, NoFilm> {
        self.force_by(cage, ring, |motion| {
            let over_own = self.law.of_film(&lift(&motion.value()), fluid)?;
            let JournalMotion { position: [y, z], velocity: [vy, vz], .. } = *motion;
            let JournalMotion { journal_speed, bush_speed, profile_angle, profile_speed, .. } = *motion;
            let own = [y, z, vy, vz, journal_speed, bush_speed, profile_angle, profile_speed];
            let chained = |x: JournalDual| Dual {
                re: x.re,
                eps: std::array::from_fn(|k| {
                    x.eps.iter().zip(&own).map(|(slope, own)| slope * own.eps[k]).sum()
                }),
            };
            Ok(GuideForce {
                pressure: over_own.pressure.map(chained),
                shear: over_own.shear.map(chained),
                solid: over_own.solid.map(chained),
                moment: chained(over_own.moment),
                film_moment: chained(over_own.film_moment),
                film_share: chained(over_own.film_share),
            })
        })
    }

    /// Its forces on a cage that bends, with the modes of that at these amplitudes (m) and rates (m/s); what acts on the modes, and on request
    /// its derivatives, are left in the memory.
    ///
    /// # Errors
    /// [`NoFilm`] for a film without solid contact that is gone somewhere.
    pub(crate) fn bend(
        &self,
        cage: &MovingCage<f64>,
        ring: &MovingRing<f64>,
        of_modes: [&[f64]; 2],
        (fluid, wanted): (Fluid, Wanted),
        memory: &mut BentLandForces,
    ) -> std::result::Result<LandForce<f64>, NoFilm> {
        match &self.bent {
            Some(bent) => bent.force(self, (cage, ring), of_modes, (fluid, wanted), memory),
            None => self.force(cage, ring, fluid),
        }
    }

    /// Change of what [`Land::bend`] has found last along one direction of the motion of both bodies or of one mode, as derivatives; that over
    /// the modes goes to `on_modes`.
    pub(crate) fn bend_slopes(
        &self,
        cage: &MovingCage<Dual<1>>,
        ring: &MovingRing<Dual<1>>,
        mode: Option<OfMode>,
        memory: &BentLandForces,
        on_modes: &mut [Dual<1>],
    ) -> LandForce<Dual<1>> {
        match &self.bent {
            Some(bent) => bent.slopes(self, (cage, ring), mode, memory, on_modes),
            None => LandForce::default(),
        }
    }

    fn force_by<T: Real>(
        &self,
        cage: &MovingCage<T>,
        ring: &MovingRing<T>,
        of_film: impl Fn(&JournalMotion<T>) -> std::result::Result<GuideForce<T>, NoFilm>,
    ) -> std::result::Result<LandForce<T>, NoFilm> {
        let mut out = LandForce::default();
        let middle = self.beside(self.x, cage, ring);
        if self.law.film.is_some() {
            let film = of_film(&middle.motion)?;
            out.film_share = film.film_share;
            self.add(&film, self.film_part, &middle, &mut out);
            out.by_film = out.on;
        }
        for [x, share] in self.slices.iter().filter(|_| self.law.solid.is_some()) {
            let slice = self.beside(*x, cage, ring);
            let solid = self.law.of_solid(&slice.motion, out.film_share);
            self.add(&solid, *share, &slice, &mut out);
        }
        Ok(out)
    }

    /// The cage is the journal, or takes the opposite.
    fn sign(&self) -> f64 {
        if self.side == GuideSide::CageInside { 1.0 } else { -1.0 }
    }

    /// Adds a part of the force of a law to what acts on both bodies.
    fn add<T: Real>(&self, force: &GuideForce<T>, part: f64, at: &Beside<T>, out: &mut LandForce<T>) {
        let sign = self.sign();
        self.push(force.force().map(|f| f * part), force.moment * part, at, out);
        for (sum, part_of) in out.parts.iter_mut().zip([force.pressure, force.shear, force.solid]) {
            *sum = [0, 1].map(|i| sum[i] + part_of[i] * (part * sign));
        }
    }

    /// Adds a force across the axis and a couple about it on the journal to what acts on both bodies.
    fn push<T: Real>(&self, [fy, fz]: [T; 2], couple: T, at: &Beside<T>, out: &mut LandForce<T>) {
        let zero = T::constant(0.0);
        let (along, couple) = ([zero, fy, fz], [couple, zero, zero]);
        let sign = self.sign();
        for ((on, lever), sign) in out.on.iter_mut().zip(at.levers).zip([sign, -sign]) {
            let moment = sum(cross(lever, along), couple);
            on[0] = sum(on[0], along.map(|f| f * sign));
            on[1] = sum(on[1], moment.map(|m| m * sign));
        }
    }

    /// Smallest gap at a place along the axis of a cage whose modes have these amplitudes and rates, m.
    fn gap_at(&self, x: f64, cage: &MovingCage<f64>, ring: &MovingRing<f64>, of_modes: [&[f64]; 2]) -> f64 {
        let motion = self.beside(x, cage, ring).motion;
        match &self.bent {
            Some(bent) => bent.smallest_gap(self, &motion, cage.angle, of_modes),
            None => self.law.smallest_gap(&motion),
        }
    }

    /// Smallest gap over its width, m; negative where surfaces overlap.
    pub(crate) fn smallest_gap(
        &self,
        cage: &MovingCage<f64>,
        ring: &MovingRing<f64>,
        of_modes: [&[f64]; 2],
    ) -> f64 {
        let at = |x: f64| self.gap_at(x, cage, ring, of_modes);
        self.slices.iter().map(|[x, _]| at(*x)).fold(at(self.x), f64::min)
    }

    /// Number of arcs in which its film touches a cage that bends, in its middle, and the angle that they take, rad.
    pub(crate) fn wet_arcs(
        &self,
        cage: &MovingCage<f64>,
        ring: &MovingRing<f64>,
        of_modes: [&[f64]; 2],
    ) -> (u32, f64) {
        let motion = self.beside(self.x, cage, ring).motion;
        self.bent.as_ref().map_or((0, 0.0), |bent| bent.wet_arcs(self, &motion, cage.angle, of_modes))
    }

    /// Centre of the cage from that of the ring in the middle of the land, m, and its velocity, m/s.
    pub(crate) fn eccentricity(&self, cage: &MovingCage<f64>, ring: &MovingRing<f64>) -> [[f64; 2]; 2] {
        let JournalMotion { position, velocity, .. } = self.beside(self.x, cage, ring).motion;
        let sign = self.sign();
        [position.map(|x| x * sign), velocity.map(|x| x * sign)]
    }

    /// How far the tilt of the cage in its ring takes the edges of the land, over the gap in its middle; zero where they touch.
    pub(crate) fn tilt_over_gap(
        &self,
        cage: &MovingCage<f64>,
        ring: &MovingRing<f64>,
        of_modes: [&[f64]; 2],
    ) -> f64 {
        let [_, y, z] = difference(cage.tilt.axis, ring.axis);
        let gap = self.gap_at(self.x, cage, ring, of_modes);
        if gap <= 0.0 { 0.0 } else { math::hypot(y, z) * self.half_width / gap }
    }

    /// The longest step (s) in which no onset is passed unseen, with bodies on straight lines.
    pub(crate) fn longest_step(
        &self,
        mass: f64,
        (cage, of_modes): (&MovingCage<f64>, [&[f64]; 2]),
        ring: &MovingRing<f64>,
        tuning: &Tuning,
    ) -> f64 {
        let at = |x: f64| {
            let motion = self.beside(x, cage, ring).motion;
            if let Some(bent) = &self.bent {
                return bent.longest_step(self, &motion, cage.angle, of_modes, (mass, tuning));
            }
            let JournalMotion { position, velocity, .. } = motion;
            longest_step(&self.law, mass, &CagePlace { position, velocity }, tuning)
        };
        self.slices.iter().map(|[x, _]| at(*x)).fold(at(self.x), f64::min)
    }
}
