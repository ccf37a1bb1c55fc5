//! Comparison of cases whose elements have a prescribed motion: whether and how the cage whirls.

use super::series::series;
use super::{Comparison, Done, Known, cell};
use crate::plots::{self, WhirlPoint};
use crate::results::summary::{Summary, Whirl};
use crate::results::table::rounded;
use cagedyn::Result;

/// The comparison.
pub(super) const WHIRL: Comparison = Comparison {
    columns: &[
        ("whirl [rad/s]", 13),
        ("5 %", 9),
        ("95 %", 9),
        ("radius [um]", 11),
        ("motion", 14),
        ("settled [s]", 11),
    ],
    cells,
    channels: &CHANNELS,
    csv_columns,
    csv_cells,
    picture_name: "whirl_speed.svg",
    picture,
};

/// Channels whose means are in the file.
const CHANNELS: [&str; 9] = [
    "cage.y_ratio",
    "cage.z_ratio",
    "cage.eccentricity",
    "cage.speed",
    "cage.slip",
    "guide.film_share",
    "guide.minimum_film",
    "pocket.touching_elements",
    "lubricant.viscosity",
];

fn cells(s: &Summary) -> Vec<String> {
    let whirl = s.whirl.as_ref();
    let text = |x: Option<f64>, decimals: usize| x.map_or("-".to_owned(), |x| format!("{x:.decimals$}"));
    vec![
        text(whirl.and_then(|w| w.mean_speed_rad_per_s), 1),
        text(whirl.and_then(|w| w.p05_speed_rad_per_s), 1),
        text(whirl.and_then(|w| w.p95_speed_rad_per_s), 1),
        text(whirl.map(|w| 1e6 * w.mean_radius_m), 2),
        whirl.map_or("-".to_owned(), |w| w.motion.name().to_owned()),
        text(whirl.and_then(settled), 4),
    ]
}

/// Settling time of a whirl, s; that of other motions says nothing.
fn settled(whirl: &Whirl) -> Option<f64> {
    whirl.settling_time_s.filter(|_| whirl.motion.is_whirl()).map(rounded)
}

/// Columns of tables on the motion of the cage centre.
pub const OF_WHIRL: [&str; 7] = [
    "whirl speed mean [rad/s]",
    "whirl speed 5 % [rad/s]",
    "whirl speed 95 % [rad/s]",
    "whirl radius mean [m]",
    "turns [1]",
    "motion",
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

fn csv_columns(known: &[Known]) -> Vec<String> {
    let mut columns: Vec<String> =
        OF_WHIRL.into_iter().chain(["max pocket force [N]"]).map(str::to_owned).collect();
    columns.extend(known.iter().map(|(name, unit)| format!("{name} mean [{unit}]")));
    columns
}

fn csv_cells(s: &Summary, known: &[Known]) -> Vec<String> {
    let mut row = of_whirl(s).to_vec();
    row.push(cell(s.pocket_forces.as_ref().map(|forces| forces.largest_n)));
    row.extend(known.iter().map(|(name, _)| cell(s.of(name).map(|s| s.spread.mean))));
    row
}

/// Whirl over speed, if the cases have more than one speed.
fn picture(title: &str, done: &[Done<'_>]) -> Option<Result<String>> {
    let series = series(done, point);
    let mut speeds = series.iter().flat_map(|s| &s.points).map(|p| p.speed);
    let first = speeds.next()?;
    speeds.any(|speed| speed != first).then(|| plots::whirl_speed(title, &series))
}

fn point(d: &Done<'_>) -> Option<WhirlPoint> {
    let w = d.results()?.whirl.as_ref()?;
    Some(WhirlPoint {
        speed: d.speed,
        mean: w.mean_speed_rad_per_s?,
        band: [w.p05_speed_rad_per_s?, w.p95_speed_rad_per_s?],
        whirls: w.motion.is_whirl(),
    })
}
