//! Columns of tables of runs on slip, pocket forces and whirl, and their cells.

use super::Row;
use crate::results::files::plain;
use crate::results::summary::{Summary, Whirl};
use crate::results::table::rounded;
use cagedyn::CageMotion;

/// Columns on slip and pocket forces.
pub const OF_ROLLERS: [&str; 5] = [
    "max roller slip [1]",
    "mean roller slip [1]",
    "driving pocket force [N]",
    "braking pocket force [N]",
    "max pocket force [N]",
];

/// Their cells, empty where there is nothing.
pub fn of_rollers(s: &Summary) -> [String; OF_ROLLERS.len()] {
    let forces = s.pocket_forces.as_ref();
    [
        cell(s.max_roller_slip.as_ref().map(|slip| slip.value)),
        cell(mean_slip(s)),
        cell(forces.map(|f| f.driving_n)),
        cell(forces.map(|f| f.braking_n)),
        cell(forces.map(|f| f.largest_n)),
    ]
}

/// Mean slip of all rollers.
fn mean_slip(s: &Summary) -> Option<f64> {
    let is_slip = |name: &str| name.starts_with("roller[") && name.ends_with("].slip");
    let slips = || s.statistics.iter().filter(|(name, _)| is_slip(name)).map(|(_, of)| of.spread.mean);
    let count = slips().count();
    (count > 0).then(|| slips().sum::<f64>() / count as f64)
}

/// Column of [`OF_WHIRL`] that is no number.
pub const MOTION: &str = "motion";

/// Class of the motion of the axis of a cage in space.
pub const WOBBLE: &str = "wobble";

/// Columns on the motion of the cage centre.
pub const OF_WHIRL: [&str; 7] = [
    "whirl speed mean [rad/s]",
    "whirl speed 5 % [rad/s]",
    "whirl speed 95 % [rad/s]",
    "whirl radius mean [m]",
    "turns [1]",
    MOTION,
    "settling time [s]",
];

/// Their cells, empty where there is nothing.
pub fn of_whirl(s: &Summary) -> [String; OF_WHIRL.len()] {
    let whirl = s.whirl.as_ref();
    [
        cell(whirl.and_then(|w| w.mean_speed_rad_per_s)),
        cell(whirl.and_then(|w| w.p05_speed_rad_per_s)),
        cell(whirl.and_then(|w| w.p95_speed_rad_per_s)),
        cell(whirl.map(|w| w.mean_radius_m)),
        cell(whirl.map(|w| w.turns)),
        whirl.map_or(String::new(), |w| w.motion.name().to_owned()),
        cell(whirl.and_then(settled)),
    ]
}

/// Whether the cage of a run whirls.
pub fn whirls(row: &Row) -> bool {
    let motion = row.text(MOTION);
    CageMotion::ALL.into_iter().any(|known| known.is_whirl() && Some(known.name()) == motion)
}

/// Settling time of a whirl, s; that of other motions says nothing.
fn settled(whirl: &Whirl) -> Option<f64> {
    whirl.settling_time_s.filter(|_| whirl.motion.is_whirl()).map(rounded)
}

/// A number in a table; empty where there is none.
pub fn cell(x: Option<f64>) -> String {
    x.map_or(String::new(), plain)
}
