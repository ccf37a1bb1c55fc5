//! Motion of the cage centre from what was recorded.

use cagedyn::scene::GuideRing;
use cagedyn::{Model, Recording, WhirlRecord, WhirlSummary};

/// Channels that it takes, where the scene has them.
pub const CHANNELS: [&str; 7] = [
    "cage.whirl_speed",
    "cage.whirl_radius",
    "cage.y",
    "cage.z",
    "cage.speed",
    "inner_ring.y",
    "inner_ring.z",
];

/// Motion from time `from` (s) on; `None` without its channels or with too few records.
pub fn whirl(model: &Model, recording: &Recording, from: f64) -> Option<WhirlSummary> {
    let all = model.channels();
    let column = |name: &str| -> Option<&[f64]> {
        let place = model.recorded().iter().position(|i| all[*i].name == name)?;
        Some(recording.columns.get(place)?.as_slice())
    };
    let [speed, radius, y, z, cage_speed, ring_y, ring_z] = CHANNELS.map(column);
    let guide = model.scene().cage.as_ref()?.guide.as_ref();
    let moving = guide.is_some_and(|guide| guide.ring == GuideRing::InnerRing);
    let relative = |cage: Option<&[f64]>, ring: Option<&[f64]>| -> Option<Vec<f64>> {
        let ring = ring.filter(|_| moving);
        Some(cage?.iter().enumerate().map(|(i, x)| x - ring.map_or(0.0, |ring| ring[i])).collect())
    };
    let (y, z) = (relative(y, ring_y)?, relative(z, ring_z)?);
    let record = WhirlRecord {
        times: &recording.times,
        whirl_speed: speed?,
        whirl_radius: radius?,
        centre: [&y, &z],
        cage_speed: cage_speed?,
        clearance: model.guide_clearance(),
    };
    WhirlSummary::of(&record, from)
}
