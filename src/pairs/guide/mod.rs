//! Cage and guiding ring, between which a film and a solid contact act. Global frame.
//!
//! Forces act through the centre of the journal; the bush carries in addition the moment of the force about its own
//! centre, so both wrenches balance.

mod deformed;
pub(crate) mod land;
mod longest_step;
pub mod side;

use crate::bodies::{CAGE, Fault, ForceSource, INNER_RING, Motions, OUTER_RING, Power, SHARED};
use crate::error::Result;
use crate::laws::elastic::solid::SolidContact;
use crate::laws::fluid::Fluid;
use crate::laws::guide::bent::Wanted;
use crate::laws::guide::journal::{Harmonic, JournalMotion, NoFilm};
use crate::laws::guide::lubricant_layer::{LubricantLayer, PressureShear};
use crate::laws::guide::short_bearing::ShortBearing;
use crate::laws::guide::{GuideFilm, GuideForce, GuideLaw, GuideSolid};
use crate::pairs::line_laws::LawBuilder;
use crate::pairs::slope_sums::SlopeSums;
use crate::pairs::{Ahead, Cost, Law, SharedForce, SharedInfo, SharedPair};
use crate::scalar::{Dual, Real, math};
use crate::scene::{self, GuideRing};
use crate::space::{Motion, Wrench};
use deformed::DeformedGuide;
pub(super) use deformed::OnDeformed;
use longest_step::{CagePlace, longest_step};
use nalgebra::Matrix3;
use side::{GuideSide, JournalDual, difference};
use std::f64::consts::TAU;

/// Asperities begin to touch at this many times the roughness, unless the scene says otherwise.
const ASPERITY_HEIGHT: f64 = 3.0;
/// Samples per period of the highest harmonic, for the highest place of a roundness profile.
const PROFILE_SAMPLES: u32 = 64;
/// Newton steps from the highest samples; the error, a thousandth at first, is squared by each.
const PROFILE_REFINEMENTS: u32 = 4;
/// Round-off of a height over the sum of all amplitudes.
const PROFILE_ROUND_OFF: f64 = 1e-13;

/// Every number of a motion as a variable.
#[inline]
fn lift(m: &JournalMotion<f64>) -> JournalMotion<JournalDual> {
    let variable = JournalDual::variable;
    JournalMotion {
        position: [variable(m.position[0], 0), variable(m.position[1], 1)],
        velocity: [variable(m.velocity[0], 2), variable(m.velocity[1], 3)],
        journal_speed: variable(m.journal_speed, 4),
        bush_speed: variable(m.bush_speed, 5),
        profile_angle: variable(m.profile_angle, 6),
        profile_speed: variable(m.profile_speed, 7),
    }
}

/// The guide of a cage: the laws of its film and its solid contact, and the bodies it is between.
#[derive(Debug)]
pub(super) struct Guide {
    law: GuideLaw,
    side: GuideSide,
    /// The ring that guides, a shared body.
    ring: usize,
    /// How it acts on a cage that bends.
    deformed: Option<DeformedGuide>,
}

const SHORT_BEARING: Cost = Cost { value: 160.0, slopes: 1550.0, per_element: false };
/// A layer, which is dry for most of the time in some scenes and never in others.
const LAYER: Cost = Cost { value: 200.0, slopes: 400.0, per_element: false };

/// The laws of a guide of a scene at the path of `laws`, with the side on which its ring is, that ring, and the profile of the cage.
pub(super) fn laws_of(laws: &LawBuilder<'_>, guide: &scene::Guide) -> Result<Built> {
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
    let profile = roundness.clone();
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
            thickener: laws.thickener("lubricant_layer")?,
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
    let law = GuideLaw { radius, clearance, free_clearance, film, solid, roughness, touching_ratio };
    let (side, ring) = match guide.ring {
        GuideRing::OuterRing => (GuideSide::CageInside, OUTER_RING),
        GuideRing::InnerRing => (GuideSide::CageOutside, INNER_RING),
    };
    Ok(Built { law, side, ring, profile })
}

/// A guide by its laws.
pub(super) struct Built {
    pub(super) law: GuideLaw,
    pub(super) side: GuideSide,
    /// The ring that guides, a shared body.
    pub(super) ring: usize,
    profile: Vec<Harmonic>,
}

impl Guide {
    /// The guide of a scene, if its cage has one.
    pub(super) fn of(laws: &LawBuilder<'_>) -> Result<Option<Box<dyn SharedPair>>> {
        let Some(guide) = laws.scene().cage.as_ref().and_then(|cage| cage.guide.as_ref()) else {
            return Ok(None);
        };
        let Built { law, side, ring, profile } = laws_of(&laws.at("cage.guide.film"), guide)?;
        let deformed = DeformedGuide::of(laws.scene(), side, ring, law.radius, &profile);
        Ok(Some(Box::new(Self { law, side, ring, deformed })))
    }

    #[inline]
    fn journal_motion(&self, shared: &[Motion<f64>; SHARED]) -> JournalMotion<f64> {
        self.side.journal_motion(&shared[CAGE], &shared[self.ring])
    }
}

impl Guide {
    /// Adds what a grease does that changes its viscosity: a central difference over its logarithm.
    fn add_warming(&self, fluid: Fluid, m: &JournalMotion<f64>, sums: &mut SlopeSums<'_>) {
        const STEP: f64 = SlopeSums::VISCOSITY_STEP;
        let at = |step: f64| self.law.force(m, fluid.moved(step, sums.ln_structure_ratio));
        let (Ok(high), Ok(low)) = (at(STEP), at(-STEP)) else { return };
        let [high, low] = [high, low].map(|force| self.side.wrenches(&force, m));
        let scale = sums.ln_viscosity_rate / (2.0 * STEP);
        for (place, body) in [CAGE, self.ring].into_iter().enumerate() {
            let (high, low) = (high[place].components(), low[place].components());
            sums.add_mate_over_time(body, &[0, 1, 2].map(|i| scale * (high[i] - low[i])));
        }
    }
}

impl SharedPair for Guide {
    fn info(&self) -> SharedInfo {
        SharedInfo {
            bodies: [CAGE, self.ring],
            source: ForceSource::Guide,
            laws: [
                self.law.film.as_ref().map(|_| Law::GuideFilm),
                self.law.solid.as_ref().map(|_| Law::GuideSolid),
            ],
            powers: [Power::GuideFilm, Power::GuideSolid],
            shears: matches!(self.law.film, Some(GuideFilm::LubricantLayer(_))),
        }
    }

    fn memory(&self) -> SharedForce {
        SharedForce { deformed: self.deformed.as_ref().map(DeformedGuide::memory), ..SharedForce::default() }
    }

    #[inline]
    fn evaluate(
        &self,
        motions: &Motions,
        fluid: Fluid,
        out: &mut SharedForce,
    ) -> std::result::Result<(), Fault> {
        if let Some(deformed) = &self.deformed {
            return deformed.evaluate(&self.law, motions, fluid, Wanted::Forces, out).map_err(fault);
        }
        let motion = self.journal_motion(&motions.shared);
        match self.law.force(&motion, fluid) {
            Ok(force) => {
                out.on = self.side.wrenches(&force, &motion);
                out.of_law = force;
                out.damping = None;
                Ok(())
            }
            Err(gone) => Err(fault(gone)),
        }
    }

    fn evaluate_with_damping(
        &self,
        motions: &Motions,
        fluid: Fluid,
        out: &mut SharedForce,
    ) -> std::result::Result<(), Fault> {
        if let Some(deformed) = &self.deformed {
            return deformed.evaluate(&self.law, motions, fluid, Wanted::Damping, out).map_err(fault);
        }
        let shared = &motions.shared;
        // Over the velocity of the journal and the speed of the cage, which may be either.
        let plain = self.journal_motion(shared);
        let (constant, variable) = (Dual::<3>::constant, Dual::<3>::variable);
        let speed = variable(shared[CAGE].speed, 2);
        let (journal_speed, bush_speed) = match self.side {
            GuideSide::CageInside => (speed, constant(plain.bush_speed)),
            GuideSide::CageOutside => (constant(plain.journal_speed), speed),
        };
        let motion = JournalMotion {
            position: plain.position.map(constant),
            velocity: [variable(plain.velocity[0], 0), variable(plain.velocity[1], 1)],
            journal_speed,
            bush_speed,
            profile_angle: constant(plain.profile_angle),
            profile_speed: speed,
        };
        let force = match self.law.force(&motion, fluid) {
            Ok(force) => force,
            Err(gone) => return Err(fault(gone)),
        };
        let wrenches = self.side.wrenches(&force, &motion);
        out.on = wrenches.map(|on| Wrench { force: on.force.map(|f| f.value()), moment: on.moment.value() });
        out.of_law = force.value();
        // The velocity of the journal is that of the cage, or the opposite of it.
        let along = if self.side == GuideSide::CageInside { 1.0 } else { -1.0 };
        let [on_cage, _] = wrenches;
        let rows = on_cage.components();
        let on_cage = Matrix3::from_fn(|i, k| -rows[i].eps[k] * if k < 2 { along } else { 1.0 });
        // The ring feels what the cage feels, but for the lever.
        let mut on_ring = Matrix3::zeros();
        on_ring.fixed_view_mut::<2, 2>(0, 0).copy_from(&on_cage.fixed_view::<2, 2>(0, 0));
        out.damping = Some([on_cage, on_ring]);
        Ok(())
    }

    fn acting(&self, force: &SharedForce) -> [bool; 2] {
        let GuideForce { film_share, solid, .. } = force.of_law;
        [self.law.film.is_some() && film_share > 0.0, solid != [0.0; 2]]
    }

    fn of_film(&self, motions: &Motions, force: &SharedForce) -> [Wrench<f64>; 2] {
        self.side.wrenches(&force.of_law.of_film(), &self.journal_motion(&motions.shared))
    }

    fn parts(&self, motions: &Motions, force: &SharedForce) -> GuideForce<f64> {
        self.side.on_cage(&force.of_law, &self.journal_motion(&motions.shared))
    }

    fn smallest_gap(&self, motions: &Motions) -> f64 {
        match &self.deformed {
            Some(deformed) => deformed.smallest_gap(&self.law, motions),
            None => self.law.smallest_gap(&self.journal_motion(&motions.shared)),
        }
    }

    fn wet_arcs(&self, motions: &Motions) -> (u32, f64) {
        self.deformed.as_ref().map_or((0, 0.0), |deformed| deformed.wet_arcs(&self.law, motions))
    }

    fn add_slopes(&self, motions: &Motions, fluid: Fluid, force: &mut SharedForce, sums: &mut SlopeSums<'_>) {
        if let Some(deformed) = &self.deformed {
            return deformed.add_slopes(&self.law, motions, fluid, force, sums);
        }
        let m = self.journal_motion(&motions.shared);
        let motion = lift(&m);
        let Ok(force) = self.law.force(&motion, fluid) else { return };
        let (speeding, moving) = (sums.speeding(self.ring), sums.moving(self.ring));
        let bodies = [CAGE, self.ring];
        let wrenches = self.side.wrenches(&force, &motion).map(|on_body| on_body.components());
        for (body, rows) in bodies.into_iter().zip(wrenches) {
            let rows = rows.map(|row| self.side.over_bodies(&row));
            for (k, over) in bodies.into_iter().enumerate() {
                sums.add_mate(body, over, &rows.map(|row| row[k]));
            }
            sums.add_mate_over_time(body, &rows.map(|[_, (_, velocity)]| velocity[2] * speeding));
            if moving != [[0.0; 2]; 2] {
                let rate = |x: &[f64], by: [f64; 2]| x[0] * by[0] + x[1] * by[1];
                let rates =
                    rows.map(|[_, (place, velocity)]| rate(&place, moving[0]) + rate(&velocity, moving[1]));
                sums.add_mate_over_time(body, &rates);
            }
        }
        let ln_viscosity_rate = sums.ln_viscosity_rate;
        if ln_viscosity_rate == 0.0 {
            return;
        }
        if self.law.film.as_ref().is_some_and(GuideFilm::thickens) {
            return self.add_warming(fluid, &m, sums);
        }
        // Films know the viscosity only in its products with velocities, so their derivative over its logarithm is the
        // sum of those over each velocity times that velocity.
        let by_motion = |row: JournalDual| {
            let [_, _, vy, vz, journal, bush, _, profile] = row.eps;
            let by_speeds = journal * m.journal_speed + bush * m.bush_speed + profile * m.profile_speed;
            ln_viscosity_rate * (vy * m.velocity[0] + vz * m.velocity[1] + by_speeds)
        };
        let film = self.side.wrenches(&force.of_film(), &motion).map(|on_body| on_body.components());
        for (body, rows) in bodies.into_iter().zip(film) {
            sums.add_mate_over_time(body, &rows.map(by_motion));
        }
    }

    /// Bodies move on straight lines for this.
    fn longest_step(&self, ahead: &Ahead<'_>) -> f64 {
        if let Some(deformed) = &self.deformed {
            return deformed.longest_step(&self.law, ahead);
        }
        let [body, ring] = [&ahead.shared[CAGE], &ahead.shared[self.ring]];
        let relative = CagePlace {
            position: difference(body.position, ring.position),
            velocity: difference(body.velocity, ring.velocity),
        };
        longest_step(&self.law, ahead.masses[CAGE], &relative, ahead.tuning)
    }

    fn stiffness(&self) -> f64 {
        self.law.solid.map_or(0.0, |solid| solid.contact.stiffness)
    }

    fn energy_giving_field(&self) -> Option<String> {
        let field = self.law.film.as_ref()?.passive().err()?;
        Some(format!("cage.guide.film.{field}"))
    }

    fn cost(&self) -> Option<Cost> {
        if let Some(deformed) = &self.deformed {
            return Some(deformed.cost());
        }
        self.law.film.as_ref().map(|film| match film {
            GuideFilm::ShortBearing(_) => SHORT_BEARING,
            GuideFilm::LubricantLayer(_) => LAYER,
        })
    }
}

fn fault(gone: NoFilm) -> Fault {
    Fault::NoGuideFilm { minimum_film: gone.minimum_film }
}

/// Largest height of a profile, m, from above: where nothing reaches this circle, nothing reaches the profile either.
fn highest_place(roundness: &[Harmonic]) -> f64 {
    let order = roundness.iter().map(|a| a.order).max().unwrap_or(0);
    let samples = order * PROFILE_SAMPLES;
    let step = TAU / f64::from(samples.max(1));
    let at = |angle: f64| {
        roundness.iter().fold([0.0; 3], |[height, slope, curvature], a| {
            let n = f64::from(a.order);
            let (sin, cos) = math::sin_cos(n * angle + a.phase);
            let [even, odd] = [a.amplitude * cos, a.amplitude * sin];
            [height + even, slope - n * odd, curvature - n * n * even]
        })
    };
    let heights: Vec<f64> = (0..samples).map(|i| at(step * f64::from(i))[0]).collect();
    let count = heights.len();
    let mut highest = 0.0f64;
    for (i, height) in heights.iter().enumerate() {
        if *height < heights[(i + count - 1) % count] || *height < heights[(i + 1) % count] {
            continue;
        }
        let mut angle = step * i as f64;
        for _ in 0..PROFILE_REFINEMENTS {
            let [_, slope, curvature] = at(angle);
            if curvature < 0.0 {
                angle -= (slope / curvature).clamp(-step, step);
            }
        }
        highest = highest.max(at(angle)[0]);
    }
    let sum: f64 = roundness.iter().map(|a| a.amplitude.abs()).sum();
    highest + PROFILE_ROUND_OFF * sum
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
            clearance: 0.2e-3,
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
    fn no_place_of_a_profile_is_above_its_highest() {
        let mut random = fastrand::Rng::with_seed(7);
        let mut within = |low: f64, high: f64| low + (high - low) * random.f64();
        for count in [1, 2, 3, 12] {
            for _ in 0..20 {
                let roundness: Vec<Harmonic> = (0..count)
                    .map(|_| Harmonic {
                        order: within(2.0, 14.0) as u32,
                        amplitude: within(-1e-5, 1e-5),
                        phase: within(-3.0, 3.0),
                    })
                    .collect();
                let highest = highest_place(&roundness);
                let height = |angle: f64| -> f64 {
                    roundness.iter().map(|a| a.amplitude * (f64::from(a.order) * angle + a.phase).cos()).sum()
                };
                let seen = (0..20_000).map(|i| height(TAU * f64::from(i) / 2e4)).fold(0.0, f64::max);
                assert!(highest >= seen, "{roundness:?}");
                // Samples miss at most this of a wave.
                assert!(highest < seen + 1e-9, "{roundness:?} {highest} {seen}");
            }
        }
        let one = Harmonic { order: 5, amplitude: -2e-5, phase: 0.3 };
        assert!((highest_place(&[one]) - 2e-5).abs() < 1e-17);
        assert_eq!(highest_place(&[]), 0.0);
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
