//! Comparison of cases with rollers: where the cage is, and how much the rollers slip.

use super::series::series;
use super::{Comparison, Done};
use crate::plots::{self, Point};
use crate::table::rounded;
use cagedyn::{Result, Spread};

/// The comparison.
pub const ROLLERS: Comparison =
    Comparison { columns: &COLUMNS, row, csv_rows, picture_name: "cage_positions.svg", picture };

/// Columns of the printed table: heading, narrowest width.
const COLUMNS: [(&str, usize); 9] = [
    ("case", 4),
    ("y/c", 8),
    ("+-", 7),
    ("z/c", 8),
    ("+-", 7),
    ("eccentricity", 12),
    ("max roller slip [%]", 19),
    ("wall time [s]", 13),
    ("", 0),
];

fn row(done: &Done<'_>) -> Vec<String> {
    let s = &done.summary;
    let mean = |name: &str| s.of(name).map_or("-".to_owned(), |s| format!("{:.4}", s.spread.mean));
    let deviation = |name: &str| s.of(name).map_or("-".to_owned(), |s| format!("{:.4}", s.spread.deviation));
    vec![
        done.case.name.clone(),
        mean("cage.y_ratio"),
        deviation("cage.y_ratio"),
        mean("cage.z_ratio"),
        deviation("cage.z_ratio"),
        mean("cage.eccentricity"),
        s.max_roller_slip.as_ref().map_or("-".to_owned(), |slip| format!("{:.2}", 100.0 * slip.value)),
        format!("{:.2}", s.wall_time_s),
        done.state().to_owned(),
    ]
}

fn csv_rows(done: &[Done<'_>]) -> Vec<Vec<String>> {
    let channels = ["cage.y_ratio", "cage.z_ratio", "cage.eccentricity", "cage.speed", "cage.slip"];
    let others = ["inner_ring.y", "inner_ring.z", "inner_ring.drag_torque"];
    let channels: Vec<&str> = channels.into_iter().chain(others).collect();
    let unit = |name: &str| done.iter().find_map(|d| d.summary.of(name)).map_or("1", |s| s.unit);
    let mut head = vec!["case".to_owned(), "inner ring speed [1/min]".to_owned()];
    for name in &channels {
        head.push(format!("{name} mean [{}]", unit(name)));
        head.push(format!("{name} deviation [{}]", unit(name)));
        head.push(format!("{name} standard error [{}]", unit(name)));
    }
    head.extend(
        ["max roller slip [1]", "simulated time [s]", "wall time [s]", "complete"].map(str::to_owned),
    );
    let body = done.iter().map(|d| {
        let s = &d.summary;
        let mut row = vec![d.case.name.clone(), rounded(d.speed).to_string()];
        for name in &channels {
            let of = s.of(name);
            row.push(of.map_or(String::new(), |s| format!("{:?}", s.spread.mean)));
            row.push(of.map_or(String::new(), |s| format!("{:?}", s.spread.deviation)));
            row.push(of.map_or(String::new(), |s| known_error(&s.spread)));
        }
        row.push(s.max_roller_slip.as_ref().map_or(String::new(), |slip| format!("{:?}", slip.value)));
        row.push(format!("{:?}", s.simulated_time_s));
        row.push(format!("{:.3}", s.wall_time_s));
        row.push(d.state().is_empty().to_string());
        row
    });
    std::iter::once(head).chain(body).collect()
}

/// Standard error of a mean that has settled.
fn known_error(spread: &Spread) -> String {
    if spread.stationary { format!("{:?}", spread.standard_error) } else { String::new() }
}

/// Mean cage centres, if any cage is guided.
fn picture(title: &str, done: &[Done<'_>]) -> Option<Result<String>> {
    let series = series(done, point);
    (!series.is_empty()).then(|| plots::cage_positions(title, &series))
}

fn point(d: &Done<'_>) -> Option<Point> {
    let centre = (d.summary.of("cage.y_ratio")?.spread.mean, d.summary.of("cage.z_ratio")?.spread.mean);
    Some(Point { speed: d.speed, centre })
}
