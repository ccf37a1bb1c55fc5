//! What the animation shows of rollers in space: how they lie between their ribs.

use super::frames::Packed;
use cagedyn::Scene;
use cagedyn::scene::{RibRing, RibSide};
use serde::Serialize;

/// Channels of every roller that are shown, in the order of [`Unrolled::motion`].
pub const CHANNELS: [&str; 3] = ["axial_offset", "skew", "tilt"];

/// Lengths in m, angles in rad.
#[derive(Serialize)]
pub struct Unrolled {
    /// Length over the ends of a roller.
    length: f64,
    /// Radius of the faces of the ends.
    face_radius: f64,
    /// Play of the rollers between ribs on both sides.
    end_play: Option<f64>,
    /// Which rib there is, and its side: 1 at +x, -1 at -x.
    ribs: Vec<(&'static str, i8)>,
    /// Place along the axis, skew and tilt; by element, then by frame.
    motion: [Packed; 3],
}

impl Unrolled {
    /// That of a scene whose rollers move in space, if `column` has all channels of them.
    pub fn new(scene: &Scene, column: impl Fn(&str) -> Option<Packed>) -> Option<Self> {
        let rollers = scene.rollers.as_ref()?;
        let space = rollers.space.as_ref()?;
        let [at, skew, tilt] = CHANNELS.map(column);
        let ribs = scene.ribs.as_ref();
        let told = ribs.iter().flat_map(|ribs| &ribs.list).map(|rib| {
            let ring = match rib.ring {
                RibRing::Outer => "outer",
                RibRing::Inner => "inner",
            };
            (ring, if rib.side == RibSide::Positive { 1 } else { -1 })
        });
        Some(Self {
            length: space.length,
            face_radius: space.ends.as_ref().map_or(rollers.radius, |ends| ends.face_radius),
            end_play: ribs.map(|ribs| ribs.end_play),
            ribs: told.collect(),
            motion: [at?, skew?, tilt?],
        })
    }
}

/// Whether the rollers of a scene move in space.
pub fn wanted(scene: &Scene) -> bool {
    scene.rollers.as_ref().is_some_and(|rollers| rollers.space.is_some())
}
