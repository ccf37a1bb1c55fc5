//! Comparison of cases with rollers: where the cage is, and how much the rollers slip.

use super::series::series;
use super::{Comparison, Done, Known, cell};
use crate::plots::{self, Point};
use crate::results::summary::Summary;
use cagedyn::Result;

/// The comparison.
pub(super) const ROLLERS: Comparison = Comparison {
    columns: &[
        ("y/c", 8),
        ("+-", 7),
        ("z/c", 8),
        ("+-", 7),
        ("eccentricity", 12),
        ("max roller slip [%]", 19),
        ("max pocket force [N]", 20),
    ],
    cells,
    channels: &CHANNELS,
    csv_columns,
    csv_cells,
    picture_name: "cage_positions.svg",
    picture,
};

/// Channels whose means are in the file.
const CHANNELS: [&str; 8] = [
    "cage.y_ratio",
    "cage.z_ratio",
    "cage.eccentricity",
    "cage.speed",
    "cage.slip",
    "inner_ring.y",
    "inner_ring.z",
    "inner_ring.drag_torque",
];

fn cells(s: &Summary) -> Vec<String> {
    let text = |x: Option<f64>, decimals: usize| x.map_or("-".to_owned(), |x| format!("{x:.decimals$}"));
    let mean = |name: &str| text(s.of(name).map(|s| s.spread.mean), 4);
    let deviation = |name: &str| text(s.of(name).map(|s| s.spread.deviation), 4);
    vec![
        mean("cage.y_ratio"),
        deviation("cage.y_ratio"),
        mean("cage.z_ratio"),
        deviation("cage.z_ratio"),
        mean("cage.eccentricity"),
        text(s.max_roller_slip.as_ref().map(|slip| 100.0 * slip.value), 2),
        text(s.pocket_forces.as_ref().map(|forces| forces.largest_n), 1),
    ]
}

fn csv_columns(known: &[Known<'_>]) -> Vec<String> {
    let parts = ["mean", "deviation", "standard error"];
    let of = |(name, unit): &Known<'_>| parts.map(|part| format!("{name} {part} [{unit}]"));
    let mut columns: Vec<String> = known.iter().flat_map(of).collect();
    columns.extend(OF_ROLLERS.map(str::to_owned));
    columns
}

fn csv_cells(s: &Summary, known: &[Known<'_>]) -> Vec<String> {
    let mut row = Vec::new();
    for (name, _) in known {
        let spread = s.of(name).map(|s| &s.spread);
        row.push(cell(spread.map(|s| s.mean)));
        row.push(cell(spread.map(|s| s.deviation)));
        // Of a mean that has settled.
        row.push(cell(spread.filter(|s| s.stationary).map(|s| s.standard_error)));
    }
    row.extend(of_rollers(s));
    row
}

/// Columns of tables on slip and pocket forces.
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

/// Mean cage centres, if any cage is guided.
fn picture(title: &str, done: &[Done<'_>]) -> Option<Result<String>> {
    let series = series(done, point);
    (!series.is_empty()).then(|| plots::cage_positions(title, &series))
}

fn point(d: &Done<'_>) -> Option<Point> {
    let s = d.results()?;
    let centre = (s.of("cage.y_ratio")?.spread.mean, s.of("cage.z_ratio")?.spread.mean);
    Some(Point { speed: d.speed, centre })
}
