//! How long a step may be that passes no onset of a guide unseen.

use crate::integrate::Tuning;
use crate::laws::guide::bent::{BentMotion, BentSurface};
use crate::laws::guide::{GuideFilm, GuideLaw};
use crate::pairs::passage::Passage;
use crate::scalar::math;
use std::f64::consts::TAU;

/// Places around the circle that tell how long a step may be, per order of the highest wave.
const PLACES_PER_ORDER: u32 = 16;

/// Place (m) and velocity (m/s) of the cage seen from the centre of the guiding ring.
pub(super) struct CagePlace {
    pub(super) position: [f64; 2],
    pub(super) velocity: [f64; 2],
}

/// The longest step of a guide whose cage has `mass` kg and is at this place.
///
/// From outside an onset, a step ends no further behind it than a share of what the law needs to become itself; within a gap
/// it uses up at most a share of what is left; from surfaces that overlap it ends within the film that they part into. So no
/// law is passed between two states that both are outside of it.
pub(super) fn longest_step(guide: &GuideLaw, mass: f64, place: &CagePlace, tuning: &Tuning) -> f64 {
    let CagePlace { position, velocity } = *place;
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
    if let Some(film) = guide.film.as_ref().filter(|_| gap <= 0.0) {
        let thickness = match film {
            GuideFilm::LubricantLayer(layer) => layer.thickness.min(guide.free_clearance),
            GuideFilm::ShortBearing(_) => guide.free_clearance,
        };
        // Time until the distance from the centre has fallen to that of a place in the film, if it does.
        let radius = guide.free_clearance - share * thickness;
        let rest = (e - radius) * (e + radius);
        let square = along * along - speed * speed * rest;
        if along < 0.0 && square >= 0.0 {
            longest = rest / (square.sqrt() - along);
        }
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

/// The same of a bent cage of `mass` kg. Every place of the surface moves on a straight line for this.
pub(super) fn longest_bent_step(
    law: &GuideLaw,
    surface: &BentSurface,
    motion: &BentMotion<'_>,
    mass: f64,
    tuning: &Tuning,
) -> f64 {
    let s = if surface.on_journal { 1.0 } else { -1.0 };
    let ([y, z], [vy, vz], [speed, _]) = (motion.position, motion.velocity, motion.speeds);
    let [amplitudes, rates] = [motion.amplitudes, motion.rates];
    // Velocity as it is seen in axes that turn with the cage.
    let (vy, vz) = (vy + speed * z, vz - speed * y);
    let highest = surface.waves.last().map_or(1, |(order, _)| *order);
    let count = PLACES_PER_ORDER * highest.max(4);
    let fading = tuning.fading * law.roughness;
    let least = if law.solid.is_some() { fading } else { tuning.thinnest_film * law.free_clearance };
    let share = tuning.onset_share;
    let thickness = match &law.film {
        Some(GuideFilm::LubricantLayer(layer)) => layer.thickness.min(law.free_clearance),
        Some(GuideFilm::ShortBearing(_)) | None => law.free_clearance,
    };
    let mut longest = f64::INFINITY;
    for i in 0..count {
        let (sin, cos) = math::sin_cos(TAU * f64::from(i) / f64::from(count));
        let mut gap = law.free_clearance - s * (y * cos + z * sin);
        let mut closing = s * (vy * cos + vz * sin);
        let mut wave = [cos, sin];
        let mut order = 1;
        for (k, (n, _)) in surface.waves.iter().enumerate() {
            while order < *n {
                wave = [wave[0] * cos - wave[1] * sin, wave[1] * cos + wave[0] * sin];
                order += 1;
            }
            gap -= s * (amplitudes[2 * k] * wave[0] + amplitudes[2 * k + 1] * wave[1]);
            closing += s * (rates[2 * k] * wave[0] + rates[2 * k + 1] * wave[1]);
        }
        if closing < 0.0 && gap <= 0.0 && law.film.is_some() {
            longest = longest.min((share * thickness - gap) / -closing);
        }
        if closing <= 0.0 {
            continue;
        }
        if gap > 0.0 && law.film.is_some() {
            longest = longest.min(share * gap.max(least) / closing);
        }
        let mut onset = |rest: f64, depth: f64| {
            if rest > 0.0 {
                longest = longest.min((rest + share * depth) / closing);
            }
        };
        if let Some(GuideFilm::LubricantLayer(layer)) = &law.film {
            onset(gap - layer.thickness, layer.thickness);
        }
        if let Some(solid) = &law.solid {
            let pass = Passage::of(&solid.contact, mass, tuning);
            onset(gap - solid.asperity_height, pass.time(closing) * closing / share);
            if law.film.is_some() {
                onset(gap - fading, fading);
            }
        }
    }
    longest
}
