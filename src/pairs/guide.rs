//! Cage and guiding ring: who is the journal, and the way back from the force on it to both bodies. Global frame.
//!
//! Forces act through the centre of the journal; the bush carries in addition the moment of the force about its own
//! centre, so both wrenches balance.

use super::SlopeSums;
use super::line_laws::LawBuilder;
use super::passage::Passage;
use crate::bodies::{CAGE, Fault, IN_HUB, INNER_RING, Input, Motions, OUTER_RING, SHARED};
use crate::error::Result;
use crate::integrate::Tuning;
use crate::laws::elastic::solid::SolidContact;
use crate::laws::fluid::Fluid;
use crate::laws::guide::journal::{Harmonic, JournalMotion};
use crate::laws::guide::lubricant_layer::{LubricantLayer, PressureShear};
use crate::laws::guide::short_bearing::ShortBearing;
use crate::laws::guide::{GuideFilm, GuideForce, GuideLaw, GuideSolid};
use crate::scalar::{Dual, Real, math};
use crate::scene::{self, GuideRing};
use crate::space::{Motion, Wrench};
use nalgebra::Matrix3;
use std::f64::consts::TAU;

/// Asperities begin to touch at this many times the roughness, unless the scene says otherwise.
const ASPERITY_HEIGHT: f64 = 3.0;
/// Samples per period of the highest harmonic, for the highest place of a roundness profile.
const PROFILE_SAMPLES: u32 = 64;

/// Side of the guide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GuideSide {
    /// The cage is the journal inside the ring.
    CageInside,
    /// The cage is the bush around the ring.
    CageOutside,
}

impl GuideSide {
    /// Motion of the journal in the bush. The roundness profile is that of the cage.
    #[inline]
    pub fn journal_motion<T: Real>(self, cage: &Motion<T>, ring: &Motion<T>) -> JournalMotion<T> {
        let (journal, bush) = match self {
            GuideSide::CageInside => (cage, ring),
            GuideSide::CageOutside => (ring, cage),
        };
        JournalMotion {
            position: difference(journal.position, bush.position),
            velocity: difference(journal.velocity, bush.velocity),
            journal_speed: journal.speed,
            bush_speed: bush.speed,
            profile_angle: cage.angle,
            profile_speed: cage.speed,
        }
    }

    /// The force on the cage, with its moment about the cage centre.
    #[inline]
    pub fn on_cage<T: Real>(self, f: &GuideForce<T>, m: &JournalMotion<T>) -> GuideForce<T> {
        match self {
            GuideSide::CageInside => *f,
            GuideSide::CageOutside => GuideForce {
                pressure: opposite(f.pressure),
                shear: opposite(f.shear),
                solid: opposite(f.solid),
                moment: -(f.moment + carried(f, m)),
                film_moment: -(f.film_moment + carried(&f.of_film(), m)),
                ..*f
            },
        }
    }

    /// Wrenches on the cage and on the ring.
    #[inline]
    pub fn wrenches<T: Real>(self, f: &GuideForce<T>, m: &JournalMotion<T>) -> [Wrench<T>; 2] {
        let force = f.force();
        let on_journal = Wrench { force, moment: f.moment };
        let on_bush = Wrench { force: opposite(force), moment: -(f.moment + carried(f, m)) };
        match self {
            GuideSide::CageInside => [on_journal, on_bush],
            GuideSide::CageOutside => [on_bush, on_journal],
        }
    }
}

#[inline]
fn difference<T: Real>(a: [T; 2], b: [T; 2]) -> [T; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

#[inline]
fn opposite<T: Real>([y, z]: [T; 2]) -> [T; 2] {
    [-y, -z]
}

/// Moment of the force on the journal about the centre of the bush.
#[inline]
fn carried<T: Real>(f: &GuideForce<T>, m: &JournalMotion<T>) -> T {
    let [y, z] = f.force();
    m.position[0] * z - m.position[1] * y
}

/// The guide of a cage: the laws of its film and its solid contact, and the bodies it is between.
#[derive(Debug)]
pub(crate) struct Guide {
    law: GuideLaw,
    side: GuideSide,
    /// The ring that guides, a shared body.
    pub(crate) ring: usize,
}

/// Force of the guide at one state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GuideState {
    /// On the journal.
    force: GuideForce<f64>,
    motion: JournalMotion<f64>,
}

/// Derivatives of a wrench over the coordinates of ring and cage, their rates, and the speed of the ring.
type GuideDual = Dual<11>;
/// First velocity among its directions, and the speed of the ring.
const VELOCITY: usize = 5;
const RING_SPEED: usize = 10;

impl Guide {
    /// The guide of a scene, if its cage has one.
    pub(crate) fn new(laws: &LawBuilder<'_>) -> Result<Option<Self>> {
        let Some(guide) = laws.scene().cage.as_ref().and_then(|cage| cage.guide.as_ref()) else {
            return Ok(None);
        };
        let laws = laws.at("cage.guide.film");
        let clearance = guide.diametral_clearance / 2.0;
        // A profile on the outside of the cage thins the film where it is high, one in its bore thickens it.
        let (radius, sign) = match guide.ring {
            GuideRing::OuterRing => (guide.guide_radius - clearance, 1.0),
            GuideRing::InnerRing => (guide.guide_radius, -1.0),
        };
        let roundness: Vec<Harmonic> = guide
            .roundness
            .iter()
            .map(|a| Harmonic { order: a.order, amplitude: sign * a.amplitude, phase: a.phase })
            .collect();
        let free_clearance = clearance - highest_place(&roundness);
        let film = match &guide.film {
            None => None,
            Some(scene::GuideFilm::ShortBearing(film)) => Some(GuideFilm::ShortBearing(ShortBearing {
                viscosity: laws.viscosity("short_bearing")?,
                radius,
                clearance,
                land_width: film.land_width,
                squeeze: film.squeeze,
                pressure_moment: film.pressure_moment,
                roundness,
                profile_on_journal: guide.ring == GuideRing::OuterRing,
            })),
            Some(scene::GuideFilm::LubricantLayer(film)) => Some(GuideFilm::LubricantLayer(LubricantLayer {
                viscosity: laws.viscosity("lubricant_layer")?,
                pressure_viscosity: laws.pressure_viscosity("lubricant_layer")?,
                cap: film.pressure_cap,
                radius,
                clearance,
                width: film.land_width,
                thickness: film.thickness,
                pressure_shear: match film.pressure_shear {
                    scene::PressureShear::Absent => PressureShear::Absent,
                    scene::PressureShear::WithinArc => PressureShear::WithinArc,
                    scene::PressureShear::WithEdges => PressureShear::WithEdges,
                },
                roundness,
                profile_on_journal: guide.ring == GuideRing::OuterRing,
            })),
        };
        let share = guide.film_share.as_ref();
        let (roughness, touching_ratio) = share.map_or((0.0, 0.0), |s| (s.roughness, s.touching_ratio));
        let solid = guide.solid.as_ref().map(|law| GuideSolid {
            contact: SolidContact::from(&law.contact),
            asperity_height: law.asperity_height.unwrap_or(ASPERITY_HEIGHT * roughness),
        });
        let law = GuideLaw { radius, free_clearance, film, solid, roughness, touching_ratio };
        let (side, ring) = match guide.ring {
            GuideRing::OuterRing => (GuideSide::CageInside, OUTER_RING),
            GuideRing::InnerRing => (GuideSide::CageOutside, INNER_RING),
        };
        Ok(Some(Self { law, side, ring }))
    }

    /// Its laws.
    pub(crate) fn law(&self) -> &GuideLaw {
        &self.law
    }

    /// Force at this motion of the bodies with this lubricant.
    ///
    /// # Errors
    /// [`Fault::NoGuideFilm`] where a film alone is gone.
    #[inline]
    pub(crate) fn evaluate(
        &self,
        shared: &[Motion<f64>; SHARED],
        fluid: Fluid,
    ) -> std::result::Result<GuideState, Fault> {
        let motion = self.side.journal_motion(&shared[CAGE], &shared[self.ring]);
        match self.law.force(&motion, fluid) {
            Ok(force) => Ok(GuideState { force, motion }),
            Err(gone) => Err(Fault::NoGuideFilm { minimum_film: gone.minimum_film }),
        }
    }

    /// Wrenches on cage and ring.
    #[inline]
    pub(crate) fn wrenches(&self, state: &GuideState) -> [Wrench<f64>; 2] {
        self.side.wrenches(&state.force, &state.motion)
    }

    /// Those of the film alone.
    #[inline]
    pub(crate) fn film_wrenches(&self, state: &GuideState) -> [Wrench<f64>; 2] {
        self.side.wrenches(&state.force.of_film(), &state.motion)
    }

    /// The force on the cage by its parts.
    pub(crate) fn on_cage(&self, state: &GuideState) -> GuideForce<f64> {
        self.side.on_cage(&state.force, &state.motion)
    }

    /// Whether film and solid contact act.
    pub(crate) fn acting(&self, state: &GuideState) -> [bool; 2] {
        [self.law.film.is_some() && state.force.film_share > 0.0, state.force.solid != [0.0; 2]]
    }

    /// -d(force, moment on the cage)/d(velocity, speed of the cage), N s/m and its kin.
    pub(crate) fn damping(&self, shared: &[Motion<f64>; SHARED], fluid: Fluid) -> Matrix3<f64> {
        let [body, ring] = [&shared[CAGE], &shared[self.ring]];
        let constant = |x: [f64; 2]| x.map(Dual::<3>::constant);
        let moving = Motion {
            position: constant(body.position),
            velocity: [Dual::variable(body.velocity[0], 0), Dual::variable(body.velocity[1], 1)],
            angle: Dual::constant(body.angle),
            speed: Dual::variable(body.speed, 2),
        };
        let ring = Motion {
            position: constant(ring.position),
            velocity: constant(ring.velocity),
            angle: Dual::constant(ring.angle),
            speed: Dual::constant(ring.speed),
        };
        let motion = self.side.journal_motion(&moving, &ring);
        let Ok(force) = self.law.force(&motion, fluid) else { return Matrix3::zeros() };
        let [on_cage, _] = self.side.wrenches(&force, &motion);
        let rows = on_cage.components();
        Matrix3::from_fn(|i, k| -rows[i].eps[k])
    }

    /// Adds the derivatives of its forces.
    pub(crate) fn add_slopes(&self, motions: &Motions, fluid: Fluid, sums: &mut SlopeSums<'_>) {
        let bodies = [&motions.shared[CAGE], &motions.shared[self.ring]];
        // Ring y, z, cage y, z, angle; then their rates.
        let lift = |body: &Motion<f64>, at: usize, angle: bool, moves: bool| {
            let variable =
                |x: f64, i: usize| if moves { GuideDual::variable(x, i) } else { Dual::constant(x) };
            Motion {
                position: std::array::from_fn(|k| variable(body.position[k], at + k)),
                velocity: std::array::from_fn(|k| variable(body.velocity[k], VELOCITY + at + k)),
                angle: if angle { variable(body.angle, at + 2) } else { Dual::constant(body.angle) },
                speed: if angle {
                    variable(body.speed, VELOCITY + at + 2)
                } else {
                    Dual::constant(body.speed)
                },
            }
        };
        let (on_inner, cage_at) = (self.ring == INNER_RING, IN_HUB[CAGE]);
        let ring_moves = on_inner && sums.layout.shared(self.ring).is_some();
        let moving = lift(bodies[0], cage_at, true, true);
        let mut ring = lift(bodies[1], 0, false, ring_moves);
        if on_inner {
            ring.speed = Dual::variable(bodies[1].speed, RING_SPEED);
        }
        let motion = self.side.journal_motion(&moving, &ring);
        let Ok(force) = self.law.force(&motion, fluid) else { return };
        let rows = |[on_cage, on_ring]: [Wrench<GuideDual>; 2]| {
            let [y, z, moment] = on_cage.components();
            [on_ring.force[0], on_ring.force[1], y, z, moment]
        };
        let first = if ring_moves { 0 } else { cage_at };
        let all = rows(self.side.wrenches(&force, &motion));
        for (i, row) in all.into_iter().enumerate().skip(first) {
            for k in 0..VELOCITY {
                sums.out.over_positions.hub[(i, k)] += row.eps[k];
                sums.out.over_velocities.hub[(i, k)] += row.eps[VELOCITY + k];
            }
            sums.hub_over_time[i] += row.eps[RING_SPEED] * sums.rates.of(Input::RingSpeed);
        }
        let ln_viscosity_rate = sums.ln_viscosity_rate;
        if ln_viscosity_rate == 0.0 {
            return;
        }
        // Films know the viscosity only in its products with velocities, so their derivative over its logarithm is the
        // sum of those over each velocity times that velocity.
        let [cage, ring] = bodies;
        let moves = if ring_moves { ring.velocity } else { [0.0; 2] };
        let velocities = [moves[0], moves[1], cage.velocity[0], cage.velocity[1], cage.speed];
        let film = rows(self.side.wrenches(&force.of_film(), &motion));
        for (i, row) in film.into_iter().enumerate().skip(first) {
            let slopes = velocities.iter().zip(&row.eps[VELOCITY..RING_SPEED]);
            let by_motion: f64 = slopes.map(|(v, slope)| v * slope).sum();
            sums.hub_over_time[i] += ln_viscosity_rate * (by_motion + ring.speed * row.eps[RING_SPEED]);
        }
    }

    /// The longest step (s) that passes no onset unseen, with a cage of `mass` kg. Bodies move on straight lines for this.
    pub(crate) fn longest_step(&self, shared: &[Motion<f64>], mass: f64, tuning: &Tuning) -> f64 {
        let [body, ring] = [&shared[CAGE], &shared[self.ring]];
        let relative = JournalPlace {
            position: difference(body.position, ring.position),
            velocity: difference(body.velocity, ring.velocity),
        };
        longest_step(&self.law, mass, &relative, tuning)
    }
}

/// Largest height of a profile, m, to about a thousandth of its amplitude.
fn highest_place(roundness: &[Harmonic]) -> f64 {
    let order = roundness.iter().map(|a| a.order).max().unwrap_or(0);
    let samples = order * PROFILE_SAMPLES;
    (0..samples)
        .map(|i| {
            let angle = TAU * f64::from(i) / f64::from(samples);
            roundness.iter().map(|a| a.amplitude * math::cos(f64::from(a.order) * angle + a.phase)).sum()
        })
        .fold(0.0, f64::max)
}

/// The same from the centre of the guiding ring.
struct JournalPlace {
    position: [f64; 2],
    velocity: [f64; 2],
}

/// The longest step of a guide whose cage has `mass` kg and is at this place.
///
/// From outside an onset, a step ends no further behind it than a share of what the law needs to become itself; within a gap
/// it uses up at most a share of what is left. So no law is passed between two states that both are outside of it.
fn longest_step(guide: &GuideLaw, mass: f64, place: &JournalPlace, tuning: &Tuning) -> f64 {
    let JournalPlace { position, velocity } = *place;
    let share = tuning.onset_share;
    let e = math::hypot(position[0], position[1]);
    let speed = math::hypot(velocity[0], velocity[1]);
    let along = position[0] * velocity[0] + position[1] * velocity[1];
    // Time until the distance from the centre is `radius`, which is larger than e.
    let until = |radius: f64| {
        let rest = (radius - e) * (radius + e);
        let root = (along * along + speed * speed * rest).sqrt();
        if along > 0.0 { rest / (along + root) } else { (root - along) / (speed * speed) }
    };
    let gap = guide.free_clearance - e;
    // Where surfaces touch before the film is gone, the gap may close.
    let fading = tuning.fading * guide.roughness;
    let least = if guide.solid.is_some() { fading } else { tuning.thinnest_film * guide.free_clearance };
    let mut longest = f64::INFINITY;
    if gap > 0.0 && guide.film.is_some() {
        longest = until(e + share * gap.max(least));
    }
    let mut onset = |rest: f64, depth: f64| {
        if rest > 0.0 {
            longest = longest.min(until(e + rest + share * depth));
        }
    };
    if let Some(GuideFilm::LubricantLayer(layer)) = &guide.film {
        onset(gap - layer.thickness, layer.thickness);
    }
    if let Some(solid) = &guide.solid {
        let rest = gap - solid.asperity_height;
        if rest > 0.0 {
            let depth = speed * Passage::of(&solid.contact, mass, tuning).time(speed);
            onset(rest, depth / share);
        }
        if guide.film.is_some() {
            onset(gap - fading, fading);
        }
    }
    if longest.is_nan() { f64::INFINITY } else { longest }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws::elastic::solid::SolidContact;
    use crate::laws::guide::{GuideLaw, GuideSolid};
    use crate::laws::traction::solid_friction::SolidFriction;

    fn law() -> GuideLaw {
        let friction = Some(SolidFriction { coefficient: 0.2, transition_speed: 0.01 });
        let contact = SolidContact { stiffness: 1e6, damping: 0.0, softening_depth: 0.0, friction };
        let solid = Some(GuideSolid { contact, asperity_height: 0.0 });
        GuideLaw {
            radius: 35e-3,
            free_clearance: 0.2e-3,
            film: None,
            solid,
            roughness: 0.0,
            touching_ratio: 0.0,
        }
    }

    fn body(position: [f64; 2], speed: f64) -> Motion<f64> {
        Motion { position, velocity: [0.0; 2], angle: 0.0, speed }
    }

    #[test]
    fn a_cage_around_a_ring_is_pushed_back_and_driven_by_it() {
        let (cage, ring) = (body([0.21e-3, 0.0], 100.0), body([0.0; 2], 300.0));
        let side = GuideSide::CageOutside;
        let m = side.journal_motion(&cage, &ring);
        let f = law().force(&m, Fluid::SAME).unwrap();
        let [on_cage, on_ring] = side.wrenches(&f, &m);
        // 10 um deep at the left of the ring, where its surface moves down and drags the cage.
        assert!(
            (on_cage.force[0] + 10.0).abs() < 1e-9 && (on_cage.force[1] + 2.0).abs() < 1e-9,
            "{on_cage:?}"
        );
        assert!(on_cage.moment > 0.0 && on_ring.moment < 0.0);
        let reported = side.on_cage(&f, &m);
        assert_eq!((reported.force(), reported.moment), (on_cage.force, on_cage.moment));
    }

    #[test]
    fn both_sides_balance() {
        for side in [GuideSide::CageInside, GuideSide::CageOutside] {
            let (cage, ring) = (body([0.15e-3, -0.16e-3], 100.0), body([1e-5, 2e-5], -300.0));
            let m = side.journal_motion(&cage, &ring);
            let [a, b] = side.wrenches(&law().force(&m, Fluid::SAME).unwrap(), &m);
            assert_eq!([a.force[0] + b.force[0], a.force[1] + b.force[1]], [0.0; 2]);
            let about_origin =
                |w: &Wrench<f64>, x: [f64; 2]| w.moment + x[0] * w.force[1] - x[1] * w.force[0];
            let sum = about_origin(&a, cage.position) + about_origin(&b, ring.position);
            assert!(sum.abs() < 1e-15, "{sum}");
        }
    }
}
