//! Motion of the cage from what was recorded: of its centre, and in space of its axis.

use super::recording::Recording;
use super::whirl::{WhirlRecord, WhirlSummary};
use crate::model::Model;
use crate::scene::GuideRing;

/// Channels that it takes, where the scene has them.
const CHANNELS: [&str; 12] = [
    "cage.whirl_speed",
    "cage.whirl_radius",
    "cage.x",
    "cage.y",
    "cage.z",
    "cage.speed",
    "cage.wobble_speed",
    "cage.tilt",
    "cage.tilt_y",
    "cage.tilt_z",
    "inner_ring.y",
    "inner_ring.z",
];

/// How a cage moved over a window of time.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionOfCage {
    /// Its centre about that of the guide.
    pub whirl: WhirlSummary,
    /// In space, the point on its axis that is one pitch radius from the centre, about the axis of the bearing.
    pub wobble: Option<WhirlSummary>,
}

impl MotionOfCage {
    /// Channels to record for it, where the scene has them.
    pub const CHANNELS: [&'static str; CHANNELS.len()] = CHANNELS;

    /// Motion from time `from` (s) on; `None` without its channels or with too few records.
    pub fn of(model: &Model, recording: &Recording, from: f64) -> Option<Self> {
        let all = model.channels();
        let column = |name: &str| -> Option<&[f64]> {
            let place = model.recorded().iter().position(|i| all[*i].name == name)?;
            Some(recording.columns.get(place)?.as_slice())
        };
        let cage = model.scene().cage.as_ref()?;
        let mut guides =
            cage.guide.iter().chain(cage.space.iter().flat_map(|s| s.lands.iter().map(|land| &land.guide)));
        let moving = guides.next().is_some_and(|guide| guide.ring == GuideRing::InnerRing);
        let relative = |name: &str| -> Option<Vec<f64>> {
            let ring = column(&format!("inner_ring.{name}")).filter(|_| moving);
            let places = column(&format!("cage.{name}"))?.iter().enumerate();
            Some(places.map(|(i, x)| x - ring.map_or(0.0, |ring| ring[i])).collect())
        };
        let (y, z) = (relative("y")?, relative("z")?);
        let record = WhirlRecord {
            times: &recording.times,
            whirl_speed: column("cage.whirl_speed")?,
            whirl_radius: column("cage.whirl_radius")?,
            centre: [&y, &z],
            along: column("cage.x"),
            cage_speed: column("cage.speed")?,
            clearance: model.guide_clearance(),
        };
        let whirl = WhirlSummary::of(&record, from)?;
        let shift = |name: &str| -> Option<Vec<f64>> {
            Some(column(name)?.iter().map(|tilt| model.pitch_radius() * tilt).collect())
        };
        let wobble = || {
            let [shifts, y, z] = ["cage.tilt", "cage.tilt_y", "cage.tilt_z"].map(shift);
            let (shifts, y, z) = (shifts?, y?, z?);
            let record = WhirlRecord {
                whirl_speed: column("cage.wobble_speed")?,
                whirl_radius: &shifts,
                centre: [&y, &z],
                along: None,
                ..record
            };
            WhirlSummary::of(&record, from)
        };
        Some(Self { whirl, wobble: wobble() })
    }
}
