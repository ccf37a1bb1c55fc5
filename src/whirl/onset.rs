//! At which speed a cage whirls: three different speeds, by runs of the whole scene under its gravity.
//!
//! ```text
//! survival        the slowest speed at which a whirl that is there goes on
//! dropped start   the slowest speed at which a cage comes to whirl that starts from the centre, or slightly beside it
//! loss of rest    the speed at which a cage that rests on its film begins to whirl while the speed is raised
//! ```
//!
//! Onset is no bifurcation of rest: between the first and the last of these speeds rest and whirl are both there, and how the cage is
//! disturbed decides. Speeds are found by halving, to a share of themselves.

use super::averaged::Averaged;
use super::find;
use crate::bodies::CAGE_MOTION;
use crate::error::{Error, Result, Status};
use crate::model::{HostInputs, Input, Model};
use crate::scalar::math;
use crate::scene::{OuterRing, PlaneVector, Scene, Signal};
use crate::sim::{RunLimits, Sim};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Length of a run, s, and the share of it after which the cage must go round.
const RUN: f64 = 0.25;
const JUDGED_FROM: f64 = 0.8;
/// Time between looks at its place then, s.
const LOOK: f64 = 0.1e-3;
/// The cage whirls where its centre goes round faster than this share of the elements.
const WHIRLS: f64 = 0.5;
/// How closely a speed is found, as a share.
const CLOSE: f64 = 0.02;
/// Time in which a cage comes to rest, time in which the speed is raised over the range then, and how often the cage is judged, s.
const REST: f64 = 0.2;
const RAISE: f64 = 4.0;
const STAY: f64 = 0.1;
/// Places beside the centre from which a cage is dropped, as shares of the clearance.
const DROPS: [[f64; 2]; 3] = [[0.0, 0.0], [0.05, 0.0], [-0.03, 0.04]];

/// Speeds of the inner ring at which a whirl begins and ends, rad/s, within the range that was looked at. `None` where there is none:
/// of the first, where whirls go on down to the slowest speed, of the others, where there is no whirl up to the fastest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Onset {
    /// A whirl that is there goes on down to here.
    pub survival: Option<f64>,
    /// A dropped cage comes to whirl from here on.
    pub dropped_start: Option<f64>,
    /// A cage at rest begins to whirl here while the speed is raised.
    pub loss_of_rest: Option<f64>,
    /// How many of the three, in this order, are known: all, unless a host has ended the search.
    pub known: usize,
    /// Why the others are not.
    pub stopped: Option<Error>,
}

/// The three speeds of a scene between two magnitudes of the speed of its inner ring, rad/s.
///
/// # Errors
/// [`Status::BadValue`] for a range that does not grow from above zero; [`Status::BadScene`] as [`super::steady`], as [`Sim::advance_to`]. Limits are an error only before the
/// first speed is found.
pub fn onset(scene: &Scene, range: [f64; 2], limits: &RunLimits) -> Result<Onset> {
    limits.searching(|| speeds(scene, range, limits))
}

fn speeds(scene: &Scene, [slowest, fastest]: [f64; 2], limits: &RunLimits) -> Result<Onset> {
    if !(slowest > 0.0 && fastest > slowest && fastest.is_finite()) {
        let text = format!("range: from {slowest:?} to {fastest:?} rad/s; speeds must grow from above zero");
        return Err(Error::new(Status::BadValue, text));
    }
    let Some(Signal::Constant(given)) = scene.inner_ring.as_ref().map(|ring| &ring.speed) else {
        let text = "inner_ring.speed: must be constant; it is what is varied".to_owned();
        return Err(Error::new(Status::BadScene, text));
    };
    if scene.outer_ring.as_ref().is_some_and(OuterRing::turns) {
        let text = "outer_ring.speed: must be absent; the speed of the inner ring alone is varied".to_owned();
        return Err(Error::new(Status::BadScene, text));
    }
    let sign = if *given < 0.0 { -1.0 } else { 1.0 };
    let at = |speed: f64| with_speed(scene, sign * speed);
    let goes_on = |speed: f64| whirls_on(&at(speed), limits);
    let starts = |speed: f64| starts_dropped(&at(speed), limits);
    let mut onset = Onset::default();
    let find_all = |onset: &mut Onset| -> Result<()> {
        onset.survival = first(slowest, fastest, goes_on)?.filter(|speed| *speed > slowest);
        onset.known = 1;
        limits.tell(1.0 / 3.0, 1);
        onset.dropped_start = first(slowest, fastest, starts)?;
        onset.known = 2;
        limits.tell(2.0 / 3.0, 2);
        onset.loss_of_rest = raised(scene, sign, [slowest, fastest], limits)?;
        onset.known = 3;
        limits.tell(1.0, 3);
        Ok(())
    };
    match find_all(&mut onset) {
        Err(e) if e.is_stop() && onset.known > 0 => onset.stopped = Some(e),
        ended => ended?,
    }
    Ok(onset)
}

/// The slowest speed from which on something holds, if it does at the fastest: geometric halving.
fn first(slowest: f64, fastest: f64, holds: impl Fn(f64) -> Result<bool>) -> Result<Option<f64>> {
    if !holds(fastest)? {
        return Ok(None);
    }
    if holds(slowest)? {
        return Ok(Some(slowest));
    }
    let (mut low, mut high) = (slowest, fastest);
    while high / low > 1.0 + CLOSE {
        let middle = (low * high).sqrt();
        if holds(middle)? { high = middle } else { low = middle }
    }
    Ok(Some(high))
}

fn with_speed(scene: &Scene, speed: f64) -> Scene {
    let mut scene = scene.copied();
    if let Some(ring) = &mut scene.inner_ring {
        ring.speed = Signal::Constant(speed);
    }
    scene
}

/// Whether the whirl without gravity goes on under it.
fn whirls_on(scene: &Scene, limits: &RunLimits) -> Result<bool> {
    let whirl = match find(scene, &mut Averaged::new(scene, limits)?) {
        Ok(whirl) => whirl,
        Err(e) if e.is_stop() => return Err(e),
        Err(_) => return Ok(false),
    };
    let model = Arc::new(Model::new(scene.copied())?);
    let mut sim = Sim::new(model.clone())?;
    let Some(cage) = model.layout().cage() else { return Ok(false) };
    let mut state = sim.state().to_vec();
    let (q, v) = state.split_at_mut(model.layout().positions());
    let orbit = model.inputs_at(0.0, &HostInputs::default()).of(Input::OrbitSpeed);
    let round = whirl.speed - orbit;
    (q[cage], q[cage + 1], q[cage + 2]) = (whirl.eccentricity, 0.0, -whirl.lead);
    (v[cage], v[cage + 1], v[cage + 2]) = (0.0, whirl.eccentricity * whirl.speed, orbit);
    for (k, pair) in whirl.waves().as_chunks::<2>().0.iter().enumerate() {
        let n = (k + 2) as f64 * round;
        let at = cage + CAGE_MOTION + 2 * k;
        (q[at], q[at + 1]) = (pair[0], pair[1]);
        (v[at], v[at + 1]) = (-n * pair[1], n * pair[0]);
    }
    sim.set_state(0.0, &state)?;
    whirls(&mut sim, RUN, limits)
}

/// Whether a cage whirls that starts near the centre.
fn starts_dropped(scene: &Scene, limits: &RunLimits) -> Result<bool> {
    let clearance =
        scene.cage.as_ref().and_then(|cage| cage.guide.as_ref()).map_or(0.0, |g| g.diametral_clearance / 2.0);
    for [y, z] in DROPS {
        let mut scene = scene.copied();
        scene.initial.cage = Some(PlaneVector { y: y * clearance, z: z * clearance });
        scene.initial.cage_velocity = PlaneVector::default();
        if whirls(&mut Sim::new(Arc::new(Model::new(scene)?))?, RUN, limits)? {
            return Ok(true);
        }
    }
    Ok(false)
}

/// The speed at which a cage that rests begins to whirl while the speed grows evenly.
fn raised(scene: &Scene, sign: f64, [slowest, fastest]: [f64; 2], limits: &RunLimits) -> Result<Option<f64>> {
    let mut scene = scene.copied();
    scene.initial.cage_velocity = PlaneVector::default();
    let ramp = Signal::Ramp { from: sign * slowest, to: sign * fastest, start: REST, end: REST + RAISE };
    if let Some(ring) = &mut scene.inner_ring {
        ring.speed = ramp;
    }
    let mut sim = Sim::new(Arc::new(Model::new(scene)?))?;
    limits.advance(&mut sim, REST)?;
    while sim.time() < REST + RAISE {
        if whirls(&mut sim, STAY, limits)? {
            return Ok(Some(sim.input_at_present(Input::RingSpeed).abs()));
        }
    }
    Ok(None)
}

/// Whether the cage goes round in the last part of a run of this length, s: its direction, not the speed of its rattling, tells.
fn whirls(sim: &mut Sim, length: f64, limits: &RunLimits) -> Result<bool> {
    let start = sim.time();
    let Some(cage) = sim.model().layout().cage() else { return Ok(false) };
    limits.advance(sim, start + JUDGED_FROM * length)?;
    let looks = ((1.0 - JUDGED_FROM) * length / LOOK).ceil();
    let direction = |sim: &Sim| math::atan2(sim.state()[cage + 1], sim.state()[cage]);
    let (mut before, mut turned) = (direction(sim), 0.0);
    for i in 1..=looks as u32 {
        limits.advance(sim, start + length * (JUDGED_FROM + (1.0 - JUDGED_FROM) * f64::from(i) / looks))?;
        let now = direction(sim);
        turned += (now - before + PI).rem_euclid(TAU) - PI;
        before = now;
    }
    let orbit = sim.input_at_present(Input::OrbitSpeed);
    let speed = turned / ((1.0 - JUDGED_FROM) * length);
    Ok(turned.abs() > TAU && speed.abs() > WHIRLS * orbit.abs())
}
