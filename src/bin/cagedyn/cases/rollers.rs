//! Comparison of cases with rollers: where the cage is, and how much the rollers slip.

use super::series::series;
use super::{Comparison, Done, Known, rounded_cell};
use crate::plots::{self, Point};
use crate::points::Row;
use crate::points::columns::OF_ROLLERS;
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

fn cells(row: &Row) -> Vec<String> {
    vec![
        rounded_cell(row, "cage.y_ratio mean [1]", 1.0, 4),
        rounded_cell(row, "cage.y_ratio deviation [1]", 1.0, 4),
        rounded_cell(row, "cage.z_ratio mean [1]", 1.0, 4),
        rounded_cell(row, "cage.z_ratio deviation [1]", 1.0, 4),
        rounded_cell(row, "cage.eccentricity mean [1]", 1.0, 4),
        rounded_cell(row, "max roller slip [1]", 100.0, 2),
        rounded_cell(row, "max pocket force [N]", 1.0, 1),
    ]
}

fn csv_columns(known: &[Known<'_>]) -> Vec<String> {
    let parts = ["mean", "deviation", "standard error"];
    let of = |(name, unit): &Known<'_>| parts.map(|part| format!("{name} {part} [{unit}]"));
    let mut columns: Vec<String> = known.iter().flat_map(of).collect();
    columns.extend(OF_ROLLERS.map(str::to_owned));
    columns
}

/// Mean cage centres, if any cage is guided.
fn picture(title: &str, done: &[Done<'_>]) -> Option<Result<String>> {
    let series = series(done, point);
    (!series.is_empty()).then(|| plots::cage_positions(title, &series))
}

fn point(d: &Done<'_>) -> Option<Point> {
    let row = d.results()?;
    let part = |axis: &str, part: &str| row.number(&format!("cage.{axis}_ratio {part} [1]"));
    let band = |axis: &str| Some([part(axis, "5 %")?, part(axis, "95 %")?]);
    let centre = (part("y", "mean")?, part("z", "mean")?);
    Some(Point { speed: d.speed, centre, bands: [band("y")?, band("z")?] })
}
