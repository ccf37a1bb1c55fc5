//! Comparison of cases whose elements have a prescribed motion: whether and how the cage whirls.

use super::series::series;
use super::{Comparison, Done, Known, rounded_cell};
use crate::plots::{self, WhirlPoint};
use crate::points::Row;
use crate::points::columns::{MOTION, OF_WHIRL, whirls};
use crate::points::row::share_of;
use cagedyn::{CageMotion, Result};

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

fn cells(row: &Row) -> Vec<String> {
    vec![
        rounded_cell(row, "whirl speed mean [rad/s]", 1.0, 1),
        rounded_cell(row, "whirl speed 5 % [rad/s]", 1.0, 1),
        rounded_cell(row, "whirl speed 95 % [rad/s]", 1.0, 1),
        rounded_cell(row, "whirl radius mean [m]", 1e6, 2),
        row.text(MOTION).unwrap_or("-").to_owned(),
        rounded_cell(row, "settling time [s]", 1.0, 4),
    ]
}

fn csv_columns(known: &[Known<'_>]) -> Vec<String> {
    let mut columns: Vec<String> =
        OF_WHIRL.into_iter().chain(["max pocket force [N]"]).map(str::to_owned).collect();
    columns.extend(known.iter().map(|(name, unit)| format!("{name} mean [{unit}]")));
    columns
}

/// Whirl over speed, if the cases have more than one speed.
fn picture(title: &str, done: &[Done<'_>]) -> Option<Result<String>> {
    let series = series(done, point);
    let mut speeds = series.iter().flat_map(|s| &s.points).map(|p| p.speed);
    let first = speeds.next()?;
    speeds.any(|speed| speed != first).then(|| plots::whirl_speed(title, &series))
}

fn point(d: &Done<'_>) -> Option<WhirlPoint> {
    let row = d.results()?;
    let speed = |part: &str| row.number(&format!("whirl speed {part} [rad/s]"));
    let motions = || CageMotion::ALL.into_iter().filter(|motion| motion.is_whirl());
    Some(WhirlPoint {
        speed: d.speed,
        mean: speed("mean")?,
        band: [speed("5 %")?, speed("95 %")?],
        whirls: whirls(row),
        share: motions().map(|known| row.number(&share_of(known))).sum(),
    })
}
