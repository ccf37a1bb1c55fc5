//! How long a step may be that passes no onset of a rigid guide unseen.

use crate::integrate::Tuning;
use crate::laws::guide::{GuideFilm, GuideLaw};
use crate::pairs::passage::Passage;
use crate::scalar::math;

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
