//! Whether neighbouring rollers go through each other, where nothing keeps them apart.

use crate::bodies::{ElementSet, Fault};
use crate::scalar::math;
use crate::scene::{Pocket, Scene};
use std::f64::consts::TAU;

/// Pockets whose play, doubled by this, is less than that between rollers keep these apart, also where they yield.
const HELD: f64 = 1.5;

/// How close rollers may come.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spacing {
    /// How far the angle between neighbours may shrink before it is looked at whether they overlap, rad; `None` where they
    /// have a contact or are kept apart.
    play: Option<f64>,
}

impl Spacing {
    /// That of the rollers of a scene.
    pub(crate) fn new(scene: &Scene) -> Self {
        Self { play: play(scene) }
    }

    /// The fault of the first rollers that overlap, by radial offset (m) and travel (rad) of each.
    pub(crate) fn overlap(&self, set: &ElementSet, places: impl Fn(usize) -> [f64; 2]) -> Option<Fault> {
        let play = self.play?;
        let ElementSet { radius, pitch_radius, radius_excess, count, .. } = set;
        (0..*count).find_map(|j| {
            let k = (j + 1) % count;
            let ([rho, travel], [rho_k, travel_k]) = (places(j), places(k));
            // Most are far apart.
            if travel_k - travel > -0.5 * play {
                return None;
            }
            let across = math::sin(0.5 * (TAU / *count as f64 + travel_k - travel));
            let chord = 4.0 * (pitch_radius + rho) * (pitch_radius + rho_k) * across * across;
            let distance = ((rho_k - rho) * (rho_k - rho) + chord).sqrt();
            let depth = 2.0 * radius + radius_excess[j] + radius_excess[k] - distance;
            (depth > 0.0).then_some(Fault::Overlap { roller: j, next: k, depth })
        })
    }
}

/// Angle in rad by which neighbouring rollers of a scene can come closer, if that is for them to see to.
fn play(scene: &Scene) -> Option<f64> {
    let rollers =
        scene.rollers.as_ref().filter(|rollers| rollers.neighbours.is_none() && rollers.count > 1)?;
    let spacing = TAU / f64::from(rollers.count);
    let radius = scene.pitch_radius();
    let play = spacing - 2.0 * math::asin((rollers.radius + scene.largest_deviation()) / radius);
    let pocket = scene.cage.as_ref().and_then(|cage| cage.pocket.as_ref()).map(Pocket::clearance);
    let held = pocket.is_some_and(|clearance| HELD * 2.0 * clearance < play * radius);
    (!held).then_some(play.max(0.0))
}
