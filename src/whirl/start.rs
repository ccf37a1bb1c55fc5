//! Where the search for a steady whirl starts: a closed estimate for a rigid cage on a layer, else the end of a short run.

use super::Whirl;
use super::averaged::{Averaged, Unknowns};
use crate::bodies::CAGE_MOTION;
use crate::error::{Error, Result, Status};
use crate::model::{HostInputs, Input, Model};
use crate::scalar::math;
use crate::scene::{GuideFilm, GuideRing, PlaneVector, Pocket, RingStiffness, Scene};
use crate::sim::Sim;
use std::sync::Arc;

/// Half angle of the wet arc, and the share of the estimated speed, that the search begins with.
const ARC: f64 = 0.1;
const SHARE: f64 = 0.9;
/// How deep elements begin in their pockets, m.
const DEPTH: f64 = 0.5e-6;
/// Length of the run, part of it after which it counts, and places that are looked at.
const RUN: f64 = 60e-3;
const COUNTED_FROM: f64 = 0.6;
const LOOKS: u32 = 400;
/// Slower than this share of the elements, nothing whirls.
const RESTS: f64 = 0.5;

/// Unknowns to begin with.
pub(super) fn guess(scene: &Scene, averaged: &Averaged) -> Result<Vec<f64>> {
    match estimate(scene, averaged) {
        Some(unknowns) => Ok(averaged.pack(&unknowns)),
        None => Ok(averaged.pack(&run(scene, averaged)?)),
    }
}

/// The scene with a cage that does not bend.
pub(super) fn rigid(scene: &Scene) -> Scene {
    let mut scene = scene.copied();
    if let Some(cage) = &mut scene.cage {
        cage.elastic_ring = None;
    }
    scene
}

/// The scene with a cage that starts as this whirl goes, among elements of this orbit speed, rad/s.
pub(super) fn with_start(scene: &Scene, whirl: &Whirl, orbit: f64) -> Scene {
    let mut scene = scene.copied();
    scene.initial.cage = Some(PlaneVector { y: whirl.eccentricity, z: 0.0 });
    scene.initial.cage_velocity = PlaneVector { y: 0.0, z: whirl.eccentricity * whirl.speed };
    scene.initial.cage_speed = Some(orbit);
    scene
}

/// The scene with a cage of one wave less, if it has more than one.
pub(super) fn with_fewer_waves(scene: &Scene) -> Option<Scene> {
    let mut scene = scene.copied();
    let ring = scene.cage.as_mut()?.elastic_ring.as_mut().filter(|ring| ring.modes > 2)?;
    ring.modes -= 1;
    if let RingStiffness::FiniteElements(modes) = &mut ring.stiffness {
        modes.frequencies.pop();
        modes.modal_masses.pop();
    }
    Some(scene)
}

/// Balance of shear, pressure and centrifugal force at the edge of a layer. What shears it is the cage, seen from an outer ring.
fn estimate(scene: &Scene, averaged: &Averaged) -> Option<Unknowns> {
    let cage = scene.cage.as_ref().filter(|cage| cage.elastic_ring.is_none())?;
    let guide = cage.guide.as_ref()?;
    let Some(GuideFilm::LubricantLayer(layer)) = &guide.film else { return None };
    let Some(Pocket::SolidPlane(pocket)) = &cage.pocket else { return None };
    let clearance = guide.diametral_clearance / 2.0;
    let inside = clearance - layer.thickness;
    let inputs = averaged.model().inputs_at(0.0, &HostInputs::default());
    let viscosity = match averaged.model().viscosity(&inputs) {
        Some(viscosity) => viscosity,
        None => match scene.lubricant.as_ref()?.viscosity {
            crate::scene::Viscosity::Constant(viscosity) => viscosity,
            crate::scene::Viscosity::Walther(_) => return None,
        },
    };
    let (orbit, radius) = (averaged.orbit(), guide.guide_radius - clearance);
    let sliding =
        orbit - if guide.ring == GuideRing::OuterRing { inputs.of(Input::OuterRingSpeed) } else { 0.0 };
    if inside <= 0.0 || sliding == 0.0 {
        return None;
    }
    let square = 2.7 * viscosity * radius * radius * layer.land_width * sliding.abs()
        / (layer.thickness * cage.mass * inside);
    let touching = pocket.diametral_clearance / 2.0 - inside + DEPTH;
    Some(Unknowns {
        eccentricity: inside / math::cos(ARC),
        speed: -SHARE * square.sqrt() * sliding.signum(),
        lead: sliding.signum() * touching / scene.pitch_radius(),
        waves: Vec::new(),
    })
}

/// The whirl that the scene comes to by itself, in axes that go round with it.
pub(super) fn run(scene: &Scene, averaged: &Averaged) -> Result<Unknowns> {
    let model = Arc::new(Model::new(Scene { gravity: None, ..scene.copied() })?);
    let cage = model.layout().cage().unwrap_or(0);
    let mut sim = Sim::new(model.clone())?;
    let count = model.layout().positions() - cage - CAGE_MOTION;
    let mut sum = Unknowns { eccentricity: 0.0, speed: 0.0, lead: 0.0, waves: vec![0.0; count] };
    let from = (COUNTED_FROM * f64::from(LOOKS)) as u32;
    let share = 1.0 / f64::from(LOOKS - from);
    for i in from + 1..=LOOKS {
        averaged.limits().advance(&mut sim, RUN * f64::from(i) / f64::from(LOOKS))?;
        let (q, v) = sim.state().split_at(model.layout().positions());
        let [y, z, angle] = [q[cage], q[cage + 1], q[cage + 2]];
        let e = math::hypot(y, z).max(1e-12);
        sum.eccentricity += share * e;
        sum.speed += share * (y * v[cage + 1] - z * v[cage]) / (e * e);
        let inputs = model.inputs_at(sim.time(), &HostInputs::default());
        sum.lead += share * (inputs.orbit_travel() - angle);
        let ahead = math::atan2(z, y) - angle;
        for (k, pair) in sum.waves.chunks_mut(2).enumerate() {
            let (sin, cos) = math::sin_cos((k + 2) as f64 * ahead);
            let at = cage + CAGE_MOTION + 2 * k;
            pair[0] += share * (q[at] * cos + q[at + 1] * sin);
            pair[1] += share * (q[at + 1] * cos - q[at] * sin);
        }
    }
    if sum.speed.abs() < RESTS * averaged.orbit().abs() {
        let text = format!(
            "no steady whirl found: after {RUN} s from the start of the scene the cage goes round at {:.1} rad/s; start it with a push",
            sum.speed
        );
        return Err(Error::new(Status::BadState, text));
    }
    Ok(sum)
}
